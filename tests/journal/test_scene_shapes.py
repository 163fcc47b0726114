"""Shapes of the bore and tilt of the shaft as a scene states them."""

import numpy as np
import pytest

import loadflow as lf
from loadflow.errors import InputError
from loadflow.journal import Contour, Crown, Lobes
from loadflow.scene.journal import Journal
from loadflow.stages.films.of_bearing import equilibria

SCENE = """
results = ["journal.film"]
[journal.geometry]
diameter = 3.0
width = 2.25
relative_clearance = 0.5e-3
"""


def read(folder, text):
    path = folder / "scene.toml"
    path.write_text(SCENE + text)
    return lf.read_scene(path)


def test_a_scene_states_shape_and_relief_and_keeps_them(tmp_path):
    text = """
    shape = { kind = "lobes", count = 3, preload = 0.4 }
    relief = [
        { kind = "crown", height = 5e-5 },
        { kind = "contour", angle = [0.0, 3.0], height = [0.0, 1e-5] },
    ]
    """
    geometry = read(tmp_path, text).journal.geometry
    assert geometry.shape == Lobes(3, preload=0.4)
    assert geometry.relief == (Crown(5e-5), Contour([0.0, 3.0], [0.0, 1e-5]))
    again = tmp_path / "again.toml"
    again.write_text(read(tmp_path, text).to_toml())
    assert lf.read_scene(again).journal.geometry == geometry


@pytest.mark.parametrize(
    ("text", "lines"),
    [
        (
            'shape = { kind = "lobes", count = 3, span = 2.0 }',
            ["journal.geometry.shape.span: unknown key"],
        ),
        ('shape = { kind = "lobes", count = 0 }', ["journal.geometry.shape.count = 0"]),
        (
            'shape = { kind = "oval" }',
            [
                f"kind = 'oval': must be '{k}'"
                for k in ("cylindrical", "arc", "lobes", "tilting pads")
            ],
        ),
    ],
)
def test_mistakes_are_named_for_the_stated_kind_alone(tmp_path, text, lines):
    with pytest.raises(InputError) as error:
        read(tmp_path, text)
    message = str(error.value).splitlines()
    assert len(message) == len(lines)
    for line, part in zip(message, lines):
        assert part in line


def test_the_moment_of_the_shaft_tilts_it_in_the_frame_of_the_cube():
    """A moment about y of the cube presses the shaft down behind the middle of the bearing."""
    options = Journal(grid=(36, 8))
    force = np.array([[0.0, 0.0, -1.5e6]])
    moment = np.array([[0.0, 2e5, 0.0]])
    straight = equilibria(options, force, np.array([1.2]))
    tilted = equilibria(options, force, np.array([1.2]), moment=moment)
    np.testing.assert_allclose(straight.tilt, 0.0)
    # x downwind is the film's third axis: a rotation about y > 0 lowers the shaft at x > 0
    at_rim = tilted.eccentricity[0, 0] + 0.5 * 2.25 * tilted.tilt[0, 1]
    assert at_rim > tilted.eccentricity[0, 0]
    assert tilted.minimum_film[0] < straight.minimum_film[0]
