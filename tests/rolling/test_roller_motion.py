"""Motion of rollers: exact steps, energy, limits, and what stops them."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from roller_energy import RollerState, energy_audit

from benchmarks.peers.roller_moment import roller_moment
from loadflow.errors import InputError
from loadflow.rolling import FrictionOptions
from loadflow.rolling import friction as parts
from loadflow.rolling.friction import DragConstants
from loadflow.rolling.motion import _coulomb_kernels, _motion_kernels
from loadflow.rolling.motion.cage import CageRim, cage_orbit
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.history import (
    RollerHistory,
    RollerRow,
    crank_history,
    radial_history,
)
from loadflow.rolling.motion.radial_load import behw_law, radial_distribution
from loadflow.rolling.motion.rollers import (
    coulomb_motion,
    film_arguments,
    film_motion,
    film_numbers,
    longest_slip,
)
from loadflow.tribology import lubricant
from loadflow.tribology.film import butenschoen
from loadflow.validation._friction_motion import ROW, STATIC, static_load
from loadflow.validation.friction import MAIN, MAIN_RACES

DRAG = parts.coulomb_drag_constants(MAIN, 37.06e-3, 9 / 22, 0.12, 0.04, variant="thesis")
OPTIONS = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=333.15)
WITH_DRAG = dataclasses.replace(OPTIONS, roller_drag=1e-6)


def refined(history, times):
    """The same history with every interval cut into `times`: linear in between."""
    old = history.time
    new = np.interp(np.arange(times * (old.size - 1) + 1) / times, np.arange(old.size), old)

    def on(values):
        columns = values if values.ndim == 2 else values[:, None]
        out = np.stack([np.interp(new, old, column) for column in columns.T], axis=1)
        return out if values.ndim == 2 else out[:, 0]

    names = ("inner_speed", "outer_speed", "load", "outward", "tangential")
    return dataclasses.replace(history, time=new, **{n: on(getattr(history, n)) for n in names})


def cut(history, stop):
    names = ("time", "inner_speed", "outer_speed", "load", "outward", "tangential")
    return dataclasses.replace(history, **{n: getattr(history, n)[:stop] for n in names})


def test_coulomb_steps_are_exact_between_the_samples():
    history = cut(static_load(1000, 2e3), 500)
    plain, fine = coulomb_motion(history, DRAG), coulomb_motion(refined(history, 7), DRAG)
    assert np.abs(fine.spin[::7] / plain.spin - 1).max() < 1e-10
    assert plain.maximum_slip > 0.5


@pytest.mark.parametrize(("rpm", "force"), [row[:2] for row in STATIC])
def test_closed_form_of_the_largest_slip_agrees_with_the_steps(rpm, force):
    found = radial_distribution(force, ROW.places, 8e-6, behw_law(ROW.roller_length))
    half_zone = np.arccos(4e-6 / float(found.displacement))
    closed = longest_slip(ROW, DRAG, rpm * np.pi / 30, half_zone)
    assert abs(closed - coulomb_motion(static_load(rpm, force), DRAG).maximum_slip) < 0.003


def test_coulomb_run_up_takes_the_time_that_momentum_needs():
    """From rest under a constant grip and no drag: a straight line, then ideal."""
    time, ideal, grip = np.linspace(0, 1, 11), np.full(11, 10.0), np.full((11, 1), 2.0)
    spin = _coulomb_kernels.coulomb_spins(
        time, ideal, grip, np.zeros((11, 1)), np.zeros((11, 1)), 0.0, 0.1, np.zeros(1)
    )
    assert np.allclose(spin[:, 0], np.minimum(20 * time, 10), atol=1e-12)


def implicit(pulled, target, grip, brake):
    """Least of (w - pulled)²/2 + grip |w - target| + brake |w|: at a kink or between them."""
    ends = [target, 0.0]
    ends += [pulled + s * grip + r * brake for s in (-1, 1) for r in (-1, 1)]

    def cost(w):
        return (w - pulled) ** 2 / 2 + grip * abs(w - target) + brake * abs(w)

    return min(ends, key=cost)


@settings(max_examples=15, deadline=None)
@given(
    st.lists(st.floats(0, 5), min_size=4, max_size=4),
    st.lists(st.floats(-2, 2), min_size=4, max_size=4),
    st.lists(st.floats(0, 2), min_size=4, max_size=4),
    st.floats(0, 3),
    st.floats(-20, 20),
    st.sampled_from([(10.0, 12.0, 5.0, 5.0), (5.0, -3.0, -3.0, 4.0)]),
)
def test_coulomb_spin_agrees_with_tiny_steps(grip, push, brake, damping, start, ideal):
    time, inertia = np.arange(4.0), 0.5
    exact = _coulomb_kernels.coulomb_spins(
        time, np.array(ideal), *(np.array(m)[:, None] for m in (grip, push, brake)), damping,
        inertia, np.array([start]),
    )[:, 0]  # fmt: skip
    steps = 4000
    h, middle = 3 / steps, (np.arange(steps) + 0.5) * 3 / steps
    w = start
    given_ = (np.interp(middle, time, v).tolist() for v in (ideal, grip, push, brake))
    for target, a, b, k in zip(*given_):
        # implicit Coulomb friction: it stops at the ideal spin, or at rest, and never passes it
        w = implicit(w + h / inertia * (b - damping * w), target, h * a / inertia, h * k / inertia)
    assert abs(exact[-1] - w) < 0.03


def test_film_steps_hold_a_tenth_of_a_percent():
    history = cut(static_load(1000, 2e3), 900)
    plain, tight = (
        film_motion(history, WITH_DRAG, tolerance=tolerance) for tolerance in (3e-4, 1e-6)
    )
    assert np.abs(plain.spin - tight.spin).max() < 1e-3 * history.ideal_spin[0]
    assert 0.1 < tight.maximum_slip < 1


@pytest.mark.parametrize("film", ["moes", "hamrock"])
@pytest.mark.parametrize("load", [1e-3, 1.0, 300.0, 3e4])
@pytest.mark.parametrize("speed", [1e-3, 0.3, 5.0])
def test_contacts_follow_their_slopes(film, load, speed):
    """Central differences of 1e-5 of the speed: they leave 1e-9 and rounding."""
    numbers = film_numbers(ROW, dataclasses.replace(WITH_DRAG, film=film))

    def at(mean):
        return _motion_kernels.both_contacts(numbers, mean, mean / ROW.radius, load, 0.3 * load)

    step = 1e-5 * speed
    here, less, more = at(speed), at(speed - step), at(speed + step)
    for ring in ("inner", "outer"):
        slopes = getattr(here, f"{ring}_slope")
        for name, value in getattr(here, ring)._asdict().items():
            change = getattr(getattr(more, ring), name) - getattr(getattr(less, ring), name)
            assert getattr(slopes, name) == pytest.approx(
                change / (2 * step), rel=1e-4, abs=1e-9 * value / speed
            )


@pytest.mark.parametrize("order", ["C", "F"])
def test_steps_take_histories_that_are_read_only_or_laid_out_by_columns_as_any_other(order):
    """Other layouts would be compiled anew, which takes much longer than the steps."""
    history = cut(static_load(2000, 2e3), 20)
    names = ("time", "inner_speed", "outer_speed", "load", "outward", "tangential")
    changed = {name: np.array(getattr(history, name), order=order) for name in names}
    for values in changed.values():
        values.flags.writeable = False
    other = dataclasses.replace(history, **changed)
    for one, usual in zip(film_arguments(other), film_arguments(history), strict=True):
        assert one.flags.c_contiguous
        assert one.flags.writeable
        np.testing.assert_array_equal(one, usual)


def test_film_steps_agree_with_lsoda():
    from scipy.integrate import solve_ivp

    history = cut(static_load(2000, 2e3), 400)
    numbers, given_ = film_numbers(ROW, WITH_DRAG), film_arguments(history)
    time, roller = given_[0], 4

    def rate(t, w):
        at = [np.interp(t, time, v[:, roller] if v.ndim == 2 else v) for v in given_[1:]]
        return [roller_moment(numbers, *at, w[0]) / ROW.inertia]

    ours = film_motion(history, WITH_DRAG, tolerance=1e-5).spin[:, roller]
    path = solve_ivp(
        rate, (0, time[-1]), [history.ideal_spin[0]], "LSODA", time, rtol=1e-8, atol=1e-6,
        max_step=time[1],
    )  # fmt: skip
    assert path.success
    assert np.abs(path.y[0] - ours).max() < 1e-3 * history.ideal_spin[0]


def test_shaft_power_is_lost_or_stored():
    history = cut(static_load(1000, 2e3), 900)
    motion = film_motion(history, WITH_DRAG)
    numbers = film_numbers(ROW, WITH_DRAG)
    out = _motion_kernels.forces(numbers, *film_arguments(history)[1:], motion.spin)
    cage = history.cage_speed[:, None]
    state = RollerState(
        inner_speed=history.inner_speed[:, None], outer_speed=0.0, cage_speed=cage,
        spin=motion.spin, spin_rate=out[..., 7] / ROW.inertia,
        traction=(out[..., 0], out[..., 1]), rolling=(out[..., 2], out[..., 3]),
        drag=WITH_DRAG.roller_drag * motion.spin + out[..., 6], tangential=history.tangential,
    )  # fmt: skip
    audit = energy_audit(state, *MAIN_RACES, ROW.inertia)
    assert audit.error < 1e-9
    assert min(audit.losses.values()) >= 0
    pushed = (audit.losses["slip"], audit.losses["rolling"], audit.losses["drag"])
    assert all(power > 0 for power in pushed)


def test_elastic_films_let_free_rollers_stop_and_films_of_all_regimes_do_not():
    history = static_load(1000, 2e3)
    elastic = dataclasses.replace(OPTIONS, film="hamrock", roughness=1e-12)
    drag = DragConstants(1e-6, 0.0)
    slips = [film_motion(history, o, drag=drag).maximum_slip for o in (elastic, OPTIONS)]
    assert slips[0] > slips[1] + 0.1


@settings(max_examples=10, deadline=None)
@given(st.floats(0.05, 20), st.floats(10, 2000), st.floats(0, 9.81))
def test_slip_stays_between_ideal_rolling_and_rest(speed, force, gravity):
    """Constant speed: nothing drives a roller beyond ideal rolling or backward."""
    time = np.linspace(0, 30 / speed, 60)
    history = radial_history(ROW, time, speed, force, 8e-6, behw_law(11e-3), gravity=gravity)
    slip = film_motion(history, WITH_DRAG).slip
    assert slip.min() > -1e-6
    assert slip.max() < 1 + 1e-2


def test_turning_the_other_way_mirrors_the_motion():
    time = np.linspace(0, 0.3, 200)
    histories = [radial_history(ROW, time, s * 50.0, 500.0, 8e-6, behw_law(11e-3)) for s in (1, -1)]
    ahead, back = (film_motion(h, WITH_DRAG).spin for h in histories)
    mirror = -np.arange(14) % 14
    assert np.allclose(ahead, -back[:, mirror], rtol=1e-6, atol=1e-6)


def test_crank_pin_rollers_settle_into_a_period():
    """Outer ring driving; where the rod swings slower, rollers may overspin."""
    drive = CrankDrive(
        radius=42.5e-3, rod_length=143.5e-3, piston_mass=0.4, rod_mass=0.6, rod_centre=43e-3
    )
    row = RollerRow(
        rollers=18, roller_diameter=7.5e-3, roller_length=18e-3, pitch_diameter=55.5e-3,
        roller_mass=6.67e-3,
    )  # fmt: skip
    omega = 3000 * np.pi / 30
    time = np.linspace(0, 37 * 2 * np.pi / omega, 37 * 180 + 1)
    force = drive.pin_loads(omega * time, omega).crank
    swing = drive.swing(omega * time, omega)
    place = (21 / 37 * swing.angle)[:, None] + row.places
    direction = np.arctan2(force[:, 0], force[:, 1])
    loads = radial_distribution(
        np.hypot(*force.T), place - direction[:, None], 25e-6, behw_law(18e-3)
    ).loads
    history = crank_history(row, drive, time, omega, loads)
    assert np.allclose(history.cage_speed, 21 / 37 * swing.speed)
    drag = DragConstants(2e-6, 0.0)
    motion = coulomb_motion(history, drag, driving="outer", periodic=True)
    assert (history.ideal_spin < 0).all()
    assert 0.01 < motion.maximum_slip < 1
    assert np.allclose(motion.spin[0], motion.spin[-1], rtol=1e-9)


def test_cage_under_a_constant_load_rests_where_the_film_carries_it():
    rim = CageRim(width=4e-3, bore=63e-3, diameter=62.85e-3, viscosity=10.6e-3)
    orbit = cage_orbit(rim, np.linspace(0, 0.3, 61), (0.0, 40.0), 60.0, 100.0)
    ratio, angle = orbit.eccentricity_ratio[-1], orbit.angle[-1]
    so, beta = butenschoen(ratio, rim.width_ratio)
    carried = so * rim.width * rim.bore * rim.viscosity * 160.0 / rim.relative_clearance**2
    assert carried == pytest.approx(40.0, rel=1e-3)
    assert angle - np.pi / 2 == pytest.approx(float(beta), abs=1e-3)
    assert (orbit.friction_power > 0).all()
    assert orbit.convergence.converged


def test_histories_and_rows_refuse_what_has_no_meaning():
    good = static_load(1000, 2e3)
    with pytest.raises(InputError, match="load: must be ≥ 0"):
        dataclasses.replace(good, load=-good.load)
    with pytest.raises(InputError, match="time"):
        dataclasses.replace(good, time=good.time[::-1])
    with pytest.raises(InputError, match="outward: shape"):
        dataclasses.replace(good, outward=good.outward[:, :3])
    with pytest.raises(InputError, match="tangential: must be finite"):
        dataclasses.replace(good, tangential=good.tangential * np.nan)
    with pytest.raises(InputError, match="pitch_diameter"):
        RollerRow(rollers=3, roller_diameter=1.0, roller_length=1.0, pitch_diameter=0.5)
    with pytest.raises(InputError, match="pocket"):
        coulomb_motion(good, DRAG, pocket="lucky")
    with pytest.raises(InputError, match="diameter"):
        CageRim(width=1.0, bore=1.0, diameter=1.0, viscosity=1.0)
    assert isinstance(good, RollerHistory)


def test_a_braking_cage_holds_rollers_but_never_turns_them_back():
    """Slow bearing: rollers rest on the lower raceway, and hang in the cage at the sides."""
    time = np.linspace(0, 20, 800)
    history = radial_history(ROW, time, 1.0, 0.0, 8e-6, behw_law(11e-3), gravity=9.81)
    motion = coulomb_motion(history, DragConstants(1e-7, 0.0), pocket="braking")
    assert motion.slip.min() > -1e-12
    assert motion.slip.max() == 1.0
    assert (motion.slip[motion.settled] < 1e-9).any()


def test_a_stage_of_a_roller_that_turns_back_under_grease_converges():
    # tapered roller of a parked rotor that swings in its brake: the spin that the films ask for
    # jumps from side to side of the answer, ever within the bounds found before
    row = RollerRow(
        rollers=64, roller_diameter=0.08, roller_length=0.14, pitch_diameter=2.0, contact_angle=0.5
    )
    grease = FrictionOptions(
        oil=lubricant("lgep-2"), temperature=313.15, roughness=0.6e-6, roller_drag=1e-3,
        starvation=0.7,
    )  # fmt: skip
    state = (
        -0.015439053126159747, -0.030916202490707593, 0.008819847334893487,
        57.36366481614285, -25.943373380394714, -45.36239411077991,
    )  # fmt: skip
    known, part, guess = -5.718657586483572e-05, 6.62753121762128, -5.641303688618953e-05
    tally, film = np.zeros(4), film_numbers(row, grease)
    spin, _, _ = _motion_kernels._stage(film, state, known, part, guess, tally)
    assert tally[1] == 0
    assert tally[0] < 20
    # the balance of the implicit step, to what a stage is solved to
    assert spin == pytest.approx(known + part * roller_moment(film, *state, spin), rel=1e-3)
