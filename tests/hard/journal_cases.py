"""Hard cases of the film of a journal bearing."""

from __future__ import annotations

import numpy as np
from hard_case import Outcome, hard, refused, solved

from loadflow.journal import (
    ConstantFlow,
    Contact,
    Film,
    GasMixture,
    Groove,
    Guembel,
    JournalBearing,
    LocalShell,
    Lubricant,
    MassConserving,
    Reynolds,
    Supply,
    ThickShell,
)
from loadflow.tribology import AsperityContact

MAIN = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
OIL = Lubricant(0.05)
MIXED = {"lubricant": OIL, "cavitation": GasMixture(0.05e6), "edge_pressure": 0.5e6}
LOAD = (2.0587e6, 0.4428e6)


@hard(
    "journal",
    "ε = 0.999, position given",
    why="the gap falls to a thousandth of the clearance within a degree; uniform cells miss it",
    what="cells crowd at the narrowest gap; the scaled residual is that of the fluxes",
    tolerance=1e-9,
)
def almost_touching():
    film = MAIN.pressure((0.999 * MAIN.clearance, 0.0), 1.2, OIL, cavitation=Reynolds())
    assert np.isfinite(film.force).all()
    assert film.maximum_pressure > 1e8
    return solved(film, f"p_max = {float(film.maximum_pressure) / 1e6:.0f} MPa")


@hard(
    "journal",
    "load for ε > 0.99",
    why="stiffness grows without bound, a Newton step leaves the clearance",
    what="damped steps that stay inside; a graded mesh where uniform cells do not resolve the gap",
)
def extreme_load():
    state = MAIN.equilibrium((2e9, 0.0), 1.2, **MIXED)
    assert 0.99 < state.eccentricity_ratio < 1
    return solved(state, f"ε = {float(state.eccentricity_ratio):.4f}")


@hard(
    "journal",
    "ε → 0: no load, and 1 µN",
    why="attitude angle without a direction; Sommerfeld number 0",
    what="Cartesian unknowns; the attitude of the unloaded film is its limit π/2",
)
def no_load():
    state = MAIN.equilibrium([(0.0, 0.0), (1e-6, 0.0)], 1.2, lubricant=OIL, edge_pressure=1e5)
    assert np.all(state.eccentricity_ratio < 1e-9)
    assert np.isfinite(state.attitude_angle).all()
    return solved(state, f"ε ≤ {float(np.max(state.eccentricity_ratio)):.1e}")


@hard(
    "journal",
    "ω → 0 under load: 1e-6 rad/s",
    why="So grows as 1/ω, the film becomes some nanometres thin",
    what="start from the closed form, graded mesh, then load steps",
)
def creeping():
    speeds = np.array([1e-3, 1e-6])
    state = MAIN.equilibrium((1e5, 0.0), speeds, **MIXED)
    assert np.all(np.diff(state.eccentricity_ratio) > 0)
    assert np.all(state.eccentricity_ratio < 1)
    return solved(state, f"ε = {', '.join(f'{e:.6f}' for e in state.eccentricity_ratio)}")


@hard(
    "journal",
    "ω = 0 under load",
    why="without rotation and squeeze no film carries",
    what="a named error, or a flagged sample in a series",
)
def at_rest():
    return refused(lambda: MAIN.equilibrium(LOAD, 0.0, **MIXED), "without rotation", "N")


@hard(
    "journal",
    "load reversed within one step of 0.1 s",
    why="the film must empty on one side and fill on the other; Newton starts far off",
    what="implicit steps that are cut, the load interpolated, until Newton holds",
    tolerance=1e-6,
)
def reversal():
    time = np.arange(20) * 0.1
    force = np.where(time[:, None] < 1.0, 1.0, -1.0) * np.array([2e6, 0.0])
    orbit = MAIN.orbit(time, force, 1.2, grid=(48, 12), **MIXED)
    assert float(orbit["eccentricity_ratio"].max()) < 1
    assert np.isfinite(orbit["maximum_pressure"]).all()
    largest = float(orbit["eccentricity_ratio"].max())
    return Outcome(
        f"ε ≤ {largest:.3f}", float(orbit["residual"].max()), int(orbit["iterations"].max())
    )


@hard(
    "journal",
    "axial groove in the loaded zone",
    why="the pressure is cut where it carries",
    what="the groove's cells hold its pressure; ε is larger than without",
)
def loaded_groove():
    groove = Supply([Groove(angle=0.1, arc=0.1, length=1.5, pressure=0.5e6)])
    plain = MAIN.equilibrium(LOAD, 1.2, **MIXED)
    state = MAIN.equilibrium(LOAD, 1.2, supply=groove, **MIXED)
    assert state.eccentricity_ratio > plain.eccentricity_ratio + 0.01
    text = (
        f"ε = {float(state.eccentricity_ratio):.3f}, {float(plain.eccentricity_ratio):.3f} without"
    )
    return solved(state, text)


@hard(
    "journal",
    "mixing constant from 10 % of ambient to 1e-8 of it",
    why="the law tends to one that is not differentiable",
    what="fill as the unknown in the cavity; the answer meets the mass-conserving law",
)
def hardening():
    states = [
        MAIN.equilibrium(LOAD, 1.2, OIL, cavitation=GasMixture(c * 0.5e6), edge_pressure=0.5e6)
        for c in (1e-1, 1e-3, 1e-5, 1e-8)
    ]
    sharp = MAIN.equilibrium(
        LOAD,
        1.2,
        OIL,
        cavitation=MassConserving(),
        edge_pressure=0.5e6,
        grid=(60, 20),
        grading="uniform",
    )
    off = abs(float(states[-1].eccentricity_ratio) - float(sharp.eccentricity_ratio))
    assert off < 1e-5
    assert all(state.converged for state in states)
    worst = max(states, key=lambda state: float(state.residual))
    most = max(int(state.iterations) for state in states)
    return Outcome(f"ε of c → 0 within {off:.0e} of the limit", float(worst.residual), most)


@hard(
    "journal",
    "width to diameter 1e-3 and 50",
    why="cells a ten-thousandth as long as wide; one direction of the flow dominates",
    what="direct band factors do not feel the aspect; closed forms of short and long bearing hold",
)
def slender():
    short = JournalBearing(1.0, 1e-3, 1e-3).pressure(
        (0.25e-3, 0.0), 10.0, OIL, cavitation=Guembel(), inlet=None
    )
    long = JournalBearing(1.0, 50.0, 1e-3).pressure(
        (0.25e-3, 0.0), 10.0, OIL, cavitation=Guembel(), inlet=None
    )
    ocvirk = short_bearing_force(1.0, 1e-3, 1e-3, 0.5, OIL.viscosity, 10.0)
    got = float(np.hypot(*short.force))
    assert abs(got / ocvirk - 1) < 5e-3
    assert long.converged
    return solved(short, f"short bearing within {abs(got / ocvirk - 1):.1e} of Ocvirk")


def short_bearing_force(d, b, psi, ratio, viscosity, speed):
    """Ocvirk's closed form with a half film."""
    unit = viscosity * speed * (d / 2) * b**3 / (4 * (psi * d / 2) ** 2)
    tail = 1 - ratio**2
    return unit * ratio / tail**2 * np.sqrt(16 * ratio**2 + np.pi**2 * tail)


@hard(
    "journal",
    "cells 10⁴ times longer than wide",
    why="iterative solvers stall on stretched cells; the rupture moves by a cell in a Newton step",
    what="direct factors; one step more for each cell around",
)
def stretched():
    disc = JournalBearing(1.0, 50.0, 1e-3)
    film = disc.pressure((0.4e-3, 0.0), 10.0, OIL, cavitation=Reynolds(), grid=(2880, 4))
    return solved(film, f"cells {50.0 / 4 / (np.pi / 2880):.0f} : 1")


@hard(
    "journal",
    "shaft outside the clearance",
    why="the gap is negative",
    what="a named error with ε and the clearance",
)
def outside():
    return refused(
        lambda: MAIN.pressure((1.1 * MAIN.clearance, 0.0), 1.0, OIL), "ε = 1.1", "touches the bore"
    )


@hard(
    "journal",
    "starved supply: a fortieth of the oil that the film draws",
    why="the groove itself ruptures; its pressure cannot follow from its flow",
    what="the fill of the groove becomes its unknown; the flow balances; starved is reported",
)
def starved():
    bearing = JournalBearing(diameter=0.2, width=0.2, relative_clearance=1e-3)
    film = {"lubricant": Lubricant(0.03), "cavitation": MassConserving(), "edge_pressure": 0.0}
    supplies = [
        Supply([Groove(np.pi, arc=0.3, length=0.15, restrictor=ConstantFlow(flow))])
        for flow in (4e-5, 1e-6)
    ]
    full, dry = (bearing.equilibrium((3e4, 0.0), 60.0, supply=s, **film) for s in supplies)
    assert not full.starved
    assert dry.starved
    assert abs(dry.supply_flow / 1e-6 - 1) < 1e-8
    ratios = float(dry.eccentricity_ratio), float(full.eccentricity_ratio)
    return solved(dry, f"ε = {ratios[0]:.3f}, {ratios[1]:.3f} when flooded")


@hard(
    "journal",
    "a shaft so tilted that its edge meets the shell",
    why="the gap is negative at one bearing end only",
    what="a named error with gap, angle and place along the axis",
)
def edge_contact():
    return refused(lambda: MAIN.pressure((0.0, 0.0), 1.2, OIL, tilt=(0.0, 2e-3)), "z =")


@hard(
    "journal",
    "tilt that leaves a twentieth of the clearance at one bearing end",
    why="pressure crowds at one edge; half the width no longer mirrors the other",
    what="the full width is solved; the moment of the film comes with it",
)
def nearly_edge():
    tilt = 0.95 * MAIN.clearance / (0.5 * MAIN.width)
    film = MAIN.pressure(
        (0.0, 0.0), 1.2, OIL, tilt=(0.0, tilt), cavitation=MassConserving(), edge_pressure=0.5e6
    )
    assert np.isfinite(film.force).all()
    return solved(film, f"p_max = {float(film.maximum_pressure) / 1e6:.1f} MPa")


@hard(
    "journal",
    "thin shell: a gap that the pressure opens by more than the clearance",
    why="gap and pressure decide each other; alternating between film and shell diverges",
    what="the shell stands in the Newton matrix of the film, its spread by GMRES; ε passes 1",
)
def soft_shell():
    shells = [None, ThickShell(3.6, 210e9), ThickShell(3.6, 2e9), ThickShell(3.6, 2e8)]
    states = [MAIN.equilibrium((2.6e6, -0.46e6), 1.267, shell=s, **MIXED) for s in shells]
    rigid, steel, _, soft = states
    assert abs(steel.eccentricity_ratio / rigid.eccentricity_ratio - 1) < 1e-3
    assert soft.eccentricity_ratio > 1 > soft.minimum_film / MAIN.clearance > 0.1
    given = soft.shell_deformation / MAIN.clearance
    return solved(soft, f"ε = {float(soft.eccentricity_ratio):.3f}, shell gives {given:.2f} c")


@hard(
    "journal",
    "a shell so soft that its ends meet the shaft",
    why="a shell that gives way locally keeps its ends, where the pressure ends",
    what="a named error with gap, angle and place",
)
def soft_rims():
    shell = LocalShell(8e-10)
    return refused(
        lambda: MAIN.equilibrium((2.6e6, -0.46e6), 1.267, shell=shell, **MIXED),
        "touches the elastic shell",
        "z = 1.125 m",
    )


ROUGH = Contact(AsperityContact(roughness=1e-6, contact_modulus=115e9, factor=1e-3), friction=0.1)


@hard(
    "journal",
    "film thinner than the roughness, to overlapping mean planes",
    why="a smooth gap closes at ε = 1: no film beyond, 1/h³ without bound before it",
    what="asperities share the load, the oil flows through the mean gap that they leave",
)
def thinner_than_rough():
    loads = [[3e7, 0.0], [1e8, 0.0], [1e9, 0.0]]
    state = MAIN.equilibrium(loads, 1e-2, OIL, cavitation=Reynolds(), contact=ROUGH)
    assert np.all(np.diff(state.eccentricity_ratio) > 0)
    assert state.eccentricity_ratio[-1] > 1
    assert np.all(state.minimum_film < ROUGH.roughness)
    assert np.all(state.minimum_film > 0)
    found = f"ε = {float(state.eccentricity_ratio[-1]):.5f}, "
    return solved(state, found + f"h_min/σ = {float(state.minimum_film[-1]) / 1e-6:.3f}")


@hard(
    "journal",
    "ε = 0.999 and 0.9999 with contact, there and back",
    why="film and asperities both stiffen without bound, and their shares change by the nanometre",
    what="cells crowd at the gap; the load of the film and of the asperities at the position found "
    "leads back to it, by each law",
)
def touching_deeply():
    rough = Contact(AsperityContact(roughness=5e-7, contact_modulus=115e9, factor=1e-3))
    worst, shares = [], []
    for law, grid in ((Reynolds(), (60, 12)), (MassConserving(), (60, 12)), (Guembel(), (60, 12))):
        film = Film(OIL, law, 0.5e6, contact=rough, grid=grid)
        for ratio in (0.999, 0.9999):
            place = (ratio * MAIN.clearance, 0.0)
            held = MAIN.pressure(place, 0.1, film)
            state = MAIN.equilibrium(held.force, 0.1, film)
            off = np.hypot(*(state.eccentricity - place)) / MAIN.clearance
            assert off < 1e-6 * (1.0 - ratio)
            assert state.resolved
            assert 0.0 < state.contact_share < 1.0
            worst.append(state)
            shares.append(float(state.contact_share))
    assert shares[1] > shares[0]
    last = max(worst, key=lambda state: float(state.residual))
    return solved(last, f"asperities carry {shares[0]:.1%} and {shares[1]:.1%} of the load")


@hard(
    "journal",
    "speed through zero under load, both ways",
    why="no wedge, no scale of pressure; a smooth film carries nothing at ω = 0",
    what="asperities carry all of the load at standstill, a state like every other",
)
def through_zero():
    speeds = np.array([-0.5, -1e-2, -1e-6, 0.0, 1e-6, 1e-2, 0.5])
    state = MAIN.equilibrium(LOAD, speeds, **MIXED, contact=ROUGH)
    share = state.contact_share
    assert share[3] > 1 - 1e-9
    assert np.all(np.diff(share[:4]) > -1e-9)
    assert np.all(np.diff(share[3:]) < 1e-9)
    return solved(state, f"share of contact {share[0]:.4f} … 1 … {share[-1]:.4f}")
