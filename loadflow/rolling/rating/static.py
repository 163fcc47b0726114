"""Static capacities of ISO 76 and the verdicts on a main bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import singledispatch
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.rolling.bearings.ball import BallBearing
from loadflow.rolling.bearings.crossed_roller import CrossedRollerBearing
from loadflow.rolling.bearings.four_point import SlewingBearing
from loadflow.rolling.bearings.three_row import ThreeRowRollerBearing
from loadflow.rolling.raceways import BallRaceways
from loadflow.rolling.rating import safety
from loadflow.rolling.roller_raceways import RollerRaceways
from loadflow.verdict import Verdict

Array = NDArray[np.float64]

HOURS_20_YEARS = 20 * 365.25 * 24  # L10h of IEC 61400-1
LIFE_SOURCE = "IEC 61400-1 as quoted by [Jonuschies 2015], (1.10): 20 years"
STATIC_RATING = 1.0  # static rating over the design load
STATIC_SOURCE = "IEC 61400-1 as quoted by [Jonuschies 2015], (1.11)"


@singledispatch
def static_capacity(bearing: Any) -> float:
    """Basic static capacity C₀ of ISO 76, N: radial, or axial of slewing rings.

    Balls from Hertz's pressure at the harder loaded raceway with Stribeck's 5; rollers by the
    closed formulas of the standard.

    Raises
    ------
    InputError
        If the kind of bearing is not known.
    """
    raise InputError(f"bearing: no static capacity of a {type(bearing).__name__}")


@static_capacity.register
def _(bearing: BallBearing) -> float:
    radial = allowed_force(bearing) * bearing.rows * bearing.balls / 5
    return radial * math.cos(bearing.contact_angle)


@static_capacity.register
def _(bearing: SlewingBearing) -> float:
    return allowed_force(bearing) * bearing.rows * bearing.balls * math.sin(bearing.contact_angle)


@static_capacity.register
def _(bearing: RollerRaceways) -> float:
    return 44e6 * _roller_area(bearing) * math.cos(bearing.contact_angle) * bearing.rows


@static_capacity.register
def _(bearing: CrossedRollerBearing) -> float:
    return 220e6 * _roller_area(bearing) / 2 * math.sin(bearing.contact_angle)


@static_capacity.register
def _(bearing: ThreeRowRollerBearing) -> float:
    return 220e6 * _roller_area(bearing.rows[0])


def _roller_area(bearing: RollerRaceways) -> float:
    """(1 - γ) Z L D, m²."""
    area = bearing.rollers * bearing.roller_length * bearing.roller_diameter
    return (1 - bearing.gamma) * area


def allowed_force(bearing: BallRaceways) -> float:
    """Force on a ball at the allowed pressure of the harder loaded raceway, N, (4.3)."""
    unit = max(float(bearing.raceway_contact(side, 1.0).pressure) for side in ("inner", "outer"))
    allowed = bearing.allowable_pressure * safety.hardness_factor(bearing.hardness)
    return (allowed / unit) ** 3


def static_load_slewing(
    radial: ArrayLike, axial: ArrayLike, moment: ArrayLike, bearing: SlewingBearing
) -> Array:
    """Static equivalent axial load P₀ = F_a + 2.3 F_r tan α + 4 M/D_pw of a slewing bearing, N.

    ISO 76 for thrust ball bearings, with the usual term of the moment, which the standard lacks.
    The safety of a real distribution is that of the result (`static_safety`).
    """
    tan = math.tan(bearing.contact_angle)
    tilt = 4 * np.abs(moment) / bearing.pitch_diameter
    return np.asarray(np.abs(axial) + 2.3 * np.abs(radial) * tan + tilt)


def static_load(radial: ArrayLike, axial: ArrayLike, x0: float, y0: float) -> Array:
    """Static equivalent load P₀ = X₀ F_r + Y₀ F_a, at least F_r, N, (2.7)."""
    r, a = np.abs(radial), np.abs(axial)
    return np.asarray(np.maximum(x0 * r + y0 * a, r))


def verdicts(
    life_hours: float,
    static_safety: float,
    *,
    subject: str = "rolling bearing",
    life_limit: float = HOURS_20_YEARS,
    static_limit: float = STATIC_RATING,
) -> Iterator[Verdict]:
    """Yield the verdicts on a main bearing after IEC 61400-1: its life, its static safety.

    Parameters
    ----------
    life_hours : float
        Rating life L10h (or modified, or of the system) under the lifetime's loads, h.
    static_safety : float
        Smallest ratio of allowed to acting force under the design loads, which have the partial
        safety factor for loads in them.
    subject : str
        Name of the bearing.
    life_limit, static_limit : float
        Smallest of both allowed.
    """
    yield Verdict(
        subject,
        "rating life L10h",
        life_hours,
        life_limit,
        "at least",
        "h",
        LIFE_SOURCE if life_limit == HOURS_20_YEARS else "stated",
    )
    yield Verdict(
        subject,
        "static rating over the design load",
        static_safety,
        static_limit,
        "at least",
        source=STATIC_SOURCE if static_limit == STATIC_RATING else "stated",
    )
