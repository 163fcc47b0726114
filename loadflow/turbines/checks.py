"""What the parts of a turbine share: types of fields, refusing a bad value by its name."""

from __future__ import annotations

from typing import Annotated, Any, get_args, get_origin, get_type_hints

import numpy as np
from annotated_types import Ge, Gt, Le, Lt
from numpy.typing import NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]
Positive = Annotated[float, Gt(0)]
NotNegative = Annotated[float, Ge(0)]
Bound = Gt | Ge | Le | Lt


def require(ok: bool, owner: str, name: str, value: object, allowed: str) -> None:
    """Refuse a value that is not allowed.

    Raises
    ------
    InputError
    """
    if not ok:
        raise InputError(f"{owner}: {name} = {value!r} is not allowed; it must be {allowed}")


def require_ranges(part: Any) -> None:
    """Refuse numbers of a part that are not finite, or outside the ranges that their types state.

    Raises
    ------
    InputError
    """
    for name, bounds in _ranges(type(part)).items():
        value = getattr(part, name)
        if value is None and name in _optional(type(part)):
            continue
        # an integer may have hundreds of digits, which isfinite does not take
        number = isinstance(value, int | float | np.number)
        finite = number and bool(abs(value) <= np.finfo(float).max)
        ok = finite and all(_holds(bound, value) for bound in bounds)
        allowed = " and ".join([*map(_words, bounds), "finite"])
        require(ok, type(part).__name__, name, value, allowed)


def _ranges(part: type) -> dict[str, tuple[Bound, ...]]:
    """Bounds of the numbers of a part, by name; none is left out that has any."""
    hints = get_type_hints(part, include_extras=True)
    inner = {name: [hint, *get_args(hint)] for name, hint in hints.items()}
    return {
        name: next(h for h in kinds if get_origin(h) is Annotated).__metadata__
        for name, kinds in inner.items()
        if any(get_origin(h) is Annotated for h in kinds)
    }


def _optional(part: type) -> set[str]:
    """Names of the numbers that may be left out."""
    hints = get_type_hints(part, include_extras=True)
    return {name for name, hint in hints.items() if type(None) in get_args(hint)}


def _holds(bound: Bound, value: float) -> bool:
    match bound:
        case Gt(gt=limit):
            return bool(value > limit)  # type: ignore[operator]
        case Ge(ge=limit):
            return bool(value >= limit)  # type: ignore[operator]
        case Le(le=limit):
            return bool(value <= limit)  # type: ignore[operator]
        case Lt(lt=limit):
            return bool(value < limit)  # type: ignore[operator]


def _words(bound: Bound) -> str:
    match bound:
        case Gt(gt=limit):
            return f"> {limit}"
        case Ge(ge=limit):
            return f">= {limit}"
        case Le(le=limit):
            return f"<= {limit}"
        case Lt(lt=limit):
            return f"< {limit}"
