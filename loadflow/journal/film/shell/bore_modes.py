"""Modes in which a bore gives way, on places of its own, and on the cells of any film.

The growth of the gap under a pressure p is ``Σ λ_i φ_i ∫ φ_i p dA`` with modes φ_i whose squares
integrate to one over the bore.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import require
from loadflow.numerics.matrix_file import digest_of

if TYPE_CHECKING:
    from loadflow.journal.housings import InfluenceShell

Array = NDArray[np.float64]

_RECIPROCAL = 1e-3  # asymmetry of an influence matrix, over its largest number, that is let pass
_AROUND = 3  # places that are repeated on both sides of a turn, for a smooth interpolation


@dataclass(frozen=True, eq=False)
class BoreModes:
    """Modes of a bore.

    Attributes
    ----------
    angle : array (n,)
        rad, rising within one turn.
    axial : array (m,)
        m, from the middle of the bearing.
    shapes : array (k, n, m)
        φ_i there, 1/m.
    compliances : array (k,)
        λ_i, m³/N, falling.
    """

    angle: Array
    axial: Array
    shapes: Array
    compliances: Array

    def at(self, angle: Array, axial: Array) -> Array:
        """Shapes (k, a, b) at other places, by cubic splines; `angle` (a,), `axial` (b,)."""
        from scipy.interpolate import CubicSpline

        turn = np.append(self.angle, self.angle[0] + 2 * math.pi)
        closed = np.concatenate([self.shapes, self.shapes[:, :1]], axis=1)
        around = CubicSpline(turn, closed, axis=1, bc_type="periodic")
        places = turn[0] + np.remainder(angle - turn[0], 2 * math.pi)
        return np.asarray(CubicSpline(self.axial, around(places), axis=2)(axial))

    @property
    def influence(self) -> Array:
        """Influence matrix (n m, n m) of the places, m/N, the axial one running fastest."""
        flat = self.shapes.reshape(len(self.shapes), -1)
        return np.asarray((flat.T * self.compliances) @ flat)


def leading(compliance: Array, aside: Array, accuracy: float) -> tuple[Array, Array]:
    """Eigenvalues and vectors of a `compliance` (n, n) in an orthonormal basis that count.

    Those below `accuracy` of the largest are left out, where the displacements `aside` (n, 2) of a
    bore as a whole, which a shaft follows without a change of its film, do not count.
    """
    whole = np.linalg.qr(aside)[0]
    values, vectors = np.linalg.eigh(compliance)
    rest = compliance - whole @ (whole.T @ compliance)
    rest -= (rest @ whole) @ whole.T
    largest = float(np.linalg.eigvalsh(rest)[-1])
    kept = np.flatnonzero(values > accuracy * max(largest, 0.0))[::-1]
    return values[kept], vectors[:, kept]


@lru_cache(maxsize=8)
def modes_of_file(shell: InfluenceShell, radius: float, width: float) -> BoreModes:
    """Modes of the influence matrix in the file of `shell`, for a bore of `radius` and `width`, m.

    Raises
    ------
    loadflow.errors.InputError
        A file that cannot be read or lacks a field; places that are not on the bore; a matrix that
        is not reciprocal.
    """
    digest_of(shell.file, "file", shell.sha256)
    angle, axial, matrix = (np.asarray(part, dtype=float) for part in _read(shell.file))
    size = angle.size * axial.size
    named = f"in {str(shell.file)!r}"
    require(matrix.size == size**2, f"influence {named}", matrix.shape, f"({size}, {size})")
    require(angle.size >= 8, f"angle {named}", angle.size, "8 places or more")
    require(axial.size >= 3, f"axial {named}", axial.size, "3 places or more")
    for name, part in (("angle", angle), ("axial", axial), ("influence", matrix)):
        require(bool(np.isfinite(part).all()), f"{name} {named}", "NaN or infinite", "finite")
    rising = bool((np.diff(angle) > 0).all()) and angle[-1] - angle[0] < 2 * math.pi
    require(rising, f"angle {named}", (angle[0], angle[-1]), "rising, rad, through one turn")
    gap = float(np.diff(np.append(angle, angle[0] + 2 * math.pi)).max())
    require(gap < 0.6, f"angle {named}", gap, "no more than 0.6 rad between places")
    require(bool((np.diff(axial) > 0).all()), f"axial {named}", axial.tolist(), "rising, m")
    close = 1e-3 * width
    over = axial[0] <= -0.5 * width + close and axial[-1] >= 0.5 * width - close
    half = 0.5 * width
    require(
        over, f"axial {named}", (axial[0], axial[-1]), f"from {-half:.6g} to {half:.6g} m or beyond"
    )
    matrix = matrix.reshape(size, size)
    skew = float(np.abs(matrix - matrix.T).max()) / float(np.abs(matrix).max())
    require(skew < _RECIPROCAL, f"influence {named}", f"asymmetric by {skew:.3g}", "reciprocal")
    areas = np.sqrt(np.outer(radius * _shares_around(angle), _shares(axial)).ravel())
    both = np.stack([np.cos(angle), np.sin(angle)])[:, :, None] * np.ones(axial.size)
    aside = both.reshape(2, -1).T * areas[:, None]
    work = areas[:, None] * (0.5 * (matrix + matrix.T)) * areas
    values, vectors = leading(work, aside, shell.accuracy)
    require(values.size > 0, f"influence {named}", "no positive mode", "positive definite")
    shapes = (vectors / areas[:, None]).T.reshape(-1, angle.size, axial.size)
    return BoreModes(angle, axial, shapes, values)


def _shares(places: Array) -> Array:
    """Lengths that belong to places on a line."""
    middles = 0.5 * (places[1:] + places[:-1])
    return np.diff(np.concatenate([places[:1], middles, places[-1:]]))


def _shares_around(angle: Array) -> Array:
    """Arcs that belong to places around, rad."""
    turn = np.concatenate([[angle[-1] - 2 * math.pi], angle, [angle[0] + 2 * math.pi]])
    return 0.5 * (turn[2:] - turn[:-2])


def _read(path: str | Path) -> tuple[Any, Any, Any]:
    """Angle, axial place and influence matrix of a file."""
    import xarray as xr

    names = ("angle", "axial", "influence")
    try:
        if Path(path).suffix == ".npz":
            with np.load(path, allow_pickle=False) as file:
                angle, axial, matrix = (file[name] for name in names)
        else:
            with xr.open_dataset(path) as table:
                angle, axial, matrix = (table[name].to_numpy() for name in names)
        return angle, axial, matrix
    except OSError as error:
        raise InputError(f"file = {str(path)!r}: cannot be read: {error}") from error
    except KeyError as error:
        raise InputError(f"file = {str(path)!r}: has no {error.args[0]}") from error
    except ValueError as error:
        raise InputError(f"file = {str(path)!r}: is no NetCDF file: {error}") from error
