"""A rolling bearing as the shaft feels it, for `loadflow.shaft.bearing_loads`."""

from __future__ import annotations

import numpy as np

from loadflow.rolling.stiffness.over_speed import condensed
from loadflow.scene.bearings import FurtherBearing
from loadflow.shaft import BearingModel
from loadflow.stages.rolling_at_work import rest

Floats = np.ndarray


def rolling_model(
    part: FurtherBearing, thrust: Floats, *, tilting: bool = False, strict: bool = True
) -> BearingModel:
    """Motion of the inner ring and tangent stiffness under each load and thrust.

    Parameters
    ----------
    part : FurtherBearing
        Geometry and rings.
    thrust : ndarray, shape (n,)
        Axial force on the bearing under each load, N; it stays as it is while the bearing gives.
    tilting : bool
        Whether the bearing takes the moment; else it tilts freely, and the model has no tilt.
    strict : bool
        Raise `loadflow.errors.SolverError` for a load without an equilibrium; else it has NaN.
    """
    # in the frame of the bearing: y and z of the cube first, its x last
    kept = [0, 1, 3, 4] if tilting else [0, 1]

    def model(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
        pushed = np.concatenate([thrust[:, None], force[:, 1:]], axis=1)
        answer = rest(part, pushed, moment * tilting, strict=strict)
        motion = np.where(answer.converged[:, None], answer.displacement, np.nan)[:, kept]
        return motion, condensed(answer.stiffness, answer.contacts.scale, kept)

    return model
