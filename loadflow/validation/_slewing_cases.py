"""Bearings and loads of [Ritzer 2018] that its tables share."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from loadflow.rolling import RollingEquilibrium, SlewingBearing
from loadflow.rolling.raceways import Raceway

MM15 = 1e3**1.5  # N/mm^1.5 in N/m^1.5
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

# Table 4.2, 4.4, 4.6, 4.7, 4.9:
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


# Table 2.4: F_r, F_a (N), M_k (N m), measured torque (N m)
FRICTION_TESTS = np.array(
    [
        [250e3, 1000e3, 1000e3, 37_000],
        [500e3, 2000e3, 500e3, 44_000],
        [250e3, 500e3, 3000e3, 41_000],
    ]
)


def coacting(
    bearing: SlewingBearing, radial: ArrayLike, axial: ArrayLike, tilt: ArrayLike
) -> RollingEquilibrium[SlewingBearing]:
    """Equilibrium with radial force and moment loading the same balls as +F_a."""
    x, z, turn = (np.asarray(v, float) for v in (radial, axial, tilt))
    zero = np.zeros_like(x)
    return bearing.equilibrium(
        force=np.stack([x, zero, z], axis=-1), moment=np.stack([zero, -turn], axis=-1)
    )
