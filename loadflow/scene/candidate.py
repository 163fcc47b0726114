"""A candidate of a scene: an arrangement of bearings that is compared with others."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from pydantic import BaseModel

from loadflow.scene.bearings import Rolling
from loadflow.scene.journal import Journal
from loadflow.scene.section import Section
from loadflow.scene.thrust import Thrust
from loadflow.scene.tolerances import Tolerances


class Candidate(Section, BaseModel):
    """An arrangement of bearings that is compared with others: what stands at its places.

    Attributes
    ----------
    title, source : str
        What it is called, and where its measures are from.
    journal, rolling, thrust
        Its bearings, as sections.
    tolerances : dict
        Of their values, by place and key.
    """

    title: str = ""
    source: str = ""
    journal: Journal | None = None
    rolling: Rolling | None = None
    thrust: Thrust | None = None
    tolerances: Tolerances = {}

    @property
    def bearings(self) -> dict[str, dict[str, Any]]:
        """Its bearings by room and place."""
        films, rolling, thrust = self.journal, self.rolling, self.thrust
        return {
            "journal": {place: films.at(place) for place in films.bearings} if films else {},
            "rolling": dict(rolling.bearings) if rolling else {},
            "thrust": dict(thrust.bearings) if thrust else {},
        }

    @property
    def places(self) -> tuple[str, ...]:
        """Places on the shaft that it needs."""
        return tuple(place for room in self.bearings.values() for place in room)

    def rooms_of(self, others: Iterable[Candidate]) -> set[str]:
        """Rooms that it has bearings in, all of them as they are in one of the others."""
        known = [other.bearings for other in others]
        return {
            room
            for room, parts in self.bearings.items()
            if parts
            and all(any(o[room].get(p) == part for o in known) for p, part in parts.items())
        }
