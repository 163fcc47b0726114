"""Table of the induced velocities over inflow angle and pitch: the cheapest rung.

At given geometry the induction of a section depends on the ratio of the two wind components and on
the pitch alone, so a table over both replaces the solver; what is left is the error of linear
interpolation. Outside the table the section is solved.
"""

from __future__ import annotations

import hashlib

import numpy as np

from .machine import Machine

_ANGLES = np.radians(np.arange(-20.0, 80.25, 0.5))
_PITCHES = np.radians(np.arange(-6.0, 34.5, 1.0))


_ON = ("radius", "chord", "twist", "lift", "drag")
_AND = ("blades", "tip_radius", "hub_radius", "drag_in_induction")
"""What the induction of a section is a function of, beside the flow."""

_KEPT = 8
_tables: dict[bytes, np.ndarray] = {}  # the latest ones: a run asks for the same rotor many times


def with_table(m: Machine) -> Machine:
    """The machine with its table filled; the tables of the latest rotors are kept."""
    key = _fingerprint(m)
    table = _tables.pop(key, None)
    if table is None:
        table = _filled(m)
    _tables[key] = table
    for old in list(_tables)[:-_KEPT]:
        _tables.pop(old, None)
    return m._replace(
        table=table,
        table_angle=(float(_ANGLES[0]), float(_ANGLES[1] - _ANGLES[0])),
        table_pitch=(float(_PITCHES[0]), float(_PITCHES[1] - _PITCHES[0])),
    )


def _filled(m: Machine) -> np.ndarray:
    from ._kernels import fill_table

    table = np.zeros((m.radius.size, _ANGLES.size, _PITCHES.size, 2))
    fill_table(m, _ANGLES, _PITCHES, table)
    return table


def _fingerprint(m: Machine) -> bytes:
    found = hashlib.sha256(repr([getattr(m, name) for name in _AND]).encode())
    for name in _ON:
        values = np.ascontiguousarray(getattr(m, name))
        found.update(repr(values.shape).encode() + values.tobytes())
    return found.digest()
