"""Catalogue formulas of the friction torque: Stribeck, Palmgren, SKF. For comparison.

They are scaled from small fast bearings; on a slow main bearing they spread by a factor of three
and more, which is why they stand beside the component models. SI units at the door.

References
----------
Stribeck 1901; Palmgren 1957 and 1964, as (4.31)–(4.35) of von Hollen 2013; SKF, Rolling bearings,
chapter Friction (forms of G_rr, G_sl, μ_sl, inlet heating; the constants R, S of each series are in
`loadflow/data/skf_friction.toml`; the drag term needs the catalogue's diagrams and is left out).
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Annotated, Any, Literal, get_args

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields, check_one_of

Array = NDArray[np.float64]
CatalogueKind = Literal["cylindrical", "tapered", "spherical"]
_NotNegative = Annotated[float, Ge(0)]
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
    "ball": 0.0015,
}

_SLIDING = {"cylindrical": 0.02, "tapered": 0.002}  # μ_EHL; other bearings 0.05 (mineral oil)


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


@dataclass(frozen=True, kw_only=True)
class SkfConstants:
    """Constants of one bearing series; those of SKF's table give `skf_constants`.

    Attributes
    ----------
    kind : {"cylindrical", "tapered", "spherical"}
        Type of bearing.
    r1, r2, r3, r4 : float
        R of the rolling torque (cylindrical: R₁; tapered: R₁, R₂; spherical: all).
    s1, s2, s3, s4 : float
        S of the sliding torque (spherical: all, else S₁, S₂).
    axial_factor : float
        Y of tapered bearings.
    starvation, geometry : float
        K_rs (3e-8 oil bath, 6e-8 grease) and K_Z (cylindrical 5.1, spherical 5.5, tapered 6).

    Raises
    ------
    InputError
        A kind that is none of these, or a negative constant.

    Examples
    --------
    >>> from loadflow.rolling.friction import SkfConstants
    >>> series = SkfConstants(kind="cylindrical", r1=1.54e-6, s1=0.16, s2=0.0015, geometry=5.1)
    >>> series.starvation
    6e-08
    """

    kind: CatalogueKind
    r1: _NotNegative
    s1: _NotNegative
    s2: _NotNegative
    r2: _NotNegative = 0.0
    r3: _NotNegative = 0.0
    r4: _NotNegative = 0.0
    s3: _NotNegative = 0.0
    s4: _NotNegative = 0.0
    axial_factor: _NotNegative = 0.0
    starvation: _NotNegative = 6e-8
    geometry: Annotated[float, Gt(0)] = 5.1

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "kind", get_args(CatalogueKind))

    def idle(self) -> Iterator[tuple[str, str]]:
        """Constants that the formulas of the type do not have, and why."""
        read = {
            "cylindrical": (),
            "tapered": ("r2", "axial_factor"),
            "spherical": ("r2", "r3", "r4", "s3", "s4"),
        }[self.kind]
        for name in ("r2", "r3", "r4", "s3", "s4", "axial_factor"):
            if name not in read:
                yield name, f"SKF's formulas of {self.kind} rollers have none"


def skf_constants(kind: CatalogueKind, series: str, axial_factor: float = 0.0) -> SkfConstants:
    """Constants of a series from SKF's table, `loadflow/data/skf_friction.toml`.

    Parameters
    ----------
    kind : {"cylindrical", "tapered", "spherical"}
        Type of bearing.
    series : str
        One of `skf_series` of that type.
    axial_factor : float
        Y of a tapered bearing; each has its own, and others have none.

    Raises
    ------
    InputError
        If there is no such type or series, or `axial_factor` is missing or makes no sense.

    Examples
    --------
    >>> from loadflow.rolling.friction import skf_constants, skf_torque
    >>> found = skf_torque(skf_constants("spherical", "240"), 1e6, 2e5, 1.3, 320e-6, 0.75, 1.09)
    >>> [round(float(torque)) for torque in found]  # N m, rolling and sliding
    [304, 244]
    """
    known = skf_series(kind)
    check_one_of("series", series, known)
    if not (axial_factor > 0 if kind == "tapered" else axial_factor == 0):
        raise InputError(
            "axial_factor: Y of a tapered bearing must be > 0, of others it is left out, "
            f"got {axial_factor} for {kind}"
        )
    return SkfConstants(kind=kind, axial_factor=axial_factor, **_skf_table()[kind][series])


def skf_series(kind: CatalogueKind) -> list[str]:
    """Names of the series of a type that SKF's table has.

    Examples
    --------
    >>> from loadflow.rolling.friction import skf_series
    >>> skf_series("spherical")[-2:]
    ['248', '249']
    """
    table = _skf_table()
    check_one_of("kind", kind, table)
    return [*table[kind]]


@lru_cache(maxsize=1)
def _skf_table() -> dict[str, dict[str, dict[str, Any]]]:
    path = resources.files("loadflow.data") / "skf_friction.toml"
    return dict(tomllib.loads(path.read_text(encoding="utf-8"))["series"])


def skf_torque(
    constants: SkfConstants,
    radial: ArrayLike,
    axial: ArrayLike,
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside_diameter: float,
    boundary: float = 0.15,
) -> tuple[Array, Array]:
    """Rolling and sliding torque after SKF, N m, (4.36) without seals and drag.

    Parameters
    ----------
    constants : SkfConstants
        Of the series.
    radial, axial : array_like
        Magnitudes of the loads, N.
    speed : array_like
        rad/s.
    viscosity : array_like
        Kinematic viscosity of the (base) oil, m²/s.
    bore, outside_diameter : float
        m.
    boundary : float
        μ_bl of boundary lubrication.

    Examples
    --------
    >>> from loadflow.rolling.friction import SkfConstants, skf_torque
    >>> series = SkfConstants(kind="cylindrical", r1=1.54e-6, s1=0.16, s2=0.0015, geometry=5.1)
    >>> found = skf_torque(series, 1e5, 0.0, 10.0, 320e-6, bore=0.3, outside_diameter=0.5)
    >>> [round(float(torque)) for torque in found]  # rolling, sliding
    [40, 1]
    """
    fr, fa = np.asarray(radial, float), np.asarray(axial, float)
    n = np.abs(np.asarray(speed, float)) * _RPM
    nu, d, big = np.asarray(viscosity, float) * 1e6, bore * 1e3, outside_diameter * 1e3
    mean = (d + big) / 2
    if constants.kind == "cylindrical":
        rolling = constants.r1 * mean**2.41 * fr**0.31
        sliding = constants.s1 * mean**0.9 * fa + constants.s2 * mean * fr
    elif constants.kind == "tapered":
        thrust = constants.axial_factor * fa
        rolling = constants.r1 * mean**2.38 * (fr + constants.r2 * thrust) ** 0.31
        sliding = constants.s1 * mean**0.82 * (fr + constants.s2 * thrust)
    else:
        points = constants.r1 * mean**1.85 * (fr + constants.r2 * fa) ** 0.54
        lines = constants.r3 * mean**2.3 * (fr + constants.r4 * fa) ** 0.31
        rolling = np.minimum(points, lines)
        points = constants.s1 * mean**0.25 * (fr**4 + constants.s2 * fa**4) ** (1 / 3)
        lines = constants.s3 * mean**0.94 * (fr**3 + constants.s4 * fa**3) ** (1 / 3)
        sliding = np.minimum(points, lines)
    heated = 1 / (1 + 1.84e-9 * (n * mean) ** 1.28 * nu**0.64)
    crowd = np.sqrt(constants.geometry / (2 * (big - d)))
    refill = np.exp(-constants.starvation * nu * n * (d + big) * crowd)
    dry = np.exp(-2.6e-8 * (n * nu) ** 1.4 * mean)
    friction = dry * boundary + (1 - dry) * _SLIDING.get(constants.kind, 0.05)
    return (
        np.asarray(heated * refill * rolling * (nu * n) ** 0.6 * 1e-3),
        np.asarray(sliding * friction * 1e-3),
    )


def catalogue_torques(
    kind: CatalogueKind,
    radial: ArrayLike,
    axial: ArrayLike,
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside_diameter: float,
    series: SkfConstants | None = None,
) -> dict[str, Array]:
    """Torque after each catalogue that needs no more than type, size and load, N m.

    Parameters
    ----------
    kind : {"cylindrical", "tapered", "spherical"}
        Type of bearing.
    radial, axial : array_like
        Magnitudes of the loads, N.
    speed, viscosity, bore, outside_diameter
        As `skf_torque`.
    series : SkfConstants, optional
        Adds SKF's model; see `skf_constants`.

    Returns
    -------
    dict of str to ndarray
        "constant coefficient" (on bore and load), "palmgren", and "skf".

    Examples
    --------
    >>> spread = catalogue_torques("cylindrical", 1e6, 0.0, 1.5, 1e-4, 0.5, 0.72)
    >>> {name: round(float(torque)) for name, torque in spread.items()}
    {'palmgren': 192, 'constant coefficient': 275}
    """
    fr, fa = np.asarray(radial, float), np.asarray(axial, float)
    mean = (bore + outside_diameter) / 2
    torques = {
        "palmgren": palmgren_torque(kind, fr, fa, speed, viscosity, mean),
        "constant coefficient": stribeck_torque(
            np.hypot(fr, fa), bore, FRICTION_COEFFICIENTS[kind]
        ),
    }
    if series is not None:
        torques["skf"] = sum(
            skf_torque(series, fr, fa, speed, viscosity, bore, outside_diameter), np.zeros(())
        )
    return torques
