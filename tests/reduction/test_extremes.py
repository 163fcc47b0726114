"""Extrapolated maxima: coverage of the interval, blocks."""

import numpy as np
import pytest
from scipy.stats import binom

from loadflow.errors import InputError
from loadflow.reduction import block_maxima, extreme_value


def test_interval_covers_the_true_level_as_often_as_it_says():
    """200 samples of 60 maxima; 90 % intervals, count within its 99.9 % binomial interval."""
    rng = np.random.default_rng(8)
    level = 50 + 4 * -np.log(-np.log1p(-1 / 5000))
    covered = 0
    for _ in range(200):
        got = extreme_value(rng.gumbel(50, 4, 60), horizon=5000, confidence=0.9)
        covered += got.low <= level <= got.high
    low, high = binom.ppf([0.0005, 0.9995], 200, 0.9)
    assert low <= covered <= high


def test_large_sample_gives_the_parameters_and_scales():
    x = np.random.default_rng(1).gumbel(50, 4, 2000)
    got = extreme_value(x, horizon=1000)
    assert got.location == pytest.approx(50, rel=0.01)
    assert got.scale == pytest.approx(4, rel=0.07)
    scaled = extreme_value(1e3 * x + 7, horizon=1000)
    assert scaled.value == pytest.approx(1e3 * got.value + 7)
    assert scaled.high == pytest.approx(1e3 * got.high + 7)


def test_blocks_are_cut_along_time():
    x = np.arange(20.0).reshape(2, 10)
    np.testing.assert_array_equal(block_maxima(x, dt=0.5, block=2.0), [3, 7, 13, 17])


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: block_maxima(np.ones(5), 1.0, 6.0), "longer than the record"),
        (lambda: block_maxima(np.ones(5), 1.0, 0.5), "at least the time step"),
        (lambda: extreme_value(np.ones(9), 10), "k >= 10"),
        (lambda: extreme_value(np.ones(10), 1.0), "horizon = 1.0"),
        (lambda: extreme_value(np.ones(10), 10, confidence=1.0), "confidence = 1.0"),
        (lambda: extreme_value([np.nan] * 10, 10), "maxima is nan"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
