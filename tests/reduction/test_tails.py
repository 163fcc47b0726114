"""Tails of load series and the level of a return period."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.reduction import Tail, long_term_extreme, tail_of_maxima, tail_of_peaks
from loadflow.reduction.extremes import gumbel_parameters
from loadflow.reduction.tails import YEAR, _pareto


def gumbel_tail(location=100.0, scale=5.0, count=60):
    return Tail(location, scale, 0.0, 1 / 600, count)


@given(st.floats(-0.3, 0.3), st.floats(1.0, 50.0), st.floats(1.0, 500.0))
def test_the_level_of_one_tail_is_where_its_rate_is_that_of_the_return_period(shape, scale, years):
    tail = Tail(100.0, scale, shape, 1 / 60, 100, "peaks")
    got = long_term_extreme([tail], [1.0], years)
    assert float(tail.rate_above(got.value)) * years * YEAR == pytest.approx(1.0, rel=1e-6)
    assert got.shares.tolist() == [1.0]


def test_tails_add_up_by_their_shares():
    mild, severe = gumbel_tail(100.0), gumbel_tail(120.0)
    alone = long_term_extreme([severe], [0.01])
    both = long_term_extreme([mild, severe], [0.99, 0.01])
    exceedances = 0.99 * mild.rate_above(both.value) + 0.01 * severe.rate_above(both.value)
    assert float(exceedances) * 50 * YEAR == pytest.approx(1.0, rel=1e-9)
    assert both.value > alone.value
    # e^{20/5} = 54.6 as severe, at 1/99 of the time
    assert both.shares[0] == pytest.approx(99 / (99 + np.exp(4.0)), rel=1e-6)
    assert long_term_extreme([mild, severe], [0.0, 0.01]).value == pytest.approx(alone.value)


def test_series_of_several_lengths_are_fitted_together():
    rng = np.random.default_rng(5)
    x = rng.standard_exponential(3000)
    rows = [x[:1800], x[1800:1830], x[1830:]]  # cut where blocks of 30 begin
    assert tail_of_maxima(rows, dt=1.0, block=30.0) == tail_of_maxima(x, dt=1.0, block=30.0)
    pieces = tail_of_peaks(rows, dt=1.0, separation=1.0)
    assert pieces == tail_of_peaks(x, dt=1.0, separation=1.0)
    for fit in (tail_of_maxima, tail_of_peaks):
        with pytest.raises(InputError, match="no values"):
            fit([], 1.0, **({"block": 30.0} if fit is tail_of_maxima else {}))


@pytest.mark.parametrize("kind", ["maxima", "peaks"])
def test_interval_covers_the_true_level_about_as_often_as_it_says(kind):
    """Of 60 values: of 150 intervals of 90 %, 125 at least cover the level."""
    rng = np.random.default_rng(3)
    covered = 0
    for k in range(150):
        if kind == "maxima":
            truth = 10.0 + np.log(50 * YEAR / 60.0)
            tail = tail_of_maxima(rng.gumbel(10.0, 1.0, 60), dt=60.0, block=60.0)
        else:
            x = rng.standard_exponential(1200)  # e^-u of all values lie above the level u
            truth = np.log(50 * YEAR / 60.0)
            tail = tail_of_peaks(x, dt=60.0, quantile=0.95, separation=60.0)
        got = long_term_extreme([tail], [1.0], confidence=0.9, seed=k)
        covered += got.low <= truth <= got.high
    assert covered >= 125


def test_interval_of_many_wind_speeds_with_few_seeds_covers_the_true_level():
    """The steepest of 11 fits to 6 maxima each governs, so that levels lie too high and those of
    resamples higher still: their percentiles cover the true level in 10 of 60 cases.
    """
    rng, shares = np.random.default_rng(4), np.full(11, 1 / 11)

    def level(location, scale):
        fits = (Tail(a, b, 0.0, 1 / 600, 6) for a, b in zip(location, scale))
        return long_term_extreme([*fits], shares)

    truth = level(np.full(11, 100.0), np.full(11, 5.0)).value
    maxima = (rng.gumbel(100.0, 5.0, (11, 6)) for _ in range(60))
    found = [level(*gumbel_parameters(x)) for x in maxima]
    assert sum(one.low <= truth <= one.high for one in found) >= 52


def test_interval_of_tails_with_a_fitted_shape_covers_the_true_level():
    """The scale of such fits varies so much that misses over it would cover in two of three."""

    def level(scale, shape):
        return long_term_extreme([Tail(100.0, scale, shape, 1 / 600, 60, "peaks")], [1.0])

    rng, truth = np.random.default_rng(1), level(5.0, -0.2).value
    drawn = -25.0 * np.expm1(-0.2 * rng.standard_exponential((40, 60)))
    found = [level(float(scale), float(shape)) for scale, shape in zip(*_pareto(drawn))]
    assert sum(one.low <= truth <= one.high for one in found) >= 34


def test_interval_of_few_peaks_is_known_whatever_is_drawn():
    """Of ten peaks a resample may have none: four of these seeds have one."""
    few = Tail(100.0, 5.0, 0.0, 1 / 600, 10, "peaks")
    for seed in (13, 18, 42, 43):
        found = long_term_extreme([few], [1.0], seed=seed)
        assert found.low < found.value < found.high


def test_exceedances_that_are_near_are_one_peak():
    x = np.zeros(1000)
    x[[100, 101, 105]] = 5.0, 7.0, 6.0  # within 10 s: one peak
    x[200:900:50] = np.arange(1.0, 15.0)
    tail = tail_of_peaks(x, dt=1.0, quantile=0.9, separation=10.0)
    assert tail.count == 15
    assert tail.threshold == 0.0
    assert tail.scale == pytest.approx((7.0 + np.arange(1.0, 15.0).sum()) / 15)
    assert tail.rate == pytest.approx(15 / 1000)


def test_a_bounded_tail_is_recognised_and_never_exceeds_its_end():
    x = np.random.default_rng(1).uniform(0.0, 1.0, (10, 2000))  # shape −1
    tail = tail_of_peaks(x, dt=1.0, quantile=0.9, separation=1.0, shape=None)
    assert tail.shape == pytest.approx(-1.0, abs=0.1)
    end = tail.threshold - tail.scale / tail.shape
    assert long_term_extreme([tail], [1.0]).value <= end
    assert float(tail.rate_above(end + 0.1)) < 1e-200


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: tail_of_maxima(np.ones(50), 1.0, 10.0), "5 blocks; a tail needs at least 10"),
        (lambda: tail_of_maxima(np.ones(500), 1.0, 10.0), "all maxima are equal"),
        (lambda: tail_of_maxima(np.full(6100, 0.1), 1.0, 100.0), "all maxima are equal"),
        (lambda: tail_of_peaks(np.arange(91.0) % 7, 1.0, 0.5, 2.0, shape=None), "all maxima are"),
        (lambda: tail_of_peaks(np.arange(9.0), 1.0, 0.5, 1.0), "at least 10"),
        (lambda: tail_of_peaks(np.arange(9.0), 1.0, quantile=1.0), "quantile = 1.0"),
        (lambda: tail_of_peaks(np.arange(9.0), 1.0, separation=0.1), "separation = 0.1 s"),
        (lambda: tail_of_peaks(np.arange(90.0) % 7, 1.0, 0.5, 1.0, shape=1), "shape = 1"),
        (lambda: long_term_extreme([gumbel_tail()], [1.0, 2.0]), r"\(1,\) is needed"),
        (lambda: long_term_extreme([gumbel_tail()], [0.0]), "not all 0"),
        (lambda: long_term_extreme([gumbel_tail()], [1.0], years=0), "years = 0"),
        (lambda: long_term_extreme([gumbel_tail()], [1.0], confidence=1), "confidence = 1"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()
