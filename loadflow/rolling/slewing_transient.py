"""Motion of a slewing bearing into its rest: the multibody rung of [Ritzer 2018], § 3.1.

The inner ring with its structure has mass, contacts and rings have damping; the rings themselves
are their static modes (Guyan), whose inertia is left out. What comes to rest is the equilibrium of
`SlewingBearing.equilibrium`; the way there depends on damping, which the source gives no value for.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import numpy as np
from annotated_types import Gt
from numpy.typing import ArrayLike

from loadflow.errors import SolverError
from loadflow.rolling.contact import STIFFNESS, Array, Contacts
from loadflow.rolling.equilibrium import broadcast_loads
from loadflow.rolling.options import check_fields
from loadflow.rolling.rings import FlexibleRings, RingModes, ring_modes

if TYPE_CHECKING:
    from loadflow.rolling.slewing import SlewingBearing


@dataclass(frozen=True, kw_only=True)
class Inertia:
    """What moves with the inner ring, and how motion is damped.

    Attributes
    ----------
    mass : float
        Of the inner ring and its structure, kg.
    radius : float
        Radius of gyration about the tilt axes, m.
    contact_damping : float
        C_max of (3.2) over K √step, s, K the stiffness of both contacts of a ball in series; the
        √step gives the source's numeric rule its units.
    step : float
        Penetration at which the damping of a contact is fully on, m (3.1).
    ring_damping : float
        Time constant of the material damping of the ring modes, s.

    Raises
    ------
    InputError
        If a field is not positive.
    """

    mass: Annotated[float, Gt(0)]
    radius: Annotated[float, Gt(0)]
    contact_damping: Annotated[float, Gt(0)] = 1e-3
    step: Annotated[float, Gt(0)] = 10e-6
    ring_damping: Annotated[float, Gt(0)] = 1e-4

    def __post_init__(self) -> None:
        check_fields(self)


@dataclass(frozen=True)
class Transient:
    """Motion over `time` (n,): displacement (n, 5), largest contact force (n,) and its rest.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s.
    displacement : ndarray, shape (n, 5)
        (ux, uy, uz, θx, θy), m and rad.
    largest_force : ndarray, shape (n,)
        N, without its damping.
    residual : float
        Largest unbalanced component at the end over the largest load.
    """

    time: Array
    displacement: Array
    largest_force: Array
    residual: float


def settle(
    bearing: SlewingBearing,
    rings: FlexibleRings,
    inertia: Inertia,
    force: ArrayLike,
    moment: ArrayLike = (0.0, 0.0),
    *,
    duration: float = 0.5,
    tolerance: float = 1e-8,
) -> Transient:
    """Let a bearing come to rest under a load put on at once.

    Parameters
    ----------
    bearing, rings
        See `SlewingBearing.equilibrium`.
    inertia : Inertia
        Mass and damping.
    force, moment : array_like, shape (3,) and (2,)
        Load on the inner ring, N and N m.
    duration : float
        Time given, s.
    tolerance : float
        Relative tolerance of the integration.

    Returns
    -------
    Transient
        The motion.

    Raises
    ------
    SolverError
        If the integration fails.
    """
    from scipy.integrate import solve_ivp

    from loadflow.rolling import _ring_kernels

    contacts = bearing.contacts()
    modes = ring_modes(bearing, rings, 0.0)
    f, m = broadcast_loads(force, moment)
    load = np.zeros(modes.size)
    load[:5] = np.concatenate([f, m]) * contacts.scale
    mass = inertia.mass * np.array([1, 1, 1, *[(inertia.radius / contacts.lever) ** 2] * 2])
    system = _System(contacts, modes, inertia)

    def rate(_: float, state: Array) -> Array:
        x, speed = state[: modes.size], state[modes.size :]
        pull, damper = system.forces(x)
        rest = load - pull
        # modes without mass: (damping of material and contacts) ȧ = what is left over
        coupled = damper[5:, 5:] + inertia.ring_damping * np.eye(modes.size - 5)
        mode_speed = np.linalg.solve(coupled, rest[5:] - damper[5:, :5] @ speed)
        drag = damper[:5, :5] @ speed + damper[:5, 5:] @ mode_speed
        return np.concatenate([speed, mode_speed, (rest[:5] - drag) / mass])

    start = np.zeros(modes.size + 5)
    answer = solve_ivp(rate, (0, duration), start, "LSODA", rtol=tolerance, atol=1e-12)
    if not answer.success:
        raise SolverError(f"the motion could not be followed: {answer.message}")
    states = np.ascontiguousarray(answer.y[: modes.size].T)
    largest = _ring_kernels.contact_state(states, modes.basis, contacts.table, modes.local)[0]
    pull, _ = system.forces(states[-1])
    return Transient(
        answer.t,
        states[:, :5] * contacts.scale,
        largest.max(axis=1),
        float(np.abs((load - pull)[:5]).max() / max(np.abs(load).max(), 1e-300)),
    )


@dataclass(frozen=True)
class _System:
    """Elastic forces and damping matrix of the contacts in any state."""

    contacts: Contacts
    modes: RingModes
    inertia: Inertia

    def forces(self, x: Array) -> tuple[Array, Array]:
        """Elastic force on all unknowns, damping matrix of the contacts."""
        from loadflow.rolling import _ring_kernels

        basis, table = self.modes.basis, self.contacts.table
        count, size = basis.shape[1:]
        push, pull = np.zeros((3, count)), np.zeros(size)
        slope, across, angle = np.zeros((3, count))
        _ring_kernels.evaluate(x, basis, table, self.modes.local, push, slope, across, angle, pull)
        force = np.linalg.norm(push, axis=0)
        stiffness = np.repeat(table[:, STIFFNESS], count // len(table))
        deep = np.clip((force / stiffness) ** (2 / 3) / self.inertia.step, 0, 1)
        smooth = deep**2 * (3 - 2 * deep)  # the step function of (3.1)
        full = self.inertia.contact_damping * stiffness * np.sqrt(self.inertia.step)
        pressed = force > 0
        normal = push[:, pressed] / force[pressed]
        along = np.einsum("ck,ckn->kn", normal, basis[:, pressed])
        return pull, (along.T * (full * smooth)[pressed]) @ along
