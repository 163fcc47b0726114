"""Ladder of the stages that reduce loads and solve the bearings."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import xarray as xr
from scipy.interpolate import RectBivariateSpline

from benchmarks.common import seconds_of
from benchmarks.ladder.friction import friction_gains
from benchmarks.ladder.measuring import (
    Bench,
    Entry,
    Errors,
    Rungs,
    Setting,
    label,
    on_cases,
    percent,
    radial_loads,
    rounded,
    rung_key,
    sentence,
    with_dominated,
    with_ratios,
)
from benchmarks.ladder.thrust import cone_gains, thrust_gains
from loadflow.planning.asked import ABSOLUTE
from loadflow.scene.cases import Case
from loadflow.scene.friction import Friction
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Rolling, Scene
from loadflow.stages import reduction, rolling
from loadflow.stages.frames import to_film, to_rolling
from loadflow.stages.friction import least_film_parameter, mean_of_loaded
from loadflow.stages.rolling_at_work import friction_options

FILM = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power", "side_flow")
LIFE_EXPONENT = 3.0  # of point contacts, (4.2)
BY_NAME = {
    "map": "gas mixture, mass conserving; table made once for a film; ε ≤ 0.995",
    "table": "film of ISO 7902: no gas, no ambient pressure; interpolated tables",
    "chart": "film of ISO 7902: no gas, no ambient pressure; closed forms",
}  # never chosen by a plan: a scene or script must name them
ALIGNED = "aligned, rigid, isothermal"
AROUND = (60, 120)  # cells of the rung "reduced"
GRIDS = ((30, 10), (60, 20), (120, 40), (240, 80))


def measure_reduction(bench: Bench) -> Rungs:
    table = FilmTable(bench.scene.journal, bench.series)
    top = _full_series(bench, table)
    rungs = {
        rung_key(bench.scene, "reduction", pick=pick, size=size): _reduced(
            bench, table, pick, size, top
        )
        for pick in _PICKED
        for size in bench.setting.sizes
    }
    full = rung_key(bench.scene, "reduction", size=1.0)
    return with_dominated(rungs | {full: top})


def _reduced(bench: Bench, table: FilmTable, pick: str, size: float, top: Entry) -> Entry:
    scene, case = _picking(bench.scene, pick, size, 0), bench.middle
    seconds = seconds_of(
        lambda: reduction.reduced_loads(scene, case, bench.series[case]), bench.setting.repeat
    )
    errors, kept = _reduction_errors(bench, table, pick, size)
    found = errors.summary()
    return {
        "settings": {"pick": pick, "size": size},
        "includes": [_PICKED[pick], f"size {size:g}"],
        "seconds_per_case": rounded(seconds * 600.0 / bench.setting.full_duration),
        "relative_time": rounded(kept),
        "samples_over_wanted": rounded(kept / size),
        "reference": top["reference"],
        "cases": top["cases"],
        "errors": found,
        "error": sentence(found, "largest load", "E_max", "p_max", "E_mean"),
    }


_PICKED = {
    "random": "random members of each class of speed and load",
    "extremes": "the severest and a spread of the others of each class",
    "envelope": "as extremes, but of inner classes that keep one load a random one",
}


def _full_series(bench: Bench, table: FilmTable) -> Entry:
    return {
        "settings": {"pick": "extremes", "size": 1.0},
        "includes": ["every step"],
        "seconds_per_case": 0.0,
        "relative_time": 1.0,
        "reference": f"every step of the series; film of every step from {table.about}",
        "cases": (
            f"{on_cases(bench)}; 1 seed, {bench.setting.full_duration:g} s, bearings N, N2 (film) "
            f"and N, N2, M (largest load), {bench.setting.picks} picks each"
        ),
        "errors": {},
        "error": "top rung",
    }


def _picking(scene: Scene, pick: str, size: float, seed: int) -> Scene:
    chosen = scene.reduction.model_copy(update={"pick": pick, "size": size, "seed": seed})
    return scene.model_copy(update={"reduction": chosen})


def _reduction_errors(
    bench: Bench, table: FilmTable, pick: str, size: float
) -> tuple[Errors, float]:
    errors, kept = Errors(), []
    for case, parts in bench.series.items():
        full = radial_loads(parts["shaft"])
        speed = parts["loads"]["speed"].values.astype(float)
        films = {name: table(full[name], speed) for name in ("N", "N2")}
        for seed in range(bench.setting.picks):
            scene = _picking(bench.scene, pick, size, seed)
            for name, node in reduction.reduced_loads(scene, case, parts).children.items():
                index, weight = node["index"].values, node["weight"].values
                where = f"{label(case)}, {name}, pick {seed}"
                load = np.hypot(full[name][:, 0], full[name][:, 1])
                errors.add("largest load", where, load[index].max(), load.max())
                kept.append(index.size / speed.size)
                life = speed * load**LIFE_EXPONENT
                errors.add("life", where, life.mean(), np.average(life[index], weights=weight))
                if name in films:
                    _compare_films(errors, where, films[name], index, weight)
    return errors, float(np.mean(kept))


def _compare_films(
    errors: Errors,
    where: str,
    film: dict[str, np.ndarray],
    index: np.ndarray,
    weight: np.ndarray,
) -> None:
    ratio, pressure = film["eccentricity_ratio"], film["maximum_pressure"]
    power = film["friction_power"]
    errors.add("E_max", where, ratio[index].max(), ratio.max())
    gap = film["minimum_film"]
    errors.add("h_min", where, gap[index].min(), gap.min())
    errors.add("p_max", where, pressure[index].max(), pressure.max())
    errors.add("E_mean", where, np.average(ratio[index], weights=weight), ratio.mean())
    errors.add("friction power", where, np.average(power[index], weights=weight), power.mean())


class FilmTable:
    """Film over load and speed: a round bearing without grooves feels nothing else.

    Solved once on a lattice, so that the film of every step of every case costs nothing.
    """

    quantities = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power")

    def __init__(self, options: Journal, series: dict[Case, dict[str, xr.Dataset]]) -> None:
        radial = [
            radial_loads(parts["shaft"])[name] for parts in series.values() for name in ("N", "N2")
        ]
        speed = [parts["loads"]["speed"].values for parts in series.values() for _ in ("N", "N2")]
        self.largest = 1.001 * max(float(np.hypot(*force.T).max()) for force in radial)
        low, high = min(s.min() for s in speed), max(s.max() for s in speed)
        root, turning = np.linspace(0.02, 1.0, 50), np.linspace(0.999 * low, 1.001 * high, 24)
        answer = solve(options, self.largest * root[:, None] ** 2, turning)
        self.splines = {
            name: RectBivariateSpline(root, turning, getattr(answer, name))
            for name in self.quantities
        }
        self.about = self._check(options, np.concatenate(radial), np.concatenate(speed))

    def __call__(self, force: np.ndarray, speed: np.ndarray) -> dict[str, np.ndarray]:
        root = np.sqrt(np.hypot(force[:, 0], force[:, 1]) / self.largest)
        return {name: spline.ev(root, speed) for name, spline in self.splines.items()}

    def _check(self, options: Journal, force: np.ndarray, speed: np.ndarray) -> str:
        some = np.random.default_rng(0).choice(speed.size, 100, replace=False)
        force, speed = force[some], speed[some].astype(float)
        direct = solve(options, np.hypot(*force.T), speed)
        worst = max(
            float(np.abs(values / getattr(direct, name) - 1).max())
            for name, values in self(force, speed).items()
        )
        return (
            f"splines through solutions on grid {options.grid[0]}x{options.grid[1]} over load and "
            f"speed (within {percent(worst)} of direct solutions at 100 random steps)"
        )


def solve(options: Journal, load: np.ndarray, speed: np.ndarray | float, **keys: Any) -> Any:
    """Equilibrium of the pipeline's bearing under radial loads (…), N."""
    load = np.asarray(load)
    return options.geometry.equilibrium(
        force=np.stack([load, np.zeros_like(load)], axis=-1),
        speed=speed,
        film=replace(options.film_model, **keys),
    )


def operating_points(options: Journal, setting: Setting) -> tuple[np.ndarray, np.ndarray]:
    """Loads and speeds of the given Sommerfeld numbers at each of the given speeds."""
    numbers, speed = np.meshgrid(setting.sommerfeld, setting.speeds)
    unit = options.geometry.sommerfeld_number(1.0, 1.0, options.lubricant.viscosity)
    return (numbers * speed / unit).ravel(), speed.ravel()


def film_errors(options: Journal, setting: Setting, reference: Any, **keys: Any) -> Errors:
    """Deviations of the film from that of a finer grid at the operating points."""
    load, speed = operating_points(options, setting)
    answer = solve(options, load, speed, **keys)
    errors = Errors()
    for i, omega in enumerate(speed):
        where = f"So = {answer.sommerfeld_number[i]:.3g}, {omega:g} rad/s"
        for name in FILM:
            errors.add(
                name.replace("_", " "), where, getattr(answer, name)[i], getattr(reference, name)[i]
            )
        if answer.stiffness is not None:
            errors.add("stiffness", where, answer.stiffness[i], reference.stiffness[i])
    return errors


def reference_film(options: Journal, setting: Setting, grid: tuple[int, int]) -> Any:
    load, speed = operating_points(options, setting)
    return solve(options, load, speed, grid=grid, grading="graded", rung="grid")


def measure_journal(bench: Bench) -> Rungs:
    options, setting = bench.scene.journal, bench.setting
    finest = setting.finest
    reference = reference_film(options, setting, finest)
    coarser = (finest[0] // 2, finest[1] // 2)
    doubt = film_errors(options, setting, reference, grid=coarser, grading="graded").summary()
    about = (
        f"graded grid {finest[0]}x{finest[1]}; against {coarser[0]}x{coarser[1]} it moves by "
        + (sentence(doubt, *doubt))
    )
    cases = (
        f"So = {', '.join(f'{so:g}' for so in setting.sommerfeld)} at "
        f"{', '.join(f'{w:g}' for w in setting.speeds)} rad/s; bearing, oil and gas content of "
        "pipelines/dlc_1_1.toml"
    )
    chosen: list[Entry] = [{"grid": grid, "rung": "grid"} for grid in GRIDS]
    chosen += [{"grid": grid, "grading": "graded", "rung": "grid"} for grid in GRIDS[1:3]]
    chosen += [{"grid": (n, 20), "rung": "reduced"} for n in AROUND]
    models = {rung_key(bench.scene, "journal", **keys): keys for keys in chosen}
    models |= {rung: {"rung": rung} for rung in BY_NAME}  # charts are no rung of a scene
    rungs: Rungs = {}
    for name, keys in models.items():
        errors = film_errors(options, setting, reference, **keys).summary()
        rungs[name] = {
            **({} if name in BY_NAME else {"settings": keys}),
            "includes": [BY_NAME.get(name, "gas mixture, mass conserving"), ALIGNED],
            "seconds_per_sample": rounded(_film_seconds(bench, keys)),
            "reference": about,
            "cases": cases,
            "errors": errors,
            "error": sentence(
                errors, "eccentricity ratio", "minimum film", "maximum pressure", "friction power"
            ),
        }
    return with_ratios(rungs, rung_key(bench.scene, "journal", grid=GRIDS[-1], rung="grid"))


def _film_seconds(bench: Bench, keys: dict[str, Any]) -> float:
    """Seconds of one sample, on the first ones of a reduced series, in their order."""
    parts = bench.series[bench.middle]
    reduced = reduction.reduced_loads(bench.scene, bench.middle, parts)["N"].to_dataset()
    cells = int(np.prod(keys.get("grid", (1, 1))))
    count = min(200, max(10, 200 * 4800 // cells))
    load = np.linalg.norm(to_film(reduced["force"].values), axis=-1)[:count]
    speed = reduced["speed"].values[:count]
    options = bench.scene.journal
    return seconds_of(lambda: solve(options, load, speed, **keys), bench.setting.repeat) / count


ROLLING = Rolling()
CONTACTS = ("maximum_force", "maximum_pressure", "equivalent_load")


def measure_rolling(bench: Bench) -> Rungs:
    """Rigid rings against flexible ones; these against all their modes, at few samples."""
    flexible = Rolling(rings="flexible").ring_model
    every_mode = replace(flexible, modes=1000)
    found = {
        "rigid": _ring_errors(bench, "rigid", flexible, 200),
        "flexible": _ring_errors(bench, flexible, every_mode, 4),
    }
    rungs = {
        name: {
            "settings": {"rings": name},
            "includes": [_RINGS[name], "Hertzian contacts, operating contact angles"],
            "seconds_per_sample": rounded(_ring_seconds(bench, name)),
            "reference": "flexible rings of the default scene; these against all ring modes",
            "cases": f"{on_cases(bench)}; 1 seed, the bearing M of the default scene",
            "errors": errors,
            "error": sentence(errors, "maximum force", "life"),
        }
        for name, errors in found.items()
    }
    return with_ratios(rungs, "flexible")


_RINGS = {
    "rigid": "rigid rings",
    "flexible": "both rings as curved beams on walls (sections assumed), fewest modes that do",
}


def _ring_seconds(bench: Bench, rings: Any) -> float:
    options = Rolling(rings=rings)
    scene = bench.scene.model_copy(update={"rolling": options})
    case, parts = bench.middle, bench.series[bench.middle]
    reduced = {"reduction": reduction.reduced_loads(scene, case, parts)}
    samples = reduced["reduction"][options.bearing].sizes["sample"]
    return (
        seconds_of(lambda: rolling.load_distribution(scene, case, reduced), bench.setting.repeat)
        / samples
    )


def _ring_errors(bench: Bench, rings: Any, reference: Any, samples: int) -> dict[str, Any]:
    bearing, name = ROLLING.geometry, ROLLING.bearing
    errors = Errors()
    for case, parts in bench.series.items():
        load = parts["shaft"].sel(bearing=name).transpose("time", "axis", ...)
        some = slice(None, None, max(1, load.sizes["time"] // samples))
        force = to_rolling(load["force"].values[some].astype(float))
        moment = to_rolling(load["moment"].values[some].astype(float))[:, :2]
        ours, best = (bearing.equilibrium(force, moment, rings=r) for r in (rings, reference))
        for i in range(len(force)):
            where = f"{label(case)}, t = {float(load['time'][some][i]):g} s"
            for key in CONTACTS:
                pair = getattr(ours, key)[i], getattr(best, key)[i]
                errors.add(key.replace("_", " "), where, *pair)
            stiff = (_evened(answer.stiffness[i], bearing) for answer in (ours, best))
            errors.add("stiffness", where, *stiff)
            lives = ours.equivalent_load[i], best.equivalent_load[i]
            errors.add("life", where, *(load**LIFE_EXPONENT for load in lives))
        speed = parts["loads"]["speed"].values[some].astype(float)
        lost, least = (_ideal_losses(answer, speed) for answer in (ours, best))
        for quantity, value in lost.items():
            scale = 1.0 if quantity in ABSOLUTE else None
            errors.add(quantity, label(case), value, least[quantity], scale)
    return errors.summary()


def _ideal_losses(answer: Any, speed: np.ndarray) -> dict[str, float]:
    """Mean friction, film and slip of balls in ideal rolling, as a run tells them."""
    lost = answer.friction(speed, friction_options(Friction(), answer.bearing))
    least = least_film_parameter(lost.film_parameter, answer.element_forces)
    return {
        "friction power": float(lost.power.mean()),
        "film parameter": float(np.median(least)),
        "slip": float(mean_of_loaded(lost.sliding, answer.element_forces).mean()),
    }


def _evened(stiffness: np.ndarray, bearing: Any) -> np.ndarray:
    """Stiffness (5, 5) with the tilts as ways at the pitch circle: all in N/m."""
    lever = np.array([1.0, 1.0, 1.0, *[2.0 / bearing.pitch_diameter] * 2])
    return stiffness * np.outer(lever, lever)


def measure_gains(bench: Bench, rooms: set[str]) -> dict[str, dict[str, float]]:
    """Largest |d ln(answer)/d ln(load)| of what users read of each kind of bearing in `rooms`."""
    of = {
        "journal": lambda: _film_gains(bench),
        "thrust": lambda: thrust_gains(bench, STEP),
        "cones": lambda: cone_gains(bench, STEP),
        "rolling": lambda: _contact_gains(bench) | friction_gains(bench, STEP),
    }
    return {room: gains() for room, gains in of.items() if room in rooms}


STEP = 1.02  # ratio of the loads that a gain compares


def _gain(more: np.ndarray, less: np.ndarray) -> float:
    return rounded(float(np.max(np.abs(np.log(more / less))) / np.log(STEP)))


def _film_gains(bench: Bench) -> dict[str, float]:
    options = bench.scene.journal
    load, speed = operating_points(options, bench.setting)
    more, less = (solve(options, load * r, speed) for r in (STEP**0.5, STEP**-0.5))
    return {
        name.replace("_", " "): _gain(getattr(more, name), getattr(less, name)) for name in FILM
    }


def _contact_gains(bench: Bench) -> dict[str, float]:
    """Of the rolling bearing, at the largest load of each case."""
    bearing, name = ROLLING.geometry, ROLLING.bearing
    found: dict[str, list[float]] = {}
    for parts in bench.series.values():
        worst = int(np.argmax(np.hypot(*radial_loads(parts["shaft"])[name].T)))
        load = parts["shaft"].sel(bearing=name).isel(time=worst).transpose("axis", ...)
        force = to_rolling(load["force"].values[None].astype(float))
        moment = to_rolling(load["moment"].values[None].astype(float))[:, :2]
        more, less = (
            bearing.equilibrium(force=force * r, moment=moment * r) for r in (STEP**0.5, STEP**-0.5)
        )
        for key in ("maximum_force", "maximum_pressure", "equivalent_load"):
            gain = _gain(getattr(more, key), getattr(less, key))
            found.setdefault(key.replace("_", " "), []).append(gain)
    largest = {key: max(values) for key, values in found.items()}
    return largest | {"life": rounded(LIFE_EXPONENT * largest["equivalent load"])}
