"""Wind and rotor, or files → hub loads of one case."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import xarray as xr

from loadflow.cube import iter_cases, open_cube
from loadflow.scene import Scene
from loadflow.stages.cases import CUBES, Case, wind_of, wind_options
from loadflow.stages.given_winds import RUN_IN, given_field


def hub_loads(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Simulate or read one case: speed, pitch, hub force and moment over time, in single precision.

    Single precision keeps a relative 6e-8, far below any load model's error, at half the size.
    """
    series = _read(scene, case) if case.file else _simulate(scene, case)
    labels = {"dlc": case.dlc, "wind_speed": case.wind_speed, "seed": case.seed}
    series = series.assign_coords(labels | {"weight": case.weight})
    return series.astype("float32")


def _simulate(scene: Scene, case: Case) -> xr.Dataset:
    from loadflow.rotor import RotorOptions, simulate_condition
    from loadflow.rotor.inflow import wind_machine
    from loadflow.turbines import load_turbine

    loads, wind, winds, field = scene.loads, wind_of(scene, case), wind_options(scene), None
    if case.wind:
        plant = wind_machine(load_turbine(scene.turbine.name))
        wind, field = given_field(Path(case.wind), wind, winds, plant, loads.duration)
    series = simulate_condition(
        scene.turbine.name,
        wind,
        winds,
        run_in=RUN_IN,
        field=field,
        dt=loads.step,
        rung=loads.rung,
        options=RotorOptions(
            individual_pitch=loads.individual_pitch,
            mass_imbalance=loads.mass_imbalance,
            pitch_imbalance=loads.pitch_imbalance,
        ),
    )
    # a cube has the pitch of blade 1 and the wind along the mean
    return series.drop_dims("blade").assign(wind=series["wind"].sel(axis="x", drop=True))


def _read(scene: Scene, case: Case) -> xr.Dataset:
    from loadflow.readers import read_loads

    path = Path(case.file)
    if path.suffix in CUBES:
        return dict(iter_cases(open_cube(path)))[case.entry].load()
    loads = scene.loads
    cube = read_loads(
        path, turbine=scene.turbine.name, cases=loads.case_list, pattern=loads.pattern
    )
    return next(series for _, series in iter_cases(cube))
