"""Ring modes of a bearing, and what its rings and its contacts know of each other.

A ring gives displacements (r, θ, z) at patches of its raceways. Contacts feel them as few fields
each: a point contact the shift of its groove centres, a roller its approach along the normal and
what the turn of the raceways adds at its end. Everything else is the same for both: the modes of
the rings, their condensation and Newton's iteration.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.lanes import aligned, lanes_for
from loadflow.rolling.contacts import Array, Contacts, Raceway
from loadflow.rolling.rings.flexible import FlexibleRings
from loadflow.rolling.rings.patches import PatchPoints

_ROUNDING = 1e-11  # share of a shift that is rounding, of the modes above all


class ContactLaw(NamedTuple):
    """What the kernels take of the contacts.

    Attributes
    ----------
    power : int
        POINT or LINE of `loadflow.rolling.contacts`.
    table : ndarray
        Of points that of `Contacts`; of lines ARM, GAP, STIFFNESS of each slice.
    local : float
        Compliance of both rings right at a contact, m/N.
    """

    power: int
    table: Array
    local: float


class Coupling(Hashable, Protocol):
    """How the contacts of a bearing feel its rings.

    Shapes: ``kind`` counts the sets of contacts around the bearing, one contact of each for every
    element; ``patch`` the sets of patches that they ride on, ``field`` what a contact feels.

    Attributes
    ----------
    left_out : float
        Share of the energy of smooth loads that modes may miss.
    sprung : bool
        Whether a spring at each contact stands for the modes left out.
    """

    left_out: ClassVar[float]
    sprung: ClassVar[bool]

    @property
    def contacts(self) -> Contacts:
        """The contacts of the bearing."""

    @property
    def elements(self) -> int:
        """Rolling elements of a row."""

    @property
    def places(self) -> list[tuple[float, float]]:
        """Radius and height of the point of the inner ring that stands for each patch, m."""

    def points(self, ring: Raceway, rings: FlexibleRings) -> PatchPoints:
        """Patches of one ring, in its frame."""

    def fields(self, moved: Array) -> Array:
        """What contacts feel, (kind · element, field, n), of patches (patch, element, 3, n)."""

    def smooth_loads(self) -> list[tuple[float, Array]]:
        """Directions of loads to order modes by: expected share, (kind, field); the force first."""

    def law(self, spring: float, rings: FlexibleRings) -> ContactLaw:
        """Law of the contacts, with a spring at each for what modes leave out, m/N."""

    def state(self, unknowns: Array, modes: RingModes) -> tuple[Array, Array]:
        """Force and signed angle of all contacts of a series, (n, kind of `contacts`, element)."""

    def statistics(self, unknowns: Array, modes: RingModes) -> tuple[Array, Array]:
        """Largest forces (n, kind) and sums of their powers (n, kind, 3), as `ContactForces`."""

    def grouped(self, unknowns: Array, modes: RingModes, groups: int) -> Array:
        """Forces on whole elements, (n, group, element)."""

    def pushes(self, force: Array, angle: Array) -> Array:
        """Forces (r, θ, z) on the patches of the outer ring, (..., patch, element, 3)."""

    def raceways(self, moved: Array) -> Array:
        """Displacement of raceways, (..., *groups, element, 3), by that of all patches."""


@dataclass(frozen=True, eq=False)
class RingModes:
    """Ring modes of a bearing in one position.

    Attributes
    ----------
    coupling : Coupling
        How contacts feel the rings.
    basis : ndarray, shape (field, contact, 5 + mode)
        What each contact feels of each unknown (of balls the shift of the groove centres): five
        rigid ones as lengths, then the modes.
    law : ContactLaw
        Law of the contacts with what both rings yield right at them.
    share : float
        Share of the modes' compliance in the whole, along the nominal contact lines.
    mixing : ndarray, shape (ring mode, mode)
        The modes in those that the rings give, all of the inner ring before all of the outer one.
    """

    coupling: Coupling
    basis: Array
    law: ContactLaw
    share: float
    mixing: Array

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.basis.shape[-1]

    @property
    def reach(self) -> Array:
        """Factors that turn residuals of the unknowns into forces."""
        modes = np.abs(self.basis[..., 5:]).max(axis=(0, 1))
        return np.concatenate([np.ones(5), 1 / modes])

    @cached_property
    def waves(self) -> RingWaves:
        """The basis as waves around the ring."""
        return RingWaves.of(self.basis, self.coupling.elements)


class RingWaves(NamedTuple):
    """What contacts feel of each unknown, as waves over the elements of a row.

    Rings that are the same all round have modes of one harmonic each: a few numbers stand for the
    shifts of all contacts. Other rings have more of them, up to one for each ball. Sections that
    stay rigid move all contacts of a ball together, so that few ``tracks`` stand for the fields of
    all kinds. Only what is rounding is left out.

    Attributes
    ----------
    trig : ndarray, shape (wave, half)
        Cosines, then sines, over the balls of one half of the ring: the other half mirrors them.
        All harmonics up to `top`; cosines, sines and balls each filled up with zeros to a multiple
        of `LANES`.
    turned : ndarray, shape (half, wave)
        The same by balls.
    products : ndarray, shape (half, wave)
        The same of all harmonics that products of two waves have.
    first, owner, wave, track, place, spot, value : ndarray
        Parts of each unknown, from first[unknown] to first[unknown + 1]: unknown, wave, track, the
        place of both in an array (track, wave) in one line and in that of the tangent, amplitude.
    mixing : ndarray, shape (field · kind, track)
        Fields of each kind of contact, the shift (r, θ, z) of points, in the tracks.
    shapes : ndarray, shape (track · ball, unknown)
        Tracks that each ball feels of each unknown, in `order`, filled up both ways to a multiple
        of `LANES`; empty where the waves are so few that products of them cost less.
    cosines, product_cosines : int
        Number of cosines in both tables, empty ones included.
    balls, top : int
        Number of balls, and highest harmonic.
    order, upto : ndarray, shape (unknown,)
        Unknowns in the order of the tangent, modes by harmonic, then rigid ones; and the highest
        harmonic of those up to each.
    """

    trig: Array
    turned: Array
    products: Array
    first: NDArray[np.int64]
    owner: NDArray[np.uint64]  # unsigned, as kernels look twice at an index that may be negative
    wave: NDArray[np.int64]
    track: NDArray[np.int64]
    place: NDArray[np.uint64]
    spot: NDArray[np.int64]
    value: Array
    mixing: Array
    shapes: Array
    cosines: int
    product_cosines: int
    balls: int
    top: int
    order: NDArray[np.int64]
    upto: NDArray[np.int64]

    @classmethod
    def of(cls, basis: Array, balls: int) -> RingWaves:
        """Split a `basis` (field, kind · ball, unknown)."""
        fields, _, size = basis.shape
        shift = (
            basis.reshape(fields, -1, balls, size).transpose(3, 2, 1, 0).reshape(size, balls, -1)
        )
        largest = np.abs(shift).max(axis=(1, 2), keepdims=True)
        scaled = shift / np.where(largest > 0, largest, 1.0)  # some bearings slide along their axis
        mixing = _tracks(scaled.reshape(-1, shift.shape[-1]))
        shapes = shift @ mixing  # unknown, ball, track
        trig = _waves(balls // 2, balls)
        sizes = np.square(trig).sum(axis=1)
        wave_of = np.where(sizes > 0.5, sizes, np.inf)[:, None]
        amplitude = np.einsum("tj,ajc->atc", trig / wave_of, shapes)
        seen = np.abs(amplitude) > _ROUNDING * largest
        used = np.flatnonzero(seen.any(axis=(0, 2)))
        split = lanes_for(balls // 2 + 1)
        harmonic = np.where(used < split, used, used - split + 1)
        top = int(harmonic.max())
        owner, wave, track = (np.ascontiguousarray(index) for index in np.nonzero(seen))
        value, cosines, tracks = amplitude[owner, wave, track], lanes_for(top + 1), mixing.shape[1]
        first = np.searchsorted(owner, np.arange(size + 1))
        harmonic = np.where(wave < split, wave, wave - split + 1)
        wave = np.where(wave < split, wave, wave - split + cosines)
        place = (track * (cosines + lanes_for(top)) + wave).astype(np.uint64)
        sines = lanes_for((top + 1) * tracks) + (wave - cosines) * tracks
        spot = np.where(wave < cosines, wave * tracks, sines) + track
        highest = np.zeros(size, np.int64)
        np.maximum.at(highest, owner, harmonic)
        order = np.concatenate([5 + np.argsort(highest[5:], kind="stable"), np.arange(5)])
        both = min(2 * top, balls // 2)
        # products of waves against products of balls; short loops take thrice the time of long ones
        few = 3 * len(owner) * (2 * top * tracks + size) < shapes.size * size / 2
        rows = np.zeros((0 if few else lanes_for(shapes[0].size), lanes_for(size)))
        if not few:
            rows[: shapes[0].size, :size] = shapes.reshape(size, -1)[order].T
        trig = _half(_waves(top, balls))
        return cls(
            aligned(trig), aligned(trig.T), aligned(_half(_waves(both, balls)).T),
            first, owner.astype(np.uint64), wave, track, place, spot, value, mixing, rows, cosines,
            lanes_for(both + 1), balls, top, order, np.maximum.accumulate(highest[order]),
        )  # fmt: skip


def _half(waves: Array) -> Array:
    """The first half of the ring, filled up, of waves (wave, ball)."""
    balls = waves.shape[1]
    found = np.zeros((len(waves), lanes_for(balls // 2 + 1)))
    found[:, : balls // 2 + 1] = waves[:, : balls // 2 + 1]
    return found


def _waves(top: int, balls: int) -> Array:
    """Cosines 0 … top, then sines 1 … top, each filled up with empty waves, (wave, ball)."""
    cosines = lanes_for(top + 1)
    angle = 2 * np.pi / balls * np.outer(np.arange(top + 1), np.arange(balls))
    trig = np.zeros((cosines + lanes_for(top), balls))
    trig[: top + 1], trig[cosines : cosines + top] = np.cos(angle), np.sin(angle[1:])
    if 2 * top == balls:
        trig[cosines + top - 1] = 0.0  # a sine that is zero at every ball
    return trig


def _tracks(shift: Array) -> Array:
    """Orthonormal directions (column, track) that hold all rows; all columns if none is saved."""
    _, values, directions = np.linalg.svd(np.linalg.qr(shift, mode="r"))
    count = int((values > _ROUNDING * values[0]).sum())
    if count == shift.shape[1]:
        return np.eye(count)
    kept = directions[:count].T
    return np.ascontiguousarray(np.where(np.abs(kept) > _ROUNDING, kept, 0.0))
