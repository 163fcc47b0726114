"""Turbulent flow in the film as an effect, `Film.turbulence`: where it begins, and what it changes.

The linearised theory of [Ng and Pan 1965] keeps the equation of the film. Flow by pressure is that
of a viscosity k/12 times as large, and shear by the sliding surface C_f times as large:

    k_x = 12 + 0.0136 Re^0.90,    k_z = 12 + 0.0043 Re^0.96,    C_f = 1 + 0.0012 Re^0.94

with Re = ρ ω R h/η of the local gap h, x along the motion, z across it; the fits are those of
[Constantinescu 1973]. What the surface drags along stays U h/2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from annotated_types import Ge
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.film.gap import _turbulence_kernels as kernel
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.validity import critical_reynolds_number
from loadflow.numerics.fields import check_fields, require

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Turbulence:
    """Turbulent flow where the Reynolds number of the local gap is beyond that of Taylor vortices.

    The flow is laminar up to ``begin`` times the local critical number, Re_cr = 41.3 √(R/h)
    [Taylor 1923], and turbulent from ``end`` times it on; between, the factors pass over in a
    smooth step, 3 t² − 2 t³ of what the flow is beyond ``begin``. In gaps of the clearance that
    is (3.14) of [Jonuschies 2015].

    Attributes
    ----------
    begin, end : float
        Reynolds number over its critical value where turbulence begins, and where it is full. Both
        0: turbulent factors everywhere, as the fits stand.

    Raises
    ------
    loadflow.errors.InputError
        A negative value, or an end before the beginning.

    Examples
    --------
    >>> from loadflow.journal import Film, JournalBearing, Lubricant, Turbulence
    >>> water = Lubricant(viscosity=1e-3, density=1000.0)
    >>> bearing = JournalBearing(diameter=0.5, width=0.5, relative_clearance=1e-3)
    >>> laminar = Film(water, rung="reduced", inlet=None, grid=(60, 20))
    >>> turbulent = Film(water, rung="reduced", inlet=None, grid=(60, 20), turbulence=Turbulence())
    >>> factors = turbulent.turbulence.factors(bearing, 100.0, water, [0.1, 1.0])
    >>> [round(float(row[1]), 1) for row in factors]  # k_x/12, k_z/12 and C_f of a gap of c
    [4.0, 2.6, 5.4]
    >>> states = [bearing.equilibrium((2e4, 0.0), 100.0, f) for f in (laminar, turbulent)]
    >>> bool(states[1].minimum_film > states[0].minimum_film)
    True
    """

    begin: Annotated[float, Ge(0)] = 1.0
    end: Annotated[float, Ge(0)] = 2.0

    def __post_init__(self) -> None:
        check_fields(self)
        require(self.end >= self.begin, "end", self.end, f"≥ begin = {self.begin}")

    def regime(self, radius: float, relative_clearance: float, lubricant: Lubricant) -> Regime:
        """Reynolds numbers of a film on a shaft of `radius`, m, and with a relative clearance ψ."""
        number = lubricant.density * relative_clearance * radius**2 / lubricant.viscosity
        return Regime(self, number, number / critical_reynolds_number(relative_clearance))

    def factors(
        self, bearing: JournalGeometry, speed: float, lubricant: Lubricant, gap: ArrayLike
    ) -> tuple[Array, Array, Array]:
        """Factors k_x/12, k_z/12 and C_f.

        Parameters
        ----------
        bearing : JournalBearing
            Whose radius and clearance count.
        speed : float
            rad/s.
        lubricant : Lubricant
            Viscosity and density.
        gap : array_like (…)
            Film over the clearance.
        """
        lengths = bearing.radius, bearing.relative_clearance
        numbers = self.regime(*lengths, lubricant).at(speed)
        gaps = np.asarray(gap, dtype=float)
        rows = [
            [kernel.factor(h, numbers, which)[0] for h in gaps.ravel().tolist()]
            for which in (kernel.ALONG, kernel.ACROSS, kernel.SHEAR)
        ]
        along, across, shear = (np.reshape(row, gaps.shape) for row in rows)
        return along, across, shear


@dataclass(frozen=True)
class Regime:
    """Reynolds numbers of a film whose gap is the clearance.

    Attributes
    ----------
    turbulence : Turbulence
        Where it begins and ends.
    reynolds, onset : float
        Reynolds number, and over its critical value, at 1 rad/s; s.
    """

    turbulence: Turbulence
    reynolds: float
    onset: float

    def at(self, speed: float, lighter: float = 1.0) -> RegimeNumbers:
        """Numbers for the kernels at a speed, rad/s; `lighter`: 1/ν over that of the film."""
        size = abs(speed) * lighter
        return size * self.reynolds, size * self.onset, self.turbulence.begin, self.turbulence.end


RegimeNumbers = tuple[float, float, float, float]
"""Turbulence as the kernels take it: Reynolds number of a gap of the clearance, the same over its
critical value, and the multiples of that at which turbulence begins and is full."""
