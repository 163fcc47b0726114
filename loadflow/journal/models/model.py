"""Models of the film behind one signature: the table of rungs, and what each must offer.

The finite volumes ("grid") are `JournalBearing`'s own; every other rung is a module, or an object,
with the two functions of `Model`, imported when it is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal, Protocol, cast, get_args

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import SolverError
from loadflow.journal.options import require

if TYPE_CHECKING:
    import xarray as xr

    from loadflow.journal.bearing import JournalBearing
    from loadflow.journal.film.discretise import FilmOptions

Array = NDArray[np.float64]

Rung = Literal["chart", "table", "butenschoen", "holland", "hahn", "map", "reduced", "grid"]
"""Names of the rungs, from the cheapest to the dearest."""

_PLACES = {
    "chart": "loadflow.journal.models.charts:CLOSED",
    "table": "loadflow.journal.models.charts:TABLE",
    "butenschoen": "loadflow.journal.models.superposition:BUTENSCHOEN",
    "holland": "loadflow.journal.models.superposition:HOLLAND",
    "hahn": "loadflow.journal.models.superposition:HAHN",
    "map": "loadflow.journal.models.mobility_map",
    "reduced": "loadflow.journal.models.reduced",
}


@dataclass(frozen=True)
class Control:
    """When a solver stops: tolerance of the scaled residual, Newton steps, and what then.

    `strict` raises for the first load without an answer; else its results are NaN.
    """

    tolerance: float
    max_iterations: int
    strict: bool = True


class Model(Protocol):
    """What a rung offers."""

    def equilibrium(
        self,
        bearing: JournalBearing,
        options: FilmOptions,
        force: Array,
        speed: Array,
        control: Control,
    ) -> dict[str, Any]:
        """Return the fields of `Equilibrium` for `force` (n, 2) and `speed` (n,), n leading."""

    def orbit(
        self,
        bearing: JournalBearing,
        options: FilmOptions,
        time: Array,
        force: Array,
        speed: Array,
        start: Array | None,
        control: Control,
    ) -> xr.Dataset:
        """Return the Dataset of `JournalBearing.orbit`; `start` is in clearances."""


def check_rung(rung: str) -> None:
    """Refuse a name that no rung bears.

    Raises
    ------
    loadflow.errors.InputError
        Names the rungs that there are.
    """
    names = get_args(Rung)
    require(rung in names, "rung", rung, " or ".join(f'"{name}"' for name in names))


def model(rung: str) -> Model:
    """The model of a rung other than "grid": a module, or an object of one."""
    module, _, name = _PLACES[rung].partition(":")
    found = import_module(module)
    return cast("Model", getattr(found, name) if name else found)


def solve_on_grid(
    bearing: JournalBearing,
    options: FilmOptions,
    index: int,
    answer: dict[str, Any],
    control: Control,
) -> None:
    """Replace the row `index` of `answer` by that of the rung "grid".

    Raises
    ------
    SolverError
        If ``control.strict`` and the grid has no answer either.
    """
    force, speed = answer["force"][index], float(answer["speed"][index])
    try:
        state = bearing.equilibrium(force, speed, **vars(options), strict=control.strict)
    except SolverError as error:
        raise SolverError(str(error).replace("load 0:", f"load {index}:", 1)) from error
    for name, values in answer.items():
        values[index] = getattr(state, name)
