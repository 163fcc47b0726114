"""Static equilibrium with stiffness and damping beside ROSS, the rotor-dynamics package.

python -m benchmarks.peers.ross [PYTHON]

PYTHON, or the environment variable ROSS_PYTHON, is the interpreter of an environment with
``ross-rotordynamics`` ≥ 3.1 (Python 3.13), whose film is compiled; where it cannot import that, the
benchmark says so and ends. Both take Reynolds' condition of rupture and one viscosity: a bearing of
two axial grooves of 20° at loads of [Lund and Thomsen 1978], L/D 0.5 and 1, and four tilting pads.
Each is compared with the converged solution of our grid, and with the printed table. Processor time
of one thread, least of some calls, compilation left out; both codes run in turn.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from dataclasses import dataclass

import numpy as np

from benchmarks.common import arguments, ask, head, row, timed

DIAMETER, CLEARANCE, VISCOSITY, SPEED = 0.1, 1e-4, 0.02, 100 * np.pi
GROOVE = 20.0  # degrees
PADS, ARC, PRELOAD = 4, 75.0, 0.3
ROSS_MESHES = (
    (10, 4, 10),
    (20, 10, 10),
    (40, 20, 30),
)  # of each pad, through the film; last: default
OUR_GRIDS = ((40, 8), (60, 16), (120, 40))  # around all pads and across the whole width
FINEST = (480, 120)


@dataclass(frozen=True)
class Case:
    """A bearing and its load; `printed`: ε of the table, if there is one."""

    name: str
    width_ratio: float
    number: float
    printed: float | None = None

    @property
    def width(self) -> float:
        """m."""
        return self.width_ratio * DIAMETER

    @property
    def tilting(self) -> bool:
        """Whether the pads tilt."""
        return self.printed is None

    @property
    def load(self) -> float:
        """At the Sommerfeld number S = η N L D (R/c)²/W, N."""
        turns = SPEED / (2 * np.pi)
        area = DIAMETER * self.width
        return VISCOSITY * turns * area * (0.5 * DIAMETER / CLEARANCE) ** 2 / self.number


CASES = (
    Case("grooves, L/D 0.5, S 0.58", 0.5, 0.580, 0.477),
    Case("grooves, L/D 0.5, S 0.244", 0.5, 0.244, 0.655),
    Case("grooves, L/D 1, S 0.235", 1.0, 0.235, 0.460),
    Case("grooves, L/D 1, S 0.108", 1.0, 0.108, 0.650),
    Case("4 tilting pads, L/D 0.7, S 0.2", 0.7, 0.2),
)


# --- in the environment of ROSS ------------------------------------------------------------------
def ross_rows() -> list[dict]:
    """What ROSS answers: ε, stiffness and damping with the first axis along the load, seconds."""
    import warnings

    from ross.bearings.fixed_geometry import FixedGeometryBearing
    from ross.bearings.tilting_pad import TiltingPad

    warnings.simplefilter("ignore")
    oil = {
        "liquid_viscosity1": VISCOSITY,
        "temperature1": 313.15,
        "liquid_viscosity2": VISCOSITY,
        "temperature2": 373.15,
        "liquid_density": 860.0,
        "liquid_specific_heat": 1951.0,
        "liquid_thermal_conductivity": 0.13,
    }
    turn = np.array([[0.0, -1.0], [1.0, 0.0]])  # load along −Y, and a quarter turn with rotation
    rows = []
    for case in CASES:
        pads = (45, 135, 225, 315) if case.tilting else (90, 270)
        arc, preload = (ARC, PRELOAD) if case.tilting else (180 - GROOVE, 0.0)
        kind = TiltingPad if case.tilting else FixedGeometryBearing
        for mesh in ROSS_MESHES:

            def solve(case=case, mesh=mesh, kind=kind, pads=pads, arc=arc, preload=preload):
                around, across, through = mesh
                return kind(
                    n=0,
                    speed=[SPEED],
                    journal_diameter=DIAMETER,
                    radial_clearance=CLEARANCE,
                    pad_thickness=0.02,
                    pivot_angle=np.radians(pads),
                    pad_arc=np.radians([arc] * len(pads)),
                    pad_axial_length=[case.width] * len(pads),
                    preload=[preload] * len(pads),
                    offset=[0.5] * len(pads),
                    lubricant=oil,
                    oil_supply_temperature=313.15,
                    oil_flow_v=1e-2,
                    fys_load=-case.load,
                    thermal_type=None,
                    equilibrium_type="match_load",
                    total_ex_film=around,
                    total_ez_film=across,
                    total_ey_film=through,
                    total_ey_pad=2,
                )

            bearing, seconds = timed(solve, 3)
            found = {}
            for name in "kc":
                xx, xy, yx, yy = (
                    np.ravel(getattr(bearing, name + ij))[0] for ij in ("xx", "xy", "yx", "yy")
                )
                found[name] = (turn @ [[xx, xy], [yx, yy]] @ turn.T).tolist()
            ratio = float(np.ravel(bearing._results.outputs[0]["eccentricity"])[0])
            cells = "x".join(map(str, (len(pads) * mesh[0], *mesh[1:])))
            rows.append(
                {"case": case.name, "mesh": cells, "ratio": ratio, "seconds": seconds} | found
            )
    return rows


def ask_ross(python: str) -> list[dict] | None:
    """Rows from another interpreter; None where ROSS ≥ 3.1 cannot be had there."""
    known = "from ross.bearings.fixed_geometry import FixedGeometryBearing"
    if subprocess.run([python, "-c", known], capture_output=True).returncode:
        return None
    return ask(python, "benchmarks.peers.ross", "--worker")


# --- in this environment -------------------------------------------------------------------------
def our_row(case: Case, grid: tuple[int, int], repeat: int = 1) -> dict:
    """The same from our solver."""
    from loadflow.journal import JournalBearing, Lobes, Lubricant, Reynolds, TiltingPads

    arc, quarter = np.radians(ARC), 0.5 * np.pi
    shape = (
        TiltingPads(PADS, arc, PRELOAD, angle=0.5 * quarter)
        if case.tilting
        else Lobes(2, groove=np.radians(GROOVE))
    )
    bearing = JournalBearing(DIAMETER, case.width, 2 * CLEARANCE / DIAMETER, shape=shape)
    film = {"cavitation": Reynolds(), "grid": grid}

    def solve():
        load = (case.load, 0.0)
        return bearing.equilibrium(load, SPEED, Lubricant(VISCOSITY), whirl=SPEED, **film)

    state, seconds = timed(solve, repeat)
    return {
        "case": case.name,
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


def faster(theirs: list[tuple], ours: list[tuple]) -> str:
    """How many times longer each of `theirs` takes than our fastest with no larger error."""
    said = []
    for mesh, seconds, wrong in theirs:
        as_good = [own for _, own, error in ours if np.all(np.array(error) <= np.array(wrong))]
        ratio = f"{seconds / min(as_good):.0f}" if as_good else "none as good"
        said.append(f"{mesh}: {ratio}")
    return ", ".join(said)


def main(python: str) -> None:
    """Measure and print."""
    theirs = ask_ross(python)
    if theirs is None:
        print(f"skipped: {python} cannot import ROSS 3.1 (pip install ross-rotordynamics)")
        return
    print(head("case", "code", "cells", "ms", "ε off by", "K", "C", "printed ε off by"))
    ratios = []
    for case in CASES:
        exact = our_row(case, FINEST)
        rows = [("ROSS", one) for one in theirs if one["case"] == case.name]
        rows += [("ours", our_row(case, grid, 6)) for grid in OUR_GRIDS]
        found: dict[str, list[tuple]] = {"ROSS": [], "ours": []}
        for code, answer in rows:
            ratio, stiffness, damping = wrong = errors(answer, exact)
            found[code].append((answer["mesh"], answer["seconds"], wrong))
            table = "" if case.printed is None else f"{abs(answer['ratio'] - case.printed):.4f}"
            print(
                row(
                    case.name, code, answer["mesh"], f"{1e3 * answer['seconds']:.2f}",
                    f"{ratio:.4f}", f"{100 * stiffness:.2f} %", f"{100 * damping:.2f} %", table,
                )
            )  # fmt: skip
        ratios.append(f"{case.name}: {faster(found['ROSS'], found['ours'])}")
    print(
        "\nTime of each mesh of ROSS over that of our fastest with no larger error in ε, K and C:"
    )
    print("\n".join(ratios))


if __name__ == "__main__":
    parser = arguments(__doc__)
    usual = os.environ.get("ROSS_PYTHON", sys.executable)
    parser.add_argument("python", nargs="?", default=usual)
    parser.add_argument("--worker", action="store_true", help="ask ROSS here, as JSON")
    chosen = parser.parse_args()
    if chosen.worker:
        print(json.dumps(ross_rows()))
    else:
        main(chosen.python)
