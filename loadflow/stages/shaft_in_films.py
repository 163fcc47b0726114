"""A shaft and the films of its two journal bearings, in motion together.

Where films follow the whole series (`journal.motion = "transient"`), the shaft is tilted by where
it is in both of them at each time, and not by where it would rest: squeeze holds it while loads
swing. So shaft and films are one system. The shaft stage tells its loads and how it lies, the stage
of the films what these are; both ask for the same path, which is kept from one to the other.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass, replace

import numpy as np
import xarray as xr

from loadflow.cube import time_step
from loadflow.errors import SolverError
from loadflow.journal import Control, Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import Heat
from loadflow.journal.models.composed.shared_path import SharedPath, follow_shared
from loadflow.journal.models.composed.shared_sides import Lying, Seats
from loadflow.numerics.convergence import Convergence
from loadflow.numerics.lines import on_lines
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import move_together
from loadflow.shaft import Concept
from loadflow.shaft.in_films import ShaftInFilms
from loadflow.shaft.reactions import films_dataset, shaft_in_films
from loadflow.stages.bores import bores
from loadflow.stages.films.of_bearing import follow
from loadflow.stages.films.past import Past, after_past, past_of
from loadflow.stages.films.temperature import mean_temperature
from loadflow.stages.films.turning import SLOWEST
from loadflow.stages.frames import from_film, to_film

Floats = np.ndarray

STILL = 0.01
"""Share of the largest speed of a series, below which surfaces touch and no film is asked."""

_CONTROL = Control(tolerance=1e-5)  # 1e-7 moves the tilt by less than 1e-4 of its largest


@dataclass(frozen=True)
class FilmsTogether:
    """Path of a shaft in its films, at the samples that these take.

    Attributes
    ----------
    path : SharedPath
        Of shaft and films.
    temperature : tuple of float or None
        At which the oil of each film is held, K.
    """

    path: SharedPath
    temperature: tuple[float | None, ...]


def followed_together(scene: Scene, concept: Concept, speed: Floats) -> bool:
    """Whether a shaft at `speed` (n,), rad/s, and its films are followed together.

    A smooth film carries a shaft that turns at first; later on squeeze does, too. One that stands
    at first rests on asperities.
    """
    if not move_together(scene.shaft, scene.journal, concept):
        return False
    turns = abs(speed[0]) > max(STILL * np.abs(speed).max(), SLOWEST)
    return turns or all(scene.journal.at(name).contact is not None for name in concept.bearings)


def shaft_on_films(scene: Scene, concept: Concept, loads: xr.Dataset, tilt: float) -> xr.Dataset:
    """Loads and motion of the shaft at all samples of `loads`, as of `coupled_loads`."""
    time, force, moment, _ = _series(loads)
    every, shaft = _every(scene, loads), shaft_in_films(concept, force, moment, tilt=tilt)
    path = films_together(scene, concept, loads, tilt).path
    known = time[every]

    def onto(values: Floats) -> Floats:
        """(4, n) in the cube of (m, 2, 2) in the film."""
        return on_lines(time, known, from_film(values)[..., 1:].reshape(known.size, 4)).T

    found = np.ones(time.size, dtype=bool)
    residual, iterations = (
        max(float(one[name].max()) for one in path.paths) for name in ("residual", "iterations")
    )
    told = Convergence(True, residual, int(iterations))
    motion = shaft.motion(onto(path.position), onto(path.moment), found, told)
    about = {"solved": known.size, "interpolation_error": _between(path, known.size < time.size)}
    return films_dataset(concept, motion, shaft.along).assign_attrs(about)


def _between(path: SharedPath, skipped: bool) -> float:
    """Error of straight lines between the samples of a path, over the largest values.

    An eighth of the second difference, at its largest; none where no sample is skipped.
    """
    if not skipped:
        return 0.0
    worst = 0.0
    for values in (path.position, path.tilt, path.moment):
        if size := np.abs(values).max():
            bent = np.abs(np.diff(values, 2, axis=0)).max(initial=0.0)
            worst = max(worst, float(bent / size) / 8.0)
    return worst


def films_together(scene: Scene, concept: Concept, loads: xr.Dataset, tilt: float) -> FilmsTogether:
    """Shaft and films at the samples that films in motion take.

    Raises
    ------
    loadflow.errors.SolverError
        No film to begin with, or a step without an answer.
    """
    loads = loads.isel(time=_every(scene, loads))
    series, turned = _series(loads), bores(scene)
    lined = [turned[name] * (name in scene.journal.tilting) for name in concept.bearings]
    bore = to_film(np.array(lined))  # a shell that turns in its seat is never out of line
    past = past_of(scene, loads)
    asked = [scene.shaft.model_dump_json(), scene.journal.model_dump_json(), concept, tilt, past]
    told = repr(asked).encode() + b"".join(part.tobytes() for part in (*series, bore))
    key = hashlib.sha256(told).hexdigest()
    if key not in _KEPT:
        _KEPT.clear()
        try:
            _KEPT[key] = _followed(scene, concept, series, tilt, bore, past)
        except SolverError as error:
            _KEPT[key] = error
    found = _KEPT[key]
    if isinstance(found, SolverError):
        raise found
    return found


def in_motion(
    scene: Scene,
    bearing: str,
    loads: xr.Dataset,
    shaft: xr.Dataset,
    start: Floats | None = None,
) -> xr.Dataset:
    """Film of a bearing in motion along `loads`: with the shaft, or around it as it lies.

    Around a shaft that lies as `shaft` says of the bearing it begins at the place `start`, (2,), m.

    Raises
    ------
    loadflow.errors.SolverError
        No film to begin with, or a step without an answer.
    """
    from loadflow.turbines import load_turbine

    speed = loads["speed"].values.astype(float)
    concept = scene.shaft.concept_at(bearing)
    if concept is None or not followed_together(scene, concept, speed):
        return follow(scene.journal.at(bearing), loads, shaft, start)
    both = films_together(scene, concept, loads, load_turbine(scene.turbine.name).rotor.tilt)
    return both.path.paths[concept.bearings.index(bearing)]


_KEPT: dict[str, FilmsTogether | SolverError] = {}  # the last one alone


Series = tuple[Floats, Floats, Floats, Floats]


def _series(loads: xr.Dataset) -> Series:
    """Time (n,), force and moment of the hub (3, n), speed (n,)."""
    vectors = (loads[name].transpose("axis", "time") for name in ("hub_force", "hub_moment"))
    force, moment = (np.ascontiguousarray(values.values.astype(float)) for values in vectors)
    time, speed = (loads[name].values.astype(float) for name in ("time", "speed"))
    return time, force, moment, speed


def _every(scene: Scene, loads: xr.Dataset) -> slice:
    return slice(None, None, scene.journal.every(time_step(loads)))


def _followed(
    scene: Scene, concept: Concept, series: Series, tilt: float, bore: Floats, past: Past
) -> FilmsTogether:
    """The path along a series in bores that are turned by `bore` (2, 2), rad, after a `past`."""
    time, force, moment, speed = series
    shaft = shaft_in_films(concept, force, moment, tilt=tilt)
    bearings = [scene.journal.at(name) for name in concept.bearings]
    given = _given(shaft, bore, time.size)
    parts = [_film_of(options, given["force"][:, k], speed) for k, options in enumerate(bearings)]
    geometries, films, begins, warm = zip(*parts)
    by = _slopes(shaft)
    control = _CONTROL.limits(tolerance=1e-5, max_iterations=30)

    def path(past: Past) -> SharedPath:
        series = past.before({"time": time, "speed": speed, **given})
        lying = Lying(
            series["force"], series["tilt"], series["bend"], *by, felt=shaft.felt,
            touching=np.array([options.contact_film for options in bearings]),
            seats=_seats(bearings, series["force"]),
        )  # fmt: skip
        found = follow_shared(
            geometries, films, series["time"], series["speed"], lying, control, begins,
            rests=not past.steps,
        )  # fmt: skip
        after = slice(past.steps, None)
        return SharedPath(
            position=found.position[after],
            tilt=found.tilt[after],
            moment=found.moment[after],
            paths=[one.isel(time=after) for one in found.paths],
        )

    return FilmsTogether(after_past(path, past, time), warm)


def _seats(bearings: list[Journal], force: Floats) -> Seats | None:
    """What holds the shells of both films under loads (n, 2, 2), N; None if neither has a seat."""
    found = [options.seat for options in bearings]
    if found == [None, None]:
        return None
    load = np.hypot(force[..., 0], force[..., 1])
    slip = np.full(load.shape, np.inf)
    for k, seat in enumerate(found):
        if seat is not None:
            slip[:, k] = seat.slips_at(load[:, k])
    return Seats(np.array([np.inf if seat is None else seat.stiffness for seat in found]), slip)


def _film_of(
    options: Journal, force: Floats, speed: Floats
) -> tuple[JournalGeometry, Film, float, float | None]:
    """A bearing, its film, the temperature at first, and that at which its oil is held, K.

    Where heat is stored the temperature follows; the clearance is that of the first one.
    """
    heat = options.heat
    if not isinstance(heat, Heat):
        return options.geometry, options.film_model, 0.0, None
    warm = None if heat.capacity is None else heat.start_temperature
    if warm is None:
        warm = mean_temperature(options.model_copy(update={"tilt": False}), force, speed)
        assert warm is not None
    held = options.at_temperature(warm)
    if heat.capacity is None:
        return held.geometry, held.film_model, 0.0, warm
    stored = replace(options.film_model, heat=replace(heat, growth=None))
    return held.geometry, stored, warm, None


def _given(shaft: ShaftInFilms, bore: Floats, count: int) -> dict[str, Floats]:
    """Loads, tilt and bend of the shaft in the middle of both films, (n, 2, 2) in their axes.

    The tilt is that against bores which are turned by `bore` (2, 2), rad.
    """
    none = np.zeros((4, count))
    motion = shaft.motion(none, none, np.ones(count, dtype=bool), Convergence(True, 0.0, 0))
    return {
        "force": _film(shaft.force(none)),
        "tilt": _film(shaft.tilt(none, none)) - bore,
        "bend": to_film(motion.curvature.transpose(2, 0, 1)),
    }


def _film(vectors: Floats) -> Floats:
    """(n, 2, 2) in the axes of the films of (4, n) in the cube."""
    y, z = vectors.reshape(2, 2, -1).transpose(1, 2, 0)
    return np.stack([-z, y], axis=-1)


def _slopes(shaft: ShaftInFilms) -> tuple[Floats, Floats]:
    """Tilt by positions and by moments, (film, axis, film, axis), in the axes of the films."""
    count = shaft.line.equations.free.shape[1]
    none, found = np.zeros((4, count)), []
    for which in range(2):
        columns = []
        for number in range(4):
            unit = np.zeros((1, 2, 2))
            unit[0, number // 2, number % 2] = 1.0
            cube = from_film(unit)[..., 1:].reshape(4, 1) + none
            given = (cube, none) if which == 0 else (none, cube)
            change = _film(shaft.tilt(*given)[:, :1] - shaft.tilt(none, none)[:, :1])[0]
            columns.append(change)
        found.append(np.stack(columns, axis=-1).reshape(2, 2, 2, 2))
    return found[0], found[1]
