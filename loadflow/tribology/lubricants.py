"""Oils and greases as objects, and a small library of real ones."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from importlib import resources
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import ArrayLike

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields, not_one_of
from loadflow.quantities import CELSIUS
from loadflow.tribology import lubricant_laws as laws
from loadflow.tribology import lubricant_states as states
from loadflow.tribology.lubricant_laws import Array

PRESSURE_LAWS = {"roelands": states.roelands_state, "barus": states.barus_state}


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
    pressure_law : {"roelands", "barus"}
        How the viscosity rises with pressure; alike at low pressure.
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
    pressure_law: Literal["roelands", "barus"] = "roelands"
    critical_stress: Annotated[float, Gt(0)] = 4e6
    critical_pressure: Annotated[float, Gt(0)] = 502e6
    limiting_slope: Annotated[float, Gt(0), Le(1)] = 0.08
    thickener: str = ""
    name: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "base", tuple(laws.GOLD))
        check_choice(self, "pressure_law", tuple(PRESSURE_LAWS))
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

    @cached_property
    def level(self) -> float:
        """Walther's level a."""
        return laws.walther_level(self.viscosities, self.temperatures)

    def scaled(self, factor: float) -> Oil:
        """The oil with `factor` times its kinematic viscosities at both of its temperatures.

        Examples
        --------
        >>> lubricant("mineral-vg-320").scaled(1.1).viscosities[0] * 1e6
        352.0
        """
        first, second = self.viscosities
        return replace(self, viscosities=(factor * first, factor * second))

    def kinematic_viscosity(self, temperature: ArrayLike) -> Array:
        """Kinematic viscosity at `temperature` (K), m²/s."""
        return laws.walther(temperature, self.viscosities, self.temperatures)

    def density(self, temperature: ArrayLike, pressure: ArrayLike = 0.0) -> Array:
        """Density at `temperature` (K) and `pressure` (Pa), kg/m³."""
        t, p = np.asarray(temperature, float), np.asarray(pressure, float)
        return np.asarray(states.density_state(t, p, self.density_15, 15 + CELSIUS)[0])

    def viscosity(self, temperature: ArrayLike, pressure: ArrayLike = 0.0) -> Array:
        """Dynamic viscosity at `temperature` (K) and `pressure` (Pa), Pa s."""
        return self._viscosity(temperature, pressure)[0]

    def viscosity_slopes(
        self, temperature: ArrayLike, pressure: ArrayLike = 0.0
    ) -> tuple[Array, Array]:
        """Derivatives of the dynamic viscosity, ∂η/∂T in Pa s/K and ∂η/∂p in s."""
        return self._viscosity(temperature, pressure)[1:]

    def _viscosity(self, temperature: ArrayLike, pressure: ArrayLike) -> tuple[Array, Array, Array]:
        """η and its derivatives by temperature and pressure."""
        t, p = np.asarray(temperature, float), np.asarray(pressure, float)
        nu, nu_t = states.walther_state(t, self.level, self.slope)
        rho, rho_t, _ = states.density_state(t, 0.0, self.density_15, 15 + CELSIUS)
        if self.pressure_coefficient is None:
            alpha, alpha_t = states.gold_state(nu, nu_t, *laws.GOLD[self.base])
        else:
            alpha, alpha_t = self.pressure_coefficient, 0.0
        law = PRESSURE_LAWS[self.pressure_law]
        found = law(nu * rho, nu_t * rho + nu * rho_t, alpha, alpha_t, p)
        eta, eta_t, eta_p = (np.asarray(x) for x in found)
        return eta, eta_t, eta_p

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

    def specific_heat(self, temperature: ArrayLike) -> Array:
        """Specific heat at `temperature` (K), J/(kg K)."""
        return laws.specific_heat(temperature, self.density_15)


@dataclass(frozen=True, kw_only=True)
class ExponentialOil:
    """Oil whose viscosity falls exponentially with temperature, as many reference cases state it.

    η = η_ref exp(-β (T - T_ref)), times the rise under pressure; density, specific heat and
    conductivity are constant. It has the methods of `Oil`.

    Attributes
    ----------
    reference_viscosity : float
        η_ref, Pa s.
    reference_temperature : float
        T_ref, K.
    constant_steepness : float
        β, 1/K; 0 for constant viscosity.
    reference_density : float
        kg/m³.
    constant_specific_heat : float
        J/(kg K).
    constant_conductivity : float
        W/(m K).
    pressure_coefficient : float
        α, 1/Pa; 0 for none.
    pressure_law : {"roelands", "barus"}
        How the viscosity rises with pressure.

    Raises
    ------
    InputError
        If a field is out of its range.

    Examples
    --------
    >>> oil = ExponentialOil(reference_viscosity=0.0277, constant_steepness=0.0341)
    >>> round(float(oil.viscosity(333.15)), 6)
    0.014005
    >>> [round(float(slope), 7) for slope in oil.viscosity_slopes(333.15)]
    [-0.0004776, 0.0]
    """

    reference_viscosity: Annotated[float, Gt(0), Le(1e3)]
    reference_temperature: Annotated[float, Gt(150), Le(700)] = 40 + CELSIUS
    constant_steepness: Annotated[float, Ge(0), Le(1)] = 0.0
    reference_density: Annotated[float, Gt(0)] = 860.0
    constant_specific_heat: Annotated[float, Gt(0)] = 2000.0
    constant_conductivity: Annotated[float, Gt(0)] = 0.14
    pressure_coefficient: Annotated[float, Ge(0), Le(1e-6)] = 0.0
    pressure_law: Literal["roelands", "barus"] = "barus"

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "pressure_law", tuple(PRESSURE_LAWS))

    def scaled(self, factor: float) -> ExponentialOil:
        """The oil with `factor` times its viscosity."""
        return replace(self, reference_viscosity=factor * self.reference_viscosity)

    def viscosity(self, temperature: ArrayLike, pressure: ArrayLike = 0.0) -> Array:
        """Dynamic viscosity at `temperature` (K) and `pressure` (Pa), Pa s."""
        return self._viscosity(temperature, pressure)[0]

    def viscosity_slopes(
        self, temperature: ArrayLike, pressure: ArrayLike = 0.0
    ) -> tuple[Array, Array]:
        """Derivatives of the dynamic viscosity, ∂η/∂T in Pa s/K and ∂η/∂p in s."""
        return self._viscosity(temperature, pressure)[1:]

    def kinematic_viscosity(self, temperature: ArrayLike) -> Array:
        """Kinematic viscosity at `temperature` (K), m²/s."""
        return self.viscosity(temperature) / self.reference_density

    def density(self, temperature: ArrayLike, pressure: ArrayLike = 0.0) -> Array:
        """Density, kg/m³, constant."""
        return np.full(
            np.broadcast_shapes(np.shape(temperature), np.shape(pressure)), self.reference_density
        )

    def steepness(self, temperature: ArrayLike) -> Array:
        """Steepness β = -d(ln η)/dT, 1/K, constant."""
        return np.full(np.shape(temperature), self.constant_steepness)

    def pressure_viscosity(self, temperature: ArrayLike) -> Array:
        """Pressure–viscosity coefficient α, 1/Pa, constant."""
        return np.full(np.shape(temperature), self.pressure_coefficient)

    def conductivity(self, temperature: ArrayLike) -> Array:
        """Thermal conductivity, W/(m K), constant."""
        return np.full(np.shape(temperature), self.constant_conductivity)

    def specific_heat(self, temperature: ArrayLike) -> Array:
        """Specific heat, J/(kg K), constant."""
        return np.full(np.shape(temperature), self.constant_specific_heat)

    def _viscosity(self, temperature: ArrayLike, pressure: ArrayLike) -> tuple[Array, Array, Array]:
        """η and its derivatives by temperature and pressure."""
        t, p = np.asarray(temperature, float), np.asarray(pressure, float)
        ambient = states.exponential_state(
            t, self.reference_viscosity, self.constant_steepness, self.reference_temperature
        )
        law = PRESSURE_LAWS[self.pressure_law]
        eta, eta_t, eta_p = law(*ambient, self.pressure_coefficient, 0.0, p)
        return np.asarray(eta), np.asarray(eta_t), np.asarray(eta_p)


def lubricant(name: str) -> Oil:
    """Oil or grease of the library.

    Parameters
    ----------
    name : str
        One of `lubricant_names`.

    Returns
    -------
    Oil
        The oil; of a grease its base oil.

    Raises
    ------
    InputError
        If there is none of that name.

    Examples
    --------
    >>> lubricant("iso-vg-68").density_15
    880.0
    """
    table = _library()
    if name not in table:
        raise InputError(f"lubricant: {not_one_of(name, sorted(table))}")
    fields = dict(table[name])
    viscosities = tuple(nu * 1e-6 for nu in fields.pop("viscosities_mm2_s"))
    celsius = fields.pop("temperatures_celsius", (40, 100))
    temperatures = tuple(t + CELSIUS for t in celsius)
    return Oil(viscosities=viscosities, temperatures=temperatures, name=name, **fields)


def lubricant_names() -> list[str]:
    """Names of the oils and greases of the library.

    Returns
    -------
    list of str
        In the order of the alphabet, for `lubricant`.

    Examples
    --------
    >>> "mineral-vg-320" in lubricant_names()
    True
    """
    return sorted(_library())


@lru_cache(maxsize=1)
def _library() -> dict[str, dict[str, Any]]:
    path = resources.files("loadflow.data") / "lubricants.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))
