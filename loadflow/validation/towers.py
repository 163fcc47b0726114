"""Frequencies at which the towers of the shipped turbines sway, in a vacuum, beside printed ones.

The rotor stands and the blades bend; half a metre aside, let go, zero crossings over a minute. For
the WindPACT turbine the print is of the tower under a point that leaves the blades out, so its row
is that of its tower with this point.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from .check import Check, evidence

_STEP, _SECONDS = 0.0125, 60.0
_ROWS = (  # turbine, coordinate of the frame, direction, Hz, source, tolerance
    ("nrel-5mw", 1, "fore-aft", 0.3240, "NREL/TP-500-38060, Table 9-1", 0.01),
    ("nrel-5mw", 2, "side-to-side", 0.3120, "NREL/TP-500-38060, Table 9-1", 0.01),
    # the print has two digits
    ("iea-15mw", 1, "fore-aft, on the monopile", 0.17, "NREL/TP-5000-75698, figure 4-1", 0.03),
)
_MODES_MASS, _MODES_FREQUENCY = 72025.781, 0.4324


@evidence("another code")
def checks() -> Iterator[Check]:
    """Yield the first tower frequencies."""
    from loadflow.turbines import load_turbine

    for name, place, direction, printed, source, tolerance in _ROWS:
        turbine = load_turbine(name)
        yield Check(
            name=f"{turbine.name}: tower {direction}",
            source=source,
            expected=printed,
            got=_sway(turbine, place),
            tolerance=tolerance,
            unit="Hz",
        )
    yield Check(
        name="WindPACT 1.5 MW: tower with a point of 72 t",
        source="program Modes, FAST 7 input of 2015",
        expected=_MODES_FREQUENCY,
        got=_clamped(load_turbine("windpact-1.5mw").tower.bending),
        tolerance=0.003,
        unit="Hz",
    )


def _sway(turbine: Any, place: int) -> float:
    """Frequency of a coordinate of the tower that is let go, Hz."""
    from loadflow.rotor import RotorOptions
    from loadflow.rotor import slots as k
    from loadflow.rotor.inflow import steady_inflow
    from loadflow.rotor.loop import run, turning_state
    from loadflow.rotor.rungs import prepare

    m, c = prepare(turbine, "tower", RotorOptions(air_density=1e-9, tower_dam=False))
    state = turning_state(m, c, 1.0, 1e-9, 0.0)
    state.frame[place] = 0.5
    steps = round(_SECONDS / _STEP)
    inflow = steady_inflow(0.01, steps, 0.0)
    out = run(m, c, inflow, state, _STEP, steps=steps, controlled=False)
    x = out[:, (k.FORE_AFT, k.SIDE_SIDE)[place - 1]]
    x = x - x.mean()
    up = np.flatnonzero((x[:-1] <= 0) & (x[1:] > 0))
    times = up - x[up] / (x[up + 1] - x[up])
    return float(1 / np.diff(times).mean() / _STEP)


def _clamped(tower: Any) -> float:
    """Frequency of the first fore-aft mode under a point mass, by Rayleigh's quotient, Hz."""
    from loadflow.rotor.frame import mass_above, mode_shape
    from loadflow.rotor.machine import GRAVITY

    height = np.linspace(tower.height[0], tower.height[-1], 2001)
    shape, slope, curvature = mode_shape(tower.fore_aft, height)
    density = np.interp(height, tower.height, tower.mass_density)
    rigidity = np.interp(height, tower.height, tower.fore_aft_stiffness)
    weight = GRAVITY * (_MODES_MASS + mass_above(density, height))
    stiffness = np.trapezoid(rigidity * curvature**2 - weight * slope**2, height)
    mass = np.trapezoid(density * shape**2, height) + _MODES_MASS
    return float(np.sqrt(stiffness / mass) / (2 * np.pi))
