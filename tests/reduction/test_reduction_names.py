"""The public names of the room."""

import pkgutil

import loadflow.reduction as room

MODULES = [f"loadflow.reduction.{m.name}" for m in pkgutil.iter_modules(room.__path__)]


def test_every_public_name_loads():
    assert all(hasattr(room, name) for name in room.__all__)


def test_no_module_has_the_name_of_a_public_function():
    """It would shadow the function once it is imported."""
    assert not {name.rpartition(".")[2] for name in MODULES} & set(room.__all__)
