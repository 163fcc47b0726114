"""Blade-element momentum: the section solver balances, the table stands for it."""

from collections import OrderedDict
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rotor_sections import section_force

from loadflow.rotor import tables
from loadflow.rotor._wind_kernels import turbulence
from loadflow.rotor.aero._airfoil_kernels import SECTION_STATES
from loadflow.rotor.aero._kernels import induction, small_turn, solve
from loadflow.rotor.aero._section_kernels import tabulated_induction
from loadflow.rotor.inflow import steady_inflow
from loadflow.rotor.lanes import LANES, WEIGHT, packs
from loadflow.rotor.machine import machine
from loadflow.rotor.options import RotorOptions
from loadflow.rotor.tables import with_table
from loadflow.turbines import load_turbine
from loadflow.wind.field import Field

RIGID = machine(load_turbine("nrel-5mw"), RotorOptions(modes=()))
PACKED = ("radius", "chord", "twist", "width")


@cache
def tabled():
    """With its table of induction, which takes seconds, and none while tests are collected."""
    return with_table(RIGID)


@settings(deadline=None, max_examples=300)
@given(
    st.integers(0, 16),
    st.floats(0.5, 30.0),
    st.floats(3.0, 90.0),
    st.floats(-0.03, 1.5),
    st.floats(0.0, 0.5),
)
def test_momentum_and_blade_forces_balance_from_any_start(i, normal, tangential, pitch, guess):
    angle, a, swirl = solve(RIGID, i, pitch, normal, tangential, 0.0)
    again = solve(RIGID, i, pitch, normal, tangential, guess)[0]
    for root in (angle, again):
        assert np.isfinite(root)
    if 1e-3 < angle < 1.5 and (a, swirl) != (0.0, 0.0):
        below = induction(RIGID, i, angle - 1e-5, pitch, normal, tangential)[0]
        above = induction(RIGID, i, angle + 1e-5, pitch, normal, tangential)[0]
        assert below * above <= 0


@pytest.mark.parametrize("sections", [1, 5, 16, 17])
def test_packs_hold_each_section_of_each_blade_once(sections):
    machine = RIGID._replace(**{n: getattr(RIGID, n)[:1].repeat(sections) for n in PACKED})
    pack, blade, section = packs(machine)
    counts = pack[:, WEIGHT : WEIGHT + LANES].ravel() > 0
    assert pack[:, WEIGHT : WEIGHT + LANES].sum() == pytest.approx(1.0)
    held = list(zip(blade[counts], section[counts], strict=True))
    assert held == [(b, i) for b in range(3) for i in range(sections)]
    assert blade.size == LANES * pack.shape[0] < 3 * sections + LANES


def test_low_induction_follows_momentum_theory():
    # C_T of the annulus from the blade forces equals 4 a (1 − a) F
    i, normal, tangential = 10, 10.0, 60.0
    angle, a, swirl = solve(RIGID, i, 0.1, normal, tangential, 0.0)
    assert 0 < a < 1 / 3
    wake = np.zeros(SECTION_STATES)
    lossless = RIGID._replace(drag=np.zeros_like(RIGID.drag), shed_wake=False)
    force, _ = section_force(lossless, i, 0.1, normal, tangential, a, swirl, 0.0, wake)
    radius = RIGID.radius[i]
    f = 1.5 * (63 - radius) / (radius * np.sin(angle))
    g = 1.5 * (radius - 1.5) / (1.5 * np.sin(angle))
    loss = np.arccos(np.exp(-f)) * np.arccos(np.exp(-g)) * (2 / np.pi) ** 2
    thrust = 3 * force / (0.5 * RIGID.air_density * normal**2 * 2 * np.pi * radius)
    assert thrust == pytest.approx(4 * a * (1 - a) * loss, rel=1e-4)


def test_table_gives_the_induction_within_one_percent_of_the_wind():
    generator = np.random.default_rng(5)
    worst = 0.0
    for _ in range(400):
        i, pitch = generator.integers(3, 17), generator.uniform(-0.02, 0.4)
        normal, tangential = generator.uniform(3, 25), generator.uniform(15, 80)
        _, a, _ = solve(RIGID, i, pitch, normal, tangential, 0.0)
        speed, angle = np.hypot(normal, tangential), np.arctan2(normal, tangential)
        b, _ = tabulated_induction(tabled(), i, pitch, normal, tangential, speed, angle)
        worst = max(worst, abs(a - b) * normal / speed)
    assert worst < 0.01


def test_small_turns_have_the_sine_and_cosine_of_all_others():
    angles = np.linspace(-1.0, 1.0, 401)
    found = np.array([small_turn(angle) for angle in angles])
    assert np.abs(found - np.stack([np.sin(angles), np.cos(angles)], axis=1)).max() < 5e-15


def test_box_is_read_linearly_in_time_radius_and_angle():
    radius, angles = np.array([0.0, 30.0, 63.0]), 2 * np.pi * np.arange(12) / 12
    time = np.arange(5) * 0.5
    box = (time[:, None, None] + 0.1 * radius[None, :, None] * np.ones((1, 1, 12))).astype(
        np.float32
    )
    field = Field(time, radius, angles, box, None, None, 10.0, 0.2)
    inflow = steady_inflow(10.0, 5, 0.2, box=field)
    for t, y, z in ((0.6, 10.0, 3.0), (1.9, -40.0, -11.0), (0.0, 0.0, 0.0)):
        got = turbulence(inflow, t, y, z)[0]
        assert got == pytest.approx(t + 0.1 * np.hypot(y, z), abs=1e-4)


def test_box_turns_clockwise_seen_from_upwind():
    # angle π/2 lies to the right looking downwind: y < 0
    angles = 2 * np.pi * np.arange(8) / 8
    box = np.zeros((3, 2, 8), dtype=np.float32)
    box[:, 1, 2] = 1.0
    field = Field(np.arange(3.0), np.array([0.0, 60.0]), angles, box, None, None, 10.0, 0.2)
    inflow = steady_inflow(10.0, 5, 0.2, box=field)
    assert turbulence(inflow, 1.0, -60.0, 0.0)[0] == pytest.approx(1.0)
    assert turbulence(inflow, 1.0, 60.0, 0.0)[0] == pytest.approx(0.0)


def test_machines_that_differ_in_what_lags_alone_share_their_table(monkeypatch):
    """Filled anew, the table of the other machine is the same to the last bit."""
    turbine = load_turbine("nrel-5mw")
    lean = RotorOptions(bend_twist=0.0, air_density=1.1, dynamic_stall=False, skew_factor=0.0)
    full = RotorOptions(dynamic_inflow=True, dynamic_stall=True, bend_twist=0.5)
    one, other = (
        machine(turbine, options)._replace(radius=machine(turbine, options).radius[8:10])
        for options in (lean, full)
    )
    monkeypatch.setattr(tables, "_filled", OrderedDict())
    first = tables.with_table(one).table
    assert tables.with_table(other).table is first
    monkeypatch.setattr(tables, "_filled", OrderedDict())
    again = tables.with_table(other).table
    assert again is not first
    np.testing.assert_array_equal(again, first)
    with_drag = machine(turbine, RotorOptions(drag_in_induction=not lean.drag_in_induction))
    changed = tables.with_table(with_drag._replace(radius=one.radius)).table
    assert not np.array_equal(changed, first)
