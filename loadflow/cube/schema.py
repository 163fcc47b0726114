"""What a load cube holds: names, units, meaning and dimensions, in one table."""

from __future__ import annotations

from collections.abc import Mapping, MutableMapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from loadflow.schemas import Schema

if TYPE_CHECKING:
    import xarray as xr

AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Variable:
    """Name-independent part of a variable of the cube.

    Attributes
    ----------
    units : str
        SI unit, as in the attribute ``units``.
    long_name : str
        Meaning, as in the attribute ``long_name``.
    dims : tuple of str
        Dimensions in the order of storage.

    Examples
    --------
    >>> from loadflow.cube import VARIABLES
    >>> VARIABLES["hub_force"].units, VARIABLES["hub_force"].dims
    ('N', ('axis', 'case', 'time'))
    """

    units: str
    long_name: str
    dims: tuple[str, ...]

    @property
    def attrs(self) -> dict[str, str]:
        """Attributes of the xarray variable; text has no units."""
        units = {"units": self.units} if self.units else {}
        return units | {"long_name": self.long_name}


_SCALAR = ("case", "time")
_HUB = ("axis", "case", "time")
_BEARING = ("bearing", "axis", "case", "time")

VARIABLES: Mapping[str, Variable] = MappingProxyType(
    {
        "speed": Variable("rad/s", "rotor speed", _SCALAR),
        "pitch": Variable("rad", "pitch angle of blade 1", _SCALAR),
        "azimuth": Variable("rad", "azimuth of blade 1, 0 = up, about +x", _SCALAR),
        "wind": Variable("m/s", "wind speed along the mean wind at the hub", _SCALAR),
        "hub_force": Variable("N", "force of the rotor on the shaft", _HUB),
        "hub_moment": Variable("N m", "moment of the rotor on the shaft at the rotor apex", _HUB),
        "root_force": Variable("N", "force of blade 1 on the hub at its root", _HUB),
        "root_moment": Variable("N m", "moment of blade 1 on the hub at its root", _HUB),
        "force": Variable("N", "force of the shaft on the bearing", _BEARING),
        "moment": Variable("N m", "moment of the shaft on the bearing", _BEARING),
        "tilt": Variable("rad", "rotation of the shaft at the bearing", _BEARING),
    }
)
"""Known variables of a cube; others are allowed if they state their units."""

CASE_COORDS: Mapping[str, Variable] = MappingProxyType(
    {
        "dlc": Variable("", "design load case", ("case",)),
        "wind_speed": Variable("m/s", "mean wind speed at hub height", ("case",)),
        "seed": Variable("1", "seed of the turbulence", ("case",)),
        "weight": Variable("1", "share of the lifetime", ("case",)),
        "tripped": Variable("s", "overspeed trip: 0 in the run-in, NaN if none", ("case",)),
        "file": Variable("", "file the case was read from", ("case",)),
        "doubts": Variable("", "what is doubtful about the series, a line each", ("case",)),
        "standing_share": Variable("1", "share of the time standing or idling", ("case",)),
        "file_start": Variable("s", "first time stamp in the file", ("case",)),
    }
)
"""Coordinates on ``case``; what else varied may be added under a name of its own."""

TIME = Variable("s", "time from the start of the series", ("time",))


def _labelled(data: xr.Dataset) -> tuple[xr.Dataset, list[str]]:
    """Version 1 could leave out what a variable means; the table knows it."""
    told = []
    for name, known in {**VARIABLES, **CASE_COORDS, "time": TIME}.items():
        if name not in data.variables or not {*data[name].dims} <= {*known.dims}:
            continue
        attributes = data[name].attrs
        if attributes.get("units", "") == known.units and "long_name" not in attributes:
            attributes["long_name"] = known.long_name
            told.append(f"{name} is labelled {known.long_name!r}")
    return data, told


CUBE = Schema("load cube", "loadflow_schema", (_labelled,))
"""Form of cubes on disk, said by an attribute of the file. 2: every variable has ``long_name``;
1, or no such attribute: it may be missing."""

FILE_ATTRIBUTES: Mapping[str, str | int] = MappingProxyType(
    {"Conventions": "CF-1.11", CUBE.key: CUBE.version}
)
"""What a file of a cube says of itself, beside the attributes of the cube."""


def version_taken(attributes: MutableMapping[Any, Any]) -> Any:
    """Take what a file says of itself off its attributes; return the version of its form."""
    version = attributes.get(CUBE.key, 1)
    for name in FILE_ATTRIBUTES:
        attributes.pop(name, None)
    return version


def case_name(dlc: str, wind_speed: float, seed: int) -> str:
    """Return the name of a case.

    Parameters
    ----------
    dlc : str
        Design load case, ``"1.1"``, or a word such as ``"steady"``.
    wind_speed : float
        Mean wind speed, m/s.
    seed : int
        Seed of the turbulence.

    Returns
    -------
    str

    Examples
    --------
    >>> case_name("1.1", 12.0, 1)
    'dlc1.1_v12_s1'
    >>> case_name("steady", 11.4, 1)
    'steady_v11.4_s1'
    """
    prefix = "dlc" if str(dlc)[:1].isdigit() else ""
    return f"{prefix}{dlc}_v{float(wind_speed):g}_s{int(seed)}"
