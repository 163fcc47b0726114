"""Unsound cubes are refused with file, case, variable and index."""

import numpy as np
import pytest

from loadflow.cube import check_cube, make_case, make_cube
from loadflow.errors import InputError

N = 50


def cube():
    time = 0.025 * np.arange(N)
    return make_cube(
        [
            make_case(
                time,
                {"speed": np.ones(N), "hub_force": np.ones((3, N))},
                dlc="1.1",
                wind_speed=4,
                seed=seed,
            )
            for seed in (1, 2)
        ]
    )


def test_sound_cube_passes():
    check_cube(cube(), "loads.h5")


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_value_that_is_not_finite_is_located(bad):
    broken = cube()
    broken.hub_force[1, 1, 7] = bad
    message = r"loads\.h5, case 'dlc1\.1_v4_s2', variable 'hub_force', index \(axis y, time 7\)"
    with pytest.raises(InputError, match=message):
        check_cube(broken, "loads.h5")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda t: np.r_[t[:9], t[8], t[10:]], "index 9: value 0.2 does not rise"),
        (lambda t: np.r_[t[:9], np.nan, t[10:]], "index 9: value nan is not finite"),
        (lambda t: np.r_[t[:9], t[9] + 0.01, t[10:]], "index 9: steps are not equal"),
        (lambda t: np.r_[t[:9], t[9:] + 0.5], "index 9: steps are not equal"),
        (lambda t: t[::-1], "index 1: value 1.2 does not rise"),
        (lambda t: t + 60.0, "time starts at 60 s instead of 0"),
    ],
)
def test_unsound_time_is_located(change, message):
    whole = cube()
    broken = whole.assign_coords(time=change(whole.time.values))
    with pytest.raises(InputError, match=rf"loads\.h5, case 'dlc1\.1_v4_s1'.*{message}"):
        check_cube(broken, "loads.h5")


def test_units_must_be_there_and_right():
    broken = cube()
    broken.speed.attrs["units"] = "rpm"
    with pytest.raises(InputError, match="variable 'speed': units are 'rpm', must be 'rad/s'"):
        check_cube(broken)
    del broken.speed.attrs["units"]
    with pytest.raises(InputError, match="variable 'speed': attribute 'units' is missing"):
        check_cube(broken)
    with pytest.raises(InputError, match="variable 'extra': attribute 'units' is missing"):
        check_cube(cube().assign(extra=("time", np.ones(N))))


def test_dimensions_must_be_those_of_the_schema():
    broken = cube()
    broken["hub_force"] = broken.hub_force.isel(axis=0, drop=True).assign_attrs(units="N")
    with pytest.raises(InputError, match="'hub_force': dimensions are"):
        check_cube(broken)


def test_cases_without_names_are_refused():
    """As `expand_dims` leaves a case: with the dimension, and without its coordinate."""
    bare = cube().drop_vars("case")
    with pytest.raises(InputError, match=r"loads\.h5: coordinate 'case', .* is missing"):
        check_cube(bare, "loads.h5")


def test_empty_cubes_are_refused():
    with pytest.raises(InputError, match=r"loads\.h5: the cube is empty"):
        check_cube(cube().isel(case=slice(0)), "loads.h5")
    with pytest.raises(InputError, match="needs two time steps or more, this one has 0"):
        check_cube(cube().isel(time=slice(0)))
    with pytest.raises(InputError, match="holds no variable"):
        check_cube(cube().drop_vars(["speed", "hub_force"]))


@pytest.mark.parametrize("weight", [-0.1, np.nan, np.inf])
def test_weight_must_be_a_share(weight):
    with pytest.raises(InputError, match=r"weight = .* must be finite"):
        check_cube(cube().assign_coords(weight=("case", [0.5, weight])))


def test_case_may_be_there_only_once():
    twice = cube().assign_coords(case=["a", "a"])
    with pytest.raises(InputError, match="case 'a': the cube holds this case twice"):
        check_cube(twice)
