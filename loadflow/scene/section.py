"""What all parts of a scene are."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import reduce
from operator import or_
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Discriminator, Tag

from loadflow.errors import InputError
from loadflow.numerics.fields import shown

SECTION = ConfigDict(extra="forbid", frozen=True, allow_inf_nan=False)
"""Of every part of a scene: frozen, and an unknown key is an error."""


class Section(BaseModel):
    """Part of a scene."""

    model_config = SECTION

    @property
    def changed(self) -> set[str]:
        """Keys whose value is not the default, also of a scene written with all its defaults."""
        known = type(self).model_fields
        return {name for name in known if getattr(self, name) != known[name].default}


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
