"""Static equivalent loads of ISO 76 and the verdicts on a main bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.rolling.contacts import row_sides
from loadflow.verdict import Verdict

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry

Array = NDArray[np.float64]

HOURS_20_YEARS = 20 * 365.25 * 24  # L10h of IEC 61400-1
LIFE_SOURCE = "IEC 61400-1 as quoted by [Jonuschies 2015], (1.10): 20 years"
STATIC_RATING = 1.0  # static rating over the design load
_BALLS = (5, 10, 15, 20, 25, 30, 35, 40, 45), (0.52, 0.5, 0.46, 0.42, 0.38, 0.33, 0.29, 0.26, 0.22)
"""Contact angle of a row of balls, °, and its Y₀ (ISO 76)."""
STATIC_SOURCE = "IEC 61400-1 as quoted by [Jonuschies 2015], (1.11)"


def static_load_slewing(
    radial: ArrayLike,
    axial: ArrayLike,
    moment: ArrayLike,
    *,
    contact_angle: float,
    pitch_diameter: float,
) -> Array:
    """Static equivalent axial load P₀ = F_a + 2.3 F_r tan α + 4 M/D_pw of a slewing bearing, N.

    ISO 76 for thrust ball bearings, with the usual term of the moment, which the standard lacks.
    The safety of a real distribution is that of the result (`static_safety`).
    """
    tan = math.tan(contact_angle)
    tilt = 4 * np.abs(moment) / pitch_diameter
    return np.asarray(np.abs(axial) + 2.3 * np.abs(radial) * tan + tilt)


def static_load(radial: ArrayLike, axial: ArrayLike, x0: float, y0: float) -> Array:
    """Static equivalent load P₀ = X₀ F_r + Y₀ F_a, at least F_r, N, (2.7)."""
    r, a = np.abs(radial), np.abs(axial)
    return np.asarray(np.maximum(x0 * r + y0 * a, r))


def static_overload(
    bearing: RollingGeometry, radial: ArrayLike, axial: ArrayLike, moment: ArrayLike
) -> Array:
    """Static equivalent load over the static capacity of a bearing: above 1 it is overloaded.

    With the factors X₀ and Y₀ of ISO 76: of radial bearings P₀ = F_r at least; of slewing bearings
    as `static_load_slewing`, those of three rows by their thrust rows. Of more than two facing rows
    those of two. Which row or roller carries most is left to `RollingEquilibrium.static_safety`.

    Parameters
    ----------
    bearing : RollingGeometry
        Of any kind.
    radial, axial : array_like
        Forces, N.
    moment : array_like
        Tilting moment, N m.

    Examples
    --------
    >>> from loadflow.rolling import RollerBearing
    >>> bearing = RollerBearing(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
    ...     pitch_diameter=60.5e-3)
    >>> float(static_overload(bearing, 2 * bearing.static_capacity, 0.0, 0.0))
    2.0
    """
    if bearing.rated_axially:
        lean = 0.0 if bearing.kind == "three-row" else bearing.nominal_angle  # its thrust rows
        size = bearing.pitch_diameter
        load = static_load_slewing(radial, axial, moment, contact_angle=lean, pitch_diameter=size)
    else:
        load = static_load(radial, axial, *_radial_factors(bearing))
    return np.asarray(load / bearing.static_capacity)


def _radial_factors(bearing: RollingGeometry) -> tuple[float, float]:
    """X₀ and Y₀ of a radial bearing, ISO 76.

    It has 0.5 and Y₀ of one row, also of rows in tandem, and 1 and twice that Y₀ of two that face.
    More facing rows have them here by how many of their rows carry a thrust.
    """
    angle, rows = bearing.nominal_angle, getattr(bearing, "rows", 1)
    if angle == 0.0:
        return (0.6, 0.5) if bearing.kind == "ball" else (1.0, 0.0)
    sides = row_sides(rows, getattr(bearing, "arrangement", "back-to-back"))
    alike = min(sides.count(1.0), sides.count(-1.0))  # rows that carry a thrust; 0: all do
    share = rows / alike if alike else 1.0
    ball = bearing.kind == "ball"
    y0 = float(np.interp(math.degrees(angle), *_BALLS)) if ball else 0.22 / math.tan(angle)
    return (1.0 if alike else 0.5), y0 * share


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

    Yields
    ------
    Verdict
        Value, limit, and whether it holds.

    Examples
    --------
    >>> from loadflow.rolling.rating.static import verdicts
    >>> [verdict.answer for verdict in verdicts(life_hours=2e5, static_safety=0.9)]
    ['holds', 'broken']
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
