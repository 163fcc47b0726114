"""What a campaign of many load cases takes: time by phase and stage, memory of the parent, files.

<<<<<<< HEAD
python -m benchmarks.robustness.scale [--cases 300 1000 3000] [--workers 2] [--results RESULT …]
=======
python -m benchmarks.robustness.scale [--cases 300 1000] [--workers 2] [--results NAME …]
>>>>>>> contract

Series of made-up loads of 600 s at 20 Hz would measure the stages; what grows with the number of
cases is measured with short ones (`--steps`), so that what surrounds a case is not hidden by it.
Each size runs in a process of its own; what is printed is a row of docs/scale.md.
"""

from __future__ import annotations

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from threading import Event, Thread

import numpy as np

from benchmarks.common import ROOT, arguments

SPEEDS = np.arange(4.0, 25.0)


def campaign(folder: Path, cases: int, steps: int) -> Path:
    """Write a cube of so many short cases, and return its file."""
    import xarray as xr

    from loadflow.cube import case_name, save_cube

    rng = np.random.default_rng(1)
    time_ = 0.25 * np.arange(steps)
    phase = rng.uniform(0, 2 * np.pi, (cases, 1))
    wave = np.sin(0.4 * time_ + phase) + 0.3 * np.sin(2.1 * time_ + 2 * phase)
    wind = SPEEDS[np.arange(cases) % SPEEDS.size]
    seed = np.arange(cases) // SPEEDS.size + 1
    mean = {"hub_force": (5e5, 0.0, -1.07e6), "hub_moment": (4e6, 1e6, 4e5)}
    swing = {"hub_force": (5e4, 4e4, 6e4), "hub_moment": (1e5, 8e5, 8e5)}
    data = {
        "speed": (("case", "time"), 1.2 + 0.02 * wave),
        "pitch": (("case", "time"), 0.1 + 0.02 * wave),
        "azimuth": (("case", "time"), np.mod(1.2 * time_ + phase, 2 * np.pi)),
        "wind": (("case", "time"), wind[:, None] + wave),
    }
    for name in mean:
        values = np.array(mean[name])[:, None, None] + np.array(swing[name])[:, None, None] * wave
        data[name] = (("axis", "case", "time"), values)
    from loadflow.cube import VARIABLES

    cube = xr.Dataset(
        {
            name: (dims, values.astype("float32"), VARIABLES[name].attrs)
            for name, (dims, values) in data.items()
        },
        {
            "time": ("time", time_, {"units": "s", "long_name": "time"}),
            "axis": ["x", "y", "z"],
            "case": [case_name("1.1", v, int(s)) for v, s in zip(wind, seed)],
            "dlc": ("case", ["1.1"] * cases),
            "wind_speed": ("case", wind, {"units": "m/s", "long_name": "mean wind speed"}),
            "seed": ("case", seed),
            "weight": ("case", np.full(cases, 1 / cases)),
        },
        {"turbine": "nrel-5mw"},
    )
    return save_cube(cube, folder / "loads.h5")


def resident() -> float:
    """Memory of this process, MB."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGESIZE") / 1e6


def measure(cases: int, steps: int, workers: int, results: list[str], page: bool) -> dict:
    """Run one campaign here; return what it took."""
    from loadflow.running.runner import run
    from loadflow.scene.scene import make_scene

    with tempfile.TemporaryDirectory() as place:
        file = campaign(Path(place), cases, steps)
        scene = make_scene(
            {
                "name": "campaign",
                "accuracy": "given",
                "results": results,
                "loads": {"files": [str(file)], "weights": "given"},
            }
        )
        seen, stop = [resident()], Event()

        def watch() -> None:
            while not stop.wait(0.2):
                seen.append(resident())

        watcher = Thread(target=watch, daemon=True)
        watcher.start()
        begun, spent = time.perf_counter(), time.process_time()
        found = run(scene, out=place, workers=workers, report=page, profile=True)
        wall, cpu = time.perf_counter() - begun, time.process_time() - spent
        stop.set()
        watcher.join()
        profile = json.loads((found.path / "profile.json").read_text())
        files = [p for p in found.path.rglob("*") if p.is_file()]
        begun = time.perf_counter()
        run(scene, out=place, workers=1, report=False)
        again = time.perf_counter() - begun
        return {
            "cases": cases,
            "wall_seconds": wall,
            "parent_cpu_seconds": cpu,
            "resumed_seconds": again,
            "parent_MB_before": seen[0],
            "parent_MB_most": max(seen),
            "worker_MB_most": resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1e3,
            "files": len(files),
            "MB_on_disk": sum(p.stat().st_size for p in files) / 1e6,
            "failures": len(found.failures),
            "phases": {k: v["wall_seconds"] for k, v in profile["phases"].items()},
            "stages": profile["stages_of_load_cases"],
        }


def main() -> None:
    """Measure each size in a process of its own."""
    parser = arguments(__doc__)
    parser.add_argument("--cases", type=int, nargs="+", default=[300, 1000, 3000])
    parser.add_argument("--steps", type=int, default=120)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--results", nargs="+", default=["reduction.histogram"])
    parser.add_argument("--page", action="store_true")
    parser.add_argument("--here", action="store_true", help=argparse.SUPPRESS)
    chosen = parser.parse_args()
    if chosen.here:
        [cases] = chosen.cases
        options = (chosen.steps, chosen.workers, chosen.results, chosen.page)
        print(json.dumps(measure(cases, *options)))
        return
    for cases in chosen.cases:
        command = [sys.executable, "-m", "benchmarks.robustness.scale", "--here"]
        command += ["--cases", str(cases)]
        command += ["--steps", str(chosen.steps), "--workers", str(chosen.workers)]
        command += ["--results", *chosen.results, *(["--page"] if chosen.page else [])]
        done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
        print(done.stdout.splitlines()[-1] if done.returncode == 0 else done.stderr[-2000:])
        sys.stdout.flush()


if __name__ == "__main__":
    main()
