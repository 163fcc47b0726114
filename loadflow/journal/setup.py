"""From what the user states to the discrete film."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.feed import Feed
from loadflow.journal.film import Film
from loadflow.journal.gap import PlainGap
from loadflow.journal.grooves import groove_numbers
from loadflow.journal.mesh import build_mesh
from loadflow.journal.options import (
    Cavitation,
    GasMixture,
    Guembel,
    Lubricant,
    MassConserving,
    Reynolds,
    require,
)
from loadflow.journal.pockets import Pockets
from loadflow.journal.supply import Supply

Array = NDArray[np.float64]
Grading = Literal["auto", "uniform", "graded"]
Inlet = Literal["auto", "widest gap"] | None

SOURCE_GRID = (60, 20)  # the grid of the source, enough for its smooth law
SHARP_GRID = (120, 40)  # graded, for laws with a sharp rupture


@dataclass(frozen=True)
class FilmOptions:
    """Lubricant, law, supply and mesh of a film, as documented at `JournalBearing.equilibrium`."""

    lubricant: Lubricant
    cavitation: Cavitation | None = None
    edge_pressure: float = 0.0
    supply: Supply | None = None
    inlet: Inlet = "auto"
    grid: tuple[int, int] | None = None
    grading: Grading = "auto"

    @property
    def law(self) -> Cavitation:
        """The law of the ruptured film."""
        return Reynolds() if self.cavitation is None else self.cavitation

    @property
    def may_grade(self) -> bool:
        """Whether a load that the uniform mesh cannot resolve may be tried on a graded one."""
        uniform = isinstance(self.law, GasMixture) and self.supply is None
        return self.grading == "auto" and uniform

    def graded(self) -> FilmOptions:
        """The same on a graded mesh, fine enough for a gap of a thousandth of the clearance."""
        around, across = self.grid or SHARP_GRID
        grid = (max(around, SHARP_GRID[0]), max(across, SHARP_GRID[1]))
        return replace(self, grading="graded", grid=grid)

    def for_history(self) -> FilmOptions:
        """The same on a mesh that can keep the fill of its cells, if the law has one."""
        if not isinstance(self.law, GasMixture | MassConserving):
            return self
        require(self.grading != "graded", "grading", self.grading, "uniform where fill has a past")
        require(self.inlet != "widest gap", "inlet", self.inlet, "None where fill has a past")
        return replace(self, grading="uniform", inlet=None)


def build_film(diameter: float, width: float, clearance: float, options: FilmOptions) -> Film:
    """Discrete film of a bearing (m, m, relative clearance)."""
    law, supply = options.law, options.supply
    _check_oil(law, options.edge_pressure, supply)
    smooth = isinstance(law, GasMixture)
    inlet = options.inlet == "widest gap"
    if options.inlet == "auto":
        inlet = isinstance(law, Reynolds | Guembel) and supply is None
    require(not (inlet and supply), "inlet", options.inlet, "None where a supply is given")
    graded = options.grading == "graded"
    if options.grading == "auto":
        graded = not smooth and supply is None
    around, across = options.grid or (SOURCE_GRID if smooth else SHARP_GRID)
    grid, radius = (int(around), int(across)), 0.5 * diameter
    mesh = build_mesh(width / diameter, grid, graded, inlet, supply, radius)
    numbers = groove_numbers(mesh.angle, mesh.z, width / diameter, supply, grid[0], radius)
    mirrors = 2.0 if mesh.half else 1.0
    flow_unit = mirrors * (clearance * radius) ** 3 / (12.0 * options.lubricant.viscosity)
    return Film(
        PlainGap(mesh),
        law,
        options.lubricant.viscosity,
        clearance,
        radius,
        options.edge_pressure,
        Pockets(numbers, Feed(supply or Supply(), options.lubricant), flow_unit),
    )


def _check_oil(law: Cavitation, edge_pressure: float, supply: Supply | None) -> None:
    """Refuse pressures at which a mass-conserving film would run dry, or rupture at its rim."""
    name = "edge_pressure"
    require(np.isfinite(edge_pressure), name, edge_pressure, "Pa, absolute, finite")
    pressures = [edge_pressure]
    grooves = supply.grooves if supply else ()
    pump = supply.pump if supply else None
    pressures += [g.pressure for g in grooves if g.restrictor is None and pump is None]
    floor = 0.0 if isinstance(law, GasMixture) else getattr(law, "cavitation_pressure", -np.inf)
    allowed = f"Pa, absolute, not below the cavitation pressure {floor:g} Pa"
    require(min(pressures) >= floor, name, min(pressures), allowed)
    fed = pump is not None or any(g.restrictor is not None for g in grooves)
    if isinstance(law, GasMixture | MassConserving) and not fed:
        allowed = f"above {floor:g} Pa at a rim or in a groove, or no oil enters"
        require(max(pressures) > floor, name, edge_pressure, allowed)


def operating_points(
    vectors: ArrayLike, speed: ArrayLike, name: str
) -> tuple[Array, Array, tuple[int, ...]]:
    """Broadcast vectors (…, 2) with speeds (…); finite values only.

    Returns
    -------
    vectors : array (n, 2)
    speed : array (n,)
    shape : tuple of int
    """
    vectors = np.asarray(vectors, dtype=float)
    speed = np.asarray(speed, dtype=float)
    if vectors.ndim == 0 or vectors.shape[-1] != 2:
        raise InputError(f"{name} has shape {vectors.shape}: the last axis must have 2 components")
    for label, values in ((name, vectors), ("speed", speed)):
        bad = np.argwhere(~np.isfinite(values))
        if bad.size:
            raise InputError(f"{label}{bad[0].tolist()} = {values[tuple(bad[0])]}: must be finite")
    try:
        shape = np.broadcast_shapes(vectors.shape[:-1], speed.shape)
    except ValueError as error:
        raise InputError(
            f"{name} {vectors.shape} and speed {speed.shape} do not broadcast"
        ) from error
    if 0 in shape:
        raise InputError(f"{name} is empty: shape {vectors.shape}")
    return (
        np.broadcast_to(vectors, (*shape, 2)).reshape(-1, 2),
        np.broadcast_to(speed, shape).ravel(),
        shape,
    )
