"""Equality of seeds: calibrated tests keep their level, printed ones do not."""

import numpy as np
import pytest
from scipy.stats import binom
from seed_noise import ar1, load_like

from loadflow.errors import InputError
from loadflow.seeds import equality

DT = 0.1  # s: 600 s records, decimated for speed; only the correlation time in seconds matters
N = 6000


@pytest.mark.parametrize(("seeds", "tau"), [(6, 1.0), (6, 10.0), (2, 3.0)])
def test_false_alarm_rate_of_the_calibrated_tests(seeds, tau):
    """300 null cases of AR(1) noise; each count within its central 99.9 % binomial interval.

    A stage's p value alone is below 5 % in 5 % of the cases, and so is (or less, Holm's correction
    being careful) the verdict over the three of them.
    """
    rng = np.random.default_rng(2015)
    alarms = np.zeros(4)
    for _ in range(300):
        got = equality(ar1(rng, (seeds, N), DT, tau), DT)
        stages = (got.location, got.spread, got.spectrum)
        alarms += [*(s.pvalue < 0.05 for s in stages), not got.equal]
    low, high = binom.ppf([0.0005, 0.9995], 300, 0.05)
    assert np.all(alarms[:3] >= low), alarms
    assert np.all(alarms <= high), alarms
    assert alarms[3] >= binom.ppf(0.0005, 300, 0.03)


def test_false_alarm_rate_with_a_periodic_load_in_the_noise():
    """A deterministic 3p makes the spectra surer, not the tests bolder; 300 null cases."""
    rng = np.random.default_rng(3)
    alarms = sum(not equality(load_like(rng, (6, N), DT), DT).equal for _ in range(300))
    assert alarms <= binom.ppf(0.9995, 300, 0.05)


def test_false_alarm_rate_of_the_spectrum_of_skewed_noise():
    """Squares of slow noise: what leaked from the record's mean into the lowest band gave 20 %."""
    rng = np.random.default_rng(8)
    records = (ar1(rng, (6, 3000), 0.2, 6.0) ** 2 for _ in range(200))
    alarms = sum(equality(x, 0.2).spectrum.pvalue < 0.05 for x in records)
    assert alarms <= binom.ppf(0.9995, 200, 0.05)


def test_as_printed_rejects_equal_seeds_always():
    rng = np.random.default_rng(7)
    got = [equality(ar1(rng, (6, N), DT, 5.0), DT, method="as-printed") for _ in range(20)]
    assert not any(g.equal for g in got)
    assert sum(g.location.equal for g in got) == 0
    assert not any(g.spectrum.equal for g in got)


@pytest.mark.parametrize(
    ("stage", "change"),
    [
        ("location", lambda x: x + 1.0),
        ("spread", lambda x: 1.5 * x),
        ("spectrum", lambda x: x + 0.4 * np.sin(2 * np.pi * 1.7 * DT * np.arange(N))),
    ],
)
def test_each_stage_finds_its_own_difference(stage, change):
    """One of six seeds differs; 20 draws, found in at least 18."""
    rng = np.random.default_rng(11)
    found = 0
    for _ in range(20):
        x = load_like(rng, (6, N), DT)
        x[3] = change(x[3])
        got = equality(x, DT)
        found += not getattr(got, stage).equal
    assert found >= 18


def test_a_tone_ten_percent_higher_is_found_and_named_by_its_frequency():
    x = load_like(np.random.default_rng(5), (6, N), DT, tone=3.0)
    x[4] += 0.1 * (x[4] - load_like(np.random.default_rng(5), (6, N), DT, tone=0.0)[4])
    got = equality(x, DT)
    assert not got.spectrum.equal
    assert "spectrum differs at 0." in got.text


def test_units_do_not_matter_and_lists_of_other_lengths_work():
    x = ar1(np.random.default_rng(1), (3, N), DT, 2.0) + 5.0
    one, other = equality(x, DT), equality(1e6 * x, DT)
    assert other.pvalue == pytest.approx(one.pvalue, rel=1e-6)
    assert other.spectrum.statistic == pytest.approx(one.spectrum.statistic, rel=1e-6)
    cut = [x[0], x[1][:5000], x[2][:5500]]
    for method in ("calibrated", "as-printed"):
        assert np.isfinite(equality(cut, DT, method=method).location.statistic)


@pytest.mark.parametrize("method", ["calibrated", "as-printed"])
def test_one_seed_and_constant_and_identical_series(method):
    x = ar1(np.random.default_rng(1), (1, 400), DT, 1.0)
    one = equality(x, DT, method=method)
    assert one.equal
    assert one.text == "one seed, nothing to test"
    assert equality(np.full((3, 400), 0.1), DT, method=method).equal
    assert equality(np.repeat(x, 3, axis=0), DT, method=method).equal
    constants = equality(np.repeat([[0.1], [0.2]], 400, axis=1), DT, method=method)
    assert not constants.location.equal
    assert constants.location.pvalue < 1e-6


def test_a_constant_seed_among_living_ones_differs():
    x = ar1(np.random.default_rng(1), (4, N), DT, 1.0)
    x[2] = 0.0
    got = equality(x, DT)
    assert not got.spread.equal
    assert not got.spectrum.equal


def test_printed_stages_are_the_public_tests():
    from loadflow.seeds import kruskal_wallis, meyer_bahlburg, spectral_difference

    x = ar1(np.random.default_rng(2), (3, 500), DT, 0.05)
    got = equality(x, DT, method="as-printed")
    assert got.location.pvalue == kruskal_wallis(x).pvalue
    assert got.spread.statistic == meyer_bahlburg(x).statistic
    pairs = [spectral_difference(x[i], x[j], dt=DT).maximum for i in range(3) for j in range(3)]
    assert got.spectrum.statistic == pytest.approx(max(pairs), rel=1e-12)
    assert np.isnan(got.spectrum.pvalue)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"alpha": 1.0}, "alpha = 1.0"),
        ({"method": "best"}, "method = 'best'"),
        ({"dt": 0.0}, "dt = 0.0"),
        ({"x": np.zeros((2, 50))}, "at least 120"),
        ({"x": [[1.0]]}, "sample 0 has 1 values"),
        ({"method": "as-printed", "band": -1}, "band = -1"),
    ],
)
def test_bad_input_is_named(change, message):
    arguments = {"x": np.zeros((2, 200)), "dt": DT}
    with pytest.raises(InputError, match=message):
        equality(**(arguments | change))


def test_another_step_gives_the_calibrated_verdict_but_half_the_printed_statistic():
    """The same records sampled half as often hold the same information; H counts the samples."""
    x = ar1(np.random.default_rng(17), (4, 2 * N), DT / 2, 3.0)
    fine, coarse = equality(x, DT / 2), equality(x[:, ::2], DT)
    assert coarse.location.statistic == pytest.approx(fine.location.statistic, rel=0.02)
    assert coarse.spread.statistic == pytest.approx(fine.spread.statistic, rel=0.02)
    assert coarse.pvalue == pytest.approx(fine.pvalue, rel=0.1)
    fine, coarse = (
        equality(y, dt, method="as-printed") for y, dt in ((x, DT / 2), (x[:, ::2], DT))
    )
    assert coarse.location.statistic == pytest.approx(0.5 * fine.location.statistic, rel=0.02)
