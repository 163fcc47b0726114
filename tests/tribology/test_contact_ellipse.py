"""Approximate Hertz contacts: errors as documented, limits, refusals."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.tribology import hertz_line, hertz_point


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


def test_lundbergs_line_contact_is_near_the_other_laws_and_its_stiffness_is_its_slope():
    forces = np.array([1e3, 1e4, 1e5])
    keys = {"r1": 200.0, "r2": 20.0, "length": 0.02}
    ours, palmgren = (hertz_line(**keys, force=forces, law=law) for law in ("lundberg", "palmgren"))
    assert ours.approach == pytest.approx(palmgren.approach, rel=0.15)
    more = hertz_line(**keys, force=forces * 1.0001, law="lundberg")
    slope = 1e-4 * forces / (more.approach - ours.approach)
    assert ours.stiffness == pytest.approx(slope, rel=1e-3)
    assert hertz_line(**keys, force=0.0, law="lundberg").approach == 0


def test_lundbergs_law_ends_and_unknown_laws_are_refused():
    with pytest.raises(InputError, match="force"):
        hertz_line(200.0, 0.0, length=1e-6, force=1e5, law="lundberg")
    with pytest.raises(InputError, match="r1"):
        hertz_line(0.0, 200.0, length=0.01, force=1.0, law="lundberg")
    with pytest.raises(InputError, match="law"):
        hertz_line(200.0, 0.0, length=0.01, force=1.0, law="hooke")
