"""The film without dimensions: loads as Sommerfeld numbers, positions as eccentricity ratios."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from annotated_types import Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.journal.bearing import JournalBearing
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.results import Equilibrium, FilmField
from loadflow.numerics.fields import require

_CLEARANCE = 1e-3  # relative clearance of the bearing that stands for all; it cancels


@dataclass(frozen=True)
class UnitBearing:
    """All cylindrical journal bearings of one width, at a speed of 1.

    Forces are Sommerfeld numbers So = F ψ²/(B D η ω) (1.13), pressures Π = p ψ²/(η ω), positions
    ε = e/c, velocities dε/d(ω t). Laws, edge and supply pressures are given as Π too.

    Attributes
    ----------
    width_ratio : float
        B/D.

    Examples
    --------
    >>> from loadflow.journal import UnitBearing
    >>> round(float(UnitBearing(0.5).equilibrium((1.0, 0.0)).eccentricity_ratio), 3)
    0.724
    """

    width_ratio: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        require(self.width_ratio > 0, "width_ratio", self.width_ratio, "> 0")

    @property
    def bearing(self) -> JournalBearing:
        """The bearing of 1 m diameter that stands for all."""
        return JournalBearing(1.0, self.width_ratio, _CLEARANCE)

    @property
    def _film(self) -> dict[str, Any]:
        """Speed and oil for which η ω/ψ² = 1 Pa; the oil is too light to be turbulent."""
        return {"speed": 1.0, "lubricant": Lubricant(_CLEARANCE**2, density=1e-9)}

    def equilibrium(self, sommerfeld: ArrayLike, **film: Any) -> Equilibrium:
        """Position in which the film carries a load.

        Parameters
        ----------
        sommerfeld : array_like (…, 2)
            Load as a Sommerfeld number along both axes; the shaft turns the first to the second.
        **film
            Law, edge pressure, supply, grid and rung, as for `JournalBearing.equilibrium`.

        Returns
        -------
        Equilibrium
            Of the bearing of 1 m diameter; its ratios, angles and Π hold for all.

        Raises
        ------
        InputError, SolverError
            As `JournalBearing.equilibrium`.
        """
        _check_laminar(film)
        force = self.width_ratio * np.asarray(sommerfeld, dtype=float)
        return self.bearing.equilibrium(force, **self._film, **film)

    def sommerfeld(
        self, eccentricity_ratio: ArrayLike, rate: ArrayLike = (0.0, 0.0), **film: Any
    ) -> NDArray[np.float64]:
        """Load that the film carries at a position or along an orbit.

        Parameters
        ----------
        eccentricity_ratio : array_like (…, 2)
            Position ε.
        rate : array_like (…, 2)
            dε/d(ω t).
        **film
            As for `JournalBearing.pressure`.

        Returns
        -------
        array (…, 2)
            Sommerfeld number along both axes.

        Raises
        ------
        InputError, SolverError
            As `JournalBearing.pressure`.
        """
        return self.field(eccentricity_ratio, rate, **film).force / self.width_ratio

    def field(
        self, eccentricity_ratio: ArrayLike, rate: ArrayLike = (0.0, 0.0), **film: Any
    ) -> FilmField:
        """The whole film at a position, pressures as Π; arguments as of `sommerfeld`."""
        _check_laminar(film)
        clearance = self.bearing.clearance
        return self.bearing.pressure(
            clearance * np.asarray(eccentricity_ratio, dtype=float),
            velocity=clearance * np.asarray(rate, dtype=float),
            **self._film,
            **film,
        )


def _check_laminar(film: dict[str, Any]) -> None:
    """Refuse turbulent flow, which no number without dimension stands for."""
    value = film.get("turbulence")
    require(value is None, "turbulence", value, "None for a bearing without dimension")
