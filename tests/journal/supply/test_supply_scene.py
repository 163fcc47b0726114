"""A supply in a scene and on the command line."""

import json

import pytest
from typer.testing import CliRunner

import loadflow as lf
from loadflow.cli import app
from loadflow.errors import InputError
from loadflow.journal import Capillary, Groove, Orifice, Pump, Supply

SCENE = """
name = "pumped"
results = ["journal.film"]
[journal.supply.pump]
flow = [0.0, 3.3e-3]
pressure = [0.65e6, 0.6e6]
line = {diameter = 0.02, length = 1.0}
[[journal.supply.grooves]]
angle = 1.5
length = 1.5
[[journal.supply.grooves]]
angle = -1.5
length = 1.5
restrictor = {diameter = 5e-3}
"""
BEARING = "journal --diameter 0.2 --width 0.2 --relative-clearance 1e-3 --viscosity 0.03 "
BEARING += "--force-x 8e3 --speed-rpm 500 --grid 48 12 --json "


def test_a_scene_states_grooves_restrictors_and_pump(tmp_path):
    path = tmp_path / "scene.toml"
    path.write_text(SCENE)
    pump = Pump((0.0, 3.3e-3), (0.65e6, 0.6e6), line=Capillary(0.02, 1.0))
    grooves = (Groove(1.5, length=1.5), Groove(-1.5, length=1.5, restrictor=Orifice(5e-3)))
    assert lf.read_scene(path).journal.supply == Supply(grooves, pump)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("flow = [0.0, 3.3e-3]", "flow = [0.0]", "journal.supply.pump: pressure = .* each of 1"),
        ("angle = 1.5\n", "angel = 1.5\n", "journal.supply.grooves.0.angel: unknown key"),
        ("length = 1.5\n[[", "length = -1.5\n[[", "journal.supply.grooves.0.length"),
    ],
)
def test_a_bad_supply_of_a_scene_is_named(tmp_path, old, new, message):
    path = tmp_path / "scene.toml"
    assert old in SCENE
    path.write_text(SCENE.replace(old, new))
    with pytest.raises(InputError, match=message):
        lf.read_scene(path)


def test_grooves_on_the_command_line():
    words = "--groove-angle-deg 90 --groove-angle-deg -90 --groove-length 0.15 "
    answer = CliRunner().invoke(app, (BEARING + words + "--supply-pressure 5e5").split())
    assert answer.exit_code == 0, answer.output
    assert len(json.loads(answer.stdout)["groove_flow"]["value"]) == 2
    answer = CliRunner().invoke(app, (BEARING + "--supply-pressure 5e5").split())
    assert isinstance(answer.exception, InputError)
    assert "--groove-angle-deg" in str(answer.exception)
