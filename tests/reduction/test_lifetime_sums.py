"""Load cases summed over a lifetime, and the Markov matrix."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from load_record import record

from loadflow.errors import InputError
from loadflow.reduction import (
    damage_equivalent_load,
    lifetime_duration,
    lifetime_equivalent_load,
    load_duration,
    markov_matrix,
)

EDGES = (np.linspace(0.5, 2.0, 12), np.linspace(0.0, 6e6, 20))


def test_equal_cases_are_one_and_shares_that_are_missing_do_no_damage():
    loads = np.full((3, 2), 7.0)
    np.testing.assert_allclose(lifetime_equivalent_load(loads, [0.2, 0.3, 0.5], 4.0), 7.0)
    half = lifetime_equivalent_load(loads, [0.1, 0.15, 0.25], 4.0)
    np.testing.assert_allclose(half, 7.0 * 0.5**0.25)


def test_the_load_of_a_lifetime_is_that_of_its_cases_one_after_the_other():
    """Damage adds up: cycles of both series, each repeated in proportion to its share."""
    t = 0.005 * np.arange(20_001)
    calm, rough = np.sin(2 * np.pi * t), 3 * np.sin(2 * np.pi * 2 * t)
    loads = [damage_equivalent_load(x, 5.0, 100.0) for x in (calm, rough)]
    together = lifetime_equivalent_load(loads, [0.75, 0.25], 5.0)
    expected = (0.75 * 2.0**5 * 1.0 + 0.25 * 6.0**5 * 2.0) ** 0.2
    assert float(together) == pytest.approx(expected, rel=2e-3)  # half cycles at the ends


def test_time_and_revolutions_of_a_lifetime():
    parts = []
    for seed in (1, 2):
        speed, force, time = record(2000, seed)
        parts.append(load_duration(speed, force, time, classes=EDGES))
    year = 3.15e7
    got = lifetime_duration(parts, [0.3, 0.7], year)
    assert got.seconds.sum() == pytest.approx(year)
    factors = [year * share / part.seconds.sum() for share, part in zip((0.3, 0.7), parts)]
    turns = sum(f * part.revolutions for f, part in zip(factors, parts))
    np.testing.assert_allclose(got.revolutions, turns)
    one = lifetime_duration(parts[:1], [1.0], year)
    np.testing.assert_allclose(one.force, parts[0].force)
    assert one.equivalent_force() == pytest.approx(parts[0].equivalent_force())


@given(arrays(float, st.integers(1, 60), elements=st.integers(0, 9)))
def test_every_turning_point_leaves_to_the_next(x):
    matrix = markov_matrix(x, np.arange(11.0))
    counts = matrix.counts
    assert np.all(np.diag(counts) == 0)
    rises, falls = np.triu(counts).sum(), np.tril(counts).sum()
    assert abs(rises - falls) <= 1
    # what arrives in a class leaves it, except at both ends
    difference = counts.sum(axis=0) - counts.sum(axis=1)
    assert difference.sum() == 0
    assert np.abs(difference).sum() in (0, 2)
    moves = np.diff(x[np.concatenate(([True], np.diff(x) != 0))])
    assert counts.sum() == 0 if moves.size == 0 else 1 + np.sum(moves[1:] * moves[:-1] < 0)


def test_what_moves_within_a_class_does_not_count():
    ripple = np.array([0.2, 0.8, 0.1, 0.9, 2.5, 2.1, 2.9, 0.5])
    assert markov_matrix(ripple, [0, 1, 2, 3]).counts.tolist() == [[0, 0, 1], [0, 0, 0], [1, 0, 0]]


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lifetime_equivalent_load([1.0], [0.5, 0.5], 4), r"\(2, ...\) is needed"),
        (lambda: lifetime_equivalent_load([1.0], [-0.5], 4), "all >= 0"),
        (lambda: lifetime_equivalent_load([-1.0], [0.5], 4), "-1 is negative"),
        (lambda: lifetime_equivalent_load([1.0], [0.5], 0), "m = 0"),
        (lambda: lifetime_duration([], [1.0], 1.0), r"\(0,\) is needed"),
        (lambda: markov_matrix([]), "n >= 1"),
        (lambda: markov_matrix([1.0, 5.0], [0, 2]), "lie outside"),
    ],
)
def test_bad_input_is_named(call, message):
    with pytest.raises(InputError, match=message):
        call()


def test_other_classes_cannot_be_added():
    speed, force, time = record(200)
    parts = [load_duration(speed, force, time, classes=n) for n in (5, 6)]
    with pytest.raises(InputError, match="part 1 are not those of part 0"):
        lifetime_duration(parts, [0.5, 0.5], 1.0)
    with pytest.raises(InputError, match="duration = 0"):
        lifetime_duration(parts[:1], [1.0], 0.0)
