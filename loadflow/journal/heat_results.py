"""What the journal bearing answers of a film whose temperature changes over its area."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.results import FilmField, WarmEquilibrium

Array = NDArray[np.float64]


def _none() -> Array:
    return np.zeros(())


def _no_cells() -> Array:
    return np.zeros((0, 0))


@dataclass(frozen=True, kw_only=True, repr=False)
class _OverArea:
    """Temperatures of a film over its area, and where its heat goes."""

    temperature: Array | None = None
    outlet_temperature: Array = field(default_factory=_none)
    viscosity: Array = field(default_factory=_none)
    heat_residual: Array = field(default_factory=_none)
    heat_iterations: NDArray[np.int64] = field(default_factory=lambda: np.zeros((), dtype=int))
    maximum_temperature: Array = field(default_factory=_none)
    shaft_temperature: Array = field(default_factory=_none)
    heat_carried: Array = field(default_factory=_none)
    heat_conducted: Array = field(default_factory=_none)
    heat_imbalance: Array = field(default_factory=_none)
    leading_temperature: Array = field(default_factory=lambda: np.zeros(0))
    trailing_temperature: Array = field(default_factory=lambda: np.zeros(0))
    film_temperature: Array = field(default_factory=_no_cells)
    film_viscosity: Array = field(default_factory=_no_cells)
    surface_temperature: Array = field(default_factory=_no_cells)
    thermal_growth: Array = field(default_factory=_no_cells)


@dataclass(frozen=True, kw_only=True, repr=False)
class FilmHeatEquilibrium(_OverArea, WarmEquilibrium):
    """Static equilibrium of shaft, film and the temperature over its area.

    What it has beside `WarmEquilibrium`, or in another meaning:

    Attributes
    ----------
    friction_power : array (…)
        Dissipation by shear and pressure, W; shear by the share of liquid of each cell.
    stiffness, damping : array (…, 2, 2) or (…, 4, 4)
        At the temperatures that the film has, which do not follow the motion.
    temperature, maximum_temperature : array (…)
        Mean over the area of the film, and largest, K.
    outlet_temperature : array (…)
        Mean of the oil that leaves at the bearing ends, K.
    shaft_temperature : array (…)
        Given, or that at which no heat passes through the shaft: the mean of the film, K.
    viscosity : array (…)
        At the mean temperature, Pa s.
    heat_carried, heat_conducted : array (…)
        Heat that leaves with the oil at ends and grooves, counted from the oil as it is supplied,
        and through shell and shaft, W.
    heat_imbalance : array (…)
        |friction − carried − conducted| over friction.
    leading_temperature, trailing_temperature : array (…, mixing grooves)
        Of the oil that the film takes from each groove, and mean of that which it leaves there, K:
        grooves of a supply first, then those between segments, then the one at both ends of an
        open film. NaN where none flows.
    film_temperature, film_viscosity : array (…, nx, nz)
        Of the cells, full width, K and Pa s; in a groove that of the oil which it gives. On the
        rung "reduced" of the points across.
    surface_temperature : array (…, nx, nz)
        Of the surface of the shell there, K: that of the film but with three points across it.
    thermal_growth : array (…, nx, nz)
        Growth of the gap there by the expansion of shaft and shell, m; 0 without `growth`. With it
        `clearance` is the mean that is left, to which `eccentricity_ratio` refers.
    angle, z : array (…, nx), (…, nz)
        Angles of the cell centres, rad, and their axial places from mid-plane, m.
    heat_residual : array (…)
        Largest change of a temperature that the last solution of film and heat left, K.
    heat_iterations : array of int (…)
        Fields of temperature tried.

    Examples
    --------
    >>> from loadflow.journal import Film, FilmHeat, JournalBearing, Lobes, MassConserving
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3, shape=Lobes(2))
    >>> heat = FilmHeat("iso-vg-68", inlet_temperature=313.15)
    >>> film = Film(None, MassConserving(), edge_pressure=1e4, grid=(40, 8), heat=heat)
    >>> state = bearing.equilibrium((8e3, 0.0), 100.0, film)
    >>> bool(state.heat_imbalance < 1e-8)
    True
    """

    angle: Array = field(default_factory=lambda: np.zeros(0))
    z: Array = field(default_factory=lambda: np.zeros(0))


@dataclass(frozen=True, kw_only=True, repr=False)
class FilmHeatField(_OverArea, FilmField):
    """Film and temperature over its area at a given position of the shaft.

    Attributes are those of `FilmField` and the temperatures of `FilmHeatEquilibrium`.

    Examples
    --------
    >>> from loadflow.journal import Film, FilmHeat, JournalBearing, Lobes, MassConserving
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3, shape=Lobes(2))
    >>> heat = FilmHeat("iso-vg-68", inlet_temperature=313.15)
    >>> film = Film(None, MassConserving(), edge_pressure=1e4, grid=(40, 8), heat=heat)
    >>> found = bearing.pressure((4e-5, 0.0), 100.0, film)
    >>> bool(found.maximum_temperature > 313.15)
    True
    """
