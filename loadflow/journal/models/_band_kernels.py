"""Compiled: linear systems of a film with few unknowns across the width.

The cells around are folded, so that the matrix has a band of two columns of cells on each side.
`lanes` is as long as there are points across: a tuple where the compiler is to know how long the
loops are.
"""

from __future__ import annotations

from loadflow.journal.models._compile import inner


@inner
def factorise(lanes, band, n):
    """LU of the first `n` rows of the band matrix in place, without pivoting.

    The columns of the balance are diagonally dominant but for the axial terms, which are positive
    definite, so that the pivots need no search. Returns False if it breaks down.
    """
    mid = 2 * len(lanes)
    for j in range(n):
        pivot = band[j, mid]
        if not abs(pivot) > 0.0:  # NaN too
            return False
        inverse = 1.0 / pivot
        for i in range(1, mid + 1):  # there are rows behind the last one
            factor = band[j + i, mid - i] * inverse
            band[j + i, mid - i] = factor
            for k in range(1, mid + 1):
                band[j + i, mid - i + k] -= factor * band[j, mid + k]
        band[j, mid] = inverse
    return True


@inner
def substitute(lanes, band, columns):
    """Solve for the first three `columns` (n, …) in place with the factors of `factorise`."""
    mid, n = 2 * len(lanes), columns.shape[0]
    for i in range(min(mid, n)):
        for k in range(mid - i, mid):
            for c in range(3):
                columns[i, c] -= band[i, k] * columns[i - mid + k, c]
    for i in range(mid, n):
        a, b, c = columns[i, 0], columns[i, 1], columns[i, 2]
        for k in range(mid):
            factor, row = band[i, k], i - mid + k
            a -= factor * columns[row, 0]
            b -= factor * columns[row, 1]
            c -= factor * columns[row, 2]
        columns[i, 0], columns[i, 1], columns[i, 2] = a, b, c
    for i in range(n - 1, -1, -1):
        a, b, c = columns[i, 0], columns[i, 1], columns[i, 2]
        if i + mid < n:
            for k in range(1, mid + 1):
                factor, row = band[i, mid + k], i + k
                a -= factor * columns[row, 0]
                b -= factor * columns[row, 1]
                c -= factor * columns[row, 2]
        else:
            for k in range(1, n - i):
                factor, row = band[i, mid + k], i + k
                a -= factor * columns[row, 0]
                b -= factor * columns[row, 1]
                c -= factor * columns[row, 2]
        pivot = band[i, mid]
        columns[i, 0], columns[i, 1], columns[i, 2] = a * pivot, b * pivot, c * pivot
