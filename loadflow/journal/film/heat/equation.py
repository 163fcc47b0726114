"""Energy equation of a film over its area, of its mean temperature across the gap.

    ρ c_p ∇·(q T) = dissipation − α_shell (T − T_shell) − α_shaft (T − T_shaft)

by upwind finite volumes on the cells of the film. What flows over a face has the temperature of the
cell, groove or surroundings that it comes from. T is that of the surfaces, which with three points
across differs from the mean (`surface_temperatures`). Dissipation is that of shear, by the share of
liquid of a cell, of pressure, and of asperities that rub. The viscosity follows the temperature
within the solution; flows and gap are given.

Every groove is a volume in which all mixes: with q_out of the hot oil that flows into it and q_in
that it gives, λ' = min(λ, q_in/q_out), it has T_in = [λ' q_out T_out + (q_in − λ' q_out) T_sup] /
q_in.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Protocol, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import FILL
from loadflow.journal.film import _kernels as coefficient
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.asperity_load import NodeLoad
from loadflow.journal.film.gap.warm import WarmGap
from loadflow.journal.film.heat import _energy_kernels as kernel
from loadflow.journal.film.heat.balance import FRESH, Flows
from loadflow.journal.film.heat.ring_growth import RingExpansion
from loadflow.journal.film.heat.temperatures import Temperatures, Warmth
from loadflow.journal.film.integrals import dragged_past_pads, idle_columns
from loadflow.journal.heat import FilmHeat

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]


class Solved(Protocol):
    """A solved film: its unknowns, and the position of the shaft, clearances."""

    @property
    def u(self) -> Array:
        """Unknowns (nx, nz)."""

    @property
    def position(self) -> Array:
        """Position (m,)."""


class EnergyEquation(Temperatures):
    """Energy equation of a film with a `WarmGap`.

    Parameters
    ----------
    film : DiscreteFilm
        Film; its speed may change.
    gap : WarmGap
        Its gap.
    heat : FilmHeat
        Oil and cooling.
    """

    def __init__(self, film: DiscreteFilm, gap: WarmGap, heat: FilmHeat) -> None:
        film.sheared_by_fill = True  # heat is made where there is oil, and friction is that heat
        labels, own = _grooves(film)
        areas = film.mirrors * film.radius**2 * np.outer(film.mesh.dx, film.mesh.dz)
        super().__init__(film, heat, areas, labels, own + int(film.ends_supply))
        self.gap, self.mirrored = gap, film.mesh.half
        self._line = self.size + own if film.ends_supply else FRESH
        grows = heat.growth is not None
        self._expansion = RingExpansion(heat, film.mesh, film.radius) if grows else None

    @property
    def way(self) -> float:
        """Speed of the shaft, rad/s, that is set."""
        return self.film.speed

    def thicken(self, state: Array) -> None:
        """Give the film the viscosity and the growth of its cells at the temperatures `state`."""
        across, growth = self._at_state(state)
        self.gap.thicken(across)
        if growth is not None:
            self.gap.expand(growth / (self.film.relative_clearance * self.film.radius))

    @property
    def growth(self) -> Array:
        """Growth of the gap of the cells by heat, (nx, nz), m."""
        return self.gap.expansion * (self.film.relative_clearance * self.film.radius)

    def alone(self, film: Solved, guess: Array) -> Warmth:
        """Temperatures of one film at the speed that is set, as `solve_mean`."""
        one = film.u, film.position, self.film.speed, idle_columns(self.film)
        return self.solve_mean([one], guess)

    def solve_mean(
        self, films: Sequence[tuple[Array, Array, float, NDArray[np.bool_]]], guess: Array
    ) -> Warmth:
        """Temperatures in balance with the mean of the heat that some films make and carry.

        Parameters
        ----------
        films : sequence of (array (nx, nz), array (m,), float, array of bool (nx,))
            Unknowns of the film, position of the shaft in clearances, and speed, rad/s; columns of
            cells of pads without load.
        guess : array (nx, nz)
            Temperatures to start from, K.

        Raises
        ------
        loadflow.errors.SolverError
            No temperature is found.
        """
        film = self.film
        clearance = film.relative_clearance * film.radius
        unit = film.mirrors * film.viscosity * film.radius**4 / clearance
        each: list[Flows] = []
        gaps, sheared, pumped = (np.zeros(self.size) for _ in range(3))
        for u, position, speed, idle in films:
            film.set_speed(speed)
            film.unload(idle)
            own, shear, lost = self._given(u, position)
            each.append(own)
            sheared += unit * speed**2 * shear / len(films)
            pumped += (lost + self._rubbed(position)) / len(films)
            gaps += clearance * self.gap.means[self.wet] / len(films)
        return self.balanced(Flows.mean(each), gaps, sheared, pumped, guess)

    # --- inside ----------------------------------------------------------------------------------
    def _given(self, u: Array, position: Array) -> tuple[Flows, Array, Array]:
        """Flows; shear and dissipation by pressure of the wet cells."""
        film, mesh = self.film, self.film.mesh
        film.place(u, position)
        nx, nz = mesh.shape
        around, across = np.empty((nx + 1, nz)), np.empty((nx, nz + 1))
        lost = np.empty((nx, nz))
        kernel.flows(
            film.state, self.gap.coef, mesh.dz, mesh.area, mesh.gz, mesh.closed, film.wedge,
            film.p_edge, film.p_line, film.line_fill, film.grooved, around, across, lost,
        )  # fmt: skip
        fill = film.state[FILL].copy()
        dragged = self._dragged(film.state[FILL])
        self._drag_through(around, across, dragged, lost, fill)
        unit = film.pockets.flow_unit
        flows = self._numbered(unit * around, unit * across, unit * dragged)
        shear = (fill * self.gap.shear * mesh.dz)[self.wet]
        return flows, shear, unit * lost[self.wet]

    def _rubbed(self, position: Array) -> Array | float:
        """Heat that asperities make in the wet cells, W; 0 of smooth surfaces."""
        film = self.film
        if film.contact is None:
            return 0.0
        asperities = cast("NodeLoad", film.contact)
        sliding = abs(film.speed) * film.radius
        normal = asperities.forces(position)[self.wet]
        return np.asarray(asperities.contact.coefficient * sliding * normal)

    def _dragged(self, fill: Array) -> Array:
        """Flow over every face around, (nx + 1, nz), that the shaft drags along."""
        film, rows = self.film, self.film.mesh.shape[1]
        every = film.wedge * self.gap.coef[coefficient.E, :, :rows] * film.mesh.area
        line = np.full((1, rows), film.line_fill)
        first, last = (fill[-1:], fill[:1]) if film.mesh.closed else (line, line)
        upstream = np.concatenate([first, fill] if film.wedge > 0 else [fill, last])
        if film.mesh.closed:
            every[-1] = 0.0
        return np.asarray(every * upstream)

    def _drag_through(
        self, around: Array, across: Array, dragged: Array, lost: Array, fill: Array
    ) -> None:
        """Let no more oil through the film of a pad without load than its narrowest place drags.

        Changes all arrays.
        """
        for first, end, through, share in dragged_past_pads(self.film):
            faces, cells = slice(first, end + 1), slice(first, end)
            across[cells], lost[cells] = 0.0, 0.0
            around[faces] = dragged[faces] = through
            fill[cells] = share

    @cached_property
    def _faces(self) -> tuple[Numbers, Numbers]:
        """Numbers of the volumes before and behind all faces."""
        cells, (nx, nz) = self._cells, self.film.mesh.shape
        line = np.full((1, nz), self._line)
        before = np.concatenate([cells[-1:] if self.film.mesh.closed else line, cells])
        behind = np.concatenate([cells, line])
        side = np.full((nx, 1), FRESH)
        low = np.concatenate([before.ravel(), np.hstack([side, cells]).ravel()])
        high = np.concatenate([behind.ravel(), np.hstack([cells, side]).ravel()])
        return low, high

    def _numbered(self, around: Array, across: Array, dragged: Array) -> Flows:
        """Flows between volumes; those inside one groove left out."""
        low, high = self._faces
        flow = np.concatenate([around.ravel(), across.ravel()])
        drag = np.append(dragged.ravel(), np.zeros(across.size))
        return self._flows(low, high, flow, drag)


def _grooves(film: DiscreteFilm) -> tuple[Numbers, int]:
    """Number of the groove of each cell (nx, nz), a supply's first, −1 for none; their count."""
    labels = film.pockets.numbers.astype(np.int64).copy()
    own = film.grooved & ~film.pockets.fixed
    columns = np.asarray(own.any(axis=1))
    starts = columns & ~np.append(np.zeros(1, dtype=bool), columns[:-1])
    run = np.cumsum(starts) - 1 + film.pockets.count
    labels = np.where(own, run[:, None], labels)
    return labels, int(labels.max()) + 1
