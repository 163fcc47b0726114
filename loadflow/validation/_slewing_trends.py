"""Trends and bounds of [Ritzer 2018], as ratios that must stay below 1; rigid rings.

The laws behind them are tested over many loads in ``tests/rolling/test_slewing_trends.py``; trends
that need flexible rings are in the table ``rings``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from loadflow.validation._slewing_cases import BLADE, DRIVE, FOUR_BALL, coacting
from loadflow.validation.check import Check, evidence


@evidence("print of the source")
def checks() -> Iterator[Check]:
    """Yield all rows."""
    yield from _stiffer_than_printed()
    yield from _zones()
    tilted = replace(BLADE, row_spacing=0.06)
    singles = tilted.equilibrium(
        force=[(0, 0, 5e5), (5e5, 0, 0), (0, 0, 0)], moment=[(0, 0), (0, 0), (0, -2e6)]
    )
    together = float(coacting(tilted, 5e5, 5e5, 2e6).maximum_force)
    yield _below(
        "F_k, loads together over their sum one by one",
        "ch. 3.3: 32.7/36.5",
        together / singles.maximum_force.sum(),
    )
    loads = np.array([1e3, 2e3, 5e3, 1e4, 2e4, 5e4])
    stiffness = DRIVE.equilibrium(force=loads[:, None] * [1, 0, 0]).stiffness[:, 0, 0]
    yield _below(
        "radial stiffness, 45 balls, over that at the next load",
        "ch. 3.8",
        stiffness[:-1] / stiffness[1:],
    )


def _below(name: str, source: str, ratios: ArrayLike) -> Check:
    """A trend: the largest of the ratios is below 1."""
    return Check(f"{name}, < 1", source, 1.0, float(np.max(ratios)), 0.0, "below")


def _stiffer_than_printed() -> Iterator[Check]:
    """Rigid rings give way less than any printed with flexible ones."""
    table = ((5, 15, 20, 50, 100), (8, 18, 23, 45, 73), (10, 21, 28, 51, 82))
    thrust, mbs, test = np.array(table) * [[1e3], [1e-6], [1e-6]]
    shift = DRIVE.equilibrium(force=thrust[:, None] * [0, 0, 1]).displacement[:, 2]
    yield _below("u_z, 45 balls, rigid over flexible rings", "Table 3.13", shift / mbs)
    yield _below("u_z, 45 balls, rigid rings over test", "Table 3.13", shift / test)
    thrust = np.array([10e3, 20e3, 30e3, 40e3, 50e3])
    printed = np.array([45e-6, 75e-6, 105e-6, 128e-6, 148e-6])
    shift = FOUR_BALL.equilibrium(force=thrust[:, None] * [0, 0, 1]).displacement[:, 2]
    yield _below("u_z, four balls, rigid over flexible rings", "Table 3.5", shift / printed)
    axial = BLADE.equilibrium(force=(0, 0, 94e3)).secant_stiffness[2, 2]
    yield _below("S_z, flexible over rigid rings, secant", "ch. 4.4", 5000e6 / axial)
    tilt = BLADE.equilibrium(force=(0, 0, 0), moment=(420.8e3, 0)).secant_stiffness[3, 3]
    per_degree = math.radians(1) * tilt
    yield _below("S_k, flexible over rigid rings, secant", "ch. 4.4", 76_900e3 / per_degree)


def _zones() -> Iterator[Check]:
    """Which balls carry load."""
    play, none, preload = (
        replace(BLADE, clearance=gap).equilibrium(force=(2e5, 0, 0)) for gap in (1e-4, 0, -1e-4)
    )
    loaded = [int((result.ball_forces > 0).sum()) for result in (play, none, preload)]
    yield _below(
        "loaded contacts at G = 0.1, 0, -0.1 mm, over the next",
        "Fig. 2.18",
        [loaded[0] / loaded[1], loaded[1] / loaded[2]],
    )
    idle = replace(BLADE, clearance=-1e-4).equilibrium(force=(0, 0, 0)).maximum_force
    yield _below(
        "what load adds to the preload of G = -0.1 mm",
        "Fig. 2.18",
        preload.maximum_force / idle - 1,
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
    )
    axis = np.abs(np.sin(tilt.contacts.azimuth)) < 0.05
    yield _below(
        "F_k beside the tilt axis over the largest",
        "ch. 3.3",
        10 * tilt.ball_forces[..., axis].max() / tilt.maximum_force,
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
