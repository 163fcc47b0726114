"""Asperities on a shell that gives way where film and asperities press it."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.journal import (
    Contact,
    Film,
    GasMixture,
    Guembel,
    JournalBearing,
    LocalShell,
    Lubricant,
    ThickShell,
)
from loadflow.journal.film.shell import contact as shell_contact
from loadflow.tribology import AsperityContact, hertz_line

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
ROUGH = Contact(AsperityContact(roughness=5e-7, contact_modulus=115e9, factor=1e-3), friction=0.1)
FILM = Film(
    Lubricant(0.03), GasMixture(5e4), edge_pressure=1.5e5, contact=ROUGH, grid=(192, 8),
    grading="uniform", inlet=None, shell=LocalShell(1e-13),
)  # fmt: skip
FORCE, SPEED = np.array([4e4, 5e3]), 0.3
TILT = np.array([2e-6, 1e-6])
TIGHT = {"tolerance": 1e-11}
NAMES = ("eccentricity_ratio", "minimum_film", "contact_share", "friction_power")


def test_a_stiff_shell_is_a_rigid_one():
    rigid = BEARING.equilibrium(FORCE, SPEED, replace(FILM, shell=None), tilt=TILT, **TIGHT)
    off = []
    for compliance in (1e-17, 1e-18):
        stiff = replace(FILM, shell=LocalShell(compliance))
        state = BEARING.equilibrium(FORCE, SPEED, stiff, tilt=TILT, **TIGHT)
        off.append([float(getattr(state, n) / getattr(rigid, n)) - 1.0 for n in NAMES])
    assert 0.05 < float(rigid.contact_share) < 0.5
    np.testing.assert_allclose(off[1], 0.0, atol=2e-4)
    # what is left falls with the compliance, but for nodes between cells: theirs is that of cells
    np.testing.assert_allclose(off[1], 0.1 * np.array(off[0]), atol=1e-4)


def test_load_of_a_smooth_shaft_on_a_standing_elastic_foundation():
    """p = δ/C over the overlap: F = R B c/C (ε (θ₀ + sin 2θ₀/2) − 2 sin θ₀), cos θ₀ = 1/ε."""
    compliance, ratio = 1e-11, 1.2
    smooth = replace(ROUGH, asperities=replace(ROUGH.asperities, roughness=2e-8))
    film = replace(FILM, shell=LocalShell(compliance), contact=smooth)
    end = np.arccos(1.0 / ratio)
    shape = ratio * (end + 0.5 * np.sin(2 * end)) - 2.0 * np.sin(end)
    force = BEARING.radius * BEARING.width * BEARING.clearance / compliance * shape
    state = BEARING.equilibrium((force, 0.0), 0.0, film)
    # asperities are lifted by some roughness, 2e-4 c each
    assert float(state.eccentricity_ratio) == pytest.approx(ratio, abs=1e-3)
    deepest = (ratio - 1.0) * BEARING.clearance
    assert float(state.contact_pressure) == pytest.approx(deepest / compliance, rel=5e-3)
    assert float(state.shell_deformation) == pytest.approx(deepest, rel=5e-3)


@pytest.mark.parametrize("law", [GasMixture(5e4), Guembel()], ids=lambda law: law.kind)
def test_position_to_load_and_back(law):
    film = replace(FILM, cavitation=law)
    state = BEARING.equilibrium(FORCE, SPEED, film, tilt=TILT, **TIGHT)
    field = BEARING.pressure(state.eccentricity, SPEED, film, tilt=TILT, **TIGHT)
    np.testing.assert_allclose(field.force, FORCE, rtol=1e-6, atol=1e-6 * FORCE[0])
    back = BEARING.equilibrium(field.force, SPEED, film, tilt=TILT, **TIGHT)
    np.testing.assert_allclose(back.eccentricity, state.eccentricity, rtol=1e-6)


def test_stiffness_is_the_slope_of_the_load():
    state = BEARING.equilibrium(FORCE, SPEED, FILM, tilt=TILT, **TIGHT)
    assert 0.001 < float(state.contact_share) < 0.6
    way = np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    force = BEARING.pressure(
        state.eccentricity + 1e-10 * way, SPEED, FILM, tilt=TILT, **TIGHT
    ).force
    slopes = np.stack([force[0] - force[1], force[2] - force[3]], axis=-1) / 2e-10
    known = state.stiffness[:2, :2]
    np.testing.assert_allclose(known, slopes, atol=3e-5 * np.abs(known).max())


def test_damping_is_the_lag_behind_a_load_that_grows_slowly():
    film = replace(FILM, cavitation=Guembel())  # damping is that of a fill that stays
    rate, time = np.array([2.0, -1.0]), np.linspace(0.0, 20.0, 41)
    force = FORCE + np.outer(time - time[-1], rate)
    path = BEARING.orbit(time, force, SPEED, film, tolerance=1e-12)
    still = BEARING.equilibrium(FORCE, SPEED, film, tolerance=1e-12)
    moving = np.gradient(path.eccentricity.values, time, axis=0)[-1]
    lag = still.eccentricity - path.eccentricity.values[-1]
    behind = np.linalg.solve(still.stiffness, still.damping @ moving)
    np.testing.assert_allclose(lag, behind, atol=0.002 * np.abs(behind).max())


def test_a_yielding_shell_spreads_the_contact():
    """Softer: the film carries more of the load, at less pressure and friction."""
    states = [
        BEARING.equilibrium(FORCE, SPEED, replace(FILM, shell=LocalShell(c)), **TIGHT)
        for c in (1e-15, 1e-14, 1e-13)
    ]
    for name in ("contact_share", "maximum_pressure", "friction_power"):
        values = [float(getattr(state, name)) for state in states]
        assert values == sorted(values, reverse=True), name
    assert float(states[-1].eccentricity_ratio) > 1.0 > float(states[0].eccentricity_ratio)


def test_a_stop_ends_on_the_yielding_asperities():
    time = np.linspace(0.0, 1.0, 41)
    speed = 10.0 * np.clip(1.0 - time / 0.5, 0.0, None)
    path = BEARING.orbit(time, np.tile(FORCE, (41, 1)), speed, FILM)
    assert float(path.contact_share[0]) < 1e-3
    assert np.all(np.diff(path.contact_share.values[21:]) > 0)
    still = BEARING.equilibrium(FORCE, 0.0, FILM)
    assert float(still.contact_share) == pytest.approx(1.0, abs=1e-6)
    assert float(still.minimum_film) < float(path.minimum_film[-1])


THICK = ThickShell(outer_diameter=0.3, modulus=2e10)
AROUND = replace(FILM, grid=(48, 8), shell=THICK)


def test_contact_presses_a_shell_open_around():
    """From a rigid shell to one that carries the load on its film alone."""
    states = [
        BEARING.equilibrium(FORCE, SPEED, replace(AROUND, shell=shell), **TIGHT)
        for shell in (None, replace(THICK, modulus=2e15), replace(THICK, modulus=2e11), THICK)
    ]
    share = [float(state.contact_share) for state in states]
    assert share[1] == pytest.approx(share[0], rel=1e-3)
    assert share[1] > 1.3 * share[2] > 3.0 * share[3] > 0.01
    still = BEARING.equilibrium(FORCE, 0.0, AROUND)
    assert float(still.contact_share) == pytest.approx(1.0, abs=1e-6)
    assert float(still.shell_deformation) > 0.05 * BEARING.clearance


@pytest.mark.slow
def test_a_shell_whose_growth_is_not_found_is_no_answer(monkeypatch):
    monkeypatch.setattr(shell_contact, "_STEPS", 1)
    coarse = replace(AROUND, grid=(36, 6))
    assert not BEARING.equilibrium(FORCE, SPEED, coarse, strict=False).converged
    monkeypatch.undo()
    assert BEARING.equilibrium(FORCE, SPEED, coarse, strict=False).converged


@pytest.mark.slow
@pytest.mark.parametrize("tilt", [{}, {"tilt": TILT}])
def test_stiffness_of_a_shell_pressed_open_around(tilt):
    state = BEARING.equilibrium(FORCE, SPEED, AROUND, **TIGHT, **tilt)
    way = 1e-10 * np.array([[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
    places = np.asarray(state.eccentricity) + way
    force = np.array(BEARING.pressure(places, SPEED, AROUND, **TIGHT, **tilt).force)
    np.testing.assert_allclose(force[0], FORCE, rtol=1e-6, atol=1e-6 * FORCE[0])
    slopes = np.stack([force[1] - force[2], force[3] - force[4]], axis=-1) / 2e-10
    known = np.asarray(state.stiffness)[:2, :2]
    np.testing.assert_allclose(known, slopes, atol=1e-6 * np.abs(known).max())


@pytest.mark.slow
def test_damping_of_a_shell_pressed_open_around():
    film = replace(AROUND, grid=(36, 6), cavitation=Guembel())
    rate, time = np.array([2.0, -1.0]), np.linspace(0.0, 20.0, 11)
    force = FORCE + np.outer(time - time[-1], rate)
    path = BEARING.orbit(time, force, SPEED, film, tolerance=1e-11)
    still = BEARING.equilibrium(FORCE, SPEED, film, tolerance=1e-11)
    moving = np.gradient(path.eccentricity.values, time, axis=0)[-1]
    behind = np.linalg.solve(still.stiffness, still.damping @ moving)
    lag = still.eccentricity - path.eccentricity.values[-1]
    np.testing.assert_allclose(lag, behind, atol=0.002 * np.abs(behind).max())


def test_a_standing_shaft_on_what_its_bodies_give_has_the_pressure_of_hertz():
    """Line contact of radius R/ψ; the pressure of asperities is found the same on any cells."""
    line = float(
        hertz_line(BEARING.relative_clearance / BEARING.radius, 0.0, length=0.1, force=2e4).pressure
    )
    shell = LocalShell.conformal(2e5, BEARING.diameter, BEARING.relative_clearance)
    smooth = replace(ROUGH, asperities=replace(ROUGH.asperities, roughness=5e-8))
    film = replace(FILM, shell=shell, contact=smooth)
    fine, coarse = (
        float(BEARING.equilibrium((2e4, 0.0), 0.0, replace(film, grid=grid)).contact_pressure)
        for grid in ((384, 8), (48, 8))
    )
    assert fine == pytest.approx(line, rel=0.01)
    assert coarse == pytest.approx(fine, rel=1e-3)


def test_the_pressure_under_a_tilted_shaft_that_stands_goes_to_one_as_cells_are_halved():
    """In a rigid bore oil and asperities at one edge have pressures far above all strengths."""
    shell = LocalShell.conformal(4e5, BEARING.diameter, BEARING.relative_clearance)
    time = np.linspace(0.0, 20.0, 401)
    force = np.tile([4e4, 5e3], (time.size, 1))
    speed = 5.0 * np.maximum(1.0 - time, 0.0)
    largest = {}
    for around in (120, 240, 480):
        film = replace(FILM, grid=(around, 8), rung="reduced", shell=shell)
        path = BEARING.orbit(time, force, speed, film, tilt=np.tile(10 * TILT, (time.size, 1)))
        stands = path.isel(time=speed == 0.0)
        largest[around] = [float(stands[n].max()) for n in ("maximum_pressure", "contact_pressure")]
    first, second = (np.abs(np.subtract(largest[n], largest[2 * n])) for n in (120, 240))
    assert (second < 0.25 * first).all()
    np.testing.assert_allclose(largest[480], largest[240], rtol=2e-3)
    assert max(largest[480]) < 15e6  # rigid, the same has 36 and 96 MPa
