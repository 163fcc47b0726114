"""Kills a run with SIGKILL around each file that it writes, takes it up again, and compares.

    python kill_points.py FOLDER first step

With a step of 1 the report page is written as well. A process of its own for each run, forked
before HDF5 or numba have done anything. Prints a line of JSON: the points, and those at which the
run that was taken up again differs from one never killed.
"""

import json
import os
import shutil
import signal
import sys
from pathlib import Path

from small_run import contents, small_scene

import loadflow.storage
from loadflow.running.runner import run

WHEN = ("half written", "before the rename", "after the rename")


def in_child(work):
    """Run `work` in a fork of this process; return its exit code, negative if a signal ended it."""
    pid = os.fork()
    if pid == 0:
        try:
            work()
            os._exit(0)
        except BaseException as error:
            print(type(error).__name__, error, file=sys.stderr)
            os._exit(1)
    return os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])


def killed_at(number, when):
    """Make this process end itself at the file of this number."""
    rename, done = os.replace, [0]

    def replace(source, target):
        if done[0] == number:
            if when == "half written":
                os.truncate(source, os.path.getsize(source) // 2)
            if when == "after the rename":
                rename(source, target)
            os.kill(os.getpid(), signal.SIGKILL)
        done[0] += 1
        rename(source, target)

    loadflow.storage.os.replace = replace


def main(folder, first, step):
    scene, page = small_scene(folder), step == 1

    def whole(out):
        return in_child(lambda: run(scene, out=out, report=page))

    def cut(out, number, when):
        def work():
            killed_at(number, when)
            run(scene, out=out, report=page)

        return in_child(work)

    assert whole(folder / "reference") == 0
    wanted = contents(folder / "reference" / "small" / "result.h5")
    points, bad, point = [], [], first
    while True:
        number, when = point // len(WHEN), WHEN[point % len(WHEN)]
        out = folder / f"point{point}"
        if cut(out, number, when) == 0:
            break  # fewer files than that
        points.append(f"file {number}, {when}")
        fine = whole(out) == 0 and contents(out / "small" / "result.h5") == wanted
        left = [p.name for p in (out / "small").rglob(".*tmp")]
        if not fine or left or (out / "small" / "report.html").exists() != page:
            bad.append(points[-1])
        shutil.rmtree(out)
        point += step
    print(json.dumps({"points": points, "bad": bad}))


if __name__ == "__main__":
    main(Path(sys.argv[1]), int(sys.argv[2]), int(sys.argv[3]))
