"""How loads of a main bearing grow with the radius of the rotor: exponents by least squares."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

SIMILAR = ("nrel-5mw", "nrel-5mw@7.5e6", "nrel-5mw@10e6")
"""One turbine at the powers of [Hart et al. 2022]; its suspension is scaled with it."""

DESIGNS = ("windpact-1.5mw", "nrel-5mw", "iea-15mw")
"""Turbines that were each designed for their size, with their own suspensions."""

LOADS = ("mean radial force", "std of radial force", "std of moment")
"""Of the first main bearing, N, and of the rotor across the shaft, N m."""


@cache
def _winds_of(
    name: str, wind_speed: float, seed: int, duration: float
) -> tuple[Array, Array, Array]:
    """Time, hub force and hub moment of a turbine in turbulence; suspensions share them."""
    from loadflow.rotor import simulate

    found = simulate(
        name, wind_speed=wind_speed, seed=seed, duration=duration, dt=0.05, rung="tables"
    )
    return found["time"].values, found["hub_force"].values, found["hub_moment"].values


def loads_of(
    name: str, wind_speed: float, seeds: Sequence[int], duration: float, shaft: str
) -> Array:
    """`LOADS` of a turbine in turbulence of class I, category B; means over the seeds.

    `shaft` is the turbine whose suspension carries its rotor.
    """
    from loadflow.scene.scene import make_scene
    from loadflow.shaft import bearing_loads
    from loadflow.turbines import load_turbine

    concept = make_scene({"name": "growth", "turbine": {"name": shaft}}).shaft.concepts[0]
    tilt, rows = load_turbine(name).rotor.tilt, []
    for seed in seeds:
        time, force, hub_moment = _winds_of(name, wind_speed, seed, duration)
        carried = bearing_loads(concept, force, hub_moment, tilt=tilt, time=time)
        first = carried["force"].isel(bearing=0).transpose("axis", "time").values
        radial, moment = np.hypot(*first[1:]), np.hypot(*hub_moment[1:])
        rows.append((radial.mean(), radial.std(), moment.std()))
    return np.mean(rows, axis=0)


def exponents(
    names: Sequence[str],
    wind_speed: float,
    seeds: Sequence[int],
    duration: float = 200.0,
    shaft: str | None = None,
) -> dict[str, float]:
    """Exponent p of each of `LOADS` over the radius, load ∝ R^p by least squares of logarithms.

    All rotors stand on the suspension of the turbine `shaft`, each on its own by default.
    """
    from loadflow.turbines import load_turbine

    radii = [load_turbine(name).rotor.radius for name in names]
    loads = [loads_of(name, wind_speed, seeds, duration, shaft or name) for name in names]
    found = np.polyfit(np.log(radii), np.log(loads), 1)[0]
    return dict(zip(LOADS, found.tolist()))
