"""Journal bearing: the tables of the source [Jonuschies 2015, ch. 5.3] beside ours."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from loadflow.validation.check import Check


@dataclass(frozen=True)
class BaseLoad:
    """A row of Table 5-13: wind speed (m/s), speed (1/min), forces (kN), printed E_max and So_max."""

    wind: int
    speed: float
    mean_x: float
    amplitude_x: float
    mean_y: float
    amplitude_y: float
    e_max: float
    so_max: float

    @property
    def omega(self) -> float:
        """Speed of the shaft, rad/s."""
        return self.speed * np.pi / 30

    @property
    def worst_loads(self) -> np.ndarray:
        """The two candidates for the worst load vector, (2, 2), N."""
        x = self.mean_x + self.amplitude_x
        return 1e3 * np.array([[x, self.mean_y + s * self.amplitude_y] for s in (1.0, -1.0)])


BASE_LOADS = (
    BaseLoad(4, 7.20, 1373.06, 181.04, 24.81, 245.38, 0.67, 6.48),
    BaseLoad(8, 10.46, 1490.81, 322.84, 130.04, 317.58, 0.61, 4.60),
    BaseLoad(12, 11.89, 1670.21, 388.40, 155.25, 287.56, 0.61, 4.31),
    BaseLoad(16, 12.10, 1974.87, 489.14, -15.07, 507.18, 0.66, 5.06),
    BaseLoad(20, 12.10, 2275.48, 659.54, -212.01, 446.52, 0.71, 6.12),
    BaseLoad(24, 12.10, 2584.26, 615.76, -459.68, 608.10, 0.73, 6.98),
)


def reference_bearing() -> tuple:
    """Bearing of ch. 5.3 and the options of its film."""
    from loadflow.journal import GasMixture, JournalBearing, Lubricant

    bearing = JournalBearing(diameter=3.0, width=2.25, relative_clearance=0.5e-3)
    film = {
        "lubricant": Lubricant(viscosity=0.050),
        "cavitation": GasMixture(0.05e6),
        "edge_pressure": 0.5e6,
        "grid": (60, 20),
    }
    return bearing, film


def peak_number(pressure: float, omega: float) -> float:
    """So of the tables: p_max ψ²/(η ω), on the largest pressure, not on the mean (1.13)."""
    return pressure * 0.5e-3**2 / (0.050 * omega)


def base_load_checks() -> Iterator[Check]:
    """Table 5-13; the base periods are so long that the worst load acts as if it stood still."""
    bearing, film = reference_bearing()
    for row in BASE_LOADS:
        state = bearing.equilibrium(row.worst_loads, row.omega, **film)
        name = f"V = {row.wind} m/s"
        e_max = float(state.eccentricity_ratio.max())
        yield Check(f"E_max, {name}", "Table 5-13", row.e_max, e_max, 0.015, "absolute")
        so_max = peak_number(float(state.maximum_pressure.max()), row.omega)
        yield Check(f"So_max, {name}", "Table 5-13", row.so_max, so_max, 0.02)


def checks() -> Iterator[Check]:
    """All printed numbers of the journal bearing."""
    yield from base_load_checks()
