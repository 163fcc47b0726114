"""What files and their names say of a rotor that starts, stops or stands counts in plans."""

from pathlib import Path

import pytest

from loadflow.cube import make_case, make_cube, save_cube
from loadflow.scene.cases import Case, design_load_cases, list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages.effects.clearances import CLEARANCES
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.situation import points, situation
from loadflow.stages.films.turning import always_turns, is_parked
from loadflow.wind.cases import factor_of_maximum


def scene_of(*files):
    loads = {"source": "files", "files": [str(file) for file in files]}
    shaft = {"two_point": {"beam": {}}}
    given = {"name": "given", "results": ["journal.film"], "bearings": ["journal-thrust"]}
    return make_scene(given | {"loads": loads, "shaft": shaft})


def cube(folder, dlc):
    """A rotor that runs up from standstill."""
    time = [0.1 * k for k in range(60)]
    data = {
        "speed": [0.02 * k for k in range(60)],
        "hub_force": [[3e5] * 60, [0.0] * 60, [-1e6] * 60],
        "hub_moment": [[1e6] * 60] * 3,
    }
    case = make_case(time, data, dlc=dlc, wind_speed=8.0, seed=1)
    return save_cube(make_cube([case]), Path(folder) / f"{dlc}.h5")


@pytest.mark.parametrize(
    ("name", "turns"),
    [
        ("dlc1.1_v12_s1.outb", True),
        ("nrel5mw_dlc31_v12_s1.outb", False),
        ("dlc4.1b_v12_s1.outb", False),
        ("dlc1.3a_v12_s1.outb", True),
        ("nrel5mw_startup_v12.outb", False),
        ("nrel5mw_idling_v12.outb", False),
        ("nrel5mw_steady_v12.outb", True),
    ],
)
def test_names_of_files_tell_whether_the_rotor_always_turns(name, turns):
    assert always_turns(scene_of(name)) == turns


@pytest.mark.parametrize("dlc", ["3.1", "startup"])
def test_a_shaft_of_smooth_bearings_that_starts_does_not_float_in_its_films(tmp_path, dlc):
    scenes = {word: scene_of(cube(tmp_path, word)) for word in (dlc, "1.1")}
    assert design_load_cases(scenes[dlc]) == {dlc}
    floats = {word: CLEARANCES.switched(scene, True) for word, scene in scenes.items()}
    assert floats[dlc] is None
    assert floats["1.1"] is not None
    moves = {word: MOTION.switched(scene, True) for word, scene in scenes.items()}
    assert moves[dlc] is None
    assert moves["1.1"] is not None


def test_motion_counts_in_full_where_given_series_start(tmp_path):
    sizes = {}
    for dlc in ("startup", "1.1"):
        scene = scene_of(cube(tmp_path, dlc))
        sizes[dlc] = MOTION.indicator(situation(scene, list_cases(scene)))["minimum film"]
    assert sizes["startup"] > sizes["1.1"]


def test_a_shaft_that_a_word_calls_parked_stands():
    assert is_parked(Case("parked", 42.5, 1))
    assert not is_parked(Case("idling", 12.0, 1))


def test_variants_and_words_have_the_state_and_the_factor_of_their_load_case():
    """Files name variants, such as 6.2a, which the table of the standard does not list."""
    assert is_parked(Case("6.2a", 42.5, 1))
    assert factor_of_maximum("6.2a") == factor_of_maximum("6.2") == 1.1
    alike = [Case(dlc, 8.0, 1) for dlc in ("6.4", "6.4a", "idling", "idle")]
    assert len(points(alike)) == 1
    assert len(points([*alike, Case("1.1", 8.0, 1)])) == 2
