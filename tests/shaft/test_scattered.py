"""Functions known at scattered places, by which costly bearings are told between their samples."""

import numpy as np
import pytest

from loadflow.shaft.scattered import interpolation


def straight(places):
    return places @ np.array([[1.0, 2.0], [-3.0, 0.5], [0.25, 4.0]]) + 7.0


@pytest.mark.parametrize("speed", ["the same as another column", "constant"])
def test_places_that_span_fewer_directions_than_columns_are_interpolated_between(speed):
    rng = np.random.default_rng(2)
    known, places = rng.uniform(-0.5, 0.5, (20, 3)), rng.uniform(-0.3, 0.3, (50, 3))
    for some in (known, places):
        some[:, 2] = some[:, 1] if speed.startswith("the same") else 0.5
    found = interpolation(known, straight(known))(places)
    assert found == pytest.approx(straight(places), abs=1e-9)


def test_a_place_off_those_that_are_known_has_the_value_of_the_nearest_among_them():
    rng = np.random.default_rng(3)
    known = rng.uniform(-0.5, 0.5, (20, 3))
    known[:, 2] = 0.5
    off = known + np.array([0.0, 0.0, 0.1])
    table = straight(known)
    assert interpolation(known, table)(off) == pytest.approx(table, abs=1e-9)
