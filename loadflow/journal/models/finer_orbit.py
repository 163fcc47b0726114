"""Orbits whose shaft comes nearer to the shell than the cells around resolve."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TypeVar, cast

from loadflow.errors import SolverError
from loadflow.journal.film_model import Film
from loadflow.journal.solvers.motion.transient import OrbitStopped

_WORK = 3e6  # Newton steps times cells of all paths, beyond which none on more cells is begun

Path = TypeVar("Path")


def on_enough_cells(
    films: Sequence[Film], path: Callable[[Sequence[Film]], Path], most: Sequence[int]
) -> Path:
    """The orbit on the cells of its films, or where it stops on them, on more of them around.

    On cells fixed to the shell the gap may close between two of them, and no film is left to carry
    the load. Twice the cells take at least twice the work up to the same place: they are not tried
    where that would be too much.

    Parameters
    ----------
    films : sequence of Film
        One for each bearing of the shaft, with the cells that are asked for.
    path : callable
        The orbit in such films; its attribute `cells_around` says on which cells it is.
    most : sequence of int
        Cells around, to which those of each film are doubled.

    Raises
    ------
    OrbitStopped
        As on the cells that are asked for; it tells of more cells that were not tried.
    """
    stop: OrbitStopped | None = None
    done = ahead = 0.0
    while True:
        try:
            return path(films)
        except SolverError as error:
            if stop is None and not isinstance(error, OrbitStopped):
                raise
            stop = stop or cast("OrbitStopped", error)
            own = (isinstance(error, OrbitStopped) and error.work) or 0.0
            done, ahead = done + own, 2.0 * own
        finer = [_on_twice_the_cells(*both) for both in zip(films, most)]
        if finer == [*films]:
            raise stop
        if done + ahead > _WORK:
            grids = " and ".join(str([*film.cells]) for film in finer)
            more = f"grid = {grids} asks for more cells, which were not tried"
            raise OrbitStopped(f"{stop}; {more}", stop.time, stop.work) from stop
        films = finer


def _on_twice_the_cells(film: Film, most: int) -> Film:
    """A film on twice the cells around, where these are no more than `most`."""
    around, across = film.cells
    return film if 2 * around > most else replace(film, grid=(2 * around, across))
