"""Why the moments of the NREL 5 MW differ from OpenFAST's at 24 m/s: the suspects one by one.

In pairs, so that the noise of the winds drops out: each seed has one fine field of our own, on
33 × 33 points over 145 × 145 m. It is passed through the grid of their wind (17 × 17 points, every
0.05 s, linear interpolation), made with v and w of each point by itself, and met by the rotor with
one switch of its model changed at a time. Printed: ratio of the measures to those of the fine field
and the default rotor, mean over the seeds with its standard error; with a folder of OpenFAST series
also the ratio of each to those.
Run: python -m benchmarks.references.suspects [--wind 24] [--seeds 6] [--folder FOLDER]
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from benchmarks.common import arguments
from benchmarks.references.wind_grids import HUB_HEIGHT, RADIUS, TILT, thinned
from loadflow.readers import read_loads
from loadflow.rotor import RotorOptions, simulate
from loadflow.validation._load_series import each
from loadflow.wind import CoherenceFactors, case_seed, iec, kaimal_box, polar_angles
from loadflow.wind.coherence import PointGrid

RUN_IN, DURATION, STEP, POINTS = 60.0, 600.0, 0.05, 33
CHANNELS, SHOWN = (
    ("thrust", "tilt moment", "yaw moment"),
    ("std", "0.1 … 0.5 Hz", "3p", "DEL m = 4"),
)

ROTORS = {
    "with dynamic inflow": {"dynamic_inflow": True},
    "with dynamic stall": {"dynamic_stall": True},
    "without unsteady attached flow": {"shed_wake": False},
    "without the turn of bent blades": {"bend_twist": 0.0},
    "skew by steady theory": {"skew_factor": 15 * np.pi / 64},
    "no tower in the wind": {"tower_dam": False},
}


def polar(box):
    """The box on the points that the rotor asks, linearly interpolated."""
    return box.to_polar(np.linspace(0.0, RADIUS, 22), polar_angles(96))


def winds(wind_speed, seeds):
    """Of each seed: the fine field, thinned, and thinned with independent v and w."""
    across = np.linspace(-72.5, 72.5, POINTS)
    points = np.meshgrid(across, HUB_HEIGHT + across, indexing="ij")
    factors = CoherenceFactors(PointGrid(*(p.ravel() for p in points)), 42.0, knots=40)
    sigma = float(iec.ntm_sigma(wind_speed, "B"))
    axes = {"y": across, "z": HUB_HEIGHT + across}
    for seed in range(1, seeds + 1):
        same = {
            "hub_height": HUB_HEIGHT,
            "duration": DURATION + RUN_IN + 20.0,
            "dt": STEP,
            "seed": case_seed("1.1", wind_speed, seed, base=1),
            "factors": factors,
        }
        fine = kaimal_box(wind_speed, sigma, **axes, **same)
        apart = kaimal_box(wind_speed, sigma, **axes, **same, lateral="independent")
        yield (
            seed,
            {
                "fine": polar(fine),
                "17 × 17 points": polar(thinned(fine, 2, **axes)),
                "v and w of each point by itself": polar(apart),
                "both: their wind": polar(thinned(apart, 2, **axes)),
            },
        )


def loads(wind_speed, field, **switches):
    """Series of the rotor in a field."""
    options = replace(RotorOptions(), **switches)
    return simulate(
        wind_speed=wind_speed, field=field, duration=DURATION, run_in=RUN_IN, options=options
    )


def measured(wind_speed, seeds):
    """Measures of every suspect, by name, a list over the seeds."""
    found = {}
    for seed, fields in winds(wind_speed, seeds):
        runs = {name: loads(wind_speed, field) for name, field in fields.items()}
        runs |= {
            name: loads(wind_speed, fields["fine"], **switch) for name, switch in ROTORS.items()
        }
        for name, series in runs.items():
            found.setdefault(name, []).append(each([series], TILT))
        print(f"seed {seed}", flush=True)
    return found


def values(found, channel, measure):
    """A measure over the seeds."""
    return np.array([one[channel][measure][0] for one in found])


def main(wind, seeds, folder):
    """Print the ratios."""
    found = measured(wind, seeds)
    base = found["fine"]
    for name, ours in found.items():
        print(f"\n{name} / fine, {wind:g} m/s, {seeds} seeds")
        for channel in CHANNELS:
            cells = []
            for measure in SHOWN:
                change = np.log(values(ours, channel, measure) / values(base, channel, measure))
                error = change.std(ddof=1) / np.sqrt(seeds)
                cells.append(f"{measure} {np.exp(change.mean()):.3f} ± {error:.3f}")
            print(f"  {channel:13s}", "  ".join(cells))
    if folder is None:
        return
    files = sorted(Path(folder).glob(f"nrel5mw_dlc11_v{wind:02.0f}_s*.outb"))
    theirs = each((read_loads(str(file)).isel(case=0).load() for file in files), TILT)
    for name, ours in found.items():
        print(f"\n{name} / OpenFAST, {len(files)} seeds of theirs")
        for channel in CHANNELS:
            cells = []
            for measure in SHOWN:
                mine, other = values(ours, channel, measure), theirs[channel][measure]
                spread = mine.std(ddof=1) * np.sqrt(1 / mine.size + 1 / other.size)
                cells.append(
                    f"{measure} {mine.mean() / other.mean():.2f} ± {spread / other.mean():.2f}"
                )
            print(f"  {channel:13s}", "  ".join(cells))


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("--wind", type=float, default=24.0, help="m/s")
    parser.add_argument("--seeds", type=int, default=6, help="at least 2")
    parser.add_argument("--folder", help="of OpenFAST series")
    main(**vars(parser.parse_args()))
