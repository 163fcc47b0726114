"""What an indicator leaves no doubt about is neither measured nor solved again."""

import tomllib
from dataclasses import replace
from pathlib import Path

import pytest

from benchmarks.ladder.physics_scenes import ten_scenes
from loadflow.planning.accuracy import surely_small
from loadflow.planning.effects import EffectVerdict, estimates
from loadflow.planning.pilot import pilot
from loadflow.planning.plan import make_plan, needed_stages
from loadflow.planning.verification import differences
from loadflow.scene import make_scene, read_scene
from loadflow.stages import comparisons
from loadflow.stages.effects.effect import UNSURE
from loadflow.stages.effects.film_heat import HEAT
from loadflow.stages.effects.roller_profile import SLICED
from loadflow.stages.effects.rolling import RINGS
from loadflow.stages.registry import STAGES
from loadflow.stages.stage import with_settings

QUICK = Path(__file__).parents[2] / "pipelines" / "quick_look.toml"


class Asked(Exception):
    """Ends a pilot before it measures."""


def asked(scene, **words):
    def before(questions, choice):
        raise Asked(*questions.effects)

    with pytest.raises(Asked) as found:
        pilot(scene, before=before, **words)
    return found.value.args


@pytest.fixture(scope="module")
def plan():
    return make_plan(read_scene(QUICK))


def with_accuracy(scene, loads, life, friction=2.0):
    asked = {"rolling.loads": loads, "rolling.life": life, "rolling.friction": friction}
    return scene.model_copy(update={"accuracy": {**scene.accuracy, **asked}})


def test_rigid_rings_are_sure_where_their_indicator_is_surely_within_the_accuracy(plan):
    """Those of the quick look are held by walls: free ones mostly change more."""
    stages = [name for name in STAGES if name in needed_stages(plan.scene)]
    sizes = next(one.indicator for one in plan.effects if one.name == RINGS.name)
    for doubt in (RINGS.larger(plan.scene), UNSURE):
        rings = replace(RINGS, larger=lambda scene, doubt=doubt: doubt)
        force = plan.errors["rolling.loads"]["maximum force"] + (doubt - 1) * sizes["maximum force"]
        life = plan.errors["rolling.life"]["life"] + (doubt - 1) * sizes["life"]
        lost = max(
            error + (doubt - 1) * sizes[name]
            for name, error in plan.errors["rolling.friction"].items()
        )
        wanted = force, life, lost
        for short in (None, 0, 1, 2):
            allowed = [(0.99 if k == short else 1.01) * error for k, error in enumerate(wanted)]
            scene = with_accuracy(plan.scene, *allowed)
            found = surely_small(scene, rings, estimates(scene, stages, plan.cases))
            assert found == (short is None)
    assert not surely_small(
        plan.scene, SLICED, estimates(plan.scene, stages, plan.cases)
    )  # it is in


@pytest.mark.parametrize(
    ("words", "doubt"),
    [({}, 1.25), ({"section": {"width": 0.16, "height": 0.3}}, UNSURE), ({"supports": []}, UNSURE)],
)
def test_the_indicator_of_rings_is_nearly_a_bound_where_walls_hold_them_under_all_rows(
    words, doubt
):
    data = tomllib.loads((QUICK.parent / "dlc_1_1.toml").read_text(encoding="utf-8"))
    data["bearings"]["M"]["inner_ring"] |= words
    assert RINGS.larger(make_scene(data)) == doubt


def test_a_short_run_measures_what_is_in_doubt():
    """The kernels of elastic rings are not compiled for a question that changes nothing."""
    scene = read_scene(QUICK)
    found = asked(scene)
    assert RINGS.name not in found
    assert {"motion of the film", "heat of the film", SLICED.name} <= {*found}
    assert RINGS.name in asked(with_accuracy(scene, 0.24, 0.35))


def test_the_check_leaves_what_is_sure_as_it_is(plan, monkeypatch):
    def again(scene, case, parts):
        yield comparisons.Difference(RINGS.name, "rolling.life", "life", case.name, "others", 0.1)

    monkeypatch.setitem(comparisons.COMPARISONS, "rolling", again)
    case, parts = plan.cases[0], {"rolling": None}
    assert differences(plan.scene, [case], {case.name: parts}).sizes["check"] == 0
    doubtful = with_accuracy(plan.scene, 0.24, 0.35)
    found = differences(doubtful, [case], {case.name: parts})
    assert found["stage"].values.tolist() == [RINGS.name]


def test_an_effect_without_a_bound_is_kept_until_somebody_measures_it():
    """By its indicator heat is small enough for this stop, which no pilot asks."""
    stop = ten_scenes()["stop, 5 MW"].model_copy(update={"accuracy": 0.15})
    kept = make_plan(stop)
    told = next(one for one in kept.effects if one.name == HEAT.name)
    assert max(told.indicator.values()) < 0.05
    assert told.kept
    assert "no bound" in told.why
    small = EffectVerdict({HEAT.name: dict.fromkeys(told.indicator, 0.05)})
    assert not HEAT.is_on(make_plan(stop, verdict=small).scene)


def test_a_floating_shaft_is_followed_through_a_start_before_the_run_of_many_alone():
    """With heat and without takes 1.4 s, of a stop before a run of 2.9 s."""
    one = with_settings(ten_scenes()["start, 5 MW"], "journal", {"self_aligning": False})
    loads = one.loads.model_copy(update={"wind_speeds": list(range(4, 25, 2))})
    many = one.model_copy(update={"loads": loads})
    assert pilot(one, outcomes=None, brief=True) is None  # else None would be called
    assert HEAT.name in asked(one)  # by plan --pilot
    assert HEAT.name in asked(many, brief=True)
