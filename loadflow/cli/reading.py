"""Options of how load files are read, the same of every command that reads them."""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import Parameter, Signature, signature
from pathlib import Path
from typing import Annotated, Any, get_type_hints

import typer

Reading = dict[str, Any]
"""How load files are read, as keys of `[loads]`; None where the scene is not overruled."""

AS_STATED: Reading = {}
"""What stands for it in the parameters of a command; the options take its place."""

_OPTIONS: dict[str, Any] = {
    "cases": Annotated[
        Path | None,
        typer.Option(
            "--cases", help="List of cases: CSV with file, dlc, wind_speed, seed, weight."
        ),
    ],
    "pattern": Annotated[
        str | None,
        typer.Option(
            "--pattern",
            help="How names tell the case, by {dlc}, {wind_speed}, {seed}, such as "
            "'a{dlc}_s{seed}'.",
        ),
    ],
    "channels": Annotated[
        str | None,
        typer.Option(
            "--channels",
            help="Channels by component: a TOML file, or 'speed=Omega, hub_force_x=-#23'.",
        ),
    ],
    "gauge_distance": Annotated[
        float | None,
        typer.Option("--gauge-distance", help="From the rotor apex to the shaft strain gauge, m."),
    ],
    "frame": Annotated[
        str | None,
        typer.Option("--frame", help="Frame of the y and z channels: auto, fixed or rotating."),
    ],
}


READING = tuple(_OPTIONS)
"""Names of these options."""


def reads_load_files(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command the options of how load files are read in place of its parameter `reading`."""
    types = get_type_hints(command, include_extras=True)

    @wraps(command)
    def with_options(**given: Any) -> None:
        reading: Reading = {name: given.pop(name) for name in _OPTIONS}
        if reading["cases"] is not None:
            reading["cases"] = str(reading["cases"])
        command(**given, reading=reading)

    keyword = Parameter.POSITIONAL_OR_KEYWORD
    shown: list[Parameter] = []
    for own in signature(command).parameters.values():
        if own.name == "reading":
            shown += [
                Parameter(n, keyword, default=None, annotation=t) for n, t in _OPTIONS.items()
            ]
        else:
            shown.append(own.replace(annotation=types[own.name]))
    with_options.__signature__ = Signature(shown)  # type: ignore[attr-defined]
    with_options.__annotations__ = {one.name: one.annotation for one in shown}
    del with_options.__dict__["__wrapped__"]  # else its signature would be the one of the command
    return with_options
