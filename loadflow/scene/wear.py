"""The section of a scene that says how its journal bearings wear over a lifetime of starts."""

from __future__ import annotations

from typing import Annotated, Self

from pydantic import BaseModel, Field

from loadflow.errors import InputError
from loadflow.journal.wear.lifetime import Wear as WearModel
from loadflow.scene.journal import Journal
from loadflow.scene.section import Section
from loadflow.scene.shaft import Shaft
from loadflow.tribology import Archard, Fleischer, RunningIn

MOST = 1e9
"""Events in a life, at most."""

Count = Annotated[float, Field(ge=0, le=MOST)]


class Wear(Section, BaseModel):
    """Wear of the journal bearings over their life, for the result ``journal.wear``.

    The result is computed only where it is asked for by name, with a ``law``: Archard's
    ``{coefficient = …}``, m²/N, or Fleischer's ``{energy_density = …}``, J/m³. Every load case that
    starts, stops or stands wears the bore in what of its film is in contact while it turns:
    ``events`` times in the life, or as often as ``counts`` says of its design load case, shared by
    its wind speeds as they blow, and evenly by its variants (3.1a, 3.1b). 20,000 starts are what a
    test rig of main bearings was given for a life. Other load cases wear it with their share of
    the lifetime, by their spells of contact, where films are followed in motion. Each load case is
    followed in at most ``samples`` steps, with the motion and the rung of ``[journal]``.

    ``running_in``, ``around``, ``across``, ``step`` and ``renewal`` are those of
    `loadflow.journal.Wear`.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> scene = make_scene({"name": "life", "wear": {"law": {"coefficient": 1e-17}}})
    >>> scene.wear.law, scene.wear.events
    (Archard(coefficient=1e-17), 20000.0)
    """

    law: Archard | Fleischer | None = None
    running_in: RunningIn | None = None
    events: Count = 20_000.0
    counts: dict[str, Count] = {}
    samples: Annotated[int, Field(ge=10, le=10_000)] = 200
    around: Annotated[int, Field(ge=36, le=7200)] = 720
    across: Annotated[int, Field(ge=1, le=200)] = 1
    step: Annotated[float, Field(gt=0, le=1)] = 0.1
    renewal: Annotated[float, Field(gt=0, le=10)] = 1.0

    def with_events(self, events: float) -> Self:
        """The same with another number of starts, stops and faults, also of those in ``counts``.

        Raises
        ------
        loadflow.errors.InputError
            There is no law of wear that they could follow, or no such number.

        Examples
        --------
        >>> from loadflow.scene import make_scene
        >>> scene = make_scene({"name": "life", "wear": {"law": {"coefficient": 1e-17}}})
        >>> scene.wear.with_events(5000).events
        5000.0
        """
        if self.law is None:
            raise InputError(
                "starts: without wear.law nothing wears; state [wear] with a law, and contact of "
                "the journal bearings"
            )
        if not 0 <= events <= MOST:
            raise InputError(f"starts: must be from 0 to {MOST:g}, got {events:g}")
        changed = self.model_copy(update={"events": float(events), "counts": {}})
        changed.model_fields_set.discard("counts")
        return changed

    @property
    def model(self) -> WearModel:
        """The wear that these keys describe; there must be a law."""
        assert self.law is not None
        names = ("law", "running_in", "around", "across", "step", "renewal")
        return WearModel(**{name: getattr(self, name) for name in names})


def check_wear(wear: Wear, journal: Journal, shaft: Shaft) -> None:
    """Refuse journal bearings whose wear cannot be followed.

    Raises
    ------
    ValueError
        Names the key.
    """
    if wear.law is None:
        raise ValueError("wear.law: the result journal.wear needs a law of wear")
    for place in journal.bearings:
        one = journal.at(place)
        if one.contact is None:
            raise ValueError(f"journal.contact: the result journal.wear needs it, at {place}")
        if one.shell is not None:
            raise ValueError("journal.shell: wear knows rigid shells")
        if one.geometry.shape.segments:
            kind = one.geometry.shape.kind
            raise ValueError(f"journal.geometry.shape = {kind!r}: wear knows cylindrical bores")
        if one.tilt and not shaft.bends_at(place):
            raise ValueError("journal.tilt: wear knows the tilt of a shaft with a beam alone")
        if one.tilt and wear.across == 1:
            raise ValueError("wear.across = 1 is not allowed: > 1 for a shaft that tilts")
