"""Tilting pads in motion: their tilts are unknowns of each step, on both rungs."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from loadflow.journal import (
    FilmHeat,
    GasMixture,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    TiltingPads,
)
from loadflow.journal.film_model import Film
from loadflow.journal.models.composed.kernels import _pad_loops, _shared_pad_kernels
from loadflow.journal.models.composed.pads import make_pad_work, narrowest_on_pads

BEARING = JournalBearing(1.4, 1.3, 1e-3, shape=TiltingPads(5, 1.05, preload=0.2, angle=0.628))
SPEED, PERIOD = 1.2, 3.0


def film(law=None, rung="grid", cells=(40, 6)):
    return Film(Lubricant(0.2), law or MassConserving(), 1e5, grid=cells, rung=rung)


def turning(time, mean=1.5e6, along=4e5, aside=6e5):
    """A load that goes round an ellipse beside the middle."""
    phase = 2 * np.pi * time / PERIOD
    return np.stack([mean + along * np.cos(phase), aside * np.sin(phase)], axis=-1)


def test_a_steady_load_keeps_shaft_and_pads_where_they_rest():
    load, time = np.array([1.5e6, 3e5]), np.linspace(0.0, 1.0, 6)
    rest = BEARING.equilibrium(load, SPEED, film())
    path = BEARING.orbit(time, np.tile(load, (6, 1)), SPEED, film())
    still = np.broadcast_to(rest.eccentricity, (6, 2)) / BEARING.clearance
    np.testing.assert_allclose(path.eccentricity / BEARING.clearance, still, atol=1e-8)
    tilts = np.broadcast_to(rest.pad_tilt, (6, 5))
    np.testing.assert_allclose(path.pad_tilt, tilts, atol=1e-10)


def test_a_shaft_that_is_let_go_comes_to_rest_with_its_pads():
    load, time = np.array([1.5e6, 0.0]), np.linspace(0.0, 12.0, 61)
    rest = BEARING.equilibrium(load, SPEED, film())
    path = BEARING.orbit(time, np.tile(load, (61, 1)), SPEED, film(), start=0.9 * rest.eccentricity)
    end = path.isel(time=-1)
    np.testing.assert_allclose(end.eccentricity, rest.eccentricity, atol=1e-5 * BEARING.clearance)
    np.testing.assert_allclose(end.pad_tilt, rest.pad_tilt, atol=1e-8)


def second_order(options):
    """Paths of growing accuracy; halving the step takes their error to a quarter."""
    paths = []
    for count in (61, 121, 481):
        time = np.linspace(0.0, 2 * PERIOD, count)
        paths.append(BEARING.orbit(time, turning(time), SPEED, options))
    finest = paths[-1].eccentricity
    coarse, halved = (
        float(np.abs(path.eccentricity - finest.sel(time=path.time, method="nearest")).max())
        for path in paths[:2]
    )
    assert halved < 0.35 * coarse
    return paths


def test_given_steps_are_of_second_order_while_pads_come_and_go():
    """Halving the step takes the error of the path to a quarter, the balance of mass follows."""
    paths = second_order(film())
    assert abs(paths[-1].mass_balance) < 0.3 * abs(paths[1].mass_balance) < 1e-3
    lies = paths[-1].pad_tilt.values == 0.0
    assert (lies[1:] != lies[:-1]).sum() >= 4  # pads lost their film, and got it back


def test_adaptive_steps_and_the_closed_path_agree_with_given_steps():
    time = np.linspace(0.0, PERIOD, 41)
    closed = BEARING.orbit(time, turning(time), SPEED, film(), periodic=True)
    assert closed.closure < 1e-6
    first, last = closed.isel(time=0), closed.isel(time=-1)
    np.testing.assert_allclose(first.pad_tilt, last.pad_tilt, atol=1e-8)
    long = np.linspace(0.0, 3 * PERIOD, 121)
    march = BEARING.orbit(long, turning(long), SPEED, film()).isel(time=slice(80, None))
    apart = np.abs(march.eccentricity.values - closed.eccentricity.values).max()
    assert apart < 2e-5 * BEARING.clearance
    fine = BEARING.orbit(time, turning(time), SPEED, film(), step="adaptive", step_tolerance=1e-4)
    given = BEARING.orbit(time, turning(time), SPEED, film())
    apart = np.abs(fine.minimum_film - given.minimum_film).max()
    assert 0.0 < apart < 5e-3 * BEARING.clearance


def test_position_and_velocity_of_a_path_give_its_load_back():
    """A film at the place and the velocity of a shaft that moves slowly carries its load."""
    time = np.linspace(0.0, 4.0, 21)
    load = np.stack([1.5e6 + 2e4 * time, 5e3 * time], axis=-1)
    path = BEARING.orbit(time, load, SPEED, film(Guembel()))
    places = path.eccentricity.values
    velocity = np.gradient(places, time, axis=0)
    field = BEARING.pressure(places[10], SPEED, film(Guembel()), velocity=velocity[10])
    assert np.hypot(*(field.force - load[10])) < 1e-3 * np.hypot(*load[10])


@pytest.mark.parametrize("law", [GasMixture(1e4), Guembel()])
def test_a_shaft_that_stops_and_turns_back_takes_its_pads_along(law):
    time = np.linspace(0.0, 6.0, 121)
    load = np.tile([3e5, 0.0], (time.size, 1))
    path = BEARING.orbit(time, load, 1.2 * (1 - time / 3), film(law))
    aside = path.eccentricity.values @ [-np.sin(0.628), np.cos(0.628)] / 0.7
    lift = path.pad_tilt.isel(pad=0) + aside  # of the first pad, against the shaft
    assert float(lift[0]) > 0.0 > float(lift[-1])  # inlets and outlets have changed places
    assert bool((path.residual < 1e-8).all())


def warm(rung="grid", cells=(48, 8)):
    heat = FilmHeat("mineral-vg-320", inlet_temperature=313.15)
    return Film(None, MassConserving(), 1e5, grid=cells, rung=rung, heat=heat)


def turned_by_a_pad(time):
    """A load that turns by one pad and back: a pad comes and goes."""
    angle = 0.2 * np.pi * (1 - np.cos(np.pi * time / PERIOD))
    return 1.5e6 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


@pytest.mark.parametrize(("rung", "share"), [("grid", 1e-7), ("reduced", 5e-3)])
def test_a_steady_load_keeps_warm_pads_and_their_heat_as_at_rest(rung, share):
    """Also that of the two pads without load, past which goes what their narrowest place drags."""
    load, time = np.array([1.5e6, 3e5]), np.linspace(0.0, 1.0, 6)
    rest = BEARING.equilibrium(load, SPEED, warm())
    path = BEARING.orbit(time, np.tile(load, (6, 1)), SPEED, warm(rung))
    assert (rest.pad_tilt == 0.0).sum() == 2
    tilts = np.tile(rest.pad_tilt, (6, 1))
    np.testing.assert_allclose(path.pad_tilt, tilts, atol=share * np.abs(tilts).max())
    for name in ("minimum_film", "friction_power", "temperature"):
        np.testing.assert_allclose(path[name], getattr(rest, name), rtol=share, err_msg=name)
    np.testing.assert_allclose(path.maximum_pressure, rest.maximum_pressure, rtol=4 * share)
    cold = BEARING.orbit(time, np.tile(load, (6, 1)), SPEED, warm().isothermal())
    assert float(cold.friction_power[0] / path.friction_power[0]) > 1.1


def test_the_mean_heat_is_that_of_the_pads_that_each_load_has():
    time = np.linspace(0.0, 2 * PERIOD, 31)
    path = BEARING.orbit(time, turned_by_a_pad(time), SPEED, warm())
    without = (path.pad_tilt == 0.0).sum("time").values
    assert np.any((without > 0) & (without < 31))  # a pad comes and goes
    assert path.attrs["heat_imbalance"] < 1e-8
    assert path.attrs["heat_residual"] < 1e-6


@pytest.mark.parametrize("more", [{}, {"periodic": True}, {"moment": (1e4, 2e4)}])
def test_warm_pads_on_reduced_follow_the_grid(more):
    time = np.linspace(0.0, 2 * PERIOD, 31)
    load = turned_by_a_pad(time)
    load[-1] = load[0]
    ours, theirs = (
        BEARING.orbit(time, load, SPEED, warm(rung, (60, 16)), **more)
        for rung in ("reduced", "grid")
    )
    for name, share in (
        ("eccentricity_ratio", 5e-4),
        ("minimum_film", 0.003),
        ("maximum_pressure", 0.01),
        ("friction_power", 0.005),
        ("temperature", 1e-4),
    ):
        np.testing.assert_allclose(ours[name], theirs[name], rtol=share, err_msg=name)
    assert ours.attrs["heat_imbalance"] < 1e-8


def reduced(law=None):
    return film(law, "reduced", (60, 8))


@pytest.mark.parametrize("law", [GasMixture(1e4), MassConserving()])
def test_the_reduced_film_follows_the_grid_while_pads_come_and_go(law):
    time = np.linspace(0.0, 2 * PERIOD, 81)
    path = BEARING.orbit(time, turning(time), SPEED, reduced(law))
    grid = BEARING.orbit(time, turning(time), SPEED, film(law, cells=(60, 16)))
    for name, share in (
        ("minimum_film", 0.01),
        ("maximum_pressure", 0.02),
        ("friction_power", 0.01),
        ("pad_tilt", 0.01),
    ):
        apart = float(np.abs(path[name] - grid[name]).max())
        assert apart < share * float(np.abs(grid[name]).max()), name
    assert ((path.pad_tilt.values == 0.0) == (grid.pad_tilt.values == 0.0)).mean() > 0.98


@pytest.mark.parametrize(
    ("size", "angle", "share"),
    [
        (3e5, lambda time: 0.2 * np.pi * (1.0 - np.cos(np.pi * time / PERIOD)), 0.015),
        (2e4, lambda time: np.pi * time / PERIOD, 0.08),
    ],
    ids=["swings", "turns"],
)
def test_a_step_that_fails_is_cut_before_a_pad_is_let_go(size, angle, share):
    """Light loads that turn far in a step; a pad let go at once leaves the path by 4 and 26 %."""
    paths = []
    for every in (1, 8):
        time = np.linspace(0.0, 2 * PERIOD, 30 * every + 1)
        load = size * np.stack([np.cos(angle(time)), np.sin(angle(time))], axis=-1)
        path = BEARING.orbit(time, load, SPEED, film(GasMixture(5e4), cells=(60, 16)))
        paths.append(path["eccentricity_ratio"].values[::every])
    np.testing.assert_allclose(paths[0], paths[1], rtol=share)


def test_steps_of_the_reduced_film_on_pads_are_of_second_order():
    second_order(reduced())


def test_a_shaft_on_reduced_pads_comes_to_rest_where_the_grid_has_it():
    load, time = np.array([1.5e6, 0.0]), np.linspace(0.0, 12.0, 61)
    rest = BEARING.equilibrium(load, SPEED, film(cells=(60, 16)))
    path = BEARING.orbit(
        time, np.tile(load, (61, 1)), SPEED, reduced(), start=0.9 * rest.eccentricity
    )
    end = path.isel(time=-1)
    np.testing.assert_allclose(end.eccentricity, rest.eccentricity, atol=5e-3 * BEARING.clearance)
    np.testing.assert_allclose(end.pad_tilt, rest.pad_tilt, atol=1e-5)


def test_a_moment_tilts_the_shaft_on_reduced_pads_as_on_the_grid():
    time = np.linspace(0.0, PERIOD, 31)
    moment = np.tile([4e4, -3e4], (time.size, 1))
    path = BEARING.orbit(time, turning(time), SPEED, reduced(), moment=moment)
    grid = BEARING.orbit(time, turning(time), SPEED, film(cells=(60, 16)), moment=moment)
    for name in ("tilt", "minimum_film"):
        apart = float(np.abs(path[name] - grid[name]).max())
        assert apart < 0.02 * float(np.abs(grid[name]).max()), name


@pytest.mark.filterwarnings("ignore:the cells do not resolve")
def test_the_end_of_a_pad_stays_clear_of_the_shaft():
    """A load that swings past a pad faster than its film follows; its end is half a cell away."""
    bearing = JournalBearing(1.4, 0.8, 8e-4, shape=TiltingPads(5, 1.05, preload=0.5, angle=0.628))
    time = np.linspace(0.0, 1.0, 41)
    swing = 0.5 - 0.5 * np.cos(np.pi * time)
    angle = 0.8 * np.pi * swing - 0.4
    along, aside = 0.1 + np.cos(angle) * (1.0 - 1.2 * swing), -np.sin(angle) - swing
    load = 4.5e6 * np.stack([along, aside], axis=-1)
    path = bearing.orbit(time, load, SPEED, reduced(GasMixture(1e4)))
    assert path.attrs["cells_around"] > 60, "on 60 cells the end of the pad would meet the shaft"
    grid = bearing.orbit(time, load, SPEED, film(GasMixture(1e4), cells=(120, 16)))
    least, on_grid = (float(one.minimum_film.min()) for one in (path, grid))
    assert least == pytest.approx(on_grid, rel=0.05)
    assert least > 0.01 * bearing.clearance


def test_the_narrowest_gap_of_reduced_pads_is_that_between_their_places():
    """A shaft nearer to a pad than its cells tell: places are half a cell apart."""
    bearing = JournalBearing(1.4, 0.8, 8e-4, shape=TiltingPads(5, 1.05, preload=0.3, angle=0.628))
    time = np.linspace(0.0, PERIOD, 41)
    path = bearing.orbit(time, turning(time), SPEED, reduced(Guembel()))
    centres = path.eccentricity.values[:, None] / bearing.clearance
    tilts = path.pad_tilt.values / bearing.relative_clearance
    least = bearing.clearance * narrowest_on_pads(bearing, centres, np.zeros(1), tilts)
    np.testing.assert_allclose(path.minimum_film, least, rtol=1e-9)


@pytest.mark.parametrize("law", [MassConserving(), Guembel()])
def test_a_shaft_on_a_single_pad_is_held_sideways_by_the_squeeze_of_the_others(law):
    """Its load turns off the pad: at rest another pad holds it only after it has gone there."""
    bearing = JournalBearing(0.2, 0.2, 1e-3, shape=TiltingPads(3, 1.06, 0.14, 0.0))
    time, angle = np.linspace(0.0, 0.1, 6), np.linspace(0.0, 0.5, 6)
    force = 1e4 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    words = {"cavitation": law, "grid": (48, 8), "edge_pressure": 3e5, "step": "adaptive"}
    oil = Lubricant(0.03)
    path, fine = (
        bearing.orbit(time, force, 20.0, oil, step_tolerance=share, **words)
        for share in (1e-3, 1e-4)
    )
    assert path["residual"].max() < 1e-8
    assert int(path["steps"].sum()) < 200
    # as its errors of step ask, and on its way to where it would stand under the last load
    np.testing.assert_allclose(path["eccentricity_ratio"], fine["eccentricity_ratio"], atol=5e-3)
    words.pop("step")
    rest = bearing.equilibrium(force[-1], 20.0, oil, **words)
    assert fine["eccentricity_ratio"].values[-1] < float(rest.eccentricity_ratio)
    assert float(fine["eccentricity"].values[-1, 1]) > 0.6 * rest.eccentricity[1]


def test_a_load_passes_over_a_pad_that_alone_holds_the_shaft_alike_on_both_rungs():
    bearing = JournalBearing(0.2, 0.2, 1e-3, shape=TiltingPads(3, 1.06, 0.14, 0.0))
    time, angle = np.linspace(0.0, 0.15, 16), np.linspace(0.3, -0.45, 16)
    force = 1e4 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    words = {"cavitation": Guembel(), "grid": (48, 8), "edge_pressure": 3e5, "step": "adaptive"}
    grid, fast = (
        bearing.orbit(time, force, 20.0, Lubricant(0.03), rung=rung, **words)
        for rung in ("grid", "reduced")
    )
    aside = grid["eccentricity"].values[:, 1]
    assert aside[0] > 0.0
    assert aside[-1] < 0.0
    np.testing.assert_allclose(
        fast["eccentricity"] / bearing.clearance,
        grid["eccentricity"] / bearing.clearance,
        atol=0.01,
    )


def test_a_shaft_in_two_films_keeps_the_pad_that_it_lies_near(monkeypatch):
    """Where a step fails, flat pads lose their films, but not the one that carries the shaft."""
    for name in ("spare_state", "lift_of", "put_on"):
        monkeypatch.setattr(_pad_loops, name, getattr(_pad_loops, name).py_func)
    monkeypatch.setattr(_shared_pad_kernels, "try_other_pads", _pad_loops.try_other_pads.py_func)
    monkeypatch.setattr(_shared_pad_kernels, "set_out_side", lambda side, begun: None)
    toward = np.array([[1.0, 0.0], [-1.0, 0.0]])
    pads = SimpleNamespace(
        toward=toward, along=toward[:, ::-1].copy(), widest=np.array([0.8, 0.8]),
        cell=np.array([0, 0, 1, 1]), edge=0.0,
    )  # fmt: skip
    work = SimpleNamespace(**{name: np.ones((4, 3)) for name in ("u", "last", "before")})
    pad_work = make_pad_work((4, 3), 2)
    pad_work.on[:] = True
    at = np.array([0.7, 0.0, 0.0, 0.0])  # 0.3 clearances before one pad, 1.7 before the other
    side = SimpleNamespace(work=work, pads=pads, pad_work=pad_work, place=at, new=at)
    assert _shared_pad_kernels.try_others(side, 1.0, False)
    assert pad_work.on.tolist() == [True, False]
