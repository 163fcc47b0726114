"""The film of a journal bearing as the shaft feels it, for `loadflow.shaft.bearing_loads`."""

from __future__ import annotations

import numpy as np

from loadflow.errors import SolverError
from loadflow.scene.journal import Journal
from loadflow.shaft import BearingModel
from loadflow.stages.films.of_bearing import equilibria

Floats = np.ndarray

ALIGNED = np.zeros(3)

TURN = np.kron(np.eye(2), [[0.0, -1.0], [1.0, 0.0]])
"""From (y, z, θy, θz) of the cube to the axes of the film, (−z, y, −θz, θy)."""


def film_model(
    options: Journal,
    speed: Floats,
    *,
    tilting: bool = False,
    strict: bool = True,
    bore: Floats = ALIGNED,
) -> BearingModel:
    """Position and exact stiffness of the film under each load.

    Parameters
    ----------
    options : Journal
        Bearing, oil and film.
    speed : ndarray, shape (n,)
        Rotor speed of each load, rad/s.
    tilting : bool
        Whether the shaft tilts under the moment, which the film then takes; else it stays aligned,
        and the model has no tilt.
    strict : bool
        Raise `loadflow.errors.SolverError` for a load that no film carries; else it has NaN.
    bore : ndarray, shape (3,)
        How far the bore is turned against a shaft that does not bend, rad, in the cube: the shaft
        of a film without moment is turned as much.
    """
    n, size = len(speed), 4 if tilting else 2
    turn, aligned = TURN[:size, :size], options.model_copy(update={"tilt": False})
    last, motion = np.full((n, 6), np.nan), np.empty((n, size))
    stiffness = np.empty((n, size, size))

    def model(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
        load = np.concatenate([force, moment if tilting else np.zeros((n, 3))], axis=1)
        new = np.flatnonzero((load != last).any(axis=1))  # the others are known from the last time
        if new.size:
            line = {"moment": moment[new]} if tilting else {}
            answer = equilibria(aligned, force[new], speed[new], **line)
            if strict and not np.all(answer.converged):
                k = new[int(np.argmin(answer.converged))]
                raise SolverError(
                    f"no film carries {np.hypot(*force[k, 1:]):.4g} N at {speed[k]:.4g} rad/s"
                )
            parts = (answer.eccentricity, answer.tilt) if tilting else (answer.eccentricity,)
            moved = np.concatenate(parts, axis=1)
            last[new], motion[new] = load[new], moved @ turn
            motion[new, 2:] += bore[1 : size - 1]
            stiffness[new] = turn.T @ answer.stiffness @ turn
        return motion.copy(), stiffness.copy()

    return model
