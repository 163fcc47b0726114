"""Closed orbits: periods that the direct solution and marching take, and what each costs.

``python -m benchmarks.references.periodic`` prints one row for each load and law; a
minute on one core.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from benchmarks.common import arguments, timed
from loadflow.errors import SolverError
from loadflow.journal import GasMixture, JournalBearing, Lubricant, MassConserving, Reynolds

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OMEGA = 1.2
FILMS: dict[str, dict[str, Any]] = {
    "gas mixture": {"cavitation": GasMixture(5e4), "edge_pressure": 5e5},
    "mass conserving": {"cavitation": MassConserving(), "edge_pressure": 5e5},
    "Reynolds": {"cavitation": Reynolds()},
}


def pulsating(times_a_turn: int) -> tuple[np.ndarray, np.ndarray]:
    """One period of a load that pulses `times_a_turn` of the shaft: time and force."""
    time = np.linspace(0.0, 2 * np.pi / OMEGA / times_a_turn, 61)
    turn = 2 * np.pi * time / time[-1]
    return time, np.stack([2e6 + 5e5 * np.sin(turn), 4e5 * np.cos(turn)], axis=-1)


def closed(method: str, times_a_turn: int, film: dict[str, Any]) -> str:
    """Periods, largest ε and processor time of one closed orbit."""
    time, force = pulsating(times_a_turn)

    def orbit() -> str:
        try:
            found = BEARING.orbit(
                time, force, OMEGA, Lubricant(0.05), grid=(36, 8), periodic=method, **film
            )
        except SolverError:
            return "not closed after 100"
        return f"{found.attrs['periods']:3d}, ε {float(found.eccentricity_ratio.max()):.5f}"

    answer, seconds = timed(orbit)
    return f"{answer}, {seconds:.2f} s"


if __name__ == "__main__":
    arguments(__doc__).parse_args()
    closed("direct", 1, FILMS["gas mixture"])  # compiles
    for times_a_turn in (1, 10, 100):
        for name, film in FILMS.items():
            answers = (closed(method, times_a_turn, film) for method in ("direct", "marching"))
            print(f"{times_a_turn:3d}p  {name:16s}", *(f"{answer:36s}" for answer in answers))
