"""Laws of liquid lubricants: viscosity, density, pressure, heat.

Plain expressions that broadcast over arrays; temperatures in K, everything else in SI units.
Equation numbers are those of von Hollen, *Reibung von Kurbelwellen-Wälzlagern*, Hannover 2013.

References
----------
DIN 51563 (Ubbelohde–Walther); Barus 1893; Roelands 1966; Dowson & Higginson 1966 (density);
Gold, Schmidt, Dicke, Loos, Assmann: J. Synthetic Lubrication, 2001 (pressure–viscosity);
Cragoe 1929 (thermal conductivity).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.numerics.fields import check_one_of
from loadflow.quantities import CELSIUS
from loadflow.tribology import lubricant_states as states

Array = NDArray[np.float64]

_MM2 = 1e6  # m²/s in mm²/s
# Gold: α = s ν^t with ν in mm²/s and α in 1e-9/Pa
GOLD = {
    "mineral": (9.904, 0.1390),
    "pao": (7.382, 0.1335),
    "ester": (6.605, 0.1360),
    "pag": (5.489, 0.1485),
}


def walther_slope(viscosities: tuple[float, float], temperatures: tuple[float, float]) -> float:
    """Slope m of the Ubbelohde–Walther line through two points, (5.58).

    Examples
    --------
    >>> round(walther_slope((100e-6, 11e-6), (313.15, 373.15)), 3)
    3.568
    """
    (nu1, nu2), (t1, t2) = viscosities, temperatures
    rise = _double_log(nu1) - _double_log(nu2)
    return float(rise / np.log10(t2 / t1))


def walther_level(viscosities: tuple[float, float], temperatures: tuple[float, float]) -> float:
    """Level a of the Ubbelohde–Walther line log log(ν + 0.8) = a - m log T through two points.

    Examples
    --------
    >>> round(walther_level((100e-6, 11e-6), (313.15, 373.15)), 3)
    9.207
    """
    slope = walther_slope(viscosities, temperatures)
    return float(_double_log(viscosities[0]) + slope * np.log10(temperatures[0]))


def walther(
    temperature: ArrayLike,
    viscosities: tuple[float, float],
    temperatures: tuple[float, float] = (40 + CELSIUS, 100 + CELSIUS),
) -> Array:
    """Kinematic viscosity after Ubbelohde–Walther through two measured points, m²/s, (5.58).

    Parameters
    ----------
    temperature : array_like
        K.
    viscosities : tuple of float
        Kinematic viscosities at the two `temperatures`, m²/s.
    temperatures : tuple of float
        K; 40 °C and 100 °C if not given.

    Examples
    --------
    >>> round(float(walther(343.15, (100e-6, 11e-6))) * 1e6, 2)
    27.09
    """
    slope = walther_slope(viscosities, temperatures)
    level = walther_level(viscosities, temperatures)
    return np.asarray(states.walther_state(np.asarray(temperature, float), level, slope)[0])


def _double_log(viscosity: ArrayLike) -> Array:
    return np.log10(np.log10(np.asarray(viscosity, float) * _MM2 + 0.8))


def walther_steepness(viscosity: ArrayLike, temperature: ArrayLike, slope: float) -> Array:
    """Steepness -d(ln ν)/dT of a Walther line, 1/K.

    Parameters
    ----------
    viscosity : array_like
        Kinematic viscosity at `temperature`, m²/s.
    temperature : array_like
        K.
    slope : float
        m of `walther_slope`.

    Examples
    --------
    >>> round(float(walther_steepness(27.09e-6, 343.15, 3.515)), 4)
    0.0351
    """
    nu = np.asarray(viscosity, float) * _MM2
    return slope * np.log(nu + 0.8) * (nu + 0.8) / (nu * np.asarray(temperature, float))


def andrade_steepness(
    temperature: ArrayLike,
    viscosities: tuple[float, float],
    temperatures: tuple[float, float] = (40 + CELSIUS, 100 + CELSIUS),
) -> Array:
    """Steepness β_th = -d(ln η)/dT of ln η ~ 1/T through two dynamic viscosities, 1/K, (5.94).

    Examples
    --------
    >>> round(float(andrade_steepness(363.15, (26.3e-3, 10.6e-3), (333.15, 363.15))), 4)
    0.0278
    """
    (eta1, eta2), (t1, t2) = viscosities, temperatures
    scale = t1 * t2 / (t2 - t1) * np.log(eta1 / eta2)
    return np.asarray(scale / np.asarray(temperature, float) ** 2)


def bulk_modulus(pressure: ArrayLike) -> Array:
    """Bulk modulus ρ dp/dρ of the compression after Dowson and Higginson, Pa.

    Examples
    --------
    >>> round(float(bulk_modulus(0.0)) / 1e9, 3)
    1.667
    """
    rho, _, rho_p = states.density_state(0.0, np.asarray(pressure, float), 1.0, 0.0)
    return np.asarray(rho / rho_p)


def gold_pressure_viscosity(
    viscosity: ArrayLike, base: Literal["mineral", "pao", "ester", "pag"] = "mineral"
) -> Array:
    """Pressure–viscosity coefficient α = s ν^t for a class of base oils (Gold), 1/Pa.

    Parameters
    ----------
    viscosity : array_like
        Kinematic viscosity at the temperature in question, m²/s.
    base : {"mineral", "pao", "ester", "pag"}
        Class of the base oil.

    Raises
    ------
    InputError
        If `base` is unknown.

    Examples
    --------
    >>> round(float(gold_pressure_viscosity(70e-6)) * 1e9, 2)
    17.88
    """
    check_one_of("base", base, GOLD)
    return np.asarray(states.gold_state(np.asarray(viscosity, float), 0.0, *GOLD[base])[0])


def conductivity(
    temperature: ArrayLike,
    ambient_density: ArrayLike,
    variant: Literal["physics", "printed"] = "physics",
) -> Array:
    """Thermal conductivity k_th, W/(m K), (5.95).

    Parameters
    ----------
    temperature : array_like
        K.
    ambient_density : array_like
        kg/m³.
    variant : {"physics", "printed"}
        Cragoe's formula takes °C; von Hollen prints it with K, which lowers k_th by 13 % or so.

    Examples
    --------
    >>> round(float(conductivity(363.15, 805.0)), 4)
    0.1386
    """
    check_one_of("variant", variant, ("physics", "printed"))
    t = np.asarray(temperature, float) - (CELSIUS if variant == "physics" else 0.0)
    return np.asarray((0.1173 - 6.33e-5 * t) / (np.asarray(ambient_density, float) / 1e3))


def specific_heat(temperature: ArrayLike, density_15: float) -> Array:
    """Specific heat of mineral oils, J/(kg K) [Cragoe 1929].

    Parameters
    ----------
    temperature : array_like
        K.
    density_15 : float
        Density at 15 °C, kg/m³.

    Examples
    --------
    >>> round(float(specific_heat(313.15, 860.0)))
    1964
    """
    return np.asarray(states.specific_heat_state(np.asarray(temperature, float), density_15)[0])
