"""Rolling bearings beside standards, handbooks and a catalogue."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from loadflow.rolling import BallBearing, Mounting, RollerBearing
from loadflow.rolling.rating import modified_life as lubricated_life
from loadflow.tribology.contact_ellipse import exact_ellipse
from loadflow.tribology.hertz import curvature_sum
from loadflow.validation._slewing_cases import RINGS
from loadflow.validation.check import Check, evidence

Numbers = tuple[float, ...]


def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _ellipses()
    yield from _iso_16281()
    yield from _harris()
    yield from _catalogue()
    yield from _modified_life()
    yield from _clearance()


@evidence("closed form")
def _clearance() -> Iterator[Check]:
    """What temperatures and fits take off a radial clearance.

    Makers' catalogues: α ΔT E where the inner ring and its rollers are warmer, E the diameter of
    the outer raceway. Lamé, one steel: d/d_i of the interference on a solid shaft, D_o/D in a thick
    housing; with a bore in the shaft (1 − (d_b/d)²)/(1 − (d_b/d_i)²) of it.
    """
    row = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.54)
    solid = Mounting(bore=0.4, inner_interference=1e-4)
    hollow = (1 - (0.3 / 0.4) ** 2) / (1 - (0.3 / 0.5) ** 2)
    for name, source, expected, mounting in (
        ("inner ring and rollers 10 K warmer", "α ΔT E, catalogue of IKO", 11.7e-6 * 10 * 0.58,
         Mounting(outer_temperature=283.15)),
        ("fit on a solid shaft", "Lamé", 1e-4 * 0.4 / 0.5, solid),
        ("fit on a hollow shaft", "Lamé", 1e-4 * 0.4 / 0.5 * hollow,
         replace(solid, shaft_bore=0.3)),
        ("fit in a thick housing", "Lamé", 1e-4 * 0.58 / 0.66,
         Mounting(outside=0.66, outer_interference=1e-4)),
    ):  # fmt: skip
        got = -mounting.at_work(row, 293.15, 293.15).clearance
        yield Check(f"clearance lost, {name}", source, 1e6 * expected, 1e6 * got, 1e-9, unit="μm")


@evidence("closed form")
def _ellipses() -> Iterator[Check]:
    """Ellipticity and elliptic integrals at ratios of curvature computed to all digits."""
    for ratio, *values in (
        (1.5, 1.3101029621, 1.7897650950, 1.3911375419),
        (5.0, 2.8901810398, 2.4937439947, 1.1205197241),
        (10.0, 4.4994473032, 2.9142026887, 1.0598843439),
        (50.0, 12.0711467813, 3.8820667182, 1.0116130397),
    ):
        for name, expected, got in zip("kKE", values, exact_ellipse(ratio)):
            yield Check(
                f"{name} at R_y/R_x = {ratio:g}", "Hertz, exact", expected, float(got), 1e-9
            )


@evidence("another code")
def _iso_16281() -> Iterator[Check]:
    """Seven worked cases of a 6305 with a commercial program's results (lever arm D_pw/2)."""
    ball = 11.5e-3
    tight = BallBearing(
        balls=7,
        ball_diameter=ball,
        pitch_diameter=43.5e-3,
        groove_radius=0.52 * ball,
        outer_groove_radius=0.53 * ball,
        dynamic_capacity=23_400,
        lever="pitch",
    )
    loose = replace(tight, clearance=10e-6)
    source = "ISO/TS 16281, 6305"
    for bearing, gap, shifts, lives in (
        (tight, "0", (15.1101, 133.5381), (13163.019, 2222.7318)),
        (loose, "10 μm", (21.223, 149.1717), (10795.79, 3115.88)),
    ):
        result = bearing.equilibrium(force=[(1000, 0, 0), (0, 0, 1000)])
        for i, (load, axis) in enumerate((("F_r", 0), ("F_a", 2))):
            shift = float(result.displacement[i, axis]) * 1e6
            name = f"{load} = 1 kN, s = {gap}"
            yield Check(f"shift, {name}", source, shifts[i], shift, 5e-4, unit="μm")
            yield Check(
                f"L_10r, {name}",
                source,
                lives[i],
                float(result.reference_life[i]),
                5e-4,
                unit="10⁶",
            )
    mixed = loose.equilibrium(force=(1000, 0, 1000), moment=(1, 0))
    q = mixed.displacement
    name = "F_r = F_a = 1 kN, M = 1 N m, s = 10 μm"
    for label, expected, got, unit in (
        ("radial shift", 19.7144, math.hypot(q[0], q[1]) * 1e6, "μm"),
        ("axial shift", 146.3084, q[2] * 1e6, "μm"),
        ("tilt", 2.7239, math.hypot(q[3], q[4]) * 1e3, "mrad"),
        ("L_10r", 1627.75, float(mixed.reference_life), "10⁶"),
    ):
        yield Check(f"{label}, {name}", source, expected, got, 5e-4, unit=unit)
    pure = tight.equilibrium(force=(0, 0, 0), moment=(0, 1))
    tilt = float(pure.displacement[4]) * 1e3
    yield Check("tilt, M = 1 N m, s = 0", source, 3.6957, tilt, 5e-4, unit="mrad")
    years = float(pure.reference_life)
    yield Check("L_10r, M = 1 N m, s = 0", source, 785_144.75, years, 7e-3, unit="10⁶")


@evidence("print of the source")
def _harris() -> Iterator[Check]:
    """Harris's worked example of the 209 deep groove bearing."""
    ball = 12.7e-3
    bearing = BallBearing(
        balls=9,
        ball_diameter=ball,
        pitch_diameter=65e-3,
        groove_radius=0.52 * ball,
        clearance=15e-6,
        elastic_modulus=206.8e9,
    )
    for side, total, tau in zip(RINGS, (0.202, 0.138), (0.9399, 0.9120)):
        groove, ring = -1 / bearing.groove(side), 52.3 if side == "inner" else -77.7
        ours, cos_ours = curvature_sum(2 / ball, 2 / ball, groove, 2e3 / ring)
        name = f"{side}, 209"
        yield Check(f"Σρ, {name}", "Harris", total, float(ours) / 1e3, 3e-3, unit="1/mm")
        yield Check(f"F(ρ), {name}", "Harris", tau, float(cos_ours), 1e-3)
    result = bearing.equilibrium(force=(8900, 0, 0))
    shift = float(result.displacement[0]) * 1e6
    yield Check("radial shift, 209", "Harris", 60.4, shift, 5e-3, unit="μm")
    yield Check("Q_max, 209", "Harris", 4536, float(result.maximum_force), 5e-3, unit="N")


@evidence("print of the source")
def _catalogue() -> Iterator[Check]:
    """Dynamic capacities of deep groove bearings from their geometry, beside a catalogue."""
    for name, balls, ball, pitch, printed in (
        ("6305", 7, 11.5, 43.5, 23_400),
        ("6209", 9, 12.7, 65.0, 35_100),
    ):
        bearing = BallBearing(
            balls=balls,
            ball_diameter=ball * 1e-3,
            pitch_diameter=pitch * 1e-3,
            groove_radius=0.52 * ball * 1e-3,
        )
        source = "catalogue, assuming grooves of 0.52 D"
        yield Check(f"C, {name}", source, printed, bearing.rated_capacity, 0.03, unit="N")


@evidence("closed form")
def _modified_life() -> Iterator[Check]:
    """a_ISO by hand, from the printed formulas: one bearing of each kind, one branch of κ each.

    Speed (1/min), D_pw (mm), viscosity (mm²/s), C₀ and P (N) lead to ν₁, κ, e_C, C_u, e_C C_u/P and
    a_ISO; the last bearing has κ = 4, the end of the range.
    """
    cases: tuple[tuple[lubricated_life.Kind, str, Numbers, Numbers], ...] = (
        (
            "radial-ball",
            "oil, filtered, -/15/12",
            (3000, 72.5, 20, 31.5e3, 4000),
            (9.64901, 2.07275, 0.568873, 1431.82, 0.203631, 16.38746),
        ),
        (
            "radial-roller",
            "grease, normal cleanliness",
            (12, 1000, 150, 20e6, 1.5e6),
            (180.9223, 0.829085, 0.885900, 1.222408e6, 0.721954, 1.771742),
        ),
        (
            "thrust-ball",
            "grease, slight to typical contamination",
            (5, 1900, 200, 29e6, 3e5),
            (271.4505, 0.736783, 0.790486, 302_411.6, 0.796841, 4.164786),
        ),
        (
            "thrust-roller",
            "oil, filtered, -/17/14",
            (1200, 300, 30, 3e6, 4e5),
            (7.5, 4.0, 0.756077, 263_130.4, 0.497367, 1.326642),
        ),
    )
    for kind, cleanliness, (n, pitch, nu, c0, p), by_hand in cases:
        speed, size = n * math.pi / 30, pitch * 1e-3
        nu_1 = float(lubricated_life.reference_viscosity(speed, size)) * 1e6
        kappa = nu / nu_1
        clean = float(lubricated_life.contamination_factor(cleanliness, kappa, size))
        limit = lubricated_life.fatigue_limit(c0, kind, size)
        ratio = clean * limit / p
        factor = float(lubricated_life.life_factor(kappa, ratio, kind))
        names = ("ν₁", "κ", "e_C", "C_u", "e_C C_u/P", "a_ISO")
        units = ("mm²/s", "-", "-", "N", "-", "-")
        ours = (nu_1, kappa, clean, limit, ratio, factor)
        for name, unit, printed, got in zip(names, units, by_hand, ours):
            yield Check(f"{name}, {kind}", "ISO 281, by hand", printed, got, 2e-6, unit=unit)
