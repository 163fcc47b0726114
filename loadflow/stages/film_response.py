"""A journal bearing → how far its shaft moves under a load that swings at one frequency."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.rungs import Rung
from loadflow.scene import Journal

Floats = NDArray[np.float64]
Response = Callable[[Floats, Floats, float], float]

SAMPLES = 48  # steps in a period
SETTLED = 2e-3  # relative change of the largest ε from one period to the next; 1 % decides (4.24)
DOUBLINGS = 6


def film_response(journal: Journal, speed: float, rung: Rung = "reduced") -> Response:
    """Return ``response(mean, amplitude, frequency)`` for `loadflow.reduction.frequency_bounds`.

    The orbit under mean + amplitude · sin(2π frequency · t) is followed from the equilibrium of the
    mean load (4.23). The amplitude swells over two revolutions of the shaft, as a sudden load would
    set it whirling at half its speed, which dies away slowly; then come two whole periods. If the
    largest eccentricity ratio still changes from one to the other, all of it is done twice as long.

    Parameters
    ----------
    journal : Journal
        Bearing, oil, cavitation and grid: the section of a scene.
    speed : float
        Mean speed of the rotor, rad/s.
    rung : {"reduced", "grid"}
        Model of the film. What decides is how the largest ε changes by steps of 1 %; there the
        reduced film agrees with the finite volumes to 0.1 %, at a small part of their time.

    Returns
    -------
    callable
        mean (2,), amplitude (2,) in N, frequency in Hz → largest eccentricity ratio per period;
        raises `SolverError` if the orbit does not settle.
    """

    def response(mean: Floats, amplitude: Floats, frequency: float) -> float:
        swell = 4.0 * np.pi / abs(speed)
        for _ in range(DOUBLINGS):
            film = (journal, speed, rung)
            before, last = _largest(film, mean, amplitude, frequency, swell)
            if abs(last - before) <= SETTLED * last:
                return last
            swell *= 2
        raise SolverError(
            f"the orbit at {frequency:g} Hz does not settle in {swell / 2:.3g} s: largest ε of two "
            f"periods {before:.5g}, then {last:.5g}"
        )

    return response


def _largest(
    film: tuple[Journal, float, Rung],
    mean: Floats,
    amplitude: Floats,
    frequency: float,
    swell: float,
) -> tuple[float, float]:
    """Largest eccentricity ratio of the last period but one, and of the last."""
    journal, speed, rung = film
    periods = int(np.ceil(swell * frequency)) + 2
    time = np.arange(periods * SAMPLES + 1) / (SAMPLES * frequency)
    grown = 0.5 - 0.5 * np.cos(np.pi * np.minimum(time / swell, 1.0))
    sine = grown * np.sin(2.0 * np.pi * frequency * time)
    orbit = journal.geometry.orbit(
        time,
        mean + np.outer(sine, amplitude),
        speed,
        journal.lubricant,
        cavitation=journal.cavitation,
        edge_pressure=journal.edge_pressure,
        grid=journal.grid,
        rung=rung,
    )
    ratio = orbit["eccentricity_ratio"].values[1:].reshape(periods, SAMPLES)
    before, last = ratio[-2:].max(axis=1).tolist()
    return before, last
