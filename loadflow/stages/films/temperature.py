"""One temperature for a film in motion: friction warms it over hours, loads change in seconds."""

from __future__ import annotations

import numpy as np

from loadflow.errors import InputError
from loadflow.journal.heat import Heat
from loadflow.journal.line import Line
from loadflow.journal.models.model import model_of
from loadflow.journal.warm_orbit import series_temperature
from loadflow.scene.journal import Journal


def mean_temperature(
    options: Journal, force: np.ndarray, speed: np.ndarray, **line: np.ndarray
) -> float | None:
    """Temperature (K) of a film in motion under `force` (n, 2) in its frame; None without heat.

    That of a path of the film alone, see `series_temperature`. `line` is how the shaft lies, each
    (n, 2), as for an equilibrium.

    Raises
    ------
    loadflow.errors.InputError
        Heat over the area of the film, which has no single temperature.
    loadflow.errors.SolverError
        No heat balance below the largest temperature.
    """
    if options.heat is None:
        return None
    if not isinstance(options.heat, Heat):
        raise InputError(
            "journal.heat over the area of the film has no single temperature; a table "
            "journal.heat of one temperature has"
        )
    film, bearing, lies = options.film_model, options.geometry, Line.of(speed.shape, 0.0, **line)
    model = model_of("at_rest", film, bearing, lies)
    return series_temperature(model, bearing, film, force, speed, lies)
