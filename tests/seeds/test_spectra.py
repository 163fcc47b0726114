"""Spectral difference as printed, averaged spectra."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.seeds import spectral_difference
from loadflow.seeds.spectra import periodogram


def test_amplitude_two_percent_higher_is_power_four_percent_higher():
    t = np.arange(1000) * 0.05
    x = 3.0 + np.sin(2 * np.pi * 0.5 * t)
    got = spectral_difference(x, 1.02 * x, dt=0.05)
    at = int(np.argmin(np.abs(got.frequency - 0.5)))
    assert got.relative[at] == pytest.approx(1.02**2 - 1, rel=1e-9)
    assert got.frequency[at] == pytest.approx(0.5)
    assert not got.equal


def test_equal_series_are_equal_and_the_mean_does_not_count():
    x = np.random.default_rng(0).standard_normal(999)
    got = spectral_difference(x, x, fs=20.0)
    assert (got.maximum, got.equal, got.share_outside) == (0.0, True, 0.0)
    shifted = spectral_difference(x, x + 8.0, fs=20.0)
    assert shifted.maximum < 1e-9


@pytest.mark.parametrize("n", [64, 65, 1000])
def test_density_sums_to_the_variance(n):
    """Parseval; and the autocovariance is its transform (Wiener–Khinchin, 4.14)."""
    x = np.random.default_rng(n).standard_normal(n)
    frequency, density = periodogram(x, 0.1)
    assert density.sum() * frequency[0] == pytest.approx(x.var(), rel=1e-12)
    d = x - x.mean()
    lag1 = np.mean(d * np.roll(d, 1))
    cosine = np.cos(2 * np.pi * frequency * 0.1)
    assert np.sum(density * cosine) * frequency[0] == pytest.approx(lag1, rel=1e-9)


def test_two_seeds_of_one_process_never_agree_within_the_band():
    """The trap of the printed criterion: raw periodograms scatter by 100 %."""
    x, y = np.random.default_rng(5).standard_normal((2, 4000))
    got = spectral_difference(x, y, dt=0.05)
    assert not got.equal
    assert got.share_outside > 0.95


def test_constant_series_and_unequal_lengths():
    assert spectral_difference(np.ones(10), np.ones(12), dt=1.0).equal
    assert spectral_difference(np.ones(10), np.arange(10.0), dt=1.0).maximum == np.inf


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({}, "exactly one"),
        ({"dt": 0.1, "fs": 10.0}, "exactly one"),
        ({"dt": -0.1}, "dt = -0.1"),
        ({"fs": np.nan}, "fs = nan"),
        ({"dt": 0.1, "band": -1.0}, "band = -1.0"),
    ],
)
def test_bad_arguments_are_named(arguments, message):
    with pytest.raises(InputError, match=message):
        spectral_difference(np.arange(4.0), np.arange(4.0), **arguments)
