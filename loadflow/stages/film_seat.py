"""The film of a journal bearing as the shaft feels it, for `loadflow.shaft.bearing_loads`."""

from __future__ import annotations

import numpy as np

from loadflow.errors import SolverError
from loadflow.scene import Journal
from loadflow.shaft import BearingModel
from loadflow.stages.journal import equilibria

Floats = np.ndarray

_TURN = np.array([[0.0, -1.0], [1.0, 0.0]])
"""From (y, z) of the cube to the plane of the film, (−z, y)."""


def film_model(options: Journal, speed: Floats) -> BearingModel:
    """Eccentricity and exact stiffness of the film under each load, for an aligned shaft.

    Parameters
    ----------
    options : Journal
        Bearing, oil and film.
    speed : ndarray, shape (n,)
        Rotor speed of each load, rad/s.

    Returns
    -------
    BearingModel
        It raises `loadflow.errors.SolverError` for a load that no film carries.
    """

    def model(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
        answer = equilibria(options.model_copy(update={"tilt": False}), force, speed)
        if not np.all(answer.converged):
            worst = int(np.argmin(answer.converged))
            raise SolverError(
                f"no film carries {np.hypot(*force[worst, 1:]):.4g} N at {speed[worst]:.4g} rad/s"
            )
        return answer.eccentricity @ _TURN, _TURN.T @ answer.stiffness @ _TURN

    return model
