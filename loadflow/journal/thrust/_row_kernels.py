"""Compiled look-ups in the table of a row of pads: cubics of the gap, polynomials of the tilt.

A part of a table is cubics (intervals, 4, tilts, waves) of the logarithm of the gap, highest power
first; `frame` holds the numbers below. Nothing allocates: work arrays are handed in.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.linked import LINKED, bare

Array = NDArray[np.float64]

LOG, STEP, OUTER, MIDDLE, MOST, PADS, FIRST = range(7)
"""Of a frame: logarithm of the thinnest gap and its step from node to node, outer and middle
radius, largest tilt, pads, and the angle of the middle of the first one."""

_loop = bare(cache=True)
_inner = bare(**LINKED)


@_inner
def polynomials(frame, gap, slope, tilts, powers):
    """Fill `powers` (2, tilts): Chebyshev polynomials of the tilt, and their slopes by the gap."""
    powers[0, 0], powers[1, 0] = 1.0, 0.0
    if tilts == 1:
        return
    share = slope * frame[OUTER] / gap
    most = frame[MOST]
    scale = -2.0 / math.log1p(-most)
    if share < most:
        rate = -scale * share / ((1.0 - share) * gap)
    else:
        share, rate = most, 0.0
    place = -scale * math.log1p(-share) - 1.0
    powers[0, 1], powers[1, 1] = place, rate
    for j in range(2, tilts):
        powers[0, j] = 2.0 * place * powers[0, j - 1] - powers[0, j - 2]
        powers[1, j] = 2.0 * (rate * powers[0, j - 1] + place * powers[1, j - 1]) - powers[1, j - 2]


@_inner
def interval(frame, log_gap, intervals):
    """Interval of a gap, the last ones reaching on for ever, and its place there."""
    at = int((log_gap - frame[LOG]) / frame[STEP])  # below the table, too: in the first one
    at = min(max(at, 0), intervals - 1)
    return at, log_gap - frame[LOG] - at * frame[STEP]


@_inner
def summed(part, at, x, powers, cosine, sine):
    """A sum over the pads, its slopes by the logarithm of the gap and by the gap through tilt."""
    value, by_log, by_tilt = 0.0, 0.0, 0.0
    for j in range(part.shape[2]):
        here, steep = 0.0, 0.0
        for b in range(part.shape[3]):
            weight = 1.0 if b == 0 else (cosine if b == 1 else sine)
            c0, c1 = part[at, 0, j, b], part[at, 1, j, b]
            c2, c3 = part[at, 2, j, b], part[at, 3, j, b]
            here += weight * (((c0 * x + c1) * x + c2) * x + c3)
            steep += weight * ((3.0 * c0 * x + 2.0 * c1) * x + c2)
        value += powers[0, j] * here
        by_log += powers[0, j] * steep
        by_tilt += powers[1, j] * here
    return value, by_log, by_tilt


@_loop
def fill_sums(parts, frame, gap, slope, direction, powers, found):
    """Fill `found` (sums, n) with sums over the pads, as the table has them."""
    rows, intervals = parts.shape[0], parts.shape[1]
    for n in range(gap.size):
        polynomials(frame, gap[n], slope[n], parts.shape[3], powers)
        at, x = interval(frame, math.log(gap[n]), intervals)
        turns = frame[PADS] * (direction[n] - frame[FIRST])
        cosine, sine = math.cos(turns), math.sin(turns)
        for q in range(rows):
            found[q, n] = summed(parts[q], at, x, powers, cosine, sine)[0]


@_loop
def fill_pads(part, frame, gap, slope, angle, powers, waves, local, found):
    """Fill `local` and `found` (n, pads): film in the middle of each, m, and a value of it.

    `angle` (n, pads) is that of their middles from where the gap grows most.
    """
    intervals, tilts, count = part.shape[0], part.shape[2], part.shape[3]
    for n in range(gap.size):
        polynomials(frame, gap[n], slope[n], tilts, powers)
        at, x = interval(frame, math.log(gap[n]), intervals)
        for b in range(count):
            waves[b] = 0.0
            for j in range(tilts):
                here = (part[at, 0, j, b] * x + part[at, 1, j, b]) * x + part[at, 2, j, b]
                waves[b] += powers[0, j] * (here * x + part[at, 3, j, b])
        share = min(slope[n] * frame[OUTER] / gap[n], frame[MOST]) * frame[MIDDLE] / frame[OUTER]
        for p in range(angle.shape[1]):
            c, s = math.cos(angle[n, p]), math.sin(angle[n, p])
            local[n, p] = gap[n] * (1.0 + share * c)
            value, wave_c, wave_s = waves[0], 1.0, 0.0
            for b in range(1, count, 2):
                wave_c, wave_s = wave_c * c - wave_s * s, wave_s * c + wave_c * s
                value += waves[b] * wave_c + waves[b + 1] * wave_s
            found[n, p] = value


@_loop
def fill_lands(gap, slope, angle, depth, across, radii, found):
    """Fill `found` (n,) with least films over lands of a `depth` at angles `across` from middles.

    `angle` (n, pads) is that of the middles, `radii` the two edges.
    """
    for n in range(gap.size):
        least = np.inf
        for p in range(angle.shape[1]):
            c, s = math.cos(angle[n, p]), math.sin(angle[n, p])
            for k in range(depth.size):
                along = slope[n] * (c * across[0, k] - s * across[1, k])
                radius = radii[0] if along > 0.0 else radii[1]
                least = min(least, depth[k] + radius * along)
        found[n] = gap[n] + least
