"""The command line: exit codes, clear messages, no traceback."""

import json
import subprocess
import sys

import pytest
from synthetic import cube_file


def new_process(*arguments, cwd=None):
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
    done = new_process(
        "run", scene_file(tmp_path), "--loads", cube, "--out", tmp_path, "--workers", 1, "--json"
    )
    assert done.returncode == 0, done.stderr
    answer = json.loads(done.stdout)
    assert answer["failures"] == {}
    assert (tmp_path / "tiny" / "result.h5").exists()
    assert (tmp_path / "tiny" / "report.html").exists()


def test_plan_states_stages_and_what_is_left_out(loadflow, cube, tmp_path):
    _, out, _ = loadflow("plan", scene_file(tmp_path), "--loads", cube, "--json")
    plan = json.loads(out)
    stages = ["loads", "shaft", "reduction", "rolling", "check"]
    assert [step["stage"] for step in plan["steps"]] == stages
    assert plan["left_out"].keys() >= {"journal", "seeds", "wind, rotor"}


def test_show_prints_a_scene_that_is_a_scene(loadflow, tmp_path):
    code, first, _ = loadflow("scene", "--show", scene_file(tmp_path))
    assert (code, first) == loadflow("scene", "--show", scene_file(tmp_path, first))[:2]
    assert code == 0


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("[loads]\nwind = 3\n", "loads.wind: unknown key"),
        ("[journal.lubricant]\nviscosity = -1\n", "viscosity = -1: must be greater than 0"),
        ("friction.temperature = 40\n", "temperatures are in K: 40 °C is 313.15 K"),
        ('bearings = ["jornal-thrust"]\n', ": bearings = 'jornal-thrust': is none of those sized"),
        ("[loads\n", "not a TOML file"),
        ('[loads]\nsource = "files"\nfiles = ["gone.outb"]\n', "gone.outb"),
        ('[loads]\nsource = "files"\n', "none is given"),
    ],
)
def test_a_bad_scene_gives_one_message_and_code_2(loadflow, tmp_path, text, says):
    code, _, errors = loadflow("run", scene_file(tmp_path, text), "--out", tmp_path)
    assert code == 2
    assert says in errors.replace("\n", " ")
    assert "Traceback" not in errors


@pytest.mark.parametrize("content", [b"", b"not a series", b"\x02\x00" * 40])
def test_a_broken_load_file_gives_one_message_and_code_2(loadflow, tmp_path, content):
    path = tmp_path / "x_dlc11_v12_s1.outb"
    path.write_bytes(content)
    code, _, errors = loadflow("run", scene_file(tmp_path), "--loads", path, "--out", tmp_path)
    assert code == 2
    assert path.name in errors.replace("\n", "")
    assert "Traceback" not in errors


def test_a_new_process_ends_with_the_message_and_code_2(tmp_path):
    done = new_process("run", scene_file(tmp_path, "[loads\n"), "--out", tmp_path)
    assert done.returncode == 2
    assert "not a TOML file" in done.stderr.replace("\n", " ")
    assert "Traceback" not in done.stderr


def test_an_unknown_command_is_bad_usage(loadflow):
    assert loadflow("walk")[0] == 2


def test_validate_counts_its_numbers_by_what_they_are_held_against(loadflow):
    _, out, _ = loadflow("validate", "seeds", "--summary", "--json")
    found = json.loads(out)
    assert list(found) == ["another code", "print of the source"]
    assert all(count["ok"] > 0 and count["out"] == 0 for count in found.values())


def test_validate_shows_only_what_failed(loadflow):
    code, out, _ = loadflow("validate", "shaft", "--failed")
    assert code == 0
    assert "hardens" not in out
    assert "closed form" in out  # of the counts


def test_validate_tells_how_far_it_is_and_no_warnings_of_its_own_cases():
    done = new_process(
        "validate", "supply", "seeds", "--summary"
    )  # films of supply are not resolved
    assert "tables: 0 of 2" in done.stderr
    assert "tables: 2 of 2" in done.stderr
    assert "warning" not in done.stderr


def test_names_with_a_comma_are_told_from_one_another(loadflow):
    told = loadflow("bench", "nope")[2].replace("\n", " ")
    assert "journal, 'journal, transient', thrust" in told


def test_an_unknown_table_lists_the_known_ones(loadflow):
    code, _, errors = loadflow("validate", "magic")
    assert code == 2
    assert "journal" in errors
