"""Every public name has an example that is true; functions say what they take and give."""

import ast
import doctest
import inspect
import re
import textwrap
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


SECTIONS = re.compile(r"^(.+)\n-{3,}$", re.MULTILINE)


def sections(entry):
    """Parts of a docstring by their heads; what comes before is that of the empty one."""
    head, *rest = SECTIONS.split(inspect.getdoc(entry) or "")
    return {"": head} | dict(zip(rest[::2], rest[1::2]))


def own_raises(entry):
    """Whether a function raises an error itself."""
    tree = ast.parse(textwrap.dedent(inspect.getsource(entry)))
    return any(isinstance(node, ast.Raise) and node.exc is not None for node in ast.walk(tree))


def unsaid(name, entry):
    """What the docstring of a function leaves out."""
    parts, signature = sections(entry), inspect.signature(entry)
    said = parts.get("Parameters", "") + parts.get("Other Parameters", "")
    lines = [line.partition(" : ")[0] for line in said.splitlines() if not line.startswith(" ")]
    known = {one.strip().lstrip("*") for line in lines for one in line.split(",")}
    missing = [parameter for parameter in signature.parameters if parameter not in known]
    if str(signature.return_annotation) != "None" and not {"Returns", "Yields"} & {*parts}:
        missing.append("Returns")
    if own_raises(entry) and "Raises" not in parts:
        missing.append("Raises")
    return (name, *missing) if missing else None


def functions():
    """Public functions, but those under a name of former versions, which name the present one."""
    for name, entry in public():
        if inspect.isfunction(entry) and "deprecated" not in (inspect.getdoc(entry) or "").lower():
            yield name, entry


def test_every_public_function_says_what_it_takes_gives_and_raises():
    assert [one for one in (unsaid(*entry) for entry in functions()) if one] == []


def test_what_a_docstring_leaves_out_is_seen():
    def mine(length: float, width: float) -> float:
        """An area.

        Parameters
        ----------
        length : float
            m.
        """
        if width < 0:
            raise ValueError("width")
        return length * width

    assert unsaid("mine", mine) == ("mine", "width", "Returns", "Raises")
