"""Table of the induced velocities over inflow angle and pitch: the cheapest rung.

At given geometry the induction of a section depends on the ratio of the two wind components and on
the pitch alone, so a table over both replaces the solver; what is left is the error of linear
interpolation. Outside the table the section is solved.
"""

from __future__ import annotations

import numpy as np

from .machine import Machine

_ANGLES = np.radians(np.arange(-20.0, 80.25, 0.5))
_PITCHES = np.radians(np.arange(-6.0, 34.5, 1.0))


def with_table(m: Machine) -> Machine:
    """The machine with its table filled."""
    from ._kernels import fill_table

    table = np.zeros((m.radius.size, _ANGLES.size, _PITCHES.size, 2))
    fill_table(m, _ANGLES, _PITCHES, table)
    return m._replace(
        table=table,
        table_angle=(float(_ANGLES[0]), float(_ANGLES[1] - _ANGLES[0])),
        table_pitch=(float(_PITCHES[0]), float(_PITCHES[1] - _PITCHES[0])),
    )
