"""Orbits whose shaft comes nearer to the shell than the cells around resolve."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, cast

from loadflow.errors import SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.solvers.transient import OrbitStopped

if TYPE_CHECKING:
    import xarray as xr

_WORK = 3e6  # Newton steps times cells of all paths, beyond which none on more cells is begun


def on_enough_cells(options: Film, path: Callable[[Film], xr.Dataset], most: int) -> xr.Dataset:
    """The orbit on the cells of a film, or where it stops on them, on more of them around.

    On cells fixed to the shell the gap may close between two of them, and no film is left to carry
    the load; which cells an orbit took says its attribute `cells_around`. Twice the cells take at
    least twice the work up to the same place: they are not tried where that would be too much.

    Parameters
    ----------
    options : Film
        With the cells that are asked for.
    path : callable
        The orbit of such a film.
    most : int
        Cells around, to which they are doubled.

    Raises
    ------
    OrbitStopped
        As on the cells that are asked for; it tells of more cells that were not tried.
    """
    around, across = options.cells
    stop: OrbitStopped | None = None
    done = ahead = 0.0
    while True:
        try:
            found = path(options if stop is None else replace(options, grid=(around, across)))
            return found.assign_attrs(cells_around=around)
        except SolverError as error:
            if stop is None and not isinstance(error, OrbitStopped):
                raise
            stop = stop or cast("OrbitStopped", error)
            own = (isinstance(error, OrbitStopped) and error.work) or 0.0
            done, ahead = done + own, 2.0 * own
        if 2 * around > most:
            raise stop
        if done + ahead > _WORK:
            more = f"grid = [{2 * around}, {across}] asks for more cells, which were not tried"
            raise OrbitStopped(f"{stop}; {more}", stop.time, stop.work) from stop
        around *= 2
