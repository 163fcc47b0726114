"""Commands to begin with: init, list, and the order of the help."""

import json
import subprocess
import sys
from typing import get_args

import pytest

import loadflow
from loadflow.cli import GROUPS, main
from loadflow.cli.base import app
from loadflow.cli.lists import LISTS
from loadflow.rolling.bearings.arrangements import ARRANGEMENTS
from loadflow.scene.results import Result
from loadflow.scene.scene import read_scene
from loadflow.scene.templates import template_text, templates


def call(capsys, *arguments, code=0):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert (stop.value.code or 0) == code
    return capsys.readouterr()


def test_the_package_run_as_a_module_is_the_command_line():
    arguments = [sys.executable, "-m", "loadflow", "--version"]
    told = subprocess.run(arguments, capture_output=True, text=True, check=True)
    assert told.stdout == f"loadflow {loadflow.__version__}\n"


def test_init_writes_a_scene_that_is_valid(tmp_path, capsys):
    path = tmp_path / "new" / "mine.toml"  # the folder is made
    assert "loadflow run" in call(capsys, "init", "-o", str(path)).out
    assert read_scene(path).name == "mine"
    assert "exists already" in call(capsys, "init", "-o", str(path), code=2).err
    told = call(capsys, "init", "magic", "-o", str(tmp_path / "x.toml"), code=2).err
    assert "quick_look" in told


def test_a_place_that_takes_no_file_is_told_in_words_and_not_by_its_number(tmp_path, capsys):
    (tmp_path / "file").write_text("")
    told = call(capsys, "init", "-o", str(tmp_path / "file" / "scene.toml"), code=1).err
    assert told == f"failed: File exists: {tmp_path / 'file'}\n"


def test_a_scene_on_load_files_is_told_with_the_option_that_names_them(tmp_path, capsys):
    path = tmp_path / "own.toml"
    assert "compare own.toml --loads" in call(
        capsys, "init", "openfast", "-o", str(path)
    ).out.replace(f"{tmp_path}/", "")
    assert "--loads 'path/to/*.outb'" in call(capsys, "plan", str(path), code=2).err


def test_a_pattern_of_load_files_needs_no_quotes(tmp_path, capsys):
    path = tmp_path / "own.toml"
    call(capsys, "init", "openfast", "-o", str(path))
    files = [str(tmp_path / name) for name in ("a_dlc11_v8_s1.outb", "a_dlc11_v12_s1.outb")]
    told = call(capsys, "plan", "--loads", *files, str(path), code=2).err
    assert "a_dlc11_v8_s1.outb" in told  # which does not exist, and is no argument too many
    assert "unexpected" not in told


@pytest.mark.parametrize("name", templates())
def test_every_template_says_what_it_is_and_takes_a_name(name):
    assert templates()[name]
    assert 'name = "other"' in template_text(name, "other")


@pytest.mark.parametrize("name", LISTS)
def test_every_list_has_rows_as_wide_as_its_heads(name, capsys):
    heads, rows = LISTS[name]()
    assert rows
    assert {len(row) for row in rows} == {len(heads)}
    found = json.loads(call(capsys, "list", name, "--json").out)
    assert len(found) == len(rows)
    assert set(found[0]) == set(heads)


def test_lists_are_listed_and_an_unknown_one_is_refused(capsys):
    assert set(json.loads(call(capsys, "list", "--json").out)) == set(LISTS)
    assert "turbines" in call(capsys, "list", "magic", code=2).err
    assert "did you mean oils?" in call(capsys, "list", "oil", code=2).err


def test_a_list_can_be_asked_for_one_turbine_or_stage(capsys):
    found = json.loads(call(capsys, "list", "bearings", "nrel-5mw", "--json").out)
    assert {row["kind or turbine"] for row in found} == {"nrel-5mw"}
    assert "two-spherical" in {row["name"] for row in found}
    assert {row["stage"] for row in json.loads(call(capsys, "list", "rungs", "wind", "--json").out)}
    told = call(capsys, "list", "bearings", "nrel-5m", code=2).err
    assert "did you mean nrel-5mw?" in told


def test_a_source_of_several_bearings_is_printed_once(capsys):
    told = call(capsys, "list", "bearings").out
    notes = [line.partition("  ")[2] for line in told.splitlines() if line[:1].isdigit()]
    assert len(notes) == len(set(notes))
    _, rows = LISTS["bearings"]()
    assert all(row[-1].startswith(tuple(notes)) for row in rows if row[-1])
    assert "`" not in told  # words for users, not those of the code
    assert "class ISO VG 320 (ISO 3448)" in " ".join(call(capsys, "list", "oils").out.split())


def test_every_kind_of_bearing_and_every_result_is_said_in_words():
    _, bearings = LISTS["bearings"]()
    assert all(told for _, _, told, _ in bearings)
    assert {name for what, name, *_ in bearings if what == "rolling.arrangement"} == {*ARRANGEMENTS}
    _, results = LISTS["results"]()
    assert {name for name, *_ in results} == {*get_args(Result)}


@pytest.mark.parametrize(
    ("lines", "meant"),
    [
        ('[turbine]\nname = "nrel-5m"', "nrel-5mw"),
        ('[friction]\nlubricant = "iso-vg-20"', "iso-vg-220"),
        ('[rolling]\narrangement = "two-sferical"', "two-spherical"),
        ('[rolling]\narangement = "two-spherical"', "arrangement"),
        ('[bearings.N]\nkind = "jornal"', "journal"),
        ("[candidates.two-sferical]", "two-spherical"),
    ],
)
def test_a_name_of_a_scene_that_is_nearly_right_is_told(lines, meant, tmp_path, capsys):
    path = tmp_path / "scene.toml"
    path.write_text(lines)
    assert f"did you mean {meant}?" in call(capsys, "scene", str(path), code=2).err


def test_every_command_has_its_group_and_run_comes_first():
    names = [c.name or c.callback.__name__ for c in app.registered_commands]
    assert names[0] == "run"
    assert set(names) == {name for group in GROUPS.values() for name in group}
    assert all(c.rich_help_panel in GROUPS for c in app.registered_commands)
