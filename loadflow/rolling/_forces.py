"""Compiled loops from the displacement of the inner ring to the forces of all contacts.

Apart from the solver's loops, whose functions these do not call.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.numerics.linked import njit
from loadflow.rolling._line_law import lever_of, ninth_root
from loadflow.rolling.contacts import (
    FREE,
    GAP,
    HEIGHT,
    LINE,
    NORMAL_R,
    NORMAL_Z,
    POINT,
    RADIUS,
    STIFFNESS,
    Array,
    Spans,
)

# Sums may be reordered (so that they use vector units); nothing else of fast mathematics.
_REORDER = {"reassoc", "contract", "nsz"}


@njit(cache=True, nogil=True, error_model="numpy", inline="always")
def _approach(line: Array, law: int, dr: float, dt: float, dz: float) -> float:
    """Approach δ ≥ 0 of one contact whose inner end moves by dr, dt, dz."""
    along = line[NORMAL_R] * dr + line[NORMAL_Z] * dz
    if law == LINE:
        return max(along - line[GAP], 0.0)
    r, z = line[NORMAL_R] + dr, line[NORMAL_Z] + dz
    stretch = 2.0 * along + dr * dr + dt * dt + dz * dz + line[GAP]
    return max(stretch, 0.0) / (math.sqrt(r * r + dt * dt + z * z) + line[FREE])


@njit(cache=True, nogil=True, error_model="numpy")
def contact_state(
    displacement: Array,
    cos: Array,
    sin: Array,
    spans: Spans,
    table: Array,
    law: int,
    spatial: float,
) -> tuple[Array, Array]:
    """Force and signed angle (from the radial plane) of each contact, (n, kind, element).

    A kind with fewer elements than another is filled up with zeros.
    """
    n, kinds, count = displacement.shape[0], table.shape[0], 0
    for k in range(kinds):
        count = max(count, spans[k, 1] - spans[k, 0])
    force, angle = np.zeros((n, kinds, count)), np.zeros((n, kinds, count))
    for j in range(n):
        q = displacement[j]
        for k in range(kinds):
            line, first = table[k], spans[k, 0]
            for i in range(spans[k, 1] - first):
                c, s = cos[first + i], sin[first + i]
                ur, ut = q[0] * c + q[1] * s, q[1] * c - q[0] * s
                om, ro = q[4] * c - q[3] * s, q[3] * c + q[4] * s
                dr, dz = ur + line[HEIGHT] * om, q[2] - line[RADIUS] * om
                dt = spatial * (ut - line[HEIGHT] * ro)
                delta = _approach(line, law, dr, dt, dz)
                power = 1.5 if law == POINT else 10.0 / 9.0
                force[j, k, i] = line[STIFFNESS] * delta**power
                if law == LINE:
                    dr = dz = 0.0
                angle[j, k, i] = math.atan2(line[NORMAL_Z] + dz, line[NORMAL_R] + dr)
    return force, angle


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def _point_sums(
    q: Array, cos: Array, sin: Array, line: Array, spatial: float, forces: Array
) -> tuple[float, float, float]:
    """Sums of F, F³, F^(10/3) of one kind of point contact; fills `forces`."""
    big, h = line[RADIUS], line[HEIGHT]
    ux, uy, tx, ty = q[0] + h * q[4], q[1] - h * q[3], big * q[3], big * q[4]
    third = line[STIFFNESS] ** (1.0 / 3.0)
    first = cubes = powers = 0.0
    for i in range(cos.shape[0]):
        c, s = cos[i], sin[i]
        dt = spatial * (uy * c - ux * s)
        delta = _approach(line, POINT, ux * c + uy * s, dt, q[2] + tx * s - ty * c)
        root = math.sqrt(delta)
        force = line[STIFFNESS] * delta * root
        cube = force * force * force
        forces[i] = force
        first += force
        cubes += cube
        powers += cube * third * root
    return first, cubes, powers


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def _line_sums(
    q: Array, cos: Array, sin: Array, line: Array, forces: Array
) -> tuple[float, float, float]:
    """Sums of F, F⁴, F^(9/2) of one kind of line contact; fills `forces`."""
    lever = lever_of(line)
    fixed = line[NORMAL_Z] * q[2] - line[GAP]
    x, y = line[NORMAL_R] * q[0] + lever * q[4], line[NORMAL_R] * q[1] - lever * q[3]
    stiffness = line[STIFFNESS]
    first = fourth = powers = 0.0
    for i in range(cos.shape[0]):
        delta = max(x * cos[i] + y * sin[i] + fixed, 0.0)
        force = stiffness * delta * ninth_root(delta)
        square = force * force
        forces[i] = force
        first += force
        fourth += square * square
        powers += square * square * math.sqrt(force)
    return first, fourth, powers


@njit(cache=True, nogil=True, error_model="numpy")
def row_forces(
    displacement: Array, cos: Array, sin: Array, spans: Spans, table: Array, rows: int
) -> Array:
    """Sums of the forces of each row's kinds of line contact, (n, row, element).

    Loops over kinds outside, so that the inner loop runs along the ring.
    """
    n, kinds = displacement.shape[0], table.shape[0] // rows
    count = spans[0, 1] - spans[0, 0]
    force = np.zeros((n, rows, count))
    for j in range(n):
        q = displacement[j]
        for row in range(rows):
            total = force[j, row]
            for k in range(row * kinds, (row + 1) * kinds):
                line, first = table[k], spans[k, 0]
                lever = lever_of(line)
                fixed = line[NORMAL_Z] * q[2] - line[GAP]
                x = line[NORMAL_R] * q[0] + lever * q[4]
                y = line[NORMAL_R] * q[1] - lever * q[3]
                stiffness = line[STIFFNESS]
                for i in range(count):
                    delta = max(x * cos[first + i] + y * sin[first + i] + fixed, 0.0)
                    total[i] += stiffness * delta * ninth_root(delta)
    return force


@njit(cache=True, nogil=True)
def force_sums(
    displacement: Array,
    cos: Array,
    sin: Array,
    spans: Spans,
    table: Array,
    law: int,
    spatial: float,
) -> tuple[Array, Array]:
    """Largest force (n, kind) and sums of powers of the forces (n, kind, 3).

    The powers are 1, 3, 10/3 of points and 1, 4, 9/2 of lines, as the lives of the raceways need.
    """
    n, kinds = displacement.shape[0], table.shape[0]
    largest, sums = np.zeros((n, kinds)), np.zeros((n, kinds, 3))
    forces = np.zeros(cos.shape[0])
    for j in range(n):
        for k in range(kinds):
            c, s = cos[spans[k, 0] : spans[k, 1]], sin[spans[k, 0] : spans[k, 1]]
            if law == POINT:
                part = _point_sums(displacement[j], c, s, table[k], spatial, forces)
            else:
                part = _line_sums(displacement[j], c, s, table[k], forces)
            sums[j, k, 0], sums[j, k, 1], sums[j, k, 2] = part
            for i in range(c.shape[0]):  # apart from the sums: a maximum keeps off vector units
                largest[j, k] = max(largest[j, k], forces[i])
    return largest, sums
