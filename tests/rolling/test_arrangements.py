"""Arrangements of main bearings: in the library, in scenes, through the stage, and binned."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from hypothesis import given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError
from loadflow.rolling import (
    ARRANGEMENTS,
    Lubrication,
    RollerBearing,
    SphericalRollerBearing,
    arrangement_lives,
    bin_loads,
    main_bearings,
    system_life,
)
from loadflow.running.pages import report
from loadflow.scene.cases import Case
from loadflow.scene.scene import make_scene
from loadflow.stages import rolling as stage
from loadflow.studies.lifetime.finished_run import run_lifetime
from loadflow.studies.verdicts.verdicts import verdicts
from loadflow.tribology import lubricant

RNG = np.random.default_rng(7)
COUNT = 400
SPEED = 1.2 + 0.05 * RNG.normal(size=COUNT)


def loads(place):
    """Plausible loads of a 5 MW turbine in the bearing's frame, (n, 3) and (n, 2)."""
    axial = 0.0 if place == "N" else 5e5
    force = np.array([2e5, -1e6, axial]) * (1 + 0.1 * RNG.normal(size=(COUNT, 1)))
    moment = np.array([1e6, 5e5]) * (1 + RNG.normal(size=(COUNT, 2)))
    return force, moment if place == "M" else np.zeros((COUNT, 2))


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_every_arrangement_carries_the_loads_of_its_turbine(arrangement):
    bearings = main_bearings(arrangement)
    series = {place: loads(place) for place in bearings}
    force, moment = ({k: v[i] for k, v in series.items()} for i in (0, 1))
    found = arrangement_lives(bearings, force, moment, SPEED)
    assert set(found) == set(bearings)
    for part in found.values():
        assert part.static_safety > 1.5
        assert part.maximum_pressure < 4e9
        assert part.life_hours > 8766
    together = system_life([part.life_hours for part in found.values()])
    assert together <= min(part.life_hours for part in found.values()) * (1 + 1e-12)
    with pytest.raises(InputError, match="no loads"):
        arrangement_lives(bearings, {}, {}, SPEED)


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_modified_life_of_a_series_adds_the_damage_of_its_steps(arrangement):
    bearings = main_bearings(arrangement)
    series = {place: loads(place) for place in bearings}
    force, moment = ({k: v[i] for k, v in series.items()} for i in (0, 1))
    speed = np.where(np.arange(COUNT) % 10, SPEED, 0.0)  # now and then it stands
    oil = Lubrication(oil=lubricant("mineral-vg-320"), temperature=323.15)
    found = arrangement_lives(bearings, force, moment, speed, lubrication=oil)
    for place, bearing in bearings.items():
        turning = speed > 0
        result = bearing.equilibrium(force[place][turning], moment[place][turning])
        work = bearing.life_modification(result.equivalent_load, speed[turning], oil)
        exponent = 3 if arrangement == "moment" else 10 / 3
        lives = (bearing.rated_capacity / result.equivalent_load) ** exponent * work.factor
        damage = (speed[turning] / lives).sum() / speed.sum()
        hours = 1e6 / damage / (speed.mean() / (2 * np.pi) * 3600)
        assert found[place].modified_life_hours == pytest.approx(hours, rel=1e-9)
    plain = arrangement_lives(bearings, force, moment, speed)
    assert all(part.modified_life_hours is None for part in plain.values())
    thin = replace(oil, oil=lubricant("mineral-vg-320"), temperature=423.15)
    with pytest.raises(InputError, match="kappa"):
        arrangement_lives(bearings, force, moment, 1e-3 * speed, lubrication=thin)


def test_every_kind_of_bearing_has_its_row_in_iso_281():
    kinds = {b.life_kind for name in ARRANGEMENTS for b in main_bearings(name).values()}
    assert kinds == {"radial-roller", "thrust-ball"}


def test_unknown_arrangements_are_refused():
    with pytest.raises(InputError, match="two-spherical"):
        main_bearings("three-spherical")


@pytest.mark.parametrize("arrangement", ARRANGEMENTS)
def test_scenes_take_an_arrangement_and_write_it_out(arrangement):
    scene = make_scene({"name": "x", "rolling": {"arrangement": arrangement}})
    assert scene.rolling.geometries == main_bearings(arrangement)
    assert make_scene(tomllib.loads(scene.to_toml())) == scene


def test_scenes_take_a_list_of_bearings():
    roller = {
        "kind": "roller",
        "rollers": 40,
        "roller_diameter": 0.08,
        "roller_length": 0.14,
        "pitch_diameter": 1.3,
    }
    spherical = roller | {"kind": "spherical", "rollers": 28, "contact_angle": 0.2}
    parts = [{"bearing": "N", "geometry": roller}, {"bearing": "N2", "geometry": spherical}]
    found = make_scene({"name": "x", "rolling": parts}).rolling.geometries
    assert {name: type(part) for name, part in found.items()} == {
        "N": RollerBearing,
        "N2": SphericalRollerBearing,
    }


@pytest.mark.parametrize(
    ("rolling", "message"),
    [
        ({"arrangement": "none"}, "arrangement"),
        ({"arrangement": "moment", "bearing": "N"}, "leave them out"),
        ({"geometry": {"kind": "plain"}}, "kind must be one of"),
        ({"geometry": {"kind": "roller", "balls": 3}}, "balls: unknown key; known here: .*rollers"),
        ({"further": [{"bearing": "M", "geometry": {}}]}, "rolling.further.0.geometry.balls"),
        ({"arrangement": "tapered-pair", "rings": "flexible"}, "give inner_ring or outer_ring"),
        ({"bearing": "X"}, "the shaft has the bearings"),
    ],
)
def test_scenes_refuse_bearings_that_make_no_sense(rolling, message):
    with pytest.raises(InputError, match=message):
        make_scene({"name": "x", "rolling": rolling})


def reduced(place):
    """What the reduction stage gives of one bearing, in the cube's frame (x along the shaft)."""
    force, moment = loads(place)
    turn = [2, 0, 1]
    whole = np.concatenate([moment, np.zeros((COUNT, 1))], axis=1)
    return xr.Dataset(
        {
            "time": ("sample", 0.1 * np.arange(COUNT)),
            "speed": ("sample", SPEED),
            "weight": ("sample", np.ones(COUNT)),
            "force": (("sample", "axis"), force[:, turn]),
            "moment": (("sample", "axis"), whole[:, turn]),
        }
    )


def test_the_stage_keeps_each_bearing_and_the_life_of_the_system():
    scene = make_scene({"name": "x", "rolling": {"arrangement": "cylindrical-tapered"}})
    tree = xr.DataTree.from_dict({place: reduced(place) for place in ("N", "N2")})
    cases = [Case("1.1", 8.0, 1, 0.7), Case("1.1", 12.0, 1, 0.3)]
    parts = {case: stage.load_distribution(scene, case, {"reduction": tree}) for case in cases}
    table = stage.summary(parts)
    first, each = report._rolling_tables(table)
    assert [row[0] for row in each.rows] == [f"{c.name} {b}" for c in cases for b in ("N", "N2")]
    assert len(first.rows) == 2
    judged = verdicts(scene, {"rolling": table}, run_lifetime(scene, {"rolling": table}))
    assert "rolling, all as a system" in {verdict.subject for verdict in judged}
    assert table["bearing"].values.tolist() == ["N", "N2"]
    assert "ball_forces" not in parts[cases[0]]
    hours = table["bearing_life_hours"].sel(load_case="1.1").values
    assert table["life_hours"].item() == hours[0]
    assert table["system_life_hours"].item() == pytest.approx(float(system_life(hours, 9 / 8)))
    # the factor of the largest load is on the load, not on the safety
    factor = table["bearing_static_safety"] / table["bearing_design_safety"]
    assert (table["bearing_load_factor"] == 1.35).all()
    assert ((factor > 1.0) & (factor < 1.36)).all()
    # the same loads in both cases: together they are as one
    one = stage.summary({cases[0]: parts[cases[0]]})
    assert one["bearing_life_hours"].values[0] == pytest.approx(hours)


@pytest.mark.parametrize("asked", [(1e5, 2e5), (2e5, 1e5)])
def test_the_system_is_to_live_as_long_as_the_shortest_life_asked_of_its_bearings(asked):
    first, second = ({"limits": {"life": life}} for life in asked)
    chosen = main_bearings("cylindrical-tapered")
    parts = [
        stated | {"bearing": place, "geometry": geometry}
        for stated, (place, geometry) in zip((first, second), chosen.items(), strict=True)
    ]
    scene = make_scene({"name": "x", "rolling": parts})
    assert scene.rolling.system_life == 1e5
    case = Case("1.1", 8.0, 1, 1.0)
    tree = xr.DataTree.from_dict({place: reduced(place) for place in ("N", "N2")})
    table = stage.summary({case: stage.load_distribution(scene, case, {"reduction": tree})})
    judged = verdicts(scene, {"rolling": table}, run_lifetime(scene, {"rolling": table}))
    limits = {
        v.limit for v in judged if v.subject == "rolling, all as a system" and "life" in v.quantity
    }
    assert limits == {1e5}


@given(st.integers(1, 30))
@settings(max_examples=15, deadline=None)
def test_bins_keep_revolutions_and_mean_load(bins):
    force, moment = loads("M")
    turns = RNG.uniform(0, 1, COUNT)
    f, m, w = bin_loads(force, moment, turns, bins)
    assert w.sum() == pytest.approx(turns.sum())
    assert np.average(f, axis=0, weights=w) == pytest.approx(np.average(force, 0, turns))
    assert np.average(m, axis=0, weights=w) == pytest.approx(np.average(moment, 0, turns))


def test_finer_bins_come_closer_to_the_life_of_the_series():
    bearing = main_bearings("tapered-pair")
    force, moment = loads("M")
    full = arrangement_lives(bearing, {"M": force}, {"M": moment}, SPEED)["M"].life
    errors = []
    for bins in (1, 4, 16):
        f, m, w = bin_loads(force, moment, SPEED, bins)
        life = arrangement_lives(bearing, {"M": f}, {"M": m}, np.ones_like(w), w)["M"].life
        errors.append(life / full - 1)
    assert errors[0] > errors[1] > abs(errors[2])  # averages hide damage
    assert abs(errors[2]) < 0.01


@pytest.mark.parametrize("wrong", [{"bins": 0}, {"revolutions": [1.0]}, {"revolutions": [0.0] * 3}])
def test_bins_refuse_what_makes_no_sense(wrong):
    keys = {"force": np.ones((3, 3)), "moment": np.zeros((3, 2)), "revolutions": [1.0] * 3}
    with pytest.raises(InputError):
        bin_loads(**keys | wrong)
