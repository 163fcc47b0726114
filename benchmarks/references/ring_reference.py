"""Answers with every ring mode and ball centre an unknown, nothing condensed.

python -m benchmarks.references.ring_reference

Prints what `loadflow.validation.rings` holds as `UNCONDENSED`, and errors of the condensed solver.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from benchmarks.common import arguments
from benchmarks.references.whole_rings import reference_equilibrium
from loadflow.validation._slewing_cases import DRIVE
from loadflow.validation.rings import UNCONDENSED, drive_rings


def main() -> None:
    bearing, rings = replace(DRIVE, curvature="exact"), drive_rings()
    scale = bearing.contacts().scale
    for load in UNCONDENSED:
        state = reference_equilibrium(bearing, rings, load[:3], load[3:])
        ours = bearing.equilibrium(load[:3], load[3:], rings=rings)
        size, force = np.linalg.norm(state.displacement / scale), state.forces.max()
        print(
            f"{load}: ({size:.6g}, {force:.8g}), condensed "
            f"{np.linalg.norm(ours.displacement / scale) / size - 1:+.2%}, "
            f"{float(ours.maximum_force) / force - 1:+.2%}"
        )


if __name__ == "__main__":
    arguments(__doc__).parse_args()
    main()
