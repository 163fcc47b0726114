"""One number of a source beside ours."""

from __future__ import annotations

import functools
import importlib
import pkgutil
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal, ParamSpec, get_args

from loadflow.errors import InputError

Evidence = Literal[
    "measured elsewhere", "another code", "closed form", "print of the source", "consistency"
]
EVIDENCE: tuple[Evidence, ...] = get_args(Evidence)
"""What a row is held against, the strongest first.

Measured elsewhere: an experiment of others. Another code: a program that is not this one, or a
published numerical solution. Closed form: an exact solution or a formula, evaluated apart from what
is tested. Print of the source: what the work prints whose method is followed here. Consistency: two
answers of our own, one of them as an input or by another way; that they agree says nothing about
the world.
"""
OUTCOMES = ("ok", "out", "refused", "missed", "not computed")
"""What may become of a row."""

_Arguments = ParamSpec("_Arguments")


@dataclass(frozen=True)
class Check:
    """One printed number beside ours.

    Attributes
    ----------
    name : str
        What is compared, e.g. ``"E_max, V = 12 m/s"``.
    source : str
        Where it is printed, e.g. ``"Table 5-13"``.
    expected, got : float
        The printed number and ours, in `unit`.
    tolerance : float
        Allowed deviation; a share of `expected` if `kind` is ``"relative"``, in `unit` if it is
        ``"absolute"``. For ``"below"`` the check asks ``got <= expected * (1 + tolerance)``, for
        ``"above"`` that ``got >= expected * (1 - tolerance)``.
    kind : {"relative", "absolute", "below", "above"}
        How `tolerance` is meant.
    unit : str
        Unit of both numbers, ``"-"`` if none.
    refused : str
        Why the printed number is not held, if it is not: `got` is then what the source's own data
        give instead, and the row is in order as long as it contradicts the print, out of tolerance.
    missed : str
        Why ours misses a number that is not in doubt, if it does; the row is in order as long as
        it misses, so that it does not stay behind when the model becomes better.
    absent : str
        What is not installed without which the number cannot be computed; `got` is then NaN.
    evidence : str, optional
        What `expected` is, one of `EVIDENCE`; `evidence` states it for all rows of a function.
    """

    name: str
    source: str
    expected: float
    got: float
    tolerance: float
    kind: Literal["relative", "absolute", "below", "above"] = "relative"
    unit: str = "-"
    refused: str = ""
    missed: str = ""
    absent: str = ""
    evidence: Evidence | None = None

    @property
    def deviation(self) -> float:
        """Deviation of `got`, in the terms of `kind`."""
        difference = self.got - self.expected
        return difference if self.kind == "absolute" else difference / abs(self.expected)

    @property
    def ok(self) -> bool:
        """Whether the deviation is within the tolerance, beyond it if refused or missed.

        Never of a NaN.
        """
        sides = {"below": self.deviation, "above": -self.deviation}
        deviation = sides.get(self.kind, abs(self.deviation))
        beyond = self.refused or self.missed
        return bool(deviation > self.tolerance if beyond else deviation <= self.tolerance)

    @property
    def outcome(self) -> str:
        """One of `OUTCOMES`."""
        if self.absent:
            return "not computed"
        if not self.ok:
            return "out"
        return "refused" if self.refused else "missed" if self.missed else "ok"

    @property
    def verdict(self) -> str:
        """The outcome, and why where there is more to say."""
        reasons = {"refused": self.refused, "missed": self.missed, "not computed": self.absent}
        reason = reasons.get(self.outcome)
        return f"{self.outcome}: {reason}" if reason else self.outcome


def evidence(
    kind: Evidence,
) -> Callable[[Callable[_Arguments, Iterator[Check]]], Callable[_Arguments, Iterator[Check]]]:
    """State what the rows of a function are held against, unless they say so themselves.

    Parameters
    ----------
    kind : str
        One of `EVIDENCE`.

    Examples
    --------
    >>> @evidence("closed form")
    ... def rows():
    ...     yield Check("sum of angles", "triangle", 180.0, 180.0, 1e-9, unit="°")
    >>> [row.evidence for row in rows()]
    ['closed form']
    """

    def stating(
        rows: Callable[_Arguments, Iterator[Check]],
    ) -> Callable[_Arguments, Iterator[Check]]:
        @functools.wraps(rows)
        def stated(*args: _Arguments.args, **kwargs: _Arguments.kwargs) -> Iterator[Check]:
            for row in rows(*args, **kwargs):
                yield row if row.evidence else replace(row, evidence=kind)

        return stated

    return stating


def counts(rows: Iterable[Check]) -> dict[Evidence, dict[str, int]]:
    """Return how many rows of each kind of evidence came out how; kinds without rows are left out.

    Examples
    --------
    >>> row = Check("x", "print", 1.0, 1.2, 0.1, evidence="closed form")
    >>> counts([row, replace(row, got=1.0)])["closed form"]
    {'ok': 1, 'out': 1, 'refused': 0, 'missed': 0, 'not computed': 0}
    """
    found = [(row.evidence, row.outcome) for row in rows]
    return {
        kind: {outcome: found.count((kind, outcome)) for outcome in OUTCOMES}
        for kind in EVIDENCE
        if any(kind == of for of, _ in found)
    }


def names() -> list[str]:
    """Names of the validation tables, in alphabetical order."""
    modules = (module.name for module in pkgutil.iter_modules([str(Path(__file__).parent)]))
    return sorted(name for name in modules if name != "check" and not name.startswith("_"))


def all_checks(name: str, folder: Path | None = None) -> Iterator[Check]:
    """Yield the checks of the table `name`.

    Parameters
    ----------
    name : str
        One of `names`.
    folder : Path, optional
        With files that are not part of the package, for the rows that need them.

    Raises
    ------
    InputError
        A folder, but no row of this table needs one, or a file is not in it.
    """
    table = importlib.import_module(f"loadflow.validation.{name}")
    of_files = getattr(table, "checks_of_files", None)
    if folder is not None and of_files is None:
        raise InputError(f"folder = {folder}: no number of the table {name} needs files")
    yield from table.checks()
    if folder is not None and of_files is not None:
        yield from of_files(folder)
