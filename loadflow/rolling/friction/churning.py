"""Churning of the oil or grease: a law with two measured constants.

No closed form of churning is trustworthy for a given bearing (in von Hollen 2013 it was the
largest gap between model and measurement). So the form is that of a body in a fluid, torque =
a η ω + b ρ ω²: friction of slow flow, inertia of fast flow. Both constants are fitted to a run
without load.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from annotated_types import Ge
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields


@dataclass(frozen=True)
class Churning:
    """Churning torque a η ω + b ρ ω |ω|.

    Attributes
    ----------
    viscous : float
        a, m³.
    inertial : float
        b, m⁵.

    Examples
    --------
    >>> from loadflow.rolling.friction import Churning
    >>> Churning(viscous=1e-4).inertial
    0.0
    """

    viscous: Annotated[float, Ge(0)] = 0.0
    inertial: Annotated[float, Ge(0)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)

    def torque(
        self, speed: ArrayLike, viscosity: ArrayLike, density: ArrayLike
    ) -> NDArray[np.float64]:
        """Torque, N m, at `speed` (rad/s), dynamic `viscosity` (Pa s) and `density` (kg/m³)."""
        omega = np.asarray(speed, float)
        slow = self.viscous * np.asarray(viscosity, float) * omega
        return np.asarray(slow + self.inertial * np.asarray(density, float) * omega * np.abs(omega))


def fit_churning(
    speed: ArrayLike, torque: ArrayLike, viscosity: ArrayLike, density: ArrayLike
) -> Churning:
    """Constants of `Churning` from torques measured without load, both kept from falling below 0.

    Parameters
    ----------
    speed : array_like, shape (n,)
        rad/s.
    torque : array_like, shape (n,)
        N m, other losses taken off.
    viscosity, density : array_like
        Pa s and kg/m³ at each point.

    Returns
    -------
    Churning
        a and b of least squares, m³ and m⁵, none below 0.

    Raises
    ------
    InputError
        Fewer than two points, or values that are not finite.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling.friction import fit_churning
    >>> speed = np.array([50.0, 100.0, 200.0])
    >>> fitted = fit_churning(speed, 2e-3 * 0.02 * speed, viscosity=0.02, density=850.0)
    >>> round(fitted.viscous, 6)
    0.002
    """
    from scipy.optimize import nnls

    omega, eta, rho, moment = np.broadcast_arrays(
        *(np.asarray(v, float) for v in (speed, viscosity, density, torque))
    )
    if omega.ndim != 1 or omega.size < 2 or not np.isfinite([omega, eta, rho, moment]).all():
        raise InputError(f"speed, torque: need two or more finite points, got {omega.size}")
    terms = np.stack([eta * omega, rho * omega * np.abs(omega)], axis=1)
    scale = np.maximum(np.abs(terms).max(axis=0), 1e-300)
    constants, _ = nnls(terms / scale, moment)
    viscous, inertial = constants / scale
    return Churning(float(viscous), float(inertial))
