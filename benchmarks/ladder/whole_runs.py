"""Whole runs of the main job, from the coarsest models to all that there is: time against error.

The scene is that of README's command, ``pipelines/dlc_1_1.toml``, at some of its wind speeds, with
one of its six seeds and series of full length. The answers are held against those of `BEST`.
"""

from __future__ import annotations

import copy
import json
import tempfile
import time
import tomllib
from pathlib import Path
from typing import Any

from benchmarks.ladder.physics_sizes import REFERENCE, Found
from loadflow.running.runner import run
from loadflow.scene.changed import with_name
from loadflow.scene.scene import Scene

DEFAULT = "accuracy = 0.05 (default)"
BEST = "everything on: accuracy = 0.005"
SPEEDS = [4, 8, 12, 16, 20, 24]
ALL_SPEEDS = 11
"""Wind speeds of the main job, each with six seeds."""

GRID = [11, 144]
"""Of the wind, as the plan of the main job takes it: on another grid a seed is another wind."""

COLD = {"motion": "quasi-static", "heat": None, "tilt": False}
CHARTS = COLD | {
    "rung": "chart",
    "edge_pressure": 0.0,
    "cavitation": {"kind": "reynolds", "cavitation_pressure": 0.0},
}
RIGID = {"rings": "rigid", "roller_model": "whole"}


def whole_runs() -> dict[str, Scene]:
    """The main job by ever better models, in the same winds."""
    main = tomllib.loads(REFERENCE.read_text(encoding="utf-8"))

    def made(
        accuracy: Any = 0.05,
        film: dict[str, Any] | None = None,
        rolling: dict[str, Any] | None = None,
        **loads: Any,
    ) -> Scene:
        scene = copy.deepcopy(main) | {"name": "whole", "accuracy": accuracy}
        scene["loads"] |= {"wind_speeds": SPEEDS, "seeds": 1, "wind_grid": GRID} | loads
        bearings = scene["bearings"]
        for journal in (bearings["N"], bearings["N2"][0]):
            journal |= film or {}
        bearings["M"] |= rolling or {}
        if accuracy == "given":
            bearings["N2"][1]["rung"] = "curve"  # what plans take; the default is the collar's grid
        return Scene.model_validate(scene)

    coarse = {"film": CHARTS, "rolling": RIGID, "rung": "tables"}
    return {
        "charts": made("given", **coarse),
        BEST: made(0.005),
        DEFAULT: made(),
        "accuracy = 0.2": made(0.2),
    }


def answers(tree: Any) -> dict[str, float]:
    """What users read of a run: the fatigue load, the hardest film, the largest force, the life."""
    film, rolling = tree["journal"], tree["rolling"]
    fatigue = tree["statistics"]["force"].sel(bearing="N", axis="z", statistic="del")
    return {
        "DEL of N": float(fatigue.mean()),
        "collar film": float(tree["thrust"]["smallest_film"].min()),
        "minimum film": float(film["smallest_film"].min()),
        "eccentricity ratio": float(film["largest_eccentricity_ratio"].max()),
        "friction power": float(film["mean_friction_power"].mean()),
        "maximum force": float(rolling["largest_ball_force"].max()),
        "life": float(1 / (1 / rolling["life"]).mean()),
    }


def runs(known: Found) -> Found:
    """Processor time and answers of every whole run that is not known, its kernels compiled."""
    done = {one["run"] for one in known}
    for name, scene in whole_runs().items():
        if name in done:
            continue
        brief = {"wind_speeds": SPEEDS[-1:], "seeds": 1, "duration": 60.0}
        short = scene.model_copy(update={"loads": scene.loads.model_copy(update=brief)})
        _run(with_name(short, "compiles"))
        seconds, of_cases, found = _run(scene)
        print(name, f"{seconds:.1f} s, {of_cases:.1f} s of load cases", found, flush=True)
        yield {"run": name, "seconds": seconds, "of_cases": of_cases, "answers": found}


def _run(scene: Scene) -> tuple[float, float, dict[str, float]]:
    """Processor time of a run, s, that of its load cases alone, and what it answers."""
    with tempfile.TemporaryDirectory() as folder:
        begun = time.process_time()
        done = run(scene, out=Path(folder), report=False, profile=True)
        seconds = time.process_time() - begun
        told = json.loads((done.path / "profile.json").read_text(encoding="utf-8"))
        stages = told["stages_of_load_cases"].values()
        return seconds, sum(one["processor_seconds"] for one in stages), answers(done.tree)
