"""The command that answers for a friction rig."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Any, Literal

import typer

from loadflow.cli import completing
from loadflow.cli.base import AsJson, app, print_json, print_rows
from loadflow.cli.stated import refuse
from loadflow.errors import InputError
from loadflow.quantities import CELSIUS, percent

Arrangement = Literal["rollers", "journal", "straight"]


@app.command("friction-rig")
def friction_rig(
    speed_rpm: Annotated[
        list[float] | None,
        typer.Option(
            help="Of the shaft, 1/min, 0 at rest; may be repeated. Default: those of --measured."
        ),
    ] = None,
    arrangement: Annotated[
        Arrangement,
        typer.Option(
            help="A crank with rollers or a journal bearing on its pin; a straight shaft."
        ),
    ] = "rollers",
    stage: Annotated[
        Literal["coulomb", "film"],
        typer.Option(help="Rollers by friction coefficients, or by their films."),
    ] = "coulomb",
    oil: Annotated[
        str, typer.Option(help="A lubricant by name.", autocompletion=completing.oils)
    ] = "crankshaft-5w-30",
    temperature_c: Annotated[float, typer.Option(help="Of the oil, °C.")] = 90.0,
    load: Annotated[float, typer.Option(help="Radial, on a straight shaft, N.")] = 2e3,
    pin: Annotated[
        tuple[float, float, float],
        typer.Option(help="Journal bearing: diameter, width (m), relative clearance."),
    ] = (48e-3, 18e-3, 1e-3),
    seal_force: Annotated[float, typer.Option(help="Of the lip seal, N; 0: none.")] = 11.5,
    thrust_share: Annotated[
        float, typer.Option(help="Force on the rod's washers over that of the pin; 0: none.")
    ] = 0.0,
    measured: Annotated[
        Path | None,
        typer.Option(
            help="Series of the rig, .csv: rpm, force (N, of the piston along its travel), and "
            "velocity (m/s, of the piston) or angle (°, of the crank), over whole turns."
        ),
    ] = None,
    as_json: AsJson = False,
) -> None:
    """Friction torque of a crank rig over speed, part by part, beside what was measured."""
    from loadflow.journal import JournalBearing
    from loadflow.studies.one_bearing.crank_rig import CrankRig
    from loadflow.studies.one_bearing.rig import rig_torques

    told: dict[str, Any] = {
        "temperature": temperature_c + CELSIUS,
        "oil": oil,
        "seal_force": seal_force,
    }
    if arrangement == "straight":
        refuse("a straight shaft has no pin", "pin", "thrust_share")
        rig = CrankRig(drive=None, load=load, **told)
    elif arrangement == "journal":
        refuse(
            "a crank is loaded by its masses, and a journal bearing has no washers",
            "load",
            "thrust_share",
        )
        rig = CrankRig(pin_film=JournalBearing(*pin), **told)
    else:
        refuse("a crank is loaded by its masses, and has rollers on its pin", "load", "pin")
        rig = CrankRig(thrust_share=thrust_share, **told)
    if not speed_rpm and measured is None:
        raise InputError(
            "give --speed-rpm, or --measured; for example: loadflow friction-rig --speed-rpm 1000"
        )
    rows = rig_torques(rig, tuple(speed_rpm or ()), stage, measured)
    if as_json:
        print_json({"units": {"rpm": "1/min", "off": "1", "others": "N m"}, "rows": rows})
        return
    names = {"rpm": "1/min", "torque": "torque, N m", "measured": "measured, N m"}
    parts = list(dict.fromkeys(name for row in rows for name in row))  # those at rest are others
    cells = [[_cell(name, row[name]) if name in row else "–" for name in parts] for row in rows]
    print_rows(tuple(names.get(name, name) for name in parts), cells)


def _cell(name: str, value: float) -> str:
    return percent(value, signed=True) if name == "off" else f"{value:.4g}"
