"""Rolling bearings: tables of [Ritzer 2018], of ISO/TS 16281 worked cases and of Harris.

Rows whose source carries "assuming ..." need that assumption, which the source does not state.
Not compared, because the printed numbers contradict themselves or cannot be derived: the flexible
deflection 0.35 mm of Bild 2.9, angles and pressures of Appendix B (wrong Hertz coefficients), the
ball forces of Tab. 3.14 (not in equilibrium with their load), Tab. 3.5 at 5 kN (below the rigid
bound), α = 38.19° (the complement, and not of its own forces), the computed torques of Tab. 2.5
rows 2 and 3, measured friction (40 … 60 % above every formula).
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from loadflow.rolling import BallBearing, SlewingBearing, capacity, friction, life, safety
from loadflow.rolling.patches import raceway_points
from loadflow.rolling.raceway import Raceway
from loadflow.rolling.slewing_result import SlewingResult
from loadflow.tribology.hertz import (
    curvature_sum,
    effective_modulus,
    exact_ellipse,
    stiffness_factor,
)
from loadflow.validation.check import Check

MM15 = 1e3**1.5  # N/mm^1.5 in N/m^1.5
RPM = math.pi / 30
RINGS: tuple[Raceway, Raceway] = ("inner", "outer")

BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=math.pi / 4,
    hardness=600,
    life_hardness_factor=0.85,
    curvature="ritzer",
)
FOUR_BALL = replace(BLADE, balls=4, rows=1, pitch_diameter=0.1, life_hardness_factor=1.0)
DRIVE = SlewingBearing(
    balls=45,
    ball_diameter=0.015,
    pitch_diameter=0.250,
    groove_radius=0.0078,
    contact_angle=math.pi / 4,
    curvature="ritzer",
)

# Tab. 4.2, 4.4, 4.6, 4.7, 4.9:
# F_r, F_a (N), M_k (N m), F_k,max, P_ea (N), t (%), N (1/min), O (°), n (1/min)
SPECTRUM = np.array(
    [
        [94_000, 38_500, 420_800, 7_200, 769_000, 43.75, 7.25, 0.422, 0.0085],
        [188_000, 44_000, 841_600, 14_500, 1_540_000, 23.96, 8.97, 0.602, 0.015],
        [208_000, 86_000, 1_261_600, 22_000, 2_378_000, 10.51, 9.26, 0.894, 0.023],
        [380_000, 113_000, 1_673_200, 28_800, 3_057_000, 9.67, 10.17, 1.062, 0.030],
        [384_000, 99_400, 1_441_200, 25_100, 2_655_000, 9.36, 9.59, 0.826, 0.022],
        [176_500, 34_800, 347_000, 7_400, 754_442, 1.75, 9.02, 0.838, 0.021],
    ]
)


def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _contacts()
    yield from _statics()
    yield from _life()
    yield from _friction()
    yield from _geometry()
    yield from _assumed()
    yield from _ellipses()
    yield from _iso_16281()
    yield from _harris()
    yield from _catalogue()


def _contacts() -> Iterator[Check]:
    """Hertz: Bild 3.1, Tab. 3.12, Tab. 4.3 and ch. 4.4."""
    sheet = ((80, 0.543, 2_154_099, 63.71951, 0.9617), (-120, 0.598, 2_271_910, 42.88618, 0.9431))
    for side, (r22, psi, k, total, cos_tau) in zip(RINGS, sheet):
        curvatures = (50.0, 50.0, -1 / 0.0205, 1e3 / r22)
        ours, cos_ours = curvature_sum(*curvatures)
        yield Check(f"Σk, {side}", "Bild 3.1", total, float(ours), 1e-4, "absolute", "1/m")
        yield Check(f"cos τ, {side}", "Bild 3.1", cos_tau, float(cos_ours), 1e-4, "absolute")
        got = float(stiffness_factor(psi, ours, effective_modulus())) / MM15
        yield Check(
            f"K_A with ψ/ξ = {psi}, {side}", "(3.5), Bild 3.1", k, got, 1e-6, unit="N/mm^1.5"
        )
        exact = replace(FOUR_BALL, pitch_diameter=0.2).raceway_contact(side)
        yield Check(f"ψ/ξ, {side}", "Bild 3.1", psi, float(exact.coefficient), 6e-3)
    for bearing, name, printed in (
        (BLADE, "Tab. 4.3", (2_216e3, 2_221e3, 2_219e3)),
        (DRIVE, "Tab. 3.12", (1_144e3, 1_161e3, 1_152e3)),
    ):
        both = [float(bearing.raceway_contact(s).stiffness) / MM15 for s in RINGS]
        for label, expected, ours_k in zip(
            ("K_Ai", "K_Aa", "K_A"), printed, (*both, sum(both) / 2)
        ):
            yield Check(label, name, expected, ours_k, 0.01, unit="N/mm^1.5")
    for side, expected in zip(RINGS, (2232, 2202)):
        pressure = float(BLADE.raceway_contact(side, 28_800.0).pressure) / 1e6
        yield Check(f"p_max at 28 800 N, {side}", "ch. 4.4", expected, pressure, 5e-3, unit="MPa")


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


def _statics() -> Iterator[Check]:
    """Allowed forces, safeties, and the ball force under axial load."""
    factor = safety.hardness_factor(600)
    yield Check("f_s at 600 HV", "(2.8)", 0.844, factor, 1e-3)
    yield Check("p_max,zul", "ch. 2.3", 3545, factor * 4200, 1e-3, unit="MPa")
    unit = float(BLADE.raceway_contact("inner", 1.0).pressure)
    yield Check("F_k,zul", "(4.3)", 113_352, (3545e6 / unit) ** 3, 0.02, unit="N")
    yield Check("s_0,Fk", "(4.1)", 3.94, float(safety.ratio(113_352, 28_800)), 0.005, "absolute")
    yield Check("s_0,Hertz", "(4.2)", 1.59, float(safety.ratio(3545, 2232)), 0.005, "absolute")
    result = BLADE.equilibrium(force=(0, 0, 2e6))
    force = float(result.maximum_force)
    yield Check("F_k, F_a = 2000 kN, rigid rings", "ch. 3.3", 10_438, force, 5e-4, unit="N")
    thrust = BLADE.equilibrium(force=(0, 0, 3e6))
    shift = float(thrust.displacement[2]) * 1e3
    yield Check("u_z, F_a = 3000 kN, rigid rings", "Bild 2.9", 0.1, shift, 0.005, "absolute", "mm")


def _life() -> Iterator[Check]:
    """Life of the blade bearing, ch. 4.4."""
    load, share, rate = SPECTRUM[:, 4], SPECTRUM[:, 5] / 100, SPECTRUM[:, 6] / 60
    amplitude, printed_speed = np.radians(SPECTRUM[:, 7]), SPECTRUM[:, 8]
    critical = math.degrees(life.critical_amplitude(129, BLADE.gamma))
    yield Check("O_crit", "(4.6), (4.7)", 11.17, critical, 5e-4, unit="°")
    equivalent = life.oscillation_load(load, rate, share, amplitude)
    yield Check("P_ea of the spectrum", "(4.5)", 2_239_000, equivalent, 5e-4, unit="N")
    rated = replace(BLADE, life_hardness_factor=1.0).rated_capacity
    yield Check("C_a", "(4.9)", 1_266_000, rated, 5e-3, unit="N")
    yield Check(
        "f_cm, γ = 0.02", "Tab. 4.8", 51.7, capacity.capacity_factor(0.02, math.pi / 4), 1e-12
    )
    yield Check("C_a,h", "(4.11)", 1_076_000, 0.85 * 1_266_000, 1e-3, unit="N")
    years = float(life.rating_life(1_076_000, 2_239_000))
    yield Check("L_10", "(2.19)", 0.11, years, 0.005, "absolute", "10⁶")
    speed = life.oscillation_speed(rate, amplitude)
    for i, (expected, got) in enumerate(zip(printed_speed, speed / RPM), start=1):
        yield Check(f"n, case {i}", "Tab. 4.9", expected, got, 6e-4, "absolute", "1/min")
    hours = float(life.life_hours(0.11, 0.015 * RPM))
    yield Check("L_10h from rounded L_10, n", "(4.12)", 122_222, hours, 1e-5, unit="h")
    mean = life.mean_speed(speed, share)
    own = float(life.life_hours(years, mean))
    yield Check("L_10h", "(4.12)", 122_222, own, 0.01, unit="h")
    yield Check("n_m", "(4.14), assuming Σt = 99 % as is", 0.015, mean / RPM, 0.01, unit="1/min")


def _friction() -> Iterator[Check]:
    """Friction torque, Tab. 4.11 and 4.12."""
    sums, printed = (2_202_502, 2_703_230, 4_981_978), (15_300, 17_000, 24_600)
    for i, (total, expected) in enumerate(zip(sums, printed), start=1):
        got = float(friction.friction_torque_forces(total, 1.9, idle=8000))
        yield Check(f"M_R, case {i}", "(2.37), Tab. 4.12", expected, got, 2e-3, unit="N m")
    got = float(friction.friction_torque_loads(1e6, 250e3, 1e6, 1.9, idle=8000))
    yield Check("M_R, case 1", "(2.26), Tab. 4.12", 19_000, got, 2e-3, unit="N m")


def _geometry() -> Iterator[Check]:
    """Master points of the raceways, and the arithmetic of Tab. 3.8."""
    cases = (
        (FOUR_BALL, 0.5e-3, "Tab. 3.4, 3.7", 64.496, 35.504, 14.496),
        (DRIVE, 0.1e-3, "Tab. 3.11", 130.374, 119.626, 5.374),
    )
    for bearing, shell, source, outer, inner, height in cases:
        for ring, radius in zip(RINGS, (inner, outer)):
            x, _, z = raceway_points(bearing, ring, shell)[0, 0, 0] * 1e3
            yield Check(f"radius, {ring}", source, radius, x, 1e-3, "absolute", "mm")
            yield Check(f"height, {ring}", source, height, z, 1e-3, "absolute", "mm")
    second = raceway_points(DRIVE, "outer", 0.1e-3)[0, 0, 1] * 1e3
    yield Check("ball 2, along", "Tab. 3.11", 129.105, second[0], 1e-3, "absolute", "mm")
    yield Check("ball 2, across", "Tab. 3.11", 18.145, second[1], 1e-3, "absolute", "mm")
    table = zip((8, 18, 23, 45, 73), (7, 16, 20, 41, 67), (-12.5, -11.1, -13.0, -8.8, -8.2))
    for mbs, fem, printed in table:
        share = 100 * (fem / mbs - 1)
        yield Check(
            f"Δ at {mbs} μm", "Tab. 3.13, its arithmetic", printed, share, 0.1, "absolute", "%"
        )
    yield Check(
        "F_k of its components",
        "Tab. 3.8, its arithmetic",
        9500,
        math.hypot(5830, 7500),
        1e-4,
        unit="N",
    )


def _assumed() -> Iterator[Check]:
    """Cases that rest on an assumption; the sources of the rows name it."""
    rigid = "rigid rings, G = 0"
    coacting = f"{rigid}, F_r and M_k co-acting"
    loads = np.array([[250e3, 1000e3, 1000e3], [500e3, 2000e3, 500e3], [250e3, 500e3, 3000e3]])
    sums = _coacting(BLADE, *loads.T).force_sum
    for i, (expected, got, tolerance) in enumerate(
        zip((2_202_502, 2_703_230, 4_981_978), sums, (0.025, 5e-3, 5e-3)), start=1
    ):
        yield Check(
            f"ΣF_k, case {i}",
            f"Tab. 4.11, assuming {coacting}",
            expected,
            float(got),
            tolerance,
            unit="N",
        )
    tilt = BLADE.equilibrium(force=(0, 0, 0), moment=(500e3, 0)).maximum_force
    yield Check(
        "F_k, M_k = 500 kNm",
        f"ch. 3.3, assuming {rigid}, L_A = 0",
        6182,
        float(tilt),
        0.04,
        unit="N",
    )
    radial = BLADE.equilibrium(force=(500e3, 0, 0))
    both, angle = radial.ball_forces[0, :, 0], radial.contact_angles[0, :, 0]
    vector = math.hypot(*(both @ np.stack([np.cos(angle), np.sin(angle) * [1, -1]], axis=1)))
    yield Check(
        "F_k, F_r = 500 kN",
        f"ch. 3.3, assuming {rigid}, F_k of both diagonals",
        7665,
        vector,
        0.07,
        unit="N",
    )
    wide = replace(BLADE, row_spacing=0.06)
    combined = _coacting(wide, 500e3, 500e3, 2000e3).maximum_force
    yield Check(
        "F_k, Tab. 3.1",
        f"ch. 3.3, assuming {coacting}, L_A = 60 mm",
        32_700,
        float(combined),
        0.1,
        unit="N",
    )
    spectrum = _coacting(wide, *SPECTRUM[:, :3].T)
    for i, row in enumerate(SPECTRUM):
        band = f"assuming {coacting}, L_A = 60 mm; printed is flexible"
        largest = float(spectrum.maximum_force[i])
        yield Check(f"F_k,max, case {i + 1}", f"Tab. 4.4, {band}", row[3], largest, 0.2, unit="N")
        load = float(spectrum.equivalent_load[i])
        yield Check(f"P_ea, case {i + 1}", f"Tab. 4.6, {band}", row[4], load, 0.17, unit="N")
    extract = zip(
        (3400, 3200, 3000, 2900, 2700, 2500, 2400, 2200),
        (1098, 1077, 1056, 1035, 1014, 992, 970, 940),
    )
    for force, pressure in extract:
        got = float(BLADE.raceway_contact("inner", force).pressure) / 1e6
        yield Check(
            f"p_max at {force} N",
            "Bild 2.17, assuming the blade bearing, inner ring",
            pressure,
            got,
            0.015,
            unit="MPa",
        )
    approach = 2 * (9500 / 2.213e6) ** (2 / 3)
    free, alpha = FOUR_BALL.groove_distance * 1e3, math.radians(52.14)
    shift = (free + approach) * math.sin(alpha) - free * math.sin(math.pi / 4)
    yield Check(
        "u_z of the simplified model",
        "ch. 3.5, assuming equal contacts and α = 52.14°",
        0.126,
        shift,
        0.03,
        unit="mm",
    )


def _coacting(
    bearing: SlewingBearing, radial: ArrayLike, axial: ArrayLike, tilt: ArrayLike
) -> SlewingResult:
    """Equilibrium with radial force and moment loading the same balls as +F_a."""
    x, z, turn = (np.asarray(v, float) for v in (radial, axial, tilt))
    zero = np.zeros_like(x)
    return bearing.equilibrium(
        force=np.stack([x, zero, z], axis=-1), moment=np.stack([zero, -turn], axis=-1)
    )


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
