"""Each solver over its whole documented input range: an answer that holds, or a named error.

A sample here; ``HYPOTHESIS_PROFILE=long pytest tests/hard/test_fuzz.py`` draws 10,000.
"""

import numpy as np
from hypothesis import assume, event, example, given
from hypothesis import strategies as st

from loadflow.errors import LoadflowError
from loadflow.journal import (
    GasMixture,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
)
from loadflow.reduction import histogram
from loadflow.rolling import SlewingBearing
from loadflow.seeds import kruskal_wallis, meyer_bahlburg


def powers(low, high):
    """Positive numbers, even over the decades from 10^low to 10^high."""
    return st.floats(low, high).map(lambda x: 10.0**x)


def answered(work):
    """Return the answer, or None where an error names why there is none."""
    try:
        return work()
    except LoadflowError:
        return None


LAWS = st.one_of(
    st.sampled_from([Sommerfeld(), Guembel(), Reynolds(), MassConserving()]),
    powers(-3, 5).map(GasMixture),
)
ANGLES = st.floats(-np.pi, np.pi)


@given(
    diameter=powers(-2, 1),
    slenderness=powers(-1, 0.5),
    clearance=powers(-4, -2),
    viscosity=powers(-3, 0),
    speed=powers(-2, 3),
    number=powers(-3, 2),
    angle=ANGLES,
    law=LAWS,
)
def test_film_carries_any_load_or_says_why_not(
    diameter, slenderness, clearance, viscosity, speed, number, angle, law
):
    bearing = JournalBearing(diameter, diameter * slenderness, clearance)
    oil = Lubricant(viscosity)
    load = number / bearing.sommerfeld_number(1.0, speed, viscosity)
    force = load * np.array([np.cos(angle), np.sin(angle)])
    film = {"lubricant": oil, "cavitation": law, "edge_pressure": 1e5, "grid": (48, 8)}
    state = answered(lambda: bearing.equilibrium(force, speed, **film))
    if state is None:
        event("no answer")
        return
    assert state.converged
    assert 0 <= state.eccentricity_ratio < 1
    for name in ("attitude_angle", "maximum_pressure", "friction_power", "stiffness", "damping"):
        assert np.isfinite(getattr(state, name)).all()
    one_mesh = film | {"grading": "graded", "strict": False}
    position = bearing.equilibrium(force, speed, **one_mesh)
    again = (
        bearing.pressure(position.eccentricity, speed, **one_mesh) if position.converged else None
    )
    if again is not None and again.converged:
        assert np.allclose(again.force, force, rtol=1e-5, atol=1e-7 * load)


@given(
    balls=st.integers(6, 200),
    rows=st.integers(1, 2),
    ball=powers(-2, -0.7),
    ring=st.floats(1.1, 4.0),
    osculation=st.floats(0.51, 0.56),
    contact_angle=st.floats(0.35, 1.2),
    gap=st.floats(-2e-3, 4e-3),
    magnitude=powers(-3, 8),
    direction=st.lists(st.floats(-1, 1), min_size=5, max_size=5),
)
def test_balls_carry_any_load_or_say_why_not(
    balls, rows, ball, ring, osculation, contact_angle, gap, magnitude, direction
):
    pitch = ring * balls * ball / np.pi
    load = magnitude * np.array(direction)
    load[3:] *= pitch / 2
    assume(np.abs(direction).max() > 1e-3)
    bearing = SlewingBearing(
        balls=balls,
        rows=rows,
        ball_diameter=ball,
        pitch_diameter=pitch,
        groove_radius=osculation * ball,
        contact_angle=contact_angle,
        clearance=gap * ball,
    )
    result = answered(lambda: bearing.equilibrium(force=load[:3], moment=load[3:]))
    if result is None:
        event("no answer")
        return
    assert result.converged
    assert result.residual <= 1e-8
    assert (result.ball_forces >= 0).all()
    assert np.isfinite(result.ball_forces).all()
    assert np.isfinite(result.maximum_pressure)


RECORDS = st.lists(
    st.lists(
        st.one_of(st.integers(-3, 3).map(float), st.floats(-1e9, 1e9)), min_size=2, max_size=30
    ),
    min_size=2,
    max_size=6,
)


@given(records=RECORDS, scale=powers(-6, 6), shift=st.integers(-5, 5))
def test_rank_tests_feel_neither_scale_nor_order(records, scale, shift):
    for test in (kruskal_wallis, meyer_bahlburg):
        found = test(records)
        assert 0 <= found.pvalue <= 1
        assert found.statistic >= -1e-9
        turned = test([np.array(record)[::-1] for record in records[::-1]])
        assert np.isclose(found.statistic, turned.statistic, rtol=1e-9, atol=1e-9)


@given(
    n=st.integers(1, 400),
    size=st.floats(0.005, 1.0),
    seed=st.integers(0, 1000),
    spread=powers(-9, 9),
    pick=st.sampled_from(["random", "extremes", "envelope"]),
)
@example(n=3, size=0.25, seed=694, spread=1.0, pick="extremes")  # severest and strongest: two pairs
def test_reduction_keeps_the_weight_of_the_whole_series(n, size, seed, spread, pick):
    rng = np.random.default_rng(seed)
    speed, force = rng.normal(1, 0.1, n), spread * rng.standard_t(2, (n, 2))
    reduced = histogram(speed, force, np.arange(n) * 0.1, size=size, pick=pick, seed=seed)
    assert np.isclose(reduced.weight.sum(), n)
    assert np.unique(reduced.index).size == reduced.index.size
    if pick != "random":
        load = np.hypot(*force.T)
        severity = load / np.abs(speed)
        assert np.isclose(severity[reduced.index].max(), severity.max(), rtol=1e-12)
        row = np.searchsorted(reduced.edges[0], speed[load.argmax()], side="right") - 1
        assert load.argmax() in reduced.index or reduced.counts_reduced[row, -1] == 1
        assert load[reduced.index].max() >= reduced.edges[1][-2]
