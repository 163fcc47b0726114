"""One case of a load cube → the loads of its bearings, by a suspension if it has hub loads only."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases, make_cube
from loadflow.errors import InputError
from loadflow.numerics.fields import none_such
from loadflow.shaft import TwoPoint, bearing_loads
from loadflow.stages.frames import to_film

log = logging.getLogger("loadflow.run")

Floats = np.ndarray


@dataclass(frozen=True)
class BearingSeries:
    """One bearing in one case, as plain arrays.

    Attributes
    ----------
    case, bearing : str
        Which.
    labels : dict
        `dlc`, `wind_speed` (m/s), `seed` and `weight` of the case.
    time, speed : ndarray, shape (n,)
        s and rad/s.
    force, moment : ndarray, shape (n, 3)
        N and N m in the frame of the cube.
    """

    case: str
    bearing: str
    labels: dict[str, Any]
    time: Floats
    speed: Floats
    force: Floats
    moment: Floats

    @cached_property  # asked for by each statistic of a lifetime
    def radial(self) -> Floats:
        """Radial force in the frame of the film, shape (n, 2), N."""
        return to_film(self.force)

    @property
    def source(self) -> str:
        """What it is, in words."""
        return f"{self.case}, bearing {self.bearing}"


def iter_bearings(
    cube: Cube, bearings: Sequence[str] = (), turbine: str = "nrel-5mw", source: str = "load cube"
) -> Iterator[BearingSeries]:
    """Yield every wanted bearing of every case.

    Parameters
    ----------
    cube : Cube
        With `speed`, and `force` of bearings or else `hub_force` and `hub_moment`.
    bearings : sequence of str
        Which bearings; default: all.
    turbine : str
        Name or file of the turbine; its tilt is taken for the suspension.
    source : str
        Name of the cube, for messages.

    Raises
    ------
    loadflow.errors.InputError
        No such loads or bearing in the cube, or no case.
    """
    empty = True
    for name, case in iter_cases(cube):
        empty = False
        try:
            loads = with_bearings(case.load(), turbine)
            chosen = _chosen(loads, bearings)
        except InputError as error:
            raise InputError(f"{source}: {name}: {error}") from error
        labels = {
            key: case[key].item()
            for key in ("dlc", "wind_speed", "seed", "weight")
            if key in case.coords
        }
        for bearing in chosen:
            log.info("%s, bearing %s: %d samples", name, bearing, loads.sizes["time"])
            force, moment = (
                loads[load].sel(bearing=bearing).transpose("time", "axis").values.astype(float)
                for load in ("force", "moment")
            )
            speed = loads["speed"].values.astype(float)
            time = loads["time"].values
            yield BearingSeries(name, str(bearing), labels, time, speed, force, moment)
    if empty:
        raise InputError(f"{source}: the load cube is empty, it holds no case")


def bearing_cube(cube: Cube, turbine: str = "nrel-5mw", source: str = "load cube") -> Cube:
    """Return the cube with the loads of the bearings in place of those of the hub.

    Raises
    ------
    loadflow.errors.InputError
        As `iter_bearings`.
    """
    cases = []
    for name, case in iter_cases(cube):
        try:
            loads = with_bearings(case.load(), turbine)
        except InputError as error:
            raise InputError(f"{source}: {name}: {error}") from error
        labels = {k: v for k, v in case.coords.items() if v.ndim == 0}
        cases.append(loads.assign_coords(labels))
    return make_cube(cases)


def suspension(cube: Cube, turbine: str = "nrel-5mw") -> str:
    """Say in words where the bearing forces of a cube come from."""
    first = next((case for _, case in iter_cases(cube)), None)
    if first is None or "force" in first:
        return "of the cube"
    concept = TwoPoint()
    return (
        f"the cube has hub loads only; taken: two points, N at {concept.hub_to_first:g} m and N2 "
        f"{concept.span:g} m behind, gearbox {concept.gearbox_mass:g} kg, shaft tilted "
        f"{np.degrees(_tilt(turbine)):g}° ({turbine})"
    )


def with_bearings(case: xr.Dataset, turbine: str = "nrel-5mw") -> xr.Dataset:
    """Return `speed`, `force` and `moment` (bearing, axis, time) of the bearings of a case.

    Raises
    ------
    loadflow.errors.InputError
        The case has neither bearing nor hub loads, or no speed.
    """
    if "speed" not in case:
        raise InputError("no rotor speed; the variable 'speed' is needed")
    if "force" in case:
        moment = case.get("moment", xr.zeros_like(case["force"]))
        return case[["speed", "force"]].assign(moment=moment)
    if "hub_force" not in case or "hub_moment" not in case:
        raise InputError("neither 'force' of bearings nor 'hub_force' with 'hub_moment'")
    hub = [case[name].transpose("axis", "time").values for name in ("hub_force", "hub_moment")]
    loads = bearing_loads(TwoPoint(), *hub, tilt=_tilt(turbine), time=case["time"].values)
    return loads.assign(speed=("time", case["speed"].values, case["speed"].attrs))


def _tilt(turbine: str) -> float:
    from loadflow.turbines import load_turbine

    return load_turbine(turbine).rotor.tilt


def _chosen(loads: xr.Dataset, bearings: Sequence[str]) -> list[Any]:
    """Labels of the wanted bearings."""
    there = [str(label) for label in loads["bearing"].values]
    if unknown := [name for name in bearings if name not in there]:
        raise InputError(none_such("bearing", unknown, there))
    return [label for label in loads["bearing"].values if not bearings or str(label) in bearings]
