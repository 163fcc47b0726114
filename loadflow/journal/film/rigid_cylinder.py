"""Films that compiled loops take whole: which ones they are, and what is handed over.

They are those that are solved most often: an aligned shaft in a rigid cylinder, smooth surfaces,
laminar flow of one viscosity, and grooves of given pressure or none. All others are solved part by
part, `DiscreteFilm.linearise`, so that each effect only says what it changes.
"""

from __future__ import annotations

import math
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.gap import CylindricalGap
from loadflow.journal.film.imbalance import flux_of

Array = NDArray[np.float64]


class Cylinder(NamedTuple):
    """What the loops take of a film, by the names of its parts; arrays are its own.

    Attributes
    ----------
    address, numbers, scale
        The law, its parameters, and the scale of pressure, Pa.
    face, cell, strength, polar, closed, cells, order, bandwidth
        The mesh.
    filling : tuple of float
        As of `CavitationLaw.filling`.
    fixed : array (nx, nz)
        Cells that are held.
    wedge, slope, edges
        What the motion drags along, what the squeeze presses, and what drives the flow at the ends.
    unit : float
        Of loads, m².
    flux, width : float
        Scale of what flows through a cell, and width of all cells across, shaft radii.
    state, coefs, places, beside, across, band
        Cells, gap and matrix, filled by the loops.
    pivots, growth, modes, fields, carried, loads
        Work arrays.
    columns : array (2, m + 2, n)
        Room for the answers of the last two linearisations; m is 3, or 2 of a mesh that turns.
    found : array (2, 5, 2)
        Load, stiffness and damping of the last linearisation, and of the one at work.
    weights, moving : array (m + 2,), (2,)
        Of the columns in a step; velocity of the shaft.
    """

    address: int
    numbers: Array
    scale: float
    face: Array
    cell: Array
    strength: float
    polar: bool
    closed: bool
    cells: tuple[Array, Array, Array]
    order: NDArray[np.int64]
    bandwidth: int
    filling: tuple[float, float]
    fixed: NDArray[np.bool_]
    wedge: float
    slope: float
    edges: tuple[float, float, float]
    unit: float
    flux: float
    width: float
    state: Array
    coefs: Array
    places: Array
    beside: Array
    across: Array
    band: Array
    pivots: NDArray[np.int32]
    growth: Array
    modes: Array
    fields: Array
    carried: Array
    loads: Array
    columns: Array
    found: Array
    weights: Array
    moving: Array


def as_cylinder(film: DiscreteFilm) -> Cylinder | None:
    """What compiled loops take of a `film`, at its scale and speed; None: it has more to it."""
    gap = film.gap
    if type(film) is not DiscreteFilm or type(gap) is not CylindricalGap:
        return None
    if film.pockets.free.size or gap.surfaces is not None or film.thickening is not None:
        return None
    known = cast("Cylinder | None", film.whole)
    if known is None:
        known = film.whole = _laid_out(film, gap)
    filling = film.law.filling(film.scale)
    return known._replace(scale=film.scale, filling=filling, wedge=film.wedge, flux=flux_of(film))


def _laid_out(film: DiscreteFilm, gap: CylindricalGap) -> Cylinder:
    """The parts of a film, and room to work."""
    mesh, moves, count = film.mesh, len(gap.coefs), len(film.ab)
    face, cell = mesh.trigonometry
    most = moves + gap.size
    return Cylinder(
        address=film.address,
        numbers=film.numbers,
        scale=film.scale,
        face=face,
        cell=cell,
        strength=float(mesh.strength),
        polar=mesh.polar,
        closed=mesh.closed,
        cells=mesh.cells,
        order=mesh.order,
        bandwidth=mesh.bandwidth,
        filling=film.law.filling(film.scale),
        fixed=film.fixed,
        wedge=film.wedge,
        slope=film.slope,
        edges=film.edges,
        unit=film.unit,
        flux=math.nan,
        width=float(mesh.dz.sum()),
        state=film.state,
        coefs=gap.coefs,
        places=gap.beside[0],
        beside=gap.beside[1],
        across=gap.across,
        band=film.ab,
        pivots=np.empty(count, dtype=np.int32),
        growth=np.empty((moves, mesh.angle.size, 1)),
        modes=np.empty((moves, gap.size, mesh.angle.size)),
        fields=np.empty((most, *mesh.shape)),
        carried=np.empty((most, gap.size)),
        loads=np.empty((moves, gap.size)),
        columns=np.zeros((2, most, count)),
        found=np.zeros((2, 1 + 2 * gap.size, gap.size)),
        weights=np.zeros(most),
        moving=np.zeros(gap.size),
    )
