"""Shares of the lifetime of several design load cases are shares of its time."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from loadflow.errors import InputError
from loadflow.scene.lifetime import Lifetime, check_counts
from loadflow.scene.lifetime_shares import YEAR, lifetime_shares, without_share
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.stages import wear
from loadflow.studies.bearing_series import BearingSeries
from loadflow.studies.lifetime.finished_run import case_shares, energy_per_year, run_lifetime
from loadflow.studies.lifetime.lifetimes import LifetimeOptions, lifetimes
from loadflow.studies.lifetime.page import exceedances, share_warnings
from loadflow.wind import Machine, conditions

NREL_5MW = Machine(cut_in=3.0, rated=11.4, cut_out=25.0, rotor_diameter=126.0, hub_height=90.0)


def below(v):
    """Share of time below v in class I: Rayleigh, annual mean 10 m/s."""
    return 1 - math.exp(-math.pi / 4 * (v / 10) ** 2)


RUNNING = below(25) - below(3)


def test_shares_computed_by_hand():
    """Production at 8 (two seeds) and 12 m/s, idling at 2, 12 and 28 m/s, a start, an extreme."""
    dlcs = ["1.2", "1.2", "1.2", "6.4", "6.4", "6.4", "3.1", "1.3"]
    speeds = [8.0, 8.0, 12.0, 2.0, 12.0, 28.0, 8.0, 12.0]
    lengths = [600.0] * 6 + [300.0, 600.0]
    got = lifetime_shares(dlcs, speeds, lengths, per_year={"3.1": 1000})
    start = 1000 * 300 / (365.25 * 86400)
    low = (below(10) - below(6)) / (below(14) - below(6))  # bins of 8 and 12 m/s: 6 … 10 … 14
    calm, storm = below(7), below(36) - below(20)  # bins of 2 and 28 m/s: 0 … 7, 20 … 36
    idle = (1 - RUNNING) / (calm + storm)
    rest = 1 - start
    expected = [
        rest * RUNNING * low / 2,
        rest * RUNNING * low / 2,
        rest * RUNNING * (1 - low),
        rest * idle * calm,
        0.0,
        rest * idle * storm,
        start,
        0.0,
    ]
    np.testing.assert_allclose(got, expected, rtol=1e-12)
    assert got.sum() == pytest.approx(1.0)
    assert without_share(dlcs, got) == ["1.3"]


def test_production_and_idling_are_weighted_as_the_conditions_of_the_wind_are():
    cases = conditions("1.2", NREL_5MW) + conditions("6.4", NREL_5MW)
    got = lifetime_shares(
        [c.dlc for c in cases], [c.wind_speed for c in cases], [c.duration for c in cases]
    )
    theirs = np.array([c.weight for c in cases])
    production = np.array([c.dlc == "1.2" for c in cases])
    np.testing.assert_allclose(got[production], theirs[production], rtol=1e-9)
    # what is below 1 and above 35 m/s goes to the speeds that are there
    scale = (1 - RUNNING) / theirs[~production].sum()
    assert 1 < scale < 1.15
    np.testing.assert_allclose(got[~production], scale * theirs[~production], rtol=1e-9)


def test_both_cases_of_normal_production_share_one_time():
    got = lifetime_shares(["1.1", "1.2", "1.2", "6.4"], [8.0, 8.0, 12.0, 30.0], [600.0] * 4)
    assert got[0] == pytest.approx(got[1])
    assert got[:3].sum() == pytest.approx(RUNNING)


def test_variants_of_production_and_idling_share_the_lifetime_as_their_load_cases_do():
    speeds, lengths = [8.0, 8.0, 12.0, 30.0, 12.0], [600.0] * 5
    got = lifetime_shares(["1.1a", "1.2", "1.2b", "6.4a", "1.3a"], speeds, lengths)
    np.testing.assert_allclose(
        got, lifetime_shares(["1.1", "1.2", "1.2", "6.4", "1.3"], speeds, lengths), rtol=1e-12
    )
    assert got[:3].sum() == pytest.approx(RUNNING)
    assert got[4] == 0


def test_a_single_load_case_takes_the_whole_lifetime():
    got = lifetime_shares(["3.1"] * 3, [4.0, 8.0, 8.0], [300.0] * 3)
    assert got.sum() == pytest.approx(1.0)
    assert got[1] == got[2]


def test_nothing_but_counted_events_takes_their_time_alone():
    got = lifetime_shares(["3.1", "4.1"], [8.0, 8.0], [300.0] * 2, per_year={"3.1": 10, "4.1": 20})
    np.testing.assert_allclose(got, np.array([10, 20]) * 300 / YEAR)


@pytest.mark.parametrize(
    ("dlcs", "per_year", "says"),
    [
        (["1.4", "1.5"], {}, "1.4, 1.5 has a share"),
        (["1.2", "3.1"], {"4.1": 10}, "'4.1'"),
        (["1.2", "3.1a"], {"3.1": 10, "3.1a": 1}, r"nothing takes the number of 3\.1, "),
        (["1.2", "3.1"], {"3.1": -1}, "3.1 = -1"),
        (["1.2", "3.1"], {"3.1": math.nan}, "3.1 = nan"),
        (["1.2", "3.1"], {"3.1": 1e6}, "take 9.51 years"),
    ],
)
def test_what_cannot_be_is_an_error(dlcs, per_year, says):
    with pytest.raises(InputError, match=says):
        lifetime_shares(dlcs, [8.0, 8.0], [300.0, 300.0], per_year=per_year)


def series(dlc, wind_speed, swing, weight):
    time = 0.5 * np.arange(1201)
    noise = np.random.default_rng(1).normal(size=time.size)
    wave = swing * (np.sin(2 * np.pi * 0.2 * time) + 0.1 * noise)
    force = np.stack([np.zeros_like(time), np.zeros_like(time), -1e6 + wave], axis=1)
    labels = {"dlc": dlc, "wind_speed": wind_speed, "seed": 1, "weight": weight}
    speed = np.full_like(time, 1.2)
    return BearingSeries(f"{dlc} {wind_speed}", "N", labels, time, speed, force, 0 * force)


def test_an_event_without_a_number_does_no_damage_and_is_named():
    parts = [series("1.2", 8.0, 1e5, 0.5), series("3.1", 8.0, 9e5, 0.5)]
    alone, both = (
        next(iter(lifetimes(chosen, LifetimeOptions(block=10.0)))) for chosen in (parts[:1], parts)
    )
    assert both.shares.tolist() == [1.0, 0.0]
    np.testing.assert_allclose(both.lifetime_equivalent, alone.lifetime_equivalent)
    assert both.left_out == ("3.1",)
    assert "3.1" in share_warnings([both])[0]
    assert share_warnings([alone]) == []
    assert both.tails == alone.tails


def test_starts_leave_the_tail_of_production_in_the_same_wind_as_it_is():
    parts = [series("1.2", 8.0, 1e5, 1.0), series("3.1", 8.0, 3e5, 1.0)]
    start = parts[1]
    short = replace(start, **{key: getattr(start, key)[:100] for key in ("time", "speed", "force")})
    options = LifetimeOptions(block=10.0, per_year={"3.1": 1000.0})
    alone = next(iter(lifetimes(parts[:1], LifetimeOptions(block=10.0))))
    for events, names in ((short, ["8"]), (start, ["1.2, 8", "3.1, 8"])):
        both = next(iter(lifetimes([parts[0], events], options)))
        assert both.tails["1.2", 8.0] == alone.tails["1.2", 8.0]
        assert both.tail_names == names
        np.testing.assert_allclose(both.tail_shares, both.shares[: len(names)], rtol=1e-12)
        drawn = exceedances(both, options)
        np.testing.assert_allclose(
            drawn["rate"][0],
            both.shares[0] * alone.tails["1.2", 8.0].rate_above(drawn["level"]) * YEAR,
        )


@pytest.mark.parametrize("tail", ["maxima", "peaks"])
def test_a_short_seed_takes_no_data_from_the_tail_of_the_long_ones(tail):
    """600 s have 60 blocks; 5 s have none, and 55 s have 5."""
    options = LifetimeOptions(block=10.0, tail=tail)
    long = series("1.2", 8.0, 1e5, 1.0)
    alone = next(iter(lifetimes([long], options))).tails["1.2", 8.0]
    for steps, more in ((10, 0), (110, 5)):
        cut = {key: getattr(long, key)[:steps] for key in ("time", "speed", "force", "moment")}
        both = next(iter(lifetimes([long, replace(long, case="short", **cut)], options)))
        found = both.tails["1.2", 8.0]
        assert found.count >= alone.count + (more if tail == "maxima" else 0)
        assert found.threshold == pytest.approx(alone.threshold, rel=0.01)


def test_counted_events_and_given_weights_do_damage():
    parts = [series("1.2", 8.0, 1e5, 0.5), series("3.1", 8.0, 9e5, 0.5)]
    counted = next(iter(lifetimes(parts, LifetimeOptions(per_year={"3.1": 1000.0}))))
    assert counted.shares[1] == pytest.approx(1000 * 600.5 / YEAR)
    given = next(iter(lifetimes(parts, LifetimeOptions(weights="given"))))
    assert given.shares.tolist() == [0.5, 0.5]
    assert given.lifetime_equivalent[0, 0] > counted.lifetime_equivalent[0, 0] > 2e5
    with pytest.raises(InputError, match="given"):
        LifetimeOptions(weights="given", per_year={"3.1": 1.0})


def test_given_weights_are_taken_as_they_are_but_not_without_a_word():
    per_case = [series("1.2", 8.0, 1e5, 1.0), series("6.4", 28.0, 1e5, 1.0)]
    (life,) = lifetimes(per_case, LifetimeOptions(weights="given"))
    assert life.shares.tolist() == [1.0, 1.0]
    assert "sum to 2 lifetimes" in share_warnings([life])[0]
    with pytest.raises(InputError, match="share of 0"):
        list(lifetimes([series("1.2", 8.0, 1e5, 0.0)], LifetimeOptions(weights="given")))


def rolling_table(dlcs, lengths, power=0.0):
    """Summary of bearings with equal damage per hour in all cases."""
    count = len(dlcs)
    ones, speed = np.ones((1, count)), np.full(count, 1.2)
    each = ("bearing", "case")
    return xr.Dataset(
        {
            "bearing_life": (each, 1e3 * ones), "bearing_modified_life": (each, 2e3 * ones),
            "mean_speed": ("case", speed), "mean_friction_power": (each, power * ones),
        },
        {
            "bearing": ["M"], "case": [f"c{k}" for k in range(count)], "dlc": ("case", dlcs),
            "wind_speed": ("case", np.full(count, 10.0)), "length": ("case", lengths),
            "weight": ("case", np.ones(count)),
        },
        {"weibull_slope": 1.5},
    )  # fmt: skip


def events_scene(**lifetime):
    return make_scene({"name": "e", "loads": {"dlc": ["1.2", "3.1"]}, "lifetime": lifetime})


def test_events_of_a_scene_take_their_time_damage_and_energy():
    table = rolling_table(["1.2", "3.1"], [600.0, 300.0], power=2e3)
    table["bearing_life"][:, 1] = 10.0  # a start hurts as a hundred times its length
    without, counted = events_scene(), events_scene(per_year={"3.1": 2000})
    start = 2000 * 300 / YEAR
    np.testing.assert_allclose(case_shares(without, table), [1.0, 0.0])
    np.testing.assert_allclose(case_shares(counted, table), [1 - start, start])
    lives = [
        float(run_lifetime(one, {"rolling": table})["life_hours"][0]) for one in (without, counted)
    ]
    assert lives[0] / lives[1] == pytest.approx(1 + 99 * start)
    energies = [
        float(energy_per_year(one, table, table["mean_friction_power"], case_shares(one, table))[0])
        for one in (without, counted)
    ]
    year = 8766 * 3600 * 2e3
    assert energies[0] == pytest.approx(year * RUNNING)
    assert energies[1] == pytest.approx(year * (RUNNING * (1 - start) + start))
    table["dlc"] = "case", ["1.2a", "3.1"]
    share, power = case_shares(without, table), table["mean_friction_power"]
    assert float(energy_per_year(without, table, power, share)[0]) == energies[0]


def test_events_that_are_not_there_or_take_more_than_a_year_are_refused():
    with pytest.raises(InputError, match=r"lifetime\.per_year: no load case '4\.1'"):
        events_scene(per_year={"4.1": 10})
    table = rolling_table(["1.2", "3.1"], [600.0, 300.0])
    with pytest.raises(InputError, match="years of each year"):
        case_shares(events_scene(per_year={"3.1": 2e5}), table)


def test_wear_takes_the_events_of_the_lifetime_where_it_has_no_count_of_its_own():
    scene = events_scene(per_year={"3.1": 500}, years=25.0)
    counts = wear.counts_of(scene, ["1.2", "3.1", "4.1"])
    assert counts == {"3.1": 12_500.0, "4.1": scene.wear.events}  # production has none
    own = make_scene(
        {"name": "w", "loads": {"dlc": ["1.2", "3.1"]}, "wear": {"counts": {"3.1": 7}},
         "lifetime": {"per_year": {"3.1": 500}}}
    )  # fmt: skip
    assert wear.counts_of(own, ["1.2", "3.1"]) == {"3.1": 7.0}
    variants = wear.counts_of(own, ["3.1a", "3.1b", "startup"])
    assert variants == {"3.1a": 3.5, "3.1b": 3.5, "startup": own.wear.events}


def test_variants_of_a_load_case_share_its_number_and_have_a_share_of_the_lifetime():
    dlcs, lengths = ["1.2", "3.1a", "3.1b"], [600.0, 300.0, 300.0]
    both = lifetime_shares(dlcs, [8.0] * 3, lengths, per_year={"3.1": 1000})
    assert both[1:] == pytest.approx([500 * 300 / YEAR] * 2)
    own = lifetime_shares(dlcs, [8.0] * 3, lengths, per_year={"3.1": 1000, "3.1b": 10})
    assert own[1:] == pytest.approx([1000 * 300 / YEAR, 10 * 300 / YEAR])
    words = lifetime_shares(["1.2", "startup"], [8.0] * 2, lengths[:2], per_year={"start": 7})
    assert words[1] == pytest.approx(7 * 300 / YEAR)
    table = rolling_table(["1.2", "3.1a"], [600.0, 300.0])
    share = case_shares(events_scene(per_year={"3.1": 1000}), table)
    assert share[1] == pytest.approx(1000 * 300 / YEAR)


def test_a_number_of_a_load_case_that_is_not_there_says_which_is_meant():
    with pytest.raises(InputError, match=r"per_year: no load case '3\.l'; did you mean 3\.1"):
        events_scene(per_year={"3.l": 10})
    with pytest.raises(InputError, match=r"wear\.counts: no load case '4\.1'"):
        make_scene({"name": "w", "loads": {"dlc": ["1.2", "3.1"]}, "wear": {"counts": {"4.1": 7}}})


def test_a_number_whose_variants_all_have_their_own_is_refused():
    own, there = {"3.1": 10.0, "3.1a": 1.0}, ["1.2", "3.1a"]
    for lifetime, counts in ((Lifetime(per_year=own), {}), (Lifetime(), own)):
        with pytest.raises(InputError, match=r"nothing takes the number of 3\.1, .*leave it out"):
            check_counts(lifetime, counts, there, "rayleigh")
        check_counts(lifetime, counts, [*there, "3.1b"], "rayleigh")  # which takes it


def test_a_scene_is_told_which_numbers_of_events_no_wear_takes():
    base = {
        "name": "w", "results": ["journal.wear"], "loads": {"dlc": ["1.2", "3.1", "4.1"]},
        "shaft": {"two_point": {}}, "journal": {"contact": {"asperities": {
            "roughness": 2e-6, "contact_modulus": 1e11, "factor": 1e-3}}},
    }  # fmt: skip

    def said(per_year=None, motion="transient", **keys):
        wear = {"law": {"coefficient": 1e-17}} | keys
        lifetime = {"per_year": per_year or {}, "years": 25.0}
        journal = base["journal"] | {"motion": motion}
        more = {"wear": wear, "lifetime": lifetime, "journal": journal, "accuracy": "given"}
        return unused_keys(make_scene(base | more))

    assert "wear.events" not in said({"3.1": 5}, events=7)
    assert "wear.events" not in said({"3.1": 5, "4.1": 5})  # as it is by default
    told = said({"3.1": 5, "4.1": 5}, events=7)
    assert told["wear.events"].startswith("3.1, 4.1, all that wears")
    told = said({"3.1": 5}, counts={"4.1": 5}, events=7)
    assert told["wear.events"].endswith("wear.counts and lifetime.per_year")
    assert "lifetime.years" not in told
    assert "wear.counts" not in told
    assert "no load case 1.2" in said(counts={"1.2": 5})["wear.counts"]
    assert "lifetime.years" not in said({"1.2": 5})  # production wears, too
    assert "lifetime.years" in said({"1.2": 5}, motion="quasi-static")  # but not films at rest
