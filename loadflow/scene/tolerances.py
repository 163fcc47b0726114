"""Tolerances of values of bearings: how a scene states them, and the scene at their ends."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any, Self, TypeVar

from pydantic import BaseModel, ValidationError

from loadflow.errors import InputError
from loadflow.scene.bearings import Rolling
from loadflow.scene.candidates import ABOUT, TOLERANCES
from loadflow.scene.journal import Journal
from loadflow.scene.shaft import Shaft
from loadflow.scene.thrust import Thrust
from loadflow.tribology import lubricant

Tolerances = dict[str, dict[str, float]]
"""By place on the shaft and key of the bearing there: half of the band around the value, in its
unit; of ``heat.oil`` a share of its viscosity."""

ALIGNMENT = "alignment"
"""Key of a journal bearing that only a film with tilt knows."""

_STATED = {"value", "tolerance"}
_OIL = "oil"
_VISCOSITIES = ("viscosities", "reference_viscosity")

Part = TypeVar("Part", bound=BaseModel)


def taken_out(data: Mapping[str, Any]) -> dict[str, Any]:
    """A scene as it is written, with the tolerances of its bearings in a section of their own.

    Parameters
    ----------
    data : mapping
        With ``{ value = …, tolerance = … }`` in place of values of ``[bearings.PLACE]``, and of
        candidates.

    Returns
    -------
    dict
        With the values alone, and ``tolerances`` by place and key.

    Examples
    --------
    >>> found = taken_out({"bearings": {"N": {"kind": "journal",
    ...     "lubricant": {"viscosity": {"value": 0.05, "tolerance": 0.005}}}}})
    >>> found["bearings"]["N"]["lubricant"], found["tolerances"]
    ({'viscosity': 0.05}, {'N': {'lubricant.viscosity': 0.005}})
    """
    found = dict(data)
    if isinstance(places := data.get("bearings"), Mapping):
        bare, tolerances = _of_places(places)
        found |= {"bearings": bare} | _joined(tolerances, data)
    if isinstance(candidates := data.get("candidates"), Mapping):
        found["candidates"] = {name: _of_candidate(one) for name, one in candidates.items()}
    return found


def _of_candidate(stated: Any) -> Any:
    if not isinstance(stated, Mapping):
        return stated
    about = (*ABOUT, TOLERANCES)
    bare, tolerances = _of_places({k: part for k, part in stated.items() if k not in about})
    kept = {key: stated[key] for key in about if key in stated}
    return bare | kept | _joined(tolerances, stated)


def _joined(tolerances: Tolerances, data: Mapping[str, Any]) -> dict[str, Any]:
    """The section of tolerances, with those found beside values; none where there is none."""
    stated = data.get(TOLERANCES, {})
    if not tolerances or not isinstance(stated, Mapping):
        return {}
    places = dict.fromkeys([*stated, *tolerances])
    return {TOLERANCES: {p: {**stated.get(p, {}), **tolerances.get(p, {})} for p in places}}


def _of_places(places: Mapping[str, Any]) -> tuple[dict[str, Any], Tolerances]:
    """Places without the tolerances in them, and these; ``like`` another place has its, too."""
    bare: dict[str, Any] = {}
    own: Tolerances = {}
    for place, stated in places.items():
        parts = stated if isinstance(stated, list) else [stated]
        split = [_split(part) for part in parts]
        told = [part for part, _ in split]
        bare[place] = told if isinstance(stated, list) else told[0]
        own[place] = {key: tolerance for _, found in split for key, tolerance in found.items()}
    for place, stated in bare.items():
        for part in stated if isinstance(stated, list) else [stated]:
            other = part.get("like") if isinstance(part, Mapping) else None
            model = bare.get(other) if isinstance(other, str) else None
            if isinstance(other, str) and isinstance(model, Mapping):
                own[place] = {
                    key: tolerance
                    for key, tolerance in own[other].items()
                    if key.split(".")[0] not in part  # what it states itself
                } | own[place]
    return bare, {place: found for place, found in own.items() if found}


def _split(value: Any, key: tuple[str, ...] = ()) -> tuple[Any, dict[str, Any]]:
    """A value without the tolerances in it, and these by their key."""
    if isinstance(value, Mapping):
        if {*value} == _STATED:
            return value["value"], {".".join(key): value["tolerance"]}
        parts = {name: _split(part, (*key, str(name))) for name, part in value.items()}
        bare: Any = {name: part for name, (part, _) in parts.items()}
        return bare, {k: t for _, found in parts.values() for k, t in found.items()}
    if isinstance(value, list):
        several = [_split(part, (*key, str(k))) for k, part in enumerate(value)]
        return [part for part, _ in several], {k: t for _, f in several for k, t in f.items()}
    return value, {}


@dataclass(frozen=True)
class Toleranced:
    """The bearings of a scene, with the tolerances of their values.

    Attributes
    ----------
    tolerances : dict
        By place and key.
    journal, rolling, thrust
        Sections of the scene.

    Examples
    --------
    >>> bearings = Toleranced({"N": {"geometry.relative_clearance": 1e-4}}, Journal(), Rolling(),
    ...     Thrust())
    >>> low = bearings.at_end("geometry.relative_clearance", -1)
    >>> low.journal.at("N").geometry.relative_clearance
    0.0004
    """

    tolerances: Tolerances
    journal: Journal
    rolling: Rolling
    thrust: Thrust

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of all values that have a tolerance, each once."""
        return tuple(dict.fromkeys(key for keys in self.tolerances.values() for key in keys))

    def at_end(self, key: str, end: int) -> Self:
        """The bearings with a value of all that have a tolerance of it at an end of their bands.

        Parameters
        ----------
        key : str
            Of the value, such as ``"geometry.relative_clearance"``.
        end : int
            -1 for the lower, 1 for the upper end.

        Raises
        ------
        loadflow.errors.InputError
            No bearing of a place has a number of that key.
        pydantic.ValidationError
            The value is not allowed.
        """
        found = self
        for place, keys in self.tolerances.items():
            if key in keys:
                found = found._moved(place, key, end * keys[key])
        return found

    def check(self, shaft: Shaft, method: str) -> None:
        """Refuse tolerances of what no bearing has, and bands that leave the range of a value.

        Parameters
        ----------
        shaft : Shaft
            Only a shaft that bends knows how a bore is aligned.
        method : str
            Of the reduction.

        Raises
        ------
        ValueError
            Naming place, key and value.
        """
        for place, keys in self.tolerances.items():
            for key, tolerance in keys.items():
                told = f"tolerances.{place}.{key} = {tolerance:g}"
                if not (math.isfinite(tolerance) and tolerance > 0):
                    raise ValueError(f"{told}: must be > 0")
                if key.split(".")[0] == "seat":
                    raise ValueError(f"{told}: no film has its seat, whose effect plans estimate")
                for end in (-1, 1):
                    try:
                        self._moved(place, key, end * tolerance)
                    except (ValidationError, InputError) as error:
                        raise ValueError(f"{told}: {_first(error)}") from error
        for place in filter(self.is_turned, self.journal.bearings):
            where = f"journal.{ALIGNMENT}, bearing {place}"
            if place not in self.journal.tilting:
                raise ValueError(f"{where}: it is self_aligning, and never out of line")
            if not shaft.bends_at(place) or method == "periodic":
                raise ValueError(
                    f"{where}: only a film at rest or along the series, around a shaft with a "
                    "beam, knows it; give its suspension a beam"
                )

    def _no_number(self, place: str, key: str) -> str:
        film = self.journal.at(place) if place in self.journal.bearings else None
        if key == ALIGNMENT and film is not None and film.alignment == "mean":
            return 'its bore has alignment = "mean"; a tolerance is about a turn in rad'
        return "no bearing there has such a number"

    def is_turned(self, place: str) -> bool:
        """Whether the bore of a journal bearing is, or may be, out of line with its housing."""
        told = any(key.split(".")[0] == ALIGNMENT for key in self.tolerances.get(place, {}))
        return told or self.journal.at(place).alignment not in ("mean", (0.0, 0.0))

    def _moved(self, place: str, key: str, by: float) -> Self:
        """The bearings with a value of those of a place moved."""
        path = key.split(".")
        update: dict[str, Any] = {}
        journal, rolling, thrust = self.journal, self.rolling, self.thrust
        if place in journal.bearings and (film := _moved(journal.at(place), path, by)):
            update["journal"] = journal.model_copy(update={"own": {**journal.own, place: film}})
        if place == rolling.bearing and (first := _moved(rolling, path, by)):
            update["rolling"] = first
        for k, part in enumerate(rolling.further):
            if part.bearing == place and (other := _moved(part, path, by)):
                further = [*rolling.further[:k], other, *rolling.further[k + 1 :]]
                update["rolling"] = rolling.model_copy(update={"further": further})
        if place in thrust.bearings and (pads := _moved(thrust.bearings[place], path, by)):
            parts = {**thrust.bearings, place: pads}
            update["thrust"] = thrust.model_copy(update={"bearings": parts})
        if not update:
            raise InputError(self._no_number(place, path[0]))
        return replace(self, **update)


def _first(error: Exception) -> str:
    if isinstance(error, ValidationError):
        return "an end of its band: " + error.errors()[0]["msg"].removeprefix("Value error, ")
    return str(error)


def _moved(part: Part, path: Iterable[str], by: float) -> Part | None:
    """A bearing with one of its values moved; None if it has no such number.

    Raises
    ------
    pydantic.ValidationError
        The value is not allowed.
    """
    data = part.model_dump(mode="json", exclude_none=True)
    *tables, last = path
    at: Any = data
    for name in tables:
        at = _inside(at, name)
    before = _inside(at, last)
    if last == _OIL and isinstance(before, str | Mapping):
        at[last] = _thicker(before, 1.0 + by)
    elif isinstance(before, int | float) and not isinstance(before, bool):
        at[int(last) if isinstance(at, list) else last] = before + by
    else:
        return None
    return type(part).model_validate(data)


def _inside(table: Any, name: str) -> Any:
    """A part of a table or a list; None if it is not there."""
    if isinstance(table, list):
        return table[int(name)] if name.isdecimal() and int(name) < len(table) else None
    return table.get(name) if isinstance(table, dict) else None


def _thicker(oil: str | Mapping[str, Any], factor: float) -> dict[str, Any]:
    """Data of an oil whose viscosity is `factor` times as large at all temperatures."""
    data = asdict(lubricant(oil)) if isinstance(oil, str) else dict(oil)
    for name in _VISCOSITIES:
        if name in data:
            value = data[name]
            data[name] = [factor * v for v in value] if name == "viscosities" else factor * value
    return {key: value for key, value in data.items() if value is not None}
