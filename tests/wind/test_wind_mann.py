"""Mann turbulence: what distinguishes it, at a false-alarm rate of 1e-3 for each statistical test.

Fixed seeds; each seed gives one independent number, tested by Student's t.
"""

import warnings
from itertools import combinations

import numpy as np
import pytest
from scipy import stats
from scipy.special import hyp2f1

from loadflow.errors import InputError, ValidityWarning
from loadflow.wind import Machine, WindOptions, condition, inflow, mann_box, read_hawc2_box
from loadflow.wind.mann import dissipation

mannrs = pytest.importorskip("mannrs")

ALARM = 1e-3
V, SIGMA, DT, SEEDS = 12.0, 2.0, 0.25, 32
LINES = 8.0 * np.arange(-4, 4)


def make(seed, **options):
    return mann_box(
        V, SIGMA, y=LINES, z=90.0 + LINES, hub_height=90.0, duration=511 * DT, dt=DT, seed=seed,
        **options,
    )  # fmt: skip


@pytest.fixture(scope="module")
def boxes():
    return [make(seed) for seed in range(SEEDS)]


def test_dissipation_holds_the_variance():
    """Integral of von Kármán's spectrum over all wavenumbers: 3/2 σ²; 55/18 · 0.4754 in short."""
    assert dissipation(1.0, 33.6) * 33.6 ** (2 / 3) == pytest.approx(55 / 18 * 0.4754, rel=1e-3)
    k = np.geomspace(1e-6, 1e6, 20_000)
    x = 33.6 * k
    energy = dissipation(1.3, 33.6) * 33.6 ** (5 / 3) * x**4 / (1 + x**2) ** (17 / 6)
    assert np.trapezoid(energy, k) == pytest.approx(1.5 * 1.3**2, rel=1e-3)


@pytest.mark.parametrize("mean_over_height", [False, True])
def test_the_power_of_small_eddies_is_that_of_the_tensor(boxes, mean_over_height):
    """Φ33 [Mann 1994] summed over the wavenumbers of a box of twice the width; w has no sum left.

    The mean over the height has the eddies of infinite height for the most part. 32 seeds and 164
    wavenumbers leave 0.3 and 0.7 % of scatter.
    """
    n, (count,), dx = 512, LINES.shape, V * DT
    k1 = 2 * np.pi * np.fft.fftfreq(n, dx)[:, None, None]
    k2 = 2 * np.pi * np.fft.fftfreq(2 * count, 8.0)[:, None]
    k3 = 2 * np.pi * np.fft.fftfreq(2 * count, 8.0)
    small = slice(90, 254)
    k1 = k1[small]
    length, gamma = 0.8 * 42.0, 3.9
    k = np.sqrt(k1**2 + k2**2 + k3**2)
    beta = (
        gamma
        * (k * length) ** (-2 / 3)
        / np.sqrt(hyp2f1(1 / 3, 17 / 6, 4 / 3, -((k * length) ** -2)))
    )
    k0 = np.sqrt(k1**2 + k2**2 + (k3 + beta * k1) ** 2)
    energy = dissipation(0.55 * SIGMA, length) * length ** (5 / 3) * (k0 * length) ** 4
    tensor = energy / (1 + (k0 * length) ** 2) ** (17 / 6) * (k1**2 + k2**2) / (4 * np.pi * k**4)
    kept = (
        np.exp(1j * np.multiply.outer(k3, LINES)).mean(-1) if mean_over_height else np.ones(k3.size)
    )
    due = (tensor * abs(kept) ** 2).sum() * (2 * np.pi) ** 3 / (n * dx * (2 * count * 8.0) ** 2)

    def power(box):
        w = box.w.mean(2, keepdims=True) if mean_over_height else box.w
        return (abs(np.fft.fft(w, axis=0)[small]) ** 2).mean((1, 2)).sum() / n**2

    assert np.mean([power(b) for b in boxes]) == pytest.approx(due, rel=0.02)


def test_u_and_w_are_correlated_downward_and_u_and_v_are_not(boxes):
    uw = [(b.u * b.w).mean(dtype=float) for b in boxes]
    uv = [(b.u * b.v).mean(dtype=float) for b in boxes]
    assert stats.ttest_1samp(uw, 0.0, alternative="less").pvalue < ALARM
    assert stats.ttest_1samp(uv, 0.0).pvalue > ALARM


def test_what_is_higher_comes_earlier(boxes):
    """Shear leans the eddies forward: low follows high, so its phase lags below 0.25 Hz."""

    def lag(box):
        line = np.fft.rfft(box.u, axis=0)[1:32]
        pairs = combinations(range(len(LINES)), 2)
        return sum((line[..., i] * line[..., j].conj()).imag.sum(dtype=float) for i, j in pairs)

    found = stats.ttest_1samp([lag(b) for b in boxes], 0.0, alternative="less")
    assert found.pvalue < ALARM


def test_seeds_are_independent(boxes):
    pairs = zip(boxes[::2], boxes[1::2])
    shared = [(a.u * b.u).mean(dtype=float) for a, b in pairs]
    assert stats.ttest_1samp(shared, 0.0).pvalue > ALARM
    np.testing.assert_array_equal(boxes[3].w, make(3).w)


def test_components_are_ordered_and_hub_scaling_keeps_their_ratio(boxes):
    spread = np.array([[getattr(b, c).std(dtype=float) for c in "uvw"] for b in boxes])
    for bigger, smaller in ((0, 1), (1, 2)):
        gap = stats.ttest_rel(spread[:, bigger], spread[:, smaller], alternative="greater")
        assert gap.pvalue < ALARM
    scaled = make(0, scaling="hub")
    assert scaled.u[:, 4, 4].std(dtype=float) == pytest.approx(SIGMA, rel=1e-5)
    factor = scaled.u[0, 0, 0] / boxes[0].u[0, 0, 0]
    np.testing.assert_allclose(scaled.w, factor * boxes[0].w, rtol=1e-4, atol=1e-6)


def test_files_of_hawc2_hold_the_same_box(boxes, tmp_path):
    """Its own writer: raw planes, the last of which meets the rotor first."""
    box, paths = boxes[0], [tmp_path / f"{c}.bin" for c in "uvw"]
    axes = (np.arange(512.0), LINES, LINES)
    parts = (np.ascontiguousarray(getattr(box, c)[::-1]) for c in "uvw")
    mannrs.Windfield(*parts, *axes).to_HAWC2(*paths)
    keys = {"shape": (512, 8, 8), "spacing": (V * DT, 8.0, 8.0), "wind_speed": V}
    back = read_hawc2_box(*paths, hub_height=90.0, **keys)
    for c in "uvw":
        np.testing.assert_array_equal(getattr(back, c), getattr(box, c))
    np.testing.assert_allclose(back.time, box.time)
    paths[1].write_bytes(paths[1].read_bytes()[:-4])
    with pytest.raises(InputError, match=r"v\.bin: 131068 bytes"):
        read_hawc2_box(*paths, hub_height=90.0, **keys)


@pytest.mark.parametrize(
    "shape", [(512, 4, 16), (512, 16, 4), (1024, 4, 8), (8, 512, 8), (8, 8, 512), (512, 2, 32)]
)
def test_a_shape_that_fits_the_size_but_not_the_values_is_doubted(boxes, tmp_path, shape):
    paths = [tmp_path / f"{c}.bin" for c in "uvw"]
    for path, c in zip(paths, "uvw"):
        path.write_bytes(np.ascontiguousarray(getattr(boxes[0], c)[::-1]).astype("<f4").tobytes())
    keys = {"spacing": (V * DT, 8.0, 8.0), "wind_speed": V, "hub_height": 90.0}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        right = read_hawc2_box(*paths, shape=(512, 8, 8), **keys)
        mirrored = read_hawc2_box(*paths, shape=(512, 8, 8), first_line="left", **keys)
    np.testing.assert_array_equal(mirrored.v, right.v[:, ::-1])
    with pytest.warns(ValidityWarning, match=r"u\.bin: .*; is the shape .* right"):
        read_hawc2_box(*paths, shape=shape, **keys)


def test_a_condition_takes_it():
    machine = Machine(cut_in=3, rated=11.4, cut_out=25, rotor_diameter=126, hub_height=90)
    options = WindOptions(spectrum="mann", radii=4, angles=12, step=0.25)
    case = condition("1.1", machine, options, wind_speed=12.0, duration=60.0)
    field = inflow(case, machine, options)
    assert field.u.shape == (241, 4, 12)
    assert 0.3 < field.hub.std() / case.sigma < 1.5
    with pytest.raises(InputError, match="'each'"):
        inflow(case, machine, WindOptions(spectrum="mann", scaling="each"))


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"gamma": -1.0}, "gamma"),
        ({"scaling": "each"}, "scaling"),
        ({"length_scale": 0.0}, "scale"),
    ],
)
def test_nonsense_is_refused(options, message):
    with pytest.raises(InputError, match=message):
        make(1, **options)
