"""Motion of the rollers: how far their spin falls short of ideal rolling, over load histories.

Two models of friction. *Coulomb* (von Hollen's first stage): raceways grip with μ times the force,
oil drags, and the equation of motion is linear between events, so that it is solved exactly. *Film*
(its second stage): traction of the oil up to a limiting stress, rolling resistance, asperities,
weight; stiff, solved implicitly. Equation numbers are those of von Hollen 2013.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.numerics.convergence import Convergence
from loadflow.numerics.fields import check_one_of
from loadflow.rolling.friction import coulomb
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.friction.roller_drag import DragConstants
from loadflow.rolling.motion.history import RollerHistory, RollerRow
from loadflow.tribology.hertz import effective_modulus

Array = NDArray[np.float64]


@dataclass(frozen=True)
class RollerMotion:
    """Spin of all rollers of a row.

    Attributes
    ----------
    history : RollerHistory
        What they went through.
    spin : ndarray, shape (n, roller)
        Against the cage, rad/s.
    slip_energy : ndarray, shape (n, roller)
        Lost in slip on both raceways since the sample before, J.
    slip_power_density : ndarray, shape (n, roller)
        Largest power of slip over the area of a contact in that time, W/m²: the measure of
        smearing where a slow roller enters the load zone.
    convergence : Convergence
        Worst gap between the spins of films and balance, over the ideal one, and evaluations of
        both contacts of all rollers together; zeros if exact.
    steps : int
        Time steps of all rollers together; 0 if exact.
    """

    history: RollerHistory
    spin: Array
    slip_energy: Array = field(repr=False)
    slip_power_density: Array = field(repr=False)
    convergence: Convergence = Convergence(True, 0.0, 0)  # noqa: RUF009 (frozen)
    steps: int = 0

    @property
    def slip_speed(self) -> Array:
        """Speed of the raceways less that of the rollers' surface, m/s."""
        return self.history.surface_speed[:, None] - self.history.row.radius * self.spin

    @property
    def slip(self) -> Array:
        """Share of the ideal spin that is missing; 1 for a roller that does not turn in its pocket.

        0 where the bearing stands.
        """
        ideal = np.broadcast_to(self.history.ideal_spin[:, None], self.spin.shape)
        ratio = np.divide(self.spin, ideal, out=np.ones_like(self.spin), where=ideal != 0)
        return np.asarray(1 - ratio)

    @property
    def settled(self) -> NDArray[np.bool_]:
        """Samples after the first turn of the cage: by then each roller has forgotten its start."""
        return np.asarray(self.history.turns_of_cage >= 1)

    @property
    def maximum_slip(self) -> float:
        """Largest slip after the first turn of the cage (of all, if there is no full turn)."""
        after = self.settled
        return float(self.slip[after if after.any() else slice(None)].max())


def coulomb_motion(
    history: RollerHistory,
    drag: DragConstants,
    *,
    adhesion: float = 0.12,
    sliding: float = 0.04,
    driving: Literal["inner", "outer"] = "inner",
    pocket: Literal["source", "braking"] = "source",
    periodic: bool = False,
) -> RollerMotion:
    """Motion with Coulomb friction and viscous drag (stage 1), (5.30)–(5.35), exactly.

    Loads change linearly between samples; the spin then follows closed forms from event to event,
    whatever the step.

    Parameters
    ----------
    history : RollerHistory
        Loads and speeds.
    drag : DragConstants
        C₁' and C₃₂' of one roller (`coulomb_drag_constants`).
    adhesion, sliding : float
        μ of the raceways, μ' of the cage.
    driving : {"inner", "outer"}
        Ring that turns in the frame of the load.
    pocket : {"source", "braking"}
        Friction of the cage with the signs of (5.30), which may drive, or always against the spin.
    periodic : bool
        Run twice and keep the second pass.

    Raises
    ------
    InputError
        If a choice is unknown.
    """
    check_one_of("pocket", pocket, ("source", "braking"))
    from loadflow.rolling.motion import _coulomb_kernels as kernels

    row, ideal = history.row, history.ideal_spin
    size, around = np.abs(history.outward), history.tangential
    bend = (row.radius, adhesion, sliding, driving)
    if pocket == "source":
        grip = coulomb.driving_moment(history.load, size, 0.0, 0.0, *bend)
        push = np.asarray(coulomb.driving_moment(0.0, 0.0, around, 0.0, *bend))
        brake = np.zeros_like(size)
    else:
        grip = adhesion * row.radius * (2 * history.load + size)
        push = np.zeros_like(size)
        pull = np.sign(ideal)[:, None] * adhesion * history.outward
        brake = sliding * row.radius * np.abs(around + pull)
    turning = history.inner_speed - history.outer_speed
    swing = np.gradient(history.cage_speed, history.time)
    # von Hollen's crank-pin bearing counts spin and moments in the sense of the turning outer ring
    sense = -1.0 if driving == "outer" else 1.0
    moment = sense * push + (row.inertia * swing - drag.orbit * turning)[:, None]
    spin = np.full(row.rollers, ideal[0])
    args = (history.time, ideal, np.maximum(np.asarray(grip, float), 0.0), moment, brake)
    for _ in range(2 if periodic else 1):
        spins = kernels.coulomb_spins(*args, drag.spin, row.inertia, spin)
        spin = spins[-1].copy()
    return RollerMotion(history, spins, *_rubbed(history, spins, sliding))


def _rubbed(history: RollerHistory, spins: Array, sliding: float) -> tuple[Array, Array]:
    """Energy of slip in each interval, J, and its power over the contact's area, W/m², (5.38)."""
    row = history.row
    slip = np.abs(history.surface_speed[:, None] - row.radius * spins)
    energy, density = np.zeros_like(spins), np.zeros_like(spins)
    steps = np.diff(history.time, prepend=history.time[0])[:, None]
    for side, pressed in ((1 - row.gamma, -history.outward), (1 + row.gamma, history.outward)):
        force = history.load + np.maximum(pressed, 0)
        width = 2 * np.sqrt(
            8 * force * row.radius * side / (np.pi * row.roller_length * _modulus())
        )
        power = sliding * force * slip
        energy += power * steps
        area = width * row.roller_length
        density = np.maximum(density, np.divide(power, area, out=density * 0, where=area > 0))
    return energy, density


def longest_slip(
    row: RollerRow,
    drag: DragConstants,
    speed: float,
    half_zone: float,
    *,
    adhesion: float = 0.12,
    sliding: float = 0.04,
) -> float:
    """Largest slip under a constant radial load, in closed form (stage 1).

    A roller leaves the load zone with ideal spin and decays toward its equilibrium for as long as
    it is unloaded.

    Parameters
    ----------
    row : RollerRow
        Rollers; the outer ring is at rest, weight is neglected.
    drag : DragConstants
        C₁' and C₃₂'.
    speed : float
        Of the inner ring, rad/s.
    half_zone : float
        Half the load zone ψ₀, rad.
    adhesion, sliding : float
        μ and μ'.

    Examples
    --------
    Von Hollen's main bearing at 1000/min and 2 kN, Table 8.5:

    >>> row = RollerRow(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
    ...     pitch_diameter=60.5e-3, roller_mass=11e-3)
    >>> round(longest_slip(row, DragConstants(7.84e-6, -6.52e-7), 104.72, 1.0894), 3)
    0.782
    """
    cage = float(row.cage_speed(speed, 0.0))
    ideal = float(row.surface_speed(speed, 0.0)) / row.radius
    pressed = row.mass * row.pitch_diameter / 2 * cage**2
    drive = float(coulomb.driving_moment(0.0, pressed, 0.0, 0.0, row.radius, adhesion, sliding))
    rest = (drive - drag.orbit * speed) / drag.spin
    free = 2 * (math.pi - half_zone) / cage
    return max(0.0, (1 - rest / ideal) * (1 - math.exp(-free * drag.spin / row.inertia)))


def film_motion(
    history: RollerHistory,
    options: FrictionOptions,
    *,
    drag: DragConstants | None = None,
    sliding: float = 0.04,
    tolerance: float = 3e-4,
    periodic: bool = False,
) -> RollerMotion:
    """Motion with friction of films (stage 2), (5.97)–(5.102), implicitly.

    With ``film="moes"`` films, rolling forces and the traction of the wedge hold in all regimes,
    from rollers that hardly touch to loaded ones; with a power law of elastic films the friction is
    that of von Hollen, which leaves free rollers to stop. Asperities rub where the film is thin.

    Parameters
    ----------
    history : RollerHistory
        Loads and speeds.
    options : FrictionOptions
        Oil, temperature, surfaces, film law, hysteresis; of its losses only those of raceways and
        `roller_drag` brake the rollers.
    drag : DragConstants, optional
        C₁ and C₃₂ of one roller, for `options.roller_drag` and no ribs.
    sliding : float
        μ' of the cage's pockets.
    tolerance : float
        Allowed first-order error of a step, over the ideal spin. The steps are of second order;
        with the default the spin is within 0.1 % of a tight reference
        (`benchmarks/peers/friction.py`).
    periodic : bool
        Run twice and keep the second pass.

    Raises
    ------
    SolverError
        If an implicit step does not converge.
    """
    from loadflow.rolling.motion import _motion_kernels as kernels

    numbers = film_numbers(history.row, options, drag, sliding)
    given = film_arguments(history)
    spin = np.full(history.row.rollers, history.ideal_spin[0])
    for _ in range(2 if periodic else 1):
        # mypy cannot count the arguments of a compiled function behind a star
        found = kernels.film_spins(numbers, *given, spin, tolerance)  # type: ignore[call-arg]
        spins, energy, density, tally = found
        spin = spins[-1].copy()
    if tally[1] and tally[2] > 1e-3:
        raise SolverError(
            f"roller motion: {int(tally[1])} of {int(2 * tally[3])} stages not converged, the "
            f"worst moves by {tally[2]:.2g} of the ideal spin"
        )
    reached = Convergence(not tally[1], float(tally[2]), int(tally[0]))
    return RollerMotion(history, spins, energy, density, reached, int(tally[3]))


def film_numbers(
    row: RollerRow,
    options: FrictionOptions,
    drag: DragConstants | None = None,
    sliding: float = 0.04,
) -> tuple[float, ...]:
    """Numbers of oil and contact that the compiled steps take, see `_motion_kernels.Film`."""
    from loadflow.rolling.motion._motion_kernels import Film
    from loadflow.tribology.contact_film import POWER_LAWS

    oil, t = options.oil, options.temperature
    constants = drag or DragConstants(options.roller_drag, 0.0)
    law = POWER_LAWS.get(options.film, POWER_LAWS["hamrock"])
    viscosity = float(oil.viscosity(t))
    return Film(
        viscosity=viscosity,
        pressure_viscosity=float(oil.pressure_viscosity(t)),
        heating=viscosity * float(oil.steepness(t)) / float(oil.conductivity(t)),
        starvation=options.starvation,
        critical_stress=oil.critical_stress,
        critical_pressure=oil.critical_pressure,
        limiting_slope=oil.limiting_slope,
        roughness=options.roughness,
        boundary=options.boundary_friction,
        hysteresis=options.hysteresis,
        modulus=_modulus(),
        length=row.roller_length,
        radius=row.radius,
        gamma=row.gamma,
        inertia=row.inertia,
        pocket=sliding,
        spin_drag=constants.spin,
        orbit_drag=constants.orbit,
        regimes=options.film == "moes",
        factor=law.coefficient,
        material=law.material,
        speed=law.speed,
        load=law.load,
    )


def _modulus() -> float:
    """Reduced modulus E₀ of steel on steel, Pa."""
    return 2 * float(effective_modulus())


def film_arguments(history: RollerHistory) -> tuple[Array, ...]:
    """Arrays of a history that the compiled steps take."""
    given = (
        history.time,
        history.surface_speed,
        history.inner_speed - history.outer_speed,
        np.gradient(history.cage_speed, history.time) * math.cos(history.row.contact_angle),
        history.load,
        history.outward,
        history.tangential,
    )
    # one that is read-only, or laid out by columns, would compile the steps anew
    return tuple(np.require(one, requirements=("C", "W")) for one in given)
