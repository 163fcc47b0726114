"""Rolling bearings where solvers usually break: clearance, preload, extremes, missing balance."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import SolverError
from loadflow.rolling import BallBearing, RollerBearing, SlewingBearing

BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=math.pi / 4,
    row_spacing=0.06,
)
GROOVE = BallBearing(
    balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3, groove_radius=6.604e-3, clearance=15e-6
)
PAIR = RollerBearing(
    rollers=48,
    roller_diameter=0.04,
    roller_length=0.06,
    pitch_diameter=0.8,
    contact_angle=0.35,
    rows=2,
    row_spacing=0.12,
)
DIRECTIONS = np.concatenate([np.eye(5), np.random.default_rng(5).normal(size=(15, 5))])


@pytest.mark.parametrize("magnitude", [1e-3, 1.0, 1e3, 1e6, 1e9])
@pytest.mark.parametrize("clearance", [-1e-4, 0.0, 1e-5, 2e-4])
def test_every_direction_from_a_millinewton_to_a_giganewton(magnitude, clearance):
    bearing = dataclasses.replace(BLADE, clearance=clearance)
    load = magnitude * DIRECTIONS
    result = bearing.equilibrium(force=load[:, :3], moment=load[:, 3:])
    assert result.converged.all()
    assert (result.residual <= 1e-8).all()
    assert np.isfinite(result.maximum_pressure).all()


@pytest.mark.parametrize("magnitude", [1e-3, 1e3, 1e7])
@pytest.mark.parametrize("clearance", [-4e-5, 0.0, 1e-4])
def test_tapered_pair_in_every_direction(magnitude, clearance):
    bearing = dataclasses.replace(PAIR, clearance=clearance)
    load = magnitude * DIRECTIONS
    result = bearing.equilibrium(force=load[:, :3], moment=load[:, 3:])
    assert (result.residual <= 1e-8).all()


def test_no_load_with_clearance_touches_nothing_and_says_so():
    loose = dataclasses.replace(BLADE, clearance=1e-5)
    result = loose.equilibrium(force=(0, 0, 0))
    assert result.converged
    assert result.singular
    assert (result.ball_forces == 0).all()
    assert (result.displacement == 0).all()
    assert np.isinf(result.static_safety)
    assert np.isinf(result.rating_life)


def test_preload_alone_loads_all_balls_alike():
    tight = dataclasses.replace(BLADE, clearance=-2e-5)
    result = tight.equilibrium(force=(0, 0, 0))
    forces = result.ball_forces
    assert forces.min() > 0
    assert np.ptp(forces) < 1e-9 * forces.max()
    assert not result.singular


def test_preload_is_lost_on_one_diagonal_under_axial_load():
    tight = dataclasses.replace(BLADE, clearance=-4e-5)
    loads = np.linspace(0, 2e6, 41)
    result = tight.equilibrium(force=loads[:, None] * [0, 0, 1])
    released = (result.ball_forces[:, :, 1] == 0).all(axis=(-2, -1))
    assert not released[0]
    assert released[-1]
    assert (np.diff(released.astype(int)) >= 0).all()
    # stiffness falls when the second diagonal lets go
    last = np.flatnonzero(~released)[-1]
    assert result.stiffness[last + 1, 2, 2] < result.stiffness[0, 2, 2]


def test_tiny_axial_load_with_clearance_closes_the_gap():
    loose = dataclasses.replace(BLADE, clearance=2e-5)
    result = loose.equilibrium(force=(0, 0, 1e-3))
    assert result.displacement[2] == pytest.approx(1e-5, rel=1e-3)
    assert result.ball_forces.sum() * math.sin(math.pi / 4) == pytest.approx(1e-3, rel=1e-3)


def test_one_ball_carries_a_radial_load_when_clearance_is_large():
    loose = dataclasses.replace(GROOVE, clearance=2e-4)
    result = loose.equilibrium(force=(10, 0, 0))
    assert (result.ball_forces > 0).sum() == 1
    assert result.ball_forces.max() == pytest.approx(10, rel=1e-9)
    assert result.residual <= 1e-8


def test_pure_moment_with_clearance():
    loose = dataclasses.replace(BLADE, clearance=5e-5)
    result = loose.equilibrium(force=(0, 0, 0), moment=(1e4, 0))
    assert result.residual <= 1e-8
    assert (result.ball_forces > 0).any()
    assert (result.ball_forces == 0).any()


def test_series_through_zero_load_keeps_every_case():
    t = np.linspace(0, 2 * np.pi, 101)
    loose = dataclasses.replace(BLADE, clearance=1e-5)
    result = loose.equilibrium(force=np.sin(t)[:, None] * [1e5, 0, 2e5])
    assert result.converged.all()
    assert result.maximum_force[50] < 1e-9  # sin π in floating point is not quite zero
    assert result.maximum_force[[0, 25]] == pytest.approx([0, result.maximum_force.max()])


@pytest.mark.parametrize("bearing", [dataclasses.replace(BLADE, clearance=1e-5),
                                     dataclasses.replace(PAIR, clearance=1e-4)])  # fmt: skip
def test_loads_below_the_last_digit_of_the_displacement_still_settle(bearing):
    load = np.array([1e-16, 1e-12, 1e-9, 1e-6])[:, None] * [0.3, 0.5, -0.2, 0.3, -0.9]
    result = bearing.equilibrium(force=load[:, :3], moment=load[:, 3:])
    assert result.converged.all()
    assert np.ptp(result.displacement, axis=0) == pytest.approx(0, abs=2e-8)


def test_cylindrical_rollers_bear_no_axial_force():
    bearing = RollerBearing(
        rollers=12, roller_diameter=15e-3, roller_length=16e-3, pitch_diameter=65e-3
    )
    with pytest.raises(SolverError, match=r"index \(1,\).*Fz = 10"):
        bearing.equilibrium(force=[(1e4, 0, 0), (1e4, 0, 10)])
    flagged = bearing.equilibrium(force=[(1e4, 0, 0), (1e4, 0, 10)], strict=False)
    assert flagged.converged.tolist() == [True, False]


def test_single_tapered_row_bears_no_force_the_wrong_way():
    single = dataclasses.replace(PAIR, rows=1)
    assert single.equilibrium(force=(0, 0, 1e4)).converged
    with pytest.raises(SolverError, match="Fz = -10000"):
        single.equilibrium(force=(0, 0, -1e4))
