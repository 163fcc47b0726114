"""Wind and rotor, or files → hub loads of one case."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import CASE_COORDS, Cube, case_named, iter_cases, open_cube, time_step
from loadflow.errors import InputError
from loadflow.numerics.watch import part_of_work
from loadflow.scene.cases import CUBES, Case, wind_of
from loadflow.scene.given_winds import RUN_IN, given_field
from loadflow.scene.loads import Loads
from loadflow.scene.scene import Scene
from loadflow.stages.labelling import label
from loadflow.stages.stage import Measured, Rungs, Stage
from loadflow.stages.summary import over_cases
from loadflow.stages.swinging import ROOT
from loadflow.turbines import load_turbine
from loadflow.wind.cases import STANDING

NEEDED = ("speed", "hub_force", "hub_moment")
"""Without which no shaft has loads."""


def hub_loads(scene: Scene, case: Case, inputs: dict[str, Any]) -> xr.Dataset:
    """Simulate or read one case: speed, pitch, hub force and moment over time, in single precision.

    Single precision keeps a relative 6e-8, far below any load model's error, at half the size.
    """
    from loadflow.readers.doubts import with_doubts

    series = _read(scene, case) if case.file else _simulate(scene, case)
    labels = {"dlc": case.dlc, "wind_speed": case.wind_speed, "seed": case.seed}
    series = series.assign_coords(labels | {"weight": case.weight})
    if scene.shaft.pitch is None:  # no bearing has them
        series = series.drop_vars([name for name in ROOT if name in series])
    return with_doubts(series, scene.turbine.name, simulated=not case.file).astype("float32")


def _simulate(scene: Scene, case: Case) -> xr.Dataset:
    from loadflow.rotor import simulate_condition
    from loadflow.rotor.inflow import wind_machine

    loads, wind, winds, field = scene.loads, wind_of(scene, case), scene.loads.wind_options, None
    doubt = ""
    turbine = load_turbine(scene.turbine.name)
    if case.wind:
        plant = wind_machine(turbine)
        with part_of_work("wind"):
            wind, field, doubt = given_field(Path(case.wind), wind, winds, plant, loads.duration)
    series = simulate_condition(
        scene.turbine.name,
        wind,
        winds,
        run_in=RUN_IN,
        field=field,
        dt=loads.step,
        rung=loads.rung,
        options=replace(loads.rotor_options, air_density=scene.environment.air_density),
    )
    told = "\n".join(filter(None, (doubt, swing_doubt(series, turbine.rotor.radius))))
    # a cube has the pitch of blade 1 and the wind along the mean
    series = series.drop_dims("blade").assign(wind=series["wind"].sel(axis="x", drop=True))
    return series.assign_coords(
        tripped=((), series.attrs.pop("tripped"), _TRIPPED),
        doubts=((), told, CASE_COORDS["doubts"].attrs),
    )


def swing_doubt(series: xr.Dataset, radius: float) -> str:
    """Say that blades of a rotor that stands draw a swing from the wind; "" if they do not.

    The tip is that of blade 1.
    """
    from loadflow.rotor.standing import LEAST_SWING, swing_of

    if series.attrs["event"] not in STANDING:
        return ""
    swing, least = swing_of(series["tip_deflection"], time_step(series)), LEAST_SWING * radius
    if swing < least:
        return ""
    return (
        f"the blades of the rotor that stands swing by themselves, at {swing:.2g} m of a tip "
        f"(effective value in some 10 s; from {least:.2g} m on): an oblique storm drives their "
        "edge modes, and the loads tell of that more than of the storm"
    )


def _read(scene: Scene, case: Case) -> xr.Dataset:
    from loadflow.readers import read_loads

    path = Path(case.file)
    if path.suffix in CUBES:
        found = case_named(_opened(path, case.fingerprint), case.entry).load()
        if missing := [name for name in NEEDED if name not in found]:
            have = ", ".join(map(str, found.data_vars))
            raise InputError(
                f"{path}, {case.entry}: no {', '.join(missing)}; a scene needs the loads of the "
                f"hub, this case has {have}"
            )
        return found
    cube = read_loads(path, turbine=scene.turbine.name, quiet=True, **scene.loads.reading)
    return next(series for _, series in iter_cases(cube))


@lru_cache(maxsize=4)
def _opened(path: Path, fingerprint: str) -> Cube:
    """A cube that stays open: each of its load cases is read when its turn comes."""
    return open_cube(path)


def summary(parts: Mapping[Case, xr.Dataset]) -> xr.Dataset | None:
    """Mean power of each case, when it tripped (s, NaN if not), how long it stood, its doubts.

    None where the series were read and have none of it.
    """

    def told(part: xr.Dataset) -> xr.Dataset:
        tripped = part.coords["tripped"].item() if "tripped" in part.coords else np.nan
        found = {"tripped": ((), tripped, _TRIPPED)}
        attrs = {key: CASE_COORDS[key].attrs for key in ("standing_share", "doubts")}
        found |= {k: ((), part[k].item(), a) for k, a in attrs.items()}
        if {"hub_moment", "speed"} <= set(part.data_vars):
            torque = part["hub_moment"].sel(axis="x").values.astype(float)
            power = float(np.mean(torque * part["speed"].values))
            found["rotor_power"] = (), power, label("W", "mean power of the rotor on the shaft")
        return xr.Dataset(found)

    known, each = True, {}
    for case, part in parts.items():  # each is read once
        known = known and "tripped" in part.coords
        each[case] = told(part)
    found = over_cases(each)
    tells = (found["standing_share"] > 0) | (found["doubts"] != "")
    return found if known or "rotor_power" in found or bool(tells.any()) else None


def trips(groups: Mapping[str, Any]) -> dict[str, float]:
    """Return when cases of a run tripped, s; those that did not are left out.

    `groups` is what the run found, by stage.
    """
    if "loads" not in groups:
        return {}
    times = groups["loads"]["tripped"]
    names = times["case"].values
    return {str(name): float(t) for name, t in zip(names, times.values) if np.isfinite(t)}


def doubts(groups: Mapping[str, Any]) -> dict[str, list[str]]:
    """Return what is doubtful about the series, by case; sound cases are left out."""
    if "loads" not in groups:
        return {}
    said = groups["loads"]["doubts"]
    names = said["case"].values
    return {str(name): str(d).split("\n") for name, d in zip(names, said.values) if str(d)}


def warnings(tree: xr.DataTree) -> list[str]:
    """Say which cases stand because they tripped, since when, and what is doubtful."""
    doubtful = [
        f"loads, {name}: {doubt}" for name, said in doubts(tree.children).items() for doubt in said
    ]
    return [*trip_warnings(trips(tree.children)), *doubtful]


def trip_warnings(times: Mapping[str, float]) -> list[str]:
    """Say it of cases that tripped, given by name with the time (s); nothing of none."""
    if not times:
        return []
    told = ", ".join(f"{name} {when_tripped(t)}" for name, t in times.items())
    return [f"loads: tripped on overspeed, and stopped from then on: {told}"]


def when_tripped(time: float) -> str:
    """Time of a trip (s) in words."""
    return f"at {time:.1f} s" if time > 0 else "in the run-in"


_TRIPPED = CASE_COORDS["tripped"].attrs


def finest_rung(scene: Scene) -> str:
    """Return the finest model of the rotor that the scene's turbine allows."""
    from loadflow.rotor.rungs import finest_rung as finest

    return finest(load_turbine(scene.turbine.name))


def _rotor_key(scene: Scene) -> str:
    loads = scene.loads
    return (loads.rung or finest_rung(scene)) if loads.source == "simulate" else "files"


def _finest_rotor(scene: Scene) -> dict[str, Any]:
    finest = finest_rung(scene)
    return {} if _rotor_key(scene) in ("files", finest) else {"rung": finest}


def wind_key(scene: Scene) -> str:
    """Name of the scene's wind in the ladder."""
    if not scene.loads.makes_wind:
        return "files"
    radii, angles = scene.loads.wind_grid
    return f"{scene.loads.spectrum}, {radii}x{angles}"


def _wind_seconds(scene: Scene, measured: Measured) -> float | None:
    """Time of the wind beyond that of the usual grid, with which the rotor is measured."""
    if not scene.loads.makes_wind:
        return 0.0
    usual = scene.model_copy(update={"loads": Loads()})
    ours, theirs = (measured(one, WIND.name) for one in (scene, usual))
    if ours is None or theirs is None:
        return None
    return float(ours["seconds_per_case"] - theirs["seconds_per_case"])


WIND = Rungs("wind", section="loads", key=wind_key, exact=lambda scene: not scene.loads.makes_wind)
ROTOR = Rungs(
    "loads",
    section="loads",
    key=_rotor_key,
    exact=lambda scene: scene.loads.source == "files",
    better=_finest_rotor,
    possible=lambda scene, settings: (
        settings.get("rung") in (None, "tables", "bem", "flap")
        or settings["rung"] == finest_rung(scene)
    ),
)

STAGE = Stage(
    "loads",
    run=hub_loads,
    sections=lambda scene: (
        *("turbine", "loads", "environment"),
        *(("shaft",) if scene.shaft.pitch is not None else ()),
    ),
    models=(WIND, ROTOR),
    summarise=summary,
    warnings=warnings,
    more_seconds=_wind_seconds,
    left_out=lambda scene: (
        {"wind, rotor": "load series are given, nothing is simulated"}
        if scene.loads.source == "files"
        else {}
    ),
)
