"""Catalogue formulas of the friction torque: Stribeck, Palmgren, and SKF's beside. For comparison.

They are scaled from small fast bearings; on a slow main bearing they spread by a factor of three
and more, which is why they stand beside the component models. SI units at the door.

References
----------
Stribeck 1901; Palmgren 1957 and 1964, as (4.31)–(4.35) of von Hollen 2013; SKF: `skf`.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.rolling.friction.skf import CatalogueKind, SkfConstants, skf_torque

Array = NDArray[np.float64]
_RPM = 30 / np.pi  # rad/s in 1/min

# Palmgren's f₀ of oil-bath or grease lubrication, and f₁ of cylindrical, tapered and spherical
# roller bearings, middle of the ranges of Harris & Kotzalas, Essential Concepts, ch. 10.
PALMGREN_F0 = {"cylindrical": 2.5, "tapered": 4.0, "spherical": 5.0, "ball": 1.5}
PALMGREN_F1 = {"cylindrical": 3e-4, "tapered": 4e-4, "spherical": 5e-4}

# Constant coefficients of friction of open bearings at about a tenth of their capacity (SKF)
FRICTION_COEFFICIENTS = {
    "cylindrical": 0.0011,
    "tapered": 0.0018,
    "spherical": 0.0018,
    "deep groove": 0.0015,
    "angular contact": 0.0020,
    "four-point": 0.0024,
}


def stribeck_torque(load: ArrayLike, pitch_diameter: float, friction: float) -> Array:
    """Torque F μ d_m/2, N m, (4.31).

    Parameters
    ----------
    load : array_like
        N.
    pitch_diameter : float
        d_m, m.
    friction : float
        μ, 0.001 … 0.003.

    Returns
    -------
    ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import stribeck_torque
    >>> round(float(stribeck_torque(1e4, 0.06, 0.0011)), 3)  # N m
    0.33
    """
    return np.asarray(np.asarray(load, float) * friction * pitch_diameter / 2)


def palmgren_idle_torque(
    speed: ArrayLike, viscosity: ArrayLike, pitch_diameter: float, factor: float
) -> Array:
    """Palmgren's torque without load M₀, N m, (4.33).

    Parameters
    ----------
    speed : array_like
        rad/s.
    viscosity : array_like
        Kinematic viscosity, m²/s.
    pitch_diameter : float
        m.
    factor : float
        f₀ of type and lubrication (`PALMGREN_F0`).

    Returns
    -------
    ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import palmgren_idle_torque
    >>> slow, fast = palmgren_idle_torque([100.0, 200.0], 1e-5, 0.06, factor=2.0)
    >>> round(float(fast / slow), 2)  # 2^(2/3)
    1.59
    """
    flow = np.asarray(viscosity, float) * 1e6 * np.abs(np.asarray(speed, float)) * _RPM
    # constant below ν n = 2000, where 160 = 2000^(2/3) to 0.8 %
    law = np.where(flow < 2000, 160.0, flow ** (2 / 3))
    return np.asarray(1e-7 * factor * (pitch_diameter * 1e3) ** 3 * law * 1e-3)


def palmgren_load_torque(
    load: ArrayLike,
    pitch_diameter: float,
    factor: float,
    static_capacity: float | None = None,
    exponent: float = 0.0,
) -> Array:
    """Palmgren's torque of the load M₁ = f F d_m (F/C₀)^c, N m, (4.34); c = 0 gives (4.35).

    Parameters
    ----------
    load : array_like
        Load that decides friction, N.
    pitch_diameter : float
        m.
    factor : float
        f, or f₁ (`PALMGREN_F1`) with c = 0.
    static_capacity : float, optional
        C₀, N; needed unless c = 0.
    exponent : float
        c.

    Returns
    -------
    ndarray
        N m.

    Raises
    ------
    InputError
        If `exponent` is not 0 and `static_capacity` is missing.

    Examples
    --------
    >>> from loadflow.rolling.friction import palmgren_load_torque
    >>> round(float(palmgren_load_torque(1e4, 0.06, 0.0003)), 3)  # N m
    0.18
    """
    force = np.asarray(load, float)
    if exponent == 0:
        return np.asarray(factor * force * pitch_diameter)
    if static_capacity is None:
        raise InputError("static_capacity: needed for an exponent other than 0")
    return np.asarray(factor * force * pitch_diameter * (force / static_capacity) ** exponent)


def palmgren_torque(
    kind: CatalogueKind,
    radial: ArrayLike,
    axial: ArrayLike,
    speed: ArrayLike,
    viscosity: ArrayLike,
    pitch_diameter: float,
) -> Array:
    """Palmgren's whole torque M₀ + M₁, N m, (4.32), with `PALMGREN_F0` and `PALMGREN_F1`.

    Parameters
    ----------
    kind : {"cylindrical", "tapered", "spherical"}
        Type of bearing.
    radial, axial : array_like
        Magnitudes of the loads, N.
    speed, viscosity, pitch_diameter
        As `palmgren_idle_torque`.

    Returns
    -------
    ndarray
        N m.

    Raises
    ------
    InputError
        If there is no such type.

    Examples
    --------
    >>> from loadflow.rolling.friction import palmgren_torque
    >>> round(float(palmgren_torque("cylindrical", 1e6, 0.0, 1.5, 1e-4, 0.61)))  # N m
    192
    """
    check_one_of("kind", kind, PALMGREN_F1)
    load = np.hypot(radial, axial)
    idle = palmgren_idle_torque(speed, viscosity, pitch_diameter, PALMGREN_F0[kind])
    return np.asarray(idle + palmgren_load_torque(load, pitch_diameter, PALMGREN_F1[kind]))


def catalogue_torques(
    kind: CatalogueKind,
    radial: ArrayLike,
    axial: ArrayLike,
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside_diameter: float,
    series: SkfConstants | None = None,
    static_capacity: float | None = None,
) -> dict[str, Array]:
    """Torque after each catalogue that needs no more than type, size and load, N m.

    Parameters
    ----------
    kind : {"cylindrical", "tapered", "spherical", "deep groove", "angular contact", "four-point"}
        Type of bearing.
    radial, axial : array_like
        Magnitudes of the loads, N.
    speed, viscosity, bore, outside_diameter
        As `skf_torque`.
    series : SkfConstants, optional
        Adds SKF's model; see `skf_constants`.
    static_capacity : float, optional
        As `skf_torque`.

    Returns
    -------
    dict of str to ndarray
        "constant coefficient" (on bore and load), of rollers "palmgren", and "skf".

    Examples
    --------
    >>> spread = catalogue_torques("cylindrical", 1e6, 0.0, 1.5, 1e-4, 0.5, 0.72)
    >>> {name: round(float(torque)) for name, torque in spread.items()}
    {'palmgren': 192, 'constant coefficient': 275}
    """
    fr, fa = np.asarray(radial, float), np.asarray(axial, float)
    mean = (bore + outside_diameter) / 2
    torques = {}
    if kind in PALMGREN_F1:
        torques["palmgren"] = palmgren_torque(kind, fr, fa, speed, viscosity, mean)
    torques["constant coefficient"] = stribeck_torque(
        np.hypot(fr, fa), bore, FRICTION_COEFFICIENTS[kind]
    )
    if series is not None:
        size = bore, outside_diameter
        parts = skf_torque(series, fr, fa, speed, viscosity, *size, static_capacity=static_capacity)
        torques["skf"] = sum(parts, np.zeros(()))
    return torques
