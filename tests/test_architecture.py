"""Imports run downwards through the rooms, without circles, and private names stay at home.

Every import counts: type hints under ``TYPE_CHECKING`` and imports inside functions, too. The known
faults may only become fewer: one that is listed but gone fails its test, so that the list shrinks.
"""

from __future__ import annotations

import ast
import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import loadflow

ROOT = Path(loadflow.__file__).parent

FLOORS = (
    ("__main__",),
    ("cli",),
    ("running",),
    ("planning",),
    ("validation", "studies"),
    ("stages",),
    ("scene",),
    ("report",),
    ("journal", "rolling"),
    ("wind", "rotor", "shaft", "seeds", "reduction", "readers"),
    ("cube", "turbines", "tribology"),
    ("numerics", "plots"),
    ("storage", "schemas", "former_names", "verdict", "quantities"),
    ("errors", "data"),
)
"""Rooms from top to bottom. Those of one floor may use each other, if none does in a circle."""

UPWARDS: set[str] = set()
"""Known imports from a lower floor into a higher one."""

CIRCLES: set[str] = set()
"""Known groups of modules that import each other in a circle."""

ROOM_CIRCLES: set[str] = set()
"""Known groups of rooms that do."""

PRIVATE: set[str] = set()
"""Known uses of a private name in another room than its own."""

Graph = dict[str, set[str]]


def test_every_room_has_its_floor():
    assert {room(name) for name in modules()} - {one for floor in FLOORS for one in floor} == {""}


def test_imports_run_downwards():
    found = {
        f"{name} -> {target}"
        for name, targets in imports().items()
        for target, _ in targets
        if room(name) and floor(target) < floor(name)
    }
    assert found == UPWARDS


def test_no_modules_import_each_other_in_a_circle():
    graph = {
        name: {target for target, _ in found} & set(modules()) - {name, "loadflow"}
        for name, found in imports().items()
    }
    assert circles(graph) == CIRCLES


def test_no_rooms_import_each_other_in_a_circle():
    graph: Graph = {}
    for name, found in imports().items():
        graph.setdefault(room(name), set()).update(room(target) for target, _ in found)
    graph.pop("")
    assert circles({name: found - {name, ""} for name, found in graph.items()}) == ROOM_CIRCLES


def test_no_folders_beside_each_other_import_each_other_in_a_circle():
    """Modules beside those folders, not in one of them, may stand above and below."""
    graph: Graph = {}
    for name, found in imports().items():
        for target, _ in found:
            if beside := folders_that_part(name, target):
                graph.setdefault(beside[0], set()).add(beside[1])
                graph.setdefault(beside[1], set())
    assert circles(graph) == set()


def test_folders_part_where_they_lie_side_by_side_in_one_room():
    film = "loadflow.journal.film"
    sides = f"{film}.heat", f"{film}.gap"
    assert folders_that_part(f"{sides[0]}.balance", f"{sides[1]}.warm") == sides
    assert folders_that_part(f"{film}.heat.balance", f"{film}.film") == ()
    assert folders_that_part(f"{film}.film", "loadflow.rolling.rings.beam") == ()


def test_no_private_name_is_used_in_another_room():
    found = {
        f"{name}: {target}.{what}".rstrip(".")
        for name, targets in imports().items()
        for target, what in targets
        if room(name) != room(target) and any(map(is_private, [*target.split("."), what]))
    }
    assert found == PRIVATE


def test_a_circle_is_found_wherever_it_begins():
    graph = {"a": {"b"}, "b": {"c"}, "c": {"b", "d"}, "d": set(), "e": {"a"}}
    assert circles(graph) == {"b, c"}


def test_imports_of_hints_and_inside_functions_count(tmp_path):
    file = tmp_path / "sample.py"
    file.write_text(
        "if TYPE_CHECKING:\n    from loadflow.scene.scene import Scene\n"
        "def late():\n    from .near import thing\n",
        encoding="utf-8",
    )
    found = set(imports_of("loadflow.cube.sample", file))
    assert ("loadflow.scene.scene", "Scene") in found
    assert ("loadflow.cube.near", "thing") in found


@cache
def modules() -> dict[str, Path]:
    """Modules of the package by their full name."""
    found = {}
    for path in sorted(ROOT.rglob("*.py")):
        parts = path.relative_to(ROOT.parent).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


@cache
def imports() -> dict[str, set[tuple[str, str]]]:
    """What each module imports of the package: (module, name), the name empty for a whole one."""
    return {name: set(imports_of(name, path)) for name, path in modules().items()}


def imports_of(module: str, path: Path) -> Iterator[tuple[str, str]]:
    """Imports of a module, and of the stub beside it that names what is loaded lazily."""
    package = module.split(".") if path.name == "__init__.py" else module.split(".")[:-1]
    for source in filter(Path.exists, (path, path.with_suffix(".pyi"))):
        for node in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Import):
                names = (alias.name for alias in node.names)
                yield from ((name, "") for name in names if name.split(".")[0] == "loadflow")
            elif isinstance(node, ast.ImportFrom):
                base = absolute(package, node)
                if base.split(".")[0] == "loadflow":
                    for alias in node.names:
                        whole = f"{base}.{alias.name}"
                        yield (whole, "") if whole in modules() else (base, alias.name)


def absolute(package: list[str], node: ast.ImportFrom) -> str:
    """Full name of the module that an import names, relative to `package` or not."""
    above = package[: len(package) - node.level + 1] if node.level else []
    return ".".join([*above, *filter(None, [node.module])])


def folder(module: str) -> list[str]:
    """Folder of a module, part by part."""
    parts = module.split(".")
    return parts if ROOT.joinpath(*parts[1:]).is_dir() else parts[:-1]


def folders_that_part(name: str, target: str) -> tuple[str, ...]:
    """The two folders side by side in one room in which two modules lie; none for others."""
    for depth, (here, there) in enumerate(zip(folder(name), folder(target), strict=False)):
        if here != there:
            both = (folder(name), folder(target))
            return tuple(".".join(parts[: depth + 1]) for parts in both) if depth > 1 else ()
    return ()


def room(module: str) -> str:
    """Second part of a module's name, empty for the package itself."""
    return module.split(".")[1] if "." in module else ""


def floor(module: str) -> int:
    """Number of the floor of a module, from the top; the package itself may be used by all."""
    return next((k for k, rooms in enumerate(FLOORS) if room(module) in rooms), len(FLOORS))


def is_private(name: str) -> bool:
    return name.startswith("_") and not name.startswith("__")


def circles(graph: Graph) -> set[str]:
    """Groups of nodes that reach each other, their names in order."""

    def reached(start: str) -> set[str]:
        found, todo = set(), [start]
        while todo:
            new = graph[todo.pop()] - found
            found |= new
            todo += new
        return found

    reach = {name: reached(name) for name in graph}
    groups = (
        sorted(other for other in reach[name] if name in reach[other])
        for name in graph
        if name in reach[name]
    )
    short = ([name.removeprefix("loadflow.") for name in group] for group in groups)
    return {", ".join(group) for group in short if len(group) > 1}


LONGEST = 450
"""Lines of a file."""

LONGER: set[str] = set()
"""Known longer files."""


def test_files_are_short():
    """A file is one concept; what is longer is two. Add none to the known ones."""
    found = {
        path.relative_to(ROOT).as_posix()
        for path in modules().values()
        if len(path.read_text(encoding="utf-8").splitlines()) > LONGEST
    }
    assert found - LONGER == set()


CALLED_BY_OTHERS = {
    "emit",
    "generic_resolve",
    "get_source_stamp",
    "handleError",
    "on_end",
    "on_start",
}
"""Methods that logging and numba call, by names that they chose."""


def test_no_name_is_defined_and_used_nowhere():
    repository = ROOT.parent
    folders = [
        repository / name for name in ("loadflow", "tests", "benchmarks", "pipelines", "docs")
    ]
    files = [f for folder in folders for f in folder.rglob("*") if f.suffix in SOURCES]
    words = Counter(re.findall(r"\w+", "\n".join(f.read_text(encoding="utf-8") for f in files)))
    unused = {name for name in defined() if words[name] == 1 and not name.startswith("__")}
    assert unused - CALLED_BY_OTHERS == set()


SOURCES = {".py", ".pyi", ".md", ".toml", ".html"}


def defined() -> Iterator[str]:
    """Functions, classes and methods of the package, and what modules assign."""
    for path in modules().values():
        tree = ast.parse(path.read_text(encoding="utf-8"))
        for node in ast.walk(tree):
            if isinstance(node, ast.FunctionDef | ast.ClassDef) and not is_validator(node):
                yield node.name
        for node in tree.body:
            targets = node.targets if isinstance(node, ast.Assign) else []
            yield from (target.id for target in targets if isinstance(target, ast.Name))


def is_validator(node: ast.FunctionDef | ast.ClassDef) -> bool:
    """Whether a decorator registers it, as those of pydantic, typer and numba do."""
    registers = ("validator", "command", "callback", "overload", "register", "infer")
    return any(word in ast.unparse(d) for d in node.decorator_list for word in registers)


CHOICE_IN_OWN_WORDS = re.compile(r"must be (?:one of|'[\w-]+' or|'[\w-]+', ')")


def test_a_wrong_choice_is_told_by_one_sentence():
    worded = {
        path.relative_to(ROOT).as_posix()
        for path in modules().values()
        if CHOICE_IN_OWN_WORDS.search(path.read_text(encoding="utf-8"))
    }
    # that sentence; pydantic's, which is said before the value is known; numbers, or an object
    assert worded == {
        "numerics/fields.py", "scene/section.py",
        "rolling/rating/modified_life.py", "rolling/bearings/base.py",
    }  # fmt: skip
