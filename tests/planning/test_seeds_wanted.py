"""Seeds that an accuracy takes: by the scatter of a run, or of the main job before one."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from loadflow.planning.plan import make_plan
from loadflow.planning.seeds_wanted import enough_seeds, of_run, seeds_wanted, sentences
from loadflow.scene.scene import make_scene
from loadflow.studies.seeds.scatter import scatter_of_one_seed

SEEDS, SPEEDS = 400, (8.0, 12.0)
SCENE = make_scene(
    {"name": "look", "results": ["journal.film", "loads.statistics"],
     "journal": {"self_aligning": True},  # else the tilt that is left out governs the film
     "loads": {"wind_speeds": list(SPEEDS), "seeds": 4, "duration": 600.0}}
)  # fmt: skip


def _tables(seeds=SEEDS):
    rng = np.random.default_rng(1)
    count = seeds * len(SPEEDS)
    speed = np.repeat(SPEEDS, seeds)
    coords = {
        "case": [f"c{k}" for k in range(count)], "bearing": ["N"], "dlc": ("case", ["1.1"] * count),
        "wind_speed": ("case", speed), "length": ("case", np.full(count, 600.0)),
    }  # fmt: skip
    level = np.where(speed == 8.0, 0.5, 1.0)
    ratio = level * (1.0 + 0.03 * rng.standard_normal(count))
    equivalent = level * (1.0 + 0.1 * rng.standard_normal(count))
    largest = level * (10.0 + rng.gumbel(size=count))
    force = np.zeros((1, 3, 3, count))
    force[0, 1] = np.stack([equivalent, -0.1 * largest, largest])
    dims = ("bearing", "axis", "statistic", "case")
    more = {"axis": ["x", "y", "z"], "statistic": ["del", "min", "max"]}
    return {
        "journal": xr.Dataset(
            {"largest_eccentricity_ratio": (("bearing", "case"), ratio[None])}, coords
        ),
        "statistics": xr.Dataset({"force": (dims, force)}, coords | more),
    }


def test_scatter_of_one_seed_is_that_of_the_law_the_seeds_were_drawn_from():
    found = scatter_of_one_seed(_tables(), None)
    # of both wind speeds the same share; their levels count in the governing one alone
    pooled = 0.03 * np.sqrt((0.5**2 + 1.0**2) / 2)
    assert found["largest eccentricity ratio"] == pytest.approx(1.96 * pooled, rel=0.1)
    # lifetime load (Σ p S⁴)^¼ with S = s (1 + 0.1 z): by moments of z, both wind speeds apart
    moment = 1 + 6 * 0.01 + 3 * 1e-4
    square = 1 + 28 * 0.01 + 210 * 1e-4 + 420 * 1e-6 + 105 * 1e-8
    spread = np.sqrt((square - moment**2) * (1.0 + 0.5**8)) / (moment * (1.0 + 0.5**4))
    assert found["damage-equivalent load"] == pytest.approx(1.96 * spread / 4, rel=0.15)
    assert 0.1 < found["50-year load"] < 2.0


def test_a_run_is_told_by_its_own_seeds_and_they_halve_the_interval_four_at_a_time():
    many, few = (of_run(SCENE, _tables(n), {}) for n in (400, 100))
    ratio = [next(o for o in found if "ratio" in o.answer) for found in (many, few)]
    assert all(one.measured for one in ratio)
    assert ratio[1].interval == pytest.approx(2 * ratio[0].interval, rel=0.15)
    one = ratio[0]
    needed = (one.interval * np.sqrt(400) / 0.05) ** 2
    assert one.seeds == max(1, np.ceil(needed))
    said = enough_seeds([replace(one, seeds=7, wanted=0.05)])
    assert said == "seeds of each wind speed that would do: largest eccentricity ratio 7 for ±5 %"
    assert enough_seeds([]) == ""


def test_a_plan_without_a_run_takes_the_main_job_and_says_what_seeds_would_buy():
    found = seeds_wanted(make_plan(SCENE))
    assert [one.answer for one in found] == [
        "largest eccentricity ratio", "smallest film", "damage-equivalent load", "50-year load",
    ]  # fmt: skip
    assert not any(one.measured for one in found)
    film = found[1]
    assert film.seeds == np.ceil((film.interval * np.sqrt(4) / 0.05) ** 2)
    assert film.seconds is not None
    assert film.seconds > 0
    said = sentences(found)
    assert "smallest film" in said[1]
    assert "50-year load" in said[1]
    fewer = seeds_wanted(make_plan(SCENE), wanted=0.5)
    assert fewer[1].seeds == 1


def test_variants_have_the_wind_of_their_load_case():
    def variant(dlc):
        plan = make_plan(SCENE)
        return replace(plan, cases=tuple(replace(case, dlc=dlc) for case in plan.cases))

    assert seeds_wanted(variant("1.5a")) == seeds_wanted(variant("1.5")) == []
    assert seeds_wanted(variant("1.2a")) == seeds_wanted(variant("1.2")) != []


def test_cases_without_turbulence_have_nothing_to_say():
    gust = make_scene({"name": "gust", "loads": {"dlc": "1.5"}, "results": ["loads.statistics"]})
    assert seeds_wanted(make_plan(gust)) == []
    assert sentences([]) == []
