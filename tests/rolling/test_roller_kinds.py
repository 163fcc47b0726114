"""Spherical, crossed and three-row roller bearings: closed forms, symmetry, refusals."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.rolling import (
    CrossedRollerBearing,
    FrictionOptions,
    RollerRaceways,
    SphericalRollerBearing,
    ThreeRowRollerBearing,
    ToroidalRollerBearing,
)
from loadflow.rolling.rating import capacity
from loadflow.tribology import lubricant

SPHERICAL = SphericalRollerBearing(
    rollers=28, roller_diameter=0.08, roller_length=0.12, pitch_diameter=0.95, contact_angle=0.17
)
CROSSED = CrossedRollerBearing(
    rollers=180, roller_diameter=0.04, roller_length=0.038, pitch_diameter=2.6
)
ROW = {"rollers": 28, "roller_diameter": 0.08, "roller_length": 0.12, "pitch_diameter": 0.95}
TOROIDAL = ToroidalRollerBearing(**ROW, raceway_radius=1.2, clearance=2e-4)
AXIAL = RollerRaceways(
    rollers=150, roller_diameter=0.05, roller_length=0.05, pitch_diameter=3.0, slices=20
)
RADIAL = RollerRaceways(
    rollers=160, roller_diameter=0.032, roller_length=0.04, pitch_diameter=3.0, slices=20
)
THREE = ThreeRowRollerBearing(support=AXIAL, retaining=AXIAL, radial=RADIAL)


def balance(result, load):
    """Largest difference of contact forces times their directions from the load."""
    total = (result.contact_forces[..., None] * result.contact_directions).sum(axis=(-3, -2))
    return np.abs(total - load).max() / np.abs(load).max()


@pytest.mark.parametrize("bearing", [SPHERICAL, CROSSED, THREE], ids=lambda b: type(b).__name__)
def test_contact_forces_balance_the_load(bearing):
    tilt = (0.0, 0.0) if bearing is SPHERICAL else (3e5, -5e5)
    force = (4e5, -2e5, 1e5)
    result = bearing.equilibrium(force, tilt)
    assert balance(result, np.array([*force, *tilt])) < 1e-9
    assert result.residual < 1e-10


def test_spherical_bearing_takes_no_moment_and_tilts_freely():
    with pytest.raises(InputError, match="moment"):
        SPHERICAL.equilibrium((1e5, 0, 0), (1.0, 0))
    result = SPHERICAL.equilibrium([(1e6, 0, 2e5), (0, 1e6, 2e5)])
    assert result.singular.all()
    assert result.displacement[:, 3:] == pytest.approx(0, abs=1e-12)
    assert result.stiffness[:, 3:, 3:] == pytest.approx(0, abs=1e-3)


def test_rows_of_a_spherical_bearing_share_radial_load_and_one_takes_the_thrust():
    radial, axial = SPHERICAL.equilibrium([(1e6, 0, 0), (0, 0, 3e5)]).roller_forces
    assert radial[0] == pytest.approx(radial[1], rel=1e-9)
    assert axial[0] == pytest.approx(0, abs=1e-6)
    assert axial[1] == pytest.approx(3e5 / 28 / math.sin(0.17), rel=1e-9)


def test_a_toroidal_bearing_carries_as_barrels_in_a_sphere_but_neither_thrust_nor_moment():
    force = [(1e6, 2e5, 0), (0, -2e6, 0)]
    row = SphericalRollerBearing(**ROW, rows=1, clearance=2e-4)
    assert TOROIDAL.equilibrium(force).roller_forces == pytest.approx(
        row.equilibrium(force).roller_forces, rel=1e-12
    )
    assert TOROIDAL.equilibrium(force).singular.all()
    assert not TOROIDAL.takes_thrust
    with pytest.raises(SolverError, match="No contact may resist"):
        TOROIDAL.equilibrium((1e6, 0, 1e5))
    with pytest.raises(InputError, match="moment"):
        TOROIDAL.equilibrium((1e6, 0, 0), (1.0, 0))


def test_displaced_toroidal_rings_touch_where_the_arcs_of_their_raceways_do():
    # a barrel is a lens of two arcs whose centres are 2R - D apart; displaced centres of the
    # raceways are further from each other, until nothing is left between the raceways and it
    apart = 2 * 1.2 - 0.08
    shift = math.sqrt(apart**2 - (apart - 1e-4) ** 2)  # takes all of the gap of 0.1 mm
    moved = dataclasses.replace(TOROIDAL, shift=shift)
    assert moved.lost_clearance == pytest.approx(2e-4, rel=1e-4)
    tight = dataclasses.replace(TOROIDAL, clearance=0.0).equilibrium((1e5, 0, 0))
    assert moved.equilibrium((1e5, 0, 0)).maximum_force == pytest.approx(
        tight.maximum_force, rel=1e-3
    )


def test_barrels_slip_less_in_flatter_raceways():
    options = FrictionOptions(oil=lubricant("lgep-2"), temperature=313.15, roughness=0.3e-6)
    sphere = SphericalRollerBearing(**ROW, rows=1)
    lost = [
        float(bearing.equilibrium((1e6, 0, 0)).friction(1.2, options).losses["differential slip"])
        for bearing in (sphere, TOROIDAL, dataclasses.replace(TOROIDAL, raceway_radius=3.0))
    ]
    assert lost[0] > 2 * lost[1] > 4 * lost[2] > 0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"rows": 2}, "rows: it has one"),
        ({"row_spacing": 0.1}, "rows: it has one"),
        ({"contact_angle": 0.1}, r"contact_angle: must be 0, .* got 0\.1"),
        ({"raceway_radius": 0.515}, r"raceway_radius: must be > 0\.515 m"),
        ({"shift": 1.0}, "shift"),
        ({"shift": 0.3}, "shift: must be less than half the length of a roller"),
    ],
)
def test_what_is_no_toroidal_bearing_is_refused(change, message):
    with pytest.raises(InputError, match=message):
        dataclasses.replace(TOROIDAL, **change)


def test_crossed_rollers_share_thrust_alike():
    result = CROSSED.equilibrium([(0, 0, 5e5), (0, 0, -5e5)])
    each = 5e5 / 90 / math.sin(math.pi / 4)
    assert result.roller_forces[0] == pytest.approx(np.stack([np.full(90, each), np.zeros(90)]))
    assert result.roller_forces[1] == pytest.approx(result.roller_forces[0][::-1])


def test_crossed_rollers_follow_one_another_around():
    around = CROSSED.contacts().kind_azimuth[:: CROSSED.slices]
    assert np.diff(np.sort(around.ravel())) == pytest.approx(2 * math.pi / 180)


def test_rows_of_a_three_row_ring_divide_the_work():
    support, retaining, radial = THREE.equilibrium((3e5, 0, 6e5)).roller_forces
    support = support[: THREE.support.rollers]  # short rows are padded with zeros
    assert support == pytest.approx(6e5 / 150, rel=1e-9)
    assert retaining == pytest.approx(0, abs=1e-9)
    assert (radial * np.cos(2 * np.pi * np.arange(160) / 160)).sum() == pytest.approx(3e5)
    tilted = THREE.equilibrium((0, 0, 0), (0, 1e6)).roller_forces
    assert tilted[0].sum() == pytest.approx(tilted[1].sum(), rel=1e-9)
    assert tilted[0].max() == pytest.approx(tilted[1].max(), rel=1e-2)


def test_three_row_life_is_that_of_its_rows():
    thrust = THREE.equilibrium((0, 0, 1e6))
    # λν = 0.73 of the capacity stands for the edges, which the slices state themselves
    assert 0.73e6 < thrust.equivalent_load < 1e6
    assert THREE.equilibrium((5e5, 0, 1e6)).reference_life < thrust.reference_life
    assert 1 < thrust.static_safety < thrust.pressure_safety**2 * (1 + 1e-12)


@pytest.mark.parametrize(("gamma", "f_c"), [(0.01, 105.4), (0.06, 156.9), (0.2, 205.0)])
def test_thrust_roller_factor_is_that_of_iso_281(gamma, f_c):
    ours = capacity.thrust_roller_capacity(
        rollers=1, roller_diameter=1e-3, roller_length=1e-3, contact_angle=math.pi / 2, gamma=gamma
    )
    assert ours == pytest.approx(f_c, rel=2e-3)


@pytest.mark.parametrize(
    ("bearing", "field", "value"),
    [
        (SPHERICAL, "rows", 3),
        (SPHERICAL, "row_spacing", 0.1),
        (SPHERICAL, "contact_angle", 0.0),
        (CROSSED, "rollers", 181),
        (CROSSED, "roller_length", 0.05),
        (CROSSED, "contact_angle", 0.0),
        (CROSSED, "rows", 2),
        (THREE, "support", dataclasses.replace(AXIAL, rows=2)),
        (THREE, "axial_clearance", 2.0),
    ],
)
def test_impossible_roller_bearings_are_refused(bearing, field, value):
    with pytest.raises(InputError, match=field):
        dataclasses.replace(bearing, **{field: value})


def test_friction_of_crossed_rollers_follows_the_loads():
    result = CROSSED.equilibrium([(3e4, 4e4, -2e5), (0, 0, 0)], [(3e4, -4e4), (0, 0)])
    expected = 0.004 / 2 * (4.4 * 5e4 + (2.2 * 5e4 + 2e5) * CROSSED.pitch_diameter)
    assert result.friction_torque() == pytest.approx([expected, 0])
    assert result.friction_torque(idle=100.0) == pytest.approx([expected + 100, 100])
