"""Film bearings of a scene that carry the force along the shaft: thrust collars, pairs of cones."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Literal, Self

import numpy as np
from pydantic import BaseModel, model_validator

from loadflow.errors import InputError, SolverError
from loadflow.journal import DoubleThrustBearing, DoubleThrustResult, Film, Lubricant, PadHeat
from loadflow.journal.thrust.collar_series import CollarSeries
from loadflow.journal.thrust.curves import CollarCurves, CollarFilms, gives_way
from loadflow.scene.axial import Array, AxialBearing, Cells, ConePair, Lands, Positive
from loadflow.scene.seats import SeatTable, check_seat
from loadflow.scene.section import Section, told_apart


class ThrustCollar(AxialBearing):
    """Thrust bearing beside journal bearings: a collar between two rows of pads.

    It carries the force along the shaft both ways, and neither radial forces nor moments.
    ``geometry`` is that of the row that carries thrust downwind, ``back`` of the other one, alike
    if left out; ``play`` is what the collar moves from one row to the other, m. With a table
    ``heat`` the friction of the films warms their oil, which takes the place of ``lubricant``: each
    row has its own temperature, at rest that of each sample, in motion one for the whole series.

    ``self_aligning`` pads stand on a carrier that turns with the collar: however the shaft tilts,
    their films stay aligned, and give it no moment. ``seat`` is what the carrier resists with,
    friction or stiffness: plans then count what that leaves of the slope in the films.
    """

    kind: Literal["thrust"] = "thrust"
    geometry: Lands
    back: Lands | None = None
    play: Positive = 4e-4
    heat: PadHeat | None = None
    self_aligning: bool = False
    seat: SeatTable | None = None

    @model_validator(mode="after")
    def _one_oil(self) -> Self:
        if self.heat is not None and "lubricant" in self.changed:
            raise ValueError("lubricant: follows from heat.oil and its temperature; leave it out")
        return self

    @model_validator(mode="after")
    def _seat_of_what_aligns_itself(self) -> Self:
        check_seat(self)
        return self

    @property
    def film_model(self) -> Film:
        """The film that these keys describe, with its heat."""
        if self.heat is None:
            return super().film_model
        return replace(super().film_model, lubricant=None, heat=self.heat)

    @property
    def oil(self) -> Lubricant:
        """The oil as it enters."""
        return self.film_model.liquid

    @property
    def bearing(self) -> DoubleThrustBearing:
        """Both rows."""
        return DoubleThrustBearing(self.geometry, self.back or self.geometry, self.play)

    @property
    def radius(self) -> float:
        """Mean radius of the front row, m."""
        return 0.5 * (self.geometry.inner_radius + self.geometry.outer_radius)

    @property
    def clearance(self) -> float:
        """Half of the play, m."""
        return 0.5 * self.play

    @property
    def words(self) -> str:
        """What it is."""
        row = self.geometry
        pads = "tilting pads" if row.pivot is not None else "fixed pads"
        return f"thrust bearing, {row.pads} {pads} on each side"

    @property
    def measures(self) -> str:
        """Its measures, in words."""
        row = self.geometry
        return (
            f"d {2e3 * row.inner_radius:.0f} … D {2e3 * row.outer_radius:.0f} mm, play "
            f"{1e6 * self.play:.0f} µm, {1e3 * self.oil.viscosity:.3g} mPa s"
        )

    def normal_load(self, force: Array, moment: Array) -> Array:
        """The force along the shaft."""
        return np.abs(force[:, 2])

    def solve(
        self, force: Array, moment: Array, speed: float, tilt: Array | None = None
    ) -> DoubleThrustResult:
        """Place of the collar under the force along the shaft, held at a tilt (2,) or aligned."""
        turned = np.zeros(2) if tilt is None else tilt
        return self.bearing.equilibrium(float(force[2]), speed, self.film_model, tilt=turned)

    def by_curve(
        self, force: Array, speed: Array, tilt: Array | None = None, time: Array | None = None
    ) -> CollarFilms:
        """Places of the collar, of films tabulated down to half the sum of their R_z.

        Tilted by (n, 2), rad, and in motion over times (n,), s, where they are given.
        """
        if tilt is None and time is None and self.heat is None:
            curves = CollarCurves(self.bearing, self.film_model, 0.5 * self.contact_film)
            return curves.equilibrium(force[:, 2], speed)
        series = self.series(tilt is not None)
        turned = np.zeros(2) if tilt is None else tilt
        if time is None:
            return series.equilibrium(force[:, 2], speed, turned)
        return series.path(time, force[:, 2], speed, turned)

    def series(self, tilts: bool, span: tuple[float, float] | None = None) -> CollarSeries:
        """Its films on tables of its rows, or of those between the gaps of a `span`, m."""
        return CollarSeries(self.bearing, self.film_model, self.contact_film, tilts, span)

    def cool(self) -> Self:
        """With its oil as it enters."""
        return self.model_copy(update={"heat": None, "lubricant": self.oil})

    def on_cells(self, grid: tuple[int, int]) -> Self:
        """With other cells: those of all collars, and no key of its own."""
        other = self.model_copy(update={"grid": grid})
        other.model_fields_set.discard("grid")
        return other

    def with_clearance(self, change: float) -> Self:
        """With more play, by twice the change: that of both rows."""
        play = self.play + 2.0 * change
        if play <= 2.0 * self.contact_film:
            raise InputError(f"play: {play:g} m is no more than the roughness")
        return self.model_copy(update={"play": play})

    def with_viscosity(self, factor: float) -> Self:
        """The collar with an oil so many times as thick, at all temperatures."""
        if self.heat is None:
            return super().with_viscosity(factor)
        return self.model_copy(update={"heat": self.heat.scaled(factor)})

    def touches(self, force: Array, speed: float) -> bool:
        """At standstill, or where a film as thin as the roughness carries less.

        Not for certain where pads find no such film: then the sample has no answer.
        """
        row = self.geometry if force[2] >= 0 else self.back or self.geometry
        if speed == 0.0:
            return True
        try:
            cold = self.film_model.isothermal()
            carried = row.pressure(self.contact_film, speed, cold).force
        except SolverError:
            return False
        return bool(carried < abs(float(force[2])))

    @model_validator(mode="after")
    def _room_for_a_film(self) -> Self:
        least = 2.0 * self.contact_film
        if self.play <= least:
            raise ValueError(f"play = {self.play:g}: must be > {least:g} m, twice the roughness")
        return self


if TYPE_CHECKING:
    AnyAxial = ThrustCollar | ConePair
else:
    AnyAxial = told_apart({"thrust": ThrustCollar, "conical-pair": ConePair})


class Thrust(Section, BaseModel):
    """The bearings of pads on the shaft, by place.

    ``rung`` is how films of thrust collars are solved: each sample on the grid, or by a curve over
    the gap that is tabulated once (docs/thrust.md). ``grid`` counts the cells of each of their
    pads, along the motion and across. With ``tilt`` the shaft is tilted in them as the beam of its
    suspension is; with ``motion = "transient"`` the collar follows the whole series along its axis,
    which only a curve knows. Written at a collar these are those of all of them.

    Examples
    --------
    >>> from loadflow.scene import make_scene
    >>> lands = {"pads": 8, "inner_radius": 0.8, "outer_radius": 1.2, "pad_angle": 0.7}
    >>> journal = {"kind": "journal", "geometry": {"diameter": 1.4, "width": 1.3,
    ...     "relative_clearance": 1e-3}}
    >>> collar = {"kind": "thrust", "geometry": lands | {"taper": 1e-4}}
    >>> scene = make_scene({"shaft": {"two_point": {}}, "bearings": {"N": journal,
    ...     "N2": [journal, collar]}})
    >>> list(scene.thrust.bearings), scene.wants("thrust")
    (['N2'], True)
    """

    bearings: dict[str, AnyAxial] = {}
    rung: Literal["grid", "curve"] = "grid"
    grid: Cells = (20, 10)
    motion: Literal["quasi-static", "transient"] = "quasi-static"
    tilt: bool = False

    @property
    def in_motion(self) -> bool:
        """Whether the collars follow the whole series; they do not read a reduced one then."""
        return self.motion == "transient" and bool(self.collars)

    @model_validator(mode="after")
    def _motion_needs_a_curve(self) -> Self:
        if self.motion == "transient" and self.rung == "grid":
            if "rung" in self.model_fields_set:
                raise ValueError('motion = "transient" needs a table of films; set rung = "curve"')
            object.__setattr__(self, "rung", "curve")
        return self

    @model_validator(mode="after")
    def _collars_on_it(self) -> Self:
        own = {one.grid for one in self.collars.values() if "grid" in one.model_fields_set}
        stated = own | ({self.grid} if "grid" in self.model_fields_set else set())
        if len(stated) > 1:
            told = " and ".join(str(list(cells)) for cells in sorted(stated))
            raise ValueError(f"grid: collars share one grid, got {told}; keep one")
        for cells in own:
            object.__setattr__(self, "grid", cells)  # as stated at a collar
        self.bearings.update({name: one.on_cells(self.grid) for name, one in self.collars.items()})
        return self

    @property
    def collars(self) -> dict[str, ThrustCollar]:
        """Those of its bearings whose films have rungs."""
        return {name: one for name, one in self.bearings.items() if one.kind == "thrust"}

    @model_validator(mode="after")
    def _curves_need_rigid_pads(self) -> Self:
        for place, one in self.collars.items() if self.rung == "curve" else ():
            if any(map(gives_way, (one.geometry, one.back or one.geometry))):
                known = 'rung = "grid"' if self.motion != "transient" else "motion quasi-static"
                raise ValueError(
                    f"bearings.{place}: pads on springs have no curve over the gap; set {known}"
                )
        return self


def check_thrust(thrust: Thrust, method: str) -> None:
    """Refuse what films of pads cannot be asked for in a scene.

    Raises
    ------
    ValueError
        No such bearing; loads that a film must follow; a collar where forces across the shaft and
        moments have no other bearing.
    """
    if not thrust.bearings:
        raise ValueError('results: thrust.film needs a bearing of kind "thrust" or "conical-pair"')
    if method == "periodic":
        raise ValueError(
            'reduction.method = "periodic": films of pads and cones have no closed orbit; set '
            '"histogram" or "stationary"'
        )
    for place, one in thrust.bearings.items():
        if one.kind == "thrust" and place in ("M", "Y", "P"):
            raise ValueError(
                f"bearings.{place}: a thrust bearing takes neither radial forces nor moments; a "
                '"conical-pair" does'
            )
