"""Temperatures across a film: those of its surfaces beside its mean, on a parabola.

Where heat passes into shell and shaft the film is cooler there. With the mean T, gap h and
conductivity k a parabola through the surfaces has the fluxes ``k (6 T − 4 T_shell − 2 T_shaft)/h``
into the shell and ``k (6 T − 2 T_shell − 4 T_shaft)/h`` into the shaft, which pass on to what cools
them. Exact for even dissipation. The viscosity is taken at both surfaces and midway, by the rule of
Simpson, which Lobatto's with three points is (Elrod, NASA CR-185136).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap_warm import AcrossFilm
from loadflow.journal.heat import FilmHeat

Array = NDArray[np.float64]


class Surface(NamedTuple):
    """Temperature of a surface: ``given + mean T + shaft T_J``, of the film and of the shaft."""

    given: Array
    mean: Array
    shaft: Array

    def at(self, mean: Array, shaft: float) -> Array:
        """Temperature where the film has `mean`, and the shaft, K."""
        return np.asarray(self.given + self.mean * mean + self.shaft * shaft)


@dataclass(frozen=True)
class Surfaces:
    """Surfaces of the shell and of the shaft at the cells of a film."""

    shell: Surface
    shaft: Surface

    @property
    def carried(self) -> Surface:
        """Mean temperature of what the shaft drags along: faster oil counts for more."""
        given, mean, shaft = (b - a for a, b in zip(self.shell, self.shaft))
        return Surface(given / 6, 1 + mean / 6, shaft / 6)

    @classmethod
    def of(cls, heat: FilmHeat, gap: Array) -> Surfaces:
        """Surfaces of a film whose cells have a `gap`, m; as warm as the film with one point."""
        none, all_ = np.zeros_like(gap), np.ones_like(gap)
        if heat.points == 1:
            return cls(Surface(none, all_, none), Surface(none, all_, none))
        conducts = float(heat.liquid.conductivity(heat.inlet_temperature)) / gap
        out, into = heat.shell_transfer, heat.shaft_transfer
        first, second = 4 * conducts + out, 4 * conducts + into
        det = first * second - 4 * conducts**2
        warm = out * heat.shell_temperature
        shell = (second * warm, 6 * conducts * (second - 2 * conducts), -2 * conducts * into)
        shaft = (-2 * conducts * warm, 6 * conducts * (first - 2 * conducts), first * into)
        return cls(
            Surface(*(part / det for part in shell)), Surface(*(part / det for part in shaft))
        )

    def viscosity(
        self, heat: FilmHeat, reference: float, mean: Array, shaft: float
    ) -> tuple[AcrossFilm, Array]:
        """Viscosity over `reference` of cells at `mean`, K; its change under shear by that, 1/K."""
        low, high = self.shell.at(mean, shaft), self.shaft.at(mean, shaft)
        middle = 0.25 * (6 * mean - low - high)
        by = self.shell.mean, 0.25 * (6 - self.shell.mean - self.shaft.mean), self.shaft.mean
        oil, fluid, slopes = heat.liquid, [], []
        for temperature, change in zip((low, middle, high), by):
            viscosity = oil.viscosity(temperature)
            fluid.append(reference / viscosity)
            slope = np.asarray(oil.viscosity_slopes(temperature)[0])
            slopes.append(-fluid[-1] * slope / viscosity * change)
        total = fluid[0] + 4 * fluid[1] + fluid[2]
        centre = (2 * fluid[1] + fluid[2]) / total
        parts = (centre**2 * fluid[0], 4 * (0.5 - centre) ** 2 * fluid[1])
        flows = 2 * (parts[0] + parts[1] + (1 - centre) ** 2 * fluid[2])
        shear = 6 / total
        slope = -shear * (slopes[0] + 4 * slopes[1] + slopes[2]) / total
        return AcrossFilm(shear, 1 / flows, 2 * (1 - centre)), slope
