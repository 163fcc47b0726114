"""Approximate Hertz contacts: errors as documented, limits, refusals."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.tribology import hertz_point


def errors(rung, low, high):
    """Largest relative errors of stiffness and pressure over a range of curvature ratios."""
    ratio = np.geomspace(low, high, 400)
    ours, exact = (hertz_point(ratio, 1.0, 0.0, 0.0, force=1e3, rung=r) for r in (rung, "exact"))
    return [
        float(np.abs(getattr(ours, name) / getattr(exact, name) - 1).max())
        for name in ("stiffness", "pressure")
    ]


@pytest.mark.parametrize(
    ("rung", "low", "high", "stiffness", "pressure"),
    [
        ("spline", 1, 200, 1e-8, 1e-8),
        ("spline", 1, 1e5, 1e-8, 1e-8),
        ("regression", 5, 60, 0.038, 0.014),
        ("regression", 1, 200, 0.096, 0.034),
        ("power", 5, 60, 0.04, 0.017),
        ("power", 1, 200, 0.107, 0.024),
    ],
)
def test_rungs_hold_their_documented_errors(rung, low, high, stiffness, pressure):
    found = errors(rung, low, high)
    assert found[0] < stiffness
    assert found[1] < pressure


def test_power_law_is_exact_for_circles():
    circle = [hertz_point(1.0, 1.0, 0.0, 0.0, force=1e3, rung=r) for r in ("power", "exact")]
    assert circle[0].pressure == pytest.approx(circle[1].pressure, rel=1e-12)
    assert circle[0].approach == pytest.approx(circle[1].approach, rel=1e-12)


def test_unknown_rungs_are_refused():
    with pytest.raises(InputError, match="rung"):
        hertz_point(1.0, 1.0, 0.0, 0.0, force=1.0, rung="guess")
