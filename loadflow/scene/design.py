"""What of a bearing may vary in a design, between which values, and what the design must hold."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, Field, field_validator, model_validator

from loadflow.scene.section import Section


class Variation(Section, BaseModel):
    """Values that a key may take: all from `low` to `high`, or one of `values`.

    Attributes
    ----------
    low, high : float, optional
        Ends of a range, in the unit of the key.
    values : list, optional
        Numbers, names or tables, such as shapes of a bore.

    Examples
    --------
    >>> Variation.model_validate([0.8, 1.2])
    Variation(low=0.8, high=1.2, values=None)
    """

    low: float | None = None
    high: float | None = None
    values: Annotated[list[Any], Field(min_length=2, max_length=64)] | None = None

    @model_validator(mode="before")
    @classmethod
    def _of_two_ends(cls, data: Any) -> Any:
        if isinstance(data, list | tuple) and len(data) == 2:
            return {"low": data[0], "high": data[1]}
        return data

    @model_validator(mode="after")
    def _one_of_both(self) -> Self:
        if self.values is not None:
            if self.low is not None or self.high is not None:
                raise ValueError("values: takes the place of low and high; leave them out")
        elif self.low is None or self.high is None:
            raise ValueError("must be [low, high], or a table with values")
        elif not self.low < self.high:
            raise ValueError(f"low = {self.low:g} must be < high = {self.high:g}")
        return self


class Crowning(Section, BaseModel):
    """A search for the best crown of journal bearings alone, in place of that of all keys.

    Attributes
    ----------
    aim : {"minimum_film", "maximum_pressure"}
        What is to be largest, or least, of the worst load.
    largest_height : float, optional
        m; the radial clearance if left out.
    exponent : float
        2 is a parabola, 1 a cone.
    """

    aim: Literal["minimum_film", "maximum_pressure"] = "minimum_film"
    largest_height: Annotated[float, Field(gt=0)] | None = None
    exponent: Annotated[float, Field(ge=1)] = 2.0


class Design(Section, BaseModel):
    """A search for the best bearing of a candidate: what may vary, and how long to look.

    Attributes
    ----------
    candidate : str, optional
        Which candidate; the scene's own bearings, or the first candidate, if left out.
    keys : dict
        By key of its bearings, the values that it may take: ``geometry.diameter`` of the bearings
        at all places, ``N.geometry.diameter`` of that at N, ``friction.lubricant`` of the section.
        Left out: the main measures of its kind about those that it has.
    margin : float
        Factor by which the loads must be able to grow until the first limit of the scene.
    maps : list of pairs of keys
        What to draw maps over, at most six; the first two keys if left out.
    sweep : int
        Designs that are spread over all keys at first.
    levels : int
        Points of the front of friction energy against margin that are optimised, the first at
        `margin`.
    generations, population : int
        Of the optimiser, at each level.
    cells : int
        Of a map, along each key.
    classes : int
        Classes of speed, and twice as many of load, that stand for the series.
    checks : int
        Designs that are at most run with the models that a plan would take, until one holds.
    seed : int
        Of the spread and of the optimiser.
    crown : Crowning, optional
        Search the crown of the journal bearings alone; of the rest `candidate` and `classes` count.
    """

    candidate: str | None = None
    keys: dict[str, Variation] = {}
    margin: Annotated[float, Field(ge=0.1, le=10)] = 1.0
    maps: Annotated[list[tuple[str, str]], Field(max_length=6)] = []
    sweep: Annotated[int, Field(ge=8, le=4096)] = 96
    levels: Annotated[int, Field(ge=1, le=12)] = 4
    generations: Annotated[int, Field(ge=1, le=200)] = 14
    population: Annotated[int, Field(ge=6, le=256)] = 20
    cells: Annotated[int, Field(ge=3, le=41)] = 13
    classes: Annotated[int, Field(ge=2, le=20)] = 5
    checks: Annotated[int, Field(ge=1, le=8)] = 5
    seed: Annotated[int, Field(ge=0)] = 0
    crown: Crowning | None = None

    def idle(self) -> Iterator[tuple[str, str]]:
        """Keys without effect beside the others, and why."""
        for name in type(self).model_fields if self.crown is not None else ():
            if name not in ("candidate", "classes", "crown"):
                yield name, "with design.crown the crown alone is searched"

    @field_validator("keys", mode="before")
    @classmethod
    def _flat(cls, keys: Any) -> Any:
        """Dotted keys that TOML has turned into tables within tables."""
        return dict(_flattened(keys)) if isinstance(keys, Mapping) else keys

    @model_validator(mode="after")
    def _maps_of_keys(self) -> Self:
        for pair in self.maps:
            for key in pair:
                if self.keys and key not in self.keys:
                    raise ValueError(f"maps: {key!r} is none of the keys {', '.join(self.keys)}")
            if pair[0] == pair[1]:
                raise ValueError(f"maps: {pair[0]!r} twice in one map")
        return self


def _flattened(keys: Mapping[str, Any], above: str = "") -> Iterator[tuple[str, Any]]:
    for name, part in keys.items():
        key = f"{above}{name}"
        if isinstance(part, Mapping) and not {"low", "high", "values"} & set(part):
            yield from _flattened(part, f"{key}.")
        else:
            yield key, part
