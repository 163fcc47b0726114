"""The command `run` from outside: signals, what it tells where, and a cluster."""

import itertools
import os
import shutil
import signal
import subprocess
import sys
import time
from contextlib import suppress

import pytest
from small_run import contents, small_scene

from loadflow.cli import progress as shown
from loadflow.errors import InputError, LoadflowError
from loadflow.running.cases import Outcome
from loadflow.running.profile import Profile
from loadflow.running.runner import run
from loadflow.running.telling import Task, TimeLeft

RESULTS = ("reduction.histogram", "loads.statistics")


def command(folder, *more, **keys):
    scene = folder / "scene.toml"
    scene.write_text(small_scene(folder, **keys).to_toml(), encoding="utf-8")
    return [sys.executable, "-m", "loadflow.cli", "run", scene, "--out", folder / "runs", *more]


def wait_until(condition, seconds=120.0):
    end = time.monotonic() + seconds
    while not (found := condition()):
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)
    return found


def still_alive(psutil, processes, seconds):
    """Those that have not ended by then; an orphan that nobody has collected yet has ended."""
    _, left = psutil.wait_procs(processes, timeout=seconds)
    found = []
    for one in left:
        with suppress(psutil.NoSuchProcess):
            found += [] if one.status() == psutil.STATUS_ZOMBIE else [one]
    return found


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signals")
@pytest.mark.parametrize(("name", "code"), [("SIGTERM", 143), ("SIGINT", 130)])
def test_a_signal_ends_a_run_with_one_sentence_and_no_process_left(tmp_path, name, code):
    psutil = pytest.importorskip("psutil")
    # cases that take long: a film on a fine grid
    slow = {"results": ["journal.film"], "journal": {"grid": [360, 120]}}
    process = subprocess.Popen(
        command(tmp_path, "--workers", "2", **slow),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    parent = psutil.Process(process.pid)
    try:
        children = wait_until(lambda: len(c := parent.children(recursive=True)) >= 2 and c)
        began = time.monotonic()
        process.send_signal(getattr(signal, name))
        _, told = process.communicate(timeout=30)
        took = time.monotonic() - began
    finally:
        process.kill()
    assert process.returncode == code
    assert f"stopped by {name}; started again, a run goes on where it was\n" in told
    assert "Traceback" not in told
    assert took < 2.0
    assert still_alive(psutil, children, 2.0) == []


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such signal")
def test_workers_do_not_outlive_a_killed_parent(tmp_path):
    psutil = pytest.importorskip("psutil")
    slow = {"results": ["journal.film"], "journal": {"grid": [360, 120]}}
    process = subprocess.Popen(command(tmp_path, "--workers", "2", **slow), stderr=subprocess.PIPE)
    parent = psutil.Process(process.pid)
    children = wait_until(lambda: len(c := parent.children(recursive=True)) >= 2 and c)
    wait_until(lambda: (tmp_path / "runs/small/loads").exists())
    process.kill()
    process.wait()
    process.stderr.close()
    assert still_alive(psutil, children, 20.0) == []


def test_a_log_gets_lines_the_first_of_them_at_once(tmp_path):
    run(small_scene(tmp_path), out=tmp_path / "runs", report=False)
    process = subprocess.Popen(
        command(tmp_path, "--workers", "1", "--profile", "-v"),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    first = process.stderr.readline()
    assert first.startswith("0:00  reading")
    assert not (tmp_path / "runs/small/report.html").exists()
    out, rest = process.communicate()
    assert process.returncode == 0, rest
    assert "load cases: 2 of 2" in rest
    assert "2 load cases, 2 of them finished" in rest  # of the log file, by -v
    assert "\x1b" not in rest  # no bars in a file
    assert "phase" in out
    assert (tmp_path / "runs/small/profile.json").exists()
    page = (tmp_path / "runs/small/report.html").read_text(encoding="utf-8")
    assert "Where the time went" in page
    assert "start-up, plan" in page


def test_the_profile_adds_up_the_processor_time_of_stages():
    profile = Profile()
    for worked in (1.5, 0.25):
        stage = {"loads": 2.0}, {"loads": 0.5}, {"loads": 0.1}, {"loads": worked}
        profile.add(Outcome(*stage))
    row = profile.table(2)["stages_of_load_cases"]["loads"]
    assert (row["process_seconds"], row["processor_seconds"]) == (4.0, 1.75)


def test_a_profile_says_what_all_processes_did_and_it_adds_up():
    profile = Profile(started=time.perf_counter() - 20.0)
    profile.add_wall("pilot", 2.0)
    profile.add_wall("load cases", 10.0)
    spent = {"loads": 6.0, "journal": 9.0}
    none, tenth = dict.fromkeys(spent, 0.0), dict.fromkeys(spent, 0.1)
    compiling = {"loads": 0.0, "journal": 1.0}
    profile.add(Outcome(spent, compiling, tenth, none, parts={"loads": {"wind": 2.0}}))
    found = profile.table(2)
    took = {name: row["process_seconds"] for name, row in found["where"].items()}
    assert sum(took.values()) == pytest.approx(2 * found["wall_seconds"], abs=0.01)
    assert (took["wind"], took["pilot"], took["processes start and wait"]) == (2.0, 4.0, 5.0)
    assert took["rotor"] == pytest.approx(3.9)
    assert took["films"] == pytest.approx(7.9)
    assert took["compiling kernels"] == pytest.approx(1.0)


def test_a_stage_that_takes_long_tells_every_minute(monkeypatch, capsys):
    clock = itertools.count(0.0, 10.0)  # 10 s later whenever it is asked
    monkeypatch.setattr(shown, "EVERY", 0.0)
    monkeypatch.setattr(shown, "TimeLeft", lambda: TimeLeft(lambda: next(clock)))
    lines = shown._Lines()
    lines.show("load cases", 0, 8)
    lines.show("load cases", 2, 8)
    time.sleep(2.5)
    lines.end()
    told = capsys.readouterr().err.splitlines()
    assert told[0].endswith("load cases: 0 of 8")
    assert 2 <= len(told) <= 4
    assert all("load cases: 2 of 8, about " in line for line in told[1:])


def test_time_left_counts_down_between_jobs_and_goes_by_their_cost():
    """Of unequal jobs, and not beyond what was expected."""
    now = [0.0]
    left = TimeLeft(lambda: now[0])
    left.show("cases", 0, 4)
    assert left.seconds() is None
    now[0] = 60.0
    left.show("cases", 1, 4)
    told = []
    for now[0] in (60.0, 120.0, 300.0):
        told.append(left.seconds())
    assert told == [180.0, 120.0, None]

    now[0] = 0.0
    left = TimeLeft(lambda: now[0])
    left.show(Task("cases", 100.0), 0, 2)
    now[0] = 45.0
    left.show(Task("cases", 10.0), 1, 2)  # a long case of two is done in half of its time
    assert left.seconds() == pytest.approx(5.0)


def test_the_version_is_printed():
    done = subprocess.run(
        [sys.executable, "-m", "loadflow.cli", "--version"],
        capture_output=True,
        text=True,
        check=True,
    )
    import loadflow

    assert done.stdout == f"loadflow {loadflow.__version__}\n"


# --- a Dask cluster --------------------------------------------------------------------------


@pytest.fixture
def cluster():
    distributed = pytest.importorskip("dask.distributed")
    with distributed.LocalCluster(
        n_workers=2,
        threads_per_worker=1,
        processes=True,
        dashboard_address=None,
        silence_logs=50,
    ) as cluster:
        yield cluster


def test_a_cluster_that_loses_a_worker_gives_the_bits_of_one_process(tmp_path, cluster):
    scene = small_scene(tmp_path, results=RESULTS)
    alone = run(scene, out=tmp_path / "alone", report=False)
    killed = []

    def kill_one(stage, done, total):
        if (stage, done) == ("load cases", 0):
            process = next(iter(cluster.workers.values())).pid
            os.kill(process, signal.SIGTERM if os.name == "nt" else signal.SIGKILL)
            killed.append(process)

    address = cluster.scheduler_address
    shared = run(scene, out=tmp_path / "shared", scheduler=address, report=False, progress=kill_one)
    assert killed
    assert shared.failures == {}
    assert contents(shared.path / "result.h5") == contents(alone.path / "result.h5")


@pytest.mark.slow
def test_a_lost_scheduler_is_named_and_the_run_goes_on_without_it(tmp_path, cluster):
    scene = small_scene(tmp_path, results=RESULTS)

    def close(stage, done, total):
        if (stage, done) == ("load cases", 1):
            cluster.close()

    address = cluster.scheduler_address
    with pytest.raises(LoadflowError, match=f"lost the Dask scheduler {address}; started again"):
        run(scene, out=tmp_path / "runs", scheduler=address, report=False, progress=close)
    first = {path: path.stat().st_mtime_ns for path in (tmp_path / "runs/small").glob("*/*.h5")}
    again = run(scene, out=tmp_path / "runs", report=False)
    alone = run(scene, out=tmp_path / "alone", report=False)
    assert contents(again.path / "result.h5") == contents(alone.path / "result.h5")
    assert first
    assert all(path.stat().st_mtime_ns == stamp for path, stamp in first.items())


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:9", "nonsense", "tcp://"])
def test_an_address_where_no_scheduler_answers_is_bad_input(tmp_path, address):
    pytest.importorskip("dask.distributed")
    with pytest.raises(InputError, match="no Dask scheduler answers"):
        run(small_scene(tmp_path), out=tmp_path / "runs", scheduler=address)
    shutil.rmtree(tmp_path / "runs")
