"""Grooves behind restrictors and pumps on the rung "reduced" against the grid with the same."""

from dataclasses import replace

import numpy as np
import pytest

from loadflow.errors import InputError
from loadflow.journal import (
    Capillary,
    ConstantFlow,
    Film,
    GasMixture,
    Groove,
    Heat,
    JournalBearing,
    Lubricant,
    MassConserving,
    Orifice,
    Pump,
    Reynolds,
    Supply,
)

BEARING = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
SPEED, LOAD = 100.0, np.array([6e3, 1e3])
SIDES = (np.pi / 2, -np.pi / 2)
CAPILLARY = Capillary(1.5e-3, 0.1)


def pockets(*restrictors, pump=None):
    pressure = 0.0 if pump else 3e5
    return Supply(
        tuple(
            Groove(angle, arc=0.3, length=0.05, pressure=pressure, restrictor=restrictor)
            for angle, restrictor in zip(SIDES, restrictors)
        ),
        pump=pump,
    )


PUMPED = pockets(
    None, CAPILLARY, pump=Pump((0.0, 1e-5, 4e-5), (4e5, 3e5, 0.0), line=Capillary(4e-3, 0.5))
)
FEEDS = {
    "capillaries": pockets(CAPILLARY, CAPILLARY),
    "orifices": pockets(Orifice(1e-3), Orifice(1e-3)),
    "constant flow": pockets(ConstantFlow(2e-6), ConstantFlow(3e-6)),
    "one of two": pockets(CAPILLARY, None),
    "pump": PUMPED,
}
FILM = Film(Lubricant(0.03), GasMixture(5e4), 1e5, PUMPED, inlet=None, grid=(72, 24))
NAMES = ("minimum_film", "maximum_pressure", "friction_power", "side_flow", "supply_flow")


def both(film, **line):
    return tuple(
        BEARING.equilibrium(LOAD, SPEED, replace(film, rung=rung), **line)
        for rung in ("reduced", "grid")
    )


@pytest.mark.parametrize("feed", FEEDS)
def test_restrictors_and_pumps_at_rest_are_those_of_the_grid(feed):
    """So are stiffness and damping, which know the reaction of the restrictors."""
    own, grid = both(replace(FILM, supply=FEEDS[feed]))
    for name, most in zip(NAMES, (0.004, 0.006, 0.002, 0.02, 0.02)):
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most), name
    np.testing.assert_allclose(own.groove_pressure, grid.groove_pressure, rtol=0.01)
    largest = np.abs(grid.groove_flow).max()
    np.testing.assert_allclose(own.groove_flow, grid.groove_flow, atol=0.02 * largest)
    assert own.supply_power == pytest.approx(float(grid.supply_power), rel=0.03)
    for name in ("stiffness", "damping"):
        scale = np.abs(getattr(grid, name)).max()
        np.testing.assert_allclose(getattr(own, name), getattr(grid, name), atol=0.02 * scale)


@pytest.mark.parametrize("feed", FEEDS)
def test_what_flows_is_what_its_feed_gives(feed):
    """The residual of the pressures is of the same iteration: it is met to rounding."""
    supply = FEEDS[feed]
    state, _ = both(replace(FILM, supply=supply))
    source, oil = 3e5, Lubricant(0.03)
    if supply.pump is not None:
        flow = float(state.groove_flow.sum())
        source = supply.pump.at(flow)[0] - supply.pump.line.pressure_drop(flow, oil)[0]
    for groove, flow, pressure in zip(supply.grooves, state.groove_flow, state.groove_pressure):
        restrictor = groove.restrictor
        if restrictor is not None and restrictor.given_flow is not None:
            assert flow == pytest.approx(restrictor.given_flow, rel=1e-8)
            continue
        drop = 0.0 if restrictor is None else restrictor.pressure_drop(float(flow), oil)[0]
        assert pressure == pytest.approx(source - drop, rel=1e-8)


@pytest.mark.parametrize("law", [Reynolds(), MassConserving()], ids=lambda law: law.kind)
def test_other_laws_and_a_moment_go_with_a_pump(law):
    own, grid = both(replace(FILM, cavitation=law), moment=(10.0, 5.0))
    for name, most in zip(NAMES, (0.008, 0.01, 0.003, 0.03, 0.03)):
        assert getattr(own, name) == pytest.approx(float(getattr(grid, name)), rel=most), name
    np.testing.assert_allclose(own.groove_pressure, grid.groove_pressure, rtol=0.01)


@pytest.mark.parametrize("feed", ["orifices", "pump"])
def test_stiffness_holds_the_reaction_of_the_feed(feed):
    """Differences of the force at places beside the equilibrium, where the feed follows."""
    film = replace(FILM, supply=FEEDS[feed], rung="reduced")
    state, step = BEARING.equilibrium(LOAD, SPEED, film), 1e-9
    columns = []
    for way in step * np.eye(2):
        ahead, behind = (state.eccentricity + sign * way for sign in (1.0, -1.0))
        ends = (BEARING.pressure(place, SPEED, film).force for place in (ahead, behind))
        columns.append(np.subtract(*ends) / (2.0 * step))
    scale = np.abs(state.stiffness).max()
    np.testing.assert_allclose(np.transpose(columns), state.stiffness, atol=1e-4 * scale)
    held = film.supply.grooves, state.groove_pressure
    given = tuple(replace(g, pressure=p, restrictor=None) for g, p in zip(*held))
    stiff = BEARING.equilibrium(LOAD, SPEED, replace(film, supply=Supply(given))).stiffness
    assert np.abs(stiff - state.stiffness).max() > 1e-3 * scale


@pytest.mark.parametrize("periodic", [False, True])
def test_paths_on_a_pump_are_those_of_the_grid(periodic):
    phase = np.linspace(0.0, 2 * np.pi, 21)
    force = LOAD + np.stack([2e3 * np.cos(phase), 1e3 * np.sin(phase)], axis=-1)
    force[-1] = force[0]
    own, grid = (
        BEARING.orbit(phase / SPEED, force, SPEED, replace(FILM, rung=rung), periodic=periodic)
        for rung in ("reduced", "grid")
    )
    for name, allowed in zip(NAMES, (0.008, 0.01, 0.003, 0.03, 0.03)):
        scale = np.abs(grid[name]).max()
        assert np.abs(own[name] - grid[name]).max() < allowed * scale, name
    np.testing.assert_allclose(own.groove_pressure, grid.groove_pressure, rtol=0.01)


def test_a_capillary_lets_more_through_as_the_oil_warms():
    """It follows the viscosity, as the film does; other restrictors are refused with heat."""
    heat = Heat("iso-vg-68", capacity=4e2, start_temperature=320.0)
    film = replace(FILM, lubricant=None, heat=heat, supply=FEEDS["capillaries"], rung="reduced")
    time = np.linspace(0.0, 0.2, 81)
    loads = np.tile(LOAD, (81, 1))
    path = BEARING.orbit(time, loads, SPEED, film)
    assert float(path.temperature[-1]) > 320.5
    last = heat.lubricant(float(path.temperature[-1]))
    still = BEARING.equilibrium(LOAD, SPEED, replace(film, lubricant=last, heat=None))
    for name in ("groove_flow", "groove_pressure", "supply_power"):
        np.testing.assert_allclose(path[name][-1], getattr(still, name), rtol=0.03)
    for feed in ("orifices", "pump"):
        with pytest.raises(InputError, match="a given pressure or a capillary"):
            BEARING.orbit(time, loads, SPEED, replace(film, supply=FEEDS[feed]))
