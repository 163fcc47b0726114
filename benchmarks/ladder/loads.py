"""Ladder of the stages that make and describe loads."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import xarray as xr

from benchmarks.common import seconds_of
from benchmarks.ladder.measuring import (
    Bench,
    Entry,
    Errors,
    Rungs,
    inputs,
    label,
    on_cases,
    percent,
    radial_loads,
    rounded,
    rung_key,
    sentence,
    with_ratios,
)
from benchmarks.ladder.supports import measure_supports
from loadflow.cube import make_cube, save_cube
from loadflow.reduction import damage_equivalent_load
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.changed import with_loads
from loadflow.scene.scene import Scene
from loadflow.scene.shaft import Shaft
from loadflow.shaft import (
    Beam,
    BearingSupport,
    DirectDrive,
    Integrated,
    MomentBearing,
    PitchBearing,
    ThreePoint,
    TwoPoint,
    YawBearing,
)
from loadflow.stages import loads, seeds, shaft, statistics

SLOPE = 4.0

Found = dict[tuple[str, str], float]
"""Of a case, by quantity and place."""

ROTOR = {
    "tables": ["rigid blades", "tabulated induction"],
    "bem": ["rigid blades", "blade-element momentum at every section and step"],
    "flap": ["two flap modes and one edge mode per blade", "tabulated induction"],
    "tower": ["as flap", "first tower modes", "torsion of the drivetrain"],
}
TOP = "tower"


def measure_loads(bench: Bench) -> Rungs:
    setting = bench.setting
    keys = {
        "wind_speeds": list(setting.wind_speeds),
        "seeds": setting.seeds,
        "duration": setting.duration,
    }
    described = {rung: dict(_describe_cases(bench.with_loads(**keys, rung=rung))) for rung in ROTOR}
    rungs: Rungs = {}
    for rung, includes in ROTOR.items():
        scene = bench.with_loads(
            wind_speeds=[12.0], seeds=1, duration=setting.full_duration, rung=rung
        )
        case = list_cases(scene)[0]
        seconds = seconds_of(lambda s=scene, c=case: loads.hub_loads(s, c, {}), setting.repeat)  # type: ignore[misc]
        errors = deviations(described[rung], described[TOP]).summary()
        rungs[rung_key(scene, "loads")] = {
            "settings": {"rung": rung},
            "includes": includes,
            "seconds_per_case": rounded(seconds * 600.0 / setting.full_duration),
            "reference": f"rung {TOP}, same wind",
            "cases": f"{on_cases(bench)}; {setting.seeds} seeds, {setting.duration:g} s",
            "errors": errors if rung != TOP else {},
            "error": sentence(
                errors, "tilt moment DEL", "yaw moment DEL", "bearing force DEL", "bearing load max"
            )
            + f" against {TOP}"
            if rung != TOP
            else "top rung; beside OpenFAST: docs/rotor.md",
        }
    return with_ratios(rungs | {"files": _files(bench)}, TOP)


def _describe_cases(scene: Scene) -> Iterator[tuple[str, Found]]:
    for case in list_cases(scene):
        yield label(case), describe(inputs(scene, case))


def describe(parts: dict[str, xr.Dataset]) -> Found:
    """Spread, damage and extreme of hub moments and bearing loads; mean of the bearing loads.

    And the slowest speed of the rotor, which films at low speed and κ follow.
    """
    hub, bearings = parts["loads"]["hub_moment"], parts["shaft"]
    tracks = {
        ("tilt moment", "hub"): hub.sel(axis="y"),
        ("yaw moment", "hub"): hub.sel(axis="z"),
    }
    for bearing in ("N", "N2"):
        for axis in ("y", "z"):
            tracks["bearing force", f"{bearing} F{axis}"] = bearings["force"].sel(
                bearing=bearing, axis=axis
            )
    duration = float(hub["time"][-1] - hub["time"][0])
    found: Found = {}
    for (name, where), data in tracks.items():
        values = data.values.astype(float)
        found[f"{name} std", where] = values.std()
        found[f"{name} DEL", where] = float(damage_equivalent_load(values, SLOPE, duration))
        if where == "hub":
            found[f"{name} max", where] = np.abs(values).max()
    for name, load in radial_loads(bearings).items():
        radial = np.hypot(load[:, 0], load[:, 1])
        found["bearing load max", name] = radial.max()
        if name != "M":  # the moment bearing is governed by the tilting moment
            found["radial force max", name] = radial.max()
        found["bearing load mean", name] = radial.mean()
    found["slowest speed", "rotor"] = float(np.abs(parts["loads"]["speed"].values).min())
    return found


def deviations(rung: dict[str, Found], top: dict[str, Found]) -> Errors:
    """Errors of a rung against the top one, over their cases."""
    errors = Errors()
    for case, found in rung.items():
        for (quantity, where), value in found.items():
            errors.add(quantity, f"{case}, {where}", value, top[case][quantity, where])
    return errors


def _files(bench: Bench) -> Entry:
    """Reading one case of a cube; single precision is all that it loses."""
    case, series = bench.middle, bench.series[bench.middle]["loads"]
    with tempfile.TemporaryDirectory() as folder:
        path = save_cube(make_cube([series]), Path(folder) / "loads.h5")
        scene = with_loads(bench.scene, [str(path)])
        given = list_cases(scene)[0]
        seconds = seconds_of(lambda: loads.hub_loads(scene, given, {}), bench.setting.repeat)
    return {
        "includes": ["what the given series include"],
        "seconds_per_case": rounded(seconds * 600.0 / bench.setting.full_duration),
        "reference": "the given series",
        "cases": f"a load cube, {label(case)}",
        "errors": {},
        "error": "that of the given series; stored in single precision, 6e-08",
    }


RIGID = "rigid shaft, weights, statically determinate"
BEAM = "shaft as a Timoshenko beam, tilt and curvature in the bearings"
TILTING = 5e8
"""N m/rad, of bearings that resist tilting, such as paired tapered rollers; assumed."""


def measure_shaft(bench: Bench) -> Rungs:
    two, one = TwoPoint(), MomentBearing()
    bent, stiff = replace(two, beam=Beam()), replace(one, beam=Beam())
    suspensions = [
        Shaft(two_point=two),
        Shaft(three_point=ThreePoint()),
        Shaft(integrated=Integrated()),
        Shaft(direct_drive=DirectDrive()),
        Shaft(moment=one),
        Shaft(two_point=two, moment=one),
        Shaft(two_point=bent),
        Shaft(moment=stiff),
        Shaft(two_point=bent, moment=one),
        Shaft(two_point=bent, moment=stiff),
        Shaft(yaw=YawBearing()),
        Shaft(pitch=PitchBearing()),
    ]
    rungs = {
        rung_key(bench.scene.model_copy(update={"shaft": section}), "shaft"): section
        for section in suspensions
    }

    root = bench.scene.model_copy(update={"shaft": Shaft(pitch=PitchBearing())})
    of_root = inputs(root, bench.middle)  # the series keeps what a blade does only if it is asked

    def loaded(section: Shaft) -> xr.Dataset:
        scene = bench.scene.model_copy(update={"shaft": section})
        parts = bench.series[bench.middle] if section.pitch is None else of_root
        return shaft.bearing_loads(scene, bench.middle, parts)

    def entry(section: Shaft) -> Entry:
        seconds = seconds_of(lambda: loaded(section), bench.setting.repeat)
        includes = BEAM if any(concept.beam for concept in section.concepts) else RIGID
        return _exact(bench, seconds, includes) | {"error": "exact (statically determinate)"}

    found = {name: entry(section) for name, section in rungs.items()}
    seat = BearingSupport(radial=5e9, takes_moment=True, tilt=TILTING)
    tough = loaded(Shaft(two_point=replace(two, beam=Beam(supports=(seat, seat)))))
    loads = {"rigid": loaded(rungs["two_point"]), "tough": tough}
    peaks = {
        kind: {n: np.hypot(*_across(data["force"].sel(bearing=n))).max() for n in ("N", "N2")}
        for kind, data in loads.items()
    }
    off = max(abs(peaks["rigid"][n] / peaks["tough"][n] - 1) for n in ("N", "N2"))
    found["two_point"]["error"] += (
        f"; if both bearings resist tilting with {TILTING:.0e} N m/rad, bearing load max ≤ "
        f"{percent(off)} against the beam"
    )
    return with_ratios(found | measure_supports(bench), "two_point+moment")


def _across(force: xr.DataArray) -> np.ndarray:
    return force.sel(axis=["y", "z"]).transpose("axis", "time").values


def _exact(bench: Bench, seconds: float, includes: str) -> Entry:
    return {
        "includes": [includes],
        "seconds_per_case": rounded(seconds * 600.0 / bench.setting.full_duration),
        "reference": "none needed",
        "cases": f"DLC 1.1, {label(bench.middle)}",
        "errors": {},
    }


def measure_statistics(bench: Bench) -> Rungs:
    case = bench.middle
    seconds = seconds_of(
        lambda: statistics.statistics(bench.scene, case, bench.series[case]), bench.setting.repeat
    )
    entry = _exact(bench, seconds, "mean, spread, extremes, rainflow count on every step")
    return with_ratios({"-": entry | {"error": "exact on the given series"}}, "-")


def measure_seeds(bench: Bench) -> Rungs:
    scene = bench.with_loads(
        wind_speeds=[12.0], seeds=6, duration=bench.setting.full_duration, rung="tables"
    )
    cases = list_cases(scene)
    parts = {case.name: inputs(scene, case) for case in cases}
    rungs: Rungs = {}
    for methods in (["as-printed"], ["calibrated"], ["as-printed", "calibrated"]):
        chosen = scene.seeds.model_copy(update={"methods": methods})
        tested = scene.model_copy(update={"seeds": chosen})
        judged = partial(_equality_of_seeds, tested, cases, parts)
        seconds = seconds_of(judged, bench.setting.repeat)
        entry = _exact(bench, seconds / len(cases), "location, spread and spectrum")
        rungs[rung_key(tested, "seeds")] = entry | {
            "cases": "DLC 1.1, 12 m/s, 6 seeds",
            "error": "rates of false alarms: docs/seeds.md",
        }
    return with_ratios(rungs, "as-printed+calibrated")


def _equality_of_seeds(
    scene: Scene, cases: list[Case], parts: dict[str, dict[str, xr.Dataset]]
) -> xr.Dataset:
    """All that the stage says of the cases, piece by piece as a run has it."""
    groups = [seeds.groups_in(scene, some, parts) for some in seeds.pieces(scene, cases)]
    return seeds.joined(scene, groups)
