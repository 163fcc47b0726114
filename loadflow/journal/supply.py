"""How oil reaches the film: grooves and pockets of the shell, restrictors, pump."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Annotated, Literal

import numpy as np
from annotated_types import Ge, Gt, MinLen
from numpy.typing import NDArray

from loadflow.journal.lubricant import Lubricant
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

_TURN = 6.283185307179586


class _Restrictor:
    """What a groove, a pump or a heat balance asks of a restrictor."""

    laminar = False
    """Whether flow times viscosity alone tells the pressure that is lost."""

    @property
    def given_flow(self) -> float | None:
        """Flow that it keeps whatever the pressure, m³/s; None: the flow follows."""
        return None

    def drops(self, lubricant: Lubricant) -> tuple[float, float]:
        """Pressure that is lost over the flow, Pa s/m³, and over its square, Pa s²/m⁶."""
        return 0.0, 0.0

    def pressure_drop(self, flow: float, lubricant: Lubricant) -> tuple[float, float]:
        """Pressure that `flow` (m³/s) loses, Pa, and its slope."""
        linear, quadratic = self.drops(lubricant)
        size = abs(flow)
        return (linear + quadratic * size) * flow, linear + 2 * quadratic * size


@dataclass(frozen=True)
class Capillary(_Restrictor):
    """Laminar restrictor: Δp = 128 η l Q/(π d⁴).

    Attributes
    ----------
    diameter, length : float
        Of the bore, m.

    Examples
    --------
    >>> from loadflow.journal import Capillary, Groove
    >>> pocket = Groove(angle=0.0, arc=0.4, length=0.05, restrictor=Capillary(2e-3, 0.1))
    """

    diameter: Annotated[float, Gt(0)]
    length: Annotated[float, Gt(0)]

    laminar = True

    def __post_init__(self) -> None:
        require(self.diameter > 0, "diameter", self.diameter, "must be > 0 m")
        require(self.length > 0, "length", self.length, "must be > 0 m")

    def drops(self, lubricant: Lubricant) -> tuple[float, float]:
        """Pressure that is lost over the flow, Pa s/m³, and over its square, which loses none."""
        return 128 * lubricant.viscosity * self.length / (np.pi * self.diameter**4), 0.0


@dataclass(frozen=True)
class Orifice(_Restrictor):
    """Sharp-edged restrictor: Δp = ρ/2 (Q/(α A))².

    Attributes
    ----------
    diameter : float
        Of the bore, m.
    discharge_coefficient : float
        α.

    Examples
    --------
    >>> from loadflow.journal import Groove, Orifice
    >>> pocket = Groove(angle=0.0, arc=0.4, length=0.05, restrictor=Orifice(diameter=2e-3))
    """

    diameter: Annotated[float, Gt(0)]
    discharge_coefficient: Annotated[float, Gt(0)] = 0.62

    def __post_init__(self) -> None:
        require(self.diameter > 0, "diameter", self.diameter, "must be > 0 m")
        alpha = self.discharge_coefficient
        require(alpha > 0, "discharge_coefficient", alpha, "> 0")

    def drops(self, lubricant: Lubricant) -> tuple[float, float]:
        """Pressure that is lost over the flow, which is none, and over its square, Pa s²/m⁶."""
        area = self.discharge_coefficient * 0.25 * np.pi * self.diameter**2
        return 0.0, 0.5 * lubricant.density / area**2


@dataclass(frozen=True)
class ConstantFlow(_Restrictor):
    """Flow control: one pump for each pocket, or a valve that keeps its flow.

    Attributes
    ----------
    flow : float
        Q, m³/s.

    Examples
    --------
    >>> from loadflow.journal import ConstantFlow, Groove
    >>> pocket = Groove(angle=0.0, arc=0.4, length=0.05, restrictor=ConstantFlow(flow=1e-5))
    """

    flow: Annotated[float, Gt(0)]

    def __post_init__(self) -> None:
        require(self.flow > 0, "flow", self.flow, "must be > 0 m³/s")

    @property
    def given_flow(self) -> float:
        """Its flow, m³/s."""
        return self.flow


Restrictor = Capillary | Orifice | ConstantFlow


@dataclass(frozen=True)
class Groove:
    """Groove or pocket of the shell, under one pressure.

    The length along the axis and the arc make it an axial groove, a circumferential groove
    (``arc=2π``) or a rectangular pocket; ``shape="circle"`` makes a spot.

    Attributes
    ----------
    angle : float
        Angle of its middle from the first axis toward the second, rad.
    arc : float
        Angle it spans, rad; 0 is a line, which takes one column of cells (of a circle it follows
        from `length`).
    length : float, optional
        Axial length, or diameter of a circle, m; default the full width.
    pressure : float
        Its pressure, or that before its `restrictor`, Pa, absolute. Not used with a pump.
    axial : float
        Distance of its middle from mid-plane, m. A groove off mid-plane is a pair, mirrored about
        mid-plane and fed as one.
    shape : {"rectangle", "circle"}
        Its outline in the developed shell.
    restrictor : Capillary, Orifice or ConstantFlow, optional
        What the oil passes on its way in; the pressure of the groove then follows from the flow
        into the film.

    Examples
    --------
    >>> import math
    >>> from loadflow.journal import Groove, Supply
    >>> at_sides = (math.pi / 2, -math.pi / 2)
    >>> two = tuple(Groove(angle=a, arc=0.3, length=0.07, pressure=2e5) for a in at_sides)
    >>> len(Supply(two).grooves)
    2
    """

    angle: float
    arc: Annotated[float, Ge(0)] = 0.0
    length: Annotated[float, Gt(0)] | None = None
    pressure: float = 0.0
    axial: Annotated[float, Ge(0)] = 0.0
    shape: Literal["rectangle", "circle"] = "rectangle"
    restrictor: Restrictor | None = None

    def __post_init__(self) -> None:
        require(0 <= self.arc <= _TURN + 1e-9, "arc", self.arc, "rad, 0 … 2π")
        require(self.length is None or self.length > 0, "length", self.length, "must be > 0 m")
        require(self.axial >= 0, "axial", self.axial, "must be ≥ 0 m")
        require(self.shape in ("rectangle", "circle"), "shape", self.shape, "rectangle or circle")
        if self.shape == "circle":
            require(self.length is not None, "length", self.length, "the diameter of a circle, m")
            require(self.arc == 0, "arc", self.arc, "0 for a circle, whose length is its diameter")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if self.restrictor is not None and self.restrictor.given_flow is not None:
            yield "pressure", "its flow is given, whatever the pressure"
        if self.arc >= _TURN:
            yield "angle", "the groove runs round"


@dataclass(frozen=True)
class Pump:
    """Pump that feeds all grooves, with a line between.

    Attributes
    ----------
    flow : tuple of float
        Flow at the points of its curve, m³/s, increasing.
    pressure : tuple of float
        Pressure there, Pa, absolute, not increasing; straight lines between and beyond. One point
        is a constant pressure.
    line : Capillary or Orifice, optional
        Resistance between pump and grooves.

    Examples
    --------
    A pump of 200 l/min at 0.6 MPa whose pressure falls to nothing at 240 l/min:

    >>> pump = Pump(flow=(0.0, 200 / 60e3, 240 / 60e3), pressure=(0.65e6, 0.6e6, 0.0))
    """

    flow: Annotated[tuple[float, ...], MinLen(1)]
    pressure: Annotated[tuple[float, ...], MinLen(1)]
    line: Capillary | Orifice | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "flow", tuple(map(float, self.flow)))
        object.__setattr__(self, "pressure", tuple(map(float, self.pressure)))
        require(len(self.flow) > 0, "flow", self.flow, "m³/s, one point or more")
        rising = all(a < b for a, b in zip(self.flow, self.flow[1:]))
        require(rising, "flow", self.flow, "m³/s, increasing")
        same = len(self.flow) == len(self.pressure)
        require(
            same, "pressure", self.pressure, f"Pa, one value for each of {len(self.flow)} flows"
        )
        falling = all(a >= b for a, b in zip(self.pressure, self.pressure[1:]))
        require(falling, "pressure", self.pressure, "Pa, not increasing with flow")

    def idle(self) -> Iterator[tuple[str, str]]:
        """Fields without effect beside the others, and why."""
        if len(self.flow) == 1:
            yield "flow", "one point is a constant pressure, whatever the flow"

    def at(self, flow: float) -> tuple[float, float]:
        """Pressure at `flow` (m³/s), Pa, and its slope."""
        return at_pump(np.array(self.flow), np.array(self.pressure), flow)


def at_pump(flows: Array, pressures: Array, flow: float) -> tuple[float, float]:
    """Pressure of a curve `flows`, `pressures` (n,) at a `flow`, and its slope; compiled, too."""
    if flows.size == 1:
        return pressures[0], 0.0
    part = 0
    while part < flows.size - 2 and flow > flows[part + 1]:
        part += 1
    slope = (pressures[part + 1] - pressures[part]) / (flows[part + 1] - flows[part])
    return pressures[part] + slope * (flow - flows[part]), slope


@dataclass(frozen=True)
class Supply:
    """Lubricant supply through grooves and pockets of the shell.

    Attributes
    ----------
    grooves : tuple of Groove
        Grooves; they must not overlap.
    pump : Pump, optional
        What feeds them all; without it each groove has its own pressure.
    tank_pressure : float
        Pressure from which the oil is raised, Pa, absolute; only for the supply power.

    Examples
    --------
    >>> from loadflow.journal import Groove, JournalBearing, Lubricant, Supply
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> fed = Supply((Groove(angle=3.14159, arc=0.3, length=0.07, pressure=2e5),))
    >>> state = bearing.equilibrium((2e4, 0.0), 50.0, Lubricant(0.05), supply=fed, grid=(36, 8))
    >>> bool(state.supply_flow > 0.0)
    True
    """

    grooves: tuple[Groove, ...] = ()
    pump: Pump | None = None
    tank_pressure: float = 0.0

    def __post_init__(self) -> None:
        object.__setattr__(self, "grooves", tuple(self.grooves))
        if self.pump is not None:
            require(len(self.grooves) > 0, "grooves", self.grooves, "one or more with a pump")
            for number, groove in enumerate(self.grooves):
                name = f"grooves[{number}].pressure"
                require(groove.pressure == 0, name, groove.pressure, "not given with a pump")
