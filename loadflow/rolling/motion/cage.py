"""Cage that rides on a ring: a dynamically loaded journal bearing (Holland, Butenschön).

Superposition of turning and squeezing films in closed form (`loadflow.tribology.film`). Equation
numbers are those of von Hollen 2013, who prints +5/2 for the exponent -5/2 of (4.29) and √(1 - ε)
for √(1 - ε²) in (4.30).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import Convergence, is_small
from loadflow.numerics.fields import check_fields
from loadflow.tribology.film import butenschoen, butenschoen_squeeze

Array = NDArray[np.float64]

_RTOL = 1e-6  # of the steps in time


@dataclass(frozen=True, kw_only=True)
class CageRim:
    """Rim of a cage in the bore that guides it.

    Attributes
    ----------
    width : float
        Width of the contact, m.
    bore, diameter : float
        Of the guiding ring and of the cage, m.
    viscosity : float
        Pa s.

    Raises
    ------
    InputError
        If a field is out of its range or the cage is not smaller than the bore.
    """

    width: Annotated[float, Gt(0)]
    bore: Annotated[float, Gt(0)]
    diameter: Annotated[float, Gt(0)]
    viscosity: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        check_fields(self)
        if self.diameter >= self.bore:
            raise InputError(f"diameter: must be < the bore {self.bore:g} m, got {self.diameter:g}")

    @property
    def clearance(self) -> float:
        """Radial clearance, m."""
        return (self.bore - self.diameter) / 2

    @property
    def relative_clearance(self) -> float:
        """ψ = (D - d)/D."""
        return (self.bore - self.diameter) / self.bore

    @property
    def width_ratio(self) -> float:
        """b/d."""
        return self.width / self.bore


@dataclass(frozen=True)
class CageOrbit:
    """Closed path of a cage over one period.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s.
    eccentricity_ratio, angle : ndarray, shape (n,)
        ε, and direction of the narrowest gap, rad.
    minimum_gap : ndarray, shape (n,)
        m.
    friction_power : ndarray, shape (n,)
        (4.30), W.
    convergence : Convergence
        Change of ε and angle (rad) over the last cycle, and number of cycles.
    """

    time: Array
    eccentricity_ratio: Array
    angle: Array
    minimum_gap: Array
    friction_power: Array
    convergence: Convergence


@dataclass(frozen=True)
class _Drive:
    """Load and speeds over one period."""

    time: Array
    force: Array
    cage_speed: Array
    ring_speed: Array

    def at(self, t: float) -> tuple[float, float, float, float]:
        """Load (N), its direction (rad), speeds of cage and ring (rad/s)."""
        x, y, cage, ring = (
            float(np.interp(t, self.time, values))
            for values in (self.force[:, 0], self.force[:, 1], self.cage_speed, self.ring_speed)
        )
        return math.hypot(x, y), math.atan2(y, x), cage, ring


def cage_orbit(
    rim: CageRim,
    time: ArrayLike,
    force: ArrayLike,
    cage_speed: ArrayLike,
    ring_speed: ArrayLike,
    *,
    start: float = 0.8,
    tolerance: float = 1e-4,
    max_cycles: Annotated[int, Ge(2)] = 20,
) -> CageOrbit:
    """Closed path of a cage under a periodic load, (4.23), (4.24).

    Parameters
    ----------
    rim : CageRim
        Cage and bore.
    time : array_like, shape (n,)
        One period from start to end, s; the last sample repeats the first.
    force : array_like, shape (n, 2) or (2,)
        Of the cage on the ring, N.
    cage_speed, ring_speed : array_like, shape (n,) or ()
        In the frame of the load, rad/s.
    start : float
        First guess of ε.
    tolerance : float
        Largest change of ε and of the angle (rad) over a cycle; none is asked below what the
        steps in time leave open, about 1e-6.
    max_cycles : int
        Cycles before giving up.

    Raises
    ------
    SolverError
        If the path does not close.
    """
    from scipy.integrate import solve_ivp

    t = np.asarray(time, float)
    drive = _Drive(
        t,
        np.broadcast_to(np.asarray(force, float), (t.size, 2)),
        np.broadcast_to(np.asarray(cage_speed, float), t.shape),
        np.broadcast_to(np.asarray(ring_speed, float), t.shape),
    )
    # -ln(1 - ε): the film stiffens without bound toward ε = 1
    state = np.array([-math.log1p(-start), drive.at(t[0])[1]])
    for cycle in range(1, max_cycles + 1):
        path = solve_ivp(
            _rates, (t[0], t[-1]), state, "LSODA", t, rtol=_RTOL, atol=1e-8, args=(rim, drive)
        )
        if not path.success:
            raise SolverError(f"cage: cycle {cycle}: {path.message}")
        ends = -np.expm1(-path.y[0, [0, -1]])
        turn = math.remainder(path.y[1, -1] - path.y[1, 0], 2 * math.pi)
        change = max(abs(float(ends[1] - ends[0])), abs(turn))
        finest = _RTOL * max(1.0, float(np.abs(path.y[1]).max()))
        state = path.y[:, -1]
        if is_small(change, tolerance, finest):
            break
    else:
        raise SolverError(
            f"cage: the path is open by {change:.3g} after {max_cycles} cycles, where the steps "
            f"in time allow {finest:.3g}"
        )
    ratio, angle = -np.expm1(-path.y[0]), path.y[1]
    return CageOrbit(
        time=t,
        eccentricity_ratio=ratio,
        angle=angle,
        minimum_gap=rim.clearance * np.exp(-path.y[0]),
        friction_power=_power(rim, drive, ratio, angle),
        convergence=Convergence(True, change, cycle),
    )


def _rates(t: float, state: Array, rim: CageRim, drive: _Drive) -> list[float]:
    """Rates of -ln(1 - ε) and of the angle."""
    load, direction, cage, ring = drive.at(t)
    # trial steps of the integrator may leave the clearance
    ratio, lag = min(max(-math.expm1(-state[0]), 1e-3), 0.9999), state[1] - direction
    scale = load * rim.relative_clearance**2 / (rim.width * rim.bore * rim.viscosity)
    so, beta = (float(x) for x in butenschoen(ratio, rim.width_ratio))
    toward = math.cos(lag) - math.sin(lag) / math.tan(beta)
    squeeze = float(butenschoen_squeeze(math.copysign(ratio, toward), rim.width_ratio))
    growth = scale / squeeze * toward
    return [
        growth / (1 - ratio),
        (cage + ring) / 2 - scale / so * math.sin(lag) / (2 * math.sin(beta)),
    ]


def _power(rim: CageRim, drive: _Drive, ratio: Array, angle: Array) -> Array:
    """Friction of the film, W, (4.30)."""
    so, beta = butenschoen(ratio, rim.width_ratio)
    turning = drive.cage_speed + drive.ring_speed - 2 * np.gradient(angle, drive.time)
    sliding = drive.cage_speed - drive.ring_speed
    shear = np.pi * sliding / np.sqrt(1 - ratio**2) + so * turning * ratio / 2 * np.sin(beta)
    size = rim.width * rim.bore**2 * rim.viscosity / (2 * rim.relative_clearance)
    return np.asarray(size * shear * sliding)
