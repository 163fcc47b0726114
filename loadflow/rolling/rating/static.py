"""Static equivalent loads of ISO 76 and the verdicts on a main bearing."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

HOURS_20_YEARS = 20 * 365.25 * 24  # L10h of IEC 61400-1
STATIC_RATING = (1.0, 1.5)  # static rating over the extreme load: lowest, and wanted


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


@dataclass(frozen=True)
class Verdict:
    """What must hold, and whether it does.

    Attributes
    ----------
    what : str
        Name of the quantity.
    value, limit : float
        Found, and smallest allowed.
    unit : str
        Of both.
    """

    what: str
    value: float
    limit: float
    unit: str = ""

    @property
    def holds(self) -> bool:
        """Whether the value reaches the limit."""
        return self.value >= self.limit


def verdicts(life_hours: float, static_safety: float) -> Iterator[Verdict]:
    """Yield the verdicts on a main bearing after IEC 61400-1.

    Parameters
    ----------
    life_hours : float
        Rating life L10h (or modified, or of the system) under the lifetime's loads, h.
    static_safety : float
        Smallest ratio of allowed to acting force under the design loads.
    """
    yield Verdict("rating life L10h", life_hours, HOURS_20_YEARS, "h")
    for limit in STATIC_RATING:
        yield Verdict("static rating over load", static_safety, limit)
