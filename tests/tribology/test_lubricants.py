"""Laws of lubricants, the library of oils, film against roughness, traction."""

import numba
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad

from loadflow.errors import InputError
from loadflow.tribology import Oil, asperities, lubricant, lubricant_names, traction
from loadflow.tribology import lubricant_laws as laws
from loadflow.tribology import lubricant_states as states


@given(st.floats(5e-6, 2e-3), st.floats(0.02, 0.5))
def test_walther_returns_its_two_points(thick, share):
    thin = max(thick * share, 1e-6)
    at = laws.walther(np.array([313.15, 373.15]), (thick, thin))
    assert at == pytest.approx([thick, thin], rel=1e-12)


@pytest.mark.parametrize("name", lubricant_names())
def test_every_oil_of_the_library_thins_with_heat_and_thickens_under_pressure(name):
    oil = lubricant(name)
    assert oil.source
    eta = oil.viscosity(np.linspace(263, 393, 27))
    assert (np.diff(eta) < 0).all()
    assert oil.viscosity(333.15, 0.5e9) > 10 * oil.viscosity(333.15)
    assert 5e-9 < oil.pressure_viscosity(333.15) < 4e-8
    assert 0.1 < oil.conductivity(333.15) < 0.2


@pytest.mark.parametrize("name", ["lgwm-2", "pao-vg-320", "cylinder-oil"])
def test_steepness_is_the_derivative_of_the_viscosity(name):
    oil, t, dt = lubricant(name), 330.0, 0.01
    slope = -np.log(oil.viscosity(t + dt) / oil.viscosity(t - dt)) / (2 * dt)
    assert oil.steepness(t) == pytest.approx(slope, rel=1e-7)


def test_roelands_starts_like_barus_and_stays_below():
    p = np.array([1e3, 1e8, 1e9, 3e9])
    thick = states.roelands_state(0.1, 0.0, 2e-8, 0.0, p)[0]
    barus = states.barus_state(0.1, 0.0, 2e-8, 0.0, p)[0]
    assert thick[0] == pytest.approx(barus[0], rel=1e-9)
    assert (thick[1:] < barus[1:]).all()
    assert np.isfinite(states.barus_state(0.1, 0.0, 2e-8, 0.0, np.array(1e12))[0])


def test_bulk_modulus_is_that_of_the_compressed_density():
    p, dp = 0.4e9, 1e5
    rho = lubricant("mineral-vg-320").density(330.0, np.array([p - dp, p, p + dp]))
    assert laws.bulk_modulus(p) == pytest.approx(rho[1] * 2 * dp / (rho[2] - rho[0]), rel=1e-6)


def test_conductivity_as_printed_is_lower():
    assert laws.conductivity(363.15, 805.0) == pytest.approx(0.1386, abs=1e-4)
    assert laws.conductivity(363.15, 805.0, "printed") == pytest.approx(0.1172, abs=1e-4)


@pytest.mark.parametrize(
    "change",
    [
        {"viscosities": (1e-5, 1e-4)},
        {"viscosities": (100.0, 10.0)},
        {"temperatures": (373.15, 313.15)},
        {"base": "water"},
        {"density_15": -1.0},
    ],
)
def test_an_impossible_oil_is_refused(change):
    with pytest.raises(InputError):
        Oil(**({"viscosities": (1e-4, 1e-5)} | change))


def test_an_unknown_oil_is_refused():
    with pytest.raises(InputError, match="lgep-2"):
        lubricant("olive")


@given(st.floats(-1e12, 1e12), st.floats(1e5, 1e8))
def test_stress_never_passes_its_limit(newtonian, limit):
    stress = traction.smooth_stress(newtonian, limit)
    assert abs(stress) <= limit
    assert stress * newtonian >= 0
    clipped = min(max(newtonian, -limit), limit)  # Table 5.1
    assert abs(clipped - stress) <= 0.2385 * limit  # 1 - tanh 1


def test_asperity_integrals_by_quadrature():
    for order in (2.0, 2.5):
        for u in (-1.5, 0.3, 2.7, 5.0):
            exact = quad(lambda s, n=order, g=u: (s - g) ** n * np.exp(-s * s / 2), u, 12)[0]
            ours = asperities.greenwood_tripp(order, u)
            assert ours == pytest.approx(exact / np.sqrt(2 * np.pi), rel=1e-8)


def test_asperities_carry_less_the_wider_the_gap():
    p = asperities.asperity_pressure(np.linspace(0, 6, 13), 115e9, 0.5e-6, 20e-6, 4e9)
    assert (np.diff(p) < 0).all()
    # σβη = 0.04, √(σ/β) = 0.158: 3.0e-4 × 115 GPa × 4.739 × 0.6166
    assert p[0] == pytest.approx(4.7391 * 0.04**2 * 0.15811 * 115e9 * 0.61663, rel=1e-3)


def test_limiting_stress_is_continuous_at_the_critical_pressure():
    p = 502e6 + np.array([-1.0, 0.0, 1.0])
    assert traction.limiting_stress(p, 4e6, 502e6, 0.07) == pytest.approx(4e6, abs=0.1)


def test_a_solid_film_at_rest_has_no_stress():
    assert traction.newtonian_stress(1e300, 0.0, 1e-7) == 0.0
    assert np.isfinite(traction.smooth_stress(traction.newtonian_stress(1e300, 5.0, 1e-7), 4e6))


def test_traction_compiles_as_it_stands():
    compiled = numba.njit(traction.smooth_stress)
    assert compiled(3e6, 4e6) == pytest.approx(float(traction.smooth_stress(3e6, 4e6)), rel=1e-15)
