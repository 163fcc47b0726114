"""Speeds in a roller bearing: ideal rolling, and the sliding and mean speeds of each contact.

Plain expressions for floats or arrays. Signs: all speeds turn about the bearing axis in one sense,
`spin` is that of a roller against the cage, positive if the inner ring overtakes the cage (the
roller itself then turns the other way). Equation numbers are those of von Hollen 2013.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Value = float | NDArray[np.float64]


class IdealSpeeds(NamedTuple):
    """Speeds of a bearing without slip, rad/s."""

    cage: Value
    spin: Value

    @property
    def roller(self) -> Value:
        """Absolute spin of a roller, in its own sense: spin less cage speed, (4.50)."""
        return self.spin - self.cage


class ContactSpeeds(NamedTuple):
    """Speeds of the surfaces in the two contacts of a roller, m/s.

    `sliding` is the ring's less the roller's surface speed, `mean` their mean, both seen from the
    contact.
    """

    sliding_inner: Value
    sliding_outer: Value
    mean_inner: Value
    mean_outer: Value


def ideal_speeds(
    inner_speed: Value, outer_speed: Value, inner_diameter: float, outer_diameter: float
) -> IdealSpeeds:
    """Speeds without slip for any two ring speeds, (4.50)–(4.52), (4.57)–(4.60).

    Parameters
    ----------
    inner_speed, outer_speed : float or ndarray
        Speeds of the rings, rad/s.
    inner_diameter, outer_diameter : float
        Raceway diameters d and D at the contact, m.

    Examples
    --------
    A main bearing NU2208 whose inner ring turns at 1 rad/s:

    >>> speeds = ideal_speeds(1.0, 0.0, 49.5e-3, 71.5e-3)
    >>> round(speeds.cage, 6), round(speeds.spin, 6), round(speeds.roller, 6)
    (0.409091, 2.659091, 2.25)
    """
    d, big = inner_diameter, outer_diameter
    cage = (d * inner_speed + big * outer_speed) / (big + d)
    spin = 2.0 * d * big / ((big + d) * (big - d)) * (inner_speed - outer_speed)
    return IdealSpeeds(cage, spin)


def contact_speeds(
    inner_speed: Value,
    outer_speed: Value,
    cage_speed: Value,
    spin: Value,
    inner_diameter: float,
    outer_diameter: float,
) -> ContactSpeeds:
    """Sliding and mean speeds of both contacts for any spin, (5.69)–(5.84).

    For a driving outer ring von Hollen counts all of them, and the spin, the other way round.

    Parameters
    ----------
    inner_speed, outer_speed, cage_speed : float or ndarray
        rad/s.
    spin : float or ndarray
        Spin of the roller against the cage, rad/s.
    inner_diameter, outer_diameter : float
        Raceway diameters, m; the roller's is half their difference.
    """
    inner = inner_diameter / 2.0 * (inner_speed - cage_speed)
    outer = outer_diameter / 2.0 * (cage_speed - outer_speed)
    roller = (outer_diameter - inner_diameter) / 4.0 * spin
    return ContactSpeeds(
        inner - roller, outer - roller, (inner + roller) / 2.0, (outer + roller) / 2.0
    )


def entrainment_speed(
    inner_speed: Value, outer_speed: Value, pitch_diameter: float, gamma: float
) -> Value:
    """Mean surface speed of ideal rolling in both contacts, |ω_i - ω_o| D_pw (1 - γ²)/4, m/s.

    Parameters
    ----------
    inner_speed, outer_speed : float or ndarray
        rad/s.
    pitch_diameter : float
        m.
    gamma : float
        D_w cos α/D_pw.
    """
    return np.abs(inner_speed - outer_speed) * pitch_diameter * (1.0 - gamma * gamma) / 4.0


def common_period(
    inner_diameter: float, outer_diameter: float, four_stroke: bool = False
) -> tuple[int, int]:
    """Turns of the inner ring and of the cage until both stand as before, (5.9), outer at rest.

    Diameters are taken as whole micrometres. For a driving outer ring exchange the diameters. The
    gas force of a four-stroke engine repeats after two turns, so that their number must be even.

    Examples
    --------
    >>> common_period(49.5e-3, 71.5e-3), common_period(63e-3, 48e-3)
    ((22, 9), (37, 21))
    >>> common_period(63e-3, 48e-3, four_stroke=True)
    (74, 42)
    """
    from fractions import Fraction

    small, big = round(inner_diameter * 1e6), round(outer_diameter * 1e6)
    ratio = Fraction(small, small + big)
    times = 2 if four_stroke and ratio.denominator % 2 else 1
    return times * ratio.denominator, times * ratio.numerator
