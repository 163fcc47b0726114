"""What carries the rotor and how it yields: spin, bending of the tower, torsion of the drivetrain.

Few coordinates: 0 is the angle of the generator, referred to the rotor; then the fore-aft and
side-side motion of the tower top, m; last the twist of the drivetrain, rad, by which the rotor is
ahead of the generator. Each moves the rotor apex and turns the axes of the rotor in proportion.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.turbines import Turbine

from .options import RotorOptions

Array = NDArray[np.float64]
_GRAVITY = 9.80665
_FINE = 2001


class Frame(NamedTuple):
    """Coordinates of what carries the rotor, ``h`` in number; SI."""

    reach: Array  # (h, 6): displacement of the apex and rotation in the shaft frame, per unit
    carries: Array  # (h,): 1 where the nacelle moves, 0 where only the rotor turns in it
    twist: int  # place of the twist; 0: the drivetrain is rigid
    mass: Array  # (h, h): all but the blades
    stiffness: Array  # (h, h)
    damping: Array  # (h, h)
    load: Array  # (h,): weight of the nacelle


def frame(turbine: Turbine, options: RotorOptions) -> Frame:
    """Coordinates that the options ask for.

    Raises
    ------
    InputError
        The tower shall move, but the file of the turbine does not say how it bends.
    """
    rotor, drivetrain = turbine.rotor, turbine.drivetrain
    spin = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    modes = _tower_modes(turbine) if options.tower_motion else []
    twists = options.drivetrain_torsion and drivetrain.torsional_stiffness > 0
    reach = np.array([spin, *(mode.reach for mode in modes), *([spin] if twists else [])])
    count = reach.shape[0]
    carries = np.zeros(count)
    carries[1 : 1 + len(modes)] = 1.0

    generator = drivetrain.generator_inertia * drivetrain.gear_ratio**2
    move, turn = reach[:, :3], reach[:, 3]
    mass = rotor.hub_mass * move @ move.T + rotor.hub_inertia * np.outer(turn, turn)
    mass[0, 0] += generator
    # the generator turns faster than the nacelle rolls by the gear ratio
    roll = generator / drivetrain.gear_ratio * turn * carries
    mass[0] += roll
    mass[:, 0] += roll
    stiffness, damping, load = np.zeros((count, count)), np.zeros((count, count)), np.zeros(count)
    for j, mode in enumerate(modes, start=1):
        mass[j, j] += mode.mass
        stiffness[j, j], damping[j, j], load[j] = mode.stiffness, mode.damping, mode.load
    if twists:
        stiffness[-1, -1] = drivetrain.torsional_stiffness
        damping[-1, -1] = drivetrain.torsional_damping
    return Frame(reach, carries, count - 1 if twists else 0, mass, stiffness, damping, load)


def calmed(f: Frame) -> Frame:
    """The frame with a tower whose motion dies out within seconds."""
    critical = 2 * np.sqrt(f.stiffness * f.mass) * np.diag(f.carries)
    return f._replace(damping=np.maximum(f.damping, critical))


class _TowerMode(NamedTuple):
    reach: Array  # (6,)
    mass: float  # tower and nacelle
    stiffness: float
    damping: float
    load: float


def _tower_modes(turbine: Turbine) -> list[_TowerMode]:
    """First fore-aft and side-side mode."""
    rotor, tower = turbine.rotor, turbine.tower
    bending = tower.bending
    if bending is None:
        raise InputError(
            f"rung = 'tower': the file of {turbine.name} has no table tower.bending; describe it, "
            "or take the rung 'flap'"
        )
    height = np.linspace(bending.height[0], tower.height, _FINE)
    density = np.interp(height, bending.height, bending.mass_density)
    weight = _GRAVITY * (turbine.rotor_mass + bending.nacelle_mass + mass_above(density, height))
    # apex seen from the tower top, ground frame
    ahead, above = -rotor.overhang * np.cos(rotor.tilt), rotor.hub_height - tower.height
    modes = []
    for kind in ("fore_aft", "side_side"):
        along = kind == "fore_aft"
        rigidity = np.interp(height, bending.height, getattr(bending, f"{kind}_stiffness"))
        shape, slope, curvature = mode_shape(getattr(bending, kind), height)
        top_slope = slope[-1]
        own = np.trapezoid(density * shape**2, height)
        elastic = np.trapezoid(rigidity * curvature**2, height)
        # the nacelle is a point; tilting forward moves what lies behind the tower axis down
        behind = bending.nacelle_downwind if along else 0.0
        square = (1 + top_slope * bending.nacelle_above) ** 2 + (top_slope * behind) ** 2
        # weight pulls what tilts; that of the rotor acts on its sections, in axes that tilt:
        # there the tower top would feel it along the shaft, though it moves level
        stiffness = elastic - np.trapezoid(weight * slope**2, height)
        stiffness -= bending.nacelle_mass * _GRAVITY * bending.nacelle_above * top_slope**2
        stiffness += turbine.rotor_mass * _GRAVITY * top_slope
        move = (
            [1 + top_slope * above, 0, -top_slope * ahead]
            if along
            else [0, 1 + top_slope * above, 0]
        )
        turn = [0, top_slope, 0] if along else [-top_slope, 0, 0]
        modes.append(
            _TowerMode(
                reach=np.concatenate([_in_shaft_frame(v, rotor.tilt) for v in (move, turn)]),
                mass=own + bending.nacelle_mass * square,
                stiffness=stiffness,
                damping=2 * bending.damping * np.sqrt(elastic * own),
                load=bending.nacelle_mass * _GRAVITY * top_slope * behind,
            )
        )
    return modes


def mode_shape(coefficients: tuple[float, ...], height: Array) -> tuple[Array, Array, Array]:
    """Deflection, slope and curvature of a mode over the height, from foot to top."""
    length = height[-1] - height[0]
    x = ((height - height[0]) / length)[:, None]
    powers = np.arange(2, 2 + len(coefficients))
    c = np.array(coefficients) / sum(coefficients)
    return (
        x**powers @ c,
        x ** (powers - 1) @ (c * powers) / length,
        x ** (powers - 2) @ (c * powers * (powers - 1)) / length**2,
    )


def mass_above(density: Array, height: Array) -> Array:
    """Mass of the tower above each height."""
    piece = 0.5 * (density[1:] + density[:-1]) * np.diff(height)
    return np.append(np.cumsum(piece[::-1])[::-1], 0.0)


def _in_shaft_frame(vector: list[float], tilt: float) -> Array:
    """A vector of the ground frame in the shaft frame."""
    x, y, z = vector
    c, s = np.cos(tilt), np.sin(tilt)
    return np.array([x * c - z * s, y, x * s + z * c])
