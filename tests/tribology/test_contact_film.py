"""Film of rolling contacts: rows of Table 5.2, all regimes, corrections."""

import numba
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import brentq

from loadflow.errors import InputError
from loadflow.tribology import contact_film as film
from loadflow.tribology import traction

G = 4615.38


def test_table_rows_are_power_laws():
    u, w = 2e-11, 5e-5
    assert film.film_ratio("crook", G, u, w) == pytest.approx(
        2.14 * G**0.75 * u**0.75 * w**-0.125, rel=1e-14
    )
    assert sum(law.contact == "point" for law in film.POWER_LAWS.values()) == 4


def test_circular_hamrock_dowson_is_the_row_of_the_table():
    u, w = 1e-11, 1e-6
    exact = film.hamrock_dowson_central(G, u, w, 1.0)
    assert film.film_ratio("hamrock-dowson", G, u, w) == pytest.approx(exact, rel=1e-3)


def test_harris_209_inner_contact():
    u, g, w, k = 2.154e-10 / 2, 5227 / 2, 7.63e-4 / 2, 9.285  # its groups use E*, ours E₀ = 2 E*
    assert film.hamrock_dowson_central(2 * g, u * 2, w * 2, k) * 5.1093e-3 == pytest.approx(
        0.693e-6, rel=5e-3
    )
    assert film.hamrock_dowson_minimum(2 * g, u * 2, w * 2, k) * 5.1093e-3 == pytest.approx(
        0.554e-6, rel=5e-3
    )


def test_printed_exponent_makes_films_4_8_times_too_thick():
    args = (G, 1.56329e-11, 6.28806e-5)
    ratio = film.film_ratio("hamrock-printed", *args) / film.film_ratio("hamrock", *args)
    assert ratio == pytest.approx(4.8, abs=0.05)


def _martin_film(speed: float, load: float) -> float:
    """Film where p' = 0 between rigid cylinders, by quadrature, over the radius."""
    x = np.tan(np.linspace(-np.pi / 2 + 1e-6, np.pi / 2 - 1e-6, 20001))

    def carried(h0: float) -> float:
        h = h0 + (x * np.sqrt(2 * h0)) ** 2 / 2
        dx = np.sqrt(2 * h0)

        def pressure(at: float) -> np.ndarray:
            slope = 12 * speed * (h - at * h0) / h**3 * dx
            return np.concatenate([[0], np.cumsum((slope[1:] + slope[:-1]) / 2 * np.diff(x))])

        # the film ends where p = p' = 0: x > 0 with h = at h0
        def end(at: float) -> float:
            return float(np.interp(np.sqrt(at - 1), x, pressure(at)))

        at = brentq(end, 1.01, 2.0)
        p = np.where(x < np.sqrt(at - 1), pressure(at), 0.0)
        carried.at = at
        return float(np.sum((p[1:] + p[:-1]) / 2 * np.diff(x)) * dx)

    h0 = brentq(lambda value: carried(value) - load, 1e-9, 1e-1)
    carried(h0)
    return carried.at * h0


def test_a_light_contact_has_the_rigid_film_of_martin():
    speed, load = 1e-11, 1e-8
    assert film.moes_line(1.0, speed, load) == pytest.approx(_martin_film(speed, load), rel=3e-3)


def test_the_wedge_pulls_as_the_integral_of_its_shear():
    h0, ratio = 1e-6, 1.225748440967634  # least film over the radius, and that where p' = 0
    stop = np.arctan(np.sqrt(ratio - 1))
    exact = np.sqrt(2 / h0) * (np.pi / 2 + stop)  # ∫ dx/h up to the rupture
    assert traction.inlet_force(1.0, 1.0, 1.0, 1.0, ratio * h0) == pytest.approx(exact, rel=1e-4)


def test_rigid_piezoviscous_limit_is_bloks():
    # least film 1.666 (G U)^(2/3), 1.2257 of it where p' = 0; soft films made thick by a tiny load
    g, u = 1e7, 1e-13
    exact = 1.2257 * 1.666 * (g * u) ** (2 / 3)
    assert film.moes_line(g, u, 3e-7) == pytest.approx(exact, rel=0.03)


@pytest.mark.parametrize("law", ["dowson-toyoda", "dowson-higginson", "hamrock", "crook"])
@pytest.mark.parametrize("speed", [2e-12, 1e-11, 5e-11])
@pytest.mark.parametrize("load", [2e-5, 1e-4, 3e-4])
def test_loaded_contacts_agree_with_the_elastic_laws(law, speed, load):
    ratio = film.moes_line(G, speed, load) / film.film_ratio(law, G, speed, load)
    assert 0.85 < ratio < 1.6


@given(st.floats(1e-14, 1e-9), st.floats(-12, -3), st.floats(10, 1e4))
@settings(deadline=None)
def test_film_falls_with_load_and_grows_with_speed(speed, log_load, material):
    load = 10.0**log_load
    here = film.moes_line(material, speed, load)
    assert (
        film.moes_line(material, speed, 1.1 * load)
        < here
        < film.moes_line(material, 1.1 * speed, load)
    )
    assert np.isfinite(film.moes_line(material, speed, 0.0))


def test_nijenbanning_agrees_with_hamrock_dowson_in_circular_contacts():
    for u in (3e-12, 1e-11, 1e-10):
        ours = film.nijenbanning_point(4500.0, u, 3e-7, 1.0)
        assert ours == pytest.approx(film.hamrock_dowson_central(4500.0, u, 3e-7, 1.0), rel=0.15)


def test_films_compile_as_they_stand():
    assert numba.njit(film.moes_line_exponent)(G, 1e-11, 1e-5) == pytest.approx(
        film.moes_line_exponent(G, 1e-11, 1e-5), rel=1e-13
    )


def test_thermal_and_starvation_factors():
    assert film.thermal_factor(0.007) == pytest.approx(0.974, abs=1e-3)
    assert film.zhu_cheng_factor(0.0, 0.003) == 1.0
    assert film.zhu_cheng_factor(1.0, 0.003, 0.2) < film.zhu_cheng_factor(1.0, 0.003)
    far, near = film.starvation_factor(np.array([1e-2, 60e-6]), 50e-6, 4.5e-3, 0.1e-6)
    assert far == 1.0
    assert 0 < near < 1
    assert film.starvation_factor(40e-6, 50e-6, 4.5e-3, 0.1e-6) == 0.0


def test_an_unknown_law_is_refused():
    with pytest.raises(InputError, match="moes"):
        film.film_ratio("guess", G, 1e-11, 1e-5)
