"""Hard cases of journal bearings where two hardships meet."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hard_case import Outcome, hard, solved

from loadflow.journal import (
    ConicalBearing,
    ConstantFlow,
    Contact,
    Contour,
    Film,
    FilmHeat,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    Lubricant,
    MassConserving,
    Pivot,
    Supply,
    ThickShell,
)
from loadflow.tribology import AsperityContact, ShaftImprint, lubricant

SMALL = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
MIXED = {"lubricant": Lubricant(0.03), "cavitation": GasMixture(5e4), "edge_pressure": 1.5e5}
ROUGH = Contact(AsperityContact(roughness=1e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)


def _path(orbit, text: str) -> Outcome:
    """Outcome of an orbit, which raises where a step does not converge."""
    return Outcome(text, float(orbit["residual"].max()), int(orbit["iterations"].max()))


@hard(
    "journal",
    "load and tilt reversed within one step of 0.1 s",
    why="the film empties on one side and one end and fills on the others, all in one step",
    what="steps are cut, load and tilt interpolated; the same on the grid and on `reduced`",
    tolerance=1e-6,
)
def reversal_with_tilt():
    time = np.arange(20) * 0.1
    way = np.where(time < 1.0, 1.0, -1.0)[:, None]
    words = MIXED | {"grid": (120, 24)}
    force, tilt = way * (2e4, 5e3), way * (3e-4, -2e-4)
    grid, fast = (
        SMALL.orbit(time, force, 20.0, tilt=tilt, rung=rung, **words)
        for rung in ("grid", "reduced")
    )
    largest = [float(orbit["eccentricity_ratio"].max()) for orbit in (grid, fast)]
    assert largest[0] < 1
    assert abs(largest[1] / largest[0] - 1) < 0.02
    return _path(grid, f"ε ≤ {largest[0]:.3f}, {largest[1]:.3f} on `reduced`")


@hard(
    "journal",
    "viscosity ratio of 10³ across the film",
    why="nearly all of the shear lies in a thin layer at the hot wall; a mean means nothing",
    what="integrals of the fluidity across the film through four points",
)
def viscosity_across():
    """A cold shaft and a hot shell: 0.9 Pa s at one wall and a thousandth of it at the other."""
    states = []
    for points in (1, 4):
        heat = FilmHeat(
            "iso-vg-220", 313.15, shell_transfer=1e6, shaft_transfer=1e6, shaft_temperature=268.15,
            shell_temperature=403.15, points=points,
        )  # fmt: skip
        film = Film(heat=heat, cavitation=MassConserving(), grid=(48, 12), edge_pressure=1.5e5)
        states.append(SMALL.equilibrium((2e4, 0.0), 20.0, film))
    oil = lubricant("iso-vg-220")
    ratio = float(oil.viscosity(268.15) / oil.viscosity(403.15))
    assert ratio > 1000
    mean, across = (float(state.friction_power) for state in states)
    assert across < 0.6 * mean  # sheared where it is thin
    return solved(states[1], f"{ratio:.0f} : 1; {across:.0f} W, {mean:.0f} W with a mean")


@hard(
    "journal",
    "a groove that starves while its film heats",
    why="less oil is hotter and thinner oil, which draws less and lets the shaft down on it",
    what="the fill of the groove is its unknown, the energy equation goes with it; heat balances",
)
def starved_and_warm():
    ratios, warmth = [], []
    for flow in (3e-5, 3e-6, 3e-7):
        groove = Groove(np.pi, arc=0.3, length=0.15, restrictor=ConstantFlow(flow))
        film = Film(
            heat=FilmHeat("iso-vg-68", 313.15, shell_transfer=200.0), cavitation=MassConserving(),
            supply=Supply([groove]), grid=(48, 12),
        )  # fmt: skip
        state = SMALL.equilibrium((2e4, 0.0), 60.0, film)
        ratios.append(float(state.eccentricity_ratio))
        warmth.append(float(state.maximum_temperature))
    assert state.starved
    assert abs(state.supply_flow / flow - 1) < 1e-8
    assert np.all(np.diff(ratios) > 0)
    assert np.all(np.diff(warmth) > 0)
    return solved(state, f"ε = {ratios[-1]:.3f} at {warmth[-1] - 273.15:.0f} °C")


@hard(
    "journal",
    "thin shell at high load in motion",
    why="the pressure opens the gap by more than the clearance while the shaft turns with its load",
    what="the shell stands in the Newton matrix of every step; ε passes 1, the film does not close",
    tolerance=1e-6,
)
def thin_shell_in_motion():
    shell = ThickShell(0.22, 0.5e9)
    time = np.linspace(0.0, 0.125, 11)
    turn = 2 * np.pi * 2 * time
    force = 9e4 * np.stack([1 + 0.2 * np.cos(turn), 0.2 * np.sin(turn)], axis=-1)
    orbit = SMALL.orbit(time, force, 60.0, shell=shell, grid=(72, 24), **MIXED)
    assert float(orbit["eccentricity_ratio"].max()) > 1
    assert float(orbit["minimum_film"].min()) > orbit.attrs["minimum_film_grid_error"]
    return _path(orbit, f"ε ≤ {float(orbit['eccentricity_ratio'].max()):.2f}")


@hard(
    "journal",
    "speed through zero under load in motion, both ways",
    why="the wedge fades and turns round while the squeeze lets the shaft down onto the asperities",
    what="asperities and squeeze stand in every step; the mirrored path is its mirror image, and "
    "ends in the film that it began with",
    tolerance=1e-6,
)
def through_zero_in_motion():
    time = np.linspace(0.0, 400.0, 41)
    speed, load = 2.0 * np.cos(np.pi * time / 400.0), np.tile((2e4, 5e3), (41, 1))
    shares = []
    for rung in ("grid", "reduced"):
        film = Film(**MIXED, contact=ROUGH, rung=rung, grid=(48, 12), inlet=None)
        one = SMALL.orbit(time, load, speed, film)
        other = SMALL.orbit(time, load * (1.0, -1.0), -speed, film)
        films = one["minimum_film"].values
        np.testing.assert_allclose(other["minimum_film"].values, films, rtol=1e-9)
        share = one["contact_share"].values
        assert share.argmax() in (20, 21)  # the squeeze is still going on where the speed is zero
        assert 0.5 < share.max() < 1.0 - 1e-3
        assert share[0] < 1e-6
        assert films.min() > 0.0
        assert abs(films[-1] / films[0] - 1.0) < 1e-3
        shares.append(float(share.max()))
    assert abs(shares[1] / shares[0] - 1.0) < 0.03
    return _path(one, f"share of contact 0 … {shares[0]:.2f} … 0")


@hard(
    "journal",
    "wear deeper than the film",
    why="60 µm off, forty times the film: the shaft lies in its imprint at ε = 1.6",
    what="the worn bore is the gap of film and asperities; the eccentricity has no bound at 1",
)
def worn_deeply():
    bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    deep = ShaftImprint(largest_depth=60e-6, clearance=bearing.clearance)
    angle = 2 * np.pi / 720 * np.arange(720)
    worn = replace(bearing, relief=(Contour(angle.tolist(), deep.depth(angle).tolist()),))
    film = Film(**MIXED, contact=ROUGH, grid=(120, 8))
    speeds = np.array([0.0, 0.1, 10.0])
    state = worn.equilibrium((4e4, 0.0), speeds, film)
    assert np.all(state.eccentricity_ratio > 1.5)
    assert np.all(state.minimum_film > 0.0)
    assert abs(state.contact_share[0] - 1.0) < 1e-6
    # an imprint fits its shaft: at low speed it has no wedge, and its film carries nothing
    assert state.contact_share[1] > 0.95
    assert 0.0 < state.contact_share[2] < 0.5
    assert state.minimum_film[-1] < 0.2 * 60e-6
    shares = ", ".join(f"{share:.2f}" for share in state.contact_share)
    return solved(state, f"ε = {float(state.eccentricity_ratio.max()):.2f}, contact {shares}")


@hard(
    "journal",
    "one pad of a cone unloaded",
    why="the pad has no stiffness but that of its springs, the others share what it leaves",
    what="its row is that of the springs alone; the load at the position leads back to it",
)
def one_unloaded_pad():
    pivot = Pivot(0.6, stiffness=1e9, tilt_stiffness=1e7)
    cone = ConicalBearing(0.5, (1.0, 1.4), 1e-4, pads=5, pad_angle=1.1, pivot=pivot)
    return _without_load(1, cone, (3e-5, 0.0, 0.0))


@hard(
    "journal",
    "half of the pads of a cone unloaded, all on springs that tilt",
    why="a pad without pressure has no stiffness: the matrix of pads is singular there",
    what="an unloaded pad rests on its spring, its row that of the spring alone",
)
def unloaded_pad():
    pivot = Pivot(0.6, stiffness=1e11, tilt_stiffness=1e9)
    cone = ConicalBearing(0.5, (1.0, 1.4), 1e-4, pads=8, pad_angle=0.7, pivot=pivot)
    return _without_load(4, cone, (8e-5, 0.0, 2e-5))


def _without_load(idle, cone, place):
    """The load at a place where `idle` pads carry nothing, and back to the place."""
    film = Film(Lubricant(0.05), Guembel(), grid=(20, 10))
    held = cone.pressure(place, 10.0, film)
    assert int((held.normal_force == 0.0).sum()) == idle
    state = cone.equilibrium(held.force, 10.0, film, moment=held.moment)
    np.testing.assert_allclose(state.eccentricity, place, atol=1e-6 * cone.clearance)
    np.testing.assert_allclose(state.normal_force, held.normal_force, rtol=1e-6, atol=1e-3)
    return solved(state, f"{idle} of {cone.pads} pads carry nothing")
