"""Stribeck curve of a bearing: friction over speed, its minimum, and where asperities carry."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.film_model import Film
from loadflow.numerics.convergence import Control
from loadflow.numerics.fields import require
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]

_KEPT = (
    "eccentricity_ratio",
    "minimum_film",
    "maximum_pressure",
    "friction_power",
    "contact_power",
    "contact_share",
    "contact_pressure",
)
_FINE = 1e-4  # of a speed, to which minimum and transition are found
_TRIES = 60


def stribeck(
    bearing: JournalBearing,
    force: ArrayLike,
    speeds: ArrayLike,
    film: Film,
    share: float = 0.05,
    points: int = 31,
    control: Control | None = None,
) -> xr.Dataset:
    """Coefficient of friction over speed under one load, by an equilibrium at each speed.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    force : array_like (2,)
        What the shaft applies to it, N.
    speeds : array_like (n,)
        Increasing, > 0, rad/s; of two, `points` lie between them, evenly on a logarithmic scale.
    film : Film
        With `contact`; with `heat` each speed has its own temperature.
    share : float
        Share of the load on asperities, at which friction is said to turn from mixed to that of a
        full film.
    points : int
        Number of speeds between two.
    control : Control, optional
        How hard to solve. Not strict: speeds without an answer are NaN.

    Returns
    -------
    xarray.Dataset
        Over ``speed``: friction_coefficient P_f/(R ω F), eccentricity_ratio, minimum_film,
        maximum_pressure, friction_power, contact_power, contact_share, contact_pressure and
        converged. Without dimension: ``minimum_friction`` at ``minimum_speed``, and
        ``transition_speed``; NaN where they are not within `speeds`. Both are solved for between
        the speeds, to 1e-4 of them.

    Raises
    ------
    loadflow.errors.InputError
        A film without contact, no load, speeds that do not increase from above 0, a share out of
        range.
    loadflow.errors.SolverError
        A speed without an answer.

    Examples
    --------
    >>> from loadflow.journal import Contact, Film, JournalBearing, Lubricant, stribeck
    >>> from loadflow.tribology import AsperityContact
    >>> rough = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
    >>> film = Film(Lubricant(0.03), contact=Contact(rough, friction=0.1))
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> curve = stribeck(bearing, (80e3, 0.0), (0.1, 50.0), film, points=7)
    >>> round(float(curve.transition_speed), 1)
    0.9
    >>> bool(curve.transition_speed < curve.minimum_speed < 5.0)
    True
    """
    import xarray as xr

    if film.contact is None:
        raise InputError("contact: not given; a Stribeck curve needs the asperities of the film")
    load = np.asarray(force, dtype=float)
    require(load.shape == (2,) and bool(load.any()), "force", force, "(2,), N, not 0")
    require(0.0 < share < 1.0, "share", share, "between 0 and 1")
    speed = np.asarray(speeds, dtype=float)
    if speed.shape == (2,) and bool(np.all(speed > 0)):
        require(points >= 3, "points", points, "at least 3")
        speed = np.geomspace(speed[0], speed[1], points)
    good = speed.ndim == 1 and speed.size >= 2 and speed[0] > 0 and bool(np.all(np.diff(speed) > 0))
    require(good, "speeds", speeds, "(n,), rad/s, increasing from above 0")

    size = float(np.hypot(*load))
    answer = bearing.equilibrium(load, speed, film, control=control)
    coefficient = answer.friction_power / (bearing.radius * speed * size)
    lenient = replace(control or Control(), strict=False)

    def at(logarithm: float) -> tuple[float, float]:
        """Coefficient of friction and share of contact at a speed."""
        omega = float(np.exp(logarithm))
        state = bearing.equilibrium(load, omega, film, control=lenient)
        return float(state.friction_power) / (bearing.radius * omega * size), _share_of(state)

    logs = np.log(speed)
    least, where = _least(lambda x: at(x)[0], logs, coefficient)
    carried = np.asarray(answer.contact_share)
    change = _crossing(lambda x: at(x)[1] - share, logs, carried - share)
    found = {name: ("speed", getattr(answer, name), FILM[name].attributes) for name in _KEPT}
    return xr.Dataset(
        {
            "friction_coefficient": ("speed", coefficient, _said("1", "coefficient of friction")),
            **found,
            "converged": ("speed", answer.converged, FILM["converged"].attributes),
            "minimum_friction": ((), least, _said("1", "smallest coefficient of friction")),
            "minimum_speed": ((), where, _said("rad/s", "speed of the smallest friction")),
            "transition_speed": (
                (),
                change,
                _said("rad/s", f"speed at which asperities carry {share:g} of the load"),
            ),
        },
        coords={"speed": ("speed", speed, FILM["speed"].attributes)},
    )


def _share_of(state: object) -> float:
    return float(np.asarray(state.contact_share))  # type: ignore[attr-defined]


def _said(units: str, meaning: str) -> dict[str, str]:
    return {"units": units, "long_name": meaning}


def _least(value: Callable[[float], float], places: Array, known: Array) -> tuple[float, float]:
    """Smallest value between the places, and exp of its place; NaN where it lies at an end."""
    from scipy.optimize import minimize_scalar

    if not np.isfinite(known).all():
        return np.nan, np.nan
    lowest = int(np.argmin(known))
    if lowest in (0, known.size - 1):
        return np.nan, np.nan
    bracket = (float(places[lowest - 1]), float(places[lowest + 1]))
    options = {"xatol": _FINE, "maxiter": _TRIES}
    found = minimize_scalar(value, bounds=bracket, method="bounded", options=options)
    if not (found.success and np.isfinite(found.fun)):
        return np.nan, np.nan
    return float(found.fun), float(np.exp(found.x))


def _crossing(value: Callable[[float], float], places: Array, known: Array) -> float:
    """Exp of the last place at which a falling value passes 0; NaN without one."""
    from scipy.optimize import brentq

    falls = np.flatnonzero((known[:-1] > 0.0) & (known[1:] <= 0.0))
    if not falls.size:
        return np.nan
    last = int(falls[-1])
    ends = float(places[last]), float(places[last + 1])
    return float(np.exp(brentq(value, *ends, xtol=_FINE, maxiter=_TRIES)))
