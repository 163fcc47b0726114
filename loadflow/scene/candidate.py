"""A candidate of a scene: an arrangement of bearings that is compared with others."""

from __future__ import annotations

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
    def places(self) -> tuple[str, ...]:
        """Places on the shaft that it needs."""
        journal = self.journal.bearings if self.journal else []
        rolling = self.rolling.geometries if self.rolling else ()
        return (*journal, *rolling, *(self.thrust.bearings if self.thrust else ()))
