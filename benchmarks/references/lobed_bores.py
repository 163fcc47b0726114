"""Fixed lobes and arcs on the rung "reduced" against the grid of as many cells: error and time.

    python -m benchmarks.references.lobed_bores [DRAWS]

Draws: 1 to 4 lobes of preload 0 to 0.7 or an arc of 70 to 290°, B/D 0.2 to 1.5, So 0.03 to 20, both
senses of rotation, four laws; at rest. Then an orbit of a lemon bore by both rungs.
"""

from __future__ import annotations

import math
import warnings
from typing import Any

import numpy as np

from benchmarks.common import arguments, head, row, timed
from loadflow.errors import ValidityWarning
from loadflow.journal import (
    Arc,
    GasMixture,
    Guembel,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    Reynolds,
)

EDGE = 1e5
LAWS = (GasMixture(5e4), Guembel(EDGE), Reynolds(EDGE), MassConserving(5e4))
ANSWERS = ("minimum_film", "maximum_pressure", "friction_power")
SHARES = (50, 95, 100)


def drawn(random: np.random.Generator, law: Any) -> tuple[JournalBearing, Any, float, Any]:
    """A bearing, its load, N, its speed, rad/s, and the film, of which the rung is open."""
    shape: Lobes | Arc
    if random.random() < 0.7:
        count = int(random.integers(1, 5))
        groove = random.uniform(0.05, 0.5) * min(1.0, 4.0 / count)
        preload, angle, offset = random.uniform([0.0, 0.0, 0.2], [0.7, 6.0, 0.9]).tolist()
        shape, way = Lobes(count, preload, groove, angle, offset), random.uniform(0.0, 2 * np.pi)
    else:
        shape = Arc(angle=random.uniform(-0.4, 0.4), span=random.uniform(1.2, 5.0))
        way = random.uniform(-0.3, 0.3)
    diameter, clearance = (10 ** random.uniform([-1.0, -3.3], [0.5, -2.7])).tolist()
    width = diameter * random.uniform(0.2, 1.5)
    viscosity, speed, number = (10 ** random.uniform([-2, -0.5, -1.5], [-0.5, 1.5, 1.3])).tolist()
    size = number * viscosity * speed / clearance**2 * diameter * width
    bearing = JournalBearing(diameter, width, clearance, shape)
    film = {"lubricant": Lubricant(viscosity), "cavitation": law, "edge_pressure": EDGE}
    load = size * math.cos(way), size * math.sin(way)
    return bearing, load, speed * random.choice([-1.0, 1.0]), film


def at_rest(draws: int) -> None:
    """Print how far both rungs are from each other, and how many have no answer."""
    random, away, lost = np.random.default_rng(3), [], {"reduced": 0, "grid": 0}
    for k in range(draws):
        bearing, load, speed, film = drawn(random, LAWS[k % len(LAWS)])
        states = {
            rung: bearing.equilibrium(
                load, speed, **film, inlet=None, grid=(120, 24), rung=rung, strict=False
            )
            for rung in lost
        }
        for rung, state in states.items():
            lost[rung] += not state.converged
        if all(state.converged for state in states.values()):
            ours, theirs = states.values()
            away.append([abs(getattr(ours, q) / getattr(theirs, q) - 1.0) for q in ANSWERS])
    print(f"{draws} draws; without an answer: {lost}")
    print(head("away from the grid, per cent", *(f"{share} % of draws" for share in SHARES)))
    for name, values in zip(ANSWERS, np.percentile(away, SHARES, axis=0).T):
        print(row(name, *(f"{100 * value:.2f}" for value in values)))


def in_motion(steps: int = 2000) -> None:
    """Print time and extremes of an orbit of a lemon bore."""
    shape = Lobes(count=2, preload=0.3, groove=0.35)
    bearing, time = JournalBearing(1.4, 1.3, 0.85e-3, shape), np.arange(steps) * 0.05
    force = np.stack([1.2e6 + 4e5 * np.sin(3 * time), 3e5 * np.cos(2.3 * time)], axis=1)
    print(head("orbit of a lemon bore", "ms a step", "h_min, µm", "p_max, MPa", "friction, W"))
    for rung, grid in (
        ("grid", (60, 20)),
        ("grid", (120, 40)),
        ("reduced", (60, 20)),
        ("reduced", (120, 40)),
    ):
        film = {"cavitation": GasMixture(5e4), "edge_pressure": EDGE, "grid": grid, "rung": rung}
        bearing.orbit(time[:5], force[:5], 1.2, Lubricant(0.1), **film)
        path, seconds = timed(lambda f=film: bearing.orbit(time, force, 1.2, Lubricant(0.1), **f))
        print(
            row(
                f"{rung}, {grid[0]} × {grid[1]}",
                f"{1e3 * seconds / steps:.3f}",
                f"{1e6 * float(path.minimum_film.min()):.2f}",
                f"{1e-6 * float(path.maximum_pressure.max()):.3f}",
                f"{float(path.friction_power.mean()):.1f}",
            )
        )


def main() -> None:
    """Measure."""
    parser = arguments(__doc__)
    parser.add_argument("draws", type=int, nargs="?", default=300, help="Bearings at rest.")
    warnings.simplefilter("ignore", ValidityWarning)
    at_rest(parser.parse_args().draws)
    in_motion()


if __name__ == "__main__":
    main()
