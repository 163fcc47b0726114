"""SKF's friction torque of each type of bearing beside its formulas by hand; drag of oil."""

from typing import get_args

import numpy as np
import pytest

from loadflow.errors import InputError, ValidityWarning
from loadflow.rolling import BallBearing, FrictionOptions, SlewingBearing
from loadflow.rolling.friction import CatalogueEntry, skf, torques_beside
from loadflow.scene.scene import make_scene
from loadflow.tribology import lubricant

KINDS = get_args(skf.CatalogueKind)
OIL = FrictionOptions(oil=lubricant("iso-vg-68"), temperature=333.15)


def test_skf_sliding_goes_from_boundary_to_full_film():
    series = skf.SkfConstants(kind="cylindrical", r1=1e-6, s1=0.16, s2=0.0015)
    _, still = skf.skf_torque(series, 5e3, 0.0, 0.0, 100e-6, 0.04, 0.08)
    _, fast = skf.skf_torque(series, 5e3, 0.0, 500.0, 100e-6, 0.04, 0.08)
    assert still / fast == pytest.approx(0.15 / 0.02, rel=1e-3)
    rolling, _ = skf.skf_torque(series, 5e3, 0.0, np.array([10.0, 20.0]), 10e-6, 0.04, 0.08)
    assert rolling[1] / rolling[0] == pytest.approx(2**0.6, rel=0.05)


@pytest.mark.parametrize("kind", KINDS)
def test_every_series_of_skf_gives_a_coefficient_of_friction_as_catalogues_know_it(kind):
    for series in skf.skf_series(kind):
        known = skf.skf_constants(kind, series, 1.5 if kind == "tapered" else 0.0)
        # about a tenth of what a bearing of this size carries, of balls less than of rollers
        bore, load = 0.1, 1e4 if known.of_balls else 4e4
        parts = skf.skf_torque(known, load, 0.0, 100.0, 30e-6, bore, 0.18, static_capacity=8e4)
        assert 3e-4 < sum(parts) / (load * bore / 2) < 4e-3, series


def test_skf_torque_of_a_spherical_bearing_is_that_of_its_formula_by_hand():
    known = skf.skf_constants("spherical", "240")
    rolling, sliding = skf.skf_torque(known, 1e6, 2e5, 1.0, 320e-6, 0.75, 1.09)
    mean, n, nu = 920.0, 30 / np.pi, 320.0
    least = min(2.9e-6 * mean**1.85 * 1.974e6**0.54, 4.78e-6 * mean**2.3 * 1.968e6**0.31)
    heat = 1 + 1.84e-9 * (n * mean) ** 1.28 * nu**0.64
    refill = np.exp(-6e-8 * nu * n * 1840 * np.sqrt(5.5 / 680))
    assert rolling == pytest.approx(least * (nu * n) ** 0.6 * refill / heat * 1e-3, rel=1e-12)
    dry = np.exp(-2.6e-8 * (n * nu) ** 1.4 * mean)
    points = 6.95e-3 * mean**0.25 * (1e24 + 240 * 1.6e21) ** (1 / 3)
    lines = 2.1e-2 * mean**0.94 * (1e18 + 68 * 8e15) ** (1 / 3)
    friction = 0.15 * dry + 0.05 * (1 - dry)
    assert sliding == pytest.approx(min(points, lines) * friction * 1e-3, rel=1e-12)


def test_skf_names_the_series_that_it_has():
    with pytest.raises(InputError, match="did you mean 240"):
        skf.skf_constants("spherical", "2400")
    with pytest.raises(InputError, match="axial_factor"):
        skf.skf_constants("tapered", "302")
    with pytest.raises(InputError, match="of others it is left out"):
        skf.skf_constants("spherical", "240", axial_factor=1.5)
    with pytest.raises(InputError, match="kind: must be one of cylindrical"):
        skf.skf_series("ball")
    with pytest.raises(InputError, match="kind: must be one of cylindrical"):
        skf.SkfConstants(kind="ball", r1=1e-6, s1=0.16, s2=0.0015)


# --- balls -------------------------------------------------------------------------------------


def test_skf_torque_of_a_deep_groove_bearing_is_that_of_its_formula_by_hand():
    """6208 with a thrust of a tenth of C₀: α_F = 24.6° 0.1^0.24."""
    known = skf.skf_constants("deep groove", "62")
    found = skf.skf_torque(known, 3e3, 1.9e3, 100.0, 30e-6, 0.04, 0.08, static_capacity=1.9e4)
    n, nu, mean, sine = 3000 / np.pi, 30.0, 60.0, np.sin(np.radians(24.6 * 0.1**0.24))
    points = 3.9e-7 * mean**1.96 * (3e3 + 1.7 / sine * 1.9e3) ** 0.54
    heat = 1 + 1.84e-9 * (n * mean) ** 1.28 * nu**0.64
    refill = np.exp(-6e-8 * nu * n * 120 * np.sqrt(3.1 / 80))
    assert found[0] == pytest.approx(points * (nu * n) ** 0.6 * refill / heat * 1e-3, rel=1e-12)
    dry = np.exp(-2.6e-8 * (n * nu) ** 1.4 * mean)
    slid = 3.23e-3 * mean**-0.145 * (3e3**5 + 36.5 * mean**1.5 / sine * 1.9e3**4) ** (1 / 3)
    assert found[1] == pytest.approx(slid * (0.15 * dry + 0.05 * (1 - dry)) * 1e-3, rel=1e-12)
    radial = skf.skf_torque(known, 3e3, 0.0, 100.0, 30e-6, 0.04, 0.08, static_capacity=1.9e4)
    slid = 3.23e-3 * mean**-0.26 * 3e3 ** (5 / 3)
    assert radial[1] == pytest.approx(slid * (0.15 * dry + 0.05 * (1 - dry)) * 1e-3, rel=1e-12)


@pytest.mark.parametrize(
    ("kind", "series", "r", "s"),
    [
        ("angular contact", "other", (5.03e-7, 1.97, 1.90e-12), (0.013, 0.68, 1.91e-12)),
        ("four-point", "all", (4.78e-7, 2.42, 1.40e-12), (0.012, 0.9, 1.40e-12)),
    ],
)
def test_balls_with_a_contact_angle_are_pressed_by_their_own_inertia_too(kind, series, r, s):
    known = skf.skf_constants(kind, series)
    rolling, sliding = skf.skf_torque(known, 2e3, 1e3, 600.0, 10e-6, 0.05, 0.11)
    n, nu, mean = 18000 / np.pi, 10.0, 80.0
    points = r[0] * mean**1.97 * (2e3 + r[2] * mean**4 * n**2 + r[1] * 1e3) ** 0.54
    heat = 1 + 1.84e-9 * (n * mean) ** 1.28 * nu**0.64
    refill = np.exp(-6e-8 * nu * n * 160 * np.sqrt(known.geometry / 120))
    assert rolling == pytest.approx(points * (nu * n) ** 0.6 * refill / heat * 1e-3, rel=1e-12)
    flung = 2e3 + s[2] * mean**4 * n**2
    slid = s[0] * mean**0.26 * (flung ** (4 / 3) + s[1] * 1e3 ** (4 / 3))
    dry = np.exp(-2.6e-8 * (n * nu) ** 1.4 * mean)
    assert sliding == pytest.approx(slid * (0.15 * dry + 0.05 * (1 - dry)) * 1e-3, rel=1e-12)


def test_deep_groove_bearings_need_their_static_capacity():
    with pytest.raises(InputError, match="static_capacity"):
        skf.skf_torque(skf.skf_constants("deep groove", "62"), 3e3, 0.0, 1.0, 3e-5, 0.04, 0.08)


GROOVE = BallBearing(
    balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3, groove_radius=0.52 * 12.7e-3
)
RING = SlewingBearing(
    balls=40, rows=2, row_spacing=0.1, ball_diameter=0.06, pitch_diameter=0.95,
    groove_radius=0.0312, contact_angle=0.8,
)  # fmt: skip
RING_SIZE = {"bore": 0.8, "outside_diameter": 1.1}


def test_a_row_of_balls_has_the_load_on_the_bearing_and_its_static_capacity():
    loaded = GROOVE.equilibrium([(3e3, 4e3, 1e3), (3e3, 4e3, -1e3)])
    entry = CatalogueEntry(bore=0.045, outside_diameter=0.085, series="62")
    found = torques_beside(loaded, [100.0, -100.0], OIL, entry)
    assert [*found] == ["constant coefficient", "skf"]
    oil = OIL.oil.kinematic_viscosity(OIL.temperature)
    constants = skf.SkfConstants(
        kind="deep groove", r1=3.9e-7, r2=1.7, s1=3.23e-3, s2=36.5, geometry=3.1, starvation=3e-8
    )
    capacity = GROOVE.static_capacity
    parts = skf.skf_torque(constants, 5e3, 1e3, 100.0, oil, 0.045, 0.085, static_capacity=capacity)
    np.testing.assert_allclose(found["skf"], sum(parts), rtol=1e-6)
    np.testing.assert_allclose(found["constant coefficient"], 0.0015 * np.hypot(5e3, 1e3) * 0.0225)


def test_what_rounding_leaves_of_thrust_is_none():
    """SKF has another power of the diameter without thrust, and a jump of a tenth there."""
    loaded = GROOVE.equilibrium([(3e4, 0.0, 0.0)] * 2, [(0.0, 0.0), (10.0, 0.0)])
    entry = CatalogueEntry(bore=0.045, outside_diameter=0.085, series="62")
    found = torques_beside(loaded, 100.0, OIL, entry)["skf"]
    assert found[1] == pytest.approx(found[0], rel=1e-6)


def test_rows_of_a_four_point_ring_share_thrust_and_each_bears_its_part_of_a_moment():
    """Without tilt both rows have half of the thrust; a moment loads them apart."""
    loaded = RING.equilibrium([(0.0, 0.0, 4e5), (0.0, 0.0, 4e5)], [(0.0, 0.0), (4e4, 0.0)])
    entry = CatalogueEntry(**RING_SIZE, series="all")
    found = torques_beside(loaded, 1.0, OIL, entry)["skf"]
    constants = entry.skf(RING, greased=False)
    oil = OIL.oil.kinematic_viscosity(OIL.temperature)
    one = sum(skf.skf_torque(constants, 0.0, 2e5, 1.0, oil, 0.8, 1.1))
    assert found[0] == pytest.approx(2 * one, rel=1e-6)
    assert found[1] > found[0]


# --- drag --------------------------------------------------------------------------------------


def test_drag_of_balls_is_that_of_its_formula_by_hand():
    """6208 in oil to the middle of its mean diameter, H = 30 of 60 mm: V_M = 5.8e-4."""
    known = skf.skf_constants("deep groove", "62")
    found = skf.skf_drag_torque(known, 200.0, 68e-6, 0.04, 0.08, oil_level=0.03)
    n, nu, mean, crowd = 6000 / np.pi, 68.0, 60.0, 3.1 * 120 / 40
    inside = 2 * np.arccos((36 - 30) / 36)
    reach, rim = np.sin(inside / 2), 0.36 * mean**2 * (inside - np.sin(inside)) * 0.05 * crowd
    film = 1.093e-7 * n**2 * mean**3 * (n * mean**2 * reach / nu) ** -1.379 * rim
    swept = 0.4 * 5.8e-4 * crowd * 1e-12 * mean**5 * n**2
    assert found == pytest.approx((swept + film) * 1e-3, rel=1e-12)


def test_drag_of_rollers_is_that_of_its_formula_by_hand():
    """NU 208 of 18 mm, H = 60 mm as the mean diameter: V_M = 1.2e-3, more than half in the bath."""
    known = skf.skf_constants("cylindrical", "2")
    found = skf.skf_drag_torque(known, 200.0, 68e-6, 0.04, 0.08, oil_level=0.06, width=0.018)
    n, nu, mean, crowd = 6000 / np.pi, 68.0, 60.0, 5.1 * 120 / 40
    long = 5 * 0.65 * 18 / mean
    drag = 2.789e-10 * long**3 - 2.786e-4 * long**2 + 0.0195 * long + 0.6439
    swept = 4 * 1.2e-3 * 0.65 * crowd * 1e-12 * drag * 18 * mean**4 * n**2
    inside = 2 * np.arccos(-24 / 36)
    rim = 0.36 * mean**2 * (inside - np.sin(inside)) * 0.05 * crowd
    film = 1.093e-7 * n**2 * mean**3 * (n * mean**2 / nu) ** -1.379 * rim
    assert found == pytest.approx((swept + film) * 1e-3, rel=1e-12)


@pytest.mark.parametrize("kind", KINDS)
def test_drag_grows_with_level_and_speed_from_nothing(kind):
    known = skf.skf_constants(kind, skf.skf_series(kind)[0], 1.5 if kind == "tapered" else 0.0)
    levels = [0.0, 0.01, 0.05, 0.1, 0.14, 0.3]
    speeds = np.array([0.0, 10.0, -20.0])
    torques = np.array(
        [skf.skf_drag_torque(known, speeds, 1e-4, 0.1, 0.18, level, 0.04) for level in levels]
    )
    assert (torques[0] == 0).all()
    assert (torques[:, 0] == 0).all()
    assert (np.diff(torques[:, 1:], axis=0) > 0).all()
    assert (torques[1:, 2] > torques[1:, 1]).all()


def test_thick_oil_is_outside_of_what_skf_says():
    known = skf.skf_constants("deep groove", "62")
    with pytest.warns(ValidityWarning, match="up to 500 mm"):
        skf.skf_drag_torque(known, 1.0, 501e-6, 0.04, 0.08, oil_level=0.04)
    with pytest.warns(ValidityWarning, match="up to 250 mm"):
        skf.skf_drag_torque(known, 1.0, 251e-6, 0.04, 0.08, oil_level=0.041)


def test_an_oil_level_adds_the_drag_of_every_row():
    loaded = RING.equilibrium((0.0, 0.0, 4e5))
    bare = CatalogueEntry(**RING_SIZE, series="all")
    bath = CatalogueEntry(**RING_SIZE, series="all", oil_level=0.1)
    dry, wet = (torques_beside(loaded, 3.0, OIL, entry)["skf"] for entry in (bare, bath))
    oil = OIL.oil.kinematic_viscosity(OIL.temperature)
    row = skf.skf_drag_torque(bare.skf(RING, False), 3.0, oil, 0.8, 1.1, 0.1)
    assert wet - dry == pytest.approx(2 * row, rel=1e-9)


def test_a_grease_has_no_bath():
    grease = FrictionOptions(oil=lubricant("lgep-2"), temperature=313.15)
    entry = CatalogueEntry(**RING_SIZE, series="all", oil_level=0.1)
    with pytest.raises(InputError, match=r"oil_level: a bath of oil; .* is a grease"):
        torques_beside(RING.equilibrium((0.0, 0.0, 4e5)), 3.0, grease, entry)


@pytest.mark.parametrize(
    ("entry", "told"),
    [
        ({"oil_level": 0.1}, "oil_level: give a series or constants"),
        ({"series": "all", "width": 0.1}, "width: give an oil_level"),
        ({"series": "all", "oil_level": -0.1}, "oil_level: must be ≥ 0"),
    ],
)
def test_what_drag_cannot_be_formed_of_is_refused(entry, told):
    with pytest.raises(InputError, match=told):
        CatalogueEntry(**RING_SIZE, **entry)


def test_a_width_is_of_rollers_and_rollers_have_one():
    from test_catalogued import BARRELS

    size = {"bore": 0.75, "outside_diameter": 1.15, "oil_level": 0.1}
    with pytest.raises(InputError, match="width: missing"):
        CatalogueEntry(**size, series="240").check(BARRELS)
    CatalogueEntry(**size, series="240", width=0.4).check(BARRELS)
    with pytest.raises(InputError, match="width: left out where balls roll"):
        CatalogueEntry(**RING_SIZE, series="all", oil_level=0.1, width=0.1).check(RING)
    barrels = skf.SkfConstants(kind="spherical", r1=1e-6, s1=0.16, s2=0.0015)
    with pytest.raises(InputError, match=r"constants\.roller_geometry: missing"):
        CatalogueEntry(**size, constants=barrels, width=0.4).check(BARRELS)
    bare = skf.SkfConstants(kind="cylindrical", r1=1e-6, s1=0.16, s2=0.0015)
    with pytest.raises(InputError, match="roller_geometry"):
        skf.skf_drag_torque(bare, 1.0, 1e-4, 0.3, 0.5, 0.1, 0.1)


# --- scenes ------------------------------------------------------------------------------------

PLACE = {
    "kind": "four-point",
    "geometry": {
        "balls": 40, "rows": 2, "row_spacing": 0.1, "ball_diameter": 0.06, "pitch_diameter": 0.95,
        "groove_radius": 0.0312, "contact_angle": 0.8,
    },
}  # fmt: skip


def scene_of(entry, oil):
    loads = {"wind_speeds": [12.0], "seeds": 1, "duration": 12.0, "step": 0.05, "rung": "tables"}
    return make_scene({
        "name": "balls", "accuracy": "given", "results": ["rolling.friction"], "loads": loads,
        "shaft": {"moment": {}}, "friction": {"lubricant": oil, "temperature": 333.15},
        "bearings": {"M": PLACE | {"catalogue": RING_SIZE | entry}},
    })  # fmt: skip


def test_a_bath_of_grease_is_refused_where_the_scene_states_it():
    with pytest.raises(InputError, match=r"bearings\.M\.catalogue\.oil_level: a bath of oil"):
        scene_of({"series": "all", "oil_level": 0.1}, "lgep-2")


def test_a_run_has_the_torque_after_skf_beside_ours_of_balls_and_their_bath(tmp_path):
    import loadflow as lf

    means = []
    for name, entry in (("dry", {}), ("wet", {"oil_level": 0.1})):
        scene = scene_of({"series": "all"} | entry, "mineral-vg-320")
        run = lf.run(scene, out=tmp_path / name, report=False)
        table = run.tree["friction"].to_dataset()
        assert "mean_palmgren_torque" not in table
        means.append(float(table["mean_skf_torque"].max()))
    assert means[1] > means[0] > 0
