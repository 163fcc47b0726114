"""Films by the closed charts of ISO 7902, whatever the bore: those of a cylinder at rest."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from loadflow.journal import Equilibrium, JournalBearing, Lubricant
from loadflow.journal.shapes import CYLINDER
from loadflow.scene.journal import Journal
from loadflow.shaft import BearingModel
from loadflow.stages.films.support import TURN
from loadflow.stages.frames import to_film

Floats = np.ndarray

WIDTHS = 1 / 8, 1.0
"""Width over diameter that the charts know."""

_STEP = 1e-3
"""Share of a load by which it is changed to see how the film gives way."""


@dataclass(frozen=True)
class ChartFilm:
    """A bearing as charts know it, with the oil as it enters.

    A width that they do not know is taken at the end of their range, under the same specific load.

    Attributes
    ----------
    bearing : JournalBearing
        The cylinder.
    lubricant : Lubricant
        Its oil.
    share : float
        Width of the cylinder over that of the bearing.
    """

    bearing: JournalBearing
    lubricant: Lubricant
    share: float

    def equilibrium(self, force: Floats, speed: Floats) -> Equilibrium:
        """Films under loads of the whole bearing, `force` (n, 2), N, in the plane of the film."""
        pressed = force * self.share
        return self.bearing.equilibrium(pressed, speed, self.lubricant, rung="chart", strict=False)

    def model(self, speed: float) -> BearingModel:
        """What a shaft feels of it that turns with `speed`, rad/s, and tilts freely.

        A film of a cylinder turns with its load: along it, it gives way as its place changes with
        the size of the load, across it as that place turns.
        """
        turn = TURN[:2, :2]

        def model(force: Floats, moment: Floats) -> tuple[Floats, Floats]:
            load, turning = to_film(force), np.full(len(force), speed)
            lies, more = (
                np.asarray(self.equilibrium(load * size, turning).eccentricity)
                for size in (1.0, 1.0 + _STEP)
            )
            along, across = (more - lies) / _STEP, lies
            soft = (
                along[:, :, None] * load[:, None]
                + _turned(across)[:, :, None] * _turned(load)[:, None]
            )
            with np.errstate(divide="ignore", invalid="ignore"):
                soft = soft / (load**2).sum(axis=-1)[:, None, None]
            return lies @ turn, turn.T @ np.linalg.inv(soft) @ turn

        return model


def _turned(vector: Floats) -> Floats:
    """By a right angle, (..., 2)."""
    return np.stack([-vector[..., 1], vector[..., 0]], axis=-1)


def charted(journal: Journal) -> ChartFilm:
    """A bearing of a scene as charts know it."""
    heat = journal.heat
    held = journal.at_temperature(heat.inlet_temperature) if heat else journal
    size = held.geometry
    width = float(np.clip(size.width_ratio, *WIDTHS)) * size.diameter
    cylinder = replace(size, shape=CYLINDER, relief=(), width=width)
    return ChartFilm(cylinder, held.lubricant, width / size.width)
