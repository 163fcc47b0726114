"""Vibrating rings: closed-form frequencies, Craig–Bampton modes, and rest where statics says."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import (
    FiniteElementRing,
    FlexibleRings,
    Inertia,
    RingBeam,
    RingProfile,
    RingSection,
    SlewingBearing,
    Support,
    craig_bampton,
    natural_frequencies,
    patch_points,
    transient_response,
)

MODULUS, POISSON, DENSITY = 210e9, 0.3, 7850.0
BEARING = SlewingBearing(
    balls=12, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4,
)  # fmt: skip
OUTER = FiniteElementRing(
    profile=RingProfile(
        bearing=BEARING, ring="outer", inside=0.256, outside=0.32, bottom=-0.02, top=0.02
    ),
    held="bottom", bed=1e11, grip=1e11, across=2,
)  # fmt: skip
INNER = dataclasses.replace(
    OUTER,
    profile=RingProfile(
        bearing=BEARING, ring="inner", inside=0.18, outside=0.244, bottom=-0.02, top=0.02
    ),
    held="top",
)
POINTS = patch_points(BEARING, "outer", BEARING.contacts().azimuth)
BOTH = FlexibleRings(outer=OUTER, inner=INNER)
LOAD = ((3e3, -1e3, 9e3), (100.0, 150.0))


def slender():
    """Free ring of 12 × 12 mm at a mean radius of 0.257 m, with a groove of 1 % of its area."""
    bearing = SlewingBearing(
        balls=12, ball_diameter=0.002, pitch_diameter=0.501, groove_radius=0.00104,
        contact_angle=math.pi / 4,
    )  # fmt: skip
    profile = RingProfile(
        bearing=bearing, ring="outer", inside=0.502, outside=0.526, bottom=-0.006, top=0.006
    )
    return FiniteElementRing(profile=profile, held="bottom", bed=1.0, grip=1.0, across=3)


@pytest.mark.parametrize("n", [2, 3, 4, 5])
def test_ring_bends_in_and_out_of_its_plane_at_the_frequencies_of_a_thin_ring(n):
    side, radius = 0.012, 0.257
    bending = MODULUS * side**4 / 12
    torsion = MODULUS / (2 * (1 + POISSON)) * RingSection.rectangle(side, side).torsion
    unit = bending / (DENSITY * side**2 * radius**4) * n**2 * (n**2 - 1) ** 2
    in_plane, out_of_plane = (math.sqrt(unit / (n**2 + more)) for more in (1, bending / torsion))
    found = natural_frequencies(slender(), n, 2)
    # Hoppe's and Michell's rings have no shear and no rotary inertia: 1.3 % at five waves
    assert found == pytest.approx([out_of_plane, in_plane], rel=0.015)


def test_ring_breathes_and_is_free_as_a_whole():
    ring = slender()
    breathing = math.sqrt(MODULUS / DENSITY) / 0.257
    first, second, third = natural_frequencies(ring, 0, 3)
    assert max(first, second) < 1e-3 * third  # along the axis, and about it
    frequencies = natural_frequencies(ring, 0, 6)
    assert np.abs(frequencies / breathing - 1).min() < 0.01
    assert natural_frequencies(ring, 1, 3)[1] < 1e-3 * third  # sideways, and tilting


def test_held_patches_with_more_modes_bring_the_frequencies_of_the_whole_ring_from_above():
    exact = [np.repeat(natural_frequencies(OUTER, n, 4), 1 if n == 0 else 2) for n in range(7)]
    exact = np.sort(np.concatenate(exact))[:10]
    errors = np.array(
        [craig_bampton(OUTER, POINTS, k).frequencies[:10] / exact - 1 for k in (0, 8, 32, 64)]
    )
    assert errors.min() > -1e-6
    assert (np.diff(errors, axis=0) < 1e-9).all()
    assert errors.max(axis=1) == pytest.approx([0.093, 0.0093, 0.001, 6e-5], rel=0.2)


def test_modes_carry_the_mass_of_the_ring():
    r, z = OUTER.profile.grid(across=1)
    section = np.stack([np.append(r[:, 0], r[::-1, 1]), np.append(z[:, 0], z[::-1, 1])])
    a, b = section, np.roll(section, -1, axis=1)
    cross = a[0] * b[1] - b[0] * a[1]
    moment = abs((cross * (a[0] + b[0])).sum() / 6)  # ∫r dA of the meshed section
    whole = DENSITY * 2 * math.pi * moment
    motion = craig_bampton(OUTER, POINTS, 64)
    effective = motion.carried @ np.linalg.solve(motion.mass, motion.carried.T)
    for direction in range(3):
        assert 0.9 * whole < effective[direction, direction] < whole * (1 + 1e-9)


@pytest.mark.slow
def test_rings_with_mass_settle_where_statics_says_with_any_number_of_modes():
    static = BEARING.equilibrium(*LOAD, rings=BOTH)
    peaks = []
    for count in (0, 4, 16):
        motion = transient_response(
            BEARING, BOTH, Inertia(mass=30, radius=0.1), *LOAD, duration=0.2, fixed_modes=count
        )
        assert motion.residual < 1e-8
        assert motion.displacement[-1] == pytest.approx(static.displacement, rel=1e-7)
        assert motion.largest_force[-1] == pytest.approx(static.maximum_force, rel=1e-8)
        peaks.append(motion.largest_force.max())
    massless = transient_response(BEARING, BOTH, Inertia(mass=30, radius=0.1), *LOAD, duration=0.2)
    # inertia of rings that are stiff beside their contacts changes the overshoot by a percent
    assert 1e-3 < abs(massless.largest_force.max() / peaks[-1] - 1) < 0.05
    assert peaks[1] == pytest.approx(peaks[2], rel=1e-3)
    assert abs(peaks[1] - peaks[2]) < abs(peaks[0] - peaks[2])


def test_one_vibrating_ring_beside_a_rigid_one():
    rings = FlexibleRings(inner=INNER)
    motion = transient_response(
        BEARING, rings, Inertia(mass=30, radius=0.1), (0, 0, 5e3), duration=0.2, fixed_modes=4
    )
    static = BEARING.equilibrium((0, 0, 5e3), rings=rings)
    assert motion.displacement[-1, 2] == pytest.approx(static.displacement[2], rel=1e-7)


@pytest.mark.parametrize(
    ("inertia", "outer", "count", "word"),
    [
        ({"mass": 1.0}, OUTER, 2, "mass, radius"),
        ({}, OUTER, -1, "fixed_modes"),
        ({}, RingBeam(section=RingSection.rectangle(0.03, 0.04), radius=0.145,
                      supports=(Support(radius=0.145, radial=1e9, tangential=1e9, axial=1e9),)),
         2, "FiniteElementRing"),
    ],
)  # fmt: skip
def test_rings_that_cannot_vibrate_are_refused(inertia, outer, count, word):
    rings = dataclasses.replace(BOTH, outer=outer)
    moving = Inertia(**({"mass": 30.0, "radius": 0.1} | inertia))
    with pytest.raises(InputError, match=word):
        transient_response(BEARING, rings, moving, *LOAD, fixed_modes=count)
    with pytest.raises(InputError, match="harmonic"):
        natural_frequencies(OUTER, -1)
