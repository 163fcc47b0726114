"""Grooves and pockets of the discrete film: what flows out of them, and their unknown pressures."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.feed import Feed
from loadflow.journal.film.linearised import SingularFilm

Array = NDArray[np.float64]

UNSUPPLIED = {
    "supply_flow": 0.0,
    "supply_power": 0.0,
    "groove_flow": np.zeros(0),
    "groove_pressure": np.zeros(0),
    "starved": False,
}  # what `Equilibrium` says of the supply of a film that has none


@dataclass(frozen=True, eq=False)
class Pockets:
    """Cells of the grooves and what feeds them.

    Attributes
    ----------
    numbers : array of int (nx, nz)
        Number of the groove in which each cell lies, −1 for none.
    feed : Feed
        What gives the grooves their pressure.
    flow_unit : float
        Of the outflow of a cell, m³/s, full width.
    """

    numbers: NDArray[np.int64]
    feed: Feed
    flow_unit: float

    @cached_property
    def fixed(self) -> NDArray[np.bool_]:
        """Cells that share the pressure of a groove, (nx, nz)."""
        return self.numbers >= 0

    @cached_property
    def free(self) -> NDArray[np.int64]:
        """Numbers of the grooves whose pressure is unknown."""
        return self.feed.free

    @cached_property
    def free_cells(self) -> NDArray[np.bool_]:
        """Their cells, (nx, nz)."""
        return np.isin(self.numbers, self.free)

    @property
    def count(self) -> int:
        """Number of grooves."""
        return len(self.feed.supply.grooves)

    def lifts(self, edge_pressure: float) -> bool:
        """Whether the supply may carry a load without rotation: it differs from the ends."""
        return any(p != edge_pressure for p in self.feed.guess(edge_pressure)) or self.free.size > 0

    @cached_property
    def samples(self) -> NDArray[np.int64]:
        """Place of one cell of every groove in a flattened field."""
        places = [np.flatnonzero(self.numbers.ravel() == j)[0] for j in range(self.count)]
        return np.array(places, dtype=int)

    def given(self, edge_pressure: float) -> Array:
        """Pressure to start from: that of the grooves in their cells, else that of the ends."""
        pressure = np.full(self.numbers.shape, edge_pressure)
        for number, value in enumerate(self.feed.guess(edge_pressure)):
            pressure[self.numbers == number] = value
        return pressure

    def flows(self, outflow: Array) -> Array:
        """Flow of every groove into the film, m³/s, from the `outflow` of its cells (nx, nz)."""
        sums = np.bincount(self.numbers.ravel() + 1, outflow.ravel(), self.count + 1)
        return np.asarray(self.flow_unit * sums[1:], dtype=np.float64)

    def missing(self, pressure: Array, outflow: Array, scale: float) -> float:
        """Largest mismatch of a free groove and its feed, over the `scale` of pressure."""
        flow = self.flows(outflow)[self.free]
        mismatch, _, _ = self.feed.mismatch(self.of_free(pressure), flow, scale)
        return float(np.abs(mismatch).max()) / scale

    def of_free(self, field: Array) -> Array:
        """Values of a `field` (nx, nz) in the free grooves."""
        return field.ravel()[self.samples[self.free]]

    def eliminate(
        self,
        columns: Array,
        direct: Array,
        through: Array,
        pressure: Array,
        slope: Array,
        scale: float,
    ) -> Array:
        """Eliminate the unknown pressures from a linearised film.

        Parameters
        ----------
        columns : array (a + m, n)
            Newton step of the unknowns and derivatives with the grooves held, then the answer of
            the film to each of the m free grooves.
        direct : array (a, m)
            Flow of the free grooves, m³/s, then its derivatives at unchanged unknowns.
        through : array (a + m, m)
            Change of these flows by the change `columns` of the unknowns.
        pressure, slope : array (m,)
            Pressure of the free grooves and its derivative by their unknown.
        scale : float
            Of pressure, Pa.

        Returns
        -------
        array (a, n)
            The first columns with pressure and flow of the grooves in step.

        Raises
        ------
        SingularFilm
            What flows is not finite.
        """
        held, answer = columns[: -self.free.size], columns[-self.free.size :]
        flow = direct - through[: held.shape[0]]
        # restrictors are linearised at the flow that the step of the film leaves, not at that of a
        # film which has not yet converged round a groove
        mismatch, by_pressure, by_flow = self.feed.mismatch(pressure, flow[0], scale)
        matrix = np.diag(by_pressure * slope) + by_flow @ through[held.shape[0] :].T
        change = np.concatenate([[mismatch], flow[1:] @ by_flow.T])
        if not math.isfinite(float(matrix.sum() + change.sum())):
            raise SingularFilm("flow of the grooves is not finite: the iteration diverges")
        # least squares: an empty groove of a shaft that does not turn has no slope
        pressures = np.linalg.lstsq(matrix, change.T)[0]
        return held + pressures.T @ answer
