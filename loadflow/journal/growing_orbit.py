"""Path of the shaft in a bearing whose clearance follows the temperature that it stores.

Shaft and shell grow over minutes and hours, so that the gap hardly changes in the time of a step.
The path is taken in pieces: each has the clearance of the temperature at its beginning, and ends
before that has changed by `CHANGE`. The next begins where the shaft is, in a film at rest there;
squeeze by the growth itself, a few µm in minutes, is left out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.heat import Heat
from loadflow.journal.questions import Steps
from loadflow.journal.thermal import LEFT, clearance_at, grown_by
from loadflow.numerics.convergence import EPS
from loadflow.quantities import FILM, GRID_ERROR

if TYPE_CHECKING:
    import xarray as xr

Array = NDArray[np.float64]
Piece = Callable[[JournalGeometry, slice, float, Steps], "xr.Dataset"]
"""Path in a bearing as it is, over some samples, from a temperature, K."""

CHANGE = 1e-3
"""Of the clearance, by which it changes in a piece."""

_FIRST = 64  # samples of the first piece; each is at most twice as long as the last


def growing_orbit(
    piece: Piece, bearing: JournalGeometry, heat: Heat, count: int, start: float, steps: Steps
) -> xr.Dataset:
    """Path over `count` samples, with its `clearance`.

    Parameters
    ----------
    piece : callable
        Path in a bearing that stays as it is.
    bearing : JournalGeometry
        As it is made.
    heat : Heat
        With growth, and heat that is stored.
    count : int
        Number of samples.
    start : float
        First temperature, K.
    steps : Steps
        How to go through time, the first position in clearances as they are made.

    Raises
    ------
    loadflow.errors.SolverError
        As `piece`; the shaft grows into its shell.
    """
    begun, length, warm = 0, _FIRST, start
    paths: list[xr.Dataset] = []
    place = None if steps.start is None else steps.start * bearing.clearance
    while True:
        grown = grown_by(bearing, heat, warm)
        if grown.clearance <= LEFT * bearing.clearance * (1.0 + EPS):
            raise SolverError(f"the shaft grows into its shell at sample {begun}, {warm:.5g} K")
        own = replace(steps, start=None if place is None else place / grown.clearance)
        try:
            path = piece(grown, slice(begun, min(begun + length, count - 1) + 1), warm, own)
        except SolverError as error:
            raise SolverError(f"from sample {begun} on: {error}") from error
        after = clearance_at(bearing, heat, path["temperature"].values)
        far = np.flatnonzero(np.abs(after - after[0]) > CHANGE * grown.clearance)
        # a step that alone goes farther is a piece of its own
        took = max(int(far[0]) - 1, 1) if far.size else after.size - 1
        path = path.isel(time=slice(0, took + 1))
        width = np.full(took + 1, grown.clearance)
        path = path.assign(clearance=("time", width, FILM["clearance"].attributes))
        paths.append(path if not paths else path.isel(time=slice(1, None)))
        begun += took
        if begun == count - 1:
            return _joined(paths)
        warm = float(path["temperature"][-1])
        place = path["eccentricity"].values[-1]
        length = 2 * took


def _joined(paths: list[xr.Dataset]) -> xr.Dataset:
    """All pieces, each bound that of the piece in which its answer is worst.

    A piece is cut after it is solved, so that its bound may be that of a sample that was dropped.
    """
    import xarray as xr

    narrow = min(paths, key=lambda path: float(path["minimum_film"].min()))
    high = max(paths, key=lambda path: float(path["maximum_pressure"].max()))
    about = dict(narrow.attrs)
    pressed = f"maximum_pressure{GRID_ERROR}"
    about |= {name: value for name, value in high.attrs.items() if name == pressed}
    for name in ("mass_balance", "cells_around"):
        if name in about:
            about[name] = max((path.attrs[name] for path in paths), key=abs)
    joined = xr.concat(paths, dim="time", data_vars="minimal", coords="minimal", compat="override")
    return joined.assign_attrs(about)
