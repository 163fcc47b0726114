"""Every public function of the room shows what it does, and what it shows is true."""

import doctest
import importlib
import inspect
import pkgutil

import pytest

from loadflow import tribology

MODULES = [m.name for m in pkgutil.iter_modules(tribology.__path__) if not m.name.startswith("_")]


@pytest.mark.parametrize("name", MODULES)
def test_examples_of_the_docstrings(name):
    outcome = doctest.testmod(importlib.import_module(f"loadflow.tribology.{name}"))
    assert outcome.failed == 0


def test_every_public_function_and_class_has_an_example():
    without = []
    for name in tribology.__all__:
        entry = getattr(tribology, name)
        shown = ">>>" in (inspect.getdoc(entry) or "")
        if not shown and (inspect.isfunction(entry) or inspect.isclass(entry)):
            without.append(name)
    assert without == ["WearLaw"]  # a protocol: its examples are those of the laws
