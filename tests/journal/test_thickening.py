"""Viscosity that rises with pressure: closed forms, consistency, and what goes with it."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    ConicalBearing,
    Contact,
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
    ThickShell,
    ThrustBearing,
    Turbulence,
)
from loadflow.tribology import AsperityContact

THIN = Lubricant(0.05)
RISE = 20e-9  # 1/Pa
BARUS = replace(THIN, pressure_coefficient=RISE)
ROELANDS = replace(BARUS, pressure_law="roelands")
SPEED, LOAD = 50.0, np.array([1e5, 2e4])
BEARING = JournalBearing(0.2, 0.1, 1e-3)
PLACE = 0.8 * BEARING.clearance * np.array([np.cos(0.3), np.sin(0.3)])
LAWS = [Sommerfeld(), Guembel(), Reynolds(), MassConserving(), GasMixture(5e4)]
ROUGH = Contact(AsperityContact(roughness=4e-7, contact_modulus=1e11, factor=1e-3))


def film(oil=BARUS, law=None, **more):
    given = {"edge_pressure": 1e5, "inlet": None, "grid": (48, 12), "grading": "uniform"} | more
    return Film(oil, law or GasMixture(5e4), **given)


# --- the liquid -------------------------------------------------------------------------------


@pytest.mark.parametrize("oil", [BARUS, ROELANDS])
@pytest.mark.parametrize("pressure", [1e6, 5e7, 2e8])
def test_what_drives_the_flow_is_the_integral_of_the_fluidity(oil, pressure):
    whole, _ = quad(lambda p: 1.0 / float(oil.thickening(p)), 0.0, pressure, epsrel=1e-12)
    assert float(oil.driving(np.array(pressure))) == pytest.approx(whole, rel=1e-9)


def test_both_laws_rise_alike_from_no_pressure():
    for oil in (BARUS, ROELANDS):
        rise = (float(oil.thickening(1e4)) - 1.0) / 1e4
        assert rise == pytest.approx(RISE, rel=3e-4)
    assert float(BARUS.thickening(1e8)) == pytest.approx(np.exp(2.0))
    assert 1.0 < float(ROELANDS.thickening(1e8)) < np.exp(2.0)
    assert BARUS.thickening(-1e8) == 1.0  # oil that is pulled is as thin as without pressure


@pytest.mark.parametrize("given", [{"pressure_coefficient": -1e-9}, {"pressure_law": "other"}])
def test_a_liquid_that_is_none_is_named(given):
    with pytest.raises(InputError, match=next(iter(given))):
        Lubricant(0.05, **given)


# --- closed forms -----------------------------------------------------------------------------


@pytest.mark.parametrize("law", [Guembel(), Reynolds()])
def test_the_film_of_barus_is_that_of_one_viscosity_bent(law):
    """Grubin's q = (1 − exp(−αp))/α obeys the equation of one viscosity."""
    even, thick = (
        BEARING.pressure(PLACE, SPEED, film(oil, law, edge_pressure=0.0)) for oil in (THIN, BARUS)
    )
    bent = -np.log(1.0 - RISE * np.maximum(even.pressure, 0.0)) / RISE
    assert RISE * bent.max() > 0.3
    np.testing.assert_allclose(thick.pressure, bent, atol=1e-9 * bent.max())


def test_friction_is_the_shear_and_flow_of_the_liquid_in_every_cell():
    around = 480
    state = BEARING.pressure(PLACE, SPEED, film(BARUS, Reynolds(), grid=(around, 12)))
    thin = BEARING.pressure(PLACE, SPEED, film(THIN, Reynolds(), grid=(around, 12)))
    radius, c = BEARING.radius, BEARING.clearance
    gap = c - PLACE @ np.array([np.cos(state.angle), np.sin(state.angle)])
    cells = 2 * np.pi * radius / around * BEARING.width / 12
    pressure = state.pressure[:, 6:] if state.pressure.shape[1] == 12 else state.pressure
    shear = 0.05 * np.exp(RISE * pressure) * (SPEED * radius) ** 2 / gap[:, None] * cells
    assert state.friction_power > 1.02 * thin.friction_power
    slope = (np.roll(pressure, -1, 0) - np.roll(pressure, 1, 0)) / (4 * np.pi * radius / around)
    along = gap[:, None] ** 3 / (12 * 0.05 * np.exp(RISE * pressure)) * slope**2 * cells
    ways = np.full(6, BEARING.width / 12)  # between the cells, and to the bearing end
    ways[-1] *= 0.5
    falls = np.diff(np.column_stack([pressure, np.full(around, 1e5)]), axis=1) / ways
    wide = ways / ways[0] * cells
    across = gap[:, None] ** 3 / (12 * 0.05 * np.exp(RISE * pressure)) * falls**2 * wide
    whole = 2 * (shear + along + across).sum()
    assert state.friction_power == pytest.approx(whole, rel=0.01)


# --- consistency ------------------------------------------------------------------------------


CASES = [{"law": law} for law in LAWS] + [
    {"oil": ROELANDS},
    {"shell": LocalShell(3e-13)},
    {"shell": ThickShell(0.3, 2.1e11)},
    {"contact": ROUGH},
    {"supply": Supply((Groove(2.0, arc=0.3, length=0.05, pressure=3e5),))},
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: str(next(iter(case.values())))[:22])
def test_stiffness_and_damping_are_differences_of_the_force(case):
    asked = film(**case)
    state = BEARING.equilibrium(LOAD, SPEED, asked)
    assert RISE * state.maximum_pressure > 0.2
    step = 1e-6 * BEARING.clearance

    def force(place, velocity=(0.0, 0.0)):
        return BEARING.pressure(place, SPEED, asked, velocity=velocity).force

    back = force(state.eccentricity)
    np.testing.assert_allclose(back, LOAD, atol=1e-6 * np.hypot(*LOAD))
    ways = step * np.eye(2)
    stiffness = [(force(state.eccentricity + w) - force(state.eccentricity - w)) for w in ways]
    np.testing.assert_allclose(
        state.stiffness,
        np.transpose(stiffness) / (2 * step),
        atol=3e-5 * abs(state.stiffness).max(),
    )
    if asked.shell is not None:  # its squeeze is no part of a film at a given velocity
        return
    ways *= 10.0
    damping = [force(state.eccentricity, w) - force(state.eccentricity, -w) for w in ways]
    np.testing.assert_allclose(
        state.damping, np.transpose(damping) / (20 * step), atol=3e-5 * abs(state.damping).max()
    )


def test_the_shaft_keeps_a_thicker_film_than_at_one_viscosity():
    thin, thick = (BEARING.equilibrium(LOAD, SPEED, film(oil)) for oil in (THIN, BARUS))
    assert 1.03 < thick.minimum_film / thin.minimum_film < 1.2
    assert thick.maximum_pressure > thin.maximum_pressure


def test_without_a_coefficient_nothing_changes():
    thin, even = (
        BEARING.equilibrium(LOAD, SPEED, film(oil)) for oil in (THIN, replace(THIN, density=870.0))
    )
    assert thin.eccentricity.tolist() == even.eccentricity.tolist()


def test_the_error_falls_with_the_square_of_the_cells():
    """A full film, whose force has no kink."""
    forces = [
        np.hypot(*BEARING.pressure(PLACE, SPEED, film(law=Sommerfeld(), grid=(n, n // 3))).force)
        for n in (24, 48, 96)
    ]
    order = np.log2((forces[0] - forces[1]) / (forces[1] - forces[2]))
    assert abs(order - 2.0) < 0.15


def test_a_path_under_a_constant_load_ends_at_rest():
    time = np.linspace(0.0, 0.6, 61)
    path = BEARING.orbit(time, np.tile(LOAD, (61, 1)), SPEED, film(), start=(2e-5, 0.0))
    rest = BEARING.equilibrium(LOAD, SPEED, film())
    np.testing.assert_allclose(path.eccentricity[-1], rest.eccentricity, rtol=1e-4)
    assert float(path.mass_balance) < 1e-2


def test_tilt_lobes_and_a_pump_go_with_it():
    lobed = JournalBearing(0.2, 0.1, 1e-3, shape=Lobes(2, preload=0.3))
    state = lobed.equilibrium(LOAD, SPEED, film(), moment=(0.0, 200.0))
    assert state.converged
    assert RISE * state.maximum_pressure > 0.1


# --- what it does not know --------------------------------------------------------------------


@pytest.mark.parametrize("rung", ["map", "chart"])
def test_other_rungs_refuse_it_by_name(rung):
    law = None if rung == "chart" else GasMixture(5e4)
    edge = 0.0 if rung == "chart" else 1e5
    with pytest.raises(InputError, match="viscosity that rises with pressure"):
        BEARING.equilibrium(LOAD, SPEED, Film(BARUS, law, edge, rung=rung))


def test_turbulence_pads_and_cones_refuse_it_by_name():
    with pytest.raises(InputError, match="turbulence"):
        BEARING.equilibrium(LOAD, SPEED, film(turbulence=Turbulence()))
    pads = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4)
    with pytest.raises(InputError, match="pressure_coefficient"):
        pads.pressure(1e-4, 10.0, Film(BARUS, Guembel()))
    cone = ConicalBearing(half_angle=0.52, slant=(1.0, 1.5), clearance=1e-4)
    with pytest.raises(InputError, match="pressure_coefficient"):
        cone.pressure((5e-5, 0.0, 0.0), 10.0, Film(BARUS, Guembel(), inlet=None))


def test_a_rigid_film_beyond_barus_is_named():
    with pytest.raises(SolverError, match="times as thick"):
        BEARING.equilibrium((6e5, 0.0), SPEED, film(law=Guembel()))
    state = BEARING.equilibrium((6e5, 0.0), SPEED, film(ROELANDS, Guembel()))
    assert state.converged
