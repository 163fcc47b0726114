"""Rainflow, damage-equivalent load, load duration."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.reduction import damage_equivalent_load, load_duration, rainflow

series = st.lists(st.integers(-20, 20), min_size=1, max_size=60)


def astm(x):
    """ASTM E1049-85, 5.4.4: three points, half cycles where the start is among them."""
    turns = [x[0]]
    for v in x[1:]:
        if len(turns) > 1 and (turns[-1] - turns[-2]) * (v - turns[-1]) > 0:
            turns[-1] = v
        elif v != turns[-1]:
            turns.append(v)
    stack, cycles = [], []
    for v in turns:
        stack.append(v)
        while len(stack) >= 3 and abs(stack[-1] - stack[-2]) >= abs(stack[-2] - stack[-3]):
            y = abs(stack[-2] - stack[-3])
            if len(stack) == 3:
                cycles.append((y, 0.5))
                stack.pop(0)
            else:
                cycles.append((y, 1.0))
                last = stack.pop()
                del stack[-2:]
                stack.append(last)
    cycles += [(abs(b - a), 0.5) for a, b in pairwise(stack)]
    return cycles


def total_per_range(cycles):
    totals = {}
    for span, count in cycles:
        totals[span] = totals.get(span, 0.0) + count
    return totals


def test_example_of_the_standard():
    """ASTM E1049-85, figure 6: ranges 3, 4, 6, 8, 9 with 0.5, 1.5, 0.5, 1.0, 0.5 cycles."""
    cycles = rainflow([-2, 1, -3, 5, -1, 3, -4, 4, -2])
    counted = total_per_range(zip(cycles.range, cycles.count))
    assert counted == {3: 0.5, 4: 1.5, 6: 0.5, 8: 1.0, 9: 0.5}


@given(series)
def test_rainflow_is_that_of_the_standard(x):
    cycles = rainflow(x)
    assert total_per_range(zip(cycles.range, cycles.count)) == total_per_range(astm(x))


@given(series, st.floats(0.1, 1e6), st.sampled_from([3.0, 4.0, 10.0]))
def test_damage_equivalent_load_scales_with_the_load(x, scale, m):
    one = damage_equivalent_load(x, m, duration=10.0)
    other = damage_equivalent_load(scale * np.array(x, dtype=float) + 7, m, duration=10.0)
    assert other == pytest.approx(scale * one, rel=1e-6, abs=1e-6)


def test_a_sine_is_its_own_equivalent():
    t = np.arange(0, 100.001, 0.001)
    got = damage_equivalent_load(2.5 * np.cos(2 * np.pi * t), [3, 10], duration=100, f_eq=1.0)
    np.testing.assert_allclose(got, 5.0, rtol=1e-3)
    quick = damage_equivalent_load(rainflow(2.5 * np.cos(2 * np.pi * t)), 4, 100, f_eq=16.0)
    assert quick == pytest.approx(2.5, rel=1e-3)


def test_high_exponents_do_not_overflow_and_a_constant_does_no_damage():
    x = 1e30 * np.sin(np.arange(1000.0))
    assert np.isfinite(damage_equivalent_load(x, 40, 1000.0))
    assert damage_equivalent_load(np.ones(9), 4, 1.0) == 0.0
    assert rainflow([1.0]).range.size == 0


def test_matrix_holds_every_cycle():
    cycles = rainflow(np.random.default_rng(0).standard_normal(500))
    matrix = cycles.matrix(np.linspace(0, 10, 21), np.linspace(-5, 5, 11))
    assert matrix.shape == (20, 10)
    assert matrix.sum() == pytest.approx(cycles.count.sum())


def test_time_and_turns_are_all_sorted_in():
    rng = np.random.default_rng(1)
    t = np.cumsum(rng.uniform(0.01, 0.05, 3000))
    speed, force = rng.uniform(0.5, 1.3, 3000), rng.uniform(1e6, 2e6, (3000, 2))
    got = load_duration(speed, force, t, classes=(5, 20))
    assert got.seconds.sum() == pytest.approx(t[-1] - t[0])
    assert got.revolutions.sum() == pytest.approx(np.trapezoid(speed, t) / (2 * np.pi))
    assert got.revolutions.shape == (5, 20)
    assert got.force[got.revolutions > 0].min() >= 1e6 * np.sqrt(2)
    assert np.all(got.force[got.revolutions == 0] == 0)


def test_equivalent_force_is_within_the_class_width_of_the_exact_one():
    rng = np.random.default_rng(2)
    t, speed = 0.1 * np.arange(5000), rng.uniform(0.5, 1.3, 5000)
    force = np.stack([rng.uniform(1e6, 3e6, 5000), np.zeros(5000)], axis=1)
    exact = np.average(force[1:-1, 0] ** 3, weights=speed[1:-1]) ** (1 / 3)
    got = load_duration(speed, force, t, classes=(10, 50)).equivalent_force(3.0)
    assert got == pytest.approx(exact, rel=1e-3)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: rainflow([1.0, np.nan, 2.0]), r"x is nan at index \(1,\)"),
        (lambda: rainflow([]), r"shape \(0,\)"),
        (lambda: damage_equivalent_load([1, 2], -3, 1.0), "m = -3"),
        (lambda: damage_equivalent_load([1, 2], 3, 0.0), "duration = 0"),
        (lambda: damage_equivalent_load([1, 2], 3, 1.0, f_eq=0.0), "f_eq = 0"),
        (lambda: load_duration([1.0], [[1.0, 0.0]], [0.0]), "at least two"),
        (
            lambda: load_duration([0, 0], [[1, 0], [1, 0]], [0, 1]).equivalent_force(),
            "does not turn",
        ),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
