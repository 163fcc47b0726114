"""Rings that bearings sized for a turbine bring along."""

import tomllib
from importlib import resources

import numpy as np
import pytest

from loadflow.planning.plan import make_plan
from loadflow.rolling.contacts import HEIGHT
from loadflow.rolling.rings.usual import usual_rings
from loadflow.scene.candidates import candidates_of, machine_names
from loadflow.scene.places import GEOMETRIES
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys

SIZED = {
    f"{turbine}, {name}, {place}": part
    for turbine in machine_names()
    for name, one in candidates_of(turbine).items()
    for place, part in one.items()
    if isinstance(part, dict) and part.get("kind") in GEOMETRIES
}
LOOK = {
    "name": "look", "bearings": "tapered-pair", "shaft": {"moment": {}},
    "loads": {"wind_speeds": [12.0], "seeds": 1, "duration": 60.0},
    "results": ["rolling.loads", "rolling.life"],
}  # fmt: skip


@pytest.mark.parametrize("part", SIZED.values(), ids=SIZED)
def test_rings_lie_under_all_rows_and_beside_the_rollers(part):
    bearing = GEOMETRIES[part["kind"]](**part["geometry"])
    inner, outer = usual_rings(bearing)
    rows = np.abs(bearing.contacts().table[:, HEIGHT]).max()
    middle, size = bearing.pitch_diameter / 2, bearing.element_diameter
    for ring, side in ((inner, -1), (outer, 1)):
        assert ring.height / 2 >= rows
        raceway = ring.radius - side * ring.width / 2
        assert 0.34 * size < side * (raceway - middle) <= 0.5 * size + 1e-3  # 45° … 0°
        assert abs(ring.foot) == pytest.approx(ring.height / 2, abs=1e-3)
    assert part["inner_ring"] == inner.written
    assert part["outer_ring"] == outer.written


@pytest.mark.parametrize(
    ("place", "bore", "outside", "width"),
    [("N", 1.25, 1.75, 0.375), ("N2", 0.75, 1.22, 0.365)],  # INP-A and INP-B, 231/750
)
def test_a_published_bearing_is_as_high_as_its_rings(place, bore, outside, width):
    written = tomllib.loads(
        resources.files("loadflow").joinpath("data", "machines", "nrel-5mw.toml").read_text("utf-8")
    )
    part = written["candidates"]["toroidal-spherical"][place]
    inner, outer = usual_rings(GEOMETRIES[part["kind"]](**part["geometry"]))
    size = part["geometry"]["roller_diameter"]
    seats = [2 * (ring.radius - side * (ring.width / 2 - 0.5 * size))
             for ring, side in ((inner, -1), (outer, 1))]  # fmt: skip
    assert seats == pytest.approx([bore, outside], rel=0.04)
    assert outer.height == pytest.approx(width, rel=0.1)


def test_a_stated_ring_goes_first():
    stated = {"section": {"width": 0.1, "height": 1.7}, "radius": 0.85}
    own = candidates_of("nrel-5mw")["tapered-pair"]["M"] | {"inner_ring": stated}
    rolling = make_scene(LOOK | {"bearings": {"M": own}}).rolling
    assert rolling.inner_ring.radius == 0.85
    assert rolling.outer_ring.radius == pytest.approx(1.111)


def test_the_plan_takes_them_where_the_accuracy_asks_and_the_scene_tells_them():
    scene = make_scene(LOOK)
    plan = make_plan(scene)
    assert plan.scene.rolling.rings == "flexible"
    assert plan.accurate
    coarse = make_plan(make_scene(LOOK | {"accuracy": 0.4}))
    assert coarse.scene.rolling.rings == "rigid"
    assert coarse.errors["rolling.life"]["life"] > 0.2
    written = tomllib.loads(plan.scene.to_toml())["bearings"]["M"]
    assert written["outer_ring"]["radius"] == pytest.approx(1.111)


def test_nobody_is_told_that_rings_are_unused_which_nobody_stated():
    given = make_scene(LOOK | {"accuracy": "given"})
    assert not [key for key in unused_keys(given) if "ring" in key]
    again = make_scene(tomllib.loads(given.to_toml()))
    assert not [key for key in unused_keys(again) if "ring" in key]


@pytest.mark.parametrize("name", ["two-spherical", "cylindrical-tapered", "tapered-pair"])
def test_usual_rings_are_softer_than_rigid_ones_and_carry(name):
    part = make_scene(LOOK | {"bearings": name, "shaft": {"two_point": {}, "moment": {}}}).rolling
    force = (0.0, -1.5e6, 3e5 if part.geometry.takes_thrust else 0.0)
    rigid = part.geometry.equilibrium(force)
    rings = type(part).model_validate(dict(part) | {"rings": "flexible"}).ring_model
    soft = part.geometry.equilibrium(force, rings=rings)
    assert np.linalg.norm(soft.displacement[:3]) > np.linalg.norm(rigid.displacement[:3])
    assert 0.5 < float(soft.maximum_force / rigid.maximum_force) < 1.1
