"""Temperatures across the film: exact films between parallel walls, limits, balance, the ladder."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import solve_banded

from loadflow.journal import Arc, Film, FilmHeat, JournalBearing, MassConserving, Sommerfeld
from loadflow.journal.film.heat.surface_temperatures import Surfaces
from loadflow.tribology import ExponentialOil
from loadflow.validation.film_heat import ladder_bearing

STEEPNESS, VISCOSITY, CONDUCTIVITY = 0.0341, 0.0277, 0.14
OIL = ExponentialOil(
    reference_viscosity=VISCOSITY,
    constant_steepness=STEEPNESS,
    constant_conductivity=CONDUCTIVITY,
)
COLD = OIL.reference_temperature
GAP = np.array([100e-6])
HELD = 1e9  # W/(m² K): as good as a given temperature


def sheared(nahme, into_shaft):
    """Rise midway and at the shaft, times the steepness, and stress over that of the cold film."""
    heat = FilmHeat(
        OIL, COLD, points=3, shell_transfer=HELD, shell_temperature=COLD,
        shaft_transfer=into_shaft, shaft_temperature=COLD,
    )  # fmt: skip
    surfaces = Surfaces.of(heat, GAP)
    power = nahme * CONDUCTIVITY / (STEEPNESS * GAP)  # of the cold film, W/m²
    mean = np.array([COLD])
    for _ in range(200):  # heat that is made, and that passes into both walls
        stress = surfaces.viscosity(heat, VISCOSITY, mean, COLD)[0].shear
        unit = HELD * (surfaces.shell.mean) + into_shaft * surfaces.shaft.mean
        rest = HELD * (surfaces.shell.at(0 * mean, COLD) - COLD)
        rest += into_shaft * (surfaces.shaft.at(0 * mean, COLD) - COLD)
        mean = mean + 0.3 * ((power * stress - rest) / unit - mean)
    low, high = surfaces.shell.at(mean, COLD), surfaces.shaft.at(mean, COLD)
    middle = 0.25 * (6 * mean - low - high)
    return [float(x[0]) for x in (STEEPNESS * (middle - COLD), STEEPNESS * (high - COLD), stress)]


@pytest.mark.parametrize(
    ("nahme", "rise", "stress", "off"),
    [
        (0.1, 0.012423, 0.991749, (0.005, 1e-4)),
        (1.0, 0.117783, 0.924196, (0.02, 5e-4)),
        (10.0, 0.810930, 0.573879, (0.11, 0.02)),
    ],
)
def test_a_film_between_cold_walls_is_that_of_nahme(nahme, rise, stress, off):
    """[Nahme 1940], closed form, and what three points are off; one would leave the stress at 1."""
    found = sheared(nahme, HELD)
    assert found[0] == pytest.approx(rise, rel=off[0])
    assert found[2] == pytest.approx(stress, rel=off[1])


@pytest.mark.parametrize(
    ("nahme", "rise", "stress", "off"),
    [
        (0.1, 0.048790, 0.967945, (0.01, 5e-4)),
        (1.0, 0.405465, 0.760346, (0.06, 0.012)),
        (10.0, 1.791759, 0.281983, (0.12, 0.13)),
    ],
)
def test_a_film_beside_an_insulated_shaft_is_that_of_the_closed_form(nahme, rise, stress, off):
    found = sheared(nahme, 0.0)
    assert found[1] == pytest.approx(rise, rel=off[0])
    assert found[2] == pytest.approx(stress, rel=off[1])


WARM = FilmHeat(
    ExponentialOil(
        reference_viscosity=0.01901574,
        reference_temperature=322.9833,
        constant_steepness=0.0300690,
        reference_density=854.952,
        constant_specific_heat=1951.50,
        constant_conductivity=0.15,
    ),
    inlet_temperature=323.0,
    carry_over=0.8,
)
FILM = Film(None, MassConserving(), edge_pressure=100.0, grid=(60, 12), heat=WARM)
LOAD, SPEED = (112814.907, 0.0), 94.24778


def solved(**changes):
    film = replace(FILM, heat=replace(WARM, **changes))
    return ladder_bearing().equilibrium(LOAD, SPEED, film)


def test_without_conduction_three_points_are_one():
    one, three = solved(), solved(points=3)
    for name in ("eccentricity_ratio", "friction_power", "maximum_temperature", "side_flow"):
        np.testing.assert_allclose(getattr(three, name), getattr(one, name), rtol=1e-8)
    np.testing.assert_allclose(three.surface_temperature, three.film_temperature, rtol=1e-9)


@pytest.mark.parametrize("points", [3, 4])
@pytest.mark.parametrize("shaft", [{}, {"shaft_temperature": 330.0}])
def test_all_heat_is_accounted_for(shaft, points):
    state = solved(
        points=points, shell_transfer=300.0, shell_temperature=325.9, shaft_transfer=1e6, **shaft
    )
    assert state.heat_imbalance < 1e-8
    assert state.heat_conducted > 0.05 * state.friction_power


def entering(length, out, into, shaft):
    """Temperatures above those of entering oil, of a sheared film marched along 2000 steps of 100
    cells across: mean of the film and its shell's surface at the end.
    """
    heavy, speed, gap, cells, steps = 860.0 * 1951.8, 10.471976, float(GAP[0]), 100, 2000
    high, step = gap / cells, length / steps
    velocity = speed * (np.arange(cells) + 0.5) / cells
    made = VISCOSITY * speed**2 / gap**2 * high
    each = heavy * velocity * high / step
    bands = np.zeros((3, cells))
    bands[0, 1:] = bands[2, :-1] = -CONDUCTIVITY / high
    bands[1] = each + 2.0 * CONDUCTIVITY / high
    for row, transfer in ((0, out), (-1, into)):
        bands[1, row] -= CONDUCTIVITY / high
        bands[1, row] += 1.0 / (1.0 / transfer + 0.5 * high / CONDUCTIVITY) if transfer else 0.0
    warm = shaft / (1.0 / into + 0.5 * high / CONDUCTIVITY)
    t = np.zeros(cells)
    for _ in range(steps):
        rhs = each * t + made
        rhs[-1] += warm
        t = solve_banded((1, 1), bands, rhs)
    through = out * t[0] / (1.0 + 0.5 * out * high / CONDUCTIVITY)
    return t.mean(), t[0] - 0.5 * high * through / CONDUCTIVITY


@pytest.mark.parametrize("length", [0.1, 0.4])
@pytest.mark.parametrize(("out", "shaft"), [(0.0, 20.0), (1e3, -10.0), (0.0, 0.0)])
def test_heat_of_the_surfaces_takes_its_way_into_the_film(length, out, shaft):
    """A cubic follows the entry of a film between a shaft held warm or cold and its shell."""
    oil = ExponentialOil(
        reference_viscosity=VISCOSITY,
        constant_steepness=0.0,
        reference_density=860.0,
        constant_specific_heat=1951.8,
        constant_conductivity=CONDUCTIVITY,
    )
    cold, radius = oil.reference_temperature, 0.5
    bearing = JournalBearing(2 * radius, 0.1, float(GAP[0]) / radius, shape=Arc(0, length / radius))
    known, off = np.array(entering(length, out, 1e6, shaft)), []
    for points in (3, 4):
        heat = FilmHeat(
            oil, cold, carry_over=0.0, points=points, shell_transfer=out, shell_temperature=cold,
            shaft_transfer=1e6, shaft_temperature=cold + shaft,
        )  # fmt: skip
        film = Film(None, Sommerfeld(), heat=heat, grid=(100, 2))
        field = bearing.pressure((0.0, 0.0), 10.471976 / radius, film)
        got = np.array([x[-1, 0] for x in (field.film_temperature, field.surface_temperature)])
        off.append(np.abs(got - cold - known).max())
    largest = np.abs([shaft, *known]).max()
    assert off[1] < (0.1 if length < 0.2 else 0.015) * largest
    assert off[1] < 0.4 * off[0] or shaft == 0.0


def test_heat_across_the_film_raises_the_ladder_by_a_rung():
    """ROSS, full film with pad and shaft: ε 0.627, 8181 W, 71.9 °C, shaft 63.7 °C."""
    state = solved(points=3, shell_transfer=332.5, shell_temperature=325.942, shaft_transfer=1e6)
    assert state.converged
    assert state.eccentricity_ratio == pytest.approx(0.627, abs=0.02)
    assert state.friction_power == pytest.approx(8181.1, rel=0.05)
    assert state.maximum_temperature - 273.15 == pytest.approx(71.87, abs=2.0)
    assert state.shaft_temperature - 273.15 == pytest.approx(63.72, abs=0.5)
    assert np.degrees(state.attitude_angle) == pytest.approx(44.368, abs=0.5)
