"""Temperatures of the rolling bearings of a run, and how they follow its loads."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy as np
import xarray as xr

from loadflow.errors import SolverError
from loadflow.quantities import CELSIUS
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.friction import Friction
from loadflow.scene.scene import Scene
from loadflow.stages.rolling import warm_bearing
from loadflow.studies.candidate.factor import grown
from loadflow.studies.candidate.result import Number
from loadflow.studies.seeds.intervals import Groups, interval

HOTTEST = 500.0
"""Temperature, K, to which viscosities of oils are known."""

_HEAVIER = 1.5  # factor on the loads for the power of them that the warmth follows


@dataclass(frozen=True)
class Warmth:
    """Temperature of a rolling bearing in each load case.

    Attributes
    ----------
    temperature : dict
        K, by load case.
    power : dict
        Of the load, that its rise over the air follows; 0 where the scene states the temperature,
        infinite where it does not shed more heat.
    ambient : float
        Of the air, K.
    """

    temperature: dict[str, float]
    power: dict[str, float]
    ambient: float

    def under(self, case: str, factor: float) -> float:
        """Temperature, K, with a factor on the loads of a case.

        Examples
        --------
        >>> Warmth({"a": 303.0}, {"a": 1.0}, 293.0).under("a", 2.0)
        313.0
        """
        rise, power = self.temperature[case] - self.ambient, self.power[case]
        if math.isinf(power):
            return HOTTEST if factor > 1 else self.temperature[case]
        return min(self.ambient + rise * factor**power, HOTTEST)


def warmth_of(
    scene: Scene, place: str, table: xr.Dataset, samples: Iterable[tuple[str, xr.Dataset]]
) -> Warmth:
    """Temperatures of a bearing as its run has them.

    Parameters
    ----------
    scene : Scene
        What was run.
    place : str
        Of the bearing.
    table : xarray.Dataset
        Rolling bearings of the run, over ``case`` and ``bearing``.
    samples : iterable
        Each load case, and some of its samples, whose heat is balanced again under more load.
    """
    ambient = scene.friction.ambient_temperature
    known, powers = {}, {}
    for case, some in samples:
        known[case] = float(table["bearing_temperature"].sel(case=case, bearing=place))
        powers[case] = rise_power(scene, place, some)
    return Warmth(known, powers, ambient)


def rise_power(scene: Scene, place: str, some: xr.Dataset) -> float:
    """Power of the load that the rise of a bearing over the air follows; 0 where it is stated."""
    if scene.friction.conductance_of(scene.rolling.bearings[place]) is None:
        return 0.0

    def under(factor: float) -> float:
        return warm_bearing(scene, place, grown(some, factor))[1]

    return power_of_rise(under, scene.friction.ambient_temperature)


def power_of_rise(under: Callable[[float], float], ambient: float) -> float:
    """Power of the load that the rise of a balanced temperature over the air follows.

    Parameters
    ----------
    under : callable
        Factor on the loads → temperature, K.
    ambient : float
        K.

    Returns
    -------
    float
        0 of a bearing that stands, infinite of one that does not shed more heat.
    """
    try:
        rise = under(1.0) - ambient
        if not rise > 0:  # it stands
            return 0.0
        more = under(_HEAVIER) - ambient
    except SolverError:  # some samples may lose more than all of them, which their run balanced
        return math.inf
    return math.log(more / rise) / math.log(_HEAVIER)


def warmest(
    options: Friction,
    parts: Mapping[str, FurtherBearing],
    table: xr.Dataset,
    power: xr.DataArray | None,
    share: np.ndarray,
) -> Number:
    """Warmest rolling bearing, °C; where it is stated, with the cooling that its losses need.

    Parameters
    ----------
    options : Friction
        Oil and cooling.
    parts : mapping
        Rolling bearings of the scene, by place.
    table : xarray.Dataset
        Rolling bearings of the run.
    power : xarray.DataArray or None
        Mean friction (case, bearing), W.
    share : ndarray
        Of the lifetime, of each case.
    """
    values = table["bearing_temperature"].transpose("case", "bearing").values - CELSIUS
    k, b = np.unravel_index(int(np.nanargmax(values)), values.shape)
    place, air = str(table["bearing"].values[b]), options.ambient_temperature - CELSIUS
    if options.balances(parts.values()):
        low, high = interval(Groups.of(table), lambda some: float(np.nanmax(values[some])))
        own = options.conductance_of(parts[place])
        note = "as stated"
        if own is not None:
            note = f"its mean friction and {own:.3g} W/K to {air:.0f} °C"
        case = str(table["case"].values[k])
        return Number(float(values[k, b]), "°C", low, high, case=case, place=place, note=note)
    return Number(
        float(values[k, b]),
        "°C",
        note=f"as stated{_needed(options, parts, power, table['case'].values, share)}",
    )


def _needed(
    options: Friction,
    parts: Mapping[str, FurtherBearing],
    power: xr.DataArray | None,
    cases: np.ndarray,
    share: np.ndarray,
) -> str:
    """Cooling with which losses make a bearing as warm as stated, in words."""
    air = options.ambient_temperature
    if power is None:
        return ""
    stated = [options.temperature_of(parts[p]) - air for p in power["bearing"].values.tolist()]
    if min(stated) <= 0:
        return f": no warmer than the air, {air - CELSIUS:.0f} °C"
    often = xr.DataArray(share / share.sum(), {"case": cases}, ["case"])
    rise = xr.DataArray(stated, power["bearing"].coords)
    lost = (power.sel(case=cases) * often).sum("case") / rise
    told = ", ".join(f"{float(each):.3g}" for each in lost.values)
    where = ", ".join(map(str, lost["bearing"].values))
    return (
        f", and not balanced: the losses need a cooling of {told} W/K ({where}) to "
        f"{air - CELSIUS:.0f} °C for it"
    )
