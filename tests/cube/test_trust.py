"""HDF5 files that end the process which reads them, or keep it forever, are refused by name."""

import os
import signal
import sys
import time

import h5py
import pytest
from synthetic import cube_file

from loadflow.cube import open_cube, trust
from loadflow.errors import InputError


@pytest.fixture
def examiner(monkeypatch):
    found = trust._Examiner()
    monkeypatch.setattr(trust, "_EXAMINER", found)
    yield found
    found.close()


def program(tmp_path, monkeypatch, body):
    """Put another program in place of the one that examines."""
    path = tmp_path / "program.py"
    path.write_text(
        f"import json, os, signal, sys\nprint('\"ready\"', flush=True)\nfor line in sys.stdin:\n"
        f"    print('[\"block0000/data\"]', flush=True)\n    {body}\n"
    )
    monkeypatch.setattr(trust.program, "__file__", str(path))


@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.parametrize(
    ("which", "says"),
    [("SIGSEGV", "ends the process that reads it"), ("SIGPROF", "finds no end of it")],
)
def test_a_file_that_ends_its_reader_is_refused_with_the_place(
    tmp_path, monkeypatch, examiner, which, says
):
    path = cube_file(tmp_path / "loads.h5", steps=50)
    body = f"os.kill(os.getpid(), signal.{which})"
    program(tmp_path, monkeypatch, body)
    with pytest.raises(InputError, match=rf"loads\.h5, block0000/data: damaged so that.*{says}"):
        open_cube(path)


@pytest.mark.skipif(os.name != "posix", reason="signals")
def test_another_file_is_not_blamed_for_what_one_before_it_harmed(tmp_path, monkeypatch, examiner):
    program(
        tmp_path,
        monkeypatch,
        "again = globals().get('again', 0) + 1;"
        " os.kill(os.getpid(), signal.SIGSEGV) if again > 1 else print('\"\"', flush=True)",
    )
    path = cube_file(tmp_path / "loads.h5", steps=50)
    for _ in range(4):  # of each process the first answer is sound, and the second its end
        trust._check(path)


def test_without_an_interpreter_files_are_examined_here(tmp_path, monkeypatch, examiner):
    monkeypatch.setattr(sys, "executable", str(tmp_path / "none"))
    path = cube_file(tmp_path / "loads.h5", steps=50)
    open_cube(path)
    path.write_bytes(path.read_bytes()[:700])
    with pytest.raises(InputError, match=r"loads\.h5: cannot be read as HDF5"):
        open_cube(path)


def test_a_sound_file_is_examined_once_and_again_when_it_has_changed(
    tmp_path, monkeypatch, examiner
):
    asked = []
    monkeypatch.setattr(examiner, "examined", lambda path: asked.append(path) or "")
    path = tmp_path / "run.h5"
    h5py.File(path, "w").close()
    for age in (100, 100, 50, 50, 0, 0):  # what is young may change within the same time stamp
        os.utime(path, (time.time() - age,) * 2) if age == 0 else os.utime(path, (1e9 - age,) * 2)
        trust.check_hdf5(path)
    assert len(asked) == 4


@pytest.mark.skipif(not hasattr(signal, "SIGKILL"), reason="signals")
def test_a_process_that_was_killed_between_two_files_is_started_again(tmp_path, examiner):
    path = cube_file(tmp_path / "loads.h5", steps=50)
    trust._check(path)
    trust._check(path)
    os.kill(examiner._process.pid, signal.SIGKILL)
    trust._check(path)
