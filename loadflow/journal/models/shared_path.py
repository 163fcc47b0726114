"""One shaft in two reduced films with effects, followed through time.

Both films and the shaft are one system: each film has the loads, and the shaft the tilt, that the
other one leaves. The shaft is rigid between the films; how their moments bend it, and turn housings,
is that of the last step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models import composed_film as at
from loadflow.journal.models._composed_loops import solve
from loadflow.journal.models._shared_loops import Shared, Side, follow
from loadflow.journal.models.composed_film import Composed
from loadflow.journal.models.composed_model import ComposedFilm, build, contact_share
from loadflow.journal.models.ring import no_start
from loadflow.journal.models.slow_heat import (
    COLD,
    THIN,
    cooled,
    lighter,
    slow_states,
    standing_states,
)
from loadflow.journal.solvers.transient import orbit_dataset, stopped
from loadflow.numerics.convergence import Limits

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_HOLDS = 4.0  # times the largest load, at which a gap at a bearing end would be closed
_NOW = np.zeros(1)


class Lying(NamedTuple):
    """How a shaft lies in two films, and loads them.

    Attributes
    ----------
    force : array (n, 2, 2)
        Load on each film if none takes a moment, N: (time, film, axis).
    tilt : array (n, 2, 2)
        Of the shaft in each film then, if it is in the middle of both, rad.
    bend : array (n, 2, 2)
        Its curvature in each film, 1/m.
    by_position : array (2, 2, 2, 2)
        Tilt by position in the films, rad/m: (film, axis, film, axis).
    by_moment : array (2, 2, 2, 2)
        Tilt by the moments of the films, rad/(N m), as the shaft bends and what it rests on turns.
    felt : array of bool (2,)
        Whether the shaft feels the moment of each film.
    touching : array (2,)
        Gap, m, below which shaft and shell touch at a bearing end.
    """

    force: Array
    tilt: Array
    bend: Array
    by_position: Array
    by_moment: Array
    felt: NDArray[np.bool_]
    touching: Array


@dataclass(frozen=True)
class SharedPath:
    """Path of a shaft in two films; first dimension time, second the film.

    Attributes
    ----------
    position, tilt : array (n, 2, 2)
        m; rad.
    moment : array (n, 2, 2)
        Of the shaft on the film and what it touches, N m.
    paths : list of xarray.Dataset
        Of each film, as `JournalBearing.orbit` gives it.
    """

    position: Array
    tilt: Array
    moment: Array
    paths: list[xr.Dataset]


def follow_shared(
    bearings: Sequence[JournalGeometry],
    options: Sequence[Film],
    time: Array,
    speed: Array,
    lying: Lying,
    control: Limits,
    temperature: Sequence[float] = (0.0, 0.0),
    level: int = 0,
) -> SharedPath:
    """Follow a shaft in two films.

    Parameters
    ----------
    bearings, options : sequence
        The two bearings and their films, with no heat over the area.
    time, speed : array (n,)
        s; rad/s.
    lying : Lying
        How the shaft lies in them.
    control : Limits
        How hard each step is solved.
    temperature : sequence of float
        Of both films at the first time, K, where they store heat.
    level : int
        Of the points across, of which a higher one has more.

    Raises
    ------
    OrbitStopped
        No film to begin with, or a step that fails even when cut to 1/256.
    """
    count, size = time.size, np.hypot(*np.moveaxis(lying.force, -1, 0))
    models = []
    for number, (bearing, film) in enumerate(zip(bearings, options)):
        line = Line(tilt=lying.tilt[:, number], bend=lying.bend[:, number])
        model = build(bearing, film, speed, line, level)
        model.units.raise_scale(float(size[:, number].max()) / (bearing.width * bearing.diameter))
        ring = model.film.ring._replace(scale=model.units.scale)
        models.append(replace(model, film=model.film._replace(ring=ring)))
    if len({type(model.film) for model in models}) > 1:  # the loop knows two of one kind
        models = [replace(model, film=Composed(*model.film)) for model in models]
    sides = [_side(k, models, lying, temperature[k]) for k in range(2)]
    shared = _shared(sides, lying)
    for k, (side, model) in enumerate(zip(sides, models)):
        _begin(side, model, lying.force[:1, k], speed[:1], control)
    shared.at[:] = np.concatenate([side.place[:2] for side in sides])
    shared.before[:] = shared.at
    done = follow(*sides, shared, time, speed, control.tolerance, control.max_iterations)
    if done < count:
        k = int(np.argmin([side.rows[done - 1, at.LEAST] for side in sides]))
        ratio = float(np.hypot(*sides[k].place[:2]))
        missed = float(np.linalg.norm(shared.missing)), 0.0, control.max_iterations
        raise stopped(time[done], lying.force[done, k], speed[done], ratio, missed)
    return _told(models, sides, time, speed, lying)


def _side(number: int, models: Sequence[ComposedFilm], lying: Lying, temperature: float) -> Side:
    """One film, in the units of the loops; coordinates are the positions in clearances."""
    model, count = models[number], len(lying.tilt)
    turn = model.bearing.radius / model.bearing.clearance
    given, lies, turned = np.zeros((count, 4)), np.zeros((4, 4)), np.zeros((4, 4))
    given[:, 2:] = lying.tilt[:, number] * turn
    lies[[0, 1], [2 * number, 2 * number + 1]] = 1.0
    for k, other in enumerate(models):
        both = slice(2 * k, 2 * k + 2)
        lies[2:, both] = turn * other.bearing.clearance * lying.by_position[number, :, k]
        turned[2:, both] = turn * other.bearing.radius * lying.by_moment[number, :, k]
    felt = lies * model.bearing.clearance / models[0].bearing.clearance
    if not lying.felt[number]:
        felt[2:] = 0.0
    film, contact = model.film, model.options.contact
    load = _HOLDS * float(np.hypot(*lying.force[:, number].T).max())
    if film.rough.size > 0.0 or film.give > 0.0 or film.ring.shaped:
        load = 0.0
    rub = 0.0 if contact is None else contact.coefficient * model.bearing.radius
    warmth, states = slow_states(model.options, model.units, 0.5, rub, temperature, count)
    light = lighter(warmth, states, 0) if warmth.on else 1.0
    return Side(
        film=film, work=model.work, lies=lies, felt=felt, turned=turned, given=given,
        bend=np.array(model.lines(count)[:, 2:]),
        stop=np.array([lying.touching[number] / model.bearing.clearance, load]),
        place=np.zeros(4), new=np.zeros(4), rows=np.zeros((count, model.columns)),
        thin=np.array([states[0, THIN], light]), warmth=warmth, states=states,
    )  # fmt: skip


def _shared(sides: Sequence[Side], lying: Lying) -> Shared:
    load = sum(lying.force[:, k] @ side.felt[:2] for k, side in enumerate(sides))
    return Shared(np.array(load), *np.zeros((6, 4)), np.zeros((4, 5)), np.zeros(len(load)))


def _begin(side: Side, model: ComposedFilm, force: Array, speed: Array, control: Limits) -> None:
    """A film at rest at the first time, around a shaft that the other film does not turn."""
    work, most = side.work, 4 * control.max_iterations
    line = np.concatenate([side.given[:1, 2:], side.bend[:1]], axis=1)
    work.bend[:], work.u[:], work.kept[0] = side.bend[0], model.cold(), 0.0
    side.place[:] = model.estimates(force, speed, line)[0]
    solve(
        side.film, work, side.place, 2, 0, _NOW, model.loads(force), line, speed * side.thin[0],
        control.tolerance, most, np.inf, side.rows[:1], np.zeros((2, 0, 0)), COLD,
        standing_states(1),
    )  # fmt: skip
    if not side.rows[0, at.CONVERGED] > 0.0:
        missed = tuple(side.rows[0, [at.RESIDUAL, at.ROUNDING, at.ITERATIONS]])
        raise no_start(force[0], speed[0], float(np.hypot(*side.place[:2])), missed)
    work.kept[0] = 0.0


def _told(
    models: Sequence[ComposedFilm], sides: Sequence[Side], time: Array, speed: Array, lying: Lying
) -> SharedPath:
    """What the loops have found."""
    lengths = np.array([[m.bearing.clearance, m.bearing.radius] for m in models])
    rows = [side.rows for side in sides]

    def both(*columns: int) -> Array:
        return np.stack([each[:, columns] for each in rows], axis=1)

    paths = []
    for k, (model, side) in enumerate(zip(models, sides)):
        values = model.results(rows[k], speed * side.states[:, THIN])
        values |= {"x": rows[k][:, at.X], "y": rows[k][:, at.Y]}
        if model.options.contact is not None:
            values["contact_share"] = contact_share(values["contact_force"], lying.force[:, k])
        values = cooled(side.warmth, side.states, values)
        force = lying.force[:, k]
        paths.append(orbit_dataset(values, time, force, speed, model.bearing.clearance))
    return SharedPath(
        position=both(at.X, at.Y) * lengths[:, :1],
        tilt=both(at.TILT_X, at.TILT_Y) * (lengths[:, :1] / lengths[:, 1:]),
        moment=both(at.MOMENT_X, at.MOMENT_Y) * lengths[:, 1:],
        paths=paths,
    )
