"""Tables of contacts that the equilibrium solver takes.

A table has one line for each kind of contact (row and diagonal of balls, or row and slice of
rollers), repeated at each element with azimuth φ. Columns: RADIUS and HEIGHT of the point of the
inner ring that the contact acts on; NORMAL_R and NORMAL_Z; FREE, GAP, STIFFNESS.

Point contact: (NORMAL_R, NORMAL_Z) is the vector from the outer to the inner groove centre, FREE
the distance of both at touch, GAP = |vector|² - FREE² (kept apart so that nothing cancels);
F = K δ^1.5 along the actual vector. Line contact: (NORMAL_R, NORMAL_Z) is the fixed unit normal,
GAP the clearance along it; F = K δ^(10/9).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Spans = NDArray[np.int64]
Raceway = Literal["inner", "outer"]

POINT, LINE = 0, 1  # laws of contact
RADIUS, HEIGHT, NORMAL_R, NORMAL_Z, FREE, GAP, STIFFNESS = range(7)


@dataclass(frozen=True)
class Contacts:
    """All contacts of a bearing between its two rigid rings.

    Attributes
    ----------
    table : ndarray, shape (kind, 7)
        One line for each kind of contact; columns as in the module.
    azimuth : ndarray, shape (element,)
        Azimuth of each rolling element from the x axis toward y, rad.
    law : int
        0 for point contacts, 1 for line contacts.
    spatial : bool
        Whether the distance of the groove centres counts their tangential motion.
    cap : float
        Longest step of one iteration, m.
    lever : float
        Length that turns rotations into displacements in residuals, m.
    spans : ndarray of int, shape (kind, 2), optional
        First and last + 1 of the elements that each kind has; all of them if not given.
    """

    table: Array
    azimuth: Array
    law: int
    spatial: bool
    cap: float
    lever: float
    spans: Spans | None = None

    @property
    def elements(self) -> Spans:
        """First and last + 1 of the elements of each kind, (kind, 2)."""
        if self.spans is not None:
            return self.spans
        return np.tile(np.array([0, len(self.azimuth)]), (len(self.table), 1))

    @property
    def kind_azimuth(self) -> Array:
        """Azimuths of each kind's elements, (kind, element), rad; a short kind ends with zeros."""
        spans = self.elements
        azimuth = np.zeros((len(spans), int(np.max(spans[:, 1] - spans[:, 0]))))
        for row, (first, last) in zip(azimuth, spans):
            row[: last - first] = self.azimuth[first:last]
        return azimuth

    @property
    def arguments(self) -> tuple[Array, Array, Spans, Array, int, float]:
        """Arguments common to all kernels."""
        return (
            np.cos(self.azimuth),
            np.sin(self.azimuth),
            self.elements,
            self.table,
            self.law,
            float(self.spatial),
        )

    def unit_compliance(self) -> Array:
        """Inverse of the Hessian if each contact had unit stiffness: shape of a cold start."""
        matrix = np.zeros((5, 5))
        for (first, last), (radius, height, normal_r, normal_z, *_) in zip(
            self.elements, self.table
        ):
            azimuth = self.azimuth[first:last]
            cos, sin, zero = np.cos(azimuth), np.sin(azimuth), np.zeros(last - first)
            radial = np.stack([cos, sin, zero, -height * sin, height * cos])
            axial = np.stack([zero, zero, zero + 1, radius * sin, -radius * cos])
            along = (normal_r * radial + normal_z * axial) / np.hypot(normal_r, normal_z)
            matrix += along @ along.T
        scale = self.scale
        scaled = scale[:, None] * matrix * scale
        scaled += 1e-6 * np.trace(scaled) * np.eye(5)
        return scale[:, None] * np.linalg.inv(scaled) * scale

    @property
    def scale(self) -> Array:
        """Factors that turn the scaled unknowns (all lengths) into (ux, uy, uz, θx, θy)."""
        return np.array([1.0, 1.0, 1.0, 1 / self.lever, 1 / self.lever])


def row_sides(rows: int, arrangement: str) -> list[float]:
    """Which way each row carries: +1 for +Fz on the inner ring, -1 for -Fz, from the lowest row.

    A single row carries +Fz. Back-to-back, the row at -z carries +Fz, so that the lines of contact
    meet the axis far apart.
    """
    if rows == 1 or arrangement == "tandem":
        return [1.0] * rows
    first = 1.0 if arrangement == "back-to-back" else -1.0
    return [first if k < rows / 2 else -first for k in range(rows)]


def mean_offset(rows: int, spacing: float, arrangement: str) -> float:
    """Axial place of a row on the side to which its normal points outward, m, mean of all rows.

    Negative back-to-back, positive face-to-face, 0 in tandem.
    """
    places = [(k - (rows - 1) / 2) * spacing for k in range(rows)]
    return sum(z * side for z, side in zip(places, row_sides(rows, arrangement))) / rows


def azimuths(count: int, first: float = 0.0) -> Array:
    """Azimuths of `count` equally spaced elements, the first at `first` rad."""
    return first + 2 * np.pi * np.arange(count) / count
