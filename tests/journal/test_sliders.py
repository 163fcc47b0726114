"""Steps and parabolas of the gap against exact mass-conserving films."""

import numpy as np
import pytest

from loadflow.journal import (
    Arc,
    Groove,
    JournalBearing,
    Lubricant,
    MassConserving,
    Recess,
    Reynolds,
    Supply,
)
from loadflow.validation._journal_shapes import (
    PARABOLA,
    parabolic_slider,
    pocket_errors,
    pocket_slider,
)


def test_pressure_and_flux_over_steps_converge_with_first_order():
    """Upwind fill and a rupture that falls on a cell edge: order 1, over steps as well."""
    errors = np.array([pocket_errors(cells) for cells in (50, 100, 200, 400)])
    orders = np.log2(errors[:-1] / errors[1:])
    np.testing.assert_allclose(orders, 1.0, atol=0.1)
    assert errors[0, 0] < 0.01  # of the peak; the published scheme has 0.0089
    assert errors[0, 1] < 3.1e-4


def test_rupture_and_reformation_of_the_parabola_are_found_to_the_cell():
    cells = np.array([100, 200, 400, 800])
    found = [parabolic_slider(n) for n in cells]
    for place in ("rupture", "reformation"):
        errors = np.array([abs(f[place] - PARABOLA[place]) for f in found])
        assert np.all(errors * cells < 76.2e-3)  # within one cell: first order
    loads = np.array([abs(f["load"] / PARABOLA["load"] - 1) for f in found])
    assert np.polyfit(np.log2(cells), np.log2(loads), 1)[0] < -1.0
    assert loads[0] < 5e-4


def test_the_flux_of_a_slider_is_conserved_to_rounding():
    field = pocket_slider(100)
    assert field.residual < 1e-10
    assert field.supply_flow == pytest.approx(field.side_flow, rel=1e-6, abs=1e-15)


def test_rayleigh_step_is_exact():
    """A step bearing between lands of constant gap: its pressure is linear on both sides."""
    inner, outer, length, split = 2.0, 1.0, 0.02, 0.7
    gap, viscosity = 1e-5, 0.02
    recess = Recess(0.5 * split * length, split * length, (inner - outer) * gap)
    bearing = JournalBearing(2.0, 500.0, gap, shape=Arc(0.5 * length, length), relief=(recess,))
    field = bearing.pressure((0.0, 0.0), 3.0, Lubricant(viscosity), cavitation=Reynolds(),
                             grid=(40, 2))  # fmt: skip
    high, low = (inner * gap) ** 3 / split, (outer * gap) ** 3 / (1 - split)
    peak = 6 * viscosity * 3.0 * length * (inner - outer) * gap / (high + low)
    x = field.angle / length
    exact = np.where(x < split, x / split, (1 - x) / (1 - split)) * peak
    np.testing.assert_allclose(field.pressure[:, 0], exact, rtol=1e-6)


def test_a_step_across_the_axis_carries_flow_in_series():
    """Poiseuille flow over a step of the gap along the axis, fed by a line in the middle."""
    # a deep recess round the middle: nearly all of the pressure falls over the lands
    bearing = JournalBearing(1.0, 0.8, 1e-3, relief=(Recess(0.0, 2 * np.pi, 5e-3, length=0.4),))
    supply = Supply((Groove(0.0, arc=0.2, length=0.4, pressure=1e6),))
    field = bearing.pressure((0.0, 0.0), 0.0, Lubricant(0.05), cavitation=MassConserving(),
                             supply=supply, grid=(40, 32))  # fmt: skip
    inside = np.abs(field.z) < 0.2
    opposite = np.argmin(np.abs((field.angle - np.pi) % (2 * np.pi)))
    assert field.pressure[opposite, inside].min() > 0.97e6
    expected = 2 * 2 * np.pi * 0.5 * (0.5e-3) ** 3 / (12 * 0.05) * 1e6 / 0.2
    assert field.side_flow == pytest.approx(expected, rel=0.02)
