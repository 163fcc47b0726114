"""Joining, selecting, iterating and resampling cases."""

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from loadflow.cube import (
    VARIABLES,
    case_name,
    iter_cases,
    make_case,
    make_cube,
    regular_time,
    resample,
    select,
)
from loadflow.errors import InputError


def case(wind_speed=12.0, seed=1, dlc="1.1", n=200, dt=0.025, **varied):
    rng = np.random.default_rng(seed)
    time = dt * np.arange(n)
    data = {
        "speed": rng.normal(1.2, 0.1, n).astype("f4"),
        "azimuth": np.mod(1.2 * time, 2 * np.pi),
        "hub_force": rng.normal(size=(3, n)),
    }
    return make_case(time, data, dlc=dlc, wind_speed=wind_speed, seed=seed, **varied)


def test_a_vector_that_lies_the_other_way_round_is_told_its_shape():
    with pytest.raises(InputError, match=r"hub_force: must have the shape \(3, 5\), got \(5, 3\)"):
        make_case(
            np.arange(5.0), {"hub_force": np.zeros((5, 3))}, dlc="1.1", wind_speed=8.0, seed=1
        )


def test_equal_cases_become_one_dataset_of_the_schema():
    cube = make_cube([case(4, 1), case(4, 2), case(6, 1)])
    assert isinstance(cube, xr.Dataset)
    for name, array in cube.data_vars.items():
        assert array.dims == VARIABLES[name].dims
        assert array.attrs == VARIABLES[name].attrs
    assert cube.case.values.tolist() == ["dlc1.1_v4_s1", "dlc1.1_v4_s2", "dlc1.1_v6_s1"]
    for coord in ("dlc", "wind_speed", "seed", "weight"):
        assert cube[coord].dims == ("case",)
    np.testing.assert_allclose(cube.weight, 1 / 3)


def test_values_and_types_of_each_case_survive():
    cases = [case(4, 1), case(4, 2), case(6, 1)]
    for original, (_, out) in zip(cases, iter_cases(make_cube(cases))):
        for name in original.data_vars:
            assert out[name].dtype == original[name].dtype
            np.testing.assert_array_equal(out[name], original[name])


def test_bearing_loads_are_stored_bearing_first():
    first = case()
    extra = {"force": (("time", "bearing", "axis"), np.zeros((200, 2, 3)), {"units": "N"})}
    first = first.assign(extra).assign_coords(position=("bearing", [1.9, 5.5], {"units": "m"}))
    cube = make_cube([first, first.assign_coords(seed=2)])
    assert cube.force.dims == ("bearing", "axis", "case", "time")
    assert cube.position.dims == ("bearing",)


def test_lengths_and_steps_make_a_tree():
    tree = make_cube([case(n=201), case(seed=2, n=401), case(seed=3, n=201, dt=0.05)])
    assert set(tree.children) == {"t5_dt0.025", "t10_dt0.025", "t10_dt0.05"}
    assert [name for name, _ in iter_cases(tree)] == [f"dlc1.1_v12_s{s}" for s in (1, 2, 3)]


def test_what_else_varied_is_kept_and_may_name_the_case():
    cases = [case(yaw=y).assign_coords(case=f"dlc1.1_v12_s1_yaw{y}") for y in (-8, 8)]
    cube = make_cube(cases)
    assert cube.yaw.values.tolist() == [-8, 8]
    assert cube.case.values.tolist() == ["dlc1.1_v12_s1_yaw-8", "dlc1.1_v12_s1_yaw8"]


def test_cases_that_cannot_be_joined_are_refused():
    with pytest.raises(InputError, match="none was given"):
        make_cube([])
    with pytest.raises(InputError, match=r"'dlc1\.1_v12_s1' is given twice"):
        make_cube([case(), case()])
    with pytest.raises(InputError, match="different variables: azimuth in one"):
        make_cube([case(), case(seed=2).drop_vars("azimuth")])
    with pytest.raises(InputError, match="lacks the coordinate 'seed'"):
        make_cube([case().drop_vars("seed")])
    with pytest.raises(InputError, match="unknown variable 'torque'"):
        make_case([0, 1], {"torque": [0, 1]}, dlc="1.1", wind_speed=12, seed=1)


def test_selection_takes_scalars_and_lists():
    cube = make_cube([case(v, s) for v in (4, 6, 8) for s in (1, 2)])
    assert select(cube, wind_speed=6).sizes["case"] == 2
    assert select(cube, wind_speed=[4, 8], seed=2).case.values.tolist() == [
        "dlc1.1_v4_s2",
        "dlc1.1_v8_s2",
    ]
    assert select(cube, dlc="1.1").sizes["case"] == 6


def test_selection_from_a_tree_keeps_what_is_needed():
    tree = make_cube([case(4), case(6, dlc="3.1", n=400), case(8, seed=2)])
    assert isinstance(select(tree, dlc="3.1"), xr.Dataset)
    assert isinstance(select(tree, seed=1), xr.DataTree)
    with pytest.raises(InputError, match=r"no case matches \{'dlc': '4.1'\}.*'3.1'"):
        select(tree, dlc="4.1")


@given(st.floats(0, 99, allow_subnormal=False), st.integers(0, 10**6))
def test_case_names_tell_cases_apart(wind_speed, seed):
    name = case_name("1.1", wind_speed, seed)
    assert name.startswith("dlc1.1_v")
    assert "/" not in name
    assert name.endswith(f"_s{seed}")


@given(
    st.sampled_from([0.001, 0.005, 0.00625, 0.01, 0.025, 0.03, 0.05, 0.1, 0.5, 1 / 3]),
    st.integers(2, 30_000),
    st.sampled_from([0.0, 10.0, 60.0, 600.0]),
    st.sampled_from([3, 4, 6, None]),
)
def test_stamps_rounded_in_print_give_back_the_regular_grid(dt, n, start, digits):
    if digits is not None and dt < 2 * 10.0**-digits:
        digits = None
    stamps = start + dt * np.arange(n)
    step, time = regular_time(stamps if digits is None else np.round(stamps, digits))
    quantum = 1e-9 if digits is None else 10.0**-digits
    assert abs(step - dt) * (n - 1) <= 2 * quantum
    np.testing.assert_allclose(time, stamps, atol=2 * quantum, rtol=0)


@given(
    st.integers(10, 500),  # 0, 0.03, 0.05 alone might be rounded stamps of 0.025
    st.data(),
    st.sampled_from([0.2, 0.5, -0.3]),
    st.sampled_from([0.01, 0.025, 0.5, 2.0]),
)
def test_a_stamp_out_of_place_is_found(n, data, shift, dt):
    stamps = dt * np.arange(n)
    i = data.draw(st.integers(1, n - 2))
    stamps[i] += shift * dt
    with pytest.raises(InputError, match=f"index {i}|index {i + 1}"):
        regular_time(stamps)


@given(st.sampled_from([0.01, 0.025, 0.05, 0.1, 0.25]), st.floats(-5, 5), st.floats(-5, 5))
def test_resampling_keeps_straight_lines(dt, level, slope):
    time = 0.025 * np.arange(401)
    data = {"speed": level + slope * time}
    line = make_case(time, data, dlc="1.1", wind_speed=12, seed=1)
    out = resample(make_cube([line]), dt)
    np.testing.assert_allclose(out.time, dt * np.arange(round(10 / dt) + 1), atol=1e-12)
    np.testing.assert_allclose(out.speed[0], level + slope * out.time, atol=1e-9)


def test_resampling_does_not_fold_fast_oscillations_down():
    time = 0.025 * np.arange(4001)
    data = {"speed": np.sin(2 * np.pi * 9.9 * time)}  # at 0.1 s it would look like 0.1 Hz
    out = resample(make_cube([make_case(time, data, dlc="1.1", wind_speed=12, seed=1)]), 0.1)
    assert float(np.abs(out.speed).max()) < 0.15


def test_resampling_goes_round_with_the_azimuth():
    out = resample(make_cube([case(n=4001)]), 0.1)
    expected = np.exp(1j * 1.2 * out.time.values)
    np.testing.assert_allclose(np.exp(1j * out.azimuth[0].values), expected, atol=1e-6)


def test_resampling_brings_a_tree_to_one_cube():
    tree = make_cube([case(n=201), case(seed=2, n=401), case(seed=3, n=201, dt=0.05)])
    cube = resample(tree, 0.05, duration=5.0)
    assert isinstance(cube, xr.Dataset)
    assert dict(cube.sizes) == {"case": 3, "time": 101, "axis": 3}
    with pytest.raises(InputError, match=r"'dlc1\.1_v12_s1' lasts 5 s"):
        resample(tree, 0.05, duration=6.0)
    with pytest.raises(InputError, match="must be > 0"):
        resample(tree, 0.0)
    with pytest.raises(InputError, match="longer than the series"):
        resample(tree, 50.0)
