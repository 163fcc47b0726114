"""Rings given by a matrix: ring plus hub, tower or blade root, condensed elsewhere."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import ArrayLike

from loadflow.errors import InputError, SolverError
from loadflow.numerics.matrix_file import digest_of, read_matrix
from loadflow.rolling.contacts import Array
from loadflow.rolling.rings.patches import PatchPoints


def guyan(stiffness: ArrayLike, masters: ArrayLike) -> Array:
    """Condense a stiffness matrix to some of its unknowns, S_mm - S_ms S_ss⁻¹ S_sm.

    Parameters
    ----------
    stiffness : array_like or sparse matrix, shape (n, n)
        Symmetric; positive definite on the unknowns that vanish.
    masters : array_like of int, shape (m,)
        Unknowns that stay.

    Returns
    -------
    ndarray, shape (m, m)
        In the order of `masters`.

    Raises
    ------
    InputError
        If the matrix is not square or `masters` are not different unknowns of it.
    SolverError
        If the other unknowns can move without resistance.

    Examples
    --------
    >>> from loadflow.rolling import guyan
    >>> guyan([[1.0, -1.0], [-1.0, 3.0]],
    ...     masters=[0]).round(4).tolist()  # springs 1 and 2 in series
    [[0.6667]]
    """
    from scipy.sparse import csc_matrix, issparse
    from scipy.sparse.linalg import splu

    matrix = csc_matrix(stiffness if issparse(stiffness) else np.asarray(stiffness, float))
    size = matrix.shape[0]
    keep = np.asarray(masters)
    if matrix.shape != (size, size):
        raise InputError(f"stiffness: must be square, got {matrix.shape}")
    if keep.ndim != 1 or len(np.unique(keep)) != len(keep) or keep.min() < 0 or keep.max() >= size:
        raise InputError(f"masters: must be different unknowns below {size}, got {masters!r}")
    rest = np.setdiff1d(np.arange(size), keep)
    dense = matrix[keep][:, keep].toarray()
    if not len(rest):
        return dense
    coupling = matrix[rest][:, keep].toarray()
    try:
        inner = splu(matrix[rest][:, rest])
    except RuntimeError as error:
        raise SolverError(
            f"stiffness: the other unknowns move without resistance: {error}"
        ) from None
    condensed = dense - coupling.T @ inner.solve(coupling)
    return (condensed + condensed.T) / 2


@dataclass(frozen=True, eq=False)
class CompliantRing:
    """A ring with all that it is bolted to, by its compliance at the raceway patches.

    Attributes
    ----------
    compliance : array_like, shape (3 n, 3 n)
        Displacements of the n patches under unit forces on them, m/N, symmetric. Patches in the
        order of `patch_points`, (row, diagonal, ball), of rollers (row, end, roller), the end
        toward -z first; three components each.
    axes : {"cylindrical", "cartesian"}
        Components (r, θ, z) of each patch, or (x, y, z) of the ring's frame.
    first_angle : float
        Azimuth of the first ball in the ring's frame, rad.

    Raises
    ------
    InputError
        If the matrix is not square, finite, symmetric and positive semidefinite.

    Notes
    -----
    Hertz's law counts what a ring yields right under a ball: form the matrix with loads spread over
    a patch and take off what a half-space yields under it
    (`loadflow.rolling.rings.local_compliance`), as `FiniteElementRing` and `SolidRing` do; else it
    is counted twice, the more the finer the mesh.

    Balls sit where the matrix was formed, or whole ball pitches on: a structure that is not
    rotationally symmetric is turned by ball pitches without another condensation.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.rolling import CompliantRing
    >>> ring = CompliantRing(1e-11 * np.eye(3 * 48))
    >>> ring.axes
    'cylindrical'
    """

    compliance: ArrayLike
    axes: Literal["cylindrical", "cartesian"] = "cylindrical"
    first_angle: float = 0.0

    def __post_init__(self) -> None:
        if self.axes not in ("cylindrical", "cartesian"):
            raise InputError(f"axes: must be cylindrical or cartesian, got {self.axes!r}")
        matrix = np.asarray(self.compliance, float)
        if matrix.ndim != 2 or matrix.shape[0] != matrix.shape[1] or matrix.shape[0] % 3:
            raise InputError(f"compliance: must be square with 3 n rows, got {matrix.shape}")
        if not np.isfinite(matrix).all():
            raise InputError("compliance: must be finite")
        if not np.allclose(matrix, matrix.T, rtol=0, atol=1e-6 * np.abs(matrix).max()):
            raise InputError("compliance: must be symmetric")

    @classmethod
    def from_stiffness(
        cls,
        stiffness: ArrayLike,
        axes: Literal["cylindrical", "cartesian"] = "cylindrical",
        first_angle: float = 0.0,
    ) -> CompliantRing:
        """Ring from its stiffness at the patches (N/m), condensed, with its supports.

        Raises
        ------
        InputError
            If the matrix is singular: hold the ring by its supports before condensing.
        """
        matrix = np.asarray(stiffness, float)
        try:
            compliance = np.linalg.inv(np.linalg.cholesky(matrix))
        except np.linalg.LinAlgError as error:
            raise InputError(
                f"stiffness: must be positive definite, hold the ring by supports ({error})"
            ) from None
        return cls(compliance.T @ compliance, axes, first_angle)

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q, (kind, ball, 3, mode), of C = Q Qᵀ; see `RingBeam.flexibility`.

        Raises
        ------
        InputError
            If the matrix does not fit the bearing, or balls are not at the stations it was formed
            at.
        """
        kinds, balls = len(points.radius), len(points.azimuth)
        matrix = np.asarray(self.compliance, float)
        if matrix.shape[0] != 3 * kinds * balls:
            raise InputError(
                f"compliance: the bearing has {kinds * balls} patches, the matrix is {matrix.shape}"
            )
        values, vectors = np.linalg.eigh((matrix + matrix.T) / 2)
        if values[0] < -1e-6 * values[-1]:
            raise InputError(
                f"compliance: must be positive semidefinite, its lowest eigenvalue is "
                f"{values[0]:.3g} m/N beside {values[-1]:.3g}"
            )
        kept = values > 1e-14 * values[-1]
        factor = (vectors[:, kept] * np.sqrt(values[kept])).reshape(kinds, balls, 3, -1)
        pitch = 2 * math.pi / balls
        steps = (points.azimuth[0] - self.first_angle) / pitch
        if abs(steps - round(steps)) > 1e-6:
            raise InputError(
                f"ball_angle, ring angles: must be whole ball pitches of {pitch:g} rad for a given "
                f"compliance, got {steps:g} of them"
            )
        if self.axes == "cartesian":
            station = self.first_angle + pitch * np.arange(balls)
            cos, sin = np.cos(station)[:, None], np.sin(station)[:, None]
            x, y = factor[..., 0, :], factor[..., 1, :]
            factor = np.stack([x * cos + y * sin, y * cos - x * sin, factor[..., 2, :]], axis=2)
        return np.roll(factor, -round(steps), axis=1)


@dataclass(frozen=True)
class MatrixRing:
    """A ring with all that it is bolted to, by a matrix in a file, as a scene names it.

    Attributes
    ----------
    file : str
        Of numpy (``.npy``) or rows of text: the matrix at the raceway patches, (3 n, 3 n), in the
        order of `CompliantRing`.
    form : {"compliance", "stiffness"}
        m/N, or N/m of a ring that is held by its supports.
    axes, first_angle
        As in `CompliantRing`. In a scene the angle is that from y toward z of the load cube.
    sha256 : str
        Of the file; filled in. Where it is stated, the file must still be that one.

    Raises
    ------
    InputError
        The file is missing, has changed, or does not hold such a matrix.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from loadflow.rolling import MatrixRing
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(Path(folder) / "hub.npy", 1e-11 * np.eye(3 * 48))
    ...     ring = MatrixRing(str(Path(folder) / "hub.npy"))
    >>> ring.form, len(ring.sha256)
    ('compliance', 64)
    """

    file: str
    form: Literal["compliance", "stiffness"] = "compliance"
    axes: Literal["cylindrical", "cartesian"] = "cylindrical"
    first_angle: float = 0.0
    sha256: str = ""
    kind: Literal["matrix"] = "matrix"

    section: ClassVar[None] = None
    radius: ClassVar[None] = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "sha256", digest_of(self.file, "file", self.sha256))
        if self.form not in ("compliance", "stiffness"):
            raise InputError(f"form: must be compliance or stiffness, got {self.form!r}")
        make = CompliantRing if self.form == "compliance" else CompliantRing.from_stiffness
        matrix = read_matrix(self.file, "file")
        object.__setattr__(self, "_ring", make(matrix, self.axes, self.first_angle))

    def of(self, bearing: object, ring: str) -> MatrixRing:
        """The ring of a bearing: the matrix says all."""
        return self

    def flexibility(self, points: PatchPoints) -> Array:
        """Factor Q, as `CompliantRing.flexibility`."""
        ring: CompliantRing = self.__dict__["_ring"]
        return ring.flexibility(points)
