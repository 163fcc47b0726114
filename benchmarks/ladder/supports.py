"""The shaft iterated with its bearings: what it costs, how far it is off, and what it changes.

python -m benchmarks.ladder.supports [--speed 12]

One case of DLC 1.1, 600 s. The table for docs/shaft.md: largest loads of a suspension whose bearing
takes a moment, by a rigid shaft, on rigid bearings, on the best fixed numbers (the bearing's own
stiffness at its mean load) and iterated. `measure_supports` is the part of the ladder.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import arguments, seconds_of, timed
from benchmarks.ladder.measuring import (
    Bench,
    Entry,
    Errors,
    Rungs,
    Setting,
    label,
    rounded,
    rung_key,
    sentence,
)
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene, make_scene
from loadflow.shaft import bearing_loads as suspended
from loadflow.stages import rolling_support as rolling_seat
from loadflow.stages import shaft
from loadflow.stages.films import support as film_seat

SECTION = {"outer_diameter": 2.0, "inner_diameter": 1.6}
"""A shaft that the bearings of the scene fit around, m; assumed."""

ARMS = {"radial": 1e8}
"""Elastomers of the torque arms, N/m; assumed."""

OWN = {
    "journal": {"stiffness": "journal"},
    "journal, tilting": {"stiffness": "journal", "takes_moment": True},
    "rolling": {"stiffness": "rolling", "takes_moment": True},
}
EXACT = 300
"""Samples solved to tell the error of the others."""


IN_MOTION = {"motion": "transient", "rung": "reduced"}

FINER = 2
"""Times the cells around of the films that tell the error of a shaft in films in motion."""


def scene_of(
    bench: Bench,
    supports: list[dict[str, Any]],
    concept: str = "two_point",
    rings: str = "rigid",
    **film: Any,
) -> Scene:
    """The scene of the benchmark, a beam on `supports`; its ball bearing stands where it may."""
    whole = bench.scene.model_dump()
    names = {"two_point": ("N", "N2"), "three_point": ("N", "G")}[concept]
    shared = {"tilt": True} | film
    others = {name: one | shared for name, one in whole["journal"]["own"].items()}
    place = next((n for n, s in zip(names, supports) if s.get("stiffness") == "rolling"), names[0])
    return make_scene(
        {
            "name": "supports",
            "results": ["loads.statistics"],
            "shaft": {concept: {"beam": {"sections": [SECTION], "supports": supports}}},
            "journal": whole["journal"] | shared | {"bearings": list(names), "own": others},
            "rolling": {"bearing": place, "rings": rings, "geometry": whole["rolling"]["geometry"]},
        }
    )


def models(scene: Scene, name: str, speed: np.ndarray, thrust: np.ndarray) -> Any:
    """The bearing's own model."""
    support = scene.shaft.coupled[name]
    if support.stiffness == "journal":
        return film_seat.film_model(scene.journal, speed, tilting=support.takes_moment)
    part = scene.rolling.bearings[name]
    return rolling_seat.rolling_model(part, thrust, tilting=support.takes_moment)


def solved(scene: Scene, loads: xr.Dataset, found: xr.Dataset, some: np.ndarray) -> xr.Dataset:
    """Some samples with the bearings' own models; `found` gives their thrust."""
    speed = loads["speed"].values.astype(float)[some]
    own = {
        name: models(
            scene,
            name,
            speed,
            found["force"].sel(bearing=name, axis="x").values[some].astype(float),
        )
        for name in scene.shaft.coupled
    }
    hub = (loads[n].values.astype(float)[:, some] for n in ("hub_force", "hub_moment"))
    return suspended(scene.shaft.concepts[0], *hub, tilt=tilt_of(scene), models=own, tolerance=1e-8)


def tilt_of(scene: Scene) -> float:
    from loadflow.turbines import load_turbine

    return load_turbine(scene.turbine.name).rotor.tilt


def measure_supports(bench: Bench) -> Rungs:
    """Entries of the ladder, by the kinds of bearing that the shaft is iterated with."""
    case = bench.middle
    parts = {"loads": bench.series[case]["loads"]}
    pairs = [
        [OWN["journal"], OWN["journal"]],
        [{}, OWN["journal, tilting"]],
        [{}, OWN["rolling"]],
        [OWN["journal"], OWN["rolling"]],
    ]
    rungs: Rungs = {}
    for supports in pairs:
        scene = scene_of(bench, supports)
        seconds = seconds_of(lambda s=scene: shaft.bearing_loads(s, case, parts), 1)  # type: ignore[misc]
        rungs[rung_key(scene, "shaft")] = _entry(scene, case, parts, seconds)
    scene = scene_of(bench, [OWN["journal, tilting"]] * 2, **IN_MOTION)
    rungs[rung_key(scene, "shaft")] = _in_motion(bench, case, parts)
    return rungs


def _in_motion(bench: Bench, case: Case, parts: dict[str, xr.Dataset]) -> Entry:
    """The shaft in films in motion: its own time, as the films are those of the run."""
    own = [OWN["journal, tilting"]] * 2
    around, across = bench.scene.journal.grid
    finer = scene_of(bench, own, **IN_MOTION, grid=(FINER * around, across))
    scene = scene_of(bench, own, **IN_MOTION)
    truth = shaft.bearing_loads(finer, case, parts)
    (found, films), (_, alone) = (
        timed(lambda: shaft.bearing_loads(scene, case, parts)) for _ in range(2)
    )
    steps, errors = found.sizes["time"], Errors()
    for quantity, name in (("bearing load", "force"), ("tilt", "tilt")):
        ours, theirs = found[name].values, truth[name].values
        worst = int(np.argmax(abs(ours - theirs).max(axis=(0, 1))))
        where = f"{label(case)}, t = {found['time'].values[worst]:.0f} s"
        errors.add(quantity, where, ours[..., worst], theirs[..., worst], abs(theirs).max())
    films = rounded((films - alone) * 24_000 / steps)
    return {
        "includes": ["shaft as a Timoshenko beam, in motion with the films that it lies in"],
        "seconds_per_case": rounded(alone * 24_000 / steps),
        "reference": f"{FINER} times the cells around in both films",
        "cases": f"DLC 1.1, {label(case)}; both films took {films} s, as those of the run",
        "errors": {},  # of a rung each, not of rungs that compete
        "error": f"{sentence(errors.summary(), 'bearing load', 'tilt')} of the largest",
    }


def _entry(scene: Scene, case: Case, parts: dict[str, xr.Dataset], seconds: float) -> Entry:
    found = shaft.bearing_loads(scene, case, parts)
    steps = found.sizes["time"]
    some = np.sort(np.random.default_rng(0).choice(steps, EXACT, replace=False))
    truth = solved(scene, parts["loads"], found, some)
    errors = Errors()
    for quantity, name in (("bearing load", "force"), ("tilt", "tilt")):
        ours, theirs = found[name].values[..., some], truth[name].values
        worst = int(np.argmax(abs(ours - theirs).max(axis=(0, 1))))
        where = f"{label(case)}, t = {found['time'].values[some[worst]]:.0f} s"
        errors.add(quantity, where, ours[..., worst], theirs[..., worst], abs(theirs).max())
    summary = errors.summary()
    with_film = any(support.stiffness == "journal" for support in scene.shaft.coupled.values())
    film = {"film": rung_key(scene, "journal")} if with_film else {}
    return {
        **film,
        "includes": ["shaft as a Timoshenko beam, iterated with the bearings' own stiffness"],
        "seconds_per_case": rounded(seconds * 24_000 / steps),
        "reference": f"{EXACT} samples solved with the bearings' own models",
        "cases": f"DLC 1.1, {label(case)}; {found.attrs['solved']} samples solved",
        "errors": {},  # of a rung each, not of rungs that compete
        "error": f"{sentence(summary, 'bearing load', 'tilt')} of the largest",
    }


def compare(bench: Bench, case: Case, loads: xr.Dataset) -> Iterator[str]:
    """Rows of the table."""
    yield "| suspension | shaft and bearings | N, kN | second, kN | moment, kN m |"
    yield "|---|---|---:|---:|---:|"
    suspensions: dict[str, tuple[str, list[dict[str, Any]]]] = {
        "two points, ball bearing N2": ("two_point", [{}, OWN["rolling"]]),
        "two points, film N2": ("two_point", [{}, OWN["journal, tilting"]]),
        "two points, films N and N2, no moment": ("two_point", [OWN["journal"], OWN["journal"]]),
        "three points, ball bearing N": ("three_point", [OWN["rolling"], ARMS]),
        "three points, film N": ("three_point", [OWN["journal, tilting"], {}]),
    }
    for name, (concept, supports) in suspensions.items():
        scene = scene_of(bench, supports, concept)
        found = shaft.bearing_loads(scene, case, {"loads": loads})
        plain = [{k: v for k, v in s.items() if k != "stiffness"} for s in supports]
        fixed = [s | numbers(scene, loads, found, n) for s, n in zip(plain, scene.shaft.bearings)]
        rows = {
            "rigid shaft, no moment": {concept: {}},
            "beam, rigid bearings": _beam(concept, plain),
            "beam, fixed stiffness": _beam(concept, fixed),
        }
        for model, table in rows.items():
            other = make_scene({"name": "x", "results": ["loads.statistics"], "shaft": table})
            data = shaft.bearing_loads(other, case, {"loads": loads})
            yield f"| {name} | {model} | {_peaks(data)} |"
        yield f"| {name} | beam, iterated | {_peaks(found)} |"


def _beam(concept: str, supports: list[dict[str, Any]]) -> dict[str, Any]:
    return {concept: {"beam": {"sections": [SECTION], "supports": supports}}}


def numbers(scene: Scene, loads: xr.Dataset, found: xr.Dataset, name: str) -> dict[str, float]:
    """Stiffness of a bearing at its mean load, the same in both directions."""
    if name not in scene.shaft.coupled:
        return {}
    one = found.sel(bearing=name).mean("time")
    force, moment = (one[n].values[None].astype(float) for n in ("force", "moment"))
    speed = np.array([float(loads["speed"].mean())])
    soft = np.linalg.inv(models(scene, name, speed, force[:, 0])(force, moment)[1][0])
    found_ = {"radial": 2 / (soft[0, 0] + soft[1, 1])}
    if len(soft) == 4:
        found_["tilt"] = 2 / (soft[2, 2] + soft[3, 3])
    return {key: float(value) for key, value in found_.items()}


def _peaks(data: xr.Dataset) -> str:
    force, moment = (
        np.hypot(*data[n].sel(axis=["y", "z"]).transpose("axis", ...).values)
        for n in ("force", "moment")
    )
    numbers_ = [*force.max(axis=1), moment.max()]
    return " | ".join(f"{value / 1e3:.0f}" for value in numbers_)


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--speed", type=float, default=12.0, help="wind speed, m/s")
    speed = parser.parse_args().speed
    bench = Bench(Setting(wind_speeds=(speed,)))
    case, parts = next(iter(bench.series.items()))
    for text in compare(bench, case, parts["loads"]):
        print(text, flush=True)
    for name, entry in measure_supports(bench).items():
        print(f"{name}: {entry['seconds_per_case']} s; {entry['error']}; {entry['cases']}")


if __name__ == "__main__":
    main()
