"""Tilt of a shaft that lies on different sides of the clearances of its journal bearings."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import (
    Suspensions,
    floating,
    floats_in_films,
    move_together,
)
from loadflow.shaft import Concept
from loadflow.shaft import bearing_loads as reactions
from loadflow.shaft.beam import BearingSupport
from loadflow.stages.bores import slope_between, usual_loads
from loadflow.stages.effects.chart_films import charted
from loadflow.stages.effects.effect import Effect, Sizes
from loadflow.stages.effects.film_sizes import largest, no_bound_at_standstill
from loadflow.stages.effects.situation import Floats, Situation
from loadflow.stages.films.turning import carried_throughout
from loadflow.stages.frames import from_film, moved_by, to_film
from loadflow.stages.stage import with_settings
from loadflow.turbines import load_turbine

_WAYS = np.array([[0, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
"""Where the moment of the hub pushes one bearing as it pulls the other; the mean first."""


@dataclass(frozen=True)
class Place:
    """Where a film lies: `position` (5, n, 3), m, in the frame of the cube, and `film` (5, n), m.

    NaN where the shaft stands. `load` (5, n), N, presses on it.
    """

    position: Floats
    film: Floats
    load: Floats


def slopes(at: Situation, concept: Concept, names: list[str]) -> tuple[Floats, dict[str, Place]]:
    """Slope of a shaft in the clearances of its outermost films, and film at mid-plane of each.

    Closed charts say where a film lies under the mean load, and under its largest deviation, which
    pushes one bearing as it pulls the other. Films in motion lie elsewhere at each moment, but
    scatter alike: mean, spread and extreme of the slope are those of films at rest within a tenth
    (5 MW, 12 and 18 m/s).

    Returns
    -------
    slope : ndarray, shape (5, n, 3)
        In the frame of the cube, rad: under the mean load, and pushed either way along y and z.
    places : dict of Place
        Where the film of each bearing lies.
    """
    places = {name: place_of(at, name, (-1.0) ** k) for k, name in enumerate(names)}
    return slope_between(concept, {name: one.position for name, one in places.items()}), places


def place_of(at: Situation, name: str, sign: float) -> Place:
    """Place of a film under the mean load, and pushed by its deviation × `sign` as by `slopes`."""
    chart, load = charted(at.scene.journal.at(name)), at.bearings[name]
    force = load.force + sign * _WAYS[:, None] * load.swing[:, None]
    force = to_film(force)
    pressed = np.hypot(force[..., 0], force[..., 1])
    position, film = np.full((*force.shape[:2], 3), np.nan), np.full(force.shape[:2], np.nan)
    if at.turns.any():
        some = force[:, at.turns]
        speed = np.broadcast_to(at.speed[at.turns], some.shape[:2])
        found = chart.equilibrium(some.reshape(-1, 2), speed.ravel())
        lies = np.asarray(found.eccentricity).reshape(some.shape)
        position[:, at.turns] = from_film(lies)
        film[:, at.turns] = np.asarray(found.minimum_film).reshape(some.shape[:2])
    return Place(position, film, pressed)


@dataclass(frozen=True)
class Ends:
    """Films by the ends of their bearing: `share` of it that these take, and `film` (n,), m.

    Slices of a film as thin as h carry ∝ 1/h, so that mid-plane rises by x/tanh x and the film at
    the end is 2x/(e^2x − 1) of that of an aligned shaft: it closes, up to where surfaces touch. x,
    the share, is as 1/h: whatever thins a film thins its end by more.
    """

    share: Floats
    film: Floats

    def left(self, least: float, by: float = 1.0) -> Floats:
        """Film at the end (n,), m, of films `by` × as thick; no less than `least`."""
        x = np.clip(self.share / by, 1e-9, 300.0)  # beyond, nothing is left in any number
        return np.asarray(np.maximum(by * self.film * 2.0 * x / np.expm1(2.0 * x), least))


def ends_afloat(at: Situation) -> dict[str, Ends]:
    """Films that a shaft floats in, and what the ends take of them: their gap is c − |e ± θ B/2|.

    The slope θ is that of `slopes` less the turn of the bores; ``alignment = "mean"`` takes that of
    `usual_slope`. Loads that a film does not carry have none to close.
    """
    found = {}
    for _, concept, names in floating(at.scene.shaft, at.scene.journal):
        slope, places = slopes(at, concept, names)
        for name, place in places.items():
            if name not in at.scene.journal.tilting or not at.turns.any():
                continue
            own = at.scene.journal.at(name)
            lies, film = place.position[:, at.turns], place.film[:, at.turns]
            tilted = slope[:, at.turns]
            carried = np.isfinite(film) & np.isfinite(tilted).all(axis=-1)
            if not carried[0].any():
                continue
            if own.alignment == "mean":
                bore = usual_slope(at.scene, concept, names)
            else:
                bore = from_film(own.alignment)
            away = 0.5 * own.geometry.width * moved_by(tilted - bore)
            ends = [np.linalg.norm(lies + side, axis=-1) for side in (away, -away)]
            share = (np.maximum(*ends) - np.linalg.norm(lies, axis=-1)) / film
            found[name] = Ends(share[carried], film[carried])
    return found


def usual_slope(scene: Scene, concept: Concept, names: list[str]) -> Floats:
    """Slope (3,), rad, that bores have which follow a shaft in its clearances, as by `slopes`.

    That of the usual load of the machine, whatever the wind speeds of a scene are. Zero where no
    film carries that: films refuse it then.
    """
    usual = usual_loads(scene)
    gravity = load_turbine(scene.turbine.name).rotor.tilt
    loads = reactions(replace(concept, beam=None), usual.force, usual.moment, tilt=gravity)["force"]
    places = {}
    for name in (names[0], names[-1]):
        force = to_film(loads.sel(bearing=name).transpose("time", "axis").values.astype(float))
        found = charted(scene.journal.at(name)).equilibrium(force, usual.speed)
        places[name] = from_film(np.asarray(found.eccentricity))
    slope = slope_between(concept, places)
    lying = np.isfinite(slope).all(axis=1)
    if not lying.any():
        return np.zeros(3)
    return np.asarray(np.average(slope[lying], axis=0, weights=usual.weight[lying]))


def closed_ends(at: Situation) -> dict[str, float]:
    """What the ends of a bearing take of its film at mid-plane, which stays where it is.

    By film that a shaft floats in, at its largest.
    """
    return {name: float(ends.share.max()) for name, ends in ends_afloat(at).items()}


def _indicator(at: Situation) -> Sizes:
    """What the ends take, x, changes, at the same load.

    Of the film as `Ends` says; the rest is calibrated on pilots of sized cylindrical bores,
    docs/physics.md.
    """
    found = []
    for name, ends in ends_afloat(at).items():
        left = ends.left(at.scene.journal.at(name).contact_film)
        most = float(np.maximum(ends.share, 1e-9).max())
        found.append(
            {
                "eccentricity ratio": 0.03 * most,
                "minimum film": max(float(ends.film.min() / left.min()) - 1.0, 0.0),
                "maximum pressure": 1.0 - 1.0 / (1.0 + 0.4 * most**2),
                "friction power": 0.02 * most,
            }
        )
    return largest(found) if found else {}


def stated(scene: Scene, of: Suspensions) -> bool:
    """Whether a scene says what shafts rest on, or that films are not those they float in."""
    found = of(scene.shaft, scene.journal)
    other = {key for key, value in _TOGETHER.items() if getattr(scene.journal, key) != value}
    rests = any(one.beam is not None and one.beam.supports for _, one, _ in found)
    return rests or bool(other & scene.journal.model_fields_set)


def switched(scene: Scene, on: bool, of: Suspensions) -> Scene | None:
    """The scene with shafts on rigid bearings, or on films that they are followed with in motion.

    None where these are no films that can be: of a shaft that stands at times, those of smooth
    surfaces. `of` says which shafts.
    """
    journal = with_settings(scene, "journal", _TOGETHER) if on else scene
    if journal is None or (on and not carried_throughout(scene)):
        return None
    held = {name for name, one in scene.thrust.collars.items() if not one.self_aligning}
    if on and any(held & {*one.bearings} for _, one, _ in of(scene.shaft, scene.journal)):
        return None  # their moment, which no model feeds back, would hold the shaft
    support = BearingSupport(stiffness="journal", takes_moment=True)
    changed = {}
    for kind, concept, films in of(scene.shaft, scene.journal):
        if concept.beam is not None and on:
            if films != [*concept.bearings]:
                return None
            supports = (support,) * len(films)
            changed[kind] = replace(concept, beam=replace(concept.beam, supports=supports))
        elif concept.beam is not None:
            changed[kind] = replace(concept, beam=concept.beam.free_in_films())
    found = journal.model_copy(update={"shaft": scene.shaft.model_copy(update=changed)})
    together = all(
        move_together(found.shaft, found.journal, concept)
        for _, concept, _ in of(found.shaft, found.journal)
        if concept.beam is not None
    )
    return found if not on or together else None


_TOGETHER = {"tilt": True, "motion": "transient", "rung": "reduced"}
"""Keys of films that are followed together with the shaft between them."""


CLEARANCES = Effect(
    "tilt in the clearances",
    model="shaft",
    keys=("shaft.two_point", "shaft.integrated", "shaft.direct_drive"),
    is_on=lambda scene: floats_in_films(scene.shaft, scene.journal),
    switched=lambda scene, on: switched(scene, on, floating),
    stated=lambda scene: stated(scene, floating),
    indicator=_indicator,
    larger=no_bound_at_standstill,
    smaller=20.0,  # 13 at 5 MW and 18 m/s, whose seed of 60 s swings less than is estimated
    out="films lie where rigid bearings hold the shaft, which tilts in their clearances",
    needs='a beam whose supports have stiffness = "journal" and takes_moment = true, with '
    'journal.tilt, motion = "transient" and rung = "reduced"; a thrust collar beside them must be '
    "self_aligning; a shaft that stands at times needs journal.contact",
    concerns=lambda scene: (
        scene.wants("journal")
        and any(one.beam is not None for _, one, _ in floating(scene.shaft, scene.journal))
    ),
    probe="journal",
)
