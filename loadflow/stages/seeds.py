"""All load cases → which seeds of a wind speed may be taken as equal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import groupby
from typing import Any

import numpy as np
import xarray as xr

from loadflow.scene.cases import Case
from loadflow.scene.scene import Scene
from loadflow.seeds import Method, equality, group_seeds_jointly, holm
from loadflow.stages.labelling import label
from loadflow.stages.reduction import moment_governs
from loadflow.stages.stage import Rungs, Stage, always

TESTS = ("location", "spread", "spectrum")


def equality_of_seeds(
    scene: Scene, cases: list[Case], inputs: Mapping[str, dict[str, Any]]
) -> xr.Dataset:
    """Test the seeds of every wind speed, for rotor speed and each load component of each bearing.

    The components are those of the radial force, or of the tilting moment where one is taken.

    Returns
    -------
    xarray.Dataset
        `statistic`, `pvalue`, `equal` (variant, group, component, test), `verdict` in words
        (variant, group, component), and `may_merge` (variant, group): whether all components are
        equal, with Holm's correction for their number and that of the groups where the tests hold
        their level. `together` (group) says in words which seeds the calibrated tests let merge. A
        group is one wind speed of one load case, sampled at one step.
    """

    def group_of(case: Case) -> tuple[str, float, float]:
        return case.dlc, case.wind_speed, _step(inputs[case.name]["loads"])

    groups = [list(group) for _, group in groupby(sorted(cases, key=group_of), key=group_of)]
    per_method = []
    for method in scene.seeds.methods:
        found = xr.concat([_one_group(scene, method, group, inputs) for group in groups], "group")
        per_method.append(found.assign(may_merge=_may_merge(found, method, scene.seeds.alpha)))
    together = [_together(scene, group, inputs) for group in groups]
    return (
        xr.concat(per_method, "variant")
        .assign(together=("group", together, {"long_name": "which seeds belong together"}))
        .assign_coords(variant=list(scene.seeds.methods))
        .assign_attrs(alpha=scene.seeds.alpha, band=scene.seeds.band)
    )


def _together(scene: Scene, group: list[Case], inputs: Mapping[str, dict[str, Any]]) -> str:
    """Say which seeds of one wind speed belong together, all components at once, and why."""
    found = components(scene, group, inputs)
    step = next(iter(found.values()))[1]
    series = {name: values for name, (values, _) in found.items()}
    grouping = group_seeds_jointly(series, step, scene.seeds.alpha)
    return grouping.in_words([str(case.seed) for case in group])


def _step(loads: xr.Dataset) -> float:
    return round(float(loads["time"][1] - loads["time"][0]), 9)


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
    scene: Scene, method: Method, group: list[Case], inputs: Mapping[str, dict[str, Any]]
) -> xr.Dataset:
    """Test the seeds of one wind speed, every component by itself."""
    options = scene.seeds
    found = {
        name: equality(series, step, alpha=options.alpha, method=method, band=options.band)
        for name, (series, step) in components(scene, group, inputs).items()
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


def components(
    scene: Scene, group: list[Case], inputs: Mapping[str, dict[str, Any]]
) -> dict[str, tuple[list[np.ndarray], float]]:
    """Return for each component the series of all seeds, and their step."""
    found: dict[str, tuple[list[np.ndarray], float]] = {}
    for case in group:
        for name, values, step in _series(scene, inputs[case.name]):
            found.setdefault(name, ([], step))[0].append(values)
    return found


def _series(scene: Scene, parts: dict[str, Any]) -> Iterator[tuple[str, np.ndarray, float]]:
    loads, shaft = parts["loads"], parts["shaft"]
    step = _step(loads)
    yield "speed", loads["speed"].values.astype(float), step
    for bearing in shaft["bearing"].values:
        moment = shaft["moment"].sel(bearing=bearing).transpose("time", "axis").values
        by_moment = moment_governs(scene, str(bearing), moment)
        name, load = ("M", shaft["moment"]) if by_moment else ("F", shaft["force"])
        for axis in ("y", "z"):
            component = load.sel(bearing=bearing, axis=axis)
            yield f"{bearing} {name}{axis}", component.values.astype(float), step


def seeds_key(scene: Scene) -> str:
    """Name of the tests in the ladder."""
    return "+".join(sorted(set(scene.seeds.methods)))


STAGE = Stage(
    "seeds",
    run=equality_of_seeds,
    results={"seeds.equality": lambda scene: {}},
    needs=always("loads", "shaft"),
    scope="run",
    sections=always("seeds"),
    models=(Rungs("seeds", section="seeds", key=seeds_key, exact=lambda scene: True),),
)
