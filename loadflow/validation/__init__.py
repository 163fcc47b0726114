"""Numbers of the sources beside our own.

Every module of this package has a function ``checks()`` that yields `Check` rows, each with what it
is held against; the command ``loadflow validate`` prints them and the tests assert them, so both
show the same numbers.
"""

from loadflow.validation.check import (
    EVIDENCE,
    OUTCOMES,
    Check,
    Evidence,
    all_checks,
    counts,
    evidence,
    names,
)

__all__ = [
    "EVIDENCE",
    "OUTCOMES",
    "Check",
    "Evidence",
    "all_checks",
    "counts",
    "evidence",
    "names",
]
