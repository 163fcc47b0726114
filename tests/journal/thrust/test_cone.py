"""Conical bearings against exact series, the cylinder, and themselves."""

import math
from itertools import chain

import numpy as np
import pytest

from benchmarks.robustness.families import FAMILIES, SEEDS, draw_point
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    ConicalBearing,
    ConicalPair,
    Film,
    GasMixture,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Pivot,
    Reynolds,
    Sommerfeld,
)
from loadflow.journal.solvers.assembly.search import Chart, around, search
from loadflow.numerics.convergence import Limits
from loadflow.validation import thrust as exact

CONE = ConicalBearing(half_angle=0.52, slant=(1.0, 1.5), clearance=1e-4)
FILM = Film(Lubricant(0.05), Guembel(), inlet=None, grid=(60, 12))
PADS = ConicalBearing(0.3, (1.0, 1.3), 1e-4, pads=8, pad_angle=0.7)
LAWS = [Sommerfeld(), Guembel(), Reynolds(), MassConserving(), GasMixture(1e5)]


def loads(found):
    return np.append(found.force, found.moment)


@pytest.mark.parametrize("toward", [0.0, 0.7])
@pytest.mark.parametrize("row", exact.CONES)
def test_whole_cones_meet_the_exact_series_with_second_order(row, toward):
    """Also where the cut of the half film falls between nodes."""
    angle, ratio, eps, axial, x, y, middle = row
    expected = np.array([-x, -y, -axial])
    errors = []
    for grid in ((80, 20), (160, 40)):
        found = exact.whole_cone(angle, ratio, eps, grid, toward)
        force = found.force * exact.GAP**2
        cos, sin = math.cos(toward), math.sin(toward)
        turned = np.array(
            [cos * force[0] + sin * force[1], cos * force[1] - sin * force[0], force[2]]
        )
        errors.append(np.abs(turned / expected - 1))
        assert found.centre[0, 0] == pytest.approx(middle, abs=1e-3)
    assert errors[0].max() < 5e-3
    assert errors[1].max() < 1e-3
    np.testing.assert_allclose(np.log2(errors[0] / errors[1]), 2.0, atol=0.2)


def test_conical_pad_meets_the_exact_series():
    load, angle, middle = exact.SEGMENT
    for grid, allowed in (((80, 20), 5e-3), ((160, 40), 1e-3)):
        found = exact.segment(grid)
        assert found.normal_force[0] * exact.GAP**2 == pytest.approx(load, rel=allowed)
        assert math.degrees(found.centre[0, 1]) == pytest.approx(angle, abs=0.03)
        assert found.centre[0, 0] == pytest.approx(middle, abs=1e-3)


def test_full_film_has_no_axial_force():
    full = Film(Lubricant(0.05), Sommerfeld(), inlet=None, grid=(80, 20))
    found = CONE.pressure((5e-5, 2e-5, 1e-5), 10.0, full)
    assert abs(found.force[2]) < 1e-9 * np.hypot(*found.force[:2])


def test_signs_of_the_frame():
    """The shaft presses toward the apex; the film stands before the narrowest gap."""
    force = CONE.pressure((5e-5, 0.0, 0.0), 10.0, FILM).force
    assert list(np.sign(force)) == [1, -1, -1]
    back = CONE.pressure((5e-5, 0.0, 0.0), -10.0, FILM).force
    np.testing.assert_allclose(back, force * [1, -1, 1], rtol=1e-9)
    wider = CONE.pressure((5e-5, 0.0, 2e-5), 10.0, FILM).force
    assert abs(wider[2]) < abs(force[2])


@pytest.mark.parametrize("law", [Guembel(), Sommerfeld()], ids=lambda law: law.kind)
def test_a_slender_cone_is_the_cylinder(law):
    radius, width, c, angle = 0.5, 0.5, 5e-4, 1e-5
    middle = radius / math.sin(angle)
    cone = ConicalBearing(angle, (middle - width / 2, middle + width / 2), c)
    film = Film(Lubricant(0.05), law, inlet=None, grid=(120, 30), grading="uniform")
    bearing = JournalBearing(2 * radius, width, c / radius)
    place = np.array([2.5e-4, 1e-4])
    found, expected = cone.pressure([*place, 0.0], 10.0, film), bearing.pressure(place, 10.0, film)
    # the cylinder's load is 0.25 % above the converged one on this mesh, the cone's 0.05 % below
    np.testing.assert_allclose(found.force[:2], expected.force, rtol=4e-3)
    assert found.friction_power == pytest.approx(float(expected.friction_power), rel=2e-3)
    tilted = cone.pressure([*place, 0.0], 10.0, film, tilt=(1e-4, -2e-4))
    finer = Film(Lubricant(0.05), law, inlet=None, grid=(120, 60), grading="uniform")
    other = bearing.pressure(place, 10.0, finer, tilt=(1e-4, -2e-4))
    np.testing.assert_allclose(tilted.force[:2], other.force, rtol=4e-3)
    np.testing.assert_allclose(tilted.moment, other.moment, rtol=8e-3)


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_oil_is_conserved_and_the_film_converges(law):
    film = Film(Lubricant(0.05), law, edge_pressure=1e5, inlet=None, grid=(60, 12))
    found = CONE.pressure((4e-5, 3e-5, -1e-5), 10.0, film)
    assert found.converged
    assert found.residual < 1e-10
    if not isinstance(law, Reynolds):  # its rupture loses oil by definition
        assert abs(found.mass_balance) < 1e-9
    assert found.force[2] <= 1e-6 * abs(found.force[0])


@pytest.mark.parametrize("bearing", [CONE, PADS], ids=["ring", "pads"])
@pytest.mark.parametrize("law", [Guembel(), MassConserving()], ids=lambda law: law.kind)
def test_stiffness_and_damping_are_the_derivatives(bearing, law):
    edge = 0.0 if isinstance(law, Guembel) else 1e5
    film = Film(Lubricant(0.05), law, edge_pressure=edge, inlet=None, grid=(24, 8))
    at = np.array([4e-5, -2e-5, 1e-5, 1e-5, -2e-5])

    def load(position, velocity=(0.0, 0.0, 0.0)):
        words = {"tilt": position[3:], "velocity": velocity}
        return loads(bearing.pressure(position[:3], 10.0, film, **words))

    found = bearing.pressure(at[:3], 10.0, film, tilt=at[3:])
    steps = 1e-10 * np.eye(5)
    differences = np.array([(load(at + d) - load(at - d)) / 2e-10 for d in steps]).T
    allowed = 1e-4 * np.abs(found.stiffness).max()
    np.testing.assert_allclose(differences, found.stiffness, atol=allowed)
    rates = 1e-8 * np.eye(3)
    squeeze = np.array([(load(at, v) - load(at, -v)) / 2e-8 for v in rates]).T
    np.testing.assert_allclose(
        squeeze, found.damping[:, :3], atol=1e-4 * np.abs(found.damping).max()
    )


@pytest.mark.parametrize("bearing", [CONE, PADS], ids=["ring", "pads"])
@pytest.mark.parametrize("place", [(4e-5, -2e-5, 1e-5), (-1e-5, 8e-5, -2e-5), (7e-5, 6e-5, 2e-5)])
def test_position_load_position_closes(bearing, place):
    held = bearing.pressure(place, 10.0, FILM)
    for words in ({}, {"moment": held.moment}):
        state = bearing.equilibrium(held.force, 10.0, FILM, **words)
        assert state.converged
        assert state.residual < 1e-10
        np.testing.assert_allclose(state.eccentricity, place, atol=1e-6 * bearing.clearance)
        np.testing.assert_allclose(state.tilt, 0.0, atol=1e-12)


def test_tilt_load_tilt_closes():
    tilt = (1e-5, -2e-5)
    held = CONE.pressure((4e-5, -2e-5, 1e-5), 10.0, FILM, tilt=tilt)
    state = CONE.equilibrium(held.force, 10.0, FILM, moment=held.moment)
    np.testing.assert_allclose(state.tilt, tilt, rtol=1e-6)
    np.testing.assert_allclose(state.eccentricity, (4e-5, -2e-5, 1e-5), rtol=1e-6)


def test_loads_of_the_pads_add_up():
    found = PADS.pressure((4e-5, -2e-5, 1e-5), 10.0, FILM)
    np.testing.assert_allclose(found.pad_forces.sum(axis=0), found.force, rtol=1e-12)
    assert found.load_share.sum() == pytest.approx(1.0)
    assert (found.normal_force == 0.0).any()  # pads on the far side carry nothing


def test_pads_on_springs_follow_their_load():
    pivot = Pivot(0.6, stiffness=1e11, tilt_stiffness=1e9)
    bearing = ConicalBearing(0.5, (1.0, 1.4), 1e-4, pads=8, pad_angle=0.7, pivot=pivot)
    film = Film(Lubricant(0.05), Guembel(), grid=(20, 10))
    held = bearing.pressure((4e-5, -2e-5, 1e-5), 10.0, film)
    assert held.converged
    carried = np.abs(held.pad_displacement) * 1e11
    # less than the pressure, whose normals turn over a pad
    np.testing.assert_allclose(carried, held.normal_force, rtol=0.05, atol=1e-6)
    state = bearing.equilibrium(held.force, 10.0, film, moment=held.moment)
    np.testing.assert_allclose(state.eccentricity, (4e-5, -2e-5, 1e-5), rtol=1e-6)
    at = np.array([4e-5, -2e-5, 1e-5, 0.0, 0.0])

    def load(position):
        return loads(bearing.pressure(position[:3], 10.0, film, tilt=position[3:]))

    differences = np.array([(load(at + d) - load(at - d)) / 2e-10 for d in 1e-10 * np.eye(5)]).T
    allowed = 1e-4 * np.abs(held.stiffness).max()
    np.testing.assert_allclose(differences, held.stiffness, atol=allowed)


@pytest.mark.parametrize("arrangement", ["O", "X"])
def test_two_cones_carry_force_and_moment_both_ways(arrangement):
    cone = ConicalBearing(0.5, (1.0, 1.3), 2e-4)
    pair = ConicalPair(cone, cone, 1.0, 2e-4, arrangement)
    film = Film(Lubricant(0.1), Guembel(), inlet=None, grid=(40, 10))
    place, tilt = (5e-5, -3e-5, 4e-5), (2e-5, 3e-5)
    held = pair.pressure(place, 1.0, film, tilt=tilt)
    state = pair.equilibrium(held.force, held.moment, 1.0, film)
    np.testing.assert_allclose(state.eccentricity, place, rtol=1e-6)
    np.testing.assert_allclose(state.tilt, tilt, rtol=1e-6)
    assert max(state.left.force[2], state.right.force[2]) < 0  # each toward its own apex
    outward = 1.0 if arrangement == "O" else -1.0
    axial = outward * (state.right.force[2] - state.left.force[2])
    assert state.force[2] == pytest.approx(axial, rel=1e-9)
    assert state.load_share.sum() == pytest.approx(1.0)
    assert state.friction_torque > 0


def test_pair_is_symmetric_and_its_stiffness_the_derivative():
    cone = ConicalBearing(0.5, (1.0, 1.3), 2e-4)
    pair = ConicalPair(cone, cone, 1.0)
    film = Film(Lubricant(0.1), Guembel(), inlet=None, grid=(40, 10))
    middle = pair.pressure((5e-5, 2e-5, 0.0), 1.0, film)
    assert abs(middle.force[2]) < 1e-9 * abs(middle.force[0])
    np.testing.assert_allclose(middle.load_share, 0.5, rtol=1e-9)
    at = np.array([5e-5, 2e-5, 3e-5, 1e-5, -2e-5])
    found = pair.pressure(at[:3], 1.0, film, tilt=at[3:])

    def load(p):
        return loads(pair.pressure(p[:3], 1.0, film, tilt=p[3:]))

    differences = np.array([(load(at + d) - load(at - d)) / 2e-10 for d in 1e-10 * np.eye(5)]).T
    allowed = 1e-4 * np.abs(found.stiffness).max()
    np.testing.assert_allclose(differences, found.stiffness, atol=allowed)


@pytest.mark.parametrize("law", [Guembel(), Reynolds(), MassConserving()])
def test_a_search_goes_on_from_a_film_without_pressure(law):
    ring = ConicalBearing(half_angle=0.5, slant=(0.5, 0.7), clearance=1e-4)
    oil = Film(Lubricant(0.05), law, inlet=None, grid=(24, 8), edge_pressure=1e5)
    film = ring._assembly(oil, 50.0, 0.0)
    centred = ring._started(film, np.zeros(5), 50.0)
    wanted = np.append(ring.pressure((5e-5, 1e-5, 0.0), 50.0, oil).force, np.zeros(2))
    chart = Chart(ring.clearance, ring.half_angle, np.zeros(2))
    more = around(film, chart, lambda place: ring._started(film, place, 50.0), wanted)
    found = search(film, chart, chain([centred], more), wanted, np.arange(3), Limits(1e-10, 60))
    assert found.converged
    assert np.sum(film.loads(found)[0], axis=0)[:3] == pytest.approx(wanted[:3], rel=1e-6)


@pytest.mark.parametrize(
    ("force", "speed", "reason"),
    [
        ((1e5, 0.0, -1e6), 0.0, "without rotation"),
        ((1e5, 0.0, 1e5), 10.0, "away from its apex"),
        ((1e6, 0.0, -1e5), 10.0, "tan α"),
    ],
)
def test_loads_without_an_answer_have_a_reason(force, speed, reason):
    with pytest.raises(SolverError, match=reason):
        CONE.equilibrium(force, speed, FILM)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"half_angle": 0.0}, "half_angle"),
        ({"half_angle": 1.6}, "half_angle"),
        ({"slant": (1.5, 1.0)}, "slant"),
        ({"clearance": -1e-4}, "clearance"),
        ({"pads": 3}, "pad_angle"),
        ({"pads": 7, "pad_angle": 1.0}, "pad_angle"),
        ({"pivot": Pivot()}, "pivot"),
    ],
)
def test_impossible_geometry_is_refused_by_name(values, message):
    words = {"half_angle": 0.5, "slant": (1.0, 1.5), "clearance": 1e-4} | values
    with pytest.raises(InputError, match=message):
        ConicalBearing(**words)


def test_bad_states_are_refused_by_name():
    with pytest.raises(InputError, match="touches"):
        CONE.pressure((2e-4, 0.0, 0.0), 10.0, FILM)
    with pytest.raises(InputError, match="eccentricity"):
        CONE.pressure((1e-5, 0.0), 10.0, FILM)
    with pytest.raises(InputError, match="force"):
        CONE.equilibrium((1e5, math.nan, -1e6), 10.0, FILM)
    with pytest.raises(InputError, match="moment and tilt"):
        CONE.equilibrium((1e5, 0.0, -1e6), 10.0, FILM, moment=(0, 0), tilt=(0, 0))


def test_a_load_too_heavy_for_the_mesh_ends_with_numbers():
    cone = ConicalBearing(0.5, (1.0, 1.3), 2e-4)
    film = Film(Lubricant(0.1), Guembel(), inlet=None, grid=(40, 10))
    with pytest.raises(SolverError, match="narrowest film"):
        ConicalPair(cone, cone, 1.0).equilibrium((1e9, 0.0, 1e8), (1e8, 0.0), 1.0, film)


def test_results_are_labelled():
    found = CONE.pressure((5e-5, 0.0, 0.0), 10.0, FILM)
    data = found.to_dataset()
    assert all({"units", "long_name"} <= set(v.attrs) for v in data.data_vars.values())
    assert "ConicalResult" in repr(found)
    cone = ConicalBearing(0.5, (1.0, 1.3), 2e-4)
    pair = ConicalPair(cone, cone, 1.0).pressure((5e-5, 0, 0), 1.0, FILM)
    assert pair.to_dataset().load_share.shape == (2,)
    assert "PairResult" in repr(pair)
    assert "h_min" in repr(pair)


def test_orbit_stays_in_equilibrium_and_returns_to_it():
    film = Film(Lubricant(0.05), Guembel(), inlet=None, grid=(24, 8))
    place = np.array([5e-5, 1e-5, 0.0])
    force = CONE.pressure(place, 10.0, film).force
    time = np.linspace(0.0, 12.0, 61)
    for start in (None, 0.8 * place):
        path = CONE.orbit(time, force, 10.0, film, start=start)
        np.testing.assert_allclose(path.eccentricity[-1], place, atol=1e-3 * CONE.clearance)
        assert float(path.residual.max()) < 1e-8
    still = CONE.orbit(time[:3], force, 10.0, film, start=place)
    np.testing.assert_allclose(still.eccentricity, [place] * 3, atol=1e-8 * CONE.clearance)


def test_mass_conserving_film_keeps_its_history():
    """With suction below the edge pressure, the shaft drifts off on the way out of its balance."""
    film = Film(Lubricant(0.05), MassConserving(), edge_pressure=1e5, inlet=None, grid=(24, 8))
    place = np.array([5e-5, 1e-5, 0.0])
    force = CONE.pressure(place, 10.0, film).force
    still = CONE.orbit(np.linspace(0.0, 1.0, 6), force, 10.0, film, start=place)
    np.testing.assert_allclose(still.eccentricity, [place] * 6, atol=1e-6 * CONE.clearance)
    gone = CONE.orbit(np.linspace(0.0, 1.0, 6), force, 10.0, film, start=0.8 * place)
    assert float(gone.residual.max()) < 1e-8
    assert float(gone.eccentricity[-1, 2]) > 1e-5


def test_steps_in_time_are_of_second_order():
    film = Film(Lubricant(0.05), Guembel(), inlet=None, grid=(24, 8))
    force = CONE.pressure((5e-5, 1e-5, 0.0), 10.0, film).force
    ends = []
    for count in (41, 81, 161):
        time = np.linspace(0.0, 1.0, count)
        load = force * (1 + 0.3 * np.sin(2 * np.pi * time) ** 2)[:, None]
        ends.append(CONE.orbit(time, load, 10.0, film).eccentricity.values[-1])
    first, second = np.linalg.norm(np.diff(ends, axis=0), axis=1)
    assert math.log2(first / second) == pytest.approx(2.0, abs=0.25)


def test_bad_series_are_refused_by_name():
    with pytest.raises(InputError, match="does not increase"):
        CONE.orbit([0.0, 1.0, 1.0], (1e5, 0.0, -1e6), 10.0, FILM)
    with pytest.raises(InputError, match="force"):
        CONE.orbit([0.0, 1.0, 2.0], np.ones((2, 3)), 10.0, FILM)


@pytest.mark.parametrize("number", [10342, 10386])
def test_pairs_far_from_their_first_position_are_found_in_few_steps(number):
    """The first search ends at once where it leads nowhere; all films between the cones follow."""
    rng = np.random.default_rng([SEEDS["pair"], number])
    found = FAMILIES["pair"](draw_point(rng))()
    assert found.converged
    assert found.iterations < 250  # the first took 735, with 200 from each start
