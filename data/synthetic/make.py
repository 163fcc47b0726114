"""Makes the small load cubes of this folder: python data/synthetic/make.py [FOLDER]

- ``table_5_13.h5``: base loads of bearing N2 at six wind speeds, from Table 5-13 of the source.
- ``table_5_14.h5``: base load, 1p and 3p at 24 m/s, three seeds, from Tables 5-14 … 5-16.
- ``dlc_1_1.h5``: hub loads of the NREL 5 MW turbine in turbulence, two speeds, two seeds.
- ``start_stop.h5``: its start-up (DLC 3.1) and normal stop (DLC 4.1) at 12 m/s.

The angular frequencies of the tables are 1.2 times too high (a series of step 0.03 s was
transformed with 0.025 s): here they are divided by it, so that 1p is the rotor's own frequency. The
tables give no phases; all sines start at zero.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube import Cube, make_case, make_cube, save_cube
from loadflow.rotor import simulate

TOO_HIGH = 1.2
"""Printed over true frequency."""

# V m/s: n 1/min, then mean and (amplitude kN, printed frequency °/s) of Fx (down) and Fy (left)
TABLE_5_13 = {
    4: (7.20, (1373.06, (181.04, 1.76)), (24.81, (245.38, 2.20))),
    8: (10.46, (1490.81, (322.84, 3.08)), (130.04, (317.58, 1.76))),
    12: (11.89, (1670.21, (388.40, 2.64)), (155.25, (287.56, 1.32))),
    16: (12.10, (1974.87, (489.14, 3.76)), (-15.07, (507.18, 7.03))),
    20: (12.10, (2275.48, (659.54, 6.15)), (-212.01, (446.52, 7.91))),
    24: (12.10, (2584.26, (615.76, 6.59)), (-459.68, (608.10, 4.83))),
}
# the same by seed, at 24 m/s and 12.1 1/min; base load, 1p, 3p
TABLES_5_14_TO_16 = {
    1: (
        (2584.26, (615.76, 6.59), (336.02, 87.01), (204.15, 261.04)),
        (-459.68, (608.10, 4.83), (329.20, 87.01), (183.02, 265.87)),
    ),
    2: (
        (2590.62, (625.83, 13.18), (340.64, 87.01), (238.30, 256.20)),
        (-457.70, (728.74, 7.47), (370.41, 87.01), (205.97, 256.20)),
    ),
    3: (
        (3035.93, (489.43, 5.27), (339.83, 87.01), (266.35, 259.72)),
        (-216.86, (457.54, 2.19), (331.02, 87.01), (184.46, 234.67)),
    ),
}
N2 = 1.912 + 3.6  # m from the hub centre


def bearing_case(
    time: np.ndarray, wind_speed: float, seed: int, rpm: float, down: tuple, left: tuple
) -> xr.Dataset:
    """Loads of N2 as sums of sines; the source's axes turned into those of the cube."""

    def track(mean: float, *tones: tuple[float, float]) -> np.ndarray:
        waves = (a * np.sin(np.radians(omega / TOO_HIGH) * time) for a, omega in tones)
        return 1e3 * (mean + sum(waves))

    force = np.zeros((1, 3, time.size), dtype="float32")
    force[0, 1], force[0, 2] = track(*left), -track(*down)
    speed = np.full(time.size, rpm * np.pi / 30, dtype="float32")
    case = make_case(time, {"speed": speed}, dlc="1.1", wind_speed=wind_speed, seed=seed)
    return case.assign(
        force=(("bearing", "axis", "time"), force, {"units": "N", "long_name": "bearing force"})
    ).assign_coords(
        bearing=["N2"], axis=["x", "y", "z"], position=("bearing", [N2], {"units": "m"})
    )


def table_5_13() -> Cube:
    time = 1.0 * np.arange(601)
    return make_cube([bearing_case(time, v, 1, *row) for v, row in TABLE_5_13.items()])


def table_5_14() -> Cube:
    time = 0.15 * np.arange(4001)
    rows = TABLES_5_14_TO_16.items()
    return make_cube([bearing_case(time, 24, seed, 12.1, *row) for seed, row in rows])


def hub_case(dlc: str, wind_speed: float, seed: int, step: float, **settings: float) -> xr.Dataset:
    """Hub loads of the cheapest rotor, every second step of 0.05 s or so, in single precision."""
    series = simulate(
        dlc=dlc, wind_speed=wind_speed, seed=seed, dt=step / 2, rung="tables", **settings
    ).isel(time=slice(None, None, 2))
    data = {
        name: series[name].values.astype("float32")
        for name in ("speed", "pitch", "azimuth", "hub_force", "hub_moment")
    }
    time = step * np.arange(series.sizes["time"])
    return make_case(time, data, dlc=dlc, wind_speed=wind_speed, seed=seed)


def dlc_1_1() -> Cube:
    return make_cube(
        [hub_case("1.1", v, seed, 0.1, duration=100.0) for v in (8.0, 12.0) for seed in (1, 2)]
    )


def start_stop() -> Cube:
    start = hub_case("3.1", 12.0, 1, 0.1, duration=150.0, event_time=10.0)
    stop = hub_case("4.1", 12.0, 1, 0.1, duration=100.0, event_time=20.0)
    return make_cube([start, stop])


CUBES = {
    "table_5_13.h5": table_5_13,
    "table_5_14.h5": table_5_14,
    "dlc_1_1.h5": dlc_1_1,
    "start_stop.h5": start_stop,
}


def main(folder: Path) -> None:
    for name, make in CUBES.items():
        path = save_cube(make(), folder / name)
        print(f"{path}: {path.stat().st_size / 1e3:.0f} kB")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent)
