"""How the rings of a bearing deform: which of them, and what gives their compliance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Protocol, runtime_checkable

import numpy as np
from annotated_types import Ge, Gt

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.contacts import Array, Raceway
from loadflow.rolling.rings.patches import PatchPoints


@runtime_checkable
class Ring(Protocol):
    """Anything that gives the compliance of a ring with its structure at the raceway patches.

    Without what Hertz's law counts: see `loadflow.rolling.rings.local_compliance`.
    """

    def flexibility(self, points: PatchPoints) -> Array:
        """Return Q, (kind, ball, 3, mode), with the compliance C = Q Qᵀ; m/√(N m)."""


@dataclass(frozen=True, kw_only=True)
class FlexibleRings:
    """How the rings of a bearing deform.

    Attributes
    ----------
    inner, outer : Ring, optional
        `RingBeam`, `FiniteElementRing`, `CompliantRing` or anything with their method
        ``flexibility``; rigid if None.
    modes : int, optional
        Ring modes kept for both rings together; by default all of up to 100, else all but 1e-5 (of
        rollers 1e-7) of what smooth loads store in the rings.
    inner_angle, outer_angle : float
        How far each ring has turned with its structure, rad; matters for structures that are not
        rotationally symmetric. Loads and displacements stay in the fixed frame.
    turning_patches : bool
        Whether a raceway patch turns with its section, or only shifts with its master point as
        source's. Of balls: raceways of rollers turn with their section.
    shell : float
        Thickness T_S of the patches of balls, m.
    master_width : float, optional
        Side of the square over which a force enters a ring at a master node, m: the size of the
        elements there. The rings of Ritzer yield under it although Hertz's approach holds that
        already. By default it is counted once.

    Raises
    ------
    InputError
        If a field is out of its range or not a ring.

    Examples
    --------
    >>> from loadflow.rolling import FlexibleRings, RingBeam, RingSection, SlewingBearing, Support
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> wall = Support.wall(radius=0.3, height=0.06, thickness=0.03, length=0.3)
    >>> outer = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.3, supports=(wall,))
    >>> soft = bearing.equilibrium((1e4, 0.0, 5e4), rings=FlexibleRings(outer=outer))
    >>> rigid = bearing.equilibrium((1e4, 0.0, 5e4))
    >>> bool(soft.displacement[2] > rigid.displacement[2])
    True
    """

    inner: Ring | None = None
    outer: Ring | None = None
    modes: Annotated[int, Ge(1)] | None = None
    inner_angle: float = 0.0
    outer_angle: float = 0.0
    turning_patches: bool = False
    shell: Annotated[float, Ge(0)] = 0.5e-3
    master_width: Annotated[float, Gt(0)] | None = None

    def turn(self, ring: Raceway) -> float:
        """How far a ring has turned, rad."""
        return self.outer_angle if ring == "outer" else self.inner_angle

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inner", "outer"):
            ring = getattr(self, name)
            if ring is not None and not isinstance(ring, Ring):
                raise InputError(f"{name}: must have a method flexibility, got {ring!r}")
        for name in ("inner_angle", "outer_angle"):
            if not np.isfinite(getattr(self, name)):
                raise InputError(f"{name}: must be finite, got {getattr(self, name)!r}")
