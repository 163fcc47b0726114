"""Pitch and yaw bearings swing: capacity, life, torque, and the loads under a nacelle."""

import math

import numpy as np
import pytest
from synthetic import case

from loadflow.errors import InputError
from loadflow.rolling import (
    Oscillation,
    PitchMotion,
    RollerBearing,
    SlewingBearing,
    friction_torque_forces,
)
from loadflow.rolling.rating.oscillation import IDLE_TORQUES, MOUNTING_FACTORS
from loadflow.scene.scene import make_scene
from loadflow.shaft import PitchBearing, YawBearing, pitch_loads, yaw_loads
from loadflow.stages import friction, loads, reduction, rolling, shaft
from loadflow.studies.verdicts.verdicts import verdicts

BLADE = SlewingBearing(
    balls=129, rows=2, ball_diameter=0.04, pitch_diameter=1.9, groove_radius=0.0205,
    contact_angle=math.pi / 4, hardness=600.0,
)  # fmt: skip
HUB = case(8.0, 1, steps=200)
GRAVITY = 9.80665


class One:
    dlc, wind_speed, seed, weight, name = "1.1", 8.0, 1, 1.0, "dlc1.1_v8_s1"
    duration = 600.0


def test_a_full_turn_there_and_back_is_two_revolutions():
    turn = Oscillation(amplitude=math.pi, frequency=1.0)  # from −180° to 180° and back
    life = turn.life(BLADE, [1e5], [1.0])
    revolutions = (BLADE.rated_capacity / 1e5) ** 3
    assert life == pytest.approx(revolutions / 2)
    assert turn.hours(3.6e-3) == pytest.approx(1.0)


def test_small_oscillations_last_longer_and_soft_mounts_shorten_life():
    wide, narrow = (Oscillation(math.radians(a), 0.1) for a in (30.0, 10.0))
    lives = [one.life(BLADE, [2e5, 3e5], [0.5, 0.5]) for one in (wide, narrow)]
    assert lives[1] == pytest.approx(3 * lives[0])
    soft = Oscillation(math.radians(30.0), 0.1, mounting="yaw, four-leg tower")
    assert soft.life(BLADE, [2e5, 3e5], [0.5, 0.5]) == pytest.approx(0.25 * lives[0])
    assert MOUNTING_FACTORS["pitch"] == 0.85


def test_rollers_have_their_own_exponent():
    rollers = RollerBearing(
        rollers=40, roller_diameter=0.05, roller_length=0.08, pitch_diameter=1.0, contact_angle=0.3
    )
    turn = Oscillation(math.pi, 1.0)
    expected = (rollers.rated_capacity / 1e5) ** (10 / 3) / 2
    assert turn.life(rollers, [1e5], [1.0]) == pytest.approx(expected)


def test_idle_friction_of_the_blade_bearing_adds_up_to_what_was_measured():
    assert sum(IDLE_TORQUES.values()) == 7560.0
    assert sum(IDLE_TORQUES[part] for part in ("first row", "second row")) == 4260.0


@pytest.mark.parametrize("wrong", [{"amplitude": 0.0}, {"frequency": 0.0}, {"mounting": "sea"}])
def test_what_does_not_swing_is_refused(wrong):
    with pytest.raises(InputError):
        Oscillation(**{"amplitude": 0.1, "frequency": 0.1} | wrong)


def test_a_yaw_bearing_carries_what_stands_on_it():
    yaw = YawBearing(overhang=5.0, shaft_above=2.0, nacelle_mass=240e3, nacelle_downwind=1.9)
    force, moment = np.array([5e5, 1e5, -1e6]), np.array([4e6, 1e6, 3e5])
    found = yaw_loads(yaw, force, moment)
    axial, downwind, left = found["force"].values[0, :, 0]
    assert (axial, downwind, left) == pytest.approx((-1e6 - 240e3 * GRAVITY, 5e5, 1e5))
    _, about_downwind, about_left = found["moment"].values[0, :, 0]
    # the rotor's weight ahead of the tower tips the nacelle forward, its thrust backward
    assert about_left == pytest.approx(1e6 + 2 * 5e5 - 5 * 1e6 + 1.9 * 240e3 * GRAVITY)
    assert about_downwind == pytest.approx(4e6 - 2 * 1e5)
    tilted = yaw_loads(yaw, force, moment, tilt=0.1)
    size = np.linalg.norm(tilted["force"].values[0, :, 0] + [240e3 * GRAVITY, 0, 0])
    assert size == pytest.approx(np.linalg.norm(force))


def scene_of(**yaw):
    swings = {"amplitude": 0.5, "frequency": 0.01, "mounting": "yaw, tubular tower"}
    geometry = {
        "balls": 120, "rows": 1, "ball_diameter": 0.05, "pitch_diameter": 2.6,
        "groove_radius": 0.026, "contact_angle": math.pi / 4, "shoulder_angle": 1.2,
    }  # fmt: skip
    part = {"kind": "four-point", "geometry": geometry, "oscillation": swings} | yaw
    return make_scene(
        {
            "name": "yaw",
            "results": ["rolling.life"],
            "shaft": {"two_point": {}, "yaw": {}},
            "bearings": {"Y": part},
        }
    )


def answered(scene):
    found = {"loads": HUB, "shaft": shaft.bearing_loads(scene, None, {"loads": HUB})}
    found["reduction"] = reduction.reduced_loads(scene, One(), found)
    return rolling.load_distribution(scene, One(), found), found


def test_a_bearing_that_swings_counts_as_running_while_the_rotor_idles():
    scene, hub = scene_of(), HUB.assign(speed=0.0 * HUB["speed"])
    reactions = shaft.bearing_loads(scene, None, {"loads": hub})
    found = friction.losses(scene, One(), {"loads": hub, "shaft": reactions})
    assert bool(found["running"].sel(bearing="Y").all())


def test_a_scene_rates_a_yaw_bearing_by_its_oscillation():
    scene = scene_of()
    part, inputs = answered(scene)
    reduced = inputs["reduction"]["Y"].to_dataset()
    swings = scene.rolling.oscillation
    solved = rolling.solve_bearing(scene, "Y", reduced)
    life = swings.life(scene.rolling.geometry, solved.equivalent_load, reduced["weight"].values)
    hours = rolling.hours_together(rolling.summary({One(): part}), "bearing_life")
    assert hours[0] == pytest.approx(swings.hours(life), rel=1e-9)
    assert np.isfinite(float(part["bearing_truncated"][0]))
    rule = friction_torque_forces(solved.force_sum, 2.6)
    assert float(part["bearing_torque"][0]) == pytest.approx(rule.max(), rel=0.2)


def test_idle_friction_adds_to_the_torque_of_a_scene():
    swings = {"amplitude": 0.5, "frequency": 0.01, "idle_torque": 7560.0}
    more = float(answered(scene_of(oscillation=swings))[0]["bearing_torque"][0])
    usual = float(answered(scene_of())[0]["bearing_torque"][0])
    assert more - usual == pytest.approx(7560.0)


@pytest.mark.parametrize(
    ("named", "sum_of_them"),
    [("first row", 3080.0), (["first row", "first seal"], 4970.0), ([*IDLE_TORQUES], 7560.0)],
)
def test_idle_friction_may_be_named_by_its_parts(named, sum_of_them):
    swings = {"amplitude": 0.5, "frequency": 0.01}
    for kind in (swings, {"kind": "pitch"}):
        place = {} if kind is swings else {"shaft": {"two_point": {}, "pitch": {}}}
        part = scene_of().rolling.model_dump(mode="json", exclude_none=True)["geometry"]
        rolling_part = {"bearing": "Y" if kind is swings else "P", "geometry": part}
        shaft_part = {"shaft": {"two_point": {}, "yaw": {}}} | place
        data = {"name": "idle", "results": ["rolling.life"]} | shaft_part
        rolling_part["oscillation"] = kind | {"idle_torque": named}
        scene = make_scene(data | {"rolling": rolling_part})
        assert scene.rolling.idle_torque == sum_of_them
        # a resolved scene says the number
        assert scene.model_dump(mode="json")["rolling"]["oscillation"]["idle_torque"] == sum_of_them
    assert Oscillation(**swings, idle_torque=named).idle_torque == sum_of_them


def test_an_unknown_part_of_idle_friction_is_refused_and_so_is_less_than_none():
    swings = {"amplitude": 0.5, "frequency": 0.01}
    for wrong, said in (
        ("frist row", "first row"),
        (["seal"], "first seal"),
        ("grease", "-780"),
        (-5.0, "-5"),
    ):
        with pytest.raises(InputError, match=f"idle_torque.*{said}") as told:
            scene_of(oscillation=swings | {"idle_torque": wrong})
        assert "\n" not in str(told.value)  # one line for the key
        with pytest.raises(InputError, match=f"idle_torque.*{said}"):
            Oscillation(**swings, idle_torque=wrong)


def test_idle_friction_is_lost_at_the_speed_of_the_swing():
    swings = {"amplitude": 0.5, "frequency": 0.01}
    lost = []
    for idle in (0.0, 7560.0):
        scene = scene_of(oscillation=swings | {"idle_torque": idle})
        reactions = shaft.bearing_loads(scene, None, {"loads": HUB})
        lost.append(friction.losses(scene, One(), {"loads": HUB, "shaft": reactions}))
    more = (lost[1]["friction_power"] - lost[0]["friction_power"]).values
    np.testing.assert_allclose(more, 7560.0 * 4 * 0.5 * 0.01, rtol=1e-9)


def test_a_yaw_bearing_that_turns_with_the_rotor_is_refused():
    with pytest.raises(InputError, match="oscillation"):
        scene_of(oscillation=None)


def test_what_swings_has_no_modified_life_and_loses_at_its_own_speed():
    scene = scene_of()
    part, inputs = answered(scene)
    table = rolling.summary({One(): part})
    said = [verdict.quantity for verdict in verdicts(scene, {"rolling": table}, None)]
    assert "rating life L10h" in said
    assert "modified rating life L10mh" not in said
    assert np.isnan(table["bearing_modified_life_hours"].values).all()
    lost = friction.losses(scene, One(), inputs)
    ratio = lost["friction_power"] / lost["friction_torque"]
    np.testing.assert_allclose(ratio, 4 * 0.5 * 0.01, rtol=1e-9)


def test_a_pitch_bearing_carries_its_blade():
    force, moment = np.array([6e5, 2e5, -1e5]), np.array([3e4, 1e6, 8e6])
    found = pitch_loads(PitchBearing(inboard=0.4), force, moment)
    assert found["force"].values[0, :, 0] == pytest.approx(force)
    # the blade's force has a longer arm there; the drive takes what turns about the axis
    about = [0.0, 1e6 + 0.4 * 1e5, 8e6 + 0.4 * 2e5]
    assert found["moment"].values[0, :, 0] == pytest.approx(about)
    with pytest.raises(InputError, match="finite"):
        pitch_loads(PitchBearing(), [np.nan, 0, 0], [0, 0, 0])


def test_a_pitch_is_counted_by_its_cycles():
    time = np.arange(0.0, 600.0, 0.05)
    small, large = np.radians(0.04), np.radians(3.0)
    angle = large * np.cos(2 * np.pi * time / 20) + small * np.cos(2 * np.pi * time)
    swing = PitchMotion(threshold=np.radians(0.5)).during(time, angle)
    assert swing.frequency == pytest.approx(1 / 20, rel=0.03)  # dither does not count
    assert swing.amplitude == pytest.approx(large + small, rel=0.02)
    assert swing.mounting_factor == 0.85
    assert PitchMotion().during(time, np.full_like(time, 0.2)) is None
    still, moving = (
        PitchMotion().speed(time, a).max() for a in (0 * angle, large * np.cos(0.1 * np.pi * time))
    )
    assert (still, moving) == pytest.approx((0.0, large * 0.1 * np.pi), rel=1e-3)


def with_blade(pitch):
    """A series of a blade that turns and is pitched."""
    turn = HUB["azimuth"].values if "azimuth" in HUB else np.cumsum(HUB["speed"].values) * 0.025
    none = np.zeros_like(turn)
    force = np.stack([6e5 - 1.7e5 * np.cos(turn), 1.5e5 + none, -1.7e5 * np.sin(turn)])
    moment = np.stack([none, 1.2e6 + 3.5e6 * np.sin(turn), 5e6 + 4e5 * np.cos(turn)])
    return HUB.assign(
        root_force=(("axis", "time"), force),
        root_moment=(("axis", "time"), moment),
        pitch=("time", pitch),
    )


def pitch_scene(**swings):
    return make_scene(
        {
            "name": "pitch",
            "results": ["rolling.life"],
            "shaft": {"two_point": {}, "pitch": {}},
            "bearings": {
                "P": {
                    "kind": "four-point",
                    "geometry": {
                        "balls": 129, "rows": 2, "ball_diameter": 0.04, "pitch_diameter": 1.9,
                        "groove_radius": 0.0205, "contact_angle": math.pi / 4, "hardness": 600.0,
                    },
                    "oscillation": {"kind": "pitch"} | swings,
                }
            },
        }
    )  # fmt: skip


def lived(scene, hub):
    found = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
    found["reduction"] = reduction.reduced_loads(scene, One(), found)
    return rolling.load_distribution(scene, One(), found), found


def test_a_scene_rates_a_pitch_bearing_by_the_pitch_of_its_series():
    scene, time = pitch_scene(), HUB["time"].values.astype(float)
    hub = with_blade(0.05 * np.sin(2 * np.pi * time / time[-1] * 4))
    part, inputs = lived(scene, hub)
    swing = scene.rolling.oscillation.during(time, hub["pitch"].values)
    reduced = inputs["reduction"]["P"].to_dataset()
    solved = rolling.solve_bearing(scene, "P", reduced)
    life = swing.life(scene.rolling.geometry, solved.equivalent_load, reduced["weight"].values)
    hours = rolling.hours_together(rolling.summary({One(): part}), "bearing_life")
    assert hours[0] == pytest.approx(swing.hours(life), rel=1e-9)
    # a blade bearing of 1.9 m on the root of a larger blade than its own
    assert float(part["bearing_static_safety"].min()) < 5
    # a pitch that stands wears no raceway out
    still, _ = lived(scene, with_blade(0.05 + 0.0 * time))
    assert float(still["bearing_life"][0]) == np.inf


def test_a_pitch_bearing_loses_at_the_rate_of_the_pitch():
    scene, time = pitch_scene(), HUB["time"].values.astype(float)
    once, twice = (with_blade(a * np.sin(2 * np.pi * time / time[-1])) for a in (0.05, 0.1))
    lost = []
    for hub in (once, twice, with_blade(0.0 * time)):
        inputs = {"loads": hub, "shaft": shaft.bearing_loads(scene, None, {"loads": hub})}
        lost.append(float(friction.losses(scene, One(), inputs)["friction_power"].mean()))
    assert 1.5 * lost[0] < lost[1]
    assert lost[2] == 0.0


def test_root_loads_are_kept_for_a_pitch_bearing_alone():
    short = {"wind_speeds": [12.0], "duration": 1.0, "rung": "tables", "step": 0.1, "seeds": 1}
    data = {"name": "x", "results": ["loads.statistics"], "loads": short}
    one = make_scene(data)
    from loadflow.scene.cases import list_cases

    (first,) = list_cases(one)
    assert "root_force" not in loads.hub_loads(one, first, {})
    blade = make_scene(data | {"shaft": {"two_point": {}, "pitch": {}}})
    assert {"root_force", "root_moment"} <= set(loads.hub_loads(blade, first, {}).data_vars)


def test_what_a_pitch_bearing_lacks_is_named():
    with pytest.raises(InputError, match=r"root_force.*RootMyc1"):
        shaft.bearing_loads(pitch_scene(), None, {"loads": HUB})
    with pytest.raises(InputError, match="pitch bearing swings"):
        make_scene(
            {
                "name": "x",
                "results": ["rolling.life"],
                "shaft": {"pitch": {}},
                "bearings": {"P": {"kind": "four-point", "geometry": {
                    "balls": 50, "ball_diameter": 0.04, "pitch_diameter": 1.9,
                    "groove_radius": 0.0205, "contact_angle": 0.8}}},
            }
        )  # fmt: skip
    with pytest.raises(InputError, match="amplitude and frequency"):
        scene_of(oscillation={"kind": "pitch"})
