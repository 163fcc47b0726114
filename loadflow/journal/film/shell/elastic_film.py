"""Film in an elastic shell: the gap follows the pressure in the same Newton iteration.

The shell needs no unknowns of its own: its growth is that of the pressure at hand, so that every
residual of the film is one of film and shell. What the gap of a cell owes to its own pressure
stands in the band; what it owes to others is iterated on top of the band's factors.
"""

from __future__ import annotations

from typing import Any, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import DLOAD, FILL, LOAD
from loadflow.journal.film.film import DiscreteFilm, Factors
from loadflow.journal.film.gap import _elastic_kernels as kernel
from loadflow.journal.film.gap.asperity_load import AsperityLoad, Touch, YieldingNodeLoad
from loadflow.journal.film.gap.elastic import ElasticGap
from loadflow.journal.film.shell.compliance import Compliance

Array = NDArray[np.float64]

_EXACT = 1e-8  # residual of the linear systems of a shell that spreads, over their right-hand side
_KRYLOV = 60  # steps of GMRES that are tried
_AT_ONCE = 0.5  # work over the cells squared where they lead nowhere, as that of films is counted
_SMALLEST = 1.0 / 2**20  # share of a step below which there is none


class ElasticFilm(DiscreteFilm):
    """Film between shaft and elastic shell; other parameters than `compliance`: `DiscreteFilm`.

    The shell is at its nominal size under the edge pressure, inside and outside.
    """

    def __init__(self, compliance: Compliance, gap: ElasticGap, *film: Any) -> None:
        super().__init__(gap, *film)
        self.gap: ElasticGap = gap
        self.compliance = compliance
        self.elastic, self.softness = True, 1.0
        self.stencil = np.empty((5, *gap.mesh.shape))
        self._all_at_once = 0.0  # work of systems that were solved so

    def place(self, u: Array, position: Array) -> Array:
        """Evaluate law, shell and gap at `u` and `position`; returns the axes of the frame."""
        self._apply_law(u)
        self._grow(position)
        self._place = position
        return self.gap.place(position)

    def _carried(self, columns: Array) -> Array:
        """Change of the load by each of `columns`, that of the asperities with it."""
        carried = super()._carried(columns)
        if self.contact is not None:
            pressure = self.state[DLOAD] * self._fields(columns)
            growth = self._grows(pressure)
            asperities = cast("YieldingNodeLoad", self.contact)
            self._touch, by_growth = asperities.with_growth(self._place)
            slopes = by_growth / (self.mirrors * self.radius**2)
            carried += np.einsum("mxz,lxz->lm", slopes, growth)
        return carried

    def _touched(self, contact: AsperityLoad, position: Array) -> Touch:
        return self._touch  # that of `_carried`: nearly all of what asperities take

    def relax(self, share: float = 1.0) -> None:
        """Undo what pressure has deformed; the shell then has a `share` of its compliance."""
        self.softness = share
        self.gap.grow(np.zeros(self.mesh.shape))

    def further_work(self) -> float:
        """What the film has taken beyond its Newton steps, as `Effort` counts, since last asked."""
        work, self._all_at_once = self._all_at_once, 0.0
        return work

    @property
    def _per_clearance(self) -> float:
        """Growth of the gap that counts, in clearances, over that of the shell, m."""
        return self.softness / (self.relative_clearance * self.radius)

    def _excess(self) -> Array:
        """Pressure of the cells (nx, nz) above that at the bearing ends, Pa."""
        self.gap.drag(self.wedge * self._per_clearance * self.compliance.local)
        return np.asarray(self.state[LOAD] - self.p_edge)

    def _grow(self, position: Array) -> None:
        """Let the gaps grow under the pressure at hand, with the shaft at `position`."""
        self.gap.grow(self._grows(self._excess()))

    def _grows(self, pressure: Array) -> Array:
        """Growth of the gaps (…, nx, nz), clearances, by a change of the `pressure`, Pa."""
        return self._per_clearance * self.compliance.growth(pressure)

    def _follows(self) -> Array | None:
        """Growth of the gaps by the position of the shaft (m, nx, nz); none unless they touch."""
        return None

    @property
    def deformation(self) -> Array:
        """Growth of the gap of the cells last placed, (nx, nz), m."""
        growth = self.gap.pressed + self.gap.pressed_open()
        return growth * (self.relative_clearance * self.radius)

    def target(self, position: Array, step: Array) -> Array:
        """Where a step of the shaft may lead: as far as the shell deforms."""
        return position + step

    def clearance_left(self, position: Array) -> float:
        """Narrowest gap over the clearance, that between cells included."""
        return self.gap.left(position)

    def narrowest(self, u: Array, position: Array) -> float:
        """Narrowest gap over the clearance at any unknowns `u` and `position`."""
        self.place(u, position)
        return self.gap.narrowest(position)

    def step_share(
        self, u: Array, columns: Array, weights: Array, way: tuple[Array, Array], fills: bool
    ) -> float:
        """Share of a Newton step that leaves at least a third of the narrowest gap."""
        start, target = way
        least = self.gap.least_after(start)
        share = super().step_share(u, columns, weights, way, fills)
        while share > _SMALLEST:
            trial = u.copy()
            self.correct(trial, columns, share * weights, fills)
            self._apply_law(trial)
            place = start + share * (target - start)
            self._grow(place)
            if self.gap.least(place) >= least:
                return share
            share *= 0.5
        return share

    def balance(
        self,
        coef: Array,
        mass: Array,
        change: Array | None = None,
        out: Array | None = None,
    ) -> Array:
        """Outflow of every cell (nx, nz) at the state last placed, or by a `change` of it."""
        field = super().balance(coef, mass, change, out)
        if change is not None:
            self._spread(self._grows(change[LOAD][None]), field[None])
        return field

    def _spread(self, growth: Array, fields: Array) -> None:
        """Add what a `growth` (l, nx, nz), clearances, changes in the balance to `fields`."""
        kernel.spread(self.stencil, growth, fields)

    def _add_following(self, fields: Array) -> None:
        """Let the derivatives of the balance by position (m, nx, nz) have the gaps that follow."""
        growth = self._follows()
        if growth is not None:
            self._spread(growth, fields)

    def _assemble(self, mass: Array, rate: float) -> None:
        super()._assemble(mass, rate)
        mesh = self.mesh
        gap = self.gap
        kernel.gap_stencil(
            self.state, gap.coef, gap.blend, gap.own_share, *gap.nodes, gap.surfaces, mesh.dz,
            mesh.gz, mesh.closed, self.wedge, self.edges, self.slope * rate, self.fixed,
            gap.thinned, self.stencil,
        )  # fmt: skip
        growth = self._per_clearance * self.compliance.local * self.state[DLOAD]
        kernel.add_stencil(self.stencil, growth, mesh.order, self.fixed, mesh.bandwidth, self.ab)

    def _solve(self, factors: Factors, columns: Array) -> None:
        """Solve for each of `columns` (l, n), in place.

        Where the shell spreads by GMRES, preconditioned with the band; where that stalls, because
        the shell is much softer than the film, all at once.
        """
        super()._solve(factors, columns)
        if not self.compliance.spreads:
            return
        from scipy.sparse.linalg import LinearOperator, gmres

        def preconditioned(given: Array) -> Array:
            rest = self._far(given)
            super(ElasticFilm, self)._solve(factors, rest)
            return given + rest

        sizes = np.linalg.norm(columns, axis=1, keepdims=True)
        scaled = columns / np.where(sizes > 0.0, sizes, 1.0)
        matrix = LinearOperator(
            (scaled.size, scaled.size),
            lambda vector: preconditioned(vector.reshape(scaled.shape)).ravel(),
            dtype=float,
        )
        found, failed = gmres(matrix, scaled.ravel(), rtol=_EXACT, restart=_KRYLOV, maxiter=1)
        if failed:
            self._all_at_once += _AT_ONCE * columns.shape[1] ** 2
            every = preconditioned(np.eye(columns.shape[1]))
            columns[:] = np.linalg.solve(every.T, columns.T).T
        else:
            columns[:] = found.reshape(columns.shape) * sizes

    def _add_shell_squeeze(self, factors: Factors, columns: Array, size: int) -> None:
        """Let the derivatives by velocity have the squeeze of the shell that follows the shaft."""
        by_place, by_velocity = columns[1 : size + 1], columns[size + 1 : 2 * size + 1]
        pressure = -self.state[DLOAD] * self._fields(by_place)
        growth, follows = self._grows(pressure), self._follows()
        if follows is not None:
            growth = growth + follows
        volume = self.slope * self.state[FILL] * self.gap.widths * growth
        if self.gap.open_share is not None:
            volume *= self.gap.open_share
        volume[:, self.fixed] = 0.0
        more = self._columns(volume)
        self._solve(factors, more)
        by_velocity += more

    def _fields(self, columns: Array) -> Array:
        """Columns in the order of the solver, (l, n), as fields of cells (l, nx, nz)."""
        return columns.reshape(-1, *self.mesh.shape)[:, self.mesh.order]

    def _columns(self, fields: Array) -> Array:
        """Fields of cells (l, nx, nz) as columns in the order of the solver, (l, n)."""
        ordered = np.empty_like(fields)
        ordered[:, self.mesh.order] = fields
        return ordered.reshape(len(fields), -1)

    def _far(self, columns: Array) -> Array:
        """What the balance owes to changes of the unknowns, (l, n), by way of other cells' gaps."""
        fields = self._fields(columns)
        pressure = self.state[DLOAD] * fields
        growth = self._grows(pressure) - self._per_clearance * self.compliance.local * pressure
        out = np.zeros_like(fields)
        self._spread(growth, out)
        out[:, self.fixed] = 0.0
        return self._columns(out)
