"""What a user states about the film of a bearing: one description for every verb and every model.

`Film` says what the film is, `Control` of `loadflow.numerics` how hard to solve. The verbs also
take their fields one by one: `Keywords` types them, `film_and_control` makes the two objects of
them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any, Literal, TypedDict

import numpy as np

from loadflow.errors import InputError
from loadflow.journal.cavitation import CavitationLaw, Reynolds
from loadflow.journal.contact import Contact
from loadflow.journal.heat import FilmHeat, Heat
from loadflow.journal.lubricant import Lubricant
from loadflow.journal.pad_heat import PadHeat
from loadflow.journal.rungs import RUNGS, check_rung
from loadflow.journal.shells import Shell
from loadflow.journal.supply import Supply
from loadflow.journal.turbulence import Turbulence
from loadflow.numerics.convergence import Control as Control
from loadflow.numerics.fields import meant, require

Grading = Literal["auto", "uniform", "graded"]
Inlet = Literal["auto", "widest gap"] | None

SMOOTH_GRID = (60, 20)  # of [Jonuschies 2015], enough for a smooth law
SHARP_GRID = (120, 40)  # graded, for laws with a sharp rupture


class FilmKeywords(TypedDict, total=False):
    """The fields of `Film`, as keywords of a verb."""

    lubricant: Lubricant | None
    cavitation: CavitationLaw | None
    edge_pressure: float
    supply: Supply | None
    inlet: Inlet
    grid: tuple[int, int] | None
    grading: Grading
    shell: Shell | None
    heat: Heat | FilmHeat | PadHeat | None
    contact: Contact | None
    rung: str
    turbulence: Turbulence | None


class ControlKeywords(TypedDict, total=False):
    """The fields of `Control`, as keywords of a verb."""

    tolerance: float | None
    max_iterations: int | None
    strict: bool


class Keywords(FilmKeywords, ControlKeywords):
    """What a verb takes in place of a `Film` and a `Control`."""


@dataclass(frozen=True)
class Film:
    """Film of a bearing: liquid, law of rupture, what surrounds and feeds it, and its model.

    Attributes
    ----------
    lubricant : Lubricant, optional
        The liquid; left out with `heat`, whose oil it is then.
    cavitation : GasMixture, Sommerfeld, Guembel, Reynolds or MassConserving
        Law of the ruptured film; default ``Reynolds()``.
    edge_pressure : float
        Pressure at both bearing ends and on an inlet line, Pa, absolute.
    supply : Supply, optional
        Grooves of the shell.
    inlet : {"auto", "widest gap"} or None
        Inlet line at the widest gap (ISO 7902) or none. "auto": the line for Reynolds and Gümbel
        without a supply. In an orbit it turns with the widest gap, as no groove does.
    grid : tuple of int, optional
        Cells around and across the full width (even; half is solved where the film is symmetric).
        Default (60, 20) for the gas mixture, (120, 40) else.
    grading : {"auto", "uniform", "graded"}
        Uniform cells, or cells that crowd at the narrowest gap and the bearing ends. "auto":
        uniform for the gas mixture and with a `MatrixShell`, graded else. With a supply, in any
        bore but a cylinder, with tilt or a shell cells crowd at the ends alone, and where grooves
        or reliefs end within the width they are even between these. Where a few uniform cells span
        the narrowest gap, under a heavy load or at a given position, the film is then solved on a
        graded mesh, but with a supply or such a shell.
    shell : LocalShell, LinedShell, ThickShell, MatrixShell, HousedShell or InfluenceShell, optional
        Elastic shell, whose gap follows the pressure above that of the ends; rigid by default.
    heat : Heat, FilmHeat or PadHeat, optional
        Oil and cooling: the film is as warm as its own friction makes it, of one temperature or of
        one that changes over its area; `PadHeat` is that of thrust bearings. Isothermal by default.
    contact : Contact, optional
        Asperities, which share load, flow and friction with the oil; smooth surfaces by default.
    rung : {"grid", "reduced", "map", "chart", "table", "butenschoen", "holland", "hahn"}
        Model: finite volumes; few unknowns across the width; the mobility map; closed forms and
        tables of ISO 7902, which leave total_fill, stiffness and damping None; the historical
        superpositions.
    turbulence : Turbulence, optional
        Turbulent flow where the Reynolds number is beyond its critical value; laminar by default,
        with a `loadflow.errors.ValidityWarning` where that does not hold.

    Raises
    ------
    loadflow.errors.InputError
        A value out of range, a pressure below that of cavitation, both or none of `lubricant` and
        `heat`.

    Examples
    --------
    >>> from loadflow.journal import Film, GasMixture, JournalBearing, Lubricant
    >>> film = Film(Lubricant(0.05), GasMixture(0.05e6), edge_pressure=0.5e6, grid=(60, 20))
    >>> bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    >>> round(float(bearing.equilibrium((2e6, 0.4e6), 1.2, film).eccentricity_ratio), 2)
    0.61
    """

    lubricant: Lubricant | None = None
    cavitation: CavitationLaw | None = None
    edge_pressure: float = 0.0
    supply: Supply | None = None
    inlet: Inlet = "auto"
    grid: tuple[int, int] | None = None
    grading: Grading = "auto"
    shell: Shell | None = None
    heat: Heat | FilmHeat | PadHeat | None = None
    contact: Contact | None = None
    rung: str = "grid"
    turbulence: Turbulence | None = None

    def __post_init__(self) -> None:
        if self.lubricant is None and self.heat is None:
            raise InputError("lubricant: not given; a film needs a Lubricant, or heat and its oil")
        if self.lubricant is not None and self.heat is not None:
            raise InputError("lubricant: not given with heat, as it follows from heat.oil")
        for name, kinds, allowed in _KINDS:
            value = getattr(self, name)
            require(value is None or isinstance(value, kinds), name, value, f"{allowed}, or None")
        check_rung(self.rung)
        require(self.inlet in ("auto", "widest gap", None), "inlet", self.inlet, _INLETS)
        require(self.grading in _GRADINGS, "grading", self.grading, " or ".join(_GRADINGS))
        if self.grid is not None:
            object.__setattr__(self, "grid", check_grid(self.grid))
        name, pressure = "edge_pressure", self.edge_pressure
        require(math.isfinite(pressure), name, pressure, "Pa, absolute, finite")
        lowest = min([pressure, *self._groove_pressures()])
        floor = self.law.floor
        allowed = f"Pa, absolute, not below the cavitation pressure {floor:g} Pa"
        require(lowest >= floor, name, lowest, allowed)

    @property
    def law(self) -> CavitationLaw:
        """The law of the ruptured film."""
        return Reynolds() if self.cavitation is None else self.cavitation

    @property
    def liquid(self) -> Lubricant:
        """The liquid of an isothermal film; with `heat`, as it enters."""
        if self.lubricant is None:
            assert self.heat is not None
            return self.heat.lubricant(self.heat.inlet_temperature)
        return self.lubricant

    @property
    def crowds(self) -> bool:
        """Whether cells crowd at the narrowest gap and at the ends, where their places are free."""
        if self.grading == "auto":  # a given matrix is that of cells even across, on all rungs
            return not self.law.smooth and (self.shell is None or self.shell.any_grid)
        return self.grading == "graded"

    @property
    def may_grade(self) -> bool:
        """Whether a load that the uniform mesh cannot resolve may be tried on a graded one."""
        return self.grading == "auto" and self.law.smooth and self.supply is None

    @property
    def cells(self) -> tuple[int, int]:
        """Cells around and across, by default those that suit the law."""
        return self.grid or (SMOOTH_GRID if self.law.smooth else SHARP_GRID)

    @property
    def inlet_line(self) -> bool:
        """Whether the oil is replaced on a line at the widest gap."""
        if self.inlet == "auto":
            return self.law.inlet_line and self.supply is None
        return self.inlet is not None

    def graded(self) -> Film:
        """The same on a graded mesh, fine enough for a gap of a thousandth of the clearance."""
        around, across = self.grid or SHARP_GRID
        grid = (max(around, SHARP_GRID[0]), max(across, SHARP_GRID[1]))
        return replace(self, grading="graded", grid=grid)

    def for_history(self) -> Film:
        """The same on a mesh that can keep the fill of its cells, if the law has one."""
        if not self.law.keeps_fill:
            return self
        require(self.grading != "graded", "grading", self.grading, "uniform where fill has a past")
        require(self.inlet != "widest gap", "inlet", self.inlet, "None where fill has a past")
        return replace(self, grading="uniform", inlet=None)

    def closing(self) -> Film:
        """The same on a rung that closes orbits: its own, or else the grid."""
        closes = "periodic" in (RUNGS[self.rung].in_motion or ())
        return self if closes else replace(self, rung="grid")

    def isothermal(self) -> Film:
        """The same without heat, its liquid as it enters."""
        return self if self.heat is None else replace(self, lubricant=self.liquid, heat=None)

    def check_oil(self, *other: float) -> None:
        """Refuse pressures at which the film would run dry, or rupture at its end.

        Parameters
        ----------
        *other : float
            Pressures of grooves of the bore, Pa, absolute.

        Raises
        ------
        loadflow.errors.InputError
            Names the pressure and the cavitation pressure.
        """
        floor, name = self.law.floor, "edge_pressure"
        pressures = [self.edge_pressure, *other, *self._groove_pressures()]
        allowed = f"Pa, absolute, not below the cavitation pressure {floor:g} Pa"
        require(min(pressures) >= floor, name, min(pressures), allowed)
        grooves = self.supply.grooves if self.supply else ()
        fed = bool(self.supply and self.supply.pump) or any(g.restrictor for g in grooves)
        if self.law.keeps_fill and not fed:
            allowed = f"above {floor:g} Pa at a bearing end or in a groove, or no oil enters"
            require(max(pressures) > floor, name, self.edge_pressure, allowed)

    def _groove_pressures(self) -> list[float]:
        """Given pressures of grooves, Pa, absolute."""
        if self.supply is None or self.supply.pump is not None:
            return []
        return [g.pressure for g in self.supply.grooves if g.restrictor is None]


_INLETS = '"auto", "widest gap" or None'
_GRADINGS = ("auto", "uniform", "graded")
_KINDS = (
    ("lubricant", Lubricant, "a Lubricant, such as Lubricant(viscosity=0.05)"),
    ("cavitation", CavitationLaw, "a law of cavitation, such as GasMixture(50e3) or Reynolds()"),
    ("supply", Supply, "a Supply"),
    ("shell", Shell, "a shell, such as ThickShell(outer_diameter=1.8, modulus=210e9)"),
    ("heat", Heat | FilmHeat | PadHeat, "a Heat, FilmHeat or PadHeat"),
    ("contact", Contact, "a Contact"),
    ("turbulence", Turbulence, "a Turbulence"),
)


def check_grid(grid: tuple[int, int]) -> tuple[int, int]:
    """Cells around and across.

    Raises
    ------
    loadflow.errors.InputError
        No two numbers, fewer than eight around, or an odd number across.
    """
    two = isinstance(grid, Sequence | np.ndarray) and len(grid) == 2
    require(two, "grid", grid, "cells around and across, such as (60, 20)")
    nx, nz = (int(cells) for cells in grid)
    require(nx >= 8, "grid[0]", nx, "at least 8 cells around")
    require(nz >= 2 and nz % 2 == 0, "grid[1]", nz, "an even number of cells across the width")
    return nx, nz


_FILM = tuple(part.name for part in fields(Film))
_CONTROL = tuple(part.name for part in fields(Control))


def film_and_control(
    film: Film | Lubricant | None,
    more: tuple[Any, ...],
    control: Control | None,
    keywords: Keywords,
) -> tuple[Film, Control]:
    """Film and control of a verb: as given, or built from the keywords of their fields.

    Parameters
    ----------
    film : Film or Lubricant, optional
        The description, or the liquid of one that the keywords describe.
    more : tuple
        Fields of `Film` after the lubricant, in their order.
    control : Control, optional
        How hard to solve.
    keywords : Keywords
        Fields of both.

    Raises
    ------
    loadflow.errors.InputError
        A description together with one of its own keywords; the lubricant twice.
    TypeError
        A keyword that is none, or a field given twice.
    """
    given: dict[str, Any] = dict(keywords)
    limits = {name: given.pop(name) for name in _CONTROL if name in given}
    if control is not None and limits:
        raise InputError(f"{', '.join(limits)}: not given with control, which says so")
    for name, value in zip(_FILM[1:], more):
        if name in given:
            raise TypeError(f"{name} is given twice")
        given[name] = value
    unknown = [name for name in given if name not in _FILM]
    if unknown or len(more) >= len(_FILM):
        near = "".join(meant(name, (*_FILM, *_CONTROL)) for name in unknown[:1])
        raise TypeError(f"unexpected arguments: {', '.join(unknown) or more}{near}")
    if isinstance(film, Film):
        if given:
            raise InputError(f"{', '.join(given)}: not given with a Film, which says so")
    else:
        if film is not None:
            if "lubricant" in given:
                raise InputError("lubricant: given twice")
            given["lubricant"] = film
        film = Film(**given)
    return film, control or Control(**limits)
