"""Hard cases of the load distribution of rolling bearings."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from hard_case import hard, refused, solved

from loadflow.rolling import (
    BallBearing,
    FlexibleRings,
    RingBeam,
    RingSection,
    SlewingBearing,
    Support,
    legs,
)

BLADE = SlewingBearing(
    balls=129,
    rows=2,
    ball_diameter=0.040,
    pitch_diameter=1.9,
    groove_radius=0.0205,
    contact_angle=np.pi / 4,
    row_spacing=0.06,
)
LOOSE = replace(BLADE, clearance=1e-4)
GROOVE = BallBearing(
    balls=9, ball_diameter=12.7e-3, pitch_diameter=65e-3, groove_radius=6.604e-3, clearance=15e-6
)


@hard(
    "rolling",
    "1e-3 N on a bearing with clearance",
    why="contact on a handful of balls over a flat valley of positions; the tangent is singular",
    what="start where the elastic energy balances the work; shifted factor of a singular tangent",
)
def feather():
    result = LOOSE.equilibrium(force=[(1e-3, 0, 0), (0, 0, 1e-3), (7e-4, 2e-4, -5e-4)])
    return solved(result, f"largest ball force {float(np.max(result.maximum_force)):.1e} N")


@hard(
    "rolling",
    "moment alone",
    why="no force gives a direction to start from",
    what="the start follows the compliance of the whole ring; all five components balance",
)
def moment_only():
    result = BLADE.equilibrium(force=(0, 0, 0), moment=(3e6, 1e6))
    return solved(result, f"largest ball force {float(result.maximum_force) / 1e3:.1f} kN")


@hard(
    "rolling",
    "from two-point to four-point contact",
    why="balls change diagonal within the series; the tangent jumps",
    what="the energy is convex across the change; steps are halved until it falls",
)
def switching():
    tilt = np.linspace(0, 2e6, 60)
    force = np.stack([0 * tilt, 0 * tilt, 2e6 - tilt], axis=-1)
    tight = replace(BLADE, clearance=-1e-5)
    result = tight.equilibrium(force=force, moment=np.stack([tilt, 0 * tilt], axis=-1))
    both = ((result.ball_forces > 0).all(axis=-2)).sum(axis=(-1, -2))
    assert both.min() < both.max()
    return solved(result, f"{both.min()} to {both.max()} balls in four-point contact")


@hard(
    "rolling",
    "preload lost",
    why="one diagonal of all balls lets go at once",
    what="no memory of the contact: it opens and closes where the energy is least",
)
def preload_lost():
    tight = replace(BLADE, clearance=-4e-5)
    load = np.linspace(0, 3e6, 40)
    result = tight.equilibrium(force=load[:, None] * [0.0, 0.0, 1.0])
    released = (result.ball_forces[..., 1, :] == 0).all(axis=(-1, -2))
    assert not released[0]
    assert released[-1]
    return solved(result, f"let go at {load[released.argmax()] / 1e6:.2f} MN")


@hard(
    "rolling",
    "one loaded ball",
    why="four of five directions have no stiffness",
    what="the free directions stay; singular is reported",
)
def one_ball():
    result = GROOVE.equilibrium(force=(1e-2, 0, 0), moment=(0, 0))
    loaded = int((result.ball_forces > 0).sum())
    assert loaded <= 2
    return solved(result, f"{loaded} ball carries all")


@hard(
    "rolling",
    "1e-3 to 1e9 N in one series",
    why="twelve decades of stiffness; a warm start is useless",
    what="each load is scaled by itself and started cold",
)
def decades():
    load = np.logspace(-3, 9, 25)
    result = BLADE.equilibrium(force=load[:, None] * [0.3, 0.2, 0.93])
    assert np.all(np.diff(result.maximum_force) > 0)
    return solved(result, f"largest force {float(result.maximum_force[-1]):.2e} N")


@hard(
    "rolling",
    "contact ellipse over the shoulder",
    why="Hertz goes on as if the groove had no end",
    what="with a shoulder given the result says whether any ellipse reaches over it",
)
def over_the_shoulder():
    shallow = replace(BLADE, shoulder_angle=np.radians(65))
    result = shallow.equilibrium(force=[(0, 0, 1e5), (0, 0, 3e7)])
    assert list(result.truncated) == [False, True]
    angle = float(np.degrees(result.contact_angles[1].max()))
    return solved(result, f"contact angle {angle:.1f}°, truncated")


@hard(
    "rolling",
    "thin rings that give way by more than a groove is wide",
    why="contacts turn far from their nominal angle; linearised distances are off",
    what="exact distances between the displaced grooves; beyond 90° a named error",
)
def soft_rings():
    section = RingSection(area=4e-3, inertia_axial=2e-8, inertia_radial=2e-8, torsion=2e-8)
    foot = Support(radius=1.0, radial=1e10, tangential=1e10, axial=1e10, sectors=legs(3, 0.2))
    rings = FlexibleRings(outer=RingBeam(section=section, radius=1.0, supports=(foot,)))
    gentle = BLADE.equilibrium(force=(0, 0, 1e6), rings=rings)
    words = refused(lambda: BLADE.equilibrium(force=(0, 0, 1e7), rings=rings), "90°").result
    moved = float(np.abs(gentle.ring_displacement("outer")).max())
    assert moved > 2 * BLADE.groove_radius - BLADE.ball_diameter
    return solved(gentle, f"1 MN carried, ring moved {1e3 * moved:.1f} mm; 10 MN: {words}")
