"""Sliced roller bearings: closed forms, profiles, pairs, life, laws."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import RollerBearing
from loadflow.rolling.rating import capacity

CYLINDRICAL = RollerBearing(
    rollers=12,
    roller_diameter=15e-3,
    roller_length=16e-3,
    pitch_diameter=65e-3,
    profile="straight",
)
PAIR = RollerBearing(
    rollers=48,
    roller_diameter=0.04,
    roller_length=0.06,
    pitch_diameter=0.8,
    contact_angle=0.35,
    rows=2,
    row_spacing=0.12,
    clearance=-20e-6,
)


def test_one_slice_follows_the_line_contact_law():
    one = dataclasses.replace(CYLINDRICAL, slices=1, clearance=1e-3)
    result = one.equilibrium(force=(1000, 0, 0))
    # all on one roller: q = 35 948 L^(8/9) δ^(10/9) in N and mm
    delta = (result.displacement[0] - 0.5e-3) * 1e3
    assert 35_948 * 16 ** (8 / 9) * delta ** (10 / 9) == pytest.approx(1000, rel=1e-6)


def test_slices_of_a_straight_roller_share_alike():
    forces = CYLINDRICAL.equilibrium(force=(1e4, 0, 0)).slice_forces
    assert np.ptp(forces, axis=1) == pytest.approx(0, abs=1e-9)
    one = dataclasses.replace(CYLINDRICAL, slices=1).equilibrium(force=(1e4, 0, 0))
    assert forces.sum(axis=1) == pytest.approx(one.slice_forces.sum(axis=1), rel=1e-12)


def test_stribeck_constant_of_rollers():
    result = CYLINDRICAL.equilibrium(force=(1e4, 0, 0))
    assert result.maximum_force * 12 / 1e4 == pytest.approx(4.08, abs=0.05)


def test_profile_unloads_the_ends():
    curved = dataclasses.replace(CYLINDRICAL, profile="iso").equilibrium(force=(1e4, 0, 0))
    first = curved.slice_forces[0, :, 0]
    assert first[0] < first[15]
    assert first == pytest.approx(first[::-1], rel=1e-9)
    assert (np.diff(first[:15]) > 0).all()


def test_iso_profile_drops_as_printed():
    drop = dataclasses.replace(CYLINDRICAL, profile="iso", slices=2).profile_drop
    expected = 0.00035 * 15e-3 * math.log(1 / (1 - 0.5**2))
    assert drop == pytest.approx([expected] * 2)
    long = dataclasses.replace(PAIR, roller_length=0.15).profile_drop
    assert (long[np.abs(np.arange(30) - 14.5) < 4] == 0).all()
    assert long[0] > 0


def test_crowned_roller_follows_its_radius():
    crowned = dataclasses.replace(CYLINDRICAL, profile="crowned", crown_radius=5.0, slices=4)
    assert crowned.profile_drop[0] == pytest.approx(6e-3**2 / 10)


def test_tilt_moves_the_load_along_the_roller():
    forces = CYLINDRICAL.equilibrium(force=(1e4, 0, 0), moment=(0, 5.0)).slice_forces[0, :, 0]
    assert forces[-1] > forces[0]


@pytest.mark.parametrize("clearance", [-40e-6, 0.0, 30e-6])
def test_forces_of_the_pair_balance_the_load(clearance):
    load = np.array([5e4, -4e5, 1e5, 2e4, 1e4])
    bearing = dataclasses.replace(PAIR, clearance=clearance)
    result = bearing.equilibrium(force=load[:3], moment=load[3:])
    table, phi = result.contacts.table, result.contacts.azimuth
    force = result.slice_forces.reshape(-1, bearing.rollers)
    radial, axial = force * table[:, 2, None], force * table[:, 3, None]
    lever = table[:, 1, None] * radial - table[:, 0, None] * axial
    total = [(radial * np.cos(phi)).sum(), (radial * np.sin(phi)).sum(), axial.sum(),
             -(lever * np.sin(phi)).sum(), (lever * np.cos(phi)).sum()]  # fmt: skip
    assert total == pytest.approx(load, abs=1e-8 * 4e5)


def test_stiffness_is_symmetric_and_the_slope_of_the_load():
    load = np.array([5e4, -4e5, 1e5, 2e4, 1e4])
    steps = np.eye(5)
    at = lambda x: PAIR.equilibrium(force=x[..., :3], moment=x[..., 3:], tolerance=1e-13)  # noqa: E731
    compliance = (at(load + steps).displacement - at(load - steps).displacement).T / 2
    assert at(load).stiffness @ compliance == pytest.approx(np.eye(5), abs=1e-3)


def test_preload_stiffens_the_pair():
    tight, loose = (
        dataclasses.replace(PAIR, clearance=c).equilibrium(force=(0, 0, 1e4)).stiffness[2, 2]
        for c in (-40e-6, 0.0)
    )
    assert tight > 1.5 * loose


def test_axial_clearance_is_the_free_travel():
    loose = dataclasses.replace(PAIR, clearance=100e-6, profile="straight")
    up, down = loose.equilibrium(force=[(0, 0, 1), (0, 0, -1)]).displacement[:, 2]
    assert up - down == pytest.approx(loose.axial_clearance, rel=1e-3)


def test_life_of_one_slice_without_clearance_is_that_of_the_capacity():
    # the capacity holds for half the circle loaded; 0.83 stands for edges, which one slice has not,
    # and lines carry the fourth power in ISO/TS 16281, not 10/3
    bearing = dataclasses.replace(CYLINDRICAL, clearance=0.0, slices=1)
    result = bearing.equilibrium(force=(1e4, 0, 0))
    simple = (bearing.rated_capacity / 0.83 / 1e4) ** 4
    assert result.reference_life == pytest.approx(simple, rel=0.03)


@pytest.mark.parametrize(("gamma", "f_c"), [(0.01, 52.1), (0.10, 84.2)])
def test_capacity_of_rollers_follows_the_closed_form(gamma, f_c):
    size = {"rollers": 1, "rows": 1, "roller_diameter": 1e-3, "roller_length": 1e-3}
    value = capacity.radial_roller_capacity(**size, contact_angle=0.0, gamma=gamma)
    assert value / 1.1 == pytest.approx(f_c, rel=2e-3)


def test_edge_stress_is_largest_at_the_ends_and_one_in_the_middle():
    factor = capacity.edge_stress(31)
    assert factor[0] == factor.max() > 2
    assert factor[15] == 1
    assert factor == pytest.approx(factor[::-1])


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("rollers", 50),
        ("roller_length", 0.0),
        ("pitch_diameter", 0.01),
        ("profile", "conical"),
        ("profile", "crowned"),
        ("slices", 0),
        ("law", "x"),
    ],
)
def test_bad_geometry_is_refused(field, value):
    with pytest.raises(InputError, match=r"must|fit|belongs"):
        dataclasses.replace(CYLINDRICAL, **{field: value})
