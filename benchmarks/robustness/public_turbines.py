"""The IEA turbines of their own repositories, read as they are, completed, and run in steady wind.

As with public load files each file is taken from a clone (OWNER/NAME) at its commit. Which files,
what they lack and what is published of them stands in `loadflow.validation.turbines`, whose numbers
are printed here side by side.

    python -m benchmarks.robustness.public_turbines CLONES    # the table of docs/reliability.md
"""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np

from benchmarks.common import arguments, head, row
from benchmarks.robustness.public_files import clone
from loadflow.errors import InputError
from loadflow.turbines import Turbine, load_turbine
from loadflow.validation.turbines import (
    TURBINES,
    PublicTurbine,
    completed,
    content,
    controlled_states,
    published_states,
)


def missing(public: PublicTurbine, clones: Path) -> list[str]:
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


def differences(public: PublicTurbine, turbine: Turbine) -> np.ndarray:
    """Wind, and speed, pitch (deg), power, thrust less the published; all but pitch over it."""
    known = published_states(public.name)
    ours = controlled_states(public, turbine)
    off = ours / np.where(known[:, 1:] == 0, 1, known[:, 1:]) - 1
    off[:, 1] = ours[:, 1] - known[:, 2]
    return np.column_stack([known[:, 0], off])


def main(clones: Path) -> None:
    """Print the table."""
    print(head("turbine", "file alone", "wind m/s", "speed", "pitch °", "power", "thrust"))
    for public in TURBINES:
        clone(public.repository, clones)
        lacks = missing(public, clones)
        told = f"{len(lacks)} keys missing" if lacks else "read"
        for wind, speed, pitch, power, thrust in differences(public, completed(public, clones)):
            shares = [f"{100 * x:+.1f} %" for x in (speed, power, thrust)]
            name = public.repository.split("/")[1]
            cells = (name, told, f"{wind:.1f}", shares[0], f"{pitch:+.2f}", *shares[1:])
            print(row(*cells), flush=True)


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("clones", type=Path, help="folder of clones, OWNER/NAME")
    main(parser.parse_args().clones)
