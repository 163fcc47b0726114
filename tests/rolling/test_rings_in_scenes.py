"""Flexible rings as a scene asks for them."""

import math
import tomllib
from dataclasses import fields

import numpy as np
import pytest
from synthetic import cube_file

import loadflow as lf
from loadflow.errors import InputError
from loadflow.rolling import (
    FiniteElementRing,
    FlexibleRings,
    MeshedRing,
    RingBeam,
    RingProfile,
    RingSection,
    SlewingBearing,
    SolidRing,
    Support,
    patch_points,
)
from loadflow.scene.bearings import standing_ring
from loadflow.scene.scene import make_scene
from loadflow.scene.written import anchored
from loadflow.stages.registry import models

GEOMETRY = {
    "balls": 100, "ball_diameter": 0.04, "pitch_diameter": 2.5, "groove_radius": 0.021,
    "contact_angle": 0.7854,
}  # fmt: skip
SPHERICAL = {
    "rollers": 30, "roller_diameter": 0.09, "roller_length": 0.14, "pitch_diameter": 1.0,
    "contact_angle": 0.21,
}  # fmt: skip


def test_a_run_with_flexible_rings_keeps_every_sample_and_shifts_the_forces(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(12.0,), seeds=(1,))
    largest = {}
    for rings in ("rigid", "flexible"):
        scene = make_scene(
            {
                "name": rings, "loads": {"source": "files", "files": [str(cube)]},
                "results": ["rolling.life"], "rolling": {"rings": rings},
            }
        )  # fmt: skip
        table = lf.run(scene, out=tmp_path, report=False).tree["rolling"]
        assert int(table["not_converged"].sum()) == 0
        assert float(table["largest_residual"].max()) <= 1e-9
        largest[rings] = float(table["largest_ball_force"].max())
    assert largest["flexible"] != pytest.approx(largest["rigid"], rel=0.01)


RING = {"section": {"width": 0.099, "height": 0.12}, "radius": 1.35}


@pytest.mark.parametrize(
    "rolling",
    [{"geometry": GEOMETRY}, {"inner_ring": None, "outer_ring": None}],
    ids=["geometry without rings", "no ring"],
)
def test_flexible_rings_without_data_are_refused(rolling):
    with pytest.raises(InputError, match="inner_ring or outer_ring"):
        make_scene({"name": "x", "rolling": {"rings": "flexible"} | rolling})


def test_a_ring_left_out_is_rigid_and_not_that_of_the_default_bearing():
    for given in ({"geometry": GEOMETRY}, {}):
        rolling = {"rings": "flexible", "outer_ring": RING} | given
        model = make_scene({"name": "x", "rolling": rolling}).rolling.ring_model
        assert model.inner is None
        assert model.outer.radius == 1.35
    default = make_scene({"name": "x", "rolling": {"rings": "flexible"}}).rolling.ring_model
    assert None not in (default.inner, default.outer)


def test_a_ring_may_be_stated_by_the_measures_of_rectangle_and_wall():
    wall = {"radius": 1.35, "height": -0.06, "thickness": 0.06, "length": 1.0}
    rolling = {"rings": "flexible", "geometry": GEOMETRY, "outer_ring": RING | {"supports": [wall]}}
    scene = make_scene({"name": "x", "rolling": rolling})
    ring = scene.rolling.ring_model.outer
    assert ring == standing_ring(0.099, 0.12, 1.35, wall=(0.06, 1.0))
    assert ring.section == RingSection.rectangle(0.099, 0.12)
    # what is written down is what was read
    again = make_scene(tomllib.loads(scene.to_toml()))
    assert again.rolling == scene.rolling


@pytest.mark.parametrize(
    ("ring", "says"),
    [
        ({"section": {"width": -1.0, "height": 0.1}}, "width: must be > 0"),
        ({"section": {"width": "wide", "height": 0.1}}, "section"),
        ({"supports": [{"radius": 1.2, "height": 0, "thickness": 0, "length": 1}]}, "thickness of"),
        ({"supports": [{"radius": 1.2, "thickness": 0.1}]}, "thickness"),
        ({"radius": -1.0}, "radius"),
        ({"radius": 1.2}, "outer_ring: radius must be > 1.25 m, got 1.2"),
    ],
)
def test_bad_measures_of_a_ring_are_named(ring, says):
    rolling = {"rings": "flexible", "geometry": GEOMETRY, "outer_ring": RING | ring}
    with pytest.raises(InputError, match=says):
        make_scene({"name": "x", "rolling": rolling})


def test_every_slewing_bearing_of_a_scene_may_have_flexible_rings(tmp_path):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(12.0,), seeds=(1,))
    largest = {}
    for rings in ({}, {"rings": "flexible", "outer_ring": RING}):
        second = {"bearing": "N2", "geometry": GEOMETRY} | rings
        first = {"bearing": "N", "geometry": {"kind": "spherical"} | SPHERICAL}
        scene = make_scene(
            {
                "name": f"with{len(rings)}", "results": ["rolling.life"],
                "loads": {"source": "files", "files": [str(cube)]}, "rolling": [first, second],
            }
        )  # fmt: skip
        assert models()["rolling"].text_of(scene) == f"{'flexible' if rings else 'rigid'} rings"
        table = lf.run(scene, out=tmp_path, report=False).tree["rolling"]
        largest[bool(rings)] = float(table["bearing_force"].sel(bearing="N2").max())
    assert largest[True] != pytest.approx(largest[False], rel=0.01)


TAPERED = {
    "kind": "roller", "rollers": 60, "roller_diameter": 0.085, "roller_length": 0.12,
    "pitch_diameter": 2.5, "contact_angle": 0.7, "rows": 2, "row_spacing": 0.3, "slices": 6,
    "clearance": -50e-6,
}  # fmt: skip
CUPS = {
    "inner_ring": {"section": {"width": 0.15, "height": 0.5}, "radius": 1.14},
    "outer_ring": {"section": {"width": 0.15, "height": 0.5}, "radius": 1.36},
}


@pytest.mark.parametrize("kind", ["tapered", "spherical"])
def test_roller_bearings_of_a_scene_may_have_flexible_rings(tmp_path, kind):
    cube = cube_file(tmp_path / "loads.h5", wind_speeds=(12.0,), seeds=(1,))
    place, geometry, cups = {
        "tapered": ("M", TAPERED, CUPS),
        "spherical": (
            "N",
            {"kind": "spherical"} | SPHERICAL,
            {"outer_ring": {"section": {"width": 0.08, "height": 0.3}, "radius": 0.58}},
        ),
    }[kind]
    life, force = {}, {}
    for rings in ("rigid", "flexible"):
        part = {"bearing": place, "geometry": geometry, "rings": rings} | cups
        scene = make_scene(
            {
                "name": rings, "results": ["rolling.life", "rolling.loads"], "rolling": part,
                "loads": {"source": "files", "files": [str(cube)]},
                "shaft": {"moment": {}} if place == "M" else {"two_point": {}},
            }
        )  # fmt: skip
        table = lf.run(scene, out=tmp_path, report=False).tree["rolling"]
        assert int(table["not_converged"].sum()) == 0
        life[rings] = float(table["bearing_life_hours"].sel(bearing=place).max())
        force[rings] = float(table["bearing_force"].sel(bearing=place).max())
        assert float(table["bearing_design_safety"].min()) > 0
    assert life["flexible"] != pytest.approx(life["rigid"], rel=0.02)
    assert force["flexible"] != pytest.approx(force["rigid"], rel=1e-3)


def test_flexible_rings_of_other_bearings_are_refused():
    crossed = {"kind": "crossed", "rollers": 60, "roller_diameter": 0.04, "roller_length": 0.03}
    first = {"geometry": crossed | {"pitch_diameter": 2.5}, "rings": "flexible", "outer_ring": RING}
    with pytest.raises(InputError, match="rings of a crossed bearing are rigid"):
        make_scene({"name": "x", "rolling": [first]})


def part_of(place, ring):
    from loadflow.scene.scene import read_scene

    words = ", ".join(f"{key} = {value!r}" for key, value in ring.items())
    (place / "scene.toml").write_text(
        f"""
        results = ["rolling.life"]
        [bearings.M]
        kind = "four-point"
        rings = "flexible"
        outer_ring = {{ {words} }}
        [bearings.M.geometry]
        balls = 45
        ball_diameter = 0.015
        pitch_diameter = 0.25
        groove_radius = 0.0078
        contact_angle = {math.pi / 4}
        """
    )
    return read_scene(place / "scene.toml").rolling


def test_a_ring_with_its_housing_may_be_given_as_a_matrix_in_a_file(tmp_path):
    beam = RingBeam(
        section=RingSection.rectangle(0.05, 0.04), radius=0.15,
        supports=(Support.wall(0.15, -0.02, 0.01, 0.2),),
    )  # fmt: skip
    geometry = SlewingBearing(
        balls=45, ball_diameter=0.015, pitch_diameter=0.25, groove_radius=0.0078,
        contact_angle=math.pi / 4,
    )  # fmt: skip
    points = patch_points(geometry, "outer", geometry.contacts().azimuth)
    factor = beam.flexibility(points)
    size = 3 * 2 * 45
    matrix = np.einsum("kbcm,KBCm->kbcKBC", factor, factor).reshape(size, size)
    np.save(tmp_path / "housing.npy", matrix)
    part = part_of(tmp_path, {"kind": "matrix", "file": "housing.npy"})  # beside the scene
    load = (6.5e3, 0.0, 8e3), (0.0, 2e3)
    got = part.geometry.equilibrium(*load, rings=part.ring_model)
    known = geometry.equilibrium(*load, rings=FlexibleRings(outer=beam))
    rigid = geometry.equilibrium(*load)
    assert got.maximum_force == pytest.approx(known.maximum_force, rel=1e-5)
    assert abs(known.maximum_force / rigid.maximum_force - 1) > 0.01
    # what is written knows the file by its content
    assert len(part.outer_ring.sha256) == 64
    np.save(tmp_path / "housing.npy", 2 * matrix)
    with pytest.raises(InputError, match="has changed since"):
        part_of(tmp_path, {"kind": "matrix", "file": "housing.npy",
                           "sha256": part.outer_ring.sha256})  # fmt: skip


def test_files_of_a_candidate_lie_beside_the_scene_as_those_of_its_bearings_do(tmp_path):
    ring = {"outer_ring": {"kind": "matrix", "file": "housing.npy"}}
    found = anchored({"bearings": {"M": ring}, "candidates": {"own": {"M": [ring]}}}, tmp_path)
    whole = {"outer_ring": {"kind": "matrix", "file": str(tmp_path / "housing.npy")}}
    assert found == {"bearings": {"M": whole}, "candidates": {"own": {"M": [whole]}}}


@pytest.mark.parametrize(
    ("ring", "says"),
    [
        ({"kind": "matrix", "file": "missing.npy"}, "cannot be read"),
        ({"kind": "matrix", "file": "scene.toml"}, "no table of numbers"),
        ({"kind": "matrix", "file": "odd.txt"}, "square with 3 n rows"),
        ({"kind": "matrix", "file": "soft.txt", "form": "stiffness"}, "positive definite"),
        ({"kind": "plate", "file": "odd.txt"}, "kind must be one of beam, matrix, finite-element"),
    ],
)
def test_files_that_are_no_ring_are_named(tmp_path, ring, says):
    np.savetxt(tmp_path / "odd.txt", np.eye(4))
    np.savetxt(tmp_path / "soft.txt", np.zeros((270, 270)))
    with pytest.raises(InputError, match=says):
        part_of(tmp_path, ring)


MESHED = {"kind": "finite-element", "inside": 0.2535, "outside": 0.31, "bottom": -0.02,
          "top": 0.02, "held": "bottom", "bed": 1e12, "grip": 1e12}  # fmt: skip


def meshed(**changes):
    geometry = {"balls": 45, "ball_diameter": 0.015, "pitch_diameter": 0.25,
                "groove_radius": 0.0078, "contact_angle": math.pi / 4}  # fmt: skip
    rolling = {"bearing": "M", "rings": "flexible", "geometry": geometry,
               "outer_ring": MESHED | changes}  # fmt: skip
    return make_scene({"name": "x", "results": ["rolling.life"], "rolling": rolling}).rolling


def test_a_ring_of_finite_elements_is_meshed_with_the_grooves_of_its_bearing():
    part = meshed()
    geometry = part.geometry
    profile = RingProfile(
        bearing=geometry, ring="outer", inside=0.2535, outside=0.31, bottom=-0.02, top=0.02
    )
    ring = FiniteElementRing(profile=profile, held="bottom", bed=1e12, grip=1e12)
    load = (6.5e3, 0.0, 8e3), (0.0, 2e3)
    got = geometry.equilibrium(*load, rings=part.ring_model)
    known = geometry.equilibrium(*load, rings=FlexibleRings(outer=ring))
    rigid = geometry.equilibrium(*load)
    assert got.maximum_force == pytest.approx(known.maximum_force, rel=1e-9)
    assert abs(known.maximum_force / rigid.maximum_force - 1) > 0.002
    beam = geometry.equilibrium(*load, rings=FlexibleRings(outer=ring.as_beam()))
    assert got.maximum_force == pytest.approx(beam.maximum_force, rel=0.05)
    again = make_scene(
        {"name": "x", "results": ["rolling.life"], "rolling": part.model_dump(mode="json")}
    )
    assert again.rolling.outer_ring == part.outer_ring


def test_a_ring_held_in_sectors_is_meshed_all_round():
    ring = meshed(sectors=[[0.0, 0.8], [math.pi, 0.8]]).ring_model.outer
    assert isinstance(ring, SolidRing)
    assert ring.sectors == ((0.0, 0.8), (math.pi, 0.8))


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"inside": 0.29}, "the raceway must reach"),
        ({"top": 0.005, "bottom": -0.005}, "the grooves from"),
        ({"top": -0.05}, "must be > bottom"),
        ({"held": "side"}, "held"),
    ],
)
def test_meshed_rings_that_do_not_fit_are_refused_by_name(changes, says):
    with pytest.raises(InputError, match=says):
        meshed(**changes)


def test_rings_of_rollers_are_not_meshed():
    geometry = {"kind": "spherical"} | SPHERICAL
    with pytest.raises(InputError, match="grooves for balls"):
        make_scene(
            {"name": "x", "rolling": {"bearing": "N", "rings": "flexible", "geometry": geometry,
                                      "outer_ring": MESHED | {"inside": 1.2, "outside": 1.4}}}
        )  # fmt: skip


def test_every_key_of_a_meshed_ring_moves_the_forces():
    """What the walk over all keys of a scene does for the rings of its own scenes."""
    other = {"inside": 0.2525, "outside": 0.33, "bottom": -0.025, "top": 0.025, "held": "back",
             "bed": 1e11, "grip": 1e11, "across": 3, "resolution": 4.0,
             "elastic_modulus": 1e11, "poisson_ratio": 0.2}  # fmt: skip
    assert {*other, "sectors"} == {field.name for field in fields(MeshedRing)}
    load = (6.5e3, 0.0, 8e3), (0.0, 2e3)

    def force(**changes):
        part = meshed(**changes)
        return float(part.geometry.equilibrium(*load, rings=part.ring_model).maximum_force)

    usual = force()
    moved = {key: abs(force(**{key: value}) / usual - 1) for key, value in other.items()}
    assert min(moved.values()) > 1e-7, moved
