"""Commands that process load cubes: seeds, reduce."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from loadflow.cli.base import (
    AsJson,
    CubeFile,
    TurbineName,
    app,
    check_turbine,
    open_checked,
    out,
    print_json,
    print_rows,
)
from loadflow.cli.progress import works_long
from loadflow.cli.stated import refuse
from loadflow.errors import InputError

if TYPE_CHECKING:
    from loadflow.cube import Cube
    from loadflow.scene.journal import Journal


class Test(StrEnum):
    """How seeds are tested."""

    as_printed = "as-printed"
    calibrated = "calibrated"


class Kind(StrEnum):
    """Kinds of design load."""

    histogram = "histogram"
    stationary = "stationary"
    periodic = "periodic"


class Grid(StrEnum):
    """Whose classes a histogram has."""

    each = "each"
    cube = "cube"


class Pick(StrEnum):
    """How the members of a class are picked."""

    random = "random"
    extremes = "extremes"
    envelope = "envelope"


class Rounding(StrEnum):
    """How the number kept of a class is rounded."""

    up = "up"
    nearest = "nearest"
    total = "total"


@app.command()
@works_long
def seeds(
    cube: CubeFile,
    variable: Annotated[
        list[str] | None,
        typer.Option(help="What to test, such as hub_moment.y; repeatable; default: all loads."),
    ] = None,
    bearings: Annotated[
        bool, typer.Option("--bearings", help="Test the forces on the bearings, not at the hub.")
    ] = False,
    alpha: Annotated[float, typer.Option(help="Level of significance.")] = 0.05,
    method: Annotated[Test, typer.Option(help="Of the tests.")] = Test.calibrated,
    margin: Annotated[float, typer.Option(help="Of equivalent seeds, relative.")] = 0.05,
    uncertainty: Annotated[
        float, typer.Option(help="Wanted of a mean over seeds, relative.")
    ] = 0.05,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Page with figures to write, .html.")
    ] = None,
    turbine: TurbineName = "nrel-5mw",
    as_json: AsJson = False,
) -> None:
    """Test for each wind speed and load component whether its seeds are equal.

    Then group the seeds of each wind speed: those of one group may be merged.
    """
    from loadflow.studies.bearing_series import bearing_cube
    from loadflow.studies.seeds.page import write_seed_page
    from loadflow.studies.seeds.verdicts import (
        HEADS,
        as_row,
        count_different,
        groupings,
        seed_verdicts,
    )

    if not output:
        refuse("only the page tells it; give -o", "margin", "uncertainty")
    series = open_checked(cube)
    if bearings:
        check_turbine(series)
        series = bearing_cube(series, turbine, str(cube))
    else:
        refuse("it is that of bearing forces; give --bearings", "turbine")
    options: dict[str, Any] = {"alpha": alpha, "method": method.value, "source": str(cube)}
    verdicts = seed_verdicts(series, variable or [], **options)
    groups = groupings(series, verdicts)
    if output:
        write_seed_page(
            output, series, verdicts, groups, margin=margin, uncertainty=uncertainty,
            source=cube.name,
        )  # fmt: skip
    if as_json:
        print_json([verdict.as_dict() for verdict in verdicts])
        return
    print_rows(HEADS, [as_row(verdict) for verdict in verdicts])
    out.print(f"{count_different(verdicts)}; {method.value}, α = {alpha:g}; * differs by itself")
    for text in groups.values():
        out.print(text, soft_wrap=True, highlight=False)
    if output:
        out.print(f"page     {output}", soft_wrap=True)


@app.command("reduce")
@works_long
def reduce_series(
    cube: CubeFile,
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder to write to.")],
    method: Annotated[Kind, typer.Option(help="Kind of design load.")] = Kind.histogram,
    size: Annotated[float, typer.Option(help="Histogram: share of each series to keep.")] = 0.1,
    pick: Annotated[
        Pick, typer.Option(help="Histogram: of the members of a class.")
    ] = Pick.extremes,
    rounding: Annotated[
        Rounding, typer.Option(help="Histogram: of the number kept of a class.")
    ] = Rounding.up,
    classes: Annotated[
        tuple[int, int] | None, typer.Option(help="Histogram: classes of speed and of force.")
    ] = None,
    phase: Annotated[
        str,
        typer.Option(
            help="Histogram: only standstill, run-up, operation, run-down or 'part speed'; or each."
        ),
    ] = "",
    between: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Histogram: only the samples of these times, s."),
    ] = None,
    grid: Annotated[
        Grid, typer.Option(help="Histogram: classes of each series, or of the whole cube.")
    ] = Grid.each,
    seed: Annotated[int, typer.Option(min=0, help="Histogram: of the random pick.")] = 0,
    bounds: Annotated[
        tuple[float, float] | None,
        typer.Option(help="Periodic: slow and fast bound, Hz; default: ask the film."),
    ] = None,
    additional: Annotated[int, typer.Option(min=0, help="Periodic: loads on each axis.")] = 2,
    order: Annotated[
        list[float] | None,
        typer.Option(help="Periodic: take this multiple of the rotor's frequency; repeatable."),
    ] = None,
    scene: Annotated[
        Path | None,
        typer.Option(help="Scene whose journal bearing is asked; default: a reference bearing."),
    ] = None,
    film: Annotated[
        bool,
        typer.Option(
            "--film",
            help="Histogram: compare the films of full and reduced; others: solve the film under "
            "the design loads, periodic ones round the orbit that closes.",
        ),
    ] = False,
    bearing: Annotated[
        list[str] | None, typer.Option(help="Which bearing; repeatable; default: all.")
    ] = None,
    turbine: TurbineName = "nrel-5mw",
    as_json: AsJson = False,
) -> None:
    """Turn the radial force of each bearing in each case into design loads; write files and a page.

    histogram: fewer samples of the same load character; stationary: constant loads; periodic: mean
    and harmonics that the bearing feels. A cube of hub loads alone gets its bearing forces from the
    default suspension on two points.
    """
    source = open_checked(cube)
    check_turbine(source)
    for kind, options_of in _OF_METHOD.items():
        if method is not kind:
            refuse(f"give --method {kind.value}", *options_of)
    if order:
        refuse("--order says which harmonics there are", "additional")
    where: dict[str, Any] = {"bearings": bearing or [], "turbine": turbine, "source": str(cube)}
    if method is Kind.stationary:
        _stationary(source, output, where, _journal(scene) if film or scene else None, as_json)
    elif method is Kind.periodic:
        options = {"bounds": bounds, "additional": additional, "orders": order}
        _periodic(source, output, where, options, scene, film, as_json)
    else:
        histogram: dict[str, Any] = {"size": size, "pick": pick.value, "rounding": rounding.value}
        histogram |= {"classes": classes, "seed": seed}
        where |= {"between": between, "grid": grid.value}
        asked = {"phase": phase, "journal": _journal(scene) if film or scene else None}
        _histogram(source, output, where | asked, histogram, as_json)


_OF_METHOD = {
    Kind.histogram: ("size", "pick", "rounding", "classes", "phase", "between", "grid", "seed"),
    Kind.periodic: ("bounds", "additional", "order"),
}
"""Options that one method alone reads."""


def _journal(scene: Path | None) -> Journal:
    """The journal bearing of a scene, or the reference bearing."""
    from loadflow.scene.journal import Journal
    from loadflow.scene.scene import read_scene

    return Journal() if scene is None else read_scene(scene).journal


def _histogram(
    cube: Cube,
    folder: Path,
    where: dict[str, Any],
    options: dict[str, Any],
    as_json: bool,
) -> None:
    from loadflow.studies.design_loads.reduced_series import (
        FILM_HEADS,
        HEADS,
        as_row,
        film_rows,
        reduce_cube,
        write_reduction_page,
    )

    made = reduce_cube(cube, folder, options=options, **where)
    page = write_reduction_page(folder / "reduction.html", made, source=Path(where["source"]).name)
    if as_json:
        parts = [part.as_dict() for part in made.parts]
        whole = {
            name: {
                "full": int(one["counts_full"].sum()),
                "reduced": int(one["counts_reduced"].sum()),
            }
            for name, one in made.whole.items()
        }
        told = {"suspension": made.suspension, "page": str(page), "series": parts}
        told |= {"warnings": made.warnings}
        print_json(told | ({"whole_cube": whole} if whole else {}))
        return
    out.print(f"bearing forces: {made.suspension}", soft_wrap=True, highlight=False)
    print_rows(HEADS, [as_row(part) for part in made.parts])
    if rows := film_rows(made.parts):
        print_rows(FILM_HEADS, rows)
    for warning in made.warnings:
        out.print(f"warning  {warning}", soft_wrap=True, highlight=False)
    out.print(f"page     {page}", soft_wrap=True)


def _stationary(
    cube: Cube, folder: Path, where: dict[str, Any], journal: Journal | None, as_json: bool
) -> None:
    from loadflow.studies.bearing_series import iter_bearings
    from loadflow.studies.design_loads.films import HEADS, as_row, stationary_films
    from loadflow.studies.design_loads.tables import (
        STATIONARY_HEADS,
        stationary_row,
        stationary_rows,
        write_stationary,
    )

    rows, films = [], []
    for series in iter_bearings(cube, **where):
        rows += stationary_rows(series)
        films += [] if journal is None else stationary_films(series, journal)
    file = write_stationary(rows, folder)
    if as_json:
        print_json({"file": str(file), "loads": rows} | ({"films": films} if films else {}))
        return
    print_rows(STATIONARY_HEADS, [stationary_row(row) for row in rows])
    if films:
        print_rows(HEADS, [as_row(film) for film in films])
    out.print(f"table    {file}", soft_wrap=True)


def _periodic(
    cube: Cube,
    folder: Path,
    where: dict[str, Any],
    options: dict[str, Any],
    scene: Path | None,
    film: bool,
    as_json: bool,
) -> None:
    from loadflow.studies.bearing_series import iter_bearings
    from loadflow.studies.design_loads.films import HEADS, as_row, periodic_film
    from loadflow.studies.design_loads.tables import PERIODIC_HEADS, periodic_parts, write_periodic
    from loadflow.turbines import load_turbine

    if scene is not None and options["bounds"] and not film:
        raise InputError(
            "give either --bounds or --scene, whose bearing would find them, or both with --film"
        )
    journal = None if options["bounds"] else _journal(scene)
    named = load_turbine(where["turbine"]).frequencies
    series = iter_bearings(cube, **where)
    parts = list(periodic_parts(series, journal=journal, named=named, **options))
    page = write_periodic(parts, folder, Path(where["source"]).name)
    films = [periodic_film(part, _journal(scene)) for part in parts] if film else []
    if as_json:
        found: dict[str, Any] = {"page": str(page), "loads": [part.as_dict() for part in parts]}
        print_json(found | ({"films": films} if films else {}))
        return
    print_rows(PERIODIC_HEADS, [row for part in parts for row in part.rows()])
    if films:
        print_rows(HEADS, [as_row(film) for film in films])
    out.print(f"page     {page}", soft_wrap=True)
