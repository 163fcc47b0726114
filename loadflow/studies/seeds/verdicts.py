"""Load cube → which seeds of a wind speed are equal, which belong together, and are they enough."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import Cube, iter_cases, time_step
from loadflow.errors import InputError
from loadflow.reduction import damage_equivalent_load
from loadflow.seeds import (
    Equivalence,
    Method,
    SeedEquality,
    SeedsNeeded,
    Stage,
    equality,
    equivalence,
    group_seeds_jointly,
    holm,
    seeds_needed,
)
from loadflow.stages.statistics import SLOPE
from loadflow.studies.channels import channel, choose_channels

log = logging.getLogger("loadflow.run")

HEADS = (
    "DLC",
    "wind, m/s",
    "seeds",
    "component",
    "location",
    "p",
    "spread",
    "p",
    "spectrum",
    "p",
    "p of all",
    "equal",
)
STAGES = ("location", "spread", "spectrum")

Group = list[xr.Dataset]
"""The seeds of one wind speed of one load case."""


@dataclass(frozen=True)
class Verdict:
    """Whether the seeds of one wind speed are equal in one component.

    Attributes
    ----------
    dlc : str
        Design load case.
    wind_speed : float
        m/s.
    seeds : int
        How many.
    component : str
        Such as ``speed``, ``hub_moment.y`` or ``force.N.z``.
    equality : SeedEquality
        The tests of this component alone.
    pvalue : float
        Of all its tests; calibrated: corrected for the number of components and wind speeds.
    equal : bool
        Calibrated: whether `pvalue` reaches the level of significance; as printed: the three
        stages of this component.
    """

    dlc: str
    wind_speed: float
    seeds: int
    component: str
    equality: SeedEquality
    pvalue: float
    equal: bool

    def as_dict(self) -> dict[str, Any]:
        """The verdict in plain values, for JSON."""
        stages = {
            name: {key: getattr(getattr(self.equality, name), key) for key in ("pvalue", "equal")}
            for name in STAGES
        }
        own = {k: v for k, v in vars(self).items() if k != "equality"}
        return own | {"alpha": self.equality.alpha, "method": self.equality.method} | stages


def as_row(verdict: Verdict) -> list[str]:
    """The verdict under `HEADS`: H, H and ΔS as printed, F calibrated; * marks what differs."""
    tested = verdict.seeds > 1
    cells = []
    for name in STAGES:
        stage: Stage = getattr(verdict.equality, name)
        mark = "" if stage.equal else " *"
        cells += [f"{stage.statistic:.3g}{mark}", _p(stage.pvalue)] if tested else ["-", "-"]
    return [
        verdict.dlc,
        f"{verdict.wind_speed:g}",
        str(verdict.seeds),
        verdict.component,
        *cells,
        _p(verdict.pvalue) if tested else "-",
        ("yes" if verdict.equal else "no") if tested else verdict.equality.text,
    ]


def count_different(verdicts: Sequence[Verdict]) -> str:
    """How many differ, in words."""
    tested = sum(verdict.seeds > 1 for verdict in verdicts)
    different = sum(not verdict.equal for verdict in verdicts)
    return f"{different} of {tested} differ, {len(verdicts) - tested} have one seed"


def _p(value: float) -> str:
    return "-" if np.isnan(value) else f"{value:.2g}"


def seed_verdicts(
    cube: Cube,
    wanted: Sequence[str] = (),
    *,
    alpha: float = 0.05,
    method: Method = "calibrated",
    source: str = "load cube",
) -> list[Verdict]:
    """Test the seeds of every wind speed of every load case, component by component.

    Seeds that are sampled at different steps are not compared with each other.

    Parameters
    ----------
    cube : Cube
        Its bearing loads are tested where it has them, else its hub loads.
    wanted : sequence of str
        Components, or variables for all their components; default: rotor speed and all loads that
        are not zero.
    alpha : float
        Level of significance; calibrated: of all verdicts together (Holm's correction).
    method : {"calibrated", "as-printed"}
        See `loadflow.seeds.equality`.
    source : str
        Name of the cube, for messages.

    Returns
    -------
    list of Verdict
        By load case, wind speed and component.

    Raises
    ------
    loadflow.errors.InputError
        An unknown component, or a series that is too short.
    """
    groups = seed_groups(cube)
    names = choose_channels(next(iter(groups.values()))[0], wanted, source)
    found: list[Verdict] = []
    for (dlc, wind_speed, step), group in groups.items():
        for name in names:
            series = [channel(case, name).values.astype(float) for case in group]
            try:
                test = equality(series, step, alpha=alpha, method=method)
            except InputError as error:
                raise InputError(f"{source}: {wind_speed:g} m/s, {name}: {error}") from error
            log.info("DLC %s, %g m/s, %s: %d seeds tested", dlc, wind_speed, name, len(group))
            found.append(Verdict(dlc, wind_speed, len(group), name, test, test.pvalue, test.equal))
    return _corrected(found, alpha) if method == "calibrated" else found


def _corrected(verdicts: list[Verdict], alpha: float) -> list[Verdict]:
    """Correct for the number of tests; a single seed is no test."""
    tested = [verdict for verdict in verdicts if verdict.seeds > 1]
    adjusted = dict(zip(map(id, tested), holm([v.pvalue for v in tested]).tolist()))
    p = [adjusted.get(id(verdict), 1.0) for verdict in verdicts]
    return [replace(v, pvalue=q, equal=q >= alpha) for v, q in zip(verdicts, p)]


def seed_groups(cube: Cube) -> dict[tuple[str, float, float], Group]:
    """Cases of one load case, wind speed (m/s) and time step (s), in order."""
    groups: dict[tuple[str, float, float], Group] = {}
    for _, case in iter_cases(cube):
        key = str(case["dlc"].item()), float(case["wind_speed"]), time_step(case)
        groups.setdefault(key, []).append(case)
    if not groups:
        raise InputError("the load cube is empty, it holds no case")
    return dict(sorted(groups.items()))


@dataclass(frozen=True)
class Sufficiency:
    """What the seeds of one wind speed say about one component beyond equality.

    Attributes
    ----------
    component : str
        Which.
    equivalence : Equivalence
        Whether the seeds are shown to differ by less than the margin.
    needed : dict of str to SeedsNeeded or None
        Seeds that the wanted uncertainty of ``"mean"``, ``"extreme"`` (largest magnitude) and
        ``"damage"`` (damage-equivalent load) takes; None where it takes more than there can be.
    """

    component: str
    equivalence: Equivalence
    needed: dict[str, SeedsNeeded | None]

    def as_row(self) -> list[str]:
        """The numbers under `SUFFICIENCY_HEADS`."""
        e = self.equivalence
        cells = [
            "-" if n is None else f"{n.seeds} ({n.low} … {n.high})" for n in self.needed.values()
        ]
        word = "yes" if e.equivalent else "not shown"
        return [self.component, f"{e.location:.1%}", f"{e.spread:.1%}", word, *cells]


SUFFICIENCY_HEADS = (
    "component",
    "location within",
    "spread within",
    "equivalent",
    "seeds for the mean",
    "for the extreme",
    "for the damage",
)


def sufficiency(
    group: Group,
    names: Sequence[str],
    step: float,
    margin: float = 0.05,
    uncertainty: float = 0.05,
    alpha: float = 0.05,
) -> list[Sufficiency]:
    """Say of each component whether the seeds are equivalent, and how many would be needed.

    Parameters
    ----------
    group : list of xarray.Dataset
        Two seeds of one wind speed, or more.
    names : sequence of str
        Components.
    step : float
        Time step, s.
    margin : float
        Relative difference that is allowed between equivalent seeds.
    uncertainty : float
        Wanted relative half width of the confidence interval of a mean over seeds.
    alpha : float
        Level of significance, and of that interval.
    """
    found = []
    for name in names:
        series = [channel(case, name).values.astype(float) for case in group]
        values = {
            "mean": [x.mean() for x in series],
            "extreme": [np.abs(x).max() for x in series],
            "damage": [damage_equivalent_load(x, SLOPE, (x.size - 1) * step) for x in series],
        }
        needed = {key: _needed(v, uncertainty, 1.0 - alpha) for key, v in values.items()}
        found.append(Sufficiency(name, equivalence(series, margin, alpha), needed))
    return found


def _needed(values: Any, uncertainty: float, confidence: float) -> SeedsNeeded | None:
    try:
        return seeds_needed(values, uncertainty, confidence)
    except (
        InputError
    ):  # a mean of zero has no relative uncertainty, or no number of seeds is enough
        return None


def groupings(cube: Cube, verdicts: Sequence[Verdict]) -> dict[tuple[str, float, float], str]:
    """Say of each wind speed with several seeds which of them belong together, and why.

    All components of the verdicts count together (`loadflow.seeds.group_seeds_jointly`).

    Parameters
    ----------
    cube : Cube
        The cube.
    verdicts : sequence of Verdict
        What `seed_verdicts` found in it.

    Returns
    -------
    dict
        Text for each load case, wind speed (m/s) and time step (s).
    """
    names = list(dict.fromkeys(verdict.component for verdict in verdicts))
    alpha, method = verdicts[0].equality.alpha, verdicts[0].equality.method
    found = {}
    for key, group in seed_groups(cube).items():
        if len(group) > 1:
            series = {n: [channel(c, n).values.astype(float) for c in group] for n in names}
            grouping = group_seeds_jointly(series, key[2], alpha, method)  # type: ignore[arg-type]
            seeds = [str(case["seed"].item()) for case in group]
            found[key] = f"DLC {key[0]}, {key[1]:g} m/s: {grouping.in_words(seeds)}"
    return found
