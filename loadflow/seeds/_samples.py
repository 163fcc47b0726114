"""The one door for samples: finite, one-dimensional, not empty."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Floats = NDArray[np.float64]


def as_samples(samples: Iterable[ArrayLike], least: int = 1) -> list[Floats]:
    """Return the samples as float arrays, or say which one is unfit.

    Parameters
    ----------
    samples : iterable of array_like, shape (n_i,)
        One series per seed; lengths may differ.
    least : int
        Smallest allowed length of a sample.
    """
    arrays = [np.asarray(x, dtype=float) for x in samples]
    if not arrays:
        raise InputError("samples: got none; at least one is needed")
    for i, x in enumerate(arrays):
        if x.ndim != 1:
            raise InputError(f"sample {i} has shape {x.shape}; a one-dimensional series is needed")
        if x.size < least:
            raise InputError(f"sample {i} has {x.size} values; at least {least} are needed")
        finite = np.isfinite(x)
        if not finite.all():
            at = int(np.argmin(finite))
            raise InputError(f"sample {i} is {x[at]} at index {at}; all values must be finite")
    return arrays


def check_level(alpha: float) -> None:
    """Raise unless `alpha` is a level of significance."""
    if not 0.0 < alpha < 1.0:
        raise InputError(f"alpha = {alpha}; allowed: 0 < alpha < 1")


def sampling_step(dt: float | None, fs: float | None) -> float:
    """Time step in s from `dt` (s) or `fs` (Hz); exactly one of them is given."""
    if (dt is None) == (fs is None):
        raise InputError("give exactly one of dt (s) and fs (Hz)")
    name, value = ("dt", dt) if fs is None else ("fs", fs)
    if value is None or not (np.isfinite(value) and value > 0):
        raise InputError(f"{name} = {value}; allowed: {name} > 0")
    return float(value) if name == "dt" else 1.0 / float(value)
