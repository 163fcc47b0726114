"""Derivatives of the lubricant laws, for energy equations."""

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.tribology import ExponentialOil, Oil, lubricant, lubricant_names
from loadflow.tribology import lubricant_states as states

OILS = {
    "library": lubricant("mineral-vg-320"),
    "constant α": lubricant("heavy-machine-oil"),
    "barus": Oil(viscosities=(1e-4, 1.1e-5), pressure_law="barus"),
    "exponential": ExponentialOil(
        reference_viscosity=0.0277, constant_steepness=0.0341, pressure_coefficient=2e-8
    ),
    "roelands": ExponentialOil(
        reference_viscosity=0.1, constant_steepness=0.03, pressure_coefficient=2e-8,
        pressure_law="roelands",
    ),
    "no pressure": ExponentialOil(reference_viscosity=0.1, pressure_law="roelands"),
}  # fmt: skip


@pytest.mark.parametrize("name", OILS)
@given(temperature=st.floats(263, 403), pressure=st.floats(-1e5, 5e8))
def test_slopes_are_the_derivatives(name, temperature, pressure):
    oil, dt, dp = OILS[name], 1e-3, 1e3

    def density(t, p):
        return states.density_state(t, p, 880.0, 288.15)[0]

    def slopes_of_density(t, p):
        return states.density_state(t, p, 880.0, 288.15)[1:]

    for law, slopes in ((oil.viscosity, oil.viscosity_slopes), (density, slopes_of_density)):
        by_t = (law(temperature + dt, pressure) - law(temperature - dt, pressure)) / (2 * dt)
        by_p = (law(temperature, pressure + dp) - law(temperature, pressure - dp)) / (2 * dp)
        value, found = law(temperature, pressure), slopes(temperature, pressure)
        assert found[0] == pytest.approx(by_t, rel=1e-6, abs=1e-9 * value)
        assert found[1] == pytest.approx(by_p, rel=1e-5, abs=1e-15 * value)


@pytest.mark.parametrize("name", OILS)
def test_oils_answer_alike_over_arrays(name):
    oil = OILS[name]
    t, p = np.linspace(280, 380, 5)[:, None], np.array([0.0, 1e7, 1e8])
    for found in (oil.viscosity(t, p), *oil.viscosity_slopes(t, p), oil.density(t, p)):
        assert found.shape == (5, 3)
    for law in (oil.conductivity, oil.specific_heat, oil.steepness, oil.pressure_viscosity):
        assert np.shape(law(t)) == (5, 1)
    assert oil.kinematic_viscosity(t) * oil.density(t) == pytest.approx(oil.viscosity(t))
    assert oil.steepness(t) == pytest.approx(-oil.viscosity_slopes(t)[0] / oil.viscosity(t))
    slope = oil.viscosity_slopes(t)[1] / oil.viscosity(t)
    assert slope == pytest.approx(oil.pressure_viscosity(t), rel=1e-12)


@pytest.mark.parametrize("name", lubricant_names())
def test_the_specific_heat_of_oils_is_near_2_kilojoules(name):
    assert 1.7e3 < lubricant(name).specific_heat(313.15) < 2.4e3


def test_density_under_pressure_is_that_of_the_law():
    oil, p = OILS["library"], np.array([0.0, 1e8, 1e9])
    growth = 1 + 0.6e-9 * p / (1 + 1.7e-9 * p)  # Dowson and Higginson
    expected = (oil.density_15 - 0.605 * (330.0 - 288.15)) * growth
    assert oil.density(330.0, p) == pytest.approx(expected, rel=1e-14)


def test_the_pressure_law_matters_at_high_pressure_alone():
    both = [Oil(viscosities=(1e-4, 1.1e-5), pressure_law=law) for law in ("barus", "roelands")]
    low, high = ([oil.viscosity(330.0, p) for oil in both] for p in (1e6, 1e9))
    assert low[0] == pytest.approx(low[1], rel=1e-4)
    assert high[0] > 2 * high[1]


def test_laws_of_an_unknown_name_are_refused():
    with pytest.raises(InputError, match="pressure_law"):
        Oil(viscosities=(1e-4, 1e-5), pressure_law="linear")
    with pytest.raises(InputError, match="pressure_law"):
        ExponentialOil(reference_viscosity=0.1, pressure_law="linear")
    with pytest.raises(InputError, match="constant_steepness"):
        ExponentialOil(reference_viscosity=0.1, constant_steepness=-0.1)


def test_states_compile_as_they_stand():
    cases = {
        states.exponential_state: (333.0, 0.03, 0.034, 313.0),
        states.walther_state: (343.0, 8.9, 3.4),
        states.gold_state: (7e-5, -3e-6, 9.9, 0.139),
        states.barus_state: (0.1, -0.005, 2e-8, -1e-10, 1e8),
        states.roelands_state: (0.1, -0.005, 2e-8, -1e-10, 1e8),
        states.density_state: (330.0, 1e8, 880.0, 288.15),
        states.specific_heat_state: (330.0, 880.0),
    }
    for law, arguments in cases.items():
        found = numba.njit(law)(*arguments)
        assert found == pytest.approx([float(x) for x in law(*arguments)], rel=1e-14)
