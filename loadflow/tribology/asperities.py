"""Film against roughness: Λ, contact of asperities, and the share of the load that they carry.

References
----------
Zhou, Hoeprich: Torque of Tapered Roller Bearings. J. Tribology 113 (1991) 590. Greenwood, Tripp:
The contact of two nominally flat rough surfaces. Proc. IMechE 185 (1970) 625.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.fields import check_fields

Array = NDArray[np.float64]
Value = float | NDArray[np.float64]

_REACH = 12.0  # film parameter above which asperities carry less than rounding


def combined_roughness(first: Value, second: Value) -> Value:
    """Combined roughness σ = √(R_q1² + R_q2²), m.

    Parameters
    ----------
    first, second : float or ndarray
        R_q of both surfaces, m.

    Returns
    -------
    float or ndarray
        σ, m.

    Examples
    --------
    >>> round(float(combined_roughness(0.3e-6, 0.4e-6)) * 1e6, 3)
    0.5
    """
    return np.sqrt(first * first + second * second)


def film_parameter(film: Value, roughness: Value) -> Value:
    """Λ = h/σ, (8.2) of von Hollen 2013; at least 5 keeps ground surfaces apart.

    Parameters
    ----------
    film : float or ndarray
        Film thickness h, m.
    roughness : float or ndarray
        Combined roughness σ, m.

    Returns
    -------
    float or ndarray
        Λ.

    Examples
    --------
    >>> round(float(film_parameter(3.8, combined_roughness(0.31, 0.533))), 2)
    6.16
    """
    return film / roughness


SHARE_POWER = 1.2
"""Of the film parameter in the share of the load that asperities carry."""


def asperity_share(parameter: Value, rate: float = 1.8, power: float = SHARE_POWER) -> Value:
    """Share exp(-B Λ^C) of the load that asperities carry, of Zhou and Hoeprich.

    Parameters
    ----------
    parameter : float or ndarray
        Λ.
    rate, power : float
        B and C.

    Returns
    -------
    float or ndarray
        0 … 1.

    Examples
    --------
    >>> round(float(asperity_share(1.0)), 4)
    0.1653
    """
    return np.exp(-rate * np.minimum(parameter, 1e3) ** power)


def greenwood_tripp(order: float, separation: ArrayLike) -> NDArray[np.float64]:
    """Integral F_n(u) = ∫ (s - u)^n φ(s) ds of Gaussian heights φ above u, within 3e-9.

    By the parabolic cylinder function, Γ(n+1)/√(2π) exp(-u²/4) D_{-n-1}(u). The power law
    4.4086e-5 (4 - u)^6.804 in common use is off by 11 % below u = 2 and by 74 % at u = 3.

    Parameters
    ----------
    order : float
        n > -1; 5/2 for the pressure, 2 for the area of contact.
    separation : array_like
        u = h/σ of the mean planes.

    Returns
    -------
    ndarray
        F_n(u).

    Examples
    --------
    >>> greenwood_tripp(2.5, [0.0, 2.0]).round(6).tolist()
    [0.616634, 0.005424]
    """
    from scipy.special import gamma, pbdv

    u = np.asarray(separation, float)
    cylinder, _ = pbdv(-order - 1.0, u)
    return np.asarray(gamma(order + 1.0) / np.sqrt(2 * np.pi) * np.exp(-u * u / 4) * cylinder)


def asperity_pressure(
    separation: ArrayLike,
    contact_modulus: float,
    roughness: float,
    tip_radius: float,
    density: float,
) -> NDArray[np.float64]:
    """Pressure that touching asperities carry after Greenwood and Tripp, Pa.

    p = 16√2 π/15 (σ β η)² √(σ/β) E* F_5/2(h/σ).

    Parameters
    ----------
    separation : array_like
        h/σ.
    contact_modulus : float
        E*, Pa (`loadflow.tribology.hertz.effective_modulus`).
    roughness : float
        Combined roughness σ of the heights of the asperities, m.
    tip_radius : float
        Radius β of an asperity, m.
    density : float
        Asperities of one surface in an area, η, 1/m².

    Returns
    -------
    ndarray
        Pa.

    Examples
    --------
    >>> p = asperity_pressure([0.0, 2.0], 115e9, 0.5e-6, 20e-6, 4e9)
    >>> (p / 1e6).round(4).tolist()
    [85.0176, 0.7478]
    """
    contact = AsperityContact.of_tips(roughness, contact_modulus, tip_radius, density)
    return contact.pressure(np.asarray(separation, float) * roughness)


@dataclass(frozen=True, kw_only=True)
class AsperityContact:
    """Elastic contact of two rough surfaces [Greenwood and Tripp 1970].

    Gap h is that of the mean planes, m, of any sign; all methods broadcast over arrays and compile
    to 1e-8 s a point. Inside a loop, take `loadflow.tribology.kernels.pressure_integral`
    times `scale`.

    Attributes
    ----------
    roughness : float
        Combined roughness σ of the heights of the asperities, m: of their summits where
        `summit_height` is given.
    contact_modulus : float
        E*, Pa (`loadflow.tribology.hertz.effective_modulus`).
    factor : float
        K = 16√2 π/15 (σβη)² √(σ/β) of p = K E* F_5/2((h − δ)/σ).
    crowding : float
        σβη: roughness × radius of the tips × tips in an area; 0.03 … 0.05 for most surfaces. Gives
        the real area of contact.
    summit_height : float
        δ, how far the mean of the summits lies above the mean plane, of both surfaces together, m.
        0 takes all heights for summits.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> contact = AsperityContact(roughness=0.5e-6, contact_modulus=115e9, factor=1e-3)
    >>> round(float(contact.pressure(1e-6)) / 1e6, 4)
    0.6237
    >>> round(float(contact.gap(0.6237e6)) * 1e6, 3)
    1.0
    """

    roughness: Annotated[float, Gt(0), Le(1e-3)]
    contact_modulus: Annotated[float, Gt(0)]
    factor: Annotated[float, Gt(0), Le(1)]
    crowding: Annotated[float, Gt(0), Le(1)] = 0.04
    summit_height: Annotated[float, Ge(0), Le(1e-3)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)

    @classmethod
    def of_tips(
        cls,
        roughness: float,
        contact_modulus: float,
        tip_radius: float,
        density: float,
        summit_height: float = 0.0,
    ) -> AsperityContact:
        """Contact of surfaces whose tips are known.

        Parameters
        ----------
        roughness : float
            σ, m.
        contact_modulus : float
            E*, Pa.
        tip_radius : float
            Radius β of an asperity, m.
        density : float
            Asperities of one surface in an area, η, 1/m².
        summit_height : float
            δ, m.
        """
        if not (tip_radius > 0 and density > 0):
            raise InputError(
                f"tip_radius, density: must be > 0 m and > 0 1/m², got {tip_radius}, {density}"
            )
        crowding = roughness * tip_radius * density
        factor = 16 * np.sqrt(2) * np.pi / 15 * crowding**2 * np.sqrt(roughness / tip_radius)
        return cls(
            roughness=roughness,
            contact_modulus=contact_modulus,
            factor=float(factor),
            crowding=crowding,
            summit_height=summit_height,
        )

    @property
    def scale(self) -> float:
        """K E*, Pa."""
        return self.factor * self.contact_modulus

    @property
    def reach(self) -> float:
        """Gap of the mean planes above which asperities carry less than rounding, m."""
        return self.summit_height + _REACH * self.roughness

    def pressure(self, gap: ArrayLike) -> Array:
        """Mean pressure that asperities carry at a gap h (m), Pa."""
        return self.scale * self._integrals(gap)[0]

    def pressure_slope(self, gap: ArrayLike) -> Array:
        """Derivative dp/dh at a gap h (m), Pa/m, never positive."""
        return self.scale / self.roughness * self._integrals(gap)[1]

    def area(self, gap: ArrayLike) -> Array:
        """Real over nominal area of contact at a gap h (m): π² (σβη)² F_2((h − δ)/σ).

        The elastic law holds while this is well below 1; it is not cut there.
        """
        return (np.pi * self.crowding) ** 2 * self._integrals(gap)[2]

    def gap(self, pressure: ArrayLike) -> Array:
        """Gap at which asperities carry a pressure (Pa, not negative), m; infinite for 0.

        Raises
        ------
        InputError
            If the pressure is negative or not finite.
        SolverError
            If the iteration does not converge.
        """
        p = np.asarray(pressure, float)
        if not np.all(np.isfinite(p) & (p >= 0)):
            raise InputError(f"pressure: must be finite and ≥ 0 Pa, got {p}")
        target = np.log(np.maximum(p, 1e-300 * self.scale) / self.scale)
        # ln F_5/2 is concave: after one step Newton's method comes from above and never passes
        u = np.zeros_like(target)
        for _ in range(60):
            value, slope = self._integrals(self.roughness * u + self.summit_height)[:2]
            step = (np.log(value) - target) * value / slope
            u = np.minimum(u - step, 37.5)
            if np.max(np.abs(step) / (1 + np.abs(u)), initial=0.0) < 1e-12:
                return np.where(p > 0, u * self.roughness + self.summit_height, np.inf)
        raise SolverError(f"gap of rough surfaces: not converged in 60 steps, last step {step}")

    def _integrals(self, gap: ArrayLike) -> Array:
        """F_5/2, its derivative, F_2 and its derivative at gaps, shape (4, ...)."""
        from loadflow.tribology.kernels import contact_table

        u = (np.asarray(gap, float) - self.summit_height) / self.roughness
        return np.asarray(contact_table(np.ravel(u)).reshape(4, *u.shape))
