"""The geometry of a journal bearing: what it is, before anything happens to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

import numpy as np
from annotated_types import Gt, Lt
from numpy.typing import ArrayLike

from loadflow.journal.relief import Relief
from loadflow.journal.shapes import CYLINDER, Shape
from loadflow.numerics.fields import require


@dataclass(frozen=True)
class JournalGeometry:
    """Geometry of a journal bearing.

    Attributes
    ----------
    diameter, width : float
        Bore D and width B, m.
    relative_clearance : float
        ψ = clearance/diameter; the radial clearance is c = ψ D/2.
    shape : Cylindrical, Arc, Lobes or TiltingPads
        How the bore runs around.
    relief : tuple of Crown, Recess or Contour
        What widens the gap of that shape.

    Raises
    ------
    loadflow.errors.InputError
        A diameter outside 0 … 100 m, a width that is not positive, ψ outside 0 … 0.1.

    Examples
    --------
    >>> from loadflow.journal import JournalGeometry
    >>> geometry = JournalGeometry(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> geometry.clearance, geometry.width_ratio
    (0.00075, 0.75)
    >>> round(float(geometry.sommerfeld_number(2e6, 1.2451, 0.05)), 2)
    1.19
    """

    diameter: Annotated[float, Gt(0), Lt(100.0)]
    width: Annotated[float, Gt(0)]
    relative_clearance: Annotated[float, Gt(0), Lt(0.1)]
    shape: Shape = CYLINDER
    relief: tuple[Relief, ...] = ()

    def __post_init__(self) -> None:
        # more was meant in mm; but wide bearings of a metre stand for infinitely wide ones
        require(0 < self.diameter < 100.0, "diameter", self.diameter, "0 … 100, in m")
        require(0 < self.width < np.inf, "width", self.width, "> 0, finite")
        psi = self.relative_clearance
        require(0 < psi < 0.1, "relative_clearance", psi, "0 … 0.1")
        object.__setattr__(self, "relief", tuple(self.relief))
        for k, part in enumerate(self.relief):
            for name, value, allowed in part.beyond(self.width):
                require(False, f"relief.{k}.{name}", value, allowed)

    @property
    def radius(self) -> float:
        """Shaft radius, m."""
        return 0.5 * self.diameter

    @property
    def clearance(self) -> float:
        """Radial clearance c, m."""
        return self.relative_clearance * self.radius

    @property
    def width_ratio(self) -> float:
        """B/D."""
        return self.width / self.diameter

    @property
    def has_pads(self) -> bool:
        """Whether parts of the bore tilt, so that K and C depend on the frequency of vibration."""
        return any(part.tilting for part in self.shape.segments)

    def pressure_between(self, edge_pressure: float) -> float:
        """Pressure (Pa) between the segments of the bore: theirs, or that of the bearing ends."""
        own = self.shape.groove_pressure
        return edge_pressure if own is None else own

    def sommerfeld_number(self, force: ArrayLike, speed: ArrayLike, viscosity: ArrayLike) -> Any:
        """So = F ψ²/(B D η |ω|), (1.13) of [Jonuschies 2015]; 0 without load, else ∞ at rest.

        Of numbers a number, of arrays of sizes of forces (N) and speeds (rad/s) an array.
        """
        load = np.asarray(force) * self.relative_clearance**2
        drag = self.width * self.diameter * np.asarray(viscosity) * np.abs(speed)
        with np.errstate(divide="ignore", invalid="ignore"):
            found = np.where(load == 0.0, 0.0, np.divide(load, drag))
        return found[()]
