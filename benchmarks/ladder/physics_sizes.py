"""How much each effect moves an answer, on single wind speeds of three turbines; docs/physics.md.

Each function measures one part, and yields turbine, wind speed and the sizes found there.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Iterable, Iterator
from itertools import product
from typing import Any

import numpy as np
import xarray as xr

from benchmarks.common import ROOT
from benchmarks.ladder import wind
from loadflow.errors import SolverError
from loadflow.journal import Growth, Heat
from loadflow.planning.effects import concerned, switched
from loadflow.planning.pilot import Effort, Questions, measure
from loadflow.planning.plan import chosen_models, needed_stages
from loadflow.rotor import simulate_condition
from loadflow.scene.bearings import standing_ring
from loadflow.scene.candidates import machine
from loadflow.scene.cases import Case, list_cases, wind_of
from loadflow.scene.scene import Scene
from loadflow.scene.shaft import Shaft
from loadflow.stages.effects import film as film_effects
from loadflow.stages.effects import film_heat
from loadflow.stages.effects import shaft as shaft_effects
from loadflow.stages.effects.clearances import CLEARANCES
from loadflow.stages.effects.effect import Effect
from loadflow.stages.effects.roller_profile import SLICED
from loadflow.stages.effects.rotor import LATERAL
from loadflow.stages.loads import hub_loads
from loadflow.stages.probes import PROBES, Answers
from loadflow.stages.shaft import bearing_loads
from loadflow.turbines import load_turbine
from loadflow.wind import Field

SPEEDS = (6.0, 12.0, 18.0, 24.0)
TURBINES = ("windpact-1.5mw", "nrel-5mw", "iea-15mw")

Found = Iterable[dict[str, Any]]
"""What a part has measured; each takes what is known of it, and yields the rest."""

FILM_ALONE = ["journal.film"]
RESULTS = ["loads.statistics", "journal.film", "rolling.loads", "rolling.life"]
SHORT = {"duration": 60.0, "seeds": 1}
THOROUGH = Effort(1, 60.0)
"""Of the pilot, whose scenes here are too short for one that simulates."""

STEEL = 2.1e11  # Pa
REALISED = 6
"""Seeds of a wind speed where a mean over seeds is told."""
COHERENT = 24
"""The same where other winds are compared: extremes of so many still scatter by 0.4 to 1 %."""
COHERENT_IN_LIGHT_WIND = 72
"""The same at the lowest wind speed, where that is as much as there is to tell."""

BLADES = "bending of the blades"
TOWER = "sway of the tower, twist of the drivetrain"
GRIDS = {"grid of the wind finer than 11 × 48": (11, 48), "… than 11 × 144": (11, 144)}
OVER_ROTOR = "turbulence that differs over the rotor"

FED = 1e5
"""Pressure of the grooves above that of the bearing ends, Pa."""

NO_ANSWER = "no answer"
"""Of an effect with which, or without which, no film carries the shaft."""

GROWTH = Growth(shell_share=film_heat.SHELL_SHARE)
"""Of shaft and shell of steel, the shell in a cooler housing."""

FREE, TAKING = {"stiffness": "journal"}, {"stiffness": "journal", "takes_moment": True}
SEATS: dict[str, dict[str, Any]] = {
    "stiffness of two films": {"supports": (FREE, FREE)},
    "… which take the moment": {"supports": (TAKING, TAKING)},
    "… of a ball bearing and a film": {
        "supports": (FREE, {"stiffness": "rolling", "takes_moment": True}),
        "ball": "N2",
    },
}
"""Suspensions of which the bearings' own stiffness is fed back to the shaft."""

REFERENCE = ROOT / "pipelines" / "dlc_1_1.toml"
STOP = ROOT / "pipelines" / "dlc_4_2_shutdown.toml"
FITS = 0.875
"""Width of a bearing over the distance to the next, at most."""
HOLLOW = 0.9
"""Bore of the shaft over its diameter, as in the main job."""


def scene_of(
    turbine: str,
    film: dict[str, Any] | None = None,
    sized: bool = False,
    supports: tuple[dict[str, Any], ...] = (),
    ball: str = "M",
    **keys: Any,
) -> Scene:
    """Two journal bearings and a ball bearing for the moment; the shaft as a beam as wide as they.

    The journal bearings are those of the main job, their diameter and width in proportion to the
    rotor's, as far as they fit beside each other, or `sized`: those of the package for this
    turbine. Their shells stay, as tilt is one of the effects. `film` are keys of them (None: left
    out), `supports` those of the beam. The ball bearing is the sized one; its rings are square,
    with sides of 2.4 balls. Beside the others it stands at M, or takes the place of one of them.
    """
    known = machine(turbine)
    shaft = {place: dict(keys) for place, keys in known["shaft"].items()}
    two = next(place for place in shaft if place != "moment")
    rolling = known["candidates"]["four-point"]
    inner = rolling["M"]["geometry"]
    side, mean = 2.4 * inner["ball_diameter"], inner["pitch_diameter"] / 2
    around = {
        f"{name}_ring": standing_ring(side, side, mean + sign * side / 2, wall=(0.06, 1.0))
        for name, sign in (("inner", -1), ("outer", 1))
    }
    if sized:
        journal = known["candidates"]["journal-cylindrical"]
        shaft[two]["beam"] = {}
    else:
        main = tomllib.loads(REFERENCE.read_text(encoding="utf-8"))["bearings"]["N"]
        size = load_turbine(turbine).rotor.radius / load_turbine("nrel-5mw").rotor.radius
        lengths = {key: size * main["geometry"][key] for key in ("diameter", "width")}
        first, *_, last = Shaft.model_validate({two: shaft[two]}).concepts[0].positions
        lengths["width"] = min(lengths["width"], FITS * (last - first))
        own = main | {"geometry": main["geometry"] | lengths}
        journal = dict.fromkeys(("N", "N2"), own)
        outer = lengths["diameter"]
        section = {"outer_diameter": outer, "inner_diameter": HOLLOW * outer}
        shaft[two]["beam"] = {"sections": [section], "supports": list(supports)}
    bearings = {
        place: {
            key: value
            for key, value in ({**journal[place], "self_aligning": None} | (film or {})).items()
            if value is not None
        }
        for place in ("N", "N2")
    }
    bearings[ball] = rolling["M"] | around
    if ball != "M":
        del shaft["moment"]
    made = {"name": "physics", "turbine": {"name": turbine}, "results": RESULTS, "shaft": shaft}
    return Scene.model_validate(made | {"bearings": bearings} | keys)


def _left(known: Found, speeds: tuple[float, ...] = SPEEDS) -> Iterator[tuple[str, float]]:
    """Turbines and wind speeds of which nothing is known yet."""
    there = {(one["turbine"], one["speed"]) for one in known}
    yield from (place for place in product(TURBINES, speeds) if place not in there)


def at_work(turbine: str, speed: float) -> Scene:
    """Scene of `sizes`: all effects that a plan may take of a shaft on rigid bearings."""
    loads = {"wind_speeds": [speed]} | SHORT
    return scene_of(turbine, supports=({}, {}), loads=loads, accuracy=0.02)


def sizes(known: Found) -> Found:
    """Measured size of every effect, by turbine and wind speed; of a shaft on rigid bearings.

    Where it tilts in its clearances other effects drown; that has a part of its own.
    """
    for turbine, speed in _left(known):
        scene = at_work(turbine, speed)
        chosen = chosen_models(scene, tuple(list_cases(scene))).scene
        others = [
            one
            for one in concerned(chosen, needed_stages(chosen))
            if one is not CLEARANCES and switched(chosen, one, not one.is_on(chosen)) is not None
        ]
        yield _measured(turbine, speed, chosen, *others)


def elements(known: Found) -> Found:
    """Measured size of profile and tilt of rollers in a sized tapered pair, as `sizes`."""
    for turbine, speed in _left(known):
        yield _measured(turbine, speed, on_rollers(turbine, speed), SLICED)


def on_rollers(turbine: str, speed: float) -> Scene:
    """Scene of `elements`: the sized pair of tapered rollers alone."""
    bearing = machine(turbine)["candidates"]["tapered-pair"]["M"]
    made = {"name": "physics", "turbine": {"name": turbine}, "results": RESULTS[2:]}
    made |= {"bearings": {"M": bearing}, "shaft": {"moment": {}}}
    made |= {"loads": _tabulated(speed), "accuracy": "given"}
    return Scene.model_validate(made)


def films(known: Found) -> Found:
    """Measured size of contact, shell and turbulence of films that have them, as `sizes`."""
    effects = (film_effects.CONTACT, film_effects.SHELL, film_effects.TURBULENCE)
    for turbine, speed in _left(known):
        yield _measured(turbine, speed, touching(turbine, speed), *effects)


def touching(turbine: str, speed: float) -> Scene:
    """Scene of `films`: with asperities, a shell and turbulence."""
    stop = tomllib.loads(STOP.read_text(encoding="utf-8"))["bearings"]["N"]
    wall = 0.1 * scene_of(turbine).journal.geometry.diameter
    shell = {"kind": "local", "compliance": 0.2 * wall / STEEL}
    film = {"contact": stop["contact"], "shell": shell, "turbulence": {}}
    return _warm_film(turbine, speed, film)


def oil(known: Found) -> Found:
    """Measured size of supply and growth of films that have them, as `sizes`.

    Two axial grooves of 0.7 of the width at the sides, at `FED` above the bearing ends; the
    clearance of the scene is that at 20 °C.
    """
    for turbine, speed in _left(known):
        scene = grooved(turbine, speed)
        yield _measured(turbine, speed, scene, film_effects.SUPPLY, film_heat.GROWTH)


def grooved(turbine: str, speed: float) -> Scene:
    """Scene of `oil`: with two grooves and a clearance that grows."""
    journal = scene_of(turbine).journal
    length, pressure = 0.7 * journal.geometry.width, journal.edge_pressure + FED
    grooves = [
        {"angle": angle, "length": length, "pressure": pressure}
        for angle in (math.pi / 2, -math.pi / 2)
    ]
    return _warm_film(turbine, speed, {"supply": {"grooves": grooves}}, GROWTH)


def _warm_film(
    turbine: str, speed: float, film: dict[str, Any], growth: Growth | None = None
) -> Scene:
    """Films of N and N2 in motion, warm, around a shaft that tilts, with more keys of theirs."""
    oil = film_heat.oil_of(scene_of(turbine).journal.lubricant)
    whole: dict[str, Any] = {"heat": Heat(oil, growth=growth), "lubricant": None, "rung": "reduced"}
    whole |= {"motion": "transient", "tilt": True}
    keys: dict[str, Any] = {"loads": _tabulated(speed), "accuracy": "given", "results": FILM_ALONE}
    return scene_of(turbine, film=whole | film, **keys)


def _tabulated(speed: float) -> dict[str, Any]:
    """Loads of one short case of a rotor from tables."""
    return {"wind_speeds": [speed], "rung": "tables"} | SHORT


def _measured(turbine: str, speed: float, scene: Scene, *effects: Effect) -> dict[str, Any]:
    """Sizes of some effects alone, in a scene that has all it is to have."""
    cases = tuple(list_cases(scene))
    names = tuple(effect.name for effect in effects)
    found = measure(Questions(scene, names, THOROUGH.duration, cases), cases[0])
    print(turbine, speed, found, flush=True)
    silent = {name: NO_ANSWER for name in names if name not in found.sizes}
    refused = {**silent, **found.refused}
    return {"turbine": turbine, "speed": speed, "sizes": found.sizes, "refused": refused}


def fed_back(known: Found) -> Found:
    """What is lost where the shaft stands on rigid bearings, not on the stiffness of its own.

    Loads, and films around the shaft that lies so; each suspension of `SEATS` alone. At one wind
    speed, as films at touching ends take long.
    """
    for turbine, speed in _left(known, speeds=(12.0,)):
        sizes: dict[str, dict[str, float]] = {}
        refused: dict[str, str] = {}
        hub = None
        for name, seat in SEATS.items():
            scene = on_seat(turbine, speed, seat)
            rigid = switched(scene, shaft_effects.STIFFNESS, False)
            assert rigid is not None
            (case,) = list_cases(scene)
            hub = hub_loads(scene, case, {}) if hub is None else hub
            try:
                whole, without = (_seated(one, case, hub) for one in (scene, rigid))
                sizes[name] = _change(without, whole)
            except SolverError:  # mostly as the shaft touches the ends of its bearings
                refused[name] = NO_ANSWER
        print(turbine, speed, sizes, refused, flush=True)
        yield {"turbine": turbine, "speed": speed, "sizes": sizes, "refused": refused}


def on_seat(turbine: str, speed: float, seat: dict[str, Any]) -> Scene:
    """Scene of `fed_back`: films at rest around a shaft that lies as bearings of `SEATS` let it."""
    film = {"motion": "quasi-static", "tilt": True, "rung": "reduced"}
    loads = _tabulated(speed)
    return scene_of(turbine, film=film, loads=loads, accuracy="given", **seat)


def _seated(scene: Scene, case: Case, hub: xr.Dataset) -> Answers:
    """Largest radial forces, and films around the shaft that lies as its bearings let it."""
    loads = bearing_loads(scene, case, {"loads": hub})
    if loads.attrs["converged"] != 1:  # some samples would stand on rigid bearings
        raise SolverError("shaft and bearings do not settle")
    radial = np.hypot(*loads["force"].sel(axis=["y", "z"]).transpose("axis", ...)).max("time")
    largest = {(str(one["bearing"].values), "bearing load max"): float(one) for one in radial}
    return largest | PROBES["journal"].answers(scene, case, {"loads": hub, "shaft": loads})


def clearances(known: Found) -> Found:
    """What is lost where a shaft on films that do not align themselves lies on rigid bearings."""
    for turbine, speed in _left(known):
        yield _measured(turbine, speed, in_clearances(turbine, speed), CLEARANCES)


def in_clearances(turbine: str, speed: float) -> Scene:
    """Scene of `clearances`: sized bores, aligned with the shaft as it lies at its usual load."""
    film = {"motion": "transient", "tilt": True, "rung": "reduced", "alignment": "mean"}
    known = machine(turbine)["shaft"]
    shaft = {place: dict(keys) | {"beam": {}} for place, keys in known.items() if place != "moment"}
    keys: dict[str, Any] = {"loads": _tabulated(speed), "accuracy": "given", "results": FILM_ALONE}
    return scene_of(turbine, film=film, sized=True, shaft=shaft | {"moment": {}}, **keys)


def lateral(known: Found) -> Found:
    """What is lost without coherence of v and w: of means over many seeds of 120 s.

    With it a seed is another wind, so that a pilot, which has one, cannot tell.
    """
    for turbine, speed in _left(known):
        seeds = COHERENT_IN_LIGHT_WIND if speed == SPEEDS[0] else COHERENT
        whole, without = (
            _mean(
                PROBES["loads"].answers(scene, case, {})
                for scene in [realised(turbine, speed, seeds=seeds, lateral=kind)]
                for case in list_cases(scene)
            )
            for kind in ("coherent", "independent")
        )
        yield {
            "turbine": turbine,
            "speed": speed,
            "sizes": {LATERAL.name: _change(without, whole)},
        }


def rotors(known: Found) -> Found:
    """What is lost without blades and tower that give way, and on a coarser grid of the wind.

    Of means over `REALISED` seeds of 120 s, all in the same turbulence, made on 21 × 144 points.
    Blades are left out of a rotor whose tower stands still, as no model has rigid ones on a tower.
    """
    variants = {
        "whole": ("tower", wind.FINEST),
        "no tower": ("flap", wind.FINEST),
        "rigid": ("tables", wind.FINEST),
        "hub": ("tower", None),
        **{name: ("tower", grid) for name, grid in GRIDS.items()},
    }
    for turbine, speed in _left(known):
        scene = in_one_wind(turbine, speed)
        found: dict[str, list[Answers]] = {name: [] for name in variants}
        for case in list_cases(scene):
            field = wind.turbulence(scene, case, wind.FINEST, "fast")
            for name, (rung, grid) in variants.items():
                met = wind.everywhere(field, None) if grid is None else wind.thinned(field, grid)
                found[name].append(_in_field(scene, case, met, rung))
        mean = {name: _mean(answers) for name, answers in found.items()}
        sizes = {
            BLADES: _change(mean["rigid"], mean["no tower"]),
            TOWER: _change(mean["no tower"], mean["whole"]),
            OVER_ROTOR: _change(mean["hub"], mean["whole"]),
            **{name: _change(mean[name], mean["whole"]) for name in GRIDS},
        }
        print(turbine, speed, sizes, flush=True)
        yield {"turbine": turbine, "speed": speed, "sizes": sizes}


def in_one_wind(turbine: str, speed: float) -> Scene:
    """Scene of `rotors`."""
    return realised(turbine, speed, dynamic_inflow=True, dynamic_stall=True)


def realised(turbine: str, speed: float, **loads: Any) -> Scene:
    """A scene of seeds of 120 s at a wind speed, `REALISED` of them where nothing else is said."""
    every = {"wind_speeds": [speed], "seeds": REALISED, "duration": 120.0}
    return scene_of(turbine, accuracy="given", loads=every | loads)


def _in_field(scene: Scene, case: Case, field: Field, rung: str) -> Answers:
    """Loads of the bearings, by a rotor of `rung` in a field of one's own."""
    loads = scene.loads
    hub = simulate_condition(
        scene.turbine.name,
        wind_of(scene, case),
        loads.wind_options,
        dt=loads.step,
        run_in=wind.RUN_IN,
        field=field,
        rung=rung,
        options=loads.rotor_options,
    )
    return PROBES["shaft"].answers(scene, case, {"loads": hub})


def _mean(answers: Iterable[Answers]) -> Answers:
    """Means over cases, by bearing and quantity."""
    found = list(answers)
    return {key: sum(one[key] for one in found) / len(found) for key in found[0]}


def _change(without: Answers, known: Answers) -> dict[str, float]:
    """Largest change of any bearing, by quantity."""
    sizes: dict[str, float] = {}
    for (bearing, quantity), value in known.items():
        change = abs(without[bearing, quantity] / value - 1.0)
        sizes[quantity] = max(sizes.get(quantity, 0.0), change)
    return sizes


BESIDE: dict[str, Callable[[Found], Found]] = {
    "elements": elements,
    "films": films,
    "oil": oil,
    "fed_back": fed_back,
    "clearances": clearances,
    "lateral": lateral,
    "rotors": rotors,
}
"""What scenes of `sizes` do not have, and what a pilot cannot tell."""


def joined(kept: dict[str, Any]) -> list[dict[str, Any]]:
    """Sizes of all effects, of those among them that have a part of their own."""
    measured = []
    for one in kept["sizes"]:
        place = one["turbine"], one["speed"]
        parts = [one] + [
            other
            for part in BESIDE
            for other in kept.get(part, [])
            if (other["turbine"], other["speed"]) == place
        ]
        whole = {
            key: {name: found for part in parts for name, found in part.get(key, {}).items()}
            for key in ("sizes", "refused")
        }
        measured.append(one | whole)
    return measured
