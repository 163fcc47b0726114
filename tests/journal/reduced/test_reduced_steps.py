"""Steps that the rung "reduced" chooses by their error: the rule of the grid in its own loops."""

from dataclasses import replace

import numpy as np
import pytest
from film_matrix import BEARING, asked

from loadflow.errors import InputError
from loadflow.journal import JournalBearing
from loadflow.journal.solvers.motion.step_size import SAFETY, foreseen, growth

SPEED, PERIOD = 100.0, 0.12
TIME = np.linspace(0.0, PERIOD, 13)
PHASE = 2 * np.pi * TIME / PERIOD
LOAD = np.stack([6e3 + 4e3 * np.sin(3 * PHASE), 1e3 + 3e3 * np.cos(2 * PHASE)], axis=-1)
EFFECTS = {
    "plain": (),
    "tilt": ("tilt and bend",),
    "moment": ("moment",),
    "contact": ("contact",),
    "shell": ("local shell",),
    "lobes": ("lobes",),
    "supply": ("supply",),
    "stored heat": ("heat, stored",),
    "many": ("mass-conserving", "lobes", "tilt and bend", "turbulence"),
}


def path(parts, finer=1, rung="reduced", **options):
    """Path under the load that runs straight between its samples, on times as much `finer`."""
    film, geometry, line = asked(parts, rung)
    bearing = JournalBearing(**BEARING | {"shape": geometry.shape, "relief": geometry.relief})
    time = np.linspace(0.0, PERIOD, 12 * finer + 1)
    force = np.stack([np.interp(time, TIME, part) for part in LOAD.T], axis=-1)
    rows = {name: np.tile(values, (time.size, 1)) for name, values in line.items()}
    return bearing.orbit(time, force, SPEED, film, **rows, **options)


def chosen(parts, tolerance, **more):
    return path(parts, step="adaptive", step_tolerance=tolerance, **more)


@pytest.mark.parametrize("effect", EFFECTS)
def test_chosen_steps_meet_their_tolerance_where_given_ones_are_too_long(effect):
    parts = EFFECTS[effect]
    exact = path(parts, finer=256).isel(time=slice(None, None, 256))
    clearance = BEARING["relative_clearance"] * BEARING["diameter"] / 2
    errors, steps = [], []
    for tolerance in (None, 1e-3, 1e-5):
        found = path(parts) if tolerance is None else chosen(parts, tolerance)
        apart = found.eccentricity.values - exact.eccentricity.values
        errors.append(float(np.hypot(*apart.T).max()) / clearance)
        steps.append(12 if tolerance is None else int(found.steps.sum()))
    assert errors[0] > 0.02
    assert errors[1] < 0.004
    # one step is of third order, the path of second: 100^(2/3) = 22; the load has corners
    assert errors[2] < errors[1] / 5
    order = np.log(errors[1] / errors[2]) / np.log(steps[2] / steps[1])
    assert order > (1.3 if effect == "stored heat" else 1.6)  # of which one is given a sample
    assert steps[1] < 120


@pytest.mark.parametrize("parts", [(), ("lobes",), ("tilt and bend",)], ids=str)
def test_as_many_steps_as_on_the_grid_are_taken(parts):
    few, grid = (chosen(parts, 1e-3, rung=rung) for rung in ("reduced", "grid"))
    assert int(few.steps.sum()) == pytest.approx(int(grid.steps.sum()), rel=0.15)
    assert np.abs(few.minimum_film / grid.minimum_film - 1.0).max() < 0.02


@pytest.mark.parametrize("parts", [(), ("tilt and bend", "contact"), ("lobes",)], ids=str)
def test_a_tolerance_that_every_step_meets_leaves_the_steps_that_are_given(parts):
    free, given = chosen(parts, 1e6), path(parts)
    assert (free.steps[1:] == 1).all()
    np.testing.assert_array_equal(free.eccentricity, given.eccentricity)
    assert "steps" not in given


def test_pads_that_keep_their_films_take_the_steps_of_the_grid():
    film, geometry, _ = asked(("tilting pads",), "reduced")
    bearing = JournalBearing(**BEARING | {"shape": geometry.shape})
    force = np.array([6e3, 1e3]) + 3e2 * np.stack([np.sin(PHASE), np.cos(PHASE)], axis=-1)
    few, grid = (
        bearing.orbit(
            TIME, force, SPEED, replace(film, rung=rung), step="adaptive", step_tolerance=1e-3
        )
        for rung in ("reduced", "grid")
    )
    assert int(few.steps.sum()) == pytest.approx(int(grid.steps.sum()), rel=0.2)
    assert np.abs(few.minimum_film / grid.minimum_film - 1.0).max() < 0.02


def test_steps_of_its_own_are_refused_on_a_closed_path():
    film, _, _ = asked((), "reduced")
    force = LOAD.copy()
    force[-1] = force[0]
    with pytest.raises(InputError, match=r"step = 'adaptive' .* \"given\" on a closed path"):
        JournalBearing(**BEARING).orbit(TIME, force, SPEED, film, step="adaptive", periodic=True)


def test_the_rule_takes_the_error_of_a_cubic_for_what_it_is():
    """Of t³, second-order steps leave a known share of how far it is from the quadratic."""
    step, before, earlier = 0.3, 0.2, 0.4
    times = np.array([0.0, -before, -before - earlier])
    ahead = np.dot(foreseen(step, before, earlier), times**3)
    left = abs(step**3 - ahead)
    assert left == pytest.approx(step * (step + before) * (step + before + earlier))
    # BDF2 on t³ from exact values, its stiffness far above the inverse of the step
    ratio = step / before
    rate, last = (1 + 2 * ratio) / (1 + ratio) / step, (1 + ratio) / step
    slope = (rate * step**3 + ratio**2 / (1 + ratio) / step * (-before) ** 3) - last * 0.0
    error = abs(slope - 3 * step**2) / rate
    allowed = error * 2.0**3  # eight times the error allows twice the step
    assert growth(left, 1.0, step, before, earlier, allowed) == pytest.approx(2 * SAFETY, rel=0.5)
