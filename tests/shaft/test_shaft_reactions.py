"""What the bearings take is what the rotor and the weights give, in every component."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.shaft import MomentBearing, ThreePoint, TwoPoint, bearing_loads
from loadflow.shaft.reactions import GRAVITY

LOAD = st.floats(-1e7, 1e7)
VECTOR = st.tuples(LOAD, LOAD, LOAD).map(lambda v: np.array(v)[:, None])
LENGTH = st.floats(0.1, 10.0)
MASS = st.floats(0.0, 2e5)
TILT = st.floats(-0.3, 0.3)


def weight(mass, tilt):
    return mass * GRAVITY * np.array([np.sin(tilt), 0.0, -np.cos(tilt)])


def moment_about_hub(position, force):
    return np.cross([position, 0.0, 0.0], force)


def assert_balanced(loads, force, moment, own):
    """Rotor and own weights against the bearings: six equations, the torque excepted."""
    given_force = force[:, 0] + sum(f for _, f in own)
    given_moment = moment[:, 0] + sum(moment_about_hub(x, f) for x, f in own)
    taken = loads["force"].values[:, :, 0]
    taken_moment = sum(
        moment_about_hub(x, f) + m
        for x, f, m in zip(loads["position"].values, taken, loads["moment"].values[:, :, 0])
    )
    scale = 1 + np.abs(taken).max() + np.abs(given_moment).max()
    assert taken.sum(axis=0) == pytest.approx(given_force, abs=1e-12 * scale)
    assert taken_moment[1:] == pytest.approx(given_moment[1:], abs=1e-11 * scale)


@given(VECTOR, VECTOR, LENGTH, LENGTH, LENGTH, MASS, MASS, TILT)
def test_two_point_suspension_is_in_equilibrium(f, m, first, span, overhang, gear, shaft, tilt):
    concept = TwoPoint(first, span, overhang, gear, shaft, hub_to_shaft_centre=2.0)
    loads = bearing_loads(concept, f, m, tilt=tilt)
    own = [(concept.gearbox_position, weight(gear, tilt)), (2.0, weight(shaft, tilt))]
    assert_balanced(loads, f, m, own)
    assert loads["force"].sel(bearing="N", axis="x").item() == 0.0


@given(VECTOR, VECTOR, LENGTH, LENGTH, MASS, TILT)
def test_three_point_suspension_is_in_equilibrium(f, m, first, span, gear, tilt):
    concept = ThreePoint(first, span, 0.5, gear)
    assert_balanced(
        bearing_loads(concept, f, m, tilt=tilt),
        f,
        m,
        [(first + span + 0.5, weight(gear, tilt))],
    )


@given(VECTOR, VECTOR, LENGTH, MASS, TILT)
def test_moment_bearing_is_in_equilibrium(f, m, distance, shaft, tilt):
    concept = MomentBearing(distance, shaft, hub_to_shaft_centre=3.0)
    assert_balanced(bearing_loads(concept, f, m, tilt=tilt), f, m, [(3.0, weight(shaft, tilt))])


@given(VECTOR, VECTOR, VECTOR, VECTOR)
def test_loads_without_weight_superpose(f1, m1, f2, m2):
    concept = TwoPoint(gearbox_mass=0.0)
    both = bearing_loads(concept, f1 + f2, m1 + m2)["force"].values
    single = sum(bearing_loads(concept, f, m)["force"].values for f, m in ((f1, m1), (f2, m2)))
    assert both == pytest.approx(single, abs=1e-6)


def test_moment_bearing_sees_the_gauge_moments_of_openfast():
    # 1.912 m behind the apex OpenFAST states Mys + 1.912 Fzs and Mzs − 1.912 Fys
    loads = bearing_loads(MomentBearing(1.912), [[0.0], [2.0], [3.0]], [[9.0], [5.0], [7.0]])
    expected = [0.0, 5.0 + 1.912 * 3.0, 7.0 - 1.912 * 2.0]
    assert loads["moment"].values[0, :, 0] == pytest.approx(expected)


def test_one_sided_torque_support_loads_the_locating_bearing():
    torque = np.array([[4e6], [0.0], [0.0]])
    plain = bearing_loads(TwoPoint(), np.zeros((3, 1)), torque)["force"]
    armed = bearing_loads(TwoPoint(torque_arm=2.0), np.zeros((3, 1)), torque)["force"]
    change = (armed - plain).sel(axis="z").values[:, 0]
    assert change.sum() == pytest.approx(-4e6 / 2.0)
    assert change[1] == pytest.approx(-2e6 * (3.6 + 1.2) / 3.6)


@pytest.mark.parametrize(
    ("force", "message"),
    [
        ([[0.0, 1.0]], r"shape must be \(3, n\)"),
        ([[0.0], [np.nan], [0.0]], "nan at axis y, index 0"),
    ],
)
def test_bad_loads_are_named(force, message):
    with pytest.raises(InputError, match=message):
        bearing_loads(TwoPoint(), force, np.zeros((3, 1)))


def test_bad_distances_are_named():
    with pytest.raises(InputError, match=r"span = -1"):
        TwoPoint(span=-1)
