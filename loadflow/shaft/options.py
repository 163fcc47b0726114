"""Suspension concepts of Table 2-4 of [Jonuschies 2015]; data only.

Distances are measured along the shaft, downwind from the hub centre (the rotor apex). Every concept
tells its `bearings`, their `positions` (m), which of them are `main_bearings`, the number of the
`locating` one, the `masses` on the shaft as pairs of position (m) and mass (kg), its `integration`,
and its `beam`: None for a rigid shaft.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal, cast

from annotated_types import Ge, Gt

from loadflow.errors import InputError
from loadflow.shaft.beam import Beam

Masses = tuple[tuple[float, float], ...]
Integration = Literal["resolved", "partly integrated", "fully integrated"]
"""How far the drivetrain shares its parts with the suspension, Table 2-3 of [Jonuschies 2015]."""


class _OnTwoSupports:
    """What suspensions with a first support behind the hub and a second one a span apart share."""

    hub_to_first: float
    span: float

    bearings: ClassVar[tuple[str, ...]] = ("N", "N2")
    main_bearings: ClassVar[tuple[str, ...]] = bearings
    locating: ClassVar[int] = 1
    integration: ClassVar[Integration] = "fully integrated"

    def __post_init__(self) -> None:
        _check(cast("Concept", self), positive=("hub_to_first", "span"))

    @property
    def positions(self) -> tuple[float, ...]:
        """Positions of the two supports, m."""
        return self.hub_to_first, self.hub_to_first + self.span

    @property
    def torque_support(self) -> tuple[float, float] | None:
        """Position and lateral arm of a one-sided support of the torque, m; None without one."""
        return None


@dataclass(frozen=True)
class TwoPoint(_OnTwoSupports):
    """Two bearings on the shaft and a slip-on gearbox behind them: hub – N – N2 – gearbox.

    The default distances and the gearbox mass are those of [Jonuschies 2015] (Fig. 5-1).
    It does not give the distance of N from the hub centre; that of the NREL 5 MW turbine is taken.

    Attributes
    ----------
    hub_to_first : float
        Hub centre to the floating bearing N, m.
    span : float
        N to the locating bearing N2, m.
    second_to_gearbox : float
        N2 to the centre of mass of the gearbox, m.
    gearbox_mass : float
        Mass that hangs on the shaft, kg.
    shaft_mass : float
        Mass of the shaft, kg.
    hub_to_shaft_centre : float
        Hub centre to the centre of mass of the shaft, m.
    torque_arm : float
        Lateral distance of a one-sided torque support of the gearbox, m, left of the shaft if
        positive; its reaction to the torque loads the shaft. 0: supports on both sides, whose
        forces cancel.
    beam : Beam, optional
        The shaft as an elastic beam; without, rigid.

    Examples
    --------
    >>> from loadflow.shaft import TwoPoint
    >>> [round(x, 3) for x in TwoPoint(hub_to_first=1.9, span=3.6).positions]
    [1.9, 5.5]
    """

    hub_to_first: Annotated[float, Gt(0)] = 1.912
    span: Annotated[float, Gt(0)] = 3.6
    second_to_gearbox: Annotated[float, Ge(0)] = 1.2
    gearbox_mass: Annotated[float, Ge(0)] = 60e3
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 3.5
    torque_arm: float = 0.0
    beam: Beam | None = None

    integration: ClassVar[Integration] = "resolved"

    @property
    def gearbox_position(self) -> float:
        """Position of the centre of mass of the gearbox, m."""
        return self.hub_to_first + self.span + self.second_to_gearbox

    @property
    def masses(self) -> Masses:
        """Shaft and gearbox."""
        shaft = (self.hub_to_shaft_centre, self.shaft_mass)
        return shaft, (self.gearbox_position, self.gearbox_mass)

    @property
    def torque_support(self) -> tuple[float, float] | None:
        """Position and lateral arm of a one-sided support, m."""
        return (self.gearbox_position, self.torque_arm) if self.torque_arm else None


@dataclass(frozen=True)
class ThreePoint(_OnTwoSupports):
    """One main bearing N, which locates, and the torque arms of the gearbox as second support G.

    The arms stand on both sides; their pair of forces against the torque cancels on the shaft.

    Attributes
    ----------
    hub_to_first : float
        Hub centre to the main bearing N, m.
    span : float
        N to the plane of the torque arms G, m.
    gearbox_offset : float
        Torque arms to the centre of mass of the gearbox, downwind, m.
    gearbox_mass, shaft_mass, hub_to_shaft_centre, beam
        As in `TwoPoint`.

    Examples
    --------
    >>> from loadflow.shaft import ThreePoint
    >>> [round(x, 3) for x in ThreePoint(hub_to_first=1.9, span=4.8).positions]
    [1.9, 6.7]
    """

    hub_to_first: Annotated[float, Gt(0)] = 1.912
    span: Annotated[float, Gt(0)] = 4.8
    gearbox_offset: float = 0.0
    gearbox_mass: Annotated[float, Ge(0)] = 60e3
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 3.5
    beam: Beam | None = None

    bearings: ClassVar[tuple[str, ...]] = ("N", "G")
    main_bearings: ClassVar[tuple[str, ...]] = ("N",)
    locating: ClassVar[int] = 0
    integration: ClassVar[Integration] = "partly integrated"

    @property
    def masses(self) -> Masses:
        """Shaft and gearbox."""
        shaft = (self.hub_to_shaft_centre, self.shaft_mass)
        return shaft, (self.positions[1] + self.gearbox_offset, self.gearbox_mass)


@dataclass(frozen=True)
class Integrated(_OnTwoSupports):
    """Two bearings N, N2 close together in the housing of the gearbox, which the frame carries.

    Its torque reaction stays in the frame. The default distances are assumed.

    Attributes
    ----------
    hub_to_first : float
        Hub centre to the floating bearing N, m.
    span : float
        N to the locating bearing N2, m.
    shaft_mass, hub_to_shaft_centre, beam
        As in `TwoPoint`; the mass is that of the planet carrier as well, where it turns along.

    Examples
    --------
    >>> from loadflow.shaft import Integrated
    >>> len(Integrated(span=1.2).positions)
    2
    """

    hub_to_first: Annotated[float, Gt(0)] = 1.912
    span: Annotated[float, Gt(0)] = 1.2
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 2.5
    beam: Beam | None = None

    @property
    def masses(self) -> Masses:
        """The shaft."""
        return ((self.hub_to_shaft_centre, self.shaft_mass),)


@dataclass(frozen=True)
class DirectDrive(_OnTwoSupports):
    """Two bearings N, N2 and the generator's rotor on the shaft, no gearbox.

    The default distances are those of the IEA 15 MW turbine. The air gap hands its torque to the
    frame; the pull of an eccentric air gap is left out.

    Attributes
    ----------
    hub_to_first : float
        Hub centre to the floating bearing N, m.
    span : float
        N to the locating bearing N2, m.
    generator_mass : float
        Mass of the generator's rotor, kg.
    hub_to_generator : float
        Hub centre to the centre of that mass, m.
    shaft_mass, hub_to_shaft_centre, beam
        As in `TwoPoint`.

    Examples
    --------
    >>> from loadflow.shaft import DirectDrive
    >>> len(DirectDrive(generator_mass=1e5).positions)
    2
    """

    hub_to_first: Annotated[float, Gt(0)] = 1.0
    span: Annotated[float, Gt(0)] = 1.2
    generator_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_generator: Annotated[float, Ge(0)] = 1.6
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 1.6
    beam: Beam | None = None

    @property
    def masses(self) -> Masses:
        """Shaft and generator."""
        shaft = (self.hub_to_shaft_centre, self.shaft_mass)
        return shaft, (self.hub_to_generator, self.generator_mass)


@dataclass(frozen=True)
class MomentBearing:
    """One bearing M that takes force and tilting moment; gearbox and frame carry themselves.

    Attributes
    ----------
    hub_to_bearing : float
        Hub centre to the bearing centre, m.
    shaft_mass : float
        Mass of what turns with the rotor behind the hub, kg.
    hub_to_shaft_centre : float
        Hub centre to the centre of that mass, m.
    beam : Beam, optional
        As in `TwoPoint`.

    Examples
    --------
    >>> from loadflow.shaft import MomentBearing
    >>> MomentBearing(hub_to_bearing=1.9).positions
    (1.9,)
    """

    hub_to_bearing: Annotated[float, Gt(0)] = 1.912
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 1.912
    beam: Beam | None = None

    bearings: ClassVar[tuple[str, ...]] = ("M",)
    main_bearings: ClassVar[tuple[str, ...]] = bearings
    locating: ClassVar[int] = 0
    integration: ClassVar[Integration] = "fully integrated"
    torque_support: ClassVar[None] = None

    def __post_init__(self) -> None:
        _check(self, positive=("hub_to_bearing",))

    @property
    def positions(self) -> tuple[float, ...]:
        """Position of the bearing, m."""
        return (self.hub_to_bearing,)

    @property
    def masses(self) -> Masses:
        """What turns with the rotor."""
        return ((self.hub_to_shaft_centre, self.shaft_mass),)


Concept = TwoPoint | ThreePoint | Integrated | DirectDrive | MomentBearing


def _check(concept: Concept, positive: tuple[str, ...]) -> None:
    if concept.beam is not None:
        concept.beam.supports_of(len(concept.bearings))
    for name, value in vars(concept).items():
        if name == "beam":
            continue
        if not math.isfinite(value):
            raise InputError(f"{name} = {value}: must be finite")
        if name in positive and value <= 0:
            raise InputError(f"{name} = {value} m: must be greater than 0")
        if name.endswith("_mass") and value < 0:
            raise InputError(f"{name} = {value} kg: must not be negative")
