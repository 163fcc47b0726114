"""Models of the film behind one signature: the table of rungs, and what each must offer.

The finite volumes ("grid") are `JournalGeometry`'s own; every other rung is a module, or an object,
with the two functions of `Model`, imported when it is used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, Literal, Protocol, cast, get_args

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.geometry import JournalGeometry
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

if TYPE_CHECKING:
    import xarray as xr

    from loadflow.journal.film_model import Film

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


class Model(Protocol):
    """What a rung offers."""

    def equilibrium(
        self,
        bearing: JournalGeometry,
        options: Film,
        force: Array,
        speed: Array,
        control: Limits,
    ) -> dict[str, Any]:
        """Return the fields of `Equilibrium` for `force` (n, 2) and `speed` (n,), n leading."""

    def orbit(
        self,
        bearing: JournalGeometry,
        options: Film,
        time: Array,
        force: Array,
        speed: Array,
        start: Array | None,
        control: Limits,
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
