"""Commands that answer for one point: wind, journal, rolling."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any

import typer

from loadflow.cli import completing
from loadflow.cli.base import AsJson, app, out, print_json, print_quantities, print_rows
from loadflow.cli.stated import refuse
from loadflow.errors import InputError
from loadflow.quantities import CELSIUS


@app.command("wind")
def wind_conditions(
    wind_speed: Annotated[float, typer.Argument(metavar="V", help="Mean at the hub, m/s.")],
    category: Annotated[str, typer.Option(help="Turbulence: A+, A, B or C.")] = "B",
    wind_class: Annotated[str, typer.Option("--class", help="Wind class: I, II or III.")] = "I",
    diameter: Annotated[float, typer.Option(help="Of the rotor, m.")] = 126.0,
    hub_height: Annotated[float, typer.Option(help="Above ground, m.")] = 90.0,
    as_json: AsJson = False,
) -> None:
    """Show the wind conditions of IEC 61400-1 at a wind speed."""
    from loadflow.studies.wind_conditions import iec_conditions

    print_quantities(
        iec_conditions(
            wind_speed,
            wind_class=wind_class,
            category=category,
            rotor_diameter=diameter,
            hub_height=hub_height,
        ),
        as_json,
    )


@app.command()
def journal(
    diameter: Annotated[float | None, typer.Option(help="Bore D, m.")] = None,
    width: Annotated[float | None, typer.Option(help="Width B, m.")] = None,
    relative_clearance: Annotated[
        float | None, typer.Option(help="ψ: clearance over diameter.")
    ] = None,
    viscosity: Annotated[float | None, typer.Option(help="Dynamic, Pa s.")] = None,
    oil: Annotated[
        str | None,
        typer.Option(
            help="Oil that its own friction warms, in place of a viscosity: a name.",
            autocompletion=completing.oils,
        ),
    ] = None,
    inlet_temperature_c: Annotated[
        float, typer.Option(help="Of the oil that enters the film, °C; with --oil.")
    ] = 40.0,
    transfer: Annotated[
        float, typer.Option(help="Heat through the housing, W/K, into air of 20 °C; with --oil.")
    ] = 0.0,
    force_x: Annotated[
        float | None, typer.Option(help="Of the shaft on the bearing, first axis (down), N.")
    ] = None,
    force_y: Annotated[
        float, typer.Option(help="Second axis, the one the first turns to, N.")
    ] = 0.0,
    speed_rpm: Annotated[float | None, typer.Option(help="Speed of the shaft, 1/min.")] = None,
    series: Annotated[
        Path | None,
        typer.Option(help="Parameter file, in place of one force and speed.", show_default=False),
    ] = None,
    edge_pressure: Annotated[
        float | None, typer.Option(help="At the bearing ends, absolute, Pa; default 0.")
    ] = None,
    law: Annotated[
        str | None,
        typer.Option(
            help="Of the ruptured film: gas-mixture, sommerfeld, guembel, reynolds or "
            "mass-conserving; default Reynolds' condition, or the mixture with its constant."
        ),
    ] = None,
    mixing_constant: Annotated[float | None, typer.Option(help="Of the gas mixture, Pa.")] = None,
    cavitation_pressure: Annotated[
        float | None, typer.Option(help="Of the other laws, absolute, Pa; default 0.")
    ] = None,
    rung: Annotated[
        str | None,
        typer.Option(
            help="Model: grid, reduced, map, chart, table, butenschoen, holland or hahn; default "
            "grid."
        ),
    ] = None,
    inlet: Annotated[
        str | None,
        typer.Option(help='Line of fresh oil: "auto", "widest gap" or "none"; default auto.'),
    ] = None,
    scene: Annotated[
        Path | None,
        typer.Option(help="Take bearing and film from this scene; other options change them."),
    ] = None,
    sets: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=VALUE",
            help="Any key of a scene's \\[journal], as in TOML: --set "
            '\'geometry.shape = {kind = "lobes", count = 3}\', --set \'shell = {kind = "local", '
            "compliance = 1e-12}'; once for each.",
        ),
    ] = None,
    grid: Annotated[
        tuple[int, int] | None, typer.Option(help="Cells around and across the full width.")
    ] = None,
    groove_angle_deg: Annotated[
        list[float] | None,
        typer.Option(help="Middle of an axial groove, from the first axis, °; once for each."),
    ] = None,
    groove_arc_deg: Annotated[float, typer.Option(help="Arc of a groove, °; 0: a line.")] = 0.0,
    groove_length: Annotated[
        float | None, typer.Option(help="Of a groove, m; default the full width.")
    ] = None,
    supply_pressure: Annotated[
        float | None, typer.Option(help="In the grooves, absolute, Pa; default that at its ends.")
    ] = None,
    coefficients: Annotated[
        Path | None,
        typer.Option(
            help="Table of stiffness and damping to write, .csv, with the columns of ROSS; its "
            "rows are --speed-rpm, or --over-rpm."
        ),
    ] = None,
    over_rpm: Annotated[
        tuple[float, float, int] | None,
        typer.Option(help="Speeds of --coefficients: first, last (1/min), and how many."),
    ] = None,
    whirl: Annotated[
        float | None,
        typer.Option(
            help="Frequency of the vibration over the speed, for tilting pads; with "
            "--coefficients, default 1."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Solve the film of a journal bearing for one load, or for a reduced series."""
    from loadflow.studies.one_bearing.journal import (
        journal_coefficients,
        journal_point,
        journal_series,
    )
    from loadflow.studies.one_bearing.journal_film import journal_film

    if oil is None:
        refuse("the oil has one viscosity; give --oil", "inlet_temperature_c", "transfer")
    if not groove_angle_deg:
        refuse(
            "say where the grooves are: --groove-angle-deg, once for each",
            "groove_arc_deg", "groove_length", "supply_pressure",
        )  # fmt: skip
    bearing, film = journal_film(
        scene,
        sets or [],
        geometry={
            "diameter": diameter,
            "width": width,
            "relative_clearance": relative_clearance,
        },
        viscosity=viscosity,
        heat={
            "oil": oil,
            "inlet_temperature": inlet_temperature_c + CELSIUS,
            "transfer": transfer,
        },
        law={
            "kind": law,
            "mixing_constant": mixing_constant,
            "cavitation_pressure": cavitation_pressure,
        },
        grooves={
            "angles": [math.radians(angle) for angle in groove_angle_deg or []],
            "arc": math.radians(groove_arc_deg),
            "length": groove_length,
            "pressure": supply_pressure,
        },
        keys={"edge_pressure": edge_pressure, "rung": rung, "inlet": inlet, "grid": grid},
    )
    if coefficients is None:
        refuse("they are of a table: give its file with --coefficients", "over_rpm", "whirl")
    else:
        if not bearing.has_pads:
            refuse("K and C of a bore without tilting pads are one at every frequency", "whirl")
        if rung != "grid":
            refuse("K and C over speed are those of the rung grid", "rung")
        if series is not None or force_x is None:
            raise InputError("--coefficients: give one load with --force-x, no --series")
        rows = _speeds(speed_rpm, over_rpm)
        share = 1.0 if whirl is None else whirl
        table = journal_coefficients(coefficients, (force_x, force_y), rows, bearing, film, share)
        _show_coefficients(coefficients, table, share, as_json)
        return
    if series is not None:
        refuse("--series brings its own loads", "force_x", "force_y", "speed_rpm")
        answer = journal_series(series, bearing, film)
    elif force_x is None or speed_rpm is None:
        raise InputError("give --force-x and --speed-rpm, or a parameter file with --series")
    else:
        force, speed = (force_x, force_y), speed_rpm * math.pi / 30
        answer = journal_point(force, speed, bearing, film)
    print_quantities(answer, as_json)


def _speeds(
    speed_rpm: float | None, over_rpm: tuple[float, float, int] | None
) -> tuple[float, float, int]:
    """First and last speed of a table, rad/s, and how many."""
    if (speed_rpm is None) == (over_rpm is None):
        raise InputError("--coefficients: give either --speed-rpm or --over-rpm")
    rows = (speed_rpm, speed_rpm, 1) if speed_rpm is not None else over_rpm
    assert rows is not None
    first, last, count = rows
    if count < 1 or (count > 1 and not 0 < first < last):
        raise InputError(f"--over-rpm {first:g} {last:g} {count}: 0 < first < last, one or more")
    return first * math.pi / 30, last * math.pi / 30, count


def _show_coefficients(
    file: Path, table: list[dict[str, float]], whirl: float, as_json: bool
) -> None:
    if as_json:
        print_json({"file": str(file), "whirl": whirl, "rows": table})
        return
    print_rows(tuple(table[0]), [[f"{value:.4g}" for value in row.values()] for row in table])
    share = "" if whirl == 1.0 else f"{whirl:g} of "
    out.print(f"of a vibration at {share}the speed")
    out.print(f"table    {file}", soft_wrap=True)


@app.command()
def rolling(
    balls: Annotated[int | None, typer.Option(help="Balls in each row.")] = None,
    ball_diameter: Annotated[float | None, typer.Option(help="m.")] = None,
    pitch_diameter: Annotated[float | None, typer.Option(help="m.")] = None,
    groove_radius: Annotated[float | None, typer.Option(help="Of both rings, m.")] = None,
    contact_angle_deg: Annotated[float | None, typer.Option(help="Nominal, °; default 45.")] = None,
    rows: Annotated[int | None, typer.Option(help="Rows of balls; default 1.")] = None,
    row_spacing: Annotated[float | None, typer.Option(help="Of neighbouring rows, m.")] = None,
    clearance: Annotated[float | None, typer.Option(help="Axial, < 0 for preload, m.")] = None,
    hardness: Annotated[float | None, typer.Option(help="Of raceways, HV; default 700.")] = None,
    life_hardness_factor: Annotated[
        float | None, typer.Option(help="On the dynamic capacity, of soft raceways; default 1.")
    ] = None,
    inner_ring: Annotated[
        tuple[float, float, float] | None,
        typer.Option(help="Flexible: width, height of its section, radius of the centroid, m."),
    ] = None,
    outer_ring: Annotated[
        tuple[float, float, float] | None, typer.Option(help="The same of the outer ring.")
    ] = None,
    wall: Annotated[
        tuple[float, float] | None,
        typer.Option(
            help="Thickness and length of the walls that flexible rings stand on, the outer one "
            "below, the inner one above, m; without it they float."
        ),
    ] = None,
    scene: Annotated[
        Path | None, typer.Option(help="Take bearing and rings from this scene instead.")
    ] = None,
    bearing: Annotated[
        str | None,
        typer.Option(help="Which one of the scene, of a candidate as NAME.N; default its first."),
    ] = None,
    force_x: Annotated[float, typer.Option(help="On the inner ring, radial, N.")] = 0.0,
    force_y: Annotated[float, typer.Option(help="Radial, N.")] = 0.0,
    force_z: Annotated[float, typer.Option(help="Along the axis, N.")] = 0.0,
    moment_x: Annotated[float, typer.Option(help="Tilting, N m.")] = 0.0,
    moment_y: Annotated[float, typer.Option(help="Tilting, N m.")] = 0.0,
    speed_rpm: Annotated[
        float | None, typer.Option(help="Speed, 1/min; gives the life in hours.")
    ] = None,
    oil: Annotated[
        str | None,
        typer.Option(
            help="A lubricant by name; gives the modified life of ISO 281.",
            autocompletion=completing.oils,
        ),
    ] = None,
    temperature_c: Annotated[float, typer.Option(help="Of the bearing, °C; with --oil.")] = 50.0,
    cleanliness: Annotated[
        str, typer.Option(help="System and class of ISO 281 annex A; with --oil.")
    ] = "grease, normal cleanliness",
    coefficients: Annotated[
        Path | None,
        typer.Option(
            help="Table of stiffness and damping to write, .csv, with the columns of ROSS, of the "
            "aligned bearing with rigid rings; its rows are --speed-rpm, or --over-rpm. With --oil "
            "contacts have films."
        ),
    ] = None,
    over_rpm: Annotated[
        tuple[float, float, int] | None,
        typer.Option(help="Speeds of --coefficients: first, last (1/min), and how many."),
    ] = None,
    loss: Annotated[
        float,
        typer.Option(help="Share of its stiffness that the steel loses; with --coefficients."),
    ] = 0.01,
    whirl: Annotated[
        float | None,
        typer.Option(
            help="Frequency of the vibration over the speed, for what steel and films lose; with "
            "--coefficients, default 1."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Share a load between the balls of a four-point slewing bearing, or a bearing of a scene."""
    from loadflow.rolling import Lubrication
    from loadflow.studies.one_bearing.rolling import (
        bearing_of_scene,
        rolling_coefficients,
        rolling_point,
        slewing_bearing,
    )
    from loadflow.tribology import lubricant

    measures: dict[str, Any] = {
        "balls": balls,
        "ball_diameter": ball_diameter,
        "pitch_diameter": pitch_diameter,
        "groove_radius": groove_radius,
        "contact_angle_deg": contact_angle_deg,
        "rows": rows,
        "row_spacing": row_spacing,
        "clearance": clearance,
        "hardness": hardness,
        "life_hardness_factor": life_hardness_factor,
    }
    rings, inertia = {"inner_ring": inner_ring, "outer_ring": outer_ring, "wall": wall}, False
    given = {name: value for name, value in (measures | rings).items() if value is not None}
    options = ", ".join(f"--{name.replace('_', '-')}" for name in given)
    if scene is not None:
        if given:
            raise InputError(f"--scene brings bearing and rings: leave out {options}")
        part = bearing_of_scene(scene, bearing)
        found, inertia = (part.modelled, part.ring_model), part.inertia
    elif bearing is not None:
        raise InputError("--bearing names a bearing of a scene: give --scene")
    else:
        if rows in (None, 1):
            refuse("the bearing has one row; give --rows", "row_spacing")
        found = slewing_bearing(**given)
    if oil is None:
        refuse("they count with an oil; give --oil", "temperature_c", "cleanliness")
    force, moment = (force_x, force_y, force_z), (moment_x, moment_y)
    if coefficients is None:
        refuse(
            "they are of a table: give its file with --coefficients", "over_rpm", "loss", "whirl"
        )
    else:
        refuse("K and C over speed are those of rigid rings", "inner_ring", "outer_ring", "wall")
        refuse(
            "the table has no safety and no life",
            "hardness", "life_hardness_factor", "cleanliness",
        )  # fmt: skip
        warm = None if oil is None else (oil, temperature_c + CELSIUS)
        share = 1.0 if whirl is None else whirl
        table = rolling_coefficients(
            coefficients, found[0], force, moment, _speeds(speed_rpm, over_rpm), warm, loss, share
        )
        _show_coefficients(coefficients, table, share, as_json)
        return
    speed = None if speed_rpm is None else speed_rpm * math.pi / 30
    lubrication = None
    if oil is not None:
        lubrication = Lubrication(
            oil=lubricant(oil), temperature=temperature_c + CELSIUS, cleanliness=cleanliness
        )
    answer = rolling_point(
        *found, force, moment, speed=speed, lubrication=lubrication, inertia=inertia
    )
    print_quantities(answer, as_json)
