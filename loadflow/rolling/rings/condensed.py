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
    shifts of all contacts. Other rings have more of them, up to one for each ball. Only what is
    rounding is left out.

    Attributes
    ----------
    trig : ndarray, shape (wave, half)
        Cosines, then sines, over the balls of one half of the ring, with empty waves up to a
        multiple of four of each: the other half mirrors them.
    owner, wave : ndarray of int, shape (part,)
        Unknown and wave of each part.
    amplitude : ndarray, shape (part, field · kind)
        Fields of each kind of contact: the shift (r, θ, z) of points.
    cosines, balls : int
        Number of cosines, empty ones included, and of balls.
    """

    trig: Array
    owner: NDArray[np.int64]
    wave: NDArray[np.int64]
    amplitude: Array
    cosines: int
    balls: int

    @classmethod
    def of(cls, basis: Array, balls: int) -> RingWaves:
        """Split a `basis` (field, kind · ball, unknown)."""
        fields, _, size = basis.shape
        shift = (
            basis.reshape(fields, -1, balls, size).transpose(1, 0, 2, 3).reshape(-1, balls, size)
        )
        angle = 2 * np.pi / balls * np.outer(np.arange(balls // 2 + 1), np.arange(balls))
        trig = np.concatenate([np.cos(angle), np.sin(angle[1 : (balls + 1) // 2])])
        amplitude = np.einsum("tj,sja->ats", trig / np.square(trig).sum(axis=1)[:, None], shift)
        seen = np.abs(amplitude).max(axis=2)
        seen = seen > _ROUNDING * seen.max(axis=1, keepdims=True)
        used = np.flatnonzero(seen.any(axis=0))
        owner, wave = np.nonzero(seen[:, used])
        kept = [used[used <= balls // 2], used[used > balls // 2]]
        sizes = [-(-len(some) // 4) * 4 for some in kept]
        half = np.zeros((sum(sizes), balls // 2 + 1))
        place = np.empty(len(used), np.int64)
        for some, first in zip(kept, (0, sizes[0])):
            half[first : first + len(some)] = trig[some, : balls // 2 + 1]
            place[np.searchsorted(used, some)] = first + np.arange(len(some))
        parts = np.ascontiguousarray(amplitude[owner, used[wave]])
        return cls(half, owner, place[wave], parts, sizes[0], balls)
