"""Energy audit of a roller: what the shafts put in, what rubs away, what is stored.

The power put in is formed from the torques on rings and cage, which follow from the forces on each
surface and from the balance of the roller; the losses are formed from each component's own law.
Both agree only if forces, levers and the roller's equation of motion are right.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.rolling.friction import RollerGaps
from loadflow.rolling.friction.roller_drag import (
    _conductance,
    segment_area_moment,
    segment_polar,
)
from loadflow.rolling.kinematics import Value, contact_speeds

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class RollerState:
    """Speeds of the bearing and forces on one roller (arrays: one entry for each roller or time).

    Attributes
    ----------
    inner_speed, outer_speed, cage_speed : float or ndarray
        rad/s.
    spin, spin_rate : float or ndarray
        Of the roller against the cage, rad/s and rad/s²; signs as in
        `loadflow.rolling.kinematics`.
    traction : tuple
        Friction on the roller at inner and outer ring in the sense of the spin, N.
    rolling : tuple
        Rolling force on each surface at both rings (`rolling_resistance`), N, of the spin's sign.
    drag : float or ndarray
        Moment of cage, pocket and oil against the spin, N m, of the spin's sign.
    rib_moment, rib_force : float or ndarray
        Of the ribs on the roller (`rib_shear`): moment against the spin, N m, and force along the
        positive sense of turning, N.
    rib : {"outer", "inner"}
        Ring with the ribs.
    tangential : float or ndarray
        Tangential inertia force U (mass times acceleration) of the roller, N.

    Examples
    --------
    >>> from roller_energy import RollerState
    >>> state = RollerState(inner_speed=10.0, outer_speed=0.0, cage_speed=4.5, spin=60.0)
    >>> state.spin_rate, state.rib
    (0.0, 'outer')
    """

    inner_speed: Value
    outer_speed: Value
    cage_speed: Value
    spin: Value
    spin_rate: Value = 0.0
    traction: tuple[Value, Value] = (0.0, 0.0)
    rolling: tuple[Value, Value] = (0.0, 0.0)
    drag: Value = 0.0
    rib_moment: Value = 0.0
    rib_force: Value = 0.0
    rib: Literal["outer", "inner"] = "outer"
    tangential: Value = 0.0


@dataclass(frozen=True)
class EnergyAudit:
    """Powers, W, summed over all rollers given.

    Attributes
    ----------
    shaft : float
        What both rings and the cage are driven with.
    stored : float
        Growth of the kinetic energy of the rollers' spin and orbit.
    losses : dict of str to float
        Slip, rolling, drag and rib.

    Examples
    --------
    >>> from roller_energy import EnergyAudit
    >>> audit = EnergyAudit(shaft=120.0, stored=15.0, losses={"slip": 70.0, "drag": 35.0})
    >>> audit.shaft - audit.stored - sum(audit.losses.values())  # W, what is not accounted for
    0.0
    """

    shaft: float
    stored: float
    losses: dict[str, float]

    @property
    def imbalance(self) -> float:
        """Shaft less stored less lost power, W."""
        return self.shaft - self.stored - sum(self.losses.values())

    @property
    def error(self) -> float:
        """|imbalance| over the largest power of all; 0 where nothing moves."""
        terms = (self.shaft, self.stored, *self.losses.values())
        largest = max(abs(p) for p in terms)
        return abs(self.imbalance) / largest if largest > 0 else 0.0


def roller_torques(
    state: RollerState, inner_diameter: float, outer_diameter: float
) -> tuple[Value, Value, Value]:
    """Torques that drive inner ring, outer ring and cage against one roller, N m.

    The cage is pushed by what the roller's tangential balance leaves: tractions, shear of the
    rolling film, and the resultants of its pressure, which are inclined by 2 F R_eff/ρ.

    Examples
    --------
    >>> from roller_energy import RollerState, roller_torques
    >>> state = RollerState(inner_speed=10.0, outer_speed=0.0, cage_speed=4.5, spin=60.0,
    ...     traction=(100.0, -100.0))
    >>> inner, outer, cage = roller_torques(state, 0.2, 0.24)
    >>> inner, outer, cage
    (10.0, 12.0, -22.0)
    """
    inner, outer = inner_diameter / 2, outer_diameter / 2
    pitch, roller = (inner + outer) / 2, (outer - inner) / 2
    (pull_i, pull_o), (roll_i, roll_o) = state.traction, state.rolling
    lean_i = 2 * inner / (inner + roller)  # 2 R_eff/ρ
    lean_o = 2 * outer / (outer - roller)
    on_roller = pull_i - roll_i + lean_i * roll_i - (pull_o - roll_o + lean_o * roll_o)
    cage_push = state.tangential - on_roller - state.rib_force
    at_rib = pitch * state.rib_force + state.rib_moment
    return (
        inner * (roll_i + pull_i) + (at_rib if state.rib == "inner" else 0.0),
        -outer * (roll_o + pull_o) + (at_rib if state.rib == "outer" else 0.0),
        pitch * cage_push + state.drag,
    )


def energy_audit(
    state: RollerState, inner_diameter: float, outer_diameter: float, inertia: float
) -> EnergyAudit:
    """Audit the power of rollers.

        Parameters
        ----------
        state : RollerState
            Speeds and forces; fields broadcast.
        inner_diameter, outer_diameter : float
            Raceway diameters, m.
        inertia : float
            Moment of inertia of a roller about its axis, kg m².

        Examples
        --------
        A roller held back by drag alone, rolling without slip:

        >>> from loadflow.rolling.friction import RollerGaps
    from loadflow.rolling.friction.roller_drag import (
        _conductance,
        segment_area_moment,
        segment_polar,
    )
    from loadflow.rolling.kinematics import ideal_speeds
        >>> d, big = 49.5e-3, 71.5e-3
        >>> cage, spin = ideal_speeds(100.0, 0.0, d, big)
        >>> state = RollerState(inner_speed=100.0, outer_speed=0.0, cage_speed=cage, spin=spin,
        ...     traction=(1.0, 1.0), drag=2 * 5.5e-3)
        >>> energy_audit(state, d, big, 1.7e-7).error < 1e-12
        True
    """
    to_inner, to_outer, to_cage = roller_torques(state, inner_diameter, outer_diameter)
    shaft = to_inner * state.inner_speed + to_outer * state.outer_speed
    shaft = shaft + to_cage * state.cage_speed
    pitch = (inner_diameter + outer_diameter) / 4
    stored = inertia * (state.spin - state.cage_speed) * state.spin_rate
    stored = stored + state.tangential * pitch * state.cage_speed
    v = contact_speeds(
        state.inner_speed, state.outer_speed, state.cage_speed, state.spin,
        inner_diameter, outer_diameter,
    )  # fmt: skip
    (pull_i, pull_o), (roll_i, roll_o) = state.traction, state.rolling
    ring = state.inner_speed if state.rib == "inner" else state.outer_speed
    losses = {
        "slip": pull_i * v.sliding_inner + pull_o * v.sliding_outer,
        "rolling": 2 * (roll_i * v.mean_inner + roll_o * v.mean_outer),
        "drag": state.drag * state.spin,
        "rib": state.rib_moment * state.spin
        + (pitch * state.rib_force + state.rib_moment) * (ring - state.cage_speed),
    }
    shape = np.broadcast_shapes(*(np.shape(x) for x in (shaft, stored, *losses.values())))

    def total(power: Value) -> float:
        return float(np.broadcast_to(power, shape).sum())

    return EnergyAudit(total(shaft), total(stored), {k: total(p) for k, p in losses.items()})


class RibShear(NamedTuple):
    """What the oil between a roller's ends and the ribs of one ring does to the roller.

    `moment` against the spin, N m; `force` along the ring's turning, N; `loss` of both bodies, W.

    Examples
    --------
    >>> from roller_energy import RollerGaps, rib_shear
    >>> gaps = RollerGaps(radius=0.02, length=0.06, end_gaps=(2e-4, 2e-4), rib_gaps=(1e-4, 1e-4),
    ...     pocket_gaps=(1e-4, 1e-4), rib_height=0.008, cage_half_height=0.005, pocket_angle=0.5,
    ...     roughness=1e-6, pitch_diameter=0.5)
    >>> found = rib_shear(gaps, 0.02, spin=60.0, ring_speed=-4.5)
    >>> found._fields, found.loss > 0
    (('moment', 'force', 'loss'), True)
    """

    moment: float
    force: float
    loss: float


def rib_shear(
    gaps: RollerGaps,
    viscosity: float,
    spin: float,
    ring_speed: float,
    rib: Literal["outer", "inner"] = "outer",
) -> RibShear:
    """Viscous shear at the ribs from the whole field of sliding speeds, which loses what it must.

    Parameters
    ----------
    gaps : RollerGaps
        Roller and ribs.
    viscosity : float
        Pa s.
    spin : float
        Spin of the roller against the cage, rad/s.
    ring_speed : float
        Speed of the ring with the ribs against the cage, rad/s.
    rib : {"outer", "inner"}
        Ring with the ribs.

    Examples
    --------
    >>> from roller_energy import RollerGaps, rib_shear
    >>> gaps = RollerGaps(radius=0.02, length=0.06, end_gaps=(2e-4, 2e-4), rib_gaps=(1e-4, 1e-4),
    ...     pocket_gaps=(1e-4, 1e-4), rib_height=0.008, cage_half_height=0.005, pocket_angle=0.5,
    ...     roughness=1e-6, pitch_diameter=0.5)
    >>> slow, fast = (rib_shear(gaps, 0.02, speed, -speed / 13).loss for speed in (30.0, 60.0))
    >>> round(fast / slow, 6)
    4.0
    """
    r, h = gaps.radius, gaps.rib_height
    pitch = gaps.pitch_diameter / 2
    polar = segment_polar(r, h) / 2
    left = r - h
    area = r**2 * math.acos(left / r) - left * math.sqrt(2 * r * h - h**2)
    first = segment_area_moment(r, h) * (1.0 if rib == "outer" else -1.0)
    film = _conductance(gaps, viscosity)
    moment = film * ((ring_speed + spin) * polar + ring_speed * pitch * first)
    force = film * (ring_speed * (pitch * area + first) + spin * first)
    loss = moment * spin + (force * pitch + moment) * ring_speed
    return RibShear(moment, force, loss)
