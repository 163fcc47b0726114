"""One temperature for a film in motion: friction warms it over hours, loads change in seconds."""

from __future__ import annotations

import numpy as np

from loadflow.errors import SolverError
from loadflow.scene.journal import Journal

TEMPERATURE_SAMPLES = 64
"""Samples of a series whose mean friction and flow give the temperature of a film in motion."""


def mean_temperature(
    options: Journal, force: np.ndarray, speed: np.ndarray, **line: np.ndarray
) -> float | None:
    """Temperature (K) of a film in motion under `force` (n, 2) in its frame; None without heat.

    `line` is how the shaft lies, each (n, 2), as for an equilibrium.

    It is that of the mean friction and flow of `TEMPERATURE_SAMPLES` equilibria of the series.

    Raises
    ------
    loadflow.errors.SolverError
        No heat balance below the largest temperature.
    """
    if options.heat is None:
        return None
    some = np.unique(np.linspace(0, speed.size - 1, TEMPERATURE_SAMPLES).round().astype(int))
    warm = options.geometry.equilibrium(
        force[some],
        speed[some],
        options.film_model,
        weights=np.ones(some.size),
        strict=False,
        **{name: rows[some] for name, rows in line.items()},
    )
    if not np.any(warm.converged):
        raise SolverError("orbit cannot start: no heat balance of its mean friction and flow")
    return float(np.asarray(warm.temperature)[0])
