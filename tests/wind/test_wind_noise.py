"""Noise of the wind: the numbers of numpy's generator, so that a seed stays the same wind."""

import numpy as np
import pytest

from loadflow.wind import case_seed
from loadflow.wind._kernels import normal_rows, time_first


@pytest.mark.parametrize(("drawn", "kept"), [(1, 1), (7, 3), (13_610, 6_806), (300_000, 300_000)])
@pytest.mark.parametrize("index", [1, 2])
def test_normal_numbers_are_those_of_numpy_bit_for_bit(drawn, kept, index):
    seed, count = case_seed("1.1", 12.0, index), max(4, 2_000_000 // drawn)
    rows = np.empty((count, kept), np.float32)
    normal_rows(seed, drawn, rows)
    expected = np.random.default_rng(seed).standard_normal((count, drawn), dtype=np.float32)
    assert np.abs(expected).max() > 4.0  # the tail, beyond the strips, is among them
    np.testing.assert_array_equal(rows, expected[:, :kept])


def test_time_first_is_the_transposed_array_at_sizes_that_tiles_do_not_divide():
    values = np.random.default_rng(1).random((37, 3, 101), dtype=np.float32)
    turned = time_first(values)
    np.testing.assert_array_equal(turned, values.transpose(2, 1, 0))
    assert turned.flags.c_contiguous
