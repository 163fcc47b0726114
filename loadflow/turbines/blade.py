"""Airfoils, bending modes and blades. Frozen, checked once when made; SI units and radians."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .checks import Array, NotNegative, Positive, require, require_ranges


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
