"""Grooves of a supply in shaped bores on the rung "reduced" against the grid with the same ones."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Arc,
    Crown,
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lobes,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
    TiltingPads,
)

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
SPEED, LOAD = 100.0, np.array([6e3, 1e3])
TWO = Supply(tuple(Groove(angle, arc=0.3, length=0.05, pressure=2e5) for angle in (2.4, -2.0)))
FILM = Film(Lubricant(0.03), GasMixture(5e4), 1e5, TWO, inlet=None, grid=(96, 40))
REDUCED = replace(FILM, rung="reduced")
LEMON = JournalBearing(**SIZE, shape=Lobes(2, preload=0.5, angle=0.2))
BORES = {
    "lemon": LEMON,
    "three lobes": JournalBearing(**SIZE, shape=Lobes(3, preload=0.3, angle=0.1)),
    "arc": JournalBearing(**SIZE, shape=Arc(0.2, 5.0)),
    "crown": JournalBearing(**SIZE, relief=(Crown(2e-5, 0.02),)),
}
LAWS = (GasMixture(5e4), MassConserving(), Reynolds(), Guembel(), Sommerfeld())
NAMES = ("minimum_film", "maximum_pressure", "friction_power", "side_flow", "supply_flow")
UNIT = LEMON.clearance / LEMON.radius


def apart(one, other):
    return np.array([float(getattr(one, name) / getattr(other, name) - 1.0) for name in NAMES])


def both(bearing, line=None, **words):
    found = [
        bearing.equilibrium(LOAD, SPEED, replace(film, **words), **line or {})
        for film in (REDUCED, FILM)
    ]
    assert all(one.converged for one in found)
    return found


@pytest.mark.parametrize("bore", BORES)
@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_fed_films_of_every_law_and_bore_are_those_of_the_grid(bore, law):
    few, fine = both(BORES[bore], cavitation=law)
    assert (np.abs(apart(few, fine)) < (0.0025, 0.006, 0.002, 0.01, 0.015)).all()
    for name in ("stiffness", "damping"):
        scale = np.abs(getattr(fine, name)).max()
        np.testing.assert_allclose(getattr(few, name), getattr(fine, name), atol=0.015 * scale)


@pytest.mark.parametrize("line", [{"tilt": (0.3 * UNIT, 0.1 * UNIT)}, {"moment": (10.0, 5.0)}])
def test_fed_lobes_go_with_a_shaft_that_tilts(line):
    few, fine = both(LEMON, line)
    assert (np.abs(apart(few, fine)) < (0.008, 0.01, 0.003, 0.015, 0.02)).all()


def test_a_position_carries_the_load_of_the_equilibrium_there():
    few, fine = both(LEMON)
    given = few.eccentricity, SPEED
    there = LEMON.pressure(*given, REDUCED)
    np.testing.assert_allclose(there.force, LOAD, rtol=1e-6)
    other = LEMON.pressure(*given, FILM)
    assert np.hypot(*(there.force - other.force)) < 0.01 * np.hypot(*LOAD)
    assert float(there.maximum_pressure) == pytest.approx(float(fine.maximum_pressure), rel=0.005)


@pytest.mark.parametrize(
    ("bore", "steps"),
    [("lemon", {}), ("lemon", {"periodic": True}), ("three lobes", {"step": "adaptive"})],
    ids=["given", "closed", "adaptive"],
)
def test_paths_in_fed_lobes_are_those_of_the_grid(bore, steps):
    phase = np.linspace(0.0, 2 * np.pi, 21)
    force = LOAD + np.stack([2e3 * np.cos(phase), 1e3 * np.sin(phase)], axis=-1)
    force[-1] = force[0]
    few, fine = (
        BORES[bore].orbit(phase / SPEED, force, SPEED, replace(film, grid=(72, 24)), **steps)
        for film in (REDUCED, FILM)
    )
    for name, allowed in zip(NAMES, (0.006, 0.008, 0.003, 0.015, 0.025)):
        scale = np.abs(fine[name]).max()
        assert np.abs(few[name] - fine[name]).max() < allowed * scale, name


def test_cells_around_fed_lobes_are_of_second_order():
    bearing = JournalBearing(**SIZE, shape=Lobes(2, preload=0.4, groove=np.pi / 6))
    turn = np.radians(1.0)
    grooves = (Groove(150 * turn, arc=20 * turn, length=0.05, pressure=2e5),)
    film = replace(REDUCED, supply=Supply(grooves), cavitation=Sommerfeld())
    found = [
        bearing.equilibrium(LOAD, SPEED, replace(film, grid=(cells, 8)))
        for cells in (120, 240, 480)
    ]
    orders = {}
    for name in ("minimum_film", "friction_power", "supply_flow"):
        first, second = np.abs(np.diff([float(getattr(one, name)) for one in found]))
        orders[name] = float(np.log2(first / second))
    assert orders["minimum_film"] == pytest.approx(2.0, abs=0.2)
    assert orders["friction_power"] == pytest.approx(2.0, abs=0.2)
    assert orders["supply_flow"] > 1.8


def test_what_fed_segments_do_not_hold_is_refused_by_name():
    over = replace(REDUCED, supply=Supply((Groove(1.9, arc=0.3, length=0.05, pressure=2e5),)))
    with pytest.raises(InputError, match=r'grooves\[0\].angle = 1.9 .* segment .* on rung = "red'):
        LEMON.equilibrium(LOAD, SPEED, over)
    on_a_pad = Groove(np.pi / 2, arc=0.3, length=0.05, pressure=2e5)
    padded = JournalBearing(**SIZE, shape=TiltingPads(4, 1.2))
    fed, time = replace(REDUCED, supply=Supply((on_a_pad,))), np.linspace(0.0, 0.01, 3)
    with pytest.raises(InputError, match=r'shape = .* without pads .* in motion on rung = "red'):
        padded.orbit(time, np.tile(LOAD, (3, 1)), SPEED, fed)
    few, fine = (
        padded.equilibrium(LOAD, SPEED, replace(fed, rung=rung)) for rung in ("reduced", "grid")
    )
    assert few.minimum_film == fine.minimum_film  # at rest pads are of the grid
