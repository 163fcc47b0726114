"""How far cells around and points across may leave a reduced film from that of ever more of them.

The rule is that of `loadflow.journal.film.cell_error`: around, the pressure bends within a cell by
its second differences, as on the grid. Across, it is a polynomial, and what the next ones would add
is no more than the highest of those that are there.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.cell_error import (
    LOAD_SHARE,
    Left,
    drawn_share,
    facing_slopes,
    peak_share,
)
from loadflow.journal.models.ring import Ring
from loadflow.journal.models.width_modes import Nodes

Array = NDArray[np.float64]

_TOGETHER = 256  # films that are judged at once: one by one, that costs more than to solve them


class Judged:
    """Films on the same cells and points, as they are solved one after another.

    Attributes
    ----------
    facing : array (n, 4)
        How the narrowest gap of each closes with place and tilt.
    narrow : array (n,)
        That gap, clearances.
    opens : array (n,)
        As `Balance.opens`.
    """

    def __init__(self, ring: Ring, nodes: Nodes, fed: bool, count: int) -> None:
        self.ring, self.nodes, self.fed = ring, nodes, fed
        self.facing, self.narrow, self.opens = np.zeros((count, 4)), np.zeros(count), np.ones(count)
        self._grooves = np.where(ring.back == 0.0, np.inf, 0.0)[:, None]
        self._left = np.full((3, count), np.nan)
        self._waiting: list[tuple[int, Array]] = []
        self._drawing: list[tuple[Array, Array, float]] = []

    def add(
        self,
        n: int,
        pressure: Array,
        gap: Array,
        opens: float = 1.0,
        fill: Array | None = None,
        speed: float = 0.0,
    ) -> None:
        """Take film number `n`: pressure (nx, m), Pa, gap (nx, l), clearances.

        `fill` (nx, m) is that of a law by which it changes all over, at a `speed`, rad/s.
        """
        gaps = gap + self._grooves
        i, k = divmod(int(gaps.argmin()), gaps.shape[1])
        ring, self.narrow[n], self.opens[n] = self.ring, gaps[i, k], opens
        self.facing[n] = facing_slopes(ring.cos[i], ring.sin[i], self.nodes.z[k])
        self._waiting.append((n, pressure.copy()))
        if fill is not None:
            self._drawing.append((fill.copy(), gap[:, : fill.shape[1]].copy(), speed))
        if len(self._waiting) == _TOGETHER:
            self._judge()

    def left(self) -> Left:
        """What cells and points leave out of each film; NaN of those that were not solved."""
        self._judge()
        return Left(*self._left)

    def _judge(self) -> None:
        """Judge the films that are waiting."""
        if not self._waiting:
            return
        numbers, films = zip(*self._waiting)
        pressure, drawing = np.array(films), self._drawing
        self._waiting, self._drawing = [], []
        drawn = self._drawn(pressure, *zip(*drawing)) if drawing else np.zeros(1)
        self._left[:, list(numbers)] = self._left_of(pressure, drawn)

    def _drawn(
        self, pressure: Array, fills: Sequence[Array], gaps: Sequence[Array], speed: Sequence[float]
    ) -> Array:
        """What cells leave out as their oil is taken from upstream (n, nx, m), Pa."""
        ring, fill, gap = self.ring, np.array(fills), np.array(gaps)
        wedge, over = 0.25 * ring.slope * np.abs(speed), min(float(self.nodes.z.max()), 1.0)
        faces = np.abs(np.roll(fill, -1, axis=1) - fill) * ring.apart[:, None]
        faces = faces / (gap * np.roll(gap, -1, axis=1)) * (0.5 * wedge)[:, None, None]
        each = (faces + np.roll(faces, 1, axis=1)) * (over / ring.width[:, None])
        return drawn_share(each, pressure - ring.p_edge)

    def _left_of(self, pressure: Array, drawn: Array) -> Left:
        """What is left out of films of a pressure (n, nx, m), Pa, beside what is `drawn`."""
        ring, count = self.ring, len(pressure)
        above = pressure - ring.p_edge
        before, after = np.roll(pressure, 1, axis=1), np.roll(pressure, -1, axis=1)
        for beside, held in ((before, np.roll(ring.groove, 1)), (after, np.roll(ring.groove, -1))):
            beside[:, held] = 2.0 * beside[:, held] - pressure[:, held]  # it ends half a cell away
        around = np.abs(before + after - 2.0 * pressure) + drawn
        across = np.abs(above @ self.nodes.highest.T).sum(axis=-1)
        around[:, ring.groove], across[:, ring.groove] = 0.0, 0.0
        own = self.nodes.weights[: pressure.shape[-1]]
        bent = (around @ own + across * own.sum()) @ ring.width
        whole = np.abs(above) @ own @ ring.width
        share = np.where(whole > 0.0, bent / np.where(whole > 0.0, whole, 1.0), 0.0)
        each, rows = np.arange(count), pressure.shape[1]
        highest = pressure.reshape(count, -1).argmax(axis=1)
        row, column = np.divmod(highest, pressure.shape[-1])
        near = (row[:, None] + [-1, 0, 1]) % rows
        beside_it = around[each[:, None], near, column[:, None]].max(axis=1)
        beside_it += across[each[:, None], near].max(axis=1)
        peak = np.maximum(pressure[each, row, column], 1e-300)
        return Left(
            share, LOAD_SHARE * ring.area * bent, peak_share(share, beside_it / peak, self.fed)
        )
