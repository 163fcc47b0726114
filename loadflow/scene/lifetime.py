"""The section of a scene that says what happens how often in the life of the machine."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated

from pydantic import BaseModel, Field

from loadflow.scene.section import Section

Count = Annotated[float, Field(ge=0, le=1e9)]


class Lifetime(Section, BaseModel):
    """How often a year starts, stops and faults happen, and how many years there are.

    ``per_year`` counts the events of a design load case over all its wind speeds, as IEC 61400-1
    asks for those of 2.3, 2.4, 3.1 and 4.1. They take their number times their length of the
    lifetime, with their damage and their energy; production and idling share the rest. Without a
    number an event has no share. Wear takes ``per_year`` times ``years`` of a load case for which
    ``wear.counts`` says nothing.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> scene = make_scene({"name": "life", "loads": {"dlc": ["1.2", "3.1"]},
    ...     "lifetime": {"per_year": {"3.1": 1000}}})
    >>> scene.lifetime.count("3.1"), scene.lifetime.count("1.2")
    (20000.0, None)
    """

    per_year: dict[str, Count] = {}
    years: Annotated[float, Field(gt=0, le=1000)] = 20.0

    def count(self, dlc: str) -> float | None:
        """How often a design load case happens in the life; None where nothing is said."""
        return self.years * self.per_year[dlc] if dlc in self.per_year else None


def check_per_year(lifetime: Lifetime, there: Iterable[str], weights: str) -> None:
    """Refuse counts of load cases that are not there, or beside shares that files give.

    Raises
    ------
    ValueError
        Names the key.
    """
    known = sorted(set(there))
    for dlc in lifetime.per_year:
        if dlc not in known:
            raise ValueError(
                f"lifetime.per_year: no load case {dlc!r}; there are {', '.join(known)}"
            )
    if lifetime.per_year and weights == "given":
        raise ValueError(
            'lifetime.per_year: loads.weights = "given" takes the shares of the files; keep one'
        )
