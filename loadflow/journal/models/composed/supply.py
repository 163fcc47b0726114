"""Grooves and pockets of a supply in a reduced film: which points they hold at their pressure.

Columns of cells have their edges on those of the grooves, as on the grid. Across, the width is
parted where grooves end, so that their pressure ends between two stretches.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.feed import FeedTable
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.grooves import groove_marks, groove_numbers
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.ring import Ring
from loadflow.journal.models.width_modes import Nodes, stretched_width
from loadflow.journal.supply import Supply

Array = NDArray[np.float64]

_POINTS = (5, 8, 12, 16)  # inside the stretches of half of the width that are parted once
_CLOSE = 1e-7  # to a groove, in shaft radii, at which a point is in it
_ENDS = 1e-9  # share of the half width by which a groove may miss the bearing end


def nodes_beside(
    supply: Supply | None, bearing: JournalGeometry, whole: bool, number: int, few: int | None
) -> Nodes | None:
    """Points across a width that grooves part; None where none does.

    They are the `number` of `_POINTS`; what they tell is whether the `few` of these would do.
    """
    if supply is None:
        return None
    half, marks = bearing.width / bearing.diameter, parted_at(supply, bearing)
    if not marks:
        return None

    def shared(points: int) -> tuple[int, int]:
        middle = min(max(round(0.8 * points * marks[0]), 1), points - 2)
        return middle, points - middle

    fewer = None if few is None else shared(_POINTS[few])
    return stretched_width(half, marks, shared(_POINTS[number]), whole, fewer)


def parted_at(supply: Supply, bearing: JournalGeometry) -> tuple[float, ...]:
    """Where grooves end between mid-plane and the bearing end, shares of the half width."""
    _, ends = groove_marks(supply.grooves, 1, bearing.radius)
    shares = np.unique(np.round(ends / (bearing.width / bearing.diameter), 12))
    return tuple(shares[(shares > _ENDS) & (shares < 1.0 - _ENDS)].tolist())


class Held(NamedTuple):
    """What grooves of a supply hold of a film, and what they take of its drag.

    Attributes
    ----------
    on : bool
        Whether there are any.
    grooves : array of int (nx, m)
        Number of the groove that holds each point, −1 for none; one at the end of a groove is held.
    columns : array of bool (nx,)
        Columns that grooves hold all across.
    drags : array (nx, m)
        Share of the width of each point that is beside grooves.
    """

    on: bool
    grooves: NDArray[np.int64]
    columns: NDArray[np.bool_]
    drags: Array


def held_points(units: DiscreteFilm, options: Film, nodes: Nodes, ring: Ring) -> Held:
    """Which points of a film on the columns of a `ring` its supply holds.

    Raises
    ------
    loadflow.errors.InputError
        A groove beyond the bearing end, or two that overlap.
    """
    angle, points = np.arctan2(ring.sin, ring.cos), nodes.slopes.shape[1]
    if options.supply is None:
        shape = angle.size, points
        return Held(False, np.full(shape, -1), np.zeros(angle.size, bool), np.ones(shape))
    half, z = float(units.mesh.z_edges[-1]), nodes.z[:points]
    asked = options.cells[0], units.radius
    below, above = (
        groove_numbers(angle, z + by, half, options.supply, *asked) for by in (-_CLOSE, _CLOSE)
    )
    drags = nodes.below * (below < 0) + (1.0 - nodes.below) * (above < 0)
    grooves = np.maximum(below, above)
    return Held(True, grooves, np.all(grooves >= 0, axis=1), drags)


class Feeding(NamedTuple):
    """What feeds the grooves of a film whose pressure is unknown.

    Attributes
    ----------
    table : FeedTable
        That of the grooves, f of them.
    slots : array of int (g,)
        Number of each groove among these, −1 for one of a given pressure.
    samples : array of int (g, 2)
        Column and point that each groove holds.
    first : array of int (f,)
        Those of the grooves of the table, as places in (nx, m).
    points : array of int (n, 2)
        Columns and points that these hold, column after column.
    keeps_full : bool
        Whether they are kept full beside the law.
    unit : float
        Flow, m³/s, over that of the film.
    """

    table: FeedTable
    slots: NDArray[np.int64]
    samples: NDArray[np.int64]
    first: NDArray[np.int64]
    points: NDArray[np.int64]
    keeps_full: bool
    unit: float


def feeding_of(units: DiscreteFilm, held: Held, share: float) -> Feeding:
    """What feeds the grooves of a film whose flows are `share` of those in its units."""
    pockets, grooves = units.pockets, held.grooves
    free, slots = pockets.free, np.full(pockets.count, -1)
    slots[free] = np.arange(free.size)
    places = [np.flatnonzero(grooves.ravel() == number)[0] for number in range(pockets.count)]
    first, across = np.array(places, dtype=np.int64), grooves.shape[1]
    return Feeding(
        table=pockets.feed.table,
        slots=slots,
        samples=np.stack([first // across, first % across], axis=1),
        first=first[free],
        points=np.argwhere(np.isin(grooves, free)).astype(np.int64, order="C"),
        keeps_full=bool(units.law.moves_by_cells and free.size),
        unit=share * pockets.flow_unit,
    )


class Border(NamedTuple):
    """Work arrays of f grooves whose pressure is unknown; pressures in Pa.

    Attributes
    ----------
    fed : array (f,)
        Flow of the grooves into the film and into their own gap, as `balance` has it.
    pressure, flow, change : array (f,)
        Pressure of the grooves, their flow in m³/s, and a change of `fed`.
    direct : array (5, f)
        Derivatives of that by the position, at unchanged unknowns; the first row is none.
    through : array (f, f)
        What the answer of the film to each takes from the flow of all.
    missing, by_pressure, by_flow : array (f,), (f,), (f, f)
        As of `Feed.mismatch`.
    system : array (f, f + 1)
        Linear system of the pressures.
    """

    fed: Array
    pressure: Array
    flow: Array
    change: Array
    direct: Array
    through: Array
    missing: Array
    by_pressure: Array
    by_flow: Array
    system: Array


def make_border(count: int) -> Border:
    """Allocate the work arrays of `count` grooves."""
    shapes = count, count, count, count, (5, count), (count, count), count, count, (count, count)
    return Border._make(np.zeros(shape) for shape in (*shapes, (count, count + 1)))


def put_in_grooves(units: DiscreteFilm, held: Held, pressure: Array) -> None:
    """Give the points that grooves hold their pressure, Pa, in place."""
    inner = pressure[:, : held.grooves.shape[1]]
    for number, given in enumerate(units.pockets.feed.guess(units.p_edge)):
        inner[held.grooves == number] = given


def supplied(units: DiscreteFilm, flows: Array, pressure: Array, between: Array) -> dict[str, Any]:
    """Flow and pressure of the grooves of films whose `flows` (n, g) are in their units.

    What grooves `between` segments feed (n,), m³/s, is in the flow of all. A groove whose pressure
    is unknown is starved where that is below the pressure of the bearing ends.
    """
    feed, flows = units.pockets.feed, units.pockets.flow_unit * flows
    lack = units.p_edge - pressure[:, units.pockets.free]
    return {
        "supply_flow": flows.sum(axis=1) + between,
        "supply_power": np.array([feed.power(*row) for row in zip(pressure, flows)]),
        "groove_flow": flows,
        "groove_pressure": pressure,
        "starved": np.any(lack > 1e-9 * units.scale, axis=1),
    }


def falls_dry(units: DiscreteFilm, row: Array) -> bool:
    """Whether a groove of a film, whose `row` is (flows, pressures), would have to rupture.

    Only laws with a fill can follow one whose feed gives less than the film draws.
    """
    pressure = row[units.pockets.count :][units.pockets.free]
    return not units.law.keeps_fill and bool(np.any(pressure < units.law.floor))
