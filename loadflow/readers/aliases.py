"""Which channel of a program is which component of the cube: the table shipped, and one's own."""

from __future__ import annotations

import os
import re
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib.resources import files
from pathlib import Path
from typing import Any, Literal

from loadflow.cube import VARIABLES
from loadflow.errors import InputError

COMPONENTS = tuple(
    f"{name}_{axis}" if "axis" in variable.dims else name
    for name, variable in VARIABLES.items()
    if "bearing" not in variable.dims
    for axis in ("xyz" if "axis" in variable.dims else "x")
)
"""What a reader delivers: ``speed``, …, ``hub_force_x``, …, ``hub_moment_z``."""

GAUGE = {"hub_moment_y": "gauge_moment_y", "hub_moment_z": "gauge_moment_z"}
"""Bending moments at the strain gauge, from which those at the rotor apex follow."""

TIME = "time"
"""Time stamps of a format that does not say itself which column they are."""

POWER = "rotor_power"
"""Power on the shaft: never in the cube, but torque and speed are checked against it."""

ROOT = tuple(f"root_{what}_{axis}" for what in ("force", "moment") for axis in "xyz")
"""Loads of blade 1 at its root: all of them or none."""

OPTIONAL = ("pitch", "azimuth", "wind", POWER, *ROOT)
LATERAL = ("hub_force_y", "hub_force_z", "hub_moment_y", "hub_moment_z")
"""Components that differ between the fixed and the rotating frame."""

Channels = Mapping[str, str | Sequence[str]]
"""Component of the cube → channel of the file, or several of which the first one found is used;
a leading minus turns the sign."""

Frame = Literal["auto", "fixed", "rotating"]
"""Frame of the y and z channels: "rotating" ones are turned back with the azimuth; "auto" takes the
fixed ones, and rotating ones where only these are known by their names."""


@dataclass(frozen=True)
class Aliases:
    """Names of the channels of a program.

    Attributes
    ----------
    fixed, rotating : mapping of str to tuple of str
        By component: those of the frame that stands still, and of the one that turns with blade 1.
    advice : str
        How missing channels come into the output; ``{lines}`` stands for one line for each.
    """

    fixed: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    rotating: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    advice: str = ""


ADVICE = {
    "openfast": "Lines for the OutList of ElastoDyn:\n{lines}",
    "bladed": "Channels to write: {lines}",
    "hawc2": "Name the loads with channels, as the files do not say how the axes of a body lie",
}


@cache
def aliases(program: str) -> Aliases:
    """Return the channels of a program in the table that is shipped.

    Parameters
    ----------
    program : {"openfast", "bladed", "hawc2", "csv"}
        Key of ``channels.toml``.
    """
    table = tomllib.loads(files("loadflow.data").joinpath("channels.toml").read_text("utf-8"))[
        program
    ]
    frames = {
        frame: {key: tuple(names) for key, names in table.get(frame, {}).items()}
        for frame in ("fixed", "rotating")
    }
    return Aliases(**frames, advice=ADVICE.get(program, ""))


def read_channels(source: str | os.PathLike[str] | Channels) -> dict[str, tuple[str, ...]]:
    """Return channels of one's own, from a file, a text or a mapping.

    Parameters
    ----------
    source : path, str or mapping
        TOML file with keys such as ``hub_force_x = "-Fz coo: shaft"`` (a name or a list of
        names); the same as text, ``"speed=Omega, hub_force_x=-#23"``; or a mapping.

    Returns
    -------
    dict of str to tuple of str
        Names by component.

    Raises
    ------
    loadflow.errors.InputError
        No such file, not TOML, an unknown component, or a name that is no text.

    Examples
    --------
    >>> read_channels("speed=Omega, hub_force_x=-Fz coo: shaft")
    {'speed': ('Omega',), 'hub_force_x': ('-Fz coo: shaft',)}
    """
    where = "channels"
    if isinstance(source, Mapping):
        data: dict[str, Any] = dict(source)
    elif not isinstance(source, str | os.PathLike):
        raise InputError(f"channels = {source!r}: must be a table of names, a file or a text")
    elif "=" in str(source) and not Path(source).is_file():
        data = _parse(str(source))
    else:
        data, where = _load(Path(source)), str(source)
    known = (*COMPONENTS, *GAUGE.values(), POWER, TIME)
    found = {}
    for key, names in data.items():
        if key not in known:
            raise InputError(
                f"{where}: {key!r} is nothing the cube holds; it takes {', '.join(known)}"
            )
        listed = [names] if isinstance(names, str) else names
        if not isinstance(listed, Sequence) or not all(isinstance(n, str) and n for n in listed):
            raise InputError(f"{where}: {key} = {names!r} must be a name, or a list of names")
        found[key] = tuple(listed)
    return found


def _parse(pairs: str) -> dict[str, str]:
    """Split ``key=name, key=name``; names of channels may hold commas."""
    parts = re.split(r"(?:^|[,;\n])\s*(\w+)\s*=\s*", pairs.strip().strip("{}"))
    if parts[0].strip() or len(parts) < 3:
        raise InputError(f"channels: {pairs!r} must be a file, or like 'speed=Omega, pitch=Pi1'")
    return {key: name.strip().strip("'\"") for key, name in zip(parts[1::2], parts[2::2])}


def _load(path: Path) -> dict[str, Any]:
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise InputError(f"{path}: cannot read the channels: {error.strerror}") from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: not a TOML file: {error}") from None
    inner = data.get("channels")
    return inner if set(data) == {"channels"} and isinstance(inner, dict) else data
