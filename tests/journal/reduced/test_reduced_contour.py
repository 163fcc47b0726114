"""Contours of the bore on the rung "reduced" against the grid, and against closed forms."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Contact,
    Contour,
    Crown,
    Film,
    GasMixture,
    Groove,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    Recess,
    Reynolds,
    Sommerfeld,
    Supply,
    ThickShell,
    TiltingPads,
)
from loadflow.journal.line import Line
from loadflow.journal.models.composed.model import build
from loadflow.journal.models.composed.uneven import Thickness
from loadflow.tribology import AsperityContact

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
CLEARANCE, SPEED, LOAD = 1e-4, 60.0, np.array([6e3, -2.5e4])
FILM = Film(Lubricant(0.03), GasMixture(5e4), 1.5e5, grid=(144, 48), inlet=None, grading="uniform")
ANGLE = np.linspace(0.0, 2.0 * np.pi, 145)[:-1]
RUBBED = np.maximum(np.cos(ANGLE + 1.2), 0.0) ** 4  # about where the load presses
WORN = Contour(ANGLE, 3e-5 * RUBBED)
OVAL = Contour(ANGLE, 1e-5 * (1.0 - np.cos(2.0 * ANGLE)))
Z = np.linspace(-0.05, 0.05, 11)
SKEW = Contour(ANGLE, 2e-5 * RUBBED[:, None] * (1.0 + Z / 0.05), Z)
ROUGH = Contact(AsperityContact(roughness=1e-6, contact_modulus=1e11, factor=1e-3))
FED = Supply((Groove(1.57, arc=0.3, length=0.05, pressure=2e5),))
MOST = {
    "eccentricity_ratio": 1.5e-3,
    "minimum_film": 5e-3,
    "maximum_pressure": 8e-3,
    "friction_power": 2e-3,
}


def bearing(*relief, **more):
    return JournalBearing(**SIZE, relief=relief, **more)


def pair(**words):
    """Film on few points across, and on the grid."""
    return replace(FILM, rung="reduced", **words), replace(FILM, **words)


def check(few, fine, most=MOST):
    for name, part in most.items():
        scale = np.abs(np.asarray(getattr(fine, name)))
        assert np.max(np.abs(getattr(few, name) - getattr(fine, name))) <= part * scale.max(), name


CASES = {
    "worn": (WORN, {}, {}),
    "oval": (OVAL, {}, {}),
    "worn at one end": (SKEW, {}, {}),
    "tilt": (WORN, {}, {"tilt": (5e-5, 1e-4)}),
    "reynolds": (WORN, {"cavitation": Reynolds()}, {}),
    "local shell": (WORN, {"shell": LocalShell(4e-12)}, {}),
    "thick shell": (WORN, {"shell": ThickShell(0.3, 2.1e11)}, {}),
    "supply": (WORN, {"supply": FED}, {}),
}


@pytest.mark.parametrize("case", CASES)
def test_a_film_in_a_contour_is_that_of_the_grid(case, alone):
    contour, words, line = CASES[case]
    bore = bearing(contour)
    few, fine = (bore.equilibrium(LOAD, SPEED, film, **line) for film in pair(**words))
    check(few, fine)
    for name in ("stiffness", "damping"):
        scale = np.abs(getattr(fine, name)).max()
        np.testing.assert_allclose(getattr(few, name), getattr(fine, name), atol=0.02 * scale)
    plain = bearing().equilibrium(LOAD, SPEED, pair(**words)[0], **line)
    assert abs(few.eccentricity_ratio / plain.eccentricity_ratio - 1.0) > 0.02  # it matters


@pytest.mark.parametrize(("contact", "speed"), [(None, 3.0), (ROUGH, 0.03), (ROUGH, 0.0)])
def test_a_shaft_lies_in_wear_that_is_deeper_than_its_film(contact, speed, alone):
    few, fine = (bearing(WORN).equilibrium(LOAD, speed, film) for film in pair(contact=contact))
    assert float(few.eccentricity_ratio) > 1.15
    assert 4.0 * few.minimum_film < 3e-5
    # between rough surfaces the mean gap stays, which either rung seeks between its own places
    thin = 0.02 if contact else 0.005
    check(
        few, fine, MOST | {"minimum_film": thin, "maximum_pressure": 0.03, "friction_power": 0.02}
    )
    if contact is not None:
        assert few.contact_share == pytest.approx(fine.contact_share, rel=0.02)


@pytest.mark.parametrize("words", [{}, {"periodic": True}, {"step": "adaptive"}])
def test_a_path_in_a_worn_bore_is_that_of_the_grid(words):
    time = np.linspace(0.0, 2.0 * np.pi / 60.0, 41)
    force = LOAD + 1.5e4 * np.stack([np.sin(60.0 * time), np.cos(60.0 * time)], axis=1)
    few, fine = (
        bearing(WORN).orbit(time, force, SPEED, replace(film, grid=(72, 48)), **words)
        for film in pair()
    )
    check(few, fine, MOST | {"minimum_film": 0.015, "maximum_pressure": 0.02})


def test_a_contour_that_is_a_shift_of_the_bore_is_the_round_bore_there():
    shift = 0.2 * CLEARANCE
    place = 0.5 * CLEARANCE * np.array([0.6, -0.8])
    moved = bearing(Contour(ANGLE, shift * np.cos(ANGLE)))  # it takes that off the position
    film = pair(grid=(144, 24))[0]
    there = moved.pressure(place + np.array([shift, 0.0]), SPEED, film)
    here = bearing().pressure(place, SPEED, film)
    np.testing.assert_allclose(there.force, here.force, rtol=2e-3)
    assert float(there.minimum_film) == pytest.approx(float(here.minimum_film), rel=1e-3)


def test_the_error_falls_with_the_square_of_the_cells():
    """A full film, whose force has no kink, in a contour that is as fine as its cells."""
    forces = []
    for cells in (24, 48, 96):
        angle = np.linspace(0.0, 2.0 * np.pi, 8 * cells + 1)[:-1]
        oval = Contour(angle, 1e-5 * (1.0 - np.cos(2.0 * angle)))
        film = pair(cavitation=Sommerfeld(), grid=(cells, 20))[0]
        forces.append(np.hypot(*bearing(oval).pressure((6e-5, 2e-5), SPEED, film).force))
    order = np.log2((forces[0] - forces[1]) / (forces[1] - forces[2]))
    assert abs(order - 2.0) < 0.15


def test_stiffness_is_the_slope_of_the_force(alone):
    film = pair()[0]
    state = bearing(SKEW).equilibrium(LOAD, SPEED, film, tolerance=1e-12)
    here, step = np.asarray(state.eccentricity), 1e-4 * state.minimum_film

    def force(place):
        return bearing(SKEW).pressure(place, SPEED, film, tolerance=1e-12).force

    np.testing.assert_allclose(force(here), LOAD, rtol=1e-6)
    for axis, way in enumerate(step * np.eye(2)):
        slope = (force(here + way) - force(here - way)) / (2.0 * step)
        scale = np.abs(state.stiffness[:2, :2]).max()
        np.testing.assert_allclose(slope, state.stiffness[:2, axis], atol=1e-5 * scale)


def test_the_narrowest_gap_of_a_contour_knows_growth_by_heat():
    """Where a shaft may begin is asked by it."""
    film, grown = pair()[0], 0.1
    z = np.array([0.0, 0.25, 0.5])
    cells = np.ones((film.grid[0], z.size))
    speed, place, bend = np.array([SPEED]), np.array([[0.5, -0.2, 0.0, 0.0]]), np.zeros((1, 2))
    for bore in (bearing(WORN), bearing(Crown(1e-5, 0.03), WORN)):
        cold, warm = (
            build(bore, film, speed, Line(), viscosity=told).least(place, bend)
            for told in (None, Thickness(z, cells, growth=grown * cells))
        )
        np.testing.assert_allclose(warm, cold + grown, rtol=1e-12)


def test_a_crown_and_lobes_go_with_a_contour(alone):
    crowned = bearing(Crown(1e-5, 0.03), WORN)
    lobed = bearing(OVAL, shape=Lobes(3, preload=0.3))
    for bore in (crowned, lobed):
        few, fine = (bore.equilibrium(0.5 * LOAD, SPEED, film) for film in pair())
        check(few, fine, MOST | {"minimum_film": 0.01, "maximum_pressure": 0.015})


def test_what_it_does_not_go_with_is_named():
    film, time = pair()[0], np.linspace(0.0, 0.01, 3)
    with pytest.raises(InputError, match="a recess in the bore"):
        bearing(Recess(3.0, 0.3, depth=1e-5)).equilibrium(LOAD, SPEED, film)
    pads = bearing(OVAL, shape=TiltingPads(4, 1.2))
    with pytest.raises(InputError, match="alike all around for pads in motion"):
        pads.orbit(time, np.tile(LOAD, (3, 1)), SPEED, film)


def test_grooves_between_lobes_feed_what_a_contour_opens_at_the_bearing_ends():
    """Beside the error of the cells, which a crown has that opens both sides of a groove alike."""
    off = []
    for relief in (Crown(4e-5, 0.02), Contour((0.0, 1.571, 3.142, 4.712), (0.0, 3e-5, 0.0, 1e-5))):
        bearing = JournalBearing(**SIZE, shape=Lobes(2, preload=0.4, angle=0.2), relief=(relief,))
        few, fine = (
            bearing.equilibrium((2e4, 3e3), 100.0, replace(FILM, grid=(144, 40), rung=rung))
            for rung in ("reduced", "grid")
        )
        off.append(float(few.supply_flow / fine.supply_flow))
    assert off[1] == pytest.approx(off[0], rel=1e-3)
