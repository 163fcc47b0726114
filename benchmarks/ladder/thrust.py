"""Ladder of the films of thrust collars: tabulated or not, over grids of their pads."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import count

import numpy as np

from benchmarks.common import seconds_of, timed
from benchmarks.ladder.measuring import (
    Bench,
    Entry,
    Errors,
    Rungs,
    label,
    on_cases,
    rounded,
    sentence,
    with_ratios,
)
from loadflow.journal.thrust.collar_series import CollarSeries
from loadflow.journal.thrust.curves import CollarCurves
from loadflow.running.candidates import candidates_for
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import ConePair, ThrustCollar
from loadflow.stages import thrust
from loadflow.stages.frames import to_rolling

FILM = ("minimum_film", "maximum_pressure", "friction_power")
FORCES = (1e5, 3e5, 6e5, 9e5, 1.2e6)  # N, from little wind to the largest thrust
FINEST = (160, 80)
TABULATED = {
    "curve": "tabulated over gap and speed, interpolated",
    "grid": "each sample on the grid",
}


def measure_thrust(bench: Bench) -> Rungs:
    """The collar of the pipeline at loads and speeds from cut-in to rated."""
    scene, speeds = bench.scene, bench.setting.speeds
    finest = bench.setting.finest if bench.setting.finest < FINEST else FINEST
    reference = films(scene, "grid", finest, speeds)
    rungs: Rungs = {}
    for rung in TABULATED:
        for grid in thrust.GRIDS:
            chosen = at_grid(scene, rung, grid)
            errors = Errors()
            answer = films(scene, rung, grid, speeds)
            for name in FILM:
                for (force, speed), ours, best in zip(
                    points(speeds), answer[name], reference[name], strict=True
                ):
                    where = f"{force / 1e3:g} kN at {speed:g} rad/s"
                    errors.add(name.replace("_", " "), where, ours, best)
            found = errors.summary()
            entry: Entry = {
                # the coarsest grid is what a scene has that names none: one that it names stays
                "settings": {"rung": rung} | ({"grid": grid} if grid != thrust.GRIDS[0] else {}),
                "includes": [TABULATED[rung], f"{grid[0]}x{grid[1]} cells for each pad"],
                **_seconds(chosen, rung, bench.setting.repeat),
                "reference": f"each sample on the grid {finest[0]}x{finest[1]}",
                "cases": (
                    f"{', '.join(f'{force / 1e3:g}' for force in FORCES)} kN at "
                    f"{', '.join(f'{w:g}' for w in speeds)} rad/s; collar of pipelines/dlc_1_1.toml"
                ),
                "errors": found,
                "error": sentence(found, *(name.replace("_", " ") for name in FILM)),
            }
            rungs[thrust.rung_key(chosen)] = entry
    found = with_ratios(rungs, thrust.rung_key(at_grid(scene, "grid", thrust.GRIDS[-1])))
    return found | cones(bench)


def cones(bench: Bench) -> Rungs:
    """The sized pair of cones on its grids, under the largest and a middling load of each case.

    No plan chooses between them: a scene names their grid.
    """
    scene, loads = _of_cones(bench.scene), [*cone_loads(bench)]
    finest = CONES[-1]
    reference = [_cone(scene, finest).solve(*load) for _, *load in loads]
    rungs: Rungs = {}
    for grid in CONES[:-1]:
        one, errors = _cone(scene, grid), Errors()
        answers = [one.solve(*load) for _, *load in loads]
        for name in FILM:
            for (where, *_), ours, best in zip(loads, answers, reference, strict=True):
                errors.add(name.replace("_", " "), where, getattr(ours, name), getattr(best, name))
        seconds = seconds_of(lambda one=one: [one.solve(*load) for _, *load in loads], 1)
        found = errors.summary()
        rungs[thrust.rung_key(_with(scene, one))] = {
            "includes": ["both cones, shaft free to tilt", f"{grid[0]}x{grid[1]} cells a segment"],
            "seconds_per_sample": rounded(seconds / len(loads)),
            "reference": f"the same on the grid {finest[0]}x{finest[1]}",
            "cases": f"{on_cases(bench)}; conical-pair of that turbine, two samples of each case",
            "errors": found,
            "error": sentence(found, *(name.replace("_", " ") for name in FILM)),
        }
    return with_ratios(rungs, [*rungs][-1])


CONES = ((20, 10), (40, 20), (80, 40))


def _of_cones(scene: Scene) -> Scene:
    """The scene with the sized pair of cones alone."""
    found = candidates_for(scene)[0]["conical-pair"]
    return scene.model_copy(update={"thrust": found.thrust})


def _cone(scene: Scene, grid: tuple[int, int]) -> ConePair:
    [one] = scene.thrust.bearings.values()
    assert isinstance(one, ConePair)
    return one.model_copy(update={"grid": grid})


def _with(scene: Scene, one: ConePair) -> Scene:
    section = scene.thrust.model_copy(update={"bearings": {"M": one}})
    return scene.model_copy(update={"thrust": section})


def cone_loads(bench: Bench) -> Iterator[tuple[str, np.ndarray, np.ndarray, float]]:
    """Name, force, moment and speed of the most pressed sample and of the median of each case."""
    one = _cone(_of_cones(bench.scene), CONES[0])
    for case, parts in bench.series.items():
        shaft = parts["shaft"].sel(bearing="M")
        force, moment = (
            to_rolling(shaft[name].transpose("time", "axis").values.astype(float))
            for name in ("force", "moment")
        )
        order = np.argsort(one.normal_load(force, moment))
        for words, k in (("largest load", order[-1]), ("median load", order[order.size // 2])):
            speed = float(parts["loads"]["speed"].values[k])
            yield f"{label(case)}, {words}", force[k], moment[k], speed


def points(speeds: tuple[float, ...]) -> list[tuple[float, float]]:
    return [(force, speed) for force in FORCES for speed in speeds]


def collar_of(scene: Scene) -> ThrustCollar:
    return next(iter(scene.thrust.collars.values()))


def at_grid(scene: Scene, rung: str, grid: tuple[int, int]) -> Scene:
    collars = {name: one.on_cells(grid) for name, one in scene.thrust.collars.items()}
    changed = {"bearings": collars, "rung": rung, "grid": grid}
    return scene.model_copy(update={"thrust": scene.thrust.model_copy(update=changed)})


def films(
    scene: Scene, rung: str, grid: tuple[int, int], speeds: tuple[float, ...], load: float = 1.0
) -> dict[str, np.ndarray]:
    """Values of `FILM` at all points."""
    part = collar_of(at_grid(scene, rung, grid))
    force, speed = load * np.array(points(speeds)).T[0], np.array(points(speeds)).T[1]
    if rung == "curve":
        answer = part.by_curve(np.outer(force, (0.0, 0.0, 1.0)), speed)
        return {name: getattr(answer, name) for name in FILM}
    none = np.zeros(3)
    each = [part.solve(np.array([0.0, 0.0, f]), none, w) for f, w in zip(force, speed)]
    return {name: np.array([getattr(one, name) for one in each]) for name in FILM}


def _seconds(scene: Scene, rung: str, repeat: int) -> dict[str, object]:
    """Seconds of one sample, and those of the tables of a curve, which are made once."""
    part, rng = collar_of(scene), np.random.default_rng(0)
    samples = 2_000 if rung == "curve" else 20
    force = np.zeros((samples, 3))
    force[:, 2], speed = rng.uniform(1e5, 1e6, samples), rng.uniform(0.7, 1.3, samples)
    if rung == "curve":
        part.by_curve(force, speed)
        seconds = seconds_of(lambda: part.by_curve(force, speed), repeat)
        kinds = {kind: rounded(timed(_table(part, kind), warm=False)[1]) for kind in TABLES}
        return {"seconds_per_sample": rounded(seconds / samples), "seconds_once": kinds}
    loads = [*zip(force, speed.tolist(), strict=True)]
    each = seconds_of(lambda: [part.solve(f, np.zeros(3), w) for f, w in loads], repeat)
    return {"seconds_per_sample": rounded(each / samples)}


TABLES = ("curve", "aligned", "tilted")


def _table(part: ThrustCollar, kind: str) -> Callable[[], object]:
    """Make the table of a collar anew, for a first sample."""
    force, speed, tilt = np.array([6e5]), np.array([1.0]), np.array([[1e-6, 0.0]])
    play, film = part.play * (1.0 + 1e-9 * next(_FRESH)), part.film_model
    collar = replace(part.bearing, play=play)
    if kind == "curve":
        curves = CollarCurves(collar, film, 0.5 * part.contact_film)
        return lambda: curves.equilibrium(force, speed)
    series = CollarSeries(collar, film, part.contact_film, kind == "tilted")
    return lambda: series.equilibrium(force, speed, tilt if kind == "tilted" else (0.0, 0.0))


_FRESH = count(1)


def thrust_gains(bench: Bench, step: float) -> dict[str, float]:
    """Largest |d ln(answer)/d ln(load)| of the collar over the points."""
    speeds, grid = bench.setting.speeds, thrust.GRIDS[1]
    more, less = (films(bench.scene, "grid", grid, speeds, r) for r in (step**0.5, step**-0.5))
    return {
        name.replace("_", " "): rounded(
            float(np.max(np.abs(np.log(more[name] / less[name]))) / np.log(step))
        )
        for name in FILM
    }


def cone_gains(bench: Bench, step: float) -> dict[str, float]:
    """The same of the pair of cones, under the loads of its rungs."""
    one, found = _cone(_of_cones(bench.scene), CONES[0]), dict.fromkeys(FILM, 0.0)
    for _, force, moment, speed in cone_loads(bench):
        heavy, light = (one.solve(force * r, moment * r, speed) for r in (step**0.5, step**-0.5))
        for name in FILM:
            change = float(abs(np.log(getattr(heavy, name) / getattr(light, name))))
            found[name] = max(found[name], change / float(np.log(step)))
    return {name.replace("_", " "): rounded(gain) for name, gain in found.items()}
