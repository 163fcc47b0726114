"""Oils and greases as objects, and a small library of real ones."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib import resources
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Gt, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields
from loadflow.tribology import lubricant_laws as laws
from loadflow.tribology.lubricant_laws import CELSIUS, Array


@dataclass(frozen=True, kw_only=True)
class Oil:
    """Liquid lubricant, or the base oil of a grease.

    Attributes
    ----------
    viscosities : tuple of float
        Kinematic viscosities at the two `temperatures`, m²/s.
    temperatures : tuple of float
        K; 40 °C and 100 °C if not given.
    density_15 : float
        Density at 15 °C, kg/m³.
    base : {"mineral", "pao", "ester", "pag"}
        Class of the base oil; gives the pressure–viscosity coefficient unless it is stated.
    pressure_coefficient : float, optional
        Constant pressure–viscosity coefficient α_p, 1/Pa.
    critical_stress : float
        Shear stress τ_c up to which the oil is Newtonian at low pressure, Pa.
    critical_pressure : float
        Pressure above which the limiting shear stress grows, Pa.
    limiting_slope : float
        Growth of the limiting shear stress with pressure.
    thickener : str
        Of a grease; empty for an oil.
    name, source : str
        What it is, and where the numbers come from.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> oil = lubricant("mineral-vg-320")
    >>> round(float(oil.viscosity(343.15)), 3)
    0.06
    """

    viscosities: tuple[float, float]
    temperatures: tuple[float, float] = (40 + CELSIUS, 100 + CELSIUS)
    density_15: Annotated[float, Gt(0)] = 880.0
    base: Literal["mineral", "pao", "ester", "pag"] = "mineral"
    pressure_coefficient: Annotated[float, Gt(0), Le(1e-6)] | None = None
    critical_stress: Annotated[float, Gt(0)] = 4e6
    critical_pressure: Annotated[float, Gt(0)] = 502e6
    limiting_slope: Annotated[float, Gt(0), Le(1)] = 0.08
    thickener: str = ""
    name: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "base", tuple(laws.GOLD))
        thin, thick = min(self.viscosities), max(self.viscosities)
        if not (0.4e-6 < thin < thick < 1.0 and self.viscosities[0] == thick):
            raise InputError(
                "viscosities: two values in m²/s between 4e-7 and 1, the colder and larger first, "
                f"got {self.viscosities}"
            )
        if not 150 < self.temperatures[0] < self.temperatures[1] < 700:
            raise InputError(
                f"temperatures: two rising values in K from 150 to 700, got {self.temperatures}"
            )

    @cached_property
    def slope(self) -> float:
        """Walther's slope m."""
        return laws.walther_slope(self.viscosities, self.temperatures)

    def kinematic_viscosity(self, temperature: ArrayLike) -> Array:
        """Kinematic viscosity at `temperature` (K), m²/s."""
        return laws.walther(temperature, self.viscosities, self.temperatures)

    def density(self, temperature: ArrayLike) -> Array:
        """Density at `temperature` (K) and ambient pressure, kg/m³."""
        return laws.density(temperature, self.density_15)

    def viscosity(self, temperature: ArrayLike, pressure: ArrayLike = 0.0) -> Array:
        """Dynamic viscosity at `temperature` (K) and `pressure` (Pa, Roelands), Pa s."""
        ambient = self.kinematic_viscosity(temperature) * self.density(temperature)
        return laws.roelands(ambient, self.pressure_viscosity(temperature), pressure)

    def pressure_viscosity(self, temperature: ArrayLike) -> Array:
        """Pressure–viscosity coefficient α_p at `temperature` (K), 1/Pa."""
        if self.pressure_coefficient is not None:
            return np.full(np.shape(temperature), self.pressure_coefficient)
        return laws.gold_pressure_viscosity(self.kinematic_viscosity(temperature), self.base)

    def steepness(self, temperature: ArrayLike) -> Array:
        """Steepness β_th = -d(ln η)/dT at `temperature` (K), 1/K."""
        nu = self.kinematic_viscosity(temperature)
        thinning = 0.605 / self.density(temperature)
        return laws.walther_steepness(nu, temperature, self.slope) + thinning

    def conductivity(self, temperature: ArrayLike) -> Array:
        """Thermal conductivity at `temperature` (K), W/(m K)."""
        return laws.conductivity(temperature, self.density(temperature))


def lubricant(name: str) -> Oil:
    """Oil or grease of the library.

    Parameters
    ----------
    name : str
        One of `lubricant_names`.

    Raises
    ------
    InputError
        If there is none of that name.
    """
    table = _library()
    if name not in table:
        raise InputError(f"lubricant: must be one of {', '.join(sorted(table))}, got {name!r}")
    fields = dict(table[name])
    viscosities = tuple(nu * 1e-6 for nu in fields.pop("viscosities_mm2_s"))
    celsius = fields.pop("temperatures_celsius", (40, 100))
    temperatures = tuple(t + CELSIUS for t in celsius)
    return Oil(viscosities=viscosities, temperatures=temperatures, name=name, **fields)


def lubricant_names() -> list[str]:
    """Names of the oils and greases of the library."""
    return sorted(_library())


@lru_cache(maxsize=1)
def _library() -> dict[str, dict[str, Any]]:
    path = resources.files("loadflow.data") / "lubricants.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))
