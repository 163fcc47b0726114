"""Speed and error of the rung "map" and of the historical rungs, beside grid and sparse reference.

    python -m benchmarks.peers.journal_map [sparse steps]

Same transient gas-mixture step on 60 × 20 cells as in ``journal.py``. What the table costs is
reported apart; it is kept for every series of the same film. The reference is timed on the first
steps of the series, the map on 24,000 of them, in processor time of one thread.
"""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np

from benchmarks.common import arguments, timed
from benchmarks.peers.journal import OMEGA, STEP, SparseFilm
from loadflow.journal import Film, Guembel, Reynolds
from loadflow.journal.models import _mobility_kernels as kernel
from loadflow.journal.models import mobility
from loadflow.journal.models.mobility_films import POWERS, Found, MovingFilm, approach
from loadflow.validation.journal import PERIODIC_LOADS, reference_bearing, sines

HISTORICAL = {"map": None, "holland": Reynolds(), "butenschoen": Reynolds(), "hahn": Guembel()}
"""Rungs that are compared, and the law of each that knows one; the map takes that of the film."""


def held_out(
    table: mobility.MobilityMap, width_ratio: float, options: Film, points: np.ndarray
) -> np.ndarray:
    """Relative error (n,) of the velocity at `points` (n, 3): ε, angle from it to the load, s.

    The film is solved at each point, so that points between the nodes show what the map costs;
    NaN where the film has no solution.
    """
    film = MovingFilm(width_ratio, options)
    errors = []
    for ratio, angle, size in points.tolist():
        chi = kernel.direction(1.0 - ratio, math.cos(angle), math.sin(angle))
        raw = np.empty(2)
        kernel.interpolate(table.motion, table.axes, 1.0 - ratio, chi, size, raw)
        got = size * np.sinh(raw) * (1.0 - ratio) ** POWERS
        begin = Found(film.film.start(), size * np.array([math.cos(chi), math.sin(chi)]))
        found = approach(film, (0.0, size), (0.0, size), chi, begin)
        found = found and approach(film, (0.0, size), (ratio, size), chi, found, 5)
        exact = found.velocity if found else np.full(2, np.nan)
        errors.append(math.hypot(*(got - exact)) / math.hypot(*exact))
    return np.array(errors)


def misses_of(film: dict[str, Any]) -> np.ndarray:
    """Error of the velocity of the map at 200 random points."""
    options = Film(grading="graded", **film)
    plain, _ = mobility.scaled(options)
    table = mobility.tabulate(0.75, plain, 1.0)
    rng = np.random.default_rng(3)
    points = rng.uniform((0.0, 0.0, 0.05), (0.95, np.pi / 2, 0.9), (200, 3))
    return held_out(table, 0.75, plain, points)


def main(steps: int) -> None:
    bearing, film = reference_bearing()
    long = np.arange(24_001) * STEP
    force = np.stack([sines(x, long) for x in PERIODIC_LOADS[0][:2]], axis=-1)
    few = slice(0, 401)
    grid, grid_time = timed(lambda: bearing.orbit(long[few], force[few], OMEGA, **film))
    start = grid.eccentricity.values[0] / bearing.clearance
    _, plain = SparseFilm().orbit(force[: steps + 1], start)
    _, table = timed(lambda: bearing.orbit(long[few], force[few], OMEGA, rung="map", **film))
    _, quick = timed(lambda: bearing.orbit(long, force, OMEGA, rung="map", **film))
    _, static = timed(lambda: bearing.equilibrium(force[:2000], OMEGA, rung="map", **film))
    errors, of_law = {}, {None: float(grid.eccentricity_ratio.max())}
    for rung, law in HISTORICAL.items():
        # each knows the film of one law at ambient pressure, and is held against the grid's of it
        own = film if law is None else {"lubricant": film["lubricant"], "cavitation": law}
        asked = (long[few], force[few], OMEGA)
        if law not in of_law:
            of_law[law] = float(bearing.orbit(*asked, **own).eccentricity_ratio.max())
        orbit = bearing.orbit(*asked, rung=rung, **own)
        errors[rung] = float(orbit.eccentricity_ratio.max()) / of_law[law] - 1
    misses = misses_of(film)
    result = {
        "sparse_ms_per_step": 1e3 * plain / steps,
        "grid_ms_per_step": 1e3 * grid_time / 400,
        "map_us_per_step": 1e6 * quick / 24_000,
        "map_speed_over_sparse": plain / steps / (quick / 24_000),
        "map_table_and_first_call_s": table,
        "map_static_us_per_load": 1e6 * static / 2000,
        "error_of_E_max_against_grid": errors,
        "map_held_out_error": {
            "median": float(np.nanmedian(misses)),
            "90 % below": float(np.nanquantile(misses, 0.9)),
            "no solution": int(np.isnan(misses).sum()),
        },
    }
    print(json.dumps(result, indent=2))


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("steps", type=int, nargs="?", default=40, help="of the sparse reference")
    main(parser.parse_args().steps)
