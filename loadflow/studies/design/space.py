"""Keys of a candidate that may vary → the candidate at a point of their space."""

from __future__ import annotations

import copy
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from pydantic import ValidationError

from loadflow.errors import InputError
from loadflow.scene.design import Design, Variation
from loadflow.scene.friction import Friction
from loadflow.scene.messages import message
from loadflow.scene.places import JOURNAL, places_of, sections_of
from loadflow.scene.scene import Candidate, Scene

DIGITS = 4
"""Significant digits of a value: drawings have no more."""

DEFAULTS: dict[str, dict[str, tuple[float, float]]] = {
    JOURNAL: {
        "geometry.diameter": (0.7, 1.3),
        "geometry.width": (0.7, 1.3),
        "geometry.relative_clearance": (0.5, 2.0),
        "lubricant.viscosity": (0.5, 2.0),
    },
    "ball": {
        "geometry.ball_diameter": (0.8, 1.2),
        "geometry.pitch_diameter": (0.9, 1.2),
        "geometry.groove_radius": (0.99, 1.02),
    },
    "roller": {
        "geometry.roller_diameter": (0.8, 1.2),
        "geometry.roller_length": (0.7, 1.3),
        "geometry.pitch_diameter": (0.9, 1.2),
    },
}
"""What varies where a scene does not say: ends of ranges over the value that a candidate has."""

UNITS = {
    "diameter": "m", "width": "m", "viscosity": "Pa s", "density": "kg/m^3", "edge_pressure": "Pa",
    "clearance": "m", "roller_diameter": "m", "roller_length": "m", "pitch_diameter": "m",
    "ball_diameter": "m", "groove_radius": "m", "outer_groove_radius": "m", "crown_radius": "m",
    "row_spacing": "m", "contact_angle": "rad", "shaft_roughness": "m", "shell_roughness": "m",
    "temperature": "K", "inlet_temperature": "K", "pressure": "Pa", "angle": "rad", "arc": "rad",
    "length": "m", "depth": "m", "drop": "m",
}  # fmt: skip
"""Unit of a key by its last part; what is not here has none, or is not shown with one."""


@dataclass(frozen=True)
class Axis:
    """A key that varies.

    Attributes
    ----------
    key : str
        As the scene has it.
    low, high : float
        Ends of its coordinate: of the value itself, or of the number of one of `values`.
    values : tuple
        What it may take, if it is no range.
    whole : bool
        Whether only whole coordinates are legal.
    unit : str
        Of the value.
    """

    key: str
    low: float
    high: float
    values: tuple[Any, ...] = ()
    whole: bool = False
    unit: str = ""

    def value(self, coordinate: float) -> Any:
        """Value at a coordinate, in `DIGITS` significant digits.

        Examples
        --------
        >>> Axis("geometry.diameter", 1.0, 2.0).value(1.234567)
        1.235
        >>> Axis("lubricant", 0, 1, ("thin", "thick"), whole=True).value(0.9)
        'thick'
        """
        if self.values:
            return copy.deepcopy(self.values[int(np.clip(round(coordinate), self.low, self.high))])
        if self.whole:
            return int(np.clip(round(coordinate), self.low, self.high))
        return float(f"{coordinate:.{DIGITS}g}")

    def shown(self, coordinate: float) -> str:
        """The value in words."""
        value = self.value(coordinate)
        if isinstance(value, Mapping):
            return ", ".join(f"{name} {part}" for name, part in value.items())
        if isinstance(value, list):
            return "; ".join(map(str, value)) or "none"
        return f"{value:.{DIGITS}g}" if isinstance(value, float) else str(value)


@dataclass(frozen=True)
class Space:
    """The designs of one candidate.

    Attributes
    ----------
    axes : tuple of Axis
        What varies.
    places : mapping
        Data of its bearings by place, as a scene writes them.
    friction : mapping
        Data of the section on the friction of rolling bearings.
    title, source : str
        Of the candidate.
    collars : mapping
        Data of its thrust collars by place, which stand beside its bearings and do not vary.
    """

    axes: tuple[Axis, ...]
    places: Mapping[str, Any]
    friction: Mapping[str, Any]
    title: str = ""
    source: str = ""
    collars: Mapping[str, Any] = field(default_factory=dict)

    @property
    def bounds(self) -> list[tuple[float, float]]:
        """Ends of each coordinate."""
        return [(axis.low, axis.high) for axis in self.axes]

    def settings(self, point: Sequence[float]) -> dict[str, Any]:
        """Values by key."""
        return {axis.key: axis.value(float(x)) for axis, x in zip(self.axes, point)}

    def data(self, point: Sequence[float]) -> tuple[dict[str, Any], dict[str, Any]]:
        """Places and friction at a point, as a scene writes them.

        A dynamic capacity that a bearing states follows its geometry as that of ISO 281 does.
        """
        places, friction = copy.deepcopy((dict(self.places), dict(self.friction)))
        for key, value in self.settings(point).items():
            for table, path in _targets(key, places, friction):
                _set(table, path, value)
        _with_capacity(places, self.places)
        return with_collars(places, self.collars), friction

    def at(self, point: Sequence[float]) -> tuple[Candidate, Friction]:
        """The candidate, and the friction section, at a point.

        Raises
        ------
        loadflow.errors.InputError
            The values do not fit together, such as rollers that overlap.
        """
        about, origins = {"title": self.title, "source": self.source}, {}
        try:
            places, friction = self.data(point)
            sections = sections_of(places, ())
            origins = sections.origins
            return (
                Candidate.model_validate(about | sections.data),
                Friction.model_validate(friction),
            )
        except ValidationError as error:
            model = Friction if error.title == Friction.__name__ else Candidate
            said = message(error, "design", origins if model is Candidate else {}, model)
            raise InputError(said.splitlines()[0]) from error
        except ValueError as error:
            raise InputError(f"design: {error}") from error


def space_of(scene: Scene, candidate: Candidate, design: Design) -> Space:
    """Space of the designs of a candidate.

    Parameters
    ----------
    scene : Scene
        For its section on friction.
    candidate : Candidate
        What is varied.
    design : Design
        The keys and their values.

    Raises
    ------
    loadflow.errors.InputError
        A key that no bearing of it has, or a value that it cannot take.
    """
    places = written_places(candidate)
    friction = scene.friction.model_dump(mode="json", exclude_unset=True, exclude_none=True)
    keys = design.keys or default_keys(places)
    axes = tuple(_axis(key, variation, places, friction) for key, variation in keys.items())
    collars = written_collars(candidate)
    space = Space(axes, places, friction, candidate.title, candidate.source, collars)
    for axis in axes:
        _check_key(space, axis)
    return space


def written_places(candidate: Candidate) -> dict[str, Any]:
    """Data of the bearings of a candidate by place, each in full."""
    dumped = [
        part.model_dump(mode="json", exclude_unset=True, exclude_none=True) if part else None
        for part in (candidate.journal, candidate.rolling)
    ]
    journal, rolling = dumped
    if candidate.journal is not None:
        assert journal is not None
        journal["bearings"] = candidate.journal.bearings
    if candidate.rolling is not None:
        assert rolling is not None
        rolling |= {
            "bearing": candidate.rolling.bearing,
            "geometry": candidate.rolling.model_dump(mode="json", exclude_none=True)["geometry"],
            "further": rolling.get("further", []),
        }
    found = places_of(journal, rolling)
    for place, data in found.items():
        if "like" in data:
            found[place] = copy.deepcopy(found[data["like"]])
    return found


def written_collars(candidate: Candidate) -> dict[str, Any]:
    """Data of the thrust collars of a candidate by place, each in full, as a scene writes it."""
    if candidate.thrust is None:
        return {}
    data = candidate.thrust.model_dump(mode="json", exclude_unset=True, exclude_none=True)
    data["bearings"] = {
        place: {"kind": one.kind}
        | one.model_dump(mode="json", exclude_unset=True, exclude_none=True)
        for place, one in candidate.thrust.collars.items()
    }
    return places_of(None, None, data)


def with_collars(places: Mapping[str, Any], collars: Mapping[str, Any]) -> dict[str, Any]:
    """Bearings by place, with the collars that stand beside some of them, or alone."""
    found = dict(places)
    for place, data in copy.deepcopy(dict(collars)).items():
        found[place] = [places[place], data] if place in places else data
    return found


def default_keys(places: Mapping[str, Any]) -> dict[str, Variation]:
    """Main measures of a candidate about those that it has.

    Raises
    ------
    loadflow.errors.InputError
        There are none.
    """
    found: dict[str, Variation] = {}
    first = next(iter(places.values()))
    family = JOURNAL if first["kind"] == JOURNAL else _element(first["geometry"])
    for key, (low, high) in DEFAULTS[family].items():
        values = {place: _get(data, key.split(".")) for place, data in places.items()}
        known = {place: v for place, v in values.items() if isinstance(v, float | int)}
        if len(known) == len(places) and len(set(known.values())) == 1:
            known = {"": next(iter(known.values()))}
        for place, value in known.items():
            found[f"{place}.{key}".lstrip(".")] = Variation(
                low=_rounded(low * value), high=_rounded(high * value)
            )
    if not found:
        raise InputError("design: no keys to vary; write [design.keys]")
    return found


def _element(geometry: Mapping[str, Any]) -> str:
    return "roller" if "roller_diameter" in geometry else "ball"


def _rounded(value: float) -> float:
    return float(f"{value:.3g}")


def _axis(key: str, variation: Variation, places: Any, friction: Any) -> Axis:
    unit = UNITS.get(key.rsplit(".", 1)[-1], "")
    if variation.values is not None:
        values = tuple(variation.values)
        return Axis(key, 0.0, len(values) - 1.0, values, whole=True, unit=unit)
    targets = [*_targets(key, places, friction)]
    if not targets:
        raise InputError(f"design.keys.{key}: no bearing of the candidate is at that place")
    now = _get(*targets[0])
    whole = isinstance(now, int) and not isinstance(now, bool)
    assert variation.low is not None
    assert variation.high is not None
    return Axis(key, variation.low, variation.high, whole=whole, unit=unit)


def _targets(key: str, places: Any, friction: Any) -> Iterator[tuple[Any, list[str]]]:
    """Yield the tables that a key is of, and the rest of the key within each."""
    first, *rest = key.split(".")
    if first == "friction":
        yield friction, rest
    elif first in places:
        yield places[first], rest
    else:
        for data in places.values():
            yield data, [first, *rest]


def _get(table: Any, path: Sequence[str]) -> Any:
    for name in path:
        if isinstance(table, list):
            table = table[int(name)] if name.isdigit() and int(name) < len(table) else None
        else:
            table = table.get(name) if isinstance(table, Mapping) else None
    return table


def _set(table: Any, path: Sequence[str], value: Any) -> None:
    *tables, last = path
    for name in tables:
        table = table[int(name)] if isinstance(table, list) else table.setdefault(name, {})
    if isinstance(table, list):
        table[int(last)] = copy.deepcopy(value)
    else:
        table[last] = copy.deepcopy(value)


def _check_key(space: Space, axis: Axis) -> None:
    """Refuse a key that no value of makes a bearing; of several values each must."""
    alone, said = Space((axis,), space.places, space.friction), []
    tried = range(len(axis.values)) or np.linspace(axis.low, axis.high, 5)
    for coordinate in tried:
        try:
            alone.at([float(coordinate)])
        except InputError as error:
            said.append(str(error).removeprefix("design: "))
        except (LookupError, ValueError, TypeError, AttributeError) as error:
            raise InputError(f"design.keys.{axis.key}: no such key of the bearing") from error
    if said and (axis.values or len(said) == len(tried)):
        raise InputError(f"design.keys.{axis.key}: {said[0]}")


def _with_capacity(places: dict[str, Any], before: Mapping[str, Any]) -> None:
    """Let stated capacities follow the geometry as those of ISO 281 would."""
    for place, data in places.items():
        geometry = data.get("geometry", {})
        stated = geometry.get("dynamic_capacity")
        if stated is None or stated != before[place]["geometry"].get("dynamic_capacity"):
            continue
        if geometry != before[place]["geometry"]:
            ratio = _by_standard(place, data) / _by_standard(place, before[place])
            geometry["dynamic_capacity"] = float(f"{stated * ratio:.{DIGITS}g}")


def _by_standard(place: str, data: Mapping[str, Any]) -> float:
    """Capacity of a rolling bearing by ISO 281, N, whatever it states."""
    plain = {key: v for key, v in data["geometry"].items() if key != "dynamic_capacity"}
    parts = sections_of({place: {**data, "geometry": plain}}, ("design",)).data
    return float(Candidate.model_validate(parts).rolling.geometries[place].rated_capacity)  # type: ignore[union-attr]


def start_of(space: Space) -> list[float]:
    """Coordinates of the candidate as it is; the middle of a range where it has no value."""
    found = []
    for axis in space.axes:
        now = _get(*next(_targets(axis.key, space.places, space.friction)))
        if axis.values:
            found.append(float(axis.values.index(now)) if now in axis.values else 0.0)
        elif isinstance(now, int | float):
            found.append(float(np.clip(now, axis.low, axis.high)))
        else:
            found.append(0.5 * (axis.low + axis.high))
    return found
