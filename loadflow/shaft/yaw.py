"""What rotor and nacelle do to the yaw bearing on top of the tower."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
import xarray as xr
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.shaft.reactions import GRAVITY

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class YawBearing:
    """One bearing Y, level on the tower top; its axis stands upright.

    Attributes
    ----------
    overhang : float
        Rotor apex to the tower's axis along the shaft, m.
    shaft_above : float
        Of the shaft's axis over the bearing, at the tower's axis, m.
    nacelle_mass : float
        All that stands on the bearing but the rotor, kg.
    nacelle_downwind : float
        Of its centre of mass behind the tower's axis, m.

    Examples
    --------
    >>> from loadflow.shaft import YawBearing, yaw_loads
    >>> bearing = YawBearing(overhang=5.0, shaft_above=2.0, nacelle_mass=240e3)
    >>> loads = yaw_loads(bearing, [5e5, 0.0, -1e6], [4e6, 0.0, 0.0])
    >>> loads["force"].values.ravel().round(-3).tolist()  # along its axis, N; then downwind, left
    [-3354000.0, 500000.0, 0.0]
    """

    overhang: Annotated[float, Gt(0)] = 5.01910
    shaft_above: Annotated[float, Ge(0)] = 1.96256
    nacelle_mass: Annotated[float, Ge(0)] = 240e3
    nacelle_downwind: float = 1.9

    bearings: ClassVar[tuple[str, ...]] = ("Y",)

    def __post_init__(self) -> None:
        if not all(map(math.isfinite, vars(self).values())):
            raise InputError("YawBearing: all measures must be finite")
        if self.overhang <= 0 or self.shaft_above < 0 or self.nacelle_mass < 0:
            raise InputError(
                f"overhang = {self.overhang} m must be > 0, shaft_above = {self.shaft_above} m and "
                f"nacelle_mass = {self.nacelle_mass} kg >= 0"
            )


def yaw_loads(
    bearing: YawBearing, hub_force: ArrayLike, hub_moment: ArrayLike, *, tilt: float = 0.0
) -> xr.Dataset:
    """Loads of the nacelle on the yaw bearing, from equilibrium; its inertia is left out.

    Parameters
    ----------
    bearing : YawBearing
        Where it stands, and what stands on it.
    hub_force, hub_moment : array_like, shape (3, n) or (3,)
        As in `bearing_loads`, in the frame of the shaft, N and N m.
    tilt : float
        Of the shaft, rad.

    Returns
    -------
    xarray.Dataset
        `force` and `moment` over (bearing, axis, time). The axes are those of the bearing: x along
        its axis, up; y downwind, z to the left looking downwind. The moment about its own axis is
        that of the yaw drives, and left out.

    Raises
    ------
    InputError
        Loads that do not fit or are not finite.

    Examples
    --------
    >>> from loadflow.shaft import YawBearing, yaw_loads
    >>> loads = yaw_loads(YawBearing(nacelle_mass=0.0), [0.0, 0.0, -1e6], [0.0, 0.0, 0.0])
    >>> round(float(loads["moment"].sel(axis="z").item()) / 1e6, 2)  # forward, MN m
    -5.02
    """
    force, moment = checked_loads(hub_force=hub_force, hub_moment=hub_moment)
    cos, sin = math.cos(tilt), math.sin(tilt)
    level = np.array([[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]])
    push, turn = level @ force, level @ moment
    arm = np.array([-bearing.overhang * cos, 0.0, bearing.shaft_above + bearing.overhang * sin])
    turn = turn + np.cross(arm[:, None], push, axis=0)
    weight = bearing.nacelle_mass * GRAVITY
    push = push - np.array([0.0, 0.0, weight])[:, None]
    turn = turn + np.array([0.0, bearing.nacelle_downwind * weight, 0.0])[:, None]
    # the axis of a bearing is the first of its frame
    own = [2, 0, 1]
    forces, moments = push[own], turn[own]
    moments[0] = 0.0
    return swinging_loads("Y", forces, moments, position=bearing.overhang)


def checked_loads(**loads: ArrayLike) -> list[Floats]:
    """A force and a moment by their names, each (3, n).

    Raises
    ------
    InputError
        Loads that do not fit or are not finite.
    """
    given = [np.asarray(load, float) for load in loads.values()]
    found = [load[:, None] if load.shape == (3,) else load for load in given]
    shapes = {load.shape for load in found}
    if len(shapes) > 1 or found[0].ndim != 2 or found[0].shape[0] != 3:
        told = ", ".join(f"{name} {load.shape}" for name, load in zip(loads, found))
        raise InputError(f"{told}: (3, n) is needed")
    if not all(np.isfinite(load).all() for load in found):
        raise InputError(f"{', '.join(loads)}: must be finite")
    return found


def swinging_loads(name: str, force: Floats, moment: Floats, *, position: float) -> xr.Dataset:
    """Loads (3, n) of a bearing beside the shaft, labelled as those of its own bearings."""

    def labelled(values: Floats, units: str, what: str) -> tuple[tuple[str, ...], Floats, dict]:
        about = {"units": units, "long_name": f"{what} of what it carries on the bearing"}
        return ("bearing", "axis", "time"), values[None], about

    along = "position of the bearing along the shaft from the hub centre"
    return xr.Dataset(
        {"force": labelled(force, "N", "force"), "moment": labelled(moment, "N m", "moment")},
        {
            "bearing": [name],
            "axis": ["x", "y", "z"],
            "position": ("bearing", [position], {"units": "m", "long_name": along}),
        },
    )
