"""The ladder knows every rung that a scene can choose, and what it says still holds."""

import re
from pathlib import Path
from typing import get_args

import numpy as np
import pytest
import synthetic

import loadflow
from benchmarks.ladder.measuring import rung_key
from loadflow.planning.ladder import STEPS_PER_CASE, gains, ladder
from loadflow.planning.plan import make_plan
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Loads, Reduction, Rolling, Seeds, Shaft, make_scene
from loadflow.wind import LOAD_CASES


def choices(section, name):
    """The values that a Literal of the scene allows, None aside."""
    values = get_args(section.model_fields[name].annotation)
    return get_args(values[0]) if type(None) in values else values


def plan_of(**sections):
    return make_plan(make_scene({"name": "ladder", "accuracy": "given"} | sections))


SCENES = [
    *({"loads": e["settings"]} for e in ladder().get("wind", {}).values() if "settings" in e),
    *(
        {"friction": settings, "rolling": {"arrangement": arrangement}}
        for settings in ({"step": 0.1}, {"step": 0.4}, {"step": 0.4, "follow_every": 4})
        for arrangement in ("two-spherical", "moment")
    ),
    *({"loads": {"rung": rung}} for rung in choices(Loads, "rung")),
    *({"reduction": {"pick": pick}} for pick in choices(Reduction, "pick")),
    *(
        {"journal": {"rung": rung, "motion": motion}}
        for rung in choices(Journal, "rung")
        for motion in choices(Journal, "motion")
    ),
    *({"rolling": {"rings": rings}} for rings in choices(Rolling, "rings")),
    *({"seeds": {"methods": [m]}} for m in get_args(choices(Seeds, "methods")[0])),
    {"seeds": {"methods": ["calibrated", "as-printed"]}},
]


@pytest.mark.parametrize("sections", SCENES, ids=str)
def test_every_rung_that_a_scene_can_choose_has_cost_and_error(sections):
    for step in plan_of(**sections).steps:
        if step.name == "check":
            continue
        assert step.seconds is not None, (step.name, step.rung)
        assert step.seconds > 0
        assert step.error


SHAFTS = [
    *({concept: {}} for concept in Shaft.model_fields),
    {"two_point": {"beam": {}}},
    {"moment": {"beam": {}}},
    {"two_point": {"beam": {}}, "moment": {}},
    {"two_point": {"beam": {}}, "moment": {"beam": {}}},
]


@pytest.mark.parametrize("shaft", SHAFTS, ids=str)
def test_each_suspension_is_measured(shaft):
    plan = plan_of(shaft=shaft, results=["loads.statistics"])
    assert all(step.seconds for step in plan.steps)


def test_benchmarks_and_plan_name_a_rung_by_the_same_function():
    named = 0
    for table, rungs in ladder().items():
        for name, entry in rungs.items():
            if "settings" in entry:
                model = table.removesuffix(", transient")
                moving = {"motion": "transient"} if model != table else {}
                rolling = {"arrangement": "two-spherical"} if "rollers" in name else {}
                scene = make_scene({"name": "r", "rolling": rolling})
                assert rung_key(scene, model, **moving | entry["settings"]) == name
                named += 1
    assert named > 30


def test_what_was_not_measured_says_so():
    steps = {step.name: step for step in plan_of(journal={"grid": [48, 16]}).steps}
    step = steps["journal"]
    assert step.seconds is None
    assert step.error is None


def test_expected_time_grows_with_length_and_cases():
    def seconds(**loads):
        return {s.name: s.seconds for s in plan_of(loads=loads).steps if s.seconds}

    short = seconds(wind_speeds=[12.0], seeds=1, duration=300.0)
    long = seconds(wind_speeds=[8.0, 12.0], seeds=3, duration=600.0)
    assert long == {name: pytest.approx(12 * value) for name, value in short.items()}


def test_one_case_of_the_plan_is_one_case_of_the_ladder():
    steps = plan_of(loads={"wind_speeds": [12.0], "seeds": 1}).steps
    assert LOAD_CASES["1.1"].duration / 0.025 == STEPS_PER_CASE
    assert steps[0].seconds == pytest.approx(ladder()["loads"]["tower"]["seconds_per_case"])


def test_a_finer_wind_costs_what_it_takes_longer():
    def seconds(**loads):
        return plan_of(loads={"wind_speeds": [12.0], "seeds": 1} | loads).steps[0].seconds

    wind = ladder()["wind"]
    more = wind["kaimal, 21x144"]["seconds_per_case"] - wind["kaimal, 11x48"]["seconds_per_case"]
    assert seconds(wind_grid=[21, 144]) - seconds() == pytest.approx(more)
    assert seconds(wind_grid=[13, 50]) is None


def test_what_rigid_rings_leave_out_is_not_told_twice():
    """The row of the rung tells the error that answers count; the rest is that of an effect."""
    made = plan_of(results=["rolling.loads"], shaft={"moment": {}}, rolling={"rings": "rigid"})
    step = next(step for step in made.steps if step.name == "rolling")
    told = ladder()["rolling"]
    assert step.rung.startswith("rigid")
    assert told["flexible"]["error"] in step.error
    assert "among the effects" in step.error
    assert told["rigid"]["error"] not in step.error


def test_errors_are_ordered_and_name_their_worst_case():
    measured = [
        error
        for rungs in ladder().values()
        for e in rungs.values()
        for error in (e["errors"] or {}).values()
    ]
    assert len(measured) > 20
    for error in measured:
        assert 0 <= error["p95"] <= error["max"]
        assert error["worst"]


def test_a_finer_film_grid_is_dearer_and_more_accurate():
    rungs = ladder()["journal"]
    coarse, usual, fine = (rungs[f"grid, {g}"] for g in ("30x10", "60x20", "240x80"))
    assert coarse["relative_time"] < usual["relative_time"] < fine["relative_time"]
    for quantity in coarse["errors"]:
        assert coarse["errors"][quantity]["max"] > fine["errors"][quantity]["max"]


def test_stored_film_errors_still_hold():
    """Measured again at two loads; the coarser reference leaves out at most half of the error."""
    from benchmarks.ladder.bearings import film_errors, reference_film
    from benchmarks.ladder.measuring import Setting

    options = Journal()
    setting = Setting(sommerfeld=(1.0, 10.0), speeds=(1.267,))
    reference = reference_film(options, setting, (240, 80))
    errors = film_errors(options, setting, reference, grid=(60, 20)).summary()
    for quantity, stored in ladder()["journal"]["grid, 60x20"]["errors"].items():
        assert errors[quantity]["max"] < 1.5 * stored["max"], quantity
        assert errors[quantity]["max"] > stored["max"] / 10, quantity


def test_stored_errors_of_the_film_in_motion_still_hold():
    """Measured again on sines of the turbine's size; the cases of the ladder are other ones."""
    from benchmarks.ladder.measuring import Errors
    from benchmarks.ladder.orbit import MODELS, REFERENCE, compare, solve

    options, time = Journal(), 0.025 * np.arange(120)
    force = np.stack([1.8e6 + 8e5 * np.sin(3.8 * time), 3e5 * np.cos(1.3 * time)], axis=-1)
    series = (time, force, np.full(time.size, 1.2))
    reference = solve(options, *series, **REFERENCE | {"grid": (240, 20)})
    for name in ("reduced, 60", "reduced, 60, 0.05 s", "grid, 60x20"):
        errors = Errors()
        compare(errors, "sines", solve(options, *series, **MODELS[name]), reference)
        for quantity, stored in ladder()["journal, transient"][name]["errors"].items():
            found = errors.summary()[quantity]["max"]
            assert stored["max"] / 10 < found < 1.5 * stored["max"], (name, quantity)


def within(found, stored):
    """A sample of fewer cases: no worse than half as much again, and no less than a tenth."""
    return stored["max"] / 10 < found["max"] < 1.5 * stored["max"]


def test_stored_errors_of_the_wind_still_hold():
    """One minute at 12 m/s on rigid blades, against the next but one grid."""
    from benchmarks.ladder.loads import describe, deviations
    from benchmarks.ladder.wind import loads_in, thinned, turbulence
    from loadflow.scene.cases import list_cases

    loads = {"wind_speeds": [12.0], "seeds": 1, "duration": 60.0, "rung": "tables"}
    scene = make_scene({"name": "sample", "loads": loads})
    case = list_cases(scene)[0]
    fine = turbulence(scene, case, (11, 72), "fast")
    coarse, best = (
        {"sample": describe(loads_in(scene, case, thinned(fine, grid)))}
        for grid in ((11, 24), (11, 72))
    )
    errors = deviations(coarse, best).summary()
    stored = ladder()["wind"]["kaimal, 11x24"]["errors"]
    for quantity in ("tilt moment DEL", "yaw moment DEL", "bearing force DEL", "tilt moment std"):
        assert within(errors[quantity], stored[quantity]), quantity


def test_stored_errors_of_binned_lives_still_hold():
    """Measured again on noise of the turbine's size."""
    from benchmarks.ladder.life import MODELS, Loads, compare, life_of
    from loadflow.rolling import main_bearings

    rng = np.random.default_rng(1)
    force = np.array([1e5, -9e5, 4e5]) + 1e5 * rng.standard_normal((4000, 3))
    moment = 1.2e6 * rng.standard_normal((4000, 2))
    loads = Loads(force, moment, np.ones(4000), np.zeros(4000, int))
    bearing = main_bearings("moment")["M"]
    best = {"noise": life_of(bearing, loads)}
    for name in ("bins, 4", "bins, 12"):
        gather, _ = MODELS[name]
        errors = compare({"noise": life_of(bearing, gather(loads))}, best).summary()
        assert within(errors["life"], ladder()["life"][name]["errors"]["life"]), name


def test_stored_errors_of_friction_still_hold():
    """Measured again on waves and noise, the four-point bearing in ideal rolling."""
    from benchmarks.ladder.friction import compare, solve
    from benchmarks.ladder.measuring import Errors
    from loadflow.scene.cases import Case
    from loadflow.stages import shaft

    scene, case = make_scene({"name": "sample"}), Case("1.1", 12.0, 1)
    hub = synthetic.case(12.0, 1, steps=1200, dt=0.05)
    noise = 3e5 * np.random.default_rng(1).standard_normal(hub["hub_moment"].shape)
    parts = {"loads": hub.assign(hub_moment=hub["hub_moment"] + noise)}
    parts |= {"shaft": shaft.bearing_loads(scene, case, parts)}
    errors = Errors()
    compare(errors, "noise", *(solve(scene, {"step": step}, case, parts) for step in (0.4, 0.05)))
    stored = ladder()["friction"]["balls, every 0.4 s"]["errors"]
    assert within(errors.summary()["friction power"], stored["friction power"]), errors.summary()


def test_the_pages_show_what_is_stored():
    from benchmarks.ladder.__main__ import BY_QUANTITY, DOC, by_quantity, page

    assert DOC.read_text(encoding="utf-8") == page(ladder(), gains())
    assert BY_QUANTITY.read_text(encoding="utf-8") == by_quantity(ladder())


def test_errors_of_the_ladder_are_percentages_without_a_power_of_ten():
    text = (Path(loadflow.__file__).parent / "data" / "ladder.json").read_text(encoding="utf-8")
    assert " %" in text
    assert not re.search(r"e[+-]?\d+ %", text)
