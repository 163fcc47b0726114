"""The four-point slewing bearing against the source, its reference values, and its laws."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.rolling import SlewingBearing

BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=math.pi / 4,
)
# reference values of an independent solver use the printed mean stiffness factor
PRINTED = dataclasses.replace(BLADE, contact_stiffness=2.219e6 * 1e3**1.5)


def test_axial_load_gives_the_printed_ball_force():
    result = BLADE.equilibrium(force=(0, 0, 2e6))
    assert result.ball_forces.shape == (2, 2, 129)
    assert result.ball_forces[:, 0] == pytest.approx(10_438, rel=5e-4)
    assert (result.ball_forces[:, 1] == 0).all()
    assert result.displacement[2] == pytest.approx(0.0771e-3, rel=1e-3)
    assert np.degrees(result.contact_angles[0, 0, 0]) == pytest.approx(47.96, abs=0.01)
