"""Operating points and load cases: control laws, weights, symmetry, repeatability."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rotor import RotorOptions, simulate, steady_state
from loadflow.turbines import load_turbine

WEIGHT = 109390.0 * 9.80665
CALM = RotorOptions(tower_dam=False, skew_factor=0.0)


@pytest.fixture(scope="module")
def points():
    return steady_state("nrel-5mw", wind_speed=[5.0, 9.0, 14.0, 20.0], rung="tables")


@pytest.fixture(scope="module")
def series():
    return simulate(wind_speed=12, seed=1, duration=60.0, run_in=10.0, rung="tables")


def test_operating_points_obey_the_control_law(points):
    generator = points["speed"].values * 97
    torque = points["torque"].values / 97
    share = (generator[0] - 70.16224) / (91.21091 - 70.16224)
    assert torque[0] == pytest.approx(2.332287 * 91.21091**2 * share, rel=1e-3)
    assert torque[1] == pytest.approx(2.332287 * generator[1] ** 2, rel=1e-3)
    assert points["power"].values[2:] == pytest.approx(5.29661e6, rel=1e-3)
    assert generator[2:] == pytest.approx(122.9096, rel=1e-3)
    assert points["pitch"].values[:2] == pytest.approx(0.0, abs=1e-6)
    assert points["pitch"].values[3] > points["pitch"].values[2] > 0.1
    assert points["settled"].all()


def test_control_that_hunts_between_its_regions_has_a_mean_and_says_so():
    # a weakly damped loop of pitch and speed: fine pitch on one side, constant power on the other
    point = steady_state("nrel-5mw", wind_speed=[11.4, 11.75, 12.2])
    assert point["settled"].values.tolist() == [True, False, True]
    assert 0 == point["pitch"][0] < np.radians(1.5) < point["pitch"][1] < np.radians(2.3)
    assert point["power"].values[1] == pytest.approx(5.29661e6, rel=1e-2)
    assert point["thrust"][0] > point["thrust"][1] > point["thrust"][2]
    series = simulate(wind_speed=11.75, duration=1.0, run_in=0.0)
    assert series["speed"].values == pytest.approx(12.1 * np.pi / 30, rel=0.05)


def test_no_skew_no_shear_no_tilt_no_cone_leaves_torque_and_thrust_alone():
    turbine = load_turbine("nrel-5mw")
    import dataclasses

    straight = dataclasses.replace(turbine.rotor, tilt=0.0, cone=0.0)
    point = steady_state(
        dataclasses.replace(turbine, rotor=straight),
        wind_speed=10.0,
        shear=0.0,
        rung="bem",
        options=CALM,
    ).isel(wind_speed=0)
    force, moment = point["hub_force"].values, point["hub_moment"].values
    assert force[1] == pytest.approx(0.0, abs=1.0)
    assert force[2] == pytest.approx(-WEIGHT, rel=1e-5)
    assert np.abs(moment[1:]).max() < 1e-5 * moment[0]


def test_gravity_of_a_coned_rotor_tilts_it_upwind():
    # the blades lean upwind by the cone: their weight has the lever of their centre of mass
    turbine = load_turbine("nrel-5mw")
    low = steady_state(turbine, wind_speed=3.5, shear=0.0, rung="bem", options=CALM)
    lever = (1.5 + 20.52) * np.sin(np.radians(2.5))
    expected = -3 * turbine.blade.mass * 9.80665 * np.cos(np.radians(5)) * lever
    assert low["hub_moment"].values[0, 1] == pytest.approx(expected, rel=0.06)


def test_weight_shows_in_the_mean_forces(series):
    assert series["hub_force"].sel(axis="z").mean() == pytest.approx(-WEIGHT, rel=0.01)
    assert series["hub_force"].dims == ("axis", "time")
    assert series["time"].values[-1] == pytest.approx(60.0 - 0.025)
    for variable in series.data_vars.values():
        assert variable.attrs["units"]
        assert variable.attrs["long_name"]


def test_the_same_seed_gives_the_same_series_to_the_bit(series):
    again = simulate(wind_speed=12, seed=1, duration=60.0, run_in=10.0, rung="tables")
    other = simulate(wind_speed=12, seed=2, duration=60.0, run_in=10.0, rung="tables")
    assert np.array_equal(series["hub_moment"].values, again["hub_moment"].values)
    assert not np.array_equal(series["hub_moment"].values, other["hub_moment"].values)


def test_turbulence_gives_3p_and_imbalance_gives_1p_in_the_fixed_frame(series):
    from scipy.signal import welch

    def peak(data, times):
        """Height of the spectrum at a multiple of the mean speed over its surroundings."""
        tilt = data["hub_moment"].sel(axis="y").values
        f, power = welch(tilt, 40.0, nperseg=1024)
        centre = times * float(data["speed"].mean()) / (2 * np.pi)
        near = np.abs(f - centre) < 0.06
        around = (np.abs(f - centre) > 0.12) & (np.abs(f - centre) < 0.3) & (f > 0.1)
        return power[near].max() / power[around].mean()

    assert peak(series, 3) > 5
    uneven = simulate(
        wind_speed=12,
        duration=60.0,
        run_in=10.0,
        rung="tables",
        options=RotorOptions(pitch_imbalance=0.02),
    )
    assert peak(uneven, 1) > 3 * peak(series, 1)


def test_cheap_rung_follows_the_solved_one(series):
    solved = simulate(wind_speed=12, seed=1, duration=60.0, run_in=10.0, rung="bem")
    for axis in ("y", "z"):
        difference = (series["hub_moment"] - solved["hub_moment"]).sel(axis=axis).std()
        assert difference < 0.02 * solved["hub_moment"].sel(axis=axis).std()


def test_bending_blades_stay_bounded_and_near_the_published_deflection():
    point = steady_state("nrel-5mw", wind_speed=8.0).isel(wind_speed=0)
    assert 2.5 < float(point["tip_deflection"]) < 3.5


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"wind_speed": 40.0}, "wind_speed = 40.0"),
        ({"dlc": "8.1"}, "load case '8.1' is unknown"),
        ({"dlc": "1.4", "seed": 3}, "index = 3: load case 1.4 has no turbulence and 2 variants"),
        ({"dlc": "1.1", "steady": True}, "load case 1.1 has no steady extreme wind"),
        ({"event": "earthquake"}, "event: must be one of none, .* got 'earthquake'"),
        ({"dlc": "6.1", "wind_speed": 101.0}, "wind_speed = 101.0"),
        ({"rung": "cfd"}, "rung = 'cfd'"),
        ({"turbine": "nrel-6mw"}, "unknown turbine"),
        ({"dt": 1.0}, "dt = 1.0"),
        ({"duration": -1.0}, "duration = -1.0"),
    ],
)
def test_bad_arguments_are_named(change, message):
    arguments = {"turbine": "nrel-5mw", "wind_speed": 12.0, "rung": "tables"} | change
    turbine = arguments.pop("turbine")
    with pytest.raises(InputError, match=message):
        simulate(turbine, **arguments)


def test_bad_options_are_named():
    with pytest.raises(InputError, match="air_density = 0"):
        RotorOptions(air_density=0.0)
