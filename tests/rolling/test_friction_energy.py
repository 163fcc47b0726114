"""Sum of losses = shaft power less stored energy; friction of a whole bearing."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from roller_energy import RollerState, energy_audit, roller_torques

from loadflow.errors import InputError, SolverError
from loadflow.rolling import FrictionOptions, RollerBearing, friction, roller_friction
from loadflow.rolling.friction import rolling_resistance
from loadflow.rolling.kinematics import contact_speeds, ideal_speeds
from loadflow.tribology import lubricant, traction
from loadflow.validation.friction import MAIN, MAIN_BEARING, MAIN_RACES, MODULUS

INERTIA = 0.5 * 11e-3 * (5.5e-3) ** 2
force_values = st.floats(0, 20)


@given(
    st.floats(-100, 100), st.floats(-100, 100), st.floats(-60, 60), st.floats(-600, 600),
    force_values, force_values, force_values, force_values, st.floats(0, 0.05), force_values,
    st.floats(-0.05, 0.05), st.floats(-3, 3), st.sampled_from(["inner", "outer"]),
)  # fmt: skip
def test_every_state_that_obeys_the_rollers_equation_balances(
    inner, outer, cage, spin, pull_i, pull_o, roll_i, roll_o, drag, tangential, turn, push, rib
):
    radius = (MAIN_RACES[1] - MAIN_RACES[0]) / 4
    moment = radius * (pull_i + pull_o - roll_i - roll_o) - drag - turn
    state = RollerState(
        inner_speed=inner, outer_speed=outer, cage_speed=cage, spin=spin,
        spin_rate=moment / INERTIA, traction=(pull_i, pull_o), rolling=(roll_i, roll_o),
        drag=drag, tangential=tangential, rib_moment=turn, rib_force=push, rib=rib,
    )  # fmt: skip
    audit = energy_audit(state, *MAIN_RACES, INERTIA)
    scale = abs(audit.shaft) + abs(audit.stored) + sum(abs(p) for p in audit.losses.values())
    assert abs(audit.imbalance) <= 1e-11 * scale + 1e-12


def test_the_audit_finds_a_wrong_equation_of_motion():
    cage, spin = ideal_speeds(100.0, 0.0, *MAIN_RACES)
    state = RollerState(
        inner_speed=100.0, outer_speed=0.0, cage_speed=cage, spin=spin, traction=(1.0, 1.0),
        rolling=(0.9, 1.0),
    )  # fmt: skip
    assert energy_audit(state, *MAIN_RACES, INERTIA).error > 0.01


def test_a_roller_that_spins_up_stores_what_is_not_lost():
    """Traction, rolling and drag over a run-up: integrals of both sides agree."""
    speed, load = 1000 * np.pi / 30, 20.0
    cage, ideal = ideal_speeds(speed, 0.0, *MAIN_RACES)
    drag = friction.drag_constants(MAIN, 10.6e-3, 9 / 22).spin
    step, spin, put_in, lost = 2e-5, 0.3 * ideal, 0.0, 0.0

    def state(w):
        v = contact_speeds(speed, 0.0, cage, w, *MAIN_RACES)
        area, film = 2 * 9.5e-6 * 11e-3, 0.1e-6
        pulls, rolls = [], []
        for sliding, mean, radius in (
            (v.sliding_inner, v.mean_inner, 4.5e-3),
            (v.sliding_outer, v.mean_outer, 6.5e-3),
        ):
            stress = traction.smooth_stress(traction.newtonian_stress(1.0, sliding, film), 4e6)
            pulls.append(stress * area)
            rolls.append(
                rolling_resistance.hydrodynamic_force(
                    load, 11e-3, radius, mean, 10.6e-3, 2e-8, MODULUS
                )
            )
        moment = 5.5e-3 * (sum(pulls) - sum(rolls)) - drag * w
        return RollerState(
            inner_speed=speed, outer_speed=0.0, cage_speed=cage, spin=w,
            spin_rate=moment / INERTIA, traction=tuple(pulls), rolling=tuple(rolls), drag=drag * w,
        )  # fmt: skip

    start = spin
    for _ in range(400):  # midpoint rule
        middle = state(spin + step / 2 * state(spin).spin_rate)
        audit = energy_audit(middle, *MAIN_RACES, INERTIA)
        assert audit.error < 1e-12
        put_in += audit.shaft * step
        lost += sum(audit.losses.values()) * step
        spin = spin + step * middle.spin_rate
    stored = INERTIA / 2 * ((spin - cage) ** 2 - (start - cage) ** 2)
    assert spin > 0.9 * ideal
    assert put_in - lost == pytest.approx(stored, rel=1e-4)


OPTIONS = FrictionOptions(
    oil=lubricant("crankshaft-5w-30"), temperature=363.15, roughness=0.2e-6, hysteresis=0.01
)


def test_torque_is_the_sum_of_rolling_powers_at_both_rings():
    result = MAIN_BEARING.equilibrium(force=(2000.0, 0.0, 0.0))
    omega = 1000 * np.pi / 30
    found = roller_friction(result, omega, OPTIONS)
    forces = result.roller_forces[0]
    sums = []
    for radius in (4.5e-3, 6.5e-3):
        half = np.sqrt(8 * forces * radius / (np.pi * 11e-3 * MODULUS))
        sums.append(rolling_resistance.hysteresis_moment(forces, half, 0.01).sum() / (2 * radius))
    torque = friction.hydrodynamic_torque(*sums, *MAIN_RACES)
    assert found.torques["hysteresis"] == pytest.approx(float(torque), rel=1e-12)
    oblique = friction.hydrodynamic_torque(*sums, 45e-3, 60e-3, contact_angle=0.3)
    pitch, gamma = 52.5e-3, 15 / 105  # D_w cos α/D_pw
    assert oblique == pytest.approx(sum(sums) * pitch / 2 * (1 - gamma**2), rel=1e-12)
    assert found.torque == pytest.approx(float(found.power) / omega, rel=1e-14)
    assert found.torques["rolling"] > 0


def test_films_of_the_main_bearing():
    result = MAIN_BEARING.equilibrium(force=(2000.0, 0.0, 0.0))
    options = dataclasses.replace(
        OPTIONS,
        film="hamrock",
        oil=dataclasses.replace(OPTIONS.oil, pressure_coefficient=2e-8),
    )
    found = roller_friction(result, 1000 * np.pi / 30, options)
    # 0.115 μm at 718 N; here 732 N, C_th 0.977
    assert found.film[0, 0, 0] == pytest.approx(0.115e-6 * 0.977, rel=0.01)
    assert found.film_parameter[0, 0, 0] == pytest.approx(found.film[0, 0, 0] / 0.2e-6)
    assert (found.film[..., 1] > found.film[..., 0]).all()


WIND = RollerBearing(
    rollers=36, roller_diameter=0.08, roller_length=0.15, pitch_diameter=1.0, clearance=0.0
)


def test_a_slow_main_bearing_runs_in_mixed_friction():
    load = 36 / 4.08 * 200e3
    result = WIND.equilibrium(force=(load, 0, 0))
    options = FrictionOptions(
        oil=lubricant("mineral-vg-320"), temperature=333.15, roughness=0.55e-6
    )
    found = roller_friction(result, 10 * np.pi / 30, options)
    loaded = result.roller_forces > 1e5
    assert 0.4 < found.film_parameter[loaded].min() < 2
    assert found.asperity_share[loaded].max() > 0.1
    assert (found.traction_use[loaded] < 0.1).all()
    # rolling alone, without ribs, cage, seals and churning: well below the catalogues' 0.001
    assert 5e-5 < found.torque / (load * 0.5) < 1e-3


@settings(max_examples=20, deadline=None)
@given(st.floats(1e3, 1e6), st.floats(0.01, 50))
def test_losses_are_finite_and_not_negative(force, omega):
    found = roller_friction(MAIN_BEARING.equilibrium(force=(force, 0, 0)), omega, OPTIONS)
    assert all(np.isfinite(p) and p >= 0 for p in found.losses.values())
    assert np.isfinite(found.film).all()


def test_speed_may_stand_still_or_turn_back():
    result = MAIN_BEARING.equilibrium(force=(2000.0, 0.0, 0.0))
    still, back, fore = (roller_friction(result, w, OPTIONS) for w in (0.0, -100.0, 100.0))
    assert still.power == 0
    assert (still.film == 0).all()
    assert back.power == pytest.approx(float(fore.power))
    series = roller_friction(result, np.array([0.0, -100.0, 100.0]), OPTIONS)
    assert series.power == pytest.approx([0.0, float(back.power), float(fore.power)])
    with pytest.raises(InputError, match="speed"):
        roller_friction(result, np.nan, OPTIONS)


def test_film_laws_of_points_are_refused():
    with pytest.raises(InputError, match="film"):
        dataclasses.replace(OPTIONS, film="archard")


def test_components_add_what_they_say():
    result = MAIN_BEARING.equilibrium(force=(2000.0, 0.0, 0.0))
    plain = roller_friction(result, 100.0, OPTIONS)
    more = dataclasses.replace(
        OPTIONS,
        seal_torque=0.06,
        churning=friction.Churning(1e-3),
        roller_drag=1e-6,
        rib_angle=0.05,
        rib_height=1e-3,
    )
    found = roller_friction(result, 100.0, more)
    assert found.torques["seal"] == pytest.approx(0.06)
    assert found.torques["churning"] == pytest.approx(
        0.1 * float(OPTIONS.oil.viscosity(OPTIONS.temperature))
    )
    assert found.losses["rib"] > 0
    assert found.losses["drag"] > 0
    assert found.losses["rolling"] == pytest.approx(float(plain.losses["rolling"]))


def test_heat_balance_sheds_what_friction_makes():
    result = MAIN_BEARING.equilibrium(force=[(2000.0, 0, 0), (4000.0, 0, 0)])
    found = friction.balanced_temperature(result, 300.0, OPTIONS, 2.0, 293.15, weights=[3, 1])
    loss = np.average(found.friction.power, weights=[3, 1])
    assert found.convergence.converged
    assert loss == pytest.approx(2.0 * (found.temperature - 293.15), rel=1e-5)
    assert found.temperature > 293.15
    still = friction.balanced_temperature(result, 0.0, OPTIONS, 2.0, 293.15)
    assert still.temperature == 293.15
    hot = dataclasses.replace(OPTIONS, seal_torque=5.0)
    with pytest.raises(SolverError, match="heat balance"):
        friction.balanced_temperature(result, 300.0, hot, 1e-3, 293.15)
    with pytest.raises(InputError, match="conductance"):
        friction.balanced_temperature(result, 300.0, OPTIONS, 0.0, 293.15)


def test_a_heat_balance_that_is_not_found_is_refused_and_says_what_helps(monkeypatch):
    result = MAIN_BEARING.equilibrium(force=(2000.0, 0, 0))
    monkeypatch.setattr(friction.heat, "_MOST_STEPS", 2)  # too few for this one
    with pytest.raises(SolverError, match=r"not found in 2 steps .* What helps: a conductance"):
        friction.balanced_temperature(result, 300.0, OPTIONS, 2.0, 293.15)


def test_rib_friction_lies_between_film_and_boundary():
    pair = RollerBearing(
        rollers=48, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8,
        contact_angle=0.35, rows=2, row_spacing=0.12, clearance=-20e-6,
    )  # fmt: skip
    result = pair.equilibrium(force=(0, -4e5, 1e5))
    rib = FrictionOptions(
        oil=lubricant("lgwm-2"), temperature=313.15, rib_angle=0.04, rib_height=3e-3,
        rib_friction=0.04, boundary_friction=0.12,
    )  # fmt: skip
    plain = roller_friction(result, 1.5, rib).losses["rib"]
    losses = [
        roller_friction(result, w, dataclasses.replace(rib, rib_radius=2.0)).losses["rib"] / w
        for w in (0.01, 1.5, 50.0)
    ]
    assert plain / 1.5 < losses[2] * 1.01
    assert losses[2] < losses[1] < losses[0] <= 3 * plain / 1.5 * 1.001


def test_roller_forces_are_the_sums_of_their_slices():
    pair = RollerBearing(
        rollers=20, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8,
        contact_angle=0.35, rows=2, row_spacing=0.12, clearance=-20e-6, slices=7,
    )  # fmt: skip
    result = pair.equilibrium(force=[(0, -4e5, 1e5), (1e5, 2e5, 0)], moment=(2e4, -1e4))
    assert result.roller_forces == pytest.approx(result.slice_forces.sum(axis=-2), rel=1e-12)


def test_losses_of_a_bearing_are_the_power_of_its_shaft():
    """Torques from the forces on every surface, against the sum of all components."""
    speed, drag = 150.0, 2e-6
    options = dataclasses.replace(OPTIONS, roller_drag=drag)
    result = MAIN_BEARING.equilibrium(force=(3000.0, 1000.0, 0.0))
    found = roller_friction(result, speed, options)
    cage, spin = ideal_speeds(speed, 0.0, *MAIN_RACES)
    force = result.roller_forces[0]
    oil, u = OPTIONS.oil, spin * 5.5e-3
    rolling = []
    for radius in (4.5e-3, 6.5e-3):
        film = friction.line_film(force, 11e-3, radius, MODULUS, np.array(u), options)
        moment = rolling_resistance.hysteresis_moment(force, film.half_width, options.hysteresis)
        inlet = rolling_resistance.hydrodynamic_force(
            force, 11e-3, radius, u, float(oil.viscosity(363.15)),
            float(oil.pressure_viscosity(363.15)), MODULUS,
        )  # fmt: skip
        rolling.append(moment / (2 * radius) + film.share * inlet)
    pull = (sum(rolling) + drag * spin / 5.5e-3) / 2  # each raceway pulls half of what is needed
    state = RollerState(
        inner_speed=speed, outer_speed=0.0, cage_speed=cage, spin=spin, traction=(pull, pull),
        rolling=tuple(rolling), drag=drag * spin,
    )  # fmt: skip
    torques = [np.sum(t) for t in roller_torques(state, *MAIN_RACES)]
    assert sum(torques) == pytest.approx(0.0, abs=1e-12)
    shaft = torques[0] * speed + torques[2] * cage
    assert shaft == pytest.approx(float(found.power), rel=1e-12)
    assert energy_audit(state, *MAIN_RACES, INERTIA).error < 1e-12
