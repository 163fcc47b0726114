"""Time of a static point with K and C beside the linear algebra that it needs, and its error.

python -m benchmarks.peers.newton_step [--repeats N]

One run measures both in turn, and takes the least time of each: what a Newton step needs is one
`dgbtrf` of the band and three right-hand sides (the film and its derivatives by both displacements)
by `dgbtrs`. The error of ε, h_min, K and C (over their largest entry) is against 240 × 80 cells.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np
from scipy.linalg.lapack import dgbtrf, dgbtrs

from benchmarks.common import arguments
from loadflow.journal import Film, GasMixture, JournalBearing, Lubricant, Reynolds
from loadflow.journal.line import Line
from loadflow.journal.results import Equilibrium
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.convergence import Limits
from loadflow.quantities import percent

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
FORCE, SPEED = np.array([2.0586e6, 0.4428e6]), 1.2451
LAWS = {
    "gas mixture": Film(Lubricant(0.05), GasMixture(0.05e6), 0.5e6, None),
    "Reynolds": Film(Lubricant(0.05), Reynolds(), 0.0, None),
}
FINEST = (240, 80)
RIGHT_HAND_SIDES = 3
LIMITS = Limits(1e-10, 60, True)


def with_grid(film: Film, grid: tuple[int, int]) -> Film:
    """The film on another grid."""
    return Film(film.liquid, film.law, film.edge_pressure, None, grid=grid)


def algebra(film: Film, steps: int) -> Callable[[], None]:
    """The linear algebra of so many Newton steps, at the matrix of the last."""
    statics = Statics(BEARING, film, Line.of(()), SPEED)
    statics.resolve(0, FORCE, SPEED, None, LIMITS)
    discrete = statics.film
    still, gap, band = np.zeros(2), discrete.gap, discrete.mesh.bandwidth
    growth = discrete.storage(gap.coefs[:1], gap.around[None], still, 0.0)
    discrete._assemble(growth[0], 0.0)
    matrix = np.ascontiguousarray(discrete.ab[:, : 3 * band + 1])  # as narrow as LAPACK needs it
    work = matrix.copy()
    columns = np.random.default_rng(1).random((RIGHT_HAND_SIDES, work.shape[0]))

    def run() -> None:
        for _ in range(steps):
            work[:] = matrix
            lu, pivots, _ = dgbtrf(work.T, band, band, overwrite_ab=1)
            dgbtrs(lu, band, band, columns.T, pivots, overwrite_b=1)

    return run


def least(work: dict[str, Callable[[], object]], repeats: int) -> dict[str, float]:
    """Least processor time of each, s, taken in turn."""
    times: dict[str, list[float]] = {name: [] for name in work}
    for _ in range(repeats):
        for name, run in work.items():
            begin = time.process_time()
            run()
            times[name].append(time.process_time() - begin)
    return {name: min(some) for name, some in times.items()}


def off(state: Equilibrium, fine: Equilibrium, name: str) -> float:
    """Largest difference of a result over its largest entry."""
    one, other = np.asarray(getattr(state, name)), np.asarray(getattr(fine, name))
    return float(np.abs(one - other).max() / np.abs(other).max())


def main() -> None:
    """Measure and print the rows of the table."""
    parser = arguments(__doc__)
    parser.add_argument("--repeats", type=int, default=100)
    repeats = parser.parse_args().repeats
    print("| law | cells | steps | point | algebra | ratio | ε off by | h_min | K | C |")
    print("|---|---|---:|---:|---:|---:|---:|---:|---:|---:|")
    for law, film in LAWS.items():
        fine = BEARING.equilibrium(FORCE, SPEED, with_grid(film, FINEST))
        for grid in ((40, 16), (60, 20), (120, 40)):
            one = with_grid(film, grid)
            state = BEARING.equilibrium(FORCE, SPEED, one)
            steps = int(state.iterations)
            spent = least(
                {
                    "point": lambda one=one: BEARING.equilibrium(FORCE, SPEED, one),
                    "algebra": algebra(one, steps),
                },
                repeats,
            )
            ratio = spent["point"] / spent["algebra"]
            errors = [
                percent(off(state, fine, name))
                for name in ("eccentricity_ratio", "minimum_film", "stiffness", "damping")
            ]
            print(
                f"| {law} | {grid[0]} × {grid[1]} | {steps} | {1e3 * spent['point']:.2f} ms | "
                f"{1e3 * spent['algebra']:.2f} ms | {ratio:.2f} | {' | '.join(errors)} |"
            )


if __name__ == "__main__":
    main()
