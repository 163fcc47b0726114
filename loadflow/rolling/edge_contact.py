"""Pressure under one roller by influence coefficients: what independent slices leave out.

The raceway is an elastic half-space loaded by rectangles of uniform pressure (Love 1929); the
contact problem is solved by conjugate gradients with convolutions by FFT (Polonsky & Keer 1999).
Raceway and roller end together: the free end of the raceway, which softens edges, is left out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError, SolverError
from loadflow.numerics.convergence import is_small, rounding_level, unresolved
from loadflow.numerics.shown import Shown, in_words
from loadflow.quantities import Quantity
from loadflow.tribology.hertz import effective_modulus

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from loadflow.rolling.roller_raceways import RollerRaceways

Array = NDArray[np.float64]


_SHOWN = {
    "maximum_pressure": Quantity("p_max", "Pa", "largest pressure"),
    "approach": Quantity("δ", "m", "approach of roller and raceway"),
    "slice_forces": Quantity("q", "N", "force on each strip along the roller"),
    "converged": Quantity("", "1", "whether the tolerance was met"),
    "residual": Quantity("", "1", "difference of gap and approach over the approach"),
    "iterations": Quantity("", "1", "steps"),
}


@dataclass(frozen=True, repr=False)
class EdgeContact(Shown):
    """Contact of one roller with one raceway.

    Attributes
    ----------
    along, across : ndarray
        Middles of the cells along and across the roller, m.
    pressure : ndarray, shape (along, across)
        Pa.
    approach : float
        Of roller and raceway, m.
    slice_forces : ndarray, shape (along,)
        Force of each strip, N.
    converged : bool
        Whether the tolerance was met.
    residual : float
        Largest difference of gap and approach under pressure, over the approach.
    iterations : int
        Steps.

    Examples
    --------
    >>> from loadflow.rolling import RollerBearing, edge_contact
    >>> bearing = RollerBearing(rollers=48, roller_diameter=0.04, roller_length=0.06,
    ...     pitch_diameter=0.8)
    >>> found = edge_contact(bearing, force=1e4, cells=(24, 16), tolerance=1e-4)
    >>> found.converged, round(float(found.slice_forces.sum()))
    (True, 10000)
    """

    along: Array
    across: Array
    pressure: Array
    approach: float
    slice_forces: Array
    converged: bool
    residual: float
    iterations: int

    @property
    def maximum_pressure(self) -> float:
        """Largest pressure, Pa."""
        return float(self.pressure.max())

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a contact."""
        return _SHOWN

    def to_dataset(self) -> xr.Dataset:
        """Pressure over ``along`` and ``across``, and the numbers of the contact, with units."""
        import xarray as xr

        dims = {"slice_forces": "along"}
        data = {n: (dims.get(n, ()), getattr(self, n), q.attributes) for n, q in _SHOWN.items()}
        about = {"units": "Pa", "long_name": "pressure"}
        place = {"units": "m", "long_name": "place from the middle of the roller"}
        at = {n: (n, getattr(self, n), place) for n in ("along", "across")}
        return xr.Dataset(data | {"pressure": (("along", "across"), self.pressure, about)}, at)

    def plot(self) -> Figure:
        """Draw the pressure over the contact, and its largest value along the roller."""
        from loadflow import plots

        drawing, (area, along) = plots.figure(1, 2, height=3.0)
        x, y = 1e3 * self.along, 1e3 * self.across
        shown = area.pcolormesh(x, y, self.pressure.T / 1e6, cmap="viridis", shading="nearest")
        drawing.colorbar(shown, ax=area, label="pressure, MPa")
        area.set(xlabel="along the roller, mm", ylabel="across, mm")
        area.grid(False)
        along.plot(x, self.pressure.max(axis=1) / 1e6)
        along.set(xlabel="along the roller, mm", ylabel="largest pressure, MPa")
        return drawing

    def __repr__(self) -> str:
        pressure, unit = in_words(np.array(self.maximum_pressure), "Pa")
        said = "converged" if self.converged else "not converged"
        return f"<EdgeContact, largest pressure {pressure} {unit}, {said}>"

    def edge_factor(self, share: float = 0.05) -> float:
        """Largest pressure in the outer `share` of the length at each end over that in the middle.

        Above 1 the edges are loaded harder than the rest.
        """
        peak = self.pressure.max(axis=1)
        ends = max(1, round(share * len(peak)))
        middle = peak[len(peak) // 4 : -(len(peak) // 4)]
        return float(max(peak[:ends].max(), peak[-ends:].max()) / middle.max())


def edge_contact(
    bearing: RollerRaceways,
    force: float,
    tilt: float = 0.0,
    *,
    raceway: Literal["inner", "outer"] = "inner",
    cells: tuple[int, int] = (96, 48),
    tolerance: float = 1e-6,
    max_iterations: int = 500,
) -> EdgeContact:
    """Pressure between a roller with the bearing's profile and a raceway.

    Parameters
    ----------
    bearing : RollerRaceways
        Gives diameters, length, profile and material.
    force : float
        On the roller, N.
    tilt : float
        Of the roller in the raceway about the rolling direction, rad.
    raceway : {"inner", "outer"}
        Which raceway.
    cells : tuple of int
        Cells along and across the roller. Pressures at the edges grow with the cells along it.
    tolerance : float
        Largest residual.
    max_iterations : int
        Steps allowed.

    Returns
    -------
    EdgeContact
        Pressure over the contact, force of each slice, and the approach.

    Raises
    ------
    InputError
        If the force is not positive or not finite.
    SolverError
        If the iteration does not converge.

    Examples
    --------
    >>> from loadflow.rolling import RollerBearing
    >>> bearing = RollerBearing(rollers=12, roller_diameter=15e-3, roller_length=16e-3,
    ...     pitch_diameter=65e-3, profile="straight")
    >>> edge_contact(bearing, 1e4).edge_factor() > 1.2
    True
    """
    if not (math.isfinite(force) and force > 0):
        raise InputError(f"force: must be finite and > 0 N, got {force}")
    sign = 1.0 if raceway == "inner" else -1.0
    curvature = 2 / bearing.roller_diameter / (1 - sign * bearing.gamma)
    e_star = float(effective_modulus(bearing.elastic_modulus, bearing.poisson_ratio))
    length, (rows, columns) = bearing.roller_length, cells
    x = (np.arange(rows) + 0.5) / rows * length - length / 2
    lengthwise = (bearing.drop_at(x) + tilt * x)[:, None]
    half = 1.4 * math.sqrt(4 * force / (math.pi * length * curvature * e_star))
    while True:
        y = (np.arange(columns) + 0.5) / columns * 2 * half - half
        steps = length / rows, 2 * half / columns
        found, pressure, approach, residual, rounding, iterations = _conjugate_gradients(
            lengthwise + curvature * y**2 / 2,
            _kernel(cells, steps, e_star),
            force,
            steps,
            tolerance,
            max_iterations,
        )
        if not pressure[:, [0, -1]].any():
            break
        half *= 1.5  # a short contact is wider than the line
    if not found:
        raise SolverError(
            f"edge contact: {unresolved(residual, rounding, iterations)}; "
            f"force {force:g} N, tilt {tilt:g} rad"
        )
    return EdgeContact(
        along=x,
        across=y,
        pressure=pressure,
        approach=approach,
        slice_forces=pressure.sum(axis=1) * steps[0] * steps[1],
        converged=True,
        residual=residual,
        iterations=iterations,
    )


def _kernel(cells: tuple[int, int], steps: tuple[float, float], e_star: float) -> Array:
    """Transform of the displacement around a cell under unit pressure (Love), m/Pa."""
    shape = 2 * cells[0], 2 * cells[1]
    x, y = (np.fft.fftfreq(n, 1 / n) * h for n, h in zip(shape, steps))

    def corner(a: Array, b: Array) -> Array:
        r = np.hypot(a, b)
        return a * np.log(b + r) + b * np.log(a + r)

    a, b = steps[0] / 2, steps[1] / 2
    x, y = np.abs(x)[:, None], np.abs(y)[None, :]
    total = corner(x + a, y + b) + corner(x - a, y - b)
    total -= corner(x + a, y - b) + corner(x - a, y + b)
    return np.asarray(np.fft.rfft2(total / (math.pi * e_star)))


def _conjugate_gradients(
    gap: Array,
    kernel: Array,
    force: float,
    steps: tuple[float, float],
    tolerance: float,
    limit: int,
) -> tuple[bool, Array, float, float, float, int]:
    """Whether found, pressure, approach, residual, its rounding level and steps of the contact.

    The contact is frictionless; the residual is a distance over the approach.
    """
    shape = gap.shape
    area = steps[0] * steps[1]

    def bend(load: Array) -> Array:
        padded = tuple(2 * n for n in shape)
        return np.fft.irfft2(np.fft.rfft2(load, padded) * kernel, padded)[: shape[0], : shape[1]]

    p = np.full(shape, force / (area * gap.size))
    direction = np.zeros(shape)
    descent, previous = 0.0, 1.0
    approach = residual = rounding = math.inf
    for step in range(1, limit + 1):
        bent = bend(p)
        g = gap + bent
        touching = p > 0
        approach = float(g[touching].mean())
        g = g - approach
        residual = float(np.abs(g[touching]).max()) / abs(approach)
        rounding = rounding_level(float(np.abs(bent).max()) / abs(approach))
        apart = g[~touching] / abs(approach)
        if is_small(residual, tolerance, rounding) and (apart >= -max(tolerance, rounding)).all():
            return True, p, approach, residual, rounding, step
        square = float((g[touching] ** 2).sum())
        direction = np.where(touching, g + descent * square / previous * direction, 0.0)
        previous = square
        answer = bend(direction)
        answer -= answer[touching].mean()
        length = float((g * direction)[touching].sum() / (answer * direction)[touching].sum())
        p = np.maximum(p - np.where(touching, length * direction, 0.0), 0.0)
        overlap = (p <= 0) & (g < 0)
        descent = 0.0 if overlap.any() else 1.0
        p[overlap] -= length * g[overlap]
        p *= force / (area * p.sum())
    return False, p, approach, residual, rounding, limit
