"""Relief of a bore: what is cut into it or what it is deformed by. Options only.

Crowning, a measured or calculated contour, recesses; all of it widens the gap where it is positive.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import NDArray

from loadflow.numerics.fields import require
from loadflow.numerics.lines import on_lines

Array = NDArray[np.float64]
_TURN = 2 * np.pi
_ROUNDED = 1e-9  # share by which a length may exceed what it was computed from


@dataclass(frozen=True)
class Crown:
    """Bore that widens toward both ends, against the bending of the shaft (Fig. 1-8).

    The gap grows by ``height · ((|z| − B/2 + length) / length)^exponent`` over the last `length`
    before each end.

    Attributes
    ----------
    height : float
        Growth of the gap at the bearing ends, m.
    length : float, optional
        Axial length of either crown, m; at most half of the width, which is the default.
    exponent : float
        2 is a parabola, 1 a cone.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import Crown, JournalBearing
    >>> bearing = JournalBearing(0.2, 0.1, 1e-3, relief=(Crown(height=10e-6),))
    >>> ends = np.array([-0.05, 0.0, 0.05])
    >>> bearing.relief[0].added(np.zeros(1), ends, width=0.1).tolist()  # m, ends and middle
    [[1e-05, 0.0, 1e-05]]
    """

    height: float
    length: Annotated[float, Gt(0)] | None = None
    exponent: Annotated[float, Ge(1)] = 2.0
    kind: Literal["crown"] = "crown"

    def __post_init__(self) -> None:
        require(bool(np.isfinite(self.height)), "height", self.height, "m, finite")
        require(self.length is None or self.length > 0, "length", self.length, "must be > 0 m")
        require(self.exponent >= 1, "exponent", self.exponent, "≥ 1")

    def beyond(self, width: float) -> Iterator[tuple[str, float, str]]:
        """Fields that do not fit a bearing of `width`, m: name, value and what is allowed."""
        if self.length is not None and self.length > 0.5 * width * (1 + _ROUNDED):
            yield "length", self.length, f"m, at most half of the width, {0.5 * width:g}"

    def added(self, angle: Array, z: Array, width: float) -> Array:
        """Growth of the gap at `angle` (n,) and `z` (m,) of a bearing of `width`, (n, m), m."""
        half = 0.5 * width
        length = half if self.length is None else min(self.length, half)
        share = np.maximum(np.abs(z) - half + length, 0.0) / length
        return np.broadcast_to(self.height * share**self.exponent, (angle.size, z.size))

    def steps(self, width: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Angles (rad) and axial places (m) at which the gap steps: none."""
        return (), ()

    @property
    def even_around(self) -> bool:
        """Whether the gap grows alike at all angles."""
        return True

    def symmetric(self, width: float) -> bool:
        """Whether both halves of the width are alike."""
        return True


@dataclass(frozen=True)
class Recess:
    """Rectangular pocket of constant depth in the bore, filled by what flows through it.

    Attributes
    ----------
    angle, arc : float
        Angle of its middle from the first axis toward the second and the angle it spans, rad.
    depth : float
        m.
    length : float, optional
        Axial length, m; default the full width.
    z : float
        Axial place of its middle, m from mid-plane.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Recess
    >>> pocket = Recess(angle=0.0, arc=0.5, depth=1e-4, length=0.05)
    >>> bearing = JournalBearing(0.2, 0.1, 1e-3, relief=(pocket,))
    """

    angle: float
    arc: Annotated[float, Gt(0), Le(_TURN)]
    depth: Annotated[float, Gt(0)]
    length: Annotated[float, Gt(0)] | None = None
    z: float = 0.0
    kind: Literal["recess"] = "recess"

    def __post_init__(self) -> None:
        require(0 < self.arc <= _TURN, "arc", self.arc, "rad, 0 < arc ≤ 2π")
        require(self.depth > 0, "depth", self.depth, "must be > 0 m")
        require(self.length is None or self.length > 0, "length", self.length, "must be > 0 m")
        placed = self.length is not None or self.z == 0
        require(placed, "z", self.z, "0 across the full width; give the length of a shorter one")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.arc >= _TURN:
            yield "angle", "the recess runs round"

    def beyond(self, width: float) -> Iterator[tuple[str, float, str]]:
        """Fields that do not fit a bearing of `width`, m: name, value and what is allowed."""
        low, high = self.across(width)
        if high <= -0.5 * width or low >= 0.5 * width:
            yield "z", self.z, f"m, so that the recess reaches into ±{0.5 * width:g}"

    def added(self, angle: Array, z: Array, width: float) -> Array:
        """Growth of the gap at `angle` (n,) and `z` (m,) of a bearing of `width`, (n, m), m."""
        away = np.abs((angle - self.angle + np.pi) % _TURN - np.pi)
        low, high = self.across(width)
        inside = (away < 0.5 * self.arc)[:, None] & ((z > low) & (z < high))[None, :]
        return np.where(inside, self.depth, 0.0)

    def steps(self, width: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Angles (rad) and axial places (m) at which the gap steps: its ends inside the bearing."""
        around = self.angle - 0.5 * self.arc, self.angle + 0.5 * self.arc
        return around, tuple(z for z in self.across(width) if abs(z) < 0.5 * width)

    def across(self, width: float) -> tuple[float, float]:
        """Axial places of both ends, m; beyond the ends where it is as long as the bearing."""
        half = width if self.length is None else 0.5 * self.length
        return self.z - half, self.z + half

    @property
    def even_around(self) -> bool:
        """Whether the gap grows alike at all angles."""
        return False

    def symmetric(self, width: float) -> bool:
        """Whether both halves of the width are alike."""
        low, high = (np.clip(end, -0.5 * width, 0.5 * width) for end in self.across(width))
        return bool(low == -high)


@dataclass(frozen=True)
class Contour:
    """Given contour or deformation of the bore, linear between its points.

    Attributes
    ----------
    angle : sequence of float (n,)
        rad, increasing; a contour that spans less than a turn is closed between its last and first
        point.
    height : sequence (n,) or (n, m)
        Growth of the gap, m.
    z : sequence of float (m,), optional
        Axial places, m from mid-plane, increasing; constant beyond them. Needed for heights (n, m).

    Examples
    --------
    >>> from loadflow.journal import Contour
    >>> oval = Contour(angle=[0.0, 1.5708, 3.1416, 4.7124], height=[0.0, 1e-5, 0.0, 1e-5])
    >>> round(oval.added(0.7854, 0.0, width=0.1).item() * 1e6, 2)  # µm, half way
    5.0
    """

    angle: Sequence[float]
    height: Sequence[float] | Sequence[Sequence[float]]
    z: Sequence[float] | None = None
    kind: Literal["contour"] = "contour"

    def __post_init__(self) -> None:
        height = np.asarray(self.height, dtype=float)
        rows = height.tolist()
        object.__setattr__(self, "height", tuple(map(tuple, rows) if height.ndim == 2 else rows))
        for name in ("angle", "z"):
            if (points := getattr(self, name)) is not None:
                object.__setattr__(self, name, tuple(np.asarray(points, dtype=float).tolist()))
        angle, z, table = self._table
        shape = (angle.size, z.size)
        require(table.shape == shape, "height", height.shape, f"one value for each point {shape}")
        for name, points in (("angle", angle), ("z", z)):
            require(bool(np.all(np.diff(points) > 0)), name, points.tolist(), "increasing")
        require(bool(np.isfinite(table).all()), "height", "not finite", "m, finite")
        require(angle[-1] - angle[0] <= _TURN, "angle", angle[-1], "within one turn of the first")

    @cached_property
    def _table(self) -> tuple[Array, Array, Array]:
        """Angles (n,), axial places (m,) and heights (n, m) as arrays."""
        height = np.asarray(self.height, dtype=float)
        z = np.asarray([0.0] if self.z is None else self.z, dtype=float)
        table = height[:, None] if height.ndim == 1 else height
        return np.asarray(self.angle, dtype=float), z, table

    def beyond(self, width: float) -> Iterator[tuple[str, float, str]]:
        """Fields that do not fit a bearing of `width`, m: none, points may lie past the ends."""
        yield from ()

    def added(self, angle: Array, z: Array, width: float) -> Array:
        """Growth of the gap at `angle` (n,) and `z` (m,) of a bearing of `width`, (n, m), m."""
        angles, places, table = self._table
        turned = angles[0] + (angle - angles[0]) % _TURN
        if angles[-1] < angles[0] + _TURN:
            angles = np.append(angles, angles[0] + _TURN)
            table = np.concatenate([table, table[:1]])
        around = on_lines(turned, angles, table)
        share = np.interp(z, places, np.arange(places.size))
        low = np.minimum(share.astype(int), places.size - 1)
        high = np.minimum(low + 1, places.size - 1)
        return (1 - share + low) * around[..., low] + (share - low) * around[..., high]

    def steps(self, width: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """Angles (rad) and axial places (m) at which the gap steps: none."""
        return (), ()

    @property
    def even_around(self) -> bool:
        """Whether the gap grows alike at all angles."""
        return False

    def symmetric(self, width: float) -> bool:
        """Whether both halves of the width are alike."""
        _, z, table = self._table
        return bool(np.array_equal(z, -z[::-1]) and np.array_equal(table, table[:, ::-1]))


Relief = Crown | Recess | Contour
