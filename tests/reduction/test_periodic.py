"""Harmonics, frequency bounds, periodic loads."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.reduction import (
    amplitude_spectrum,
    closing_period,
    find_harmonics,
    frequency_bounds,
    periodic,
)

DEGREE = np.pi / 180
# Table 5-14 of the source, seed 1: mean, then amplitude (kN) and printed angular frequency (°/s)
FX = (2584.26, (615.76, 6.59), (336.02, 87.01), (204.15, 261.04))
FY = (-459.68, (608.10, 4.83), (329.20, 87.01), (183.02, 265.87))
SPEED = 12.1 * np.pi / 30


def table_5_14(time, slow_down=1.0):
    """Force (n, 2) in N synthesised from the table, frequencies divided by `slow_down`."""
    axes = []
    for mean, *tones in (FX, FY):
        x = np.full_like(time, mean)
        for amplitude, omega in tones:
            x += amplitude * np.sin(omega * DEGREE / slow_down * time)
        axes.append(1e3 * x)
    return np.stack(axes, axis=1)


def test_table_5_14_is_found_again():
    time = 0.03 * np.arange(20_000)
    got = periodic(
        np.full(20_000, SPEED), table_5_14(time, 1.2), time, bounds=(0.1, 1.0), additional=2
    )
    for axis, (mean, *tones), found in zip((0, 1), (FX, FY), got.harmonics):
        # slow sines that do not close leave the record's mean a little off
        assert got.mean[axis] == pytest.approx(1e3 * mean, abs=0.05e3 * tones[0][0])
        assert [h.kind for h in found] == ["base", "additional", "additional"]
        for h, (amplitude, omega) in zip(found, tones):
            assert h.amplitude == pytest.approx(1e3 * amplitude, rel=1e-3)
            assert h.frequency * 360 == pytest.approx(omega / 1.2, rel=1e-3)
    assert [h.label for h in got.harmonics[0]] == ["", "1p", "3p"]


def test_wrong_time_step_makes_the_printed_frequencies_1p2_times_too_high():
    """Series of step 0.03 s transformed with 0.025 s, 20,000 values padded to 2^15: erratum 4."""
    n = 20_000
    force = table_5_14(0.03 * np.arange(n), slow_down=1.2)
    options = {"window": "rectangular", "points": 2**15, "refine": False, "bounds": (0.1, 1.0)}
    wrong = periodic(np.full(n, SPEED), force, 0.025 * np.arange(n), **options)
    right = periodic(np.full(n, SPEED), force, 0.03 * np.arange(n), **options)
    line = 360 / (2**15 * 0.025)
    assert line == pytest.approx(0.43945, abs=5e-6)
    printed = [h.frequency * 360 for h in wrong.harmonics[0]]
    assert printed[1] == pytest.approx(87.01, abs=0.005)
    assert printed[2] == pytest.approx(261.04, abs=0.01)
    assert printed[1] / line == pytest.approx(198)
    assert printed[2] / line == pytest.approx(594)
    for a, b in zip(wrong.frequencies, right.frequencies):
        assert a / b == pytest.approx(1.2)
    # only the true step lets the order of the rotor be recognised
    assert [h.label for h in right.harmonics[0][1:]] == ["1p", "3p"]
    assert [h.label for h in wrong.harmonics[0][1:]] == ["", ""]


@settings(max_examples=30, deadline=None)
@given(
    st.floats(0.02, 4.5),
    st.floats(-3.1, 3.1),
    st.floats(1e-3, 1e6),
    st.sampled_from(["hann", "rectangular"]),
)
def test_a_single_sine_is_found_exactly_between_the_lines(frequency, phase, amplitude, window):
    t = 0.1 * np.arange(3000)
    x = amplitude * (3.0 + np.sin(2 * np.pi * frequency * t + phase))
    (h,) = find_harmonics(x, 0.1, 1, window=window)
    assert h.frequency == pytest.approx(frequency, rel=1e-6)
    assert h.amplitude == pytest.approx(amplitude, rel=1e-5)
    assert np.cos(h.phase - phase) == pytest.approx(1.0, abs=1e-6)


def test_weak_sine_beside_a_strong_one_and_no_side_lobes():
    t = 0.05 * np.arange(12_000)
    x = np.sin(2 * np.pi * 0.2013 * t) + 0.002 * np.sin(2 * np.pi * 0.2113 * t + 1.0)
    strong, weak = find_harmonics(x, 0.05, 2)
    assert strong.frequency == pytest.approx(0.2013, rel=1e-7)
    assert weak.frequency == pytest.approx(0.2113, rel=1e-5)
    assert weak.amplitude == pytest.approx(0.002, rel=1e-3)


def test_sine_in_noise_is_as_sure_as_it_can_be():
    """Cramér–Rao bound of the frequency: √6 σ / (π A T √n); within 5 of it (Hann: 1.6 times)."""
    rng = np.random.default_rng(4)
    n, dt = 10_000, 0.05
    x = np.sin(2 * np.pi * 0.6047 * dt * np.arange(n)) + rng.standard_normal(n)
    (h,) = find_harmonics(x, dt, 1)
    bound = np.sqrt(6) / (np.pi * n * dt * np.sqrt(n))
    assert abs(h.frequency - 0.6047) < 5 * bound


def test_spectrum_of_a_sine_on_a_line_is_its_amplitude_whatever_the_window():
    t = 0.1 * np.arange(1000)
    for window in ("hann", "rectangular"):
        f, a = amplitude_spectrum(5 + 3 * np.cos(2 * np.pi * 0.5 * t + 0.3), 0.1, window, 1000)
        peak = int(np.argmax(np.abs(a)))
        assert f[peak] == pytest.approx(0.5)
        assert abs(a[peak]) == pytest.approx(3.0)
        assert np.angle(a[peak]) == pytest.approx(0.3)


def test_constant_force_has_no_harmonics_and_a_named_tower_frequency_has_its_name():
    t = 0.05 * np.arange(4000)
    force = np.stack([np.full(4000, 2e6), 1e5 * np.sin(2 * np.pi * 0.32 * t)], axis=1)
    got = periodic(np.full(4000, SPEED), force, t, additional=1, named={"tower": 0.32})
    assert got.harmonics[0] == ()
    assert "tower" in [h.label for h in got.harmonics[1]]


def test_orders_are_taken_whatever_else_is_stronger():
    t = 0.05 * np.arange(12_000)
    p = SPEED / (2 * np.pi)
    x = (
        2 * np.sin(2 * np.pi * 0.45 * t)
        + np.sin(2 * np.pi * p * t)
        + 0.5 * np.sin(6 * np.pi * p * t)
    )
    force = np.stack([x, x], axis=1)
    got = periodic(np.full(t.size, SPEED), force, t, orders=(1, 3), bounds=(0.05, 1.0))
    assert [h.label for h in got.harmonics[0] if h.kind == "additional"] == ["1p", "3p"]


def test_load_as_function_and_as_closed_series():
    t = 0.05 * np.arange(12_000)
    force = table_5_14(t, 1.2)
    load = periodic(np.full(t.size, SPEED), force, t, bounds=(0.1, 1.0))
    error = load(t) - force
    assert np.sqrt(np.mean(error[200:-200] ** 2)) < 0.01 * force[:, 0].mean()
    assert load(1.0).shape == (2,)
    closed = load.closed(tolerance=0.02)
    _, series = closed.series(dt=0.05)
    np.testing.assert_allclose(series[0], series[-1], atol=1e-6 * 2.5e6)
    for a, b in zip(closed.frequencies, load.frequencies):
        assert a == pytest.approx(b, rel=0.0201)
    assert load.series(0.5, duration=10.0)[0].size == 21


@given(st.lists(st.floats(0.004, 3.0), min_size=1, max_size=5), st.sampled_from([0.05, 0.01]))
def test_closing_period_rounds_within_the_tolerance(frequencies, tolerance):
    got = closing_period(frequencies, tolerance)
    turns = np.array(got.frequencies) * got.period
    np.testing.assert_allclose(turns, np.rint(turns), atol=1e-6)
    np.testing.assert_allclose(got.frequencies, frequencies, rtol=tolerance * 1.001)
    assert got.error <= tolerance


def low_pass(corner, quasi_static=0.3, dead=0.6):
    """A bearing that follows slow loads: E falls from 0.9 to 0.6 around the corner frequency."""

    def response(mean, amplitude, frequency):
        return dead + quasi_static / (1 + (frequency / corner) ** 2)

    return response


def test_bounds_are_where_the_rise_passes_one_percent():
    got = frequency_bounds(low_pass(0.3), [2e6, 0], [5e5, 5e5])
    assert got.bracketed
    e, f = got.eccentricity, got.frequency
    up, down = list(f).index(got.high), list(f).index(got.low)
    assert e[up + 1] / e[up] - 1 > 0.01 >= e[up] / e[up - 1] - 1
    assert e[down + 1] / e[down] - 1 < 0.01 <= e[down] / e[down - 1] - 1
    assert got.low < 0.3 < got.high
    slower = frequency_bounds(low_pass(0.1), [2e6, 0], [5e5, 5e5])
    assert slower.high <= got.high
    assert slower.low <= got.low


def test_bounds_outside_the_trial_frequencies_are_flagged():
    unmoved = frequency_bounds(lambda m, a, f: 0.6, [1, 0], [1, 0])
    assert not unmoved.bracketed
    assert unmoved.low == unmoved.high == pytest.approx(1 / 40)
    always = frequency_bounds(lambda m, a, f: 0.6 * f**-0.1, [1, 0], [1, 0])
    assert (always.high, always.low, always.bracketed) == (3.0, 1 / 40, False)


def test_the_bearing_sets_the_bounds_of_the_periodic_load():
    t = 0.05 * np.arange(12_000)
    asked = []

    def response(mean, amplitude, frequency):
        asked.append((mean, amplitude))
        return low_pass(0.3)(mean, amplitude, frequency)

    force = table_5_14(t, 1.2)
    got = periodic(np.full(t.size, SPEED), force, t, response=response)
    assert got.bounds.bracketed
    np.testing.assert_allclose(asked[0][0], force.mean(axis=0))
    np.testing.assert_allclose(asked[0][1], np.sqrt(2) * force.std(axis=0))
    assert all(h.frequency < got.bounds.low for a in got.harmonics for h in a if h.kind == "base")


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: frequency_bounds(lambda m, a, f: np.nan, [1, 0], [1, 0]), SolverError, "nan"),
        (lambda: frequency_bounds(low_pass(1), [1, 0], [1, 0], [1, 2, 3]), InputError, "must fall"),
        (
            lambda: frequency_bounds(low_pass(1), [1, 0], [1, 0], threshold=0),
            InputError,
            "threshold",
        ),
        (lambda: closing_period([]), InputError, "at least one"),
        (lambda: closing_period([1.0, -1.0]), InputError, "all > 0"),
        (lambda: closing_period([1.0], tolerance=0), InputError, "tolerance = 0"),
        (lambda: amplitude_spectrum(np.ones(9), 1.0, points=4), InputError, "points = 4"),
        (lambda: amplitude_spectrum(np.ones(9), 1.0, "flat"), InputError, "window = 'flat'"),
    ],
)
def test_bad_input_is_named(call, error, message):
    with pytest.raises(error, match=message):
        call()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"time": np.array([0, 1, 2, 3, 4, 5, 6, 7, 8, 9.5])}, "step 1.5 s at index 8"),
        ({"bounds": (1.0, 0.5)}, r"bounds = \(1, 0.5\)"),
        ({"bounds": (0.1, 1.0), "response": low_pass(1)}, "either bounds or response"),
    ],
)
def test_bad_periodic_input_is_named(change, message):
    arguments = {
        "speed": np.ones(10),
        "force": np.random.default_rng(0).standard_normal((10, 2)),
        "time": np.arange(10.0),
    }
    with pytest.raises(InputError, match=message):
        periodic(**(arguments | change))


def test_another_step_gives_the_same_harmonics():
    t = 0.05 * np.arange(12_000)
    force = table_5_14(t, 1.2)
    fine, coarse = (
        periodic(np.full(s.size, SPEED), f, s, bounds=(0.1, 1.0))
        for s, f in ((t, force), (t[::2], force[::2]))
    )
    for a, b in zip(fine.harmonics, coarse.harmonics):
        for one, other in zip(a, b):
            assert other.label == one.label
            assert other.frequency == pytest.approx(one.frequency, rel=1e-6)
            assert other.amplitude == pytest.approx(one.amplitude, rel=1e-4)
