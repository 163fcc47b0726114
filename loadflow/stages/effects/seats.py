"""Effects of the seats on which bearings align themselves: what they leave of the shaft's slope.

A seat passes no more than its own moment, so that a film is tilted by the lesser of two things: by
all of the slope, as if the seat stuck, or by what that moment presses against the film.
"""

from __future__ import annotations

import numpy as np

from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import films_of, move_together, on_seats, seats_felt
from loadflow.shaft import Concept
from loadflow.stages.effects.clearances import (
    CLEARANCES,
    Place,
    place_of,
    slopes,
    stated,
    switched,
)
from loadflow.stages.effects.effect import UNKNOWN, Effect, Sizes
from loadflow.stages.effects.film_sizes import largest
from loadflow.stages.effects.situation import Floats, Situation


def shaft_slopes(at: Situation, name: str) -> Floats:
    """Largest slope, (5, n), rad, of the shaft in a bearing: bent, and in the clearances of films.

    Rows are those of `slopes`: under the mean load, and pushed either way. 0 in the clearances
    where it stands.
    """
    concept = _concept(at, name)
    films, bent = films_of(concept, at.scene.journal), at.bearings[name].slope
    if len(films) < 2:
        return np.tile(bent, (5, 1))
    slope, _ = slopes(at, concept, films)
    return np.nan_to_num(np.linalg.norm(slope, axis=-1)) + bent


def place_on_seat(at: Situation, name: str) -> Place:
    """Where a film lies, (5, n), pushed as it is where the shaft has the slopes of `slopes`."""
    films = films_of(_concept(at, name), at.scene.journal)
    return place_of(at, name, (-1.0) ** films.index(name))


def _concept(at: Situation, name: str) -> Concept:
    concept = at.scene.shaft.concept_at(name)
    assert concept is not None
    return concept


def _films(at: Situation) -> Sizes:
    """What slope or seat takes of the film: 0.5 x² or exp(18 m) − 1 of what is left, the lesser.

    x is slope × width / (2 film): what a seat that sticks closes at one end. m is the moment that
    the seat passes at most, over load × width. Films of B/D from 0.4 to 1 at ε from 0.5 to 0.93,
    tilted by a moment in the plane of the load or across it, are exp(−8 m) to exp(−33 m) as thick
    as aligned ones. Nothing where the shaft stands, and lies on its shell.
    """
    journals = {name: at.scene.journal.at(name) for name in at.scene.journal.bearings}
    return largest([_film(at, name, one) for name, one in journals.items() if one.seat is not None])


def _film(at: Situation, name: str, own: Journal) -> Sizes:
    assert own.seat is not None
    lies, slope, width = place_on_seat(at, name), shaft_slopes(at, name), own.geometry.width
    # a shaft that stands has no film: its slope closes nothing
    stuck = np.nan_to_num(0.5 * slope * width / lies.film)
    passed = own.seat.largest_moment(lies.load, slope) / (np.maximum(lies.load, 1.0) * width)
    passed = np.minimum(passed, MOST)
    pressed = np.minimum(0.06 * stuck**2, 55.0 * passed**2)
    thinner = np.minimum(0.5 * stuck**2, np.expm1(18.0 * passed))
    film = np.where(np.isfinite(lies.film), lies.film, np.inf)
    aligned, left = film.min(axis=0), (film / (1.0 + thinner)).min(axis=0)
    there = np.isfinite(aligned)
    sizes = {
        "eccentricity ratio": np.minimum(0.03 * stuck, 0.5 * passed),
        "minimum film": aligned[there] / left[there] - 1.0,
        "maximum pressure": pressed / (1.0 + pressed),
        "friction power": np.minimum(0.04 * stuck, 1.3 * passed),
    }
    return {quantity: float(size.max(initial=0.0)) for quantity, size in sizes.items()}


MOST = 0.25
"""Moment over load × width from which the ends of a film touch, whatever the seat passes."""


def _collars(at: Situation) -> Sizes:
    """What slope or seat takes of the films of a collar: x (1 + 0.15 x) of what is left.

    x is slope × outer radius / film, as if the seat stuck, but no more than the moment of the seat
    presses: m / (1 − 0.55 m), with m that moment over thrust × outer radius. Solved films of
    tapered lands have that of a slope within 5 %, and the moment within 20 % up to x = 1.
    """
    found = []
    for place, films in at.collars.items():
        collar, load = at.scene.thrust.collars[place], at.bearings[place]
        if collar.seat is None:
            continue
        slope, outer = shaft_slopes(at, place).max(axis=0), collar.geometry.outer_radius
        thrust = np.maximum(np.abs(load.force[:, 0]), 1.0)
        passed = np.minimum(collar.seat.largest_moment(thrust, slope) / (thrust * outer), 1.5)
        for k, film in enumerate(films):
            if film is None:  # none carries the load, or the collar stands, and has none to move
                found.append(dict.fromkeys(_OF_COLLARS, float(at.turns[k])))
                continue
            stuck = float(slope[k]) * outer / film.minimum_film
            x = min(stuck, float(passed[k] / (1.0 - 0.55 * passed[k])))
            found.append(
                {
                    "minimum film": x * (1.0 + 0.15 * x),
                    "maximum pressure": 2.7 * x / (1.0 + 2.7 * x),
                    "friction power": 0.1 * x,
                }
            )
    return largest(found)


_OF_COLLARS = ("minimum film", "maximum pressure", "friction power")


def _followed(scene: Scene) -> bool:
    """Whether all shafts in films on seats are followed with them.

    Plans choose section by section: that of the shaft says so, as far as the films can be.
    """
    found = [concept for _, concept, _ in on_seats(scene.shaft, scene.journal)]
    felt = {name for concept in found for name in seats_felt(scene.shaft, scene.journal, concept)}
    chosen = scene.journal.in_motion and scene.journal.rung == "reduced"
    together = all(move_together(scene.shaft, scene.journal, concept) for concept in found)
    return felt == {*scene.journal.on_seats} and (together or not chosen)


SEATS = Effect(
    "seats of the bearings",
    model="shaft",
    keys=CLEARANCES.keys,
    is_on=_followed,
    switched=lambda scene, on: switched(scene, on, on_seats),
    stated=lambda scene: stated(scene, on_seats),
    indicator=_films,
    larger=lambda scene: UNKNOWN,  # films that carry little in motion are stirred by small moments
    smaller=15.0,
    out="shells follow the shaft at once and all the way, whatever their seats resist with",
    needs="what tilt in the clearances does: two journal bearings, their films as supports of a "
    'beam with takes_moment, journal.motion = "transient" and rung = "reduced"',
    concerns=lambda scene: scene.wants("journal") and bool(scene.journal.on_seats),
    probe="journal",
)

OF_COLLARS = Effect(
    "seats of the collars",
    model="thrust",
    keys=(),
    is_on=lambda scene: False,
    switched=lambda scene, on: None if on else scene,
    indicator=_collars,
    out="pads follow the collar at once and all the way, whatever their seats resist with",
    needs="films of pads that are tilted by what a seat leaves, which scenes do not have; a seat "
    "of less friction, radius or stiffness would leave less",
    concerns=lambda scene: (
        scene.wants("thrust") and any(one.seat is not None for one in scene.thrust.collars.values())
    ),
    solves=True,
    smaller=15.0,
)
