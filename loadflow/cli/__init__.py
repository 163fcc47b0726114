"""The command line: reads arguments, calls the package, prints. No logic of its own."""

from __future__ import annotations

import sys
from collections.abc import Sequence

from loadflow.cli import cubes, lifetimes, points, processing, scenes  # noqa: F401  they register their commands
from loadflow.cli.base import app, err
from loadflow.cli.signals import Stopped, leave, stoppable, tell_stopped
from loadflow.errors import InputError, LoadflowError


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line.

    Exit code 0: done; 1: failed with a message; 2: bad usage or input; 130, 143: stopped by SIGINT
    or SIGTERM.

    Parameters
    ----------
    arguments : sequence of str, optional
        What follows the name of the program; default: the arguments of the process.
    """
    try:
        with stoppable():
            app(arguments)
    except InputError as error:
        err.print(f"[red]error:[/] {_plain(error)}", soft_wrap=True)
        sys.exit(2)
    except (LoadflowError, OSError) as error:  # OSError: a disk or folder that refuses the output
        err.print(f"[red]failed:[/] {_plain(error)}", soft_wrap=True)
        sys.exit(1)
    except Stopped as stop:
        tell_stopped(stop.number)
        leave(stop.code)


def _plain(error: Exception) -> str:
    return str(error).replace("[", "\\[")
