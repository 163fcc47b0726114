"""The four-point slewing bearing against the source, its reference values, and its laws."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.rolling import RollerBearing, SlewingBearing
from loadflow.rolling import friction as rolling_friction

BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=math.pi / 4,
)
# the reference values (an independent solver) hold for the printed mean stiffness factor
PRINTED = dataclasses.replace(BLADE, contact_stiffness=2.219e6 * 1e3**1.5)
DRIVE = SlewingBearing(
    balls=45,
    ball_diameter=0.015,
    pitch_diameter=0.250,
    groove_radius=0.0078,
    contact_angle=math.pi / 4,
)


def balanced(result):
    """Forces of all contacts summed up by hand, over the position of the inner groove centres."""
    bearing, table = result.bearing, result.contacts.table
    phi = result.contacts.azimuth
    radius, height = table[:, 0, None], table[:, 1, None]
    force = result.ball_forces.reshape(-1, bearing.balls)
    ux, uy, uz, tx, ty = result.displacement
    c, s = np.cos(phi), np.sin(phi)
    inner = np.stack(np.broadcast_arrays(radius * c, radius * s, height), axis=-1)
    start = np.stack(np.broadcast_arrays(table[:, 2, None] * c, table[:, 2, None] * s,
                                         table[:, 3, None]), axis=-1)  # fmt: skip
    vector = start + np.array([ux, uy, uz]) + np.cross(np.array([tx, ty, 0]), inner)
    pull = force[..., None] * vector / np.linalg.norm(vector, axis=-1, keepdims=True)
    return pull.sum((0, 1)), np.cross(inner, pull).sum((0, 1))[:2]


def test_axial_load_gives_the_printed_ball_force():
    result = BLADE.equilibrium(force=(0, 0, 2e6))
    assert result.ball_forces.shape == (2, 2, 129)
    assert result.ball_forces[:, 0] == pytest.approx(10_438, rel=5e-4)
    assert (result.ball_forces[:, 1] == 0).all()
    assert result.displacement[2] == pytest.approx(0.0771e-3, rel=1e-3)
    assert np.degrees(result.contact_angles[0, 0, 0]) == pytest.approx(47.96, abs=0.01)


@pytest.mark.parametrize(
    ("spacing", "force", "moment", "largest"),
    [
        (0.0, (0, 0, 2e6), (0, 0), 10_436.2),
        (0.0, (500e3, 0, 0), (0, 0), 5590),
        (0.0, (0, 0, 0), (500e3, 0), 6130),
        (0.05, (0, 0, 0), (500e3, 0), 6353),
        (0.06, (0, 0, 0), (500e3, 0), 6396),
        (0.07, (0, 0, 0), (500e3, 0), 6438),
        (0.06, (500e3, 0, 500e3), (0, -2e6), 30_623),
        (0.0, (500e3, 0, 500e3), (0, -2e6), 29_569),
    ],
)
def test_largest_ball_force_of_the_reference_solver(spacing, force, moment, largest):
    bearing = dataclasses.replace(PRINTED, row_spacing=spacing)
    result = bearing.equilibrium(force=force, moment=moment)
    assert result.maximum_force == pytest.approx(largest, rel=2e-4)


@pytest.mark.parametrize(
    ("sign", "sums"),
    [(-1, (2_245_029, 2_696_338, 4_978_880)), (1, (2_902_602, 3_663_845, 5_165_128))],
)
def test_force_sums_of_the_reference_solver(sign, sums):
    force = [(250e3, 0, 1e6), (500e3, 0, 2e6), (250e3, 0, 500e3)]
    moment = [(0, sign * 1e6), (0, sign * 500e3), (0, sign * 3e6)]
    result = PRINTED.equilibrium(force=force, moment=moment)
    assert result.force_sum == pytest.approx(sums, rel=2e-4)
    assert result.force_sum == pytest.approx(result.ball_forces.sum((-3, -2, -1)), rel=1e-12)


def test_axial_displacement_of_the_drive_bearing():
    loads = np.array([5e3, 10e3, 15e3, 20e3, 50e3, 100e3])
    bearing = dataclasses.replace(DRIVE, contact_stiffness=1.152e6 * 1e3**1.5)
    result = bearing.equilibrium(force=loads[:, None] * [0, 0, 1])
    reference = [0.00742, 0.01171, 0.01528, 0.01843, 0.03332, 0.05177]
    assert result.displacement[:, 2] * 1e3 == pytest.approx(reference, abs=6e-6)
    # flexible rings, as printed, are never stiffer
    printed = np.array([0.008, 0.014, 0.018, 0.023, 0.045, 0.073])
    assert (printed > result.displacement[:, 2] * 1e3 - 5e-4).all()


def test_four_ball_rigid_rings_are_stiffer_than_the_printed_flexible_ones():
    bearing = SlewingBearing(
        balls=4, ball_diameter=0.04, pitch_diameter=0.1, groove_radius=0.0205,
        contact_angle=math.pi / 4,
    )  # fmt: skip
    loads = np.array([10e3, 20e3, 30e3, 40e3, 50e3])
    shift = bearing.equilibrium(force=loads[:, None] * [0, 0, 1]).displacement[:, 2]
    assert (shift * 1e3 < [0.045, 0.075, 0.105, 0.128, 0.148]).all()


def test_forces_balance_the_load_to_1e_8_in_every_component():
    force, moment = np.array([3e5, -1e5, 2e5]), np.array([4e5, 7e5])
    wide = dataclasses.replace(BLADE, row_spacing=0.06, clearance=-20e-6)
    f, m = balanced(wide.equilibrium(force=force, moment=moment))
    assert f == pytest.approx(force, abs=1e-8 * 7e5)
    assert m == pytest.approx(moment, abs=1e-8 * 7e5)


@pytest.mark.parametrize("distance", ["spatial", "meridional"])
def test_stiffness_is_symmetric_and_the_slope_of_the_load(distance):
    bearing = dataclasses.replace(BLADE, row_spacing=0.06, distance=distance)
    load = np.array([2e5, 1e5, 3e5, 4e5, -6e5])
    base = bearing.equilibrium(force=load[:3], moment=load[3:], tolerance=1e-13)
    assert base.stiffness == pytest.approx(base.stiffness.T, rel=1e-12)
    steps = np.eye(5) * 1e-4 * 6e5
    plus, minus = (
        bearing.equilibrium(force=(load + s * steps)[:, :3], moment=(load + s * steps)[:, 3:],
                            tolerance=1e-13).displacement
        for s in (1, -1)
    )  # fmt: skip
    compliance = ((plus - minus) / (2e-4 * 6e5)).T
    assert base.stiffness @ compliance == pytest.approx(np.eye(5), abs=2e-6)


def test_plus_fz_moves_the_inner_ring_up_and_mirrors():
    up, down = BLADE.equilibrium(force=[(0, 0, 1e5), (0, 0, -1e5)]).displacement
    assert up[2] > 0
    assert down[2] == pytest.approx(-up[2], rel=1e-9)


@settings(max_examples=20, deadline=None)
@given(st.floats(0, 2 * math.pi), st.floats(-1, 1), st.floats(-1, 1), st.floats(-1, 1))
def test_turning_the_load_by_a_ball_pitch_turns_the_answer(direction, axial, tilt, cross):
    turn = 2 * math.pi / DRIVE.balls
    angle = np.array([direction, direction + turn])
    radial = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    across = np.stack([-np.sin(angle), np.cos(angle)], axis=1)
    force = np.concatenate([5e3 * radial, np.full((2, 1), 2e4 * axial)], axis=1)
    moment = 1e3 * tilt * across + 1e3 * cross * radial
    result = DRIVE.equilibrium(force=force, moment=moment, chunk=1)
    first, second = result.ball_forces
    assert np.roll(first, 1, axis=-1) == pytest.approx(second, abs=1e-6 * first.max())


@settings(max_examples=20, deadline=None)
@given(st.floats(1e-3, 1e4))
def test_scaling_all_lengths_scales_forces_by_their_square(scale):
    lengths = ("ball_diameter", "pitch_diameter", "groove_radius", "row_spacing", "clearance")
    base = dataclasses.replace(DRIVE, clearance=5e-6)
    big = dataclasses.replace(base, **{n: getattr(base, n) * 1.7 for n in lengths})
    one = base.equilibrium(force=(scale, 0, scale), moment=(0.03 * scale, 0))
    two = big.equilibrium(force=1.7**2 * np.array([scale, 0, scale]),
                          moment=1.7**3 * np.array([0.03 * scale, 0]))  # fmt: skip
    assert two.ball_forces == pytest.approx(1.7**2 * one.ball_forces, abs=1e-6 * 1.7**2 * scale)
    assert two.maximum_pressure == pytest.approx(one.maximum_pressure, rel=1e-6)


def test_order_of_the_cases_does_not_matter():
    rng = np.random.default_rng(3)
    force, moment = rng.normal(size=(200, 3)) * 2e5, rng.normal(size=(200, 2)) * 3e5
    order = rng.permutation(200)
    series = BLADE.equilibrium(force=force, moment=moment)
    mixed = BLADE.equilibrium(force=force[order], moment=moment[order])
    cold = BLADE.equilibrium(force=force, moment=moment, chunk=1)
    scale = series.maximum_force[:, None, None, None]
    assert np.abs(series.ball_forces[order] - mixed.ball_forces).max() < 1e-8 * scale.max()
    assert (np.abs(series.ball_forces - cold.ball_forces) < 1e-8 * scale).all()
    assert (series.residual < 1e-8).all()


def test_rigid_stiffness_exceeds_the_printed_flexible_one():
    thrust = PRINTED.equilibrium(force=(0, 0, 94e3))
    assert 94e3 / thrust.displacement[2] == pytest.approx(8873e6, rel=2e-3)
    assert thrust.stiffness[2, 2] == pytest.approx(13_423e6, rel=2e-3)
    tilt = PRINTED.equilibrium(force=(0, 0, 0), moment=(420.8e3, 0))
    per_degree = math.radians(1) / 1e3
    assert 420.8e3 / tilt.displacement[3] * per_degree == pytest.approx(142_600, rel=2e-3)
    assert tilt.stiffness[3, 3] * per_degree > 76_900


def test_secant_stiffness_leads_to_the_load_and_is_the_tangent_elsewhere():
    thrust = PRINTED.equilibrium(force=(0, 0, 94e3))
    assert thrust.secant_stiffness[2, 2] == pytest.approx(8873e6, rel=2e-3)
    others = [0, 1, 3, 4]
    assert thrust.secant_stiffness[others][:, others] == pytest.approx(
        thrust.stiffness[others][:, others], rel=1e-9, abs=1.0
    )
    tapered = RollerBearing(
        rollers=48, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8,
        contact_angle=0.35, rows=2, row_spacing=0.12, clearance=-20e-6,
    )  # fmt: skip
    load = np.array([[2e5, 1e5, 3e5, 2e4, -3e4], [0, 1e5, -1e4, 0, 1e4]])
    loose = dataclasses.replace(BLADE, row_spacing=0.06, clearance=50e-6)
    for bearing in (BLADE, loose, tapered):
        result = bearing.equilibrium(load[:, :3], load[:, 3:])
        secant = result.secant_stiffness
        assert secant == pytest.approx(np.swapaxes(secant, -1, -2), rel=1e-9, abs=1.0)
        carried = np.einsum("nab,nb->na", secant, result.displacement)
        assert carried == pytest.approx(load, abs=1e-6 * 3e5)
    rest = dataclasses.replace(BLADE, clearance=-1e-5).equilibrium((0, 0, 0))
    assert rest.secant_stiffness == pytest.approx(rest.stiffness, rel=1e-6, abs=1e3)


def test_switch_from_two_to_four_point_contact_of_the_drive_bearing():
    result = dataclasses.replace(DRIVE, contact_stiffness=1.152e6 * 1e3**1.5).equilibrium(
        force=(0, -6500, 8000), moment=(2000, 0), element_angle=math.pi / 2
    )
    # balls count from +y; the load is symmetric about it, so the sense of counting is free
    minor = result.ball_forces[0].min(axis=0)
    assert (np.flatnonzero(minor > 0) + 1).tolist() == list(range(15, 33))
    assert minor[14] == pytest.approx(49, abs=1)


def test_truncation_is_found_where_the_ellipse_passes_the_shoulder():
    forces = [(0, 0, 1e4), (0, 0, 2e6)]
    bearing = dataclasses.replace(BLADE, shoulder_angle=math.radians(60))
    assert bearing.equilibrium(force=forces).truncated.tolist() == [False, True]
    with pytest.raises(InputError, match="shoulder_angle"):
        _ = BLADE.equilibrium(force=forces).truncated


def test_meridional_distance_takes_more_force_under_radial_load():
    meridional = dataclasses.replace(BLADE, distance="meridional")
    ratio = (
        meridional.equilibrium(force=(5e5, 0, 0)).maximum_force
        / BLADE.equilibrium(force=(5e5, 0, 0)).maximum_force
    )
    assert 1.03 < ratio < 1.05


def test_safety_life_and_friction_follow_from_the_forces():
    result = BLADE.equilibrium(force=(0, 0, 2e6))
    force = result.maximum_force
    pressure = BLADE.raceway_contact("inner", force).pressure
    assert result.maximum_pressure == pytest.approx(pressure)
    assert result.pressure_safety == pytest.approx(4.2e9 / pressure)
    assert result.static_safety == pytest.approx((4.2e9 / pressure) ** 3)
    load = 258 * force * math.sin(math.pi / 4)
    assert result.equivalent_load == pytest.approx(load, rel=1e-9)
    assert result.rating_life == pytest.approx((BLADE.rated_capacity / load) ** 3, rel=1e-9)
    # alike balls: the life from the raceways is that of the bearing
    assert result.reference_life == pytest.approx(float(result.rating_life), rel=1e-5)
    expected = 0.005 * 0.7 * 258 * force * 0.95
    assert result.friction_torque() == pytest.approx(expected, rel=1e-9)
    assert result.friction_torque("loads", idle=10) == pytest.approx(10 + 0.003 * 0.95 * 2e6)
    assert result.friction_torque("equivalent") == pytest.approx(0.0024 * 0.95 * load)
    torque = result.friction_torque(idle=8000)
    factor = rolling_friction.friction_factor(torque, result.force_sum, 1.9, idle=8000)
    assert factor == pytest.approx(0.005)
    with pytest.raises(InputError, match="model"):
        result.friction_torque("palmgren")  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("field", "value", "words"),
    [
        ("groove_radius", 0.02, "groove_radius"),
        ("ball_diameter", -0.04, "ball_diameter"),
        ("pitch_diameter", 0.03, "pitch_diameter"),
        ("balls", 1, "balls"),
        ("balls", 200, "do not fit"),
        ("contact_angle", 0.0, "contact_angle"),
        ("contact_angle", 2.0, "contact_angle"),
        ("clearance", 0.1, "clearance"),
        ("elastic_modulus", float("nan"), "elastic_modulus"),
        ("distance", "other", "distance"),
    ],
)
def test_bad_geometry_is_refused_by_name(field, value, words):
    with pytest.raises(InputError, match=words):
        dataclasses.replace(BLADE, **{field: value})


@pytest.mark.parametrize(
    ("force", "moment", "words"),
    [
        ((0, 0), (0, 0), "force"),
        ((0, 0, 1), (0, 0, 0), "moment"),
        ((0, np.nan, 1), (0, 0), "finite"),
        (np.zeros((3, 3)), np.zeros((2, 2)), "broadcast"),
    ],
)
def test_bad_loads_are_refused_by_name(force, moment, words):
    with pytest.raises(InputError, match=words):
        BLADE.equilibrium(force=force, moment=moment)


def test_a_result_shows_what_it_has_where_no_table_rates_the_bearing():
    """Small balls on a large circle, as in yaw bearings: forces and stiffness, but no life."""
    wide = dataclasses.replace(BLADE, pitch_diameter=4.5)
    result = wide.equilibrium((1e5, 0, 1e6))
    with pytest.raises(InputError, match="state dynamic_capacity instead"):
        _ = result.rating_life
    assert "none: gamma" in repr(result)
    data = result.to_dataset()
    assert "rating_life" not in data
    assert "gamma" in data.attrs["no_rating_life"]
    assert float(data["static_safety"]) > 0
    stated = dataclasses.replace(wide, dynamic_capacity=2e6).equilibrium((1e5, 0, 1e6))
    assert float(stated.to_dataset()["rating_life"]) > 0
