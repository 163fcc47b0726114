"""One description of the film, the same for every verb, and its keywords."""

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Control,
    Film,
    FilmHeat,
    GasMixture,
    Heat,
    JournalBearing,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
    warm_equilibrium,
)

BEARING = JournalBearing(0.2, 0.1, 1e-3)
OIL = Lubricant(0.03)
WORDS = {"cavitation": GasMixture(5e4), "edge_pressure": 1.5e5, "grid": (36, 8)}
FILM = Film(OIL, **WORDS)
LOAD = (8e3, 1e3)


def same(one, other):
    for name, values in vars(one).items():
        if values is not None:
            np.testing.assert_array_equal(values, getattr(other, name), err_msg=name)


def test_a_film_is_what_its_keywords_say():
    same(BEARING.equilibrium(LOAD, 100.0, FILM), BEARING.equilibrium(LOAD, 100.0, OIL, **WORDS))
    place = (3e-5, 1e-5)
    same(BEARING.pressure(place, 100.0, FILM), BEARING.pressure(place, 100.0, OIL, **WORDS))
    time, force = np.linspace(0.0, 0.01, 4), np.tile(LOAD, (4, 1))
    one, other = (
        BEARING.orbit(time, force, 100.0, OIL, **WORDS),
        BEARING.orbit(time, force, 100.0, film=FILM),
    )
    assert one.identical(other)


def test_a_control_is_what_its_keywords_say():
    words = {"tolerance": 1e-30, "max_iterations": 3, "strict": False}  # too few
    one = BEARING.equilibrium(LOAD, 100.0, FILM, control=Control(**words))
    assert not one.converged
    assert one.iterations == BEARING.equilibrium(LOAD, 100.0, FILM, **words).iterations
    fine = BEARING.equilibrium(LOAD, 100.0, FILM)
    same(fine, BEARING.equilibrium(LOAD, 100.0, FILM, control=Control()))


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"film": FILM, "edge_pressure": 1e5}, "edge_pressure: not given with a Film"),
        ({"film": FILM, "lubricant": OIL}, "lubricant: not given with a Film"),
        ({"film": OIL, "lubricant": OIL}, "lubricant: given twice"),
        ({}, "lubricant: not given"),
        ({"film": OIL, "heat": Heat()}, "lubricant: not given with heat"),
        ({"film": FILM, "control": Control(), "strict": False}, "strict: not given with control"),
        ({"film": OIL, "contact": "rough"}, "contact = 'rough' is not allowed: a Contact, or None"),
        (
            {"film": OIL, "cavitation": "guembel"},
            "cavitation = 'guembel' is .*: a law of cavitation",
        ),
        ({"film": OIL, "shell": 0.1}, "shell = 0.1 is not allowed: a shell, such as ThickShell"),
        ({"film": OIL, "supply": 1e5}, "supply = 100000.0 is not allowed: a Supply, or None"),
        ({"film": None, "heat": 313.15}, "heat = 313.15 is not allowed: a Heat, FilmHeat"),
        ({"film": OIL, "grid": 60}, r"grid = 60 is not allowed: cells .* such as \(60, 20\)"),
        ({"film": OIL, "inlet": "auto", "rung": "reduced"}, "'auto'; inlet = None leaves it out"),
        ({"film": 0.05}, r"lubricant = 0.05 is not allowed: a Lubricant, such as Lubricant\(visc"),
        ({"film": FILM, "weights": [1.0]}, "weights = .* without heat"),
    ],
)
def test_what_is_said_twice_or_not_at_all_is_refused(words, message):
    with pytest.raises(InputError, match=message):
        BEARING.equilibrium(LOAD, 100.0, **words)


def test_a_bearing_in_mm_is_refused():
    with pytest.raises(InputError, match="diameter = 1400 is not allowed: 0 … 100, in m"):
        JournalBearing(diameter=1400, width=1300, relative_clearance=1e-3)


def test_a_word_that_is_none_is_a_type_error():
    with pytest.raises(TypeError, match="viscocity"):
        BEARING.equilibrium(LOAD, 100.0, OIL, viscocity=1.0)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"inlet": "narrowest gap"}, "inlet = 'narrowest gap'"),
        ({"grading": "fine"}, "grading = 'fine'"),
        ({"grid": (60, 7)}, r"grid\[1\] = 7"),
        ({"grid": (4, 8)}, r"grid\[0\] = 4"),
        ({"edge_pressure": np.nan}, "edge_pressure = nan"),
        ({"cavitation": MassConserving(2e5), "edge_pressure": 1e5}, "cavitation pressure 200000"),
        ({"cavitation": Reynolds(2e5), "edge_pressure": 1e5}, "cavitation pressure 200000"),
    ],
)
def test_a_film_is_checked_as_it_is_made(words, message):
    with pytest.raises(InputError, match=message):
        Film(OIL, **words)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ({"tolerance": 0.0}, "tolerance = 0.0"),
        ({"tolerance": np.inf}, "tolerance = inf"),
        ({"max_iterations": 0}, "max_iterations = 0"),
    ],
)
def test_a_control_is_checked_as_it_is_made(words, message):
    with pytest.raises(InputError, match=message):
        Control(**words)


def test_heat_is_a_part_of_the_film():
    heat = Heat(inlet_temperature=315.0)
    words = {name: value for name, value in WORDS.items() if name != "grid"} | {"grid": (24, 4)}
    warm = BEARING.equilibrium(LOAD, 100.0, Film(heat=heat, **words))
    assert warm.converged
    assert warm.temperature > 315.0
    assert warm.outlet_temperature == pytest.approx(2 * warm.temperature - 315.0)
    alone = BEARING.equilibrium(LOAD, 100.0, heat.lubricant(warm.temperature), **words)
    assert warm.minimum_film == pytest.approx(alone.minimum_film, rel=1e-6)
    assert warm.friction_power == pytest.approx(alone.friction_power, rel=1e-6)
    with pytest.warns(DeprecationWarning, match="heat=heat"):
        same(warm, warm_equilibrium(BEARING, LOAD, 100.0, heat, **words).film)


def test_heat_is_refused_where_no_model_has_it():
    film = Film(heat=Heat(), **WORDS)
    with pytest.raises(InputError, match="heat = "):
        BEARING.pressure((0.0, 0.0), 100.0, film)
    chart = Film(heat=FilmHeat(), **WORDS | {"rung": "map"})
    with pytest.raises(InputError, match="heat = "):
        BEARING.orbit([0.0, 0.1], [LOAD, LOAD], 100.0, chart)


def test_a_film_may_be_part_of_a_set():
    assert len({Film(OIL), Film(OIL), Film(OIL, shell=LocalShell(1e-12))}) == 2
