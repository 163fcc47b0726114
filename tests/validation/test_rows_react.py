"""Rows that claim evidence react to wrong arithmetic; what they are held to does not."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from loadflow import validation

PERTURBED = Path(__file__).with_name("perturbed.py")
WITHOUT_COMPILER = ("mixed",)  # laws that the films' compiled loops hold
TABLES = ("friction", "reduction", "rings", "seeds", "shaft", "vibration", "wind")
SLOW = ("film_charts", "rolling", "similarity", "thrust", "towers", "turbines")
ON_EXACT_FILMS = ("friction_rig",)  # the film on its pin closes to the last digits
COUNTED = {
    "friction": r"rollers loaded|^period, |^R_3, F = 2 kN|^τ_lim at|exponent 1$",
    "friction_rig": "^s₂ uneven by half, pin",
    "reduction": "classes for|kept of|cycles of range",
    "rolling": "ball in four-point contact|share of balls",
    "seeds": r", R_\d",
    "turbines": "IEA 15 MW: pitch, V = (9|10) m/s",
}
"""Numbers that no small error moves: those that count classes, balls, cycles or ranks, whole ones
(τ_lim in Pa), that of a linear law, a share that is none, and a pitch at its lowest."""


def moved(names, exact=(), **environment):
    """Rows of tables with the package's arithmetic off, that of some rooms aside, by table."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", str(PERTURBED), *names, *(f"-{room}" for room in exact)],
        capture_output=True, text=True, check=False, env=os.environ | environment,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(done.stdout)


def unmoved(name, rows):
    """Rows of a table that do not react as evidence must, with what is wrong."""
    stated = list(validation.all_checks(name))
    assert [row.name for row in stated] == [label for label, *_ in rows]
    for row, (label, expected, got) in zip(stated, rows, strict=True):
        if row.evidence == "consistency" or row.absent:
            continue
        if expected != float(row.expected):
            yield f"{label}: what it is held against is calculated by the package"
        if got == float(row.got) and not re.search(COUNTED.get(name, "$^"), label):
            yield f"{label}: nothing of the package is calculated"


def test_compiled_laws_react():
    for name, rows in moved(WITHOUT_COMPILER, NUMBA_DISABLE_JIT="1").items():
        assert [*unmoved(name, rows)] == []


def test_rows_react_to_wrong_arithmetic_and_what_they_are_held_to_does_not():
    assert {name: [*unmoved(name, rows)] for name, rows in moved(TABLES).items()} == {
        name: [] for name in TABLES
    }


@pytest.mark.slow
def test_rows_of_the_rig_react_where_its_film_stays():
    # laws of contact films are compiled by the motion of the rollers
    exact = ["loadflow.journal", "loadflow.tribology.contact_film"]
    found = moved(ON_EXACT_FILMS, exact=exact)
    assert {name: [*unmoved(name, rows)] for name, rows in found.items()} == {"friction_rig": []}


@pytest.mark.slow
def test_rows_of_more_tables_react():
    assert {name: [*unmoved(name, rows)] for name, rows in moved(SLOW).items()} == {
        name: [] for name in SLOW
    }


def test_a_number_against_itself_and_one_against_our_own_are_found(monkeypatch):
    def row(name, expected, got, **more):
        return validation.Check(name, "print", expected, got, 0.1, evidence="closed form", **more)

    stated = [row("constant", 2.5, 2.5), row("ours", 1.5, 1.6), row("held", 1.5, 1.6)]
    monkeypatch.setattr(validation, "all_checks", lambda name: iter(stated))
    rows = [["constant", 2.5, 2.5], ["ours", 1.51, 1.61], ["held", 1.5, 1.61]]
    assert [text.split(":")[0] for text in unmoved("wind", rows)] == ["constant", "ours"]
