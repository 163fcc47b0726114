"""Torque after catalogues beside our own: in a bearing's loads, in a scene, in a comparison."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import (
    BallBearing,
    FrictionOptions,
    RollerBearing,
    SlewingBearing,
    SphericalRollerBearing,
)
from loadflow.rolling.friction import (
    CatalogueEntry,
    SkfConstants,
    catalogue_torques,
    palmgren_torque,
    skf_constants,
    torques_beside,
)
from loadflow.scene.scene import make_scene
from loadflow.scene.unused import unused_keys
from loadflow.tribology import lubricant

GREASE = FrictionOptions(oil=lubricant("lgep-2"), temperature=313.15)
OIL = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)
PAIR = RollerBearing(
    rollers=48, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.8, contact_angle=0.35,
    rows=2, row_spacing=0.12, clearance=-20e-6,
)  # fmt: skip
BARRELS = SphericalRollerBearing(
    rollers=28, roller_diameter=0.08, roller_length=0.12, pitch_diameter=0.95, contact_angle=0.17
)
PAIR_ENTRY = CatalogueEntry(bore=0.7, outside_diameter=0.9, series="329", axial_factor=1.5)
BARREL_ENTRY = CatalogueEntry(bore=0.75, outside_diameter=1.15, series="240")


def test_each_row_of_a_preloaded_pair_has_the_load_of_its_own_rollers():
    """Rows whose thrusts cancel rub all the same: the load on the whole bearing has none."""
    loaded = PAIR.equilibrium((0.0, -4e5, 0.0))
    forces, angle = loaded.roller_forces, loaded.element_azimuth
    up = -(forces * np.sin(angle)).sum(axis=-1) * math.cos(0.35)
    thrust = forces.sum(axis=-1) * math.sin(0.35)
    assert up.sum() == pytest.approx(4e5, rel=1e-8)
    assert thrust[0] == pytest.approx(thrust[1], rel=1e-8)
    assert thrust[0] > 0.1 * 4e5
    oil = OIL.oil.kinematic_viscosity(OIL.temperature)
    constants = SkfConstants(
        kind="tapered", r1=2.31e-6, r2=10.9, s1=0.009, s2=2, axial_factor=1.5, geometry=6.0,
        starvation=3e-8,
    )  # fmt: skip
    one = catalogue_torques("tapered", up[0], thrust[0], 1.5, oil, 0.7, 0.9, constants)
    found = torques_beside(loaded, 1.5, OIL, PAIR_ENTRY)
    for name, torque in one.items():
        assert found[name] == pytest.approx(2 * torque, rel=1e-8)
    whole = catalogue_torques("tapered", 4e5, 0.0, 1.5, oil, 0.7, 0.9, constants)
    assert found["skf"] > 2 * whole["skf"]


def test_a_spherical_bearing_is_rated_whole():
    loaded = BARRELS.equilibrium([(6e5, 8e5, 2e5), (6e5, 8e5, -2e5)])
    found = torques_beside(loaded, [1.3, -1.3], GREASE, BARREL_ENTRY)
    oil = GREASE.oil.kinematic_viscosity(GREASE.temperature)
    constants = skf_constants("spherical", "240")
    rated = catalogue_torques("spherical", 1e6, 2e5, 1.3, oil, 0.75, 1.15, constants)
    for name, torque in rated.items():
        np.testing.assert_allclose(found[name], torque, rtol=1e-12)


def test_palmgren_needs_no_entry():
    loaded = BARRELS.equilibrium((1e6, 0.0, 0.0))
    oil = GREASE.oil.kinematic_viscosity(GREASE.temperature)
    found = torques_beside(loaded, 1.3, GREASE)
    assert [*found] == ["palmgren"]
    assert found["palmgren"] == palmgren_torque("spherical", 1e6, 0.0, 1.3, oil, 0.95)
    balls = BallBearing(
        balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3, groove_radius=0.52 * 12.7e-3
    )
    assert torques_beside(balls.equilibrium((3e3, 0.0, 0.0)), 10.0, GREASE) == {}


def test_tracks_refill_sooner_from_oil_than_from_grease():
    loaded, entry = PAIR.equilibrium((0.0, -4e5, 1e5)), PAIR_ENTRY
    thickened = FrictionOptions(
        oil=lubricant("mineral-vg-320").__class__(
            viscosities=OIL.oil.viscosities, temperatures=OIL.oil.temperatures, thickener="lithium"
        ),
        temperature=OIL.temperature,
    )
    oil, grease = (
        float(torques_beside(loaded, 20.0, one, entry)["skf"]) for one in (OIL, thickened)
    )
    assert grease < oil


def test_a_tapered_row_without_y_has_that_of_its_contact_angle():
    left_out = CatalogueEntry(bore=0.7, outside_diameter=0.9, series="329")
    assert left_out.skf(PAIR, greased=True).axial_factor == 0.4 / math.tan(0.35)
    assert PAIR_ENTRY.skf(PAIR, greased=True).axial_factor == 1.5


SIZE = {"bore": 0.75, "outside_diameter": 1.15}
BARREL_CONSTANTS = SkfConstants(kind="spherical", r1=2e-6, s1=1e-3, s2=1.0)


@pytest.mark.parametrize(
    ("bearing", "entry", "told"),
    [
        (BARRELS, {"series": "329"}, "series of spherical rollers: must be .* got '329'"),
        (PAIR, {"series": "240", "bore": 0.7, "outside_diameter": 0.9}, "series of tapered"),
        (PAIR, {"constants": BARREL_CONSTANTS, "bore": 0.7, "outside_diameter": 0.9}, "tapered"),
        (BARRELS, {"bore": 0.9}, r"bore: must be < 0\.871"),
        (BARRELS, {"outside_diameter": 1.0}, r"outside_diameter: must be > 1\.02"),
        (BARRELS, {"series": "240", "axial_factor": 1.5}, "axial_factor"),
        (
            SphericalRollerBearing(
                rollers=20, roller_diameter=0.08, roller_length=0.1, pitch_diameter=0.95, rows=1
            ),
            {}, "kind: .* not of this SphericalRollerBearing",
        ),
        (
            SlewingBearing(balls=40, rows=1, ball_diameter=0.06, pitch_diameter=0.95,
                           groove_radius=0.0312, contact_angle=0.8),
            {"series": "240"}, "series of four-point balls",
        ),
    ],
)  # fmt: skip
def test_an_entry_that_is_not_of_the_bearing_is_refused(bearing, entry, told):
    with pytest.raises(InputError, match=told):
        CatalogueEntry(**SIZE | entry).check(bearing)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ({"outside_diameter": 0.7}, "outside_diameter: must be > bore"),
        ({"series": "240", "constants": BARREL_CONSTANTS}, "keep one"),
        ({"axial_factor": 1.5}, "axial_factor: give a series"),
        ({"bore": -1.0}, "bore: must be > 0"),
    ],
)
def test_an_entry_that_contradicts_itself_is_refused(entry, told):
    with pytest.raises(InputError, match=told):
        CatalogueEntry(**SIZE | entry)


def test_no_constant_of_skf_is_negative():
    with pytest.raises(InputError, match="s2: must be ≥ 0"):
        SkfConstants(kind="cylindrical", r1=1e-6, s1=0.1, s2=-1.0)


# --- scenes ------------------------------------------------------------------------------------

PLACE = {
    "kind": "spherical",
    "geometry": {
        "rollers": 28, "roller_diameter": 0.08, "roller_length": 0.12, "pitch_diameter": 0.95,
        "contact_angle": 0.17,
    },
}  # fmt: skip


def scene_with(entry, **more):
    place = PLACE | {"catalogue": SIZE | entry}
    return make_scene(
        {"bearings": {"N2": place}, "results": ["rolling.friction"], "shaft": {"two_point": {}}}
        | more
    )


def test_a_wrong_series_is_refused_where_the_scene_states_it():
    with pytest.raises(InputError, match=r"bearings\.N2: catalogue\.series of spherical rollers"):
        scene_with({"series": "NU"})
    with pytest.raises(InputError, match=r"bearings\.N2\.catalogue\.sries"):
        scene_with({"sries": "240"})


def test_an_entry_and_constants_that_nothing_reads_are_told():
    assert unused_keys(scene_with({"series": "240"})) == {}
    unread = unused_keys(scene_with({"series": "240"}, results=["rolling.loads"]))
    assert "rolling.catalogue" in unread
    sized = {"bearings": "two-spherical", "results": ["rolling.loads"], "shaft": {"two_point": {}}}
    scene = make_scene(sized)
    assert scene.rolling.catalogue.series == "231"
    assert unused_keys(scene) == {}
    constants = {"kind": "spherical", "r1": 2e-6, "s1": 1e-3, "s2": 1.0, "axial_factor": 2.0}
    told = unused_keys(scene_with({"constants": constants}))
    assert "rolling.catalogue.constants.axial_factor" in told


def test_a_run_has_our_torque_beside_that_of_catalogues(tmp_path):
    import loadflow as lf

    loads = {"wind_speeds": [12.0], "seeds": 1, "duration": 12.0, "step": 0.05, "rung": "tables"}
    scene = make_scene({
        "name": "beside", "accuracy": "given", "results": ["rolling.friction"], "loads": loads,
        "shaft": {"two_point": {}},
        "bearings": {"N": PLACE, "N2": PLACE | {"catalogue": SIZE | {"series": "240"}}},
    })  # fmt: skip
    run = lf.run(scene, out=tmp_path)
    table = run.tree["friction"].to_dataset()
    means = ["mean_friction_torque", "mean_palmgren_torque", "mean_skf_torque"]
    for name in [*means, "mean_constant_coefficient_torque"]:
        assert table[name].attrs["units"] == "N m"
        assert (table[name].sel(bearing="N2") > 0).all()
        assert table[name].sel(bearing="N").isnull().all() == (name not in means[:2])
    page = run.report.read_text(encoding="utf-8")
    assert "mean friction torque after SKF" in page
