"""Numbers of [Ritzer 2018]'s bearings with rigid rings, rebuilt by a solver that is not this one.

They are not printed, but computed from the printed inputs and the printed stiffness K_A, which ours
take here, too; to the digits that were kept of them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from loadflow.rolling import SlewingBearing
from loadflow.rolling.rating import life
from loadflow.validation._slewing_cases import (
    BLADE,
    DRIVE,
    FOUR_BALL,
    FRICTION_TESTS,
    MM15,
    SPECTRUM,
    coacting,
)
from loadflow.validation.check import Check, evidence

_SOURCE = "rebuilt, rigid rings, K_A as printed"
_WITHIN = 2e-4
"""Share of forces: four digits, and tilts that are small angles here."""


@evidence("another code")
def checks() -> Iterator[Check]:
    """Yield all rows."""
    blade = replace(BLADE, contact_stiffness=2.219e6 * MM15)
    yield from _axial()
    yield from _stiffness(blade)
    yield from _forces(blade)
    yield from _orientations(blade)
    # x = 9/10 below the critical travel, as Rumbarger has it
    load, share, rate, travel = SPECTRUM[:, 4:8].T
    got = life.oscillation_load(
        load, rate / 60, share / 100, np.radians(travel),
        critical=life.critical_amplitude(129, BLADE.gamma), rule="rumbarger",
    )  # fmt: skip
    name = "P_ea of the spectrum, x = 9/10 below O_crit"
    yield Check(name, "(4.5), rebuilt", 2_216_904, got, 1e-6, unit="N")


def _axial() -> Iterator[Check]:
    """Shift under axial load alone, of the bearings of Table 3.13 and 3.5."""
    drive = replace(DRIVE, contact_stiffness=1.152e6 * MM15)
    four = replace(FOUR_BALL, contact_stiffness=2.213e6 * MM15)
    for bearing, what, loads in (
        (
            drive,
            "45 balls",
            ((5, 7.42), (10, 11.71), (15, 15.28), (20, 18.43), (50, 33.32), (100, 51.77)),
        ),
        (four, "four balls", ((5, 23.9),)),
    ):
        for thrust, expected in loads:
            got = 1e6 * float(bearing.equilibrium((0, 0, thrust * 1e3)).displacement[2])
            within = 0.05 if expected == 23.9 else 0.006  # of the last digit
            name = f"u_z, {what}, F_a = {thrust} kN"
            yield Check(name, _SOURCE, expected, got, within, "absolute", "μm")


def _stiffness(blade: SlewingBearing) -> Iterator[Check]:
    """Stiffness of the blade bearing where ch. 4.4 states that of flexible rings."""
    axial = blade.equilibrium((0, 0, 94e3))
    turned = blade.equilibrium((0, 0, 0), (420.8e3, 0))
    degree = math.radians(1) / 1e3
    for name, expected, got, within, unit in (
        ("S_z, secant", 8873, axial.secant_stiffness[2, 2] / 1e6, 1e-4, "kN/mm"),
        ("S_z, tangent", 13_423, axial.stiffness[2, 2] / 1e6, 1e-4, "kN/mm"),
        ("S_k, secant", 142_600, turned.secant_stiffness[3, 3] * degree, 5e-4, "kN m/°"),
        ("S_k, tangent", 220_800, turned.stiffness[3, 3] * degree, 5e-4, "kN m/°"),
    ):
        yield Check(name, _SOURCE, expected, float(got), within, unit=unit)


def _forces(blade: SlewingBearing) -> Iterator[Check]:
    """Hardest loaded ball under single loads and under those of Table 3.1 and 4.2."""
    thrust = blade.equilibrium((0, 0, 2e6))
    radial = blade.equilibrium((5e5, 0, 0))
    rows = [
        ("F_k, F_a = 2000 kN", 10_436.2, thrust.maximum_force, 1e-5, "N"),
        ("u_z, F_a = 2000 kN", 77.4, 1e6 * thrust.displacement[2], 7e-4, "μm"),
        ("F_k, F_r = 500 kN", 5590, radial.maximum_force, _WITHIN, "N"),
        ("u_x, F_r = 500 kN", 51.46, 1e6 * radial.displacement[0], _WITHIN, "μm"),
    ]
    for apart, expected in ((0, 6130), (50, 6353), (60, 6396), (70, 6438)):
        rows_apart = replace(blade, row_spacing=apart * 1e-3)
        got = rows_apart.equilibrium((0, 0, 0), (0, -5e5)).maximum_force
        rows.append((f"F_k, M_k = 500 kN m, L_A = {apart} mm", expected, got, _WITHIN, "N"))
    for apart, expected in ((0, 29_569), (60, 30_623)):
        got = coacting(replace(blade, row_spacing=apart * 1e-3), 5e5, 5e5, 2e6).maximum_force
        rows.append((f"F_k, Table 3.1, co-acting, L_A = {apart} mm", expected, got, _WITHIN, "N"))
    for case, (force, equivalent) in enumerate(((6850, 707_915), (13_322, 1_389_480)), start=1):
        found = coacting(replace(blade, row_spacing=0.06), *SPECTRUM[case - 1, :3])
        name = f"case {case}, co-acting, L_A = 60 mm"
        rows.append((f"F_k,max, {name}", force, found.maximum_force, _WITHIN, "N"))
        rows.append((f"P_ea, {name}", equivalent, found.equivalent_load, _WITHIN, "N"))
    for name, number, got, within, unit in rows:
        yield Check(name, _SOURCE, number, float(got), within, unit=unit)
    # counter-acting loads of Table 3.10, balls counted from +y: where a second contact begins
    drive = replace(DRIVE, contact_stiffness=1.152e6 * MM15)
    mixed = drive.equilibrium((0, -6500, 8000), (2000, 0), element_angle=math.pi / 2)
    begins = float(mixed.ball_forces[0, 1, 14])
    yield Check("second contact of ball 15", _SOURCE, 49, begins, 0.5, "absolute", "N")


def _orientations(blade: SlewingBearing) -> Iterator[Check]:
    """Sum of the ball forces of the friction tests, F_r along, against and across M_k."""
    for way, sums in (
        ("co-acting", (2_245_029, 2_696_338, 4_978_880)),
        ("counter-acting", (2_902_602, 3_663_845, 5_165_128)),
        ("about the line of F_r", (2_616_583, 3_314_762, 5_053_910)),
    ):
        for case, (expected, row) in enumerate(zip(sums, FRICTION_TESTS), start=1):
            radial, axial, turn, _ = row
            moment = {"co-acting": (0, -turn), "counter-acting": (0, turn)}.get(way, (turn, 0))
            got = float(blade.equilibrium((radial, 0, axial), moment).force_sum)
            yield Check(f"ΣF_k, case {case}, M_k {way}", _SOURCE, expected, got, _WITHIN, unit="N")
