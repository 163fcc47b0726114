"""Wind speeds and seeds → a load cube of simulated cases, without a run."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from loadflow.cube import Cube, make_cube
from loadflow.scene.cases import list_cases, simulated_case, weighted, wind_class
from loadflow.scene.scene import make_scene
from loadflow.stages.loads import hub_loads

log = logging.getLogger("loadflow.run")


def simulate_cube(
    turbine: str,
    wind_speeds: Sequence[float] | None,
    seeds: Sequence[int] | None,
    settings: Mapping[str, Any],
    progress: Callable[[str, int, int], None] = lambda stage, done, total: None,
) -> Cube:
    """Simulate every wind speed of a design load case with every seed.

    Parameters
    ----------
    turbine : str
        Name or file of the turbine.
    wind_speeds : sequence of float, optional
        Means at the hub, m/s; by default those of the load case.
    seeds : sequence of int, optional
        Of the turbulence, or numbers of the variants of a gust; by default all that the load case
        asks for.
    settings : mapping
        What else the section ``loads`` of a scene takes, such as `duration` and `rung`.
    progress : callable
        Called with stage, cases done and their number.

    Returns
    -------
    xarray.Dataset or xarray.DataTree
        Load cube; the cases share the lifetime as their wind speeds do (Rayleigh, (2.2)).

    Raises
    ------
    loadflow.errors.InputError
        A setting out of its range.
    """
    loads = {"source": "simulate", **settings}
    if wind_speeds:
        loads["wind_speeds"] = list(wind_speeds)
    data = {"results": ["loads.statistics"], "turbine": {"name": turbine}, "loads": loads}
    scene = make_scene(data, source="simulation")
    cases = list_cases(scene)
    if seeds:
        wanted = dict.fromkeys((c.dlc, c.wind_speed, seed) for c in cases for seed in seeds)
        chosen = [simulated_case(scene, *what) for what in wanted]
        cases = weighted(chosen, wind_class(scene))
    done = []
    for case in cases:
        started = time.perf_counter()
        done.append(hub_loads(scene, case, {}))
        log.info("%s: %.1f s", case.name, time.perf_counter() - started)
        progress("loads", len(done), len(cases))
    return make_cube(done)
