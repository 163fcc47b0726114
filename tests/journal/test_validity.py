"""Films beyond what their equations suppose warn."""

import warnings
from functools import partial

import numpy as np
import pytest

from loadflow.errors import ValidityWarning
from loadflow.journal import (
    ConicalBearing,
    ConicalPair,
    Film,
    JournalBearing,
    Lubricant,
    ThrustBearing,
)
from loadflow.journal.grid_bounds import unresolved_counted
from loadflow.journal.validity import LARGEST_PRESSURE

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
PRESSED = "the pressure of 1 of 2 films is beyond what oil and shell bear, p_max = "


@pytest.mark.parametrize("rung", ["grid", "reduced"])
@pytest.mark.parametrize("asked", ["equilibrium", "pressure", "orbit"])
def test_a_pressure_that_neither_oil_nor_shell_bears_is_told(rung, asked):
    film = Film(Lubricant(1.0), rung=rung, grid=(96, 12), inlet=None)
    places, loads = [(1e-5, 0.0), (9.9e-5, 0.0)], [(1e5, 0.0), (2e7, 0.0)]
    ask = {
        "equilibrium": partial(BEARING.equilibrium, loads, 300.0, film),
        "pressure": partial(BEARING.pressure, places, 300.0, film),
        "orbit": partial(BEARING.orbit, [0.0, 1.0], loads, [300.0, 300.0], film),
    }[asked]
    with pytest.warns(ValidityWarning, match=PRESSED):
        found = ask()
    peaks = np.asarray(found.maximum_pressure)
    assert peaks[0] < LARGEST_PRESSURE < peaks[1]


def test_pads_and_cones_are_warned_of_such_pressures_too():
    film = Film(Lubricant(1.0), grid=(40, 10))
    pads = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    cone = ConicalBearing(half_angle=0.52, slant=(1.0, 1.5), clearance=1e-4)
    pair = ConicalPair(cone, cone, distance=1.0, clearance=1e-4)
    asked = [
        partial(pads.equilibrium, 7e8, 10.0, film),
        partial(pads.orbit, [0.0, 1e-3], [7e8, 7e8], 10.0, film, start=4e-6),
        partial(cone.pressure, (9.9e-5, 0.0, 0.0), 100.0, film),
        partial(cone.equilibrium, (0.0, 0.0, -1.5e9), 100.0, film, tilt=(6e-5, 0.0)),
        partial(pair.pressure, (9.9e-5, 0.0, 0.0), 100.0, film),
    ]
    for ask in asked:
        with pytest.warns(ValidityWarning, match="beyond what oil and shell bear") as caught:
            found = ask()
        assert np.max(np.asarray(found.maximum_pressure)) > LARGEST_PRESSURE
        assert all("contact" not in str(one.message) for one in caught)


def test_films_of_today_are_not_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        BEARING.equilibrium((2e5, 0.0), 100.0, Film(Lubricant(0.05), grid=(96, 16)))


def test_who_keeps_the_pressure_of_every_film_is_not_warned_of_it():
    film = Film(Lubricant(1.0), grid=(96, 12), inlet=None)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with unresolved_counted():
            found = BEARING.pressure((9.9e-5, 0.0), 300.0, film)
    assert found.maximum_pressure > LARGEST_PRESSURE
