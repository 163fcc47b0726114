"""The pressures of grooves and pockets as unknowns: restrictors and pump against the film."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.lubricant import Lubricant
from loadflow.journal.supply import Supply, at_pump

Array = NDArray[np.float64]


class FeedTable(NamedTuple):
    """What feeds the m free grooves, as numbers.

    Attributes
    ----------
    drops : array (m, 2)
        Pressure that their restrictors lose over the flow, Pa s/m³, and over its square, Pa s²/m⁶.
    given : array (m,)
        Flow that is kept, m³/s; 0: none is.
    source : array (m,)
        Pressure before the restrictors, Pa, where there is no pump.
    flows, pressures : array (n,)
        Curve of the pump, m³/s and Pa; n = 0: there is none.
    line : array (2,)
        As `drops`, of the line behind it.
    """

    drops: Array
    given: Array
    source: Array
    flows: Array
    pressures: Array
    line: Array


def mismatch_of(
    table: Any,
    curve: Any,
    pressure: Array,
    flow: Array,
    scale: float,
    missing: Array,
    by_pressure: Array,
    by_flow: Array,
) -> None:
    """Fill what `Feed.mismatch` returns; compiled, too.

    `table` is a `FeedTable`, `curve` is `at_pump`.
    """
    count, total, source, slope = table.given.size, 0.0, 0.0, 0.0
    for row in range(count):
        total += flow[row]
    if table.flows.size > 0:
        source, slope = curve(table.flows, table.pressures, total)
        linear, quadratic = table.line[0], table.line[1] * abs(total)
        source -= (linear + quadratic) * total
        slope -= linear + 2.0 * quadratic
    for row in range(count):
        for other in range(count):
            by_flow[row, other] = 0.0
        if table.given[row] > 0.0:
            missing[row] = scale * (flow[row] / table.given[row] - 1.0)
            by_pressure[row] = 0.0
            by_flow[row, row] = scale / table.given[row]
            continue
        linear, quadratic = table.drops[row, 0], table.drops[row, 1] * abs(flow[row])
        before = source if table.flows.size > 0 else table.source[row]
        missing[row] = pressure[row] - before + (linear + quadratic) * flow[row]
        by_pressure[row] = 1.0
        for other in range(count):
            by_flow[row, other] = -slope
        by_flow[row, row] += linear + 2.0 * quadratic


@dataclass(frozen=True, eq=False)
class Feed:
    """What joins flow and pressure of the grooves whose pressure is not given.

    Attributes
    ----------
    supply : Supply
        Grooves and pump.
    lubricant : Lubricant
        Liquid in the restrictors.
    """

    supply: Supply
    lubricant: Lubricant

    @property
    def free(self) -> NDArray[np.int64]:
        """Numbers of the grooves whose pressure is unknown."""
        pumped = self.supply.pump is not None
        grooves = enumerate(self.supply.grooves)
        return np.array([i for i, g in grooves if pumped or g.restrictor is not None], dtype=int)

    @property
    def largest_pressure(self) -> float:
        """Largest pressure that the supply states, Pa."""
        pump = self.supply.pump
        stated = [g.pressure for g in self.supply.grooves]
        return max([0.0, *stated, *(pump.pressure if pump else ())])

    @property
    def largest_flow(self) -> float:
        """Largest of the constant flows, m³/s."""
        flows = (g.restrictor.given_flow for g in self.supply.grooves if g.restrictor is not None)
        return max([0.0, *(flow for flow in flows if flow is not None)])

    def guess(self, edge_pressure: float) -> list[float]:
        """Pressure of every groove, Pa: as given, or halfway to its source."""
        pump = self.supply.pump
        values = []
        for groove in self.supply.grooves:
            source = pump.pressure[0] if pump else groove.pressure
            if pump is None and groove.restrictor is None:
                values.append(source)
            else:
                values.append(edge_pressure + 0.5 * max(source - edge_pressure, 0.0))
        return values

    def mismatch(self, pressure: Array, flow: Array, scale: float) -> tuple[Array, Array, Array]:
        """What is missing between the free grooves and what feeds them, Pa.

        Parameters
        ----------
        pressure, flow : array (m,)
            Pressure of the free grooves, Pa, and their flow into the film, m³/s.
        scale : float
            Pressure that stands for the whole of a constant flow, Pa.

        Returns
        -------
        mismatch : array (m,)
            Zero where pressure and flow agree.
        by_pressure : array (m,)
            Its derivative by the pressure of the same groove.
        by_flow : array (m, m)
            Its derivative by all flows.
        """
        count = flow.size
        missing, by_pressure, by_flow = np.empty(count), np.empty(count), np.empty((count, count))
        mismatch_of(self.table, at_pump, pressure, flow, scale, missing, by_pressure, by_flow)
        return missing, by_pressure, by_flow

    @cached_property
    def table(self) -> FeedTable:
        """What feeds the free grooves, as numbers."""
        grooves = [self.supply.grooves[number] for number in self.free]
        parts = [groove.restrictor for groove in grooves]
        drops = [(0.0, 0.0) if one is None else one.drops(self.lubricant) for one in parts]
        pump = self.supply.pump
        line = None if pump is None else pump.line
        return FeedTable(
            drops=np.array(drops, dtype=float).reshape(-1, 2),
            given=np.array([(0.0 if one is None else one.given_flow) or 0.0 for one in parts]),
            source=np.array([groove.pressure for groove in grooves], dtype=float),
            flows=np.array(() if pump is None else pump.flow, dtype=float),
            pressures=np.array(() if pump is None else pump.pressure, dtype=float),
            line=np.array((0.0, 0.0) if line is None else line.drops(self.lubricant)),
        )

    def power(self, pressure: Array, flow: Array) -> float:
        """Power that lifts the oil from tank to supply pressure, net of what flows back, W.

        Q p of Table 5-23 of [Jonuschies 2015]; `pressure` and `flow` are those of all grooves. A
        constant flow without stated pressure takes that of its groove.
        """
        if self.supply.pump is not None:
            total = float(flow.sum())
            return total * (self.supply.pump.at(total)[0] - self.supply.tank_pressure)
        stated = np.array([g.pressure for g in self.supply.grooves])
        before = np.where(stated > 0, stated, pressure)
        return float(flow @ (before - self.supply.tank_pressure))
