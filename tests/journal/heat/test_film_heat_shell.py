"""Heat over the area of a film in an elastic shell, with asperities too, at rest and in motion."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import (
    Contact,
    Film,
    FilmHeat,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    RingGrowth,
    ThickShell,
)
from loadflow.journal.cavitation import GasMixture
from loadflow.journal.line import Line
from loadflow.journal.solvers.newton import solve_film
from loadflow.journal.solvers.statics import Statics
from loadflow.journal.solvers.warm.position import energy_of
from loadflow.numerics.convergence import Limits
from loadflow.tribology import AsperityContact, ExponentialOil

LOBES = JournalBearing(0.2, 0.1, 1e-3, shape=Lobes(2))
LOAD, SPEED, SLOW = np.array([5e4, 3e3]), 100.0, 2.0
LINING, THICK = LocalShell(2e-12), ThickShell(outer_diameter=0.3, modulus=7e10)
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)
COOLED = FilmHeat("iso-vg-68", shell_transfer=1000.0, shell_temperature=313.15)
EVEN = ExponentialOil(reference_viscosity=0.03, reference_density=870.0)


def film(shell, heat=COOLED, law=None, **more):
    more = {"edge_pressure": 1e5, "grid": (36, 8)} | more
    return Film(None, law or GasMixture(5e4), heat=heat, shell=shell, **more)


@pytest.mark.parametrize("shell", [LINING, THICK])
@pytest.mark.parametrize("contact", [None, ROUGH])
def test_with_one_viscosity_film_and_shell_are_the_isothermal_ones(shell, contact):
    speed = SLOW if contact else SPEED
    warm = LOBES.equilibrium(LOAD, speed, film(shell, replace(COOLED, oil=EVEN), contact=contact))
    isothermal = Film(
        Lubricant(0.03), GasMixture(5e4), 1e5, grid=(36, 8), shell=shell, contact=contact
    )
    cold = LOBES.equilibrium(LOAD, speed, isothermal)
    for name in ("eccentricity", "minimum_film", "shell_deformation", "stiffness", "damping"):
        expected = getattr(cold, name)
        scale = np.abs(expected).max()
        np.testing.assert_allclose(getattr(warm, name), expected, rtol=1e-6, atol=1e-7 * scale)


@pytest.mark.parametrize("shell", [LINING, THICK])
@pytest.mark.parametrize("law", [MassConserving(), GasMixture(5e4)])
def test_the_heat_that_leaves_is_the_friction_and_the_shell_cools_the_film(shell, law):
    soft = LOBES.equilibrium(LOAD, SPEED, film(shell, law=law))
    rigid = LOBES.equilibrium(LOAD, SPEED, film(None, law=law))
    assert soft.converged
    assert soft.heat_imbalance < 1e-8
    left = soft.heat_carried + soft.heat_conducted
    assert left == pytest.approx(float(soft.friction_power), rel=1e-8)
    assert soft.shell_deformation > 0.5e-6
    assert soft.maximum_pressure < rigid.maximum_pressure


def test_a_stiff_shell_is_the_rigid_one():
    stiff = LOBES.equilibrium(LOAD, SPEED, film(LocalShell(1e-18)))
    rigid = LOBES.equilibrium(LOAD, SPEED, film(None))
    for name in ("minimum_film", "maximum_temperature", "friction_power", "maximum_pressure"):
        assert getattr(stiff, name) == pytest.approx(float(getattr(rigid, name)), rel=1e-5)


@pytest.mark.parametrize("shell", [LINING, THICK, LocalShell(1e-11)])
@pytest.mark.parametrize("contact", [None, ROUGH])
def test_stiffness_is_the_slope_of_the_force_at_the_temperatures_of_the_film(shell, contact):
    """Central differences, with a viscosity that falls fourfold around and across."""
    options = film(shell, contact=contact)
    statics = Statics(LOBES, options, Line(), SPEED)
    equation, discrete = energy_of(statics), statics.film
    rows = discrete.mesh.z.size
    turn = 1.0 - np.cos(discrete.mesh.angle)
    uneven = 305.0 + 15.0 * turn[:, None] + 2.0 * np.arange(rows)
    equation.thicken(uneven.ravel())
    speed = SLOW if contact else SPEED
    found = statics.solve(0, LOAD, speed, None, Limits(1e-12, 60, True))
    assert found.converged
    step, slopes = 1e-5, np.empty((2, 2))
    for way in range(2):
        ends = []
        for sign in (1, -1):
            place = found.position + sign * step * np.eye(2)[way]
            beside = solve_film(discrete, found.u, place, np.zeros(2), 1e-12, 60)
            assert beside.converged
            ends.append(beside.linear.load)
        slopes[:, way] = (ends[0] - ends[1]) / (2 * step)
    np.testing.assert_allclose(
        found.linear.stiffness, slopes, rtol=1e-5, atol=1e-6 * np.abs(slopes).max()
    )


def test_expansion_of_the_ring_adds_to_what_the_lining_gives():
    growth = RingGrowth(
        0.3, shaft_expansion=0.0, shell_expansion=20e-6, reference_temperature=293.0
    )
    heat = replace(COOLED, oil=replace(EVEN, constant_specific_heat=1e9), shell_transfer=0.0)
    both = LOBES.equilibrium(LOAD, SPEED, film(LINING, replace(heat, growth=growth)))
    wider = replace(LOBES, relative_clearance=1e-3 + 20e-6 * (313.15 - 293.0))
    same = wider.equilibrium(LOAD, SPEED, film(LINING, heat))
    assert both.minimum_film == pytest.approx(float(same.minimum_film), rel=1e-5)
    assert both.shell_deformation == pytest.approx(float(same.shell_deformation), rel=1e-5)
    assert both.thermal_growth.mean() == pytest.approx(0.1 * 20e-6 * 20.15, rel=1e-3)


@pytest.mark.parametrize("shell", [LINING, THICK])
def test_a_shaft_comes_to_rest_where_the_warm_film_in_its_shell_carries_it(shell):
    time = np.append(np.linspace(0.0, 0.2, 9), np.linspace(0.3, 1.0, 6))
    options = film(shell)
    path = LOBES.orbit(time, np.tile(LOAD, (time.size, 1)), SPEED, options, start=(1e-5, 1e-5))
    rest, last = LOBES.equilibrium(LOAD, SPEED, options), path.isel(time=-1)
    for name in ("minimum_film", "shell_deformation", "friction_power", "maximum_pressure"):
        assert float(last[name]) == pytest.approx(float(getattr(rest, name)), rel=1e-3)
    assert path.attrs["heat_imbalance"] < 1e-8


@pytest.mark.parametrize(
    ("speed", "contact", "more"),
    [
        pytest.param(SLOW, ROUGH, {}, marks=pytest.mark.slow),
        (10.0, ROUGH.as_rough(0.5), {"points": 3, "growth": RingGrowth(0.3)}),
    ],
)
def test_a_closed_path_of_all_together_closes(speed, contact, more):
    """Shell and asperities; with growth and three points across where these hardly rub."""
    time = np.linspace(0.0, 2 * np.pi / speed, 9)
    loads = LOAD + np.outer(np.cos(speed * time), (1e4, 0.0))
    loads[-1] = loads[0]
    options = film(LINING, replace(COOLED, **more), contact=contact)
    path = LOBES.orbit(time, loads, speed, options, periodic=True)
    assert path.attrs["closure"] < 1e-6
    assert path.attrs["heat_imbalance"] < 1e-8
    assert float(path.contact_share.max()) > 0.0
    assert float(path.shell_deformation.min()) > 1e-6
