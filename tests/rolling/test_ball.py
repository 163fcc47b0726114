"""Ball bearings: load directions, clearance, rows, life; printed cases are in the validation."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import BallBearing

BALL = 11.5e-3
GROOVE = BallBearing(
    balls=7,
    ball_diameter=BALL,
    pitch_diameter=43.5e-3,
    groove_radius=0.52 * BALL,
    outer_groove_radius=0.53 * BALL,
    dynamic_capacity=23_400,
)
ANGULAR = dataclasses.replace(GROOVE, contact_angle=math.radians(40), dynamic_capacity=None)


def test_209_deep_groove_bearing():
    ball = 12.7e-3
    bearing = BallBearing(
        balls=9,
        ball_diameter=ball,
        pitch_diameter=65e-3,
        groove_radius=0.52 * ball,
        clearance=15e-6,
        elastic_modulus=206.8e9,
    )
    result = bearing.equilibrium(force=(8900, 0, 0))
    assert result.displacement[0] == pytest.approx(60.59e-6, rel=1e-4)
    loads = np.sort(result.ball_forces[0])[::-1]
    assert loads[[0, 1, 3]] == pytest.approx([4526.5, 2840.6, 61.45], rel=1e-4)
    assert [float(p) for p in result.raceway_pressure] == pytest.approx([3090e6, 2582e6], rel=2e-4)


@pytest.mark.parametrize(
    ("balls", "ball", "pitch", "capacity"),
    [(7, 11.5, 43.5, 23.37e3), (9, 12.7, 65.0, 34.18e3)],
)
def test_capacity_from_geometry(balls, ball, pitch, capacity):
    bearing = BallBearing(balls=balls, ball_diameter=ball / 1e3, pitch_diameter=pitch / 1e3,
                          groove_radius=0.52 * ball / 1e3)  # fmt: skip
    assert bearing.rated_capacity == pytest.approx(capacity, rel=1e-3)


def test_stribeck_constant_of_a_bearing_without_clearance():
    many = dataclasses.replace(GROOVE, balls=11, ball_diameter=8e-3, groove_radius=4.16e-3,
                               outer_groove_radius=None, pitch_diameter=43.5e-3)  # fmt: skip
    result = many.equilibrium(force=(1000, 0, 0))
    assert result.maximum_force * 11 / 1000 == pytest.approx(4.37, abs=0.05)


def test_deep_groove_bearing_is_symmetric_in_axial_load():
    up, down = GROOVE.equilibrium(force=[(200, 0, 1000), (200, 0, -1000)]).displacement
    assert down == pytest.approx(up * [1, 1, -1, -1, -1], abs=1e-12)


def test_radial_life_with_clearance_is_shorter():
    lives = [
        float(dataclasses.replace(GROOVE, clearance=s).equilibrium(force=(1000, 0, 0)).rating_life)
        for s in (-5e-6, 0.0, 10e-6, 50e-6)
    ]
    assert lives[1] > lives[2] > lives[3]


def test_life_falls_with_the_cube_of_the_load():
    # displacement grows as F^(2/3) exactly while contact angles stay
    life = GROOVE.equilibrium(force=np.array([[1.0], [2.0]]) * [1000, 0, 0]).rating_life
    assert life[0] / life[1] == pytest.approx(8, rel=1e-3)


def test_equivalent_load_is_that_of_the_life():
    result = GROOVE.equilibrium(force=(1000, 0, 500))
    assert (23_400 / result.equivalent_load) ** 3 == pytest.approx(float(result.rating_life))


def test_back_to_back_pair_is_stiffer_against_tilt_than_face_to_face():
    def tilt(arrangement):
        pair = dataclasses.replace(ANGULAR, rows=2, row_spacing=0.02, arrangement=arrangement,
                                   clearance=-5e-6)  # fmt: skip
        return pair.equilibrium(force=(0, 0, 0), moment=(5, 0)).displacement[3]

    assert tilt("back-to-back") < 0.7 * tilt("face-to-face")


def test_pair_carries_axial_load_by_one_row_each_way():
    pair = dataclasses.replace(ANGULAR, rows=2, row_spacing=0.02)
    up, down = pair.equilibrium(force=[(0, 0, 1e3), (0, 0, -1e3)]).ball_forces
    assert (up[0] > 0).all()
    assert (up[1] == 0).all()
    assert down[::-1] == pytest.approx(up, rel=1e-9)


def test_lever_arm_changes_tilt_and_life_as_documented():
    pitch = dataclasses.replace(GROOVE, lever="pitch")
    ours, theirs = (b.equilibrium(force=(0, 0, 0), moment=(0, 1)) for b in (GROOVE, pitch))
    assert theirs.displacement[4] / ours.displacement[4] == pytest.approx(1.013, abs=2e-3)
    assert theirs.rating_life / ours.rating_life == pytest.approx(0.97, abs=0.01)


@pytest.mark.parametrize("lever", ["groove", "pitch"])
def test_stiffness_is_symmetric_and_the_slope_of_the_load(lever):
    bearing = dataclasses.replace(GROOVE, lever=lever, clearance=10e-6)
    load = np.array([500.0, 300, 400, 0.7, -0.4])
    steps = np.diag([1e-2, 1e-2, 1e-2, 1e-4, 1e-4])
    at = lambda x: bearing.equilibrium(force=x[..., :3], moment=x[..., 3:], tolerance=1e-14)  # noqa: E731
    compliance = (at(load + steps).displacement - at(load - steps).displacement).T
    compliance /= 2 * np.diag(steps)
    assert at(load).stiffness @ compliance == pytest.approx(np.eye(5), abs=2e-3)


@pytest.mark.parametrize(
    ("field", "value"),
    [("outer_groove_radius", 0.005), ("clearance", 2e-3), ("arrangement", "x"), ("lever", "x")],
)
def test_bad_geometry_is_refused_by_name(field, value):
    with pytest.raises(InputError, match=field):
        dataclasses.replace(GROOVE, **{field: value})
