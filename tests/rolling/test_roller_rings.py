"""Flexible rings of roller bearings: against rigid rings, closed forms and all modes at once."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from loadflow.errors import InputError, SolverError
from loadflow.rolling import (
    CompliantRing,
    FlexibleRings,
    FrictionOptions,
    RingBeam,
    RingSection,
    RollerBearing,
    SphericalRollerBearing,
    Support,
)
from loadflow.rolling._line_law import ninth_root
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.tribology import lubricant

ROLLERS = {"rollers": 24, "roller_diameter": 0.04, "roller_length": 0.05, "slices": 10}
TAPERED = RollerBearing(
    **ROLLERS, pitch_diameter=0.5, rows=2, row_spacing=0.09, contact_angle=0.35, clearance=-10e-6
)
CYLINDRICAL = RollerBearing(**ROLLERS, pitch_diameter=0.5)
SPHERICAL = SphericalRollerBearing(**ROLLERS, pitch_diameter=0.5, contact_angle=0.2)
KINDS = {"tapered": TAPERED, "cylindrical": CYLINDRICAL, "spherical": SPHERICAL}
LOADS = {
    "tapered": (2e5, -1e5, 6e4, 5e3, 9e3),
    "cylindrical": (2e5, -1e5, 0.0, 5e2, 9e2),
    "spherical": (2e5, -1e5, 3e4, 0.0, 0.0),
}


def beam(radius, side=0.06, size=1.0, walls=True, **more):
    """Ring of square section, `size` times as stiff as steel, on a wall or free."""
    wall = Support.wall(radius=radius, height=0.03, thickness=0.03, length=0.3)
    springs = {k: size * getattr(wall, k) for k in ("radial", "tangential", "axial", "tilt")}
    held = dataclasses.replace(wall, **springs)
    return RingBeam(
        section=RingSection.rectangle(side, 0.18), radius=radius, harmonics=12,
        elastic_modulus=size * 210e9, supports=(held,) if walls else (), **more,
    )  # fmt: skip


def rings(size=1.0, walls=True, **more):
    return FlexibleRings(
        inner=beam(0.19, size=size, walls=walls), outer=beam(0.31, size=size, walls=walls), **more
    )


def solved(kind, factor=1.0, **more):
    load = np.multiply.outer(np.atleast_1d(factor), np.array(LOADS[kind]))
    return KINDS[kind].equilibrium(load[..., :3], load[..., 3:], **more)


def test_ninth_root_holds_over_the_whole_range_of_doubles():
    delta = np.concatenate([np.logspace(-289.9, 308, 6001), [np.finfo(float).max]])
    found = np.array([ninth_root(d) for d in delta])
    exact = np.exp(np.log(delta.astype(np.longdouble)) / 9)
    assert float(np.abs(found / exact - 1).max()) < 3e-15
    assert [ninth_root(d) for d in (0.0, -1.0)] == [0.0, 0.0]
    tiny = np.array([ninth_root(d) for d in (1e-290, 1e-300, 5e-324)])
    assert (np.diff(tiny) < 0).all()
    assert (tiny > 0).all()
    assert ninth_root(np.inf) == np.inf
    assert np.isnan(ninth_root(np.nan))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("walls", [True, False])
def test_stiff_rings_are_rigid_ones(kind, walls):
    rigid, stiff = solved(kind), solved(kind, rings=rings(size=1e9, walls=walls))
    assert stiff.converged.all()
    assert stiff.slice_forces == pytest.approx(
        rigid.slice_forces, abs=1e-6 * rigid.slice_forces.max()
    )
    assert stiff.roller_forces == pytest.approx(
        rigid.roller_forces, abs=1e-6 * rigid.maximum_force.max()
    )
    for name in ("maximum_force", "maximum_pressure", "static_safety", "rating_life", "force_sum"):
        assert getattr(stiff, name) == pytest.approx(getattr(rigid, name), rel=1e-6), name
    scale = np.outer(rigid.contacts.scale, rigid.contacts.scale)
    assert stiff.stiffness * scale == pytest.approx(
        rigid.stiffness * scale, abs=1e-6 * np.abs(rigid.stiffness * scale).max()
    )


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("walls", [True, False])
def test_contact_forces_balance_the_load(kind, walls):
    found = solved(kind, [0.3, 1.0, 1.4], rings=rings(walls=walls))
    balance = np.einsum("nke,nkea->na", found.contact_forces, found.contact_directions)
    load = np.concatenate([found.force, found.moment], axis=1)
    lever = np.array([1, 1, 1, 4.0, 4.0])  # moments over half the pitch radius
    error = np.abs((balance - load) * lever).max(axis=1)
    assert (error < 1e-9 * np.abs(load).max(axis=1)).all()
    assert (found.residual < 1e-10).all()
    rigid = solved(kind, [0.3, 1.0, 1.4])
    assert not np.allclose(found.maximum_force, rigid.maximum_force, rtol=0.01)


def test_thrust_widens_a_thin_ring_as_the_closed_form_says():
    """A tapered row under thrust; the line of contact meets the outer ring's centroid."""
    bearing = dataclasses.replace(
        TAPERED, rows=1, row_spacing=0.0, clearance=0.0, profile="straight"
    )
    thrust, alpha, radius, side = 1e5, bearing.contact_angle, 0.275, 0.01
    section = RingSection.rectangle(side, side)
    height = (radius - 0.25) * math.tan(alpha)
    outer = RingBeam(section=section, radius=radius, height=height, harmonics=6)
    found = bearing.equilibrium((0, 0, thrust), rings=FlexibleRings(outer=outer))
    roller = thrust / (24 * math.sin(alpha))
    assert found.roller_forces == pytest.approx(roller, rel=1e-9)
    # q R²/(E A), q the radial force over the length of the centroid's circle
    widening = 24 * roller * math.cos(alpha) * radius / (2 * math.pi * 210e9 * section.area)
    approach = brentq(lambda d: 10 * bearing.slice_stiffness * d ** (10 / 9) - roller, 1e-9, 1e-3)
    expected = (approach + widening * math.cos(alpha)) / math.sin(alpha)
    assert widening * math.cos(alpha) > 20 * approach  # the ring, not the contact
    assert found.displacement[2] == pytest.approx(expected, rel=2e-4)  # (side/R)²/12
    moved = found.ring_displacement("outer")
    assert moved.shape == (1, 24, 3)
    assert moved[..., 0] == pytest.approx(widening, rel=2e-4)
    # away from that line the thrust twists the ring, and the force moves along the rollers
    twisted = bearing.equilibrium(
        (0, 0, 1e3), rings=FlexibleRings(outer=dataclasses.replace(outer, height=height + 0.01))
    )
    ends = twisted.slice_forces[0, :, 0]
    assert abs(ends[0] - ends[-1]) > 0.2 * ends.max()


def whole(bearing, flexible, load):
    """Slice forces and displacement under one load, every slice on the rings' whole compliance.

    Written on its own: δ = V u - C F at every slice, C from the rings at the slices' own places,
    F the contact law, ΣF V = load; Newton's method on (δ, u).
    """
    contacts = bearing.contacts()
    table, phi = contacts.table, contacts.azimuth
    kinds, count = len(table), len(phi)
    normal = np.zeros((kinds, count, 3))
    normal[..., 0], normal[..., 2] = table[:, 2, None], table[:, 3, None]
    compliance = np.zeros((kinds * count,) * 2)
    for ring in (flexible.inner, flexible.outer):
        factor = ring.flexibility(PatchPoints(table[:, 0], table[:, 1], phi))
        along = np.einsum("kec,kecm->kem", normal, factor).reshape(kinds * count, -1)
        compliance += along @ along.T
    lever = table[:, 1] * table[:, 2] - table[:, 0] * table[:, 3]
    ones = np.ones(count)
    v = np.stack(
        [
            np.outer(table[:, 2], np.cos(phi)), np.outer(table[:, 2], np.sin(phi)),
            np.outer(table[:, 3], ones), np.outer(-lever, np.sin(phi)),
            np.outer(lever, np.cos(phi)),
        ], axis=-1,
    ).reshape(-1, 5) * np.array([1, 1, 1, 4, 4])  # fmt: skip
    gap, stiff = np.repeat(table[:, 5], count), np.repeat(table[:, 6], count)
    goal = np.asarray(load) * np.array([1, 1, 1, 4, 4])
    rigid = bearing.equilibrium(load[:3], load[3:])
    u, force = rigid.displacement / np.array([1, 1, 1, 4, 4]), rigid.contact_forces.ravel()
    delta = v @ u - gap - compliance @ force
    for _ in range(60):  # δ + C F(δ) = V u - gap with F(δ < 0) = 0, and Vᵀ F = load
        law = stiff * np.maximum(delta, 0) ** (10 / 9)
        slope = 10 / 9 * stiff * np.maximum(delta, 1e-300) ** (1 / 9) * (delta > 0)
        miss = np.concatenate([delta + compliance @ law + gap - v @ u, v.T @ law - goal])
        if np.abs(miss[:-5]).max() < 1e-15 and np.abs(miss[-5:]).max() < 1e-8:
            return law.reshape(kinds, count), u * np.array([1, 1, 1, 4, 4])
        jacobian = np.block(
            [[np.eye(len(delta)) + compliance * slope, -v], [v.T * slope, np.zeros((5, 5))]]
        )
        step = np.linalg.solve(jacobian, -miss)
        delta, u = delta + step[:-5], u + step[-5:]
    raise AssertionError("no answer")


@pytest.mark.parametrize("walls", [True, False])
def test_all_slices_on_the_whole_compliance_give_the_same_forces(walls):
    bearing = dataclasses.replace(TAPERED, slices=4, clearance=-60e-6)
    load = 0.7 * np.array(LOADS["tapered"])
    force, moved = whole(bearing, rings(walls=walls), load)
    everything = bearing.equilibrium(load[:3], load[3:], rings=rings(walls=walls, modes=1000))
    assert everything.contact_forces == pytest.approx(force, abs=1e-6 * force.max())
    scale = np.array([1, 1, 1, 0.25, 0.25])
    assert everything.displacement * scale == pytest.approx(
        moved * scale, abs=1e-6 * np.abs(moved * scale).max()
    )
    some = bearing.equilibrium(load[:3], load[3:], rings=rings(walls=walls))
    assert some.contact_forces == pytest.approx(force, abs=2e-3 * force.max())


def test_kept_modes_hold_what_all_modes_hold():
    bearing = dataclasses.replace(TAPERED, rollers=48, roller_diameter=0.025)
    force, moment = np.array([1e5, -5e4, 3e4]), np.array([3e3, 5e3])

    def flexible(modes):
        ends = (dataclasses.replace(beam(radius), harmonics=24) for radius in (0.19, 0.31))
        return FlexibleRings(**dict(zip(("inner", "outer"), ends)), modes=modes)

    few, many = (bearing.equilibrium(force, moment, rings=flexible(n)) for n in (None, 1000))
    assert few.elements.modes.size < many.elements.modes.size - 20
    assert few.maximum_force == pytest.approx(many.maximum_force, rel=2e-3)
    assert few.rating_life == pytest.approx(many.rating_life, rel=2e-4)


def test_a_load_turned_by_a_pitch_turns_the_forces():
    turn = 2 * math.pi / 24
    x, y, z, mx, my = LOADS["tapered"]
    cos, sin = math.cos(turn), math.sin(turn)
    first = solved("tapered", rings=rings())
    other = TAPERED.equilibrium(
        (cos * x - sin * y, sin * x + cos * y, z), (cos * mx - sin * my, sin * mx + cos * my),
        rings=rings(),
    )  # fmt: skip
    assert other.slice_forces == pytest.approx(
        np.roll(first.slice_forces[0], 1, axis=-1), abs=1e-7 * first.slice_forces.max()
    )


def test_rows_share_a_radial_load_alike_and_mirror_it():
    found = TAPERED.equilibrium((2e5, 0, 0), rings=rings(walls=False)).slice_forces
    assert found[0] == pytest.approx(found[1, ::-1], abs=1e-6 * found.max())
    mirrored = found[..., -np.arange(24) % 24]  # azimuth φ to -φ
    assert mirrored == pytest.approx(found, abs=1e-6 * found.max())


def test_preload_of_free_rings_is_less_than_of_rigid_ones():
    bearing = dataclasses.replace(TAPERED, clearance=-50e-6)
    rigid, free = (bearing.equilibrium((0, 0, 0), rings=r) for r in ("rigid", rings(walls=False)))
    assert 0 < free.force_sum < 0.8 * rigid.force_sum
    assert free.roller_forces == pytest.approx(float(free.maximum_force), rel=1e-6)


@pytest.mark.parametrize("kind", KINDS)
def test_warm_and_cold_series_agree(kind):
    t = np.linspace(0, 3, 24)
    load = np.array(LOADS[kind]) * np.stack(
        [np.cos(t), np.sin(2 * t), np.sin(t), np.sin(3 * t), np.cos(t)], axis=1
    )
    warm, cold = (
        KINDS[kind].equilibrium(load[:, :3], load[:, 3:], rings=rings(), chunk=c) for c in (512, 1)
    )
    assert warm.converged.all()
    assert warm.slice_forces == pytest.approx(cold.slice_forces, abs=1e-7 * cold.slice_forces.max())
    alone = KINDS[kind].equilibrium(load[7, :3], load[7, 3:], rings=rings())
    assert alone.slice_forces == pytest.approx(
        warm.slice_forces[7], abs=1e-7 * warm.slice_forces[7].max()
    )


def test_results_of_flexible_rings_hold_together():
    found = solved("tapered", [0.5, 1.0], rings=rings())
    slices = found.slice_forces
    assert found.roller_forces == pytest.approx(slices.sum(axis=-2), rel=1e-12)
    assert found.maximum_force == pytest.approx(found.roller_forces.max(axis=(-1, -2)), rel=1e-12)
    assert found.force_sum == pytest.approx(slices.sum(axis=(-1, -2, -3)), rel=1e-12)
    fourth = found.elements.power_sums("inner")[..., 1]
    assert fourth == pytest.approx((found.contact_forces**4).sum(axis=-1), rel=1e-12)
    pressed = TAPERED.slice_contact("inner", slices.max(axis=(-1, -2, -3))).pressure
    assert found.maximum_pressure == pytest.approx(pressed, rel=1e-12)
    oil = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=333.15)
    assert (found.friction(1.0, oil).power > 0).all()
    assert found.to_dataset().element_forces.shape == (2, 2, 24)
    for ring in ("inner", "outer"):
        assert found.ring_displacement(ring).shape == (2, 2, 24, 3)


def test_stiffness_is_the_slope_of_the_load():
    load = np.array(LOADS["tapered"])
    found = solved("tapered", rings=rings(walls=False))
    step = 1e-4 * np.abs(load).max() * np.array([1, 1, 1, 0.2, 0.2])
    moved = [
        TAPERED.equilibrium(
            load[:3] + d[:3], load[3:] + d[3:], rings=rings(walls=False), tolerance=1e-12
        ).displacement
        for d in np.concatenate([np.diag(step), -np.diag(step)])
    ]
    slope = (np.array(moved[:5]) - np.array(moved[5:])) / (2 * step[:, None])
    scale = np.outer(found.contacts.scale, found.contacts.scale)
    compliance = np.linalg.inv(found.stiffness[0])
    assert slope / scale == pytest.approx(
        compliance / scale, abs=1e-5 * np.abs(compliance / scale).max()
    )


def test_a_given_compliance_stands_for_a_ring():
    ring = beam(0.31)
    points = TAPERED.ring_coupling().points("outer", FlexibleRings(outer=ring))
    factor = ring.flexibility(points).reshape(3 * 4 * 24, -1)  # two ends in each of two rows
    matrix = CompliantRing(factor @ factor.T)
    one, other = (
        solved("tapered", rings=FlexibleRings(outer=model, modes=400)) for model in (ring, matrix)
    )
    assert other.slice_forces == pytest.approx(one.slice_forces, abs=1e-6 * one.slice_forces.max())


def test_what_rollers_do_not_know_is_refused():
    with pytest.raises(InputError, match="master_width"):
        solved("tapered", rings=rings(master_width=3e-3))
    with pytest.raises(SolverError, match="no equilibrium"):
        CYLINDRICAL.equilibrium((1e5, 0, 1e4), rings=rings())
    with pytest.raises(InputError, match="takes none"):
        SPHERICAL.equilibrium((1e5, 0, 0), (1e3, 0), rings=rings())
