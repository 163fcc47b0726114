"""All load cases → which seeds of a wind speed may be taken as equal."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr

from loadflow.cube import time_step
from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.seeds import Method, equality, group_seeds_jointly, holm
from loadflow.stages.labelling import label
from loadflow.stages.reduction import moment_governs
from loadflow.stages.stage import Rungs, Stage, always

TESTS = ("location", "spread", "spectrum")

Series = dict[str, np.ndarray]
"""Of one case, by component."""

Components = dict[str, list[np.ndarray]]
"""Of the seeds of a group, by component."""


def pieces(scene: Scene, cases: list[Case]) -> list[list[Case]]:
    """Cases that are compared with each other: those of one wind speed of one load case."""
    return [list(group) for _, group in groupby(sorted(cases, key=_condition), key=_condition)]


def _condition(case: Case) -> tuple[str, float]:
    return case.dlc, case.wind_speed


def groups_in(scene: Scene, cases: list[Case], inputs: Mapping[str, dict[str, Any]]) -> xr.Dataset:
    """Test the seeds of one of the `pieces`: a group for each step that its series have.

    The components are rotor speed and, of each bearing, those of the radial force, or of the
    tilting moment where one is taken.
    """
    by_step: dict[float, list[tuple[Case, Series]]] = {}
    for case in cases:
        step, series = series_of(scene, inputs[case.name])
        by_step.setdefault(step, []).append((case, series))
    found = []
    for step in sorted(by_step):
        group = [case for case, _ in by_step[step]]
        tested = _by_component(one for _, one in by_step[step])
        tests = [_one_group(scene, method, group, tested, step) for method in scene.seeds.methods]
        together = [_together(scene, group, tested, step)]
        words = {"long_name": "which seeds belong together"}
        found.append(xr.concat(tests, "variant").assign(together=("group", together, words)))
    return xr.concat(found, "group")


def joined(scene: Scene, found: list[xr.Dataset]) -> xr.Dataset:
    """Join the `pieces`, and judge all groups together.

    Returns
    -------
    xarray.Dataset
        `statistic`, `pvalue`, `equal` (variant, group, component, test), `verdict` in words
        (variant, group, component), and `may_merge` (variant, group): whether all components are
        equal, with Holm's correction for their number and that of the groups where the tests hold
        their level. `together` (group) says in words which seeds the calibrated tests let merge. A
        group is one wind speed of one load case, sampled at one step.
    """
    methods = scene.seeds.methods
    whole = xr.concat(found, "group")
    per_method = [
        part.assign(may_merge=_may_merge(part, method, scene.seeds.alpha))
        for method, part in zip(methods, (whole.isel(variant=k) for k in range(len(methods))))
    ]
    return (
        xr.concat(per_method, "variant")
        .assign(together=whole["together"])
        .assign_coords(variant=list(methods))
        .assign_attrs(alpha=scene.seeds.alpha, band=scene.seeds.band)
    )


def _together(scene: Scene, group: list[Case], series: Components, step: float) -> str:
    """Say which seeds of one wind speed belong together, all components at once, and why."""
    grouping = group_seeds_jointly(series, step, scene.seeds.alpha)
    return grouping.in_words([str(case.seed) for case in group])


def _may_merge(found: xr.Dataset, method: Method, alpha: float) -> xr.DataArray:
    """Whether the seeds of each group may be merged, all components taken together."""
    if method == "calibrated":
        adjusted = holm(found["joint_pvalue"].values.ravel())
        equal = found["joint_pvalue"].copy(data=adjusted.reshape(found["joint_pvalue"].shape))
        verdict = (equal >= alpha).all("component")
    else:
        verdict = found["equal"].all(("component", "test"))
    return verdict.astype(int).assign_attrs(units="1", long_name="whether the seeds may be merged")


def _one_group(
    scene: Scene, method: Method, group: list[Case], series: Components, step: float
) -> xr.Dataset:
    """Test the seeds of one wind speed, every component by itself."""
    options = scene.seeds
    found = {
        name: equality(values, step, alpha=options.alpha, method=method, band=options.band)
        for name, values in series.items()
    }
    dims = ("group", "component", "test")

    def table(attribute: str) -> list[list[list[float]]]:
        rows = [[getattr(e, test) for test in TESTS] for e in found.values()]
        return [[[float(getattr(stage, attribute)) for stage in row] for row in rows]]

    return xr.Dataset(
        {
            "statistic": (dims, table("statistic"), {"units": "1", "long_name": "test statistic"}),
            "pvalue": (dims, table("pvalue"), {"units": "1", "long_name": "p value"}),
            "equal": (dims, table("equal"), {"units": "1", "long_name": "not rejected"}),
            "joint_pvalue": (
                dims[:2],
                [[e.pvalue for e in found.values()]],
                {"units": "1", "long_name": "p value of the three stages together"},
            ),
            "verdict": (dims[:2], [[e.text for e in found.values()]]),
        },
        {
            "component": list(found),
            "test": list(TESTS),
            "dlc": ("group", [group[0].dlc]),
            "wind_speed": ("group", [group[0].wind_speed], {"units": "m/s"}),
            "seeds": ("group", [len(group)], label("1", "seeds in the group")),
        },
    )


def _by_component(series: Iterable[Series]) -> Components:
    found: Components = {}
    for one in series:
        for name, values in one.items():
            found.setdefault(name, []).append(values)
    return found


def series_of(scene: Scene, parts: dict[str, Any]) -> tuple[float, Series]:
    """Return the step of a case, s, and the series that its seed is tested by."""
    loads, shaft = parts["loads"], parts["shaft"]
    found = {"speed": loads["speed"].values.astype(float)}
    for bearing in shaft["bearing"].values:
        moment = shaft["moment"].sel(bearing=bearing).transpose("time", "axis").values
        by_moment = moment_governs(scene, str(bearing), moment)
        name, load = ("M", shaft["moment"]) if by_moment else ("F", shaft["force"])
        for axis in ("y", "z"):
            component = load.sel(bearing=bearing, axis=axis)
            found[f"{bearing} {name}{axis}"] = component.values.astype(float)
    return time_step(loads), found


def seeds_key(scene: Scene) -> str:
    """Name of the tests in the ladder."""
    return "+".join(sorted(set(scene.seeds.methods)))


STAGE = Stage(
    "seeds",
    run=groups_in,
    pieces=pieces,
    joined=joined,
    results={"seeds.equality": lambda scene: {}},
    needs=always("loads", "shaft"),
    scope="run",
    sections=always("seeds"),
    models=(Rungs("seeds", section="seeds", key=seeds_key, exact=lambda scene: True),),
)
