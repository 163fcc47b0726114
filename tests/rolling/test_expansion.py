"""Ring expansion: rigid limit, reference values, bounds of the kinematics."""

import dataclasses
import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.rolling import RingSections, SlewingBearing, axial_expansion

BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=math.pi / 4,
)
RINGS = RingSections(
    outer_outside=2.1, outer_inside=1.902, inner_outside=1.888, inner_inside=1.7, height=0.1
)
LOADS = np.array([1e4, 5e5, 3e6])


def test_rings_that_do_not_expand_give_the_rigid_answer():
    stiff = axial_expansion(BLADE, LOADS, RINGS, flexible="none")
    rigid = BLADE.equilibrium(force=LOADS[:, None] * [0, 0, 1])
    assert stiff.displacement == pytest.approx(rigid.displacement[:, 2], rel=1e-8)
    assert stiff.ball_force == pytest.approx(rigid.maximum_force, rel=1e-8)
    assert stiff.contact_angle == pytest.approx(rigid.contact_angles[:, 0, 0, 0], rel=1e-8)


@pytest.mark.parametrize(("height", "shift"), [(0.1, 0.243e-3), (0.05, 0.289e-3)])
def test_displacement_at_3000_kn_of_the_reference_solver(height, shift):
    result = axial_expansion(BLADE, 3e6, dataclasses.replace(RINGS, height=height))
    assert result.displacement == pytest.approx(shift, abs=1e-6)
    assert result.residual < 1e-12


def test_flexible_rings_give_more_in_the_order_of_their_softness():
    shift = [
        axial_expansion(BLADE, LOADS, RINGS, flexible=f).displacement
        for f in ("none", "inner", "both")
    ]
    assert (shift[0] < shift[1]).all()
    assert (shift[1] < shift[2]).all()
    outer = axial_expansion(BLADE, LOADS, RINGS, flexible="outer")
    assert outer.displacement == pytest.approx(shift[1], rel=0.1)


def test_displacement_keeps_below_the_bound_of_the_kinematics():
    result = axial_expansion(BLADE, 1e7, RINGS)
    free = BLADE.groove_distance
    approach = (result.ball_force / BLADE.series_stiffness) ** (2 / 3)
    assert result.displacement < free * (1 - math.sin(BLADE.contact_angle)) + approach


def test_tension_mirrors_compression_and_no_load_stays():
    result = axial_expansion(BLADE, [-1e6, 0.0, 1e6], RINGS, rings="thick")
    assert result.displacement[0] == -result.displacement[2]
    assert result.displacement[1] == 0
    assert np.isfinite(result.contact_angle).all()


def test_nonsense_is_refused():
    with pytest.raises(InputError, match="outer_outside"):
        dataclasses.replace(RINGS, outer_outside=1.9)
    with pytest.raises(InputError, match="clearance"):
        axial_expansion(dataclasses.replace(BLADE, clearance=1e-5), 1e5, RINGS)
    with pytest.raises(InputError, match="axial_force"):
        axial_expansion(BLADE, np.nan, RINGS)
    with pytest.raises(InputError, match="flexible"):
        axial_expansion(BLADE, 1e5, RINGS, flexible="all")  # type: ignore[arg-type]
