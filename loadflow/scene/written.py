"""From a scene as it is written to the sections that the rooms read."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from loadflow.errors import InputError
from loadflow.numerics.fields import meant
from loadflow.scene.candidates import ABOUT, TOLERANCES, candidates_of, machine_names
from loadflow.scene.own_shaft import own_shaft
from loadflow.scene.places import Location, sections_of, told_later
from loadflow.scene.tolerances import taken_out
from loadflow.schemas import Schema
from loadflow.turbines import load_turbine, turbine_names


def _with_places(data: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Version 1 has sections, which are what the rooms read today: nothing but words changes."""
    stated = [name for name in ("journal", "rolling") if name in data]
    return data, [
        f"[{name}] is [bearings.PLACE] today, as `loadflow scene --show` prints it"
        for name in stated
    ]


def _with_supports(data: dict[str, Any]) -> tuple[dict[str, Any], list[str]]:
    """Version 2 calls the supports of a beam its seats."""
    shaft = data.get("shaft")
    if not isinstance(shaft, dict):
        return data, []
    renamed, told = dict(shaft), []
    for concept, suspension in shaft.items():
        beam = suspension.get("beam") if isinstance(suspension, dict) else None
        if isinstance(beam, dict) and "seats" in beam and "supports" not in beam:
            new = {"supports" if key == "seats" else key: value for key, value in beam.items()}
            renamed[concept] = suspension | {"beam": new}
            told.append(f"shaft.{concept}.beam.seats is supports today")
    return data | {"shaft": renamed}, told


SCENE = Schema("scene", "schema", (_with_places, _with_supports))
"""Form of scenes. 3: a beam has ``supports``; 2: it has ``seats``; 1: ``[journal]`` and
``[rolling]`` in place of ``[bearings.PLACE]`` and ``[candidates.NAME]``."""

UNSTATED = 2
"""Version that a scene without one is read as: both ways to write bearings are valid there."""


def in_sections(data: dict[str, Any], results: Sequence[str]) -> dict[str, Any]:
    """Data of a scene with its places as the sections that the rooms read.

    A shaft that it does not state is that of its turbine (`loadflow.scene.own_shaft.own_shaft`).

    Parameters
    ----------
    data : dict
        As a scene is written.
    results : sequence of str
        All results that there are.

    Raises
    ------
    loadflow.errors.InputError
        A version of the form that is not known.
    ValueError
        Places that are no bearings, of the scene or of any candidate; one bearing a line.
    """
    read = dict(data)
    read = SCENE.upgrade(read, read.pop(SCENE.key, UNSTATED))
    read = taken_out(read)
    turbine = _turbine_of(read)
    if (shaft := own_shaft(turbine, read.get("shaft"))) is not None:
        read["shaft"] = shaft
    wrong: list[str] = []
    if isinstance(read.get("bearings"), str | list) and _unread(turbine):
        del read["bearings"]
    if "bearings" in read:
        with told_later(wrong):
            sections = sections_of(_placed(read.pop("bearings"), turbine)).data
            if twice := sorted(set(sections) & set(read)):
                raise ValueError(f"bearings: beside [{twice[0]}]; write all as [bearings.PLACE]")
            if "results" not in read:
                rooms = {"journal", "rolling", "thrust"} - set(sections)
                read["results"] = [name for name in results if name.split(".")[0] not in rooms]
            read |= sections
    if isinstance(candidates := read.get("candidates"), dict):
        read["candidates"] = dict(candidates)
        for name, stated in candidates.items():
            with told_later(wrong):
                read["candidates"][name] = _candidate(name, stated, turbine)
    if wrong:
        raise ValueError("\n".join(wrong))
    return read


def _candidate(name: str, stated: Any, turbine: str) -> Any:
    """Data of a candidate in sections; one without places is that of the package."""
    if not isinstance(stated, dict):
        return stated
    if {"journal", "rolling", "thrust"} & {k for k, v in stated.items() if not _is_place(v)}:
        return stated  # in sections already
    places, about = _bare(stated), {key: stated[key] for key in _NO_PLACES if key in stated}
    if not places and not _unread(turbine):
        sized = _sized(name, turbine, f"candidates.{name}: says nothing, and")
        places, about = _bare(sized), {k: sized[k] for k in ABOUT} | about
    return about | (sections_of(places, ("candidates", name)).data if places else {})


def _placed(stated: Any, turbine: str) -> Any:
    """What stands at the places of a scene; by name it is what is sized for its turbine."""
    names = [stated] if isinstance(stated, str) else stated
    if not (isinstance(names, list) and all(isinstance(name, str) for name in names)):
        return stated
    found: dict[str, list[Any]] = {}
    for name in names:
        for place, parts in _bare(_sized(name, turbine, f"bearings = {name!r}:")).items():
            found.setdefault(place, []).extend(parts if isinstance(parts, list) else [parts])
    return {place: parts if len(parts) > 1 else parts[0] for place, parts in found.items()}


def _sized(name: str, turbine: str, told: str) -> dict[str, Any]:
    """A candidate of the package; `told` begins the message where there is none of that name."""
    known = candidates_of(turbine)
    if not known:
        raise ValueError(
            f"{told} bearings are sized for {', '.join(machine_names())}, not for {turbine}; state "
            "its own as [bearings.PLACE]: `loadflow scene --show` of a scene with one of these "
            "turbines prints the sized ones to begin with"
        )
    if name not in known:
        raise ValueError(
            f"{told} is none of those sized for {turbine}: {', '.join(known)}{meant(name, known)}"
        )
    found: dict[str, Any] = known[name]
    return found


def _unread(turbine: str) -> bool:
    """Whether a turbine cannot be read, which its own check tells, with its key."""
    try:
        load_turbine(turbine)
    except InputError:
        return True
    return False


def _is_place(value: Any) -> bool:
    return isinstance(value, dict) and bool({"kind", "like"} & set(value))


def _bare(candidate: dict[str, Any]) -> dict[str, Any]:
    """The places of a candidate."""
    return {key: value for key, value in candidate.items() if key not in _NO_PLACES}


_NO_PLACES = (*ABOUT, TOLERANCES)


def named_by_file(turbine: Any) -> Any:
    """The table of a turbine with its `file` as its name.

    Raises
    ------
    ValueError
        A name beside the file, or a file that is no path.
    """
    if not isinstance(turbine, dict) or "file" not in turbine:
        return turbine
    if "name" in turbine:
        raise ValueError("name and file: give one of both")
    if not isinstance(turbine["file"], str):
        raise ValueError(f"file = {turbine['file']!r:.200}: must be a path")
    return {key: value for key, value in turbine.items() if key != "file"} | {
        "name": turbine["file"]
    }


def _turbine_of(data: dict[str, Any]) -> str:
    turbine = named_by_file(data.get("turbine", {}))
    name = turbine.get("name") if isinstance(turbine, dict) else getattr(turbine, "name", None)
    return "nrel-5mw" if name is None else str(name)  # what is no table is told by the section


def origins(data: dict[str, Any]) -> dict[Location, Location]:
    """Where the data of sections was written, of a scene that has its places."""
    found: dict[Location, Location] = {}
    if isinstance(turbine := data.get("turbine"), dict) and "file" in turbine:
        found[("turbine", "name")] = ("turbine", "file")
    try:
        if "bearings" in data:
            found |= sections_of(_placed(data["bearings"], _turbine_of(data))).origins
        for name, stated in data.get("candidates", {}).items():
            where = ("candidates", name)
            own = sections_of(_bare(stated), where).origins if _bare(stated) else {}
            found |= {(*where, *section): location for section, location in own.items()}
    except (ValueError, AttributeError):  # told already
        pass
    return found


def anchored(data: dict[str, Any], folder: Path) -> dict[str, Any]:
    """Make the paths of a scene relative to its file, not to where the user stands."""

    def path(value: Any) -> Any:
        return str(folder / value) if isinstance(value, str) else value

    found = dict(data)
    if isinstance(loads := data.get("loads"), dict):
        several = {
            key: [path(file) for file in loads[key]]
            for key in ("files", "winds")
            if isinstance(loads.get(key), list)
        }
        keys = [key for key in ("cases", "case_list", "channels") if key in loads]
        found["loads"] = loads | several | {key: path(loads[key]) for key in keys}
    for room in {"journal", "rolling"} & {*data}:
        found[room] = _each(data[room], path)
    if isinstance(places := data.get("bearings"), dict):
        found["bearings"] = {name: _each(part, path) for name, part in places.items()}
    if isinstance(candidates := data.get("candidates"), dict):
        found["candidates"] = {
            name: {place: _each(part, path) for place, part in one.items()}
            if isinstance(one, dict)
            else one
            for name, one in candidates.items()
        }
    if isinstance(shaft := data.get("shaft"), dict):
        found["shaft"] = {name: _on_frames(part, path) for name, part in shaft.items()}
    turbine = data.get("turbine")
    if isinstance(turbine, dict) and isinstance(name := turbine.get("name"), str):
        base = name.rpartition("@")[0] or name  # a power may have a point: nrel-5mw@5.5e6
        file = name if base in turbine_names() or not Path(name).suffix else path(name)
        found["turbine"] = turbine | {"name": file}
    elif isinstance(turbine, dict) and "file" in turbine:
        found["turbine"] = turbine | {"file": path(turbine["file"])}
    return found


def _each(bearings: Any, path: Callable[[Any], Any]) -> Any:
    """A bearing, or each of a list of them, with its paths."""
    if isinstance(bearings, list):
        return [_with_files(one, path) for one in bearings]
    return _with_files(bearings, path)


_FILES = (("shell", "matrix"), ("shell", "file"), ("inner_ring", "file"), ("outer_ring", "file"))
"""Tables of a bearing, and their keys that name files."""


def _with_files(bearing: Any, path: Callable[[Any], Any]) -> Any:
    """A bearing with the paths to the matrices of its shell and rings, if it has some."""
    if not isinstance(bearing, dict):
        return bearing
    found = dict(bearing)
    for part, key in _FILES:
        table = found.get(part)
        if table is not None:
            found[part] = _with_path(table, path, key)
    return found


def _on_frames(suspension: Any, path: Callable[[Any], Any]) -> Any:
    """A suspension with the paths to the matrices under its bearings, if it has some."""
    beam = suspension.get("beam") if isinstance(suspension, dict) else None
    if not isinstance(beam, dict):
        return suspension
    found = beam | {"frame": _with_path(beam["frame"], path)} if "frame" in beam else dict(beam)
    if isinstance(supports := beam.get("supports"), list):
        found["supports"] = [
            one | {"housing": _with_path(one["housing"], path)}
            if isinstance(one, dict) and "housing" in one
            else one
            for one in supports
        ]
    return suspension | {"beam": found}


def _with_path(table: Any, path: Callable[[Any], Any], key: str = "file") -> Any:
    if not isinstance(table, dict) or key not in table:
        return table
    return table | {key: path(table[key])}
