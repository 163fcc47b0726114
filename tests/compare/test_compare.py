"""Candidates on the same loads: numbers, intervals, margins, page."""

import csv
import doctest
import importlib
import json
import math
import re
import shutil
import subprocess
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from browser import BROWSER, looked_at, on_paper
from synthetic import cube_file

from loadflow.cli import main
from loadflow.cube import open_cube
from loadflow.errors import InputError
from loadflow.planning.accuracy import errors_beside, expected_errors
from loadflow.planning.effects import EffectVerdict, Estimates
from loadflow.planning.ladder import ladder
from loadflow.planning.plan import make_plan
from loadflow.quantities import percent, three_digits
from loadflow.report.compare_page import _row, short, write_comparison
from loadflow.report.moments import Moment, moment_chart
from loadflow.report.sketch import sketch
from loadflow.rolling import system_life
from loadflow.running import kept_numbers
from loadflow.running.candidates import candidate_scene, candidates_for
from loadflow.running.comparison import (
    SHARED,
    Means,
    _as_run,
    _base,
    compare,
    shared_loads,
)
from loadflow.scene.candidate import Candidate
from loadflow.scene.candidates import candidates_of
from loadflow.scene.scene import make_scene, read_scene
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.films.turning import SLOWEST
from loadflow.stages.wear import counts_of
from loadflow.storage import plain
from loadflow.studies.candidate import risks as candidate_risks
from loadflow.studies.candidate.friction import TORQUES, error_together, rolling_losses
from loadflow.studies.candidate.margins import damage_per_hour, margin_of
from loadflow.studies.candidate.numbers import Finished, extreme, of_one_seed, without_shares
from loadflow.studies.candidate.pads import clearance_used
from loadflow.studies.candidate.quantities import QUANTITIES, named_quantities
from loadflow.studies.candidate.result import (
    THRUST,
    UNCARRIED,
    Comparison,
    Judged,
    Number,
    missing,
)
from loadflow.studies.candidate.risks import (
    events,
    mostly_exceeded,
    rolling_risks,
    spread_over,
    wear,
)
from loadflow.studies.candidate.seeds import of_life
from loadflow.studies.candidate.supply import leaving, supply_power
from loadflow.studies.compare.comparison import _oil, in_wide_bore, judged
from loadflow.studies.compare.words import conclusion, drawn, facts, reservations
from loadflow.studies.lifetime.finished_run import NO_SHARE
from loadflow.studies.seeds.intervals import Groups, interval, joint_life
from loadflow.studies.verdicts.verdicts import AT_NO_RATIO
from loadflow.verdict import Verdict


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return cube_file(tmp_path_factory.mktemp("cube") / "loads.h5", steps=200)


def scene_of(cube, **more):
    data = {
        "name": "side_by_side",
        "loads": {"files": [str(cube)]},
        "shaft": {"two_point": {}, "moment": {}},
        "candidates": {
            "journal-cylindrical": {}, "two-spherical": {}, "double-row-tapered": {},
        },
    }  # fmt: skip
    return make_scene(data | more)


@pytest.fixture(scope="module")
def found(cube, tmp_path_factory):
    return compare(scene_of(cube), out=tmp_path_factory.mktemp("runs"))


def by_name(found):
    return {one.name: one for one in found.comparison.candidates}


def test_every_candidate_is_answered_on_the_same_loads(found):
    assert found.failures == {}
    assert set(by_name(found)) == {"journal-cylindrical", "two-spherical", "double-row-tapered"}
    loads = {
        tuple(path.stat().st_size for path in sorted((found.path / one.folder / "loads").iterdir()))
        for one in found.comparison.candidates
    }
    assert len(loads) == 1


def test_numbers_are_finite_where_they_are_asked(found):
    for one in found.comparison.candidates:
        for key in ("load_factor", "friction", "energy"):
            assert math.isfinite(one.numbers[key].value), (one.name, key)
        assert set(one.numbers) <= set(QUANTITIES)
    film = by_name(found)["journal-cylindrical"].numbers["minimum_film"]
    assert film.low <= film.value <= film.high
    assert film.value > film.limit
    assert film.case.startswith("dlc1.1")


@pytest.mark.slow
def test_our_friction_torque_stands_beside_that_of_catalogues(cube, tmp_path, found):
    sized = candidates_of("nrel-5mw")["two-spherical"]
    first = sized["N"]
    bare = {key: value for key, value in first.items() if key != "catalogue"}  # rings as well
    both = compare(
        scene_of(cube, candidates={
            "one": {"N": first, "N2": bare},
            "two": {"N": first, "N2": sized["N2"]},
        }),
        out=tmp_path,
    )  # fmt: skip
    one, two = (by_name(both)[name].numbers for name in ("one", "two"))
    torques = ("friction_torque", "palmgren_torque", "skf_torque", "constant_coefficient_torque")
    assert all(two[name].value > 0 and two[name].unit == "N m" for name in torques)
    assert math.isnan(one["skf_torque"].value)
    assert one["skf_torque"].note == "n/a: no constants of these bearings"
    assert one["friction_torque"].value == pytest.approx(two["friction_torque"].value, rel=1e-9)
    lost = two["friction"].value * 1e3 / two["friction_torque"].value
    assert 0.5 < lost < 1.3  # rad/s, the speeds of the loads
    assert "after SKF, with its constants" in (both.path / "compare.html").read_text("utf-8")
    film = by_name(found)["journal-cylindrical"].numbers["palmgren_torque"]
    assert film.note == "n/a: no rolling elements"


def test_losses_of_collars_have_the_error_of_their_films():
    errors = {"journal.film": 0.02, "thrust.film": 0.1}
    assert error_together({"journal.film": 3e3, "thrust.film": 1e3}, errors) == pytest.approx(0.04)
    assert error_together({"journal.film": 3e3, "thrust.film": 0.0}, errors) == 0.02
    unknown = errors | {"thrust.film": math.nan}
    assert math.isnan(error_together({"journal.film": 3e3, "thrust.film": 1e3}, unknown))
    assert error_together({"journal.film": 3e3}, errors) == 0.02


def test_every_number_has_its_interval_error_and_band_or_says_why_not(found):
    for one in found.comparison.as_dict()["candidates"]:
        for key, number in one["numbers"].items():
            if number["value"] is None:
                assert number["missing"] == {}, (one["name"], key)
                continue
            known = {
                what
                for what, end in (
                    ("seeds", "low"), ("models", "error"), ("tolerances", "tolerance_low"),
                )
                if number[end] is not None
            }  # fmt: skip
            assert known | {*number["missing"]} == {"seeds", "models", "tolerances"}
            assert known & {*number["missing"]} == set()
            assert all(number["missing"].values())
    spherical = by_name(found)["two-spherical"].numbers
    for key in ("friction", "energy", "friction_torque", "skf_torque", "film_parameter", "tilt",
                "minimum_load", "row_share", "row_overload", "viscosity_ratio"):  # fmt: skip
        # κ follows the viscosity at a temperature that is assumed where no cooling is stated
        most = 1.0 if key == "viscosity_ratio" else 0.5
        assert 0 <= spherical[key].error < most, key
    for key in ("friction_torque", "palmgren_torque", "skf_torque"):
        assert spherical[key].tolerance_low < spherical[key].value < spherical[key].tolerance_high
    journal = by_name(found)["journal-cylindrical"].numbers
    assert 0 <= journal["oil_flow"].error == journal["pump"].error < 0.1
    page = found.page.read_text(encoding="utf-8")
    beside = re.findall(r"<i>(?:seeds|models|tol\.)</i> – <a href=\"#(why-\d+)\" title=", page)
    instead = [f"why-{k}" for k in re.findall(r"<td class=\" soft\">n/a <sup>(\d+)</sup>", page)]
    assert instead
    assert len(instead) == len(re.findall(r">n/a", page))
    asked = beside + instead
    told = re.findall(r"<li id=\"(why-\d+)\">[^<]+</li>", page)
    assert {*asked} == {*told}
    assert len(told) == len({*told}) < len(asked)  # each reason once


def test_rolling_bearings_are_asked_for_as_much_accuracy_as_where_nothing_is_said(cube):
    loose = {"journal.film": 0.2, "rolling.loads": 0.25, "rolling.life": 0.01}
    scene = scene_of(cube, accuracy=loose)
    tapered, journal = (
        candidate_scene(scene, name, scene.candidates[name], 200)
        for name in ("double-row-tapered", "journal-cylindrical")
    )
    assert tapered.allowed("rolling.loads") == 0.05
    assert tapered.allowed("rolling.life") == 0.01
    assert journal.allowed("journal.film") == 0.2
    given = scene_of(cube, accuracy="given")
    one = candidate_scene(given, "two-spherical", given.candidates["two-spherical"], 200)
    assert one.accuracy == "given"


def test_no_effect_of_the_shared_loads_is_open_to_the_plan_of_a_candidate(tmp_path):
    """Not even one that is left out by saying nothing, as dynamic stall is."""
    loads = {"wind_speeds": [12.0], "seeds": 1}
    words = {"results": ["loads.statistics"], "accuracy": 0.2}
    scene = make_scene({"name": "shared", "loads": loads} | words)
    shared = _base(scene)
    (tmp_path / "manifest.json").write_text(json.dumps({"wanted": shared.digest()}))
    (tmp_path / "scene.toml").write_text(make_plan(shared).scene.to_toml())
    ran = _as_run(shared, scene, tmp_path)
    assert ran.loads.dynamic_stall is None
    rotor = [one for one in EFFECTS if one.model == "loads"]
    assert rotor
    assert not [one.name for one in rotor if one.is_open(ran)]


def test_what_no_ladder_knows_says_so_and_what_is_0_has_no_share():
    plain_zero = Number(0.0, "h", low=0.0, high=0.0)
    assert missing("mixed_time", plain_zero)["tolerances"].startswith("it is 0")
    assert missing("mixed_time", plain_zero)["models"].startswith("it is 0")
    assert "slowest speed" in missing("viscosity_ratio", replace(plain_zero, value=2.0))["models"]
    whole = Number(100.0, "%", low=100.0, high=100.0, error=0.01)
    assert missing("row_share", whole) == {"tolerances": "it is whole"}
    assert {*missing("friction", Number(1.0))} == {"seeds", "models", "tolerances"}
    assert missing("friction", Number(math.nan)) == {}


def test_films_of_cones_have_the_error_of_their_grid():
    sized = {"results": ["thrust.film"], "bearings": ["conical-pair"]}
    pair = make_scene({"name": "cones"} | sized)
    errors = expected_errors(pair)["thrust.film"]
    known = ladder()["thrust"]["pair of cones, 20x10"]["errors"]
    for name, error in errors.items():
        assert error > known[name]["max"] > 0
    fine = {place: one.model_copy(update={"grid": (40, 20)})
            for place, one in pair.thrust.bearings.items()}  # fmt: skip
    finer = pair.model_copy(update={"thrust": pair.thrust.model_copy(update={"bearings": fine})})
    assert expected_errors(finer)["thrust.film"]["minimum film"] < errors["minimum film"]


def test_the_margin_with_the_seeds_as_they_are_lies_in_its_interval(found):
    for one in found.comparison.candidates:
        factor = one.numbers["load_factor"]
        assert factor.low <= factor.value * (1 + 1e-9)
        assert factor.value <= factor.high * (1 + 1e-9)
        assert factor.high > factor.low, one.name


def test_the_load_factor_of_a_film_is_where_its_limit_is(found):
    """Solved again with the loads times the factor, the verdict that governs is at its limit."""
    one = by_name(found)["journal-cylindrical"]
    factor = one.numbers["load_factor"]
    assert factor.holds == one.holds
    assert factor.place in ("N", "N2")
    assert one.governs.endswith(factor.place)


def _of_the_journal(found):
    folder = found.path / by_name(found)["journal-cylindrical"].folder
    result = open_cube(folder / "result.h5")
    return read_scene(folder / "scene.toml"), folder, result["journal"].to_dataset().load()


def _one_more(table, dlc, **values):
    """The films of a run and those of one case more, like its first."""
    like = table.isel(case=[0])
    more = like.assign({name: xr.full_like(like[name], value) for name, value in values.items()})
    more = more.assign_coords(case=[f"dlc{dlc}_more"], dlc=("case", [dlc]))
    return xr.concat([table, more], "case")


def test_a_start_stands_in_contact_and_is_no_margin_of_films_and_production_in_contact_is_0(found):
    scene, folder, table = _of_the_journal(found)
    alone = margin_of(scene, folder, {"journal": table}, [])
    touching = {"in_contact": 50, "smallest_film": 1e-7, "largest_pressure": np.nan}
    start = margin_of(scene, folder, {"journal": _one_more(table, "3.1", **touching)}, [])
    assert (start.factor, start.case, start.governs) == (alone.factor, alone.case, alone.governs)
    rubs = margin_of(scene, folder, {"journal": _one_more(table, "1.3", **touching)}, [])
    assert (rubs.factor, rubs.case) == (0.0, "dlc1.3_more")


def test_what_a_standing_shaft_weighs_on_its_bearings_is_a_margin_in_proportion(found):
    scene, folder, table = _of_the_journal(found)
    bores = {place: scene.journal.at(place).geometry for place in ("N", "N2")}
    areas = {place: bore.width * bore.diameter for place, bore in bores.items()}
    place = min(areas, key=lambda one: areas[one])
    nearer = 0.9 * margin_of(scene, folder, {"journal": table}, []).factor
    heavy = 7e6 / nearer * areas[place]  # 7 MPa: limit of the material
    times = {"standing_load": heavy, "standing_load_time": 3.0, "largest_pressure": np.nan}
    margin = margin_of(scene, folder, {"journal": _one_more(table, "6.1", **times)}, [])
    assert margin.factor == pytest.approx(nearer)
    assert (margin.case, margin.time) == ("dlc6.1_more", 3.0)
    assert margin.governs == f"specific load at standstill in {place}"


def test_a_smallest_film_is_that_of_a_shaft_that_runs_and_says_what_it_leaves_out(found):
    scene, folder, table = _of_the_journal(found)
    start = _one_more(table, "3.1", smallest_film=1e-7, largest_eccentricity_ratio=0.999)

    def film(films):
        run = Finished("a", "", "", scene, {"journal": films}, {}, folder)
        at = Groups.of(films), "smallest_film", "least", 1e6, "µm", "minimum film"
        return extreme(run, films, *at, running=True)

    assert film(start).value == film(table).value > 1.0
    assert film(table).note == ""
    assert film(start).note == "1 load case that starts, stops or stands not counted"
    alone = film(start.isel(case=[-1]))
    assert math.isnan(alone.value)
    assert alone.note.startswith("n/a: all load cases of this run start")


def test_a_margin_of_a_life_names_the_load_case_that_takes_most_of_it(found):
    folder = found.path / by_name(found)["double-row-tapered"].folder
    result, scene = open_cube(folder / "result.h5"), read_scene(folder / "scene.toml")
    tables = {group: result[group].to_dataset() for group in ("rolling", "lifetime")}
    lived = Verdict("rolling M", "rating life L10h", 1e6, 175320.0, "at least")
    margin = margin_of(scene, folder, tables, [lived])
    damage = damage_per_hour(tables["rolling"].sel(bearing="M"), "")
    share = tables["lifetime"]["share"].reindex(case=damage["case"])
    assert margin.case == str((damage * share).idxmax("case").values)
    assert margin.governs.startswith("rating life of M (")


def test_the_margin_of_lives_is_that_of_all_bearings_as_a_system(found):
    folder = found.path / by_name(found)["two-spherical"].folder
    result, scene = open_cube(folder / "result.h5"), read_scene(folder / "scene.toml")
    tables = {group: result[group].to_dataset() for group in ("rolling", "lifetime")}
    limit, lives, what = 175320.0, {"N": 1e6, "N2": 2e6}, "rating life L10h"
    own = [Verdict(f"rolling {at}", what, life, limit, "at least") for at, life in lives.items()]
    both = float(system_life([*lives.values()]))
    joint = Verdict("rolling, all as a system", what, both, limit, "at least")
    alone = margin_of(scene, folder, tables, own)
    margin = margin_of(scene, folder, tables, [*own, joint])
    assert alone.factor == pytest.approx((1e6 / limit) ** 0.3)
    assert margin.factor == pytest.approx((both / limit) ** 0.3, rel=2e-3)  # as it is sought
    assert margin.governs.startswith("rating life of all bearings, most of ")
    assert margin.low <= margin.factor <= margin.high


def test_seeds_of_a_margin_of_all_bearings_follow_their_life_as_a_system():
    damage = np.array([[1e-6, 4e-6], [3e-6, 1e-6]])
    over = xr.DataArray(damage, dims=("case", "bearing"))
    first, both = (float(system_life(1 / own, 1.5)) for own in (damage[0], damage.mean(axis=0)))
    for found in (over, over.transpose()):
        drawn = of_life(found, np.array([0.5, 0.5]), 2.0, 3.0, 1.5)
        assert drawn(np.array([0, 0])) == pytest.approx(2.0 * (first / both) ** (1 / 3))


def test_rolling_bearings_have_skidding_films_and_standstill_journal_bearings_a_reason(found):
    rolling = by_name(found)["two-spherical"].numbers
    assert rolling["minimum_load"].limit == 2.0
    assert rolling["minimum_load"].holds == (rolling["minimum_load"].value >= 2.0)
    assert rolling["minimum_load"].case
    assert rolling["viscosity_ratio"].limit == 0.1
    assert rolling["viscosity_ratio"].value > 0.1
    assert "not judged" in rolling["standstill"].note  # no case of this cube stands
    film = by_name(found)["journal-cylindrical"].numbers
    for key in ("minimum_load", "viscosity_ratio"):
        assert rolling[key].low <= rolling[key].value <= rolling[key].high
    assert rolling["viscosity_ratio"].value == rolling["viscosity_ratio"].low  # none is smaller
    for key in ("minimum_load", "viscosity_ratio", "standstill", "row_share", "wear"):
        assert math.isnan(film[key].value), key
        assert film[key].note.startswith("n/a"), key


def test_every_cell_has_a_number_or_a_reason(found):
    for one in found.comparison.candidates:
        assert [*one.numbers] == [*QUANTITIES]
        for key, number in one.numbers.items():
            assert math.isfinite(number.value) or number.note, (one.name, key)
            assert number.unit == QUANTITIES[key].unit, key
    film, rolling = (by_name(found)[name] for name in ("journal-cylindrical", "two-spherical"))
    assert film.numbers["rating_life"].note == "n/a: no rolling elements"
    assert rolling.numbers["film_pressure"].note == "n/a: no film bearing"
    page = found.page.read_text(encoding="utf-8")
    assert QUANTITIES["thrust_film"].name not in page  # no candidate has a collar


def test_what_a_film_leaves_of_the_clearance_of_cones_is_their_eccentricity_ratio():
    cone = {"half_angle": 0.5, "slant": [1.6, 2.6], "clearance": 2e-4}
    pair = {"kind": "conical-pair", "geometry": {"distance": 3.2, "left": cone}}
    scene = make_scene({"name": "c", "shaft": {"moment": {}}, "bearings": {"M": pair}})
    found = clearance_used(Number(50.0, "µm", 40.0, 60.0), scene.thrust.bearings["M"])
    assert (found.value, found.low, found.high) == pytest.approx((0.75, 0.7, 0.8))
    assert (found.unit, found.limit != found.limit, found.holds) == ("–", True, None)


def test_an_eccentricity_ratio_above_1_says_why_there_is_a_film_and_others_nothing():
    geometry = {"diameter": 1.0, "width": 1.0, "relative_clearance": 1e-3}
    pads = {"shape": {"kind": "tilting pads", "count": 4, "arc": 1.2, "preload": 0.3}}
    body = {"name": "bores", "shaft": {"two_point": {}}}
    plain, shaped = (
        make_scene(body | {"journal": {"bearings": ["N"], "geometry": geometry | shape}})
        for shape in ({}, pads)
    )
    assert "preloaded lobes and pads" in in_wide_bore(Number(1.11, place="N"), shaped).note
    within = in_wide_bore(Number(0.9, place="N"), shaped).note
    assert within == f"no limit: {AT_NO_RATIO}"
    assert in_wide_bore(Number(1.11, place="N"), plain).note == ""


def test_oil_without_a_stated_supply_is_brought_back_at_a_pressure_that_is_said(found):
    film = by_name(found)["journal-cylindrical"].numbers
    flow, pump = film["oil_flow"], film["pump"]
    assert pump.value == pytest.approx(1e5 * flow.value / 6e4 / 1e3)  # 0.1 MPa, l/min to kW
    assert pump.note == "what leaves the films, at 0.1 MPa, assumed; not in the energy"
    shares = (pump.tolerance_low / pump.value, flow.tolerance_low / flow.value)
    assert shares[0] == pytest.approx(shares[1])
    states = {"mean_supply_power": ("bearing", [2.0, 3.0]), "mean_side_flow": ("bearing", [1, 1])}
    assert supply_power(xr.Dataset(states)) == (5.0, "")
    power, note = supply_power(xr.Dataset(states), 1e-3)  # m³/s of a collar, which has no supply
    assert power == pytest.approx(5.0 + 1e5 * 1e-3)
    assert note == "what leaves the collar at 0.1 MPa, assumed; not in the energy"


def test_a_run_that_kept_no_oil_of_pads_says_what_makes_it_anew():
    older = xr.Dataset({"smallest_film": ("case", [1e-5])}, {"case": ["a"]})
    told = dict(_oil(SimpleNamespace(tables={"thrust": older}), older))
    assert {*told} == {"oil_flow", "pump"}
    assert all(math.isnan(one.value) and "--overwrite" in one.note for one in told.values())


def test_oil_of_pads_is_that_of_each_load_case_by_its_name():
    flow = ("case", "bearing"), [[1.0, 2.0], [np.nan, 4.0]]
    table = xr.Dataset({"mean_side_flow": flow}, {"case": ["b", "a"]})
    assert leaving(table, np.array(["a", "b", "c"])).tolist() == [4.0, 3.0, 0.0]
    assert leaving(None, np.array(["a", "b"])).tolist() == [0.0, 0.0]
    assert supply_power(table)[0].tolist() == [3e5, 4e5]


def test_the_references_behind_the_models_are_told_once_for_all_that_share_them(found):
    page = found.page.read_text(encoding="utf-8")
    told = {one.references: [] for one in found.comparison.candidates}
    for one in found.comparison.candidates:
        told[one.references].append(one.title)
    assert len(told) == 2  # of journal and of rolling bearings
    for text, titles in told.items():
        assert page.count(text) == 1
        assert f"behind the models of {'; '.join(titles)}: {text}" in page


def test_wear_is_that_of_the_followed_contour_with_an_interval_by_what_each_start_rubs():
    rough = {"roughness": 0.5e-6, "contact_modulus": 115e9, "factor": 1e-3}
    scene = make_scene(
        {"name": "worn", "shaft": {"two_point": {}}, "wear": {"law": {"coefficient": 1e-17}},
         "journal": {"bearings": ["N"], "contact": {"asperities": rough}, "geometry": {
             "diameter": 1.0, "width": 1.0, "relative_clearance": 1e-3}}}
    )  # fmt: skip
    cases = ["smooth", "a", "b"]
    table = xr.Dataset(
        coords={"case": cases, "dlc": ("case", ["1.1", "3.1", "3.1"]),
                "wind_speed": ("case", [12.0, 4.0, 4.0])}
    )  # fmt: skip
    bore = xr.Dataset(
        {
            "depth_of_bore": (("angle", "z"), [[0.0], [20e-6]]),
            "contact_energy": (("renewal", "cycle"), [[4.0, 1.0], [2.0, 1.0]]),
            "count": ("cycle", [100.0, 100.0]),
            "case": ("cycle", ["a", "b"]),
            "production": ("cycle", [False, False]),
        },
        {"cycle": ["a", "b"]},
        {"cycles": 2},
    )
    groups = Groups.of(table)
    found = wear(scene, {"N": bore}, table, groups)
    assert (found.value, found.limit) == (pytest.approx(20.0), pytest.approx(50.0))
    assert (found.case, found.place, found.holds) == ("a", "N", True)
    assert "100 nm each on average" in found.note
    # a alone rubs 300 of 400 J, twice of it are 600, twice of b 200
    assert (found.low, found.high) == (pytest.approx(10.0), pytest.approx(30.0))
    assert "0 % of the friction energy that wears is of power production" in found.note
    spells = bore.assign(case=("cycle", ["smooth"] * 2), production=("cycle", [True] * 2))
    running = wear(scene, {"N": spells}, table, groups)
    assert (running.value, running.case) == (found.value, "smooth")
    assert "on average" not in running.note
    assert "100 % of the friction energy" in running.note
    untouched = wear(scene, {"N": xr.Dataset(attrs={"cycles": 0})}, table, groups)
    assert (untouched.value, untouched.holds) == (0.0, True)
    lawless = make_scene({"name": "none", "journal": {"bearings": ["N"]}})
    assert "needs a law of wear" in wear(lawless, {}, table, groups).note


def test_rows_of_wear_and_standing_say_which_starts_they_rest_on():
    table = xr.Dataset(coords={"case": [0, 1, 2], "dlc": ("case", ["1.1", "4.1", "3.1"])})
    starts = {"loads": {"dlc": ["1.1", "3.1", "4.1"]}, "lifetime": {"per_year": {"4.1": 500}}}
    scene = make_scene({"name": "s", **starts})
    assert events(scene, table) == "20,000 of DLC 3.1, 10,000 of DLC 4.1 in the life"
    assert events(scene, table.isel(case=[0])) == "no start, stop or fault in this run"


def test_time_standing_has_the_error_of_what_counts_as_standing(tmp_path):
    """Ten samples stand; two more would if ten times as fast a shaft did."""
    speed = np.r_[np.zeros(10), np.full(2, 5 * SLOWEST), np.ones(88)]
    (tmp_path / "loads").mkdir()
    series = xr.Dataset({"speed": ("time", speed)}, {"time": np.arange(100.0)})
    series.to_netcdf(tmp_path / "loads" / "a.h5", engine="h5netcdf")
    coords = {"dlc": ("case", ["3.1"]), "wind_speed": ("case", [8.0]), "seed": ("case", [1])}
    table = xr.Dataset(coords={"case": ["a"], **coords})
    ratio = xr.DataArray([[math.nan]], dims=("case", "bearing"))
    found = dict(
        rolling_risks(
            make_scene({"name": "s"}), tmp_path, table.assign(bearing_viscosity_ratio=ratio),
            np.ones(1),
        )
    )["standstill"]  # fmt: skip
    assert (found.value, found.error) == (pytest.approx(10.0), pytest.approx(0.2))
    assert "ten times" in found.note


@pytest.mark.parametrize("rung", ["tables", "flap", "tower"])
def test_the_error_of_kappa_is_that_of_the_slowest_speed_on_the_models_of_the_rotor(rung):
    loads = {"wind_speeds": [8.0], "rung": rung}
    scene = make_scene(
        {"name": "s", "bearings": ["tapered-pair"], "results": ["rolling.loads"], "loads": loads}
    )
    found = errors_beside(scene, Estimates())["rolling.friction"]["viscosity ratio"]
    known = [ladder()["wind"]["kaimal, 11x48"], ladder()["loads"][rung]]
    speed = sum(one["errors"].get("slowest speed", {"max": 0.0})["max"] for one in known)
    few = ladder()["comparison"]["rollers"]["errors"]["viscosity ratio"]["max"]
    assert found == pytest.approx(0.83 * speed + few, rel=1e-9)
    assert found < 0.02


def test_an_extreme_of_one_seed_has_no_interval_without_width():
    coords = {"case": ["a", "b", "c"], "wind_speed": ("case", [12.0, 12.0, 24.0])}
    table = xr.Dataset({"dlc": ("case", ["1.1"] * 3)}, coords)
    run = SimpleNamespace(tables={"journal": table})
    sure = Number(2.0, "µm", 2.0, 2.0, case="c")
    assert math.isnan(of_one_seed(run, sure).low)
    assert "one seed" in missing("minimum_film", of_one_seed(run, sure))["seeds"]
    for kept in (replace(sure, case="a"), replace(sure, low=1.0), replace(sure, case="")):
        assert of_one_seed(run, kept) == kept


def test_what_stands_at_a_place_and_which_shaft_bends_is_told_in_words(found):
    told = found.comparison.as_dict()
    kinds = {one["name"]: [part["kind"] for part in one["bearings"]] for one in told["candidates"]}
    assert kinds["two-spherical"] == ["double-row spherical roller bearing"] * 2
    assert kinds["double-row-tapered"] == ["double-row tapered roller bearing"]
    scene = make_scene({"name": "s", "shaft": {"two_point": {}, "moment": {}}})
    assert [one["name"] for one in drawn(scene, ["M"])] == ["moment"]
    assert len(drawn(scene)) == 2


def test_candidates_that_can_wear_are_asked_for_it_where_the_scene_has_a_law():
    rough = {"roughness": 0.5e-6, "contact_modulus": 115e9, "factor": 1e-3}
    geometry = {"diameter": 1.0, "width": 1.0, "relative_clearance": 1e-3}
    body = {"name": "worn", "wear": {"law": {"coefficient": 1e-17}}}
    for contact, asked in (({"contact": {"asperities": rough}}, True), ({}, False)):
        journal = {"bearings": ["N"], "geometry": geometry, **contact}
        scene = make_scene({**body, "journal": journal})
        one = candidate_scene(scene, "own", Candidate(journal=scene.journal), 24_000)
        assert ("journal.wear" in one.results) is asked


def test_asked_starts_are_those_that_wear_follows_and_need_a_law(cube, tmp_path, monkeypatch):
    seen = []

    def stop(scene, *_):
        seen.append(counts_of(scene, ["3.1"])["3.1"])
        raise InputError("seen")

    monkeypatch.setattr("loadflow.running.comparison.candidates_for", stop)
    law = {"law": {"coefficient": 1e-17}, "counts": {"3.1": 7}}
    for starts in (None, 500.0):
        with pytest.raises(InputError, match="seen"):
            compare(scene_of(cube, wear=law), out=tmp_path, starts=starts)
    assert seen == [7.0, 500.0]
    with pytest.raises(InputError, match=r"starts: without wear\.law"):
        compare(scene_of(cube), out=tmp_path, starts=500.0)
    with pytest.raises(InputError, match="starts: must be from 0"):
        compare(scene_of(cube, wear=law), out=tmp_path, starts=-1.0)
    path = tmp_path / "scene.toml"
    path.write_text(scene_of(cube).to_toml(), encoding="utf-8")
    with pytest.raises(SystemExit) as left:
        main(["compare", str(path), "--starts", "500", "--out", str(tmp_path)])
    assert left.value.code == 2


def test_bands_by_tolerances_stand_beside_the_numbers(found):
    for one in found.comparison.candidates:
        for key in ("load_factor", "friction", "energy"):
            number = one.numbers[key]
            assert number.tolerance_low <= number.value <= number.tolerance_high, (one.name, key)
            assert number.tolerance_low < number.tolerance_high
            assert number.tolerance
    number = found.comparison.candidates[0].numbers["energy"]
    low, high = map(three_digits, (number.tolerance_low, number.tolerance_high))
    told = f"<small><i>tol.</i> {low}\u2009…\u2009{high}, {number.tolerance}</small>"
    assert told in found.page.read_text(encoding="utf-8")
    assert "oil viscosity ± 10 %, oil temperature ± 5 K" in found.comparison.facts["Tolerances"]


def test_tilt_films_and_rows_have_intervals_by_the_seeds(found):
    rolling = by_name(found)["two-spherical"].numbers
    for key in ("film_parameter", "row_share", "row_overload", "tilt"):
        assert rolling[key].low <= rolling[key].value <= rolling[key].high, key
    film = by_name(found)["journal-cylindrical"].numbers["tilt"]
    assert math.isnan(film.value)  # no limit
    assert "aligns itself" in film.note


def test_a_spherical_pair_has_its_thrust_on_one_row(found):
    share = by_name(found)["two-spherical"].numbers["row_share"]
    assert share.value > 95
    assert share.place == "N2"
    assert by_name(found)["two-spherical"].numbers["row_overload"].value == pytest.approx(
        share.value / 50
    )


def test_what_carries_the_thrust_is_said(found):
    assert by_name(found)["journal-cylindrical"].thrust.startswith("no bearing; one for")
    assert by_name(found)["two-spherical"].thrust.startswith("N2")
    assert by_name(found)["double-row-tapered"].thrust.startswith("M")


def test_those_that_hold_without_reservations_come_first_and_lose_more_and_more(found):
    rank = [
        (not one.holds, bool(one.reservations), one.numbers["energy"].value)
        for one in found.comparison.candidates
    ]
    assert rank == sorted(rank)
    assert found.comparison.conclusion.count(".") >= 1


def test_it_continues_with_what_is_missing(cube, found):
    film = found.path / "candidates" / "journal-cylindrical" / "journal"
    before = {path.name: path.stat().st_mtime_ns for path in film.iterdir()}
    again = compare(scene_of(cube), out=found.path.parent)
    after = {path.name: path.stat().st_mtime_ns for path in film.iterdir()}
    assert after == before
    assert again.comparison.to_csv() == found.comparison.to_csv()


def test_kept_numbers_are_strict_json_and_come_back_as_they_were(tmp_path):
    verdict = Verdict("N", "life", math.nan, math.inf, "at least")
    life = {"life": Number(math.inf, "h")}
    one = judged_of("a", np.float64(5.0), numbers=life, verdicts=(verdict,))
    run = SimpleNamespace(folder=tmp_path)
    kept_numbers.keep(run, "of", one)

    def refused(name):
        raise AssertionError(f"{name} is no JSON")

    json.loads((tmp_path / "numbers.json").read_text(), parse_constant=refused)
    assert repr(kept_numbers.kept(run, "of")) == repr(
        judged_of("a", 5.0, numbers=life, verdicts=(verdict,))
    )


def test_numbers_are_found_anew_by_other_code(monkeypatch):
    run = SimpleNamespace(name="a", title="a", source="", scene=make_scene({"name": "c"}))
    run.manifest = {}
    before = kept_numbers.key_of(run)
    assert before == kept_numbers.key_of(run)
    monkeypatch.setattr(kept_numbers, "code_stamp", lambda: "another")
    assert kept_numbers.key_of(run) != before


def test_numbers_are_found_once_and_anew_where_they_rest_on_something_else(
    cube, found, tmp_path, monkeypatch
):
    asked, place = [], shutil.copytree(found.path, tmp_path / found.path.name)

    def seen(run, folder):
        asked.append(run.name)
        return judged(run, folder)

    monkeypatch.setattr("loadflow.running.comparison.judged", seen)
    again = compare(scene_of(cube), out=tmp_path)
    assert asked == []
    plain_words = [json.dumps(one.comparison.as_dict()) for one in (again, found)]
    assert plain_words[0] == plain_words[1]
    damaged = place / "candidates" / "two-spherical" / "numbers.json"
    whole = damaged.read_text(encoding="utf-8")
    damaged.write_text(whole[:1000], encoding="utf-8")
    compare(scene_of(cube), out=tmp_path)
    assert asked == ["two-spherical"]
    assert damaged.read_text(encoding="utf-8") == whole
    bare = {"clearance": 0.0, "viscosity": 0.0, "temperature": 0.0, "roughness": 0.0}
    compare(scene_of(cube, as_built={**bare, "alignment": 0.0}), out=tmp_path)
    assert sorted(asked[1:]) == ["double-row-tapered", "journal-cylindrical", "two-spherical"]


def test_inputs_tell_wind_speeds_seeds_and_the_length_that_is_stated():
    cases = {"case": [0, 1, 2, 3], "dlc": ("case", ["1.1", "1.1", "3.1", ""]),
             "wind_speed": ("case", [8.0, 8.0, 12.0, np.nan])}  # fmt: skip
    runs = [{"journal": xr.Dataset(coords=cases)}]
    told = [
        facts(make_scene({"name": "c", "loads": loads}), runs)["Load cases"]
        for loads in ({}, {"duration": 120.0})
    ]
    by_case = "4: DLC 1.1 at 8 m/s; DLC 3.1 at 12 m/s; of no design load case; 1 … 2 seeds at each"
    assert told == [by_case, f"{by_case}, 120 s"]


class Links(HTMLParser):
    def __init__(self):
        super().__init__()
        self.links, self.ids = [], set()

    def handle_starttag(self, tag, attrs):
        given = dict(attrs)
        self.links += [given["href"]] if tag == "a" else []
        self.ids |= {given["id"]} if "id" in given else set()


def test_the_page_says_the_conclusion_and_its_links_lead_somewhere(found):
    page = found.page.read_text(encoding="utf-8")
    assert found.comparison.conclusion in page
    assert found.comparison.reservations in page
    shown = re.sub(r"<(script|style).*?</\1>", "", page, flags=re.DOTALL)
    assert "nan" not in shown.lower().replace("tenance", "")
    parser = Links()
    parser.feed(page)
    for link in parser.links:
        if link.startswith("#"):
            assert link[1:] in parser.ids
        else:
            assert (found.path / link).exists(), link
    for one in found.comparison.candidates:  # each number of a load case leads to it
        for key, number in one.numbers.items():
            extreme = bool(number.case) and math.isfinite(number.value)
            time = "" if math.isnan(number.time) else f"-{number.time:.3f}"
            assert (f"{one.name}.at-{number.case}-{number.place}{time}" in parser.ids) == extreme
            row = re.search(rf'<tr id="{re.escape(f"{one.name}.{key}")}">.*?</tr>', page)
            assert (row is not None) == extreme, key
            assert row is None or f'href="#{one.name}.at-{number.case}-' in row[0]


def series_under(time, *force):
    """A bearing that turns steadily under a force (3) over time, without a moment."""
    force = np.stack(np.broadcast_arrays(*force, time)[:3])
    return xr.Dataset(
        {"speed": ("time", np.full(time.size, 1.2), {"units": "rad/s"}),
         "force": (("axis", "time"), force, {"units": "N"}),
         "moment": (("axis", "time"), np.zeros_like(force), {"units": "N m"})},
        {"time": time},
    )  # fmt: skip


def test_a_moment_shows_force_and_film_of_its_bearing_at_its_time_in_the_series():
    time = np.arange(0.0, 120.0, 0.1)
    series = series_under(time, 0.0, 3e5 + time, 4e5)
    film = xr.Dataset(
        {"time": ("sample", [70.3, 2.0, 50.01]),
         "minimum_film": ("sample", [20e-6, 1e-6, 30e-6], {"units": "m"})},
    )  # fmt: skip
    chart = moment_chart(Moment("a", 60.0, "N"), series, {"journal bearing": film}, "c")
    assert (chart.x[0], chart.x[-1]) == pytest.approx((45.0, 75.0))
    assert chart.mark == 60.0
    across, _speed, thin = chart.panels  # neither thrust nor moment: no lines of zeros
    assert [*across.lines] == ["across the shaft"]
    at = np.flatnonzero(np.isclose(chart.x, 60.0))
    assert across.lines["across the shaft"][at] == pytest.approx(np.hypot(3e2 + 0.06, 4e2))
    known = np.isfinite(thin.lines["journal bearing"])
    assert chart.x[known] == pytest.approx([50.0, 70.3])  # the sample at 2 s is out of sight
    assert thin.lines["journal bearing"][known] == pytest.approx([30.0, 20.0])
    assert thin.dots
    whole = moment_chart(Moment("a", math.nan, "N"), series, {}, "c")
    assert whole.mark is None
    assert whole.x.size == time.size


@pytest.mark.parametrize(("every", "dots"), [(1, False), (2, True), (3, True)])
def test_films_of_every_other_sample_are_seen_as_dots_and_those_of_all_as_a_line(every, dots):
    """A line has no gaps: values with nothing beside them would not be drawn."""
    time = np.arange(0.0, 120.0, 0.1)
    series = series_under(time, 1.0, 1.0, 1.0)
    pressure = ("sample", 1e6 + time[::every], {"units": "Pa"})
    film = xr.Dataset({"time": ("sample", time[::every]), "maximum_pressure": pressure})
    few = film.isel(sample=[3, 300 // every])
    alone, beside = (
        moment_chart(Moment("a", 30.0, "N"), series, samples, "c").panels[-1].dots
        for samples in ({"journal bearing": film}, {"journal bearing": film, "pads": few})
    )
    assert alone == dots
    assert beside  # the few are seen, too


def judged_of(name, energy, kind="rolling", **own):
    known = {"energy": Number(energy, "MWh"),
             "load_factor": Number(1.6, "×", limit=1.0, holds=True)}  # fmt: skip
    about = {"source": "", "verdicts": (), "thrust": "N2", "governs": "", "change": "",
             "models": {}, "checks": [], "bearings": [], "folder": ""}  # fmt: skip
    numbers = known | own.pop("numbers", {})
    return Judged(name=name, title=name, kind=kind, numbers=numbers, **about | own)


@pytest.mark.parametrize(("brief", "expected"), [(0.04, 5.0), (0.06, 0.1)])
def test_a_load_that_dips_for_a_moment_is_no_load_that_skids(brief, expected):
    """The rule of catalogues is one of steady running; a twentieth of the time may pass below."""
    loads, weights = np.array([5.0, 0.1, 9.0]), np.array([0.5 - brief, brief, 0.5])
    assert mostly_exceeded(loads, weights) == expected


def lightest(monkeypatch, share, **parts):
    """Of one bearing, from loads over its capacity and speeds of cases of one wind speed."""
    scene = make_scene({"name": "s", "bearings": ["tapered-pair"]})
    rated = scene.rolling.geometries["M"].rated_capacity
    lines = {
        case: {"load": load, "speed": speed, "weight": np.ones(len(load)), "time": load}
        for case, (load, speed) in parts.items()
    }
    found = [
        ("M", case, xr.Dataset({name: ("sample", values) for name, values in own.items()}))
        for case, own in lines.items()
    ]
    monkeypatch.setattr(candidate_risks, "_samples", lambda *_: found)
    monkeypatch.setattr(
        candidate_risks,
        "_equilibrium",
        lambda *args: SimpleNamespace(equivalent_load=args[-1]["load"].values * rated),
    )
    same = {"dlc": ("case", ["1.1"] * len(parts)), "wind_speed": ("case", [4.0] * len(parts))}
    cases = xr.Dataset(coords={"case": [*parts], **same})
    return candidate_risks._lightest(scene, Path(), cases, np.array(share), Groups.of(cases))


def test_seeds_drawn_anew_may_be_those_whose_shaft_stands_alone(monkeypatch):
    """Of two seeds the shaft turns in one: what both resample of the other has no load."""
    load = [0.05] * 3
    found = lightest(monkeypatch, [0.5, 0.5], a=(load, [1.0] * 3), b=(load, [0.0] * 3))
    assert (found.value, found.low, found.high) == pytest.approx((5.0, 5.0, 5.0))


@pytest.mark.parametrize(("rare", "expected"), [(0.04, 5.0), (0.06, 0.1)])
def test_light_loads_count_with_the_share_of_the_lifetime_of_their_case(
    rare, expected, monkeypatch
):
    """However many samples were solved of it."""
    usual, light = ([0.05] * 3, [1.0] * 3), ([0.001] * 30, [1.0] * 30)
    found = lightest(monkeypatch, [1 - rare, rare], a=usual, b=light)
    assert found.value == pytest.approx(expected)
    assert f"below the limit in {percent(rare)} of that time" in found.note


def test_samples_that_are_solved_as_they_are_extreme_stand_for_no_time(tmp_path):
    """One of 1000 that carries nothing is among some fifty."""
    scene = make_scene({"name": "s", "bearings": ["tapered-pair"]})
    count, least = 1000, 501
    force = np.full((count, 3), 1e6)
    force[least] = 0.0
    part = xr.Dataset(
        {
            "force": (("sample", "axis"), force),
            "moment": (("sample", "axis"), np.zeros((count, 3))),
            "speed": ("sample", np.ones(count)),
            "weight": ("sample", np.full(count, 4.0)),
            "time": ("sample", np.arange(count) / 10.0),
        }
    )
    (tmp_path / "reduction").mkdir()
    part.to_netcdf(tmp_path / "reduction" / "a.h5", group="M", engine="h5netcdf")
    [(_, _, some)] = candidate_risks._samples(scene, tmp_path, ["a"])
    assert some["weight"].values[some["time"].values == least / 10].tolist() == [0.0]
    assert (some["weight"].values > 0).sum() == 48
    assert some["weight"].sum() == 4 * count


def test_few_samples_tell_the_load_that_is_mostly_exceeded_as_all_do():
    """Of unlike weights, 48 spread over the loads; as many spread over time scatter by 40 %."""
    rng = np.random.default_rng(7)
    missed = []
    for _ in range(50):
        loads = np.abs(rng.normal(1.0, 0.4, 764))
        weights = rng.geometric(0.05, 764).astype(float)
        some = spread_over(loads, weights, 48)
        found = mostly_exceeded(loads[some], np.ones(48))
        missed.append(found / mostly_exceeded(loads, weights) - 1)
    assert np.std(missed) < 0.04
    assert abs(np.mean(missed)) < 0.04


def test_extreme_load_cases_alone_tell_nothing_of_a_year():
    table = xr.Dataset(coords={"case": ["a", "b"]})
    shares = xr.Dataset({"share": ("case", [0.3, 0.7])}, {"case": ["a", "b"]})
    numbers = {
        "energy": Number(6.2, "MWh"), "rating_life": Number(190.0, "years", limit=20.0, holds=True),
        "friction": Number(0.7, "kW", note="cold"), "film_pressure": Number(5.0, "MPa"),
        "mixed_time": Number(math.nan, "h", note="n/a: no film bearing"),
        **{name: Number(90.0, "N m") for name in TORQUES.values()},
        "minimum_load": Number(1.5, "%", limit=2.0, holds=False),
    }  # fmt: skip
    known = Finished("a", "", "", None, {"rolling": table, "lifetime": shares}, {}, None)
    assert without_shares(known, numbers) == numbers
    told = without_shares(replace(known, tables={"rolling": table}), numbers)
    assert math.isnan(told["energy"].value)
    assert told["rating_life"].holds is None
    assert told["rating_life"].note == f"n/a: {NO_SHARE}"
    assert told["mixed_time"] == numbers["mixed_time"]
    assert told["film_pressure"] == numbers["film_pressure"]
    assert (told["friction"].value, told["friction"].note) == (
        0.7, f"cold; all load cases count alike, as {NO_SHARE}",
    )  # fmt: skip
    for name in ("minimum_load", *TORQUES.values()):  # those of catalogues beside ours
        assert told[name] == replace(
            numbers[name], note=f"all load cases count alike, as {NO_SHARE}"
        )


def test_without_a_year_candidates_rank_by_how_much_loads_may_grow():
    of_year = {"energy": Number(math.nan, "MWh")}
    near, far = (
        judged_of(name, 0.0, numbers=of_year | {"load_factor": Number(factor, "×")})
        for name, factor in (("near", 1.2), ("far", 2.76))
    )
    order = sorted([near, far], key=lambda one: one.rank)
    assert [one.name for one in order] == ["far", "near"]
    assert conclusion(order).endswith(
        "rolling bearings (far) have most, 2.76 times these loads to their limits."
    )


LIGHT = {"minimum_load": Number(0.68, "%", limit=2.0, holds=False)}
LOOSE = Verdict("journal N2", THRUST, 964e3, 0.0, "at most", "N")


def test_what_breaks_a_rule_or_leaves_the_thrust_ranks_behind_and_is_no_headline():
    skids, rolls = judged_of("barrels", 3.0, numbers=LIGHT), judged_of("pair", 20.0)
    bare = judged_of("bores", 47.0, "journal", verdicts=(LOOSE,))
    collar = judged_of("collar", 109.0, "journal")
    order = sorted([skids, bare, collar, rolls], key=lambda one: one.rank)
    assert order == [rolls, collar, skids, bare]
    assert all(one.holds for one in order)
    assert conclusion(order) == (
        "4 of 4 candidates hold their limits on these loads, of which 2 with reservations; of the "
        "others, rolling bearings (pair) lose least, 20.0 MWh a year, with a capacity margin of "
        "1.60; the best journal bearings (collar) lose 109 MWh a year, with a capacity margin of "
        "1.60."
    )
    assert reservations(order) == (
        "Reservations: load over the dynamic capacity, exceeded for 95 % of the time (skidding): "
        "barrels (0.68 %, limit 2 %); and thrust that no bearing carries: bores (964 kN)."
    )
    assert reservations([rolls, collar]) == ""
    assert "lose 47.0 MWh a year without that of a thrust bearing" in conclusion([rolls, bare])
    told = conclusion([rolls, bare], {"pads": "no equilibrium"})
    assert "Without an answer, and not counted: pads." in told
    gone = replace(rolls, unanswered={"rolling of one": "no equilibrium"})
    assert "which have parts without an answer." in conclusion([gone])


def test_bearings_of_the_scene_are_none_of_a_candidate_that_has_others():
    """A collar of the scene carries no thrust of journals without one."""
    others = {"candidates": {"journal-cylindrical": {}, "journal-thrust": {}}}
    scene = make_scene({"name": "quick", "bearings": ["journal-thrust"], **others})
    assert scene.thrust.bearings
    bare, pads = (scene.candidates[name] for name in others["candidates"])
    found = candidate_scene(scene, "bare", bare, 1000)
    assert not found.thrust.bearings
    assert not {"thrust", "rolling"} & found.model_fields_set
    assert candidate_scene(scene, "pads", pads, 1000).thrust.bearings


def test_a_candidate_with_a_reservation_says_so_in_table_and_depth(found):
    bare = by_name(found)["journal-cylindrical"]
    assert bare.holds
    assert UNCARRIED in bare.reservations
    page = found.page.read_text(encoding="utf-8")
    assert f"<small>with reservations: {'; '.join(bare.reservations)}</small>" in page
    assert f"{bare.title}: holds, with reservations: " in page


def listed(key, number):
    return plain(vars(number)) | {"missing": missing(key, number)}


@pytest.mark.parametrize(
    ("key", "said"), [("eccentricity_ratio", "limit ≤ 0.95"), ("minimum_film", "limit ≥ 0.95")]
)
def test_a_limit_says_on_which_side_of_it_a_number_must_stay(key, said):
    numbers = {key: listed(key, Number(0.9, "–", limit=0.95, holds=True))}
    data = {"quantities": named_quantities()}
    row = _row(key, data | {"candidates": [{"name": "one", "numbers": numbers}]}, ())
    assert row.limit == said
    [cell] = row.cells
    assert (cell.value, cell.state, cell.limit) == ("0.900", "good", "")


@pytest.mark.parametrize(
    ("limit", "said"),
    [(0.0, "0"), (0.95, "0.95"), (10.0, "10"), (100.0, "100"), (999.7, "1,000"), (2e7, "2.00e+07")],
)
def test_a_limit_has_no_zeros_at_its_end_and_no_exponent_where_it_can_be_read(limit, said):
    assert short(limit) == said


def test_limits_that_differ_stand_in_each_cell():
    key, data = "minimum_film", {"quantities": named_quantities()}
    both = [
        {"name": name, "numbers": {key: listed(key, Number(20.0, "µm", limit=limit, holds=True))}}
        for name, limit in (("one", 10.0), ("two", 13.8))
    ]
    row = _row(key, data | {"candidates": both}, ())
    assert row.limit == ""
    assert [cell.limit for cell in row.cells] == ["limit ≥ 10", "limit ≥ 13.8"]


def test_the_limit_of_some_stands_beside_them_alone():
    """A number without a limit must not seem to break that of the others."""
    key, data = "eccentricity_ratio", {"quantities": named_quantities()}
    held = Number(0.9, "–", limit=0.95, holds=True)
    for free in (Number(1.1, "–", low=1.0, high=1.1), Number(1.1, "–")):
        both = [
            {"name": name, "numbers": {key: listed(key, number)}}
            for name, number in (("bore", held), ("pads", free))
        ]
        row = _row(key, data | {"candidates": both}, ())
        assert (row.limit, [cell.limit for cell in row.cells]) == ("", ["limit ≤ 0.95", ""])


def test_a_row_that_is_zero_or_without_a_number_throughout_is_named_once_with_why(tmp_path):
    def candidate(name, **numbers):
        return judged_of(name, 3.0, "journal", numbers=numbers)

    idle, lawless = Number(0.0, "kW", note="fed without pressure"), "n/a: wear.law: needs a law"
    shut = Number(0.0, "µm", limit=1.0, holds=False)
    one = candidate("one", pump=idle, wear=Number(math.nan, "µm", note=lawless), minimum_film=shut)
    two = candidate("two", pump=idle, wear=Number(math.nan, "µm", note="n/a: no film bearing"),
                    minimum_film=shut)  # fmt: skip
    both = Comparison("c", "", "", (one, two), {}, [], {}, [])
    page = write_comparison(tmp_path / "c.html", both.as_dict()).read_text(encoding="utf-8")
    told = page.split("Left out, as no candidate has a number above 0: ")[1].split("</p>")[0]
    pump, worn, film = (QUANTITIES[key].name for key in ("pump", "wear", "minimum_film"))
    assert f"{pump} (0 throughout; fed without pressure)" in told
    assert f"{worn} (wear.law: needs a law)" in told
    assert f'<th scope="row">{pump}' not in page
    assert f'<th scope="row">{film}' in page  # 0 breaks its limit


def test_what_no_number_has_is_told_once_and_stands_in_no_cell(tmp_path):
    def page_of(energy):
        film = Number(20.0, "µm", error=0.02)
        one = judged_of("one", 3.0, "journal", numbers={"minimum_film": film, "energy": energy})
        told = Comparison("c", "", "", (one,), {}, [], {}, []).as_dict()
        return write_comparison(tmp_path / "c.html", told).read_text(encoding="utf-8")

    lacking, once = "<i>seeds</i> – <a", "No number has <i>seeds</i> beside it: one seed gives no"
    of_one_seed = page_of(Number(10.0, "MWh"))
    assert of_one_seed.count(once) == 1
    assert lacking not in of_one_seed
    assert "<i>models</i> – <a" in of_one_seed  # the film has that
    of_several = page_of(Number(10.0, "MWh", low=9.0, high=11.0))
    assert once not in of_several
    assert of_several.count(lacking) >= 1


def test_without_a_picture_a_number_leads_to_its_row_which_leads_nowhere(tmp_path):
    film = Number(20.0, "µm", case="a", time=3.0, place="N")
    one = judged_of("one", 3.0, "journal", numbers={"minimum_film": film})
    told = Comparison("c", "", "", (one,), {}, [], {}, []).as_dict()
    page = write_comparison(tmp_path / "c.html", told).read_text(encoding="utf-8")
    assert page.count('href="#one.minimum_film"') == 1
    row = page.partition('<tr id="one.minimum_film">')[2].partition("</tr>")[0]
    assert "3.00 s" in row
    assert "href" not in row


def test_the_table_and_the_json_hold_the_same_numbers(found):
    with found.table.open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    data = json.loads((found.path / "compare.json").read_text(encoding="utf-8"))
    listed = {(row["candidate"], row["quantity"]): row["value"] for row in rows}
    for one in data["candidates"]:
        for key, number in one["numbers"].items():
            told = listed[one["name"], key]
            assert (float(told) if told else None) == number["value"]


def test_the_command_prints_json(cube, tmp_path, capsys):
    scene = tmp_path / "s.toml"
    scene.write_text(scene_of(cube).to_toml(), encoding="utf-8")
    with pytest.raises(SystemExit) as stop:
        main(["compare", str(scene), "--candidate", "two-spherical", "--workers", "1", "--json",
              "--out", str(tmp_path / "runs")])  # fmt: skip
    assert not stop.value.code
    data = json.loads(capsys.readouterr().out)
    assert [one["name"] for one in data["candidates"]] == ["two-spherical"]
    assert Path(data["page"]).exists()


def test_an_unknown_candidate_is_named(cube, tmp_path):
    with pytest.raises(InputError, match="no candidate 'magic'; there are journal-cylindrical"):
        compare(scene_of(cube), candidates=["magic"], out=tmp_path)


def test_without_candidates_the_sized_ones_that_the_shaft_has_places_for_are_taken(cube):
    scene = scene_of(cube, candidates={}, shaft={"two_point": {}}, results=["loads.statistics"])
    known, without = candidates_for(scene)
    assert {"journal-cylindrical", "journal-lemon", "two-spherical"} <= set(known)
    assert "four-point" in without


def test_a_sized_candidate_fills_a_suspension(cube):
    """One bearing at N is whole on three points, and half an answer on two."""
    states = {"candidates": {}, "results": ["loads.statistics"]}
    three = scene_of(cube, shaft={"three_point": {}}, **states)
    known, without = candidates_for(three)
    assert list(known) == ["spherical"]
    assert known["spherical"].places == ("N",)
    assert "two-spherical" in without
    assert "spherical" in candidates_for(scene_of(cube, shaft={"two_point": {}}, **states))[1]


def test_the_bearings_that_the_scene_states_are_candidates_too(cube):
    own = {"kind": "journal", "geometry": {"diameter": 1.0, "width": 0.9,
                                           "relative_clearance": 1e-3}}  # fmt: skip
    scene = scene_of(cube, candidates={}, bearings={"N": own, "N2": {"like": "N"}})
    assert "own-journal" in candidates_for(scene)[0]
    assert "own-rolling" not in candidates_for(scene)[0]


def test_bearings_of_the_scene_that_are_the_sized_ones_are_compared_once(cube):
    scene = scene_of(cube, candidates={}, bearings=["journal-thrust", "tapered-pair"])
    known, without = candidates_for(scene)
    assert {"journal-thrust", "tapered-pair", "two-spherical"} <= set(known)
    assert not {"own-journal", "own-rolling"} & {*known, *without}


def test_cylindrical_and_lobed_bores_are_followed_in_motion_and_others_at_rest(cube):
    names = ("journal-cylindrical", "journal-lemon", "journal-tilting-pads")
    scene = scene_of(cube, candidates={name: {} for name in names})
    *moving, resting = (
        candidate_scene(scene, name, scene.candidates[name], 1000) for name in names
    )
    for one in moving:
        assert (one.journal.motion, one.journal.rung) == ("transient", "reduced")
        assert one.journal.at("N2").in_motion
    assert resting.journal.motion == "quasi-static"
    assert resting.reduction.classes is not None


def test_bores_with_a_supply_that_the_fast_rung_does_not_know_are_solved_at_rest(cube):
    def modelled(**groove):
        lobes = {"kind": "lobes", "count": 2, "preload": 0.2, "groove": 0.25, "angle": 0.35}
        size = {"diameter": 1.4, "width": 1.2, "relative_clearance": 1e-3, "shape": lobes}
        own = {"kind": "journal", "geometry": size, "lubricant": {"viscosity": 0.1}}
        own["supply"] = {"grooves": [{"length": 0.5, "pressure": 3e5} | groove]}
        scene = scene_of(cube, candidates={"own": {"N": own, "N2": own}})
        return candidate_scene(scene, "own", scene.candidates["own"], 1000).journal

    assert modelled(angle=1.5, arc=0.3).in_motion
    for between in ({"angle": 0.35 + math.pi / 2, "arc": 0.1}, {"angle": 1.0, "shape": "circle"}):
        assert (modelled(**between).motion, modelled(**between).rung) == ("quasi-static", "grid")


def test_losses_without_slip_are_near_those_with_every_roller_followed(cube, found, tmp_path):
    """The friction stage follows each roller; sampled ideal rolling is a third off at most."""
    import loadflow as lf

    base = candidate_scene(
        scene_of(cube), "slip", scene_of(cube).candidates["double-row-tapered"], 200
    ).model_copy(update={"results": ["rolling.loads", "rolling.friction"]})
    run = lf.run(base, out=tmp_path, report=False)
    theirs = run.tree["friction"]["mean_friction_power"].sel(bearing="M").mean().item()
    rolling = run.tree["rolling"].to_dataset()
    ours = rolling_losses(base, run.path, rolling).power.sel(bearing="M").mean().item()
    assert ours == pytest.approx(theirs, rel=0.33)


def table(values, speeds):
    return xr.Dataset(
        {"x": ("case", values)},
        {"dlc": ("case", ["1.1"] * len(values)), "wind_speed": ("case", speeds)},
    )


@pytest.mark.parametrize(("speeds", "seeds"), [(1, 6), (1, 12), (11, 2)])
def test_an_interval_covers_the_mean_as_often_as_it_says(speeds, seeds):
    """Of normal samples; without wider percentiles it is 0.86, 0.90 and 0.80."""
    draw, inside, count = np.random.default_rng(3), 0, speeds * seeds
    groups = Groups.of(table(np.zeros(count), np.repeat(np.arange(speeds), seeds)))
    for _ in range(400):
        values = draw.normal(size=count)
        low, high = interval(groups, lambda some, v=values: float(v[some].mean()), 400)
        inside += low < 0 < high
    assert 0.915 < inside / 400 < 0.98


def test_seeds_are_drawn_within_their_wind_speed():
    values = np.array([0.0, 0.0, 10.0, 10.0])
    groups = Groups.of(table(values, [8.0, 8.0, 12.0, 12.0]))
    assert groups.sizes == (2, 2)
    assert interval(groups, lambda some: float(values[some].mean())) == (5.0, 5.0)


def test_one_seed_gives_no_interval():
    groups = Groups.of(table(np.zeros(2), [8.0, 12.0]))
    assert all(map(math.isnan, interval(groups, lambda some: 1.0)))


def test_the_life_of_a_system_is_that_of_its_parts():
    damage = np.array([[1e-5, 1e-5], [3e-5, 3e-5]])
    share = np.array([0.5, 0.5])
    each = 1 / 2e-5
    slope = 1.125
    assert joint_life(damage, share, slope) == pytest.approx(each * 2 ** (-1 / slope))


def test_the_sketch_is_to_scale_along_the_shaft():
    line = {"name": "two_point", "bearings": ["N", "N2"], "positions": [2.0, 6.0],
            "locating": "N2", "masses": [[8.0, 6e4]]}  # fmt: skip
    drawn = sketch([line])
    boxes = [float(x) for x in re.findall(r'<rect x="([\d.]+)"', drawn)]
    mass = float(re.search(r'<circle cx="([\d.]+)" cy="[\d.]+" r="5"', drawn)[1])
    first, second = sorted({x + 9 for x in boxes})
    assert (mass - second) / (second - first) == pytest.approx(0.5, rel=1e-3)
    assert "60 t" in drawn


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
@pytest.mark.parametrize("width", [400, 1600])
def test_a_browser_shows_the_page_within_its_width_without_a_console_error(found, tmp_path, width):
    # the copy says in its title how wide the page is: wide tables scroll inside it
    probe = (
        "<script>addEventListener('load', () => {"
        "const link = document.querySelector('.main td a[href*=\".at-\"]'); link.click();"
        "setTimeout(() => {"
        "const drawn = document.querySelectorAll('svg.sketch rect').length;"
        "const wide = document.documentElement.scrollWidth > innerWidth;"
        "const frames = document.getElementById(link.hash.slice(1)).querySelectorAll('canvas');"
        "const top = document.querySelector(link.hash.replaceAll('.', '\\\\.')).parentElement;"
        "const seen = Math.abs(top.getBoundingClientRect().top) < innerHeight;"
        "document.title = `drawn ${drawn} wide ${wide} frames ${frames.length > 2} seen ${seen}`;"
        "}, 500)});</script></body>"
    )
    copy = tmp_path / "probe.html"
    text = found.page.read_text(encoding="utf-8")
    copy.write_text(text.replace("</body>", probe), encoding="utf-8")
    done = subprocess.run(
        [
            BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--no-first-run",
            "--disable-background-networking", "--disable-component-update", "--disable-sync",
            "--enable-logging=stderr", f"--user-data-dir={tmp_path / 'profile'}",
            f"--window-size={width},1000", "--virtual-time-budget=5000", "--dump-dom",
            copy.as_uri(),
        ],
        capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    assert "<title>drawn 6 wide false frames true seen true</title>" in done.stdout
    assert "CONSOLE" not in done.stderr


@pytest.mark.browser
@pytest.mark.skipif(BROWSER is None, reason="no Chromium on this machine")
def test_a4_holds_the_comparison_with_the_depth_of_each_candidate(found, tmp_path):
    async def look(browser):
        return (
            await on_paper(browser, 273.0),
            await on_paper(browser, 182.0),
            await browser.printed(),
        )

    page = found.page.absolute().as_uri()
    lying, standing, sheets = looked_at(page, tmp_path / "profile", look)
    assert lying["folded"] == lying["again"] > 3
    assert lying["lost"] == lying["silent"] == 0
    assert 0 < max(lying["other"]) <= 1032  # px, 273 mm
    assert len(standing["upright"]) > 5
    assert max(standing["upright"]) <= 688  # 182 mm
    assert standing["smallest"] >= 6.5 / 0.75  # 6.5 pt
    assert {*sheets} == {(595, 842), (842, 595)}
    assert sheets.count((595, 842)) >= len(found.comparison.candidates)  # about a page for each


@pytest.mark.parametrize(
    "module",
    [
        "report.sketch", "studies.seeds.intervals", "scene.candidates", "scene.schema",
        "scene.templates",
    ],
)  # fmt: skip
def test_examples_of_the_docstrings(module):
    outcome = doctest.testmod(importlib.import_module(f"loadflow.{module}"))
    assert outcome.attempted > 0
    assert outcome.failed == 0


def test_a_pilot_of_one_candidate_leaves_the_loads_of_all_as_they_are(tmp_path):
    """What is measured with one bearing must not change the loads of it alone."""
    look = {"wind_speeds": [12.0], "seeds": 1, "duration": 30.0, "rung": "tables", "step": 0.1}
    scene = make_scene(
        {"name": "look", "loads": look, "shaft": {"two_point": {}, "moment": {}},
         "candidates": {"journal-cylindrical": {}}}
    )  # fmt: skip
    loads = shared_loads(scene, tmp_path, Means())
    own = candidate_scene(loads.scene, "one", scene.candidates["journal-cylindrical"], loads.steps)
    huge = {"bearing load max": 0.9, "bearing force DEL": 0.9, "minimum film": 0.9}
    verdict = EffectVerdict(sizes=dict.fromkeys(("dynamic inflow", "dynamic stall"), huge))
    digests = {step.name: step.digest for step in make_plan(own).steps}  # the bores are its own
    for step in make_plan(own, verdict=verdict).steps:
        if step.name in SHARED:
            assert step.digest == digests[step.name]
    assert digests["loads"] == {step.name: step.digest for step in loads.plan.steps}["loads"]
    open_ones = candidate_scene(scene, "one", scene.candidates["journal-cylindrical"], loads.steps)
    first, other = (make_plan(open_ones, verdict=one).steps[0] for one in (None, verdict))
    assert first.digest != other.digest  # where they are not settled, it does
    again = shared_loads(scene, tmp_path, Means())
    assert again.plan.steps == loads.plan.steps
