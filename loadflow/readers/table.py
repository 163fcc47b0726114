"""Channels of a file with their names and units, as they stand there."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import NDArray

DEGREE = math.pi / 180.0
UNITS: dict[str, dict[str, float]] = {
    "rad/s": {
        "rad/s": 1.0,
        "rad/sec": 1.0,
        "rpm": math.pi / 30,
        "1/min": math.pi / 30,
        "rev/min": math.pi / 30,
        "r/min": math.pi / 30,
        "deg/s": DEGREE,
        "deg/sec": DEGREE,
    },
    "rad": {"rad": 1.0, "deg": DEGREE, "°": DEGREE},
    "m/s": {"m/s": 1.0, "m/sec": 1.0},
    "N": {"n": 1.0, "kn": 1e3, "mn": 1e6},
    "N m": {"nm": 1.0, "knm": 1e3, "mnm": 1e6},
    "W": {"w": 1.0, "kw": 1e3, "mw": 1e6},
    "s": {"s": 1.0, "sec": 1.0},
}
"""SI unit → what files may say instead → factor."""

UNKNOWN = "INVALID"
"""Unit that OpenFAST writes for a channel it does not know; its values mean nothing."""


@dataclass(frozen=True)
class Table:
    """Content of one file, as it stands there.

    Attributes
    ----------
    source : str
        Name of the file, for messages.
    stamps : ndarray, shape (n,)
        Time stamps, s.
    names, units : tuple of str
        Of each column, in the order of the file.
    values : ndarray, shape (n, columns)
        The series.
    descriptions : tuple of str
        Of each column, or nothing; channels are found by them too.
    doubts : tuple of str
        What is odd about the file although it can be read.
    """

    source: str
    stamps: NDArray[Any]
    names: tuple[str, ...]
    units: tuple[str, ...]
    values: NDArray[Any]
    descriptions: tuple[str, ...] = ()
    doubts: tuple[str, ...] = ()

    def find(self, channel: str) -> int | None:
        """Return the column of a channel, or None.

        Parameters
        ----------
        channel : str
            Name, in upper or lower case; ``"#7"`` for the seventh column of the file; or
            words of the description that only one channel has. A leading minus is ignored. A
            channel with the unit `UNKNOWN` does not count.

        Raises
        ------
        loadflow.errors.InputError
            Several columns have the name.
        """
        columns = self.columns(channel)
        if len(columns) > 1:
            numbers = ", ".join(f"#{i + 1}" for i in columns)
            name = channel.removeprefix("-")
            raise InputError(
                f"{self.source}: {len(columns)} channels {name!r}; name one: {numbers}"
            )
        return columns[0] if columns else None

    def columns(self, channel: str) -> list[int]:
        """Return all columns that a name may mean; see `find`."""
        name = channel.removeprefix("-")
        if name.startswith("#") and name[1:].isdigit():
            column = int(name[1:]) - 1
            return [column] if 0 <= column < len(self.names) else []
        plain = " ".join(name.casefold().split())
        rules = (
            lambda i: self.names[i] == name,
            lambda i: self.names[i].casefold() == name.casefold(),
            lambda i: self._description(i) == plain,
            lambda i: plain in self._description(i),
        )
        for rule in rules:
            if columns := [i for i in self._valid if rule(i)]:
                return columns
        return []

    def _description(self, column: int) -> str:
        """Description in lower case with single blanks."""
        text = self.descriptions[column] if self.descriptions else ""
        return " ".join(text.casefold().split())

    def series(self, channel: str, si: str) -> NDArray[np.float64]:
        """Return one channel in SI units.

        Parameters
        ----------
        channel : str
            As in `find`; with a leading minus the sign is reversed.
        si : str
            Unit to return, a key of `UNITS`.

        Raises
        ------
        loadflow.errors.InputError
            No such channel, its unit cannot be converted to `si`, or a value is not finite.
        """
        column = self.find(channel)
        if column is None:
            raise InputError(f"{self.source}: channel {channel!r} is missing; {self.listing()}")
        values = np.asarray(self.values[:, column], dtype=float)
        bad = ~np.isfinite(values)
        if bad.any():
            i = int(np.argmax(bad))
            raise InputError(
                f"{self.source}, channel {self.names[column]!r}, index {i} "
                f"(time {self.stamps[i]:g} s): value {values[i]} is not finite"
            )
        sign = -1.0 if channel.startswith("-") else 1.0
        return sign * self._factor(column, si) * values

    def has_unit(self, channel: str, si: str) -> bool:
        """Whether a channel that the file has can be converted to an SI unit."""
        column = self.find(channel)
        return column is not None and _plain_unit(self.units[column]) in UNITS[si]

    def listing(self) -> str:
        """Return what channels there are, for messages."""
        number = (lambda i: f"#{i + 1} ") if self.descriptions else (lambda i: "")
        valid = [number(i) + self.names[i] for i in self._valid]  # where a name may repeat
        more = f" and {len(valid) - 60} more" if len(valid) > 60 else ""
        invalid = len(self.names) - len(valid)
        without = f"; {invalid} channels have the unit {UNKNOWN}" if invalid else ""
        return f"the file has {', '.join(valid[:60])}{more}{without}"

    @property
    def _valid(self) -> list[int]:
        return [i for i, unit in enumerate(self.units) if unit.strip("()").upper() != UNKNOWN]

    def _factor(self, column: int, si: str) -> float:
        unit = self.units[column]
        factor = UNITS[si].get(_plain_unit(unit))
        if factor is None:
            raise InputError(
                f"{self.source}, channel {self.names[column]!r}: unit {unit!r} cannot be read as "
                f"{si!r}; expected one of {', '.join(UNITS[si])}"
            )
        return factor


def _plain_unit(unit: str) -> str:
    plain = unit.strip().strip("()[]").casefold()
    for sign in "·*-. ":
        plain = plain.replace(sign, "")
    return plain
