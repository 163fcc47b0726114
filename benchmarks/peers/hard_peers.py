"""What other packages do with the hard cases that they can run: writes tests/hard/peers.json.

python -m benchmarks.peers.hard_peers [--ross PYTHON] [--pyconturb PYTHON]

PYTHON are interpreters of environments of their own: ``pip install ross-rotordynamics 'plotly<6'``
and ``pip install pyconturb 'setuptools<80'``. What is not given keeps its old rows. scipy and
pylife are asked in this environment. A case has three minutes.
"""

from __future__ import annotations

import json
import subprocess
import sys
import warnings
from collections.abc import Callable
from importlib import metadata
from typing import Any

import numpy as np

from benchmarks import common

PEERS = common.ROOT / "tests" / "hard" / "peers.json"
PATIENCE = 180.0  # s

Case = Callable[[], str]


def states(values: Any) -> str:
    """Whether an array is all numbers."""
    return "" if np.isfinite(values).all() else " (NaN or infinite, no error)"


# --- ROSS: the bearing of tests/hard/journal_cases.py --------------------------------------------
RADIUS, WIDTH, CLEARANCE, VISCOSITY = 1.5, 2.25, 0.75e-3, 0.05


def _plain_journal(load: float, speed: float) -> str:
    """Equilibrium and stiffness, 20 x 8 elements; one pad all round."""
    from ross.bearings.lubricants import lubricants_dict
    from ross.bearings.plain_journal import PlainJournal
    from ross.units import Q_

    same = {"liquid_viscosity1": VISCOSITY, "liquid_viscosity2": VISCOSITY * (1 - 1e-9)}
    bearing = PlainJournal(
        n=3,
        axial_length=WIDTH,
        journal_radius=RADIUS,
        radial_clearance=CLEARANCE,
        elements_circumferential=20,
        elements_axial=8,
        n_pad=1,
        pad_arc_length=359.0,
        preload=0,
        geometry="circular",
        reference_temperature=50,
        frequency=Q_([speed], "rad/s"),
        fxs_load=0,
        fys_load=-load,
        groove_factor=[0.5],
        lubricant=lubricants_dict["TEST"] | same,
    )
    ratio = abs(float(np.ravel(bearing.equilibrium_pos)[0]))
    stiffness = [np.ravel(getattr(bearing, f"k{ij}")) for ij in ("xx", "xy", "yx", "yy")]
    return f"ε = {ratio:.6g}, stiffness{states(stiffness) or ' finite'}"


def _fluid_flow(ratio: float, around: int = 61) -> str:
    """Pressure at a given position, Gümbel's condition."""
    from ross.bearings.fluid_flow import FluidFlow

    film = FluidFlow(
        *(20, around, WIDTH, 1.2, 0.0, 0.0, RADIUS, RADIUS + CLEARANCE, VISCOSITY, 860.0),
        attitude_angle=np.pi / 4,
        eccentricity=ratio * CLEARANCE,
    )
    pressure = film.p_mat_numerical
    return f"{pressure.max() / 1e6:.0f} MPa on {around} points around{states(pressure)}"


def _stretched() -> str:
    """Points 10⁴ times as far apart along the axis as around."""
    from ross.bearings.fluid_flow import FluidFlow

    film = FluidFlow(
        *(4, 2881, 50.0, 10.0, 0.0, 0.0, 0.5, 0.5005, VISCOSITY, 860.0),
        attitude_angle=np.pi / 4,
        eccentricity=0.2e-3,
        bearing_type="medium_size",
    )
    return f"p_max = {film.p_mat_numerical.max() / 1e6:.3g} MPa{states(film.p_mat_numerical)}"


ROSS: dict[str, Case] = {
    "journal: ε = 0.999, position given": lambda: "; ".join(
        _fluid_flow(0.999, n) for n in (61, 721)
    ),
    "journal: load for ε > 0.99": lambda: _plain_journal(2e9, 1.2),
    "journal: ε → 0: no load, and 1 µN": lambda: " and ".join(
        _plain_journal(load, 1.2) for load in (0.0, 1e-6)
    ),
    "journal: ω → 0 under load: 1e-6 rad/s": lambda: " and ".join(
        f"{_plain_journal(1e5, speed)} at {speed:g} rad/s" for speed in (1e-3, 1e-6)
    ),
    "journal: ω = 0 under load": lambda: _plain_journal(2.1e6, 0.0),
    "journal: shaft outside the clearance": lambda: _fluid_flow(1.1),
    "journal: cells 10⁴ times longer than wide": _stretched,
}


# --- PyConTurb: turbulence of IEC 61400-1 --------------------------------------------------------
def _pyconturb(y: list[float], z: list[float], speed: float = 12.0) -> str:
    import pandas as pd
    from pyconturb import gen_turb

    names = [f"u_p{i}" for i in range(len(y))]
    points = pd.DataFrame(np.zeros((4, len(y))), index=["k", "x", "y", "z"], columns=names)
    points.loc["y"], points.loc["z"] = y, z
    field = gen_turb(
        points, T=60, nt=600, u_ref=speed, turb_class="B", z_ref=90.0, seed=1, verbose=False
    )
    spread = ", ".join(f"{value:.4g}" for value in field.values.std(axis=0))
    return f"standard deviations {spread} m/s{states(field.values)}"


PYCONTURB: dict[str, Case] = {
    "wind: grid points a micrometre apart": lambda: _pyconturb([0.0, 1e-6], [90.0, 90.0]),
    "wind: two grid points at the same place": lambda: _pyconturb([0.0, 0.0], [90.0, 90.0]),
    "wind: a grid that reaches below the ground": lambda: _pyconturb([0.0, 10.0], [-5.0, 90.0]),
    "wind: turbulence without wind": lambda: _pyconturb([0.0, 10.0], [90.0, 90.0], 0.0),
}


# --- scipy and pylife ----------------------------------------------------------------------------
def _kruskal(*records: Any) -> str:
    from scipy.stats import kruskal

    found = kruskal(*records)
    return f"kruskal: H = {found.statistic:.3g}, p = {found.pvalue:.2g}"


def _millions() -> str:
    rng = np.random.default_rng(3)
    return _kruskal(rng.normal(size=5_000_000), rng.normal(size=5_000_000))


SCIPY: dict[str, Case] = {
    "seeds: all samples tied": lambda: _kruskal(np.ones(50), np.ones(40)),
    "seeds: one seed": lambda: _kruskal(np.random.default_rng(2).normal(size=4000)),
    "seeds: 10⁷ samples": _millions,
}


def _rainflow(series: list[float]) -> str:
    import pylife.stress.rainflow as rainflow

    detector = rainflow.FourPointDetector(recorder=rainflow.LoopValueRecorder())
    done = detector.process(np.array(series))
    rest = ", ".join(f"{value:g}" for value in done.residuals)
    return f"{len(done.recorder.values_from)} closed cycles, residue {rest}"


PYLIFE: dict[str, Case] = {
    "reduction: a series with a gap to count": lambda: _rainflow(
        [0.0, 5.0, np.nan, -5.0, 3.0, -2.0, 4.0, 0.0]
    ),
    "reduction: a constant series to count": lambda: _rainflow([1.0] * 10),
}

ASKED: dict[str, tuple[str, str, dict[str, Case]]] = {
    "ross": ("ROSS", "ross-rotordynamics", ROSS),
    "pyconturb": ("PyConTurb", "pyconturb", PYCONTURB),
    "scipy": ("scipy", "scipy", SCIPY),
    "pylife": ("pylife", "pylife", PYLIFE),
}
"""Name, package and cases of each peer."""


def ask(peer: str, case: str) -> str:
    """What a peer says, in this environment: its answer, its error, and what it warned of."""
    name, package, cases = ASKED[peer]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            text = cases[case]()
        except Exception as error:
            text = f"{type(error).__name__}: {str(error).splitlines()[0]}"
    told = {str(w.message).splitlines()[0].rstrip(".") for w in caught if _of_numbers(w)}
    if told:
        text += f"; warns: {', '.join(sorted(told))}"
    return f"{name} {metadata.version(package)}: {text}"


def _of_numbers(warning: warnings.WarningMessage) -> bool:
    return issubclass(warning.category, RuntimeWarning) or "NaN" in str(warning.message)


def told_by(python: str, peer: str, case: str) -> str:
    """What a peer says in another interpreter, if it says it in time."""
    module = "benchmarks.peers.hard_peers"
    try:
        return str(common.ask(python, module, "--ask", peer, case, seconds=PATIENCE))
    except subprocess.TimeoutExpired:
        return f"{peer}: no answer in {PATIENCE:g} s"


def main() -> None:
    """Ask the peers that are there."""
    parser = common.arguments(__doc__)
    parser.add_argument("--ross", metavar="PYTHON", help="interpreter that has ROSS")
    parser.add_argument("--pyconturb", metavar="PYTHON", help="interpreter that has PyConTurb")
    parser.add_argument("--ask", nargs=2, metavar=("PEER", "CASE"), help="one case, here, as JSON")
    chosen = parser.parse_args()
    if chosen.ask:
        print(json.dumps(ask(*chosen.ask)))
        return
    pythons = {"ross": chosen.ross, "pyconturb": chosen.pyconturb}
    pythons |= {"scipy": sys.executable, "pylife": sys.executable}
    rows = json.loads(PEERS.read_text(encoding="utf-8")) if PEERS.exists() else {}
    for peer, (_, _, cases) in ASKED.items():
        for case in cases if pythons[peer] else ():
            rows[case] = told_by(str(pythons[peer]), peer, case)
            print(f"{case}: {rows[case]}", flush=True)
    PEERS.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
