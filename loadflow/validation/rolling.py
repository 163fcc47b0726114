"""Rolling bearings: the tables of [Ritzer 2018], ISO standards, Harris.

Rows whose source carries "assuming ..." need that assumption, which the source does not state;
rows marked as refused show why a printed number is not held.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from loadflow.rolling import friction
from loadflow.rolling.rating import life, safety
from loadflow.rolling.rings.patches import raceway_points
from loadflow.tribology.hertz import curvature_sum, effective_modulus, stiffness_factor
from loadflow.validation import (
    _rolling_standards,
    _slewing_assumed,
    _slewing_rebuilt,
    _slewing_refused,
    _slewing_trends,
    rings,
)
from loadflow.validation._slewing_cases import (
    BLADE,
    DRIVE,
    FOUR_BALL,
    FRICTION_TESTS,
    MM15,
    RINGS,
    SPECTRUM,
)
from loadflow.validation.check import Check, evidence

RPM = math.pi / 30


@evidence("print of the source")
def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _contacts()
    yield from _statics()
    yield from _life()
    yield from _friction()
    yield from _geometry()
    yield from _slewing_assumed.checks()
    yield from _slewing_rebuilt.checks()
    yield from rings.printed()
    yield from _slewing_trends.checks()
    yield from _slewing_refused.checks()
    yield from _rolling_standards.checks()


def _contacts() -> Iterator[Check]:
    """Hertz: Fig. 3.1, Table 3.12, Table 4.3 and ch. 4.4."""
    sheet = ((80, 0.543, 2_154_099, 63.71951, 0.9617), (-120, 0.598, 2_271_910, 42.88618, 0.9431))
    for side, (r22, psi, k, total, cos_tau) in zip(RINGS, sheet):
        curvatures = (50.0, 50.0, -1 / 0.0205, 1e3 / r22)
        ours, cos_ours = curvature_sum(*curvatures)
        yield Check(f"Σk, {side}", "Fig. 3.1", total, float(ours), 1e-4, "absolute", "1/m")
        yield Check(f"cos τ, {side}", "Fig. 3.1", cos_tau, float(cos_ours), 1e-4, "absolute")
        got = float(stiffness_factor(psi, ours, effective_modulus())) / MM15
        yield Check(
            f"K_A with ψ/ξ = {psi}, {side}", "(3.5), Fig. 3.1", k, got, 1e-6, unit="N/mm^1.5"
        )
        exact = replace(FOUR_BALL, pitch_diameter=0.2).raceway_contact(side)
        yield Check(f"ψ/ξ, {side}", "Fig. 3.1", psi, float(exact.coefficient), 6e-3)
    for bearing, name, printed in (
        # the worksheet enters D_pw for the radius of the raceway along the ring
        (replace(FOUR_BALL, pitch_diameter=0.2), "Table 3.3", (2_154e3, 2_272e3, 2_213e3)),
        (BLADE, "Table 4.3", (2_216e3, 2_221e3, 2_219e3)),
        (DRIVE, "Table 3.12", (1_144e3, 1_161e3, 1_152e3)),
    ):
        both = [float(bearing.raceway_contact(s).stiffness) / MM15 for s in RINGS]
        for label, expected, ours_k in zip(
            ("K_Ai", "K_Aa", "K_A"), printed, (*both, sum(both) / 2)
        ):
            yield Check(label, name, expected, ours_k, 0.01, unit="N/mm^1.5")
    for side, expected in zip(RINGS, (2232, 2202)):
        pressure = float(BLADE.raceway_contact(side, 28_800.0).pressure) / 1e6
        yield Check(f"p_max at 28 800 N, {side}", "ch. 4.4", expected, pressure, 5e-3, unit="MPa")


def _statics() -> Iterator[Check]:
    """Allowed forces, safeties, and the ball force under axial load."""
    factor = safety.hardness_factor(600)
    yield Check("f_s at 600 HV", "(2.8)", 0.844, factor, 1e-3)
    yield Check("p_max,zul", "ch. 2.3", 3545, factor * 4200, 1e-3, unit="MPa")
    unit = float(BLADE.raceway_contact("inner", 1.0).pressure)
    allowed = (factor * 4200e6 / unit) ** 3
    yield Check("F_k,zul", "(4.3)", 113_352, allowed, 0.02, unit="N")
    yield Check("s_0,Fk", "(4.1)", 3.94, float(safety.ratio(allowed, 28_800)), 0.015)
    pressure = float(BLADE.raceway_contact("inner", 28_800.0).pressure)
    hertz = float(safety.ratio(factor * 4200e6, pressure))
    yield Check("s_0,Hertz", "(4.2)", 1.59, hertz, 0.005)
    result = BLADE.equilibrium(force=(0, 0, 2e6))
    force = float(result.maximum_force)
    yield Check("F_k, F_a = 2000 kN, rigid rings", "ch. 3.3", 10_438, force, 5e-4, unit="N")
    thrust = BLADE.equilibrium(force=(0, 0, 3e6))
    shift = float(thrust.displacement[2]) * 1e3
    yield Check("u_z, F_a = 3000 kN, rigid rings", "Fig. 2.9", 0.1, shift, 0.005, "absolute", "mm")


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
    hardened = BLADE.rated_capacity
    yield Check("C_a,h", "(4.11)", 1_076_000, hardened, 5e-3, unit="N")
    years = float(life.rating_life(hardened, equivalent))
    yield Check("L_10", "(2.19)", 0.11, years, 0.005, "absolute", "10⁶")
    speed = life.oscillation_speed(rate, amplitude)
    for i, (expected, got) in enumerate(zip(printed_speed, speed / RPM), start=1):
        yield Check(f"n, case {i}", "Table 4.9", expected, got, 6e-4, "absolute", "1/min")
    hours = float(life.life_hours(0.11, 0.015 * RPM))
    yield Check("L_10h from rounded L_10, n", "(4.12)", 122_222, hours, 1e-5, unit="h")
    mean = life.mean_speed(speed, share)
    own = float(life.life_hours(years, mean))
    yield Check("L_10h", "(4.12)", 122_222, own, 0.01, unit="h")
    yield Check("n_m", "(4.14), assuming Σt = 99 % as is", 0.015, mean / RPM, 0.01, unit="1/min")


def _friction() -> Iterator[Check]:
    """Friction torque, Table 4.11 and 4.12."""
    sums, printed = (2_202_502, 2_703_230, 4_981_978), (15_300, 17_000, 24_600)
    for i, (total, expected) in enumerate(zip(sums, printed), start=1):
        got = float(friction.friction_torque_forces(total, 1.9, idle=8000))
        yield Check(f"M_R, case {i}", "(2.37), Table 4.12", expected, got, 2e-3, unit="N m")
    radial, axial, tilt, _ = FRICTION_TESTS[0]
    got = float(friction.friction_torque_loads(axial, radial, tilt, 1.9, idle=8000))
    yield Check("M_R, case 1", "(2.26), Table 4.12", 19_000, got, 2e-3, unit="N m")


def _geometry() -> Iterator[Check]:
    """Master points of the raceways."""
    cases = (
        (FOUR_BALL, 0.5e-3, "Table 3.4, 3.7", 64.496, 35.504, 14.496),
        (DRIVE, 0.1e-3, "Table 3.11", 130.374, 119.626, 5.374),
    )
    for bearing, shell, source, outer, inner, height in cases:
        for ring, radius in zip(RINGS, (inner, outer)):
            x, _, z = raceway_points(bearing, ring, shell)[0, 0, 0] * 1e3
            yield Check(f"radius, {ring}", source, radius, x, 1e-3, "absolute", "mm")
            yield Check(f"height, {ring}", source, height, z, 1e-3, "absolute", "mm")
    for ring, ball, x, y in (
        ("outer", 2, 18.145, 129.105),
        ("outer", 3, 35.936, 125.324),
        ("outer", 45, -18.145, 129.105),
        ("inner", 2, 16.649, 118.462),
        ("inner", 3, 32.973, 114.992),
        ("inner", 45, -16.649, 118.462),
    ):
        # the table counts from +y, clockwise
        along, across, _ = raceway_points(DRIVE, ring, 0.1e-3)[0, 0, ball - 1] * 1e3
        for axis, printed, got in (("X", x, across), ("Y", y, along)):
            name = f"{axis}, {ring}, ball {ball}"
            yield Check(name, "Table 3.11", printed, got, 1e-3, "absolute", "mm")
