"""What the grid of the wind and the coherence of v and w change of the loads of the NREL 5 MW.

In pairs, so that the noise of the winds drops out: one fine field thinned to every second, third or
fourth line, and one seed with v and w coherent or of each point by itself. Printed: ratio of the
measures to those of the first of each table, mean over the seeds with its standard error.
Run: python -m benchmarks.references.wind_grids [wind speed] [seeds]
"""

from dataclasses import replace

import numpy as np

from benchmarks.common import arguments
from loadflow.rotor import simulate
from loadflow.validation._load_series import each
from loadflow.wind import (
    CoherenceFactors,
    PolarGrid,
    WindOptions,
    case_seed,
    iec,
    kaimal,
    kaimal_box,
    polar_angles,
)
from loadflow.wind.coherence import PointGrid

HUB_HEIGHT, RADIUS, RUN_IN, DURATION, STEP = 90.0, 63.0, 45.0, 300.0, 0.05
TILT = np.radians(5.0)
SHOWN = ("std", "0.1 … 0.5 Hz", "3p", "DEL m = 4")


def thinned(field, step, **axes):
    """Every `step`-th line of both axes."""
    parts = {
        name: np.ascontiguousarray(getattr(field, name)[:, ::step, ::step])
        for name in ("u", "v", "w")
    }
    return replace(field, **parts, **{name: axis[::step] for name, axis in axes.items()})


def loads(wind_speed, field):
    return simulate(
        wind_speed=wind_speed, field=field, duration=DURATION - RUN_IN - 5.0, run_in=RUN_IN
    )


def common(wind_speed, seed):
    return {
        "hub_height": HUB_HEIGHT,
        "duration": DURATION,
        "dt": STEP,
        "seed": case_seed("1.1", wind_speed, seed, base=1),
    }


def polar_grids(wind_speed, sigma, seeds):
    """41 radii and 192 angles, half, a quarter."""
    radius, angle = np.linspace(0.0, RADIUS, 41), polar_angles(192)
    factors = CoherenceFactors(PolarGrid(radius, angle), 42.0, knots=32)
    for seed in seeds:
        fine = kaimal(
            wind_speed,
            sigma,
            radius=radius,
            angles=angle,
            factors=factors,
            **common(wind_speed, seed),
        )
        for step in (1, 2, 4):
            name = f"{41 // step + 1 if step > 1 else 41} × {192 // step}"
            yield name, loads(wind_speed, thinned(fine, step, radius=radius, angle=angle))


def square_grids(wind_speed, sigma, seeds):
    """Spacings of 5, 10 and 15 m over 150 m, sampled bilinearly."""
    y = np.linspace(-75.0, 75.0, 31)
    points = np.meshgrid(y, HUB_HEIGHT + y, indexing="ij")
    factors = CoherenceFactors(PointGrid(*(p.ravel() for p in points)), 42.0, knots=40)
    for seed in seeds:
        fine = kaimal_box(
            wind_speed, sigma, y=y, z=HUB_HEIGHT + y, factors=factors, **common(wind_speed, seed)
        )
        for step in (1, 2, 3):
            box = thinned(fine, step, y=y, z=HUB_HEIGHT + y)
            field = box.to_polar(np.linspace(0.0, RADIUS, 22), polar_angles(96))
            yield f"{5 * step} m", loads(wind_speed, field)


def coherences(wind_speed, sigma, seeds):
    """v and w coherent, or of each point by itself; `sigma` is that of category B."""
    for seed in seeds:
        for lateral in ("coherent", "independent"):
            yield (
                lateral,
                simulate(
                    wind_speed=wind_speed, seed=seed, wind_options=WindOptions(lateral=lateral)
                ),
            )


def main(wind_speed, count):
    sigma = float(iec.ntm_sigma(wind_speed, "B"))
    for table in (polar_grids, square_grids, coherences):
        runs = {}
        for name, series in table(wind_speed, sigma, range(1, count + 1)):
            runs.setdefault(name, []).append(each([series], TILT))
        first = next(iter(runs))
        for name in list(runs)[1:]:
            print(f"\n{wind_speed:g} m/s, {name} / {first}, {count} seeds")
            for channel in ("thrust", "tilt moment", "yaw moment"):
                cells = []
                for measure in SHOWN:
                    mine, other = (
                        np.array([run[channel][measure][0] for run in runs[n]])
                        for n in (name, first)
                    )
                    change = np.log(mine / other)
                    error = change.std(ddof=1) / np.sqrt(count)
                    cells.append(f"{measure} {np.exp(change.mean()):.3f} ± {error:.3f}")
                print(f"  {channel:13s}", "  ".join(cells), flush=True)


if __name__ == "__main__":
    parser = arguments(__doc__)
    parser.add_argument("wind_speed", type=float, nargs="?", default=12.0, help="m/s")
    parser.add_argument("count", type=int, nargs="?", default=4, help="seeds")
    main(**vars(parser.parse_args()))
