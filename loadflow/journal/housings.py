"""What a user states about a housing that gives way with its shell: feet, flange, or a file.

Options only; `loadflow.journal.film.shell.housing_elements` solves the housing and
`loadflow.journal.film.shell.bore_modes` reads the file.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

from annotated_types import Ge, Gt, Le, Lt

from loadflow.journal.shell_base import ElasticShell
from loadflow.numerics.fields import require
from loadflow.numerics.matrix_file import digest_of

_STEEL = 2.1e11  # Pa


@dataclass(frozen=True)
class Feet:
    """Base on which a housing stands: straight walls from its round part down to the base.

    Attributes
    ----------
    height : float
        Of the axis above the base, m.
    width : float
        Of the base across the axis, m.
    angle : float
        Direction from the axis to the base, rad.
    length : float, optional
        Of the base along the axis, m, in its middle; that of the housing by default.

    Examples
    --------
    >>> from loadflow.journal import Feet
    >>> Feet(height=1.9, width=3.0).angle
    0.0
    """

    height: Annotated[float, Gt(0)]
    width: Annotated[float, Gt(0)]
    angle: float = 0.0
    length: Annotated[float, Gt(0)] | None = None
    kind: Literal["feet"] = "feet"

    def __post_init__(self) -> None:
        require(0 < self.height < math.inf, "height", self.height, "must be > 0 m and finite")
        require(0 < self.width < math.inf, "width", self.width, "must be > 0 m and finite")
        require(math.isfinite(self.angle), "angle", self.angle, "rad, finite")
        if self.length is not None:
            require(0 < self.length < math.inf, "length", self.length, "must be > 0 m and finite")

    symmetric = True


@dataclass(frozen=True)
class Flange:
    """Flange around a housing, held where it is bolted.

    Attributes
    ----------
    bolt_circle : float
        Diameter at which it is held all round, m.
    thickness : float
        Along the axis, m.
    axial : float
        Of its middle, from the middle of the bearing, m.

    Examples
    --------
    >>> from loadflow.journal import Flange
    >>> Flange(bolt_circle=4.2, thickness=0.12, axial=1.0).symmetric
    False
    """

    bolt_circle: Annotated[float, Gt(0)]
    thickness: Annotated[float, Gt(0)]
    axial: float = 0.0
    kind: Literal["flange"] = "flange"

    def __post_init__(self) -> None:
        require(
            0 < self.bolt_circle < math.inf,
            "bolt_circle",
            self.bolt_circle,
            "must be > 0 m and finite",
        )
        require(
            0 < self.thickness < math.inf, "thickness", self.thickness, "must be > 0 m and finite"
        )
        require(math.isfinite(self.axial), "axial", self.axial, "m, finite")

    @property
    def symmetric(self) -> bool:
        """Whether both halves of the width give way alike."""
        return self.axial == 0.0


@dataclass(frozen=True)
class HousedShell(ElasticShell):
    """Shell in a housing on feet or a flange, by finite elements in three dimensions.

    The bore gives way by the modes of its influence matrix, which follow once from the elements
    and hold on every grid of the film.

    Attributes
    ----------
    outer_diameter : float
        Of the round part of the housing, m, above the bore.
    support : Feet or Flange
        How it is held.
    modulus, poisson_ratio : float
        Of the housing, Pa and 1; steel by default.
    shell_thickness : float
        Of a shell of another material in the housing, m; 0: none.
    shell_modulus : float, optional
        Of the shell, Pa; that of the housing by default.
    length : float, optional
        Of the housing along the axis, m; the width of the bearing by default.
    elements : tuple of int
        Quadratic elements around, through the wall and along the axis.
    accuracy : float
        Share of the compliance of the bore that left out modes may have together.

    Examples
    --------
    >>> from loadflow.journal import Feet, HousedShell
    >>> HousedShell(outer_diameter=0.3, support=Feet(height=0.2, width=0.3)).symmetric
    True
    """

    outer_diameter: Annotated[float, Gt(0)]
    support: Feet | Flange
    modulus: Annotated[float, Gt(0)] = _STEEL
    poisson_ratio: Annotated[float, Ge(0), Lt(0.5)] = 0.3
    shell_thickness: Annotated[float, Ge(0)] = 0.0
    shell_modulus: Annotated[float, Gt(0)] | None = None
    length: Annotated[float, Gt(0)] | None = None
    elements: tuple[
        Annotated[int, Ge(16), Le(120)], Annotated[int, Ge(1), Le(8)], Annotated[int, Ge(2), Le(24)]
    ] = (36, 2, 4)
    accuracy: Annotated[float, Gt(0), Le(0.1)] = 0.002
    kind: Literal["housed"] = "housed"

    def __post_init__(self) -> None:
        require(self.modulus > 0, "modulus", self.modulus, "must be > 0 Pa")
        good = 0 <= self.poisson_ratio < 0.5
        require(good, "poisson_ratio", self.poisson_ratio, "0 ≤ poisson_ratio < 0.5")
        require(0 < self.accuracy <= 0.1, "accuracy", self.accuracy, "0 < accuracy ≤ 0.1")
        require(self.shell_thickness >= 0, "shell_thickness", self.shell_thickness, "must be ≥ 0 m")
        if self.shell_modulus is not None:
            require(self.shell_modulus > 0, "shell_modulus", self.shell_modulus, "must be > 0 Pa")
            named = "> 0 m where shell_modulus is given"
            require(self.shell_thickness > 0, "shell_thickness", self.shell_thickness, named)
        if self.length is not None:
            require(0 < self.length < math.inf, "length", self.length, "must be > 0 m and finite")
        object.__setattr__(self, "elements", tuple(int(n) for n in self.elements))
        around, through, along = self.elements
        fine = 16 <= around <= 120 and 1 <= through <= 8 and 2 <= along <= 24
        require(fine, "elements", self.elements, "16 … 120 around, 1 … 8 through, 2 … 24 along")
        outer = self.outer_diameter
        if isinstance(self.support, Feet):
            height = self.support.height
            require(height >= 0.5 * outer, "height", height, f"must be ≥ {0.5 * outer:.6g} m")
        else:
            circle = self.support.bolt_circle
            require(
                circle > outer, "bolt_circle", circle, f"must be > {outer:.6g} m, the housing's"
            )

    @property
    def symmetric(self) -> bool:
        """Whether both halves of the width give way alike."""
        return self.support.symmetric

    def check_bore(self, diameter: float, width: float) -> None:
        """Refuse a housing that does not enclose a bearing of this `diameter` and `width`, m.

        Raises
        ------
        loadflow.errors.InputError
            Housing smaller than the shell, shorter than the bearing, a foot or flange beyond it.
        """
        inner = diameter + 2 * self.shell_thickness
        needed = f"must be > {inner:.6g} m"
        require(self.outer_diameter > inner, "outer_diameter", self.outer_diameter, needed)
        length = self.length_around(width)
        require(length >= width, "length", length, f"must be ≥ {width:.6g} m, that of the bearing")
        if isinstance(self.support, Feet):
            foot = self.support.length
            if foot is not None:
                require(foot <= length, "length of the feet", foot, f"must be ≤ {length:.6g} m")
        else:
            half, end = 0.5 * self.support.thickness, 0.5 * length * (1 + 1e-9)
            reach = abs(self.support.axial) + half
            require(reach <= end, "axial", self.support.axial, f"m, within ± {end - half:.6g}")

    def length_around(self, width: float) -> float:
        """Length of the housing around a bearing of `width`, m."""
        return width if self.length is None else self.length


@dataclass(frozen=True)
class InfluenceShell(ElasticShell):
    """Shell whose influence matrix another finite-element program has written to a file.

    The file (NetCDF, or ``.npz`` of numpy) holds ``angle`` (n,), rad, rising through one turn,
    ``axial`` (m,), m from the middle of the bearing and over its whole width, and ``influence``
    (n m, n m) or (n, m, n, m), m/N: outward displacement of every node of the bore under a unit
    outward force on each, the axial place running fastest. It is taken on every grid of the film.

    Attributes
    ----------
    file : str or path
        With the influence matrix.
    accuracy : float
        Share of the compliance of the bore that left out modes may have together.
    sha256 : str
        Of the file; filled in. Where it is stated, the file must still be that one.

    Raises
    ------
    loadflow.errors.InputError
        The file is missing, or has changed. What is in it is read with the first film.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> import numpy as np
    >>> from loadflow.journal import InfluenceShell
    >>> angle, axial = np.linspace(0.0, 6.0, 24), np.linspace(-0.1, 0.1, 5)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     file = Path(folder) / "housing.npz"
    ...     np.savez(file, angle=angle, axial=axial, influence=1e-12 * np.eye(120))
    ...     shell = InfluenceShell(str(file))
    >>> shell.accuracy, len(shell.sha256)
    (0.002, 64)
    """

    file: str | Path
    accuracy: Annotated[float, Gt(0), Le(0.1)] = 0.002
    sha256: str = ""
    kind: Literal["influence"] = "influence"

    @property
    def symmetric(self) -> bool:
        """Whether both halves of the width give way alike."""
        return False

    def __post_init__(self) -> None:
        require(0 < self.accuracy <= 0.1, "accuracy", self.accuracy, "0 < accuracy ≤ 0.1")
        object.__setattr__(self, "sha256", digest_of(self.file, "file", self.sha256))
