"""What the rollers of one row go through: speeds, loads, inertia and weight of each, over time.

Rollers sit where an ideal cage carries them. Signs as in `loadflow.rolling.kinematics`.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated

import numpy as np
from annotated_types import Ge, Gt, Lt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.kinematics import Value
from loadflow.rolling.motion.crank import CrankDrive
from loadflow.rolling.motion.radial_load import LineLaw, radial_distribution
from loadflow.rolling.rings.equilibrium import FlexibleRingForces

if TYPE_CHECKING:
    from loadflow.rolling.results import ContactResult
    from loadflow.rolling.roller_raceways import RollerRaceways

Array = NDArray[np.float64]

STEEL_DENSITY = 7850.0  # kg/m³
GRAVITY = 9.81  # m/s²
_APPROACH = 0.9  # power of the load that the approach of a roller is


@dataclass(frozen=True, kw_only=True)
class RollerRow:
    """One row of rollers as their motion sees it.

    Attributes
    ----------
    rollers : int
        Number of rollers.
    roller_diameter, roller_length, pitch_diameter : float
        m.
    contact_angle : float
        From the radial plane, rad.
    roller_mass : float, optional
        kg; a steel cylinder's if not given.

    Raises
    ------
    InputError
        If a field is out of its range.
    """

    rollers: Annotated[int, Ge(1)]
    roller_diameter: Annotated[float, Gt(0)]
    roller_length: Annotated[float, Gt(0)]
    pitch_diameter: Annotated[float, Gt(0)]
    contact_angle: Annotated[float, Ge(0), Lt(math.pi / 2)] = 0.0
    roller_mass: Annotated[float, Gt(0)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        if self.pitch_diameter <= self.roller_diameter:
            raise InputError(
                f"pitch_diameter: must be > the roller diameter {self.roller_diameter:g} m, "
                f"got {self.pitch_diameter:g}"
            )

    @classmethod
    def of(cls, bearing: RollerRaceways) -> RollerRow:
        """Any row of `bearing`."""
        return cls(
            rollers=bearing.rollers,
            roller_diameter=bearing.roller_diameter,
            roller_length=bearing.roller_length,
            pitch_diameter=bearing.pitch_diameter,
            contact_angle=bearing.contact_angle,
        )

    @property
    def radius(self) -> float:
        """ρ, m."""
        return self.roller_diameter / 2

    @property
    def gamma(self) -> float:
        """D_w cos α/D_pw."""
        return self.roller_diameter * math.cos(self.contact_angle) / self.pitch_diameter

    @property
    def mass(self) -> float:
        """Of a roller, kg."""
        if self.roller_mass is not None:
            return self.roller_mass
        return STEEL_DENSITY * math.pi * self.radius**2 * self.roller_length

    @property
    def inertia(self) -> float:
        """J = m ρ²/2 of a roller about its axis, kg m²."""
        return self.mass * self.radius**2 / 2

    @property
    def raceways(self) -> tuple[float, float]:
        """Diameters d and D of the raceways at the contacts, m."""
        return self.pitch_diameter * (1 - self.gamma), self.pitch_diameter * (1 + self.gamma)

    @property
    def places(self) -> Array:
        """Places of the rollers in the cage, 2πj/z, rad."""
        return 2 * np.pi * np.arange(self.rollers) / self.rollers

    def cage_speed(self, inner_speed: Value, outer_speed: Value) -> Value:
        """Ideal speed of the cage, rad/s."""
        return ((1 - self.gamma) * inner_speed + (1 + self.gamma) * outer_speed) / 2

    def surface_speed(self, inner_speed: Value, outer_speed: Value) -> Value:
        """Speed of both raceways as seen from the contacts, with its sign, m/s."""
        return (inner_speed - outer_speed) * self.pitch_diameter * (1 - self.gamma**2) / 4


@dataclass(frozen=True, kw_only=True)
class RollerHistory:
    """Loads and speeds of all rollers of a row over time; between samples they change linearly.

    Attributes
    ----------
    row : RollerRow
        The row.
    time : ndarray, shape (n,)
        Rising, s.
    inner_speed, outer_speed : ndarray, shape (n,)
        rad/s.
    load : ndarray, shape (n, roller)
        R ≥ 0 that the rings press the roller with, N.
    outward : ndarray, shape (n, roller)
        Force of inertia and weight toward the outer ring (negative: the inner), N.
    tangential : ndarray, shape (n, roller)
        Mass times tangential acceleration less weight, in the positive sense of turning, N.

    Raises
    ------
    InputError
        If shapes do not fit, time does not rise, values are not finite, or a load is negative.
    """

    row: RollerRow
    time: Array
    inner_speed: Array
    outer_speed: Array
    load: Array
    outward: Array
    tangential: Array

    def __post_init__(self) -> None:
        n, shape = self.time.shape[0], (self.time.shape[0], self.row.rollers)
        for name in ("inner_speed", "outer_speed"):
            _check(name, getattr(self, name), (n,))
        for name in ("load", "outward", "tangential"):
            _check(name, getattr(self, name), shape)
        if n < 2 or not (np.diff(self.time) > 0).all():
            raise InputError("time: two or more rising samples are needed")
        if (self.load < 0).any():
            raise InputError(f"load: must be ≥ 0 N, got {self.load.min():g}")

    def followed(self, every: int) -> RollerHistory:
        """Return the history of every so many of its rollers, from the first one on.

        Rollers do not act on one another, so that those left move as they do among all.
        """
        load, outward, tangential = (
            np.ascontiguousarray(each[:, ::every])
            for each in (self.load, self.outward, self.tangential)
        )
        row = replace(self.row, rollers=load.shape[1])
        return replace(self, row=row, load=load, outward=outward, tangential=tangential)

    @property
    def cage_speed(self) -> Array:
        """Ideal speed of the cage, rad/s."""
        return np.asarray(self.row.cage_speed(self.inner_speed, self.outer_speed))

    @property
    def surface_speed(self) -> Array:
        """Speed of the raceways at the contacts, m/s."""
        return np.asarray(self.row.surface_speed(self.inner_speed, self.outer_speed))

    @property
    def ideal_spin(self) -> Array:
        """Spin of a roller against the cage without slip, rad/s."""
        return self.surface_speed / self.row.radius

    @property
    def turns_of_cage(self) -> Array:
        """Turns of the cage from the start, either way."""
        return np.abs(turned(self.time, self.cage_speed)) / (2 * np.pi)


def _check(name: str, values: Array, shape: tuple[int, ...]) -> None:
    if values.shape != shape:
        raise InputError(f"{name}: shape {shape} is needed, got {values.shape}")
    if not np.isfinite(values).all():
        raise InputError(f"{name}: must be finite")


def turned(time: Array, speed: Array) -> Array:
    """Angle turned from the start, rad, by the trapezoidal rule."""
    steps = np.diff(time) * (speed[1:] + speed[:-1]) / 2
    return np.concatenate([[0.0], np.cumsum(steps)])


def radial_history(
    row: RollerRow,
    time: ArrayLike,
    inner_speed: ArrayLike,
    force: ArrayLike,
    clearance: float,
    law: LineLaw,
    *,
    direction: ArrayLike = 0.0,
    gravity: float = 0.0,
) -> RollerHistory:
    """Rollers of a bearing under a radial load, outer ring at rest (von Hollen's main bearing).

    Parameters
    ----------
    row : RollerRow
        Rollers.
    time : array_like, shape (n,)
        s.
    inner_speed, force, direction : array_like, shape (n,) or ()
        rad/s; N; angle of the load, rad. A negative force acts the other way.
    clearance : float
        Diametral, m.
    law : LineLaw
        Of both contacts together.
    gravity : float
        m/s², along angle 0; von Hollen neglects it.
    """
    t = np.asarray(time, float)
    speed, load, angle = (
        np.broadcast_to(np.asarray(x, float), t.shape) for x in (inner_speed, force, direction)
    )
    rest = np.zeros_like(t)
    cage = np.asarray(row.cage_speed(speed, rest))
    place = turned(t, cage)[:, None] + row.places
    side = np.where(load < 0, np.pi, 0.0)
    rollers = radial_distribution(
        np.abs(load), place - (angle + side)[:, None], clearance, law
    ).loads
    outward, tangential = _carried(row, t, cage, place, gravity)
    return RollerHistory(
        row=row, time=t, inner_speed=speed, outer_speed=rest, load=rollers, outward=outward,
        tangential=tangential,
    )  # fmt: skip


def bearing_histories(
    result: ContactResult[RollerRaceways],
    time: ArrayLike,
    speed: ArrayLike,
    *,
    down: float = -math.pi / 2,
    gravity: float = GRAVITY,
) -> list[RollerHistory]:
    """Rollers of each row of a bearing under a load series, outer ring at rest.

    The rings move, and bend where they are flexible, as under rollers that stand still, which for
    many rollers is as good; each roller's load is that at its own place in the turning cage.

    Parameters
    ----------
    result : ContactResult
        Load distribution, cases (n,).
    time : array_like, shape (n,)
        s.
    speed : array_like, shape (n,) or ()
        Of the inner ring, rad/s.
    down : float
        Direction of gravity, angle from x toward y, rad.
    gravity : float
        m/s².

    Raises
    ------
    InputError
        If the times do not fit the cases, or do not rise.
    """
    bearing, t = result.bearing, np.asarray(time, float)
    if result.cases != t.shape:
        raise InputError(f"time: shape {result.cases} of the load cases is needed, got {t.shape}")
    row = RollerRow.of(bearing)
    omega = np.broadcast_to(np.asarray(speed, float), t.shape)
    rest = np.zeros_like(t)
    cage = np.asarray(row.cage_speed(omega, rest))
    angle = turned(t, cage)
    flexible = isinstance(result.elements, FlexibleRingForces)
    forces = _between_places(result, angle) if flexible else _between_rigid_rings(result, angle)
    outward, tangential = _carried(row, t, cage, angle[:, None] + row.places - down, gravity)
    return [
        RollerHistory(
            row=row, time=t, inner_speed=omega, outer_speed=rest,
            load=np.ascontiguousarray(forces[:, i]), outward=outward, tangential=tangential,
        )
        for i in range(bearing.rows)
    ]  # fmt: skip


def _between_rigid_rings(result: ContactResult[RollerRaceways], angle: Array) -> Array:
    """Loads (n, row, roller), N, of rollers that a cage has turned by `angle` (n,)."""
    from loadflow.rolling import _forces

    shift, cos, sin = result.displacement.copy(), np.cos(angle), np.sin(angle)
    for i, j in ((0, 1), (3, 4)):  # as the cage sees it
        x, y = result.displacement[:, i], result.displacement[:, j]
        shift[:, i], shift[:, j] = cos * x + sin * y, cos * y - sin * x
    around_cos, around_sin, spans, table, *_ = result.contacts.arguments
    return np.asarray(
        _forces.row_forces(shift, around_cos, around_sin, spans, table, result.bearing.rows)
    )


def _between_places(result: ContactResult[RollerRaceways], angle: Array) -> Array:
    """Loads as of `_between_rigid_rings`, from those at the places of rollers that stand.

    Rings that bend are known there alone. In between the approach, load^0.9, goes in a line.
    """
    forces = result.roller_forces
    count = forces.shape[-1]
    passed = angle * count / (2 * np.pi)
    whole = np.floor(passed)
    first = (whole[:, None].astype(int) + np.arange(count)) % count
    approach = forces**_APPROACH
    before, after = (
        np.take_along_axis(approach, at[:, None], axis=-1) for at in (first, (first + 1) % count)
    )
    part = (passed - whole)[:, None, None]
    return np.asarray(((1 - part) * before + part * after) ** (1 / _APPROACH))


def crank_history(
    row: RollerRow,
    drive: CrankDrive,
    time: ArrayLike,
    speed: float,
    load: ArrayLike,
) -> RollerHistory:
    """Rollers of a crank-pin bearing, seen from the pin: the outer ring (the rod) turns.

    Parameters
    ----------
    row : RollerRow
        Rollers.
    drive : CrankDrive
        Gives the swing of the rod and the inertia of the rollers.
    time : array_like, shape (n,)
        s; top dead centre at 0.
    speed : float
        Of the crank, rad/s.
    load : array_like, shape (n, roller)
        Roller loads, N (`radial_distribution` of `CrankDrive.pin_loads`).
    """
    t = np.asarray(time, float)
    phi = speed * t
    inner, outer = row.raceways
    inertia = drive.roller_inertia(phi[:, None], speed, row.mass, inner, outer, row.places)
    return RollerHistory(
        row=row, time=t, inner_speed=np.zeros_like(t), outer_speed=drive.swing(phi, speed).speed,
        load=np.asarray(load, float), outward=-inertia.radial, tangential=inertia.tangential,
    )  # fmt: skip


def _carried(
    row: RollerRow, time: Array, cage: Array, place: Array, gravity: float
) -> tuple[Array, Array]:
    """Outward force along the contact normal, and tangential need, of rollers in the cage, N.

    `place` are angles from the direction of gravity.
    """
    pitch, weight = row.pitch_diameter / 2, row.mass * gravity
    centrifugal = row.mass * pitch * cage**2
    outward = (centrifugal[:, None] + weight * np.cos(place)) * math.cos(row.contact_angle)
    swing = row.mass * pitch * np.gradient(cage, time)
    return outward, swing[:, None] + weight * np.sin(place)
