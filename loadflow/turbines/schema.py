"""What a turbine is. Frozen, checked once when it is made; SI units and radians."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Annotated

from annotated_types import Ge, Gt, Le, Lt

from .blade import Airfoil, Blade
from .checks import NotNegative, Positive, require, require_ranges
from .control import COMMON_PRACTICE, Control, Supervision
from .tower import Tower

Inclination = Annotated[float, Gt(-0.35), Lt(0.35)]

_POWER_OF_AREA = 20.0, 2000.0
"""Rated power over the rotor's area, W/m², far beyond what is built (200 … 550): outside, power or
radius are in other units."""


@dataclass(frozen=True)
class RotorGeometry:
    """Geometry and hub of the rotor.

    Attributes
    ----------
    radius, hub_radius, hub_height, overhang : float
        m; `overhang` from the tower axis to the rotor apex along the shaft.
    blades : int
    tilt, cone : float
        rad; tilt lifts the upwind end of the shaft, cone inclines the blades upwind.
    hub_mass, hub_inertia : float
        kg; kg m² about the shaft.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> rotor = load_turbine("nrel-5mw").rotor
    >>> rotor.radius, rotor.blades
    (63.0, 3)
    """

    radius: Positive
    hub_radius: NotNegative
    blades: Annotated[int, Ge(1), Le(6)]
    hub_height: Positive
    overhang: Positive
    tilt: Inclination
    cone: Inclination
    hub_mass: NotNegative
    hub_inertia: NotNegative

    def __post_init__(self) -> None:
        require_ranges(self)
        inside = 0 <= self.hub_radius < self.radius
        require(inside, "RotorGeometry", "hub_radius", self.hub_radius, f"in [0, {self.radius})")
        clear = self.hub_height > self.radius
        require(clear, "RotorGeometry", "hub_height", self.hub_height, f"above {self.radius} m")


@dataclass(frozen=True)
class Drivetrain:
    """Drivetrain: gear, generator, shaft brake, torsion of the shaft.

    Attributes
    ----------
    gear_ratio : float
        Generator speed over rotor speed (1 for direct drive).
    generator_inertia : float
        kg m² about the generator shaft.
    brake_torque, brake_time : float
        Shaft brake: torque at the generator shaft when fully closed, N m (0: there is none), and
        the time it takes to close, s.
    torsional_stiffness, torsional_damping : float
        Between rotor and generator, at the speed of the rotor, N m/rad (0: rigid) and N m s/rad.
    efficiency : float, optional
        Electrical power over that of the rotor, from which that of a windIO file follows.
    hub_to_bearing, bearing_span : float, optional
        From the hub centre to the first main bearing along the shaft, and from there to the
        second, m: the places of the main bearings where a scene states none.

    Examples
    --------
    >>> from loadflow.turbines import Drivetrain
    >>> Drivetrain(gear_ratio=97.0, generator_inertia=534.0).torsional_stiffness  # rigid
    0.0
    """

    gear_ratio: Positive
    generator_inertia: NotNegative
    brake_torque: NotNegative = 0.0
    brake_time: Positive = 0.6
    torsional_stiffness: NotNegative = 0.0
    torsional_damping: NotNegative = 0.0
    efficiency: Annotated[float, Gt(0), Le(1)] | None = None
    hub_to_bearing: Positive | None = None
    bearing_span: Positive | None = None

    def __post_init__(self) -> None:
        require_ranges(self)


@dataclass(frozen=True)
class Turbine:
    """A wind turbine as far as its main bearing feels it.

    Attributes
    ----------
    name, source : str
    rated_power : float
        Electrical, W.
    rated_wind_speed, cut_in, cut_out : float
        m/s.
    rotor, tower, drivetrain, control, blade : the parts
    airfoils : dict of Airfoil by name
    frequencies : dict of float by name
        Natural frequencies that a load spectrum may show, Hz.
    supervision : Supervision
    assumed : tuple of str
        What the file did not say, and what was taken instead.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> turbine = load_turbine("nrel-5mw")
    >>> turbine.rated_power / 1e6, turbine.rotor.hub_height, turbine.tower.height
    (5.0, 90.0, 87.6)
    """

    name: str
    source: str
    rated_power: Positive
    rated_wind_speed: Positive
    cut_in: Positive
    cut_out: Positive
    rotor: RotorGeometry
    tower: Tower
    drivetrain: Drivetrain
    control: Control
    blade: Blade
    airfoils: dict[str, Airfoil] = field(default_factory=dict)
    frequencies: dict[str, float] = field(default_factory=dict)
    supervision: Supervision = COMMON_PRACTICE
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require_ranges(self)
        pitch, highest = self.supervision.stopped_pitch, self.control.maximum_pitch
        within = max(pitch, self.supervision.idling_pitch) <= highest
        require(within, "Supervision", "stopped_pitch", pitch, f"at most {highest} rad")
        speeds = (self.cut_in, self.rated_wind_speed, self.cut_out)
        ordered = 0 < speeds[0] < speeds[1] < speeds[2]
        require(ordered, self.name, "cut_in, rated, cut_out", speeds, "positive and increasing")
        low, high = (bound * math.pi * self.rotor.radius**2 for bound in _POWER_OF_AREA)
        likely = low < self.rated_power < high
        by_area = f"{low:.2g} … {high:.2g} W for a rotor of {self.rotor.radius:g} m radius"
        require(likely, self.name, "rated_power", self.rated_power, by_area)
        for name in self.blade.airfoil:
            known = ", ".join(sorted(self.airfoils))
            require(name in self.airfoils, "Blade", "airfoil", name, f"one of {known}")
        for name, value in self.frequencies.items():
            require(value > 0, "frequencies", name, value, "positive, in Hz")
        tip, root = self.rotor.radius, self.rotor.hub_radius
        inside = bool(self.blade.radius[0] > root and self.blade.radius[-1] < tip)
        require(
            inside,
            "Blade",
            "radius",
            (float(self.blade.radius[0]), float(self.blade.radius[-1])),
            f"inside hub radius {root} m and rotor radius {tip} m",
        )

    @property
    def rated_speed(self) -> float:
        """Speed of the rotor that its controller holds above rated wind, rad/s."""
        return self.control.reference_speed / self.drivetrain.gear_ratio

    @property
    def rotor_mass(self) -> float:
        """Hub and blades, kg."""
        return self.rotor.hub_mass + self.rotor.blades * self.blade.mass
