"""Half-speed whirl of a shaft in its film.

A film that nowhere ruptures carries no load where it turns at half the speed of the shaft, and a
shaft without mass goes round in it for ever on a closed orbit, wherever it began (Booker 1965,
J. Basic Eng. 87, 537-546). What ends this is a film that ruptures for part of a turn, or what no
film has: the smoothing of its cells. So the finer the cells, the longer it lasts.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

HALF = 0.05
"""How near the speed of whirl over that of the shaft is to a half.

Shafts either whirl or come to rest: of those of tests/journal/motion/test_whirl.py in films at 1 to
5 bar, the median is 0.496 to 0.498 or 0.00 to 0.01, so that it hardly matters how near.
"""

FORGOTTEN = 6
"""Turns of a shaft after which it lies in its films as they have it, wherever it began.

Of the shafts of tests/journal/motion/test_whirl.py, begun at 0.97 and at 0.5 of the clearance, 90°
apart: 1.2 MN at 1 bar and 3 MN at 5 bar lie within 2e-5 of the clearance of each other by then,
1.2 MN at 2 bar within 6 %. What still whirls by then, as at 0.4 MN, lasts: they are 0.9 of it
apart.
"""


def whirling(samples: xr.Dataset) -> NDArray[np.bool_]:
    """Samples (n,) of a path about which the shaft whirls at half its speed, for a long time.

    That is the mean over a turn of the shaft before and one after them, or what there is of these,
    if it is a turn. As it lifts off it goes round so for a few turns, whatever damps it.

    Parameters
    ----------
    samples : xarray.Dataset
        ``time``, s, ``speed``, rad/s, and ``eccentricity``, m, over ``sample``.
    """
    time, speed = samples["time"].values, samples["speed"].values
    down, left = samples["eccentricity"].values.T
    places = down + 1j * left
    moved = np.nan_to_num(np.angle(places[1:] * places[:-1].conj()))
    turned = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time)
    angle, shaft = (np.append(0.0, np.cumsum(steps)) for steps in (moved, turned))
    length = np.append(0.0, np.cumsum(np.abs(turned)))
    begin = np.searchsorted(length, np.maximum(length - 2.0 * np.pi, 0.0), "right") - 1
    end = np.minimum(np.searchsorted(length, length + 2.0 * np.pi), length.size - 1)
    whole = length[end] - length[begin] >= 2.0 * np.pi
    spun = np.where(whole, shaft[end] - shaft[begin], np.inf)
    ratio = (angle[end] - angle[begin]) / np.where(spun == 0.0, np.inf, spun)
    return _lasting(np.abs(ratio - 0.5) < HALF, length)


def _lasting(whirls: NDArray[np.bool_], length: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Of samples (n,) those that go on for `FORGOTTEN` turns, by the `length` turned, rad."""
    ends = np.flatnonzero(np.diff(whirls, prepend=False, append=False)).reshape(-1, 2)
    kept = np.zeros_like(whirls)
    for begin, end in ends:
        kept[begin:end] = length[end - 1] - length[begin] >= 2.0 * np.pi * FORGOTTEN
    return kept
