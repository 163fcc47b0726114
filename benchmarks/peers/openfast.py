"""Turbulent loads of the NREL 5 MW beside OpenFAST series: what deviates, and what is noise.

Other winds on either side, so both scatter. Of each measure are printed the means over the seeds
and their ratio with its standard error, from the scatter of our seeds; those of OpenFAST, one to
three, are taken to scatter alike. Then the same ratio at their wind: our measures as a linear
function of the mean and the standard deviation of the hub wind, fitted over our seeds and taken at
the hub winds of OpenFAST. A star marks what is further than two errors from one; of the measures
of two models that agree one in twenty has it.

Run: python -m benchmarks.peers.openfast FOLDER [--seeds N] [--winds V …] [--lateral independent]
"""

from pathlib import Path

import numpy as np

from benchmarks.common import arguments
from loadflow.readers import read_loads
from loadflow.rotor import simulate
from loadflow.validation._load_series import each
from loadflow.wind import WindOptions

TILT = np.radians(5.0)


def ratio(ours, theirs):
    """Ratio of the means, and its standard error."""
    spread = ours.std(ddof=1) * np.sqrt(1 / ours.size + 1 / theirs.size)
    return ours.mean() / theirs.mean(), spread / abs(theirs.mean())


def ratio_at_wind(ours, theirs, our_wind, their_wind):
    """The same with ours at the hub winds of the others; winds (seeds, 2): mean, deviation."""
    basis = np.column_stack([np.ones(ours.size), our_wind])
    place = np.append(1.0, their_wind.mean(axis=0))
    law = np.linalg.lstsq(basis, ours, rcond=None)[0]
    rest = ours - basis @ law
    lever = place @ np.linalg.solve(basis.T @ basis, place)
    spread = np.sqrt(rest @ rest / (ours.size - place.size) * (lever + 1 / theirs.size))
    return place @ law / theirs.mean(), spread / abs(theirs.mean())


def cell(value, error):
    return f"{value:8.3f} ± {error:5.3f} {'*' if abs(value - 1) > 2 * error else ' '}"


def main(folder, seeds, winds, lateral):
    options = WindOptions(lateral=lateral)
    for wind in winds:
        files = sorted(Path(folder).glob(f"nrel5mw_dlc11_v{wind:02d}_s*.outb"))
        theirs = each((read_loads(str(file)).isel(case=0).load() for file in files), TILT)
        ours = each(
            (simulate(wind_speed=wind, seed=s, wind_options=options) for s in range(1, seeds + 1)),
            TILT,
        )
        hub = [np.column_stack([x["wind"][m] for m in ("mean", "std")]) for x in (ours, theirs)]
        print(f"\n{wind} m/s, kN and kN m, {seeds} seeds / {len(files)} of OpenFAST")
        print(f"{'':28s}{'ours':>10s}{'OpenFAST':>10s}   ratio              at their hub wind")
        for channel, measures in ours.items():
            if channel not in theirs:  # what a cube of files does not hold
                continue
            for name, values in measures.items():
                other = theirs[channel][name]
                print(
                    f"  {channel:13s}{name:13s}{values.mean():10.4g}{other.mean():10.4g}",
                    cell(*ratio(values, other)),
                    cell(*ratio_at_wind(values, other, *hub)) if channel != "wind" else "",
                    flush=True,
                )


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("folder")
    parser.add_argument("--seeds", type=int, default=30, help="at least 5")
    parser.add_argument("--winds", type=int, nargs="+", default=[4, 8, 12, 24])
    parser.add_argument("--lateral", default="coherent", choices=("coherent", "independent"))
    main(**vars(parser.parse_args()))
