"""What bearings stand on, housing or bedplate, as a matrix in a file, condensed elsewhere."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.numerics.matrix_file import digest_of, read_matrix

Floats = NDArray[np.float64]

AXES = ("Fx", "Fy", "Fz", "Mx", "My", "Mz")
"""Rows and columns of each support, in the axes of the shaft."""

_ALIKE = 1e-6  # of the geometric mean of two diagonal entries: what is printed with seven digits
_HELD = 1e-9  # least eigenvalue of a stiffness whose diagonal is 1: below, rounding is all there is


@dataclass(frozen=True)
class FrameMatrix:
    """Stiffness or compliance of a structure at the centres of the bearings that it carries.

    Attributes
    ----------
    file : str
        Of numpy (``.npy``), values between commas (``.csv``) or rows of text: 6 rows and columns
        for each support, the one next to the hub first, in the order of `AXES`; x along the shaft,
        downwind, z up, y to the left. Motion and load are those of the bearing's bore at the
        middle of the bearing.
    form : {"stiffness", "compliance"}
        N/m, N and N m of a structure that is held where the tower begins, or m/N, 1/N and
        1/(N m).
    sha256 : str
        Of the file; filled in. Where it is stated, the file must still be that one.

    Raises
    ------
    loadflow.errors.InputError
        The file is missing or has changed, or its matrix is not square with 6 rows for each
        support, finite, symmetric and positive semidefinite; a stiffness of a structure that is
        not held.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from loadflow.shaft import FrameMatrix
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     np.save(Path(folder) / "foot.npy", np.diag([9e9, 4e9, 8e9, 1e10, 2e10, 2e10]))
    ...     foot = FrameMatrix(str(Path(folder) / "foot.npy"))
    >>> foot.supports, round(1 / float(foot.compliance[2, 2]))
    (1, 8000000000)
    """

    file: str
    form: Literal["stiffness", "compliance"] = "stiffness"
    sha256: str = ""

    def __post_init__(self) -> None:
        check_one_of("form", self.form, ("stiffness", "compliance"))
        object.__setattr__(self, "sha256", digest_of(self.file, "file", self.sha256))
        matrix, size = self._checked(read_matrix(self.file, "file"))
        if self.form == "stiffness":
            even = np.linalg.inv(matrix / np.outer(size, size))
            matrix = (even + even.T) / 2 / np.outer(size, size)
        matrix.flags.writeable = False
        object.__setattr__(self, "_compliance", matrix)

    @property
    def compliance(self) -> Floats:
        """Motion of the bores by unit loads on them, (6 n, 6 n), m/N, 1/N and 1/(N m)."""
        return np.asarray(self.__dict__["_compliance"])

    @property
    def supports(self) -> int:
        """Number of supports that the matrix is of."""
        return len(self.compliance) // 6

    def _checked(self, matrix: Floats) -> tuple[Floats, Floats]:
        """The matrix, and the roots of its diagonal (1 of a zero): loads of all units evened."""
        rows, columns = matrix.shape if matrix.ndim == 2 else (matrix.size, 0)
        if rows != columns or rows == 0 or rows % 6:
            raise self._wrong(f"6 rows and columns for each support, got {matrix.shape}")
        if not np.isfinite(matrix).all():
            row, column = np.argwhere(~np.isfinite(matrix))[0]
            raise self._wrong(f"finite, got {_told(matrix, row, column)}")
        diagonal = np.diag(matrix)
        if (diagonal < 0).any():
            row = int(np.argmin(diagonal >= 0))
            raise self._wrong(f"not negative on the diagonal, got {_told(matrix, row, row)}")
        alone = (diagonal == 0)[:, None] & (matrix != 0)
        if alone.any():
            row, column = (int(k) for k in np.argwhere(alone)[0])
            raise self._wrong(
                f"zero in a whole row whose diagonal is, got {_told(matrix, row, column)}"
            )
        size = np.sqrt(np.where(diagonal > 0, diagonal, 1.0))
        even = matrix / np.outer(size, size)
        off = np.abs(even - even.T)
        row, column = sorted(divmod(int(off.argmax()), rows))
        if off[row, column] > _ALIKE:
            raise self._wrong(
                f"symmetric, got {_told(matrix, row, column)} and {_told(matrix, column, row)}"
            )
        matrix, even = (matrix + matrix.T) / 2, (even + even.T) / 2
        values, vectors = np.linalg.eigh(even)
        row = int(np.abs(vectors[:, 0]).argmax())
        if values[0] < -_ALIKE:
            raise self._wrong(
                f"positive semidefinite, but a motion of which {_name(row)} has the largest part "
                f"gives energy (lowest eigenvalue {values[0]:.2g} beside a diagonal of 1)"
            )
        if self.form == "stiffness" and values[0] < _HELD:
            raise self._wrong(
                f"the stiffness of a structure that is held, but {_name(row)} moves it without "
                "resistance: hold it at the tower before it is condensed, or give its compliance"
            )
        return matrix, size

    def _wrong(self, needed: str) -> InputError:
        return InputError(f"file = {self.file!r}: the {self.form} must be {needed}")


def _told(matrix: Floats, row: int, column: int) -> str:
    return f"{matrix[row, column]:.7g} in row {_name(row)}, column {_name(column)}"


def _name(row: int) -> str:
    """Number and load of a row, counted from 1 as in an editor."""
    return f"{row + 1} ({AXES[row % 6]} of support {row // 6 + 1})"
