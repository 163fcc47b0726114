"""Suspensions of another size by the laws of similarity ([Jonuschies 2015], (1.6)–(1.9))."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any, TypeVar

from loadflow.errors import InputError
from loadflow.shaft.beam import Beam, BearingSupport, ShaftSection
from loadflow.shaft.options import Concept
from loadflow.turbines.similarity import check_positive

_STIFFNESS = {
    "radial": 1, "housing_lateral": 1, "housing_vertical": 1, "tilt": 3, "housing_tilt": 3,
}  # fmt: skip
"""Power of φ of a support's stiffness, of the same material."""

Suspension = TypeVar("Suspension", bound=Concept)


def scaled_suspension(concept: Suspension, factor: float) -> Suspension:
    """The suspension with all lengths times a factor: masses φ³, stiffness φ, against tilting φ³.

    Parameters
    ----------
    concept : TwoPoint, ThreePoint, Integrated, DirectDrive or MomentBearing
        Of known size.
    factor : float
        φ, > 0.

    Returns
    -------
    Suspension
        Of the same class.

    Raises
    ------
    InputError
        A factor that is not positive and finite; a housing or frame given by a matrix.

    Examples
    --------
    >>> from loadflow.shaft import TwoPoint, scaled_suspension
    >>> larger = scaled_suspension(TwoPoint(), 2.0)
    >>> larger.span, larger.gearbox_mass
    (7.2, 480000.0)
    """
    check_positive("factor", factor)
    changed: dict[str, Any] = {}
    for field in fields(concept):
        value = getattr(concept, field.name)
        if field.name == "beam":
            changed["beam"] = None if value is None else _beam(value, factor)
        else:
            changed[field.name] = value * factor ** (3 if field.name.endswith("_mass") else 1)
    return replace(concept, **changed)


def _beam(beam: Beam, factor: float) -> Beam:
    if beam.matrices:
        raise InputError(
            f"{beam.matrices[0]}: a matrix of a file does not scale; leave it out, or give that of "
            "the other size afterwards"
        )
    return replace(
        beam,
        sections=tuple(_section(section, factor) for section in beam.sections),
        supports=tuple(_support(one, factor) for one in beam.supports),
    )


def _section(section: ShaftSection, factor: float) -> ShaftSection:
    length = None if section.length is None else factor * section.length
    return ShaftSection(factor * section.outer_diameter, factor * section.inner_diameter, length)


def _support(support: BearingSupport, factor: float) -> BearingSupport:
    known = {
        name: getattr(support, name) * factor**power
        for name, power in _STIFFNESS.items()
        if getattr(support, name) is not None
    }
    return replace(support, **known)
