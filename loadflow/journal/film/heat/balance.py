"""What is linear in the temperatures of a film: what flows carry and what its surfaces conduct.

Numbered volumes: the cells, the grooves, the shaft. Each has a temperature; of a film with moments
(`surface_temperatures`) each cell has its first moment A as well, behind all of these.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.heat.surface_temperatures import Surface, Surfaces
from loadflow.journal.heat import FilmHeat

if TYPE_CHECKING:
    from scipy.sparse import csc_matrix

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

FRESH = -1  # number of what surrounds the film: oil as it is supplied


@dataclass(frozen=True)
class Flows:
    """Flows between numbered volumes, m³/s, all > 0: from `source` to `sink`.

    `drag` is what the shaft drags along of each; the rest is driven by pressure.
    """

    source: Numbers
    sink: Numbers
    flow: Array
    drag: Array

    @classmethod
    def mean(cls, each: Sequence[Flows]) -> Flows:
        """Mean of some flows; none is set off against another that goes the other way."""
        joined = (np.concatenate(parts) for parts in zip(*(vars(one).values() for one in each)))
        source, sink, flow, drag = joined
        return cls(source, sink, flow / len(each), drag / len(each))

    def sums(self, by: Numbers, weights: Array, count: int) -> Array:
        """Sum of `weights` over the flows of each of `count` volumes; those of fresh oil aside."""
        inside = by != FRESH
        return np.bincount(by[inside], weights[inside], count).astype(float)


@dataclass(frozen=True)
class Volumes:
    """Numbers of cells, grooves and shaft; `area` (size,) is that of the cells, m²."""

    area: Array
    grooves: int
    moments: bool

    @property
    def size(self) -> int:
        """Number of cells."""
        return int(self.area.size)

    @property
    def shaft(self) -> int:
        """Number of the shaft, the last volume."""
        return self.size + self.grooves

    @property
    def count(self) -> int:
        """Number of volumes."""
        return self.shaft + 1

    @property
    def unknowns(self) -> int:
        """Number of temperatures and moments."""
        return self.count + (self.size if self.moments else 0)

    def skew(self, t: Array) -> Array | float:
        """Moments A of the cells among the unknowns `t`."""
        return t[self.count :] if self.moments else 0.0

    def of_cells(self, surface: Surface) -> tuple[Array, csc_matrix]:
        """A temperature of the cells, constant (size,) and by the unknowns (size, unknowns)."""
        cells = np.arange(self.size)
        columns = [cells, np.full(self.size, self.shaft)]
        values = [surface.mean, surface.shaft]
        if self.moments:
            columns.append(self.count + cells)
            values.append(surface.skew)
        rows = np.tile(cells, len(columns))
        shape = (self.size, self.unknowns)
        return surface.given, sparse(np.concatenate(values), rows, np.concatenate(columns), shape)


@dataclass(frozen=True)
class HeatBalance:
    """Heat of all volumes by their unknowns: ``matrix @ t − rhs`` is what leaves them."""

    heat: FilmHeat
    volumes: Volumes
    surfaces: Surfaces
    flows: Flows

    def linear(self) -> tuple[csc_matrix, Array]:
        """Matrix and right-hand side."""
        from scipy.sparse import vstack

        moved, rest = self._moved()
        taken, warm = self._conducted()
        matrix, rhs = moved + taken, rest + warm
        if self.surfaces.moments is not None:
            moment, turned = self._moments()
            matrix, rhs = vstack([matrix, moment], format="csc"), np.append(rhs, turned)
        return matrix, rhs

    # --- inside ----------------------------------------------------------------------------------
    @cached_property
    def _parts(self) -> tuple[Array, Array]:
        """What of each flow is dragged, and what is driven by pressure."""
        return self.flows.drag, self.flows.flow - self.flows.drag

    @cached_property
    def _leaving(self) -> tuple[Array, Array]:
        """What leaves each cell, dragged and driven; together what enters it."""
        flows, count, size = self.flows, self.volumes.count, self.volumes.size
        drag = flows.sums(flows.source, flows.drag, count)[:size]
        return drag, flows.sums(flows.sink, flows.flow, count)[:size] - drag

    def _entering(self, part: Array) -> tuple[csc_matrix, Array]:
        """What enters the cells of a `part` of each flow: by its source, and of fresh oil."""
        flows, volumes = self.flows, self.volumes
        to_cell = (flows.sink >= 0) & (flows.sink < volumes.size)
        known, new = to_cell & (flows.source != FRESH), to_cell & (flows.source == FRESH)
        shape = (volumes.size, volumes.count)
        matrix = sparse(part[known], flows.sink[known], flows.source[known], shape)
        return matrix, np.bincount(flows.sink[new], part[new], volumes.size).astype(float)

    def _profile(self, surface: Surface, others: float = 1.0) -> tuple[Array, csc_matrix]:
        """A temperature of the cells, and that of all other volumes times `others`."""
        from scipy.sparse import vstack

        volumes = self.volumes
        given, cells = volumes.of_cells(surface)
        rest = np.arange(volumes.size, volumes.count)
        shape = (rest.size, volumes.unknowns)
        alone = sparse(np.full(rest.size, others), np.arange(rest.size), rest, shape)
        both = vstack([cells, alone], format="csc")
        return np.append(given, np.zeros(rest.size)), both

    def _moved(self) -> tuple[csc_matrix, Array]:
        """Heat that leaves cells with their flows; mixing in grooves."""
        from scipy.sparse import vstack

        heat, volumes, flows = self.heat, self.volumes, self.flows
        size, count = volumes.size, volumes.count
        heavy, fresh = heat.volume_heat, heat.inlet_temperature
        given = heavy * flows.sums(flows.source, flows.flow, count)[size : volumes.shaft]
        taken = heavy * flows.sums(flows.sink, flows.flow, count)[size : volumes.shaft]
        with np.errstate(divide="ignore", invalid="ignore"):
            share = np.where(taken > 0.0, np.minimum(heat.carry_over, given / taken), 0.0)
        unused = given == 0.0
        own = np.append(np.where(unused, 1.0, given), 0.0)  # the shaft's row is that of conduction
        rhs = np.zeros(count)
        rhs[size : volumes.shaft] = np.where(unused, 1.0, given - share * taken) * fresh
        used = heavy * np.where(unused, 0.0, share)
        to_groove = flows.sink >= size
        mixed, strange = to_groove & (flows.source != FRESH), to_groove & (flows.source == FRESH)
        number = flows.sink[strange] - size
        np.add.at(rhs, flows.sink[strange], heavy * fresh * share[number] * flows.flow[strange])
        number = flows.sink[mixed] - size

        rest = np.arange(size, count)
        matrix = sparse(own, rest, rest, (count, volumes.unknowns))
        profiles = self.surfaces.dragged, self.surfaces.pressed
        for surface, part, out in zip(profiles, self._parts, self._leaving):
            entering, new = self._entering(part)
            mixing = sparse(
                used[number] * part[mixed], number, flows.source[mixed], (rest.size, count)
            )
            moving = vstack([heavy * (_diagonal(out, count) - entering), -mixing], format="csc")
            constant, by_unknowns = self._profile(surface)
            matrix = matrix + moving @ by_unknowns
            rhs -= moving @ constant
            rhs[:size] += heavy * fresh * new
        return matrix, rhs

    def _conducted(self) -> tuple[csc_matrix, Array]:
        """Heat that passes into shell and shaft; the shaft's own balance."""
        from scipy.sparse import csc_matrix, vstack

        heat, volumes = self.heat, self.volumes
        area, count, shaft = volumes.area, volumes.count, volumes.shaft
        out, into = heat.shell_transfer * area, heat.shaft_transfer * area
        (low, shell), (high, turns) = (
            volumes.of_cells(s) for s in (self.surfaces.shell, self.surfaces.shaft)
        )
        turning = _only(volumes, shaft)
        cells = _scaled(out, shell) + _scaled(into, turns) - _column(into, shaft, volumes)
        rhs = np.zeros(count)
        rhs[: area.size] = -out * (low - heat.shell_temperature) - into * high
        whole = float(area.sum())
        if heat.shaft_temperature is not None:
            row, rhs[shaft] = whole * turning, whole * heat.shaft_temperature
        elif heat.shaft_transfer > 0.0:  # no net heat passes into it
            row = whole * turning - csc_matrix(area @ turns)
            rhs[shaft] = float(area @ high)
        else:  # as warm as the film
            means = sparse(
                area, np.zeros_like(area, dtype=int), np.arange(area.size), row_of(volumes)
            )
            row = whole * turning - means
        idle = csc_matrix((volumes.grooves, volumes.unknowns))
        return vstack([cells, idle, row], format="csc"), rhs

    def _moments(self) -> tuple[csc_matrix, Array]:
        """First moments: what flows carry, what crosses the film, what it conducts across."""
        heat, volumes, surfaces, flows = self.heat, self.volumes, self.surfaces, self.flows
        assert surfaces.moments is not None
        heavy, fresh, area, size = (
            heat.volume_heat,
            heat.inlet_temperature,
            volumes.area,
            volumes.size,
        )
        matrix, rhs = None, np.zeros(size)
        carried = ((surfaces.moments.dragged, 1 / 3), (surfaces.moments.pressed, 0.0))
        for (surface, even), part, out in zip(carried, self._parts, self._leaving):
            entering, new = self._entering(part)
            moving = heavy * (_diagonal(out, volumes.count) - entering)
            constant, by_unknowns = self._profile(surface, even)
            term = moving @ by_unknowns
            matrix = term if matrix is None else matrix + term
            rhs += heavy * fresh * even * new - moving @ constant
        grown = self._leaving[0] - flows.sums(flows.sink, flows.drag, volumes.count)[:size]
        constant, crossing = volumes.of_cells(surfaces.moments.crossing)
        matrix = matrix - _scaled(heavy * grown, crossing)
        rhs += heavy * grown * constant
        (low, shell), (high, turns) = (
            volumes.of_cells(s) for s in (surfaces.shell, surfaces.shaft)
        )
        out, into, k = (
            heat.shell_transfer * area,
            heat.shaft_transfer * area,
            surfaces.conducts * area,
        )
        matrix = matrix - _scaled(out + k, shell) + _scaled(into + k, turns)
        matrix = matrix - _column(into, volumes.shaft, volumes)
        rhs += (out + k) * low - out * heat.shell_temperature - (into + k) * high
        return matrix, rhs


def sparse(values: Array, rows: Numbers, columns: Numbers, shape: tuple[int, int]) -> csc_matrix:
    """Sparse matrix of entries at `rows` and `columns`."""
    from scipy.sparse import csc_matrix  # a film without heat starts sooner

    return csc_matrix((values, (rows, columns)), shape=shape)


def row_of(volumes: Volumes) -> tuple[int, int]:
    """Shape of one row."""
    return 1, volumes.unknowns


def _diagonal(values: Array, columns: int) -> csc_matrix:
    every = np.arange(values.size)
    return sparse(values, every, every, (values.size, columns))


def _scaled(factors: Array, matrix: csc_matrix) -> csc_matrix:
    """Rows of a matrix times `factors`."""
    return _diagonal(factors, factors.size) @ matrix


def _column(values: Array, column: int, volumes: Volumes) -> csc_matrix:
    """`values` of the cells in one column."""
    every = np.arange(values.size)
    return sparse(values, every, np.full(values.size, column), (values.size, volumes.unknowns))


def _only(volumes: Volumes, column: int) -> csc_matrix:
    """One row that is 1 at a column."""
    return sparse(np.ones(1), np.zeros(1, dtype=int), np.array([column]), row_of(volumes))
