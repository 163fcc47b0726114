"""Each public function and class is reached from where a user enters.

Users enter by the command line, a script of `pipelines/`, a notebook, or the code of a page that
tests run (`test_docs_site.py`, `test_docs_pages.py`), where the solvers are used as a library. What
only prose, tests, benchmarks or the validation name is not reached.
"""

import ast
import json
import re
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest
from reach import Module, Package
from taught_pages import TAUGHT

import loadflow

FOLDER = Path(loadflow.__file__).parent
ROOT = FOLDER.parent
COMMAND_LINE = ("loadflow.cli", "main")
PAGES = [ROOT / "README.md", *TAUGHT]
FORMER = ("aliases", "former_names")
"""Modules of names that users of earlier versions may still call: nothing else is excepted."""
TABLES = ("checks", "checks_of_files")
"""What `loadflow validate` asks of each of its tables, which it imports by their names."""


@cache
def package():
    return Package.at(FOLDER)


def scripts():
    """Code that users run or are taught."""
    for path in (ROOT / "pipelines").glob("*.py"):
        yield path.read_text(encoding="utf-8")
    for path in (ROOT / "notebooks").glob("*.ipynb"):
        cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
        code = [line for c in cells if c["cell_type"] == "code" for line in (*c["source"], "\n")]
        yield "".join(line for line in code if not line.startswith("%"))
    for page in PAGES:
        yield from re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)


@cache
def reached():
    """Places that users reach, and those that the validation reaches beyond them."""
    by_users = package().reached({COMMAND_LINE}) | package().reached_by(scripts())
    tables = [name for name in package().modules if name.startswith("loadflow.validation.")]
    asked = {(name, check) for name in tables for check in TABLES}
    return by_users, package().reached(asked) - by_users


@cache
def asked():
    """Names that users ask of an object: in code that they reach, in scripts and templates."""
    nodes = (node for text in scripts() for node in ast.walk(ast.parse(text)))
    in_scripts = {node.attr for node in nodes if isinstance(node, ast.Attribute)}
    pages = (FOLDER / "report" / "templates").glob("*.html")
    in_pages = {w for page in pages for w in re.findall(r"\w+", page.read_text(encoding="utf-8"))}
    return package().fields_asked(reached()[0]) | in_scripts | in_pages


def is_of_another_package(module, cls, method):
    """Whether a base of a class that is not ours has the method: it is called from there."""
    bases = getattr(import_module(module), cls).__mro__
    return any(method in vars(b) for b in bases if not b.__module__.startswith("loadflow"))


def lost(found, modules):
    """Public names of modules that are not among the places found."""
    return {
        f"{module.name}: {name}"
        for module in modules
        for name in module.public
        if (module.name, name) not in found
    }


def test_every_public_name_is_reached_by_a_user():
    modules = [m for m in package().modules.values() if m.name.rpartition(".")[2] not in FORMER]
    rooms = [m for m in modules if not m.name.startswith("loadflow.validation")]
    assert lost(reached()[0], rooms) == set()


def test_every_method_of_a_class_that_is_reached_is_asked_for():
    methods = {
        (module.name, cls, name)
        for module in package().modules.values()
        if module.name.rpartition(".")[2] not in FORMER
        for cls, name in module.methods
        if (module.name, cls) in reached()[0] and name not in asked()
    }
    assert {one for one in methods if not is_of_another_package(*one)} == set()


def test_every_name_of_the_validation_is_reached_by_one_of_its_tables():
    every = set().union(*reached())
    inside = [m for n, m in package().modules.items() if n.startswith("loadflow.validation")]
    assert lost(every, inside) == set()


def test_commands_and_stages_are_reached_and_a_table_is_not_by_users():
    by_users, by_tables = reached()
    assert ("loadflow.cli.comparing", "compare") in by_users
    assert ("loadflow.stages.journal", "film") in by_users
    assert ("loadflow.journal.models.grid", "orbit") in by_users
    assert ("loadflow.validation.journal", "checks") in by_tables


MAIN = "from package.other import used\n\ndef main():\n    used()\n"
REACHED = {
    "called": (MAIN, "def used(): ...\n"),
    "inside another": (
        "def main():\n    from package import other\n    other.used()\n",
        "def used(): ...\n",
    ),
    "by its place": (
        'PLACES = ["package.other:used"]\ndef main():\n    PLACES\n',
        "def used(): ...\n",
    ),
    "by a formatted place": (
        'ROOM = "package.other"\ndef main():\n    f"{ROOM}:used"\n',
        "def used(): ...\n",
    ),
    "of a module that is handed on": (
        "from package import other\n\ndef main():\n    for one in (other,):\n        one.used()\n",
        "def used(): ...\n",
    ),
    "registered": (
        "from package.other import app\n\ndef main():\n    app()\n",
        "app = make()\n\n@app.command()\ndef used(): ...\n",
    ),
    "by what it is called from": (MAIN, "def used():\n    helper()\n\ndef helper(): ...\n"),
}
NOT_REACHED = {
    "told": ('def main():\n    """Calls `used`."""\n', "def used(): ...\n"),
    "a variable of its name": ("def main(used):\n    return used\n", "def used(): ...\n"),
    "a field of its name": ("def main(made):\n    return made.used\n", "def used(): ...\n"),
    "a text of its name": ('def main():\n    return "used"\n', "def used(): ...\n"),
    "another of its name": (
        "def main():\n    used()\n\ndef used(): ...\n",
        "def used(): ...\n",
    ),
    "by what nobody calls": (
        "from package.other import used\n\ndef main(): ...\n\ndef alone():\n    used()\n",
        "def used(): ...\n",
    ),
    "imported alone": (
        "from package.other import used\n\ndef main(): ...\n",
        "def used(): ...\n",
    ),
}


def lost_of(main, other):
    texts = {"package": "", "package.cli": main, "package.other": other}
    made = {name: Module(name, ast.parse(text), name == "package") for name, text in texts.items()}
    found = Package(made).reached({("package.cli", "main")})
    return lost(found, [made["package.other"]])


@pytest.mark.parametrize("case", REACHED)
def test_what_is_called_is_reached(case):
    assert lost_of(*REACHED[case]) == set()


@pytest.mark.parametrize("case", NOT_REACHED)
def test_what_is_only_named_is_not_reached(case):
    assert lost_of(*NOT_REACHED[case]) == {"package.other: used"}


def test_a_name_of_a_room_is_that_of_the_module_it_comes_from():
    texts = {"package": "", "package.room": "", "package.room.inside": "def used(): ...\n"}
    made = {
        name: Module(name, ast.parse(text), name != "package.room.inside")
        for name, text in texts.items()
    }
    stubs = {"package.room": {"used": ("package.room.inside", "used")}}
    found = Package(made, stubs).reached_by(["from package.room import used\nused()\n"])
    assert ("package.room.inside", "used") in found


def test_a_method_that_nobody_asks_for_is_seen():
    text = "def main():\n    Made().asked()\n\n"
    text += "class Made:\n    def asked(self): ...\n    def lost(self): ...\n"
    made = Module("package", ast.parse(text), True)
    whole = Package({"package": made})
    fields = whole.fields_asked(whole.reached({("package", "main")}))
    assert [name for _, name in made.methods if name not in fields] == ["lost"]
