"""One rule of convergence: where rounding ends decides no answer."""

import math
import time

import numpy as np
import pytest

from benchmarks.robustness.families import FAMILIES, SEEDS, draw_point
from loadflow.errors import SolverError
from loadflow.journal import (
    GasMixture,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    TiltingPads,
)
from loadflow.numerics import convergence

BEARING = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(0.05)
LAWS = [Sommerfeld(), Guembel(), Reynolds(), MassConserving(), GasMixture(5e4)]


def test_what_is_not_a_number_is_no_answer():
    nothing = math.nan
    assert not convergence.is_small(nothing, 1.0, 1.0)
    assert not convergence.answered(nothing, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0)
    assert not convergence.answered(0.0, 1.0, 1.0, nothing, nothing, 1.0, 1.0)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: type(law).__name__)
def test_loads_of_any_size_have_an_answer_wherever_rounding_ends(law):
    sizes = 10.0 ** np.arange(-12, 10)
    turns = np.linspace(0.0, 6.0, sizes.size)  # other directions round otherwise
    force = sizes[:, None] * np.stack([np.cos(turns), np.sin(turns)], axis=-1)
    state = BEARING.equilibrium(force, 1.2, OIL, cavitation=law, edge_pressure=1e5, grid=(60, 8))
    assert state.converged.all()
    light = slice(4, 12)  # a film is linear in a load that is light, but for the last digits
    per_load = state.eccentricity_ratio[light] / sizes[light]
    if not isinstance(law, GasMixture):
        np.testing.assert_allclose(per_load[3:], per_load[-1], rtol=1e-3)


def test_a_load_beyond_what_numbers_resolve_says_what_it_reached_and_what_rounding_allows():
    with pytest.raises(SolverError, match=r"residual \S+ after \d+ steps, where rounding allows"):
        BEARING.equilibrium((1e14, 0.0), 0.1, OIL, edge_pressure=1e5)


def test_a_shaft_that_touches_the_ends_under_tilt_is_refused_at_once_with_what_is_missing():
    tilted = {"tilt": (0.7 * BEARING.clearance / (0.5 * BEARING.width), 0.0)}
    options = {"cavitation": Reynolds(), "edge_pressure": 1e5, "grid": (60, 20)}
    assert BEARING.equilibrium((1e5, 0.0), 1.2, OIL, **options, **tilted).converged  # compiled
    begin = time.process_time()
    with pytest.raises(SolverError, match=r"touches the bore.* the last 9\d\.\d % of the load"):
        BEARING.equilibrium((5e7, 0.0), 1.2, OIL, **options, **tilted)
    assert time.process_time() - begin < 2.0


def test_lobes_whose_first_position_leads_nowhere_are_reached_from_another_load():
    # number 415 of the family "shaped" of benchmarks.robustness.families
    rng = np.random.default_rng([SEEDS["shaped"], 415])
    point = draw_point(rng)
    state = FAMILIES["shaped"](point)()
    assert state.converged
    assert np.allclose(state.force, point.force)


@pytest.mark.parametrize("number", [0, 46, 119, 139, 166, 174, 197, 208, 255, 260])
def test_cones_carry_the_load_of_a_film_at_any_place(number):
    """Rings without rupture, whose axial place is free, among them; segments that pull and push."""
    point = draw_point(np.random.default_rng([SEEDS["cone"], number]))
    state = FAMILIES["cone"](point)()
    assert state.converged
    assert state.residual < 1e-9


@pytest.mark.parametrize("number", [3, 11, 45, 49])
def test_pairs_of_cones_carry_the_load_of_films_at_any_place(number):
    """Rings without rupture, held and free tilts, an axial force among them."""
    point = draw_point(np.random.default_rng([SEEDS["pair"], number]))
    state = FAMILIES["pair"](point)()
    assert state.converged
    assert state.residual < 1e-9


@pytest.mark.parametrize("number", [85, 94, 266])
def test_shells_that_give_way_by_more_than_the_clearance_are_reached(number):
    """From a rigid shell on, or on more cells around."""
    point = draw_point(np.random.default_rng([SEEDS["shell"], number]))
    state = FAMILIES["shell"](point)()
    assert state.converged
    assert np.allclose(state.force, point.force)
    assert float(state.shell_deformation) > 0.1 * point.gap


@pytest.mark.parametrize("count", [3, 4, 5])
def test_pads_carry_an_ordinary_load_from_any_side(count):
    pads = TiltingPads(count, 0.8 * 2 * np.pi / count, preload=0.3)
    bearing = JournalBearing(3.0, 2.25, 0.5e-3, shape=pads)
    turns = np.linspace(-0.8, 0.8, 9)
    force = 2e6 * np.stack([np.cos(turns), np.sin(turns)], axis=-1)
    film = {"cavitation": GasMixture(5e4), "edge_pressure": 5e5, "grid": (60, 8)}
    state = bearing.equilibrium(force, 1.2, OIL, **film)
    assert state.converged.all()
    assert np.isfinite(state.stiffness).all()


def test_a_pad_bearing_without_an_answer_is_flagged_not_raised():
    bearing = JournalBearing(3.0, 2.25, 0.5e-3, shape=TiltingPads(4, 1.2))
    force = [(2e6, 0.0), (1e16, 0.0)]
    state = bearing.equilibrium(force, 1.2, OIL, edge_pressure=5e5, grid=(48, 8), strict=False)
    assert state.converged.tolist() == [True, False]
    assert np.isnan(state.stiffness[1]).all()
