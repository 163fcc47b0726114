"""The linear system of a film's Newton step against LAPACK."""

import numpy as np
import pytest
from scipy.linalg.lapack import dgbtrf, dgbtrs

from loadflow.journal.film._band_kernels import band_storage, factorise, substitute

RIGHT_HAND_SIDES = 3


def random_band(count, bandwidth, diagonal):
    """A random band matrix, with more on the `diagonal` of its columns."""
    rng = np.random.default_rng(7)
    band, mid = band_storage(count, bandwidth), 2 * bandwidth
    band[:, bandwidth : 3 * bandwidth + 1] = rng.standard_normal((count, 2 * bandwidth + 1))
    rows = np.arange(count)[:, None] + np.arange(band.shape[1]) - mid
    band[(rows < 0) | (rows >= count)] = 0.0
    band[:, mid] += diagonal
    return band, rng.standard_normal((RIGHT_HAND_SIDES, count))


def solved(band, bandwidth, columns):
    """Solutions, and the rows that were exchanged."""
    pivots = np.empty(len(band), dtype=np.int32)
    assert factorise(band, bandwidth, pivots) == 0
    substitute(band, bandwidth, pivots, columns)
    return columns, pivots


@pytest.mark.parametrize("bandwidth", [2, 4, 5, 9, 20, 33])
@pytest.mark.parametrize("exchanges", ["none", "some", "most"])
def test_a_band_is_solved_with_the_pivots_and_the_solution_of_lapack(bandwidth, exchanges):
    count, diagonal = 203, np.full(203, 3.0 * bandwidth)
    diagonal[::20] = {"none": 3.0 * bandwidth, "some": 0.0, "most": 0.0}[exchanges]
    if exchanges == "most":
        diagonal[:] = 0.0
    band, columns = random_band(count, bandwidth, diagonal)
    factors, expected, info = dgbtrf(band.T, bandwidth, bandwidth)
    assert info == 0
    reference = dgbtrs(factors, bandwidth, bandwidth, columns.T, expected)[0].T
    found, pivots = solved(band, bandwidth, columns)
    np.testing.assert_array_equal(pivots, expected)
    moved = np.flatnonzero(pivots != np.arange(count)).size
    assert (moved == 0) if exchanges == "none" else (moved > 0)
    # the same operations in the same order, but for what a processor rounds once or twice
    np.testing.assert_allclose(found, reference, rtol=0, atol=1e-10 * np.abs(reference).max())


def test_a_column_without_a_pivot_is_named():
    band, _ = random_band(40, 5, 20.0)
    band[17] = 0.0
    assert factorise(band, 5, np.empty(40, dtype=np.int32)) == 18


def test_a_matrix_with_a_number_that_is_none_has_no_finite_solution():
    band, columns = random_band(40, 5, 20.0)
    band[17, 10] = np.nan
    found, _ = solved(band, 5, columns)
    assert not np.isfinite(found).all()
