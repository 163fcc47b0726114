"""Commands that make load cubes and hand them on: convert, loads."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from loadflow.cli.base import AsJson, TurbineName, app, open_checked, out, print_json, progress

CUBES = (".h5", ".nc")


@app.command()
def convert(
    files: Annotated[list[str], typer.Argument(help="Load files or patterns, or one load cube.")],
    output: Annotated[
        Path,
        typer.Option("-o", "--output", help="File to write: .h5, or .csv, .parquet, .mat."),
    ],
    turbine: Annotated[str, typer.Option(help="Turbine that the files are of.")] = "nrel-5mw",
    step: Annotated[
        float | None, typer.Option(help="Bring all series to this time step, s.")
    ] = None,
) -> None:
    """Read load files of OpenFAST and others into one load cube, or hand a cube to other programs.

    What the name of the output ends with decides: a load cube (.h5, .nc), or tables for other
    programs (.csv, .parquet) or for MATLAB (.mat).
    """
    from loadflow.cube import export_cube, iter_cases, resample, save_cube
    from loadflow.readers import read_loads

    first = Path(files[0])
    one_cube = len(files) == 1 and (first.suffix in CUBES or first.is_dir())
    cube = open_checked(first) if one_cube else read_loads(files, turbine=turbine)
    if step is not None:
        cube = resample(cube, step)
    write = save_cube if output.suffix in CUBES else export_cube
    write(cube, output)
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
