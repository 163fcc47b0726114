"""Grooves and pockets on the rung "reduced" against the grid with the same ones."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Film,
    GasMixture,
    Groove,
    Guembel,
    Heat,
    JournalBearing,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    Supply,
    Turbulence,
)
from loadflow.journal.models.width_modes import (
    between_stretches,
    half_width_nodes,
    stretched_width,
    whole_width,
)

SIZE = {"diameter": 0.2, "width": 0.1, "relative_clearance": 1e-3}
BEARING, SPEED, LOAD = JournalBearing(**SIZE), 100.0, np.array([6e3, 1e3])
LAWS = (GasMixture(5e4), MassConserving(), Reynolds(), Guembel(), Sommerfeld())
SIDES = (np.pi / 2, -np.pi / 2)
TWO = Supply(tuple(Groove(angle, arc=0.3, length=0.05, pressure=2e5) for angle in SIDES))
FILM = Film(Lubricant(0.03), GasMixture(5e4), 1e5, TWO, inlet=None, grid=(96, 40))
REDUCED = replace(FILM, rung="reduced")
NAMES = ("minimum_film", "maximum_pressure", "friction_power", "side_flow", "supply_flow")
UNIT = BEARING.clearance / BEARING.radius

PLACES = {
    "two long grooves": Supply(
        tuple(Groove(angle, arc=0.4, length=0.08, pressure=3e5) for angle in SIDES)
    ),
    "a line": Supply((Groove(3.0, length=0.06, pressure=2e5),)),
    "two pairs": Supply(
        tuple(Groove(a, arc=0.3, length=0.02, axial=0.025, pressure=2e5) for a in SIDES)
    ),
    "lengths that differ": Supply(
        (Groove(1.6, arc=0.2, length=0.07, pressure=3e5), Groove(3.6, arc=0.3, length=0.03,
                                                                 pressure=2e5))
    ),
    "all round": Supply((Groove(0.0, arc=2 * np.pi, length=0.02, pressure=2e5),)),
}  # fmt: skip


def apart(one, other):
    return np.array([float(one[name] / other[name] - 1.0) for name in NAMES])


def at_rest(film, **line):
    found = BEARING.equilibrium(LOAD, SPEED, film, **line)
    assert found.converged
    return {name: getattr(found, name) for name in (*NAMES, "groove_flow", "stiffness", "damping")}


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_films_of_every_law_are_those_of_the_grid_at_rest(law):
    few = at_rest(replace(REDUCED, cavitation=law))
    fine = at_rest(replace(FILM, cavitation=law))
    assert (np.abs(apart(few, fine)) < (0.002, 0.004, 0.0005, 0.01, 0.02)).all()
    np.testing.assert_allclose(few["groove_flow"].sum(), few["supply_flow"])


@pytest.mark.parametrize("place", PLACES)
def test_grooves_wherever_they_lie_feed_as_those_of_the_grid(place):
    few, fine = (at_rest(replace(film, supply=PLACES[place])) for film in (REDUCED, FILM))
    assert (np.abs(apart(few, fine)) < (0.005, 0.01, 0.003, 0.01, 0.015)).all()
    largest = np.abs(fine["groove_flow"]).max()
    np.testing.assert_allclose(few["groove_flow"], fine["groove_flow"], atol=0.015 * largest)
    scale = np.abs(fine["stiffness"]).max()
    np.testing.assert_allclose(few["stiffness"], fine["stiffness"], atol=0.02 * scale)
    scale = np.abs(fine["damping"]).max()
    np.testing.assert_allclose(few["damping"], fine["damping"], atol=0.02 * scale)


@pytest.mark.parametrize(
    ("words", "line"),
    [
        ({}, {"tilt": (0.3 * UNIT, 0.1 * UNIT)}),
        ({}, {"moment": (10.0, 5.0)}),
        ({"turbulence": Turbulence(begin=0.0, end=0.0)}, {}),
        ({"lubricant": None, "heat": Heat("iso-vg-68")}, {}),
    ],
    ids=["tilt", "moment", "turbulence", "heat"],
)
def test_grooves_go_with_other_effects(words, line):
    few, fine = (at_rest(replace(film, **words), **line) for film in (REDUCED, FILM))
    assert (np.abs(apart(few, fine)) < (0.008, 0.01, 0.003, 0.015, 0.02)).all()


def test_grooves_over_the_whole_width_hold_their_columns():
    """What feeds the bearing ends from their corners has no limit; the film does not feel it."""
    whole = Supply(tuple(Groove(angle, arc=0.3, pressure=1.5e5) for angle in SIDES))
    few, fine = (at_rest(replace(film, supply=whole)) for film in (REDUCED, FILM))
    assert (np.abs(apart(few, fine))[:3] < (0.002, 0.004, 0.0005)).all()


@pytest.mark.parametrize(
    ("law", "periodic"),
    [(GasMixture(5e4), False), (MassConserving(), False), (GasMixture(5e4), True)],
    ids=["gas-mixture", "mass-conserving", "gas-mixture, closed"],
)
def test_paths_beside_grooves_are_those_of_the_grid(law, periodic):
    phase = np.linspace(0.0, 2 * np.pi, 21)
    force = LOAD + np.stack([2e3 * np.cos(phase), 1e3 * np.sin(phase)], axis=-1)
    force[-1] = force[0]
    few, fine = (
        BEARING.orbit(
            phase / SPEED, force, SPEED, replace(film, cavitation=law, grid=(72, 24)),
            periodic=periodic,
        )
        for film in (REDUCED, FILM)
    )  # fmt: skip
    for name, allowed in zip(NAMES, (0.006, 0.008, 0.002, 0.015, 0.025)):
        scale = np.abs(fine[name]).max()
        assert np.abs(few[name] - fine[name]).max() < allowed * scale, name
    assert few.groove_flow.dims == ("time", "groove")
    np.testing.assert_allclose(few.groove_flow.sum("groove"), few.supply_flow)


def test_heat_that_is_stored_scales_the_flow_of_grooves_with_the_oil():
    heat = Heat("iso-vg-68", capacity=4e2, start_temperature=320.0)
    film = replace(REDUCED, lubricant=None, heat=heat)
    time = np.linspace(0.0, 0.2, 81)
    path = BEARING.orbit(time, np.tile(LOAD, (81, 1)), SPEED, film)
    last = heat.lubricant(float(path.temperature[-1]))
    still = at_rest(replace(REDUCED, lubricant=last))
    assert float(path.supply_flow[-1]) == pytest.approx(float(still["supply_flow"]), rel=0.03)
    assert float(path.temperature[-1]) > 320.5


@pytest.mark.parametrize("whole", [False, True])
def test_stretches_without_a_bend_are_polynomials(whole):
    """Integrals and slopes of what any polynomials of their degree hold are exact."""
    nodes = stretched_width(0.5, (0.3, 0.7), (2, 2), whole)
    inner = nodes.slopes.shape[1]
    z = nodes.z / 0.5
    q = 1.0 - z**2 if not whole else (1.0 - z**2) * (1.0 + 0.5 * z)
    slopes = nodes.slopes @ q[:inner]
    exact = -2.0 * z / 0.5
    if whole:
        exact = (-2.0 * z * (1.0 + 0.5 * z) + 0.5 * (1.0 - z**2)) / 0.5
    real = nodes.weights > 1e-9
    np.testing.assert_allclose(slopes[real], exact[real], atol=1e-12)
    np.testing.assert_allclose(slopes[~real], 0.0, atol=1e-6)  # no bend
    share = 2.0 if whole else 1.0
    assert nodes.weights @ q == pytest.approx(share * 0.5 * 2.0 / 3.0, rel=1e-9)
    assert nodes.width == pytest.approx(share * 0.5)


def test_the_slopes_on_both_sides_of_a_bend_make_its_flow():
    nodes = stretched_width(1.0, (0.4,), (2, 2), False)
    inner = nodes.slopes.shape[1]
    q = np.minimum(1.0, (1.0 - nodes.z) / 0.6)[:inner]  # a groove, and a land at its end
    slopes = nodes.slopes @ q
    assert nodes.weights @ slopes**2 == pytest.approx(1.0 / 0.6, rel=1e-12)


@pytest.mark.parametrize("whole", [False, True])
def test_without_marks_stretches_are_the_points_of_the_whole_width(whole):
    one = stretched_width(0.5, (), (3, 2), whole)
    other = whole_width(0.5, 6) if whole else half_width_nodes(0.5, 3)
    for name in ("z", "weights", "slopes", "fine", "below"):
        np.testing.assert_allclose(getattr(one, name), getattr(other, name), atol=1e-12)


@pytest.mark.parametrize("whole", [False, True])
def test_values_at_the_points_of_other_stretches_are_those_of_the_polynomials(whole):
    few, many = (stretched_width(0.5, (0.4,), points, whole) for points in ((2, 3), (3, 6)))
    inner, others = few.slopes.shape[1], many.slopes.shape[1]

    def film(z):  # a groove, and a land at its end
        return np.minimum(1.0, (1.0 - np.abs(z) / 0.5) / 0.6)

    values = between_stretches((0.4,), few, many, whole) @ film(few.z[:inner])
    np.testing.assert_allclose(values, film(many.z[:others]), atol=1e-12)


REFUSED = {
    "circle": (
        {"supply": Supply((Groove(1.0, length=0.05, pressure=2e5, shape="circle"),))},
        r"grooves\[0\].shape",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_few_points_do_not_hold_is_refused_by_name(name):
    words, named = REFUSED[name]
    with pytest.raises(InputError, match=rf'{named} = .* not allowed: .* on rung = "reduced"'):
        BEARING.equilibrium(LOAD, SPEED, replace(REDUCED, **words))
