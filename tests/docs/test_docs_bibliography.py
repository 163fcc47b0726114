"""Authors with a year, and standards, that code and pages name are in the bibliography."""

import re
from functools import cache
from pathlib import Path

import loadflow

PACKAGE = Path(loadflow.__file__).parent
ROOT = PACKAGE.parent
PAGE = ROOT / "docs" / "bibliography.md"
CITED = re.compile(
    r"([A-ZÄÖÜ][\w'-]+)(?: et al\.)?,?\s+\(?((?:1[89]|20)\d\d)\b(?![\d.,]*\d? ?[a-zµN°/])"
)
STANDARD = re.compile(r"\b(ISO(?:/TS)?|DIN|IEC|VDI) (\d{2,6})(?:-\d+)?\b")


def sources():
    """Files of the package and pages for readers, the bibliography left out."""
    found = [path for ending in ("*.py", "*.toml", "*.md") for path in PACKAGE.rglob(ending)]
    return [*found, *(set((ROOT / "docs").glob("*.md")) - {PAGE}), ROOT / "README.md"]


@cache
def texts():
    return {path: path.read_text(encoding="utf-8") for path in sources()}


@cache
def entries():
    """Entries of the bibliography, a text each."""
    return re.findall(r"^- (.*(?:\n  .*)*)", PAGE.read_text(encoding="utf-8"), re.MULTILINE)


def is_there(name, year):
    """Whether one entry has that name and that year; Siegel-Tukey are two names."""
    return any(year in entry and all(n in entry for n in name.split("-")) for entry in entries())


def missing(text):
    return {f"{name} {year}" for name, year in CITED.findall(text) if not is_there(name, year)}


def test_every_author_with_a_year_is_in_the_bibliography():
    found = {str(path.relative_to(ROOT)): missing(text) for path, text in texts().items()}
    assert {path: names for path, names in found.items() if names} == {}


def test_every_standard_is_in_the_bibliography():
    page = " ".join(PAGE.read_text(encoding="utf-8").split())
    cited = {f"{body} {number}" for t in texts().values() for body, number in STANDARD.findall(t)}
    assert len(cited) > 8
    assert {one for one in cited if one not in page} == set()


def test_a_source_that_is_not_there_is_seen():
    assert missing("as in [Nobody 1999] and [Ritzer 2018]") == {"Nobody 1999"}


def test_every_entry_has_a_key_of_its_own():
    keys = re.findall(r"^- \*\*\[(.+?)\]\*\*", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(keys) > 60
    assert len(keys) == len(set(keys))
