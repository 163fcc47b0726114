"""Ladder of the wind: the same turbulence on coarser grids, by the loads that it makes."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from benchmarks.common import seconds_of
from benchmarks.ladder.loads import Found, describe, deviations
from benchmarks.ladder.measuring import (
    Bench,
    Entry,
    Rungs,
    label,
    on_cases,
    rounded,
    rung_key,
    sentence,
    with_ratios,
)
from loadflow.rotor import simulate_condition
from loadflow.rotor.inflow import wind_machine
from loadflow.scene.cases import Case, list_cases, wind_of
from loadflow.scene.scene import Scene
from loadflow.stages import shaft
from loadflow.turbines import load_turbine
from loadflow.wind import Field, inflow

FINEST = (21, 144)
GRIDS = ((6, 24), (6, 48), (11, 24), (11, 36), (11, 48), (11, 72), (11, 144), (21, 72), FINEST)
"""Radii, with the hub, and angles: each a part of the finest."""

NEXT, USUAL = (21, 72), (11, 48)
WHOLE = {
    "hub wind": "the wind of the hub all over the rotor",
    "rotor average": "the mean over the rotor, all over it",
}
FACTORS = "factors interpolated over 96 knots"
RUN_IN, MARGIN = 60.0, 10.0
QUANTITIES = ("tilt moment DEL", "yaw moment DEL", "bearing force DEL", "bearing load max")


def measure_wind(bench: Bench) -> Rungs:
    """Errors of the loads of the rotor with flexible blades in coarser fields."""
    setting = bench.setting
    scene = bench.with_loads(
        wind_speeds=list(setting.wind_speeds),
        seeds=setting.seeds,
        duration=setting.duration,
        rung="tower",
    )
    found: dict[str, dict[str, Found]] = {}
    for case in list_cases(scene):
        for rung, field in fields(scene, case):
            found.setdefault(rung, {})[label(case)] = describe(loads_in(scene, case, field))
    top = f"{name(FINEST)}, exact factors"
    case = list_cases(scene)[0]
    doubt = deviations(found[name(NEXT)], found[top]).summary()
    about = {
        "reference": reference(doubt),
        "cases": f"{on_cases(bench)}; {setting.seeds} seeds, {setting.duration:g} s, rotor tower",
    }
    rungs: Rungs = {}
    for rung, values in found.items():
        errors = deviations(values, found[top]).summary()
        rungs[rung] = {
            **_described(rung),
            "seconds_per_case": rounded(_seconds(bench, scene, case, rung)),
            **about,
            "errors": {} if rung == top else errors,
            "error": "top rung" if rung == top else sentence(errors, *QUANTITIES),
        }
    return with_ratios(rungs | _mann(bench, scene, case), top)


def reference(doubt: dict[str, Any]) -> str:
    """What the errors are against, and how far that can be trusted."""
    return (
        f"{name(FINEST)}, exact factors, same turbulence; from {name(NEXT)} on it moves by "
        f"{sentence(doubt, *QUANTITIES)}: an extreme is one gust at one place, and settles "
        "slowly"
    )


def name(grid: tuple[int, int]) -> str:
    """Name of a grid in the ladder."""
    return rung_key(Scene(name="wind"), "wind", wind_grid=grid)


def fields(scene: Scene, case: Case) -> Iterator[tuple[str, Field]]:
    """Yield the turbulence of a case on every grid, made once on the finest one."""
    fine = turbulence(scene, case, FINEST, "fast")
    hub, mean = (everywhere(fine, weights) for weights in (None, fine.radius))
    yield from zip(WHOLE, (hub, mean))
    for grid in GRIDS:
        yield name(grid), thinned(fine, grid)
    exact = turbulence(scene, case, FINEST, "exact")
    yield f"{name(USUAL)}, exact factors", thinned(exact, USUAL)
    yield f"{name(FINEST)}, exact factors", exact


def turbulence(scene: Scene, case: Case, grid: tuple[int, int], method: Any) -> Field:
    """Turbulence of a case with its run-in, on a grid."""
    plant = wind_machine(load_turbine(scene.turbine.name))
    wind = wind_of(scene, case)
    longer = replace(wind, duration=RUN_IN + wind.duration + 2 * MARGIN)
    options = replace(scene.loads.wind_options, radii=grid[0], angles=grid[1])
    return inflow(longer, plant, options, method=method)


def thinned(field: Field, grid: tuple[int, int]) -> Field:
    """The field on some of its points."""
    along = (field.radius.size - 1) // (grid[0] - 1)
    around = field.angle.size // grid[1]
    some = np.s_[:, ::along, ::around]
    parts = {c: np.ascontiguousarray(getattr(field, c)[some]) for c in "uvw"}
    return replace(field, radius=field.radius[::along], angle=field.angle[::around], **parts)


def everywhere(field: Field, weights: np.ndarray | None) -> Field:
    """One wind all over the rotor: that of the hub, or the mean with `weights` of the radii."""
    radius, angle = field.radius[[0, -1]], 2 * np.pi / 3 * np.arange(3)
    parts = {}
    for c in "uvw":
        values = getattr(field, c)
        one = values[:, 0, 0]
        if weights is not None:
            one = np.average(values.mean(axis=2), axis=1, weights=weights).astype(np.float32)
        parts[c] = np.tile(one[:, None, None], (1, 2, 3))
    return replace(field, radius=radius, angle=angle, **parts)


def loads_in(scene: Scene, case: Case, field: Field) -> dict[str, Any]:
    """What the stages loads and shaft give in a field of one's own."""
    hub = simulate_condition(
        scene.turbine.name,
        wind_of(scene, case),
        scene.loads.wind_options,
        dt=scene.loads.step,
        run_in=RUN_IN,
        field=field,
        rung=scene.loads.rung,
    )
    found = {"loads": hub}
    return found | {"shaft": shaft.bearing_loads(scene, case, found)}


def _described(rung: str) -> Entry:
    """What a rung includes, and the settings of a scene that choose it."""
    if rung in WHOLE:
        return {"includes": [WHOLE[rung], "made by hand, not an option"]}
    if rung.endswith("exact factors"):
        return {"includes": ["radii x angles of a polar grid", "factors of every frequency"]}
    grid = next(grid for grid in GRIDS if name(grid) == rung)
    about = {"includes": ["radii x angles of a polar grid", FACTORS]}
    return about | {"settings": {"wind_grid": list(grid)}}


def _seconds(bench: Bench, scene: Scene, case: Case, rung: str) -> float:
    """Seconds of the wind of a case of 600 s, from a shorter one."""
    method = "exact" if rung.endswith("exact factors") else "fast"
    grids = {name(grid): grid for grid in GRIDS} | {"hub wind": (2, 3), "rotor average": USUAL}
    grid = grids[rung.removesuffix(", exact factors")]
    repeat = 1 if method == "exact" else bench.setting.repeat
    return _in_full(bench) * seconds_of(lambda: turbulence(scene, case, grid, method), repeat)


def _in_full(bench: Bench) -> float:
    """Length of the wind of a case of 600 s over that of the setting."""
    lost = RUN_IN + 2 * MARGIN
    return (600.0 + lost) / (bench.setting.duration + lost)


def _mann(bench: Bench, scene: Scene, case: Case) -> Rungs:
    """The other model of turbulence, by its time alone; nothing where its extra is missing."""
    try:
        import mannrs  # noqa: F401
    except ImportError:
        return {}
    loads = scene.loads.model_copy(update={"spectrum": "mann"})
    other = scene.model_copy(update={"loads": loads})
    return {
        f"mann, {USUAL[0]}x{USUAL[1]}": {
            "includes": ["spectral tensor of Mann", "a further seed of a speed"],
            "seconds_per_case": rounded(
                _in_full(bench)
                * seconds_of(lambda: turbulence(other, case, USUAL, "fast"), bench.setting.repeat)
            ),
            "reference": "none: another model of the turbulence, not a coarser one",
            "cases": f"DLC 1.1, {label(case)}",
            "errors": None,
            "error": "not measured: another model of the turbulence",
        }
    }
