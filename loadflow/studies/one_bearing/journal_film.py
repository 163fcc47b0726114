"""Bearing and film of the command line: the keys of a scene's section, given one by one."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from loadflow.errors import InputError

if TYPE_CHECKING:
    from loadflow.journal import Film, JournalBearing

Given = Mapping[str, Any]

EXAMPLE = (
    "loadflow journal --diameter 1.2 --width 1 --relative-clearance 1e-3 --viscosity 0.2 "
    "--force-x 1e6 --speed-rpm 12"
)
"""A call with all that one bearing needs."""


def journal_film(
    scene: Path | None,
    sets: Sequence[str],
    *,
    geometry: Given,
    viscosity: float | None,
    heat: Given,
    law: Given,
    grooves: Given,
    keys: Given,
) -> tuple[JournalBearing, Film]:
    """Return bearing and film of a scene, or of the keys given; None is not given.

    Parameters
    ----------
    scene : Path, optional
        Scene whose ``[journal]`` the other keys change. Without it the film is by default one of
        Reynolds' condition at no edge pressure, on the grid that suits its law.
    sets : sequence of str
        Keys of ``[journal]`` as lines of TOML.
    geometry, heat, law, keys : mapping
        Keys of the tables ``geometry``, ``heat`` and ``cavitation``, and of the section.
    viscosity : float, optional
        Pa s; or ``heat["oil"]``.
    grooves : mapping
        angles (rad), arc, length and pressure of axial grooves.

    Raises
    ------
    loadflow.errors.InputError
        A key that is unknown, missing, out of range or given twice.
    """
    from loadflow.journal import JournalBearing
    from loadflow.scene.journal import make_journal
    from loadflow.scene.scene import read_scene

    data: dict[str, Any] = {"cavitation": {"kind": "reynolds"}, "edge_pressure": 0.0}
    if scene is not None:
        data = read_scene(scene).journal.model_dump(exclude_unset=True)
    more = _tables(sets)
    sizes = _given(geometry)
    measures = sizes | more.get("geometry", {})
    has_oil = bool({"lubricant", "heat"} & more.keys())
    if scene is None:
        _check_needed([name for name in geometry if name not in measures], viscosity, heat, has_oil)
    oil = _oil(viscosity, heat)
    for name in ("lubricant", "heat"):
        if oil:
            data.pop(name, None)
    if scene is None:
        JournalBearing(**{name: measures[name] for name in geometry})  # in its own words
    data = _merged(data, {"geometry": sizes} if sizes else {}) | oil | _given(keys)
    data |= _law(law) | _supply(grooves, float(data.get("edge_pressure", 0.5e6)))
    section = make_journal(_merged(data, more), "journal")
    film = section.film_model
    if scene is None and keys.get("grid") is None and "grid" not in more:
        film = replace(film, grid=None)
    return section.geometry, film


def _given(values: Given) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def _tables(sets: Sequence[str]) -> dict[str, Any]:
    """Read lines ``key = value`` of TOML."""
    data: dict[str, Any] = {}
    for line in sets:
        try:
            data = _merged(data, tomllib.loads(line))
        except tomllib.TOMLDecodeError as error:
            raise InputError(f"--set {line}: not a line of TOML: {error}") from error
    return data


def _merged(one: dict[str, Any], other: dict[str, Any]) -> dict[str, Any]:
    """Tables of `one` with the keys of `other` set; a table with a kind of its own replaces."""
    data = dict(one)
    for name, value in other.items():
        old = data.get(name)
        join = isinstance(old, dict) and isinstance(value, dict) and "kind" not in value
        data[name] = _merged(old, value) if join and old is not None else value
    return data


def _check_needed(
    missing: Sequence[str], viscosity: float | None, heat: Given, has_oil: bool
) -> None:
    """Refuse a bearing or an oil that is not given, with all that is missing in one message."""
    needed = [f"--{name.replace('_', '-')}" for name in missing]
    if viscosity is None and heat["oil"] is None and not has_oil:
        needed.append("either --viscosity or --oil")
    if needed:
        told = " and ".join(filter(None, [", ".join(needed[:-1]), needed[-1]]))
        raise InputError(f"give {told}, or a scene with --scene; for example: {EXAMPLE}")


def _oil(viscosity: float | None, heat: Given) -> dict[str, Any]:
    oil = heat["oil"]
    if viscosity is None and oil is None:
        return {}
    if viscosity is not None and oil is not None:
        raise InputError("give either --viscosity or --oil")
    return {"lubricant": {"viscosity": viscosity}} if oil is None else {"heat": _given(heat)}


def _law(law: Given) -> dict[str, Any]:
    given = _given(law)
    if not given:
        return {}
    usual = "gas-mixture" if "mixing_constant" in given else "reynolds"
    return {"cavitation": {"kind": usual} | given}


def _supply(grooves: Given, edge_pressure: float) -> dict[str, Any]:
    length, pressure = grooves["length"], grooves["pressure"]
    if not grooves["angles"]:
        if pressure is not None or length is not None or grooves["arc"]:
            raise InputError("say where the grooves are: --groove-angle-deg, once for each")
        return {}
    same = {"arc": grooves["arc"], "pressure": edge_pressure if pressure is None else pressure}
    if length is not None:
        same["length"] = length
    return {"supply": {"grooves": [{"angle": angle} | same for angle in grooves["angles"]]}}
