"""The search for the best crowns of the journal bearings of a scene, under its own loads."""

from __future__ import annotations

import copy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from loadflow.errors import InputError
from loadflow.journal import Crown
from loadflow.running.comparison import Means, shared_loads
from loadflow.running.designing import chosen_candidate, spectrum_of
from loadflow.running.executor import executor
from loadflow.running.lock import locked
from loadflow.scene.design import Crowning
from loadflow.scene.scene import Candidate, Scene
from loadflow.storage import write_json, write_text
from loadflow.studies.design.crowning import PlaceCrown, crowns_of
from loadflow.studies.design.result import scene_with_bearings
from loadflow.studies.design.space import with_collars, written_collars, written_places


@dataclass(frozen=True)
class Crowned:
    """A finished search for crowns.

    Attributes
    ----------
    path : Path
        Its folder.
    crowns : tuple of PlaceCrown
        By bearing.
    """

    path: Path
    crowns: tuple[PlaceCrown, ...]

    @property
    def table(self) -> Path:
        """The numbers as JSON."""
        return self.path / "crown.json"

    @property
    def scene(self) -> Path:
        """Scene with the crowns, ready to run."""
        return self.path / "crowned.toml"


def crown(
    scene: Scene,
    *,
    out: str | Path = "runs",
    workers: int = 1,
    scheduler: str | None = None,
    overwrite: bool = False,
    progress: Any = None,
) -> Crowned:
    """Find the best crowns of the journal bearings of a candidate, as ``[design.crown]`` says.

    Parameters
    ----------
    scene : Scene
        Loads, shaft, candidate and aim (`loadflow.scene.design.Crowning`; its defaults without).
    out : path
        Folder of runs. Loads and shaft are those of the run of the scene's name there, made if they
        are missing; the result is in ``design/CANDIDATE`` of it.
    workers, scheduler, overwrite, progress
        As of `loadflow.run`.

    Returns
    -------
    Crowned
        Table and scene are written.

    Raises
    ------
    loadflow.errors.InputError
        No such candidate, none with journal bearings, or a shaft that is held aligned.
    loadflow.errors.SolverError
        A bearing that no crown leaves a film.
    """
    name, candidate = chosen_candidate(scene)
    journal = candidate.journal
    if journal is None:
        raise InputError(f"design.crown: candidate {name!r} has no journal bearing")
    with executor(workers, scheduler) as where:
        loads = shared_loads(scene, out, Means(where, overwrite, progress))
    folder = loads.folder / "design" / name
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder):
        spectrum, _ = spectrum_of(loads, candidate, scene.design.classes, folder)
        groups = {place: spectrum[place].to_dataset() for place in journal.bearings}
        found = crowns_of(journal, groups, scene.design.crown or Crowning())
        done = Crowned(folder, found)
        write_json(done.table, [one.as_dict() for one in found])
        write_text(done.scene, _scene(scene, name, candidate, found))
    return done


def _scene(scene: Scene, name: str, candidate: Candidate, found: tuple[PlaceCrown, ...]) -> str:
    """The scene with the crowns."""
    places = copy.deepcopy(written_places(candidate))
    for one in found:
        geometry = places[one.place].setdefault("geometry", {})
        kept = [part for part in geometry.get("relief", []) if part.get("kind") != Crown.kind]
        crown = one.found.crown
        told = {} if crown is None else {
            "kind": crown.kind, "height": crown.height, "length": crown.length,
            "exponent": crown.exponent,
        }  # fmt: skip
        geometry["relief"] = [*kept, *([told] if told else [])]
        places[one.place]["rung"] = "grid"
    friction = scene.friction.model_dump(mode="json", exclude_unset=True, exclude_none=True)
    places = with_collars(places, written_collars(candidate))
    words = "; ".join(", ".join(part for part in one.row[:4] if part) for one in found)
    return scene_with_bearings(scene, f"{scene.name}-{name}-crowned", places, friction, words)
