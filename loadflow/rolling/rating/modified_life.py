"""Modified rating life of ISO 281:2007: lubrication, contamination, reliability; system life."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Annotated, Any, Literal

import numpy as np
from annotated_types import Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_choice, check_fields, check_one_of
from loadflow.rolling.rating import safety
from loadflow.tribology.lubricants import Oil

Array = NDArray[np.float64]
Kind = Literal["radial-ball", "radial-roller", "thrust-ball", "thrust-roller"]

SLOW_POWER = 0.83
"""Power of the speed, below 1000 1/min, that κ follows: ν₁ falls with it [ISO 281 (28)]."""

LARGEST_FACTOR = 50.0  # of a_ISO
LEAST_FACTOR = 0.1
KAPPA_RANGE = (0.1, 4.0)  # below: no factor; above: counts as the upper end

WEIBULL = {"ball": 10 / 9, "roller": 9 / 8}

# ISO 281 (31)–(42): (constant, numerator, exponent of κ) of the bracket for κ < 0.4, < 1, ≤ 4
_BRACKETS = {
    "ball": ((2.5671, 2.2649, 0.054381), (2.5671, 1.9987, 0.19087), (2.5671, 1.9987, 0.071739)),
    "roller": ((1.5859, 1.3993, 0.054381), (1.5859, 1.2348, 0.19087), (1.5859, 1.2348, 0.071739)),
}
# exponents of the bracket, of the load ratio and of the whole; what divides the load ratio
_SHAPE: dict[str, tuple[float, float, float, float]] = {
    "radial-ball": (0.83, 1 / 3, -9.3, 1.0),
    "radial-roller": (1.0, 0.4, -9.185, 1.0),
    "thrust-ball": (0.83, 1 / 3, -9.3, 3.0),
    "thrust-roller": (1.0, 0.4, -9.185, 2.5),
}
_A1 = {
    0.90: 1.0, 0.95: 0.64, 0.96: 0.55, 0.97: 0.47, 0.98: 0.37, 0.99: 0.25, 0.992: 0.22,
    0.994: 0.19, 0.996: 0.16, 0.998: 0.12, 0.999: 0.093, 0.9992: 0.087, 0.9994: 0.080,
    0.9995: 0.077,
}  # fmt: skip

# ISO 281 annex A: e_C = min(a κ^0.68 D_pw^0.55, 1) (1 - b/D_pw^(1/3)), D_pw in mm
_CLEANLINESS = {
    "oil, filtered, -/13/10": (0.0864, 0.5663),
    "oil, filtered, -/15/12": (0.0432, 0.9987),
    "oil, filtered, -/17/14": (0.0288, 1.6329),
    "oil, filtered, -/19/16": (0.0216, 2.3362),
    "oil, unfiltered, -/13/10": (0.0864, 0.5796),
    "oil, unfiltered, -/15/12": (0.0288, 1.141),
    "oil, unfiltered, -/17/14": (0.0133, 1.670),
    "oil, unfiltered, -/19/16": (0.00864, 2.5164),
    "oil, unfiltered, -/21/18": (0.00411, 3.8974),
    "grease, high cleanliness": (0.0864, 0.6796),
    "grease, normal cleanliness": (0.0432, 1.141),
    "grease, slight to typical contamination": (0.0177, 1.887),
    "grease, severe contamination": (0.0115, 2.662),
    "grease, very severe contamination": (0.00617, 4.06),
}
CLEANLINESS = tuple(_CLEANLINESS)


@dataclass(frozen=True, kw_only=True)
class Lubrication:
    """Lubrication of a bearing at work.

    Attributes
    ----------
    oil : Oil
        The oil or the base oil of the grease, from `loadflow.tribology.lubricant` or of its own.
    temperature : float
        K.
    cleanliness : str
        One of `CLEANLINESS`: system and ISO 4406 class, or grease and its state.

    Examples
    --------
    >>> from loadflow.rolling import Lubrication
    >>> from loadflow.tribology import lubricant
    >>> Lubrication(oil=lubricant("iso-vg-220"), temperature=333.15).cleanliness
    'grease, normal cleanliness'
    """

    oil: Oil
    temperature: Annotated[float, Gt(0)]
    cleanliness: str = "grease, normal cleanliness"

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "cleanliness", CLEANLINESS)


def reference_viscosity(speed: ArrayLike, pitch_diameter: float) -> Array:
    """Kinematic viscosity ν₁ that separates the surfaces, m²/s, at `speed` (rad/s), ISO 281 (28).

    Parameters
    ----------
    speed : array_like
        rad/s; the sign does not count.
    pitch_diameter : float
        m.
    """
    n = np.abs(np.asarray(speed, float)) * 30 / math.pi
    slow = safety.ratio(45_000.0, np.minimum(n, 1000.0) ** SLOW_POWER)
    fast = 4500.0 / np.sqrt(np.maximum(n, 1000.0))
    return np.asarray(np.where(n < 1000, slow, fast) / math.sqrt(pitch_diameter * 1e3) * 1e-6)


def viscosity_ratio(lubrication: Lubrication, speed: ArrayLike, pitch_diameter: float) -> Array:
    """Viscosity ratio κ = ν/ν₁ of the oil at its temperature."""
    nu = lubrication.oil.kinematic_viscosity(lubrication.temperature)
    return np.asarray(nu / reference_viscosity(speed, pitch_diameter))


def contamination_factor(cleanliness: str, kappa: ArrayLike, pitch_diameter: float) -> Array:
    """Contamination factor e_C of ISO 281 annex A.

    Parameters
    ----------
    cleanliness : str
        One of `CLEANLINESS`.
    kappa : array_like
        Viscosity ratio.
    pitch_diameter : float
        m.

    Raises
    ------
    InputError
        If `cleanliness` is unknown.
    """
    check_one_of("cleanliness", cleanliness, CLEANLINESS)
    a, b = _CLEANLINESS[cleanliness]
    d = pitch_diameter * 1e3
    if cleanliness == "grease, slight to typical contamination" and d >= 500:
        b = 1.677
    film = np.minimum(a * np.asarray(kappa, float) ** 0.68 * d**0.55, 1.0)
    return np.asarray(np.maximum(film * (1 - b / np.cbrt(d)), 0.0))


def fatigue_limit(static_capacity: float, kind: Kind, pitch_diameter: float) -> float:
    """Fatigue load limit C_u, N, by the simplified rule of ISO 281 annex B.

    Parameters
    ----------
    static_capacity : float
        Basic static capacity C₀, N.
    kind : str
        Kind of bearing.
    pitch_diameter : float
        m.
    """
    ball = kind.endswith("ball")
    large = max(pitch_diameter / 0.1, 1.0)
    return static_capacity / (22 if ball else 8.2) * large ** (-0.5 if ball else -0.3)


def life_factor(
    kappa: ArrayLike, load_ratio: ArrayLike, kind: Kind, limit: float = LARGEST_FACTOR
) -> Array:
    """Life modification factor a_ISO, ISO 281 (31)–(42), at most 50.

    Parameters
    ----------
    kappa : array_like
        Viscosity ratio, at least 0.1; above 4 it counts as 4.
    load_ratio : array_like
        e_C C_u/P.
    kind : {"radial-ball", "radial-roller", "thrust-ball", "thrust-roller"}
        Kind of bearing.
    limit : float
        Largest factor allowed, up to 50; IEC 61400-4 allows 3.8 in gearboxes.

    Returns
    -------
    ndarray
        a_ISO.

    Raises
    ------
    InputError
        If `kind` is unknown, κ is below 0.1, where the standard gives no factor, or `limit` is not
        within 0.1 … 50.

    Examples
    --------
    >>> [round(float(life_factor(k, 0.3, "radial-ball")), 2) for k in (0.5, 1.0, 4.0)]
    [1.23, 15.57, 50.0]
    """
    check_one_of("kind", kind, _SHAPE)
    thinnest, thickest = KAPPA_RANGE
    k = np.minimum(np.asarray(kappa, float), thickest)
    if not np.all(k >= thinnest):
        raise InputError(
            f"kappa: ISO 281 holds for κ ≥ 0.1, got {np.min(k):.3g}: the film is too thin; take "
            "a thicker oil or the basic rating life"
        )
    if not 0.1 <= limit <= LARGEST_FACTOR:
        raise InputError(f"limit: must lie in 0.1 … {LARGEST_FACTOR:g}, got {limit}")
    inner, power, outer, share = _SHAPE[kind]
    low, middle, high = (
        np.maximum(top - slope / k**exponent, 0.0) ** inner  # below 0 only out of its range
        for top, slope, exponent in _BRACKETS[kind.split("-")[1]]
    )
    bracket = np.where(k < 0.4, low, np.where(k < 1, middle, high))
    rest = 1 - bracket * (np.asarray(load_ratio, float) / share) ** power
    least = (10 * limit) ** (1 / outer)  # where 0.1 rest^outer reaches the limit
    return np.asarray(0.1 * np.maximum(rest, least) ** outer)


def reliability_factor(reliability: float = 0.90) -> float:
    """Life factor a₁ of ISO 281 table 12.

    Parameters
    ----------
    reliability : float
        0.90, 0.95, 0.96, 0.97, 0.98, 0.99, 0.992, 0.994, 0.996, 0.998, 0.999, 0.9992, 0.9994 or
        0.9995.

    Raises
    ------
    InputError
        For another reliability.
    """
    if reliability not in _A1:
        raise InputError(f"reliability: must be one of {', '.join(map(str, _A1))}")
    return _A1[reliability]


@dataclass(frozen=True)
class LifeModification:
    """Life modification factor of ISO 281 with what leads to it; arrays over load and speed.

    Attributes
    ----------
    viscosity_ratio : ndarray
        κ.
    contamination : ndarray
        e_C.
    fatigue_limit : float
        C_u, N.
    load_ratio : ndarray
        e_C C_u/P.
    factor : ndarray
        a_ISO.
    thick : ndarray of bool
        Whether κ is above 4, where it counts as 4.
    capped : ndarray of bool
        Whether a_ISO would be larger than its limit.

    Examples
    --------
    >>> from loadflow.rolling import BallBearing, Lubrication
    >>> from loadflow.tribology import lubricant
    >>> bearing = BallBearing(balls=16, ball_diameter=0.04, pitch_diameter=0.5,
    ...     groove_radius=0.0208)
    >>> oil = Lubrication(oil=lubricant("mineral-vg-320"), temperature=323.15)
    >>> found = bearing.life_modification([1e4, 1e5], 10.0, oil)
    >>> bool(found.factor[0] > found.factor[1]), found.thick.tolist()
    (True, [False, False])
    """

    viscosity_ratio: Array
    contamination: Array
    fatigue_limit: float
    load_ratio: Array
    factor: Array
    thick: NDArray[np.bool_]
    capped: NDArray[np.bool_]


def life_modification(
    load: ArrayLike,
    speed: ArrayLike,
    *,
    lubrication: Lubrication,
    kind: Kind,
    pitch_diameter: float,
    static_capacity: float,
    limit: float = LARGEST_FACTOR,
) -> LifeModification:
    """Life modification factor a_ISO of a bearing at work, and which limits of it act.

    Parameters
    ----------
    load : array_like
        Dynamic equivalent (reference) load, N.
    speed : array_like
        rad/s.
    lubrication : Lubrication
        Oil, temperature, cleanliness.
    kind : str
        Kind of bearing, see `life_factor`.
    pitch_diameter, static_capacity : float
        m, N.
    limit : float
        See `life_factor`.

    Returns
    -------
    LifeModification
        Factor a_ISO with κ, e_C, C_u and the limits that act.

    Raises
    ------
    InputError
        As `life_factor`.

    Examples
    --------
    >>> from loadflow.rolling import Lubrication, life_modification
    >>> from loadflow.tribology import lubricant
    >>> work = {"kind": "radial-ball", "pitch_diameter": 0.065, "static_capacity": 20e3}
    >>> oil = Lubrication(oil=lubricant("iso-vg-68"), temperature=333.15)
    >>> found = life_modification(2000.0, 100.0, lubrication=oil, **work)
    >>> bool(0.1 < found.viscosity_ratio < 4.0)
    True
    """
    kappa = viscosity_ratio(lubrication, speed, pitch_diameter)
    clean = contamination_factor(lubrication.cleanliness, kappa, pitch_diameter)
    fatigue = fatigue_limit(static_capacity, kind, pitch_diameter)
    ratio = clean * safety.ratio(fatigue, load)
    factor = life_factor(kappa, ratio, kind, limit)
    return LifeModification(
        viscosity_ratio=kappa,
        contamination=clean,
        fatigue_limit=fatigue,
        load_ratio=ratio,
        factor=factor,
        thick=np.broadcast_to(kappa > KAPPA_RANGE[1], factor.shape),
        capped=factor >= limit * (1 - 1e-12),
    )


def modified_life(
    life: ArrayLike, load: ArrayLike, speed: ArrayLike, *, reliability: float = 0.90, **work: Any
) -> Array:
    """Modified (reference) rating life L_nm = a₁ a_ISO L10, of the unit of `life`.

    Parameters
    ----------
    life : array_like
        Basic rating or reference life.
    load, speed : array_like
        Dynamic equivalent (reference) load, N, and rad/s.
    reliability : float
        One of those of `reliability_factor`, 0.90 … 0.9995.
    **work
        The further arguments of `life_modification`, which also tells κ and which limits act.

    Returns
    -------
    ndarray
        L_nm.

    Raises
    ------
    InputError
        As `life_factor` and `reliability_factor`.

    Examples
    --------
    >>> from loadflow.rolling import Lubrication, modified_life
    >>> from loadflow.tribology import lubricant
    >>> work = {"kind": "radial-ball", "pitch_diameter": 0.065, "static_capacity": 20e3}
    >>> oil = Lubrication(oil=lubricant("iso-vg-68"), temperature=333.15)
    >>> life = modified_life(100.0, 2000.0, [10.0, 100.0], lubrication=oil, **work)
    >>> bool(life[0] < life[1])  # the faster, the thicker the film
    True
    """
    factor = life_modification(load, speed, **work).factor
    return np.asarray(reliability_factor(reliability) * factor * np.asarray(life, float))


def system_life(lives: ArrayLike, exponent: float = WEIBULL["roller"], axis: int = -1) -> Array:
    """Life that all parts of a system survive alike: (Σ L^-e)^(-1/e).

    Parameters
    ----------
    lives : array_like
        Lives of raceways, rows or bearings, in one unit, at one reliability.
    exponent : float
        Weibull slope e: 10/9 of balls, 9/8 of rollers (`WEIBULL`), 1.5 in IEC 61400-4.
    axis : int
        Axis of the parts.

    Returns
    -------
    ndarray
        In the unit of `lives`.

    Raises
    ------
    InputError
        If a life is not positive.

    Examples
    --------
    >>> from loadflow.rolling import system_life
    >>> round(float(system_life([1e5, 1e5])))
    54003
    """
    parts = np.asarray(lives, float)
    if not np.all(parts > 0):
        raise InputError(f"lives: must be > 0, got {np.min(parts):g}")
    return safety.ratio(1.0, (parts**-exponent).sum(axis=axis)) ** (1 / exponent)
