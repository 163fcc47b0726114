"""The report as one HTML file that needs no other file and no network."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from jinja2 import Environment, PackageLoader, select_autoescape
from matplotlib.figure import Figure

from loadflow.plots.style import to_png
from loadflow.storage import write_text


@dataclass(frozen=True)
class Table:
    """A table: a title, column heads and rows of text; `bad` holds the numbers of rows to mark.

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
    def source(self) -> str:
        """The figure as a ``data:`` address."""
        return to_png(self.figure)


@dataclass(frozen=True)
class Section:
    """A part of the page, shown in order: text, tables, pictures.

    Examples
    --------
    >>> from loadflow.report import Section, Table
    >>> Section("Films", "At rest.", [Table("Films", ["bearing"], [["N"]])]).tables[0].title
    'Films'
    """

    title: str
    text: str = ""
    tables: list[Table] = field(default_factory=list)
    pictures: list[Picture] = field(default_factory=list)

    @property
    def anchor(self) -> str:
        """Name for links within the page."""
        return self.title.lower().replace(" ", "-")


def write_page(path: Path, title: str, facts: dict[str, str], sections: list[Section]) -> Path:
    """Write the page, whole or not at all.

    Parameters
    ----------
    path : Path
        HTML file to write.
    title : str
        Heading of the page.
    facts : dict
        Short facts shown under the heading.
    sections : list of Section
        The content.

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
    return write_filled(path, "page.html", title=title, facts=facts, sections=sections)


def write_filled(path: Path, template: str, **values: Any) -> Path:
    """Write a template of the package with its values filled in, whole or not at all."""
    environment = Environment(
        loader=PackageLoader("loadflow.report"), autoescape=select_autoescape(["html"])
    )
    return write_text(path, environment.get_template(template).render(**values))
