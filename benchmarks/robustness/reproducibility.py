"""How far results move on another processor: kernels as compiled here, and for a plain one.

python -m benchmarks.robustness.reproducibility

Each group of results is computed twice in processes of their own: with the vector instructions of
this machine, and with kernels compiled for the oldest processor of its kind
(NUMBA_CPU_NAME=generic) beside an old instruction set of the BLAS (OPENBLAS_CORETYPE=Prescott) and
one thread. What is printed is the largest difference over the largest magnitude of each variable,
and whether two runs with the same kernels agree bit by bit.
"""

from __future__ import annotations

import os
import pickle
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable

import numpy as np

from benchmarks.common import ROOT, arguments

FIELDS = (
    "eccentricity",
    "minimum_film",
    "maximum_pressure",
    "friction_power",
    "stiffness",
    "damping",
)
PLAIN = {
    "NUMBA_CPU_NAME": "generic",
    "NUMBA_CPU_FEATURES": "",
    "OPENBLAS_CORETYPE": "Prescott",
}


def _film_cases() -> list[tuple[dict, dict]]:
    from loadflow.journal import (
        GasMixture,
        Groove,
        Guembel,
        Lobes,
        LocalShell,
        MassConserving,
        Reynolds,
        Sommerfeld,
        Supply,
        TiltingPads,
    )

    laws = [Sommerfeld(), Guembel(), Reynolds(), MassConserving(), GasMixture(5e4)]
    cases: list[tuple[dict, dict]] = [({}, {"cavitation": law}) for law in laws]
    cases += [
        ({"shape": Lobes(3, 0.3)}, {}),
        ({"shape": TiltingPads(4, 1.2, 0.3, angle=0.4)}, {"cavitation": GasMixture(5e4)}),
        ({}, {"supply": Supply((Groove(2.5, 0.3, pressure=3e5),))}),
        ({}, {"tilt": (1e-5, 2e-5)}),
        ({}, {"shell": LocalShell(1e-11), "cavitation": GasMixture(5e4)}),
    ]
    return cases


def journal_at_rest() -> dict[str, np.ndarray]:
    """Laws, shapes, pads, supply, tilt and shell; So of about 0.1 to 10."""
    from loadflow.journal import JournalBearing, Lubricant

    turns = np.linspace(0, 6, 8)
    force = np.geomspace(1e5, 1e7, 8)[:, None] * np.stack([np.cos(turns), np.sin(turns)], axis=-1)
    force[:, 0] = np.abs(force[:, 0])
    out = {}
    for number, (shape, film) in enumerate(_film_cases()):
        bearing = JournalBearing(3.0, 2.25, 0.5e-3, **shape)
        state = bearing.equilibrium(
            force, 1.2, Lubricant(0.05), edge_pressure=1e5, grid=(60, 12), strict=False, **film
        )
        out |= {f"{name} {number}": getattr(state, name) for name in FIELDS}
    return out


def journal_orbits() -> dict[str, np.ndarray]:
    """A load that turns and pulsates, 200 steps; grid, reduced, map."""
    from loadflow.journal import GasMixture, JournalBearing, Lubricant

    bearing = JournalBearing(3.0, 2.25, 0.5e-3)
    time = np.linspace(0.0, 20.0, 201)
    size = 2e6 * (1 + 0.5 * np.sin(1.3 * time))
    force = size[:, None] * np.stack([np.cos(0.4 * time), np.sin(0.4 * time)], axis=-1)
    film = {"cavitation": GasMixture(5e4), "edge_pressure": 5e5, "grid": (60, 12)}
    out = {}
    for rung in ("grid", "reduced", "map"):
        path = bearing.orbit(time, force, 1.2, Lubricant(0.05), rung=rung, **film)
        for name in ("eccentricity", "minimum_film", "maximum_pressure", "friction_power"):
            out[f"{rung} {name}"] = path[name].values
    return out


def rolling() -> dict[str, np.ndarray]:
    """Four-point bearing under 60 loads of 1 N to 1 MN, forces, displacements, tangent."""
    from loadflow.rolling import SlewingBearing

    rng = np.random.default_rng(1)
    size = np.geomspace(1.0, 1e6, 60)[:, None]
    bearing = SlewingBearing(
        balls=60, ball_diameter=0.05, pitch_diameter=1.5, groove_radius=0.0265, contact_angle=0.78
    )
    force, moment = size * rng.standard_normal((60, 3)), size * rng.standard_normal((60, 2))
    result = bearing.equilibrium(force=force, moment=moment)
    return {
        "forces": result.ball_forces / size[:, :, None, None],
        "displacement": result.displacement,
        "stiffness": result.stiffness,
    }


def rotor() -> dict[str, np.ndarray]:
    """Steady state of the 5 MW turbine, and 30 s in a steady wind."""
    from loadflow.rotor import simulate, steady_state

    points = steady_state("nrel-5mw", wind_speed=[4.0, 8.0, 11.4, 16.0, 24.0])
    series = simulate("nrel-5mw", wind_speed=11.0, duration=30.0)
    names = ("hub_force", "hub_moment")
    both = {"steady": points, "series": series}
    return {f"{k} {n}": d[n].values for k, d in both.items() for n in names if n in d}


GROUPS: dict[str, Callable[[], dict[str, np.ndarray]]] = {
    "journal at rest": journal_at_rest,
    "journal orbits": journal_orbits,
    "rolling": rolling,
    "rotor": rotor,
}


def computed(
    environment: dict[str, str], groups: list[str], python: str = sys.executable
) -> dict[str, dict[str, np.ndarray]]:
    """Groups of results, in a process of its own with its own cache of kernels."""
    with tempfile.TemporaryDirectory() as folder:
        given = {"OPENBLAS_NUM_THREADS": "1"} | environment
        if environment:
            given["NUMBA_CACHE_DIR"] = folder
        results = os.path.join(folder, "results")
        command = [python, "-m", "benchmarks.robustness.reproducibility", results]
        command += ["--groups", *groups]
        subprocess.run(command, check=True, cwd=ROOT, env=os.environ | given)
        with open(results, "rb") as file:
            return dict(pickle.load(file))


def main() -> None:
    """Compute, compare, print."""
    warnings.simplefilter("ignore")
    parser = arguments(__doc__)
    parser.add_argument("results", nargs="?", help="compute here, and keep the results there")
    parser.add_argument("--groups", nargs="+", choices=GROUPS, default=[*GROUPS])
    parser.add_argument("--python", help="another interpreter, in place of another processor")
    chosen = parser.parse_args()
    if chosen.results:
        with open(chosen.results, "wb") as file:
            pickle.dump({name: GROUPS[name]() for name in chosen.groups}, file)
        return
    here = computed({}, chosen.groups)
    if chosen.python:
        other = computed({}, chosen.groups, chosen.python)
        for name, values in here.items():
            print(f"{name}: {chosen.python}: {_said(values, other[name])}")
        return
    again, plain = computed({}, chosen.groups), computed(PLAIN, chosen.groups)
    for name, values in here.items():
        print(f"{name}: again here: {_said(values, again[name])}")
        print(f"{name}: plain processor: {_said(values, plain[name])}")


def _said(values: dict[str, np.ndarray], others: dict[str, np.ndarray]) -> str:
    """Whether the bits are the same, or the largest difference."""
    if all(np.array_equal(v, others[k], equal_nan=True) for k, v in values.items()):
        return "same bits"
    moved = {}
    for key, value in values.items():
        lost = int((np.isnan(value) != np.isnan(others[key])).sum())
        scale = np.nanmax(np.abs(value)) or 1.0
        moved[key] = np.inf if lost else float(np.nanmax(np.abs(value - others[key])) / scale)
    worst = max(moved, key=moved.__getitem__)
    return f"OTHER BITS, at most {moved[worst]:.1e} of the largest value ({worst})"


if __name__ == "__main__":
    main()
