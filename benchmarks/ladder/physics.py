"""Which physics matters when: docs/physics.md and its figures.

``sizes`` lets the pilot measure every effect on single wind speeds of three turbines, ``elements``
that of rollers in slices, in a bearing that the scenes of ``sizes`` do not have, ``films`` what
their films do not have, ``lateral`` the coherence of v and w over several seeds, ``scenes`` asks
the plan of ten scenes what it keeps, ``runs`` makes small whole runs from the coarsest models
to all that there is and holds their answers against the last. What is measured is kept beside the
page in ``docs/figures/physics.json``, so that each part may be measured alone; without a part the
page is written anew from there: ``python -m benchmarks.ladder.physics [PART …]``.
"""

from __future__ import annotations

import json
import tempfile
import time
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt

from benchmarks.common import ROOT, arguments, head, put, row
from benchmarks.ladder.__main__ import DOC, WHOLE_RUNS
from loadflow.planning.pilot import Effort, pilot
from loadflow.planning.plan import make_plan
from loadflow.quantities import percent
from loadflow.running.runner import run
from loadflow.scene.bearings import standing_ring
from loadflow.scene.candidates import machine
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import Scene, with_name
from loadflow.stages.effects import film as film_effects
from loadflow.stages.effects.rotor import LATERAL
from loadflow.stages.probes import PROBES
from loadflow.turbines import load_turbine

KEPT = ROOT / "docs" / "figures" / "physics.json"
PAGE = ROOT / "docs" / "physics.md"
FIGURE = ROOT / "docs" / "figures" / "physics.svg"
FRONT = ROOT / "docs" / "figures" / "speed-vs-error-runs.svg"
TINY = 1e-3
"""Share below which an effect is not worth a word."""

ROUNDING = 1e-9
"""Share below which nothing has changed but the last digits."""

SPEEDS = (6.0, 12.0, 18.0, 24.0)
TURBINES = ("windpact-1.5mw", "nrel-5mw", "iea-15mw")
READ = {
    "loads": ("bearing force DEL", "bearing load max"),
    "film": ("minimum film", "friction power"),
    "rolling": ("maximum force", "life"),
}
"""Quantities of the page, by what they belong to."""

RESULTS = ["loads.statistics", "journal.film", "rolling.loads", "rolling.life"]
SHORT = {"duration": 60.0, "seeds": 1}
THOROUGH = Effort(1, 60.0)
"""Of the pilot, whose scenes here are too short for one that simulates."""

STEEL = 2.1e11  # Pa
OF_FILMS = (film_effects.CONTACT.name, film_effects.SHELL.name, film_effects.TURBULENCE.name)
REALISED = 6
"""Seeds of a wind speed without and with coherence of v and w."""

DEFAULT = "accuracy = 0.05 (default)"


REFERENCE = ROOT / "pipelines" / "dlc_1_1.toml"
STOP = ROOT / "pipelines" / "dlc_4_2_shutdown.toml"
HOLLOW = 0.9
"""Bore of the shaft over its diameter, as in the main job."""


def scene_of(
    turbine: str,
    film: dict[str, Any] | None = None,
    sized: bool = False,
    **keys: Any,
) -> Scene:
    """Two journal bearings and a ball bearing for the moment; the shaft as a beam as wide as they.

    The journal bearings are those of the main job, their diameter and width in proportion to the
    rotor's, or `sized`: those of the package for this turbine. `film` are keys of them. The ball
    bearing is the sized one; its rings are square, with sides of 2.4 balls.
    """
    known = machine(turbine)
    shaft = {place: dict(keys) for place, keys in known["shaft"].items()}
    two = next(place for place in shaft if place != "moment")
    rolling = known["candidates"]["four-point"]
    ball = rolling["M"]["geometry"]
    side, mean = 2.4 * ball["ball_diameter"], ball["pitch_diameter"] / 2
    around = {
        f"{name}_ring": standing_ring(side, side, mean + sign * side / 2, wall=(0.06, 1.0))
        for name, sign in (("inner", -1), ("outer", 1))
    }
    if sized:
        journal = known["candidates"]["journal-cylindrical"]
        shaft[two]["beam"] = {}
    else:
        main = tomllib.loads(REFERENCE.read_text(encoding="utf-8"))["bearings"]["N"]
        size = load_turbine(turbine).rotor.radius / load_turbine("nrel-5mw").rotor.radius
        lengths = {key: size * main["geometry"][key] for key in ("diameter", "width")}
        own = main | {"geometry": main["geometry"] | lengths}
        journal = dict.fromkeys(("N", "N2"), own)
        outer = lengths["diameter"]
        section = {"outer_diameter": outer, "inner_diameter": HOLLOW * outer}
        shaft[two]["beam"] = {"sections": [section]}
    bearings = {place: journal[place] | (film or {}) for place in ("N", "N2")}
    bearings["M"] = rolling["M"] | around
    made = {"name": "physics", "turbine": {"name": turbine}, "results": RESULTS, "shaft": shaft}
    return Scene.model_validate(made | {"bearings": bearings} | keys)


# --- sizes over wind speed and turbine ------------------------------------------------------------


def everywhere(
    measure: Callable[[str, float], dict[str, Any] | None],
) -> Iterator[dict[str, Any]]:
    """What is measured for each turbine and wind speed, where there is something."""
    for turbine in TURBINES:
        for speed in SPEEDS:
            begun = time.process_time()
            found = measure(turbine, speed)
            print(turbine, speed, f"{time.process_time() - begun:.0f} s", flush=True)
            if found is not None:
                yield {"turbine": turbine, "speed": speed} | found


def sizes() -> Iterator[dict[str, Any]]:
    """Measured size of every effect, by turbine and wind speed."""

    def measure(turbine: str, speed: float) -> dict[str, Any] | None:
        loads = {"wind_speeds": [speed]} | SHORT
        verdict = pilot(scene_of(turbine, loads=loads, accuracy=0.02), effort=THOROUGH)
        return verdict and {"sizes": verdict.sizes, "refused": verdict.refused}

    return everywhere(measure)


def elements() -> Iterator[dict[str, Any]]:
    """Measured size of profile and tilt of rollers in a sized tapered pair, as `sizes`."""

    def measure(turbine: str, speed: float) -> dict[str, Any]:
        bearing = machine(turbine)["candidates"]["tapered-pair"]["M"]
        places = {"bearings": {"M": bearing}, "shaft": {"moment": {}}}
        loads = {"wind_speeds": [speed], "rung": "tables"} | SHORT
        made = {"name": "physics", "turbine": {"name": turbine}, "results": RESULTS[2:]}
        scene = Scene.model_validate(made | places | {"loads": loads, "accuracy": 0.02})
        verdict = pilot(scene, effort=THOROUGH)
        assert verdict is not None
        return {"sizes": {name: verdict.sizes[name] for name in verdict.sizes if "rollers" in name}}

    return everywhere(measure)


def films() -> Iterator[dict[str, Any]]:
    """Measured size of contact, shell and turbulence of films that have them, as `sizes`."""
    stop = tomllib.loads(STOP.read_text(encoding="utf-8"))["bearings"]["N"]

    def measure(turbine: str, speed: float) -> dict[str, Any]:
        wall = 0.1 * scene_of(turbine).journal.geometry.diameter
        shell = {"kind": "local", "compliance": 0.2 * wall / STEEL}
        film = {"contact": stop["contact"], "shell": shell, "turbulence": {}}
        loads = {"wind_speeds": [speed], "rung": "tables"} | SHORT
        results = ["journal.film"]
        scene = scene_of(turbine, film=film, loads=loads, accuracy=0.02, results=results)
        verdict = pilot(scene, effort=THOROUGH)
        assert verdict is not None
        return {"sizes": {one: verdict.sizes[one] for one in OF_FILMS if one in verdict.sizes}}

    return everywhere(measure)


def lateral() -> Iterator[dict[str, Any]]:
    """What is lost without coherence of v and w: of means over `REALISED` seeds of 120 s.

    With it a seed is another wind, so that a pilot, which has one, cannot tell.
    """

    def measure(turbine: str, speed: float) -> dict[str, Any]:
        winds = {"wind_speeds": [speed], "seeds": REALISED, "duration": 120.0}
        known, without = (
            _means(scene_of(turbine, accuracy="given", loads=winds | {"lateral": kind}))
            for kind in ("coherent", "independent")
        )
        sizes: dict[str, float] = {}
        for (bearing, quantity), value in known.items():
            change = abs(without[bearing, quantity] / value - 1.0)
            sizes[quantity] = max(sizes.get(quantity, 0.0), change)
        return {"sizes": {LATERAL.name: sizes}}

    return everywhere(measure)


def _means(scene: Scene) -> dict[tuple[str, str], float]:
    """Loads by bearing and quantity, means over all cases."""
    found = [PROBES["loads"].answers(scene, case, {}) for case in list_cases(scene)]
    return {key: sum(one[key] for one in found) / len(found) for key in found[0]}


def joined(kept: dict[str, Any]) -> list[dict[str, Any]]:
    """Sizes of all effects, of those among them that have a part of their own."""
    measured = []
    for one in kept["sizes"]:
        place = one["turbine"], one["speed"]
        more = {
            name: size
            for part in ("elements", "films", "lateral")
            for other in kept.get(part, [])
            if (other["turbine"], other["speed"]) == place
            for name, size in other["sizes"].items()
        }
        measured.append(one | {"sizes": one["sizes"] | more})
    return measured


# --- ten scenes, and what the plan keeps ----------------------------------------------------------


def ten_scenes() -> dict[str, Scene]:
    """Power production, start, stop, parked; small and large turbine; stiff and soft housing."""
    production = {"wind_speeds": [12.0]} | SHORT
    small, usual, large = TURBINES
    still = {"results": ["loads.statistics", "rolling.loads"]}
    parked = {"dlc": "6.1"} | SHORT
    stop = tomllib.loads(STOP.read_text(encoding="utf-8"))["bearings"]["N"]
    touching = {key: stop[key] for key in ("contact", "shell")}
    events = {"results": ["journal.film"], "film": touching}
    soft = {"kind": "local", "compliance": 1e-11}
    return {
        "power production, 1.5 MW": scene_of(small, loads=production),
        "power production, 5 MW": scene_of(usual, loads=production),
        "power production, 15 MW": scene_of(large, loads=production),
        "20 % asked for, 5 MW": scene_of(usual, loads=production, accuracy=0.2),
        "stiff housing, sized bearings of 1.4 m, 5 MW": scene_of(
            usual, loads=production, sized=True
        ),
        "soft housing (10 µm/MPa), 5 MW": scene_of(usual, loads=production, film={"shell": soft}),
        "start, 5 MW": scene_of(usual, loads={"dlc": "3.1", "wind_speeds": [4.0]}, **events),
        "stop, 5 MW": scene_of(usual, loads={"dlc": "4.1", "wind_speeds": [24.0]}, **events),
        "parked, 5 MW": scene_of(usual, loads=parked, **still),
        "parked, 15 MW": scene_of(large, loads=parked, **still),
    }


def scenes() -> Iterator[dict[str, Any]]:
    """What the plan keeps of each scene after its pilot, and why."""
    for name, scene in ten_scenes().items():
        begun = time.process_time()
        plan = make_plan(scene, [], pilot(scene, effort=THOROUGH))
        print(name, f"{time.process_time() - begun:.0f} s", flush=True)
        yield {
            "scene": name,
            "asked": scene.accuracy,
            "effects": [
                {"name": one.name, "kept": one.kept, "why": one.why, "size": one.size}
                for one in plan.effects
            ],
            "rungs": {step.name: step.rung for step in plan.steps},
            "errors": plan.errors,
            "accurate": plan.accurate,
        }


# --- whole runs -----------------------------------------------------------------------------------


def whole_runs() -> dict[str, Scene]:
    """The same winds by ever better models: on another grid a seed is another wind."""
    loads = {"wind_speeds": [8.0, 18.0], "duration": 60.0, "seeds": 2, "wind_grid": [11, 48]}
    coarse = loads | {"rung": "tables", "seeds": 1}
    cold = {"motion": "quasi-static", "heat": None, "tilt": False}
    charts = cold | {"rung": "chart", "edge_pressure": 0.0}
    charts["cavitation"] = {"kind": "reynolds", "cavitation_pressure": 0.0}

    def made(**keys: Any) -> Scene:
        return scene_of("nrel-5mw", **({"loads": loads} | keys))

    return {
        "charts, one seed": made(accuracy="given", loads=coarse, film=charts),
        "charts": made(accuracy="given", loads=coarse | {"seeds": 2}, film=charts),
        "film at rest, cold, aligned": made(accuracy="given", film=cold | {"grid": [40, 12]}),
        "accuracy = 0.2": made(accuracy=0.2),
        "accuracy = 0.1": made(accuracy=0.1),
        DEFAULT: made(),
        "accuracy = 0.05, one seed": made(loads=loads | {"seeds": 1}),
        "accuracy = 0.02": made(accuracy=0.02),
    }


def answers(tree: Any) -> dict[str, float]:
    """What users read of a run: the hardest film, the friction, the largest force, the life."""
    film, rolling = tree["journal"], tree["rolling"]
    return {
        "minimum film": float(film["smallest_film"].min()),
        "eccentricity ratio": float(film["largest_eccentricity_ratio"].max()),
        "friction power": float(film["mean_friction_power"].mean()),
        "maximum force": float(rolling["largest_ball_force"].max()),
        "life": float(1 / (1 / rolling["life"]).mean()),
    }


def runs() -> Iterator[dict[str, Any]]:
    """Processor time and answers of every whole run, kernels compiled."""
    scenes = whole_runs()
    with tempfile.TemporaryDirectory() as folder:  # compiles
        run(with_name(scenes[DEFAULT], "warm"), out=Path(folder), report=False)
    for name, scene in scenes.items():
        with tempfile.TemporaryDirectory() as folder:
            begun = time.process_time()
            done = run(scene, out=Path(folder), report=False)
            seconds = time.process_time() - begun
            print(name, f"{seconds:.1f} s", flush=True)
            yield {"run": name, "seconds": seconds, "answers": answers(done.tree)}


# --- the page -------------------------------------------------------------------------------------


def largest(found: dict[str, float]) -> str:
    """The quantity that moves most, and by how much."""
    if not found:
        return "-"
    name = max(found, key=lambda one: found[one])
    if found[name] < ROUNDING:
        return "nothing"
    return f"{percent(found[name])} of {name}"


def effects_of(measured: list[dict[str, Any]]) -> list[str]:
    """Names of all effects that were measured anywhere."""
    return list(dict.fromkeys(name for one in measured for name in one["sizes"]))


def size_table(measured: list[dict[str, Any]]) -> str:
    """The figure, and a row for each effect and turbine, a column for each wind speed."""
    picture = "Size of each effect over wind speed; the grey line is 5 %"
    lines = [f"![{picture}](figures/{FIGURE.name})\n"]
    lines += ["The answer that moves most, and by how much:\n"]
    lines += [head("effect", "turbine", *(f"{speed:g} m/s" for speed in SPEEDS))]
    for effect in effects_of(measured):
        for turbine in TURBINES:
            at = {one["speed"]: one for one in measured if one["turbine"] == turbine}
            cells = [
                "refused"
                if effect in at[speed]["refused"]
                else largest(at[speed]["sizes"].get(effect, {}))
                if speed in at
                else "-"
                for speed in SPEEDS
            ]
            lines.append(row(effect, turbine, *cells))
    return "\n".join(lines)


def draw_sizes(measured: list[dict[str, Any]]) -> None:
    """Size over wind speed: a panel for each effect, a line for each turbine and answer."""
    effects = effects_of(measured)
    rows = -(-len(effects) // 3)
    figure, axes = plt.subplots(
        rows, 3, figsize=(12, 3 * rows), squeeze=False, layout="constrained"
    )
    for axis in axes.flat[len(effects) :]:
        axis.remove()
    read = [name for names in READ.values() for name in names]
    for axis, effect in zip(axes.flat, effects):
        for colour, turbine in enumerate(TURBINES):
            ours = [
                (one["speed"], one["sizes"][effect])
                for one in measured
                if one["turbine"] == turbine and effect in one["sizes"]
            ]
            for name, style in zip(read, ("-", "--") * 3):
                points = [(speed, 100 * found[name]) for speed, found in ours if name in found]
                if points:
                    axis.plot(*zip(*points), style, color=f"C{colour}", label=f"{turbine}, {name}")
        axis.axhline(5.0, color="0.6", lw=0.8)
        axis.set(title=effect, xlabel="wind speed, m/s", ylabel="change, %", yscale="symlog")
        axis.legend(fontsize=5)
    with plt.rc_context({"svg.hashsalt": "loadflow"}):
        figure.savefig(FIGURE, metadata={"Date": None})
    plt.close(figure)


def scene_table(found: list[dict[str, Any]]) -> str:
    """A row for each scene: what was kept, what was left out and why, what is expected then."""
    lines = [head("scene", "kept, as it moves", "left out", "largest expected error")]
    for one in found:
        split: dict[bool, list[str]] = {True: [], False: []}
        for effect in one["effects"]:
            size = max((effect["size"] or {}).values(), default=0.0)
            if size > TINY:
                split[effect["kept"]].append(f"{effect['name']}: {largest(effect['size'])}")
            elif not effect["kept"] and effect["why"].startswith(("load ", "orbit ")):
                split[False].append(f"{effect['name']}: the shaft touches the bearing ends")
        errors = {
            f"{result}: {name}": error
            for result, quantities in one["errors"].items()
            for name, error in quantities.items()
            if error is not None
        }
        cells = ["; ".join(split[kept]) or "-" for kept in (True, False)]
        lines.append(row(one["scene"], *cells, largest(errors)))
    return "\n".join(lines)


def errors_of(found: list[dict[str, Any]]) -> list[dict[str, float]]:
    """Errors of the answers of each run against the last."""
    best = found[-1]["answers"]
    return [{name: abs(one["answers"][name] / best[name] - 1) for name in best} for one in found]


def run_table(found: list[dict[str, Any]]) -> str:
    """Time over that of the most accurate run, and errors against it."""
    best = found[-1]
    names = list(best["answers"])
    lines = [
        f"![Largest error of an answer over the time of the whole run](figures/{FRONT.name})\n"
    ]
    lines += [head("run", "relative time", *names, "largest", numbers=True)]
    for one, errors in zip(found, errors_of(found)):
        cells = [percent(error) for error in (*errors.values(), max(errors.values()))]
        lines.append(row(one["run"], f"{one['seconds'] / best['seconds']:.2g}", *cells))
    return "\n".join(lines)


def draw_front(found: list[dict[str, Any]]) -> None:
    """Largest error of an answer over the time, and the front that no run beats in both."""
    times = [one["seconds"] / found[-1]["seconds"] for one in found]
    errors = [100 * max(one.values()) for one in errors_of(found)]
    figure, axis = plt.subplots(figsize=(7.5, 4.5), layout="constrained")
    front: list[tuple[float, float]] = []
    for k, (when, error) in sorted(enumerate(zip(times, errors)), key=lambda one: one[1]):
        if not front or error < front[-1][1]:
            front.append((when, error))
        own = found[k]["run"] == DEFAULT
        axis.plot(when, error, "o", ms=9 if own else 5, color="C3" if own else "C0")
        axis.annotate(found[k]["run"], (when, error), (5, 4), textcoords="offset points", size=7)
    axis.step(*zip(*front), where="post", color="0.6", lw=1, zorder=0)
    axis.set(xscale="log", xlabel="processor time over that of the most accurate run")
    axis.set(ylabel="largest error of an answer, %", ylim=(0, None))
    with plt.rc_context({"svg.hashsalt": "loadflow"}):
        figure.savefig(FRONT, metadata={"Date": None})
    plt.close(figure)


PARTS = {
    "sizes": sizes, "elements": elements, "films": films, "lateral": lateral, "scenes": scenes,
    "runs": runs,
}  # fmt: skip
"""What is measured."""

SIZES = "## Size over wind speed and turbine"
SCENES = """## Scenes, and what the plan keeps of them

Accuracy of 5 % where nothing else is said; DLC 1.1 at 12 m/s, or as named. After each effect that
the pilot measured: what leaving it out changes most. What a scene has no data for, or what moves
nothing by 0.1 %, is not listed. Written by `python -m benchmarks.ladder.physics scenes`."""
RUNS = """## Whole runs

Time against error of whole runs, pilot and check at the end included: the scene of
[physics.md](physics.md) for the NREL 5 MW turbine, 60 s at 8 and 18 m/s, by ever better models.
Processor time over that of the last run, kernels compiled; differences of its answers. All have the
same winds on 11 × 48 points, as a seed on another grid is another wind. Written by `python -m
benchmarks.ladder.physics runs`."""


def kept_so_far() -> dict[str, Any]:
    """What was measured, by part."""
    return json.loads(KEPT.read_text(encoding="utf-8")) if KEPT.exists() else {}


def main() -> None:
    """Measure the parts asked for, and write the page."""
    parser = arguments(__doc__)
    parser.add_argument("parts", nargs="*", choices=[[], *PARTS], help="what to measure anew")
    asked = parser.parse_args().parts
    for part in asked:
        found: list[dict[str, Any]] = []
        for one in PARTS[part]():
            found.append(one)
            KEPT.write_text(json.dumps(kept_so_far() | {part: found}, indent=1), encoding="utf-8")
    kept = kept_so_far()
    kept["sizes"] = joined(kept)
    told = [
        f"{text}\n\n{table(kept[part])}"
        for part, text, table in (("sizes", SIZES, size_table), ("scenes", SCENES, scene_table))
        if part in kept
    ]
    put(PAGE, "<!-- measured -->", "<!-- end of measured -->", "\n\n".join(told))
    if "sizes" in kept:
        draw_sizes(kept["sizes"])
    if "runs" in kept:
        told = [RUNS, run_table(kept["runs"])]
        put(DOC, *WHOLE_RUNS, "\n\n".join(told))
        draw_front(kept["runs"])


if __name__ == "__main__":
    main()
