"""A journal bearing → how far its shaft moves under a load that swings at one frequency."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.scene.journal import Journal
from loadflow.stages.films.temperature import mean_temperature

Floats = NDArray[np.float64]
Response = Callable[[Floats, Floats, float], float]

SAMPLES = 48  # steps in a period


def film_response(journal: Journal, speed: float) -> Response:
    """Return ``response(mean, amplitude, frequency)`` for `loadflow.reduction.frequency_bounds`.

    It is the largest eccentricity ratio of the closed orbit under
    mean + amplitude · sin(2π frequency · t), by finite volumes (4.23) or on the rung "reduced". The
    closed orbit is solved for directly: near half the speed of the shaft the load drives its whirl,
    which would take hundreds of periods to decay.

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
        raises `SolverError` if the orbit does not close.
    """

    def response(mean: Floats, amplitude: Floats, frequency: float) -> float:
        warm = mean_temperature(journal, mean[None], np.array([speed]))
        held = journal if warm is None else journal.at_temperature(warm)
        phase = np.linspace(0.0, 2.0 * np.pi, SAMPLES + 1)
        with unresolved_counted():
            orbit = held.geometry.orbit(
                phase / (2.0 * np.pi * frequency),
                mean + np.outer(np.sin(phase), amplitude),
                speed,
                held.film_model.closing(),
                periodic=True,
            )
        return float(orbit["eccentricity_ratio"].max())

    return response
