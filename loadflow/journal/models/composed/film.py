"""What the loops of a reduced film with effects work on: constants of the film, and work arrays.

Effects are a shaft that tilts and bends, asperities, and a shell that gives way where it is
pressed. The position of the shaft is q = (x, y, tilt about the first axis, about the second), in
clearances and clearances per shaft radius; at z its centre is seen at

    x + tilt₂ z + bend₁ z²/2,    y − tilt₁ z + bend₂ z²/2.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models._ring_kernels import RingSystem, ring_system
from loadflow.journal.models.composed.modes import Modes, ModesWork, make_modes_work
from loadflow.journal.models.composed.supply import Border, Feeding, Held, make_border
from loadflow.journal.models.composed.thickening import Thickening
from loadflow.journal.models.composed.uneven import Uneven
from loadflow.journal.models.ring import Ring
from loadflow.journal.models.width_modes import Nodes
from loadflow.numerics.lanes import aligned, lanes_for

Array = NDArray[np.float64]

# columns of a row of results
(
    X, Y, TILT_X, TILT_Y, PEAK, DISSIPATION, SHEAR, OUTFLOW, FILLED, LEAST, GROWTH, MOMENT_X,
    MOMENT_Y, CONTACT_X, CONTACT_Y, NORMAL, HIGHEST, BEYOND, FED, STEPS, RESIDUAL, ITERATIONS,
    CONVERGED, ROUNDING,
) = range(24)  # fmt: skip
RESULTS = 24


class Places(NamedTuple):
    """Places across: the points of the film, then others at which the narrowest gap is sought.

    Attributes
    ----------
    z : array (f,)
        From mid-plane, shaft radii.
    depth : array (f,)
        What a relief widens the bore there, clearances.
    """

    z: Array
    depth: Array


class Lanes(NamedTuple):
    """Points across as rows of `loadflow.numerics.lanes`, 0 behind them.

    Attributes
    ----------
    z, depth : array (L,)
        Of the points of the film, and what a relief widens the bore there.
    weights, inner : array (L,)
        Of the points at which the pressure is unknown; 1 there.
    slopes : array (m, L)
        Slopes of the pressure at all points, by its value at one.
    shares : array (l, L)
        The same of one point by the values at all.
    pairs : array (l, m, L)
        Products of two of these slopes at each point, times its weight.
    whole, ends : array (L,)
        Weights of all points; 1 at the bearing ends.
    fine : array (m, F)
        Values at places close by each other, by that at one point.
    """

    z: Array
    depth: Array
    weights: Array
    inner: Array
    slopes: Array
    shares: Array
    pairs: Array
    whole: Array
    ends: Array
    fine: Array


def lanes_of(nodes: Nodes, depth: Array) -> Lanes:
    """Lanes of points across, of which a relief widens the bore by `depth`."""
    points, inner = nodes.slopes.shape

    def rows(values: Array, count: int = points) -> Array:
        given = aligned(np.zeros((*values.shape[:-1], lanes_for(count))))
        given[..., : values.shape[-1]] = values
        return given

    pairs = nodes.weights[:, None, None] * nodes.slopes[:, :, None] * nodes.slopes[:, None, :]
    ends = np.concatenate([np.zeros(points - nodes.ends.size), np.ones(nodes.ends.size)])
    return Lanes(
        z=rows(nodes.z), depth=rows(depth[:points]), weights=rows(nodes.weights[:inner]),
        inner=rows(np.ones(inner)), slopes=rows(nodes.slopes.T), shares=rows(nodes.slopes),
        pairs=rows(pairs), whole=rows(nodes.weights), ends=rows(ends),
        fine=rows(nodes.fine.T, len(nodes.fine)),
    )  # fmt: skip


class Rough(NamedTuple):
    """Asperities: roughness and its flow factors, and the load of a line of contact.

    Attributes
    ----------
    size : float
        Combined roughness over the clearance; 0 where the surfaces are smooth.
    along, across : array (2, 16) or (0, 16)
        Rows of flow factors.
    slip : float
        Share of the roughness that the shaft drags along.
    deepest : float
        Overlap of the mean planes, clearances, at which the law of contact ends.
    first, step : float
        Eccentricity ratios of the table: first one, and distance.
    table : array (4, n)
        Radial load of a shaft radius of width, N, its derivative, then ∫ p_a, N, likewise.
    z, weights : array (g,)
        Places across, shaft radii, and their share of the whole width, shaft radii.
    """

    size: float
    along: Array
    across: Array
    slip: float
    deepest: float
    first: float
    step: float
    table: Array
    z: Array
    weights: Array


class Yielding(NamedTuple):
    """Asperities on a shell that gives way where these press it, too, in a bore of any gap, or
    beside grooves.

    Attributes
    ----------
    on : bool
        Whether there are any.
    first, step : float
        Gaps without that yield, clearances, of the table: first one, and distance.
    table : array (4, n)
        Gap with it, its derivative, asperity pressure over K E*, its derivative.
    values : array (g, m)
        Pressure at places across from that at the points.
    growth : array (g, l)
        What a shell that gives way all over opens there, from that at all points.
    z, weights, depth : array (g,)
        These places, shaft radii, their share of the whole width, shaft radii, and what a relief
        widens the bore there, clearances.
    share, part : array (n,)
        Places between a cell centre and the next one, and their weights, shares of the way.
    cos, sin : array (nx, n)
        Of these places.
    grooves : array of bool (g, nx)
        Whether there is a groove of a supply between a cell centre and the next one.
    unit : float
        Load, N, over ∫∫ of asperity pressure over K E*, in shaft radii.
    """

    on: bool
    first: float
    step: float
    table: Array
    values: Array
    growth: Array
    z: Array
    weights: Array
    depth: Array
    share: Array
    part: Array
    cos: Array
    sin: Array
    grooves: NDArray[np.bool_]
    unit: float


_NONE = np.zeros(1)
_NONE_AROUND = np.zeros((1, 1))
RIGID = Yielding(
    False, 0.0, 1.0, np.zeros((4, 2)), _NONE_AROUND, _NONE_AROUND, _NONE, _NONE, _NONE, _NONE,
    _NONE, _NONE_AROUND, _NONE_AROUND, np.zeros((1, 1), bool), 0.0,
)  # fmt: skip


class Regime(NamedTuple):
    """Whether the flow may be turbulent, and where it is.

    Attributes
    ----------
    on : bool
        Whether it may.
    reynolds, onset : float
        Reynolds number of a gap of the clearance at 1 rad/s, the same over its critical value; s.
    begin, end : float
        Multiples of the critical value where turbulence begins, and is full.
    """

    on: bool
    reynolds: float
    onset: float
    begin: float
    end: float


LAMINAR = Regime(False, 0.0, 0.0, 0.0, 0.0)


def regime_of(bearing: JournalGeometry, options: Film) -> Regime:
    """Whether the flow may be turbulent."""
    if options.turbulence is None:
        return LAMINAR
    lengths = bearing.radius, bearing.relative_clearance
    at_one = options.turbulence.regime(*lengths, options.liquid).at(1.0)
    return Regime(True, *at_one)


class Composed(NamedTuple):
    """Constants of a film with effects.

    Attributes
    ----------
    ring : Ring
        Cells around, and what fills them.
    nodes : Nodes
        Points across.
    places : Places
        These, and what a relief widens the bore there.
    lanes : Lanes
        The points as rows of lanes.
    give : float
        Growth of the gap over the pressure of its place, clearances per Pa; 0: a rigid shell.
    modes : Modes
        What a shell gives all over.
    rough : Rough
        Asperities.
    yielding : Yielding
        What these are on a shell that gives way.
    regime : Regime
        Whether the flow may be turbulent.
    held : Held
        What grooves of a supply hold.
    feeding : Feeding
        What feeds those whose pressure is unknown.
    uneven : Uneven
        Viscosity of the points, and what widens the gap from place to place.
    thickening : Thickening
        What their pressure makes of it.
    """

    ring: Ring
    nodes: Nodes
    places: Places
    lanes: Lanes
    give: float
    modes: Modes
    rough: Rough
    yielding: Yielding
    regime: Regime
    held: Held
    feeding: Feeding
    uneven: Uneven
    thickening: Thickening


class ShelledFilm(Composed):
    """One in a shell that gives way all over, too."""


class ComposedWork(NamedTuple):
    """Work arrays of one film of nx cells around, each with m unknowns in L lanes.

    Behind the unknowns are those of edge pressure, which stay.

    Attributes
    ----------
    u, before, last, trial : array (nx, L)
        Unknowns: current, at the last two times, and before a step.
    liquid : array (3, nx, L)
        F H of the cells: storage of earlier times, then the last two times.
    squeeze : array (nx, L)
        Growth of the gap of the mean planes by a given velocity of the shaft, 1/s; else 0.
    state : array (8, nx, L)
        As in `_kernels.apply_law`.
    gap : array (4, nx, L)
        Of the points: mean planes, mean gap, its share that opens, and conductance.
    gap_slope : array (nx, L)
        Derivative of the conductance by the gap of the mean planes.
    face : array (5, nx, L)
        Of the faces: conductance, dragged gap, their derivatives, and gap of the mean planes.
    slope : array (nx, L)
        ∂p across.
    matrix : RingSystem
        Derivatives of the residual, then their factors.
    columns : array (5 + f, nx, L)
        Residual and its derivatives by the position; then what the matrix makes of them. Behind
        those that are in use the same of f unknown pressures of grooves.
    row : array (5, L)
        Rows of numbers that are taken one by one.
    centre : array (2, f)
        Where the shaft is seen at the places across.
    bend : array (2,)
        Curvature of the shaft, clearances per square of the shaft radius.
    load : array (4,)
        Load that the film carries, N, its moments over the shaft radius.
    touch : array (5, 4)
        The same of the asperities, then its derivatives by the position.
    normal : array (1,)
        ∫ of their pressure, N.
    carried : array (5, 4)
        Load that each of the columns carries.
    system : array (4, 5)
        Linear system of a step of the shaft.
    pressed : array (4, nx, m)
        Derivative of `touch` by the pressure at the points, N/Pa, on a shell that gives way.
    numbers : array (2,)
        Reynolds number of a gap of the clearance, and over its critical value.
    step : array (4,)
        Newton step of the shaft.
    places : array (4, 4)
        Position at the time before the last, the next one, its load, and position at the time
        before these.
    past : array (7,)
        Bend of the shaft at the time before the last, at the last; the step between them and the
        one before it, s, 0 where there is none; the step that its error allows next, s.
    kept : array (2,)
        Whether `matrix` holds factors, and `columns` what they make of the derivatives by the
        position; the rate of these, 1/s.
    fed : array (g,)
        Flow of the grooves of a supply into the film, as `balance` has it.
    border : Border
        Those whose pressure is unknown.
    sheared : array (nx, L)
        Shear of the points at the film's one viscosity, where `Uneven.on`.
    modes : ModesWork
        Of a shell that gives way all over.
    thick : array (2, nx, L)
        Pressure of the points, Pa, and their viscosity over that without; of `Thickening`.
    """

    u: Array
    before: Array
    last: Array
    trial: Array
    liquid: Array
    squeeze: Array
    state: Array
    gap: Array
    gap_slope: Array
    face: Array
    slope: Array
    matrix: RingSystem
    columns: Array
    row: Array
    centre: Array
    bend: Array
    load: Array
    touch: Array
    normal: Array
    carried: Array
    system: Array
    pressed: Array
    numbers: Array
    step: Array
    places: Array
    past: Array
    kept: Array
    fed: Array
    border: Border
    sheared: Array
    modes: ModesWork
    thick: Array


def make_work(
    around: int, nodes: Nodes, places: int, feeding: Feeding, modes: Modes
) -> ComposedWork:
    """Allocate the work arrays."""
    points, inner = nodes.slopes.shape
    shape, free = (around, lanes_for(points)), feeding.first.size
    return ComposedWork(
        u=aligned(np.zeros(shape)),
        before=aligned(np.zeros(shape)),
        last=aligned(np.zeros(shape)),
        trial=aligned(np.zeros(shape)),
        liquid=aligned(np.zeros((3, *shape))),
        squeeze=aligned(np.zeros(shape)),
        state=aligned(np.zeros((8, *shape))),
        gap=aligned(np.ones((4, *shape))),
        gap_slope=aligned(np.zeros(shape)),
        face=aligned(np.ones((5, *shape))),
        slope=aligned(np.zeros(shape)),
        matrix=ring_system(around, inner, shape[1]),
        columns=aligned(np.zeros((5 + free, *shape))),
        row=aligned(np.zeros((5, shape[1]))),
        centre=np.zeros((2, places)),
        bend=np.zeros(2),
        load=np.zeros(4),
        touch=np.zeros((5, 4)),
        normal=np.zeros(1),
        carried=np.zeros((5, 4)),
        system=np.zeros((4, 5)),
        pressed=np.zeros((4, around, inner)),
        numbers=np.zeros(2),
        step=np.zeros(4),
        places=np.zeros((4, 4)),
        past=np.zeros(7),
        kept=np.zeros(2),
        fed=np.zeros(feeding.slots.size),
        border=make_border(free),
        sheared=np.zeros(shape),
        modes=make_modes_work(modes, shape, points),
        thick=np.ones((2, *shape)),
    )
