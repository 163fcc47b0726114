"""Reduced films at given positions and velocities against those of the grid, and at rest."""

from dataclasses import replace

import numpy as np
import pytest
from film_matrix import BEARING, asked

from loadflow.errors import InputError
from loadflow.journal import JournalBearing

SPEED, ANSWERS = 100.0, ("maximum_pressure", "friction_power", "side_flow", "total_fill")
PLACE = 0.5 * np.array([0.8, -0.6])  # clearances
WAYS = {"still": np.zeros(2), "moving": np.array([21.0, 15.0])}  # clearances per second
EFFECTS = {
    "plain": (),
    "conserving": ("mass-conserving",),
    "reynolds": ("reynolds",),
    "arc": ("arc",),
    "lobes": ("lobes",),
    "crown": ("crown",),
    "tilt": ("tilt and bend",),
    "shell": ("local shell",),
    "contact": ("contact",),
    "turbulence": ("turbulence",),
    "supply": ("supply", "tilt and bend"),
    "rough": ("contact", "tilt and bend", "turbulence"),
    "many": ("contact", "local shell", "tilt and bend", "lobes", "turbulence"),
}
OFF = {"supply": 0.02}
"""How far they are from the grid with 40 cells across, 0.5 % but beside grooves."""


def described(effect, rung):
    """Bearing, film and line of an effect."""
    film, geometry, line = asked(EFFECTS[effect], rung)
    more = {"shape": geometry.shape, "relief": geometry.relief}
    return JournalBearing(**BEARING | more), film, line


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize("effect", EFFECTS)
def test_films_at_a_position_are_those_of_the_grid(effect, way):
    bearing, film, line = described(effect, "reduced")
    where = PLACE * bearing.clearance, SPEED
    velocity = WAYS[way] * bearing.clearance
    few = bearing.pressure(*where, film, velocity, **line)
    fine = bearing.pressure(*where, replace(film, rung="grid", grid=(36, 40)), velocity, **line)
    bound = OFF.get(effect, 0.005)
    assert np.hypot(*(few.force - fine.force)) < bound * np.hypot(*fine.force)
    for name in ANSWERS:
        one, other = getattr(few, name), getattr(fine, name)
        assert abs(one - other) < 2.0 * bound * abs(other), name
    assert few.minimum_film == pytest.approx(float(fine.minimum_film), rel=1e-3)
    for name in ("stiffness", "damping"):
        one, other = getattr(few, name)[:2, :2], getattr(fine, name)[:2, :2]
        assert np.abs(one - other).max() < 0.025 * np.abs(other).max(), name
    # what is shown are the same fields, at other places
    assert few.pressure.shape == (few.angle.size, few.z.size)
    rim = 0.5 * bearing.width
    for name in ("pressure", "gap"):
        scale = np.abs(getattr(fine, name)).max()
        middle = [
            np.array([np.interp(0.3 * rim, field.z, row) for row in getattr(field, name)])
            for field in (few, fine)
        ]
        off = np.abs(np.interp(fine.angle, few.angle, middle[0], period=2 * np.pi) - middle[1])
        assert off.mean() < 0.01 * scale, name
        assert off.max() < 0.08 * scale, name  # where the film ends within a cell


@pytest.mark.parametrize("effect", EFFECTS)
def test_position_load_position_closes(effect):
    bearing, film, line = described(effect, "reduced")
    force = np.array([6e3, 1e3])
    state = bearing.equilibrium(force, SPEED, film, **line)
    field = bearing.pressure(state.eccentricity, SPEED, film, **line)
    np.testing.assert_allclose(field.force, force, rtol=1e-6, atol=1e-6 * 6e3)
    for name in (*ANSWERS, "minimum_film"):
        assert float(getattr(field, name)) == pytest.approx(float(getattr(state, name)), rel=1e-6)
    scale = np.abs(state.damping).max()
    np.testing.assert_allclose(field.damping, state.damping, atol=1e-6 * scale)


@pytest.mark.parametrize("effect", ["plain", "conserving", "lobes", "supply", "rough"])
def test_stiffness_and_damping_are_differences_of_the_force(effect):
    bearing, film, line = described(effect, "reduced")
    place, velocity = PLACE * bearing.clearance, WAYS["moving"] * bearing.clearance
    field = bearing.pressure(place, SPEED, film, velocity, **line)
    for axis in range(2):
        step = np.eye(2)[axis] * 1e-4 * bearing.clearance
        there, before = (
            bearing.pressure(place + sign * step, SPEED, film, velocity, **line).force
            for sign in (1, -1)
        )
        slope = (there - before) / (2 * step[axis])
        scale = np.abs(field.stiffness[:2, :2]).max()
        np.testing.assert_allclose(field.stiffness[:2, axis], slope, atol=2e-4 * scale)
        there, before = (
            bearing.pressure(place, SPEED, film, velocity + sign * SPEED * step, **line).force
            for sign in (1, -1)
        )
        slope = (there - before) / (2 * SPEED * step[axis])
        scale = np.abs(field.damping[:2, :2]).max()
        np.testing.assert_allclose(field.damping[:2, axis], slope, atol=2e-4 * scale)


def test_each_film_is_the_same_whatever_is_beside_it():
    bearing, film, line = described("tilt", "reduced")
    places = np.array([PLACE, [0.2, 0.1], [0.85, 0.0]]) * bearing.clearance
    all_of_them = bearing.pressure(places, SPEED, film, **line)
    for n, place in enumerate(places):
        alone = bearing.pressure(place, SPEED, film, **line)
        for name in ("force", *ANSWERS, "stiffness", "damping"):
            np.testing.assert_array_equal(getattr(all_of_them, name)[n], getattr(alone, name))


def test_a_gap_that_the_cells_do_not_resolve_is_that_of_the_grid():
    bearing, film, _ = described("plain", "reduced")
    film = replace(film, grading="auto")
    places = np.array([[0.5, 0.0], [0.998, 0.01]]) * bearing.clearance
    few = bearing.pressure(places, SPEED, film)
    fine = bearing.pressure(places[1], SPEED, replace(film, rung="grid"))
    np.testing.assert_allclose(few.force[1], fine.force, rtol=1e-9)
    assert few.pressure[1].max() > 0.3 * fine.pressure.max()
    with pytest.raises(InputError, match=r"eccentricity 1: .*touches the bore"):
        bearing.pressure(np.array([[0.5, 0.0], [1.01, 0.0]]) * bearing.clearance, SPEED, film)


@pytest.mark.parametrize(
    ("parts", "ratio", "way"),
    [
        (("gas-mixture", "lobes"), 0.0689, (0.0, 4.1)),
        (("mass-conserving", "local shell", "contact"), 0.98, (0.0, 0.0)),
        (("gas-mixture", "crown", "contact"), 0.94, (-1.0, 1.5)),
    ],
    ids=["fast squeeze", "pressed", "opening"],
)
def test_films_that_are_not_found_at_once_are_found_by_way_of_others(parts, ratio, way):
    film, geometry, line = asked(parts, "reduced")
    more = {"shape": geometry.shape, "relief": geometry.relief}
    bearing = JournalBearing(**BEARING | more)
    velocity = np.array(way) * SPEED * bearing.clearance
    place = ratio * bearing.clearance * np.array([1.0, 0.0])
    field = bearing.pressure(place, SPEED, film, velocity, **line)
    assert field.converged
    assert field.residual < 1e-9
