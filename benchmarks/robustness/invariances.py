"""What no result may depend on: units, the mirror, the company of its load, the way to it.

python -m benchmarks.robustness.invariances [--draws N] [--first I] [FAMILY …]

Bearings of `benchmarks.robustness.families` are asked again

- in other units: every length, pressure and time that their user states times a factor;
- in a mirror: the second axis the other way, and with it speed, load, line, bore and grooves;
- in company: after a lighter load in the same series;
- the other way: for the load that the film carries at the position found.

Each must have an answer where the draw has one, and the same numbers. Printed: every one that does
not, then the count of each family.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.common import arguments
from benchmarks.robustness.clock import Clock, Late
from benchmarks.robustness.families import FAMILIES, SEEDS, draw_point
from loadflow.errors import LoadflowError
from loadflow.journal import (
    Arc,
    ConicalBearing,
    ConicalPair,
    Contour,
    Film,
    Groove,
    JournalBearing,
    Lobes,
    Lubricant,
    Recess,
    ThrustBearing,
    TiltingPads,
)

Array = NDArray[np.float64]
Units = tuple[float, float, float]

UNITS: tuple[Units, ...] = ((0.01, 1.0, 1.0), (8.0, 1.0, 1.0), (1.0, 1e3, 1.0), (1.0, 1.0, 1e3))
TOLERANCE = 1e-6  # of the scaled residual 1e-10 of heavy loads, whose stiffness is large
CAP = 20.0  # s of processor time

_LENGTHS = "diameter width inner_radius outer_radius taper slant clearance distance height length"
_LENGTHS += " depth z axial outer_diameter thickness roughness summit_height"
_PRESSURES = "edge_pressure groove_pressure pressure tank_pressure modulus contact_modulus"
_PRESSURES += " mixing_constant cavitation_pressure"
DIMENSIONS = (  # of lengths, pressures and times
    dict.fromkeys(_LENGTHS.split(), (1, 0, 0))
    | dict.fromkeys(_PRESSURES.split(), (0, 1, 0))
    | {"viscosity": (0, 1, 1), "density": (-2, 1, 2), "compliance": (1, -1, 0)}
    | {"flow": (3, 0, -1), "force": (2, 1, 0), "moment": (3, 1, 0), "bend": (-1, 0, 0)}
    | {"speed": (0, 0, -1), "time": (0, 0, 1)}
)
_VALUES = {  # of a result, each over what it is measured by
    "eccentricity": (1, 0, 0), "minimum_film": (1, 0, 0),
    "maximum_pressure": (0, 1, 0), "friction_power": (3, 1, -1),
}  # fmt: skip


@dataclass(frozen=True)
class Asked:
    """What a draw asks of a bearing: a verb and its arguments."""

    bearing: Any
    verb: str
    film: Film
    given: dict[str, Any]
    options: dict[str, Any]

    def answer(self) -> Any:
        """The result."""
        return getattr(self.bearing, self.verb)(film=self.film, **self.given, **self.options)

    @property
    def held(self) -> dict[str, Any]:
        """What is given of the shaft's line."""
        return {name: self.given[name] for name in ("tilt", "bend") if name in self.given}


def asked(family: str, number: int) -> Asked:
    """What draw `number` of a family asks."""
    point = draw_point(np.random.default_rng([SEEDS[family], number]))
    work, seen = FAMILIES[family](point), []
    kinds = (JournalBearing, ThrustBearing, ConicalBearing, ConicalPair)
    verbs = {(kind, verb): getattr(kind, verb) for kind in kinds for verb in ("equilibrium",)}
    verbs[JournalBearing, "orbit"] = JournalBearing.orbit

    def catcher(verb: str) -> Any:
        def catch(self: Any, *values: Any, **keywords: Any) -> Any:
            names = ("time", "force", "speed", "film") if verb == "orbit" else _order(self)
            seen.append((self, verb, dict(zip(names, values)) | keywords))
            raise Late

        return catch

    try:
        for kind, verb in verbs:
            setattr(kind, verb, catcher(verb))
        work()
    except Late:
        pass
    finally:
        for (kind, verb), method in verbs.items():
            setattr(kind, verb, method)
    bearing, verb, values = seen[0]
    film = values.pop("film")
    if film is None or isinstance(film, Lubricant):
        names = [one.name for one in fields(Film) if one.name in values]
        film = Film(film, **{name: values.pop(name) for name in names})
    known = ("time", "force", "speed", "moment", "tilt", "bend")
    given = {name: np.asarray(values.pop(name)) for name in known if values.get(name) is not None}
    return Asked(bearing, verb, film, given, {k: v for k, v in values.items() if v is not None})


def _order(bearing: Any) -> tuple[str, ...]:
    pair = isinstance(bearing, ConicalPair)
    return ("force", "moment", "speed", "film") if pair else ("force", "speed", "film")


def in_units(case: Asked, units: Units) -> Asked:
    """The same in units of other lengths, pressures and times; heat has units of its own."""
    bearing, film = _scaled(case.bearing, units), _scaled(case.film, units)
    given = {name: value * _factor(name, units) for name, value in case.given.items()}
    return replace(case, bearing=bearing, film=film, given=given)


def _factor(name: str, units: Units) -> float:
    powers = DIMENSIONS.get(name, (0, 0, 0))
    return float(np.prod([unit**power for unit, power in zip(units, powers)]))


def _scaled(thing: Any, units: Units, name: str = "") -> Any:
    """A description with every number in other units."""
    if isinstance(thing, (list, tuple)):
        return tuple(_scaled(one, units, name) for one in thing)
    if is_dataclass(thing):
        parts = {one.name: getattr(thing, one.name) for one in fields(thing) if one.init}
        return replace(thing, **{key: _scaled(one, units, key) for key, one in parts.items()})
    return thing * _factor(name, units) if isinstance(thing, float) else thing


def mirrored(case: Asked) -> Asked | None:
    """The same with the second axis the other way; None of rows of pads, which face one way."""
    if not isinstance(case.bearing, JournalBearing):
        return None
    shape = case.bearing.shape
    if isinstance(shape, (Lobes, TiltingPads)):
        shape = replace(shape, angle=-shape.angle, offset=1.0 - shape.offset)
    elif isinstance(shape, Arc):
        shape = replace(shape, angle=-shape.angle)
    relief = tuple(_turned(one) for one in case.bearing.relief)
    film, across = case.film, np.array([1.0, -1.0])
    if film.supply is not None:
        grooves = tuple(_turned(one) for one in film.supply.grooves)
        film = replace(film, supply=replace(film.supply, grooves=grooves))
    signs = {"force": across, "bend": across, "moment": -across, "tilt": -across, "speed": -1.0}
    given = {name: value * signs.get(name, 1.0) for name, value in case.given.items()}
    bearing = replace(case.bearing, shape=shape, relief=relief)
    return replace(case, bearing=bearing, film=film, given=given)


def _turned(part: Any) -> Any:
    """A groove or relief seen in the mirror."""
    if isinstance(part, Contour):
        angle = -np.asarray(part.angle) % (2 * np.pi)
        order = np.argsort(angle)
        return replace(
            part, angle=angle[order].tolist(), height=np.array(part.height)[order].tolist()
        )
    return replace(part, angle=-part.angle) if isinstance(part, (Groove, Recess)) else part


def numbers(
    result: Any, units: Units = (1.0, 1.0, 1.0), mirror: bool = False, of: int | None = None
) -> dict[str, Array]:
    """Place, film, pressure and friction of a result, as in units and frame of the draw.

    Of a series those of load number `of`.
    """
    found = {}
    for name, powers in _VALUES.items():
        if hasattr(result, name):
            value = np.asarray(getattr(result, name), dtype=float)
            value = value if of is None else value[of]
            found[name] = value / np.prod([unit**power for unit, power in zip(units, powers)])
    if mirror and "eccentricity" in found:
        found["eccentricity"] = found["eccentricity"] * [1.0, -1.0]
    return found


def solved(case: Asked) -> tuple[Any, str]:
    """The answer, or None and why there is none."""
    try:
        with Clock(CAP):
            return case.answer(), ""
    except Late:
        return None, "late"
    except LoadflowError as error:
        return None, str(error)


def broken(case: Asked) -> Iterator[str]:
    """What a case breaks, each with how far its numbers are off."""
    first, why = solved(case)
    others: list[tuple[str, Asked | None, Units, bool]] = [
        (f"in units {units}", None if case.film.heat else in_units(case, units), units, False)
        for units in UNITS
    ]
    others.append(("in the mirror", mirrored(case), (1.0, 1.0, 1.0), True))
    for name, other, units, mirror in others:
        if other is None:
            continue
        again, why_not = solved(other)
        if (again is None) != (first is None):
            yield f"{name}: {why or 'answered'}, and {why_not or 'answered'}"
        elif first is not None:
            yield from _apart(name, numbers(first), numbers(again, units, mirror))
    if first is None or case.verb != "equilibrium" or not isinstance(case.bearing, JournalBearing):
        return
    yield from _in_company(case, first)
    if "moment" not in case.given and case.film.heat is None:
        yield from _other_way(case, first)


def _apart(name: str, one: dict[str, Array], other: dict[str, Array]) -> Iterator[str]:
    """Each quantity that differs, over its largest value."""
    for key, value in one.items():
        off = float(np.abs(value - other[key]).max() / max(np.abs(value).max(), 1e-300))
        if not off < TOLERANCE:
            yield f"{name}: {key} {off:.1e} off"


def _in_company(case: Asked, alone: Any) -> Iterator[str]:
    """The load after a lighter one."""
    given = {name: np.stack([value, value]) for name, value in case.given.items() if value.ndim}
    given["force"] = given["force"] * np.array([[0.3], [1.0]])
    both = replace(case, given=case.given | given, options=case.options | {"strict": False})
    series, why = solved(both)
    if series is None or not series.converged[1]:
        yield f"in company: {why or 'no answer'}"
        return
    yield from _apart("in company", numbers(alone), numbers(series, of=1))


def _other_way(case: Asked, found: Any) -> Iterator[str]:
    """The load of the film at the position found, on the cells that it was found on."""
    place = {"eccentricity": found.eccentricity, "speed": case.given["speed"], **case.held}
    if case.film.shell is not None:
        return  # which may have two films at one position
    field, why = solved(replace(case, verb="pressure", given=place))
    if field is None:
        yield f"at its position: {why}"
        return
    if not (found.resolved and field.resolved):
        return  # loads that the cells do not resolve are solved on others
    off = np.hypot(*(field.force - case.given["force"])) / np.hypot(*case.given["force"])
    if not off < TOLERANCE:
        yield f"at its position: {off:.1e} of the load off"


def main() -> None:
    """Draw and print what is broken."""
    parser = arguments(__doc__)
    parser.add_argument("families", nargs="*", default=list(FAMILIES), metavar="FAMILY")
    parser.add_argument("--draws", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    for family in given.families:
        count = 0
        for number in range(given.first, given.first + given.draws):
            for text in broken(asked(family, number)):
                count += 1
                print(f"{family} {number} {text}", flush=True)
        print(f"{family}: {count} broken of {given.draws} draws", flush=True)


if __name__ == "__main__":
    main()
