"""Commands that sum up load cubes: statistics, lifetime."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

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


class Weights(StrEnum):
    """Where the shares of the lifetime come from."""

    rayleigh = "rayleigh"
    given = "given"


class TailKind(StrEnum):
    """What a tail is fitted to."""

    maxima = "maxima"
    peaks = "peaks"


@app.command()
@works_long
def statistics(
    cube: CubeFile,
    variable: Annotated[
        list[str] | None,
        typer.Option(help="Such as hub_moment.y; repeatable; default: speed and all loads."),
    ] = None,
    bearings: Annotated[
        bool, typer.Option("--bearings", help="Loads on the bearings, not at the hub.")
    ] = False,
    output: Annotated[
        Path | None, typer.Option("-o", "--output", help="Folder for tables (.csv) and a page.")
    ] = None,
    turbine: TurbineName = "nrel-5mw",
    as_json: AsJson = False,
) -> None:
    """Describe every case: mean, spread, extremes, shape; and the extreme loads of all of them.

    Beside each extreme stand the loads at the same moment, as IEC 61400-1 wants them.
    """
    from loadflow.studies.bearing_series import bearing_cube
    from loadflow.studies.lifetime.extreme_loads import contemporaneous_extremes
    from loadflow.studies.statistics import (
        EXTREME_HEADS,
        HEADS,
        extreme_records,
        extreme_row,
        statistic_records,
        statistic_row,
        write_statistics,
    )

    series = open_checked(cube)
    if bearings:
        check_turbine(series)
        series = bearing_cube(series, turbine, str(cube))
    else:
        refuse("it is that of bearing forces; give --bearings", "turbine")
    records = statistic_records(series, variable or [], str(cube))
    extremes = contemporaneous_extremes(series, source=str(cube))
    page = write_statistics(records, extremes, output, cube.name) if output else None
    if as_json:
        print_json({"statistics": records, "extremes": extreme_records(extremes)})
        return
    print_rows(HEADS, [statistic_row(record) for record in records])
    units = dict(zip(extremes["channel"].values.tolist(), extremes["units"].values.tolist()))
    print_rows(EXTREME_HEADS, [extreme_row(record, units) for record in extreme_records(extremes)])
    if page:
        out.print(f"page     {page}", soft_wrap=True)


@app.command()
@works_long
def lifetime(
    cube: CubeFile,
    output: Annotated[Path, typer.Option("-o", "--output", help="Folder to write to.")],
    bearing: Annotated[
        list[str] | None, typer.Option(help="Which bearing; repeatable; default: all.")
    ] = None,
    years: Annotated[float, typer.Option(help="Lifetime.")] = 20.0,
    return_period: Annotated[float, typer.Option(help="Of the extreme, years.")] = 50.0,
    exponent: Annotated[
        list[float] | None, typer.Option(help="Wöhler exponent; repeatable; default: 4 and 10.")
    ] = None,
    weights: Annotated[
        Weights, typer.Option(help="Shares of the cases: by wind speed, or the cube's own.")
    ] = Weights.rayleigh,
    wind_class: Annotated[str, typer.Option("--class", help="Wind class: I, II or III.")] = "I",
    per_year: Annotated[
        list[str] | None,
        typer.Option(help="How often a year a load case happens, as 3.1=1000; repeatable."),
    ] = None,
    weibull_shape: Annotated[
        float, typer.Option(help="Of the wind speeds; 2 is the Rayleigh distribution.")
    ] = 2.0,
    tail: Annotated[
        TailKind, typer.Option(help="Fit block maxima, or peaks over a threshold.")
    ] = TailKind.maxima,
    block: Annotated[
        float, typer.Option(help="Length of a block, or distance of peaks, s.")
    ] = 60.0,
    turbine: TurbineName = "nrel-5mw",
    as_json: AsJson = False,
) -> None:
    """Sum up a lifetime of each bearing: fatigue, revolutions by speed and force, extreme load."""
    from loadflow.studies.bearing_series import iter_bearings
    from loadflow.studies.lifetime.lifetimes import LifetimeOptions, lifetimes
    from loadflow.studies.lifetime.page import (
        HEADS,
        as_dict,
        share_warnings,
        summary_table,
        write_lifetime,
    )
    from loadflow.turbines import load_turbine

    source = open_checked(cube)
    if weights is Weights.given:
        refuse(
            "--weights given takes the shares of the cube",
            "wind_class", "weibull_shape", "per_year",
        )  # fmt: skip
        check_turbine(source)
    plant = load_turbine(turbine)
    options = LifetimeOptions(
        years=years,
        return_period=return_period,
        exponents=tuple(exponent or (4.0, 10.0)),
        weights=weights.value,
        wind_class=wind_class,
        weibull_shape=weibull_shape,
        operating=(plant.cut_in, plant.cut_out),
        per_year=_counts(per_year or []),
        tail=tail.value,
        block=block,
    )
    series = iter_bearings(source, bearing or [], turbine, str(cube))
    lives = list(lifetimes(series, options))
    page = write_lifetime(lives, options, output, cube.name)
    warnings = share_warnings(lives)
    if as_json:
        bearings = [as_dict(life, options) for life in lives]
        print_json({"page": str(page), "bearings": bearings, "warnings": warnings})
        return
    told = summary_table(lives, options)
    print_rows(HEADS, told.rows)
    if told.note:
        out.print(told.note, soft_wrap=True)
    for warning in warnings:
        out.print(f"warning  {warning}", soft_wrap=True)
    out.print(f"page     {page}", soft_wrap=True)


def _counts(given: list[str]) -> dict[str, float]:
    """Load cases and their numbers from ``DLC=NUMBER``."""
    counts = {}
    for item in given:
        dlc, _, number = item.partition("=")
        try:
            counts[dlc] = float(number)
        except ValueError:
            raise InputError(f"--per-year {item}: must be DLC=NUMBER, as 3.1=1000") from None
    return counts
