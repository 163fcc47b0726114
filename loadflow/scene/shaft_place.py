"""Which shafts lie in the clearances of several journal bearings, and tilt or move with them."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from loadflow.journal.heat import Heat
from loadflow.journal.line import Line
from loadflow.journal.models.model import why_not
from loadflow.scene.journal import Journal
from loadflow.scene.shaft import Shaft
from loadflow.shaft import Concept

Found = Iterator[tuple[str, Concept, list[str]]]
Suspensions = Callable[[Shaft, Journal], Found]
"""Shaft and journal bearings → some of the suspensions: kind, suspension, its films."""


def floating(shaft: Shaft, journal: Journal) -> Found:
    """Yield suspensions whose shaft floats in two films or more: kind, suspension, its films.

    Loads lift a shaft in one bearing and press it down in the other, so that it tilts by up to
    both clearances over their distance. Where all of these bearings are self-aligning, it may.

    Parameters
    ----------
    shaft : Shaft
        The suspensions.
    journal : Journal
        The bearings.
    """
    for kind, concept in shaft.suspensions.items():
        films = films_of(concept, journal)
        if len(films) > 1 and set(films) & {*journal.tilting}:
            yield kind, concept, films


def on_seats(shaft: Shaft, journal: Journal) -> Found:
    """Yield suspensions with bearings that align themselves on seats that are stated."""
    for kind, concept in shaft.suspensions.items():
        films = films_of(concept, journal)
        if set(films) & {*journal.on_seats}:
            yield kind, concept, films


def films_of(concept: Concept, journal: Journal) -> list[str]:
    """Places of a suspension where films of journal bearings are."""
    return [name for name in concept.bearings if name in journal.bearings]


def floats_in_films(shaft: Shaft, journal: Journal) -> bool:
    """Whether all films that a shaft floats in are fed back to it; True where it floats in none."""
    return all(name in shaft.coupled for _, _, films in floating(shaft, journal) for name in films)


def move_together(shaft: Shaft, journal: Journal, concept: Concept) -> bool:
    """Whether shaft and films of a suspension are followed together.

    All its bearings are two journal bearings whose films the shaft's supports are, in motion, by
    the rung "reduced": with tilt, or on seats that hold the shaft.
    """
    if concept.beam is None or len(concept.bearings) != 2 or not journal.in_motion:
        return False
    films = [support.stiffness == "journal" for support in concept.beam.supports]
    if films != [True, True] or journal.rung != "reduced":
        return False
    tilting = journal.tilting if journal.tilt else ()
    known = set(concept.bearings) <= {*tilting, *seats_felt(shaft, journal, concept)}
    return known and all(_followable(journal.at(name)) for name in concept.bearings)


def any_moves_in_films(shaft: Shaft, journal: Journal) -> bool:
    """Whether some suspension has its shaft and films followed together."""
    return any(move_together(shaft, journal, concept) for concept in shaft.concepts)


def seats_felt(shaft: Shaft, journal: Journal, concept: Concept) -> list[str]:
    """Bearings of a suspension whose seats hold the shaft: their supports take a moment."""
    felt = {name for name, support in shaft.coupled.items() if support.takes_moment}
    return [name for name in concept.bearings if name in journal.on_seats and name in felt]


def _followable(options: Journal) -> bool:
    """Whether the loop knows the film of a bearing."""
    film, line = options.film_model, Line(tilt=np.zeros((1, 2)))
    plain = options.heat is None or isinstance(options.heat, Heat)
    return plain and why_not("in_motion", film, options.geometry, line) is None


def check_seats(shaft: Shaft, journal: Journal) -> None:
    """Refuse supports that are to take the moment of a seat which no shaft is followed in.

    Raises
    ------
    ValueError
        Naming the bearing, and what helps.
    """
    for concept in shaft.concepts:
        felt = seats_felt(shaft, journal, concept)
        if felt and not move_together(shaft, journal, concept):
            raise ValueError(
                f"shaft: support of bearing {felt[0]} with takes_moment = true: what a seat holds "
                "is followed where a shaft lies in two films, without heat over the area; "
                'give both its bearings supports of stiffness = "journal" and '
                "takes_moment = true, and those that align themselves a seat, or leave out "
                "takes_moment"
            )


def overlapping(shaft: Shaft, journal: Journal) -> Iterator[str]:
    """Say which journal bearings of a suspension are wider than the distance between them.

    Parameters
    ----------
    shaft : Shaft
        The suspensions.
    journal : Journal
        The bearings.

    Examples
    --------
    >>> from loadflow.scene import Journal
    >>> from loadflow.scene.shaft import Shaft
    >>> from loadflow.shaft import TwoPoint
    >>> print(*overlapping(Shaft(two_point=TwoPoint(span=2.0)), Journal()))
    bearings N, N2: 2.25 m and 2.25 m wide, 2 m apart: they overlap by 0.25 m along the shaft
    """
    for concept in shaft.concepts:
        where = dict(zip(concept.bearings, concept.positions))
        places = [name for name in concept.bearings if name in journal.bearings]
        for one, other in pairwise(places):
            widths = [journal.at(name).geometry.width for name in (one, other)]
            apart = where[other] - where[one]
            if (over := sum(widths) / 2 - apart) > 0:
                yield (
                    f"bearings {one}, {other}: {widths[0]:g} m and {widths[1]:g} m wide, "
                    f"{apart:.3g} m apart: they overlap by {over:.2g} m along the shaft"
                )
