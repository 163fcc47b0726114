"""Which shafts lie in the clearances of several journal bearings, and so tilt in them."""

from __future__ import annotations

from collections.abc import Callable, Iterator

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
