"""How far the cells may leave a solved film from that of ever finer ones, told by that film alone.

A pressure bends within a cell by its second differences from cell to cell. All that the cells leave
out, be it the pressure between their centres, the flow through their faces or the place of rupture,
is of that size; the stiffness of the film tells how far the shaft then moves. The shares below are
such that the bounds hold the error in 97 % of draws of each family of bearings
(``benchmarks/robustness/grid_bounds.py``); the midpoint rule alone leaves 1/24 of the differences.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import FILL, LOAD
from loadflow.journal.film._kernels import E, G
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.gap import BoreGap
from loadflow.journal.film.surface.film import SurfaceFilm

Array = NDArray[np.float64]
Numbers = TypeVar("Numbers", float, Array)

LOAD_SHARE = 1.0 / 6.0  # of the load, of all second differences
_PEAK, _AT_PEAK = 0.4, 0.1  # of the peak, of all of them and of those next to it
_FED = 1.25  # of the peak beside grooves, at whose edges the pressure has corners
# of the attitude, of the way that the shaft may take at most: load is left out along itself, which
# hardly turns the shaft, but for grooves, which lie where they are
_TURN, _FED_TURN = 0.5, 2.5
_FED_MOVES = 1.6  # of the way of the shaft beside grooves
_SHEAR, _DRAG = 1.0 / 30.0, 0.3  # of friction, of all of them and of the change of the gap
# where the unknowns lie on nodes and the film ends on the edges; the whole gap may close there
_NODES, _CLOSES = 1.25, 1.5
_LITTLE = 1e-6  # of the load, the least that a film beside asperities is taken to carry
_REGULAR = 1e-12  # determinant of a stiffness, over its largest entry squared, that is not 0
_FLOW, _OPEN = 1.0 / 3.0, 2.0  # of the side flow, of all of them and of what moves and opens
_DRAWN = 1.25  # differences that count as many as slopes of oil from upstream sum up to


@np.errstate(over="ignore")  # of a film that its cells do not resolve at all
def relative_errors(
    film: DiscreteFilm,
    gap: BoreGap,
    position: Array,
    stiffness: Array | None,
    free: slice | NDArray[np.int64],
    load: Array,
    rubbing: float = 0.0,
) -> Array:
    """Relative bounds of a film last placed where it was solved, in the order of `BOUNDED`.

    Parameters
    ----------
    film, gap
        The film and its gap.
    position : array (m,)
        Where the shaft is, clearances.
    stiffness : array (m, m) or None
        Derivative of the load by the position, N per clearance; None where the position was given.
    free : slice or array of int
        Degrees of freedom in balance.
    load : array (m,)
        What film and asperities carry, N.
    rubbing : float
        Share of asperities in the friction.
    """
    width = np.hypot(gap.around[0], gap.around[1])
    left = Left(*pressure_error(film, width, film.mesh.dz, 1.0, _drawn(film))[:3])
    if stiffness is None:
        return held_errors(left, load)
    moves = np.arange(gap.size)[free]
    _, angle, z = gap.closest(position)
    of_shaft = moves < min(gap.shaft, 4)
    facing = np.zeros(moves.size)
    facing[of_shaft] = facing_slopes(np.cos(angle), np.sin(angle), z)[moves[of_shaft]]
    touch = None if film.contact is None else film.contact.at(position)
    return resting_errors(
        left,
        Balance(
            position=position[:2],
            facing=facing,
            stiffness=stiffness[free][:, free],
            arms=np.select([moves < 2, moves < gap.shaft], [1.0, 0.5 * film.mesh.z_edges[-1]]),
            narrow=gap.narrowest(position),
            growth=float(film.deformation.max()) / (film.relative_clearance * film.radius),
            opens=1.0 if gap.open_share is None else float(gap.open_share.min()),
            load=load[:2],
            touching=None if touch is None else touch.load[:2],
            rubbing=rubbing / touch.normal if touch is not None and rubbing > 0.0 else 0.0,
            fed=bool(film.pockets.count),
        ),
    )


class Left(NamedTuple):
    """What cells leave out: `share` of the pressure, `missing` load, N, and share of the `peak`."""

    share: float | Array
    missing: float | Array
    peak: float | Array


@dataclass(frozen=True)
class Balance:
    """Shafts in balance, as they answer to load that their film lacks; rows after any leading axes.

    Attributes
    ----------
    position : array (2,)
        Clearances.
    facing : array (n,)
        How the narrowest gap closes with each coordinate that moves, of which x and y come first.
    stiffness : array (n, n)
        Derivative of the load by these, N per clearance.
    arms : array (n,)
        Of the missing load about them; 0 of pads.
    narrow, growth : float
        Narrowest gap, and largest growth of an elastic shell, clearances.
    opens : float
        Least share of a growth of the mean planes by which the mean gap grows.
    load : array (2,)
        What film and asperities carry, N.
    touching : array (2,) or None
        What asperities carry of that; None without.
    rubbing : float
        Share of these in the friction, over what they are pressed with, 1/N.
    fed : bool
        Whether there are grooves of a supply.
    """

    position: Array
    facing: Array
    stiffness: Array
    arms: Array
    narrow: float | Array
    growth: float | Array
    opens: float | Array
    load: Array
    touching: Array | None
    rubbing: float | Array
    fed: bool


def facing_slopes(c: float, s: float, z: float) -> Array:
    """How the gap at an angle of cosine `c` and sine `s`, at `z`, closes with place and tilt."""
    return np.array([c, s, -z * s, z * c])


def held_errors(left: Left, load: Array) -> Array:
    """Relative bounds of films at given positions that carry `load` (…, 2), N."""
    out, size = np.zeros((*np.shape(left.share), 7)), np.hypot(load[..., 0], load[..., 1])
    out[..., 0] = np.where(size > 0.0, left.missing / np.where(size > 0.0, size, 1.0), 0.0)
    out[..., 4], out[..., 5], out[..., 6] = left.peak, _SHEAR * left.share, _FLOW * left.share
    return out


@np.errstate(over="ignore", invalid="ignore")  # of a film that its cells do not resolve at all
def resting_errors(left: Left, balance: Balance) -> Array:
    """Relative bounds of films in balance, as `relative_errors`; all may have leading axes."""
    missing, facing = np.asarray(left.missing), balance.facing
    x, y = balance.position[..., 0], balance.position[..., 1]
    far = np.hypot(x, y)
    known = np.where(far > 0.0, far, 1.0)
    along_x, along_y = np.where(far > 0.0, x / known, 1.0), y / known
    ways = np.zeros((*far.shape, 3, facing.shape[-1]))
    ways[..., 0, 0], ways[..., 0, 1] = along_x, along_y
    ways[..., 1, 0], ways[..., 1, 1], ways[..., 2, :] = -along_y, along_x, facing
    felt = missing * (_FED_MOVES if balance.fed else 1.0)
    moved = np.abs(ways @ _inverse(balance.stiffness)) @ balance.arms * felt[..., None]
    outward, sideways, closer = moved[..., 0], moved[..., 1], moved[..., 2]
    out = np.zeros((*far.shape, 7))
    out[..., 1] = np.where(far > 0.0, outward / known, 0.0)
    turn = _FED_TURN if balance.fed else _TURN
    out[..., 2] = np.where(far > 0.0, turn * np.hypot(outward, sideways) / known, 0.0)
    closer = closer * balance.opens  # rough surfaces keep a gap between them as their planes close
    whole, shifted = np.hypot(balance.load[..., 0], balance.load[..., 1]), 0.0
    if balance.touching is not None:  # what the film leaves, asperities take
        loaded, rest = np.where(whole > 0.0, whole, 1.0), balance.load - balance.touching
        carried = np.hypot(rest[..., 0], rest[..., 1])
        rubs = np.hypot(balance.touching[..., 0], balance.touching[..., 1])
        closer = closer * np.where(whole > 0.0, 1.0 + rubs / loaded, 1.0)
        # a film that carries little may do so in one spot
        shifted = missing * whole / np.maximum(carried, _LITTLE * loaded) ** 2
    # what an elastic shell opens with the pressure
    pressed = LOAD_SHARE * left.share * balance.growth
    out[..., 3] = (closer + pressed) / np.maximum(balance.narrow, np.finfo(float).tiny)
    out[..., 4] = left.peak + shifted
    out[..., 5] = _SHEAR * left.share + _DRAG * out[..., 3] + balance.rubbing * missing
    out[..., 6] = _FLOW * left.share + _OPEN * (out[..., 1] + out[..., 3])
    return out


def warm_errors(relative: Array, thinning: Array | float, ratio: Array, narrow: Array) -> Array:
    """Bounds (…, 7) of films whose viscosity the cells leave unknown by a share, too.

    Parameters
    ----------
    relative : array (…, 7)
        Bounds of the films at the viscosity that they have.
    thinning : array (…) or float
        Bound of what the cells do to the viscosity by way of the temperature, as a share.
    ratio, narrow : array (…)
        Eccentricity ratio and narrowest gap, clearances, of films under a load: they take the place
        at which a load changed by this share has them in oil of one viscosity. At a given place
        `narrow` is infinite, and the load changes by the share.
    """
    share, held = np.asarray(thinning, dtype=float), np.isinf(narrow)
    moved = np.where(held, 0.0, share)
    closer = moved * np.minimum(1.0, np.asarray(ratio) / np.maximum(narrow, 1e-300))
    more = (np.where(held, share, 0.0), moved, _TURN * moved, closer)
    peak = np.where(held, share, _PEAK * share)
    return np.asarray(relative + np.stack([*more, peak, share, share], axis=-1))


def pressure_error(
    film: DiscreteFilm,
    width: Array,
    across: Array,
    on_edges: float,
    drawn: Array | float = 0.0,
) -> tuple[float, float, float, Array]:
    """Second differences over the pressure, what they leave of the load, N, and of the peak.

    `width` (nx,) and `across` (nz,) are those of the cells. `on_edges` is how far beyond the
    outermost values the ends lie: 1 half a cell, 0 a whole one; `drawn` is what counts beside the
    differences around (nx, nz), Pa. All of the cells come last, times the share that counts, Pa.
    """
    pressure = film.state[LOAD]
    around, beside = _differences(film, on_edges)
    around = around + drawn
    bends, area = around + beside, np.outer(width, across)
    bent = float(np.vdot(bends, area))
    whole = float(np.vdot(np.abs(pressure - film.p_edge), area))
    share = bent / whole if whole > 0.0 else 0.0
    row, column = np.unravel_index(int(pressure.argmax()), pressure.shape)
    highest, beside_it = float(pressure[row, column]), 0.0
    if highest > 0.0:
        rows = np.arange(row - 1, row + 2) % len(pressure)
        near = rows[:, None], slice(max(0, column - 1), column + 2)
        beside_it = float(around[near].max() + beside[near].max()) / highest
    peak = peak_share(share, beside_it, bool(film.pockets.count))
    return share, LOAD_SHARE * film.mirrors * film.radius**2 * bent, peak, LOAD_SHARE * bends


def _drawn(film: DiscreteFilm) -> Array | float:
    """What cells (nx, nz) leave out of the pressure as their oil is taken from upstream, Pa.

    0 but of a law whose fill changes all over: others are in order where the film carries.
    """
    if not film.law.smooth:
        return 0.0
    mesh, fill, coef = film.mesh, film.state[FILL], film.gap.coef
    ends = (fill[-1:], fill[:1]) if mesh.closed else (fill[:1], fill[-1:])
    steps = np.abs(np.diff(np.concatenate([ends[0], fill, ends[1]]), axis=0))
    faces = steps * coef[E, :, : fill.shape[1]] / coef[G, :, : fill.shape[1]]
    over = min(float(mesh.z_edges[-1]), 1.0) / mesh.dx[:, None]
    each = 0.25 * abs(film.wedge) * (faces[:-1] + faces[1:]) * over
    return drawn_share(each, film.state[LOAD] - film.p_edge)


def drawn_share(each: Array, above: Array) -> Array:
    """What counts beside differences around of slopes that sum up to `each`, Pa.

    Where oil is taken from upstream, half of its change from cell to cell flows too much or too
    little: the pressure has to make up for that by its slope, until it has leaked out at the ends.
    It is off by no more than what it is `above` that of the ends.
    """
    return np.asarray(_DRAWN * np.minimum(each, np.abs(above)))


def peak_share(share: Numbers, beside: Numbers, fed: bool) -> Numbers:
    """Share of the peak that is left out, by that of all, and by differences `beside` it.

    `fed` says whether there are grooves of a supply.
    """
    return (_FED if fed else 1.0) * (_PEAK * share + _AT_PEAK * beside)


def _differences(film: DiscreteFilm, on_edges: float) -> tuple[Array, Array]:
    """Magnitudes of the second differences of the pressure around and across (nx, nz), Pa."""
    mesh, pressure = film.mesh, film.state[LOAD]
    nx, nz = pressure.shape

    def beyond(end: float, inner: Array) -> Array:
        return end + on_edges * (end - inner)

    around, across = np.empty((nx + 2, nz)), np.empty((nx, nz + 2))
    around[1:-1] = across[:, 1:-1] = pressure
    if mesh.closed:
        around[0], around[-1] = pressure[-1], pressure[0]
    else:
        around[0], around[-1] = (beyond(film.p_line, pressure[i]) for i in (0, -1))
    across[:, 0] = pressure[:, 0] if mesh.half else beyond(film.p_edge, pressure[:, 0])
    across[:, -1] = beyond(film.p_edge, pressure[:, -1])
    twice = 2.0 * pressure
    along = np.abs(around[:-2] + around[2:] - twice)
    return along, np.abs(across[:, :-2] + across[:, 2:] - twice)


class SurfaceError:
    """What the cells leave out of a film on a cone, a plane ring or a straight pad.

    Parameters
    ----------
    film : SurfaceFilm
        A film last placed where it was solved.

    Attributes
    ----------
    peak, shear : float
        Of the largest pressure, and of the friction at a given position, over them.
    """

    def __init__(self, film: SurfaceFilm) -> None:
        gap, mesh = film.gap, film.gap.mesh
        share, _, self.peak, left = pressure_error(film, mesh.weights[0], mesh.carrying, 0.0)
        self.shear = 2.0 * _NODES * _SHEAR * share
        self._left = _NODES * film.radius**2 * left
        self._around, self._across = gap.pressed, gap.across * mesh.carrying

    def missing(self, rows: Array) -> tuple[Array, Array]:
        """What combinations `rows` (l, m) of the loads on the film lack, N: (l,) and at most (l,).

        The first as if the cells left out of the pressure what has one sign all over.
        """
        modes = np.einsum("lj,ji,jk->lik", rows, self._around, self._across)
        signed = np.einsum("ik,lik->l", self._left, modes)
        return signed, np.einsum("ik,lik->l", self._left, np.abs(modes))


def drag_error(shear: float, gap: float) -> float:
    """Relative bound of the friction of pads from that at a given position and that of the gap."""
    return shear + _CLOSES * gap


def _inverse(stiffness: Array) -> Array:
    """How far shafts move under a load, (…, n, n); of a stiffness that is none the least."""
    if stiffness.shape == (2, 2):  # nearly all; arrays of one number take most of the time
        (a, b), (c, d) = stiffness.tolist()
        det, most = a * d - b * c, max(abs(a), abs(b), abs(c), abs(d))
        if abs(det) > _REGULAR * most * most:
            return np.array([[d, -b], [-c, a]]) / det
    finite = np.asarray(np.isfinite(stiffness).all(axis=(-2, -1)))
    known = np.where(finite[..., None, None], stiffness, 0.0)
    if stiffness.shape[-1] > 2:
        return np.where(finite[..., None, None], np.linalg.pinv(known), np.nan)
    a, b, c, d = (known[..., i, j] for i in (0, 1) for j in (0, 1))
    det = a * d - b * c
    regular = np.asarray(np.abs(det) > _REGULAR * np.abs(known).max(axis=(-2, -1)) ** 2)
    turned = np.stack([np.stack([d, -b], axis=-1), np.stack([-c, a], axis=-1)], axis=-2)
    inverse = turned / np.where(regular, det, 1.0)[..., None, None]
    if not regular.all():
        inverse = np.where(regular[..., None, None], inverse, np.linalg.pinv(known))
    return np.where(finite[..., None, None], inverse, np.nan)
