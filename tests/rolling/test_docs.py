"""The examples in the docstrings are true."""

import doctest
import importlib

import pytest


@pytest.mark.parametrize(
    "module",
    [
        "rolling.bearings.four_point",
        "rolling.bearings.ball",
        "rolling.bearings.roller",
        "rolling.motion.rollers",
        "rolling.bearings.spherical",
        "rolling.bearings.crossed_roller",
        "rolling.bearings.three_row",
        "rolling.edge_contact",
        "rolling.rating.binning",
        "rolling.bearings.arrangements",
        "rolling.rating.modified_life",
        "tribology.hertz",
    ],
)
def test_examples_of_the_docstrings(module):
    outcome = doctest.testmod(importlib.import_module(f"loadflow.{module}"))
    assert outcome.attempted > 0
    assert outcome.failed == 0
