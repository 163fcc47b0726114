"""Surfaces that carry a film: cone, plane ring and straight pad, and the profiles cut into them.

On a surface of revolution with radius r and generator coordinate s, the angle φ and ζ, with
dζ = ds/r, are isothermal: the metric is r² (dφ² + dζ²). In them the pressure flow of the Reynolds
equation is that of a plane; only what goes with the surface of a cell (drag, squeeze, load) has
the factor (r/R)², R the reference radius. The cylinder is the surface on which this factor is 1.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.fields import require

Array = NDArray[np.float64]


class Frame(NamedTuple):
    """A point of a surface, seen from the point about which the shaft turns, and three axes there.

    Attributes
    ----------
    point : array (3,)
        m.
    normal, generator, tangent : array (3,)
        Out of the shaft; away from apex or axis; with the motion.
    """

    point: Array
    normal: Array
    generator: Array
    tangent: Array

    def turning(self, axis: Array) -> Array:
        """Displacements and rotations (5,) of the shaft that turn it by 1 rad about the point."""
        return np.concatenate([np.cross(axis, -self.point), axis[:2]])

    def along(self, axis: Array) -> Array:
        """Displacements and rotations (5,) of the shaft that shift it by 1 m."""
        return np.append(axis, [0.0, 0.0])


class Surface(Protocol):
    """What the film asks of the surface on which it lies."""

    def __hash__(self) -> int:
        """Surfaces are keys of the meshes on them."""

    @property
    def radius(self) -> float:
        """Reference radius R, m: unit of length of the film."""

    @property
    def rigid(self) -> slice:
        """Those of the five motions of the shaft (x, y, z, about x, about y) that move the gap."""

    @property
    def open_ends(self) -> bool:
        """Whether oil leaves at both ends."""

    def nodes(self, cells: int) -> Array:
        """Even nodes ζ across, from the inner to the outer end (cells + 1,)."""

    def metric(self, z: Array) -> Array:
        """Square of the radius at ζ over R²."""

    def area(self, edges: Array) -> Array:
        """Surface of the cells between `edges` (cells + 1,) per radian, in R²."""

    def place(self, z: Array) -> Array:
        """Distance from the apex (or from the axis) at ζ, m."""

    def basis(self, angle: Array) -> Array:
        """The three functions of the angle that compose all motions, (3, …)."""

    def motions(self, z: Array) -> tuple[Array, Array]:
        """Motions of the shaft that close the gap: factors of `basis` (5, 3), and of ζ (5, n)."""

    def frame(self, angle: float, place: float) -> Frame:
        """Point and axes of the surface at an angle and a distance from apex or axis, m."""


@dataclass(frozen=True)
class Cone:
    """Cone between two distances from the apex; with half angle π/2 a plane ring.

    Attributes
    ----------
    half_angle : float
        α between axis and generator, rad.
    inner, outer : float
        Distances of both ends from the apex along the generator, m.
    """

    half_angle: float
    inner: float
    outer: float

    @property
    def middle(self) -> float:
        """Distance of the middle of the generator from the apex, m."""
        return 0.5 * (self.inner + self.outer)

    @property
    def radius(self) -> float:
        """Radius at the middle of the generator, m."""
        return self.middle * math.sin(self.half_angle)

    @property
    def rigid(self) -> slice:
        """All five motions, on a plane ring the last three."""
        return slice(2 if math.cos(self.half_angle) < 1e-12 else 0, 5)

    @property
    def open_ends(self) -> bool:
        """Oil leaves at both ends."""
        return True

    def nodes(self, cells: int) -> Array:
        """Nodes at even steps of ln s, (cells + 1,)."""
        inner, outer = (math.log(s / self.middle) for s in (self.inner, self.outer))
        return np.linspace(inner, outer, cells + 1) / math.sin(self.half_angle)

    def metric(self, z: Array) -> Array:
        """Square of the radius at ζ over R²."""
        return np.asarray(np.exp(2.0 * math.sin(self.half_angle) * z))

    def area(self, edges: Array) -> Array:
        """Surface of the cells between `edges` per radian, in R²."""
        squares = np.expm1(2.0 * math.sin(self.half_angle) * edges)
        return np.diff(squares) / (2.0 * math.sin(self.half_angle))

    def place(self, z: Array) -> Array:
        """Distance from the apex at ζ, m."""
        return np.asarray(self.middle * np.exp(math.sin(self.half_angle) * z))

    def basis(self, angle: Array) -> Array:
        """Cosine, sine and 1."""
        return np.array([np.cos(angle), np.sin(angle), np.ones_like(angle)])

    def motions(self, z: Array) -> tuple[Array, Array]:
        """Motions of the shaft that close the gap; rotations are about the middle of the axis.

        The point on the axis is that at half the length of the cone; a rotation counts in units
        of displacement per R.
        """
        cos, sin = math.cos(self.half_angle), math.sin(self.half_angle)
        factors = np.array(
            [[cos, 0.0, 0.0], [0.0, cos, 0.0], [0.0, 0.0, -sin], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]]
        )
        across = np.ones((5, z.size))
        across[3:] = (np.expm1(sin * z) + sin**2) / sin
        return factors, across

    def frame(self, angle: float, place: float) -> Frame:
        """Point and axes at an angle and a distance from the apex, m."""
        cos, sin = math.cos(self.half_angle), math.sin(self.half_angle)
        x, y = math.cos(angle), math.sin(angle)
        height = place * cos - self.middle * cos
        return Frame(
            point=np.array([place * sin * x, place * sin * y, height]),
            normal=np.array([cos * x, cos * y, -sin]),
            generator=np.array([sin * x, sin * y, cos]),
            tangent=np.array([-y, x, 0.0]),
        )


@dataclass(frozen=True)
class Strip:
    """Straight pad whose middle runs at `radius`: a piece of a plane ring without curvature.

    Attributes
    ----------
    radius : float
        Distance of the pad's middle from the axis, m; the runner passes at ω · radius.
    width : float
        Across the motion, m; infinite for a pad without side flow, whose results are per metre.
    """

    radius: float
    width: float

    @property
    def rigid(self) -> slice:
        """Axial motion and both tilts."""
        return slice(2, 5)

    @property
    def open_ends(self) -> bool:
        """Whether oil leaves at both sides."""
        return math.isfinite(self.width)

    def nodes(self, cells: int) -> Array:
        """Even nodes; one metre of an infinitely wide pad is two rows of them."""
        if not self.open_ends:
            return np.array([-0.75, -0.25, 0.25, 0.75]) / self.radius
        return np.linspace(-0.5, 0.5, cells + 1) * self.width / self.radius

    def metric(self, z: Array) -> Array:
        """One."""
        return np.ones_like(z)

    def area(self, edges: Array) -> Array:
        """Cell widths, in R."""
        return np.diff(edges)

    def place(self, z: Array) -> Array:
        """Distance from the axis at ζ, m."""
        return np.asarray(self.radius * (1.0 + z))

    def basis(self, angle: Array) -> Array:
        """1, distance along the motion over R, and 1."""
        return np.array([np.ones_like(angle), angle, np.ones_like(angle)])

    def motions(self, z: Array) -> tuple[Array, Array]:
        """As on a plane ring."""
        factors = np.zeros((5, 3))
        factors[2, 2], factors[3, 1], factors[4, 0] = -1.0, -1.0, 1.0
        across = np.ones((5, z.size))
        across[4] = 1.0 + z
        return factors, across

    def frame(self, angle: float, place: float) -> Frame:
        """Point and axes at a distance along the motion over R, and from the axis, m."""
        normal, generator, tangent = -np.eye(3)[2], np.eye(3)[0], np.eye(3)[1]
        return Frame(np.array([place, self.radius * angle, 0.0]), normal, generator, tangent)


# --- profiles ------------------------------------------------------------------------------------
class Profile(Protocol):
    """What is cut into a pad: it widens the gap by `depth`, m, at a share of the pad's length."""

    @property
    def kinks(self) -> tuple[float, ...]:
        """Shares of the length, in the sense of motion, at which the profile has a kink or step."""

    def depth(self, share: Array) -> Array:
        """Depth at shares of the length, m."""


@dataclass(frozen=True)
class Flat:
    """A pad without profile.

    Examples
    --------
    >>> from loadflow.journal import Flat
    >>> Flat().kinks
    ()
    """

    kind: Literal["flat"] = "flat"

    @property
    def kinks(self) -> tuple[float, ...]:
        """None."""
        return ()

    def depth(self, share: Array) -> Array:
        """Zero."""
        return np.zeros_like(share)

    @property
    def reversed(self) -> Flat:
        """The same for the other sense of rotation."""
        return self


FLAT = Flat()


@dataclass(frozen=True)
class Taper:
    """Film that falls linearly from the inlet, then a flat land (ISO 12131).

    Attributes
    ----------
    taper : float
        Depth at the inlet, m.
    wedge : float
        Share of the pad's length over which it falls to 0.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import Taper
    >>> profile = Taper(taper=1e-4, wedge=0.75)
    >>> profile.depth(np.array([0.0, 0.75, 1.0])).tolist()  # m, from the inlet to the outlet
    [0.0001, 0.0, 0.0]
    """

    taper: float
    wedge: float = 0.75
    kind: Literal["taper"] = "taper"

    def __post_init__(self) -> None:
        require(0 <= self.taper < math.inf, "taper", self.taper, "must be ≥ 0 m and finite")
        require(0 < self.wedge <= 1, "wedge", self.wedge, "share of the pad's angle, 0 < … ≤ 1")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.taper == 0:
            yield "wedge", "taper is 0"

    @property
    def kinks(self) -> tuple[float, ...]:
        """The end of the wedge."""
        return (self.wedge,) if self.wedge < 1 else ()

    def depth(self, share: Array) -> Array:
        """Depth at shares of the length, m."""
        return np.asarray(self.taper * np.maximum(0.0, 1.0 - share / self.wedge))

    @property
    def reversed(self) -> Reversed:
        """The same for the other sense of rotation."""
        return Reversed(self)


@dataclass(frozen=True)
class Step:
    """Rayleigh step: deeper by `height` up to a share of the length [Rayleigh 1918].

    Attributes
    ----------
    height : float
        Depth of the inlet land below the outlet land, m.
    share : float
        Share of the pad's length before the step.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import Step
    >>> Step(height=1e-4).depth(np.array([0.2, 0.9])).tolist()  # m, before and behind the step
    [0.0001, 0.0]
    """

    height: float
    share: float = 0.718
    kind: Literal["step"] = "step"

    def __post_init__(self) -> None:
        require(0 <= self.height < math.inf, "height", self.height, "must be ≥ 0 m and finite")
        require(0 < self.share < 1, "share", self.share, "share of the pad's length, 0 … 1")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.height == 0:
            yield "share", "height is 0"

    @property
    def kinks(self) -> tuple[float, ...]:
        """The step."""
        return (self.share,)

    def depth(self, share: Array) -> Array:
        """Depth at shares of the length, m."""
        return np.where(share < self.share, self.height, 0.0)

    @property
    def reversed(self) -> Reversed:
        """The same for the other sense of rotation."""
        return Reversed(self)


@dataclass(frozen=True)
class Reversed:
    """A profile cut for the other sense of rotation.

    Attributes
    ----------
    profile : Profile
        The profile as it is cut for the sense of motion.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal.surfaces import Reversed, Taper
    >>> Reversed(Taper(taper=1e-4, wedge=0.75)).depth(np.array([0.0, 0.25, 1.0])).tolist()
    [0.0, 0.0, 0.0001]
    """

    profile: Taper | Step
    kind: Literal["reversed"] = "reversed"

    @property
    def kinks(self) -> tuple[float, ...]:
        """Those of the profile, from the other end."""
        return tuple(sorted(1.0 - share for share in self.profile.kinks))

    def depth(self, share: Array) -> Array:
        """Depth at shares of the length, m."""
        return self.profile.depth(1.0 - share)

    @property
    def reversed(self) -> Taper | Step:
        """The profile itself."""
        return self.profile


Cut = Flat | Taper | Step | Reversed
"""What may be cut into the pads of a bearing."""
