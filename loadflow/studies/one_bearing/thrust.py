"""One load on one thrust bearing or pair of cones → film, losses and stiffness, labelled."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr
from pydantic import TypeAdapter, ValidationError

from loadflow.errors import InputError
from loadflow.quantities import GRID_ERROR, table
from loadflow.scene.messages import message
from loadflow.scene.scene import read_scene
from loadflow.scene.thrust import AnyAxial
from loadflow.stages.labelling import quantities
from loadflow.studies.one_bearing.journal import Load


def bearing_of_scene(path: Path, name: str | None, kind: str) -> AnyAxial:
    """A bearing of a `kind` in a scene, the first if no `name` is given.

    Raises
    ------
    loadflow.errors.InputError
        No such scene or bearing.
    """
    there = {p: one for p, one in read_scene(path).thrust.bearings.items() if one.kind == kind}
    name = name or next(iter(there), None)
    if name is None or name not in there:
        known = ", ".join(there) or "none"
        raise InputError(f"{path}: no {kind} bearing {name or ''}; there are {known}")
    return there[name]


def bearing_of_keys(data: Mapping[str, Any]) -> AnyAxial:
    """A bearing of the keys that a scene has for it, ``kind`` among them.

    Raises
    ------
    loadflow.errors.InputError
        A key that is missing or out of range.
    """
    try:
        found: AnyAxial = TypeAdapter(AnyAxial).validate_python(dict(data))
    except ValidationError as error:
        raise InputError(message(error, str(data["kind"]), {})) from error
    return found


def thrust_point(bearing: AnyAxial, force: Load, moment: Load, speed: float) -> xr.Dataset:
    """Return the equilibrium under `force` (3,), N, and `moment` (2,), N m, at `speed` (rad/s).

    The third axis is that of the shaft; a thrust bearing takes the third component alone.

    Raises
    ------
    loadflow.errors.InputError
        Values that are not finite; loads that the bearing does not take.
    loadflow.errors.SolverError
        No film carries the load.
    """
    if bearing.kind == "thrust" and any((*force[:2], *moment)):
        raise InputError("a thrust bearing takes the force along the shaft alone")
    full = np.array([*moment, 0.0])
    answer = bearing.solve(np.asarray(force, float), full, speed)
    kelvin = getattr(answer, "temperature", math.nan)  # cones have no heat
    limit = bearing.limits.pressure_at(kelvin)
    rows = {
        name: (getattr(answer, name), units, meaning)
        for name, (_, units, meaning) in answer.told().items()
    }
    solver = {name: rows.pop(name) for name in ("converged", "residual", "iterations")}
    rows |= {
        "least_film": (bearing.least_film, "m", "smallest film allowed"),
        "film_holds": (bool(answer.minimum_film >= bearing.least_film), "1", "whether it is"),
        "pressure_limit": (limit, "Pa", "largest film pressure that the material carries"),
        "pressure_holds": (bool(answer.maximum_pressure <= limit), "1", "whether it does"),
    }
    bounds = {name + GRID_ERROR: bound for name, bound in vars(answer.grid_error).items()}
    about = table(*bounds)
    solver |= {name: (bound, *about[name]) for name, bound in bounds.items()}
    return quantities(rows | solver, model=f"{bearing.words}; {bearing.measures}")
