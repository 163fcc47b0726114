"""An effect is one object and one row: the plan counts and chooses it, the pilot measures it."""

import json
import tomllib
from dataclasses import replace

import numpy as np
import pytest
from synthetic import cube_file

import loadflow as lf
from loadflow.cli import main
from loadflow.cli.lists import LISTS
from loadflow.errors import InputError, SolverError
from loadflow.planning.effects import EffectVerdict, switched
from loadflow.planning.ladder import expected_seconds
from loadflow.planning.pilot import (
    EFFORTS,
    Questions,
    _all_on,
    effort_for,
    hardest,
    measure,
    pilot,
)
from loadflow.planning.plan import make_plan, needed_stages
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages import registry, statistics
from loadflow.stages.effects import film, film_heat, film_tilt, rotor
from loadflow.stages.effects import registry as effects
from loadflow.stages.effects.effect import Effect
from loadflow.stages.effects.film_costs import COSTS
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.effects.roller_profile import SLICED_COSTS
from loadflow.stages.effects.rolling import RINGS
from loadflow.stages.effects.situation import situation
from loadflow.stages.probes import PROBES, Probe
from loadflow.stages.registry import STAGES
from loadflow.stages.stage import Rungs, Stage, always, with_settings


@pytest.fixture(scope="module")
def cube(tmp_path_factory):
    folder = tmp_path_factory.mktemp("effects")
    return cube_file(folder / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=500)


def scene_of(cube, **keys):
    loads = {"files": [str(cube)]}
    return make_scene({"name": "effects", "loads": loads, "results": ["journal.film"]} | keys)


def effect_in(plan, name):
    return next(effect for effect in plan.effects if effect.name == name)


# --- one object and one row -------------------------------------------------------------------

# a toy: oil that is half as thick, "in" by the seed of the reduction being odd
TOY = Effect(
    "odd seed",
    model="reduction",
    keys=("reduction.seed",),
    is_on=lambda scene: scene.reduction.seed % 2 == 1,
    switched=lambda scene, on: with_settings(scene, "reduction", {"seed": int(on)}),
    indicator=lambda at: {"largest load": 0.2},
    out="the seed is even",
    needs="an odd seed",
)


def test_a_toy_effect_is_counted_chosen_and_measured_by_one_row(cube, monkeypatch):
    effects.EFFECTS.append(TOY)
    try:
        check_toy_effect(cube, monkeypatch)
    finally:
        effects.EFFECTS.remove(TOY)


def check_toy_effect(cube, monkeypatch):
    wanted = {"results": ["reduction.histogram"]}
    plan = make_plan(scene_of(cube, **wanted))
    assert plan.scene.reduction.seed == 1  # 20 % are more than 5 %
    assert effect_in(plan, "odd seed").why.endswith("or it takes 2 % of the time or less")
    named = make_plan(scene_of(cube, reduction={"seed": 0}, **wanted))
    assert not effect_in(named, "odd seed").kept
    assert named.errors["reduction.histogram"]["largest load"] == pytest.approx(0.2, abs=0.02)
    helps = "what would help: leave reduction.seed to the plan"
    assert f"odd seed left out; {helps}" in named.shortfalls[0]

    def answers(scene, case, inputs):
        return {("N", "largest load"): 1.0 if TOY.is_on(scene) else 0.99}

    monkeypatch.setitem(PROBES, "reduction", Probe((), answers))
    verdict = pilot(scene_of(cube, **wanted))
    assert verdict.sizes["odd seed"] == {"largest load": pytest.approx(0.01)}
    measured = make_plan(scene_of(cube, **wanted), verdict=verdict)
    assert effect_in(measured, "odd seed").size == {"largest load": pytest.approx(0.01)}
    assert measured.accurate


def test_an_effect_that_series_can_mute_is_never_asked_to_be_out(cube, monkeypatch, request):
    asked = []

    def answers(scene, case, inputs):
        asked.append(TOY.is_on(scene))
        return {("N", "largest load"): inputs.get("toy", 1.0)}

    muted = replace(TOY, muted=lambda scene: lambda given: {**given, "toy": 0.98})
    EFFECTS.append(muted)
    request.addfinalizer(lambda: EFFECTS.remove(muted))
    monkeypatch.setitem(PROBES, "reduction", Probe((), answers))
    scene = scene_of(cube, results=["reduction.histogram"], reduction={"seed": 1})
    questions = Questions(scene, ("odd seed",), 60.0, ())
    found = measure(questions, list_cases(scene)[0])
    assert found.sizes["odd seed"] == {"largest load": pytest.approx(0.02)}
    assert asked == [True, True]


def test_a_toy_stage_with_a_toy_rung_runs_by_one_row(cube, tmp_path, request):
    """It gives the result of another stage, by half of its numbers."""

    def half(scene, case, inputs):
        return 0.5 * statistics.statistics(scene, case, inputs)

    toy = Stage(
        "toy",
        run=half,
        results={"loads.statistics": registry.STAGES["statistics"].results["loads.statistics"]},
        needs=always("loads", "shaft"),
        models=(Rungs("toy", section="loads", key=lambda scene: "coarse"),),
        summarise=statistics.summary,
        warnings=lambda tree: ["toy: only half"],
    )
    plain = scene_of(cube, accuracy="given", results=["loads.statistics"])
    whole = lf.run(plain, out=tmp_path / "whole", report=False).tree["statistics"]
    known = dict(registry.STAGES)
    request.addfinalizer(lambda: (registry.STAGES.clear(), registry.STAGES.update(known)))
    del registry.STAGES["statistics"]  # put back in its place among the others, as order is theirs
    registry.STAGES["toy"] = toy
    plan = make_plan(plain)
    assert [step.name for step in plan.steps] == ["loads", "shaft", "toy"]
    assert plan.steps[-1].rung == "coarse"
    assert plan.steps[-1].seconds is None  # not measured, and said so
    run = lf.run(plain, out=tmp_path, report=False)
    given, ours = (tree["hub_force"].values for tree in (whole, run.tree["toy"]))
    assert ours == pytest.approx(0.5 * given)
    assert "toy: only half" in run.warnings


# --- switching --------------------------------------------------------------------------------


@pytest.mark.parametrize("effect", effects.EFFECTS, ids=lambda effect: effect.name)
def test_an_effect_is_in_or_out_as_it_is_switched(effect, cube):
    scene = scene_of(cube, results=["journal.film", "rolling.loads"])
    for on in (True, False):
        changed = switched(scene, effect, on)
        if changed is not None:
            assert effect.is_on(changed) == on
            back = switched(changed, effect, not on)
            assert back is None or effect.is_on(back) != on


GROOVE = {"angle": 3.14, "length": 0.5, "pressure": 6e5}
CIRCLE = {"supply": {"grooves": [GROOVE | {"shape": "circle"}]}}


@pytest.mark.parametrize(
    ("effect", "known", "unknown", "said"),
    [
        (
            film.SUPPLY,
            {"supply": {"grooves": [GROOVE | {"arc": 0.3}]}},
            CIRCLE,
            "rectangular ones, each on one segment",
        ),
    ],
    ids=["supply"],
)
def test_a_rung_that_knows_a_part_of_an_effect_is_listed_with_that_part(
    effect, known, unknown, said
):
    def scene(tables, rung):
        return make_scene({"journal": {**tables, "rung": rung}})

    assert effect.known_by(scene(known, "reduced"))
    assert effect.known_by(scene(unknown, "grid"))
    with pytest.raises(InputError, match="reduced"):
        scene(unknown, "reduced")
    heads, rows = LISTS["effects"]()
    (row,) = (row for row in rows if row[0] == effect.name)
    label = dict(zip(heads, row))["known by rungs"]
    assert label.startswith("grid, reduced (")
    assert said in label


def test_a_film_is_warmed_by_an_oil_that_enters_with_the_stated_viscosity(cube):
    scene = scene_of(cube, journal={"lubricant": {"viscosity": 0.07, "density": 900.0}})
    heat = switched(scene, film_heat.HEAT, True).journal.heat
    assert heat.lubricant(heat.inlet_temperature).viscosity == pytest.approx(0.07, rel=0.02)
    assert heat.lubricant(heat.inlet_temperature + 20).viscosity < 0.04


@pytest.mark.parametrize("heat", [{}, {"kind": "film"}, {"growth": {"shell_expansion": 0.0}}])
def test_a_film_without_heat_has_the_oil_and_the_clearance_with_which_it_enters(cube, heat):
    """Else what heat seems to change is what another oil does."""
    given = {"oil": "iso-vg-220", "inlet_temperature": 318.15, **heat}
    journal = scene_of(cube, journal={"heat": given}).journal
    cool = film_heat._with_heat(journal, on=False)
    assert cool.heat is None
    assert cool.lubricant == journal.heat.lubricant(318.15)
    assert cool.lubricant.viscosity > 0.1
    narrow = "growth" in heat  # the shaft alone grows
    assert (cool.geometry.clearance < journal.geometry.clearance) == narrow
    stated = scene_of(cube, journal={"lubricant": {"viscosity": 0.2}})
    there = switched(stated, film_heat.HEAT, True)
    back = switched(there, film_heat.HEAT, False).journal
    assert back.lubricant.viscosity == pytest.approx(0.2, rel=1e-12)


def test_a_shaft_that_stands_at_times_has_its_film_at_rest():
    data = {"name": "start", "results": ["journal.film"], "loads": {"dlc": "3.1"}}
    plan = make_plan(make_scene(data))
    assert not effect_in(plan, "motion of the film").kept
    assert plan.errors["journal.film"]["minimum film"] > 0.05
    assert plan.shortfalls


# --- indicators -------------------------------------------------------------------------------


def test_indicators_grow_with_what_they_stand_for():
    def size(effect, quantity, **keys):
        scene = make_scene({"name": "s", "loads": {"wind_speeds": [12.0], "seeds": 1}} | keys)
        return effect.indicator(situation(scene, list_cases(scene)))[quantity]

    thin, thick = (
        {"journal": {"lubricant": {"viscosity": viscosity}}} for viscosity in (0.02, 0.08)
    )
    assert size(film_heat.HEAT, "friction power", **thick) > size(
        film_heat.HEAT, "friction power", **thin
    )
    assert size(film_tilt.TILT, "minimum film", **thin) > size(
        film_tilt.TILT, "minimum film", **thick
    )
    assert size(film.CONTACT, "minimum film", **thick) == 0.0
    held, free = (
        {"journal": {"heat": {"growth": {"shell_expansion": expansion}}}}
        for expansion in (0.0, 11.7e-6)
    )
    assert size(film_heat.GROWTH, "minimum film", **free) == 0.0  # steel in steel, as warm
    assert size(film_heat.GROWTH, "minimum film", **held) > 0.1
    stated = {"journal": {"heat": {}}}
    assert 0.0 < size(film_heat.GROWTH, "minimum film", **stated) < 0.5
    worn = {"journal": {"lubricant": {"viscosity": 2e-5}}}
    assert size(film.CONTACT, "minimum film", **worn) > 0.0
    soft = {"journal": {"shell": {"kind": "local", "compliance": 1e-10}}}
    steel = {"journal": {"shell": {"kind": "local", "compliance": 1e-12}}}
    assert size(film.SHELL, "maximum pressure", **soft) > size(
        film.SHELL, "maximum pressure", **steel
    )


def test_the_shell_indicator_has_the_size_of_the_solved_films():
    """docs/journal-shell.md: 1e-10 m/Pa takes 8 % of the film and 7 % of the pressure."""
    scene = make_scene(
        {
            "name": "s",
            "loads": {"wind_speeds": [24.0], "seeds": 1},
            "journal": {"shell": {"kind": "local", "compliance": 1e-10}},
        }
    )
    sizes = film.SHELL.indicator(situation(scene, list_cases(scene)))
    assert 0.03 < sizes["minimum film"] < 0.3


# --- the pilot --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def verdict(cube):
    return pilot(scene_of(cube))


def test_the_pilot_measures_what_the_plan_then_counts(cube, verdict):
    assert set(verdict.sizes) >= {"motion of the film", "heat of the film"}
    for sizes in verdict.sizes.values():
        assert all(0 <= size < 10 for size in sizes.values())
    plan = make_plan(scene_of(cube), verdict=verdict)
    still = make_plan(scene_of(cube, journal={"motion": "quasi-static"}), verdict=verdict)
    for quantity, size in verdict.sizes["motion of the film"].items():
        more = still.errors["journal.film"][quantity] - plan.errors["journal.film"][quantity]
        assert more > 0.5 * size
    motion = effect_in(plan, "motion of the film")
    assert motion.size == verdict.sizes["motion of the film"]


def test_the_pilot_says_the_same_again(cube, verdict):
    again = pilot(scene_of(cube))
    assert replace(again, seconds=0.0) == replace(verdict, seconds=0.0)
    assert EffectVerdict.from_json(json.loads(json.dumps(verdict.to_json()))) == verdict


def test_a_series_shorter_than_what_it_takes_to_settle_is_measured_too(tmp_path):
    short = cube_file(tmp_path / "loads.h5", wind_speeds=(8.0,), seeds=(1,), steps=50)
    found = pilot(scene_of(short))
    assert 0 < found.sizes["motion of the film"]["minimum film"] < 10


def test_models_as_given_need_no_pilot(cube):
    assert pilot(scene_of(cube, accuracy="given")) is None


def test_the_pilot_looks_where_steady_load_per_speed_and_largest_load_are():
    scene = make_scene({"name": "s", "loads": {"wind_speeds": [4.0, 12.0, 24.0], "seeds": 2}})
    cases = hardest(scene, tuple(list_cases(scene)))
    assert [case.wind_speed for case in cases] == [4.0, 24.0]
    assert all(case.seed == 1 for case in cases)


def test_a_short_run_has_a_short_pilot():
    """What it may take follows from the ladder, so that no clock decides what a run finds."""
    speeds = [8.0, 12.0, 18.0]
    lengths = [(2, 60.0), (2, 400.0), (20, 600.0)]
    found = []
    for seeds, duration in lengths:
        loads = {"wind_speeds": speeds, "seeds": seeds, "duration": duration}
        scene = make_scene({"name": "look", "results": ["journal.film"], "loads": loads})
        cases = tuple(list_cases(scene))
        rotor = [effect for effect in EFFECTS if effect.model == "loads"]
        found.append(effort_for(scene, rotor, cases))
    assert found == [*reversed(EFFORTS)]


def test_a_run_remembers_its_pilot_and_gives_the_same_on_two_processes(cube, tmp_path):
    beam = {"sections": [{"outer_diameter": 3.0, "inner_diameter": 2.7}]}
    keys = {"journal": {"bearings": ["N2"]}, "shaft": {"two_point": {"beam": beam}}}
    one = lf.run(scene_of(cube, **keys), out=tmp_path / "one", report=False)
    manifest = json.loads((one.path / "manifest.json").read_text(encoding="utf-8"))
    assert manifest["pilot"]["sizes"]
    sizes = {effect["name"]: effect["size"] for effect in manifest["effects"]}
    assert sizes["tilt of the shaft"] == manifest["pilot"]["sizes"]["tilt of the shaft"]
    again = lf.run(scene_of(cube, **keys), out=tmp_path / "one", report=False)
    after = json.loads((again.path / "manifest.json").read_text(encoding="utf-8"))
    assert after["pilot"] == manifest["pilot"]  # taken up, not measured anew
    two = lf.run(scene_of(cube, **keys), out=tmp_path / "two", workers=2, report=False)
    other = json.loads((two.path / "manifest.json").read_text(encoding="utf-8"))
    # a kernel that was just compiled and the same out of its file may differ in the last digits
    sizes, found = (run["pilot"]["sizes"] for run in (manifest, other))
    assert sizes.keys() == found.keys()
    for effect, each in sizes.items():
        assert found[effect] == pytest.approx(each, rel=1e-6)
    for before, after in zip(manifest["effects"], other["effects"], strict=True):
        assert (after["size"] or {}) == pytest.approx(before["size"] or {}, rel=1e-6)
        assert after | {"size": None} == before | {"size": None}
    assert one.tree["journal"].to_dataset().equals(two.tree["journal"].to_dataset())


# --- command line -----------------------------------------------------------------------------


def planned(scene, capsys, *options):
    with pytest.raises(SystemExit) as ended:
        main(["plan", str(scene), *options])
    assert ended.value.code == 0
    return capsys.readouterr().out


def keys_of(data):
    if isinstance(data, dict):
        for key, value in data.items():
            yield key
            yield from keys_of(value)
    elif isinstance(data, list):
        for value in data:
            yield from keys_of(value)


def test_plan_shows_indicators_and_with_pilot_the_measured_sizes(cube, tmp_path, capsys):
    scene = tmp_path / "s.toml"
    scene.write_text(f'results = ["journal.film"]\n[loads]\nfiles = ["{cube}"]\n', encoding="utf-8")
    told = json.loads(planned(scene, capsys, "--json"))
    assert all(effect["size"] is None for effect in told["effects"])
    assert {"name", "kept", "size", "indicator"} <= set(told["effects"][0])
    assert not any("error" in key for key in keys_of(told["effects"]))
    assert set(told["errors"]) == {"journal.film"}
    measured = json.loads(planned(scene, capsys, "--json", "--pilot"))
    sizes = {effect["name"]: effect["size"] for effect in measured["effects"]}
    assert sizes["motion of the film"]["eccentricity ratio"] > 0
    text = " ".join(planned(scene, capsys).split())
    assert text.startswith("not accurate enough: journal.film") == (not told["accurate"])
    assert "--pilot measures them" in text


def test_needed_stages_follow_from_what_each_stage_needs(cube):
    moving = scene_of(cube, journal={"motion": "transient"})
    assert needed_stages(moving) == {"loads", "shaft", "journal"}
    still = scene_of(cube, journal={"motion": "quasi-static"})
    assert needed_stages(still) == {"loads", "shaft", "reduction", "journal"}


def test_bearings_of_different_size_are_put_in_motion_together(cube):
    other = {"geometry": {"diameter": 2.0, "width": 1.2, "relative_clearance": 1e-3}}
    bearings = {"N": {"kind": "journal"}, "N2": {"kind": "journal"} | other}
    data = {"name": "two", "loads": {"files": [str(cube)]}, "results": ["journal.film"]}
    scene = make_scene(data | {"bearings": bearings})
    moving = switched(scene, film.MOTION, True)
    assert moving.journal.at("N2").geometry.diameter == 2.0
    assert {moving.journal.at(place).motion for place in ("N", "N2")} == {"transient"}
    again = make_scene(tomllib.loads(moving.to_toml()))
    assert again.journal.at("N2").motion == "transient"
    assert again.digest() == moving.digest()
    stated = {"N": {"kind": "journal"}, "N2": {"kind": "journal", "motion": "transient"} | other}
    with pytest.raises(InputError, match="all journal bearings of a scene have one"):
        make_scene(data | {"bearings": stated})


# --- elastic rings ----------------------------------------------------------------------------
TAPERED = {
    "kind": "roller", "rollers": 60, "rows": 2, "roller_diameter": 0.085, "roller_length": 0.12,
    "pitch_diameter": 2.5, "contact_angle": 0.7, "row_spacing": 0.3, "slices": 6,
    "clearance": -50e-6,
}  # fmt: skip
OUTER = {"section": {"width": 0.15, "height": 0.5}, "radius": 1.36}


def test_elastic_rings_of_rollers_are_switched_on_where_sections_are_stated(cube):
    rings = next(effect for effect in effects.EFFECTS if effect.name == "elastic rings")
    part = {"bearing": "M", "geometry": TAPERED}
    keys = {"results": ["rolling.life"], "shaft": {"moment": {}}}
    without = scene_of(cube, rolling=part, **keys)
    assert rings.switched(without, True) is None
    assert "four-point" not in rings.needs
    scene = scene_of(cube, rolling=part | {"outer_ring": OUTER}, **keys)
    on = rings.switched(scene, True)
    assert on.rolling.ring_model.outer.radius == OUTER["radius"]
    assert rings.switched(on, False).rolling.ring_model == "rigid"
    # what free rings do to the bearing of the main job, at most
    for one in (without, scene):
        size = rings.indicator(situation(one, list_cases(one)))
        assert 0.2 < size["life"] <= 0.28
        assert 0.15 < size["maximum force"] <= 0.21


def test_inertia_that_changes_nothing_is_not_taken_for_friction_alone():
    """It would cost a thousand times the load distribution that friction makes for itself."""
    balls = {"balls": 60, "ball_diameter": 0.06, "pitch_diameter": 1.5, "groove_radius": 0.0312}
    scene = make_scene(
        {
            "name": "balls",
            "results": ["rolling.friction"],
            "loads": {"dlc": "1.1", "wind_speeds": [12.0], "seeds": 1},
            "bearings": {"N": {"kind": "ball", "geometry": balls}},
        }
    )
    assert not make_plan(scene).scene.rolling.inertia
    spun = scene.model_copy(update={"rolling": scene.rolling.model_copy(update={"inertia": True})})
    seconds = [expected_seconds(one, "friction", list_cases(one)) for one in (scene, spun)]
    assert seconds[1] > 10 * seconds[0]


def test_friction_is_timed_with_rigid_rings_and_rollers_in_slices():
    scene = make_scene(
        {"name": "rollers", "results": ["rolling.friction"], "bearings": ["tapered-pair"]}
    )
    known = {"flexible": 3e-4, "rigid": 2e-5}

    def measured(scene, model, key=None):
        own = SLICED_COSTS[scene.rolling.rung] * known[scene.rolling.rung]
        return {"seconds_per_sample": own if key is None else known[key]}

    bent = switched(scene, RINGS, True)
    rigid, flexible = (STAGES["friction"].more_seconds(one, measured) for one in (scene, bent))
    assert rigid == pytest.approx(0.0, abs=1e-12)
    assert flexible > 0.0


def test_elastic_rings_are_switched_on_in_every_bearing_that_has_sections(cube):
    rings = next(effect for effect in effects.EFFECTS if effect.name == "elastic rings")
    spherical = {
        "kind": "spherical", "rollers": 30, "roller_diameter": 0.09, "roller_length": 0.14,
        "pitch_diameter": 1.0, "contact_angle": 0.21,
    }  # fmt: skip
    ring = {"section": {"width": 0.1, "height": 0.3}, "radius": 0.6}
    parts = [
        {"bearing": "N", "geometry": spherical},
        {"bearing": "N2", "geometry": spherical, "outer_ring": ring},
    ]
    scene = scene_of(cube, results=["rolling.life"], rolling=parts)
    on = rings.switched(scene, True)
    assert [part.rings for part in on.rolling.bearings.values()] == ["rigid", "flexible"]
    off = rings.switched(on, False)
    assert [part.rings for part in off.rolling.bearings.values()] == ["rigid", "rigid"]


def test_wind_without_coherence_of_its_lateral_parts_is_counted_and_no_plan_chooses_it():
    def planned(**loads):
        given = {"source": "simulate", "wind_speeds": [24.0], "seeds": 1, "duration": 60.0} | loads
        return make_plan(
            make_scene(
                {"name": "wind", "loads": given, "results": ["loads.statistics"], "accuracy": 0.5}
            )
        )

    usual, apart = planned(), planned(lateral="independent")
    assert effect_in(usual, "coherence of lateral turbulence").kept
    left = effect_in(apart, "coherence of lateral turbulence")
    assert not left.kept
    errors = [plan.errors["loads.statistics"]["bearing force DEL"] for plan in (usual, apart)]
    assert errors[1] - errors[0] == pytest.approx(left.indicator["bearing force DEL"])
    assert left.indicator["bearing force DEL"] == pytest.approx(rotor.COHERENCE)


def test_the_cost_of_an_effect_of_a_film_is_that_of_its_rung_and_motion(cube):
    def cost(**journal):
        return film_tilt.TILT.cost(scene_of(cube, journal=journal))

    assert cost(rung="reduced", motion="transient") == COSTS["tilt"]["reduced"][1]
    assert cost(rung="grid") == COSTS["tilt"]["grid"][0]
    assert cost(rung="map") == 1.0


def _of_groove(tmp_path, **groove):
    data = {
        "shaft": {"two_point": {}},
        "loads": {"files": [str(cube_file(tmp_path / "loads.h5", steps=200))]},
        "journal": {"bearings": ["N"], "supply": {"grooves": [{"pressure": 6e5} | groove]}},
        "results": ["journal.film"],
    }
    scene = make_scene(data)
    return film.SUPPLY.indicator(situation(scene, list_cases(scene)))["minimum film"]


def test_a_groove_takes_of_the_film_what_its_arc_and_its_pair_do(tmp_path):
    around = [_of_groove(tmp_path, angle=a, arc=2 * np.pi, length=0.1) for a in (0.0, np.pi)]
    assert min(around) > 0.0
    assert around[0] == pytest.approx(around[1])
    aside = {"angle": 0.0, "length": 0.3}
    narrow, wide = (_of_groove(tmp_path, **aside, arc=arc) for arc in (0.2, 2.0))
    assert wide > narrow
    assert _of_groove(tmp_path, **aside, arc=2.0, axial=0.4) > wide
    assert _of_groove(tmp_path, **aside, shape="circle") > 0


def test_what_a_scene_states_stays_on_where_it_does_not_go_with_what_a_plan_may_take():
    """A table that is left out cannot be made up again: it is not measured without a word."""
    shell = {"kind": "local", "compliance": 1e-11}
    journal = {"shell": shell, "motion": "transient", "rung": "reduced"}
    scene = make_scene({"name": "s", "loads": {"wind_speeds": [12.0]}, "journal": journal})

    def answers(one):
        if one.journal.in_motion and one.journal.shell is not None:
            raise SolverError("not together")
        return {("N", "minimum film"): 1.0}

    refused = {}
    together, best = _all_on(scene, [film.SHELL, film.MOTION], answers, refused)
    assert film.SHELL.is_on(together)
    assert not film.MOTION.is_on(together)
    assert refused == {film.MOTION.name: "not together"}
    assert best == {("N", "minimum film"): 1.0}
