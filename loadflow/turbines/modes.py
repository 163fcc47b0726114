"""Bending modes of a blade or a tower from mass and stiffness."""

from __future__ import annotations

import numpy as np

from loadflow.errors import InputError

from .blade import Mode
from .checks import Array

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

    def modes(stiffness: Array, names: tuple[str, ...]) -> list[Mode]:
        shapes = clamped_shapes(span, mass_density, stiffness)
        return [Mode(name, tuple(c.tolist())) for name, c in zip(names, shapes, strict=False)]

    return (*modes(flap_stiffness, ("flap1", "flap2")), *modes(edge_stiffness, ("edge1",)))


def tower_mode(
    height: Array, mass_density: Array, stiffness: Array, top_mass: float
) -> tuple[float, ...]:
    """Coefficients of the first mode of a tower with rotor and nacelle as a point on its top."""
    return tuple(clamped_shapes(height, mass_density, stiffness, top_mass)[0].tolist())


def clamped_shapes(
    span: Array, mass_density: Array, stiffness: Array, end_mass: float = 0.0
) -> Array:
    """Mode shapes of a beam clamped at its first station, by Ritz's method over x² … x⁶.

    Parameters
    ----------
    span : ndarray, shape (m,)
        Stations along the beam, m; x runs from 0 at the first to 1 at the last.
    mass_density, stiffness : ndarray, shape (m,)
        kg/m; N m².
    end_mass : float
        A point on the free end, kg.

    Returns
    -------
    ndarray, shape (5, 5)
        Coefficients of x² … x⁶ of each mode, lowest first; they add up to 1.

    Raises
    ------
    InputError
        Stations that do not increase, or a beam without mass or stiffness.
    """
    from scipy.linalg import eigh

    x, length = np.linspace(0, 1, _FINE), span[-1] - span[0]

    def integral(values: Array, functions: Array) -> Array:
        weight = np.interp(span[0] + x * length, span, values)
        product = functions[:, :, None] * functions[:, None, :]
        return np.trapezoid(weight[:, None, None] * product, x, axis=0)

    curvature = _POWERS * (_POWERS - 1) * x[:, None] ** (_POWERS - 2)
    # every function is 1 at the end
    mass = integral(mass_density, x[:, None] ** _POWERS) + end_mass / length
    try:
        vectors = eigh(integral(stiffness, curvature), mass)[1].T
    except (np.linalg.LinAlgError, ValueError) as error:  # singular, or not finite
        raise InputError(
            "structure: stations must increase, and mass and stiffness be > 0 and finite; "
            f"got {span[0]:g} … {span[-1]:g} m, at most {mass_density.max():g} kg/m and "
            f"{stiffness.max():g} N m²"
        ) from error
    return vectors / vectors.sum(axis=1, keepdims=True)
