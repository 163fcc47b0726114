"""Turbulent wind on a polar grid around the hub: what the rotor samples along its path."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError


@dataclass(frozen=True, eq=False)
class Field:
    """Fluctuation of the wind about its mean on a polar grid in the rotor plane.

    The mean profile is not in it: the wind at height z is
    ``wind_speed * (z / hub_height) ** shear_exponent + u``.

    Attributes
    ----------
    time : (nt,) ndarray
        Time from 0, equidistant, s.
    radius : (nr,) ndarray
        Radii, rising, m; ``radius[0] == 0`` is the hub centre, repeated over all angles.
    angle : (na,) ndarray
        Equidistant angles from 0 in [0, 2π), rad: 0 is up (+z), rising clockwise as seen from
        upwind, the azimuth of a rotor that turns clockwise.
    u, v, w : (nt, nr, na) ndarray of float32
        Downwind (+x), lateral (+y, to the left when looking downwind) and vertical (+z, up)
        fluctuation, m/s; `v` and `w` may be None.
    wind_speed : float
        Mean speed at the hub, m/s.
    shear_exponent : float
        Exponent of the mean profile.

    Examples
    --------
    >>> from loadflow.wind import kaimal, polar_angles
    >>> field = kaimal(12.0, 1.8, radius=[0.0, 30.0, 60.0], angles=polar_angles(8), duration=10.0,
    ...     dt=0.5, seed=1, hub_height=90.0)
    >>> field.u.shape, field.hub.shape
    ((21, 3, 8), (21,))
    """

    time: NDArray[np.float64]
    radius: NDArray[np.float64]
    angle: NDArray[np.float64]
    u: NDArray[np.float32]
    v: NDArray[np.float32] | None
    w: NDArray[np.float32] | None
    wind_speed: float
    shear_exponent: float

    def __post_init__(self) -> None:
        check_polar_grid(self.radius, self.angle)
        shape = (len(self.time), len(self.radius), len(self.angle))
        for name in ("u", "v", "w"):
            component = getattr(self, name)
            if component is not None and component.shape != shape:
                raise InputError(f"{name} has shape {component.shape}, the grid is {shape}")

    @property
    def hub(self) -> NDArray[np.float32]:
        """Downwind fluctuation at the hub centre, (nt,), m/s."""
        return self.u[:, 0, 0]

    @property
    def y(self) -> NDArray[np.float64]:
        """Lateral positions of the grid, (nr, na), m."""
        return -self.radius[:, None] * np.sin(self.angle)

    @property
    def z(self) -> NDArray[np.float64]:
        """Heights of the grid above the hub, (nr, na), m."""
        return self.radius[:, None] * np.cos(self.angle)


def polar_angles(count: int) -> NDArray[np.float64]:
    """`count` equidistant angles from 0 in [0, 2π), rad.

    Parameters
    ----------
    count : int
        How many, at least 3.

    Returns
    -------
    ndarray (count,)
        0, 2π/count, 4π/count, …, rad.

    Raises
    ------
    InputError
        Fewer than 3.

    Examples
    --------
    >>> from loadflow.wind import polar_angles
    >>> polar_angles(4).round(3).tolist()
    [0.0, 1.571, 3.142, 4.712]
    """
    if count < 3:
        raise InputError(f"a polar grid needs at least 3 angles, not {count}")
    return 2 * np.pi * np.arange(count) / count


def check_polar_grid(radius: NDArray[np.float64], angle: NDArray[np.float64]) -> None:
    """Raise `InputError` unless the radii rise from 0 and the angles are `polar_angles`."""
    if radius.ndim != 1 or len(radius) < 2 or radius[0] != 0 or np.any(np.diff(radius) <= 0):
        raise InputError(f"radius must rise from 0 (hub centre), got {radius}")
    if angle.ndim != 1 or not np.allclose(angle, polar_angles(len(angle)), rtol=0, atol=1e-9):
        raise InputError(f"angle must be equidistant from 0 in [0, 2π), got {angle}")
