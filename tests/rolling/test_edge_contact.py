"""Pressure under one roller by influence coefficients: closed forms, edges, slices."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.rolling import RollerBearing, edge_contact, hertz_point
from loadflow.studies.one_bearing.rolling import rolling_point

ROLLER = RollerBearing(
    rollers=12,
    roller_diameter=15e-3,
    roller_length=16e-3,
    pitch_diameter=65e-3,
    profile="straight",
)
CELLS = (64, 32)


def test_a_short_crown_is_hertz_point_contact():
    crowned = dataclasses.replace(ROLLER, profile="crowned", crown_radius=0.2)
    ours = edge_contact(crowned, 500.0, cells=(128, 64))
    roller, gamma = 2 / 15e-3, ROLLER.gamma
    hertz = hertz_point(roller, 5.0, roller * gamma / (1 - gamma), 0.0, force=500.0)
    assert ours.maximum_pressure == pytest.approx(float(hertz.pressure), rel=2e-3)
    assert ours.approach == pytest.approx(float(hertz.approach), rel=1e-3)


def test_the_middle_of_a_straight_roller_is_hertz_line_contact():
    ours = edge_contact(ROLLER, 5e3, cells=CELLS)
    step = ours.along[1] - ours.along[0]
    line = ROLLER.slice_contact("inner", ours.slice_forces[32] / step * 16e-3 / ROLLER.slices)
    assert ours.pressure[32].max() == pytest.approx(float(line.pressure), rel=3e-3)


def test_edges_of_a_straight_roller_are_loaded_hardest_and_a_profile_relieves_them():
    straight = edge_contact(ROLLER, 5e3, cells=CELLS)
    relieved = edge_contact(dataclasses.replace(ROLLER, profile="iso"), 5e3, cells=CELLS)
    assert straight.edge_factor() > 1.4
    assert relieved.edge_factor() < 0.7
    assert straight.maximum_pressure > relieved.maximum_pressure


def test_tilt_loads_one_end_and_independent_slices_miss_the_peak():
    tilted = edge_contact(ROLLER, 5e3, 1e-3, cells=CELLS)
    assert tilted.slice_forces[0] > 2 * tilted.slice_forces[-1]
    other = edge_contact(ROLLER, 5e3, -1e-3, cells=CELLS)
    assert other.slice_forces[::-1] == pytest.approx(tilted.slice_forces, rel=1e-3, abs=0.1)
    step = tilted.along[1] - tilted.along[0]
    own = ROLLER.slice_contact("inner", tilted.slice_forces.max() / step * 16e-3 / 30).pressure
    assert tilted.maximum_pressure > 0.8 * float(own)


@pytest.mark.parametrize("raceway", ["inner", "outer"])
def test_forces_add_up_and_pressure_is_where_the_gap_is_closed(raceway):
    ours = edge_contact(ROLLER, 2e3, 2e-4, raceway=raceway, cells=CELLS)
    assert ours.slice_forces.sum() == pytest.approx(2e3, rel=1e-12)
    assert (ours.pressure >= 0).all()
    assert not ours.pressure[:, [0, -1]].any()
    assert ours.converged
    assert ours.residual <= 1e-6
    assert np.abs(ours.across).max() < 1e-3


def test_what_cannot_be_solved_is_said():
    for force in (0.0, -1.0, math.inf):
        with pytest.raises(InputError, match="force"):
            edge_contact(ROLLER, force)
    with pytest.raises(SolverError, match="residual"):
        edge_contact(ROLLER, 1e3, max_iterations=3)


def test_a_point_reports_the_edges_of_its_hardest_pressed_roller():
    bearing = RollerBearing(
        rollers=48, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8
    )

    def point(bearing, moment):
        found = rolling_point(bearing, "rigid", (2e5, 0, 0), (0, moment))
        return [float(found[name]) for name in ("maximum_pressure", "edge_pressure", "edge_factor")]

    slices, edges, factor = point(bearing, 0.0)
    assert edges == pytest.approx(slices, rel=0.03)
    assert factor < 0.1
    slices, edges, factor = point(dataclasses.replace(bearing, profile="straight"), 0.0)
    assert edges > 1.3 * slices
    assert factor > 1.3
    whole = bearing.equilibrium((2e5, 0, 0), (0, 2e4))
    half = 0.5 * whole.displacement[4]  # as a roller tilts in each raceway
    alone = edge_contact(bearing, whole.roller_forces.max(), half)
    for moment in (-2e4, 2e4):
        _, edges, factor = point(bearing, moment)
        assert edges == pytest.approx(alone.maximum_pressure, rel=1e-6)
        assert factor == pytest.approx(alone.edge_factor(), rel=1e-6)
