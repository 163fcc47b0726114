"""How the shaft lies in the bearings of a candidate: its tilt over what they allow, its thrust."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import xarray as xr

from loadflow.cube.hdf5 import read_variables
from loadflow.scene.scene import Scene, read_scene
from loadflow.shaft import bearing_loads
from loadflow.shaft.options import Concept
from loadflow.studies.shaft_through import hollow_shaft, shaft_widths, through
from loadflow.studies.verdicts.uncarried import located

Tables = Mapping[str, xr.Dataset]


def carries_thrust(scene: Scene, tables: Tables) -> str:
    """What carries the force along the shaft, in words."""
    if "rolling" in tables:
        table = tables["rolling"]
        for place, bearing in scene.rolling.geometries.items():
            force = float(table["bearing_axial_force"].sel(bearing=place).max())
            if force > 0 and bearing.takes_thrust:
                return f"{place}, up to {force / 1e3:.0f} kN"
    if "thrust" in tables:
        forces = tables["thrust"]["largest_axial_load"].max("case")
        k = int(np.argmax(forces.values))
        return f"{forces['bearing'].values[k]}, up to {float(forces[k]) / 1e3:.0f} kN"
    left = []
    for one in located(scene, tables):
        if one.carried:
            return f"{one.place}, up to {one.force / 1e3:.0f} kN"
        left.append(one.force)
    if "journal" in tables and not left:
        left = [float(tables["journal"]["largest_axial_load"].max())]
    return f"no bearing; one for {max(left) / 1e3:.0f} kN is needed" if left else "no bearing"


@dataclass(frozen=True)
class Tilt:
    """Largest tilt of the shaft in a bearing over what that allows; NaN where none is limited.

    `time` is that of the largest in its case, s; `by_case` has the share in each load case.
    """

    share: float = math.nan
    place: str = ""
    case: str = ""
    time: float = math.nan
    note: str = "the bearing takes the moment, or aligns itself"
    by_case: dict[str, float] = field(default_factory=dict)


def shaft_tilt(scene: Scene, folder: Path, tables: Tables) -> Tilt:
    """Largest tilt of the shaft in a bearing over what it allows.

    The shaft bends as its beam does, made narrower where it would not pass through the bearings;
    without one, as a hollow beam that fits into them. A bearing that takes the moment tilts with
    the shaft, without a limit. Where a film was solved around the tilted shaft, what is left of it
    closes at a tilt that much larger.
    """
    from loadflow.turbines import load_turbine

    allowed = _allowed_tilts(scene, tables)
    ran = read_scene(folder / "scene.toml")  # with the effects that the run had
    tilted = ran.journal.tilting if "journal" in tables and ran.journal.tilt else ()
    widths = shaft_widths(
        scene.journal if "journal" in tables else None,
        scene.rolling if "rolling" in tables else None,
    )
    found: dict[str, Tilt] = {}
    gravity = load_turbine(scene.turbine.name).rotor.tilt
    for concept in scene.shaft.concepts:
        own = [place for place in concept.bearings if place in allowed]
        if not own or len(concept.bearings) < 2:
            continue
        line, note = _beam_through(concept, {place: widths[place] for place in own})
        for path in sorted((folder / "loads").glob("*.h5")):
            series = read_variables(path, ("hub_force", "hub_moment"))
            force, moment = (
                series[name].transpose("axis", "time").values.astype(float)
                for name in ("hub_force", "hub_moment")
            )
            tilts = bearing_loads(line, force, moment, tilt=gravity)["tilt"]
            across = tilts.sel(axis=["y", "z"]).transpose("bearing", "axis", "time").values
            size = np.linalg.norm(across, axis=1)
            times = series["time"].values[size.argmax(axis=1)].tolist()
            seen = zip(size.max(axis=1).tolist(), times)
            largest = dict(zip(tilts["bearing"].values.tolist(), seen))
            for place in own:
                limit, one = allowed[place], found.get(place, Tilt(0.0, place, note=note))
                if limit > 0:
                    tilt, time = largest[place]
                    share = tilt / (limit + (tilt if place in tilted else 0.0))
                    if share > one.share:
                        one = replace(one, share=share, case=path.stem, time=time)
                    found[place] = replace(one, by_case=one.by_case | {path.stem: share})
    return max(found.values(), key=lambda one: one.share, default=Tilt())


def _beam_through(concept: Concept, widths: Mapping[str, float]) -> tuple[Concept, str]:
    """The suspension on rigid bearings with a beam that passes through them, and which it is."""
    narrow = min(widths.values())
    if concept.beam is None:
        line = replace(concept, beam=hollow_shaft(narrow))
        note = f"of a hollow shaft of {1e3 * narrow:.0f} mm"
    else:
        line = through(concept, widths)
        fits = line is concept
        note = "" if fits else f"of the shaft made narrower, to pass through {1e3 * narrow:.0f} mm"
    assert line.beam is not None
    return replace(line, beam=line.beam.free_in_films().on_rigid_bearings()), note


def _allowed_tilts(scene: Scene, tables: Tables) -> dict[str, float]:
    """By place: tilt that the bearing allows, rad; 0: no limit.

    A journal bearing allows that which closes its smallest film at an end; one that is
    self-aligning has no limit.
    """
    found: dict[str, float] = {}
    if "journal" in tables:
        for place in scene.journal.bearings:
            film = float(tables["journal"]["smallest_film"].sel(bearing=place).min())
            end = 0.5 * scene.journal.at(place).geometry.width
            found[place] = film / end if place in scene.journal.tilting else 0.0
    if "rolling" in tables:
        for place, bearing in scene.rolling.geometries.items():
            found[place] = bearing.allowed_tilt or 0.0
    return found
