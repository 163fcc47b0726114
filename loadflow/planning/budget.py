"""Error budget of a finished run: what seeds, tolerances and models do to each answer."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.planning.accuracy import contributions
from loadflow.planning.effects import Estimates
from loadflow.quantities import percent
from loadflow.scene.scene import Scene
from loadflow.stages.registry import giving
from loadflow.stages.statistics import SLOPE
from loadflow.studies.lifetime.finished_run import known_shares
from loadflow.studies.seeds.intervals import Groups, Picks, bounds, drawn
from loadflow.studies.seeds.scatter import return_level
from loadflow.studies.tolerances import Band, band_of

Floats = NDArray[np.float64]
Statistic = Callable[[xr.Dataset, Floats, Picks], Floats]
"""From a table, values (case,) and numbers of cases (…, case) to an answer (…)."""


def _largest(table: xr.Dataset, values: Floats, some: Picks) -> Floats:
    return np.asarray(np.nanmax(values[some], axis=-1, initial=-np.inf))


def _smallest(table: xr.Dataset, values: Floats, some: Picks) -> Floats:
    return np.asarray(np.nanmin(values[some], axis=-1, initial=np.inf))


def _mean(table: xr.Dataset, values: Floats, some: Picks) -> Floats:
    weight = np.where(np.isnan(values), 0.0, _weights(table))[some]
    return np.asarray((weight * np.nan_to_num(values)[some]).sum(-1) / weight.sum(-1))


def _life(table: xr.Dataset, values: Floats, some: Picks) -> Floats:
    turns = _weights(table) * np.abs(table["mean_speed"].values)
    turns = np.where(np.isnan(values), 0.0, turns)
    damage = np.where(np.isnan(values), 0.0, turns / values)
    return np.asarray(turns[some].sum(-1) / damage[some].sum(-1))


def _damage_equivalent(table: xr.Dataset, values: Floats, some: Picks) -> Floats:
    weight = np.where(np.isnan(values), 0.0, _weights(table))[some]
    damage = np.nan_to_num(values)[some] ** SLOPE
    return np.asarray(((weight * damage).sum(-1) / weight.sum(-1)) ** (1.0 / SLOPE))


def _across(table: xr.Dataset) -> xr.DataArray | None:
    """Statistics of both components of the force across the shaft, by bearing."""
    return table["force"].sel(axis=["y", "z"]) if "force" in table else None


def _peaks(table: xr.Dataset) -> xr.DataArray | None:
    """The largest of each component of the force, either way; of both components."""
    if (force := _across(table)) is None:
        return None
    peaks = abs(force.sel(statistic=["min", "max"])).max(["statistic", "axis"])
    return peaks.assign_attrs(force.attrs)


def _ranges(table: xr.Dataset) -> xr.DataArray | None:
    """Damage-equivalent load of the component that does more damage in each bearing's life."""
    if (force := _across(table)) is None:
        return None
    found = force.sel(statistic="del")
    weight = xr.DataArray(_weights(table), dims="case")
    harder = (found**SLOPE * weight).sum("case").argmax("axis")
    return found.isel(axis=harder).assign_attrs(force.attrs)


def _weights(table: xr.Dataset) -> Floats:
    """Share of the lifetime of each case; alike where the table does not know it."""
    weight = table["weight"].values.astype(float) if "weight" in table.coords else np.array(np.nan)
    known = np.isfinite(weight).all() and np.sum(weight) > 0
    return weight if known else np.ones(table.sizes["case"])


@dataclass(frozen=True)
class _Source:
    """Where an answer stands in the tables of a run, and how it is read of all cases.

    `variable` names it in the table, or finds it there; without `read` it is the load that is
    exceeded once in 50 years, with the interval of its law. `name` is what it is called, if not as
    the quantity whose error by models it has; `measured` whether that error, and the band by
    tolerances, are its own.
    """

    result: str
    quantity: str
    stage: str
    variable: str | Callable[[xr.Dataset], xr.DataArray | None]
    read: Statistic | None
    name: str = ""
    measured: bool = True

    def found(self, table: xr.Dataset) -> xr.DataArray | None:
        """Its values by bearing and case; None where the table has none."""
        if callable(self.variable):
            return self.variable(table)
        return table.get(self.variable)


_SOURCES = (
    _Source("journal.film", "minimum film", "journal", "smallest_film", _smallest),
    _Source(
        "journal.film", "eccentricity ratio", "journal", "largest_eccentricity_ratio", _largest
    ),
    _Source("journal.film", "maximum pressure", "journal", "largest_pressure", _largest),
    _Source("journal.film", "friction power", "journal", "mean_friction_power", _mean),
    _Source("thrust.film", "minimum film", "thrust", "smallest_film", _smallest),
    _Source("thrust.film", "maximum pressure", "thrust", "largest_pressure", _largest),
    _Source("thrust.film", "friction power", "thrust", "mean_friction_power", _mean),
    _Source("rolling.loads", "maximum force", "rolling", "bearing_force", _largest),
    _Source("rolling.loads", "maximum pressure", "rolling", "bearing_pressure", _largest),
    _Source("rolling.life", "life", "rolling", "bearing_life", _life),
    _Source(  # a_ISO follows the load, too: its error is larger than that of the basic life
        "rolling.life", "life", "rolling", "bearing_modified_life", _life, "modified life", False
    ),
    _Source("rolling.friction", "friction power", "friction", "mean_friction_power", _mean),
    _Source("rolling.friction", "film parameter", "friction", "median_film_parameter", _smallest),
    _Source("rolling.friction", "slip", "friction", "mean_slip", _mean),
    _Source("loads.statistics", "bearing load max", "statistics", _peaks, _largest),
    _Source(
        "loads.statistics",
        "bearing force DEL",
        "statistics",
        _ranges,
        _damage_equivalent,
        f"bearing force DEL, m = {SLOPE:g}",
    ),
    _Source(
        "loads.statistics",
        "bearing load max",
        "statistics",
        _peaks,
        None,
        "50-year load across the shaft",
    ),
)


@dataclass(frozen=True)
class Answer:
    """An answer of a run, and how far off it may be.

    Attributes
    ----------
    result, quantity, bearing, unit : str
        What it is.
    value : float
        Of all load cases: the extreme, the mean over the lifetime, or the life.
    low, high : float
        95 % interval by a bootstrap over the seeds; NaN with one seed of each wind speed.
    error : float or None
        Relative error by models, what is left out counted; None where it was not measured.
    left_out : dict
        Effects that are left out, and the share by which each moves the answer.
    band : Band or None
        By tolerances of the bearing's values; None where none has one.
    case : str
        Load case of an extreme; empty where it is of all.
    time : float
        Its time in that case, s; NaN where it is not known.

    Examples
    --------
    >>> answer = Answer("rolling.life", "life", "M", "h", 10.0, 9.0, 12.0, 0.05)
    >>> round(answer.by_seeds, 3), answer.governed_by
    (0.2, 'seeds')
    """

    result: str
    quantity: str
    bearing: str
    unit: str
    value: float
    low: float
    high: float
    error: float | None
    left_out: Mapping[str, float] | None = None
    band: Band | None = None
    case: str = ""
    time: float = float("nan")

    @property
    def by_seeds(self) -> float:
        """Largest distance of the interval from the value, over the value; NaN without one."""
        if self.value == 0:
            return float("nan")
        return float(max(self.high - self.value, self.value - self.low) / abs(self.value))

    @property
    def governed_by(self) -> str:
        """``"seeds"``, ``"models"``, ``"tolerance of …"``, or what of these is not known."""
        if self.error is None:
            return "models: not measured"
        if np.isnan(self.by_seeds):
            return "seeds: one of each wind speed"
        sizes = {"seeds": self.by_seeds, "models": self.error}
        if self.band is not None:
            if np.isnan(self.band.largest):
                return "tolerances: no answer at an end of a band"
            sizes[f"tolerance of {self.band.governed_by}"] = self.band.largest
        return max(reversed(sizes), key=lambda name: sizes[name])


def answers(
    scene: Scene,
    tables: Mapping[str, xr.Dataset],
    errors: Mapping[str, Mapping[str, Any]],
    effects: Iterable[Mapping[str, Any]],
) -> list[Answer]:
    """Return the answers of a run with their error budget.

    Parameters
    ----------
    scene : Scene
        As it ran.
    tables : mapping
        Tables of the run over ``case``, by stage.
    errors : mapping
        Expected error by result and quantity; what is no number was not measured.
    effects : iterable of mapping
        All effects of the plan, with `name`, `size` and `indicator`.

    Returns
    -------
    list of Answer
        One for each result, quantity and bearing.
    """
    sizes = {one["name"]: one["size"] or one["indicator"] or {} for one in effects}
    return [
        answer
        for source in _SOURCES
        if source.result in scene.results and source.stage in tables
        for answer in _of(source, scene, tables, errors, Estimates(sizes))
    ]


def _shared(tables: Mapping[str, xr.Dataset], source: _Source) -> xr.Dataset:
    """The table of an answer; its cases weigh what the lifetime of the run gave them, if it did.

    The weights of the cases themselves are of 1 within each design load case.
    """
    table = tables[source.stage]
    share = known_shares(tables, table)
    return table if share is None else table.assign_coords(weight=("case", share))


def _of(
    source: _Source,
    scene: Scene,
    tables: Mapping[str, xr.Dataset],
    errors: Mapping[str, Mapping[str, Any]],
    known: Estimates,
) -> Iterator[Answer]:
    table = _shared(tables, source)
    if (rows := source.found(table)) is None:
        return
    groups = Groups.of(table)
    several = max(groups.sizes, default=0) > 1 and source.read is not None
    picks = drawn(groups) if several else None  # one seed tells nothing
    found = rows.transpose("bearing", "case")
    error = errors.get(source.result, {}).get(source.quantity) if source.measured else None
    missing = _left_out(source, scene, known)
    for bearing in found["bearing"].values:
        values = found.sel(bearing=bearing).values.astype(float)
        if np.isnan(values).all():
            continue
        whole = _whole(source, table, groups, values, picks)
        if whole is None:
            continue
        value, low, high = whole
        yield Answer(
            source.result,
            source.name or source.quantity,
            str(bearing),
            str(found.attrs.get("units", "1")),
            value,
            low,
            high,
            float(error) if isinstance(error, (int, float)) else None,
            missing,
            band_of(tables, source.stage, str(bearing), source.quantity)
            if source.measured
            else None,
            *_moment(source, table, str(bearing), values),
        )


def _moment(source: _Source, table: xr.Dataset, bearing: str, values: Floats) -> tuple[str, float]:
    """Load case of an extreme over all cases, and its time where that is known."""
    if source.read not in (_largest, _smallest):
        return "", float("nan")
    at = np.nanargmax(values) if source.read is _largest else np.nanargmin(values)
    case, name = str(table["case"].values[at]), f"{source.variable}_time"
    known = name in table
    return case, float(table[name].sel(bearing=bearing, case=case)) if known else float("nan")


def _whole(
    source: _Source, table: xr.Dataset, groups: Groups, values: Floats, picks: Picks | None
) -> tuple[float, float, float] | None:
    """An answer of all cases and its interval; None where there are too few seeds for a law.

    A law needs three seeds of every wind speed: without one of them the largest load may be left
    out, and the level lie below it.
    """
    if source.read is None:
        if min(groups.sizes, default=0) < 3:
            return None
        length = float(np.median(table["length"].values)) if "length" in table.coords else 600.0
        weight = _weights(table)
        level = return_level(groups, weight / weight.sum(), values, length)
        return None if level is None else (level.value, level.low, level.high)
    read = partial(source.read, table, values)
    low, high = (np.nan, np.nan) if picks is None else bounds(read(picks), groups)
    return float(read(np.arange(values.size))), low, high


def _left_out(source: _Source, scene: Scene, known: Estimates) -> dict[str, float]:
    """Effects that are left out, and by how much each moves the answer."""
    links = giving(source.result).results[source.result](scene).get(source.quantity, ())
    found: dict[str, float] = {}
    for part in contributions(scene, source.result, source.quantity, links, known):
        if part.effect is not None and part.share is not None:
            found[part.effect.name] = found.get(part.effect.name, 0.0) + part.share
    return found


def more_seeds(found: Iterable[Answer], allowed: Callable[[str], float]) -> str:
    """Say of which answers more seeds would tell more than better models; empty if of none.

    Parameters
    ----------
    found : iterable of Answer
        Of a run.
    allowed : callable
        From a result to the accuracy that is asked for; seeds below it are enough.
    """
    worst: dict[str, float] = {}
    for one in found:
        if one.governed_by == "seeds" and one.by_seeds > allowed(one.result):
            worst[one.quantity] = max(worst.get(one.quantity, 0.0), one.by_seeds)
    if not worst:
        return ""
    told = ", ".join(f"{name} (±{percent(share)})" for name, share in worst.items())
    return f"More seeds would tell more than better models of: {told}."
