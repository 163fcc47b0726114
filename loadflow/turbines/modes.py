"""Bending modes of a blade from its mass and stiffness."""

from __future__ import annotations

import numpy as np

from .checks import Array
from .schema import Mode

_POWERS = np.arange(2, 7)
_FINE = 2001


def bending_modes(
    span: Array, mass_density: Array, flap_stiffness: Array, edge_stiffness: Array
) -> tuple[Mode, ...]:
    """Two flap and one edge mode of a clamped blade at rest, by Ritz's method over x² … x⁶.

    Twist and rotation are left out of the shapes; the loop brings both in with the stiffness.

    Parameters
    ----------
    span : ndarray, shape (m,)
        Distance from the root, m.
    mass_density, flap_stiffness, edge_stiffness : ndarray, shape (m,)
        kg/m; N m².

    Returns
    -------
    tuple of Mode
        flap1, flap2, edge1.
    """
    from scipy.linalg import eigh

    x = np.linspace(0, 1, _FINE)

    def along(values: Array) -> Array:
        return np.interp(x * span[-1], span, values)

    shape = x[:, None] ** _POWERS
    curvature = _POWERS * (_POWERS - 1) * x[:, None] ** (_POWERS - 2)
    mass = np.trapezoid(
        along(mass_density)[:, None, None] * shape[:, :, None] * shape[:, None, :], x, axis=0
    )

    def modes(stiffness: Array, names: tuple[str, ...]) -> list[Mode]:
        bending = np.trapezoid(
            along(stiffness)[:, None, None] * curvature[:, :, None] * curvature[:, None, :],
            x,
            axis=0,
        )
        vectors = eigh(bending, mass)[1].T
        return [
            Mode(name, tuple((v / v.sum()).tolist()))
            for name, v in zip(names, vectors, strict=False)
        ]

    return (*modes(flap_stiffness, ("flap1", "flap2")), *modes(edge_stiffness, ("edge1",)))
