"""The film without dimensions is the film of every bearing of its width."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.journal import Guembel, JournalBearing, Lubricant, Reynolds, UnitBearing

GRID = {"grid": (48, 12)}


@settings(max_examples=15)
@given(
    diameter=st.floats(0.01, 5.0),
    psi=st.floats(3e-4, 3e-3),
    viscosity=st.floats(1e-3, 1.0),
    speed=st.floats(0.1, 500.0),
    number=st.floats(0.05, 20.0),
)
def test_bearings_of_one_sommerfeld_number_are_alike(diameter, psi, viscosity, speed, number):
    bearing, oil = (
        JournalBearing(diameter, 0.75 * diameter, psi),
        Lubricant(viscosity, density=1e-3),
    )
    load = number / bearing.sommerfeld_number(1.0, speed, viscosity)
    real = bearing.equilibrium((load, 0.0), speed, oil, **GRID)
    unit = UnitBearing(0.75).equilibrium((number, 0.0), **GRID)
    for name in ("eccentricity_ratio", "attitude_angle", "sommerfeld_number"):
        assert getattr(unit, name) == pytest.approx(getattr(real, name), rel=1e-6)
    scale = viscosity * speed / psi**2
    assert unit.maximum_pressure * scale == pytest.approx(real.maximum_pressure, rel=1e-6)


def test_position_gives_the_load_that_gives_the_position():
    unit = UnitBearing(0.5)
    state = unit.equilibrium([(0.5, 0.2), (3.0, -1.0)], cavitation=Reynolds(), **GRID)
    position = state.eccentricity / unit.bearing.clearance
    back = unit.sommerfeld(position, cavitation=Reynolds(), **GRID)
    np.testing.assert_allclose(back, [(0.5, 0.2), (3.0, -1.0)], rtol=1e-6)


def test_an_orbit_gives_its_loads():
    """Whirl at half the speed carries nothing: the wedge runs round with the shaft."""
    turn = np.linspace(0, 2 * np.pi, 9)
    place = 0.5 * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    whirl = 0.5 * np.stack([-place[:, 1], place[:, 0]], axis=-1)
    film = {"cavitation": Guembel(), "inlet": None}
    load = UnitBearing(0.5).sommerfeld(place, whirl, **film, **GRID)
    still = UnitBearing(0.5).sommerfeld(place, **film, **GRID)
    assert np.abs(load).max() < 3e-3 * np.abs(still).max()


def test_a_width_of_zero_is_refused():
    with pytest.raises(InputError, match="width_ratio"):
        UnitBearing(0.0)
