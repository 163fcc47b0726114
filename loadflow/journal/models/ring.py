"""What both reduced films share: cells around, fixed to the shell, their oil, their messages."""

from __future__ import annotations

from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.discretise import build_film
from loadflow.journal.film.film import DiscreteFilm
from loadflow.journal.film.gap.grooves import groove_marks
from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.mesh import folded
from loadflow.journal.film.gap.shaped_mesh import between_marks, cells_on
from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.solvers.estimate import closed_form_position
from loadflow.journal.solvers.messages import no_equilibrium, not_found
from loadflow.journal.solvers.motion.transient import OrbitStopped

Array = NDArray[np.float64]


class Ring(NamedTuple):
    """Cells around, and what fills them.

    Attributes
    ----------
    cos, sin, cos_face, sin_face : array (nx,)
        Of the cell centres, and of the faces behind them.
    load_x, load_y : array (nx,)
        ∫ cos θ dθ and ∫ sin θ dθ over the cells.
    base, base_face : array (nx,)
        H of the centred shaft at cell centres and faces.
    width, apart : array (nx,)
        Δθ of the cells, and from the centre of each to that of the next one; to the edge of a
        groove.
    groove : array of bool (nx,)
        Columns that are axial grooves, whose pressure stays.
    back : array (nx,)
        Δθ from where each place between two columns begins, its centre or the end of a groove, to
        the face behind it.
        In a groove 0.
    lobe : array (3, nx)
        Of the segment at these faces: H of the centred shaft is ``b − x cos θ − y sin θ``.
    shaped : bool
        Whether the bore is no cylinder.
    order : array (nx,)
        Place of each column of cells in the folded band.
    law : int
        Address of the law of cavitation.
    numbers : array
        Its parameters.
    kink : float
        Unknown, Pa, below which it stands for the fill, and above for the pressure; −∞ where a law
        has no such kink.
    edge_fill : float
        Fill of the oil that enters at the bearing ends.
    scale, p_edge : float
        Scale of pressure, and pressure at the ends, Pa.
    slope : float
        12 η/ψ², Pa s.
    area : float
        Load over ∫ p over the points across: R², or 2 R² of half the width, m².
    """

    cos: Array
    sin: Array
    cos_face: Array
    sin_face: Array
    load_x: Array
    load_y: Array
    base: Array
    base_face: Array
    width: Array
    apart: Array
    groove: NDArray[np.bool_]
    back: Array
    lobe: Array
    shaped: bool
    order: NDArray[np.int64]
    law: int
    numbers: Array
    kink: float
    edge_fill: float
    scale: float
    p_edge: float
    slope: float
    area: float


def units_of(bearing: JournalGeometry, options: Film, speed: Array) -> DiscreteFilm:
    """The grid's film without effects on cells fixed to the shell: its units, law and cells."""
    bare = replace(
        options, grading="uniform", inlet=None, contact=None, shell=None, turbulence=None
    )
    between = bearing.pressure_between(options.edge_pressure)
    film = build_film(bearing.diameter, bearing.width, bearing.relative_clearance, bare, between)
    film.set_scale(float(np.abs(speed).max()))
    return film


def ring_of(film: DiscreteFilm, share: float) -> Ring:
    """Cells of the grid's `film`; the points across are those of 1/`share` of the width."""
    angle, count = film.mesh.angle, film.mesh.angle.size
    if film.pockets.count:  # cells end where grooves do
        width = film.mesh.dx
        # of a cell the load along its middle is that of a pressure held over its width: 2 sin(w/2)
        face, middle = film.mesh.edges[1:], width * np.sinc(0.5 * width / np.pi)
    else:
        width = middle = np.full(count, 2.0 * np.pi / count)
        face = angle + 0.5 * width
    half = 0.5 * width
    return Ring(
        cos=np.cos(angle), sin=np.sin(angle), cos_face=np.cos(face), sin_face=np.sin(face),
        load_x=middle * np.cos(angle), load_y=middle * np.sin(angle),
        base=np.ones(count), base_face=np.ones(count), width=width, apart=half + np.roll(half, -1),
        groove=np.zeros(count, dtype=bool), back=half,
        lobe=np.outer([1.0, 0.0, 0.0], np.ones(count)), shaped=False, order=film.mesh.order,
        law=film.law.address, numbers=np.array(film.law.numbers),
        kink=film.law.kink,
        edge_fill=film.law.fill_at(film.p_edge), scale=film.scale, p_edge=film.p_edge,
        slope=film.slope, area=share * film.radius**2,
    )  # fmt: skip


def lobed(ring: Ring, bearing: JournalGeometry, options: Film) -> Ring:
    """The same around the segments of a shaped bore: cells on them, one in each groove between.

    Cells on the segments end where grooves of a supply do.
    """
    bore, around = replace(Bore.of(bearing), relief=()), options.cells[0]  # of points across
    fed = options.supply.grooves if options.supply is not None else ()
    marks, _ = groove_marks(fed, around, bearing.radius)
    segments = bore.segments
    starts = [part.start for part in segments] + [segments[0].start + 2 * np.pi]
    edges, number, groove = [np.array(starts[:1])], [], []
    for k, (part, cells) in enumerate(zip(segments, cells_on(segments, around))):
        own = between_marks(part.start, part.end, marks, cells)[1:]
        edges += [own, np.array(starts[k + 1 : k + 2])]
        number += [k] * (own.size + 1)
        groove += [False] * own.size + [True]
    edge, segment, gap = np.concatenate(edges), np.array(number), np.array(groove)
    width, angle, face = np.diff(edge), 0.5 * (edge[1:] + edge[:-1]), edge[1:]
    half = np.where(gap, 0.0, 0.5 * width)
    owner = np.where(gap, np.roll(segment, -1), segment)  # of the face behind each cell
    preload = np.array([part.preload for part in segments])[owner]
    toward = np.array([part.narrowest for part in segments])[owner]
    away = preload / (1.0 - preload)
    lobe = np.stack([1.0 / (1.0 - preload), away * np.cos(toward), away * np.sin(toward)])
    centre, middle = np.array([0.0]), np.sinc(0.5 * width / np.pi)
    return ring._replace(
        cos=np.cos(angle), sin=np.sin(angle), cos_face=np.cos(face), sin_face=np.sin(face),
        load_x=width * middle * np.cos(angle), load_y=width * middle * np.sin(angle),
        base=bore.gap(angle, segment, centre)[:, 0], base_face=bore.gap(face, owner, centre)[:, 0],
        width=width, apart=half + np.roll(half, -1), groove=gap, back=half,
        lobe=lobe, shaped=True, order=folded(width.size),
    )  # fmt: skip


def estimates(bearing: JournalGeometry, film: DiscreteFilm, force: Array, speed: Array) -> Array:
    """Positions (n, 2) by the closed form, clearances."""
    numbers = [
        bearing.sommerfeld_number(*point, film.viscosity)
        for point in zip(np.hypot(*force.T).tolist(), speed.tolist())
    ]
    ratio = bearing.width / bearing.diameter
    finite = np.where(np.isfinite(numbers), numbers, 1e9)
    return closed_form_position(ratio, finite, force, speed, film.ruptures)


def no_start(
    force: Array,
    speed: float,
    ratio: float,
    found: tuple[float, float, float],
    work: float | None = None,
    why: str = "",
) -> OrbitStopped:
    """Say that an orbit has no equilibrium to start from.

    Parameters
    ----------
    force, speed, ratio
        First load (2,), N, its speed, rad/s, and the eccentricity ratio at which Newton ended.
    found : tuple of float
        Residual, its rounding level, and Newton steps.
    work : float or None
        As of `OrbitStopped`.
    why : str
        What else is known.
    """
    none = not_found(*found, ratio) + why
    return OrbitStopped(f"orbit cannot start: {no_equilibrium(force, speed, none)}", work=work)
