"""Laws of cavitation: what a film does where its pressure would fall below what oil bears.

A law is one class: its parameters, what the mesh and the solvers must know of it, and the function
that gives pressure and fill of cells, compiled on first use. To add one, write a class with a
function `cells` and add it to `LAWS`; scenes and the command line then know it by its `kind`.

One unknown u of a cell stands for pressure and fill: the pressure in the full film, and a measure
of its lack in the ruptured film. A law says for each u (rows of the state, and their derivatives)

======== =====================================================================================
`P`      pressure that drives the flow, Pa
`FILL`   share F of liquid in the gap
`SLACK`  what the balance of a cell may lack, of a complementarity
`LOAD`   pressure that carries
======== =====================================================================================
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Annotated, Any, ClassVar, Self

import numpy as np
from annotated_types import Gt
from numpy.typing import NDArray

from loadflow.numerics.fields import require

Array = NDArray[np.float64]

# rows of the state of the cells
P, DP, FILL, DFILL, SLACK, DSLACK, LOAD, DLOAD = range(8)

FILLS = 0.1
"""Pressure over its scale that a cell may take in the Newton step in which it fills."""

Cells = Callable[[Any, float, int, Any, Any], None]
"""``cells(numbers, scale, count, u, state)``: write the `count` columns of each row of `state`.

All arrays are flat: row r of cell i is ``state[r * count + i]``. `numbers` are those of the law,
`scale` is the scale of pressure, Pa. Plain Python that numba compiles, without calls.
"""


@dataclass(frozen=True)
class CavitationLaw:
    """What every law says of itself; this is a film that never ruptures.

    Attributes
    ----------
    kind : str
        Name in scenes and on the command line.
    ruptures : bool
        Whether pressures are limited from below.
    smooth : bool
        Whether pressure and fill have no kink: a coarse, uniform mesh serves then.
    keeps_fill : bool
        Whether the fill is a state of its own: it has a history, its cells must not move, and oil
        must enter somewhere.
    inlet_line : bool
        Whether the oil is replaced on a line at the widest gap (ISO 7902) if nothing else is said.
    moves_by_cells : bool
        Whether the law is a complementarity, whose rupture moves by one cell in a Newton step.
    cuts_load : bool
        Whether pressures below the floor stay in the film and only carry nothing.
    keeps_mass : bool
        Whether what flows out of a cell at rest has flowed into it, so that it can carry heat.
    """

    kind: ClassVar[str]
    ruptures: ClassVar[bool] = False
    smooth: ClassVar[bool] = False
    keeps_fill: ClassVar[bool] = False
    inlet_line: ClassVar[bool] = False
    moves_by_cells: ClassVar[bool] = False
    cuts_load: ClassVar[bool] = False
    keeps_mass: ClassVar[bool] = True
    cells: ClassVar[Cells]

    @property
    def floor(self) -> float:
        """Lowest pressure that may be given anywhere, Pa, absolute."""
        return -math.inf

    @property
    def kink(self) -> float:
        """Pressure, Pa, below which the unknown of a cell is its fill alone; -inf: no such kink."""
        return self.floor if self.keeps_fill and not self.smooth else -math.inf

    def filling(self, scale: float, limited: bool = True) -> tuple[float, float]:
        """The kink, and the most that a cell below it may become in one Newton step, Pa.

        What is above the kink of a cell that fills is oil that has no room, and no pressure: that
        would be a thousand times too much. Where steps are not `limited` no cell is below a kink.
        """
        return (self.kink, self.kink + FILLS * scale) if limited else (-math.inf, 0.0)

    @property
    def numbers(self) -> tuple[float, ...]:
        """Parameters of `cells`."""
        return ()

    @property
    def address(self) -> int:
        """Address of the compiled function `cells`."""
        return _compiled(type(self).cells)

    def fill_at(self, pressure: float) -> float:
        """Fill of the oil that enters at `pressure`, Pa."""
        return 1.0

    def unknown_of(self, pressure: Array, scale: float) -> Array:
        """Unknowns of a (not ruptured) pressure field, Pa."""
        return np.array(pressure, dtype=float)

    def pressure_unit(self, edge_pressure: float) -> float:
        """Unit of pressure of a film in this ambience, Pa; 0 where it only scales with the load."""
        return 0.0

    def scaled(self, unit: float) -> Self:
        """The law of the film without dimensions, its pressures over `unit`, Pa."""
        return self


@lru_cache
def _compiled(cells: Cells) -> int:
    from numba import cfunc, types

    double = types.CPointer(types.float64)
    signature = types.void(double, types.float64, types.intp, double, double)
    function = cfunc(signature, cache=True, error_model="numpy")(cells)
    _KEPT.append(function)
    return int(function.address)  # type: ignore[arg-type]


_KEPT: list[Any] = []  # compiled functions live as long as their addresses


def _full(numbers: Any, scale: float, count: int, u: Any, state: Any) -> None:
    for i in range(count):
        state[P * count + i] = u[i]
        state[DP * count + i] = 1.0
        state[FILL * count + i] = 1.0
        state[DFILL * count + i] = 0.0
        state[SLACK * count + i] = 0.0
        state[DSLACK * count + i] = 0.0
        state[LOAD * count + i] = u[i]
        state[DLOAD * count + i] = 1.0


def _guembel(numbers: Any, scale: float, count: int, u: Any, state: Any) -> None:
    p_cav = numbers[0]
    for i in range(count):
        p = u[i]
        ruptured = p < p_cav
        state[P * count + i] = p
        state[DP * count + i] = 1.0
        state[FILL * count + i] = 1.0
        state[DFILL * count + i] = 0.0
        state[SLACK * count + i] = 0.0
        state[DSLACK * count + i] = 0.0
        state[LOAD * count + i] = p_cav if ruptured else p
        state[DLOAD * count + i] = 0.0 if ruptured else 1.0


def _reynolds(numbers: Any, scale: float, count: int, u: Any, state: Any) -> None:
    """The unknown of a ruptured cell is the slack of the complementarity."""
    p_cav = numbers[0]
    for i in range(count):
        v = u[i]
        ruptured = v < p_cav
        p = p_cav if ruptured else v
        dp = 0.0 if ruptured else 1.0
        state[P * count + i] = p
        state[DP * count + i] = dp
        state[FILL * count + i] = 1.0
        state[DFILL * count + i] = 0.0
        state[SLACK * count + i] = v - p_cav if ruptured else 0.0
        state[DSLACK * count + i] = 1.0 - dp
        state[LOAD * count + i] = p
        state[DLOAD * count + i] = dp


def _mass_conserving(numbers: Any, scale: float, count: int, u: Any, state: Any) -> None:
    """The unknown of a ruptured cell is u = p_cav − scale (1 − F)."""
    p_cav = numbers[0]
    for i in range(count):
        v = u[i]
        ruptured = v < p_cav
        p = p_cav if ruptured else v
        dp = 0.0 if ruptured else 1.0
        state[P * count + i] = p
        state[DP * count + i] = dp
        state[FILL * count + i] = 1.0 + (v - p_cav) / scale if ruptured else 1.0
        state[DFILL * count + i] = 1.0 / scale if ruptured else 0.0
        state[SLACK * count + i] = 0.0
        state[DSLACK * count + i] = 0.0
        state[LOAD * count + i] = p
        state[DLOAD * count + i] = dp


def _gas_mixture(numbers: Any, scale: float, count: int, u: Any, state: Any) -> None:
    """The unknown is u = p − scale (1 − F), which tends to that of the sharp law as c → 0.

    So Newton needs no continuation, and p > 0 by itself.
    """
    mixing = numbers[0]
    for i in range(count):
        v = u[i]
        root = math.sqrt((v + mixing) ** 2 + 4.0 * mixing * scale)
        if v > mixing:
            p = 0.5 * (v - mixing + root)
        else:
            p = 2.0 * mixing * (v + scale) / (mixing - v + root)
        # (p + c)(p − u) = c · scale; p + c without cancellation
        lift = 0.5 * (v + mixing + root)
        if v + mixing < 0.0:
            lift = 2.0 * mixing * scale / (root - v - mixing)
        slope = mixing / (lift * lift)
        dp = 1.0 / (1.0 + scale * slope)
        state[P * count + i] = p
        state[DP * count + i] = dp
        state[FILL * count + i] = p / lift
        state[DFILL * count + i] = slope * dp
        state[SLACK * count + i] = 0.0
        state[DSLACK * count + i] = 0.0
        state[LOAD * count + i] = p
        state[DLOAD * count + i] = dp


@dataclass(frozen=True)
class Sommerfeld(CavitationLaw):
    """Full film: pressures below zero are allowed, (3.38) of [Jonuschies 2015].

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, Sommerfeld
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> oil = Lubricant(0.05)
    >>> full = bearing.equilibrium((5e3, 0.0), 50.0, oil, cavitation=Sommerfeld(), grid=(36, 8))
    >>> round(float(full.attitude_angle), 2)  # a full film moves the shaft across its load
    1.57
    """

    kind: ClassVar[str] = "sommerfeld"
    cells: ClassVar[Cells] = _full


@dataclass(frozen=True)
class _AtPressure(CavitationLaw):
    """Law that limits the pressure by that of cavitation."""

    cavitation_pressure: float = 0.0

    ruptures: ClassVar[bool] = True

    def __post_init__(self) -> None:
        value = self.cavitation_pressure
        require(math.isfinite(value), "cavitation_pressure", value, "Pa, absolute, finite")

    @property
    def floor(self) -> float:
        """Cavitation pressure, Pa."""
        return self.cavitation_pressure

    @property
    def numbers(self) -> tuple[float, ...]:
        """Parameter of `cells`."""
        return (self.cavitation_pressure,)

    def pressure_unit(self, edge_pressure: float) -> float:
        """Edge pressure above that of cavitation, Pa."""
        return edge_pressure - self.cavitation_pressure

    def scaled(self, unit: float) -> Self:
        """Law of the film without dimensions."""
        return replace(self, cavitation_pressure=0.0)


@dataclass(frozen=True)
class Guembel(_AtPressure):
    """Full film whose pressure below the cavitation pressure carries nothing, (3.39).

    Attributes
    ----------
    cavitation_pressure : float
        Pa, absolute.

    Examples
    --------
    >>> from loadflow.journal import Guembel, JournalBearing, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> oil = Lubricant(0.05)
    >>> state = bearing.equilibrium((5e3, 0.0), 50.0, oil, cavitation=Guembel(), grid=(36, 8))
    >>> round(float(state.eccentricity_ratio), 2)
    0.24
    """

    kind: ClassVar[str] = "guembel"
    inlet_line: ClassVar[bool] = True
    cuts_load: ClassVar[bool] = True
    cells: ClassVar[Cells] = _guembel


@dataclass(frozen=True)
class Reynolds(_AtPressure):
    """Swift–Stieber film: p and ∂p/∂n continuous at the rupture, (3.40); not mass conserving.

    Attributes
    ----------
    cavitation_pressure : float
        Pa, absolute.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, Reynolds
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> oil = Lubricant(0.05)
    >>> state = bearing.equilibrium((5e3, 0.0), 50.0, oil, cavitation=Reynolds(), grid=(36, 8))
    >>> round(float(state.eccentricity_ratio), 2)
    0.24
    """

    kind: ClassVar[str] = "reynolds"
    inlet_line: ClassVar[bool] = True
    moves_by_cells: ClassVar[bool] = True
    keeps_mass: ClassVar[bool] = False
    cells: ClassVar[Cells] = _reynolds


@dataclass(frozen=True)
class MassConserving(_AtPressure):
    """Jakobsson–Floberg–Olsson film: either full (F = 1) or at cavitation pressure (F < 1).

    Attributes
    ----------
    cavitation_pressure : float
        Pa, absolute.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, Lubricant, MassConserving
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> film = {"cavitation": MassConserving(), "edge_pressure": 1e5, "grid": (36, 8)}
    >>> state = bearing.equilibrium((5e4, 0.0), 50.0, Lubricant(0.05), **film)
    >>> bool(0.0 < state.total_fill < 1.0)  # part of the gap is empty
    True
    """

    kind: ClassVar[str] = "mass-conserving"
    keeps_fill: ClassVar[bool] = True
    cells: ClassVar[Cells] = _mass_conserving


@dataclass(frozen=True)
class GasMixture(CavitationLaw):
    """Gas–liquid mixture of Wegmann, (3.41–3.51) of [Jonuschies 2015].

    The gap is filled to ``F = p / (p + c)``, p absolute (Jonuschies misprints (3.48)).

    Attributes
    ----------
    mixing_constant : float
        c, Pa. Towards 0 the law tends to `MassConserving`.

    Examples
    --------
    >>> from loadflow.journal import GasMixture
    >>> law = GasMixture(mixing_constant=5e3)
    >>> round(law.fill_at(1e5), 3)  # share of liquid at atmospheric pressure
    0.952
    """

    mixing_constant: Annotated[float, Gt(0)]

    kind: ClassVar[str] = "gas-mixture"
    ruptures: ClassVar[bool] = True
    smooth: ClassVar[bool] = True
    keeps_fill: ClassVar[bool] = True
    cells: ClassVar[Cells] = _gas_mixture

    def __post_init__(self) -> None:
        require(self.mixing_constant > 0, "mixing_constant", self.mixing_constant, "must be > 0 Pa")

    @property
    def floor(self) -> float:
        """Cavitation pressure, Pa."""
        return 0.0

    @property
    def numbers(self) -> tuple[float, ...]:
        """Parameter of `cells`."""
        return (self.mixing_constant,)

    def fill_at(self, pressure: float) -> float:
        """Fill of the mixture at `pressure`, Pa."""
        wet = pressure + self.mixing_constant
        return pressure / wet if wet > 0 else 1.0

    def unknown_of(self, pressure: Array, scale: float) -> Array:
        """Unknowns of a pressure field, Pa."""
        mixing = self.mixing_constant
        return pressure - scale * mixing / (pressure + mixing)

    def pressure_unit(self, edge_pressure: float) -> float:
        """Edge pressure above that of cavitation, Pa."""
        return edge_pressure

    def scaled(self, unit: float) -> Self:
        """Law of the film without dimensions."""
        return replace(self, mixing_constant=self.mixing_constant / unit)


LAWS: dict[str, type[CavitationLaw]] = {
    law.kind: law for law in (GasMixture, Sommerfeld, Guembel, Reynolds, MassConserving)
}
"""Every law by its `kind`."""
