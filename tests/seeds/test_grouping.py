"""Grouping of seeds, equivalence, number of seeds."""

import numpy as np
import pytest
import xarray as xr
from scipy.stats import binom
from seed_noise import ar1

from loadflow.errors import InputError
from loadflow.seeds import (
    averaged_spectrum,
    effective_size,
    equivalence,
    group_seeds,
    group_seeds_jointly,
    holm,
    seeds_needed,
)

DT, N = 0.1, 6000


def cube_of(x):
    return xr.DataArray(
        x,
        dims=("case", "time"),
        coords={"time": DT * np.arange(x.shape[1]), "seed": ("case", np.arange(x.shape[0]) + 1)},
    )


def test_three_kinds_of_seed_become_three_groups_with_reasons():
    x = ar1(np.random.default_rng(4), (6, N), DT, 2.0) + 10
    x[2] += 2.0
    x[4] = 10 + 2.0 * (x[4] - 10)
    got = group_seeds(cube_of(x), alpha=0.05, method="calibrated")
    np.testing.assert_array_equal(got.labels, [0, 0, 1, 0, 2, 0])
    np.testing.assert_array_equal(got.labels["seed"], np.arange(6) + 1)
    assert got.labels.dims == ("case",)
    assert got.groups == [(0, 1, 3, 5), (2,), (4,)]
    assert got.reasons[0].startswith("groups 1 and 2: location differs")
    assert "spread differs" in got.reasons[1]
    assert len(got.reasons) == 3
    assert got.representatives[0] in (0, 1, 3, 5)
    assert got.representatives[1:].tolist() == [2, 4]
    chief = got.representatives[0] + 1
    told = got.in_words([*"123456"])  # a star would mean a test that fails, in the table above it
    assert told.startswith(f"{{1, 2, 4, 6}} ({chief} stands for them) {{3}} {{5}}. groups 1 and 2")


def test_equal_seeds_are_one_group_except_for_the_stated_false_alarms():
    """150 null cases at 5 %; number of splits within the 99.9 % binomial bound."""
    rng = np.random.default_rng(6)
    splits = sum(len(group_seeds(ar1(rng, (6, N), DT, 3.0), dt=DT).groups) > 1 for _ in range(150))
    assert splits <= binom.ppf(0.9995, 150, 0.05)


def test_as_printed_never_groups_correlated_seeds_but_does_group_a_seed_with_its_copy():
    x = ar1(np.random.default_rng(8), (4, N), DT, 5.0)
    x[3] = x[0]
    got = group_seeds(x, method="as-printed", dt=DT)
    assert got.groups == [(0, 3), (1,), (2,)]


def test_order_of_the_dims_and_a_single_seed():
    x = cube_of(ar1(np.random.default_rng(9), (3, N), DT, 1.0))
    np.testing.assert_array_equal(group_seeds(x).labels, group_seeds(x.T).labels)
    one = group_seeds(x[:1])
    assert one.reasons == ("one seed, nothing to test",)
    assert one.groups == [(0,)]
    assert one.representatives.tolist() == [0]


def test_seeds_are_joined_only_if_every_component_agrees():
    rng = np.random.default_rng(21)
    speed, force = ar1(rng, (4, N), DT, 2.0) + 10, ar1(rng, (4, N), DT, 2.0)
    force[3] += 4.0
    got = group_seeds_jointly({"speed": speed, "force": force}, DT)
    assert got.groups == [(0, 1, 2), (3,)]
    assert "force: location differs" in got.reasons[0]
    assert "speed" not in got.reasons[0]
    alone = group_seeds_jointly({"speed": speed}, DT)
    assert alone.groups == [(0, 1, 2, 3)]
    assert alone.verdict.pvalue == group_seeds(speed, dt=DT).verdict.pvalue
    with pytest.raises(InputError, match="the same for every component"):
        group_seeds_jointly({"speed": speed, "force": force[:3]}, DT)


def test_false_alarms_of_all_components_together():
    """Twelve components of equal seeds, α = 5 %: more than 8 of 60 sets has a chance of 0.3 %."""
    rng = np.random.default_rng(30)
    rejected = 0
    for _ in range(60):
        parts = {str(k): ar1(rng, (3, 4000), DT, 1.0) for k in range(12)}
        rejected += len(group_seeds_jointly(parts, DT).groups) > 1
    assert rejected <= 8


def test_a_margin_asks_for_equivalence_within_each_group():
    x = ar1(np.random.default_rng(4), (3, N), DT, 0.5) + 100
    x[2] += 50
    got = group_seeds(x, dt=DT, margin=0.05)
    assert got.groups == [(0, 1), (2,)]
    assert got.equivalence[0].margin == 0.05
    assert got.equivalence[0].location < 0.05
    assert got.equivalence[1].equivalent  # one seed is equivalent to itself
    assert group_seeds(x, dt=DT).equivalence == ()


def test_bad_input_is_named():
    x = cube_of(np.zeros((2, 200)))
    with pytest.raises(InputError, match="dims"):
        group_seeds(x.rename(case="run"))
    with pytest.raises(InputError, match="time coordinate"):
        group_seeds(x.drop_vars("time"))
    with pytest.raises(InputError, match="dt is needed"):
        group_seeds(np.zeros((2, 200)))


def test_holm_against_its_definition():
    assert holm([0.01, 0.04, 0.03]).tolist() == pytest.approx([0.03, 0.06, 0.06])
    assert holm([0.5, 0.9]).tolist() == [1.0, 1.0]
    assert holm([]).size == 0


def test_effective_size_of_exponentially_correlated_noise():
    """n_eff = T/(2 tau) = 100; 100 records have 400 degrees of freedom, 20 % is 2.8 sigma."""
    x = ar1(np.random.default_rng(1), (100, N), DT, 3.0)
    assert effective_size(x) == pytest.approx(100, rel=0.2)
    white = effective_size(np.random.default_rng(1).standard_normal((100, N)))
    assert white == pytest.approx(N, rel=0.2)
    assert effective_size(np.ones((1, 50))) == 50


def test_effective_size_of_few_records_is_right_on_average():
    """1000 means of six records scatter by 1 %; the reciprocal of chi-squared would add 9 %."""
    x = ar1(np.random.default_rng(3), (6000, 600), DT, 3 * DT)
    rho = np.exp(-1 / 3)
    due = 600 * (1 - rho) / (1 + rho)
    sizes = [effective_size(x[i : i + 6]) for i in range(0, 6000, 6)]
    assert np.mean(sizes) == pytest.approx(due, rel=0.04)


def test_equivalence_is_shown_only_where_the_data_can_show_it():
    rng = np.random.default_rng(2)
    fast, slow = ar1(rng, (4, N), DT, 0.1) + 20, ar1(rng, (4, N), DT, 20.0) + 20
    assert equivalence(fast, margin=0.1).equivalent
    assert not equivalence(slow, margin=0.1).equivalent
    fast[1] += 2.5
    assert not equivalence(fast, margin=0.1).equivalent
    assert equivalence(fast[:1], margin=0.1).equivalent
    with pytest.raises(InputError, match="margin = 0"):
        equivalence(fast, margin=0)


def test_equivalence_errs_in_at_most_five_percent_at_the_margin():
    """Two seeds whose means differ by exactly the margin; 300 cases, 99.9 % binomial bound."""
    rng = np.random.default_rng(12)
    wrong = 0
    for _ in range(300):
        x = ar1(rng, (2, 2000), DT, 1.0) + 100.0
        x[1] += 1.0
        wrong += equivalence(x, margin=0.01).location <= 0.01
    assert wrong <= binom.ppf(0.9995, 300, 0.05)


def test_number_of_seeds_gives_the_wanted_coverage():
    """With the number found, a 95 % interval of the wanted width covers: checked by its formula."""
    values = np.array([0.96, 1.02, 1.05, 0.94, 1.04, 0.99])
    got = seeds_needed(values, 0.05)
    from scipy.stats import t

    half = [t.ppf(0.975, n - 1) * got.scatter / np.sqrt(n) for n in (got.seeds - 1, got.seeds)]
    assert half[1] <= 0.05 < half[0]
    assert got.low <= got.seeds <= got.high
    assert got.uncertainty == pytest.approx(t.ppf(0.975, 5) * values.std(ddof=1) / np.sqrt(6))
    assert seeds_needed(np.ones(3), 0.01).seeds == 2


@pytest.mark.parametrize(
    ("values", "uncertainty", "message"),
    [
        ([1.0], 0.1, "at least 2"),
        ([1.0, -1.0], 0.1, "mean of values is 0"),
        ([1.0, 2.0], 0.0, "uncertainty = 0.0"),
        ([1.0, 2.0], 1e-6, "more than 100000"),
    ],
)
def test_impossible_numbers_of_seeds_are_named(values, uncertainty, message):
    with pytest.raises(InputError, match=message):
        seeds_needed(values, uncertainty)


def test_averaged_spectrum_of_white_noise_lies_in_its_band():
    """Density 2 σ² dt; 95 % bands at 4 x 249 independent frequencies: 3 % is 4 sigma."""
    x = np.random.default_rng(1).standard_normal(200_000)
    got = averaged_spectrum(x, dt=0.05, segment=50.0)
    covered = []
    for seed in range(4):
        series = np.random.default_rng(seed).standard_normal(200_000)
        band = averaged_spectrum(series, dt=0.05, segment=50.0)
        inside = (band.low <= 0.1) & (band.high >= 0.1)
        covered.append(np.mean(inside[2:-2:2]))  # Hann's neighbours are correlated
    assert np.mean(covered) == pytest.approx(0.95, abs=0.03)
    assert got.density.sum() * got.frequency[1] == pytest.approx(1.0, rel=0.02)
    assert np.all(got.low < got.density)
    for bad in (0.01, 1e9):
        with pytest.raises(InputError, match="segment"):
            averaged_spectrum(x, dt=0.05, segment=bad)
    with pytest.raises(InputError, match="confidence"):
        averaged_spectrum(x, dt=0.05, confidence=1.0)
