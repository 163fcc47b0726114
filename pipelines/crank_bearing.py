"""The friction source's bearing: rollers on the crank pin of an engine, driven without gas force.

Loads of the pin, spin of every roller with Coulomb friction and with films, gap of the cage in the
rod; then the friction torque of the whole rig over speed in its three configurations: rollers on
the pin, a journal bearing there, and a straight shaft. Masses and the journal bearing are not given
by the source; the masses are of a 1.8 l engine. Run with ``python pipelines/crank_bearing.py``.
"""

from __future__ import annotations

import math

import numpy as np

from loadflow.journal import JournalBearing
from loadflow.rolling import FrictionOptions, friction
from loadflow.rolling.kinematics import common_period
from loadflow.rolling.motion.cage import CageRim, cage_orbit
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.history import RollerHistory, RollerRow, crank_history
from loadflow.rolling.motion.radial_load import behw_law, radial_distribution
from loadflow.rolling.motion.rollers import coulomb_motion, film_motion
from loadflow.studies.one_bearing.crank_rig import CrankRig
from loadflow.tribology import lubricant

DRIVE = CrankDrive(
    radius=42.5e-3, rod_length=143.5e-3, piston_mass=0.4, rod_mass=0.6, rod_centre=43e-3
)
ROW = RollerRow(
    rollers=18, roller_diameter=7.5e-3, roller_length=18e-3, pitch_diameter=55.5e-3,
    roller_mass=6.67e-3,
)  # fmt: skip
CLEARANCE, CAGE_MASS = 25e-6, 30e-3  # m, diametral; kg
GAPS = friction.RollerGaps(
    radius=ROW.radius,
    length=ROW.roller_length,
    end_gaps=(0.33e-3, 0.33e-3),
    rib_gaps=(0.473e-3, 0.473e-3),
    pocket_gaps=(0.06e-3, 0.06e-3),
    rib_height=0.0,  # thrust washers instead
    cage_half_height=2.5625e-3,
    pocket_angle=math.radians(43.1),
    roughness=5e-6,
    pitch_diameter=ROW.pitch_diameter,
)
OPTIONS = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=363.15, roughness=0.3e-6)
VISCOSITY = float(OPTIONS.oil.viscosity(OPTIONS.temperature))


def pin_history(rpm: float, step: float = 2.0) -> RollerHistory:
    """Loads and speeds until crank and cage stand as before, in steps of `step` degrees."""
    inner, outer = ROW.raceways
    turns, _ = common_period(outer, inner)  # the outer ring drives
    omega = rpm * math.pi / 30
    time = np.linspace(0, turns * 60 / rpm, round(turns * 360 / step) + 1)
    load = DRIVE.pin_loads(omega * time, omega).crank
    cage = outer / (outer + inner) * DRIVE.swing(omega * time, omega).angle
    direction = np.arctan2(load[:, 0], load[:, 1])  # from the crank's arm
    place = (cage - direction)[:, None] + ROW.places
    rollers = radial_distribution(
        np.hypot(*load.T), place, CLEARANCE, behw_law(ROW.roller_length)
    ).loads
    return crank_history(ROW, DRIVE, time, omega, rollers)


def cage_gap(rpm: float) -> float:
    """Least gap between cage and rod, m."""
    omega = rpm * math.pi / 30
    time = np.linspace(0, 60 / rpm, 181)
    ring = DRIVE.swing(omega * time, omega).speed
    force = friction.cage_inertia_force(CAGE_MASS, ROW.rollers, ROW.mass, DRIVE.radius, omega)
    rim = CageRim(width=4e-3, bore=63e-3, diameter=62.85e-3, viscosity=VISCOSITY)
    orbit = cage_orbit(rim, time, (float(force), 0.0), 21 / 37 * ring, ring)
    return float(orbit.minimum_gap.min())


def main(speeds: tuple[float, ...] = (2000, 3000, 4000)) -> list[tuple[float, ...]]:
    """Print and return slip and gap at each speed (1/min)."""
    ratio = 21 / 37
    coulomb = friction.coulomb_drag_constants(GAPS, VISCOSITY, ratio, 0.12, 0.04, driving="outer")
    plain = friction.drag_constants(GAPS, VISCOSITY, ratio)
    rows = []
    print("1/min   largest roller load, N   mean slip: Coulomb   films   cage gap, μm")
    for rpm in speeds:
        history = pin_history(rpm)
        first = coulomb_motion(history, coulomb, driving="outer", periodic=True)
        second = film_motion(history, OPTIONS, drag=plain, periodic=True)
        row = (
            rpm, history.load.max(), first.slip.mean(), second.slip.mean(), cage_gap(rpm) * 1e6,
        )  # fmt: skip
        rows.append(row)
        print("{:5.0f} {:24.0f} {:20.3f} {:7.3f} {:14.2f}".format(*row))
    return rows


CONFIGURATIONS = {
    "rollers": CrankRig(drive=DRIVE),
    "journal": CrankRig(
        drive=DRIVE,
        pin_film=JournalBearing(diameter=48e-3, width=18e-3, relative_clearance=1e-3),
    ),
    "straight shaft": CrankRig(drive=None),
}


def torques(speeds: tuple[float, ...] = (500, 1000, 2000, 3000)) -> list[tuple[float, ...]]:
    """Print and return the torque of each configuration (N m) at each speed (1/min)."""
    rows = []
    print("1/min   " + "   ".join(f"{name}, N m" for name in CONFIGURATIONS))
    for rpm in speeds:
        found = [rig.friction_torque(rpm).torque for rig in CONFIGURATIONS.values()]
        rows.append((rpm, *found))
        print(f"{rpm:5.0f} {found[0]:14.3f} {found[1]:14.3f} {found[2]:21.3f}")
    return rows


if __name__ == "__main__":
    main()
    torques()
