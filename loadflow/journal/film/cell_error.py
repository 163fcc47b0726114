"""How far the cells may leave a solved film from that of ever finer ones, told by that film alone.

A pressure bends within a cell by its second differences from cell to cell. All that the cells leave
out, be it the pressure between their centres, the flow through their faces or the place of rupture,
is of that size; the stiffness of the film tells how far the shaft then moves. The shares below are
such that the bounds hold the error in 97 % of draws of each family of bearings
(``benchmarks/robustness/grid_bounds.py``); the midpoint rule alone leaves 1/24 of the differences.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import LOAD
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap import BoreGap
from loadflow.journal.film.surface_film import SurfaceFilm

Array = NDArray[np.float64]

_LOAD = 1.0 / 6.0  # of the load, of all second differences
_PEAK, _AT_PEAK = 0.4, 0.1  # of the peak, of all of them and of those next to it
_FED = 1.25  # of the peak beside grooves, at whose edges the pressure has corners
_TURN = 2.5  # of the attitude, of the way of the shaft: it turns more readily than it moves
_SHEAR, _DRAG = 1.0 / 30.0, 0.3  # of friction, of all of them and of the change of the gap
# where the unknowns lie on nodes and the film ends on the edges; the whole gap may close there
_NODES, _CLOSES = 1.25, 1.5
_LITTLE = 1e-6  # of the load, the least that a film beside asperities is taken to carry
_REGULAR = 1e-12  # determinant of a stiffness, over its largest entry squared, that is not 0
_FLOW, _OPEN = 1.0 / 3.0, 2.0  # of the side flow, of all of them and of what moves and opens


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
    share, missing, peak, _ = pressure_error(film, width, film.mesh.dz, 1.0)
    if film.pockets.count:
        peak *= _FED
    out = np.zeros(7)
    if stiffness is None:
        size = float(np.hypot(*load[:2]))
        out[0] = missing / size if size > 0.0 else 0.0
        out[4], out[5], out[6] = peak, _SHEAR * share, _FLOW * share
        return out
    moves = np.arange(gap.size)[free]
    response = _inverse(stiffness[free][:, free])
    unbalanced = np.where(moves < gap.shaft, missing, 0.0)
    unbalanced[(moves >= 2) & (moves < gap.shaft)] *= 0.5 * film.mesh.z_edges[-1]
    _, angle, z = gap.closest(position)
    growth = float(film.deformation.max()) / (film.relative_clearance * film.radius)
    narrow = max(gap.narrowest(position), np.finfo(float).tiny)
    far = float(np.hypot(*position[:2]))
    along = position[:2] / far if far > 0.0 else np.array([1.0, 0.0])
    facing = np.array([np.cos(angle), np.sin(angle), -z * np.sin(angle), z * np.cos(angle)])
    ways = np.zeros((3, gap.size))
    ways[0, :2], ways[1, :2] = along, (-along[1], along[0])
    ways[2, : min(gap.shaft, 4)] = facing[: gap.shaft]
    outward, sideways, closer = np.abs(ways[:, moves] @ response) @ unbalanced
    if far > 0.0:
        out[1], out[2] = outward / far, _TURN * np.hypot(outward, sideways) / far
    if gap.open_share is not None:  # rough surfaces keep a gap between them as their planes close
        closer *= float(gap.open_share.min())
    whole, shifted, touch = float(np.hypot(*load[:2])), 0.0, None
    if film.contact is not None and whole > 0.0:  # what the film leaves, asperities take
        touch = film.contact.at(position)
        lubricated = max(float(np.hypot(*(load - touch.load)[:2])), _LITTLE * whole)
        closer *= 1.0 + float(np.hypot(*touch.load[:2])) / whole
        # a film that carries little may do so in one spot
        shifted = missing * whole / lubricated**2
    pressed = _LOAD * share * growth  # what an elastic shell opens with the pressure
    out[3], out[4] = (closer + pressed) / narrow, peak + shifted
    out[5] = _SHEAR * share + _DRAG * out[3]
    out[6] = _FLOW * share + _OPEN * (out[1] + out[3])
    if touch is not None and rubbing > 0.0:
        out[5] += rubbing * missing / touch.normal
    return out


def pressure_error(
    film: DiscreteFilm, width: Array, across: Array, on_edges: float
) -> tuple[float, float, float, Array]:
    """Second differences over the pressure, what they leave of the load, N, and of the peak.

    `width` (nx,) and `across` (nz,) are those of the cells. `on_edges` is how far beyond the
    outermost values the ends lie: 1 half a cell, 0 a whole one. The differences of the cells
    (nx, nz) come last, times the share that counts, Pa.
    """
    pressure = film.state[LOAD]
    around, beside = _differences(film, on_edges)
    bends, area = around + beside, np.outer(width, across)
    bent = float(np.vdot(bends, area))
    whole = float(np.vdot(np.abs(pressure - film.p_edge), area))
    share = bent / whole if whole > 0.0 else 0.0
    row, column = np.unravel_index(int(pressure.argmax()), pressure.shape)
    highest, peak = float(pressure[row, column]), _PEAK * share
    if highest > 0.0:
        rows = np.arange(row - 1, row + 2) % len(pressure)
        near = rows[:, None], slice(max(0, column - 1), column + 2)
        peak += _AT_PEAK * float(around[near].max() + beside[near].max()) / highest
    return share, _LOAD * film.mirrors * film.radius**2 * bent, peak, _LOAD * bends


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

    def missing(self, rows: Array) -> Array:
        """Bounds (l,) of what combinations `rows` (l, m) of the loads on the film lack, N."""
        modes = np.einsum("lj,ji,jk->lik", rows, self._around, self._across)
        return np.asarray(np.einsum("ik,lik->l", self._left, np.abs(modes)))


def drag_error(shear: float, gap: float) -> float:
    """Relative bound of the friction of pads from that at a given position and that of the gap."""
    return shear + _CLOSES * gap


def _inverse(stiffness: Array) -> Array:
    """How far the shaft moves under a load; of a stiffness that is none the least."""
    if not np.isfinite(stiffness).all():
        return np.full(stiffness.shape, np.nan)
    if len(stiffness) == 2:
        (a, b), (c, d) = stiffness.tolist()
        det = a * d - b * c
        if abs(det) > _REGULAR * max(abs(a), abs(b), abs(c), abs(d)) ** 2:
            return np.array([[d, -b], [-c, a]]) / det
    return np.asarray(np.linalg.pinv(stiffness))
