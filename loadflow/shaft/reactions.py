"""Equilibrium of the shaft: statically determinate reactions of its supports.

Frame of the load cube: x along the shaft, downwind; z up; y completes it. A force F at position x
on the shaft has the moment x e_x × F = (0, −x Fz, x Fy) about the hub centre.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.shaft.options import Concept, MomentBearing, ThreePoint, TwoPoint

GRAVITY = 9.80665

Floats = NDArray[np.float64]


def bearing_loads(
    concept: Concept,
    hub_force: ArrayLike,
    hub_moment: ArrayLike,
    *,
    tilt: float = 0.0,
    time: ArrayLike | None = None,
) -> xr.Dataset:
    """Loads that the shaft applies to its bearings, from equilibrium at every instant.

    Inertia of the shaft across its axis is left out: it hardly moves.

    Parameters
    ----------
    concept : TwoPoint, ThreePoint or MomentBearing
        The suspension.
    hub_force : array_like, shape (3, n) or (3,)
        What the rotor applies to the shaft at the hub centre, weight included, N.
    hub_moment : array_like, shape (3, n) or (3,)
        Its moment about the hub centre, N m.
    tilt : float
        Tilt of the shaft, rad, positive when the hub is the higher end; it turns part of each
        weight along the shaft, downwind.
    time : array_like, shape (n,), optional
        Time, s.

    Returns
    -------
    xarray.Dataset
        `force` (N) and `moment` (N m) over (bearing, axis, time), with the coordinate
        `position` (bearing), m from the hub centre. The torque passes by all bearings.

    Raises
    ------
    loadflow.errors.InputError
        Shapes do not match, a load is not finite, or |tilt| is not below 90°.

    Examples
    --------
    >>> weight = [0.0, 0.0, -1.07e6]
    >>> loads = bearing_loads(TwoPoint(gearbox_mass=0.0), weight, [0.0, 0.0, 0.0])
    >>> [round(float(f) / 1e3) for f in loads["force"].sel(axis="z").isel(time=0)]
    [-1638, 568]
    """
    force, moment = _checked(hub_force, "hub_force"), _checked(hub_moment, "hub_moment")
    if force.shape != moment.shape:
        raise InputError(f"hub_force {force.shape} and hub_moment {moment.shape} must be alike")
    if not abs(tilt) < np.pi / 2:
        raise InputError(f"tilt = {tilt} rad: must be between -π/2 and π/2")
    down = np.array([np.sin(tilt), 0.0, -np.cos(tilt)])
    total, about_hub = force.copy(), moment.copy()
    for position, extra in _own_loads(concept, moment[0], down):
        total += extra
        about_hub += _moment_of(position, extra)
    if isinstance(concept, MomentBearing):
        return _one_support(concept, total, about_hub, time)
    return _two_supports(concept, total, about_hub, time)


def _checked(load: ArrayLike, name: str) -> Floats:
    values = np.asarray(load, dtype=float)
    if values.shape == (3,):
        values = values[:, None]
    if values.ndim != 2 or values.shape[0] != 3:
        raise InputError(f"{name}: shape must be (3, n), got {values.shape}")
    if not np.isfinite(values).all():
        axis, index = np.argwhere(~np.isfinite(values))[0]
        raise InputError(f"{name}: {values[axis, index]} at axis {'xyz'[axis]}, index {index}")
    return values


def _own_loads(concept: Concept, torque: Floats, down: Floats) -> Iterator[tuple[float, Floats]]:
    """Yield position and force of the weights and of the torque support."""
    yield concept.hub_to_shaft_centre, (concept.shaft_mass * GRAVITY * down)[:, None]
    if isinstance(concept, MomentBearing):
        return
    yield concept.gearbox_position, (concept.gearbox_mass * GRAVITY * down)[:, None]
    if concept.torque_arm:
        support = np.zeros((3, torque.size))
        support[2] = -torque / concept.torque_arm
        yield concept.gearbox_position, support


def _moment_of(position: float, force: Floats) -> Floats:
    """Moment about the hub centre of a force on the shaft axis."""
    return position * np.stack([np.zeros_like(force[0]), -force[2], force[1]])


def _one_support(
    concept: MomentBearing, total: Floats, about_hub: Floats, time: ArrayLike | None
) -> xr.Dataset:
    moment = about_hub - _moment_of(concept.hub_to_bearing, total)
    moment[0] = 0.0
    return _dataset(concept.bearings, (concept.hub_to_bearing,), total[None], moment[None], time)


def _two_supports(
    concept: TwoPoint | ThreePoint, total: Floats, about_hub: Floats, time: ArrayLike | None
) -> xr.Dataset:
    """Share the radial load between two supports without moment; the locating one takes thrust."""
    first, second = concept.positions
    about_first = about_hub - _moment_of(first, total)
    far = np.zeros_like(total)
    far[1] = about_first[2] / (second - first)
    far[2] = -about_first[1] / (second - first)
    near = total - far
    if isinstance(concept, TwoPoint):
        far[0], near[0] = total[0], 0.0
    forces = np.stack([near, far])
    return _dataset(concept.bearings, concept.positions, forces, np.zeros_like(forces), time)


def _dataset(
    bearings: tuple[str, ...],
    positions: tuple[float, ...],
    force: Floats,
    moment: Floats,
    time: ArrayLike | None,
) -> xr.Dataset:
    dims = ("bearing", "axis", "time")
    place = {
        "units": "m",
        "long_name": "position of the bearing along the shaft from the hub centre",
    }
    dataset = xr.Dataset(
        {
            "force": (
                dims,
                force,
                {"units": "N", "long_name": "force of the shaft on the bearing"},
            ),
            "moment": (
                dims,
                moment,
                {"units": "N m", "long_name": "moment of the shaft on the bearing"},
            ),
        },
        {
            "bearing": list(bearings),
            "axis": ["x", "y", "z"],
            "position": ("bearing", list(positions), place),
        },
    )
    if time is None:
        return dataset
    return dataset.assign_coords(time=("time", np.asarray(time, dtype=float), {"units": "s"}))
