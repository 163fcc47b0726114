"""Hard cases of the motion of rollers and cages."""

from __future__ import annotations

import numpy as np
from hard_case import hard, refused, solved

from loadflow.rolling import FrictionOptions, RollerBearing
from loadflow.rolling.friction import DragConstants
from loadflow.rolling.motion.cage import CageRim, cage_orbit
from loadflow.rolling.motion.history import RollerHistory, RollerRow, radial_history
from loadflow.rolling.motion.radial_load import behw_law
from loadflow.rolling.motion.rollers import coulomb_motion, film_motion
from loadflow.rolling.motion.skidding import roller_slip
from loadflow.tribology import lubricant

ROW = RollerRow(
    rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3,
    roller_mass=11e-3,
)  # fmt: skip
OPTIONS = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=363.15, roller_drag=1e-6)
LAW = behw_law(11e-3)


@hard(
    "roller motion",
    "rollers under 1 N to 4 kN torn up to speed in one sample",
    why="the rate of the slip runs from 0.4 to 4e13 1/s; explicit steps blow up above 200 N",
    what="L-stable implicit steps; slip by bounded Newton from within the core",
    tolerance=1e-7,
)
def stiffness():
    time = np.linspace(0, 0.2, 201)
    load = np.broadcast_to(np.logspace(0, np.log10(4e3), 14), (201, 14))
    zero = np.zeros((201, 14))
    history = RollerHistory(
        row=ROW, time=time, inner_speed=np.where(time > 0, 100.0, 0.0), outer_speed=np.zeros(201),
        load=load, outward=zero + 0.6, tangential=zero,
    )  # fmt: skip
    motion = film_motion(history, OPTIONS)
    slip = motion.slip[-1]
    assert (np.diff(slip) < 1e-9).all()
    assert slip.min() > -1e-9
    assert slip[-1] < 1e-5
    return solved(motion.convergence, f"slip {slip[0]:.0%} at 1 N, {slip[-1]:.0e} at 4 kN")


@hard(
    "roller motion",
    "load reversed through zero: all rollers free, then torn up on the other side",
    why="zone and direction jump; the step that meets a roller decides what it loses",
    what="each roller has steps of its own, as short as its error asks for",
    tolerance=1e-7,
)
def reversal():
    time = np.linspace(0, 0.2, 401)
    force = 2e3 * np.sin(100 * time)
    history = radial_history(ROW, time, 100.0, force, 8e-6, LAW)
    motions = [film_motion(history, OPTIONS, tolerance=t) for t in (3e-4, 1e-6)]
    assert np.abs(motions[0].slip - motions[1].slip).max() < 2e-3
    assert motions[0].slip_power_density.max() > 1e6
    return solved(motions[0].convergence, f"largest slip {motions[0].maximum_slip:.0%}")


@hard(
    "roller motion",
    "a bearing that stops, stands and turns back",
    why="ideal spin, films and thermal loading vanish; slip over spin is 0/0",
    what="signed speeds throughout; friction of asperities alone is left at rest",
    tolerance=1e-7,
)
def turning_back():
    time = np.linspace(0, 8, 401)
    speed = np.clip(3 - time, -2, 2) * (np.abs(time - 3) > 0.5)
    history = radial_history(ROW, time, speed, 500.0, 8e-6, LAW, gravity=9.81)
    film = film_motion(history, OPTIONS)
    exact = coulomb_motion(history, DragConstants(1e-6, 0.0), pocket="braking")
    assert np.isfinite(film.spin).all()
    assert np.isfinite(exact.slip).all()
    loaded = history.load > 100
    assert np.abs(film.slip_speed[loaded]).max() < 0.02 * 0.0149 * 2
    return solved(film.convergence, f"spin {film.spin.min():.2f} to {film.spin.max():.2f} rad/s")


@hard(
    "roller motion",
    "free rollers that elastic films cannot drive",
    why="a vanishing Hertzian strip: resistance of the film exceeds its traction, the roller stops",
    what="rolling resistance, like the pocket, brakes to rest and no further",
    tolerance=1e-7,
)
def stopped():
    options = FrictionOptions(
        oil=OPTIONS.oil, temperature=323.15, film="hamrock", roughness=1e-12, roller_drag=8e-6
    )
    time = np.linspace(0, 0.5, 1001)
    history = radial_history(ROW, time, 100.0, 2e3, 8e-6, LAW)
    motion = film_motion(history, options)
    assert motion.spin.min() > -1e-3 * history.ideal_spin[0]
    return solved(motion.convergence, f"largest slip {motion.maximum_slip:.1%}")


@hard(
    "roller motion",
    "cage on its rim at ε = 0.98 and beyond",
    why="So grows as (1 - ε²)^-2, its squeeze as ^-5/2; explicit steps leave the clearance",
    what="-ln(1 - ε) as the unknown of a stiff integrator",
    tolerance=1e-4,
)
def cage():
    rim = CageRim(width=4e-3, bore=63e-3, diameter=62.85e-3, viscosity=10.6e-3)
    time = np.linspace(0, 0.06, 61)
    turn = 2 * np.pi * time / 0.06
    force = 1e3 * np.stack([1 + 0.5 * np.cos(turn), 0.5 * np.sin(turn)], axis=-1)
    orbit = cage_orbit(rim, time, force, 60.0, 100.0)
    assert orbit.minimum_gap.min() > 0
    ratio = orbit.eccentricity_ratio.max()
    assert ratio > 0.98
    return solved(orbit.convergence, f"ε ≤ {ratio:.4f}")


@hard(
    "roller motion",
    "times of another length than the load cases",
    why="a series of loads and its clock that do not belong together broadcast silently",
    what="a named error with both shapes",
)
def wrong_clock():
    pair = RollerBearing(
        rollers=14, roller_diameter=11e-3, roller_length=11e-3, pitch_diameter=60.5e-3
    )
    result = pair.equilibrium(force=np.tile([1e3, 0, 0], (5, 1)))
    return refused(
        lambda: roller_slip(result, np.arange(4.0), 1.0, OPTIONS), "time", "(5,)", "(4,)"
    )
