"""Losses of rollers in motion are what their shaft puts in, and add up to a torque."""

import math
from dataclasses import replace

import numpy as np
import pytest
from roller_energy import RollerState, roller_torques

from loadflow.errors import InputError
from loadflow.journal import JournalBearing
from loadflow.rolling import FrictionOptions
from loadflow.rolling.friction import DragConstants, drag_constants
from loadflow.rolling.motion import _motion_kernels as kernels
from loadflow.rolling.motion.history import radial_history
from loadflow.rolling.motion.radial_load import behw_law
from loadflow.rolling.motion.rollers import (
    coulomb_motion,
    film_arguments,
    film_motion,
    film_numbers,
)
from loadflow.rolling.motion.torque import (
    FrictionTorque,
    coulomb_torque,
    film_torque,
    measured_torque,
)
from loadflow.studies.one_bearing.crank_rig import MAIN, CrankRig
from loadflow.tribology import lubricant

OMEGA = 3000 * math.pi / 30
TIME = np.linspace(0.0, 4 * 22 / 9 * 0.02, 3521)
HISTORY = radial_history(MAIN.row, TIME, OMEGA, 2e3, 8e-6, behw_law(11e-3))
OIL = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=363.15, roughness=0.3e-6)
DRAG = DragConstants(2e-6, 0.0)


def test_what_rollers_with_films_lose_is_what_the_shaft_puts_in():
    motion = film_motion(HISTORY, OIL, drag=DRAG)
    found = film_torque(motion, OIL, OMEGA, drag=DRAG)
    forces = kernels.forces(
        film_numbers(MAIN.row, OIL, DRAG), *film_arguments(HISTORY)[1:], motion.spin
    )
    state = RollerState(
        inner_speed=OMEGA, outer_speed=0.0, cage_speed=HISTORY.cage_speed[:, None],
        spin=motion.spin, traction=(forces[..., 0], forces[..., 1]),
        rolling=(forces[..., 2], forces[..., 3]), drag=forces[..., 6] + DRAG.spin * motion.spin,
    )  # fmt: skip
    inner, _, cage = roller_torques(state, *MAIN.row.raceways)
    power = (inner * OMEGA + cage * HISTORY.cage_speed[:, None]).sum(axis=1)
    # over whole turns of the cage nothing is stored; the impulses of entry lie between samples
    assert found.power == pytest.approx(power[motion.settled].mean(), rel=0.05)


def test_rolling_with_coulomb_friction_is_half_the_bore_times_the_sum_of_the_loads():
    free = coulomb_motion(HISTORY, DragConstants(1e-12, 0.0), sliding=0.0)
    found = coulomb_torque(free, DragConstants(1e-12, 0.0), OMEGA, sliding=0.0, rolling=5e-4)
    bore = MAIN.row.raceways[0]
    rolls = (2 * HISTORY.load + HISTORY.outward).sum(axis=1)[free.settled].mean()
    assert found.torques["rolling"] == pytest.approx(5e-4 * bore / 4 * rolls, rel=1e-9)  # (5.36)


def test_parts_of_one_name_add_up_and_speeds_must_agree():
    one, other = FrictionTorque({"a": 1.0}, 2.0), FrictionTorque({"a": 3.0, "b": 4.0}, 2.0)
    assert (one + other).torques == {"a": 2.0, "b": 2.0}
    with pytest.raises(InputError, match="differ"):
        one + replace(other, speed=3.0)
    with pytest.raises(InputError, match="speed"):
        FrictionTorque({}, 0.0)


def test_a_rig_that_measures_inertia_alone_has_no_friction():
    angle = np.linspace(0.0, 2 * math.pi, 360, endpoint=False)
    assert measured_torque(np.cos(angle), np.sin(angle), 10.0) == pytest.approx(0.0, abs=1e-15)
    with pytest.raises(InputError, match="one length"):
        measured_torque([1.0, 2.0], [1.0], 10.0)
    with pytest.raises(InputError, match="finite"):
        measured_torque([np.nan], [1.0], 10.0)


def test_the_film_on_the_pin_loses_what_petroff_says_where_it_carries_nothing():
    light = CrankRig().drive
    assert light is not None
    light = replace(light, piston_mass=0.0, rod_mass=1e-6)
    bearing = JournalBearing(diameter=48e-3, width=18e-3, relative_clearance=1e-3)
    rig = CrankRig(drive=light, pin_film=bearing)
    omega = 1000 * math.pi / 30
    swing = light.swing(np.linspace(0, 2 * math.pi, 721)[:-1], omega).speed
    gap = bearing.clearance
    petroff = rig.viscosity * 2 * math.pi * 24e-3**3 * 18e-3 / gap * np.mean(swing**2)
    assert rig.friction_torque(1000.0).losses["pin film"] == pytest.approx(petroff, rel=0.01)


def test_colder_oil_costs_more_in_both_stages():
    for stage in ("coulomb", "film"):
        warm, cold = (
            CrankRig(temperature=t).friction_torque(2000.0, stage).torque for t in (363.15, 333.15)
        )
        assert cold > 1.1 * warm


def test_configurations_of_the_crank_rig_lose_in_the_order_measured():
    film = JournalBearing(diameter=48e-3, width=18e-3, relative_clearance=1e-3)
    rigs = CrankRig(), CrankRig(pin_film=film), CrankRig(drive=None)
    slow, fast = ([rig.friction_torque(n).torque for rig in rigs] for n in (500.0, 3000.0))
    assert slow[0] < slow[1]
    assert fast[1] < fast[0]
    assert fast[2] - slow[2] < 0.8 * (fast[0] - slow[0])


def test_stage_two_loses_less_than_stage_one_only_without_its_loss_of_slip():
    rig = CrankRig(seal_force=0.0)
    coulomb, films = (rig.friction_torque(1000.0, stage) for stage in ("coulomb", "film"))
    slip = films.torques["main slip"] + films.torques["pin slip"]
    assert films.torque - slip < coulomb.torque < films.torque


def test_drag_is_the_moment_times_the_spin():
    held = drag_constants(MAIN.gaps, 0.01, 9 / 22, variant="thesis")
    motion = coulomb_motion(HISTORY, held)
    found = coulomb_torque(motion, held, OMEGA)
    power = np.abs(held.spin * motion.spin + held.orbit * OMEGA) * motion.spin
    assert found.losses["drag"] == pytest.approx(power[motion.settled].sum(axis=1).mean())


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: CrankRig(load=-1.0),
        lambda: CrankRig(main_bearings=0),
        lambda: CrankRig(drive=None, pin_film=JournalBearing(0.05, 0.02, 1e-3)),
        lambda: CrankRig().friction_torque(1000.0, "third"),
    ],
)
def test_what_is_no_rig_is_refused(wrong):
    with pytest.raises(InputError):
        wrong()


def test_thrust_washers_add_their_own_loss():
    usual, more = (
        CrankRig(thrust_share=share).friction_torque(1000.0).torques for share in (0.0, 0.04)
    )
    assert "thrust washers" not in usual
    twice = CrankRig(thrust_share=0.08).friction_torque(1000.0).torques["thrust washers"]
    assert twice == pytest.approx(2 * more["thrust washers"])
    assert more["thrust washers"] > 0
