"""Linear systems of columns of cells around a ring against a dense solver."""

from __future__ import annotations

import numpy as np
import pytest

from loadflow.journal.models._compile import outer
from loadflow.journal.models._ring_kernels import factorise, ring_system, substitute
from loadflow.numerics.lanes import lanes_for


@outer
def _solve(ring, columns, count):
    if not factorise(ring):
        return False
    substitute(ring, columns, count)
    return True


def _drawn(around, across):
    """A system as a film has: its dense matrix, and the one of blocks."""
    draw = np.random.default_rng(around)
    ring = ring_system(around, across, lanes_for(across + 2))
    block = draw.normal(size=(around, across, across)) * 0.3 + 4.0 * np.eye(across)
    left, right = -draw.random((2, around, across))
    ring.block[:, :, :across] = block.transpose(0, 2, 1)
    ring.left[:, :across], ring.right[:, :across] = left, right
    dense = np.zeros((around, across, around, across))
    for i in range(around):
        dense[i, :, i] += block[i]
        dense[i, :, i - 1] += np.diag(left[i])
        dense[i, :, (i + 1) % around] += np.diag(right[i])
    return ring, dense.reshape(around * across, -1), draw


@pytest.mark.parametrize(("around", "across"), [(60, 6), (61, 4), (7, 14), (3, 20)])
@pytest.mark.parametrize("count", [1, 3, 5])
def test_system_is_solved(around, across, count):
    ring, dense, draw = _drawn(around, across)
    given = draw.normal(size=(5, around, across))
    columns = np.zeros((5, around, lanes_for(across + 2)))
    columns[:, :, :across] = given
    assert _solve(ring, columns, count)
    exact = np.linalg.solve(dense, given.reshape(5, -1).T).T.reshape(given.shape)
    np.testing.assert_allclose(columns[:count, :, :across], exact[:count], atol=1e-13)
    np.testing.assert_array_equal(columns[count:, :, :across], given[count:])
    assert not columns[:, :, across:].any()


@pytest.mark.parametrize("bad", [0.0, np.nan])
def test_breakdown_is_told(bad):
    ring, _, _ = _drawn(7, 4)
    ring.block[3], ring.left[3] = bad, 0.0
    assert not _solve(ring, np.zeros((5, 7, 8)), 1)
