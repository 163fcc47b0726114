"""Turbulent loads of the NREL 5 MW beside OpenFAST series: statistics, spectra, fatigue, extremes.

Other winds on either side, so both scatter; printed are means over the seeds and their ratio.
Run: python benchmarks/loads_openfast.py FOLDER [seeds] [wind speed …]
"""

import sys
from pathlib import Path

import numpy as np

from loadflow.readers import read_loads
from loadflow.rotor import simulate
from loadflow.validation._load_series import compare

TILT = np.radians(5.0)


def main(folder, seeds, winds):
    for wind in winds:
        files = sorted(Path(folder).glob(f"nrel5mw_dlc11_v{wind:02d}_s*.outb"))
        theirs = compare([read_loads(str(file)).isel(case=0).load() for file in files], TILT)
        ours = compare([simulate(wind_speed=wind, seed=s) for s in range(1, seeds + 1)], TILT)
        print(f"\n{wind} m/s, kN and kN m, {seeds} seeds / {len(files)} of OpenFAST (ratio)")
        for channel, values in ours.items():
            other = theirs[channel]
            cells = [f"{m} {v:.4g}/{other[m]:.4g} ({v / other[m]:.2f})" for m, v in values.items()]
            print(f"  {channel:12s}", "  ".join(cells), flush=True)


if __name__ == "__main__":
    arguments = sys.argv[1:]
    main(
        arguments[0],
        int(arguments[1]) if len(arguments) > 1 else 6,
        [int(v) for v in arguments[2:]] or [4, 8, 12, 24],
    )
