"""Numbers of [Ritzer 2018] that cannot hold: each beside what the source's own data give instead.

A refused row is in order as long as the contradiction stands, that is outside its tolerance. Not
shown, because no number is printed: the computing time; the direction of the factor 1.172 on f_cm
for an osculation above 0.08 (`capacity.slewing_capacity` refuses it); the curve of f_H below and
above 55 HRC, damping and stiffness of the springs between balls.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

from loadflow.rolling import RingSections, axial_expansion, friction
from loadflow.validation._slewing_cases import BLADE, FOUR_BALL, FRICTION_TESTS, RINGS
from loadflow.validation.check import Check, evidence

# Appendix B; its height is that of one row, both together carry the load of Fig. 2.9
APPENDIX_B = RingSections(
    outer_outside=2.100, outer_inside=1.902, inner_outside=1.888, inner_inside=1.700, height=0.100
)
ONE_ROW = 500e3 / 129  # Appendix B: axial load for each ball, N


@evidence("print of the source")
def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _expansion()
    yield from _appendix_b()
    yield from _angle()
    yield from _friction()


def _refused(
    name: str, source: str, printed: float, got: float, allowed: float, why: str, **more: Any
) -> Check:
    """A printed number, what the source's own data give instead, and why they differ."""
    return Check(name, source, printed, got, allowed, refused=why, **more)


def _expansion() -> Iterator[Check]:
    """Deflection of the blade bearing under 3000 kN."""
    grown = axial_expansion(BLADE, 3e6, APPENDIX_B)
    yield _refused(
        "u_z at 3000 kN, both rings",
        "Fig. 2.9",
        0.35,
        float(grown.displacement) * 1e3,
        0.02,
        "more than (2.13), (2.17) give with App. B",
        unit="mm",
    )
    free, nominal = BLADE.groove_distance, BLADE.contact_angle
    approach = (3e6 / (BLADE.balls * BLADE.rows) / BLADE.series_stiffness) ** (2 / 3)
    most = (free * (1 - math.sin(nominal)) + approach) * 1e3
    for sign, printed in (("+", 0.38), ("-", 0.6)):
        yield _refused(
            f"|u_z| at {sign}3000 kN, test",
            "ch. 2.4.2",
            printed,
            most,
            0.02,
            "beyond α = 90°, where balls leave their grooves: the rig gives way too",
            unit="mm",
            evidence="measured elsewhere",
        )
    rigid = float(FOUR_BALL.equilibrium((0, 0, 5e3)).displacement[2]) * 1e3
    yield _refused(
        "u_z, four balls, 5 kN, flexible ring",
        "Table 3.5",
        0.020,
        rigid,
        0.05,
        "less than rigid rings give",
        unit="mm",
    )


def _appendix_b() -> Iterator[Check]:
    """Hertz and kinematics of the worksheet in Appendix B."""
    force = ONE_ROW / math.sin(math.radians(48.41))
    for side, coefficient, pressure in zip(RINGS, (0.745, 0.755), (1576, 1571)):
        contact = BLADE.raceway_contact(side, force)
        yield _refused(
            f"ψ/ξ, {side}",
            "App. B",
            coefficient,
            float(contact.coefficient),
            0.1,
            "belongs to cos τ of 0.85, not to the 0.95 beside it",
        )
        yield _refused(
            f"p_max, rigid, {side}",
            "App. B",
            pressure,
            float(contact.pressure) / 1e6,
            0.1,
            "built on the wrong ξ η",
            unit="MPa",
        )
    free, nominal = BLADE.groove_distance * 1e3, BLADE.contact_angle
    angle = math.degrees(math.atan2(free * math.sin(nominal) + 0.0491, free * math.cos(nominal)))
    yield _refused(
        "α, rigid rings",
        "App. B",
        48.41,
        angle,
        0.5,
        "not the angle of the 0.0491 mm printed beside it",
        kind="absolute",
        unit="°",
    )
    for ring, printed, degrees in (
        ("outer", 0.1383, 49.95),
        ("inner", 0.1104, 49.08),
        ("both", 0.1902, 51.33),
    ):
        sin = math.sin(math.radians(degrees))
        approach = (ONE_ROW / sin / BLADE.series_stiffness) ** (2 / 3) * 1e3
        shift = (free + approach) * sin - free * math.sin(nominal)
        yield _refused(
            f"u_z, flexible: {ring}",
            "App. B",
            printed,
            shift,
            0.1,
            f"not the shift that belongs to the α = {degrees}° beside it",
            unit="mm",
        )


def _angle() -> Iterator[Check]:
    """Contact angle beside the expansion printed with it."""
    force = 2e6 / (BLADE.balls * BLADE.rows * math.sin(math.radians(52.5)))
    reach = BLADE.groove_distance + (force / BLADE.series_stiffness) ** (2 / 3)
    nominal = BLADE.groove_distance * math.cos(BLADE.contact_angle)
    grown = (nominal - reach * math.cos(math.radians(52.5))) * 1e3
    yield _refused(
        "Δr_A + Δr_I at α = 52.5°, 2000 kN",
        "ch. 3.3, 3.4",
        0.143,
        grown,
        0.1,
        "more than closes the triangle of the groove centres",
        unit="mm",
    )


def _friction() -> Iterator[Check]:
    """Computed torques that their formula does not give, and measured ones that none gives."""
    radial, axial, tilt, measured = FRICTION_TESTS.T
    by_load = friction.friction_torque_loads(axial, radial, tilt, 1.9, idle=8000)
    by_force = friction.friction_torque_forces([2_202_502, 2_703_230, 4_981_978], 1.9, idle=8000)
    for case, printed in ((2, 24_000), (3, 21_000)):
        yield _refused(
            f"M_R, case {case}, old model",
            "Table 2.5, 4.12",
            printed,
            float(by_load[case - 1]),
            0.05,
            "not what (2.26) gives",
            unit="N m",
        )
    for model, torques in (("(2.26)", by_load), ("(2.37)", by_force)):
        for case, (printed, got) in enumerate(zip(measured, torques), start=1):
            yield _refused(
                f"M_R, case {case}, test",
                f"Table 4.12, by {model}",
                printed,
                float(got),
                0.2,
                "no formula of the source comes near its tests",
                unit="N m",
                evidence="measured elsewhere",
            )
