"""Load cases, gusts and the winds made from them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.wind import (
    LOAD_CASES,
    CoherenceFactors,
    Machine,
    PolarGrid,
    WindOptions,
    case_seed,
    coherence_factors,
    conditions,
    gust_field,
    gusts,
    iec,
    inflow,
    polar_angles,
)

NREL_5MW = Machine(cut_in=3.0, rated=11.4, cut_out=25.0, rotor_diameter=126.0, hub_height=90.0)
COARSE = WindOptions(category="A", radii=3, angles=8, step=0.25, seeds=1)


# -- table and expansion -------------------------------------------------------------------------


def test_dlc_1_1_is_the_load_database_of_the_source():
    cases = conditions("1.1", NREL_5MW, WindOptions(category="B"))
    assert len(cases) == 66
    assert sorted({c.wind_speed for c in cases}) == list(range(4, 25, 2))
    assert {c.duration for c in cases} == {600.0}
    assert cases[0].safety_factor == 1.25
    # bins of 2 m/s from 3 to 25 m/s, class I
    share = iec.weibull_cdf(25.0, 10.0) - iec.weibull_cdf(3.0, 10.0)
    assert sum(c.weight for c in cases) == pytest.approx(share)


@pytest.mark.parametrize(
    ("dlc", "count", "speeds"),
    [
        ("1.4", 6, [9.4, 11.4, 13.4]),
        ("1.5", 44, list(range(4, 25, 2))),
        ("2.3", 16, [9.4, 11.4, 13.4, 25.0]),
        ("3.3", 40, [3.0, 9.4, 11.4, 13.4, 25.0]),
        ("5.1", 48, [9.4, 11.4, 13.4, 25.0]),
        ("6.1", 12, [50.0]),
        ("6.2", 24, [50.0]),
        ("6.3", 12, [40.0]),
        ("6.4", 102, list(range(2, 36, 2))),
    ],
)
def test_speeds_and_number_of_conditions(dlc, count, speeds):
    cases = conditions(dlc, NREL_5MW)
    assert len(cases) == count
    assert sorted({c.wind_speed for c in cases}) == pytest.approx(speeds)


def test_safety_factors_follow_the_kind_of_case():
    for row in LOAD_CASES.values():
        assert (row.safety_factor == 1.0) == (row.kind == "F")
    assert LOAD_CASES["1.3"].safety_factor == 1.35
    assert LOAD_CASES["6.2"].safety_factor == 1.1


@pytest.mark.parametrize("dlc", LOAD_CASES)
def test_every_load_case_makes_a_finite_wind(dlc):
    condition = conditions(dlc, NREL_5MW, COARSE, duration=80.0)[-1]
    field = inflow(condition, NREL_5MW, COARSE)
    assert field.time[-1] >= 80.0
    assert all(np.isfinite(x).all() for x in (field.u, field.v, field.w) if x is not None)
    assert (field.u.std() > 0) == (condition.wind != "NWP")


def test_options_reach_the_conditions():
    own = WindOptions(
        wind_class="S", v_ref=45.0, v_ave=9.0, category="S", reference_intensity=0.15,
        shear_exponent=0.14, speed_step=4.0, seeds=2,
    )  # fmt: skip
    cases = conditions("1.3", NREL_5MW, own)
    assert [c.wind_speed for c in cases[::2]] == [4.0, 8.0, 12.0, 16.0, 20.0, 24.0]
    sigma = iec.etm_sigma(12.0, iec.WindClass("S", 45.0, 9.0), 0.15)
    assert cases[4].sigma == pytest.approx(sigma)
    assert cases[0].shear_exponent == 0.14
    assert conditions("6.1", NREL_5MW, own)[0].shear_exponent == 0.11
    one = conditions("1.1", NREL_5MW, own, wind_speeds=[11.4], yaw_errors=[0.1], duration=60.0)
    assert [(c.wind_speed, c.yaw_error, c.duration) for c in one] == [(11.4, 0.1, 60.0)] * 2


def test_the_example_of_the_documentation_runs():
    text = (Path(__file__).parents[2] / "docs" / "wind.md").read_text(encoding="utf-8")
    example = text.split("```python\n")[1].split("```")[0]
    names: dict = {}
    exec(example, names)
    assert len(names["everything"]) == 66
    assert names["field"].u.shape == (6001, 11, 48)


# -- seeds ---------------------------------------------------------------------------------------


def test_no_two_conditions_of_the_whole_set_share_a_seed():
    states = set()
    count = 0
    for dlc in LOAD_CASES:
        for c in conditions(dlc, NREL_5MW):
            states.add(tuple(case_seed(c.dlc, c.wind_speed, c.index).generate_state(4)))
            count += 1
    assert len(states) == count


def test_seeds_are_the_same_in_every_process():
    # a fixed number: a change of it changes every series that was ever made
    assert case_seed("1.1", 12.0, 1).generate_state(1)[0] == 1798477470
    assert case_seed("1.1", 12.0, 1, base=1).generate_state(1)[0] != 1798477470


def test_a_condition_gives_the_same_wind_whatever_ran_before():
    condition = conditions("1.1", NREL_5MW, COARSE, duration=60.0)[3]
    factors = coherence_factors(NREL_5MW, COARSE)
    alone = inflow(condition, NREL_5MW, COARSE)
    inflow(replace(condition, wind_speed=20.0), NREL_5MW, COARSE, factors=factors)
    again = inflow(condition, NREL_5MW, COARSE, factors=factors)
    np.testing.assert_array_equal(alone.u, again.u)
    np.testing.assert_array_equal(alone.w, again.w)
    other = inflow(condition, NREL_5MW, COARSE, seed=1)
    assert not np.array_equal(alone.u, other.u)


# -- gusts ---------------------------------------------------------------------------------------


def test_operating_gust_dips_peaks_and_passes():
    t = np.linspace(-5.0, 15.0, 20001)
    gust = gusts.operating_gust(t, 10.0)
    assert gust.max() == pytest.approx(7.4)  # 0.37 * 2
    assert t[gust.argmax()] == pytest.approx(10.5 / 2)
    assert gust.min() == pytest.approx(-2.6806, abs=1e-4)
    np.testing.assert_allclose(gust[(t < 0) | (t > 10.5)], 0, atol=1e-12)


def test_direction_changes_stay():
    assert gusts.direction_change([-1.0, 0.0, 3.0, 6.0, 60.0], -0.6) == pytest.approx(
        [0, 0, -0.3, -0.6, -0.6]
    )
    rise, turn = gusts.coherent_gust([0.0, 5.0, 10.0, 60.0], 1.0)
    assert rise == pytest.approx([0, 7.5, 15, 15])
    assert turn == pytest.approx([0, 0.5, 1, 1])


def test_vertical_shear_adds_twice_the_bracket_over_the_rotor_at_its_peak():
    condition = conditions("1.5", NREL_5MW, COARSE, wind_speeds=[12.0])[0]
    field = inflow(condition, NREL_5MW, COARSE)
    peak = np.argmin(abs(field.time - condition.gust_time - 6.0))
    top, bottom = field.u[peak, -1, 0], field.u[peak, -1, 4]
    bracket = iec.ews_amplitude(12.0, "A", 126.0, 90.0)
    assert top - bottom == pytest.approx(2 * bracket, rel=1e-4)
    assert field.hub[peak] == pytest.approx(0, abs=1e-6)


def test_signs_of_the_horizontal_shear():
    plus, minus = conditions("1.5", NREL_5MW, COARSE, wind_speeds=[12.0])[2:]
    assert plus.horizontal
    assert minus.gust == -plus.gust
    field = inflow(plus, NREL_5MW, COARSE)
    peak = np.argmin(abs(field.time - plus.gust_time - 6.0))
    # angle 90° is to the right when looking downwind, y < 0
    assert field.y[-1, 2] == pytest.approx(-63.0)
    assert field.u[peak, -1, 2] < -1 < 1 < field.u[peak, -1, 6]


@given(st.floats(-3, 3), st.floats(0, 20), st.floats(5, 25))
def test_turning_wind_keeps_its_speed(angle, rise, speed):
    angles, radius = polar_angles(6), np.array([0.0, 50.0])
    field = gust_field([0.0, 1.0], radius, angles, speed, 90.0, 0.2, rise=rise, direction=angle)
    mean = speed * (1 + field.z / 90.0) ** 0.2
    v = 0.0 if field.v is None else field.v
    np.testing.assert_allclose(np.hypot(mean + field.u, v)[0], mean + rise, rtol=1e-5)


def test_coherent_gust_of_both_signs():
    plus, minus = conditions("1.4", NREL_5MW, COARSE, wind_speeds=[12.0])
    a, b = inflow(plus, NREL_5MW, COARSE), inflow(minus, NREL_5MW, COARSE)
    np.testing.assert_array_equal(a.u, b.u)
    np.testing.assert_array_equal(a.v, -b.v)
    # V_hub + 15 m/s turned by 60°
    assert a.hub[-1] == pytest.approx(27 * np.cos(np.pi / 3) - 12, rel=1e-5)
    assert a.v[-1, 0, 0] == pytest.approx(27 * np.sin(np.pi / 3), rel=1e-5)


# -- refusals ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: conditions("9.9", NREL_5MW), "'9.9' is unknown"),
        (lambda: WindOptions(wind_class="S"), "class 'S'"),
        (lambda: WindOptions(v_ref=50.0), "v_ref = 50"),
        (lambda: WindOptions(category="S"), "reference_intensity"),
        (lambda: WindOptions(step=-0.1), "step = -0.1"),
        (lambda: WindOptions(radii=1), "radii = 1"),
        (lambda: Machine(25.0, 11.4, 3.0, 126.0, 90.0), "cut_in = 25"),
        (lambda: Machine(3.0, 11.4, 25.0, 200.0, 90.0), "reaches the ground"),
        (lambda: case_seed("1.1", -1.0, 0), "wind speed = -1"),
        (lambda: case_seed("1.1", 1.0, -1), "index = -1"),
        (lambda: polar_angles(2), "at least 3"),
        (lambda: PolarGrid(np.array([1.0, 2.0]), polar_angles(4)), "rise from 0"),
        (lambda: PolarGrid(np.array([0.0, 2.0]), np.array([0.0, 1.0, 2.0])), "equidistant"),
        (lambda: CoherenceFactors(PolarGrid(np.array([0.0, 2.0]), polar_angles(4)), 42, 1), "knot"),
        (
            lambda: gust_field([0.0, 1.0], [0.0, 95.0], polar_angles(4), 10.0, 90.0),
            "reaches the ground",
        ),
    ],
)
def test_nonsense_is_refused(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_steady_storms_come_from_where_their_turbulent_ones_may():
    """Without the grid from all sides; ±15° otherwise and ±30° where the yaw error is extreme."""
    found = {
        dlc: np.degrees([c.yaw_error for c in conditions(dlc, NREL_5MW, steady=True)])
        for dlc in ("6.1", "6.2", "6.3")
    }
    np.testing.assert_allclose(found["6.1"], [-15.0, 15.0])
    np.testing.assert_allclose(found["6.2"], np.arange(-165.0, 181.0, 15.0))
    np.testing.assert_allclose(found["6.3"], [-30.0, 30.0])
