"""Loads on the bearings: of a rigid shaft from equilibrium, of an elastic one as it bends.

Frame of the load cube: x along the shaft, downwind; z up; y completes it. A force F at position x
on the shaft has the moment x e_x × F = (0, −x Fz, x Fy) about the hub centre.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.shaft.beam import Beam
from loadflow.shaft.elastic import (
    BearingModel,
    EquationsOf,
    Iteration,
    ShaftMotion,
    elastic_reactions,
)
from loadflow.shaft.in_films import ShaftInFilms
from loadflow.shaft.options import Concept

GRAVITY = 9.80665

Floats = NDArray[np.float64]


def bearing_loads(
    concept: Concept,
    hub_force: ArrayLike,
    hub_moment: ArrayLike,
    *,
    tilt: float = 0.0,
    time: ArrayLike | None = None,
    models: Mapping[str, BearingModel] | None = None,
    tolerance: float = 1e-10,
    strict: bool = True,
) -> xr.Dataset:
    """Loads that the shaft applies to its bearings, from equilibrium at every instant.

    Inertia of the shaft across its axis is left out: it hardly moves.

    Parameters
    ----------
    concept : TwoPoint, ThreePoint, Integrated, DirectDrive or MomentBearing
        The suspension. With a `beam` the shaft bends: bearings that resist tilting then share the
        load according to their stiffness, and all tell the tilt of the shaft in them.
    hub_force : array_like, shape (3, n) or (3,)
        What the rotor applies to the shaft at the hub centre, weight included, N.
    hub_moment : array_like, shape (3, n) or (3,)
        Its moment about the hub centre, N m.
    tilt : float
        Tilt of the shaft, rad, positive when the hub is the higher end; it turns part of each
        weight along the shaft, downwind.
    time : array_like, shape (n,), optional
        Time, s.
    models : mapping, optional
        What bearings do under load, by name: functions of force and moment (n, 3) that return
        displacement (n, 4) and stiffness (n, 4, 4) in y, z, θy, θz. They replace the constant
        stiffness in the beam's supports; shaft and bearings are iterated until they agree.
    tolerance : float
        Largest change of a reaction in the last iteration, relative to the largest reaction.
    strict : bool
        Raise for a load under which shaft and bearings do not agree; else `converged` is False.

    Returns
    -------
    xarray.Dataset
        `force` (N) and `moment` (N m) over (bearing, axis, time), with the coordinate
        `position` (bearing), m from the hub centre. The torque passes by all bearings. With a beam
        also `displacement` (m), `tilt` (rad) and `curvature` (1/m) of the shaft in each bearing,
        the `bore_tilt` (rad) of that bearing on its housing and frame, and the attributes
        `converged`, `residual` and `iterations`; with models also `converged`
        (bearing, time), whether shaft and bearings agree.

    Raises
    ------
    loadflow.errors.InputError
        Shapes do not match, a load is not finite, or |tilt| is not below 90°; models without a
        beam, or of a bearing that is not there; none of a support whose stiffness comes from one.
    loadflow.errors.SolverError
        Shaft and bearing models do not converge, and `strict`.

    Examples
    --------
    >>> from loadflow.shaft import TwoPoint, bearing_loads
    >>> weight = [0.0, 0.0, -1.07e6]
    >>> loads = bearing_loads(TwoPoint(gearbox_mass=0.0), weight, [0.0, 0.0, 0.0])
    >>> [round(float(f) / 1e3) for f in loads["force"].sel(axis="z").isel(time=0)]
    [-1638, 568]
    """
    force, moment = _checked(hub_force, "hub_force"), _checked(hub_moment, "hub_moment")
    if force.shape != moment.shape:
        raise InputError(f"hub_force {force.shape} and hub_moment {moment.shape} must be alike")
    if time is not None and np.shape(time) != force.shape[1:]:
        raise InputError(f"time: shape must be {force.shape[1:]}, got {np.shape(time)}")
    own, total, about_hub = _all_loads(concept, force, moment, tilt)
    numbered = _numbered(concept, models or {})
    if concept.beam is None:
        across = _one_support if len(concept.bearings) == 1 else _two_supports
        forces, moments = across(concept, total, about_hub)
        motion = None
    else:
        iteration = Iteration(tolerance, strict)
        motion = elastic_reactions(*_on_beam(concept, force, moment, own), numbered, iteration)
        forces, moments = motion.force, motion.moment
    forces[concept.locating, 0] = total[0]
    return _dataset(concept, forces, moments, motion, time, bool(models))


def shaft_in_films(
    concept: Concept, hub_force: Floats, hub_moment: Floats, *, tilt: float = 0.0
) -> ShaftInFilms:
    """The shaft of a suspension as the films of its two bearings let it lie.

    Parameters
    ----------
    concept, hub_force, hub_moment, tilt
        As of `bearing_loads`; a suspension with a beam and two bearings.

    Raises
    ------
    loadflow.errors.InputError
        As `bearing_loads`; no beam, another number of bearings than two.
    """
    force, moment = _checked(hub_force, "hub_force"), _checked(hub_moment, "hub_moment")
    if concept.beam is None or len(concept.bearings) != 2:
        raise InputError("a shaft lies in films where it has a beam and two bearings")
    own, total, _ = _all_loads(concept, force, moment, tilt)
    return ShaftInFilms(EquationsOf(*_on_beam(concept, force, moment, own), whole=True), total[0])


def films_dataset(concept: Concept, motion: ShaftMotion, along: Floats) -> xr.Dataset:
    """Loads and motion (as of `bearing_loads`) of a shaft in films, with the force `along` it."""
    forces = motion.force
    forces[concept.locating, 0] = along
    return _dataset(concept, forces, motion.moment, motion, None, True)


def _all_loads(
    concept: Concept, force: Floats, moment: Floats, tilt: float
) -> tuple[list[tuple[float, Floats]], Floats, Floats]:
    """Loads on the shaft beside those of the hub, all together, and their moment about the hub."""
    if not abs(tilt) < np.pi / 2:
        raise InputError(f"tilt = {tilt} rad: must be between -π/2 and π/2")
    down = np.array([np.sin(tilt), 0.0, -np.cos(tilt)])
    own = list(_own_loads(concept, moment[0], down))
    total, about_hub = force.copy(), moment.copy()
    for position, extra in own:
        total += extra
        about_hub += _moment_of(position, extra)
    return own, total, about_hub


def _on_beam(
    concept: Concept, force: Floats, moment: Floats, own: list[tuple[float, Floats]]
) -> tuple[Beam, tuple[float, ...], int, Floats, Floats, Floats]:
    """The beam of a suspension, its bearings, and what acts on it, as of `elastic_reactions`."""
    assert concept.beam is not None
    places = np.array([0.0, *(position for position, _ in own)])
    pushes = np.stack(np.broadcast_arrays(force, *(extra for _, extra in own)))
    return concept.beam, concept.positions, concept.locating, places, pushes, moment


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


def _numbered(concept: Concept, models: Mapping[str, BearingModel]) -> dict[int, BearingModel]:
    for name in models:
        if name not in concept.bearings:
            raise InputError(f"models: no bearing {name!r}; there are {concept.bearings}")
    if models and concept.beam is None:
        raise InputError("models: a rigid shaft does not feel its bearings; give it a beam")
    supports = concept.beam.supports if concept.beam else ()
    for name, support in zip(concept.bearings, supports):
        if support.stiffness != "given" and name not in models:
            raise InputError(
                f"models: bearing {name!r} is missing, its support has "
                f"stiffness = {support.stiffness!r}"
            )
    return {concept.bearings.index(name): model for name, model in models.items()}


def _own_loads(concept: Concept, torque: Floats, down: Floats) -> Iterator[tuple[float, Floats]]:
    """Yield position and force of the weights and of the torque support."""
    for position, mass in concept.masses:
        yield position, (mass * GRAVITY * down)[:, None]
    if concept.torque_support:
        position, arm = concept.torque_support
        support = np.zeros((3, torque.size))
        support[2] = -torque / arm
        yield position, support


def _moment_of(position: float, force: Floats) -> Floats:
    """Moment about the hub centre of a force on the shaft axis."""
    return position * np.stack([np.zeros_like(force[0]), -force[2], force[1]])


def _one_support(concept: Concept, total: Floats, about_hub: Floats) -> tuple[Floats, Floats]:
    moment = about_hub - _moment_of(concept.positions[0], total)
    moment[0] = 0.0
    return total[None].copy(), moment[None]


def _two_supports(concept: Concept, total: Floats, about_hub: Floats) -> tuple[Floats, Floats]:
    """Share the radial load between two supports without moment."""
    first, second = concept.positions
    about_first = about_hub - _moment_of(first, total)
    forces = np.zeros((2, *total.shape))
    forces[1, 1] = about_first[2] / (second - first)
    forces[1, 2] = -about_first[1] / (second - first)
    forces[0, 1:] = total[1:] - forces[1, 1:]
    return forces, np.zeros_like(forces)


def _dataset(
    concept: Concept,
    force: Floats,
    moment: Floats,
    motion: ShaftMotion | None,
    time: ArrayLike | None,
    modelled: bool,
) -> xr.Dataset:
    found = {
        "force": (force, "N", "force of the shaft on the bearing"),
        "moment": (moment, "N m", "moment of the shaft on the bearing"),
    }
    attrs: dict[str, float] = {}
    if motion:
        found |= {
            "displacement": (motion.displacement, "m", "displacement of the shaft at the bearing"),
            "tilt": (motion.tilt, "rad", "rotation of the shaft at the bearing"),
            "curvature": (motion.curvature, "1/m", "curvature of the shaft at the bearing"),
            "bore_tilt": (motion.bore_tilt, "rad", "rotation of the bore of the bearing"),
        }
        attrs = vars(motion.convergence) | {"converged": int(motion.convergence.converged)}
    place = {
        "units": "m",
        "long_name": "position of the bearing along the shaft from the hub centre",
    }
    dataset = xr.Dataset(
        {
            name: (("bearing", "axis", "time"), values, {"units": units, "long_name": meaning})
            for name, (values, units, meaning) in found.items()
        },
        {
            "bearing": list(concept.bearings),
            "axis": ["x", "y", "z"],
            "position": ("bearing", list(concept.positions), place),
        },
        attrs,
    )
    if modelled and motion:
        meaning = "whether shaft and bearings agree"
        flags = np.broadcast_to(motion.converged, (len(concept.bearings), motion.converged.size))
        labels = {"units": "1", "long_name": meaning}
        dataset["converged"] = ("bearing", "time"), flags.copy(), labels
    if time is None:
        return dataset
    return dataset.assign_coords(time=("time", np.asarray(time, dtype=float), {"units": "s"}))
