"""Films of one row of thrust pads around a tilted runner, tabulated without dimension.

With a film that ruptures at the pressure of its edges all pressures scale with viscosity × speed,
and one table serves every speed and temperature. One pad is solved at gaps, tilts and directions of
the tilt; pads of a row differ by the direction alone, in which they see it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import cast

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from loadflow.errors import InputError, LoadflowError, SolverError
from loadflow.journal.cavitation import Guembel
from loadflow.journal.film_model import Film
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.thrust._row_kernels import fill_lands, fill_pads, fill_sums
from loadflow.journal.thrust.bearings import ThrustBearing
from loadflow.journal.thrust.curves import gives_way
from loadflow.journal.thrust.pads import Pivot

Array = NDArray[np.float64]

MOST = 0.9
"""Largest tilt of a table: slope times outer radius over the film on the axis."""

_GAPS = 25  # between the thinnest and the thickest film, evenly in its logarithm
_TILTS, _DIRECTIONS = 7, 12
_NEAREST = 7  # pads on the thin side, of which one has the largest pressure
_PROBES = 6  # films that are solved on the grid to see how far the table is off
_SMALL = 1e-3  # share of the largest tilt, of which the error of the moment is that of none
_SHARE = 0.1  # of the force, of the squeeze that tells what it does to the largest pressure
_RADIANS = 4  # directions of a row within its pitch

FORCE, DAMPING, TORQUE, FLOW, SIDE_FLOW, MOMENT_ACROSS, MOMENT_ALONG = range(7)
"""Rows of sums over the pads: force and friction torque over η ω, damping over η, flows over ω;
moments of the runner on the pads over η ω, about where the gap grows most and a right angle on."""
_POWERS = np.array([2.0, 3.0, 1.0, -1.0, -1.0, 2.0, 2.0])
"""Of the gap, with which they are nearly constant."""
_SUMS, _PRESSURE, _FILM = 7, 7, 8
_VALUES = 9  # of a pad: its sums, largest pressure and least film


@dataclass(frozen=True)
class RowTable:
    """A row of pads, tabulated over gap, tilt and its direction.

    Attributes
    ----------
    row : ThrustBearing
        Its pads are fixed, or tilt freely on rigid pivots.
    grid : (int, int)
        Cells of a pad.
    thinnest, thickest : float
        Ends of the table, gaps on the axis, m.
    tilts : bool
        Whether the runner tilts; without, one pad stands for all.

    Raises
    ------
    loadflow.errors.InputError
        Pads on supports that give way.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import Film, Guembel, Lubricant, ThrustBearing
    >>> from loadflow.journal.thrust.row_table import FORCE, RowTable
    >>> lands = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    >>> table = RowTable(lands, (8, 4), 2e-5, 4e-4)
    >>> sums = table.sums(np.array([1e-4]), np.zeros(1), np.zeros(1))
    >>> exact = lands.pressure(1e-4, 10.0, Film(Lubricant(0.05), Guembel(), grid=(8, 4)))
    >>> bool(abs(sums[FORCE, 0] * 0.05 * 10.0 / exact.force - 1) < 1e-3)
    True
    """

    row: ThrustBearing
    grid: tuple[int, int]
    thinnest: float
    thickest: float
    tilts: bool = False

    def __post_init__(self) -> None:
        if gives_way(self.row):
            raise InputError(
                "pads on supports that give way have no table of their films; solve them on the "
                "grid"
            )

    def sums(self, gap: Array, slope: Array, direction: Array) -> Array:
        """Sums over the pads (7, n), per unit of viscosity and speed.

        Parameters
        ----------
        gap, slope : array (n,)
            Film on the axis, m, and slope of the runner, rad; beyond `MOST` that of `MOST`.
        direction : array (n,)
            Where the gap grows most, rad.
        """
        found, scratch = np.empty((_SUMS, gap.size)), np.empty((2, self._tilted))
        fill_sums(self.parts, self.frame, *_rows(gap, slope, direction), scratch, found)
        return np.asarray(found * gap ** -_POWERS[:, None])

    def pressure(self, gap: Array, slope: Array, direction: Array) -> Array:
        """Largest pressure (n,) of all pads above that of the edges, over η ω, 1."""
        local, pads = self._pads(gap, slope, direction, _PRESSURE)
        return np.asarray((pads / local**2).max(axis=1))

    def squeezed(self, gap: Array) -> Array:
        """Share of squeeze in the largest pressure over that in the force, (n,), 1; aligned."""
        return np.asarray(_squeezed_of(self)(np.log(gap)))

    def minimum_film(self, gap: Array, slope: Array, direction: Array) -> Array:
        """Least film (n,), m: of fixed pads as the cells have it, else of the pads as they tilt."""
        row = self.row
        if self.follows:
            local, pads = self._pads(gap, slope, direction, _FILM)
            return np.asarray((pads * local).min(axis=1))
        share = np.linspace(0.0, 1.0, self.grid[0] + 1)
        share = np.unique(np.concatenate([share, row.row.profile.kinks]))
        depth = row.row.profile.depth(share)
        across = (share - 0.5) * row.pad_angle
        found, radii = np.empty(gap.size), np.array([row.inner_radius, row.outer_radius])
        angle, waves = self._angles(direction, 3), np.array([np.cos(across), np.sin(across)])
        fill_lands(*_rows(gap, slope, angle), depth, waves, radii, found)
        return found

    def errors(self, film: Film, speed: float, most: float = 0.0) -> Array:
        """Largest relative errors (2,) beside films of the whole row on the grid, of its own law.

        That of force, torque, pressure and least film, and that of the moment of a tilted runner,
        at some gaps between the nodes. Pads that follow the runner are aligned there: tilted, each
        has the film of an aligned one over its pivot, and the row is beside the sum of these.

        Parameters
        ----------
        film : Film
            Isothermal.
        speed : float
            rad/s.
        most : float
            Largest tilt that counts, as `MOST`.
        """
        rng, worst, aligned = np.random.default_rng(0), np.zeros(2), set[float]()
        gaps = np.exp(0.5 * (np.log(self.gaps[1:]) + np.log(self.gaps[:-1])))
        places = np.linspace(_GAPS // 3, _GAPS - 2, _PROBES).astype(int)
        tilts = 2 * [most, most / 3.0, 2.0 * most / 3.0]
        if self.tilts:  # relative errors of moments are largest for a small tilt
            places, tilts = np.append(places, places[::3]), [*tilts, _SMALL * most, _SMALL * most]
        for gap, tilt in zip(gaps[places].tolist(), tilts):
            slope = tilt * gap / self.row.outer_radius if self.tilts else 0.0
            at = gap, slope, float(rng.uniform(0.0, 2.0 * math.pi))
            if self.follows and slope > 0.0:
                worst = np.maximum(worst, self._apart(at, _over_pivots(self, *at)))
                at = gap, 0.0, at[2]
            if at[1] == 0.0 and gap in aligned:
                continue
            aligned |= {gap} if at[1] == 0.0 else set()
            worst = np.maximum(worst, self._apart(at, _on_grid(self.row, film, speed, *at)))
        return worst

    @property
    def gaps(self) -> Array:
        """Nodes (n,), m."""
        return np.geomspace(self.thinnest, self.thickest, _GAPS)

    @property
    def frame(self) -> Array:
        """Numbers by which compiled loops find a place in the table."""
        row, logs = self.row, np.log(self.gaps)
        step = float(logs[-1] - logs[0]) / (_GAPS - 1)
        radii = row.outer_radius, 0.5 * (row.inner_radius + row.outer_radius)
        return np.array([logs[0], step, *radii, MOST, row.pads, row.row.centres[0]])

    @property
    def parts(self) -> Array:
        """Sums over the pads as compiled loops take them, (sums, gaps, 4, tilts, waves)."""
        return _sums_of(self)

    @property
    def follows(self) -> bool:
        """Whether the pads tilt as the runner does."""
        return self.row.row.tilting

    def local(self, gap: Array, slope: Array, angle: Array) -> Array:
        """Film in the middle of pads whose middles lie at `angle` from the widest gap, m."""
        row = self.row
        radius = 0.5 * (row.inner_radius + row.outer_radius)
        share = np.minimum(slope * row.outer_radius / gap, MOST) * radius / row.outer_radius
        return np.asarray(gap * (1.0 + share * np.cos(angle)))

    # --- inside ----------------------------------------------------------------------------------

    def _apart(self, at: tuple[float, float, float], exact: Array) -> Array:
        """What `errors` has, at a gap, slope and direction."""
        place = tuple(np.array([each]) for each in at)
        sums = self.sums(*place)[[FORCE, TORQUE, MOMENT_ACROSS, MOMENT_ALONG], 0]
        off = np.array([*sums, self.pressure(*place)[0], self.minimum_film(*place)[0]]) - exact
        moment = np.hypot(*off[2:4]) / np.hypot(*exact[2:4]) if at[1] > 0.0 else 0.0
        some = [0, 1, 4, 5]
        return np.array([np.abs(off[some] / exact[some]).max(), moment])

    @property
    def _tilted(self) -> int:
        return _TILTS if self.tilts else 1

    def _angles(self, direction: Array, count: int) -> Array:
        """Angles of the middles of the `count` pads nearest to where the film is thinnest, (n, m).

        They are counted from where the gap grows most.
        """
        first, pitch = self.row.row.centres[0], 2.0 * math.pi / self.row.pads
        if not self.tilts:
            return np.zeros((direction.size, 1)) + first - direction[:, None]
        nearest = np.round((direction + math.pi - first) / pitch)
        some = np.arange(min(count, self.row.pads)) - (min(count, self.row.pads) - 1) // 2
        return np.asarray(first + pitch * (nearest[:, None] + some) - direction[:, None])

    def _pads(
        self, gap: Array, slope: Array, direction: Array, which: int, count: int = _NEAREST
    ) -> tuple[Array, Array]:
        """Film in the middle of the pads on the thin side and one of their values, (n, count)."""
        angle = self._angles(direction, count)
        part = _parts_of_pads(self)[which]
        local, found = np.empty(angle.shape), np.empty(angle.shape)
        scratch = np.empty((2, self._tilted)), np.empty(part.shape[3])
        fill_pads(part, self.frame, *_rows(gap, slope, angle), *scratch, local, found)
        return local, found


def _crowded(share: float | Array) -> Array:
    """Tilt as it is interpolated: what is left of the film counts."""
    return -np.log1p(-np.asarray(share))


def _waves(angle: Array, count: int) -> Array:
    """1, cos ψ, sin ψ, cos 2ψ, … (…, count)."""
    orders = np.arange(1, (count + 1) // 2)
    turns = orders * angle[..., None]
    pairs = np.stack([np.cos(turns), np.sin(turns)], axis=-1)
    ones = np.ones((*angle.shape, 1))
    return np.concatenate([ones, pairs.reshape(*angle.shape, -1)], axis=-1)


@lru_cache(maxsize=16)
def _nodes_of(table: RowTable) -> Array:
    """One pad at all gaps, tilts and directions, (gaps, tilts, directions, 9), times local gaps.

    Raises
    ------
    loadflow.errors.SolverError
        A film that carries no load, or that is not found.
    """
    nodes = 0.5 * (1.0 + chebyshev.chebpts2(_TILTS)) * _crowded(MOST)
    shares = -np.expm1(-nodes) if table.tilts else np.zeros(1)
    directions = np.arange(_DIRECTIONS) * 2.0 * math.pi / _DIRECTIONS
    film = _film_of(table)
    found = np.empty((_GAPS, shares.size, directions.size if table.tilts else 1, _VALUES))
    if table.tilts and table.follows:
        return _following(table, table.gaps, shares, directions)
    for i, gap in enumerate(table.gaps.tolist()):
        for j, share in enumerate(shares.tolist()):
            slope = share * gap / table.row.outer_radius
            for k, angle in enumerate(directions.tolist() if table.tilts else [0.0]):
                if k and slope == 0.0:
                    found[i, j, k] = _turned(found[i, j, 0], angle)
                    continue
                at = np.array([gap]), np.array([slope]), np.array([angle])
                found[i, j, k] = _node(table.row, film, gap, slope, angle, table.local(*at)[0])
    return found


def _following(table: RowTable, gaps: Array, shares: Array, directions: Array) -> Array:
    """Nodes of pads that tilt freely: their film is that of an aligned runner over the pivot."""
    row, pivot = table.row, cast("Pivot", table.row.pivot)
    width = row.outer_radius - row.inner_radius
    radius = (row.inner_radius + pivot.across * width) / row.outer_radius
    at = directions + (pivot.share - 0.5) * row.pad_angle
    gap = gaps[:, None, None]
    over = gap * (1.0 + radius * shares[:, None] * np.cos(at))
    aligned = replace(
        table, thinnest=(1.0 - MOST) * table.thinnest, thickest=2.0 * table.thickest, tilts=False
    )
    splines = _splines_of(aligned)
    values = np.stack([splines[q](np.log(over))[..., 0] for q in range(_VALUES)], axis=-1)
    slope = shares[:, None] * gap / row.outer_radius
    ratio = table.local(gap, slope, directions) / over
    powers = np.array([*_POWERS, 2.0, -1.0])
    values = values * ratio[..., None] ** powers
    arm = radius * row.outer_radius * values[..., FORCE]
    values[..., MOMENT_ACROSS], values[..., MOMENT_ALONG] = -arm * np.sin(at), arm * np.cos(at)
    return np.asarray(values)


def _over_pivots(table: RowTable, gap: float, slope: float, direction: float) -> Array:
    """What `RowTable.errors` are of, of pads that tilt freely: the sum of aligned films."""
    angles = np.array(table.row.row.centres) - direction
    share = np.array([slope * table.row.outer_radius / gap])
    pads = _following(table, np.array([gap]), share, angles)[0, 0]
    local = table.local(np.array(gap), np.array(slope), angles)[:, None]
    sums = (pads[:, :_SUMS] * local**-_POWERS).sum(axis=0)
    pressure, film = pads[:, _PRESSURE] / local[:, 0] ** 2, pads[:, _FILM] * local[:, 0]
    moment = sums[[MOMENT_ACROSS, MOMENT_ALONG]]
    return np.array([sums[FORCE], sums[TORQUE], *moment, pressure.max(), film.min()])


def _on_grid(
    row: ThrustBearing, film: Film, speed: float, gap: float, slope: float, direction: float
) -> Array:
    """The same of a whole row on the grid, pads and runner where they are."""
    cos, sin = math.cos(direction), math.sin(direction)
    exact = row.pressure(gap, speed, film, tilt=(slope * sin, -slope * cos))
    x, y = exact.moment
    above = exact.maximum_pressure - film.edge_pressure
    acts = exact.force, abs(exact.friction_torque), cos * x + sin * y, cos * y - sin * x, above
    drag = film.liquid.viscosity * abs(speed)
    return np.array([*(each / drag for each in acts), exact.minimum_film])


def _turned(node: Array, angle: float) -> Array:
    """Values of a pad at `angle` that has an aligned runner, from those of one at 0."""
    turned, cos, sin = node.copy(), math.cos(angle), math.sin(angle)
    turned[MOMENT_ACROSS] = cos * node[MOMENT_ACROSS] - sin * node[MOMENT_ALONG]
    turned[MOMENT_ALONG] = sin * node[MOMENT_ACROSS] + cos * node[MOMENT_ALONG]
    return turned


def _node(
    row: ThrustBearing, film: Film, gap: float, slope: float, angle: float, local: float
) -> Array:
    """Values of one pad whose middle lies at `angle` from the widest gap."""
    one = replace(row, pads=1, first_pad=angle - 0.5 * row.pad_angle)
    try:
        state = one.pressure(gap, 1.0, film, tilt=(0.0, -slope))
    except LoadflowError as error:
        raise SolverError(f"gap {gap:.3g} m, slope {slope:.3g} rad: {error}") from error
    if slope == 0.0 and state.force <= 0.0:
        raise SolverError(f"gap {gap:.3g} m: the film carries no load in this sense of rotation")
    sums = state.force, state.damping, abs(state.friction_torque), state.flow
    side = float(np.sum(state.side_flow))
    scaled = np.array([*sums, side, *state.moment]) * local**_POWERS
    return np.array([*scaled, state.maximum_pressure * local**2, state.minimum_film / local])


@lru_cache(maxsize=16)
def _splines_of(table: RowTable) -> dict[int, CubicSpline]:
    """Each value of a pad over the logarithm of the gap: polynomials of tilt, waves around."""
    nodes = _nodes_of(table)
    return {which: CubicSpline(np.log(table.gaps), part) for which, part in _spectra(nodes)}


def _spectra(nodes: Array) -> list[tuple[int, Array]]:
    """By value, coefficients (gaps, tilts · waves) of nodes (gaps, tilts, directions, values)."""
    count = nodes.shape[2]
    angles = np.arange(count) * 2.0 * math.pi / count
    waves = _waves(angles, max(count - 1, 1))
    around = np.linalg.lstsq(waves, np.eye(count), rcond=None)[0]
    along = _inverse(nodes.shape[1])
    found = np.einsum("hk,jl,glkq->gjhq", around, along, nodes)
    return [(q, found[..., q].reshape(len(found), -1)) for q in range(nodes.shape[3])]


@lru_cache(maxsize=16)
def _squeezed_of(table: RowTable) -> CubicSpline:
    film, found = _film_of(table), []
    for gap in table.gaps.tolist():
        rest = table.row.pressure(gap, 1.0, film)
        moved = table.row.pressure(gap, 1.0, film, velocity=-_SHARE * rest.force / rest.damping)
        more = moved.maximum_pressure / rest.maximum_pressure, moved.force / rest.force
        found.append((more[0] - 1.0) / (more[1] - 1.0))
    return CubicSpline(np.log(table.gaps), found)


def _film_of(table: RowTable) -> Film:
    """The film of a table: of unit viscosity, ruptured at the pressure of its edges."""
    return Film(Lubricant(1.0), Guembel(0.0), inlet=None, grid=table.grid)


def _inverse(count: int) -> Array:
    """Polynomials by values at their nodes, (count, count)."""
    if count == 1:
        return np.ones((1, 1))
    values = chebyshev.chebvander(chebyshev.chebpts2(count), count - 1)
    return np.asarray(np.linalg.inv(values), float)


@lru_cache(maxsize=16)
def _sums_of(table: RowTable) -> Array:
    """Sums over the pads over the logarithm of the gap: polynomials of tilt, a wave of a pitch."""
    row, splines = table.row, _splines_of(table)
    logs, pads = np.log(table.gaps), row.pads
    if not table.tilts:
        values = np.stack([splines[q](logs)[:, :1] for q in range(_SUMS)], axis=-1)
        values[..., MOMENT_ACROSS:] = 0.0  # of pads all round
        spline = CubicSpline(logs, (pads * values).reshape(logs.size, -1))
        return _cubics(spline, (1, 1, _SUMS)).transpose(4, 0, 1, 2, 3).copy()
    nodes = 0.5 * (1.0 + chebyshev.chebpts2(_TILTS)) * _crowded(MOST)
    shares, around = -np.expm1(-nodes), np.arange(_RADIANS) * 2.0 * math.pi / (pads * _RADIANS)
    totals = np.empty((logs.size, _TILTS, _RADIANS, _SUMS))
    for j, share in enumerate(shares):
        slope = share * table.gaps / row.outer_radius
        for k, direction in enumerate(row.row.centres[0] + around):
            turned = np.full(logs.size, direction)
            for q in range(_SUMS):
                local, values = table._pads(table.gaps, slope, turned, q, pads)
                each = values * (local / table.gaps[:, None]) ** -_POWERS[q]
                totals[:, j, k, q] = each.sum(axis=1)
    waves = _waves(pads * around, 3)
    by_wave = np.einsum("hk,jl,glkq->gjhq", np.linalg.pinv(waves), _inverse(_TILTS), totals)
    spline = CubicSpline(logs, by_wave.reshape(logs.size, -1))
    return _cubics(spline, (_TILTS, 3, _SUMS)).transpose(4, 0, 1, 2, 3).copy()


@lru_cache(maxsize=16)
def _parts_of_pads(table: RowTable) -> list[Array]:
    """Each value of a pad as compiled loops take it, (gaps, 4, tilts, waves)."""
    return [_cubics(spline, (table._tilted, -1)) for spline in _splines_of(table).values()]


def _cubics(spline: CubicSpline, shape: tuple[int, ...]) -> Array:
    """Cubics (gaps, 4, …) of a spline whose values have been flattened."""
    found = spline.c.transpose(1, 0, 2)
    return np.ascontiguousarray(found.reshape(*found.shape[:2], *shape))


def _rows(gap: Array, slope: Array, angle: Array) -> tuple[Array, Array, Array]:
    """Arrays of one kind in memory: loops are compiled once."""
    one, two, three = (np.ascontiguousarray(each, float) for each in (gap, slope, angle))
    return one, two, three
