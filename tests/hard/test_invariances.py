"""No result depends on units, hand or direction of its frame, on company, or on the way to it."""

import time
from dataclasses import replace

import numpy as np
import pytest
from numba import njit

from benchmarks.robustness import invariances
from benchmarks.robustness.clock import Clock, Late
from benchmarks.robustness.invariances import Asked, asked, broken, on_reduced

DRAWS = [
    ("cylinder", 30001),
    ("cylinder", 30007),
    ("shaped", 8),  # a crowned pad that a film holds although its curve without relief knows none
    ("shaped", 30001),  # pads whose tilt at a given position Newton's method does not find
    ("shaped", 30017),
    ("pads", 30001),  # eight alike on sixty cells, of which the last digits of a span gave one more
    ("pads", 30004),
    ("supply", 30002),
    ("line", 30003),  # the narrowest gap between the places where it is sampled
    ("line", 30006),
    ("shell", 30001),
    ("shell", 30005),
    ("contact", 30001),
    ("touching", 30002),
    ("thrust", 30004),
    ("cone", 30003),
    ("pair", 30002),  # films without rupture: nothing holds the shaft along the axis
    ("pair", 30012),
    ("heat", 30003),
    ("orbit", 30002),
    ("composed", 30001),  # an orbit on "reduced"
    ("composed", 30002),
    ("composed", 30004),
    ("composed", 30008),
    ("composed", 30011),
    ("composed", 30013),
    ("composed", 30022),
    ("composed", 30024),
]
REDUCED = [
    ("cylinder", 30007),
    ("cylinder", 80000),
    ("cylinder", 80004),  # so few even cells span its gap that its film is found in one frame only
    ("shaped", 80001),
    ("line", 80001),
    ("contact", 80002),
    ("supply", 80002),
]
MORE = [3, 6, 7, 9, *range(15, 22), 23, 25]
"""Of the parts together from 30000 on; five that take longer are left out. Of 9 a groove lies in a
gap of the shell: it is refused, in the mirror, too."""


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("family", "number"), DRAWS)
def test_a_drawn_bearing_is_the_same_whichever_way_it_is_asked(family, number):
    assert list(broken(asked(family, number))) == []


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize(("family", "number"), REDUCED)
def test_a_film_on_few_points_across_is_the_same_whichever_way_it_is_asked(family, number):
    assert list(broken(on_reduced(asked(family, number)))) == []


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("number", MORE)
def test_parts_together_are_the_same_whichever_way_they_are_asked(number):
    assert list(broken(asked("composed", 30000 + number))) == []


@pytest.mark.filterwarnings("ignore")
def test_what_depends_on_its_units_is_told(monkeypatch):
    """What the test above rests on can fail: a pressure that stays while the others change."""
    monkeypatch.setitem(invariances.DIMENSIONS, "viscosity", (0, 0, 1))
    told = list(broken(asked("cylinder", 30001)))
    assert told
    assert all("in units (1.0, 1000.0, 1.0)" in text for text in told)


def _in_its_direction(case, answer):
    x, y = np.moveaxis(case.given["force"], -1, 0)
    film = answer.minimum_film * (1.0 + 1e-3 * np.cos(np.arctan2(y, x) - 0.5))
    return replace(answer, minimum_film=film)


def _in_company(case, answer):
    if answer.minimum_film.ndim == 0:
        return answer
    return replace(answer, minimum_film=answer.minimum_film * (1.0 + 1e-5))


def _on_the_way(case, answer):
    return replace(answer, force=answer.force * (1.0 + 1e-3))


SPOILT = {
    "turned": ("equilibrium", _in_its_direction),
    "in the mirror": ("equilibrium", _in_its_direction),
    "after a lighter one": ("equilibrium", _in_company),
    "before": ("equilibrium", _in_company),
    "between cells": ("equilibrium", _in_its_direction),
    "at its position": ("pressure", _on_the_way),
    "there and back": ("pressure", _on_the_way),
}


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("name", SPOILT)
def test_what_depends_on_its_frame_its_company_or_its_way_is_told(monkeypatch, name):
    """What the tests above rest on can fail, each way of asking by itself."""
    verb, spoil = SPOILT[name]
    whole = Asked.answer

    def spoilt(case):
        return spoil(case, whole(case)) if case.verb == verb else whole(case)

    monkeypatch.setattr(Asked, "answer", spoilt)
    told = list(broken(asked("cylinder", 30001)))
    assert any(text.startswith(name) for text in told), told


def test_the_clock_ends_work_that_is_late_and_says_how_long_it_took():
    clock = Clock(cap=0.05)
    with clock, pytest.raises(Late):
        time.sleep(sum(0.0 for _ in iter(int, 1)))  # goes on for ever
    assert 0.9 * clock.cap < clock.seconds < 5.0


def test_the_clock_stands_while_kernels_are_compiled():
    kernel = njit(lambda x: x * 2.0 + 1.0)
    begun = time.process_time()
    with Clock() as clock:
        assert kernel(3.0) == 7.0
    assert clock.seconds < 0.5 * (time.process_time() - begun)
