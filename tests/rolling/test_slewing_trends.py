"""What must hold of a four-point bearing under any load, and a plain solution to compare with."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from scipy.optimize import least_squares

from loadflow.rolling import FlexibleRings, RingBeam, RingSection, SlewingBearing, Support, legs

DRIVE = SlewingBearing(
    balls=45, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4,
)  # fmt: skip
BLADE = SlewingBearing(
    balls=129, rows=2, ball_diameter=0.040, pitch_diameter=1.9, groove_radius=0.0205,
    contact_angle=math.pi / 4, row_spacing=0.06,
)  # fmt: skip
DIRECTION = st.floats(0, 2 * math.pi)
THRUST = st.floats(2e3, 1e5)


def beam(radius, foot, height, sectors=None):
    """A ring of 30 by 40 mm on springs at one of its faces."""
    stiff = {"radial": 3e9, "tangential": 3e9, "axial": 3e9, "tilt": 3e5}
    return RingBeam(
        section=RingSection.rectangle(0.030, 0.040), radius=radius, harmonics=16,
        supports=(Support(radius=foot, height=height, sectors=sectors, **stiff),),
    )  # fmt: skip


OUTER, INNER = beam(0.145, 0.144, -0.02), beam(0.105, 0.106, 0.02)
BOTH = FlexibleRings(inner=INNER, outer=OUTER)


def with_rings(force, moment=(0, 0)):
    """The drive bearing's answer with rigid rings, one flexible ring, and both."""
    kinds = {
        "rigid": "rigid",
        "inner": FlexibleRings(inner=INNER),
        "outer": FlexibleRings(outer=OUTER),
        "both": BOTH,
    }
    return {name: DRIVE.equilibrium(force, moment, rings=rings) for name, rings in kinds.items()}


def plain_solution(bearing, force, moment):
    """Ball forces and displacement by scipy from vectors in space; shares no formula with ours."""
    radius = bearing.ball_diameter / 2
    inner = bearing.groove_radius - radius
    outer = (bearing.outer_groove_radius or bearing.groove_radius) - radius
    cos, sin = math.cos(bearing.contact_angle), math.sin(bearing.contact_angle)
    angle = 2 * np.pi / bearing.balls * np.arange(bearing.balls)
    around = np.stack([np.cos(angle), np.sin(angle), 0 * angle], axis=-1)
    along = np.stack([-np.sin(angle), np.cos(angle), 0 * angle], axis=-1)
    up = np.array([0, 0, 1.0])
    starts, vectors = [], []
    for height in (np.arange(bearing.rows) - (bearing.rows - 1) / 2) * bearing.row_spacing:
        for sign in (1, -1):
            half = bearing.pitch_diameter / 2
            starts.append(around * (half + inner * cos) + up * (height + sign * inner * sin))
            fixed = around * (half - outer * cos) + up * (height - sign * outer * sin)
            vectors.append(starts[-1] - fixed - up * sign * bearing.clearance / 2)
    starts, vectors = np.array(starts), np.array(vectors)
    scale = np.r_[1, 1, 1, 2 / bearing.pitch_diameter, 2 / bearing.pitch_diameter]
    load = np.r_[force, moment] * scale

    def pull(state):
        u = state * scale * 1e-5
        moved = vectors + u[:3] + np.cross([u[3], u[4], 0], starts)
        if bearing.distance == "meridional":
            moved = moved - (moved * along).sum(-1, keepdims=True) * along
        length = np.linalg.norm(moved, axis=-1)
        size = bearing.series_stiffness * np.maximum(length - inner - outer, 0) ** 1.5
        return size, moved * (size / length)[..., None]

    def residual(state):
        forces = pull(state)[1]
        turning = np.cross(starts, forces).sum((0, 1))[:2]
        return (np.r_[forces.sum((0, 1)), turning] * scale - load) / np.abs(load).max()

    for stretch in (1, 4, 16, 64):
        found = least_squares(
            residual, load / np.abs(load).max() * stretch, jac="3-point", xtol=1e-15, ftol=1e-15,
            gtol=1e-15,
        )  # fmt: skip
        if found.cost < 1e-20:
            return pull(found.x)[0], found.x * scale * 1e-5
    raise AssertionError(f"the plain solution did not converge: {found.cost}")


@settings(max_examples=25, deadline=None)
@given(
    balls=st.integers(4, 60),
    rows=st.integers(1, 3),
    gap=st.floats(-0.01, 0.01),
    angle=st.floats(0.6, 1.0),
    other_groove=st.booleans(),
    distance=st.sampled_from(["spatial", "meridional"]),
    load=st.tuples(*[st.floats(-1, 1)] * 5),
)
def test_any_bearing_and_load_agree_with_a_plain_solution(
    balls, rows, gap, angle, other_groove, distance, load
):
    assume(max(map(abs, load)) > 0.01)
    ball, pitch = 0.02, 0.02 * max(balls / 2.9, 3)
    bearing = SlewingBearing(
        balls=balls, rows=rows, row_spacing=0.03 * (rows > 1), ball_diameter=ball,
        pitch_diameter=pitch, groove_radius=0.0105, contact_angle=angle, clearance=gap * 1e-3,
        outer_groove_radius=0.0107 if other_groove else None, distance=distance,
    )  # fmt: skip
    size = 4000.0 * balls * rows
    force, moment = size * np.array(load[:3]), size * pitch / 4 * np.array(load[3:])
    ours = bearing.equilibrium(force, moment)
    forces, shift = plain_solution(bearing, force, moment)
    largest = forces.max()
    assert ours.ball_forces.reshape(forces.shape) == pytest.approx(forces, abs=1e-6 * largest)
    arms = np.array([1, 1, 1, pitch / 2, pitch / 2])
    assert ours.displacement * arms == pytest.approx(shift * arms, abs=1e-6 * abs(shift).max())


@settings(max_examples=20, deadline=None)
@given(DIRECTION, st.floats(1e5, 5e5), st.floats(1e-6, 9e-5))
def test_the_loaded_zone_never_grows_with_clearance(direction, radial, step):
    force = (radial * math.cos(direction), radial * math.sin(direction), 0)
    results = [
        dataclasses.replace(BLADE, clearance=gap).equilibrium(force)
        for gap in (-1e-4, -step, 0.0, step, 1e-4)
    ]
    counts = [int((result.ball_forces > 0).sum()) for result in results]
    assert counts == sorted(counts, reverse=True)
    # with 0.1 mm of preload every contact is closed, and the preload itself is most of its force
    assert counts[0] == 4 * 129
    idle = dataclasses.replace(BLADE, clearance=-1e-4).equilibrium((0, 0, 0)).maximum_force
    assert idle > 0.5 * results[0].maximum_force


@settings(max_examples=20, deadline=None)
@given(st.floats(0.01, 2), st.floats(0.8, 1.25), st.floats(0.8, 1.25), DIRECTION)
def test_loads_one_by_one_add_up_to_more_than_together(size, share, other, direction):
    # not a law: a radial load beside a small moment and hardly any thrust does the opposite, by 9 %
    axial, radial, tilt = 500e3 * size * share, 500e3 * size * other, 2e6 * size
    cos, sin = math.cos(direction), math.sin(direction)
    force = np.array([(0, 0, axial), (radial * cos, radial * sin, 0), (0, 0, 0)])
    moment = np.array([(0, 0), (0, 0), (tilt * sin, -tilt * cos)])  # the same balls as +F_a
    single = BLADE.equilibrium(force, moment).maximum_force
    together = BLADE.equilibrium(force.sum(0), moment.sum(0)).maximum_force
    assert together < single.sum()


@settings(max_examples=20, deadline=None)
@given(st.floats(1e3, 1e6), DIRECTION)
def test_a_moment_loads_opposite_halves_and_spares_the_balls_on_its_axis(tilt, direction):
    bearing = dataclasses.replace(BLADE, row_spacing=0.0)
    moment = tilt * np.array([math.cos(direction), math.sin(direction)])
    result = bearing.equilibrium((0, 0, 0), moment)
    forces, angle = result.ball_forces[0], result.contacts.azimuth
    count = (forces > 0).sum(axis=-1)
    assert set(count.tolist()) <= {64, 65}
    side = np.sin(angle - direction)  # > 0 where the moment lifts the inner ring
    assert (side[forces[0] > 0] > -0.03).all()
    assert (side[forces[1] > 0] < 0.03).all()
    # the approach falls with the distance from the axis, the force with its power 3/2
    share = forces.sum(axis=0) / forces.max()
    assert (share <= 1.1 * np.abs(side) ** 1.5 + 0.01).all()


@settings(max_examples=20, deadline=None)
@given(st.floats(1e2, 3e5), DIRECTION)
def test_radial_load_alone_makes_four_point_contact_on_one_half(radial, direction):
    result = BLADE.equilibrium((radial * math.cos(direction), radial * math.sin(direction), 0))
    lower, upper = result.ball_forces.sum(axis=0)
    assert lower == pytest.approx(upper, abs=1e-6 * lower.max())
    single = dataclasses.replace(BLADE, rows=1, row_spacing=0.0).equilibrium(
        (radial * math.cos(direction), radial * math.sin(direction), 0)
    )
    loaded = single.ball_forces[0] > 0
    assert (loaded[0] == loaded[1]).all()
    # more than half: the inner ring also shifts along the outer, which closes a few contacts more
    assert 64 <= loaded[0].sum() <= 70
    assert (np.cos(single.contacts.azimuth[loaded[0]] - direction) > -0.16).all()


@settings(max_examples=20, deadline=None)
@given(st.floats(1e2, 1e5), st.floats(1.01, 3), DIRECTION, st.integers(7, 45))
def test_radial_stiffness_rises_with_load(radial, factor, direction, balls):
    bearing = dataclasses.replace(DRIVE, balls=balls)
    along = np.array([math.cos(direction), math.sin(direction)])
    force = np.array([radial, factor * radial])[:, None] * np.append(along, 0.0)
    stiffness = bearing.equilibrium(force).stiffness[:, :2, :2]
    soft, stiff = along @ stiffness @ along
    assert stiff > soft


@settings(max_examples=10, deadline=None)
@given(THRUST, st.sampled_from([1, -1]), st.floats(0, 0.06), DIRECTION)
def test_flexible_rings_never_give_way_less_than_rigid_ones(thrust, sign, lever, direction):
    force = (0, 0, sign * thrust)
    moment = lever * thrust * np.array([math.cos(direction), math.sin(direction)])
    load, found = np.r_[force, moment], with_rings(force, moment)
    work = {name: float(load @ result.displacement) for name, result in found.items()}
    for result in found.values():
        carried = result.secant_stiffness @ result.displacement
        assert carried == pytest.approx(load, abs=1e-6 * thrust)
    assert work["rigid"] < min(work["inner"], work["outer"])
    assert max(work["inner"], work["outer"]) < work["both"]


@settings(max_examples=10, deadline=None)
@given(THRUST)
def test_similar_rings_give_way_alike_and_straighten_the_characteristic(thrust):
    loads = np.array([1.0, 1.05])[:, None] * thrust * [0, 0, 1]
    shift = {name: result.displacement[:, 2] for name, result in with_rings(loads).items()}
    assert shift["inner"] == pytest.approx(shift["outer"], rel=0.25)
    exponent = {name: np.log(u[1] / u[0]) / math.log(1.05) for name, u in shift.items()}
    assert exponent["rigid"] < min(exponent["inner"], exponent["outer"])
    assert max(exponent["inner"], exponent["outer"]) < exponent["both"] < 1


@settings(max_examples=10, deadline=None)
@given(THRUST)
def test_rings_on_one_face_give_way_more_in_tension(thrust):
    up, down = DRIVE.equilibrium([(0, 0, thrust), (0, 0, -thrust)], rings=BOTH).displacement[:, 2]
    assert up > -1.01 * down
    mirrored = FlexibleRings(
        inner=beam(0.105, 0.106, -0.02), outer=beam(0.145, 0.144, 0.02)
    )  # the other faces
    other = DRIVE.equilibrium((0, 0, -thrust), rings=mirrored).displacement[2]
    assert other == pytest.approx(-up, rel=1e-8)


@settings(max_examples=10, deadline=None)
@given(st.floats(0, 2e3), st.floats(-2e3, 2e3), st.floats(0, 300.0), DIRECTION)
def test_three_legs_deform_more_than_four(radial, axial, tilt, direction):
    assume(radial + abs(axial) + 8 * tilt > 500)
    cos, sin = math.cos(direction), math.sin(direction)
    moved = []
    for count in (3, 4):
        rings = FlexibleRings(outer=beam(0.145, 0.144, -0.02, sectors=legs(count, 0.35)))
        turned = [
            DRIVE.equilibrium(
                (radial * cos, radial * sin, axial), (-tilt * sin, tilt * cos),
                rings=dataclasses.replace(rings, outer_angle=2 * math.pi / count * part / 3),
            ).ring_displacement("outer")
            for part in range(3)
        ]  # fmt: skip
        moved.append(np.linalg.norm(turned, axis=-1).max())  # of the worst position of the legs
    assert moved[0] > moved[1]


@settings(max_examples=10, deadline=None)
@given(THRUST, st.floats(-0.04, 0.04))
def test_patches_that_turn_with_their_section_hardly_change_the_answer(thrust, lever):
    load = ((0, 0, thrust), (lever * thrust, 0))
    fixed, turning = (
        DRIVE.equilibrium(*load, rings=dataclasses.replace(BOTH, turning_patches=turns))
        for turns in (False, True)
    )
    assert turning.maximum_force == pytest.approx(fixed.maximum_force, rel=0.05)
    assert turning.displacement[2] == pytest.approx(fixed.displacement[2], rel=0.1)
