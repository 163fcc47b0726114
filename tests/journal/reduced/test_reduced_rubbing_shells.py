"""Asperities on shells that give way all over on the rung "reduced" against the grid."""

from dataclasses import replace

import numpy as np
import pytest
from test_reduced_shells import BEARING, FEET, FILM, FLANGE, LOAD, REDUCED, SOFT

from loadflow.journal import Contact, LocalShell, MatrixShell
from loadflow.tribology import AsperityContact

ROUGH = Contact(AsperityContact(roughness=1e-6, contact_modulus=1e11, factor=1e-3))
NAMES = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "contact_share")


def pair(shell, around=72, **words):
    """Film on few points across, and on the grid."""
    few, fine = (replace(film, shell=shell, contact=ROUGH, **words) for film in (REDUCED, FILM))
    return replace(few, grid=(around, 20)), replace(fine, grid=(around, 40))


@pytest.mark.parametrize(
    ("shell", "speed"),
    [
        (FEET, 0.3),
        pytest.param(SOFT, 0.03, marks=pytest.mark.slow),
        pytest.param(FLANGE, 0.3, marks=pytest.mark.slow),
        pytest.param(SOFT, 0.0, marks=pytest.mark.slow),
    ],
    ids=["feet", "thick", "flange", "standing"],
)
def test_a_film_that_rubs_in_a_shell_is_that_of_the_grid(shell, speed, alone):
    few, fine = (BEARING.equilibrium(LOAD, speed, film) for film in pair(shell))
    assert few.contact_share > 0.3
    assert float(few.eccentricity_ratio) > 1.0  # the shell lets the shaft into it
    for name, most in zip(NAMES, (1e-3, 0.06, 0.04, 0.08)):
        assert float(getattr(few, name)) == pytest.approx(float(getattr(fine, name)), rel=most)
    scale = np.abs(fine.stiffness).max()
    np.testing.assert_allclose(few.stiffness, fine.stiffness, atol=0.03 * scale)


@pytest.mark.parametrize("shell", [FEET, pytest.param(FLANGE, marks=pytest.mark.slow)])
def test_at_its_place_it_carries_its_load_and_slopes_are_those_of_the_force(shell, alone):
    film = pair(shell)[0]
    state = BEARING.equilibrium(LOAD, 0.3, film, tolerance=1e-12)
    here, step = np.asarray(state.eccentricity), 1e-3 * state.minimum_film

    def force(place):
        return BEARING.pressure(place, 0.3, film, tolerance=1e-12).force

    np.testing.assert_allclose(force(here), LOAD, rtol=1e-5)
    for axis, way in enumerate(step * np.eye(2)):
        slope = (force(here + way) - force(here - way)) / (2.0 * step)
        scale = np.abs(state.stiffness[:2, :2]).max()
        np.testing.assert_allclose(slope, state.stiffness[:2, axis], atol=3e-4 * scale)


def test_a_matrix_of_local_growth_is_pressed_as_the_local_shell_is(alone):
    """Of the first all growth by asperities is sought, of the second it is tabulated."""
    given = {"grid": (36, 8), "grading": "uniform", "contact": ROUGH}
    local = replace(REDUCED, shell=LocalShell(4e-12), **given)
    matrix = replace(local, shell=MatrixShell(4e-12 * np.eye(36 * 8)))
    states = [BEARING.equilibrium(LOAD, 0.3, film) for film in (matrix, local)]
    assert states[0].contact_share > 0.1
    for name in NAMES:
        one, other = (float(getattr(state, name)) for state in states)
        assert one == pytest.approx(other, rel=1e-6)
    for name in ("stiffness", "damping"):
        one, other = (getattr(state, name) for state in states)
        np.testing.assert_allclose(one, other, rtol=1e-6)


@pytest.mark.slow
def test_a_path_that_rubs_is_that_of_the_grid():
    time = 5e-3 * np.arange(30)
    force = LOAD + 1.2e4 * np.stack([np.sin(40.0 * time), np.cos(40.0 * time)], axis=1)
    few, fine = (BEARING.orbit(time, force, 0.6, film) for film in pair(FEET))
    assert float(few.contact_pressure.max()) > 1e6
    for name, most in zip(NAMES[:3], (2e-3, 0.05, 0.06)):
        scale = np.abs(fine[name]).max()
        assert float(np.abs(few[name] - fine[name]).max()) <= most * scale
