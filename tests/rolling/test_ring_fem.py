"""Finite-element rings against beams, against solid rings, and the solver against its reference."""

import dataclasses
import math

import numpy as np
import pytest

from benchmarks.references.whole_rings import reference_equilibrium
from loadflow.errors import InputError
from loadflow.rolling import (
    FiniteElementRing,
    FlexibleRings,
    MeshedRing,
    RingBeam,
    RingProfile,
    RingSection,
    RollerBearing,
    SlewingBearing,
    SolidRing,
    Support,
    patch_points,
)
from loadflow.rolling.rings.local_compliance import half_space
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON
from loadflow.validation._slewing_cases import FOUR_BALL
from loadflow.validation.rings import four_ball_rings

BEARING = SlewingBearing(
    balls=12, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4,
)  # fmt: skip
PROFILE = RingProfile(
    bearing=BEARING, ring="outer", inside=0.256, outside=0.32, bottom=-0.02, top=0.02
)
BED = 1e11  # N/m³, soft enough that beams hold
SIDE = 2 * PROFILE.patch_half
YIELD = half_space(SIDE, SIDE, STEEL_MODULUS, STEEL_POISSON)[0]  # of a half-space under a patch
POINTS = patch_points(BEARING, "outer", BEARING.contacts().azimuth)


def uniform(ring):
    """Motion (r, θ, z) of the patches per unit radial force on each, (kind, 3)."""
    factor = ring.flexibility(POINTS)
    return np.einsum("kbcm,kBm->kc", factor, factor[:, :, 0]) / BEARING.balls


def ring(held, **change):
    return FiniteElementRing(profile=PROFILE, held=held, **change)


def beam(held):
    width, height = 0.032, 0.02 if held == "top" else -0.02
    bed = {"radial": BED * width, "tangential": BED * width, "axial": BED * width,
           "tilt": BED * width**3 / 12}  # fmt: skip
    return RingBeam(
        section=RingSection.rectangle(0.030, 0.040), radius=0.145,
        supports=(Support(radius=0.144, height=height, **bed),),
    )  # fmt: skip


@pytest.mark.parametrize("held", ["bottom", "top"])
def test_uniform_load_on_a_soft_bed_moves_the_ring_as_it_does_a_beam(held):
    ours, thin = uniform(ring(held, bed=BED, grip=BED)), uniform(beam(held))
    # a beam has no groove, a rigid section, and yields nowhere less than a half-space would
    assert ours[:, 0] == pytest.approx(thin[:, 0], rel=0.2)


def test_profile_without_its_grooves_has_the_constants_of_a_rectangle():
    tiny = dataclasses.replace(BEARING, ball_diameter=0.0005, groove_radius=0.00026)
    profile = RingProfile(
        bearing=tiny, ring="outer", inside=0.2502, outside=0.3142, bottom=-0.02, top=0.02
    )
    section, radius, height = profile.section()
    plain = RingSection.rectangle(0.032, 0.040)
    for name in ("area", "inertia_axial", "inertia_radial"):
        assert getattr(section, name) == pytest.approx(getattr(plain, name), rel=2e-3)
    assert section.torsion == pytest.approx(plain.torsion, rel=0.03)
    assert (radius, height) == pytest.approx((0.1411, 0), rel=1e-3, abs=1e-9)


@pytest.mark.parametrize("held", ["bottom", "top", "back"])
def test_ring_as_beam_on_its_held_face(held):
    soft = ring(held, bed=1e9, grip=1e9)
    (support,) = soft.as_beam().supports
    width = 0.04 if held == "back" else 0.032
    springs = [support.radial, support.tangential, support.axial]
    # a bed that is soft beside the section keeps its springs, a hard one leaves the section's
    assert springs == pytest.approx([1e9 * width] * 3, rel=1e-3)
    (support,) = ring(held, bed=1e18, grip=1e18).as_beam().supports
    shear = 5 / 6 * STEEL_MODULUS / 2.6
    depth = {"bottom": 0.02, "top": 0.02, "back": 0.0155}[held]
    assert support.tangential == pytest.approx(shear * width / depth, rel=0.01)
    ours, thin = (
        BEARING.equilibrium((0, 0, 2e4), rings=FlexibleRings(outer=model)).displacement[2]
        for model in (ring(held), ring(held).as_beam())
    )
    assert thin == pytest.approx(ours, rel=0.1)


def test_compliance_depends_neither_on_harmonics_nor_on_elements():
    base = ring("bottom").flexibility(POINTS)
    diagonal = np.einsum("kbcm,kbcm->kbc", base, base)[:, 0]
    for change in ({"resolution": 16.0}, {"across": 8}):
        other = ring("bottom", **change).flexibility(POINTS)
        found = np.einsum("kbcm,kbcm->kbc", other, other)[:, 0]
        assert found == pytest.approx(diagonal, abs=0.02 * YIELD)


@pytest.mark.slow
def test_solid_ring_is_the_section_in_harmonics():
    thin = four_ball_rings().outer
    bearing = thin.profile.bearing
    points = patch_points(bearing, "outer", bearing.contacts().azimuth)
    solid = SolidRing(
        profile=thin.profile, held=thin.held, bed=thin.bed, grip=1e12, around=32, across=3
    )
    factors = [model.flexibility(points) for model in (solid, dataclasses.replace(thin, grip=1e12))]
    ours, harmonics = (np.einsum("kbcm,KBCm->kbcKBC", f, f).reshape(24, 24) for f in factors)
    side = 2 * thin.profile.patch_half
    # two elements across a patch and three in depth leave its own displacement 5 % short
    dent = half_space(side, side, STEEL_MODULUS, STEEL_POISSON)[0]
    assert ours == pytest.approx(harmonics, rel=0.07, abs=0.1 * dent)


@pytest.mark.parametrize("direction", [None, 0, 1])
def test_half_space_under_a_rectangle_is_the_mean_of_boussinesq_and_cerruti(direction):
    a, b, nu = 2.0, 0.5, 0.3
    edge = math.atan2(b, a)

    def ray(angle):
        """Integral over the distance r of two points apart in this direction."""
        cos, sin = math.cos(angle), math.sin(angle)
        end = a / cos if angle < edge else b / sin
        r = np.linspace(0, end, 2001)
        part = 0.0 if direction is None else nu * (cos, sin)[direction] ** 2
        return np.trapezoid((a - r * cos) * (b - r * sin), r) * (1 - nu + part)

    angles = np.linspace(0, math.pi / 2, 4001)
    mean = 4 * np.trapezoid([ray(v) for v in angles], angles) / (a * b) ** 2
    index = 0 if direction is None else direction + 1
    assert half_space(a, b, 1.0, nu)[index] == pytest.approx((1 + nu) / math.pi * mean, rel=1e-5)


def test_a_ring_stiffer_by_a_million_is_rigid_and_hertz_stays():
    stiff = ring("bottom", elastic_modulus=STEEL_MODULUS * 1e6, bed=1e21, grip=1e21)
    rigid = BEARING.equilibrium((500, 0, 5e3), (0, 100))
    ours = BEARING.equilibrium((500, 0, 5e3), (0, 100), rings=FlexibleRings(outer=stiff))
    assert ours.displacement == pytest.approx(rigid.displacement, rel=1e-5)
    assert ours.ball_forces == pytest.approx(rigid.ball_forces, rel=1e-5, abs=1e-2)


def test_tension_differs_from_compression_where_one_face_holds_the_ring():
    rings = FlexibleRings(outer=ring("bottom"))
    up, down = BEARING.equilibrium([(0, 0, 2e4), (0, 0, -2e4)], rings=rings).displacement[:, 2]
    # +Fz presses the outer ring's upper raceway, far from the face that holds it
    assert up > -1.01 * down


def test_master_nodes_of_coarse_elements_add_what_a_half_space_yields():
    rings = FlexibleRings(outer=ring("bottom"))
    once, twice = (
        BEARING.equilibrium((0, 0, 1e4), rings=dataclasses.replace(rings, master_width=w))
        for w in (None, 2e-3)
    )
    sine = math.sin(float(once.contact_angles[0, 0, 0]))
    yields = half_space(2e-3, 2e-3, STEEL_MODULUS, STEEL_POISSON)[0]
    added = yields * float(once.maximum_force) / sine
    assert twice.displacement[2] - once.displacement[2] == pytest.approx(added, rel=0.05)


def test_clamped_face_is_the_limit_of_a_stiff_bed():
    stiff, stiffer = (uniform(ring("bottom", bed=b, grip=b)) for b in (1e15, 1e16))
    # beside what a half-space would yield, which the ring's compliance lacks
    assert stiff[:, 0] == pytest.approx(stiffer[:, 0], abs=0.005 * YIELD)


def test_a_face_that_slides_is_softer():
    clamped, sliding = (uniform(ring("bottom", grip=g)) for g in (1e15, 1e9))
    assert (sliding[:, 0] > 1.5 * clamped[:, 0]).all()


@pytest.mark.parametrize("outer", ["beam", "finite elements"])
@pytest.mark.parametrize(
    "load",
    [
        (0, 0, 2e4, 0, 0),
        (500, 0, 5e3, 100, 0),  # some balls carry on both diagonals
        (2e3, 0, 0, 0, 0),  # all loaded balls do
        (1e3, 500, -3e3, 0, 200),
    ],
)
def test_condensed_solver_agrees_with_all_modes_and_balls_as_unknowns(load, outer):
    rings = FlexibleRings(outer=beam("bottom") if outer == "beam" else ring("bottom"))
    full = reference_equilibrium(BEARING, rings, load[:3], load[3:])
    ours = BEARING.equilibrium(load[:3], load[3:], rings=rings)
    scale = ours.contacts.scale
    moved, expected = (np.linalg.norm(u / scale) for u in (ours.displacement, full.displacement))
    assert moved == pytest.approx(expected, rel=1e-3)
    # the condensed solver takes the diagonals of a ball apart, and unequal raceways in series
    assert ours.maximum_force == pytest.approx(full.forces.max(), rel=5e-3)


@pytest.mark.parametrize("seed", range(6))
def test_every_ball_carries_what_it_does_without_condensation_under_any_load(seed):
    rng = np.random.default_rng(seed)
    load = rng.normal(size=5) * [1e3, 1e3, 6e3, 80, 80]
    bearing = dataclasses.replace(BEARING, clearance=(-1e-5, 0.0, 2e-5)[seed % 3])
    rings = FlexibleRings(outer=ring("bottom"))
    full = reference_equilibrium(bearing, rings, load[:3], load[3:])
    ours = bearing.equilibrium(load[:3], load[3:], rings=rings)
    assert ours.ball_forces[0] == pytest.approx(full.forces[0], abs=2e-3 * full.forces.max())


def test_rings_that_slide_on_their_faces_take_their_balls_along():
    bearing, rings = FOUR_BALL, four_ball_rings()
    for load in ((1e4, 0, 0, 0, 0), (5e3, 0, 2e4, 100, 0)):
        full = reference_equilibrium(bearing, rings, load[:3], load[3:])
        ours = bearing.equilibrium(load[:3], load[3:], rings=rings)
        assert ours.displacement[0] == pytest.approx(full.displacement[0], rel=1e-3)
        assert ours.maximum_force == pytest.approx(full.forces.max(), rel=5e-3)


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


COARSE = SlewingBearing(
    balls=24, ball_diameter=0.04, pitch_diameter=0.5, groove_radius=0.0208, contact_angle=0.785
)


def test_a_ring_too_thin_to_be_meshed_behind_its_grooves_is_refused_by_its_measures():
    measures = {"inside": 0.5016, "outside": 0.5388, "bottom": -0.06, "top": 0.026}
    ring = MeshedRing(held="bottom", across=2, resolution=1.5, **measures).of(COARSE, "outer")
    with pytest.raises(InputError, match=r"18\.6 mm thick is too thin .* from -60 to 26 mm"):
        COARSE.equilibrium((0, 0, 1e5), (1e4, 0), rings=FlexibleRings(outer=ring))


def test_a_mesh_too_coarse_to_give_way_is_refused_and_a_finer_one_answers():
    measures = {"inside": 0.5157, "outside": 0.7632, "bottom": -0.0194, "top": 0.0913}

    def force(across):
        mesh = MeshedRing(
            held="bottom", across=across, resolution=3.0, bed=9.6e12, grip=1.3e14, **measures
        )
        rings = FlexibleRings(outer=mesh.of(COARSE, "outer"))
        return COARSE.equilibrium((0, 0, 1e5), (1e4, 0), rings=rings).maximum_force

    with pytest.raises(InputError, match=r"outer: the ring gives way nowhere.*elements across"):
        force(1)
    rigid = COARSE.equilibrium((0, 0, 1e5), (1e4, 0)).maximum_force
    assert force(4) < rigid


def test_balls_unequally_spaced_are_refused():
    points = dataclasses.replace(POINTS, azimuth=POINTS.azimuth + 0.1 * (POINTS.azimuth > 3))
    with pytest.raises(InputError, match="equally spaced"):
        ring("bottom").flexibility(points)


def test_a_ring_with_grooves_for_balls_refuses_rollers():
    rollers = RollerBearing(
        rollers=12, roller_diameter=0.015, roller_length=0.02, pitch_diameter=0.25,
        contact_angle=0.3,
    )  # fmt: skip
    with pytest.raises(InputError, match="no raceway at radius"):
        rollers.equilibrium((1e3, 0, 1e3), rings=FlexibleRings(outer=ring("bottom")))
