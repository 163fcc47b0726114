"""What unsteady attached flow needs of an airfoil, found in its polar."""

from __future__ import annotations

import numpy as np

from loadflow.turbines import Airfoil

_RANGE = np.radians(15.0)  # around zero: where the angle of zero lift is sought
_NEAR, _FAR = np.radians(2.0), np.radians(15.0)  # from zero lift: where the slope is taken


def attached_flow(foil: Airfoil) -> tuple[float, float, float]:
    """Angle of zero lift, slope of potential flow and drag at zero lift.

    The slope is the steepest line from zero lift to the normal force of the polar between 2° and
    15° off it, on either side, so that potential flow bounds the polar there.

    Parameters
    ----------
    foil : Airfoil

    Returns
    -------
    tuple of float
        rad, 1/rad, −; all zero for a section without lift, as a cylinder.
    """
    angle = np.linspace(-_RANGE, _RANGE, 601)
    lift = np.interp(angle, foil.angle, foil.lift)
    rises = np.flatnonzero((lift[:-1] < 0) & (lift[1:] >= 0))
    if rises.size == 0:
        return 0.0, 0.0, 0.0
    k = rises[-1]
    zero = angle[k] - lift[k] * (angle[k + 1] - angle[k]) / (lift[k + 1] - lift[k])
    friction = float(np.interp(zero, foil.angle, foil.drag))
    off = np.linspace(_NEAR, _FAR, 100)
    angle = zero + np.concatenate([-off, off])
    lift, drag = (np.interp(angle, foil.angle, y) for y in (foil.lift, foil.drag))
    normal = lift * np.cos(angle) + (drag - friction) * np.sin(angle)
    return float(zero), float(np.max(normal / (angle - zero))), friction
