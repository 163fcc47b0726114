"""Asperities in a film with heat over its area: their heat, load and growth, at rest and moving."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import (
    Contact,
    Film,
    FilmHeat,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    RingGrowth,
)
from loadflow.tribology import AsperityContact, ExponentialOil

LOBES = JournalBearing(0.2, 0.1, 1e-3, shape=Lobes(2))
LOAD, SLOW = (5e4, 3e3), 2.0
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
COOLED = FilmHeat("iso-vg-68", shell_transfer=1000.0, shell_temperature=313.15)
EVEN = ExponentialOil(reference_viscosity=0.06, reference_density=870.0)


def film(heat=COOLED, contact=ROUGH, **more):
    more = {"edge_pressure": 1e5, "grid": (48, 8)} | more
    return Film(None, MassConserving(), heat=heat, contact=contact, **more)


@pytest.mark.parametrize("points", [1, 3, 4])
def test_heat_of_asperities_is_in_the_balance(points):
    """What leaves is the friction of oil and asperities, which here is nearly theirs alone."""
    state = LOBES.equilibrium(LOAD, SLOW, film(replace(COOLED, points=points)))
    assert state.converged
    assert 0.1 < state.contact_share < 0.2
    assert 0.8 < state.contact_power / state.friction_power < 1.0
    assert state.heat_imbalance < 1e-8
    left = state.heat_carried + state.heat_conducted
    assert left == pytest.approx(float(state.friction_power), rel=1e-8)
    smooth = replace(ROUGH, friction=0.0)
    without = LOBES.equilibrium(LOAD, SLOW, film(replace(COOLED, points=points), smooth))
    assert state.maximum_temperature > without.maximum_temperature + 10.0


def test_with_one_viscosity_the_load_is_that_of_the_isothermal_film():
    warm = LOBES.equilibrium(LOAD, SLOW, film(replace(COOLED, oil=EVEN)))
    cold = LOBES.equilibrium(
        LOAD, SLOW, Film(Lubricant(0.06), MassConserving(), 1e5, grid=(48, 8), contact=ROUGH)
    )
    for name in ("eccentricity", "minimum_film", "contact_share", "contact_power", "stiffness"):
        expected = getattr(cold, name)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(getattr(warm, name), expected, rtol=1e-7, atol=1e-9 * scale)


def test_asperities_see_the_growth_of_shaft_and_shell():
    """One temperature everywhere: that of a bearing with the clearance that is left."""
    shell, shaft, rise = 20e-6, 12e-6, 30.0
    growth = RingGrowth(
        0.3, shaft_expansion=shaft, shell_expansion=shell, reference_temperature=313.15 - rise
    )
    heavy = replace(EVEN, constant_specific_heat=1e9)  # hardly warms
    grown = FilmHeat(heavy, 313.15, shell_transfer=1.0, shell_temperature=313.15, growth=growth)
    state = LOBES.equilibrium(LOAD, SLOW, film(grown))
    wide = replace(LOBES, relative_clearance=1e-3 + (shell - shaft) * rise)
    even = LOBES.equilibrium(LOAD, SLOW, film(replace(grown, growth=None)))
    # two half shells with their own preload: the same gap, as both lobes are round by default
    same = wide.equilibrium(LOAD, SLOW, film(replace(grown, growth=None)))
    assert state.contact_share == pytest.approx(float(same.contact_share), rel=1e-3)
    assert abs(state.contact_share / even.contact_share - 1.0) > 0.02


def test_a_shaft_that_stands_is_carried_by_asperities_and_makes_no_heat():
    for heat in (COOLED, replace(COOLED, shell_transfer=0.0)):
        state = LOBES.equilibrium(LOAD, 0.0, film(heat))
        assert state.contact_share == pytest.approx(1.0, abs=1e-9)
        assert float(state.friction_power) == 0.0
        assert state.maximum_temperature == pytest.approx(313.15)


def test_a_shaft_comes_to_rest_where_film_and_asperities_carry_it():
    time = np.append(np.linspace(0.0, 0.2, 9), np.linspace(0.3, 3.0, 12))
    path = LOBES.orbit(time, np.tile(LOAD, (time.size, 1)), SLOW, film(), start=(1e-5, 1e-5))
    rest, last = LOBES.equilibrium(LOAD, SLOW, film()), path.isel(time=-1)
    assert float(last.minimum_film) == pytest.approx(float(rest.minimum_film), rel=1e-3)
    assert float(last.contact_share) == pytest.approx(float(rest.contact_share), rel=1e-3)
    assert float(last.friction_power) == pytest.approx(float(rest.friction_power), rel=1e-3)
    assert path.attrs["maximum_temperature"] == pytest.approx(rest.maximum_temperature, abs=1e-4)
    assert path.attrs["heat_imbalance"] < 1e-8


def test_a_closed_path_with_contact_closes():
    time = np.linspace(0.0, 2 * np.pi / SLOW, 25)
    loads = LOAD + np.outer(np.cos(SLOW * time), (1e4, 0.0))
    loads[-1] = loads[0]
    path = LOBES.orbit(time, loads, SLOW, film(), periodic=True)
    assert path.attrs["closure"] < 1e-6
    assert path.attrs["heat_imbalance"] < 1e-8
    assert float(path.contact_share.max()) > float(path.contact_share.min()) > 0.0
