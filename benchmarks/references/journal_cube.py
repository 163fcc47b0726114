"""A whole load cube through the film in motion: time, memory, and error of E_max.

    python -m benchmarks.references.journal_cube RUN [--workers 2] [--cases 66] [--check 12]

RUN is the folder of a finished run (``loadflow run pipelines/dlc_1_1.toml``), whose stages loads
and shaft are read. Every step of every case is followed with the rung "reduced", nothing is
reduced or skipped. For `check` cases the 400 steps up to and behind the largest eccentricity are
followed again with the rung "grid", and the largest eccentricities compared.
"""

from __future__ import annotations

import json
import resource
import time as clock
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.common import arguments
from loadflow.cube import open_cube
from loadflow.scene.journal import Journal
from loadflow.scene.scene import read_scene
from loadflow.stages.frames import to_film

BEFORE, BEHIND = 350, 50  # steps of a window around the largest eccentricity


def series(run: Path, case: str, bearing: str) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Time, radial force and speed of one bearing."""
    with open_cube(run / "loads" / f"{case}.h5") as loads:
        time, speed = (loads[name].values.astype(float) for name in ("time", "speed"))
    with open_cube(run / "shaft" / f"{case}.h5") as shaft:
        force = shaft["force"].sel(bearing=bearing).transpose("time", "axis").values
    return time, to_film(force.astype(float)), speed


def follow(run: Path, options: Journal, bearing: str, case: str) -> dict[str, Any]:
    """Orbit of one case: its steps, seconds, largest eccentricity and when."""
    begin = clock.process_time()
    time, force, speed = series(run, case, bearing)
    orbit = _orbit(options, "reduced", time, force, speed)
    ratio = orbit["eccentricity_ratio"].values
    return {
        "case": case,
        "steps": time.size,
        "seconds": clock.process_time() - begin,
        "peak": int(ratio.argmax()),
        "e_max": float(ratio.max()),
        "residual": float(orbit["residual"].max()),
        "memory": resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20,
    }


def check(run: Path, options: Journal, bearing: str, found: dict[str, Any]) -> dict[str, float]:
    """E_max of the window around the peak, with both rungs; seconds of a step of the grid."""
    part = slice(max(0, found["peak"] - BEFORE), found["peak"] + BEHIND)
    time, force, speed = (values[part] for values in series(run, found["case"], bearing))
    few = _orbit(options, "reduced", time, force, speed)["eccentricity_ratio"].max()
    begin = clock.process_time()
    grid = _orbit(options, "grid", time, force, speed)["eccentricity_ratio"].max()
    seconds = (clock.process_time() - begin) / time.size
    return {"error": abs(float(few / grid) - 1), "grid_seconds_per_step": seconds}


def _orbit(options: Journal, rung: str, *history: np.ndarray) -> Any:
    return options.geometry.orbit(*history, replace(options.film_model, rung=rung))


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("run", type=Path)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--cases", type=int, default=66)
    parser.add_argument("--check", type=int, default=12)
    parser.add_argument("--bearing", default="N")
    chosen = parser.parse_args()
    run, options = chosen.run, read_scene(chosen.run / "scene.toml").journal
    cases = sorted(path.stem for path in (run / "shaft").glob("*.h5"))[: chosen.cases]
    for rung in ("reduced", "grid"):  # compiled before, in the process that workers come from
        _orbit(options, rung, *(part[:3] for part in series(run, cases[0], chosen.bearing)))
    begin = clock.perf_counter()
    with ProcessPoolExecutor(chosen.workers) as pool:
        work = partial(follow, run, options, chosen.bearing)
        found = list(pool.map(work, cases, chunksize=1))
        wall = clock.perf_counter() - begin
        some = found[:: max(1, len(found) // chosen.check)] if chosen.check else []
        checked = list(pool.map(partial(check, run, options, chosen.bearing), some))
    steps = sum(one["steps"] for one in found)
    seconds = sum(one["seconds"] for one in found)
    result = {
        "bearing": chosen.bearing,
        "cases": len(found),
        "steps": steps,
        "wall_seconds": wall,
        "processor_seconds": seconds,
        "microseconds_per_step": 1e6 * seconds / steps,
        "memory_of_a_worker_GiB": max(one["memory"] for one in found),
        "largest_eccentricity_ratio": max(one["e_max"] for one in found),
        "largest_residual": max(one["residual"] for one in found),
    }
    if checked:
        result |= {
            "cases_checked": len(checked),
            "largest_error_of_E_max": max(one["error"] for one in checked),
            "grid_seconds_for_all": steps
            * float(np.mean([one["grid_seconds_per_step"] for one in checked])),
        }
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    main()
