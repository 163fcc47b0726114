"""A past for films in motion: loads that go before a series, whose film is not kept.

A film at rest under the first load has carried it for ever: its pressure may be the largest of all,
its gap the narrowest. A film forgets how it began within about two turns of the shaft.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.cube import time_step
from loadflow.errors import SolverError, ValidityWarning
from loadflow.journal.solvers.motion.transient import OrbitStopped
from loadflow.numerics.prediction import foretell_past
from loadflow.scene.scene import Scene
from loadflow.stages.running_time import running

Floats = NDArray[np.float64]

TURNS = 2
"""Turns of the shaft that go before a series."""

KNOWN = 10
"""Turns at its begin from which they are foretold, with one turn of memory."""


@dataclass(frozen=True)
class Past:
    """How much goes before a series: `steps`, foretold with `memory` from the first `known` steps.

    Without steps a film begins at rest.
    """

    steps: int = 0
    memory: int = 0
    known: int = 0

    def before(self, series: dict[str, Floats]) -> dict[str, Floats]:
        """Put a past before series (n, …), each of which may be "time", all foretold together."""
        time = series["time"]
        if not self.steps:
            return series
        names = [name for name in series if name != "time"]
        tables = [np.reshape(series[name], (time.size, -1)) for name in names]
        known = np.concatenate(tables, axis=1)[: self.known]
        past = foretell_past(known, self.memory, self.steps)
        columns = np.cumsum([table.shape[1] for table in tables])[:-1]
        parts = zip(names, np.split(past, columns, axis=1))
        earlier = time[0] - (time[1] - time[0]) * np.arange(self.steps, 0, -1)
        return {"time": np.concatenate([earlier, time])} | {
            name: np.concatenate([part.reshape(-1, *series[name].shape[1:]), series[name]])
            for name, part in parts
        }


AT_REST = Past()
"""None: the film begins at rest under the first load."""

T = TypeVar("T")


def after_past(path: Callable[[Past], T], past: Past, time: Floats) -> T:
    """Follow a film along its `path` after a `past`; begin at rest where that carries none.

    So it does where no film is found through the past, or for as long after it as it is remembered,
    with a warning. `time` (n,), s, is that of the loads without the past.

    Raises
    ------
    loadflow.errors.SolverError
        No film is found from rest on, either, or it stops when it has forgotten how it began.
    """
    if not past.steps:
        return path(AT_REST)
    try:
        return path(past)
    except SolverError as error:
        forgotten = time[min(past.steps, time.size - 1)]
        if isinstance(error, OrbitStopped) and error.time > forgotten:
            raise
        found = path(AT_REST)
        warnings.warn(
            f"no film is found through the loads foretold before t = {time[0]:g} s "
            f"({error}): it begins at rest",
            ValidityWarning,
            stacklevel=3,
        )
        return found


def past_of(scene: Scene, loads: xr.Dataset) -> Past:
    """Past of a film under `loads`: two turns, where the rotor runs at first, else none.

    A rotor that stands or idles at first has the film at rest that it really has.
    """
    return past_of_speed(loads["speed"].values, time_step(loads), running(scene, loads).values)


def past_of_speed(speed: Floats, step: float, runs: NDArray[np.bool_]) -> Past:
    """Past of a film under loads at `speed` (n,), rad/s, every `step`, s.

    As `past_of`; `runs` (n,) says when the rotor runs.
    """
    still = np.flatnonzero(~runs)
    length = int(still[0]) if still.size else runs.size
    if length < 4:  # too short to foretell from
        return AT_REST
    turn = 2.0 * np.pi / (np.abs(speed[:length]).mean() * step)
    known = min(length, round(KNOWN * turn))
    return Past(round(TURNS * turn), min(round(turn), known // 3), known)
