"""A shaft line in matrices: beam elements, discs with gyroscopic moments, bearings, housings.

The shaft is a chain of Timoshenko's beam elements with two nodes (Przemieniecki 1968), rotor,
gearbox and generator are rigid discs with gyroscopic moments, bearings are stiffness and damping.
Each node has the displacements x and y and the slopes x′ and y′ along the shaft. The axes are those
of a film: the third one along the shaft, downwind, and the rotation turns x to y.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.shaft.beam import Beam, ShaftSection

Floats = NDArray[np.float64]

DOF = ("x", "y", "x'", "y'")
"""Degrees of freedom of a node: displacements (m) and slopes along the shaft (rad)."""

_PLANES = ([0, 2, 4, 6], [1, 3, 5, 7])
"""Of an element, (w₁, φ₁, w₂, φ₂) in the plane of x and in that of y."""


@dataclass(frozen=True)
class Disc:
    """A rigid body on the shaft.

    Attributes
    ----------
    position : float
        m from the hub centre.
    mass : float
        kg.
    polar_inertia, inertia : float
        About the shaft and across it, kg m².

    Examples
    --------
    >>> from loadflow.shaft import Disc
    >>> Disc(position=0.0, mass=1.1e5, polar_inertia=3.9e7, inertia=1.9e7).mass
    110000.0
    """

    position: float
    mass: float
    polar_inertia: float = 0.0
    inertia: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not math.isfinite(value) or (name != "position" and value < 0):
                raise InputError(f"{name} = {value}: must be finite, and >= 0 of a mass")


@dataclass(frozen=True)
class LineSupport:
    """What carries the shaft at a place.

    Attributes
    ----------
    position : float
        m from the hub centre.
    stiffness, damping : array_like, shape (2, 2) or (4, 4), optional
        Of x and y, N/m and N s/m, or of all of `DOF`, with N, N m and N s, N m s; no stiffness:
        rigid against displacement, no damping: none.
    housing : tuple of float or None
        Stiffness of the housing along x and y in series, N/m; None: rigid. Not beside a bearing
        is rigid itself.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.shaft import LineSupport
    >>> film = LineSupport(1.9, stiffness=1e9 * np.eye(2), housing=(8e9, None))
    >>> [matrix.shape for matrix in film.matrices()]
    [(2, 2), (2, 2)]
    """

    position: float
    stiffness: ArrayLike | None = None
    damping: ArrayLike | None = None
    housing: tuple[float | None, float | None] = (None, None)

    def matrices(self) -> tuple[Floats, Floats]:
        """Stiffness and damping, (2, 2) or (4, 4)."""
        k = np.asarray(self.stiffness, dtype=float)
        c = np.zeros_like(k) if self.damping is None else np.asarray(self.damping, dtype=float)
        square = k.shape in ((2, 2), (4, 4)) and c.shape == k.shape
        if not square or not (np.isfinite(k).all() and np.isfinite(c).all()):
            raise InputError(
                f"support at {self.position} m: stiffness {k.shape} and damping {c.shape} must be "
                "finite and both (2, 2) or (4, 4)"
            )
        return k, c


@dataclass(frozen=True)
class ShaftLine:
    """A shaft with what turns on it.

    Attributes
    ----------
    beam : Beam
        Sections, material; its supports are not read.
    length : float
        From the hub centre to the end, m.
    discs : tuple of Disc
        Rotor, gearbox, generator.
    density : float
        Of the shaft, kg/m³; 0: without mass.
    elements : int
        Least number of beam elements; each section, disc and support begins a new one besides.

    Examples
    --------
    >>> from loadflow.shaft import Beam, Disc, LineSupport, ShaftLine, ShaftSection, modes
    >>> line = ShaftLine(Beam((ShaftSection(0.1),)), length=2.0)
    >>> pinned = modes(line, [LineSupport(0.0), LineSupport(2.0)], speed=0.0, count=2)
    >>> [round(float(f)) for f in pinned.natural_frequency]  # rad/s; slender: (π/L)² √(EI/ρA) = 319
    [318, 318]
    """

    beam: Beam
    length: float
    discs: tuple[Disc, ...] = ()
    density: float = 7850.0
    elements: int = 24

    def __post_init__(self) -> None:
        if not 0 < self.length < math.inf:
            raise InputError(f"length = {self.length} m: must be greater than 0")
        if not 0 <= self.density < math.inf or self.elements < 1:
            raise InputError(
                f"density = {self.density} kg/m³ must be >= 0, elements = {self.elements} >= 1"
            )
        for disc in self.discs:
            if not 0 <= disc.position <= self.length:
                raise InputError(
                    f"disc at {disc.position} m: the shaft is 0 … {self.length} m long"
                )


@dataclass
class System:
    """Assembled matrices; the last rows are housings without mass."""

    nodes: Floats
    mass: Floats
    gyroscopic: Floats  # per rad/s of the shaft
    stiffness: Floats
    damping: Floats
    held: list[int] = field(default_factory=list)

    def free(self, speed: float) -> tuple[Floats, Floats, Floats, NDArray[np.int64]]:
        """M, C and K at a speed without what is held, and what is free."""
        left = np.setdiff1d(np.arange(len(self.mass)), self.held)
        both = np.ix_(left, left)
        return (
            self.mass[both],
            (self.damping + speed * self.gyroscopic)[both],
            self.stiffness[both],
            left,
        )

    def at(self, position: float) -> int:
        """First row of the node at a place."""
        return 4 * int(np.argmin(np.abs(self.nodes - position)))


def assembled(
    line: ShaftLine, supports: Sequence[LineSupport], places: Sequence[float] = ()
) -> System:
    """Matrices of line and supports, with a node at each of `places`."""
    stretches = line.beam.stretches(line.length)
    marks = {0.0, line.length, *places, *(disc.position for disc in line.discs)}
    marks |= {support.position for support in supports} | {start for start, _, _ in stretches}
    for mark in marks:
        if not 0 <= mark <= line.length:
            raise InputError(f"support at {mark} m: the shaft is 0 … {line.length} m long")
    nodes = _nodes(sorted(marks), line.length / line.elements)
    extra = sum(s.stiffness is not None and any(s.housing) for s in supports)
    size = 4 * len(nodes) + 2 * extra
    stiffness, mass, damping, gyroscopic = (np.zeros((size, size)) for _ in range(4))
    system = System(nodes, mass, gyroscopic, stiffness, damping)
    for number, (left, right) in enumerate(pairwise(nodes)):
        middle = (left + right) / 2
        section = next(s for start, stop, s in stretches if start <= middle <= stop)
        bending, inertia, rotary = _element(line, section, float(right - left))
        rows = 4 * number + np.arange(8)
        for plane in _PLANES:
            own = np.ix_(rows[plane], rows[plane])
            system.stiffness[own] += bending
            system.mass[own] += inertia
        # of a round section the polar inertia is twice that across
        one, other = rows[_PLANES[0]], rows[_PLANES[1]]
        system.gyroscopic[np.ix_(one, other)] += 2 * rotary
        system.gyroscopic[np.ix_(other, one)] -= 2 * rotary
    for disc in line.discs:
        row = system.at(disc.position)
        for i, value in enumerate((disc.mass, disc.mass, disc.inertia, disc.inertia)):
            system.mass[row + i, row + i] += value
        system.gyroscopic[row + 2, row + 3] += disc.polar_inertia
        system.gyroscopic[row + 3, row + 2] -= disc.polar_inertia
    place = 4 * len(nodes)
    for support in supports:
        row = system.at(support.position)
        if support.stiffness is None:
            system.held += [row, row + 1]
            continue
        k, c = support.matrices()
        joined = np.arange(row, row + len(k))
        if not any(support.housing):
            system.stiffness[np.ix_(joined, joined)] += k
            system.damping[np.ix_(joined, joined)] += c
            continue
        moving = np.arange(place, place + 2)
        spread = np.zeros((len(k), size))  # motion of the shaft against the housing
        spread[np.arange(len(k)), joined] = 1.0
        spread[[0, 1], moving] -= 1.0
        system.stiffness += spread.T @ k @ spread
        system.damping += spread.T @ c @ spread
        for i, stiff in enumerate(support.housing):
            if stiff is None:
                system.held.append(int(moving[i]))
            else:
                system.stiffness[moving[i], moving[i]] += stiff
        place += 2
    return system


def _nodes(marks: list[float], longest: float) -> Floats:
    """Marks, and nodes between them so that no element is longer than `longest`."""
    parts = [
        np.linspace(a, b, max(math.ceil((b - a) / longest - 1e-9), 1), endpoint=False)
        for a, b in pairwise(marks)
    ]
    return np.concatenate([*parts, [marks[-1]]])


def _element(
    line: ShaftLine, section: ShaftSection, length: float
) -> tuple[Floats, Floats, Floats]:
    """Stiffness, mass (its rotation included) and mass of rotation of (w₁, φ₁, w₂, φ₂)."""
    beam, l = line.beam, length  # noqa: E741
    stiff = beam.youngs_modulus * section.inertia
    phi = 0.0
    if beam.shear:
        rigidity = beam.youngs_modulus / (2 * (1 + beam.poisson)) * section.area
        phi = 12 * stiff / (rigidity * section.shear_coefficient(beam.poisson) * l**2)
    bending = (
        stiff
        / (l**3 * (1 + phi))
        * np.array(
            [
                [12, 6 * l, -12, 6 * l],
                [6 * l, (4 + phi) * l**2, -6 * l, (2 - phi) * l**2],
                [-12, -6 * l, 12, -6 * l],
                [6 * l, (2 - phi) * l**2, -6 * l, (4 + phi) * l**2],
            ]
        )
    )
    # rows of the consistent mass of Przemieniecki (1968), (11.34) and (11.35)
    a = 13 / 35 + 7 * phi / 10 + phi**2 / 3
    b = 9 / 70 + 3 * phi / 10 + phi**2 / 6
    c = (11 / 210 + 11 * phi / 120 + phi**2 / 24) * l
    d = (13 / 420 + 3 * phi / 40 + phi**2 / 24) * l
    e = (1 / 105 + phi / 60 + phi**2 / 120) * l**2
    f = (1 / 140 + phi / 60 + phi**2 / 120) * l**2
    moved = (
        line.density
        * section.area
        * l
        / (1 + phi) ** 2
        * np.array([[a, c, b, -d], [c, e, d, -f], [b, d, a, -c], [-d, -f, -c, e]])
    )
    g, h = 6 / 5, (1 / 10 - phi / 2) * l
    i = (2 / 15 + phi / 6 + phi**2 / 3) * l**2
    j = (-1 / 30 - phi / 6 + phi**2 / 6) * l**2
    turned = (
        line.density
        * section.inertia
        / (l * (1 + phi) ** 2)
        * np.array([[g, h, -g, h], [h, i, -h, j], [-g, -h, g, -h], [h, j, -h, i]])
    )
    return bending, moved + turned, turned
