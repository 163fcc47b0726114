"""What one tilting pad carries without moment, and how it then tilts, by one parabola across.

The film of a pad that tilts freely presses toward its pivot alone, and how hard depends on the gap
over the pivot alone. So one curve over that gap stands for all pads of a bearing, and all loads.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_NODES = 49  # along a pad
_THINNEST, _THIN, _BESIDE = 1e-4, 40, 40  # smallest gap, in clearances; gaps of the curve
_NARROW, _STRAIGHTER = 0.3, 0.8  # gap from which they are even; how far beyond a straight film
_SHARES = np.append(np.geomspace(1e-3, 0.2, 10), np.linspace(0.25, 0.99, 16))
_STEEPEST = 0.9999  # of the tilt at which the end of a pad meets the shaft
_BISECTIONS = 10  # of the tilt


@dataclass(frozen=True)
class PadCurve:
    """Pads of one form: what they carry and how they tilt.

    Attributes
    ----------
    gaps : array (n,)
        Over the pivot of the flat pad, clearances, increasing; wider ones hold no pad.
    forces : array (n,)
        Toward the pivot, over η ω B R/ψ².
    lifts : array (n,)
        Tilt against the shaft, clearances.
    """

    gaps: Array
    forces: Array
    lifts: Array

    @property
    def widest(self) -> float:
        """Widest gap at which a film holds a pad; 0 if none does."""
        return float(self.gaps[-1]) if self.gaps.size else 0.0

    def holds(self, gap: Array) -> NDArray[np.bool_]:
        """Whether a film holds a pad at each `gap` (k,)."""
        return np.asarray(gap <= self.widest)

    def force(self, gap: Array) -> tuple[Array, Array]:
        """Force at each `gap` (k,), and how fast it falls as the gap widens, ≥ 0."""
        if not self.gaps.size:
            return np.zeros_like(gap), np.zeros_like(gap)
        x, y = np.log(self.gaps), np.log(self.forces)
        at = np.log(np.maximum(gap, self.gaps[0]))
        force = np.where(self.holds(gap), np.exp(np.interp(at, x, y)), 0.0)
        part = np.clip(np.searchsorted(x, at), 1, x.size - 1)
        slope = (y[part] - y[part - 1]) / (x[part] - x[part - 1])
        return force, np.maximum(-slope * force / np.exp(at), 0.0)

    def lift(self, gap: Array) -> Array:
        """Tilt at each `gap` (k,); 0 where none holds the pad."""
        if not self.gaps.size:
            return np.zeros_like(gap)
        return np.asarray(np.interp(gap, self.gaps, self.lifts, right=0.0))


@lru_cache(maxsize=64)
def pad_curve(preload: float, before: float, after: float, half_width: float) -> PadCurve:
    """Curve of a pad that reaches from an angle `before` its pivot to one `after` it, rad.

    The pressure is a parabola across, and its weighted balance [Galerkin 1915] around that
    (H³ P')' − 5/(2 b²) H³ P = 15/2 H', without what is negative. Of two tilts without moment the
    larger is stable.

    Parameters
    ----------
    preload : float
        1 − assembled over machined clearance.
    before, after : float
        Along the rotation, rad.
    half_width : float
        b = B/(2 R).

    Examples
    --------
    >>> curve = pad_curve(0.2, 0.5, 0.5, 1.0)
    >>> bool((curve.forces[0] > curve.forces[10]) & (curve.lifts[10] > 0))
    True
    """
    wide = 1.0 / (1.0 - preload)
    gaps = np.append(
        np.geomspace(_THINNEST, _NARROW, _THIN, endpoint=False),
        np.linspace(_NARROW, wide + _STRAIGHTER, _BESIDE),
    )
    angle = np.linspace(-before, after, _NODES)
    step, cos, sin = angle[1] - angle[0], np.cos(angle), np.sin(angle)
    base = wide - np.outer(cos, wide - gaps)  # gap of the flat pad, (nodes, gaps)
    most = (base[sin > 1e-9].T / sin[sin > 1e-9]).min(axis=1)

    def pressures(lift: Array) -> Array:
        """At tilts (…, gaps), (nodes, …, gaps)."""
        fall = np.multiply.outer(sin, lift)
        flat = base.reshape(_NODES, *(1,) * (lift.ndim - 1), gaps.size)
        return _parabola(flat - fall, step, half_width)

    moments = np.tensordot(sin, pressures(_SHARES[:, None] * most), 1)
    upstream = moments < 0.0
    last = _SHARES.size - 1 - np.argmax(upstream[::-1], axis=0)  # tilt from which it turns on
    low = _SHARES[last] * most
    high = np.append(_SHARES, _STEEPEST)[last + 1] * most
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        flat = sin @ pressures(middle) < 0.0
        low, high = np.where(flat, middle, low), np.where(flat, high, middle)
    lifts = 0.5 * (low + high)
    forces = 2.0 / 3.0 * step * (cos @ pressures(lifts))
    holds = upstream.any(axis=0) & (forces > 0.0)
    count = gaps.size if holds.all() else int(np.argmin(holds))
    return PadCurve(gaps[:count], forces[:count], lifts[:count])


def _parabola(height: Array, step: float, half_width: float) -> Array:
    """Pressure (n, …) in mid-plane of gaps `height` (n, …), its negative part cut off."""
    face = (0.5 * (height[1:] + height[:-1])) ** 3 / step**2
    right = 7.5 * (height[:-2] - height[2:]) / (2.0 * step)
    main = face[1:] + face[:-1] + 2.5 / half_width**2 * height[1:-1] ** 3
    count = len(main)
    for node in range(count):  # Thomas' algorithm for all gaps at once
        if node:
            main[node] -= face[node] * main[node - 1]
            right[node] += face[node] * right[node - 1]
        right[node] /= main[node]
        main[node] = face[node + 1] / main[node]  # from here on the share of the next pressure
    pressure = np.zeros_like(height)
    for node in range(count, 0, -1):
        pressure[node] = right[node - 1] + main[node - 1] * pressure[node + 1]
    return np.maximum(pressure, 0.0)
