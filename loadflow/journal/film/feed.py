"""The pressures of grooves and pockets as unknowns: restrictors and pump against the film."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.lubricant import Lubricant
from loadflow.journal.supply import Capillary, ConstantFlow, Orifice, Pump, Restrictor, Supply

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
        parts = [g.restrictor for g in self.supply.grooves]
        return max([0.0, *(r.flow for r in parts if isinstance(r, ConstantFlow))])

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
            if isinstance(groove.restrictor, ConstantFlow):
                missing[row] = scale * (flow[row] / groove.restrictor.flow - 1.0)
                by_pressure[row] = 0.0
                by_flow[row, row] = scale / groove.restrictor.flow
                continue
            drop, rise = pressure_drop(groove.restrictor, float(flow[row]), self.lubricant)
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
        pressure, slope = pump_pressure(pump, flow)
        drop, rise = pressure_drop(pump.line, flow, self.lubricant)
        return pressure - drop, slope - rise

    def power(self, pressure: Array, flow: Array) -> float:
        """Power that lifts the oil from tank to supply pressure, net of what flows back, W.

        Q p of Table 5-23 of [Jonuschies 2015]; `pressure` and `flow` are those of all grooves. A
        constant flow without stated pressure takes that of its groove.
        """
        if self.supply.pump is not None:
            total = float(flow.sum())
            return total * (pump_pressure(self.supply.pump, total)[0] - self.supply.tank_pressure)
        stated = np.array([g.pressure for g in self.supply.grooves])
        before = np.where(stated > 0, stated, pressure)
        return float(flow @ (before - self.supply.tank_pressure))


def pressure_drop(
    restrictor: Restrictor | None, flow: float, lubricant: Lubricant
) -> tuple[float, float]:
    """Pressure that `flow` (m³/s) loses in a restrictor, Pa, and its slope."""
    if isinstance(restrictor, Capillary):
        bore = restrictor
        slope = 128 * lubricant.viscosity * bore.length / (np.pi * bore.diameter**4)
        return slope * flow, slope
    if isinstance(restrictor, Orifice):
        area = restrictor.discharge_coefficient * 0.25 * np.pi * restrictor.diameter**2
        factor = 0.5 * lubricant.density / area**2
        return factor * flow * abs(flow), 2 * factor * abs(flow)
    return 0.0, 0.0


def pump_pressure(pump: Pump, flow: float) -> tuple[float, float]:
    """Pressure of a pump at `flow` (m³/s), Pa, and its slope."""
    if len(pump.flow) == 1:
        return pump.pressure[0], 0.0
    points = np.array(pump.flow)
    part = int(np.clip(np.searchsorted(points, flow) - 1, 0, points.size - 2))
    slope = (pump.pressure[part + 1] - pump.pressure[part]) / (points[part + 1] - points[part])
    return float(pump.pressure[part] + slope * (flow - points[part])), float(slope)
