"""Heat over the area of a film in motion: temperatures that stay while the shaft moves."""

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError, ValidityWarning
from loadflow.journal import (
    Film,
    FilmHeat,
    GasMixture,
    JournalBearing,
    Lobes,
    MassConserving,
    RingGrowth,
)
from loadflow.journal.solvers.statics import Statics

LOBES = JournalBearing(0.2, 0.15, 1e-3, shape=Lobes(2))
LOAD, SPEED = (2e4, 3e3), 200.0
TIME = np.append(np.linspace(0.0, 0.2, 9), np.linspace(0.3, 1.5, 8))
GROWN = {"points": 3, "shaft_transfer": 100.0, "growth": RingGrowth(0.3)}


def film(law=None, grid=(40, 8), **heat):
    law = law or MassConserving()
    return Film(None, law, edge_pressure=2e4, grid=grid, heat=FilmHeat("iso-vg-68", **heat))


@pytest.mark.parametrize("law", [MassConserving(), GasMixture(1e4)])
@pytest.mark.parametrize("heat", [{}, GROWN])
def test_a_shaft_comes_to_rest_where_its_warm_film_carries_it(law, heat):
    """From the middle; its temperatures and growth are those of the film at rest."""
    options = film(law, **heat)
    path = LOBES.orbit(TIME, np.tile(LOAD, (17, 1)), SPEED, options, start=(1e-5, 1e-5))
    rest = LOBES.equilibrium(LOAD, SPEED, options)
    last = path.isel(time=-1)
    np.testing.assert_allclose(last.eccentricity, rest.eccentricity, atol=2e-5 * LOBES.clearance)
    assert float(last.minimum_film) == pytest.approx(float(rest.minimum_film), rel=1e-4)
    assert float(last.eccentricity_ratio) == pytest.approx(rest.eccentricity_ratio, abs=1e-4)
    assert float(last.friction_power) == pytest.approx(float(rest.friction_power), rel=1e-4)
    assert float(last.temperature) == pytest.approx(float(rest.temperature), abs=1e-5)
    assert path.attrs["maximum_temperature"] == pytest.approx(rest.maximum_temperature, abs=1e-4)
    assert path.attrs["heat_imbalance"] < 1e-8
    assert path.attrs["heat_residual"] < 1e-6
    if heat:
        grown = LOBES.clearance + path.attrs["mean_growth"]
        assert grown == pytest.approx(float(rest.clearance), rel=1e-6)


def test_the_temperatures_are_those_of_the_mean_heat():
    """Half the time under each of two loads: between both, and closed on average."""
    one, other = (8e3, 0.0), (3e4, 0.0)
    options = film(GasMixture(1e4))
    rest = [LOBES.equilibrium(load, SPEED, options) for load in (one, other)]
    time = np.linspace(0.0, 0.05, 16)
    loads = np.tile(one, (16, 1))
    loads[8:] = other
    path = LOBES.orbit(time, loads, SPEED, options)
    low, high = sorted(float(state.temperature) for state in rest)
    assert low + 0.1 < float(path.temperature[0]) < high - 0.1
    assert np.ptp(path.temperature.values) == 0.0
    assert path.attrs["heat_imbalance"] < 1e-8


def test_a_closed_path_keeps_its_temperatures():
    time = np.linspace(0.0, 2 * np.pi / SPEED, 25)
    turning = np.stack([np.cos(SPEED * time), np.sin(SPEED * time)], axis=-1)
    loads = LOAD + 4e3 * turning
    loads[-1] = loads[0]
    path = LOBES.orbit(time, loads, SPEED, film(GasMixture(1e4)), periodic=True)
    assert path.attrs["closure"] < 1e-6
    assert path.attrs["heat_imbalance"] < 1e-8


def test_loads_without_a_film_at_rest_are_told():
    options = film(GasMixture(1e4))
    loads = np.tile(LOAD, (16, 1))
    speeds = np.full(16, SPEED)
    speeds[-3:] = 0.0
    time = np.linspace(0.0, 0.01, 16)
    with pytest.warns(ValidityWarning, match="3 of 16 loads of the series have none"):
        path = LOBES.orbit(time, loads, speeds, options)
    assert path.attrs["heat_imbalance"] < 1e-8
    with pytest.raises(SolverError, match="orbit cannot start"):
        LOBES.orbit(time, loads, 0.0, options)
    with pytest.raises(InputError, match="conserves mass"):
        LOBES.orbit(TIME, np.tile(LOAD, (17, 1)), SPEED, Film(heat=FilmHeat(), edge_pressure=2e4))


def test_loads_without_a_film_are_asked_for_one_first_and_last(monkeypatch):
    """Not at every field of temperature: where none carries them, that takes longest."""
    options, asked, solve = film(GasMixture(1e4)), [], Statics.solve

    def counted(self, index, *arguments, **words):
        asked.append(index)
        return solve(self, index, *arguments, **words)

    monkeypatch.setattr(Statics, "solve", counted)
    loads, speeds = np.tile(LOAD, (16, 1)), np.full(16, SPEED)
    speeds[-1] = 0.0
    path = LOBES.orbit(np.linspace(0.0, 0.01, 16), loads, speeds, options)
    assert path.attrs["heat_iterations"] > 3
    assert asked.count(15) == 2
    assert asked.count(14) == path.attrs["heat_iterations"]


def test_a_series_that_overheats_says_how_warm_and_what_helps():
    time = np.linspace(0.0, 0.01, 16)
    said = r"orbit cannot start: the film gets hotter than 423.15 K.*of 16 loads.*fields.*may help"
    with pytest.raises(SolverError, match=said):
        LOBES.orbit(time, np.tile(LOAD, (16, 1)), 20.0 * SPEED, film(GasMixture(1e4)))
