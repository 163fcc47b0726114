"""The shaft of a suspension, as wide as its bearings let it be, and how it tilts in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import xarray as xr

from loadflow.scene.bearings import Rolling
from loadflow.scene.fitting_shaft import BORE, narrowest
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Candidate, Scene
from loadflow.scene.shaft import Shaft
from loadflow.shaft import Beam, ShaftSection, bearing_loads
from loadflow.shaft.options import Concept

_BORE_OF_ROLLING = 0.8
"""Diameter of the shaft in a rolling bearing over its pitch diameter, about that of large ones."""


def shaft_widths(journal: Journal | None, rolling: Rolling | None) -> dict[str, float]:
    """Diameter of the shaft that fits each bearing, m, by place."""
    found: dict[str, float] = {}
    if journal is not None:
        found |= {place: journal.at(place).geometry.diameter for place in journal.bearings}
    if rolling is not None:
        found |= {
            place: _BORE_OF_ROLLING * bearing.pitch_diameter
            for place, bearing in rolling.geometries.items()
        }
    return found


def through(concept: Concept, widths: Mapping[str, float], follows: bool = False) -> Concept:
    """A suspension whose beam passes through its bearings.

    A beam that is wider than a bearing is made narrower as a whole, its bore alike: what carries a
    design must be possible to build.

    Parameters
    ----------
    concept : Concept
        With a beam.
    widths : mapping
        Diameter of the shaft that fits each bearing, m, by place.
    follows : bool
        Whether the beam also grows with the bearings, as one does whose sections nobody stated.
    """
    beam = concept.beam
    assert beam is not None
    stretches = beam.stretches(concept.positions[-1])
    shares = [
        widths[place] / section.outer_diameter
        for place, position in zip(concept.bearings, concept.positions)
        for start, end, section in stretches
        if place in widths and start < position <= end
    ]
    scale = min(shares, default=1.0) if follows else min(1.0, *shares, 1.0)
    if scale == 1:
        return concept
    sections = tuple(
        replace(
            one,
            outer_diameter=scale * one.outer_diameter,
            inner_diameter=scale * one.inner_diameter,
        )
        for one in beam.sections
    )
    return replace(concept, beam=replace(beam, sections=sections))


def hollow_shaft(diameter: float) -> Beam:
    """A beam of that outer diameter, m, for a shaft that nobody stated."""
    return Beam(sections=(ShaftSection(diameter, BORE * diameter),))


@dataclass(frozen=True)
class BentShaft:
    """The shaft of a scene as a beam on two bearings, which must fit the bearings of each design.

    Attributes
    ----------
    name : str
        Of its suspension.
    concept : Concept
        The suspension as the scene has it.
    gravity : float
        Tilt of the shaft's axis against the horizontal, rad.
    follows : bool
        Whether it is as wide as the bearings, as its sections are not stated.
    """

    name: str
    concept: Concept
    gravity: float
    follows: bool

    @classmethod
    def of(cls, scene: Scene, places: tuple[str, ...]) -> BentShaft | None:
        """The shaft in bearings at `places`; None where none bends between two of them."""
        from loadflow.turbines import load_turbine

        for name, concept in scene.shaft.suspensions.items():
            own = set(concept.bearings) & set(places)
            if own and concept.beam is not None and len(concept.bearings) > 1:
                fitting = hollow_shaft(narrowest(scene.journal)).sections
                gravity = load_turbine(scene.turbine.name).rotor.tilt
                return cls(name, concept, gravity, concept.beam.sections == fitting)
        return None

    def fitting(self, candidate: Candidate) -> Concept:
        """The suspension with a beam that passes through the bearings of a candidate."""
        widths = shaft_widths(candidate.journal, candidate.rolling)
        return through(self.concept, widths, self.follows)

    def lying(self, candidate: Candidate, place: str, samples: xr.Dataset) -> xr.Dataset:
        """Samples of a place with `tilt` and `curvature` of the shaft that fits a candidate.

        Parameters
        ----------
        candidate : Candidate
            The bearings.
        place : str
            One of them.
        samples : xarray.Dataset
            Of `loadflow.studies.load_spectrum.load_spectrum`, of that place.
        """
        fits = self.fitting(candidate)
        if fits is self.concept:
            return samples
        before, after = (_bent(one, self.gravity, place, samples) for one in (self.concept, fits))
        # what supports and housings do stands in the samples; the beam alone is another one
        changed = {
            name: samples[name] + (after[name] - before[name]) for name in ("tilt", "curvature")
        }
        return samples.assign(changed)


def fitting_shaft(scene: Scene, candidate: Candidate) -> Shaft:
    """The shaft of a scene with a beam that passes through the bearings of a candidate."""
    bent = BentShaft.of(scene, candidate.places)
    if bent is None:
        return scene.shaft
    return scene.shaft.model_copy(update={bent.name: bent.fitting(candidate)})


def _bent(concept: Concept, gravity: float, place: str, samples: xr.Dataset) -> xr.Dataset:
    """Tilt and curvature of the shaft in a bearing under the hub loads of samples."""
    assert concept.beam is not None
    rigid = replace(concept, beam=concept.beam.on_rigid_bearings())
    force, moment = (
        samples[name].transpose("axis", "sample").values for name in ("hub_force", "hub_moment")
    )
    found = bearing_loads(rigid, force, moment, tilt=gravity).sel(bearing=place)
    return (
        found[["tilt", "curvature"]]
        .drop_vars(["bearing", "time"], errors="ignore")
        .rename(time="sample")
    )
