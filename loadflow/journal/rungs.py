"""The models of a film, from the cheapest to the most expensive, and what each of them knows.

To add one, write a module with the functions of `loadflow.journal.models.model.Model` and add a row
here: verbs, scenes and the command line then know it by its name, and refuse what it cannot do.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from loadflow.errors import InputError

_FULL_WIDTH = "a shaped bore, an elastic shell or a shaft that tilts or bends"

FEATURES = {
    "shape": "a shaped bore",
    "relief": "a recess in the bore",
    "contour": "a contour of the bore",
    "crown": "a bore that widens toward its ends",
    "moment": _FULL_WIDTH,
    "tilt": _FULL_WIDTH,
    "bend": _FULL_WIDTH,
    "shell": _FULL_WIDTH,
    "local_shell": "a shell that gives way where it is pressed",
    "supply": "a supply",
    "inlet": "a line of fresh oil",
    "grading": "a graded mesh",
    "heat": "heat",
    "slow_heat": "heat that is stored",
    "film_heat": "an energy equation over the area of the film",
    "contact": "contact of asperities",
    "turbulence": "turbulent flow",
    "pressure_coefficient": "viscosity that rises with pressure",
    "step": "adaptive steps",
    "periodic": "a closed orbit",
}
"""What a model may know of a film, its surroundings and its history: argument and words."""

_LINE = {"moment", "tilt", "bend"}
_SHELLS = {"shell", "local_shell"}
_BORES = _LINE | _SHELLS | {"shape", "relief", "contour", "crown", "supply", "inlet", "grading"}
_FLOW = {"contact", "turbulence", "pressure_coefficient"}
_REDUCED = frozenset(
    _LINE | _SHELLS | _FLOW | {"shape", "contour", "crown", "heat", "film_heat", "supply"}
)


@dataclass(frozen=True)
class Rung:
    """A model of the film.

    Attributes
    ----------
    name : str
        As `Film.rung`.
    place : str
        Module, or module and object, with the functions of the model: ``package.module:OBJECT``.
    at_rest : frozenset of str
        The `FEATURES` that its equilibrium knows.
    in_motion : frozenset of str, optional
        Those that its orbit knows; None: it has no history.
    at_position : frozenset of str, optional
        Those that its field of pressure knows; None: it has none.
    law : str, optional
        Kind of the only law that it knows, with its cavitation pressure at the edge pressure;
        None: it asks the law, whatever it is.
    inlet : {"widest gap"} or None
        With `law`, whether the oil of its film is replaced at the widest gap.
    words : str
        Why it has no history.
    """

    name: str
    place: str
    at_rest: frozenset[str]
    in_motion: frozenset[str] | None = None
    at_position: frozenset[str] | None = None
    law: str | None = None
    inlet: Literal["widest gap"] | None = None
    words: str = "it has no history"


_MODELS = "loadflow.journal.models"
_HEAT = frozenset({"heat"})
_WARMING = _HEAT | {"slow_heat"}
_CHART = 'a chart has no history; "butenschoen" and "holland" superpose its squeeze'

RUNGS: dict[str, Rung] = {
    rung.name: rung
    for rung in (
        Rung(
            "chart",
            f"{_MODELS}.charts:CLOSED",
            _HEAT,
            law="reynolds",
            inlet="widest gap",
            words=_CHART,
        ),
        Rung(
            "table",
            f"{_MODELS}.charts:TABLE",
            _HEAT,
            law="reynolds",
            inlet="widest gap",
            words=_CHART,
        ),
        Rung(
            "butenschoen",
            f"{_MODELS}.superposition:BUTENSCHOEN",
            _HEAT,
            _HEAT,
            law="reynolds",
            inlet="widest gap",
        ),
        Rung(
            "holland",
            f"{_MODELS}.superposition:HOLLAND",
            _HEAT,
            _HEAT,
            law="reynolds",
            inlet="widest gap",
        ),
        Rung("hahn", f"{_MODELS}.superposition:HAHN", _HEAT, _HEAT, law="guembel"),
        Rung(
            "map",
            f"{_MODELS}.mobility_map",
            frozenset({"heat", "inlet", "grading"}),
            _WARMING | {"inlet", "grading"},
        ),
        Rung(
            "reduced",
            f"{_MODELS}.reduced",
            _REDUCED,
            _REDUCED | _WARMING | {"step", "periodic"},
            _REDUCED - _HEAT - {"moment"},
        ),
        Rung(
            "grid",
            f"{_MODELS}.grid",
            frozenset(_BORES | _FLOW | {"heat", "film_heat"}),
            _WARMING | _BORES | _FLOW | {"film_heat", "step", "periodic"},
            frozenset(_BORES | _FLOW | {"film_heat"}),
        ),
    )
}
"""Every model of the film by its name."""


def check_rung(name: str) -> None:
    """Refuse a name that no rung bears.

    Raises
    ------
    loadflow.errors.InputError
        Names the rungs that there are.
    """
    if name not in RUNGS:
        names = " or ".join(f'"{name}"' for name in RUNGS)
        raise InputError(f"rung = {name!r} is not allowed: {names}")
