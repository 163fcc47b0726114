"""The error budget of a run: value, interval by seeds, error by models, and what governs."""

import numpy as np
import pytest
import xarray as xr

from loadflow.planning.budget import Answer, answers, more_seeds
from loadflow.scene.scene import make_scene

CASES = ["a_s1", "a_s2", "b_s1", "b_s2"]
SCENE = make_scene(
    {"name": "look", "results": ["journal.film", "rolling.life"], "accuracy": "given"}
    | {"rolling": {"arrangement": "tapered-pair"}}
)


def _over_cases(**columns):
    data = {name: (("bearing", "case"), np.array([values])) for name, values in columns.items()}
    coords = {
        "case": CASES, "bearing": ["N"], "dlc": ("case", ["1.1"] * 4),
        "wind_speed": ("case", [8.0, 8.0, 16.0, 16.0]), "weight": ("case", [0.3, 0.3, 0.2, 0.2]),
    }  # fmt: skip
    return xr.Dataset(data, coords)


TABLES = {
    "journal": _over_cases(
        smallest_film=[5e-5, 4e-5, 3e-5, 3.2e-5], mean_friction_power=[1e3, 1e3, 2e3, 2e3]
    ),
    "rolling": _over_cases(bearing_life=[100.0, 100.0, 10.0, 30.0]).assign(
        mean_speed=("case", [1.0, 1.0, 1.5, 1.5])
    ),
}


def _found(errors=None, effects=()):
    found = answers(SCENE, TABLES, errors or {}, effects)
    return {one.quantity: one for one in found}


def test_answers_are_those_of_the_whole_run():
    """The extreme, the mean over the lifetime, and revolutions over the sum of their damage."""
    found = _found()
    assert found["minimum film"].value == 3e-5
    assert found["friction power"].value == pytest.approx(0.6 * 1e3 + 0.4 * 2e3)
    turns, lives = np.array([0.3, 0.3, 0.3, 0.3]), np.array([100.0, 100.0, 10.0, 30.0])
    assert found["life"].value == pytest.approx(turns.sum() / (turns / lives).sum())


def test_load_cases_weigh_what_the_lifetime_of_the_run_gives_them():
    """Weights are of 1 within each design load case; one of extreme loads alone has no share."""
    share = xr.DataArray([0.9, 0.1, 0.0], {"case": CASES[:3]}, "case")
    found = answers(SCENE, TABLES | {"lifetime": xr.Dataset({"share": share})}, {}, ())
    values = {one.quantity: one.value for one in found}
    assert values["friction power"] == pytest.approx(1e3)
    assert values["life"] == pytest.approx(100.0)
    assert values["minimum film"] == 3e-5


def test_intervals_come_from_seeds_of_one_wind_speed_alone():
    found = _found()
    power, film = found["friction power"], found["minimum film"]
    assert power.low == power.value == power.high  # speeds differ, seeds do not
    assert (film.low, film.high) == (3e-5, 3.2e-5)
    # by hand: both seeds of 16 m/s the one, or both the other
    assert found["life"].low == pytest.approx(1.2 / (0.6 / 100 + 0.6 / 10))
    assert found["life"].high == pytest.approx(1.2 / (0.6 / 100 + 0.6 / 30))


def test_what_governs_is_the_larger_of_both_and_unknown_errors_are_said():
    errors = {"journal.film": {"minimum film": 0.03, "friction power": 0.03}}
    found = _found(errors | {"rolling.life": {"life": "not measured"}})
    assert found["minimum film"].governed_by == "seeds"
    assert found["friction power"].governed_by == "models"
    assert found["life"].governed_by == "models: not measured"
    said = more_seeds(found.values(), lambda result: 0.05)
    assert "minimum film (±6.7 %)" in said
    assert "friction" not in said
    assert more_seeds(found.values(), lambda result: 0.1) == ""


def test_one_seed_of_each_speed_has_no_interval():
    some = {name: table.isel(case=[0, 2]) for name, table in TABLES.items()}
    errors = {"journal.film": {"minimum film": 0.03}}
    [film, *_] = answers(SCENE, some, errors, ())
    assert np.isnan(film.low)
    assert film.governed_by == "seeds: one of each wind speed"


def test_what_is_left_out_is_named_with_its_share_of_the_answer():
    """An effect of the film counts as it is, one of the load with the gain of the answer."""
    own = SCENE.model_copy(
        update={"journal": SCENE.journal.model_copy(update={"motion": "quasi-static"})}
    )
    effects = [
        {"name": "motion of the film", "size": {"minimum film": 0.2}, "indicator": {}},
        {"name": "heat of the film", "size": None, "indicator": {"minimum film": 0.1}},
    ]
    film = next(one for one in answers(own, TABLES, {}, effects) if one.quantity == "minimum film")
    assert film.left_out == {"motion of the film": 0.2, "heat of the film": 0.1}
    assert isinstance(film, Answer)


def _statistics(seeds):
    """Statistics of one bearing: a force along z that scatters, one along y that swings."""
    low, high = np.zeros((2, 3, seeds)), np.zeros((2, 3, seeds))
    scatter = np.random.default_rng(1).gumbel(size=seeds)
    high[0, 2], low[0, 2] = 1e6 + 1e4 * scatter, -2e5
    swing = np.full((2, 3, seeds), 1e4)
    swing[0, 1] = 1e5 + np.arange(seeds)
    force = xr.DataArray(
        np.stack([low, high, swing]),
        {"statistic": ["min", "max", "del"], "bearing": ["N", "N2"], "axis": ["x", "y", "z"]},
        ["statistic", "bearing", "axis", "case"],
        attrs={"units": "N"},
    )
    coords = {
        "case": [f"s{k}" for k in range(seeds)], "dlc": ("case", ["1.1"] * seeds),
        "wind_speed": ("case", [12.0] * seeds), "length": ("case", [600.0] * seeds),
    }  # fmt: skip
    return xr.Dataset({"force": force}, coords), high[0, 2]


def test_loads_have_their_extreme_their_damage_and_their_50_year_level_with_intervals():
    table, peaks = _statistics(12)
    scene = SCENE.model_copy(update={"results": ["loads.statistics"]})
    errors = {"loads.statistics": {"bearing load max": 0.01, "bearing force DEL": 0.02}}
    every = answers(scene, {"statistics": table}, errors, ())
    found = {one.quantity: one for one in every if one.bearing == "N"}
    assert found["bearing load max"].value == peaks.max()
    swing = found["bearing force DEL, m = 4"]
    assert swing.value == pytest.approx(np.mean((1e5 + np.arange(12)) ** 4) ** 0.25)
    assert swing.low < swing.value < swing.high
    level = found["50-year load across the shaft"]
    assert peaks.max() < level.low < level.value < level.high
    drawn = 1e6 + 1e4 * np.log(50 * 365.25 * 24 * 6)  # of the law they are drawn from
    assert level.low < drawn < level.high
    assert level.value == pytest.approx(drawn, rel=0.01)
    assert (level.error, level.unit) == (0.01, "N")
    few = answers(scene, {"statistics": table.isel(case=[0, 1])}, errors, ())
    assert not [one for one in few if one.quantity.startswith("50-year")]  # no law of two seeds
    storm = table.isel(case=[0]).assign_coords(case=["storm"], wind_speed=("case", [25.0]))
    both = xr.concat([table, storm], "case", data_vars="minimal")
    lone = answers(scene, {"statistics": both}, errors, ())  # the storm may hold the largest load
    assert not [one for one in lone if one.quantity.startswith("50-year")]


def test_the_damage_is_that_of_the_component_that_does_more_over_the_lifetime():
    """In storms, which are hardly ever, the other component swings more."""
    swing = np.full((1, 3, 2), 1.0)
    swing[0, 1], swing[0, 2] = [1.0, 90.0], [20.0, 20.0]
    force = xr.DataArray(
        np.stack([0 * swing, 0 * swing, swing]),
        {"statistic": ["min", "max", "del"], "bearing": ["N"], "axis": ["x", "y", "z"]},
        ["statistic", "bearing", "axis", "case"],
        attrs={"units": "N"},
    )
    coords = {
        "case": ["calm", "storm"], "dlc": ("case", ["1.1"] * 2),
        "wind_speed": ("case", [12.0, 25.0]), "weight": ("case", [1.0 - 1e-6, 1e-6]),
    }  # fmt: skip
    scene = SCENE.model_copy(update={"results": ["loads.statistics"]})
    every = answers(scene, {"statistics": xr.Dataset({"force": force}, coords)}, {}, ())
    (damage,) = (one for one in every if one.quantity.startswith("bearing force DEL"))
    assert damage.value == pytest.approx(20.0, rel=1e-9)


def test_a_modified_life_has_not_the_error_of_the_basic_one():
    lives = {"bearing_life": 2e6, "bearing_modified_life": 3e6, "mean_speed": 1.2}
    coords = {"bearing": ["N"], "case": ["a", "b"], "dlc": ("case", ["1.1"] * 2),
              "wind_speed": ("case", [12.0, 12.0])}  # fmt: skip
    table = xr.Dataset(
        {name: (("bearing", "case"), [[value, value]]) for name, value in lives.items()}, coords
    )
    table = table.assign(mean_speed=("case", [1.2, 1.2]))
    scene = SCENE.model_copy(update={"results": ["rolling.life"]})
    every = answers(scene, {"rolling": table}, {"rolling.life": {"life": 0.28}}, ())
    found = {one.quantity: one for one in every}
    assert found["life"].error == 0.28
    assert found["modified life"].error is None
