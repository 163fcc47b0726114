"""Files and names in the pages for those who take part exist; the glossary is the table."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

import loadflow
from loadflow.cli import app
from loadflow.cube.schema import CASE_COORDS, VARIABLES
from loadflow.quantities import FILM, ROLLING

PACKAGE = Path(loadflow.__file__).parent
ROOT = PACKAGE.parent
PAGES = ("docs/architecture.md", "docs/errata.md", "CONTRIBUTING.md")
SUFFIXES = (".py", ".pyi", ".md", ".toml", ".json")
# what pages name that is written by whoever follows them, or made by a run
YOURS = {'cavitation = {kind = "yours"}', "loadflow/validation/NAME.py"}


def text_of(page):
    return (ROOT / page).read_text(encoding="utf-8")


def code_of(page):
    """What stands between single backticks, outside of blocks."""
    prose = re.sub(r"```.*?```", "", text_of(page), flags=re.DOTALL)
    return {" ".join(part.split()) for part in re.findall(r"`([^`]+)`", prose)}


def found(path):
    """Whether a path of a page exists; a bare name like `_kernels.py` anywhere in the package."""
    if any((base / path).exists() for base in (PACKAGE, ROOT)):
        return True
    return "/" not in path and any(PACKAGE.rglob(path))


def names_in(file):
    """Names that a module defines, at any depth."""
    defined = set()
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            defined.add(node.name)
        elif isinstance(node, ast.Assign):
            defined |= {target.id for target in node.targets if isinstance(target, ast.Name)}
        elif isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
            defined.add(node.target.id)
    return defined


@cache
def words():
    """All words in the source of package and tests."""
    files = [*PACKAGE.rglob("*.py*"), *(ROOT / "tests").rglob("*.py"), ROOT / "pyproject.toml"]
    texts = (f.read_text(encoding="utf-8") for f in files if f.suffix in (*SUFFIXES,))
    return {word for text in texts for word in re.findall(r"\w+", text)}


@pytest.mark.parametrize("page", PAGES)
def test_the_files_of_a_page_exist(page):
    paths = {code for code in code_of(page) if code.endswith((*SUFFIXES, "/"))} - YOURS
    assert len(paths) > 5
    assert {path for path in paths if not found(path)} == set()


@pytest.mark.parametrize("page", PAGES)
def test_the_names_of_a_page_exist(page):
    names = {code for code in code_of(page) if re.fullmatch(r"[A-Za-z_]\w*", code)}
    assert len(names) > 5
    assert names - words() == set()


DOCS = [path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md")]
LINKED = ["README.md", "CONTRIBUTING.md", *DOCS]


@pytest.mark.parametrize("page", sorted(LINKED))
def test_the_links_of_a_page_lead_somewhere(page):
    links = re.findall(r"\]\(([^)#]+)\)", text_of(page))
    here = (ROOT / page).parent
    assert {link for link in links if "://" not in link and not (here / link).exists()} == set()


def located():
    """Rows of the tables whose last columns are a file of the package and a name in it."""
    rows = re.findall(r"^\|.*\| `([\w/]+\.py)` \| `(\w+)` \|$", text_of(PAGES[0]), re.MULTILINE)
    assert len(rows) > 60
    return rows


@pytest.mark.parametrize(("file", "name"), located())
def test_an_equation_or_a_step_is_where_the_page_says(file, name):
    assert name in names_in(PACKAGE / file)


def test_where_is_equation_x_has_forty_rows():
    table = text_of(PAGES[0]).split("## Where is equation X")[1]
    assert table.count("\n| ") >= 41


TABLES = {
    "Of a film": {n: (q.symbol, q.units, q.meaning) for n, q in FILM.items()},
    "Of a rolling bearing": {n: (q.symbol, q.units, q.meaning) for n, q in ROLLING.items()},
    "Of a load cube": {n: (v.units, v.long_name) for n, v in {**VARIABLES, **CASE_COORDS}.items()},
}
GLOSSARY = "docs/glossary.md"


def lines_of(title):
    """Rows that a table of the glossary has to have."""
    rows = TABLES[title].items()
    return [f"| `{name}` | {' | '.join(cell or '–' for cell in cells)} |" for name, cells in rows]


def rows_of(title):
    """Rows that a table of the glossary has."""
    section = text_of(GLOSSARY).split(f"### {title}\n")[1].split("\n#")[0]
    return [line for line in section.splitlines() if line.startswith("| `")]


@pytest.mark.parametrize("title", TABLES)
def test_the_glossary_has_the_quantities_of_the_tables(title):
    assert rows_of(title) == lines_of(title), "write anew: python tests/docs/test_docs_pages.py"


def write_glossary():
    """Bring the tables of the glossary up to what the package says."""
    page = text_of(GLOSSARY)
    for title in TABLES:
        page = page.replace("\n".join(rows_of(title)), "\n".join(lines_of(title)))
    (ROOT / GLOSSARY).write_text(page, encoding="utf-8")


def test_the_readme_lists_every_command():
    commands = {c.name or c.callback.__name__ for c in app.registered_commands}
    table = text_of("README.md").split("## Commands")[1].split("\n## ")[0]
    assert set(re.findall(r"`loadflow (\w[\w-]*)", table)) == commands


def test_the_readme_s_examples_run():
    blocks = re.findall(r"```python\n(.*?)```", text_of("README.md"), re.DOTALL)
    found = {}
    for block in blocks:
        exec(block, found)
    assert len(blocks) == 2
    assert found["state"].converged
    assert found["loads"].converged


if __name__ == "__main__":
    write_glossary()
