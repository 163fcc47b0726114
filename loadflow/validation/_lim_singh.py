"""Stiffness matrix of ball and roller bearings in closed form after Lim and Singh.

Given the displacement of the inner ring, forces and the 6 × 6 tangent follow without a solver. The
stiffness of a load distribution is held against it: another derivation, by our own hand.
Equation numbers are those of Kruk's review.

References
----------
Lim, Singh: Vibration transmission through rolling element bearings, part I. J. Sound and Vibration
139 (1990) 179.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.rolling import BallBearing, RollerBearing
from loadflow.validation.check import Check, evidence

Array = NDArray[np.float64]
Held = Callable[..., Any]

ROLLER = RollerBearing(
    rollers=14,
    roller_diameter=11e-3,
    roller_length=11e-3,
    pitch_diameter=60.5e-3,
    slices=1,
    profile="straight",
    contact_angle=0.3,
    clearance=4e-6,
)
BALL = BallBearing(
    balls=9,
    ball_diameter=12.7e-3,
    pitch_diameter=65e-3,
    groove_radius=0.52 * 12.7e-3,
    clearance=15e-6,
)


class RingForces(NamedTuple):
    """Forces of the rolling elements and their tangent.

    `loads` (..., 5) are (Fx, Fy, Fz, Mx, My) on the inner ring that hold the displacement, N and
    N m; `stiffness` (..., 6, 6) is in the order (x, y, z, θx, θy, θz), with zeros for the free
    rotation.
    """

    loads: Array
    stiffness: Array


def lim_singh_ball(
    displacement: ArrayLike,
    azimuth: ArrayLike,
    radius: float,
    constant: float,
    groove_distance: float,
    contact_angle: float = 0.0,
    clearance: float = 0.0,
    exponent: float = 1.5,
) -> RingForces:
    """Forces and stiffness of a row of balls.

    Parameters
    ----------
    displacement : array_like, shape (..., 5)
        (ux, uy, uz, θx, θy) of the inner ring relative to the outer, m and rad.
    azimuth : array_like, shape (ball,)
        Angles ψ of the balls, rad.
    radius : float
        r, radius of the inner ring's groove centres, m.
    constant : float
        K of Q = K δ^n over both contacts, N/m^n.
    groove_distance : float
        A₀, distance of the groove centres at touch, m.
    contact_angle : float
        Unloaded contact angle α₀, rad.
    clearance : float
        Internal clearance on the diameter, m.
    exponent : float
        n.
    """
    q, psi, dr, dz = _ring_motion(displacement, azimuth, radius, clearance)
    r = groove_distance * np.cos(contact_angle) + dr
    z = groove_distance * np.sin(contact_angle) + dz
    distance = np.sqrt(r * r + z * z)
    delta = np.maximum(distance - groove_distance, 0.0)
    # Q/A, and its slope along the line of contact against that across it
    across = constant * delta**exponent / distance
    along = exponent * constant * delta ** (exponent - 1)
    nr, nz = r / distance, z / distance
    turn = along - across
    rr, rz, zz = across + turn * nr * nr, turn * nr * nz, across + turn * nz * nz
    return _assemble(psi, radius, across * r, across * z, rr, rz, zz, q.shape[:-1])


def lim_singh_roller(
    displacement: ArrayLike,
    azimuth: ArrayLike,
    radius: float,
    constant: float,
    contact_angle: float = 0.0,
    clearance: float = 0.0,
    exponent: float = 10 / 9,
) -> RingForces:
    """Forces and stiffness of a row of unsliced rollers; no tilting stiffness for α₀ = 0.

    Parameters
    ----------
    displacement, azimuth, contact_angle, clearance
        As `lim_singh_ball`.
    radius : float
        Pitch radius, m.
    constant, exponent : float
        K and n of Q = K δ^n over both contacts.
    """
    q, psi, dr, dz = _ring_motion(displacement, azimuth, radius, clearance)
    cos, sin = np.cos(contact_angle), np.sin(contact_angle)
    delta = np.maximum(dr * cos + dz * sin, 0.0)
    force = constant * delta**exponent
    slope = exponent * constant * delta ** (exponent - 1) * (delta > 0)
    return _assemble(
        psi, radius, force * cos, force * sin,
        slope * cos * cos, slope * cos * sin, slope * sin * sin, q.shape[:-1],
    )  # fmt: skip


def _ring_motion(
    displacement: ArrayLike, azimuth: ArrayLike, radius: float, clearance: float
) -> tuple[Array, Array, Array, Array]:
    """Radial and axial motion of the inner ring at each element, (..., element)."""
    q, psi = np.asarray(displacement, float), np.asarray(azimuth, float)
    cos, sin, u = np.cos(psi), np.sin(psi), q[..., None, :]
    dr = u[..., 0] * cos + u[..., 1] * sin - clearance / 2
    dz = u[..., 2] + radius * (u[..., 3] * sin - u[..., 4] * cos)
    return q, psi, dr, dz


def _assemble(
    psi: Array,
    radius: float,
    radial: Array,
    axial: Array,
    rr: Array,
    rz: Array,
    zz: Array,
    cases: tuple[int, ...],
) -> RingForces:
    """Sum forces and 2 × 2 stiffnesses in each element's meridian plane over the ring."""
    zero, one = np.zeros_like(psi), np.ones_like(psi)
    out = np.stack([np.cos(psi), np.sin(psi), zero, zero, zero], axis=-1)
    along = np.stack([zero, zero, one, radius * np.sin(psi), -radius * np.cos(psi)], axis=-1)
    loads = radial @ out + axial @ along
    matrix = np.zeros((*cases, 6, 6))
    cross = np.einsum("...j,ja,jb->...ab", rz, out, along)
    matrix[..., :5, :5] = (
        np.einsum("...j,ja,jb->...ab", rr, out, out)
        + np.einsum("...j,ja,jb->...ab", zz, along, along)
        + cross
        + np.swapaxes(cross, -1, -2)
    )
    return RingForces(loads, matrix)


def roller_row(displacement: ArrayLike) -> RingForces:
    """Closed form of `ROLLER`."""
    return lim_singh_roller(
        displacement, ROLLER.contacts().azimuth, 30.25e-3, ROLLER.slice_stiffness, 0.3, 4e-6
    )


def ball_row(displacement: ArrayLike) -> RingForces:
    """Closed form of `BALL`."""
    contacts = BALL.contacts()
    return lim_singh_ball(
        displacement,
        contacts.azimuth,
        contacts.table[0, 0],
        BALL.series_stiffness,
        BALL.groove_distance,
        0.0,
        15e-6,
    )


Row = Callable[[ArrayLike], RingForces]


@evidence("consistency")
def checks() -> Iterator[Check]:
    """Stiffness of a solved load distribution against the closed form at its displacement."""
    source = "Lim and Singh 1990, evaluated by us at the displacement found"
    rows: tuple[tuple[str, Held, Row], ...] = (
        ("ball", BALL.equilibrium, ball_row),
        ("roller", ROLLER.equilibrium, roller_row),
    )
    for name, hold, row in rows:
        load = row([2e-5, 5e-6, 1e-5, 1e-4, -2e-4]).loads  # a load that a single row can hold
        found = hold(force=load[:3], moment=load[3:])
        closed = row(found.displacement).stiffness
        for i, j in ((0, 0), (0, 2), (1, 3), (2, 2), (3, 3), (4, 4)):
            expected, got = float(closed[i, j]), float(found.stiffness[i, j])
            yield Check(f"k_{i + 1}{j + 1}, {name} bearing", source, expected, got, 1e-8)
