"""Where grooves of a supply reach a bearing end, and shafts that grow, on the rung "reduced"."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import SolverError
from loadflow.journal import (
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    JournalBearing,
    Lubricant,
    RingGrowth,
    Supply,
)
from loadflow.journal.line import Line
from loadflow.journal.models.composed.model import build, unknowns_on

WIDE = JournalBearing(0.2, 0.15, 1e-3)
FED = Film(
    Lubricant(0.03), GasMixture(5e4), 1e5, Supply([Groove(2.5, arc=0.3, pressure=5e5)]),
    grid=(72, 24), rung="reduced", inlet=None,
)  # fmt: skip
TILT = {"tilt": (5e-4, 0.0)}


def test_a_groove_keeps_its_pressure_up_to_the_bearing_end_on_more_points():
    line = Line(tilt=np.array([[5e-4, 0.0]]))
    few, many = (build(WIDE, FED, np.array([50.0]), line, level, at_rest=True) for level in (0, 2))
    held = many.film.held.grooves >= 0
    assert held.any()
    moved, cold = (
        one[:, : held.shape[1]] for one in (unknowns_on(few.cold(), few, many), many.cold())
    )
    np.testing.assert_array_equal(moved[held], cold[held])
    state, fine = (
        WIDE.equilibrium((3e4, 0.0), 50.0, film, **TILT)
        for film in (FED, replace(FED, rung="grid"))
    )
    assert float(state.supply_flow) == pytest.approx(float(fine.supply_flow), rel=0.03)


@pytest.mark.parametrize("strict", [True, False])
def test_a_shaft_that_cold_oil_lets_grow_into_its_shell_is_told(strict):
    heat = FilmHeat(
        "iso-vg-68", shell_transfer=500.0, shell_temperature=313.15, shaft_temperature=420.0,
        growth=RingGrowth(0.3),
    )  # fmt: skip
    film = Film(None, GasMixture(5e4), 1e5, grid=(48, 8), rung="reduced", heat=heat, inlet=None)
    bearing = JournalBearing(0.2, 0.1, 1e-3)
    if strict:
        with pytest.raises(SolverError, match="grown into its shell"):
            bearing.equilibrium((5e3, 0.0), 100.0, film)
    else:
        state = bearing.equilibrium([(5e3, 0.0)] * 2, 100.0, film, strict=False)
        assert not state.converged.any()


def test_a_film_that_grows_is_as_thin_in_a_groove_as_that_of_the_grid():
    heat = FilmHeat("iso-vg-68", growth=RingGrowth(0.3))
    supply = Supply([Groove(0.6, arc=1.2, pressure=3e5)])
    film = Film(None, GasMixture(5e4), 1e5, supply, grid=(96, 24), heat=heat, inlet=None)
    few, fine = (
        JournalBearing(0.2, 0.1, 1e-3).equilibrium((6e3, 0.0), 100.0, replace(film, rung=rung))
        for rung in ("reduced", "grid")
    )
    assert float(few.minimum_film) == pytest.approx(float(fine.minimum_film), rel=0.04)
