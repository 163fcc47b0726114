"""Flexible rings: beams against closed forms, and the laws of the bearing that they carry."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.rolling import (
    CompliantRing,
    FlexibleRings,
    RingBeam,
    RingSection,
    RollerBearing,
    SlewingBearing,
    Support,
    axial_expansion,
    guyan,
    legs,
    patch_points,
)
from loadflow.rolling.rings import _ring_kernels, _ring_tangent
from loadflow.rolling.rings.condensation import ring_modes
from loadflow.rolling.rings.expansion import RingSections
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.scene.bearings import Rolling

STEEL = 210e9
DRIVE = SlewingBearing(
    balls=45, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4,
)  # fmt: skip
ROLLERS = RollerBearing(
    rollers=30, rows=2, roller_diameter=0.02, roller_length=0.03, pitch_diameter=0.25,
    row_spacing=0.06, contact_angle=0.5, clearance=-20e-6,
)  # fmt: skip
BLADE = SlewingBearing(
    balls=129, rows=2, ball_diameter=0.040, pitch_diameter=1.9, groove_radius=0.0205,
    contact_angle=math.pi / 4, row_spacing=0.06,
)  # fmt: skip


def flange(radius, height, size=1.0, **more):
    """A bolted flange with springs of `size` N/mm per mm and mm."""
    stiff = {"radial": 1e9, "tangential": 1e9, "axial": 1e9, "tilt": 1e6}
    return Support(radius=radius, height=height, **{k: v * size for k, v in stiff.items()}, **more)


OUTER = RingBeam(
    section=RingSection.rectangle(0.028, 0.040), radius=0.146, harmonics=16,
    supports=(flange(0.15, -0.02),),
)  # fmt: skip
INNER = RingBeam(
    section=RingSection.rectangle(0.028, 0.040), radius=0.104, harmonics=16,
    supports=(flange(0.10, 0.02),),
)  # fmt: skip
BOTH = FlexibleRings(inner=INNER, outer=OUTER)
LOAD = np.array([4e3, -2e3, 9e3, 300.0, 450.0])


def compliance(ring, radius, height, azimuth):
    """Compliance (3 n, 3 n) at one circle of points."""
    points = PatchPoints(np.array([radius]), np.array([height]), np.asarray(azimuth, float))
    factor = ring.flexibility(points).reshape(3 * len(azimuth), -1)
    return factor @ factor.T


def test_pinched_thin_ring_opens_as_the_textbook_says():
    section, radius = RingSection.rectangle(0.002, 0.002), 0.5
    ring = RingBeam(section=section, radius=radius, harmonics=100)
    matrix = compliance(ring, radius, 0.0, [0, math.pi]).reshape(2, 3, 2, 3)
    opening = matrix[:, 0, :, 0].sum()
    thin = radius**3 / (STEEL * section.inertia_axial) * (math.pi / 4 - 2 / math.pi)
    assert opening == pytest.approx(thin, rel=1e-4)  # truncation at harmonic 100, h/R = 0.004


@pytest.mark.parametrize("n", [2, 3, 5])
def test_harmonic_axial_load_bends_and_twists_a_thin_ring(n):
    section, radius, count = RingSection.rectangle(0.004, 0.003), 0.8, 24
    ring = RingBeam(section=section, radius=radius, harmonics=8)
    phi = 2 * math.pi * np.arange(count) / count
    push = np.zeros((count, 3))
    push[:, 2] = np.cos(n * phi) * 2 * math.pi * radius / count  # 1 N/m
    moved = (compliance(ring, radius, 0.0, phi) @ push.ravel()).reshape(count, 3)[:, 2]
    bending = STEEL * section.inertia_radial
    twisting = STEEL / 2.6 * section.torsion
    expected = radius**4 / (n**2 - 1) ** 2 * (1 / bending + 1 / (n**2 * twisting))
    assert moved == pytest.approx(expected * np.cos(n * phi), abs=2e-4 * expected)


def test_uniform_load_widens_and_uniform_couple_twists():
    section, radius = RingSection.rectangle(0.02, 0.05), 0.5
    ring = RingBeam(section=section, radius=radius, harmonics=8)
    phi = 2 * math.pi * np.arange(32) / 32
    push = np.zeros((32, 3))
    push[:, 0] = 2 * math.pi * radius / 32
    level = (compliance(ring, radius, 0.0, phi) @ push.ravel()).reshape(32, 3)
    high = (compliance(ring, radius, 0.025, phi) @ push.ravel()).reshape(32, 3)
    widening = radius**2 / (STEEL * section.area)
    twist = 0.025 * radius**2 / (STEEL * section.inertia_radial)
    # thick-ring terms are of the order (width/radius)²/12
    assert level[:, 0] == pytest.approx(widening, rel=1e-3)
    assert high[:, 0] == pytest.approx(widening + 0.025 * twist, rel=1e-3)


def test_rectangle_has_the_torsion_constant_of_the_tables():
    for ratio, table in ((1, 0.1406), (2, 0.229), (10, 0.312)):
        assert RingSection.rectangle(1.0, ratio).torsion == pytest.approx(table * ratio, rel=2e-3)


def test_a_ring_that_may_fly_off_is_refused():
    free = dataclasses.replace(OUTER, supports=(Support(radius=0.15, radial=1e9),))
    with pytest.raises(SolverError, match="supports"):
        DRIVE.equilibrium(LOAD[:3], LOAD[3:], rings=FlexibleRings(outer=free))


def test_uniform_radial_compliance_is_the_ring_expansion_of_the_source():
    sections = RingSections(
        outer_outside=0.35, outer_inside=0.252, inner_outside=0.248, inner_inside=0.15,
        height=0.04,
    )  # fmt: skip
    parts = {}
    for name, outside, inside, loaded in (
        ("outer", 0.35, 0.252, 0.252), ("inner", 0.248, 0.15, 0.248),
    ):  # fmt: skip
        softness = loaded / (2 * math.pi * (outside - inside) * STEEL * 0.04)
        radial = np.tile([1.0, 0, 0], 90)
        parts[name] = CompliantRing(softness * np.outer(radial, radial))
    loads = np.array([1e4, 1e5, 3e5])
    for given_rings, name in ((parts, "both"), ({"outer": parts["outer"]}, "outer")):
        result = DRIVE.equilibrium(loads[:, None] * [0, 0, 1], rings=FlexibleRings(**given_rings))
        closed = axial_expansion(DRIVE, loads, sections, flexible=name)
        assert result.displacement[:, 2] == pytest.approx(closed.displacement, rel=1e-8)
        assert result.maximum_force == pytest.approx(closed.ball_force, rel=1e-8)


def test_stiff_rings_are_rigid():
    rigid = DRIVE.equilibrium(LOAD[:3], LOAD[3:])
    errors = []
    for factor in (1e2, 1e3, 1e4):
        rings = FlexibleRings(
            **{
                name: dataclasses.replace(
                    ring,
                    elastic_modulus=STEEL * factor,
                    supports=(flange(ring.supports[0].radius, 0.0, factor),),
                )
                for name, ring in (("inner", INNER), ("outer", OUTER))
            }
        )
        flexible = DRIVE.equilibrium(LOAD[:3], LOAD[3:], rings=rings)
        errors.append(np.abs(flexible.ball_forces - rigid.ball_forces).max() / rigid.maximum_force)
    assert errors[2] < 1e-4
    assert errors[0] / errors[1] == pytest.approx(10, rel=0.1)  # the first order in compliance
    assert errors[1] / errors[2] == pytest.approx(10, rel=0.1)


def test_ball_forces_balance_the_load_to_1e_8():
    # in space the pull also has a small part along the ring; in the plane of the ball it has none
    meridional = dataclasses.replace(DRIVE, distance="meridional")
    result = meridional.equilibrium(LOAD[:3], LOAD[3:], rings=BOTH)
    force, angle = result.ball_forces[0], result.contact_angles[0] * [[1], [-1]]
    radial, axial, phi = force * np.cos(angle), force * np.sin(angle), result.contacts.azimuth
    pull = np.array([(radial * np.cos(phi)).sum(), (radial * np.sin(phi)).sum(), axial.sum()])
    assert pull == pytest.approx(LOAD[:3], abs=1e-8 * 9e3)
    assert result.residual <= 1e-10


def test_stiffness_is_the_slope_of_the_load():
    base = DRIVE.equilibrium(LOAD[:3], LOAD[3:], rings=BOTH, tolerance=1e-13)
    scale = np.array([1, 1, 1, 0.125, 0.125])
    steps = np.diag(2.0 * scale)
    moved = [
        DRIVE.equilibrium((LOAD + sign * steps)[:, :3], (LOAD + sign * steps)[:, 3:], rings=BOTH,
                          tolerance=1e-13).displacement
        for sign in (1, -1)
    ]  # fmt: skip
    slope = ((moved[0] - moved[1]) / (4 * scale[:, None])).T
    identity = base.stiffness @ slope * scale / scale[:, None]
    assert identity == pytest.approx(np.eye(5), abs=1e-5)
    assert base.stiffness == pytest.approx(base.stiffness.T, rel=1e-9, abs=1e-3)


def test_flexible_rings_are_softer_and_both_softest():
    shift = {
        name: DRIVE.equilibrium((0, 0, 3e4), rings=rings).displacement[2]
        for name, rings in (
            ("rigid", "rigid"),
            ("inner", FlexibleRings(inner=INNER)),
            ("outer", FlexibleRings(outer=OUTER)),
            ("both", BOTH),
        )
    }
    assert shift["rigid"] < min(shift["inner"], shift["outer"])
    assert max(shift["inner"], shift["outer"]) < shift["both"]


def test_twist_makes_tension_differ_from_compression():
    up, down = DRIVE.equilibrium([(0, 0, 5e4), (0, 0, -5e4)], rings=BOTH).displacement[:, 2]
    assert abs(up + down) > 0.01 * up
    centred = FlexibleRings(
        **{
            name: dataclasses.replace(ring, supports=(flange(ring.supports[0].radius, 0.0),))
            for name, ring in (("inner", INNER), ("outer", OUTER))
        }
    )
    up, down = DRIVE.equilibrium([(0, 0, 5e4), (0, 0, -5e4)], rings=centred).displacement[:, 2]
    assert up == pytest.approx(-down, rel=1e-8)


def test_three_legs_give_way_more_than_four_and_a_flange_least():
    moved = []
    for sectors in (legs(3, 0.35), legs(4, 0.35), None):
        ring = dataclasses.replace(OUTER, supports=(flange(0.15, -0.02, sectors=sectors),))
        result = DRIVE.equilibrium((2e3, 0, 2e3), (0, 300.0), rings=FlexibleRings(outer=ring))
        moved.append(np.linalg.norm(result.ring_displacement("outer"), axis=-1).max())
    assert moved[0] > 1.3 * moved[1] > 1.3 * moved[2]


def test_turning_structure_and_load_together_turns_the_answer():
    ring = dataclasses.replace(OUTER, supports=(flange(0.15, -0.02, sectors=legs(3, 0.4)),))
    turn = 2 * math.pi / 45 * 4
    cos, sin = math.cos(turn), math.sin(turn)
    spin = np.array([[cos, -sin], [sin, cos]])
    fixed = DRIVE.equilibrium(LOAD[:3], LOAD[3:], rings=FlexibleRings(outer=ring))
    turned = DRIVE.equilibrium(
        np.append(spin @ LOAD[:2], LOAD[2]), spin @ LOAD[3:],
        rings=FlexibleRings(outer=ring, outer_angle=turn),
    )  # fmt: skip
    assert turned.ball_forces == pytest.approx(np.roll(fixed.ball_forces, 4, -1), abs=1e-5)
    other = DRIVE.equilibrium(
        LOAD[:3], LOAD[3:], rings=FlexibleRings(outer=ring), element_angle=0.07
    )
    assert np.abs(other.maximum_force / fixed.maximum_force - 1) > 1e-6


@pytest.mark.parametrize("axes", ["cylindrical", "cartesian"])
def test_a_given_matrix_is_the_ring_it_came_from_and_turns_by_ball_pitches(axes):
    ring = dataclasses.replace(OUTER, supports=(flange(0.15, -0.02, sectors=legs(3, 0.4)),))
    phi = DRIVE.contacts().azimuth
    factor = ring.flexibility(patch_points(DRIVE, "outer", phi))
    if axes == "cartesian":
        cos, sin = np.cos(phi)[:, None], np.sin(phi)[:, None]
        r, t = factor[:, :, 0], factor[:, :, 1]
        factor = np.stack([r * cos - t * sin, r * sin + t * cos, factor[:, :, 2]], axis=2)
    matrix = np.einsum("kbcm,KBCm->kbcKBC", factor, factor).reshape(270, 270)
    given_ring = CompliantRing(matrix, axes=axes)
    turn = 2 * math.pi / 45 * 7
    for model in (ring, given_ring):
        rings = FlexibleRings(outer=model, outer_angle=turn, modes=198)
        result = DRIVE.equilibrium(LOAD[:3], LOAD[3:], rings=rings)
        if model is ring:
            expected = result.ball_forces
    assert result.ball_forces == pytest.approx(expected, abs=1e-4)
    with pytest.raises(InputError, match="whole ball pitches"):
        DRIVE.equilibrium(LOAD[:3], rings=FlexibleRings(outer=given_ring), element_angle=0.01)


def test_a_ring_may_be_given_by_its_stiffness_if_that_holds_it():
    root = np.random.default_rng(1).normal(size=(12, 12))
    stiffness = 1e9 * (root @ root.T + 12 * np.eye(12))
    given_ring = CompliantRing.from_stiffness(stiffness, axes="cartesian")
    np.testing.assert_allclose(given_ring.compliance @ stiffness, np.eye(12), atol=1e-9)
    assert given_ring.axes == "cartesian"
    with pytest.raises(InputError, match="hold the ring by supports"):
        CompliantRing.from_stiffness(np.zeros((12, 12)))


def test_guyan_condensation_gives_the_compliance_at_the_masters():
    rng = np.random.default_rng(0)
    root = rng.normal(size=(12, 12))
    stiffness = root @ root.T
    masters = [7, 0, 3]
    condensed = guyan(stiffness, masters)
    assert np.linalg.inv(condensed) == pytest.approx(
        np.linalg.inv(stiffness)[np.ix_(masters, masters)], rel=1e-8
    )
    with pytest.raises(InputError, match="masters"):
        guyan(stiffness, [1, 1])


def test_rings_that_give_way_to_90_degrees_are_refused():
    free = RingBeam(section=RingSection.rectangle(0.099, 0.12), radius=1.001, harmonics=8)
    with pytest.raises(SolverError, match="90°"):
        BLADE.equilibrium((5e5, 0, 5e5), (0, -2e6), rings=FlexibleRings(outer=free))


@pytest.mark.parametrize(
    ("field", "value", "word"),
    [("modes", 0, "modes"), ("inner", 3, "inner"), ("outer_angle", math.nan, "outer_angle")],
)
def test_bad_fields_are_named(field, value, word):
    with pytest.raises(InputError, match=word):
        FlexibleRings(**{field: value})
    with pytest.raises(InputError, match="at least one ring"):
        DRIVE.equilibrium((0, 0, 1e3), rings=FlexibleRings())


def test_clearance_no_contact_and_zero_load_are_handled():
    loose = dataclasses.replace(DRIVE, clearance=40e-6)
    loads = [(0, 0, 0), (0, 0, 1e-3), (5.0, 0, 0), (0, 0, -2e4), (3e3, 0, 100.0)]
    result = loose.equilibrium(loads, rings=BOTH, strict=False, chunk=1)
    assert result.converged.all()
    assert result.ball_forces[0].max() == 0
    assert result.singular[0]
    assert result.ball_forces[3, 0, 0].max() == 0
    axial = (result.ball_forces[3] * np.sin(result.contact_angles[3])).sum()
    assert axial == pytest.approx(2e4, rel=1e-9)


def test_warm_and_cold_series_agree():
    t = np.linspace(0, 6, 40)
    force = np.stack([4e3 * np.cos(t), 2e3 * np.sin(2 * t), 9e3 * np.sin(t)], axis=1)
    moment = np.stack([300 * np.sin(3 * t), 200 * np.cos(t)], axis=1)
    warm = DRIVE.equilibrium(force, moment, rings=BOTH)
    cold = DRIVE.equilibrium(force, moment, rings=BOTH, chunk=1)
    assert warm.converged.all()
    assert warm.ball_forces == pytest.approx(cold.ball_forces, abs=1e-5)
    assert warm.maximum_force == pytest.approx(warm.ball_forces.max((-3, -2, -1)), rel=1e-12)
    assert warm.equivalent_load == pytest.approx(cold.equivalent_load, rel=1e-8)


def test_the_last_mode_kept_favours_no_direction():
    scene = Rolling(rings="flexible")  # more modes than are kept
    bearing, rings = scene.geometry, scene.ring_model
    turn = 2 * math.pi / bearing.balls
    angle = np.array([0.3, 0.3 + turn])
    tilt = 8e5 * np.stack([-np.sin(angle), np.cos(angle)], axis=1)
    push = np.stack([4e5 * np.cos(angle), 4e5 * np.sin(angle), [3e5, 3e5]], axis=1)
    first, second = bearing.equilibrium(push, tilt, rings=rings, chunk=1).ball_forces
    assert second == pytest.approx(np.roll(first, 1, axis=-1), abs=1e-7 * first.max())


@pytest.mark.parametrize("sectors", [None, legs(3, 0.4)])
def test_waves_around_the_ring_shift_the_contacts_as_the_basis_does(sectors):
    ring = dataclasses.replace(OUTER, supports=(flange(0.15, -0.02, sectors=sectors),))
    modes = ring_modes(DRIVE.ring_coupling(0.03), FlexibleRings(inner=INNER, outer=ring))
    waves = modes.waves
    tracks = np.zeros((modes.size, waves.mixing.shape[1], DRIVE.balls))
    sign = np.where(np.arange(len(waves.trig)) < waves.cosines, 1.0, -1.0)[:, None]
    half = waves.trig[:, : DRIVE.balls // 2 + 1]
    mirrored = sign * half[:, DRIVE.balls - half.shape[1] : 0 : -1]
    trig = np.concatenate([half, mirrored], axis=1)
    for owner, (first, last) in enumerate(zip(waves.first, waves.first[1:])):
        for wave, track, value in zip(
            waves.wave[first:last], waves.track[first:last], waves.value[first:last]
        ):
            tracks[owner, track] += value * trig[wave]
    shift = np.einsum("sf,afj->asj", waves.mixing, tracks)
    expected = modes.basis.reshape(3, -1, DRIVE.balls, modes.size).transpose(3, 1, 0, 2)
    error = np.abs(shift.reshape(expected.shape) - expected).max(axis=(1, 2, 3))
    assert (error < 1e-9 * np.abs(expected).max(axis=(1, 2, 3))).all()
    if sectors is None:
        assert len(waves.value) < 10 * modes.size  # few waves stand for all contacts
        assert waves.mixing.shape[1] < len(waves.mixing)  # rigid sections: fewer tracks than fields


@pytest.mark.parametrize("kind", ["all round", "legs", "rollers"])
def test_the_tangent_is_the_slope_of_the_forces_by_waves_and_by_balls(kind):
    sectors = legs(3, 0.4) if kind == "legs" else None
    ring = dataclasses.replace(OUTER, supports=(flange(0.15, -0.02, sectors=sectors),))
    bearing = ROLLERS if kind == "rollers" else DRIVE
    found = bearing.equilibrium(LOAD[:3], LOAD[3:], rings=FlexibleRings(inner=INNER, outer=ring))
    modes, (x,) = found.elements.modes, found.elements._unknowns
    if kind != "rollers":  # both ways are taken; for these rollers they cost nearly the same
        assert (modes.waves.shapes.size == 0) == (kind == "all round")

    def contacts(x):
        return _ring_kernels.evaluate(x, modes.waves, modes.law)

    slope = _ring_tangent.tangent(modes.waves, modes.law.power, *contacts(x)[1:5])
    steps = np.diag(1e-9 * modes.reach)  # shifts by a nanometre
    expected = [(contacts(x + d)[5] - contacts(x - d)[5]) / (2 * d.sum()) for d in steps]
    weight = np.sqrt(np.outer(np.diag(slope), np.diag(slope)))
    assert np.abs((slope - np.transpose(expected)) / weight).max() < 1e-5


def test_a_chunk_does_not_depend_on_the_chunks_before_it():
    t = np.linspace(0, 6, 24)
    force = np.stack([4e3 * np.cos(t), 2e3 * np.sin(2 * t), 9e3 * np.sin(t)], axis=1)
    whole = DRIVE.equilibrium(force, rings=BOTH, chunk=8)
    last = DRIVE.equilibrium(force[16:], rings=BOTH, chunk=8)
    np.testing.assert_array_equal(whole.displacement[16:], last.displacement)
    np.testing.assert_array_equal(whole.stiffness[16:], last.stiffness)


@pytest.mark.parametrize("fit", ["flange", "legs"])
def test_kept_modes_hold_what_all_modes_hold(fit):
    stiff = {"radial": 2e9, "tangential": 2e9, "axial": 4e9, "tilt": 1e7}
    outer = RingBeam(
        section=RingSection.rectangle(0.099, 0.12), radius=1.001,
        supports=(Support(radius=1.0, height=-0.06, **stiff,
                          sectors=legs(4, 0.6) if fit == "legs" else None),),
    )  # fmt: skip
    force = [(0, 0, 1e6), (2e5, 0, 2e5), (0, 0, 0)]
    moment = [(0, 0), (0, -8e5), (5e5, 0)]
    few, all_modes = (
        BLADE.equilibrium(force, moment, rings=FlexibleRings(outer=outer, modes=m))
        for m in (None, 390)
    )
    assert few.displacement[:, 2:] == pytest.approx(
        all_modes.displacement[:, 2:], rel=5e-3, abs=1e-7
    )
    assert few.maximum_force == pytest.approx(all_modes.maximum_force, rel=0.02)


@settings(max_examples=10, deadline=None)
@given(st.floats(0, 2 * math.pi), st.floats(-1, 1), st.floats(-1, 1))
def test_turning_the_load_by_a_ball_pitch_turns_the_answer(direction, axial, tilt):
    angle = np.array([direction, direction + 2 * math.pi / 45])
    force = np.stack([5e3 * np.cos(angle), 5e3 * np.sin(angle), np.full(2, 2e4 * axial)], axis=1)
    moment = 5e2 * tilt * np.stack([-np.sin(angle), np.cos(angle)], axis=1)
    first, second = DRIVE.equilibrium(force, moment, rings=BOTH, chunk=1).ball_forces
    assert second == pytest.approx(np.roll(first, 1, axis=-1), abs=2e-5)
