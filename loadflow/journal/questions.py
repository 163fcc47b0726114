"""What is asked about a film: a shaft at rest under loads, at given positions, or in motion.

Loads, positions and times lead in all arrays: they are n.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, Self

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.film_model import Film
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.line import Line
from loadflow.numerics.convergence import Limits
from loadflow.numerics.fields import require

Array = NDArray[np.float64]
Some = NDArray[np.int64]

_PERIODIC = (False, True, "direct", "marching")


@dataclass(frozen=True)
class Steps:
    """How an orbit goes through time, as documented at `JournalBearing.orbit`.

    Attributes
    ----------
    start : array (2,), optional
        First position, clearances.
    temperature : float
        Of the film at the first time, K, where it stores heat.
    """

    start: Array | None = None
    step: Literal["given", "adaptive"] = "given"
    step_tolerance: float = 1e-3
    periodic: bool | Literal["direct", "marching"] = False
    closure: float = 1e-6
    max_periods: int = 100
    temperature: float = 0.0

    def __post_init__(self) -> None:
        require(self.step in ("given", "adaptive"), "step", self.step, '"given" or "adaptive"')
        require(self.step_tolerance > 0, "step_tolerance", self.step_tolerance, "> 0")
        allowed = 'False, True, "direct" or "marching"'
        require(self.periodic in _PERIODIC, "periodic", self.periodic, allowed)

    @property
    def accuracy(self) -> float:
        """Error of a step, share of the narrowest gap; no limit where steps are given."""
        return self.step_tolerance if self.step == "adaptive" else np.inf


@dataclass(frozen=True)
class AtRest:
    """Where the shaft rests under each of some loads, and its film.

    Attributes
    ----------
    force : array (n, 2)
        N.
    speed : array (n,)
        rad/s.
    line : Line
        How the shaft lies under each load.
    """

    bearing: JournalGeometry
    film: Film
    force: Array
    speed: Array
    line: Line
    limits: Limits

    def at(self, some: Some) -> Self:
        """The same of the loads at `some` (m,) alone."""
        force, speed = self.force[some], self.speed[some]
        return replace(self, force=force, speed=speed, line=self.line.at(some))


@dataclass(frozen=True)
class AtPosition:
    """The film of a shaft at each of some positions.

    Attributes
    ----------
    position, velocity : array (n, 2)
        Clearances; clearances per second.
    speed : array (n,)
        rad/s.
    line : Line
        How the shaft lies at each position.
    """

    bearing: JournalGeometry
    film: Film
    position: Array
    velocity: Array
    speed: Array
    line: Line
    limits: Limits

    def at(self, some: Some) -> Self:
        """The same of the positions at `some` (m,) alone."""
        position, velocity, speed = self.position[some], self.velocity[some], self.speed[some]
        line = self.line.at(some)
        return replace(self, position=position, velocity=velocity, speed=speed, line=line)


@dataclass(frozen=True)
class InMotion:
    """The path of the shaft under a load that changes over time.

    Attributes
    ----------
    time : array (n,)
        s.
    force : array (n, 2)
        N.
    speed : array (n,)
        rad/s.
    line : Line
        How the shaft lies at each time.
    """

    bearing: JournalGeometry
    film: Film
    time: Array
    force: Array
    speed: Array
    line: Line
    limits: Limits
    steps: Steps

    def at(self, some: Some) -> Self:
        """The same of the times at `some` (m,) alone."""
        time, force, speed = self.time[some], self.force[some], self.speed[some]
        return replace(self, time=time, force=force, speed=speed, line=self.line.at(some))

    @property
    def at_rest(self) -> AtRest:
        """The shaft at rest under the load of each time."""
        return AtRest(self.bearing, self.film, self.force, self.speed, self.line, self.limits)
