"""Commands for scenes and their runs: run, plan, scene, report; and validate."""

from __future__ import annotations

import tomllib
from contextlib import AbstractContextManager, ExitStack, nullcontext
from math import isnan
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.table import Table

from loadflow.cli import completing
from loadflow.cli.base import (
    AsJson,
    OtherSettings,
    OutFolder,
    RunName,
    Scheduler,
    Workers,
    app,
    caught_warnings,
    check_workers,
    err,
    out,
    print_json,
)
from loadflow.cli.progress import progress, works_long
from loadflow.cli.reading import AS_STATED, Reading, reads_load_files
from loadflow.cli.stated import refuse
from loadflow.errors import InputError, LoadflowError
from loadflow.numerics.collections import few_collections
from loadflow.numerics.fields import none_such
from loadflow.quantities import load_cases, percent

SceneFile = Annotated[
    Path,
    typer.Argument(help="Scene, a TOML file; or a turbine alone, windIO.", show_default=False),
]
LoadFiles = Annotated[
    list[str] | None,
    typer.Option("--loads", help="Load files (name or quoted pattern) in place of the scene's."),
]


def read(path: Path, loads: list[str] | None, name: str | None = None, **reading: Any) -> Any:
    """Read a scene, with other load files and under another name if they are given."""
    with few_collections():
        from loadflow.scene.changed import with_loads, with_name
        from loadflow.scene.scene import read_scene

    scene = read_scene(path)
    if loads or any(value is not None for value in reading.values()):
        scene = with_loads(scene, loads or scene.loads.files, **reading)
    return scene if name is None else with_name(scene, name)


def tell_unused(scene: Any) -> None:
    """Print what of a scene has no effect."""
    from loadflow.scene.unused import unused_warnings

    for warning in unused_warnings(scene):
        err.print(f"warning: {warning}", soft_wrap=True, markup=False)


@app.command()
@works_long
@reads_load_files
def run(
    scene: SceneFile,
    loads: LoadFiles = None,
    out_folder: OutFolder = Path("runs"),
    name: RunName = None,
    workers: Workers = 0,
    scheduler: Scheduler = None,
    overwrite: OtherSettings = False,
    reading: Reading = AS_STATED,
    profile: Annotated[
        bool, typer.Option("--profile", help="Write and print where the time went.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Carry a scene out; a run that was killed goes on where it was."""
    check_workers()
    with progress(quiet=as_json) as show:
        show(f"reading {scene}", 0, 1)
        from loadflow.running.executor import Executor, executor, usable_cores

        processes: AbstractContextManager[Executor] = executor(workers or usable_cores(), scheduler)
        with ExitStack() as begun:
            if not _was_run(scene, out_folder, name):
                # before anything else: they read their modules for seconds, as this process does
                processes = nullcontext(begun.enter_context(processes))
            with few_collections():
                from loadflow.running.profile import Profile
                from loadflow.running.runner import run_on

            result = run_on(
                processes,
                read(scene, loads, name, **reading),
                out_folder,
                overwrite=overwrite,
                say=show,
                profile=Profile() if profile else None,
            )
    if as_json:
        paths = {"path": str(result.path), "report": str(result.report)}
        found = {"failures": result.failures, "flagged": result.flagged}
        judged = {"verdicts": [verdict.as_dict() for verdict in result.verdicts]}
        told = {"warnings": result.warnings, "shortfalls": result.shortfalls}
        print_json(paths | found | judged | told)
    else:
        for said in result.shortfalls:
            out.print(f"not accurate enough: {said}", soft_wrap=True)
        out.print(f"results  {result.path / 'result.h5'}\nreport   {result.report}", soft_wrap=True)
        for part, count in result.flagged.items():
            out.print(f"flagged  {part}: {count} samples have no answer", soft_wrap=True)
        for verdict in result.verdicts:
            if not verdict.holds:
                out.print(f"verdict  {verdict.sentence}", soft_wrap=True, markup=False)
        for warning in result.warnings:
            out.print(f"warning  {warning}", soft_wrap=True, markup=False)
        if profile:
            _print_profile(result.path)
    if result.failures:
        lines = "\n".join(f"  {case}: {why}" for case, why in result.failures.items())
        raise LoadflowError(f"{len(result.failures)} parts have no answer:\n{lines}")


def _was_run(scene: Path, out_folder: Path, name: str | None) -> bool:
    """Whether there are results of a run of that name: if nothing is left to do, none works."""
    if name is None:
        try:
            name = str(tomllib.loads(scene.read_text(encoding="utf-8")).get("name", scene.stem))
        except (OSError, ValueError):  # no TOML: what is wrong with it is told as it is read
            return False
    return (out_folder / name / "result.h5").is_file()


def _print_profile(folder: Path) -> None:
    """Print where the time of a run went."""
    from loadflow.running.pages.profile import profile_tables

    for found in profile_tables(folder):
        table = Table(*found.heads, box=None)
        for row in found.rows:
            table.add_row(*row)
        out.print(table)


@app.command()
@works_long
@reads_load_files
def plan(
    scene: SceneFile,
    loads: LoadFiles = None,
    out_folder: OutFolder = Path("runs"),
    reading: Reading = AS_STATED,
    measure: Annotated[
        bool, typer.Option("--pilot", help="Measure the effects on a few samples first.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Show which stages, models and effects a scene needs, their expected time and error."""
    from loadflow.planning.pilot import pilot
    from loadflow.planning.plan import make_plan
    from loadflow.planning.seeds_wanted import seeds_wanted, sentences
    from loadflow.planning.shortfalls import found_shortfalls
    from loadflow.running.folder import finished_parts, known_verdict, refinements, results_of
    from loadflow.scene.unused import (
        asks_for_friction,
        friction_note,
        unused_keys,
        unused_warnings,
    )

    if not measure:
        refuse("only --pilot works long", "verbose")
    wanted = read(scene, loads, **reading)
    folder = out_folder / wanted.name
    verdict = known_verdict(folder, wanted)
    if verdict is None and measure:
        with progress(quiet=as_json) as show:
            verdict = pilot(wanted, show)
    made = make_plan(wanted, refinements(folder, wanted), verdict)
    there = finished_parts(folder, made)
    tables = results_of(folder) if all(there[s.name] == s.runs for s in made.steps) else None
    checked = (tables or {}).get("check")
    short = [
        *([] if checked is None else found_shortfalls(wanted, made.scene, checked)),
        *made.shortfalls,
    ]
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
        names = [case.name for case in made.cases]
        found = {"steps": steps, "cases": names, "left_out": made.left_out}
        found |= {"unused": unused_keys(wanted), "taken": wanted.taken}
        told = {"errors": made.errors, "accurate": made.accurate, "shortfalls": short}
        told |= {
            "overloaded": made.overloaded,
            "seeds": [vars(one) for one in seeds_wanted(made, tables)],
        }
        print_json(found | told | {"effects": [vars(effect) for effect in made.effects]})
        return
    for said in short:
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
    out.print(load_cases(len(made.cases)))
    _print_errors(made)
    for said in sentences(seeds_wanted(made, tables)):
        out.print(said, soft_wrap=True)
    _print_effects(made, measured=verdict is not None)
    for stage, why in made.left_out.items():
        out.print(f"left out: {stage} ({why})", soft_wrap=True)
    if wanted.candidates:
        listed = ", ".join(wanted.candidates)
        out.print(
            f"candidates are no part of this plan: {listed}; loadflow compare runs them",
            soft_wrap=True, markup=False,
        )  # fmt: skip
    doubts = friction_note(wanted) if asks_for_friction(wanted) else ()
    for warning in [*made.overloaded, *wanted.taken, *doubts, *unused_warnings(wanted)]:
        out.print(f"warning: {warning}", soft_wrap=True, markup=False)


def _print_errors(made: Any) -> None:
    for result, errors in made.errors.items():
        sizes = (
            f"{quantity} " + ("not measured" if error is None else f"≤ {percent(error)}")
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
    if untold := [quantity for quantity, size in sizes.items() if isnan(size)]:
        return f"{untold[0]} not known"
    quantity = max(sizes, key=sizes.get)
    return f"{quantity} {percent(sizes[quantity])}" if sizes[quantity] else "nothing"


@app.command("scene")
def show_scene(
    scene: Annotated[Path | None, typer.Argument(help="Scene, a TOML file.")] = None,
    show: Annotated[bool, typer.Option("--show", help="Print it with all defaults.")] = False,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print the JSON Schema of scenes, for editors.")
    ] = False,
) -> None:
    """Check a scene; with --show print it as resolved, in the form of today."""
    if schema:
        refuse("--schema is that of all scenes", "scene", "show")
        import json

        from loadflow.scene.schema import json_schema

        print(json.dumps(json_schema(), indent=1))
        return
    if scene is None:
        raise InputError("give a scene, or --schema")
    from loadflow.scene.scene import former_sections

    resolved = read(scene, None)
    print(resolved.to_toml() if show else f"{scene}: valid")
    if not show and (former := former_sections(scene)):
        names = " and ".join(f"[{name}]" for name in former)
        out.print(
            f"{names}: still read; today's form is [bearings.PLACE], as `loadflow scene --show` "
            "prints it",
            soft_wrap=True, markup=False,
        )  # fmt: skip
    tell_unused(resolved)


@app.command()
def report(
    run_folder: Annotated[Path, typer.Argument(help="Folder of a run.")],
    overwrite: Annotated[
        bool, typer.Option("--overwrite", help="Write it though nothing has changed.")
    ] = False,
) -> None:
    """Write the report page of a run again, if its results have changed."""
    from loadflow.running.report_state import report_is_current

    if (run_folder / "result.h5").exists() and not overwrite and report_is_current(run_folder):
        out.print(str(run_folder / "report.html"), soft_wrap=True)
        err.print("nothing has changed since it was written; --overwrite writes it again")
        return
    from loadflow.running.pages.report import write_report

    out.print(str(write_report(run_folder, overwrite)), soft_wrap=True)


@app.command()
def bench(
    stages: Annotated[list[str] | None, typer.Argument(help="Stages; default: all.")] = None,
    as_json: AsJson = False,
) -> None:
    """Show the measured speed and error of every model; `benchmarks/run` measures them anew."""
    from loadflow.planning.ladder import ladder

    known = ladder()
    if unknown := set(stages or []) - set(known):
        raise InputError(none_such("stage", sorted(unknown), known))
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
    names: Annotated[
        list[str] | None,
        typer.Argument(help="Tables; default: all.", autocompletion=completing.tables),
    ] = None,
    failed: Annotated[
        bool, typer.Option("--failed", help="Show only the numbers that are out of tolerance.")
    ] = False,
    summary: Annotated[
        bool, typer.Option("--summary", help="Show only the counts, by kind of evidence.")
    ] = False,
    folder: Annotated[
        Path | None,
        typer.Option(help="Clones, OWNER/NAME, for the numbers of files that are not shipped."),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Print the sources' numbers beside ours; fails if one is out of its tolerance."""
    from loadflow import validation

    known = validation.names()
    if unknown := set(names or []) - set(known):
        raise InputError(none_such("table", sorted(unknown), known))
    if folder and not names:
        raise InputError("--folder: name the table whose numbers need the files, e.g. turbines")
    tables = names or known
    rows: list[tuple[str, Any]] = []
    with progress(quiet=as_json) as show, caught_warnings():  # the rows say what they hold
        for k, name in enumerate(tables):
            show("tables", k, len(tables))
            rows += [(name, check) for check in validation.all_checks(name, folder)]
        show("tables", len(tables), len(tables))
    bad = sum(check.outcome == "out" for _, check in rows)
    shown = [row for row in rows if not failed or row[1].outcome == "out"]
    if as_json and summary:
        print_json(validation.counts(check for _, check in rows))
    elif as_json:
        print_json([{"table": n, **vars(c), "ok": c.ok, "outcome": c.outcome} for n, c in shown])
    else:
        if shown and not summary:
            out.print(_table_of(shown))
        out.print(_counts_of([check for _, check in rows]))
        if any(check.outcome in ("refused", "missed") for _, check in rows):
            out.print(
                "refused: the print contradicts the source's own data; missed: ours is off, for a "
                "reason that stands at the number"
            )
    if bad:
        raise LoadflowError(f"{bad} numbers are out of their tolerance")


def _table_of(rows: list[tuple[str, Any]]) -> Table:
    """Rows of validation tables, each with the name of its table."""
    heads = ("table", "number", "source", "evidence", "expected", "ours", "deviation", "allowed")
    table = Table(*heads, "")
    for name, check in rows:
        scale, sign = (1, "") if check.kind == "absolute" else (100, " %")
        table.add_row(
            name,
            check.name,
            check.source,
            check.evidence,
            f"{check.expected:.6g} {check.unit}",
            f"{check.got:.6g} {check.unit}",
            f"{check.deviation * scale:+.3g}{sign}",
            f"{check.tolerance * scale:.3g}{sign}",
            f"[red]{check.verdict}[/]" if check.outcome == "out" else check.verdict,
        )
    return table


def _counts_of(rows: list[Any]) -> Table:
    """How many numbers came out how, by what they are held against."""
    from loadflow.validation import OUTCOMES, counts

    table = Table("evidence", "numbers", "within tolerance", *OUTCOMES[1:], box=None)
    for kind, found in counts(rows).items():
        table.add_row(kind, str(sum(found.values())), *(str(n) for n in found.values()))
    total = (sum(row.outcome == outcome for row in rows) for outcome in OUTCOMES)
    table.add_row("all", str(len(rows)), *(str(n) for n in total))
    return table
