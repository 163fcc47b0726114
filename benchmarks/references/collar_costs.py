"""What motion, heat and tilt of a thrust collar cost: processor time of its table and its samples.

python -m benchmarks.references.collar_costs

The collar of the main job, 2,000 samples at rest or 24,000 steps in motion; the table once.
"""

from __future__ import annotations

from functools import partial
from itertools import product

import numpy as np

from benchmarks.common import ROOT, arguments, timed
from loadflow.planning.effects import switched
from loadflow.scene import read_scene
from loadflow.stages.effects.thrust import HEAT

STEPS, KEPT = 24_000, 2_000


def loads(count: int) -> tuple[np.ndarray, ...]:
    """Forces, N, speeds, rad/s, tilts, rad, and times, s, that wander as those of a load case."""
    time = 0.025 * np.arange(STEPS)
    slow, passing = np.sin(0.06 * time), np.sin(2.0 * np.pi * 0.6 * time)
    force = np.outer(5e5 + 2e5 * slow + 5e4 * passing, (0.0, 0.0, 1.0))
    speed = 1.1 + 0.1 * np.sin(0.05 * time)
    tilt = 1e-5 * np.column_stack([passing, 1.0 + 0.3 * slow])
    some = np.linspace(0, STEPS - 1, count).astype(int)
    return force[some], speed[some], tilt[some], time[some]


def main() -> None:
    """Print seconds of the table, and of each sample or step beside it."""
    arguments(__doc__).parse_args()
    cold = read_scene(ROOT / "pipelines" / "dlc_1_1.toml")
    warm = switched(cold, HEAT, True)
    assert warm is not None
    print(f"{'heat':>6} {'tilt':>6} {'motion':>6} {'table, s':>9} {'each, µs':>9}")
    for number, (heat, tilts, moves) in enumerate(product((False, True), repeat=3)):
        [part] = (warm if heat else cold).thrust.collars.values()
        force, speed, tilt, time = loads(STEPS if moves else KEPT)
        given = force, speed, tilt if tilts else None, time if moves else None
        part.by_curve(*given)  # compiles
        fresh = part.with_clearance(1e-12 * (1 + number))  # tables are remembered
        solve = partial(fresh.by_curve, *given)
        first, again = timed(solve)[1], timed(solve)[1]
        each = 1e6 * again / speed.size
        print(f"{heat!s:>6} {tilts!s:>6} {moves!s:>6} {first - again:9.2f} {each:9.2f}", flush=True)


if __name__ == "__main__":
    main()
