"""What the default grid holds without a word on cells."""

import numpy as np
import pytest

from loadflow.journal import JournalBearing, Lobes
from loadflow.validation._journal_shapes import TWO_GROOVES, loaded


@pytest.mark.parametrize("ratio", TWO_GROOVES)
def test_two_grooves_of_lund_and_thomsen(ratio):
    bearing = JournalBearing(1.0, ratio, 1e-3, shape=Lobes(2, groove=np.radians(20)))
    for row in TWO_GROOVES[ratio]:
        state, load = loaded(bearing, row.number, bearing.clearance)
        stiffness = state.stiffness * bearing.clearance / load
        assert float(state.eccentricity_ratio) == pytest.approx(row.ratio, abs=1e-3)
        # their last digit is worth up to 0.5 %
        assert stiffness[0] == pytest.approx([row.k_xx, row.k_xy], rel=0.015)
