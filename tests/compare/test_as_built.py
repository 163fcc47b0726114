"""Tolerances: what a bearing becomes at their ends, and the bands beside the numbers."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from loadflow.journal.wear.cycle import Cycle
from loadflow.rolling.rating.modified_life import viscosity_ratio
from loadflow.scene.as_built import AsBuilt, grade_width
from loadflow.scene.candidate import Candidate
from loadflow.scene.scene import make_scene
from loadflow.studies.candidate import wear_bands
from loadflow.studies.candidate.deviations import Built, tolerances_of, with_places
from loadflow.studies.candidate.grown_films import fast_journal
from loadflow.studies.candidate.margins import _film_value, lubrication
from loadflow.studies.candidate.result import Number
from loadflow.studies.candidate.wear_bands import BATCHES, Rubbing, with_error
from loadflow.studies.compare.band_films import deciding_of, films_of
from loadflow.studies.compare.bands import Known, _as_share, _banded, _in_bores, cheap_numbers

NONE = {"clearance": 0.0, "viscosity": 0.0, "temperature": 0.0, "roughness": 0.0, "alignment": 0.0}
MEASURES = {"diameter": 1.0, "width": 0.8, "relative_clearance": 1e-3}


@pytest.mark.parametrize(
    ("first", "last", "grade", "table"),
    [(30, 50, 6, 16), (80, 120, 7, 35), (400, 500, 7, 63), (630, 800, 6, 50), (1600, 2000, 7, 150),
     (2500, 3150, 8, 330)],
)  # fmt: skip
def test_grades_are_those_of_the_tables_of_iso_286(first, last, grade, table):
    """At the geometric mean of a step of diameters, but for the rounding of the tables."""
    width = 1e6 * grade_width(1e-3 * math.sqrt(first * last), grade)
    assert width == pytest.approx(table, rel=0.03)


def spectrum(places, moment=0.0):
    axes = ("sample", "axis")
    count = 4
    group = xr.Dataset(
        {
            "force": (axes, np.outer([1.0, 0.8, 0.6, 0.9], [2e5, 0.0, -1.2e6])),
            "moment": (axes, np.outer(np.ones(count), [0.0, moment, 0.0])),
            "time": ("sample", np.arange(4.0)),
            "speed": ("sample", [1.2, 1.2, 0.9, 1.0]),
            "weight": ("sample", [0.25, 0.25, 0.25, 0.25]),
            "load_factor": ("sample", np.full(count, 1.35)),
            "running": ("sample", np.ones(count, bool)),
            "ultimate": ("sample", np.ones(count, bool)),
            "load_per_speed": ("case", [1e6]),
        },
        {"axis": ["x", "y", "z"], "case": ["one"]},
    )
    floating = group.assign(force=group["force"] * xr.DataArray([0.0, 1.0, 1.0], dims="axis"))
    tree = xr.DataTree.from_dict({p: floating if p == "N" else group for p in places})
    tree.attrs["seconds"] = 3e7
    return tree


def built(**sections):
    scene = make_scene({"name": "t", "shaft": {"two_point": {}, "moment": {}}, **sections})
    rooms = {
        room: getattr(scene, room) for room in ("journal", "rolling", "thrust") if room in sections
    }
    if "thrust" in rooms:
        places = [*scene.thrust.bearings]
    else:
        places = ["N", "N2"] if "journal" in rooms else [*scene.rolling.geometries]
    return Built(Candidate(**rooms), scene.friction, spectrum(places))


def journal(**more):
    data = {"bearings": ["N", "N2"], "geometry": MEASURES, "lubricant": {"viscosity": 0.3}}
    return built(journal=data | more)


def only(stated, **given):
    """The one tolerance that is not 0, and what its ends are."""
    (found,) = tolerances_of(stated, AsBuilt(**(NONE | given)))
    return found


def test_a_tolerance_of_0_is_left_out():
    assert not [*tolerances_of(journal(), AsBuilt(**NONE))]
    assert not AsBuilt(**NONE).any
    assert AsBuilt().any


def test_clearance_is_taken_over_the_diameter_to_both_ends():
    found = only(journal(), clearance=2e-4)
    sizes = [end.candidate.journal.geometry.relative_clearance for end in found.ends]
    assert sizes == pytest.approx([0.8e-3, 1.2e-3])
    stated = cheap_numbers(found.stated)
    tight, wide = map(cheap_numbers, found.ends)
    assert tight["oil_flow"] < stated["oil_flow"] < wide["oil_flow"]


def test_a_clearance_that_is_used_up_is_said():
    found = only(journal(), clearance=0.01)
    assert found.missing
    assert len(found.ends) == 1


def test_thinner_oil_and_warmer_oil_thin_the_film_alike():
    """Of one viscosity: a share, and the kelvin that take as much of it."""
    grade, warm = (
        only(journal(), viscosity=0.1),
        only(journal(), temperature=-math.log(0.9) / 0.035),
    )
    thin, warmer = grade.ends[0], warm.ends[1]
    assert thin.candidate.journal.lubricant.viscosity == pytest.approx(0.27)
    assert warmer.candidate.journal.lubricant.viscosity == pytest.approx(0.27)
    films = [cheap_numbers(one)["minimum_film"] for one in (thin, grade.stated, grade.ends[1])]
    assert films == sorted(films)
    assert films[0] < films[-1]


def test_a_film_with_heat_has_other_oil_and_another_inlet():
    data = {"bearings": ["N"], "geometry": MEASURES, "heat": {"oil": "mineral-vg-320"}}
    hot = built(journal=data)
    assert only(hot, temperature=7.0).ends[1].candidate.journal.heat.inlet_temperature == 320.15
    first = only(hot, viscosity=0.1).ends[0].candidate.journal.heat.liquid.viscosities[0]
    assert first == pytest.approx(0.9 * hot.candidate.journal.heat.liquid.viscosities[0])


def test_a_collar_with_heat_has_other_oil_and_another_inlet():
    geometry = {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7,
                "taper": 1e-4}  # fmt: skip
    one = {"kind": "thrust", "geometry": geometry, "heat": {"oil": "mineral-vg-320"}}
    hot = built(thrust={"bearings": {"N2": one}})
    heat = hot.candidate.thrust.bearings["N2"].heat
    grade, warm = only(hot, viscosity=0.1), only(hot, temperature=7.0)
    thinner, warmer = (
        end.candidate.thrust.bearings["N2"].heat for end in (grade.ends[0], warm.ends[1])
    )
    assert thinner.liquid.viscosities[0] == pytest.approx(0.9 * heat.liquid.viscosities[0])
    assert warmer.inlet_temperature == heat.inlet_temperature + 7.0
    films = [
        cheap_numbers(some)["minimum_film"] for some in (grade.ends[0], warm.ends[1], grade.stated)
    ]
    assert max(films[:2]) < films[2]


def test_the_margin_of_a_film_follows_its_power_of_the_load():
    """A pressure whose limit is twice as high: the loads may grow by 2 over its power."""
    low, high = (
        cheap_numbers(journal(limits={"material": [[400.0, p]], "minimum_film": 1e-7}))
        for p in (1e7, 2e7)
    )
    power = math.log(2.0) / math.log(high["load_factor"] / low["load_factor"])
    assert 0.9 < power < 2.0  # the pressure of a film grows faster than its load
    rougher = only(journal(), roughness=0.25).ends[1]
    assert cheap_numbers(rougher)["load_factor"] <= cheap_numbers(journal())["load_factor"]


def cones(**limits):
    cone = {"half_angle": 0.5, "slant": [1.6, 2.6], "clearance": 2e-4}
    pair = {"distance": 3.2, "left": cone}
    data = {"kind": "conical-pair", "lubricant": {"viscosity": 0.2}, "geometry": pair}
    return built(thrust={"bearings": {"M": data | {"limits": limits}}})


def test_the_margin_of_cones_follows_its_power_of_the_load():
    """As that of journal bearings: twice the pressure allowed, the loads by 2 over its power."""
    low, high = (cheap_numbers(cones(material=[[400.0, p]], minimum_film=1e-7)) for p in (2e6, 4e6))
    power = math.log(2.0) / math.log(high["load_factor"] / low["load_factor"])
    assert 0.3 < power < 2.0
    oils = only(cones(), viscosity=0.1)
    thin, thick = (cheap_numbers(end)["load_factor"] for end in oils.ends)
    assert thin < cheap_numbers(oils.stated)["load_factor"] < thick


def test_a_shaft_that_lies_askew_thins_the_film_and_0_leaves_it():
    found = only(journal(), alignment=1e-4)
    stated = cheap_numbers(found.stated)["minimum_film"]
    films = [cheap_numbers(end)["minimum_film"] for end in found.ends]
    assert len(films) == 4
    assert max(films) < stated
    assert stated == pytest.approx(cheap_numbers(journal())["minimum_film"], rel=0.02)


def test_bands_of_bores_that_follow_the_shaft_know_how_they_are_turned():
    """A shaft that is always tilted alike lies straight in them."""
    data = {"bearings": ["N", "N2"], "geometry": MEASURES, "lubricant": {"viscosity": 0.3}}
    data |= {"tilt": True, "alignment": "mean"}
    scene = make_scene({"name": "t", "shaft": {"two_point": {}}, "journal": data})
    lying = spectrum(["N", "N2"])
    for place, tilt in (("N", 1e-4), ("N2", -5e-5)):
        none = xr.zeros_like(lying[place].to_dataset()["force"])
        turned = none + xr.DataArray([0.0, tilt, tilt], dims="axis")
        lying = with_places(lying, {place: lying[place].to_dataset().assign(
            tilt=turned, curvature=none)})  # fmt: skip
    stated = journal(tilt=True, alignment="mean")
    followed = cheap_numbers(replace(stated, spectrum=_in_bores(scene, lying)))
    straight = cheap_numbers(replace(journal(tilt=False), spectrum=lying))
    for name in ("minimum_film", "film_pressure"):
        assert followed[name] == pytest.approx(straight[name], rel=1e-3)


def test_a_shaft_that_is_tilted_by_more_than_its_bore_lets_it_has_no_film():
    options = fast_journal(journal(tilt=True).candidate.journal.at("N"))
    sample = spectrum(["N"])["N"].to_dataset().isel(sample=[0])
    along = xr.DataArray([0.0, 1e-3, 0.0], dims="axis")
    none = xr.zeros_like(sample["force"])
    sample = sample.assign(tilt=none + along, curvature=none)
    assert math.isnan(_film_value(options, sample, "minimum_film", 2.0, 1.0))
    assert _film_value(options, sample, "minimum_film", 0.2, 1.0) > 0


def starting():
    """A bearing whose start rubs: 2 s up to 0.02 rad/s, its asperities known."""
    rough = {"roughness": 0.5e-6, "contact_modulus": 115e9, "factor": 1e-3}
    stated = journal(contact={"asperities": rough}, motion="quasi-static", grid=[60, 8])
    time = np.linspace(0.0, 2.0, 9)
    start = Cycle(time, np.tile((1.2e6, 0.0), (9, 1)), 0.01 * time, in_motion=False)
    return replace(stated, rubbing=Rubbing("N", start))


@pytest.mark.parametrize(
    ("given", "first_rubs_more"),
    [({"viscosity": 0.3}, True), ({"temperature": 8.0}, False), ({"roughness": 0.3}, False)],
)
def test_a_start_rubs_more_in_thinner_or_warmer_oil_and_on_rougher_surfaces(given, first_rubs_more):
    found = only(starting(), **given)
    first, last = (cheap_numbers(end)["wear"] for end in found.ends)
    assert (first > last) is first_rubs_more
    assert min(first, last) < cheap_numbers(found.stated)["wear"] < max(first, last)


def test_a_start_rubs_more_under_a_shaft_that_lies_askew():
    found = only(starting(), alignment=2e-4)
    stated = cheap_numbers(found.stated)["wear"]
    assert all(cheap_numbers(end)["wear"] > stated for end in found.ends)


def test_what_rubs_begins_as_far_from_rest_in_a_narrower_or_a_wider_bore():
    """Where the shaft was is outside of the one, and above the asperities of the other."""
    rough = {"roughness": 0.5e-6, "contact_modulus": 115e9, "factor": 1e-3}
    words = {"motion": "transient", "rung": "reduced", "grid": [60, 8]}
    options = journal(contact={"asperities": rough}, **words).candidate.journal.at("N")
    time, force = 0.05 * np.arange(20), np.tile((1.2e6, 0.0), (20, 1))
    speed = np.full(time.size, 0.01)
    path = options.geometry.orbit(time, force, speed, options.film_model)
    place = path["eccentricity"].values[-1]
    rubs = Rubbing("N", Cycle(time, force, speed, start=place)).begun_in(options)

    def energy(wider):
        clearance = wider * options.geometry.relative_clearance
        bore = replace(options.geometry, relative_clearance=clearance)
        return rubs.energy(options.model_copy(update={"geometry": bore}))

    assert energy(1.0) > 0
    assert energy(0.95) == pytest.approx(energy(1.0), rel=0.1)
    assert energy(1.05) == pytest.approx(energy(1.0), rel=0.1)


def test_wear_has_the_error_of_its_coefficient_and_of_the_films_that_it_begins_in(monkeypatch):
    """Thinner films rub more: as rougher surfaces do in the start that wears most."""
    stated = starting()
    scene = SimpleNamespace(journal=stated.candidate.journal)
    worn = Number(2.0, "µm", place="N", case="start")
    monkeypatch.setattr(wear_bands, "rubbing_of", lambda *about: stated.rubbing)

    def told(**errors):
        manifest = {"expected_errors": {"journal.film": errors}}
        return with_error(SimpleNamespace(scene=scene, folder=None, manifest=manifest), worn)

    alone = told()
    assert alone.error == BATCHES - 1
    assert "error of films not counted" in alone.note
    some, more = (told(**{"minimum film": error}).error for error in (0.1, 0.3))
    assert BATCHES - 1 < some < more
    assert with_error(None, replace(worn, value=0.0)).value == 0
    monkeypatch.setattr(Rubbing, "energy", lambda self, options: 0.0)
    nothing = told(**{"minimum film": 0.1})
    assert nothing.error == BATCHES - 1
    assert "error of films not counted" in nothing.note


def test_a_band_ends_where_a_quantity_cannot_go_on():
    share = Number(99.0, "%")
    wide = _banded(share, [("oil grade", -0.5, 2.0), ("clearance", -0.1, 0.1)], 100.0)
    assert (wide.tolerance_low, wide.tolerance_high) == (pytest.approx(98.49, abs=0.01), 100.0)
    assert wide.tolerance == "oil grade"
    film = _banded(Number(4.0, "µm"), [("clearance", -5.0, 1.0)], math.inf)
    assert (film.tolerance_low, film.tolerance_high) == (0.0, 5.0)
    over = _as_share(Number(1.98, "×"), wide)
    assert over.tolerance_high == pytest.approx(2.0)  # of two rows


def test_oil_of_rolling_bearings_is_as_thin_as_its_grade_allows():
    stated = built(rolling={"arrangement": "two-spherical"})
    thin, thick = only(stated, viscosity=0.1).ends
    ratio = [
        float(viscosity_ratio(lubrication(one.friction), 1.2, 1.0)) for one in (thin, stated, thick)
    ]
    assert np.divide(ratio, ratio[1]) == pytest.approx([0.9, 1.0, 1.1], rel=1e-6)


def test_preload_is_changed_and_moments_turn_what_cannot_tilt_alone():
    pair = built(rolling={"arrangement": "cylindrical-tapered"})
    end = only(pair, clearance=3e-5).ends[1]
    for before, after in zip(
        pair.candidate.rolling.geometries.values(), end.candidate.rolling.geometries.values()
    ):
        assert after.clearance - before.clearance == pytest.approx(3e-5)
    askew = only(pair, alignment=1e-4)
    pressure = [cheap_numbers(one)["contact_pressure"] for one in (askew.stated, *askew.ends)]
    assert max(pressure[1:]) > pressure[0]
    free = built(rolling={"arrangement": "two-spherical"})
    assert not [*tolerances_of(free, AsBuilt(**(NONE | {"alignment": 1e-4})))]


def test_tolerances_of_values_count_in_place_of_those_assumed():
    stated = journal()
    own = {"N": {"geometry.relative_clearance": 1e-4}}
    toleranced = replace(stated, candidate=stated.candidate.model_copy(update={"tolerances": own}))
    first, *others = tolerances_of(toleranced, AsBuilt(alignment=0.0))
    assert first.name == "geometry.relative_clearance"
    ends = [end.candidate.journal.at("N").geometry.relative_clearance for end in first.ends]
    assert ends == pytest.approx([0.9e-3, 1.1e-3])
    assert all(end.candidate.journal.at("N2").geometry.relative_clearance == 1e-3
               for end in first.ends)  # fmt: skip
    assert [one.name for one in others] == ["oil grade", "oil temperature", "roughness"]


def test_samples_that_decide_move_numbers_as_all_samples_do():
    heat = {"oil": "mineral-vg-320", "inlet_temperature": 318.0}
    stated = built(journal={"bearings": ["N", "N2"], "geometry": MEASURES, "heat": heat})
    oil = only(stated, viscosity=0.1)
    known, deciding = Known().of(stated)
    whole = cheap_numbers(stated)
    for end in oil.ends:
        full, few = cheap_numbers(end), cheap_numbers(end, deciding)
        for name in ("minimum_film", "film_pressure", "load_factor", "friction"):
            moved = full[name] / whole[name]
            assert few[name] / known[name] == pytest.approx(moved, abs=3e-3), name


def test_of_samples_the_hardest_and_those_that_last_are_kept():
    stated = journal()
    wider = xr.concat([stated.spectrum["N"].to_dataset()] * 4, "sample", data_vars="minimal")
    weight = np.r_[0.3, np.full(15, 0.7 / 15)]
    films = films_of(
        fast_journal(stated.candidate.journal.at("N")), wider.assign(weight=("sample", weight))
    )
    kept = deciding_of(films)
    assert {films.thin, films.hard, 0} <= set(kept.places.tolist())
    assert kept.places.size < 8
    assert float(kept.films.samples["weight"].sum()) == pytest.approx(1.0)
