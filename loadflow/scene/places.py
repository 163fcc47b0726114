"""Which bearings stand at which places of the shaft, as scenes write it.

A scene says ``[bearings.PLACE]`` with a ``kind``; several bearings that are considered for one
place are a list ``[[bearings.PLACE]]``. The rooms read the sections ``journal`` and ``rolling``;
here one form becomes the other.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from typing import Any

from loadflow.numerics.fields import not_one_of
from loadflow.rolling import KINDS

JOURNAL = "journal"
"""The kind of all journal bearings; the others are kinds of rolling bearings."""

COLLAR = "thrust"
AXIAL = (COLLAR, "conical-pair")
"""Kinds of film bearings that carry the force along the shaft."""

FOUR_POINT = "four-point"
_REGISTERED = {FOUR_POINT: "slewing"}
WRITTEN = {registered: written for written, registered in _REGISTERED.items()}
"""Kinds of rolling bearings that scenes write in another word than the package has."""


GEOMETRIES = {FOUR_POINT: KINDS[_REGISTERED[FOUR_POINT]]} | KINDS
"""Kinds of rolling bearings by every word that a scene may have for them."""

PLACE_KINDS = (JOURNAL, *AXIAL, *(WRITTEN.get(kind, kind) for kind in KINDS))
"""What `kind` a bearing of a scene may have."""

OF_COLLARS = ("rung", "grid", "motion", "tilt")
"""Keys that all thrust collars of a scene share."""

SHARED = ("motion", "step", "tilt", "rung", "grid", "grading")
"""Keys that all journal bearings of a scene share: how the film is modelled."""

Location = tuple[int | str, ...]


@dataclass
class Sections:
    """What the rooms read of the places of a shaft.

    Attributes
    ----------
    journal : dict or None
        Data of the section of journal bearings.
    rolling : list of dict or None
        Data of the section of rolling bearings.
    thrust : dict or None
        Data of the section of film bearings that carry the force along the shaft.
    origins : dict
        Where the data of a section was written, to name it in messages.
    """

    journal: dict[str, Any] | None = None
    rolling: list[dict[str, Any]] | None = None
    thrust: dict[str, Any] | None = None
    origins: dict[Location, Location] = field(default_factory=dict)

    @property
    def data(self) -> dict[str, Any]:
        """The sections that there are."""
        rooms = {"journal": self.journal, "rolling": self.rolling, "thrust": self.thrust}
        return {name: data for name, data in rooms.items() if data is not None}


def sections_of(places: Any, where: Location = ("bearings",)) -> Sections:
    """Sections that say what stands at the places of a shaft.

    Parameters
    ----------
    places : mapping
        By place, a bearing (a mapping with ``kind``, or with ``like``, another place) or a list.
    where : tuple
        Keys down to the places, for messages.

    Raises
    ------
    ValueError
        No mapping, no or an unknown kind, two bearings of one room at a place, or `like` a place
        that is not there; all that is wrong, one bearing a line.
    """
    name = ".".join(map(str, where))
    if not isinstance(places, Mapping) or not places:
        raise ValueError(f"{name}: needs a table for each place, such as [{name}.N]")
    found = Sections()
    wrong: list[str] = []
    for place, stated in places.items():
        several = isinstance(stated, list)
        for number, data in enumerate(stated if several else [stated]):
            location = (*where, place, number) if several else (*where, place)
            with told_later(wrong):
                _add(found, place, location, _stated(places, place, location, data))
    if wrong:
        raise ValueError("\n".join(wrong))
    return found


@contextmanager
def told_later(wrong: list[str]) -> Iterator[None]:
    """Add what is wrong with some bearings to the rest of it, to tell all of it at once."""
    try:
        yield
    except ValueError as error:
        wrong.append(str(error))


def _add(found: Sections, place: str, location: Location, data: dict[str, Any]) -> None:
    kind = data.pop("kind", None)
    if kind not in (*PLACE_KINDS, *KINDS):
        told = ".".join(map(str, location))
        raise ValueError(f"{told}.kind: {not_one_of(kind, PLACE_KINDS)}")
    if kind == JOURNAL:
        _add_journal(found, place, location, data)
    elif kind in AXIAL:
        _add_axial(found, place, location, data | {"kind": kind})
    else:
        _add_rolling(found, place, location, data, _REGISTERED.get(kind, kind))


def places_of(
    journal: Mapping[str, Any] | None,
    rolling: Mapping[str, Any] | None,
    thrust: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """The same as a scene writes it, of the plain data of its sections."""
    found: dict[str, list[dict[str, Any]]] = {}
    if journal is not None:
        common = {name: value for name, value in journal.items() if name not in ("bearings", "own")}
        own = journal.get("own", {})
        first = next((place for place in journal["bearings"] if place not in own), None)
        for place in journal["bearings"]:
            alike = place not in own and place != first
            stated: Mapping[str, Any] = {"like": first} if alike else own.get(place, common)
            unwritten = ("bearings", "own", *(SHARED if place in own else ()))
            data = {name: value for name, value in stated.items() if name not in unwritten}
            found.setdefault(place, []).append(data if alike else {"kind": JOURNAL} | data)
    if rolling is not None:
        for part in ({k: v for k, v in rolling.items() if k != "further"}, *rolling["further"]):
            data = {k: v for k, v in part.items() if k != "bearing"}
            geometry = {**data.pop("geometry")}
            kind = geometry.pop("kind")
            told = {"kind": WRITTEN.get(kind, kind), "geometry": geometry} | data
            found.setdefault(part["bearing"], []).append(told)
    axial = thrust or {"bearings": {}}
    of_collars = {name: axial[name] for name in OF_COLLARS if name in axial}
    for place, part in axial["bearings"].items():
        more = of_collars if part["kind"] == COLLAR else {}
        found.setdefault(place, []).append({**part, **more})
    several = {place for place, parts in found.items() if len(parts) > 1}
    if several:  # "like" means a place with one bearing
        for parts in found.values():
            parts[:] = [{"kind": JOURNAL} | common if "like" in part else part for part in parts]
    return {place: parts if place in several else parts[0] for place, parts in found.items()}


def _stated(places: Mapping[str, Any], place: str, location: Location, data: Any) -> dict[str, Any]:
    """Data of a bearing; `like` replaced by what it means."""
    told = ".".join(map(str, location))
    if not isinstance(data, Mapping):
        raise ValueError(f"{told} = {data!r}: must be a table with the key kind")
    data = dict(data)
    other = data.pop("like", None)
    if other is None:
        return data
    model = places.get(other) if isinstance(other, str) else None
    if other == place or not isinstance(model, Mapping) or "like" in model:
        raise ValueError(
            f"{told}.like = {other!r}: must be another place with one bearing of its "
            f"own, of {', '.join(p for p in places if p != place) or 'none'}"
        )
    return {**model, **data}


def _add_journal(found: Sections, place: str, location: Location, data: dict[str, Any]) -> None:
    if found.journal is None:
        found.journal = data | {"bearings": [place]}
        found.origins["journal",] = location
        return
    told = ".".join(map(str, location))
    if place in found.journal["bearings"]:
        raise ValueError(f"{told}: a second journal bearing; write it under [candidates.NAME]")
    common = {name: part for name, part in found.journal.items() if name not in ("bearings", "own")}
    found.journal["bearings"].append(place)
    if data != common:
        found.journal.setdefault("own", {})[place] = data
        found.origins["journal", "own", place] = location


def _add_axial(found: Sections, place: str, location: Location, data: dict[str, Any]) -> None:
    found.thrust = found.thrust or {"bearings": {}}
    told = ".".join(map(str, location))
    if place in found.thrust["bearings"]:
        raise ValueError(f"{told}: a second bearing of its kind; write it under [candidates.NAME]")
    for name in OF_COLLARS if data["kind"] == COLLAR else ():
        if name in data:
            value = data.pop(name)
            if found.thrust.setdefault(name, value) != value:
                raise ValueError(f"{told}.{name} = {value!r}: collars share one {name}; keep one")
            found.origins["thrust", name] = (*location, name)
    found.thrust["bearings"][place] = data
    found.origins["thrust", "bearings", place] = location


def _add_rolling(
    found: Sections, place: str, location: Location, data: dict[str, Any], kind: str
) -> None:
    if found.rolling is None:
        found.rolling = []
    told = ".".join(map(str, location))
    if any(part["bearing"] == place for part in found.rolling):
        raise ValueError(f"{told}: a second rolling bearing; write it under [candidates.NAME]")
    geometry = data.get("geometry")
    if not isinstance(geometry, Mapping):
        raise ValueError(f"{told}.geometry: must be a table of the bearing's measures")
    number = len(found.rolling)
    found.rolling.append(data | {"bearing": place, "geometry": {"kind": kind, **geometry}})
    prefix = ("rolling", "further", number - 1) if number else ("rolling",)
    found.origins[prefix] = location
