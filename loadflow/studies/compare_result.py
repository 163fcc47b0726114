"""Result of a comparison: numbers with their errors, candidates, and all of them together."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from loadflow.verdict import Verdict

THRUST = "force along the shaft without a bearing"


@dataclass(frozen=True)
class Number:
    """One answer for one candidate, with what is known of its error.

    Attributes
    ----------
    value : float
        In `unit`; NaN where it has none.
    unit : str
        Unit.
    low, high : float
        95 % interval by the seeds of the loads; NaN where one seed alone tells nothing.
    error : float
        Error by models to expect, as a share of the value; NaN where it was not measured.
    limit : float
        Of the value; NaN without one.
    holds : bool or None
        Whether it keeps to its limit.
    case : str
        Load case of an extreme.
    time : float
        Its time in that case, s.
    place : str
        Bearing that it belongs to.
    note : str
        What else must be known.
    tolerance_low, tolerance_high : float
        Band by tolerances; NaN where the value does not follow them, or none were asked.
    tolerance : str
        Which tolerance moves it most.
    """

    value: float
    unit: str = ""
    low: float = math.nan
    high: float = math.nan
    error: float = math.nan
    limit: float = math.nan
    holds: bool | None = None
    case: str = ""
    time: float = math.nan
    place: str = ""
    note: str = ""
    tolerance_low: float = math.nan
    tolerance_high: float = math.nan
    tolerance: str = ""


@dataclass(frozen=True)
class Judged:
    """A candidate with all its numbers.

    Attributes
    ----------
    name, title, source, kind : str
        Of the candidate; the kind is journal, conical, rolling or several.
    numbers : dict
        By quantity (`QUANTITIES`).
    verdicts : tuple of Verdict
        All of its run.
    thrust : str
        What carries the force along the shaft.
    governs : str
        The limit that is reached first.
    change : str
        What would change the verdict.
    models : dict
        Rung of each stage.
    checks : list
        How far sampled answers moved with better models: stage, quantity, change.
    bearings : list
        The bearing at each place.
    folder : str
        Of its run, relative to that of the comparison.
    unanswered : dict
        Parts without an answer.
    references : str
        Numbers of others that its models are held against.
    """

    name: str
    title: str
    source: str
    kind: str
    numbers: dict[str, Number]
    verdicts: tuple[Verdict, ...]
    thrust: str
    governs: str
    change: str
    models: dict[str, str]
    checks: list[dict[str, Any]]
    bearings: list[dict[str, Any]]
    folder: str
    unanswered: dict[str, str] = field(default_factory=dict)
    references: str = ""

    @property
    def broken(self) -> list[Verdict]:
        """Verdicts that do not hold, but for the lack of a thrust bearing."""
        return [v for v in self.verdicts if not v.holds and v.quantity != THRUST]

    @property
    def holds(self) -> bool:
        """Whether all hold, but for the lack of a thrust bearing."""
        return not self.broken and not self.unanswered

    def as_dict(self) -> dict[str, Any]:
        """All of it in plain values for JSON; what is not known is None."""
        return {
            "name": self.name,
            "title": self.title,
            "source": self.source,
            "kind": self.kind,
            "holds": self.holds,
            "thrust": self.thrust,
            "governs": self.governs,
            "change": self.change,
            "numbers": {key: plain(vars(n)) for key, n in self.numbers.items()},
            "verdicts": [v.as_dict() for v in self.verdicts],
            "models": self.models,
            "checks": self.checks,
            "bearings": self.bearings,
            "folder": self.folder,
            "unanswered": self.unanswered,
            "references": self.references,
        }


QUANTITIES: dict[str, tuple[str, str]] = {
    "load_factor": ("capacity margin: loads may grow by, to the first limit", "×"),
    "minimum_film": ("smallest film", "µm"),
    "film_to_roughness": ("smallest film over roughness R_z of both surfaces", "–"),
    "thrust_film": ("smallest film of the thrust bearing", "µm"),
    "thrust_pressure": ("largest film pressure of the thrust bearing", "MPa"),
    "eccentricity_ratio": ("largest eccentricity ratio ε", "–"),
    "film_pressure": ("largest film pressure", "MPa"),
    "static_safety": ("static rating over the design load", "–"),
    "contact_pressure": ("largest contact pressure", "MPa"),
    "modified_life": ("modified life L10mh of all bearings", "years"),
    "rating_life": ("rating life L10h of all bearings", "years"),
    "row_share": ("load on the row that takes the thrust, at largest thrust", "%"),
    "row_overload": ("the same over an even share", "×"),
    "film_parameter": ("film parameter Λ at low speed", "–"),
    "viscosity_ratio": ("smallest viscosity ratio κ while turning", "–"),
    "minimum_load": ("smallest load over the dynamic capacity (skidding)", "%"),
    "standstill": ("time standing, share of the lifetime (marks of standing)", "%"),
    "tilt": ("tilt of the shaft over its limit", "%"),
    "friction": ("mean friction loss", "kW"),
    "energy": ("energy lost a year", "MWh"),
    "oil_flow": ("oil that leaves the film", "l/min"),
    "pump": ("power to supply the oil", "kW"),
    "mixed_time": ("time in mixed friction a year", "h"),
    "wear": ("wear of the shell by starts, stops and faults of the life", "µm"),
}
"""What is compared: its name and unit, in the order of the table."""


_FILMS = ("minimum_film", "film_to_roughness", "eccentricity_ratio", "film_pressure", "mixed_time")
_ROLLING = ("static_safety", "contact_pressure", "modified_life", "rating_life", "film_parameter",
    "viscosity_ratio", "minimum_load", "standstill")  # fmt: skip
_ROWS = ("row_share", "row_overload")
_FED = ("oil_flow", "pump", "wear")


def without(rooms: Sequence[str]) -> dict[str, Number]:
    """Every quantity as bearings of some rooms have it who do not compute it: none, and why.

    Examples
    --------
    >>> without(["journal"])["rating_life"].note
    'n/a: no rolling elements'
    >>> without(["thrust"])["pump"].note
    'n/a: not computed for films of pads'
    """
    why = dict.fromkeys(QUANTITIES, "no model of it for these bearings")
    why |= dict.fromkeys(_ROWS, "no bearing with several rows takes the thrust")
    why |= dict.fromkeys(("thrust_film", "thrust_pressure"), "no thrust collar beside journals")
    if "rolling" not in rooms:
        why |= dict.fromkeys((*_ROLLING, *_ROWS), "no rolling elements")
    if not {"journal", "thrust"} & {*rooms}:
        why |= dict.fromkeys((*_FILMS, *_FED), "no film bearing")
    elif "journal" not in rooms:
        why |= dict.fromkeys(_FED, "not computed for films of pads")
    return {
        key: Number(math.nan, unit, note=f"n/a: {why[key]}")
        for key, (_, unit) in QUANTITIES.items()
    }


def named_quantities() -> dict[str, dict[str, str]]:
    """Name and unit of what is compared, for JSON."""
    return {key: {"name": name, "unit": unit} for key, (name, unit) in QUANTITIES.items()}


@dataclass(frozen=True)
class Comparison:
    """Candidates side by side.

    Attributes
    ----------
    name : str
        Of the scene.
    conclusion : str
        One sentence.
    candidates : tuple of Judged
        Those that hold first, each group by the energy that it loses.
    facts : dict
        Loads, seeds, shaft.
    shaft : list
        Suspensions, to draw: bearings, positions, masses.
    failures : dict
        Candidates without an answer, and why.
    without_place : list of str
        Candidates that the shaft has no place for.
    """

    name: str
    conclusion: str
    candidates: tuple[Judged, ...]
    facts: dict[str, str]
    shaft: list[dict[str, Any]]
    failures: dict[str, str]
    without_place: list[str]

    def as_dict(self) -> dict[str, Any]:
        """All of it in plain values for JSON; what is not known is None."""
        return {
            "name": self.name,
            "conclusion": self.conclusion,
            "facts": self.facts,
            "quantities": named_quantities(),
            "candidates": [one.as_dict() for one in self.candidates],
            "shaft": self.shaft,
            "failures": self.failures,
            "without_place": self.without_place,
        }

    def to_csv(self) -> str:
        """All numbers as CSV, one for each line."""
        text = io.StringIO()
        heads = [one.name for one in fields(Number) if one.name not in ("value", "unit")]
        rows = csv.writer(text, lineterminator="\n")
        rows.writerow(["candidate", "quantity", "value", "unit", *heads])
        for one in self.candidates:
            for key, number in one.numbers.items():
                told = plain(vars(number))
                first = [one.name, key, told["value"], number.unit]
                rows.writerow([*first, *("" if told[h] is None else told[h] for h in heads)])
        return text.getvalue()


def plain(data: Any) -> Any:
    """Plain values for JSON; what is not finite is None."""
    if isinstance(data, Mapping):
        return {name: plain(part) for name, part in data.items()}
    if isinstance(data, np.generic):
        data = data.item()
    return None if isinstance(data, float) and not math.isfinite(data) else data
