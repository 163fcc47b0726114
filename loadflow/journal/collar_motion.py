"""A thrust collar that follows its load along the axis: implicit steps, many in one Newton."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_banded
from scipy.optimize.elementwise import find_root

from loadflow.journal.collar_sides import Carried, Side

Array = NDArray[np.float64]

FOLLOWED = 1e-8
"""Largest share of the force that may be missing in a step."""

_WINDOW = 2048  # steps that are solved at once, halved where Newton fails
_STEPS, _STEP = 12, 0.7  # Newton steps of them; largest change of ln(front film/back film)
_NUDGE = 1e-6  # of that logarithm, for slopes


@dataclass(frozen=True)
class CollarMotion:
    """A collar between two rows of pads under a load, its mass neglected.

    Attributes
    ----------
    time : array (n,)
        s, increasing.
    front, back : Side
        The rows through the series.
    loads : array (n,)
        Along the axis, N.
    play : float
        Of both films together, m.
    """

    time: Array
    front: Side
    back: Side
    loads: Array
    play: float
    weights: Array = field(init=False)
    """(3, n): velocity by the gap now, one step and two steps before, 1/s."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "weights", _backward(self.time))

    def followed(
        self, gap: Array, ends: tuple[Array, Array]
    ) -> tuple[Array, Array, Array, NDArray[np.int64]]:
        """Gaps of the front row, their rates, shares of the force missing, Newton steps.

        Parameters
        ----------
        gap : array (n,)
            Gaps at rest under each load, m; the path begins at the first.
        ends : pair of array (n,)
            Smallest and largest ln(front film/back film): there the surfaces touch.
        """
        place = np.clip(np.log(gap / (self.play - gap)), *ends)
        residual, steps = np.zeros(gap.size), np.zeros(gap.size, np.int64)
        waiting = [(k, min(k + _WINDOW, gap.size)) for k in range(1, gap.size, _WINDOW)][::-1]
        while waiting:
            first, last = waiting.pop()
            now = slice(first, last)
            found, left, count = self._window(now, place, ends)
            steps[now] += count
            if left.max() < FOLLOWED:
                place[now], residual[now] = found, left
            elif last - first > 1:
                middle = (first + last) // 2
                waiting += [(middle, last), (first, middle)]
            else:
                place[now], residual[now], more = self._single(first, place, ends)
                steps[now] += more
        gap = self._gap(place)
        return gap, self._rate(gap, slice(0, gap.size)), residual, steps

    # --- inside ----------------------------------------------------------------------------------
    def _gap(self, place: Array) -> Array:
        return np.asarray(self.play / (1.0 + np.exp(-place)))

    def _rate(self, gap: Array, now: slice) -> Array:
        """Velocities of the gaps `now`, of gaps (n,) from the first one on."""
        padded = np.concatenate([[0.0, 0.0], gap[: now.stop]])
        once, twice = padded[now.start + 1 : -1], padded[now.start : -2]
        a, b, c = self.weights[:, now]
        return np.asarray(a * gap[now] + b * once + c * twice)

    def _rows(self, place: Array, now: slice) -> tuple[Carried, Carried]:
        gap = self._gap(place)
        return self.front.at(gap, now), self.back.at(self.play - gap, now)

    def _window(
        self, now: slice, places: Array, ends: tuple[Array, Array]
    ) -> tuple[Array, Array, int]:
        """Places of some steps by Newton, the share of the force missing, steps."""
        places, low, high = places.copy(), ends[0][now], ends[1][now]
        # films that give way lag behind: the last place known is as good as that at rest
        if now.stop - now.start < _WINDOW:
            places[now] = np.clip(places[now.start - 1], low, high)
        for count in range(_STEPS + 1):
            place, gaps = places[now], self._gap(places)
            rate = self._rate(gaps, now)
            rows, moved = self._rows(place, now), self._rows(place + _NUDGE, now)
            missing, pressed, scale = self._missing(rows, rate, now)
            held = ((place <= low) & (missing > 0.0)) | ((place >= high) & (missing < 0.0))
            residual = np.where(held, 0.0, np.abs(missing) / scale)
            if residual.max() < FOLLOWED or count == _STEPS or residual.max() > 1e6:
                break
            bands = self._bands(rows, moved, pressed, rate, gaps[now], now)
            stays = held | (bands[0] == 0.0)  # no film carries, or surfaces touch
            bands[0, stays], bands[1, stays], bands[2, stays] = 1.0, 0.0, 0.0
            right = np.where(stays, 0.0, -missing)
            change = solve_banded((2, 0), _shifted(bands), right, check_finite=False)
            places[now] = np.clip(place + np.clip(change, -_STEP, _STEP), low, high)
        return places[now], residual, count

    def _missing(
        self, rows: tuple[Carried, Carried], rate: Array, now: slice
    ) -> tuple[Array, tuple[Array, Array], Array]:
        """Load that no film carries, what presses on each, and the scale of both, N."""
        front, back = rows
        pressed = front.force - front.damping * rate, back.force + back.damping * rate
        missing = self.loads[now] - np.maximum(pressed[0], 0.0) + np.maximum(pressed[1], 0.0)
        scale = np.maximum(np.maximum(front.force, back.force), np.abs(self.loads[now]))
        return missing, pressed, np.maximum(scale, 1e-9)

    def _bands(
        self,
        rows: tuple[Carried, Carried],
        moved: tuple[Carried, Carried],
        pressed: tuple[Array, Array],
        rate: Array,
        gap: Array,
        now: slice,
    ) -> Array:
        """Derivatives (3, m) of what is missing by the place now, one and two steps before."""
        active = [np.where(p > 0.0, 1.0, 0.0) for p in pressed]
        slopes = [
            ((b.force - a.force) - sign * (b.damping - a.damping) * rate) / _NUDGE
            for a, b, sign in zip(rows, moved, (1.0, -1.0))
        ]
        squeeze = active[0] * rows[0].damping + active[1] * rows[1].damping
        wider = np.concatenate([[0.0, 0.0], gap * (self.play - gap) / self.play])
        before = np.array([wider[2:], wider[1:-1], wider[:-2]])
        bands = squeeze * self.weights[:, now] * before
        bands[0] += active[1] * slopes[1] - active[0] * slopes[0]
        return np.asarray(bands)

    def _single(
        self, step: int, places: Array, ends: tuple[Array, Array]
    ) -> tuple[float, float, int]:
        """Place of one step between its ends: what is missing falls where the film is thinner."""
        now, places = slice(step, step + 1), places.copy()

        def missing(place: Array) -> Array:
            found = np.empty(place.size)
            for k, one in enumerate(np.ravel(place)):
                places[step] = one
                rate = self._rate(self._gap(places[: step + 1]), now)
                found[k] = self._missing(self._rows(places[now], now), rate, now)[0][0]
            return found.reshape(np.shape(place))

        low, high = np.array([ends[0][step]]), np.array([ends[1][step]])
        at_low, at_high = missing(low)[0], missing(high)[0]
        if at_low >= 0.0 or at_high <= 0.0:
            return float(low[0] if at_low >= 0.0 else high[0]), 0.0, 2
        found = find_root(missing, (low, high), tolerances={"xatol": 0.0, "xrtol": 1e-14})
        places[step] = found.x[0]
        rate = self._rate(self._gap(places[: step + 1]), now)
        left, _, scale = self._missing(self._rows(places[now], now), rate, now)
        return float(found.x[0]), float(np.abs(left[0]) / scale[0]), int(found.nit[0])


def _backward(times: Array) -> Array:
    """Weights (3, n) of differences of second order backward in time; the first is at rest."""
    weights, steps = np.zeros((3, times.size)), np.diff(times)
    if steps.size:
        weights[:2, 1] = 1.0 / steps[0], -1.0 / steps[0]
    if steps.size > 1:
        ratio, step = steps[1:] / steps[:-1], steps[1:]
        weights[0, 2:] = (1.0 + 2.0 * ratio) / (1.0 + ratio) / step
        weights[1, 2:] = -(1.0 + ratio) / step
        weights[2, 2:] = ratio**2 / (1.0 + ratio) / step
    return weights


def _shifted(bands: Array) -> Array:
    """Bands as `solve_banded` reads them: column k holds what the place k does to k, k+1, k+2."""
    found = np.zeros_like(bands)
    found[0], found[1, :-1], found[2, :-2] = bands[0], bands[1, 1:], bands[2, 2:]
    return found
