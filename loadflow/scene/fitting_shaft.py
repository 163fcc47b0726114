"""Section of an elastic shaft that a scene does not state: as wide as its journal bearings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, Self

from pydantic import (
    BaseModel,
    ModelWrapValidatorHandler,
    PrivateAttr,
    ValidationError,
    model_validator,
)

from loadflow.scene.journal import Journal
from loadflow.scene.shaft import SWINGING

BORE = 0.5
"""Bore over diameter, that of the forged shafts of the WindPACT turbines."""


def with_fitting_beams(shaft: Any, journal: Any) -> Any:
    """Complete the beams of a scene's shaft that state no section.

    In journal bearings the shaft is as wide as the narrowest of them: a thinner one would tilt far
    more than any that is built for these bearings.

    Parameters
    ----------
    shaft, journal : mapping
        The sections as the scene has them; what is wrong with them is told by their own checks.

    Returns
    -------
    mapping

    Examples
    --------
    >>> from loadflow.scene.fitting_shaft import with_fitting_beams
    >>> with_fitting_beams({"two_point": {"beam": {}}}, {"bearings": ["N", "N2"]})
    {'two_point': {'beam': {'sections': [{'outer_diameter': 3.0, 'inner_diameter': 1.5}]}}}
    """
    if not isinstance(shaft, dict):
        return shaft
    open_ones = [kind for kind, options in shaft.items() if _is_open(kind, options)]
    try:
        diameter = narrowest(Journal.model_validate(journal)) if open_ones else 0.0
    except ValidationError:
        return shaft
    beams = {
        kind: shaft[kind] | {"beam": {"sections": [_section(diameter)]} | shaft[kind]["beam"]}
        for kind in open_ones
    }
    return shaft | beams


class WithFittingBeams(BaseModel):
    """A scene that knows which beams of its shaft stated no section as it was read.

    It is no key: a scene as resolved states the sections, and its digest is that of them.
    """

    _open_beams: tuple[str, ...] = PrivateAttr(default=())

    @model_validator(mode="wrap")
    @classmethod
    def _remember_open_beams(cls, data: Any, read: ModelWrapValidatorHandler[Self]) -> Self:
        shaft = data.get("shaft") if isinstance(data, dict) else None
        shaft = shaft if isinstance(shaft, dict) else {}
        scene = read(data)
        kinds = tuple(kind for kind, options in shaft.items() if _is_open(kind, options))
        scene._open_beams = kinds or scene._open_beams
        return scene

    def __eq__(self, other: object) -> bool:
        """Whether all keys are equal; how a scene was written makes no other of it."""
        if not isinstance(other, BaseModel):
            return NotImplemented
        return type(self) is type(other) and self.__dict__ == other.__dict__


def fitted(shaft: Mapping[str, Any], journal: Journal, open_beams: Sequence[str]) -> Iterator[str]:
    """Say which beams of a resolved shaft, as plain data, have the section that fits.

    Parameters
    ----------
    shaft : mapping
        By kind of suspension.
    journal : Journal
        The bearings.
    open_beams : sequence of str
        Suspensions whose beams stated no section.
    """
    diameter = narrowest(journal)
    for kind in open_beams:
        options = shaft.get(kind)
        beam = options.get("beam") if options else None
        if beam and beam["sections"] == [_section(diameter)]:
            yield (
                f"shaft.{kind}.beam: {diameter:.4g} m with a bore of {BORE * diameter:.4g} m, as "
                "wide as the journal bearings: what is taken where no sections are stated"
            )


def narrowest(journal: Journal) -> float:
    """The smallest diameter of the bearings, m."""
    return min(journal.at(place).geometry.diameter for place in journal.bearings)


def _is_open(kind: str, options: Any) -> bool:
    """Whether a suspension with bearings for films has a beam without sections."""
    beam = options.get("beam") if isinstance(options, dict) else None
    return kind not in ("moment", *SWINGING) and isinstance(beam, dict) and "sections" not in beam


def _section(diameter: float) -> dict[str, float]:
    return {"outer_diameter": diameter, "inner_diameter": BORE * diameter}
