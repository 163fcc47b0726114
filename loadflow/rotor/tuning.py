"""Gains of the control that follow from the rotor, where a turbine states what they are to do.

The torque below rated holds the optimal tip speed ratio; the pitch gains give the speed a frequency
and a damping ratio [Jonkman et al. 2009, section 7; Abbas et al. 2022]; peak shaving lifts the
lowest pitch so far that the thrust stays below a share of its largest value.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.turbines import Turbine

from . import slots as k
from .control.constants import Controller, controller
from .inflow import steady_inflow
from .loop import run, turning_state
from .machine import Machine, machine
from .options import RotorOptions
from .tables import with_table

Array = NDArray[np.float64]

_RIGID = RotorOptions(
    modes=(),
    tower_motion=False,
    drivetrain_torsion=False,
    tower_dam=False,
    shed_wake=False,
    skew_factor=0.0,
    blade_torsion=False,
)
_BENDING = RotorOptions(
    tower_motion=False, drivetrain_torsion=False, tower_dam=False, shed_wake=False, skew_factor=0.0
)
_SETTLED, _STEP = 20.0, 0.02  # s, until blades that bend and twist stand still in the mean
_PITCHES = np.radians(np.arange(-6.0, 31.0, 0.5))
_SPEED_STEP = 0.5  # m/s, between the winds of a schedule
_LEAST_SLOPE = 0.25  # of the power at zero pitch, over the least one found
_WINDS = 8  # above rated wind, where the power over the pitch is looked at


def tuned(turbine: Turbine) -> Turbine:
    """Return the turbine with all gains of its control stated.

    Parameters
    ----------
    turbine : Turbine

    Returns
    -------
    Turbine
        The same one, where all are stated already.

    Raises
    ------
    InputError
        The rotor does not reach its rated power, or its power does not fall with the pitch.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> from loadflow.rotor.tuning import tuned
    >>> turbine = load_turbine("nrel-5mw")
    >>> tuned(turbine) is turbine
    True
    """
    if turbine.control.is_tuned:
        return turbine
    rotor = _Rotor(turbine)
    control = turbine.control
    if control.region_2_gain is None:
        gain = rotor.optimal_gain(float(control.optimal_tip_speed_ratio or 0.0))
        control = replace(control, region_2_gain=gain, optimal_tip_speed_ratio=None)
    if control.integral_gain is None:
        frequency, damping = control.pitch_frequency or 0.0, control.pitch_damping or 0.0
        proportional, integral, halving = rotor.pitch_gains(frequency, damping)
        control = replace(
            control,
            proportional_gain=proportional,
            integral_gain=integral,
            gain_halving_pitch=halving,
            pitch_frequency=None,
            pitch_damping=None,
        )
    if control.thrust_limit is not None:
        wind, pitch = rotor.shaved(control.thrust_limit, turbine.control.optimal_tip_speed_ratio)
        control = replace(control, scheduled_wind=wind, scheduled_pitch=pitch, thrust_limit=None)
    return replace(turbine, control=control)


class _Rotor:
    """Torque and thrust of the rotor in uniform wind, rigid and along its axis but for one."""

    def __init__(self, turbine: Turbine) -> None:
        self.turbine = turbine
        stated = replace(
            turbine.control,
            region_2_gain=1.0,
            optimal_tip_speed_ratio=None,
            proportional_gain=1.0,
            integral_gain=1.0,
            gain_halving_pitch=1.0,
            pitch_frequency=None,
            pitch_damping=None,
            thrust_limit=None,
        )
        self.controller: Controller = controller(replace(turbine, control=stated))
        self.machine: Machine = with_table(machine(turbine, _RIGID)._replace(tilt=0.0))
        self.rated_speed = turbine.rated_speed

    def loads(self, wind: float, speed: float, pitch: float) -> tuple[float, float]:
        """Torque, N m, and thrust, N."""
        state = turning_state(self.machine, self.controller, wind, speed, pitch)
        inflow = steady_inflow(wind, 2, 0.0)
        out = run(self.machine, self.controller, inflow, state, 0.01, steps=2, controlled=False)
        return float(out[-1, k.MX]), float(out[-1, k.FX])

    def bent_torque(self, wind: float, speed: float, pitch: float) -> float:
        """Mean torque of blades that bend and twist, N m: it falls as they do."""
        m = with_table(machine(self.turbine, _BENDING))
        state = turning_state(m, self.controller, wind, speed, pitch)
        steps = round(_SETTLED / _STEP)
        inflow = steady_inflow(wind, steps, 0.0)
        out = run(m, self.controller, inflow, state, _STEP, steps=steps, controlled=False)
        return float(out[-round(2 * np.pi / speed / _STEP) :, k.MX].mean())

    def lowest(self, wind: float) -> float:
        """Lowest pitch in a wind, rad."""
        control = self.turbine.control
        if not control.scheduled_wind:
            return control.minimum_pitch
        return float(np.interp(wind, control.scheduled_wind, control.scheduled_pitch))

    def optimal_gain(self, ratio: float) -> float:
        """Torque over speed² on the generator's side that holds the tip speed ratio."""
        speed = 0.8 * self.rated_speed
        wind = speed * self.machine.tip_radius / ratio
        torque = self.bent_torque(wind, speed, self.lowest(wind))
        if torque <= 0:
            raise InputError(
                f"control.optimal_tip_speed_ratio = {ratio:g}: the rotor of {self.turbine.name} "
                f"gives {torque:.3g} N m there; it must drive"
            )
        gear = self.machine.gear_ratio
        return torque / gear / (speed * gear) ** 2

    def pitch_gains(self, frequency: float, damping: float) -> tuple[float, float, float]:
        """Proportional and integral gain at zero pitch, and the pitch that halves them, rad."""
        turbine, m = self.turbine, self.machine
        rated = turbine.control.rated_mechanical_power
        winds = np.linspace(1.15 * turbine.rated_wind_speed, turbine.cut_out, _WINDS)
        pitches, slopes = [], []
        for wind in winds:
            power = np.array([self.loads(wind, self.rated_speed, p)[0] for p in _PITCHES])
            power *= self.rated_speed
            falling = np.flatnonzero((power[:-1] >= rated) & (power[1:] < rated))
            if falling.size:
                i = falling[-1]
                slope = (power[i + 1] - power[i]) / (_PITCHES[i + 1] - _PITCHES[i])
                slopes.append(slope)
                pitches.append(_PITCHES[i] + (rated - power[i]) / slope)
        if len(slopes) < 2:
            raise InputError(
                f"control.pitch_frequency: the rotor of {turbine.name} does not reach "
                f"{rated / 1e6:.3g} MW above rated wind, so that no gains follow"
            )
        # weighted so that it holds in proportion; around rated wind the power hardly falls
        steep = -np.array(slopes)
        growth, at_zero = np.polyfit(pitches, steep, 1, w=1 / steep)
        at_zero = max(float(at_zero), _LEAST_SLOPE * float(steep.min()))
        halving = float(np.clip(at_zero / growth, 0.02, 1.0)) if growth > 0 else 1.0
        inertia = (
            m.hub_inertia
            + m.blades * float(np.sum(m.mass * (m.radius * np.cos(m.cone)) ** 2))
            + turbine.drivetrain.generator_inertia * m.gear_ratio**2
        )
        share = inertia * self.rated_speed / (m.gear_ratio * at_zero)
        return 2 * damping * frequency * share, frequency**2 * share, halving

    def shaved(self, limit: float, ratio: float | None) -> tuple[tuple[float, ...], ...]:
        """Winds, m/s, and lowest pitch, rad, that keep the thrust below a share of its largest."""
        turbine, control = self.turbine, self.turbine.control
        ratio = ratio or self.rated_speed * self.machine.tip_radius / turbine.rated_wind_speed
        winds = np.arange(turbine.cut_in, 1.4 * turbine.rated_wind_speed, _SPEED_STEP)
        slowest = control.region_15_start / self.machine.gear_ratio
        speeds = np.clip(ratio * winds / self.machine.tip_radius, slowest, self.rated_speed)
        free = np.array([self.loads(v, w, self.lowest(v))[1] for v, w in zip(winds, speeds)])
        largest = limit * float(free[winds <= turbine.rated_wind_speed].max())
        found = []
        for wind, speed, thrust in zip(winds, speeds, free):
            lowest = self.lowest(wind)
            if thrust > largest:
                above = _PITCHES[lowest < _PITCHES]
                thrusts = np.array([self.loads(wind, speed, p)[1] for p in above])
                lowest = float(above[np.argmax(thrusts <= largest)])
            found.append((float(wind), lowest))
        table = np.array(found).T
        return tuple(table[0].tolist()), tuple(table[1].tolist())
