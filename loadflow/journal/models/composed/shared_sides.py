"""Two reduced films with effects that one shaft lies in: what the compiled loop asks of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, cast

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.gap.layout import Bore
from loadflow.journal.film.gap.shaped import ShapedGap
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.models.composed.film import Composed, ComposedWork
from loadflow.journal.models.composed.model import ComposedFilm
from loadflow.journal.models.composed.pads import NO_PADS, Pads, PadWork, make_pad_work, pads_of
from loadflow.journal.models.slow_heat import THIN, Warmth, slow_states
from loadflow.journal.solvers.motion.start import orbit_film

Array = NDArray[np.float64]

_HOLDS = 4.0  # times the largest load, at which a gap at a bearing end would be closed
_STICKS = 1e-3  # share of the clearance that a seat gives way by at a bearing end before it slides
COORDINATES = 4
SHAFT = 8  # unknowns of the shaft: its coordinates, and moments of both films; then those of seats


class Seats(NamedTuple):
    """What holds the shells of both films as they turn with the shaft.

    Attributes
    ----------
    stiffness : array (2,)
        Moment over the turn of each, N m/rad; infinite where it turns as it slides alone.
    slip : array (n, 2)
        Moment at which it slides, N m; infinite where it does not.
    """

    stiffness: Array
    slip: Array


class Lying(NamedTuple):
    """How a shaft lies in two films, and loads them.

    Attributes
    ----------
    force : array (n, 2, 2)
        Load on each film if none takes a moment, N: (time, film, axis).
    tilt : array (n, 2, 2)
        Of the shaft in each film then, if it is in the middle of both, rad.
    bend : array (n, 2, 2)
        Its curvature in each film, 1/m.
    by_position : array (2, 2, 2, 2)
        Tilt by position in the films, rad/m: (film, axis, film, axis).
    by_moment : array (2, 2, 2, 2)
        Tilt by the moments of the films, rad/(N m), as the shaft bends and what it rests on turns.
    felt : array of bool (2,)
        Whether the shaft feels the moment of each film.
    touching : array (2,)
        Gap, m, below which shaft and shell touch at a bearing end.
    seats : Seats, optional
        Of shells that turn with the shaft; aligned with it at the first time.
    """

    force: Array
    tilt: Array
    bend: Array
    by_position: Array
    by_moment: Array
    felt: NDArray[np.bool_]
    touching: Array
    seats: Seats | None = None


class Side(NamedTuple):
    """One of the two films.

    Attributes
    ----------
    film : Composed
        Its constants.
    work : ComposedWork
        Its work arrays, which hold the film at the first time.
    lies : array (4, m)
        Place of the shaft in it by the coordinates, and by the moments of both films and seats.
    slipped : array (4,)
        What the shell has slid in its seat, in the units of the place: two turns.
    felt : array (4, SHAFT)
        What the coordinates feel of its load, and which of it these moments are.
    given : array (n, 4)
        Place where coordinates and moments are 0.
    bend : array (n, 2)
        Curvature of the shaft.
    stop : array (2,)
        Gap at a bearing end, clearances, below which surfaces touch, and the load there, N, at
        which it would close; no load: they do not.
    arcs : array (s, 5)
        Arcs of the bore that they touch, as `Bore.arcs`.
    place, new : array (4,)
        At the last time, and at the next.
    past : array (8,)
        Place at the time before the last; bend then, and at the last.
    rows : array (n, RESULTS)
        Results, but for the first row filled.
    thin : array (2,)
        Viscosity and density of the oil over those of the film.
    warmth : Warmth
        Heat that is stored.
    states : array (n, STATES)
        As `slow_heat` fills them.
    pads, pad_work : Pads, PadWork
        Of a bore whose pads tilt; of none in others.
    tilts : array (n, p)
        Of these, clearances; but for the first row filled.
    """

    film: Composed
    work: ComposedWork
    lies: Array
    slipped: Array
    felt: Array
    given: Array
    bend: Array
    stop: Array
    arcs: Array
    place: Array
    new: Array
    past: Array
    rows: Array
    thin: Array
    warmth: Warmth
    states: Array
    pads: Pads
    pad_work: PadWork
    tilts: Array


class PaddedSide(Side):
    """One of two films of which one at least is on pads that tilt."""


class Shared(NamedTuple):
    """The shaft in both films.

    Attributes
    ----------
    load : array (n, COORDINATES)
        What the coordinates are to feel, N.
    at, before, new, step, missing : array (m,)
        Unknowns of the shaft at the last two times and at the next, their step, and what is missing
        in their equations, N. First the coordinates, then the moments of the films, N, over the
        radius of each; with seats, moments that these would hold if they did not slide.
    system : array (m, m + 1)
        Linear system of a step.
    slip, held : array (n, 2), array (2,)
        Moment at which each seat slides, N, over the radius of its film; share of its own one that
        it holds. Without seats (0, 2) and (0,).
    steps : array (1,)
        Step to the last time, s.
    told : array (2,)
        Residual and iterations of the last Newton iteration.
    """

    load: Array
    at: Array
    before: Array
    new: Array
    step: Array
    missing: Array
    system: Array
    slip: Array
    held: Array
    steps: Array
    told: Array


def gap_of_pads(model: ComposedFilm, force: Array, speed: Array) -> ShapedGap | None:
    """The grid's gap of a bore whose pads tilt, at a load (1, 2), N; None in other bores."""
    if not Bore.of(model.bearing).pads:
        return None
    film, line = model.options.isothermal(), model.line.at(np.array([0]))
    return cast("ShapedGap", orbit_film(model.bearing, film, force, speed, line)[0].gap)


def pads_beside(model: ComposedFilm, gap: ShapedGap | None) -> tuple[Pads, PadWork]:
    """Pads of a film, flat, and their work arrays; those of none where the bore has none."""
    if gap is None:
        return NO_PADS, make_pad_work((0, 0), 0)
    pads = pads_of(model.film.ring, gap, float(model.cold()[0, 0]))
    return pads, make_pad_work(model.work.u.shape, gap.pads.size)


def side_of(
    number: int,
    models: Sequence[ComposedFilm],
    lying: Lying,
    temperature: float,
    pads: Sequence[tuple[Pads, PadWork]],
) -> Side:
    """One film, in the units of the loops; coordinates are the positions in clearances."""
    model, count = models[number], len(lying.tilt)
    turn = model.bearing.radius / model.bearing.clearance
    seated = 0 if lying.seats is None else len(models)
    given, lies = np.zeros((count, 4)), np.zeros((4, SHAFT + 2 * seated))
    given[:, 2:] = lying.tilt[:, number] * turn
    lies[[0, 1], [2 * number, 2 * number + 1]] = 1.0
    for k, other in enumerate(models):
        places, moments = (slice(first + 2 * k, first + 2 * k + 2) for first in (0, COORDINATES))
        lies[2:, places] = turn * other.bearing.clearance * lying.by_position[number, :, k]
        lies[2:, moments] = turn * other.bearing.radius * lying.by_moment[number, :, k]
    felt = lies[:, :SHAFT] * model.bearing.clearance / models[0].bearing.clearance
    felt[:, COORDINATES:] = 0.0
    if lying.seats is not None:
        held = SHAFT + 2 * number
        give = give_of_seat(
            model.bearing, float(lying.seats.stiffness[number]), lying.seats.slip[:, number]
        )
        lies[[2, 3], [held, held + 1]] = -turn * model.bearing.radius * give
    if not lying.felt[number]:
        felt[2:] = 0.0
    own = COORDINATES + 2 * number
    felt[[2, 3], [own, own + 1]] = 1.0
    film, contact = model.film, model.options.contact
    load = _HOLDS * float(np.hypot(*lying.force[:, number].T).max())
    if film.rough.size > 0.0:
        load = 0.0
    rub = 0.0 if contact is None else contact.coefficient * model.bearing.radius
    warmth, states = slow_states(model.options, model.units, 0.5, rub, temperature, count)
    own_pads, pad_work = pads[number]
    padded = any(work.on.size for _, work in pads)
    return (PaddedSide if padded else Side)(
        film=film, work=model.work, lies=lies, slipped=np.zeros(4), felt=felt, given=given,
        bend=np.array(model.lines(count)[:, 2:]),
        stop=np.array([lying.touching[number] / model.bearing.clearance, load]),
        arcs=Bore.of(model.bearing).arcs(),
        place=np.zeros(4), new=np.zeros(4), past=np.zeros(8), rows=np.zeros((count, model.columns)),
        thin=np.array([states[0, THIN], 1.0]), warmth=warmth, states=states,
        pads=own_pads, pad_work=pad_work, tilts=np.zeros((count, pad_work.on.size)),
    )  # fmt: skip


def give_of_seat(bearing: JournalGeometry, stiffness: float, slip: Array) -> float:
    """Turn of a seat by moment, rad/(N m); one that slides gives way a little before it does."""
    most = float(slip.max())
    if np.isfinite(stiffness) or np.isinf(most):
        return 1.0 / stiffness
    # one that has no load at all holds nothing
    return _STICKS * 2.0 * bearing.clearance / bearing.width / max(most, 1.0)
