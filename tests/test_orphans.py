"""Each public function and class has a caller in the package, or a page that says its use."""

import ast
import re
from pathlib import Path

import loadflow

PACKAGE = Path(loadflow.__file__).parent
ROOT = PACKAGE.parent
WORD = re.compile(r"\w+")
FORMER = ("aliases.py", "former_names.py")
"""Names that users of earlier versions may still call."""
CALLED_BY_FRAMEWORK = ("command", "callback", "njit", "field_validator")


def public(tree):
    """Public functions and classes of a module that no framework calls by itself."""
    for node in tree.body:
        if isinstance(node, ast.FunctionDef | ast.ClassDef) and not node.name.startswith("_"):
            told = " ".join(ast.dump(part) for part in node.decorator_list)
            if not any(word in told for word in CALLED_BY_FRAMEWORK):
                yield node.name


def names_in(tree):
    """Names that a module uses, its own definitions and docstrings aside."""
    used = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Name):
            used.add(node.id)
        elif isinstance(node, ast.Attribute):
            used.add(node.attr)
        elif isinstance(node, ast.ImportFrom):
            used |= {alias.name for alias in node.names}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            if not node.value[:1].isspace() and len(node.value) < 200 and ":" in node.value:
                used |= {*WORD.findall(node.value)}  # a place such as package.module:OBJECT
            elif node.value.isidentifier():
                used.add(node.value)
    return used


def orphans(modules, pages):
    """Names by module that neither a module nor a page uses."""
    trees = {name: ast.parse(text) for name, text in modules.items()}
    uses = {name: names_in(tree) for name, tree in trees.items()}
    told = {*WORD.findall(" ".join(pages))}
    everywhere = set().union(*uses.values())
    return {
        f"{name}: {one}"
        for name, tree in trees.items()
        for one in public(tree)
        if one not in everywhere and one not in told
    }


def test_no_public_name_is_without_a_caller_and_a_page():
    modules = {
        path.relative_to(PACKAGE).as_posix(): path.read_text(encoding="utf-8")
        for path in PACKAGE.rglob("*.py")
        if path.name not in FORMER
    }
    pages = [path.read_text(encoding="utf-8") for path in (ROOT / "docs").glob("*.md")]
    pages.append((ROOT / "README.md").read_text(encoding="utf-8"))
    assert orphans(modules, pages) == set()


def test_an_orphan_is_found():
    modules = {
        "one.py": "def used(): ...\ndef told(): ...\ndef lost():\n    '''Not `lost`.'''\n",
        "two.py": "from one import used\n",
    }
    assert orphans(modules, ["`told`"]) == {"one.py: lost"}
