"""Rolling bearings in scenes: geometries of any kind, told apart by ``kind``, and their rings."""

from __future__ import annotations

import math
from dataclasses import fields
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self

from pydantic import (
    BaseModel,
    BeforeValidator,
    TypeAdapter,
    WrapSerializer,
    field_validator,
    model_validator,
)

from loadflow.errors import InputError
from loadflow.numerics.fields import not_one_of
from loadflow.rolling import (
    ARRANGEMENTS,
    KINDS,
    BoltCircle,
    FlexibleRings,
    MatrixRing,
    MeshedRing,
    Mounting,
    Oscillation,
    PitchMotion,
    RingBeam,
    RingSection,
    RollingBearing,
    SlewingBearing,
    Support,
    main_bearings,
)
from loadflow.rolling.friction import CatalogueEntry
from loadflow.rolling.rating.oscillation import idle_torque_of
from loadflow.scene.cooling import Cooling
from loadflow.scene.limits import RollingLimits
from loadflow.scene.places import FOUR_POINT, GEOMETRIES
from loadflow.scene.section import SECTION, told_apart


def _without_kind(value: Any) -> Any:
    if isinstance(value, dict):
        return {name: part for name, part in value.items() if name != "kind"}
    return value


def _with_kind(value: Any, handler: Any) -> Any:
    return {"kind": value.kind} | handler(value)


_PLAIN, _TOLD = BeforeValidator(_without_kind), WrapSerializer(_with_kind)

if TYPE_CHECKING:
    Geometry = RollingBearing
else:
    Geometry = told_apart(
        {kind: Annotated[cls, _PLAIN, _TOLD] for kind, cls in GEOMETRIES.items()}, usual=FOUR_POINT
    )
"""Geometry of a rolling bearing; ``kind`` says which, four-point if nothing is said."""


def standing_ring(
    width: float,
    height: float,
    radius: float,
    wall: tuple[float, float] | None = None,
    face: Literal["bottom", "top"] = "bottom",
) -> RingBeam:
    """Ring of rectangular section about the bearing's middle plane, on a cylindrical wall.

    Parameters
    ----------
    width, height, radius : float
        Of the section, radially and axially, and of its centroid, m.
    wall : tuple of float, optional
        Thickness and length of the wall, m; without it only the ring's mean motion is held.
    face : {"bottom", "top"}
        Which face stands on the wall.

    Raises
    ------
    InputError
        If a measure is not positive.
    """
    section = RingSection.rectangle(width, height)
    if wall is None:
        return RingBeam(section=section, radius=radius)
    foot = height / 2 if face == "top" else -height / 2
    return RingBeam(section=section, radius=radius, supports=(_wall(radius, foot, *wall),))


def around(
    bearing: RollingBearing,
    inner: RingBeam | MatrixRing | MeshedRing | None,
    outer: RingBeam | MatrixRing | MeshedRing | None,
) -> FlexibleRings:
    """Flexible rings of a bearing, one of them at least, on their sides of its balls.

    Raises
    ------
    InputError
        If there is no ring, or its centroid lies on the other side of the pitch circle.
    """
    pitch = bearing.pitch_diameter / 2
    if inner is None and outer is None:
        raise InputError("give inner_ring or outer_ring, of this geometry")
    # a matrix is formed at the raceways, and has no centroid
    if inner is not None and inner.radius is not None and inner.radius >= pitch:
        raise InputError(f"inner_ring: radius must be < {pitch:g} m, got {inner.radius:g}")
    if outer is not None and outer.radius is not None and outer.radius <= pitch:
        raise InputError(f"outer_ring: radius must be > {pitch:g} m, got {outer.radius:g}")
    return FlexibleRings(
        inner=None if inner is None else inner.of(bearing, "inner"),
        outer=None if outer is None else outer.of(bearing, "outer"),
    )


def _wall(radius: float, height: float, thickness: float, length: float) -> Support:
    for name, size in (("radius", radius), ("thickness", thickness), ("length", length)):
        if not (math.isfinite(size) and size > 0):
            raise InputError(f"{name} of the wall: must be > 0 m, got {size:g}")
    return Support.wall(radius, height, thickness, length)


_SECTION, _WALL = {"width", "height"}, {"radius", "height", "thickness", "length"}


def _by_measures(ring: Any) -> Any:
    """A ring whose section is stated as a rectangle, and its supports as walls."""

    def stated(part: Any, names: set[str]) -> bool:
        return (
            isinstance(part, dict)
            and set(part) == names
            and all(isinstance(size, int | float) for size in part.values())
        )

    if not isinstance(ring, dict):
        return ring
    read = dict(ring)
    if stated(ring.get("section"), _SECTION):
        read["section"] = RingSection.rectangle(**ring["section"])
    if isinstance(ring.get("supports"), list):
        read["supports"] = [_held(s, stated(s, _WALL)) for s in ring["supports"]]
    return read


def _held(support: Any, as_wall: bool) -> Any:
    """A support as a wall, as bolts, which have a ``count``, or as it stands."""
    if as_wall:
        return _wall(**support)
    if isinstance(support, dict) and "count" in support:
        known = {part.name for part in fields(BoltCircle)}
        for name in support:
            if name not in known:
                raise InputError(f"{name}: {not_one_of(name, sorted(known))}")
        return TypeAdapter(BoltCircle).validate_python(support)
    return support


if TYPE_CHECKING:
    Ring = RingBeam | MatrixRing | MeshedRing
else:
    Ring = told_apart(
        {
            "beam": Annotated[RingBeam, _PLAIN, BeforeValidator(_by_measures)],
            "matrix": MatrixRing,
            "finite-element": Annotated[MeshedRing, _PLAIN, _TOLD],
        },
        usual="beam",
    )
"""A flexible ring; ``section = {width, height}`` is a rectangle, a support with ``radius``,
``height``, ``thickness`` and ``length`` a wall, and one with a ``count`` a `BoltCircle`. With
``kind = "matrix"`` its ``file`` has the compliance, or the stiffness, of ring, bolts and housing
together; with ``"finite-element"`` the ring is meshed here, with the grooves of its bearing."""


if TYPE_CHECKING:
    Swing = Oscillation | PitchMotion
else:
    Swing = told_apart({"stated": Oscillation, "pitch": PitchMotion}, usual="stated")
"""How a bearing swings; ``kind = "pitch"`` follows the pitch of each series."""


class FurtherBearing(BaseModel):
    """Another rolling bearing of the shaft: its name, its geometry and its rings.

    ``rings = "flexible"`` takes `inner_ring` and `outer_ring`; one that is left out is rigid. With
    an ``oscillation`` it swings, as pitch and yaw bearings do, in place of turning with the rotor.
    With a `mounting` its clearance follows fits, which stretch the sections of flexible rings, and
    temperatures.

    ``roller_model = "whole"`` takes each roller as one contact, without its profile and its tilt.
    ``inertia = true`` counts centrifugal force and gyroscopic moment of the balls, between rigid
    rings; stiffnesses for the shaft and for rotor dynamics are those without them.

    A `catalogue` entry (diameters, series) adds SKF's friction torque to Palmgren's, which stand
    beside ours. `cooling` is that of its housing, or how warm it is; what the section
    ``[friction]`` states goes before it.
    """

    model_config = SECTION

    bearing: str
    geometry: Geometry
    rings: Literal["rigid", "flexible"] = "rigid"
    inner_ring: Ring | None = None
    outer_ring: Ring | None = None
    roller_model: Literal["sliced", "whole"] = "sliced"
    inertia: bool = False
    oscillation: Swing | None = None
    mounting: Mounting | None = None
    catalogue: CatalogueEntry | None = None
    cooling: Cooling | None = None
    limits: RollingLimits = RollingLimits()

    @field_validator("oscillation", mode="before")
    @classmethod
    def _idle_torque_is_named(cls, value: Any) -> Any:
        # before pydantic tells each form that a torque may have by itself
        stated = value.get("idle_torque") if isinstance(value, dict) else None
        if not isinstance(stated, int | float | str | list):
            return value
        try:
            return value | {"idle_torque": idle_torque_of(stated)}
        except InputError as error:
            raise ValueError(str(error)) from error

    @model_validator(mode="after")
    def _rings_fit(self) -> Self:
        try:
            _ = self.ring_model
        except InputError as error:
            raise ValueError(f'rings = "flexible": {error}') from error
        return self

    @model_validator(mode="after")
    def _has_seats(self) -> Self:
        if self.mounting is not None:
            cold = self.mounting.reference_temperature
            self.mounting.gap_growth(self.geometry, cold, cold, *self._sections)
        return self

    @model_validator(mode="after")
    def _is_in_the_catalogue(self) -> Self:
        if self.catalogue is not None:
            try:
                self.catalogue.check(self.geometry)
            except InputError as error:
                raise ValueError(f"catalogue.{error}") from error
        return self

    @model_validator(mode="after")
    def _elements_fit(self) -> Self:
        kind = self.geometry.kind
        if self.roller_model == "whole" and self.geometry.element != "roller":
            raise ValueError(f'roller_model = "whole": a {kind} bearing has no rollers')
        if self.inertia and not self.can_have_inertia:
            known = ", ".join(kind for kind, cls in KINDS.items() if cls.element_inertia)
            raise ValueError(
                f"inertia: that of balls is modelled in bearings of kind {known} with rigid rings "
                f'that turn with the rotor; this one is of kind {kind}, rings = "{self.rings}"'
                f"{', and swings' if self.oscillation else ''}"
            )
        return self

    @property
    def can_have_inertia(self) -> bool:
        """Whether the inertia of its elements can be counted."""
        return self.geometry.element_inertia and self.rings == "rigid" and self.oscillation is None

    @property
    def balances_heat(self) -> bool:
        """Whether its friction warms it: one that swings, or has no model, is as warm as stated."""
        return self.geometry.friction_model is not None and self.oscillation is None

    @property
    def modelled(self) -> RollingBearing:
        """The geometry with its rollers in slices, or whole."""
        whole = self.roller_model == "whole"
        return self.geometry.with_whole_rollers() if whole else self.geometry

    @property
    def idle_torque(self) -> float:
        """Friction without load of a bearing that swings, N m; 0 of others."""
        return 0.0 if self.oscillation is None else idle_torque_of(self.oscillation.idle_torque)

    def at_work(self, temperature: float, ambient: float) -> Self:
        """Return the bearing with the clearance of its mounting at a temperature, K.

        Raises
        ------
        loadflow.errors.SolverError
            If it has no clearance there.
        """
        if self.mounting is None:
            return self
        sections = self._sections if self.rings == "flexible" else ()
        warm = self.mounting.at_work(self.geometry, temperature, ambient, *sections)
        return self.model_copy(update={"geometry": warm})

    @property
    def _sections(self) -> tuple[RingBeam | MeshedRing | None, RingBeam | MeshedRing | None]:
        """Rings with sections of their own, inner and outer; one given by its matrix has none."""
        rings = self.inner_ring, self.outer_ring
        inner, outer = (None if isinstance(ring, MatrixRing) else ring for ring in rings)
        return inner, outer

    @property
    def ring_model(self) -> Literal["rigid"] | FlexibleRings:
        """What `RollingBearing.equilibrium` takes as its rings."""
        if self.rings == "rigid":
            return "rigid"
        if not self.geometry.flexible_rings:
            known = ", ".join(kind for kind, cls in KINDS.items() if cls.flexible_rings)
            raise InputError(f"rings of a {self.geometry.kind} bearing are rigid; not of {known}")
        return around(self.modelled, self.inner_ring, self.outer_ring)


class Rolling(FurtherBearing):
    """Rolling bearing: which one of the shaft, its geometry, material and limits.

    A scene may give several, as a list ``[[rolling]]`` or as an ``arrangement`` of
    `loadflow.rolling.main_bearings`; those after the first are in ``further``. The key ``kind`` of
    a geometry says which bearing it is: four-point (if nothing is said; slewing is the same), ball,
    roller, spherical, crossed or three-row.

    ``rings = "flexible"`` takes `inner_ring` and `outer_ring`; one that is left out is rigid,
    unless both and the geometry are. The rings of the default bearing have the diameters of
    [Ritzer 2018] App. B; their height, and the walls of 60 mm and 1 m that they stand on, are
    assumed.
    """

    bearing: str = "M"
    geometry: Geometry = SlewingBearing(
        balls=129,
        rows=2,
        ball_diameter=0.040,
        pitch_diameter=1.9,
        groove_radius=0.0205,
        contact_angle=0.7853981633974483,
        hardness=600.0,
        life_hardness_factor=0.85,
    )
    inner_ring: Ring | None = standing_ring(0.094, 0.12, 0.897, wall=(0.06, 1.0), face="top")
    outer_ring: Ring | None = standing_ring(0.099, 0.12, 1.0005, wall=(0.06, 1.0))
    further: list[FurtherBearing] = []

    @model_validator(mode="before")
    @classmethod
    def _one_of_several(cls, data: Any) -> Any:
        """Turn a list, or the name of an arrangement, into the first bearing and further ones.

        Beside a geometry or a ring of the scene, the default rings do not stay.
        """
        if isinstance(data, list) and data and all(isinstance(part, dict) for part in data):
            data = data[0] | {"further": data[1:]}
        if isinstance(data, dict) and "arrangement" in data:
            if {"bearing", "geometry", "further"} & set(data):
                raise ValueError("arrangement: gives bearing and geometry; leave them out")
            if not isinstance(data["arrangement"], str):
                raise ValueError(f"arrangement: {not_one_of(data['arrangement'], ARRANGEMENTS)}")
            chosen = main_bearings(data["arrangement"])
            rest = {name: value for name, value in data.items() if name != "arrangement"}
            first, *others = ({"bearing": b, "geometry": g} for b, g in chosen.items())
            data = rest | first | {"further": others}
        if isinstance(data, dict) and {"geometry", "inner_ring", "outer_ring"} & set(data):
            return {"inner_ring": None, "outer_ring": None} | data
        return data

    @model_validator(mode="after")
    def _names_differ(self) -> Self:
        if len(self.geometries) != 1 + len(self.further):
            raise ValueError("bearing: each must have a name of its own")
        return self

    @property
    def bearings(self) -> dict[str, FurtherBearing]:
        """All bearings by name, the first one first."""
        return {part.bearing: part for part in (self, *self.further)}

    @property
    def geometries(self) -> dict[str, Geometry]:
        """Geometry of all bearings by name."""
        return {name: part.geometry for name, part in self.bearings.items()}

    @property
    def system_life(self) -> float:
        """Life that all bearings are to have as a system, h: the shortest one asked of them."""
        return min(part.limits.life for part in self.bearings.values())

    @property
    def rung(self) -> Literal["rigid", "flexible"]:
        """Model in the ladder: flexible if the rings of any bearing are."""
        return "flexible" if any(b.rings == "flexible" for b in self.bearings.values()) else "rigid"
