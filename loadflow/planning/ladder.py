"""What each model costs and how far it is off: the measured ladder, and a scene's place on it.

``loadflow/data/ladder.json`` is written by ``benchmarks/ladder.py``: for each stage and rung the
processor time per unit of work, and the error of what users read against a stated reference.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable
from functools import cache
from importlib.resources import files
from typing import Any

from pydantic import ValidationError

from loadflow.rolling import BallBearing, SlewingBearing
from loadflow.scene.cases import Case
from loadflow.scene.loads import Loads
from loadflow.scene.scene import Scene

STEPS_PER_CASE = 24_000
"""Length of a load case in the ladder: 600 s in steps of 0.025 s."""

WARM_FILMS = 7.0
"""Time of a film with its heat balance over that of an isothermal one; see docs/journal.md."""


@cache
def ladder() -> dict[str, Any]:
    """Return measured cost and error of every rung, as written by ``benchmarks/ladder.py``."""
    return _data("ladder.json")


@cache
def gains() -> dict[str, dict[str, float]]:
    """Return d ln(answer)/d ln(load) of what users read of each bearing, at its largest."""
    return _data("gains.json")


def _data(name: str) -> dict[str, Any]:
    return json.loads(files("loadflow").joinpath("data", name).read_text(encoding="utf-8"))


def rung_of(scene: Scene, stage: str) -> str:
    """Return the model that the scene chooses for a stage, by its name in the ladder.

    The wind is a stage of the ladder, too, made in the stage "loads".
    """
    found = _RUNGS.get(stage)
    return found(scene) if found else "-"


def finest(scene: Scene) -> str:
    """Return the finest model of the loads that the scene's turbine allows."""
    from loadflow.rotor.rungs import finest_rung
    from loadflow.turbines import load_turbine

    return finest_rung(load_turbine(scene.turbine.name))


def _loads_rung(scene: Scene) -> str:
    return (scene.loads.rung or finest(scene)) if scene.loads.source == "simulate" else "files"


def _wind_rung(scene: Scene) -> str:
    if not scene.loads.makes_wind:
        return "files"
    radii, angles = scene.loads.wind_grid
    return f"{scene.loads.spectrum}, {radii}x{angles}"


def _shaft_rung(scene: Scene) -> str:
    concepts = ((name, concept) for name, concept in scene.shaft if concept)
    plain = "+".join(f"{name}, beam" if concept.beam else name for name, concept in concepts)
    seats = [f"{name} {seat.stiffness}" for name, seat in scene.shaft.seated.items()]
    return f"{plain}, iterated with {', '.join(seats)}" if seats else plain


def _film_rung(scene: Scene) -> str:
    around, across = scene.journal.grid
    rung = scene.journal.rung
    graded = ", graded" if scene.journal.grading == "graded" else ""
    elastic = ", elastic" if scene.journal.shell is not None else ""
    names = {"grid": f"grid, {around}x{across}{graded}{elastic}", "reduced": f"reduced, {around}"}
    return names.get(rung, rung)


def _friction_rung(scene: Scene) -> str:
    balls = BallBearing | SlewingBearing
    followed = any(not isinstance(b, balls) for b in scene.rolling.geometries.values())
    return f"{'rollers' if followed else 'balls'}, every {scene.friction.step:g} s"


def _reduction_rung(scene: Scene) -> str:
    pick, size = scene.reduction.pick, scene.reduction.size
    classes = f", {scene.reduction.classes} classes" if scene.reduction.classes else ""
    return "full series" if size == 1.0 else f"histogram, {pick}, {size:g}{classes}"


_RUNGS: dict[str, Callable[[Scene], str]] = {
    "wind": _wind_rung,
    "loads": _loads_rung,
    "shaft": _shaft_rung,
    "seeds": lambda scene: "+".join(sorted(set(scene.seeds.methods))),
    "reduction": _reduction_rung,
    "journal": _film_rung,
    "rolling": lambda scene: scene.rolling.rung,
    "friction": _friction_rung,
}


def section_of(stage: str) -> str:
    """Return the section of a scene that holds the settings of a stage."""
    return "loads" if stage == "wind" else stage


def measured(scene: Scene, stage: str) -> dict[str, Any] | None:
    """Return what the ladder holds of the scene's rung of a stage, None if it was not measured."""
    seated = stage == "shaft" and scene.shaft.seated
    return _rungs(scene, stage).get(_seats_rung(scene) if seated else rung_of(scene, stage))


def _seats_rung(scene: Scene) -> str:
    """Kinds of bearing that the shaft is iterated with, as the ladder names them."""
    kinds = {
        f"{seat.stiffness}, tilting"
        if seat.stiffness == "journal" and seat.takes_moment
        else f"{seat.stiffness}, flexible"
        if seat.stiffness == "rolling" and scene.rolling.bearings[name].rings == "flexible"
        else seat.stiffness
        for name, seat in scene.shaft.seated.items()
    }
    return f"on {'+'.join(sorted(kinds))}"


def _rungs(scene: Scene, stage: str) -> dict[str, Any]:
    """All rungs of a stage; a film in motion has its own."""
    moving = stage == "journal" and scene.journal.in_motion
    return ladder().get("journal, transient" if moving else stage, {})


def expected_seconds(scene: Scene, stage: str, cases: Iterable[Case]) -> float | None:
    """Processor time that a stage takes over `cases`, s; None if its rung was not measured."""
    known = measured(scene, stage)
    if known is None:
        return None
    if "seconds_per_case" in known:
        more = _wind_seconds(scene) if stage == "loads" else 0.0
        if more is None:
            return None
        each = known["seconds_per_case"] + more
        films = _seat_films(scene, known) if stage == "shaft" else 1.0
        if films is None:
            return None
        return each * films * sum(case.steps for case in cases) / STEPS_PER_CASE
    bearings = len(scene.journal.bearings) if stage == "journal" else 1
    samples = _share(scene, stage) * bearings * sum(case.steps for case in cases)
    return known["seconds_per_sample"] * samples * _films(scene, stage)


def _seat_films(scene: Scene, known: dict[str, Any]) -> float | None:
    """Time of the scene's film over that of the one which the shaft was measured on."""
    if "film" not in known:
        return 1.0
    films = ladder()["journal"]
    ours, theirs = films.get(rung_of(scene, "journal")), films[known["film"]]
    if ours is None:
        return None
    warm = WARM_FILMS if scene.journal.heat is not None else 1.0
    return warm * float(ours["seconds_per_sample"] / theirs["seconds_per_sample"])


def _films(scene: Scene, stage: str) -> float:
    """Films solved for each sample: a heat balance tries several temperatures."""
    warm = stage == "journal" and scene.journal.heat is not None and not scene.journal.in_motion
    return WARM_FILMS if warm else 1.0


def _wind_seconds(scene: Scene) -> float | None:
    """Time of the wind beyond that of the usual grid, with which the stage "loads" is measured."""
    if not scene.loads.makes_wind:
        return 0.0
    usual = scene.model_copy(update={"loads": Loads()})
    ours, theirs = (measured(one, "wind") for one in (scene, usual))
    if ours is None or theirs is None:
        return None
    return ours["seconds_per_case"] - theirs["seconds_per_case"]


def _share(scene: Scene, stage: str) -> float:
    """Share of the series that a bearing is solved for."""
    if stage == "journal" and scene.journal.in_motion:
        return 1.0
    reduction = measured(scene, "reduction") or {}
    return min(1.0, scene.reduction.size * reduction.get("samples_over_wanted", 1.0))


def choices(scene: Scene, stage: str) -> list[Scene]:
    """Return the scene with each rung that it leaves open for a stage; itself alone if none is.

    A rung is open where the scene names none of its settings. Rungs that another one makes
    needless, or that a scene cannot ask for, are passed over.
    """
    section = getattr(scene, section_of(stage))
    given = {"loads": scene.loads.source == "files", "wind": not scene.loads.makes_wind}
    if given.get(stage):
        return [scene]
    entries = _rungs(scene, stage).values()
    useful = [e["settings"] for e in entries if "settings" in e and "dominated_by" not in e]
    opened = [settings for settings in useful if not section.model_fields_set & set(settings)]
    found = [with_settings(scene, stage, settings) for settings in opened]
    return [one for one in found if one is not None] or [scene]


def is_open(scene: Scene, stage: str) -> bool:
    """Whether the scene leaves the model of a stage to the plan."""
    return len(choices(scene, stage)) > 1


def with_settings(scene: Scene, stage: str, settings: dict[str, Any]) -> Scene | None:
    """Return the scene with other settings, None where it lacks the data that they need."""
    name = section_of(stage)
    section = getattr(scene, name)
    if settings.get("rung") == "tower" and finest(scene) != "tower":
        return None
    try:
        changed = type(section).model_validate(section.model_dump(exclude_unset=True) | settings)
    except ValidationError:
        return None
    return scene.model_copy(update={name: changed})
