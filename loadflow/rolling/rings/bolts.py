"""Bolts that hold a ring to its structure: springs from their size, and what they carry.

Closed forms of single bolts: the bolt as bars in series, the clamped parts as two cones that meet,
or grow into a sleeve where neighbours leave no room. Bolts along the axis of the bearing, through
both flanges; no prying, no settling, no opening of the joint in the load distribution.

References
----------
VDI 2230-1: compliance of bolt and clamped parts, load factor Φ, assembly preload at 90 % of the
yield strength with the torsion of tightening.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.rolling.contacts import Array, Raceway
from loadflow.rolling.rings.patches import PatchPoints
from loadflow.rolling.rings.section import LARGEST, Support
from loadflow.tribology.hertz import STEEL_MODULUS, STEEL_POISSON

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry
    from loadflow.rolling.results import ContactResult

Strength = Literal["8.8", "10.9", "12.9"]

_YIELDS = {"8.8": (640e6, 660e6), "10.9": (940e6, 940e6), "12.9": (1100e6, 1100e6)}
"""R_p0.2 of each strength, up to M16 and above, Pa (ISO 898-1)."""

_USED = 0.9  # share of the yield strength that tightening uses


@dataclass(frozen=True, kw_only=True)
class BoltCircle:
    """Bolts that hold a ring all round, as a support of a `RingBeam`.

    Attributes
    ----------
    radius, height : float
        Circle of the bolts, and the face where the ring meets its structure, m.
    count : int
        Number of bolts.
    diameter, pitch : float
        Nominal diameter and pitch of the metric thread, m; it reaches through the whole grip.
    grip : float
        Length that is clamped, of ring and structure together, m.
    strength : {"10.9", "8.8", "12.9"}
        Property class.
    hole, head : float, optional
        Diameters of the holes and under the heads and nuts, m; 1.1 and 1.4 times the nominal one.
    friction : float
        Coefficient in the thread when it is tightened.
    tightening_factor : float
        α_A, largest over least preload of the way of tightening: 1.4 … 1.6 of a torque wrench.
    first_angle : float
        Azimuth of the first bolt in the frame of the ring, rad.

    Raises
    ------
    InputError
        If a field is out of its range, bolts overlap, or a head is no larger than its hole.

    Examples
    --------
    >>> from loadflow.rolling import BoltCircle
    >>> bolts = BoltCircle(radius=1.0, height=-0.06, count=60, diameter=0.03, pitch=3.5e-3,
    ...     grip=0.18)
    >>> round(bolts.preload / 1e3), round(bolts.load_factor, 3)  # kN
    (427, 0.13)
    """

    radius: Annotated[float, Gt(0), Le(LARGEST)]
    height: float
    count: Annotated[int, Ge(3)]
    diameter: Annotated[float, Gt(0)]
    pitch: Annotated[float, Gt(0)]
    grip: Annotated[float, Gt(0), Le(LARGEST)]
    strength: Strength = "10.9"
    hole: Annotated[float, Gt(0)] | None = None
    head: Annotated[float, Gt(0)] | None = None
    friction: Annotated[float, Ge(0), Le(1)] = 0.12
    tightening_factor: Annotated[float, Ge(1), Le(10)] = 1.6
    first_angle: float = 0.0

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "strength", tuple(_YIELDS))
        if not math.isfinite(self.height + self.first_angle):
            raise InputError("height, first_angle: must be finite")
        if self.pitch >= self.diameter / 2:
            raise InputError(
                f"pitch: must be < {self.diameter / 2:g} m, half the diameter, got {self.pitch:g}"
            )
        if not self.diameter <= self._hole < self._head:
            raise InputError(
                f"hole, head: must be diameter {self.diameter:g} ≤ hole < head, got "
                f"{self._hole:g} and {self._head:g} m"
            )
        if self._spacing < self._head:
            raise InputError(
                f"count: {self.count} heads of {self._head:g} m overlap on a circle of radius "
                f"{self.radius:g} m"
            )

    @property
    def _hole(self) -> float:
        return self.hole or 1.1 * self.diameter

    @property
    def _head(self) -> float:
        return self.head or 1.4 * self.diameter

    @property
    def _spacing(self) -> float:
        return 2 * math.pi * self.radius / self.count

    @property
    def azimuth(self) -> Array:
        """Of the bolts in the frame of the ring, rad."""
        return self.first_angle + 2 * np.pi * np.arange(self.count) / self.count

    # --- one bolt --------------------------------------------------------------------------------
    @property
    def _flank(self) -> float:
        """Flank diameter d₂, m."""
        return self.diameter - 0.64952 * self.pitch

    @property
    def _core(self) -> float:
        """Core diameter d₃, m."""
        return self.diameter - 1.22687 * self.pitch

    @property
    def bolt_compliance(self) -> float:
        """δ_S of one bolt, m/N: head, thread within the grip, thread within the nut, nut."""
        whole, core = math.pi / 4 * self.diameter**2, math.pi / 4 * self._core**2
        head, nut = 0.5 * self.diameter, 0.4 * self.diameter
        return ((head + nut) / whole + (self.grip + 0.5 * self.diameter) / core) / STEEL_MODULUS

    @property
    def clamped_compliance(self) -> float:
        """δ_P of the parts that one bolt clamps, m/N; it has the room up to its neighbours."""
        outer, hole, head, grip = self._spacing, self._hole, self._head, self.grip
        tan = 0.362 + 0.032 * math.log(grip / head / 2) + 0.153 * math.log(outer / head)
        edge = min(outer, head + grip * tan)
        cones = math.log((head + hole) * (edge - hole) / ((head - hole) * (edge + hole)))
        sleeve = max(grip - (edge - head) / tan, 0.0)
        area = math.pi / 4 * (edge**2 - hole**2)
        return (2 * cones / (math.pi * hole * tan) + sleeve / area) / STEEL_MODULUS

    @property
    def joint_stiffness(self) -> float:
        """Of a closed joint along one bolt, N/m: the bolt and what it clamps, side by side."""
        return 1 / self.clamped_compliance + 1 / self.bolt_compliance

    @property
    def load_factor(self) -> float:
        """Φ: share of a pull along the axis, under head and nut, that a bolt carries."""
        return self.clamped_compliance / (self.clamped_compliance + self.bolt_compliance)

    @property
    def preload(self) -> float:
        """Largest assembly preload F_M of one bolt, N: 90 % of the yield strength."""
        mean = (self._flank + self._core) / 2
        small, large = _YIELDS[self.strength]
        strength = _USED * (small if self.diameter <= 0.016 else large)
        lead = self.pitch / (math.pi * self._flank) + 1.155 * self.friction
        torsion = 1.5 * self._flank / mean * lead
        return math.pi / 4 * mean**2 * strength / math.sqrt(1 + 3 * torsion**2)

    @property
    def least_preload(self) -> float:
        """Preload that is left where tightening scatters most, N."""
        return self.preload / self.tightening_factor

    def clamping(self, pull: ArrayLike) -> Array:
        """Share of the least preload that still clamps under a pull on one bolt, N; < 0 opens."""
        freed = (1 - self.load_factor) * np.asarray(pull, float)
        return np.asarray(1 - freed / self.least_preload)

    # --- the circle ------------------------------------------------------------------------------
    @cached_property
    def springs(self) -> Support:
        """The bolts with what they clamp as springs per length of their circle.

        Axially bolt and clamped parts side by side, as long as the joint is closed. In the joint
        friction holds: along it the clamped parts yield in shear, and against tilt in bending, as a
        sleeve that is as stiff as they are.
        """
        stiff, axial = 1 / self.clamped_compliance, self.joint_stiffness
        shear = stiff / (2 * (1 + STEEL_POISSON))
        area = stiff * self.grip / STEEL_MODULUS
        around = 4 * area / math.pi + 2 * self._hole**2  # D² + d_h² of that sleeve
        bending = stiff * around / 16
        radial, tangential, along, tilt = (
            each / self._spacing for each in (shear, shear, axial, bending)
        )
        return Support(
            radius=self.radius, height=self.height,
            radial=radial, tangential=tangential, axial=along, tilt=tilt,
        )  # fmt: skip


@dataclass(frozen=True)
class BoltLoads:
    """What the bolts of a ring carry.

    Attributes
    ----------
    bolts : BoltCircle
        The bolts.
    pull : ndarray, shape (..., bolt)
        Force on each joint along the axis that pulls ring and structure apart, N.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import BoltCircle, BoltLoads
    >>> bolts = BoltCircle(radius=1.0, height=-0.06, count=60, diameter=0.03, pitch=3.5e-3,
    ...     grip=0.18)
    >>> loads = BoltLoads(bolts, np.array([0.0, 1e5, 4e5]))
    >>> loads.clamping.round(2), (loads.largest_force / 1e3).round()  # kN
    (array([ 1.  ,  0.67, -0.3 ]), array([427., 440., 479.]))
    """

    bolts: BoltCircle
    pull: Array

    @property
    def clamping(self) -> Array:
        """Share of the least preload that still clamps each joint, (..., bolt); < 0 opens it."""
        return self.bolts.clamping(self.pull)

    @property
    def largest_force(self) -> Array:
        """Force of each bolt tightened most, N, (..., bolt)."""
        return np.asarray(self.bolts.preload + self.bolts.load_factor * self.pull)


def bolts_of(ring: object) -> list[BoltCircle]:
    """Circles of bolts among the supports of a ring; none of a ring without supports."""
    return [held for held in getattr(ring, "supports", ()) if isinstance(held, BoltCircle)]


def bolt_loads(result: ContactResult[RollingGeometry], ring: Raceway) -> list[BoltLoads]:
    """Loads of the bolts of a flexible ring, circle by circle.

    Parameters
    ----------
    result : RollingEquilibrium
        With ``rings=FlexibleRings(…)``.
    ring : {"inner", "outer"}
        Which ring.

    Returns
    -------
    list of BoltLoads
        One for each circle.

    Raises
    ------
    InputError
        If the ring is rigid, or has no bolts.

    Examples
    --------
    >>> from loadflow.rolling import (
    ...     BoltCircle, FlexibleRings, RingBeam, RingSection, SlewingBearing, bolt_loads)
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> bolts = BoltCircle(radius=0.31, height=-0.05, count=30, diameter=0.02, pitch=2.5e-3,
    ...     grip=0.12)
    >>> outer = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.3, supports=(bolts,))
    >>> loaded = bearing.equilibrium((0.0, 0.0, 1e5), rings=FlexibleRings(outer=outer))
    >>> found = bolt_loads(loaded, "outer")[0]
    >>> round(float(found.pull.sum() / 1e3)), round(float(found.clamping.min()), 2)  # kN
    (100, 0.97)
    """
    from loadflow.rolling.rings.equilibrium import FlexibleRingForces

    elements = result.elements
    if not isinstance(elements, FlexibleRingForces):
        raise InputError(f"ring: the {ring} ring is rigid")
    model: Any = getattr(elements.rings, ring)
    circles = bolts_of(model)
    if not circles:
        raise InputError(f"ring: the {ring} ring has no bolts; give its supports a BoltCircle")
    modal = elements.modal_force(ring)
    found = []
    for bolts in circles:
        places = PatchPoints(np.array([bolts.radius]), np.array([bolts.height]), bolts.azimuth)
        lifted = np.einsum("bm,...m->...b", model.flexibility(places)[0, :, 2], modal)
        away = 1.0 if model.height > bolts.height else -1.0
        found.append(BoltLoads(bolts, away * bolts.joint_stiffness * lifted))
    return found
