"""Friction of rolling bearings as a result of a scene, beside that of journal bearings."""

import numpy as np
import pytest

import loadflow as lf
from loadflow.errors import InputError, SolverError
from loadflow.planning.plan import make_plan
from loadflow.rolling import main_bearings
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import asks_for_friction, friction_note, unused_warnings
from loadflow.stages import friction, loads
from loadflow.stages.loads import hub_loads
from loadflow.stages.registry import STAGES
from loadflow.stages.rolling_at_work import friction_options
from loadflow.stages.shaft import bearing_loads
from loadflow.studies.lifetime.energy import run_energy
from loadflow.studies.lifetime.finished_run import run_lifetime
from loadflow.tribology import lubricant


def short(**sections):
    loads = {"wind_speeds": [12.0], "seeds": 1, "duration": 12.0, "step": 0.05, "rung": "tables"}
    return make_scene(
        {"name": "short", "results": ["rolling.friction"], "loads": loads, **sections}
    )


def test_friction_needs_the_series_and_no_reduction():
    plan = make_plan(short())
    assert [step.name for step in plan.steps] == ["loads", "shaft", "friction"]
    assert plan.steps[-1].rung.startswith("balls, every ")
    rollers = make_plan(short(rolling={"arrangement": "two-spherical"}))
    assert rollers.steps[-1].rung.startswith("rollers, every ")


def test_the_plan_takes_friction_as_fine_as_the_accuracy_asks_for():
    """What a scene states of it stays."""
    spherical = {"rolling": {"arrangement": "two-spherical"}}

    def chosen(**sections):
        return make_plan(short(**spherical, **sections)).scene.friction

    given, coarse = chosen(accuracy="given"), chosen(accuracy=0.2)
    assert (given.step, given.follow_every) == (0.1, 1)
    assert coarse.step > given.step
    assert coarse.follow_every > 1
    stated = chosen(accuracy=0.2, friction={"follow_every": 2})
    assert stated.follow_every == 2


def test_rollers_to_follow_are_told_where_there_are_none():
    of_balls = short(friction={"follow_every": 4})
    assert any("friction.follow_every" in text for text in unused_warnings(of_balls))
    of_rollers = short(friction={"follow_every": 4}, rolling={"arrangement": "two-spherical"})
    assert not any("follow_every" in text for text in unused_warnings(of_rollers))


def test_rollers_that_stand_for_others_hardly_change_the_means():
    scene = short(rolling={"arrangement": "two-spherical"}, shaft={"two_point": {}})
    (case,) = list_cases(scene)
    inputs = {"loads": hub_loads(scene, case, {})}
    inputs["shaft"] = bearing_loads(scene, case, inputs)
    some = scene.model_copy(
        update={"friction": scene.friction.model_copy(update={"follow_every": 4})}
    )
    every, few = (
        friction.summary({case: friction.losses(one, case, inputs)}) for one in (scene, some)
    )
    for name, allowed in {"mean_friction_power": 0.01, "median_film_parameter": 0.0}.items():
        assert np.allclose(few[name], every[name], rtol=allowed, atol=0.0), name
    # 12 s are half a turn of the cage, so that not every roller passes every place
    assert np.allclose(few["mean_slip"], every["mean_slip"], atol=0.03)
    assert not np.array_equal(few["mean_slip"], every["mean_slip"])


def test_rollers_of_both_bearings_are_followed(tmp_path):
    scene = short(
        rolling={"arrangement": "two-spherical"},
        shaft={"two_point": {}},
        results=["journal.film", "rolling.friction"],
        accuracy="given",  # neither a pilot nor a check is needed
    )
    run = lf.run(scene, out=tmp_path)
    assert run.failures == {}
    table = run.tree["friction"].to_dataset()
    assert list(table["bearing"].values) == ["N", "N2"]
    assert (table["mean_friction_power"] > 0).all()
    assert (table["mean_friction_power"] < run.tree["journal"]["mean_friction_power"]).all()
    assert float(table["mean_slip"].sel(bearing="N2").max()) > 0.1  # thrust unloads a row
    curved = table["mean_differential_slip_power"]  # of barrels
    assert (curved > 0.1 * table["mean_friction_power"]).all()
    assert (curved <= table["mean_slip_power"]).all()
    assert curved.attrs == {
        "units": "W", "long_name": "mean power lost in differential slip of curved contacts",
    }  # fmt: skip
    assert "Friction of rolling bearings" in run.report.read_text(encoding="utf-8")


def test_balls_of_the_moment_bearing_slide_in_their_curved_contacts(tmp_path):
    run = lf.run(short(), out=tmp_path, report=False)
    table = run.tree["friction"].to_dataset()
    assert (table["mean_friction_torque"] > 0).all()
    # a ball of 40 mm at 45° on 1.9 m spins at 0.7 of the speed and rolls at half of it
    assert ((table["mean_slip"] > 1e-4) & (table["mean_slip"] < 0.05)).all()
    assert (table["mean_slip_power"] > 0).all()
    assert (table["mean_slip_power"] < table["mean_friction_power"]).all()
    assert (table["largest_slip_power_density"] > 0).all()
    assert (table["temperature"] == 313.15).all()
    assert np.isfinite(table["median_film_parameter"]).all()


def losses_of(scene):
    stage = make_plan(scene)
    (one,) = stage.cases
    series = hub_loads(scene, one, {})
    shaft = bearing_loads(scene, one, {"loads": series})
    return friction.losses(scene, one, {"loads": series, "shaft": shaft})


TAPERED = {"arrangement": "tapered-pair"}
_PAIR = {
    "rollers": 60, "roller_diameter": 0.05, "roller_length": 0.08, "pitch_diameter": 1.2,
    "contact_angle": 0.35, "rows": 2, "row_spacing": 0.2, "clearance": -5e-5,
}  # fmt: skip
BENT = {
    "bearing": "M", "geometry": _PAIR | {"kind": "roller"}, "rings": "flexible",
    "outer_ring": {"section": {"width": 0.1, "height": 0.3}, "radius": 0.68},
}  # fmt: skip


def test_tapered_rollers_rub_on_their_ribs_unless_the_scene_says_otherwise():
    usual, none = (
        losses_of(short(rolling=TAPERED, friction={"step": 2.0} | keys))["friction_power"].mean()
        for keys in ({}, {"rib_angle": 0.0})
    )
    # 17 to 42 % of the torque for an angle of 0.04 (docs/friction.md)
    assert 0.1 < 1 - float(none / usual) < 0.5
    options = friction_options(short().friction, main_bearings("two-spherical")["N"])
    assert options.rib_angle == 0.0
    straight = losses_of(short(rolling=TAPERED, friction={"step": 2.0}))
    assert (straight["differential_slip_power"] == 0).all()


def test_churning_and_seals_of_the_scene_are_counted():
    base, more = (
        losses_of(short(friction={"step": 2.0} | keys))
        for keys in ({}, {"seal_torque": 100.0, "churning": {"viscous": 50.0, "inertial": 0.1}})
    )
    speed = base["speed"].values
    oil = lubricant("lgep-2")
    torque = 100.0 + 50.0 * oil.viscosity(313.15) * speed + 0.1 * oil.density(313.15) * speed**2
    added = (more["friction_torque"] - base["friction_torque"]).values[0]
    np.testing.assert_allclose(added, torque, rtol=1e-9)


def test_ribs_churning_and_seals_count_in_the_energy_of_a_run():
    """From the section of a scene to its energy balance and to the joules of a year."""

    usual = short(rolling=TAPERED)
    (one,) = list_cases(usual)
    series = hub_loads(usual, one, {})
    inputs = {"loads": series, "shaft": bearing_loads(usual, one, {"loads": series})}

    def balance(**keys):
        scene = short(rolling=TAPERED, friction={"step": 2.0} | keys)
        tables = {
            "loads": loads.summary({one: series}),
            "friction": friction.summary({one: friction.losses(scene, one, inputs)}),
        }
        year = run_lifetime(scene, tables)
        return run_energy(scene, tables)["rolling_loss"].values.item(), float(
            year["rolling_energy"].sum()
        )

    bare = balance(rib_angle=0.0)
    for keys in (
        {},  # the rib of tapered rollers
        {"rib_angle": 0.0, "seal_torque": 100.0},
        {"rib_angle": 0.0, "churning": {"viscous": 5000.0}},
    ):
        lost, energy = balance(**keys)
        assert lost > 1.05 * bare[0]
        assert energy / bare[1] == pytest.approx(lost / bare[0], rel=1e-9)


@pytest.mark.parametrize(
    ("rolling", "conductance"),
    [
        ({}, 300.0),
        ({"rings": "flexible"}, 300.0),
        (TAPERED, 30.0),
        (BENT, 30.0),
    ],
)
def test_a_cooled_bearing_has_the_temperature_that_carries_off_its_friction(rolling, conductance):
    cooling = {"conductance": conductance, "ambient_temperature": 283.15, "step": 0.5}
    found = losses_of(short(rolling=rolling, friction=cooling))
    (temperature,) = found["temperature"].values
    assert temperature > 284.0
    # the slip of rollers, which the balance leaves out, is small
    shed = conductance * (temperature - 283.15)
    assert float(found["friction_power"].mean()) == pytest.approx(shed, rel=0.03)


def test_the_modified_life_has_the_oil_at_the_temperature_of_the_heat_balance():
    def rated(**friction):
        scene = short(rolling=TAPERED, friction={"step": 0.5} | friction)
        case = next(iter(list_cases(scene)))
        inputs = {}
        for name in ("loads", "shaft", "reduction"):
            inputs[name] = STAGES[name].run(scene, case, inputs)
        found = STAGES["rolling"].run(scene, case, inputs)
        return [float(found[f"bearing_{what}"][0]) for what in ("temperature", "modified_life")]

    hot, less = rated(conductance=15.0, ambient_temperature=313.15)
    assert hot > 320.0
    assert rated(temperature=hot) == pytest.approx([hot, less], rel=1e-9)
    cold, more = rated()
    assert cold == 313.15
    assert less < more
    with pytest.raises(SolverError, match=r"bearing M: heat balance"):
        rated(conductance=0.01)


@pytest.mark.parametrize(
    ("given", "left_out"),
    [
        ({}, "churning and seals"),
        ({"seal_torque": 50.0}, "churning"),
        ({"churning": {"viscous": 50.0}}, "seals"),
        ({"churning": {"viscous": 50.0}, "seal_torque": 50.0}, None),
    ],
)
def test_friction_that_is_not_counted_is_told(given, left_out):
    told = friction_note(short(friction=given))
    assert len(told) == (left_out is not None)
    assert all(said.startswith(f"friction: {left_out} of the rolling") for said in told)


def test_friction_that_nobody_asked_for_is_not_doubted():
    assert asks_for_friction(short())
    assert asks_for_friction(make_scene({"rolling": {}}))
    empty, other = make_scene({}), make_scene({"results": ["loads.statistics"], "rolling": {}})
    assert friction_note(empty)  # which a run, that computes it, tells
    assert not asks_for_friction(empty)
    assert not asks_for_friction(other)
    assert unused_warnings(empty) == []


def test_an_unknown_lubricant_is_refused_with_those_there_are():
    with pytest.raises(InputError, match=r"friction\.lubricant.*lgep-2"):
        short(friction={"lubricant": "butter"})


def test_a_bearing_without_a_model_is_a_failure_with_its_name(tmp_path):
    scene = short(
        rolling={"geometry": {
            "kind": "crossed", "rollers": 100, "roller_diameter": 0.03, "roller_length": 0.03,
            "pitch_diameter": 1.9, "contact_angle": np.pi / 4,
        }},
    )  # fmt: skip
    run = lf.run(scene, out=tmp_path, report=False)
    assert any("no model of friction" in reason for reason in run.failures.values())
