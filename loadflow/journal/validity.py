"""Whether a film is laminar, and its pressure one that shell and oil bear."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import ValidityWarning
from loadflow.journal.geometry import JournalGeometry

if TYPE_CHECKING:
    from loadflow.journal.lubricant import Lubricant

Array = NDArray[np.float64]

LARGEST_PRESSURE = 0.5e9
"""Pa, where the pressures of hard elastohydrodynamic contacts begin, 0.5 … 3 GPa in [Hamrock,
Schmid and Jacobson]: no shell of a journal bearing bears them, steel surfaces flatten, and the law
of [Barus 1893] is far too high."""


def reynolds_number(bearing: JournalGeometry, speed: ArrayLike, lubricant: Lubricant) -> Array:
    """Re = ρ |ω| R c/η of a concentric gap."""
    surface = np.abs(speed) * bearing.radius
    return np.asarray(lubricant.density * surface * bearing.clearance / lubricant.viscosity)


def critical_reynolds_number(relative_clearance: float) -> float:
    """Re_cr = 41.3 √(D/s), (3.14) of [Jonuschies 2015]; D/s = 1/ψ.

    Examples
    --------
    >>> round(critical_reynolds_number(0.5e-3))
    1847
    """
    return float(41.3 * relative_clearance**-0.5)


def warn_if_turbulent(
    bearing: JournalGeometry, speed: ArrayLike, lubricant: Lubricant, turbulence: object | None
) -> None:
    """Warn of speeds at which the flow is not laminar, unless the film knows its `turbulence`.

    Warns
    -----
    loadflow.errors.ValidityWarning
        Re reaches Re_cr; names both.
    """
    if turbulence is not None:
        return
    largest = float(np.max(reynolds_number(bearing, speed, lubricant)))
    critical = critical_reynolds_number(bearing.relative_clearance)
    if largest >= critical:
        warnings.warn(
            f"Re = {largest:.4g} reaches Re_cr = {critical:.4g} (3.14) at ω = "
            f"{np.max(np.abs(speed)):.4g} rad/s: the laminar film underestimates friction and "
            "load; a film with turbulence = Turbulence(), in a scene turbulence = {}, does not",
            ValidityWarning,
            stacklevel=3,
        )


def warn_if_beyond_pressure(pressure: ArrayLike, contact: bool = True) -> None:
    """Warn of films whose largest `pressure`, Pa, is beyond `LARGEST_PRESSURE`; NaN counts not.

    Films that know `contact` of asperities are told that these may take a share.

    Warns
    -----
    loadflow.errors.ValidityWarning
        How many are, and the largest pressure.
    """
    largest = np.atleast_1d(np.asarray(pressure, dtype=float)).ravel()
    beyond = int((largest > LARGEST_PRESSURE).sum())
    if beyond:
        warnings.warn(
            f"the pressure of {beyond} of {largest.size} films is beyond what oil and shell bear, "
            f"p_max = {np.nanmax(largest) / 1e6:,.0f} MPa > {LARGEST_PRESSURE / 1e6:.0f} MPa: "
            "check load, clearance and roughness"
            + ("; `contact` lets asperities take a share" if contact else ""),
            ValidityWarning,
            stacklevel=3,
        )
