"""One side of a thrust collar through a series: what its row carries, and how warm it is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.heat import HOTTEST
from loadflow.journal.pad_heat import PadHeat
from loadflow.journal.thrust.row_table import (
    DAMPING,
    FLOW,
    FORCE,
    MOMENT_ACROSS,
    MOST,
    SIDE_FLOW,
    TORQUE,
    RowTable,
)

Array = NDArray[np.float64]

TRIES = 60
"""Temperatures that are tried."""

_SETTLED = 1e-10
"""Last step of a temperature, K."""


class Carried(NamedTuple):
    """What a row does at rest (n,): N, N s/m, N m, m³/s, K, Pa s, N m.

    The moment (n, 2) is that of the collar on its pads, about both axes.
    """

    force: Array
    damping: Array
    torque: Array
    flow: Array
    side_flow: Array
    temperature: Array
    viscosity: Array
    moment: Array


@dataclass(frozen=True)
class Side:
    """One row of pads through a series, and the law of its viscosity."""

    table: RowTable
    speed: Array
    slope: Array
    direction: Array
    viscosity: float
    heat: PadHeat | None = None
    held: float | None = None
    """Temperature, K, of all samples; each has its own without."""

    @property
    def least(self) -> Array:
        """Thinnest gaps on the axis, m."""
        return np.maximum(
            self.table.thinnest, self.slope * self.table.row.outer_radius / MOST * (1 + 1e-12)
        )

    @property
    def wave(self) -> tuple[Array, Array]:
        """Cosine and sine (n,) of the direction of the tilt, over a pitch of its pads."""
        turns = self.table.row.pads * (self.direction - self.table.row.row.centres[0])
        return np.cos(turns), np.sin(turns)

    @property
    def held_viscosity(self) -> float:
        """Viscosity where all samples have one temperature, Pa s."""
        if self.heat is None or self.held is None:
            return self.viscosity
        return float(self.heat.liquid.viscosity(self.held))

    def some(self, places: NDArray[np.int64]) -> Side:
        """Some samples of it."""
        speed, slope, direction = self.speed[places], self.slope[places], self.direction[places]
        return replace(self, speed=speed, slope=slope, direction=direction)

    def at(self, gap: Array, some: NDArray[np.int64] | slice = slice(None)) -> Carried:
        """Films of `some` samples at their gaps, m, the collar without motion."""
        speed = self.speed[some]
        turning = np.maximum(speed, 0.0)  # a wedge that runs backward carries nothing
        sums = self.table.sums(gap, self.slope[some], self.direction[some])
        warm, viscosity = self._warmth(sums, np.abs(speed))
        drag = viscosity * turning
        return Carried(
            drag * sums[FORCE],
            viscosity * sums[DAMPING],
            viscosity * np.abs(speed) * sums[TORQUE],
            np.abs(speed) * sums[FLOW],
            np.abs(speed) * sums[SIDE_FLOW],
            warm,
            viscosity,
            self._moment(drag * sums[MOMENT_ACROSS:], some),
        )

    def _moment(self, moment: Array, some: NDArray[np.int64] | slice) -> Array:
        """Moments (n, 2) about the axes, of those (2, n) about the direction of the tilt."""
        cos, sin = np.cos(self.direction[some]), np.sin(self.direction[some])
        across, along = moment
        return np.column_stack([cos * across - sin * along, sin * across + cos * along])

    def _warmth(self, sums: Array, speed: Array) -> tuple[Array, Array]:
        """Temperature, K, and viscosity of films: T = T_in + k η(T), by Newton from the cold.

        A temperature that is not found in `TRIES` is NaN.
        """
        if self.heat is None:
            return np.full(speed.size, np.nan), np.full(speed.size, self.viscosity)
        oil = self.heat.liquid
        if self.held is not None:
            return np.full(speed.size, self.held), np.full(speed.size, self.held_viscosity)
        rise = self.heat.warming(speed * sums[TORQUE], sums[FLOW])
        rise = rise * (self.heat.carried(sums[FLOW], sums[SIDE_FLOW]) + 0.5)
        warm = np.full(speed.size, self.heat.inlet_temperature)
        for _ in range(TRIES):
            viscosity = oil.viscosity(warm)
            left = self.heat.inlet_temperature + rise * viscosity - warm
            step = left / (1.0 + rise * viscosity * oil.steepness(warm))
            warm = np.minimum(warm + step, HOTTEST)
            settled = (np.abs(step) < _SETTLED) | (warm == HOTTEST)
            if settled.all():
                break
        return np.where(settled, warm, np.nan), np.asarray(oil.viscosity(warm))

    def pressure(self, gap: Array, rest: Carried, carried: Array) -> Array:
        """Largest pressures above that of the edges, Pa, of films that carry so much in motion, N.

        What squeeze adds to them is told of aligned films, as a share of what it adds to the force.
        """
        where = gap, self.slope, self.direction
        each = self.table.pressure(*where) / self.table.sums(*where)[FORCE]
        squeeze = carried - rest.force
        if not squeeze.any():
            return np.asarray(each * rest.force)
        return np.maximum(each * (rest.force + self.table.squeezed(gap) * squeeze), 0.0)

    def minimum_film(self, gap: Array) -> Array:
        """Least films, m."""
        return self.table.minimum_film(gap, self.slope, self.direction)
