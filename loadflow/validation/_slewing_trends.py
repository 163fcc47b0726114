"""Which balls of [Ritzer 2018] carry load, and how the stiffness grows; rigid rings.

What has no number (rigid rings give way less, the zone shrinks with clearance) is a law and no row:
``tests/rolling/test_slewing_trends.py`` holds it over many loads.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from loadflow.validation._slewing_cases import BLADE, DRIVE, coacting
from loadflow.validation.check import Check, evidence

_NEAR = 8  # balls from the axis of the moment, where the first one stands


@evidence("print of the source")
def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _zones()
    tilted = replace(BLADE, row_spacing=0.06)
    singles = tilted.equilibrium(
        force=[(0, 0, 5e5), (5e5, 0, 0), (0, 0, 0)], moment=[(0, 0), (0, 0), (0, -2e6)]
    )
    together = float(coacting(tilted, 5e5, 5e5, 2e6).maximum_force)
    yield Check(
        "F_k, loads together over their sum one by one",
        "ch. 3.3, assuming rigid rings, G = 0, L_A = 60 mm",
        32.7 / 36.5,
        together / float(singles.maximum_force.sum()),
        0.05,
    )
    stiffness = DRIVE.equilibrium(force=[(1e3, 0, 0), (2e3, 0, 0)]).stiffness[:, 0, 0]
    yield Check(
        "radial stiffness, 45 balls, at 2 kN over that at 1 kN",
        "ch. 3.8; Hertz, F^(1/3)",
        2 ** (1 / 3),
        float(stiffness[1] / stiffness[0]),
        0.02,  # the contact angle turns with the load
        evidence="closed form",
    )


def _zones() -> Iterator[Check]:
    """Which balls carry load."""
    for gap, expected in ((0.0, 0.5), (-1e-4, 1.0)):
        zone = replace(BLADE, clearance=gap).equilibrium(force=(2e5, 0, 0)).ball_forces > 0
        yield Check(
            f"share of balls that a diagonal loads under F_r, G = {1e3 * gap:g} mm",
            "Fig. 2.18",
            expected,
            float(zone.mean()),
            1 / BLADE.balls,
            "absolute",
            evidence="closed form",
        )
    tilt = BLADE.equilibrium(force=(0, 0, 0), moment=(5e5, 0))
    share = (tilt.ball_forces > 0).sum(axis=-1) / BLADE.balls
    yield Check(
        "share of balls that a diagonal loads under M_k",
        "ch. 3.3",
        0.5,
        float(share.mean()),
        1 / BLADE.balls,
        "absolute",
        evidence="closed form",
    )
    near = tilt.ball_forces[..., _NEAR].max() / tilt.maximum_force
    yield Check(
        "F_k 22° from the tilt axis over the largest",
        "ch. 3.3; Hertz, sin^1.5",
        math.sin(2 * math.pi * _NEAR / BLADE.balls) ** 1.5,
        float(near),
        0.02,  # the contact angle turns with the load
        evidence="closed form",
    )
    radial = BLADE.equilibrium(force=(5e5, 0, 0)).ball_forces
    yield Check(
        "F_k of one diagonal over the other, F_r alone",
        "ch. 2.6",
        1.0,
        float(radial[:, 0].max() / radial[:, 1].max()),
        1e-6,
        evidence="consistency",  # by symmetry
    )
    # counter-acting loads; balls counted from +y, where the first one stands
    mixed = DRIVE.equilibrium(force=(0, -6500, 8000), moment=(2000, 0), element_angle=math.pi / 2)
    four_point = 1 + np.flatnonzero(mixed.ball_forces[0].min(axis=0) > 0)
    source = "Table 3.14, assuming F_r and M_k counter-acting, rigid rings"
    yield Check("first ball in four-point contact", source, 15, float(four_point[0]), 0, "absolute")
    # printed symmetric about ball 23 though ball 1 stands on the axis: one ball either way
    yield Check("last ball in four-point contact", source, 31, float(four_point[-1]), 1, "absolute")
