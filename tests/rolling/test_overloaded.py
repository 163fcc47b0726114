"""Bearings that are far too small for their loads are told by name, with the factor."""

import json

import numpy as np
import pytest
from synthetic import cube_file

from loadflow.errors import SolverError
from loadflow.planning.accuracy import errors_beside, expected_errors
from loadflow.planning.effects import Estimates
from loadflow.planning.plan import make_plan
from loadflow.rolling import (
    BallBearing,
    CrossedRollerBearing,
    RollerBearing,
    RollerRaceways,
    ThreeRowRollerBearing,
    ToroidalRollerBearing,
    main_bearings,
)
from loadflow.rolling.rating.static import static_overload
from loadflow.scene.cases import list_cases
from loadflow.scene.scene import make_scene
from loadflow.stages.effects.registry import EFFECTS
from loadflow.stages.effects.rolling_heat import ROLLING_HEAT
from loadflow.stages.effects.situation import situation
from loadflow.stages.rolling_at_work import rest


def scene_of(folder, size, kind="spherical", results=("rolling.life",)):
    """Two bearings of `size` m pitch diameter with more clearance than their rollers give way."""
    rows = {"rows": 2, "row_spacing": 0.2 * size} if kind == "roller" else {}
    geometry = rows | {
        "rollers": 20, "roller_diameter": size / 10, "roller_length": size / 10,
        "pitch_diameter": size, "contact_angle": 0.15, "clearance": 0.01 * size,
    }  # fmt: skip
    bearing = {"kind": kind, "geometry": geometry}
    cube = cube_file(folder / "loads.h5", seeds=(1,), steps=60)
    return make_scene(
        {
            "name": "small", "loads": {"files": [str(cube)]}, "results": [*results],
            "bearings": {"N": bearing, "N2": bearing},
        }
    )  # fmt: skip


@pytest.mark.parametrize("kind", ["spherical", "roller"])
@pytest.mark.parametrize("size", [0.1, 0.01])
def test_indicators_of_overloaded_bearings_are_numbers(tmp_path, size, kind):
    scene = scene_of(tmp_path, size, kind)
    at = situation(scene, list_cases(scene))
    rolling = [effect for effect in EFFECTS if effect.model == "rolling" and effect.concerns(scene)]
    sizes = {effect.name: effect.indicator(at) for effect in rolling}
    assert "profile and tilt of the rollers" in sizes
    # friction of a hundredth of the size leaves at no temperature, which is told as not known
    heat = sizes.pop("heat of rolling bearings")
    assert (np.isfinite([*heat.values()]) == (size == 0.1)).all()
    assert all(np.isfinite([*found.values()]).all() for found in sizes.values())


def test_a_plan_names_overloaded_bearings_and_the_factor(tmp_path):
    small, large = (make_plan(scene_of(tmp_path, size)) for size in (0.1, 2.5))
    assert large.overloaded == ()
    assert [said.split(" is overloaded")[0] for said in small.overloaded] == [
        "rolling bearing N", "rolling bearing N2",
    ]  # fmt: skip
    assert "times its static capacity" in small.overloaded[0]
    json.dumps([dict(effect.indicator) for effect in small.effects], allow_nan=False)


@pytest.mark.parametrize(("size", "is_known"), [(0.1, True), (0.01, False)])
def test_what_is_not_known_of_an_effect_makes_the_errors_of_its_answers_unknown(
    tmp_path, size, is_known
):
    scene = scene_of(tmp_path, size)
    heat = ROLLING_HEAT.indicator(situation(scene, list_cases(scene)))
    # heat moves the modified life; were it to move the life, that would be as well known
    known = Estimates({ROLLING_HEAT.name: {**heat, "life": heat["modified life"]}})
    life = expected_errors(scene, known)["rolling.life"]["life"]
    modified = errors_beside(scene, known)["rolling.life"]["modified life"]
    assert (life is not None, modified is not None) == (is_known, is_known)


def test_a_bearing_without_equilibrium_is_said_to_be_overloaded(tmp_path):
    part = scene_of(tmp_path, 0.01).rolling.bearings["N"]
    force = np.array([[0.0, 0.0, -1e6]])
    with pytest.raises(SolverError, match=r"overloaded: the load is [\d.e+]+ times its static"):
        rest(part, force, np.zeros((1, 3)))


def test_the_overload_is_that_of_iso_76():
    leaning = RollerBearing(
        rollers=30, roller_diameter=0.05, roller_length=0.06, pitch_diameter=1.0,
        rows=2, row_spacing=0.1, contact_angle=0.3,
    )  # fmt: skip
    capacity = leaning.static_capacity
    thrust = 0.44 / np.tan(0.3)  # Y₀ of two rows
    assert static_overload(leaning, capacity, 0.0, 0.0) == pytest.approx(1.0)
    assert static_overload(leaning, 0.0, capacity, 0.0) == pytest.approx(thrust)
    ring = main_bearings("moment")["M"]
    load = static_overload(ring, 0.0, ring.static_capacity, 0.0)
    assert load == pytest.approx(1.0)
    half = ring.static_capacity * ring.pitch_diameter / 8
    assert static_overload(ring, 0.0, 0.0, half) == pytest.approx(0.5)


@pytest.mark.parametrize(
    ("rows", "arrangement", "sharing"),
    [
        (1, "back-to-back", 1), (2, "tandem", 1), (3, "tandem", 1), (2, "face-to-face", 2),
        (4, "back-to-back", 2),
    ],
)  # fmt: skip
def test_the_overload_knows_how_many_rows_carry_a_thrust(rows, arrangement, sharing):
    leaning = RollerBearing(
        rollers=40, roller_diameter=0.06, roller_length=0.08, pitch_diameter=1.0,
        rows=rows, row_spacing=0.2, contact_angle=0.35, arrangement=arrangement,
    )  # fmt: skip
    push = 0.3 * leaning.static_capacity
    told = static_overload(leaning, 0.0, push, 0.0)
    assert told == pytest.approx(0.3 * sharing * 0.22 / np.tan(0.35))
    # the fullest roller: all of the rows that carry a thrust share it alike
    solved = 1 / leaning.equilibrium((0.0, 0.0, push)).static_safety
    assert told == pytest.approx(solved, rel=0.15)
    assert static_overload(leaning, push, 0.0, 0.0) == pytest.approx(0.3)
    both = static_overload(leaning, push, push, 0.0)
    assert both == pytest.approx(0.3 * (0.5 if sharing == 1 else 1.0) + told)


def test_rows_of_cylindrical_rollers_carry_a_radial_load_together():
    four = RollerBearing(
        rollers=40, roller_diameter=0.06, roller_length=0.08, pitch_diameter=1.0, rows=4,
        row_spacing=0.1,
    )  # fmt: skip
    assert static_overload(four, four.static_capacity, 0.0, 0.0) == pytest.approx(1.0)


def test_bearings_of_every_kind_have_an_overload():
    one = {"roller_diameter": 0.04, "roller_length": 0.038, "pitch_diameter": 2.6}
    crossed = CrossedRollerBearing(rollers=180, **one)
    row = RollerRaceways(rollers=180, **one)
    three = ThreeRowRollerBearing(support=row, retaining=row, radial=row)
    barrels = ToroidalRollerBearing(
        rollers=26, roller_diameter=0.15, roller_length=0.29, pitch_diameter=1.5,
        raceway_radius=1.8, clearance=4e-4,
    )  # fmt: skip
    groove = {"ball_diameter": 0.04, "pitch_diameter": 0.5, "groove_radius": 0.0208, "balls": 16}
    deep, angular = BallBearing(**groove), BallBearing(**groove, contact_angle=np.radians(30))
    for bearing, radial, axial in (
        (crossed, 2.3, 1.0), (three, 0.0, 1.0), (barrels, 1.0, 0.0), (deep, 1.0, 0.5),
        (angular, 1.0, 0.33),
    ):  # fmt: skip
        size = bearing.static_capacity
        assert static_overload(bearing, size, 0.0, 0.0) == pytest.approx(radial)
        assert static_overload(bearing, 0.0, size, 0.0) == pytest.approx(axial)
