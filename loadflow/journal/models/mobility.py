"""The mobility map: velocity of the shaft over position and load, tabulated from the grid solution.

A film without grooves feels the rotation of the shaft only through ω_eff = ω − 2 γ' (3.8), γ' the
speed at which the eccentricity turns. Seen in the frame that turns with the eccentricity its force
is a function of ε and of u = ė − ω × e / 2, the velocity of the shaft against the mean flow of the
oil; solved for u this is the mobility of Booker 1965, so that the path of the shaft follows from
an ordinary differential equation without any solving. A fill, if the law has one, is taken as
steady in that frame.

A film whose pressures all scale with the load (Reynolds, Gümbel, Sommerfeld at cavitation
pressure) needs ε and the direction of the load only; else ambient pressure is a unit of pressure,
and the load in that unit a third axis.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.models import _mobility_kernels as kernel
from loadflow.journal.models.mobility_films import (
    FILL,
    GAPS,
    LOADS,
    ODD,
    STIFFNESS,
    Found,
    MovingFilm,
    approach,
)
from loadflow.numerics.splines import spline

Array = NDArray[np.float64]

LARGEST_RATIO = 0.995
_SCALE = 0.05  # s1: loads below feel a full film
_SMALLEST = 1e-3  # load that stands for the limit 0


@dataclass(frozen=True)
class Nodes:
    """How fine a map is: nodes over ξ and χ, and the step of y."""

    xi: int
    chi: int
    load_step: float = 0.5


FLAT, DEEP = Nodes(33, 29), Nodes(21, 17)  # without and with the axis of loads


@dataclass(frozen=True, eq=False)
class MobilityMap:
    """Map of one film without dimensions.

    Attributes
    ----------
    motion : array (n_ξ, n_χ, n_y, 2)
        Spline coefficients of the velocity, see `_map_kernels`.
    results : array (n_ξ, n_χ, n_y, 12)
        Spline coefficients of what else is asked of the film, see `results_at`.
    axes : array (6,)
        Steps and ends of the axes.
    covered : array of bool, one smaller than the coefficients at either end
        Nodes at which the film carries the load; elsewhere stand the values of the next one
        outward.
    solved, seconds : int, float
        Film solutions that it took, and time.
    """

    motion: Array
    results: Array
    axes: Array
    covered: NDArray[np.bool_]
    solved: int
    seconds: float

    def results_at(self, position: Array, load: Array) -> tuple[Array, Array]:
        """1 − ε, χ, s (n, 3), and the rows of results (n, 12), at positions and loads (n, 2)."""
        place, raw = np.empty((len(load), 3)), np.empty((len(load), 12))
        kernel.along(self.results, self.axes, position, np.ascontiguousarray(load), place, raw)
        values = np.where(np.arange(12) < FILL, np.exp(raw), raw)
        values[:, STIFFNESS.start :] = np.sinh(raw[:, STIFFNESS.start :])
        values[:, ODD] *= np.where(place[:, 1] < 0, -1.0, 1.0)[:, None]
        return place, values * place[:, [2]] ** LOADS * place[:, [0]] ** GAPS

    def covers(self, place: Array) -> NDArray[np.bool_]:
        """Whether the film was solved all around `place` (n, 3): 1 − ε, χ, s."""
        axes, solved = self.axes, self.covered
        xi = -np.log(place[:, 0])
        y = np.log1p(place[:, 2] / axes[kernel.S1]) if solved.shape[2] > 1 else 0 * xi
        steps = (
            xi / axes[kernel.D_XI],
            np.abs(place[:, 1]) / axes[kernel.D_CHI],
            y / axes[kernel.D_Y],
        )
        inside = xi <= axes[kernel.XI_MAX] * (1 + 1e-9)
        for corner in np.ndindex(2, 2, 2):
            index = tuple(
                np.clip(np.floor(s).astype(int) + c, 0, n - 1)
                for s, c, n in zip(steps, corner, solved.shape)
            )
            inside &= solved[index]
        return inside


def scaled(options: Film) -> tuple[Film, float]:
    """The film without dimensions, and its unit of pressure, Pa; 0 where the load is the unit."""
    law = options.law
    unit = law.pressure_unit(options.edge_pressure)
    scaled_law = law.scaled(unit)
    edge = 1.0 if unit else 0.0
    lubricant = Lubricant(1.0 / 12.0)
    return replace(options, lubricant=lubricant, cavitation=scaled_law, edge_pressure=edge), unit


@lru_cache(maxsize=16)
def tabulate(
    width_ratio: float, options: Film, largest: float, nodes: Nodes | None = None
) -> MobilityMap:
    """Map of a film without dimensions, kept for the next call.

    Parameters
    ----------
    width_ratio : float
        B/D.
    options : Film
        As `scaled` returns them.
    largest : float
        Largest load s; only used where ambient pressure is the unit.
    nodes : Nodes, optional
        How fine; default `FLAT` or `DEEP`.

    Raises
    ------
    SolverError
        The film has no solution at the lightest load.
    """
    begin = perf_counter()
    film = MovingFilm(width_ratio, options)
    nodes = nodes or (DEEP if options.edge_pressure > 0.0 else FLAT)
    xi = np.linspace(0.0, -math.log(1.0 - LARGEST_RATIO), nodes.xi)
    chi = np.linspace(0.0, math.pi, nodes.chi)
    y, sizes = np.zeros(1), np.ones(1)
    if options.edge_pressure > 0.0:
        top = math.log1p(largest / _SCALE)
        y = np.linspace(0.0, top, max(5, math.ceil(top / nodes.load_step) + 1))
        sizes = np.maximum(_SCALE * np.expm1(y), _SMALLEST)
    shape = (xi.size, chi.size, y.size)
    motion, results = np.empty((*shape, 2)), np.empty((*shape, 12))
    covered = np.zeros(shape, dtype=bool)
    for j, turn in enumerate(chi.tolist()):
        fill_column(film, -np.expm1(-xi), turn, sizes, motion[:, j], results[:, j], covered[:, j])
    results[0, ..., STIFFNESS] = results[1, ..., STIFFNESS]  # the limit, where no load rests
    axes = np.array([xi[1], chi[1], y[1] if y.size > 1 else 1.0, _SCALE, xi[-1], sizes[-1]])
    return MobilityMap(
        _splines(motion, np.array([False, True])),
        _splines(results, ODD),
        axes,
        covered,
        film.solved,
        perf_counter() - begin,
    )


def _splines(table: Array, odd: NDArray[np.bool_]) -> Array:
    """Coefficients over ξ, χ and y; the mirror at χ = 0 and π closes the splines over χ."""
    coef = spline(table, 0, "smooth")
    coef = np.where(odd, spline(coef, 1, "odd"), spline(coef, 1, "even"))
    return np.ascontiguousarray(coef if table.shape[2] == 1 else spline(coef, 2, "smooth"))


def fill_column(
    film: MovingFilm,
    ratios: Array,
    chi: float,
    sizes: Array,
    motion: Array,
    results: Array,
    covered: NDArray[np.bool_],
) -> None:
    """Fill `motion` (n_ξ, n_y, 2), `results` (n_ξ, n_y, 12) and `covered` for one χ.

    The lightest load from the centre outward; heavier ones from the narrowest gap inward, as far as
    the film carries them: a starved film does so only where the gap is narrow.
    """
    top = ratios.size - 1
    at = (float(ratios[0]), float(sizes[0]))
    found: Found | None = Found(film.film.start(), at[1] * np.array([math.cos(chi), math.sin(chi)]))
    first = at, found
    for k, size in enumerate(sizes.tolist()):
        at, found = first
        for i in range(top + 1) if k == 0 else range(top, -1, -1):
            node = (float(ratios[i]), size)
            found = found and approach(film, at, node, chi, found)
            values = found and film.values(*node, found)
            if not values:
                break
            motion[i, k], results[i, k] = values
            covered[i, k] = True
            at = node
            if i == top:
                first = at, found
        else:
            continue
        if k == 0:
            raise SolverError(f"no map: no film at ε = {ratios[i]:.4g}, χ = {chi:.4g}")
        if i == top:
            motion[:, k:], results[:, k:] = motion[:, [k - 1]], results[:, [k - 1]]
            return
        motion[: i + 1, k], results[: i + 1, k] = motion[i + 1, k], results[i + 1, k]
