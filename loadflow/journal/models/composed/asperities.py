"""Asperities of a reduced film with effects: tables of what they carry, and where it is asked."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicHermiteSpline

from loadflow.journal.contact import Contact
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap._rough_kernels import NO_CONTACT
from loadflow.journal.film.gap.asperity_load import CylinderLoad
from loadflow.journal.film.gap.grooves import groove_numbers
from loadflow.journal.film.gap.rough import RoughGap, Roughness
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.composed.film import RIGID, Rough, Yielding
from loadflow.journal.models.composed.relief import depth_at
from loadflow.journal.models.composed.supply import parted_at
from loadflow.journal.models.ring import Ring
from loadflow.journal.models.width_modes import Nodes, on_places
from loadflow.journal.supply import Supply
from loadflow.tribology.kernels import pressure_integral

Array = NDArray[np.float64]

_LINES = 32  # across, on which the asperities of a shaft that tilts are asked
_PER_SIZE = 0.05  # distance of the eccentricities of the table of contact, over the roughness
_AROUND = np.radians(1.5)  # of a cell for each place, of Gauss, at which asperities are asked
_LEAST_AROUND = 3  # such places in a cell
_TOUCHES = 8.5  # film parameter above which asperities on a shell carry nothing, to rounding
_LONGEST = 10000  # entries of a table of these, 500 times the roughness


def rough_of(
    bearing: JournalGeometry, contact: Contact | None, whole: bool, units: DiscreteFilm
) -> Rough:
    """Asperities of the surfaces; none where they are smooth."""
    none = np.empty((0, 16))
    if contact is None:
        return Rough(0.0, none, none, 0.0, 0.0, 9.0, 1.0, np.zeros((4, 2)), np.zeros(1), np.ones(1))
    gap = RoughGap(units.mesh, contact, bearing.clearance)
    size, along, across, slip, _ = gap.rough.numbers
    first, step, table = _line_of_contact(contact, bearing.radius, bearing.clearance)
    x, w = np.polynomial.legendre.leggauss(_LINES if whole else 1)
    half = bearing.width / bearing.diameter
    return Rough(
        size, along, across, slip, gap.rough.deepest, first, step, table, half * x, half * w
    )


@lru_cache(maxsize=8)
def _line_of_contact(
    contact: Contact, radius: float, clearance: float
) -> tuple[float, float, Array]:
    """Table of what asperities carry on a shaft radius of width, over the eccentricity ratio."""
    surfaces = CylinderLoad(contact, radius, radius, clearance)
    size, tips = contact.asperities.roughness / clearance, contact.asperities.summit_height
    step = _PER_SIZE * size
    ratios = np.arange(1.0 - tips / clearance - NO_CONTACT * size, 1.0 + 0.04, step)
    ratios = ratios[: int((NO_CONTACT + 9.0) / _PER_SIZE)]
    touches = [surfaces.at(np.array([ratio, 0.0])) for ratio in ratios.tolist()]
    normal = np.array([touch.normal for touch in touches])
    table = np.stack(
        [
            [touch.load[0] for touch in touches],
            [touch.stiffness[0, 0] for touch in touches],
            normal,
            np.gradient(normal, step),
        ]
    )
    return float(ratios[0]), step, table


def yielding_of(
    bearing: JournalGeometry,
    options: Film,
    give: float,
    whole: bool,
    nodes: Nodes,
    ring: Ring,
    grows: bool = False,
) -> Yielding:
    """Asperities on a shell that gives way by `give`, clearances per Pa, or in a shaped bore.

    The pressure is that of `nodes` across; a bore that `grows` by heat has a shape, too.
    """
    contact, supply = options.contact, options.supply
    shaped = bearing.shape.segments or bearing.relief
    if contact is None or not (give or grows or shaped or supply):
        return RIGID
    half = bearing.width / bearing.diameter
    x, w = _lines(supply, bearing, whole)
    marks = () if supply is None else parted_at(supply, bearing)
    growth = on_places(nodes, marks, whole, x)
    values = np.ascontiguousarray(growth[:, : nodes.slopes.shape[1]])
    angle, around = np.arctan2(ring.sin, ring.cos), options.cells[0]
    numbers = groove_numbers(angle, half * x, half, supply, around, bearing.radius).T
    held = np.ascontiguousarray(numbers >= 0)  # transposed, it would have the loop compiled anew
    first, step, table = _yielding_gap(contact, bearing.clearance, give)
    places = max(int(np.ceil(2.0 * np.pi / options.cells[0] / _AROUND)), _LEAST_AROUND)
    share, part = np.polynomial.legendre.leggauss(places)
    share, part = 0.5 * (1.0 + share), 0.5 * part
    turns = np.outer(ring.apart, share) - ring.back[:, None]
    at = (ring.cos_face + 1j * ring.sin_face)[:, None] * np.exp(1j * turns)
    return Yielding(
        True, first, step, table, values, growth, half * x, half * w, depth_at(bearing, half * x),
        share, part, at.real.copy(), at.imag.copy(), held & np.roll(held, -1, axis=1),
        contact.asperities.scale * bearing.radius**2,
    )  # fmt: skip


def _lines(supply: Supply | None, bearing: JournalGeometry, whole: bool) -> tuple[Array, Array]:
    """Places across at which asperities are asked, shares of the half width, and their weights.

    Where grooves end, one rule of Gauss ends and another begins.
    """
    ends = () if supply is None else parted_at(supply, bearing)
    if whole and not ends:
        return np.polynomial.legendre.leggauss(_LINES)
    x, w = np.polynomial.legendre.leggauss(_LINES // 2)
    edges = np.array([0.0, *ends, 1.0])
    middles, halves = 0.5 * (edges[1:] + edges[:-1]), 0.5 * np.diff(edges)
    places = (middles[:, None] + halves[:, None] * x).ravel()
    weights = 2.0 * np.outer(halves, w).ravel()  # both halves are alike
    if not whole:
        return places, weights
    return np.append(-places, places), 0.5 * np.append(weights, weights)


@lru_cache(maxsize=8)
def _yielding_gap(contact: Contact, clearance: float, give: float) -> tuple[float, float, Array]:
    """Table of `Yielding` on a shell that gives way by `give`, clearances per Pa."""
    rough = Roughness(contact, clearance, give * clearance)
    lifted, size, summits = rough.yields
    lowest = min(-rough.deepest, summits)
    planes = np.arange(lowest, summits + (_TOUCHES + 1.0) * size, 0.2 * _PER_SIZE * size)
    pairs = np.array([pressure_integral(h) for h in ((planes - summits) / size).tolist()])
    value, slope = pairs[:, 0], pairs[:, 1] / size
    share = 1.0 / (1.0 - lifted * slope)
    gap = planes - lifted * value
    step, last = _PER_SIZE * size, summits + _TOUCHES * size
    # farther down the shell gives way as straight as the table goes on
    wanted = np.arange(max(gap[0], last - _LONGEST * step), last, step)
    opens = CubicHermiteSpline(gap, planes, share)(wanted)
    at = np.array([pressure_integral(h) for h in ((opens - summits) / size).tolist()])
    rise = at[:, 1] / size
    opened = 1.0 / (1.0 - lifted * rise)
    return float(wanted[0]), step, np.stack([opens, opened, at[:, 0], rise * opened])
