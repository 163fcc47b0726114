"""Series that can be read and yet mean something else are doubted with numbers."""

import numpy as np
import pytest

from loadflow.cube import check_cube, make_case, make_cube, standing, standing_share
from loadflow.readers.doubts import GRAVITY, find_doubts, power_doubts, with_doubts
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")
RATED = TURBINE.control.reference_speed / TURBINE.drivetrain.gear_ratio
WEIGHT = TURBINE.rotor_mass * GRAVITY * np.cos(TURBINE.rotor.tilt)


def series(speed=RATED, fy=0.0, fz=-WEIGHT, torque=4e6, wind=12.0, step=0.05, n=2000):
    """A rotor that turns evenly under its weight."""
    one = np.ones(n)
    data = {
        "speed": speed * one,
        "wind": wind * one,
        "hub_force": np.stack([6e5 * one, fy * one, fz * one]),
        "hub_moment": np.stack([torque * one, 5e5 * one, 0 * one]),
    }
    return make_case(step * np.arange(n), data, dlc="1.1", wind_speed=12, seed=1)


def test_sound_series_are_not_doubted():
    assert find_doubts(series(), TURBINE) == []
    assert find_doubts(series(fz=-1.09 * WEIGHT, wind=13.9), TURBINE) == []


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"fz": -1.2 * WEIGHT}, ["hub_force z is -1282 kN", "weighs 1069 kN across the shaft"]),
        ({"fz": -WEIGHT / 1e3}, ["a factor of 0.001, as between N and kN: is the unit right?"]),
        ({"fz": WEIGHT}, ["the weight acts along +z (mean 1069 kN) instead of -z"]),
        ({"fy": WEIGHT, "fz": 0.0}, ["the weight acts along +y"]),
        ({"torque": -4e6}, ["torque × speed is -5", "the sign of one is turned"]),
        ({"torque": 8e6}, ["torque × speed is 1", "is rated at 5297 kW"]),
        ({"torque": 4e9}, ["5297 kW of the rotor (a factor of 957, as between N and kN"]),
        ({"speed": 12.67, "step": 0.01, "torque": 4e5}, ["up to 12.67 rad/s", "rad/s and 1/min"]),
        ({"speed": -RATED, "torque": -4e6}, ["the mean rotor speed is -1.267 rad/s"]),
        ({"step": 0.5, "n": 400}, ["the step of 0.5 s gives 3.3 samples in a blade passage"]),
        ({"wind": 8.0}, ["the mean wind is 8 m/s, the load case is at 12 m/s"]),
    ],
)
def test_what_does_not_fit_is_told_with_both_numbers(changed, said):
    told = "\n".join(find_doubts(series(**changed), TURBINE))
    for part in said:
        assert part in told


def test_torque_and_speed_are_compared_with_the_power_in_the_file():
    found = {"hub_moment_x": np.full(9, 4e6), "speed": np.full(9, 1.25)}
    assert power_doubts(found) == []
    assert power_doubts(found | {"rotor_power": np.full(9, 5.2e6)}) == []
    [told] = power_doubts(found | {"rotor_power": np.full(9, 5e3)})
    assert "5000 kW in the mean, the power of the file 5 kW (a factor of 1e+03, as" in told


def test_doubts_are_kept_once_and_go_into_the_cube():
    doubtful = with_doubts(with_doubts(series(wind=8.0), "nrel-5mw"), "nrel-5mw")
    assert str(doubtful["doubts"].item()).count("\n") == 0
    cube = make_cube([doubtful])
    check_cube(cube)
    assert "8 m/s" in str(cube["doubts"].values[0])
    simulated = with_doubts(series(wind=8.0), "nrel-5mw", simulated=True)
    assert str(simulated["doubts"].item()) == ""


def test_standing_and_idling_are_recognised():
    stop = series()
    speed = np.where(np.arange(2000) < 1100, RATED, -0.05 * np.pi / 30)
    stop = stop.assign(speed=stop["speed"].copy(data=speed))
    stands = standing(stop, RATED)
    assert int(stands.sum()) == 900
    assert float(standing_share(stop, RATED)) == pytest.approx(0.45)
    assert float(with_doubts(stop, "nrel-5mw")["standing_share"]) == pytest.approx(0.45)
    assert float(stop["speed"].where(~stands).mean()) == pytest.approx(RATED)
    assert float(standing_share(stop)) == pytest.approx(0.45)  # without a rated speed
    assert float(standing_share(series(speed=0.19))) == 0.0  # the slowest of large turbines
