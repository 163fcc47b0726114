"""Kruskal–Wallis and Meyer-Bahlburg: printed numbers, exactness, laws."""

import time

import numpy as np
import pytest
import scipy.stats
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.seeds import kruskal_wallis, meyer_bahlburg, siegel_tukey_ranks
from loadflow.validation.seeds import checks

# integers from a narrow range: many ties
sample = st.lists(st.integers(-6, 6), min_size=1, max_size=9)
samples = st.lists(sample, min_size=2, max_size=5)


@pytest.mark.parametrize("check", list(checks()), ids=lambda c: c.name)
def test_printed_examples(check):
    assert check.ok, check


@given(samples)
def test_kruskal_wallis_equals_scipy(xs):
    ours = kruskal_wallis(xs)
    if np.ptp(np.concatenate(xs)) == 0:
        assert (ours.statistic, ours.pvalue) == (0.0, 1.0)
        return
    theirs = scipy.stats.kruskal(*xs)
    assert ours.statistic == pytest.approx(theirs.statistic, rel=1e-9, abs=1e-9)
    assert ours.pvalue == pytest.approx(theirs.pvalue, rel=1e-9)


@given(samples)
def test_meyer_bahlburg_is_kruskal_wallis_of_the_ranks_with_their_permutation_variance(xs):
    """The definition, written out without a shortcut."""
    ours = meyer_bahlburg(xs)
    pooled = np.concatenate(xs)
    by_position = siegel_tukey_ranks(pooled.size)
    ordered = np.sort(pooled)
    ranks = np.array([by_position[ordered == value].mean() for value in pooled])
    parts = np.split(ranks, np.cumsum([len(x) for x in xs])[:-1])
    np.testing.assert_allclose(ours.rank_sums, [p.sum() for p in parts])
    middle = (pooled.size + 1) / 2
    between = sum(p.size * (p.mean() - middle) ** 2 for p in parts)
    variance = np.sum((ranks - middle) ** 2)
    expected = (pooled.size - 1) * between / variance if variance > 0 else 0.0
    assert ours.statistic == pytest.approx(expected, rel=1e-9, abs=1e-9)


@given(samples, st.randoms(use_true_random=False))
def test_order_of_samples_and_values_does_not_matter(xs, random):
    """Ties ranked in order of input would fail this."""
    for test in (kruskal_wallis, meyer_bahlburg):
        h = test(xs).statistic
        shuffled = [random.sample(x, len(x)) for x in xs]
        random.shuffle(shuffled)
        assert test(shuffled).statistic == pytest.approx(h, rel=1e-9, abs=1e-9)
        assert test([[2 * v + 7 for v in x] for x in xs]).statistic == h


@pytest.mark.parametrize("n", range(1, 14))
def test_siegel_tukey_ranks_are_a_permutation_and_the_middle_has_the_last(n):
    """Also for N = 3 mod 4, where a known implementation gives N + 1."""
    ranks = siegel_tukey_ranks(n)
    assert sorted(ranks) == list(range(1, n + 1))
    assert int(np.argmax(ranks)) in (n // 2, (n - 1) // 2)


def test_ties_in_insect_sprays():
    """Counts with many ties (InsectSprays of R); values by an independent implementation."""
    sprays = [
        [10, 7, 20, 14, 14, 12, 10, 23, 17, 20, 14, 13],
        [11, 17, 21, 11, 16, 14, 17, 17, 19, 21, 7, 13],
        [0, 1, 7, 2, 3, 1, 2, 1, 3, 0, 1, 4],
        [3, 5, 12, 6, 4, 3, 5, 5, 5, 5, 2, 4],
        [3, 5, 3, 5, 3, 6, 1, 1, 3, 2, 6, 4],
        [11, 9, 15, 22, 15, 16, 13, 10, 26, 26, 24, 13],
    ]
    assert meyer_bahlburg(sprays).statistic == pytest.approx(9.8024, abs=5e-5)
    residuals = [np.array(s) - np.mean(s) for s in sprays]
    test = meyer_bahlburg(residuals)
    assert test.statistic == pytest.approx(19.6798, abs=5e-5)
    assert test.pvalue == pytest.approx(1.435e-3, rel=5e-4)


def test_false_alarms_of_independent_values():
    """4000 draws of 3 x 12 values: size at 5 % between 3.6 and 5.6 % (4.6 % known, 3 sigma 1 %)."""
    rng = np.random.default_rng(1970)
    draws = rng.standard_normal((4000, 3, 12))
    rejected = np.mean([meyer_bahlburg(d).pvalue < 0.05 for d in draws])
    assert rejected == pytest.approx(0.046, abs=0.01)


def test_one_seed_and_constant_series_have_a_valid_verdict():
    one = kruskal_wallis([[1.0, 2.0, 3.0]])
    assert (one.statistic, one.pvalue, one.df) == (0.0, 1.0, 0)
    assert one.note == "one seed, nothing to test"
    constant = meyer_bahlburg([[2.0] * 5, [2.0] * 3])
    assert (constant.statistic, constant.pvalue) == (0.0, 1.0)
    assert "equal" in constant.note


def test_notes_tell_of_ties_and_of_a_number_not_divisible_by_four():
    assert meyer_bahlburg([[1, 2, 3], [4, 5, 6]]).note.startswith("N = 6 is not divisible by 4")
    assert "2 of 6 values repeat another" in kruskal_wallis([[1, 2, 2], [2, 3, 4]]).note
    assert kruskal_wallis([[1, 2], [3, 4]]).note == ""


def test_median_centring_takes_location_out():
    rng = np.random.default_rng(3)
    x = rng.standard_normal((2, 400))
    shifted = [x[0], x[1] + 5.0]
    centred = meyer_bahlburg(shifted, centre="median").statistic
    assert centred == pytest.approx(meyer_bahlburg(x, centre="median").statistic, rel=1e-9)


@pytest.mark.parametrize(
    ("bad", "message"),
    [
        ([], "got none"),
        ([[1.0], []], "sample 1 has 0 values"),
        ([[1.0], [1.0, np.nan]], "sample 1 is nan at index 1"),
        ([[[1.0]]], r"shape \(1, 1\)"),
    ],
)
def test_bad_samples_are_named(bad, message):
    with pytest.raises(InputError, match=message):
        kruskal_wallis(bad)
    with pytest.raises(InputError, match=message):
        meyer_bahlburg(bad)
    with pytest.raises(InputError, match="centre"):
        meyer_bahlburg([[1.0], [2.0]], centre="mode")


def test_a_wind_speed_of_six_full_records_takes_a_fraction_of_a_second():
    x = np.random.default_rng(0).standard_normal((6, 24_000))
    kruskal_wallis(x[:, :10])
    start = time.process_time()  # of this process alone, whatever else the machine does
    kruskal_wallis(x)
    meyer_bahlburg(x)
    assert time.process_time() - start < 0.5
