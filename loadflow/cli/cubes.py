"""Commands that make load cubes and hand them on: convert, loads."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from loadflow.cli.base import (
    AsJson,
    Overwrite,
    TurbineName,
    app,
    caught_warnings,
    check_free,
    open_checked,
    out,
    print_json,
    print_rows,
)
from loadflow.cli.progress import progress, works_long
from loadflow.cli.reading import AS_STATED, READING, Reading, reads_load_files
from loadflow.cli.stated import refuse
from loadflow.errors import InputError
from loadflow.quantities import load_cases

if TYPE_CHECKING:
    from loadflow.cube import Cube

CUBES = (".h5", ".nc")


@app.command()
@works_long
@reads_load_files
def convert(
    files: Annotated[
        list[str], typer.Argument(help="Load files, folders of them or patterns, or load cubes.")
    ],
    output: Annotated[
        Path | None,
        typer.Option("-o", "--output", help="File to write: .h5, or .csv, .parquet, .mat."),
    ] = None,
    turbine: Annotated[str, typer.Option(help="Turbine that the files are of.")] = "nrel-5mw",
    step: Annotated[
        float | None, typer.Option(help="Bring all series to this time step, s.")
    ] = None,
    reading: Reading = AS_STATED,
    names: Annotated[
        bool, typer.Option("--list", help="Only show which case each name says; nothing is read.")
    ] = False,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Read load files of OpenFAST and others into one load cube, or hand a cube to other programs.

    Several load cubes, such as the parts of a run, are joined.

    What the name of the output ends with decides: a load cube (.h5, .nc), or tables for other
    programs (.csv, .parquet) or for MATLAB (.mat).
    """
    from loadflow.cube import export_cube, iter_cases, make_cube, resample, save_cube
    from loadflow.readers import read_loads

    if names:
        refuse(
            "--list only shows names",
            "output", "turbine", "step", "channels", "gauge_distance", "frame", "overwrite",
        )  # fmt: skip
        _list_names(files, reading["pattern"], reading["cases"], as_json)
        return
    if output is None:
        raise InputError("-o/--output is missing: the file to write; or --list to see the names")
    check_free(output, overwrite)
    told: list[str] = []
    paths = [Path(name) for name in files]
    if all(path.suffix in CUBES or _holds_cubes(path) for path in paths):
        refuse("load cubes say themselves what is in them", "turbine", *READING)
        cubes = [open_checked(path) for path in paths]
        parts = [case for cube in cubes for _, case in iter_cases(cube)]
        cube = cubes[0] if len(cubes) == 1 else make_cube(parts)
    else:
        with caught_warnings() as told:
            cube = read_loads(
                files,
                turbine=turbine,
                **reading | {"frame": reading["frame"] or "auto"},
                quiet=True,
            )
    if step is not None:
        cube = resample(cube, step)
    write = save_cube if output.suffix in CUBES else export_cube
    write(cube, output)
    found = [name for name, _ in iter_cases(cube)]
    warnings = [*told, *_doubts(cube)]
    if as_json:
        print_json({"path": str(output), "cases": found, "warnings": warnings})
        return
    out.print(f"{output}: {load_cases(len(found))}", soft_wrap=True)
    for warning in warnings:
        out.print(f"warning  {warning}", soft_wrap=True, highlight=False, markup=False)


def _list_names(files: list[str], pattern: str | None, cases: str | None, as_json: bool) -> None:
    from loadflow.readers import list_names

    fields = ("dlc", "wind_speed", "seed")
    with caught_warnings() as told:
        labels = list_names(files, pattern=pattern, cases=cases)
    rows = [
        {"file": file} | {field: getattr(label, field) for field in fields}
        for file, label in labels
    ]
    if as_json:
        print_json(rows)
        return
    shown = [["-" if value is None else str(value) for value in row.values()] for row in rows]
    print_rows(("file", "dlc", "wind speed, m/s", "seed"), shown)
    for warning in told:
        out.print(f"warning  {warning}", soft_wrap=True, highlight=False, markup=False)


def _holds_cubes(folder: Path) -> bool:
    """Whether a folder is one of load cubes, as a run leaves them; load files come first."""
    from loadflow.readers import READERS

    inside = [*folder.iterdir()] if folder.is_dir() else []
    loads = any(reader.recognises(path) for path in inside for reader in READERS)
    return not loads and any(path.suffix in CUBES for path in inside)


def _doubts(cube: Cube) -> list[str]:
    """Say what does not fit, by case."""
    from loadflow.cube import iter_cases

    return [
        f"{name}: {doubt}"
        for name, case in iter_cases(cube)
        if "doubts" in case.coords and str(case["doubts"].item())
        for doubt in str(case["doubts"].item()).split("\n")
    ]


@app.command()
@works_long
def loads(
    output: Annotated[Path, typer.Option("-o", "--output", help="Load cube to write, .h5.")],
    wind_speed: Annotated[
        list[float] | None,
        typer.Option(help="Mean at the hub, m/s; repeatable; default: those of the load case."),
    ] = None,
    turbine: TurbineName = "nrel-5mw",
    dlc: Annotated[
        list[str] | None, typer.Option(help="Design load case; repeatable; default: 1.1.")
    ] = None,
    seed: Annotated[
        list[int] | None,
        typer.Option(help="Of the turbulence, or variant of a gust; repeatable; default: 1."),
    ] = None,
    duration: Annotated[
        float | None, typer.Option(help="Length of each series, s; default: of the load case.")
    ] = None,
    step: Annotated[float, typer.Option(help="Time step, s.")] = 0.025,
    category: Annotated[str, typer.Option(help="Turbulence: A+, A, B or C.")] = "B",
    wind_class: Annotated[str, typer.Option("--class", help="Wind class: I, II or III.")] = "I",
    rung: Annotated[
        str | None, typer.Option(help="Model: tables, bem, flap or tower; default: by load case.")
    ] = None,
    steady: Annotated[bool, typer.Option("--steady", help="Steady extreme wind.")] = False,
    overwrite: Overwrite = False,
    as_json: AsJson = False,
) -> None:
    """Simulate the hub loads of a turbine in its design load cases, from power to standstill."""
    from loadflow.cube import iter_cases, save_cube
    from loadflow.stages.loads import trip_warnings
    from loadflow.studies.simulated_cube import simulate_cube

    check_free(output, overwrite)
    settings: dict[str, Any] = {
        "dlc": dlc or ["1.1"],
        "step": step,
        "category": category,
        "wind_class": wind_class,
        "steady": steady,
    }
    settings |= {} if duration is None else {"duration": duration}
    settings |= {} if rung is None else {"rung": rung}
    with progress(quiet=as_json) as show:
        cube = simulate_cube(turbine, wind_speed, seed or [1], settings, progress=show)
    save_cube(cube, output)
    lengths = {name: case.sizes["time"] * step for name, case in iter_cases(cube)}
    tripped = {name: float(case["tripped"]) for name, case in iter_cases(cube)}
    warnings = trip_warnings({name: t for name, t in tripped.items() if t >= 0})
    if as_json:
        cases = list(lengths)
        told = {"cases": cases, "turbine": turbine, "warnings": warnings}
        print_json({"path": str(output), **told, **settings})
    else:
        listed = ", ".join(f"{name} ({length:g} s)" for name, length in lengths.items())
        out.print(f"{output}: {listed}; in steps of {step:g} s", soft_wrap=True)
        for warning in warnings:
            out.print(f"warning  {warning}", soft_wrap=True)
