"""Compiled functions are called by their place in memory."""

import numpy as np
import pytest
from numba import njit, typeof
from numba.core.errors import TypingError

from loadflow.numerics.entries import Entry, enter


@njit
def _add(times, numbers, total):
    """Add all numbers to the total, `times` times."""
    if times < 0:
        raise ValueError("never")
    for number in numbers:
        total[0] += times * number


@njit
def _call(entry, times, numbers, total):
    enter(entry, (times, numbers, total))


NUMBERS = np.array([1.0, 2.0, 3.0])
ENTRY = Entry(_add, tuple(typeof(one) for one in (1, NUMBERS, NUMBERS)))


def test_an_entry_does_what_its_function_does():
    total = np.zeros(1)
    _call(ENTRY, 2, NUMBERS, total)
    assert total[0] == 12.0


def test_what_an_entry_raises_is_raised():
    with pytest.raises(ValueError, match="never"):
        _call(ENTRY, -1, NUMBERS, np.zeros(1))


def test_an_entry_takes_arguments_of_its_own_types_alone():
    with pytest.raises(TypingError):
        _call(ENTRY, 2.5, NUMBERS, np.zeros(1))


def test_what_cannot_be_compiled_is_said():
    @njit
    def impossible(times, numbers, total):
        total[0] += "text"

    with pytest.raises(TypingError, match="No implementation of function"):
        _call(Entry(impossible, ENTRY.kinds), 1, NUMBERS, np.zeros(1))
