"""Stiffness and damping of a rolling bearing over the speed of the shaft, for rotor dynamics."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.quantities import FILM
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.stiffness.rotor_coefficients import Model, Result, rotor_coefficients

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Tilt = Literal["held", "free", "kept"]

DOF = ("e_x", "e_y", "tilt_x", "tilt_y")
"""Degrees of freedom: two displacements across the axis (m), two rotations (rad), as of a film."""

_KEPT: dict[Tilt, list[int]] = {"held": [0, 1, 3, 4], "free": [0, 1], "kept": [0, 1, 3, 4]}
_SOFT = 1e-9  # of the stiffest motion, below which nothing resists one


def condensed(stiffness: NDArray, scale: Array, kept: list[int]) -> NDArray:
    """Stiffness (n, k, k), real or complex, of the motions `kept`; the others follow it freely.

    They follow without a change of load. A motion that nothing resists, such as that of cylindrical
    rollers along the shaft, follows by nothing. `scale` (5,) makes all motions lengths.
    """
    rest = [k for k in range(stiffness.shape[-1]) if k not in kept]
    even = stiffness * np.outer(scale, scale)
    held, across = even[:, kept][:, :, kept], even[:, kept][:, :, rest]
    real = not np.iscomplexobj(even)
    follow = np.linalg.pinv(even[:, rest][:, :, rest], rcond=_SOFT, hermitian=real)
    left = held - across @ follow @ across.swapaxes(-1, -2)
    return left / np.outer(scale[kept], scale[kept])


def coefficients_over_speed(
    result: Result,
    speed: ArrayLike,
    *,
    whirl: float = 1.0,
    tilt: Tilt = "held",
    options: FrictionOptions | None = None,
    model: Model = "film",
    loss: float = 0.01,
    time_constant: float = 1e-5,
) -> xr.Dataset:
    """Stiffness K(ω) and damping C(ω) of a rolling bearing under a load, over the speed ω.

    They are those of `rotor_coefficients` across the axis, of a vibration at ``whirl · ω``, so that
    M ẍ + C ẋ + K x = f of a rotor on this bearing. The ring moves along its axis without a change
    of load. What the steel loses in a cycle does not depend on its frequency, so that C falls with
    1/ω: it belongs to a vibration of that frequency and to no other.

    Parameters
    ----------
    result : ContactResult
        Equilibrium under one load, with rigid rings.
    speed : array_like, shape (n,)
        Speeds of the rings against each other, rad/s, not 0. They give the films.
    whirl : float
        Frequency of vibration over the speed, > 0: 1 for unbalance (synchronous).
    tilt : {"held", "free", "kept"}
        Whether the shaft stays as it is tilted, tilts freely, or has its rotations in K and C, too.
    options, model, loss, time_constant
        As `rotor_coefficients`.

    Returns
    -------
    xarray.Dataset
        Over ``speed``, ``dof`` and ``along`` (`DOF`): ``stiffness`` and ``damping``, as
        `loadflow.journal.rotor_coefficients` has them of a film; over ``speed`` ``converged``,
        ``residual`` and ``iterations`` of the equilibrium.

    Raises
    ------
    InputError
        Several loads; speeds that are no list of finite values other than 0; as
        `rotor_coefficients`.

    Examples
    --------
    >>> from loadflow.rolling import RollerBearing, coefficients_over_speed
    >>> bearing = RollerBearing(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
    ...     pitch_diameter=60.5e-3)
    >>> table = coefficients_over_speed(bearing.equilibrium(force=(2000, 0, 0)), [50.0, 100.0],
    ...     model="dry")
    >>> table.stiffness.dims, round(float(table.damping[0, 0, 0] / table.damping[1, 0, 0]), 6)
    (('speed', 'dof', 'along'), 2.0)
    """
    import xarray as xr

    speeds = np.atleast_1d(np.asarray(speed, dtype=float))
    if speeds.ndim != 1 or not (np.isfinite(speeds) & (speeds != 0)).all():
        raise InputError(f"speed = {np.asarray(speed).tolist()}: a list of values other than 0")
    if not (np.isfinite(whirl) and whirl > 0):
        raise InputError(f"whirl = {whirl}: must be > 0")
    check_one_of("tilt", tilt, tuple(_KEPT))
    if result.cases not in ((), (1,)):
        raise InputError(f"result of {result.cases} loads: give that of one load")
    told: dict[str, Any] = {
        "options": options, "model": model, "loss": loss, "time_constant": time_constant,
    }  # fmt: skip
    kept, rows = _KEPT[tilt], []
    for one in np.abs(speeds).tolist():
        frequency = whirl * one
        found = rotor_coefficients(result, [frequency], speed=one, **told)
        k, c = (found[part].values[0, 0, :5, :5] for part in ("stiffness", "damping"))
        rows.append(condensed((k + 1j * frequency * c)[None], result.contacts.scale, kept)[0])
    size = 2 if tilt == "held" else len(kept)
    matrix = np.stack(rows)[:, :size, :size]
    dims, dof = ("speed", "dof", "along"), list(DOF[:size])
    damping = matrix.imag / (whirl * np.abs(speeds))[:, None, None]
    solved = {
        name: ("speed", np.full(speeds.size, np.asarray(getattr(result, name)).ravel()[0]))
        for name in ("converged", "residual", "iterations")
    }
    return xr.Dataset(
        {
            "stiffness": (dims, matrix.real, FILM["stiffness"].attributes),
            "damping": (dims, damping, FILM["damping"].attributes),
        }
        | {name: (*values, FILM[name].attributes) for name, values in solved.items()},
        {
            "speed": ("speed", speeds, FILM["speed"].attributes),
            "dof": dof,
            "along": dof,
        },
        {"whirl": whirl, "model": model},
    )
