"""Cases with flexible rings are solved in an order of neighbours, and answered as they came."""

import numpy as np
import pytest

from loadflow.numerics.neighbours import near_order
from loadflow.rolling import FlexibleRings, RingBeam, RingSection, SlewingBearing, Support

WALL = Support.wall(radius=0.3, height=0.06, thickness=0.03, length=0.3)
OUTER = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.3, supports=(WALL,))
RINGS = FlexibleRings(outer=OUTER)
BEARING = SlewingBearing(
    balls=24, ball_diameter=0.04, pitch_diameter=0.5, groove_radius=0.0208, contact_angle=0.785
)


def way(points):
    return np.linalg.norm(np.diff(points, axis=0), axis=1).sum()


def shuffled(count):
    turn = np.linspace(0.0, 2.0 * np.pi, count)
    points = np.stack([np.cos(turn), np.sin(turn), 0.1 * turn, 0.0 * turn, 0.0 * turn], axis=1)
    return np.random.default_rng(3).permutation(points)


def test_scattered_points_come_as_neighbours_each_of_them_once():
    points = shuffled(400)
    order = near_order(points, 512)
    np.testing.assert_array_equal(np.sort(order), np.arange(400))
    assert way(points[order]) < 0.1 * way(points)


def test_each_chunk_stays_together_and_begins_with_its_first():
    order = near_order(shuffled(100), 40)
    for first in (0, 40, 80):
        some = order[first : first + 40]
        assert some[0] == first
        assert set(some) == set(range(first, min(first + 40, 100)))


def test_a_series_in_time_stays_as_it_comes():
    time = np.linspace(0.0, 20.0, 500)
    points = np.stack([np.cos(time), np.sin(3.1 * time), np.cos(0.7 * time)], axis=1)
    np.testing.assert_array_equal(near_order(points, 512), np.arange(500))


def test_scattered_loads_are_answered_as_they_came_in_fewer_iterations():
    load = shuffled(300) * [2e4, 2e4, 5e4, 1.0, 1.0] + [0.0, 0.0, 5e4, 0.0, 0.0]
    force, moment = load[:, :3], load[:, 3:]
    each = BEARING.equilibrium(force, moment, rings=RINGS, chunk=1)
    found = BEARING.equilibrium(force, moment, rings=RINGS)
    np.testing.assert_array_equal(found.force, force)
    np.testing.assert_allclose(found.displacement, each.displacement, rtol=1e-6, atol=1e-12)
    assert found.maximum_force == pytest.approx(each.maximum_force, rel=1e-8)
    assert found.iterations.mean() < each.iterations.mean()
