"""Life rules: tables, spectra, oscillation, and what they refuse."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.rolling import friction, rating_life_spectrum
from loadflow.rolling.rating import capacity, life, safety


@pytest.mark.parametrize(
    ("gamma", "degrees", "value"),
    [
        (0.014886, 45, 46.79),
        (0.01, 60, 39.2),
        (0.11, 45, 81.0),
        (0.05, 52.5, 64.95),
        (0.1, 75, 70.7),
    ],
)
def test_capacity_factor_is_linear_in_its_table(gamma, degrees, value):
    assert capacity.capacity_factor(gamma, math.radians(degrees)) == pytest.approx(value, abs=0.01)


@pytest.mark.parametrize(("gamma", "degrees"), [(0.005, 45), (0.31, 45), (0.25, 60), (0.05, 40)])
def test_capacity_factor_refuses_what_is_outside_its_table(gamma, degrees):
    with pytest.raises(InputError, match="tabulated"):
        capacity.capacity_factor(gamma, math.radians(degrees))


def test_capacity_of_open_grooves_is_refused():
    with pytest.raises(InputError, match="groove_radius"):
        capacity.slewing_capacity(balls=129, rows=2, ball_diameter=0.04, pitch_diameter=1.9,
                                  contact_angle=math.pi / 4, groove_radius=0.022)  # fmt: skip


@given(st.lists(st.floats(0, 1e7), min_size=1, max_size=20), st.floats(1, 5))
def test_spectrum_load_lies_between_mean_and_maximum(loads, exponent):
    value = life.spectrum_load(loads, np.ones(len(loads)), exponent)
    assert np.mean(loads) * (1 - 1e-9) <= value <= max(loads) * (1 + 1e-9)


def test_spectrum_life_adds_damage():
    load, turns = np.array([1e5, 2e5, 0.0]), np.array([3.0, 1.0, 6.0])
    damage = (turns / 10 / (1e6 / np.maximum(load, 1e-9)) ** 3).sum()
    assert rating_life_spectrum(1e6, load, turns) == pytest.approx(1 / damage)


def test_spectrum_over_one_axis():
    load = np.arange(1.0, 7).reshape(2, 3)
    both = life.spectrum_load(load, np.ones(3), axis=1)
    assert both == pytest.approx([float(life.spectrum_load(row, np.ones(3))) for row in load])


@pytest.mark.parametrize("weight", [[0, 0], [-1, 2]])
def test_spectrum_weights_must_make_sense(weight):
    with pytest.raises(InputError, match="weight"):
        life.spectrum_load([1, 2], weight)


def test_amplitude_definition_changes_the_travel_fourfold():
    travel = life.oscillation_speed(1.0, 0.01)
    assert life.oscillation_speed(1.0, 0.01, "half") == pytest.approx(4 * travel)
    with pytest.raises(InputError, match="definition"):
        life.oscillation_speed(1.0, 0.01, "peak")  # type: ignore[arg-type]


def test_both_rules_of_the_amplitude_exponent():
    rows = {"load": [1e6, 2e6], "frequency": [1, 1], "time": [0.5, 0.5], "amplitude": [0.1, 0.4]}
    printed = life.oscillation_load(**rows, critical=0.2)
    swapped = life.oscillation_load(**rows, critical=0.2, rule="rumbarger")
    plain = life.oscillation_load(**rows)
    weight = np.array([0.1, 0.4**0.9])
    expected = np.cbrt((np.array([1e6, 2e6]) ** 3 * weight).sum() / weight.sum())
    assert printed == pytest.approx(expected)
    assert swapped < plain < printed


def test_the_critical_amplitude_is_compared_with_the_whole_path():
    rows = {"load": [1e6, 2e6], "frequency": [1, 1], "time": [0.5, 0.5]}
    path = np.array([0.1, 0.4])
    for rule in ("as-printed", "rumbarger"):
        travel = life.oscillation_load(**rows, amplitude=path, critical=0.2, rule=rule)
        half = life.oscillation_load(
            **rows, amplitude=path / 4, critical=0.2, rule=rule, definition="half"
        )
        assert half == pytest.approx(travel, rel=1e-14)
    with pytest.raises(InputError, match="rule"):
        life.oscillation_load(**rows, amplitude=path, rule="harris")  # type: ignore[arg-type]


def test_critical_path_is_twice_the_angle_between_two_balls_seen_from_the_ring():
    # neighbouring rolled zones meet once the ring turns by 2π/u_j from end to end
    ends = 2 * math.pi / life.overrollings(129, 0.0149)
    assert life.critical_amplitude(129, 0.0149) == pytest.approx(2 * ends / (1 - 0.0149))


def test_oscillating_spectrum_of_the_source_both_rules():
    from loadflow.validation._slewing_cases import SPECTRUM

    load, share, rate = SPECTRUM[:, 4], SPECTRUM[:, 5] / 100, SPECTRUM[:, 6] / 60
    path = np.radians(SPECTRUM[:, 7])
    critical = life.critical_amplitude(129, 0.014886)
    printed = life.oscillation_load(load, rate, share, path, critical=critical)
    swapped = life.oscillation_load(load, rate, share, path, critical=critical, rule="rumbarger")
    assert printed == pytest.approx(2_238_533, rel=1e-6)  # every path is below the critical one
    assert swapped == pytest.approx(2_216_904, rel=1e-6)


def test_life_in_hours():
    assert life.life_hours(0.11, 0.015 * math.pi / 30) == pytest.approx(122_222, rel=1e-5)


def test_no_load_lives_for_ever():
    assert np.isinf(life.rating_life(1e6, 0.0))


def test_hardness_factor_has_a_ceiling():
    assert safety.hardness_factor(700) == 1.0
    assert safety.hardness_factor(600) == pytest.approx(0.84375)
    with pytest.raises(InputError, match="hardness"):
        safety.hardness_factor(0)


def test_friction_from_loads_splits_into_its_parts():
    parts = [friction.friction_torque_loads(*load, 1.9) for load in np.diag([1e6, 2e5, 1e6])]
    total = friction.friction_torque_loads(1e6, 2e5, 1e6, 1.9, idle=100)
    assert total == pytest.approx(100 + sum(parts))
    assert parts[0] == pytest.approx(0.003 * 0.95 * 1e6)
    assert parts[2] == pytest.approx(0.003 / 2 * 4.4e6)


@pytest.mark.parametrize("kind", ["ball", "roller"])
def test_wide_oscillation_lives_as_long_as_its_turns(kind):
    exponent = {"ball": 3, "roller": 10 / 3}[kind]
    keys = {"elements": 129, "gamma": 0.015, "kind": kind}
    for degrees in (30.0, 180.0, 720.0):  # from end to end; a cycle travels twice as far
        amplitude = math.radians(2 * degrees)
        capacity = float(life.oscillating_capacity(1e6, amplitude, **keys))
        oscillations = float(life.rating_life(capacity, 2e5, exponent))
        turns = float(life.rating_life(1e6, 2e5, exponent))
        assert oscillations * amplitude / (2 * math.pi) == pytest.approx(turns)
    half = life.oscillating_capacity(1e6, math.radians(15), "half", **keys)
    assert half == pytest.approx(float(life.oscillating_capacity(1e6, math.radians(60), **keys)))


def test_narrow_oscillation_of_the_guideline():
    keys = {"elements": 129, "gamma": 0.015}
    narrow = life.oscillating_capacity(1.0, math.radians(2), **keys)  # θ = 1°, critical 5.5°
    assert narrow == pytest.approx(180**0.3 * 129**0.033)
    below, above = life.oscillating_capacity(1.0, np.radians([10.98, 11.02]), **keys)
    assert above == pytest.approx(below, rel=0.06)
    for wrong in ({"amplitude": 0.0}, {"amplitude": 1.0, "kind": "needle"}):
        with pytest.raises(InputError):
            life.oscillating_capacity(1.0, **(keys | wrong))


def test_load_of_the_guideline():
    assert life.guideline_load(4.0, -1.0, 10.0, 2.0) == pytest.approx(3 + 1 + 10)
