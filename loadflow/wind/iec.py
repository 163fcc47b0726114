"""Wind conditions of IEC 61400-1 (edition 3: 2005 with A1:2010; edition 4: 2019) as plain formulas.

All functions take the wind speed at hub height as a number or an array (m/s) and return the same
shape; angles are in radians. The classes are ``"I"``, ``"II"``, ``"III"``, their tropical
variants of edition 4 (``"I-T"``, …; ``"T"`` alone means ``"I-T"``), or a `WindClass` of the
designer (class S). The turbulence categories are ``"A+"`` (edition 4), ``"A"``, ``"B"``, ``"C"``,
or, for class S, the reference turbulence intensity itself as a number.

Clause and equation numbers are those of edition 3. Where [Jonuschies 2015] prints the same formula
its number is given; its (2.8) prints 1.5 where the standard has 1.35, and the standard is used.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import gamma
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError

Floats = NDArray[np.float64]

#: Reference turbulence intensity at 15 m/s of each category (A+ since edition 4).
REFERENCE_INTENSITY = {"A+": 0.18, "A": 0.16, "B": 0.14, "C": 0.12}
#: Standard deviations of (u, v, w) as shares of σ1 (Annex B, Kaimal).
COMPONENT_SIGMA = (1.0, 0.8, 0.5)
#: Kaimal integral length scales of (u, v, w) as multiples of Λ1 (Annex B).
COMPONENT_LENGTH = (8.1, 2.7, 0.66)
#: Rise of wind speed in the extreme coherent gust with direction change, m/s (2.13).
COHERENT_GUST = 15.0


@dataclass(frozen=True)
class WindClass:
    """Wind speeds that define a class; make your own for class S.

    Attributes
    ----------
    name : str
        Name of the class.
    v_ref : float
        Reference speed, the 10-min mean at hub height with a return period of 50 years, m/s.
    v_ave : float
        Annual mean speed at hub height, m/s.
    """

    name: str
    v_ref: float
    v_ave: float

    def __post_init__(self) -> None:
        for field in ("v_ref", "v_ave"):
            value = getattr(self, field)
            if not 0 < value < np.inf:
                raise InputError(f"wind class {self.name!r}: {field} = {value} m/s, must be > 0")


CLASSES = {
    c.name: c
    for c in (
        WindClass("I", 50.0, 10.0),
        WindClass("II", 42.5, 8.5),
        WindClass("III", 37.5, 7.5),
        # edition 4: V_ref,T = 57 m/s in every class, the annual mean stays that of the class
        WindClass("I-T", 57.0, 10.0),
        WindClass("II-T", 57.0, 8.5),
        WindClass("III-T", 57.0, 7.5),
        WindClass("T", 57.0, 10.0),
    )
}


def class_speeds(name: str | WindClass) -> WindClass:
    """Class by its name; a `WindClass` (class S) passes through.

    Raises
    ------
    InputError
        If the class is unknown, or is ``"S"``, whose speeds only the designer knows.
    """
    if isinstance(name, WindClass):
        return name
    if name == "S":
        raise InputError(
            "wind class 'S' has no speeds of its own: give a WindClass(name, v_ref, v_ave)"
        )
    if name not in CLASSES:
        raise InputError(
            f"wind class {name!r} is unknown; known: {', '.join(CLASSES)}, or a WindClass"
        )
    return CLASSES[name]


def reference_intensity(category: str | float) -> float:
    """Reference turbulence intensity I_ref of a category; a number (class S) passes through.

    Raises
    ------
    InputError
        If the category is unknown or the number is outside (0, 1).
    """
    if isinstance(category, str):
        if category not in REFERENCE_INTENSITY:
            known = ", ".join(REFERENCE_INTENSITY)
            raise InputError(
                f"turbulence category {category!r} is unknown; known: {known}, or I_ref"
            )
        return REFERENCE_INTENSITY[category]
    if not isinstance(category, Real) or not 0 < category < 1:
        raise InputError(
            f"turbulence category {category!r} is unknown; known: "
            f"{', '.join(REFERENCE_INTENSITY)}, or the reference intensity I_ref in (0, 1)"
        )
    return float(category)


def _speed(v: ArrayLike, name: str = "wind speed") -> Floats:
    speed = np.asarray(v, dtype=float)
    bad = ~(np.isfinite(speed) & (speed >= 0))
    if np.any(bad):
        raise InputError(f"{name} = {speed[bad].flat[0]} m/s must be finite and not negative")
    return speed


def _positive(**lengths: float) -> None:
    for name, value in lengths.items():
        if not 0 < value < np.inf:
            raise InputError(f"{name} = {value} m must be > 0 and finite")


def length_scale(hub_height: float) -> float:
    """Longitudinal turbulence scale Λ1 in m: 0.7 z up to 60 m, 42 m above (eq. 5)."""
    _positive(hub_height=hub_height)
    return 0.7 * min(hub_height, 60.0)


# -- how often a wind speed occurs ------------------------------------------------------------


def weibull_cdf(v: ArrayLike, v_ave: float, shape: float = 2.0) -> Floats:
    """Share of time with a 10-min mean speed below `v` (2.2); shape 2 is the Rayleigh distribution.

    Parameters
    ----------
    v : array_like
        Wind speed at hub height, m/s.
    v_ave : float
        Annual mean, m/s.
    shape : float
        Weibull shape k; the scale C = v_ave/Γ(1 + 1/k) follows from the mean.
    """
    if not (0 < v_ave < np.inf and 0 < shape < np.inf):
        raise InputError(f"v_ave = {v_ave} m/s and shape = {shape} must both be > 0")
    scale = v_ave / gamma(1 + 1 / shape)
    return -np.expm1(-((_speed(v) / scale) ** shape))


def bin_probability(v: ArrayLike, v_ave: float, width: float = 2.0, shape: float = 2.0) -> Floats:
    """Share of time in the bins of `width` m/s centred at `v` (the bin ends at zero from below)."""
    v = _speed(v)
    if not 0 < width < np.inf:
        raise InputError(f"bin width = {width} m/s must be > 0")
    upper = weibull_cdf(v + width / 2, v_ave, shape)
    return upper - weibull_cdf(np.maximum(v - width / 2, 0), v_ave, shape)


# -- mean wind --------------------------------------------------------------------------------


def nwp(z: ArrayLike, v_hub: float, hub_height: float, exponent: float = 0.2) -> Floats:
    """Normal wind profile: mean speed in m/s at heights `z` in m, zero at the ground (2.4)."""
    _positive(hub_height=hub_height)
    return _speed(v_hub) * (_height(z) / hub_height) ** exponent


def ewm_speed(
    z: ArrayLike,
    wind_class: str | WindClass,
    hub_height: float,
    return_period: int = 50,
    steady: bool = True,
) -> Floats:
    """Extreme wind speed at heights `z`, m/s (2.6, 2.7).

    Parameters
    ----------
    z : array_like
        Heights, m.
    wind_class : str or WindClass
        Class.
    hub_height : float
        Hub height, m.
    return_period : {50, 1}
        Years; the 1-year speed is 0.8 times the 50-year speed.
    steady : bool
        3-s gust of the steady model (1.4 V_ref at the hub) or 10-min mean of the turbulent model
        (V_ref at the hub; use it with `ewm_sigma`).
    """
    _positive(hub_height=hub_height)
    if return_period not in (1, 50):
        raise InputError(f"return_period = {return_period} years must be 1 or 50")
    factor = (1.4 if steady else 1.0) * (1.0 if return_period == 50 else 0.8)
    return factor * class_speeds(wind_class).v_ref * (_height(z) / hub_height) ** 0.11


def _height(z: ArrayLike) -> Floats:
    heights = np.asarray(z, dtype=float)
    if np.any(~(heights >= 0)):
        raise InputError(f"height {heights[~(heights >= 0)].flat[0]} m must not be negative")
    return heights


# -- standard deviation of turbulence -----------------------------------------------------------


def ntm_sigma(v: ArrayLike, category: str | float) -> Floats:
    """σ1 of the normal turbulence model, a 90 % quantile, m/s (2.5, eq. 11)."""
    return reference_intensity(category) * (0.75 * _speed(v) + 5.6)


def ntm_sigma_cdf(
    sigma: ArrayLike, v: ArrayLike, category: str | float, edition: int = 4
) -> Floats:
    """Probability that σ1 at the mean speed `v` is below `sigma`.

    Edition 4 has a Weibull distribution with shape 0.27 v + 1.4 and scale I_ref (0.75 v + 3.3);
    edition 3 (note to 6.3.1.3) a log-normal one with mean I_ref (0.75 v + 3.8) and standard
    deviation 1.4 I_ref (v in m/s).
    """
    sigma = _speed(sigma, "sigma")
    if _edition(edition) == 4:
        shape, scale = _sigma_weibull(_speed(v), category)
        return -np.expm1(-((sigma / scale) ** shape))
    from scipy.special import ndtr

    mean, width = _sigma_lognormal(_speed(v), category)
    with np.errstate(divide="ignore"):  # log(0) = -inf is the right limit: probability zero
        return ndtr((np.log(sigma) - mean) / width)


def ntm_sigma_quantile(
    probability: ArrayLike, v: ArrayLike, category: str | float, edition: int = 4
) -> Floats:
    """σ1 in m/s exceeded with 1 − `probability` at mean speed `v`; see `ntm_sigma_cdf`."""
    p = np.asarray(probability, dtype=float)
    if np.any(~((p >= 0) & (p < 1))):
        raise InputError("probability must be in [0, 1)")
    if _edition(edition) == 4:
        shape, scale = _sigma_weibull(_speed(v), category)
        return scale * (-np.log1p(-p)) ** (1 / shape)
    from scipy.special import ndtri

    mean, width = _sigma_lognormal(_speed(v), category)
    return np.exp(mean + width * ndtri(p))


def _edition(edition: int) -> int:
    if edition not in (3, 4):
        raise InputError(f"edition = {edition} must be 3 or 4")
    return edition


def _sigma_weibull(v: Floats, category: str | float) -> tuple[Floats, Floats]:
    return 0.27 * v + 1.4, reference_intensity(category) * (0.75 * v + 3.3)


def _sigma_lognormal(v: Floats, category: str | float) -> tuple[Floats, Floats]:
    intensity = reference_intensity(category)
    mean = intensity * (0.75 * v + 3.8)
    variance = np.log1p((1.4 * intensity / mean) ** 2)
    return np.log(mean) - variance / 2, np.sqrt(variance)


def etm_sigma(v: ArrayLike, wind_class: str | WindClass, category: str | float) -> Floats:
    """Standard deviation σ1 of the extreme turbulence model, m/s (2.10; eq. 19)."""
    c = 2.0
    slope = 0.072 * (class_speeds(wind_class).v_ave / c + 3)
    return c * reference_intensity(category) * (slope * (_speed(v) / c - 4) + 10)


def ewm_sigma(v: ArrayLike) -> Floats:
    """Standard deviation σ1 of the turbulent extreme wind speed model, m/s (eq. 16)."""
    return 0.11 * _speed(v)


# -- amplitudes of the transient conditions (their course over time: loadflow.wind.gusts) -------


def eog_amplitude(
    v: ArrayLike,
    wind_class: str | WindClass,
    category: str | float,
    rotor_diameter: float,
    hub_height: float,
) -> Floats:
    """Magnitude V_gust of the extreme operating gust, m/s (2.8 with 1.35 for the printed 1.5).

    Raises
    ------
    InputError
        If `v` is above the 1-year extreme V_e1, where the standard defines no gust.
    """
    speed = _speed(v)
    extreme = float(ewm_speed(hub_height, wind_class, hub_height, return_period=1))
    if np.any(speed > extreme):
        raise InputError(
            f"wind speed = {speed.max():g} m/s is above V_e1 = {extreme:g} m/s: no gust"
        )
    limit = 3.3 * ntm_sigma(speed, category) / _lateral_spread(rotor_diameter, hub_height)
    return np.minimum(1.35 * (extreme - speed), limit)


def edc_angle(
    v: ArrayLike, category: str | float, rotor_diameter: float, hub_height: float
) -> Floats:
    """Magnitude θ_e of the extreme direction change, rad, at most π (2.11)."""
    speed = _speed(v)
    across = ntm_sigma(speed, category) / _lateral_spread(rotor_diameter, hub_height)
    return np.minimum(4 * np.arctan2(across, speed), np.pi)


def _lateral_spread(rotor_diameter: float, hub_height: float) -> float:
    """Reduction of a gust over the rotor disc, 1 + 0.1 D/Λ1."""
    _positive(rotor_diameter=rotor_diameter)
    return 1 + 0.1 * rotor_diameter / length_scale(hub_height)


def ecd_angle(v: ArrayLike, wind_class: str | WindClass) -> Floats:
    """Direction change θ_cg of the coherent gust, rad: 180° below 4 m/s, then 720°/v (2.15).

    Raises
    ------
    InputError
        If `v` is above V_ref, where the standard defines none.
    """
    speed = _speed(v)
    v_ref = class_speeds(wind_class).v_ref
    if np.any(speed > v_ref):
        raise InputError(
            f"wind speed = {speed.max():g} m/s is above V_ref = {v_ref:g} m/s: no gust"
        )
    return np.deg2rad(720.0 / np.maximum(speed, 4.0))


def ews_amplitude(
    v: ArrayLike, category: str | float, rotor_diameter: float, hub_height: float
) -> Floats:
    """Bracket 2.5 + 0.2 β σ1 (D/Λ1)^¼ of the extreme wind shear, m/s, with β = 6.4.

    It multiplies (z − z_hub)/D or y/D and 1 − cos(2πt/T).
    """
    _positive(rotor_diameter=rotor_diameter)
    ratio = (rotor_diameter / length_scale(hub_height)) ** 0.25
    return 2.5 + 0.2 * 6.4 * ntm_sigma(v, category) * ratio
