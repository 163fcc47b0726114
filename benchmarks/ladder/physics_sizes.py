"""How much each effect moves an answer, on single wind speeds of three turbines; docs/physics.md.

Each function measures one part, and yields turbine, wind speed and the sizes found there.
"""

from __future__ import annotations

import time
import tomllib
from collections.abc import Iterable, Iterator
from typing import Any

from benchmarks.common import ROOT
from benchmarks.ladder import wind
from loadflow.planning.pilot import Effort, pilot
from loadflow.rotor import simulate_condition
from loadflow.scene.bearings import standing_ring
from loadflow.scene.candidates import machine
from loadflow.scene.cases import Case, list_cases, wind_of
from loadflow.scene.scene import Scene
from loadflow.stages.effects import film as film_effects
from loadflow.stages.effects.rotor import LATERAL
from loadflow.stages.probes import PROBES, Answers
from loadflow.turbines import load_turbine
from loadflow.wind import Field

SPEEDS = (6.0, 12.0, 18.0, 24.0)
TURBINES = ("windpact-1.5mw", "nrel-5mw", "iea-15mw")

RESULTS = ["loads.statistics", "journal.film", "rolling.loads", "rolling.life"]
SHORT = {"duration": 60.0, "seeds": 1}
THOROUGH = Effort(1, 60.0)
"""Of the pilot, whose scenes here are too short for one that simulates."""

STEEL = 2.1e11  # Pa
OF_FILMS = (film_effects.CONTACT.name, film_effects.SHELL.name, film_effects.TURBULENCE.name)
REALISED = 6
"""Seeds of a wind speed where a mean over seeds is told."""

BLADES = "bending of the blades"
TOWER = "sway of the tower, twist of the drivetrain"
GRIDS = {"grid of the wind finer than 11 × 48": (11, 48), "… than 11 × 144": (11, 144)}
OVER_ROTOR = "turbulence that differs over the rotor"

REFERENCE = ROOT / "pipelines" / "dlc_1_1.toml"
STOP = ROOT / "pipelines" / "dlc_4_2_shutdown.toml"
HOLLOW = 0.9
"""Bore of the shaft over its diameter, as in the main job."""


def scene_of(
    turbine: str,
    film: dict[str, Any] | None = None,
    sized: bool = False,
    **keys: Any,
) -> Scene:
    """Two journal bearings and a ball bearing for the moment; the shaft as a beam as wide as they.

    The journal bearings are those of the main job, their diameter and width in proportion to the
    rotor's, or `sized`: those of the package for this turbine. `film` are keys of them. The ball
    bearing is the sized one; its rings are square, with sides of 2.4 balls.
    """
    known = machine(turbine)
    shaft = {place: dict(keys) for place, keys in known["shaft"].items()}
    two = next(place for place in shaft if place != "moment")
    rolling = known["candidates"]["four-point"]
    ball = rolling["M"]["geometry"]
    side, mean = 2.4 * ball["ball_diameter"], ball["pitch_diameter"] / 2
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
        own = main | {"geometry": main["geometry"] | lengths}
        journal = dict.fromkeys(("N", "N2"), own)
        outer = lengths["diameter"]
        section = {"outer_diameter": outer, "inner_diameter": HOLLOW * outer}
        shaft[two]["beam"] = {"sections": [section]}
    bearings = {place: journal[place] | (film or {}) for place in ("N", "N2")}
    bearings["M"] = rolling["M"] | around
    made = {"name": "physics", "turbine": {"name": turbine}, "results": RESULTS, "shaft": shaft}
    return Scene.model_validate(made | {"bearings": bearings} | keys)


def sizes() -> Iterator[dict[str, Any]]:
    """Measured size of every effect, by turbine and wind speed."""
    for turbine in TURBINES:
        for speed in SPEEDS:
            loads = {"wind_speeds": [speed]} | SHORT
            scene = scene_of(turbine, loads=loads, accuracy=0.02)
            begun = time.process_time()
            verdict = pilot(scene, effort=THOROUGH)
            print(turbine, speed, f"{time.process_time() - begun:.0f} s", flush=True)
            if verdict is not None:
                yield {
                    "turbine": turbine,
                    "speed": speed,
                    "sizes": verdict.sizes,
                    "refused": verdict.refused,
                }


def elements() -> Iterator[dict[str, Any]]:
    """Measured size of profile and tilt of rollers in a sized tapered pair, as `sizes`."""
    for turbine in TURBINES:
        bearing = machine(turbine)["candidates"]["tapered-pair"]["M"]
        places = {"bearings": {"M": bearing}, "shaft": {"moment": {}}}
        for speed in SPEEDS:
            loads = {"wind_speeds": [speed], "rung": "tables"} | SHORT
            made = {"name": "physics", "turbine": {"name": turbine}, "results": RESULTS[2:]}
            scene = Scene.model_validate(made | places | {"loads": loads, "accuracy": 0.02})
            verdict = pilot(scene, effort=THOROUGH)
            assert verdict is not None
            rollers = {name: verdict.sizes[name] for name in verdict.sizes if "rollers" in name}
            yield {"turbine": turbine, "speed": speed, "sizes": rollers}


def films() -> Iterator[dict[str, Any]]:
    """Measured size of contact, shell and turbulence of films that have them, as `sizes`."""
    stop = tomllib.loads(STOP.read_text(encoding="utf-8"))["bearings"]["N"]
    for turbine in TURBINES:
        wall = 0.1 * scene_of(turbine).journal.geometry.diameter
        shell = {"kind": "local", "compliance": 0.2 * wall / STEEL}
        film = {"contact": stop["contact"], "shell": shell, "turbulence": {}}
        for speed in SPEEDS:
            loads = {"wind_speeds": [speed], "rung": "tables"} | SHORT
            results = ["journal.film"]
            scene = scene_of(turbine, film=film, loads=loads, accuracy=0.02, results=results)
            verdict = pilot(scene, effort=THOROUGH)
            assert verdict is not None
            ours = {one: verdict.sizes[one] for one in OF_FILMS if one in verdict.sizes}
            print(turbine, speed, ours, flush=True)
            yield {"turbine": turbine, "speed": speed, "sizes": ours}


def lateral() -> Iterator[dict[str, Any]]:
    """What is lost without coherence of v and w: of means over `REALISED` seeds of 120 s.

    With it a seed is another wind, so that a pilot, which has one, cannot tell.
    """
    for turbine in TURBINES:
        for speed in SPEEDS:
            known, without = (
                _mean(
                    PROBES["loads"].answers(scene, case, {})
                    for scene in [_realised(turbine, speed, lateral=kind)]
                    for case in list_cases(scene)
                )
                for kind in ("coherent", "independent")
            )
            yield {
                "turbine": turbine,
                "speed": speed,
                "sizes": {LATERAL.name: _change(without, known)},
            }


def rotors() -> Iterator[dict[str, Any]]:
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
    for turbine in TURBINES:
        for speed in SPEEDS:
            scene = _realised(turbine, speed, dynamic_inflow=True, dynamic_stall=True)
            found: dict[str, list[Answers]] = {name: [] for name in variants}
            for case in list_cases(scene):
                field = wind.turbulence(scene, case, wind.FINEST, "fast")
                for name, (rung, grid) in variants.items():
                    met = (
                        wind.everywhere(field, None) if grid is None else wind.thinned(field, grid)
                    )
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


def _realised(turbine: str, speed: float, **loads: Any) -> Scene:
    """A scene of `REALISED` seeds of 120 s at a wind speed."""
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


BESIDE = {"elements": elements, "films": films, "lateral": lateral, "rotors": rotors}
"""What scenes of `sizes` do not have, and what a pilot cannot tell."""


def joined(kept: dict[str, Any]) -> list[dict[str, Any]]:
    """Sizes of all effects, of those among them that have a part of their own."""
    measured = []
    for one in kept["sizes"]:
        place = one["turbine"], one["speed"]
        more = {
            name: size
            for part in BESIDE
            for other in kept.get(part, [])
            if (other["turbine"], other["speed"]) == place
            for name, size in other["sizes"].items()
        }
        measured.append(one | {"sizes": one["sizes"] | more})
    return measured
