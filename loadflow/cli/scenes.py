"""Commands for scenes and their runs: run, plan, scene, report; and validate."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from loadflow.cli.base import (
    AsJson,
    CaseList,
    FrameOfChannels,
    GaugeDistance,
    NamePattern,
    OwnChannels,
    app,
    err,
    out,
    print_json,
    progress,
)
from loadflow.errors import InputError, LoadflowError

SceneFile = Annotated[Path, typer.Argument(help="Scene, a TOML file.", show_default=False)]
LoadFiles = Annotated[
    list[str] | None,
    typer.Option("--loads", help="Load files (name or quoted pattern) in place of the scene's."),
]


def _read(path: Path, loads: list[str] | None, name: str | None = None, **reading: Any) -> Any:
    from loadflow.scene.scene import read_scene, with_loads

    scene = read_scene(path)
    if loads or any(value is not None for value in reading.values()):
        scene = with_loads(scene, loads or scene.loads.files, **reading)
    return scene.model_copy(update={"name": name}) if name else scene


def _reading(
    cases: Path | None,
    pattern: str | None,
    channels: str | None,
    gauge_distance: float | None,
    frame: str | None,
) -> dict[str, Any]:
    """How load files are read, as keys of `[loads]`; None where the scene is not overruled."""
    return {
        "cases": None if cases is None else str(cases),
        "pattern": pattern,
        "channels": channels,
        "gauge_distance": gauge_distance,
        "frame": frame,
    }


@app.command()
def run(
    scene: SceneFile,
    loads: LoadFiles = None,
    out_folder: Annotated[Path, typer.Option("--out", help="Folder for runs.")] = Path("runs"),
    name: Annotated[str | None, typer.Option(help="Name of the run; default: the scene's.")] = None,
    workers: Annotated[int, typer.Option(min=0, help="Processes; 0: one for each core.")] = 0,
    scheduler: Annotated[str | None, typer.Option(help="Dask scheduler, tcp://host:port.")] = None,
    overwrite: Annotated[bool, typer.Option(help="Replace parts of other settings.")] = False,
    cases: CaseList = None,
    pattern: NamePattern = None,
    channels: OwnChannels = None,
    gauge_distance: GaugeDistance = None,
    frame: FrameOfChannels = None,
    as_json: AsJson = False,
) -> None:
    """Carry a scene out; a run that was killed goes on where it was."""
    from loadflow.running.runner import run as carry_out

    reading = _reading(cases, pattern, channels, gauge_distance, frame)
    with progress(quiet=as_json) as show:
        result = carry_out(
            _read(scene, loads, name, **reading),
            out=out_folder,
            workers=workers or len(os.sched_getaffinity(0)),
            scheduler=scheduler,
            overwrite=overwrite,
            progress=show,
        )
    if as_json:
        paths = {"path": str(result.path), "report": str(result.report)}
        found = {"failures": result.failures, "flagged": result.flagged}
        judged = {"verdicts": [verdict.as_dict() for verdict in result.verdicts]}
        print_json(paths | found | judged | {"warnings": result.warnings})
    else:
        out.print(f"results  {result.path / 'result.h5'}\nreport   {result.report}", soft_wrap=True)
        for part, count in result.flagged.items():
            out.print(f"flagged  {part}: {count} samples have no answer", soft_wrap=True)
        for verdict in result.verdicts:
            if not verdict.holds:
                out.print(f"verdict  {verdict.sentence}", soft_wrap=True, markup=False)
        for warning in result.warnings:
            out.print(f"warning  {warning}", soft_wrap=True, markup=False)
    if result.failures:
        lines = "\n".join(f"  {case}: {why}" for case, why in result.failures.items())
        raise LoadflowError(f"{len(result.failures)} parts have no answer:\n{lines}")


@app.command()
def plan(
    scene: SceneFile,
    loads: LoadFiles = None,
    out_folder: Annotated[Path, typer.Option("--out", help="Folder for runs.")] = Path("runs"),
    cases: CaseList = None,
    pattern: NamePattern = None,
    channels: OwnChannels = None,
    gauge_distance: GaugeDistance = None,
    frame: FrameOfChannels = None,
    as_json: AsJson = False,
) -> None:
    """Show which stages and models a scene needs, their expected time and error."""
    from loadflow.planning.plan import make_plan
    from loadflow.running.folder import climbs, finished_parts
    from loadflow.scene.unused import unused_keys, unused_warnings

    reading = _reading(cases, pattern, channels, gauge_distance, frame)
    wanted = _read(scene, loads, **reading)
    folder = out_folder / wanted.name
    made = make_plan(wanted, climbs(folder, wanted))
    there = finished_parts(folder, made)
    steps = [
        {
            "stage": step.stage.name,
            "rung": step.rung,
            "reason": made.reasons.get(step.stage.name, ""),
            "runs": step.runs,
            "finished": there[step.stage.name],
            "seconds": step.seconds and step.seconds * (1 - there[step.stage.name] / step.runs),
            "error": step.error,
        }
        for step in made.steps
    ]
    if as_json:
        names = [case.name for case in made.cases]
        found = {"steps": steps, "cases": names, "left_out": made.left_out}
        found |= {"unused": unused_keys(wanted)}
        print_json(found | {"errors": made.errors, "accurate": made.accurate})
        return
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
    for result, errors in made.errors.items():
        sizes = (
            f"{quantity} " + ("not measured" if error is None else f"≤ {100 * error:.2g} %")
            for quantity, error in errors.items()
        )
        if errors:
            out.print(f"expected error of {result}: {', '.join(sizes)}")
    if not made.accurate:
        unknown = any(None in errors.values() for errors in made.errors.values())
        why = (
            "not known to hold: some errors were not measured"
            if unknown
            else "not expected to hold"
        )
        out.print(f"the accuracy that the scene asks for is {why}", soft_wrap=True)
    for stage, why in made.left_out.items():
        out.print(f"left out: {stage} ({why})")
    for warning in unused_warnings(wanted):
        out.print(f"warning: {warning}", soft_wrap=True, markup=False)


@app.command("scene")
def show_scene(
    scene: SceneFile,
    show: Annotated[bool, typer.Option("--show", help="Print it with all defaults.")] = False,
) -> None:
    """Check a scene; with --show print it as resolved."""
    from loadflow.scene.unused import unused_warnings

    resolved = _read(scene, None)
    print(resolved.to_toml() if show else f"{scene}: valid")
    for warning in unused_warnings(resolved):
        err.print(f"warning: {warning}", soft_wrap=True, markup=False)


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
