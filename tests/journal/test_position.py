"""Films at given positions: on the cells of an equilibrium there, with the same word on them."""

import warnings

import numpy as np
import pytest

from loadflow.errors import LoadflowError, ValidityWarning
from loadflow.journal import (
    Contact,
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
)
from loadflow.tribology import AsperityContact

OIL, SPEED, GRID = Lubricant(0.05), 10.0, (48, 12)
LAWS = {
    "gas mixture": (GasMixture(5e4), 5e5),
    "mass conserving": (MassConserving(), 1e5),
    "Reynolds": (Reynolds(), 0.0),
    "Gümbel": (Guembel(), 0.0),
    "Sommerfeld": (Sommerfeld(), 0.0),
}
GAS = Film(OIL, *LAWS["gas mixture"])


def bearing_of(width):
    return JournalBearing(1.0, width, 1e-3)


def force_of(width, number):
    """Force, N, of a Sommerfeld number."""
    return number * OIL.viscosity * SPEED / 1e-3**2 * width


def drawn(rng, law, narrowest):
    """A bearing, its film, what is given of the line, and the way to the shaft."""
    law, edge = LAWS[law]
    width = float(10 ** rng.uniform(-1.0, np.log10(4.0)))
    kind, angle, groove = rng.choice(["aligned", "tilted", "fed"]), *rng.uniform(0.0, 6.28, 2)
    line, more = {}, {}
    if kind == "tilted":
        line["tilt"] = rng.uniform(-0.5, 0.5, 2) * narrowest * 1e-3 / width
    if kind == "fed":
        hole = Groove(float(groove), arc=0.3, length=0.8 * width, pressure=edge + 2e5)
        more["supply"] = Supply((hole,))
    film = {"lubricant": OIL, "cavitation": law, "edge_pressure": edge, **more}
    return bearing_of(width), film, line, np.array([np.cos(angle), np.sin(angle)])


def without_warning(verb, *given, **more):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ValidityWarning)
        return verb(*given, **more)


@pytest.mark.parametrize("law", LAWS)
def test_the_film_at_the_position_of_an_equilibrium_carries_its_load(law):
    rng, asked = np.random.default_rng(list(LAWS).index(law)), 0
    verges = 0
    for _ in range(16):
        bearing, film, line, way = drawn(rng, law, 0.3)
        force = force_of(bearing.width, 10 ** rng.uniform(-2.0, np.log10(300.0))) * way
        film = Film(grid=GRID, **film)
        try:
            state = without_warning(bearing.equilibrium, force, SPEED, film, **line)
        except LoadflowError:  # a shaft that is held tilted and touches
            continue
        if not state.resolved:  # told; there may be no equilibrium on the cells asked for
            continue
        field = without_warning(bearing.pressure, state.eccentricity, SPEED, film, **line)
        off = np.hypot(*(field.force - force))
        if bool(off > 1e-9 * np.hypot(*force)):  # the load passes from cells to cells just there
            assert field.relative_grid_error[0] > 5.0 * state.relative_grid_error[0]
            assert off < field.grid_error.force
            verges += 1
            continue
        assert float(field.maximum_pressure) == pytest.approx(float(state.maximum_pressure))
        asked += 1
    assert asked >= 8
    assert verges <= LAWS[law][0].smooth  # of one draw; no other law changes its cells


@pytest.mark.parametrize("law", LAWS)
def test_twice_the_cells_move_a_force_by_no_more_than_is_told(law):
    rng, told = np.random.default_rng(10 + list(LAWS).index(law)), []
    for _ in range(10):
        left = float(10 ** rng.uniform(-2.7, 0.0))
        bearing, film, line, way = drawn(rng, law, left)
        place = (1.0 - left) * bearing.clearance * way
        own = without_warning(bearing.pressure, place, SPEED, Film(grid=GRID, **film), **line)
        graded = own.angle.size > 2 * GRID[0]
        grid = tuple(2 * cells for cells in (own.pressure.shape if graded else GRID))
        finer = Film(grid=grid, grading="graded" if graded else "auto", **film)
        fine = without_warning(bearing.pressure, place, SPEED, finer, **line)
        told.append(bool(own.resolved))
        # of second order: what is left of twice the cells is a third of what they change
        error = 4.0 / 3.0 * np.hypot(*(own.force - fine.force))
        assert error < own.grid_error.force or not own.resolved, (bearing, place)
    assert sum(told) >= 5


@pytest.mark.parametrize("number", [30.0, 100.0, 300.0])
def test_position_load_position_closes_whatever_the_load(number):
    bearing = bearing_of(0.5)
    force = force_of(0.5, number) * np.array([0.8, -0.6])
    state = bearing.equilibrium(force, SPEED, GAS)
    field = bearing.pressure(state.eccentricity, SPEED, GAS)
    again = bearing.equilibrium(field.force, SPEED, GAS)
    np.testing.assert_allclose(field.force, force, rtol=1e-9)
    np.testing.assert_allclose(again.eccentricity, state.eccentricity, rtol=1e-9)
    assert field.resolved
    assert state.resolved


def test_asperities_that_carry_leave_position_and_load_together():
    rough = Contact(AsperityContact(roughness=5e-6, contact_modulus=1e11, factor=1e-2))
    film = Film(OIL, *LAWS["gas mixture"], contact=rough)
    force = (force_of(0.5, 300.0), 0.0)
    state = bearing_of(0.5).equilibrium(force, SPEED, film)
    field = bearing_of(0.5).pressure(state.eccentricity, SPEED, film)
    assert state.contact_share > 0.1
    np.testing.assert_allclose(field.force, force, rtol=1e-9, atol=1e-9 * force[0])


def test_a_light_film_is_the_same_beside_a_heavy_one():
    places = np.array([[3e-4, 0.0], [4.98e-4, 1e-5]])
    both = bearing_of(0.5).pressure(places, SPEED, GAS)
    light, heavy = (bearing_of(0.5).pressure(place, SPEED, GAS) for place in places)
    assert both.pressure.shape[1:] == heavy.pressure.shape != light.pressure.shape
    np.testing.assert_array_equal(both.pressure[1], heavy.pressure)
    for name in ("force", "maximum_pressure", "friction_power", "stiffness", "relative_grid_error"):
        np.testing.assert_array_equal(getattr(both, name)[0], getattr(light, name), err_msg=name)
    # its cells are shown where those of the heavy one lie: the film is the same
    turn, thin = np.cos(both.angle[0]), both.gap[0, :, 0]
    np.testing.assert_allclose(thin, bearing_of(0.5).clearance - 3e-4 * turn, rtol=5e-3)
    middle = np.interp(0.0, light.angle - 2 * np.pi, light.pressure[:, 9], period=2 * np.pi)
    shown = np.interp(0.0, both.angle[0], both.pressure[0, :, 19], period=2 * np.pi)
    assert shown == pytest.approx(middle, rel=5e-3)
    assert both.pressure[0].max() == pytest.approx(light.pressure.max(), rel=5e-3)


def test_uniform_cells_asked_for_by_name_are_kept_and_told():
    film = Film(OIL, *LAWS["gas mixture"], grading="uniform")
    with pytest.warns(ValidityWarning, match="force of number 0 may be off"):
        field = bearing_of(0.5).pressure((4.98e-4, 0.0), SPEED, film)
    assert field.pressure.shape == film.cells
    assert not field.resolved
