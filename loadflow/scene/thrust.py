"""Film bearings of a scene that carry the force along the shaft: thrust collars, pairs of cones."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BaseModel,
    BeforeValidator,
    Field,
    WrapSerializer,
    field_validator,
    model_validator,
)

from loadflow.errors import InputError, SolverError
from loadflow.journal import (
    ConicalPair,
    DoubleThrustBearing,
    DoubleThrustResult,
    Film,
    Guembel,
    Lubricant,
    PairResult,
    ThrustBearing,
)
from loadflow.journal.thrust_curves import CollarCurves, CollarFilms, gives_way
from loadflow.scene.films import Law
from loadflow.scene.limits import FilmLimits
from loadflow.scene.section import Section, told_apart

Positive = Annotated[float, Field(gt=0)]
Cells = tuple[Annotated[int, Field(ge=8, le=320)], Annotated[int, Field(ge=4, le=160)]]
Array = NDArray[np.float64]


def _finite(value: Any) -> Any:
    """Plain data without what is infinite, which is what rigid supports have by default."""
    if isinstance(value, Mapping):
        kept = {name: _finite(part) for name, part in value.items()}
        return {name: part for name, part in kept.items() if part != math.inf}
    return value


def _both_alike(pair: Any) -> Any:
    """A pair of which the right cone is left out: as the left one."""
    if isinstance(pair, Mapping) and "left" in pair and "right" not in pair:
        return {**pair, "right": pair["left"]}
    return pair


def _told(value: Any, handler: Any) -> Any:
    return _finite(handler(value))


if TYPE_CHECKING:
    Lands = ThrustBearing
    Cones = ConicalPair
else:
    Lands = Annotated[ThrustBearing, WrapSerializer(_told)]
    Cones = Annotated[ConicalPair, BeforeValidator(_both_alike), WrapSerializer(_told)]


UNKNOWN_TO_PADS = frozenset(
    ("motion", "heat", "shell", "contact", "supply", "inlet", "tilt", "rung", "grading")
)
"""Keys of journal bearings that those of pads do not have: at rest, at one temperature, aligned."""


class AxialBearing(Section, BaseModel):
    """What bearings of pads share in a scene: the film, the surfaces, what they must hold.

    Films of pads know one temperature, rigid pads (their supports may give way), no contact and no
    motion: keys for these are refused. `boundary_friction` is that of surfaces that touch.
    """

    lubricant: Lubricant = Lubricant(viscosity=0.050)
    cavitation: Law = Guembel()
    edge_pressure: Annotated[float, Field(ge=0)] = 0.1e6
    grid: Cells = (20, 10)
    shaft_roughness: Positive = 1.3e-6
    shell_roughness: Positive = 2.5e-6
    boundary_friction: Annotated[float, Field(gt=0, le=1)] = 0.15
    limits: FilmLimits = FilmLimits()

    @model_validator(mode="before")
    @classmethod
    def _no_more_than_pads_know(cls, data: Any) -> Any:
        for name in UNKNOWN_TO_PADS & {*data} if isinstance(data, dict) else ():
            raise ValueError(f"{name}: films of pads and cones do not know it; leave it out")
        return data

    @field_validator("lubricant")
    @classmethod
    def _even(cls, value: Lubricant) -> Lubricant:
        if value.pressure_coefficient > 0:
            raise ValueError("pressure_coefficient: films of pads and cones do not know it")
        return value

    @property
    def contact_film(self) -> float:
        """Film, m, below which the surfaces touch: the sum of their R_z."""
        return self.shaft_roughness + self.shell_roughness

    @property
    def least_film(self) -> float:
        """Smallest film allowed, m."""
        return self.limits.least_film(self.contact_film)

    @property
    def film_model(self) -> Film:
        """The film that these keys describe."""
        return Film(
            lubricant=self.lubricant,
            cavitation=self.cavitation,
            edge_pressure=self.edge_pressure,
            inlet=None,
            grid=self.grid,
        )

    @property
    @abstractmethod
    def radius(self) -> float:
        """Mean radius of the film, m."""

    @property
    @abstractmethod
    def clearance(self) -> float:
        """Film, m, where the bearing is centred and its pads leave the least."""

    @property
    @abstractmethod
    def words(self) -> str:
        """What it is."""

    @property
    @abstractmethod
    def measures(self) -> str:
        """Its measures, in words."""

    @abstractmethod
    def normal_load(self, force: Array, moment: Array) -> Array:
        """Load (n,) that presses on the films under force and moment (n, 3) of the bearing, N.

        It tells which samples are the hard ones; force and moment are in the frame of the bearing,
        whose third axis is that of the shaft.
        """

    @abstractmethod
    def solve(self, force: Array, moment: Array, speed: float) -> DoubleThrustResult | PairResult:
        """Equilibrium under a force (3,), N, and a moment (3,), N m, in the frame of the bearing.

        Raises
        ------
        loadflow.errors.SolverError
            No film carries it.
        """

    def by_curve(self, force: Array, speed: Array) -> CollarFilms | None:
        """Films under forces (n, 3) by interpolation in a table of them; None where none is."""
        return None

    @abstractmethod
    def with_clearance(self, change: float) -> Self:
        """The bearing with its clearance changed by `change`, m.

        Raises
        ------
        loadflow.errors.InputError
            No clearance is left.
        """

    @abstractmethod
    def touches(self, force: Array, speed: float) -> bool:
        """Whether surfaces touch for certain under a load that no film was found to carry."""


class ThrustCollar(AxialBearing):
    """Thrust bearing beside journal bearings: a collar between two rows of pads.

    It carries the force along the shaft both ways, and neither radial forces nor moments; its films
    are solved as if the pads stayed aligned with the collar. ``geometry`` is that of the row that
    carries thrust downwind, ``back`` of the other one, alike if left out; ``play`` is what the
    collar moves from one row to the other, m.
    """

    kind: Literal["thrust"] = "thrust"
    geometry: Lands
    back: Lands | None = None
    play: Positive = 4e-4

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
            f"{1e6 * self.play:.0f} µm, {1e3 * self.lubricant.viscosity:.3g} mPa s"
        )

    def normal_load(self, force: Array, moment: Array) -> Array:
        """The force along the shaft."""
        return np.abs(force[:, 2])

    def solve(self, force: Array, moment: Array, speed: float) -> DoubleThrustResult:
        """Place of the collar under the force along the shaft."""
        return self.bearing.equilibrium(float(force[2]), speed, self.film_model)

    def by_curve(self, force: Array, speed: Array) -> CollarFilms:
        """Places of the collar, of films tabulated down to half the sum of their R_z."""
        return CollarCurves(self.bearing, self.film_model, 0.5 * self.contact_film).equilibrium(
            force[:, 2], speed
        )

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

    def touches(self, force: Array, speed: float) -> bool:
        """At standstill, or where a film as thin as the roughness carries less.

        Not for certain where pads find no such film: then the sample has no answer.
        """
        row = self.geometry if force[2] >= 0 else self.back or self.geometry
        if speed == 0.0:
            return True
        try:
            carried = row.pressure(self.contact_film, speed, self.film_model).force
        except SolverError:
            return False
        return bool(carried < abs(float(force[2])))

    @model_validator(mode="after")
    def _room_for_a_film(self) -> Self:
        least = 2.0 * self.contact_film
        if self.play <= least:
            raise ValueError(f"play = {self.play:g}: must be > {least:g} m, twice the roughness")
        return self


class ConePair(AxialBearing):
    """Two cones against each other, which locate the shaft: forces and moments.

    The cone ``geometry.left`` is upwind; ``geometry.right`` is like it if left out.
    """

    kind: Literal["conical-pair"] = "conical-pair"
    geometry: Cones

    @property
    def radius(self) -> float:
        """Mean radius of the left cone, m."""
        cone = self.geometry.left
        return 0.5 * sum(cone.slant) * math.sin(cone.half_angle)

    @property
    def clearance(self) -> float:
        """Normal to the cones, m."""
        pair = self.geometry
        return pair.left.clearance if pair.clearance is None else pair.clearance

    @property
    def words(self) -> str:
        """What it is."""
        pads = self.geometry.left.pads
        rows = "whole rings" if pads is None else f"{pads} segments each"
        return f"pair of cones in {self.geometry.arrangement}, {rows}"

    @property
    def measures(self) -> str:
        """Its measures, in words."""
        cone, pair = self.geometry.left, self.geometry
        return (
            f"mean D {2e3 * self.radius:.0f} mm, B {1e3 * (cone.slant[1] - cone.slant[0]):.0f} mm "
            f"along the cone, {math.degrees(cone.half_angle):.0f}°, {1e3 * pair.distance:.0f} mm "
            f"apart, clearance {1e6 * self.clearance:.0f} µm, "
            f"{1e3 * self.lubricant.viscosity:.3g} mPa s"
        )

    def normal_load(self, force: Array, moment: Array) -> Array:
        """Load normal to the film of the harder pressed cone, if each took its part alone."""
        angle, pair = self.geometry.left.half_angle, self.geometry
        across = np.hypot(force[:, 0], force[:, 1])
        turning = np.hypot(moment[:, 0], moment[:, 1])
        radial = 0.5 * across + turning / pair.distance
        return np.asarray(radial / math.cos(angle) + np.abs(force[:, 2]) / math.sin(angle))

    def solve(self, force: Array, moment: Array, speed: float) -> PairResult:
        """Place and tilt of the shaft."""
        return self.geometry.equilibrium(force, moment[:2], speed, self.film_model)

    def with_clearance(self, change: float) -> Self:
        """With another clearance normal to the cones, centred."""
        pair = self.geometry
        if pair.clearance is not None:
            other = replace(pair, clearance=pair.clearance + change)
        else:
            cones = [replace(c, clearance=c.clearance + change) for c in (pair.left, pair.right)]
            other = replace(pair, left=cones[0], right=cones[1])
        return self.model_copy(update={"geometry": other})

    def touches(self, force: Array, speed: float) -> bool:
        """At standstill; while turning the cones may carry, whatever the solver found."""
        return speed == 0.0


if TYPE_CHECKING:
    AnyAxial = ThrustCollar | ConePair
else:
    AnyAxial = told_apart({"thrust": ThrustCollar, "conical-pair": ConePair})


class Thrust(Section, BaseModel):
    """The bearings of pads on the shaft, by place.

    ``rung`` is how films of thrust collars are solved: each sample on the grid, or by a curve over
    the gap that is tabulated once (docs/thrust.md). ``grid`` counts the cells of each of their
    pads, along the motion and across; written at a collar it is that of all of them.

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
                raise ValueError(
                    f"bearings.{place}: pads on springs have no curve over the gap; set "
                    'rung = "grid"'
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
