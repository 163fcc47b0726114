"""Rings that vibrate: natural frequencies, and the Craig–Bampton form with its masses.

A finite-element ring is reduced to its static modes under loads on the raceway patches and to modes
of vibration with the patches held, [Ritzer 2018] (3.7), (3.8). Stiffness of both is diagonal, the
mass couples them, and couples both to the motion of the structure that carries the ring.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from loadflow.errors import InputError
from loadflow.rolling.contacts import Array
from loadflow.rolling.raceways import Raceway
from loadflow.rolling.rings.finite_element import FiniteElementRing
from loadflow.rolling.rings.harmonics import RingWave, SectionSystem
from loadflow.rolling.rings.patches import PatchPoints, patch_points
from loadflow.rolling.rings.solid_section import SolidSection

if TYPE_CHECKING:
    from loadflow.rolling.raceways import BallRaceways
    from loadflow.rolling.rings.condensed import RingModes
    from loadflow.rolling.rings.flexible import FlexibleRings


@dataclass(frozen=True, eq=False)
class RingMotion:
    """Craig–Bampton form of a ring.

    Unknowns: the static modes of `FiniteElementRing.flexibility`, in its order and of unit
    stiffness, then the modes with held patches, of unit mass.

    Attributes
    ----------
    stiffness : ndarray, shape (mode,)
        Diagonal: 1 for static modes, ω² for the others, 1/s².
    mass : ndarray, shape (mode, mode)
        s² between static modes.
    carried : ndarray, shape (5, mode)
        Momentum of the modes in the motion (ux, uy, uz, θx, θy) of the structure.
    """

    stiffness: Array
    mass: Array
    carried: Array

    @property
    def frequencies(self) -> Array:
        """Natural frequencies of the ring with free patches, rad/s, ascending."""
        from scipy.linalg import eigh

        squares = eigh(np.diag(self.stiffness), self.mass, eigvals_only=True)
        return np.sqrt(np.maximum(squares, 0.0))


def natural_frequencies(ring: SolidSection, harmonic: int, count: int = 4) -> Array:
    """Lowest natural frequencies of a ring of revolution on its bed, rad/s.

    Parameters
    ----------
    ring : FiniteElementRing
        The ring; a bed of 1 N/m³ leaves it practically free.
    harmonic : int
        Waves around the ring.
    count : int
        How many.

    Returns
    -------
    ndarray (count,)
        rad/s, rising.

    Raises
    ------
    InputError
        If `harmonic` or `count` is out of its range.

    Examples
    --------
    >>> from loadflow.rolling import FiniteElementRing, RingProfile, SlewingBearing
    >>> from loadflow.rolling import natural_frequencies
    >>> bearing = SlewingBearing(balls=24, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> profile = RingProfile(bearing=bearing, ring="outer", inside=0.51, outside=0.62,
    ...     bottom=-0.04, top=0.04)
    >>> ring = FiniteElementRing(profile=profile, held="bottom", bed=1.0,
    ...     across=2)  # practically free
    >>> bool(natural_frequencies(ring, 3, 1)[0] > natural_frequencies(ring, 2, 1)[0] > 100.0)
    True
    """
    if harmonic < 0 or count < 1:
        raise InputError(f"harmonic, count: must be >= 0 and >= 1, got {harmonic}, {count}")
    system = SectionSystem(ring)
    squares, _ = _lowest(system.stiffness(harmonic), system.mass, None, count)
    return np.sqrt(np.maximum(squares, 0.0))


def craig_bampton(ring: FiniteElementRing, points: PatchPoints, fixed_modes: int) -> RingMotion:
    """Reduce a ring to its raceway patches with `fixed_modes` modes of vibration.

    Parameters
    ----------
    ring : FiniteElementRing
        The ring.
    points : PatchPoints
        Its patches, equally spaced; the first ball at azimuth 0 of the fixed frame.
    fixed_modes : int
        Modes with held patches, those of lowest frequency of all waves that the balls tell apart.

    Returns
    -------
    RingMotion
        Masses and stiffness of the reduced ring.

    Raises
    ------
    InputError
        If `fixed_modes` is negative.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import FiniteElementRing, RingProfile, SlewingBearing
    >>> from loadflow.rolling import craig_bampton, patch_points
    >>> bearing = SlewingBearing(balls=8, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208, contact_angle=0.785)
    >>> profile = RingProfile(bearing=bearing, ring="outer", inside=0.51, outside=0.62,
    ...     bottom=-0.04, top=0.04)
    >>> ring = FiniteElementRing(profile=profile, held="bottom", across=1)
    >>> points = patch_points(bearing, "outer", 2 * np.pi * np.arange(8) / 8)
    >>> motion = craig_bampton(ring, points, fixed_modes=4)
    >>> type(motion).__name__
    'RingMotion'
    """
    if fixed_modes < 0:
        raise InputError(f"fixed_modes: must be >= 0, got {fixed_modes}")
    system, balls = SectionSystem(ring), len(points.azimuth)
    blocks = [_shapes(system, wave, balls, fixed_modes) for wave in ring.waves(system, points)]
    every = np.sort(np.concatenate([block.squares for block in blocks]))
    limit = every[fixed_modes - 1] if fixed_modes else -1.0
    return _assemble(system, blocks, limit, fixed_modes)


@dataclass(frozen=True, eq=False)
class _Shapes:
    """Fields of a wave over the section: static of unit energy, vibrating of unit mass with ω²."""

    wave: RingWave
    static: Array
    vibrating: Array
    squares: Array


def joint_motion(
    bearing: BallRaceways, rings: FlexibleRings, modes: RingModes, fixed_modes: int
) -> RingMotion:
    """Both rings over the ring modes of a bearing and the vibrations of each ring.

    Raises
    ------
    InputError
        If a flexible ring is no `FiniteElementRing`.
    """
    from scipy.linalg import block_diag

    contacts, motions, inner = bearing.contacts(), [], 0
    names: tuple[Raceway, Raceway] = ("inner", "outer")
    for name in names:
        ring = getattr(rings, name)
        if ring is None:
            continue
        if not isinstance(ring, FiniteElementRing):
            raise InputError(f"{name}: must be a FiniteElementRing to vibrate, got {ring!r}")
        azimuth = contacts.azimuth - getattr(rings, f"{name}_angle")
        points = patch_points(bearing, name, azimuth, rings.shell, rings.turning_patches)
        motions.append(craig_bampton(ring, points, fixed_modes))
        inner = len(motions[-1].stiffness) if name == "inner" else inner
    kept = modes.mixing.shape[1]
    mixed, first, row = [], 0, 0  # both rings in terms of ring modes and vibrations
    for motion in motions:
        statics = len(motion.stiffness) - fixed_modes
        part = np.zeros((len(motion.stiffness), kept + fixed_modes * len(motions)))
        part[:statics, :kept] = modes.mixing[row : row + statics]
        part[statics:, kept + first : kept + first + fixed_modes] = np.eye(fixed_modes)
        mixed.append(part)
        first, row = first + fixed_modes, row + statics
    turn = np.concatenate(mixed)
    vibrating = np.concatenate([m.stiffness[len(m.stiffness) - fixed_modes :] for m in motions])
    # the outer ring's structure rests
    carried = motions[0].carried @ turn[:inner] if inner else np.zeros((5, turn.shape[1]))
    return RingMotion(
        np.concatenate([np.ones(kept), vibrating]),
        turn.T @ block_diag(*(m.mass for m in motions)) @ turn,
        carried,
    )


def _assemble(
    system: SectionSystem,
    blocks: list[_Shapes],
    limit: float,
    fixed_modes: int,
) -> RingMotion:
    """Matrices of all waves, with the vibrations up to ω² = `limit`."""
    statics = sum(block.static.shape[1] for block in blocks)
    size = statics + fixed_modes
    mass, carried = np.zeros((size, size)), np.zeros((5, size))
    stiffness = np.ones(size)
    first, free = 0, statics
    for block in blocks:
        count = block.static.shape[1]
        chosen = np.flatnonzero(block.squares <= limit)[: size - free]
        unknowns = np.r_[first : first + count, free : free + len(chosen)]
        fields = np.concatenate([block.static, block.vibrating[:, chosen]], axis=1)
        inertia = block.wave.weight * (system.mass @ fields)
        mass[np.ix_(unknowns, unknowns)] = fields.T @ inertia
        carried[:, unknowns] = _rigid_fields(system, block.wave) @ inertia
        stiffness[unknowns[count:]] = block.squares[chosen]
        first, free = first + count, free + len(chosen)
    return RingMotion(stiffness, mass, carried)


def _shapes(system: SectionSystem, wave: RingWave, balls: int, count: int) -> _Shapes:
    """Static fields, nearest to the static modes of the wave, and `count` vibrations."""
    from scipy.sparse.linalg import splu

    moving = np.ones(system.basis.N, bool)
    if wave.order == 0:  # one family moves in r and z, the other along the ring
        moving = (np.arange(system.basis.N) % 3 == 1) == (wave.family == 1)
    stiffness = system.stiffness(wave.order)[moving][:, moving].tocsc()
    mass = system.mass[moving][:, moving].tocsc()
    seen = wave.components(balls)
    loads = wave.loads[np.ix_(moving, seen)]
    root = np.linalg.cholesky(loads.T @ splu(stiffness).solve(loads) / wave.weight)
    # the patches' compliance lacks the dents right under them, which hardly carry mass
    left, _, right = np.linalg.svd(np.linalg.solve(root, wave.factor[seen]), full_matrices=False)
    loads = loads @ np.linalg.solve(root.T, left @ right) / wave.weight
    static = np.zeros((system.basis.N, loads.shape[1]))
    static[moving] = splu(stiffness).solve(loads)
    vibrating, squares = np.zeros((system.basis.N, count)), np.zeros(count)
    if count:
        squares, vibrating[moving] = _lowest(stiffness, mass, loads, count)
    return _Shapes(wave, static, vibrating / np.sqrt(wave.weight), squares)


def _lowest(stiffness: Any, mass: Any, held: Array | None, count: int) -> tuple[Array, Array]:
    """Lowest ω² and shapes of unit mass; displacements that loads `held` work on stay zero."""
    from scipy.sparse.linalg import LinearOperator, eigsh, splu

    inverse = splu(stiffness)
    if held is None:
        solve = inverse.solve
    else:
        reach = inverse.solve(held)
        pulled = np.linalg.solve(held.T @ reach, reach.T)

        def solve(load: Array) -> Array:
            return inverse.solve(load) - reach @ (pulled @ load)

    size = stiffness.shape[0]
    squares, shapes = eigsh(
        stiffness, count, mass, sigma=0.0, OPinv=LinearOperator((size, size), solve),
        v0=solve(mass @ np.linspace(1, 2, size)),
    )  # fmt: skip
    order = np.argsort(squares)
    return squares[order], shapes[:, order]


def _rigid_fields(system: SectionSystem, wave: RingWave) -> Array:
    """Fields over the section of a unit (ux, uy, uz, θx, θy) in a wave, (5, unknown)."""
    r, z = system.basis.doflocs
    part = np.arange(r.size) % 3
    u, v, w = (np.where(part == c, 1.0, 0.0) for c in range(3))
    fields = np.zeros((5, r.size))
    if wave.order == 0 and wave.family == 0:
        fields[2] = w
    elif wave.order == 1:
        shift, tilt = (0, 4) if wave.family == 0 else (1, 3)
        fields[shift] = u - v
        fields[tilt] = (z * (u - v) - r * w) * (1 if tilt == 4 else -1)
    return fields
