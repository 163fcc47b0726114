"""Flexible rings of a slewing bearing, condensed to few modes at the raceways.

Each contact presses the two rings apart with equal forces, so that only their joint compliance
C = C_inner + C_outer at the raceway patches counts. Of C = Q Qᵀ those modes are kept that contact
forces along the nominal contact lines (and, weaker, across them) store most energy in; the static
shapes of a Guyan condensation, ordered by what they carry. What the others hold on average acts as
a spring right at each contact, so that a smooth load meets the whole compliance.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, Annotated, NamedTuple, Protocol, runtime_checkable

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields
from loadflow.rolling.contacts import NORMAL_R, NORMAL_Z, Array, Contacts
from loadflow.rolling.rings.local_compliance import half_space
from loadflow.rolling.rings.patches import PatchPoints, patch_points

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways

# expected share of a contact force across its nominal line, and along the ring
_ACROSS, _ALONG = 0.2, 0.02
_LEFT_OUT, _MOST = 1e-5, 100  # share of the energy that modes may miss, and how many at most
_ROUNDING = 1e-11  # share of a shift or compliance that is rounding, of the modes above all
_TWIN = 1e-6  # relative distance below which two modes hold the same energy
_FALL = 2.0  # harmonic n of the forces is taken to fall as 1/(1 + n)²


@runtime_checkable
class Ring(Protocol):
    """Anything that gives the compliance of a ring with its structure at the raceway patches.

    Without what Hertz's law counts: see `loadflow.rolling.rings.local_compliance`.
    """

    def flexibility(self, points: PatchPoints) -> Array:
        """Return Q, (kind, ball, 3, mode), with the compliance C = Q Qᵀ; m/√(N m)."""


@dataclass(frozen=True, kw_only=True)
class FlexibleRings:
    """How the rings of a bearing deform.

    Attributes
    ----------
    inner, outer : Ring, optional
        `RingBeam`, `FiniteElementRing`, `CompliantRing` or anything with their method
        ``flexibility``; rigid if None.
    modes : int, optional
        Ring modes kept for both rings together; by default all of up to 100, else all but 1e-5 of
        what smooth loads store in the rings.
    inner_angle, outer_angle : float
        How far each ring has turned with its structure, rad; matters for structures that are not
        rotationally symmetric. Loads and displacements stay in the fixed frame.
    turning_patches : bool
        Whether a raceway patch turns with its section, or only shifts with its master point as the
        source's.
    shell : float
        Thickness T_S of the patches, m.
    master_width : float, optional
        Side of the square over which a force enters a ring at a master node, m: the size of the
        elements there. The rings of Ritzer yield under it although Hertz's approach holds that
        already. By default it is counted once.

    Raises
    ------
    InputError
        If a field is out of its range or not a ring.

    Examples
    --------
    >>> from loadflow.rolling import FlexibleRings, RingBeam, RingSection, SlewingBearing, Support
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> wall = Support.wall(radius=0.3, height=0.06, thickness=0.03, length=0.3)
    >>> outer = RingBeam(section=RingSection.rectangle(0.05, 0.1), radius=0.3, supports=(wall,))
    >>> soft = bearing.equilibrium((1e4, 0.0, 5e4), rings=FlexibleRings(outer=outer))
    >>> rigid = bearing.equilibrium((1e4, 0.0, 5e4))
    >>> bool(soft.displacement[2] > rigid.displacement[2])
    True
    """

    inner: Ring | None = None
    outer: Ring | None = None
    modes: Annotated[int, Ge(1)] | None = None
    inner_angle: float = 0.0
    outer_angle: float = 0.0
    turning_patches: bool = False
    shell: Annotated[float, Ge(0)] = 0.5e-3
    master_width: Annotated[float, Gt(0)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        for name in ("inner", "outer"):
            ring = getattr(self, name)
            if ring is not None and not isinstance(ring, Ring):
                raise InputError(f"{name}: must have a method flexibility, got {ring!r}")
        for name in ("inner_angle", "outer_angle"):
            if not np.isfinite(getattr(self, name)):
                raise InputError(f"{name}: must be finite, got {getattr(self, name)!r}")


@dataclass(frozen=True, eq=False)
class RingModes:
    """Ring modes of a bearing in one position.

    Attributes
    ----------
    basis : ndarray, shape (3, contact, 5 + mode)
        Shift of the groove centres by each unknown: five rigid ones as lengths, then the modes.
    local : float
        Compliance of both rings right at a contact, m/N.
    share : float
        Share of the modes' compliance in the whole, along the nominal contact lines.
    mixing : ndarray, shape (ring mode, mode)
        The modes in those that the rings give, all of the inner ring before all of the outer one.
    balls : int
        Balls of a row.
    """

    basis: Array
    local: float
    share: float
    mixing: Array
    balls: int

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
        return RingWaves.of(self.basis, self.balls)


class RingWaves(NamedTuple):
    """Shift of the groove centres by each unknown, as waves over the balls of a row.

    Rings that are the same all round have modes of one harmonic each: a few numbers stand for the
    shifts of all contacts. Other rings have more of them, up to one for each ball. Only what is
    rounding is left out.

    Attributes
    ----------
    trig : ndarray, shape (wave, ball)
        Cosines and sines over the balls, with empty waves up to a multiple of four.
    owner, wave : ndarray of int, shape (part,)
        Unknown and wave of each part.
    amplitude : ndarray, shape (part, 3 kind)
        Shift (r, θ, z) of each kind of contact.
    """

    trig: Array
    owner: NDArray[np.int64]
    wave: NDArray[np.int64]
    amplitude: Array

    @classmethod
    def of(cls, basis: Array, balls: int) -> RingWaves:
        """Split a `basis` (3, kind · ball, unknown)."""
        size = basis.shape[-1]
        shift = basis.reshape(3, -1, balls, size).transpose(1, 0, 2, 3).reshape(-1, balls, size)
        angle = 2 * np.pi / balls * np.outer(np.arange(balls // 2 + 1), np.arange(balls))
        trig = np.concatenate([np.cos(angle), np.sin(angle[1 : (balls + 1) // 2])])
        amplitude = np.einsum("tj,sja->ats", trig / np.square(trig).sum(axis=1)[:, None], shift)
        seen = np.abs(amplitude).max(axis=2)
        seen = seen > _ROUNDING * seen.max(axis=1, keepdims=True)
        used = np.flatnonzero(seen.any(axis=0))
        owner, wave = np.nonzero(seen[:, used])
        padded = np.zeros((-(-len(used) // 4) * 4, balls))
        padded[: len(used)] = trig[used]
        return cls(padded, owner, wave, np.ascontiguousarray(amplitude[owner, used[wave]]))


@lru_cache(maxsize=16)
def ring_modes(bearing: BallRaceways, rings: FlexibleRings, ball_angle: float) -> RingModes:
    """Condense the rings of a bearing to their modes.

    Raises
    ------
    InputError
        If a ring does not fit the bearing.
    """
    contacts = bearing.contacts(ball_angle)
    factor = _joint_factor(bearing, rings, contacts)
    mixing, local, share = _condense(factor, contacts, rings.modes)
    shapes = np.moveaxis(factor @ mixing, 1, 0)
    basis = np.concatenate([rigid_basis(contacts), shapes], axis=-1)
    basis[1] *= contacts.spatial
    return RingModes(
        np.ascontiguousarray(basis),
        local + _master_compliance(bearing, rings),
        share,
        mixing,
        bearing.balls,
    )


def _master_compliance(bearing: BallRaceways, rings: FlexibleRings) -> float:
    """What both rings yield at a master node on top of Hertz's approach, m/N."""
    if rings.master_width is None:
        return 0.0
    side = rings.master_width
    flexible = (rings.inner is not None) + (rings.outer is not None)
    return flexible * half_space(side, side, bearing.elastic_modulus, bearing.poisson_ratio)[0]


def _joint_factor(bearing: BallRaceways, rings: FlexibleRings, contacts: Contacts) -> Array:
    """Q of both rings side by side, (contact, 3, mode); inner minus outer."""
    parts = []
    shape = (len(contacts.table), bearing.balls, 3)
    for name in ("inner", "outer"):
        ring = getattr(rings, name)
        if ring is None:
            continue
        azimuth = contacts.azimuth - getattr(rings, f"{name}_angle")
        points = patch_points(bearing, name, azimuth, rings.shell, rings.turning_patches)
        factor = np.asarray(ring.flexibility(points), float)
        if factor.shape[:3] != shape or not np.isfinite(factor).all():
            raise InputError(f"{name}: flexibility must be finite {shape}, got {factor.shape}")
        parts.append(factor.reshape(-1, 3, factor.shape[-1]))
    if not parts:
        raise InputError('inner, outer: give at least one ring, or rings="rigid"')
    return np.concatenate(parts, axis=-1)


def _condense(factor: Array, contacts: Contacts, modes: int | None) -> tuple[Array, float, float]:
    """Largest modes under smooth contact forces (ring mode, mode), local compliance, share."""
    table, balls = contacts.table, len(contacts.azimuth)
    normal = table[:, [NORMAL_R, NORMAL_Z]]
    nr, nz = np.repeat(normal / np.linalg.norm(normal, axis=1)[:, None], balls, axis=0).T
    along = nr[:, None] * factor[:, 0] + nz[:, None] * factor[:, 2]
    across = nr[:, None] * factor[:, 2] - nz[:, None] * factor[:, 0]
    energy = _smooth_gram(along, balls)
    weighted = energy + _ACROSS**2 * _smooth_gram(across, balls)
    weighted += _ALONG**2 * _smooth_gram(factor[:, 1], balls)
    values, vectors = np.linalg.eigh(weighted)
    if values[-1] <= 0:
        raise InputError("inner, outer: the rings do not yield at all; use rings='rigid'")
    order = [i for i in np.argsort(values)[::-1] if values[i] > 1e-13 * values[-1]]
    if modes is None:
        held = np.cumsum(values[order]) / values[order].sum()
        enough = int(np.searchsorted(held, 1 - _LEFT_OUT)) + 1
        modes = len(order) if len(order) <= _MOST else min(enough, _MOST)
        # the cosine and sine of a harmonic stay together: which half of the pair comes first is
        # rounding, and either alone would favour a direction
        while modes < len(order) and values[order[modes]] > (1 - _TWIN) * values[order[modes - 1]]:
            modes += 1
    kept = vectors[:, order[:modes]]
    scale = np.ones(kept.shape[1])
    local = 0.0
    if len(order) > modes:
        left = float(np.square(along @ vectors[:, order[modes:]]).sum()) / len(along)
        local = min(_local_compliance(along), left)
        if local < _ROUNDING * np.square(along).sum() / len(along):
            local = 0.0
        # the spring at the contacts takes its part of what the kept modes carry
        carried = np.square(along @ kept).sum(axis=0)
        scale = np.sqrt(np.where(carried > local, 1 - local / np.maximum(carried, 1e-300), 1.0))
    share = np.einsum("am,ab,bm->", kept, energy, kept) / np.trace(energy)
    return kept * scale, local, float(share)


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


def rigid_basis(contacts: Contacts) -> Array:
    """Shift (r, θ, z) of the inner groove centres by (ux, uy, uz, R θx, R θy), (3, contact, 5)."""
    cos, sin = np.cos(contacts.azimuth), np.sin(contacts.azimuth)
    zero = np.zeros_like(cos)
    parts = []
    for radius, height, *_ in contacts.table:
        radial = [cos, sin, zero, -height * sin, height * cos]
        tangential = [-sin, cos, zero, -height * cos, -height * sin]
        axial = [zero, zero, zero + 1, radius * sin, -radius * cos]
        parts.append(np.array([radial, tangential, axial]))
    return np.moveaxis(np.concatenate(parts, axis=-1), 1, -1) * contacts.scale
