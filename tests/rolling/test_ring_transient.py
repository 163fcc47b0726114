"""The motion of a bearing ends where its equilibrium is."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import (
    FlexibleRings,
    Inertia,
    RingBeam,
    RingSection,
    SlewingBearing,
    Support,
    transient_response,
)

BEARING = SlewingBearing(
    balls=45, ball_diameter=0.015, pitch_diameter=0.250, groove_radius=0.0078,
    contact_angle=math.pi / 4,
)  # fmt: skip
RINGS = FlexibleRings(
    outer=RingBeam(
        section=RingSection.rectangle(0.028, 0.040), radius=0.146, harmonics=8,
        supports=(Support(radius=0.15, height=-0.02, radial=1e9, tangential=1e9, axial=1e9,
                          tilt=1e6),),
    ),
    modes=12,
)  # fmt: skip


@pytest.mark.parametrize(("damping", "overshoots"), [(0.5e-3, True), (2e-3, False)])
def test_motion_settles_to_the_static_answer_whatever_the_damping(damping, overshoots):
    force, moment = (4e3, -2e3, 9e3), (300.0, 450.0)
    inertia = Inertia(mass=50, radius=0.1, contact_damping=damping)
    motion = transient_response(BEARING, RINGS, inertia, force, moment, duration=0.3)
    static = BEARING.equilibrium(force, moment, rings=RINGS)
    assert motion.residual < 1e-8
    assert motion.displacement[-1] == pytest.approx(static.displacement, rel=1e-8)
    assert motion.largest_force[-1] == pytest.approx(static.maximum_force, rel=1e-8)
    # a load put on at once overshoots, unless damping holds it back
    assert (motion.largest_force.max() > 1.1 * static.maximum_force) == overshoots


def test_a_bearing_without_load_stays_where_it_is():
    inertia = Inertia(mass=50, radius=0.1)
    motion = transient_response(BEARING, RINGS, inertia, (0, 0, 0), duration=0.01)
    assert np.abs(motion.displacement).max() == 0


def test_mass_must_be_positive():
    with pytest.raises(InputError, match="mass"):
        Inertia(mass=0, radius=0.1)
