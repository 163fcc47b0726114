"""Friction torque of a row of rollers whose motion is known: every loss, and their sum.

Losses of stage 1 (Coulomb) are (5.36)–(5.43) of von Hollen 2013, those of stage 2 (films)
(5.104)–(5.109) with the loss of slip, which von Hollen leaves out. The torque is the mean power
over the speed, (7.2).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.rolling.friction import coulomb
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.friction.roller_drag import DragConstants
from loadflow.rolling.kinematics import contact_speeds
from loadflow.rolling.motion.rollers import RollerMotion, film_arguments, film_numbers

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FrictionTorque:
    """Mean losses of something that turns, and the torque that drives them.

    Attributes
    ----------
    losses : mapping of str to float
        Mean power of each part, W.
    speed : float
        That the torque is meant at, rad/s, > 0: of the shaft that is driven.

    Examples
    --------
    >>> from loadflow.rolling.motion.torque import FrictionTorque
    >>> one = FrictionTorque({"rolling": 2.0, "drag": 3.0}, 100.0)
    >>> both = one + FrictionTorque({"seal": 5.0}, 100.0)
    >>> both.power, both.torque, both.torques["seal"]
    (10.0, 0.1, 0.05)
    """

    losses: Mapping[str, float] = field(default_factory=dict)
    speed: float = 1.0

    def __post_init__(self) -> None:
        if not (np.isfinite(self.speed) and self.speed > 0):
            raise InputError(f"speed = {self.speed} rad/s: must be > 0")

    @property
    def power(self) -> float:
        """All losses, W."""
        return float(sum(self.losses.values()))

    @property
    def torque(self) -> float:
        """N m, (7.2)."""
        return self.power / self.speed

    @property
    def torques(self) -> dict[str, float]:
        """Share of each part, N m."""
        return {name: loss / self.speed for name, loss in self.losses.items()}

    def __add__(self, other: FrictionTorque) -> FrictionTorque:
        """Losses of both; parts of one name add up. Both are meant at one speed."""
        if abs(other.speed - self.speed) > 1e-9 * self.speed:
            raise InputError(f"speeds {self.speed} and {other.speed} rad/s differ")
        names = [*self.losses, *(n for n in other.losses if n not in self.losses)]
        parts = {n: self.losses.get(n, 0.0) + other.losses.get(n, 0.0) for n in names}
        return FrictionTorque(parts, self.speed)

    def named(self, prefix: str) -> FrictionTorque:
        """The same with `prefix` and a blank before each part."""
        return FrictionTorque({f"{prefix} {n}": p for n, p in self.losses.items()}, self.speed)


def coulomb_torque(
    motion: RollerMotion,
    drag: DragConstants,
    speed: float,
    *,
    adhesion: float = 0.12,
    sliding: float = 0.04,
    rolling: float = 5e-4,
    driving: Literal["inner", "outer"] = "inner",
    pocket: coulomb.Variant = "physics",
) -> FrictionTorque:
    """Losses of rollers that move with Coulomb friction (stage 1), after one turn of the cage.

    Parameters
    ----------
    motion : RollerMotion
        Of `coulomb_motion`.
    drag : DragConstants
        C₁ and C₃₂ of one roller: its moment times its spin is lost, (5.42).
    speed : float
        Of the shaft, rad/s.
    adhesion, sliding, rolling : float
        μ, μ′ and μ_R.
    driving : {"inner", "outer"}
        Ring that turns.
    pocket : {"physics", "printed"}
        Friction at the cage as it is, or with the μ′² of von Hollen, (5.40).

    Raises
    ------
    InputError
        An unknown choice, or a speed that is not positive.

    Examples
    --------
    >>> from loadflow.rolling.friction import DragConstants
    >>> from loadflow.rolling.motion.history import RollerRow, radial_history
    >>> from loadflow.rolling.motion.radial_load import behw_law
    >>> from loadflow.rolling.motion.rollers import coulomb_motion
    >>> row = RollerRow(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
    ...     pitch_diameter=60.5e-3)
    >>> time, drag = np.linspace(0.0, 0.3, 600), DragConstants(7.84e-6, -6.52e-7)
    >>> history = radial_history(row, time, 104.7, 2e3, 8e-6, behw_law(11e-3))
    >>> found = coulomb_torque(coulomb_motion(history, drag), drag, 104.7)
    >>> sorted(found.losses)
    ['drag', 'pocket', 'rolling', 'sliding']
    """
    history = motion.history
    row = history.row
    # N and U as von Hollen counts them: radial inertia outward, tangential against the turning
    radial, around = history.outward, history.tangential
    push = np.asarray(coulomb.cage_force(radial, around, 0.0, adhesion, sliding, driving))
    spin = np.abs(motion.spin)
    # of the roller itself: it turns against the cage if the inner ring drives, with it if the outer
    sense = -1.0 if driving == "inner" else 1.0
    own = np.abs(spin + sense * np.abs(history.cage_speed)[:, None])
    slip = np.abs(history.ideal_spin)[:, None] - spin
    turning = history.inner_speed - history.outer_speed
    held = np.abs(drag.spin * motion.spin + drag.orbit * turning[:, None])
    args = history.load, radial, push
    parts = {
        "rolling": coulomb.rolling_loss(*args, own, row.radius, rolling, sliding),
        "sliding": coulomb.sliding_loss(*args, np.abs(slip), row.radius, sliding),
        "pocket": coulomb.pocket_loss(push, spin, row.radius, sliding, pocket),
        "drag": held * spin,
    }
    return FrictionTorque(_means(motion, parts), speed)


def film_torque(
    motion: RollerMotion,
    options: FrictionOptions,
    speed: float,
    *,
    drag: DragConstants | None = None,
    sliding: float = 0.04,
) -> FrictionTorque:
    """Losses of rollers that move with friction of films (stage 2), after one turn of the cage.

    Parameters
    ----------
    motion : RollerMotion
        Of `film_motion` with the same options, drag and friction of the pockets.
    options, drag, sliding
        As there.
    speed : float
        Of the shaft, rad/s.

    Raises
    ------
    InputError
        A speed that is not positive.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions
    >>> from loadflow.rolling.motion.history import RollerRow, radial_history
    >>> from loadflow.rolling.motion.radial_load import behw_law
    >>> from loadflow.rolling.motion.rollers import film_motion
    >>> from loadflow.tribology import lubricant
    >>> row = RollerRow(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
    ...     pitch_diameter=60.5e-3)
    >>> history = radial_history(row, np.linspace(0.0, 0.3, 300), 104.7, 2e3, 8e-6, behw_law(11e-3))
    >>> oil = FrictionOptions(oil=lubricant("crankshaft-5w-30"), temperature=363.15)
    >>> found = film_torque(film_motion(history, oil), oil, 104.7)
    >>> sorted(found.losses)
    ['drag', 'pocket', 'rolling', 'slip']
    """
    from loadflow.rolling.motion import _motion_kernels as kernels

    history, row = motion.history, motion.history.row
    numbers = film_numbers(row, options, drag, sliding)
    _, surface, turning, *rest = film_arguments(history)
    found = kernels.forces(numbers, surface, turning, *rest, motion.spin)  # type: ignore[call-arg]
    v = contact_speeds(
        history.inner_speed[:, None], history.outer_speed[:, None], history.cage_speed[:, None],
        motion.spin, *row.raceways,
    )  # fmt: skip
    spin_drag, orbit_drag = numbers.spin_drag, numbers.orbit_drag  # type: ignore[attr-defined]
    held = np.abs(spin_drag * motion.spin + orbit_drag * turning[:, None])
    steps = np.gradient(history.time)[:, None]
    along = np.stack(np.broadcast_arrays(v.mean_inner, v.mean_outer), axis=-1)
    parts = {
        "rolling": 2 * np.abs(found[..., 2:4] * along).sum(axis=-1),
        "slip": motion.slip_energy / steps,
        "pocket": np.abs(found[..., 6] * motion.spin),
        "drag": held * np.abs(motion.spin),
    }
    return FrictionTorque(_means(motion, parts), speed)


def _means(motion: RollerMotion, parts: Mapping[str, object]) -> dict[str, float]:
    """Mean power of all rollers over the samples that have forgotten their start."""
    after = motion.settled if motion.settled.any() else slice(None)
    return {
        name: float(np.sum(np.asarray(power, float)[after], axis=1).mean())
        for name, power in parts.items()
    }


def measured_torque(force: ArrayLike, velocity: ArrayLike, speed: float) -> float:
    """Friction torque that a driven crank rig measures, N m, (7.1), (7.2).

    Parameters
    ----------
    force : array_like, shape (n,)
        On the piston along its travel, N, at even steps over whole turns of the crank: inertia has
        no mean power, so that what is left is friction.
    velocity : array_like, shape (n,)
        Of the piston, m/s, in the sense of the force.
    speed : float
        Of the crank, rad/s, > 0.

    Raises
    ------
    InputError
        Series that differ in length, are empty or not finite; a speed that is not positive.

    Examples
    --------
    >>> angle = np.linspace(0.0, 40 * np.pi, 7200, endpoint=False)  # 20 turns, samples every 1°
    >>> velocity = 4.25 * np.sin(angle)
    >>> inertia, friction = -900.0 * np.cos(angle), 3.0 * velocity
    >>> round(measured_torque(inertia + friction, velocity, 100.0), 4)  # 3 · 4.25²/2/100
    0.2709
    """
    push, moving = np.asarray(force, float), np.asarray(velocity, float)
    if push.ndim != 1 or push.shape != moving.shape or not push.size:
        raise InputError(f"force {push.shape} and velocity {moving.shape}: one length is needed")
    if not (np.isfinite(push).all() and np.isfinite(moving).all()):
        raise InputError("force, velocity: must be finite")
    return FrictionTorque({"rig": float(np.mean(push * moving))}, speed).torque
