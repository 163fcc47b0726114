"""What film bearings of pads share in a scene, and the pair of cones among them."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Literal, Self

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

from loadflow.journal import (
    ConicalPair,
    DoubleThrustResult,
    Film,
    Guembel,
    Lubricant,
    PairResult,
    ThrustBearing,
)
from loadflow.journal.thrust.curves import CollarFilms
from loadflow.scene.films import Law
from loadflow.scene.limits import FilmLimits
from loadflow.scene.section import Section

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


UNKNOWN_TO_PADS = frozenset(("shell", "contact", "supply", "inlet", "grading", "turbulence"))
"""Keys of journal bearings that those of pads do not have."""

UNKNOWN_TO_CONES = frozenset(("motion", "heat", "tilt", "rung"))
"""Keys of collars that pairs of cones do not have: at rest, at one temperature, tilting freely."""


class AxialBearing(Section, BaseModel):
    """What bearings of pads share in a scene: the film, the surfaces, what they must hold.

    Films of pads know rigid pads (their supports may give way) and no contact: keys for these are
    refused. `boundary_friction` is that of surfaces that touch.
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
        unknown = UNKNOWN_TO_PADS | cls._unknown
        for name in sorted(unknown & {*data}) if isinstance(data, dict) else ():
            raise ValueError(f"{name}: films of pads and cones do not know it; leave it out")
        return data

    _unknown: ClassVar[frozenset[str]] = frozenset()
    """Further keys that a kind refuses by name."""

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
    def oil(self) -> Lubricant:
        """The oil as it enters."""
        return self.lubricant

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
    def solve(
        self, force: Array, moment: Array, speed: float, tilt: Array | None = None
    ) -> DoubleThrustResult | PairResult:
        """Equilibrium under a force (3,), N, and a moment (3,), N m, in the frame of the bearing.

        A collar is held at a `tilt` (2,), rad, aligned by default; cones find their own.

        Raises
        ------
        loadflow.errors.SolverError
            No film carries it.
        """

    def by_curve(
        self, force: Array, speed: Array, tilt: Array | None = None, time: Array | None = None
    ) -> CollarFilms | None:
        """Films under forces (n, 3) by interpolation in a table of them; None where none is."""
        return None

    def with_viscosity(self, factor: float) -> Self:
        """The bearing with an oil so many times as thick."""
        oil = replace(self.lubricant, viscosity=factor * self.lubricant.viscosity)
        return self.model_copy(update={"lubricant": oil})

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


class ConePair(AxialBearing):
    """Two cones against each other, which locate the shaft: forces and moments.

    The cone ``geometry.left`` is upwind; ``geometry.right`` is like it if left out.
    """

    _unknown: ClassVar[frozenset[str]] = UNKNOWN_TO_CONES

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

    def solve(
        self, force: Array, moment: Array, speed: float, tilt: Array | None = None
    ) -> PairResult:
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
