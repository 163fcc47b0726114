"""Flexible rings of a bearing, condensed to few modes at the raceways.

Each contact presses the two rings apart with equal forces, so that only their joint compliance
C = C_inner + C_outer at the raceway patches counts. Of C = Q Qᵀ those modes are kept that contact
forces along the nominal contact lines (and, weaker, across them) store most energy in; the static
shapes of a Guyan condensation, ordered by what they carry. What the others hold on average acts as
a spring right at each point contact, so that a smooth load meets the whole compliance; of line
contacts more modes are kept instead, which cost little beside their slices.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

import numpy as np

from loadflow.errors import InputError
from loadflow.numerics.one_thread import on_one_thread
from loadflow.rolling.contacts import Array, Contacts, Raceway
from loadflow.rolling.rings.condensed import Coupling, RingModes
from loadflow.rolling.rings.flexible import FlexibleRings

_MOST = 100  # modes by default
_ROUNDING = 1e-11  # share of a compliance that is rounding
_TWIN = 1e-6  # relative distance below which two modes hold the same energy
_FALL = 2.0  # harmonic n of the forces is taken to fall as 1/(1 + n)²


@lru_cache(maxsize=16)
@on_one_thread
def ring_modes(coupling: Coupling, rings: FlexibleRings) -> RingModes:
    """Condense the rings of a bearing to their modes.

    Raises
    ------
    InputError
        If a ring does not fit the bearing.
    """
    factor = _joint_factor(coupling, rings)
    mixing, spring, share = _condense(factor, coupling, rings.modes)
    rigid = rigid_basis(coupling.places, coupling.contacts)
    rigid = np.moveaxis(rigid.reshape(3, -1, coupling.elements, 5), 0, 2)
    basis = np.concatenate([coupling.fields(rigid), factor @ mixing], axis=-1)
    return RingModes(
        coupling,
        np.ascontiguousarray(np.moveaxis(basis, 1, 0)),
        coupling.law(spring, rings),
        share,
        mixing,
    )


def _joint_factor(coupling: Coupling, rings: FlexibleRings) -> Array:
    """Q of both rings side by side, (contact, field, mode); inner minus outer."""
    parts = []
    names: tuple[Raceway, Raceway] = ("inner", "outer")
    for name in names:
        ring = getattr(rings, name)
        if ring is None:
            continue
        points = coupling.points(name, rings)
        shape = (len(points.radius), coupling.elements, 3)
        factor = np.asarray(ring.flexibility(points), float)
        if factor.shape[:3] != shape or not np.isfinite(factor).all():
            raise InputError(f"{name}: flexibility must be finite {shape}, got {factor.shape}")
        if not factor.shape[3]:
            raise InputError(
                f"{name}: the ring gives way nowhere: its mesh is too coarse beside the contacts; "
                "allowed: more elements across, or no flexible ring"
            )
        parts.append(coupling.fields(factor))
    if not parts:
        raise InputError('inner, outer: give at least one ring, or rings="rigid"')
    return np.concatenate(parts, axis=-1)


def _condense(factor: Array, coupling: Coupling, modes: int | None) -> tuple[Array, float, float]:
    """Largest modes under smooth contact forces (ring mode, mode), local compliance, share."""
    balls = coupling.elements
    (_, force), *others = coupling.smooth_loads()
    along = _felt(force, factor)
    energy = _smooth_gram(along, balls)
    weighted = energy.copy()
    for expected, direction in others:
        weighted += expected**2 * _smooth_gram(_felt(direction, factor), balls)
    values, vectors = np.linalg.eigh(weighted)
    if values[-1] <= 0:
        raise InputError("inner, outer: the rings do not yield at all; use rings='rigid'")
    order = [i for i in np.argsort(values)[::-1] if values[i] > 1e-13 * values[-1]]
    if modes is None:
        held = np.cumsum(values[order]) / values[order].sum()
        enough = int(np.searchsorted(held, 1 - coupling.left_out)) + 1
        modes = len(order) if len(order) <= _MOST else min(enough, _MOST)
        # the cosine and sine of a harmonic stay together: which half of the pair comes first is
        # rounding, and either alone would favour a direction
        while modes < len(order) and values[order[modes]] > (1 - _TWIN) * values[order[modes - 1]]:
            modes += 1
    kept = _aligned(vectors[:, order[:modes]], values[order[:modes]], along[0])
    scale = np.ones(kept.shape[1])
    local = 0.0
    if len(order) > modes and coupling.sprung:
        left = float(np.square(along @ vectors[:, order[modes:]]).sum()) / len(along)
        local = min(_local_compliance(along), left)
        if local < _ROUNDING * np.square(along).sum() / len(along):
            local = 0.0
        # the spring at the contacts takes its part of what the kept modes carry
        carried = np.square(along @ kept).sum(axis=0)
        scale = np.sqrt(np.where(carried > local, 1 - local / np.maximum(carried, 1e-300), 1.0))
    share = np.einsum("am,ab,bm->", kept, energy, kept) / np.trace(energy)
    return kept * scale, local, float(share)


def _aligned(modes: Array, values: Array, felt: Array) -> Array:
    """Turn the two modes of a harmonic so that the second moves nothing where `felt` (ring mode,).

    Any two directions of such a pair do; these are a cosine and a sine from the first contact on,
    with half as many waves as others.
    """
    turned = modes.copy()
    first = 0
    while first + 1 < len(values):
        if values[first + 1] <= (1 - _TWIN) * values[first]:
            first += 1
            continue
        pair = modes[:, first : first + 2]
        cosine, sine = felt @ pair
        size = np.hypot(cosine, sine)
        if size > _TWIN * np.linalg.norm(felt):
            turned[:, first] = pair @ [cosine / size, sine / size]
            turned[:, first + 1] = pair @ [-sine / size, cosine / size]
        first += 2
    return turned


def _felt(direction: Array, factor: Array) -> Array:
    """What all contacts feel in a direction (kind, field) of each, (contact, mode)."""
    around = np.repeat(direction, len(factor) // len(direction), axis=0)
    return np.asarray(np.einsum("cf,cfm->cm", around, factor))


def _smooth_gram(shift: Array, balls: int) -> Array:
    """Energy of the modes under forces whose harmonics fall off as those of real loads do."""
    waves = np.fft.rfft(shift.reshape(-1, balls, shift.shape[-1]), axis=1, norm="ortho")
    waves /= (1.0 + np.arange(waves.shape[1]))[:, None] ** _FALL
    smooth = np.fft.irfft(waves, balls, axis=1, norm="ortho").reshape(shift.shape)
    return smooth.T @ smooth


def _local_compliance(along: Array) -> float:
    """Level to which the compliance falls for loads that change from ball to ball, m/N."""
    contacts, modes = along.shape
    small = along.T @ along if modes < contacts else along @ along.T
    values = np.concatenate([np.linalg.eigvalsh(small), np.zeros(max(contacts - modes, 0))])
    return float(max(np.median(values), 0.0))


def rigid_basis(places: Iterable[tuple[float, float]], contacts: Contacts) -> Array:
    """Shift (r, θ, z) of points at all azimuths by (ux, uy, uz, R θx, R θy), (3, point, 5).

    The points of the inner ring lie at the `places` (radius, height), m.
    """
    cos, sin = np.cos(contacts.azimuth), np.sin(contacts.azimuth)
    zero = np.zeros_like(cos)
    parts = []
    for radius, height in places:
        radial = [cos, sin, zero, -height * sin, height * cos]
        tangential = [-sin, cos, zero, -height * cos, -height * sin]
        axial = [zero, zero, zero + 1, radius * sin, -radius * cos]
        parts.append(np.array([radial, tangential, axial]))
    return np.moveaxis(np.concatenate(parts, axis=-1), 1, -1) * contacts.scale
