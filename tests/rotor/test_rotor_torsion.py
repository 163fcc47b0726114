"""Blades that twist, and control gains that follow from the rotor, beside published steady states.

The published figures are those of the HAWC2 models in the turbines' repositories, IEA-15-240-RWT
(IEA_15MW_RWT_Onshore.opt) and IEA-22-280-RWT (iea-22-280-rwt-steady-states-hawc2.yaml), which bend
and twist; ours add the weight of the rotor along the tilted shaft, taken off here.
"""

import importlib.resources
from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rotor import RotorOptions, steady_state
from loadflow.rotor.machine import GRAVITY, machine
from loadflow.rotor.room import room_for
from loadflow.rotor.rungs import prepare
from loadflow.rotor.steady import operating_point
from loadflow.rotor.structure._kernels import torsion
from loadflow.rotor.tuning import _Rotor, tuned
from loadflow.turbines import load_turbine

PUBLISHED = {  # wind m/s: speed 1/min, pitch deg, power W, thrust N
    "IEA-15-240-RWT.yaml": {
        9.0: (6.390847, 0.000535, 9.593e6, 1.5906e6),
        10.0: (7.101976, 0.000535, 12.881e6, 1.8987e6),
        11.0: (7.559987, 1.170321, 15.664e6, 1.9863e6),
        15.0: (7.559987, 9.190, 15.667e6, 1.269e6),
    },
    "IEA-22-280-RWT.yaml": {
        9.0: (5.539863, -1.326795, 13.976e6, 2.5110e6),
        12.0: (7.061100, 5.094706, 23.122e6, 2.4765e6),
        15.0: (7.061100, 10.537309, 23.125e6, 1.8301e6),
        20.0: (7.061100, 16.704, 23.134e6, 1.374e6),
    },
}


@pytest.fixture(scope="module")
def examples():
    pytest.importorskip("windIO")
    return importlib.resources.files("windIO") / "examples" / "turbine"


@pytest.mark.parametrize("file", PUBLISHED)
def test_steady_states_are_the_published_ones_of_blades_that_twist(examples, file):
    turbine, wanted = load_turbine(str(examples / file)), PUBLISHED[file]
    found = steady_state(
        turbine,
        wind_speed=list(wanted),
        shear=0.0,
        rung="flap",
        options=RotorOptions(tower_dam=False),
    )
    weight = turbine.rotor_mass * GRAVITY * np.sin(turbine.rotor.tilt)
    speed, pitch, power, thrust = np.array(list(wanted.values())).T
    assert found["speed"].values == pytest.approx(np.pi / 30 * speed, rel=0.015)
    assert found["pitch"].values == pytest.approx(np.radians(pitch), abs=np.radians(0.35))
    assert found["power"].values == pytest.approx(power, rel=0.04)
    assert found["thrust"].values - weight == pytest.approx(thrust, rel=0.035)


def test_without_torsion_the_thrust_below_rated_is_far_too_large(examples):
    turbine = load_turbine(str(examples / "IEA-15-240-RWT.yaml"))
    rigid = RotorOptions(tower_dam=False, blade_torsion=False)
    found = steady_state(turbine, wind_speed=10.0, shear=0.0, rung="flap", options=rigid)
    weight = turbine.rotor_mass * GRAVITY * np.sin(turbine.rotor.tilt)
    assert 1.1 < (found["thrust"].item() - weight) / 1.8987e6 < 1.2


def test_the_turn_of_the_tip_is_the_published_one(examples):
    turbine = load_turbine(str(examples / "IEA-22-280-RWT.yaml"))
    m, c = prepare(turbine, "flap", RotorOptions(tower_dam=False))
    _, state, _ = operating_point(m, c, 15.0, 0.0)
    share = (m.radius - m.hub_radius) / (m.tip_radius - m.hub_radius)
    turned = np.degrees(state.torsion[0])
    # blade_rotation_deflection_z_pitching, nose-down positive here
    assert np.interp(0.675, share, turned) == pytest.approx(2.38, rel=0.12)
    assert np.interp(0.975, share, turned) == pytest.approx(4.76, rel=0.12)


def test_a_couple_at_the_tip_twists_a_uniform_blade_by_the_closed_form():
    # θ = M L/(G J) at the tip, linear from the root
    turbine = load_turbine("nrel-5mw")
    blade = turbine.blade
    rigidity = np.full(2, 5e7)
    twisting = replace(
        blade,
        torsion_span=np.array([0.0, blade.span[-1]]),
        torsion_stiffness=rigidity,
        centre_ahead=np.zeros(2),
    )
    m = machine(replace(turbine, blade=twisting), RotorOptions())
    m = m._replace(mass=np.zeros_like(m.mass), cone=0.0)
    n, turned, room = m.radius.size, np.zeros(m.radius.size), room_for(m)
    force, motion = np.zeros((n, 4)), np.zeros((n, 7))
    force[-1, 3] = 1e5  # nose up at the last section
    torsion(m, 0, 0.0, 1.0, 0.0, np.zeros(6), np.zeros(3), force, motion, turned, room)
    length = m.radius - m.hub_radius
    # the last section has half of its own couple
    assert turned[:-1] == pytest.approx(-1e5 * length[:-1] / 5e7, rel=1e-9)
    force[-1] = 0.0
    force[-1, 0] = 1e4  # downwind, on a blade bent ahead in the sense of rotation: nose up
    motion[:, 1] = 2.0 * (length / length[-1]) ** 2
    torsion(m, 0, 0.0, 1.0, 0.0, np.zeros(6), np.zeros(3), force, motion, turned, room)
    assert turned[-1] < 0  # the bent blade carries the force ahead of the axis of the inner part
    # closed form: the force times its distance ahead of the tangent of each section
    ahead = 2.0 * (1 - length / length[-1]) ** 2
    torque = -1e4 * ahead[:-1]
    expected = np.cumsum(torque * np.gradient(length)[:-1]) / 5e7
    assert turned[-2] == pytest.approx(expected[-1], rel=0.1)


def test_a_blade_without_its_torsion_carries_nothing_of_it():
    m = machine(load_turbine("nrel-5mw"), RotorOptions())
    assert m.torsion_compliance.size == 0


def test_gains_that_follow_from_the_rotor_do_what_they_are_to_do():
    # at constant speed the power of rigid blades at 18 m/s falls by dP/dθ; with it the gains must
    # give the frequency and the damping that were asked for, Jonkman et al. 2009, (7-7) … (7-17)
    known = load_turbine("nrel-5mw")
    control = replace(
        known.control,
        region_2_gain=None,
        optimal_tip_speed_ratio=7.55,
        proportional_gain=None,
        integral_gain=None,
        gain_halving_pitch=None,
        pitch_frequency=0.6,
        pitch_damping=0.7,
    )
    found = tuned(replace(known, control=control))
    law, gear = found.control, known.drivetrain.gear_ratio
    assert law.is_tuned
    assert law.region_2_gain == pytest.approx(known.control.region_2_gain, rel=0.06)
    speed = known.control.reference_speed / gear
    inertia = 38.677e6 + 534.116 * gear**2  # printed, kg m²
    points = steady_state(known, [17.9, 18.1], shear=0.0, rung="tables")
    pitch = float(points["pitch"].mean())
    rotor = _Rotor(known)
    torques = [rotor.loads(18.0, speed, pitch + step)[0] for step in (-0.01, 0.01)]
    slope = -speed * (torques[1] - torques[0]) / 0.02
    scheduled = 1 / (1 + pitch / law.gain_halving_pitch)
    frequency = np.sqrt(law.integral_gain * scheduled * gear * slope / (inertia * speed))
    assert frequency == pytest.approx(0.6, rel=0.12)
    damping = law.proportional_gain * scheduled * gear * slope / (inertia * speed * 2 * frequency)
    assert damping == pytest.approx(0.7, rel=0.12)


def test_peak_shaving_keeps_the_thrust_below_its_share():
    known = load_turbine("nrel-5mw")
    limited = replace(known, control=replace(known.control, thrust_limit=0.8))
    winds = [9.0, 10.0, 11.0, 12.0]
    options = {"shear": 0.0, "rung": "tables", "options": RotorOptions(tower_dam=False)}
    free, shaved = (steady_state(t, winds, **options) for t in (known, limited))
    weight = known.rotor_mass * GRAVITY * np.sin(known.rotor.tilt)
    highest = [float((s["thrust"] - weight).max()) for s in (free, shaved)]
    assert 0.74 < highest[1] / highest[0] < 0.84
    assert float(shaved["pitch"][2]) > float(free["pitch"][2]) + np.radians(1.0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"optimal_tip_speed_ratio": 7.5}, "region_2_gain or optimal_tip_speed_ratio"),
        ({"region_2_gain": None}, "region_2_gain or optimal_tip_speed_ratio"),
        ({"integral_gain": None}, "pitch_frequency and pitch_damping"),
        ({"pitch_frequency": 0.6}, "pitch_frequency and pitch_damping"),
        ({"thrust_limit": 1.2}, "thrust_limit"),
    ],
)
def test_a_control_states_each_gain_once(change, message):
    with pytest.raises(InputError, match=message):
        replace(load_turbine("nrel-5mw").control, **change)
