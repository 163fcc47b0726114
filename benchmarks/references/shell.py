"""Effect and cost of an elastic shell on the reference bearing.

``python -m benchmarks.references.shell``

At V = 24 m/s of Table 5-13. Time is processor time of an equilibrium, shell set up, over that of
the rigid one: the least of several runs in turn.
"""

from __future__ import annotations

from functools import partial

import numpy as np

from benchmarks.common import arguments, head, row, timed
from loadflow.journal import LocalShell, ThickShell
from loadflow.journal.shells import Shell
from loadflow.validation.journal import reference_bearing

LOAD, SPEED = (2.58426e6, -0.45968e6), 12.1 * 2 * np.pi / 60
SHELLS: dict[str, Shell | None] = {
    "rigid": None,
    "steel, wall 30 mm": ThickShell(3.06, 210e9),
    "steel, wall 300 mm": ThickShell(3.6, 210e9),
    "E = 2 GPa, wall 300 mm": ThickShell(3.6, 2e9),
    "E = 0.2 GPa, wall 300 mm": ThickShell(3.6, 2e8),
    "local, 1e-12 m/Pa": LocalShell(1e-12),
    "local, 1e-10 m/Pa": LocalShell(1e-10),
    "local, 5e-10 m/Pa": LocalShell(5e-10),
}
_LOADS = 20  # equilibria that are timed together
_REPEATS = 5


def main() -> None:
    """Print the table of docs/journal-shell.md."""
    bearing, film = reference_bearing()

    def solve(shell: Shell | None, count: int = 1):
        loads = np.linspace(1.0, 0.9, count)[:, None] * np.array(LOAD)
        return bearing.equilibrium(loads, SPEED, shell=shell, **film)

    states = {name: solve(shell) for name, shell in SHELLS.items()}
    times: dict[str, list[float]] = {name: [] for name in SHELLS}
    for _ in range(_REPEATS):
        for name, shell in SHELLS.items():
            times[name].append(timed(partial(solve, shell, _LOADS))[1])
    rigid = states["rigid"]
    print(head("shell", "gives, µm", "ε", "h_min", "p_max", "time", numbers=True))
    for name, state in states.items():
        cost = min(times[name]) / min(times["rigid"])
        change = [
            100 * float(getattr(state, field)[0] / getattr(rigid, field)[0] - 1)
            for field in ("eccentricity_ratio", "minimum_film", "maximum_pressure")
        ]
        given = f"{1e6 * float(state.shell_deformation[0]):.2f}"
        print(row(name, given, *(f"{value:+.2f} %" for value in change), f"{cost:.1f}"))


if __name__ == "__main__":
    arguments(__doc__).parse_args()
    main()
