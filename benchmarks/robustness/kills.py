"""Kills a run with SIGKILL anywhere in each of its phases, takes it up again, and compares.

    python -m benchmarks.robustness.kills [count] [--only PHASE] [--folder FOLDER]

A phase is what the run does within some functions: the pilot, the first load case, all that the
load cases need with what is between them, the writing of parts, the stages over all cases, the
collection of the result, the writing of its file, the report page. The calls within it are counted
in a run that is left alone; a run is then killed at one of these calls, `count` times in all,
spread evenly over the phases and the calls of each. Taken up again it must give the bits of the run
that was left alone and its page, and leave no temporary file. Each run is a process of its own. The
kills around the writing of each file are those of ``tests/running/kill_points.py``.
"""

from __future__ import annotations

import argparse
import os
import signal
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from inspect import isgeneratorfunction
from pathlib import Path
from types import FrameType, ModuleType
from typing import Any

import numpy as np

from benchmarks.common import ROOT, arguments, head, row
from loadflow.cube import make_case, make_cube, open_cube, save_cube
from loadflow.running import cases, runner, whole
from loadflow.scene import make_scene

PHASES: dict[str, tuple[tuple[ModuleType, str], ...]] = {
    "pilot": ((runner, "pilot"),),
    "first load case": ((runner, "do_case"),),
    "load cases and between them": ((runner, "_carry_out"),),
    "writing parts": ((cases, "save_part"), (whole, "save_part")),
    "stages over all cases": ((runner, "finish_stages"),),
    "joining the result": ((runner, "collect"),),
    "writing the result": ((runner, "save_cube"),),
    "page": ((runner, "write_report"),),
}
"""Functions that carry a phase out, where they are looked up."""

ONCE = ("first load case",)
"""Phases of which only the first call of the function counts."""


def write_loads(path: Path) -> None:
    """Write two short load cases of the NREL 5 MW with a known course."""
    time, draw = np.arange(60) * 0.25, np.random.default_rng(1)
    means = {"hub_force": [4e5, 2e4, -1.08e6], "hub_moment": [2e6, 1e6, 5e5]}

    def case(wind: float) -> Any:
        course = 1 + 0.1 * np.sin(time) + 0.02 * draw.standard_normal((3, time.size))
        loads = {name: np.array(mean)[:, None] * course for name, mean in means.items()}
        data = {"speed": np.full(time.size, 1.2)} | loads
        return make_case(time, data, dlc="1.2", wind_speed=wind, seed=1)

    save_cube(make_cube([case(8.0), case(12.0)]), path)


def counted(phase: str, limit: int | None) -> list[int]:
    """Count the calls of a phase from now on; at the one of number `limit` this process ends."""
    calls, begun = [0], [0]

    def count(_frame: FrameType, event: str, _arg: object) -> None:
        if event == "call":
            calls[0] += 1
            if calls[0] == limit:
                os.kill(os.getpid(), signal.SIGKILL)

    @contextmanager
    def counting() -> Iterator[None]:
        begun[0] += 1
        if begun[0] == 1 or phase not in ONCE:
            sys.setprofile(count)
        try:
            yield
        finally:
            sys.setprofile(None)

    def wrapped(function: Callable[..., Any]) -> Callable[..., Any]:
        def whole(*args: Any, **options: Any) -> Any:
            with counting():
                return function(*args, **options)

        def piecewise(*args: Any, **options: Any) -> Iterator[Any]:
            with counting():
                yield from function(*args, **options)

        return piecewise if isgeneratorfunction(function) else whole

    for module, name in PHASES[phase]:
        setattr(module, name, wrapped(getattr(module, name)))
    return calls


def one_run(folder: Path, out: Path, phase: str, limit: int | None) -> None:
    """Carry the scene out in this process; print how many calls the phase had."""
    calls = counted(phase, limit) if phase else [0]
    loads = {"files": [str(folder / "loads.h5")]}
    scene = make_scene({"name": "killed", "results": ["journal.film"], "loads": loads})
    runner.run(scene, out=out)
    print(calls[0])


def in_process(folder: Path, out: Path, phase: str = "", limit: int = 0) -> tuple[int, int]:
    """Exit code of a run in a process of its own, and the calls of the phase."""
    command = [sys.executable, "-m", __spec__.name if __spec__ else __name__, "--folder"]
    command += [str(folder), "--out", str(out), "--phase", phase, "--limit", str(limit)]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if done.returncode > 0:
        raise SystemExit(done.stderr)
    return done.returncode, int(done.stdout or 0)


def contents(out: Path) -> dict[str, Any]:
    """All numbers of a result, as bytes."""
    tree = open_cube(out / "killed" / "result.h5")
    return {
        f"{node.path}/{name}": (values.shape, values.tobytes())
        for node in tree.subtree
        for name, variable in node.to_dataset(inherit=False).variables.items()
        for values in [np.asarray(variable.values).astype("U") if variable.dtype.kind == "O"
                       else np.asarray(variable.values)]
    }  # fmt: skip


def survey(
    folder: Path,
    count: int,
    phases: Sequence[str] = tuple(PHASES),
    say: Callable[[str], None] = print,
) -> list[str]:
    """Kill `count` runs; return the points whose run was not taken up to the bit."""
    write_loads(folder / "loads.h5")
    in_process(folder, folder / "whole")
    wanted, bad = contents(folder / "whole"), []
    say(head("phase", "calls", "killed", "to the bit"))
    for number, phase in enumerate(phases):
        _, calls = in_process(folder, folder / f"counted{number}", phase)
        share = count // len(phases) + (number < count % len(phases))
        fine = 0
        for point in range(share):
            limit = max(1, round((point + 0.5) / share * calls))
            out = folder / f"{number}-{point}"
            code, _ = in_process(folder, out, phase, limit)
            killed = code == -signal.SIGKILL
            in_process(folder, out)
            left = [*(out / "killed").rglob(".*tmp")]
            page = (out / "killed" / "report.html").exists()
            if killed and contents(out) == wanted and page and not left:
                fine += 1
            else:
                bad.append(f"{phase}, call {limit} of {calls}")
        say(row(phase, calls, share, fine))
    return bad


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("count", type=int, nargs="?", default=50)
    parser.add_argument("--only", choices=PHASES, help="one phase; default: all")
    parser.add_argument("--folder", type=Path, help="where the runs are left; default: nowhere")
    for inner in ("--out", "--phase", "--limit"):
        parser.add_argument(inner, help=argparse.SUPPRESS)
    asked = parser.parse_args()
    if asked.out is not None:
        one_run(asked.folder, Path(asked.out), asked.phase, int(asked.limit) or None)
        return
    with tempfile.TemporaryDirectory() as place:
        folder = asked.folder or Path(place)
        folder.mkdir(parents=True, exist_ok=True)
        bad = survey(folder, asked.count, [asked.only] if asked.only else [*PHASES])
    print("\n".join(bad))
    sys.exit(bool(bad))


if __name__ == "__main__":
    main()
