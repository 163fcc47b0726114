"""Finite-element rings against beams, against solid rings, and the solver against its reference."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import (
    FiniteElementRing,
    FlexibleRings,
    RingBeam,
    RingProfile,
    RingSection,
    SlewingBearing,
    SolidRing,
    Support,
    patch_points,
    reference_equilibrium,
)

pytest.importorskip("skfem")

BEARING = SlewingBearing(
    balls=12, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4,
)  # fmt: skip
PROFILE = RingProfile(
    bearing=BEARING, ring="outer", inside=0.256, outside=0.32, bottom=-0.02, top=0.02
)
BED = 1e11  # N/m³, soft enough that beams hold
POINTS = patch_points(BEARING, "outer", BEARING.contacts().azimuth)


def uniform(ring):
    """Motion (r, θ, z) of the patches per unit radial force on each, (kind, 3)."""
    factor = ring.flexibility(POINTS)
    return np.einsum("kbcm,kBm->kc", factor, factor[:, :, 0]) / BEARING.balls


def beam(held):
    width, height = 0.032, 0.02 if held == "top" else -0.02
    bed = {"radial": BED * width, "tangential": BED * width, "axial": BED * width,
           "tilt": BED * width**3 / 12}  # fmt: skip
    return RingBeam(
        section=RingSection.rectangle(0.030, 0.040), radius=0.145,
        supports=(Support(radius=0.144, height=height, **bed),),
    )  # fmt: skip


@pytest.mark.parametrize("held", ["bottom", "top"])
def test_harmonic_zero_of_the_section_is_that_of_the_beam(held):
    ring = FiniteElementRing(profile=PROFILE, held=held, bed=BED, grip=BED, harmonics=1)
    ours, thin = uniform(ring), uniform(dataclasses.replace(beam(held), harmonics=1))
    # a beam's section is rigid; the real one yields where it is pushed, and lacks the groove
    assert (ours[:, 0] > thin[:, 0]).all()
    assert ours[:, 0] == pytest.approx(thin[:, 0], rel=0.2)


def test_solid_ring_is_the_section_in_harmonics():
    common = {"profile": PROFILE, "held": "bottom", "across": 1}
    solid = uniform(SolidRing(around=12, **common))[:, 0]
    # 12 line loads: more harmonics resolve them better than the elements of 65 mm, fewer worse
    coarse, fine = (uniform(FiniteElementRing(harmonics=n, **common))[:, 0] for n in (12, 24))
    assert (coarse < solid).all()
    assert (solid < fine).all()


def test_clamped_face_is_the_limit_of_a_stiff_bed():
    stiff, stiffer = (
        uniform(FiniteElementRing(profile=PROFILE, held="bottom", bed=b, grip=b, harmonics=4))
        for b in (1e15, 1e16)
    )
    assert stiff[:, 0] == pytest.approx(stiffer[:, 0], rel=1e-2)


def test_a_face_that_slides_is_softer():
    clamped, sliding = (
        uniform(FiniteElementRing(profile=PROFILE, held="bottom", grip=g, harmonics=4))
        for g in (1e15, 1e9)
    )
    assert (sliding[:, 0] > 1.5 * clamped[:, 0]).all()


def test_condensed_solver_agrees_with_all_modes_and_balls_as_unknowns():
    rings = FlexibleRings(outer=beam("bottom"))
    for load, tolerance in (
        ((0, 0, 2e4, 0, 0), 2e-3),  # unequal raceways in series, instead of one by one
        # some balls carry on both diagonals, which their centre couples once α leaves 45°
        ((500, 0, 5e3, 100, 0), 0.03),
        ((2e3, 0, 0, 0, 0), 0.06),  # all loaded balls do
    ):
        full = reference_equilibrium(BEARING, rings, load[:3], load[3:])
        ours = BEARING.equilibrium(load[:3], load[3:], rings=rings)
        assert ours.maximum_force == pytest.approx(full.forces.max(), rel=tolerance)
        scale = ours.contacts.scale
        moved = np.linalg.norm(ours.displacement / scale)
        assert moved == pytest.approx(np.linalg.norm(full.displacement / scale), rel=tolerance)


def test_reference_without_flexible_rings_is_the_rigid_bearing():
    full = reference_equilibrium(BEARING, FlexibleRings(), (0, 0, 2e4))
    rigid = BEARING.equilibrium((0, 0, 2e4))
    assert full.displacement[2] == pytest.approx(rigid.displacement[2], rel=1e-6)
    assert full.forces.max() == pytest.approx(rigid.maximum_force, rel=1e-6)


@pytest.mark.parametrize(
    ("change", "word"),
    [({"inside": 0.2}, "inside"), ({"top": 0.004}, "bottom, top"), ({"outside": 0.2}, "outside")],
)
def test_profiles_that_cannot_be_are_refused(change, word):
    with pytest.raises(InputError, match=word):
        dataclasses.replace(PROFILE, **change)


def test_balls_off_the_planes_of_the_mesh_are_refused():
    ring = SolidRing(profile=PROFILE, held="bottom", across=1, around=13)
    with pytest.raises(InputError, match="around"):
        ring.flexibility(POINTS)
