"""Indicators of grooves, and of bearings that take a moment."""

from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages.effects import film, shaft
from loadflow.stages.effects.situation import situation


def test_a_groove_matters_the_more_the_nearer_the_load_comes_to_it():
    def size(*grooves):
        supply = {"supply": {"grooves": list(grooves)}} if grooves else {}
        loads = {"wind_speeds": [4.0], "seeds": 1}
        scene = make_scene({"name": "s", "loads": loads, "journal": {"bearings": ["N"]} | supply})
        return film.SUPPLY.indicator(situation(scene, list_cases(scene)))["minimum film"]

    line = {"length": 0.5, "pressure": 6e5}
    above, below = line | {"angle": 3.1416}, line | {"angle": 0.0}
    assert size() == size(above) == 0.0
    assert 0.1 < size(below) < size(below | {"length": 1.0})
    assert size(above | {"arc": 0.5, "pressure": 5e6}) > 0.1


def test_bearings_that_take_a_moment_may_move_loads_and_others_do_not():
    def size(effect, *supports):
        beam = {"sections": [{"outer_diameter": 2.0}], "supports": list(supports)}
        keys = {"shaft": {"two_point": {"beam": beam}}, "journal": {"tilt": True}}
        scene = make_scene({"name": "s", "loads": {"wind_speeds": [12.0]}} | keys)
        return effect.indicator(situation(scene, list_cases(scene)))["bearing load max"]

    free, taking = {"stiffness": "journal"}, {"stiffness": "journal", "takes_moment": True}
    for effect in (shaft.ELASTIC, shaft.STIFFNESS):
        assert size(effect, free, free) == 0.0
        assert 0.02 < size(effect, free, taking) < 0.5
