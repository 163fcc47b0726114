"""Tilting pads of a reduced film: what the compiled loops ask of them, and work on.

A pad that tilts by t clearances sees the shaft at its place and t along the tangent at the pivot,
so that all that the gap of the pad knows of its tilt is that shift.
"""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.ring import Ring
from loadflow.journal.questions import AtRest
from loadflow.journal.solvers.motion.start import orbit_film, orbit_start
from loadflow.journal.solvers.statics import Statics

Array = NDArray[np.float64]

_CURVE = 200  # places of the table of tilts
_NOWHERE = np.array([0.0, 1.0])  # of a table of pads that no film holds


class Pads(NamedTuple):
    """Constants of pads.

    Attributes
    ----------
    cell, face : array of int (nx,)
        Pad of each column of cells, and of the face behind it; −1 in a groove.
    along, toward : array (p, 2)
        Directions of the tangents at the pivots, and of the pivots.
    base, base_face : array (nx,)
        As those of `Ring` with flat pads.
    lobe : array (2, nx)
        The same of x and y of its `lobe`.
    groove : array of bool (nx,)
        The grooves between them.
    edge : float
        Unknown of a film at the pressure of the ends.
    widest : array (2,)
        Gap at the pivot up to which a film holds a pad, clearances, where the shaft turns forward,
        and backward.
    first, step : array (2,)
        Gaps of the table of tilts: logarithm of the first one, and distance.
    tilts : array (2, n)
        Tilts against the shaft at which a film holds a pad, clearances.
    """

    cell: NDArray[np.int64]
    face: NDArray[np.int64]
    along: Array
    toward: Array
    base: Array
    base_face: Array
    lobe: Array
    groove: NDArray[np.bool_]
    edge: float
    widest: Array
    first: Array
    step: Array
    tilts: Array


_FEW, _FLAT = np.zeros(0, dtype=np.int64), np.zeros((0, 2))
NO_PADS = Pads(
    _FEW, _FEW, _FLAT, _FLAT, np.zeros(0), np.zeros(0), np.zeros((2, 0)), np.zeros(0, dtype=bool),
    0.0, np.zeros(2), np.zeros(2), np.zeros(2), np.zeros((2, 0)),
)  # fmt: skip
"""Those of a bore that has none."""


class PadWork(NamedTuple):
    """Work arrays of pads.

    Attributes
    ----------
    tilts : array (4, p)
        At the time before the last, at the last, at the next one; a Newton step of them.
    on : array of bool (p,)
        Which have a film.
    load : array (p, 4)
        What each carries, N, its moments over the shaft radius.
    carried : array (p, 5, 4)
        What each of the columns carries on it.
    touch : array (p, 5, 4)
        What surfaces that touch carry on each, N, then its derivatives by the position.
    follow : array (p, 6)
        Moment, N, and its derivatives by the position of the shaft and by the tilt.
    system : array (4, 5)
        Linear system of a step of the shaft.
    spare, spare_tilts, spare_on : array (2, nx, m), (2, p), (p,)
        Films, tilts, and which have one, while a step on other pads is tried.
    """

    tilts: Array
    on: NDArray[np.bool_]
    load: Array
    carried: Array
    touch: Array
    follow: Array
    system: Array
    spare: Array
    spare_tilts: Array
    spare_on: NDArray[np.bool_]


def pads_of(ring: Ring, gap: ShapedGap, edge: float) -> Pads:
    """Pads of the bore of `gap`, whose cells are those of `ring`; `edge` as in `Pads`."""
    count = gap.pads.size
    number: NDArray[np.int64] = np.cumsum(ring.groove) - ring.groove  # of pads, and grooves behind
    curves = [gap.pad_curve(sense) for sense in (1.0, -1.0)]
    reach = [np.log(curve.gaps[[0, -1]]) if curve.gaps.size else _NOWHERE for curve in curves]
    gaps = [np.linspace(ends[0], ends[1], _CURVE) for ends in reach]
    return Pads(
        cell=np.where(ring.groove, -1, number),
        face=np.where(ring.groove, (number + 1) % count, number),
        along=gap.layout.tangents.copy(),
        toward=gap.pivots.copy(),
        base=ring.base.copy(),
        base_face=ring.base_face.copy(),
        lobe=ring.lobe[1:].copy(),
        groove=ring.groove.copy(),
        edge=edge,
        widest=np.array([curve.widest for curve in curves]),
        first=np.array([some[0] for some in gaps]),
        step=np.array([some[1] - some[0] for some in gaps]),
        tilts=np.array([curve.lift(np.exp(some)) for curve, some in zip(curves, gaps)]),
    )


def make_pad_work(shape: tuple[int, int], count: int) -> PadWork:
    """Allocate the work arrays of `count` pads for unknowns of a `shape`."""
    return PadWork(
        tilts=np.zeros((4, count)),
        on=np.zeros(count, dtype=bool),
        load=np.zeros((count, 4)),
        carried=np.zeros((count, 5, 4)),
        touch=np.zeros((count, 5, 4)),
        follow=np.zeros((count, 6)),
        system=np.zeros((4, 5)),
        spare=np.zeros((2, *shape)),
        spare_tilts=np.zeros((2, count)),
        spare_on=np.zeros(count, dtype=bool),
    )


def narrowest_on_pads(
    bearing: JournalGeometry, centres: Array, depth: Array, tilts: Array
) -> Array:
    """Narrowest gap (n,) of shafts seen at `centres` (n, f, 2) by pads of `tilts` (n, p).

    At these places the pads are `depth` (f,) farther away, clearances.
    """
    bore = Bore.of(bearing)
    least = np.full(len(centres), np.inf)
    for number, part in enumerate(bore.segments):
        along = np.array([-np.sin(part.narrowest), np.cos(part.narrowest)])
        seen = centres + (tilts[:, number, None] * along)[:, None]
        gaps = replace(bore, segments=(part,)).narrowest(seen.reshape(-1, 2))
        least = np.minimum(least, (gaps.reshape(len(centres), -1) + depth).min(axis=1))
    return least


class FirstOnPads(NamedTuple):
    """Where a path on pads begins: position (4,) and tilts (p,), clearances, pads with a film."""

    place: Array
    tilts: Array
    on: NDArray[np.bool_]


def first_on_pads(
    asked: AtRest, start: Array | None, warm: Statics | None = None
) -> tuple[FirstOnPads, ShapedGap]:
    """State of a path at the one load of its first time, that of the grid; and the gap of that.

    A film that is `warm` from place to place is given by its cells on the grid.

    Raises
    ------
    loadflow.errors.InputError
        A start outside the bore.
    OrbitStopped
        No film to start from.
    """
    force, speed = asked.force, asked.speed
    statics = warm or orbit_film(asked.bearing, asked.film, force, speed, asked.line)[0]
    gap = cast("ShapedGap", statics.gap)
    first = orbit_start(statics, force[0], float(speed[0]), start, asked.limits)
    place = np.zeros(4)
    place[: gap.shaft] = first.position[: gap.shaft]
    on = np.isin(gap.pads, np.arange(gap.size)[first.free])
    return FirstOnPads(place, np.where(on, first.position[gap.pads], 0.0), on), gap
