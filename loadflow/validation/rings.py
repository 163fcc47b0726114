"""Flexible rings of slewing bearings: closed forms, our own solid rings.

The source's ring sections are lost, so that every row of it (`printed`, shown by the table
``rolling``) assumes sections and supports, which its label states. `SOLID_FOUR`, `SOLID_DRIVE` hold
answers of rings in three dimensions with the contact resolved (no Hertz, no master points), formed
by ``python -m benchmarks.references.ring_contact``; `UNCONDENSED` those with every ring mode and
ball centre an unknown, ``python -m benchmarks.references.ring_reference``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np

from loadflow.rolling import (
    BoltCircle,
    FlexibleRings,
    RingBeam,
    RingSection,
    SlewingBearing,
    Support,
)
from loadflow.rolling.rings.bolts import Strength
from loadflow.rolling.rings.finite_element import FiniteElementRing
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.rolling.rings.profile import RingProfile
from loadflow.validation._slewing_cases import DRIVE, FOUR_BALL
from loadflow.validation.check import Check, evidence

Load = tuple[float, ...]

# axial load (N) → u_z (m) and ball force (N), contact resolved, four_ball_rings() and drive_rings()
SOLID_FOUR = {
    1e4: (4.45278e-5, 3440.6), 3e4: (9.73408e-5, 10075.6),
    -1e4: (4.02976e-5, 3429.37), -3e4: (8.31301e-5, 9968.5),
}  # fmt: skip
SOLID_DRIVE = {
    5e4: (3.7568e-5, 1511.33), 1e5: (6.08011e-5, 2971.18),
    -5e4: (3.25859e-5, 1513.73), -1e5: (5.09462e-5, 2981.04),
}  # fmt: skip
# load (N, N m) → |displacement| (m; tilts times D_pw/2) and largest ball force (N), drive_rings()
UNCONDENSED: dict[Load, tuple[float, float]] = {
    (0, 0, 5e4, 0, 0): (3.74567e-05, 1508.1864),
    (0, 0, -5e4, 0, 0): (3.34072e-05, 1514.6103),
    (6500, 0, 8000, 0, -2000): (2.95258e-05, 1489.1247),
    (6500, 0, 8000, 0, 2000): (4.24177e-05, 1618.2534),
    (0, 0, 0, 2000, 0): (2.80028e-05, 1074.9315),
    (2e4, 0, 0, 0, 0): (3.19394e-05, 1275.7726),
}
# Table 3.13: F_a (N), u_z (m) of the source's multibody model and of its finite elements
TABLE_3_13 = ((5e3, 0.008e-3, 0.007e-3), (15e3, 0.018e-3, 0.016e-3), (20e3, 0.023e-3, 0.020e-3),
              (50e3, 0.045e-3, 0.041e-3), (100e3, 0.073e-3, 0.067e-3))  # fmt: skip
MASTER_WIDTH = 3e-3  # m, of 3 to 5 quadratic elements across a ring of 21 mm
ASSUMED = "assuming rings of 32 × 40 mm clamped at one face"


def drive_rings() -> FlexibleRings:
    """Rings of the 45-ball bearing with assumed sections, each clamped at one face."""
    exact = replace(DRIVE, curvature="exact")
    outer = RingProfile(
        bearing=exact, ring="outer", inside=0.256, outside=0.32, bottom=-0.02, top=0.02
    )
    inner = RingProfile(
        bearing=exact, ring="inner", inside=0.18, outside=0.244, bottom=-0.02, top=0.02
    )
    return FlexibleRings(
        outer=FiniteElementRing(profile=outer, held="bottom"),
        inner=FiniteElementRing(profile=inner, held="top"),
    )


def four_ball_rings() -> FlexibleRings:
    """Rings of Table 3.6; outer ring resting on its lower, inner ring on its upper face."""
    outer = RingProfile(
        bearing=FOUR_BALL, ring="outer", inside=0.108, outside=0.15, bottom=-0.03, top=0.03
    )
    inner = RingProfile(
        bearing=FOUR_BALL, ring="inner", inside=0.05, outside=0.092, bottom=-0.03, top=0.03
    )
    return FlexibleRings(
        outer=FiniteElementRing(profile=outer, held="bottom", grip=1e9),
        inner=FiniteElementRing(profile=inner, held="top", grip=1e9),
    )


def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _closed_forms()
    yield from _bolts()
    yield from _rigid_limit()
    yield from _in_series()
    yield from _four_ball()
    yield from _drive()


@evidence("print of the source")
def printed() -> Iterator[Check]:
    """Yield the source's rows, which the table ``rolling`` shows."""
    yield from _four_ball_printed()
    yield from _drive_printed()


@evidence("closed form")
def _closed_forms() -> Iterator[Check]:
    """Thin rings against textbook formulas."""
    radius, modulus = 0.5, 210e9
    ring = RingBeam(section=RingSection.rectangle(0.002, 0.002), radius=radius, harmonics=100)
    matrix = _compliance(ring, np.array([0, math.pi]), radius, 0.0)
    opening = matrix[:, 0, :, 0].sum()
    thin = radius**3 / (modulus * 0.002**4 / 12) * (math.pi / 4 - 2 / math.pi)
    yield Check("pinched thin ring, opening", "P R³/(E I) (π/4 - 2/π)", thin, opening, 1e-4,
                unit="m/N")  # fmt: skip
    width, tall = 0.02, 0.05
    area, inertia_axial = width * tall, tall * width**3 / 12
    inertia_radial = width * tall**3 / 12
    ring = RingBeam(section=RingSection.rectangle(width, tall), radius=radius, harmonics=8)
    around = 2 * math.pi * np.arange(32) / 32
    for height in (0.0, 0.025):
        matrix = _compliance(ring, around, radius, height)
        moved = matrix[:, 0, :, 0].sum(axis=1).mean() * 2 * math.pi * radius / 32
        bends = 1 + inertia_axial / (area * radius**2)  # a wider ring is less curved
        stretch = radius**2 / (modulus * area * bends)
        twist = height**2 * radius**2 / (modulus * inertia_radial)
        yield Check(f"uniform radial load {height * 1e3:g} mm off the centroid",
                    "q R²/(E A) (1 + I_a/A R²)⁻¹ + q e² R²/(E I_r)", stretch + twist, moved,
                    1e-9,
                    unit="m²/N")  # fmt: skip


def _compliance(ring: RingBeam, azimuth: np.ndarray, radius: float, height: float) -> np.ndarray:
    points = PatchPoints(np.array([radius]), np.array([height]), azimuth)
    factor = ring.flexibility(points)[0]
    return np.einsum("bcm,BCm->bcBC", factor, factor)


def _beams(stiffness: float = 1.0) -> FlexibleRings:
    """Rings of the 45-ball bearing as beams on a bed at one face."""
    section, width = RingSection.rectangle(0.030, 0.040), 0.032
    bed = 1e11 * stiffness
    springs: dict[str, Any] = {
        "radial": bed * width, "tangential": bed * width, "axial": bed * width,
        "tilt": bed * width**3 / 12,
    }  # fmt: skip
    common: dict[str, Any] = {"section": section, "elastic_modulus": 210e9 * stiffness}
    return FlexibleRings(
        outer=RingBeam(
            radius=0.145, **common,
            supports=(Support(radius=0.144, height=-0.02, **springs),),
        ),
        inner=RingBeam(
            radius=0.105, **common, supports=(Support(radius=0.106, height=0.02, **springs),)
        ),
    )  # fmt: skip


def _solve(bearing: SlewingBearing, load: Load, rings: FlexibleRings) -> tuple[float, float]:
    """Size of the displacement, tilts times D_pw/2 (m), and largest ball force (N)."""
    result = bearing.equilibrium(load[:3], load[3:], rings=rings)
    size = np.linalg.norm(result.displacement / result.contacts.scale)
    return float(size), float(result.maximum_force)


@evidence("print of the source")
def _bolts() -> Iterator[Check]:
    """Assembly preload of bolts with fine threads, kN."""
    source = "table of VDI 2230:2001, 90 % of the yield strength"
    cases: tuple[tuple[int, float, Strength, float, float], ...] = (
        (10, 1.25, "10.9", 0.12, 46.4), (12, 1.25, "12.9", 0.14, 80.4),
        (16, 1.5, "8.8", 0.12, 87.6), (20, 1.5, "8.8", 0.12, 148.0), (20, 1.5, "10.9", 0.10, 215.0),
        (22, 1.5, "12.9", 0.14, 296.0), (24, 2.0, "8.8", 0.14, 204.0),
        (24, 2.0, "10.9", 0.12, 297.0), (24, 2.0, "12.9", 0.10, 355.0),
    )  # fmt: skip
    for size, pitch, strength, friction, printed in cases:
        bolts = BoltCircle(
            radius=1.0, height=-0.1, count=36, diameter=size * 1e-3, pitch=pitch * 1e-3, grip=0.1,
            strength=strength, friction=friction,
        )  # fmt: skip
        name = f"preload of M{size} x {pitch:g}, {strength}, μ = {friction:g}"
        # the print does not say with which digits of areas and diameters it calculates
        yield Check(name, source, printed, bolts.preload / 1e3, 0.003, unit="kN")


@evidence("consistency")
def _rigid_limit() -> Iterator[Check]:
    """Rings a million times stiffer are rigid."""
    rigid = DRIVE.equilibrium((6500, 0, 8000), (0, 2000))
    _, force = _solve(DRIVE, (6500, 0, 8000, 0, 2000), _beams(1e6))
    yield Check("F_k,max, rings 10⁶ times stiffer", "rigid rings", float(rigid.maximum_force),
                force, 1e-6, unit="N")  # fmt: skip


@evidence("consistency")
def _in_series() -> Iterator[Check]:
    """Under axial load the rings are springs in series: what each of them adds, adds up."""
    both = _beams()
    rigid, one, other, up = (
        float(DRIVE.equilibrium((0, 0, 5e4), rings=r).displacement[2])
        for r in ("rigid", replace(both, inner=None), replace(both, outer=None), both)
    )
    # the contact angle turns with all of them
    yield Check("u_z, both rings flexible", "rigid rings and what each flexible one adds",
                1e3 * (one + other - rigid), 1e3 * up, 0.01, unit="mm")  # fmt: skip


def _four_ball_printed() -> Iterator[Check]:
    """Simplified model of Table 3.6 under 30 kN, as multibody model."""
    as_source = replace(four_ball_rings(), master_width=MASTER_WIDTH)
    note = "assuming rings that slide on a held face, elements of 3 mm at the master nodes"
    for load, printed, name in ((3e4, 0.134, "tension"), (-3e4, 0.126, "compression")):
        shift, force = _solve(FOUR_BALL, (0, 0, load, 0, 0), as_source)
        yield Check(f"u_z, four balls, {name}", f"ch. 3.5, {note}", printed, shift * 1e3, 0.15,
                    unit="mm")  # fmt: skip
    source = f"Table 3.8, {note}"
    yield Check("F_k, four balls", source, 9500, force, 0.15, unit="N")


@evidence("consistency")
def _four_ball() -> Iterator[Check]:
    """Simplified model of Table 3.6 beside the contact resolved."""
    rings = four_ball_rings()
    for load, expected in SOLID_FOUR.items():
        axial: Load = (0, 0, load, 0, 0)
        name = f"four balls, F_a = {load / 1e3:g} kN"
        yield from _beside(FOUR_BALL, axial, rings, expected, name, "own solid rings, Table 3.6")


def _drive_printed() -> Iterator[Check]:
    """45-ball bearing beside the source's multibody model and its finite elements."""
    rings = drive_rings()
    as_source = replace(rings, master_width=MASTER_WIDTH)
    masters = f"{ASSUMED}, elements of 3 mm at the master nodes"
    for thrust, multibody, elements in TABLE_3_13:
        name = f"u_z, 45 balls, F_a = {thrust / 1e3:g} kN"
        for model, printed, note in (
            (as_source, multibody, f"multibody, {masters}"),
            (rings, elements, f"finite elements, {ASSUMED}"),
        ):
            shift = _solve(DRIVE, (0, 0, thrust, 0, 0), model)[0]
            yield Check(
                name, f"Table 3.13, {note}", printed * 1e3, shift * 1e3, 0.15, unit="mm",
            )  # fmt: skip


@evidence("consistency")
def _drive() -> Iterator[Check]:
    """45-ball bearing beside fuller models of our own."""
    rings, exact = drive_rings(), replace(DRIVE, curvature="exact")
    for load, expected in SOLID_DRIVE.items():
        axial: Load = (0, 0, load, 0, 0)
        name = f"45 balls, F_a = {load / 1e3:g} kN"
        yield from _beside(exact, axial, rings, expected, name, f"own solid rings, {ASSUMED}")
    for case, expected in UNCONDENSED.items():
        name = "F = ({:g}, {:g}, {:g}) N, M = ({:g}, {:g}) N m".format(*case)
        yield from _beside(
            exact, case, rings, expected, name, f"nothing condensed, {ASSUMED}", (5e-5, 5e-4)
        )


def _beside(
    bearing: SlewingBearing,
    load: Load,
    rings: FlexibleRings,
    expected: tuple[float, float],
    name: str,
    source: str,
    within: tuple[float, float] = (0.05, 0.015),
) -> Iterator[Check]:
    """Displacement and largest ball force beside those of a fuller model, and how near it is.

    Forces of balls add up to the load whatever the rings do: they are nearer than displacements.
    """
    shift, force = _solve(bearing, load, rings)
    for label, fuller, got, tolerance, unit in (
        ("|u|", expected[0] * 1e3, shift * 1e3, within[0], "mm"),
        ("F_k,max", expected[1], force, within[1], "N"),
    ):
        yield Check(f"{label}, {name}", source, fuller, got, tolerance, unit=unit)
