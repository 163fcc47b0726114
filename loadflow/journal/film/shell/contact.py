"""Asperities on a shell that gives way around what is pressed: a housing, a thick cylinder.

Film and asperities press the shell together. For a pressure of the film and a place of the shaft
the growth of the gap W is that of all that presses it, ``W = C (p + p_a(W))``, found by Newton's
method; only the cells that touch are unknowns of its linear systems. To the film it is then a shell
that gives way by less, ``(1 − C ∂p_a/∂W)⁻¹ C``, and whose gap follows the shaft where they touch.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.contact import Contact
from loadflow.journal.film.gap.asperity_load import Touch, YieldingNodeLoad
from loadflow.journal.film.gap.rough import RoughElasticGap
from loadflow.journal.film.shell import _contact_kernels as kernel
from loadflow.journal.film.shell.compliance import Compliance
from loadflow.journal.film.shell.elastic_film import ElasticFilm

Array = NDArray[np.float64]

_STEPS, _HALVINGS = 30, 8
_LARGEST = 300.0  # growth by the film alone, clearances: an iteration that has lost its way
_EXACT = 1e-13  # of growth and roughness, what is left of the balance of a shell
_OF_CELLS = 2.5  # work of one of these steps over the cells, as that of films is counted
_ENOUGH = 1e-9  # the same, beyond which there is no growth that fits


class ShellContact(YieldingNodeLoad):
    """Asperities on the cells of a shell of any `compliance`; other parameters as for the base."""

    def __init__(
        self,
        contact: Contact,
        gap: RoughElasticGap,
        radius: float,
        mirrors: float,
        grooves: NDArray[np.bool_],
        compliance: Compliance,
    ) -> None:
        super().__init__(contact, gap, radius, mirrors, grooves)
        mesh = gap.mesh
        self._compliance, self._shape = compliance, mesh.shape
        between = self._between.matrix(mesh.shape)
        self._lines = between.indptr, between.indices, between.data
        weights = np.outer(self._around, self._across).ravel() * ~self._held.ravel()
        areas = np.outer(mesh.dx, mesh.dz).ravel()
        self._means = contact.asperities.scale * weights / areas[self._cells]
        self._unit_growth = 0.0
        self.steps = 0  # of Newton's method, since they were last counted
        self._touching = np.zeros(0, dtype=np.int64)
        size = int(np.prod(mesh.shape))
        # rows of cells that have touched: of all cells they would be a gigabyte on fine grids
        self._row, self._by_cells = np.full(size, -1), np.empty((0, size))
        self.by_place = np.zeros((self._modes.reach.shape[0], *mesh.shape))

    def settle(self, pressure: Array, position: Array, unit: float) -> Array:
        """Growth of the cells (nx, nz), clearances, under `pressure` of the film, Pa.

        `unit` is the growth of the gap, clearances, over that of the shell, m. What follows from
        it, `grows` and `by_place`, is that of this state. NaN where no growth fits the pressure:
        the film then has no balance, either.
        """
        self._unit_growth = unit
        alone = unit * self._compliance.growth(pressure)
        if not np.abs(alone).max() <= _LARGEST:
            return np.full_like(alone, np.nan)
        modes = self._modes
        rigid = modes.gaps(position, self._gap.curvature) - self._summits
        rigid = (rigid + self._places[1].of(self._shell.expansion)).ravel()
        pressed_open = self._shell.pressed
        growth = pressed_open if unit and np.isfinite(pressed_open).all() else alone
        pressed, slope = self._asperities(rigid, growth)
        missing = alone + self._grown_by(pressed) - growth
        for _ in range(_STEPS):
            size = max(float(np.abs(growth).max()), self._roughness)
            left = float(np.abs(missing).max())
            if left <= _EXACT * size or not np.isfinite(left):
                break
            self._linearise(slope)
            step, share = self._solved(missing[None])[0], 1.0
            for _ in range(_HALVINGS):
                trial = growth + share * step
                pressed, slope = self._asperities(rigid, trial)
                missing = alone + self._grown_by(pressed) - trial
                if float(np.abs(missing).max()) < left:
                    break
                share *= 0.5
            growth = trial
        self._linearise(slope)
        self._follow(slope)
        fits = float(np.abs(missing).max()) <= _ENOUGH * size
        return np.asarray(growth) if fits else np.full_like(growth, np.nan)

    def grows(self, pressure: Array) -> Array:
        """Growth (l, nx, nz), clearances, by a change of the film's `pressure`, Pa."""
        return self._solved(self._unit_growth * self._compliance.growth(pressure))

    def at(self, position: Array) -> Touch:
        """What they carry with the shaft at `position` (m,), where the shell was settled."""
        return self.with_growth(position)[0] if self._touching.size else super().at(position)

    def with_growth(self, position: Array) -> tuple[Touch, Array]:
        """As of the base, with the shell that follows the shaft where they touch."""
        touch, by_growth = super().with_growth(position)
        if self._touching.size:  # else the shell has no growth by asperities to follow
            touch.stiffness[:] += np.einsum("mxz,nxz->mn", by_growth, self.by_place)
        return touch, by_growth

    # --- inside ----------------------------------------------------------------------------------
    def _asperities(self, rigid: Array, growth: Array) -> tuple[Array, Array]:
        """Mean pressure of the cells (nx, nz), Pa, and its change by the gap of the nodes."""
        pressure, slope = np.empty(growth.size), np.empty(rigid.size)
        given = rigid, growth.ravel(), self._lines, self._cells, self._means, self._roughness
        kernel.press(*given, pressure, slope)
        return pressure.reshape(self._shape), slope

    def _grown_by(self, pressed: Array) -> Array:
        """Growth of all cells, clearances, by what asperities press on some, Pa."""
        flat = pressed.ravel()
        cells = np.flatnonzero(flat)
        if (self._row[cells] < 0).any():  # a trial may press cells that then never touch
            return self._unit_growth * self._compliance.growth(pressed)
        return self._unit_growth * (flat[cells] @ self._influence(cells)).reshape(self._shape)

    def _linearise(self, slope: Array) -> None:
        """Cells that touch, change of their pressure by all growth, and of all growth by theirs."""
        self.steps += 1
        touching = np.zeros(self._row.size, dtype=bool)
        touching[self._cells[slope != 0.0]] = True
        self._touching = np.flatnonzero(touching)
        count = self._touching.size
        if not count:
            return
        self._by_growth = np.zeros((count, touching.size))
        row = np.cumsum(touching) - 1
        kernel.add_by_growth(slope, self._lines, self._cells, row, self._by_growth)
        self._grown = self._unit_growth * self._influence(self._touching)
        self._matrix = np.eye(count) - self._by_growth @ self._grown.T

    def _influence(self, cells: NDArray[np.int64]) -> Array:
        """Growth of all cells by the pressure on each of some, (count, size), m/Pa.

        It is that of the shell alone, and kept: cells touch again and again.
        """
        new = cells[self._row[cells] < 0]
        if new.size:
            one = np.zeros((new.size, self._row.size))
            one[np.arange(new.size), new] = 1.0
            grown = self._compliance.growth(one.reshape(new.size, *self._shape))
            self._row[new] = len(self._by_cells) + np.arange(new.size)
            self._by_cells = np.concatenate([self._by_cells, grown.reshape(one.shape)])
        return self._by_cells[self._row[cells]]

    def _solved(self, growth: Array) -> Array:
        """Growth (l, nx, nz) of a shell that asperities press, by that of one they do not."""
        if not self._touching.size:
            return growth
        flat = growth.reshape(len(growth), -1)
        pressed = np.linalg.solve(self._matrix, self._by_growth @ flat.T)
        return np.asarray(growth + (pressed.T @ self._grown).reshape(growth.shape))

    def _follow(self, slope: Array) -> None:
        """Growth of the cells by the position of the shaft, for `by_place`."""
        modes, size = self._modes, self._modes.reach.shape[0]
        if not self._touching.size:
            self.by_place = np.zeros((size, *self._shape))
            return
        closing = -(modes.reach[:, :, None] * modes.lengths[:, None, :]).reshape(size, -1)
        pressed = np.array(
            [np.bincount(self._cells, slope * way, int(np.prod(self._shape))) for way in closing]
        ).reshape(size, *self._shape)
        self.by_place = self._solved(self._unit_growth * self._compliance.growth(pressed))


class TouchedFilm(ElasticFilm):
    """Film in a shell that gives way around what film and asperities press.

    Without its `contact` it is that of a shell which the film alone presses.
    """

    contact: ShellContact | None

    def further_work(self) -> float:
        """What the film has taken beyond its Newton steps, as `Effort` counts, since last asked."""
        work = super().further_work()
        if self.contact is None:
            return work
        steps, self.contact.steps = self.contact.steps, 0
        return work + _OF_CELLS * float(self.mesh.shape[0] * self.mesh.shape[1]) * steps

    def _grow(self, position: Array) -> None:
        if self.contact is None:
            super()._grow(position)
        else:
            growth = self.contact.settle(self._excess(), position, self._per_clearance)
            self.gap.grow(growth)

    def _grows(self, pressure: Array) -> Array:
        return super()._grows(pressure) if self.contact is None else self.contact.grows(pressure)

    def _follows(self) -> Array | None:
        return None if self.contact is None else self.contact.by_place
