"""The cubes of data/synthetic are what their command makes, and what they say they are."""

import importlib.util
from pathlib import Path

import numpy as np
import pytest

from loadflow.cube import check_cube, iter_cases, open_cube
from loadflow.reduction import periodic
from loadflow.stages.frames import to_film

FOLDER = Path(__file__).parents[1] / "data" / "synthetic"
FILES = ("table_5_13.h5", "table_5_14.h5", "dlc_1_1.h5", "start_stop.h5")


@pytest.fixture(scope="module")
def maker():
    spec = importlib.util.spec_from_file_location("synthetic_maker", FOLDER / "make.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_command_makes_these_files_and_no_others(maker):
    assert sorted(maker.CUBES) == sorted(FILES) == sorted(p.name for p in FOLDER.glob("*.h5"))


@pytest.mark.parametrize("name", FILES)
def test_made_again_they_are_the_same(maker, name):
    made = dict(iter_cases(maker.CUBES[name]()))
    kept = dict(iter_cases(open_cube(FOLDER / name)))
    assert list(made) == list(kept)
    for case, series in kept.items():
        for variable, data in series.data_vars.items():
            ours, theirs = made[case][variable].values, data.values
            # single precision, and a rotor whose libraries may round otherwise
            scale = np.abs(theirs).max() or 1.0
            if variable == "azimuth":  # wraps around
                ours, theirs, scale = np.unwrap(ours), np.unwrap(theirs), 100.0
            np.testing.assert_allclose(ours, theirs, rtol=0, atol=2e-4 * scale, err_msg=variable)


@pytest.mark.parametrize("name", FILES)
def test_they_are_small_sound_cubes(name):
    assert (FOLDER / name).stat().st_size < 300e3
    check_cube(open_cube(FOLDER / name))


def test_tables_have_the_true_frequencies():
    """1p and 3p are the rotor's, not 1.2 times as much; amplitudes and means are the printed."""
    for name, case in iter_cases(open_cube(FOLDER / "table_5_14.h5")):
        force = case["force"].isel(bearing=0).transpose("time", "axis").values.astype(float)
        speed = case["speed"].values.astype(float)
        found = periodic(speed, to_film(force), case["time"].values, bounds=(0.1, 1.0))
        down = found.harmonics[0]
        assert [h.label for h in down[1:]] == ["1p", "3p"], name
        assert down[1].frequency * 2 * np.pi == pytest.approx(speed[0], rel=2e-3)
        assert 330e3 < down[1].amplitude < 345e3


def test_base_loads_grow_with_the_wind():
    cube = open_cube(FOLDER / "table_5_13.h5")
    weight = -cube["force"].sel(axis="z", bearing="N2").mean("time")
    assert cube["wind_speed"].values.tolist() == [4, 8, 12, 16, 20, 24]
    assert (weight.diff("case") > 0).all()


def test_a_start_begins_and_a_stop_ends_at_rest():
    start, stop = (case["speed"].values for _, case in iter_cases(open_cube(FOLDER / FILES[3])))
    assert start[0] == 0 < start[-1]
    assert stop[0] > 0 == stop[-1]
