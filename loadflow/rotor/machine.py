"""Rotor and blades as the compiled loops see them: plain numbers and arrays, made once per rung."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.turbines import Airfoil, Blade, Mode, Turbine

from .airfoils import potential_flow, separation
from .frame import Frame, frame
from .options import RotorOptions

Array = NDArray[np.float64]

GRAVITY = 9.80665
"""Standard gravity, m/s²."""
_POLAR_STEP = np.radians(0.5)
_FINE = 2001


class Machine(NamedTuple):
    """Rotor, blades and drivetrain; SI, radians. Sections are the aerodynamic ones.

    ``n`` sections per blade, ``k`` modes; the mode shapes hold at zero pitch, (normal, tangential).
    """

    blades: int
    tip_radius: float
    hub_radius: float
    hub_height: float
    tilt: float
    cone: float
    hub_mass: float
    hub_inertia: float
    gear_ratio: float
    frame: Frame
    radius: Array  # (n,)
    width: Array  # (n,)
    chord: Array  # (n,)
    twist: Array  # (n,)
    lift: Array  # (n, p), over −π … π in equal steps
    drag: Array  # (n, p)
    slows: NDArray[np.bool_]  # (n,), whether the section slows the wind: a cylinder has no lift
    zero_lift: Array  # (n,), angle of attack without lift
    lift_slope: Array  # (n,), of potential flow, 1/rad; 0: a section without lift
    friction: Array  # (n,), drag at zero lift
    attached: Array  # (n, p), see `Separation`
    separated: Array  # (n, p)
    mass: Array  # (n,), kg
    shape: Array  # (n, k, 2)
    slope: Array  # (n, k, 2)
    shortening: Array  # (n, k, k), pull towards the root per product of modal coordinates
    modal_mass: Array  # (k, k)
    modal_stiffness: Array  # (k, k)
    modal_damping: Array  # (k, k)
    centrifugal: Array  # (k, k), stiffness per Ω²
    axial_gravity: Array  # (k, k), stiffness per outward component of gravity
    prebend: Array  # (n,), upwind of the pitch axis at zero pitch
    prebend_slope: Array  # (n,)
    prebend_centrifugal: Array  # (k,), load on the modes per Ω²
    prebend_gravity: Array  # (k,), load on the modes per outward component of gravity
    bend_twist: float
    torsion_compliance: Array  # (n,), 1/(N m²); without sections: no torsion
    centre_ahead: Array  # (n,), quarter chord ahead of the axis of torsion
    moment: Array  # (n, p), coefficient about the quarter chord, nose up
    mass_factor: Array  # (blades,)
    pitch_offset: Array  # (blades,)
    tower_distance: float  # rotor apex to tower axis, along the shaft
    tower_base_radius: float  # 0: no tower dam
    tower_top_radius: float
    tower_height: float
    air_density: float
    skew_factor: float
    drag_in_induction: bool
    shed_wake: bool
    dynamic_inflow: bool
    dynamic_stall: bool
    table: Array  # (n, p, q, 2) induced over undisturbed speed; empty: solved at every step
    table_angle: tuple[float, float]  # first inflow angle and step, rad
    table_pitch: tuple[float, float]  # first pitch and step, rad


def machine(turbine: Turbine, options: RotorOptions) -> Machine:
    """Discretise a turbine.

    Parameters
    ----------
    turbine : Turbine
    options : RotorOptions
        Which effects are switched on; modes that are not wanted are left out.
    """
    rotor, blade = turbine.rotor, turbine.blade
    edges = _section_edges(blade.radius, rotor.hub_radius, rotor.radius)
    length = rotor.radius - rotor.hub_radius
    stations = blade.radius - rotor.hub_radius
    span = np.linspace(0, length, _FINE)
    density = np.interp(span, blade.span, blade.mass_density)
    density *= blade.mass / np.trapezoid(density, span)
    modes = tuple(mode for mode in blade.modes if mode.name in options.modes)
    structure = _Structure(blade, modes, span, density)
    prebend = blade.prebend if blade.prebend.size else np.zeros(blade.radius.size)
    bow = np.gradient(np.interp(span, np.append(0.0, stations), np.append(0.0, prebend)), span)
    outer_weight = _from_tip(density, span)
    outer_pull = _from_tip(density * (span + rotor.hub_radius), span)
    angle = np.arange(-np.pi, np.pi + _POLAR_STEP / 2, _POLAR_STEP)
    foils = [turbine.airfoils[name] for name in blade.airfoil]
    lift = np.array([np.interp(angle, f.angle, f.lift) for f in foils])
    flows = [potential_flow(foil) for foil in foils]
    split = [separation(*pair, angle) for pair in zip(foils, flows, strict=True)]
    imbalance = np.zeros(rotor.blades)
    imbalance[0] = 1.0
    tower = turbine.tower
    twists = blade.twists and bool(modes) and options.blade_torsion
    dam = 0.5 if options.tower_dam else 0.0
    return Machine(
        blades=rotor.blades,
        tip_radius=rotor.radius,
        hub_radius=rotor.hub_radius,
        hub_height=rotor.hub_height,
        tilt=rotor.tilt,
        cone=rotor.cone,
        hub_mass=rotor.hub_mass,
        hub_inertia=rotor.hub_inertia,
        gear_ratio=turbine.drivetrain.gear_ratio,
        frame=frame(turbine, options),
        # a column of a table of stations would have the loop compiled once more
        radius=np.ascontiguousarray(blade.radius),
        width=_widths(blade.radius, rotor.hub_radius, rotor.radius),
        chord=np.ascontiguousarray(blade.chord),
        twist=np.ascontiguousarray(blade.twist),
        lift=lift,
        drag=np.array([np.interp(angle, f.angle, f.drag) for f in foils]),
        slows=options.drag_in_induction | np.any(lift != 0.0, axis=1),
        zero_lift=np.array([flow.zero for flow in flows]),
        lift_slope=np.array([flow.slope for flow in flows]),
        friction=np.array([flow.friction for flow in flows]),
        attached=np.array([s.attached for s in split]),
        separated=np.array([s.separated for s in split]),
        mass=_lumps(span, density, edges - rotor.hub_radius),
        shape=structure.at(structure.shape, stations),
        slope=structure.at(structure.slope, stations),
        shortening=structure.shortening(stations),
        modal_mass=structure.mass(),
        modal_stiffness=structure.stiffness(),
        modal_damping=structure.damping(),
        centrifugal=structure.tension(outer_pull),
        axial_gravity=structure.tension(outer_weight),
        prebend=prebend,
        prebend_slope=np.interp(stations, span, bow),
        prebend_centrifugal=np.trapezoid(outer_pull * bow * structure.slope[:, 0], span),
        prebend_gravity=np.trapezoid(outer_weight * bow * structure.slope[:, 0], span),
        bend_twist=options.bend_twist,
        torsion_compliance=_compliance(blade, stations) if twists else np.zeros(0),
        centre_ahead=np.interp(stations, blade.torsion_span, blade.centre_ahead)
        if twists
        else np.zeros(0),
        moment=np.array([_moment(f, angle) for f in foils]),
        mass_factor=1 + options.mass_imbalance * imbalance,
        pitch_offset=options.pitch_imbalance * imbalance,
        tower_distance=rotor.overhang,
        tower_base_radius=dam * tower.base_diameter,
        tower_top_radius=dam * tower.top_diameter,
        tower_height=tower.height,
        air_density=options.air_density,
        skew_factor=options.skew_factor,
        drag_in_induction=options.drag_in_induction,
        shed_wake=options.shed_wake,
        dynamic_inflow=options.dynamic_inflow,
        dynamic_stall=bool(options.dynamic_stall),
        table=np.zeros((0, 0, 0, 2)),
        table_angle=(0.0, 1.0),
        table_pitch=(0.0, 1.0),
    )


def _compliance(blade: Blade, stations: Array) -> Array:
    """Mean of one over the torsional stiffness, between the middles of the sections."""
    span = np.linspace(0, blade.torsion_span[-1], _FINE)
    stiffness = np.interp(span, blade.torsion_span, blade.torsion_stiffness)
    turned = _from_root(1 / stiffness, span)
    edges = np.concatenate([[0.0], 0.5 * (stations[1:] + stations[:-1]), [stations[-1]]])
    return np.diff(np.interp(edges, span, turned)) / np.diff(edges)


def _moment(foil: Airfoil, angle: Array) -> Array:
    return np.interp(angle, foil.angle, foil.moment) if foil.moment.size else np.zeros(angle.size)


class _Structure:
    """Modal integrals of one blade over its span."""

    def __init__(self, blade: Blade, modes: tuple[Mode, ...], span: Array, density: Array) -> None:
        self.blade, self.modes, self.span, self.density = blade, modes, span, density
        twist = np.interp(span, blade.span, blade.structural_twist)
        x = span / span[-1]
        self.curvature = np.zeros((len(modes), span.size))
        self.shape = np.zeros((len(modes), 2, span.size))
        self.slope = np.zeros_like(self.shape)
        for k, mode in enumerate(modes):
            powers = np.arange(2, 2 + len(mode.coefficients))
            terms = np.array(mode.coefficients) * powers * (powers - 1)
            self.curvature[k] = x[:, None] ** (powers - 2) @ terms / span[-1] ** 2
            flap = mode.name.startswith("flap")
            normal, tangential = (
                (np.cos(twist), np.sin(twist)) if flap else (-np.sin(twist), np.cos(twist))
            )
            for axis, direction in enumerate((normal, tangential)):
                self.slope[k, axis] = _from_root(self.curvature[k] * direction, span)
                self.shape[k, axis] = _from_root(self.slope[k, axis], span)

    def at(self, function: Array, stations: Array) -> Array:
        """Mode shapes or slopes (k, 2, span) at stations, (n, k, 2)."""
        out = np.zeros((stations.size, len(self.modes), 2))
        for k in range(len(self.modes)):
            for axis in range(2):
                out[:, k, axis] = np.interp(stations, self.span, function[k, axis])
        return out

    def shortening(self, stations: Array) -> Array:
        """Half the integral of the slopes' products from the root, (n, k, k)."""
        out = np.zeros((stations.size, len(self.modes), len(self.modes)))
        product = 0.5 * np.einsum("kas,las->kls", self.slope, self.slope)
        for k, row in enumerate(product):
            for j, values in enumerate(row):
                out[:, k, j] = np.interp(stations, self.span, _from_root(values, self.span))
        return out

    def mass(self) -> Array:
        return self._integral(self.density, self.shape)

    def tension(self, force: Array) -> Array:
        """Stiffness by an axial force (n,) per unit of what causes it."""
        return self._integral(force, self.slope)

    def stiffness(self) -> Array:
        """Bending stiffness; flap and edge bend about different principal axes."""
        out = np.zeros((len(self.modes), len(self.modes)))
        for kind, table in (
            ("flap", self.blade.flap_stiffness),
            ("edge", self.blade.edge_stiffness),
        ):
            bends = np.array([mode.name.startswith(kind) for mode in self.modes])
            curvature = self.curvature * bends[:, None]
            rigidity = np.interp(self.span, self.blade.span, table)
            out += np.trapezoid(rigidity * curvature[:, None] * curvature[None], self.span)
        return out

    def damping(self) -> Array:
        """Proportional to stiffness, the stated share of critical for each mode by itself."""
        stiffness, mass = self.stiffness(), self.mass()
        frequency = np.sqrt(np.diag(stiffness) / np.diag(mass))
        return 2 * self.blade.damping * stiffness / frequency[None, :]

    def _integral(self, weight: Array, function: Array) -> Array:
        product = np.einsum("kas,las->kls", function, function)
        return np.trapezoid(weight * product, self.span)


def _section_edges(radius: Array, root: float, tip: float) -> Array:
    """Edges of sections whose middles are `radius`, from root to tip."""
    edges = np.concatenate([[root], 0.5 * (radius[1:] + radius[:-1]), [tip]])
    # middles given: each edge mirrors the one before it at the middle, if that stays in order
    mirrored = [root]
    for middle in radius:
        mirrored.append(2 * middle - mirrored[-1])
    exact = np.array(mirrored)
    closes = bool(np.all(np.diff(exact) > 0)) and abs(exact[-1] - tip) < 0.01 * tip
    if not closes:
        return edges
    exact[-1] = tip
    return exact


def _widths(radius: Array, root: float, tip: float) -> Array:
    """Length that each section stands for: linear load between sections and to the root; from the
    last one on the load falls with the square root of the distance to the tip, as Prandtl's loss.
    """
    stations = np.concatenate([[root], radius, [tip]])
    widths = 0.5 * (stations[2:] - stations[:-2])
    widths[-1] += (2 / 3 - 1 / 2) * (tip - radius[-1])
    return widths


def _lumps(span: Array, density: Array, edges: Array) -> Array:
    """Mass between the edges."""
    cumulative = _from_root(density, span)
    return np.diff(np.interp(edges, span, cumulative))


def _from_root(values: Array, span: Array) -> Array:
    """Integral from the root."""
    step = 0.5 * (values[1:] + values[:-1]) * np.diff(span)
    return np.concatenate([[0.0], np.cumsum(step)])


def _from_tip(values: Array, span: Array) -> Array:
    """Integral from each station to the tip."""
    total = _from_root(values, span)
    return total[-1] - total
