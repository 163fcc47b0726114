"""What all parts of a scene are."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict

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
