"""Draw journal bearings of every family over the documented ranges, and count what comes of them.

python -m benchmarks.robustness.families [--draws N] [--first I] [--cap S] [--show] [FAMILY …]
python -m benchmarks.robustness.families --keep [--draws N] [--cap S] [--show] [FAMILY …]

With `--keep` each family goes on with N numbers from the first that was not drawn yet, and the
counts are added to tests/hard/families.json after every 25, so that 10,000 of each come together
over several nights; `python -m benchmarks.robustness.hard_cases --tables` brings them to the page.
Each draw follows from its family and number alone, so that `--first I --draws 1 --show` repeats
one. What is counted: answered (converged and finite), reason (an error that says why there can be
no answer: contact, starvation, standstill, unfit input), unfound (an error that only says that no
answer was found, with its residual), raw (any other exception), slow (more than 2 s of processor
time, whatever came of it). With `--cap` a draw ends after so many seconds of processor time and is
counted as late. The clock stands while kernels are compiled, so that a draw has the same time
whichever came before it.

Ranges, even over the decades where they span some: diameter 0.1 … 5 m, B/D 0.1 … 4, ψ 2e-4 … 3e-3,
viscosity 1e-3 … 1 Pa s, speed ± 0.1 … 300 rad/s, So 1e-3 … 300, all five laws (mixing constant
1e2 … 1e5 Pa), edge pressure 0.1 or 0.3 MPa, grids of 48 × 8 to 96 × 16.

- cylinder: rigid, aligned.
- shaped: partial arcs of 90 … 300° that the load meets, 1 … 6 lobes, 3 … 6 tilting pads, preload
  0 … 0.7; a third of them crowned, recessed or out of round by up to 0.3 c.
- pads: 3 … 8 tilting pads that leave 0.05 … 0.5 of the circle free, pivots at 0.4 … 0.7 of a pad,
  preload 0 … 0.7, the load on a pad, between two or anywhere; a third crowned by up to 0.3 c, a
  third under a tilt of up to 0.5 c at the ends; 1 in 3 "reduced" on 60 × 8 cells.
- supply: 1 … 3 grooves or pockets under pressure or behind restrictors, or fed by a pump.
- line: tilt of up to 0.8 c at the bearing's ends, moment of up to F B/5, bend of up to 0.5 c.
- shell: elastic shells whose growth under the mean pressure is 1e-3 … 3 clearances.
- contact: roughness of 1e-4 … 3e-2 c, half of them tilted, bent or under a moment.
- thrust: 3 … 8 tapered lands or tilting pads on 20 × 10 cells, under 1e-3 … 1e-1 η ω R⁴/h².
- cone: rings and segments of half angles 11 … 52°, under the force of a film at some place.
- heat: oil that thins by 1 … 5 % each kelvin; one temperature of the film, with cooling, a sump or
  growth of shaft and shell, or heat over the area, at one or three points across the gap.
- pair: two such cones against each other, under the force of both films at some place, half of them
  under their moment, too, at a tilt that takes up to 0.3 of the gap.
- orbit: 24 steps under a load that turns and pulsates, the fifth part closed; 1 in 3 "reduced".
- composed: any of bores, supply, tilt or moment, shells, asperities, heat and turbulence together,
  one in three in motion, one in three "reduced"; what does not go together is refused by name,
  which counts as a reason.
"""

from __future__ import annotations

import json
import sys
import warnings
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import numpy as np

from benchmarks.common import arguments
from benchmarks.robustness import kept
from benchmarks.robustness.clock import Clock, Late
from loadflow.errors import InputError, LoadflowError
from loadflow.journal import (
    Arc,
    Capillary,
    ConicalBearing,
    ConicalPair,
    ConstantFlow,
    Contact,
    Contour,
    Crown,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    Growth,
    Guembel,
    Heat,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Orifice,
    Pivot,
    Pump,
    Recess,
    Reynolds,
    Sommerfeld,
    Supply,
    ThickShell,
    ThrustBearing,
    TiltingPads,
    Turbulence,
)
from loadflow.tribology import AsperityContact, ExponentialOil

SLOW = 2.0  # s
GRIDS = ((48, 8), (60, 12), (60, 20), (96, 16))
REASONS = ("touches", "carries no load", "starved", "carries no more", "half-speed whirl")
REASONS += ("find no tilt", "a cone presses the shaft away", "the film gets hotter than")
REASONS += ("no heat balance below 423.15 K; at 423", "no heat balance: at")
REASONS += ("no heat balance below 423.15 K; the mean",)
REASONS += ("at once too little and too much", "a film holds no pad that faces the load")
SEEDS = {"cylinder": 1, "shaped": 2, "supply": 3, "line": 4, "shell": 5, "orbit": 6}
SEEDS |= {"contact": 7, "thrust": 8, "cone": 9, "pair": 10, "heat": 11, "touching": 12, "pads": 13}
SEEDS |= {"composed": 14}
LINE = ("tilt", "moment", "bend")
"""Keywords that say how the shaft lies, one for all of a path."""


@dataclass
class Point:
    """A bearing at one operating point; `film` are keywords of the verbs."""

    rng: np.random.Generator
    diameter: float
    width: float
    clearance: float
    viscosity: float
    speed: float
    load: float
    angle: float
    number: float
    film: dict[str, Any] = field(default_factory=dict)
    shape: dict[str, Any] = field(default_factory=dict)

    @property
    def gap(self) -> float:
        """Radial clearance, m."""
        return self.clearance * 0.5 * self.diameter

    @property
    def pressure(self) -> float:
        """Load over the projected area, Pa."""
        return self.load / (self.diameter * self.width)

    @property
    def force(self) -> np.ndarray:
        """Load, N."""
        return self.load * np.array([np.cos(self.angle), np.sin(self.angle)])

    @property
    def bearing(self) -> JournalBearing:
        """The bearing."""
        return JournalBearing(self.diameter, self.width, self.clearance, **self.shape)

    def solve(self) -> Any:
        """The equilibrium."""
        return self.bearing.equilibrium(self.force, self.speed, self.oil, **self.film)

    @property
    def oil(self) -> Lubricant | None:
        """The liquid; None where the heat has it."""
        return None if "heat" in self.film else Lubricant(self.viscosity)


def powers(rng: np.random.Generator, low: float, high: float) -> float:
    """A number, even over the decades from `low` to `high`."""
    return float(np.exp(rng.uniform(np.log(low), np.log(high))))


def draw_point(rng: np.random.Generator) -> Point:
    """What all families share."""
    diameter, slenderness = powers(rng, 0.1, 5.0), powers(rng, 0.1, 4.0)
    clearance, viscosity = powers(rng, 2e-4, 3e-3), powers(rng, 1e-3, 1.0)
    speed = powers(rng, 0.1, 300.0) * rng.choice([1.0, 1.0, 1.0, -1.0])
    number = powers(rng, 1e-3, 300.0)
    bearing = JournalBearing(diameter, diameter * slenderness, clearance)
    load = number / bearing.sommerfeld_number(1.0, speed, viscosity)
    mixture = GasMixture(powers(rng, 1e2, 1e5))
    laws = [Sommerfeld(), Guembel(), Reynolds(), MassConserving(), mixture]
    film = {
        "cavitation": laws[rng.integers(len(laws))],
        "edge_pressure": float(rng.choice([1e5, 3e5])),
        "grid": GRIDS[rng.integers(len(GRIDS))],
    }
    size = (diameter, diameter * slenderness, clearance, viscosity, speed)
    return Point(rng, *size, load, rng.uniform(-np.pi, np.pi), number, film)


def cylinder(point: Point) -> Callable[[], Any]:
    """Rigid and aligned."""
    return point.solve


def shaped(point: Point) -> Callable[[], Any]:
    """Arcs, lobes and pads, with and without relief."""
    rng, kind = point.rng, point.rng.integers(3)
    if kind == 0:
        span = np.radians(rng.uniform(90, 300))
        shape: Any = Arc(point.angle + span * rng.uniform(-0.3, 0.3), span)
    elif kind == 1:
        count = int(rng.integers(1, 7))
        preload, offset = rng.uniform(0, 0.7), rng.uniform(0.5, 1.0)
        groove = min(0.35, 0.3 * 2 * np.pi / count)
        shape = Lobes(count, preload, groove, rng.uniform(-np.pi, np.pi), offset)
    else:
        count = int(rng.integers(3, 7))
        arc = rng.uniform(0.5, 0.9) * 2 * np.pi / count
        angle = point.angle if rng.random() < 0.3 else rng.uniform(-np.pi, np.pi)
        shape = TiltingPads(count, arc, rng.uniform(0, 0.7), angle, rng.uniform(0.4, 0.7))
    point.shape = {"shape": shape}
    if rng.random() < 1 / 3:
        high = point.gap * rng.uniform(0.01, 0.3)
        around = np.linspace(0, 2 * np.pi, 73)[:-1]
        waves = high * (1 + np.cos(rng.integers(2, 5) * around + rng.uniform(0, 6)))
        spot = rng.uniform(-np.pi, np.pi), rng.uniform(0.1, 1.0)
        reliefs = [
            Crown(high, exponent=rng.uniform(1, 3)),
            Recess(*spot, depth=powers(rng, 0.1, 10) * point.gap, length=0.4 * point.width),
            Contour(around.tolist(), waves.tolist()),
        ]
        point.shape["relief"] = (reliefs[rng.integers(3)],)
    return point.solve


def pads(point: Point) -> Callable[[], Any]:
    """Tilting pads, whole or crowned, around a shaft that may tilt."""
    rng, count = point.rng, int(point.rng.integers(3, 9))
    arc = rng.uniform(0.5, 0.95) * 2 * np.pi / count
    beside = (0.0, np.pi / count, rng.uniform(-np.pi, np.pi))[rng.integers(3)]
    shape = TiltingPads(
        count, arc, rng.uniform(0, 0.7), point.angle + beside, rng.uniform(0.4, 0.7)
    )
    point.shape = {"shape": shape}
    if rng.random() < 1 / 3:
        crown = Crown(point.gap * rng.uniform(0.01, 0.3), exponent=rng.uniform(1, 3))
        point.shape["relief"] = (crown,)
    if rng.random() < 1 / 3:
        way = rng.uniform(-np.pi, np.pi)
        lean = rng.uniform(0, 0.5) * point.gap / (0.5 * point.width)
        point.film["tilt"] = lean * np.array([np.cos(way), np.sin(way)])
    if rng.random() < 1 / 3:
        point.film |= {"rung": "reduced", "grid": (60, 8)}
    return point.solve


def supply(point: Point) -> Callable[[], Any]:
    """Grooves and pockets, restrictors, a pump."""
    rng, count = point.rng, int(point.rng.integers(1, 4))
    pumped = rng.random() < 0.25
    pressure = float(point.film["edge_pressure"] + powers(rng, 0.02, 3.0) * point.pressure)
    oil = 0.5 * abs(point.speed) * point.diameter * point.width * point.gap  # what it drags along
    first, grooves = rng.uniform(-np.pi, np.pi), []
    for k in range(count):
        angle = first + 2 * np.pi * k / count
        arc = rng.uniform(0.0, 0.6) * 2 * np.pi / count
        length = point.width * rng.uniform(0.3, 0.9)
        bore = powers(rng, 1e-3, 5e-2) * min(point.diameter, point.width)
        flow = powers(rng, 0.1, 3.0) * oil / count
        kinds = [None, Capillary(bore, 20 * bore), Orifice(bore), ConstantFlow(flow)]
        restrictor = None if pumped else kinds[rng.integers(len(kinds))]
        given = 0.0 if pumped or isinstance(restrictor, ConstantFlow) else pressure
        grooves.append(Groove(angle, arc, length, given, restrictor=restrictor))
    pump = Pump((0.0, powers(rng, 0.3, 5.0) * oil), (pressure, 0.5 * pressure)) if pumped else None
    point.film["supply"] = Supply(tuple(grooves), pump)
    return point.solve


def line(point: Point) -> Callable[[], Any]:
    """Tilt, moment and bend."""
    rng, kind = point.rng, point.rng.integers(3)
    way = rng.uniform(-np.pi, np.pi)
    direction = np.array([np.cos(way), np.sin(way)])
    half = 0.5 * point.width
    if kind != 1:
        point.film["tilt"] = direction * rng.uniform(0, 0.8) * point.gap / half
    if kind == 1:
        point.film["moment"] = direction * rng.uniform(0, 0.2) * point.load * point.width
    if kind == 2:
        point.film["tilt"] = 0.5 * point.film["tilt"]
        point.film["bend"] = direction[::-1] * rng.uniform(0, 0.5) * 2 * point.gap / half**2
    return point.solve


def shell(point: Point) -> Callable[[], Any]:
    """Shells that give way where they are pressed, or all over."""
    rng = point.rng
    growth = powers(rng, 1e-3, 3.0) * point.gap / point.pressure  # m/Pa
    if rng.random() < 0.5:
        point.film["shell"] = LocalShell(growth)
    else:
        wall = rng.uniform(0.05, 0.5)
        modulus = 0.5 * point.diameter * wall / growth
        point.film["shell"] = ThickShell(point.diameter * (1 + wall), modulus, 0.3)
        point.film["grid"] = (48, 8)
    return point.solve


def rough(point: Point) -> Callable[[], Any]:
    """Rough surfaces that touch."""
    rng = point.rng
    size = powers(rng, 1e-4, 3e-2) * point.gap
    both = AsperityContact(roughness=size, contact_modulus=115e9, factor=powers(rng, 1e-4, 1e-2))
    point.film["contact"] = Contact(both)
    return point.solve


def contact(point: Point) -> Callable[[], Any]:
    """Rough surfaces that touch, half of them around a shaft that tilts."""
    work = rough(point)
    return line(point) if point.rng.random() < 0.5 else work


def touching(point: Point) -> Callable[[], Any]:
    """Rough surfaces under loads that press them together, half of them tilted."""
    number = powers(point.rng, 20.0, 300.0)
    point.load *= number / point.number
    point.number = number
    size = powers(point.rng, 3e-3, 3e-2) * point.gap
    rough = AsperityContact(
        roughness=size, contact_modulus=115e9, factor=powers(point.rng, 1e-4, 1e-2)
    )
    point.film["contact"] = Contact(rough)
    return line(point) if point.rng.random() < 0.5 else point.solve


def thrust(point: Point) -> Callable[[], Any]:
    """Rings of 3 … 8 lands or tilting pads under what they carry at some film."""
    rng, count, outer = point.rng, int(point.rng.integers(3, 9)), 0.5 * point.diameter
    gap = powers(rng, 1e-5, 3e-4) * outer
    size = (count, outer * rng.uniform(0.3, 0.7), outer)
    arc = rng.uniform(0.6, 0.95) * 2 * np.pi / count
    if rng.random() < 2 / 3:
        cut = {"taper": gap * rng.uniform(0.3, 4.0), "wedge": rng.uniform(0.5, 1.0)}
        bearing = ThrustBearing(*size, pad_angle=arc, **cut)
    else:
        bearing = ThrustBearing(*size, pad_angle=arc, pivot=Pivot(rng.uniform(0.55, 0.65)))
    film = Film(Lubricant(point.viscosity), **(point.film | {"grid": (20, 10)}))
    force = point.viscosity * abs(point.speed) * outer**4 / gap**2 * powers(rng, 1e-3, 1e-1)
    return lambda: bearing.equilibrium(force=force, speed=point.speed, film=film)


def _cone_of(point: Point) -> tuple[ConicalBearing, Film]:
    """A whole ring or segments of a cone, and their film."""
    rng, start, half = point.rng, 0.5 * point.diameter, point.rng.uniform(0.2, 0.9)
    gap = powers(rng, 5e-5, 5e-4) * start
    pads = {} if rng.random() < 0.5 else {"pads": int(rng.integers(4, 10)), "pad_angle": 0.5}
    slant = (start, start * rng.uniform(1.2, 1.6))
    bearing = ConicalBearing(half_angle=half, slant=slant, clearance=gap, **pads)
    grid = (24, 8) if pads else (60, 10)
    return bearing, Film(Lubricant(point.viscosity), **(point.film | {"grid": grid, "inlet": None}))


def cone(point: Point) -> Callable[[], Any]:
    """Whole rings and segments of cones under the force of a film at some place."""
    bearing, film = _cone_of(point)
    gap = bearing.clearance
    aside = point.rng.uniform(0.1, 0.85) * gap / np.cos(bearing.half_angle)
    place = (aside * np.cos(point.angle), aside * np.sin(point.angle), -0.1 * gap)

    def work() -> Any:
        force = bearing.pressure(eccentricity=place, speed=point.speed, film=film).force
        return bearing.equilibrium(force=force, speed=point.speed, film=film)

    return work


def heat(point: Point) -> Callable[[], Any]:
    """Films that warm: one temperature of the whole film, or one of each place."""
    rng = point.rng
    oil = ExponentialOil(
        reference_viscosity=point.viscosity, constant_steepness=rng.uniform(0.01, 0.05)
    )
    area = np.pi * point.diameter * point.width
    cooling = powers(rng, 1.0, 1e3)  # W/(m² K)
    balance: Heat | FilmHeat
    if rng.random() < 0.5:
        kind = rng.integers(3)
        balance = Heat(
            oil,
            transfer=cooling * area if kind != 1 else 0.0,
            sump_transfer=cooling * area if kind == 1 else None,
            growth=Growth(shell_share=rng.uniform(0.5, 1.0)) if kind == 2 else None,
        )
    else:
        walls = {} if rng.random() < 0.3 else {"shell_transfer": cooling, "shaft_transfer": cooling}
        points = 3 if rng.random() < 0.3 else 1
        balance = FilmHeat(oil, carry_over=rng.uniform(0.0, 0.8), points=points, **walls)
        point.film["cavitation"] = MassConserving()
        if rng.random() < 0.5:
            point.shape["shape"] = Lobes(int(rng.integers(1, 4)), preload=rng.uniform(0, 0.5))
    point.film["heat"] = balance
    return point.solve


def pair(point: Point) -> Callable[[], Any]:
    """Two cones against each other, one locating bearing, under the load of both films."""
    cone, film = _cone_of(point)
    rng, gap, half = point.rng, cone.clearance, cone.half_angle
    distance = 0.5 * point.diameter * rng.uniform(0.5, 3.0)
    bearing = ConicalPair(cone, cone, distance, arrangement="OX"[rng.integers(2)])
    axial = rng.uniform(-0.8, 0.8)
    aside = rng.uniform(0.1, 0.85) * gap * (1.0 - abs(axial)) / np.cos(half)
    shift = aside * np.cos(point.angle), aside * np.sin(point.angle), axial * gap / np.sin(half)
    free, way = rng.random() < 0.5, rng.uniform(-np.pi, np.pi)
    lean = rng.uniform(0.0, 0.3) * gap * (1.0 - abs(axial)) / (0.5 * distance + cone.slant[1])
    tilt = lean * np.array([np.cos(way), np.sin(way)]) * (0.3 if free else 0.0)

    def work() -> Any:
        held = bearing.pressure(eccentricity=shift, speed=point.speed, film=film, tilt=tilt)
        moment = held.moment if free else None
        return bearing.equilibrium(held.force, moment, point.speed, film)

    return work


def orbit(point: Point) -> Callable[[], Any]:
    """24 steps of a load that turns and pulsates."""
    rng = point.rng
    period = 2 * np.pi / abs(point.speed) * powers(rng, 0.5, 20.0)
    times = np.linspace(0.0, period, 25)
    turns = int(rng.integers(-1, 2)) if rng.random() < 0.5 else 0
    phase = 2 * np.pi * times / period
    size = point.load * (1 + rng.uniform(0, 0.9) * np.sin(phase))
    angle = point.angle + turns * phase
    force = size[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    options = dict(point.film)
    if rng.random() < 1 / 3:
        options |= {"rung": "reduced", "grid": (60, 12), "inlet": None}
    elif rng.random() < 0.3:
        options["periodic"] = True
    held = {name: np.tile(options[name], (25, 1)) for name in LINE if name in options}
    return lambda: point.bearing.orbit(times, force, point.speed, point.oil, **options | held)


def composed(point: Point) -> Callable[[], Any]:
    """Any parts together, at rest or in motion, on the grid or on "reduced"."""
    rng, work = point.rng, point.solve
    if rng.random() < 0.2:
        point.film["turbulence"] = Turbulence()
    for part in (shaped, supply, line, shell, rough, heat):
        if rng.random() < 0.35:
            part(point)
    if rng.random() < 1 / 3:
        point.film |= {"rung": "reduced", "grid": (60, 12), "inlet": None}
    return orbit(point) if rng.random() < 0.35 else work


FAMILIES: dict[str, Callable[[Point], Callable[[], Any]]] = {
    "cylinder": cylinder,
    "shaped": shaped,
    "pads": pads,
    "supply": supply,
    "line": line,
    "shell": shell,
    "contact": contact,
    "touching": touching,
    "thrust": thrust,
    "cone": cone,
    "heat": heat,
    "pair": pair,
    "orbit": orbit,
    "composed": composed,
}


def outcome(work: Callable[[], Any], clock: Clock) -> tuple[str, str]:
    """What comes of a draw under its clock: its count, and the text of an error."""
    try:
        with clock:
            answer = work()
    except Late:
        return "late", f"ended after {clock.cap:g} s"
    except LoadflowError as error:
        text = str(error)
        told = isinstance(error, InputError) or any(word in text for word in REASONS)
        return ("reason" if told else "unfound"), text
    except Exception as error:  # what must not happen
        return "raw", f"{type(error).__name__}: {error}"
    finite = bool(np.isfinite(np.asarray(answer.minimum_film)).all())
    return ("answered", "") if finite else ("raw", "an answer that is not finite")


def run(family: str, numbers: range, show: bool, cap: float = 0.0) -> dict[str, Any]:
    """Counts of one family."""
    counts: Counter[str] = Counter()
    raised: list[tuple[int, str]] = []
    longest = total = 0.0
    for number in numbers:
        rng = np.random.default_rng([SEEDS[family], number])
        point = draw_point(rng)
        work, clock = FAMILIES[family](point), Clock(cap)
        kind, text = outcome(work, clock)
        spent = clock.seconds
        longest, total = max(longest, spent), total + spent
        counts["slow"] += spent > SLOW
        counts[kind] += 1
        if kind == "raw":
            raised.append((number, text))
        if show and (kind != "answered" or spent > SLOW):
            law = type(point.film["cavitation"]).__name__
            more = type(point.shape.get("shape", point.film.get("shell", ""))).__name__
            head = f"{family} {number}: {kind}, So {point.number:.3g}, B/D "
            head += f"{point.width / point.diameter:.2f}, {law}, {point.film['grid']}, {more}"
            print(f"{head}, {spent:.1f} s: {text}", flush=True)
    names = ("answered", "reason", "unfound", "raw", "late", "slow")
    row: dict[str, Any] = {"draws": len(numbers), "cap": cap}
    row |= {name: counts[name] for name in names} | {"raised": raised}
    return row | {"mean": round(total / len(numbers), 3), "longest": round(longest, 2)}


def main() -> None:
    """Draw and print the counts."""
    parser = arguments(__doc__)
    parser.add_argument("families", nargs="*", default=list(FAMILIES), metavar="FAMILY")
    parser.add_argument("--draws", type=int, default=200)
    parser.add_argument("--first", type=int, help="number of the first draw; 0 if not given")
    parser.add_argument("--cap", type=float, default=0.0, help="seconds of processor time a draw")
    parser.add_argument("--show", action="store_true", help="every draw without an answer")
    parser.add_argument("--json", metavar="FILE", help="write the counts there")
    parser.add_argument("--keep", action="store_true", help="go on, and add to the kept counts")
    asked = parser.parse_args()
    unknown = set(asked.families) - set(FAMILIES)
    if unknown:
        sys.exit(f"unknown families: {', '.join(sorted(unknown))}; known: {', '.join(FAMILIES)}")
    if asked.keep and (asked.first is not None or asked.json):
        sys.exit("--keep goes on where a family ends, in its own file: leave --first and --json")
    warnings.simplefilter("ignore")
    rows: dict[str, Any] = {}
    for family in asked.families:
        draw = partial(run, family, show=asked.show, cap=asked.cap)
        first = asked.first or 0
        numbers = range(first, first + asked.draws)
        rows[family] = kept.keep(family, asked.draws, draw) if asked.keep else draw(numbers)
        print(f"{family}: {rows[family]}", flush=True)
    if asked.json:
        with open(asked.json, "w", encoding="utf-8") as file:
            json.dump(rows, file, indent=1)


if __name__ == "__main__":
    main()
