"""The one door for load series: speed (n,), force (n, 2), time (n,)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Floats = NDArray[np.float64]


def finite(name: str, values: ArrayLike) -> Floats:
    """Return `values` as floats; raise with name and index if one is not finite."""
    x = np.asarray(values, dtype=float)
    if not np.isfinite(x).all():
        at = tuple(int(i) for i in np.argwhere(~np.isfinite(x))[0])
        raise InputError(f"{name} is {x[at]} at index {at}; all values must be finite")
    return x


def check_series(
    speed: ArrayLike, force: ArrayLike, time: ArrayLike | None = None
) -> tuple[Floats, Floats, Floats | None]:
    """Return speed (n,), force (n, 2) and time (n,), or say what is wrong with them."""
    n, f = finite("speed", speed), finite("force", force)
    if n.ndim != 1 or n.size == 0:
        raise InputError(f"speed has shape {n.shape}; (n,) with n >= 1 is needed")
    if f.shape != (n.size, 2):
        raise InputError(f"force has shape {f.shape}; ({n.size}, 2) is needed, as speed has")
    if time is None:
        return n, f, None
    t = finite("time", time)
    if t.shape != n.shape:
        raise InputError(f"time has shape {t.shape}; {n.shape} is needed, as speed has")
    falls = np.flatnonzero(np.diff(t) <= 0)
    if falls.size:
        raise InputError(f"time does not rise after index {int(falls[0])}")
    return n, f, t
