"""Gaussian noise in single precision, three times as fast as numpy makes it.

The wind of a load case takes some 10⁸ numbers; numpy asks for the bits of each by a call, here the
bits come in bulk and a compiled loop makes numbers of them, by the same rule.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

LAYERS = 256
EDGE = 3.6541528853610088
"""Where the tail of the normal density begins, of `LAYERS` layers of equal area."""

_BULK = 1 << 15


def layers() -> tuple[NDArray[np.uint32], NDArray[np.float32], NDArray[np.float32]]:
    """Layers of the normal density: largest number that is taken at once, scale, density at x.

    [Marsaglia and Tsang 2000], in single precision with 23 bits.

    Examples
    --------
    >>> from loadflow.wind.noise import layers
    >>> taken, scale, density = layers()
    >>> taken[255].item() / 2**23 > 0.94, density[0].item()
    (True, 1.0)
    """
    at_edge = math.exp(-0.5 * EDGE * EDGE)
    area = EDGE * at_edge + math.sqrt(math.pi / 2) * math.erfc(EDGE / math.sqrt(2))
    x, taken = np.zeros(LAYERS), np.zeros(LAYERS)
    x[-1] = EDGE
    for k in range(LAYERS - 2, 0, -1):
        x[k] = math.sqrt(-2 * math.log(area / x[k + 1] + math.exp(-0.5 * x[k + 1] ** 2)))
    density = np.exp(-0.5 * x * x)
    taken[2:] = x[1:-1] / x[2:]
    x[0] = area / at_edge
    taken[0] = EDGE / x[0]
    whole = 2.0**23
    return (
        np.rint(taken * whole).astype(np.uint32),
        (x / whole).astype(np.float32),
        density.astype(np.float32),
    )


_LAYERS = layers()


class NormalStream:
    """Standard normal numbers, those of `numpy.random.default_rng` of the seed.

    Of a million numbers, one of the tail differs in its last bit.

    Parameters
    ----------
    seed : numpy.random.SeedSequence
        Where the stream begins.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.wind.noise import NormalStream
    >>> ours = np.empty(4, np.float32)
    >>> NormalStream(np.random.SeedSequence(1)).fill(ours)
    >>> theirs = np.random.default_rng(1).standard_normal(4, dtype=np.float32)
    >>> np.array_equal(ours, theirs)
    True
    """

    def __init__(self, seed: np.random.SeedSequence) -> None:
        self._bits = np.random.PCG64(seed)
        self._bulk = np.empty(0, dtype=np.uint32)
        self._at = 0

    def fill(self, out: NDArray[np.float32]) -> None:
        """Fill an array (n,) with the next numbers."""
        from loadflow.wind._kernels import SPARE, draw_normals

        done = 0
        while done < out.size:
            if self._bulk.size - self._at <= SPARE:
                fresh = self._bits.random_raw(_BULK).astype("<u8", copy=False).view(np.uint32)
                self._bulk, self._at = np.concatenate([self._bulk[self._at :], fresh]), 0
            self._at, count = draw_normals(self._bulk, self._at, out[done:], *_LAYERS, EDGE)
            done += count
