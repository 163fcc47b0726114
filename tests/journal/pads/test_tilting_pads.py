"""Tilting pads: where Newton starts, what holds a pad, and that all ways lead to one film."""

from __future__ import annotations

import warnings
from dataclasses import replace

import numpy as np
import pytest

from benchmarks.robustness.families import FAMILIES, SEEDS, draw_point
from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    Film,
    GasMixture,
    Guembel,
    Heat,
    JournalBearing,
    Lubricant,
    MassConserving,
    TiltingPads,
)
from loadflow.journal.film.gap.pad_curve import pad_curve
from loadflow.journal.line import Line
from loadflow.journal.models.composed import film as at
from loadflow.journal.models.composed.path import Drive, march_of
from loadflow.journal.questions import Steps
from loadflow.journal.solvers.effort import Effort
from loadflow.journal.solvers.newton import no_film
from loadflow.journal.solvers.pads.estimate import on_pads
from loadflow.journal.solvers.pads.statics import balance_pads, solve_with_pads
from loadflow.journal.solvers.statics import Statics
from loadflow.numerics.convergence import Limits

PADS = TiltingPads(5, 1.05, preload=0.2, angle=0.628)
BEARING = JournalBearing(1.4, 1.3, 1e-3, shape=PADS)
FILM = Film(Lubricant(0.2), GasMixture(1e4), 1e5, grid=(48, 12))
SPEED = 1.2
LIMITS = Limits(1e-10, 60, True)


def statics(bearing: JournalBearing, speed: float = SPEED) -> Statics:
    """The film at a speed."""
    found = Statics(bearing, FILM, Line.of(()), abs(speed))
    found.film.set_speed(speed)
    return found


def test_long_flat_pad_carries_what_its_exact_film_does() -> None:
    """A plane slider under parabolas across: 5/6 of the infinitely wide one, pivot at its centre.

    With a ratio of gaps of 2.1886 the centre of pressure of the plane slider is at 0.5772 of its
    length, and its load 0.02670 · 6 η U L²/h_out² [Cameron 1966].
    """
    small = 0.02  # rad, so short that the pad is plane
    share = 0.5772
    curve = pad_curve(0.0, share * small, (1 - share) * small, half_width=50.0)
    place = int(np.argmin(np.abs(curve.gaps - 0.3)))
    gap, lift = curve.gaps[place], curve.lifts[place]
    outlet = gap - lift * np.sin((1 - share) * small)
    inlet = gap + lift * np.sin(share * small)
    assert inlet / outlet == pytest.approx(2.1886, rel=0.05)
    exact = 5 / 6 * 6 * 0.02670 * small**2 / outlet**2
    assert curve.forces[place] == pytest.approx(exact, rel=0.02)


@pytest.mark.parametrize("load", [2e5, 1e6, 4e6])
@pytest.mark.parametrize("angle", [0.0, 2.0])
def test_first_position_is_near_the_answer(load: float, angle: float) -> None:
    """Within 5 % of the clearance, so that Newton's method needs few steps from it."""
    force = load * np.array([np.cos(angle), np.sin(angle)])
    film = statics(BEARING)
    place = on_pads(film.film, film.gap, force)
    assert place is not None
    found = film.solve(0, force, SPEED, None, LIMITS)
    assert found.converged
    assert found.iterations <= 6
    np.testing.assert_allclose(place, found.position[:2], atol=0.05)


def test_both_ways_lead_to_one_film() -> None:
    """Newton for all at once, and shaft on pads held between bounds, which other pads come off."""
    force = np.array([1.99e6, -2.4e5])
    film = statics(BEARING)
    once = film.solve(0, force, SPEED, None, LIMITS)
    limits = LIMITS.tolerance, LIMITS.max_iterations
    generalised = np.append(force, np.zeros(5))
    away = film.gap.lifted(np.append([0.87, -0.1], np.zeros(5)), SPEED)
    effort = Effort.of(film.film, LIMITS.max_iterations)
    asked = film.film, film.gap, generalised, away, np.arange(2), *limits
    steps = solve_with_pads(*asked, effort)
    assert steps.iterations == effort.spent
    assert steps.converged
    np.testing.assert_allclose(steps.position, once.position, atol=1e-8)
    pads = film.gap.pads
    off = film.gap.columns_of(np.setdiff1d(pads, film.gap.converging(once.position, SPEED)))
    for state in (once, steps):
        pressure = film.film.field(state.u, state.position)[0]
        np.testing.assert_allclose(pressure[off], 1e5, rtol=1e-9)  # no pressure is left on them


def test_pad_behind_its_middle_is_held_by_a_straight_film() -> None:
    """Without preload a pad opposite the load tilts like a plane slider if its pivot is offset."""
    middle = pad_curve(0.0, 0.5, 0.5, 1.0)
    offset = pad_curve(0.0, 0.6, 0.4, 1.0)
    assert not middle.holds(np.array([1.01]))[0]
    assert offset.holds(np.array([1.2]))[0]


def test_turned_bearing_and_reversed_speed_give_the_mirrored_answer() -> None:
    """Offset pivots, load and rotation mirrored."""
    mirrored = []
    for sign in (1.0, -1.0):
        offset = 0.6 if sign > 0 else 0.4
        shape = TiltingPads(4, 1.2, preload=0.1, angle=0.3 * sign, offset=offset)
        bearing = JournalBearing(1.4, 1.3, 1e-3, shape=shape)
        film = Film(Lubricant(0.2), Guembel(), 1e5, grid=(48, 12))
        mirrored.append(bearing.equilibrium((8e5, 2e5 * sign), 1.2 * sign, film))
    first, second = mirrored
    assert first.maximum_pressure == pytest.approx(float(second.maximum_pressure), rel=1e-8)
    assert first.friction_power == pytest.approx(float(second.friction_power), rel=1e-8)


def test_a_film_from_a_near_one_is_the_same_in_fewer_steps() -> None:
    """Warm oil that is a tenth thicker, under a shaft so tilted that pads are sought one by one."""
    bearing = JournalBearing(2.0, 1.3, 0.7e-3, shape=TiltingPads(4, 1.3, preload=0.35, angle=0.785))
    given = {"tilt": [[1.5e-4, 0.0]], "edge_pressure": 1e5, "grid": (60, 10)}
    warm = Heat(inlet_temperature=318.0)
    thicker = replace(warm, oil=warm.liquid.scaled(1.1))
    load = ([[2.2e6, 0.3e6]], 1.3)
    stated = bearing.equilibrium(*load, heat=warm, **given)
    afresh = bearing.equilibrium(*load, heat=thicker, **given)
    near = bearing.equilibrium(*load, heat=thicker, near=stated, **given)
    assert near.iterations.sum() <= afresh.iterations.sum()
    assert near.heat_iterations.sum() < afresh.heat_iterations.sum()
    np.testing.assert_allclose(near.minimum_film, afresh.minimum_film, rtol=1e-6)
    np.testing.assert_allclose(near.temperature, afresh.temperature, atol=1e-5)


def test_a_start_without_room_is_left_for_the_usual_one() -> None:
    load = ([[4e6, 0.0]], SPEED)
    stated = BEARING.equilibrium(*load, FILM)
    far = replace(stated, eccentricity=stated.eccentricity + 5 * BEARING.clearance)
    found = BEARING.equilibrium(*load, FILM, near=far)
    np.testing.assert_allclose(found.eccentricity, stated.eccentricity, rtol=1e-9)


def test_a_near_film_of_other_loads_or_pads_is_refused() -> None:
    stated = BEARING.equilibrium([[4e6, 0.0]], SPEED, FILM)
    with pytest.raises(InputError, match=r"near = '1 load\(s\) .* is not allowed: 2 load\(s\)"):
        BEARING.equilibrium([[4e6, 0.0], [3e6, 0.0]], SPEED, FILM, near=stated)
    plain = JournalBearing(1.4, 1.3, 1e-3)
    with pytest.raises(InputError, match=r"is not allowed: 1 load\(s\) on 0 pads"):
        plain.equilibrium([[4e5, 0.0]], SPEED, FILM, near=stated)


@pytest.mark.parametrize("law", [MassConserving(), GasMixture(1e4)], ids=lambda law: law.kind)
def test_ordinary_wind_loads_on_a_pad_have_answers(law: MassConserving | GasMixture) -> None:
    """A 5 MW turbine under load on pad, the default angle: none ends in an error of its numbers."""
    draw = np.random.default_rng(5)
    load = 2e5 + 8e5 * draw.weibull(2.5, 60)
    toward = draw.normal(0.0, 0.35, 60)  # from the first pivot
    toward[:10] = 0.0  # on its very middle, where both sides are alike
    force = load[:, None] * np.stack([np.cos(toward), np.sin(toward)], axis=-1)
    speed = np.clip(draw.normal(1.1, 0.15, 60), 0.3, 1.35)
    bearing = JournalBearing(1.4, 1.3, 1e-3, shape=TiltingPads(5, 1.05, preload=0.2))
    film = Film(Lubricant(0.2), law, 1e5, grid=(180, 16))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        found = bearing.equilibrium(force, speed, film, strict=False)
    assert found.converged.all()
    assert (found.minimum_film > 0).all()


@pytest.mark.filterwarnings("ignore:the cells do not resolve")
def test_a_load_at_which_a_film_takes_hold_of_a_pad_is_refused_by_its_name() -> None:
    """Beside each other the pads carry too little and too much: no place between has the load."""
    point = draw_point(np.random.default_rng([SEEDS["pads"], 1233]))
    FAMILIES["pads"](point)
    with pytest.raises(SolverError, match=r"a film holds the pad at -78.4° there or just beside"):
        point.solve()
    options = {name: value for name, value in point.film.items() if name != "tilt"}
    line = Line.of((), tilt=point.film["tilt"])
    own = Statics(point.bearing, Film(point.oil, **options), line, abs(point.speed))
    last = own.solve(0, point.force, point.speed, None, LIMITS)
    assert last.lost.size == 1
    missing = []
    for angle in np.arange(8) * np.pi / 4:
        beside = last.position[:2] + 2e-3 * np.array([np.cos(angle), np.sin(angle)])
        held = point.bearing.pressure(beside * point.gap, point.speed, point.oil, **point.film)
        missing.append((point.force - held.force) / point.load)
    assert (missing @ np.transpose(missing)).min() < -0.1  # the other way from one to another


def test_a_pad_that_meets_the_shaft_however_it_tilts_is_not_sought_a_tilt() -> None:
    own = statics(BEARING)
    for place, converged in ((0.6, True), (1.3, False)):
        position = np.zeros(own.gap.size)
        position[:2] = place * own.gap.pivots[0]
        there = replace(no_film(own.film), u=own.film.start(), position=position)
        found, held = balance_pads(own.film, own.gap, there, own.gap.pads[:1], 1e-10, 60)
        assert (found.converged, held.tolist()) == (converged, [converged])
        assert (found.iterations > 0) == converged


def test_a_path_that_stops_on_pads_meets_these_as_they_are_tilted() -> None:
    """Flat, the ones that have turned into its way would stand off the shaft."""
    film, count = replace(FILM, rung="reduced"), 3
    load, line = np.full((count, 2), (1e6, 0.0)), Line.of((count,))
    given = np.linspace(0.0, 0.1, count), load, np.full(count, SPEED), line, LIMITS
    march = march_of(Drive(BEARING, film, *given, Steps()))

    def told(x: float, tilts: float) -> str:
        march.rows[1, at.X] = x
        march.tried.tilts[:] = tilts
        return str(march.stops(1, 2))

    assert "touches the bore" not in told(0.3, 0.0)
    assert "touches the bore" in told(0.3, 2.0)
    assert "touches the bore, narrowest gap -" in told(1.05, 0.0)
