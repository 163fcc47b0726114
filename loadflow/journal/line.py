"""What is given of the shaft where it runs through a bearing: its moment, tilt and bend."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Line:
    """What is given of the shaft's centre line, one row for each load.

    Attributes
    ----------
    moment : array (n, 2) or None
        N m; the shaft then tilts freely under it.
    tilt : array (n, 2) or None
        Rotation about the first and the second axis, rad, held.
    bend : array (n, 2) or None
        Curvature of the centre line, 1/m.
    whirl : float
        Frequency at which it vibrates, rad/s: tilting pads are condensed out of stiffness and
        damping at it.
    near : array (n, 2 + pads) or None
        Where shafts on tilting pads are looked for first: eccentricity, clearances, and rotation of
        the pads over ψ; NaN where nothing is known.
    searches : array (n,) of `loadflow.journal.solvers.search.Search` or None
        What was found and spent before where the same loads are asked again, as at temperatures.
    """

    moment: Array | None = None
    tilt: Array | None = None
    bend: Array | None = None
    whirl: float = 0.0
    near: Array | None = None
    searches: NDArray[np.object_] | None = None

    @classmethod
    def of(cls, shape: tuple[int, ...], whirl: float = 0.0, **given: ArrayLike | None) -> Line:
        """Broadcast what is given to loads of `shape`.

        Raises
        ------
        loadflow.errors.InputError
            Misshapen or not finite values, moment and tilt together.
        """
        rows: dict[str, Any] = {name: _rows(name, value, shape) for name, value in given.items()}
        line = cls(**rows, whirl=whirl)
        if line.moment is not None and line.tilt is not None:
            raise InputError("moment and tilt are both given: one follows from the other")
        return line

    def at(self, places: NDArray[np.int64]) -> Line:
        """The same for the loads at `places` (m,) alone."""
        moment, tilt, bend, near = (
            None if rows is None else rows[places]
            for rows in (self.moment, self.tilt, self.bend, self.near)
        )
        searches = None if self.searches is None else self.searches[places]
        return Line(moment, tilt, bend, self.whirl, near, searches)

    def start(self, index: int) -> Array | None:
        """Where the shaft under load number `index` is looked for first, if that is known."""
        known = self.near is not None and bool(np.isfinite(self.near[index]).all())
        return self.near[index] if known and self.near is not None else None

    @property
    def straight(self) -> bool:
        """Whether the shaft stays aligned and straight."""
        return self.moment is None and self.tilt is None and self.bend is None


def _rows(name: str, value: ArrayLike | None, shape: tuple[int, ...]) -> Array | None:
    if value is None:
        return None
    values = np.asarray(value, dtype=float)
    bad = np.argwhere(~np.isfinite(values))
    if bad.size:
        raise InputError(f"{name}{bad[0].tolist()} = {values[tuple(bad[0])]}: must be finite")
    try:
        return np.broadcast_to(values, (*shape, 2)).reshape(-1, 2)
    except ValueError as error:
        raise InputError(
            f"{name} {values.shape} does not broadcast with the loads {(*shape, 2)}"
        ) from error
