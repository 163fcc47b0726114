"""The rung "reduced" with oil under pressure between the lobes or pads of a bore."""

import math

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Arc,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Supply,
    TiltingPads,
)
from loadflow.journal.line import Line
from loadflow.journal.models.composed.model import build, unknowns_on

FORCE, SPEED, BETWEEN = (4e4, 1e4), 60.0, 3e5
FILM = Film(Lubricant(0.03), MassConserving(), edge_pressure=1e5, grid=(72, 16))
RUNGS = "reduced", "grid"
AREA = {"lubricant": None, "heat": FilmHeat("iso-vg-68", inlet_temperature=313.15)}


def lobed(pressure=BETWEEN):
    shape = Lobes(3, preload=0.3, groove=0.3, groove_pressure=pressure)
    return JournalBearing(diameter=0.5, width=0.35, relative_clearance=1e-3, shape=shape)


def padded(pressure=BETWEEN):
    shape = TiltingPads(4, arc=math.radians(75), preload=0.3, offset=0.55, groove_pressure=pressure)
    return JournalBearing(diameter=0.5, width=0.35, relative_clearance=1e-3, shape=shape)


def on(rung, **changes):
    return Film(**(vars(FILM) | changes | {"rung": rung}))


@pytest.mark.parametrize(
    ("film", "line"),
    [
        ({}, {}),
        ({"cavitation": GasMixture(5e4)}, {"tilt": (1e-4, -5e-5)}),
        ({"cavitation": GasMixture(5e4), "shell": LocalShell(1e-11)}, {}),
        ({}, {"moment": (200.0, 300.0)}),
        (AREA, {}),
    ],
    ids=["law that conserves mass", "tilt", "local shell", "moment", "heat over the area"],
)
def test_it_presses_the_film_as_on_the_grid(film, line):
    ours, theirs = (lobed().equilibrium(FORCE, SPEED, on(r, **film), **line) for r in RUNGS)
    for name, share in (("eccentricity_ratio", 0.01), ("minimum_film", 0.005),
                        ("maximum_pressure", 0.01), ("friction_power", 0.003),
                        ("supply_flow", 0.08)):  # fmt: skip
        np.testing.assert_allclose(getattr(ours, name), getattr(theirs, name), share, err_msg=name)
    size = np.abs(theirs.stiffness).max()
    np.testing.assert_allclose(ours.stiffness, theirs.stiffness, atol=0.02 * size)
    # it is no small matter: the shaft lies elsewhere than in oil at the pressure of the ends
    without = lobed(None).equilibrium(FORCE, SPEED, on("reduced", **film), **line)
    assert abs(without.eccentricity_ratio / ours.eccentricity_ratio - 1.0) > 0.05


def test_what_it_feeds_leaves_at_the_ends():
    """At ends at the cavitation pressure next to nothing is drawn in."""
    film = on("reduced", edge_pressure=0.0, grid=(60, 16))
    state = lobed().equilibrium(FORCE, SPEED, film)
    assert state.side_flow > 0.0
    assert state.supply_flow == pytest.approx(state.side_flow, rel=0.01)


def test_pads_in_motion_are_those_of_the_grid():
    time = np.arange(31) * 0.01
    force = np.stack([4e4 * (1 + 0.3 * np.sin(20 * time)), 1e4 * np.cos(20 * time)], axis=1)
    speed = np.full(time.size, SPEED)
    ours, theirs = (padded().orbit(time, force, speed, on(rung)) for rung in RUNGS)
    for name, share in (("eccentricity_ratio", 0.002), ("minimum_film", 0.001),
                        ("maximum_pressure", 0.01), ("friction_power", 0.002),
                        ("supply_flow", 0.04)):  # fmt: skip
        np.testing.assert_allclose(ours[name], theirs[name], share, err_msg=name)
    without = padded(None).orbit(time, force, speed, on("reduced"))
    assert np.abs(without.minimum_film / ours.minimum_film - 1.0).max() > 0.02


def test_it_stays_on_further_points_across():
    """A polynomial from there to the bearing end would lower it between the points."""
    given = lobed(), on("reduced"), np.array([SPEED]), Line.of(())
    few, many = (build(*given, level) for level in range(2))
    np.testing.assert_allclose(unknowns_on(few.cold(), few, many), many.cold(), rtol=1e-12)


def test_a_pressure_below_that_of_cavitation_is_refused_by_name():
    with pytest.raises(InputError, match="not below the cavitation pressure"):
        lobed(2e4).equilibrium(FORCE, SPEED, on("reduced", cavitation=MassConserving(5e4)))


@pytest.mark.parametrize("rung", RUNGS)
def test_a_groove_between_segments_names_it(rung):
    fed = Supply((Groove(angle=math.pi / 3, arc=0.2, pressure=2e5),))
    with pytest.raises(InputError, match=r"grooves\[0\].angle .* shape.groove_pressure"):
        lobed(None).equilibrium(FORCE, SPEED, on(rung, supply=fed))


def test_oil_beside_an_arc_at_a_pressure_of_its_own_is_refused_by_its_key():
    arc = Arc(angle=0.0, span=3.0, groove_pressure=3e5)
    bearing = JournalBearing(0.5, 0.35, 1e-3, shape=arc)
    with pytest.raises(InputError, match=r'shape.groove_pressure = 300000.0 .* rung = "grid"'):
        bearing.equilibrium(FORCE, SPEED, on("reduced"))
    assert bearing.equilibrium(FORCE, SPEED, on("grid")).converged
