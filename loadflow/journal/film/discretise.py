"""From what the user states to the discrete film."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.film.asperity_load import CylinderLoad, NodeLoad
from loadflow.journal.film.compliance import compliance_of
from loadflow.journal.film.elastic import ElasticFilm
from loadflow.journal.film.feed import Feed
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap import PlainGap
from loadflow.journal.film.gap_elastic import ElasticGap
from loadflow.journal.film.gap_mesh import crowded, recess_marks, shaped_mesh
from loadflow.journal.film.gap_rough import RoughGap, RoughShapedGap
from loadflow.journal.film.gap_shaped import Bore, ShapedGap
from loadflow.journal.film.gap_warm import WarmGap
from loadflow.journal.film.groove_pressure import Pockets
from loadflow.journal.film.grooves import groove_marks, groove_numbers
from loadflow.journal.film.mesh import build_mesh
from loadflow.journal.film_model import Film
from loadflow.journal.shapes import Arc, Shape
from loadflow.journal.supply import Supply
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

FULL_GRID = (120, 24)  # the same where both halves of the width differ


def build_film(diameter: float, width: float, clearance: float, options: Film) -> DiscreteFilm:
    """Discrete film of a bearing (m, m, relative clearance)."""
    law, supply = options.law, options.supply
    options.check_oil()
    smooth = law.smooth
    inlet = options.inlet_line
    require(not (inlet and supply), "inlet", options.inlet, "None where a supply is given")
    graded = options.grading == "graded"
    if options.grading == "auto":
        graded = not smooth and supply is None
    grid, radius = options.cells, 0.5 * diameter
    mesh = build_mesh(width / diameter, grid, graded, inlet, supply, radius)
    numbers = groove_numbers(mesh.angle, mesh.z, width / diameter, supply, grid[0], radius)
    mirrors = 2.0 if mesh.half else 1.0
    flow_unit = mirrors * (clearance * radius) ** 3 / (12.0 * options.liquid.viscosity)
    clear, contact = clearance * radius, options.contact
    film = DiscreteFilm(
        PlainGap(mesh) if contact is None else RoughGap(mesh, contact, clear),
        law,
        options.liquid.viscosity,
        clearance,
        radius,
        options.edge_pressure,
        Pockets(numbers, Feed(supply or Supply(), options.liquid), flow_unit),
    )
    if contact is not None:
        film.contact = CylinderLoad(contact, radius, width, clear)
    return film


def build_shaped_film(
    bore: Bore, shape: Shape, options: Film, straight: bool, crowd: tuple[float, ...] = ()
) -> tuple[ShapedGap, DiscreteFilm]:
    """Discrete film of a bearing of any shape; `straight`: around an aligned, straight shaft.

    Cells crowd at the angles `crowd`, rad.
    """
    law, supply = options.law, options.supply
    require(
        options.inlet != "widest gap",
        "inlet",
        options.inlet,
        "None but for a cylindrical, aligned bearing",
    )
    pressure = getattr(shape, "groove_pressure", None)
    pressure = options.edge_pressure if pressure is None else pressure
    options.check_oil(pressure)
    smooth = law.smooth
    half = straight and all(part.symmetric(bore.width) for part in bore.relief)
    grid = options.cells if half or smooth or options.grid else FULL_GRID
    graded = options.grading == "graded" or (options.grading == "auto" and not smooth)
    turns, places = recess_marks(bore.relief, bore.radius, bore.width)
    around, ends = groove_marks(supply.grooves if supply else (), grid[0], bore.radius)
    ratio = bore.width / (2 * bore.radius)
    mesh = shaped_mesh(
        ratio, grid, half, graded, bore.segments, [*turns, *around], [*places, *ends, *-ends]
    )
    for angle in crowd:
        mesh = crowded(mesh, angle)
    numbers = groove_numbers(mesh.angle, mesh.z, ratio, supply, grid[0], bore.radius)
    mirrors = 2.0 if half else 1.0
    flow_unit = mirrors * bore.clearance**3 / (12.0 * options.liquid.viscosity)
    words = (
        law,
        options.liquid.viscosity,
        bore.clearance / bore.radius,
        bore.radius,
        options.edge_pressure,
        Pockets(numbers, Feed(supply or Supply(), options.liquid), flow_unit),
        pressure,
    )
    contact = options.contact
    gap: ShapedGap
    if options.shell is None:
        if contact is not None:
            require(not bore.pads, "contact", contact, "None for pads that tilt")
            require(
                options.heat is None, "contact", contact, "None with a heat balance of the film"
            )
            gap = RoughShapedGap(mesh, bore, contact)
        elif options.heat is not None:
            gap = WarmGap(mesh, bore)
        else:
            gap = ShapedGap(mesh, bore)
        film = DiscreteFilm(gap, *words)
    else:
        require(contact is None, "contact", contact, "None with an elastic shell")
        require(not bore.pads, "shell", options.shell, "None for pads, whose backs are not held")
        compliance = compliance_of(options.shell, mesh, bore.radius)
        gap = ElasticGap(mesh, bore, rims_give=compliance.spreads)
        film = ElasticFilm(compliance, gap, *words)
    film.fill(mesh.groove, pressure)
    film.ambient = _outside(gap, film, options.edge_pressure, shape)
    if contact is not None:
        film.contact = NodeLoad(contact, gap, bore.radius, mirrors, film.grooved)
    return gap, film


def _outside(
    gap: ShapedGap, film: DiscreteFilm, edge_pressure: float, shape: Shape
) -> Array | float:
    """Load of what is not in the film: the edge pressure all round, the groove at its ends, N.

    The edge pressure acts on the shaft beside an arc and on the back of pads.
    """
    if not gap.bore.segments:
        return 0.0
    load = edge_pressure * gap.uniform()
    if not isinstance(shape, Arc):
        load -= (film.p_line - edge_pressure) * gap.facing_groove()
    return np.asarray(film.mirrors * film.radius**2 * load)


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
