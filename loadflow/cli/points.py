"""Commands that answer for one point: wind, journal, rolling."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated

import typer

from loadflow.cli.base import AsJson, app, print_quantities
from loadflow.errors import InputError


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
    from loadflow.stages.points import iec_conditions

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
    diameter: Annotated[float, typer.Option(help="Bore D, m.", show_default=False)],
    width: Annotated[float, typer.Option(help="Width B, m.", show_default=False)],
    relative_clearance: Annotated[
        float, typer.Option(help="ψ: clearance over diameter.", show_default=False)
    ],
    viscosity: Annotated[float, typer.Option(help="Dynamic, Pa s.", show_default=False)],
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
    edge_pressure: Annotated[float, typer.Option(help="At the rims, absolute, Pa.")] = 0.0,
    mixing_constant: Annotated[
        float | None, typer.Option(help="Of the gas mixture, Pa; without it: Reynolds' condition.")
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
        float | None, typer.Option(help="In the grooves, absolute, Pa; default that at the rims.")
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Solve the film of a plain journal bearing for one load, or for a reduced series."""
    from loadflow.journal import GasMixture, Groove, JournalBearing, Lubricant, Supply
    from loadflow.stages.points import journal_point, journal_series

    bearing = JournalBearing(diameter, width, relative_clearance)
    lubricant = Lubricant(viscosity)
    cavitation = None if mixing_constant is None else GasMixture(mixing_constant)
    supply = None
    if groove_angle_deg:
        pressure = edge_pressure if supply_pressure is None else supply_pressure
        arc = math.radians(groove_arc_deg)
        angles = map(math.radians, groove_angle_deg)
        supply = Supply(tuple(Groove(angle, arc, groove_length, pressure) for angle in angles))
    elif supply_pressure is not None or groove_length is not None or groove_arc_deg:
        raise InputError("say where the grooves are: --groove-angle-deg, once for each")
    film = (bearing, lubricant, cavitation, edge_pressure, grid, supply)
    if series is not None:
        if force_x is not None or force_y or speed_rpm is not None:
            raise InputError("--series brings its own loads: leave out --force-… and --speed-rpm")
        answer = journal_series(series, *film)
    elif force_x is None or speed_rpm is None:
        raise InputError("give --force-x and --speed-rpm, or a parameter file with --series")
    else:
        force, speed = (force_x, force_y), speed_rpm * math.pi / 30
        answer = journal_point(force, speed, *film)
    print_quantities(answer, as_json)


@app.command()
def rolling(
    balls: Annotated[int, typer.Option(help="Balls in each row.", show_default=False)],
    ball_diameter: Annotated[float, typer.Option(help="m.", show_default=False)],
    pitch_diameter: Annotated[float, typer.Option(help="m.", show_default=False)],
    groove_radius: Annotated[float, typer.Option(help="Of both rings, m.", show_default=False)],
    contact_angle_deg: Annotated[float, typer.Option(help="Nominal, °.")] = 45.0,
    rows: Annotated[int, typer.Option(help="Rows of balls.")] = 1,
    row_spacing: Annotated[float, typer.Option(help="Of neighbouring rows, m.")] = 0.0,
    clearance: Annotated[float, typer.Option(help="Axial, < 0 for preload, m.")] = 0.0,
    hardness: Annotated[float, typer.Option(help="Of the raceways, HV.")] = 700.0,
    force_x: Annotated[float, typer.Option(help="On the inner ring, radial, N.")] = 0.0,
    force_y: Annotated[float, typer.Option(help="Radial, N.")] = 0.0,
    force_z: Annotated[float, typer.Option(help="Along the axis, N.")] = 0.0,
    moment_x: Annotated[float, typer.Option(help="Tilting, N m.")] = 0.0,
    moment_y: Annotated[float, typer.Option(help="Tilting, N m.")] = 0.0,
    as_json: AsJson = False,
) -> None:
    """Share a load between the balls of a four-point slewing bearing."""
    from loadflow.rolling import SlewingBearing
    from loadflow.stages.points import rolling_point

    bearing = SlewingBearing(
        balls=balls,
        ball_diameter=ball_diameter,
        pitch_diameter=pitch_diameter,
        groove_radius=groove_radius,
        contact_angle=math.radians(contact_angle_deg),
        rows=rows,
        row_spacing=row_spacing,
        clearance=clearance,
        hardness=hardness,
    )
    force, moment = (force_x, force_y, force_z), (moment_x, moment_y)
    print_quantities(rolling_point(bearing, force, moment), as_json)
