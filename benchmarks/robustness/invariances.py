"""What no result may depend on: units, the mirror, the company of its load, the way to it.

python -m benchmarks.robustness.invariances [--draws N] [--first I] [FAMILY …]

Bearings of `benchmarks.robustness.families` are asked again

- in other units: every length, pressure and time that their user states times a factor;
- in a mirror: the second axis the other way, and with it speed, load, line, bore and grooves;
- turned by whole cells, with load, line, bore and grooves; and by an angle that moves cells, where
  what changes may be no more than the bounds of both say;
- in company: between a lighter and a heavier load of one series, in both orders;
- the other way: for the load that the film carries at the position found;
- there and back: for the place at which the load of a film at another place is carried.

Each must have an answer where the draw has one, and the same numbers. Printed: every one that does
not, then the count of each family. `--rung reduced` asks all of them of that rung.
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
CELLS = 7  # that a bearing is turned by
ASIDE = 0.777  # rad, of no count of cells

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


def turned(case: Asked, by: float) -> Asked | None:
    """The same, all of it turned by an angle, rad; None of what is no journal bearing."""
    if not isinstance(case.bearing, JournalBearing):
        return None
    shape = case.bearing.shape
    if isinstance(shape, (Arc, Lobes, TiltingPads)):
        shape = replace(shape, angle=_around(shape.angle + by))
    relief = tuple(_moved(one, by) for one in case.bearing.relief)
    film = case.film
    if film.supply is not None:
        grooves = tuple(_moved(one, by) for one in film.supply.grooves)
        film = replace(film, supply=replace(film.supply, grooves=grooves))
    cos, sin = np.cos(by), np.sin(by)
    matrix = np.array([[cos, -sin], [sin, cos]])
    along = ("force", "bend", "moment", "tilt")
    given = {name: x @ matrix.T if name in along else x for name, x in case.given.items()}
    bearing = replace(case.bearing, shape=shape, relief=relief)
    return replace(case, bearing=bearing, film=film, given=given)


def _moved(part: Any, by: float) -> Any:
    """A groove or relief farther around."""
    if isinstance(part, Contour):
        angle = (np.asarray(part.angle) + by) % (2 * np.pi)
        order = np.argsort(angle)
        return replace(
            part, angle=angle[order].tolist(), height=np.array(part.height)[order].tolist()
        )
    more = isinstance(part, (Groove, Recess))
    return replace(part, angle=_around(part.angle + by)) if more else part


def _around(angle: float) -> float:
    """The angle between -π and π, rad."""
    return float((angle + np.pi) % (2 * np.pi) - np.pi)


def on_reduced(case: Asked) -> Asked:
    """The same on the rung "reduced"."""
    return replace(case, film=replace(case.film, rung="reduced", inlet=None))


def numbers(
    result: Any,
    units: Units = (1.0, 1.0, 1.0),
    mirror: bool = False,
    by: float = 0.0,
    of: int | None = None,
) -> dict[str, Array]:
    """Place, film, pressure and friction of a result, as in units and frame of the draw.

    Of one that was turned `by` an angle, as before; of a series those of load number `of`.
    """
    found = {}
    for name, powers in _VALUES.items():
        if hasattr(result, name):
            value = np.asarray(getattr(result, name), dtype=float)
            value = value if of is None else value[of]
            found[name] = value / np.prod([unit**power for unit, power in zip(units, powers)])
    if mirror and "eccentricity" in found:
        found["eccentricity"] = found["eccentricity"] * [1.0, -1.0]
    if by and "eccentricity" in found:
        cos, sin = np.cos(by), np.sin(by)
        found["eccentricity"] = found["eccentricity"] @ np.array([[cos, -sin], [sin, cos]])
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
    whole = CELLS * 2.0 * np.pi / case.film.cells[0]
    others: list[tuple[str, Asked | None, dict[str, Any]]] = [
        (f"in units {units}", None if case.film.heat else in_units(case, units), {"units": units})
        for units in UNITS
    ]
    others.append(("in the mirror", mirrored(case), {"mirror": True}))
    others.append(("turned", turned(case, whole), {"by": whole}))
    for name, other, seen in others:
        if other is None:
            continue
        again, why_not = solved(other)
        if (again is None) != (first is None):
            yield f"{name}: {why or 'answered'}, and {why_not or 'answered'}"
        elif first is not None:
            yield from _apart(name, numbers(first), numbers(again, **seen))
    if first is None or case.verb != "equilibrium" or not isinstance(case.bearing, JournalBearing):
        return
    yield from _in_company(case, first)
    yield from _between_cells(case, first)
    if "moment" not in case.given and case.film.heat is None and case.film.shell is None:
        yield from _other_way(case, first)  # a shell may have two films at one position
        yield from _there_and_back(case, first)


def _apart(name: str, one: dict[str, Array], other: dict[str, Array]) -> Iterator[str]:
    """Each quantity that differs, over its largest value."""
    for key, value in one.items():
        off = float(np.abs(value - other[key]).max() / max(np.abs(value).max(), 1e-300))
        if not off < TOLERANCE:
            yield f"{name}: {key} {off:.1e} off"


def _in_company(case: Asked, alone: Any) -> Iterator[str]:
    """The load between a lighter and a heavier one, in both orders."""
    for name, shares in (("after a lighter one", (0.3, 1.0, 1.5)), ("before", (1.5, 1.0, 0.3))):
        given = {key: np.stack(3 * [value]) for key, value in case.given.items() if value.ndim}
        given["force"] = given["force"] * np.array(shares)[:, None]
        both = replace(case, given=case.given | given, options=case.options | {"strict": False})
        series, why = solved(both)
        if series is None or not series.converged[1]:
            yield f"{name}: {why or 'no answer'}"
            continue
        yield from _apart(name, numbers(alone), numbers(series, of=1))


def _between_cells(case: Asked, first: Any) -> Iterator[str]:
    """What changes as cells lie elsewhere, over the bounds of both."""
    other = turned(case, ASIDE)
    again = solved(other)[0] if other is not None else None
    if again is None or not (first.resolved and again.resolved):
        return
    for name, bound in vars(first.grid_error).items():
        both = bound + getattr(again.grid_error, name)
        off = abs(getattr(first, name) - getattr(again, name))
        if name == "attitude_angle":
            off = min(off, 2.0 * np.pi - off)
        if off > both + TOLERANCE * abs(getattr(first, name)):
            yield f"between cells: {name} {float(off / both):.2g} of both bounds"


def _other_way(case: Asked, found: Any) -> Iterator[str]:
    """The load of the film at the position found, on the cells that it was found on."""
    field, why = _at(case, found.eccentricity)
    if field is None:
        yield f"at its position: {why}"
        return
    if not (found.resolved and field.resolved):
        return  # loads that the cells do not resolve are solved on others
    off = np.hypot(*(field.force - case.given["force"])) / np.hypot(*case.given["force"])
    if not off < TOLERANCE:
        yield f"at its position: {off:.1e} of the load off"


def _there_and_back(case: Asked, found: Any) -> Iterator[str]:
    """The place of the load of the film at a place nearer to the middle, over the clearance."""
    place = 0.9 * np.asarray(found.eccentricity)
    field, _ = _at(case, place)
    if field is None or not field.resolved or not np.hypot(*field.force) > 0.0:
        return
    back, why = solved(replace(case, given=case.given | {"force": np.asarray(field.force)}))
    if back is None:
        yield f"there and back: {why}"
        return
    if not back.resolved:
        return
    off = np.hypot(*(back.eccentricity - place)) / case.bearing.clearance
    if not off < TOLERANCE:
        yield f"there and back: {off:.1e} of the clearance off"


def _at(case: Asked, place: Array) -> tuple[Any, str]:
    """The film of a case at a place."""
    given = {"eccentricity": place, "speed": case.given["speed"], **case.held}
    return solved(replace(case, verb="pressure", given=given))


def main() -> None:
    """Draw and print what is broken."""
    parser = arguments(__doc__)
    parser.add_argument("families", nargs="*", default=list(FAMILIES), metavar="FAMILY")
    parser.add_argument("--draws", type=int, default=20)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--rung", choices=["grid", "reduced"], default="grid")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    for family in given.families:
        count = 0
        for number in range(given.first, given.first + given.draws):
            case = asked(family, number)
            case = on_reduced(case) if given.rung == "reduced" else case
            for text in broken(case):
                count += 1
                print(f"{family} {number} {text}", flush=True)
        print(f"{family}: {count} broken of {given.draws} draws", flush=True)


if __name__ == "__main__":
    main()
