"""Motion of a slewing bearing into its rest: the multibody rung of [Ritzer 2018], § 3.1.

The inner ring with its structure has mass, contacts and rings have damping. The rings are their
static modes without inertia (Guyan), or with their masses and some modes of vibration with held
patches (Craig–Bampton). What comes to rest is the equilibrium of `BallRaceways.equilibrium`; the
way there depends on damping, which Ritzer gives no value for.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated

import numpy as np
from annotated_types import Gt
from numpy.typing import ArrayLike

from loadflow.errors import InputError, SolverError
from loadflow.numerics.fields import check_fields
from loadflow.numerics.shown import Shown, in_words
from loadflow.quantities import ROLLING, Quantity
from loadflow.rolling.contacts import STIFFNESS, Array, Contacts
from loadflow.rolling.equilibrium import broadcast_loads
from loadflow.rolling.rings.condensation import ring_modes
from loadflow.rolling.rings.condensed import RingModes
from loadflow.rolling.rings.coupling import PointCoupling
from loadflow.rolling.rings.dynamics import RingMotion, joint_motion
from loadflow.rolling.rings.flexible import FlexibleRings

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from loadflow.rolling.raceways import BallRaceways


@dataclass(frozen=True, kw_only=True)
class Inertia:
    """What moves with the inner ring, and how motion is damped.

    Attributes
    ----------
    mass : float
        Of the inner ring and its structure, together, kg.
    radius : float
        Radius of gyration about the tilt axes, m.
    contact_damping : float
        C_max of (3.2) over K √step, s, K the stiffness of both contacts of a ball in series; the
        √step gives Ritzer's numeric rule its units.
    step : float
        Penetration at which the damping of a contact is fully on, m (3.1).
    ring_damping : float
        Time constant of the material damping of the ring modes, s.

    Raises
    ------
    InputError
        If a field is not positive.

    Examples
    --------
    >>> from loadflow.rolling import Inertia
    >>> Inertia(mass=1e4, radius=0.8).contact_damping
    0.001
    """

    mass: Annotated[float, Gt(0)]
    radius: Annotated[float, Gt(0)]
    contact_damping: Annotated[float, Gt(0)] = 1e-3
    step: Annotated[float, Gt(0)] = 10e-6
    ring_damping: Annotated[float, Gt(0)] = 1e-4

    def __post_init__(self) -> None:
        check_fields(self)


_SHOWN = {
    "time": Quantity("t", "s", "time"),
    "largest_force": Quantity("Q_max", "N", "largest contact force, without its damping"),
    "residual": Quantity("", "1", "largest unbalanced component at the end over the largest load"),
}


@dataclass(frozen=True, repr=False)
class Transient(Shown):
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

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import Transient
    >>> motion = Transient(np.array([0.0, 0.1]), np.zeros((2, 5)), np.array([0.0, 3e3]),
    ...     residual=1e-3)
    >>> float(motion.largest_force.max())
    3000.0
    """

    time: Array
    displacement: Array
    largest_force: Array
    residual: float

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a motion."""
        return _SHOWN

    def to_dataset(self) -> xr.Dataset:
        """The motion over ``time``, with units."""
        import xarray as xr

        names = ["ux", "uy", "uz", "θx", "θy"]
        moved = ROLLING["displacement"].attributes
        return xr.Dataset(
            {
                "displacement": (("time", "dof"), self.displacement, moved),
                "largest_force": ("time", self.largest_force, _SHOWN["largest_force"].attributes),
                "residual": ((), self.residual, _SHOWN["residual"].attributes),
            },
            {"time": ("time", self.time, _SHOWN["time"].attributes), "dof": names},
        )

    def plot(self) -> Figure:
        """Draw displacement, tilt and the largest contact force over time."""
        from loadflow import plots

        drawing, axes = plots.figure(3, 1, sharex=True)
        for axis, first, last, scale, label in (
            (axes[0], 0, 3, 1e6, "displacement, µm"),
            (axes[1], 3, 5, 1e3, "tilt, mrad"),
        ):
            for k, name in enumerate(("x", "y", "z", "x", "y")[first:last], first):
                axis.plot(self.time, scale * self.displacement[:, k], label=name)
            axis.set(ylabel=label)
            axis.legend()
        axes[2].plot(self.time, self.largest_force / 1e3)
        axes[2].set(xlabel="time, s", ylabel="largest force, kN")
        return drawing

    def __repr__(self) -> str:
        force, unit = in_words(np.array(np.max(self.largest_force)), "N")
        return f"<Transient of {self.time.size} steps, largest contact force {force} {unit}>"


def transient_response(
    bearing: BallRaceways,
    rings: FlexibleRings,
    inertia: Inertia,
    force: ArrayLike,
    moment: ArrayLike = (0.0, 0.0),
    *,
    duration: float = 0.5,
    tolerance: float = 1e-8,
    fixed_modes: int | None = None,
) -> Transient:
    """Follow a bearing to rest under a load that is applied suddenly.

    Parameters
    ----------
    bearing, rings
        See `BallRaceways.equilibrium`.
    inertia : Inertia
        Mass and damping.
    force, moment : array_like, shape (3,) and (2,)
        Load on the inner ring, N and N m.
    duration : float
        Time given, s.
    tolerance : float
        Relative tolerance of the integration.
    fixed_modes : int, optional
        Modes of vibration with held patches of each ring (Craig–Bampton), whose masses then count;
        rings must be `FiniteElementRing`. By default rings have no inertia.

    Returns
    -------
    Transient
        The motion.

    Raises
    ------
    InputError
        If rings that are no `FiniteElementRing` are to vibrate.
    SolverError
        If the integration fails.

    Examples
    --------
    >>> from loadflow.rolling import FlexibleRings, Inertia, RingBeam, RingSection
    >>> from loadflow.rolling import SlewingBearing, Support
    >>> from loadflow.rolling import transient_response
    >>> bearing = SlewingBearing(balls=12, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> wall = Support.wall(radius=0.3, height=0.06, thickness=0.03, length=0.3)
    >>> outer = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.3, supports=(wall,))
    >>> rings = FlexibleRings(outer=outer)
    >>> motion = transient_response(bearing, rings, Inertia(mass=1e3, radius=0.3), (0.0, 0.0, 5e4),
    ...     duration=0.1)
    >>> rest = bearing.equilibrium((0.0, 0.0, 5e4), rings=rings).displacement[2]
    >>> bool(abs(motion.displacement[-1, 2] / rest - 1) < 1e-2)
    True
    """
    from scipy.integrate import solve_ivp

    from loadflow.rolling.rings import _ring_kernels

    contacts = bearing.contacts()
    modes = ring_modes(PointCoupling(bearing), rings)
    f, m = broadcast_loads(force, moment)
    load = np.zeros(modes.size)
    load[:5] = np.concatenate([f, m]) * contacts.scale
    system = _System(contacts, modes, inertia)
    if fixed_modes is None:
        motion: _Massless | _Vibrating = _Massless(system, load)
    else:
        motion = _Vibrating(system, load, joint_motion(bearing, rings, modes, fixed_modes))
    answer = solve_ivp(
        motion.rate,
        (0, duration),
        motion.start,
        "LSODA",
        jac=motion.slope,
        rtol=tolerance,
        atol=1e-12,
    )
    if not answer.success:
        raise SolverError(f"the motion could not be followed: {answer.message}")
    states = np.ascontiguousarray(answer.y[: modes.size].T)
    largest = _ring_kernels.contact_state(states, modes.waves, modes.law)[0]
    pull, _ = system.forces(states[-1])
    return Transient(
        answer.t,
        states[:, :5] * contacts.scale,
        largest.max(axis=(1, 2)),
        float(np.abs((load - pull)[:5]).max() / max(np.abs(load).max(), 1e-300)),
    )


@dataclass(frozen=True)
class _System:
    """Elastic forces and damping matrix of the contacts in any state."""

    contacts: Contacts
    modes: RingModes
    inertia: Inertia

    @property
    def mass(self) -> Array:
        """Of the rigid unknowns, kg."""
        turning = (self.inertia.radius / self.contacts.lever) ** 2
        return self.inertia.mass * np.array([1, 1, 1, turning, turning])

    def forces(self, x: Array) -> tuple[Array, Array]:
        """Elastic force on all unknowns, damping matrix of the contacts."""
        _, push, *_, pull = self.contact(x)
        basis, table = self.modes.basis, self.contacts.table
        push = push.reshape(len(table), 3, -1).transpose(1, 0, 2).reshape(3, -1)
        force = np.linalg.norm(push, axis=0)
        stiffness = np.repeat(table[:, STIFFNESS], len(force) // len(table))
        deep = np.clip((force / stiffness) ** (2 / 3) / self.inertia.step, 0, 1)
        smooth = deep**2 * (3 - 2 * deep)  # the step function of (3.1)
        full = self.inertia.contact_damping * stiffness * np.sqrt(self.inertia.step)
        pressed = force > 0
        normal = push[:, pressed] / force[pressed]
        along = np.einsum("ck,ckn->kn", normal, basis[:, pressed])
        return pull, (along.T * (full * smooth)[pressed]) @ along

    def tangent(self, x: Array) -> Array:
        """Slope of the elastic force on all unknowns."""
        from loadflow.rolling.rings import _ring_tangent

        modes, (_, push, slope, across, slant, _) = self.modes, self.contact(x)
        return _ring_tangent.tangent(modes.waves, modes.law.power, push, slope, across, slant)

    def contact(self, x: Array) -> tuple[Array, ...]:
        """Shift and force of all contacts, slopes along and across, slant, force on unknowns."""
        from loadflow.rolling.rings import _ring_kernels

        return _ring_kernels.evaluate(x, self.modes.waves, self.modes.law)


@dataclass(frozen=True, eq=False)
class _Massless:
    """Ring modes without inertia: state (unknowns, speed of the rigid ones)."""

    system: _System
    load: Array
    slope = None  # by differences

    @property
    def start(self) -> Array:
        return np.zeros(len(self.load) + 5)

    def rate(self, _: float, state: Array) -> Array:
        """Rate of the state."""
        size = len(self.load)
        x, speed = state[:size], state[size:]
        pull, damper = self.system.forces(x)
        rest = self.load - pull
        # modes without mass: (damping of material and contacts) ȧ = what is left over
        coupled = damper[5:, 5:] + self.system.inertia.ring_damping * np.eye(size - 5)
        mode_speed = np.linalg.solve(coupled, rest[5:] - damper[5:, :5] @ speed)
        drag = damper[:5, :5] @ speed + damper[:5, 5:] @ mode_speed
        return np.concatenate([speed, mode_speed, (rest[:5] - drag) / self.system.mass])


@dataclass(frozen=True, eq=False)
class _Vibrating:
    """Rings with mass: state (unknowns, vibrations, speed of all)."""

    system: _System
    load: Array
    rings: RingMotion

    @cached_property
    def start(self) -> Array:
        """At rest, rings unloaded."""
        return np.zeros(2 * (5 + len(self.rings.stiffness)))

    @cached_property
    def inverse_mass(self) -> Array:
        """Of all unknowns and vibrations."""
        rings = self.rings
        mass = np.zeros((len(self.start) // 2,) * 2)
        mass[:5, :5] = np.diag(self.system.mass)
        mass[5:, 5:] = rings.mass
        mass[:5, 5:] = self.system.contacts.scale[:, None] * rings.carried
        mass[5:, :5] = mass[:5, 5:].T
        structure = mass[:5, :5] - mass[:5, 5:] @ np.linalg.solve(rings.mass, mass[5:, :5])
        if np.linalg.eigvalsh(structure)[0] <= 0:
            raise InputError(
                f"mass, radius: the inner ring alone has more inertia than {self.system.inertia}"
            )
        return np.asarray(np.linalg.inv(mass), float)

    def rate(self, _: float, state: Array) -> Array:
        """Rate of the state."""
        size, half = len(self.load), len(state) // 2
        x, speed = state[:half], state[half:]
        pull, damper = self.system.forces(x[:size])
        rest = np.concatenate([self.load - pull, -self.rings.stiffness[size - 5 :] * x[size:]])
        rest[:size] -= damper @ speed[:size]
        rest[5:] -= self.system.inertia.ring_damping * self.rings.stiffness * speed[5:]
        return np.concatenate([speed, self.inverse_mass @ rest])

    def slope(self, _: float, state: Array) -> Array:
        """Derivative of the rate, but for that of the contacts' damping."""
        size, half = len(self.load), len(state) // 2
        damper = self.system.forces(state[:size])[1]
        stiff = np.zeros((half, half))
        stiff[5:, 5:] = np.diag(self.rings.stiffness)
        drag = self.system.inertia.ring_damping * stiff
        stiff[:size, :size] = self.system.tangent(state[:size])
        drag[:size, :size] += damper
        matrix = np.zeros((2 * half, 2 * half))
        matrix[:half, half:] = np.eye(half)
        matrix[half:, :half] = -self.inverse_mass @ stiff
        matrix[half:, half:] = -self.inverse_mass @ drag
        return matrix
