"""Shapes of the bore: a cylinder, one partial arc, fixed lobes, tilting pads. Options only."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal, NamedTuple

import numpy as np
from annotated_types import Ge, Gt, Le, Lt
from numpy.typing import NDArray

from loadflow.numerics.fields import require

Array = NDArray[np.float64]
_TURN = 2 * np.pi


class Segment(NamedTuple):
    """Part of the bore between two axial grooves, angles in rad.

    Its radius of curvature exceeds that of the shaft by ``c / (1 − preload)``; centred, the shaft
    is nearest to it at `narrowest`, where the gap is the radial clearance c.
    """

    start: float
    end: float
    narrowest: float
    preload: float
    tilting: bool


def _require_preload(preload: float, offset: float) -> None:
    require(0 <= preload < 1, "preload", preload, "0 ≤ preload < 1")
    require(0 <= offset <= 1, "offset", offset, "0 … 1, share of the arc before the narrowest gap")


@dataclass(frozen=True)
class Cylindrical:
    """Full cylinder.

    Examples
    --------
    >>> from loadflow.journal import Cylindrical, JournalBearing
    >>> JournalBearing(0.2, 0.1, 1e-3).shape == Cylindrical()
    True
    """

    kind: Literal["cylindrical"] = "cylindrical"

    @property
    def segments(self) -> tuple[Segment, ...]:
        """None: the bore runs all the way round."""
        return ()

    @property
    def groove_pressure(self) -> None:
        """There are no grooves between segments."""
        return None

    @property
    def grooves_between(self) -> bool:
        """Whether grooves fill what the segments leave free."""
        return False


@dataclass(frozen=True)
class Arc:
    """One partial arc of a cylinder; both of its ends lie in oil.

    Attributes
    ----------
    angle : float
        Angle of its middle from the first axis toward the second, rad.
    span : float
        Angle it spans, rad: 180, 150, 120, 90° in ISO 7902.
    groove_pressure : float, optional
        Pressure of the oil at both ends, Pa, absolute; default the edge pressure.

    Examples
    --------
    >>> import math
    >>> from loadflow.journal import Arc, JournalBearing
    >>> half = Arc(angle=0.0, span=math.pi)
    >>> bearing = JournalBearing(0.2, 0.1, 1e-3, shape=half)
    """

    angle: float
    span: Annotated[float, Gt(0), Lt(6.28)]
    groove_pressure: float | None = None
    kind: Literal["arc"] = "arc"

    def __post_init__(self) -> None:
        require(0 < self.span < 6.28, "span", self.span, "rad, 0 < span < 6.28")

    @property
    def segments(self) -> tuple[Segment, ...]:
        """The one arc."""
        half = 0.5 * self.span
        return (Segment(self.angle - half, self.angle + half, self.angle, 0.0, False),)

    @property
    def grooves_between(self) -> bool:
        """Whether grooves fill what the arc leaves free: the edge pressure acts there."""
        return False


@dataclass(frozen=True)
class Lobes:
    """Equal fixed lobes with axial grooves between them.

    The relative clearance of the bearing is the assembled one: c is the radius of the largest
    circle inside the bore less that of the shaft (for the `offset` 1/2). The lobes are arcs of the
    clearance ``c / (1 − preload)``.

    Attributes
    ----------
    count : int
        Number of lobes.
    preload : float
        1 − assembled over machined clearance, 0 … 1; 0 is a cylinder with grooves.
    groove : float
        Angle that each axial groove spans, rad.
    angle : float
        Angle of the middle of the first lobe from the first axis toward the second, rad.
    offset : float
        Place of a lobe's narrowest gap as a share of its arc, from its end of smaller angle: 1/2 is
        symmetric, 1 converges all along where the shaft turns from the first axis to the second.
    groove_pressure : float, optional
        Pressure in the grooves, Pa, absolute; default the edge pressure.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lobes
    >>> bearing = JournalBearing(0.2, 0.1, 1e-3, shape=Lobes(count=3, preload=0.5))
    >>> len(bearing.shape.segments)
    3
    """

    count: Annotated[int, Ge(1), Le(12)]
    preload: Annotated[float, Ge(0), Lt(1)] = 0.0
    groove: Annotated[float, Gt(0)] = 0.3490658503988659
    angle: float = 0.0
    offset: Annotated[float, Ge(0), Le(1)] = 0.5
    groove_pressure: float | None = None
    kind: Literal["lobes"] = "lobes"

    def __post_init__(self) -> None:
        require(1 <= self.count <= 12, "count", self.count, "1 … 12")
        _require_preload(self.preload, self.offset)
        widest = 0.9 * _TURN / self.count
        require(0 < self.groove < widest, "groove", self.groove, f"rad, 0 < groove < {widest:.4g}")

    @property
    def segments(self) -> tuple[Segment, ...]:
        """The lobes, in the order of their angle."""
        arc = _TURN / self.count - self.groove
        middles = [self.angle + k * _TURN / self.count for k in range(self.count)]
        return tuple(
            _segment(m - 0.5 * arc, arc, self.preload, self.offset, False) for m in middles
        )

    @property
    def grooves_between(self) -> bool:
        """Whether grooves fill what the segments leave free."""
        return True


@dataclass(frozen=True)
class TiltingPads:
    """Equal pads that tilt about axial pivots on their back without friction or inertia.

    The pads are thin and rigid and hold still where their film carries nothing. The gap of the
    centred shaft over the pivots is the radial clearance c; the pads are arcs of the clearance
    ``c / (1 − preload)``.

    Attributes
    ----------
    count : int
        Number of pads.
    arc : float
        Angle that each pad spans, rad.
    preload : float
        1 − assembled over machined clearance, 0 … 1.
    angle : float
        Angle of the first pivot from the first axis toward the second, rad: with the load along
        the first axis 0 is load on pad, π/count load between pads.
    offset : float
        Place of the pivot as a share of the arc, from the end of smaller angle.
    groove_pressure : float, optional
        Pressure between the pads, Pa, absolute; default the edge pressure.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, TiltingPads
    >>> bearing = JournalBearing(0.2, 0.1, 1e-3, shape=TiltingPads(count=4, arc=1.2, preload=0.3))
    >>> len(bearing.shape.segments)
    4
    """

    count: Annotated[int, Ge(1), Le(12)]
    arc: Annotated[float, Gt(0)]
    preload: Annotated[float, Ge(0), Lt(1)] = 0.0
    angle: float = 0.0
    offset: Annotated[float, Gt(0), Lt(1)] = 0.5
    groove_pressure: float | None = None
    kind: Literal["tilting pads"] = "tilting pads"

    def __post_init__(self) -> None:
        require(1 <= self.count <= 12, "count", self.count, "1 … 12")
        _require_preload(self.preload, self.offset)
        require(0 < self.offset < 1, "offset", self.offset, "0 < offset < 1 for a pivot")
        whole = _TURN / self.count
        require(0 < self.arc < whole, "arc", self.arc, f"rad, 0 < arc < 2π/count = {whole:.4g}")

    @property
    def segments(self) -> tuple[Segment, ...]:
        """The pads, in the order of their angle."""
        pivots = [self.angle + k * _TURN / self.count for k in range(self.count)]
        starts = [pivot - self.offset * self.arc for pivot in pivots]
        return tuple(_segment(s, self.arc, self.preload, self.offset, True) for s in starts)

    @property
    def grooves_between(self) -> bool:
        """Whether grooves fill what the segments leave free."""
        return True


def _segment(start: float, arc: float, preload: float, offset: float, tilting: bool) -> Segment:
    return Segment(start, start + arc, start + offset * arc, preload, tilting)


Shape = Cylindrical | Arc | Lobes | TiltingPads
CYLINDER = Cylindrical()
