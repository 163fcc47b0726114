"""The pressures of grooves and pockets as unknowns: restrictors and pump against the film."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.lubricant import Lubricant
from loadflow.journal.supply import Supply

Array = NDArray[np.float64]


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
        missing, by_pressure = np.empty(count), np.ones(count)
        by_flow = np.zeros((count, count))
        source, slope = self._source(float(flow.sum()))
        for row, number in enumerate(self.free):
            groove = self.supply.grooves[number]
            restrictor, drop, rise = groove.restrictor, 0.0, 0.0
            if restrictor is not None:
                given = restrictor.given_flow
                if given is not None:
                    missing[row] = scale * (flow[row] / given - 1.0)
                    by_pressure[row] = 0.0
                    by_flow[row, row] = scale / given
                    continue
                drop, rise = restrictor.pressure_drop(float(flow[row]), self.lubricant)
            before = groove.pressure if source is None else source
            missing[row] = pressure[row] - before + drop
            by_flow[row] = -slope
            by_flow[row, row] += rise
        return missing, by_pressure, by_flow

    def _source(self, flow: float) -> tuple[float | None, float]:
        """Pressure before the restrictors and its slope over all flow; None without a pump."""
        pump = self.supply.pump
        if pump is None:
            return None, 0.0
        pressure, slope = pump.at(flow)
        if pump.line is None:
            return pressure, slope
        drop, rise = pump.line.pressure_drop(flow, self.lubricant)
        return pressure - drop, slope - rise

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
