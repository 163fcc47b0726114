"""Bearings that a scene takes by name: what is said of them, and of turbines that have none."""

import pytest

from loadflow.errors import InputError
from loadflow.scene import candidates
from loadflow.scene.candidates import candidates_of
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys

OWN = {
    "kind": "journal",
    "self_aligning": True,
    "geometry": {"diameter": 1.0, "width": 0.8, "relative_clearance": 1e-3},
}
OWN_PLACES = {"N": OWN, "N2": OWN}


@pytest.mark.parametrize("turbine", ["nrel-5mw", "windpact-1.5mw", "iea-15mw"])
def test_no_key_of_bearings_taken_by_name_is_said_to_have_no_effect(turbine):
    for name in candidates_of(turbine):
        scene = make_scene({"turbine": {"name": turbine}, "bearings": name})
        assert unused_keys(scene) == {}, name
    written = {"turbine": {"name": turbine}, "bearings": OWN_PLACES}
    assert {*unused_keys(make_scene(written))} == {"journal.self_aligning"}


WIDE = {"rollers": 44, "roller_diameter": 0.09, "roller_length": 0.12, "pitch_diameter": 1.4}


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"source": None}, "candidates.two: source: this key is missing"),
        ({"N": {"kind": "roller", "geometry": WIDE | {"pitch_diameter": 1.2}}},
         "candidates.two.N.geometry: rollers: 44 of 0.09 m do not fit"),
        ({}, ""),
    ],
)  # fmt: skip
def test_a_new_arrangement_of_a_turbine_is_told_what_it_lacks(monkeypatch, changed, told):
    stated = {"title": "two", "source": "here", "N": {"kind": "roller", "geometry": WIDE}} | changed
    one = {key: value for key, value in stated.items() if value is not None}
    monkeypatch.setattr(candidates, "machine", lambda turbine: {"candidates": {"two": one}})
    read = candidates_of.__wrapped__  # not the one that remembers what the package has
    if told:
        with pytest.raises(InputError, match=rf"machines/nrel-5mw\.toml: {told}"):
            read("nrel-5mw")
    else:
        assert {*read("nrel-5mw")["two"]["N"]} >= {"inner_ring", "outer_ring", "geometry"}


@pytest.mark.parametrize(
    ("bearing", "told"),
    [
        ({"kind": "roller"}, "geometry"),
        ({"kind": "roller", "geometry": {"rollers": 44, "pitch_diameter": 1.4}}, "roller_diameter"),
        ({"kind": "roller", "geometry": WIDE | {"rolers": 44}}, "rolers"),
    ],
)
def test_a_key_too_few_or_too_many_of_a_new_arrangement_is_told_by_the_scene(
    monkeypatch, bearing, told
):
    stated = {"title": "two", "source": "here", "N": bearing}
    monkeypatch.setattr(candidates, "machine", lambda turbine: {"candidates": {"two": stated}})
    found = candidates_of.__wrapped__("nrel-5mw")["two"]
    with pytest.raises(InputError, match=told):
        make_scene({"candidates": {"two": {"N": found["N"]}}})


def test_a_collar_alone_is_asked_of_bearings_that_have_films_beside_it():
    named = {"bearings": "journal-thrust", "results": ["thrust.film"]}
    assert unused_keys(make_scene(named)) == {}


def test_bearings_by_name_of_which_nothing_is_wanted_are_told():
    named = {"bearings": "journal-lemon", "results": ["loads.statistics"]}
    assert unused_keys(make_scene(named)) == {"journal": "no wanted result reads this section"}


@pytest.mark.parametrize(
    "stated", [{"bearings": "journal-lemon"}, {"candidates": {"spherical": {}}}]
)
@pytest.mark.parametrize(
    ("turbine", "key"), [({"name": "nrel-6mw"}, "name"), ({"file": "/absent/own.toml"}, "file")]
)
def test_a_turbine_that_cannot_be_read_is_told_once(stated, turbine, key):
    with pytest.raises(InputError) as refused:
        make_scene(stated | {"turbine": turbine, "loads": {"seeds": 0}})
    told = str(refused.value).splitlines()
    assert len(told) == 2, told
    assert told[0].startswith(f"scene: turbine.{key}: ")
    assert told[1].startswith("scene: loads.seeds = 0: ")


def test_a_scaled_turbine_without_bearings_of_its_own_asks_for_them():
    told = "\n".join(make_scene({"turbine": {"name": "nrel-5mw@7e6"}}).taken)
    assert "made for nrel-5mw; state those of nrel-5mw@7e6 in [bearings.N]" in told
    assert "state those of nrel-5mw@7e6 in [bearings.M]" in told
    own = {"turbine": {"name": "nrel-5mw@7e6"}, "bearings": OWN_PLACES}
    assert make_scene(own).taken == []
