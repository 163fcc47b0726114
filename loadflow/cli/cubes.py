"""Commands for load cubes: convert, loads, seeds, reduce."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from loadflow.cli.base import AsJson, app, out, print_json, print_rows, progress

if TYPE_CHECKING:
    from loadflow.cube import Cube

CubeFile = Annotated[
    Path, typer.Argument(help="Load cube (.h5), or a folder of its cases.", show_default=False)
]
TurbineName = Annotated[str, typer.Option(help="Turbine: a name, or a file.")]


class Method(StrEnum):
    """How seeds are tested."""

    as_printed = "as-printed"
    calibrated = "calibrated"


class Pick(StrEnum):
    """How the members of a class are picked."""

    random = "random"
    extremes = "extremes"


def _open(path: Path) -> Cube:
    """Open a cube and check it whole."""
    from loadflow.cube import check_cube, open_cube

    cube = open_cube(path)
    check_cube(cube, source=str(path))
    return cube


@app.command()
def convert(
    files: Annotated[list[str], typer.Argument(help="Load files or patterns.")],
    output: Annotated[Path, typer.Option("-o", "--output", help="Load cube to write, .h5.")],
    turbine: Annotated[str, typer.Option(help="Turbine that the files are of.")] = "nrel-5mw",
) -> None:
    """Read load files of OpenFAST and others into one load cube."""
    from loadflow.cube import iter_cases, save_cube
    from loadflow.readers import read_loads

    cube = read_loads(files, turbine=turbine)
    save_cube(cube, output)
    out.print(f"{output}: {sum(1 for _ in iter_cases(cube))} load cases", soft_wrap=True)


@app.command()
def loads(
    wind_speed: Annotated[
        list[float], typer.Option(help="Mean at the hub, m/s; may be repeated.", show_default=False)
    ],
    output: Annotated[Path, typer.Option("-o", "--output", help="Load cube to write, .h5.")],
    turbine: TurbineName = "nrel-5mw",
    dlc: Annotated[str, typer.Option(help="Design load case.")] = "1.1",
    seed: Annotated[list[int] | None, typer.Option(help="Of the turbulence; repeatable.")] = None,
    duration: Annotated[float, typer.Option(help="Length of each series, s.")] = 600.0,
    step: Annotated[float, typer.Option(help="Time step, s.")] = 0.025,
    category: Annotated[str, typer.Option(help="Turbulence: A+, A, B or C.")] = "B",
    wind_class: Annotated[str, typer.Option("--class", help="Wind class: I, II or III.")] = "I",
    rung: Annotated[str, typer.Option(help="Model: tables, bem or flap.")] = "flap",
    as_json: AsJson = False,
) -> None:
    """Simulate the hub loads of a turbine in turbulent wind; every wind speed with every seed."""
    from loadflow.cube import save_cube
    from loadflow.stages.simulated import simulate_cube

    settings = {
        "dlc": dlc,
        "duration": duration,
        "step": step,
        "category": category,
        "wind_class": wind_class,
        "rung": rung,
    }
    with progress(quiet=as_json) as show:
        cube = simulate_cube(turbine, wind_speed, seed or [1], settings, progress=show)
    save_cube(cube, output)
    cases = cube["case"].values.tolist()
    if as_json:
        print_json({"path": str(output), "cases": cases, "turbine": turbine, **settings})
    else:
        each = f"{duration:g} s each, in steps of {step:g} s"
        out.print(f"{output}: {', '.join(cases)}; {each}", soft_wrap=True)


@app.command()
def seeds(
    cube: CubeFile,
    variable: Annotated[
        list[str] | None,
        typer.Option(help="What to test, such as hub_moment.y; repeatable; default: all loads."),
    ] = None,
    alpha: Annotated[float, typer.Option(help="Level of significance.")] = 0.05,
    method: Annotated[Method, typer.Option(help="Of the tests.")] = Method.calibrated,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Page with figures to write, .html.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Test for each wind speed and load component whether its seeds are equal."""
    from loadflow.stages.seed_report import (
        HEADS,
        as_row,
        count_different,
        seed_verdicts,
        write_seed_page,
    )

    series = _open(cube)
    verdicts = seed_verdicts(
        series, variable or [], alpha=alpha, method=method.value, source=str(cube)
    )
    if output:
        write_seed_page(output, series, verdicts, source=cube.name)
    if as_json:
        print_json([verdict.as_dict() for verdict in verdicts])
        return
    print_rows(HEADS, [as_row(verdict) for verdict in verdicts])
    out.print(f"{count_different(verdicts)}; {method.value}, α = {alpha:g}")
    if output:
        out.print(f"page     {output}", soft_wrap=True)


@app.command("reduce")
def reduce_series(
    cube: CubeFile,
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder to write to.")],
    size: Annotated[float, typer.Option(help="Share of each series to keep, 0 … 1.")] = 0.1,
    pick: Annotated[Pick, typer.Option(help="Of the members of a class.")] = Pick.extremes,
    seed: Annotated[int, typer.Option(min=0, help="Of the random pick.")] = 0,
    bearing: Annotated[
        list[str] | None, typer.Option(help="Which bearing; repeatable; default: all.")
    ] = None,
    turbine: TurbineName = "nrel-5mw",
    as_json: AsJson = False,
) -> None:
    """Reduce the radial force of each bearing in each case; write parameter files and a page.

    A cube of hub loads alone gets its bearing forces from the default suspension on two points.
    """
    from loadflow.stages.reduced_files import HEADS, as_row, reduce_cube, write_reduction_page

    made = reduce_cube(
        _open(cube),
        output,
        size=size,
        pick=pick.value,
        seed=seed,
        bearings=bearing or [],
        turbine=turbine,
        source=str(cube),
    )
    page = write_reduction_page(output / "reduction.html", made, source=cube.name)
    if as_json:
        print_json(
            {
                "suspension": made.suspension,
                "page": str(page),
                "series": [part.as_dict() for part in made.parts],
            }
        )
        return
    out.print(f"bearing forces: {made.suspension}", soft_wrap=True, highlight=False)
    print_rows(HEADS, [as_row(part) for part in made.parts])
    out.print(f"page     {page}", soft_wrap=True)
