"""Start, stop, faults and standing: what the supervision does, and what the rotor does then."""

import dataclasses

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.readers import read_loads
from loadflow.rotor import RotorOptions, simulate
from loadflow.rotor.control.constants import STATES
from loadflow.turbines import load_turbine
from loadflow.wind import LOAD_CASES

TURBINE = load_turbine("nrel-5mw")
FEATHER = np.pi / 2
QUICK = {"rung": "tables", "run_in": 5.0}


def states(series):
    """Names of the states in their order."""
    number = series["state"].values
    changes = np.concatenate([[0], np.flatnonzero(np.diff(number)) + 1])
    return [STATES[k] for k in number[changes]]


def at(series, name, time):
    return float(series[name].sel(time=time, method="nearest"))


@pytest.mark.openfast
def test_start_up_follows_openfast(openfast_data):
    theirs = read_loads(f"{openfast_data}/nrel5mw_startup_v12.outb").isel(case=0)
    ours = simulate(dlc="3.1", wind_speed=12, event_time=30.0, duration=240.0)
    n = min(ours.sizes["time"], theirs.sizes["time"])
    a, b = ours["speed"].values[:n], theirs["speed"].values[:n]
    turning = b > 0.1  # rad/s; below it idles at feather, where ours stands braked
    assert np.abs(a / b - 1)[turning].max() < 0.05
    assert np.abs(a - b).max() < 0.05 * 1.267
    assert np.abs(ours["pitch"].values[:n] - theirs["pitch"].values[:n]).max() < np.radians(2.0)


@pytest.mark.parametrize("wind_speed", [3.0, 12.0, 25.0])
def test_a_start_runs_up_to_the_operating_point(wind_speed):
    series = simulate(dlc="3.1", wind_speed=wind_speed, event_time=5.0, duration=300, **QUICK)
    assert states(series) == ["park", "start", "run"]
    speed = series["speed"].values
    before = series["time"].values < 4.9
    assert np.all(speed[before] == 0.0)
    assert speed.max() < 1.15 * 1.267
    if wind_speed > 11.4:
        assert speed[-1] == pytest.approx(1.267, rel=0.01)
        power = at(series, "generator_torque", 299.0) * speed[-1] * 97
        assert power == pytest.approx(5.2966e6, rel=0.02)
    fall = np.diff(series["pitch"].values) / 0.025
    assert fall.min() > -np.radians(8.001)


@pytest.mark.parametrize(
    ("event", "path", "rate"),
    [
        ("stop", ["run", "stop", "park"], 4.0),
        ("emergency stop", ["run", "emergency stop", "park"], 8.0),
        ("grid loss", ["run", "fault", "park"], 8.0),
        ("blade stuck", ["run", "fault", "park"], 8.0),
    ],
)
def test_every_stop_ends_at_rest(event, path, rate):
    series = simulate(dlc="4.1", wind_speed=14, event=event, event_time=5.0, duration=90, **QUICK)
    assert states(series) == path
    assert at(series, "speed", 85.0) == 0.0
    assert at(series, "pitch", 85.0) == pytest.approx(FEATHER)
    assert at(series, "generator_torque", 85.0) == 0.0
    rise = np.degrees(np.diff(series["pitch"].values)).max() / 0.025
    assert rise == pytest.approx(rate, rel=0.01)
    azimuth = series["azimuth"].values[-100:]
    assert np.all(azimuth == azimuth[0])
    # at rest the torque on the shaft is that of the air on the blades, no more
    assert abs(series["hub_moment"].sel(axis="x").values[-1]) < 0.5e6


def test_grid_loss_takes_the_torque_at_once_and_the_rotor_speeds_up():
    series = simulate(dlc="4.1", wind_speed=14, event="grid loss", event_time=5.0, duration=20,
                      **QUICK)  # fmt: skip
    torque, time = series["generator_torque"].values, series["time"].values
    assert torque[time < 4.99].min() > 40e3
    assert np.all(torque[time > 5.03] == 0.0)
    assert series["speed"].max() > 1.04 * at(series, "speed", 5.0)


def test_emergency_stop_is_the_quickest_and_normal_stop_the_gentlest():
    def duration(event):
        series = simulate(dlc="4.1", wind_speed=14, event=event, event_time=5.0, duration=90,
                          **QUICK)  # fmt: skip
        return np.count_nonzero(series["speed"].values > 0.05)

    assert duration("emergency stop") < duration("grid loss") < duration("stop")


def test_a_stuck_blade_stays_and_loads_the_shaft():
    stuck = simulate(dlc="2.1", wind_speed=14, seed=1, event_time=5.0, duration=30, **QUICK)
    sound = simulate(dlc="2.1", wind_speed=14, seed=1, event="stop", event_time=5.0, duration=30,
                     **QUICK)  # fmt: skip
    late = stuck["time"] > 5.05
    last = stuck["blade_pitch"].sel(blade=3)[late.values]
    assert float(last.max() - last.min()) == 0.0
    assert at(stuck, "pitch", 29.0) == pytest.approx(FEATHER)
    bending = [float(abs(s["hub_moment"].sel(axis="y")).max()) for s in (stuck, sound)]
    assert bending[0] > 1.5 * bending[1]


def test_runaway_pitch_trips_the_overspeed():
    series = simulate(dlc="2.2", wind_speed=20, seed=1, event_time=5.0, duration=60, **QUICK)
    assert series.attrs["event"] == "pitch runaway"
    assert states(series) == ["run", "fault", "park"]
    trip = np.flatnonzero(series["state"].values == STATES.index("fault"))[0]
    assert series["speed"].values[trip] * 97 == pytest.approx(1.2 * 122.9096, rel=0.01)


def test_stop_in_a_gust_stays_below_overspeed():
    peaks = [
        float(simulate(dlc="4.2", wind_speed=13.4, seed=k, duration=100, **QUICK)["speed"].max())
        for k in (1, 4)
    ]
    assert 1.25 < peaks[0] < peaks[1] < 1.2 * 1.267


def test_a_parked_rotor_stands_still_exactly():
    series = simulate(dlc="6.4", event="parked", wind_speed=15, azimuth=1.0, duration=10, **QUICK)
    assert np.all(series["speed"].values == 0.0)
    assert np.all(series["azimuth"].values == 1.0)
    assert states(series) == ["park"]
    # the torque that the brake holds is that of the wind
    assert np.ptp(series["hub_moment"].sel(axis="x").values) > 0.0


def test_brake_slips_only_beyond_its_torque():
    series = simulate(dlc="6.1", wind_speed=50, seed=2, duration=60, **QUICK)
    torque, speed = series["hub_moment"].sel(axis="x").values, series["speed"].values
    capacity = 28116.2 * 97
    at_rest = (speed[:-1] == 0.0) & (speed[1:] == 0.0)
    assert np.abs(torque[:-1][at_rest]).max() <= capacity
    weak = dataclasses.replace(
        TURBINE, drivetrain=dataclasses.replace(TURBINE.drivetrain, brake_torque=2000.0)
    )
    slipping = simulate(weak, dlc="6.1", wind_speed=50, seed=2, duration=60, **QUICK)
    assert np.abs(slipping["speed"].values).max() > np.abs(speed).max()


def test_an_idling_rotor_turns_slowly_without_torque():
    series = simulate(dlc="6.4", wind_speed=8, duration=20, **QUICK)
    assert states(series) == ["idle"]
    assert 0.02 < float(series["speed"].mean()) < 0.2
    assert np.all(series["generator_torque"].values == 0.0)
    assert np.all(series["pitch"].values == np.radians(70.0))


def test_parked_with_a_stuck_blade_bends_the_shaft():
    sound = simulate(dlc="7.1", wind_speed=40, event="parked", duration=20, **QUICK)
    faulty = simulate(dlc="7.1", wind_speed=40, duration=20, **QUICK)
    assert float(faulty["blade_pitch"].sel(blade=3).max()) == 0.0
    moments = [float(abs(s["hub_moment"].sel(axis="y")).max()) for s in (sound, faulty)]
    assert moments[1] > 2 * moments[0]


def test_steady_extreme_wind_is_steady_and_mirrored():
    left, right = (
        simulate(dlc="6.1", wind_speed=70, seed=k, steady=True, duration=5, **QUICK) for k in (1, 2)
    )
    assert np.ptp(left["wind"].sel(axis="x").values) == 0.0
    y = [float(s["wind"].sel(axis="y")[0]) for s in (left, right)]
    assert y == pytest.approx([-70 * np.sin(np.radians(15)), 70 * np.sin(np.radians(15))])


@pytest.mark.parametrize("yaw_error", [0.0, np.pi / 2, np.pi, -np.pi / 2])
@pytest.mark.parametrize("event", ["parked", "idling"])
def test_wind_from_all_round_is_finite(yaw_error, event):
    series = simulate(dlc="6.2", wind_speed=50, event=event, yaw_error=yaw_error, duration=20,
                      **QUICK)  # fmt: skip
    assert np.isfinite(series["hub_moment"].values).all()
    along = float(series["wind"].sel(axis="x").mean())
    assert along == pytest.approx(50 * np.cos(yaw_error), abs=6.0)


def test_direction_change_by_180_degrees_and_none_at_all():
    # below 4 m/s the coherent gust turns the wind round
    series = simulate(dlc="1.4", wind_speed=3.5, duration=60, **QUICK)
    wind = series["wind"].values
    assert np.isfinite(series["hub_moment"].values).all()
    assert wind[0, -1] == pytest.approx(-18.5, rel=1e-6)
    assert abs(wind[1, -1]) < 1e-6
    calm = simulate(dlc="1.4", wind_speed=3.5, event="none", shear=0.0, yaw_error=0.0, duration=20,
                    **QUICK)  # fmt: skip
    assert np.isfinite(calm["hub_force"].values).all()


def test_gust_meets_blade_1_where_it_is_told():
    for azimuth, wind in ((0.0, 14.0), (2.0, 11.4), (1.0, 25.0)):
        series = simulate(dlc="1.5", wind_speed=wind, azimuth=azimuth, duration=60, dt=0.025)
        # the gust begins in the middle of a short series; the rotor turns 0.03 rad in a step
        off = at(series, "azimuth", 30.0) - azimuth
        assert abs((off + np.pi) % (2 * np.pi) - np.pi) < 0.03


def test_signs_of_the_extreme_shear_show_in_the_moments():
    peak = {}
    for k in (1, 2, 3, 4):
        series = simulate(dlc="1.5", wind_speed=14, seed=k, duration=60, **QUICK)
        peak[k] = series["hub_moment"].sel(time=slice(34, 38)).mean("time").values
    assert peak[1][1] > 2e6 > -0.5e6 > peak[2][1]  # more wind above tilts the rotor back
    # more wind on the left (+y) turns it to the right (−z)
    assert peak[3][2] < -1e6 < 1e6 < peak[4][2]


def test_individual_pitch_takes_the_mean_moments_away():
    plain = simulate(wind_speed=18, duration=120, rung="tables", run_in=60)
    own = simulate(
        wind_speed=18, duration=120, rung="tables", run_in=60,
        options=RotorOptions(individual_pitch=True),
    )  # fmt: skip
    for axis in ("y", "z"):
        assert abs(float(own["hub_moment"].sel(axis=axis).mean())) < 0.1e6
    assert float(plain["hub_moment"].sel(axis="y").mean()) > 1e6
    assert float(own["speed"].mean()) == pytest.approx(float(plain["speed"].mean()), rel=1e-3)
    spread = own["blade_pitch"] - own["blade_pitch"].mean("blade")
    assert np.radians(0.5) < float(abs(spread).max()) < np.radians(5.1)
    assert float(np.ptp(plain["blade_pitch"].values, axis=0).max()) == 0.0


def test_individual_pitch_needs_a_gain():
    control = dataclasses.replace(TURBINE.control, individual_gain=0.0)
    with pytest.raises(InputError, match=r"individual_pitch = True: NREL 5 MW has no control"):
        simulate(
            dataclasses.replace(TURBINE, control=control),
            wind_speed=18,
            options=RotorOptions(individual_pitch=True),
        )


@pytest.mark.parametrize("dlc", LOAD_CASES)
def test_every_load_case_simulates(dlc):
    row = LOAD_CASES[dlc]
    wind_speed = {"50-year": 50.0, "1-year": 40.0}.get(row.speeds, 11.4)
    series = simulate(dlc=dlc, wind_speed=wind_speed, duration=12.0, **QUICK)
    assert series.attrs["safety_factor"] == row.safety_factor
    assert series.attrs["event"] in row.events
    for name in ("speed", "hub_force", "hub_moment", "blade_pitch"):
        assert np.isfinite(series[name].values).all()


@pytest.mark.parametrize("dlc", ["6.4", "3.1"])
def test_a_rotor_that_stands_does_not_sway_from_the_start(dlc):
    # the tower of the IEA 15 MW leans by half a metre under the weight on top and sways for minutes
    series = simulate("iea-15mw", dlc=dlc, wind_speed=4.0, duration=20.0)
    fore_aft = series["tower_fore_aft"].values[: round(4.0 / 0.025)]
    assert abs(fore_aft.mean()) > 0.2
    assert np.ptp(fore_aft) < 0.02
