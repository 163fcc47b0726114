"""Lim–Singh stiffness, film dynamics, bearing matrices over frequency."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from richter import richter_printed

from loadflow.errors import InputError
from loadflow.rolling import (
    FrictionOptions,
    RollerBearing,
    SlewingBearing,
    _kernels,
    rotor_coefficients,
)
from loadflow.rolling.stiffness import contact_films as film_dynamics
from loadflow.tribology import lubricant
from loadflow.validation._lim_singh import (
    BALL,
    ROLLER,
    ball_row,
    lim_singh_roller,
    roller_row,
)

micro = st.floats(-3e-5, 3e-5)
small = st.floats(-1e-3, 1e-3)


@given(micro, micro, micro, small, small)
@settings(max_examples=40, deadline=None)
def test_closed_form_is_the_tangent_of_the_load_distribution(x, y, z, a, b):
    q = np.array([x, y, z, a, b])
    for bearing, closed in ((ROLLER, roller_row), (BALL, ball_row)):
        gradient, hessian = np.zeros(5), np.zeros((5, 5))
        _kernels.evaluate(q, *bearing.contacts().arguments, gradient, hessian)
        found = closed(q)
        assert found.loads == pytest.approx(gradient, rel=1e-9, abs=1e-6)
        scale = np.abs(hessian).max()
        assert found.stiffness[:5, :5] == pytest.approx(hessian, rel=1e-9, abs=1e-12 * scale)
        assert (found.stiffness[5] == 0).all()
        assert (found.stiffness[:, 5] == 0).all()


@pytest.mark.parametrize("closed", [roller_row, ball_row])
def test_closed_form_against_finite_differences(closed):
    q = np.array([3e-5, 1e-5, 1.5e-5, 2e-4, -3e-4])
    step = np.array([1e-9, 1e-9, 1e-9, 1e-8, 1e-8])
    exact = closed(q).stiffness[:5, :5]
    for j in range(5):
        change = np.eye(5)[j] * step
        column = (closed(q + change).loads - closed(q - change).loads) / (2 * step[j])
        # moments and forces differ by the pitch radius: each column against its own largest
        assert column == pytest.approx(exact[:, j], rel=1e-6, abs=1e-6 * np.abs(exact[:, j]).max())


def test_cases_are_vectorised():
    q = np.array([[3e-5, 0, 1e-5, 0, 0], [0, 2e-5, 2e-5, 1e-4, 0]])
    both = ball_row(q)
    assert both.stiffness[1] == pytest.approx(ball_row(q[1]).stiffness)


def test_cylindrical_rollers_resist_tilting_only_in_slices():
    sliced = RollerBearing(
        rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3
    )
    k = sliced.equilibrium(force=(5e3, 0, 0)).stiffness
    closed = lim_singh_roller([1e-5, 0, 0, 0, 0], np.linspace(0, 6, 14), 30.25e-3, 1e9)
    assert closed.stiffness[3, 3] == closed.stiffness[4, 4] == 0
    assert k[4, 4] > 0


def test_plate_series_meets_the_closed_form():
    for ratio in (0.99, 1.0, 1.01):  # |κb| about 0.2
        eta = 0.04 * ratio / (12 * 100.0 / (0.5e-6**2 * 1.5e9) * 1e-8)
        args = (1.5e9, 11e-3, 100e-6, 0.5e-6, eta, 100.0)
        found = film_dynamics.richter_plate(*args)
        k, d = richter_printed(*args)
        assert found.real == pytest.approx(k, rel=1e-9)
        assert found.imag / 100 == pytest.approx(d, rel=1e-11)


@given(st.floats(-9, 9), st.floats(-3, 5))
def test_plate_is_passive_finite_and_below_the_trapped_film(log_eta, log_omega):
    k = film_dynamics.richter_plate(1.5e9, 11e-3, 1e-4, 5e-7, 10.0**log_eta, 10.0**log_omega)
    assert np.isfinite(k)
    assert k.real >= 0
    assert k.imag > 0
    assert k.real <= 1.5e9 * 11e-3 / 5e-7 * 2e-4 * (1 + 1e-12)


def test_plate_limits():
    thin = film_dynamics.richter_plate(1.5e9, 11e-3, 1e-4, 5e-7, 1e-6, 10.0)
    assert thin.imag / 10 == pytest.approx(1e-6 * 11e-3 * (2e-4) ** 3 / (5e-7) ** 3, rel=1e-9)
    g3 = 12 * 1e-6 * 10 / (25e-14 * 1.5e9)
    assert thin.real == pytest.approx(1.5e9 * 11e-3 / 5e-7 * 4 / 15 * g3**2 * 1e-20, rel=1e-9)
    stiff = film_dynamics.richter_plate(1.5e9, 11e-3, 1e-4, 5e-7, 1e12, 1e3)
    assert stiff.real == pytest.approx(1.5e9 * 11e-3 / 5e-7 * 2e-4, rel=1e-3)
    with pytest.raises(InputError, match="film"):
        film_dynamics.richter_plate(1.5e9, 1.0, 1e-4, 0.0, 1.0, 1.0)


def test_dietl_elements():
    # Q = 1 kN on 11 mm: BEHW 1.713e8 N/m, ISO 1.901e8 N/m
    for constant, power, delta, expected in (
        (26_200 * 11**0.92 * 1e3**1.08, 1.08, 6.304e-6, 1.713e8),
        (35_948 * 11 ** (8 / 9) * 1e3 ** (10 / 9), 10 / 9, None, 1.901e8),
    ):
        depth = (1000 / constant) ** (1 / power)
        if delta:
            assert depth == pytest.approx(delta, rel=1e-3)
        k = film_dynamics.dietl_contact_stiffness(1000.0, depth, power)
        assert k == pytest.approx(expected, rel=1e-3)
        slope = (constant * (depth * 1.0001) ** power - constant * (depth * 0.9999) ** power) / (
            2e-4 * depth
        )
        assert k == pytest.approx(slope, rel=1e-6)
    assert film_dynamics.dietl_film_stiffness(1000.0, 0.5e-6) == pytest.approx(2e10)


OIL = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=333.15)
FREQUENCIES = np.logspace(-1, 5, 13)


@pytest.mark.parametrize("bearing", [ROLLER, BALL])
def test_a_dry_bearing_has_the_tangent_of_its_load_distribution(bearing):
    result = bearing.equilibrium(force=(3e3, 0, 3e3), moment=(0, 0), strict=False)
    out = rotor_coefficients(result, FREQUENCIES, model="dry", loss=0.0)
    for k in out.stiffness.values[0]:
        assert k[:5, :5] == pytest.approx(result.stiffness, rel=1e-12, abs=1e-3)
    assert (out.damping == 0).all()


@pytest.mark.parametrize("bearing", [ROLLER, BALL])
def test_films_soften_and_damp_less_and_less_with_frequency(bearing):
    result = bearing.equilibrium(force=[(3e3, 0, 3e3), (6e3, 0, 5e3)], strict=False)
    out = rotor_coefficients(result, FREQUENCIES, speed=100.0, options=OIL)
    dry = rotor_coefficients(result, FREQUENCIES, model="dry")
    kxx, cxx = out.stiffness.values[..., 0, 0], out.damping.values[..., 0, 0]
    assert (kxx <= dry.stiffness.values[..., 0, 0]).all()
    assert (kxx > 0.4 * dry.stiffness.values[..., 0, 0]).all()
    assert (np.diff(kxx, axis=-1) >= -1e-6 * kxx[..., :-1]).all()
    assert (np.diff(cxx, axis=-1) < 0).all()
    damping = out.damping.values[..., :5, :5]
    skew = np.abs(damping - np.swapaxes(damping, -1, -2)).max()
    assert skew < 1e-12 * np.abs(damping).max()
    scale = np.array([1, 1, 1, 1 / 0.03, 1 / 0.03])
    values = np.linalg.eigvalsh(damping * scale * scale[:, None])
    assert (values > -1e-9 * values.max()).all()  # passive


def test_proportional_damping_and_labels():
    result = BALL.equilibrium(force=(3e3, 0, 1e3))
    out = rotor_coefficients(result, [50.0], model="proportional", time_constant=2e-5)
    assert out.damping.values[0, 0, :5, :5] == pytest.approx(2e-5 * result.stiffness, rel=1e-12)
    assert out.attrs["model"] == "proportional"
    assert all({"units", "long_name"} <= set(out[v].attrs) for v in out.data_vars)


def test_rigid_films_at_standstill():
    result = BALL.equilibrium(force=(3e3, 0, 1e3))
    still = rotor_coefficients(result, [50.0], speed=0.0, options=OIL)
    dry = rotor_coefficients(result, [50.0], model="dry")
    assert still.stiffness.values == pytest.approx(dry.stiffness.values)


@pytest.mark.parametrize(
    ("frequency", "kwargs", "word"),
    [
        ([0.0], {"model": "dry"}, "frequency"),
        ([1.0], {"model": "wet"}, "model"),
        ([1.0], {}, "options"),
    ],
)
def test_bad_requests_are_refused(frequency, kwargs, word):
    with pytest.raises(InputError, match=word):
        rotor_coefficients(BALL.equilibrium(force=(3e3, 0, 1e3)), frequency, **kwargs)


def test_slewing_bearings_too():
    slewing = SlewingBearing(
        balls=45, ball_diameter=0.015, pitch_diameter=0.25, groove_radius=0.0078,
        contact_angle=0.7853981634,
    )  # fmt: skip
    result = slewing.equilibrium(force=(1e3, 0, 2e4), moment=(500, 0))
    dry = rotor_coefficients(result, [10.0], model="dry", loss=0.0)
    assert dry.stiffness.values[0, 0, :5, :5] == pytest.approx(result.stiffness, rel=1e-12)
    wet = rotor_coefficients(result, [10.0], speed=1.0, options=OIL)
    assert 0.5 < wet.stiffness.values[0, 0, 2, 2] / dry.stiffness.values[0, 0, 2, 2] < 1
