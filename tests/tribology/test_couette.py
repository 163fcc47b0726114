"""Heat of sheared films: the printed table, balances, refusals."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import quad, solve_ivp

from loadflow.errors import InputError
from loadflow.tribology import ConductingCouette, adiabatic_rise, nahme_number

OIL = {"viscosity": 0.0277, "speed": 10.471976, "gap": 1e-4, "heat_capacity": 860 * 1951.8}


def test_adiabatic_rise_has_the_exact_values():
    assert adiabatic_rise(0.1, steepness=0.0341, **OIL) == pytest.approx(3.267283, abs=5e-7)
    assert adiabatic_rise(0.1, **OIL) == pytest.approx(3.456246, abs=5e-7)


def test_adiabatic_rise_is_the_solution_of_the_heat_balance():
    eta, u, h, c = OIL.values()
    path = solve_ivp(
        lambda x, t: eta * np.exp(-0.05 * t) * u**2 / h / (c * u * h / 2), (0, 0.5), [0.0],
        rtol=1e-11, atol=1e-12,
    )  # fmt: skip
    assert adiabatic_rise(0.5, steepness=0.05, **OIL) == pytest.approx(path.y[0, -1], rel=1e-8)


@pytest.mark.parametrize(
    ("nahme", "middle", "stress", "wall", "insulated"),
    [
        (0.1, 0.012423, 0.991749, 0.048790, 0.967945),
        (1.0, 0.117783, 0.924196, 0.405465, 0.760346),
        (10.0, 0.810930, 0.573879, 1.791759, 0.281983),
    ],
)
def test_conducting_films_have_the_printed_values(nahme, middle, stress, wall, insulated):
    both, one = ConductingCouette(nahme), ConductingCouette(nahme, insulated=True)
    assert (both.largest_rise, both.stress_ratio) == pytest.approx((middle, stress), abs=6e-7)
    assert (one.largest_rise, one.stress_ratio) == pytest.approx((wall, insulated), abs=6e-7)


@pytest.mark.parametrize("insulated", [False, True])
@given(nahme=st.floats(1e-6, 1e4))
def test_profiles_keep_walls_momentum_and_energy(nahme, insulated):
    film = ConductingCouette(nahme, insulated)
    rise = film.rise([0.0, 1.0])
    assert rise[1] == pytest.approx(0.0, abs=1e-9)
    assert rise[0] == pytest.approx(film.largest_rise if insulated else 0.0, abs=1e-9)
    assert film.velocity([0.0, 1.0]) == pytest.approx([0.0, 1.0], abs=1e-12)
    # τ = η du/dy is the same everywhere: ∫ exp(βΔT) dy = 1/τ*
    total = quad(lambda y: float(np.exp(film.rise(y))), 0, 1, limit=200)[0]
    assert total * film.stress_ratio == pytest.approx(1.0, rel=1e-7)
    # k T'' + τ du/dy = 0, as d(βΔT)/dy + Na τ* u = constant
    y, d = np.array([0.2, 0.45, 0.8]), 1e-5
    slope = (film.rise(y + d) - film.rise(y - d)) / (2 * d)
    flux = slope + nahme * film.stress_ratio * film.velocity(y)
    assert flux == pytest.approx(np.full(3, flux.mean()), abs=1e-5 * (1 + abs(flux.mean())))


def test_a_cold_film_is_that_of_newton():
    film = ConductingCouette(0.0)
    assert film.largest_rise == 0.0
    assert film.stress_ratio == 1.0
    assert film.velocity(0.3) == pytest.approx(0.3)
    near = ConductingCouette(1e-9)
    assert near.stress_ratio == pytest.approx(1 - 1e-9 / 12, abs=1e-14)
    assert near.velocity(0.3) == pytest.approx(0.3, abs=1e-9)


def test_impossible_films_are_refused():
    with pytest.raises(InputError, match="nahme"):
        ConductingCouette(-1.0)
    with pytest.raises(InputError, match="share"):
        ConductingCouette(1.0).rise(1.2)
    with pytest.raises(InputError, match="conductivity"):
        nahme_number(0.03, 20.0, 0.0, 0.03)
    for key, value in (("gap", 0.0), ("viscosity", -1.0), ("heat_capacity", np.nan)):
        with pytest.raises(InputError, match=key):
            adiabatic_rise(0.1, **(OIL | {key: value}))
    with pytest.raises(InputError, match="distance"):
        adiabatic_rise(-0.1, **OIL)
