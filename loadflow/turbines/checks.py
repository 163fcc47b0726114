"""What the parts of a turbine share: types of fields, refusing a bad value by its name."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]
Positive = Annotated[float, Gt(0)]
NotNegative = Annotated[float, Ge(0)]


def require(ok: bool, owner: str, name: str, value: object, allowed: str) -> None:
    """Refuse a value that is not allowed.

    Raises
    ------
    InputError
    """
    if not ok:
        raise InputError(f"{owner}: {name} = {value!r} is not allowed; it must be {allowed}")


def require_positive(part: object, *names: str) -> None:
    """Refuse fields of a part that are not positive and finite."""
    for name in names:
        value = getattr(part, name)
        require(
            bool(np.isfinite(value) and value > 0),
            type(part).__name__,
            name,
            value,
            "positive and finite",
        )


def require_not_negative(part: object, *names: str) -> None:
    """Refuse fields of a part that are negative or not finite."""
    for name in names:
        value = getattr(part, name)
        fits = bool(np.isfinite(value) and value >= 0)
        require(fits, type(part).__name__, name, value, ">= 0 and finite")
