"""Thrust bearings against exact series, and against themselves."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Control,
    DoubleThrustBearing,
    Film,
    GasMixture,
    Guembel,
    Lubricant,
    MassConserving,
    Pivot,
    RectangularThrustBearing,
    Reynolds,
    Sommerfeld,
    Step,
    ThrustBearing,
)
from loadflow.validation import thrust as exact

GRIDS = ((40, 20), (80, 40), (160, 80))
FILM = Film(Lubricant(0.05), Guembel(), grid=(40, 20))
LANDS = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4, wedge=0.75)
LAWS = [Sommerfeld(), Guembel(), Reynolds(), MassConserving(), GasMixture(1e5)]


@pytest.mark.parametrize("row", exact.SECTORS)
def test_sector_pads_meet_the_exact_series(row):
    angle, a, wedge, load, centre, radius = row
    found = exact.sector_pad(angle, a, wedge, GRIDS[0])
    assert found.force * exact.GAP**2 == pytest.approx(load, rel=3e-3)
    assert found.centre == pytest.approx((radius, centre), abs=1e-3)


@pytest.mark.parametrize("row", [exact.SECTORS[0], exact.SECTORS[5]])
def test_sector_pads_converge_with_second_order(row):
    angle, a, wedge, load, *_ = row
    loads = np.array([exact.sector_pad(angle, a, wedge, grid).force for grid in GRIDS])
    loads *= exact.GAP**2
    assert abs(loads[2] / load - 1) < 5e-4
    assert math.log2((loads[1] - loads[0]) / (loads[2] - loads[1])) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("row", exact.RECTANGULAR)
def test_rectangular_pads_meet_the_exact_series(row):
    ratio, a, wedge, load, centre = row
    found = exact.rectangular_pad(ratio, a, wedge, GRIDS[0])
    assert found.force * exact.GAP**2 / ratio == pytest.approx(load, rel=3e-3)
    assert found.centre[1] == pytest.approx(centre, abs=1e-3)


@pytest.mark.parametrize("row", exact.STEPPED)
def test_steps_of_the_gap_keep_the_second_order(row):
    ratio, a, share, load = row
    found = [exact.stepped_pad(ratio, a, share, grid).force for grid in GRIDS]
    assert found[0] * exact.GAP**2 / ratio == pytest.approx(load, rel=3e-3)
    assert math.log2((found[1] - found[0]) / (found[2] - found[1])) == pytest.approx(2, abs=0.1)


@pytest.mark.parametrize("row", exact.WIDE)
def test_infinitely_wide_pads_are_those_of_rayleigh(row):
    a, wedge, load, centre = row
    found = exact.wide_pad(a, wedge, (80, 4))
    assert found.force * exact.GAP**2 == pytest.approx(load, rel=2e-3)
    assert found.centre[1] == pytest.approx(centre, abs=1e-3)
    assert found.side_flow == pytest.approx(0.0)


def test_wide_rectangles_tend_to_the_infinite_one():
    wide = exact.wide_pad(2.0, 1.0, (40, 4)).force
    errors = [1 - exact.rectangular_pad(b, 2.0, 1.0, (40, 200)).force / b / wide for b in (10, 20)]
    assert 0 < errors[1] < 0.6 * errors[0] < 0.05


def test_friction_of_the_wide_pad_is_the_closed_form():
    """F* = 4 ln a / (a − 1) − 6 / (a + 1)."""
    for a, expected in ((2.0, 0.772589), (2.1887, 0.754202)):
        found = exact.wide_pad(a, 1.0, (160, 4))
        assert found.friction_power * exact.GAP == pytest.approx(expected, rel=2e-4)


def test_a_narrow_sector_is_a_rectangle():
    angle, width = 0.02, 0.02
    sector = ThrustBearing(1, 1 - width / 2, 1 + width / 2, angle, taper=1e-5, wedge=1.0)
    straight = RectangularThrustBearing(1, 1.0, angle, width, taper=1e-5, wedge=1.0)
    film = Film(Lubricant(0.05), grid=(20, 10))
    expected = straight.pressure(1e-5, 1.0, film).force
    assert sector.pressure(1e-5, 1.0, film).force == pytest.approx(expected, rel=2e-4)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
@pytest.mark.parametrize("speed", [10.0, -10.0])
def test_oil_is_conserved_by_every_law_that_keeps_it(law, speed):
    film = Film(Lubricant(0.05), law, edge_pressure=1e5, grid=(24, 12))
    found = LANDS.pressure(1e-4, speed, film)
    assert found.converged
    if not isinstance(law, Reynolds) or speed > 0:  # its rupture loses oil by definition
        assert abs(found.mass_balance) < 1e-9


def test_flow_in_is_flow_out():
    """What enters at the leading edge leaves at the sides and at the trailing edge, there h U / 2
    and what the pressure adds."""
    found = LANDS.pressure(1e-4, 10.0, Film(Lubricant(0.05), grid=(80, 40)))
    drag = 0.5 * 10.0 * 1e-4 * 0.5 * (1.0**2 - 0.5**2) * 6
    assert found.flow > found.side_flow.sum() + drag  # pressure drives oil out at the trailing edge
    assert found.side_flow.min() > 0
    coarse = LANDS.pressure(1e-4, 10.0, Film(Lubricant(0.05), grid=(40, 20)))
    assert coarse.flow == pytest.approx(found.flow, rel=0.01)


def test_force_gap_force_closes():
    state = LANDS.equilibrium(1e6, 10.0, FILM)
    assert state.converged
    assert state.residual < 1e-10
    assert LANDS.pressure(state.gap, 10.0, FILM).force == pytest.approx(1e6, rel=1e-9)
    again = LANDS.equilibrium(LANDS.pressure(8e-5, 10.0, FILM).force, 10.0, FILM)
    assert again.minimum_film == pytest.approx(8e-5, rel=1e-6)


def test_tilted_runner_and_back():
    tilt = (2e-5, -3e-5)
    held = LANDS.pressure(1e-4, 10.0, FILM, tilt=tilt)
    state = LANDS.equilibrium(held.force, 10.0, FILM, moment=held.moment)
    np.testing.assert_allclose(state.tilt, tilt, rtol=1e-6)
    assert state.gap == pytest.approx(1e-4, rel=1e-6)
    assert state.load_share.sum() == pytest.approx(1.0)
    assert np.ptp(state.load_share) > 0.02


def test_stiffness_and_damping_are_the_derivatives():
    at = np.array([1e-4, 2e-5, -1e-5])

    def load(position, velocity=0.0):
        found = LANDS.pressure(position[0], 10.0, FILM, tilt=position[1:], velocity=velocity)
        return np.append(-found.force, found.moment)

    found = LANDS.pressure(at[0], 10.0, FILM, tilt=at[1:])
    steps = 1e-9 * np.eye(3)
    differences = np.array([(load(at + d) - load(at - d)) / 2e-9 for d in steps]).T
    np.testing.assert_allclose(differences, found.stiffness_matrix, rtol=1e-5, atol=1e3)
    squeeze = (load(at, 1e-7) - load(at, -1e-7)) / 2e-7
    np.testing.assert_allclose(squeeze, found.damping_matrix[:, 0], rtol=1e-5, atol=1e-3)


def test_squeeze_carries_without_rotation():
    assert LANDS.pressure(1e-4, 0.0, FILM).force == 0.0
    assert LANDS.pressure(1e-4, 0.0, FILM, velocity=-1e-3).force > 1e5


def test_force_is_that_above_the_edge_pressure():
    plain = LANDS.pressure(1e-4, 10.0, Film(Lubricant(0.05), grid=(40, 20)))
    high = LANDS.pressure(1e-4, 10.0, Film(Lubricant(0.05), edge_pressure=2e5, grid=(40, 20)))
    assert high.force == pytest.approx(plain.force, rel=1e-9)
    assert high.maximum_pressure == pytest.approx(plain.maximum_pressure + 2e5, rel=1e-9)


@pytest.mark.parametrize("share", [0.6, 0.65, 0.7])
def test_centre_of_pressure_of_tilting_pads_is_their_pivot(share):
    bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, pivot=Pivot(share))
    state = bearing.equilibrium(1e6, 10.0, FILM)
    assert state.converged
    assert state.force == pytest.approx(1e6, rel=1e-9)
    assert state.pad_tilt[0, 0] > 0  # the film narrows with the motion
    assert state.minimum_film < state.gap
    held = bearing.pressure(state.gap, 10.0, FILM)
    assert held.force == pytest.approx(1e6, rel=1e-6)


def test_straight_tilting_pad_has_the_centre_of_the_closed_form():
    """Infinitely wide: x_c/L = 0.568688 at a = 2."""
    pad = RectangularThrustBearing(1, 10.0, 1.0, 20.0, pivot=Pivot(0.5687))
    found = pad.pressure(1.5e-4, 0.1, Film(Lubricant(1.0), grid=(40, 40)))
    tilt = found.pad_tilt[0, 0]
    inlet, outlet = 1.5e-4 + 0.5687 * tilt, 1.5e-4 - 0.4313 * tilt
    assert inlet / outlet == pytest.approx(2.0, abs=0.05)


def test_elastic_support_gives_way_by_its_load():
    stiffness = 5e9
    pivot = Pivot(0.5, stiffness=stiffness, tilt_stiffness=math.inf)
    bearing = ThrustBearing(6, 0.5, 1.0, 0.785, taper=1e-4, pivot=pivot)
    state = bearing.equilibrium(1e6, 10.0, FILM)
    np.testing.assert_allclose(state.pad_displacement, 1e6 / 6 / stiffness, rtol=1e-8)
    rigid = LANDS.equilibrium(1e6, 10.0, FILM)
    series = 1 / (1 / rigid.stiffness + 1 / (6 * stiffness))
    assert state.stiffness == pytest.approx(series, rel=1e-6)
    assert state.minimum_film == pytest.approx(rigid.minimum_film, rel=1e-8)


@pytest.mark.parametrize("stiffness", [1e10, 1e9])  # 67 and 667 µm beside a film of 85 µm
def test_tilting_pads_may_give_way_by_more_than_their_film(stiffness):
    force, speed = 4e6, 12.0
    on_rigid = ThrustBearing(6, 0.5, 0.9, 0.8, pivot=Pivot(0.6)).equilibrium(force, speed, FILM)
    bearing = ThrustBearing(6, 0.5, 0.9, 0.8, pivot=Pivot(0.6, stiffness=stiffness))
    state = bearing.equilibrium(force, speed, FILM)
    assert state.gap == pytest.approx(on_rigid.gap - force / 6 / stiffness, abs=1e-10)
    assert state.minimum_film == pytest.approx(on_rigid.minimum_film, rel=1e-6)
    back = bearing.pressure(state.gap, speed, FILM)
    assert back.force == pytest.approx(force, rel=1e-6)
    path = bearing.orbit([0.0, 0.01, 0.02], force, speed, FILM)
    np.testing.assert_allclose(path.gap, state.gap, atol=1e-3 * state.minimum_film)
    np.testing.assert_allclose(path.minimum_film, state.minimum_film, rtol=1e-3)


@pytest.mark.parametrize("stiffness", [1e10, 1e9])
@pytest.mark.parametrize("force", [4e6, -4e6])
def test_a_collar_finds_its_place_between_tilting_pads_on_springs(stiffness, force):
    row = ThrustBearing(6, 0.5, 0.9, 0.8, pivot=Pivot(0.6, stiffness=stiffness))
    collar = DoubleThrustBearing(row, row, play=3e-4)
    found = collar.equilibrium(force, 12.0, FILM)
    assert found.front.force - found.back.force == pytest.approx(force, rel=1e-6)
    pressed = found.front if force > 0 else found.back
    alone = row.equilibrium(pressed.force, 12.0, FILM)
    assert pressed.gap == pytest.approx(alone.gap, abs=1e-9)
    assert collar.pressure(found.gap, 12.0, FILM).force == pytest.approx(force, rel=1e-5)


@pytest.mark.parametrize(
    ("bearing", "speed", "reason"),
    [
        (LANDS, 0.0, "without rotation"),
        (LANDS, -10.0, "diverges"),
        (ThrustBearing(6, 0.5, 1.0, 0.785), 10.0, "no wedge"),
        (ThrustBearing(6, 0.5, 1.0, 0.785, pivot=Pivot(0.5)), 10.0, "meets the pivot"),
    ],
)
def test_loads_without_an_answer_have_a_reason(bearing, speed, reason):
    with pytest.raises(SolverError, match=reason):
        bearing.equilibrium(1e6, speed, FILM)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"pads": 0}, "pads"),
        ({"pads": 9}, "pad_angle"),
        ({"outer_radius": 0.4}, "outer_radius"),
        ({"taper": -1e-4}, "taper"),
        ({"wedge": 1.5}, "wedge"),
    ],
)
def test_impossible_geometry_is_refused_by_name(values, message):
    words = {"pads": 6, "inner_radius": 0.5, "outer_radius": 1.0, "pad_angle": 0.785} | values
    with pytest.raises(InputError, match=message):
        ThrustBearing(**words)


def test_full_circle_of_pads_and_a_single_one_are_allowed():
    for pads in (1, 8):
        bearing = ThrustBearing(pads, 0.5, 1.0, 2 * math.pi / pads, taper=1e-4)
        assert bearing.pressure(1e-4, 10.0, FILM).force > 0


@pytest.mark.parametrize("gap", [0.0, -1e-4, math.nan, math.inf])
def test_impossible_gaps_are_refused(gap):
    with pytest.raises(InputError, match="gap"):
        LANDS.pressure(gap, 10.0, FILM)


def test_what_the_film_does_not_know_is_refused():
    with pytest.raises(InputError, match="inlet"):
        LANDS.pressure(1e-4, 10.0, Film(Lubricant(0.05), inlet="widest gap"))
    with pytest.raises(InputError, match="rung"):
        LANDS.pressure(1e-4, 10.0, Film(Lubricant(0.05), rung="reduced"))
    with pytest.raises(InputError, match="touches"):
        LANDS.pressure(1e-4, 10.0, FILM, tilt=(2e-4, 0.0))


def test_a_film_near_standstill_is_an_answer_whose_force_goes_with_the_speed():
    # edges at 1 bar and lands twenty times as deep as the gap: their roundings are most of it
    lands = ThrustBearing(18, 1.6, 1.9, pad_angle=0.3, taper=8e-5)
    law = Guembel(cavitation_pressure=0.0)
    oil = Film(Lubricant(0.05), law, edge_pressure=1e5, inlet=None, grid=(20, 10))
    whole = lands.pressure(3.8e-6, 1.0, oil).force
    for speed in (1e-3, 1e-6, 1e-9):
        found = lands.pressure(3.8e-6, speed, oil)
        assert found.converged
        assert found.iterations < 5
        assert found.force == pytest.approx(whole * speed, rel=1e-4)


def test_not_strict_is_flagged_not_raised():
    control = Control(max_iterations=1, strict=False)
    found = LANDS.pressure(1e-4, 10.0, FILM, control=control)
    assert not found.converged


def test_results_are_labelled():
    found = LANDS.equilibrium(1e6, 10.0, lubricant=Lubricant(0.05), cavitation=Guembel())
    data = found.to_dataset()
    assert all({"units", "long_name"} <= set(v.attrs) for v in data.data_vars.values())
    assert "ThrustResult" in repr(found)
    assert "h_min" in repr(found)
    assert isinstance(
        RectangularThrustBearing(1, 10.0, 1.0, 1.0, profile=Step(1e-4)).row.angle, float
    )


@pytest.mark.parametrize("law", LAWS[:4], ids=lambda law: law.kind)
def test_squeeze_out_without_rotation_is_the_closed_form(law):
    """An infinitely wide parallel pad sinks as 1/h² = 1/h0² + 2 F t/(η L³) per width."""
    pad = RectangularThrustBearing(1, 10.0, 1.0, math.inf)
    time = np.linspace(0.0, 50.0, 81)
    edge = 1e3 if law.keeps_fill else 0.0
    film = Film(Lubricant(1.0), law, edge_pressure=edge, grid=(80, 4))
    path = pad.orbit(time, 1e6, 0.0, film, start=1e-4)
    gap = (1e8 + 2 * 1e6 * time) ** -0.5
    np.testing.assert_allclose(path.gap, gap, rtol=2e-4)
    assert float(path.gap[-1]) < 0.8e-4


def test_orbit_returns_to_the_equilibrium():
    state = LANDS.equilibrium(1e6, 10.0, FILM)
    time = np.linspace(0.0, 2.0, 41)
    for start in (None, 1.1 * state.gap):
        path = LANDS.orbit(time, 1e6, 10.0, FILM, start=start)
        assert float(path.gap[-1]) == pytest.approx(state.gap, rel=1e-4)
    assert all({"units", "long_name"} <= set(v.attrs) for v in path.data_vars.values())
