"""Bearings that a comparison runs for a scene, and the scene of each of them."""

from __future__ import annotations

from typing import Any

from loadflow.errors import InputError
from loadflow.journal import Lobes
from loadflow.numerics.fields import none_such
from loadflow.scene.candidates import candidates_of
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Candidate, Scene, make_scene
from loadflow.scene.section import is_valid
from loadflow.scene.tolerances import Tolerances
from loadflow.scene.wear import check_wear

ROLLING_SHARE = 0.05
"""Share of the samples in which a rolling bearing is solved, where the scene does not say."""

SHAPED_CLASSES = 5
"""Classes of speed, and of load, of which one sample is solved, the extremes first, in journal
bearings that take long to follow through a whole series: pads, elastic shells, tilted shafts."""


def candidates_for(scene: Scene) -> tuple[dict[str, Candidate], list[str]]:
    """Candidates of a scene, and names of those for which its shaft has no places.

    Raises
    ------
    loadflow.errors.InputError
        There is none at all.
    """
    if scene.candidates:
        return dict(scene.candidates), []
    found: dict[str, Candidate] = {}
    if "journal" in scene.model_fields_set:
        title = "journal bearings of the scene"
        thrust = scene.thrust if scene.thrust.bearings else None
        found["own-journal"] = Candidate(
            title=title,
            journal=scene.journal,
            thrust=thrust,
            tolerances=_of_places(scene, [*scene.journal.bearings, *scene.thrust.bearings]),
        )
    elif scene.thrust.bearings:
        title = "film bearings of the scene"
        found["own-thrust"] = Candidate(
            title=title,
            thrust=scene.thrust,
            tolerances=_of_places(scene, [*scene.thrust.bearings]),
        )
    sized = candidates_of(scene.turbine.name)
    if "rolling" in scene.model_fields_set:
        title = "rolling bearings of the scene"
        found["own-rolling"] = Candidate(
            title=title,
            rolling=scene.rolling,
            tolerances=_of_places(scene, [*scene.rolling.geometries]),
        )
    shell = {
        "turbine": {"name": scene.turbine.name},
        "results": ["loads.statistics"],
        "candidates": {name: {} for name in sized},
        "shaft": {"two_point": {}, "moment": {}},
    }
    sizes = make_scene(shell).candidates
    own = [_bearings(one) for one in found.values()]  # as sized, too: these stand first
    sizes = dict(sorted(sizes.items(), key=lambda item: _bearings(item[1]) not in own))
    built = [_bearings(one) for one in sizes.values()]
    found = {name: one for name, one in found.items() if _bearings(one) not in built}
    places = set(scene.shaft.bearings)
    usable = {name: one for name, one in found.items() if set(one.places) <= places}
    whole = [set(concept.main_bearings) for concept in scene.shaft.concepts]
    usable |= {name: one for name, one in sizes.items() if set(one.places) in whole}
    found |= sizes
    if not usable:
        raise InputError(
            f"no candidates: the scene states none, and for {scene.turbine.name} with bearings at "
            f"{', '.join(places) or 'no place'} the package has none; write [candidates.NAME.PLACE]"
            " into the scene (`loadflow scene --show` prints that of a turbine file)"
        )
    return usable, [name for name in found if name not in usable]


def _bearings(one: Candidate) -> tuple[Any, ...]:
    """What a candidate is, without what it is called."""
    return one.journal, one.rolling, one.thrust, one.tolerances


def _of_places(scene: Scene, places: list[str]) -> Tolerances:
    return {place: found for place, found in scene.tolerances.items() if place in places}


def candidate_scene(base: Scene, name: str, candidate: Candidate, steps: int) -> Scene:
    """The scene of one candidate: its bearings, by the models that suit a comparison.

    Journal bearings of cylindrical and lobed bores are followed in motion through the whole series
    on the rung ``reduced`` where it knows their supply; others are solved at rest in a few samples,
    the extremes among them.

    Parameters
    ----------
    base : Scene
        Loads, shaft, friction.
    name : str
        Of the candidate.
    candidate : Candidate
        Its bearings.
    steps : int
        Length of the shortest series.
    """
    results: list[str] = []
    update: dict[str, Any] = {"name": name, "candidates": {}, "tolerances": candidate.tolerances}
    fewer: dict[str, Any] = {"size": ROLLING_SHARE}
    if candidate.journal is not None:
        results.append("journal.film")
        if _wears(base, candidate.journal):
            results.append("journal.wear")
        update["journal"] = journal = _modelled(candidate.journal)
        if not journal.in_motion:
            share = min(1.0, SHAPED_CLASSES**2 / steps)
            fewer = {"size": share, "classes": SHAPED_CLASSES}
    if candidate.rolling is not None:
        results += (rolling := ["rolling.loads", "rolling.life"])
        update["rolling"] = candidate.rolling
        if cooled := base.friction.cooling:
            own = {place: cooled[place] for place in cooled if place in candidate.rolling.bearings}
            update["friction"] = base.friction.model_copy(update={"cooling": own})
        if isinstance(base.accuracy, dict):
            update["accuracy"] = _as_near(base, rolling)
    if candidate.thrust is not None:
        results.append("thrust.film")
        update["thrust"] = candidate.thrust
        fewer = {"size": min(1.0, SHAPED_CLASSES**2 / steps), "classes": SHAPED_CLASSES}
    if not base.reduction.changed:
        update["reduction"] = base.reduction.model_copy(update=fewer)
    # a bearing of the scene in a room that the candidate has none of is none of the candidate's
    others = [room for room in ("journal", "rolling", "thrust") if getattr(candidate, room) is None]
    update |= {room: type(getattr(base, room))() for room in others}
    found = base.model_copy(update=update | {"results": results})
    found.model_fields_set.difference_update(others)
    return found


def _as_near(base: Scene, results: list[str]) -> dict[Any, float]:
    """Accuracy of a scene, and of some results no less than where nothing is said."""
    usual = float(Scene.model_fields["accuracy"].default)
    nearer = {result: min(usual, base.allowed(result)) for result in results}
    return {str(name): value for name, value in base.accuracy.items()} | nearer  # type: ignore[union-attr]


def _wears(base: Scene, journal: Journal) -> bool:
    """Whether the scene says how bores wear, and these can."""
    try:
        check_wear(base.wear, journal, base.shaft)
    except ValueError:
        return False
    return True


def _modelled(journal: Journal) -> Journal:
    """A journal bearing in motion on `reduced`, where that rung knows it and none is named."""
    parts = (journal, *journal.own.values())
    simple = not journal.tilt and all(
        (not part.geometry.shape.segments or isinstance(part.geometry.shape, Lobes))
        and part.geometry.relief == ()
        and part.shell is None
        for part in parts
    )
    if not simple or {"motion", "rung"} & journal.changed:
        return journal
    fast = {"motion": "transient", "rung": "reduced"}
    own = {place: part.model_copy(update=fast) for place, part in journal.own.items()}
    found = journal.model_copy(update=fast | {"own": own})
    # a supply in the groove between lobes the rung does not know
    return found if is_valid(found) else journal


def chosen_of(known: dict[str, Candidate], names: list[str] | None) -> dict[str, Candidate]:
    """Those of some names.

    Raises
    ------
    loadflow.errors.InputError
        A name that is not known.
    """
    if names is None:
        return known
    if unknown := [name for name in names if name not in known]:
        raise InputError(none_such("candidate", unknown, known))
    return {name: known[name] for name in names}
