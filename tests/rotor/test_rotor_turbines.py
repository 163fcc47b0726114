"""The other turbines: operating points follow from their files, prebend and fine pitch count."""

import dataclasses

import numpy as np
import pytest
from numba import typeof

from loadflow.rotor import RotorOptions, simulate, steady_state
from loadflow.rotor.control._kernels import control_torque
from loadflow.rotor.control.constants import STATES, controller
from loadflow.rotor.machine import machine
from loadflow.rotor.tables import with_table
from loadflow.rotor.tuning import tuned
from loadflow.turbines import load_turbine, turbine_names

CALM = RotorOptions(tower_dam=False, skew_factor=0.0)


def test_windpact_turns_at_the_speed_that_its_torque_constant_asks_for():
    point = steady_state("windpact-1.5mw", wind_speed=[7.0, 14.0], shear=0.0)
    speed, power = point["speed"].values, point["power"].values
    # tip speed ratio and power coefficient that a blade of its time is designed for
    assert 6.5 < speed[0] * 35 / 7.0 < 7.5
    assert 0.44 < power[0] / (0.5 * 1.225 * np.pi * 35**2 * 7.0**3) < 0.5
    assert point["pitch"].values[0] == pytest.approx(np.radians(2.6))
    assert power[1] == pytest.approx(1.57895e6, rel=1e-3)
    assert speed[1] * 30 / np.pi == pytest.approx(20.463, rel=1e-3)


def test_the_loop_is_compiled_once_for_all_turbines_and_effects():
    rigid = RotorOptions(modes=(), tower_motion=False, drivetrain_torsion=False, tower_dam=False)
    names = [*turbine_names(), "nrel-5mw@8e6"]
    turbines = [tuned(load_turbine(name)) for name in names]
    kinds = {
        (typeof(with_table(machine(one, options))), typeof(controller(one)))
        for one in turbines
        for options in (RotorOptions(), rigid)
    }
    assert len(kinds) == 1


@pytest.mark.parametrize("name", ["windpact-1.5mw", "iea-15mw"])
def test_a_turbine_runs_in_turbulence_and_stops(name):
    turbine = load_turbine(name)
    series = simulate(name, wind_speed=13.0, duration=40.0, run_in=20.0)
    weight = turbine.rotor_mass * 9.80665 * np.cos(turbine.rotor.tilt)
    assert series["hub_force"].sel(axis="z").mean() == pytest.approx(-weight, rel=0.02)
    reference = turbine.control.reference_speed / turbine.drivetrain.gear_ratio
    assert series["speed"].mean() == pytest.approx(reference, rel=0.08)
    stop = simulate(
        name,
        dlc="5.1",
        wind_speed=turbine.rated_wind_speed,
        duration=60.0,
        event_time=5.0,
        run_in=10.0,
        rung="tables",
    )
    assert float(stop["speed"][-1]) < 0.2 * reference


@pytest.mark.parametrize(("share", "exponent"), [(1.0, -1.0), (0.0, 0.0)])
def test_above_rated_speed_the_power_or_the_torque_is_held(share, exponent):
    turbine = load_turbine("iea-15mw")
    c = controller(turbine)._replace(constant_power=share)
    speeds = c.reference_speed * np.array([1.0, 1.05, 1.1])
    torque = np.array([control_torque(c, speed, 0.2) for speed in speeds])
    assert torque == pytest.approx(torque[0] * (speeds / speeds[0]) ** exponent)
    assert torque[0] * speeds[0] == pytest.approx(c.rated_power)
    # the line of region 2½ ends on it
    below = control_torque(c, c.rated_speed * (1 - 1e-9), 0.0)
    assert below == pytest.approx(control_torque(c, c.rated_speed, 0.0), rel=1e-6)


def test_turbulence_at_high_wind_does_not_trip_the_iea_15mw():
    series = simulate("iea-15mw", wind_speed=24.0, seed=1, duration=300.0, rung="tables")
    assert (series["state"] == STATES.index("run")).all()


@pytest.mark.parametrize("name", ["windpact-1.5mw", "iea-15mw"])
@pytest.mark.parametrize("wind_speed", [8.0, 20.0])
def test_a_turbine_on_its_tower_starts(name, wind_speed):
    # an integrator slower than the ramp once took over at 84° and the generator drove the rotor
    turbine = load_turbine(name)
    start = simulate(
        name, dlc="3.1", wind_speed=wind_speed, duration=150.0, run_in=5.0, event_time=5.0
    )
    reference = turbine.control.reference_speed / turbine.drivetrain.gear_ratio
    speed = start["speed"].values
    assert speed.min() > -0.02 * reference
    assert 0.7 * reference < speed[-1] < 1.05 * reference
    assert speed.max() < turbine.supervision.overspeed * reference
    assert int(start["state"][-1]) == STATES.index("run")


@pytest.mark.parametrize("name", ["windpact-1.5mw", "iea-15mw"])
@pytest.mark.parametrize("dlc", ["6.1", "6.4"])
def test_a_turbine_that_stands_stays_put_on_its_tower(name, dlc):
    turbine = load_turbine(name)
    wind = 50.0 if dlc == "6.1" else 10.0
    idle = simulate(name, dlc=dlc, wind_speed=wind, duration=60.0, rung="tower")
    reference = turbine.control.reference_speed / turbine.drivetrain.gear_ratio
    assert np.abs(idle["speed"]).max() < 0.25 * reference
    assert np.abs(idle["tower_fore_aft"]).max() < 0.02 * turbine.tower.height


def test_prebend_moves_the_blades_upwind_as_a_cone_does():
    # a straight bow is a cone about the root: same loads but for the hub radius and cosines
    turbine = load_turbine("nrel-5mw")
    angle = np.radians(1.0)
    bow = np.tan(angle) * (turbine.blade.radius - turbine.rotor.hub_radius)
    bent = dataclasses.replace(turbine, blade=dataclasses.replace(turbine.blade, prebend=bow))
    coned = dataclasses.replace(
        turbine, rotor=dataclasses.replace(turbine.rotor, cone=turbine.rotor.cone + angle)
    )
    plain, a, b = (
        steady_state(t, wind_speed=14.0, rung="tables", options=CALM).isel(wind_speed=0)
        for t in (turbine, bent, coned)
    )
    change = [
        (float(p["hub_moment"].sel(axis="y") - plain["hub_moment"].sel(axis="y"))) for p in (a, b)
    ]
    assert change[1] < -1e5  # the weight in front tilts the rotor forward
    assert change[0] == pytest.approx(change[1], rel=0.12)


def test_prebent_blades_are_straightened_by_their_own_pull():
    turbine = load_turbine("nrel-5mw")
    x = (turbine.blade.radius - 1.5) / 61.5
    bent = dataclasses.replace(
        turbine, blade=dataclasses.replace(turbine.blade, prebend=3.0 * x**2)
    )
    tips = [
        float(steady_state(t, wind_speed=20.0, options=CALM)["tip_deflection"][0])
        for t in (turbine, bent)
    ]
    assert 0.1 < tips[1] - tips[0] < 3.0


def test_dynamic_inflow_leaves_the_steady_state_and_overshoots_after_a_pitch_step():
    from loadflow.rotor.inflow import steady_inflow
    from loadflow.rotor.loop import run, turning_state
    from loadflow.rotor.rungs import prepare

    turbine, dt = load_turbine("nrel-5mw"), 0.025
    thrust = {}
    for lag in (False, True):
        calm = dataclasses.replace(CALM, dynamic_inflow=lag, shed_wake=False)
        m, c = prepare(turbine, "tables", calm)
        m = m._replace(tilt=0.0, cone=0.0)
        state = turning_state(m, c, 8.0, 0.95, 0.0)
        winds = steady_inflow(8.0, 4800, 0.0)
        before = run(m, c, winds, state, dt, steps=400, controlled=False)
        state.pitch[:] = np.radians(2.0)
        after = run(m, c, winds, state, dt, steps=4800, controlled=False)
        thrust[lag] = before[-1, 3], after[2, 3], after[-1, 3]
    assert thrust[True][0] == pytest.approx(thrust[False][0], rel=1e-6)
    assert thrust[True][2] == pytest.approx(thrust[False][2], rel=1e-4)
    # at first the wake is still that of the higher load: thrust falls below its final value
    step = thrust[False][0] - thrust[False][2]
    assert 1.3 * step < thrust[True][0] - thrust[True][1] < 3 * step
