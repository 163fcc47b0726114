"""Crank drive: motion of piston and rod, loads on crank pin and main bearings, inertia of rollers.

The bearings of the friction source sit in one, and their rollers are the hardest case there is:
the load turns, the outer ring swings, inertia lifts the rollers. Angles in rad, φ from top dead
centre; equation numbers are those of von Hollen 2013 (those lost in print are rebuilt from the
rolling constraints).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, NamedTuple

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields

Array = NDArray[np.float64]


class PistonMotion(NamedTuple):
    """Travel from top dead centre (m), its first (m/s) and second (m/s²) derivative in time."""

    travel: Array
    speed: Array
    acceleration: Array


class RodSwing(NamedTuple):
    """Angle ψ = φ + χ between crank and rod (rad) and its derivatives in time."""

    angle: Array
    speed: Array
    acceleration: Array


class PinLoads(NamedTuple):
    """Load of the crank pin's bearing in three frames, N, last axis (x, y).

    `rod` moves with the rod, `crank` with the crank (von Hollen's Hz), `space` is fixed.
    """

    rod: Array
    crank: Array
    space: Array


class RollerInertia(NamedTuple):
    """Mass times acceleration of rollers, N: radial N (outward), tangential U."""

    radial: Array
    tangential: Array


@dataclass(frozen=True, kw_only=True)
class CrankDrive:
    """Crank, rod, piston, and the masses that turn with the crank.

    Attributes
    ----------
    radius, rod_length : float
        r and l, m.
    piston_mass, rod_mass : float
        kg.
    rod_centre : float
        Distance of the rod's centre of mass from the big eye, m.
    web_mass, web_radius : float
        Crank web, kg and m.
    counter_mass, counter_radius : float
        Counterweight, kg and m.
    bearing_mass : float
        Bearing on the crank pin, kg.

    Raises
    ------
    InputError
        If a field is out of its range or the rod is not longer than the crank.
    """

    radius: Annotated[float, Gt(0)]
    rod_length: Annotated[float, Gt(0)]
    piston_mass: Annotated[float, Ge(0)] = 0.0
    rod_mass: Annotated[float, Ge(0)] = 0.0
    rod_centre: Annotated[float, Ge(0)] = 0.0
    web_mass: Annotated[float, Ge(0)] = 0.0
    web_radius: Annotated[float, Ge(0)] = 0.0
    counter_mass: Annotated[float, Ge(0)] = 0.0
    counter_radius: Annotated[float, Ge(0)] = 0.0
    bearing_mass: Annotated[float, Ge(0)] = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        if self.rod_length <= self.radius:
            raise InputError(
                f"rod_length: must be > the crank's radius {self.radius:g} m, "
                f"got {self.rod_length:g}"
            )
        if self.rod_centre > self.rod_length:
            raise InputError(
                f"rod_centre: must be ≤ the rod's length {self.rod_length:g} m, "
                f"got {self.rod_centre:g}"
            )

    @property
    def ratio(self) -> float:
        """λ = r/l."""
        return self.radius / self.rod_length

    @property
    def oscillating_mass(self) -> float:
        """Piston and the small eye's share of the rod, kg, (4.9)."""
        return self.piston_mass + self.rod_mass * self.rod_centre / self.rod_length

    @property
    def rod_rotating_mass(self) -> float:
        """The big eye's share of the rod, kg."""
        return self.rod_mass * (1 - self.rod_centre / self.rod_length)

    def piston(self, angle: ArrayLike, speed: ArrayLike, exact: bool = True) -> PistonMotion:
        """Motion of the piston at constant `speed` (rad/s), (4.3), or as series (4.5)–(4.8).

        Von Hollen prints +λ²/2 sin² in the root's expansion (4.4) for -λ²/2 sin².
        """
        phi, omega = np.asarray(angle, float), np.asarray(speed, float)
        sin, cos, lam = np.sin(phi), np.cos(phi), self.ratio
        if exact:
            root = np.sqrt(1 - (lam * sin) ** 2)
            travel = 1 - cos + (1 - root) / lam
            first = sin + lam * sin * cos / root
            second = cos + lam * (np.cos(2 * phi) / root + (lam * sin * cos) ** 2 / root**3)
        else:
            travel = 1 - cos + lam / 2 * sin**2
            first = sin + lam / 2 * np.sin(2 * phi)
            second = cos + lam * np.cos(2 * phi)
        r = self.radius
        return PistonMotion(r * travel, r * omega * first, r * omega**2 * second)

    def swing(self, angle: ArrayLike, speed: ArrayLike) -> RodSwing:
        """Angle ψ between crank and rod at constant `speed` (rad/s), (4.54)–(4.56)."""
        phi, omega, lam = np.asarray(angle, float), np.asarray(speed, float), self.ratio
        sin, root = np.sin(phi), np.sqrt(1 - (lam * np.sin(phi)) ** 2)
        return RodSwing(
            phi + np.arcsin(lam * sin),
            omega * (1 + lam * np.cos(phi) / root),
            -(omega**2) * lam * (1 - lam**2) * sin / root**3,
        )

    def rod_force(self, angle: ArrayLike, speed: ArrayLike, gas_force: ArrayLike = 0.0) -> Array:
        """Force along the rod, positive in pressure, N, (4.12)–(4.16)."""
        phi = np.asarray(angle, float)
        inertia = self.oscillating_mass * self.piston(phi, speed).acceleration
        lean = np.sqrt(1 - (self.ratio * np.sin(phi)) ** 2)
        return np.asarray((np.asarray(gas_force, float) - inertia) / lean)

    def pin_loads(self, angle: ArrayLike, speed: ArrayLike, gas_force: ArrayLike = 0.0) -> PinLoads:
        """Loads of the bearing on the crank pin in all frames, (5.1)–(5.6).

        Parameters
        ----------
        angle, speed : array_like
            Crank angle, rad, and speed, rad/s.
        gas_force : array_like
            On the piston, N, positive toward the crank.
        """
        phi = np.asarray(angle, float)
        thrust = self.rod_force(phi, speed, gas_force)
        whirl = self.rod_rotating_mass * self.radius * np.asarray(speed, float) ** 2
        psi = self.swing(phi, speed).angle
        chi = psi - phi

        def pair(x: Array, y: Array) -> Array:
            return np.stack(np.broadcast_arrays(x, y), axis=-1)

        return PinLoads(
            rod=pair(whirl * np.sin(psi), whirl * np.cos(psi) - thrust),
            crank=pair(thrust * np.sin(psi), whirl - thrust * np.cos(psi)),
            space=pair(
                whirl * np.sin(phi) + thrust * np.sin(chi),
                whirl * np.cos(phi) - thrust * np.cos(chi),
            ),
        )

    def main_load(self, angle: ArrayLike, speed: ArrayLike, gas_force: ArrayLike = 0.0) -> Array:
        """Load of all main bearings of the throw together, (x, y) in space, N, (5.7), (5.8)."""
        phi, omega = np.asarray(angle, float), np.asarray(speed, float)
        turning = self.web_mass * self.web_radius - self.counter_mass * self.counter_radius
        whirl = (turning + self.bearing_mass * self.radius) * omega**2
        outward = np.stack(np.broadcast_arrays(np.sin(phi), np.cos(phi)), axis=-1)
        return self.pin_loads(phi, speed, gas_force).space + whirl[..., None] * outward

    def roller_inertia(
        self,
        angle: ArrayLike,
        speed: float,
        roller_mass: float,
        inner_diameter: float,
        outer_diameter: float,
        first: ArrayLike = 0.0,
    ) -> RollerInertia:
        """Inertia of rollers of the crank-pin bearing in ideal rolling, (4.69), (4.70).

        Von Hollen prints the wrong sign before the second term of (4.68).

        Parameters
        ----------
        angle : array_like
            Crank angle φ, rad.
        speed : float
            Of the crank, rad/s.
        roller_mass : float
            kg.
        inner_diameter, outer_diameter : float
            Raceway diameters, m.
        first : array_like
            Place of the roller in the cage, 2πj/z, rad; broadcasts with `angle`.
        """
        share = outer_diameter / (outer_diameter + inner_diameter)
        swing = self.swing(angle, speed)
        place = share * swing.angle + np.asarray(first, float)
        own = (inner_diameter + outer_diameter) / 4
        pull = roller_mass * self.radius * speed**2
        radial = roller_mass * own * (speed - share * swing.speed) ** 2 + pull * np.cos(place)
        tangential = -roller_mass * own * share * swing.acceleration - pull * np.sin(place)
        return RollerInertia(-radial, tangential)
