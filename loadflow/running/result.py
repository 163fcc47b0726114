"""What a run has found: its parts joined in one tree, verdicts and lifetime."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import xarray as xr

from loadflow.cube.hdf5 import read_whole
from loadflow.planning.plan import Plan
from loadflow.planning.verification import CHECK
from loadflow.running.executor import Executor
from loadflow.running.folder import part_file
from loadflow.running.whole import summaries
from loadflow.scene.scene import Scene
from loadflow.scene.unused import friction_note, scaling_note, unused_keys
from loadflow.stages.bores import told_bores
from loadflow.stages.registry import STAGES
from loadflow.verdict import Verdict, from_dataset, to_dataset


@dataclass(frozen=True)
class Run:
    """A finished run.

    Attributes
    ----------
    path : Path
        Its folder.
    tree : xarray.DataTree
        What was wanted: one group for each stage.
    failures : dict
        Load cases that a solver could not answer, and why.
    unused : dict
        Keys of the scene that are set but change nothing, and why.
    shortfalls : tuple of str
        Results that the check found, or that are expected, less accurate than asked for: how far
        off, why, what helps.
    notes : tuple of str
        What is doubtful about the scene itself, such as a turbine that is scaled, or what neither
        scene nor turbine state, and what was taken instead.
    """

    path: Path
    tree: xr.DataTree
    failures: dict[str, str] = field(default_factory=dict)
    unused: dict[str, str] = field(default_factory=dict)
    shortfalls: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()

    @property
    def flagged(self) -> dict[str, int]:
        """Number of samples without an answer, by stage and case, where there are any."""
        found = {}
        for stage, node in self.tree.children.items():
            if "not_converged" in node:
                flags = node.to_dataset()["not_converged"]
                per_case = flags.sum([dim for dim in flags.dims if dim != "case"])
                for case in per_case["case"].values[per_case.to_numpy() > 0]:
                    found[f"{case}, {stage}"] = int(per_case.sel(case=case))
        return found

    @property
    def verdicts(self) -> tuple[Verdict, ...]:
        """What the bearings must hold, and whether they do."""
        if "verdicts" not in self.tree.children:
            return ()
        return tuple(from_dataset(self.tree["verdicts"].to_dataset()))

    @property
    def warnings(self) -> list[str]:
        """What the run found doubtful about its own models."""
        ignored = [f"{key}: has no effect, {why}" for key, why in self.unused.items()]
        stages = (*STAGES.values(), CHECK)
        found = [said for stage in stages for said in stage.warnings(self.tree)]
        return [*self.notes, *ignored, *found]

    @property
    def report(self) -> Path:
        """The report page."""
        return self.path / "report.html"


def run_of(
    folder: Path,
    scene: Scene,
    tree: xr.DataTree,
    failures: dict[str, str],
    shortfalls: Iterable[str],
    overloaded: Iterable[str],
) -> Run:
    """Return a run with what is doubtful about its scene; `overloaded` is what its plan says."""
    notes = [*overloaded, *scaling_note(scene), *friction_note(scene), *scene.taken]
    notes += told_bores(tree.children)
    return Run(folder, tree, failures, unused_keys(scene), tuple(shortfalls), tuple(notes))


def collect(plan: Plan, folder: Path, where: Executor) -> xr.DataTree:
    """Join what the stages found, reduced to what a reader wants of each case."""
    found, missing = summaries(plan, folder, where)
    whole = {step.name: part_file(folder, step.name) for step in plan.of_scope("run")}
    found |= {name: read_whole(part) for name, part in whole.items() if part.exists()}
    groups = {step.name: found[step.name] for step in plan.steps if step.name in found}
    groups |= _judged(plan.scene, groups, missing)
    return xr.DataTree.from_dict(
        {
            f"{name}/{path}".rstrip("/"): node
            for name, data in groups.items()
            for path, node in _nodes(data)
        }
    )


def _judged(
    scene: Scene, groups: Mapping[str, Any], missing: Mapping[str, list[str]]
) -> dict[str, xr.Dataset]:
    """Lifetime and verdicts of what was found; nothing where no bearing was solved."""
    from loadflow.studies.lifetime.energy import run_energy
    from loadflow.studies.lifetime.finished_run import run_lifetime
    from loadflow.studies.verdicts.verdicts import verdicts

    lifetime = run_lifetime(scene, groups)
    found = verdicts(scene, groups, lifetime, missing)
    judged = {"verdicts": to_dataset(found)} if found else {}
    tables = {"lifetime": lifetime, "energy": run_energy(scene, groups)}
    return judged | {name: table for name, table in tables.items() if table is not None}


def _nodes(data: xr.Dataset | xr.DataTree) -> Iterator[tuple[str, xr.Dataset]]:
    if isinstance(data, xr.Dataset):
        yield "", data
    else:
        for node in data.subtree:
            yield node.path.strip("/"), node.to_dataset(inherit=False)
