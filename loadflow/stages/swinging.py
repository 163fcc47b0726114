"""How bearings beside the shaft swing in a load case."""

from __future__ import annotations

from typing import Any

import numpy as np
import xarray as xr

from loadflow.errors import InputError
from loadflow.rolling import Oscillation
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.scene import Scene

Floats = np.ndarray

ROOT = ("root_force", "root_moment")
"""What a series has of blade 1."""


def follows_pitch(scene: Scene) -> bool:
    """Whether a bearing swings as the pitch of each series does."""
    parts = scene.rolling.bearings.values()
    return any(part.oscillation is not None and part.oscillation.of_pitch for part in parts)


def swing_of(part: FurtherBearing, inputs: dict[str, Any]) -> Oscillation | None:
    """How a bearing that swings does so in a case; None where it stands.

    Raises
    ------
    loadflow.errors.InputError
        It follows the pitch, of which the series has none.
    """
    assert part.oscillation is not None
    if not part.oscillation.of_pitch:
        return part.oscillation.during((), ())
    return part.oscillation.during(*_pitch(inputs["loads"]))


def swing_speed(part: FurtherBearing, series: xr.Dataset, every: slice) -> Floats:
    """Size of its speed at every so many samples of a series, rad/s."""
    assert part.oscillation is not None
    time = series["time"].values.astype(float)
    angle = _pitch(series)[1] if part.oscillation.of_pitch else np.zeros_like(time)
    return part.oscillation.speed(time, angle)[every]


def root_loads(series: xr.Dataset) -> list[Floats]:
    """Force and moment of blade 1 at its root, (3, n), N and N m.

    Raises
    ------
    loadflow.errors.InputError
        The series has none.
    """
    missing = [name for name in ROOT if name not in series]
    if missing:
        raise InputError(
            f"shaft.pitch: the series has no {' and no '.join(missing)}; simulated loads have "
            "them, of load files the channels root_force_x … root_moment_z, such as RootFzc1, "
            "RootFxc1, RootFyc1, RootMzc1, RootMxc1 and RootMyc1 of OpenFAST"
        )
    return [series[name].transpose("axis", "time").values.astype(float) for name in ROOT]


def _pitch(series: xr.Dataset) -> tuple[Floats, Floats]:
    if "pitch" not in series:
        raise InputError('oscillation.kind = "pitch": the series has no pitch')
    return series["time"].values.astype(float), series["pitch"].values.astype(float)
