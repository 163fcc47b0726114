"""Former names of public keywords and attributes, which keep working for one version and say so."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import wraps
from operator import attrgetter
from typing import Any, TypeVar

Class = TypeVar("Class", bound=type)


def renamed(**former: str) -> Callable[[Class], Class]:
    """Class decorator: the keywords and attributes named still work, with a warning.

    Parameters
    ----------
    **former : str
        Present name of each former one.

    Warns
    -----
    DeprecationWarning
        A former name is used.

    Examples
    --------
    >>> from dataclasses import dataclass
    >>> @renamed(size="length")
    ... @dataclass(frozen=True)
    ... class Rod:
    ...     length: float
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     rod = Rod(size=2.0)
    >>> rod, str(told[0].message)
    (Rod(length=2.0), 'Rod: size is now length')
    """

    def decorate(cls: Class) -> Class:
        initialise = cls.__init__  # type: ignore[misc]

        @wraps(initialise)
        def __init__(self: Any, *arguments: Any, **keywords: Any) -> None:
            for old, new in former.items():
                if old in keywords:
                    _warn(cls, old, new)
                    keywords[new] = keywords.pop(old)
            initialise(self, *arguments, **keywords)

        cls.__init__ = __init__  # type: ignore[misc]
        for old, new in former.items():
            setattr(cls, old, renamed_attribute(old, new))
        return cls

    return decorate


def renamed_attribute(old: str, new: str) -> property:
    """Property under a former name, of a class that no keyword of that name builds.

    Parameters
    ----------
    old, new : str
        Former and present name; the present one may be an attribute of an attribute.

    Examples
    --------
    >>> class Plane:
    ...     real = renamed_attribute("real", "point.real")
    ...     point = 2.0 + 1.0j
    >>> with warnings.catch_warnings(record=True) as told:
    ...     warnings.simplefilter("always")
    ...     value = Plane().real
    >>> value, str(told[0].message)
    (2.0, 'Plane: real is now point.real')
    """

    def get(self: Any) -> Any:
        _warn(type(self), old, new)
        return attrgetter(new)(self)

    return property(get, doc=f"Former name of `{new}`; deprecated.")


def _warn(cls: type, old: str, new: str) -> None:
    said = f"{cls.__name__}: {old} is now {new}"
    warnings.warn(said, DeprecationWarning, stacklevel=3)  # at the line with it
