"""A law of cavitation and a model of the film, each in one place: what adding one takes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from loadflow.journal.cavitation import (
    DFILL,
    DLOAD,
    DP,
    DSLACK,
    FILL,
    LOAD,
    SLACK,
    CavitationLaw,
    P,
)
from loadflow.journal.rows import operating_columns, without_supply
from loadflow.journal.rungs import Rung


def _soft(numbers, scale, count, u, state):
    share = numbers[0]
    for i in range(count):
        p = u[i]
        carries = 1.0 if p >= 0.0 else share
        state[P * count + i] = p
        state[DP * count + i] = 1.0
        state[FILL * count + i] = 1.0
        state[DFILL * count + i] = 0.0
        state[SLACK * count + i] = 0.0
        state[DSLACK * count + i] = 0.0
        state[LOAD * count + i] = carries * p
        state[DLOAD * count + i] = carries


@dataclass(frozen=True)
class SoftGuembel(CavitationLaw):
    """Full film of which a share of the tension carries: 1 is Sommerfeld's, 0 is Gümbel's."""

    tension_share: float = 0.0

    kind: ClassVar[str] = "soft-guembel"
    ruptures: ClassVar[bool] = True
    inlet_line: ClassVar[bool] = True
    cells: ClassVar = _soft

    @property
    def numbers(self):
        """Share of the tension that carries."""
        return (self.tension_share,)


TENTH = 0.1


class TenthFilm:
    """A model that finds every shaft at a tenth of the clearance, along its load."""

    def equilibrium(self, asked):
        """Fields of `Equilibrium`."""
        bearing, film, force, speed = asked.bearing, asked.film, asked.force, asked.speed
        position = TENTH * force / np.hypot(*force.T)[:, None]
        flat = np.ones(speed.size)
        drag = film.liquid.viscosity * speed**2 * bearing.radius**3 * bearing.width
        return {
            **operating_columns(bearing, force, speed, film.liquid, position),
            **without_supply(speed.size),
            "eccentricity_ratio": TENTH * flat,
            "minimum_film": (1.0 - TENTH) * bearing.clearance * flat,
            "maximum_pressure": film.edge_pressure * flat,
            "friction_power": 2.0 * np.pi * drag / bearing.clearance,
            "side_flow": bearing.clearance * bearing.width * np.abs(speed) * bearing.radius,
            "total_fill": None,
            "stiffness": None,
            "damping": None,
            "converged": np.ones(speed.size, dtype=bool),
            "iterations": np.zeros(speed.size, dtype=int),
            "residual": 0.0 * flat,
        }


TENTH_FILM = TenthFilm()
TENTH_RUNG = Rung(
    "tenth", "toy_film:TENTH_FILM", frozenset({"heat", "inlet"}), words="not for time"
)
