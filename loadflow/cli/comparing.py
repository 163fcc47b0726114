"""Commands to begin with and to decide with: init, list, compare."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from loadflow.cli import completing
from loadflow.cli.base import (
    AsJson,
    OtherSettings,
    OutFolder,
    Overwrite,
    RunName,
    Scheduler,
    Workers,
    app,
    check_free,
    check_workers,
    out,
    print_json,
    print_rows,
)
from loadflow.cli.progress import progress, works_long
from loadflow.cli.reading import AS_STATED, Reading, reads_load_files
from loadflow.cli.scenes import LoadFiles, SceneFile, read, tell_unused
from loadflow.errors import LoadflowError
from loadflow.quantities import three_digits


@app.command()
@works_long
@reads_load_files
def compare(
    scene: SceneFile,
    loads: LoadFiles = None,
    candidate: Annotated[
        list[str] | None,
        typer.Option(
            "--candidate",
            help="Name of one to compare, may be repeated; default all.",
            autocompletion=completing.candidates,
        ),
    ] = None,
    starts: Annotated[
        float | None,
        typer.Option(
            "--starts",
            help="Starts, stops and faults of each design load case in the life, for wear.",
        ),
    ] = None,
    out_folder: OutFolder = Path("runs"),
    name: RunName = None,
    workers: Workers = 0,
    scheduler: Scheduler = None,
    overwrite: OtherSettings = False,
    reading: Reading = AS_STATED,
    as_json: AsJson = False,
) -> None:
    """Journal or rolling? Compare bearings for the same places under the same loads.

    The candidates are those of the scene, or those that are sized for its turbine.
    """
    check_workers()
    from loadflow.running.comparison import compare as carry_out
    from loadflow.running.executor import usable_cores

    asked = read(scene, loads, name, **reading)
    tell_unused(asked)
    with progress(quiet=as_json) as show:
        found = carry_out(
            asked,
            out=out_folder,
            candidates=candidate,
            starts=starts,
            workers=workers or usable_cores(),
            scheduler=scheduler,
            overwrite=overwrite,
            progress=show,
        )
    if as_json:
        print_json(
            {"page": str(found.page), "table": str(found.table)} | found.comparison.as_dict()
        )
    else:
        for told in filter(None, (found.comparison.conclusion, found.comparison.reservations)):
            out.print(told, soft_wrap=True, markup=False)
        heads = ("candidate", "limits", "loads may grow by", "governed by", "MWh a year", "thrust")
        rows = [
            (
                one.name,
                ("hold, but" if one.reservations else "hold") if one.holds else "broken",
                f"{three_digits(one.numbers['load_factor'].value)} ×",
                one.governs,
                three_digits(one.numbers["energy"].value),
                one.thrust,
            )
            for one in found.comparison.candidates
        ]
        print_rows(heads, rows)
        out.print(f"page   {found.page}\ntable  {found.table}", soft_wrap=True)
    if found.failures:
        lines = "\n".join(f"  {one}: {why}" for one, why in found.failures.items())
        raise LoadflowError(f"{len(found.failures)} candidates have no answer:\n{lines}")


@app.command()
def init(
    template: Annotated[
        str,
        typer.Argument(
            help="Name, as `loadflow list scenes` has them.", autocompletion=completing.templates
        ),
    ] = "quick_look",
    output: Annotated[Path, typer.Option("-o", "--output", help="File to write.")] = Path(
        "scene.toml"
    ),
    overwrite: Overwrite = False,
) -> None:
    """Write a scene to begin with."""
    from loadflow.scene.scene import read_scene
    from loadflow.scene.templates import template_text

    text = template_text(template, name=output.stem)
    check_free(output, overwrite)
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(text, encoding="utf-8")
    loads = read_scene(output).loads
    given = " --loads 'path/to/*.outb'" if loads.source == "files" and not loads.files else ""
    steps = [f"  loadflow {verb} {output}{given}" for verb in ("plan", "run", "compare")]
    out.print("\n".join([f"{output}: a copy of {template}; next:", *steps]), soft_wrap=True)


@app.command("list")
def list_known(
    what: Annotated[
        str | None,
        typer.Argument(
            help="What to list; left out: what there is.", autocompletion=completing.lists
        ),
    ] = None,
    only: Annotated[
        str | None,
        typer.Argument(help="Only rows of this, as the first column has it: a turbine, a stage."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """List what scenes may name: turbines, oils, bearings, rungs, effects and others."""
    from loadflow.cli.lists import LISTS, rows_of, with_notes

    if what is None:
        rows = [(name, (one.__doc__ or "").strip().splitlines()[0]) for name, one in LISTS.items()]
        if as_json:
            print_json(dict(rows))
        else:
            print_rows(("loadflow list …", ""), rows)
        return
    heads, found = rows_of(what, only)
    if as_json:
        print_json([dict(zip(heads, row)) for row in found])
        return
    short, notes = with_notes(heads, found)
    print_rows(heads, short)
    for note in notes:
        out.print(note, soft_wrap=True, markup=False, highlight=False)
