"""Rows of numbers that compiled code works on side by side."""

from __future__ import annotations

import numpy as np
from numba import njit

from loadflow.numerics.lanes import (
    LANES,
    aligned,
    larger,
    largest,
    magnitude,
    put,
    spread,
    take,
    total,
    with_lane,
)


@njit
def _worked_out(a, b, made):
    one, other = take(a, LANES), take(b, 0)
    put(made, 0, one + other * 2.0)
    put(made, LANES, 1.0 - one / other)
    put(made, 2 * LANES, with_lane(spread(3.0), 5, -1.0))
    put(made, 3 * LANES, larger(one, magnitude(other)))
    return total(one)


def test_rows_are_worked_on_as_arrays_are():
    a, b = np.random.default_rng(1).normal(size=(2, 2, LANES))
    made = np.zeros((4, LANES))
    added = _worked_out(a, b, made)
    expected = [a[1] + 2.0 * b[0], 1.0 - a[1] / b[0], np.full(LANES, 3.0)]
    expected[2][5] = -1.0
    np.testing.assert_allclose(made[:3], expected, rtol=1e-14)
    np.testing.assert_array_equal(made[3], np.maximum(a[1], np.abs(b[0])))
    np.testing.assert_allclose(added, a[1].sum(), rtol=1e-14)


@njit
def _larger_of(a, made):
    put(made, 0, larger(spread(1.0), take(a, 0)))


def test_what_is_no_number_is_not_the_larger_one():
    made = np.zeros(LANES)
    _larger_of(np.full(LANES, np.nan), made)
    np.testing.assert_array_equal(made, 1.0)


@njit
def _largest_of(a):
    return largest(take(a, 0))


def test_the_largest_of_a_row_is_that_of_its_numbers():
    values = np.random.default_rng(1).normal(size=LANES)
    for at in range(LANES):
        assert _largest_of(np.roll(values, at)) == values.max()
    values[1] = np.nan
    assert _largest_of(values) == np.nanmax(values)


def test_rows_lie_each_in_one_line_of_the_cache():
    values = np.random.default_rng(1).normal(size=(3, 5, LANES))
    kept = [aligned(values) for _ in range(9)]  # numpy places each at another multiple of 16 bytes
    assert all(one.ctypes.data % 64 == 0 for one in kept)
    assert all(one.flags.c_contiguous and (one == values).all() for one in kept)
