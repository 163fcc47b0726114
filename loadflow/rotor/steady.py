"""Steady operation: the operating point that the control reaches in a steady wind."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from loadflow.errors import InputError, SolverError
from loadflow.turbines import Turbine, load_turbine

from .options import RotorOptions

if TYPE_CHECKING:
    import xarray as xr

    from .control.constants import Controller
    from .loop import State
    from .machine import Machine

_STEP = 0.04  # s
_SETTLE, _MEAN = 40.0, 20.0  # s; the mean is over whole revolutions of at least _MEAN
_ROUNDS = 12
_TOLERANCE = 2e-4  # of the mean speed from one round to the next
_PITCH_TOLERANCE = 2e-4  # rad
# control that hunts around rated: rounds in each of the two means compared, and how near they are
_HUNTED = 4
_HUNTING_TOLERANCE, _HUNTING_PITCH_TOLERANCE = 1e-3, 2e-3  # of the speed; rad


def steady_state(
    turbine: str | Path | Turbine,
    wind_speed: float | Sequence[float],
    *,
    shear: float = 0.2,
    rung: str | None = None,
    options: RotorOptions | None = None,
) -> xr.Dataset:
    """Operating points in steady wind, means over whole revolutions.

    Parameters
    ----------
    turbine : str, Path or Turbine
    wind_speed : float or sequence
        At the hub, m/s, within cut-in … cut-out.
    shear : float
        Exponent of the wind profile over height.
    rung : {"tables", "bem", "flap", "tower"}, optional
        See `simulate`; by default the finest that the turbine allows.
    options : RotorOptions, optional

    Returns
    -------
    xarray.Dataset
        Over ``wind_speed``: ``speed`` (rad/s), ``pitch`` (rad), ``power`` (mechanical, of the
        rotor, W), ``torque`` (N m), ``thrust`` (N, aerodynamic plus the part of the weight along
        the shaft), ``hub_force`` and ``hub_moment`` (wind_speed, axis) at the rotor apex, N and
        N m, ``tip_deflection`` (m, out of plane, at the outermost section), ``settled``: where it
        is False the control hunts in a cycle, and the values are means over 160 s.

    Raises
    ------
    InputError
        A wind speed outside the operating range, an unknown rung.
    SolverError
        If neither a steady state nor a steady cycle is reached.

    Examples
    --------
    >>> from loadflow.rotor import steady_state
    >>> point = steady_state("nrel-5mw", wind_speed=14.0)
    >>> float(point["power"][0] / 1e6).__round__(1)
    5.3
    """
    import xarray as xr

    from .rungs import finest_rung, prepare

    machine = load_turbine(turbine)
    speeds = np.atleast_1d(np.asarray(wind_speed, float))
    outside = [v for v in speeds if not machine.cut_in <= v <= machine.cut_out]
    if speeds.size == 0:
        raise InputError("wind_speed = [] is not allowed; give at least one, m/s")
    if speeds.ndim != 1 or outside:
        raise InputError(
            f"wind_speed = {outside or speeds.shape} is not allowed; it must be within "
            f"{machine.cut_in} … {machine.cut_out} m/s"
        )
    if not 0 <= shear < 1:
        raise InputError(f"shear = {shear} is not allowed; it must be in [0, 1)")
    rung = rung or finest_rung(machine)
    m, c = prepare(machine, rung, options or RotorOptions())
    points = [operating_point(m, c, float(v), shear) for v in speeds]
    rows = np.array([mean for mean, _, _ in points])
    from . import slots as k

    moment, force = rows[:, [k.MX, k.MY, k.MZ]], rows[:, [k.FX, k.FY, k.FZ]]
    along = ("wind_speed",)

    def variable(values: np.ndarray, units: str, name: str) -> tuple:
        dims = along if values.ndim == 1 else (*along, "axis")
        return dims, values, {"units": units, "long_name": name}

    return xr.Dataset(
        {
            "speed": variable(rows[:, k.SPEED], "rad/s", "rotor speed"),
            "pitch": variable(rows[:, k.PITCH], "rad", "blade pitch"),
            "power": variable(rows[:, k.SPEED] * moment[:, 0], "W", "mechanical rotor power"),
            "torque": variable(moment[:, 0], "N m", "rotor torque"),
            "thrust": variable(force[:, 0], "N", "thrust with the weight along the shaft"),
            "hub_force": variable(force, "N", "force of the rotor on the shaft"),
            "hub_moment": variable(moment, "N m", "moment of the rotor on the shaft at the apex"),
            "tip_deflection": variable(rows[:, k.TIP], "m", "deflection of the outermost section"),
            "settled": variable(
                np.array([settled for _, _, settled in points]), "1", "control does not hunt"
            ),
        },
        coords={
            "wind_speed": ("wind_speed", speeds, {"units": "m/s", "long_name": "hub wind speed"}),
            "axis": ["x", "y", "z"],
        },
        attrs={"turbine": machine.name, "rung": rung, "shear": shear},
    )


def operating_point(
    m: Machine, c: Controller, wind_speed: float, shear: float
) -> tuple[np.ndarray, State, bool]:
    """Mean columns, the last state, and whether the control settled.

    The means are over whole revolutions; where the control hunts, as between its regions, over
    the minutes of a cycle that neither grows nor drifts.
    """
    from . import slots as k
    from .frame import calmed
    from .inflow import steady_inflow
    from .loop import run, turning_state

    c = c._replace(overspeed=np.inf)  # too fast on the way from a poor guess is no fault
    state = turning_state(m, c, wind_speed, *_guess(m, c, wind_speed))
    inflow = steady_inflow(wind_speed, round(_SETTLE / _STEP), shear)
    before = np.full(k.COLUMNS + m.blades, np.inf)
    rounds = []
    for turn in range(_ROUNDS):
        # the tower by itself would sway for minutes
        model = m._replace(frame=calmed(m.frame)) if turn == 0 else m
        out = run(model, c, inflow, state, _STEP, steps=round(_SETTLE / _STEP))
        turns = np.floor(_MEAN * state.speed / (2 * np.pi)) + 1
        count = round(turns * 2 * np.pi / state.speed / _STEP)
        mean = out[-count:].mean(axis=0)
        settled = abs(mean[k.SPEED] / before[k.SPEED] - 1) < _TOLERANCE
        if settled and abs(mean[k.PITCH] - before[k.PITCH]) < _PITCH_TOLERANCE:
            return mean, state, True
        before = mean
        rounds.append(out.mean(axis=0))
    early, late = (np.mean(rounds[-n:][:_HUNTED], axis=0) for n in (2 * _HUNTED, _HUNTED))
    steady = abs(late[k.SPEED] / early[k.SPEED] - 1) < _HUNTING_TOLERANCE
    if steady and abs(late[k.PITCH] - early[k.PITCH]) < _HUNTING_PITCH_TOLERANCE:
        return late, state, False
    raise SolverError(
        f"no steady state at {wind_speed} m/s after {_ROUNDS * _SETTLE:.0f} s: mean speed "
        f"{mean[k.SPEED]:.5f} rad/s, pitch {mean[k.PITCH]:.5f} rad"
    )


def _guess(m: Machine, c: Controller, wind_speed: float) -> tuple[float, float]:
    """Speed and pitch to start from: optimum tip-speed ratio, then a pitch that grows with wind."""
    rated = c.reference_speed / m.gear_ratio
    optimal = 7.5 * wind_speed / m.tip_radius
    if optimal < rated:
        return max(optimal, c.region_15_start / m.gear_ratio), c.minimum_pitch
    surplus = wind_speed - rated * m.tip_radius / 7.5
    return rated, c.minimum_pitch + 0.1 * float(np.sqrt(surplus))
