"""How far the cells may leave one shaft on several films from where it would be on finer ones."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film.cell_error import SurfaceError, drag_error
from loadflow.journal.solvers.assembly.member import BODY, AssemblyState, Member, MemberState
from loadflow.journal.solvers.assembly.solve import Assembly

Array = NDArray[np.float64]

# of the sum of sizes of what films lack, at least: pads that are alike lack load of one sign, which
# leaves a shaft between them where it is, but they are never quite alike (docs/journal-numerics.md)
_UNLIKE = 0.3


class _Part(NamedTuple):
    """A film whose pad follows its load.

    `yields` (m, m) is how far the pad gives way to the load of the film, clearances per N, `kept`
    (m, m) what of a load on the film reaches the shaft, `left` (m, m) what of its way the gap.
    """

    member: Member
    place: Array
    error: SurfaceError
    yields: Array
    kept: Array
    left: Array


def relative_errors(assembly: Assembly, members: slice, state: AssemblyState) -> Array:
    """Bounds of force, smallest film, largest pressure and friction of `members`, over them (4,).

    What the cells leave out of the pressures shifts shaft and pads as their stiffness allows; 0 of
    a force that is given.
    """
    parts = [_part(assembly, m, s, state) for m, s in zip(assembly.members, state.members)]
    response = _response(assembly, state)
    thin, peak, shear = 0.0, 0.0, 0.0
    force, lost = np.zeros(3), np.zeros(3)
    held = np.setdiff1d(np.arange(3), state.free)
    loads = assembly.loads(state)[members]
    for part, found in zip(parts[members], loads):
        gap = part.member.film.gap.narrowest(part.place)
        thin = max(thin, _closing(parts, part, response) / gap if gap > 0.0 else np.inf)
        peak, shear = max(peak, part.error.peak), max(shear, part.error.shear)
        force += np.sum(found, axis=0)[:3]
        for turn in part.member.turns:
            rows = (turn.T @ part.member.attached.T @ part.kept)[held]
            lost[held] += part.member.unit * part.error.missing(rows)[1]
    size = float(np.linalg.norm(force))
    share = float(np.linalg.norm(lost)) / size if size > 0.0 else 0.0
    return np.array([share, thin, peak + thin, drag_error(shear, thin)])


def _part(assembly: Assembly, member: Member, own: MemberState, state: AssemblyState) -> _Part:
    """A film, its pad and what its cells leave out."""
    place = member.place(own, state.position)
    member.film.place(own.u, place)
    whole, error = np.eye(place.size), SurfaceError(member.film)
    if not own.pad.size or own.linear is None:
        return _Part(member, place, error, 0.0 * whole, whole, whole)
    by_pad, scales = member.by_pad, np.abs(member.by_pad).max(axis=0)
    stiffness = own.linear.stiffness
    matrix = member.unit * by_pad.T @ stiffness @ by_pad + member.support
    turned = _inverse(matrix / np.outer(scales, scales)) / np.outer(scales, scales)
    yields = member.unit * by_pad @ turned @ by_pad.T
    return _Part(
        member, place, error, yields, whole - stiffness @ yields, whole - yields @ stiffness
    )


def _response(assembly: Assembly, state: AssemblyState) -> Array:
    """How far the shaft moves under a load (5, 5), m and rad per N and N m; 0 where it is held."""
    free, scale = state.free, assembly.scale
    response = np.zeros((BODY, BODY))
    if free.size:
        both = np.outer(scale[free], scale[free])
        stiffness = assembly.coefficients(state)[0][np.ix_(free, free)]
        response[np.ix_(free, free)] = both * _inverse(stiffness * both)
    return response


def _closing(parts: list[_Part], here: _Part, response: Array) -> float:
    """How far the narrowest gap of the film `here` may close, clearances."""
    member = here.member
    facing = member.film.gap.facing(here.place)
    own = facing @ here.left @ member.attached @ member.turns[0]
    by_shaft = own @ response
    signed, most = 0.0, 0.0
    for part in parts:
        for number, turn in enumerate(part.member.turns):
            row = part.member.unit * by_shaft @ turn.T @ part.member.attached.T @ part.kept
            if part is here and number == 0:
                row = row - facing @ here.yields
            lacks, at_most = part.error.missing(row[None])
            signed, most = signed + float(lacks[0]), most + float(at_most[0])
    return max(abs(signed), _UNLIKE * most)


def _inverse(matrix: Array) -> Array:
    """Inverse of a stiffness; of one that holds nothing the least."""
    if not np.isfinite(matrix).all():
        return np.full(matrix.shape, np.nan)
    return np.asarray(np.linalg.pinv(matrix))
