"""Compiled loops of rollers between flexible rings: slices of a line contact.

Fields of the contacts are two for each row of rollers: the approach at the roller's middle along
its normal, and what the relative turn of the raceways adds to it at the roller's end, both lengths.
`table` (row · slice, 3) holds the ARM of each slice from the middle over half the roller's length,
its GAP and STIFFNESS; F = K δ^(10/9) of each, all of them added up at once for a row.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.numerics.linked import LINKED, bare, njit
from loadflow.rolling._line_law import ninth_root

ARM, GAP, STIFFNESS = range(3)

# Sums may be reordered (so that they use vector units); nothing else of fast mathematics.
_REORDER = {"reassoc", "contract", "nsz"}


@bare(forceinline=True, fastmath=_REORDER, **LINKED)
def line_contacts(shift, table, push, slope, across, slant):
    """Fill push (2 row, roller), slope, across and slant (row, roller) of rollers by their shift.

    Slope is the stiffness of a roller along its normal, slant its lever over half the length, and
    across what resists a turn about that lever. Free of branches. Returns energy and sum of forces.
    """
    energy = total = 0.0
    rows = slope.shape[0]
    slices = table.shape[0] // rows
    for k in range(rows):
        middle, turn = shift[2 * k], shift[2 * k + 1]
        force, moment = push[2 * k], push[2 * k + 1]
        stiff, first, second = slope[k], slant[k], across[k]
        for j in range(middle.shape[0]):
            force[j] = moment[j] = stiff[j] = first[j] = second[j] = 0.0
        for s in range(k * slices, (k + 1) * slices):
            arm, gap, stiffness = table[s, ARM], table[s, GAP], table[s, STIFFNESS]
            square = arm * arm
            for j in range(middle.shape[0]):
                delta = max(middle[j] + arm * turn[j] - gap, 0.0)
                along = stiffness * ninth_root(delta)
                part = along * delta
                energy += part * delta
                force[j] += part
                moment[j] += arm * part
                stiff[j] += along
                first[j] += arm * along
                second[j] += square * along
        for j in range(middle.shape[0]):
            total += force[j]
            lever = first[j] / max(stiff[j], 1e-300)
            second[j] = 10.0 / 9.0 * max(second[j] - lever * first[j], 0.0)
            stiff[j] *= 10.0 / 9.0
            first[j] = lever
    return 9.0 / 19.0 * energy, total


@njit(cache=True, nogil=True, error_model="numpy")
def slice_forces(shift, table):
    """Force of each slice, (n, row · slice, roller), by the shift (n, row, 2, roller)."""
    cases, rows, _, count = shift.shape
    slices = table.shape[0] // rows
    force = np.zeros((cases, table.shape[0], count))
    for i in range(cases):
        for s in range(table.shape[0]):
            middle, turn = shift[i, s // slices]
            arm, gap, stiffness = table[s, ARM], table[s, GAP], table[s, STIFFNESS]
            for j in range(count):
                delta = max(middle[j] + arm * turn[j] - gap, 0.0)
                force[i, s, j] = stiffness * ninth_root(delta) * delta
    return force


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath=_REORDER, **LINKED)
def _row_forces(middle, turn, arm, gap, stiffness, force):
    """Fill the force of one slice of each roller of a row."""
    for j in range(force.shape[0]):
        delta = max(middle[j] + arm * turn[j] - gap, 0.0)
        force[j] = stiffness * ninth_root(delta) * delta


@njit(cache=True, nogil=True, error_model="numpy")
def roller_forces(shift, table):
    """Force of each roller, (n, row, roller), by the shift (n, row, 2, roller)."""
    cases, rows, _, count = shift.shape
    slices = table.shape[0] // rows
    force, one = np.zeros((cases, rows, count)), np.zeros(count)
    for i in range(cases):
        for s in range(table.shape[0]):
            row = s // slices
            total = force[i, row]
            _row_forces(
                shift[i, row, 0], shift[i, row, 1], table[s, ARM], table[s, GAP],
                table[s, STIFFNESS], one,
            )  # fmt: skip
            for j in range(count):
                total[j] += one[j]
    return force


@njit(forceinline=True, nogil=True, error_model="numpy", fastmath={"reassoc", "nsz", "nnan"})
def _largest(values):
    most = 0.0
    for j in range(values.shape[0]):
        most = max(most, values[j])
    return most


@njit(cache=True, nogil=True, error_model="numpy", fastmath=_REORDER)
def slice_sums(shift, table):
    """Largest force (n, row · slice) and sums of F, F⁴ and F^4.5, (n, row · slice, 3)."""
    cases, rows, _, count = shift.shape
    slices = table.shape[0] // rows
    largest, sums = np.zeros((cases, table.shape[0])), np.zeros((cases, table.shape[0], 3))
    one = np.zeros(count)
    for i in range(cases):
        for s in range(table.shape[0]):
            row = s // slices
            _row_forces(
                shift[i, row, 0], shift[i, row, 1], table[s, ARM], table[s, GAP],
                table[s, STIFFNESS], one,
            )  # fmt: skip
            first = fourth = powers = 0.0
            for j in range(count):
                force = one[j]
                square = force * force
                first += force
                fourth += square * square
                powers += square * square * math.sqrt(force)
            largest[i, s] = _largest(one)
            sums[i, s, 0], sums[i, s, 1], sums[i, s, 2] = first, fourth, powers
    return largest, sums
