"""Grooves and pockets of a supply in a reduced film: which points they hold at their pressure.

Columns of cells have their edges on those of the grooves, as on the grid. Across, the width is
parted where grooves end, so that their pressure ends between two stretches.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.grooves import groove_marks, groove_numbers
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.width_modes import Nodes, stretched_width
from loadflow.journal.supply import Supply

Array = NDArray[np.float64]

_POINTS = 5  # inside the stretches of half of the width that are parted once
_CLOSE = 1e-7  # to a groove, in shaft radii, at which a point is in it
_ENDS = 1e-9  # share of the half width by which a groove may miss the bearing end


def nodes_beside(supply: Supply | None, bearing: JournalGeometry, whole: bool) -> Nodes | None:
    """Points across a width that grooves part; None where none does."""
    if supply is None:
        return None
    half = bearing.width / bearing.diameter
    _, ends = groove_marks(supply.grooves, 1, bearing.radius)
    shares = np.unique(np.round(ends / half, 12))
    marks = tuple(shares[(shares > _ENDS) & (shares < 1.0 - _ENDS)].tolist())
    if not marks:
        return None
    middle = min(max(round(4.0 * marks[0]), 1), _POINTS - 2)
    return stretched_width(half, marks, (middle, _POINTS - middle), whole)


class Held(NamedTuple):
    """What grooves of a supply hold of a film, and what they take of its drag.

    Attributes
    ----------
    on : bool
        Whether there are any.
    grooves : array of int (nx, m)
        Number of the groove that holds each point, −1 for none; one at the end of a groove is held.
    drags : array (nx, m)
        Share of the width of each point that is beside grooves.
    """

    on: bool
    grooves: NDArray[np.int64]
    drags: Array


def held_points(units: DiscreteFilm, options: Film, nodes: Nodes, around: int) -> Held:
    """Which points of a film of `around` columns its supply holds.

    Raises
    ------
    loadflow.errors.InputError
        A groove beyond the bearing end, or two that overlap.
    """
    angle, points = units.mesh.angle, nodes.slopes.shape[1]
    if options.supply is None:
        shape = around, points
        return Held(False, np.full(shape, -1), np.ones(shape))
    half, z = float(units.mesh.z_edges[-1]), nodes.z[:points]
    asked = options.cells[0], units.radius
    below, above = (
        groove_numbers(angle, z + by, half, options.supply, *asked) for by in (-_CLOSE, _CLOSE)
    )
    drags = nodes.below * (below < 0) + (1.0 - nodes.below) * (above < 0)
    return Held(True, np.maximum(below, above), drags)


def put_in_grooves(units: DiscreteFilm, held: Held, pressure: Array) -> None:
    """Give the points that grooves hold their pressure, Pa, in place."""
    inner = pressure[:, : held.grooves.shape[1]]
    for number, given in enumerate(units.pockets.feed.guess(units.p_edge)):
        inner[held.grooves == number] = given


def supplied(units: DiscreteFilm, flows: Array) -> dict[str, Any]:
    """Flow and pressure of the grooves of films whose `flows` (n, g) are in their units."""
    feed, flows = units.pockets.feed, units.pockets.flow_unit * flows
    pressure = np.array(feed.guess(units.p_edge))
    return {
        "supply_flow": flows.sum(axis=1),
        "supply_power": np.array([feed.power(pressure, flow) for flow in flows]),
        "groove_flow": flows,
        "groove_pressure": np.tile(pressure, (len(flows), 1)),
    }
