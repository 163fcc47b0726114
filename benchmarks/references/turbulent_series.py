"""What `loadflow.validation._turbulent_series` holds: one series a wind of OpenFAST, our scatter.

python -m benchmarks.references.turbulent_series FOLDER

Prints the measures of the series of 4, 8 and 24 m/s in the folder, and the standard deviation of
the same measures over seeds of ours that the rows do not use.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from benchmarks.common import arguments
from loadflow.readers import read_loads
from loadflow.rotor import simulate
from loadflow.validation._load_series import each
from loadflow.validation._turbulent_series import CHANNELS, MEASURED, SCATTER_OF, SERIES

TILT = np.radians(5.0)


def rounded(value: float) -> float:
    return float(f"{value:.4g}")


def main(folder: Path) -> None:
    for wind in SERIES:
        file = folder / f"nrel5mw_dlc11_v{wind:02.0f}_s1.outb"
        theirs = each([read_loads(str(file)).isel(case=0).load()], TILT)
        ours = each((simulate(wind_speed=wind, seed=seed) for seed in SCATTER_OF), TILT)
        print(f"    {wind:.1f}: {{")
        for channel in CHANNELS:
            values = tuple(rounded(theirs[channel][m].mean()) for m in MEASURED)
            spread = tuple(rounded(ours[channel][m].std(ddof=1)) for m in MEASURED)
            print(f'        "{channel}": ({values}, {spread}),')
        print("    },")


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("folder", type=Path, help="with the series of OpenFAST")
    main(parser.parse_args().folder)
