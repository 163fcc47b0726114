"""Wind speeds and seeds → a load cube of simulated cases, without a run."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import xarray as xr

from loadflow.cube import make_cube
from loadflow.scene import make_scene
from loadflow.stages.cases import Case, weighted
from loadflow.stages.loads import hub_loads


def simulate_cube(
    turbine: str,
    wind_speeds: Sequence[float],
    seeds: Sequence[int],
    settings: Mapping[str, Any],
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> xr.Dataset:
    """Simulate every wind speed with every seed.

    Parameters
    ----------
    turbine : str
        Name or file of the turbine.
    wind_speeds : sequence of float
        Means at the hub, m/s.
    seeds : sequence of int
        Of the turbulence.
    settings : mapping
        What else the section ``loads`` of a scene takes, such as `duration` and `rung`.
    progress : callable
        Called with stage, cases done and their number.

    Returns
    -------
    xarray.Dataset
        Load cube; the cases share the lifetime as their wind speeds do (Rayleigh, (2.2)).

    Raises
    ------
    loadflow.errors.InputError
        A setting out of its range.
    """
    loads = {"source": "simulate", "wind_speeds": list(wind_speeds), **settings}
    data = {"results": ["loads.statistics"], "turbine": {"name": turbine}, "loads": loads}
    scene = make_scene(data, source="simulation")
    wanted = dict.fromkeys((speed, seed) for speed in wind_speeds for seed in seeds)
    plain = [Case(scene.loads.dlc, speed, seed) for speed, seed in wanted]
    cases = weighted(plain, scene.loads.wind_class)
    done = []
    for case in cases:
        done.append(hub_loads(scene, case, {}))
        progress("loads", len(done), len(cases))
    cube = make_cube(done)
    assert isinstance(cube, xr.Dataset)  # all cases have one length and step
    return cube
