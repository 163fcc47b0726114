"""Candidates of a scene: arrangements of bearings that are compared under the same loads."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

from loadflow.errors import InputError
from loadflow.rolling.rings.usual import usual_rings
from loadflow.scene.places import GEOMETRIES

if TYPE_CHECKING:
    from collections.abc import Mapping

ABOUT = ("title", "source")
"""Keys of a candidate that say what it is."""

TOLERANCES = "tolerances"
"""Key of the tolerances of its bearings; all others are places."""


@cache
def machine_names() -> tuple[str, ...]:
    """Turbines for which sized main bearings come with the package.

    Examples
    --------
    >>> "nrel-5mw" in machine_names()
    True
    """
    folder = resources.files("loadflow").joinpath("data", "machines")
    return tuple(sorted(f.name[:-5] for f in folder.iterdir() if f.name.endswith(".toml")))


@cache
def _read(turbine: str) -> dict[str, Any]:
    file = resources.files("loadflow").joinpath("data", "machines", f"{turbine}.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def machine(turbine: str) -> dict[str, Any]:
    """Shaft and sized candidates of a turbine, as a scene writes them; empty if there are none.

    Parameters
    ----------
    turbine : str
        Name of a turbine.

    Returns
    -------
    dict
        `source`, `shaft`, `cooling` of all rolling bearings, and `candidates`.
    """
    return _read(turbine) if turbine in machine_names() else {}


@cache
def candidates_of(turbine: str) -> Mapping[str, Any]:
    """Sized candidates of a turbine by name, as scenes write them.

    Rolling bearings have rings that follow from their rolling elements, and the cooling that the
    machine states for all of them.

    Raises
    ------
    loadflow.errors.InputError
        One of them has no title or source, or a bearing of it cannot be; names its file.
    """
    read = machine(turbine)
    found: dict[str, Any] = read.get("candidates", {})
    shared = {"cooling": read["cooling"]} if "cooling" in read else {}
    for name, one in found.items():
        if missing := [key for key in ABOUT if key not in one]:
            raise InputError(f"{_file(turbine, name)}: {', '.join(missing)}: this key is missing")
    return {
        name: {
            key: _completed(part, shared, f"{_file(turbine, name)}.{key}")
            for key, part in one.items()
        }
        for name, one in found.items()
    }


def _file(turbine: str, name: str) -> str:
    """Where a candidate stands, for messages."""
    return f"data/machines/{turbine}.toml: candidates.{name}"


def _completed(part: Any, shared: dict[str, Any], place: str) -> Any:
    """A place with what all rolling bearings share, and usual rings where they may be flexible."""
    kind = part.get("kind") if isinstance(part, dict) else None
    if kind not in GEOMETRIES:
        return part
    if not GEOMETRIES[kind].flexible_rings:
        return shared | part
    try:
        inner, outer = usual_rings(GEOMETRIES[kind](**part["geometry"]))
    except InputError as error:
        raise InputError(f"{place}.geometry: {error}") from None
    except (KeyError, TypeError):  # a key too few or too many, which the scene names
        return shared | part
    return {"inner_ring": inner.written, "outer_ring": outer.written} | shared | part
