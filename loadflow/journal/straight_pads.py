"""Thrust bearings of straight rectangular pads."""

from __future__ import annotations

import math
from dataclasses import dataclass

from loadflow.journal.pads import Pads, Pivot, even_pads
from loadflow.journal.surfaces import Cut, Strip, Surface, Taper
from loadflow.journal.thrust import WEDGE, PadThrust, row_of
from loadflow.numerics.fields import require


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
    wedge: float = WEDGE
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
            require(self.wedge == WEDGE, "wedge", self.wedge, "left out where a profile is given")

    @property
    def row(self) -> Pads:
        """The pads."""
        surface: Surface = Strip(self.mean_radius, self.width)
        return row_of(self, surface, self.length / self.mean_radius)
