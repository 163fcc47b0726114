"""What the check of a run asks of films: samples in which the rotor runs."""

import numpy as np
import pytest
import xarray as xr

from loadflow.scene import make_scene
from loadflow.scene.cases import Case
from loadflow.stages import journal as stage
from loadflow.stages.comparisons import compare
from loadflow.stages.films.of_bearing import equilibria
from loadflow.stages.journal import FILM
from loadflow.stages.paths_again import answers_of_path, extremes_of_orbit

CASE = Case(dlc="4.1", wind_speed=12.0, seed=1)
STEP = 0.05


def scene_of(**more):
    return make_scene(
        {
            "accuracy": "given",
            "journal": {"bearings": ["N"], "rung": "reduced", "grid": (24, 8), **more},
            "shaft": {"two_point": {}},
        }
    )


def stop(speeds, swing=0.0):
    """Loads, shaft and reduced series of a rotor that comes to a stand."""
    time, speed = STEP * np.arange(speeds.size), ("time", speeds)
    force = np.stack([0 * time, swing * np.cos(4 * time), -1e6 + swing * np.sin(4 * time)], axis=-1)
    loads = xr.Dataset({"time": ("time", time), "speed": speed})
    rows = {"force": force[None], "moment": 0 * force[None]}
    shaft = xr.Dataset({name: (("bearing", "time", "axis"), row) for name, row in rows.items()})
    reduced = xr.Dataset(
        {
            "time": ("sample", time),
            "speed": ("sample", speeds),
            "weight": ("sample", np.ones(time.size)),
            "force": (("sample", "axis"), force),
            "moment": (("sample", "axis"), 0 * force),
            "index": ("sample", np.arange(time.size)),
        }
    )
    shaft = shaft.assign_coords(bearing=["N"], time=time)
    tree = xr.DataTree.from_dict({"N": reduced})
    return {"loads": loads.assign_coords(time=time), "shaft": shaft, "reduction": tree}


def film_errors(scene, parts):
    """Differences of the film from the next better one, by quantity."""
    asked = {name: part for name, part in parts.items() if name != "reduction"}
    asked |= {} if scene.journal.in_motion else {"reduction": parts["reduction"]}
    rows = list(compare(scene, CASE, asked))
    return {row.quantity: row.value for row in rows if row.stage == "journal"}


def test_cells_are_not_refined_for_films_of_a_rotor_that_comes_to_a_stand():
    scene = scene_of()
    parts = stop(np.geomspace(1.2, 0.04, 12))
    parts["journal"] = stage.film(scene, CASE, parts)
    film = parts["journal"]["N"].to_dataset()
    finer = FILM.finer(scene).journal.at("N")
    hardest = parts["reduction"]["N"].to_dataset().isel(sample=[-1])
    theirs = equilibria(finer, hardest["force"].values, hardest["speed"].values)
    standing = abs(theirs.minimum_film[0] / film["minimum_film"].values[-1] - 1.0)
    assert not film["running"].values[-1]
    found = film_errors(scene, parts)
    assert 0.0 < found["minimum film"] < 0.7 * standing


@pytest.mark.parametrize("way", [1, -1])
def test_of_a_path_the_part_before_or_after_standing_is_compared(way):
    scene = scene_of(motion="transient")
    parts = stop(np.concatenate([np.full(300, 1.2), np.geomspace(1.2, 0.03, 60)])[::way], swing=2e5)
    parts["journal"] = stage.orbit(scene, CASE, parts)
    film = parts["journal"]["N"].to_dataset()
    running = film["running"].values
    films = film["minimum_film"].values
    assert films[~running].min() < films[running].min()
    found = film_errors(scene, parts)
    assert 0.0 < found["minimum film"] < 0.05


def test_a_rotor_that_never_runs_is_compared_all_the_same():
    scene = scene_of()
    parts = stop(np.full(6, 0.05))
    parts["journal"] = stage.film(scene, CASE, parts)
    assert not parts["journal"]["N"]["running"].values.any()
    assert np.isfinite(film_errors(scene, parts)["minimum film"])


def test_films_in_motion_and_at_rest_are_compared_while_the_rotor_runs():
    scene, speeds = scene_of(), np.concatenate([np.full(200, 1.2), np.full(600, 0.003)])
    parts = stop(speeds, swing=1e5)
    parts["journal"] = stage.film(scene, CASE, parts)
    rows = compare(scene, CASE, parts)
    found = {row.quantity: row.value for row in rows if row.against == "the film in motion"}
    assert parts["journal"]["N"]["in_contact"].values.any()
    assert 0.0 < found["minimum film"] < 0.5


def test_what_asperities_carry_at_rest_and_the_mean_friction_are_the_answers_of_a_start():
    rows = {
        "in_contact": [1, 1, 1, 0, 0, 0],
        "running": [0, 0, 1, 1, 1, 1],
        "minimum_film": [1e-6, 1e-6, 3e-6, 4e-6, 1e-4, 1e-4],
        "eccentricity_ratio": [1.001, 1.001, 0.99, 0.98, 0.6, 0.6],
        "maximum_pressure": [9e6, 9e6, 1e6, 2e6, 3e6, 3e6],
        "friction_power": [5.0, 5.0, 10.0, 10.0, 40.0, 40.0],
    }
    film = xr.Dataset({name: ("sample", np.array(row)) for name, row in rows.items()})
    stretch = slice(2, 4)
    ours = extremes_of_orbit(film.isel(sample=stretch))
    theirs = {
        "minimum_film": 4e-6,
        "eccentricity_ratio": 0.98,
        "maximum_pressure": 2.5e6,
        "friction_power": 12.0,
    }
    found = answers_of_path(film, stretch, ours, theirs)
    # surfaces that rest on each other are nearer than those that lift off, whatever their cells
    assert found["minimum_film"] == ours["minimum_film"]
    assert found["eccentricity_ratio"] == ours["eccentricity_ratio"]
    # a fifth more of 20 of 100 W s
    assert found["friction_power"] / ours["friction_power"] == pytest.approx(1.04)
    smooth = answers_of_path(film.assign(in_contact=0 * film["in_contact"]), stretch, ours, theirs)
    assert smooth["minimum_film"] == theirs["minimum_film"]
    assert smooth["maximum_pressure"] == theirs["maximum_pressure"]
