"""What is doubtful about series that can be read: wrong turbine, frame, sign, unit or step.

A file may be sound and yet mean something else than its channels say. Weight, power and the turns
of the rotor are known well enough to notice; every doubt names the two numbers that disagree.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.cube import standing, standing_share, time_step
from loadflow.readers.frames import turning_order

GRAVITY = 9.80665
WEIGHT = 0.10
"""Share by which the mean vertical force may differ from the weight of the rotor."""
POWER = 0.10
"""Share by which torque × speed may differ from the power in the file."""
ABOVE_RATED = 1.25
"""Mean power and largest speed of the rated ones above which another turbine is likely."""
SPEED_FACTOR = 1.6
WIND = 0.25
"""Share by which the mean of the wind may differ from the wind speed of the load case."""
SAMPLES_PER_3P = 5
"""Samples in a period of the blade-passing frequency below which its loads are cut."""
NEIGHBOURS = {1e3: "N and kN", 30 / math.pi: "rad/s and 1/min", 180 / math.pi: "rad and deg"}
"""Ratios that confused units make."""


def power_doubts(found: Mapping[str, NDArray[np.float64]]) -> list[str]:
    """Compare torque × speed with the power of the shaft that the same file has.

    Parameters
    ----------
    found : mapping of str to ndarray
        Components, among them perhaps ``rotor_power``, W.
    """
    if "rotor_power" not in found:
        return []
    made = float(np.mean(found["hub_moment_x"] * found["speed"]))
    given = float(np.mean(found["rotor_power"]))
    largest = float(np.abs(found["rotor_power"]).max())
    if abs(made - given) <= POWER * max(abs(given), 0.01 * largest):
        return []
    return [
        f"torque × speed is {made / 1e3:.4g} kW in the mean, the power of the file "
        f"{given / 1e3:.4g} kW{_hint(made, given)}"
    ]


def with_doubts(case: xr.Dataset, turbine: str, simulated: bool = False) -> xr.Dataset:
    """Return a case with the coordinates ``doubts`` and ``standing_share``.

    Parameters
    ----------
    case : xarray.Dataset
        Series over time with the label ``wind_speed``; doubts that it has already stay.
    turbine : str
        Name or file of the turbine that the series are said to be of.
    simulated : bool
        Whether the series were simulated with that turbine, so that there is nothing to doubt.

    Returns
    -------
    xarray.Dataset
        ``doubts`` has one doubt in a line, and is empty where there are none.
    """
    from loadflow.turbines import load_turbine

    machine = load_turbine(turbine)
    before = str(case.coords["doubts"].item()) if "doubts" in case.coords else ""
    new = [] if simulated else find_doubts(case, machine)
    said = list(dict.fromkeys([*filter(None, before.split("\n")), *new]))
    return case.assign_coords(
        doubts=((), "\n".join(said), {"long_name": "what is doubtful about the series"}),
        standing_share=standing_share(case, machine.rated_speed),
    )


def find_doubts(case: xr.Dataset, turbine: Any) -> list[str]:
    """Compare one case with the turbine that it is said to be of.

    Parameters
    ----------
    case : xarray.Dataset
        ``speed``, ``hub_force``, ``hub_moment`` over time, in the frame and units of the cube.
    turbine : loadflow.turbines.Turbine
        The turbine.

    Returns
    -------
    list of str
        Doubts about weight, frame, torque and power, speed, step and wind.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.cube import make_series
    >>> from loadflow.readers import find_doubts
    >>> from loadflow.turbines import load_turbine
    >>> none = np.zeros((3, 2000))
    >>> data = {"speed": np.full(2000, 1.2), "hub_force": none, "hub_moment": none}
    >>> told = find_doubts(make_series(0.05 * np.arange(2000), data), load_turbine("nrel-5mw"))
    >>> told[0]
    'the mean of hub_force z is 0 kN; the rotor of NREL 5 MW weighs 1069 kN across the shaft'
    """
    if not {"speed", "hub_force", "hub_moment"} <= set(case.data_vars):
        return []
    rated_speed = turbine.rated_speed
    return [
        *_weight(case, turbine),
        *_frame(case),
        *_power(case, turbine, rated_speed),
        *_speed(case, turbine, rated_speed),
        *_step(case, turbine, rated_speed),
        *_wind(case),
    ]


def _weight(case: xr.Dataset, turbine: Any) -> Iterator[str]:
    """Mean vertical force against the weight of the rotor."""
    expected = -turbine.rotor_mass * GRAVITY * math.cos(turbine.rotor.tilt)
    y, z = (float(case["hub_force"].sel(axis=axis).astype(float).mean()) for axis in "yz")
    size = math.hypot(y, z)
    if abs(z / expected - 1) <= WEIGHT:
        return
    rotor = f"the rotor of {turbine.name} weighs {-expected / 1e3:.4g} kN across the shaft"
    if abs(size / abs(expected) - 1) <= WEIGHT:
        axis = ("+" if z > 0 else "-") + "z" if abs(z) > abs(y) else ("+" if y > 0 else "-") + "y"
        yield f"the weight acts along {axis} (mean {size / 1e3:.4g} kN) instead of -z; {rotor}"
    else:
        yield f"the mean of hub_force z is {z / 1e3:.4g} kN; {rotor}{_hint(z, expected)}"


def _frame(case: xr.Dataset) -> Iterator[str]:
    """Tell of a lateral force that turns with the rotor."""
    force = case["hub_force"].astype(float)
    lateral = force.sel(axis="y").values + 1j * force.sel(axis="z").values
    found = turning_order(lateral, case["speed"].values.astype(float), time_step(case))
    if found is None:
        return
    order, size, mean = found
    if order != 0 and size > 1.5 * mean:
        frame = (
            "the channels are those of the rotating frame"
            if order == -1
            else "a sign or the azimuth is wrong"
        )
        yield (
            f"the lateral force turns {order:+d} times a revolution ({size / 1e3:.4g} kN; its mean "
            f"is {mean / 1e3:.4g} kN): {frame}"
        )


def _power(case: xr.Dataset, turbine: Any, rated_speed: float) -> Iterator[str]:
    """Mean mechanical power against the rated one, and its sign."""
    torque = case["hub_moment"].sel(axis="x").astype(float)
    running = ~standing(case, rated_speed)
    if not bool(running.any()):
        return
    power = float((torque * case["speed"].astype(float)).where(running).mean())
    rated = turbine.control.rated_mechanical_power
    if power < -0.1 * rated:
        yield f"torque × speed is {power / 1e3:.4g} kW in the mean: the sign of one is turned"
    elif power > ABOVE_RATED * rated:
        yield (
            f"torque × speed is {power / 1e3:.4g} kW in the mean, {turbine.name} is rated at "
            f"{rated / 1e3:.4g} kW of the rotor{_hint(power, rated)}"
        )


def _speed(case: xr.Dataset, turbine: Any, rated_speed: float) -> Iterator[str]:
    speed = case["speed"].astype(float)
    largest, mean = float(abs(speed).max()), float(speed.mean())
    if largest > SPEED_FACTOR * rated_speed:
        yield (
            f"the rotor turns at up to {largest:.4g} rad/s, that of {turbine.name} is rated at "
            f"{rated_speed:.4g} rad/s{_hint(largest, rated_speed)}"
        )
    if mean < -0.1 * rated_speed:
        yield f"the mean rotor speed is {mean:.4g} rad/s: it must turn about +x"


def _step(case: xr.Dataset, turbine: Any, rated_speed: float) -> Iterator[str]:
    """Tell of a step that does not resolve the passing of the blades."""
    step = time_step(case)
    mean = abs(float(case["speed"].astype(float).mean()))
    frequency = turbine.rotor.blades * min(mean, SPEED_FACTOR * rated_speed) / (2 * math.pi)
    if frequency * step * SAMPLES_PER_3P > 1:
        yield (
            f"the step of {step:.4g} s gives {1 / (frequency * step):.2g} samples in a blade "
            f"passage ({frequency:.3g} Hz); {SAMPLES_PER_3P} are needed"
        )


def _wind(case: xr.Dataset) -> Iterator[str]:
    """Mean of the wind against what the label of the case says."""
    if "wind" not in case or "wind_speed" not in case.coords:
        return
    mean, said = float(case["wind"].astype(float).mean()), float(case["wind_speed"])
    if abs(mean - said) > max(WIND * said, 2.0):
        yield f"the mean wind is {mean:.3g} m/s, the load case is at {said:.3g} m/s"


def _hint(found: float, expected: float) -> str:
    """Name the units that such a ratio comes from."""
    if found == 0 or expected == 0:
        return ""
    ratio = abs(found / expected)
    for factor, units in NEIGHBOURS.items():
        for exponent in (1, -1):
            if abs(ratio / factor**exponent - 1) < 0.15:
                return f" (a factor of {ratio:.3g}, as between {units}: is the unit right?)"
    return ""
