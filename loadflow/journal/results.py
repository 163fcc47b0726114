"""What the journal bearing answers."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.grid_bounds import BOUNDED, FieldError, GridError, resolved
from loadflow.numerics.shown import Shown
from loadflow.quantities import FILM, GRID_ERROR, Quantity, percent

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Array = NDArray[np.float64]


_INNER = {
    **dict.fromkeys(("force", "film_force", "contact_force"), ("axis",)),
    **dict.fromkeys(("eccentricity", "moment", "tilt"), ("axis",)),
    **dict.fromkeys(("stiffness", "damping"), ("dof", "along")),
    **dict.fromkeys(("groove_flow", "groove_pressure"), ("groove",)),
    **dict.fromkeys(("pressure", "fill", "deformation", "gap"), ("around", "across")),
    **dict.fromkeys(
        ("film_temperature", "film_viscosity", "surface_temperature", "thermal_growth"),
        ("around", "across"),
    ),
    **dict.fromkeys(("leading_temperature", "trailing_temperature"), ("mixing groove",)),
    "pad_tilt": ("pad",),
    "angle": ("around",),
    "z": ("across",),
}
"""Dimensions of a result beside those of the loads."""


def _of(kind: type, bounds: dict[str, Array]) -> dict[str, Array]:
    """Those of `bounds` that a `kind` of them has."""
    return {part.name: bounds[part.name] for part in fields(kind)}


@dataclass(frozen=True, kw_only=True, repr=False)
class FilmState(Shown):
    """What an equilibrium and a film at a given position have in common; see `Equilibrium`."""

    eccentricity_ratio: Array
    minimum_film: Array
    maximum_pressure: Array
    friction_power: Array
    side_flow: Array
    supply_flow: Array
    supply_power: Array
    groove_flow: Array
    groove_pressure: Array
    starved: NDArray[np.bool_]
    total_fill: Array
    stiffness: Array
    damping: Array
    converged: NDArray[np.bool_]
    iterations: NDArray[np.int64]
    residual: Array
    moment: Array = field(default_factory=lambda: np.zeros(2))
    tilt: Array = field(default_factory=lambda: np.zeros(2))
    pad_tilt: Array = field(default_factory=lambda: np.zeros(0))
    shell_deformation: Array = field(default_factory=lambda: np.zeros(()))
    contact_force: Array | None = None
    contact_pressure: Array | None = None
    contact_area: Array | None = None
    contact_power: Array | None = None
    contact_share: Array | None = None
    relative_grid_error: Array | None = None

    def _bounds(self) -> dict[str, Array] | None:
        """Bounds of what the cells do to the results, in their units, by name."""
        relative = self.relative_grid_error
        if relative is None:
            return None
        values = {name: np.abs(getattr(self, name, 1.0)) for name in BOUNDED}
        values["attitude_angle"] = np.ones(self._shape)
        values["force"] = np.linalg.norm(np.atleast_1d(values["force"]), axis=-1)
        return {name: values[name] * relative[..., k] for k, name in enumerate(BOUNDED)}

    @property
    def resolved(self) -> NDArray[np.bool_] | None:
        """Whether the cells resolve the narrowest gap, or the load at a given one, to 25 %.

        None but on "grid" and "reduced".
        """
        bounds = self.relative_grid_error
        return None if bounds is None else resolved(bounds, self.converged)

    @property
    def grid_error(self) -> GridError | FieldError | None:
        """Bounds of what the cells do to the results; None but on "grid" and "reduced"."""
        return None

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a film."""
        return FILM

    @property
    def _shape(self) -> tuple[int, ...]:
        """Shape of the loads."""
        return np.shape(self.eccentricity_ratio)

    def to_dataset(self) -> xr.Dataset:
        """All that is known, with units and meaning.

        Returns
        -------
        xarray.Dataset
            Over ``case`` (the loads in C order; none for a single load), ``axis``, ``dof`` and
            ``along`` (what acts, and along what it acts), ``groove``, ``pad``, and the cells
            ``around`` and ``across``. What the model does not say is left out.

        Examples
        --------
        >>> from loadflow.journal import Film, JournalBearing, Lubricant
        >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
        >>> state = bearing.equilibrium((8e3, 0.0), 100.0, Film(Lubricant(0.03)))
        >>> data = state.to_dataset()
        >>> data.stiffness.dims, data.stiffness.units
        (('dof', 'along'), 'N/m')
        """
        import xarray as xr

        lead, cases = len(self._shape), math.prod(self._shape)
        found: dict[str, Any] = {}
        for name, said in self._told():
            values, dims = np.asarray(said), _INNER.get(name, ())
            if values.ndim > len(dims):
                values = values.reshape(cases, *values.shape[lead:])
                dims = ("case", *dims)
            found[name] = dims, values, FILM[name].attributes
        names = ["e_x", "e_y", "tilt_x", "tilt_y"]
        coords: dict[str, Any] = {"axis": list("xy")}
        if "stiffness" in found:
            size = found["stiffness"][1].shape[-1]
            coords |= {"dof": names[:size], "along": names[:size]}
        return xr.Dataset(found, coords)

    def _told(self) -> Iterator[tuple[str, Any]]:
        """Names and values of all that is known."""
        for part in fields(self):
            value = getattr(self, part.name)
            if value is not None and part.name in FILM:
                yield part.name, value
        if self.relative_grid_error is not None:
            yield "resolved", self.resolved
            for name, bound in vars(self.grid_error).items():
                yield name + GRID_ERROR, bound

    def __repr__(self) -> str:
        """The state in short; of many loads their number and the extremes."""
        films = np.ravel(self.minimum_film)
        ratio, peak = (
            np.ravel(getattr(self, name)) for name in ("eccentricity_ratio", "maximum_pressure")
        )
        found = np.ravel(self.converged)
        name = type(self).__name__
        if not found.any():
            return f"<{name}: {found.size} loads, none converged>"
        lowest, highest = int(np.nanargmin(films)), int(np.nanargmax(peak))
        said = (
            f"ε = {np.nanmax(ratio):.4g}, h_min = {films[lowest] * 1e6:.4g} µm"
            f"{self._give_or_take('minimum_film', lowest)}, "
            f"p_max = {peak[highest] / 1e6:.4g} MPa"
            f"{self._give_or_take('maximum_pressure', highest)}"
        )
        if self.resolved is not None and (missed := int((found & ~np.ravel(self.resolved)).sum())):
            said += ", not resolved" if found.size == 1 else f", {missed} not resolved"
        if found.size == 1:
            return f"<{name}: {said}, {np.ravel(self.iterations)[0]} iterations>"
        return f"<{name}: {found.size} loads, {found.sum()} converged; extremes {said}>"

    def _give_or_take(self, name: str, case: int) -> str:
        """Bound of what the cells do to a quantity of one load, in words."""
        if self.relative_grid_error is None:
            return ""
        bound = self.relative_grid_error[..., BOUNDED.index(name)]
        return f" ± {percent(np.ravel(bound)[case])}" if np.any(bound) else ""


@dataclass(frozen=True, kw_only=True, repr=False)
class Equilibrium(FilmState):
    """Static equilibrium of shaft and film.

    Shapes are those of the input, `force` without its last axis broadcast with `speed`;
    scalars for one load.

    Attributes
    ----------
    force : array (…, 2)
        What the shaft applies to the bearing, N.
    speed : array (…)
        Speed of the shaft, rad/s, > 0 from the first axis toward the second.
    eccentricity : array (…, 2)
        Shaft centre relative to the shell, m.
    eccentricity_ratio : array (…)
        ε = |e|/c.
    attitude_angle : array (…)
        From load to eccentricity, > 0 with rotation, rad; π/2 without load.
    minimum_film : array (…)
        Narrowest gap, m; c (1 − ε) in a cylindrical, aligned bearing.
    maximum_pressure : array (…)
        Largest pressure of the film, Pa, absolute.
    sommerfeld_number : array (…)
        So = p_m ψ²/(η |ω|), (1.13) of [Jonuschies 2015].
    friction_power : array (…)
        (3.34) of [Jonuschies 2015]: pure liquid over the whole film, W.
    side_flow : array (…)
        Oil that leaves through the bearing ends, (3.31–3.33), m³/s.
    supply_flow : array (…)
        Oil that the grooves give to the film, net, m³/s; 0 without a supply.
    supply_power : array (…)
        Q p of Table 5-23: what lifts that oil from tank to supply pressure, W.
    groove_flow, groove_pressure : array (…, grooves)
        Oil that each groove gives to the film, m³/s, and its pressure, Pa, absolute.
    starved : array of bool (…)
        Whether a fed groove gives less than the film would draw from it at the pressure of the
        ends, so that its own pressure falls below that.
    total_fill : array (…)
        ∫F h dA/∫h dA, (3.43).
    reynolds_number : array (…)
        Re = ρ ω R c/η.
    critical_reynolds_number : array (…)
        Re_cr = 41.3 √(D/s), (3.14).
    laminar : array of bool (…)
        Whether Re is below Re_cr.
    stiffness, damping : array (…, 2, 2) or (…, 4, 4)
        −∂F_film/∂e (N/m) and −∂F_film/∂ė (N s/m), [i, j]. On the full width also the moments (rows
        2, 3) and tilts (columns 2, 3) about both axes. Pads follow without moment.
    converged : array of bool (…)
        Whether `residual` fell below the tolerance.
    iterations : array of int (…)
        Newton steps.
    residual : array (…)
        Largest imbalance of a cell and of the load, over their scales.
    moment, tilt : array (…, 2)
        What the shaft applies to the bearing about both axes, N m, and its rotation about them,
        rad; 0 where the film is symmetric.
    pad_tilt : array (…, pads)
        Rotation of the pads about their pivots, rad, from the first axis toward the second.
    shell_deformation : array (…)
        Largest growth of the gap by the elastic shell, m; 0 where it is rigid.
    temperature : array (…), optional
        Effective temperature of the film, K; None without heat.
    contact_force : array (…, 2), optional
        Part of `force` that touching asperities carry, N; as the next four, None without contact.
        Then `minimum_film` is that of the mean gap between the rough surfaces, `eccentricity_ratio`
        may exceed 1, and `friction_power` contains `contact_power`.
    contact_pressure : array (…), optional
        Largest mean pressure of asperities, Pa.
    contact_area : array (…), optional
        Real over nominal area of contact there; the elastic law holds while it is well below 1.
    contact_power : array (…), optional
        Power of boundary friction μ ∬p_a dA R |ω|, W.
    contact_share : array (…), optional
        Part of `contact_force` along `force`, over its size.
    relative_grid_error : array (…, 7), optional
        Bounds of what the cells do to force, eccentricity ratio, attitude angle (rad), smallest
        film, largest pressure, friction power and side flow, over their values; None but on "grid"
        and "reduced". `grid_error` has them in units, `resolved` says whether they are small.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> state = bearing.equilibrium((5e3, 0.0), 50.0, Lubricant(0.05), grid=(36, 8))
    >>> bool(state.converged), state.stiffness.shape
    (True, (2, 2))
    """

    force: Array
    speed: Array
    eccentricity: Array
    attitude_angle: Array
    sommerfeld_number: Array
    reynolds_number: Array
    critical_reynolds_number: Array
    laminar: NDArray[np.bool_]
    temperature: Array | None = None

    @property
    def grid_error(self) -> GridError | None:
        """Bounds of what the cells do to the results; None but on "grid" and "reduced".

        They follow from the solved film alone: from how far its pressure bends within a cell, and
        its stiffness.
        """
        bounds = self._bounds()
        return None if bounds is None else GridError(**_of(GridError, bounds))

    def plot(self) -> Figure:
        """Draw K and C over the speeds, or the shaft centre in the clearance circle.

        The first where the equilibria are of several speeds under one load each.

        Returns
        -------
        matplotlib.figure.Figure

        Examples
        --------
        >>> from loadflow.journal import JournalBearing, Lubricant
        >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
        >>> state = bearing.equilibrium((5e3, 0.0), [50.0, 80.0], Lubricant(0.05), grid=(36, 8))
        >>> len(state.plot().axes)
        2
        """
        from loadflow import plots

        speeds, loads = np.ravel(self.speed), np.reshape(self.force, (-1, 2))
        if np.unique(speeds).size > 1 and np.unique(loads, axis=0).shape[0] == 1:
            return plots.coefficients(speeds, self.stiffness, self.damping)
        place, ratio = np.reshape(self.eccentricity, (-1, 2)), np.ravel(self.eccentricity_ratio)
        size = np.hypot(*place.T)
        known = np.flatnonzero(size > 0)
        clearance = size[known[0]] / ratio[known[0]] if known.size else 1.0
        return plots.clearance_circle(place / clearance, np.ravel(self.minimum_film) * 1e6)


@dataclass(frozen=True, kw_only=True, repr=False)
class WarmEquilibrium(Equilibrium):
    """Static equilibrium of shaft, film and heat; `converged` counts them all.

    Attributes
    ----------
    outlet_temperature : array (…)
        Of the oil that leaves, K.
    viscosity : array (…)
        At the effective temperature, Pa s.
    heat_residual : array (…)
        What is left of the heat balance, K.
    heat_iterations : array of int (…)
        Temperatures tried.
    inlet_temperature : array (…), optional
        Of the oil that enters, K: as given, or that of the sump.
    clearance : array (…), optional
        Radial clearance as shaft and shell have grown, m; None where they do not.

    Examples
    --------
    >>> from loadflow.journal import Heat, JournalBearing
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> state = bearing.equilibrium((1e4, 0.0), 100.0, heat=Heat(), grid=(40, 8))
    >>> bool(state.converged), bool(state.outlet_temperature > state.temperature > 313.15)
    (True, True)
    """

    outlet_temperature: Array = field(default_factory=lambda: np.zeros(()))
    viscosity: Array = field(default_factory=lambda: np.zeros(()))
    heat_residual: Array = field(default_factory=lambda: np.zeros(()))
    heat_iterations: NDArray[np.int64] = field(default_factory=lambda: np.zeros((), dtype=int))
    inlet_temperature: Array | None = None
    clearance: Array | None = None


@dataclass(frozen=True, kw_only=True, repr=False)
class FilmField(FilmState):
    """Film at a given position and velocity of the shaft.

    Attributes
    ----------
    film_force : array (…, 2)
        Force of the film on the shaft, N.
    force : array (…, 2)
        What the shaft applies to the bearing, ``−film_force``, N.
    pressure : array (…, nx, nz)
        Pressure of the cells, full width, Pa, absolute.
    fill : array (…, nx, nz)
        Share of liquid F.
    angle : array (…, nx)
        Angle of the cell centres from the first axis toward the second, rad.
    z : array (nz,)
        Axial position of the cell centres from mid-plane, m; on "reduced" that of its points.
    eccentricity_ratio, minimum_film, maximum_pressure, friction_power, side_flow, supply_flow, \
supply_power, groove_flow, groove_pressure, starved, total_fill, stiffness, damping, converged, \
iterations, residual, moment, tilt, pad_tilt, shell_deformation, contact_force, contact_pressure, \
contact_area, contact_power, contact_share, relative_grid_error
        As in `Equilibrium`.
    deformation : array (…, nx, nz)
        Growth of the gap of the cells by the elastic shell, m.
    gap : array (…, nx, nz)
        Mean gap of the cells, m.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> field = bearing.pressure((5e-5, 0.0), 50.0, Lubricant(0.05), grid=(36, 8))
    >>> field.pressure.shape
    (36, 8)
    >>> bool(field.film_force[0] < 0.0)  # the film pushes the shaft back
    True
    """

    film_force: Array
    force: Array
    pressure: Array
    fill: Array
    deformation: Array
    gap: Array
    angle: Array
    z: Array

    @property
    def grid_error(self) -> FieldError | None:
        """Bounds of what the cells do to the results; None but on "grid" and "reduced"."""
        bounds = self._bounds()
        return None if bounds is None else FieldError(**_of(FieldError, bounds))

    def plot(self, case: int = 0) -> Figure:
        """Draw the pressure unwrapped and around the shaft, and the gap.

        Parameters
        ----------
        case : int
            Number of the position, in C order.

        Returns
        -------
        matplotlib.figure.Figure

        Examples
        --------
        >>> from loadflow.journal import JournalBearing, Lubricant
        >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
        >>> len(bearing.pressure((5e-5, 0.0), 50.0, Lubricant(0.05), grid=(36, 8)).plot().axes)
        4
        """
        from loadflow import plots

        angle, pressure, gap = (
            values.reshape(-1, *values.shape[len(self._shape) :])[case]
            for values in (self.angle, self.pressure, self.gap)
        )
        return plots.pressure(angle, self.z, pressure, gap)
