"""Table of the induced velocities over inflow angle and pitch: the cheapest rung.

At given geometry the induction of a section depends on the ratio of the two wind components and on
the pitch alone, so a table over both replaces the solver; what is left is the error of linear
interpolation. Outside the table the section is solved. It is the same for all machines that differ
in what moves or lags alone, and is filled once for these.
"""

from __future__ import annotations

from collections import OrderedDict

import numpy as np
from numpy.typing import NDArray

from .machine import Machine

_ANGLES = np.radians(np.arange(-20.0, 80.25, 0.5))
_PITCHES = np.radians(np.arange(-6.0, 34.5, 1.0))

GOVERNED_BY = (
    "blades", "tip_radius", "hub_radius", "radius", "chord", "twist", "lift", "drag",
    "drag_in_induction",
)  # fmt: skip
"""All that the induction of a section reads of a machine."""

_KEPT = 4
_filled: OrderedDict[tuple[bytes, ...], NDArray[np.float64]] = OrderedDict()


def with_table(m: Machine) -> Machine:
    """The machine with its table filled; the table is shared, and read only."""
    key = tuple(np.asarray(getattr(m, name)).tobytes() for name in GOVERNED_BY)
    if key not in _filled:
        _filled[key] = _table(m)
        if len(_filled) > _KEPT:
            _filled.popitem(last=False)
    _filled.move_to_end(key)
    return m._replace(
        table=_filled[key],
        table_angle=(float(_ANGLES[0]), float(_ANGLES[1] - _ANGLES[0])),
        table_pitch=(float(_PITCHES[0]), float(_PITCHES[1] - _PITCHES[0])),
    )


def _table(m: Machine) -> NDArray[np.float64]:
    from ._kernels import fill_table

    table = np.zeros((m.radius.size, _ANGLES.size, _PITCHES.size, 2))
    fill_table(m, _ANGLES, _PITCHES, table)
    return table
