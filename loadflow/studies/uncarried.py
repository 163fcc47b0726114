"""Forces along the shaft at a place where the scene has no bearing, so that none carries them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np
import xarray as xr

from loadflow.scene.scene import Scene
from loadflow.verdict import Verdict

SLIGHT = 1e-6
"""Of the radial load: a force along the shaft below this is none."""


def empty_places(scene: Scene, solved: set[str]) -> Iterator[str]:
    """Yield the places that locate a shaft of `solved` bearings but have no bearing in the scene.

    A suspension none of whose bearings is solved has no arrangement to be judged.
    """
    rooms = {
        "journal": scene.journal.bearings,
        "rolling": scene.rolling.geometries,
        "thrust": scene.thrust.bearings,
    }
    # a room that is neither stated nor wanted has its defaults, which nobody put there
    stated = {n for n in rooms if n in scene.model_fields_set or scene.wants(n)}
    there = {place for name in stated for place in rooms[name]}
    for concept in scene.shaft.concepts:
        place = concept.bearings[concept.locating]
        if place not in there and solved & {*concept.bearings}:
            yield place


def uncarried(scene: Scene, tables: Mapping[str, xr.Dataset]) -> Iterator[Verdict]:
    """Yield a verdict on the force along the shaft at each place that locates it without a bearing.

    The loop over the bearings of a scene does not see such a place.
    """
    rooms = [name for name in ("journal", "rolling", "thrust") if name in tables]
    if "shaft" not in tables:
        return
    solved = {str(place) for name in rooms for place in tables[name]["bearing"].values}
    for place in empty_places(scene, solved):
        table = tables["shaft"].sel(bearing=place)
        forces = table["largest_axial_load"].values
        k = int(np.nanargmax(forces))
        value, case = float(forces[k]), str(table["case"].values[k])
        if not value > SLIGHT * float(table["largest_load"].max()):
            continue
        yield Verdict(
            f"{rooms[0]} arrangement", "force along the shaft without a bearing", value, 0.0,
            "at most", "N", "equilibrium of the shaft", case,
            float(table["largest_axial_load_time"].values[k]),
            f"none: {value / 1e3:.0f} kN along the shaft loads place {place}, which locates it; "
            f"place {place} has no bearing in this scene, and nothing in the scene carries it",
        )  # fmt: skip
