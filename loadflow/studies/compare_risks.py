"""What wears bearings out beside fatigue: contact of films, light loads, thin films, standing."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import open_cube
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Scene
from loadflow.stages.film_summary import STANDING
from loadflow.stages.frames import to_rolling
from loadflow.stages.rolling import rest
from loadflow.studies.compare_result import Number
from loadflow.tribology import Archard

WEAR = Archard(1e-16)
"""Wear of white metal on steel in boundary friction, m²/N; assumed, coefficients of one pair of
materials differ by 2 … 5 from batch to batch."""

YEARS = 20.0
_SECONDS = YEARS * 8766.0 * 3600.0

STARTS = 20_000
"""Starts in the life of a turbine, and stops: the design count of test benches
of segmented conical bearings, as the trade press tells; assumed."""

WORN_SHARE = 0.1
"""Of the radial clearance that may wear off; assumed."""

LIGHT = {"ball": 0.01, "roller": 0.02}
"""Smallest load over the dynamic capacity at which elements roll without skidding: the rule of
thumb of bearing catalogues."""

THINNEST = 0.1
"""Smallest viscosity ratio κ that ISO 281 covers."""


def wear(scene: Scene, table: xr.Dataset, share: np.ndarray) -> Number:
    """Depth that shells wear in 20 years while turning in mixed friction, an upper bound, µm.

    The whole load is taken to be carried by asperities, on the projected area, over the way that
    each load case turns above E_krit or in contact; the largest load of the case stands for all.
    Load cases of starts and stops count `STARTS` times, the others by their share of the lifetime.
    """
    worst: tuple[float, str, str, float] = (-1.0, "", "", math.nan)
    for place in table["bearing"].values.tolist():
        one, own = scene.journal.at(place), table.sel(bearing=place)
        deep = _worn(one, own) * np.where(_of_kind(own, "34"), 0.0, share) + _of_events(one, own)
        depth = float(deep.sum())
        if depth > worst[0]:
            case = str(own["case"].values[int(np.argmax(deep))]) if depth > 0 else ""
            worst = depth, place, case, WORN_SHARE * one.geometry.clearance
    depth, place, case, limit = worst
    touching = table["in_contact"].sum("bearing") > 0
    note = f"k = {WEAR.coefficient:g} m²/N; limit: a tenth of the radial clearance, both assumed"
    if bool(touching.any()):
        note += f"; surfaces touch in {int(touching.sum())} load cases"
    starts = _of_kind(table, "34").any()
    note += f"; {STARTS} starts or stops" if starts else "; no start or stop in this run"
    return Number(
        1e6 * depth, "µm", limit=1e6 * limit, holds=bool(depth <= limit), case=case, place=place,
        note=note,
    )  # fmt: skip


def _worn(one: Journal, table: xr.Dataset) -> np.ndarray:
    """Depth (case,) in 20 years if each load case lasted that long, m."""
    return _depth(one, table) * _SECONDS / table["duration"].values


def _depth(one: Journal, table: xr.Dataset) -> np.ndarray:
    """Depth (case,) that each load case wears, m."""
    size, turns = one.geometry, table["mixed_friction_revolutions"].values
    pressure = table["largest_load"].fillna(0.0).values / (size.diameter * size.width)
    return WEAR.depth(pressure, np.pi * size.diameter * turns)


def _of_events(one: Journal, table: xr.Dataset) -> np.ndarray:
    """Part (case,) of the depth that `STARTS` starts and as many stops wear, m."""
    depth = _depth(one, table)
    found = np.zeros_like(depth)
    for kind in ("3", "4"):
        own = _of_kind(table, kind)
        if own.any():
            found[own] += STARTS * depth[own] / own.sum()
    return found


def _of_kind(table: xr.Dataset, kinds: str) -> np.ndarray:
    """Which load cases are starts (3) or stops (4)."""
    return np.array([dlc[:1] in kinds for dlc in table["dlc"].values.tolist()], bool)


def rolling_risks(
    scene: Scene, folder: Path, table: xr.Dataset, share: np.ndarray
) -> Iterator[tuple[str, Number]]:
    """Yield smallest load, smallest viscosity ratio, and standstill of rolling bearings."""
    yield "minimum_load", _lightest(scene, folder)
    ratio = table["bearing_viscosity_ratio"].transpose("case", "bearing").values.astype(float)
    if np.isfinite(ratio).any():
        k, b = np.unravel_index(int(np.nanargmin(ratio)), ratio.shape)
        yield "viscosity_ratio", Number(
            float(ratio[k, b]), "–", limit=THINNEST, holds=bool(ratio[k, b] >= THINNEST),
            case=str(table["case"].values[k]), place=str(table["bearing"].values[b]),
            note="κ of what turns; ISO 281 ends at 0.1, full films begin at 1",
        )  # fmt: skip
    yield "standstill", _standing(scene, folder, table, share)


def _lightest(scene: Scene, folder: Path) -> Number:
    """Smallest equivalent load over the capacity while the shaft turns."""
    least, light, total = (math.inf, "", "", math.nan, 0.0), 0.0, 0.0
    for place, case, some in _samples(scene, folder):
        bearing = scene.rolling.geometries[place]
        turning = np.abs(some["speed"].values) >= STANDING
        load = _equilibrium(scene, place, some).equivalent_load / bearing.rated_capacity
        load = np.where(turning, load, np.inf)
        weight, limit = some["weight"].values, LIGHT[bearing.element]
        total += float(weight[turning].sum())
        light += float(weight[turning & (load < limit)].sum())
        k = int(np.argmin(load))
        if load[k] / limit < least[0]:
            least = float(load[k] / limit), place, case, float(some["time"].values[k]), limit
    if not math.isfinite(least[0]):
        return Number(math.nan, "%", note="the shaft does not turn")
    ratio, place, case, time, limit = least
    return Number(
        100 * ratio * limit, "%", limit=100 * limit, holds=ratio >= 1, case=case, time=time,
        place=place, note=f"of C; below the limit in {100 * light / total:.2g} % of the samples",
    )  # fmt: skip


def _standing(scene: Scene, folder: Path, table: xr.Dataset, share: np.ndarray) -> Number:
    """Share of the lifetime in which the shaft stands, and the largest pressure meanwhile."""
    stands, worst = np.zeros(table.sizes["case"]), (0.0, "", "", math.nan)
    for k, case in enumerate(table["case"].values.tolist()):
        series: Any = open_cube(folder / "loads" / f"{case}.h5")
        stands[k] = float((np.abs(series["speed"].values) < STANDING).mean())
    for place, case, some in _samples(scene, folder):
        still = np.abs(some["speed"].values) < STANDING
        if still.any():
            pressure = _equilibrium(scene, place, some).maximum_pressure
            k = int(np.argmax(np.where(still, pressure, -np.inf)))
            if pressure[k] > worst[0]:
                worst = float(pressure[k]), place, case, float(some["time"].values[k])
    pressure, place, case, time = worst
    told = f"largest contact pressure meanwhile {1e-6 * pressure:.0f} MPa" if case else ""
    if not stands.any():
        told = "no load case of this run stands: marks of standing are not judged"
    return Number(
        100 * float((stands * share).sum()), "%", case=case, time=time, place=place, note=told
    )


def _samples(scene: Scene, folder: Path) -> Iterator[tuple[str, str, xr.Dataset]]:
    """Yield place, case and reduced samples of all rolling bearings that turn with the rotor."""
    for place, part in scene.rolling.bearings.items():
        if part.oscillation is not None:
            continue
        for path in sorted((folder / "reduction").glob("*.h5")):
            samples = open_cube(path)[place].to_dataset().load()
            radial = to_rolling(samples["force"].transpose("sample", "axis").values)
            size = np.linalg.norm(radial, axis=1)
            speed = np.abs(samples["speed"].values)
            order = {int(np.argmin(size)), int(np.argmin(speed)), int(np.argmax(size))}
            spread = np.linspace(0, samples.sizes["sample"] - 1, _SPREAD).round().astype(int)
            yield place, path.stem, samples.isel(sample=sorted({*spread.tolist(), *order}))


_SPREAD = 12


def _equilibrium(scene: Scene, place: str, some: xr.Dataset) -> Any:
    force, moment = (
        some[name].transpose("sample", "axis").values.astype(float) for name in ("force", "moment")
    )
    return rest(scene.rolling.bearings[place], force, moment, strict=False)
