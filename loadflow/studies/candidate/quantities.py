"""What a comparison compares: the table of its quantities."""

from __future__ import annotations

import math
from typing import Any, Literal, NamedTuple

from loadflow.quantities import HOURS_PER_YEAR


class Compared(NamedTuple):
    """A quantity of a comparison.

    Attributes
    ----------
    name : str
        In words.
    unit : str
        Of its numbers.
    group : str
        Of rows of the page that it stands in.
    of : {"all", "film", "journal", "collar", "rolling", "rows", "catalogues"}
        Bearings that have it: journal bearings or pads in their place, journal bearings alone, a
        thrust collar beside them, rolling bearings, several rows of which one takes the thrust,
        rolling bearings of which catalogues know enough.
    at_most : bool
        Its limit must not be exceeded; that of others must be reached.
    top : float
        What it cannot exceed, in `unit`; none falls below 0.
    rule : bool
        Its limit is one of practice, which no verdict of a run counts.
    no_error, no_band : str
        Why it has no error by models, or no band by tolerances, of its own.
    shares : {"", "life", "mean"}
        Where load cases count with their shares of the lifetime: it tells of a life or a year, or
        is a mean or a quantile over all of them.
    """

    name: str
    unit: str
    group: str
    of: Literal["all", "film", "journal", "collar", "rolling", "rows", "catalogues"] = "all"
    at_most: bool = False
    top: float = math.inf
    rule: bool = False
    no_error: str = ""
    no_band: str = ""
    shares: Literal["", "life", "mean"] = ""


_SHORT, _CAPACITY, _OIL = "In short", "Capacity", "Oil"
_TORQUE = "Friction torque of rolling bearings beside that of catalogues"
_BEFORE = "What fails before rating life does"
_NO_SPEED = "the slowest speed of the rotor was not measured on one of its models"

QUANTITIES: dict[str, Compared] = {
    "load_factor": Compared(
        "capacity margin: loads may grow by, to the first limit", "×", _SHORT
    ),
    "energy": Compared("energy lost a year", "MWh", _SHORT, shares="life"),
    "friction": Compared("mean friction loss", "kW", _SHORT, shares="mean"),
    "minimum_film": Compared("smallest film", "µm", _CAPACITY, "film"),
    "film_to_roughness": Compared(
        "smallest film over roughness R_z of both surfaces", "–", _CAPACITY, "film"
    ),
    "eccentricity_ratio": Compared(
        "largest eccentricity ratio ε", "–", _CAPACITY, "film", at_most=True
    ),
    "film_pressure": Compared("largest film pressure", "MPa", _CAPACITY, "film", at_most=True),
    "thrust_film": Compared("smallest film of the thrust bearing", "µm", _CAPACITY, "collar"),
    "thrust_pressure": Compared(
        "largest film pressure of the thrust bearing", "MPa", _CAPACITY, "collar", at_most=True
    ),
    "static_safety": Compared("static rating over the design load", "–", _CAPACITY, "rolling"),
    "contact_pressure": Compared(
        "largest contact pressure", "MPa", _CAPACITY, "rolling", at_most=True
    ),
    "modified_life": Compared(
        "modified life L10mh of all bearings", "years", _CAPACITY, "rolling", shares="life"
    ),
    "rating_life": Compared(
        "rating life L10h of all bearings", "years", _CAPACITY, "rolling", shares="life"
    ),
    "row_share": Compared(
        "load on the row that takes the thrust, at largest thrust", "%", _BEFORE, "rows", top=100.0
    ),
    "row_overload": Compared("the same over an even share", "×", _BEFORE, "rows"),
    "film_parameter": Compared("film parameter Λ at low speed", "–", _BEFORE, "rolling"),
    "viscosity_ratio": Compared(
        "smallest viscosity ratio κ while turning", "–", _BEFORE, "rolling", rule=True,
        no_error=_NO_SPEED,
    ),
    "minimum_load": Compared(
        "load over the dynamic capacity, exceeded for 95 % of the time (skidding)", "%", _BEFORE,
        "rolling", rule=True, shares="mean",
    ),
    "standstill": Compared(
        "time standing, share of the lifetime (marks of standing)", "%", _BEFORE, "rolling",
        no_band="loads decide it, no tolerance does", shares="life",
    ),
    "tilt": Compared("tilt of the shaft over its limit", "%", _BEFORE, at_most=True, rule=True),
    "whirl": Compared(
        "longest half-speed whirl of a load case, share of its time", "%", _BEFORE, "journal",
        at_most=True, top=100.0, rule=True,
        no_error="only the cells damp a whirl, and the ladder has not measured what they do to it",
        no_band="not followed again with other tolerances",
    ),
    "mixed_time": Compared(
        "time in mixed friction a year", "h", _BEFORE, "film", top=HOURS_PER_YEAR,
        no_error="not counted again: of films of pads, or of such as may be off by 100 %",
        shares="life",
    ),
    "wear": Compared(
        "wear of the shell by starts, stops and faults of the life",
        "µm", _BEFORE, "journal", at_most=True, rule=True,
    ),
    "friction_torque": Compared(
        "mean friction torque, ours", "N m", _TORQUE, "rolling", shares="mean"
    ),
    "palmgren_torque": Compared("after Palmgren", "N m", _TORQUE, "catalogues", shares="mean"),
    "skf_torque": Compared(
        "after SKF, with its constants", "N m", _TORQUE, "catalogues", shares="mean"
    ),
    "constant_coefficient_torque": Compared(
        "after a constant coefficient, on the bore", "N m", _TORQUE, "catalogues", shares="mean"
    ),
    "bearing_temperature": Compared(
        "warmest rolling bearing", "°C", _OIL, "rolling",
        no_error="the ladder has not measured it",
        no_band="the temperature of the oil is a tolerance itself",
    ),
    "oil_flow": Compared("oil that leaves the films", "l/min", _OIL, "film", shares="mean"),
    "pump": Compared("power to supply the oil", "kW", _OIL, "film", shares="mean"),
}  # fmt: skip
"""What is compared, in the order of the page: groups, and rows in each."""


def named_quantities() -> dict[str, dict[str, Any]]:
    """What is said of each quantity that is compared, for JSON."""
    told = ("name", "unit", "group", "at_most")
    return {key: {name: getattr(about, name) for name in told} for key, about in QUANTITIES.items()}
