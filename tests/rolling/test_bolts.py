"""Bolts of a ring: their formulas by other ways, their loads in balance with those of the ring."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import (
    BoltCircle,
    FlexibleRings,
    RingBeam,
    RingSection,
    SlewingBearing,
    bolt_loads,
)
from loadflow.scene.scene import make_scene

SIZE = {"radius": 0.31, "height": -0.05, "count": 40, "diameter": 0.02, "pitch": 2.5e-3,
        "grip": 0.12}  # fmt: skip
BEARING = SlewingBearing(
    balls=24, ball_diameter=0.04, pitch_diameter=0.5, groove_radius=0.0208, contact_angle=0.785
)


def ring_on(bolts, height=0.0):
    section = RingSection.rectangle(0.05, 0.1)
    return RingBeam(section=section, radius=0.3, height=height, supports=(bolts,))


def integrated_cones(bolts, steps=200_000):
    """δ_P by summing slices of both cones, no wider than the room of the bolt."""
    hole, head = 1.1 * bolts.diameter, 1.4 * bolts.diameter
    room = 2 * math.pi * bolts.radius / bolts.count
    tan = 0.362 + 0.032 * math.log(bolts.grip / head / 2) + 0.153 * math.log(room / head)
    deep = (np.arange(steps) + 0.5) / steps * bolts.grip / 2
    outer = np.minimum(head + 2 * deep * tan, room)
    slices = 4 / (math.pi * (outer**2 - hole**2))
    return float(slices.sum() * bolts.grip / steps / 210e9)


@pytest.mark.parametrize("count", [24, 40, 60])
def test_clamped_parts_are_two_cones_that_neighbours_cut_to_a_sleeve(count):
    bolts = BoltCircle(**SIZE | {"count": count})
    assert bolts.clamped_compliance == pytest.approx(integrated_cones(bolts), rel=1e-6)


def test_a_bolt_is_bars_in_series():
    """M20 × 2.5: d₃ = 16.93 mm; head 0.5 d, grip, 0.5 d in the nut, nut 0.4 d."""
    bolts = BoltCircle(**SIZE)
    core, whole = math.pi / 4 * 16.9328e-3**2, math.pi / 4 * 0.02**2
    expected = (0.01 / whole + 0.12 / core + 0.01 / core + 0.008 / whole) / 210e9
    assert bolts.bolt_compliance == pytest.approx(expected, rel=1e-5)
    share = bolts.clamped_compliance / (bolts.clamped_compliance + expected)
    assert bolts.load_factor == pytest.approx(share, rel=1e-5)


def test_a_joint_opens_where_the_pull_frees_what_clamps_it():
    bolts = BoltCircle(**SIZE, tightening_factor=1.0)
    most = bolts.preload / (1 - bolts.load_factor)
    assert bolts.clamping([0.0, most / 2, most]) == pytest.approx([1.0, 0.5, 0.0], abs=1e-12)
    scattered = BoltCircle(**SIZE, tightening_factor=2.0)
    assert scattered.clamping(most / 2) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("face", [-0.05, 0.05])
def test_bolts_carry_force_and_moment_of_the_ring(face):
    """Bolts below a ring that is lifted are pulled, those above it are pressed."""
    bolts = BoltCircle(**SIZE | {"height": face})
    loaded = BEARING.equilibrium(
        (0.0, 0.0, 8e4), (1.5e4, 0.0), rings=FlexibleRings(outer=ring_on(bolts))
    )
    found = bolt_loads(loaded, "outer")[0]
    pull = -np.sign(face) * found.pull
    # forces enter a ring in the radial plane of each ball, which its tilt leaves by a few per cent
    assert pull.sum() == pytest.approx(8e4, rel=1e-3)
    # the section rolls, too: the springs against that share the moment, in its sense or against it
    moment = (pull * 0.31 * np.sin(bolts.azimuth)).sum()
    assert moment == pytest.approx(1.5e4, rel=0.1)


def test_bolts_are_their_springs():
    bolts = BoltCircle(**SIZE)
    load = (2e4, 0.0, 8e4), (1.5e4, 0.0)
    answers = [
        BEARING.equilibrium(*load, rings=FlexibleRings(outer=ring_on(held))).displacement
        for held in (bolts, bolts.springs)
    ]
    np.testing.assert_array_equal(*answers)


def test_more_bolts_hold_a_ring_firmer():
    lifts = [
        float(
            BEARING.equilibrium(
                (0.0, 0.0, 8e4), rings=FlexibleRings(outer=ring_on(BoltCircle(**SIZE | some)))
            ).displacement[2]
        )
        for some in ({"count": 20}, {"count": 40}, {"count": 40, "grip": 0.06})
    ]
    assert lifts[0] > lifts[1] > lifts[2]


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"count": 80}, "heads of 0.028 m overlap"),
        ({"hole": 0.03}, "hole, head"),
        ({"pitch": 0.011}, "pitch: must be <"),
        ({"strength": "5.6"}, "strength: must be one of 8.8, 10.9, 12.9"),
        ({"tightening_factor": 0.9}, "tightening_factor: must be ≥ 1"),
        ({"first_angle": math.nan}, "first_angle"),
    ],
)
def test_bolts_that_cannot_be_are_refused(wrong, told):
    with pytest.raises(InputError, match=told):
        BoltCircle(**SIZE | wrong)


def test_rings_without_bolts_have_no_loads_of_bolts():
    bolts = BoltCircle(**SIZE)
    with pytest.raises(InputError, match="clamp a face of the ring"):
        ring_on(bolts, height=-0.05)
    with pytest.raises(InputError, match="ring is rigid"):
        bolt_loads(BEARING.equilibrium((0.0, 0.0, 8e4)), "outer")
    loaded = BEARING.equilibrium((0.0, 0.0, 8e4), rings=FlexibleRings(outer=ring_on(bolts.springs)))
    with pytest.raises(InputError, match="has no bolts"):
        bolt_loads(loaded, "outer")


# --- scenes ------------------------------------------------------------------------------------


def scene_of(bolts, **more):
    return make_scene({
        "name": "bolts", "accuracy": "given", "results": ["rolling.loads"],
        "loads": {"wind_speeds": [12.0], "seeds": 1, "duration": 12.0, "rung": "tables"},
        "reduction": {"size": 0.1}, "shaft": {"moment": {}},
        "rolling": {
            "bearing": "M", "rings": "flexible",
            "geometry": {
                "balls": 60, "rows": 1, "ball_diameter": 0.06, "pitch_diameter": 2.0,
                "groove_radius": 0.0312, "contact_angle": 0.8,
            },
            "outer_ring": {
                "section": {"width": 0.1, "height": 0.12}, "radius": 1.06, "harmonics": 8,
                "supports": [{"radius": 1.08, "height": -0.06, "diameter": 0.03, "pitch": 3.5e-3,
                              "grip": 0.16} | bolts],
            },
        },
    } | more)  # fmt: skip


def test_a_scene_states_bolts_and_is_read_again_as_it_was_resolved():
    scene = scene_of({"count": 72, "strength": "8.8"})
    (bolts,) = scene.rolling.outer_ring.supports
    assert isinstance(bolts, BoltCircle)
    again = make_scene(scene.model_dump(mode="json"))
    assert again.rolling.outer_ring.supports == (bolts,)
    with pytest.raises(InputError, match=r"grib: .*did you mean grip"):
        scene_of({"count": 72, "grib": 0.1})
    with pytest.raises(InputError, match="overlap"):
        scene_of({"count": 400})


def test_a_run_tells_whether_bolted_joints_stay_closed(tmp_path):
    import loadflow as lf

    run = lf.run(scene_of({"count": 72}), out=tmp_path)
    share = run.tree["rolling"].to_dataset()["bearing_clamping"]
    assert share.attrs["units"] == "1"
    assert 0 < float(share.min()) < 1
    page = run.report.read_text(encoding="utf-8")
    assert "share of the preload that clamps the bolts of its rings" in page
