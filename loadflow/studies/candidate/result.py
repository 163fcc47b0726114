"""Result of a comparison: numbers with their errors, candidates, and all of them together."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Sequence
from dataclasses import dataclass, field, fields
from typing import Any

from loadflow.storage import plain
from loadflow.studies.candidate.quantities import QUANTITIES, named_quantities
from loadflow.verdict import Verdict

THRUST = "force along the shaft without a bearing"
UNCARRIED = "thrust that no bearing carries"
STARTS_ALONE = "all load cases of this run start, stop or stand"
"""Why nothing is held to limits that are those of a shaft that runs."""


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

    @property
    def reservations(self) -> dict[str, str]:
        """Rules of practice that it breaks, with value and limit, and a thrust nothing carries.

        No verdict counts them, but they speak against a candidate that holds all limits.
        """
        found = {}
        for key, about in QUANTITIES.items():
            number = self.numbers.get(key)
            if about.rule and number is not None and number.holds is False:
                unit = "" if number.unit == "–" else f" {number.unit}"
                found[about.name] = f"{number.value:.3g}{unit}, limit {number.limit:.3g}{unit}"
        thrust = [v.value for v in self.verdicts if v.quantity == THRUST and not v.holds]
        if thrust:
            found[UNCARRIED] = f"{max(thrust) / 1e3:.0f} kN"
        return found

    @property
    def rank(self) -> tuple[bool, bool, float, float]:
        """Its place among others: what holds without reservations first, then by energy lost.

        Where the loads tell of no year, by how much they may grow.
        """
        lost, factor = (self.numbers[name].value for name in ("energy", "load_factor"))
        lost, factor = (math.inf if math.isnan(lost) else lost), (factor if factor > 0 else 0.0)
        return not self.holds, bool(self.reservations), lost, -factor

    def as_dict(self) -> dict[str, Any]:
        """All of it in plain values for JSON; what is not known is None."""
        return {
            "name": self.name,
            "title": self.title,
            "source": self.source,
            "kind": self.kind,
            "holds": self.holds,
            "broken": [f"{v.quantity} ({v.subject})" for v in self.broken],
            "reservations": self.reservations,
            "thrust": self.thrust,
            "governs": self.governs,
            "change": self.change,
            "numbers": {
                key: plain(vars(n)) | {"missing": missing(key, n)}
                for key, n in self.numbers.items()
            },
            "verdicts": [v.as_dict() for v in self.verdicts],
            "models": self.models,
            "checks": self.checks,
            "bearings": self.bearings,
            "folder": self.folder,
            "unanswered": self.unanswered,
            "references": self.references,
        }


def missing(key: str, number: Number) -> dict[str, str]:
    """Why a number has no interval (``seeds``), error (``models``) or band (``tolerances``).

    Examples
    --------
    >>> missing("standstill", Number(2.0, "%", low=1.0, high=3.0))["tolerances"]
    'loads decide it, no tolerance does'
    """
    if math.isnan(number.value):
        return {}
    about, found = QUANTITIES[key], {}
    if math.isnan(number.low):
        found["seeds"] = "one seed gives no interval, nor does a film that is broken with some"
    nothing = "it is 0, of which there is no share"
    if math.isnan(number.error):
        left = "" if number.value else nothing
        found["models"] = left or about.no_error or "a model of it was not measured"
    if math.isnan(number.tolerance_low):
        whole = "it is whole" if number.value == about.top else ""
        left = whole if number.value else nothing
        found["tolerances"] = about.no_band or left or "none of the tolerances that count moves it"
    return found


def without(rooms: Sequence[str]) -> dict[str, Number]:
    """Every quantity as bearings of some rooms have it who do not compute it: none, and why.

    Examples
    --------
    >>> without(["journal"])["rating_life"].note
    'n/a: no rolling elements'
    >>> without(["thrust"])["wear"].note
    'n/a: films of pads know no asperities that wear them'
    """
    fails, elements = "no model of it for these bearings", "no rolling elements"
    films, turns = {"journal", "thrust"} & {*rooms}, "rolling" in rooms
    pads = "films of pads know no asperities that wear them" if films else "no film bearing"
    why = {
        "all": fails,
        "film": fails if films else "no film bearing",
        "journal": fails if "journal" in rooms else pads,
        "collar": "no thrust collar beside journals",
        "rolling": fails if turns else elements,
        "catalogues": "no constants of these bearings" if turns else elements,
        "rows": "no bearing with several rows takes the thrust" if turns else elements,
    }
    return {
        key: Number(math.nan, about.unit, note=f"n/a: {why[about.of]}")
        for key, about in QUANTITIES.items()
    }


@dataclass(frozen=True)
class Comparison:
    """Candidates side by side.

    Attributes
    ----------
    name : str
        Of the scene.
    conclusion, reservations : str
        One sentence; what speaks against candidates that hold their limits, empty where nothing
        does.
    candidates : tuple of Judged
        By `Judged.rank`.
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
    reservations: str
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
            "reservations": self.reservations,
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
