"""Where the power of a bearing goes, and how far its film may be trusted."""

import warnings
from dataclasses import fields, replace

import numpy as np
import pytest

from loadflow.errors import InputError, ValidityWarning
from loadflow.journal import (
    ConstantFlow,
    GasMixture,
    Groove,
    JournalBearing,
    Lubricant,
    Reynolds,
    Sommerfeld,
    Supply,
    energy_balance,
    grid_error,
)

BEARING = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
OIL = Lubricant(0.03)


@pytest.mark.parametrize("speed", [0.0, 40.0])
def test_friction_is_what_shaft_and_pump_put_in(speed):
    """(3.34) is the work of the shaft's torque and of the pressure that drives the oil through."""
    pocket = Groove(0.0, arc=0.6, length=0.1, restrictor=ConstantFlow(1e-5))
    errors = []
    for cells in (48, 96):
        film = {"cavitation": Sommerfeld(), "grid": (cells, cells // 4), "edge_pressure": 1e5}
        state = BEARING.equilibrium((8e3, 0.0), speed, OIL, supply=Supply([pocket]), **film)
        pumped = state.supply_flow * (state.groove_pressure[0] - 1e5)
        # torque on the shaft: shear of the film outside the pocket, and the offset of the load
        angle = np.linspace(-np.pi, np.pi, 20001)
        x, y = state.eccentricity / BEARING.clearance
        thin = 1.0 / (1.0 - x * np.cos(angle) - y * np.sin(angle))
        width = np.where(np.abs(angle) < 0.3, 0.1, 0.2)
        drag = 0.03 * (speed * 0.1) ** 2 * 0.1 / BEARING.clearance
        shear = drag * np.trapezoid(thin * width, angle)
        offset = 0.5 * speed * state.eccentricity[1] * 8e3
        errors.append(abs((shear + offset + pumped) / state.friction_power - 1))
    assert errors[1] < 0.01
    assert errors[1] < errors[0] < 0.03


def test_losses_against_the_power_of_the_shaft():
    groove = Groove(np.pi, arc=0.3, length=0.15, pressure=3e5)
    state = BEARING.equilibrium(
        [(8e3, 0.0), (2e4, 0.0)], 60.0, OIL, supply=Supply([groove], tank_pressure=1e5)
    )
    np.testing.assert_allclose(state.supply_power, state.supply_flow * 2e5)
    balance = energy_balance(state, 1e6)
    np.testing.assert_allclose(balance.loss, state.friction_power + state.supply_power)
    np.testing.assert_allclose(balance.efficiency, 1e6 / (1e6 + balance.loss))
    assert energy_balance(state, [0.0, 1e6]).efficiency[0] == 0.0
    with pytest.raises(InputError, match="shaft_power"):
        energy_balance(state, -1.0)


def test_turbulence_is_named_with_its_numbers():
    thin = Lubricant(1e-3)
    for call in (
        lambda: BEARING.equilibrium((8e3, 0.0), 300.0, thin),
        lambda: BEARING.orbit([0.0, 0.1], np.tile([8e3, 0.0], (2, 1)), 300.0, thin),
    ):
        with pytest.warns(ValidityWarning, match=r"Re = 2610 reaches Re_cr = 1306 \(3.14\)"):
            call()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        state = BEARING.equilibrium((8e3, 0.0), 30.0, OIL)
    assert state.laminar
    assert state.critical_reynolds_number == pytest.approx(41.3 / np.sqrt(1e-3))
    assert state.reynolds_number == pytest.approx(870 * 30.0 * 0.1 * 1e-4 / 0.03)


@pytest.mark.parametrize(
    ("law", "edge", "grid", "factors", "names"),
    [
        # errors of second order: three times a difference that is three times as large
        (Reynolds(), 0.0, (60, 20), (4.0, 18.0), ("eccentricity_ratio", "side_flow")),
        # the fill is carried upwind, of first order
        (GasMixture(5e4), 1e5, (60, 20), (1.5, 12.0), ("attitude_angle",)),
    ],
    ids=["reynolds", "mixture"],
)
def test_coarser_grids_bound_the_error_of_the_cells(law, edge, grid, factors, names):
    film = {"cavitation": law, "edge_pressure": edge}
    load = (2e4, 0.0)
    bound = grid_error(BEARING, load, 60.0, OIL, grid=grid, **film)
    found = BEARING.equilibrium(load, 60.0, OIL, grid=grid, **film)
    fine = BEARING.equilibrium(load, 60.0, OIL, grid=(4 * grid[0], 4 * grid[1]), **film)
    for part in fields(bound):
        error = abs(getattr(found, part.name) - getattr(fine, part.name))
        assert error < getattr(bound, part.name), part.name
        if part.name in names:
            low, high = factors
            assert low * error < getattr(bound, part.name) < high * error, part.name


class LostOnCoarseGrids(JournalBearing):
    """A bearing whose second load has no answer on fewer than 60 cells around."""

    def equilibrium(self, force, speed, film, **options):
        state = super().equilibrium(force, speed, film, **options)
        lost = np.array([False, film.cells[0] < 60])
        return replace(state, converged=state.converged & ~lost)


def test_a_grid_error_that_no_coarser_grid_tells_is_infinite():
    bearing = LostOnCoarseGrids(BEARING.diameter, BEARING.width, BEARING.relative_clearance)
    bound = grid_error(bearing, [(2e4, 0.0), (3e4, 0.0)], 60.0, OIL, grid=(60, 8))
    assert 0.0 < bound.minimum_film[0] < 1e-5
    assert bound.minimum_film[1] == np.inf


def test_a_grid_that_cannot_be_halved_is_named():
    with pytest.raises(InputError, match=r"grid\[1\] = 2 .* at least 4 cells across"):
        grid_error(BEARING, (2e4, 0.0), 60.0, OIL, grid=(60, 2))
