"""Named tuples that compiled code hands on by their place in memory."""

from __future__ import annotations

import sys
from typing import Any, NamedTuple

import numpy as np
import pytest
from numba import njit
from numba.core.errors import TypingError

from loadflow.numerics.references import refer


class Inner(NamedTuple):
    values: Any
    pair: Any
    on: bool
    count: int


class Outer(NamedTuple):
    first: Any
    inner: Inner
    size: float
    lengths: tuple[int, ...]
    table: Any


def _outer() -> Outer:
    table = np.arange(24.0).reshape(2, 3, 4)
    inner = Inner(np.arange(5.0), (np.ones(2), np.full(2, 7.0)), True, 3)
    return Outer(np.arange(3), inner, 0.5, (4, 5), table[:, ::2])


def _read(o):
    total = o.size + o.inner.count + len(o.lengths) + o.lengths[1]
    if o.inner.on:
        total += o.inner.pair[1][0]
    for i in range(o.table.shape[0]):
        for j in range(o.table.shape[1]):
            total += (1 + i) * o.table[i, j, 2] + o.first[j]
    inner = o.inner
    return total + inner.values[1:].sum() + inner.values.size


_of_value, _of_reference = njit(_read), njit(_read)


@njit
def _refer_and_read(o):
    return _of_reference(refer(o))


def test_fields_are_those_of_the_tuple():
    outer = _outer()
    assert _refer_and_read(outer) == _of_value(outer) == _read(outer)


@njit
def _add_to(values, reference, times):
    for _ in range(times):
        for i in range(reference.inner.values.size):
            reference.inner.values[i] += values[i]


@njit
def _add_to_itself(o):
    o = refer(refer(o))
    _add_to(o.inner.values, o, 3)
    return o.inner.values.copy(), o.inner.values


def test_numbers_in_arrays_may_change():
    outer = _outer()
    copied, same = _add_to_itself(outer)
    np.testing.assert_array_equal(outer.inner.values, 8.0 * np.arange(5.0))
    np.testing.assert_array_equal(copied, outer.inner.values)
    assert np.shares_memory(same, outer.inner.values)


def test_arrays_are_neither_kept_nor_freed():
    outer = _outer()
    _add_to_itself(outer)
    before = sys.getrefcount(outer.inner.values)
    for _ in range(100):
        _add_to_itself(outer)
    after = sys.getrefcount(outer.inner.values)
    assert after == before


@njit
def _last_of_each(outers_first, outers_second):
    first, second = refer(outers_first), refer(outers_second)
    return first.size + first.inner.values[-1], second.size + second.inner.values[-1]


def test_two_tuples_of_a_kind_are_told_apart():
    one, other = _outer(), _outer()._replace(size=2.0)
    other.inner.values[-1] = 9.0
    assert _last_of_each(one, other) == (4.5, 11.0)
    assert _last_of_each(other, one) == (11.0, 4.5)


@njit
def _in_turn(o, sizes):
    total = 0.0
    for size in sizes:
        total += _size_after(o, size)
    return total


@njit
def _size_after(o, size):
    return refer(Outer(o.first, o.inner, size, o.lengths, o.table)).size


def test_each_call_lays_down_its_own():
    assert _in_turn(_outer(), np.arange(4.0)) == 6.0


@njit
def _no_tuple(values):
    return refer(values)[0]


@njit
def _no_field(o):
    return refer(o).middle


def test_what_cannot_be_is_refused():
    with pytest.raises(TypingError):
        _no_tuple(np.ones(2))
    with pytest.raises(TypingError, match="middle"):
        _no_field(_outer())
