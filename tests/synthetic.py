"""Small load cubes for tests: physics in miniature, made in milliseconds."""

import numpy as np
import xarray as xr

from loadflow.cube import make_case, make_cube, save_cube


def case(wind_speed, seed, steps=400, dt=0.25):
    """One case: a weight, a thrust, and moments that wander."""
    rng = np.random.default_rng([int(10 * wind_speed), seed])
    time = dt * np.arange(steps)

    def wander(mean, size):
        phase = rng.uniform(0, 2 * np.pi, 6)
        frequency = rng.uniform(0.02, 0.6, 6)
        waves = np.sin(2 * np.pi * np.outer(frequency, time) + phase[:, None])
        return mean + size / 3 * waves.sum(axis=0)

    force = np.stack([wander(5e5, 5e4), wander(0, 4e4), wander(-1.07e6, 6e4)])
    moment = np.stack([wander(4e6, 1e5), wander(1e6, 8e5), wander(4e5, 8e5)])
    return make_case(
        time,
        {
            "speed": wander(1.2, 0.02),
            "pitch": wander(0.1, 0.02),
            "azimuth": np.mod(1.2 * time, 2 * np.pi),
            "wind": wander(wind_speed, 1.0),
            "hub_force": force,
            "hub_moment": moment,
        },
        dlc="1.1",
        wind_speed=wind_speed,
        seed=seed,
    )


def cube_file(path, wind_speeds=(8.0, 12.0), seeds=(1, 2), **keys):
    """Write a cube of such cases."""
    cases: list[xr.Dataset] = [case(v, s, **keys) for v in wind_speeds for s in seeds]
    return save_cube(make_cube(cases), path)
