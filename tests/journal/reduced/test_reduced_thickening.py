"""Viscosity that rises with pressure on the rung "reduced" against the grid, and against itself."""

from dataclasses import replace

import numpy as np
import pytest
from test_thickening import BARUS, BEARING, LAWS, LOAD, RISE, ROELANDS, SPEED

from loadflow.journal import (
    Contact,
    Film,
    GasMixture,
    Groove,
    Lobes,
    LocalShell,
    Sommerfeld,
    Supply,
)
from loadflow.tribology import AsperityContact

FILM = Film(BARUS, GasMixture(5e4), 1e5, inlet=None, grid=(96, 32), grading="uniform")
FED = Supply((Groove(2.0, arc=0.3, length=0.05, pressure=3e5),))
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=1e11, factor=1e-3))
MOST = {
    "eccentricity_ratio": 5e-4,
    "minimum_film": 1.5e-3,
    "maximum_pressure": 5e-3,
    "friction_power": 1e-3,
}


def pair(**words):
    """Film on few points across, and on the grid."""
    return replace(FILM, rung="reduced", **words), replace(FILM, **words)


def check(few, fine, most=MOST):
    for name, part in most.items():
        scale = np.abs(np.asarray(getattr(fine, name)))
        assert np.max(np.abs(getattr(few, name) - getattr(fine, name))) <= part * scale.max(), name


CASES = [
    *({"cavitation": law} for law in LAWS),
    {"lubricant": ROELANDS},
    {"shell": LocalShell(3e-13)},
    {"contact": ROUGH},
    {"supply": FED},
]


def named(case):
    return str(next(iter(case.values())))[:16]


@pytest.mark.parametrize("case", CASES, ids=named)
def test_a_film_that_pressure_thickens_is_that_of_the_grid(case, alone):
    few, fine = (BEARING.equilibrium(LOAD, SPEED, film) for film in pair(**case))
    assert RISE * few.maximum_pressure > 0.3
    check(few, fine)
    for name in ("stiffness", "damping"):
        scale = np.abs(getattr(fine, name)).max()
        np.testing.assert_allclose(getattr(few, name), getattr(fine, name), atol=0.02 * scale)


@pytest.mark.parametrize("case", CASES[1:], ids=named)
def test_films_many_times_as_thick_as_without_pressure_are_found(case, alone):
    """Newton's method does not find them from the closed form: they follow from thinner ones."""
    few, fine = (BEARING.equilibrium(3.0 * LOAD, SPEED, film) for film in pair(**case))
    assert few.converged
    assert few.maximum_pressure > (0.8 if "shell" in case else 2.0) / RISE
    check(
        few, fine, MOST | {"minimum_film": 4e-3, "maximum_pressure": 0.015, "friction_power": 3e-3}
    )


@pytest.mark.parametrize("case", CASES[3:6], ids=named)
def test_stiffness_and_damping_are_differences_of_the_force(case):
    film = pair(**case)[0]
    state = BEARING.equilibrium(LOAD, SPEED, film, tolerance=1e-12)
    here, step = np.asarray(state.eccentricity), 1e-4 * state.minimum_film

    def force(place, velocity=(0.0, 0.0)):
        given = place, SPEED, film
        return BEARING.pressure(*given, velocity=velocity, tolerance=1e-12).force

    np.testing.assert_allclose(force(here), LOAD, atol=1e-6 * np.hypot(*LOAD))
    ways = step * np.eye(2)
    stiffness = [(force(here + way) - force(here - way)) / (2 * step) for way in ways]
    damping = [(force(here, way) - force(here, -way)) / (2 * step) for way in ways]
    for found, wanted in ((stiffness, state.stiffness), (damping, state.damping)):
        np.testing.assert_allclose(np.transpose(found), wanted, atol=1e-5 * np.abs(wanted).max())


def test_the_error_falls_with_the_square_of_the_cells():
    """A full film, whose force has no kink."""
    place = 0.8 * BEARING.clearance * np.array([np.cos(0.3), np.sin(0.3)])
    films = [pair(cavitation=Sommerfeld(), grid=(n, 20))[0] for n in (24, 48, 96)]
    forces = [np.hypot(*BEARING.pressure(place, SPEED, film).force) for film in films]
    order = np.log2((forces[0] - forces[1]) / (forces[1] - forces[2]))
    assert abs(order - 2.0) < 0.15


@pytest.mark.parametrize("words", [{}, {"periodic": True}, {"step": "adaptive"}])
def test_a_path_is_that_of_the_grid(words):
    turn = 2.0 * np.pi / 60.0
    time = np.linspace(0.0, turn if "periodic" in words else 0.078, 40)
    force = LOAD + 4e4 * np.stack([np.sin(60.0 * time), np.cos(60.0 * time)], axis=1)
    few, fine = (
        BEARING.orbit(time, force, SPEED, replace(film, grid=(72, 24)), **words) for film in pair()
    )
    assert RISE * float(few.maximum_pressure.max()) > 0.4
    check(few, fine, MOST | {"minimum_film": 4e-3, "maximum_pressure": 0.012})


def test_lobes_and_a_tilted_shaft_are_those_of_the_grid(alone):
    lobed = replace(BEARING, shape=Lobes(2, preload=0.3))
    few, fine = (lobed.equilibrium(LOAD, SPEED, film, tilt=(5e-5, 1e-4)) for film in pair())
    check(few, fine, MOST | {"minimum_film": 0.01, "maximum_pressure": 0.015})


def test_without_pressure_on_it_the_film_is_that_of_one_viscosity():
    hardly, never = (
        BEARING.equilibrium(
            LOAD, SPEED, pair(lubricant=replace(BARUS, pressure_coefficient=rise), contact=ROUGH)[0]
        )
        for rise in (1e-15, 0.0)
    )
    for name in MOST:
        assert float(getattr(hardly, name)) == pytest.approx(float(getattr(never, name)), rel=1e-6)
