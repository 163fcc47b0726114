"""The parameter file: a reduced series as CSV with attributes, for a bearing code and for people.

Attributes stand above the table, each behind a ``#``: ``pandas.read_csv(file, comment="#")`` reads
the table. The first form, without commas, is still read.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from loadflow.errors import InputError
from loadflow.reduction._series import Floats
from loadflow.reduction.quasistatic import Reduced, bin_sums


@dataclass(frozen=True)
class _Form:
    """A form of the file: its first line, its attributes in order, what separates columns."""

    title: str
    keys: tuple[str, ...]
    separator: str | None


COLUMNS = ("index", "time", "speed", "force_x", "force_y", "weight")
UNITS = ("-", "s", "rad/s", "N", "N", "-")
_SHARED = ("source", "pick", "seed", "speed_edges", "force_edges")
FORM = _Form("# loadflow parameter file 2", (*_SHARED, "units"), ",")
FIRST = _Form("# loadflow parameter file 1", (*_SHARED, "columns", "units"), None)
HEADER = 8
"""Lines above the numbers, of both forms: in the second the names of the columns are the last."""


def write_parameter_file(path: str | Path, reduced: Reduced) -> None:
    """Write a reduced series as CSV; `read_parameter_file` gives back the same numbers exactly.

    Parameters
    ----------
    path : path-like
        File to write.
    reduced : Reduced
        What `histogram` returned.

    Raises
    ------
    InputError
        The name of the source has a line break in it.

    Examples
    --------
    >>> import numpy as np
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.reduction import histogram, write_parameter_file
    >>> load = np.stack([2e6 + 1e5 * np.sin(np.arange(300.0)), np.zeros(300)], axis=-1)
    >>> reduced = histogram(np.linspace(1.1, 1.3, 300), load)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "reduced.csv"
    ...     write_parameter_file(file, reduced)
    ...     file.exists()
    True
    """
    if len(reduced.source.splitlines()) > 1:
        raise InputError(f"source = {reduced.source!r}; it must fit on one line")
    Path(path).write_text("\n".join(_lines(reduced)) + "\n", encoding="utf-8")


def _lines(reduced: Reduced) -> Iterator[str]:
    yield FORM.title
    yield f"# source = {reduced.source}"
    yield f"# pick = {reduced.pick}"
    yield f"# seed = {reduced.seed}"
    for name, edges in zip(("speed_edges", "force_edges"), reduced.edges):
        yield f"# {name} = {' '.join(map(repr, edges.tolist()))}"
    yield f"# units = {' '.join(UNITS)}"
    yield ",".join(COLUMNS)
    columns = (reduced.index, reduced.time, reduced.speed, *reduced.force.T, reduced.weight)
    for row in zip(*(c.tolist() for c in columns)):
        yield ",".join(map(repr, row))


def read_parameter_file(path: str | Path) -> Reduced:
    """Read what `write_parameter_file` wrote.

    Parameters
    ----------
    path : path-like
        File to read.

    Returns
    -------
    Reduced

    Raises
    ------
    InputError
        No such file, or a line is not what it should be; the message names file and line.

    Examples
    --------
    >>> import numpy as np
    >>> import tempfile
    >>> from pathlib import Path
    >>> from loadflow.reduction import histogram, read_parameter_file, write_parameter_file
    >>> load = np.stack([2e6 + 1e5 * np.sin(np.arange(300.0)), np.zeros(300)], axis=-1)
    >>> reduced = histogram(np.linspace(1.1, 1.3, 300), load)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "reduced.csv"
    ...     write_parameter_file(file, reduced)
    ...     again = read_parameter_file(file)
    >>> bool((again.force == reduced.force).all())
    True
    """
    try:
        lines = Path(path).read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise InputError(f"{path}: cannot be read as a parameter file: {error}") from error
    form = next((one for one in (FORM, FIRST) if lines and lines[0].strip() == one.title), None)
    if form is None:
        raise InputError(f"{path}, line 1: is not {FORM.title!r}")
    header = _header(path, lines, form)
    rows = _rows(path, lines, form.separator)
    speed_edges = _edges(path, header, "speed_edges")
    force_edges = _edges(path, header, "force_edges")
    index, time, speed, fx, fy, weight = rows.T
    edges = (speed_edges, force_edges)
    resultant = np.hypot(fx, fy)
    for values, limits in zip((speed, resultant), edges):
        outside = np.flatnonzero((values < limits[0]) | (values >= limits[-1]))
        if outside.size:
            line = HEADER + 1 + int(outside[0])
            raise InputError(
                f"{path}, line {line}: {values[outside[0]]:g} lies outside the class edges "
                f"[{limits[0]:g}, {limits[-1]:g})"
            )
    try:
        seed = int(header["seed"])
    except ValueError as error:
        line = _line_of("seed")
        raise InputError(f"{path}, line {line}: seed = {header['seed']!r} is no integer") from error
    return Reduced(
        index=index.astype(np.int64),
        time=time,
        speed=speed,
        force=np.stack([fx, fy], axis=1),
        weight=weight,
        edges=edges,
        # every class that had a pair has one still, and their weights sum to its count
        counts_full=np.rint(bin_sums(speed, resultant, edges, weight)).astype(np.int64),
        counts_reduced=bin_sums(speed, resultant, edges).astype(np.int64),
        pick=header["pick"],
        seed=seed,
        source=header["source"],
    )


def _line_of(key: str) -> int:
    """Number of the line of an attribute that both forms have in the same place."""
    return _SHARED.index(key) + 2


def _header(path: str | Path, lines: list[str], form: _Form) -> dict[str, str]:
    """Attributes, which stand in fixed order from line 2 on, and the names of the columns."""
    header = {}
    for number, key in enumerate(form.keys, start=2):
        line = lines[number - 1] if number <= len(lines) else ""
        name, _, value = line.removeprefix("# ").partition(" =")
        if name != key:
            raise InputError(f'{path}, line {number}: "# {key} = …" is needed, found {line!r}')
        header[key] = value.removeprefix(" ")
    numbers = {key: number for number, key in enumerate(form.keys, start=2)}
    if form.separator is not None:
        named = lines[HEADER - 1] if len(lines) >= HEADER else ""
        header["columns"], numbers["columns"] = named.replace(form.separator, " "), HEADER
    for key, expected in (("columns", COLUMNS), ("units", UNITS)):
        if tuple(header[key].split()) != expected:
            raise InputError(
                f"{path}, line {numbers[key]}: {key} are {header[key]!r}; needed: "
                f"{' '.join(expected)!r}"
            )
    return header


def _edges(path: str | Path, header: dict[str, str], key: str) -> Floats:
    """Class edges of one header line."""
    edges = _numbers(path, _line_of(key), header[key])
    if edges.size < 2 or np.any(np.diff(edges) <= 0):
        raise InputError(f"{path}, line {_line_of(key)}: {key} must ascend, at least two")
    return edges


def _rows(path: str | Path, lines: list[str], separator: str | None) -> Floats:
    """Table of numbers below the header."""
    rows = []
    for number, line in enumerate(lines[HEADER:], start=HEADER + 1):
        row = _numbers(path, number, line, separator)
        if row.size != len(COLUMNS):
            raise InputError(
                f"{path}, line {number}: {row.size} numbers; {len(COLUMNS)} are needed"
            )
        rows.append(row)
    if not rows:
        raise InputError(f"{path}, line {HEADER + 1}: the table is empty")
    return np.array(rows)


def _numbers(path: str | Path, number: int, text: str, separator: str | None = None) -> Floats:
    """Finite numbers of one line."""
    try:
        values = np.array([float(word) for word in text.split(separator)])
    except ValueError as error:
        raise InputError(f"{path}, line {number}: {error}") from error
    if not np.isfinite(values).all():
        raise InputError(f"{path}, line {number}: a number is not finite")
    return values
