"""From what the user states to the discrete film."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.film.compliance import compliance_of
from loadflow.journal.film.elastic import ElasticFilm
from loadflow.journal.film.feed import Feed
from loadflow.journal.film.film import Film
from loadflow.journal.film.gap import PlainGap
from loadflow.journal.film.gap_elastic import ElasticGap
from loadflow.journal.film.gap_mesh import crowded, recess_marks, shaped_mesh
from loadflow.journal.film.gap_shaped import Bore, ShapedGap
from loadflow.journal.film.groove_pressure import Pockets
from loadflow.journal.film.grooves import groove_marks, groove_numbers
from loadflow.journal.film.mesh import build_mesh
from loadflow.journal.options import (
    Cavitation,
    GasMixture,
    Guembel,
    Lubricant,
    MassConserving,
    Reynolds,
    require,
)
from loadflow.journal.shapes import Arc, Shape
from loadflow.journal.shells import Shell
from loadflow.journal.supply import Supply

Array = NDArray[np.float64]
Grading = Literal["auto", "uniform", "graded"]
Inlet = Literal["auto", "widest gap"] | None

SOURCE_GRID = (60, 20)  # the grid of the source, enough for its smooth law
SHARP_GRID = (120, 40)  # graded, for laws with a sharp rupture
FULL_GRID = (120, 24)  # the same where both halves of the width differ


@dataclass(frozen=True)
class FilmOptions:
    """Lubricant, law, supply, mesh and shell, as documented at `JournalBearing.equilibrium`."""

    lubricant: Lubricant
    cavitation: Cavitation | None = None
    edge_pressure: float = 0.0
    supply: Supply | None = None
    inlet: Inlet = "auto"
    grid: tuple[int, int] | None = None
    grading: Grading = "auto"
    shell: Shell | None = None

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


def build_shaped_film(
    bore: Bore, shape: Shape, options: FilmOptions, straight: bool, crowd: tuple[float, ...] = ()
) -> tuple[ShapedGap, Film]:
    """Discrete film of a bearing of any shape; `straight`: around an aligned, straight shaft.

    Cells crowd at the angles `crowd`, rad.
    """
    law, supply = options.law, options.supply
    require(options.inlet != "widest gap", "inlet", options.inlet, "None but for a plain cylinder")
    pressure = getattr(shape, "groove_pressure", None)
    pressure = options.edge_pressure if pressure is None else pressure
    _check_oil(law, options.edge_pressure, supply, pressure)
    smooth = isinstance(law, GasMixture)
    half = straight and all(part.symmetric(bore.width) for part in bore.relief)
    sharp_grid = SHARP_GRID if half else FULL_GRID
    grid = options.grid or (SOURCE_GRID if smooth else sharp_grid)
    graded = options.grading == "graded" or (options.grading == "auto" and not smooth)
    turns, places = recess_marks(bore.relief, bore.radius, bore.width)
    around, ends = groove_marks(supply.grooves if supply else (), int(grid[0]), bore.radius)
    ratio = bore.width / (2 * bore.radius)
    mesh = shaped_mesh(
        ratio, grid, half, graded, bore.segments, [*turns, *around], [*places, *ends, *-ends]
    )
    for angle in crowd:
        mesh = crowded(mesh, angle)
    numbers = groove_numbers(mesh.angle, mesh.z, ratio, supply, int(grid[0]), bore.radius)
    mirrors = 2.0 if half else 1.0
    flow_unit = mirrors * bore.clearance**3 / (12.0 * options.lubricant.viscosity)
    words = (
        law,
        options.lubricant.viscosity,
        bore.clearance / bore.radius,
        bore.radius,
        options.edge_pressure,
        Pockets(numbers, Feed(supply or Supply(), options.lubricant), flow_unit),
        pressure,
    )
    if options.shell is None:
        gap = ShapedGap(mesh, bore)
        film = Film(gap, *words)
    else:
        require(not bore.pads, "shell", options.shell, "None for pads, whose backs are not held")
        compliance = compliance_of(options.shell, mesh, bore.radius)
        gap = ElasticGap(mesh, bore, rims_give=compliance.spreads)
        film = ElasticFilm(compliance, gap, *words)
    film.fill(mesh.groove, pressure)
    film.ambient = _outside(gap, film, options.edge_pressure, shape)
    return gap, film


def _outside(gap: ShapedGap, film: Film, edge_pressure: float, shape: Shape) -> Array | float:
    """Load of what is not in the film: the edge pressure all round, the groove at its ends, N.

    The edge pressure acts on the shaft beside an arc and on the back of pads.
    """
    if not gap.bore.segments:
        return 0.0
    load = edge_pressure * gap.uniform()
    if not isinstance(shape, Arc):
        load -= (film.p_line - edge_pressure) * gap.facing_groove()
    return np.asarray(film.mirrors * film.radius**2 * load)


def _check_oil(law: Cavitation, edge_pressure: float, supply: Supply | None, *other: float) -> None:
    """Refuse pressures at which a mass-conserving film would run dry, or rupture at its rim."""
    name = "edge_pressure"
    require(np.isfinite(edge_pressure), name, edge_pressure, "Pa, absolute, finite")
    pressures = [edge_pressure, *other]
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
