"""Printed tables of the sources beside our own numbers.

Every module of this package has a function ``checks()`` that yields `Check` rows; the command
``loadflow validate`` prints them and the tests assert them, so both show the same numbers.
"""

from loadflow.validation.check import Check, all_checks, names

__all__ = ["Check", "all_checks", "names"]
