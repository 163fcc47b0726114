"""What a blade does to its pitch bearing."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
import xarray as xr
from annotated_types import Ge, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.shaft.yaw import checked_loads, swinging_loads


@dataclass(frozen=True)
class PitchBearing:
    """One bearing P, between hub and blade 1; its axis is that of the pitch.

    Attributes
    ----------
    inboard : float
        Middle plane of the bearing from the root of the blade toward the apex, m; what lies between
        has no weight.

    Examples
    --------
    >>> from loadflow.shaft import PitchBearing, pitch_loads
    >>> loads = pitch_loads(PitchBearing(inboard=0.5), [7e5, 2e5, 0.0], [0.0, 0.0, 5e6])
    >>> loads["moment"].values.ravel().tolist()  # about its axis: that of the drive, left out
    [0.0, 0.0, 5100000.0]
    """

    inboard: Annotated[float, Ge(0), Le(10)] = 0.0

    bearings: ClassVar[tuple[str, ...]] = ("P",)

    def __post_init__(self) -> None:
        if not (math.isfinite(self.inboard) and 0 <= self.inboard <= 10):
            raise InputError(f"inboard = {self.inboard} m: must be within 0 … 10 m")


def pitch_loads(bearing: PitchBearing, root_force: ArrayLike, root_moment: ArrayLike) -> xr.Dataset:
    """Loads of blade 1 on its pitch bearing, from equilibrium.

    Parameters
    ----------
    bearing : PitchBearing
        Where it stands.
    root_force, root_moment : array_like, shape (3, n) or (3,)
        What blade 1 applies to the hub at its root, N and N m, as `loadflow.rotor.simulate` gives
        it and load cubes hold it: x outward along the axis of pitch, y downwind, z against the
        rotation; the axes do not turn with the pitch.

    Returns
    -------
    xarray.Dataset
        `force` and `moment` over (bearing, axis, time), in the same axes. The moment about the axis
        of pitch is that of the drive, and left out.

    Raises
    ------
    InputError
        Loads that do not fit or are not finite.

    Examples
    --------
    >>> from loadflow.shaft import PitchBearing, pitch_loads
    >>> loads = pitch_loads(PitchBearing(), [7e5, 0.0, 1.7e5], [1e4, -3.5e6, 0.0])
    >>> loads["force"].sel(bearing="P").values.ravel().tolist()
    [700000.0, 0.0, 170000.0]
    """
    force, moment = checked_loads(root_force=root_force, root_moment=root_moment)
    arm = np.array([bearing.inboard, 0.0, 0.0])
    turn = moment + np.cross(arm[:, None], force, axis=0)
    turn[0] = 0.0
    return swinging_loads("P", force, turn, position=0.0)
