"""What films of thrust collars leave out is counted, by closed forms that solved films bear out."""

from pathlib import Path

import numpy as np
import pytest

from loadflow.data import gains
from loadflow.journal import Heat
from loadflow.planning.ladder import STEPS_PER_CASE, expected_seconds, ladder
from loadflow.planning.pilot import pilot
from loadflow.planning.plan import make_plan, plan_of
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene, read_scene
from loadflow.stages.effects import thrust
from loadflow.stages.effects.film import THREE_P
from loadflow.stages.effects.situation import FEW, Situation, situation

DLC_1_1 = Path(__file__).parents[2] / "pipelines" / "dlc_1_1.toml"
COLLAR = {
    "kind": "thrust", "play": 6e-4,
    "geometry": {
        "pads": 6, "inner_radius": 1.6, "outer_radius": 1.9, "pad_angle": 0.3, "taper": 8e-5,
    },
    "lubricant": {"viscosity": 0.15},
}  # fmt: skip
SHAFT = {"two_point": {"beam": {"sections": [{"outer_diameter": 3.0, "inner_diameter": 1.5}]}}}


def scene_of(*wind_speeds, **more):
    loads = {"source": "simulate", "wind_speeds": list(wind_speeds), "seeds": 1, "duration": 60.0}
    return make_scene(
        {
            "name": "collar", "loads": loads, "shaft": SHAFT, "bearings": {"N2": COLLAR},
            "results": ["thrust.film"],
        } | more
    )  # fmt: skip


@pytest.fixture(scope="module")
def at():
    scene = scene_of(18.0)
    return situation(scene, list_cases(scene))


@pytest.fixture(scope="module")
def loaded(at):
    """Collar, thrust, speed and film of the largest load."""
    collar = at.scene.thrust.collars["N2"].model_copy(update={"grid": FEW})
    load = at.bearings["N2"]
    return collar, float(load.force[0, 0] + load.surge[0]), float(at.speed[0]), at.collars["N2"][0]


def test_heat_changes_the_film_as_the_balance_of_its_pads_does(at, loaded):
    _, force, speed, cold = loaded
    warm = thrust.HEAT.switched(at.scene, True).thrust.collars["N2"].on_cells(FEW)
    found = warm.solve(np.array([0.0, 0.0, force]), np.zeros(3), speed)
    assert found.front.temperature > Heat().inlet_temperature + 3.0
    sizes = thrust.HEAT.indicator(at)
    thinner = 1.0 - found.minimum_film / cold.minimum_film
    assert thinner > 0.05
    assert sizes["minimum film"] == pytest.approx(thinner, rel=0.15)
    more = found.maximum_pressure / cold.maximum_pressure - 1.0
    assert sizes["maximum pressure"] == pytest.approx(more, rel=0.35)  # calibrated on another one
    less = 1.0 - found.friction_power / cold.friction_power
    # the row that is not pressed stays cooler than the indicator has it
    assert less < sizes["friction power"] == pytest.approx(less, rel=0.25)


def test_tilt_changes_the_film_as_a_held_slope_does(at, loaded):
    collar, force, speed, aligned = loaded
    slope = float(at.bearings["N2"].slope[0])
    assert slope > 0
    tilted = collar.solve(np.array([0.0, 0.0, force]), np.zeros(3), speed, np.array([slope, 0.0]))
    front = tilted.front
    sizes = thrust.TILT.indicator(at)
    thinner = 1.0 - front.minimum_film / aligned.minimum_film
    assert sizes["minimum film"] == pytest.approx(thinner, rel=0.1)
    more = front.maximum_pressure / aligned.maximum_pressure - 1.0
    assert sizes["maximum pressure"] == pytest.approx(more, rel=0.15)
    less = 1.0 - front.friction_power / aligned.front.friction_power
    assert sizes["friction power"] == pytest.approx(less, abs=0.01)


def test_squeeze_takes_out_of_a_swinging_thrust_what_the_closed_form_says(at, loaded):
    collar, force, speed, _ = loaded
    row, film, load = collar.geometry, collar.film_model, at.bearings["N2"]
    passing = at.turbine.rotor.blades * speed
    swing = THREE_P * float(load.surge[0]) / force
    time = np.linspace(0.0, 3 * 2 * np.pi / passing, 91)
    orbit = row.orbit(time, force * (1.0 + swing * np.sin(passing * time)), speed, film)
    slow = np.ptp([row.equilibrium(force * (1.0 + s), speed, film).gap for s in (swing, -swing)])
    left = np.ptp(orbit.gap.values[-31:]) / slow
    assert 0.5 < left < 0.9
    lost = gains()["thrust"]["minimum film"] * swing * (1.0 - left)
    assert thrust.MOTION.indicator(at)["minimum film"] == pytest.approx(lost, rel=0.05)


def test_asperities_take_a_share_of_films_as_thin_as_the_stated_roughness(at):
    assert thrust.CONTACT.indicator(at)["minimum film"] == 0.0  # films of some 40 σ
    film = at.collars["N2"][0].minimum_film
    half = 0.5 * 0.5 * film * 3.8 / 1.1  # R_z of each surface for a film of 2 σ
    scene = scene_of(18.0, bearings={
        "N2": COLLAR | {"shaft_roughness": half, "shell_roughness": half}
    })  # fmt: skip
    found = thrust.CONTACT.indicator(situation(scene, list_cases(scene)))["minimum film"]
    assert found == pytest.approx(0.5**6.804, rel=1e-6)


def test_a_plan_takes_motion_heat_and_tilt_where_the_accuracy_asks_for_them():
    plan = make_plan(scene_of(12.0))
    kept = {one.name: one.kept for one in plan.effects if one.name.endswith("the collar")}
    assert kept == {
        "motion of the collar": True, "heat of the collar": True, "tilt of the collar": True,
        "contact of the collar": False,
    }  # fmt: skip
    assert plan.errors["thrust.film"]["minimum film"] < 0.05
    assert not any(said.startswith("thrust.film") for said in plan.shortfalls)
    chosen = plan.scene.thrust
    assert (chosen.rung, chosen.tilt, chosen.motion) == ("curve", True, "transient")
    entering = chosen.collars["N2"].oil
    assert entering.viscosity == pytest.approx(0.15, rel=1e-3)


def test_the_main_job_takes_its_collar_in_motion_and_the_coarser_wind_that_this_allows():
    """All steps of a collar cost less than the points of the wind that would make up for it."""
    plan = make_plan(read_scene(DLC_1_1))
    seconds = {step.name: step.seconds for step in plan.steps}
    assert plan.accurate
    assert plan.scene.thrust.in_motion
    assert plan.scene.loads.wind_grid == (11, 144)
    assert seconds["thrust"] < 0.25 * seconds["loads"]


def test_the_table_of_a_collar_is_counted_once_and_a_step_less_than_a_sample_at_rest():
    def seconds(*wind_speeds, **more):
        wanted = COLLAR | {"rung": "curve", "tilt": True} | more
        scene = scene_of(*wind_speeds, accuracy="given", bearings={"N2": wanted})
        return expected_seconds(scene, "thrust", list_cases(scene))

    once = ladder()["thrust"]["curve, 20x10"]["seconds_once"]
    assert 2 * seconds(8.0) - seconds(8.0, 12.0) == pytest.approx(once["tilted"])
    assert 2 * seconds(8.0, tilt=False) - seconds(8.0, 12.0, tilt=False) == pytest.approx(
        once["curve"]
    )
    kept = (seconds(8.0) - once["tilted"]) / STEPS_PER_CASE
    steps = (seconds(8.0, motion="transient") - once["tilted"]) / STEPS_PER_CASE
    assert 0.0 < steps < 20.0 * kept


def test_a_plan_counts_what_a_scene_does_not_want():
    plan = make_plan(scene_of(12.0, accuracy="given"))
    sizes = {one.name: one.indicator for one in plan.effects if one.name.endswith("the collar")}
    left = sum(one["minimum film"] for one in sizes.values())
    assert plan.errors["thrust.film"]["minimum film"] > left > 0.05


def test_motion_is_taken_where_more_accuracy_is_asked_for():
    plan = make_plan(scene_of(12.0, accuracy=0.005))
    assert plan.scene.thrust.in_motion
    standing = scene_of(12.0)
    standing = standing.model_copy(
        update={"loads": standing.loads.model_copy(update={"dlc": "4.2"})}
    )
    assert thrust.MOTION.switched(standing, True) is None


def test_a_pilot_asks_what_collars_lose_before_any_of_their_films_is_solved(monkeypatch):
    """So their loops are compiled beside those of other models; the same effects are measured."""

    class Asked(Exception):
        pass

    def questions(asked, choice):
        found.extend((asked, choice))
        raise Asked

    found = []
    monkeypatch.setattr(Situation, "collars", property(lambda at: pytest.fail("films are solved")))
    with pytest.raises(Asked):
        pilot(read_scene(DLC_1_1), before=questions)
    assert {name for name in found[0].effects if name.endswith("the collar")} == {
        "motion of the collar", "heat of the collar",
    }  # fmt: skip
    expected = plan_of(read_scene(DLC_1_1), found[1], found[0].cases)
    assert not any(one.indicator for one in expected.effects if one.name.endswith("the collar"))


def test_without_a_collar_there_is_nothing_to_leave_out():
    scene = make_scene({"name": "none", "shaft": SHAFT, "results": ["loads.statistics"]})
    assert not thrust.HEAT.concerns(scene)
