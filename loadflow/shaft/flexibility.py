"""Flexibility of a stepped shaft, in closed form (theorem of Castigliano).

In one plane a station at x has the force F with the displacement w, or the moment m with the slope
φ. Everything left of a section gives it the bending moment M(x) = Σ F (x − x_k) − Σ m and the
shear force Q(x) = Σ F; M/(E I) is the curvature w″. M is linear between stations, so two Gauss
points give ∫ M_i M_j / (E I) dx exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.shaft.beam import Beam

Floats = NDArray[np.float64]

_GAUSS = 0.5 / np.sqrt(3.0)  # place of both points, in widths from the middle


@dataclass(frozen=True)
class Stations:
    """Where forces and moments act on the shaft, in one plane.

    Attributes
    ----------
    place : ndarray, shape (k,)
        m from the hub centre.
    is_moment : ndarray of bool, shape (k,)
        Whether the station has a moment (and a slope) or a force (and a displacement).
    """

    place: Floats
    is_moment: NDArray[np.bool_]

    def bending(self, x: Floats) -> Floats:
        """Bending moment at `x` (…) of a unit load at each station, (…, k)."""
        arm = np.maximum(x[..., None] - self.place, 0.0)
        # half at the station itself, where the moment jumps: the mean of both sides
        step = np.heaviside(x[..., None] - self.place, 0.5)
        return np.where(self.is_moment, -step, arm)

    def shear(self, x: Floats) -> Floats:
        """Shear force at `x` (…) of a unit load at each station, (…, k)."""
        return np.where(self.is_moment, 0.0, np.heaviside(x[..., None] - self.place, 0.5))

    def rigid(self, end: float) -> Floats:
        """Motion of each station, (k, 2), by a unit shift and a unit slope of the shaft's end."""
        shift = np.where(self.is_moment, 0.0, 1.0)
        return np.stack([shift, np.where(self.is_moment, 1.0, self.place - end)], axis=-1)


def flexibility(beam: Beam, stations: Stations, end: float) -> Floats:
    """Motion of each station by a unit load at each, (k, k), of a shaft clamped at its end.

    Loads in equilibrium deform the shaft in the same way wherever it is held; what differs is a
    motion of the rigid shaft (`Stations.rigid`).
    """
    total = np.zeros((stations.place.size,) * 2)
    modulus = beam.youngs_modulus
    for start, stop, section in beam.stretches(end):
        inner = stations.place[(stations.place > start) & (stations.place < stop)]
        edges = np.unique(np.concatenate([[start], inner, [stop]]))
        width, middle = np.diff(edges), (edges[1:] + edges[:-1]) / 2
        weight = width / (2 * modulus * section.inertia)
        for place in (-_GAUSS, _GAUSS):
            lines = stations.bending(middle + place * width)
            total += np.einsum("e,ei,ej->ij", weight, lines, lines)
        if beam.shear:
            rigidity = modulus / (2 * (1 + beam.poisson)) * section.area
            lines = stations.shear(middle)
            compliance = width / (rigidity * section.shear_coefficient(beam.poisson))
            total += np.einsum("e,ei,ej->ij", compliance, lines, lines)
    return total


def curvature(beam: Beam, stations: Stations, loads: Floats, at: Floats, end: float) -> Floats:
    """Curvature w″ at the places `at` (b,) under `loads` (k, n), (b, n), 1/m."""
    stiffness = np.empty(at.size)
    for start, stop, section in beam.stretches(end):
        stiffness[(at >= start) & (at <= stop)] = beam.youngs_modulus * section.inertia
    return stations.bending(at) @ loads / stiffness[:, None]
