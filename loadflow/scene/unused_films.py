"""Keys of journal and thrust bearings that a scene leaves without effect, as `unused_keys`."""

from __future__ import annotations

from collections.abc import Iterator

from loadflow.journal import FilmHeat, Heat, ThrustBearing
from loadflow.journal.rungs import RUNGS
from loadflow.journal.surfaces import Reversed
from loadflow.scene.journal import Journal
from loadflow.scene.places import OF_COLLARS, SHARED
from loadflow.scene.scene import Scene
from loadflow.scene.shaft_place import seats_felt
from loadflow.wind.cases import stands_or_starts

NO_START = "no load case of this scene starts, stops or stands"


def of_journal(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield the keys of journal bearings that a scene leaves without effect, and why."""
    journal = scene.journal
    yield from _of_film(scene, journal)
    for place in journal.own:
        if place not in journal.bearings:
            yield "own", f"bearings leaves {place} out"
        for key, reason in _of_film(scene, journal.at(place)):
            if key.split(".")[0] not in SHARED:
                yield f"own.{place}.{key}", reason


def _of_film(scene: Scene, journal: Journal) -> Iterator[tuple[str, str]]:
    """Keys of the journal bearing, or of one place."""
    yield from _of_alignment(scene, journal)
    yield from _of_film_model(scene, journal)
    yield from _of_least_film(journal)
    yield from _of_film_limits(scene)


def _of_alignment(scene: Scene, journal: Journal) -> Iterator[tuple[str, str]]:
    """Keys of how the shaft lies in the bearing."""
    if journal.tilt and not any(_tilts(scene, name) for name in journal.bearings):
        yield "tilt", "the shaft is rigid and brings no moment; give its suspension a beam"
    shaft = scene.shaft
    held = any(seats_felt(shaft, scene.journal, concept) for concept in shaft.concepts)
    if journal.tilt and not scene.journal.tilting and not held:
        yield "tilt", "the bearings are self_aligning"
    if journal.self_aligning:
        yield "alignment", "the bearing is self_aligning"
    bends = any(map(shaft.bends_at, scene.journal.bearings))
    if not (scene.journal.tilt or held or (scene.asks and bends)):
        for key in ("alignment", "self_aligning"):
            if key == "self_aligning" and journal.seat is not None:  # plans count what it leaves
                continue
            yield key, "only a film with tilt knows it; set journal.tilt, with a beam as the shaft"


def _of_film_model(scene: Scene, journal: Journal) -> Iterator[tuple[str, str]]:
    """Keys of mesh, law, heat and time of the film."""
    if "grading" not in RUNGS[journal.rung].at_rest:
        yield "grading", f'rung "{journal.rung}" has no graded mesh'
    if journal.inlet == "none" and journal.cavitation.kind not in ("reynolds", "guembel"):
        yield "inlet", f"the law {journal.cavitation.kind} has no line of fresh oil of its own"
    if journal.heat is None:
        for key in ("limits.oil", "limits.oil_hours", "limits.temperature"):
            yield key, "the temperature of the film is not computed; give journal.heat"
    feels = any(support.stiffness == "journal" for support in scene.shaft.coupled.values())
    read = feels or "journal.dynamics" in scene.results
    if isinstance(journal.heat, FilmHeat) and journal.heat.stiffness != "frozen" and not read:
        yield "heat.stiffness", "only journal.dynamics, or a shaft that feels its films, reads it"
    if not journal.in_motion:
        yield "step", "only a film in motion goes from step to step"
    if isinstance(journal.heat, Heat) and not journal.in_motion:
        for key in ("heat.capacity", "heat.start_temperature"):
            yield key, "only a film in motion stores heat"


def _of_least_film(journal: Journal) -> Iterator[tuple[str, str]]:
    """Limits of a film that may be no thinner than that at E_krit, as `Journal.least_film`."""
    film = journal.critical.film
    if film > journal.limits.least_film(journal.contact_film):
        why = f"the film at E_krit, (1 − eccentricity_ratio) c = {1e6 * film:.3g} µm, is thicker"
        for key in ("minimum_film", "waviness", "margin"):
            yield f"limits.{key}", why


def _of_film_limits(scene: Scene) -> Iterator[tuple[str, str]]:
    """Limits that no load case of simulated loads asks for."""
    if scene.loads.source != "simulate":
        return
    starts = [stands_or_starts(dlc) for dlc in scene.loads.dlcs]
    if not any(starts):
        yield "limits.start_time", NO_START
    if all(starts):
        for key in ("contact_time", "eccentricity_ratio", "sommerfeld_range", "sommerfeld_peak",
                    "waviness", "margin", "minimum_film"):  # fmt: skip
            yield f"limits.{key}", "no load case of this scene is of power production"


def _tilts(scene: Scene, bearing: str) -> bool:
    moment = scene.shaft.moment
    return scene.shaft.bends_at(bearing) or (moment is not None and bearing in moment.bearings)


def of_thrust(scene: Scene) -> Iterator[tuple[str, str]]:
    """Yield those of thrust bearings, as `of_journal`."""
    yield from _of_collars(scene)
    starts = scene.loads.source != "simulate" or any(map(stands_or_starts, scene.loads.dlcs))
    for place, one in scene.thrust.bearings.items():
        if not starts and one.limits.start_time is not None:
            yield f"thrust.bearings.{place}.limits.start_time", NO_START
        if one.kind == "thrust":
            yield from _of_pads(scene, place, one.geometry, one.back)


def _of_collars(scene: Scene) -> Iterator[tuple[str, str]]:
    """Keys of collars, and of how they lie against their pads."""
    thrust, collars = scene.thrust, scene.thrust.collars
    if not collars:
        for name in OF_COLLARS:
            if name in thrust.changed:
                yield f"thrust.{name}", "no bearing of this scene is a thrust collar"
        return
    bends = any(map(scene.shaft.bends_at, collars))
    if thrust.tilt and not bends:
        yield "thrust.tilt", "no shaft with a thrust collar is a beam"
    if thrust.tilt and all(one.self_aligning for one in collars.values()):
        yield "thrust.tilt", "pads that are self_aligning follow the collar"
    if not thrust.tilt and not (scene.asks and bends):
        for place, collar in collars.items():
            if collar.self_aligning and collar.seat is None:  # plans count what a seat leaves
                where = f"thrust.bearings.{place}.self_aligning"
                why = "only films with tilt know it; set thrust.tilt, with a beam as the shaft"
                yield where, why


def _of_pads(
    scene: Scene, place: str, front: ThrustBearing, back: ThrustBearing | None
) -> Iterator[tuple[str, str]]:
    """Keys of the rows of a collar: pads that always touch, or whose place does not count."""
    rows = {"geometry": front} if back is None else {"geometry": front, "back": back}
    cut = {key: r.pivot is None and isinstance(r.profile, Reversed) for key, r in rows.items()}
    simulated = scene.loads.source == "simulate"
    against = "is cut against the sense of rotation: the pads carry nothing"
    for key, row in rows.items():
        where = f"thrust.bearings.{place}.{key}"
        if simulated and cut["geometry"]:
            yield where, f"geometry.profile {against}, and touch under all thrust downwind"
        elif simulated and cut[key]:
            yield f"{where}.profile", f"it {against}"
        if row.first_pad and not scene.thrust.tilt:
            yield f"{where}.first_pad", "the collar stays aligned, so that all pads carry alike"
