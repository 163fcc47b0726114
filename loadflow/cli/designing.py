"""The command that searches for the best bearing: design."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from loadflow.cli import completing
from loadflow.cli.base import (
    AsJson,
    OtherSettings,
    OutFolder,
    RunName,
    Scheduler,
    Workers,
    app,
    check_workers,
    err,
    out,
    print_json,
    print_rows,
)
from loadflow.cli.progress import progress, works_long
from loadflow.cli.reading import AS_STATED, Reading, reads_load_files
from loadflow.cli.scenes import LoadFiles, SceneFile, read, tell_unused
from loadflow.cli.stated import refuse
from loadflow.errors import InputError

if TYPE_CHECKING:
    from loadflow.scene.scene import Scene


@app.command()
@works_long
@reads_load_files
def design(
    scene: SceneFile,
    loads: LoadFiles = None,
    candidate: Annotated[
        str | None,
        typer.Option(
            "--candidate",
            help="Which candidate; default: the scene's own bearings, or the first.",
            autocompletion=completing.candidates,
        ),
    ] = None,
    key: Annotated[
        list[str] | None,
        typer.Option(
            "--key",
            help="What varies, KEY=LOW:HIGH or KEY=A,B,C, of bearings or friction; may be "
            "repeated, and takes the place of \\[design.keys].",
        ),
    ] = None,
    margin: Annotated[
        float | None, typer.Option(help="Factor by which the loads must be able to grow.")
    ] = None,
    crown: Annotated[
        bool,
        typer.Option(
            "--crown",
            help="Search the crown of journal bearings alone, as \\[design.crown] says.",
        ),
    ] = False,
    out_folder: OutFolder = Path("runs"),
    name: RunName = None,
    workers: Workers = 0,
    scheduler: Scheduler = None,
    overwrite: OtherSettings = False,
    reading: Reading = AS_STATED,
    as_json: AsJson = False,
) -> None:
    """Search the best bearing: least friction with enough margin under the loads of the scene."""
    check_workers()
    from loadflow.running.designing import design as carry_out
    from loadflow.running.executor import usable_cores

    asked = _with_options(read(scene, loads, name, **reading), candidate, key, margin)
    tell_unused(asked)
    if asked.design.candidate is None:
        _tell_candidate(asked)
    means: dict[str, Any] = {
        "out": out_folder,
        "workers": workers or usable_cores(),
        "scheduler": scheduler,
        "overwrite": overwrite,
    }
    if crown or asked.design.crown is not None:
        refuse("the crown alone is searched", "key", "margin")
        _crown(asked, means, as_json)
        return
    with progress(quiet=as_json) as show:
        found = carry_out(asked, progress=show, **means)
    designs = found.designs
    if as_json:
        told = designs.as_dict()
        print_json({"page": str(found.page), "table": str(found.table)} | told)
        return
    out.print(designs.conclusion, soft_wrap=True, markup=False)
    if designs.settings:
        print_rows(("key", "best"), list(designs.settings.items()))
    out.print(f"page   {found.page}\ntable  {found.table}", soft_wrap=True)
    if designs.best is not None:
        out.print(f"scene  {found.scene}", soft_wrap=True)


def _tell_candidate(asked: Scene) -> None:
    """Print which candidate is searched where none is named, and which there are beside it."""
    from loadflow.running.candidates import candidates_for
    from loadflow.running.designing import chosen_candidate

    name, candidate = chosen_candidate(asked)
    others = [one for one in candidates_for(asked)[0] if one != name]
    more = f"; --candidate takes another: {', '.join(others)}" if others else ""
    told = f"searches {name} ({candidate.title or 'of the scene'}){more}"
    err.print(told, soft_wrap=True, markup=False, highlight=False)


def _crown(asked: Scene, means: dict[str, Any], as_json: bool) -> None:
    """Search the crowns, and print them."""
    from loadflow.running.crowning import crown as carry_out
    from loadflow.studies.design.crowning import HEADS

    with progress(quiet=as_json) as show:
        found = carry_out(asked, progress=show, **means)
    if as_json:
        told = [one.as_dict() for one in found.crowns]
        print_json({"table": str(found.table), "scene": str(found.scene), "crowns": told})
        return
    print_rows(HEADS, [one.row for one in found.crowns])
    out.print(f"table  {found.table}\nscene  {found.scene}", soft_wrap=True)


def _with_options(
    scene: Scene, candidate: str | None, keys: list[str] | None, margin: float | None
) -> Scene:
    """The scene with what the command line says of the search."""
    from pydantic import ValidationError

    from loadflow.scene.design import Design

    told: dict[str, Any] = scene.design.model_dump(exclude_unset=True)
    told |= {} if candidate is None else {"candidate": candidate}
    told |= {} if margin is None else {"margin": margin}
    if keys:
        told["keys"] = dict(map(_variation, keys))
        varied = {*told["keys"]}
        told["maps"] = [pair for pair in told.get("maps", []) if varied.issuperset(pair)]
    try:
        return scene.model_copy(update={"design": Design.model_validate(told)})
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, ("design", *first["loc"])))
        raise InputError(f"{where}: {first['msg'].removeprefix('Value error, ')}") from error


def _variation(text: str) -> tuple[str, Any]:
    """Key and values of ``KEY=LOW:HIGH`` or ``KEY=A,B,C``."""
    key, found, stated = text.partition("=")
    try:
        if found and ":" in stated:
            low, high = (float(part) for part in stated.split(":"))
            return key, {"low": low, "high": high}
        if found and "," in stated:
            return key, {"values": [_value(part) for part in stated.split(",")]}
    except ValueError as error:
        raise InputError(f"--key {text}: {error}") from error
    raise InputError(f"--key {text}: must be KEY=LOW:HIGH or KEY=A,B,C")


def _value(text: str) -> float | int | str:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
