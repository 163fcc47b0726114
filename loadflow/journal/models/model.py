"""What a model of the film offers, how it is found, and what it is not asked for."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal, Protocol, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.journal.film.gap.grooves import on_one_segment
from loadflow.journal.film.heat.ring_growth import OPEN, RUNS_ROUND
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.questions import AtPosition, AtRest, InMotion, Steps
from loadflow.journal.rungs import FEATURES, RUNGS, Rung
from loadflow.journal.shapes import Shape

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Verb = Literal["at_rest", "in_motion", "at_position"]

_KEEPS_MASS = "a law that conserves mass, such as MassConserving, with heat over the area"


class Model(Protocol):
    """What a rung offers; a module, or an object of one."""

    def equilibrium(self, asked: AtRest) -> dict[str, Any]:
        """Return the fields of `Equilibrium`, n leading."""

    def pressure(self, asked: AtPosition) -> tuple[dict[str, Any], Array]:
        """Return the fields of `FilmField`, n leading; the axial places of the cells (m) apart."""

    def orbit(self, asked: InMotion) -> xr.Dataset:
        """Return the Dataset of `JournalBearing.orbit`."""


_WITHOUT = {"inlet": "; inlet = None leaves it out"}
"""What a default that a rung does not know is left out by."""


def why_not(
    verb: Verb, film: Film, bearing: JournalGeometry, line: Line, steps: Steps | None = None
) -> str | None:
    """Say why the rung of a film cannot do what it is asked for; None where it can.

    The words name what the rung does not know, and the rungs that do.
    """
    rung = RUNGS[film.rung]
    known: frozenset[str] | None = getattr(rung, verb)
    if known is None:
        why = rung.words if verb == "in_motion" else f"{_having(verb)} for a field of pressure"
        return f'rung = "{rung.name}" is not allowed: {why}'
    for name, value in _asked(verb, film, bearing, line, steps or Steps()).items():
        if name not in known:
            return (
                f"rung = {rung.name!r} is not allowed: {_having(verb, name)} for "
                f"{FEATURES[name]}; {name} = {value!r}{_WITHOUT.get(name, '')}"
            )
    for name, value, apart, allowed in _pairs(verb, film, bearing, line, steps or Steps()):
        if value is not None and apart:
            return f"{name} = {value!r} is not allowed: {allowed}"
    if film.heat is not None and film.heat.over_area and not film.law.keeps_mass:
        return f"cavitation = {film.law!r} is not allowed: {_KEEPS_MASS}"
    return None if rung.law is None else _not_its_own(rung, film)


def model_of(
    verb: Verb, film: Film, bearing: JournalGeometry, line: Line, steps: Steps | None = None
) -> Model:
    """Return the model of a film, if it can do what it is asked for.

    Raises
    ------
    loadflow.errors.InputError
        As `why_not` says.
    """
    why = why_not(verb, film, bearing, line, steps)
    if why is not None:
        raise InputError(why)
    module, _, name = RUNGS[film.rung].place.partition(":")
    found = import_module(module)
    return cast("Model", getattr(found, name) if name else found)


def _asked(
    verb: Verb, film: Film, bearing: JournalGeometry, line: Line, steps: Steps
) -> dict[str, Any]:
    """What a model must know, of `FEATURES`, and its value."""
    own = RUNGS[film.rung].law is not None  # such a model has its own inlet, and no mesh
    cut = any(any(part.steps(bearing.width)) for part in bearing.relief)
    crowned = all(part.even_around for part in bearing.relief)
    wanted: dict[str, Any] = {
        _kind_of_heat(film, verb): film.heat,
        "shape": bearing.shape if bearing.shape.segments else None,
        "relief" if cut else "crown" if crowned else "contour": bearing.relief or None,
        "moment": line.moment,
        "tilt": line.tilt,
        "bend": line.bend,
        "supply": film.supply,
        "local_shell" if film.shell is not None and film.shell.local else "shell": film.shell,
        "contact": film.contact,
        "turbulence": film.turbulence,
        "pressure_coefficient": film.liquid.pressure_coefficient or None,
        "step": None if steps.step == "given" else steps.step,
        "periodic": steps.periodic or None,
    }
    asked = {name: value for name, value in wanted.items() if value is not None}
    if film.inlet_line and not own and (film.inlet != "auto" or not bearing.shape.segments):
        asked["inlet"] = film.inlet
    if film.grading == "graded" and not own:
        asked["grading"] = film.grading
    return asked


def _pairs(
    verb: Verb, film: Film, bearing: JournalGeometry, line: Line, steps: Steps
) -> Iterator[tuple[str, Any, bool, str]]:
    """What does not go with another part: name, value, whether that is there, words."""
    pads, growth = bearing.has_pads, getattr(film.heat, "growth", None)
    stored = _kind_of_heat(film, verb) == "slow_heat"
    if film.rung == "reduced" and not bearing.shape.grooves_between:
        pressure = bearing.pressure_between(film.edge_pressure)
        at_ends = f"{film.edge_pressure} Pa, that of the bearing ends, beside an arc on "
        words = at_ends + 'rung = "reduced"; rung = "grid" knows others'
        yield "shape.groove_pressure", pressure, pressure != film.edge_pressure, words
    if film.rung == "reduced" and verb == "in_motion":
        uneven = not all(part.even_around for part in bearing.relief)
        alike = 'one that is alike all around for pads in motion on rung = "reduced"'
        yield "relief", bearing.relief, pads and uneven, alike
    if film.rung == "reduced" and film.supply is not None:
        yield from _beside_grooves(verb, film, bearing)
    over_area = film.heat is not None and film.heat.over_area
    of_pads = film.heat is not None and film.heat.of_pads
    yield "heat", film.heat, of_pads, "a Heat or FilmHeat: a PadHeat is of thrust bearings"
    if film.rung == "reduced":
        closed, given = bool(steps.periodic), '"given" on a closed path on rung = "reduced"'
        yield "step", "adaptive", closed and steps.step == "adaptive", given
    if verb == "in_motion":
        one = "without capacity on a closed path"
        yield "heat", film.heat, stored and bool(steps.periodic), one
        free = stored and growth is not None and (pads or line.moment is not None)
        one = "without growth where pads or a shaft tilt freely, or without capacity"
        yield "heat", film.heat, free, one
    one = "None on a map, which has one clearance"
    yield "heat.growth", growth, growth is not None and film.rung == "map", one
    yield "heat.growth", growth, pads and over_area, "None for pads, whose backs are not held"
    yield "heat.growth", growth, over_area and _ends(bearing.shape), RUNS_ROUND
    settled = getattr(film.heat, "stiffness", "") == "settled"
    yield "heat.stiffness", "settled", settled and pads, '"frozen" for pads that tilt'
    yield "shell", film.shell, pads, "None for pads, whose backs are not held"
    yield "contact", film.contact, pads, "None for pads that tilt"
    thick = film.liquid.pressure_coefficient > 0.0
    words = "None with a pressure_coefficient, by which the viscosity rises"
    yield "turbulence", film.turbulence, thick, words
    yield "turbulence", film.turbulence, over_area, "None with heat over the area"
    allowed = 'None with heat that is stored, but on rung = "reduced"'
    yield "turbulence", film.turbulence, stored and film.rung != "reduced", allowed


def _ends(shape: Shape) -> bool:
    """Whether there is no film along so much of a bore that its ring is not as warm as that."""
    if shape.grooves_between or not shape.segments:
        return False
    return 2 * np.pi - (shape.segments[-1].end - shape.segments[0].start) >= OPEN


def _beside_grooves(
    verb: Verb, film: Film, bearing: JournalGeometry
) -> Iterator[tuple[str, Any, bool, str]]:
    """What does not go with grooves on few points across the width; as `_pairs`."""
    supply, on_few = film.supply, 'on rung = "reduced"'
    assert supply is not None
    segments, cells = bearing.shape.segments, (film.cells[0], bearing.radius)
    for number, groove in enumerate(supply.grooves):
        name = f"supply.grooves[{number}]"
        yield f"{name}.shape", groove.shape, groove.shape == "circle", f'"rectangle" {on_few}'
        apart, within = not on_one_segment(groove, segments, *cells), "that of a groove within one"
        between = "what lies between them has shape.groove_pressure"
        words = f"{within} segment of the bore {on_few}; {between}"
        yield f"{name}.angle", groove.angle, apart, words
    moving = bearing.has_pads and verb == "in_motion"  # at rest they are of the grid
    yield "shape", bearing.shape, moving, f"one without pads beside a supply in motion {on_few}"


def _kind_of_heat(film: Film, verb: Verb) -> str:
    """Which of `FEATURES` the heat of a film is; what is stored counts in motion alone."""
    if film.heat is None or not film.heat.over_area:
        stored = verb == "in_motion" and getattr(film.heat, "capacity", None) is not None
        return "slow_heat" if stored else "heat"
    return "film_heat"


def _having(verb: Verb, feature: str | None = None) -> str:
    """Names of the rungs that know a feature, or have a verb at all."""
    having = []
    for rung in RUNGS.values():
        known: frozenset[str] | None = getattr(rung, verb)
        if known is not None and (feature is None or feature in known):
            having.append(f'"{rung.name}"')
    return " or ".join(having) or "no rung serves"


def _not_its_own(rung: Rung, film: Film) -> str | None:
    """Words for a law, ambient pressure or inlet that is not that of a model with its own film."""
    law = film.cavitation
    if law is not None and not (law.kind == rung.law and law.floor == film.edge_pressure):
        return (
            f"cavitation = {law!r} is not allowed: {rung.law} with its cavitation pressure at the "
            f'edge pressure, or None, with rung = "{rung.name}"'
        )
    if film.inlet not in ("auto", rung.inlet):
        allowed = f'{rung.inlet!r} or "auto" with rung = "{rung.name}"'
        return f"inlet = {film.inlet!r} is not allowed: {allowed}"
    return None
