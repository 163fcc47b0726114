"""Keys of a scene that are set but change nothing in this scene, each with the reason."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from loadflow.rolling.friction import Churning
from loadflow.scene.candidate import Candidate
from loadflow.scene.candidates import candidates_of
from loadflow.scene.dynamics import OF_FILMS, OF_ROLLING, turning
from loadflow.scene.loads import Loads
from loadflow.scene.results import USUAL
from loadflow.scene.scene import Scene, make_scene
from loadflow.scene.section import Section, idle_keys
from loadflow.scene.unused_films import NO_START, of_journal, of_thrust
from loadflow.scene.unused_rolling import every_rolling, mounted, of_each_rolling, of_friction
from loadflow.turbines import load_turbine
from loadflow.turbines.files import scaled_name
from loadflow.wind.cases import LOAD_CASES, STANDING, LoadCase, stands_or_starts

_CUBES = (".h5", ".nc")
_SIMULATED = (
    "dlc", "wind_speeds", "seeds", "first_seed", "yaw_errors", "azimuths", "steady", "duration",
    "step", "category", "reference_intensity", "shear_exponent", "spectrum", "scaling", "lateral",
    "wind_grid", "rung", "dynamic_inflow", "dynamic_stall", "bend_twist", "blade_torsion",
    "individual_pitch", "mass_imbalance", "pitch_imbalance",
)  # fmt: skip
_TURBULENCE = ("seeds", "first_seed", "spectrum", "scaling", "lateral", "wind_grid")
_WITH_SIGMA = ("NTM", "ETM", "EOG", "EDC", "EWS")
_RESULTS = {
    "seeds": ("seeds",),
    "reduction": ("reduction", "journal", "rolling.l", "thrust"),
    "journal": ("journal",),
    "thrust": ("thrust", "journal.film"),  # whose verdict asks what takes the thrust
    "dynamics": ("journal.dynamics", "rolling.dynamics"),
    "wear": ("journal.wear",),
    "lifetime": ("journal.film", "journal.wear", "thrust", "rolling.life", "rolling.friction"),
    "rolling": ("rolling",),
    "friction": ("rolling",),
}
"""Beginnings of the results that read a section."""


def unused_keys(scene: Scene) -> dict[str, str]:
    """Return the keys that differ from their defaults but change nothing, and why.

    Parameters
    ----------
    scene : Scene
        A valid scene.

    Returns
    -------
    dict
        Reason by key, such as ``{"loads.seeds": "no load case of this scene has turbulence"}``.

    Examples
    --------
    >>> from loadflow.scene.scene import make_scene
    >>> unused_keys(make_scene({"name": "gust", "loads": {"dlc": "1.5", "seeds": 3}}))
    {'loads.seeds': 'no load case of this scene has turbulence'}
    """
    return dict(_all(scene))


def unused_warnings(scene: Scene) -> list[str]:
    """Return a sentence on each of them, and on a turbine that is scaled."""
    unused = [f"{key}: has no effect, {reason}" for key, reason in unused_keys(scene).items()]
    return [*scaling_note(scene), *unused]


def _all(scene: Scene) -> Iterator[tuple[str, str]]:
    unread = {section for section in _RESULTS if not _is_read(scene, section)}
    around = scene.environment.model_dump(mode="json", exclude_none=True)
    bare = {"turbine": {"name": scene.turbine.name}, "results": ["loads.statistics"]}
    default = make_scene(bare := bare | {"environment": around})
    sized: dict[str, dict[str, str]] = {name: {} for name in candidates_of(scene.turbine.name)}
    own = Candidate(journal=scene.journal, rolling=scene.rolling, thrust=scene.thrust)
    named = own.rooms_of(make_scene(bare | {"candidates": sized}).candidates.values())
    for section in sorted(unread - (named if named - unread else set())):
        if getattr(scene, section) != getattr(default, section):
            yield section, "no wanted result reads this section"
    silent = unread | named  # nobody wrote the keys of bearings that are taken by name
    for name in type(scene).model_fields:
        for keys, reason in idle_keys(getattr(scene, name), (name,)) if name not in silent else ():
            yield ".".join(map(str, keys)), reason
    yield from _of_shaft(scene)
    yield from of_thrust(scene) if "thrust" not in silent else ()
    yield from of_each_rolling(scene) if "rolling" not in silent else ()
    for section, rules in (
        ("environment", _of_environment),
        ("loads", _of_loads),
        ("reduction", _of_reduction),
        ("journal", of_journal),
        ("friction", of_friction),
        ("dynamics", _of_dynamics),
        ("wear", _of_wear),
        ("lifetime", _of_lifetime),
    ):
        for key, reason in rules(scene) if section not in silent else ():
            if _differs(scene, section, key):
                yield f"{section}.{key}", reason


def _is_read(scene: Scene, section: str) -> bool:
    supports = {support.stiffness for support in scene.shaft.coupled.values()}
    begins = _RESULTS[section]
    return section in supports or any(r.startswith(begins) for r in scene.results)


def _differs(scene: Scene, section: str, key: str) -> bool:
    """Whether a key, or a part of a table, differs from its default."""
    part = getattr(scene, section)
    *tables, last = key.split(".")
    for table in tables:
        part = part[table] if isinstance(part, dict) else getattr(part, table)
    if isinstance(part, dict):
        return last in part
    return last in part.changed if isinstance(part, Section) else bool(getattr(part, last))


def _of_environment(scene: Scene) -> Iterator[tuple[str, str]]:
    if scene.loads.source == "files":
        yield "air_density", "the loads are read from files"
    others = scene.candidates.values()
    journals = [one.journal for one in others if one.journal is not None]
    journals += [scene.journal] if scene.wants("journal") else []
    heats = [journal.at(place).heat for journal in journals for place in journal.bearings]
    warm = [heat for heat in heats if heat is not None]
    rolls = scene.wants("rolling") or any(one.rolling is not None for one in others)
    cooled = scene.friction.balances(every_rolling(scene))
    sheds = rolls and (bool(cooled) or mounted(scene))
    gives = sheds or any(heat.gives_off for heat in warm)
    if not (gives or scene.environment.cold_start):
        yield "temperature", "no bearing gives heat off to its surroundings, or starts cold"
    around = scene.environment.temperature
    cold = any(heat.inlet_temperature == around for heat in warm)
    cold = cold or (rolls and scene.friction.temperature == around)
    if not cold:
        why = "no film has a heat balance with an oil, and no result of a rolling bearing is wanted"
        if warm or rolls:
            why = "films and rolling bearings state the temperature of their oil"
        yield "cold_start", why
        if scene.environment.cold_start and not gives:
            yield "temperature", why


def scaling_note(scene: Scene) -> tuple[str, ...]:
    """A sentence on a turbine that is scaled by similarity; none of one that is not."""
    base, power = scaled_name(scene.turbine.name)
    if power is None:
        return ()
    kept = "bearings keep the size they have"
    if scene.loads.source == "files":
        kept += ", and the series of the files are taken as they are"
    return (
        f"turbine: {base} scaled to {power / 1e6:.4g} MW by similarity: real turbines of that size "
        f"are lighter and softer, and gravity does not follow; {kept}",
    )


def friction_note(scene: Scene) -> tuple[str, ...]:
    """A sentence on parts of the friction of rolling bearings that are wanted but not given."""
    if "rolling.friction" not in scene.results:
        return ()
    left_out = uncounted_friction(scene)
    if not left_out:
        return ()
    return (
        f"friction: {' and '.join(left_out)} of the rolling bearings not counted, as no closed "
        "form is trustworthy; friction.churning and friction.seal_torque take measured ones",
    )


def asks_for_friction(scene: Scene) -> bool:
    """Whether a scene wants the friction of rolling bearings, not only as one of all results."""
    stated = {"rolling", "friction"} & scene.model_fields_set or not {*USUAL} <= {*scene.results}
    return bool(stated) and "rolling.friction" in scene.results


def uncounted_friction(scene: Scene) -> list[str]:
    """Parts of the friction of rolling bearings that are not given."""
    options = scene.friction
    absent = {"churning": options.churning == Churning(), "seals": options.seal_torque == 0}
    return [part for part, is_absent in absent.items() if is_absent]


# --- loads ------------------------------------------------------------------------------------


def _of_loads(scene: Scene) -> Iterator[tuple[str, str]]:
    loads = scene.loads
    if loads.source == "files":
        yield from _of_files(loads)
        return
    for key in ("cases", "channels", "gauge_distance", "frame"):
        yield key, "the loads are simulated, no files are read"
    yield "weights", "the loads are simulated: their shares follow from the wind speed"
    if not loads.winds:
        yield "pattern", "the loads are simulated, no names of files are read"
    rows = [LOAD_CASES[dlc] for dlc in loads.dlcs]
    if loads.winds:
        why = "the wind fields are given"
        for key in ("category", "reference_intensity", "shear_exponent", "azimuths", "spectrum",
                    "scaling", "lateral", "steady"):  # fmt: skip
            yield key, why
    else:
        yield from _of_wind(loads, rows)
    yield from _of_rotor(loads, rows)
    if not load_turbine(scene.turbine.name).blade.twists:
        yield "blade_torsion", "the turbine does not tell the torsional stiffness of its blades"


def _of_files(loads: Loads) -> Iterator[tuple[str, str]]:
    for key in _SIMULATED:
        yield key, "the loads are read from files, nothing is simulated"
    if loads.weights == "given":
        for key in ("wind_class", "v_ref", "v_ave"):
            yield key, 'weights = "given" takes the shares of the files'
    if loads.files and all(Path(file).suffix in _CUBES for file in loads.files):
        for key in ("cases", "pattern", "channels", "gauge_distance", "frame"):
            yield key, "load cubes say themselves what their cases are"


def _of_wind(loads: Loads, rows: list[LoadCase]) -> Iterator[tuple[str, str]]:
    """Keys of the wind that none of the load cases needs."""
    turbulent = [row.turbulent and not (loads.steady and row.extreme) for row in rows]
    if not any(turbulent):
        for key in _TURBULENCE:
            yield key, "no load case of this scene has turbulence"
    if all(t and row.events[0] not in STANDING for t, row in zip(turbulent, rows)):
        yield "azimuths", "turbulence meets the rotor at any azimuth; only gusts have their own"
    if not any(row.wind in _WITH_SIGMA for row in rows):
        for key in ("category", "reference_intensity"):
            yield key, "no load case of this scene depends on the intensity of turbulence"
    if not any(row.wind in ("EWM50", "EWM1", "EOG") for row in rows):
        yield "v_ref", "no load case of this scene has an extreme wind"
    if all(row.extreme for row in rows):
        yield "shear_exponent", "extreme winds have 0.11"


def _of_rotor(loads: Loads, rows: list[LoadCase]) -> Iterator[tuple[str, str]]:
    standing = [row.events[0] in STANDING for row in rows]
    if loads.rung in ("tables", "bem"):
        yield "bend_twist", "the blades of this rung do not bend"
        yield "blade_torsion", "the blades of this rung do not bend"
    if all(standing):
        for key in ("individual_pitch", "dynamic_inflow"):
            yield key, "the rotor stands or idles in every load case"
        if loads.dynamic_stall:
            yield "dynamic_stall", "a rotor that stands or idles has it in any case"


def _of_shaft(scene: Scene) -> Iterator[tuple[str, str]]:
    """Places of masses that are zero."""
    if scaled_name(scene.turbine.name)[1] is not None:  # all places are other ones
        return
    for name, concept in scene.shaft:
        for place, mass in _PLACES.items() if concept else ():
            if not hasattr(concept, place) or getattr(concept, mass) > 0:
                continue
            if getattr(concept, place) != getattr(type(concept)(), place):
                yield f"shaft.{name}.{place}", f"{mass} is 0"


_PLACES = {
    "hub_to_shaft_centre": "shaft_mass",
    "hub_to_generator": "generator_mass",
    "second_to_gearbox": "gearbox_mass",
    "gearbox_offset": "gearbox_mass",
}

# --- bearings ---------------------------------------------------------------------------------


def _of_reduction(scene: Scene) -> Iterator[tuple[str, str]]:
    reads = any(r.startswith(("reduction", "rolling.l")) for r in scene.results)
    if scene.reduction.method != "periodic":
        for key in ("bounds", "additional", "orders"):
            yield key, 'only method = "periodic" has harmonics'
    elif scene.reduction.orders is not None:
        yield "additional", "orders say which harmonics there are"
    if scene.journal.in_motion and not reads:
        for key in type(scene.reduction).model_fields:
            yield key, "a film in motion reads the whole series"
    elif scene.reduction.method != "histogram":
        for key in ("size", "classes", "pick", "seed", "between", "grid"):
            yield key, f'method = "{scene.reduction.method}" keeps no samples of classes'
    elif scene.reduction.size == 1.0:
        for key in ("pick", "seed"):
            yield key, "size = 1 keeps every sample"
    elif scene.reduction.pick != "random":
        yield "seed", f'pick = "{scene.reduction.pick}" draws nothing at random'


def _of_wear(scene: Scene) -> Iterator[tuple[str, str]]:
    """Numbers of events that no load case of simulated loads takes."""
    if scene.loads.source == "files":  # their load cases are known when they are read
        return
    starts = set(filter(stands_or_starts, scene.loads.dlcs))
    counted, yearly = {*scene.wear.counts}, {*scene.lifetime.per_year}
    if not starts:
        yield "events", NO_START
    elif starts <= counted | yearly:
        told = {"wear.counts": starts & counted, "lifetime.per_year": starts & yearly - counted}
        by = " and ".join(key for key, cases in told.items() if cases)
        yield "events", f"{', '.join(sorted(starts))}, all that wears, have their number in {by}"
    if not starts & counted:
        yield "counts", f"no load case {', '.join(sorted(counted))} that starts, stops or stands"


def _of_lifetime(scene: Scene) -> Iterator[tuple[str, str]]:
    if "journal.wear" not in scene.results:
        yield "years", "the result journal.wear is not wanted"
        return
    counted = set(filter(stands_or_starts, scene.lifetime.per_year)) - {*scene.wear.counts}
    given = scene.loads.source == "files"  # whose load cases are known when they are read
    moves = scene.journal.in_motion or scene.asks  # then the plan may let films move
    produces = moves and (given or not all(map(stands_or_starts, scene.loads.dlcs)))
    if not (counted or produces):
        yield "years", "all that wears has its number in wear.events or wear.counts"


def _of_dynamics(scene: Scene) -> Iterator[tuple[str, str]]:
    films = scene.journal.bearings if OF_FILMS in scene.results else ()
    places: set[str] = {*films}
    kinds = ["journal"] if places else []
    if OF_ROLLING in scene.results:
        places |= {*turning(scene.rolling, scene.shaft)}
        kinds.append("rolling")
    else:
        for key in ("contact_model", "loss", "time_constant"):
            yield key, f"the result {OF_ROLLING} is not wanted"
    followed = OF_ROLLING in scene.results and scene.dynamics.rolling_follows
    pads = (scene.journal.at(place).geometry.has_pads for place in films)
    if not followed and not any(pads):
        yield "whirl", "none of these bearings has another K or C at another frequency"
    if not any(c.beam is not None and places & set(c.bearings) for c in scene.shaft.concepts):
        for key in ("modes", "unbalance"):
            yield key, f"no suspension with a {' or '.join(kinds)} bearing has a beam"
