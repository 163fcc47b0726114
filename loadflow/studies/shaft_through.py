"""The shaft of a suspension, as wide as its bearings let it be, and how it tilts in them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.scene.bearings import Rolling
from loadflow.scene.fitting_shaft import BORE, narrowest
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Candidate, Scene
from loadflow.scene.shaft import Shaft
from loadflow.shaft import Beam, ShaftSection, bearing_loads
from loadflow.shaft.options import Concept
from loadflow.stages.bores import in_bore

Array = NDArray[np.float64]

_LIE = ("tilt", "curvature")
_LOAD = 1e6  # N, N m: what bends a shaft about as much as its weight does

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
    tightest = min(shares, default=1.0)
    scale = tightest if follows else min(tightest, 1.0)
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
    in_films : bool
        Whether films are solved around the shaft as it lies, as runs of a scene with an accuracy
        do; else those of bearings that do not say so are aligned, and its tilt is a condition.
    """

    name: str
    concept: Concept
    gravity: float
    follows: bool
    in_films: bool

    @classmethod
    def of(cls, scene: Scene, places: tuple[str, ...]) -> BentShaft | None:
        """The shaft in bearings at `places`; None where none bends between two of them."""
        from loadflow.turbines import load_turbine

        for name, concept in scene.shaft.suspensions.items():
            own = set(concept.bearings) & set(places)
            if own and concept.beam is not None and len(concept.bearings) > 1:
                fitting = hollow_shaft(narrowest(scene.journal)).sections
                gravity = load_turbine(scene.turbine.name).rotor.tilt
                follows = concept.beam.sections == fitting
                return cls(name, concept, gravity, follows, scene.asks)
        return None

    def fitting(self, candidate: Candidate) -> Concept:
        """The suspension with a beam that passes through the bearings of a candidate."""
        widths = shaft_widths(candidate.journal, candidate.rolling)
        return through(self.concept, widths, self.follows)

    def lying(self, candidate: Candidate, place: str, samples: xr.Dataset) -> xr.Dataset:
        """Samples of a place with `tilt` and `curvature` of the shaft that fits a candidate.

        And the `alignment` of its bore. The shaft is that which bends: how it tilts in the
        clearances of a candidate is left out.

        Parameters
        ----------
        candidate : Candidate
            The bearings.
        place : str
            One of them.
        samples : xarray.Dataset
            Of `loadflow.studies.lifetime.load_spectrum.load_spectrum`, of that place.
        """
        fits = self.fitting(candidate)
        if fits is not self.concept or self._floats:
            before, after = (
                _bent(one, self.gravity, place, samples) for one in (self.concept, fits)
            )
            # what supports and housings do stands in the samples; the beam alone is another one,
            # and so are the clearances that it floats in
            changed = {}
            for name in _LIE:
                bent = after[name] if self._floats else after[name] - before[name]
                more = xr.DataArray(bent, dims=("axis", "sample"))
                known = xr.zeros_like(samples[name]) if self._floats else samples[name]
                changed[name] = known + more
            samples = samples.assign(changed)
        journal = candidate.journal
        if journal is None or place not in journal.bearings:
            return samples
        return in_bore(samples, journal.at(place))

    @property
    def _floats(self) -> bool:
        """Whether the shaft of the samples lies in films of its own, beside those of candidates."""
        assert self.concept.beam is not None
        return any(support.stiffness == "journal" for support in self.concept.beam.supports)


def fitting_shaft(scene: Scene, candidate: Candidate) -> Shaft:
    """The shaft of a scene with a beam that passes through the bearings of a candidate."""
    bent = BentShaft.of(scene, candidate.places)
    if bent is None:
        return scene.shaft
    return scene.shaft.model_copy(update={bent.name: bent.fitting(candidate)})


def _bent(concept: Concept, gravity: float, place: str, samples: xr.Dataset) -> dict[str, Array]:
    """Tilt, rad, and curvature, 1/m, of the shaft in a bearing under the hub loads of samples."""
    assert concept.beam is not None
    rigid = replace(concept, beam=concept.beam.free_in_films().on_rigid_bearings())
    loads = np.concatenate(
        [samples[name].transpose("axis", "sample").values for name in ("hub_force", "hub_moment")]
    )
    return {
        name: still[:, None] + by_load @ loads
        for name, (still, by_load) in _response(rigid, gravity)[place].items()
    }


@lru_cache(maxsize=64)  # the shaft of a scene is asked for each design
def _response(concept: Concept, gravity: float) -> dict[str, dict[str, tuple[Array, Array]]]:
    """Tilt and curvature in each bearing, which are linear in the hub's forces and moments.

    By place and name: those under the weight alone (3,), and by each load (3, 6), per N and N m.
    """
    loads = _LOAD * np.eye(6, 7, k=1)
    found = bearing_loads(concept, loads[:3], loads[3:], tilt=gravity)
    response: dict[str, dict[str, tuple[Array, Array]]] = {}
    for place in concept.bearings:
        response[place] = {}
        for name in _LIE:
            values = found[name].sel(bearing=place).transpose("axis", "time").values.astype(float)
            response[place][name] = values[:, 0], (values[:, 1:] - values[:, :1]) / _LOAD
    return response
