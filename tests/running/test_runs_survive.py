"""Runs that are killed, damaged or refused: what is finished stays, and nothing wrong is used."""

import errno
import json
import logging
import math
import os
import shutil
import subprocess
import sys
import time
from collections import Counter
from dataclasses import replace
from pathlib import Path

import pytest
import workers
from small_run import contents, small_scene

from benchmarks.robustness import kills
from loadflow.cube.hdf5 import read_whole
from loadflow.errors import FormerVersionWarning, InputError, LoadflowError, NewerVersionError
from loadflow.planning.effects import EffectVerdict
from loadflow.planning.plan import EffectInPlan, make_plan
from loadflow.running.executor import Lost, executor, usable_cores
from loadflow.running.folder import MANIFEST, known_verdict, prepare, read_manifest, refinements
from loadflow.running.lock import locked
from loadflow.running.parts import digest_of, is_sound, save_part
from loadflow.running.runner import run
from loadflow.scene.changed import with_name
from loadflow.scene.scene import Scene
from loadflow.storage import check_name, written_whole

HERE = Path(__file__).parent
PART = Path("small/reduction/dlc1.1_v8_s1.h5")


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """Folder with a cube, and the folder of a finished run beside it."""
    folder = tmp_path_factory.mktemp("finished")
    run(small_scene(folder), out=folder / "runs", report=False)
    return folder


@pytest.fixture
def copied(finished, tmp_path):
    """A copy of the finished run that may be damaged; the scene has the cube of the first."""
    shutil.copytree(finished / "runs", tmp_path / "runs")
    return tmp_path / "runs"


def again(finished, out, **keys):
    """Take the run up, and return whether its result is that of the one never touched."""
    run(small_scene(finished), out=out, report=False, **keys)
    return contents(out / "small/result.h5") == contents(finished / "runs/small/result.h5")


def flipped(path, where):
    content = bytearray(path.read_bytes())
    content[where] ^= 0x10
    path.write_bytes(content)


# --- parts and manifest ----------------------------------------------------------------------


def test_no_flipped_bit_of_a_part_goes_unnoticed(finished, tmp_path):
    part = shutil.copy(finished / "runs" / PART, tmp_path / "part.h5")
    size = part.stat().st_size
    for k in range(200):
        where = (k * 7919) % size
        flipped(part, where)
        assert not is_sound(part), where
        flipped(part, where)
    assert is_sound(part)


@pytest.mark.parametrize("harm", ["64 bits", "cut", "empty", "longer"])
def test_a_damaged_part_is_made_again_and_said(finished, copied, caplog, harm):
    part = copied / PART
    content = part.read_bytes()
    if harm == "64 bits":
        for k in range(64):
            flipped(part, (k * 997) % len(content))
    else:
        part.write_bytes({"cut": content[:-300], "empty": b"", "longer": content + b"x"}[harm])
    untouched = copied / "small/loads/dlc1.1_v8_s1.h5"
    stamp = untouched.stat().st_mtime_ns
    assert again(finished, copied)
    assert is_sound(part)
    assert part.with_name(f"{part.name}.damaged").exists()
    assert "is made again" in caplog.text
    assert part.name in caplog.text
    assert untouched.stat().st_mtime_ns == stamp


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b'{"wanted": ',
        b"[1, 2]",
        b'{"stages": 3}',
        b'{"climbed": {}}',
        b'{"schema": 2, "refined": {}}',
        b"\xff\xfe\x00",
        b"null",
    ],
)
def test_a_damaged_manifest_is_said_and_made_again_from_the_parts(
    finished, copied, caplog, content
):
    manifest = copied / "small/manifest.json"
    manifest.write_bytes(content)
    with pytest.raises(InputError, match=r"manifest\.json: damaged"):
        read_manifest(manifest.parent)
    stamp = (copied / PART).stat().st_mtime_ns
    assert again(finished, copied)
    assert "manifest.json: damaged" in caplog.text
    assert (copied / PART).stat().st_mtime_ns == stamp
    assert read_manifest(manifest.parent)["cases"] == ["dlc1.1_v8_s1", "dlc1.1_v12_s1"]


def test_sizes_that_are_not_finite_are_strict_json_and_come_back_as_they_were(tmp_path):
    scene = small_scene(tmp_path)
    effect = EffectInPlan("heat", False, None, {"life": math.nan, "film": 0.1}, "not asked for")
    errors = {"journal.film": {"minimum film": math.nan, "pressure": None}}
    planned = replace(make_plan(scene), effects=[effect], errors=errors)
    verdict = EffectVerdict({"tilt": {"film": math.inf, "life": -math.inf, "power": math.nan}})
    folder = tmp_path / "small"
    folder.mkdir()
    prepare(folder, scene, planned, [], False, verdict)

    def refused(name):
        raise AssertionError(f"{name} is no JSON")

    json.loads((folder / "manifest.json").read_text(encoding="utf-8"), parse_constant=refused)
    found = read_manifest(folder)
    assert repr(found["effects"]) == repr([vars(effect)])
    assert repr(found["expected_errors"]["journal.film"]) == (
        "{'minimum film': nan, 'pressure': 'not measured'}"
    )
    assert repr(known_verdict(folder, scene)) == repr(verdict)


def test_a_manifest_of_an_older_version_is_read_and_brought_up_to_date(finished, copied):
    path = copied / "small/manifest.json"
    old = json.loads(path.read_text(encoding="utf-8"))
    assert old.pop(MANIFEST.key) == MANIFEST.version
    old.pop("finished")  # no older version told it
    old["climbed"] = [*old.pop("refined"), "reduction"]
    path.write_text(json.dumps(old), encoding="utf-8")
    with pytest.warns(FormerVersionWarning, match=r"manifest\.json: manifest .*climbed is refined"):
        assert read_manifest(path.parent)["refined"] == ["reduction"]
    with pytest.warns(FormerVersionWarning):
        assert refinements(path.parent, small_scene(finished)) == ["reduction"]
    old["climbed"] = []
    path.write_text(json.dumps(old), encoding="utf-8")
    stamp = (copied / PART).stat().st_mtime_ns
    with pytest.warns(FormerVersionWarning):
        assert again(finished, copied)
    assert (copied / PART).stat().st_mtime_ns == stamp
    new = json.loads(path.read_text(encoding="utf-8"))
    assert new[MANIFEST.key] == MANIFEST.version
    assert "climbed" not in new


def test_a_manifest_of_a_newer_version_stops_the_run_and_is_left_as_it_is(finished, copied):
    path = copied / "small/manifest.json"
    newer = json.loads(path.read_text(encoding="utf-8")) | {MANIFEST.key: MANIFEST.version + 1}
    path.write_text(json.dumps(newer), encoding="utf-8")
    content = path.read_bytes()
    with pytest.raises(NewerVersionError, match=r"manifest\.json: schema = 3: .*a newer loadflow"):
        again(finished, copied)
    assert path.read_bytes() == content


def test_only_what_a_run_wrote_is_ever_deleted(finished, copied):
    own = copied / "small/loads/.dlc1.1_v8_s1.h5.99.loadflow-tmp"
    foreign = [
        copied / "small/.editor.tmp",
        copied / "small/.notes.12.loadflow-tmp",
        copied / "small/loads/.dlc1.1_v8_s1.h5.swp.tmp",
        copied / "small/loads/mine.h5",
        copied / "small/other/.dlc1.1_v8_s1.h5.99.loadflow-tmp",
        copied / ".dlc1.1_v8_s1.h5.99.loadflow-tmp",
    ]
    for path in (own, *foreign):
        path.parent.mkdir(exist_ok=True)
        path.write_text("content")
    other = small_scene(finished, reduction={"size": 0.5})
    run(other, out=copied, overwrite=True, report=False)
    assert not own.exists()
    assert all(path.read_text() == "content" for path in foreign)


def test_symbolic_links_are_not_followed_out_of_the_run(finished, copied, tmp_path):
    outside = tmp_path / "outside"
    (copied / "small/reduction").rename(outside)
    (copied / "small/reduction").symlink_to(outside, target_is_directory=True)
    before = {path: path.read_bytes() for path in outside.iterdir()}
    other = small_scene(finished, reduction={"size": 0.5})
    with pytest.raises(InputError, match="symbolic link"):
        run(other, out=copied, overwrite=True)
    assert {path: path.read_bytes() for path in outside.iterdir()} == before


def test_a_part_says_which_settings_it_belongs_to(finished, tmp_path):
    import xarray as xr

    save_part(xr.Dataset({"a": ("x", [1.0, 2.0])}), tmp_path / "a.h5", "ab" * 32)
    assert digest_of(tmp_path / "a.h5") == "ab" * 32
    assert digest_of(finished / "loads.h5") is None  # a file of somebody else


def test_each_part_is_read_once_by_whoever_works_on_it(tmp_path, monkeypatch):
    """By its case, by the check, and by the summary of its stage."""
    reads = Counter()

    def counted(path):
        reads[path.parent.name, path.stem] += 1
        return read_whole(path)

    for place in ("cases", "whole"):
        monkeypatch.setattr(f"loadflow.running.{place}.read_whole", counted)
    run(small_scene(tmp_path), out=tmp_path / "runs", report=False)
    names = ("dlc1.1_v12_s1", "dlc1.1_v8_s1")
    times = {"loads": 3, "shaft": 3, "reduction": 1}  # of reductions there is no summary
    assert reads == {(stage, name): n for stage, n in times.items() for name in names}


# --- names -----------------------------------------------------------------------------------


ELSEWHERE = ["..", ".", "", "a/b", "a\\b", "/abs", "C:x", "con", "NUL.txt", "Com1", "a.", "a\n"]


@pytest.mark.parametrize("name", [*ELSEWHERE, ".hidden", "x" * 300, "a b", "é"])
def test_a_run_cannot_have_a_name_that_leads_elsewhere(finished, tmp_path, name):
    scene = small_scene(finished)
    with pytest.raises(InputError, match="name"):
        with_name(scene, name)
    with pytest.raises(InputError, match="name"):
        Scene.model_validate({"name": "x"}) and small_scene(finished, name=name)
    if name not in ("a b", "é"):  # these name a folder, though no run
        with pytest.raises(InputError, match="name"):
            run(scene.model_copy(update={"name": name}), out=tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_told_with_the_way_out(tmp_path, monkeypatch):
    """Starting again, which helps on a full disk, would not help here."""

    def refuse(path, *_, **__):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), str(path))

    scene = small_scene(tmp_path)
    monkeypatch.setattr(Path, "mkdir", refuse)
    with pytest.raises(LoadflowError) as told:
        run(scene, out=tmp_path / "locked")
    assert str(told.value).startswith(f"Permission denied: {tmp_path / 'locked'}")
    assert str(told.value).endswith("; out (-o) names another folder for runs")


def test_a_case_cannot_lead_out_of_the_run(tmp_path):
    from synthetic import case

    from loadflow.cube import make_cube, save_cube

    series = case(8.0, 1, steps=120).assign_coords(dlc="../../../out")
    save_cube(make_cube([series]), tmp_path / "loads.h5")
    with pytest.raises(InputError, match=r"loads\.h5: case = '\.\./"):
        run(small_scene(tmp_path), out=tmp_path / "runs")


@pytest.mark.parametrize("name", ["dlc1.1_v12_s1", "Start up 3", "a.b", "console", "com10"])
def test_names_of_files_that_harm_nobody_are_taken(name):
    assert check_name(name) == name


# --- one run at a time -----------------------------------------------------------------------


def test_two_runs_of_one_folder_do_not_meet(finished, copied):
    hold = (
        "import sys, time; from pathlib import Path; from loadflow.running.lock import locked\n"
        "with locked(Path(sys.argv[1])): print('held', flush=True); time.sleep(600)"
    )
    holder = subprocess.Popen(
        [sys.executable, "-c", hold, copied / "small"], stdout=subprocess.PIPE, text=True
    )
    try:
        assert holder.stdout.readline() == "held\n"
        with pytest.raises(LoadflowError, match=f"process {holder.pid} on .* is at work"):
            again(finished, copied)
    finally:
        holder.kill()  # as kill -9: nothing tidies up
        holder.wait()
    assert again(finished, copied)


def test_a_lock_is_free_again_after_an_error(tmp_path):
    with pytest.raises(ZeroDivisionError), locked(tmp_path):
        _ = 1 / 0
    with locked(tmp_path):
        pass


# --- disks and folders -----------------------------------------------------------------------


def test_a_file_that_a_full_disk_takes_no_more_of_is_named(tmp_path):
    """Writers of HDF5 tell the error alone; what another file lacks keeps that file's name."""
    full = OSError(28, "No space left on device")
    told = r"No space left on device: '.*loads\.h5'"
    with pytest.raises(OSError, match=told) as caught, written_whole(tmp_path / "loads.h5"):
        raise full
    assert caught.value.__cause__ is full
    assert list(tmp_path.iterdir()) == []
    with pytest.raises(OSError, match="'other'"), written_whole(tmp_path / "loads.h5"):
        raise OSError(28, "No space left on device", "other")


def test_a_full_disk_is_one_sentence_and_the_run_goes_on(finished, tmp_path, monkeypatch):
    import errno

    import loadflow.running.parts as parts

    out, write, written = tmp_path / "runs", parts.write_cube, []

    def full(cube, path):
        written.append(path)
        if len(written) == 3:
            path.write_bytes(b"as far as it went")
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        write(cube, path)

    with monkeypatch.context() as patch:
        patch.setattr(parts, "write_cube", full)
        with pytest.raises(LoadflowError, match=r"No space left on device.*goes on") as caught:
            again(finished, out)
    assert "\n" not in str(caught.value)
    assert list(out.rglob(".*tmp")) == []
    assert again(finished, out)


def test_a_file_that_may_not_grow_ends_the_command_with_a_message(finished, tmp_path):
    resource = pytest.importorskip("resource")
    scene = tmp_path / "scene.toml"
    scene.write_text(small_scene(finished).to_toml(), encoding="utf-8")
    command = [sys.executable, "-m", "loadflow.cli", "run", scene, "--out", tmp_path / "runs"]

    def at_most_20_kB():
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))

    done = subprocess.run(
        [*command, "--workers", "1"], preexec_fn=at_most_20_kB, capture_output=True, text=True
    )
    assert done.returncode == 1
    assert "failed: File too large" in done.stderr
    assert "Traceback" not in done.stderr
    assert again(finished, tmp_path / "runs")


def test_room_is_looked_for_before_a_large_cube_is_written(finished, tmp_path, monkeypatch):
    import loadflow.cube.files as files
    from loadflow.cube import open_cube, save_cube

    monkeypatch.setattr(files, "IN_MEMORY", 0)
    cube = open_cube(finished / "loads.h5").load()
    save_cube(cube, tmp_path / "fits.h5")
    assert contents(tmp_path / "fits.h5") == contents(finished / "loads.h5")
    usage = shutil.disk_usage(tmp_path)
    monkeypatch.setattr("loadflow.storage.shutil.disk_usage", lambda _: usage._replace(free=1000))
    with pytest.raises(OSError, match="MB wanted, 0 MB free"):
        save_cube(cube, tmp_path / "large.h5")
    assert [path.name for path in tmp_path.iterdir()] == ["fits.h5"]


def test_a_place_that_takes_no_folder_is_named(finished, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(LoadflowError, match=r"Not a directory: .*file"):
        again(finished, tmp_path / "file")


@pytest.mark.parametrize("gone", ["small", "small/loads"])
def test_a_folder_that_is_removed_meanwhile_is_named(finished, tmp_path, gone):
    def remove(stage, done, total):
        if (stage, done) == ("load cases", 1):
            shutil.rmtree(tmp_path / gone)

    with pytest.raises(LoadflowError, match="started again"):
        again(finished, tmp_path, progress=remove)
    assert again(finished, tmp_path)


# --- processes -------------------------------------------------------------------------------


@pytest.fixture
def bare(monkeypatch):
    """Worker processes that read none of the modules of a run before they are asked."""
    monkeypatch.setattr(f"{usable_cores.__module__}._read_modules", workers.idle)


def test_a_killed_worker_costs_the_item_that_kills_it_and_no_other(bare, caplog):
    items = [1, 2, 3, 13, 4, 5, 6, 7]
    with executor(2, None) as where:
        found = dict(where.outcomes(workers.doubled, items))
    assert isinstance(found.pop(13), Lost)
    assert found == {item: 2 * item for item in (1, 2, 3, 4, 5, 6, 7)}
    assert "go on with 1 processes" in caplog.text


def test_warnings_of_workers_are_words_without_a_line_of_code(bare, capfd):
    with executor(2, None) as where:
        assert sorted(found for _, found in where.outcomes(workers.doubted, [1, 2])) == [1, 2]
    told = [line for line in capfd.readouterr().err.splitlines() if line.strip()]
    assert sorted(told) == ["warning: film 1 is thin", "warning: film 2 is thin"]


def test_workers_that_never_live_end_the_run(bare):
    with (
        executor(2, None) as where,
        pytest.raises(LoadflowError, match="killed one after another"),
    ):
        list(where.outcomes(workers.always_killed, range(20)))


def test_a_lost_case_is_a_failure_of_the_run_and_the_others_are_kept(
    finished, tmp_path, monkeypatch
):
    import loadflow.running.runner as runner

    class Losing:
        workers, shares_disk = 1, True

        def outcomes(self, work, items):
            for item in items:
                lost = getattr(item, "wind_speed", None) == 12
                yield item, Lost("killed") if lost else work(item)

    from contextlib import nullcontext

    monkeypatch.setattr(runner, "executor", lambda *_: nullcontext(Losing()))
    found = run(small_scene(finished), out=tmp_path, report=False)
    assert found.failures == {"dlc1.1_v12_s1, worker": "killed"}
    assert is_sound(tmp_path / PART)


def test_a_worker_lost_in_the_check_ends_the_run_that_can_go_on(finished, tmp_path, monkeypatch):
    import loadflow.running.runner as runner
    from loadflow.running.whole import Piece

    class Losing:
        workers, shares_disk = 1, True

        def outcomes(self, work, items):
            for item in items:
                yield item, Lost("killed") if isinstance(item, Piece) else work(item)

    from contextlib import nullcontext

    with monkeypatch.context() as patch:
        patch.setattr(runner, "executor", lambda *_: nullcontext(Losing()))
        with pytest.raises(LoadflowError, match="check: killed; started again, the run goes on"):
            run(small_scene(finished), out=tmp_path, report=False)
    again = run(small_scene(finished), out=tmp_path, report=False)
    assert not again.failures
    assert "check" in again.tree.children


def test_what_no_solver_named_fails_one_case_and_is_in_the_log(finished, tmp_path, monkeypatch):
    from loadflow.stages.registry import STAGES

    good = STAGES["shaft"].run

    def broken(scene, case, inputs):
        if case.wind_speed > 10:
            raise ZeroDivisionError("at the root of it")
        return good(scene, case, inputs)

    monkeypatch.setitem(STAGES, "shaft", replace(STAGES["shaft"], run=broken))
    found = run(small_scene(finished), out=tmp_path, report=False)
    assert found.failures == {"dlc1.1_v12_s1, shaft": "ZeroDivisionError: at the root of it"}
    assert "in broken" in (tmp_path / "small/run.log").read_text()


def test_a_run_whose_bearings_fail_in_every_case_ends_with_their_reasons(
    finished, tmp_path, monkeypatch
):
    from loadflow.stages.registry import STAGES

    def broken(scene, case, inputs):
        raise ZeroDivisionError("at the root of it")

    monkeypatch.setitem(STAGES, "shaft", replace(STAGES["shaft"], run=broken))
    found = run(small_scene(finished), out=tmp_path, report=True)
    assert set(found.failures.values()) == {"ZeroDivisionError: at the root of it"}
    assert len(found.failures) == 2
    assert "shaft" not in found.tree.children
    assert found.report.exists()


def kill_points(folder, first, step):
    done = subprocess.run(
        [sys.executable, HERE / "kill_points.py", folder, str(first), str(step)],
        capture_output=True,
        text=True,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(HERE), *sys.path])},
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_kills_here_and_there_are_resumed_to_the_bit(tmp_path):
    found = kill_points(tmp_path, first=5, step=13)
    assert len(found["points"]) >= 3, found
    assert found["bad"] == []


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_kills_around_every_file_are_resumed_to_the_bit(tmp_path):
    found = kill_points(tmp_path, first=0, step=1)
    assert len(found["points"]) >= 36
    assert found["bad"] == []


@pytest.mark.slow
def test_of_50_kills_in_all_phases_each_is_resumed_to_the_bit(tmp_path):
    assert kills.survey(tmp_path, 50) == []


YEARS = 10 * 365 * 86400.0


@pytest.mark.parametrize("jump", [-YEARS, YEARS])
def test_a_clock_that_jumps_between_two_starts_changes_nothing(
    finished, copied, tmp_path, monkeypatch, jump
):
    (copied / PART).unlink()
    kept = copied / "small/reduction/dlc1.1_v12_s1.h5"
    paths = [path for path in copied.rglob("*") if path.is_file()]
    now = time.time()
    for path in paths:
        os.utime(path, (now + jump, now + jump))  # written by a clock that was off
    monkeypatch.setattr(time, "time", lambda: now - jump)  # and now it is off the other way
    assert again(finished, copied)
    assert kept.stat().st_mtime == pytest.approx(now + jump)  # what was finished is not done again
    assert (copied / PART).exists()
    (tmp_path / "loads.h5").write_bytes((finished / "loads.h5").read_bytes())
    os.utime(tmp_path / "loads.h5", (now + jump, now + jump))
    touched = small_scene(tmp_path)
    run(touched, out=tmp_path / "other", report=False)
    found = contents(tmp_path / "other/small/result.h5")
    assert found == contents(finished / "runs/small/result.h5")


# --- the rest --------------------------------------------------------------------------------


def test_cores_are_counted_on_systems_without_affinity(monkeypatch):
    assert usable_cores() >= 1
    monkeypatch.delattr(os, "sched_getaffinity", raising=False)
    monkeypatch.delattr(os, "process_cpu_count", raising=False)
    assert usable_cores() == os.cpu_count()


@pytest.mark.parametrize(("system", "most"), [("win32", 61), ("linux", 96)])
def test_windows_has_no_more_processes_than_it_can_wait_for(system, most, monkeypatch):
    class Idle:
        def __init__(self, workers):
            self.workers = workers

        def kill(self):
            pass

    monkeypatch.setattr(f"{usable_cores.__module__}._Processes", Idle)
    monkeypatch.setattr(sys, "platform", system)
    with executor(96, None) as where:
        assert where.workers == most


def test_the_log_of_a_run_is_in_its_folder(finished):
    told = (finished / "runs/small/run.log").read_text()
    assert "2 load cases, 0 of them finished" in told
    assert "dlc1.1_v12_s1: loads" in told
    assert told.rstrip().endswith("finished, 0 parts have no answer")
    assert not logging.getLogger("loadflow.run").handlers


def test_the_profile_adds_up_to_the_time_that_a_clock_shows(finished, tmp_path):
    started = time.perf_counter()
    run(small_scene(finished), out=tmp_path, profile=True)
    took = time.perf_counter() - started
    table = json.loads((tmp_path / "small/profile.json").read_text())
    assert 0.8 * took < table["wall_seconds"] <= took
    phases = table["phases"].values()
    assert sum(row["wall_seconds"] for row in phases) == pytest.approx(
        table["wall_seconds"], rel=0.01
    )
    assert {"loads", "shaft", "reduction"} == set(table["stages_of_load_cases"])
