"""What dynamic stall needs of a polar: how far the flow is attached, and what that does to lift."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.turbines import Airfoil

from .airfoils import attached_flow

Array = NDArray[np.float64]
_NEAR, _FAR = np.radians(2.0), np.radians(15.0)  # from zero lift: where flow is most attached


class Separation(NamedTuple):
    """Attached and separated flow over `p` angles of attack."""

    attached: Array  # (p,), 1 attached … 0 separated
    gain: Array  # (p,), lift coefficient of attached less that of separated flow


def separation(foil: Airfoil, angle: Array) -> Separation:
    """Split a polar by Kirchhoff's formula, lift = slope sin(α − α₀) ((1 + √f)/2)².

    As in Hansen, "Aerodynamics of Wind Turbines" (2008), (9.23) to (9.26), with the sine of the
    angle. Where lift falls below a quarter of that of attached flow, and farther out, the flow is
    separated.

    Parameters
    ----------
    foil : Airfoil
    angle : ndarray, shape (p,)
        Angles of attack, rising, rad.

    Returns
    -------
    Separation
        All zero for a section without lift, as a cylinder.
    """
    zero, slope, _ = attached_flow(foil)
    if slope == 0.0:
        return Separation(np.zeros(angle.size), np.zeros(angle.size))
    lift, potential = np.interp(angle, foil.angle, foil.lift), slope * np.sin(angle - zero)
    still = np.abs(angle - zero) < 1e-3
    ratio = np.where(still, 1.0, lift / np.where(still, 1.0, potential))
    root = 2 * np.sqrt(np.clip(ratio, 0.25, 1.0)) - 1
    upper = (angle >= zero + _NEAR) & (angle <= zero + _FAR)
    root[_beyond(root, int(np.argmax(root * upper)))] = 0.0
    # lift of separated flow: potential (1 + 3 √f)/(4 (1 + √f)), that of the polar where f = 0
    gain = potential * (3 + root) / (4 * (1 + root))
    whole = root == 0.0
    gain[whole] = potential[whole] - lift[whole]
    return Separation(root**2, gain)


def _beyond(root: Array, middle: int) -> NDArray[np.bool_]:
    """Places on the far side of the first one, from `middle` on, without attached flow."""
    apart = root == 0.0
    apart[middle:] = np.logical_or.accumulate(apart[middle:])
    apart[:middle] = np.logical_or.accumulate(apart[:middle][::-1])[::-1]
    return apart
