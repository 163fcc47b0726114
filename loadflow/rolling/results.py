"""Equilibrium of a rolling bearing: what follows from the forces of its contacts."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Generic, Literal, TypeVar

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.numerics.shown import Shown, span_in_words
from loadflow.quantities import ROLLING, Quantity, load_cases
from loadflow.rolling.contact_forces import ContactForces
from loadflow.rolling.contacts import HEIGHT, RADIUS, Array, Contacts
from loadflow.rolling.equilibrium import RingEquilibrium
from loadflow.rolling.geometry import RollingGeometry
from loadflow.rolling.rings.equilibrium import FlexibleRingForces

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

Bearing = TypeVar("Bearing", bound=RollingGeometry, covariant=True)

_EACH_CASE = (
    "maximum_force",
    "maximum_pressure",
    "pressure_safety",
    "static_safety",
    "equivalent_load",
    "rating_life",
    "reference_life",
    "converged",
    "residual",
    "iterations",
    "singular",
)
_COMPONENTS = {
    "force": ("axis",),
    "moment": ("tilt_axis",),
    "displacement": ("dof",),
    "stiffness": ("dof", "along"),
}


@dataclass(frozen=True)
class ContactResult(Shown, RingEquilibrium, Generic[Bearing]):
    """Equilibrium with what follows from each contact, for bearings of every kind.

    All quantities over the shape (...) of the load cases, formed when asked for; `maximum_force`,
    `force_sum`, safety and life need no array of all contact forces.

    Attributes
    ----------
    bearing : RollingGeometry
        The bearing.
    contacts : Contacts
        Its contacts, with the azimuth of each element.
    elements : ContactForces
        Forces between rolling elements and raceways.
    """

    bearing: Bearing
    contacts: Contacts
    elements: ContactForces

    def shown_quantities(self) -> Mapping[str, Quantity]:
        """Quantities of a rolling bearing."""
        return ROLLING

    @property
    def cases(self) -> tuple[int, ...]:
        """Shape of the load cases."""
        return self.displacement.shape[:-1]

    # --- contacts --------------------------------------------------------------------------------
    @property
    def contact_forces(self) -> Array:
        """Force of each contact, N, (..., kind, element); kinds as in `contacts.table`."""
        return self.elements.forces

    @property
    def contact_directions(self) -> Array:
        """Motion v of the inner ring that each contact resists, (..., kind, element, 5).

        The load of all contacts is ΣF v; a stiffness k along each adds Σk v vᵀ. In the radial plane
        of each contact: what tilts the line of contact of a ball along the ring, by the shift of
        the rings over the distance of the groove centres, is left out.
        """
        table, angle = self.contacts.table, self.elements.angles
        radius, height = table[:, RADIUS, None], table[:, HEIGHT, None]
        azimuth = self.contacts.kind_azimuth
        cos, sin = np.cos(azimuth), np.sin(azimuth)
        out, along = np.cos(angle), np.sin(angle)
        lever = height * out - radius * along
        return np.stack([out * cos, out * sin, along, -lever * sin, lever * cos], axis=-1)

    @property
    def force_sum(self) -> Array:
        """Sum ΣF_k of all contact forces, N."""
        return np.asarray(self.elements.power_sums("inner")[..., 0].sum(axis=-1))

    # --- rolling elements ------------------------------------------------------------------------
    @property
    def element_forces(self) -> Array:
        """Forces on the rolling elements, N, (..., group, element).

        Groups are rows; rows and diagonals of a four-point bearing, whose diagonal 0 carries +Fz;
        tracks of crossed rollers; support, retaining and radial row of a three-row bearing, padded
        with zeros.
        """
        return self.bearing.element_forces(self.elements)

    @property
    def ball_forces(self) -> Array:
        """`element_forces` of balls."""
        return self._of("ball")

    @property
    def roller_forces(self) -> Array:
        """`element_forces` of rollers."""
        return self._of("roller")

    @property
    def slice_forces(self) -> Array:
        """Forces on the slices of rollers, N, (..., track, slice, roller)."""
        return self.bearing.slice_forces(self.elements)

    @property
    def contact_angles(self) -> Array:
        """Operating contact angles of balls, rad, (..., group, ball), (2.44) of [Ritzer 2018].

        Counted from the radial plane, positive where the contact carries +Fz; of a four-point
        bearing toward the side of each diagonal. Where a contact is open, the angle of the line
        between the groove centres.
        """
        return self.bearing.contact_angles(self.elements)

    @property
    def truncated(self) -> NDArray[np.bool_]:
        """Whether a contact ellipse reaches over the shoulder of its raceway.

        Raises
        ------
        InputError
            If the bearing has no `shoulder_angle`.
        """
        return self.bearing.truncated(self.elements)

    def _of(self, element: str) -> Array:
        if self.bearing.element != element:
            raise AttributeError(f"{type(self.bearing).__name__} rolls on {self.bearing.element}s")
        return self.element_forces

    # --- safety and life -------------------------------------------------------------------------
    @cached_property
    def maximum_force(self) -> Array:
        """Largest force on a rolling element, N."""
        return self.bearing.maximum_force(self.elements)

    @cached_property
    def raceway_pressure(self) -> tuple[Array, ...]:
        """Largest Hertzian pressure at each raceway, Pa: inner, outer; of each row of three-row."""
        return self.bearing.raceway_pressure(self.elements)

    @property
    def maximum_pressure(self) -> Array:
        """Largest Hertzian pressure of all raceways, Pa."""
        return np.asarray(np.max(self.raceway_pressure, axis=0))

    @property
    def pressure_safety(self) -> Array:
        """Allowable over largest pressure, (4.2) put right; infinite without load."""
        return self.bearing.pressure_safety(self.elements)

    @property
    def static_safety(self) -> Array:
        """Allowable over largest force, (4.1) put right: `pressure_safety` cubed, of lines squared.

        It is that of the hardest loaded contact, a ball or a slice of a roller.
        """
        return np.asarray(self.pressure_safety**self.bearing.static_exponent)

    @property
    def reference_life(self) -> Array:
        """Reference life L10r of ISO/TS 16281, millions of revolutions; the inner ring turns."""
        return self.bearing.reference_life(self.elements)

    @property
    def rating_life(self) -> Array:
        """Basic rating life, millions of revolutions.

        The reference life; of a four-point bearing L10 of its equivalent load, (2.19).
        """
        return self.bearing.rating_life(self.elements)

    @property
    def equivalent_load(self) -> Array:
        """Dynamic equivalent load, N, of which `rating_life` follows."""
        return self.bearing.equivalent_load(self.elements)

    # --- stiffness -------------------------------------------------------------------------------
    @property
    def secant_stiffness(self) -> Array:
        """Secant stiffness, (..., 5, 5), units as `stiffness`; (2.9)–(2.11) in one matrix.

        Of all symmetric matrices that lead from the centred, unloaded ring to this load,
        ``secant_stiffness @ displacement = load``, the one nearest to the tangent (rotations times
        the pitch radius). So it is load over displacement along the displacement, and the tangent
        in directions without any, or without load.
        """
        scale = self.contacts.scale
        moved = self.displacement / scale
        load = np.concatenate([self.force, self.moment], axis=-1) * scale
        tangent = self.stiffness * np.outer(scale, scale)
        tangent = (tangent + np.swapaxes(tangent, -1, -2)) / 2  # at speed it is not symmetric
        missing = load - np.einsum("...ab,...b->...a", tangent, moved)
        size = np.square(moved).sum(axis=-1, keepdims=True)
        loaded = (np.abs(load).max(axis=-1, keepdims=True) > 0) & (size > 0)
        along = np.divide(moved, size, out=np.zeros_like(moved), where=loaded)
        work = (missing * moved).sum(axis=-1)[..., None, None]
        across = missing[..., :, None] * along[..., None, :]
        update = across + np.swapaxes(across, -1, -2)
        update -= work * along[..., :, None] * along[..., None, :]
        return np.asarray((tangent + update) / np.outer(scale, scale))

    # --- as data ---------------------------------------------------------------------------------
    def to_dataset(self) -> xr.Dataset:
        """Loads, displacement, stiffness, element forces, safety and life, with units.

        Returns
        -------
        xarray.Dataset
            Over ``case`` (the load cases in C order; none for a single load), ``axis``,
            ``tilt_axis``, ``dof``, ``along``, the groups of the bearing and ``element``. What a
            bearing has none of, as a life where no standard rates its geometry, is left out; the
            attribute ``no_…`` says why.

        Examples
        --------
        >>> from loadflow.rolling import RollerBearing
        >>> bearing = RollerBearing(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
        ...     pitch_diameter=60.5e-3)
        >>> data = bearing.equilibrium(force=(2000, 0, 0)).to_dataset()
        >>> data.element_forces.dims, data.element_forces.units
        (('row', 'element'), 'N')
        """
        import xarray as xr

        lead = ("case",) if self.cases else ()

        def rows(values: NDArray, *dims: str) -> tuple[tuple[str, ...], NDArray]:
            inner = values.shape[len(self.cases) :]
            return (*lead, *dims), values.reshape((*(-1,) * len(lead), *inner))

        told = {name: self._told(name) for name in _EACH_CASE}
        found = {
            name: (*rows(values), ROLLING[name].attributes)
            for name, values in told.items()
            if not isinstance(values, str)
        }
        left_out = {
            f"no_{name}": values for name, values in told.items() if isinstance(values, str)
        }
        around = (*self.bearing.group_dims, "element")
        for name, dims in (*_COMPONENTS.items(), ("element_forces", around)):
            found[name] = (*rows(getattr(self, name), *dims), ROLLING[name].attributes)
        dof = ["ux", "uy", "uz", "tilt_x", "tilt_y"]
        return xr.Dataset(
            found,
            {"axis": list("xyz"), "tilt_axis": list("xy"), "dof": dof, "along": dof},
            {"bearing": type(self.bearing).__name__} | left_out,
        )

    def _told(self, name: str) -> Array | str:
        """A quantity of all cases, or why a bearing like this has none."""
        try:
            return np.asarray(getattr(self, name))
        except InputError as reason:
            return str(reason)

    @property
    def element_azimuth(self) -> Array:
        """Azimuth of the elements of each group, rad, (group, element), from x toward y."""
        shape = self.element_forces.shape[len(self.cases) :]
        groups = int(np.prod(shape[:-1]))
        first = np.unique(self.contacts.elements, axis=0, return_index=True)[1]
        own = self.contacts.kind_azimuth[np.sort(first)]  # of kinds with elements of their own
        if len(own) != groups:
            own = np.repeat(own[:1], groups, axis=0)
        return np.asarray(own[:, : shape[-1]])

    @property
    def element_pressure(self) -> Array:
        """Largest Hertzian pressure at each azimuth of elements, Pa, (..., element).

        Of all rows, of bearings whose rows are alike: Hertz's p ∝ Q^(1/3) of points and Q^(1/2) of
        slices of lines.
        """
        forces = np.max(self.contact_forces, axis=-2)
        largest = np.max(forces, axis=-1, keepdims=True)
        share = np.divide(forces, largest, out=np.zeros_like(forces), where=largest > 0)
        peak = np.asarray(self.maximum_pressure)[..., None]
        return np.asarray(peak * share ** (1 / self.bearing.static_exponent))

    def ring_displacement(self, ring: Literal["inner", "outer"]) -> Array:
        """Displacement (r, θ, z) of a flexible ring's raceways, m, (…, groups, element, 3).

        Raises
        ------
        InputError
            If the ring is rigid.
        """
        if not isinstance(self.elements, FlexibleRingForces):
            raise InputError(f"ring: the {ring} ring is rigid")
        return self.elements.ring_displacement(ring)

    def plot(self, case: int = 0, what: Literal["force", "pressure", "rings"] = "force") -> Figure:
        """Draw forces on the rolling elements, contact pressure or the bent rings, around the ring.

        Parameters
        ----------
        case : int
            Number of the load case, in C order.
        what : {"force", "pressure", "rings"}
            Which; `element_pressure` is of bearings whose rows are alike, and "rings" draws how far
            the raceways of flexible rings are displaced outward.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        InputError
            Both rings are rigid.

        Examples
        --------
        >>> from loadflow.rolling import RollerBearing
        >>> bearing = RollerBearing(rollers=14, roller_diameter=11e-3, roller_length=11e-3,
        ...     pitch_diameter=60.5e-3)
        >>> state = bearing.equilibrium(force=(2000, 0, 0))
        >>> len(state.plot().axes), len(state.plot(what="pressure").axes)
        (1, 1)
        """
        from loadflow import plots

        if what == "pressure":
            pressure = self.element_pressure
            row = pressure.reshape(-1, pressure.shape[-1])[case]
            return plots.contact_pressure(self.element_azimuth[0], row)
        forces = self.element_forces
        groups = self._of_case(forces, case)
        names = [f"{' '.join(self.bearing.group_dims)} {k + 1}" for k in range(len(groups))]
        if what == "rings":
            bent = {ring: self._of_case(moved, case) for ring, moved in self._bent().items()}
            named = [f"{ring} ring, {name}" for ring in bent for name in names]
            around = np.tile(self.element_azimuth, (len(bent), 1))
            return plots.rings(around, np.concatenate([*bent.values()]), named)
        return plots.element_forces(self.element_azimuth, groups, names)

    def _of_case(self, values: Array, case: int) -> Array:
        """Values (…, groups, element) of one load case, (group, element)."""
        inner = values.shape[len(self.cases) :]
        return np.asarray(values.reshape(-1, *inner)[case].reshape(-1, inner[-1]))

    def _bent(self) -> dict[str, Array]:
        """How far the raceways of flexible rings are displaced outward, m, by ring."""
        found: dict[str, Array] = {}
        rings: tuple[Literal["inner", "outer"], ...] = ("inner", "outer")
        for ring in rings:
            if getattr(getattr(self.elements, "rings", None), ring, None) is not None:
                found[ring] = self.ring_displacement(ring)[..., 0]
        if not found:
            raise InputError('plot: what = "rings": both rings are rigid')
        return found

    def __repr__(self) -> str:
        what = f"{type(self.bearing).__name__}, {load_cases(int(np.prod(self.cases)))}"
        lines = [f"<{type(self).__name__} of {what}>"]
        for name in ("maximum_force", "maximum_pressure", "static_safety", "rating_life"):
            _, units, meaning = ROLLING[name]
            values = self._told(name)
            if isinstance(values, str):
                lines.append(f"  {meaning:36s} none: {values}")
                continue
            span, unit = span_in_words(values, units)
            lines.append(f"  {meaning:36s} {span} {unit}".rstrip())
        failed = int(np.count_nonzero(~np.asarray(self.converged)))
        lines.append(f"  {'converged':36s} {'all' if not failed else f'all but {failed}'}")
        return "\n".join(lines)
