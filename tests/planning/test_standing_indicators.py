"""Indicators of load cases in which the rotor stands or idles are those of its own speed."""

import numpy as np
import pytest

from loadflow.planning.pilot import hardest
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages.effects import film, film_heat, film_tilt, rotor, thrust
from loadflow.stages.effects.situation import situation
from loadflow.stages.loads import hub_loads

BY_STANDSTILL = (film.MOTION, film_heat.HEAT, film.TURBULENCE, thrust.MOTION, thrust.HEAT)


def scene_of(dlc, **loads):
    given = {"dlc": dlc, "seeds": 1, "yaw_errors": [0.1], "step": 0.05, "rung": "tables"} | loads
    words = {"results": ["journal.film", "thrust.film"], "bearings": ["journal-thrust"]}
    shaft = {"two_point": {"beam": {}}}
    return make_scene({"name": "stands", "loads": given, "shaft": shaft} | words)


def sizes(effect, scene):
    return effect.indicator(situation(scene, list_cases(scene)))


@pytest.mark.parametrize("dlc", ["6.1", "6.2", "6.3", "7.1"])
def test_what_takes_a_turning_shaft_is_nothing_of_one_that_stands(dlc):
    scene = scene_of(dlc)
    at = situation(scene, list_cases(scene))
    assert not at.turns.any()
    for effect in BY_STANDSTILL:
        assert set(effect.indicator(at).values()) == {0.0}, effect.name
    # what is left are the surfaces: asperities carry all, and the shell gives way beneath them
    assert set(film.CONTACT.indicator(at).values()) == {1.0}
    assert all(
        np.isfinite([*film.SHELL.indicator(at).values(), *film_tilt.TILT.indicator(at).values()])
    )
    resting = next(iter(at.films.values()))
    assert resting.minimum_film == pytest.approx(scene.journal.contact_film)
    assert (resting.friction_power == 0.0).all()


@pytest.mark.parametrize("turbine", ["nrel-5mw", "iea-15mw"])
def test_an_idling_rotor_has_the_speed_of_its_own_series(turbine):
    scene = scene_of("6.4", wind_speeds=[4.0, 24.0], duration=40.0)
    scene = scene.model_copy(update={"turbine": type(scene.turbine)(name=turbine)})
    cases = list_cases(scene)
    at = situation(scene, cases)
    for case, speed in zip(cases, at.speed):
        series = hub_loads(scene, case, {})["speed"].values
        assert speed == pytest.approx(float(np.abs(series).mean()), rel=0.2)


def test_a_feathered_rotor_has_little_thrust_and_induces_nothing():
    running, idling = (scene_of(dlc, wind_speeds=[12.0]) for dlc in ("1.1", "6.4"))
    assert (
        max(sizes(rotor.INFLOW, idling).values())
        < 1e-3
        < max(sizes(rotor.INFLOW, running).values())
    )
    assert sizes(thrust.HEAT, idling)["friction power"] < 0.1
    assert sizes(thrust.HEAT, running)["friction power"] > 0.1


def test_beside_cases_that_turn_those_that_stand_leave_films_as_they_are():
    alone, both = (scene_of(dlc, wind_speeds=None) for dlc in ("1.1", ["1.1", "6.1"]))
    for effect in (film.MOTION, film_heat.HEAT, film.CONTACT, film.SHELL, thrust.TILT):
        assert sizes(effect, both) == pytest.approx(sizes(effect, alone)), effect.name
    cases = tuple(list_cases(both))
    assert {case.dlc for case in hardest(both, cases)} == {"1.1"}
