"""Whole runs of the main job, from the coarsest models to all that there is: time against error.

The scene is that of README's command, ``pipelines/dlc_1_1.toml``, at some of its wind speeds, with
one of its six seeds and series of full length. The answers are held against those of the last run.
"""

from __future__ import annotations

import copy
import json
import tempfile
import time
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from benchmarks.ladder.physics_sizes import REFERENCE
from loadflow.running.runner import run
from loadflow.scene.scene import Scene, with_name

DEFAULT = "accuracy = 0.05 (default)"
CHARTS_AT_ALL = "charts"
SPEEDS = [6, 12, 18, 24]
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
        CHARTS_AT_ALL: made("given", **coarse),
        "film at rest, cold, aligned": made("given", film=COLD | {"grid": [40, 12]}),
        "accuracy = 0.2": made(0.2),
        "accuracy = 0.1": made(0.1),
        DEFAULT: made(),
        "accuracy = 0.02": made(0.02),
        "everything on: accuracy = 0.005": made(0.005),
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
    for name in (CHARTS_AT_ALL, DEFAULT):  # compiles
        scene = scenes[name]
        brief = {"wind_speeds": SPEEDS[:1], "seeds": 1, "duration": 60.0}
        short = scene.model_copy(update={"loads": scene.loads.model_copy(update=brief)})
        with tempfile.TemporaryDirectory() as folder:
            run(with_name(short, "warm"), out=Path(folder), report=False)
    for name, scene in scenes.items():
        with tempfile.TemporaryDirectory() as folder:
            begun = time.process_time()
            done = run(scene, out=Path(folder), report=False, profile=True)
            seconds = time.process_time() - begun
            told = json.loads((Path(folder) / "whole" / "profile.json").read_text(encoding="utf-8"))
            stages = told["stages_of_load_cases"].values()
            of_cases = sum(stage["processor_seconds"] for stage in stages)
            found = {"run": name, "seconds": seconds, "of_cases": of_cases}
            print(found, answers(done.tree), flush=True)
            yield found | {"answers": answers(done.tree)}
