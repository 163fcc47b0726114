"""Axial deflection of a slewing bearing whose rings expand, [Ritzer 2018] ch. 2.4.1.

The analytic rung between rigid and flexible rings: pure axial load, rings as plain cylinders that
widen or shrink alike all round, no twist of the section and no support by the structure.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated, Literal

import numpy as np
from annotated_types import Gt
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields, check_one_of
from loadflow.numerics.shown import Shown
from loadflow.quantities import Quantity, load_cases
from loadflow.rolling.contacts import Array
from loadflow.rolling.raceways import BallRaceways

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@dataclass(frozen=True, kw_only=True)
class RingSections:
    """Diameters and height of the rings.

    Attributes
    ----------
    outer_outside, outer_inside : float
        Diameters D_Aa, D_Ai of the outer ring, m.
    inner_outside, inner_inside : float
        Diameters D_Ia, D_Ii of the inner ring, m.
    height : float
        Height H of both rings over all rows, m.

    Raises
    ------
    InputError
        If a field is not positive or a ring has no thickness.

    Examples
    --------
    >>> from loadflow.rolling import RingSections
    >>> RingSections(outer_outside=0.62, outer_inside=0.52, inner_outside=0.48, inner_inside=0.38,
    ...     height=0.08).height
    0.08
    """

    outer_outside: Annotated[float, Gt(0)]
    outer_inside: Annotated[float, Gt(0)]
    inner_outside: Annotated[float, Gt(0)]
    inner_inside: Annotated[float, Gt(0)]
    height: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        check_fields(self)
        for ring in ("outer", "inner"):
            outside, inside = getattr(self, f"{ring}_outside"), getattr(self, f"{ring}_inside")
            if outside <= inside:
                raise InputError(f"{ring}_outside: must be > {inside:g} m, got {outside:g}")


@dataclass(frozen=True, repr=False)
class ExpansionResult(Shown):
    """Axial equilibrium with expanding rings; arrays over the load cases.

    Attributes
    ----------
    ball_force : ndarray
        Force on each ball, N.
    contact_angle : ndarray
        Operating contact angle, rad.
    displacement : ndarray
        Axial displacement of the inner ring, m.
    expansion : ndarray
        Widening of the outer and shrinking of the inner ring on the radius, together, m.
    residual : ndarray
        Gap left in the closure of the groove centres over their distance R₀.
    force : ndarray
        Axial force, N.

    Examples
    --------
    >>> from loadflow.rolling import RingSections, SlewingBearing, axial_expansion
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> rings = RingSections(outer_outside=0.62, outer_inside=0.52, inner_outside=0.48,
    ...     inner_inside=0.38, height=0.08)
    >>> found = axial_expansion(bearing, [5e4, 1e5], rings)
    >>> found.contact_angle.shape, bool(found.contact_angle[1] > found.contact_angle[0] > 0.785)
    ((2,), True)
    """

    ball_force: Array
    contact_angle: Array
    displacement: Array
    expansion: Array
    residual: Array
    force: Array

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of rings that expand."""
        return _SHOWN

    def to_dataset(self) -> xr.Dataset:
        """The result over ``case``, with units."""
        import xarray as xr

        return xr.Dataset(
            {n: ("case", np.atleast_1d(getattr(self, n)), q.attributes) for n, q in _SHOWN.items()}
        )

    def plot(self) -> Figure:
        """Draw displacement and contact angle over the axial force."""
        from loadflow import plots

        data = self.to_dataset().sortby("force")
        drawing, axes = plots.figure(1, 2, height=3.0)
        load, unit = plots.readable(data["force"])
        for axis, name in zip(axes, ("displacement", "contact_angle")):
            values, shown = plots.readable(data[name])
            axis.plot(load, values, "o-", ms=3)
            axis.set(xlabel=f"axial force, {unit}", ylabel=f"{_SHOWN[name].meaning}, {shown}")
        return drawing

    def __repr__(self) -> str:
        cases = np.size(self.force)
        return f"<ExpansionResult of {load_cases(cases)}, residual {np.max(self.residual):.1e}>"


_SHOWN = {
    "force": Quantity("F_a", "N", "axial force"),
    "ball_force": Quantity("Q", "N", "force on each ball"),
    "contact_angle": Quantity("α", "rad", "contact angle at work"),
    "displacement": Quantity("δ_a", "m", "axial displacement of the inner ring"),
    "expansion": Quantity("Δr", "m", "widening of both rings on the radius"),
    "residual": Quantity("", "1", "gap left between groove centres over their distance"),
}


def axial_expansion(
    bearing: BallRaceways,
    axial_force: ArrayLike,
    sections: RingSections,
    *,
    flexible: Literal["none", "outer", "inner", "both"] = "both",
    rings: Literal["thin", "thick"] = "thin",
) -> ExpansionResult:
    """Axial deflection with ring expansion, (2.12)–(2.18) with (2.12) put right.

    Closes the triangle of groove centres cos α = (R₀ cos α₀ - Δr)/(R₀ + δ) for the contact angle by
    bisection; each side of it has one sign change between α₀ and 90°.

    Parameters
    ----------
    bearing : BallRaceways
        Without clearance or preload.
    axial_force : array_like
        Axial force on the inner ring, N; its sign is that of the displacement.
    sections : RingSections
        The rings.
    flexible : {"none", "outer", "inner", "both"}
        Which rings expand.
    rings : {"thin", "thick"}
        Thin rings of (2.13), (2.17), or thick-walled tubes.

    Returns
    -------
    ExpansionResult
        Over the shape of `axial_force`.

    Raises
    ------
    InputError
        If the bearing has clearance, the force is not finite or an option is unknown.

    Examples
    --------
    >>> from loadflow.rolling import RingSections, SlewingBearing, axial_expansion
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> rings = RingSections(outer_outside=0.62, outer_inside=0.52, inner_outside=0.48,
    ...     inner_inside=0.38, height=0.08)
    >>> soft, rigid = (axial_expansion(bearing, 1e5, rings, flexible=kind) for kind in ("both",
    ...     "none"))
    >>> bool(soft.displacement > rigid.displacement)
    True
    """
    if bearing.clearance != 0:
        raise InputError(f"clearance: must be 0 for ring expansion, got {bearing.clearance:g}")
    load = np.asarray(axial_force, float)
    if not np.isfinite(load).all():
        raise InputError(f"axial_force: must be finite, got {load}")
    balls = bearing.balls * bearing.rows
    free, nominal = bearing.groove_distance, bearing.contact_angle
    softness = _softness(bearing, sections, flexible, rings)

    def closure(alpha: Array) -> tuple[Array, Array, Array, Array]:
        force = np.abs(load) / (balls * np.sin(alpha))
        approach = (force / bearing.series_stiffness) ** (2 / 3)
        widening = softness * balls * force * np.cos(alpha)
        gap = free * np.cos(nominal) - widening - (free + approach) * np.cos(alpha)
        return gap, force, approach, widening

    low, high = np.full(load.shape, nominal), np.full(load.shape, np.pi / 2)
    for _ in range(60):
        middle = (low + high) / 2
        open_yet = closure(middle)[0] < 0
        low, high = np.where(open_yet, middle, low), np.where(open_yet, high, middle)
    alpha = (low + high) / 2
    gap, force, approach, widening = closure(alpha)
    shift = (free + approach) * np.sin(alpha) - free * np.sin(nominal)
    residual = np.abs(gap) / free
    return ExpansionResult(force, alpha, np.sign(load) * shift, widening, residual, load)


def _softness(bearing: BallRaceways, sections: RingSections, flexible: str, rings: str) -> float:
    """Expansion of both rings on the radius for the sum of radial ball forces, m/N."""
    parts = {"none": (), "outer": ("outer",), "inner": ("inner",), "both": ("outer", "inner")}
    check_one_of("flexible", flexible, parts)
    check_one_of("rings", rings, ("thin", "thick"))
    total = 0.0
    for ring in parts[flexible]:
        outside, inside = getattr(sections, f"{ring}_outside"), getattr(sections, f"{ring}_inside")
        loaded = inside if ring == "outer" else outside
        if rings == "thin":
            per_pressure = loaded**2 / (2 * (outside - inside))
        else:
            ratio = (inside / outside) ** 2
            sign = 1.0 if ring == "outer" else -1.0
            tube = (1 + ratio) / (1 - ratio) + sign * bearing.poisson_ratio
            per_pressure = loaded / 2 * tube
        total += per_pressure / bearing.elastic_modulus / (np.pi * loaded * sections.height)
    return total
