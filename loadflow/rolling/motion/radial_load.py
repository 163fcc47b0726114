"""Radial load on one row of rollers between rigid circular rings, for a given load direction.

The planar equilibrium (5.13)–(5.16) of von Hollen 2013: balance along the load only, so that it
costs a few operations for each roller and time step. `RollerBearing.equilibrium` solves all five
directions.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError

Array = NDArray[np.float64]


class LineLaw(NamedTuple):
    """Force C δ^n over both contacts of a roller, N/m^n and 1."""

    constant: float
    exponent: float


class RadialDistribution(NamedTuple):
    """Displacement δ₀ of the ring (..., m) and roller loads R (..., roller, N)."""

    displacement: Array
    loads: Array


def behw_law(length: float) -> LineLaw:
    """C = 26 200 l^0.92 and n = 1.08 (N, mm) for a steel roller of `length` (m), (5.14), (5.15).

    Von Hollen prints I_eff δ^0.92 for l_eff^0.92.
    """
    return LineLaw(26_200 * (length * 1e3) ** 0.92 * 1e3**1.08, 1.08)


def iso_law(length: float) -> LineLaw:
    """C = 35 948 l^(8/9) and n = 10/9 (N, mm) for a steel roller of `length` (m), ISO/TS 16281."""
    return LineLaw(35_948 * (length * 1e3) ** (8 / 9) * 1e3 ** (10 / 9), 10 / 9)


def radial_distribution(
    force: ArrayLike, azimuth: ArrayLike, clearance: float, law: LineLaw
) -> RadialDistribution:
    """Roller loads under a radial force.

    Parameters
    ----------
    force : array_like, shape (...)
        Magnitude of the force, N.
    azimuth : array_like, shape (..., roller)
        Angles of the rollers from the direction of the force, rad.
    clearance : float
        Diametral clearance e ≥ 0, m.
    law : LineLaw
        `behw_law` or `iso_law`.

    Raises
    ------
    InputError
        Negative clearance, or a force that is negative or not finite.
    SolverError
        If no roller can carry the force, or Newton's method does not converge.

    Examples
    --------
    >>> import numpy as np
    >>> angles = 2 * np.pi * np.arange(14) / 14
    >>> found = radial_distribution(2000.0, angles, 8e-6, behw_law(11e-3))
    >>> round(float(found.displacement) * 1e6, 4), round(float(found.loads[0]), 2)
    (8.6408, 718.29)
    """
    load, cos = np.asarray(force, float), np.cos(np.asarray(azimuth, float))
    if not clearance >= 0:
        raise InputError(f"clearance: must be ≥ 0 m, got {clearance}")
    if not (np.isfinite(load) & (load >= 0)).all():
        raise InputError("force: must be finite and ≥ 0 N")
    shape = np.broadcast_shapes(load.shape, cos.shape[:-1])
    load, cos = np.broadcast_to(load, shape), np.broadcast_to(cos, (*shape, cos.shape[-1]))
    nearest = cos.max(axis=-1)
    if (nearest <= 0).any():
        raise SolverError("no roller lies on the side of the load")
    slack, (constant, power) = clearance / 2, law
    # all on the nearest roller: from above, Newton falls monotonically on the convex balance
    shift = (slack + (load / (constant * nearest)) ** (1 / power)) / nearest
    for _ in range(60):
        # so close to the edge of the load zone that slopes vanish, a tiny one keeps them finite
        delta = np.maximum(shift[..., None] * cos - slack, 0.0)
        slope = constant * delta ** (power - 1)
        excess = (slope * delta * cos).sum(axis=-1) - load
        stiffness = power * (slope * cos * cos).sum(axis=-1)
        step = np.divide(excess, stiffness, out=np.zeros_like(shift), where=stiffness > 0)
        shift = shift - step
        # rounding of the shift against the slack leaves up to 1e-12 N
        if (np.abs(excess) <= np.maximum(1e-12 * load, 1e-11)).all():
            break
    else:
        worst = float(np.max(np.abs(excess)))
        raise SolverError(f"radial load distribution: {worst:.3g} N unbalanced after 60 steps")
    delta = np.maximum(shift[..., None] * cos - slack, 0.0)
    return RadialDistribution(shift, constant * delta**power)
