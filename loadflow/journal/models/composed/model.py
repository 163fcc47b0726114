"""A reduced film with effects, put together: cells around, points across, shell and asperities."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import ValidityWarning
from loadflow.journal.cavitation import FILL, LOAD
from loadflow.journal.contact import Contact
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.rough import RoughGap
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film.integrals import Integrals, in_units
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.asperities import rough_of, yielding_of
from loadflow.journal.models.composed.error import Judged
from loadflow.journal.models.composed.film import (
    Composed,
    ComposedWork,
    ShelledFilm,
    lanes_of,
    make_work,
    regime_of,
)
from loadflow.journal.models.composed.kernels._gap_kernels import MEAN, OPEN
from loadflow.journal.models.composed.relief import (
    contoured,
    least_gap,
    places_of,
    resolves_relief,
    with_contours,
)
from loadflow.journal.models.composed.shell import shell_of
from loadflow.journal.models.composed.supply import (
    feeding_of,
    held_points,
    nodes_beside,
    parted_at,
    put_in_grooves,
    supplied,
)
from loadflow.journal.models.composed.thickening import thickening_of
from loadflow.journal.models.composed.uneven import EVEN, Thickness
from loadflow.journal.models.ring import estimates, lobed, ring_of, units_of
from loadflow.journal.models.width_modes import (
    Nodes,
    between_points,
    between_stretches,
    half_width_nodes,
    whole_width,
)
from loadflow.journal.rows import without_supply
from loadflow.journal.solvers.estimate import SHARES
from loadflow.journal.solvers.load_stepping import TOUCHING

Array = NDArray[np.float64]

HALF_POINTS = (4, 7, 10, 14, 20)  # across half of an even film; three miss 2 % of a peak at contact
POINTS = (6, 14, 20, 28, 40)  # across the whole width: as many even polynomials as odd ones
LEVELS = range(2)
_HALVINGS = 24  # of a place of a standing shaft
_ROOM = 0.02  # gap, in clearances, that the first position of a smooth shaft must leave
_SHORTER = 1.0 / 3.0  # of the gap of a rigid bore that asks for the same cells
_THINNER = 2.0  # times a gap in a rigid bore, that one in a shell may be
_UNRESOLVED = 0.08  # highest polynomials over the largest pressure: beyond, there are too few
_RUBS = 0.02  # share of the load that asperities carry, above which the first points are too few
_UPPER = 0.1  # the same of the sum of their upper half, of a film at rest


@dataclass(frozen=True)
class ComposedFilm:
    """One film, ready to be solved load by load, or through time.

    Attributes
    ----------
    bearing, options, line
        As given.
    units : DiscreteFilm
        The grid's film without effects, of which units and cells are taken.
    film : Composed
        Constants of the compiled loops.
    work : ComposedWork
        Their work arrays.
    """

    bearing: JournalGeometry
    options: Film
    line: Line
    units: DiscreteFilm
    film: Composed
    work: ComposedWork

    @property
    def whole(self) -> bool:
        """Whether the whole width is solved."""
        return _whole(self.bearing, self.options, self.line)

    @property
    def size(self) -> int:
        """Degrees of freedom of the shaft that move."""
        return 4 if self.line.moment is not None else 2

    @property
    def columns(self) -> int:
        """Of a row of results: those of every film, then flow and pressure of each groove."""
        return at.RESULTS + 2 * self.work.fed.size

    def judge(self, judged: Judged, n: int, speed: float) -> None:
        """Have the film that the work arrays hold at a `speed`, rad/s, judged, as number `n`."""
        inner, points = self.film.nodes.slopes.shape[1], self.film.nodes.z.size
        opens, gap = 1.0, self.work.gap[MEAN, :, :points]
        if self.film.rough.size > 0.0:
            opens = float(self.work.gap[OPEN, :, :points].min())
        fill = self.work.state[FILL, :, :inner] if self.options.law.smooth else None
        judged.add(n, self.work.state[LOAD, :, :inner], gap, opens, fill, speed)

    def loads(self, force: Array) -> Array:
        """Forces, N, and moments over the shaft radius, (n, 4)."""
        rows = np.zeros((len(force), 4))
        rows[:, :2] = force
        if self.line.moment is not None:
            rows[:, 2:] = self.line.moment / self.bearing.radius
        return rows

    def lines(self, count: int) -> Array:
        """Tilt and bend that are given, in the units of the loops, (n, 4)."""
        rows, unit = np.zeros((count, 4)), self.bearing.radius / self.bearing.clearance
        if self.line.tilt is not None:
            rows[:, :2] = self.line.tilt * unit
        if self.line.bend is not None:
            rows[:, 2:] = self.line.bend * (unit * self.bearing.radius)
        return rows

    def cold(self) -> Array:
        """Unknowns of a film at edge pressure, in grooves at theirs."""
        edge, ring, inner = self.units.p_edge, self.film.ring, self.film.nodes.slopes.shape[1]
        pressure = np.full(self.work.u.shape, edge)
        pressure[ring.back == 0.0, :inner] = self.bearing.pressure_between(edge)
        put_in_grooves(self.units, self.film.held, pressure)
        return self.units.unknown_of(pressure)

    def estimates(self, force: Array, speed: Array, lines: Array) -> Array:
        """First positions (n, 4): closed form, as near as asperities and given tilt ask."""
        size = np.hypot(*force.T)
        places = np.zeros((speed.size, 4))
        places[:, :2] = estimates(self.bearing, self.units, force, speed)
        if self.size == 2:
            places[:, 2:] = lines[:, :2]
        standing, toward = speed == 0.0, force / np.maximum(size, 1e-300)[:, None]
        if self.film.ring.shaped:
            for n, (place, line) in enumerate(zip(places, lines)):
                if standing[n] and self.film.rough.size > 0.0:
                    ratio = float(self._touching_at(size[n : n + 1])[0])
                    place[:2] = self._lying(toward[n], ratio, place, line[2:])
                else:
                    place[:2] *= self._share_inside(place, line[2:])
            return places
        if self.film.rough.size > 0.0:
            alone = self._touching_at(size)
            nearer = standing | (np.hypot(*places[:, :2].T) > alone)
            places[nearer, :2] = (alone[:, None] * toward)[nearer]
        else:
            places[standing, :2] = 0.0
        rough = self.film.rough.size
        least = -2.0 * rough if rough > 0.0 else _ROOM
        for place, line in zip(places, lines):
            for _ in range(60):
                if self.least(place[None], line[None, 2:])[0] >= least:
                    break
                place[:2] *= 0.9
        return places

    def _lying(self, toward: Array, alone: float, place: Array, bend: Array) -> Array:
        """Where along a load a shaft has the gap that it has at a ratio `alone` in a round bore."""
        low, high = 0.0, 2.0
        for _ in range(_HALVINGS):
            middle = 0.5 * (low + high)
            there = np.append(middle * toward, place[2:])
            far = self.least(there[None], bend[None])[0] > 1.0 - alone
            low, high = (middle, high) if far else (low, middle)
        return low * toward

    def _share_inside(self, place: Array, bend: Array) -> float:
        """Share of a first position (4,) that leaves a gap in a shaped bore; 0 if none does."""
        for share in SHARES:
            nearer = place * [share, share, 1.0, 1.0]
            if self.least(nearer[None], bend[None])[0] > ShapedGap.first_gap:
                return share
        return 0.0

    def _touching_at(self, load: Array) -> Array:
        """Eccentricity ratios (n,) at which asperities alone carry loads (n,), N."""
        rough = self.film.rough
        carried = rough.table[0] * rough.weights.sum()
        ratios = rough.first + rough.step * np.arange(carried.size)
        return np.interp(load, carried, ratios)

    def resolves(self, position: Array) -> bool:
        """Whether the cells around resolve the narrowest gap of a rigid shell."""
        if self.film.give > 0.0:
            return True
        narrow = self.least(position[None], self.work.bend[None])[0]
        return self.units.resolves(np.array([1.0 - narrow, 0.0]))

    def resolves_gap(self, gap: float) -> bool:
        """Whether the cells around resolve a film in a shell that gives way, by its narrowest gap.

        There the film is pressed flat, and ends over a shorter length: on cells that would do in a
        rigid bore its thickness is up to 3 % off, on these 1 %.
        """
        return self.units.resolves(np.array([1.0 - _SHORTER * gap, 0.0]))

    def surely_thin(self, place: Array, force: Array) -> bool:
        """Whether they surely do not, by a first position (4,) and what the shell gives there."""
        specific = float(np.hypot(*force)) / (self.bearing.width * self.bearing.diameter)
        gap = 1.0 - float(np.hypot(*place[:2])) + self._softness * specific
        return not self.resolves_gap(_THINNER * gap)

    @property
    def _softness(self) -> float:
        """Largest growth of the gap over an even pressure, clearances per Pa."""
        modes = self.film.modes
        spread = np.einsum("kxl,k->xl", modes.shapes, modes.pressed.sum(axis=(1, 2)))
        return self.film.give + float(spread.max())

    def touches(self, position: Array) -> bool:
        """Whether a rigid bore and a smooth shaft of given line touch at a position (4,)."""
        smooth = self.film.give == 0.0 and self.film.rough.size == 0.0 and self.size == 2
        return smooth and bool(self.least(position[None], self.work.bend[None])[0] < TOUCHING)

    def least(self, positions: Array, bends: Array) -> Array:
        """Narrowest gap (n,) of a rigid shell at `positions` (n, 4), clearances, over the width."""
        centres, bore = self.centres(positions, bends), Bore.of(self.bearing)
        if contoured(self.bearing):
            return least_gap(self.bearing, centres, self.film.places)
        gaps = bore.narrowest(centres.reshape(-1, 2)).reshape(len(positions), -1)
        return np.asarray((gaps + self.film.places.depth).min(axis=1))

    def centres(self, positions: Array, bends: Array) -> Array:
        """Where shafts at `positions` (n, 4) are seen to be from the places across, (n, f, 2)."""
        z = self.film.places.z
        x, y, tilt_x, tilt_y = positions.T[:, :, None]
        bend_x, bend_y = bends.T[:, :, None]
        return np.stack(
            [x + tilt_y * z + 0.5 * bend_x * z**2, y - tilt_x * z + 0.5 * bend_y * z**2], axis=-1
        )

    def unresolved_across(self, rows: Array) -> NDArray[np.bool_]:
        """Whether the polynomials miss the pressure of films at rest, as at a bearing end.

        They are `rows` (n, RESULTS) of a model that is built for these. Below the limits narrowest
        gap and largest pressure have been within 1.5 % (tilted) and 2.8 % (aligned) of those of
        many points, and hardly ever farther off than the upper half adds up to.
        """
        return (rows[:, at.HIGHEST] > _UNRESOLVED) | (rows[:, at.BEYOND] > _UPPER)

    def unresolved_on_path(
        self, rows: Array, force: Array, typical: float | None = None, by: int = at.HIGHEST
    ) -> NDArray[np.bool_]:
        """The same of the samples of a path under `force` (n, 2), N.

        What hardly loads the film, between samples that do, needs no more points: the share that
        is missed there counts against the mean pressure of the path. Where `rows` are but a part
        of that, `typical` is no more than it, Pa. With `by` at `BEYOND` it is what the first
        level would miss of what a further one has found.
        """
        specific = np.hypot(*force.T) / (self.bearing.width * self.bearing.diameter)
        pressure = np.maximum(rows[:, at.PEAK] - self.film.ring.p_edge, specific)
        share = pressure / np.maximum(pressure, pressure.mean() if typical is None else typical)
        return np.asarray(rows[:, by] * share > _UNRESOLVED)

    def results(self, rows: Array, speed: Array) -> dict[str, Any]:
        """Rows of the compiled loops, in SI units and named as in `Equilibrium`."""
        share = 0.5 if self.whole else 1.0  # the units are those of half of the width
        found = Integrals(
            peak=rows[:, at.PEAK],
            dissipation=share * rows[:, at.DISSIPATION],
            shear=share * rows[:, at.SHEAR],
            outflow=share * rows[:, at.OUTFLOW],
            fill=rows[:, at.FILLED],
        )
        clearance, contact = self.bearing.clearance, self.options.contact
        values = in_units(self.units, found, speed, rows[:, at.LEAST])
        values |= {
            "residual": rows[:, at.RESIDUAL],
            "iterations": rows[:, at.ITERATIONS].astype(int),
            "eccentricity_ratio": np.hypot(rows[:, at.X], rows[:, at.Y]),
            **without_supply(len(rows)),
            "supply_flow": self.units.pockets.flow_unit * share * rows[:, at.FED],
        }
        if self.options.supply is not None:
            flows, pressure = np.split(rows[:, at.RESULTS :], 2, axis=1)
            values |= supplied(self.units, share * flows, pressure, values["supply_flow"])
        if self.whole:
            values["tilt"] = rows[:, [at.TILT_X, at.TILT_Y]] * clearance / self.bearing.radius
            values["moment"] = rows[:, [at.MOMENT_X, at.MOMENT_Y]] * self.bearing.radius
        if self.options.shell is not None:
            values["shell_deformation"] = rows[:, at.GROWTH] * clearance
        if contact is not None:
            values |= self._rubbing(contact, rows, speed)
            values["friction_power"] = values["friction_power"] + values["contact_power"]
        return values

    def _rubbing(self, contact: Contact, rows: Array, speed: Array) -> dict[str, Any]:
        """What the asperities carry and lose, and the mean gap between them."""
        clearance, planes = self.bearing.clearance, rows[:, at.LEAST]
        gap = RoughGap(self.units.mesh, contact, clearance)
        force = rows[:, [at.CONTACT_X, at.CONTACT_Y]]
        touching = planes * clearance < contact.asperities.reach
        heights = np.where(touching, planes, 1.0) * clearance
        return {
            "minimum_film": clearance * np.array([gap.rough.mean(h) for h in planes.tolist()]),
            "contact_force": force,
            "contact_pressure": np.where(touching, contact.asperities.pressure(heights), 0.0),
            "contact_area": np.where(touching, contact.asperities.area(heights), 0.0),
            "contact_power": contact.coefficient
            * rows[:, at.NORMAL]
            * np.abs(speed)
            * self.bearing.radius,
        }


def build(
    bearing: JournalGeometry,
    options: Film,
    speed: Array,
    line: Line,
    level: int = 0,
    *,
    at_rest: bool = False,
    across: int | None = None,
    viscosity: Thickness | None = None,
) -> ComposedFilm:
    """Put a film on cells around and points across, of which each `level` has more.

    What a path asks on further points is whether few would do; a film `at_rest` whether these do.
    There are `across` of them beside no groove, if they are told.
    `viscosity` is that of the cells where it is uneven, and how the gap has grown by heat.
    """
    units = units_of(bearing, options, speed)
    half = float(units.mesh.z_edges[-1])
    whole = _whole(bearing, options, line)

    def layout(number: int, few: int | None) -> Nodes:
        beside = nodes_beside(options.supply, bearing, whole, number, few)
        if beside is not None:
            return beside
        plain, points = (whole_width, POINTS) if whole else (half_width_nodes, HALF_POINTS)
        return plain(half, across or points[number], None if few is None else points[few])

    flows_out = bearing.pressure_between(units.p_edge) != units.p_edge  # beside its ends, steeply
    more = 0 if resolves_relief(bearing, layout(0, None).z) and not flows_out else 1
    nodes = layout(level + more, None if at_rest else more)
    ring = ring_of(units, 1.0 if whole else 2.0)
    if bearing.shape.segments:
        ring = lobed(ring, bearing, options)
    held = held_points(units, options, nodes, ring)
    feeding = feeding_of(units, held, 0.5 if whole else 1.0)
    contour = contoured(bearing)
    ring = ring._replace(groove=ring.groove | held.columns, shaped=ring.shaped or contour)
    places = places_of(bearing, nodes.z, half, whole)
    (give, modes), uneven = shell_of(bearing, options, ring, nodes, whole), EVEN
    grows = viscosity is not None and viscosity.growth is not None
    yielding = yielding_of(bearing, options, give, whole, nodes, ring, grows)
    if viscosity is not None:
        uneven = viscosity.at(nodes.z, yielding.z, ring.back, ring.width)
        places = places._replace(depth=places.depth + viscosity.mean_growth(places.z))
        yielding = yielding._replace(depth=yielding.depth + viscosity.mean_growth(yielding.z))
    if contour:
        uneven = with_contours(uneven, bearing, ring, nodes.z, yielding.z)
    thickening = thickening_of(options.liquid, units.p_edge)
    film = (ShelledFilm if modes.on else Composed)(
        ring, nodes, places, lanes_of(nodes, places.depth), give, modes,
        rough_of(bearing, options.contact, whole, units), yielding, regime_of(bearing, options),
        held, feeding, uneven, thickening,
    )  # fmt: skip
    work = make_work(ring.width.size, nodes, places.z.size, feeding, modes)
    return ComposedFilm(bearing, options, line, units, film, work)


def levels_at_rest(options: Film) -> range:
    """Levels of points across that a film at rest may ask for: more than `LEVELS` cost little."""
    return range(len(POINTS) - 1 if options.supply is None else len(LEVELS) + 1)


def unknowns_on(
    unknowns: Array, here: ComposedFilm, there: ComposedFilm, edge: float | None = None
) -> Array:
    """Unknowns (nx, L) of the film `here` at the points of another level.

    So are other values, that are `edge` at the bearing ends.
    """
    few, many = (model.film.nodes.slopes.shape[1] for model in (here, there))
    supply, whole = here.options.supply, there.whole
    marks = () if supply is None else parted_at(supply, here.bearing)
    if marks:
        across = between_stretches(marks, here.film.nodes, there.film.nodes, whole)
    else:
        across = between_points(few, many, whole)
    end = float(here.units.unknown_of(np.array([here.units.p_edge]))[0]) if edge is None else edge
    moved = np.full(there.work.u.shape, end)
    moved[:, :many] += (unknowns[:, :few] - end) @ across.T
    between = here.film.ring.back == 0.0
    moved[between, :many] = unknowns[between, :1]  # as held, up to a bearing end
    for number, (i, k) in enumerate(here.film.feeding.samples):
        moved[:, :many][there.film.held.grooves == number] = unknowns[i, k]
    return moved


def warn_unresolved(left: NDArray[np.bool_], first: str) -> None:
    """Warn of what is `left` (n,), of which `first` is the first."""
    warnings.warn(
        f'rung "reduced": the pressure at a bearing end is not resolved at {left.sum()} of '
        f'{left.size} samples, first at {first}; "grid" with enough cells across does',
        ValidityWarning,
        stacklevel=5,
    )


def contact_share(carried: Array, force: Array) -> Array:
    """Part of loads (n, 2) that asperities carry along them, over their size; 0 without load."""
    size = (force * force).sum(axis=-1)
    along = (carried * force).sum(axis=-1)
    return np.where(size > 0.0, along / np.where(size > 0.0, size, 1.0), 0.0)


def rubs(rows: Array, force: Array) -> NDArray[np.bool_]:
    """Whether asperities carry so much of loads (n, 2), N, that the first points are too few.

    What they carry follows the gap so steeply that six points across a tilted film, which miss a
    thousandth of the gap, missed a twentieth of the friction.
    """
    return np.asarray(contact_share(rows[:, [at.CONTACT_X, at.CONTACT_Y]], force) > _RUBS)


def _whole(bearing: JournalGeometry, options: Film, line: Line) -> bool:
    """Whether both halves of the width differ."""
    shell, relief = options.shell, bearing.relief
    alike = line.straight and all(part.symmetric(bearing.width) for part in relief)
    return not (alike and (shell is None or shell.symmetric_on(options.cells[1])))
