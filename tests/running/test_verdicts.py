"""Verdicts of a run: the right load, the right limit, its source, and what governs."""

import json
import math
import tomllib

import numpy as np
import pytest
import xarray as xr
from synthetic import case, cube_file

import loadflow as lf
from loadflow.cli import app
from loadflow.cube import make_cube, save_cube
from loadflow.errors import InputError
from loadflow.rolling import main_bearings
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.studies.candidate.tilt import carries_thrust
from loadflow.studies.lifetime.finished_run import run_lifetime
from loadflow.studies.verdicts.rolling import RollingLimits, _static
from loadflow.studies.verdicts.uncarried import located, uncarried
from loadflow.studies.verdicts.verdicts import verdicts
from loadflow.verdict import Verdict, from_dataset, to_dataset

FILM = {"grid": [24, 8]}


def scene_of(cube, **keys):
    data = {
        "name": "judged",
        "loads": {"source": "files", "files": [str(cube)]},
        "results": ["journal.film", "rolling.life", "rolling.friction"],
        "reduction": {"size": 0.05},
        "shaft": {"two_point": {}},
        "journal": FILM,
        "rolling": {"arrangement": "two-spherical"},
        "friction": {"step": 2.0},
    } | keys
    return make_scene({name: part for name, part in data.items() if part is not None})


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    return cube_file(tmp_path_factory.mktemp("cube") / "loads.h5", seeds=(1,))


@pytest.fixture(scope="module")
def run(cube, tmp_path_factory):
    return lf.run(scene_of(cube), out=tmp_path_factory.mktemp("runs"))


def tables(run):
    return {name: node.to_dataset().load() for name, node in run.tree.children.items()}


def one(run, subject, quantity):
    (found,) = (v for v in run.verdicts if (v.subject, v.quantity) == (subject, quantity))
    return found


def again(run, **keys):
    """Verdicts on the numbers of a run under other limits."""
    scene = scene_of("unused.h5", **keys)
    found = tables(run)
    return verdicts(scene, found, run_lifetime(scene, found))


def test_a_verdict_says_value_limit_margin_source_and_what_governs():
    found = Verdict("a", "film", 2.0, 1.5, "at least", "m", "a table", "dlc1.1_v8_s1", 3.0)
    assert (found.holds, found.margin) == (True, 0.5)
    for part in ("film 2 m", "dlc1.1_v8_s1 at 3.0 s", "at least 1.5 m", "a table", "holds"):
        assert part in found.sentence
    assert Verdict("a", "b", 2.0, 1.5, "at most").answer == "broken"
    unknown = Verdict("a", "b", np.nan, 1.5, "at most")
    assert (unknown.answer, unknown.holds) == ("not answered", False)
    told = Verdict("a", "b", 2.0, np.nan, "at most")
    assert (told.answer, told.holds) == ("no limit", True)


def test_verdicts_are_said_in_the_units_of_engineers():
    film = Verdict("a", "smallest film", 0.0, 1.38e-5, "at least", "m")
    assert film.numbers == ("0 µm", "13.8 µm", "-13.8 µm")
    assert "smallest film 0 µm, must be at least 13.8 µm: broken" in film.sentence
    assert Verdict("a", "p", 4.916e7, 7e6, "at most", "Pa").numbers[:2] == ("49.16 MPa", "7 MPa")
    warm = Verdict("a", "T", 313.15, 348.15, "at most", "K")
    assert warm.numbers == ("40 °C", "75 °C", "35 K")
    told = Verdict("a", "force", 1e3, np.nan, "at most", "N")
    assert told.numbers == ("1 kN", "", "")


def test_verdicts_survive_the_file(tmp_path):
    rows = [Verdict("a", "b", 1.0, 2.0, "at most", note="é"), Verdict("c", "d", 3, 2, "at least")]
    to_dataset(rows).to_netcdf(tmp_path / "v.h5", engine="h5netcdf")
    with xr.open_dataset(tmp_path / "v.h5", engine="h5netcdf") as table:
        read = list(from_dataset(table))
    assert [v.sentence for v in read] == [v.sentence for v in rows]


def test_static_safety_is_that_of_the_factored_load(run):
    found = one(run, "rolling N2", "static rating over the design load")
    data = tables(run)["rolling"].sel(bearing="N2")
    characteristic = float(data["bearing_static_safety"].sel(case=found.case))
    assert "γ_f 1.35" in found.note
    assert found.limit == 1.0
    # of rollers the force grows with the load, so that the safety is not far from its share
    assert characteristic / 1.35 == pytest.approx(found.value, rel=0.2)
    assert found.value < characteristic


@pytest.mark.parametrize(("dlc", "said"), [("1.1", True), ("1.1a", True), ("1.3a", False)])
def test_a_variant_of_1_1_is_told_as_not_extrapolated(dlc, said):
    names = ("bearing_design_safety", "bearing_load_factor", "bearing_static_safety")
    values = {name: ("case", [1.35]) for name in names}
    table = xr.Dataset(values, {"case": ["a"], "dlc": ("case", [dlc])})
    note = _static(RollingLimits(), "rolling N", table).note
    assert ("not extrapolated" in note) is said


def test_the_worst_sample_under_design_loads_is_solved_anew(run, cube, tmp_path):
    found = one(run, "rolling N2", "static rating over the design load")
    tree = xr.open_datatree(run.path / "reduction" / f"{found.case}.h5", engine="h5netcdf")
    loads = tree["N2"].to_dataset().load()
    force, moment = (1.35 * loads[name].values[:, [1, 2, 0]] for name in ("force", "moment"))
    solved = main_bearings("two-spherical")["N2"].equilibrium(force, moment[:, :2])
    assert found.value == pytest.approx(float(np.min(solved.static_safety)), rel=1e-6)
    assert found.time == loads["time"].values[int(np.argmin(solved.static_safety))]


def test_a_force_along_the_shaft_is_carried_by_a_rolling_bearing_and_by_no_film(run):
    journal = one(run, "journal N2", "force along the shaft without a bearing")
    rolling = one(run, "rolling N2", "force along the shaft without a bearing")
    assert journal.answer == "broken"
    assert " kN along the shaft is carried by no bearing of this arrangement" in journal.note
    largest = float(tables(run)["rolling"]["bearing_axial_force"].sel(bearing="N2").max())
    assert journal.value == pytest.approx(largest, rel=1e-6)
    assert rolling.holds
    assert "carried by N2, a spherical roller bearing" in rolling.note
    assert not [v for v in run.verdicts if v.subject.endswith("N") and "along" in v.quantity]


@pytest.mark.parametrize("shaft", ["two_point", "integrated", "direct_drive"])
def test_a_force_along_the_shaft_at_a_place_without_a_bearing_is_carried_by_nothing(
    cube, tmp_path, shaft
):
    given = {"shaft": {shaft: {}}, "results": ["journal.film"], "accuracy": "given"}
    film = FILM | {"kind": "journal", "motion": "quasi-static"}
    alone = scene_of(cube, **given, journal=None, rolling=None, bearings={"N": film})
    done = lf.run(alone, out=tmp_path, report=shaft == "two_point")
    found = one(done, "journal arrangement", "force along the shaft without a bearing")
    assert found.answer == "broken"
    assert "place N2 has no bearing in this scene" in found.note
    assert "nothing in the scene carries it" in found.note
    loads = xr.load_dataset(done.path / "shaft" / f"{found.case}.h5", engine="h5netcdf")
    force = loads["force"].sel(bearing="N2", axis="x").sel(time=found.time)
    assert found.value == pytest.approx(abs(float(force)), rel=1e-6)
    assert found.value == pytest.approx(float(done.tree["shaft"]["largest_axial_load"].max()))
    assert carries_thrust(alone, tables(done)) == (
        f"no bearing; one for {found.value / 1e3:.0f} kN is needed"
    )


def loaded(solved, room="journal"):
    """Tables of a run in which some bearings are solved, with 9 kN along the shaft everywhere."""
    places, names = ["N", "N2", "M"], ("largest_load", "largest_axial_load")
    loads = {name: (("case", "bearing"), np.full((1, 3), 9e3)) for name in names}
    loads["largest_axial_load_time"] = ("case", "bearing"), np.full((1, 3), 4.0)
    shaft = xr.Dataset(loads, {"case": ["a"], "bearing": places})
    films = {"largest_axial_load": ("bearing", np.zeros(len(solved)))}
    return {"shaft": shaft, room: xr.Dataset(films, {"bearing": solved})}


ROLLERS = {"kind": "roller", "geometry": {"rollers": 20, "roller_diameter": 0.05,
           "roller_length": 0.05, "pitch_diameter": 1.0}}  # fmt: skip
BARRELS = {"kind": "spherical", "geometry": ROLLERS["geometry"] | {"contact_angle": 0.2}}
COLLAR = {"kind": "thrust", "geometry": {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2,
          "pad_angle": 0.7, "taper": 1e-4}}  # fmt: skip


def test_only_shafts_whose_bearings_are_solved_need_one_that_locates():
    """A three-point shaft is located at N; a moment bearing beside it is another arrangement."""
    film = {"kind": "journal"}
    both = {"name": "x", "shaft": {"three_point": {}, "moment": {}}, "bearings": {"N": film}}
    assert [*located(make_scene(both), loaded(["N"]))] == []
    second = {"name": "x", "shaft": {"two_point": {}}, "bearings": {"N": film, "N2": film}}
    assert [*located(make_scene(second), loaded(["N", "N2"]))] == []
    first = {"name": "x", "shaft": {"two_point": {}, "moment": {}}, "bearings": {"N": film}}
    (found,) = located(make_scene(first), loaded(["N"]))
    assert (found.place, found.carried) == ("N2", False)


@pytest.mark.parametrize(
    ("here", "there", "results", "subject", "words"),
    [
        ({"kind": "journal"}, BARRELS, ["journal.film"], "rolling N2",
         "9 kN along the shaft is carried by N2, a spherical roller bearing; no result of it"),
        ({"kind": "journal"}, COLLAR, ["journal.film"], "thrust N2", "carried by N2, a thrust"),
        (BARRELS, COLLAR, ["rolling.life"], "thrust N2", "carried by N2, a thrust"),
        ({"kind": "journal"}, ROLLERS, ["journal.film"], "",
         "a roller bearing stands there, which carries no thrust"),
        (BARRELS, {"kind": "journal"}, ["rolling.life"], "",
         "a journal bearing stands there, which carries no thrust"),
    ],
)  # fmt: skip
def test_what_carries_the_thrust_is_said_of_a_bearing_without_results(
    here, there, results, subject, words
):
    data = {"name": "x", "shaft": {"two_point": {}}, "bearings": {"N": here, "N2": there}}
    scene, room = make_scene(data | {"results": results}), results[0].split(".")[0]
    tables = loaded(["N"], room)
    (found,) = uncarried(scene, tables)
    carried = bool(subject)
    assert found.holds == carried
    assert found.value == (0.0 if carried else 9e3)
    assert words in found.note
    assert found.subject == (subject or f"{room} arrangement")
    if carried and room == "journal":
        assert carries_thrust(scene, tables) == "N2, up to 9 kN"
    if carried:  # with results of its own it is judged by itself
        own = loaded(["N", "N2"] if room == subject.split()[0] else ["N2"], subject.split()[0])
        assert [*uncarried(scene, tables | own)] == []


def test_a_collar_beside_a_journal_bearing_carries_without_being_asked(cube, tmp_path):
    film = FILM | {"kind": "journal", "motion": "quasi-static"}
    scene = scene_of(
        cube, journal=None, rolling=None, bearings={"N": film, "N2": [film, COLLAR]},
        results=["journal.film"], accuracy="given",
    )  # fmt: skip
    done = lf.run(scene, out=tmp_path, report=False)
    (found,) = (v for v in done.verdicts if "along the shaft" in v.quantity)
    assert (found.subject, found.answer) == ("thrust N2", "holds")
    assert "carried by N2, a thrust" in found.note
    largest = float(done.tree["journal"]["largest_axial_load"].max())
    assert f"{largest / 1e3:.0f} kN" in found.note
    assert carries_thrust(scene, tables(done)) == f"N2, up to {largest / 1e3:.0f} kN"


def test_extreme_load_cases_alone_ask_for_no_life(run):
    def asked(dlc):
        rolling = tables(run)["rolling"]
        table = rolling.assign_coords(dlc=("case", [dlc] * rolling.sizes["case"]))
        found = verdicts(scene_of("unused.h5"), {"rolling": table}, None)
        return [v.answer for v in found if "life L10" in v.quantity]

    assert asked("1.4") == []
    assert set(asked("1.2")) == {"not answered"}  # of fatigue loads without a share they lack


def test_limits_are_those_of_the_scene_and_say_so(run):
    for quantity, limits, limit in (
        ("eccentricity ratio ε", {"eccentricity_ratio": 0.3}, 0.3),
        ("smallest film", {"minimum_film": 1e-3}, 1e-3),
        ("largest Sommerfeld number", {"sommerfeld_peak": 8.0}, 8.0),
        ("largest mean Sommerfeld number", {"sommerfeld_range": (0.1, 0.2)}, 0.2),
        ("largest film pressure", {"material": ((400.0, 1e5),)}, 1e5),
        ("specific load F/(B D)", {"specific_load": 1e4}, 1e4),
    ):
        judged = again(run, journal=FILM | {"limits": limits})
        (found,) = (v for v in judged if (v.subject, v.quantity) == ("journal N", quantity))
        assert found.limit == limit
        assert found.source == "as the scene states"
        assert found.case in tables(run)["journal"]["case"].values
    judged = again(run, rolling={"arrangement": "two-spherical", "limits": {"static_safety": 9e9}})
    (found,) = (v for v in judged if v.subject == "rolling N" and "static" in v.quantity)
    assert found.answer == "broken"


def test_the_smallest_film_allowed_is_roughness_waviness_and_margin():
    journal = make_scene(
        {
            "name": "x",
            "journal": {
                "shaft_roughness": 1e-6,
                "shell_roughness": 2e-6,
                "limits": {"waviness": 3e-6, "margin": 4e-6},
            },
        }
    ).journal
    assert journal.least_film == pytest.approx(10e-6)


BORE = {"diameter": 1.5, "width": 1.5, "relative_clearance": 1e-3}
LEMON = BORE | {"shape": {"kind": "lobes", "count": 2, "preload": 0.3}}
PADS = BORE | {"shape": {"kind": "tilting pads", "count": 4, "arc": 1.3, "preload": 0.4}}


@pytest.mark.parametrize(("geometry", "ratio"), [(BORE, 0.9), (LEMON, np.inf)])
def test_the_critical_eccentricity_ratio_keeps_its_former_name_and_says_so(geometry, ratio):
    journal = make_scene(
        {"name": "x", "journal": {"geometry": geometry, "limits": {"eccentricity_ratio": 0.9}}}
    ).journal
    said = "Journal: critical_eccentricity_ratio is now critical.ratio"
    with pytest.warns(DeprecationWarning, match=said) as told:
        assert journal.critical_eccentricity_ratio == ratio
    assert told[0].filename == __file__


@pytest.mark.parametrize("geometry", [LEMON, PADS])
def test_lobes_and_pads_keep_the_film_that_a_cylinder_has_at_its_critical_eccentricity(
    run, geometry
):
    judged = again(run, journal=FILM | {"geometry": geometry})
    told = {v.quantity: v for v in judged if v.subject == "journal N"}
    film, ratio = told["smallest film"], told["eccentricity ratio ε"]
    assert film.limit == pytest.approx(37.5e-6)  # (5.1), of this clearance
    assert "E_krit" in film.source
    assert film.key == "journal.limits.eccentricity_ratio"
    assert ratio.answer == "no limit"
    assert "no certain ε" in ratio.source
    # (3.1) goes before a thinner one
    tight = again(run, journal=FILM | {"geometry": geometry | {"relative_clearance": 1e-4}})
    (film,) = (v for v in tight if (v.subject, v.quantity) == ("journal N", "smallest film"))
    assert film.limit == pytest.approx(13.8e-6)
    assert "(3.1)" in film.source


@pytest.mark.parametrize(
    ("geometry", "limits", "told"),
    [
        (LEMON, {"minimum_film": 20e-6}, {"minimum_film"}),
        (PADS, {"waviness": 1e-6, "margin": 2e-6}, {"waviness", "margin"}),
        (LEMON, {"minimum_film": 40e-6}, set()),
        (LEMON, {"margin": 2e-6, "eccentricity_ratio": 0.99}, set()),
        (BORE, {"minimum_film": 20e-6}, set()),
    ],
)
def test_a_least_film_below_that_at_the_critical_eccentricity_is_said_to_do_nothing(
    geometry, limits, told
):
    other = {"geometry": BORE, "limits": {"minimum_film": 20e-6}}
    journal = {"geometry": geometry, "limits": limits}
    asked = {"name": "x", "results": ["journal.film"]}
    found = unused_keys(make_scene(asked | {"journal": journal | {"own": {"N2": other}}}))
    assert {*found} == {f"journal.limits.{key}" for key in told}
    assert all("(1 − eccentricity_ratio) c = 37.5 µm" in why for why in found.values())
    found = unused_keys(make_scene(asked | {"journal": other | {"own": {"N2": journal}}}))
    assert {*found} == {f"journal.own.N2.limits.{key}" for key in told}


@pytest.mark.parametrize("limits", [{}, {"sommerfeld_range": [1.0, 6.0]}])
def test_a_range_of_sommerfeld_numbers_stays_stated_or_left_out_as_its_scene_is_written(limits):
    scene = make_scene({"name": "x", "journal": {"geometry": PADS, "limits": limits}})
    again = make_scene(tomllib.loads(scene.to_toml()))
    assert again.journal.limits == scene.journal.limits
    assert again.journal.sommerfeld_range == (1.0 if limits else 0.0, 6.0)


def test_tilting_pads_have_no_least_sommerfeld_number_unless_it_is_stated(run):
    def least(geometry, **limits):
        judged = again(run, journal=FILM | {"geometry": geometry, "limits": limits})
        what = "journal N", "smallest mean Sommerfeld number"
        (found,) = (v for v in judged if (v.subject, v.quantity) == what)
        return found

    assert least(LEMON).limit == least(BORE).limit == 1.0
    assert least(PADS).answer == "no limit"
    assert "do not whirl" in least(PADS).source
    assert least(PADS, sommerfeld_range=(0.9, 6.0)).limit == 0.9
    usual = least(PADS, sommerfeld_range=(1.0, 6.0))  # as others have by default
    assert (usual.limit, usual.source) == (1.0, "as the scene states")
    assert "whirl" not in least(BORE, sommerfeld_range=(0.0, 6.0)).source


def test_the_material_carries_less_the_warmer_it_is():
    limits = make_scene({"name": "x"}).journal.limits
    assert limits.pressure_at(350.0) == 7e6
    assert limits.pressure_at(127 + 273.15) == 7e6
    assert limits.pressure_at((127 + 190) / 2 + 273.15) == pytest.approx(4.2e6)
    assert limits.pressure_at(190 + 273.15) == pytest.approx(1.4e6)
    assert limits.pressure_at(500.0) == 0.0
    assert limits.pressure_at(math.nan) == 7e6  # nobody knows how warm it is


def test_the_largest_film_pressure_says_where_no_temperature_is_computed(run):
    """Of a cold bearing beside a warm one, too."""
    scene, found = scene_of("unused.h5"), tables(run)
    film = found["journal"].drop_vars("largest_temperature", errors="ignore")
    there = xr.full_like(film["largest_pressure"], math.nan)
    there.loc[{"bearing": "N"}] = 463.15
    partly = found | {"journal": film.assign(largest_temperature=there)}
    cold = "temperature not computed: the film has one viscosity"
    for numbers, expected in (
        (found | {"journal": film}, {"journal N": (cold, 7e6), "journal N2": (cold, 7e6)}),
        (partly, {"journal N": ("", 1.4e6), "journal N2": (cold, 7e6)}),
    ):
        judged = verdicts(scene, numbers, run_lifetime(scene, numbers))
        told = {v.subject: v for v in judged if v.quantity == "largest film pressure"}
        for subject, (note, limit) in expected.items():
            assert told[subject].note == note
            assert told[subject].limit == pytest.approx(limit)


def test_the_oil_lasts_as_the_table_of_the_source_says():
    def limit(**keys):
        return make_scene({"name": "x", "journal": {"limits": keys}}).journal.limits.oil_temperature

    assert limit() == pytest.approx(75 + 273.15)
    assert limit(oil_hours=10_000) == pytest.approx(30 + 273.15)
    assert limit(oil_hours=1000) == pytest.approx(52.5 + 273.15)
    assert limit(oil="synthetic, without oxygen") == pytest.approx(495 + 273.15)
    assert limit(temperature=373.15) == 373.15
    with pytest.raises(InputError, match="takes the place of oil"):
        limit(temperature=373.15, oil_hours=200)


def test_unanswered_samples_are_a_verdict(run):
    scene, found = scene_of("unused.h5"), tables(run)
    found["journal"]["not_converged"][0, 0] = 7
    (verdict,) = (
        v
        for v in verdicts(scene, found, None)
        if (v.subject, v.quantity) == ("journal N", "samples not answered")
    )
    assert verdict.answer == "broken"
    assert "not answered: 7 samples" in verdict.note


def test_contact_in_production_breaks_every_verdict_on_the_film(tmp_path):
    slow = case(8.0, 1, steps=100)
    slow["speed"][50:60] = 0.002
    file = save_cube(make_cube([slow]), tmp_path / "loads.h5")
    # at rest: in motion the squeezed film would last for these seconds
    film = FILM | {"motion": "quasi-static"}
    scene = scene_of(
        file, results=["journal.film"], reduction={"size": 1.0}, journal=film, accuracy="given"
    )
    found = {
        v.quantity: v
        for v in lf.run(scene, out=tmp_path, report=False).verdicts
        if v.subject == "journal N2"
    }
    contact = found["time in contact while turning, power production"]
    assert contact.value == pytest.approx(10 * 0.25, rel=0.01)
    assert "kJ" in contact.note
    for quantity in ("eccentricity ratio ε", "smallest film", "largest Sommerfeld number"):
        assert found[quantity].answer == "broken"
        assert "in contact in 1 load case" in found[quantity].note


def test_a_start_is_told_with_its_transition_and_has_a_limit_only_if_one_is_stated(tmp_path):
    start = case(8.0, 1, steps=80)
    slow, fast = np.linspace(0, 0.1, 60), np.linspace(0.1, 1.2, 20)
    start["speed"][:] = np.concatenate([slow, fast])
    start = start.assign_coords(dlc="3.1")
    file = save_cube(make_cube([start]), tmp_path / "loads.h5")
    film = FILM | {"motion": "quasi-static"}
    keys = {"results": ["journal.film"], "reduction": {"size": 1.0}, "accuracy": "given"}
    done = lf.run(scene_of(file, journal=film, **keys), out=tmp_path, report=False)

    def contact(**limits):
        scene = scene_of(file, journal=film | {"limits": limits}, **keys)
        judged = verdicts(scene, tables(done), None)
        assert not [v for v in judged if v.quantity == "smallest film"]
        (found,) = (v for v in judged if v.subject == "journal N" and "contact" in v.quantity)
        return found

    told = contact()
    assert told.answer == "no limit"
    assert "transition at" in told.note
    assert told.sentence in [v.sentence for v in done.verdicts]
    assert contact(start_time=1e-3).answer == "broken"


def test_modified_life_counts_lubrication_and_system_life_all_bearings(run):
    lifetime = run.tree["lifetime"].to_dataset()
    for kind in ("", "modified_"):
        each = lifetime[f"{kind}life_hours"].values
        system = lifetime[f"system_{kind}life_hours"].item()
        assert system == pytest.approx((each ** (-9 / 8)).sum() ** (-8 / 9))
    dirty = scene_of("unused.h5", friction={"cleanliness": "grease, very severe contamination"})
    assert dirty.friction.cleanliness != scene_of("unused.h5").friction.cleanliness
    life = lifetime["modified_life_hours"] / lifetime["life_hours"]
    assert (life != 1.0).all()


def test_energy_a_year_is_mean_power_over_the_winds_of_production(run):
    lifetime, data = run.tree["lifetime"].to_dataset(), tables(run)
    share = data["journal"]["weight"].values
    assert lifetime["share"].values == pytest.approx(share / share.sum())
    power = data["journal"]["mean_friction_power"] + data["journal"]["mean_supply_power"]
    mean = (power.transpose("bearing", "case").values * share).sum(axis=1)
    # class I: mean 10 m/s, between 3 and 25 m/s
    running = np.exp(-np.pi / 4 * 0.3**2) - np.exp(-np.pi / 4 * 2.5**2)
    expected = mean * running * 8766 * 3600
    assert lifetime["journal_energy"].values == pytest.approx(expected, rel=1e-9)
    friction = data["friction"]["mean_friction_power"].transpose("bearing", "case").values
    expected = (friction * share).sum(axis=1) * running * 8766 * 3600
    assert lifetime["rolling_energy"].values == pytest.approx(expected, rel=1e-9)


def test_a_key_without_effect_is_told_by_plan_and_run(cube, tmp_path, capsys):
    file = tmp_path / "told.toml"
    file.write_text(
        f'results = ["loads.statistics"]\n[loads]\nsource = "files"\nfiles = ["{cube}"]\n'
        "seeds = 3\n[reduction]\nsize = 0.5\n"
    )
    told = lf.run(lf.read_scene(file), out=tmp_path, report=False).warnings
    assert [said.partition(":")[0] for said in told] == ["reduction", "loads.seeds"]
    app(["plan", str(file), "--json"], standalone_mode=False)
    planned = json.loads(capsys.readouterr().out)
    assert list(planned["unused"]) == ["reduction", "loads.seeds"]


def test_report_and_json_show_the_same_verdicts(run):
    page = run.report.read_text(encoding="utf-8")
    for verdict in run.verdicts:
        assert verdict.quantity in page
    assert "limit from" in page
    said = json.loads(json.dumps([v.as_dict() for v in run.verdicts]))
    assert all({"value", "limit", "margin", "source", "case", "answer"} <= set(row) for row in said)
