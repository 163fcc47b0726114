"""Whether a shaft turns: films of one that stands are those of what it rests on."""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.scene.cases import Case, design_load_cases
from loadflow.scene.scene import Scene
from loadflow.wind.cases import parked, stands_or_starts, starts_or_stops

SLOWEST = 0.01 * np.pi / 30
"""Speed, rad/s, below which a shaft counts as standing: 0.01 1/min, the last digit of Table 5-22 in
[Jonuschies 2015]."""

SWING = 0.2
"""Angle, rad, within which a shaft that stands may swing: a brake holds it by an elastic
drivetrain, and slips in gusts (0.14 rad in 36 s after a fault at 24 m/s). So short an arc, beside
the loaded one of some π, draws no film in: the surfaces rest on each other."""


def is_parked(case: Case) -> bool:
    """Whether a brake holds the shaft throughout, though a storm may pull it through its brake."""
    return parked(case.dlc)


def always_turns(scene: Scene) -> bool:
    """Whether the rotor turns through all load cases, as far as names tell what given ones are."""
    return not any(map(stands_or_starts, design_load_cases(scene)))


def comes_from_or_to_standstill(scene: Scene) -> bool:
    """Whether the rotor starts, or stops, in some load case."""
    return any(map(starts_or_stops, design_load_cases(scene)))


def carried_throughout(scene: Scene) -> bool:
    """Whether films carry the shaft through all load cases: it turns, or asperities carry it."""
    films = map(scene.journal.at, scene.journal.bearings)
    return always_turns(scene) or all(film.contact is not None for film in films)


def runs_throughout(table: xr.Dataset) -> NDArray[np.bool_]:
    """Load cases of a table in which a film is to part the surfaces from beginning to end.

    Where the shaft stands, starts or stops it rests on them, or rubs, as it must.
    """
    return np.array([not stands_or_starts(str(dlc)) for dlc in table["dlc"].values], dtype=bool)


def of_running(table: xr.Dataset) -> xr.Dataset:
    """A table of films with films and contact of load cases whose shaft runs throughout alone.

    In the others smallest film and largest ε are NaN, and no sample counts as in contact.
    """
    runs = xr.DataArray(runs_throughout(table), dims="case")
    films = [name for name in ("smallest_film", "largest_eccentricity_ratio") if name in table]
    masked = {name: table[name].where(runs) for name in films}
    return table.assign(masked | {"in_contact": table["in_contact"].where(runs, 0)})


def turning(samples: xr.Dataset, parked: bool = False) -> NDArray[np.bool_]:
    """Whether the shaft turns, at each sample: one that swings in its brake stands.

    A `parked` one stands, however it swings and slips. Without a ``speed`` it turns.
    """
    if "speed" not in samples:
        return np.full(samples["converged"].shape, not parked)
    speed = samples["speed"].values
    moves = (np.abs(speed) >= SLOWEST) & (not parked)
    if "time" in samples:
        moves &= ~_swinging(samples["time"].values, speed)
    return np.asarray(moves)


def _swinging(time: np.ndarray, speed: np.ndarray) -> NDArray[np.bool_]:
    """From where on a shaft has turned back and only swings, to the end of the series."""
    turned = np.append(0.0, np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time)))
    most, least = (of.accumulate(turned[::-1])[::-1] for of in (np.maximum, np.minimum))
    back = np.append(False, speed[1:] * speed[:-1] < 0.0) & (most - least < SWING)
    return np.asarray(np.logical_or.accumulate(back))
