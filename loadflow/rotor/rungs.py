"""The rungs of the rotor model."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache

from loadflow.errors import InputError
from loadflow.turbines import Turbine
from loadflow.wind.cases import Event

from .control.constants import Controller, controller
from .machine import Machine, machine
from .options import RUNGS, RotorOptions, Rung
from .tables import with_table

_MODES = {"tables": (), "bem": (), "flap": ("flap1", "flap2", "edge1")}


def prepare(turbine: Turbine, rung: str, options: RotorOptions) -> tuple[Machine, Controller]:
    """Machine and control for a rung; a table of induction is made once per turbine."""
    if rung not in RUNGS:
        raise InputError(f"rung = {rung!r} is not a rung of the rotor; known: {', '.join(RUNGS)}")
    chosen = replace(options, modes=_MODES[rung], tabulated=rung != "bem")
    return _prepare(_Key(turbine), chosen)


def default_rung(event: Event) -> Rung:
    """Rung where none is named: bending blades, but rigid ones for a turbine that is parked."""
    return "tables" if event.startswith("parked") else "flap"


class _Key:
    """A turbine as a key of the cache: the same object is the same turbine."""

    def __init__(self, turbine: Turbine) -> None:
        self.turbine = turbine

    def __hash__(self) -> int:
        return id(self.turbine)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Key) and self.turbine is other.turbine


@lru_cache(maxsize=8)
def _prepare(key: _Key, options: RotorOptions) -> tuple[Machine, Controller]:
    built = machine(key.turbine, options)
    return (with_table(built) if options.tabulated else built), controller(
        key.turbine, options.individual_pitch
    )
