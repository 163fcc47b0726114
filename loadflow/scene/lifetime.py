"""The section of a scene that says what happens how often in the life of the machine."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Annotated

from pydantic import BaseModel, Field

from loadflow.errors import InputError
from loadflow.scene.section import Section
from loadflow.wind.cases import check_counted

Count = Annotated[float, Field(ge=0, le=1e9)]


class Lifetime(Section, BaseModel):
    """How often a year starts, stops and faults happen, and how many years there are.

    ``per_year`` counts the events of a design load case over all its wind speeds, as IEC 61400-1
    asks for those of 2.3, 2.4, 3.1 and 4.1; variants of one, such as 3.1a and 3.1b, share its
    number evenly unless they have their own. They take their number times their length of the
    lifetime, with their damage and their energy; production and idling share the rest. Without a
    number an event has no share. Wear takes ``per_year`` times ``years`` of a case that starts,
    stops or stands, for which ``wear.counts`` says nothing, and of others their share of ``years``.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> scene = make_scene({"name": "life", "loads": {"dlc": ["1.2", "3.1"]},
    ...     "lifetime": {"per_year": {"3.1": 1000}}})
    >>> scene.lifetime.per_year, scene.lifetime.years
    ({'3.1': 1000.0}, 20.0)
    """

    per_year: dict[str, Count] = {}
    years: Annotated[float, Field(gt=0, le=1000)] = 20.0


def check_counts(
    lifetime: Lifetime, starts: Mapping[str, float], there: Iterable[str], weights: str
) -> None:
    """Refuse counts of load cases that are not there, or beside shares that files give.

    Parameters
    ----------
    lifetime : Lifetime
        With ``per_year``.
    starts : mapping of str to float
        ``wear.counts``.
    there : iterable of str
        Load cases of the scene.
    weights : str
        ``loads.weights``.

    Raises
    ------
    loadflow.errors.InputError
        Names the key.
    """
    known = {*there}
    check_counted("lifetime.per_year", lifetime.per_year, known)
    check_counted("wear.counts", starts, known)
    if lifetime.per_year and weights == "given":
        raise InputError(
            'lifetime.per_year: loads.weights = "given" takes the shares of the files; keep one'
        )
