"""The command line: exit codes, clear messages, no traceback."""

import json
import subprocess
import sys

import pytest
from synthetic import cube_file


def loadflow(*arguments, cwd=None):
    return subprocess.run(
        [sys.executable, "-m", "loadflow.cli", *map(str, arguments)],
        capture_output=True,
        text=True,
        cwd=cwd,
        check=False,
    )


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return cube_file(tmp_path_factory.mktemp("cube") / "loads.h5", wind_speeds=(8.0,), seeds=(1, 2))


SCENE = """
name = "tiny"
results = ["reduction.histogram", "rolling.loads"]
[shaft.moment]
[loads]
source = "files"
"""


def scene_file(folder, text=SCENE):
    path = folder / "scene.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_run_on_given_loads_writes_result_and_report(cube, tmp_path):
    done = loadflow(
        "run", scene_file(tmp_path), "--loads", cube, "--out", tmp_path, "--workers", 1, "--json"
    )
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert answer["failures"] == {}
    assert (tmp_path / "tiny" / "result.h5").exists()
    assert (tmp_path / "tiny" / "report.html").exists()


def test_plan_states_stages_and_what_is_left_out(cube, tmp_path):
    done = loadflow("plan", scene_file(tmp_path), "--loads", cube, "--json")
    plan = json.loads(done.stdout)
    stages = ["loads", "shaft", "reduction", "rolling", "check"]
    assert [step["stage"] for step in plan["steps"]] == stages
    assert plan["left_out"].keys() >= {"journal", "seeds", "wind, rotor"}


def test_show_prints_a_scene_that_is_a_scene(tmp_path):
    first = loadflow("scene", "--show", scene_file(tmp_path))
    again = loadflow("scene", "--show", scene_file(tmp_path, first.stdout))
    assert first.returncode == again.returncode == 0
    assert first.stdout == again.stdout


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[loads]\nwind = 3\n", "loads.wind: unknown key"),
        ("[journal.lubricant]\nviscosity = -1\n", "viscosity = -1: must be greater than 0"),
        ("[loads\n", "not a TOML file"),
        ('[loads]\nsource = "files"\nfiles = ["gone.outb"]\n', "gone.outb"),
        ('[loads]\nsource = "files"\n', "none is given"),
    ],
)
def test_a_bad_scene_gives_one_message_and_code_2(tmp_path, text, says):
    done = loadflow("run", scene_file(tmp_path, text), "--out", tmp_path)
    assert done.returncode == 2
    assert says in done.stderr.replace("\n", " ")
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("content", [b"", b"not a series", b"\x02\x00" * 40])
def test_a_broken_load_file_gives_one_message_and_code_2(tmp_path, content):
    path = tmp_path / "x_dlc11_v12_s1.outb"
    path.write_bytes(content)
    done = loadflow("run", scene_file(tmp_path), "--loads", path, "--out", tmp_path)
    assert done.returncode == 2
    assert path.name in done.stderr.replace("\n", "")
    assert "Traceback" not in done.stderr


def test_an_unknown_command_is_bad_usage():
    assert loadflow("walk").returncode == 2


def test_validate_counts_its_numbers_by_what_they_are_held_against():
    done = loadflow("validate", "seeds", "--summary", "--json")
    found = json.loads(done.stdout)
    assert list(found) == ["another code", "print of the source"]
    assert all(count["ok"] > 0 and count["out"] == 0 for count in found.values())


def test_validate_shows_only_what_failed():
    done = loadflow("validate", "shaft", "--failed")
    assert done.returncode == 0
    assert "hardens" not in done.stdout
    assert "closed form" in done.stdout  # of the counts


def test_validate_tells_how_far_it_is_and_no_warnings_of_its_own_cases():
    done = loadflow("validate", "supply", "seeds", "--summary")  # films of supply are not resolved
    assert "tables: 0 of 2" in done.stderr
    assert "tables: 2 of 2" in done.stderr
    assert "warning" not in done.stderr


def test_names_with_a_comma_are_told_from_one_another():
    told = loadflow("bench", "nope").stderr.replace("\n", " ")
    assert "journal, 'journal, transient', thrust" in told


def test_an_unknown_table_lists_the_known_ones():
    done = loadflow("validate", "magic")
    assert done.returncode == 2
    assert "journal" in done.stderr
