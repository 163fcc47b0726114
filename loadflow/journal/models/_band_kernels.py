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


@inner
def substitute_one(band, columns):
    """`substitute` for the first column alone.

    A row waits for the one before it: what that has found is kept at hand, and comes last, to two
    sums of the other terms.
    """
    mid, n = (band.shape[1] - 1) // 2, columns.shape[0]
    found = 0.0
    for i in range(n):
        many = min(mid, i) - 1  # terms before the last one
        a, p, k = columns[i, 0], 0.0, max(mid - i, 0)
        row = i - mid + k
        for _ in range(many // 2):
            a -= band[i, k] * columns[row, 0]
            p -= band[i, k + 1] * columns[row + 1, 0]
            k, row = k + 2, row + 2
        if many > 0 and many % 2 == 1:
            p -= band[i, k] * columns[row, 0]
        found = (a + p) - band[i, mid - 1] * found
        columns[i, 0] = found
    found = 0.0
    for i in range(n - 1, -1, -1):
        many = min(mid, n - 1 - i) - 1
        a, p, k = columns[i, 0], 0.0, mid + many + 1
        row = i + many + 1
        for _ in range(many // 2):
            a -= band[i, k] * columns[row, 0]
            p -= band[i, k - 1] * columns[row - 1, 0]
            k, row = k - 2, row - 2
        if many > 0 and many % 2 == 1:
            p -= band[i, k] * columns[row, 0]
        found = ((a + p) - band[i, mid + 1] * found) * band[i, mid]
        columns[i, 0] = found


@inner
def substitute_all(band, columns, count):
    """Solve for the first `count` of five `columns` in place, three or all: as `substitute`.

    Two sums for each column: the next term of one need not wait for that of the other. What has
    been found last comes last, so that a row may begin before the one before it is done.
    """
    mid, n = (band.shape[1] - 1) // 2, columns.shape[0]
    for step in range(2 * n):
        forward = step < n
        i = step if forward else 2 * n - 1 - step
        many = min(mid, i if forward else n - 1 - i)
        way = 1 if forward else -1
        at, row = mid - way * many, i - way * many
        a, p = columns[i, 0], 0.0
        b, c, d, e = columns[i, 1], columns[i, 2], 0.0, 0.0
        q, r, s, t = 0.0, 0.0, 0.0, 0.0
        if count > 3:
            d, e = columns[i, 3], columns[i, 4]
        if many % 2 == 1:
            factor = band[i, at]
            p -= factor * columns[row, 0]
            q -= factor * columns[row, 1]
            r -= factor * columns[row, 2]
            if count > 3:
                s -= factor * columns[row, 3]
                t -= factor * columns[row, 4]
            at, row = at + way, row + way
        for _ in range(many // 2):
            factor, other, behind = band[i, at], band[i, at + way], row + way
            a -= factor * columns[row, 0]
            b -= factor * columns[row, 1]
            c -= factor * columns[row, 2]
            p -= other * columns[behind, 0]
            q -= other * columns[behind, 1]
            r -= other * columns[behind, 2]
            if count > 3:
                d -= factor * columns[row, 3]
                e -= factor * columns[row, 4]
                s -= other * columns[behind, 3]
                t -= other * columns[behind, 4]
            at, row = at + 2 * way, row + 2 * way
        pivot = 1.0 if forward else band[i, mid]
        columns[i, 0], columns[i, 1] = (a + p) * pivot, (b + q) * pivot
        columns[i, 2] = (c + r) * pivot
        if count > 3:
            columns[i, 3], columns[i, 4] = (d + s) * pivot, (e + t) * pivot


@inner
def factorise_any(band, n):
    """`factorise` for as many points across as the `band` is for."""
    mid = (band.shape[1] - 1) // 2
    if mid == 12:
        return factorise((0, 0, 0, 0, 0, 0), band, n)
    for j in range(n):
        pivot = band[j, mid]
        if not abs(pivot) > 0.0:  # NaN too
            return False
        inverse = 1.0 / pivot
        top = band[j, mid + 1 :]  # parts of rows, of which the compiler sees how they are passed
        for i in range(1, mid + 1):
            factor = band[j + i, mid - i] * inverse
            row = band[j + i, mid - i + 1 : 2 * mid - i + 1]
            for k in range(mid):
                row[k] -= factor * top[k]
            band[j + i, mid - i] = factor
        band[j, mid] = inverse
    return True
