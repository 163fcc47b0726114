"""Hub loads → what the shaft applies to each bearing."""

from __future__ import annotations

from typing import Any

import xarray as xr

from loadflow.scene import Scene
from loadflow.stages.cases import Case


def bearing_loads(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Return `force` and `moment` (bearing, axis, time) of all suspensions of the scene.

    Where a shaft is a beam, also its `displacement`, `tilt` and `curvature` in each bearing; they
    are NaN in bearings of a rigid shaft beside it.
    """
    from loadflow.shaft import bearing_loads as reactions
    from loadflow.turbines import load_turbine

    series = inputs["loads"].load()
    tilt = load_turbine(scene.turbine.name).rotor.tilt
    force = series["hub_force"].transpose("axis", "time").values.astype(float)
    moment = series["hub_moment"].transpose("axis", "time").values.astype(float)
    parts = [reactions(concept, force, moment, tilt=tilt) for concept in scene.shaft.concepts]
    joined = xr.concat(parts, "bearing", combine_attrs="drop_conflicts")
    return joined.assign_coords(time=series["time"]).astype("float32")
