"""Every public function of the room shows what it does."""

import importlib
import inspect
import pkgutil

import pytest

from loadflow import tribology

MODULES = [m.name for m in pkgutil.iter_modules(tribology.__path__) if not m.name.startswith("_")]


@pytest.mark.parametrize("name", MODULES)
def test_every_public_function_and_class_has_an_example(name):
    module = importlib.import_module(f"loadflow.tribology.{name}")
    for key, entry in vars(module).items():
        described = inspect.isfunction(entry) or inspect.isclass(entry)
        if key.startswith("_") or not described or entry.__module__ != module.__name__:
            continue
        # those of a protocol are in the classes that keep it, those of a result with its function
        if key not in ("WearLaw", "PowerLaw", "PointContact", "LineContact"):
            assert ">>>" in (inspect.getdoc(entry) or ""), key
