"""Films of thrust bearings and pairs of cones with other loads, oil or data than a run had."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeGuard

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.thrust.curves import gives_way
from loadflow.scene.thrust import AnyAxial, ThrustCollar
from loadflow.stages.frames import to_rolling
from loadflow.stages.thrust import tilt_in_frame

Array = NDArray[np.float64]


@dataclass(frozen=True)
class PadFilms:
    """Films under some samples; NaN where there is none.

    Attributes
    ----------
    minimum_film, maximum_pressure, friction_power, side_flow : array (n,)
        m; Pa, absolute; W; m³/s.
    touching : array of bool (n,)
        Whether the surfaces touch.
    temperature : array (n,)
        Of the warmer film, K; NaN without heat.
    """

    minimum_film: Array
    maximum_pressure: Array
    friction_power: Array
    side_flow: Array
    touching: NDArray[np.bool_]
    temperature: Array

    @property
    def carried(self) -> NDArray[np.bool_]:
        """Which samples have a film."""
        return np.isfinite(self.minimum_film) & ~self.touching

    def thinnest(self, counted: NDArray[np.bool_] | slice = slice(None)) -> float:
        """Thinnest film of those that count, m; 0 where one of them has none."""
        return float(np.where(self.carried, self.minimum_film, 0.0)[counted].min(initial=np.inf))

    def highest(self, counted: NDArray[np.bool_] | slice = slice(None)) -> float:
        """Largest pressure of those that count, Pa; infinite where one of them has no film."""
        return float(np.where(self.carried, self.maximum_pressure, np.inf)[counted].max(initial=0))


def tabulated(bearing: AnyAxial) -> TypeGuard[ThrustCollar]:
    """Whether films of a bearing can be taken from tables: a collar with rigid pads."""
    if bearing.kind != "thrust":
        return False
    return not any(map(gives_way, (bearing.geometry, bearing.back or bearing.geometry)))


def span_of(bearing: AnyAxial) -> tuple[float, float] | None:
    """Gaps of the tables of a collar, m, which those that differ little share; None without."""
    return bearing.series(False).ends if tabulated(bearing) else None


def pad_films(
    bearing: AnyAxial,
    samples: xr.Dataset,
    moving: bool = False,
    span: tuple[float, float] | None = None,
) -> PadFilms:
    """Films of one bearing, warm if it has heat, tilted if the samples say how.

    Collars with rigid pads have theirs from tables, which serve all loads, speeds, oils and
    temperatures: a sample takes microseconds there, some 0.2 s on the grid, and 1 s tilted. All
    else is solved on the grid.

    Parameters
    ----------
    bearing : ThrustCollar or ConePair
        Of a scene.
    samples : xarray.Dataset
        `speed` (sample), `force`, `moment` and, where it acts, `tilt` (sample, axis), in the frame
        of the cube; `time` (sample) of a collar that is followed.
    moving : bool
        Whether a collar with tables is followed along all of them, in their order.
    span : (float, float), optional
        Of `span_of`, of the bearing whose tables serve.
    """
    force, moment = (
        to_rolling(samples[name].transpose("sample", "axis").values.astype(float))
        for name in ("force", "moment")
    )
    speed, tilt = samples["speed"].values.astype(float), tilt_in_frame(samples)
    if not tabulated(bearing):
        return _on_grid(bearing, force, moment, speed, tilt)
    series = bearing.series(tilt is not None, span)
    turned = np.zeros(2) if tilt is None else tilt
    if moving:
        found = series.path(samples["time"].values.astype(float), force[:, 2], speed, turned)
    else:
        found = series.equilibrium(force[:, 2], speed, turned)
    return PadFilms(
        found.minimum_film,
        found.maximum_pressure,
        found.friction_power,
        found.side_flow,
        found.touching,
        found.temperature,
    )


def _on_grid(
    bearing: AnyAxial, force: Array, moment: Array, speed: Array, tilt: Array | None
) -> PadFilms:
    values, touching = np.full((5, speed.size), np.nan), np.zeros(speed.size, bool)
    for k in range(speed.size):
        turned = None if tilt is None else tilt[k]
        try:
            answer = bearing.solve(force[k], moment[k], float(speed[k]), turned)
        except SolverError:
            touching[k] = bearing.touches(force[k], float(speed[k]))
            continue
        touching[k] = answer.minimum_film < bearing.contact_film
        if not touching[k]:
            values[:4, k] = [
                getattr(answer, name)
                for name in ("minimum_film", "maximum_pressure", "friction_power", "side_flow")
            ]
            values[4, k] = getattr(answer, "temperature", np.nan)  # cones have no heat
    film, pressure, power, flow, temperature = values
    return PadFilms(film, pressure, power, flow, touching, temperature)
