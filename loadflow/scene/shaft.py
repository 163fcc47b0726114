"""The section ``[shaft]`` of a scene: the suspensions, and the bearings that they have."""

from __future__ import annotations

from typing import Self

from pydantic import BaseModel, model_validator

from loadflow.scene.section import Section
from loadflow.shaft import PitchBearing, YawBearing, scaled_suspension
from loadflow.shaft.beam import BearingSupport
from loadflow.shaft.options import (
    Concept,
    DirectDrive,
    Integrated,
    MomentBearing,
    ThreePoint,
    TwoPoint,
)

SWINGING = ("yaw", "pitch")
"""Tables of bearings beside the shaft, which swing."""


class Shaft(Section, BaseModel):
    """Suspensions to compute; a table that is left out costs nothing.

    ``two_point``, ``integrated`` and ``direct_drive`` have the bearings N (floating) and N2
    (locating), ``three_point`` the bearing N and the gearbox's torque arms G; one of these at most.
    ``moment`` has the bearing M, ``yaw`` the yaw bearing Y under the nacelle, ``pitch`` the pitch
    bearing P of blade 1, with the loads of its root: rolling bearings that swing. With a ``beam``
    in its table the shaft bends, and tilts in its bearings; without ``sections`` it is as wide as
    the journal bearings. A support of the beam with ``stiffness = "journal"`` or ``"rolling"``
    gives under each load as the bearing of that kind that the scene has there. What the bearings
    stand on may be a matrix in a file: ``housing`` of a support, ``frame`` of the beam.
    """

    two_point: TwoPoint | None = None
    three_point: ThreePoint | None = None
    integrated: Integrated | None = None
    direct_drive: DirectDrive | None = None
    moment: MomentBearing | None = None
    yaw: YawBearing | None = None
    pitch: PitchBearing | None = None

    @property
    def suspensions(self) -> dict[str, Concept]:
        """The suspensions of the shaft that the scene has, by name."""
        fields = vars(self).items()  # plans ask often, and pydantic's own iteration is slow
        return {name: concept for name, concept in fields if concept and name not in SWINGING}

    @property
    def concepts(self) -> tuple[Concept, ...]:
        """The suspensions of the shaft that the scene has."""
        return tuple(self.suspensions.values())

    def concept_at(self, place: str) -> Concept | None:
        """The suspension with a bearing at a place; None where none has one."""
        return next((one for one in self.concepts if place in one.bearings), None)

    @property
    def bearings(self) -> tuple[str, ...]:
        """Names of the bearings that the scene has loads of."""
        beside = (getattr(self, name) for name in SWINGING)
        every = (*self.concepts, *(one for one in beside if one))
        return tuple(name for concept in every for name in concept.bearings)

    @model_validator(mode="after")
    def _each_bearing_once(self) -> Self:
        with_first = [n for n, concept in self.suspensions.items() if "N" in concept.bearings]
        if len(with_first) > 1:
            raise ValueError(f"{' and '.join(with_first)} all have a bearing N; keep one of them")
        return self

    def scaled(self, factor: float) -> Shaft:
        """The suspensions with all lengths times a factor, by similarity."""
        parts = {n: scaled_suspension(concept, factor) for n, concept in self.suspensions.items()}
        return Shaft.model_validate(parts)

    @property
    def coupled(self) -> dict[str, BearingSupport]:
        """Supports, by bearing, whose stiffness comes from a journal or rolling bearing."""
        return {
            name: support
            for concept in self.concepts
            if concept.beam is not None
            for name, support in zip(concept.bearings, concept.beam.supports)
            if support.stiffness != "given"
        }

    def bends_at(self, bearing: str) -> bool:
        """Whether the shaft is a beam there, so that its tilt in the bearing is known."""
        return any(c.beam is not None and bearing in c.bearings for c in self.concepts)
