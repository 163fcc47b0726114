"""Commands for scenes and their runs: run, plan, scene, report; and validate."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from loadflow.cli.base import AsJson, app, out, print_json, progress
from loadflow.errors import InputError, LoadflowError

SceneFile = Annotated[Path, typer.Argument(help="Scene, a TOML file.", show_default=False)]
LoadFiles = Annotated[
    list[str] | None,
    typer.Option("--loads", help="Load files (name or quoted pattern) in place of the scene's."),
]


def _read(path: Path, loads: list[str] | None, name: str | None = None) -> Any:
    from loadflow.scene.scene import read_scene, with_loads

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
    from loadflow.running.runner import run as carry_out

    with progress(quiet=as_json) as show:
        result = carry_out(
            _read(scene, loads, name),
            out=out_folder,
            workers=workers or len(os.sched_getaffinity(0)),
            scheduler=scheduler,
            overwrite=overwrite,
            progress=show,
        )
    if as_json:
        paths = {"path": str(result.path), "report": str(result.report)}
        found = {"failures": result.failures, "flagged": result.flagged}
        told = {"warnings": result.warnings, "shortfalls": result.shortfalls}
        print_json(paths | found | told)
    else:
        for said in result.shortfalls:
            out.print(f"not accurate enough: {said}", soft_wrap=True)
        out.print(f"results  {result.path / 'result.h5'}\nreport   {result.report}", soft_wrap=True)
        for part, count in result.flagged.items():
            out.print(f"flagged  {part}: {count} samples have no answer", soft_wrap=True)
        for warning in result.warnings:
            out.print(f"warning  {warning}", soft_wrap=True)
    if result.failures:
        lines = "\n".join(f"  {case}: {why}" for case, why in result.failures.items())
        raise LoadflowError(f"{len(result.failures)} parts have no answer:\n{lines}")


@app.command()
def plan(
    scene: SceneFile,
    loads: LoadFiles = None,
    out_folder: Annotated[Path, typer.Option("--out", help="Folder for runs.")] = Path("runs"),
    measure: Annotated[
        bool, typer.Option("--pilot", help="Measure the effects on a few samples first.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Show which stages, models and effects a scene needs, their expected time and error."""
    from loadflow.planning.pilot import pilot
    from loadflow.planning.plan import make_plan
    from loadflow.running.folder import climbs, finished_parts, known_verdict

    wanted = _read(scene, loads)
    folder = out_folder / wanted.name
    verdict = known_verdict(folder, wanted)
    if verdict is None and measure:
        with progress(quiet=as_json) as show:
            verdict = pilot(wanted, show)
    made = make_plan(wanted, climbs(folder, wanted), verdict)
    there = finished_parts(folder, made)
    steps = [
        {
            "stage": step.name,
            "rung": step.rung,
            "reason": made.reasons.get(step.name, ""),
            "runs": step.runs,
            "finished": there[step.name],
            "seconds": step.seconds and step.seconds * (1 - there[step.name] / step.runs),
            "error": step.error,
        }
        for step in made.steps
    ]
    if as_json:
        cases = [case.name for case in made.cases]
        found = {"steps": steps, "cases": cases, "left_out": made.left_out}
        told = {"errors": made.errors, "accurate": made.accurate, "shortfalls": made.shortfalls}
        print_json(found | told | {"effects": [vars(effect) for effect in made.effects]})
        return
    for said in made.shortfalls:
        out.print(f"not accurate enough: {said}", soft_wrap=True)
    heads = ("stage", "model", "chosen", "runs", "on disk", "expected time, one core", "error")
    table = Table(*heads, box=None)
    for step in steps:
        seconds = "not measured" if step["seconds"] is None else f"{step['seconds']:.0f} s"
        table.add_row(
            *(str(step[key]) for key in ("stage", "rung", "reason", "runs", "finished")),
            seconds,
            str(step["error"] or "not measured"),
        )
    out.print(table)
    out.print(f"{len(made.cases)} load cases")
    _print_errors(made)
    _print_effects(made, measured=verdict is not None)
    for stage, why in made.left_out.items():
        out.print(f"left out: {stage} ({why})", soft_wrap=True)


def _print_errors(made: Any) -> None:
    for result, errors in made.errors.items():
        sizes = (
            f"{quantity} " + ("not measured" if error is None else f"≤ {100 * error:.2g} %")
            for quantity, error in errors.items()
        )
        if errors:
            out.print(f"expected error of {result}: {', '.join(sizes)}", soft_wrap=True)


def _print_effects(made: Any, measured: bool) -> None:
    """Each effect, kept or not, and what leaving it out changes most."""
    if not made.effects:
        return
    table = Table("effect", "", "changes, measured", "changes, estimated", "why", box=None)
    for effect in made.effects:
        table.add_row(
            effect.name,
            "kept" if effect.kept else "left out",
            *map(_largest, (effect.size, effect.indicator)),
            effect.why,
        )
    out.print(table)
    if not measured:
        out.print("Effects are estimated by indicators; --pilot measures them.", soft_wrap=True)


def _largest(sizes: Any) -> str:
    """Quantity that an effect moves most, and by how much."""
    if not sizes:
        return "-"
    quantity = max(sizes, key=sizes.get)
    return f"{quantity} {100 * sizes[quantity]:.2g} %" if sizes[quantity] else "nothing"


@app.command("scene")
def show_scene(
    scene: SceneFile,
    show: Annotated[bool, typer.Option("--show", help="Print it with all defaults.")] = False,
) -> None:
    """Check a scene; with --show print it as resolved."""
    resolved = _read(scene, None)
    print(resolved.to_toml() if show else f"{scene}: valid")


@app.command()
def report(run_folder: Annotated[Path, typer.Argument(help="Folder of a run.")]) -> None:
    """Write the report page of a run again."""
    from loadflow.running.report_page import write_report

    out.print(str(write_report(run_folder)), soft_wrap=True)


@app.command()
def bench(
    stages: Annotated[list[str] | None, typer.Argument(help="Stages; default: all.")] = None,
    as_json: AsJson = False,
) -> None:
    """Show the measured speed and error of every model; `benchmarks/run` measures them anew."""
    from loadflow.planning.ladder import ladder

    known = ladder()
    if unknown := set(stages or []) - set(known):
        raise InputError(f"no stage {', '.join(sorted(unknown))}; there are {', '.join(known)}")
    chosen = {stage: known[stage] for stage in stages or known}
    if as_json:
        print_json(chosen)
        return
    table = Table("stage", "model", "relative time", "error", "against", box=None)
    for stage, rungs in chosen.items():
        for rung, entry in rungs.items():
            time = f"{entry['relative_time']:.2g}"
            table.add_row(stage, rung, time, entry["error"], entry["reference"])
    out.print(table)


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
        print_json([{"table": name, **vars(c), "ok": c.ok} for name, c in rows])
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
                check.verdict if check.ok else f"[red]{check.verdict}[/]",
            )
        out.print(table)
        compared = [check for _, check in rows if not check.refused]
        held = f"{sum(c.ok for c in compared)} of {len(compared)} within their tolerance"
        refused = len(rows) - len(compared)
        out.print(f"{held}, {refused} printed ones refused" if refused else held)
    if bad:
        raise LoadflowError(f"{bad} numbers are out of their tolerance")
