"""The best crown for a spectrum of loads and tilts, from the library, a scene and the command."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from synthetic import cube_file

from loadflow.cli import main
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Contour,
    Crown,
    Film,
    GasMixture,
    JournalBearing,
    Lubricant,
    best_crown,
)
from loadflow.scene.scene import read_scene

BEARING = JournalBearing(diameter=0.2, width=0.16, relative_clearance=1e-3)
FILM = Film(Lubricant(0.03), GasMixture(5e4), edge_pressure=1.5e5, grid=(36, 12))
DRAW = np.random.default_rng(1)
LOADS = np.stack([DRAW.uniform(2e3, 2.5e4, 12), DRAW.normal(0, 2e3, 12)], axis=-1)
TILTS = DRAW.normal(0.0, 2.5e-4, (12, 2))


def value(crown, aim, film, tilts=TILTS):
    """Of the worst load, with the sign with which it is to be small."""
    bearing = replace(BEARING, relief=() if crown is None else (crown,))
    state = bearing.equilibrium(LOADS, 100.0, film, tilt=tilts)
    return -state.minimum_film.min() if aim == "minimum_film" else state.maximum_pressure.max()


@pytest.mark.parametrize("aim", ["minimum_film", "maximum_pressure"])
def test_on_a_finer_mesh_the_crown_beats_none_and_its_neighbours(aim):
    best = best_crown(BEARING, LOADS, 100.0, FILM, tilt=TILTS, aim=aim)
    assert best.converged
    fine, crown = replace(FILM, grid=(72, 24)), best.crown
    found = value(crown, aim, fine)
    assert found < value(None, aim, fine) - 0.03 * abs(found)
    for height, length in ((0.6, 1.0), (1.6, 1.0), (1.0, 0.7), (0.6, 0.7), (1.6, 0.7)):
        other = Crown(height * crown.height, min(length * crown.length, 0.08))
        assert found < value(other, aim, fine)
    size = 1.0 if aim == "maximum_pressure" else -1.0
    assert best.value == pytest.approx(size * value(crown, aim, FILM), rel=1e-8)
    assert best.without == pytest.approx(size * value(None, aim, FILM), rel=1e-8)
    assert best.states.minimum_film.shape == (12,)


def test_no_crown_of_a_dense_sweep_is_better():
    best = best_crown(BEARING, LOADS, 100.0, FILM, tilt=TILTS)
    sweep = [
        value(Crown(height, length), "minimum_film", FILM)
        for height in np.linspace(1e-5, 8e-5, 8)
        for length in (0.03, 0.05, 0.08)
    ]
    assert best.value > -min(sweep) * (1.0 - 1e-3)


def test_an_aligned_shaft_wants_no_crown_and_other_relief_stays():
    contour = Contour((0.0, 3.0), (0.0, 1e-6))
    bearing = replace(BEARING, relief=(Crown(3e-5), contour))
    best = best_crown(bearing, LOADS[:3], 100.0, FILM)
    assert best.crown is None
    assert best.bearing.relief == (contour,)
    assert best.value == best.without


def test_a_load_that_governs_only_with_a_crown_is_not_left_out():
    loads = np.array([[6e3, 0.0]] * 6 + [[6e4, 0.0]])  # the last one is aligned, and heavy
    tilts = np.array([[0.0, 5e-4 + 2e-5 * k] for k in range(6)] + [[0.0, 0.0]])
    best = best_crown(BEARING, loads, 100.0, FILM, tilt=tilts)
    films = best.states.minimum_film
    assert best.value == films.min()
    assert films[best.governs] == films.min()


def test_a_tilt_that_touches_without_a_crown_finds_one():
    best = best_crown(BEARING, LOADS[:2], 100.0, FILM, tilt=[(0.0, 1.5e-3), (0.0, 1e-3)])
    assert best.without == 0.0
    assert best.states_without is None
    assert best.value > 5e-6


def test_what_has_no_answer_is_said():
    with pytest.raises(InputError, match="aim"):
        best_crown(BEARING, LOADS, 100.0, FILM, aim="friction")
    with pytest.raises(InputError, match="crown"):
        best_crown(BEARING, LOADS, 100.0, replace(FILM, rung="map"))
    with pytest.raises(SolverError, match="leaves load 0 a film"):
        best_crown(BEARING, LOADS[:1], 100.0, FILM, tilt=[(0.0, 0.02)], largest_height=1e-5)


@pytest.fixture(scope="module")
def scene_file(tmp_path_factory):
    folder = tmp_path_factory.mktemp("crown")
    cube_file(folder / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=120)
    file = folder / "bend.toml"
    file.write_text(
        "name = 'bend'\naccuracy = 'given'\nresults = ['journal.film']\n"
        "[loads]\nfiles = ['loads.h5']\n[shaft.two_point.beam]\n"
        "[bearings.N]\nkind = 'journal'\ntilt = true\ngrid = [24, 8]\n"
        "[bearings.N.geometry]\ndiameter = 1.2\nwidth = 1.2\nrelative_clearance = 1e-3\n"
        "[bearings.N.lubricant]\nviscosity = 0.2\n"
        "[design]\nclasses = 2\n[design.crown]\nlargest_height = 1e-4\n",
        encoding="utf-8",
    )
    return file


def test_a_scene_gets_its_crowns_and_can_be_run_with_them(scene_file, capsys, tmp_path):
    arguments = ["design", str(scene_file), "--out", str(tmp_path), "--workers", "1", "--json"]
    with pytest.raises(SystemExit) as ended:
        main(arguments)
    assert ended.value.code == 0
    told = json.loads(capsys.readouterr().out)
    [one] = told["crowns"]
    assert one["bearing"] == "N"
    assert one["converged"]
    assert one["with"] > one["without"]
    crowned = read_scene(told["scene"])
    [relief] = crowned.journal.geometry.relief
    assert isinstance(relief, Crown)
    assert relief.height == one["height"]
    assert 0.0 < relief.height <= 1e-4
    assert crowned.name == "bend-own-journal-crowned"
    table = json.loads(Path(told["table"]).read_text(encoding="utf-8"))
    assert table == told["crowns"]
