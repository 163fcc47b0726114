"""Which frequencies move the shaft: bounds that the bearing sets, not the load (4.23–4.27)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError, SolverError
from loadflow.reduction._series import Floats, finite

Response = Callable[[Floats, Floats, float], float]

TRIAL_FREQUENCIES = (3.0, 2.0, 1.5, 1.0, 1 / 2, 1 / 3, 1 / 4, 1 / 5, 1 / 10, 1 / 20, 1 / 40)  # Hz


@dataclass(frozen=True)
class FrequencyBounds:
    """Bounds between slow, squeezing and unfelt loads.

    Attributes
    ----------
    low : float
        Hz; slower loads are carried with no help from squeeze (UFG).
    high : float
        Hz; faster loads do not move the shaft (OFG).
    frequency : ndarray, shape (k,)
        Trial frequencies, falling.
    eccentricity : ndarray, shape (k,)
        Largest eccentricity ratio per period at each of them.
    bracketed : bool
        Whether both bounds lie within the trial frequencies; if not, the missing one is the last
        trial frequency on its side.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.reduction import FrequencyBounds
    >>> bounds = FrequencyBounds(0.1, 1.0, np.array([1.0, 0.1]), np.array([0.6, 0.66]), True)
    >>> bounds.rise.round(2).tolist()
    [0.1]
    """

    low: float
    high: float
    frequency: Floats
    eccentricity: Floats
    bracketed: bool

    @property
    def rise(self) -> Floats:
        """Relative rise of the eccentricity from each trial frequency to the next lower one."""
        return np.diff(self.eccentricity) / self.eccentricity[:-1]


def frequency_bounds(
    response: Response,
    mean: ArrayLike,
    amplitude: ArrayLike,
    frequencies: Sequence[float] = TRIAL_FREQUENCIES,
    threshold: float = 0.01,
) -> FrequencyBounds:
    """Find the frequency bounds of a bearing for a mean load and a typical amplitude.

    Going down in frequency, the upper bound is where the rise of the largest eccentricity from one
    trial frequency to the next first exceeds the threshold (4.26), the lower bound where it then
    falls below it again (4.24).

    Parameters
    ----------
    response : callable
        ``response(mean, amplitude, frequency)`` returns the largest eccentricity ratio per period
        under the force mean + amplitude · sin(2π frequency · t).
    mean, amplitude : array_like, shape (2,)
        N.
    frequencies : sequence of float
        Trial frequencies in Hz, falling.
    threshold : float
        Relative rise per step.

    Returns
    -------
    FrequencyBounds

    Raises
    ------
    InputError
        Frequencies do not fall or are not positive; a force is not finite.
    SolverError
        The response is not finite and positive.

    Examples
    --------
    >>> from loadflow.reduction import frequency_bounds
    >>> def response(mean, amplitude, frequency):  # a bearing that squeeze helps above 0.3 Hz
    ...     return 0.6 + 0.1 / (1.0 + (frequency / 0.3) ** 4)
    >>> found = frequency_bounds(response, mean=(2e6, 0.0), amplitude=(3e5, 0.0))
    >>> found.low < found.high
    True
    """
    f = finite("frequencies", frequencies)
    if f.ndim != 1 or f.size < 3 or np.any(np.diff(f) >= 0) or f[-1] <= 0:
        raise InputError(f"frequencies = {f.tolist()}; they must fall, at least three, all > 0")
    if not threshold > 0:
        raise InputError(f"threshold = {threshold}; allowed: threshold > 0")
    steady, swing = finite("mean", mean), finite("amplitude", amplitude)
    e = np.array([float(response(steady, swing, float(trial))) for trial in f])
    bad = np.flatnonzero(~(np.isfinite(e) & (e > 0)))
    if bad.size:
        raise SolverError(f"response at {f[bad[0]]:g} Hz is {e[bad[0]]}; it must be > 0")
    rise = np.diff(e) / e[:-1]
    above = np.flatnonzero(rise > threshold)
    if above.size == 0:  # no trial frequency moves the shaft
        return FrequencyBounds(float(f[-1]), float(f[-1]), f, e, False)
    upper = int(above[0])
    calm = upper + np.flatnonzero(rise[upper:] < threshold)
    lower = int(calm[0]) if calm.size else f.size - 1
    return FrequencyBounds(float(f[lower]), float(f[upper]), f, e, upper > 0 and calm.size > 0)
