"""What both reduced films share: cells around, fixed to the shell, their oil, their messages."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film.discretise import build_film
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.solvers.estimate import closed_form_position
from loadflow.journal.solvers.messages import no_equilibrium, not_found
from loadflow.numerics.convergence import unresolved

Array = NDArray[np.float64]


class Ring(NamedTuple):
    """Cells around, and what fills them.

    Attributes
    ----------
    cos, sin, cos_face, sin_face : array (nx,)
        Of the cell centres, and of the faces behind them.
    order : array (nx,)
        Place of each column of cells in the folded band.
    law : int
        Address of the law of cavitation.
    numbers : array
        Its parameters.
    edge_fill : float
        Fill of the oil that enters at the bearing ends.
    scale, p_edge : float
        Scale of pressure, and pressure at the ends, Pa.
    slope : float
        12 η/ψ², Pa s.
    area : float
        Load over ∫ p over the points across: R², or 2 R² of half the width, m².
    """

    cos: Array
    sin: Array
    cos_face: Array
    sin_face: Array
    order: NDArray[np.int64]
    law: int
    numbers: Array
    edge_fill: float
    scale: float
    p_edge: float
    slope: float
    area: float


def units_of(bearing: JournalGeometry, options: Film, speed: Array) -> DiscreteFilm:
    """The grid's film without effects on cells fixed to the shell: its units, law and cells."""
    bare = replace(
        options, grading="uniform", inlet=None, contact=None, shell=None, turbulence=None
    )
    film = build_film(bearing.diameter, bearing.width, bearing.relative_clearance, bare)
    film.set_scale(float(np.abs(speed).max()))
    return film


def ring_of(film: DiscreteFilm, share: float) -> Ring:
    """Cells of the grid's `film`; the points across are those of 1/`share` of the width."""
    angle = film.mesh.angle
    face = angle + np.pi / angle.size
    return Ring(
        np.cos(angle), np.sin(angle), np.cos(face), np.sin(face), film.mesh.order,
        film.law.address, np.array(film.law.numbers), film.law.fill_at(film.p_edge),
        film.scale, film.p_edge, film.slope, share * film.radius**2,
    )  # fmt: skip


def estimates(bearing: JournalGeometry, film: DiscreteFilm, force: Array, speed: Array) -> Array:
    """Positions (n, 2) by the closed form, clearances."""
    numbers = [
        bearing.sommerfeld_number(*point, film.viscosity)
        for point in zip(np.hypot(*force.T).tolist(), speed.tolist())
    ]
    ratio = bearing.width / bearing.diameter
    finite = np.where(np.isfinite(numbers), numbers, 1e9)
    return closed_form_position(ratio, finite, force, speed, film.ruptures)


def no_start(
    force: Array, speed: float, ratio: float, found: tuple[float, float, float]
) -> SolverError:
    """Say that an orbit has no equilibrium to start from.

    Parameters
    ----------
    force, speed, ratio
        First load (2,), N, its speed, rad/s, and the eccentricity ratio at which Newton ended.
    found : tuple of float
        Residual, its rounding level, and Newton steps.
    """
    why = not_found(*found, ratio)
    return SolverError(f"orbit cannot start: {no_equilibrium(force, speed, why)}")


def stopped(
    time: float, force: Array, speed: float, ratio: float, found: tuple[float, float, float]
) -> SolverError:
    """Say at which load an orbit stops; parameters as those of `no_start`."""
    return SolverError(
        f"orbit stops at t = {time:.6g} s: F = ({force[0]:.6g}, {force[1]:.6g}) N, "
        f"ω = {speed:.6g} rad/s, ε = {ratio:.6g}; {unresolved(*found)}"
    )
