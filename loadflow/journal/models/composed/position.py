"""Reduced films at given positions and velocities of the shaft, with every effect of those at rest.

Points across and cells around are those on which a shaft at rest there would be found. The squeeze
is F ∂h/∂t by the velocity alone: what fills the gap is in balance, and a shell does not move.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from loadflow.journal.cavitation import FILL, LOAD, P
from loadflow.journal.film.cell_error import held_errors
from loadflow.journal.film.discretise import crowds_around
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.at_rest import finer_around
from loadflow.journal.models.composed.error import Judged
from loadflow.journal.models.composed.kernels._gap_kernels import MEAN, PLANES
from loadflow.journal.models.composed.kernels._loops import solve
from loadflow.journal.models.composed.kernels._thickening_kernels import PRESSURE
from loadflow.journal.models.composed.model import (
    ComposedFilm,
    build,
    contact_share,
    levels_at_rest,
    unknowns_on,
    warn_unresolved,
)
from loadflow.journal.models.composed.supply import falls_dry
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.journal.models.slow_heat import COLD, standing_states
from loadflow.journal.questions import AtPosition
from loadflow.numerics.convergence import Limits
from loadflow.numerics.lines import on_lines

Array = NDArray[np.float64]

_AT_REST = np.zeros(1)  # one time
_SHOWN = 2  # level of points across below which few show where the pressure is largest
_LEAST = 1.0 / 256  # step of an eccentricity, as a share of it, below which its film is given up


@dataclass(frozen=True)
class Held:
    """A film at a given position.

    Attributes
    ----------
    model : ComposedFilm
        The film that it was solved on.
    unknowns, pressure : array (nx, L)
        Of that, the latter in Pa.
    place : array (4,)
        Of the shaft.
    row : array
        Of results.
    force : array (2,)
        Load that it carries with its asperities, N.
    slopes : array (2, s, s)
        Derivatives of that by position and by velocity, with their sign turned.
    errors : array (7,)
        Bounds of what its cells and points leave out, as `Equilibrium.relative_grid_error`.
    found : bool
        Whether it is an answer, on cells around that resolve it.
    left : bool
        Whether its pressure asks for more points across.
    """

    model: ComposedFilm
    unknowns: Array
    pressure: Array
    place: Array
    row: Array
    force: Array
    slopes: Array
    errors: Array
    found: bool
    left: bool


class Positions:
    """What drives the films of one call, and their models by cells around and level.

    `viscosity` is that of `build`.
    """

    def __init__(
        self, asked: AtPosition, across: int | None = None, viscosity: Thickness | None = None
    ) -> None:
        self.asked, self.across, self.viscosity = asked, across, viscosity
        self._crowding = crowds_around(asked.bearing, asked.film, asked.line, asked.limits.refine)
        self.models: dict[tuple[int, int, int | None], ComposedFilm] = {}
        self.lines = self.model(asked.film.cells[0], 0, across).lines(asked.speed.size)

    def model(self, around: int, level: int, across: int | None) -> ComposedFilm:
        """The film on cells around, and on the points of a level or as many `across`."""
        key = around, level, across
        if key not in self.models:
            asked = self.asked
            fastest = np.abs(asked.speed) + np.hypot(*asked.velocity.T)
            options = replace(asked.film, grid=(around, asked.film.cells[1]))
            self.models[key] = build(
                asked.bearing, options, fastest, asked.line, level, at_rest=True, across=across,
                viscosity=self.viscosity,
            )  # fmt: skip
        return self.models[key]

    def shown(self, held: list[Held]) -> ComposedFilm:
        """The film of which the cells around and points across are shown: no fewer than of any."""
        around = max(film.model.options.cells[0] for film in held)
        points = max(film.model.film.nodes.slopes.shape[1] for film in held)
        levels = levels_at_rest(self.asked.film)[_SHOWN if self.asked.film.supply is None else 0 :]
        for level in levels[:-1]:
            model = self.model(around, level, None)
            if model.film.nodes.slopes.shape[1] >= points:
                return model
        return self.model(around, levels[-1], None)

    def held(self, n: int) -> Held:
        """Film at position `n`, on as many points and cells as it asks for."""
        around = self.asked.film.cells[0]
        finer = finer_around(self.asked.film, self.asked.limits)
        held = self._on_levels(n, around)
        gives = held.model.film.give > 0.0
        thin = gives and held.found and not held.model.resolves_gap(held.row[at.LEAST])
        if finer is not None and (thin or not held.found):
            more = self._on_levels(n, finer)
            held = more if more.found else held
        return held

    def _on_levels(self, n: int, around: int) -> Held:
        """Film at position `n` on cells around, on points of the first level that resolves it."""
        held = self.on(n, self.model(around, 0, self.across), None)
        for level in levels_at_rest(self.asked.film)[1:]:
            if not held.left:
                break
            more = self.on(n, self.model(around, level, None), held)
            if not more.found:
                break
            held = more
        return held

    def on(self, n: int, model: ComposedFilm, near: Held | None) -> Held:
        """Film at position `n` on a model, from that `near` it on fewer points."""
        work, ring, lanes = model.work, model.film.ring, model.film.lanes
        vx, vy = self.asked.velocity[n]
        work.squeeze[:] = -(vx * ring.cos + vy * ring.sin)[:, None]
        work.squeeze[:] *= lanes.inner + lanes.ends
        place = np.append(self.asked.position[n], self.lines[n, :2])
        size = 4 if model.whole else 2
        slopes, cold = np.zeros((2, size, size)), model.cold()
        work.u[:] = cold if near is None else unknowns_on(near.unknowns, near.model, model)
        row = self._solve(n, model, place, slopes)
        if not row[at.CONVERGED]:
            work.u[:] = cold
            row = self._approach(n, model, place, slopes, row[at.ITERATIONS])
        left = self.across is None and bool(model.unresolved_across(row[None])[0])
        found = row[at.CONVERGED] > 0.0 and not falls_dry(model.units, row[at.RESULTS :])
        found = bool(found and (not self._crowding or model.resolves(place)))
        force = work.load[:2] + work.touch[0, :2]
        pressure = work.thick[PRESSURE] if model.film.thickening.on else work.state[P]
        film = work.u.copy(), pressure.copy()
        judged = Judged(ring, model.film.nodes, model.film.held.on, 1)
        model.judge(judged, 0, float(self.asked.speed[n]))
        errors = held_errors(judged.left(), force[None])[0]
        return Held(model, *film, place, row, force, slopes, errors, found, found and left)

    def _solve(self, n: int, model: ComposedFilm, place: Array, slopes: Array) -> Array:
        """Row of the film at a place of position `n`, from the unknowns that are there."""
        return placed(
            model, place, self.lines[n], float(self.asked.speed[n]), self.asked.limits, slopes
        )

    def _approach(
        self, n: int, model: ComposedFilm, place: Array, slopes: Array, spent: float
    ) -> Array:
        """The same by way of lesser eccentricities and velocities."""
        work, share, step, known = model.work, -1.0, 1.0, model.cold()
        squeeze = work.squeeze.copy()
        while share < 1.0 and step >= _LEAST:
            ahead = min(share + step, 1.0)
            work.u[:], work.squeeze[:] = known, ahead * squeeze
            row = self._solve(n, model, place * [ahead, ahead, 1.0, 1.0], slopes)
            spent += row[at.ITERATIONS]
            if row[at.CONVERGED]:
                share, known = ahead, work.u.copy()
            elif share < 0.0:
                break
            else:
                step *= 0.5
        row[at.ITERATIONS] = spent
        return row


def placed(
    model: ComposedFilm, place: Array, line: Array, speed: float, control: Limits, slopes: Array
) -> Array:
    """Row of the film of a shaft that stays at a `place` (4,), from the unknowns that are there."""
    row, none = np.zeros((1, model.columns)), np.zeros((1, 4))
    solve(
        model.film, model.work, place.copy(), 0, 0, _AT_REST, none, line[None], np.array([speed]),
        control.tolerance, control.max_iterations, np.inf, row, slopes, COLD, standing_states(1),
    )  # fmt: skip
    return row[0]


def pressure(asked: AtPosition, across: int | None = None) -> tuple[dict[str, Any], Array]:
    """Fields of `FilmField`, (n, …), and places of the points across, m, of films at positions.

    As in `loadflow.journal.models.model.Model.pressure`; where there is none, `converged` is False.
    All are shown on as many cells and points, no fewer than any was solved on. There are `across`
    points whatever they leave, as of a film without effects, or as many as each film asks for.

    Warns
    -----
    loadflow.errors.ValidityWarning
        A pressure that changes more across the width than the polynomials do; names the position.
    """
    films, count = Positions(asked, across), asked.speed.size
    held = [films.held(n) for n in range(count)]
    left = np.array([film.left for film in held])
    if left.any():
        warn_unresolved(left, f"position {int(left.argmax())}")
    shown = films.shown(held)
    return told(films, held, [shown] * count), places_across(shown)


def told(films: Positions, held: list[Held], shown: list[ComposedFilm]) -> dict[str, Any]:
    """Fields of `FilmField`, (n, …), of films that are `held`, shown on the
    points of a model each, as many of all.
    """
    bearing, speed, first = films.asked.bearing, films.asked.speed, held[0].model
    rows = np.array([film.row for film in held])
    force, slopes = np.array([film.force for film in held]), np.array([f.slopes for f in held])
    count, size = speed.size, slopes.shape[-1]
    lengths = np.array([1.0, 1.0, bearing.radius, bearing.radius])[:size]
    slopes *= np.outer(lengths, lengths) / bearing.clearance
    answer = {
        "film_force": -force,
        "force": force,
        "moment": np.zeros((count, 2)),
        "tilt": np.zeros((count, 2)),
        "pad_tilt": np.zeros((count, 0)),
        "shell_deformation": np.zeros(count),
        **first.results(rows, speed),
        "stiffness": slopes[:, 0],
        "damping": slopes[:, 1],
        "converged": np.array([film.found for film in held]),
        "relative_grid_error": np.array([film.errors for film in held]),
    }
    if films.asked.film.contact is not None:
        answer["contact_share"] = contact_share(answer["contact_force"], force)
    limits = films.asked.limits
    cells = [_cells(film, on, line, limits) for film, on, line in zip(held, shown, films.lines)]
    answer |= {name: np.array([one[name] for one in cells]) for name in cells[0]}
    ring = shown[0].film.ring
    answer["angle"] = np.tile(np.unwrap(np.arctan2(ring.sin, ring.cos)), (count, 1))
    return answer


def places_across(model: ComposedFilm) -> Array:
    """Places of the points across both halves of the width, m."""
    nodes = model.film.nodes
    z = nodes.z[: nodes.slopes.shape[1]] * model.bearing.radius
    return z if model.whole else np.concatenate([-z[::-1], z])


def _cells(held: Held, shown: ComposedFilm, line: Array, control: Limits) -> dict[str, Array]:
    """What `FilmField` says of the points of a film as they lie in the model that is `shown`."""
    film, work = shown.film, shown.work
    work.u[:] = held.unknowns if held.model is shown else _moved(held, shown)
    none = Limits(control.tolerance, 0)
    placed(shown, held.place, line, 0.0, none, np.zeros((2, 0, 0)))
    points = film.nodes.slopes.shape[1]
    pressure, fill = work.state[LOAD, :, :points], work.state[FILL, :, :points]
    grown = film.give * (pressure - film.ring.p_edge)
    if film.modes.on:
        grown += work.modes.growth[:, :points]
    if film.yielding.on and film.give > 0.0:
        grown += _lifted(shown, work.gap[PLANES, :, :points])
    gap = work.gap[MEAN, :, :points]
    clearance = shown.bearing.clearance
    cells = [pressure.copy(), fill.copy(), clearance * grown, clearance * gap]
    if not shown.whole:
        cells = [np.concatenate([values[:, ::-1], values], axis=1) for values in cells]
    return dict(zip(("pressure", "fill", "deformation", "gap"), cells))


def _moved(held: Held, shown: ComposedFilm) -> Array:
    """Unknowns of a film at the points of another model.

    The unknown of a smooth law drops where the film ends, by more than its pressure: that is taken
    between the points, and not below all of a column.
    """
    own, smooth = held.model, shown.options.law.smooth
    values, ring = held.pressure if smooth else held.unknowns, own.film.ring
    if ring.cos.size != shown.film.ring.cos.size:
        old, new = (np.arctan2(one.sin, one.cos) for one in (ring, shown.film.ring))
        values = on_lines(new, old, values, period=2.0 * np.pi)
    if not smooth:
        return unknowns_on(values, own, shown)
    points = own.film.nodes.slopes.shape[1]
    least = np.minimum(values[:, :points].min(axis=1), own.film.ring.p_edge)
    pressure = unknowns_on(values, own, shown, shown.film.ring.p_edge)
    return shown.units.unknown_of(np.maximum(pressure, least[:, None]))


def _lifted(model: ComposedFilm, planes: Array) -> Array:
    """How far asperities press a shell open at gaps without that, clearances."""
    yielding = model.film.yielding
    gaps = yielding.first + yielding.step * np.arange(yielding.table.shape[1])
    opens = CubicHermiteSpline(gaps, yielding.table[0], yielding.table[1])
    first = yielding.table[0, 0] + (planes - gaps[0]) * yielding.table[1, 0]
    lifted = np.where(planes < gaps[0], first, opens(np.clip(planes, gaps[0], gaps[-1]))) - planes
    return np.where(planes < gaps[-1], lifted, 0.0)
