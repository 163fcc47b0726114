"""What a person meets at the command line: help, examples, completion, other code pages."""

import json
import os
import shlex
import subprocess
import sys

import pytest
import typer.main
from rich.text import Text
from synthetic import cube_file

from loadflow.cli import EXAMPLE, main
from loadflow.cli.base import app
from loadflow.cube import examine

COMMAND = typer.main.get_command(app)


def call(capsys, *arguments, code=0):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert (stop.value.code or 0) == code
    return capsys.readouterr()


@pytest.mark.parametrize("name", COMMAND.commands)
def test_the_help_of_a_command_ends_with_an_example_that_it_takes(name, capsys):
    assert "Example: loadflow" in call(capsys, name, "--help").out
    program, command, *arguments = shlex.split(EXAMPLE[name])
    assert (program, command) == ("loadflow", name)
    COMMAND.commands[name].make_context(name, arguments)  # click refuses unknown options


@pytest.mark.parametrize("name", ["journal", "rolling", "wind"])
def test_the_example_of_one_bearing_or_wind_gives_an_answer(name, capsys):
    assert call(capsys, *shlex.split(EXAMPLE[name])[1:]).out


@pytest.mark.parametrize("name", COMMAND.commands)
def test_help_keeps_what_stands_in_brackets(name):
    command = COMMAND.commands[name]
    helps = [command.help, *(one.help for one in command.params if getattr(one, "help", None))]
    assert [Text.from_markup(one).plain for one in helps] == [
        one.replace("\\[", "[") for one in helps
    ]


def test_help_fits_a_terminal_of_80_columns_whole(capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    for name in ("", *COMMAND.commands):
        told = call(capsys, *filter(None, [name]), "--help").out
        assert max(map(len, told.splitlines())) <= 80
        assert "…" not in told, name  # a word that is wider than its column is cut
        assert "bool" not in told.lower(), name  # a switch takes no value


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_is_written_for_the_shell(shell, tmp_path):
    away = {"HOME": str(tmp_path), "_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION": "1"}
    code = "from loadflow.cli import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", code, "--install-completion", shell],
        capture_output=True, text=True, check=False, env=os.environ | away,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    written = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert any("_COMPLETE" in path.read_text(encoding="utf-8") for path in written)


# what another system lacks: affinity of processes, UTF-8 files by default, Greek in its code page
ELSEWHERE = """
import os, sys
for name in ("sched_getaffinity", "process_cpu_count"):
    if hasattr(os, name):
        delattr(os, name)
from loadflow.cli import main
main(sys.argv[1:])
"""
CODE_PAGE = {
    "LC_ALL": "C",
    "PYTHONUTF8": "0",
    "PYTHONCOERCECLOCALE": "0",
    "PYTHONIOENCODING": "cp1252",
}


def elsewhere(*arguments):
    return subprocess.run(
        [sys.executable, "-c", ELSEWHERE, *map(str, arguments)],
        capture_output=True, encoding="cp1252", check=False, env=os.environ | CODE_PAGE,
    )  # fmt: skip


def test_letters_that_a_code_page_lacks_are_escaped():
    done = elsewhere("wind", "12")
    assert done.returncode == 0, done.stderr
    assert "\\u03c3" in done.stdout  # σ


def test_a_run_needs_neither_affinity_nor_utf8(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1, 2))
    scene = tmp_path / "scene.toml"
    scene.write_text(
        '# Größe ω ≤ 1\nname = "away"\nresults = ["reduction.histogram", "rolling.loads"]\n'
        '[shaft.moment]\n[loads]\nsource = "files"\n',
        encoding="utf-8",
    )
    done = elsewhere("run", scene, "--loads", cube, "--out", tmp_path, "--workers", 2)
    assert done.returncode == 0, done.stderr
    assert not (tmp_path / "away" / "report.html").read_text(encoding="utf-8").isascii()


# What Windows has not: `fcntl` and `resource`. The lock is that of the lines for Windows; the one
# call that they make there, a byte locked without waiting, is made of what this system has for it.
WINDOWS = """
import os, sys, types
from pathlib import Path
for name in ("fcntl", "resource"):
    sys.modules[name] = None
here = sys.platform
sys.platform = "win32"
sys.modules["msvcrt"] = types.SimpleNamespace(
    LK_NBLCK=0, locking=lambda handle, mode, size: os.lockf(handle, os.F_TLOCK, size)
)
from loadflow.running.lock import locked
sys.platform = here
del sys.modules["msvcrt"]
"""


@pytest.mark.skipif(not hasattr(os, "lockf"), reason="the stand-in is made of lockf")
def test_a_folder_is_locked_without_fcntl(tmp_path):
    take = f"{WINDOWS}with locked(Path(sys.argv[1])): print('held', flush=True); sys.stdin.read(1)"
    arguments = [sys.executable, "-c", take, str(tmp_path)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(arguments, **pipes) as holder:
        assert holder.stdout.readline() == "held\n"
        told = subprocess.run(arguments, capture_output=True, text=True, check=False, input="x")
        assert f"process {holder.pid} on" in told.stderr
        assert "held" not in told.stdout
        holder.communicate("x")
    assert subprocess.run(arguments, input=b"x", check=False).returncode == 0  # it ended with it


@pytest.mark.parametrize("damaged", [False, True])
def test_a_file_is_examined_without_limits_of_memory(damaged, tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,))
    if damaged:
        cube.write_bytes(cube.read_bytes()[:-5000])
    code = """
import runpy, sys
sys.modules["fcntl"] = sys.modules["resource"] = None
runpy.run_path(sys.argv[1], run_name="__main__")
"""
    done = subprocess.run(
        [sys.executable, "-c", code, examine.__file__], input=json.dumps(str(cube)) + "\n",
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    ready, *places, answer = map(json.loads, done.stdout.splitlines())
    assert ready == "ready"
    assert bool(places) is not damaged  # a file that is cut cannot be opened
    assert bool(answer) is damaged


@pytest.mark.skipif(not hasattr(os, "lockf"), reason="the stand-in is made of lockf")
def test_a_run_needs_neither_fcntl_nor_resource(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1, 2))
    scene = tmp_path / "scene.toml"
    scene.write_text(
        'name = "away"\nresults = ["loads.statistics"]\n[loads]\nsource = "files"\n',
        encoding="utf-8",
    )
    code = f"{WINDOWS}from loadflow.cli import main\nmain(sys.argv[1:])"
    arguments = ("run", scene, "--loads", cube, "--out", tmp_path, "--workers", 1)
    done = subprocess.run(
        [sys.executable, "-c", code, *map(str, arguments)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "away" / "result.h5").exists()


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        ("loadflow ru", {"run"}),
        ("loadflow list be", {"bearings"}),
        ("loadflow init quick", {"quick_look"}),
        ("loadflow validate frictio", {"friction", "friction_rig"}),
        ("loadflow loads --turbine n", {"nrel-5mw"}),
        ("loadflow compare x.toml --candidate journal-l", {"journal-lemon"}),
        ("loadflow journal --oil mineral", {"mineral-vg-320"}),
    ],
)
def test_a_shell_completes_names(typed, told, monkeypatch, capsys):
    words = typed.split()
    monkeypatch.setattr("sys.argv", ["loadflow"])
    monkeypatch.setenv("_LOADFLOW_COMPLETE", "complete_bash")
    monkeypatch.setenv("COMP_WORDS", typed)
    monkeypatch.setenv("COMP_CWORD", str(len(words) - 1))
    with pytest.raises(SystemExit):
        app(prog_name="loadflow")
    assert set(capsys.readouterr().out.split()) == told
