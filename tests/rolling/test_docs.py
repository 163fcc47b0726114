"""The examples in the docstrings are true."""

import doctest
import importlib

import pytest


@pytest.mark.parametrize(
    "module",
    [
        "rolling.slewing",
        "rolling.ball",
        "rolling.roller",
        "rolling.roller_motion",
        "rolling.spherical",
        "rolling.slewing_rollers",
        "rolling.three_row",
        "rolling.roller_edges",
        "rolling.binning",
        "rolling.arrangements",
        "rolling.lubricated_life",
        "tribology.hertz",
    ],
)
def test_examples_of_the_docstrings(module):
    outcome = doctest.testmod(importlib.import_module(f"loadflow.{module}"))
    assert outcome.attempted > 0
    assert outcome.failed == 0
