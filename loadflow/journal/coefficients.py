"""Stiffness and damping of a film over the speed of the shaft, for rotor dynamics."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr

    from loadflow.journal.bearing import JournalBearing
    from loadflow.journal.film_model import Control, Film

Array = NDArray[np.float64]

DOF = ("e_x", "e_y", "tilt_x", "tilt_y")
"""Degrees of freedom of a film: two displacements (m), two rotations (rad)."""

COLUMNS = ("kxx", "kxy", "kyx", "kyy", "cxx", "cxy", "cyx", "cyy")
"""Columns of a table for rotor dynamics beside ``frequency`` (rad/s): N/m and N s/m."""

_KEPT = (
    "eccentricity_ratio", "attitude_angle", "minimum_film", "sommerfeld_number", "friction_power",
    "temperature", "converged", "residual", "iterations",
)  # fmt: skip


def rotor_coefficients(
    bearing: JournalBearing,
    force: ArrayLike,
    speed: ArrayLike,
    film: Film,
    *,
    whirl: float = 1.0,
    control: Control | None = None,
    **line: ArrayLike,
) -> xr.Dataset:
    """Stiffness K(ω) and damping C(ω) of a journal bearing under a load, over the speed ω.

    They are the exact derivatives of the film's force by displacement and velocity of the shaft at
    its equilibrium, so that M ẍ + C ẋ + K x = f of a rotor on this bearing. The fill of a ruptured
    film follows its gap without delay. Tilting pads follow the shaft at the frequency of vibration
    ``whirl · ω``; bores without pads have the same K and C at every frequency.

    Parameters
    ----------
    bearing : JournalBearing
        The bearing.
    force : array_like, shape (2,) or (n, 2)
        What the shaft applies to the bearing, N.
    speed : array_like, shape (n,)
        Speeds of the shaft, rad/s, not 0.
    film : Film
        The film. Its rung is taken as "grid", the only one that knows every bore.
    whirl : float
        Frequency of vibration over the speed, > 0: 1 for unbalance (synchronous).
    control : Control, optional
        How hard to solve.
    **line
        ``moment``, or ``tilt`` and ``bend``, as in `JournalBearing.equilibrium`; of those that let
        the shaft tilt, K and C also have its two rotations.

    Returns
    -------
    xarray.Dataset
        Over ``speed``, ``dof`` and ``along`` (`DOF`): ``stiffness`` and ``damping``; over ``speed``
        what `Equilibrium` says of the state, ``converged``, ``residual`` and ``iterations``
        included.

    Raises
    ------
    InputError
        Speeds that are no list of finite values other than 0; as `JournalBearing.equilibrium`.
    SolverError
        No equilibrium at one of the speeds, and ``control.strict``.

    Notes
    -----
    Lund, J. W. (1987), Review of the concept of dynamic coefficients for fluid film journal
    bearings, J. Tribology 109, 37.

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, JournalBearing, Lubricant, rotor_coefficients
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> film = Film(Lubricant(0.03), Guembel(), grid=(60, 20))
    >>> table = rotor_coefficients(bearing, (8e3, 0.0), [50.0, 100.0, 150.0], film)
    >>> table.stiffness.dims, bool(table.converged.all())
    (('speed', 'dof', 'along'), True)
    """
    import xarray as xr

    speeds = np.atleast_1d(np.asarray(speed, dtype=float))
    if speeds.ndim != 1 or not (np.isfinite(speeds) & (speeds != 0)).all():
        raise InputError(f"speed = {np.asarray(speed).tolist()}: a list of values other than 0")
    if not (np.isfinite(whirl) and whirl > 0):
        raise InputError(f"whirl = {whirl}: must be > 0")
    loads = np.broadcast_to(np.asarray(force, dtype=float), (speeds.size, 2))
    lying = {
        name: np.broadcast_to(np.asarray(value, dtype=float), (speeds.size, 2))
        for name, value in line.items()
    }
    film = replace(film, rung="grid")
    rows = [
        bearing.equilibrium(
            loads[k],
            float(speeds[k]),
            film,
            control=control,
            whirl=whirl * abs(float(speeds[k])),
            **{name: values[k] for name, values in lying.items()},
        )
        for k in range(speeds.size)
    ]
    found: dict[str, Any] = {
        name: ("speed", np.array([getattr(row, name) for row in rows]), FILM[name].attributes)
        for name in _KEPT
        if getattr(rows[0], name, None) is not None
    }
    for name in ("stiffness", "damping"):
        values = np.stack([getattr(row, name) for row in rows])
        found[name] = ("speed", "dof", "along"), values, FILM[name].attributes
    found["force"] = ("speed", "axis"), loads, FILM["force"].attributes
    dof = list(DOF[: found["stiffness"][1].shape[-1]])
    return xr.Dataset(
        found,
        {
            "speed": ("speed", speeds, FILM["speed"].attributes),
            "dof": dof,
            "along": dof,
            "axis": list("xy"),
        },
        {"whirl": whirl},
    )


def coefficient_table(coefficients: xr.Dataset) -> str:
    """Stiffness and damping against displacement as text with commas, for rotor dynamics.

    The columns are those of bearings in ROSS (Timbó et al. 2020): ``frequency`` (rad/s), then
    `COLUMNS` (N/m, N s/m), so that ROSS reads it by
    ``BearingElement(n, **pandas.read_csv(file).to_dict("list"))``. x and y are the axes of the
    film, the rotation turns x to y. Speeds rise; those without an equilibrium are left out.

    Parameters
    ----------
    coefficients : xarray.Dataset
        As `rotor_coefficients` gives it.

    Returns
    -------
    str
        Lines of text.

    Raises
    ------
    InputError
        No speed has an equilibrium.

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, JournalBearing, Lubricant, rotor_coefficients
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> film = Film(Lubricant(0.03), Guembel(), grid=(60, 20))
    >>> text = coefficient_table(rotor_coefficients(bearing, (8e3, 0.0), [100.0], film))
    >>> text.splitlines()[0]
    'frequency,kxx,kxy,kyx,kyy,cxx,cxy,cyx,cyy'
    """
    known = coefficients.isel(speed=coefficients["converged"].values.astype(bool))
    if not known.sizes["speed"]:
        raise InputError("no speed has an equilibrium: there is no stiffness to write")
    known = known.assign_coords(speed=np.abs(known["speed"])).sortby("speed")
    plane = list(DOF[:2])
    values = [
        known[name].sel(dof=plane, along=plane).values.reshape(-1, 4)
        for name in ("stiffness", "damping")
    ]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["frequency", *COLUMNS])
    for row in np.column_stack([known["speed"].values, *values]).tolist():
        writer.writerow([f"{value:.10g}" for value in row])
    return text.getvalue()
