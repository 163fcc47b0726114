"""The tower: what the passing blades feel of it, and how it bends."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .checks import Array, NotNegative, Positive, require, require_ranges


@dataclass(frozen=True)
class TowerBending:
    """First bending modes of the tower, clamped at its foot, and the nacelle on top of it.

    Attributes
    ----------
    nacelle_mass : float
        All that stands on the tower but the rotor, kg.
    nacelle_downwind, nacelle_above : float
        Its centre of mass behind the tower axis and above the tower top, m.
    damping : float
        Structural, of each mode of the tower by itself (nothing on top), share of critical.
    height, mass_density, fore_aft_stiffness, side_side_stiffness : ndarray, shape (n,)
        Above the ground, m, clamped at the first (a monopile begins below 0); kg/m; N m².
    fore_aft, side_side : tuple of float
        Coefficients of x², x³, … of the mode shapes, with x = 0 at the foot and 1 at the top; they
        add up to 1, so that the modal coordinate is the motion of the tower top.

    Examples
    --------
    >>> from loadflow.turbines import load_turbine
    >>> bending = load_turbine("nrel-5mw").tower.bending
    >>> bending.height.size == bending.mass_density.size
    True
    """

    nacelle_mass: NotNegative
    nacelle_downwind: float
    nacelle_above: float
    damping: NotNegative
    height: Array
    mass_density: Array
    fore_aft_stiffness: Array
    side_side_stiffness: Array
    fore_aft: tuple[float, ...]
    side_side: tuple[float, ...]

    def __post_init__(self) -> None:
        require_ranges(self)
        require(0 <= self.damping < 1, "TowerBending", "damping", self.damping, "in [0, 1)")
        rising = self.height.size > 1 and bool(np.all(np.diff(self.height) > 0))
        require(rising, "TowerBending", "height", self.height.tolist(), "increasing")
        for name in ("mass_density", "fore_aft_stiffness", "side_side_stiffness"):
            values = getattr(self, name)
            fits = values.shape == self.height.shape and bool(np.all(values > 0))
            require(fits, "TowerBending", name, values.tolist(), "positive, one for each height")
        for name in ("fore_aft", "side_side"):
            total = sum(getattr(self, name))
            require(
                abs(total - 1) < 1e-3, "TowerBending", f"{name} sum of coefficients", total, "1"
            )


@dataclass(frozen=True)
class Tower:
    """The tower as the passing blades feel it: a tapered cylinder; and how it bends, if known.

    Attributes
    ----------
    base_diameter, top_diameter, height : float
        m.
    bending : TowerBending, optional

    Examples
    --------
    >>> from loadflow.turbines import Tower
    >>> Tower(base_diameter=6.0, top_diameter=3.87, height=87.6).bending is None
    True
    """

    base_diameter: Positive
    top_diameter: Positive
    height: Positive
    bending: TowerBending | None = None

    def __post_init__(self) -> None:
        require_ranges(self)
        if self.bending is not None:
            top = float(self.bending.height[-1])
            whole = abs(top - self.height) < 1e-6 * self.height
            require(whole, "TowerBending", "last height", top, f"that of the tower, {self.height}")
