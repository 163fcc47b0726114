"""Factors of the coherence matrix: what makes independent noise a coherent wind field.

The coherence exp(−κ r) depends on frequency, wind speed and length scale through the one decay κ,
so the Cholesky factors of a grid are a function of κ alone. `CoherenceFactors` holds them on a few
knots over log κ and interpolates: one object serves all seeds *and* all wind speeds of a study.

On a polar grid the coherence matrix is circulant in the angle. A Fourier transform over the angle
splits it into one small matrix per azimuthal order, so even the exact factors cost little.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.wind.field import check_polar_grid
from loadflow.wind.iec import Floats

#: Coherence between nearest neighbours below which all points are taken as independent.
NEGLIGIBLE = 1e-4


class Grid(Protocol):
    """Points whose coherence matrix splits into `blocks` matrices of order `order`."""

    @property
    def points(self) -> NDArray[np.complex128]:
        """Positions as complex numbers, m."""

    @property
    def blocks(self) -> int:
        """Number of independent blocks."""

    @property
    def order(self) -> int:
        """Order of each block."""

    @property
    def spacing(self) -> float:
        """Smallest distance of two points, m."""

    @property
    def uncorrelated(self) -> Floats:
        """Diagonals (blocks, order) of the factors when all points are independent."""

    def factors(self, decay: Floats) -> Floats:
        """Lower Cholesky factors (len(decay), blocks, order, order) at decays κ in 1/m."""

    def to_points(self, spectra: NDArray[np.complex64]) -> NDArray[np.complex64]:
        """Spectra of the blocks (blocks, order, nf) → spectra of the points, time last."""


@dataclass(frozen=True, eq=False)
class PolarGrid:
    """Rings around the hub; block n is the azimuthal order n, its order the number of radii.

    Attributes
    ----------
    radius : (nr,) ndarray
        Radii from 0 (the hub, one point that stands at every angle), m.
    angle : (na,) ndarray
        Equidistant angles, rad.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.wind import PolarGrid, polar_angles
    >>> grid = PolarGrid(np.array([0.0, 30.0, 60.0]), polar_angles(8))
    >>> grid.points.size
    24
    """

    radius: Floats
    angle: Floats

    def __post_init__(self) -> None:
        check_polar_grid(self.radius, self.angle)

    @property
    def points(self) -> NDArray[np.complex128]:
        """Positions as complex numbers (nr, na), m."""
        return self.radius[:, None] * np.exp(1j * self.angle)

    @property
    def blocks(self) -> int:
        """Number of azimuthal orders."""
        return len(self.angle)

    @property
    def order(self) -> int:
        """Number of radii."""
        return len(self.radius)

    @cached_property
    def distance(self) -> Floats:
        """Distances of (radius i, angle 0) and (radius j, angle k), (nr, nr, na), m."""
        gap = self.points[:, None, :1] - self.points
        return np.hypot(gap.real, gap.imag)

    @property
    def spacing(self) -> float:
        """Smallest distance of two points, m."""
        return float(self.distance[self.distance > 0].min())

    @property
    def uncorrelated(self) -> Floats:
        """Diagonals of the factors when all points are independent."""
        diagonal = np.ones((self.blocks, self.order))
        # the hub is one point, the same at all angles: all of it is in the order 0
        diagonal[:, 0] = 0
        diagonal[0, 0] = np.sqrt(self.blocks)
        return diagonal

    def factors(self, decay: Floats) -> Floats:
        """Lower Cholesky factors (len(decay), na, nr, nr) of every azimuthal order."""
        correlation = np.exp(-decay[:, None, None, None] * self.distance)
        # rows and columns of a circulant matrix: its eigenvalues are real and even in the order
        spectrum = np.moveaxis(np.fft.rfft(correlation).real, -1, 1).copy()
        spectrum[:, 1:, 0, 0] = 1  # zero, the hub has order 0 only; 1 lets Cholesky pass
        lower = np.asarray(np.linalg.cholesky(spectrum), dtype=np.float64)
        lower[:, 1:, 0, 0] = 0
        order = np.arange(self.blocks)
        return lower[:, np.minimum(order, self.blocks - order)]

    def to_points(self, spectra: NDArray[np.complex64]) -> NDArray[np.complex64]:
        """Azimuthal orders → angles; the result is (na, nr, nf)."""
        import scipy.fft

        return scipy.fft.ifft(spectra, axis=0, norm="ortho", overwrite_x=True)


@dataclass(frozen=True, eq=False)
class PointGrid:
    """Any points in the plane across the wind: one block of full order.

    Attributes
    ----------
    y, z : (n,) ndarray
        Coordinates, m; no two points coincide.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.wind import PointGrid
    >>> PointGrid(y=np.array([0.0, 30.0]), z=np.array([90.0, 90.0])).distance.round(1).tolist()
    [[0.0, 30.0], [30.0, 0.0]]
    """

    y: Floats
    z: Floats

    def __post_init__(self) -> None:
        if self.y.ndim != 1 or self.y.shape != self.z.shape or len(self.y) < 2:
            raise InputError("a point grid needs y and z of equal length, at least 2 points")
        if self.spacing == 0:
            raise InputError("two points of the grid coincide")

    @property
    def points(self) -> NDArray[np.complex128]:
        """Positions as complex numbers (n,), m."""
        return self.y + 1j * self.z

    @property
    def blocks(self) -> int:
        """One."""
        return 1

    @property
    def order(self) -> int:
        """Number of points."""
        return len(self.y)

    @cached_property
    def distance(self) -> Floats:
        """Distances of all points, (n, n), m."""
        gap = self.points[:, None] - self.points
        return np.hypot(gap.real, gap.imag)

    @property
    def spacing(self) -> float:
        """Smallest distance of two points, m."""
        return float(self.distance[~np.eye(self.order, dtype=bool)].min())

    @property
    def uncorrelated(self) -> Floats:
        """Diagonals of the factors when all points are independent."""
        return np.ones((1, self.order))

    def factors(self, decay: Floats) -> Floats:
        """Lower Cholesky factors (len(decay), 1, n, n)."""
        lower = np.empty((len(decay), 1, self.order, self.order))
        for k, kappa in enumerate(decay):
            lower[k, 0] = np.linalg.cholesky(np.exp(-kappa * self.distance))
        return lower

    def to_points(self, spectra: NDArray[np.complex64]) -> NDArray[np.complex64]:
        """Drop the axis of the one block; the result is (n, nf)."""
        return spectra[0]


def same_points(a: Grid, b: Grid) -> bool:
    """Whether two grids are of one kind and have the same points."""
    return type(a) is type(b) and np.array_equal(a.points, b.points)


class CoherenceFactors:
    """Factors of a grid on knots over log κ, to be interpolated linearly.

    Parameters
    ----------
    grid : PolarGrid or PointGrid
        The points.
    length_scale : float
        Λ1 in m; it sets the smallest decay, that of frequency zero.
    knots : int
        Number of knots. The error falls with its square: 96 knots give 4e-4 in the coherence.

    Notes
    -----
    Above the decay at which nearest neighbours keep a coherence of 1e-4 the points are taken as
    independent. On a fine time grid most frequencies are there and cost nothing.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.wind import CoherenceFactors, PolarGrid, polar_angles
    >>> factors = CoherenceFactors(PolarGrid(np.linspace(0, 63, 8), polar_angles(16)), 42.0)
    >>> factors.table.shape
    (96, 16, 8, 8)
    """

    def __init__(self, grid: Grid, length_scale: float, knots: int = 96) -> None:
        from loadflow.wind.spectra import coherence_decay

        if knots < 2:
            raise InputError(f"knots = {knots} must be at least 2")
        self.grid = grid
        self.length_scale = length_scale
        lowest = float(coherence_decay(0.0, 1.0, length_scale))
        highest = max(-np.log(NEGLIGIBLE) / grid.spacing, 2 * lowest)
        self.decay = np.geomspace(lowest, highest, knots)
        self.table = np.concatenate(
            [
                grid.factors(part).astype(np.float32)
                for part in np.array_split(self.decay, knots // 8 + 1)
            ]
        )

    @cached_property
    def reach(self) -> NDArray[np.int64]:
        """Diagonals below the main one that count in single precision, (knots,).

        On a polar grid distant radii no longer know of each other at most frequencies.
        """
        rows = np.sqrt((self.table**2).sum(axis=-1, keepdims=True))
        counts = (np.abs(self.table) > np.finfo(np.float32).eps * rows).any(axis=1)
        place = np.arange(self.grid.order)
        return np.asarray((counts * (place[:, None] - place)).max(axis=(1, 2)))

    def correlate(self, noise: NDArray[np.complex64], decay: Floats) -> None:
        """Give independent unit noise the coherence of the grid, in place.

        Parameters
        ----------
        noise : (blocks, order, nf) ndarray of complex64
            Independent noise of each block; contiguous.
        decay : (nf,) ndarray
            Decay κ at each frequency, rising, 1/m.
        """
        from loadflow.wind._kernels import multiply_banded

        knots = len(self.decay)
        step = np.log(self.decay[1] / self.decay[0])
        place = np.log(decay / self.decay[0]) / step
        edges = np.searchsorted(place, np.arange(knots))
        edges[0] = 0
        # a real factor times complex noise: real and imaginary parts are just twice the columns
        pairs = noise.view(np.float32)
        for k in np.flatnonzero(np.diff(edges)):
            part = slice(edges[k], edges[k + 1])
            columns = pairs[..., 2 * part.start : 2 * part.stop]
            upper = np.repeat((place[part] - k).astype(np.float32), 2)
            low, high = self.table[k : k + 2]
            reach = int(self.reach[k : k + 2].max())
            if reach < self.grid.order // 2:  # most of a full product would be zeros
                multiply_banded(columns, upper, low, high, reach)
            else:
                columns[...] = low @ (columns * (1 - upper)) + high @ (columns * upper)
        noise[..., edges[-1] :] *= self.grid.uncorrelated[..., None].astype(np.float32)


class ExactFactors:
    """Factors computed anew at every frequency: the reference for `CoherenceFactors`."""

    def __init__(self, grid: Grid, length_scale: float) -> None:
        self.grid = grid
        self.length_scale = length_scale

    def correlate(self, noise: NDArray[np.complex64], decay: Floats) -> None:
        """See `CoherenceFactors.correlate`."""
        chunk = max(1, 4_000_000 // (self.grid.blocks * self.grid.order**2))
        for start in range(0, len(decay), chunk):
            part = slice(start, start + chunk)
            lower = self.grid.factors(decay[part])
            noise[..., part] = np.einsum("fbij,bjf->bif", lower, noise[..., part], optimize=True)
