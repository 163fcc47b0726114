"""Every public name has an example in its docstring, and all of them are true."""

import ast
import doctest
import inspect
from importlib import import_module
from pathlib import Path

import pytest

import loadflow

ROOT = Path(loadflow.__file__).parent


def module_name(path):
    parts = path.relative_to(ROOT.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def with_examples():
    """Modules in whose text an example stands."""
    paths = sorted(ROOT.rglob("*.py"))
    return [module_name(path) for path in paths if ">>>" in path.read_text(encoding="utf-8")]


@pytest.mark.parametrize("name", with_examples())
def test_the_examples_of_a_module_are_true(name):
    outcome = doctest.testmod(import_module(name))
    assert outcome.attempted > 0
    assert outcome.failed == 0


def test_an_example_that_is_wrong_is_seen():
    """The runner must be able to fail: a sum that is not so."""
    wrong = doctest.DocTestParser().get_doctest(">>> 1 + 1\n3\n", {}, "wrong", None, 0)
    assert doctest.DocTestRunner(verbose=False).run(wrong, out=lambda text: None).failed == 1


def public():
    """Functions and classes that rooms offer by name: those of the stubs of lazy loading."""
    for stub in sorted(ROOT.rglob("__init__.pyi")):
        room = module_name(stub)
        for node in ast.parse(stub.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ImportFrom):
                for alias in node.names:
                    entry = getattr(import_module(room), alias.name)
                    if inspect.isfunction(entry) or inspect.isclass(entry):
                        yield (
                            f"{entry.__module__.removeprefix('loadflow.')}.{entry.__name__}",
                            entry,
                        )


def without_example():
    return {name for name, entry in public() if ">>>" not in (inspect.getdoc(entry) or "")}


def test_every_public_name_has_an_example():
    assert without_example() == set()


def test_a_name_without_an_example_is_seen(monkeypatch):
    """The list must be able to grow: a class that says nothing."""
    entries = list(public())
    monkeypatch.setattr(
        f"{__name__}.public", lambda: [*entries, ("mine.Silent", type("S", (), {}))]
    )
    assert without_example() == {"mine.Silent"}
