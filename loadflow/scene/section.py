"""What all parts of a scene are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from pydantic import BaseModel, ConfigDict

from loadflow.numerics.fields import LARGEST_INTEGER

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


def too_large(data: Any, key: str = "") -> Iterator[tuple[str, int]]:
    """Yield the integers of nested tables that no file of results can hold, by their key."""
    items: Any = ()
    if isinstance(data, dict):
        items = data.items()
    elif isinstance(data, list | tuple):
        items = enumerate(data)
    elif isinstance(data, int) and abs(data) > LARGEST_INTEGER:
        yield key, data
    for name, value in items:
        yield from too_large(value, f"{key}.{name}".lstrip("."))
