"""Turbulence: its statistics at stated false-alarm rates, and what the options do.

All statistical tests run on fixed seeds and compare with the exact distribution of the statistic,
so with other seeds a correct generator fails each of them with at most the probability `ALARM`.
The field is Gaussian and periodic over its whole length here: its Fourier coefficients at
different frequencies are independent, with a variance that the spectrum gives.
"""

from itertools import combinations

import numpy as np
import pytest
from scipy import stats

from loadflow.errors import InputError
from loadflow.wind import (
    CoherenceFactors,
    Field,
    PolarGrid,
    case_seed,
    kaimal,
    kaimal_box,
    polar_angles,
)
from loadflow.wind.spectra import coherence, kaimal_spectrum

ALARM = 1e-3
V, SIGMA, LENGTH = 12.0, 2.0, 42.0
RADIUS, ANGLES = np.array([0.0, 10.0, 30.0, 63.0]), polar_angles(8)
DT, SAMPLES, SEEDS = 0.1, 4096, 12  # 4096 is a length that the FFT takes as it is: no cut
FREQUENCY = np.arange(1, SAMPLES // 2) / (SAMPLES * DT)


def make(seed, speed=V, **options) -> Field:
    duration = DT * (SAMPLES - 1)
    defaults = {"radius": RADIUS, "angles": ANGLES, "length_scale": LENGTH}
    return kaimal(speed, SIGMA, duration=duration, dt=DT, seed=seed, **(defaults | options))


@pytest.fixture(scope="module")
def fields() -> list[Field]:
    factors = CoherenceFactors(PolarGrid(RADIUS, ANGLES), LENGTH)
    return [make(case_seed("1.1", V, index), factors=factors) for index in range(SEEDS)]


def white(fields, component, ring, angle):
    """Fourier coefficients scaled to unit variance by the Kaimal spectrum, (seed, frequency)."""
    series = np.array([getattr(f, "uvw"[component])[:, ring, angle] for f in fields], float)
    density = kaimal_spectrum(FREQUENCY, V, SIGMA, LENGTH, component)
    coefficient = np.fft.rfft(series)[:, 1:-1] / SAMPLES
    return coefficient / np.sqrt(density / (2 * SAMPLES * DT))


def two_sided(p: float) -> float:
    return 2 * min(p, 1 - p)


@pytest.mark.parametrize("component", [0, 1, 2])
@pytest.mark.parametrize(("ring", "angle"), [(0, 0), (1, 3), (3, 6)])
def test_spectrum_is_kaimal_in_every_band(fields, component, ring, angle):
    power = (np.abs(white(fields, component, ring, angle)) ** 2).mean(axis=0)
    bands = np.array_split(power, np.unique(np.geomspace(4, len(power), 7).astype(int))[:-1])
    for band in bands:  # 2 n times the mean of n squared magnitudes is chi-squared, 2 n degrees
        n = SEEDS * len(band)
        p = two_sided(stats.chi2.cdf(2 * n * band.mean(), 2 * n))
        assert p > ALARM / len(bands)


@pytest.mark.parametrize("component", [0, 1, 2])
@pytest.mark.parametrize(
    ("a", "b"), [((0, 0), (1, 0)), ((1, 0), (1, 1)), ((2, 1), (2, 5)), ((2, 7), (3, 0))]
)
def test_coherence_is_that_of_the_standard(fields, component, a, b):
    grid = PolarGrid(RADIUS, ANGLES).points
    expected = coherence(FREQUENCY, abs(grid[a] - grid[b]), V, LENGTH)
    cross = white(fields, component, *a) * white(fields, component, *b).conj()
    # real part: mean γ, variance (1 + γ²)/2; imaginary part: mean 0, variance (1 − γ²)/2
    in_phase = (cross.real - expected).sum() / np.sqrt(SEEDS * ((1 + expected**2) / 2).sum())
    quadrature = cross.imag.sum() / np.sqrt(SEEDS * ((1 - expected**2) / 2).sum())
    for z in (in_phase, quadrature):
        assert two_sided(stats.norm.cdf(z)) > ALARM / 2


def test_variance_is_the_sum_of_the_spectrum_and_no_more():
    count = 150
    small = {"radius": [0.0, 30.0], "angles": polar_angles(3)}
    series = (make(case_seed("1.2", V, index), **small) for index in range(count))
    variances = np.array(
        [[getattr(field, c)[:, 1, 1].var(dtype=float) for c in "uvw"] for field in series]
    )
    # Laurent and Massart (2000), lemma 1: tails of a weighted sum of squared normal variables
    x = np.log(2 / ALARM)
    for k in range(3):
        lines = kaimal_spectrum(FREQUENCY, V, SIGMA, LENGTH, k) / (SAMPLES * DT)
        limit = np.sqrt(2 * x * (lines**2).sum() / count) + x * lines.max() / count
        assert limit < 0.15 * lines.sum()  # sharp enough to mean something
        assert abs(variances[:, k].mean() - lines.sum()) < limit


def test_seeds_speeds_and_components_are_independent(fields):
    others = make(case_seed("1.1", 14.0, 0), speed=14.0)
    density = kaimal_spectrum(FREQUENCY, 14.0, SIGMA, LENGTH)
    other = np.fft.rfft(others.hub.astype(float))[1:-1] / SAMPLES
    rows = [*white(fields, 0, 0, 0), *white(fields, 1, 0, 0), *white(fields, 2, 0, 0)]
    rows.append(other / np.sqrt(density / (2 * SAMPLES * DT)))
    pairs = list(combinations(rows, 2))
    # |Σ a b*|² / n is exponential with mean 1 when a and b are independent unit noise
    largest = max(abs(np.vdot(a, b)) ** 2 / len(FREQUENCY) for a, b in pairs)
    assert largest < -np.log(ALARM / len(pairs))


def test_noise_is_gaussian(fields):
    sample = white(fields, 0, 2, 3).ravel()
    p = stats.kstest(np.concatenate([sample.real, sample.imag]), "norm", (0, np.sqrt(0.5))).pvalue
    assert p > ALARM


@pytest.mark.parametrize("oversampled", [2, 3])
def test_a_longer_step_is_the_same_wind_without_what_is_faster(oversampled):
    options = {"radius": RADIUS, "angles": ANGLES, "length_scale": LENGTH, "seed": 4}
    step, period = 0.1, 3 * 2**11  # the FFT takes both lengths as they are: no cut
    fine = kaimal(V, SIGMA, duration=step * (period - 1), dt=step, **options)
    coarse = kaimal(
        V,
        SIGMA,
        duration=step * (period - oversampled),
        dt=oversampled * step,
        oversampled=oversampled,
        **options,
    )
    for part in ("u", "v", "w"):
        spectrum = np.fft.rfft(getattr(fine, part), axis=0)[: period // oversampled // 2]
        ours = np.fft.rfft(getattr(coarse, part), axis=0)[:-1]
        np.testing.assert_allclose(oversampled * ours, spectrum, rtol=0, atol=2e-4 * period**0.5)


@pytest.mark.parametrize("duration", [30.0, 100.0, 150.0])
def test_half_the_step_is_the_same_wind_of_every_duration(duration):
    options = {"duration": duration, "radius": RADIUS, "angles": ANGLES, "length_scale": LENGTH}
    fine = kaimal(V, SIGMA, dt=0.05, seed=4, **options).u[::2]
    coarse = kaimal(V, SIGMA, dt=0.1, seed=4, oversampled=2, **options).u
    assert np.std(coarse - fine) < 0.15 * np.std(fine)  # what is faster than 5 Hz


def test_independent_lateral_components_share_nothing_between_points():
    field = make(3, lateral="independent")
    coherent = make(3)
    np.testing.assert_array_equal(field.u, coherent.u)
    z = white([field], 1, 1, 0) * white([field], 1, 1, 1).conj()
    p = stats.norm.cdf(z.real.sum() / np.sqrt(z.size / 2))
    assert two_sided(p) > ALARM
    assert np.corrcoef(coherent.v[:, 1, 0], coherent.v[:, 1, 1])[0, 1] > 0.5


# -- what does not depend on chance --------------------------------------------------------------


def test_fast_is_exact_within_a_thousandth_of_sigma():
    error = make(5).u - make(5, method="exact").u
    assert 0 < error.std() < 5e-4 * SIGMA
    assert abs(error).max() < 5e-3 * SIGMA


def test_hub_is_one_point(fields):
    for component in (fields[0].u, fields[0].v, fields[0].w):
        assert np.ptp(component[:, 0, :], axis=1).max() < 1e-5
        assert np.ptp(component[:, 1, :], axis=1).max() > 0.1


def test_scaling_sets_the_deviation_where_it_says():
    target = np.array([SIGMA, 0.8 * SIGMA, 0.5 * SIGMA])
    hub, each, none = (make(7, scaling=s) for s in ("hub", "each", "none"))
    for field, where in ((hub, np.s_[:, 0, 0]), (each, np.s_[:, :, :])):
        got = [getattr(field, c)[where].std(axis=0, dtype=float) for c in "uvw"]
        for value, sigma in zip(got, target, strict=True):
            np.testing.assert_allclose(value, sigma, rtol=1e-5)
    ratio = hub.u.std(dtype=float) / none.u.std(dtype=float)
    np.testing.assert_allclose(hub.u, ratio * none.u, rtol=1e-3, atol=1e-4)


def test_u_does_not_depend_on_the_other_components():
    only = make(9, components="u")
    assert only.v is None
    assert only.w is None
    np.testing.assert_array_equal(only.u, make(9).u)


def test_the_seed_is_not_used_up():
    seed = case_seed("1.1", V, 0)
    np.testing.assert_array_equal(make(seed).w, make(seed).w)


@pytest.mark.parametrize(("duration", "dt", "last"), [(600.0, 0.025, 600.0), (1.0, 0.3, 1.2)])
def test_series_covers_its_duration(duration, dt, last):
    field = kaimal(
        V, SIGMA, radius=[0, 9.0], angles=polar_angles(3), duration=duration, dt=dt, seed=1,
        hub_height=90.0, components="u",
    )  # fmt: skip
    assert field.time[0] == 0
    assert field.time[-1] == pytest.approx(last)
    assert field.u.dtype == np.float32
    assert field.u.flags.c_contiguous


def test_no_turbulence_without_sigma():
    field = kaimal(
        V, 0.0, radius=RADIUS, angles=ANGLES, duration=5.0, dt=0.1, seed=1, hub_height=90.0,
        scaling="hub",
    )  # fmt: skip
    assert np.all(field.u == 0)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"speed": 0.0}, "wind_speed = 0"),
        ({"length_scale": -1.0}, "length_scale = -1"),
        ({"length_scale": None}, "either hub_height or length_scale"),
        ({"hub_height": 90.0}, "either hub_height or length_scale"),
        ({"components": "w"}, "components: must be one of .* got 'w'"),
        ({"scaling": "most"}, "scaling: must be one of .* got 'most'"),
        ({"lateral": "loose"}, "lateral: must be one of .* got 'loose'"),
        ({"method": "slow"}, "method: must be one of .* got 'slow'"),
        ({"seed": -1}, "seed = -1"),
        ({"radius": [0.0, 5.0, 4.0]}, "rise from 0"),
        (
            {"factors": CoherenceFactors(PolarGrid(RADIUS, polar_angles(6)), LENGTH)},
            "another grid",
        ),
        ({"factors": CoherenceFactors(PolarGrid(RADIUS, ANGLES), 21.0)}, "another grid or length"),
    ],
)
def test_nonsense_is_refused(options, message):
    with pytest.raises(InputError, match=message):
        make(**({"seed": 1} | options))


@pytest.mark.parametrize(("duration", "dt"), [(10.0, 0.0), (0.1, 0.1), (np.inf, 0.1)])
def test_a_series_needs_steps(duration, dt):
    with pytest.raises(InputError, match="duration"):
        kaimal(
            V, SIGMA, radius=RADIUS, angles=ANGLES, duration=duration, dt=dt, seed=1, hub_height=90
        )


# -- rectangular grid ----------------------------------------------------------------------------


def test_box_and_polar_grid_have_the_same_statistics():
    lines = np.linspace(-30.0, 30.0, 5)
    boxes = [
        kaimal_box(
            V, SIGMA, y=lines, z=90.0 + lines, hub_height=90.0, duration=DT * (SAMPLES - 1),
            dt=DT, seed=s, components="u",
        )
        for s in range(SEEDS)
    ]  # fmt: skip
    density = kaimal_spectrum(FREQUENCY, V, SIGMA, LENGTH)

    def coefficients(i, j):
        series = np.array([b.u[:, i, j] for b in boxes], float)
        return np.fft.rfft(series)[:, 1:-1] / SAMPLES / np.sqrt(density / (2 * SAMPLES * DT))

    n = SEEDS * len(FREQUENCY)
    power = np.abs(coefficients(4, 1)) ** 2
    assert two_sided(stats.chi2.cdf(2 * power.sum(), 2 * n)) > ALARM
    expected = coherence(FREQUENCY, np.hypot(15, 30), V, LENGTH)
    cross = coefficients(2, 2) * coefficients(3, 4).conj()
    z = (cross.real - expected).sum() / np.sqrt(SEEDS * ((1 + expected**2) / 2).sum())
    assert two_sided(stats.norm.cdf(z)) > ALARM


def test_box_scaled_at_the_hub_and_sampled_on_the_disc():
    lines = np.linspace(-30.0, 30.0, 7)
    box = kaimal_box(
        V, SIGMA, y=lines, z=90.0 + lines, hub_height=90.0, duration=60.0, dt=0.1, seed=1,
        scaling="hub",
    )  # fmt: skip
    field = box.to_polar([0.0, 10.0, 30.0], polar_angles(4))
    assert field.hub.std(dtype=float) == pytest.approx(SIGMA, rel=1e-5)
    # the grid points up, right, down and left of the hub, 30 m away
    for angle, (i, j) in enumerate([(3, 6), (0, 3), (3, 0), (6, 3)]):
        np.testing.assert_allclose(field.w[:, 2, angle], box.w[:, i, j], atol=1e-5)
    with pytest.raises(InputError, match="leaves the box"):
        box.to_polar([0.0, 31.0], polar_angles(4))
