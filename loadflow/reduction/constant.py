"""Stationary design loads: one speed and one force (section 4.3.1 of [Jonuschies 2015])."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.reduction._series import Floats, check_series


@dataclass(frozen=True)
class StationaryLoad:
    """A constant speed and force.

    Attributes
    ----------
    name : str
        What it is.
    speed : float
        rad/s.
    force : ndarray, shape (2,)
        N.
    index : int or None
        Place in the series, if speed and force occur together there.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import StationaryLoad
    >>> StationaryLoad("rated", 1.25, np.array([3e6, 4e6])).resultant
    5000000.0
    """

    name: str
    speed: float
    force: Floats
    index: int | None = None

    @property
    def resultant(self) -> float:
        """Magnitude of the force in N."""
        return float(np.hypot(*self.force))


@dataclass(frozen=True)
class StationaryLoads:
    """Stationary loads of one series.

    Attributes
    ----------
    maximum : StationaryLoad
        Largest force with the lowest speed, which need not occur together.
    mean : StationaryLoad
        Mean force vector with the mean speed.
    envelope : tuple of StationaryLoad
        Moments of the series at which something is extreme, with what occurs then.

    Examples
    --------
    >>> from loadflow.reduction import stationary
    >>> loads = stationary([1.0, 1.2, 1.1], [[2e6, 0], [3e6, 4e6], [1e6, 0]])
    >>> round(loads.mean.speed, 3)
    1.1
    """

    maximum: StationaryLoad
    mean: StationaryLoad
    envelope: tuple[StationaryLoad, ...]

    def __getitem__(self, name: str) -> StationaryLoad:
        """Return the load of that name."""
        return {load.name: load for load in (self.maximum, self.mean, *self.envelope)}[name]


def stationary(
    speed: ArrayLike, force: ArrayLike, time: ArrayLike | None = None
) -> StationaryLoads:
    """Return the stationary design loads of a series.

    Kept for comparison: [Jonuschies 2015] shows that largest force with lowest speed over-rates
    and mean with mean under-rates a bearing. The envelope gives moments that really occur.

    Parameters
    ----------
    speed : array_like, shape (n,)
        rad/s; lowest and highest are meant without sign.
    force : array_like, shape (n, 2)
        N.
    time : array_like, shape (n,), optional
        s; only checked.

    Returns
    -------
    StationaryLoads

    Raises
    ------
    InputError
        Shapes do not match or a value is not finite.

    Examples
    --------
    >>> loads = stationary([1.0, 1.2, 1.1], [[2e6, 0], [3e6, 4e6], [1e6, 0]])
    >>> loads.maximum.speed, loads.maximum.resultant, loads["largest force"].speed
    (1.0, 5000000.0, 1.2)
    """
    n, f, _ = check_series(speed, force, time)
    pace, resultant = np.abs(n), np.hypot(f[:, 0], f[:, 1])
    still = pace == 0.0
    severity = np.where(still, np.inf, resultant / np.where(still, 1.0, pace))
    places = {
        "largest force": np.argmax(resultant),
        "smallest force": np.argmin(resultant),
        "lowest speed": np.argmin(pace),
        "highest speed": np.argmax(pace),
        "largest force over speed": np.argmax(severity),
        "largest first component": np.argmax(f[:, 0]),
        "smallest first component": np.argmin(f[:, 0]),
        "largest second component": np.argmax(f[:, 1]),
        "smallest second component": np.argmin(f[:, 1]),
    }
    slowest, strongest = int(places["lowest speed"]), int(places["largest force"])
    return StationaryLoads(
        maximum=StationaryLoad("largest force, lowest speed", float(n[slowest]), f[strongest]),
        mean=StationaryLoad("mean force, mean speed", float(n.mean()), f.mean(axis=0)),
        envelope=tuple(
            StationaryLoad(name, float(n[i]), f[i], int(i)) for name, i in places.items()
        ),
    )
