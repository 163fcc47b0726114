"""Few unknowns across the width: collocation on the nodes of Gauss and Lobatto."""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Axial(NamedTuple):
    """Pressure over the half width from its values at m points, given that at the bearing end.

    With q = p − p_edge at the points, lengths in shaft radii:

    Attributes
    ----------
    points : array (m,)
        From mid-plane to the bearing end.
    weights : array (m,)
        ∫ q dz = weights · q.
    stiffness : array (m, m)
        ∫ (∂q)² dz = q · stiffness · q; also the axial outflow of each point in the balance.
    leak : array (m,)
        −∂p at the bearing end is leak · q.
    middle : array (m,)
        q at mid-plane is middle · q.
    rim_weight : float
        Width that belongs to the bearing end itself.
    """

    points: Array
    weights: Array
    stiffness: Array
    leak: Array
    middle: Array
    rim_weight: float


@lru_cache(maxsize=8)
def lobatto(half_width: float, nodes: int) -> Axial:
    """Even polynomials q = (1 − ζ²)(a_0 + a_1 ζ² + …), ζ = z/half_width, at `nodes` points.

    The points are those of the Gauss–Lobatto rule over the full width, so that collocation there
    is the Galerkin method with that rule: the axial operator is exact and symmetric, the fill is
    taken at the points.
    """
    degree = 2 * nodes + 1
    series = np.zeros(degree + 1)
    series[degree] = 1.0
    inner = np.sort(legendre.legroots(legendre.legder(series)).real)
    zeta = inner[inner > 0][:nodes]
    rim = 2.0 / (degree * (degree + 1))
    weights = np.asarray(rim / legendre.legval(zeta, series) ** 2, dtype=float)
    power = 2 * np.arange(nodes)
    column = zeta[:, None]
    from_values = np.linalg.inv((1 - column**2) * column**power)
    curvature = power * (power - 1) * column ** np.maximum(power - 2, 0)
    curvature = curvature - (power + 2) * (power + 1) * column**power
    stiffness = -weights[:, None] * (curvature @ from_values)
    return Axial(
        points=half_width * zeta,
        weights=half_width * weights,
        stiffness=0.5 * (stiffness + stiffness.T) / half_width,
        leak=2.0 * from_values.sum(axis=0) / half_width,
        middle=from_values[0].copy(),
        rim_weight=half_width * rim,
    )
