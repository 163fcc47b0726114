"""What is wrong with a scene, in one line for each key: file, key, value, what is allowed."""

from __future__ import annotations

import difflib
import re
from collections.abc import Container, Iterable, Iterator, Mapping
from dataclasses import fields
from functools import cache
from typing import TYPE_CHECKING, Any, cast

from pydantic import BaseModel, ValidationError

from loadflow.numerics.fields import in_kelvin, meant, shown, unknown_key
from loadflow.scene.films import HEATS
from loadflow.scene.places import AXIAL, GEOMETRIES, Location

if TYPE_CHECKING:
    from pydantic_core import ErrorDetails

NAME = r"^[A-Za-z0-9_.-]+$"
"""What a scene may be called, as folders are named after it."""
NAME_SAYS = "letters from a to z, digits, '_', '.' and '-' only"


def message(
    error: ValidationError,
    source: str,
    origins: Mapping[Location, Location],
    model: type[BaseModel] | None = None,
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
    model : type, optional
        What was read, whose JSON Schema says what keys there are; None: they are not told.
    """
    lines = []
    classes = _schema(model).get("$defs", {})
    for item in _of_given_type(_of_stated_kind(error.errors()), classes):
        place = [part for part in _place(item["loc"]) if part not in classes]
        key = ".".join(str(part) for part in written(place, origins)) or "scene"
        reason = item["msg"].removeprefix("Value error, ").replace("Input should be", "must be")
        if item.get("ctx", {}).get("pattern") == NAME:
            reason = NAME_SAYS
        if item["type"] in ("extra_forbidden", "unexpected_keyword_argument"):
            lines.append(f"{source}: {key}: {_unknown(item['loc'], _schema(model))}")
        elif item["type"] == "missing":
            lines.append(f"{source}: {key}: this key is missing")
        elif item["type"] == "value_error":
            told = [one if _names_key(key, one) else f"{key}: {one}" for one in reason.splitlines()]
            lines += [f"{source}: {one}" for one in told]
        elif item["type"] in _NO_TABLE:
            known = _known(item["loc"], _schema(model))
            keys = ", ".join(path for path, name in known if path == name)
            table = f"must be a table, [{key}]" + (f", with keys of {keys}" if keys else "")
            lines.append(f"{source}: {key} = {shown(item['input'])}: {table}")
        else:
            near = meant(str(item["input"]), re.findall("'(.*?)'", reason)) if _listed(item) else ""
            least = item.get("ctx", {}).get("gt", item.get("ctx", {}).get("ge"))
            near = near or in_kelvin(
                str(item["loc"][-1] if item["loc"] else ""), item["input"], least
            )
            lines.append(f"{source}: {key} = {shown(item['input'])}: {reason}{near}")
    return "\n".join(lines)


def beside_bearings(
    error: ValidationError, data: Mapping[str, Any], source: str, model: type[BaseModel]
) -> str:
    """What else is wrong in a scene whose bearings could not be read, which ends all checks.

    Parameters
    ----------
    error : pydantic.ValidationError
        What pydantic found.
    data : mapping
        The scene as it is written.
    source : str
        File of the scene.
    model : type
        Class of scenes.

    Returns
    -------
    str
        Further lines; empty where the bearings were read.
    """
    rest = {key: value for key, value in data.items() if key not in ("bearings", "candidates")}
    if len(rest) == len(data) or any(item["loc"] for item in error.errors()):
        return ""
    try:
        model.model_validate(rest)
    except ValidationError as other:
        if all(item["loc"] for item in other.errors()):  # else for want of these bearings
            return "\n" + message(other, source, {}, model)
    return ""


@cache
def _schema(model: type[BaseModel] | None) -> Mapping[str, Any]:
    """JSON Schema of a class, made once: that of a scene takes a tenth of a second."""
    return model.model_json_schema() if model else {}


def written(place: Iterable[int | str], origins: Mapping[Location, Location]) -> Location:
    """Keys as the scene has them, of keys in the sections."""
    location = tuple(place)
    for size in range(len(location), -1, -1):
        if location[:size] in origins:
            return (*origins[location[:size]], *location[size:])
    return location


def _names_key(key: str, reason: str) -> bool:
    """Whether what is said of a scene as a whole begins with the key that it is about."""
    return key == "scene" and re.match(r"[\w.-]+( = |: )", reason) is not None


_NO_TABLE = ("dataclass_type", "model_type", "dict_type", "mapping_type")
"""What pydantic says of a value where a table should stand."""


def _listed(item: ErrorDetails) -> bool:
    """Whether a word is none of those that are allowed."""
    return item["type"] == "literal_error" and isinstance(item["input"], str)


_CATALOGUE_WORDS = {
    "preload": ("clearance", "a preload is a negative clearance"),
    "osculation": ("groove_radius", "groove_radius is the osculation times ball_diameter"),
    "load_rating": ("dynamic_capacity", "C is dynamic_capacity"),
    "C": ("dynamic_capacity", "C is dynamic_capacity"),
    "static_capacity": ("dynamic_capacity", "C₀ follows from the geometry (ISO 76)"),
    "C0": ("dynamic_capacity", "C₀ follows from the geometry (ISO 76)"),
}
"""What catalogues call that has no key: the key that stands for it, and what to write."""


def _unknown(location: Location, schema: Mapping[str, Any]) -> str:
    """Say that a key is unknown, what is known there, and which may be meant, there or below."""
    *above, name = location
    known = _known(tuple(above), schema)
    here = [key for path, key in known if path == key]
    key, says = _CATALOGUE_WORDS.get(str(name), ("", ""))
    if key in here:
        return f"unknown key; {says}; known here: {', '.join(sorted(here))}"
    told = unknown_key(str(name), here)
    if meant(str(name), here):
        return told
    near = difflib.get_close_matches(str(name), [key for _, key in known], n=1, cutoff=0.75)
    below = [path for path, key in known if key in near]
    return told.replace("unknown key", f"unknown key; did you mean {below[0]}?") if below else told


def _known(location: Location, schema: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Keys that are known where an unknown one stands; beside each where it stands below there."""
    if location[-2:-1] == ("geometry",) and location[-1] in GEOMETRIES:  # read by its kind
        own = fields(cast("Any", GEOMETRIES[str(location[-1])]))
        return [(name, name) for name in ("kind", *(field.name for field in own))]
    nodes = [schema]
    for part in location:
        nodes = [found for node in nodes for found in _below(node, part, schema)]
    found = {key: key for node in nodes for key in _keys(node, schema)}
    deeper = {
        f"{key}.{inner}": inner
        for node in nodes
        for key, below in _keys(node, schema).items()
        for inner in _keys(below, schema)
    }
    more = ["arrangement"] if location == ("rolling",) else []  # written for a bearing
    if not location and "rolling" in found:  # a scene: become sections before it is read
        more = ["bearings", "schema"]
    return [*((name, name) for name in (*found, *more)), *deeper.items()]


def _below(
    node: Mapping[str, Any], part: int | str, schema: Mapping[str, Any]
) -> Iterator[Mapping[str, Any]]:
    """What a schema says of one part of a place; a tag of pydantic leads to its alternative."""
    for name, one in _alternatives(node, schema):
        keys = one.get("properties", {})
        kind = keys.get("kind", {})
        if isinstance(part, int):
            yield one["prefixItems"][0] if "prefixItems" in one else one.get("items", {})
        elif part in keys:
            yield keys[part]
        elif part in (name, kind.get("const"), kind.get("default")):
            yield one
        elif isinstance(one.get("additionalProperties"), Mapping):
            yield one["additionalProperties"]


def _keys(node: Mapping[str, Any], schema: Mapping[str, Any]) -> dict[str, Any]:
    """Keys of a table, of all that it may be."""
    return {
        key: below
        for _, one in _alternatives(node, schema)
        for key, below in one.get("properties", {}).items()
    }


def _alternatives(
    node: Mapping[str, Any], schema: Mapping[str, Any]
) -> Iterator[tuple[str, Mapping[str, Any]]]:
    """Each of what a part of a schema may be, with its name where it has one."""
    if "$ref" in node:
        name = node["$ref"].rpartition("/")[2]
        for inner, one in _alternatives(schema["$defs"][name], schema):
            yield inner or name, one
        return
    several = [one for word in ("anyOf", "oneOf", "allOf") for one in node.get(word, ())]
    if not several:
        yield "", node
    for one in several:
        yield from _alternatives(one, schema)


_TAGS: dict[int | str, Mapping[str, Any]] = {"geometry": GEOMETRIES, "heat": HEATS}
"""Kinds of the keys whose tables pydantic tags with them."""


def _place(location: Location) -> Iterator[int | str]:
    """Keys down to a value, without the tag that pydantic puts after a key with kinds."""
    for k, part in enumerate(location):
        before = location[k - 1] if k else ""
        of_place = location[max(k - 3, 0) : k - 1] == ("thrust", "bearings") and part in AXIAL
        if part not in _TAGS.get(before, ()) and not of_place and part != "[key]":
            yield part


_TYPES = {
    "constrained": int | float, "float": int | float, "int": int, "str": str, "literal": str,
    "dict": Mapping, "list": list, "tuple": list,
}  # fmt: skip
"""What a value is, by how pydantic names a type that a key may have beside others."""


def _type_of(part: int | str, tables: Container[Any]) -> Any:
    """Type that pydantic put after a key which may have several; None: it is a key."""
    if part in tables:
        return Mapping
    name = re.fullmatch(r"(\w+)(-\w+|\[.*\])?", str(part))
    return _TYPES.get(name[1]) if name else None


def _of_given_type(errors: list[Any], classes: Container[Any]) -> list[Any]:
    """Of a key that may have several types, what is said of the one that stands there.

    Where none of them stands there, one line says what all of them ask for.
    """
    shown, several = [], dict[Location, list[Any]]()
    for item in errors:
        tables = classes if item["type"] in _NO_TABLE else ()
        types = [_type_of(part, tables) if k else None for k, part in enumerate(item["loc"])]
        k = next((k for k, one in enumerate(types) if one), None)
        if k is None:
            shown.append(item)
            continue
        place = item["loc"][:k]
        told = {**item, "loc": (*place, *item["loc"][k + 1 :]), "of": types[k]}
        several.setdefault(place, []).append(told)
    for place, items in several.items():
        given = next((one["input"] for one in items if one["loc"] == place), None)
        fitting = [one for one in items if given is None or isinstance(given, one["of"])]
        fitting = [one for one in fitting if one["loc"] != place or one["type"] != "literal_error"]
        asked = [one["msg"].partition(", unable")[0] for one in items if one["loc"] == place]
        if not fitting and all(one["type"] in _NO_TABLE for one in items):
            fitting = items[:1]
        words = " or ".join(one.removeprefix("Input should be ") for one in asked)
        words = words.replace("valid dictionary", "table").replace("valid string", "text in quotes")
        shown += fitting or [{**items[0], "type": "", "msg": f"Input should be {words}"}]
    return shown


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
