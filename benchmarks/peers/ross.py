"""Static equilibrium with stiffness and damping beside ROSS, the rotor-dynamics package.

python -m benchmarks.peers.ross [PYTHON]

PYTHON is the interpreter of an environment with ``ross-rotordynamics`` (2.3 needs ``plotly<6``);
where it cannot import ROSS, the benchmark says so and ends. The bearing has two axial grooves of
20°, the oil one viscosity. ROSS cuts negative pressures (Gümbel's condition): it is compared with
the converged solution of that condition; ours, of Reynolds' condition, with its own. Processor
time of one thread, least of some calls, compilation left out.
"""

from __future__ import annotations

import json
import subprocess
import sys

import numpy as np

from benchmarks.common import arguments, ask, head, row, timed

WIDTH_RATIO = 1.0
RADIUS, CLEARANCE, VISCOSITY, SPEED = 0.2, 2e-4, 0.05, 100.0
GROOVE = 20.0  # degrees
NUMBERS = (0.235, 0.108)  # Sommerfeld numbers S of Lund & Thomsen: ε = 0.46, 0.65
ROSS_MESHES = ((11, 3), (20, 10))  # around and across each of the two pads
OUR_GRIDS = ((40, 8), (60, 16), (120, 40))  # around both pads and across the whole width
FINEST = (480, 120)


def load_of(number: float) -> float:
    """Load at a Sommerfeld number S = η N L D (R/c)²/W, N."""
    turns = SPEED / (2 * np.pi)
    area = 4 * RADIUS**2 * WIDTH_RATIO
    return VISCOSITY * turns * area * (RADIUS / CLEARANCE) ** 2 / number


# --- in the environment of ROSS ------------------------------------------------------------------
def ross_rows() -> list[dict]:
    """What ROSS answers: ε, stiffness and damping with the first axis along the load, seconds."""
    from ross.bearings.lubricants import lubricants_dict
    from ross.bearings.plain_journal import PlainJournal
    from ross.units import Q_

    same = {"liquid_viscosity1": VISCOSITY, "liquid_viscosity2": VISCOSITY * (1 - 1e-9)}
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])  # load along −Y, and a quarter turn with rotation
    rows = []
    for number in NUMBERS:
        for around, across in ROSS_MESHES:

            def solve(around=around, across=across, number=number):
                return PlainJournal(
                    n=3,
                    axial_length=2 * RADIUS * WIDTH_RATIO,
                    journal_radius=RADIUS,
                    radial_clearance=CLEARANCE,
                    elements_circumferential=around,
                    elements_axial=across,
                    n_pad=2,
                    pad_arc_length=180.0 - GROOVE,
                    preload=0,
                    geometry="circular",
                    reference_temperature=50,
                    frequency=Q_([SPEED], "rad/s"),
                    fxs_load=0,
                    fys_load=-load_of(number),
                    groove_factor=[0.5, 0.5],
                    lubricant=lubricants_dict["TEST"] | same,
                    initial_guess=[0.3, -0.5],
                )

            bearing, seconds = timed(solve, 2)
            found = {}
            for name in "kc":
                xx, xy, yx, yy = (
                    np.ravel(getattr(bearing, name + ij))[0] for ij in ("xx", "xy", "yx", "yy")
                )
                found[name] = (turn @ [[xx, xy], [yx, yy]] @ turn.T).tolist()
            ratio = abs(float(bearing.equilibrium_pos[0]))
            mesh = f"{2 * around}x{across}"
            rows.append(
                {"number": number, "mesh": mesh, "ratio": ratio, "seconds": seconds} | found
            )
    return rows


def ask_ross(python: str) -> list[dict] | None:
    """Rows from another interpreter; None where ROSS cannot be had there."""
    if subprocess.run([python, "-c", "import ross"], capture_output=True).returncode:
        return None
    return ask(python, "benchmarks.peers.ross", "--worker")


# --- in this environment -------------------------------------------------------------------------
def our_row(number: float, grid: tuple[int, int], law: str, repeat: int = 1) -> dict:
    """The same from our solver."""
    from loadflow.journal import Guembel, JournalBearing, Lobes, Lubricant, Reynolds

    shape = Lobes(2, groove=np.radians(GROOVE))
    bearing = JournalBearing(2 * RADIUS, 2 * RADIUS * WIDTH_RATIO, CLEARANCE / RADIUS, shape=shape)
    film = {"cavitation": {"Reynolds": Reynolds, "Gümbel": Guembel}[law](), "grid": grid}

    def solve():
        return bearing.equilibrium((load_of(number), 0.0), SPEED, Lubricant(VISCOSITY), **film)

    state, seconds = timed(solve, repeat)
    return {
        "number": number,
        "mesh": f"{grid[0]}x{grid[1]}",
        "ratio": float(state.eccentricity_ratio),
        "seconds": seconds,
        "k": state.stiffness,
        "c": state.damping,
    }


def errors(answer: dict, reference: dict) -> tuple[float, float, float]:
    """Error of ε (absolute), of stiffness and of damping over their largest entry."""

    def off(name: str) -> float:
        exact = np.asarray(reference[name])
        return float(np.abs(np.asarray(answer[name]) - exact).max() / np.abs(exact).max())

    return abs(answer["ratio"] - reference["ratio"]), off("k"), off("c")


def main(python: str) -> None:
    theirs = ask_ross(python)
    if theirs is None:
        print(f"skipped: {python} cannot import ross (pip install ross-rotordynamics 'plotly<6')")
        return
    print(head("S", "code", "cells", "ms", "ε off by", "K", "C", numbers=True))
    for number in NUMBERS:
        exact = {law: our_row(number, FINEST, law) for law in ("Reynolds", "Gümbel")}
        rows = [("ROSS", one, exact["Gümbel"]) for one in theirs if one["number"] == number]
        rows += [
            ("ours", our_row(number, grid, "Reynolds", 6), exact["Reynolds"]) for grid in OUR_GRIDS
        ]
        for code, answer, reference in rows:
            ratio, stiffness, damping = errors(answer, reference)
            print(
                row(
                    number, code, answer["mesh"], f"{1e3 * answer['seconds']:.2f}",
                    f"{ratio:.4f}", f"{100 * stiffness:.1f} %", f"{100 * damping:.1f} %",
                )
            )  # fmt: skip


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("python", nargs="?", default=sys.executable)
    parser.add_argument("--worker", action="store_true", help="ask ROSS here, as JSON")
    chosen = parser.parse_args()
    if chosen.worker:
        print(json.dumps(ross_rows()))
    else:
        main(chosen.python)
