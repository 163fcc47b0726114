"""Loads of main bearings grow over the radius as statics and similarity ask of them."""

import pytest

from loadflow.validation._growth import DESIGNS, LOADS, SIMILAR, exponents

SHORT = {"wind_speed": 12.0, "seeds": [1], "duration": 60.0}
MEAN, FORCE, MOMENT = LOADS


def test_a_force_grows_with_the_moment_over_the_span():
    own, fixed = exponents(SIMILAR, **SHORT), exponents(SIMILAR, **SHORT, shaft=SIMILAR[0])
    assert own[MEAN] > 3.0  # weight R³, in turbulence that does not grow with the rotor
    assert own[MOMENT] == fixed[MOMENT] == pytest.approx(3.0, abs=0.3)
    # one power of R less where the span grows, too
    assert fixed[FORCE] - own[FORCE] == pytest.approx(1.0, abs=0.15)
    assert own[FORCE] < 2.6


def test_the_growth_between_designs_is_not_that_of_similarity():
    designs = exponents(DESIGNS, **SHORT)
    assert designs[MEAN] < 2.6  # rotors are built lighter than R³
    assert 2.0 < designs[FORCE] < 3.2
    assert 2.5 < designs[MOMENT] < 3.4
