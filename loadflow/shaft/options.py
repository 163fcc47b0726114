"""Suspension concepts of Table 2-4 of the source [Jonuschies 2015]; data only.

Distances are measured along the shaft, downwind from the hub centre (the rotor apex).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, ClassVar

from annotated_types import Ge, Gt

from loadflow.errors import InputError


@dataclass(frozen=True)
class TwoPoint:
    """Two bearings on the shaft and a slip-on gearbox behind them: hub – N – N2 – gearbox.

    The default distances and the gearbox mass are those of the source (Fig. 5-1); it does not give
    the distance of N from the hub centre, which is that of the NREL 5 MW turbine.

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
    """

    hub_to_first: Annotated[float, Gt(0)] = 1.912
    span: Annotated[float, Gt(0)] = 3.6
    second_to_gearbox: Annotated[float, Ge(0)] = 1.2
    gearbox_mass: Annotated[float, Ge(0)] = 60e3
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 3.5
    torque_arm: float = 0.0

    bearings: ClassVar[tuple[str, str]] = ("N", "N2")

    def __post_init__(self) -> None:
        _check(self, positive=("hub_to_first", "span"))

    @property
    def positions(self) -> tuple[float, float]:
        """Positions of the two supports, m."""
        return self.hub_to_first, self.hub_to_first + self.span

    @property
    def gearbox_position(self) -> float:
        """Position of the centre of mass of the gearbox, m."""
        return self.hub_to_first + self.span + self.second_to_gearbox


@dataclass(frozen=True)
class ThreePoint:
    """One main bearing N, which locates, and the torque arms of the gearbox as second support G.

    Attributes
    ----------
    hub_to_first : float
        Hub centre to the main bearing N, m.
    span : float
        N to the plane of the torque arms G, m.
    gearbox_offset : float
        Torque arms to the centre of mass of the gearbox, downwind, m.
    gearbox_mass, shaft_mass, hub_to_shaft_centre
        As in `TwoPoint`.
    """

    hub_to_first: Annotated[float, Gt(0)] = 1.912
    span: Annotated[float, Gt(0)] = 4.8
    gearbox_offset: float = 0.0
    gearbox_mass: Annotated[float, Ge(0)] = 60e3
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 3.5

    bearings: ClassVar[tuple[str, str]] = ("N", "G")
    torque_arm: ClassVar[float] = 0.0

    def __post_init__(self) -> None:
        _check(self, positive=("hub_to_first", "span"))

    @property
    def positions(self) -> tuple[float, float]:
        """Positions of the two supports, m."""
        return self.hub_to_first, self.hub_to_first + self.span

    @property
    def gearbox_position(self) -> float:
        """Position of the centre of mass of the gearbox, m."""
        return self.hub_to_first + self.span + self.gearbox_offset


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
    """

    hub_to_bearing: Annotated[float, Gt(0)] = 1.912
    shaft_mass: Annotated[float, Ge(0)] = 0.0
    hub_to_shaft_centre: Annotated[float, Ge(0)] = 1.912

    bearings: ClassVar[tuple[str]] = ("M",)

    def __post_init__(self) -> None:
        _check(self, positive=("hub_to_bearing",))


Concept = TwoPoint | ThreePoint | MomentBearing


def _check(concept: Concept, positive: tuple[str, ...]) -> None:
    for name, value in vars(concept).items():
        if not math.isfinite(value):
            raise InputError(f"{name} = {value}: must be finite")
        if name in positive and value <= 0:
            raise InputError(f"{name} = {value} m: must be greater than 0")
        if name.endswith("_mass") and value < 0:
            raise InputError(f"{name} = {value} kg: must not be negative")
