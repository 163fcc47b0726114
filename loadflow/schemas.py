"""Versions of forms of data on disk: an older one is brought up to date, a newer one refused."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from loadflow.errors import FormerVersionWarning, InputError, NewerVersionError

Step = Callable[[Any], tuple[Any, list[str]]]
"""Turns data of one version into the next: the data, and a sentence for each thing it changed."""


@dataclass(frozen=True)
class Schema:
    """A form of data on disk, and how each older version of it becomes the present one.

    Attributes
    ----------
    what : str
        What has this form, for messages.
    key : str
        Under which the data say their version; data without it are of version 1.
    steps : tuple of callable
        The step at index k turns version k + 1 into k + 2.

    Examples
    --------
    >>> def metres(data):
    ...     return {"length": data["length"] / 1000}, ["length: from mm to m"]
    >>> rods = Schema("rod", "schema", (metres,))
    >>> rods.version
    2
    >>> rods.upgrade({"length": 1.5}, 2, "rod.json")
    {'length': 1.5}
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     old = rods.upgrade({"length": 1500.0}, 1, "rod.json")
    >>> old["length"], str(told[0].message)
    (1.5, 'rod.json: rod of schema 1, read as 2: length: from mm to m')
    """

    what: str
    key: str
    steps: tuple[Step, ...] = ()

    @property
    def version(self) -> int:
        """The present version."""
        return len(self.steps) + 1

    def upgrade(self, data: Any, version: Any, source: str = "") -> Any:
        """Return data of any known version in the present form; a warning says what was changed.

        Parameters
        ----------
        data
            As they were read, without their version.
        version : int
            What they say of it.
        source : str
            Name of the file, for messages.

        Raises
        ------
        loadflow.errors.NewerVersionError
            Only a newer loadflow can read it.
        loadflow.errors.InputError
            It is no version at all.

        Warns
        -----
        loadflow.errors.FormerVersionWarning
            Something was changed.
        """
        self.check(version, source)
        told = []
        for step in self.steps[int(version) - 1 :]:
            data, changes = step(data)
            told += changes
        if told:
            where = f"{source}: " if source else ""
            warnings.warn(
                f"{where}{self.what} of {self.key} {version}, read as {self.version}: "
                + "; ".join(told),
                FormerVersionWarning,
                stacklevel=2,
            )
        return data

    def check(self, version: Any, source: str = "") -> None:
        """Raise unless this loadflow can read a version.

        Raises
        ------
        loadflow.errors.NewerVersionError
            Only a newer loadflow can read it.
        loadflow.errors.InputError
            It is no version at all.

        Examples
        --------
        >>> Schema("rod", "n").check(7)
        Traceback (most recent call last):
        loadflow.errors.NewerVersionError: n = 7: must be 1 … 1; a newer loadflow wrote this rod
        """
        try:
            number = int(version)
            is_number = bool(number == version) and not isinstance(version, bool | str)
        except (TypeError, ValueError):
            number, is_number = 0, False
        if is_number and 1 <= number <= self.version:
            return
        where = f"{source}: " if source else ""
        shown = number if is_number else repr(version)
        bad = f"{where}{self.key} = {shown}: must be 1 … {self.version}"
        if is_number and number > self.version:
            raise NewerVersionError(f"{bad}; a newer loadflow wrote this {self.what}")
        raise InputError(bad)
