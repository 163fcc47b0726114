"""Solvers that go through series, and the turbulence: an answer that holds, or a named error.

A sample here; ``python -m benchmarks.robustness.hard_fuzz`` draws 10,000 of each, and 1,000 orbits.
"""

import numpy as np
from hypothesis import assume, event, example, given, settings
from hypothesis import strategies as st
from test_fuzz import ANGLES, answered, powers

from loadflow.journal import GasMixture, JournalBearing, Lubricant
from loadflow.reduction import damage_equivalent_load, rainflow
from loadflow.rolling import RollerBearing
from loadflow.wind import kaimal, polar_angles

LONG = settings.get_current_profile_name() == "long"
few = settings(max_examples=10_000 if LONG else 12)
"""Of tests whose draws are dear: few in CI."""

fewer = settings(max_examples=1_000 if LONG else 8)
"""Of tests whose draws are dearer still."""


@fewer
@given(
    slenderness=powers(-0.7, 0.3),
    viscosity=powers(-2.5, 0),
    speed=powers(-1, 2),
    mixing=powers(-3, 0),
    numbers=st.lists(powers(-2, 1.5), min_size=4, max_size=6),
    angles=st.lists(ANGLES, min_size=6, max_size=6),
    step=powers(-3, 1),
    reduced=st.booleans(),
)
def test_a_film_follows_any_jumps_of_the_load_or_says_why_not(
    slenderness, viscosity, speed, mixing, numbers, angles, step, reduced
):
    """Jumps in size and direction, in steps from a thousandth of a turn to ten turns."""
    bearing = JournalBearing(0.3, 0.3 * slenderness, 1e-3)
    size = np.array(numbers) / bearing.sommerfeld_number(1.0, speed, viscosity)
    turned = np.array(angles[: size.size])
    force = size[:, None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1)
    time = np.arange(size.size) * step * 2 * np.pi / speed
    rung = "reduced" if reduced else "grid"
    orbit = answered(
        lambda: bearing.orbit(
            time,
            force,
            speed,
            Lubricant(viscosity),
            cavitation=GasMixture(mixing * 1e5),
            edge_pressure=1e5,
            grid=(48, 8),
            rung=rung,
        )
    )
    if orbit is None:
        event("no answer")
        return
    assert (orbit["eccentricity_ratio"] < 1).all()
    assert (orbit["minimum_film"] > 0).all()
    for name in ("maximum_pressure", "friction_power", "side_flow", "attitude_angle"):
        assert np.isfinite(orbit[name]).all()
    assert orbit["residual"].max() <= 1e-6


@few
@given(
    rollers=st.integers(6, 100),
    rows=st.sampled_from([1, 2, 2, 2]),  # one row carries axial loads one way only, if at all
    roller=powers(-2, -0.8),
    slenderness=st.floats(0.8, 2.5),
    ring=st.floats(1.1, 3.0),
    contact_angle=st.floats(0.0, 0.9),
    gap=st.floats(-1e-3, 3e-3),
    profile=st.sampled_from(["iso", "straight"]),
    magnitude=powers(-3, 8),
    direction=st.lists(st.floats(-1, 1), min_size=5, max_size=5),
)
@example(  # cylindrical rollers carry no axial load, be it a millionth of the moment
    rollers=6,
    rows=1,
    roller=0.1,
    slenderness=1.0,
    ring=2.0,
    contact_angle=0.0,
    gap=0.0,
    profile="iso",
    magnitude=1.0,
    direction=[0.0, 0.0, 1e-6, 0.0, 1.0],
)
def test_rollers_carry_any_load_or_say_why_not(
    rollers, rows, roller, slenderness, ring, contact_angle, gap, profile, magnitude, direction
):
    assume(np.abs(direction).max() > 1e-3)
    pitch = ring * rollers * roller / np.pi
    length = slenderness * roller
    bearing = answered(
        lambda: RollerBearing(
            rollers=rollers,
            roller_diameter=roller,
            roller_length=length,
            pitch_diameter=pitch,
            rows=rows,
            row_spacing=1.5 * length,
            contact_angle=contact_angle,
            clearance=gap * roller,
            profile=profile,
        )
    )
    load = magnitude * np.array(direction)
    load[3:] *= pitch / 2
    result = bearing and answered(lambda: bearing.equilibrium(load[:3], load[3:]))
    if result is None:
        event("no answer")
        return
    assert result.converged
    assert result.residual <= 1e-8
    assert (result.roller_forces >= 0).all()
    assert np.isfinite(result.roller_forces).all()
    assert np.isfinite(result.maximum_pressure)


VALUES = st.one_of(
    st.integers(-4, 4).map(float),
    st.floats(-1e12, 1e12).filter(lambda x: abs(x) > 1e-100),  # products of differences underflow
)


@given(series=st.lists(VALUES, min_size=1, max_size=60), factor=powers(-6, 6))
def test_cycles_grow_with_the_series_and_none_is_larger_than_its_span(series, factor):
    """Repeated values and halves and all: ranges scale, signs do not matter."""
    x = np.array(series)
    cycles, mirrored = rainflow(x), rainflow(-x)
    span = x.max() - x.min()
    assert np.all((cycles.range > 0) & (cycles.range <= span))
    assert cycles.count.sum() <= x.size
    if span > 0:
        assert cycles.range.max() == span
    assert np.array_equal(np.sort(cycles.range), np.sort(mirrored.range))
    load = damage_equivalent_load(x, 4.0, 600.0)
    assert np.isfinite(load)
    assert np.isclose(damage_equivalent_load(factor * x, 4.0, 600.0), factor * load, rtol=1e-9)


@few
@given(
    speed=powers(-1, 2),
    sigma=powers(-3, 1),
    radius=powers(-2, 2.3),
    radii=st.integers(2, 8),
    count=st.integers(3, 24),
    scale=powers(0, 2.5),
    samples=st.integers(3, 200),
    dt=powers(-2, 1),
    seed=st.integers(0, 10**6),
)
def test_any_turbulence_is_finite_and_of_one_wind_at_the_hub(
    speed, sigma, radius, radii, count, scale, samples, dt, seed
):
    """From a model in a tunnel to the largest rotor, from a calm to a hurricane."""
    field = kaimal(
        speed,
        sigma,
        radius=np.linspace(0, radius, radii),
        angles=polar_angles(count),
        duration=samples * dt,
        dt=dt,
        seed=seed,
        length_scale=scale,
    )
    for component in (field.u, field.v, field.w):
        assert np.isfinite(component).all()
        middle = component[:, 0, :]
        assert np.allclose(middle, middle[:, :1], atol=2e-3 * sigma)
        assert component.std() < 6 * sigma
