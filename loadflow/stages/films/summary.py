"""The film of a series in few numbers: extremes, means, and how long its surfaces touched."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.journal.critical import Critical
from loadflow.journal.grid_bounds import UNRESOLVED
from loadflow.journal.validity import LARGEST_PRESSURE
from loadflow.quantities import GRID_ERROR, percent
from loadflow.scene.cases import Case
from loadflow.stages.films.turning import is_parked, turning
from loadflow.stages.films.whirl import whirling
from loadflow.stages.labelling import labelled
from loadflow.stages.running_time import counted, in_contact, time_shares
from loadflow.stages.summary import over_cases
from loadflow.wind.cases import stands_or_starts


def summary(parts: Mapping[Case, xr.DataTree]) -> xr.Dataset:
    """Reduce each case to extremes and weighted means; dimensions ``bearing`` and ``case``."""
    return over_cases({case: _summary_of(case, tree) for case, tree in parts.items()})


def _summary_of(case: Case, tree: xr.DataTree) -> xr.Dataset:
    nodes = [node.to_dataset().load() for node in tree.children.values()]
    how = {"parked": is_parked(case), "starts": stands_or_starts(case.dlc)}
    parts = [extremes(samples, **how).merge(mixed_friction(samples)) for samples in nodes]
    return xr.concat(parts, "bearing", combine_attrs="override").assign_coords(
        bearing=list(tree.children)
    )


EXTREMES = {
    "largest_eccentricity_ratio": ("eccentricity_ratio", np.nanargmax, "1", "largest ε"),
    "smallest_film": ("minimum_film", np.nanargmin, "m", "smallest film"),
    "largest_pressure": ("maximum_pressure", np.nanargmax, "Pa", "largest pressure"),
    "largest_sommerfeld_number": ("sommerfeld_number", np.nanargmax, "1", "largest So"),
    "largest_load": ("load", np.nanargmax, "N", "largest radial load"),
    "largest_moment": ("moment_load", np.nanargmax, "N m", "largest moment across the shaft"),
    "largest_restoring_moment": (
        "restoring_moment",
        np.nanargmax,
        "N m",
        "largest moment of films on a tilted collar",
    ),
    "largest_axial_load": ("axial_load", np.nanargmax, "N", "largest force along the shaft"),
    "largest_temperature": ("temperature", np.nanargmax, "K", "largest effective temperature"),
}
"""Extremes of a series: of what, which, units and meaning; each also has its ``_time``."""

IN_MOTION = ("maximum_pressure",)
"""Of which the extreme is one of samples in which the shaft turns: under a shaft that stands, oil
shut in between the surfaces has any pressure, and what they carry is the specific load. Where it
starts or stops, a film without asperities counts up to E_krit: beyond it they share the load."""

MEANS = {
    "mean_eccentricity_ratio": ("eccentricity_ratio", "1", "mean ε"),
    "mean_sommerfeld_number": ("sommerfeld_number", "1", "mean So"),
    "mean_friction_power": ("friction_power", "W", "mean friction power"),
    "mean_side_flow": ("side_flow", "m^3/s", "mean side flow"),
}
"""Means over samples that run and have a film, each with its weight: of what, units, meaning."""

SUPPLY = {
    "mean_supply_flow": ("supply_flow", "m^3/s", "mean flow of the grooves"),
    "mean_supply_power": ("supply_power", "W", "mean supply power"),
}
"""Means over all samples that have a film: the pump does not stop with the rotor."""


def extremes(samples: xr.Dataset, parked: bool = False, starts: bool = False) -> xr.Dataset:
    """Reduce the film of a series of weighted loads to extremes and means.

    A `parked` shaft stands, however it swings and slips in its brake. One that `starts`, or stops,
    goes through mixed friction: see `IN_MOTION`.

    Samples in contact or without an answer have no values; they are counted. Means leave out those
    in which the rotor stands or idles, where ``running`` says so.
    """
    weight, turns = samples["weight"], turning(samples, parked)
    floats = turns & ~_mixed(samples) if starts else turns
    found: dict[str, tuple[xr.DataArray, str, str]] = {}
    for name, (of, which, units, meaning) in EXTREMES.items():
        if of in samples:
            found |= _extreme(samples, name, judged(samples, of, floats), which, units, meaning)
    if "load" in samples:
        values, meaning = np.where(turns, np.nan, samples["load"].values), "largest load standing"
        found |= _extreme(samples, "standing_load", values, np.nanargmax, "N", meaning)
    found |= _grid_errors(samples, floats)
    if samples.attrs.get("motion") == "transient" and {"time", "eccentricity"} <= set(samples):
        share = (weight * whirling(samples)).where(counted(samples), 0.0).sum()
        whole = weight.where(counted(samples), 0.0).sum()
        found["whirl_share"] = share / whole, "1", "share of the time in half-speed whirl"
    for means, count in ((MEANS, counted(samples)), (SUPPLY, True)):
        for name, (of, units, meaning) in means.items():
            if of in samples:
                found[name] = samples[of].where(count).weighted(weight).mean(), units, meaning
    found |= time_shares(samples, samples["friction_power"])
    answered = samples["converged"].astype(bool)
    touching = in_contact(samples)
    residual = samples["residual"].where(~touching, 0.0)
    found |= {
        "largest_residual": (residual.max(), "1", "largest residual"),
        "not_converged": ((~answered & ~touching).sum(), "1", "samples without an answer"),
        "in_contact": (touching.sum(), "1", "samples in which shaft and shell touch"),
    }
    if "resolved" in samples:
        missed = (answered & ~touching & ~samples["resolved"].astype(bool)).sum()
        found["not_resolved"] = missed, "1", "samples whose film the cells do not resolve"
    return labelled(found)


def _mixed(samples: xr.Dataset) -> NDArray[np.bool_]:
    """Samples above E_krit of a film that knows no asperities, which share the load there."""
    if "contact_share" in samples or "eccentricity_ratio" not in samples:
        return np.zeros(samples.sizes["sample"], dtype=bool)
    return _left(samples) < 1


def _left(samples: xr.Dataset) -> NDArray[np.float64]:
    """Film that is left over that at which friction becomes mixed; below 1 it is."""
    values = (
        samples[name].values if name in samples else 0.0
        for name in ("eccentricity_ratio", "minimum_film")
    )  # fmt: skip
    return Critical.told(samples.attrs).left(*values)


def judged(samples: xr.Dataset, of: str, turns: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Values of which the extreme is taken; NaN where they do not count."""
    values = samples[of].values
    return np.where(turns, values, np.nan) if of in IN_MOTION else values


def _extreme(
    samples: xr.Dataset,
    name: str,
    values: NDArray[np.float64],
    which: Callable[[NDArray[np.float64]], Any],
    units: str,
    meaning: str,
) -> dict[str, tuple[xr.DataArray, str, str]]:
    """One extreme of `values` with its time; NaN where none is known."""
    known = np.isfinite(values)
    at = int(which(np.where(known, values, np.nan))) if known.any() else 0
    found = {name: (xr.DataArray(values[at] if known.any() else np.nan), units, meaning)}
    if "time" in samples:
        when = float(samples["time"].values[at]) if known.any() else np.nan
        found[f"{name}_time"] = xr.DataArray(when), "s", f"time of the {meaning}"
    return found


def _grid_errors(
    samples: xr.Dataset, turns: NDArray[np.bool_]
) -> dict[str, tuple[xr.DataArray, str, str]]:
    """Bounds of what the cells do to the extremes: of films at rest each its own, of a path one."""
    found = {}
    for name in ("smallest_film", "largest_pressure"):
        of, which, units, meaning = EXTREMES[name]
        values, bounds = judged(samples, of, turns), samples.get(of + GRID_ERROR)
        bound = samples.attrs.get(of + GRID_ERROR, np.nan)
        if bounds is not None and np.isfinite(values).any():
            bound = bounds.values[int(which(np.where(np.isfinite(values), values, np.nan)))]
        if bounds is not None or of + GRID_ERROR in samples.attrs:
            told = f"bound of what the cells do to the {meaning}"
            found[name + GRID_ERROR] = xr.DataArray(float(bound)), units, told
    return found


WHIRLS = 0.05
"""Share of the time that a shaft has to whirl, to be told."""


def warnings(tree: xr.DataTree) -> list[str]:
    """Say in which load cases the film is not resolved, whirls, or is beyond its equations."""
    if "journal" not in tree.children:
        return []
    table = tree["journal"].to_dataset()
    hint = "journal.contact lets asperities take a share"
    return [*_unresolved(table), *_whirls(table), *beyond_pressure(tree, "journal", hint)]


def beyond_pressure(tree: xr.DataTree, stage: str, *hints: str) -> Iterator[str]:
    """Where the pressure of films of a `stage` is beyond what oil and shell bear."""
    table = tree[stage].to_dataset() if stage in tree.children else xr.Dataset()
    if "largest_pressure" not in table:
        return
    peak = table["largest_pressure"]
    for bearing, cases, worst, largest in _where(peak > LARGEST_PRESSURE, peak):
        yield (
            f"{stage}, bearing {bearing}: the pressure is beyond what oil and shell bear, "
            f"{LARGEST_PRESSURE / 1e6:.0f} MPa, in {cases}, {largest / 1e6:,.0f} MPa in {worst}; "
            + "; ".join(["check loads and clearance", *hints])
        )


def _whirls(table: xr.Dataset) -> Iterator[str]:
    """Where a shaft whirls at half its speed, which hardly anything but the cells damps."""
    if "whirl_share" not in table:
        return
    share = table["whirl_share"]
    for bearing, cases, worst, longest in _where(share >= WHIRLS, share):
        yield (
            f"journal, bearing {bearing}: the shaft whirls at half its speed in {cases}, {worst} "
            f"for {percent(longest)} of the time; its film does not rupture, and how soon this "
            "dies, with film, pressure and friction until then, is up to the cells; more load or a "
            "lower edge_pressure lets the film rupture, which damps it"
        )


def _unresolved(table: xr.Dataset) -> Iterator[str]:
    """Where the cells do not resolve the smallest film."""
    if "smallest_film" + GRID_ERROR not in table:
        return
    share = table["smallest_film" + GRID_ERROR] / table["smallest_film"]
    missed = share >= UNRESOLVED
    if "not_resolved" in table:
        missed = missed | (table["not_resolved"] > 0)
    for bearing, cases, worst, off in _where(missed, share):
        yield (
            f"journal, bearing {bearing}: the cells do not resolve the film in {cases}; the "
            f"smallest film of {worst} is known to {percent(off)}; a finer journal.grid resolves it"
        )


def _where(so: xr.DataArray, size: xr.DataArray) -> Iterator[tuple[Any, str, Any, float]]:
    """Of each bearing of which something is `so`: in how many load cases, the worst, its size."""
    for bearing in so["bearing"].values:
        here, sizes = so.sel(bearing=bearing), size.sel(bearing=bearing)
        if here.any():
            at = int(np.argmax(np.where(here & sizes.notnull(), sizes, -1.0)))
            cases = f"{int(here.sum())} of {here.size} load cases"
            yield bearing, cases, sizes["case"].values[at], float(sizes[at])


def mixed_friction(samples: xr.Dataset) -> xr.Dataset:
    """How long and how far the shaft turns in contact and above E_krit, as [Jonuschies 2015] asks.

    Tables 5-21 and 5-22 with (5.2): the transition is where ε last crosses E_krit (in lobes and on
    pads the smallest film that of it) in a series that begins on one side of it and ends on the
    other, a start or a stop; NaN in the others. While the surfaces touch, the boundary friction of
    the whole load is lost, an upper bound, unless the film knows its asperities; above E_krit
    without contact, the friction of the film.

    A start lifts off, and a stop touches down, where contact changes for the last time. Where the
    shaft comes to a stand, `standstill_eccentricity_ratio` is the last ε in motion, and
    `film_after_stop` how much later the film is squeezed out to E_krit; negative if it is before.
    """
    time, speed, about = samples["time"].values, np.abs(samples["speed"].values), samples.attrs
    touching = samples["in_contact"].values.astype(bool)
    turns = turning(samples)
    known = np.isfinite(samples["friction_power"].values)  # in contact, too, with its asperities
    # each sample stands for `weight` steps of the full series
    weight = samples["weight"].values
    seconds = weight * (np.ptp(time) / max(weight.sum() - 1, 1))
    own = samples["eccentricity_ratio"].values if "eccentricity_ratio" in samples else 0.0
    ratio = np.where(touching, 1.0, own)
    left = np.where(touching, 0.0, _left(samples))
    mixed = turns & (touching | (left < 1))
    rubbing = about["boundary_friction"] * about["radius"] * samples["load"].values * speed
    lost = np.where(touching & ~known, rubbing, samples["friction_power"].values)
    when, at = _transition(time, speed, left)
    parted, landed = _changes(time, speed, touching)
    stood, last = _standing(time, turns, np.where(touching & ~known, np.nan, ratio))
    values: dict[str, tuple[Any, str, str]] = {
        "duration": (seconds.sum(), "s", "length of the series"),
        "contact_time": (seconds[touching & turns].sum(), "s", "time in contact while turning"),
        "mixed_friction_time": (seconds[mixed].sum(), "s", "time above E_krit while turning"),
        "mixed_friction_revolutions": (
            (seconds * speed)[mixed].sum() / (2 * np.pi), "1", "revolutions above E_krit",
        ),
        "mixed_friction_energy": (np.nansum((seconds * lost)[mixed]), "J", "friction above E_krit"),
        "transition_time": (when, "s", "time of the transition at E_krit"),
        "transition_speed": (at, "rad/s", "speed of the transition at E_krit"),
        "lift_off_time": (parted[0], "s", "time at which the surfaces part"),
        "lift_off_speed": (parted[1], "rad/s", "speed at which the surfaces part"),
        "touch_down_time": (landed[0], "s", "time at which the surfaces come to touch"),
        "touch_down_speed": (landed[1], "rad/s", "speed at which the surfaces come to touch"),
        "standstill_time": (stood, "s", "time at which the shaft comes to a stand"),
        "standstill_eccentricity_ratio": (last, "1", "ε as the shaft comes to a stand"),
        "film_after_stop": (when - stood, "s", "time from standstill to the transition at E_krit"),
    }  # fmt: skip
    return labelled(
        {name: (xr.DataArray(v), units, meaning) for name, (v, units, meaning) in values.items()}
    )


def _transition(time: np.ndarray, speed: np.ndarray, left: np.ndarray) -> tuple[float, float]:
    """Time and speed at which ε last crosses E_krit; NaN where it begins and ends on one side."""
    known = np.flatnonzero(np.isfinite(left))
    above = left[known] < 1
    if known.size < 2 or above[0] == above[-1]:
        return np.nan, np.nan
    last = int(np.flatnonzero(above[1:] != above[:-1])[-1])
    i, j = known[last], known[last + 1]
    share = (1 - left[i]) / (left[j] - left[i])
    when, at = (float(x[i] + share * (x[j] - x[i])) for x in (time, speed))
    return when, at


def _changes(
    time: np.ndarray, speed: np.ndarray, touching: np.ndarray
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Time and speed of lift-off and of touch-down; NaN where a series ends as it begins."""
    none = np.nan, np.nan
    changed = np.flatnonzero(touching[1:] != touching[:-1]) + 1
    if touching[0] == touching[-1] or not changed.size:
        return none, none
    last = int(changed[-1])
    there = float(time[last]), float(speed[last])
    return (there, none) if touching[0] else (none, there)


def _standing(time: np.ndarray, turning: np.ndarray, ratio: np.ndarray) -> tuple[float, float]:
    """When a shaft that has turned comes to a stand for good, and ε there; NaN where none does."""
    if not turning.any() or turning[-1]:
        return np.nan, np.nan
    last = int(np.flatnonzero(turning)[-1])
    return float(time[last + 1]), float(ratio[last + 1])
