"""A journal bearing → how far its shaft moves under a load that swings at one frequency."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.scene import Journal

Floats = NDArray[np.float64]
Response = Callable[[Floats, Floats, float], float]

SAMPLES = 48  # steps in a period
SETTLED = 1e-3  # relative change of the largest ε from one period to the next; 1 % decides (4.24)
DOUBLINGS = 4


def film_response(journal: Journal, speed: float) -> Response:
    """Return ``response(mean, amplitude, frequency)`` for `loadflow.reduction.frequency_bounds`.

    The orbit under mean + amplitude · sin(2π frequency · t) is followed, from the equilibrium of
    the mean load, for a revolution of the shaft (in which squeeze dies away) and two periods, and
    on until the largest eccentricity ratio of a period no longer changes (4.23).

    Parameters
    ----------
    journal : Journal
        Bearing, oil, cavitation and grid: the section of a scene.
    speed : float
        Mean speed of the rotor, rad/s.

    Returns
    -------
    callable
        mean (2,), amplitude (2,) in N, frequency in Hz → largest eccentricity ratio per period;
        raises `SolverError` if the orbit does not settle.
    """

    def response(mean: Floats, amplitude: Floats, frequency: float) -> float:
        turn = 2.0 * np.pi / abs(speed)
        periods = int(np.ceil(turn * frequency)) + 2
        for _ in range(DOUBLINGS):
            before, last = _largest(journal, speed, mean, amplitude, frequency, periods)
            if abs(last - before) <= SETTLED * last:
                return last
            periods *= 2
        raise SolverError(
            f"the orbit at {frequency:g} Hz does not settle in {periods // 2} periods: largest "
            f"ε {before:.5g}, then {last:.5g}"
        )

    return response


def _largest(
    journal: Journal,
    speed: float,
    mean: Floats,
    amplitude: Floats,
    frequency: float,
    periods: int,
) -> tuple[float, float]:
    """Largest eccentricity ratio of the last period but one, and of the last."""
    time = np.arange(periods * SAMPLES + 1) / (SAMPLES * frequency)
    force = mean + np.outer(np.sin(2.0 * np.pi * frequency * time), amplitude)
    orbit = journal.geometry.orbit(
        time,
        force,
        speed,
        journal.lubricant,
        cavitation=journal.cavitation,
        edge_pressure=journal.edge_pressure,
        grid=journal.grid,
        rung=journal.rung,
    )
    ratio = orbit["eccentricity_ratio"].values[1:].reshape(periods, SAMPLES)
    before, last = ratio[-2:].max(axis=1).tolist()
    return before, last
