"""What a turbine is. Frozen, checked once when it is made; SI units and radians."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from math import pi
from typing import Annotated

import numpy as np
from annotated_types import Ge, Gt, Le

from loadflow.errors import InputError

from .checks import Array, NotNegative, Positive, require, require_ranges
from .tower import Tower

_DEGREE = pi / 180


@dataclass(frozen=True)
class Airfoil:
    """Lift and drag over the angle of attack.

    Attributes
    ----------
    name : str
    angle : ndarray, shape (n,)
        Angle of attack, rad, increasing, from −π to π.
    lift, drag : ndarray, shape (n,)
        Coefficients, referred to the chord.
    thickness : float, optional
        Over the chord; airfoils that state it can be blended, see `blended`.
    zero_lift, lift_slope : float, optional
        Potential flow that unsteady airfoils build on: angle of attack without lift, rad, and slope
        of the lift coefficient, 1/rad; left out, they follow from the polar.
    moment : ndarray, shape (n,) or (0,)
        Coefficient of the moment about the quarter chord, nose-up positive, referred to the square
        of the chord; empty: not known, taken as 0.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> foil = next(iter(load_turbine("nrel-5mw").airfoils.values()))
    >>> foil.angle.shape == foil.lift.shape == foil.drag.shape
    True
    """

    name: str
    angle: Array
    lift: Array
    drag: Array
    thickness: float | None = None
    zero_lift: float | None = None
    lift_slope: float | None = None
    moment: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        owner = f"airfoil {self.name!r}"
        if self.zero_lift is not None:
            near = abs(self.zero_lift) <= np.radians(15)
            require(near, owner, "zero_lift", self.zero_lift, "within ±15° (0.262 rad)")
        if self.lift_slope is not None:
            require(
                1 <= self.lift_slope <= 15, owner, "lift_slope", self.lift_slope, "1 … 15 1/rad"
            )
        increasing = self.angle.size > 1 and bool(np.all(np.diff(self.angle) > 0))
        require(increasing, owner, "angle", self.angle.tolist(), "strictly increasing")
        span = (float(self.angle[0]), float(self.angle[-1]))
        covers = abs(span[0] + np.pi) < 1e-6 and abs(span[1] - np.pi) < 1e-6
        require(covers, owner, "angle range", span, "−π … π (−180° … 180°)")
        for name in ("lift", "drag"):
            values = getattr(self, name)
            fits = values.shape == self.angle.shape and bool(np.all(np.isfinite(values)))
            require(fits, owner, name, values.tolist(), "finite, one value for each angle")
        fits = self.moment.size in (0, self.angle.size) and bool(np.isfinite(self.moment).all())
        require(fits, owner, "moment", self.moment.tolist(), "finite, one value for each angle")


@dataclass(frozen=True)
class Mode:
    """Bending mode of a blade.

    Attributes
    ----------
    name : str
        ``"flap1"``, ``"edge1"``, …; the first four letters tell the stiffness that it bends.
    coefficients : tuple of float
        Coefficients of x², x³, … with x = distance from the root over blade length; they add up
        to 1, so that the modal coordinate is the deflection of the tip.

    Examples
    --------
    >>> from loadflow.turbines import Mode
    >>> Mode("flap1", (0.0, 0.0, 1.0)).name
    'flap1'
    """

    name: str
    coefficients: tuple[float, ...]

    def __post_init__(self) -> None:
        require(self.name[:4] in ("flap", "edge"), "mode", "name", self.name, "flap… or edge…")
        total = sum(self.coefficients)
        require(abs(total - 1) < 1e-3, f"mode {self.name}", "sum of coefficients", total, "1")


@dataclass(frozen=True)
class Blade:
    """Aerodynamic sections and structure of one blade.

    Attributes
    ----------
    radius, twist, chord : ndarray, shape (n,)
        Middle of each section from the rotor axis along the blade, m; twist, rad; chord, m.
    airfoil : tuple of str, length n
    mass : float
        Whole blade, kg.
    damping : float
        Structural damping of each mode, share of critical.
    span, structural_twist, mass_density, flap_stiffness, edge_stiffness : ndarray, shape (m,)
        Distance from the root, m; rad; kg/m; N m². The mass density is scaled to `mass`.
    modes : tuple of Mode
    prebend : ndarray, shape (n,) or (0,)
        Distance of each section upwind of the pitch axis, m; empty: a straight blade.
    torsion_span, torsion_stiffness, centre_ahead : ndarray, shape (t,) or (0,)
        Distance from the root, m; torsional stiffness, N m²; distance of the quarter chord ahead of
        the axis about which the blade twists, m. Empty: not known, the blade does not twist.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> blade = load_turbine("nrel-5mw").blade
    >>> len(blade.airfoil) == blade.radius.size, [mode.name for mode in blade.modes]
    (True, ['flap1', 'flap2', 'edge1'])
    """

    radius: Array
    twist: Array
    chord: Array
    airfoil: tuple[str, ...]
    mass: Positive
    damping: NotNegative
    span: Array
    structural_twist: Array
    mass_density: Array
    flap_stiffness: Array
    edge_stiffness: Array
    modes: tuple[Mode, ...] = ()
    prebend: Array = field(default_factory=lambda: np.zeros(0))
    torsion_span: Array = field(default_factory=lambda: np.zeros(0))
    torsion_stiffness: Array = field(default_factory=lambda: np.zeros(0))
    centre_ahead: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        require_ranges(self)
        require(0 <= self.damping < 1, "Blade", "damping", self.damping, "in [0, 1)")
        fits = self.prebend.size in (0, self.radius.size) and np.isfinite(self.prebend).all()
        require(bool(fits), "Blade", "prebend", self.prebend.tolist(), "one value per section")
        for name in ("radius", "span"):
            values = getattr(self, name)
            require(
                values.size > 1 and bool(np.all(np.diff(values) > 0)),
                "Blade",
                name,
                values.tolist(),
                "strictly increasing",
            )
        for name in ("chord", "mass_density", "flap_stiffness", "edge_stiffness"):
            values = getattr(self, name)
            require(bool(np.all(values > 0)), "Blade", name, values.tolist(), "positive")
        known = self.torsion_span.size != 1 and bool(np.all(np.diff(self.torsion_span) > 0))
        known = known and self.torsion_stiffness.shape == self.torsion_span.shape
        require(
            known and bool(np.all(self.torsion_stiffness > 0)),
            "Blade",
            "torsion",
            self.torsion_span.tolist(),
            "two rows or more, stations increasing, stiffness positive",
        )

    @property
    def twists(self) -> bool:
        """Whether the torsion of the blade is described."""
        return bool(self.torsion_span.size)


@dataclass(frozen=True)
class RotorGeometry:
    """Geometry and hub of the rotor.

    Attributes
    ----------
    radius, hub_radius, hub_height, overhang : float
        m; `overhang` from the tower axis to the rotor apex along the shaft.
    blades : int
    tilt, cone : float
        rad; tilt lifts the upwind end of the shaft, cone leans the blades upwind.
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
    tilt: float
    cone: float
    hub_mass: NotNegative
    hub_inertia: NotNegative

    def __post_init__(self) -> None:
        require_ranges(self)
        inside = 0 <= self.hub_radius < self.radius
        require(inside, "RotorGeometry", "hub_radius", self.hub_radius, f"in [0, {self.radius})")
        clear = self.hub_height > self.radius
        require(clear, "RotorGeometry", "hub_height", self.hub_height, f"above {self.radius} m")
        for name in ("tilt", "cone"):
            value = getattr(self, name)
            require(abs(value) < 0.35, "RotorGeometry", name, value, "within ±0.35 rad (20°)")


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
class Control:
    """Variable-speed, collective-pitch control of the NREL 5 MW kind (generator side).

    Attributes
    ----------
    region_2_gain : float
        Torque over speed² at optimal tip-speed ratio, N m/(rad/s)².
    region_15_start, region_2_start, rated_speed : float
        Speeds at which regions 1½, 2 and 3 begin, rad/s.
    slip : float
        Of the generator in region 2½, share of its synchronous speed.
    rated_mechanical_power : float
        W.
    constant_power : float
        Above rated wind: 1 holds the power, 0 the torque, anything between is a blend of both.
    maximum_torque, maximum_torque_rate : float
        N m; N m/s.
    speed_filter : float
        Corner of the low-pass on the measured speed, Hz.
    proportional_gain, integral_gain : float
        Of the pitch controller at zero pitch, s and −.
    gain_halving_pitch : float
        Pitch at which the gains are halved, rad.
    reference_speed : float
        rad/s.
    pitch_rate, minimum_pitch, maximum_pitch : float
        rad/s; rad.
    scheduled_wind, scheduled_pitch : tuple of float
        Lowest pitch over the wind: m/s, increasing, and rad; linear in the power between the
        points, constant outside. Empty: `minimum_pitch` throughout.
    schedule_filter : float
        Corner of the low-pass on the power, by which the wind is recognised, Hz.
    optimal_tip_speed_ratio : float, optional
        In place of `region_2_gain`, which then follows from the power of the rotor.
    pitch_frequency, pitch_damping : float, optional
        In place of the three gains: frequency (rad/s) and damping ratio of the speed under the
        pitch control; the gains then follow from the power over the pitch.
    thrust_limit : float, optional
        Peak shaving: largest steady thrust, share of that without a limit; the lowest pitch around
        rated wind follows from it.
    individual_gain, individual_limit : float
        Of the individual pitch control: integral gain on the tilt and yaw moment, rad/(N m s), and
        largest deviation from the collective pitch, rad.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> round(load_turbine("nrel-5mw").control.pitch_rate, 4)  # rad/s
    0.1396
    """

    region_15_start: Positive
    region_2_start: Positive
    rated_speed: Positive
    slip: Positive
    rated_mechanical_power: Positive
    maximum_torque: Positive
    maximum_torque_rate: Positive
    speed_filter: Positive
    reference_speed: Positive
    pitch_rate: Positive
    minimum_pitch: float
    maximum_pitch: float
    region_2_gain: Positive | None = None
    proportional_gain: NotNegative | None = None
    integral_gain: Positive | None = None
    gain_halving_pitch: Positive | None = None
    optimal_tip_speed_ratio: Positive | None = None
    pitch_frequency: Positive | None = None
    pitch_damping: Positive | None = None
    thrust_limit: Annotated[float, Gt(0), Le(1)] | None = None
    scheduled_wind: tuple[float, ...] = ()
    scheduled_pitch: tuple[float, ...] = ()
    schedule_filter: Positive = 0.033
    constant_power: Annotated[float, Ge(0), Le(1)] = 1.0
    individual_gain: NotNegative = 0.0
    individual_limit: NotNegative = 5.0 * _DEGREE

    def __post_init__(self) -> None:
        speeds = (self.region_15_start, self.region_2_start, self.rated_speed)
        ordered = 0 < speeds[0] < speeds[1] < speeds[2] <= self.reference_speed
        require(
            ordered,
            "Control",
            "speeds",
            (*speeds, self.reference_speed),
            "increasing: region_15_start < region_2_start < rated_speed <= reference_speed",
        )
        require_ranges(self)
        self._check_gains()
        require(
            self.minimum_pitch < self.maximum_pitch,
            "Control",
            "minimum_pitch",
            self.minimum_pitch,
            f"below maximum_pitch = {self.maximum_pitch}",
        )
        wind, pitch = self.scheduled_wind, self.scheduled_pitch
        require(
            all(a < b for a, b in pairwise((0.0, *wind))),
            "Control",
            "scheduled_wind",
            wind,
            "positive and increasing",
        )
        within = all(self.minimum_pitch <= p <= self.maximum_pitch for p in pitch)
        require(
            len(pitch) == len(wind) and within,
            "Control",
            "scheduled_pitch",
            pitch,
            "one value for each scheduled_wind, from minimum_pitch to maximum_pitch",
        )

    def _check_gains(self) -> None:
        """Each gain is stated, or what it follows from."""
        if (self.region_2_gain is None) == (self.optimal_tip_speed_ratio is None):
            raise InputError("Control: region_2_gain or optimal_tip_speed_ratio: give one of both")
        stated = (self.proportional_gain, self.integral_gain, self.gain_halving_pitch)
        wanted = (self.pitch_frequency, self.pitch_damping)
        complete = [None not in group for group in (stated, wanted)]
        if complete.count(True) != 1 or any(x is not None for x in (stated, wanted)[complete[0]]):
            raise InputError(
                "Control: give proportional_gain, integral_gain and gain_halving_pitch, or else "
                "pitch_frequency and pitch_damping"
            )

    @property
    def is_tuned(self) -> bool:
        """Whether all gains are stated, so that none follows from the rotor."""
        return None not in (self.region_2_gain, self.integral_gain) and self.thrust_limit is None


@dataclass(frozen=True)
class Supervision:
    """What the control does around power production; the file of a turbine may leave it out.

    The pitch by state is that of the source (Table 2-1: 70° idling, 90° stopped); rates, delay and
    overspeed are common practice and no property of a published turbine.

    Attributes
    ----------
    idling_pitch, stopped_pitch : float
        rad.
    start_rate, stop_rate : float
        Pitch rate of start and normal stop, rad/s; fault and emergency take `Control.pitch_rate`.
    overspeed : float
        Generator speed that trips the protection, share of `Control.reference_speed`.
    fault_delay : float
        From a fault to the reaction of the control, s.
    brake_speed : float
        Rotor speed below which the brake closes in a stop, rad/s.

    Examples
    --------
    >>> from loadflow.turbines import Supervision
    >>> Supervision(overspeed=1.15).brake_speed
    0.1
    """

    idling_pitch: Positive = 70.0 * _DEGREE
    stopped_pitch: Positive = 90.0 * _DEGREE
    start_rate: Positive = 2.0 * _DEGREE
    stop_rate: Positive = 4.0 * _DEGREE
    overspeed: Annotated[float, Gt(1)] = 1.2
    fault_delay: NotNegative = 0.2
    brake_speed: Positive = 0.1

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
    supervision: Supervision = Supervision()
    assumed: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        require_ranges(self)
        pitch, highest = self.supervision.stopped_pitch, self.control.maximum_pitch
        within = max(pitch, self.supervision.idling_pitch) <= highest
        require(within, "Supervision", "stopped_pitch", pitch, f"at most {highest} rad")
        speeds = (self.cut_in, self.rated_wind_speed, self.cut_out)
        ordered = 0 < speeds[0] < speeds[1] < speeds[2]
        require(ordered, self.name, "cut_in, rated, cut_out", speeds, "positive and increasing")
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
    def rotor_mass(self) -> float:
        """Hub and blades, kg."""
        return self.rotor.hub_mass + self.rotor.blades * self.blade.mass
