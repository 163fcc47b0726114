"""Laws of liquid lubricants: viscosity, density, pressure, heat.

Plain expressions that broadcast over arrays; temperatures in K, everything else in SI units.
Equation numbers are those of von Hollen, *Reibung von Kurbelwellen-Wälzlagern*, Hannover 2013.

References
----------
DIN 51563 (Ubbelohde–Walther); Barus 1893; Roelands 1966; Dowson & Higginson 1966 (density);
Gold, Schmidt, Dicke, Loos, Assmann: J. Synthetic Lubrication 18 (2001) 51 (pressure–viscosity);
Cragoe 1929 (thermal conductivity).
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]

CELSIUS = 273.15
_MM2 = 1e6  # m²/s in mm²/s
# Dowson and Higginson's compression of mineral oil, 1/Pa
_SQUEEZED, _STIFFENED = 0.6e-9, 1.7e-9
# Roelands: pressure of the pole of all isotherms (Pa) and ln of its viscosity (Pa s)
_ROELANDS_PRESSURE, _ROELANDS_LOG = 1.0 / 5.1e-9, -9.67
# Gold: α = s ν^t with ν in mm²/s and α in 1e-9/Pa
GOLD = {
    "mineral": (9.904, 0.1390),
    "pao": (7.382, 0.1335),
    "ester": (6.605, 0.1360),
    "pag": (5.489, 0.1485),
}


def walther_slope(viscosities: tuple[float, float], temperatures: tuple[float, float]) -> float:
    """Slope m of the Ubbelohde–Walther line through two points, (5.58)."""
    (nu1, nu2), (t1, t2) = viscosities, temperatures
    rise = _double_log(nu1) - _double_log(nu2)
    return float(rise / np.log10(t2 / t1))


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
    t = np.asarray(temperature, float)
    slope = walther_slope(viscosities, temperatures)
    level = slope * np.log10(temperatures[0] / t) + _double_log(viscosities[0])
    return np.asarray((10.0 ** (10.0**level) - 0.8) / _MM2)


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
    """
    nu = np.asarray(viscosity, float) * _MM2
    return slope * np.log(nu + 0.8) * (nu + 0.8) / (nu * np.asarray(temperature, float))


def andrade_steepness(
    temperature: ArrayLike,
    viscosities: tuple[float, float],
    temperatures: tuple[float, float] = (40 + CELSIUS, 100 + CELSIUS),
) -> Array:
    """Steepness β_th = -d(ln η)/dT of ln η ~ 1/T through two dynamic viscosities, 1/K, (5.94)."""
    (eta1, eta2), (t1, t2) = viscosities, temperatures
    scale = t1 * t2 / (t2 - t1) * np.log(eta1 / eta2)
    return np.asarray(scale / np.asarray(temperature, float) ** 2)


def barus(viscosity: ArrayLike, coefficient: ArrayLike, pressure: ArrayLike) -> Array:
    """Viscosity η₀ exp(α p) under pressure, Pa s, (5.52).

    Far too high above about 0.5 GPa; infinite rather than an error where it overflows.
    """
    exponent = np.asarray(coefficient, float) * np.asarray(pressure, float)
    return np.asarray(viscosity, float) * np.exp(np.minimum(exponent, 700.0))


def roelands(viscosity: ArrayLike, coefficient: ArrayLike, pressure: ArrayLike) -> Array:
    """Viscosity under pressure after Roelands, Pa s; its slope at p = 0 is that of Barus.

    Parameters
    ----------
    viscosity : array_like
        At ambient pressure, Pa s.
    coefficient : array_like
        α of Barus, 1/Pa.
    pressure : array_like
        Pa.
    """
    above = np.log(np.asarray(viscosity, float)) - _ROELANDS_LOG
    power = np.asarray(coefficient, float) * _ROELANDS_PRESSURE / above
    lift = (1 + np.asarray(pressure, float) / _ROELANDS_PRESSURE) ** power - 1
    return np.asarray(viscosity, float) * np.exp(np.minimum(above * lift, 700.0))


def density(
    temperature: ArrayLike, reference: float, reference_temperature: float = 15 + CELSIUS
) -> Array:
    """Density at ambient pressure, kg/m³, falling by 0.605 kg/m³ each K, (5.59).

    The source prints the slope in N s/mm²; N s²/mm⁴ is meant.
    """
    return reference - 0.605 * (np.asarray(temperature, float) - reference_temperature)


def compressed_density(ambient: ArrayLike, pressure: ArrayLike) -> Array:
    """Density under pressure after Dowson and Higginson, kg/m³."""
    p = np.asarray(pressure, float)
    return np.asarray(ambient, float) * (1 + _SQUEEZED * p / (1 + _STIFFENED * p))


def bulk_modulus(pressure: ArrayLike) -> Array:
    """Bulk modulus ρ dp/dρ of that compression, Pa; 1.67 GPa at ambient pressure."""
    p = np.asarray(pressure, float)
    return np.asarray((1 + _STIFFENED * p) * (1 + (_SQUEEZED + _STIFFENED) * p) / _SQUEEZED)


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
    """
    if base not in GOLD:
        raise InputError(f"base: must be one of {', '.join(GOLD)}, got {base!r}")
    scale, power = GOLD[base]
    return np.asarray(scale * 1e-9 * (np.asarray(viscosity, float) * _MM2) ** power)


def printed_pressure_viscosity(viscosity_40: ArrayLike, temperature: ArrayLike) -> Array:
    """Pressure–viscosity coefficient as the source prints it, 1/Pa, (5.60).

    Twice what is usual for engine oils (3.6e-8 1/Pa for 65 mm²/s at 90 °C); kept to compare with.

    Parameters
    ----------
    viscosity_40 : array_like
        Kinematic viscosity at 40 °C, m²/s.
    temperature : array_like
        K.
    """
    t = np.asarray(temperature, float) - CELSIUS
    level = np.log10(np.asarray(viscosity_40, float) * _MM2)
    return np.asarray((2.08 + 1.375 * level - 0.015 * t + 5e-5 * t**2) * 1e-8)


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
        Cragoe's formula takes °C; the source prints it with K, which lowers k_th by 13 % or so.
    """
    if variant not in ("physics", "printed"):
        raise InputError(f"variant: must be 'physics' or 'printed', got {variant!r}")
    t = np.asarray(temperature, float) - (CELSIUS if variant == "physics" else 0.0)
    return np.asarray((0.1173 - 6.33e-5 * t) / (np.asarray(ambient_density, float) / 1e3))
