"""The command line: reads arguments, calls the package, prints. No logic of its own."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.console import Console
from rich.table import Table

from loadflow.errors import InputError, LoadflowError

app = typer.Typer(
    help="From wind and load series to the main bearing of a wind turbine.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    add_completion=False,
)
out = Console(width=None if sys.stdout.isatty() else 150)
err = Console(stderr=True)

SceneFile = Annotated[Path, typer.Argument(help="Scene, a TOML file.", show_default=False)]
LoadFiles = Annotated[
    list[str] | None,
    typer.Option("--loads", help="Load files (name or quoted pattern) in place of the scene's."),
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON, for a machine to read.")]


def main() -> None:
    """Run the command line; exit code 0 done, 1 failed with a message, 2 bad usage or input."""
    try:
        app()
    except InputError as error:
        err.print(f"[red]error:[/] {_plain(error)}", soft_wrap=True)
        sys.exit(2)
    except LoadflowError as error:
        err.print(f"[red]failed:[/] {_plain(error)}", soft_wrap=True)
        sys.exit(1)
    except KeyboardInterrupt:
        err.print("stopped; started again, the run goes on where it was")
        sys.exit(1)


def _plain(error: Exception) -> str:
    return str(error).replace("[", "\\[")


def _read(path: Path, loads: list[str] | None, name: str | None = None) -> Any:
    from loadflow.scene import read_scene, with_loads

    scene = read_scene(path)
    scene = with_loads(scene, loads) if loads else scene
    return scene.model_copy(update={"name": name}) if name else scene


@app.command()
def run(
    scene: SceneFile,
    loads: LoadFiles = None,
    out_folder: Annotated[Path, typer.Option("--out", help="Folder for runs.")] = Path("runs"),
    name: Annotated[str | None, typer.Option(help="Name of the run; default: the scene's.")] = None,
    workers: Annotated[int, typer.Option(min=0, help="Processes; 0: one for each core.")] = 0,
    scheduler: Annotated[str | None, typer.Option(help="Dask scheduler, tcp://host:port.")] = None,
    overwrite: Annotated[bool, typer.Option(help="Replace parts of other settings.")] = False,
    as_json: AsJson = False,
) -> None:
    """Carry a scene out; a run that was killed goes on where it was."""
    from loadflow.runner import run as carry_out

    with _progress(quiet=as_json) as progress:
        result = carry_out(
            _read(scene, loads, name),
            out=out_folder,
            workers=workers or len(os.sched_getaffinity(0)),
            scheduler=scheduler,
            overwrite=overwrite,
            progress=progress,
        )
    if as_json:
        print(
            json.dumps(
                {
                    "path": str(result.path),
                    "report": str(result.report),
                    "failures": result.failures,
                }
            )
        )
    else:
        out.print(f"results  {result.path / 'result.h5'}\nreport   {result.report}", soft_wrap=True)
    if result.failures:
        lines = "\n".join(f"  {case}: {why}" for case, why in result.failures.items())
        raise LoadflowError(f"{len(result.failures)} parts have no answer:\n{lines}")


@app.command()
def plan(scene: SceneFile, loads: LoadFiles = None, as_json: AsJson = False) -> None:
    """Show which stages and models a scene needs, their expected time and error."""
    from loadflow.plan import make_plan

    made = make_plan(_read(scene, loads))
    if as_json:
        steps = [
            {
                "stage": step.stage.name,
                "rung": step.rung,
                "runs": step.runs,
                "seconds": step.seconds,
                "error": step.error,
            }
            for step in made.steps
        ]
        cases = [case.name for case in made.cases]
        print(json.dumps({"steps": steps, "cases": cases, "left_out": made.left_out}))
        return
    table = Table("stage", "model", "runs", "expected time, one core", "error", box=None)
    for step in made.steps:
        seconds = "not measured" if step.seconds is None else f"{step.seconds:.0f} s"
        table.add_row(
            step.stage.name, step.rung, str(step.runs), seconds, step.error or "not measured"
        )
    out.print(table)
    out.print(f"{len(made.cases)} load cases")
    for stage, why in made.left_out.items():
        out.print(f"left out: {stage} ({why})")


@app.command("scene")
def show_scene(
    scene: SceneFile,
    show: Annotated[bool, typer.Option("--show", help="Print it with all defaults.")] = False,
) -> None:
    """Check a scene; with --show print it as resolved."""
    resolved = _read(scene, None)
    print(resolved.to_toml() if show else f"{scene}: valid")


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
def report(run_folder: Annotated[Path, typer.Argument(help="Folder of a run.")]) -> None:
    """Write the report page of a run again."""
    from loadflow.stages.report import write_report

    out.print(str(write_report(run_folder)), soft_wrap=True)


@app.command()
def validate(
    names: Annotated[list[str] | None, typer.Argument(help="Tables; default: all.")] = None,
    as_json: AsJson = False,
) -> None:
    """Print the sources' numbers beside ours; fails if one is out of its tolerance."""
    from loadflow import validation

    known = validation.names()
    if unknown := set(names or []) - set(known):
        raise InputError(f"no table {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    rows = [(name, check) for name in names or known for check in validation.all_checks(name)]
    bad = sum(not check.ok for _, check in rows)
    if as_json:
        print(json.dumps([{"table": name, **vars(c), "ok": c.ok} for name, c in rows]))
    else:
        table = Table("table", "number", "source", "printed", "ours", "deviation", "allowed", "")
        for name, check in rows:
            scale, sign = (1, "") if check.kind == "absolute" else (100, " %")
            table.add_row(
                name,
                check.name,
                check.source,
                f"{check.expected:.6g} {check.unit}",
                f"{check.got:.6g} {check.unit}",
                f"{check.deviation * scale:+.3g}{sign}",
                f"{check.tolerance * scale:.3g}{sign}",
                "ok" if check.ok else "[red]out[/]",
            )
        out.print(table)
        out.print(f"{len(rows) - bad} of {len(rows)} within their tolerance")
    if bad:
        raise LoadflowError(f"{bad} numbers are out of their tolerance")


@contextmanager
def _progress(quiet: bool) -> Iterator[Any]:
    """Yield a callback that draws one bar for each stage."""
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = [
        TextColumn("{task.description:<12}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TimeRemainingColumn(),
    ]
    with Progress(*columns, console=err, disable=quiet) as bars:
        tasks: dict[str, Any] = {}

        def show(stage: str, done: int, total: int) -> None:
            if stage not in tasks:
                tasks[stage] = bars.add_task(stage, total=total)
            bars.update(tasks[stage], completed=done, total=total)

        yield show


if __name__ == "__main__":
    main()
