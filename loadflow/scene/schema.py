"""JSON Schema of scenes as they are written, for editors that complete and check TOML."""

from __future__ import annotations

from typing import Any

from loadflow.scene.axial import ConePair
from loadflow.scene.places import COLLAR, GEOMETRIES, JOURNAL, OF_COLLARS
from loadflow.scene.scene import Scene
from loadflow.scene.thrust import ThrustCollar
from loadflow.scene.written import SCENE


def json_schema() -> dict[str, Any]:
    """JSON Schema of a scene, with ``[bearings.PLACE]`` and ``[candidates.NAME]``.

    Returns
    -------
    dict
        To be written as JSON; TOML editors read it (Taplo: ``#:schema FILE`` as the first line).

    Examples
    --------
    >>> schema = json_schema()
    >>> places, *names = schema["properties"]["bearings"]["anyOf"]
    >>> places["additionalProperties"]["$ref"]
    '#/$defs/Place'
    """
    schema = Scene.model_json_schema()
    parts, known = schema["$defs"], schema["properties"]
    parts["JournalPlace"] = _place(parts["Journal"], {JOURNAL: None}, drop=("bearings", "own"))
    rolling = {name: cls.__name__ for name, cls in GEOMETRIES.items()}
    for kind, geometry in rolling.items():
        parts[_name(kind)] = _place(parts["FurtherBearing"], {kind: geometry}, drop=("bearing",))
    axial = {cls.model_fields["kind"].default: cls.__name__ for cls in (ThrustCollar, ConePair)}
    for kind, section in axial.items():
        parts[_name(kind)] = _place(parts[section], {kind: None}, drop=("kind",))
        parts[_name(kind)]["required"] = ["kind", "geometry"]
    for key in OF_COLLARS:
        parts[_name(COLLAR)]["properties"][key] = parts["Thrust"]["properties"][key]
    kinds = ["JournalPlace", *map(_name, (*rolling, *axial))]
    like = {
        "type": "object",
        "required": ["like"],
        "properties": {
            "like": {"type": "string", "description": "Another place, whose data hold."}
        },
    }
    one = [*({"$ref": f"#/$defs/{name}"} for name in kinds), like]
    parts["Bearing"] = {"anyOf": one}
    several = {"type": "array", "items": {"$ref": "#/$defs/Bearing"}}
    parts["Place"] = {"anyOf": [{"$ref": "#/$defs/Bearing"}, several]}
    place = {"$ref": "#/$defs/Place"}
    known[SCENE.key] = {
        "type": "integer",
        "minimum": 1,
        "maximum": SCENE.version,
        "default": SCENE.version,
        "description": "Version of the form of scenes.",
    }
    sized = {"type": "string", "description": "A name of `loadflow list bearings`."}
    known["bearings"] = {
        "anyOf": [
            {"type": "object", "additionalProperties": place},
            sized,
            {"type": "array", "items": sized, "minItems": 1},
        ],
        "description": "By place on the shaft (N, N2, M): the bearing that stands there; or the "
        "names of bearings that are sized for the turbine.",
    }
    about = parts["Candidate"]["properties"]
    candidate = {
        "type": "object",
        "properties": {name: about[name] for name in ("title", "source", "tolerances")},
        "additionalProperties": place,
    }
    known["candidates"] = {
        "type": "object",
        "additionalProperties": candidate,
        "description": "Arrangements to compare; an empty table takes the one of that name that is "
        "sized for the turbine.",
    }
    _with_tolerances(schema)
    schema["required"] = [name for name in schema.get("required", []) if name != "name"]
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    schema["title"] = "loadflow scene"
    return schema


_TOLERANCED = "Toleranced"


def _with_tolerances(schema: dict[str, Any]) -> None:
    """Let each number of a bearing stand with its tolerance."""
    parts = schema["$defs"]
    parts[_TOLERANCED] = {
        "type": "object",
        "description": "A value with half of the band around it, in its unit.",
        "required": ["value", "tolerance"],
        "additionalProperties": False,
        "properties": {
            "value": {"type": ["number", "string"]},
            "tolerance": {"type": "number", "exclusiveMinimum": 0},
        },
    }
    seen: set[str] = set()
    todo = ["Bearing"]
    while todo:
        name = todo.pop()
        if name in seen or "Limits" in name:
            continue
        seen.add(name)
        for key, part in parts[name].get("properties", {}).items():
            todo += _references(part)
            for one in (part, *part.get("anyOf", [])):
                if "prefixItems" in one:
                    one["prefixItems"] = [_or_toleranced(item) for item in one["prefixItems"]]
            if _holds_a_number(part) or key == "oil":
                parts[name]["properties"][key] = _or_toleranced(part)
        todo += _references({k: v for k, v in parts[name].items() if k != "properties"})


def _or_toleranced(part: dict[str, Any]) -> dict[str, Any]:
    about = {k: part[k] for k in ("title", "description", "default") if k in part}
    rest = {k: value for k, value in part.items() if k not in about}
    either = rest.pop("anyOf") if [*rest] == ["anyOf"] else [rest]
    return about | {"anyOf": [*either, {"$ref": f"#/$defs/{_TOLERANCED}"}]}


def _references(part: Any) -> list[str]:
    """Names of all definitions that a part refers to."""
    if isinstance(part, dict):
        own = [part["$ref"].rpartition("/")[2]] if isinstance(part.get("$ref"), str) else []
        return own + [name for value in part.values() for name in _references(value)]
    if isinstance(part, list):
        return [name for value in part for name in _references(value)]
    return []


def _holds_a_number(part: dict[str, Any]) -> bool:
    return any(one.get("type") == "number" for one in (part, *part.get("anyOf", [])))


def _name(kind: str) -> str:
    return "".join(word.capitalize() for word in kind.split("-")) + "Place"


def _place(section: dict[str, Any], kinds: dict[str, str | None], drop: tuple[str, ...]) -> Any:
    """A section of one bearing as a place of that kind."""
    ((kind, geometry),) = kinds.items()
    own = {name: part for name, part in section["properties"].items() if name not in drop}
    if geometry is not None:
        own["geometry"] = {"$ref": f"#/$defs/{geometry}"}
    kept = ("type", "additionalProperties", "description")
    return {name: section[name] for name in kept if name in section} | {
        "properties": {"kind": {"const": kind}} | own,
        "required": ["kind"] if geometry is None else ["kind", "geometry"],
    }
