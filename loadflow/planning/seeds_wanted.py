"""How many seeds a scene's answers take, and whether more seeds would tell more than better models.

Of a scene that has run, by the scatter between its own seeds; of others by that of the main job
(``loadflow/data/seed_scatter.json``), which tells the order of magnitude.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.data import seed_scatter
from loadflow.planning.plan import Plan
from loadflow.quantities import percent
from loadflow.scene.scene import Scene
from loadflow.studies.lifetime.finished_run import known_shares
from loadflow.studies.seeds.intervals import Groups
from loadflow.studies.seeds.scatter import ANSWERS, scatter_of_one_seed, table_of_cases
from loadflow.wind.cases import row_of

WANTED = 0.05
"""Half width of the intervals that seeds are counted for, where the scene asks for no accuracy."""

_SUMS = ("damage-equivalent load", "life")
"""Answers to which all wind speeds, and all of a series, contribute."""


@dataclass(frozen=True)
class SeedsWanted:
    """Seeds that an answer takes.

    Attributes
    ----------
    answer : str
        One of `loadflow.studies.seeds.scatter.ANSWERS`.
    interval : float
        Half width of its 95 % interval with the seeds of the scene, over the answer.
    by_models : float or None
        Its relative error by models; None where it is not known.
    wanted : float
        Half width that the seeds are counted for.
    seeds : int
        Seeds of each wind speed that it takes.
    seconds : float or None
        Expected processor time of the run with so many; None where it is not known.
    measured : bool
        Whether the scatter is that of the scene's own seeds.

    Examples
    --------
    >>> one = SeedsWanted("life", 0.08, 0.03, 0.05, 16, 1200.0, True)
    >>> one.governed_by_seeds, one.sentence
    (True, 'life ±8 %, 16 seeds (1200 s)')
    """

    answer: str
    interval: float
    by_models: float | None
    wanted: float
    seeds: int
    seconds: float | None
    measured: bool

    @property
    def governed_by_seeds(self) -> bool:
        """Whether more seeds would tell more than better models."""
        return self.interval > self.wanted and (
            self.by_models is None or self.interval > self.by_models
        )

    @property
    def sentence(self) -> str:
        """Interval, seeds and time."""
        seeds = "1 seed" if self.seeds == 1 else f"{self.seeds} seeds"
        time = "" if self.seconds is None else f" ({self.seconds:.0f} s)"
        return f"{self.answer} ±{percent(self.interval)}, {seeds}{time}"


def seeds_wanted(
    plan: Plan, tables: Mapping[str, xr.Dataset] | None = None, wanted: float | None = None
) -> list[SeedsWanted]:
    """Return how many seeds the answers of a plan take.

    Parameters
    ----------
    plan : Plan
        Of the scene.
    tables : mapping, optional
        Results of a finished run of it by stage, whose own seeds then tell.
    wanted : float, optional
        Half width of the intervals; default the accuracy that the scene asks for, or `WANTED`.

    Returns
    -------
    list of SeedsWanted
        Empty where no load case is turbulent, or each is given.
    """
    scene = plan.scene
    sizes: dict[tuple[str, float], int] = {}
    for case in plan.cases:
        row = row_of(case.dlc)
        if row is None or row.turbulent:
            group = case.dlc, case.wind_speed
            sizes[group] = sizes.get(group, 0) + 1
    if not sizes:
        return []
    seeds = min(sizes.values())
    own = scatter_of_one_seed(tables, _shares(tables)) if tables else {}
    of_one = own or _of_reference(len(sizes), min(case.duration for case in plan.cases))
    known = [step.seconds for step in plan.steps if step.seconds is not None]
    each = sum(known) / seeds if scene.loads.source == "simulate" and known else None
    counted = _counted(
        scene,
        of_one,
        plan.errors,
        seeds=seeds,
        seconds_each=each,
        measured=bool(own),
        wanted=wanted,
    )
    return list(counted)


def of_run(
    scene: Scene, tables: Mapping[str, xr.Dataset], errors: Mapping[str, Mapping[str, Any]]
) -> list[SeedsWanted]:
    """Return the same of a finished run, by its own seeds.

    Parameters
    ----------
    scene : Scene
        As it ran.
    tables : mapping
        Its results by stage.
    errors : mapping
        Expected error by result and quantity.

    Returns
    -------
    list of SeedsWanted
        Empty where no wind speed has two seeds.
    """
    of_one = scatter_of_one_seed(tables, _shares(tables))
    table = table_of_cases(tables)
    if table is None or not of_one:
        return []
    seeds = min(Groups.of(table).sizes)
    return list(_counted(scene, of_one, errors, seeds=seeds, measured=True))


def _counted(
    scene: Scene,
    of_one: Mapping[str, float],
    errors: Mapping[str, Mapping[str, Any]],
    *,
    seeds: int,
    measured: bool,
    seconds_each: float | None = None,
    wanted: float | None = None,
) -> Iterator[SeedsWanted]:
    for answer, (result, quantity) in ANSWERS.items():
        if answer not in of_one or result not in scene.results:
            continue
        allowed = scene.allowed(result)
        limit = wanted or (allowed if math.isfinite(allowed) else WANTED)
        error = errors.get(result, {}).get(quantity)
        needed = max(1, math.ceil((of_one[answer] / limit) ** 2 - 1e-9))
        yield SeedsWanted(
            answer,
            of_one[answer] / math.sqrt(seeds),
            float(error) if isinstance(error, (int, float)) else None,
            limit,
            needed,
            None if seconds_each is None else seconds_each * needed,
            measured,
        )


def _shares(tables: Mapping[str, xr.Dataset]) -> NDArray[np.float64] | None:
    table = table_of_cases(tables)
    return None if table is None else known_shares(tables, table)


def _of_reference(wind_speeds: int, duration: float) -> dict[str, float]:
    """Scatter of the main job, at as many wind speeds and series as long."""
    known = seed_scatter()
    sums = math.sqrt(known["wind_speeds"] * known["duration"] / (wind_speeds * duration))
    return {
        answer: value * (sums if answer in _SUMS else 1.0)
        for answer, value in known["half_width"].items()
    }


def enough_seeds(found: Iterable[SeedsWanted]) -> str:
    """Say how many seeds of each wind speed would do for each answer; empty if there is none.

    Parameters
    ----------
    found : iterable of SeedsWanted
        Of a finished run, whose answers have intervals of their own.
    """
    told = [f"{one.answer} {one.seeds} for ±{percent(one.wanted)}" for one in found]
    return f"seeds of each wind speed that would do: {'; '.join(told)}" if told else ""


def sentences(found: Iterable[SeedsWanted]) -> list[str]:
    """Say what seeds leave open, how many would do, and where they matter more than models.

    Parameters
    ----------
    found : iterable of SeedsWanted
        Of one scene.

    Returns
    -------
    list of str
        Empty if there is nothing to say.
    """
    every = list(found)
    if not every:
        return []
    whose = "its own seeds" if every[0].measured else "the seeds of the main job, roughly"
    limits = " or ".join(dict.fromkeys(f"±{percent(one.wanted)}" for one in every))
    told = "; ".join(one.sentence for one in every)
    timed = any(one.seconds is not None for one in every)
    time = " (processor time of such a run)" if timed else ""
    said = [
        f"interval of each answer by seeds, and seeds of each wind speed for {limits}{time}, "
        f"by {whose}: {told}"
    ]
    more = [one.answer for one in every if one.governed_by_seeds]
    if more:
        said.append(f"more seeds would tell more than better models of: {', '.join(more)}")
    return said
