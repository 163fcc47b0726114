"""Gaps that grow from place to place with the temperatures of shaft and shell."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Arc,
    Film,
    FilmHeat,
    Groove,
    JournalBearing,
    Lobes,
    MassConserving,
    RingGrowth,
    Supply,
    TiltingPads,
)
from loadflow.journal.film.gap.shaped_mesh import shaped_mesh
from loadflow.journal.film.heat.ring_growth import RingExpansion, ring_factor, ring_motion, wall
from loadflow.journal.film.heat.warm_cylinder import bore_growth
from loadflow.scene.journal import make_journal
from loadflow.tribology import ExponentialOil

SIZE = {"diameter": 0.2, "width": 0.15, "relative_clearance": 1e-3}
LOBES = JournalBearing(**SIZE, shape=Lobes(2))
LOAD, SPEED = (2e4, 3e3), 200.0
RING = RingGrowth(outer_diameter=0.3)


def film(grid=(48, 8), **heat):
    return Film(
        None, MassConserving(), edge_pressure=2e4, grid=grid, heat=FilmHeat("iso-vg-68", **heat)
    )


@pytest.mark.parametrize("outer", [1.05, 1.5, 3.0])
@pytest.mark.parametrize("biot", [0.0, 0.5, 20.0])
@pytest.mark.parametrize("n", [0, 2, 3, 8, 40])
def test_a_free_ring_moves_as_its_tractions_say(outer, biot, n):
    """The closed form, ∫α T dz of T = Re(A zⁿ + B z⁻ⁿ), beside four constants of plane stress."""
    rising, falling = wall(n, outer, biot)
    a, b = rising * outer**-n, falling
    if n:
        assert a + b == pytest.approx(1.0, abs=1e-14)
        slope = n * (a * outer ** (n - 1) - b * outer ** (-n - 1))
        assert -slope == pytest.approx(biot * (a * outer**n + b * outer**-n), abs=1e-12 * n)
    exact = ring_factor(n, outer, biot, held=False, nu=0.3)
    assert ring_motion(n, outer, biot, False, 0.3) == pytest.approx(exact, rel=1e-9)


def test_a_thin_ring_bends_as_a_beam_and_widens_as_a_hoop():
    for n in (2, 3, 5):
        factor = ring_factor(n, 1.00001, 0.0, held=False, nu=0.3)
        assert factor == pytest.approx(-1.0 / (n**2 - 1), rel=1e-3)
    assert ring_factor(0, 1.0001, 0.0, held=False, nu=0.3) == pytest.approx(1.0, rel=1e-12)
    # the mean temperature of a wall from 1 to what leaves it, 2/(b² − 1) ∫(1 + B ln x) x dx
    outer, share = 2.0, wall(0, 2.0, 0.7)[1]
    mean = 1 + share * (outer**2 * np.log(outer) / (outer**2 - 1) - 0.5)
    assert ring_factor(0, outer, 0.7, held=False, nu=0.3) == pytest.approx(mean, rel=1e-12)


@pytest.mark.parametrize("n", [0, 1, 2, 6])
def test_a_thin_ring_that_is_held_grows_inward_by_its_thickness(n):
    """A layer that cannot move sideways: (1 + ν) α T t."""
    for thin, nu in ((1e-3, 0.3), (1e-3, 0.0)):
        factor = ring_factor(n, 1 + thin, 0.0, held=True, nu=nu)
        assert factor == pytest.approx(-(1 + nu) * thin, rel=3e-3)


def expansion(cells, half_width=0.5, **changes):
    mesh = shaped_mesh(half_width, (cells, 4), True, False, (), (), ())
    heat = FilmHeat("iso-vg-68", growth=replace(RING, **changes))
    return mesh, RingExpansion(heat, mesh, 0.1)


@pytest.mark.parametrize("held", [False, True])
def test_the_growth_around_is_that_of_each_order(held):
    """A temperature of orders 0, 1 and 3; second order in the cells; slices of a narrow ring."""
    off = []
    for cells in (48, 96, 192):
        mesh, grows = expansion(cells, 0.005, held=held, shaft_expansion=5e-6)
        phi = mesh.angle[:, None] + np.zeros(mesh.shape)
        shell = 320.0 + 8.0 * np.cos(phi - 0.4) + 5.0 * np.cos(3 * phi)
        f0, f1, f3 = (ring_factor(n, 1.5, 0.0, held, 0.3) for n in (0, 1, 3))
        bore = f0 * 26.85 + f1 * 8.0 * np.cos(phi - 0.4) + f3 * 5.0 * np.cos(3 * phi)
        exact = 0.1 * (11.7e-6 * bore - 5e-6 * 16.85)
        off.append(np.abs(grows.of(shell, 310.0, None) - exact).max())
    assert off[-1] < 3e-3 * 0.1 * 11.7e-6 * 5.0 * (abs(f3) + abs(f1) + 0.1)
    assert np.log2(np.array(off[:-1]) / off[1:]) == pytest.approx(2.0, abs=0.2)


def test_a_ring_that_cells_do_not_cover_asks_which_way_its_oil_flows_on():
    """Behind the last cell it is as warm as the first one or the last, as the shaft turns."""
    mesh, closed = expansion(12)
    shell = 320.0 + np.linspace(0.0, 8.0, 12)[:, None] + np.zeros(mesh.shape)
    assert closed.covered
    for way in (1.0, -1.0):
        np.testing.assert_array_equal(closed.of(shell, 310.0, way), closed.of(shell, 310.0, None))
    edges = np.linspace(0.2, 2.0 * np.pi - 0.1, 13)
    part = SimpleNamespace(
        edges=edges, angle=0.5 * (edges[1:] + edges[:-1]), dx=np.diff(edges),
        z_edges=mesh.z_edges,
    )  # fmt: skip
    opened = RingExpansion(FilmHeat("iso-vg-68", growth=RING), part, 0.1)
    assert not opened.covered
    on, back = (opened.of(shell, 310.0, way) for way in (1.0, -1.0))
    assert np.abs(on - back).max() > 1e-3 * np.abs(on).max()
    with pytest.raises(AssertionError, match="which way"):
        opened.of(shell, 310.0, None)


@pytest.mark.parametrize("held", [False, True])
def test_a_narrow_ring_moves_as_its_slices(held):
    orders, across = (0, 2, 3, 8), np.linspace(-0.005, 0.005, 5)
    grown = bore_growth(orders, across, 1.5, 0.5, held, 0.3).sum(axis=-1)
    exact = [ring_factor(n, 1.5, 0.5, held, 0.3) for n in orders]
    np.testing.assert_allclose(grown, np.outer(exact, np.ones(4)), rtol=1e-3)


def test_a_thin_ring_that_is_warmer_toward_one_end_opens_as_a_cone():
    """A temperature that rises straight makes no stress: the bore grows by α a T(z)."""
    edges = np.linspace(-0.5, 0.5, 21)
    middles = 0.5 * (edges[1:] + edges[:-1])
    grown = bore_growth((0,), edges, 1.01, 0.0, False, 0.3)[0] @ middles
    np.testing.assert_allclose(grown[4:-4], middles[4:-4], atol=2e-3)


def test_a_hot_spot_moves_the_bore_beside_it_too():
    """Over about the thickness of the wall, whatever the cells; a slice would move alone."""
    found = []
    for cells in (12, 24, 48):
        edges = np.linspace(-0.75, 0.75, cells + 1)
        middles = 0.5 * (edges[1:] + edges[:-1])
        warm = np.exp(-((middles / 0.2) ** 2))
        grown = bore_growth((0,), edges, 1.5, 0.0, False, 0.3)[0] @ warm
        found.append(np.interp([0.0, 0.3, 0.7], middles, grown))
    np.testing.assert_allclose(found[1], found[2], atol=0.01)
    assert found[2][0] < 0.5
    assert found[2][1] > 0.25


def test_half_of_a_ring_is_the_whole_one():
    half = np.linspace(0.0, 0.75, 7)
    whole = np.append(-half[:0:-1], half)
    one, both = (bore_growth((0, 2), edges, 1.4, 0.3, False, 0.3) for edges in (half, whole))
    np.testing.assert_allclose(one, both[:, 6:, 6:] + both[:, 6:, 5::-1], atol=1e-10)


def test_the_narrowest_film_hardly_asks_for_cells_across():
    """Cold oil at the ends lies in ever narrower a strip, but the ring bends all over."""
    round_bore = JournalBearing(**SIZE)
    films = [film((72, cells), growth=RING, shell_transfer=500.0) for cells in (24, 48)]
    least = [float(round_bore.equilibrium((4e4, 3e3), 100.0, one).minimum_film) for one in films]
    assert least[0] == pytest.approx(least[1], rel=0.03)


@pytest.mark.parametrize(("rung", "most"), [("grid", 2e-3), ("reduced", 1e-9)])
@pytest.mark.parametrize("lobes", [2, 3])
def test_a_bore_turned_from_one_groove_to_the_next_has_the_same_film(lobes, rung, most):
    """Wherever its cells begin; grooves of the fast rung all have cells, and are as warm alike."""
    options = replace(film((96, 24), growth=RING), rung=rung)
    bore = replace(LOBES, shape=Lobes(lobes))
    way = 2.0 * np.pi / lobes
    turned = np.array(LOAD) @ [[np.cos(way), np.sin(way)], [-np.sin(way), np.cos(way)]]
    one, other = (bore.equilibrium(load, SPEED, options) for load in (LOAD, turned))
    for name in ("minimum_film", "maximum_pressure", "friction_power", "clearance"):
        assert getattr(one, name) == pytest.approx(float(getattr(other, name)), rel=most)


def test_in_a_groove_the_ring_is_as_warm_as_the_oil_that_it_gives():
    """So it is in both grooves of the fast rung, and in the one that has cells on the grid."""
    for rung, grooves in (("reduced", (0, 1)), ("grid", (0,))):
        state = LOBES.equilibrium(LOAD, SPEED, replace(film(growth=RING), rung=rung))
        for groove, angle in ((0, 0.5 * np.pi), (1, 1.5 * np.pi)):
            ring = state.surface_temperature[np.abs(state.angle - angle).argmin()]
            there = np.abs(ring - state.leading_temperature[groove]).max() < 1e-9
            assert there == (groove in grooves)


def test_an_even_growth_is_another_clearance():
    """Oil that does not warm, 20 K above the temperature of assembly."""
    oil = ExponentialOil(
        reference_viscosity=0.02, constant_steepness=0.0, reference_density=860.0,
        constant_specific_heat=1e12,
    )  # fmt: skip
    heat = FilmHeat(oil, 313.15, growth=replace(RING, shaft_expansion=5e-6))
    grown = LOBES.equilibrium(LOAD, SPEED, replace(film(), heat=heat))
    wider = LOBES.clearance + 0.1 * 6.7e-6 * 20.0
    other = replace(LOBES, relative_clearance=wider / 0.1)
    exact = other.equilibrium(LOAD, SPEED, replace(film(), heat=replace(heat, growth=None)))
    assert grown.clearance == pytest.approx(wider, rel=1e-9)
    for name in (
        "eccentricity", "eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power",
        "side_flow", "sommerfeld_number", "reynolds_number", "critical_reynolds_number",
    ):  # fmt: skip
        np.testing.assert_allclose(getattr(grown, name), getattr(exact, name), rtol=1e-9)
    for name in ("stiffness", "damping"):
        found, known = getattr(grown, name), getattr(exact, name)
        np.testing.assert_allclose(found, known, atol=1e-6 * np.abs(known).max())


def test_a_free_shell_bends_inward_where_it_is_hot():
    """Steel on steel, as warm on average: the order 2 and above moves the film, the mean not."""
    plain, grown = (LOBES.equilibrium(LOAD, SPEED, film(growth=g)) for g in (None, RING))
    growth, surface = grown.thermal_growth, grown.surface_temperature
    assert grown.heat_imbalance < 1e-8
    assert plain.thermal_growth.max() == plain.thermal_growth.min() == 0.0
    assert grown.clearance == pytest.approx(LOBES.clearance, rel=0.02)
    middle = surface.shape[1] // 2
    slope = np.corrcoef(growth[:, middle], surface[:, middle])[0, 1]
    assert slope < -0.5
    moved = abs(grown.minimum_film / plain.minimum_film - 1.0)
    assert 1e-3 < moved < np.abs(growth).max() / plain.minimum_film
    assert grown.heat_iterations <= plain.heat_iterations + 4


def test_a_cooled_shell_leaves_less_clearance():
    cool = film(points=3, shell_transfer=300.0, growth=RING)
    warm = film(points=3, growth=RING)
    found = [LOBES.equilibrium(LOAD, SPEED, one) for one in (cool, warm)]
    assert found[0].clearance < 0.9 * found[1].clearance
    assert max(state.heat_imbalance for state in found) < 1e-8
    # the mean by hand: the wall from the surface's temperature on, less the shaft
    state = found[0]
    left = 1 / 300.0 - 0.1 * np.log(1.5) / 50.0
    factor = ring_factor(0, 1.5, 0.1 / (1.5 * left * 50.0), held=False, nu=0.3)
    weights = np.full(state.angle.size, 1.0)
    mean = np.average(state.surface_temperature.mean(axis=1), weights=weights)
    bore = factor * (mean - 293.15)
    exact = LOBES.clearance + 0.1 * 11.7e-6 * (bore - (state.shaft_temperature - 293.15))
    assert state.clearance == pytest.approx(exact, rel=0.01)


def test_position_load_position_closes_in_a_gap_that_grows():
    options = film(growth=RING)
    state = LOBES.equilibrium(LOAD, SPEED, options)
    there = LOBES.pressure(state.eccentricity, SPEED, options)
    assert there.force == pytest.approx(np.array(LOAD), rel=1e-6)
    assert there.eccentricity_ratio == pytest.approx(float(state.eccentricity_ratio), rel=1e-9)
    np.testing.assert_allclose(there.thermal_growth, state.thermal_growth, atol=1e-12)


def test_grooves_of_a_round_bore_and_a_tilted_shaft_grow_too():
    fed = Supply([Groove(s * np.pi / 2, arc=0.3, length=0.1, pressure=1e5) for s in (1, -1)])
    options = replace(film(growth=RING), supply=fed)
    state = JournalBearing(**SIZE).equilibrium(LOAD, SPEED, options, tilt=(1e-4, 0.0))
    assert state.converged
    assert state.heat_imbalance < 1e-8
    assert np.ptp(state.thermal_growth) > 1e-7


def test_a_shaft_that_grows_into_its_shell_is_told():
    held = film(growth=replace(RING, held=True))
    with pytest.raises(SolverError, match="touches the bore"):
        LOBES.equilibrium(LOAD, SPEED, held)
    state = LOBES.equilibrium([LOAD, LOAD], SPEED, held, strict=False)
    assert not state.converged.any()
    assert np.isnan(state.clearance).all()


def test_what_a_ring_cannot_be_is_refused_by_name():
    with pytest.raises(InputError, match=r"growth\.outer_diameter = 0\.1"):
        LOBES.equilibrium(LOAD, SPEED, film(growth=RingGrowth(0.1)))
    with pytest.raises(InputError, match=r"growth = .*runs round"):
        JournalBearing(**SIZE, shape=Arc(0.0, 2.6)).equilibrium(LOAD, SPEED, film(growth=RING))
    with pytest.raises(InputError, match=r"heat\.growth = .*pads"):
        JournalBearing(**SIZE, shape=TiltingPads(4, 1.2)).equilibrium(
            LOAD, SPEED, film(growth=RING)
        )
    with pytest.raises(InputError, match="shell_transfer = 5000"):
        LOBES.equilibrium(LOAD, SPEED, film(shell_transfer=5e3, growth=RING))


def test_a_scene_has_the_growth_of_a_ring():
    base = {"cavitation": "mass-conserving", "edge_pressure": 1e4, "grid": (48, 8)}
    base |= {"geometry": SIZE | {"shape": {"kind": "lobes", "count": 2}}}
    heat = {"kind": "film", "growth": {"outer_diameter": 0.3, "held": True}}
    section = make_journal(base | {"heat": heat}, "journal")
    assert section.film_model.heat.growth == RingGrowth(0.3, held=True)
    again = make_journal(section.model_dump(exclude_unset=True), "journal")
    assert again.heat == section.heat
    with pytest.raises(InputError, match=r"journal\.heat\.growth\.outer_diameter"):
        make_journal(base | {"heat": {"kind": "film", "growth": {}}}, "journal")


@pytest.mark.parametrize("growth", [None, RING])
def test_a_settled_stiffness_is_the_slope_of_the_force_with_its_temperatures(growth):
    options = film(growth=growth, stiffness="settled")
    state = LOBES.equilibrium(LOAD, SPEED, options)
    frozen = LOBES.equilibrium(LOAD, SPEED, film(growth=growth))
    step, columns = 2e-7, []
    for way in np.eye(2):
        ends = [
            LOBES.pressure(state.eccentricity + sign * step * way, SPEED, options).force
            for sign in (1.0, -1.0)
        ]
        columns.append((ends[0] - ends[1]) / (2.0 * step))
    expected = np.array(columns).T
    np.testing.assert_allclose(state.stiffness, expected, atol=2e-3 * np.abs(expected).max())
    apart = np.abs(frozen.stiffness - expected).max()
    assert apart > 0.02 * np.abs(expected).max()
    np.testing.assert_allclose(state.damping, frozen.damping, rtol=1e-6)


def test_a_settled_stiffness_with_tilt_has_its_moments_and_pads_refuse_it():
    grid = (40, 8)
    settled, frozen = (
        LOBES.equilibrium(LOAD, SPEED, film(grid, stiffness=kind), tilt=(1e-4, 0.0)).stiffness
        for kind in ("settled", "frozen")
    )
    assert settled.shape == (4, 4)
    for block in (np.s_[:2, :2], np.s_[2:, 2:]):
        apart = np.abs(settled[block] - frozen[block]).max() / np.abs(frozen[block]).max()
        assert 1e-3 < apart < 0.5
    pads = JournalBearing(**SIZE, shape=TiltingPads(4, 1.2))
    with pytest.raises(InputError, match=r"heat\.stiffness = 'settled'"):
        pads.equilibrium(LOAD, SPEED, film(stiffness="settled"))
