"""Laws of liquid lubricants with their derivatives, for the energy equation of a film.

Plain expressions over floats or arrays that compile as they stand, ``numba.njit(roelands_state)``.
Suffix ``_t`` is a derivative with respect to temperature (K), ``_p`` with respect to pressure (Pa).
The same laws without derivatives are in `loadflow.tribology.lubricant_laws`.

References
----------
Reynolds 1886 (exponential law); DIN 51563 (Ubbelohde–Walther); Barus 1893; Roelands 1966; Dowson &
Higginson 1966 (density under pressure); Gold et al. 2001 (pressure–viscosity); Cragoe 1929
(specific heat).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Value = float | NDArray[np.float64]

# Dowson and Higginson's compression of mineral oil, 1/Pa
SQUEEZED, STIFFENED = 0.6e-9, 1.7e-9
# Roelands: pressure of the pole of all isotherms (Pa) and ln of its viscosity (Pa s)
ROELANDS_PRESSURE, ROELANDS_LOG = 1.0 / 5.1e-9, -9.67
DENSITY_SLOPE = -0.605  # kg/(m³ K), (5.59) of von Hollen 2013
_LN10 = float(np.log(10.0))
_MM2 = 1e6  # m²/s in mm²/s
_OVERFLOW = 700.0  # of the exponential function


def exponential_state(
    temperature: Value, viscosity: float, steepness: float, reference: float
) -> tuple[Value, Value]:
    """Viscosity η_ref exp(-β (T - T_ref)) and its derivative, Pa s and Pa s/K [Reynolds 1886].

    Parameters
    ----------
    temperature : float or ndarray
        T, K.
    viscosity : float
        η_ref, Pa s.
    steepness : float
        β, 1/K.
    reference : float
        T_ref, K.

    Examples
    --------
    >>> eta, eta_t = exponential_state(333.15, 0.0277, 0.0341, 313.15)
    >>> round(float(eta), 6), round(float(eta_t), 7)
    (0.014005, -0.0004776)
    """
    eta = viscosity * np.exp(-steepness * (temperature - reference))
    return eta, -steepness * eta


def walther_state(temperature: Value, level: float, slope: float) -> tuple[Value, Value]:
    """Kinematic viscosity after Ubbelohde–Walther and its derivative, m²/s and m²/(s K).

    Parameters
    ----------
    temperature : float or ndarray
        T, K.
    level, slope : float
        a and m of log log(ν + 0.8) = a - m log T, ν in mm²/s, decimal logarithms.

    Examples
    --------
    >>> nu, nu_t = walther_state(343.15, 8.8974, 3.4)
    >>> round(float(nu) * 1e6, 3), round(float(nu_t) * 1e6, 4)
    (77.053, -3.3592)
    """
    log = _LN10 * 10.0 ** (level - slope * np.log10(temperature))  # ln(ν + 0.8)
    whole = np.exp(np.minimum(log, _OVERFLOW))
    return (whole - 0.8) / _MM2, -slope * log * whole / (_MM2 * temperature)


def gold_state(
    viscosity: Value, viscosity_t: Value, scale: float, power: float
) -> tuple[Value, Value]:
    """Pressure–viscosity coefficient α = s ν^t and dα/dT, 1/Pa and 1/(Pa K) [Gold et al. 2001].

    Parameters
    ----------
    viscosity, viscosity_t : float or ndarray
        Kinematic viscosity at ambient pressure, m²/s, and its derivative.
    scale, power : float
        s in 1e-9/Pa and t, for ν in mm²/s.

    Examples
    --------
    >>> alpha, alpha_t = gold_state(70e-6, -3e-6, 9.904, 0.139)
    >>> round(float(alpha) * 1e9, 3), round(float(alpha_t) * 1e9, 4)
    (17.876, -0.1065)
    """
    alpha = scale * 1e-9 * (viscosity * _MM2) ** power
    return alpha, power * alpha * viscosity_t / viscosity


def barus_state(
    viscosity: Value,
    viscosity_t: Value,
    coefficient: Value,
    coefficient_t: Value,
    pressure: Value,
) -> tuple[Value, Value, Value]:
    """Viscosity η₀ exp(α p), Pa s, and its derivatives by temperature and pressure [Barus 1893].

    Far too high above about 0.5 GPa; huge rather than infinite where it overflows.

    Parameters
    ----------
    viscosity, viscosity_t : float or ndarray
        η₀ at ambient pressure, Pa s, and dη₀/dT.
    coefficient, coefficient_t : float or ndarray
        α, 1/Pa, and dα/dT.
    pressure : float or ndarray
        p, Pa.

    Examples
    --------
    >>> eta, eta_t, eta_p = barus_state(0.1, -0.005, 2e-8, 0.0, 1e8)
    >>> round(float(eta), 5), round(float(eta_t), 5), round(float(eta_p * 1e8), 5)
    (0.73891, -0.03695, 1.47781)
    """
    thicker = np.exp(np.minimum(coefficient * pressure, _OVERFLOW))
    eta = viscosity * thicker
    return eta, (viscosity_t + viscosity * pressure * coefficient_t) * thicker, eta * coefficient


def roelands_state(
    viscosity: Value,
    viscosity_t: Value,
    coefficient: Value,
    coefficient_t: Value,
    pressure: Value,
) -> tuple[Value, Value, Value]:
    """Viscosity under pressure, Pa s, and its derivatives by temperature and pressure.

    Law of [Roelands 1966] with the slope of Barus at p = 0. Parameters as of `barus_state`;
    p > -196 MPa, where the isotherms meet.

    Examples
    --------
    >>> eta, eta_t, eta_p = roelands_state(0.1, -0.005, 2e-8, 0.0, 1e8)
    >>> round(float(eta), 5), round(float(eta_t), 5), round(float(eta_p * 1e8), 5)
    (0.60926, -0.02961, 1.0049)
    """
    above = np.log(viscosity) - ROELANDS_LOG
    above_t = viscosity_t / viscosity
    power = coefficient * ROELANDS_PRESSURE / above
    power_t = (coefficient_t * ROELANDS_PRESSURE - power * above_t) / above
    base = 1.0 + pressure / ROELANDS_PRESSURE
    lift = base**power
    eta = viscosity * np.exp(np.minimum(above * (lift - 1.0), _OVERFLOW))
    eta_t = eta * lift * (above_t + above * np.log(base) * power_t)
    return eta, eta_t, eta * coefficient * lift / base


def density_state(
    temperature: Value, pressure: Value, reference: float, reference_temperature: float
) -> tuple[Value, Value, Value]:
    """Density, kg/m³, and its derivatives by temperature and pressure.

    Falls by 0.605 kg/m³ each K; under pressure after [Dowson and Higginson 1966].

    Parameters
    ----------
    temperature, pressure : float or ndarray
        K and Pa.
    reference, reference_temperature : float
        Density at ambient pressure, kg/m³, at that temperature, K.

    Examples
    --------
    >>> rho, rho_t, rho_p = density_state(333.15, 1e8, 880.0, 288.15)
    >>> round(float(rho), 2), round(float(rho_t), 4), round(float(rho_p * 1e6), 4)
    (896.51, -0.636, 0.3738)
    """
    ambient = reference + DENSITY_SLOPE * (temperature - reference_temperature)
    stiff = 1.0 + STIFFENED * pressure
    squeezed = 1.0 + SQUEEZED * pressure / stiff
    return ambient * squeezed, DENSITY_SLOPE * squeezed, ambient * SQUEEZED / (stiff * stiff)


def specific_heat_state(temperature: Value, density_15: float) -> tuple[Value, Value]:
    """Specific heat of mineral oils, J/(kg K), and its derivative [Cragoe 1929].

    c = (1685 + 3.4 ϑ)/√s, ϑ in °C and s the density at 15 °C over that of water.

    Parameters
    ----------
    temperature : float or ndarray
        K.
    density_15 : float
        Density at 15 °C, kg/m³.

    Examples
    --------
    >>> c, c_t = specific_heat_state(313.15, 860.0)
    >>> round(float(c), 1), round(float(c_t), 3)
    (1963.6, 3.666)
    """
    root = (density_15 / 1e3) ** 0.5
    return (1685.0 + 3.4 * (temperature - 273.15)) / root, 3.4 / root + 0.0 * temperature
