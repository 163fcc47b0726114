"""The rungs of the rotor model."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.turbines import Turbine

from .control.constants import Controller, controller
from .machine import Machine, machine
from .options import RUNGS, RotorOptions, Rung
from .schedule import schedule_over_power
from .tables import with_table
from .tuning import tuned

_MODES = ("flap1", "flap2", "edge1")


def prepare(turbine: Turbine, rung: str, options: RotorOptions) -> tuple[Machine, Controller]:
    """Machine and control for a rung; a table of induction is made once per turbine."""
    if rung not in RUNGS:
        raise InputError(f"rung = {rung!r} is not a rung of the rotor; known: {', '.join(RUNGS)}")
    yields = rung == "tower"
    chosen = replace(
        options,
        modes=_MODES if rung in ("flap", "tower") else (),
        tabulated=rung != "bem",
        tower_motion=options.tower_motion and yields,
        drivetrain_torsion=options.drivetrain_torsion and yields,
    )
    return _prepare(Same(turbine), chosen)


def finest_rung(turbine: Turbine) -> Rung:
    """Rung with all that the file of the turbine describes."""
    return "flap" if turbine.tower.bending is None else "tower"


class Same:
    """A thing as a key of a cache: the same object is the same thing."""

    def __init__(self, thing: Any) -> None:
        self.thing = thing

    def __hash__(self) -> int:
        return id(self.thing)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Same) and self.thing is other.thing


@lru_cache(maxsize=8)
def _prepare(key: Same, options: RotorOptions) -> tuple[Machine, Controller]:
    built, turbine = machine(key.thing, options), _tuned(key)
    c = controller(turbine, options.individual_pitch)
    if turbine.control.scheduled_wind:
        power, pitch = _schedule(Same(turbine))
        c = c._replace(scheduled_power=power, scheduled_pitch=pitch)
    return (with_table(built) if options.tabulated else built), c


@lru_cache(maxsize=8)
def _tuned(key: Same) -> Turbine:
    return tuned(key.thing)


@lru_cache(maxsize=8)
def _schedule(key: Same) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    return schedule_over_power(key.thing)
