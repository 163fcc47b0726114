"""The rungs "chart" and "table": the static shaft from a chart of So and β over ε and B/D.

"chart" takes Butenschön's closed forms (ISO 7902-2), "table" interpolates the tables. Both know one
film only, that of ISO 7902: Swift–Stieber rupture at ambient pressure, oil at the widest gap; the
grid is not asked. They have no history and say nothing of fill, stiffness
and damping: these fields are None.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import SolverError
from loadflow.journal.geometry import JournalGeometry
from loadflow.journal.questions import AtRest
from loadflow.journal.rows import operating_columns, without_supply
from loadflow.journal.solvers.messages import no_equilibrium
from loadflow.numerics.fields import require
from loadflow.tribology import film, film_tables

Array = NDArray[np.float64]

_LEAST = 1e-6  # ε up to which So grows in proportion


@dataclass(frozen=True)
class Chart:
    """So, β and So_V over ε and B/D, and how far they go.

    Attributes
    ----------
    name : str
        Name of the rung.
    rotation : callable
        So and β (rad) of (ε, B/D).
    squeeze : callable
        So_V of (ε, B/D), ε < 0 where it falls.
    largest : float
        Largest ε.
    """

    name: str
    rotation: Callable[[ArrayLike, float], tuple[Array, Array]]
    squeeze: Callable[[ArrayLike, float], Array]
    largest: float

    def at_rest(self, width_ratio: float, number: Array) -> tuple[Array, Array]:
        """ε and β (rad) at Sommerfeld numbers `number` (n,); NaN beyond the chart."""
        gaps = np.geomspace(1.0, 1.0 - self.largest, 4000)[1:]
        ratios = np.concatenate([np.geomspace(_LEAST, 1 - gaps[0], 200)[:-1], 1 - gaps])
        numbers, attitudes = self.rotation(np.minimum(ratios, self.largest), width_ratio)
        wanted = np.log(np.maximum(number, 1e-300))
        ratio = np.exp(np.interp(wanted, np.log(numbers), np.log(ratios)))
        ratio *= np.minimum(number / numbers[0], 1.0)
        ratio[number > numbers[-1]] = np.nan
        return ratio, np.interp(ratio, ratios, attitudes)

    def equilibrium(self, asked: AtRest) -> dict[str, Any]:
        """Static equilibria from the chart.

        Raises
        ------
        InputError
            A supply, or B/D outside the chart.
        SolverError
            A load at ω = 0 or beyond the chart; names the first such load.
        """
        bearing, liquid, force, speed = asked.bearing, asked.film.liquid, asked.force, asked.speed
        width_ratio, viscosity = width_of(bearing, self.name), liquid.viscosity
        number = np.array(
            [
                bearing.sommerfeld_number(*point, viscosity)
                for point in zip(np.hypot(*force.T).tolist(), speed.tolist())
            ]
        )
        ratio, attitude = self.at_rest(width_ratio, number)
        found = np.isfinite(ratio)
        if asked.limits.strict and not found.all():
            bad = int(np.flatnonzero(~found)[0])
            end = f"the chart ends there, at ε = {self.largest:.6g}"
            why = f"So = {number[bad]:.6g}: {end}"
            raise SolverError(f"load {bad}: {no_equilibrium(force[bad], speed[bad], why)}")
        turn = np.arctan2(force[:, 1], force[:, 0]) + np.sign(speed) * attitude
        position = ratio[:, None] * np.stack([np.cos(turn), np.sin(turn)], axis=-1)
        known = np.nan_to_num(ratio)
        peak = np.where(
            found, film_tables.tabulated_peak(np.minimum(known, 0.99), width_ratio), np.nan
        )
        mean = np.hypot(*force.T) / (bearing.width * bearing.diameter)
        slip = 0.5 * speed[:, None] * np.stack([position[:, 1], -position[:, 0]], axis=-1)
        return {
            **operating_columns(bearing, force, speed, liquid, position),
            **without_supply(speed.size),
            "eccentricity_ratio": ratio,
            "minimum_film": bearing.clearance * (1 - ratio),
            "maximum_pressure": asked.film.edge_pressure + peak * mean,
            "friction_power": friction_power(bearing, viscosity, position, force, speed, slip),
            "side_flow": np.abs(speed)
            * bearing.diameter**3
            * bearing.relative_clearance
            * film.side_flow_number(ratio, width_ratio),
            "total_fill": None,
            "stiffness": None,
            "damping": None,
            "converged": found,
            "iterations": np.zeros(speed.size, dtype=np.int64),
            "residual": np.where(found, 0.0, np.inf),
        }


def width_of(bearing: JournalGeometry, rung: str) -> float:
    """B/D of a bearing that a chart knows."""
    width_ratio = bearing.width / bearing.diameter
    inside = film_tables.NARROWEST - 1e-6 <= width_ratio <= film_tables.WIDEST
    require(inside, "width/diameter", width_ratio, f'1/8 … 1 with rung = "{rung}"')
    return width_ratio


def friction_power(
    bearing: JournalGeometry,
    viscosity: float,
    position: Array,
    force: Array,
    speed: Array,
    slip: Array,
) -> Array:
    """Shear of the whole gap and work of the load at `slip` u, (3.34); W.

    The pressure dissipates what the load does at the velocity of the shaft against the oil, `slip`
    (n, 2) in clearances per second; at rest this is ISO 7902's friction,
    μ/ψ = π/(√(1 − ε²) So) + ε sin β / 2.
    """
    arc = 2 * np.pi / np.sqrt(1 - (position**2).sum(axis=-1))
    drag = viscosity * speed**2 * bearing.radius**3 * bearing.width / bearing.clearance
    return drag * arc + bearing.clearance * (force * slip).sum(axis=-1)


CLOSED = Chart("chart", film.butenschoen, film.butenschoen_squeeze, 0.999)
TABLE = Chart("table", film_tables.tabulated, film_tables.tabulated_squeeze, 0.99)
