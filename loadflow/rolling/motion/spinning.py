"""Ball bearings at speed: centrifugal force and gyroscopic moment of every ball, after Harris.

A ball then meets both rings at different angles. The loads of inertia are dead loads within one
equilibrium and follow its contact angles from one to the next, with control by the outer raceway
(λ_i = 0, λ_o = 2). The stiffness counts how they follow, and is not symmetric: they have no
potential. Source: [Harris and Kotzalas 2006], Advanced Concepts, ch. 2 (speeds), ch. 3 (forces).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import rounding_level, unresolved
from loadflow.rolling.contacts import HEIGHT, NORMAL_R, NORMAL_Z, RADIUS, Contacts, Raceway
from loadflow.rolling.equilibrium import FormedStiffness, RingEquilibrium

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways

Array = NDArray[np.float64]

STEEL_DENSITY = 7850.0
# A lightly pressed ball swings along its groove in steps that its small approach to it bounds.
_INNER_STEPS, _ROUNDS, _HALVINGS = 500, 50, 30
_SPHERE = 0.1  # moment of inertia of a sphere over m D²
_WANTED, _ALLOWED = 1e-8, 1e-4  # change of the loads of inertia over the largest load


@dataclass(frozen=True)
class Spin:
    """Balls of a bearing at speed; arrays (..., row, ball).

    Attributes
    ----------
    inner_forces, outer_forces : ndarray
        Contact forces at both raceways, N.
    inner_angles, outer_angles : ndarray
        Contact angles from the radial plane, rad.
    centrifugal : ndarray
        Centrifugal force, N.
    gyroscopic : ndarray
        Gyroscopic moment, N m.
    """

    inner_forces: Array
    outer_forces: Array
    inner_angles: Array
    outer_angles: Array
    centrifugal: Array
    gyroscopic: Array

    @property
    def forces(self) -> Array:
        """Contact forces at the inner raceway, N, (..., row, ball)."""
        return self.inner_forces

    @property
    def angles(self) -> Array:
        """Contact angles at the inner raceway, rad, (..., row, ball)."""
        return self.inner_angles

    def _at(self, raceway: Raceway) -> Array:
        return self.inner_forces if raceway == "inner" else self.outer_forces

    def largest(self, raceway: Raceway) -> Array:
        """Largest force of each row at a raceway, N, (..., row)."""
        return np.asarray(self._at(raceway).max(axis=-1))

    def power_sums(self, raceway: Raceway) -> Array:
        """Sums of the forces, their cubes and 10/3 powers, (..., row, 3)."""
        force = self._at(raceway)
        return np.stack([(force**power).sum(axis=-1) for power in (1, 3, 10 / 3)], axis=-1)

    def grouped(self, groups: int) -> Array:
        """Forces on the balls, N, (..., row, ball)."""
        return self.inner_forces


@dataclass(frozen=True)
class _Balls:
    """Balls in their grooves, as numbers."""

    inner_gap: float  # r_i - D/2
    outer_gap: float
    inner: float  # stiffness factors, N/m^1.5
    outer: float
    diameter: float
    pitch: float
    mass: float

    @property
    def least(self) -> Array:
        """A stiffness far below that of any contact: a ball without load stays where it is, N/m."""
        return 1e-9 * self.outer * self.outer_gap**0.5 * np.eye(2)


def spin_equilibrium(
    bearing: BallRaceways,
    contacts: Contacts,
    rest: RingEquilibrium,
    speed: ArrayLike,
    *,
    density: float = STEEL_DENSITY,
    tolerance: float = 1e-8,
    max_iterations: int = 100,
) -> tuple[RingEquilibrium, Spin]:
    """Equilibrium of rings and balls with the inertia of the balls.

    Parameters
    ----------
    bearing : BallRaceways
        The bearing; its outer ring stands still.
    contacts : Contacts
        Its contacts.
    rest : RingEquilibrium
        Equilibrium without inertia, where the iteration starts.
    speed : array_like
        Of the inner ring, rad/s; broadcasts with the load cases.
    density : float
        Of the balls, kg/m³.
    tolerance : float
        Largest residual of the rings, as in `solve`.
    max_iterations : int
        Newton steps allowed between two updates of the loads of inertia.

    Returns
    -------
    RingEquilibrium, Spin
        The rings, and the balls.

    Raises
    ------
    InputError
        If the speed is not finite.
    SolverError
        If balls or rings do not come to rest, or the loads of inertia of a ball that is about to
        leave the inner ring do not converge within 1e-4 of the largest load.
    """
    shape = rest.displacement.shape[:-1]
    omega = np.abs(np.broadcast_to(np.asarray(speed, float), shape)).reshape(-1)
    if not np.isfinite(omega).all():
        raise InputError("speed: must be finite")
    diameter = bearing.ball_diameter
    balls = _Balls(
        inner_gap=bearing.groove("inner") - diameter / 2,
        outer_gap=bearing.groove("outer") - diameter / 2,
        inner=bearing.contact_stiffness or float(bearing.raceway_contact("inner").stiffness),
        outer=bearing.contact_stiffness or float(bearing.raceway_contact("outer").stiffness),
        diameter=diameter,
        pitch=bearing.pitch_diameter,
        mass=density * np.pi / 6 * diameter**3,
    )
    load = np.concatenate([rest.force, rest.moment], axis=-1).reshape(-1, 5)
    q = rest.displacement.reshape(-1, 5).copy()
    jacobian, free = _directions(contacts), contacts.table[:, [NORMAL_R, NORMAL_Z]]
    scale = contacts.scale
    reference = np.maximum(np.abs(load * scale).max(axis=1), 1e-12)
    reach = free[None, :, None] + np.einsum("kbij,nj->nkbi", jacobian, q)
    seat = reach * balls.outer_gap / np.hypot(*np.moveaxis(reach, -1, 0))[..., None]
    angles = (_angle(reach),) * 2
    push = np.zeros_like(reach)
    total = 0
    for turn in range(_ROUNDS):
        fresh, centrifugal, gyroscopic = _inertia(balls, omega[:, None, None], *angles)
        change = np.abs(fresh - push).max(axis=(1, 2, 3)) / reference
        push = fresh if turn < 8 else (push + fresh) / 2  # lightly loaded balls may swing
        for _ in range(max_iterations):
            reach = free[None, :, None] + np.einsum("kbij,nj->nkbi", jacobian, q)
            seat, pull, tangent, outer = _seats(balls, reach, push, seat, 1e-11 * reference)
            rest_load = load - np.einsum("kbij,nkbi->nj", jacobian, pull)
            hessian = np.einsum("kbia,nkbij,kbjc->nac", jacobian, tangent, jacobian, optimize=True)
            residual = np.abs(rest_load * scale).max(axis=1) / reference
            terms = np.einsum("kbij,nkbi->nj", np.abs(jacobian), np.abs(pull)) * scale
            rounding = rounding_level(terms.max(axis=1) / reference)
            small = residual <= np.maximum(tolerance, rounding)
            if small.all():
                break
            total += 1
            scaled = hessian * scale[:, None] * scale
            trace = np.trace(scaled, axis1=1, axis2=2)
            # where no ball touches the inner ring, it goes along the load
            shift = np.where(trace > 0, 1e-10 * trace, reference / contacts.cap)
            scaled += shift[:, None, None] * np.eye(5)
            step = np.linalg.solve(scaled, (rest_load * scale)[..., None])[..., 0]
            longest = np.abs(step).max(axis=1, keepdims=True)
            step *= np.minimum(1, 0.3 * contacts.cap / np.maximum(longest, 1e-300))
            q += step * scale
        away = reach - seat
        angles = _angle(away), _angle(seat)
        if (change <= _WANTED).all() and small.all():
            break
    if (change > _ALLOWED).any() or not small.all():
        worst = int(np.argmax(np.where(small, 0.0, residual) + change))
        raise SolverError(
            f"spinning balls: case {worst} at {omega[worst]:g} rad/s: "
            f"{unresolved(residual[worst], rounding[worst], total)}; "
            f"change of inertia {change[worst]:.3g}"
        )
    tangent = _slope(balls, omega[:, None, None], reach, push, seat)
    stiffness = np.einsum("kbia,nkbij,kbjc->nac", jacobian, tangent, jacobian, optimize=True)
    full = (*shape, *reach.shape[1:3])
    spin = (np.hypot(*np.moveaxis(pull, -1, 0)), outer, *angles, centrifugal, gyroscopic)
    rings = replace(
        rest,
        displacement=q.reshape(*shape, 5),
        form_stiffness=FormedStiffness(stiffness.reshape(*shape, 5, 5)),
        residual=residual.reshape(shape),
        iterations=np.full(shape, total),
        converged=np.full(shape, True),
    )
    return rings, Spin(*(np.broadcast_to(v, reach.shape[:3]).reshape(full) for v in spin))


def _directions(contacts: Contacts) -> Array:
    """Motion (r, z) of the inner groove centre at each ball from that of the ring, (k, b, 2, 5)."""
    cos, sin = np.cos(contacts.azimuth), np.sin(contacts.azimuth)
    zero = np.zeros_like(cos)
    rows = []
    for line in contacts.table:
        radius, height = line[RADIUS], line[HEIGHT]
        out = np.stack([cos, sin, zero, -height * sin, height * cos], axis=-1)
        up = np.stack([zero, zero, zero + 1, radius * sin, -radius * cos], axis=-1)
        rows.append(np.stack([out, up], axis=1))
    return np.array(rows)


def _inertia(balls: _Balls, omega: Array, inner: Array, outer: Array) -> tuple[Array, Array, Array]:
    """Dead load (r, z) on each ball, centrifugal force, gyroscopic moment.

    Balls roll on both raceways and do not spin on the outer one, so that across the axis they turn
    with the orbital speed times sin α_o d_m/D. With outer raceway control the friction that holds
    the gyroscopic moment acts there alone, so that the inner ring feels none of it.
    """
    ratio = balls.diameter / balls.pitch
    orbit = omega * (1 - ratio * np.cos(inner)) / (1 + np.cos(inner - outer))
    centrifugal = balls.mass * balls.pitch / 2 * orbit**2
    friction = 4 * _SPHERE * centrifugal * np.sin(outer)
    push = np.stack([centrifugal - friction * np.sin(outer), friction * np.cos(outer)], axis=-1)
    return push, centrifugal, friction * balls.diameter / 2


def _inertia_slopes(balls: _Balls, omega: Array, inner: Array, outer: Array) -> tuple[Array, Array]:
    """Derivatives of the dead load (r, z) by the inner and by the outer contact angle, N/rad."""
    push, centrifugal, _ = _inertia(balls, omega, inner, outer)
    ratio = balls.diameter / balls.pitch
    apart = np.tan((inner - outer) / 2)
    by_inner = ratio * np.sin(inner) / (1 - ratio * np.cos(inner)) + apart  # of log orbital speed
    turned = np.stack([-np.sin(2 * outer), np.cos(2 * outer)], axis=-1)
    return (
        2 * by_inner[..., None] * push,
        -2 * apart[..., None] * push + 4 * _SPHERE * centrifugal[..., None] * turned,
    )


def _seats(
    balls: _Balls, reach: Array, push: Array, seat: Array, quiet: Array
) -> tuple[Array, Array, Array, Array]:
    """Ball centres at rest, force on the inner ring and its slope, outer contact forces.

    Everything counts from the outer groove centre; `reach` is the inner one. A ball that does not
    touch the inner ring lies where its dead load points; of the others Newton's method from `seat`
    with a cap on the step, until `quiet` (N) or nothing more moves.
    """
    limit = 0.2 * (balls.inner_gap + balls.outer_gap)
    dead = np.hypot(push[..., 0], push[..., 1])
    lies = (balls.outer_gap + (dead / balls.outer) ** (2 / 3)) / np.maximum(dead, 1e-300)
    alone = push * lies[..., None]
    apart = reach - alone
    open_ = (dead > 0) & (np.hypot(apart[..., 0], apart[..., 1]) <= balls.inner_gap)
    b = np.where(open_[..., None], alone, seat)
    at = _unbalanced(balls, reach, push, b)
    for _ in range(_INNER_STEPS):
        wrong, h_inner, h_outer, outer, energy = at
        hessian = h_inner + h_outer + balls.least
        step = np.linalg.solve(hessian, wrong[..., None])[..., 0]
        size = np.hypot(step[..., 0], step[..., 1])
        settled = size <= 1e-14 * balls.outer_gap
        left = np.abs(wrong).max(axis=-1)
        if (settled | (left <= quiet[:, None, None])).all():
            break
        share = np.minimum(1.0, 0.1 * limit / np.maximum(size, 1e-300))
        fall = 1e-4 * (wrong * step).sum(axis=-1)
        for _ in range(_HALVINGS):
            at = _unbalanced(balls, reach, push, b + share[..., None] * step)
            held = (at[4] <= energy - share * fall) | (np.abs(at[0]).max(axis=-1) <= left)
            if held.all():
                break
            share = np.where(held, share, 0.5 * share)
        b = b + share[..., None] * step
    else:
        raise SolverError(
            f"spinning balls: a ball does not come to rest, {left.max():.3g} N unbalanced"
        )
    pull = wrong - push + _spring(balls.outer, balls.outer_gap, b)[0]
    tangent = h_inner - h_inner @ np.linalg.solve(hessian, h_inner)
    return b, pull, tangent, outer


def _unbalanced(
    balls: _Balls, reach: Array, push: Array, b: Array
) -> tuple[Array, Array, Array, Array, Array]:
    """Unbalanced force on each ball at `b`, both slopes, outer contact forces, and potential."""
    pull, h_inner, inner = _spring(balls.inner, balls.inner_gap, reach - b)
    back, h_outer, outer = _spring(balls.outer, balls.outer_gap, b)
    stored = inner ** (5 / 3) / balls.inner ** (2 / 3) + outer ** (5 / 3) / balls.outer ** (2 / 3)
    energy = 0.4 * stored - (push * b).sum(axis=-1)
    return pull - back + push, h_inner, h_outer, outer, energy


def _slope(balls: _Balls, omega: Array, reach: Array, push: Array, seat: Array) -> Array:
    """Slope of the force on the inner ring, the ball and its inertia in balance, (..., 2, 2)."""
    away = reach - seat
    _, h_inner, h_outer, _, _ = _unbalanced(balls, reach, push, seat)
    by_inner, by_outer = _inertia_slopes(balls, omega, _angle(away), _angle(seat))
    moved = h_inner + by_inner[..., :, None] * _turning(away)[..., None, :]
    held = h_outer - by_outer[..., :, None] * _turning(seat)[..., None, :] + balls.least
    return np.asarray(h_inner - h_inner @ np.linalg.solve(moved + held, moved))


def _angle(vector: Array) -> Array:
    """Angle of (r, z) from the radial plane, rad."""
    return np.asarray(np.arctan2(vector[..., 1], vector[..., 0]))


def _turning(vector: Array) -> Array:
    """Derivative of that angle by (r, z), rad/m."""
    across = np.stack([-vector[..., 1], vector[..., 0]], axis=-1)
    return np.asarray(across / np.square(vector).sum(axis=-1, keepdims=True))


def _spring(stiffness: float, gap: float, vector: Array) -> tuple[Array, Array, Array]:
    """Force along `vector` when longer than `gap`, its Hessian, and its size."""
    length = np.hypot(vector[..., 0], vector[..., 1])
    unit = vector / length[..., None]
    delta = np.maximum(length - gap, 0.0)
    force = stiffness * delta**1.5
    slope = 1.5 * stiffness * np.sqrt(delta)
    along = unit[..., :, None] * unit[..., None, :]
    across = np.eye(2) - along
    hessian = slope[..., None, None] * along + (force / length)[..., None, None] * across
    return force[..., None] * unit, hessian, force
