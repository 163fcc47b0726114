"""The report as one HTML file that needs no other file and no network."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any, Protocol

from jinja2 import Environment, PackageLoader, select_autoescape
from matplotlib.figure import Figure

from loadflow.plots.style import to_png, to_svg
from loadflow.storage import write_text

ASSETS = Path(__file__).parent / "assets"
"""Styles and scripts of the pages, and uPlot with its licence, which draws the charts."""

LARGEST_SVG = 200_000
"""Characters of a figure that is not yet dense; a denser one becomes a picture of points."""


@dataclass(frozen=True)
class Table:
    """A table: a title, column heads and rows of text; `bad` holds the numbers of rows to mark.

    `fold` hides it until its title is clicked; `note` stands below it, and `left_out`: columns that
    it does not have, by why; more than `FEW` are hidden until they are asked for. `links` leads
    from row and column of a cell to a name within the page.

    Examples
    --------
    >>> from loadflow.report import Table
    >>> Table("Films", ["bearing", "h_min, µm"], [["N", "38"], ["N2", "4"]],
    ...     bad=frozenset({1})).rows[1]
    ['N2', '4']
    """

    title: str
    heads: list[str]
    rows: list[list[str]]
    bad: frozenset[int] = frozenset()
    fold: bool = False
    note: str = ""
    left_out: Mapping[str, Sequence[str]] = field(default_factory=dict)
    links: Mapping[tuple[int, int], str] = field(default_factory=dict)

    @property
    def words(self) -> frozenset[int]:
        """Numbers of the columns that hold words, not numbers."""
        return frozenset(
            k
            for k in range(len(self.heads))
            if any(len(row[k]) > _LONG or row[k][:1].isalpha() for row in self.rows)
        )


ZERO = "Zero in all cases"
"""Why a table has no column of a number."""

FEW = 3
"""Names of columns that are left out, which stand below a table in full."""

_STEM = 60  # characters of the name of a file
_UPRIGHT = 12  # columns on upright paper
_LONG = 24  # characters of a number with its unit


class Shown(Protocol):
    """What stands in a section as a figure: a `Picture`, or a `Chart` that the browser draws."""

    @property
    def caption(self) -> str:
        """What it shows."""

    @property
    def fold(self) -> bool:
        """Whether it is hidden until it is clicked."""

    @property
    def markup(self) -> str:
        """Its element of the page."""


@dataclass(frozen=True)
class Drawing:
    """An ``<svg>`` element with its caption.

    Examples
    --------
    >>> from loadflow.report import Drawing
    >>> Drawing("<svg></svg>", "an empty sketch").markup
    '<svg></svg>'
    """

    markup: str
    caption: str
    fold: bool = False


@dataclass(frozen=True)
class Picture:
    """A figure with its caption; `fold` hides it until it is clicked.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from loadflow.report import Picture
    >>> Picture(Figure(), "largest eccentricity of each case", fold=True).caption
    'largest eccentricity of each case'
    """

    figure: Figure
    caption: str
    fold: bool = False

    @property
    def markup(self) -> str:
        """The figure as an ``<svg>`` element, or as a picture of points where it is dense."""
        drawn = to_svg(self.figure)
        if len(drawn) <= LARGEST_SVG:
            return drawn.replace("<svg", f'<svg role="img" aria-label="{escape(self.caption)}"', 1)
        return f'<img src="{to_png(self.figure)}" alt="{escape(self.caption)}">'


@dataclass(frozen=True)
class Section:
    """A part of the page, shown in order: text, points, tables, short facts, pictures.

    Where there are `points`, sentences of which each stands alone, the text is the conclusion.

    Examples
    --------
    >>> from loadflow.report import Section, Table
    >>> Section("Films", "At rest.", [Table("Films", ["bearing"], [["N"]])]).tables[0].title
    'Films'
    """

    title: str
    text: str = ""
    tables: Sequence[Table] = field(default_factory=list)
    pictures: Sequence[Shown] = field(default_factory=list)
    facts: Mapping[str, str] = field(default_factory=dict)
    points: Sequence[str] = ()

    @property
    def anchor(self) -> str:
        """Name for links within the page."""
        return self.title.lower().replace(" ", "-")

    @property
    def wide(self) -> bool:
        """Whether its words and tables are printed across: one has more columns than fit."""
        return any(len(table.heads) > _UPRIGHT for table in self.tables)


def write_page(
    path: Path, title: str, facts: dict[str, str], sections: list[Section], mark: str = ""
) -> Path:
    """Write the page, whole or not at all.

    Parameters
    ----------
    path : Path
        HTML file to write.
    title : str
        Heading of the page.
    facts : dict
        Short facts shown under the heading, before all sections.
    sections : list of Section
        The content.
    mark : str, optional
        Kept in the page, for `mark_of`: what it was made of.

    Returns
    -------
    Path
        The file.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.report import Section, Table, write_page
    >>> films = Section("Films", tables=[Table("Films", ["bearing", "h_min, µm"], [["N", "38"]])])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     page = write_page(Path(folder) / "page.html", "Look", {"Turbine": "NREL 5 MW"}, [films])
    ...     text = page.read_text(encoding="utf-8")
    >>> "NREL 5 MW" in text and "h_min" in text
    True
    """
    return write_filled(
        path,
        "page.html",
        title=title,
        facts=facts,
        sections=sections,
        mark=mark,
        few=FEW,
    )


def write_tables(folder: Path, sections: Sequence[Section]) -> list[Path]:
    r"""Write every table of a page as CSV, as it stands there; return the files.

    Each is named after its section and its title.

    Parameters
    ----------
    folder : Path
        Made if it is missing.
    sections : sequence of Section
        Of the page.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.report.page import Section, Table, write_tables
    >>> films = Section("Films", tables=[Table("At rest", ["bearing", "h_min, µm"], [["N", "38"]])])
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [file] = write_tables(Path(folder), [films])
    ...     file.name, file.read_text(encoding="utf-8")
    ('films-at-rest.csv', 'bearing,"h_min, µm"\nN,38\n')
    """
    found: dict[Path, Table] = {}
    for section in sections:
        for table in section.tables:
            title = re.split(r"[.;]", table.title)[0]
            stem = re.sub(r"[^\w]+", "-", f"{section.title} {title}".lower()).strip("-")[:_STEM]
            same = sum(path.name.startswith(stem) for path in found)
            found[folder / (f"{stem}-{same + 1}.csv" if same else f"{stem}.csv")] = table
    folder.mkdir(parents=True, exist_ok=True)
    for path, table in found.items():
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows([table.heads, *table.rows])
        write_text(path, text.getvalue())
    return [*found]


def asset(name: str) -> str:
    """Text of a file that the page brings along."""
    return (ASSETS / name).read_text(encoding="utf-8")


def write_filled(path: Path, template: str, **values: Any) -> Path:
    """Write a template of the package with its values filled in, whole or not at all."""
    environment = Environment(
        loader=PackageLoader("loadflow.report"), autoescape=select_autoescape(["html"])
    )
    environment.globals["asset"] = asset
    return write_text(path, environment.get_template(template).render(**values))
