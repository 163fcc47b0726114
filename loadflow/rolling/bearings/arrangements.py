"""Arrangements of main bearings: what stands at N, N2 or M, and what all of them give together."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import not_one_of
from loadflow.rolling.bearings.base import RollingBearing
from loadflow.rolling.bearings.four_point import SlewingBearing
from loadflow.rolling.bearings.roller import RollerBearing
from loadflow.rolling.bearings.spherical import SphericalRollerBearing
from loadflow.rolling.rating import life, modified_life
from loadflow.rolling.rating.modified_life import Lubrication

_SPHERICAL = SphericalRollerBearing(
    rollers=30,
    roller_diameter=0.09,
    roller_length=0.14,
    pitch_diameter=1.0,
    contact_angle=0.21,
    clearance=200e-6,
    profile="crowned",
    crown_radius=18.0,
)

_ARRANGEMENTS: dict[str, dict[str, RollingBearing]] = {
    "two-spherical": {"N": _SPHERICAL, "N2": _SPHERICAL},
    "cylindrical-tapered": {
        "N": RollerBearing(
            rollers=40,
            roller_diameter=0.08,
            roller_length=0.14,
            pitch_diameter=1.3,
            clearance=100e-6,
        ),
        "N2": RollerBearing(
            rollers=44,
            roller_diameter=0.07,
            roller_length=0.12,
            pitch_diameter=1.2,
            rows=2,
            row_spacing=0.25,
            contact_angle=0.35,
            clearance=-50e-6,
        ),
    },
    "tapered-pair": {
        "M": RollerBearing(
            rollers=64,
            roller_diameter=0.08,
            roller_length=0.14,
            pitch_diameter=2.2,
            rows=2,
            row_spacing=0.9,
            contact_angle=0.7,
            clearance=-50e-6,
        )
    },
    "moment": {
        "M": SlewingBearing(
            balls=90,
            rows=2,
            ball_diameter=0.12,
            pitch_diameter=3.6,
            groove_radius=0.0624,
            contact_angle=math.pi / 4,
            row_spacing=0.15,
        )
    },
}
ARRANGEMENTS = tuple(_ARRANGEMENTS)


def main_bearings(arrangement: str) -> dict[str, RollingBearing]:
    """Bearings of an arrangement, by their place on the shaft, sized for a turbine of 5 MW.

    N floats and N2 locates on a shaft in two bearings; M takes force and tilting moment. Sizes are
    assumed such that all but the four-point bearing live 20 years on the NREL 5 MW turbine.

    Parameters
    ----------
    arrangement : {"two-spherical", "cylindrical-tapered", "tapered-pair", "moment"}
        Two spherical roller bearings; a cylindrical roller bearing before a double-row tapered one;
        a pair of tapered rows far apart, back-to-back and preloaded; one four-point ball bearing.

    Returns
    -------
    dict
        By place, its bearing.

    Raises
    ------
    InputError
        If there is no such arrangement.

    Examples
    --------
    >>> {place: type(b).__name__ for place, b in main_bearings("cylindrical-tapered").items()}
    {'N': 'RollerBearing', 'N2': 'RollerBearing'}
    """
    if arrangement not in _ARRANGEMENTS:
        raise InputError(f"arrangement: {not_one_of(arrangement, ARRANGEMENTS)}")
    return dict(_ARRANGEMENTS[arrangement])


@dataclass(frozen=True)
class SpectrumLife:
    """Modified life of a bearing under a spectrum of loads and speeds.

    Attributes
    ----------
    life : float
        With a_ISO of every step, at a reliability of 90 %, 10⁶ revolutions.
    factor : float
        Modified over basic life.
    least_viscosity_ratio : float
        Smallest κ of what turns.
    thin_share : float
        Share of the revolutions with κ below 0.1, where ISO 281 gives no factor; there a_ISO counts
        as its smallest value, 0.1.

    Examples
    --------
    >>> from loadflow.rolling import Lubrication, main_bearings, modified_spectrum_life
    >>> from loadflow.tribology import lubricant
    >>> oil = Lubrication(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> bearing = main_bearings("tapered-pair")["M"]
    >>> found = modified_spectrum_life(bearing, [1e6, 2e6], [1.2, 1.2], oil, weight=[0.9, 0.1])
    >>> found.factor > 0.1, found.thin_share
    (True, 0.0)
    """

    life: float
    factor: float
    least_viscosity_ratio: float
    thin_share: float


def modified_spectrum_life(
    bearing: RollingBearing,
    load: ArrayLike,
    speed: ArrayLike,
    lubrication: Lubrication,
    weight: ArrayLike = 1.0,
) -> SpectrumLife:
    """Modified life of ISO 281 over a spectrum, a_ISO of each step by its own speed and load.

    Parameters
    ----------
    bearing : RollingBearing
        The bearing.
    load, speed : array_like, shape (n,)
        Dynamic equivalent (reference) load, N, and rad/s.
    lubrication : Lubrication
        Oil, temperature and cleanliness.
    weight : array_like, shape (n,)
        Time that each step stands for, in any unit.

    Returns
    -------
    SpectrumLife
        Life, its factor, and how thin the film is.

    Examples
    --------
    >>> from loadflow.rolling import Lubrication, main_bearings, modified_spectrum_life
    >>> from loadflow.tribology import lubricant
    >>> bearing = main_bearings("tapered-pair")["M"]
    >>> oil = lubricant("mineral-vg-320")
    >>> cold, warm = (
    ...     modified_spectrum_life(bearing, [1e6], [1.2], Lubrication(oil=oil, temperature=kelvin))
    ...     for kelvin in (313.15, 343.15)
    ... )
    >>> cold.life > warm.life  # the warmer, the thinner the film
    True
    """
    turns = np.abs(np.asarray(speed, float)) * np.asarray(weight, float)
    rolls = turns > 0
    if not rolls.any():
        return SpectrumLife(np.inf, 1.0, np.nan, 0.0)
    turns, forces = turns[rolls], np.broadcast_to(load, rolls.shape)[rolls]
    omega = np.broadcast_to(speed, rolls.shape)[rolls]
    kappa = modified_life.viscosity_ratio(lubrication, omega, bearing.pitch_diameter)
    thin = kappa < modified_life.KAPPA_RANGE[0]
    factor = np.full(turns.shape, modified_life.LEAST_FACTOR)
    if not thin.all():
        thick = bearing.life_modification(forces[~thin], omega[~thin], lubrication)
        factor[~thin] = thick.factor
    capacity, exponent = bearing.rated_capacity, bearing.life_exponent
    # a life longer by a_ISO is that of a lighter load
    lighter = forces * factor ** (-1 / exponent)
    basic, modified = (
        float(life.rating_life_spectrum(capacity, one, turns, exponent))
        for one in (forces, lighter)
    )
    return SpectrumLife(
        life=modified,
        factor=modified / basic if np.isfinite(basic) else 1.0,
        least_viscosity_ratio=float(kappa.min()),
        thin_share=float(turns[thin].sum() / turns.sum()),
    )


@dataclass(frozen=True)
class BearingLife:
    """What a load series does to one bearing of an arrangement.

    Attributes
    ----------
    life : float
        Rating life under the whole series, 10⁶ revolutions.
    life_hours : float
        The same in hours at the mean speed of the series.
    static_safety, maximum_pressure : float
        Smallest safety by force, largest pressure (Pa).
    modified_life_hours : float, optional
        With a_ISO of every step, at a reliability of 90 %, h; None without a lubrication.

    Examples
    --------
    >>> from loadflow.rolling import arrangement_lives, main_bearings
    >>> bearings = main_bearings("tapered-pair")
    >>> force, moment = {"M": [[0.0, -1e6, 3e5]]}, {"M": [[1e6, 0.0]]}
    >>> life = arrangement_lives({"M": bearings["M"]}, force, moment, speed=[1.2])["M"]
    >>> life.life_hours > 1e4, life.modified_life_hours is None
    (True, True)
    """

    life: float
    life_hours: float
    static_safety: float
    maximum_pressure: float
    modified_life_hours: float | None = None


def arrangement_lives(
    bearings: Mapping[str, RollingBearing],
    force: Mapping[str, ArrayLike],
    moment: Mapping[str, ArrayLike],
    speed: ArrayLike,
    weight: ArrayLike = 1.0,
    lubrication: Lubrication | None = None,
) -> dict[str, BearingLife]:
    """Life and static safety of each bearing under its loads, each step weighted by revolutions.

    Parameters
    ----------
    bearings : mapping
        Bearing by place, as of `main_bearings`.
    force, moment : mapping
        By place: force (n, 3), N, and moment (n, 2), N m, on the inner ring; z is the shaft.
    speed : array_like, shape (n,)
        rad/s.
    weight : array_like, shape (n,)
        Time that each step stands for, in any unit: its length, its share of the lifetime.
    lubrication : Lubrication, optional
        Gives the modified life too.

    Returns
    -------
    dict
        `BearingLife` by place. `system_life` of the hours gives the arrangement's.

    Raises
    ------
    InputError
        If loads are missing or have wrong shapes, nothing turns, or the film of a turning step is
        too thin for ISO 281 (κ below 0.1).
    SolverError
        If a load has no equilibrium.

    Examples
    --------
    >>> from loadflow.rolling import arrangement_lives, main_bearings
    >>> bearings = main_bearings("tapered-pair")
    >>> force, moment = {"M": [[0.0, -1e6, 3e5], [0.0, -2e6, 3e5]]}, {"M": [[1e6, 0.0]] * 2}
    >>> life = arrangement_lives({"M": bearings["M"]}, force, moment, [1.2, 1.2], weight=[0.9,
    ...     0.1])["M"]
    >>> life.static_safety > 1.0
    True
    """
    turns = np.abs(np.asarray(speed, float)) * np.asarray(weight, float)
    mean = float(turns.sum() / np.broadcast_to(weight, turns.shape).sum())
    found = {}
    for place, bearing in bearings.items():
        if place not in force or place not in moment:
            raise InputError(f"force, moment: no loads of the bearing {place}")
        result = bearing.equilibrium(force[place], moment[place])
        capacity, exponent = bearing.rated_capacity, bearing.life_exponent
        load = result.equivalent_load
        revolutions = float(life.rating_life_spectrum(capacity, load, turns, exponent))
        modified = None
        if lubrication is not None:
            rolls = turns > 0
            work = bearing.life_modification(
                load[rolls], np.broadcast_to(speed, turns.shape)[rolls], lubrication
            )
            # a life longer by a_ISO is that of a lighter load
            lighter = load[rolls] * work.factor ** (-1 / exponent)
            part = life.rating_life_spectrum(capacity, lighter, turns[rolls], exponent)
            modified = float(life.life_hours(part, mean))
        found[place] = BearingLife(
            life=revolutions,
            life_hours=float(life.life_hours(revolutions, mean)),
            static_safety=float(np.min(result.static_safety)),
            maximum_pressure=float(np.max(result.maximum_pressure)),
            modified_life_hours=modified,
        )
    return found
