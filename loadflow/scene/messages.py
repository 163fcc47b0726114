"""What is wrong with a scene, in one line for each key: file, key, value, what is allowed."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import fields
from typing import Any, cast

from pydantic import ValidationError

from loadflow.numerics.fields import shown, unknown_key
from loadflow.scene.films import HEATS
from loadflow.scene.places import AXIAL, GEOMETRIES, Location


def message(
    error: ValidationError,
    source: str,
    origins: Mapping[Location, Location],
    defaults: Mapping[str, Any],
) -> str:
    """Tell the errors of a scene.

    Parameters
    ----------
    error : pydantic.ValidationError
        What pydantic found.
    source : str
        File of the scene.
    origins : mapping
        Where the data of a section was written.
    defaults : mapping
        Plain data of a scene of defaults, whose keys are known.
    """
    lines = []
    for item in _of_stated_kind(error.errors()):
        place = [*_place(item["loc"])]
        key = ".".join(str(part) for part in written(place, origins)) or "scene"
        reason = item["msg"].removeprefix("Value error, ").replace("Input should be", "must be")
        if item["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
            known = _known(item["loc"], place, defaults)
            lines.append(f"{source}: {key}: {unknown_key(str(item['loc'][-1]), known)}")
        elif item["type"] == "missing":
            lines.append(f"{source}: {key}: this key is missing")
        elif item["type"] == "value_error":
            lines.append(f"{source}: {key}: {reason}")
        else:
            lines.append(f"{source}: {key} = {shown(item['input'])}: {reason}")
    return "\n".join(lines)


def written(place: Iterable[int | str], origins: Mapping[Location, Location]) -> Location:
    """Keys as the scene has them, of keys in the sections."""
    location = tuple(place)
    for size in range(len(location), -1, -1):
        if location[:size] in origins:
            return (*origins[location[:size]], *location[size:])
    return location


def _known(location: Location, place: list[int | str], defaults: Mapping[str, Any]) -> list[str]:
    """Keys that are known where an unknown one stands."""
    if len(location) > 2 and location[-3] == "geometry" and location[-2] in GEOMETRIES:
        kind = GEOMETRIES[str(location[-2])]
        return ["kind", *(field.name for field in fields(cast("Any", kind)))]
    data: Any = defaults
    for part in place[:-1]:
        data = data.get(part) if isinstance(data, Mapping) else None
    found = list(data) if isinstance(data, Mapping) else []
    return [*found, "arrangement"] if place[:-1] == ["rolling"] else found


_TAGS: dict[int | str, Mapping[str, Any]] = {"geometry": GEOMETRIES, "heat": HEATS}
"""Kinds of the keys whose tables pydantic tags with them."""


def _place(location: Location) -> Iterator[int | str]:
    """Keys down to a value, without the tag that pydantic puts after a key with kinds."""
    for k, part in enumerate(location):
        before = location[k - 1] if k else ""
        of_place = location[max(k - 3, 0) : k - 1] == ("thrust", "bearings") and part in AXIAL
        if part not in _TAGS.get(before, ()) and not of_place:
            yield part


def _of_stated_kind(errors: list[Any]) -> list[Any]:
    """Drop what is said of alternatives of another ``kind`` than the scene states."""
    kinds = [e for e in errors if e["type"] == "literal_error" and e["loc"][-1] == "kind"]
    others = {e["loc"][:-1] for e in kinds}

    def other(location: tuple[Any, ...]) -> tuple[Any, ...] | None:
        return next((o for o in others if location[: len(o)] == o), None)

    right = {e["loc"] for e in errors if other(e["loc"]) is None}
    shown = []
    for item in errors:
        owner = other(item["loc"])
        known = owner is not None and any(loc[: len(owner) - 1] == owner[:-1] for loc in right)
        if owner is None or (not known and item in kinds):
            shown.append(item)
    return shown
