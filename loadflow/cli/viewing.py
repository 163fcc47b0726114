"""The command that opens a run in the browser: view."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from loadflow.cli.base import app, out


@app.command()
def view(
    run: Annotated[Path, typer.Argument(help="Folder of a run.", show_default=False)],
    port: Annotated[int, typer.Option(min=0, max=65535, help="0: any free one.")] = 0,
    browser: Annotated[bool, typer.Option(help="Open the browser.")] = True,
) -> None:
    r"""Open a dashboard on a run in the browser: local, without a network.

    It needs the extra: pip install loadflow\[view].
    """
    from loadflow.running.dashboard import serve

    serve(
        run,
        port,
        browser,
        told=lambda address: out.print(
            f"{run}: {address} (Ctrl+C ends it)", soft_wrap=True, highlight=False
        ),
        opened=lambda: out.print("a browser shows it", highlight=False),
    )
