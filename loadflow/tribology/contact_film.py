"""Film thickness in rolling contacts: power laws, all regimes in one formula, corrections.

Dimensionless groups after Dowson and Higginson, with the reduced modulus E₀ = 2 E* (twice
`loadflow.tribology.hertz.effective_modulus`) and the mean surface speed u:

    G = α E₀,   U = η₀ u/(E₀ R),   W = Q/(E₀ R l) for lines, Q/(E₀ R²) for points

Formulas return the film over the radius R in the direction of rolling. They are plain expressions
that take floats or arrays and can be compiled as they are, ``numba.njit(moes_line_exponent)``.
Equation numbers are those of von Hollen 2013.

References
----------
Hamrock, Schmid, Jacobson: Fundamentals of Fluid Film Lubrication. Moes: Lubrication and Beyond,
Twente 2000. Nijenbanning, Venner, Moes: Wear 176 (1994) 217. Zhu, Cheng 1989, after Zhou, Hoeprich:
J. Tribology 113 (1991) 590. Hamrock, Dowson: J. Lubrication Technology, 1977.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.fields import check_one_of

Value = float | NDArray[np.float64]


@dataclass(frozen=True)
class PowerLaw:
    """One row of Table 5.2: h/R = e₀ G^e₁ U^e₂ W^-e₃, (5.85)."""

    contact: Literal["point", "line"]
    coefficient: float
    material: float
    speed: float
    load: float

    def __call__(self, material: Value, speed: Value, load: Value) -> Value:
        """Film over radius."""
        film = self.coefficient * material**self.material * speed**self.speed
        return film * load**-self.load


POWER_LAWS = {
    "archard": PowerLaw("point", 1.40, 0.74, 0.74, 0.074),
    "cameron": PowerLaw("point", 5.81, 1.00, 1.00, 0.33),
    "cheng": PowerLaw("point", 2.21, 0.725, 0.725, 0.058),
    "hamrock-dowson": PowerLaw("point", 1.90, 0.53, 0.67, 0.067),
    "ertel-grubin": PowerLaw("line", 1.95, 0.73, 0.73, 0.091),
    "dowson-toyoda": PowerLaw("line", 3.06, 0.56, 0.69, 0.10),
    "dowson-higginson": PowerLaw("line", 1.60, 0.60, 0.70, 0.13),
    "crook": PowerLaw("line", 2.14, 0.75, 0.75, 0.125),
    # (5.90); von Hollen prints the exponent 0.629 of U for 0.692: films 4.8 times too thick
    "hamrock": PowerLaw("line", 2.922, 0.470, 0.692, 0.166),
    "hamrock-printed": PowerLaw("line", 2.922, 0.470, 0.629, 0.166),
}

HEAT_POWER = 0.548
"""Of the thermal loading in what heat of the inlet takes from a film, (5.92)."""

# logarithms of the factors of Moes' four regimes of a line
_RIGID, _SOFT = math.log(3.0), math.log(2.621)
_RIGID_THICK, _SOFT_THICK = math.log(1.287), math.log(1.311)
_LEAST_LOAD = 1e-14  # of W: below it a contact carries nothing and its film only need be wide


def film_ratio(law: str, material: Value, speed: Value, load: Value) -> Value:
    """Film over radius after a law named in `POWER_LAWS`, or ``"moes"`` for a line in any regime.

    Parameters
    ----------
    law : str
        Name of the law.
    material, speed, load : float or ndarray
        G, U, W.

    Returns
    -------
    float or ndarray
        h/R.

    Raises
    ------
    InputError
        If the law is unknown.

    Examples
    --------
    >>> round(float(film_ratio("hamrock", 4615.38, 1.56329e-11, 6.28806e-5)) * 4.5e-3 * 1e6, 4)
    0.115
    """
    if law == "moes":
        return moes_line(material, speed, load)
    check_one_of("law", law, (*POWER_LAWS, "moes"))
    return POWER_LAWS[law](material, speed, np.maximum(load, _LEAST_LOAD))


def moes_line(material: Value, speed: Value, load: Value) -> Value:
    """Central film over radius of a line contact in all regimes (Moes).

    Blends rigid-isoviscous (3/M, Martin), rigid-piezoviscous (1.287 L^2/3, Blok),
    elastic-isoviscous (2.621 M^-1/5, Herrebrugh) and elastic-piezoviscous films. A contact without
    load gets a film of thousands of radii.

    Parameters
    ----------
    material, speed, load : float or ndarray
        G, U, W.

    Returns
    -------
    float or ndarray
        h/R.

    Examples
    --------
    >>> round(float(moes_line(4615.38, 1.56329e-11, 6.28806e-5)) * 4.5e-3 * 1e6, 4)  # μm
    0.1431
    """
    return moes_line_exponent(material, speed, load)[0]


def moes_line_exponent(material: Value, speed: Value, load: Value) -> tuple[Value, Value]:
    """`moes_line`, and the exponent d log(film)/d log(speed) with which it grows with the speed.

    Parameters
    ----------
    material, speed, load : float or ndarray
        G, U, W.

    Examples
    --------
    >>> film, exponent = moes_line_exponent(4615.38, 1.56329e-11, 6.28806e-5)
    >>> faster = moes_line(4615.38, 1.001 * 1.56329e-11, 6.28806e-5)
    >>> round(float(exponent), 3), round(float(np.log(faster / film) / np.log(1.001)), 3)
    (0.696, 0.696)
    """
    # all in logarithms: an exponential takes a fraction of the time of a power
    total = np.log(2.0 * speed)  # Moes takes the sum of both surface speeds
    m = np.log(np.maximum(load, _LEAST_LOAD)) - 0.5 * total
    el = np.log(material) + 0.25 * total
    rigid, soft = _RIGID - m, _SOFT - 0.2 * m
    rigid_thick, soft_thick = _RIGID_THICK + 2.0 / 3.0 * el, _SOFT_THICK - 0.125 * m + 0.75 * el
    share = np.exp(soft - rigid)
    fade = 8.0 * np.exp(-2.0 * share)
    s = (7.0 + fade) / 5.0
    # (x^p + y^p)^(1/p) = x (1 + (y/x)^p)^(1/p)
    rigid_part = np.exp(-7.0 / 3.0 * (soft - rigid))
    thin = soft + 3.0 / 7.0 * np.log(1.0 + rigid_part)
    soft_part = np.exp(3.5 * (soft_thick - rigid_thick))
    thick = soft_thick - 2.0 / 7.0 * np.log(1.0 + soft_part)
    thick_part = np.exp(s * (thick - thin))
    blend = np.log(1.0 + thick_part)
    film = np.exp(thin + blend / s + 0.5 * total)
    # of the logarithms over log U: M falls with 1/2, L grows with 1/4
    grows_s = 0.4 * 2.0 / 5.0 * fade * share
    grows_thin = 0.1 + 0.4 * rigid_part / (1.0 + rigid_part)
    grows_thick = 0.25 - (0.25 - 1.0 / 6.0) * soft_part / (1.0 + soft_part)
    grows_part = s * (grows_thick - grows_thin) + grows_s * (thick - thin)
    grows = thick_part / (1.0 + thick_part) * grows_part / s - blend * grows_s / (s * s)
    return film, 0.5 + grows_thin + grows


def nijenbanning_point(material: Value, speed: Value, load: Value, radius_ratio: Value) -> Value:
    """Central film over radius R_x of an elliptical contact in all regimes (Nijenbanning).

    Parameters
    ----------
    material, speed, load : float or ndarray
        G, U, W of points, with R = R_x along the rolling direction.
    radius_ratio : float or ndarray
        R_x/R_y of the reduced radii, at most 1.

    Returns
    -------
    float or ndarray
        h/R_x.

    Examples
    --------
    >>> film = nijenbanning_point(5227.0, 2.154e-10, 7.63e-4, 0.03) * 5.1093e-3
    >>> round(float(film) * 1e6, 3)
    0.917
    """
    d, total = radius_ratio, 2.0 * speed
    m = np.maximum(load, _LEAST_LOAD) * total**-0.75
    el = material * total**0.25
    width = 1.0 + 0.006 * np.log(d) + 0.63 * d ** (4.0 / 7.0)
    rigid = 145.0 * (1.0 + 0.796 * d ** (14.0 / 15.0)) ** (-15.0 / 7.0) / d / m**2
    soft = 3.18 * width ** (-14.0 / 25.0) * d ** (-1.0 / 15.0) * m ** (-2.0 / 15.0)
    rigid_thick = 1.29 * (1.0 + 0.691 * d) ** (-2.0 / 3.0) * el ** (2.0 / 3.0)
    soft_thick = 1.48 * width ** (-7.0 / 20.0) * d ** (-1.0 / 24.0) * m ** (-1.0 / 12.0) * el**0.75
    s = 1.5 * (1.0 + np.exp(-1.2 * soft / rigid))
    widest = 1.8 / d
    thin = (rigid**1.5 + (soft**-4.0 + widest**-4.0) ** -0.375) ** (2.0 * s / 3.0)
    thick = (rigid_thick**-8.0 + soft_thick**-8.0) ** (-s / 8.0)
    return (thin + thick) ** (1.0 / s) * np.sqrt(total)


def hamrock_dowson_central(material: Value, speed: Value, load: Value, ellipticity: Value) -> Value:
    """Central film over radius R_x of an elliptical contact; `ellipticity` k = a/b across rolling.

    For k = 1 the row Hamrock/Dowson of Table 5.2: 2.69 (1 - 0.61 exp(-0.73)) = 1.90.

    Parameters
    ----------
    material, speed, load : float or ndarray
        G, U, W of points, with R = R_x along the rolling direction.
    ellipticity : float or ndarray
        k = a/b, of the semi-axes across and along rolling.

    Returns
    -------
    float or ndarray
        h/R_x.

    Examples
    --------
    >>> film = hamrock_dowson_central(5227.0, 2.154e-10, 7.63e-4, 9.285) * 5.1093e-3
    >>> round(float(film) * 1e6, 3)
    0.693
    """
    side = 1.0 - 0.61 * np.exp(-0.73 * ellipticity)
    return 2.69 * speed**0.67 * material**0.53 * load**-0.067 * side


def hamrock_dowson_minimum(material: Value, speed: Value, load: Value, ellipticity: Value) -> Value:
    """Smallest film over radius R_x of an elliptical contact.

    Parameters
    ----------
    material, speed, load, ellipticity : float or ndarray
        As `hamrock_dowson_central`.

    Returns
    -------
    float or ndarray
        h/R_x.

    Examples
    --------
    >>> film = hamrock_dowson_minimum(5227.0, 2.154e-10, 7.63e-4, 9.285) * 5.1093e-3
    >>> round(float(film) * 1e6, 3)
    0.554
    """
    side = 1.0 - np.exp(-0.68 * ellipticity)
    return 3.63 * speed**0.68 * material**0.49 * load**-0.073 * side


def thermal_loading(viscosity: Value, steepness: Value, speed: Value, conductivity: Value) -> Value:
    """Thermal loading L_th = η₀ β_th u²/k_th of the inlet, (5.93).

    Parameters
    ----------
    viscosity : float or ndarray
        At ambient pressure and the temperature of the surface at the inlet, Pa s.
    steepness : float or ndarray
        β_th, 1/K.
    speed : float or ndarray
        Mean surface speed, m/s.
    conductivity : float or ndarray
        W/(m K).

    Returns
    -------
    float or ndarray
        L_th.

    Examples
    --------
    >>> round(thermal_loading(0.0106, 0.0278, 1.53, 0.139), 5)
    0.00496
    """
    return viscosity * steepness * speed * speed / conductivity


def thermal_factor(loading: Value) -> Value:
    """Share of the film that inlet shear heating leaves, C_th = 1/(1 + 0.39 L^0.548), (5.92).

    Parameters
    ----------
    loading : float or ndarray
        `thermal_loading`.

    Returns
    -------
    float or ndarray
        0 … 1.

    Examples
    --------
    >>> round(thermal_factor(0.1), 4)
    0.9006
    """
    return 1.0 / (1.0 + 0.39 * loading**HEAT_POWER)


def zhu_cheng_factor(loading: Value, pressure_ratio: Value, slide_ratio: Value = 0.0) -> Value:
    """Thermal reduction with pressure and sliding, as Zhou and Hoeprich take it.

    Parameters
    ----------
    loading : float or ndarray
        `thermal_loading`.
    pressure_ratio : float or ndarray
        Largest Hertzian pressure over reduced modulus E₀.
    slide_ratio : float or ndarray
        Sliding over mean surface speed.

    Returns
    -------
    float or ndarray
        0 … 1.

    Examples
    --------
    >>> round(zhu_cheng_factor(0.1, 0.005, 0.1), 4)
    0.9155
    """
    less = 1.0 - 13.2 * pressure_ratio * loading**0.42
    return less / (1.0 + 0.213 * (1.0 + 2.23 * slide_ratio**0.83) * loading**0.64)


def starvation_factor(inlet: Value, half_width: Value, radius: Value, film: Value) -> Value:
    """Share of the flooded film that a starved inlet gives (Hamrock and Dowson 1977).

    Parameters
    ----------
    inlet : float or ndarray
        Distance of the inlet meniscus from the middle of the contact, m.
    half_width : float or ndarray
        Half width of the Hertzian contact along rolling, m.
    radius : float or ndarray
        Reduced radius along rolling, m.
    film : float or ndarray
        Flooded central film, m.

    Returns
    -------
    float or ndarray
        0 … 1.

    Examples
    --------
    >>> round(float(starvation_factor(2e-4, 1e-4, 5e-3, 0.5e-6)), 4)
    0.9129
    """
    reach = 3.06 * ((radius / half_width) ** 2 * film / radius) ** 0.58
    filled = np.minimum(np.maximum(inlet / half_width - 1.0, 0.0) / reach, 1.0)
    return filled**0.29
