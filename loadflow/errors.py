"""Errors that a user can act on; every message names the numbers it is about."""

from __future__ import annotations

from typing import Any


class LoadflowError(Exception):
    """Base of all errors that loadflow raises on purpose."""


class InputError(LoadflowError, ValueError):
    """Bad input: a scene, a file or an argument. The command line ends with exit code 2."""


class NewerVersionError(InputError):
    """Data on disk have a form that only a newer loadflow can read."""


class SolverError(LoadflowError, RuntimeError):
    """A model has no answer for sound input, or did not converge. Exit code 1."""


class ValidityWarning(UserWarning):
    """A model is used outside the range in which it holds; the message names the numbers."""


class FormerVersionWarning(UserWarning):
    """Data on disk have an older form; the message says what was brought up to date, and how."""


def in_a_line(message: Warning | str, *_: Any, **__: Any) -> str:
    """Words of a warning alone, without the line of code that warns: a `warnings.formatwarning`."""
    return f"warning: {message}\n"
