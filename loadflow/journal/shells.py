"""What a user states about the elasticity of the shell. Options only, no solver.

The pressure of the film above that of its ends widens the gap. A shell gives way where it is
pressed (`LocalShell`, `LinedShell`), or all over (`ThickShell`, `MatrixShell`, and those of
`loadflow.journal.housings`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Lt
from numpy.typing import NDArray

from loadflow.journal.housings import HousedShell, InfluenceShell
from loadflow.journal.shell_base import ElasticShell
from loadflow.numerics.fields import require
from loadflow.numerics.matrix_file import digest_of, read_matrix
from loadflow.tribology.hertz import effective_modulus

_ALIKE = 1e-3  # difference of both halves of a matrix, over its largest number, that is let pass
_LOCAL = 0.1  # deviation of a lining from the local law that is let pass


def _require_solid(modulus: float, poisson_ratio: float) -> None:
    require(modulus > 0, "modulus", modulus, "must be > 0 Pa")
    require(0 <= poisson_ratio < 0.5, "poisson_ratio", poisson_ratio, "0 ≤ poisson_ratio < 0.5")


@dataclass(frozen=True)
class LocalShell(ElasticShell):
    """Shell that gives way where it is pressed alone (Winkler), (3.36, 3.37) of [Jonuschies 2015].

    Attributes
    ----------
    compliance : float
        a_f: growth of the gap over pressure, m/Pa.

    Examples
    --------
    >>> from loadflow.journal import JournalBearing, LocalShell, Lubricant
    >>> bearing = JournalBearing(diameter=0.2, width=0.1, relative_clearance=1e-3)
    >>> soft = LocalShell(compliance=1e-12)  # 1 µm at 1 MPa
    >>> state = bearing.equilibrium((2e4, 0.0), 50.0, Lubricant(0.05), shell=soft, grid=(36, 8))
    >>> round(float(state.shell_deformation) * 1e6, 1)  # µm
    2.4
    """

    compliance: Annotated[float, Ge(0)]
    kind: Literal["local"] = "local"

    local = True

    def __post_init__(self) -> None:
        good = self.compliance >= 0 and math.isfinite(self.compliance)
        require(good, "compliance", self.compliance, "must be ≥ 0 m/Pa and finite")

    @classmethod
    def conformal(
        cls,
        line_load: float,
        diameter: float,
        relative_clearance: float,
        contact_modulus: float | None = None,
    ) -> LocalShell:
        """What shaft and shell, two half-spaces, give where a standing shaft rests on its bore.

        Of the half width b of their line contact [Hertz 1881], whose radius is D/(2ψ), the
        compliance is 9π²b/(64 E*): springs as stiff have its largest pressure under its load. A
        rigid bore would press a shaft that is tilted by a few 1e-5 against one edge.

        Parameters
        ----------
        line_load : float
            Load of the standing shaft over the width of the bearing, N/m.
        diameter : float
            m.
        relative_clearance : float
            ψ.
        contact_modulus : float, optional
            E* of the bodies, not of their asperities, Pa; left out, of steel on steel.

        Examples
        --------
        >>> from loadflow.journal import LocalShell
        >>> steel = LocalShell.conformal(2e6 / 2.25, diameter=3.0, relative_clearance=0.5e-3)
        >>> f"{steel.compliance:.3g}"  # m/Pa
        '2.06e-12'
        """
        require(line_load > 0, "line_load", line_load, "must be > 0 N/m")
        require(diameter > 0, "diameter", diameter, "must be > 0 m")
        require(relative_clearance > 0, "relative_clearance", relative_clearance, "> 0")
        stiff = float(effective_modulus()) if contact_modulus is None else contact_modulus
        require(stiff > 0, "contact_modulus", stiff, "must be > 0 Pa")
        curvature = 2.0 * relative_clearance / diameter
        width = math.sqrt(4.0 * line_load / (math.pi * curvature * stiff))
        return cls(9.0 * math.pi**2 / 64.0 * width / stiff)


@dataclass(frozen=True)
class LinedShell(ElasticShell):
    """Thin lining bonded to a rigid housing: each part is squeezed and cannot give way sideways.

    The compliance is ``t (1 + ν)(1 − 2ν)/(E (1 − ν))``, as long as the lining is thin against the
    length over which the pressure changes. A lining that hardly changes its volume is softer than
    that: it flows aside. It is refused where that matters by more than a tenth.

    Attributes
    ----------
    thickness : float
        Of the lining, m.
    modulus : float
        Young's modulus E of the lining, Pa.
    poisson_ratio : float
        ν of the lining.

    Examples
    --------
    >>> from loadflow.journal import LinedShell
    >>> lining = LinedShell(thickness=0.5e-3, modulus=50e9)
    >>> f"{lining.compliance:.2e}"  # m/Pa
    '7.43e-15'
    """

    thickness: Annotated[float, Gt(0)]
    modulus: Annotated[float, Gt(0)]
    poisson_ratio: Annotated[float, Ge(0), Lt(0.5)] = 0.3
    kind: Literal["lined"] = "lined"

    local = True

    def __post_init__(self) -> None:
        require(self.thickness > 0, "thickness", self.thickness, "must be > 0 m")
        _require_solid(self.modulus, self.poisson_ratio)

    @property
    def compliance(self) -> float:
        """Growth of the gap over an even pressure, m/Pa."""
        nu = self.poisson_ratio
        return self.thickness * (1 + nu) * (1 - 2 * nu) / (self.modulus * (1 - nu))

    def compliance_at(self, wave_length: float) -> float:
        """Growth of the gap over a pressure cos(2π x/`wave_length`), both amplitudes, m/Pa.

        Exact for a bonded layer in plane strain [Johnson 1985, Contact Mechanics, ch. 5.8].
        """
        k, nu = 2 * math.pi / wave_length, self.poisson_ratio
        kappa, depth = 3 - 4 * nu, 2 * k * self.thickness
        free = 2 * (1 - nu**2) / (self.modulus * k)
        if depth > 100:  # a half-space
            return free
        held = 2 * kappa * math.cosh(depth) + depth**2 + kappa**2 + 1
        return free * 2 * (kappa * math.sinh(depth) - depth) / held

    def check_local(self, length: float) -> None:
        """Refuse a lining that is not local under a pressure that changes over `length`, m.

        Raises
        ------
        loadflow.errors.InputError
            With the compliance that it would have.
        """
        exact = self.compliance_at(length)
        require(
            abs(exact - self.compliance) <= _LOCAL * self.compliance,
            "thickness, poisson_ratio",
            (self.thickness, self.poisson_ratio),
            f"thin and compressible enough to give way locally; under a pressure wave of "
            f"{length:.4g} m its compliance is {exact:.4g} m/Pa, not {self.compliance:.4g} m/Pa",
        )


@dataclass(frozen=True)
class ThickShell(ElasticShell):
    """Thick-walled cylinder as wide as the bearing, held all over its outside.

    Its influence coefficients come from three-dimensional elasticity, harmonic by harmonic around.

    Attributes
    ----------
    outer_diameter : float
        m, above the bore.
    modulus : float
        Young's modulus E, Pa.
    poisson_ratio : float
        ν.

    Examples
    --------
    >>> from loadflow.journal import ThickShell
    >>> ThickShell(outer_diameter=0.3, modulus=210e9).poisson_ratio
    0.3
    """

    outer_diameter: Annotated[float, Gt(0)]
    modulus: Annotated[float, Gt(0)]
    poisson_ratio: Annotated[float, Ge(0), Lt(0.5)] = 0.3
    kind: Literal["thick"] = "thick"

    def __post_init__(self) -> None:
        require(self.outer_diameter > 0, "outer_diameter", self.outer_diameter, "must be > 0 m")
        _require_solid(self.modulus, self.poisson_ratio)


@dataclass(frozen=True, eq=False)
class MatrixShell(ElasticShell):
    """Shell whose influence coefficients are given, (3.52–3.56) of [Jonuschies 2015].

    Attributes
    ----------
    matrix : array_like (nx nz, nx nz) or (nx, nz, nx, nz), str or path
        Growth of the gap at each cell of the film over the pressure on another, m/Pa: the
        deformation under 1 MPa on one cell is a column times 1e6 Pa. The cells are those of
        `FilmField.pressure`, full width, the axial place running fastest: even across by every
        law unless `Film.grading` is "graded". Or the name of a file that holds it, of
        numpy (``.npy``) or rows of text.
    sha256 : str
        Of such a file; filled in. Where it is stated, the file must still be that one.

    Examples
    --------
    >>> import numpy as np
    >>> from loadflow.journal import MatrixShell
    >>> shell = MatrixShell(np.eye(36 * 8) * 1e-12)  # one row and column for each cell of the grid
    >>> shell.numbers.shape
    (288, 288)
    """

    matrix: Any
    sha256: str = ""
    kind: Literal["matrix"] = "matrix"

    any_grid = False

    def __post_init__(self) -> None:
        given = self.matrix
        if isinstance(given, str | Path):
            object.__setattr__(self, "sha256", digest_of(given, stated=self.sha256))
            matrix = read_matrix(given)
        else:
            require(not self.sha256, "sha256", self.sha256, "that of a file, but matrix is none")
            matrix = np.array(given, float)
        side = math.isqrt(matrix.size)
        require(side**2 == matrix.size, "matrix", matrix.shape, "as many rows as columns")
        require(bool(np.isfinite(matrix).all()), "matrix", "NaN or infinite", "finite, m/Pa")
        matrix = matrix.reshape(side, side)
        matrix.flags.writeable = False
        object.__setattr__(self, "_numbers", matrix)

    @property
    def numbers(self) -> NDArray[np.float64]:
        """Influence coefficients (n, n), m/Pa."""
        return np.asarray(self.__dict__["_numbers"])

    def symmetric_on(self, across: int) -> bool:
        """Whether both halves of the width give way alike on so many cells of a film across."""
        return _alike(self, across)


@lru_cache(maxsize=8)
def _alike(shell: MatrixShell, across: int) -> bool:
    """Whether a matrix is the same seen from the other end; one of other cells is refused later."""
    numbers = shell.numbers
    if len(numbers) % across:
        return True
    around = len(numbers) // across
    full = numbers.reshape(around, across, around, across)
    apart = np.abs(full - full[:, ::-1, :, ::-1]).max()
    return bool(apart <= _ALIKE * np.abs(full).max())


Shell = LocalShell | LinedShell | ThickShell | MatrixShell | HousedShell | InfluenceShell
