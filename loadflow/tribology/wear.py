"""Wear of sliding surfaces: laws of depth, running-in, and worn contours of journal bearings.

A law says how fast a surface wears, dd/ds in m of depth per m of sliding, from the pressure that
its asperities carry. Both laws are linear in the pressure, so that the worn volume is that of the
normal force: V = k ∬ p dA ds.

References
----------
Archard, J. F.: Contact and rubbing of flat surfaces. J. Appl. Phys. 24 (1953) 981.
Fleischer, G.: Energetische Methode der Bestimmung des Verschleißes. Schmierungstechnik 4 (1973).
Dufrane, K. F.; Kannel, J. W.; McCloskey, T. H.: Wear of steam turbine journal bearings at low
operating speeds. ASME J. Lubr. Technol., 1983. Hashimoto, H.; Wada, S.; Nojima, K.:
Performance characteristics of worn journal bearings. ASLE Trans., 1986.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Protocol

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields

Array = NDArray[np.float64]


class WearLaw(Protocol):
    """What a law of wear answers.

    Examples
    --------
    >>> from loadflow.tribology import Archard
    >>> law = Archard(1e-16)
    >>> float(law.depth(1e6, 1e4))  # m, of 1 MPa over 10 km
    1e-06
    """

    def rate(self, pressure: ArrayLike, friction: ArrayLike | None = None) -> Array:
        """Depth over sliding distance dd/ds at a pressure (Pa) and friction coefficient."""
        ...

    def depth(
        self, pressure: ArrayLike, distance: ArrayLike, friction: ArrayLike | None = None
    ) -> Array:
        """Depth (m) worn over a sliding distance (m) at constant pressure and friction."""
        ...


@dataclass(frozen=True)
class Archard:
    """Wear in proportion to pressure and sliding distance, dd/ds = k p [Archard 1953].

    Attributes
    ----------
    coefficient : float
        k, m²/N (1e-15 m²/N = 1e-6 mm³/(N m)).

    Raises
    ------
    InputError
        If the coefficient is not positive and finite, or a pressure is negative.

    Examples
    --------
    >>> round(float(Archard(1e-16).depth(pressure=5e6, distance=2000.0)) * 1e6, 6)
    1.0
    """

    coefficient: Annotated[float, Gt(0), Le(1e-6)]

    def __post_init__(self) -> None:
        check_fields(self)

    def rate(self, pressure: ArrayLike, friction: ArrayLike | None = None) -> Array:
        """Depth over sliding distance, k p; `friction` has no part in it."""
        return self.coefficient * _not_negative("pressure", pressure, "Pa")

    def depth(
        self, pressure: ArrayLike, distance: ArrayLike, friction: ArrayLike | None = None
    ) -> Array:
        """Depth over a sliding distance, m."""
        return self.rate(pressure) * _not_negative("distance", distance, "m")


@dataclass(frozen=True)
class Fleischer:
    """Wear in proportion to the friction energy, dd/ds = μ p/e [Fleischer 1973].

    Attributes
    ----------
    energy_density : float
        Apparent density e of friction energy: energy over worn volume, J/m³.

    Raises
    ------
    InputError
        If the density is not positive and finite, no friction coefficient is given, or pressure
        or friction are negative.

    Examples
    --------
    >>> law = Fleischer(1e15)
    >>> round(float(law.depth(pressure=5e6, distance=2000.0, friction=0.1)) * 1e6, 6)
    1.0
    >>> round(law.archard(friction=0.1).coefficient * 1e16, 6)
    1.0
    """

    energy_density: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        check_fields(self)

    def rate(self, pressure: ArrayLike, friction: ArrayLike | None = None) -> Array:
        """Depth over sliding distance at a pressure (Pa) and a friction coefficient."""
        if friction is None:
            raise InputError("friction: Fleischer's law needs the friction coefficient")
        stress = _not_negative("friction", friction, "") * _not_negative("pressure", pressure, "Pa")
        return stress / self.energy_density

    def depth(
        self, pressure: ArrayLike, distance: ArrayLike, friction: ArrayLike | None = None
    ) -> Array:
        """Depth over a sliding distance, m."""
        return self.rate(pressure, friction) * _not_negative("distance", distance, "m")

    def archard(self, friction: float) -> Archard:
        """The law of Archard that wears alike at a constant friction coefficient."""
        return Archard(friction / self.energy_density)


@dataclass(frozen=True, kw_only=True)
class RunningIn:
    """Running-in: roughness and wear fall towards their final values as the surface wears off.

    Both follow the worn depth d: σ = σ_∞ + (σ₀ - σ_∞) exp(-d/d₀) and the rate of wear is that of
    the law times 1 + (a - 1) exp(-d/d₀).

    Attributes
    ----------
    initial_roughness, final_roughness : float
        Combined roughness σ₀ new and σ_∞ run in, m.
    depth : float
        d₀, m; as a rule about the height of the peaks that wear off.
    excess : float
        a, rate of wear of the new surface over that when run in; 3 … 10 for bearing metals.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> state = RunningIn(initial_roughness=0.8e-6, final_roughness=0.3e-6, depth=1e-6, excess=5)
    >>> round(float(state.roughness(1e-6)) * 1e6, 3)
    0.484
    >>> round(float(state.worn(Archard(1e-16), 5e6, 2000.0)) * 1e6, 3)
    2.261
    """

    initial_roughness: Annotated[float, Gt(0), Le(1e-3)]
    final_roughness: Annotated[float, Gt(0), Le(1e-3)]
    depth: Annotated[float, Gt(0), Le(1e-2)]
    excess: Annotated[float, Ge(1), Le(1e3)] = 1.0

    def __post_init__(self) -> None:
        check_fields(self)

    def roughness(self, worn: ArrayLike) -> Array:
        """Combined roughness where a depth (m) has been worn off, m."""
        fall = self.initial_roughness - self.final_roughness
        return self.final_roughness + fall * np.exp(-_not_negative("worn", worn, "m") / self.depth)

    def rate(
        self,
        law: WearLaw,
        pressure: ArrayLike,
        worn: ArrayLike = 0.0,
        friction: ArrayLike | None = None,
    ) -> Array:
        """Depth over sliding distance where a depth `worn` (m) is already off."""
        left = np.exp(-_not_negative("worn", worn, "m") / self.depth)
        return law.rate(pressure, friction) * (1 + (self.excess - 1) * left)

    def worn(
        self,
        law: WearLaw,
        pressure: ArrayLike,
        distance: ArrayLike,
        worn: ArrayLike = 0.0,
        friction: ArrayLike | None = None,
    ) -> Array:
        """Worn depth after a further sliding distance at constant pressure and friction, m.

        The exact solution of `rate`, for steps of any length.

        Parameters
        ----------
        law : WearLaw
            Law of the surface when run in.
        pressure, distance, worn : array_like
            Pressure, Pa; sliding distance, m; depth before, m.
        friction : array_like, optional
            Friction coefficient, where the law needs it.
        """
        before = _not_negative("worn", worn, "m")
        steady = law.depth(pressure, distance, friction)
        # exp(d/d₀) + a - 1 grows as exp(steady/d₀); solved for the increment of d
        growth = 1 + (self.excess - 1) * np.exp(-before / self.depth)
        fall = -np.expm1(-steady / self.depth)
        return before + steady + self.depth * np.log1p((growth - 1) * fall)


@dataclass(frozen=True, kw_only=True)
class ConformalWear:
    """Shaft in a bore of its own radius that sinks in by wear [exact for Archard's law].

    With no clearance the depth is δ cos φ over ±90° about the load line, and so is the pressure,
    p₀ cos φ, p₀ = 2 F/(π R B), at any time; δ = k p₀ s and the worn volume is 4 k F s/π.

    Attributes
    ----------
    force : float
        F, N.
    radius, width : float
        R and B, m.
    coefficient : float
        k of Archard, m²/N.
    distance : float
        Sliding distance s, m.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> case = ConformalWear(force=1e5, radius=0.2, width=0.25, coefficient=1e-16, distance=1e3)
    >>> round(case.largest_pressure / 1e6, 5), round(case.largest_depth * 1e6, 6)
    (1.27324, 0.127324)
    >>> round(case.volume * 1e9, 4)
    12.7324
    """

    force: Annotated[float, Ge(0)]
    radius: Annotated[float, Gt(0)]
    width: Annotated[float, Gt(0)]
    coefficient: Annotated[float, Gt(0)]
    distance: Annotated[float, Ge(0)]

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def largest_pressure(self) -> float:
        """p₀ on the load line, Pa."""
        return 2 * self.force / (math.pi * self.radius * self.width)

    @property
    def largest_depth(self) -> float:
        """δ on the load line, m."""
        return self.coefficient * self.largest_pressure * self.distance

    @property
    def volume(self) -> float:
        """Worn volume, m³; more than k F s by 4/π, as the normal force exceeds F."""
        return 4 * self.coefficient * self.force * self.distance / math.pi

    def pressure(self, angle: ArrayLike) -> Array:
        """Pressure at an angle (rad) from the load line, Pa."""
        return self.largest_pressure * np.maximum(np.cos(np.asarray(angle, float)), 0.0)

    def depth(self, angle: ArrayLike) -> Array:
        """Worn depth at an angle (rad) from the load line, m."""
        return self.largest_depth * np.maximum(np.cos(np.asarray(angle, float)), 0.0)


@dataclass(frozen=True, kw_only=True)
class WornArc:
    """Worn arc of a journal bearing, d = d₀ - c (1 - cos φ) about the load line.

    The arc of [Dufrane et al. 1983], used by [Hashimoto et al. 1986]: a circle of the shaft's
    radius plus d₀ about the shaft that touches the bore. With φ from the point opposite to the load
    it reads d₀ - c (1 + cos φ). Its edges are at cos φ = 1 - d₀/c.

    Attributes
    ----------
    largest_depth : float
        d₀ on the load line, m; at most 2 c.
    clearance : float
        Radial clearance c of the bearing as made, m.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> arc = WornArc(largest_depth=50e-6, clearance=100e-6)
    >>> round(math.degrees(arc.half_angle), 6)
    60.0
    >>> (arc.depth([0.0, math.pi / 4, 2.0]) * 1e6).round(3).tolist()
    [50.0, 20.711, 0.0]
    """

    largest_depth: Annotated[float, Ge(0)]
    clearance: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        check_fields(self)
        if self.largest_depth > 2 * self.clearance:
            raise InputError(
                f"largest_depth: must be ≤ 2 clearance = {2 * self.clearance:g} m, "
                f"got {self.largest_depth:g}"
            )

    @property
    def half_angle(self) -> float:
        """Angle from the load line to the edges of the arc, rad."""
        return math.acos(1 - self.largest_depth / self.clearance)

    def depth(self, angle: ArrayLike) -> Array:
        """Worn depth at an angle (rad) from the load line, m."""
        sunk = self.clearance * (1 - np.cos(np.asarray(angle, float)))
        return np.maximum(self.largest_depth - sunk, 0.0)

    def volume(self, radius: float, width: float) -> float:
        """Worn volume of a bearing of given radius and width (m), m³."""
        edge, c = self.half_angle, self.clearance
        return 2 * radius * width * ((self.largest_depth - c) * edge + c * math.sin(edge))


@dataclass(frozen=True, kw_only=True)
class ShaftImprint:
    """Imprint of the shaft itself: it has sunk by d₀ below its place on the bore.

    d = (c + d₀) cos φ - c about the load line; without clearance that of `ConformalWear`.

    Attributes
    ----------
    largest_depth : float
        d₀ on the load line, m.
    clearance : float
        Radial clearance c of the bearing as made, m; may be 0.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> imprint = ShaftImprint(largest_depth=50e-6, clearance=100e-6)
    >>> round(math.degrees(imprint.half_angle), 3)
    48.19
    """

    largest_depth: Annotated[float, Ge(0)]
    clearance: Annotated[float, Ge(0)]

    def __post_init__(self) -> None:
        check_fields(self)

    @property
    def half_angle(self) -> float:
        """Angle from the load line to the edges of the imprint, rad."""
        reach = self.clearance + self.largest_depth
        return math.acos(self.clearance / reach) if reach > 0 else 0.0

    def depth(self, angle: ArrayLike) -> Array:
        """Worn depth at an angle (rad) from the load line, m."""
        reach = (self.clearance + self.largest_depth) * np.cos(np.asarray(angle, float))
        return np.maximum(reach - self.clearance, 0.0)

    def volume(self, radius: float, width: float) -> float:
        """Worn volume of a bearing of given radius and width (m), m³."""
        edge, c = self.half_angle, self.clearance
        return 2 * radius * width * ((c + self.largest_depth) * math.sin(edge) - c * edge)


def _not_negative(name: str, value: ArrayLike, unit: str) -> Array:
    """`value` as an array, or an InputError."""
    found = np.asarray(value, float)
    if not np.all(np.isfinite(found) & (found >= 0)):
        raise InputError(f"{name}: must be finite and ≥ 0 {unit}".rstrip() + f", got {found}")
    return found
