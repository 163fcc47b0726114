"""Equilibrium with ball centres and every patch as unknowns: reference of the condensed solver.

The static state of § 3 of [Ritzer 2018] written down as it stands: rigid motion of the inner ring's
structure, all three coordinates of each ball centre (Ritzer's springs along the groove are as
good as none), all modes of each ring; four contacts at each ball, each with the stiffness of its
own raceway; F = K ⟨|b - c| - (r - R_w)⟩^1.5 between ball centre b and groove centre c. Slow and
dense, for small bearings.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import SolverError
from loadflow.rolling.contacts import Array
from loadflow.rolling.equilibrium import solve
from loadflow.rolling.raceways import Raceway
from loadflow.rolling.rings.condensation import rigid_basis
from loadflow.rolling.rings.coupling import PointCoupling
from loadflow.rolling.rings.flexible import FlexibleRings
from loadflow.rolling.rings.patches import patch_points

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways


@dataclass(frozen=True)
class ReferenceState:
    """Displacement (5,) of the inner ring and forces on both raceways, (2, kind, ball)."""

    displacement: Array
    forces: Array
    residual: float
    iterations: int


def reference_equilibrium(
    bearing: BallRaceways,
    rings: FlexibleRings,
    force: ArrayLike,
    moment: ArrayLike = (0.0, 0.0),
    tolerance: float = 1e-9,
) -> ReferenceState:
    """Solve one load case without any condensation; see the module.

    Raises
    ------
    SolverError
        If Newton's iteration does not converge.

    Examples
    --------
    >>> from loadflow.rolling import FlexibleRings, RingBeam, RingSection, SlewingBearing, Support
    >>> from benchmarks.references.whole_rings import reference_equilibrium
    >>> bearing = SlewingBearing(balls=12, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> wall = Support.wall(radius=0.3, height=0.06, thickness=0.03, length=0.3)
    >>> outer = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.3, supports=(wall,))
    >>> rings = FlexibleRings(outer=outer)
    >>> whole = reference_equilibrium(bearing, rings, (0.0, 0.0, 5e4))
    >>> ours = bearing.equilibrium((0.0, 0.0, 5e4), rings=rings)
    >>> bool(abs(whole.displacement[2] / ours.displacement[2] - 1) < 0.01)
    True
    """
    contacts = bearing.contacts()
    kinds, balls = len(contacts.table), bearing.balls
    count = kinds * balls
    shift, start, stiffness = _geometry(bearing, rings)
    size = shift.shape[-1]
    x = np.zeros(size)
    load = np.zeros(size)
    load[:5] = np.concatenate([np.asarray(force, float), np.asarray(moment, float)])
    load[:5] *= contacts.scale
    free = np.repeat(
        [bearing.groove(r) - bearing.ball_diameter / 2 for r in ("inner", "outer")], count
    )
    given = bearing.contact_stiffness
    factor = np.repeat(
        [given or float(bearing.raceway_contact(r).stiffness) for r in ("inner", "outer")], count
    )
    rigid = solve(contacts, force, moment).displacement / contacts.scale
    x[:5] = rigid
    soft = np.diag(stiffness)

    def state(x: Array) -> tuple[float, Array, Array, Array]:
        vector = start + shift @ x  # (2 count, 3), from ball centre to groove centre
        length = np.linalg.norm(vector, axis=1)
        normal = vector / length[:, None]
        delta = np.maximum(length - free, 0)
        pull = factor * delta**1.5
        along = np.einsum("kc,kcn->kn", normal, shift)
        gradient = along.T @ pull + soft @ x
        slope = 1.5 * factor * np.sqrt(delta) - pull / length
        hessian = (along.T * slope) @ along + soft
        hessian += np.einsum("kcn,k,kcm->nm", shift, pull / length, shift, optimize=True)
        energy = 0.4 * (pull * delta).sum() + x @ soft @ x / 2 - load @ x
        return energy, load - gradient, hessian, pull

    energy, rest, hessian, pull = state(x)
    weight = 1 / np.maximum(np.abs(shift).max(axis=(0, 1)), 1e-300)
    largest = np.abs(load[:5]).max()
    for iteration in range(200):
        residual = float(np.abs(rest * weight).max() / largest)
        if residual <= tolerance:
            return ReferenceState(x[:5] * contacts.scale, pull.reshape(2, kinds, balls),
                                  residual, iteration)  # fmt: skip
        scale = np.sqrt(np.diag(hessian) + 1e-9 * np.diag(hessian)[:5].max() / weight**2)
        scaled = hessian / np.outer(scale, scale) + 1e-12 * np.eye(size)
        step = np.linalg.solve(scaled, rest / scale) / scale
        step *= min(1.0, contacts.cap / np.abs(shift @ step).max())
        for _ in range(30):
            trial = state(x + step)
            if trial[0] <= energy + 1e-12 * abs(energy):
                break
            step /= 2
        x = x + step
        energy, rest, hessian, pull = trial
    raise SolverError(f"no reference equilibrium: residual {residual:.3g} after 200 steps")


def _geometry(bearing: BallRaceways, rings: FlexibleRings) -> tuple[Array, Array, Array]:
    """Shift of all contact vectors by the unknowns, their start, stiffness of the unknowns.

    Unknowns: five rigid, (r, θ, z) of each ball centre, then the modes of each flexible ring.
    Contacts: all of the inner ring, then all of the outer one. In the frame (r, θ, z) of each ball.
    """
    contacts = bearing.contacts()
    kinds, balls = len(contacts.table), bearing.balls
    rows, count = kinds // 2, kinds * balls
    parts = []
    names: tuple[Raceway, Raceway] = ("inner", "outer")
    for side, name in enumerate(names):
        ring = getattr(rings, name)
        if ring is not None:
            points = patch_points(bearing, name, contacts.azimuth, rings.shell)
            parts.append((side, ring.flexibility(points)))
    first = 5 + 3 * rows * balls
    size = first + sum(factor.shape[-1] for _, factor in parts)
    shift = np.zeros((2, kinds, balls, 3, size))
    places = PointCoupling(bearing).places
    basis = rigid_basis(places, contacts).reshape(3, kinds, balls, 5)
    shift[0, ..., :5] = np.moveaxis(basis, 0, 2)
    for kind in range(kinds):
        for ball in range(balls):
            centre = 5 + 3 * (kind // 2 * balls + ball)
            shift[:, kind, ball, :, centre : centre + 3] = -np.eye(3)
    stiffness = np.zeros(size)
    stiffness[first:] = 1
    for side, factor in parts:
        shift[side, ..., first : first + factor.shape[-1]] = factor
        first += factor.shape[-1]
    # the ball starts midway between both groove centres of each diagonal
    half = contacts.table[:, [2, 3]] / 2
    start = np.zeros((2, kinds, balls, 3))
    for side, sign in enumerate((1, -1)):
        start[side, ..., 0] = sign * half[:, None, 0]
        start[side, ..., 2] = sign * half[:, None, 1]
    return shift.reshape(2 * count, 3, size), start.reshape(2 * count, 3), stiffness
