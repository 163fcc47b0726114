"""A shaft tilts in the clearances of its journal bearings: estimated, counted, and taken back."""

import json
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from synthetic import cube_file

from benchmarks.ladder.physics import kept_so_far
from benchmarks.ladder.physics_sizes import in_clearances
from loadflow.cube import make_case
from loadflow.errors import InputError, SolverError
from loadflow.planning import pilot
from loadflow.planning.asked import resting
from loadflow.planning.choice import sections
from loadflow.planning.effects import Estimates
from loadflow.planning.pilot import Questions, measure
from loadflow.planning.plan import make_plan
from loadflow.scene.cases import Case, list_cases
from loadflow.scene.scene import make_scene
from loadflow.scene.shaft_place import floating, move_together
from loadflow.scene.thrust import Thrust
from loadflow.stages import bores, thrust
from loadflow.stages import shaft as shaft_stage
from loadflow.stages.effects import clearances
from loadflow.stages.effects.clearances import (
    CLEARANCES,
    closed_ends,
    ends_afloat,
    slopes,
    usual_slope,
)
from loadflow.stages.effects.film import MOTION
from loadflow.stages.effects.film_heat import HEAT
from loadflow.stages.effects.film_tilt import TILT
from loadflow.stages.effects.joint_motion import TOGETHER
from loadflow.stages.effects.shaft import STIFFNESS
from loadflow.stages.effects.situation import situation
from loadflow.stages.frames import from_film
from loadflow.stages.probes import Probe
from loadflow.stages.registry import STAGES, models
from loadflow.stages.shaft import bearing_loads

FLOATS = [{"stiffness": "journal"}, {"stiffness": "journal"}]


def scene_of(supports=(), beam=True, loads=None, **journal):
    sections = [{"outer_diameter": 3.0, "inner_diameter": 1.5}]
    stated = {"beam": {"sections": sections, "supports": list(supports)}} if beam else {}
    film = {"tilt": True, "geometry": {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}}
    return make_scene(
        {
            "name": "floats",
            "results": ["journal.film"],
            "loads": {"wind_speeds": [8.0, 12.0], "seeds": 1} | (loads or {}),
            "shaft": {"two_point": stated},
            "journal": film | journal,
        }
    )


def estimated(scene):
    return situation(scene, list_cases(scene))


def at_usual_loads(scene):
    """The shaft stage under the loads that bores are aligned at, and the weight of each."""
    usual = bores.usual_loads(scene)
    series = xr.Dataset(
        {
            "hub_force": (("axis", "time"), usual.force),
            "hub_moment": (("axis", "time"), usual.moment),
            "speed": ("time", usual.speed),
        },
        {"axis": ["x", "y", "z"], "time": np.arange(float(usual.speed.size))},
    )
    return bearing_loads(scene, Case("1.1", 12.0, 1), {"loads": series}), usual


def test_closed_charts_have_the_slope_of_solved_films():
    """In size, by a third; charts know no pressure beside the bearing, which turns the place."""
    scene = scene_of(FLOATS)
    at = estimated(scene)
    ((_, concept, names),) = floating(scene.shaft, scene.journal)
    slope, places = slopes(at, concept, names)
    assert all((place.film > 0).all() for place in places.values())
    pushed = np.array([[0, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], dtype=float)
    for way, estimate in zip(pushed, np.linalg.norm(slope, axis=-1)):
        forces = [
            at.bearings[name].force + sign * way * at.bearings[name].swing[:, None]
            for sign, name in zip((1.0, -1.0), names)
        ]
        loads = xr.Dataset({"force": (("bearing", "time", "axis"), forces)}, {"bearing": names})
        solved = bores.slope_in_clearances(scene, concept, names, loads, at.speed)
        np.testing.assert_allclose(np.linalg.norm(solved, axis=-1), estimate, rtol=0.35, atol=5e-5)


def test_what_a_slope_closes_grows_with_clearance_and_with_bores_that_are_turned_away():
    def most(clearance=1e-3, **journal):
        film = {"diameter": 3.0, "width": 2.25, "relative_clearance": clearance}
        return closed_ends(estimated(scene_of(geometry=film, **journal)))["N"]

    assert most(5e-4) < most() < most(alignment=[0.0, 3e-4])


def test_loads_that_a_film_does_not_carry_leave_the_estimate_of_the_others():
    film = {"diameter": 0.8, "width": 0.22, "relative_clearance": 1e-3}
    at = estimated(scene_of(geometry=film, alignment="mean", lubricant={"viscosity": 0.01}))
    ((_, concept, names),) = floating(at.scene.shaft, at.scene.journal)
    missing = np.isnan(slopes(at, concept, names)[1]["N"].film)
    assert missing.any()
    assert not missing[0].any()
    assert all(np.isfinite([*closed_ends(at).values()]))
    assert all(np.isfinite([*CLEARANCES.indicator(at).values()]))


def test_a_plan_counts_the_tilt_in_the_clearances_until_films_are_fed_back():
    rigid, floats = (scene_of(part, motion="quasi-static") for part in ([], FLOATS))
    left, counted = make_plan(rigid), make_plan(floats)
    thin, thinner = (one.errors["journal.film"]["minimum film"] for one in (counted, left))
    assert thin < 1.0 < thinner  # what is left is the motion of films that are thin at their ends
    assert not left.accurate
    assert any(CLEARANCES.name in said for said in left.shortfalls)
    assert CLEARANCES.name in left.left_out
    assert CLEARANCES.name not in counted.left_out
    assert not any(CLEARANCES.name in said for said in counted.shortfalls)


def test_a_plan_feeds_films_back_where_the_accuracy_asks_for_it():
    scene = scene_of()
    plan = make_plan(scene)
    assert CLEARANCES.is_on(plan.scene)
    assert plan.scene.journal.tilt
    assert plan.accurate
    rough = make_plan(scene.model_copy(update={"accuracy": 1e6}))
    assert not CLEARANCES.is_on(rough.scene)


def test_a_plan_follows_a_shaft_on_tilting_pads_as_in_other_bores():
    bore = {"kind": "tilting pads", "count": 4, "arc": 1.3, "preload": 0.4, "angle": np.pi / 4}
    own = {"diameter": 2.0, "width": 1.2, "relative_clearance": 1e-3, "shape": bore}
    scene = scene_of(geometry=own)
    on = CLEARANCES.switched(scene, True)
    assert CLEARANCES.is_on(on)
    assert [move_together(on.shaft, on.journal, one) for one in on.shaft.concepts] == [True]
    assert not CLEARANCES.is_on(CLEARANCES.switched(on, False))


@pytest.mark.slow
@pytest.mark.parametrize("turbine", ["windpact-1.5mw", "nrel-5mw"])
def test_the_indicator_has_the_size_that_a_pilot_measures(turbine):
    """Sized bearings at 12 m/s, whose ends do not touch; the page has what is measured."""
    scene = in_clearances(turbine, 12.0)
    cases = tuple(list_cases(scene))
    sizes = measure(Questions(scene, (CLEARANCES.name,), 60.0, cases), cases[0]).sizes
    (kept,) = [
        one["sizes"]
        for one in kept_so_far()["clearances"]
        if (one["turbine"], one["speed"]) == (turbine, 12.0)
    ]
    assert sizes[CLEARANCES.name] == pytest.approx(kept[CLEARANCES.name], rel=0.05)
    indicated = CLEARANCES.indicator(estimated(scene))
    for quantity in ("minimum film", "maximum pressure"):
        ratio = sizes[CLEARANCES.name][quantity] / indicated[quantity]
        assert 1 / CLEARANCES.smaller < ratio < CLEARANCES.larger(scene)


def test_what_a_pilot_asks_after_films_it_asks_around_the_shaft_in_these_films(monkeypatch):
    """So collars beside journal bearings are tilted as their scene says."""
    pads = {"pads": 6, "inner_radius": 1.6, "outer_radius": 2.0, "pad_angle": 0.9, "taper": 1e-4}
    collar = {"kind": "thrust", "geometry": pads, "lubricant": {"viscosity": 0.2}}
    collar |= {"self_aligning": True}
    scene = scene_of(motion="transient", rung="reduced").model_copy(
        update={"thrust": Thrust(bearings={"N2": collar})}
    )
    asked = []

    def lies_in(scene, case, inputs):
        return sorted(scene.shaft.coupled)

    def answers(scene, case, inputs):
        asked.append((lies_in(scene, case, inputs), inputs["shaft"]))
        return {("N2", "minimum film"): 1.0}

    for name, run in (("loads", lambda *about: None), ("shaft", lies_in)):
        monkeypatch.setitem(STAGES, name, replace(STAGES[name], run=run))
    probe = Probe(("loads", "shaft"), answers)
    probes = {"journal": probe, "thrust": replace(probe, around_shaft=True)}
    monkeypatch.setattr(pilot, "PROBES", probes)
    names = (CLEARANCES.name, "heat of the collar")
    measure(Questions(scene, names, 60.0, ()), list_cases(scene)[0])
    assert {tuple(lies) for lies, _ in asked} == {(), ("N", "N2")}
    assert asked[-1][0] == ["N", "N2"]
    for lies, found in asked:
        assert lies == found


@pytest.mark.filterwarnings("ignore:shaft and films in motion")
def test_a_pilot_of_films_that_follow_their_shaft_follows_none_besides(monkeypatch):
    """What it reads of the stage of the shaft tells it which stretch is asked, and no more."""
    followed = []

    def on_films(scene, concept, loads, tilt):
        followed.append(concept)
        raise SolverError("followed")

    monkeypatch.setattr(shaft_stage, "shaft_on_films", on_films)
    steps = np.arange(200)
    vectors = np.tile([[4e5], [0.0], [-2e6]], steps.size)
    data = {"speed": np.full(steps.size, 1.2), "hub_force": vectors, "hub_moment": 0.0 * vectors}
    loads = make_case(0.025 * steps, data, dlc="1.1", wind_speed=8.0, seed=1)
    scene = scene_of(FLOATS, motion="transient", rung="reduced")
    read = []
    probe = Probe(("loads", "shaft"), lambda scene, case, inputs: read.append(inputs) or {})
    for around in (False, True):
        monkeypatch.setitem(pilot.PROBES, "journal", replace(probe, around_shaft=around))
        questions = Questions(scene, (HEAT.name,), 60.0, ())
        measure(questions, list_cases(scene)[0], {"loads": loads})
        assert bool(followed) == around
    assert all(one["shaft"]["force"].sizes["time"] == steps.size for one in read)


def test_a_shaft_in_films_is_another_one_where_these_are():
    """But for films at rest, which are asked around the shaft that is followed in motion."""
    moving, thin = ({"motion": "transient", "rung": "reduced"} | more
                    for more in ({}, {"lubricant": {"viscosity": 0.1}}))  # fmt: skip
    fed_back = [{"stiffness": "journal", "takes_moment": True}] * 2
    rest = moving | {"motion": "quasi-static"}
    assert resting(scene_of(**moving)) == resting(scene_of(**thin))
    own = resting(scene_of(fed_back, **moving))
    assert own != resting(scene_of(**moving))
    assert own != resting(scene_of(fed_back, **thin))
    assert own == resting(scene_of(fed_back, **rest))


def test_the_ends_of_a_film_close_down_to_where_surfaces_touch(monkeypatch):
    """In proportion to what they take of it at first, and no further than to that gap."""
    at = estimated(scene_of())
    film = np.full((5, 2), 20.0 * at.scene.journal.at("N").contact_film)

    def told(share):
        ends = {"N": clearances.Ends(np.full(film.shape, share), film)}
        monkeypatch.setattr(clearances, "ends_afloat", lambda at: ends)
        return CLEARANCES.indicator(at)["minimum film"]

    assert told(0.0) == pytest.approx(0.0, abs=1e-6)
    assert told(0.01) == pytest.approx(0.01, rel=0.02)
    assert told(1.0) == pytest.approx(np.expm1(2.0) / 2.0 - 1.0)
    assert told(9.0) == pytest.approx(19.0)


def test_it_is_the_scene_s_that_states_supports_and_needs_two_films_on_a_beam():
    assert CLEARANCES.is_open(scene_of())
    assert not CLEARANCES.is_open(scene_of(FLOATS))
    assert CLEARANCES.concerns(scene_of())
    assert not CLEARANCES.concerns(scene_of(beam=False))
    assert not CLEARANCES.concerns(scene_of(bearings=["N"]))
    assert not CLEARANCES.is_on(scene_of([*FLOATS[:1], {}]))
    held = CLEARANCES.switched(scene_of(FLOATS), False)
    assert not CLEARANCES.is_on(held)


def test_the_tilt_of_a_shaft_on_films_is_that_in_their_clearances():
    """So leaving tilt out of the films leaves all of it out."""
    bent, floats = (TILT.indicator(estimated(scene_of(part))) for part in ([], FLOATS))
    assert floats["minimum film"] > 2 * bent["minimum film"]


@pytest.mark.parametrize("supports", [[], FLOATS])
def test_bores_aligned_as_built_take_the_mean_tilt_to_zero(supports):
    scene = scene_of(supports, alignment="mean")
    found, usual = at_usual_loads(scene)
    for name in scene.journal.bearings:
        tilt = found["tilt"].sel(bearing=name).transpose("time", "axis").values
        mean = np.average(tilt, axis=0, weights=usual.weight)
        turned = found["alignment"].sel(bearing=name).values
        assert np.linalg.norm(turned) > 5e-7
        np.testing.assert_allclose(turned, mean, atol=0.02 * np.linalg.norm(mean))


def test_indicators_of_one_wind_speed_know_bores_that_follow_the_shaft_at_all():
    """Light wind does not align them: under its mean load an end loses half of its film and more.

    Of slope and bend, by solved films, the slope is nearly all at 15 MW.
    """
    scene = in_clearances("iea-15mw", 6.0)
    ((_, concept, names),) = floating(scene.shaft, scene.journal)
    built = bores.bores(CLEARANCES.switched(scene, True))
    for name in names:
        turned = usual_slope(scene, concept, names)
        np.testing.assert_allclose(turned, built[name], atol=0.15 * np.linalg.norm(built[name]))
    ends = ends_afloat(estimated(scene))["N"]
    assert ends.left(0.0)[0] < 0.5 * ends.film[0]


def test_a_bore_is_turned_as_stated_or_as_the_shaft_lies():
    stated = scene_of(alignment=[1e-4, -2e-5])
    assert {name: turn.tolist() for name, turn in bores.bores(stated).items()} == {
        name: from_film([1e-4, -2e-5]).tolist() for name in ("N", "N2")
    }
    told = at_usual_loads(stated)[0]["alignment"].transpose("bearing", "axis").values
    np.testing.assert_allclose(told, [from_film([1e-4, -2e-5])] * 2, rtol=1e-6)
    assert "alignment" not in at_usual_loads(scene_of())[0]
    one = scene_of(own={"N2": {"alignment": "mean"}})
    assert not np.any(bores.bores(one)["N"])
    assert np.any(bores.bores(one)["N2"])


@pytest.mark.parametrize("turned", ["mean", [1e-4, -2e-5]])
def test_pads_have_the_tilt_of_the_shaft_in_the_bore_that_they_stand_in(turned):
    scene = scene_of(alignment=turned, own={"N2": {"alignment": [0.0, 0.0]}})
    row = {"pads": 6, "inner_radius": 1.6, "outer_radius": 1.9, "pad_angle": 0.3, "taper": 8e-5}
    collar = {"kind": "thrust", "geometry": row, "play": 6e-4}
    collars = {"N": collar, "N2": collar}
    pads = make_scene(
        {
            "name": "pads",
            "results": ["thrust.film"],
            "shaft": {"two_point": {"beam": {}}},
            "thrust": {"tilt": True, "motion": "transient", "bearings": collars},
        }
    )
    found, usual = at_usual_loads(scene)
    loads = xr.Dataset({"speed": ("time", usual.speed)}, {"time": found["time"]})
    inputs = {"loads": loads, "shaft": found}
    for name, bore in bores.bores(scene).items():
        part = pads.thrust.bearings[name]
        told = thrust.samples_of(pads, Case("1.1", 12.0, 1), part, name, inputs)["tilt"]
        lies = found["tilt"].sel(bearing=name).transpose("time", "axis").values
        assert np.any(bore) == (name == "N")
        np.testing.assert_allclose(told.values.T, lies - bore, atol=1e-10)


def test_bores_are_those_of_all_load_cases_in_every_process():
    scene = scene_of(FLOATS, alignment="mean")
    other = scene_of(FLOATS, alignment="mean", loads={"wind_speeds": [8.0, 12.0]})
    ours = {name: turn.tolist() for name, turn in bores.bores(other).items()}
    bores._KNOWN.clear()
    assert ours == {name: turn.tolist() for name, turn in bores.bores(scene).items()}
    code = (
        "import json, sys; from loadflow.scene.scene import Scene\n"
        "from loadflow.stages import bores\n"
        "scene = Scene.model_validate_json(sys.stdin.read())\n"
        "print(json.dumps({name: turn.tolist() for name, turn in bores.bores(scene).items()}))"
    )
    told = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code],
        input=scene.model_dump_json(), capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert json.loads(told.stdout) == ours


def test_bores_follow_what_files_hold_and_not_their_names(tmp_path):
    path, found = tmp_path / "loads.h5", []
    for seed in (1, 2):
        cube_file(path, wind_speeds=(8.0,), seeds=(seed,), steps=200)
        scene = scene_of(alignment="mean", loads={"files": [str(path)]})
        found.append(bores.bores(scene)["N"])
    assert np.linalg.norm(found[1] - found[0]) > 1e-3 * np.linalg.norm(found[0]) > 0.0


def test_without_tilt_each_shaft_lies_straight_in_its_own_bore():
    """So a plan that asks what tilt is worth aligns each bearing by itself."""
    own = {"own": {"N2": {"alignment": [1e-4, -2e-5]}}, "rung": "reduced"}
    scene = scene_of(alignment="mean", **own)
    found, _ = at_usual_loads(scene)
    straight = TILT.muted(scene)({"shaft": found})["shaft"]
    assert not straight["moment"].any()
    for name in ("N", "N2"):
        turned = found["alignment"].sel(bearing=name)
        assert np.any(turned)
        np.testing.assert_allclose(straight["tilt"].sel(bearing=name) - turned, 0.0, atol=1e-10)


@pytest.mark.parametrize("word", ["median", [1e-4], "0.0"])
def test_another_word_for_the_alignment_is_refused_by_its_name(word):
    with pytest.raises(InputError, match="alignment"):
        scene_of(alignment=word)


@pytest.mark.parametrize("rung", ["map", "chart"])
def test_films_that_know_no_tilt_may_align_themselves_beside_a_key_for_tilt(rung):
    film = {"rung": rung, "cavitation": {"kind": "reynolds", "cavitation_pressure": 5e5}}
    assert not scene_of(self_aligning=True, **film).journal.at("N").tilt
    with pytest.raises(InputError, match="tilt"):
        scene_of(**film)


def test_what_bearings_of_a_floating_shaft_give_way_by_is_told_as_tilt_alone():
    taking = [one | {"takes_moment": True} for one in FLOATS]
    floats = scene_of(taking, motion="transient", rung="reduced")
    assert CLEARANCES.is_on(floats)
    assert not STIFFNESS.concerns(floats)
    at_rest = scene_of(taking, motion="quasi-static")
    assert STIFFNESS.concerns(at_rest)
    assert STIFFNESS.is_on(at_rest)


def test_a_shaft_lies_straight_in_bearings_that_align_themselves():
    scene = scene_of(self_aligning=True)
    assert not scene.journal.at("N").tilt
    assert scene.journal.tilting == []
    assert not any(one.concerns(scene) for one in (CLEARANCES, TILT))
    assert max(TILT.indicator(estimated(scene)).values()) == 0.0
    assert CLEARANCES.concerns(scene_of())


def test_a_shaft_that_stands_at_times_floats_in_films_whose_asperities_carry_it():
    contact = {"roughness": 0.56e-6, "contact_modulus": 46.5e9, "factor": 1e-3}
    rough = {"contact": {"asperities": contact, "friction": 0.15}}
    for dlc in ("3.1", "4.2", "5.1", "6.4"):
        assert CLEARANCES.switched(scene_of(loads={"dlc": dlc}), True) is None
        floats = CLEARANCES.switched(scene_of(loads={"dlc": dlc}, **rough), True)
        assert CLEARANCES.is_on(floats)


def test_one_bearing_that_aligns_itself_leaves_the_tilt_to_the_other_one():
    geometry = {"diameter": 3.0, "width": 2.25, "relative_clearance": 1e-3}
    scene = scene_of(own={"N2": {"self_aligning": True, "geometry": geometry}})
    assert scene.journal.tilting == ["N"]
    at = estimated(scene)
    assert set(closed_ends(at)) == {"N"}
    assert closed_ends(at)["N"] > 0
    assert CLEARANCES.concerns(scene)
    assert CLEARANCES.switched(scene, True) is None


def test_a_bearing_that_aligns_itself_takes_no_moment_and_is_never_out_of_line():
    moments = [{"stiffness": "journal", "takes_moment": True}] * 2
    with pytest.raises(InputError, match="it aligns itself; leave out takes_moment"):
        scene_of(moments, self_aligning=True)
    with pytest.raises(InputError, match="it is self_aligning, and never out of line"):
        scene_of(self_aligning=True, alignment=[1e-4, 0.0])


def test_films_that_move_around_a_shaft_tilted_as_at_rest_are_told_and_counted():
    """On the rung "grid" shaft and films are not followed together, whatever supports state."""
    moves = {"motion": "transient", "heat": None}
    held, apart, still = (
        make_plan(scene_of(FLOATS, **film))
        for film in (moves, moves | {"grid": [60, 20], "rung": "grid"}, {"motion": "quasi-static"})
    )
    assert TOGETHER.is_on(held.scene)
    assert not any(TOGETHER.name in said for said in held.shortfalls)
    assert TOGETHER.is_on(still.scene)  # at rest nothing holds it back
    assert not TOGETHER.is_on(apart.scene)
    at = situation(apart.scene, apart.cases)
    size = TOGETHER.indicator(at)["minimum film"]
    assert 0.1 < size <= MOTION.indicator(at)["minimum film"]
    assert apart.errors["journal.film"]["minimum film"] > size
    assert TOGETHER.out == apart.left_out[TOGETHER.name]
    (said,) = apart.shortfalls
    assert "motion of the shaft in its films left out; what would help: journal.rung" in said


def test_a_shaft_on_rigid_bearings_or_in_one_film_has_no_films_that_hold_it_back():
    assert not TOGETHER.concerns(scene_of())
    assert not TOGETHER.concerns(scene_of(FLOATS, self_aligning=True))
    assert TOGETHER.concerns(scene_of(FLOATS))


def test_a_shaft_that_a_plan_rests_in_films_moves_with_them():
    """Whichever films it takes: it chooses them and the shaft one by one."""
    wanted = scene_of()
    rungs = [models()[name] for name in ("shaft", "journal")]
    found = sections(wanted, rungs, ["shaft", "journal"], Estimates())
    scenes = [
        wanted.model_copy(update={"shaft": shaft, "journal": journal})
        for shaft in found["shaft"]
        for journal in found["journal"]
    ]
    resting = [one for one in scenes if one.shaft.coupled and one.journal.in_motion]
    assert resting
    assert all(TOGETHER.is_on(one) for one in resting)


def test_help_against_a_tilt_left_out_is_what_it_needs_and_not_to_leave_out_the_beam():
    plan = make_plan(scene_of(rung="grid", heat=None))
    (said,) = plan.shortfalls
    assert f"tilt in the clearances left out; what would help: {CLEARANCES.needs}" in said
