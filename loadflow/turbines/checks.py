"""What the parts of a turbine share: types of fields, refusing a bad value by its name."""

from __future__ import annotations

from typing import Annotated, Any, get_origin, get_type_hints

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]
Positive = Annotated[float, Gt(0)]
NotNegative = Annotated[float, Ge(0)]
Bound = Gt | Ge | Le


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
        # an integer may have hundreds of digits, which isfinite does not take
        number = isinstance(value, int | float | np.number)
        finite = number and bool(abs(value) <= np.finfo(float).max)
        ok = finite and all(_holds(bound, value) for bound in bounds)
        allowed = " and ".join([*map(_words, bounds), "finite"])
        require(ok, type(part).__name__, name, value, allowed)


def _ranges(part: type) -> dict[str, tuple[Bound, ...]]:
    """Bounds of the numbers of a part, by name; none is left out that has any."""
    hints = get_type_hints(part, include_extras=True)
    return {
        name: hint.__metadata__ for name, hint in hints.items() if get_origin(hint) is Annotated
    }


def _holds(bound: Bound, value: float) -> bool:
    match bound:
        case Gt(gt=limit):
            return bool(value > limit)  # type: ignore[operator]
        case Ge(ge=limit):
            return bool(value >= limit)  # type: ignore[operator]
        case Le(le=limit):
            return bool(value <= limit)  # type: ignore[operator]


def _words(bound: Bound) -> str:
    match bound:
        case Gt(gt=limit):
            return f"> {limit}"
        case Ge(ge=limit):
            return f">= {limit}"
        case Le(le=limit):
            return f"<= {limit}"
