"""Films that are solved in one compiled loop against the same films solved part by part."""

from __future__ import annotations

import numpy as np
import pytest

from loadflow.journal import (
    ConstantFlow,
    Contact,
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
    Turbulence,
)
from loadflow.journal.film.rigid_cylinder import as_cylinder
from loadflow.journal.line import Line
from loadflow.journal.solvers import newton
from loadflow.journal.solvers.statics import Statics
from loadflow.tribology import AsperityContact

BEARING = JournalBearing(diameter=0.2, width=0.12, relative_clearance=1e-3)
FORCE, SPEED, OIL, GRID = (6e4, 1e4), 20.0, Lubricant(0.05), (36, 8)
EDGE = 1e5
GROOVE = Supply((Groove(angle=2.0, arc=0.4, length=0.06, pressure=3e5),))
LAWS = [GasMixture(5e3), Sommerfeld(), Guembel(), Reynolds(), MassConserving()]
FILMS = [Film(OIL, law, EDGE, grid=GRID) for law in LAWS]
FILMS += [Film(OIL, law, EDGE, supply=GROOVE, grid=GRID) for law in LAWS]


def both(monkeypatch, ask):
    """What `ask` gives with the loop, which takes every film of it, and part by part."""
    taken = []
    monkeypatch.setattr(
        newton, "as_cylinder", lambda film: taken.append(as_cylinder(film)) or taken[-1]
    )
    whole = ask()
    assert taken
    assert all(one is not None for one in taken)
    monkeypatch.setattr(newton, "as_cylinder", lambda film: None)
    return whole, ask()


def named(film):
    return f"{film.law.kind}{'-supplied' if film.supply else ''}"


@pytest.mark.parametrize("film", FILMS, ids=named)
def test_the_loop_stands_where_the_parts_do(monkeypatch, film):
    one, other = both(monkeypatch, lambda: BEARING.equilibrium(FORCE, SPEED, film))
    # both end at the rounding of the residual, K and C at that of one factorisation
    for name in ("eccentricity", "stiffness", "damping", "maximum_pressure", "side_flow"):
        expected = np.asarray(getattr(other, name))
        limit = 1e-9 * np.abs(expected).max()
        np.testing.assert_allclose(getattr(one, name), expected, rtol=0, atol=limit, err_msg=name)
    assert one.iterations == other.iterations


@pytest.mark.parametrize("film", FILMS[::2], ids=named)
def test_the_loop_goes_where_the_parts_go(monkeypatch, film):
    time = np.linspace(0.0, 0.4, 9)
    force = np.array(FORCE) * (1.0 + 0.3 * np.sin(9.0 * time))[:, None]
    one, other = both(monkeypatch, lambda: BEARING.orbit(time, force, SPEED, film))
    for name in ("eccentricity", "maximum_pressure", "total_fill"):
        expected = other[name].values
        limit = 1e-9 * np.abs(expected).max()
        np.testing.assert_allclose(one[name], expected, rtol=0, atol=limit, err_msg=name)


@pytest.mark.parametrize("film", FILMS[:5], ids=named)
def test_a_film_at_a_given_position_and_velocity_is_the_same(monkeypatch, film):
    def ask():
        place, velocity = (4e-5, 2e-5), (1e-4, -2e-4)
        return BEARING.pressure(place, SPEED, film, velocity=velocity)

    one, other = both(monkeypatch, ask)
    limit = 1e-9 * np.abs(other.pressure).max()
    np.testing.assert_allclose(one.pressure, other.pressure, rtol=0, atol=limit)


def test_a_load_alone_and_among_others_has_the_same_bits():
    film = FILMS[0]
    alone = BEARING.equilibrium(FORCE, SPEED, film)
    far = np.array([FORCE, (-1e3, 9e4), FORCE])
    again = BEARING.equilibrium(far, SPEED, film)
    np.testing.assert_array_equal(again.stiffness[0], alone.stiffness)
    np.testing.assert_array_equal(again.eccentricity[2], again.eccentricity[0])


def test_a_film_with_more_to_it_is_solved_part_by_part():
    rough = Contact(AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3))
    pump = ConstantFlow(1e-5)
    fed = Supply((Groove(angle=2.0, arc=0.4, length=0.06, restrictor=pump),))
    plain = Film(OIL, GasMixture(5e3), EDGE, grid=GRID)
    more = [
        Film(OIL, GasMixture(5e3), EDGE, contact=rough, grid=GRID),
        Film(OIL, GasMixture(5e3), EDGE, turbulence=Turbulence(), grid=GRID),
        Film(OIL, GasMixture(5e3), EDGE, supply=fed, grid=GRID),
        Film(Lubricant(0.05, pressure_coefficient=2e-8), GasMixture(5e3), EDGE, grid=GRID),
    ]
    assert as_cylinder(Statics(BEARING, plain, Line.of(()), SPEED).film) is not None
    for film in more:
        statics = Statics(BEARING, film, Line.of(()), SPEED)
        statics.film.set_speed(SPEED)
        assert as_cylinder(statics.film) is None, film
    tilted = Line.of((), tilt=(1e-5, 0.0))
    assert as_cylinder(Statics(BEARING, plain, tilted, SPEED).film) is None
