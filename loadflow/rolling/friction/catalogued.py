"""Torque that catalogues give a bearing, under the loads of its equilibrium, beside our own."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields, check_one_of
from loadflow.rolling.friction.catalogue import PALMGREN_F1, catalogue_torques, palmgren_torque
from loadflow.rolling.friction.options import FrictionOptions
from loadflow.rolling.friction.skf import (
    CatalogueKind,
    SkfConstants,
    skf_constants,
    skf_drag_torque,
    skf_series,
)

if TYPE_CHECKING:
    from loadflow.rolling.geometry import RollingGeometry
    from loadflow.rolling.results import ContactResult

Array = NDArray[np.float64]
_BATH, _GREASE = 3e-8, 6e-8  # K_rs of SKF: tracks refill sooner from a bath of oil than from grease


@dataclass(frozen=True, kw_only=True)
class CatalogueEntry:
    """What a catalogue says of a bearing beside what its geometry tells.

    Attributes
    ----------
    bore, outside_diameter : float
        d and D, m.
    series : str, optional
        Of SKF's table, one of `skf_series`: "240" of a spherical bearing 240/600.
    axial_factor : float, optional
        Y of one row of tapered rollers; 0.4 cot α of ISO 281 where it is left out.
    constants : SkfConstants, optional
        In place of a series.
    oil_level : float, optional
        H of a bath of oil at rest above the lowest contact of the outer raceway, m: adds SKF's
        drag (`skf_drag_torque`) of each part that is rated.
    width : float, optional
        B of one row of cylindrical or tapered rollers, or of a spherical bearing, m; for the drag.

    Raises
    ------
    InputError
        A field out of its range, series and constants at once, or an `axial_factor` without
        series; an `oil_level` without either, or a `width` without `oil_level`.

    Examples
    --------
    >>> from loadflow.rolling.friction import CatalogueEntry
    >>> CatalogueEntry(bore=0.6, outside_diameter=0.87, series="240").series
    '240'
    """

    bore: Annotated[float, Gt(0)]
    outside_diameter: Annotated[float, Gt(0)]
    series: str | None = None
    axial_factor: Annotated[float, Gt(0)] | None = None
    constants: SkfConstants | None = None
    oil_level: Annotated[float, Ge(0)] | None = None
    width: Annotated[float, Gt(0)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        if self.outside_diameter <= self.bore:
            raise InputError(
                f"outside_diameter: must be > bore {self.bore:g} m, got {self.outside_diameter:g}"
            )
        if self.series is not None and self.constants is not None:
            raise InputError("series, constants: keep one of them")
        if self.axial_factor is not None and self.series is None:
            raise InputError("axial_factor: give a series with it; constants have their own")
        if self.oil_level is not None and self.series is None and self.constants is None:
            raise InputError("oil_level: give a series or constants with it, for SKF's drag")
        if self.width is not None and self.oil_level is None:
            raise InputError("width: give an oil_level with it; only SKF's drag reads it")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Constants that only the drag reads, which an `oil_level` asks for."""
        if self.oil_level is None and self.constants is not None:
            yield "constants.roller_geometry", "only drag reads it: give an oil_level"

    def check(self, bearing: RollingGeometry) -> None:
        """Refuse a bearing that is not one of this entry.

        Raises
        ------
        InputError
            A kind that these catalogues do not know, diameters within its raceways, a series or
            constants of another type, an `axial_factor` of rollers that are not tapered, a `width`
            of balls, or an `oil_level` of rollers without it or without K_L.
        """
        kind = bearing.catalogue_kind
        if kind is None:
            raise InputError(
                "kind: Palmgren's and SKF's constants here are of balls and of cylindrical, "
                f"tapered and double-row spherical rollers, not of this {type(bearing).__name__}; "
                "leave it out"
            )
        across = bearing.element_diameter * math.cos(bearing.nominal_angle)
        inner, outer = bearing.pitch_diameter - across, bearing.pitch_diameter + across
        if self.bore >= inner:
            raise InputError(f"bore: must be < {inner:g} m, the inner raceway, got {self.bore:g}")
        if self.outside_diameter <= outer:
            raise InputError(
                f"outside_diameter: must be > {outer:g} m, the outer raceway, "
                f"got {self.outside_diameter:g}"
            )
        elements = f"{bearing.element}s"
        if self.series is not None:
            check_one_of(f"series of {kind} {elements}", self.series, skf_series(kind))
        if self.constants is not None and self.constants.kind != kind:
            raise InputError(
                f'constants.kind: must be "{kind}" as the {elements} are, '
                f'got "{self.constants.kind}"'
            )
        if self.axial_factor is not None and kind != "tapered":
            raise InputError(
                f"axial_factor: Y is left out for {kind} {elements}; of tapered rollers only"
            )
        if self.width is not None and bearing.element == "ball":
            raise InputError("width: left out where balls roll; SKF's drag of rollers reads it")
        if self.oil_level is not None and bearing.element == "roller":
            if self.width is None:
                raise InputError("width: missing; the drag of rollers in oil needs it")
            if self.constants is not None and self.constants.roller_geometry is None:
                raise InputError(
                    "constants.roller_geometry: missing; K_L of the drag of rollers in oil"
                )

    def skf(self, bearing: RollingGeometry, greased: bool) -> SkfConstants | None:
        """Constants of SKF's model for a bearing with grease or oil; None if none are stated."""
        if self.series is None:
            return self.constants
        kind = bearing.catalogue_kind
        assert kind is not None
        factor = 0.0
        if kind == "tapered":
            factor = self.axial_factor or 0.4 / math.tan(bearing.nominal_angle)
        found = skf_constants(kind, self.series, factor)
        return replace(found, starvation=_GREASE if greased else _BATH)


def torques_beside(
    result: ContactResult[RollingGeometry],
    speed: ArrayLike,
    options: FrictionOptions,
    entry: CatalogueEntry | None = None,
) -> dict[str, Array]:
    """Torque of a loaded bearing after each catalogue, N m, beside that of `result.friction`.

    Catalogues rate single rows of balls and of cylindrical and tapered rollers: each row has the
    force on its own elements, preload and tilt with it, and the rows add up; the preload of both
    diagonals of four-point balls cancels, as catalogues have none. Spherical bearings are rated
    whole, with the force on the bearing. Torques are those of a bearing that turns. Seals are not
    in them; where the entry has an `oil_level`, the drag of the oil is, once for each row rated.

    Parameters
    ----------
    result : RollingEquilibrium
        Under load cases (...).
    speed : array_like
        rad/s; broadcasts with the load cases.
    options : FrictionOptions
        Oil and temperature.
    entry : CatalogueEntry, optional
        Adds what needs its diameters and its series; Palmgren's formula alone has enough in the
        pitch diameter.

    Returns
    -------
    dict of str to ndarray
        "palmgren" of rollers, with an entry "constant coefficient", with a series or constants
        "skf"; empty where catalogues have nothing on the kind of bearing.

    Raises
    ------
    InputError
        An `oil_level` with a grease.

    Examples
    --------
    >>> from loadflow.rolling import FrictionOptions, SphericalRollerBearing
    >>> from loadflow.rolling.friction import CatalogueEntry, torques_beside
    >>> from loadflow.tribology import lubricant
    >>> bearing = SphericalRollerBearing(rollers=28, roller_diameter=0.08, roller_length=0.12,
    ...     pitch_diameter=0.95, contact_angle=0.17)
    >>> loaded = bearing.equilibrium((1e6, 0.0, 2e5))
    >>> options = FrictionOptions(oil=lubricant("lgep-2"), temperature=313.15)
    >>> entry = CatalogueEntry(bore=0.75, outside_diameter=1.15, series="240")
    >>> found = torques_beside(loaded, 1.3, options, entry)
    >>> {name: round(float(torque)) for name, torque in found.items()}
    {'palmgren': 563, 'constant coefficient': 688, 'skf': 569}
    """
    bearing = result.bearing
    kind = bearing.catalogue_kind
    if kind is None or (entry is None and kind not in PALMGREN_F1):
        return {}
    radial, axial = _rated_loads(result, kind)
    turning = np.asarray(speed, float)[..., None]
    viscosity = options.oil.kinematic_viscosity(options.temperature)
    if entry is None:
        pitch = bearing.pitch_diameter
        rows = {"palmgren": palmgren_torque(kind, radial, axial, turning, viscosity, pitch)}
    else:
        rows = _with_entry(bearing, entry, (radial, axial), turning, viscosity, options)
    return {name: np.asarray(torque.sum(axis=-1)) for name, torque in rows.items()}


def _with_entry(
    bearing: RollingGeometry,
    entry: CatalogueEntry,
    loads: tuple[Array, Array],
    turning: Array,
    viscosity: ArrayLike,
    options: FrictionOptions,
) -> dict[str, Array]:
    """Torques of each part of a bearing that is rated, N m, (..., part)."""
    greased = bool(options.oil.thickener)
    kind, constants = bearing.catalogue_kind, entry.skf(bearing, greased)
    assert kind is not None
    size, parts = (entry.bore, entry.outside_diameter), loads[0].shape[-1]
    capacity = bearing.static_capacity / parts
    found = catalogue_torques(kind, *loads, turning, viscosity, *size, constants, capacity)
    if constants is not None and entry.oil_level is not None:
        if greased:
            raise InputError(f"oil_level: a bath of oil; {options.oil.name or 'this'} is a grease")
        drag = skf_drag_torque(constants, turning, viscosity, *size, entry.oil_level, entry.width)
        found["skf"] = found["skf"] + drag
    return found


def _rated_loads(
    result: ContactResult[RollingGeometry], kind: CatalogueKind
) -> tuple[Array, Array]:
    """Radial and axial load of each part of a bearing that catalogues rate, N, (..., part)."""
    if kind == "spherical":
        x, y, z = np.moveaxis(result.force, -1, 0)
        return np.hypot(x, y)[..., None], np.abs(z)[..., None]
    if result.bearing.element == "ball":
        # of each kind of contact: of two diagonals, one after the other, in each row
        along = result.contact_directions[..., :3]
        kinds = np.einsum("...ke,...kei->...ki", result.contact_forces, along)
        rows = result.bearing.groups[0]
        row = kinds.reshape(*kinds.shape[:-2], rows, -1, 3).sum(axis=-2)
        return np.hypot(row[..., 0], row[..., 1]), np.abs(row[..., 2])
    forces, angle = result.element_forces, result.bearing.nominal_angle
    turned = np.exp(1j * result.element_azimuth)
    return (
        np.abs((forces * turned).sum(axis=-1)) * math.cos(angle),
        forces.sum(axis=-1) * math.sin(angle),
    )
