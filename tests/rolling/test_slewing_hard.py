"""Hard numerical cases of the four-point bearing with rigid rings."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from loadflow.errors import InputError, SolverError
from loadflow.rolling import FlexibleRings, RingBeam, RingSection, SlewingBearing, axial_expansion
from loadflow.rolling.rating.capacity import slewing_capacity
from loadflow.rolling.rings.expansion import RingSections

BEARING = SlewingBearing(
    balls=45, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4, distance="meridional",
)  # fmt: skip
FREE = BEARING.groove_distance
BOUND = 2 * FREE * math.sin(math.pi / 4)  # of the clearance
PART = st.one_of(st.just(0.0), st.floats(-1, 1), st.sampled_from([1e-9, -1e-9]))


@settings(max_examples=60, deadline=None)
@given(
    gap=st.sampled_from([0.0, 1e-6, -1e-6, 0.3, -0.3, 0.99, -0.99]),
    size=st.floats(-1, 6),  # below, the last digits of the displacement rule
    load=st.tuples(PART, PART, PART, PART, PART),
    balls=st.integers(3, 45),
    rows=st.integers(1, 2),
)
def test_every_load_at_every_clearance_is_balanced(gap, size, load, balls, rows):
    bearing = dataclasses.replace(
        BEARING, clearance=gap * BOUND, balls=balls, rows=rows, row_spacing=0.02 * (rows > 1)
    )
    assume(not 0 < max(map(abs, load)) <= 0.1)
    full = 10**size * np.array(load) * [1, 1, 1, 0.06, 0.06]
    result = bearing.equilibrium(full[:3], full[3:])
    force = result.ball_forces
    angle = result.contact_angles * np.array([1, -1])[:, None]
    around = result.contacts.azimuth
    radial = force * np.cos(angle)
    pull = [(radial * np.cos(around)).sum(), (radial * np.sin(around)).sum(),
            (force * np.sin(angle)).sum()]  # fmt: skip
    largest = max(np.abs(full).max() * 20, 1e-4 * force.sum(), 1e-300)
    assert np.abs(pull - full[:3]).max() <= 1e-9 * largest
    assert result.residual <= 1e-10
    assert np.isfinite(result.displacement).all()


def test_a_loose_bearing_without_load_rests_and_says_that_nothing_holds_it():
    loose = dataclasses.replace(BEARING, clearance=20e-6)
    result = loose.equilibrium([(0, 0, 0), (0, 0, 1e-6), (1e4, 0, 2e4)])
    assert result.singular.tolist() == [True, False, False]
    assert result.ball_forces[0].max() == 0
    # the lightest thrust closes the gap: half the clearance up, and all balls share it
    assert result.displacement[1, 2] == pytest.approx(10e-6, rel=1e-3)
    assert result.ball_forces[1, 0, 0] == pytest.approx(1e-6 / 45 / math.sin(math.pi / 4), rel=1e-2)
    assert np.isinf(result.static_safety[0])
    assert np.isinf(result.rating_life[0])


def test_preload_holds_the_ring_without_load_and_adds_to_both_diagonals():
    tight = dataclasses.replace(BEARING, clearance=-10e-6)
    rest, loaded = tight.equilibrium([(0, 0, 0), (0, 0, 2e3)]).ball_forces
    assert not tight.equilibrium((0, 0, 0)).singular
    assert np.ptp(rest) < 1e-9 * rest.max()
    # the closed form: both contacts in series share what the groove centres are too far apart
    cos = FREE * math.cos(math.pi / 4)
    high = FREE * math.sin(math.pi / 4) + 5e-6
    expected = tight.series_stiffness * (math.hypot(cos, high) - FREE) ** 1.5
    assert rest == pytest.approx(expected, rel=1e-9)
    assert loaded[0, 0].min() > rest.max() > loaded[0, 1].max() > 0


def test_axial_load_follows_the_closed_form_from_touch_to_steep_contacts():
    thrust = np.logspace(0, 7, 15)
    result = BEARING.equilibrium(thrust[:, None] * [0, 0, 1])
    rigid = RingSections(
        outer_outside=1.0, outer_inside=0.3, inner_outside=0.2, inner_inside=0.1, height=0.1
    )
    closed = axial_expansion(BEARING, thrust, rigid, flexible="none")
    assert result.maximum_force == pytest.approx(closed.ball_force, rel=1e-8)
    assert result.displacement[:, 2] == pytest.approx(closed.displacement, rel=1e-8)
    assert math.degrees(result.contact_angles[-1, 0, 0, 0]) > 65


def test_the_angle_stays_below_90_degrees_or_the_rings_are_refused():
    soft = RingBeam(section=RingSection.rectangle(0.002, 0.004), radius=0.14, harmonics=8)
    rings = FlexibleRings(outer=soft)
    with pytest.raises(SolverError, match="90°"):
        BEARING.equilibrium((0, 0, 4e5), rings=rings)
    assert (np.abs(BEARING.equilibrium((0, 0, 5e2), rings=rings).contact_angles) < 1.57).all()


def test_open_grooves_have_no_capacity_of_their_own_but_a_stated_one():
    with pytest.raises(InputError, match="state dynamic_capacity instead"):
        slewing_capacity(
            balls=45, rows=1, ball_diameter=0.015, pitch_diameter=0.25,
            contact_angle=math.pi / 4, groove_radius=0.0082,
        )  # fmt: skip
    stated = dataclasses.replace(BEARING, groove_radius=0.0082, dynamic_capacity=60e3)
    assert stated.equilibrium((0, 0, 1e4)).rating_life > 0
