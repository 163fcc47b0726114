"""Each combination of parts of a film answers or is refused by name, as the registry says."""

from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from film_matrix import BEARING, OCCASIONS, PARTS, RUNGS_SHOWN, asked, asks, refused, table

from loadflow.errors import InputError
from loadflow.journal import JournalBearing

PAGE = Path(__file__).parents[2] / "docs" / "journal-matrix.md"
LOAD, SPEED, TIME = np.array([6e3, 1e3]), 100.0, np.linspace(0.0, 0.02, 5)
WAVE = np.cos(2 * np.pi * TIME / TIME[-1])


def answer(names, rung, occasion):
    """Solve a combination; whether all of it has an answer."""
    film, geometry, line = asked(names, rung)
    bearing = JournalBearing(**BEARING | {"shape": geometry.shape, "relief": geometry.relief})
    if occasion == "rest":
        return bool(bearing.equilibrium(LOAD, SPEED, film, **line).converged)
    if occasion == "position":
        place = 0.3 * bearing.clearance * np.array([0.8, -0.6])
        return bool(bearing.pressure(place, SPEED, film, **line).converged)
    rows = {name: np.tile(values, (TIME.size, 1)) for name, values in line.items()}
    force = LOAD + np.outer(WAVE, [500.0, 0.0])
    steps = {"step": "adaptive" if occasion == "adaptive" else "given"}
    path = bearing.orbit(TIME, force, SPEED, film, periodic=occasion == "closed", **steps, **rows)
    return bool(np.isfinite(path.minimum_film).all())


def fits(names):
    axes = [PARTS[name].axis for name in names]
    return len(set(axes)) == len(axes)


def some(count, seed):
    """Combinations of any number of parts, drawn for a rung and an occasion."""
    draw, found = np.random.default_rng(seed), []
    axes = sorted({part.axis for part in PARTS.values()})
    while len(found) < count:
        names = []
        for axis in axes:
            of_axis = [name for name, part in PARTS.items() if part.axis == axis]
            if draw.random() < 0.5:
                names.append(of_axis[draw.integers(len(of_axis))])
        rung = RUNGS_SHOWN[draw.integers(2)]
        occasion = [*OCCASIONS][draw.integers(len(OCCASIONS))]
        if asks(names, occasion):
            found.append((tuple(names), rung, occasion))
    return found


ALONE = [
    ((name,), rung, occasion)
    for name in PARTS
    for rung in RUNGS_SHOWN
    for occasion in OCCASIONS
    if asks((name,), occasion)
]
PAIRS = [
    (names, rung, occasion)
    for names in combinations(PARTS, 2)
    if fits(names)
    for rung in RUNGS_SHOWN
    for occasion in OCCASIONS
    if asks(names, occasion)
]


def check(names, rung, occasion):
    why = refused(names, rung, occasion)
    if why is None:
        assert answer(names, rung, occasion)
        return
    with pytest.raises(InputError) as told:
        answer(names, rung, occasion)
    assert "is not allowed" in str(told.value)


@pytest.mark.parametrize(("names", "rung", "occasion"), ALONE)
def test_each_part_alone(names, rung, occasion):
    check(names, rung, occasion)


@pytest.mark.parametrize(("names", "rung", "occasion"), some(60, seed=1))
def test_drawn_combinations(names, rung, occasion):
    check(names, rung, occasion)


@pytest.mark.slow
@pytest.mark.parametrize(("names", "rung", "occasion"), PAIRS)
def test_each_pair(names, rung, occasion):
    check(names, rung, occasion)


@pytest.mark.parametrize("rung", RUNGS_SHOWN)
def test_the_page_is_what_the_registry_says(rung):
    text = PAGE.read_text(encoding="utf-8")
    assert "\n".join(table(rung)) in text, "\n".join(table(rung))
