"""A shell that gives way beside grooves and pockets on the rung "reduced" against the grid."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import (
    Contact,
    Crown,
    Film,
    GasMixture,
    Groove,
    JournalBearing,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
    Supply,
)
from loadflow.journal.line import Line
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.floating import floating_film
from loadflow.journal.solvers.statics import Statics
from loadflow.tribology import AsperityContact

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
BEARING, SPEED, LOAD = JournalBearing(**SIZE), 60.0, np.array([6e3, -2.5e4])
CROWNED = JournalBearing(**SIZE, relief=(Crown(1e-5, 0.02),))
FED = Supply(
    (
        Groove(1.57, arc=0.3, length=0.05, pressure=3e5),
        Groove(-0.6, arc=0.25, length=0.03, axial=0.01, pressure=6e5),
    )
)
SHELL = LocalShell(5e-12)  # a tenth of the clearance at 2 MPa
FILM = Film(Lubricant(0.03), GasMixture(5e4), 1.5e5, FED, shell=SHELL, grid=(144, 40))
REDUCED = replace(FILM, rung="reduced", grid=(72, 20))
ROUGH = Contact(AsperityContact(roughness=5e-7, contact_modulus=1e11, factor=1e-3))
NAMES = ("eccentricity_ratio", "minimum_film", "maximum_pressure", "friction_power", "supply_flow")


@pytest.mark.parametrize("law", [GasMixture(5e4), Reynolds(), MassConserving()],
                         ids=lambda law: law.kind)  # fmt: skip
@pytest.mark.parametrize("bearing", [BEARING, CROWNED], ids=["plain", "crowned"])
def test_a_fed_film_in_a_shell_is_that_of_a_grid_twice_as_fine(bearing, law, alone):
    few = bearing.equilibrium(LOAD, SPEED, replace(REDUCED, cavitation=law))
    fine = bearing.equilibrium(LOAD, SPEED, replace(FILM, cavitation=law))
    for name, most in zip(NAMES, (0.006, 0.02, 0.01, 0.01, 0.015)):
        assert float(getattr(few, name)) == pytest.approx(float(getattr(fine, name)), rel=most)
    for name in ("stiffness", "damping"):
        scale = np.abs(getattr(fine, name)).max()
        np.testing.assert_allclose(getattr(few, name), getattr(fine, name), atol=0.04 * scale)


@pytest.mark.parametrize("words", [{}, {"contact": ROUGH}], ids=["smooth", "rough"])
def test_a_fed_film_in_a_shell_around_a_tilted_shaft_is_that_of_the_grid(words, alone):
    line = {"tilt": (5e-5, 1e-4)}
    few = BEARING.equilibrium(LOAD, SPEED, replace(REDUCED, **words), **line)
    fine = BEARING.equilibrium(LOAD, SPEED, replace(FILM, **words), **line)
    for name, most in zip(NAMES, (0.004, 0.01, 0.005, 0.005, 0.005)):
        assert float(getattr(few, name)) == pytest.approx(float(getattr(fine, name)), rel=most)
    assert np.allclose(few.moment, fine.moment, atol=0.01 * np.abs(fine.moment).max())


@pytest.mark.parametrize("law", [GasMixture(5e4), MassConserving()], ids=lambda law: law.kind)
def test_a_fed_film_in_a_shell_moves_as_on_the_grid(law):
    time = 1e-3 * np.arange(60)
    force = np.stack([6e3 + 6e3 * np.sin(180 * time), -2.5e4 + 1e4 * np.cos(180 * time)], axis=1)
    few, fine = (
        BEARING.orbit(time, force, np.full(60, SPEED), replace(film, cavitation=law, grid=(72, 20)))
        for film in (REDUCED, FILM)
    )
    for name, most in zip(NAMES, (0.006, 0.02, 0.015, 0.01, 0.03)):
        off = np.abs(few[name] - fine[name]).max() / np.abs(fine[name]).max()
        assert off < most, name


def test_the_gap_where_stretches_of_the_width_meet_is_as_open_as_beside_it():
    """Points of no width there, at which the slope of the pressure bends, know the shell, too."""
    near = replace(REDUCED, supply=Supply((Groove(3.0, arc=0.3, length=0.05, pressure=1.5e5),)))
    fed, alone = (
        CROWNED.equilibrium(LOAD, SPEED, film) for film in (near, replace(near, supply=None))
    )
    assert float(fed.minimum_film) == pytest.approx(float(alone.minimum_film), rel=0.01)


@pytest.mark.parametrize("compliance", [1e-12, 5e-12])
def test_oil_that_is_conserved_finds_its_film_in_a_shell(compliance, alone):
    """From a rigid bore on: at once, first pressures would open the gap too far."""
    film = replace(REDUCED, supply=None, cavitation=MassConserving(), shell=LocalShell(compliance))
    found = BEARING.equilibrium((6e3, -1.5e4), SPEED, film)
    on_grid = BEARING.equilibrium((6e3, -1.5e4), SPEED, replace(film, rung="grid"))
    assert found.converged
    ratios = found.eccentricity_ratio, on_grid.eccentricity_ratio
    assert float(ratios[0]) == pytest.approx(float(ratios[1]), rel=0.003)
    begun = BEARING.orbit([0.0, 1e-3], [(6e3, -1.5e4)] * 2, [SPEED] * 2, film)
    assert float(begun["eccentricity_ratio"][-1]) == pytest.approx(float(ratios[0]), rel=1e-4)


@pytest.mark.parametrize("bearing", [BEARING, CROWNED], ids=["plain", "crowned"])
def test_oil_that_is_conserved_finds_its_film_in_a_shell_on_the_grid(bearing):
    """A shaft that waits for the rupture, which the shell moves all the same, finds none."""
    film = replace(FILM, cavitation=MassConserving())
    found = bearing.equilibrium(np.stack([LOAD, (6e3, -1.5e4)]), np.full(2, SPEED), film)
    assert found.converged.all()
    assert found.iterations.max() < 60


def test_a_rupture_that_moves_by_points_leads_to_a_film_at_once():
    """With a shaft that follows each wrong rupture, 60 Newton steps to and fro led nowhere."""
    around = np.linspace(0.0, 2 * np.pi, 12, endpoint=False)
    force = 6e3 * np.stack([np.cos(around), np.sin(around)], axis=1)
    film = replace(REDUCED, cavitation=MassConserving(), shell=None)
    found = BEARING.equilibrium(force, np.full(12, 100.0), film)
    assert found.converged.all()
    assert found.iterations.max() < 50


def test_a_film_that_ran_away_bends_no_shell_where_the_shaft_is_sought_off_the_bore():
    found = []
    for left in (0.0, np.inf):  # growth of the gaps that the last try has left
        grid = Statics(BEARING, FILM, Line(), SPEED)
        grid.gap.grow(np.full(grid.gap.mesh.shape, left))
        found.append(floating_film(grid.film, grid.gap, LOAD, np.zeros(2), Effort(left=1e9)))
    fresh, after = found
    assert fresh.iterations == after.iterations > 0
    np.testing.assert_array_equal(fresh.u, after.u)
