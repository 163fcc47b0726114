"""The section of a scene that says what surrounds the machine."""

from __future__ import annotations

from typing import Annotated, Any, Self

from pydantic import BaseModel, Field, model_validator

from loadflow.scene.section import Section


class Environment(Section, BaseModel):
    """Air around the turbine ([Jonuschies 2015], Table 1-2: −20 … 50 °C, 1.225 kg/m³).

    ``temperature`` (K) is that of the surroundings: journal bearings with a ``heat`` balance and
    the rolling bearings of ``[friction]`` give their heat off to it, where they state no ambient
    temperature of their own; of a film whose ``heat`` is that of its area the shell has it. With
    ``cold_start`` the oil has it, too: the film draws it in, and the rolling bearings are as cold,
    where they state no temperature. Shafts and shells of different material or warmth
    (``heat.growth``), and rolling bearings with a ``mounting``, have another clearance then; a
    uniform temperature does not move that of steel in steel. ``air_density`` (kg/m³) is that of
    simulated loads. Humidity and radiation of the sun move no bearing here, and are left out.
    """

    temperature: Annotated[float, Field(ge=223.15, le=333.15)] | None = None
    cold_start: bool = False
    air_density: Annotated[float, Field(ge=0.5, le=2.0)] = 1.225

    @model_validator(mode="after")
    def _cold_is_known(self) -> Self:
        if self.cold_start and self.temperature is None:
            raise ValueError("cold_start: needs environment.temperature")
        return self


def surrounded(data: dict[str, Any]) -> dict[str, Any]:
    """Data of a scene in sections, with the temperature around it where bearings state none."""
    told = data.get("environment")
    if not isinstance(told, dict) or not isinstance(told.get("temperature"), int | float):
        return data
    ambient, cold = float(told["temperature"]), told.get("cold_start") is True
    candidates = data.get("candidates")
    among = candidates if isinstance(candidates, dict) else {}
    every = [data, *(one for one in among.values() if isinstance(one, dict))]
    found = _with_warm_films(data, ambient, cold)
    if among:
        found["candidates"] = {
            name: _with_warm_films(one, ambient, cold) if isinstance(one, dict) else one
            for name, one in among.items()
        }
    friction = found.get("friction", {})
    if isinstance(friction, dict):
        gives = any(_gives_off(one.get("rolling")) for one in every)
        gives = gives or not {"conductance", "cooling"}.isdisjoint(friction)
        known = {"ambient_temperature": ambient} if gives else {}
        known |= {"temperature": ambient} if cold else {}
        found["friction"] = known | friction
    return found


def _with_warm_films(data: dict[str, Any], ambient: float, cold: bool) -> dict[str, Any]:
    """A copy of sections, the heat of whose journal bearings knows its surroundings."""
    found = dict(data)
    if isinstance(journal := found.get("journal"), dict):
        own = journal.get("own", {})
        warmed = _warmed(journal, ambient, cold)
        if isinstance(own, dict) and own:
            warmed["own"] = {
                place: _warmed(part, ambient, cold) if isinstance(part, dict) else part
                for place, part in own.items()
            }
        found["journal"] = warmed
    return found


def _gives_off(rolling: Any) -> bool:
    """Whether a rolling bearing states its cooling, or its clearance follows temperatures."""
    parts = rolling if isinstance(rolling, list) else [rolling]
    parts = [part for part in parts if isinstance(part, dict)]
    further = [part for one in parts for part in one.get("further") or () if isinstance(part, dict)]
    return any(
        part.get(key) is not None for part in (*parts, *further) for key in ("mounting", "cooling")
    )


def _warmed(journal: dict[str, Any], ambient: float, cold: bool) -> dict[str, Any]:
    """A journal bearing whose heat balance gives off to the surroundings, if it has one."""
    heat = journal.get("heat")
    if not isinstance(heat, dict):
        return dict(journal)
    # only where heat goes there: elsewhere it would be a key without effect that no scene states
    around: dict[Any, tuple[str, tuple[str, ...]]] = {
        "balance": ("ambient_temperature", ("transfer", "sump_transfer", "growth")),
        "film": ("shell_temperature", ("shell_transfer",)),
    }
    name, paths = around.get(heat.get("kind", "balance"), ("", ()))
    known = {name: ambient} if any(heat.get(path) not in (None, 0) for path in paths) else {}
    known |= {"inlet_temperature": ambient} if cold else {}
    return journal | {"heat": known | heat}
