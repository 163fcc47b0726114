"""Turbulent wind on a rectangular grid across the wind, as the file formats have it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.wind.field import Field, check_polar_grid

LARGEST = float(np.finfo(np.float32).max)
"""Wind that a box can hold, m/s."""


@dataclass(frozen=True, eq=False)
class Box:
    """Fluctuation of the wind about its mean on a rectangular grid.

    Attributes
    ----------
    time : (nt,) ndarray
        Time from 0, equidistant, s.
    y, z : (ny,), (nz,) ndarray
        Lateral positions (to the left when looking downwind) and heights above ground, m; rising.
    u, v, w : (nt, ny, nz) ndarray of float32
        Downwind, lateral and upward fluctuation, m/s; `v` and `w` may be None.
    wind_speed, hub_height, shear_exponent : float
        Mean speed at the hub (m/s), hub height (m), exponent of the mean profile.

    Examples
    --------
    >>> from loadflow.wind import kaimal_box
    >>> box = kaimal_box(12.0, 1.8, y=[-20.0, 0.0, 20.0], z=[70.0, 90.0], hub_height=80.0,
    ...     duration=10.0, dt=0.5, seed=1)
    >>> box.u.shape, box.wind_speed
    ((21, 3, 2), 12.0)
    """

    time: NDArray[np.float64]
    y: NDArray[np.float64]
    z: NDArray[np.float64]
    u: NDArray[np.float32]
    v: NDArray[np.float32] | None
    w: NDArray[np.float32] | None
    wind_speed: float
    hub_height: float
    shear_exponent: float

    def __post_init__(self) -> None:
        for name in ("time", "y", "z"):
            line = getattr(self, name)
            rises = line.ndim == 1 and len(line) > 1 and bool(np.all(np.diff(line) > 0))
            if not (rises and np.isfinite(line).all()):
                raise InputError(f"{name} must rise, got {line}")
        for name, least in (("wind_speed", 0), ("hub_height", 0), ("shear_exponent", -np.inf)):
            if not least < getattr(self, name) < np.inf:
                allowed = "finite" if least else "positive and finite"
                raise InputError(f"{name} = {getattr(self, name)} of the box must be {allowed}")
        shape = (len(self.time), len(self.y), len(self.z))
        for name in ("u", "v", "w"):
            component = getattr(self, name)
            if component is not None and component.shape != shape:
                raise InputError(f"{name} has shape {component.shape}, the grid is {shape}")

    def to_polar(self, radius: ArrayLike, angle: ArrayLike) -> Field:
        """Interpolate linearly to a polar grid around the hub.

        Between grid points linear interpolation loses variance at high frequencies; put a grid
        point at the hub and make the spacing small where it matters.

        Raises
        ------
        InputError
            If the disc leaves the box.
        """
        radius, angle = np.asarray(radius, float), np.asarray(angle, float)
        check_polar_grid(radius, angle)
        y = -radius[:, None] * np.sin(angle)
        z = self.hub_height + radius[:, None] * np.cos(angle)
        for name, line, points in (("y", self.y, y), ("z", self.z, z)):
            slack = 1e-6 * (line[-1] - line[0])
            if points.min() < line[0] - slack or points.max() > line[-1] + slack:
                raise InputError(
                    f"the rotor disc, {name} = {points.min():.2f} … {points.max():.2f} m, "
                    f"leaves the box, {line[0]:.2f} … {line[-1]:.2f} m"
                )
        i, right = _cell(self.y, y)
        j, upper = _cell(self.z, z)
        corners = (
            (i, j, (1 - right) * (1 - upper)),
            (i + 1, j, right * (1 - upper)),
            (i, j + 1, (1 - right) * upper),
            (i + 1, j + 1, right * upper),
        )

        def sample(component: NDArray[np.float32] | None) -> NDArray[np.float32] | None:
            if component is None:
                return None
            total = np.zeros((len(self.time), *y.shape), np.float32)
            for iy, iz, weight in corners:
                total += component[:, iy, iz] * weight
            return total

        u = sample(self.u)
        assert u is not None
        return Field(
            self.time, radius, angle, u, sample(self.v), sample(self.w),
            self.wind_speed, self.shear_exponent,
        )  # fmt: skip


def _cell(
    line: NDArray[np.float64], points: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float32]]:
    """Index of the cell of each point and its place in it, 0 … 1."""
    index = np.clip(np.searchsorted(line, points, side="right") - 1, 0, len(line) - 2)
    place = (points - line[index]) / (line[index + 1] - line[index])
    return index, np.clip(place, 0, 1).astype(np.float32)


def fitted_profile(
    z: NDArray[np.float64],
    spacing: float,
    hub_height: float,
    speed: NDArray[np.float64],
    source: object,
) -> tuple[float, NDArray[np.float64]]:
    """Exponent of the power law nearest to a profile relative to the hub's, and that law at `z`.

    Raises
    ------
    InputError
        No height but that of the hub has a mean wind from ahead; names the `source`.
    """
    above = (z > 0) & (speed > 0)
    log_z = np.log(z[above] / hub_height)
    if not np.any(log_z):
        raise InputError(f"{source}: no height beside the hub's has a mean wind from ahead")
    exponent = float(log_z @ np.log(speed[above]) / (log_z @ log_z))
    # a power of the ground may be infinite
    return exponent, (np.maximum(z, 0.5 * spacing) / hub_height) ** exponent


def spacing_of(name: str, line: NDArray[np.float64]) -> float:
    """Distance of equidistant grid points, m.

    Raises
    ------
    InputError
        If they are not.
    """
    steps = np.diff(line)
    if not steps.size or np.ptp(steps) > 1e-3 * abs(steps[0]):
        raise InputError(f"equidistant {name} are needed, got {line}")
    return float(steps.mean())
