"""Solved films as rows of results: what a film says, by the names of the fields of `FilmState`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.film._kernels import HM
from loadflow.journal.film.cell_error import relative_errors
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.groove_pressure import UNSUPPLIED
from loadflow.journal.film.integrals import summary
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.validity import critical_reynolds_number, reynolds_number
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    from loadflow.journal.film.film import DiscreteFilm
    from loadflow.journal.film.gap.gap import BoreGap
    from loadflow.journal.film.linearised import Linear
    from loadflow.journal.lubricant import Lubricant
    from loadflow.journal.solvers.newton import Solution

Array = NDArray[np.float64]


def columns_of(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Turn a list of rows into arrays that lead with the rows."""
    return {name: np.array([row[name] for row in rows]) for name in rows[0]}


def shaped(columns: dict[str, Any], shape: tuple[int, ...]) -> dict[str, Any]:
    """Give the leading axis of `columns` the `shape` of the input; () makes scalars, None stays."""
    return {
        name: None if values is None else values.reshape(shape + values.shape[1:])[()]
        for name, values in columns.items()
    }


def static_row(
    bearing: JournalGeometry,
    film: DiscreteFilm,
    gap: BoreGap,
    load: Array,
    lubricant: Lubricant,
    solution: Solution,
    whirl: float = 0.0,
) -> dict[str, Any]:
    """One row of `Equilibrium`; pads are condensed at the frequency `whirl`, rad/s."""
    position = solution.position[:2] if solution.converged else np.full(2, np.nan)
    return {
        **operating_columns(bearing, load, film.speed, lubricant, position),
        **_common_row(film, gap, solution, solution.linear.stiffness, whirl),
    }


def operating_columns(
    bearing: JournalGeometry,
    force: Array,
    speed: Any,
    lubricant: Lubricant,
    position: Array,
) -> dict[str, Any]:
    """What `Equilibrium` says of loads (…, 2), speeds (…) and positions (…, 2), in clearances."""
    critical = np.full(np.shape(speed), critical_reynolds_number(bearing.relative_clearance))
    reynolds = reynolds_number(bearing, speed, lubricant)
    return {
        "force": force,
        "speed": speed,
        "eccentricity": position * bearing.clearance,
        "attitude_angle": attitude_angle(force, position, speed),
        "sommerfeld_number": bearing.sommerfeld_number(
            np.hypot(force[..., 0], force[..., 1]), speed, lubricant.viscosity
        ),
        "reynolds_number": reynolds,
        "critical_reynolds_number": critical,
        "laminar": reynolds < critical,
        "shell_deformation": np.zeros(np.shape(speed)),
    }


def starts_of(bearing: JournalGeometry, count: int, near: Any = None) -> Array | None:
    """Where shafts on tilting pads are looked for first, `Line.near`; None on other bores.

    Parameters
    ----------
    bearing : JournalGeometry
        The bearing.
    count : int
        Number of loads.
    near : Equilibrium, optional
        Answer of a similar bearing under these loads.

    Raises
    ------
    loadflow.errors.InputError
        `near` is of other loads, or of another number of pads.
    """
    pads = len(Bore.of(bearing).pads)
    if near is not None:
        known = math.prod(near.eccentricity.shape[:-1]), near.pad_tilt.shape[-1]
        got, allowed = ("{} load(s) on {} pads".format(*two) for two in (known, (count, pads)))
        require(known == (count, pads), "near", got, allowed)
    if not pads:
        return None
    starts = np.full((count, 2 + pads), np.nan)
    if near is not None:
        rows = {name: getattr(near, name) for name in ("eccentricity", "pad_tilt")}
        starts[:] = start_rows(
            bearing, {name: values.reshape(count, -1) for name, values in rows.items()}
        )
    return starts


def start_rows(bearing: JournalGeometry, found: dict[str, Any]) -> Array:
    """Rows of `Line.near` that answers (n, …) give; NaN where there is none."""
    shaft, pads = found["eccentricity"] / bearing.clearance, found["pad_tilt"]
    return np.column_stack([shaft, pads / bearing.relative_clearance])


def answered_rows(found: NDArray[np.bool_], columns: dict[str, Any]) -> dict[str, Any]:
    """Columns of which the rows that have not been `found` (n,) say nothing but that."""
    kept = ("force", "speed", "residual", "critical_reynolds_number")
    factor = np.where(found, 1.0, np.nan)
    blank = {
        name: times_rows(values, factor)
        for name, values in columns.items()
        if name not in kept and values is not None and values.dtype == float
    }
    return columns | blank | {"converged": columns["converged"] & found}


def times_rows(values: Any, factor: Array) -> Any:
    """Rows of `values` times `factor` (n,)."""
    if values is None:
        return None
    return values * factor.reshape(factor.shape + (1,) * (values.ndim - 1))


def without_supply(count: int) -> dict[str, Any]:
    """What `Equilibrium` says of the supply of `count` films that have none."""
    return {name: np.array([value] * count) for name, value in UNSUPPLIED.items()}


def field_row(film: DiscreteFilm, gap: BoreGap, solution: Solution) -> dict[str, Any]:
    """One row of `FilmField`, but for z, of a film and its `gap`."""
    cells = field_cells(film, gap, solution.u, solution.position)
    load = film.load_of(film.gap.place(solution.position), solution.position)
    return {
        "film_force": -load[:2],
        "force": load[:2],
        **cells,
        **_common_row(film, gap, solution, None),
    }


def field_cells(film: DiscreteFilm, gap: BoreGap, u: Array, position: Array) -> dict[str, Any]:
    """What `FilmField` says of the cells at `u` and `position`; the half film is mirrored."""
    *cells, angle, _ = film.field(u, position)
    cells += [film.deformation, _mean_gap(film, gap.arcs(position))]
    if film.mesh.half:
        cells = [np.concatenate([values[:, ::-1], values], axis=1) for values in cells]
    names = ("pressure", "fill", "deformation", "gap")
    return {**dict(zip(names, cells)), "angle": angle}


def _mean_gap(film: DiscreteFilm, arcs: Array) -> Array:
    """Mean gap of the cells, m, where the film was last placed: ∫h dθ over the `arcs`, rad."""
    columns, rows = film.mesh.shape
    heights = film.gap.coef[HM, :columns, :rows] / arcs[:, None]
    return np.broadcast_to(heights * film.relative_clearance * film.radius, film.mesh.shape)


def _common_row(
    film: DiscreteFilm,
    gap: BoreGap,
    solution: Solution,
    balanced: Array | None,
    whirl: float = 0.0,
) -> dict[str, Any]:
    """What both have; `balanced` is the stiffness that held the shaft, None at a given position."""
    clearance = film.relative_clearance * film.radius
    row: dict[str, Any] = summary(film, solution.u, solution.position)
    rubbing = row.get("contact_power", 0.0) / max(row["friction_power"], 1e-300)
    carried = solution.free, solution.linear.load, rubbing
    row["relative_grid_error"] = relative_errors(film, gap, solution.position, balanced, *carried)
    shaft, lengths = film.gap.shaft, np.ones(film.gap.shaft)
    lengths[2:] = film.radius  # of the degrees of freedom: those of tilts are arms
    rows = np.arange(film.gap.size)[solution.free]
    pads = rows[rows >= shaft]
    stiffness, damping = without_pads(solution.linear, shaft, pads, whirl)
    both = np.outer(lengths, lengths) / clearance
    row["eccentricity_ratio"] = float(np.hypot(*solution.position[:2]))
    row["stiffness"] = stiffness * both
    row["damping"] = damping * both
    tilted = shaft > 2
    row["moment"] = film.radius * solution.linear.load[2:4] if tilted else np.zeros(2)
    per_radius = clearance / film.radius
    row["tilt"] = per_radius * solution.position[2:4] if tilted else np.zeros(2)
    row["pad_tilt"] = per_radius * solution.position[shaft:]
    row["shell_deformation"] = float(film.deformation.max())
    if not solution.converged:
        row = {name: _nothing(value) for name, value in row.items()}
    row["converged"] = solution.converged
    row["iterations"] = solution.iterations
    row["residual"] = solution.residual
    return row


def without_pads(
    linear: Linear, shaft: int, pads: NDArray[np.int64], whirl: float
) -> tuple[Array, Array]:
    """Stiffness and damping of the shaft alone while `pads` follow it without moment.

    The shaft vibrates at the frequency `whirl`, rad/s, and K + i ν C is condensed; at 0 what is
    left of it to first order in ν. Both are exact: the pads have no inertia.
    """
    k, c = linear.stiffness, linear.damping
    if not pads.size:
        return k[:shaft, :shaft], c[:shaft, :shaft]
    every = np.append(np.arange(shaft), pads)
    k, c = k[np.ix_(every, every)], c[np.ix_(every, every)]
    if whirl == 0.0:
        follow = np.vstack([np.eye(shaft), -following(k, shaft)])
        lead = np.vstack([np.eye(shaft), -following(k.T, shaft)])
        return lead.T @ k @ follow, lead.T @ c @ follow
    z = k + 1j * whirl * c
    left = z[:shaft, :shaft] - z[:shaft, shaft:] @ following(z, shaft)
    return left.real, left.imag / whirl


def following(stiffness: NDArray[Any], shaft: int) -> NDArray[Any]:
    """How far pads tilt with the shaft, (pads, shaft)."""
    pads, by_shaft = stiffness[shaft:, shaft:], stiffness[shaft:, :shaft]
    if not (np.isfinite(pads).all() and np.isfinite(by_shaft).all()):
        return np.full_like(by_shaft, np.nan)
    size = np.sqrt(np.maximum(np.abs(np.diag(pads)), np.finfo(float).tiny))
    scaled = pads / np.outer(size, size)
    # least squares: a pad that its film does not hold stays
    return np.asarray(np.linalg.lstsq(scaled, by_shaft / size[:, None])[0] / size[:, None])


def _nothing(value: Any) -> Any:
    """NaN in the shape of `value`; flags are False."""
    return False if isinstance(value, bool) else np.full_like(value, np.nan)


def attitude_angle(force: Array, position: Array, speed: ArrayLike) -> Array:
    """Angle from load to eccentricity, > 0 with rotation; the limit π/2 where either vanishes."""
    cross = force[..., 0] * position[..., 1] - force[..., 1] * position[..., 0]
    along = (force * position).sum(axis=-1)
    angle = np.arctan2(np.where(np.asarray(speed) < 0, -1.0, 1.0) * cross, along)
    return np.where(force.any(axis=-1) & position.any(axis=-1), angle, 0.5 * np.pi)
