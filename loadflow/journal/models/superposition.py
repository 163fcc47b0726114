"""Historical rungs: force of rotation and force of squeeze computed apart and added.

"holland" adds the load-carrying vectors [Holland 1959] of the tables, "butenschoen" those of the
closed forms [Butenschön 1976]; "hahn" adds the pressures of both motions and cuts what is negative
[Hahn 1957], which for a linear film is the Gümbel film. At rest they are "table", "chart" and the
Gümbel film.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from loadflow.journal.cavitation import Guembel
from loadflow.journal.film_model import Film
from loadflow.journal.models import mobility_map
from loadflow.journal.models.charts import CLOSED, TABLE, Chart, friction_power, width_of
from loadflow.journal.models.mobility_map import advance
from loadflow.journal.questions import AtRest, InMotion
from loadflow.journal.solvers.motion.transient import orbit_dataset
from loadflow.numerics.splines import spline
from loadflow.quantities import FILM

if TYPE_CHECKING:
    import xarray as xr


Array = NDArray[np.float64]

_NODES = 200


@dataclass(frozen=True)
class Superposed:
    """Load-carrying vectors of a chart, added.

    Attributes
    ----------
    name : str
        Name of the rung.
    chart : Chart
        What the vectors are taken from.
    """

    name: str
    chart: Chart

    def equilibrium(self, asked: AtRest) -> dict[str, Any]:
        """Static equilibria: those of the chart."""
        return replace(self.chart, name=self.name).equilibrium(asked)

    def orbit(self, asked: InMotion) -> xr.Dataset:
        """Path of the shaft by an ordinary differential equation, as of the rung "map".

        Largest pressure, flow and fill are not known and missing.
        """
        bearing, force, speed = asked.bearing, asked.force, asked.speed
        width_ratio = width_of(bearing, self.name)
        start = asked.steps.start
        if start is None:
            first = self.equilibrium(asked.at_rest.at(np.array([0])))
            start = first["eccentricity"][0] / bearing.clearance
        motion, axes = _vectors(self.chart, width_ratio)
        viscosity = asked.film.liquid.viscosity
        per_load = bearing.relative_clearance**2 / (12 * viscosity)
        units = np.array([bearing.width * bearing.diameter, per_load])
        path, slip, values = advance(motion, axes, units, asked, start)
        gap = 1 - np.hypot(*path.T)
        values |= {
            "minimum_film": bearing.clearance * gap,
            "friction_power": friction_power(bearing, viscosity, path, force, speed, slip),
        }
        data = orbit_dataset(values, asked.time, force, speed, bearing.clearance)
        covered = gap >= 1 - self.chart.largest
        return data.assign(in_range=("time", covered, FILM["in_range"].attributes))


@lru_cache(maxsize=16)
def _vectors(chart: Chart, width_ratio: float) -> tuple[Array, Array]:
    """Splines over ξ of the four mobilities that `_map_kernels` adds, and their axes."""
    xi = np.linspace(0.0, -math.log(1.0 - chart.largest), _NODES)
    ratio = np.minimum(np.maximum(-np.expm1(-xi), 1e-6), chart.largest)
    so, beta = chart.rotation(ratio, width_ratio)
    rows = [
        1 / np.tan(beta),
        np.log(6 * ratio / (so * np.sin(beta))),
        np.log(12 / chart.squeeze(ratio, width_ratio)),
        np.log(12 / chart.squeeze(-ratio, width_ratio)),
    ]
    coef = spline(np.stack(rows, axis=-1), 0, "smooth")
    axes = np.array([xi[1], 1.0, 1.0, 1.0, xi[-1], 0.0])
    return np.ascontiguousarray(coef[:, None, None, :]), axes


class Hahn:
    """Superposed pressures: the Gümbel film without an inlet, by its map."""

    def equilibrium(self, asked: AtRest) -> dict[str, Any]:
        """Static equilibria of the Gümbel film."""
        return mobility_map.equilibrium(replace(asked, film=_guembel(asked.film)))

    def orbit(self, asked: InMotion) -> xr.Dataset:
        """Path of the shaft in the Gümbel film."""
        return mobility_map.orbit(replace(asked, film=_guembel(asked.film)))


def _guembel(film: Film) -> Film:
    law = Guembel(cavitation_pressure=film.edge_pressure)
    return replace(film, cavitation=law, inlet=None)


HOLLAND = Superposed("holland", TABLE)
BUTENSCHOEN = Superposed("butenschoen", CLOSED)
HAHN = Hahn()
