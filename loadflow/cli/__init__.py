"""The command line: reads arguments, calls the package, prints. No logic of its own."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from io import TextIOWrapper

from typer.models import CommandInfo

from loadflow.cli import (  # noqa: F401  they register their commands
    comparing,
    cubes,
    designing,
    lifetimes,
    points,
    processing,
    rigs,
    scenes,
    thrust_points,
    viewing,
)
from loadflow.cli.base import app, err, warnings_in_a_line
from loadflow.cli.signals import Stopped, leave, stoppable, tell_stopped
from loadflow.errors import InputError, LoadflowError
from loadflow.studies.one_bearing.journal_film import EXAMPLE as OF_A_JOURNAL_BEARING

GROUPS = {
    "Scenes and runs": (
        "run",
        "plan",
        "compare",
        "design",
        "init",
        "scene",
        "list",
        "report",
        "view",
    ),
    "Load cubes": ("convert", "loads", "statistics", "seeds", "reduce", "lifetime"),
    "One bearing, one wind": ("journal", "thrust", "cone", "rolling", "friction-rig", "wind"),
    "How far to trust it": ("validate", "bench"),
}
"""Commands in the order of the help."""

EXAMPLES = """Begin with:

loadflow init; loadflow compare scene.toml

loadflow run scene.toml --loads 'path/to/*.outb'

loadflow journal --help
"""


EXAMPLE = {
    "run": "loadflow run scene.toml --loads 'path/to/*.outb'",
    "plan": "loadflow plan scene.toml --pilot",
    "compare": "loadflow compare scene.toml --candidate two-spherical",
    "design": "loadflow design scene.toml --candidate journal-cylindrical "
    "--key geometry.diameter=1.0:1.6 --key lubricant.viscosity=0.1,0.2,0.3",
    "init": "loadflow init dlc_1_1 -o my_turbine.toml",
    "scene": "loadflow scene --show scene.toml",
    "list": "loadflow list oils",
    "report": "loadflow report runs/quick_look",
    "view": "loadflow view runs/quick_look",
    "convert": "loadflow convert 'path/to/*.outb' -o loads.h5",
    "loads": "loadflow loads --dlc 1.1 --wind-speed 8 --wind-speed 12 -o loads.h5",
    "statistics": "loadflow statistics loads.h5 -o statistics",
    "seeds": "loadflow seeds loads.h5 -o seeds.html",
    "reduce": "loadflow reduce loads.h5 -o reduced --method periodic",
    "lifetime": "loadflow lifetime loads.h5 -o lifetime",
    "journal": OF_A_JOURNAL_BEARING,
    "thrust": "loadflow thrust --pads 10 --inner-radius 0.75 --outer-radius 1.05 "
    "--pad-angle-deg 32 --taper 6e-5 --viscosity 0.2 --force 9e5 --speed-rpm 12",
    "cone": "loadflow cone --half-angle-deg 28.6 --slant 1.59 2.59 --clearance 2e-4 "
    "--distance 3.2 --pads 10 --pad-angle-deg 33 --taper 8e-5 --viscosity 0.2 --force-x 1e6 "
    "--force-z 8e5 --moment-y 4e6 --speed-rpm 12",
    "rolling": "loadflow rolling --balls 60 --ball-diameter 0.06 --pitch-diameter 2.4 "
    "--groove-radius 0.0315 --force-z 1e6 --moment-y 1e6",
    "friction-rig": "loadflow friction-rig --speed-rpm 1000 --speed-rpm 2000 --arrangement journal",
    "wind": "loadflow wind 12",
    "validate": "loadflow validate journal --failed",
    "bench": "loadflow bench journal",
}
"""What the help of each command ends with."""


def _in_groups() -> None:
    """Order the commands of the help, `run` first, head each group, and give each its example."""
    order = [name for names in GROUPS.values() for name in names]
    group_of = {name: group for group, names in GROUPS.items() for name in names}

    def name_of(command: CommandInfo) -> str:
        return str(command.name or getattr(command.callback, "__name__", ""))

    for command in app.registered_commands:
        command.rich_help_panel = group_of.get(name_of(command), "More")
        if name_of(command) in EXAMPLE:
            command.epilog = f"Example: {EXAMPLE[name_of(command)]}"
    app.registered_commands.sort(
        key=lambda c: order.index(name_of(c)) if name_of(c) in order else len(order)
    )
    app.info.epilog = EXAMPLES


_in_groups()


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line.

    Exit code 0: done; 1: failed with a message; 2: bad usage or input; 130, 143: stopped by SIGINT
    or SIGTERM.

    Parameters
    ----------
    arguments : sequence of str, optional
        What follows the name of the program; default: the arguments of the process.
    """
    _print_on_any_code_page()
    try:
        with stoppable(), warnings_in_a_line():
            app(_each_file_of_loads(sys.argv[1:] if arguments is None else arguments))
    except InputError as error:
        err.print(f"[red]error:[/] {_plain(error)}", soft_wrap=True)
        sys.exit(2)
    except (LoadflowError, OSError) as error:  # OSError: a disk or folder that refuses the output
        told = str(error)
        if isinstance(error, OSError) and error.filename:
            told = f"{error.strerror}: {error.filename}"
        err.print(f"[red]failed:[/] {_plain(told)}", soft_wrap=True)
        sys.exit(1)
    except Stopped as stop:
        tell_stopped(stop.number)
        leave(stop.code)


def _each_file_of_loads(arguments: Sequence[str]) -> list[str]:
    """``--loads`` before each of its files: a shell makes several of a pattern without quotes."""
    told: list[str] = []
    of_loads = False
    for one in arguments:
        if one.startswith("-"):
            of_loads = one == "--loads"
        elif of_loads and told[-1] != "--loads" and not one.endswith(".toml"):  # that is a scene
            told.append("--loads")
        told.append(one)
    return told


def _print_on_any_code_page() -> None:
    """What a code page lacks (ε, ≤) is escaped as TOML and JSON do, instead of an error."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _plain(error: Exception | str) -> str:
    return str(error).replace("[", "\\[")
