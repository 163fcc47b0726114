"""Stationary and periodic design loads of a bearing, as samples that the films and rollers read.

The kinds are those of [Jonuschies 2015], 4.3.1 and 4.3.2. What governs a bearing (radial force or
tilting moment) is reduced. Of stationary loads the other load and the tilt of the shaft are those
of the same instant, or their means. Over a period the other load has its mean, and the shaft tilts
and bends with the load as it did in the series.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import xarray as xr

from loadflow.reduction import (
    FrequencyBounds,
    PeriodicLoad,
    closing_period,
    frequency_bounds,
    periodic,
    stationary,
)
from loadflow.scene.journal import Journal
from loadflow.scene.scene import Reduction
from loadflow.stages.films.response import SAMPLES, film_response
from loadflow.stages.frames import to_film
from loadflow.stages.labelling import label

Floats = np.ndarray

CLOSING = 0.01
"""Allowed relative change of a frequency so that the orbit closes."""

_LINE = ("tilt", "curvature")


@dataclass(frozen=True)
class Governed:
    """The loads of a bearing over a series.

    Attributes
    ----------
    time, speed : ndarray, shape (n,)
        s and rad/s.
    vectors : mapping of ndarray, shape (n, 3)
        ``force`` and ``moment``, and where the shaft is a beam ``tilt`` and ``curvature``, in the
        frame of the cube.
    by_moment : bool
        Whether the moment governs it, and not the force.
    source : str
        What it is.
    """

    time: Floats
    speed: Floats
    vectors: Mapping[str, tuple[Floats, Mapping[str, Any]]]
    by_moment: bool
    source: str

    @property
    def governing(self) -> str:
        """Name of the load that is reduced."""
        return "moment" if self.by_moment else "force"


def stationary_samples(loads: Governed) -> xr.Dataset:
    """Mean with mean, largest with slowest, and the moments at which something is extreme.

    All the weight is on the mean load; the others have no duration.
    """
    values = loads.vectors[loads.governing][0]
    found = stationary(loads.speed, to_film(values), loads.time)
    picks = (found.mean, found.maximum, *found.envelope)
    largest = int(np.argmax(np.hypot(*to_film(values).T)))
    places = np.array(
        [largest if pick.index is None else pick.index for pick in picks], dtype=np.int64
    )
    several = {name: vectors[places] for name, (vectors, _) in loads.vectors.items()}
    for name, (vectors, _) in loads.vectors.items():
        several[name][0] = vectors.mean(axis=0)
    weight = np.zeros(len(picks))
    weight[0] = loads.time.size
    return _labelled(
        loads,
        time=loads.time[places],
        speed=np.array([pick.speed for pick in picks]),
        weight=weight,
        several=several,
        names=[pick.name for pick in picks],
    )


def periodic_samples(loads: Governed, options: Reduction, journal: Journal | None) -> xr.Dataset:
    """Mean, base load and additional loads over the period in which they close.

    Parameters
    ----------
    loads : Governed
        Of the bearing.
    options : Reduction
        Bounds, number of additional loads, orders.
    journal : Journal, optional
        Whose film says which frequencies matter, if no bounds are given (4.23–4.27).

    Raises
    ------
    loadflow.errors.SolverError
        The film has no closed orbit at a trial frequency.
    """
    values = loads.vectors[loads.governing][0]
    radial = to_film(values)
    bounds: tuple[float, float] | FrequencyBounds | None = options.bounds
    if bounds is None and journal is not None:
        response = film_response(journal, float(loads.speed.mean()))
        bounds = frequency_bounds(response, radial.mean(axis=0), np.sqrt(2.0) * radial.std(axis=0))
    load = periodic(
        loads.speed, radial, loads.time, bounds=bounds, additional=options.additional,
        orders=options.orders,
    )  # fmt: skip
    return closed_samples(loads, load, bounds)


def closed_samples(
    loads: Governed, load: PeriodicLoad, bounds: tuple[float, float] | FrequencyBounds | None
) -> xr.Dataset:
    """One period of a periodic load, its frequencies rounded so that it closes."""
    load = load.closed(CLOSING)
    if load.frequencies:
        period = closing_period(load.frequencies, 1e-9).period
        step = 1.0 / (SAMPLES * max(load.frequencies))
    else:
        period, step = float(np.ptp(loads.time)), float(np.ptp(loads.time)) / SAMPLES
    time, closed = load.series(step, period)
    several = {
        name: np.broadcast_to(vectors.mean(axis=0), (time.size, 3)).copy()
        for name, (vectors, _) in loads.vectors.items()
    }
    several[loads.governing][:, 2], several[loads.governing][:, 1] = -closed[:, 0], closed[:, 1]
    told: dict[str, float] = {}
    pushed = to_film(loads.vectors[loads.governing][0])
    for name in _LINE:
        if name in several:
            slope, told[f"{name}_left_out"] = _along(pushed, loads.vectors[name][0])
            several[name] += (closed - pushed.mean(axis=0)) @ slope
    weight = np.full(time.size, loads.time.size / (time.size - 1))
    weight[-1] = 0.0  # the first again
    found = _labelled(
        loads,
        time=time,
        speed=np.full(time.size, load.speed),
        weight=weight,
        several=several,
        names=None,
    )
    told |= {"closed": 1, "period": period, "harmonics": len(load.frequencies)}
    if isinstance(bounds, FrequencyBounds):
        bounds = bounds.low, bounds.high
    if bounds is not None:
        told |= {"slow_bound": bounds[0], "fast_bound": bounds[1]}
    return found.assign_attrs(told)


def _along(load: Floats, line: Floats) -> tuple[Floats, float]:
    """How a tilt or bend (n, 3) goes with a load (n, 2): slope (2, 3), and the share it leaves.

    Least squares over the series, so that the line follows each load at the instant it acts; what
    is left is what other loads of the hub do to it, over all that it moves.
    """
    pushed, moved = load - load.mean(axis=0), line - line.mean(axis=0)
    slope = np.linalg.lstsq(pushed, moved, rcond=None)[0]
    across = np.sqrt(np.mean(moved[:, 1:] ** 2))
    left = np.sqrt(np.mean((moved - pushed @ slope)[:, 1:] ** 2))
    return slope, float(left / across) if across > 0 else 0.0


def _labelled(
    loads: Governed,
    *,
    time: Floats,
    speed: Floats,
    weight: Floats,
    several: Mapping[str, Floats],
    names: list[str] | None,
) -> xr.Dataset:
    words = {"force": "force on the bearing", "moment": "moment on the bearing"}
    units = {"force": "N", "moment": "N m"}
    variables: dict[str, Any] = {
        "time": ("sample", time, label("s", "time")),
        "speed": ("sample", speed, label("rad/s", "rotor speed")),
        "weight": ("sample", weight, label("1", "samples of the full series")),
    }
    for name, values in several.items():
        about = label(units[name], words[name]) if name in words else loads.vectors[name][1]
        variables[name] = ("sample", "axis"), values, dict(about)
    coords: dict[str, Any] = {"axis": ["x", "y", "z"]}
    if names is not None:
        coords["load_name"] = "sample", names
    return xr.Dataset(variables, coords, {"source": loads.source})
