"""Stationary loads: each is what its name says."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.reduction import stationary


def test_largest_force_lowest_speed_and_mean_and_envelope():
    rng = np.random.default_rng(0)
    speed, force = rng.uniform(0.9, 1.3, 500), rng.standard_normal((500, 2)) * 1e5 + [2e6, 0]
    got = stationary(speed, force, np.arange(500.0))
    resultant = np.hypot(*force.T)
    assert got.maximum.speed == speed.min()
    assert got.maximum.resultant == resultant.max()
    assert got.maximum.index is None
    np.testing.assert_allclose(got.mean.force, force.mean(axis=0))
    assert got.mean.speed == pytest.approx(speed.mean())
    for load in got.envelope:
        assert load.speed == speed[load.index]
        np.testing.assert_array_equal(load.force, force[load.index])
    assert got["largest force over speed"].index == np.argmax(resultant / speed)
    assert got["smallest second component"].force[1] == force[:, 1].min()
    # no moment of the series is worse than the first case
    assert np.all(resultant / speed <= got.maximum.resultant / got.maximum.speed)


def test_standstill_is_the_severest_moment():
    got = stationary([1.0, 0.0, -2.0], [[1, 0], [1, 0], [9, 0]])
    assert got["largest force over speed"].index == 1
    assert got["lowest speed"].speed == 0.0
    assert got["highest speed"].speed == -2.0
    with pytest.raises(InputError, match="force is nan at index"):
        stationary([1.0], [[np.nan, 0.0]])
