"""Sections of a blade that bends both ways: their turn in axes without sweep, and in the flow."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from loadflow.errors import InputError
from loadflow.rotor import RotorOptions
from loadflow.rotor.machine import machine
from loadflow.rotor.structure._kernels import deflection, turned_shapes
from loadflow.turbines import load_turbine

TURBINE = load_turbine("nrel-5mw")


def _motion(twist, pitch=0.2):
    m = machine(TURBINE, RotorOptions(bend_twist=twist))
    shape, motion = np.zeros((17, 3, 4)), np.zeros((17, 8))
    turned_shapes(m, pitch, shape)
    q = np.array([3.0, -0.2, 0.5])
    deflection(m, pitch, shape, q, np.zeros(3), motion)
    return motion, np.einsum("iks,k->is", shape[:, :, 2:], q)


def test_sections_turn_by_the_product_of_both_slopes():
    motion, slopes = _motion(0.5)
    assert np.abs(motion[:, 6]).max() > 1e-4
    assert motion[:, 6] == pytest.approx(0.5 * slopes[:, 0] * slopes[:, 1], rel=1e-12)
    assert not _motion(0.0)[0][:, 6].any()


def test_slopes_are_those_of_the_deflection():
    motion, slopes = _motion(0.0)
    radius = machine(TURBINE, RotorOptions()).radius
    for axis in (0, 1):
        assert np.gradient(motion[:, axis], radius)[5:-1] == pytest.approx(
            slopes[5:-1, axis], rel=0.05
        )


def _sections(slopes):
    # x downwind, z along the span, y to the trailing edge; turned about x: swept in the sense of
    # rotation, about y: bent downwind. A rotation about z lifts the nose.
    return Rotation.from_rotvec(np.stack([slopes[:, 1], slopes[:, 0], 0 * slopes[:, 0]], axis=1))


def test_half_the_product_is_the_turn_in_axes_that_take_the_sweep_out_first():
    motion, slopes = _motion(0.5)
    turn = -_sections(slopes).as_euler("XYZ")[:, 2]
    assert np.abs(turn).max() > 1e-4
    assert motion[:, 6] == pytest.approx(turn, rel=0.01, abs=1e-8)


def test_minus_half_the_product_is_the_turn_that_the_flow_meets():
    # air comes along y, to the trailing edge: its share along the normal of the section lifts
    motion, slopes = _motion(-0.5)
    normal = _sections(slopes).apply([1.0, 0.0, 0.0])
    assert np.abs(normal[:, 1]).max() > 1e-4
    assert motion[:, 6] == pytest.approx(-normal[:, 1], rel=0.01, abs=1e-8)


def test_a_factor_out_of_range_is_refused():
    with pytest.raises(InputError, match="bend_twist"):
        RotorOptions(bend_twist=2.0)
