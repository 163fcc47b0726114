"""Kernels of effects that most films have none of, which are not compiled for those.

What stands for a shell that gives way all over, of a `ShelledFilm`, takes a third of the time of
compiling the loops that it stands in.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

from numba.extending import overload

from loadflow.journal.models.composed.film import ShelledFilm
from loadflow.numerics.linked import LINKED, contracted

# a call takes a film with asperities 3 % of its time
_OPTIONS: Any = contracted.keywords | LINKED | {"forceinline": True}
del _OPTIONS["cache"]  # with that of the kernel that calls it


def of_shell(nothing: Callable[..., Any]) -> Callable[[Callable[..., Any]], Any]:
    """Of a function of a `ShelledFilm`, called by kernels; `nothing` is it in all others.

    The film is its first argument.
    """
    return where(lambda kind: kind is ShelledFilm, nothing)


def where(
    has: Callable[[type], bool], nothing: Callable[..., Any]
) -> Callable[[Callable[..., Any]], Any]:
    """The same of a function whose first argument is of a type that `has` the effect."""

    def of(function: Callable[..., Any]) -> Any:
        @wraps(function)
        def called(*given: Any) -> Any:
            return function(*given)  # where nothing is compiled

        @overload(called, jit_options=_OPTIONS, strict=False)
        def chosen(first: Any, *others: Any) -> Callable[..., Any]:
            held = getattr(first, "held", first)
            return function if has(held.instance_class) else nothing

        return called

    return of
