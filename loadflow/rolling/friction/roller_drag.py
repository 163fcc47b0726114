"""Viscous drag on a roller in its pocket and at the ribs (Hampp), with two constants.

The moment against the spin ω_w (relative to the cage) of a roller in a bearing of speed ω is
M_f = C₁ ω_w + C₃₂ ω, (5.18). Equation numbers are those of von Hollen 2013; where von Hollen
misprints or errs, `variant` names the choice:

``"thesis"``
    what von Hollen's program must have computed (its tables follow): the pocket of (4.80) as
    printed, the rest put right;
``"geometric"``
    the pocket as the flat bar of the drawing has it, 4 to 8 times less drag; at the rib also the
    part of the shear that crosses the radius (x² beside y²);
``"printed"``
    everything as printed in (5.20), (5.21).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Lt

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields, check_one_of

Variant = Literal["geometric", "thesis", "printed"]
VARIANTS = ("geometric", "thesis", "printed")


@dataclass(frozen=True, kw_only=True)
class RollerGaps:
    """Roller, pocket and ribs; gaps are pairs (left, right).

    Attributes
    ----------
    radius, length : float
        Of the roller, m.
    end_gaps : tuple of float
        s₁ between roller end and cage, m.
    rib_gaps : tuple of float
        s₂ between roller end and rib, m.
    pocket_gaps : tuple of float
        s₃ between roller and cage bars, m.
    rib_height : float
        m; 0 for none.
    cage_half_height : float
        Half the radial height of the cage's rings, m.
    pocket_angle : float
        Half the angle over which the bar's film is laminar, rad.
    roughness : float
        δ, sum of the roughnesses R_z of roller and pocket, m.
    pitch_diameter : float
        m.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> from loadflow.rolling.friction import RollerGaps
    >>> gaps = RollerGaps(radius=0.02, length=0.06, end_gaps=(2e-4, 2e-4), rib_gaps=(1e-4, 1e-4),
    ...     pocket_gaps=(1e-4, 1e-4), rib_height=0.008, cage_half_height=0.005, pocket_angle=0.5,
    ...     roughness=1e-6, pitch_diameter=0.5)
    >>> gaps.rib_height
    0.008
    """

    radius: Annotated[float, Gt(0)]
    length: Annotated[float, Gt(0)]
    end_gaps: tuple[float, float]
    rib_gaps: tuple[float, float]
    pocket_gaps: tuple[float, float]
    rib_height: Annotated[float, Ge(0)]
    cage_half_height: Annotated[float, Ge(0)]
    pocket_angle: Annotated[float, Gt(0), Lt(math.pi / 2)]
    roughness: Annotated[float, Gt(0)]
    pitch_diameter: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("end_gaps", "rib_gaps", "pocket_gaps"):
            pair = getattr(self, name)
            if len(pair) != 2 or not min(pair) > 0:
                raise InputError(f"{name}: two gaps > 0 m, got {pair}")
        for name in ("rib_height", "cage_half_height"):
            if getattr(self, name) > self.radius:
                raise InputError(
                    f"{name}: must be ≤ the roller's radius {self.radius:g} m, "
                    f"got {getattr(self, name):g}"
                )


@dataclass(frozen=True)
class DragConstants:
    """Moment against the spin of a roller, M_f = spin · ω_w + orbit · ω; N m s.

    Attributes
    ----------
    spin : float
        C₁ (C₁' with friction of the cage).
    orbit : float
        C₃₂ (C₃₂'), of the ribs that the rollers pass; negative where it drives the spin.

    Examples
    --------
    >>> from loadflow.rolling.friction import DragConstants
    >>> drag = DragConstants(spin=2e-6, orbit=1e-6)
    >>> drag.spin * 500.0 + drag.orbit * 100.0  # N m
    0.0011
    """

    spin: float
    orbit: float

    def moment(self, spin: float, speed: float) -> float:
        """Moment against the spin, N m, from spin and bearing speed in rad/s."""
        return self.spin * spin + self.orbit * speed


def strip_moment(radius: float, half_height: float) -> float:
    """Polar moment of area of the strip |y| < b of a roller end, m⁴, in (4.78)."""
    b, r = half_height, radius
    edge = math.sqrt(1 - (b / r) ** 2)
    return r**4 * math.asin(b / r) + b * r**3 * edge * (1 + 2 * (b / r) ** 2) / 3


def segment_area_moment(radius: float, height: float) -> float:
    """∫ y dA of the segment of a roller end that a rib covers, m³, in (4.79)."""
    return 2 / 3 * (2 * radius * height - height**2) ** 1.5


def segment_polar(radius: float, height: float, variant: Variant = "geometric") -> float:
    """Twice the polar moment of that segment, m⁴, in (4.79).

    Von Hollen prints (ρ - h)/ρ² where (ρ - h)²/ρ² is meant (taken in metres here).
    """
    r, left = radius, radius - height
    share = left / r**2 if variant == "printed" else (left / r) ** 2
    chord = math.sqrt(2 * r * height - height**2)
    return r**4 * math.acos(left / r) - r**2 * left * chord * (1 + 2 * share) / 3


def segment_square(radius: float, height: float, variant: Variant = "geometric") -> float:
    """∫ y² dA of that segment, m⁴: ½{…} of (4.79), whose second sign von Hollen prints wrongly."""
    r, left = radius, radius - height
    chord = math.sqrt(2 * r * height - height**2)
    cube = -left * chord**3 if variant == "printed" else left * chord**3
    arc = math.pi / 4 * r**4 - r**4 * math.asin(left / r) / 2
    return (arc + cube - r**2 * left * chord / 2) / 2


def pocket_integral(
    gap: float, radius: float, angle: float, roughness: float, variant: Variant = "geometric"
) -> float:
    """Share of one pocket gap in the drag between roller and bars, 𝒫(s) of (5.20).

    The roller lies against one bar (gap δ) and leaves twice the gap s at the other.
    """
    r, delta, half = radius, roughness, math.tan(angle / 2)
    far = math.atan(math.sqrt((r + gap) / gap) * half) / math.sqrt(gap * r + gap**2)
    if variant == "geometric":
        near = math.atan(math.sqrt((2 * r + delta) / delta) * half)
        near *= 2 * (r + delta) / math.sqrt(2 * r * delta + delta**2)
        return (r + 2 * gap) * far + near
    near = math.atan(math.sqrt((2 * r + delta) / delta) * half)
    near *= (2 * r + delta) / math.sqrt(2 * gap * delta + delta**2)
    return (r + gap) * far + near


def rib_constant(gaps: RollerGaps, viscosity: float, variant: Variant = "geometric") -> float:
    """Share of the ribs in C₁, N m s, in (5.20)."""
    return (
        0.5 * _conductance(gaps, viscosity) * segment_polar(gaps.radius, gaps.rib_height, variant)
    )


def _conductance(gaps: RollerGaps, viscosity: float) -> float:
    left, right = gaps.rib_gaps
    return viscosity / left + viscosity / right


def drag_constants(
    gaps: RollerGaps,
    viscosity: float,
    rib_ratio: float,
    rib: Literal["outer", "inner"] = "outer",
    variant: Variant = "geometric",
) -> DragConstants:
    """Constants C₁ and C₃₂ of the viscous drag on a roller, (5.20), (5.21).

    Parameters
    ----------
    gaps : RollerGaps
        Roller, pocket and ribs.
    viscosity : float
        Pa s.
    rib_ratio : float
        k^(') = speed at which the rollers pass the rib over the bearing's speed: d/(d + D) for ribs
        at a fixed outer ring, D/(d + D) for ribs at a turning inner one.
    rib : {"outer", "inner"}
        Ring with the ribs.
    variant : {"geometric", "thesis", "printed"}
        See the module.

    Returns
    -------
    DragConstants
        Of spin and orbit.

    Raises
    ------
    InputError
        If `rib` or `variant` is unknown.

    Examples
    --------
    >>> from loadflow.rolling.friction import RollerGaps, drag_constants
    >>> gaps = RollerGaps(radius=0.02, length=0.06, end_gaps=(2e-4, 2e-4), rib_gaps=(1e-4, 1e-4),
    ...     pocket_gaps=(1e-4, 1e-4), rib_height=0.008, cage_half_height=0.005, pocket_angle=0.5,
    ...     roughness=1e-6, pitch_diameter=0.5)
    >>> thin, thick = (drag_constants(gaps, viscosity, 0.45) for viscosity in (0.01, 0.02))
    >>> round(thick.spin / thin.spin, 6)  # laminar: as the viscosity
    2.0
    """
    check_one_of("variant", variant, VARIANTS)
    check_one_of("rib", rib, ("outer", "inner"))
    r = gaps.radius
    ends = (viscosity / gaps.end_gaps[0] + viscosity / gaps.end_gaps[1]) * strip_moment(
        r, gaps.cage_half_height
    )
    pocket = -4 * gaps.pocket_angle + sum(
        pocket_integral(gap, r, gaps.pocket_angle, gaps.roughness, variant)
        for gap in gaps.pocket_gaps
    )
    spin = ends + rib_constant(gaps, viscosity, variant) + viscosity * r**2 * gaps.length * pocket
    side = 1.0 if rib == "outer" else -1.0
    area = gaps.pitch_diameter / 2 * segment_area_moment(r, gaps.rib_height)
    if variant == "geometric":
        area += side * segment_polar(r, gaps.rib_height) / 2
    else:
        area += side * segment_square(r, gaps.rib_height, variant)
    sign = 1.0 if variant == "printed" else -1.0
    return DragConstants(spin, sign * _conductance(gaps, viscosity) * rib_ratio * area)


def coulomb_drag_constants(
    gaps: RollerGaps,
    viscosity: float,
    rib_ratio: float,
    adhesion: float,
    sliding: float,
    rib: Literal["outer", "inner"] = "outer",
    driving: Literal["inner", "outer"] = "inner",
    variant: Variant = "geometric",
) -> DragConstants:
    """Constants C₁' and C₃₂' with the cage friction that the rib drag brings, (5.26)–(5.29).

    Parameters
    ----------
    gaps, viscosity, rib_ratio, rib, variant
        As `drag_constants`.
    adhesion, sliding : float
        Friction coefficients μ of roller and raceway, μ' of roller and cage.
    driving : {"inner", "outer"}
        Ring that turns in the frame of the load; "outer" is von Hollen's crank-pin bearing.

    Returns
    -------
    DragConstants
        Of spin and orbit.

    Examples
    --------
    >>> from loadflow.rolling.friction import RollerGaps, coulomb_drag_constants, drag_constants
    >>> gaps = RollerGaps(radius=0.02, length=0.06, end_gaps=(2e-4, 2e-4), rib_gaps=(1e-4, 1e-4),
    ...     pocket_gaps=(1e-4, 1e-4), rib_height=0.008, cage_half_height=0.005, pocket_angle=0.5,
    ...     roughness=1e-6, pitch_diameter=0.5)
    >>> rubbing = coulomb_drag_constants(gaps, 0.02, 0.45, adhesion=0.12, sliding=0.04)
    >>> rubbing.spin != drag_constants(gaps, 0.02, 0.45).spin
    True
    """
    plain = drag_constants(gaps, viscosity, rib_ratio, rib, variant)
    check_one_of("driving", driving, ("inner", "outer"))
    side = 1.0 if rib == "outer" else -1.0
    lever = sliding / (0.75 * (1 - adhesion * sliding))
    change = -side * lever * (1 - adhesion) if driving == "inner" else side * lever * (1 + adhesion)
    half = 2.0 if variant == "printed" else 1.0  # von Hollen drops the factor ½ of (5.20)
    rib_part = half * rib_constant(gaps, viscosity, variant)
    return DragConstants(plain.spin + change * rib_part, plain.orbit * (1 + change))
