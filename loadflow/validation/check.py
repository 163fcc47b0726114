"""One number of a source beside ours."""

from __future__ import annotations

import importlib
import pkgutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Literal


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
        ``"absolute"``. For ``"below"`` the check asks ``got <= expected * (1 + tolerance)``.
    kind : {"relative", "absolute", "below"}
        How `tolerance` is meant.
    unit : str
        Unit of both numbers, ``"-"`` if none.
    refused : str
        Why the printed number is not held, if it is not: `got` is then what the source's own data
        give instead, and the row is in order as long as it contradicts the print, out of tolerance.
    """

    name: str
    source: str
    expected: float
    got: float
    tolerance: float
    kind: Literal["relative", "absolute", "below"] = "relative"
    unit: str = "-"
    refused: str = ""

    @property
    def deviation(self) -> float:
        """Deviation of `got`, in the terms of `kind`."""
        difference = self.got - self.expected
        return difference if self.kind == "absolute" else difference / abs(self.expected)

    @property
    def ok(self) -> bool:
        """Whether the deviation is within the tolerance, beyond it if refused; never of a NaN."""
        deviation = self.deviation if self.kind == "below" else abs(self.deviation)
        return bool(deviation > self.tolerance if self.refused else deviation <= self.tolerance)

    @property
    def verdict(self) -> str:
        """``"ok"``, ``"out"``, or ``"refused: "`` and why."""
        return (
            f"refused: {self.refused}" if self.ok and self.refused else "ok" if self.ok else "out"
        )


def names() -> list[str]:
    """Names of the validation tables, in alphabetical order."""
    modules = (module.name for module in pkgutil.iter_modules([str(Path(__file__).parent)]))
    return sorted(name for name in modules if name != "check" and not name.startswith("_"))


def all_checks(name: str) -> Iterator[Check]:
    """Yield the checks of the table `name`."""
    yield from importlib.import_module(f"loadflow.validation.{name}").checks()
