"""Steady states as the repositories of the IEA turbines publish them.

python -m benchmarks.references.steady_states CLONES    # writes the table of the package
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np

from benchmarks.common import ROOT, arguments
from loadflow.validation.turbines import TURBINES, content

TABLE = ROOT / "loadflow" / "data" / "reference" / "steady_states.csv"


def _ccblade(text: str) -> np.ndarray:
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


READS: dict[str, Callable[[str], np.ndarray]] = {".dat": _ccblade, ".opt": _opt, ".yaml": _states}
WINDS = (5.0, 7.0, 9.0, 10.0, 11.0, 13.0, 17.0, 21.0, 25.0)
"""m/s; of each the printed state that is nearest."""


def main(clones: Path) -> None:
    """Write the table."""
    lines = ["turbine,wind,speed,pitch,power,thrust"]
    for public in TURBINES:
        text = content(public, public.published, clones)
        table = READS[Path(public.published).suffix](text)
        kept = sorted({int(np.abs(table[:, 0] - wind).argmin()) for wind in WINDS})
        for wind, speed, pitch, power, thrust in table[kept]:
            cells = f"{wind:.6g}", f"{speed:.6g}", f"{pitch:.5g}", f"{power:.6g}", f"{thrust:.6g}"
            lines.append(",".join((public.name, *cells)))
    TABLE.write_text("\n".join(lines) + "\n", encoding="utf-8")


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("clones", type=Path, help="folder of clones, OWNER/NAME")
    main(parser.parse_args().clones)
