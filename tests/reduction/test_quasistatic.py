"""Histogram reduction: class rules, picks, weights."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from load_record import record

from loadflow.errors import InputError
from loadflow.reduction import class_edges, histogram, number_of_classes
from loadflow.validation.reduction import checks


@pytest.mark.parametrize("check", list(checks()), ids=lambda c: c.name)
def test_printed_rules(check):
    assert check.ok, check


@settings(max_examples=40, deadline=None)
@given(
    st.integers(1, 400),
    st.sampled_from([0.1, 0.33, 1.0, 1, 7]),
    st.sampled_from(["random", "extremes", "envelope"]),
    st.sampled_from(["up", "nearest", "total"]),
    st.integers(0, 5),
)
def test_laws_of_the_reduction(n, size, pick, rounding, seed):
    speed, force, time = record(n, seed)
    size = min(size, n)
    got = histogram(speed, force, time, size=size, pick=pick, rounding=rounding, seed=seed)
    assert np.all(np.diff(got.index) > 0)
    np.testing.assert_array_equal(got.speed, speed[got.index])
    np.testing.assert_array_equal(got.force, force[got.index])
    np.testing.assert_array_equal(got.time, time[got.index])
    # no class is lost, none has more than it had, and the weights give back each class's count
    np.testing.assert_array_equal(got.counts_full > 0, got.counts_reduced > 0)
    assert np.all(got.counts_reduced <= got.counts_full)
    assert got.weight.sum() == pytest.approx(n)
    counts, *_ = np.histogram2d(
        got.speed, np.hypot(*got.force.T), bins=got.edges, weights=got.weight
    )
    np.testing.assert_allclose(counts, got.counts_full)
    q = size if isinstance(size, int) else int(np.ceil(round(size * n, 6)))
    if rounding == "total":
        assert got.index.size <= max(q, (got.counts_full > 0).sum())
    if rounding == "up":
        expected = -(-got.counts_full * q // n)
        np.testing.assert_array_equal(got.counts_reduced, expected)
        assert q <= got.index.size <= q + (got.counts_full > 0).sum()


@pytest.mark.parametrize("pick", ["random", "extremes"])
def test_everything_kept_is_the_series_itself(pick):
    speed, force, time = record(300)
    got = histogram(speed, force, time, size=1.0, pick=pick)
    np.testing.assert_array_equal(got.index, np.arange(300))
    np.testing.assert_allclose(got.weight, 1.0)


def test_seed_decides_the_random_pick():
    series = record(2000)
    first = histogram(*series, seed=3).index
    np.testing.assert_array_equal(first, histogram(*series, seed=3).index)
    assert not np.array_equal(first, histogram(*series, seed=4).index)


def test_the_random_pick_gives_every_member_of_a_class_the_same_chance():
    """One class of 5, 2 kept, 3000 seeds: each chosen 1200 times, standard deviation 27."""
    speed, force = np.ones(5), np.stack([np.arange(1.0, 6.0), np.zeros(5)], 1)
    times = np.zeros(5)
    for seed in range(3000):
        times[histogram(speed, force, size=2, classes=1, seed=seed).index] += 1
    assert times.sum() == 6000
    assert np.all(np.abs(times - 1200) < 4 * 27)


def test_extremes_keep_the_severest_pair_of_every_class_and_random_loses_some():
    speed, force, _ = record(5000)
    severity = np.hypot(*force.T) / speed
    kept = histogram(speed, force, pick="extremes")
    row = np.searchsorted(kept.edges[0], speed, side="right") - 1
    column = np.searchsorted(kept.edges[1], np.hypot(*force.T), side="right") - 1
    cell = row * (kept.edges[1].size - 1) + column
    for c in np.unique(cell):
        members = np.flatnonzero(cell == c)
        assert severity[members].max() == severity[kept.index[cell[kept.index] == c]].max()
    lost = histogram(speed, force, pick="random", classes=5)
    assert severity[lost.index].max() < severity.max()


def test_the_envelope_keeps_the_extremes_and_does_not_lean_to_severe_pairs():
    speed, force, time = record(4000)
    severity = np.hypot(*force.T) / speed
    bias = {}
    for pick in ("extremes", "envelope"):
        means = []
        for seed in range(40):
            got = histogram(speed, force, time, classes=30, pick=pick, seed=seed)
            assert severity[got.index].max() == severity.max()
            means.append(got.mean(severity[got.index]))
        bias[pick] = np.mean(means) / severity.mean() - 1
    assert bias["extremes"] > 0
    assert abs(bias["envelope"]) < 0.2 * bias["extremes"]


def test_weighted_means_of_the_reduced_series_are_those_of_the_full_one():
    """Averaged over 40 seeds: the random pick is unbiased (means within 3 standard errors)."""
    speed, force, _ = record(4000)
    so = np.hypot(*force.T) / speed
    means = []
    for seed in range(40):
        got = histogram(speed, force, seed=seed, classes=12)
        means.append(float(got.mean(so[got.index])))
    error = np.mean(means) - so.mean()
    assert abs(error) < 3 * np.std(means) / np.sqrt(40)
    layered = histogram(speed, force, pick="extremes", classes=12)
    assert abs(layered.mean(so[layered.index]) / so.mean() - 1) < 1e-3


def test_number_of_classes_changes_rule_at_a_thousand():
    assert [number_of_classes(n) for n in (1, 4, 1000, 1001, 10**6)] == [1, 2, 32, 30, 60]
    with pytest.raises(InputError, match="n = 0"):
        number_of_classes(0)


def test_classes_are_half_open():
    force = np.array([[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]])
    got = histogram(np.ones(4), force, size=1.0, classes=([0.0, 2.0], [0.0, 1.0, 2.0, 4.0]))
    np.testing.assert_array_equal(got.counts_full, [[1, 1, 2]])
    edges = class_edges(np.array([0.0, 1.0, 4.0]), 4)
    assert edges[0] == 0.0
    assert edges[-1] > 4.0


def test_constant_series_and_standstill():
    got = histogram(np.zeros(50), np.tile([1e6, 0.0], (50, 1)), pick="extremes")
    assert got.counts_full.shape == (1, 1)
    assert got.index.size == 5
    assert got.weight.sum() == 50


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"size": 0}, "size = 0"),
        ({"size": 1.5}, "size = 1.5"),
        ({"size": 11}, "1 <= size <= 10"),
        ({"pick": "best"}, "pick = 'best'"),
        ({"rounding": "down"}, "rounding = 'down'"),
        ({"classes": 0}, "classes = 0"),
        ({"classes": ([0.0, 2.0], [0.0, 5.0])}, r"values lie outside \[0, 5\)"),
        ({"classes": ([2.0, 0.0], 3)}, "must ascend"),
        ({"classes": (3, 3, 3)}, "3 entries"),
        ({"time": np.zeros(10)}, "does not rise after index 0"),
        ({"time": np.arange(9.0)}, r"time has shape \(9,\)"),
        ({"force": np.zeros((10, 3))}, r"\(10, 2\) is needed"),
        ({"speed": np.full(10, np.inf)}, "speed is inf at index"),
        ({"speed": np.array([])}, "n >= 1"),
    ],
)
def test_bad_input_is_named(change, message):
    arguments = {"speed": np.ones(10), "force": np.arange(20.0).reshape(10, 2), "time": None}
    with pytest.raises(InputError, match=message):
        histogram(**(arguments | change))


def test_a_tenth_of_a_full_record_keeps_the_sommerfeld_number():
    """Maximum exact, weighted mean within 0.2 %; both far within what the source reports."""
    speed, force, _ = record(24_000, seed=3)
    so = np.hypot(*force.T) / speed
    got = histogram(speed, force, size=0.1, pick="extremes")
    assert got.index.size < 0.15 * so.size
    assert so[got.index].max() == so.max()
    assert got.mean(so[got.index]) == pytest.approx(so.mean(), rel=2e-3)
    start = histogram(speed[:10_000], force[:10_000], size=0.2)
    assert start.index.size < 0.3 * 10_000
