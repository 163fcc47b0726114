"""Checks of the annotated fields of option dataclasses."""

from __future__ import annotations

import difflib
import sys
from collections.abc import Iterable
from functools import cache
from typing import Any, get_args, get_type_hints

import annotated_types as at

from loadflow.errors import InputError
from loadflow.quantities import CELSIUS


def require(condition: bool, name: str, value: object, allowed: str) -> None:
    """Raise an `InputError` that names field, value and allowed range unless `condition` holds."""
    if not condition:
        raise InputError(f"{name} = {value!r} is not allowed: {allowed}")


def check_fields(instance: Any) -> None:
    """Check every annotated field of a dataclass against its range.

    Parameters
    ----------
    instance : dataclass instance
        Fields ``Annotated[T, annotated_types.Gt(...), ...]``; a ``None`` is let pass where the
        field is optional.

    Raises
    ------
    InputError
        Naming the field, its value and the range.
    """
    kind: Any = type(instance)
    for name, bounds in _bounds_of(kind).items():
        value = getattr(instance, name)
        if value is None:
            continue
        if not isinstance(value, (int, float)) or not abs(value) <= sys.float_info.max:
            raise InputError(f"{name}: must be a finite number, got {value!r}")
        for bound in bounds:
            if not _holds(bound, value):
                more = in_kelvin(name, value, getattr(bound, "gt", getattr(bound, "ge", 0.0)))
                raise InputError(f"{name}: must be {_words(bound)}, got {value!r}{more}")


def in_kelvin(name: str, value: Any, lowest: Any) -> str:
    """Say what a temperature below the `lowest` is if it is meant in °C; empty for anything else.

    Examples
    --------
    >>> in_kelvin("inlet_temperature", 45.0, 200)
    '; temperatures are in K: 45 °C is 318.15 K'
    """
    numbers = isinstance(value, (int, float)) and isinstance(lowest, (int, float))
    if not (numbers and name.endswith("temperature") and -CELSIUS < value < lowest > _COLDEST):
        return ""
    return f"; temperatures are in K: {value:g} °C is {value + CELSIUS:g} K"


_COLDEST = 100.0  # K: what may be below is a difference of temperatures


@cache
def _bounds_of(kind: type) -> dict[str, list[Any]]:
    """Bounds of the fields of a class that have some: to read its annotations takes a while."""
    hints = get_type_hints(kind, include_extras=True)
    found = {name: _bounds(hint) for name, hint in hints.items()}
    return {name: bounds for name, bounds in found.items() if bounds}


def _bounds(hint: Any) -> list[Any]:
    """All bounds of an annotation, also inside an optional."""
    found = [m for m in getattr(hint, "__metadata__", ()) if isinstance(m, _KINDS)]
    for inner in get_args(hint):
        found += _bounds(inner)
    return found


_KINDS = (at.Gt, at.Ge, at.Lt, at.Le)


def _holds(bound: Any, value: float) -> bool:
    """Whether `value` keeps `bound`."""
    if isinstance(bound, at.Gt):
        return bool(value > bound.gt)  # type: ignore[operator]
    if isinstance(bound, at.Ge):
        return bool(value >= bound.ge)  # type: ignore[operator]
    if isinstance(bound, at.Lt):
        return bool(value < bound.lt)  # type: ignore[operator]
    return bool(value <= bound.le)


def _words(bound: Any) -> str:
    """The bound in words."""
    signs = {at.Gt: (">", "gt"), at.Ge: ("≥", "ge"), at.Lt: ("<", "lt"), at.Le: ("≤", "le")}
    sign, attribute = signs[type(bound)]
    return f"{sign} {getattr(bound, attribute):g}"


def check_choice(instance: Any, name: str, allowed: tuple[str, ...]) -> None:
    """Raise an InputError unless field `name` is one of `allowed`."""
    check_one_of(name, getattr(instance, name), allowed)


def check_one_of(name: str, value: object, allowed: Iterable[str]) -> None:
    """Raise an InputError unless the argument called `name` is one of `allowed`."""
    known = [*allowed]
    if value not in known:
        raise InputError(f"{name}: {not_one_of(value, known)}")


LARGEST_INTEGER = 2**63 - 1
"""Largest that a file of results can hold."""

LARGEST = 1e30
"""Largest magnitude of a value in SI units: its tenth power is still a number."""


def shown(value: Any) -> str:
    """Return a value as it stands in a message: not all of a number of 400 digits."""
    if isinstance(value, int) and abs(value) > LARGEST_INTEGER:
        return f"an integer of {value.bit_length()} bits"
    text = repr(value)
    return text if len(text) <= 200 else f"{text[:200]}…"


def unknown_key(name: str, known: Iterable[str]) -> str:
    """Say that a key is unknown, which one may be meant, and which are known there."""
    names = sorted(known)
    return f"unknown key{meant(name, names)}" + (
        f"; known here: {', '.join(names)}" if names else ""
    )


def meant(name: str, known: Iterable[str]) -> str:
    """Say which of some names may be meant by one that is none of them; empty where none is near.

    Examples
    --------
    >>> meant("two-sferical", ["two-spherical", "four-point"])
    '; did you mean two-spherical?'
    >>> meant("VG320", ["iso-vg-68", "mineral-vg-320", "pao-vg-320"])
    '; did you mean mineral-vg-320 or pao-vg-320?'
    """
    names = [*known]
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.6)
    part = _letters(name)
    if not near and len(part) >= _TELLING:
        near = [one for one in names if part in _letters(one)]
    return f"; did you mean {' or '.join(near[:3])}?" if near else ""


_TELLING = 4  # letters and digits of a part of a name that may stand for it


def _letters(name: str) -> str:
    """Letters and digits of a name, small: how it is known, however it is written."""
    return "".join(filter(str.isalnum, name)).lower()


def not_one_of(value: object, allowed: Iterable[str]) -> str:
    """Say that a value is none of those allowed, and which one may be meant.

    Examples
    --------
    >>> not_one_of("iso-vg-86", ["iso-vg-46", "iso-vg-68"])
    "must be one of iso-vg-46, iso-vg-68, got 'iso-vg-86'; did you mean iso-vg-68?"
    >>> not_one_of("oil", ["oil, filtered", "grease"])
    "must be one of 'oil, filtered', grease, got 'oil'"
    """
    known = [*allowed]
    near = meant(value, known) if isinstance(value, str) else ""
    return f"must be one of {_listed(known)}, got {value!r}{near}"


def none_such(what: str, names: Iterable[str], known: Iterable[str]) -> str:
    """Say that there is nothing of some names, which one may be meant, and which there are.

    Examples
    --------
    >>> none_such("list", ["turbine"], ["turbines", "oils"])
    "no list 'turbine'; did you mean turbines? There are turbines, oils"
    >>> none_such("stage", ["x"], ["journal", "journal, transient"])
    "no stage 'x'; there are journal, 'journal, transient'"
    """
    there, asked = [*known], [*names]
    near = "".join(dict.fromkeys(meant(one, there) for one in asked))
    told = ", ".join(map(repr, asked))
    return f"no {what} {told}{near}{' There' if near else '; there'} are {_listed(there)}"


def _listed(names: Iterable[str]) -> str:
    """Names side by side; in quotes where they have commas of their own."""
    return ", ".join(repr(one) if "," in one else one for one in names)
