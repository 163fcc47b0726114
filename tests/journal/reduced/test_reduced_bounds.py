"""Bounds of what cells around and points across leave out of films on the rung "reduced"."""

from dataclasses import replace
from unittest.mock import patch

import numpy as np
import pytest
from film_matrix import BEARING, asked

from loadflow.errors import ValidityWarning
from loadflow.journal import JournalBearing
from loadflow.journal.film import cell_error
from loadflow.journal.grid_bounds import BOUNDED
from loadflow.journal.line import Line
from loadflow.journal.models import reduced
from loadflow.journal.models.composed import model as composed_model
from loadflow.journal.questions import AtRest
from loadflow.numerics.convergence import Limits

SPEED, QUANTITIES = 100.0, BOUNDED[1:]
PARTS = {
    "mixture": (),
    "plain": ("guembel",),
    "conserving": ("mass-conserving",),
    "full": ("sommerfeld",),
    "lobes": ("mass-conserving", "lobes"),
    "crown": ("guembel", "crown"),
    "tilt": ("mass-conserving", "tilt and bend"),
    "moment": ("guembel", "moment"),
    "contact": ("mass-conserving", "contact", "turbulence"),
    "shell": ("guembel", "local shell", "tilt and bend"),
}
FORCES = np.array([[3e2, 1e2], [6e3, 1e3], [2e4, -5e3], [5e4, 2e4]])


def described(name, cells=(48, 8)):
    film, geometry, line = asked(PARTS[name], "reduced")
    more = {"shape": geometry.shape, "relief": geometry.relief}
    return JournalBearing(**BEARING | more), replace(film, grid=cells, grading="auto"), line


def finer(verb, force, speed, film, **line):
    """A result on many more points across than it takes by itself.

    The loops of an aligned film without effects are compiled for a count of points. A tilt that no
    number shows takes it to those that are not.
    """
    aligned = not line and film.rung == "reduced"
    with (
        patch.object(composed_model, "HALF_POINTS", (12, 16, 20, 24, 28)),
        patch.object(composed_model, "POINTS", (24, 28, 32, 36, 40)),
    ):
        return verb(force, speed, film, **{"tilt": (1e-15, 0.0)} if aligned else line)


@pytest.mark.filterwarnings("ignore::loadflow.errors.ValidityWarning")
@pytest.mark.parametrize("name", [name for name in PARTS if name != "mixture"])
def test_bounds_hold_what_twice_the_cells_and_more_points_change(name):
    bearing, film, line = described(name)
    own = bearing.equilibrium(FORCES, SPEED, film, **line)
    fine = finer(bearing.equilibrium, FORCES, SPEED, replace(film, grid=(96, 16)), **line)
    asked_for = own.resolved
    assert asked_for.sum() >= 3
    for quantity in QUANTITIES:
        change = np.abs(getattr(own, quantity) - getattr(fine, quantity))
        bound = getattr(own.grid_error, quantity)
        # of second order: what is left of twice the cells is a third of what they change
        assert (4.0 / 3.0 * change <= bound + 1e-12 * np.abs(bound))[asked_for].all(), quantity
        assert (bound > 0.0).all()


@pytest.mark.parametrize("rung", ["grid", "reduced"])
def test_bounds_know_that_the_oil_of_a_light_gas_mixture_is_taken_from_upstream(rung):
    """That is of first order: no bend of the pressure tells it, and half the cells leave half."""
    bearing, film, line = described("mixture", (48, 32))
    film = replace(film, rung=rung)
    own = bearing.equilibrium(FORCES, SPEED, film, **line)
    fine = finer(bearing.equilibrium, FORCES, SPEED, replace(film, grid=(192, 32)), **line)
    for quantity in QUANTITIES:
        change = 4.0 / 3.0 * np.abs(getattr(own, quantity) - getattr(fine, quantity))
        assert (change < getattr(own.grid_error, quantity)).all(), quantity
    with patch.object(cell_error, "_DRAWN", 0.0):
        blind = bearing.equilibrium(FORCES, SPEED, film, **line)
    change = 4.0 / 3.0 * np.abs(own.minimum_film - fine.minimum_film)
    assert (change > blind.grid_error.minimum_film)[:2].any()


@pytest.mark.parametrize("name", ["plain", "tilt", "shell"])
def test_a_bound_does_not_depend_on_what_is_solved_beside_it(name):
    bearing, film, line = described(name)
    together = bearing.equilibrium(FORCES, SPEED, film, **line).relative_grid_error
    one = bearing.equilibrium(FORCES[1], SPEED, film, **line).relative_grid_error
    np.testing.assert_allclose(together[1], one, rtol=1e-6)


@pytest.mark.parametrize("name", ["plain", "lobes", "tilt", "contact"])
def test_bounds_at_a_position_hold(name):
    bearing, film, line = described(name)
    where = 0.6 * bearing.clearance * np.array([0.8, 0.6]), SPEED
    own = bearing.pressure(*where, film, **line)
    fine = finer(bearing.pressure, *where, replace(film, grid=(96, 16)), **line)
    error = 4.0 / 3.0 * np.hypot(*(own.force - fine.force))
    assert error < own.grid_error.force < 0.1 * np.hypot(*own.force)
    change = 4.0 / 3.0 * abs(own.maximum_pressure - fine.maximum_pressure)
    assert change < own.grid_error.maximum_pressure


def test_few_cells_about_a_narrow_gap_are_told():
    bearing, film, line = described("tilt", (16, 8))
    film = replace(film, grading="uniform")
    with pytest.warns(ValidityWarning, match="the cells do not resolve"):
        state = bearing.equilibrium((2e5, 0.0), SPEED, film, **line)
    assert not state.resolved


@pytest.mark.filterwarnings("ignore:the cells do not resolve")
@pytest.mark.parametrize("law", ["guembel", "mass-conserving"])
def test_a_gap_that_even_cells_do_not_resolve_is_of_the_grid_by_sharp_laws_too(law):
    """Its cells crowd there from the beginning: on the even ones h_min is a quarter off."""
    film, geometry, _ = asked((law,), "reduced")
    film = replace(film, grid=(60, 12), grading="auto", inlet=None)
    bearing, load = JournalBearing(**BEARING | {"shape": geometry.shape}), (1e7, 0.0)
    own = bearing.equilibrium(load, SPEED, film)
    even = bearing.equilibrium(load, SPEED, replace(film, grading="uniform"))
    of_grid = bearing.equilibrium(load, SPEED, replace(film, rung="grid"))
    assert own.resolved
    assert own.minimum_film == pytest.approx(float(of_grid.minimum_film), rel=1e-9)
    assert not even.resolved
    assert abs(even.minimum_film / own.minimum_film - 1.0) > 0.15
    held = bearing.pressure(own.eccentricity, SPEED, film)
    np.testing.assert_allclose(held.force, load, atol=1e-6 * load[0])


def test_a_narrow_gap_by_a_sharp_law_has_a_film_of_even_cells_where_none_may_refine():
    """The heat balance of a series asks so: a load less would shift its temperature."""
    film, geometry, _ = asked(("guembel",), "reduced")
    film = replace(film, grid=(60, 12), grading="auto", inlet=None)
    line, bearing = Line(), JournalBearing(**BEARING | {"shape": geometry.shape})
    loads, limits = (
        np.array([[1e3, 0.0], [1e7, 0.0]]),
        Limits(1e-10, 60, strict=False, refine=False),
    )
    found = reduced.equilibrium(AtRest(bearing, film, loads, np.full(2, SPEED), line, limits))
    assert found["converged"].all()


def test_bounds_are_alike_those_of_the_grid():
    bearing, film, _ = described("mixture", (60, 20))  # on the same cells around
    few = bearing.equilibrium(FORCES[:3], SPEED, film).relative_grid_error
    grid = bearing.equilibrium(FORCES[:3], SPEED, replace(film, rung="grid")).relative_grid_error
    kept = [BOUNDED.index(name) for name in ("minimum_film", "maximum_pressure", "friction_power")]
    assert (few[:, kept] < 1.5 * grid[:, kept]).all()
    assert (few[:, kept] > 0.2 * grid[:, kept]).all()
