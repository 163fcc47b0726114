"""Thrust bearings: tapered lands, steps and tilting pads on a plane ring, and straight pads."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

from loadflow.journal.surfaces import Cone, Cut, Strip, Surface, Taper
from loadflow.journal.thrust.pad_thrust import PadThrust
from loadflow.journal.thrust.pads import Pads, Pivot, even_pads
from loadflow.numerics.fields import require

_WEDGE = 0.75
"""Share of a pad's length over which it falls, if nothing is said."""


@dataclass(frozen=True)
class ThrustBearing(PadThrust):
    """Thrust bearing of equal sector pads on a plane ring.

    In the sense of motion the film falls from ``gap + taper`` at the inlet to ``gap`` over the
    first `wedge` of the pad's angle, constant along a radius, then stays.

    Attributes
    ----------
    pads : int
        Number, ≥ 1.
    inner_radius, outer_radius : float
        m.
    pad_angle : float
        Of one pad, rad; pads × pad_angle ≤ 2π.
    taper : float
        Depth of the wedge at the inlet, m.
    wedge : float
        Share of the pad's angle over which it falls to 0.
    first_pad : float
        Angle at which the first pad begins, rad.
    profile : Taper, Step or Flat, optional
        What is cut into the pads, in place of `taper` and `wedge`.
    pivot : Pivot, optional
        Point on which each pad tilts; fixed pads by default.

    Examples
    --------
    >>> from loadflow.journal import Film, Guembel, Lubricant, ThrustBearing
    >>> bearing = ThrustBearing(6, 0.5, 1.0, pad_angle=0.785, taper=1e-4, wedge=0.75)
    >>> film = Film(Lubricant(0.05), Guembel(), grid=(40, 20))
    >>> state = bearing.equilibrium(force=1e6, speed=10.0, film=film)
    >>> round(state.minimum_film * 1e6)
    157
    """

    pads: int
    inner_radius: float
    outer_radius: float
    pad_angle: float
    taper: float = 0.0
    wedge: float = _WEDGE
    first_pad: float = 0.0
    profile: Cut | None = None
    pivot: Pivot | None = None

    def __post_init__(self) -> None:
        inner, outer = self.inner_radius, self.outer_radius
        require(0 < inner < math.inf, "inner_radius", inner, "must be > 0 m and finite")
        allowed = f"m, above inner_radius = {inner:g}, finite"
        require(inner < outer < math.inf, "outer_radius", outer, allowed)
        even_pads(self.pads, self.pad_angle, self.first_pad)
        Taper(self.taper, self.wedge)
        if self.profile is not None:
            require(self.taper == 0, "taper", self.taper, "0 where a profile is given")
            require(self.wedge == _WEDGE, "wedge", self.wedge, "left out where a profile is given")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.taper == 0:
            yield "wedge", "taper is 0"

    @property
    def row(self) -> Pads:
        """The pads."""
        surface: Surface = Cone(0.5 * math.pi, self.inner_radius, self.outer_radius)
        return _row(self, surface, self.pad_angle)


@dataclass(frozen=True)
class RectangularThrustBearing(PadThrust):
    """Thrust bearing of straight rectangular pads round the axis (ISO 12131's idealisation).

    Attributes
    ----------
    pads : int
        Number, ≥ 1.
    mean_radius : float
        Distance of the pads' middles from the axis, m; the runner slides at ω · mean_radius.
    length, width : float
        Along and across the motion, m; an infinite width has no side flow, and all forces are
        then per metre of width.
    taper, wedge, first_pad, profile, pivot
        As in `ThrustBearing`.

    Examples
    --------
    Rayleigh's step of infinite width at its optimum carries 0.2063 η U L²/h²:

    >>> import math
    >>> from loadflow.journal import Film, Lubricant, RectangularThrustBearing, Step
    >>> step = Step(0.866e-4, 0.71823)
    >>> pad = RectangularThrustBearing(1, 10.0, 1.0, math.inf, profile=step)
    >>> found = pad.pressure(gap=1e-4, speed=0.1, film=Film(Lubricant(1.0), grid=(40, 4)))
    >>> round(found.force * 1e-4**2, 3)
    0.206
    """

    pads: int
    mean_radius: float
    length: float
    width: float
    taper: float = 0.0
    wedge: float = _WEDGE
    first_pad: float = 0.0
    profile: Cut | None = None
    pivot: Pivot | None = None

    def __post_init__(self) -> None:
        radius = self.mean_radius
        require(0 < radius < math.inf, "mean_radius", radius, "must be > 0 m and finite")
        require(0 < self.length < math.inf, "length", self.length, "must be > 0 m and finite")
        require(self.width > 0, "width", self.width, "must be > 0 m, or infinite")
        even_pads(self.pads, self.length / radius, self.first_pad)
        Taper(self.taper, self.wedge)
        if self.profile is not None:
            require(self.taper == 0, "taper", self.taper, "0 where a profile is given")
            require(self.wedge == _WEDGE, "wedge", self.wedge, "left out where a profile is given")

    @property
    def row(self) -> Pads:
        """The pads."""
        surface: Surface = Strip(self.mean_radius, self.width)
        return _row(self, surface, self.length / self.mean_radius)


def _row(bearing: ThrustBearing | RectangularThrustBearing, surface: Surface, angle: float) -> Pads:
    profile = bearing.profile or Taper(bearing.taper, bearing.wedge)
    centres = even_pads(bearing.pads, angle, bearing.first_pad)
    return Pads(surface, angle, centres, profile=profile, pivot=bearing.pivot)
