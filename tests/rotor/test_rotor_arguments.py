"""Arguments out of their range are refused by name, before anything runs."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rotor import RotorOptions, simulate, steady_state
from loadflow.shaft import TwoPoint, bearing_loads
from loadflow.wind import (
    Machine,
    WindOptions,
    condition,
    conditions,
    iec,
    read_bladed_box,
    read_bts,
)

MACHINE = Machine(cut_in=3, rated=11.4, cut_out=25, rotor_diameter=126, hub_height=90)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"yaw_error": 8.0}, r"yaw_error = 8\.0 rad .* -3\.1416 … 3\.1416 rad"),
        ({"yaw_error": np.nan}, "yaw_error = nan rad"),
        ({"shear": 5.0}, r"shear_exponent = 5\.0 .* \[0, 1\)"),
        ({"shear": -3.0}, r"shear_exponent = -3\.0"),
        ({"azimuth": np.inf}, "azimuth = inf rad"),
        ({"event_time": np.nan}, "event_time = nan s"),
        ({"duration": -1.0}, r"duration = -1\.0 s"),
        ({"seed": 1.5}, r"index \(seed\) = 1\.5 .* whole number >= 0"),
        ({"seed": -1}, r"index \(seed\) = -1"),
        ({"wind_class": "IV"}, "wind_class = 'IV' is unknown; known: I, II"),
        ({"category": "Z"}, r"category = 'Z' is unknown; known: A\+, A"),
    ],
)
def test_simulate_refuses_by_name(arguments, message):
    with pytest.raises(InputError, match=message):
        simulate(wind_speed=10.0, **arguments)


def test_steady_state_wants_a_wind_speed():
    with pytest.raises(InputError, match="at least one"):
        steady_state("nrel-5mw", [])


@pytest.mark.parametrize("density", [0.0, np.inf, np.nan])
def test_the_air_has_a_density(density):
    with pytest.raises(InputError, match=f"air_density = {density}"):
        RotorOptions(air_density=density)


@pytest.mark.parametrize("index", [-1, 1.0])
def test_realisations_are_whole_numbers(index):
    with pytest.raises(InputError, match="whole number >= 0"):
        condition("1.1", MACHINE, wind_speed=8.0, index=index)


def test_conditions_last():
    with pytest.raises(InputError, match="duration = -1 s"):
        conditions("1.1", MACHINE, duration=-1)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"wind_class": "IV"}, "I-T"),
        ({"category": "Z"}, "A, B, C, S"),
        ({"spectrum": "foo"}, "kaimal, mann"),
        ({"scaling": "all"}, "none, hub, each"),
        ({"lateral": "no"}, "coherent, independent"),
        ({"shear_exponent": np.nan}, r"\[0, 1\)"),
        ({"category": "S", "reference_intensity": 1.5}, r"\(0, 1\)"),
        ({"wind_class": "S", "v_ref": np.inf, "v_ave": 10.0}, "v_ref = inf"),
        ({"spectrum": "mann", "scaling": "each"}, "scaling = 'each'"),
    ],
)
def test_wind_options_name_what_is_known(options, message):
    with pytest.raises(InputError, match=message):
        WindOptions(**options)


def test_no_category_is_no_category():
    with pytest.raises(InputError, match="category None is unknown"):
        iec.ntm_sigma(10, None)


@pytest.mark.parametrize("read", [read_bts, read_bladed_box])
def test_a_missing_box_is_named(tmp_path, read):
    with pytest.raises(InputError, match=r"absent\.wind: cannot read"):
        read(tmp_path / "absent.wind")


def test_time_of_bearing_loads_has_their_length():
    still = np.zeros((3, 4))
    with pytest.raises(InputError, match=r"time: shape must be \(4,\), got \(3,\)"):
        bearing_loads(TwoPoint(), still, still, time=[0.0, 1.0, 2.0])
