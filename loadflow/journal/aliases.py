"""Names of older versions, kept for one version more; each says what takes its place."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.bearing import JournalBearing
from loadflow.journal.heat import Heat
from loadflow.journal.results import WarmEquilibrium

Array = NDArray[np.float64]


@dataclass(frozen=True)
class WarmFilm:
    """What `warm_equilibrium` answers: an `Equilibrium` with heat says it all by itself.

    Attributes
    ----------
    film : WarmEquilibrium
        With its effective `temperature`, K; `converged` counts both film and heat.

    Examples
    --------
    >>> from loadflow.journal import Heat, JournalBearing, WarmFilm
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> state = bearing.equilibrium((1e4, 0.0), 100.0, heat=Heat(), grid=(40, 8))
    >>> WarmFilm(state).film is state
    True
    """

    film: WarmEquilibrium

    @property
    def temperature(self) -> Array:
        """Effective temperature of the film (…), K."""
        return np.asarray(self.film.temperature)[()]

    @property
    def outlet_temperature(self) -> Array:
        """Temperature of the oil that leaves (…), K."""
        return np.asarray(self.film.outlet_temperature)[()]

    @property
    def viscosity(self) -> Array:
        """Viscosity at the effective temperature (…), Pa s."""
        return np.asarray(self.film.viscosity)[()]

    @property
    def iterations(self) -> int:
        """Temperatures tried."""
        return int(np.max(np.asarray(self.film.heat_iterations)))

    @property
    def residual(self) -> Array:
        """What is left of the heat balance (…), K."""
        return np.asarray(self.film.heat_residual)[()]


def warm_equilibrium(
    bearing: JournalBearing,
    force: ArrayLike,
    speed: ArrayLike,
    heat: Heat,
    *,
    weights: ArrayLike | None = None,
    strict: bool = True,
    **film: Any,
) -> WarmFilm:
    """Equilibrium of shaft, film and heat: ``bearing.equilibrium(force, speed, heat=heat, …)``.

    Deprecated; `film` are the other keywords of `JournalBearing.equilibrium`.

    Raises
    ------
    loadflow.errors.InputError, loadflow.errors.SolverError
        As `JournalBearing.equilibrium`.

    Examples
    --------
    >>> import warnings
    >>> from loadflow.journal import Heat, JournalBearing, warm_equilibrium
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("ignore", DeprecationWarning)
    ...     warm = warm_equilibrium(bearing, (1e4, 0.0), 100.0, Heat(), grid=(40, 8))
    >>> bool(warm.film.converged)
    True
    """
    warnings.warn(
        "warm_equilibrium(bearing, force, speed, heat, …) is bearing.equilibrium(force, speed, "
        "heat=heat, …) now, whose answer has the temperatures",
        DeprecationWarning,
        stacklevel=2,
    )
    if "lubricant" in film:
        raise InputError("lubricant: not given here; the lubricant follows from heat.oil")
    state = bearing.equilibrium(force, speed, heat=heat, weights=weights, strict=strict, **film)
    assert isinstance(state, WarmEquilibrium)
    return WarmFilm(state)
