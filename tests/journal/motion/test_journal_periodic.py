"""Closed orbits, adaptive steps, and the mass that an orbit moves."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    ConstantFlow,
    GasMixture,
    Groove,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
)
from loadflow.journal.solvers.motion import periodic
from loadflow.tribology.film import effective_speed

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(0.05)
OMEGA = 1.2
GRID = (36, 8)
MIXTURE = {"lubricant": OIL, "cavitation": GasMixture(5e4), "edge_pressure": 5e5, "grid": GRID}
FILLED = {"lubricant": OIL, "cavitation": MassConserving(), "edge_pressure": 5e5, "grid": GRID}
SHARP = {"lubricant": OIL, "cavitation": Reynolds(), "grid": GRID}
FILMS = pytest.mark.parametrize(
    "film", [MIXTURE, FILLED, SHARP], ids=["mixture", "mass-conserving", "reynolds"]
)


def pulsating(period, count=32):
    time = np.linspace(0.0, period, count + 1)
    turn = 2 * np.pi * time / period
    return time, np.stack([2e6 + 5e5 * np.sin(turn), 4e5 * np.cos(turn)], axis=-1)


@pytest.mark.parametrize("film", [MIXTURE, SHARP], ids=["mixture", "reynolds"])
def test_direct_and_marching_find_the_same_closed_orbit(film):
    time, force = pulsating(2 * np.pi / OMEGA)
    direct = BEARING.orbit(time, force, OMEGA, periodic=True, **film)
    marched = BEARING.orbit(time, force, OMEGA, periodic="marching", **film)
    np.testing.assert_allclose(
        direct.eccentricity, marched.eccentricity, atol=1e-4 * BEARING.clearance
    )
    assert direct.attrs["closure"] < 1e-6
    assert direct.attrs["periods"] <= marched.attrs["periods"]
    np.testing.assert_array_equal(direct.eccentricity[0], direct.eccentricity[-1])


FULL = {"lubricant": OIL, "cavitation": Sommerfeld(), "grid": GRID}


def test_a_whirl_that_a_full_film_does_not_damp_is_closed_at_all_times_at_once():
    time, force = pulsating(2 * np.pi / OMEGA, 24)
    with pytest.raises(SolverError, match=r"its ends differ by .* after 20 periods"):
        BEARING.orbit(time, force, OMEGA, periodic="marching", max_periods=20, **FULL)
    closed = BEARING.orbit(time, force, OMEGA, periodic=True, **FULL)
    assert closed.attrs["periods"] == 3
    assert float(closed.residual.max()) < 1e-10
    np.testing.assert_array_equal(closed.eccentricity[0], closed.eccentricity[-1])


def test_an_orbit_to_which_no_period_leads_is_reached_by_a_load_that_begins_to_swing(monkeypatch):
    time = np.linspace(0.0, 3 * 2 * np.pi / OMEGA, 25)
    turn = 2 * np.pi * time / time[-1]
    force = 3e7 * np.stack([1 + 0.5 * np.sin(turn), 0.2 * np.cos(turn)], axis=-1)
    film = FULL | {"grid": (48, 8)}
    orbit = BEARING.orbit(time, force, OMEGA, periodic=True, **film)
    assert (orbit.attrs["periods"], orbit.attrs["closure"]) == (3, 0.0)
    assert float(orbit.residual.max()) < 1e-10
    monkeypatch.setattr(periodic, "solve_by_swing", lambda *_: None)
    with pytest.raises(SolverError, match="does not close"):
        BEARING.orbit(time, force, OMEGA, periodic=True, max_periods=5, **film)


@pytest.mark.parametrize("law", [Sommerfeld(), Reynolds()], ids=["full", "ruptured"])
def test_orbits_closed_at_once_are_of_second_order_in_their_steps(law):
    starts = []
    for count in (24, 48, 96, 384):
        time, force = pulsating(0.3 * 2 * np.pi / OMEGA, count)
        orbit = BEARING.orbit(time, force, OMEGA, periodic=True, **FULL | {"cavitation": law})
        assert (orbit.attrs["closure"], orbit.attrs["periods"]) == (0.0, 3)
        starts.append(orbit.eccentricity.values[0] / BEARING.clearance)
    errors = [np.hypot(*(one - starts[-1])) for one in starts[:-1]]
    # the finest leaves 1/256, 1/64, 1/16 of them
    ratios = np.array(errors[:-1]) / errors[1:] * [(1 - 1 / 64) / (1 - 1 / 256), 15 / 16 * 64 / 63]
    assert np.abs(np.log2(ratios) - 2).max() < 0.2


def test_uneven_times_close_at_once_on_the_orbit_of_even_ones():
    period = 2 * np.pi / OMEGA
    even, force = pulsating(period, 96)
    share = even / period
    time = period * (share + 0.05 * np.sin(2 * np.pi * share))
    turn = 2 * np.pi * time / period
    uneven = np.stack([2e6 + 5e5 * np.sin(turn), 4e5 * np.cos(turn)], axis=-1)
    paths = [
        BEARING.orbit(t, f, OMEGA, periodic=True, **FULL)
        for t, f in ((even, force), (time, uneven))
    ]
    along = [np.interp(even, time, part) for part in paths[1].eccentricity.values.T]
    np.testing.assert_allclose(
        np.stack(along, axis=-1), paths[0].eccentricity, atol=2e-3 * BEARING.clearance
    )


def test_one_more_period_from_a_closed_orbit_stays_on_it():
    # the first step of an orbit is of first order, hence small steps
    time, force = pulsating(2 * np.pi / OMEGA, 128)
    closed = BEARING.orbit(time, force, OMEGA, periodic=True, **SHARP)
    again = BEARING.orbit(time, force, OMEGA, start=closed.eccentricity.values[0], **SHARP)
    np.testing.assert_allclose(
        again.eccentricity, closed.eccentricity, atol=2e-3 * BEARING.clearance
    )


def test_a_fast_load_is_closed_directly_where_marching_takes_too_long():
    # the fill is carried round with half the shaft's speed: ten periods of the load a revolution
    time, force = pulsating(0.1 * 2 * np.pi / OMEGA, 24)
    orbit = BEARING.orbit(time, force, OMEGA, periodic="direct", max_periods=20, **MIXTURE)
    assert orbit.attrs["closure"] < 1e-6
    with pytest.raises(
        SolverError, match=r"does not close: its ends differ by .* after 20 periods"
    ):
        BEARING.orbit(time, force, OMEGA, periodic="marching", max_periods=20, **MIXTURE)


@pytest.mark.parametrize("film", [MIXTURE, FILLED], ids=["mixture", "mass-conserving"])
def test_a_closed_orbit_keeps_its_mass(film):
    time, force = pulsating(2 * np.pi / OMEGA)
    orbit = BEARING.orbit(time, force, OMEGA, periodic=True, **film)
    assert abs(orbit.attrs["mass_balance"]) < 1e-6
    # the condition of Reynolds does not keep mass, and says so
    sharp = BEARING.orbit(time, force, OMEGA, periodic=True, **SHARP)
    assert abs(sharp.attrs["mass_balance"]) > 0.1


@pytest.mark.parametrize("share", [1.0, 0.25, -0.5])
def test_a_rotating_load_is_carried_as_at_rest_at_the_effective_speed(share):
    turning = share * OMEGA
    time = np.linspace(0.0, 2 * np.pi / abs(turning), 97)
    force = 2e6 * np.stack([np.cos(turning * time), np.sin(turning * time)], axis=-1)
    film = {"lubricant": OIL, "cavitation": Reynolds(), "grid": (48, 12)}
    orbit = BEARING.orbit(time, force, OMEGA, periodic=True, **film)
    effective = effective_speed(OMEGA, load=turning)
    rest = BEARING.equilibrium((2e6, 0.0), effective, **film)
    np.testing.assert_allclose(orbit.eccentricity_ratio, rest.eccentricity_ratio, atol=3e-3)


@pytest.mark.parametrize("film", [MIXTURE, SHARP], ids=["mixture", "reynolds"])
def test_half_speed_whirl_is_named(film):
    turning = 0.5 * OMEGA
    time = np.linspace(0.0, 2 * np.pi / turning, 61)
    force = 2e6 * np.stack([np.cos(turning * time), np.sin(turning * time)], axis=-1)
    with pytest.raises(SolverError, match=r"half-speed whirl: a load of 2e\+06 N turns at 0.6"):
        BEARING.orbit(time, force, OMEGA, periodic=True, **film)


def test_pockets_carry_a_load_that_whirls_at_half_speed():
    turning = 0.5 * OMEGA
    time = np.linspace(0.0, 2 * np.pi / turning, 61)
    force = 5e5 * np.stack([np.cos(turning * time), np.sin(turning * time)], axis=-1)
    pockets = [
        Groove(angle, arc=0.6, length=1.0, restrictor=ConstantFlow(2e-3))
        for angle in (0.0, np.pi / 2, np.pi, -np.pi / 2)
    ]
    orbit = BEARING.orbit(time, force, OMEGA, periodic=True, supply=Supply(pockets), **MIXTURE)
    assert float(orbit.eccentricity_ratio.max()) < 0.9
    assert orbit.groove_pressure.dims == ("time", "groove")


def test_oscillating_speed_without_a_mean_carries_by_wedge_and_squeeze():
    time = np.linspace(0.0, 4.0, 65)
    speed = OMEGA * np.cos(2 * np.pi * time / 4.0)
    force = np.tile([4e5, 0.0], (65, 1))
    orbit = BEARING.orbit(time, force, speed, periodic=True, closure=1e-4, **SHARP)
    assert 0.85 < float(orbit.eccentricity_ratio.max()) < 0.97
    # the film takes no side: after half a period the path is mirrored
    mirrored = orbit.eccentricity.values[32:] * [1, -1]
    np.testing.assert_allclose(mirrored, orbit.eccentricity[:33], atol=1e-3 * BEARING.clearance)


@FILMS
def test_adaptive_steps_meet_their_tolerance_where_given_ones_are_too_long(film):
    time = np.linspace(0.0, 8.0, 17)
    force = np.tile([1.5e6, 0.0], (17, 1))
    force[7:] = [-2.5e6, 1.5e6]
    fine = np.linspace(0.0, 8.0, 16 * 50 + 1)
    between = np.stack([np.interp(fine, time, part) for part in force.T], axis=-1)
    exact = BEARING.orbit(fine, between, OMEGA, **film).eccentricity.values[::50]
    errors, steps = [], []
    for options in ({}, {"step": "adaptive"}, {"step": "adaptive", "step_tolerance": 1e-4}):
        orbit = BEARING.orbit(time, force, OMEGA, **film, **options)
        errors.append(np.abs(orbit.eccentricity.values - exact).max() / BEARING.clearance)
        steps.append(int(orbit.steps.sum()) if options else 16)
    assert errors[0] > 0.03 > 3 * errors[1]
    assert errors[2] < errors[1] / 2
    assert steps[0] < steps[1] < steps[2] < 400


def test_start_assistance_lifts_the_shaft_before_it_turns():
    bearing = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
    pocket = Groove(0.0, arc=0.6, length=0.12, restrictor=ConstantFlow(1e-5))
    film = {"edge_pressure": 1e5, "cavitation": GasMixture(1e4), "grid": GRID}
    time = np.linspace(0.0, 2.0, 81)
    speed = 30.0 * np.clip(time - 1.0, 0.0, None)
    force = np.tile([8e3, 0.0], (81, 1))
    start = (0.999 * bearing.clearance, 0.0)
    orbit = bearing.orbit(
        time, force, speed, Lubricant(0.03), supply=Supply([pocket]), start=start, **film
    )
    afloat = bearing.equilibrium((8e3, 0.0), 0.0, Lubricant(0.03), supply=Supply([pocket]), **film)
    at_rest = orbit.eccentricity_ratio.sel(time=1.0)
    assert float(at_rest) == pytest.approx(float(afloat.eccentricity_ratio), abs=0.02)
    assert np.all(np.diff(orbit.eccentricity_ratio[:20]) < 0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"time": [0.0, 1.0, 2.0]}, "a period of 3 samples"),
        ({"force": [[1e6, 0.0]] * 4 + [[2e6, 0.0]]}, "force is .* the last sample must close it"),
        ({"speed": [1.0, 1.0, 1.0, 1.0, 2.0]}, "speed is 1.0 .* the last sample must close it"),
        ({"periodic": "later"}, "periodic = 'later'"),
        ({"periodic": False, "step": "none"}, "step = 'none'"),
        ({"periodic": False, "step": "adaptive", "step_tolerance": 0.0}, "step_tolerance = 0.0"),
    ],
)
def test_bad_periods_are_named(change, message):
    case = {"time": np.arange(5.0), "force": [[1e6, 0.0]] * 5, "speed": 1.0, "periodic": True}
    case |= change
    case["force"] = case["force"][: len(case["time"])]
    with pytest.raises(InputError, match=message):
        BEARING.orbit(**case, **MIXTURE)
