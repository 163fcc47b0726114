"""Blades of a rotor that stands: whether an oblique storm drives them [Bir and Jonkman 2007]."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

LEAST_SWING = 0.005
"""Effective swing of a tip over the radius from which blades swing by themselves; turbulence moves
those of DLC 6.1 by 1/220 at most (docs/rotor.md)."""

_SLOW, _WHILE = 2.0, 10.0  # s: longer than a period of an edge mode; a burst of its swing


def swing_of(tip: ArrayLike, step: float) -> float:
    """Largest effective value of a tip's fast motion within some ten seconds, m.

    Parameters
    ----------
    tip : array_like (n,)
        Deflection of the tip over time, m.
    step : float
        Time between its values, s.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rotor.standing import swing_of
    >>> time = np.arange(0.0, 60.0, 0.05)
    >>> round(swing_of(3.0 + 0.5 * np.sin(2 * np.pi * 1.1 * time), 0.05), 2)  # of 0.5 m / √2
    0.33
    """
    from scipy.ndimage import uniform_filter1d

    moved = np.asarray(tip, dtype=float)
    fast = moved - uniform_filter1d(moved, max(round(_SLOW / step), 1))
    power = uniform_filter1d(fast**2, max(round(_WHILE / step), 1))
    return float(np.sqrt(power.max()))
