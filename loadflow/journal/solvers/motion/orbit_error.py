"""How far the cells may leave the narrowest film and the largest pressure of a path."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any, cast

from loadflow.journal.film.cell_error import relative_errors
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.gap import BoreGap
from loadflow.journal.grid_bounds import BOUNDED, UNRESOLVED
from loadflow.journal.solvers.newton import Solution

_PATH = 4.0  # how much farther a path may be led than a shaft at rest, in 96 % of draws
_FILM, _PEAK = BOUNDED.index("minimum_film"), BOUNDED.index("maximum_pressure")


@dataclass
class Extremes:
    """The two states of a path that matter, kept while it is marched along: as told by `see`.

    What the cells leave out moves a shaft at rest by the stiffness of the film. A path sums it up,
    as it swings the more the nearer its load turns at half the speed of the shaft; the share that
    it is given for that is calibrated on draws (``benchmarks/robustness/grid_bounds.py``).
    """

    film: DiscreteFilm
    least: float = math.inf
    peak: float = -math.inf
    _narrow: tuple[Solution, float] | None = field(default=None, repr=False)
    _high: tuple[Solution, float] | None = field(default=None, repr=False)

    def see(self, row: dict[str, Any], solution: Solution) -> None:
        """Take notice of one time, its `row` and its state at the speed that is set."""
        here = solution, self.film.speed
        if row["minimum_film"] < self.least:
            self.least, self._narrow = row["minimum_film"], here
        if row["maximum_pressure"] > self.peak:
            self.peak, self._high = row["maximum_pressure"], here

    def bounds(self) -> dict[str, float]:
        """Bounds of the errors of the narrowest film, m, and the largest pressure, Pa, by name."""
        narrow, high = _PATH * self._at(self._narrow, _FILM), self._at(self._high, _PEAK)
        return {
            "minimum_film_grid_error": narrow * self.least,
            "maximum_pressure_grid_error": high * self.peak,
            "resolved": int(narrow < UNRESOLVED),
        }

    def _at(self, state: tuple[Solution, float] | None, which: int) -> float:
        """Relative bound of a quantity at a state."""
        if state is None:
            return math.inf
        solution, speed = state
        film = self.film
        film.set_speed(speed)
        film.place(solution.u, solution.position)
        where = film, cast("BoreGap", film.gap), solution.position
        linear = solution.linear
        return float(relative_errors(*where, linear.stiffness, solution.free, linear.load)[which])
