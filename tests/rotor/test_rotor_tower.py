"""Tower and drivetrain: free decay, balance at the hub, limits, what a file must describe."""

import dataclasses
from itertools import pairwise

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.rotor import RotorOptions, simulate
from loadflow.rotor import slots as k
from loadflow.rotor.control.constants import controller
from loadflow.rotor.frame import frame
from loadflow.rotor.inflow import steady_inflow
from loadflow.rotor.loop import run, turning_state
from loadflow.rotor.machine import machine
from loadflow.rotor.rungs import finest_rung, prepare
from loadflow.rotor.steady import operating_point
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")
VACUUM = RotorOptions(air_density=1e-9, tower_dam=False)
STEP = 0.0125
TOWER = {1: k.FORE_AFT, 2: k.SIDE_SIDE}


def stiff(turbine, factor):
    """The turbine with a tower and a drivetrain that many times stiffer, well damped."""
    bending, drivetrain = turbine.tower.bending, turbine.drivetrain
    bending = dataclasses.replace(
        bending,
        damping=0.9,
        fore_aft_stiffness=factor * bending.fore_aft_stiffness,
        side_side_stiffness=factor * bending.side_side_stiffness,
    )
    return dataclasses.replace(
        turbine,
        tower=dataclasses.replace(turbine.tower, bending=bending),
        drivetrain=dataclasses.replace(
            drivetrain,
            torsional_stiffness=factor * drivetrain.torsional_stiffness,
            torsional_damping=100 * drivetrain.torsional_damping,
        ),
    )


def decay(m, c, place, amount, *, speed=1e-9, seconds=60.0, controlled=False):
    """Columns after one coordinate of the frame is let go in still, thin air."""
    state = turning_state(m, c, 1.0, speed, 0.0)
    state.frame[place] = amount
    steps = round(seconds / STEP)
    inflow = steady_inflow(0.01, steps, 0.0)
    return run(m, c, inflow, state, STEP, steps=steps, controlled=controlled)


def oscillation(x):
    """Frequency (Hz) and damping (share of critical) of a decaying signal."""
    x = x - x.mean()
    up = np.flatnonzero((x[:-1] <= 0) & (x[1:] > 0))
    times = up - x[up] / (x[up + 1] - x[up])
    peaks = [np.ptp(x[a:b]) for a, b in pairwise(up)]
    decrement = np.log(peaks[0] / peaks[-1]) / (len(peaks) - 1)
    return 1 / np.diff(times).mean() / STEP, decrement / (2 * np.pi)


@pytest.fixture(scope="module")
def flexible():
    return prepare(TURBINE, "tower", VACUUM)


@pytest.fixture(scope="module")
def rigid_blades():
    m = machine(TURBINE, dataclasses.replace(VACUUM, modes=(), drivetrain_torsion=False))
    return m._replace(frame=m.frame._replace(damping=0 * m.frame.damping)), controller(TURBINE)


@pytest.mark.parametrize(("place", "published"), [(1, "tower fore-aft"), (2, "tower side-to-side")])
def test_the_tower_sways_at_the_published_frequency_and_its_own_damping(flexible, place, published):
    m, c = flexible
    frequency, damping = oscillation(decay(m, c, place, 0.2)[:, TOWER[place]])
    assert frequency == pytest.approx(TURBINE.frequencies[published], rel=0.01)
    # 1 % of the tower by itself is less with a mass on top: c ω/(2 k), where the rotor's weight
    # takes its part of k through the blade sections
    f = m.frame
    stiffness = f.stiffness[place, place]
    stiffness -= TURBINE.rotor_mass * 9.80665 * np.linalg.norm(f.reach[place, 3:])
    share = f.damping[place, place] * 2 * np.pi * frequency / (2 * stiffness)
    assert damping == pytest.approx(share, rel=0.05)


def test_the_drivetrain_twists_at_the_frequency_of_two_inertias_and_a_spring():
    m = machine(TURBINE, dataclasses.replace(VACUUM, modes=(), tower_motion=False))
    c = controller(TURBINE)._replace(maximum_torque=0.0, torque_rate=0.0)
    out = decay(m, c, 1, 0.005, speed=0.5, seconds=5.0, controlled=True)
    twisting = out[:, k.SPEED] - out[:, k.GENERATOR] / 97
    rotor = 115926 + 3 * np.sum(m.mass * (m.radius * np.cos(m.cone)) ** 2)
    inverse = 1 / rotor + 1 / (534.116 * 97**2)
    natural = np.sqrt(867.637e6 * inverse)
    frequency, damping = oscillation(twisting)
    assert damping == pytest.approx(6.215e6 * inverse / (2 * natural), rel=0.05)
    damped = natural * np.sqrt(1 - damping**2) / (2 * np.pi)
    assert frequency == pytest.approx(damped, rel=0.01)
    # what the rotor loses the generator gains
    momentum = rotor * out[:, k.SPEED] + 534.116 * 97 * out[:, k.GENERATOR]
    assert np.ptp(momentum[5:]) < 5e-3 * momentum.mean()


def test_without_air_the_hub_force_is_weight_less_mass_times_acceleration(rigid_blades):
    m, c = rigid_blades
    mass = TURBINE.rotor_mass
    out = decay(m, c, 2, 0.2, seconds=10.0)
    # the mass centre lies at the cone's lever before the apex
    lever = np.sum(3 * m.mass * m.radius) * np.sin(m.cone) / mass
    weight = mass * 9.80665 * np.array([np.sin(m.tilt), 0.0, -np.cos(m.tilt)])
    expected, largest = weight, 0.0
    for place, column in TOWER.items():  # the weight of the rotor moves the tower forward too
        x, reach = out[:, column], m.frame.reach[place]
        acceleration = (x[2:] - 2 * x[1:-1] + x[:-2]) / STEP**2
        centre = reach[:3] + np.cross(reach[3:], [-lever, 0, 0])
        lean = np.cross(reach[3:], weight)
        expected = expected - x[1:-1, None] * lean - mass * acceleration[:, None] * centre
        largest = max(largest, np.abs(acceleration).max())
    force = out[1:-1, [k.FX, k.FX + 1, k.FX + 2]]
    # the first steps find the acceleration
    assert np.abs(force - expected)[5:].max() < 0.01 * mass * largest


def test_an_undamped_tower_in_a_vacuum_keeps_its_energy(rigid_blades):
    m, c = rigid_blades
    _, damping = oscillation(decay(m, c, 1, 0.2)[:, k.FORE_AFT])
    assert abs(damping) < 2e-5


def test_a_turning_rotor_answers_a_nodding_nacelle_with_a_yawing_moment(rigid_blades):
    # gyroscopic: J Ω times the rate of the tilt, about z
    m, c = rigid_blades
    m = m._replace(cone=0.0)
    speed = 1.0
    still = decay(m, c, 1, 0.0, speed=speed, seconds=5.0)
    out = decay(m, c, 1, 0.2, speed=speed, seconds=5.0)
    rate = m.frame.reach[1, 4] * np.gradient(out[:, k.FORE_AFT] - still[:, k.FORE_AFT], STEP)
    polar = 3 * np.sum(m.mass * m.radius**2)
    moment = out[:, k.MX + 2] - still[:, k.MX + 2]
    fit = np.polyfit(rate[5:-5], moment[5:-5], 1)[0]
    assert fit == pytest.approx(polar * speed, rel=0.01)


def test_a_stiff_tower_and_drivetrain_leave_the_rung_flap():
    arguments = {"wind_speed": 12.0, "duration": 40.0, "run_in": 20.0}
    clamped = simulate(stiff(TURBINE, 1e4), rung="tower", **arguments)
    bending = simulate(TURBINE, rung="flap", **arguments)
    for name in ("hub_force", "hub_moment"):
        difference = (clamped[name] - bending[name]).std("time")
        assert (difference < 0.01 * bending[name].std("time")).all(), name


def test_steady_state_is_that_of_a_rotor_tilted_by_the_lean_of_its_tower():
    own = RotorOptions(tower_dam=False)
    m, c = prepare(TURBINE, "tower", own)
    mean, *_ = operating_point(m, c, 14.0, 0.2)
    rotor = dataclasses.replace(
        TURBINE.rotor, tilt=TURBINE.rotor.tilt + m.frame.reach[1, 4] * mean[k.FORE_AFT]
    )
    m, c = prepare(dataclasses.replace(TURBINE, rotor=rotor), "flap", own)
    clamped, *_ = operating_point(m, c, 14.0, 0.2)
    assert 0.15 < mean[k.FORE_AFT] < 0.45
    assert mean[[k.FX, k.SPEED, k.PITCH]] == pytest.approx(
        clamped[[k.FX, k.SPEED, k.PITCH]], rel=1e-3
    )
    columns = [k.MX, k.MX + 1, k.MX + 2]
    assert mean[columns] == pytest.approx(clamped[columns], abs=1e4)
    # the torque turns the nacelle with the rotor: top to the right, looking downwind
    assert -0.12 < mean[k.SIDE_SIDE] < -0.02


def test_a_braked_rotor_rings_down_about_a_generator_that_stands():
    stop = simulate(dlc="5.1", wind_speed=12.0, duration=60.0, run_in=10.0, event_time=5.0)
    assert float(stop["generator_speed"][-1]) == 0.0
    assert abs(float(stop["speed"][-1])) < 0.02


def test_a_model_that_breaks_down_says_when(flexible):
    m, c = flexible
    state = turning_state(m, c, 10.0, 1.0, 0.0)
    state.mode_speed[1, 0] = np.inf
    with pytest.raises(SolverError, match=r"broke down at t = 0\.000 s"):
        run(m, c, steady_inflow(10.0, 5, 0.0), state, STEP, steps=5)


def test_the_rung_names_what_a_turbine_lacks():
    tower = dataclasses.replace(TURBINE.tower, bending=None)
    stiff_one = dataclasses.replace(TURBINE, tower=tower)
    assert finest_rung(stiff_one) == "flap"
    with pytest.raises(InputError, match=r"NREL 5 MW has no table tower\.bending"):
        simulate(stiff_one, wind_speed=9.0, rung="tower")
    assert frame(stiff_one, RotorOptions(tower_motion=False)).carries.sum() == 0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"damping": 1.5}, "damping = 1.5"),
        ({"nacelle_mass": -1.0}, "nacelle_mass = -1.0"),
        ({"fore_aft": (1.0, 1.0)}, "fore_aft sum of coefficients = 2.0"),
        ({"mass_density": np.zeros(11)}, "mass_density"),
        ({"height": np.linspace(87.6, 0, 11)}, "height"),
    ],
)
def test_a_bad_tower_is_named(change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(TURBINE.tower.bending, **change)
