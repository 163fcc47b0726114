"""What all parts of a scene are."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from functools import reduce
from operator import or_
from typing import Annotated, Any, cast

from pydantic import (
    BaseModel,
    ConfigDict,
    Discriminator,
    GetCoreSchemaHandler,
    Tag,
    ValidationError,
)
from pydantic_core import CoreSchema

from loadflow.errors import InputError
from loadflow.numerics.fields import shown

SECTION = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
"""Of every part of a scene: frozen, and an unknown key is an error."""


def strict_numbers(schema: CoreSchema, handler: GetCoreSchemaHandler) -> CoreSchema:
    """Let numbers at any depth of a schema be numbers alone.

    Pydantic takes true for 1 and "63" for 63. Its option ``strict`` would ask for tuples and
    dataclasses themselves, too, which no TOML file can hold.
    """
    todo: list[Any] = [schema]
    seen = set[str]()
    while todo:
        part = todo.pop()
        if isinstance(part, list | tuple):
            todo += part
        elif isinstance(part, dict):
            kind = part.get("type")
            if kind in ("float", "int"):
                part["strict"] = True
            elif kind == "definition-ref" and part["schema_ref"] not in seen:
                seen.add(part["schema_ref"])
                todo.append(handler.resolve_ref_schema(cast("CoreSchema", part)))
            todo += part.values()
    return schema


class Section(BaseModel):
    """Part of a scene."""

    model_config = SECTION

    @classmethod
    def __get_pydantic_core_schema__(cls, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Schema of the part in which no number may be written as text, or as true."""
        return strict_numbers(handler(source), handler)

    @property
    def changed(self) -> set[str]:
        """Keys whose value is not the default, also of a scene written with all its defaults."""
        known = type(self).model_fields
        return {name for name in known if getattr(self, name) != known[name].default}


def is_valid(part: Section) -> bool:
    """Whether the values of a part fit each other; `model_copy` does not ask."""
    try:
        type(part).model_validate(dict(part))
    except ValidationError:
        return False
    return True


Keys = tuple[str | int, ...]
"""Keys down to a part of a scene."""


def keys_of(part: Any) -> dict[str, Any]:
    """Keys of a section, or fields of a dataclass, with their defaults; none of plain values."""
    if isinstance(part, BaseModel):
        return {name: field.default for name, field in type(part).model_fields.items()}
    if is_dataclass(part):
        return {field.name: field.default for field in fields(part) if field.init}
    return {}


def parts_of(value: Any, keys: Keys = ()) -> Iterator[tuple[Keys, Any]]:
    """Yield every section and dataclass in a value, at any depth, with the keys down to it."""
    inside: Any = ()
    if known := keys_of(value):
        yield keys, value
        inside = [(name, getattr(value, name)) for name in known]
    elif isinstance(value, Mapping):
        inside = value.items()
    elif isinstance(value, list | tuple):
        inside = enumerate(value)
    for name, part in inside:
        yield from parts_of(part, (*keys, name))


def idle_keys(value: Any, keys: Keys = ()) -> Iterator[tuple[Keys, str]]:
    """Yield what is set at any depth of a value and has no effect beside the rest, and why.

    The method ``idle`` of a class says which of its fields the others leave without effect, by
    name, or by names with dots of fields of its parts. Fields that have their defaults are no news.
    """
    for where, part in parts_of(value, keys):
        for name, reason in part.idle() if hasattr(part, "idle") else ():
            owner, (*tables, last) = part, name.split(".")
            for table in tables:
                owner = owner[int(table)] if table.isdecimal() else getattr(owner, table)
            default = keys_of(owner)[last]
            if default is MISSING or getattr(owner, last) != default:
                names = (int(table) if table.isdecimal() else table for table in tables)
                yield (*where, *names, last), reason


def kind_of(value: Any, usual: str | None = None) -> str | None:
    """The ``kind`` of a table or of what was read of it; `usual` where a table says nothing."""
    found = value.get("kind", usual) if isinstance(value, dict) else getattr(value, "kind", None)
    return found if isinstance(found, str) else None


def told_apart(kinds: Mapping[str, Any], usual: str | None = None) -> Any:
    """Type of a table whose ``kind`` says which of several it is, `usual` if it says nothing."""
    return Annotated[
        reduce(or_, (Annotated[cls, Tag(name)] for name, cls in kinds.items())),
        Discriminator(
            lambda value: kind_of(value, usual),
            custom_error_type="kind",
            custom_error_message="kind must be one of " + ", ".join(kinds),
        ),
    ]


def check_sizes(
    data: Any, kind: type[int] | type[float], largest: float, source: str, key: str = ""
) -> None:
    """Raise if nested tables hold a number of a kind that is larger than any quantity.

    Raises
    ------
    loadflow.errors.InputError
        With its key and the range. Infinite values are left to whoever knows the key.
    """
    items: Any = ()
    if isinstance(data, dict):
        items = data.items()
    elif isinstance(data, list | tuple):
        items = enumerate(data)
    elif isinstance(data, kind) and largest < abs(data) < math.inf:
        raise InputError(f"{source}: {key} = {shown(data)}: must be within ±{largest:g}")
    for name, value in items:
        check_sizes(value, kind, largest, source, f"{key}.{name}".lstrip("."))
