"""The shaft line vibrates as its matrices say, whatever holds it."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.shaft import (
    Beam,
    Disc,
    LineSupport,
    ShaftLine,
    ShaftSection,
    modes,
    unbalance_response,
)

BEAM = Beam((ShaftSection(1.0, 0.5),))
K = np.array([[2e9, 1e9], [-1e9, 3e9]])
C = np.array([[2e7, 3e6], [3e6, 1e7]])


def line(**more):
    return ShaftLine(BEAM, 5.0, (Disc(0.0, 1e5, 4e7, 2e7), Disc(5.0, 6e4)), **more)


def two(*args, **more):
    return [LineSupport(1.0, *args, **more), LineSupport(4.0, *args, **more)]


def test_half_the_stiffness_of_an_undamped_bearing_is_a_housing_as_stiff_in_series():
    twice = np.diag([4e9, 6e9])
    soft = modes(line(), two(twice / 2), 1.0)
    series = modes(line(), two(twice, None, housing=(4e9, 6e9)), 1.0)
    np.testing.assert_allclose(series.natural_frequency, soft.natural_frequency, rtol=1e-9)


def test_a_housing_lets_go_of_a_film_whose_own_damping_is_large():
    stiff = modes(line(), two(K, 1e3 * C), 1.0)
    housed = modes(line(), two(K, 1e3 * C, housing=(3e9, 3e9)), 1.0)
    rigid = modes(line(), [LineSupport(1.0), LineSupport(4.0)], 1.0)
    springs = modes(line(), two(np.diag([3e9, 3e9])), 1.0)
    lowest = [float(m.natural_frequency[0]) for m in (stiff, housed, rigid, springs)]
    assert lowest[0] == pytest.approx(lowest[2], rel=0.02)  # the film is a rigid bearing
    assert lowest[1] == pytest.approx(lowest[3], rel=0.02)  # the housing is what gives


def test_the_roots_fulfil_the_equation_of_motion():
    found = modes(line(), two(K, C), 1.2, count=8)
    assert float(found.residual.max()) < 1e-9
    assert (np.diff(found.natural_frequency) >= 0).all()


def test_cross_stiffness_without_damping_is_unstable_and_damping_settles_it():
    whirls = np.array([[2e9, 1e9], [-1e9, 2e9]])
    assert modes(line(), two(whirls), 1.0).largest_growth > 0
    assert modes(line(), two(whirls, np.diag([1e8, 1e8])), 1.0).largest_growth < 0


def test_more_elements_change_nothing():
    coarse, fine = (modes(line(elements=n), two(K, C), 1.0) for n in (12, 48))
    np.testing.assert_allclose(coarse.natural_frequency, fine.natural_frequency, rtol=1e-5)


def test_a_light_shaft_and_one_without_mass_agree():
    light, none = (modes(line(density=d), two(K, C), 1.0, count=3) for d in (1e-3, 0.0))
    np.testing.assert_allclose(light.natural_frequency, none.natural_frequency, rtol=1e-5)


def test_an_unbalance_far_above_all_frequencies_turns_the_shaft_about_its_centre_of_mass():
    free = ShaftLine(BEAM, 5.0, (Disc(2.5, 1e5),), density=0.0)
    held = [LineSupport(1.0, np.eye(2)), LineSupport(4.0, np.eye(2))]
    found = unbalance_response(free, lambda w: held, [100.0], 50.0, 2.5, [2.5])
    assert float(found.amplitude[0, 0]) == pytest.approx(50.0 / 1e5, rel=1e-6)
    assert found.attrs["residual"] < 1e-9


def test_a_mode_that_is_overdamped_leaves_a_gap():
    found = modes(ShaftLine(BEAM, 5.0, elements=1), two(K, 1e6 * np.eye(2)), 1.0, count=40)
    assert found.natural_frequency.isnull().any()
    assert found.natural_frequency.notnull().any()


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: ShaftLine(BEAM, -1.0),
        lambda: ShaftLine(BEAM, 1.0, (Disc(2.0, 1.0),)),
        lambda: Disc(0.0, -1.0),
        lambda: modes(line(), [LineSupport(7.0)], 1.0),
        lambda: modes(line(), two(np.eye(3)), 1.0),
        lambda: modes(line(), two(np.eye(2), np.eye(4)), 1.0),
        lambda: modes(line(), two(K), 1.0, count=0),
        lambda: unbalance_response(line(), lambda w: two(K), [1.0], -1.0),
        lambda: unbalance_response(line(), lambda w: two(K), [np.nan], 1.0),
        lambda: unbalance_response(line(), lambda w: two(K), [1.0], 1.0, 9.0),
    ],
)
def test_what_is_no_shaft_line_is_refused(wrong):
    with pytest.raises(InputError):
        wrong()
