"""What surrounds the machine acts on oil, cold start and air."""

import pytest

from loadflow.errors import InputError
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.studies.compare.words import drawn

COLD = {"temperature": 253.15}
WARM = {"bearings": ["N"], "heat": {"transfer": 100.0}}


def test_bearings_give_their_heat_to_the_surroundings_unless_they_say_otherwise():
    scene = make_scene(
        {"name": "x", "environment": COLD, "journal": WARM, "friction": {"conductance": 50.0}}
    )
    assert scene.journal.heat.ambient_temperature == 253.15
    assert scene.journal.heat.inlet_temperature == 313.15
    assert scene.friction.ambient_temperature == 253.15
    own = {"heat": {"transfer": 100.0, "ambient_temperature": 300.0}}
    assert make_scene(
        {"name": "x", "environment": COLD, "journal": own}
    ).journal.heat.ambient_temperature == 300.0  # fmt: skip


def test_each_place_has_its_own_surroundings():
    known = {"transfer": 9.0, "ambient_temperature": 290.0}
    places = {
        "N": {"kind": "journal", "heat": {"transfer": 100.0}},
        "N2": {"kind": "journal", "heat": known},
    }
    scene = make_scene({"name": "x", "environment": COLD, "bearings": places})
    assert scene.journal.at("N").heat.ambient_temperature == 253.15
    assert scene.journal.at("N2").heat.ambient_temperature == 290.0


def test_candidates_stand_in_the_same_surroundings():
    geometry = {"rollers": 28, "roller_diameter": 0.08, "roller_length": 0.12,
                "pitch_diameter": 0.95, "contact_angle": 0.17}  # fmt: skip
    film = {"kind": "journal", "heat": {"transfer": 100.0}}
    rolls = {"kind": "spherical", "geometry": geometry, "mounting": {"inner_share": 1.1}}
    scene = make_scene(
        {"name": "x", "environment": COLD, "candidates": {"one": {"N": film, "N2": rolls}}}
    )
    assert scene.candidates["one"].journal.at("N").heat.ambient_temperature == 253.15
    assert scene.friction.ambient_temperature == 253.15
    assert unused_keys(scene) == {}


def test_a_cold_start_begins_with_cold_oil():
    cold = COLD | {"cold_start": True}
    scene = make_scene({"name": "x", "environment": cold, "journal": WARM})
    oil = scene.journal.heat
    assert oil.inlet_temperature == 253.15
    assert oil.lubricant(oil.coldest).viscosity > 10 * oil.lubricant(313.15).viscosity
    assert scene.friction.temperature == 253.15


def test_a_cold_start_without_a_temperature_is_refused_and_what_is_idle_is_told():
    with pytest.raises(InputError, match="temperature"):
        make_scene({"name": "x", "environment": {"cold_start": True}})
    assert "environment.temperature" in unused_keys(make_scene({"name": "x", "environment": COLD}))


def film_of(heat, **more):
    data = {"name": "x", "environment": COLD | more, "results": ["journal.film"]}
    return make_scene(data | {"journal": {"bearings": ["N"], "heat": heat}})


@pytest.mark.parametrize(
    "heat",
    [
        {"transfer": 100.0},
        {"sump_transfer": 100.0},
        {"growth": {"shell_share": 0.5}},
        {"kind": "film", "shell_transfer": 100.0},
    ],
)
def test_what_the_surroundings_cool_is_not_called_idle(heat):
    assert unused_keys(film_of(heat)) == {}


def test_the_shell_of_a_film_with_heat_over_its_area_is_as_cold_as_the_surroundings():
    heat = film_of({"kind": "film", "shell_transfer": 100.0}).journal.heat
    assert heat.shell_temperature == 253.15
    idle = film_of({"kind": "film"})
    assert [*unused_keys(idle)] == ["environment.temperature"]


def test_a_shell_of_bronze_shrinks_on_its_shaft_in_the_cold():
    heat = {"growth": {"shell_expansion": 18e-6}}
    cold, steel = (film_of(one, cold_start=True).journal for one in (heat, {"growth": {}}))
    radius = cold.geometry.radius
    change = cold.at_temperature(253.15).geometry.clearance - cold.geometry.clearance
    assert change == pytest.approx(radius * (18e-6 - 11.7e-6) * (253.15 - 293.15))
    same = steel.at_temperature(253.15).geometry.clearance
    assert same == pytest.approx(steel.geometry.clearance)


def test_a_film_of_given_viscosity_cannot_start_cold_which_is_told():
    data = {"name": "x", "environment": COLD | {"cold_start": True}}
    told = unused_keys(make_scene(data | {"results": ["journal.film"]}))
    assert {"environment.temperature", "environment.cold_start"} <= set(told)
    assert "friction" not in told
    assert unused_keys(film_of({"transfer": 0.0}, cold_start=True)) == {}


def test_a_cold_start_beside_stated_temperatures_of_oil_is_told_to_have_no_effect():
    stated = film_of({"transfer": 100.0, "inlet_temperature": 313.15}, cold_start=True)
    told = unused_keys(stated)
    assert [*told] == ["environment.cold_start"]
    assert "state the temperature" in told["environment.cold_start"]


def test_suspensions_are_named_by_their_integration():
    scene = make_scene({"name": "x", "shaft": {"three_point": {}, "moment": {}}})
    told = {one["name"]: one["integration"] for one in drawn(scene)}
    assert told == {"three_point": "partly integrated", "moment": "fully integrated"}
    assert scene.model_copy().shaft.three_point.integration == "partly integrated"
    assert make_scene({"name": "y"}).shaft.two_point.integration == "resolved"
