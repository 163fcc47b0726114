"""The application that commands register with, and how they print."""

from __future__ import annotations

import json
import sys
import warnings
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from loadflow.cli import completing
from loadflow.cli.stated import App, Commands, refuse, stated
from loadflow.errors import InputError, ValidityWarning, in_a_line
from loadflow.storage import plain

if TYPE_CHECKING:
    import xarray as xr

    from loadflow.cube import Cube

app = App(
    cls=Commands,
    help="From wind and load series to the main bearing of a wind turbine.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
)


def _print_version(wanted: bool) -> None:
    if wanted:
        from loadflow import __version__

        print(f"loadflow {__version__}")
        raise typer.Exit


@app.callback()
def common(
    version: Annotated[
        bool,
        typer.Option(
            "--version", callback=_print_version, is_eager=True, help="Print the version."
        ),
    ] = False,
) -> None:
    """What all commands share."""


out = Console(width=None if sys.stdout.isatty() else 150)
err = Console(stderr=True)

CubeFile = Annotated[
    Path, typer.Argument(help="Load cube (.h5), or a folder of its cases.", show_default=False)
]
TurbineName = Annotated[
    str, typer.Option(help="Turbine: a name, or a file.", autocompletion=completing.turbines)
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for a machine to read.")]

OutFolder = Annotated[Path, typer.Option("--out", "-o", help="Folder for runs.")]
RunName = Annotated[str | None, typer.Option(help="Name of the run; default: the scene's.")]
Workers = Annotated[int, typer.Option(min=0, help="Processes; 0: one for each core.")]
Scheduler = Annotated[str | None, typer.Option(help="Dask scheduler, tcp://host:port.")]
OtherSettings = Annotated[
    bool, typer.Option("--overwrite", help="Replace parts of other settings.")
]

Overwrite = Annotated[bool, typer.Option("--overwrite", help="Replace a file that is there.")]

WIDEST = 4  # values of one quantity that fit a line of a table; more are for --json


def open_checked(path: Path) -> Cube:
    """Open a cube and check it whole."""
    from loadflow.cube import check_cube, open_cube

    cube = open_cube(path)
    check_cube(cube, source=str(path))
    return cube


def check_workers() -> None:
    """Refuse a number of processes beside a cluster, which has its own."""
    if stated("scheduler"):
        refuse("a cluster has its own", "workers")


def check_turbine(cube: Cube) -> None:
    """Refuse a turbine beside a cube that has the forces of its bearings."""
    from loadflow.cube import iter_cases

    if all("force" in case for _, case in iter_cases(cube)):
        refuse("the cube has the forces of its bearings", "turbine")


def check_free(path: Path, overwrite: bool) -> None:
    """Refuse to write over a file unless asked to."""
    if path.exists() and not overwrite:
        raise InputError(f"{path} exists already; give another name, or --overwrite")


@contextmanager
def warnings_in_a_line() -> Iterator[None]:
    """Print what the library warns of as its words alone, without the line of code that warns."""
    before = warnings.formatwarning
    warnings.formatwarning = in_a_line
    try:
        yield
    finally:
        warnings.formatwarning = before


@contextmanager
def caught_warnings() -> Iterator[list[str]]:
    """Collect what the library warns of within the block, to be printed like other output."""
    told: list[str] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ValidityWarning)
        yield told
    told += [str(warning.message) for warning in caught]


def print_json(data: Any) -> None:
    """Print as JSON; what is not finite becomes null, which JSON has."""
    print(json.dumps(plain(data), allow_nan=False))


def print_rows(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print a table of text."""
    table = Table(*heads, box=None)
    for row in rows:
        table.add_row(*row)
    out.print(table)


def print_quantities(data: xr.Dataset, as_json: bool) -> None:
    """Print every variable of a Dataset with its unit, one for each line.

    JSON has all values, in SI units; the table those of few values, in the units of engineers.
    """
    if as_json:
        quantities = {
            name: {"value": v.values, "units": v.attrs["units"], "long_name": v.attrs["long_name"]}
            for name, v in data.data_vars.items()
        }
        print_json(quantities | data.attrs)
        return
    print_rows(
        ("quantity", "value", "unit", "meaning"),
        [_row(str(name), v) for name, v in data.data_vars.items() if v.size <= WIDEST],
    )
    for name, text in data.attrs.items():
        out.print(f"{name}: {text}", soft_wrap=True, highlight=False)


def _row(name: str, data: xr.DataArray) -> tuple[str, str, str, str]:
    from loadflow.plots.style import readable

    meaning = data.attrs["long_name"]
    if data.dtype.kind == "b":
        return name, ", ".join("yes" if yes else "no" for yes in data.values.flat), "", meaning
    unit = data.attrs["units"]
    if unit == "N m":  # friction as well as tilting: no one larger unit suits both
        values = data.values
    else:
        small = unit == "m" and bool((abs(data) < 1e-2).all())
        values, unit = readable(data, "µm" if small else None)
    return name, ", ".join(f"{value:.6g}" for value in values.flat), unit, meaning
