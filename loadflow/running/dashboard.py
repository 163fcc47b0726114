"""A dashboard on the folder of a run: verdicts, loads, films, rolling elements.

It is local: served on this machine only, with all scripts from this machine, so that it needs no
network. It reads the parts of the run as they are and writes nothing.
"""

from __future__ import annotations

import socket
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr

from loadflow.cube import open_cube
from loadflow.errors import InputError
from loadflow.plots.journal import film_series, orbit
from loadflow.plots.style import envelope, figure, readable
from loadflow.quantities import load_cases
from loadflow.report.compare_page import verdict_row
from loadflow.running.folder import answered, open_part, read_manifest
from loadflow.studies.channels import channel, channel_names
from loadflow.verdict import from_dataset

if TYPE_CHECKING:
    from matplotlib.figure import Figure

LOCAL = "127.0.0.1"
"""Where it is served: for this machine alone."""

TITLE = "loadflow"


_COLUMNS = {
    "subject": "bearing", "quantity": "what", "answer": "verdict", "value": "value",
    "limit": "limit", "where": "governed by", "source": "limit from", "note": "remarks",
}  # fmt: skip


_FILMS = {"journal": "", "thrust": ", axial"}
"""Stages with films, and what tells their bearings apart: a collar stands where a journal does."""


class RunView:
    """What a run has to show.

    Parameters
    ----------
    folder : path
        Of a run.

    Raises
    ------
    loadflow.errors.InputError
        It is no run, or no load case of it is finished.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        self.manifest = read_manifest(self.folder)
        self.cases = [path.stem for path in sorted((self.folder / "loads").glob("*.h5"))]
        if not self.cases:
            raise InputError(f"{self.folder}: no load case of this run is finished")

    def state(self) -> str:
        """What there is to see: how many load cases, and why verdicts are missing."""
        told = load_cases(len(self.cases))
        if not (self.folder / "result.h5").exists():
            return f"{told} so far. Not finished: verdicts come at the end of `loadflow run`."
        if (self.folder / "compare.html").exists():
            named = ", ".join(sorted(path.name for path in self.folder.glob("candidates/*/")))
            return f"{told}, the loads of a comparison. Its candidates are runs: {named}."
        return told

    def part(self, stage: str, case: str) -> Any:
        """What a stage found of a case; None where it has not run."""
        there = answered(self.folder, stage, [case])
        return open_part(self.folder, stage, case) if there else None

    def series(self, case: str) -> xr.Dataset:
        """Loads and forces on the bearings of a case."""
        loads, shaft = (self.part(stage, case) for stage in ("loads", "shaft"))
        found: xr.Dataset = loads.load()
        return found if shaft is None else found.merge(shaft.load(), compat="override")

    def channels(self) -> list[str]:
        """Names of the series of a case."""
        return [
            name for names in channel_names(self.series(self.cases[0])).values() for name in names
        ]

    def bearings(self) -> list[str]:
        """Bearings with a film: journal bearings, then thrust bearings and pairs of cones."""
        found = []
        for stage, words in _FILMS.items():
            first = next((c for c in self.cases if self.part(stage, c) is not None), None)
            names = [] if first is None else self.part(stage, first).children
            found += [f"{name}{words}" for name in names]
        return found

    def verdicts(self) -> list[dict[str, str]]:
        """Verdicts of the run, a row each."""
        path = self.folder / "result.h5"
        if not path.exists():
            return []
        tree: Any = open_cube(path)
        if "verdicts" not in tree.children:
            return []
        told = from_dataset(tree["verdicts"].to_dataset())
        rows = [verdict_row(verdict.as_dict()) for verdict in told]
        return [{words: row[key] for key, words in _COLUMNS.items()} for row in rows]

    def models(self) -> list[dict[str, str]]:
        """Model of each stage with its error."""
        return [
            {"stage": stage, "model": str(told["rung"]), "error": str(told["error"])}
            for stage, told in self.manifest.get("rungs", {}).items()
        ]

    def load_figure(self, case: str, name: str) -> Figure:
        """Draw one channel of a case over time."""
        series = self.series(case)
        data = channel(series, name)
        values, unit = readable(data)
        drawing, axis = figure(height=3.0)
        envelope(axis, series["time"].values, np.asarray(values), name)
        axis.set(xlabel="time, s", title=f"{name}, {unit}")
        return drawing

    def film_figure(self, case: str, bearing: str) -> Figure | None:
        """Draw the film of a bearing over time."""
        samples = self._film(case, bearing)
        return None if samples is None else film_series(samples)

    def orbit_figure(self, case: str, bearing: str) -> Figure | None:
        """Draw the shaft centre in the clearance circle; a thrust bearing has none."""
        samples = self._film(case, bearing)
        return None if samples is None or "eccentricity" not in samples else orbit(samples)

    def _film(self, case: str, bearing: str) -> xr.Dataset | None:
        """Film of a bearing over time; None where no sample is solved."""
        stage = next(s for s in reversed(_FILMS) if bearing.endswith(_FILMS[s]))
        found, name = self.part(stage, case), bearing.removesuffix(_FILMS[stage])
        if found is None or name not in found.children:
            return None
        samples: xr.Dataset = found[name].to_dataset().load()
        return samples if bool((samples["converged"] > 0).any()) else None

    def rolling_figure(self, case: str) -> Figure | None:
        """Draw force and pressure of the rolling elements over time."""
        found = self.part("rolling", case)
        if found is None:
            return None
        drawing, axes = figure(2, sharex=True, height=1.9)
        for axis, name in zip(axes, ("maximum_force", "maximum_pressure")):
            values, unit = readable(found[name])
            axis.plot(found["time"], values, ".", ms=2)
            axis.set_title(f"{found[name].attrs['long_name']}, {unit}")
        axes[-1].set_xlabel("time, s (reduced series)")
        return drawing


def application(folder: str | Path) -> Callable[[], Any]:
    """The dashboard of a run, as what a Panel server calls for every page that is opened.

    Raises
    ------
    loadflow.errors.InputError
        Panel is not installed, or the folder is no run.
    """
    pn = _panel()
    view = RunView(folder)
    pn.extension()

    def page() -> Any:
        case = pn.widgets.Select(name="load case", options=view.cases)
        channels = pn.widgets.Select(name="channel", options=view.channels())
        head = pn.pane.Markdown(f"# {view.folder.resolve().name}\n{view.state()}")
        told = _table(pn, view.verdicts()), "### Models", _table(pn, view.models())
        rooms = [("Verdicts", pn.Column(*told, sizing_mode="stretch_width"))]
        loads = pn.bind(lambda c, n: _drawn(pn, view.load_figure(c, n)), case, channels)
        rooms.append(("Loads", pn.Column(channels, loads)))
        if view.bearings():
            bearing = pn.widgets.Select(name="bearing", options=view.bearings())
            films = pn.bind(lambda c, b: _drawn(pn, view.film_figure(c, b)), case, bearing)
            circle = pn.bind(lambda c, b: _circle(pn, view, c, b), case, bearing)
            rooms.append(("Film", pn.Column(bearing, films, circle)))
        if (view.folder / "rolling").is_dir():
            rolling = pn.bind(lambda c: _drawn(pn, view.rolling_figure(c)), case)
            rooms.append(("Rolling elements", pn.Column(rolling)))
        tabs = pn.Tabs(*rooms, dynamic=True)
        if pn.state.location is not None:  # ?case=…&tab=1 opens what a link means
            pn.state.location.sync(case, {"value": "case"})
            pn.state.location.sync(tabs, {"active": "tab"})
        return pn.Column(head, case, tabs, sizing_mode="stretch_width", max_width=1200)

    return page


def serve(
    folder: str | Path,
    port: int = 0,
    show: bool = True,
    told: Callable[[str], None] = lambda address: None,
    opened: Callable[[], None] = lambda: None,
) -> None:
    """Serve the dashboard of a run on this machine until it is stopped.

    Parameters
    ----------
    folder : path
        Of the run.
    port : int
        0: any free one.
    show : bool
        Whether to open the browser.
    told : callable
        Told of the address when it is served.
    opened : callable
        Called when a browser has drawn the page.

    Raises
    ------
    loadflow.errors.InputError
        As `application`; or the port is taken.
    """
    pn = _panel()
    page = application(folder)

    def watched() -> Any:
        pn.state.onload(opened)
        return page()

    port = port or _free_port()
    own = [f"{host}:{port}" for host in (LOCAL, "localhost")]  # no page of another site talks to it
    try:
        server = pn.serve(
            {"/": watched}, port=port, address=LOCAL, show=show, start=False, title=TITLE,
            threaded=False, verbose=False, websocket_origin=own,
        )  # fmt: skip
    except OSError as error:
        raise InputError(f"port = {port}: {error.strerror or error}") from error
    address = f"http://{LOCAL}:{server.port}/"
    server.start()
    told(address)
    try:
        server.io_loop.start()
    finally:
        server.stop()


def _free_port() -> int:
    with socket.socket() as free:
        free.bind((LOCAL, 0))
        return int(free.getsockname()[1])


def _panel() -> Any:
    try:
        import panel
    except ImportError as error:
        raise InputError("view needs the extra: pip install loadflow[view]") from error
    return panel


def _circle(pn: Any, view: RunView, case: str, bearing: str) -> Any:
    """The orbit of a journal bearing; nothing below the film of a bearing that has none."""
    if bearing.endswith(_FILMS["thrust"]):
        return pn.pane.Markdown("")
    return _drawn(pn, view.orbit_figure(case, bearing))


def _drawn(pn: Any, drawing: Figure | None) -> Any:
    if drawing is None:
        return pn.pane.Markdown("Nothing found of this load case.")
    return pn.pane.Matplotlib(drawing, format="svg", sizing_mode="stretch_width", tight=False)


def _table(pn: Any, rows: list[dict[str, str]]) -> Any:
    import pandas as pd

    if not rows:
        return pn.pane.Markdown("None in this run.")
    table = pn.pane.DataFrame(
        pd.DataFrame(rows), index=False, sizing_mode="stretch_width", text_align="start",
        stylesheets=["table thead th { text-align: start !important; }"],
    )  # fmt: skip
    return pn.Column(table, sizing_mode="stretch_width", scroll="x-auto")  # wider than a phone is
