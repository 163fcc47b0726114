"""Rollers whole or in slices and the inertia of balls, as keys of a scene and as effects."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.planning.plan import make_plan
from loadflow.rolling import BallBearing, RollerBearing
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages.effects import roller_profile
from loadflow.stages.effects.situation import situation
from loadflow.stages.rolling_at_work import rest

TAPERED = {
    "rollers": 84, "rows": 2, "roller_diameter": 0.085, "roller_length": 0.15,
    "pitch_diameter": 2.6, "row_spacing": 0.35, "contact_angle": 0.785398, "clearance": -50e-6,
}  # fmt: skip
BALLS = {
    "balls": 30, "rows": 2, "ball_diameter": 0.08, "pitch_diameter": 1.0, "groove_radius": 0.0416,
    "contact_angle": 0.5,
}  # fmt: skip
FORCE = np.array([[6e5, 2e5, -1.2e6], [4e5, -1e5, -1.0e6]])
MOMENT = np.array([[0.0, 2e6, 1e6], [0.0, -1.5e6, 0.5e6]])


def scene_of(kind, geometry, **keys):
    place, shaft = ("M", {"moment": {}}) if kind == "roller" else ("N", {"two_point": {}})
    rolling = {"bearing": place, "geometry": {"kind": kind} | geometry} | keys
    return make_scene({
        "name": "x", "loads": {"wind_speeds": [12.0], "seeds": 1}, "shaft": shaft,
        "results": ["rolling.loads", "rolling.life"], "rolling": rolling,
    })  # fmt: skip


def bearing_frame(load):
    return np.roll(load, -1, axis=-1)


def test_whole_rollers_of_a_scene_are_those_of_one_slice():
    found = rest(scene_of("roller", TAPERED, roller_model="whole").rolling, FORCE, MOMENT)
    one = RollerBearing(**TAPERED, slices=1)
    truth = one.equilibrium(bearing_frame(FORCE), bearing_frame(MOMENT)[:, :2])
    assert found.rating_life == pytest.approx(truth.rating_life, rel=1e-9)
    assert found.maximum_force == pytest.approx(truth.maximum_force, rel=1e-9)


def test_balls_of_a_scene_feel_their_inertia_at_its_speed():
    part, speed = scene_of("ball", BALLS, inertia=True).rolling, np.array([60.0, 80.0])
    found = rest(part, FORCE, 0 * MOMENT, speed)
    bearing = BallBearing(**BALLS)
    truth = bearing.equilibrium(bearing_frame(FORCE), speed=speed)
    assert found.maximum_force == pytest.approx(truth.maximum_force, rel=1e-9)
    still = rest(part, FORCE, 0 * MOMENT)
    assert (found.rating_life < 0.998 * still.rating_life).all()


@pytest.mark.parametrize(
    ("kind", "geometry", "keys", "message"),
    [
        ("ball", BALLS, {"roller_model": "whole"}, "has no rollers"),
        ("roller", TAPERED, {"inertia": True}, "of kind roller"),
        (
            "ball",
            BALLS,
            {"inertia": True, "oscillation": {"amplitude": 0.1, "frequency": 0.1}},
            "and swings",
        ),
    ],
)
def test_a_bearing_without_such_elements_refuses_the_key(kind, geometry, keys, message):
    with pytest.raises(InputError, match=message):
        scene_of(kind, geometry, **keys)


def changed(bearing):
    """What profile and tilt of the rollers change under loads with a moment."""
    load = bearing_frame(FORCE), bearing_frame(MOMENT)[:, :2]
    ours, true = bearing.with_whole_rollers().equilibrium(*load), bearing.equilibrium(*load)
    fields = ("maximum_force", "maximum_pressure", "rating_life")
    return {
        name: float(np.abs(getattr(ours, field) / getattr(true, field) - 1).max())
        for name, field in zip(roller_profile.QUANTITIES, fields)
    }


def test_the_indicator_of_sliced_rollers_has_the_size_that_is_solved():
    scene = scene_of("roller", TAPERED)
    told = roller_profile.SLICED.indicator(situation(scene, list_cases(scene)))
    for name, size in changed(RollerBearing(**TAPERED)).items():
        assert size / 3 < told[name] < 3 * size, name
    straight = scene_of("roller", TAPERED | {"profile": "straight"})
    told = roller_profile.SLICED.indicator(situation(straight, list_cases(straight)))
    assert told["maximum force"] == pytest.approx(0.0, abs=1e-9)
    assert told["maximum pressure"] == pytest.approx(0.0, abs=1e-9)
    # stress is concentrated at the ends of a straight roller
    solved = changed(RollerBearing(**TAPERED, profile="straight"))["life"]
    assert told["life"] == pytest.approx(solved, rel=0.25)


@pytest.mark.parametrize(("bearings", "place"), [("spherical", "N"), ("cylindrical-tapered", "N")])
def test_the_zone_of_a_radial_load_has_the_change_that_is_solved(bearings, place):
    scene = make_scene(
        {"name": "zone", "bearings": [bearings], "results": ["rolling.life"]}
        | {"loads": {"wind_speeds": [12.0], "seeds": 1}}
    )
    load = situation(scene, list_cases(scene)).bearings[place]
    geometry = scene.rolling.bearings[place].geometry
    radial = load.radial + np.outer((0.0, 1.0), load.swing)
    force = np.stack([radial.ravel(), *np.zeros((2, 2))], axis=-1)
    whole, sliced = (
        one.equilibrium(force, np.zeros((2, 2)))
        for one in (geometry.with_whole_rollers(), geometry)
    )
    pressed = whole.maximum_pressure[1] / sliced.maximum_pressure[1] - 1.0
    lives = whole.rating_life / sliced.rating_life - 1.0
    own = roller_profile._changes(scene.rolling.bearings[place], load)
    assert own["maximum pressure"] == pytest.approx(abs(pressed), rel=0.1)
    assert own["life"] == pytest.approx(np.abs(lives).max(), rel=0.1)


def test_the_plan_keeps_sliced_rollers_and_leaves_out_balls_that_weigh_nothing():
    plan = make_plan(scene_of("roller", TAPERED))
    assert plan.scene.rolling.roller_model == "sliced"
    assert not any(one.name == "inertia of the balls" for one in plan.effects)
    named = make_plan(scene_of("roller", TAPERED, roller_model="whole"))
    assert any("profile and tilt of the rollers" in said for said in named.shortfalls)
    balls = make_plan(scene_of("ball", BALLS))
    (inertia,) = (one for one in balls.effects if one.name == "inertia of the balls")
    assert not inertia.kept
    assert max(inertia.indicator.values()) < 1e-3
