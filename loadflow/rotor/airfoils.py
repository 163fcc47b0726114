"""What an airfoil in flow that changes needs of its polar: potential flow, and how far it holds."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.turbines import Airfoil

Array = NDArray[np.float64]

_RANGE = np.radians(15.0)  # around zero: where the angle of zero lift is sought
_NEAR, _FAR = np.radians(2.0), np.radians(15.0)  # from zero lift: where flow is most attached


class PotentialFlow(NamedTuple):
    """Normal force of attached flow over the angle of attack, a straight line."""

    zero: float  # angle of zero lift, rad
    slope: float  # 1/rad; 0: a section without lift, as a cylinder
    friction: float  # drag at zero lift


class Separation(NamedTuple):
    """Attached and separated flow over `p` angles of attack.

    Steady lift is `attached` × that of potential flow + (1 − `attached`) × `separated`.
    """

    attached: Array  # (p,), 1 attached … 0 separated
    separated: Array  # (p,), lift coefficient where nothing is attached


def potential_flow(foil: Airfoil) -> PotentialFlow:
    """Potential flow as the airfoil states it, otherwise found in its polar.

    The slope found is the steepest line from zero lift to the normal force of the polar between 2°
    and 15° above it, so that potential flow bounds the polar there.

    Parameters
    ----------
    foil : Airfoil

    Returns
    -------
    PotentialFlow
        All zero for a section without lift.
    """
    angle = np.linspace(-_RANGE, _RANGE, 601)
    lift = np.interp(angle, foil.angle, foil.lift)
    rises = np.flatnonzero((lift[:-1] < 0) & (lift[1:] >= 0))
    if rises.size == 0:
        return PotentialFlow(0.0, 0.0, 0.0)
    k = rises[-1]
    zero = angle[k] - lift[k] * (angle[k + 1] - angle[k]) / (lift[k + 1] - lift[k])
    friction = float(np.interp(zero, foil.angle, foil.drag))
    if foil.zero_lift is not None:
        zero = foil.zero_lift
    if foil.lift_slope is not None:
        return PotentialFlow(float(zero), foil.lift_slope, friction)
    angle = zero + np.linspace(_NEAR, _FAR, 100)
    lift, drag = (np.interp(angle, foil.angle, y) for y in (foil.lift, foil.drag))
    normal = lift * np.cos(angle) + (drag - friction) * np.sin(angle)
    return PotentialFlow(float(zero), float(np.max(normal / (angle - zero))), friction)


def separation(foil: Airfoil, flow: PotentialFlow, angle: Array) -> Separation:
    """Split a polar by Kirchhoff's formula, lift = slope (α − α₀) ((1 + √f)/2)².

    As in Hansen, Gaunaa and Madsen, Risø-R-1354 (2004). Where lift falls below a quarter of that of
    potential flow, and farther out, the flow is separated. Where lift exceeds potential flow or has
    the other sign, the formula has no answer. Then the sum follows the polar all the same, unless
    the airfoil states its potential flow: there the flow is attached if that is nearer to the polar
    than separated flow with half the lift, as OpenFAST has it, and the sum is not the polar.

    Parameters
    ----------
    foil : Airfoil
    flow : PotentialFlow
    angle : ndarray, shape (p,)
        Angles of attack, rising, rad.

    Returns
    -------
    Separation
    """
    lift = np.interp(angle, foil.angle, foil.lift)
    if flow.slope == 0.0:
        return Separation(np.zeros(angle.size), lift)
    off = angle - flow.zero
    potential = flow.slope * off
    ratio = np.where(potential == 0.0, 1.0, lift / np.where(potential == 0.0, 1.0, potential))
    attached = np.minimum((2 * np.sqrt(np.maximum(ratio, 0.0)) - 1) ** 2, 1.0)
    firm = attached == 1.0
    separated = np.where(
        firm, 0.5 * lift, (lift - attached * potential) / np.where(firm, 1.0, 1 - attached)
    )
    if foil.zero_lift is None and foil.lift_slope is None:
        beyond, against = ratio > 1, ratio < 0
        attached[beyond], attached[against] = 1 / ratio[beyond], 0.0
        separated[beyond], separated[against] = (lift + potential)[beyond], lift[against]
    else:
        between = potential - separated
        share = (lift - separated) / np.where(between == 0.0, 1.0, between)
        attached = np.where(between == 0.0, 1.0, np.clip(share, 0.0, 1.0))
    apart = _stalled(ratio, off)
    attached[apart], separated[apart] = 0.0, lift[apart]
    return Separation(attached, separated)


def _stalled(ratio: Array, off: Array) -> NDArray[np.bool_]:
    """Places beyond the first one, on either side of zero lift, without attached flow."""
    apart = np.zeros(off.size, bool)
    for side in (1, -1):
        order = np.argsort(side * off)
        distance = side * off[order]
        firmest = np.where((distance >= _NEAR) & (distance <= _FAR), ratio[order], -np.inf)
        start = int(np.argmax(firmest))
        beyond = np.logical_or.accumulate(ratio[order][start:] <= 0.25)
        apart[order[start:]] |= beyond
    return apart
