"""A verdict: a number that was found, the limit that it is held against, and where that is from."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
import xarray as xr

from loadflow.quantities import fitting_unit, four_digits, scale_of

_FILMS = 1e-2  # m: lengths below are told in µm, as films are everywhere


@dataclass(frozen=True)
class Verdict:
    """What a bearing must hold, and whether it does.

    Attributes
    ----------
    subject : str
        Bearing, or what else is judged.
    quantity : str
        What is judged, in words.
    value, limit : float
        Found and allowed; a value that is not known is NaN and does not hold, a limit of NaN is
        none: the value is told only.
    sense : {"at most", "at least"}
        On which side of the limit the value must be.
    unit : str
        Of both.
    source : str
        Where the limit comes from.
    case : str
        Governing load case; empty where it is not of one.
    time : float
        Of the value in that case, s; NaN where it has none.
    note : str
        What else must be known to read the number.
    key : str
        Key of a scene that sets the limit; empty where none does.

    Examples
    --------
    >>> safe = Verdict("rolling N", "static safety", 1.15, 1.0, "at least", source="IEC 61400-1")
    >>> safe.holds, round(safe.margin, 2)
    (True, 0.15)
    >>> print(safe.sentence)
    rolling N: static safety 1.15, must be at least 1 (IEC 61400-1): holds
    """

    subject: str
    quantity: str
    value: float
    limit: float
    sense: Literal["at most", "at least"]
    unit: str = ""
    source: str = ""
    case: str = ""
    time: float = math.nan
    note: str = ""
    key: str = ""

    @property
    def margin(self) -> float:
        """Distance to the limit, in `unit`; below 0 where the limit is broken, NaN if unknown."""
        gap = self.limit - self.value
        return gap if self.sense == "at most" else -gap

    @property
    def holds(self) -> bool:
        """Whether the value is known and keeps to the limit, if there is one."""
        return self.answer in ("holds", "no limit")

    @property
    def answer(self) -> Literal["holds", "broken", "not answered", "no limit"]:
        """The verdict in words."""
        if math.isnan(self.value):
            return "not answered"
        if math.isnan(self.limit):
            return "no limit"
        return "holds" if self.margin >= 0 or self.value == self.limit else "broken"

    @property
    def numbers(self) -> tuple[str, str, str]:
        """Value, limit and margin with the unit in which an engineer reads them; "" if unknown."""
        known = [abs(one) for one in (self.value, self.limit) if math.isfinite(one)]
        size = max(known, default=0.0)
        film = self.unit == "m" and size < _FILMS
        factor, unit = (1e6, "µm") if film else fitting_unit(self.unit, size)
        unit = unit.strip("–")
        zero, scale = scale_of(unit)

        def told(number: float, unit: str) -> str:
            return "" if math.isnan(number) else f"{four_digits(factor * number)} {unit}".rstrip()

        return (
            told(self.value - zero, scale),
            told(self.limit - zero, scale),
            told(self.margin, unit),
        )

    @property
    def sentence(self) -> str:
        """All of it as a sentence."""
        value, limit, _ = self.numbers
        source = f" ({self.source})" if self.source else ""
        at = f", {self.case}" if self.case else ""
        at += f" at {self.time:.1f} s" if math.isfinite(self.time) else ""
        note = f"; {self.note}" if self.note else ""
        asked = f", must be {self.sense} {limit}" if limit else ""
        found = value or "unknown"
        return f"{self.subject}: {self.quantity} {found}{at}{asked}{source}: {self.answer}{note}"

    def as_dict(self) -> dict[str, Any]:
        """All fields, with `margin` and `answer`; what is not known is None."""
        data = vars(self) | {"margin": self.margin, "answer": self.answer}
        return {
            name: None if isinstance(part, float) and math.isnan(part) else part
            for name, part in data.items()
        }


_NUMBERS = {
    "value": "number found, in `unit`",
    "limit": "limit, in `unit`",
    "margin": "distance to the limit, in `unit`",
    "time": "time of the value in its load case, s",
}
_WORDS = ("subject", "quantity", "sense", "unit", "source", "case", "note", "key", "answer")


def to_dataset(verdicts: Iterable[Verdict]) -> xr.Dataset:
    """Verdicts as a table over ``verdict``."""
    rows = list(verdicts)
    numbers = {
        name: (
            "verdict",
            np.array([getattr(row, name) for row in rows], float),
            {"units": "s" if name == "time" else "mixed", "long_name": meaning},
        )
        for name, meaning in _NUMBERS.items()
    }
    words = {
        name: (
            "verdict",
            np.array([getattr(row, name) for row in rows], str),
            {"units": "1", "long_name": name},
        )
        for name in _WORDS
    }
    return xr.Dataset(numbers | words)


def from_dataset(table: xr.Dataset) -> Iterator[Verdict]:
    """Yield the verdicts of a table that `to_dataset` made."""
    own = list(Verdict.__dataclass_fields__)
    for k in range(table.sizes.get("verdict", 0)):
        yield Verdict(**{name: table[name].values[k].item() for name in own})
