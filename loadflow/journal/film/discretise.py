"""From what the user states to the discrete film."""

from __future__ import annotations

from typing import cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.journal.cavitation import CavitationLaw
from loadflow.journal.film.feed import Feed
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.asperity_load import (
    CylinderLoad,
    GrowingNodeLoad,
    NodeLoad,
    YieldingNodeLoad,
)
from loadflow.journal.film.gap.elastic import ElasticGap, GrowingGap
from loadflow.journal.film.gap.gap import CylindricalGap
from loadflow.journal.film.gap.grooves import groove_marks, groove_numbers
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.mesh import Mesh, build_mesh
from loadflow.journal.film.gap.rough import RoughElasticGap, RoughGap, RoughShapedGap
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.film.gap.shaped_mesh import ShapedMesh, crowded, relief_marks, shaped_mesh
from loadflow.journal.film.gap.warm import (
    ElasticWarmGap,
    RoughElasticWarmGap,
    RoughWarmGap,
    WarmGap,
)
from loadflow.journal.film.groove_pressure import Pockets
from loadflow.journal.film.shell.compliance import Compliance, compliance_of
from loadflow.journal.film.shell.contact import ShellContact, TouchedFilm
from loadflow.journal.film.shell.elastic_film import ElasticFilm
from loadflow.journal.film.thickening import Thickening
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.journal.shapes import Shape
from loadflow.journal.supply import Supply
from loadflow.numerics.fields import require

Array = NDArray[np.float64]

FULL_GRID = (120, 24)  # the same where both halves of the width differ


def is_cylindrical(bearing: JournalGeometry, film: Film, line: Line) -> bool:
    """Whether a rigid cylinder surrounds an aligned shaft, in a film of one temperature."""
    fed_and_rough = film.contact is not None and film.supply is not None  # grooves do not touch
    given = film.shell is not None or film.heat is not None or fed_and_rough
    return not (bearing.shape.segments or bearing.relief or given) and line.straight


def crowds_around(bearing: JournalGeometry, film: Film, line: Line, refine: bool) -> bool:
    """Whether the grid may crowd cells at a narrowest gap that even ones around do not resolve.

    By a smooth law it does so where they do not, by others from the beginning, about a shaft whose
    gap is narrowest all along the bore: those are films of even cells where none may `refine`.
    """
    sharp = film.grading == "auto" and film.crowds and film.supply is None
    plain = sharp and film.contact is None and is_cylindrical(bearing, film, line)
    return film.may_grade or (refine and plain)


def build_film(
    diameter: float, width: float, relative_clearance: float, options: Film, *grooves: float
) -> DiscreteFilm:
    """As `cylindrical_film`, without the gap."""
    return cylindrical_film(diameter, width, relative_clearance, options, *grooves)[1]


def cylindrical_film(
    diameter: float, width: float, relative_clearance: float, options: Film, *grooves: float
) -> tuple[CylindricalGap, DiscreteFilm]:
    """Gap and discrete film of a cylindrical bearing (m) around an aligned shaft.

    `grooves` are pressures (Pa) of a bore of which these are but the units: oil may enter there.
    """
    supply, contact = options.supply, options.contact
    options.check_oil(*grooves)
    inlet = options.inlet_line
    require(not (inlet and supply), "inlet", options.inlet, "None where a supply is given")
    radius, ratio, around = 0.5 * diameter, width / diameter, options.cells[0]
    clearance = relative_clearance * radius
    mesh = build_mesh(ratio, options.cells, options.crowds, inlet, supply, radius)
    gap = CylindricalGap(mesh) if contact is None else RoughGap(mesh, contact, clearance)
    film = DiscreteFilm(gap, *_oil(mesh, options, ratio, relative_clearance, radius, around))
    if contact is not None:
        film.contact = CylinderLoad(contact, radius, width, clearance)
    _choose_flow(film, options)
    return gap, film


def _cells(options: Film, half: bool) -> tuple[int, int]:
    """Cells around and across of a film in a bore of any shape."""
    return options.cells if half or options.law.smooth or options.grid else FULL_GRID


def mesh_in_bore(bearing: JournalGeometry, options: Film, half: bool) -> ShapedMesh:
    """Cells of a film in a bore of any shape, of `half` of its width or all of it."""
    bore, grid, supply = Bore.of(bearing), _cells(options, half), options.supply
    turns, places = relief_marks(bore.relief, bore.radius, bore.width)
    around, ends = groove_marks(supply.grooves if supply else (), grid[0], bore.radius)
    marks = (*turns, *around), (*places, *ends, *-ends)
    return shaped_mesh(bearing.width_ratio, grid, half, options.crowds, bore.segments, *marks)


def shaped_film(
    bearing: JournalGeometry, options: Film, straight: bool, crowd: tuple[float, ...] = ()
) -> tuple[ShapedGap, DiscreteFilm]:
    """Gap and discrete film of any bearing; `straight`: around an aligned, straight shaft.

    Cells crowd at the angles `crowd`, rad.
    """
    contact = options.contact
    require(
        options.inlet != "widest gap",
        "inlet",
        options.inlet,
        "None but for a cylindrical, aligned bearing",
    )
    bore, pressure = Bore.of(bearing), bearing.pressure_between(options.edge_pressure)
    options.check_oil(pressure)
    half = straight and all(part.symmetric(bore.width) for part in bore.relief)
    half = half and (options.shell is None or options.shell.symmetric_on(options.cells[1]))
    ratio, grid = bearing.width_ratio, _cells(options, half)
    mesh = mesh_in_bore(bearing, options, half)
    for angle in crowd:
        mesh = crowded(mesh, angle)
    oil = _oil(mesh, options, ratio, bearing.relative_clearance, bore.radius, grid[0])
    gap: ShapedGap
    if options.shell is None:
        gap = _rigid_gap(mesh, bore, options)
        film = DiscreteFilm(gap, *oil, pressure)
    else:
        require(not bore.pads, "shell", options.shell, "None for pads, whose backs are not held")
        compliance = compliance_of(options.shell, mesh, bore.radius)
        elastic = _elastic_gap(mesh, bore, options, compliance)
        touched = contact is not None and compliance.spreads
        kind = TouchedFilm if touched else ElasticFilm
        gap, film = elastic, kind(compliance, elastic, *oil, pressure)
    film.fill(mesh.groove, pressure)
    film.ambient = _outside(gap, film, options.edge_pressure, bearing.shape)
    if contact is not None:
        radius, mirrors, grooved = bore.radius, film.mirrors, film.grooved
        if options.shell is not None:
            between, rest = cast("RoughElasticGap", gap), (radius, mirrors, grooved)
            if compliance.spreads:
                film.contact = ShellContact(contact, between, *rest, compliance)
            else:
                film.contact = YieldingNodeLoad(contact, between, *rest)
        elif isinstance(gap, GrowingGap):
            film.contact = GrowingNodeLoad(contact, gap, radius, mirrors, grooved)
        else:
            film.contact = NodeLoad(contact, gap, radius, mirrors, grooved)
    _choose_flow(film, options)
    return gap, film


def _choose_flow(film: DiscreteFilm, options: Film) -> None:
    """Let pressure thicken the liquid, and the flow be turbulent, where that is asked for."""
    if options.liquid.pressure_coefficient > 0.0:
        film.thickening = Thickening(options.liquid, film.edges)
    if options.turbulence is not None:
        lengths = film.radius, film.relative_clearance
        film.regime = options.turbulence.regime(*lengths, options.liquid)
        film.set_speed(film.speed)


def _oil(
    mesh: Mesh,
    options: Film,
    ratio: float,
    relative_clearance: float,
    radius: float,
    around: int,
) -> tuple[CavitationLaw, float, float, float, float, Pockets]:
    """What a discrete film knows beside its gap; `around`: cells around that were asked for."""
    supply, liquid = options.supply, options.liquid
    shell = ~mesh.groove if isinstance(mesh, ShapedMesh) else None
    numbers = groove_numbers(mesh.angle, mesh.z, ratio, supply, around, radius, shell)
    mirrors = 2.0 if mesh.half else 1.0
    flow_unit = mirrors * (relative_clearance * radius) ** 3 / (12.0 * liquid.viscosity)
    pockets = Pockets(numbers, Feed(supply or Supply(), liquid), flow_unit)
    lengths = relative_clearance, radius
    return options.law, liquid.viscosity, *lengths, options.edge_pressure, pockets


def _rigid_gap(mesh: ShapedMesh, bore: Bore, options: Film) -> ShapedGap:
    """Gap of a rigid shell."""
    contact = options.contact
    if contact is not None:
        require(not bore.pads, "contact", contact, "None for pads that tilt")
        kind = RoughShapedGap if options.heat is None else RoughWarmGap
        return kind(mesh, bore, contact)
    return ShapedGap(mesh, bore) if options.heat is None else WarmGap(mesh, bore)


def _elastic_gap(mesh: ShapedMesh, bore: Bore, options: Film, compliance: Compliance) -> ElasticGap:
    """Gap of an elastic shell; a local one yields to asperities where each of them presses."""
    spreads, cold = compliance.spreads, options.heat is None
    if options.contact is None:
        smooth = ElasticGap if cold else ElasticWarmGap
        return smooth(mesh, bore, ends_deform=spreads)
    alone = 0.0 if spreads else float(compliance.local.flat[0])
    rough = RoughElasticGap if cold else RoughElasticWarmGap
    return rough(mesh, bore, options.contact, alone, ends_deform=spreads)


def _outside(
    gap: ShapedGap, film: DiscreteFilm, edge_pressure: float, shape: Shape
) -> Array | float:
    """Load of what is not in the film: the edge pressure all round, the groove at its ends, N.

    The edge pressure acts on the shaft beside an arc and on the back of pads.
    """
    if not gap.bore.segments:
        return 0.0
    load = edge_pressure * gap.uniform()
    if shape.grooves_between:
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
        finite = np.isfinite(values)
        if not finite.all():
            bad = np.argwhere(~finite)[0]
            raise InputError(f"{label}{bad.tolist()} = {values[tuple(bad)]}: must be finite")
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
