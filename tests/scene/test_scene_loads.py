"""What no simulation can do is refused with the scene: file, key and what is allowed."""

import re
from importlib import resources

import pytest

from loadflow.errors import InputError
from loadflow.planning.plan import make_plan
from loadflow.scene.cases import Case, list_cases, wind_of
from loadflow.scene.scene import make_scene
from loadflow.stages.loads import hub_loads
from loadflow.turbines import load_turbine


@pytest.mark.parametrize(
    ("loads", "words"),
    [
        ({"dlc": "9.1"}, ["loads.dlc: must be one of", "1.1, 1.2", "7.1", "got '9.1'"]),
        ({"wind_speeds": [30]}, ["loads.wind_speeds = 30", "from 3 to 25 m/s"]),
        ({"dlc": ["6.4", "1.1"], "wind_speeds": [2]}, ["load case 1.1", "from 3 to 25 m/s"]),
        ({"dlc": "6.4", "wind_speeds": [110]}, ["load case 6.4", "stands from 0.1 to 100 m/s"]),
        ({"step": 0.3}, ["loads.step = 0.3", "less than or equal to 0.1"]),
        ({"steady": True}, ["loads.steady = true", "load case 1.1", "6.1, 6.2, 6.3, 7.1"]),
        ({"yaw_errors": [9]}, ["loads.yaw_errors", "9 rad", "±3.1416 rad"]),
        ({"azimuths": [90]}, ["loads.azimuths", "90 rad", "±6.2832 rad"]),
        ({"first_seed": -1}, ["loads.first_seed = -1", "greater than or equal to 0"]),
    ],
)
def test_what_cannot_be_simulated_is_refused(loads, words):
    with pytest.raises(InputError) as info:
        make_scene({"loads": loads}, "own.toml")
    for word in ["own.toml", *words]:
        assert word in str(info.value)


def test_what_the_turbine_does_not_have_is_refused(tmp_path):
    shipped = (resources.files("loadflow.turbines") / "nrel-5mw.toml").read_text(encoding="utf-8")
    plain = re.sub(r"(?m)^individual_gain.*$", "", shipped)
    plain = re.sub(r"(?ms)^\[tower\.bending\].*?(?=^\[)", "", plain)
    path = tmp_path / "plain.toml"
    path.write_text(plain, encoding="utf-8")
    for loads in ({"individual_pitch": True}, {"rung": "tower"}):
        make_scene({"loads": dict(loads)})
        (key,) = loads
        with pytest.raises(InputError, match=rf"loads\.{key} = .* NREL 5 MW has no"):
            make_scene({"turbine": {"name": str(path)}, "loads": loads})


@pytest.mark.parametrize(
    ("loads", "words"),
    [
        ({"wind_class": "S"}, ["loads: wind_class = 'S'", "v_ref"]),
        ({"v_ref": 45.0, "v_ave": 8.0}, ["wind_class = 'I'", "'S', and only it"]),
        ({"category": "S"}, ["loads: category = 'S'", "reference_intensity"]),
        ({"category": "Z"}, ["loads.category = 'Z'", "'A+', 'A', 'B', 'C' or 'S'"]),
        ({"reference_intensity": 1.2}, ["loads.reference_intensity = 1.2", "less than 1"]),
        ({"shear_exponent": 1.0}, ["loads.shear_exponent = 1.0", "less than 1"]),
        ({"scaling": "all"}, ["loads.scaling = 'all'", "'none', 'hub' or 'each'"]),
        ({"lateral": "no"}, ["loads.lateral = 'no'", "'coherent' or 'independent'"]),
        ({"bend_twist": 2.0}, ["loads.bend_twist = 2.0", "less than or equal to 1"]),
        ({"spectrum": "mann", "scaling": "each"}, ["loads: scaling = 'each'", "mann"]),
    ],
)
def test_options_of_wind_and_rotor_are_held_to_their_ranges(loads, words):
    with pytest.raises(InputError) as info:
        make_scene({"loads": loads}, "own.toml")
    for word in ["own.toml", *words]:
        assert word in str(info.value)


def test_a_class_of_ones_own_sets_extreme_wind_turbulence_and_shares():
    own = {"wind_class": "S", "v_ref": 45.0, "v_ave": 8.0, "category": "S"}
    own |= {"reference_intensity": 0.1, "wind_speeds": [8, 16]}
    scene = make_scene({"loads": own})
    assert wind_of(scene, Case("1.1", 8.0, 1)).sigma == pytest.approx(0.1 * (0.75 * 8 + 5.6))
    storm = make_scene({"loads": {k: own[k] for k in own if k != "wind_speeds"} | {"dlc": "6.1"}})
    assert {case.wind_speed for case in list_cases(storm)} == {45.0}
    shares = {c.wind_speed: c.weight for c in list_cases(scene) if c.seed == 1}
    calmer = list_cases(make_scene({"loads": own | {"v_ave": 6.0}}))
    assert shares[8.0] < next(c.weight for c in calmer if c.wind_speed == 8.0)


@pytest.mark.parametrize(
    "change",
    [
        {"shear_exponent": 0.14},
        {"scaling": "hub"},
        {"lateral": "independent"},
        {"dynamic_inflow": True},
        {"dynamic_stall": True},
        {"bend_twist": 0.0},
    ],
    ids=lambda change: next(iter(change)),
)
def test_an_option_reaches_the_loads_and_the_fingerprint_of_their_parts(change):
    short = {"duration": 2.0, "step": 0.1, "wind_grid": [3, 6], "rung": "flap"}
    plain, other = (make_scene({"loads": short | own}) for own in ({}, change))
    assert plain.digest("loads") != other.digest("loads")
    case = Case("1.1", 16.0, 1)
    before, after = (hub_loads(s, case, {})["hub_moment"] for s in (plain, other))
    assert abs(after - before).max() > 1e-4 * abs(before).max()


def test_the_plan_says_which_effects_of_the_rotor_are_off():
    base = {"wind_speeds": [8], "seeds": 1}
    told = make_plan(make_scene({"accuracy": "given", "loads": dict(base)})).left_out
    assert {"dynamic inflow", "dynamic stall"} <= told.keys()
    assert "turn of blades bent both ways" not in told
    on = {"dynamic_inflow": True, "dynamic_stall": True, "bend_twist": 0.0}
    told = make_plan(make_scene({"accuracy": "given", "loads": base | on})).left_out
    assert not {"dynamic inflow", "dynamic stall"} & told.keys()
    assert "turn of blades bent both ways" in told


def test_given_series_are_not_held_to_what_can_be_simulated():
    scene = make_scene({"loads": {"files": ["a.outb"], "dlc": "site", "wind_speeds": [30]}})
    assert scene.loads.dlcs == ("site",)


@pytest.mark.parametrize("name", ["foo", "nowhere.toml"])
def test_an_unknown_turbine_is_named(name):
    with pytest.raises(InputError, match=rf"own\.toml: turbine\.name: .*{name}"):
        make_scene({"turbine": {"name": name}}, "own.toml")


def test_wind_speeds_may_reach_the_bounds_of_the_turbine():
    machine = load_turbine("nrel-5mw")
    ends = [machine.cut_in, machine.cut_out]
    cases = list_cases(make_scene({"loads": {"wind_speeds": ends}}))
    assert {case.wind_speed for case in cases} == set(ends)
    for beyond in (machine.cut_in - 0.5, machine.cut_out + 0.5):
        with pytest.raises(InputError, match=rf"wind_speeds.*{beyond:g}"):
            list_cases(make_scene({"loads": {"wind_speeds": [beyond]}}))


def test_without_results_a_shaft_is_asked_only_for_what_it_has():
    two_point = make_scene({"shaft": {"two_point": {}}})
    assert two_point.wants("journal")
    assert not two_point.wants("rolling")
    moment = make_scene({"shaft": {"moment": {}}})
    assert moment.wants("rolling")
    assert not moment.wants("journal")
    assert make_scene({}).wants("rolling")


def test_a_default_bearing_that_results_ask_for_names_the_key_to_set():
    with pytest.raises(InputError, match=r"rolling\.bearing = 'M'.* the shaft has .*N, N2;"):
        make_scene({"shaft": {"two_point": {}}, "results": ["rolling.life"]})
