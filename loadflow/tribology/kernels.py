"""Compiled scalar laws of rough surfaces, each with its derivative, for the loops of film solvers.

Every kernel takes the film parameter H = h/σ and returns a value and its derivative with respect
to H. They accept any H, also H ≤ 0 where the mean planes overlap, so that a Newton iteration may
pass there. `flow_rows` turns a Peklenik number into the coefficients that the flow factors take.
The array functions are in `loadflow.tribology.flow_factors` and `loadflow.tribology.asperities`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.linked import LINKED, njit
from loadflow.tribology._contact_integral import HIGHEST, LOWEST, PER_UNIT, polynomials
from loadflow.tribology._flow_coefficients import COEFFICIENTS, PATTERNS

Array = NDArray[np.float64]
Pair = tuple[float, float]

_TABLE = np.array(COEFFICIENTS)
_LOG_PATTERNS = np.log(np.array(PATTERNS))
_INTEGRAL = polynomials()
_COLUMNS = _TABLE.shape[1]
_SHEAR_CHANGE, _SHEAR_BLEND = 5.0, 0.25  # H where Φ_s changes its law; half width of the blend
_SHEAR_END, _SHEAR_FADE = 7.0, 1.0  # H where Φ_fs ends; width over which it fades to 0
_CUT_OFF = 1.0 / 300.0  # least gap that shears, over 3σ
_ROOT_2PI = math.sqrt(2 * math.pi)


@njit(cache=True, nogil=True)
def flow_rows(pattern: float) -> Array:
    """Coefficients of the two tabulated Peklenik numbers beside `pattern`, with their weights.

    Parameters
    ----------
    pattern : float
        Peklenik number γ > 0; held at the ends of the table, 1/9 … 9.

    Returns
    -------
    ndarray
        Shape (2, 16): weight, then the coefficients of `COEFFICIENTS`. The weights are linear in
        ln γ.
    """
    last = _LOG_PATTERNS.size - 1
    log = min(max(math.log(pattern), _LOG_PATTERNS[0]), _LOG_PATTERNS[last])
    i = 0
    while i < last - 1 and log >= _LOG_PATTERNS[i + 1]:
        i += 1
    share = (log - _LOG_PATTERNS[i]) / (_LOG_PATTERNS[i + 1] - _LOG_PATTERNS[i])
    rows = np.empty((2, 1 + _COLUMNS))
    rows[:, 1:] = _TABLE[i : i + 2]
    rows[0, 0], rows[1, 0] = 1.0 - share, share
    return rows


@njit(cache=True, nogil=True)
def pressure_factor(film_parameter: float, rows: Array) -> Pair:
    """Pressure flow factor φ_x and dφ_x/dH; with the rows of 1/γ it is φ_z.

    Below its printed range (H = 1 for γ < 1, 0.5 else) each row holds its value.
    """
    value = slope = 0.0
    for row in rows:
        weight, sign, lowest, c, r = row[0], row[1], row[2], row[3], row[4]
        if weight == 0.0:
            continue
        held = film_parameter <= lowest
        at = lowest if held else film_parameter
        if sign < 0:
            part = c * math.exp(-r * at)
            value += weight * (1.0 - part)
            rise = r * part
        else:
            part = c * at**-r
            value += weight * (1.0 + part)
            rise = -r * part / at
        if not held:
            slope += weight * rise
    return value, slope


@njit(cache=True, nogil=True)
def shear_factor(film_parameter: float, rows: Array, smooth: bool = False) -> Pair:
    """Shear flow factor Φ_s of one surface and dΦ_s/dH; 0 for H ≤ 0.

    Parameters
    ----------
    film_parameter : float
        H.
    rows : ndarray
        `flow_rows`.
    smooth : bool
        Blend the two printed laws, which differ by up to 2e-4 at H = 5, over 4.75 … 5.25.
    """
    value = slope = 0.0
    if film_parameter <= 0.0:
        return value, slope
    width = _SHEAR_BLEND if smooth else 0.0
    share, share_slope = _share(film_parameter, _SHEAR_CHANGE, width)
    for row in rows:
        weight = row[0]
        if weight == 0.0:
            continue
        if share < 1.0:
            low, low_slope = _power_exponential(film_parameter, row[5], row[6], row[7], row[8])
            value += weight * (1.0 - share) * low
            slope += weight * ((1.0 - share) * low_slope - share_slope * low)
        if share > 0.0:
            high = row[9] * math.exp(-0.25 * film_parameter)
            value += weight * share * high
            slope += weight * (share_slope - 0.25 * share) * high
    return value, slope


@njit(cache=True, nogil=True)
def friction_shear_factor(film_parameter: float, rows: Array, smooth: bool = False) -> Pair:
    """Factor Φ_fs of the mean shear stress and dΦ_fs/dH; 0 for H ≤ 0.

    Parameters
    ----------
    film_parameter : float
        H.
    rows : ndarray
        `flow_rows`.
    smooth : bool
        Printed, Φ_fs jumps at H = 7 by 0.004 … 0.023 to 0; smooth, it fades to 0 over 6 … 7.
    """
    value = slope = 0.0
    if film_parameter <= 0.0 or film_parameter >= _SHEAR_END:
        return value, slope
    gone, gone_slope = 0.0, 0.0
    if smooth:
        gone, gone_slope = _share(film_parameter, _SHEAR_END - _SHEAR_FADE / 2, _SHEAR_FADE / 2)
    for row in rows:
        weight = row[0]
        if weight != 0.0:
            part, rise = _power_exponential(film_parameter, row[10], row[11], row[12], row[13])
            value += weight * (1.0 - gone) * part
            slope += weight * ((1.0 - gone) * rise - gone_slope * part)
    return value, slope


@njit(cache=True, nogil=True)
def friction_pressure_factor(film_parameter: float, rows: Array) -> Pair:
    """Factor φ_fp of the shear by the pressure's slope, and dφ_fp/dH; held like φ_x."""
    value = slope = 0.0
    for row in rows:
        weight, lowest = row[0], row[2]
        held = film_parameter <= lowest
        part = row[14] * math.exp(-row[15] * (lowest if held else film_parameter))
        value += weight * (1.0 - part)
        if not held:
            slope += weight * row[15] * part
    return value, slope


@njit(cache=True, nogil=True)
def friction_factor(film_parameter: float) -> Pair:
    """Factor φ_f of the mean shear stress of the film, h⟨1/h_T⟩, and dφ_f/dH; 0 for H ≤ 0."""
    if film_parameter <= 0.0:
        return 0.0, 0.0
    if film_parameter > 6.0:
        return _friction_series(film_parameter)
    inverse, rise = inverse_gap(film_parameter)
    return film_parameter * inverse, inverse + film_parameter * rise


@njit(cache=True, nogil=True)
def inverse_gap(film_parameter: float) -> Pair:
    """Mean σ⟨1/h_T⟩ of the inverse gap and its derivative: φ_f = H σ⟨1/h_T⟩.

    Stress of the film: τ = (η U/σ) σ⟨1/h_T⟩. Unlike φ_f/H it has a limit at H = 0, and continues
    to H = -3, where the gap has closed everywhere. Heights have the density
    (35/96)(1 - (δ/3σ)²)³/σ of Patir and Cheng, gaps below σ/100 do not shear.
    """
    z = film_parameter / 3.0
    if z <= -1.0:
        return 0.0, 0.0
    if z > 2.0:
        factor, rise = _friction_series(film_parameter)
        return factor / film_parameter, (rise - factor / film_parameter) / film_parameter
    s = z * z
    well = 1.0 - s
    if z <= 1.0:
        log = math.log((1.0 + z) / _CUT_OFF)
        sum_ = -55.0 + z * (132.0 + z * (345.0 + z * (-160.0 + z * (-405.0 + z * (60 + 147 * z)))))
        slope = 132.0 + z * (690.0 + z * (-480.0 + z * (-1620.0 + z * (300.0 + 882.0 * z))))
        value = well**3 * log + sum_ / 60.0
        rise = -6.0 * z * well**2 * log + (1.0 - z) * well**2 + slope / 60.0
    else:
        log = math.log((z + 1.0) / (z - 1.0))
        value = well**3 * log + z / 15.0 * (66.0 + s * (30.0 * s - 80.0))
        rise = (2.0 - 6.0 * z * log) * well**2 + (66.0 + s * (150.0 * s - 240.0)) / 15.0
    if value <= 0.0:  # within the cut-off of H = -3
        return 0.0, 0.0
    return 35.0 / 96.0 * value, 35.0 / 288.0 * rise


@njit(nogil=True, **LINKED)
def _friction_series(film_parameter: float) -> Pair:
    """Moments of the heights for H > 6, where the closed form loses digits: φ_f and slope."""
    inverse_square = (3.0 / film_parameter) ** 2
    term, value, slope = 1.0, 1.0, 0.0
    for k in range(1, 20):
        term *= inverse_square * (k - 0.5) / (k + 3.5)
        value += term
        slope -= 2 * k * term
    return value, slope / film_parameter


@njit(cache=True, nogil=True)
def mean_gap(film_parameter: float) -> Pair:
    """Mean gap ⟨h_T⟩/σ of Gaussian heights that are cut where they touch, and its derivative.

    The derivative, ½(1 + erf(H/√2)), is the contact factor of [Wu and Zheng 1989].
    """
    open_share = 0.5 * math.erfc(-film_parameter / math.sqrt(2.0))
    bell = math.exp(-0.5 * film_parameter * film_parameter) / _ROOT_2PI
    return max(film_parameter * open_share + bell, 0.0), open_share


@njit(cache=True, nogil=True)
def pressure_integral(film_parameter: float) -> Pair:
    """Integral F_5/2 of Greenwood and Tripp and its derivative -5/2 F_3/2, within 2e-10.

    Piecewise polynomials of ln F + H²/2 for -10 … 38.5; 0 above, where F underflows.
    """
    u = film_parameter
    if u >= HIGHEST:
        return 0.0, 0.0
    if u <= LOWEST:  # moments of all heights, none of which is below the other surface
        s = 1.0 / (u * u)
        root = math.sqrt(-u)
        total = 1 + s * (1.875 - s * (0.1171875 + s * (0.0732421875 + s * 0.14419555664)))
        rise = 2.5 + s * (0.9375 + s * (0.17578125 + s * (0.25634765625 + s * 0.79307556152)))
        return u * u * root * total, u * root * rise
    x = (u - LOWEST) * PER_UNIT
    i = int(x)
    t = x - i
    c = _INTEGRAL[i]
    log = c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5]))))
    rise = c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5])))
    value = math.exp(log - 0.5 * u * u)
    return value, value * (rise * PER_UNIT - u)


@njit(cache=True, nogil=True)
def area_integral(film_parameter: float) -> Pair:
    """Integral F_2 of Greenwood and Tripp and its derivative -2 F_1, in closed form.

    Its terms cancel: within 1e-9 up to H = 16, where F_2 is 1e-60.
    """
    u = film_parameter
    above = 0.5 * math.erfc(u / math.sqrt(2.0))
    bell = math.exp(-0.5 * u * u) / _ROOT_2PI
    return max((1.0 + u * u) * above - u * bell, 0.0), min(2.0 * (u * above - bell), 0.0)


@njit(nogil=True, **LINKED)
def _power_exponential(at: float, scale: float, power: float, fall: float, square: float) -> Pair:
    """A H^a exp(-b H + c H²) and its derivative."""
    value = scale * at**power * math.exp(at * (square * at - fall))
    return value, value * (power / at - fall + 2.0 * square * at)


@njit(nogil=True, **LINKED)
def _share(at: float, centre: float, half: float) -> Pair:
    """Share of the law above `centre`, 0 to 1 with two continuous derivatives, and its slope."""
    if at <= centre - half:
        return 0.0, 0.0
    if at >= centre + half:
        return 1.0, 0.0
    t = 0.5 * (at - centre + half) / half
    return t**3 * (10.0 + t * (6.0 * t - 15.0)), 15.0 / half * (t * (1.0 - t)) ** 2


@njit(cache=True, nogil=True)
def flow_factor_table(film_parameter: Array, pattern: Array, smooth: bool) -> Array:
    """All factors of `flow_factors.patir_cheng` at n points: values and slopes, shape (2, 6, n)."""
    table = np.empty((2, 6, film_parameter.size))
    along = across = np.empty((0, 0))
    last = 0.0
    for i in range(film_parameter.size):
        h, gamma = film_parameter[i], pattern[i]
        if gamma != last:
            along, across, last = flow_rows(gamma), flow_rows(1.0 / gamma), gamma
        table[0, 0, i], table[1, 0, i] = pressure_factor(h, along)
        table[0, 1, i], table[1, 1, i] = pressure_factor(h, across)
        table[0, 2, i], table[1, 2, i] = shear_factor(h, along, smooth)
        table[0, 3, i], table[1, 3, i] = friction_factor(h)
        table[0, 4, i], table[1, 4, i] = friction_shear_factor(h, along, smooth)
        table[0, 5, i], table[1, 5, i] = friction_pressure_factor(h, along)
    return table


@njit(cache=True, nogil=True)
def mean_gap_table(film_parameter: Array) -> Array:
    """`mean_gap` at n points: values and slopes, shape (2, n)."""
    table = np.empty((2, film_parameter.size))
    for i in range(film_parameter.size):
        table[0, i], table[1, i] = mean_gap(film_parameter[i])
    return table


@njit(cache=True, nogil=True)
def contact_table(film_parameter: Array) -> Array:
    """Integrals of pressure and area at n points, values and slopes: F_5/2, F_5/2', F_2, F_2'."""
    table = np.empty((4, film_parameter.size))
    for i in range(film_parameter.size):
        table[0, i], table[1, i] = pressure_integral(film_parameter[i])
        table[2, i], table[3, i] = area_integral(film_parameter[i])
    return table
