"""Closed orbits of the rung "reduced" against those of the grid, and against its own long paths."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Contact,
    Crown,
    Film,
    GasMixture,
    Guembel,
    Heat,
    JournalBearing,
    Lobes,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
    Sommerfeld,
    TiltingPads,
)
from loadflow.journal.models.composed import path as composed_path
from loadflow.tribology import AsperityContact

SIZE = {"diameter": 3.0, "width": 2.25, "relative_clearance": 0.5e-3}
BEARING = JournalBearing(**SIZE)
OIL, SPEED = Lubricant(0.05), 1.2
FILM = Film(OIL, GasMixture(5e4), edge_pressure=5e5, grid=(48, 40))
REDUCED = replace(FILM, rung="reduced")
UNIT = BEARING.clearance / BEARING.radius
ROUGH = Contact(AsperityContact(roughness=2e-6, contact_modulus=115e9, factor=1e-3))
NAMES = ("minimum_film", "maximum_pressure", "friction_power")
LAWS = (GasMixture(5e4), MassConserving(), Reynolds(), Guembel(), Sommerfeld())


def load(count, period=2 * np.pi / SPEED):
    time = np.linspace(0.0, period, count + 1)
    turn = 2 * np.pi * time / period
    force = np.stack([2e6 + 5e5 * np.sin(turn), 4e5 * np.cos(2 * turn)], axis=-1)
    force[-1] = force[0]
    return time, force


def closed(film, count=16, bearing=BEARING, **more):
    time, force = load(count)
    rows = {
        name: np.tile(more.pop(name), (time.size, 1))
        for name in ("tilt", "bend", "moment")
        if name in more
    }
    return bearing.orbit(time, force, SPEED, film, **{"periodic": True} | more, **rows)


def extremes(path):
    least, most, mean = (path[name] for name in NAMES)
    return np.array([least.min(), most.max(), mean.mean()])


def law_of(law):
    return replace(REDUCED, cavitation=law, inlet=None, grading="uniform")


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.kind)
def test_closed_orbits_are_those_of_the_grid(law):
    film = law_of(law)
    fine = closed(replace(film, rung="grid"))
    few = closed(film)
    assert np.abs(extremes(few) / extremes(fine) - 1.0).max() < 0.004
    assert few.attrs["closure"] < 1e-6
    np.testing.assert_array_equal(few.eccentricity[0], few.eccentricity[-1])


# what is on: fields of the bearing, of the film, and how the shaft lies
EFFECTS = {
    "lobes": ({"shape": Lobes(3, preload=0.3)}, {}, {}),
    "crown": ({"relief": (Crown(1e-4, 0.4),)}, {}, {}),
    "tilt and bend": ({}, {}, {"tilt": (0.2 * UNIT, 0.1 * UNIT), "bend": (0.05 * UNIT, 0.0)}),
    "moment": ({}, {}, {"moment": (3e4, 2e4)}),
    "shell": ({}, {"shell": LocalShell(3e-11)}, {}),
    "contact": ({}, {"contact": ROUGH}, {}),
}


@pytest.mark.parametrize("effect", EFFECTS)
def test_closed_orbits_with_effects_are_those_of_the_grid(effect):
    size, words, line = EFFECTS[effect]
    bearing, film = JournalBearing(**SIZE | size), replace(REDUCED, **words)
    cells = (48, 24) if line else FILM.grid  # of the whole width
    fine = closed(replace(film, rung="grid", grid=cells), 12, bearing, **line)
    few = closed(film, 12, bearing, **line)
    assert np.abs(extremes(few) / extremes(fine) - 1.0).max() < 0.01


def test_a_closed_orbit_is_where_a_long_path_comes_to():
    film, count, turns, aligned = REDUCED, 16, 30, (0.0, 0.0)
    time, force = load(count)
    many = np.append(force[:1], np.tile(force[1:], (turns, 1)), axis=0)
    long = np.linspace(0.0, turns * time[-1], turns * count + 1)
    lies = np.tile(aligned, (long.size, 1))  # so that both take the same points across
    path = BEARING.orbit(long, many, SPEED, film, tilt=lies, tolerance=1e-11)
    whole = closed(film, tilt=aligned, tolerance=1e-11, closure=1e-9)
    last = path.eccentricity[-count - 1 :]
    np.testing.assert_allclose(whole.eccentricity, last, atol=1e-6 * BEARING.clearance)
    marched = closed(film, tilt=aligned, periodic="marching")
    assert marched.attrs["periods"] >= whole.attrs["periods"]
    apart = 1e-5 * BEARING.clearance
    np.testing.assert_allclose(marched.eccentricity, whole.eccentricity, atol=apart)


def test_pads_close_their_orbit_as_those_of_the_grid_do():
    bearing = JournalBearing(1.4, 1.3, 1e-3, shape=TiltingPads(5, 1.05, preload=0.2, angle=0.628))
    film = Film(Lubricant(0.2), MassConserving(), 1e5, grid=(40, 16))
    phase = np.linspace(0.0, 2 * np.pi, 17)
    force = np.stack([1.5e6 + 4e5 * np.cos(phase), 6e5 * np.sin(phase)], axis=-1)
    fine, few = (
        bearing.orbit(
            3.0 * phase / phase[-1], force, SPEED, replace(film, rung=rung), periodic=True
        )
        for rung in ("grid", "reduced")
    )
    assert np.abs(extremes(few) / extremes(fine) - 1.0).max() < 0.01
    np.testing.assert_array_equal(few.pad_tilt[0], few.pad_tilt[-1])
    assert (few.pad_tilt == 0.0).any()  # without a film for part of the period


def swinging(count, turns=1):
    """Load of `turns` periods, with the tilt and bend of a shaft that goes with it."""
    time, force = load(count)
    turn = 2 * np.pi * time / time[-1]
    swing = np.stack([0.15 * np.sin(turn), 0.2 + 0.1 * np.cos(turn)], axis=-1)
    line = {"tilt": UNIT * swing, "bend": 0.1 * UNIT / BEARING.radius * swing[:, ::-1]}
    rows = {"force": force} | line
    for values in rows.values():
        values[-1] = values[0]
    again = {name: np.vstack([v[:1], *(v[1:] for _ in range(turns))]) for name, v in rows.items()}
    return np.linspace(0.0, turns * time[-1], turns * count + 1), again.pop("force"), again


MOVED = {"reduced": REDUCED} | {
    law.kind: replace(FILM, grid=(36, 8), cavitation=law)
    for law in (GasMixture(5e4), MassConserving(), Reynolds())
}


@pytest.mark.parametrize("name", MOVED)
def test_an_orbit_closes_around_a_shaft_that_swings_where_a_long_path_comes_to(name):
    count, turns, film = 16, 60, MOVED[name]  # what a start leaves falls to a third in five turns
    time, force, line = swinging(count)
    found = BEARING.orbit(
        time, force, SPEED, film, periodic=True, tolerance=1e-11, closure=1e-9, **line
    )
    assert found.attrs["closure"] < 1e-9
    np.testing.assert_allclose(found.tilt, line["tilt"], atol=1e-12)
    np.testing.assert_array_equal(found.eccentricity[0], found.eccentricity[-1])
    longer, many, lies = swinging(count, turns)
    path = BEARING.orbit(longer, many, SPEED, film, tolerance=1e-11, **lies)
    last = path.isel(time=slice(-count - 1, None))
    away = 2e-6 * BEARING.clearance
    np.testing.assert_allclose(found.eccentricity, last.eccentricity, atol=away)
    np.testing.assert_allclose(found.minimum_film, last.minimum_film, atol=away)
    # the mean of the tilt alone, and none, are other orbits: an end comes nearer to the shell
    mean = {name: np.tile(rows[:-1].mean(axis=0), (count + 1, 1)) for name, rows in line.items()}
    least = [
        float(BEARING.orbit(time, force, SPEED, film, periodic=True, **one).minimum_film.min())
        for one in (mean, {})
    ]
    assert float(found.minimum_film.min()) < 0.99 * least[0] < 0.98 * least[1]


def test_orbits_around_a_shaft_that_swings_are_those_of_the_grid():
    time, force, line = swinging(12)
    film = replace(REDUCED, grid=(48, 24))
    few, fine = (
        BEARING.orbit(time, force, SPEED, replace(film, rung=rung), periodic=True, **line)
        for rung in ("reduced", "grid")
    )
    assert np.abs(extremes(few) / extremes(fine) - 1.0).max() < 0.01
    # 24 cells across resolve the moment of the pressure at the ends to 2 %
    np.testing.assert_allclose(few.moment, fine.moment, atol=0.03 * np.abs(fine.moment).max())


def test_a_closed_orbit_is_of_second_order_in_its_steps():
    film = law_of(Sommerfeld())  # no rupture, whose edge moves from cell to cell
    paths = [closed(film, count, tolerance=1e-11) for count in (24, 48, 96, 384)]
    places = [path.eccentricity.values[:: len(path.time) // 24] for path in paths]
    errors = [np.abs(place - places[-1]).max() for place in places[:-1]]
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert orders == pytest.approx([2.0, 2.0], abs=0.35)


def test_points_across_are_added_until_they_resolve_the_whole_orbit(monkeypatch):
    tilt = {"tilt": (0.0, 0.62 * UNIT)}
    path = closed(REDUCED, **tilt)
    monkeypatch.setattr(composed_path, "LEVELS", composed_path.LEVELS[1:])
    fine = closed(REDUCED, **tilt)
    np.testing.assert_allclose(extremes(path), extremes(fine), rtol=1e-5)
    assert path.attrs["periods"] > fine.attrs["periods"]


def test_a_warm_film_closes_at_the_temperature_of_its_mean_friction():
    heat = Heat("mineral-vg-320", inlet_temperature=313.15)
    film = replace(REDUCED, lubricant=None, heat=heat)
    warm, fine = closed(film), closed(replace(film, rung="grid"))
    assert np.ptp(warm.temperature.values) == 0.0
    assert float(warm.temperature[0]) == pytest.approx(float(fine.temperature[0]), abs=0.05)
    assert warm.attrs["closure"] < 1e-6


def test_an_orbit_that_does_not_close_says_how_far_its_ends_are_apart():
    time, force = load(16)
    with pytest.raises(SolverError, match=r"does not close: its ends differ by .* after 4 periods"):
        BEARING.orbit(time, force, SPEED, law_of(Sommerfeld()), periodic="marching", max_periods=4)


def test_half_the_speed_of_the_shaft_and_loads_that_do_not_close_are_refused():
    time, force = load(24)
    turn = np.linspace(0.0, 2 * np.pi, time.size)
    whirl = 1e6 * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
    with pytest.raises(SolverError, match="half-speed whirl"):
        BEARING.orbit(turn / (0.5 * SPEED), whirl, SPEED, REDUCED, periodic=True)
    with pytest.raises(InputError, match="the last sample must close it"):
        BEARING.orbit(time[:-1], force[:-1], SPEED, REDUCED, periodic=True)
    swing = UNIT * 0.1 * np.stack([np.sin(time), np.cos(0.7 * time)], axis=-1)
    for name in ("tilt", "bend"):
        with pytest.raises(InputError, match=f"{name} is .* the last sample must close it"):
            BEARING.orbit(time, force, SPEED, REDUCED, periodic=True, **{name: swing})
