"""Thrust collars through series, tilted, warm and in motion, beside films solved one by one."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    DoubleThrustBearing,
    Film,
    Guembel,
    Lubricant,
    PadHeat,
    Pivot,
    Taper,
    ThrustBearing,
)
from loadflow.journal.thrust.collar_motion import FOLLOWED, backward, rates
from loadflow.journal.thrust.collar_series import CollarSeries
from loadflow.journal.thrust.row_table import (
    DAMPING,
    FLOW,
    FORCE,
    MOMENT_ACROSS,
    MOMENT_ALONG,
    SIDE_FLOW,
    TORQUE,
    RowTable,
)

GRID = (12, 6)
LANDS = ThrustBearing(9, 1.6, 1.9, pad_angle=0.6, taper=8e-5)
TILTING = ThrustBearing(9, 1.6, 1.9, pad_angle=0.6, pivot=Pivot(0.6))
COLLAR = DoubleThrustBearing(LANDS, LANDS, play=6e-4)
FILM = Film(Lubricant(0.15), Guembel(), 1e5, inlet=None, grid=GRID)
WARM = Film(None, Guembel(), 1e5, inlet=None, grid=GRID, heat=PadHeat("iso-vg-68"))
FORCES, SPEEDS = np.array([9e5, -5e5, 3e5, 1.2e6]), np.array([1.2, 1.0, 0.7, 1.27])
TILTS = np.array([[4e-6, 0.0], [0.0, 1e-5], [-8e-6, 1e-5], [2e-5, 1e-5]])
CONTACT = 3.8e-6
ENDS = 0.5 * CONTACT, COLLAR.play
"""Gaps of the tables of this collar; one of the same row between them is made once."""


@pytest.fixture(scope="module")
def tilted():
    return CollarSeries(COLLAR, FILM, CONTACT, tilts=True)


def test_films_around_a_tilted_collar_are_those_of_the_grid(tilted):
    found = tilted.equilibrium(FORCES, SPEEDS, TILTS)
    assert found.converged.all()
    assert not found.touching.any()
    assert found.residual.max() < 1e-9
    for k in range(4):
        exact = COLLAR.equilibrium(FORCES[k], SPEEDS[k], FILM, tilt=TILTS[k])
        assert found.minimum_film[k] == pytest.approx(exact.minimum_film, rel=5e-3)
        assert found.maximum_pressure[k] == pytest.approx(exact.maximum_pressure, rel=0.03)
        assert found.friction_power[k] == pytest.approx(exact.friction_power, rel=3e-3)
        off = np.hypot(*(found.moment[k] - exact.moment))
        assert (
            off
            < 0.02 * exact.restoring_moment
            == pytest.approx(0.02 * found.restoring_moment[k], rel=0.02)
        )


def test_the_moment_of_a_tilted_collar_is_the_slope_of_its_films():
    """For a small tilt the stiffness of both rows against it; it rights the collar."""
    still = COLLAR.equilibrium(9e5, 1.2, FILM)
    tilt = np.array([1e-7, 0.0])
    found = COLLAR.equilibrium(9e5, 1.2, FILM, tilt=tilt)
    stiffness = sum(row.stiffness_matrix for row in (still.front, still.back))[1:, 1:]
    np.testing.assert_allclose(found.moment, stiffness @ tilt, rtol=1e-3)
    assert found.moment @ tilt > 0.0
    assert still.restoring_moment < 1e-9 * found.restoring_moment


def test_a_temperature_that_is_not_found_is_no_answer(monkeypatch):
    series = CollarSeries(COLLAR, WARM, CONTACT)
    assert series.equilibrium(FORCES, SPEEDS).converged.all()
    monkeypatch.setattr("loadflow.journal.thrust.collar_sides.TRIES", 1)
    found = series.equilibrium(FORCES, SPEEDS)
    assert not found.converged.any()
    assert np.isnan(found.temperature).all()


def test_the_stated_error_is_no_less_than_the_true_one(tilted):
    found = tilted.equilibrium(FORCES, SPEEDS, TILTS)
    exact = [COLLAR.equilibrium(f, w, FILM, tilt=t) for f, w, t in zip(FORCES, SPEEDS, TILTS)]
    for name in ("minimum_film", "maximum_pressure", "friction_power"):
        true = np.array([getattr(one, name) for one in exact])
        assert np.abs(getattr(found, name) / true - 1).max() <= found.interpolation_error
    moment = np.array([one.moment for one in exact])
    off = np.linalg.norm(found.moment - moment, axis=1) / np.linalg.norm(moment, axis=1)
    assert off.max() <= found.moment_error < 0.06
    assert found.interpolation_error < 0.04
    assert tilted.equilibrium(FORCES, SPEEDS).moment_error == 0.0


@pytest.mark.parametrize("row", [LANDS, TILTING])
@pytest.mark.parametrize("share", [1e-3, 0.03, 0.3])
def test_the_errors_of_a_table_have_that_of_its_moments(row, share):
    """Beside the grid, whose pads stay as they follow; at 5e-5 m both carry all round."""
    table = RowTable(row, GRID, *ENDS, tilts=True)
    slope, angle = share * 5e-5 / 1.9, 1.0
    exact = row.pressure(5e-5, 1.2, FILM, tilt=(slope * math.sin(angle), -slope * math.cos(angle)))
    found = table.sums(*(np.array([each]) for each in (5e-5, slope, angle)))
    across, along = 0.15 * 1.2 * found[[MOMENT_ACROSS, MOMENT_ALONG], 0]
    cos, sin = math.cos(angle), math.sin(angle)
    moment = np.array([cos * across - sin * along, sin * across + cos * along])
    off = np.linalg.norm(moment - exact.moment) / np.linalg.norm(exact.moment)
    assert 0.0 < off <= table.errors(FILM, 1.2, 0.3)[1] < 0.06
    assert table.errors(FILM, 1.2, 0.0)[1] == 0.0


def test_pads_that_follow_the_runner_lose_less_film_to_its_tilt():
    table = RowTable(TILTING, GRID, *ENDS, tilts=True)
    slope, angle = 0.1 * 5e-5 / 1.9, 1.0
    tilt = slope * np.array([math.sin(angle), -math.cos(angle)])
    exact = TILTING.pressure(5e-5, 1.2, FILM, tilt=tilt)
    at = np.array([5e-5]), np.array([slope]), np.array([angle])
    sums, drag = table.sums(*at)[:, 0], 0.15 * 1.2
    assert sums[FORCE] * drag == pytest.approx(exact.force, rel=1e-3)
    assert sums[DAMPING] * 0.15 == pytest.approx(exact.damping, rel=5e-3)
    assert sums[TORQUE] * drag == pytest.approx(exact.friction_torque, rel=1e-3)
    assert sums[FLOW] * 1.2 == pytest.approx(exact.flow, rel=1e-3)
    assert sums[SIDE_FLOW] * 1.2 == pytest.approx(exact.side_flow.sum(), rel=1e-3)
    pressure = exact.maximum_pressure - 1e5
    assert table.pressure(*at)[0] * drag == pytest.approx(pressure, rel=5e-3)
    assert table.minimum_film(*at)[0] == pytest.approx(exact.minimum_film, rel=2e-3)
    fixed = RowTable(LANDS, GRID, *ENDS, tilts=True)
    aligned = at[0], np.zeros(1), at[2]
    lost = [1 - one.minimum_film(*at)[0] / one.minimum_film(*aligned)[0] for one in (fixed, table)]
    assert lost[1] < lost[0]


@pytest.mark.parametrize("share", [1e-3, 1e-2, 0.1])
def test_all_pads_carry_a_tilted_runner_whatever_its_gap(share):
    """Force times gap² is one number; pads that lie flat and carry nothing are another answer."""
    found = [
        gap**2 * TILTING.pressure(gap, 1.2, FILM, tilt=(0.0, -share * gap / 1.9)).force
        for gap in (5e-5, 2e-4, 2.5e-4, 3e-4, 5e-4)
    ]
    np.testing.assert_allclose(found, found[0], rtol=1e-6)


def test_each_sample_at_rest_has_the_heat_balance_of_the_grid():
    found = CollarSeries(COLLAR, WARM, CONTACT).equilibrium(FORCES, SPEEDS)
    for k in range(4):
        exact = COLLAR.equilibrium(FORCES[k], SPEEDS[k], WARM)
        assert found.front_temperature[k] == pytest.approx(exact.front.temperature, abs=2e-3)
        assert found.back_temperature[k] == pytest.approx(exact.back.temperature, abs=2e-3)
        assert found.minimum_film[k] == pytest.approx(exact.minimum_film, rel=1e-3)
        assert found.friction_power[k] == pytest.approx(exact.friction_power, rel=1e-3)


def test_heat_and_tilt_go_together(tilted):
    both = CollarSeries(COLLAR, WARM, CONTACT, tilts=True).equilibrium(FORCES, SPEEDS, TILTS)
    exact = COLLAR.equilibrium(FORCES[3], SPEEDS[3], WARM, tilt=TILTS[3])
    assert both.minimum_film[3] == pytest.approx(exact.minimum_film, rel=5e-3)
    assert both.temperature[3] == pytest.approx(exact.front.temperature, abs=0.05)


# --- in motion ------------------------------------------------------------------------------------

TIMES = np.linspace(0.0, 4.0, 161)
SWING = 6e5 * (1.0 + 0.6 * np.sin(2 * np.pi * 0.6 * TIMES))


def test_a_swinging_thrust_moves_the_collar_as_the_orbit_of_its_row():
    wide = DoubleThrustBearing(LANDS, LANDS, play=6e-3)  # the other row is far away
    found = CollarSeries(wide, FILM, CONTACT).path(TIMES, SWING, 1.2)
    orbit = LANDS.orbit(TIMES, SWING, 1.2, FILM)
    assert found.converged.all()
    assert found.residual.max() < 1e-8
    np.testing.assert_allclose(found.gap, orbit.gap.values, rtol=2e-3)
    np.testing.assert_allclose(found.maximum_pressure, orbit.maximum_pressure.values, rtol=0.03)
    still = CollarSeries(wide, FILM, CONTACT).equilibrium(SWING, 1.2)
    assert np.ptp(found.gap) < 0.8 * np.ptp(still.gap)


def test_steps_are_of_second_order():
    series = CollarSeries(COLLAR, FILM, CONTACT)

    def last(count):
        time = np.linspace(0.0, 2.0, count + 1)
        load = 6e5 * (1.0 + 0.3 * np.sin(2 * np.pi * 0.6 * time) ** 2)
        return series.path(time, load, 1.2).gap[-1]

    coarse, middle, fine = last(160), last(320), last(640)
    assert math.log2(abs(coarse - middle) / abs(middle - fine)) == pytest.approx(2.0, abs=0.3)


def test_slow_loads_are_followed_as_at_rest():
    series = CollarSeries(COLLAR, FILM, CONTACT)
    found, still = series.path(1e3 * TIMES, SWING, 1.2), series.equilibrium(SWING, 1.2)
    np.testing.assert_allclose(found.gap, still.gap, rtol=1e-3)
    np.testing.assert_allclose(found.minimum_film, still.minimum_film, rtol=1e-3)


def test_a_violent_load_is_followed_from_one_row_to_the_other(tilted):
    rng = np.random.default_rng(0)
    load = np.repeat(rng.uniform(-1.2e6, 1.2e6, 40), 10)
    time, turned = 0.025 * np.arange(load.size), np.tile([4e-6, -3e-6], (load.size, 1))
    found = tilted.path(time, load, 1.2, turned)
    assert found.converged.all()
    assert found.residual.max() < 1e-8
    still = tilted.equilibrium(load, 1.2, turned)
    assert still.gap.min() * 0.99 < found.gap.min() < found.gap.max() < still.gap.max() * 1.01


def test_a_collar_that_stands_sinks_by_squeeze_alone():
    """h⁻² grows evenly under a constant load; a row alone, of flat pads."""
    flat = ThrustBearing(9, 1.6, 1.9, pad_angle=0.6, profile=Taper(8e-5))
    collar = DoubleThrustBearing(flat, flat, play=6e-3)
    speed = np.where(TIMES < 0.05, 1.2, 0.0)
    found = CollarSeries(collar, FILM, CONTACT).path(TIMES, 6e5 + 0 * TIMES, speed)
    assert found.converged.all()
    assert np.all(np.diff(found.gap[4:]) < 0)
    ends = [CollarSeries(collar, FILM, CONTACT)._table(flat).sums(g, 0 * g, 0 * g)[DAMPING] * 0.15
            for g in (found.gap[100:102],)]  # fmt: skip
    sinks = -(found.gap[101] - found.gap[99]) / (TIMES[101] - TIMES[99])
    assert ends[0][0] * sinks == pytest.approx(6e5, rel=1e-3)


def test_a_path_has_the_temperatures_of_its_mean_friction():
    series = CollarSeries(COLLAR, WARM, CONTACT)
    found = series.path(TIMES, SWING, 1.2)
    assert np.ptp(found.front_temperature) == 0.0 == np.ptp(found.back_temperature)
    each = series.equilibrium(SWING, 1.2)
    low, high = each.front_temperature.min(), each.front_temperature.max()
    assert low < found.front_temperature[0] < high
    constant = series.path(TIMES, 6e5 + 0 * TIMES, 1.2)
    alone = series.equilibrium([6e5], 1.2)
    assert constant.front_temperature[0] == pytest.approx(alone.front_temperature[0], abs=1e-4)


def test_each_step_closes_the_balance_of_forces_and_is_as_of_many_steps_in_one_newton():
    """Warm, tilted, from one row to the other; values are those of the former method."""
    wave = np.sin(2 * np.pi * 0.35 * TIMES)
    tilts = 2e-5 * np.column_stack([wave, 0.5 + 0.4 * wave])
    loads, speeds = 1.5 * SWING * np.sin(2 * np.pi * 0.2 * TIMES), 1.2 + 0.1 * wave
    series = CollarSeries(COLLAR, WARM, CONTACT, tilts=True)
    found = series.path(TIMES, loads, speeds, tilts)
    assert found.converged.all()
    assert found.residual.max() < FOLLOWED
    assert found.iterations.max() < 12
    for name, former in FORMER.items():
        np.testing.assert_allclose(getattr(found, name)[PINNED], former, rtol=1e-6)
    weights = backward(TIMES)
    pressed, slope = [], np.hypot(*tilts.T)
    turned = np.arctan2(tilts[:, 0], -tilts[:, 1])
    for temperature, gap, way in (
        (found.front_temperature[0], found.gap, 0.0),
        (found.back_temperature[0], COLLAR.play - found.gap, math.pi),
    ):
        sums = series._table(LANDS).sums(gap, slope, turned + way)
        viscosity = WARM.heat.lubricant(temperature).viscosity
        force = viscosity * (speeds * sums[FORCE] - sums[DAMPING] * rates(gap, weights))
        pressed.append(np.maximum(force, 0.0))
    largest = np.maximum(*pressed)
    assert np.abs(pressed[0] - pressed[1] - loads)[2:].max() < 3e-8 * largest.max()


PINNED = [0, 20, 61, 100, 160]
FORMER = {
    "gap": [2.96339142e-4, 1.31915226e-4, 9.9468644e-5, 9.61885072e-5, 5.16277494e-4],
    "minimum_film": [2.77430552e-4, 8.49549105e-5, 8.17620105e-5, 6.80884509e-5, 4.80631393e-5],
    "maximum_pressure": [123507.018, 1705928.79, 967982.063, 266485.987, 3127081.84],
    "friction_power": [3690.09898, 5937.3968, 5748.77775, 5468.00749, 8009.57338],
    "front_temperature": [318.117136] * 5,
}


# --- what has no answer ---------------------------------------------------------------------------


def test_loads_beyond_what_a_film_carries_touch_and_the_rest_stays(tilted):
    found = tilted.equilibrium([1e9, 5e5, 5e5], [1.2, 0.0, 1.2])
    assert found.touching.tolist() == [True, True, False]
    assert found.converged.tolist() == [False, False, True]
    assert np.isnan(found.minimum_film[:2]).all()


def test_pads_on_springs_and_tilts_that_were_not_said_are_refused():
    soft = ThrustBearing(9, 1.6, 1.9, pad_angle=0.6, pivot=Pivot(stiffness=1e9))
    with pytest.raises(InputError, match="supports that give way"):
        CollarSeries(DoubleThrustBearing(soft, soft, play=6e-4), FILM, CONTACT)
    with pytest.raises(InputError, match="tilt"):
        CollarSeries(COLLAR, FILM, CONTACT).equilibrium(FORCES, SPEEDS, TILTS)
    backward = ThrustBearing(9, 1.6, 1.9, pad_angle=0.6, profile=Taper(8e-5).reversed)
    with pytest.raises(SolverError, match="carries no load"):
        CollarSeries(DoubleThrustBearing(backward, LANDS, 6e-4), FILM, CONTACT).equilibrium(
            FORCES, SPEEDS
        )
