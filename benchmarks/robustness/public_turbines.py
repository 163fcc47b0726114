"""The IEA turbines of their own repositories, read as they are, completed, and run in steady wind.

As with public load files each file is taken from a clone (OWNER/NAME) at the commit below. What the
files lack stands beside them here, from the ElastoDyn and ServoDyn files of the same repositories.

    python -m benchmarks.robustness.public_turbines CLONES    # the tables of docs/reliability.md
"""

from __future__ import annotations

import subprocess
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import tomli_w

from benchmarks.common import arguments, head, row
from benchmarks.robustness.public_files import clone
from loadflow.errors import InputError
from loadflow.rotor import RotorOptions, steady_state
from loadflow.turbines import Turbine, load_turbine

GRAVITY = 9.80665


def _elastodyn_blade(text: str) -> list[list[float]]:
    """Rows of share of the span, twist, mass and stiffness of a blade file of ElastoDyn."""
    lines = text.splitlines()
    first = next(k for k, line in enumerate(lines) if "BMassDen" in line) + 2
    rows = []
    for line in lines[first:]:
        try:
            share, _, *others = map(float, line.split())
        except ValueError:
            break
        rows.append([share, *others])
    return rows


def _table(text: str) -> np.ndarray:
    """Wind m/s, speed 1/min, pitch deg, power W, thrust N of performance_ccblade.dat."""
    columns = np.array([line.split() for line in text.splitlines()[1:]], float)
    return columns[:, [0, 1, 2, 4, 5]]


def _opt(text: str) -> np.ndarray:
    """The same of the operational data of HAWC2, .opt."""
    columns = np.array([line.split() for line in text.splitlines()[1:]], float)
    return columns[:, [0, 2, 1, 3, 4]] * [1, 1, 1, 1e3, 1e3]


def _states(text: str) -> np.ndarray:
    """The same of the steady states of the IEA 22 MW."""
    import yaml

    rows = []
    for case in yaml.load(text, yaml.CSafeLoader)["cases"]:
        at, whole = case["configuration"], case["outputs"]["integrated"]
        loads = whole["mechanical_power"], whole["rotor_thrust"]
        rows.append([at["wind_speed"], at["rotor_speed"], at["pitch"], *loads])
    return np.array(rows)


@dataclass(frozen=True)
class Public:
    """A public turbine: its file, what stands beside it, and its published steady states."""

    repository: str
    commit: str
    file: str
    published: str
    reads: Callable[[str], np.ndarray]
    winds: tuple[float, ...]
    beside: dict[str, Any] = field(default_factory=dict)
    blade: str = ""


TURBINES = (
    Public(
        "IEAWindTask37/IEA-3.4-130-RWT",
        "c036f783b160604b133a2e4b7317320fde055743",
        "yaml/IEA-3.4-130-RWT.yaml",
        "performance/performance_ccblade.dat",
        _table,
        (8.0, 14.0, 20.0),
        {
            "rotor": {"hub_mass": 8239.2, "hub_inertia": 31094.4},
            "drivetrain": {"generator_inertia": 1055.625},
        },
        "openfast/IEA-3.4-130-RWT_ElastoDyn_blade.dat",
    ),
    Public(
        "IEAWindTask37/IEA-10.0-198-RWT",
        "f4c09ba7b1d4481156eb35394bf1276b5d250ba6",
        "yaml/IEA-10-198-RWT.yaml",
        "performance/performance_ccblade.dat",
        _table,
        (8.0, 14.0, 20.0),
        {
            "rotor": {"hub_mass": 81707.0, "hub_inertia": 476512.0},
            "drivetrain": {"generator_inertia": 3801700.0},
        },
    ),
    Public(
        "IEAWindTask37/IEA-15-240-RWT",
        "6b3fd8ac92935f7f6fe1810a909afc2430f6896f",
        "WT_Ontology/IEA-15-240-RWT.yaml",
        "HAWC2/IEA-15-240-RWT-Onshore/data/IEA_15MW_RWT_Onshore.opt",
        _opt,
        (9.0, 15.0, 25.0),
        {
            "rotor": {"hub_mass": 69131.0, "hub_inertia": 969952.0},
            "drivetrain": {"generator_inertia": 1836784.0, "efficiency": 0.95756},
        },
    ),
    Public(
        "IEAWindSystems/IEA-22-280-RWT",
        "57979ece000ec5cc394962b964805ddf20e387be",
        "windIO/IEA-22-280-RWT.yaml",
        "outputs/01_steady_states/HAWC2/iea-22-280-rwt-steady-states-hawc2.yaml",
        _states,
        (8.0, 15.0, 25.0),
        {
            "drivetrain": {"generator_inertia": 1439492.8, "efficiency": 0.954},
            # 0.7 rad/s of the file is no steady control of blades that bend
            "control": {"pitch_frequency": 0.2},
        },
    ),
)
"""Values beside: ElastoDyn and ServoDyn of the repositories; for the 22 MW, windIO's examples."""


def content(public: Public, path: str, clones: Path) -> str:
    """A file of a repository at its commit."""
    command = ["git", "-C", clones / public.repository, "show", f"{public.commit}:{path}"]
    return subprocess.run(command, check=True, capture_output=True).stdout.decode()


def missing(public: Public, clones: Path) -> list[str]:
    """Keys that the file alone lacks."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "turbine.yaml"
        path.write_text(content(public, public.file, clones))
        try:
            load_turbine(path)
        except InputError as error:
            told = [line for line in str(error).splitlines() if "missing key" in line]
            return [line.split(": ")[1] for line in told]
        return []


def completed(public: Public, clones: Path) -> Turbine:
    """The turbine with what stands beside its file."""
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "turbine.yaml").write_text(content(public, public.file, clones))
        beside = {"windio": "turbine.yaml"} | public.beside
        if public.blade:
            rows = _elastodyn_blade(content(public, public.blade, clones))
            length = 63.0  # m, of the reference axis of the file
            structure = [[length * share, *others] for share, *others in rows]
            mass = float(np.trapezoid([r[2] for r in structure], [r[0] for r in structure]))
            beside["blade"] = {"mass": mass, "structure": structure}
        (folder / "turbine.toml").write_text(tomli_w.dumps(beside))
        return load_turbine(folder / "turbine.toml")


def differences(public: Public, turbine: Turbine, clones: Path) -> np.ndarray:
    """Speed, pitch (deg), power and thrust: ours less the published ones; all but pitch over it."""
    table = public.reads(content(public, public.published, clones))
    known = np.array([np.interp(public.winds, table[:, 0], c) for c in table[:, 1:].T])
    options = RotorOptions(tower_dam=False)
    found = steady_state(turbine, public.winds, shear=0.0, rung="flap", options=options)
    weight = turbine.rotor_mass * GRAVITY * np.sin(turbine.rotor.tilt)
    ours = np.array(
        [
            found["speed"].values * 30 / np.pi,
            np.degrees(found["pitch"].values),
            found["power"].values,
            found["thrust"].values - weight,
        ]
    )
    off = ours / np.where(known == 0, 1, known) - 1
    off[1] = ours[1] - known[1]
    return off


def main(clones: Path) -> None:
    """Print both tables."""
    print(head("turbine", "file alone", "wind m/s", "speed", "pitch °", "power", "thrust"))
    for public in TURBINES:
        clone(public.repository, clones)
        lacks = missing(public, clones)
        told = f"{len(lacks)} keys missing" if lacks else "read"
        off = differences(public, completed(public, clones), clones)
        for wind, (speed, pitch, power, thrust) in zip(public.winds, off.T):
            shares = [f"{100 * x:+.1f} %" for x in (speed, power, thrust)]
            name = public.repository.split("/")[1]
            print(row(name, told, wind, shares[0], f"{pitch:+.2f}", *shares[1:]), flush=True)


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("clones", type=Path, help="folder of clones, OWNER/NAME")
    main(parser.parse_args().clones)
