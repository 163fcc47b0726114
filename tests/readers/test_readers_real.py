"""Real OpenFAST series of the NREL 5 MW; skipped where they are absent."""

import numpy as np
import pytest
import xarray as xr
from numpy.testing import assert_allclose

from loadflow.cube import check_cube, iter_cases, open_cube, save_cube, select
from loadflow.readers import read_loads, read_openfast

pytestmark = pytest.mark.openfast


@pytest.fixture(scope="module")
def tree(openfast_data):
    return read_loads(f"{openfast_data}/*.outb")


def test_every_length_gets_a_cube_of_its_own_and_nothing_is_refused(tree, openfast_data):
    assert isinstance(tree, xr.DataTree)
    sizes = {name: child.sizes["case"] for name, child in tree.children.items()}
    assert sizes == {"t600_dt0.025": 6, "t240_dt0.025": 1, "t120_dt0.025": 4}
    assert sum(sizes.values()) == len(list(openfast_data.glob("*.outb")))
    check_cube(tree)


def test_names_of_files_tell_the_cases(tree):
    names = {name for name, _ in iter_cases(tree)}
    assert {"dlc1.1_v4_s1", "dlc1.1_v12_s3", "steady_v24_s1", "startup_v12_s1"} <= names
    assert select(tree, dlc="1.1", wind_speed=12).seed.values.tolist() == [1, 2, 3]


def test_start_stamps_are_kept(tree):
    assert select(tree, dlc="1.1").file_start.values.tolist() == [60.0] * 6


def test_weight_thrust_and_rated_state_are_those_of_the_turbine(tree):
    steady = (
        select(tree, dlc="steady", wind_speed=12)
        .isel(case=0)
        .sel(time=slice(90, None))
        .mean("time")
    )
    assert_allclose(steady.speed, 12.1 * np.pi / 30, rtol=0.01)
    weight = 109_390 * 9.80665  # blades and hub
    assert_allclose(steady.hub_force.sel(axis="z"), -weight * np.cos(np.radians(5)), rtol=0.02)
    power = steady.speed * steady.hub_moment.sel(axis="x")
    assert_allclose(power, 5.3e6, rtol=0.02)  # 5 MW of electric power at 94.4 % efficiency


def test_speed_is_the_slope_of_the_azimuth(tree):
    """Same direction: blade 1 up turns about +x."""
    case = select(tree, dlc="1.1", wind_speed=8).isel(case=0)
    slope = np.diff(np.unwrap(case.azimuth.values.astype(float))) / 0.025
    assert_allclose(slope.mean(), case.speed.mean(), rtol=1e-3)


def test_moments_at_the_apex_follow_from_those_at_the_gauge(openfast_data):
    path = openfast_data / "nrel5mw_dlc11_v12_s1.outb"
    tip = read_openfast(path).hub_moment
    gauge = {"hub_moment_y": "LSSGagMys", "hub_moment_z": "LSSGagMzs"}
    moved = read_openfast(path, channels=gauge)
    force = moved.hub_force
    my = moved.hub_moment.sel(axis="y") - 1.912 * force.sel(axis="z")
    mz = moved.hub_moment.sel(axis="z") + 1.912 * force.sel(axis="y")
    atol = 3e-4 * float(np.abs(tip).max())  # 16 bits per channel
    assert_allclose(my, tip.sel(axis="y"), atol=atol)
    assert_allclose(mz, tip.sel(axis="z"), atol=atol)


def test_saved_and_opened_it_is_the_same(tree, tmp_path):
    save_cube(tree, tmp_path / "loads.h5")
    xr.testing.assert_identical(open_cube(tmp_path / "loads.h5").load(), tree)
