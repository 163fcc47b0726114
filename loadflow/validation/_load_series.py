"""Numbers by which two load series in different winds are compared."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.cube import time_step

Array = NDArray[np.float64]

BANDS = {"0 … 0.1 Hz": (0.0, 0.1), "0.1 … 0.5 Hz": (0.1, 0.5), "3p": (2.7, 3.3)}
"""Limits of the bands of the power spectrum, Hz; of the last one in rotor speeds."""
SWINGING = ("root flap", "root edge", "yaw bearing")
"""Moments of bearings beside the shaft, in the order of their rows."""
MEASURES = ("mean", "std", *BANDS, "DEL m = 4", "highest", "lowest")


def measures(signal: Array, step: float, speed: float) -> dict[str, float]:
    """Mean, standard deviation, power in the bands, damage-equivalent range at 1 Hz, extremes.

    Parameters
    ----------
    signal : ndarray, shape (n,)
    step : float
        s.
    speed : float
        Mean of the rotor, rad/s.
    """
    from scipy.signal import welch

    from loadflow.reduction.fatigue import damage_equivalent_load

    frequency, power = welch(signal, 1 / step, nperseg=min(8192, signal.size))
    out = {"mean": signal.mean(), "std": signal.std()}
    for name, band in BANDS.items():
        low, high = np.array(band) * (speed / (2 * np.pi) if name == "3p" else 1.0)
        inside = (frequency > low) & (frequency <= high)
        out[name] = power[inside].sum() * frequency[1]
    out["DEL m = 4"] = float(damage_equivalent_load(signal, 4.0, signal.size * step))
    return {k: float(v) for k, v in out.items()} | {
        "highest": float(signal.max()),
        "lowest": float(signal.min()),
    }


def channels(series: xr.Dataset, tilt: float) -> dict[str, Array]:
    """Thrust, tilt and yaw moment and the forces on N and N2 of one series, kN and kN m; wind, m/s.

    `tilt` of the shaft, rad. Moments of the yaw bearing of the NREL 5 MW and, where the series has
    them, of blade 1 at its root, too.
    """
    from loadflow.shaft import TwoPoint, YawBearing, bearing_loads, yaw_loads

    force, moment = series["hub_force"].values, series["hub_moment"].values
    bearings = bearing_loads(TwoPoint(), force, moment, tilt=tilt, time=series["time"].values)
    out = {"thrust": force[0], "tilt moment": moment[1], "yaw moment": moment[2]}
    for name in bearings["bearing"].values:
        for axis, label in (("z", "vertical"), ("y", "lateral")):
            out[f"{name} {label}"] = bearings["force"].sel(bearing=name, axis=axis).values
    out["yaw bearing"] = yaw_loads(YawBearing(), force, moment, tilt=tilt)["moment"].values[0, 2]
    if "root_moment" in series:
        out["root edge"], out["root flap"] = series["root_moment"].values[1:]
    wind = series["wind"].values.reshape(-1, force.shape[1])[0]
    return {k: np.asarray(v, float) / 1e3 for k, v in out.items()} | {"wind": wind.astype(float)}


def each(series: Iterable[xr.Dataset], tilt: float) -> dict[str, dict[str, Array]]:
    """Measures of each of the series, by channel and measure."""
    rows = []
    for one in series:
        step = time_step(one)
        speed = float(one["speed"].mean())
        rows.append({n: measures(x, step, speed) for n, x in channels(one, tilt).items()})
    return {
        channel: {m: np.array([row[channel][m] for row in rows]) for m in MEASURES}
        for channel in rows[0]
    }


def compare(series: Iterable[xr.Dataset], tilt: float) -> dict[str, dict[str, float]]:
    """Means over the series of their measures, by channel and measure."""
    return {
        channel: {m: float(values.mean()) for m, values in of_channel.items()}
        for channel, of_channel in each(series, tilt).items()
    }
