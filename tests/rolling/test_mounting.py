"""Clearance at work: fits and temperatures of the rings."""

import math
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from pydantic import ValidationError

from loadflow.errors import InputError, SolverError
from loadflow.planning.plan import make_plan
from loadflow.rolling import (
    BallBearing,
    CrossedRollerBearing,
    FrictionOptions,
    MeshedRing,
    Mounting,
    RingBeam,
    RingSection,
    RollerBearing,
    RollerRaceways,
    SlewingBearing,
    SphericalRollerBearing,
    ThreeRowRollerBearing,
)
from loadflow.rolling.friction import balanced_temperature
from loadflow.rolling.mounting import unused_of
from loadflow.scene.bearings import FurtherBearing
from loadflow.scene.scene import make_scene
from loadflow.scene.shaft import Shaft
from loadflow.stages import rolling as stage
from loadflow.tribology import lubricant
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

ALPHA = 11.7e-6
ROW = RollerBearing(rollers=24, roller_diameter=0.04, roller_length=0.06, pitch_diameter=0.54)
PAIR = RollerBearing(
    rollers=44,
    roller_diameter=0.07,
    roller_length=0.12,
    pitch_diameter=1.2,
    rows=2,
    row_spacing=0.25,
    contact_angle=0.35,
    clearance=1e-4,
)
SPHERICAL = SphericalRollerBearing(
    rollers=28,
    roller_diameter=0.08,
    roller_length=0.12,
    pitch_diameter=0.95,
    contact_angle=0.17,
    clearance=4e-4,
)
KINDS = [
    ROW,
    PAIR,
    SPHERICAL,
    BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5, groove_radius=0.0208),
    SlewingBearing(
        balls=129,
        rows=2,
        ball_diameter=0.04,
        pitch_diameter=1.9,
        groove_radius=0.0205,
        contact_angle=math.pi / 4,
    ),
    CrossedRollerBearing(
        rollers=180, roller_diameter=0.04, roller_length=0.038, pitch_diameter=2.6
    ),
]


@pytest.mark.parametrize("bearing", KINDS, ids=lambda b: b.kind)
def test_steel_that_is_evenly_warm_keeps_its_clearance(bearing):
    grown = Mounting().gap_growth(bearing, 343.15, 293.15)
    assert abs(grown) < 1e-12 * bearing.pitch_diameter
    warmer = Mounting(inner_share=1.2).gap_growth(bearing, 343.15, 293.15)
    assert warmer < -1e-6 * bearing.pitch_diameter


def test_inner_ring_and_rollers_warmer_than_the_outer_ring_by_the_formula_of_the_makers():
    """Δ = α ΔT E, E the diameter of the outer raceway (catalogue of IKO, needle bearings)."""
    warm = Mounting(outer_temperature=313.15).at_work(ROW, 323.15, 323.15)
    assert warm.clearance == pytest.approx(-ALPHA * 10.0 * 0.58, rel=1e-12)


def test_a_fit_on_a_solid_shaft_and_in_a_thick_housing_by_the_ratio_of_diameters():
    """One steel: d/d_i of the interference; a housing without end takes (1 - …) in closed form."""
    on_shaft = Mounting(bore=0.4, inner_interference=1e-4)
    got = on_shaft.at_work(ROW, 293.15, 293.15).clearance
    assert got == pytest.approx(-1e-4 * 0.4 / 0.5, rel=1e-12)
    housed = Mounting(outside=0.66, outer_interference=1e-4)
    got = housed.at_work(ROW, 293.15, 293.15).clearance
    assert got == pytest.approx(-1e-4 * 0.58 / 0.66, rel=1e-12)


def test_hollow_shafts_and_thin_housings_press_less():
    fits = {"bore": 0.4, "inner_interference": 1e-4, "outside": 0.66, "outer_interference": 1e-4}

    def lost(**more):
        return -Mounting(**fits, **more).at_work(ROW, 293.15, 293.15).clearance

    assert lost(shaft_bore=0.3) < lost(shaft_bore=0.1) < lost()
    assert lost(housing_outside=0.7) < lost(housing_outside=1.2) < lost()
    assert lost(housing_modulus=1e5) == pytest.approx(1e-4 * 0.4 / 0.5, rel=1e-4)


def test_a_seat_that_opens_with_the_heat_does_nothing_more():
    """Aluminium at 70 °C is wider by 0.38 mm than the ring: the fit is gone, and no more."""
    housing = {"housing_expansion": 23.5e-6, "outside": 0.66}
    tight = Mounting(outer_interference=1e-4, **housing)
    loose = Mounting(outer_interference=-1e-3, **housing)
    assert tight.gap_growth(ROW, 343.15, 293.15) == loose.gap_growth(ROW, 343.15, 293.15)
    cold = tight.gap_growth(ROW, 253.15, 253.15)
    assert 2 * cold == pytest.approx(-(1e-4 + 40 * 0.66 * (23.5e-6 - ALPHA)) * 0.58 / 0.66)


def test_rows_back_to_back_open_where_the_shaft_between_them_grows():
    """Axial clearance of a pair by the shaft's length alone, over tan α as a radial one."""
    shaft = Mounting(row_distance="seats", shaft_temperature=303.15, inner_share=0, outer_share=0)
    for arrangement, sign in (("back-to-back", 1.0), ("face-to-face", -1.0)):
        pair = replace(PAIR, arrangement=arrangement)
        grown = shaft.at_work(pair, 293.15, 293.15).clearance - pair.clearance
        axial = ALPHA * 10.0 * 0.25 / 2
        assert grown == pytest.approx(sign * 2 * axial * math.tan(0.35), rel=1e-9)
    tandem = replace(PAIR, arrangement="tandem")
    assert shaft.gap_growth(tandem, 293.15, 293.15) == pytest.approx(0.0, abs=1e-18)


def test_raceways_moved_by_hand_meet_the_contacts_of_the_new_clearance():
    """Inner rings moved as a whole by their growth, row by row, give the forces at work."""
    mounting = Mounting(inner_temperature=313.15)
    warm = mounting.at_work(PAIR, 293.15, 293.15)
    contacts, moved = PAIR.contacts(), warm.contacts()
    gap = mounting.gap_growth(PAIR, 293.15, 293.15)
    assert gap < 0
    np.testing.assert_allclose(moved.table[:, 5] - contacts.table[:, 5], gap, rtol=1e-9)


def test_seats_that_do_not_fit_are_refused_by_name():
    with pytest.raises(InputError, match="inner_interference: give bore"):
        Mounting(inner_interference=1e-4)
    with pytest.raises(InputError, match="shaft_bore: must be < bore"):
        Mounting(bore=0.4, shaft_bore=0.5)
    with pytest.raises(InputError, match="housing_outside: must be > outside"):
        Mounting(outside=0.6, housing_outside=0.5)
    with pytest.raises(InputError, match=r"bore: must be < 0\.5"):
        Mounting(bore=0.6).gap_growth(ROW, 300.0, 300.0)
    axial = RollerRaceways(
        rollers=150, roller_diameter=0.05, roller_length=0.05, pitch_diameter=3.0
    )
    three = ThreeRowRollerBearing(support=axial, retaining=axial, radial=axial)
    with pytest.raises(InputError, match="more than one clearance"):
        Mounting().gap_growth(three, 300.0, 300.0)


def pressed(tubes, interference):
    """Growth of diameters by the fit of two tubes (d_in, d_out, E, ν), by Lamé's constants.

    σ_r = A - B/r² of each: no load inside the inner and outside the outer one, one pressure and the
    interference between them.
    """

    def moved(which, diameter):
        _, _, modulus, poisson = tubes[which]
        row = np.zeros(4)
        row[2 * which] = (1 - poisson) * diameter / modulus
        row[2 * which + 1] = (1 + poisson) / modulus * 4 / diameter
        return row

    def stress(which, diameter):
        row = np.zeros(4)
        row[2 * which : 2 * which + 2] = 1.0, -4 / diameter**2
        return row

    (inside, seat, *_), (_, outside, *_) = tubes
    hollow = stress(0, inside) if inside else np.array([0.0, 1.0, 0.0, 0.0])
    equations = [
        hollow, stress(1, outside), stress(0, seat) - stress(1, seat),
        moved(1, seat) - moved(0, seat),
    ]  # fmt: skip
    constants = np.linalg.solve(np.array(equations), [0.0, 0.0, 0.0, interference])
    return lambda which, diameter: moved(which, diameter) @ constants


def test_a_fit_stretches_the_section_that_a_ring_has():
    """An inner ring with shoulders above its raceway, and of another steel than the shaft."""
    ring = RingBeam(
        section=RingSection.rectangle(0.07, 0.1), radius=0.235,
        elastic_modulus=1.9e11, poisson_ratio=0.27,
    )  # fmt: skip
    fit = Mounting(bore=0.4, inner_interference=1e-4, shaft_bore=0.1)
    got = fit.at_work(ROW, 293.15, 293.15, inner_ring=ring).clearance
    steel = STEEL_MODULUS, STEEL_POISSON
    grown = pressed(((0.1, 0.4, *steel), (0.4, 0.54, 1.9e11, 0.27)), 1e-4)
    assert got == pytest.approx(-grown(1, 0.5), rel=1e-9)
    stiffer = replace(ring, elastic_modulus=STEEL_MODULUS, poisson_ratio=STEEL_POISSON)
    lost = [-fit.at_work(ROW, 293.15, 293.15, inner_ring=r).clearance for r in (None, stiffer)]
    assert lost[1] < 0.99 * lost[0]


def test_an_outer_ring_is_pressed_together_over_its_own_wall():
    """Stated by its faces, with its raceway in the wall; the housing is the tube around it."""
    ring = MeshedRing(inside=0.56, outside=0.66, bottom=-0.05, top=0.05, held="back")
    fit = Mounting(outside=0.66, outer_interference=1e-4, housing_outside=0.9)
    got = fit.at_work(ROW, 293.15, 293.15, outer_ring=ring).clearance
    steel = STEEL_MODULUS, STEEL_POISSON
    grown = pressed(((0.56, 0.66, *steel), (0.66, 0.9, *steel)), 1e-4)
    assert got == pytest.approx(grown(0, 0.58), rel=1e-9)


def test_a_section_that_ends_at_the_raceway_is_that_of_a_ring_without_one():
    ring = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.225)
    fit = Mounting(bore=0.4, inner_interference=1e-4, shaft_bore=0.2)
    grown = [fit.gap_growth(ROW, 293.15, 293.15, inner_ring=each) for each in (None, ring)]
    assert grown[1] == pytest.approx(grown[0], rel=1e-12)


def test_a_seat_that_is_not_at_the_face_of_its_ring_is_refused_by_name():
    ring = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.225)
    with pytest.raises(InputError, match=r"bore: must be the face of the ring's section, 0\.4 m"):
        Mounting(bore=0.3).gap_growth(ROW, 300.0, 300.0, inner_ring=ring)
    with pytest.raises(InputError, match=r"outside: must be the face .* section, 0\.68 m"):
        Mounting(outside=0.8).gap_growth(ROW, 300.0, 300.0, outer_ring=replace(ring, radius=0.315))


def test_scenes_take_the_sections_of_flexible_rings_and_no_others():
    ring = {"section": {"width": 0.07, "height": 0.1}, "radius": 0.235}
    stated = {
        "bearing": "N2", "inner_ring": ring, "mounting": {"bore": 0.4, "inner_interference": 1e-4},
        "geometry": {"kind": "roller", "rollers": 40, "roller_diameter": 0.04,
                     "roller_length": 0.06, "pitch_diameter": 0.54, "clearance": 0.0},
    }  # fmt: skip

    def lost(**more):
        part = FurtherBearing.model_validate(stated | more)
        return -part.at_work(293.15, 293.15).geometry.clearance

    assert lost(rings="rigid") == lost(inner_ring=None)
    assert lost(rings="flexible") < 0.99 * lost(rings="rigid")
    astray = {"bore": 0.3, "inner_interference": 1e-4}
    with pytest.raises(ValidationError, match="bore: must be the face of the ring's section"):
        lost(rings="rigid", mounting=astray)


def test_balls_without_room_left_are_refused_with_the_temperature():
    ball = BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5, groove_radius=0.0202)
    hot = Mounting(inner_temperature=590.0)
    with pytest.raises(SolverError, match=r"at 293\.1 K contacts open by"):
        hot.at_work(ball, 293.15, 293.15)


def balanced(mounting, conductance):
    options = FrictionOptions(oil=lubricant("mineral-vg-320"), temperature=323.15)

    def state(temperature):
        return mounting.at_work(PAIR, temperature, 293.15).equilibrium((2e5, 0.0, 5e4))

    return balanced_temperature(state, 1.2, options, conductance, 293.15, model=PAIR.losses)


def test_preload_by_heat_makes_a_bearing_warmer_and_without_cooling_runs_away():
    even, unequal = Mounting(), Mounting(inner_share=1.3, outer_share=0.7)
    warm, preloaded = balanced(even, 50.0), balanced(unequal, 50.0)
    assert preloaded.temperature > warm.temperature + 5.0
    power = float(preloaded.friction.power)
    assert power == pytest.approx(50.0 * (preloaded.temperature - 293.15), rel=1e-6)
    assert balanced(even, 20.0).temperature < 320.0
    with pytest.raises(SolverError, match="W are left at"):
        balanced(unequal, 20.0)


def scene(environment, mounting, friction=None):
    geometry = {
        "kind": "spherical",
        "rollers": 28,
        "roller_diameter": 0.08,
        "roller_length": 0.12,
        "pitch_diameter": 0.95,
        "contact_angle": 0.17,
        "clearance": 4e-4,
    }
    return make_scene(
        {
            "name": "cold",
            "environment": environment,
            "shaft": {"two_point": {}},
            "rolling": {"bearing": "N2", "geometry": geometry, "mounting": mounting},
            "friction": friction or {},
            "results": ["rolling.life"],
        }
    )


def loads(count=40):
    turn = np.linspace(0.0, 6.0, count)
    force = np.stack([1e5 + 0 * turn, 2e5 * np.sin(turn), -1.5e6 + 3e5 * np.cos(turn)], axis=-1)
    return xr.Dataset(
        {
            "force": (("sample", "axis"), force),
            "moment": (("sample", "axis"), 0 * force),
            "speed": ("sample", 1.2 + 0 * turn),
            "weight": ("sample", 1.0 + 0 * turn),
        }
    )


def test_surroundings_of_a_scene_act_on_clearance_and_forces_of_a_rolling_bearing():
    """A housing of aluminium presses a ring together at -20 °C, and lets it go at 50 °C."""
    housing = {"outside": 1.2, "outer_interference": 1e-4, "housing_expansion": 23.5e-6}
    found = {}
    for temperature in (253.15, 293.15, 323.15):
        around = {"temperature": temperature, "cold_start": True}
        one = scene(around, housing)
        part, warmth = stage.warm_bearing(one, "N2", loads())
        assert warmth == temperature
        found[temperature] = part.geometry.clearance
    assert found[253.15] < found[293.15] < found[323.15] <= 4e-4
    cold = scene({"temperature": 253.15, "cold_start": True}, housing)
    hardest = [
        float(stage.solve_bearing(one, "N2", loads()).maximum_force.max())
        for one in (cold, scene({"temperature": 323.15, "cold_start": True}, housing))
    ]
    assert hardest[0] < 0.99 * hardest[1]  # less clearance, more rollers under load


def test_the_heat_balance_of_a_bearing_sets_its_clearance():
    around, warm_inner = {"temperature": 283.15}, {"inner_share": 1.2, "outer_share": 0.8}
    cooled = scene(around, warm_inner, {"conductance": 100.0})
    part, temperature = stage.warm_bearing(cooled, "N2", loads())
    assert temperature > 284.0
    change = part.geometry.clearance - 4e-4
    assert change == pytest.approx(-ALPHA * 0.95 * 0.4 * (temperature - 283.15), rel=0.1)
    hotter = scene(around, warm_inner, {"conductance": 50.0})
    assert stage.warm_bearing(hotter, "N2", loads())[0].geometry.clearance < part.geometry.clearance


def test_a_shaft_is_solved_anew_where_the_clearance_of_its_bearing_follows_another_temperature():
    def digests(**changed):
        one = scene({}, {"inner_share": 1.2}, changed)
        support = {"stiffness": "rolling"}
        beam = {"supports": [{}, support]}
        shaft = Shaft.model_validate({"two_point": {"beam": beam}})
        told = make_plan(one.model_copy(update={"shaft": shaft})).steps
        return {step.name: step.digest for step in told}

    usual, warm = digests(), digests(temperature=333.15)
    assert usual["loads"] == warm["loads"]
    assert usual["shaft"] != warm["shaft"]


def test_a_seat_within_the_raceway_is_refused_when_the_scene_is_read():
    with pytest.raises(InputError, match="bore: must be <"):
        scene({}, {"bore": 1.0})


def test_fields_without_effect_are_told():
    assert dict(unused_of(Mounting(housing_share=0.5), PAIR)) == {
        "housing_share": "there is no outside"
    }
    given = Mounting(inner_temperature=300.0, inner_share=0.5)
    assert [*dict(unused_of(given, PAIR))] == ["inner_share"]
    apart = Mounting(row_distance="seats", housing_share=0.5)
    assert dict(unused_of(apart, PAIR)) == {}
    assert [*dict(unused_of(apart, ROW))] == ["row_distance", "housing_share"]
