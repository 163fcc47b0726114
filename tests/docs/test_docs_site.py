"""The pages of the site: the command line takes their commands, scenes and Python run."""

import re
import shlex
import subprocess
import sys
import tomllib

import pytest
import typer.main
from taught_pages import DOCS, TAUGHT, TUTORIAL

from loadflow.cli import main
from loadflow.cli.base import app
from loadflow.scene.scene import read_scene

ROOT = DOCS.parent
COMMAND = typer.main.get_command(app)


def blocks(page, language):
    return re.findall(rf"```{language}\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


def commands(page):
    """Lines of a page that call loadflow, as lists of arguments."""
    lines = [line for block in blocks(page, "sh") for line in block.splitlines()]
    return [shlex.split(line, comments=True)[1:] for line in lines if line.startswith("loadflow ")]


@pytest.mark.parametrize("page", TAUGHT, ids=lambda page: page.stem)
def test_the_command_line_takes_the_commands_of_a_page(page):
    taught = commands(page)
    assert taught or page.stem == "index" or blocks(page, "python")
    for name, *arguments in taught:
        if name != "--version":
            COMMAND.commands[name].make_context(name, arguments)


@pytest.mark.parametrize("page", TAUGHT, ids=lambda page: page.stem)
def test_the_python_of_a_page_runs(page):
    for block in blocks(page, "python"):
        exec(block, {})


def test_the_scene_of_the_page_on_bearings_is_one(tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(blocks(DOCS / "how-to/bearing.md", "toml")[0], encoding="utf-8")
    places = tomllib.loads(read_scene(path).to_toml())["bearings"]
    assert {place: one["kind"] for place, one in places.items()} == {
        "N": "journal",
        "N2": "spherical",
    }


QUICK = ("--version", "list", "init", "scene")


def test_the_tutorial_begins_without_error(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    begun = [arguments for arguments in commands(TUTORIAL) if arguments[0] in QUICK]
    assert len(begun) >= 5
    for arguments in begun:
        with pytest.raises(SystemExit) as stop:
            main(arguments)
        assert not stop.value.code, capsys.readouterr().err


@pytest.mark.slow
def test_the_tutorial_leads_to_the_page_that_compares(tmp_path):
    for arguments in commands(TUTORIAL):
        command = [sys.executable, "-m", "loadflow.cli", *arguments]
        done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
    assert (tmp_path / "runs/mine/compare.html").exists()


def rooms():
    """Rooms that offer public names: those with a stub."""
    package = ROOT / "loadflow"
    for stub in sorted(package.rglob("__init__.pyi")):
        yield ".".join(("loadflow", *stub.parent.relative_to(package).parts))


@pytest.mark.parametrize("room", list(rooms()))
def test_every_room_has_a_page_of_reference(room):
    name = room.removeprefix("loadflow.")
    page = (DOCS / "reference" / f"{name}.md").read_text(encoding="utf-8")
    assert f".. automodule:: {room}\n" in page
    assert f"\n{name}\n" in (DOCS / "reference/index.md").read_text(encoding="utf-8")


def test_every_page_is_in_the_navigation():
    listed = set()
    for index in DOCS.rglob("*.md"):
        for tree in blocks(index, r"\{toctree\}"):
            names = [line for line in tree.splitlines() if line and not line.startswith(":")]
            listed |= {(index.parent / f"{name}.md").resolve() for name in names}
    assert set(DOCS.rglob("*.md")) - {DOCS / "index.md"} == listed


@pytest.mark.slow
def test_the_site_is_built_without_a_warning(tmp_path):
    pytest.importorskip("sphinx")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    done = subprocess.run(
        [*command, str(DOCS), str(tmp_path / "html")], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    assert "<math" in (tmp_path / "html" / "theory.html").read_text(encoding="utf-8")
    assert "equilibrium" in (tmp_path / "html/reference/journal.html").read_text(encoding="utf-8")
