"""Course over time of the transient conditions of IEC 61400-1, and the field they make.

Time counts from the start of the gust; before it nothing has changed. The operating gust and the
wind shear pass over, the direction changes stay.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.wind.field import Field, check_polar_grid
from loadflow.wind.iec import COHERENT_GUST, Floats

#: Periods T of the transient conditions, s.
PERIOD = {"EOG": 10.5, "EDC": 6.0, "ECD": 10.0, "EWS": 12.0}


def operating_gust(time: ArrayLike, amplitude: float) -> Floats:
    """Change of speed in the extreme operating gust, m/s (2.9): dip, peak of 0.74 V_gust, dip."""
    phase = _phase(time, "EOG")
    return -0.37 * amplitude * np.sin(3 * np.pi * phase) * (1 - np.cos(2 * np.pi * phase))


def direction_change(time: ArrayLike, angle: float) -> Floats:
    """Direction in the extreme direction change, rad (2.12); `angle` is θ_e with its sign."""
    return 0.5 * angle * (1 - np.cos(np.pi * _phase(time, "EDC")))


def coherent_gust(time: ArrayLike, angle: float) -> tuple[Floats, Floats]:
    """Change of speed (m/s) and direction (rad) in the coherent gust (2.14, 2.16)."""
    rise = 0.5 * (1 - np.cos(np.pi * _phase(time, "ECD")))
    return COHERENT_GUST * rise, angle * rise


def wind_shear(time: ArrayLike, amplitude: float) -> Floats:
    """Transient part of the extreme wind shear: difference of speed over one diameter, m/s."""
    return amplitude * (1 - np.cos(2 * np.pi * _phase(time, "EWS")))


def _phase(time: ArrayLike, gust: str) -> Floats:
    return np.clip(np.asarray(time, float) / PERIOD[gust], 0.0, 1.0)


def gust_field(
    time: ArrayLike,
    radius: ArrayLike,
    angles: ArrayLike,
    wind_speed: float,
    hub_height: float,
    shear_exponent: float = 0.2,
    *,
    rise: ArrayLike = 0.0,
    direction: ArrayLike = 0.0,
    vertical: ArrayLike = 0.0,
    horizontal: ArrayLike = 0.0,
) -> Field:
    """Field of a wind without turbulence that changes over time.

    Parameters
    ----------
    time : (nt,) array_like
        Time from 0, equidistant, s.
    radius, angles : array_like
        Polar grid of `Field`, m and rad.
    wind_speed, hub_height, shear_exponent : float
        Mean profile: m/s, m, -.
    rise : float or (nt,) array_like
        Change of the speed everywhere, m/s.
    direction : float or (nt,) array_like
        Turn of the wind, rad; > 0 blows toward +y (to the left when looking downwind).
    vertical, horizontal : float or (nt,) array_like
        Gradients of speed, 1/s, along z − z_hub and y.

    Returns
    -------
    Field
        The difference to the mean profile, exact at the grid points; `v` only if the wind turns.

    Raises
    ------
    InputError
        A grid that is not polar, or that reaches the ground.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.wind import gust_field, gusts, polar_angles
    >>> time = np.linspace(0.0, 10.5, 22)
    >>> rise = gusts.operating_gust(time, 5.0)
    >>> field = gust_field(time, [0.0, 60.0], polar_angles(8), 12.0, 90.0, rise=rise)
    >>> bool(np.allclose(field.hub, rise, atol=1e-5))
    True
    """
    grid_r, grid_a = np.asarray(radius, float), np.asarray(angles, float)
    check_polar_grid(grid_r, grid_a)
    t = np.asarray(time, float)
    along_z = grid_r[:, None] * np.cos(grid_a)
    along_y = -grid_r[:, None] * np.sin(grid_a)
    if grid_r[-1] >= hub_height:
        raise InputError(
            f"radius {grid_r[-1]} m reaches the ground below the hub at {hub_height} m"
        )
    mean = wind_speed * (1 + along_z / hub_height) ** shear_exponent

    def over_time(x: ArrayLike) -> Floats:
        return np.broadcast_to(np.asarray(x, float), t.shape)[:, None, None]

    change = over_time(rise) + over_time(vertical) * along_z + over_time(horizontal) * along_y
    turn = over_time(direction)
    u = change * np.cos(turn) - mean * (1 - np.cos(turn))
    v = ((mean + change) * np.sin(turn)).astype(np.float32) if np.any(turn) else None
    return Field(t, grid_r, grid_a, u.astype(np.float32), v, None, wind_speed, shear_exponent)
