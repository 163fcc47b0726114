"""What results show of themselves in a notebook: a table of their quantities."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping
from html import escape

import numpy as np

from loadflow.errors import LoadflowError
from loadflow.quantities import READABLE, Quantity

FEW = 4
"""Numbers that are listed one by one; of more the extremes are shown."""


class Shown(ABC):
    """A result with a table for notebooks."""

    @abstractmethod
    def shown_quantities(self) -> Mapping[str, Quantity]:
        """What is shown of it, by name, where the result has it."""

    def _repr_html_(self) -> str:
        """Quantity, value, unit and meaning, one in a row."""
        rows = "".join(
            f"<tr><td>{escape(q.symbol)}</td><td style='text-align:left'>{escape(q.meaning)}</td>"
            f"<td>{text}</td><td style='text-align:left'>{escape(unit)}</td></tr>"
            for q, text, unit in self._shown()
        )
        head = escape(repr(self).splitlines()[0].strip("<>"))
        return (
            f"<table><caption style='text-align:left'>{head}</caption>"
            "<thead><tr><th></th><th style='text-align:left'>quantity</th><th>value</th>"
            f"<th style='text-align:left'>unit</th></tr></thead><tbody>{rows}</tbody></table>"
        )

    def _shown(self) -> Iterator[tuple[Quantity, str, str]]:
        for name, quantity in self.shown_quantities().items():
            try:
                value = getattr(self, name, None)
            except LoadflowError:  # of those that a bearing does not have
                continue
            if value is not None and np.size(value):
                yield quantity, *in_words(np.asarray(value), quantity.units)


def in_words(values: np.ndarray, units: str) -> tuple[str, str]:
    """Values in few words, and the unit in which they are.

    Examples
    --------
    >>> import numpy as np
    >>> in_words(np.array(2.5e-5), "m")
    ('25', 'µm')
    >>> in_words(np.array([True, False]), "1")
    ('yes, no', '')
    >>> in_words(np.array([1e6, 2e6, 3e6, 4e6, 5e6]), "Pa")
    ('1 … 5', 'MPa')
    """
    flat = np.ravel(values)
    if flat.dtype == bool:
        if flat.size <= FEW:
            return ", ".join("yes" if one else "no" for one in flat), ""
        return f"{np.count_nonzero(flat)} of {flat.size}", ""
    factor, unit = READABLE.get(units, (1.0, units))
    known = flat[np.isfinite(flat)]
    if units == "m" and known.size and np.abs(known).max() < 1e-2:
        factor, unit = 1e6, "µm"
    if units == "N m":
        factor, unit = 1.0, units  # of friction as of tilting moments
    shown = flat * factor
    unit = "" if unit == "–" else unit
    if flat.size <= FEW:
        return ", ".join(f"{one:.4g}" for one in shown), unit
    if not known.size:
        return "no value", unit
    return f"{np.nanmin(shown):.4g} … {np.nanmax(shown):.4g}", unit


def span_in_words(values: np.ndarray, units: str) -> tuple[str, str]:
    """Least and largest value, or the one that all have, and the unit in which they are.

    Examples
    --------
    >>> import numpy as np
    >>> span_in_words(np.array([2e6, 1e6, 3e6]), "Pa")
    ('1 … 3', 'MPa')
    >>> span_in_words(np.array([2e6, 2e6]), "Pa")
    ('2', 'MPa')
    """
    span, unit = in_words(np.unique([values.min(), values.max()]), units)
    return span.replace(", ", " … "), unit
