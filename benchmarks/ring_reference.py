"""Answers of the full model: solid rings, every ring mode and ball centre an unknown.

python benchmarks/ring_reference.py

Prints what `loadflow.validation.rings` holds as `SOLID` and `SOLID_FOUR`; minutes, most of them for
the sparse factors of four solid rings.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

import numpy as np

from loadflow.rolling import (
    CompliantRing,
    FlexibleRings,
    SlewingBearing,
    SolidRing,
    patch_points,
    reference_equilibrium,
)
from loadflow.validation._slewing_cases import DRIVE, FOUR_BALL
from loadflow.validation.rings import SOLID, SOLID_FOUR, drive_rings, four_ball_rings


def main() -> None:
    solve(replace(DRIVE, curvature="exact"), drive_rings(), 45, 2, SOLID)
    axial = [(0.0, 0.0, load, 0.0, 0.0) for load in SOLID_FOUR]
    solve(FOUR_BALL, four_ball_rings(), 48, 3, axial)


def solve(
    bearing: SlewingBearing,
    rings: FlexibleRings,
    around: int,
    across: int,
    loads: Iterable[tuple[float, ...]],
) -> None:
    azimuth, scale = bearing.contacts().azimuth, bearing.contacts().scale
    parts = {}
    for name in ("inner", "outer"):
        thin = getattr(rings, name)
        ring = SolidRing(
            profile=thin.profile, held=thin.held, bed=thin.bed, grip=thin.grip,
            around=around, across=across,
        )  # fmt: skip
        factor = ring.flexibility(patch_points(bearing, name, azimuth))
        factor = factor.reshape(-1, factor.shape[-1])
        parts[name] = CompliantRing(factor @ factor.T)  # condensed once for all loads
    for load in loads:
        state = reference_equilibrium(bearing, FlexibleRings(**parts), load[:3], load[3:])
        size = np.linalg.norm(state.displacement / scale)
        print(f"    {load}: ({size:.6g}, {state.forces.max():.8g}),")


if __name__ == "__main__":
    main()
