"""The section ``[turbine]`` of a scene."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, field_validator, model_validator

from loadflow.scene.section import Section
from loadflow.scene.written import named_by_file
from loadflow.turbines import load_turbine


def _with_file(schema: dict[str, Any]) -> None:
    """Tell editors of the key that stands in place of the name."""
    schema["properties"]["file"] = {"title": "File", "type": "string"}


_MEASURES = {
    "power", "rated_power", "mass", "rotor_mass", "speed", "rated_speed", "diameter", "radius",
    "rotor_diameter", "hub_height",
}  # fmt: skip


class Turbine(Section, BaseModel):
    """The turbine: a name that `loadflow.turbines` knows, or a path to a file.

    ``file`` may stand in place of ``name``: a TOML file of a turbine, or a windIO file (.yaml).

    A name with ``@`` and a power in W, such as ``nrel-5mw@8e6``, is scaled to it by similarity; so
    is the suspension of the known turbine, where the scene states none. Bearings are not: they are
    to be sized anew.
    """

    model_config = ConfigDict(json_schema_extra=_with_file)

    name: str = "nrel-5mw"

    @model_validator(mode="before")
    @classmethod
    def _from_file(cls, data: Any) -> Any:
        if isinstance(data, dict) and (measures := sorted(_MEASURES & set(data))):
            raise ValueError(
                f"{', '.join(measures)}: a turbine is named, or has a file of its own "
                "(docs/turbine-files.md); of one known by its power alone, "
                'name = "nrel-5mw@3e6" is a first guess: 3e6 W by similarity'
            )
        return named_by_file(data)

    @field_validator("name")
    @classmethod
    def _readable(cls, name: str) -> str:
        load_turbine(name)
        return name
