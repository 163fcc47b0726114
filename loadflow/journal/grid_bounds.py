"""Bounds of what the cells of a grid do to each result."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import ValidityWarning

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

BOUNDED = (
    "force",
    "eccentricity_ratio",
    "attitude_angle",
    "minimum_film",
    "maximum_pressure",
    "friction_power",
    "side_flow",
)
"""Results that have a bound, in the order of the last axis of `relative_grid_error`."""

UNRESOLVED = 0.25
"""Relative bound from which on a grid does not resolve the film."""

_MATTER = [BOUNDED.index(name) for name in ("force", "minimum_film")]


@dataclass(frozen=True)
class GridError:
    """Bounds of the errors of the fields of `Equilibrium` of the same names, in their units.

    Infinite where a coarser grid, if one was asked, has no answer.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> error = bearing.equilibrium((1e4, 0.0), 100.0, Lubricant(0.02)).grid_error
    >>> bool(0.0 < error.maximum_pressure < 1e5)  # Pa
    True
    """

    eccentricity_ratio: Array
    attitude_angle: Array
    minimum_film: Array
    maximum_pressure: Array
    friction_power: Array
    side_flow: Array


@dataclass(frozen=True)
class FieldError:
    """Bounds of the errors of the fields of `FilmField` of the same names, in their units.

    That of the force is one for all its components.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> field = bearing.pressure((5e-5, 0.0), 100.0, Lubricant(0.02))
    >>> bool(0.0 < field.grid_error.force < 0.03 * abs(field.force[0]))
    True
    """

    force: Array
    maximum_pressure: Array
    friction_power: Array
    side_flow: Array


@dataclass(frozen=True)
class PadError:
    """Bounds of the errors of the fields of results of pads of the same names, in their units.

    That of the force is one for all its components, 0 of a force that was given.

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, Lubricant, ThrustBearing
    >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4, wedge=0.75)
    >>> film = Film(Lubricant(0.05), Guembel(), grid=(20, 10))
    >>> found = bearing.equilibrium(force=1e6, speed=10.0, film=film)
    >>> bool(0.0 < found.grid_error.minimum_film < 0.05 * found.minimum_film)
    True
    """

    force: float
    minimum_film: float
    maximum_pressure: float
    friction_power: float


def resolved(relative: Array, converged: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Whether bounds (…, 7) say that the cells resolve the gap, or the load at a given one."""
    worst = np.asarray(relative)[..., _MATTER].max(axis=-1)
    return np.asarray(converged & (worst < UNRESOLVED))


@contextmanager
def unresolved_counted() -> Iterator[None]:
    """Where whoever asks keeps bound and pressure of every sample, or needs a rough number.

    No warning of these is given.
    """
    with warnings.catch_warnings():
        for what in ("the cells do not resolve", "the pressure of"):
            warnings.filterwarnings("ignore", what, ValidityWarning)
        yield


def warn_if_unresolved(columns: dict[str, Array]) -> None:
    """Warn of converged films, `columns` (n, …) of results, that the cells do not resolve.

    Nothing is known of the cells of other rungs than "grid" and "reduced", and too little where
    asperities carry: the bounds were not held against finer cells there.

    Warns
    -----
    loadflow.errors.ValidityWarning
        Names the worst and its bound.
    """
    if "relative_grid_error" not in columns:
        return
    found, bounds = columns["converged"].astype(bool), columns["relative_grid_error"]
    if columns.get("contact_share") is not None:
        found = found & ~(np.asarray(columns["contact_share"]) > 0.0)
    missed = found & ~resolved(bounds, found)
    if not missed.any():
        return
    worst = np.where(missed[:, None], bounds, 0.0)[:, _MATTER]
    case, which = np.unravel_index(int(np.argmax(worst)), worst.shape)
    name, share = BOUNDED[_MATTER[int(which)]], float(worst[case, which])
    warnings.warn(
        f"the cells do not resolve the film of {np.count_nonzero(missed)} of {found.size} loads: "
        f"{_off_by(name, share, int(case), columns)}; a finer grid or grading resolves it",
        ValidityWarning,
        stacklevel=3,
    )


def warn_if_path_unresolved(path: xr.Dataset) -> None:
    """Warn of a `path` whose attributes say that its cells do not resolve its narrowest film.

    As at rest, nothing is said of asperities that carry there.

    Warns
    -----
    loadflow.errors.ValidityWarning
        Says when, and the bound.
    """
    if path.attrs.get("resolved", 1):
        return
    films = path["minimum_film"].values
    at = int(np.nanargmin(films))
    if "contact_share" in path and float(path["contact_share"][at]) > 0.0:
        return
    share = float(path.attrs["minimum_film_grid_error"] / films[at])
    warnings.warn(
        f"the cells do not resolve the film of the path: minimum_film at t = "
        f"{float(path['time'][at]):.6g} s {_may_be_off(share)}; a finer grid resolves it",
        ValidityWarning,
        stacklevel=3,
    )


def _may_be_off(share: float) -> str:
    if share < 1.0:
        return f"may be off by {100 * share:.0f} %"
    return "is not bounded, it may be off by more than itself"


def _off_by(name: str, share: float, case: int, columns: dict[str, Array]) -> str:
    """How far a result may be off, in words: a share of what nearly cancels would say nothing."""
    told = f"{name} of number {case}"
    if share >= 1.0 and name == "force" and "force" in columns:
        size = float(np.linalg.norm(np.asarray(columns["force"])[case]))
        return f"{told} nearly cancels: {size:.3g} N, known to {share * size:.2g} N"
    return f"{told} {_may_be_off(share)}"
