"""SKF's model of the friction torque: constants of each series, rolling, sliding and drag.

For comparison: it is scaled from bearings of catalogues, which turn faster than a main bearing.
SI units at the door.

References
----------
SKF, Rolling bearings, chapter Friction: forms of G_rr, G_sl, μ_sl, inlet heating and drag; the
constants R, S, K of each series and the diagram of V_M are in `loadflow/data/skf_friction.toml`.
"""

from __future__ import annotations

import tomllib
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Annotated, Any, Literal, NamedTuple, get_args

import numpy as np
from annotated_types import Ge, Gt
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, ValidityWarning
from loadflow.numerics.fields import check_choice, check_fields, check_one_of

Array = NDArray[np.float64]
CatalogueKind = Literal[
    "cylindrical", "tapered", "spherical", "deep groove", "angular contact", "four-point"
]
_NotNegative = Annotated[float, Ge(0)]
_RPM = 30 / np.pi  # rad/s in 1/min


@dataclass(frozen=True, kw_only=True)
class SkfConstants:
    """Constants of one bearing series; those of SKF's table give `skf_constants`.

    Attributes
    ----------
    kind : {"cylindrical", "tapered", "spherical", "deep groove", "angular contact", "four-point"}
        Type of bearing.
    r1, r2, r3, r4 : float
        R of the rolling torque (cylindrical: R₁; tapered and deep groove: R₁, R₂; angular contact
        and four-point: R₁, R₂, R₃; spherical: all).
    s1, s2, s3, s4 : float
        S of the sliding torque (spherical: all; angular contact and four-point: S₁, S₂, S₃; else
        S₁, S₂).
    axial_factor : float
        Y of tapered bearings.
    starvation, geometry : float
        K_rs (3e-8 oil bath, 6e-8 grease) and K_Z (deep groove and four-point 3.1, angular contact
        4.4, cylindrical 5.1, spherical 5.5, tapered 6).
    roller_geometry : float, optional
        K_L of the drag of rollers in oil (cylindrical 0.65, tapered 0.7, spherical 0.8).

    Raises
    ------
    InputError
        A kind that is none of these, or a negative constant.

    Examples
    --------
    >>> from loadflow.rolling.friction import SkfConstants
    >>> series = SkfConstants(kind="cylindrical", r1=1.54e-6, s1=0.16, s2=0.0015, geometry=5.1)
    >>> series.starvation
    6e-08
    """

    kind: CatalogueKind
    r1: _NotNegative
    s1: _NotNegative
    s2: _NotNegative
    r2: _NotNegative = 0.0
    r3: _NotNegative = 0.0
    r4: _NotNegative = 0.0
    s3: _NotNegative = 0.0
    s4: _NotNegative = 0.0
    axial_factor: _NotNegative = 0.0
    starvation: _NotNegative = 6e-8
    geometry: Annotated[float, Gt(0)] = 5.1
    roller_geometry: Annotated[float, Gt(0)] | None = None

    def __post_init__(self) -> None:
        check_fields(self)
        check_choice(self, "kind", get_args(CatalogueKind))

    @property
    def of_balls(self) -> bool:
        """Whether its bearings roll on balls."""
        return _LAWS[self.kind].balls

    def idle(self) -> Iterator[tuple[str, str]]:
        """Constants that the formulas of the type do not have, and why."""
        what = f"{self.kind} bearings" if self.of_balls else f"{self.kind} rollers"
        for name in ("r2", "r3", "r4", "s3", "s4", "axial_factor", "roller_geometry"):
            if name not in _LAWS[self.kind].read:
                yield name, f"SKF's formulas of {what} have none"


def skf_constants(kind: CatalogueKind, series: str, axial_factor: float = 0.0) -> SkfConstants:
    """Constants of a series from SKF's table, `loadflow/data/skf_friction.toml`.

    Parameters
    ----------
    kind : {"cylindrical", "tapered", "spherical", "deep groove", "angular contact", "four-point"}
        Type of bearing.
    series : str
        One of `skf_series` of that type.
    axial_factor : float
        Y of a tapered bearing; each has its own, and others have none.

    Returns
    -------
    SkfConstants
        Constants of the series.

    Raises
    ------
    InputError
        If there is no such type or series, or `axial_factor` is missing or makes no sense.

    Examples
    --------
    >>> from loadflow.rolling.friction import skf_constants, skf_torque
    >>> found = skf_torque(skf_constants("spherical", "240"), 1e6, 2e5, 1.3, 320e-6, 0.75, 1.09)
    >>> [round(float(torque)) for torque in found]  # N m, rolling and sliding
    [304, 244]
    """
    known = skf_series(kind)
    check_one_of("series", series, known)
    if not (axial_factor > 0 if kind == "tapered" else axial_factor == 0):
        raise InputError(
            "axial_factor: Y of a tapered bearing must be > 0, of others it is left out, "
            f"got {axial_factor} for {kind}"
        )
    return SkfConstants(
        kind=kind, axial_factor=axial_factor, **_skf_table()["series"][kind][series]
    )


def skf_series(kind: CatalogueKind) -> list[str]:
    """Names of the series of a type that SKF's table has.

    Parameters
    ----------
    kind : str
        Type of bearing, as in `skf_constants`.

    Returns
    -------
    list of str
        In the order of the table, for `skf_constants`.

    Examples
    --------
    >>> from loadflow.rolling.friction import skf_series
    >>> skf_series("spherical")[-2:], skf_series("four-point")
    (['248', '249'], ['all'])
    """
    table = _skf_table()["series"]
    check_one_of("kind", kind, table)
    return [*table[kind]]


@lru_cache(maxsize=1)
def _skf_table() -> dict[str, Any]:
    path = resources.files("loadflow.data") / "skf_friction.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))


def skf_torque(
    constants: SkfConstants,
    radial: ArrayLike,
    axial: ArrayLike,
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside_diameter: float,
    boundary: float = 0.15,
    static_capacity: float | None = None,
) -> tuple[Array, Array]:
    """Rolling and sliding torque after SKF, N m, (4.36) without seals and drag.

    Parameters
    ----------
    constants : SkfConstants
        Of the series.
    radial, axial : array_like
        Magnitudes of the loads, N.
    speed : array_like
        rad/s.
    viscosity : array_like
        Kinematic viscosity of the (base) oil, m²/s.
    bore, outside_diameter : float
        m.
    boundary : float
        μ_bl of boundary lubrication.
    static_capacity : float, optional
        C₀, N; of deep groove bearings, whose contact angle follows from F_a/C₀. SKF's sliding
        torque of them jumps where there is no thrust; below 1e-9 F_r there is none.

    Returns
    -------
    tuple of ndarray
        Rolling and sliding torque, N m.

    Raises
    ------
    InputError
        A deep groove bearing without `static_capacity`.

    Examples
    --------
    >>> from loadflow.rolling.friction import SkfConstants, skf_torque
    >>> series = SkfConstants(kind="cylindrical", r1=1.54e-6, s1=0.16, s2=0.0015, geometry=5.1)
    >>> found = skf_torque(series, 1e5, 0.0, 10.0, 320e-6, bore=0.3, outside_diameter=0.5)
    >>> [round(float(torque)) for torque in found]  # rolling, sliding
    [40, 1]
    """
    fr, fa = np.asarray(radial, float), np.asarray(axial, float)
    n = np.abs(np.asarray(speed, float)) * _RPM
    nu, d, big = np.asarray(viscosity, float) * 1e6, bore * 1e3, outside_diameter * 1e3
    mean = (d + big) / 2
    law = _LAWS[constants.kind]
    rolling, sliding = law.parts(constants, _Load(fr, fa, mean, n, static_capacity))
    heated = 1 / (1 + 1.84e-9 * (n * mean) ** 1.28 * nu**0.64)
    crowd = np.sqrt(constants.geometry / (2 * (big - d)))
    refill = np.exp(-constants.starvation * nu * n * (d + big) * crowd)
    dry = np.exp(-2.6e-8 * (n * nu) ** 1.4 * mean)
    friction = dry * boundary + (1 - dry) * law.sliding
    return (
        np.asarray(heated * refill * rolling * (nu * n) ** 0.6 * 1e-3),
        np.asarray(sliding * friction * 1e-3),
    )


class _Load(NamedTuple):
    """Loads (N), mean diameter (mm), speed (1/min) and static capacity (N) of a bearing."""

    fr: Array
    fa: Array
    mean: float
    n: Array
    static_capacity: float | None


_Parts = tuple[Array, Array]


def _cylindrical(c: SkfConstants, load: _Load) -> _Parts:
    fr, fa, mean = load[:3]
    return c.r1 * mean**2.41 * fr**0.31, c.s1 * mean**0.9 * fa + c.s2 * mean * fr


def _tapered(c: SkfConstants, load: _Load) -> _Parts:
    fr, thrust, mean = load.fr, c.axial_factor * load.fa, load.mean
    rolling = c.r1 * mean**2.38 * (fr + c.r2 * thrust) ** 0.31
    return rolling, c.s1 * mean**0.82 * (fr + c.s2 * thrust)


def _spherical(c: SkfConstants, load: _Load) -> _Parts:
    fr, fa, mean = load[:3]
    points = c.r1 * mean**1.85 * (fr + c.r2 * fa) ** 0.54
    lines = c.r3 * mean**2.3 * (fr + c.r4 * fa) ** 0.31
    rolling = np.minimum(points, lines)
    points = c.s1 * mean**0.25 * (fr**4 + c.s2 * fa**4) ** (1 / 3)
    lines = c.s3 * mean**0.94 * (fr**3 + c.s4 * fa**3) ** (1 / 3)
    return rolling, np.minimum(points, lines)


def _deep_groove(c: SkfConstants, load: _Load) -> _Parts:
    fr, mean, capacity = load.fr, load.mean, load.static_capacity
    if capacity is None:
        raise InputError("static_capacity: C₀ gives the contact angle of deep groove bearings")
    # without thrust there is no angle, and SKF has another power of the diameter, so that the
    # torque jumps there: what rounding leaves of the forces of the balls is no thrust
    pushed = load.fa > _NO_THRUST * fr
    fa = np.where(pushed, load.fa, 0.0)
    sine = np.sin(np.radians(24.6 * (np.where(pushed, fa, capacity) / capacity) ** 0.24))
    rolling = c.r1 * mean**1.96 * (fr + c.r2 / sine * fa) ** 0.54
    thrust = c.s1 * mean**-0.145 * (fr**5 + c.s2 * mean**1.5 / sine * fa**4) ** (1 / 3)
    return rolling, np.where(pushed, thrust, c.s1 * mean**-0.26 * fr ** (5 / 3))


def _angular_contact(c: SkfConstants, load: _Load) -> _Parts:
    fr, fa, mean = load[:3]
    flung = mean**4 * load.n**2  # of the balls by the turning of the cage
    rolling = c.r1 * mean**1.97 * (fr + c.r3 * flung + c.r2 * fa) ** 0.54
    sliding = c.s1 * mean**0.26 * ((fr + c.s3 * flung) ** (4 / 3) + c.s2 * fa ** (4 / 3))
    return rolling, sliding


_NO_THRUST = 1e-9  # of the radial load


class _Law(NamedTuple):
    """What SKF has for a type of bearing."""

    parts: Callable[[SkfConstants, _Load], _Parts]
    """G_rr (ν n)^-0.6 and G_sl, N mm, as functions of constants and load."""
    read: tuple[str, ...]
    """Constants beside R₁, S₁, S₂ and K_Z."""
    sliding: float = 0.05
    """μ_EHL (mineral oil)."""
    balls: bool = False


_OF_ANGLED_BALLS = ("r2", "r3", "s3")
_LAWS: dict[CatalogueKind, _Law] = {
    "cylindrical": _Law(_cylindrical, ("roller_geometry",), sliding=0.02),
    "tapered": _Law(_tapered, ("r2", "axial_factor", "roller_geometry"), sliding=0.002),
    "spherical": _Law(_spherical, ("r2", "r3", "r4", "s3", "s4", "roller_geometry")),
    "deep groove": _Law(_deep_groove, ("r2",), balls=True),
    "angular contact": _Law(_angular_contact, _OF_ANGLED_BALLS, balls=True),
    "four-point": _Law(_angular_contact, _OF_ANGLED_BALLS, balls=True),
}


def skf_drag_torque(
    constants: SkfConstants,
    speed: ArrayLike,
    viscosity: ArrayLike,
    bore: float,
    outside_diameter: float,
    oil_level: float,
    width: float | None = None,
) -> Array:
    """Drag M_drag of the oil of a bath after SKF, N m.

    Of a shaft that lies in a large bath at constant speed, its inner ring turning. V_M is read from
    a diagram: within 6 % for H ≥ 0.2 d_m of balls, 20 % of rollers, 40 % at 0.05 d_m. It is that of
    one row: SKF counts the rows of balls in what grows with n² alone, not in the rest.

    Parameters
    ----------
    constants : SkfConstants
        Of the series; of rollers with `roller_geometry`.
    speed, viscosity, bore, outside_diameter
        As `skf_torque`.
    oil_level : float
        H of the oil at rest above the lowest contact of the outer raceway, m; from d_m on the
        bearing counts as under oil in what depends on the angle in the bath.
    width : float, optional
        B of the inner ring, m; of rollers.

    Returns
    -------
    ndarray
        N m.

    Warns
    -----
    ValidityWarning
        An oil of more than 500 mm²/s, or 250 with more than half of the bearing in it.

    Raises
    ------
    InputError
        Rollers without `width` or `roller_geometry`.

    Examples
    --------
    A 6208 that lies in oil to the middle of its lowest balls:

    >>> from loadflow.rolling.friction import skf_constants, skf_drag_torque
    >>> found = skf_drag_torque(
    ...     skf_constants("deep groove", "62"), [50.0, 300.0], 68e-6, 0.04, 0.08, oil_level=6e-3)
    >>> [round(float(torque) * 1e3, 2) for torque in found]  # N mm
    [1.6, 6.4]
    """
    n = np.abs(np.asarray(speed, float)) * _RPM
    nu, d, big = np.asarray(viscosity, float) * 1e6, bore * 1e3, outside_diameter * 1e3
    level, mean, c = oil_level * 1e3, (bore + outside_diameter) * 500, constants
    most = 500.0 if level <= big / 2 else 250.0
    if np.any(nu > most):
        warnings.warn(
            f"SKF's drag of an oil bath holds up to {most:g} mm²/s at this oil_level, "
            f"got {float(np.max(nu)):.0f}",
            ValidityWarning,
            stacklevel=2,
        )
    crowd = c.geometry * (d + big) / (big - d)
    read = _skf_table()["drag"]
    curve = read["balls" if c.of_balls else "rollers"]
    share = float(np.interp(level / mean, read["oil_level"], curve))
    if c.of_balls:
        swept = 0.4 * share * crowd * 1e-12 * mean**5
    else:
        if width is None or c.roller_geometry is None:
            raise InputError("width, roller_geometry: B and K_L are needed for the drag of rollers")
        long = 5 * c.roller_geometry * width * 1e3 / mean
        drag = 2.789e-10 * long**3 - 2.786e-4 * long**2 + 0.0195 * long + 0.6439
        swept = 4 * share * c.roller_geometry * crowd * 1e-12 * drag * width * 1e3 * mean**4
    if level == 0:
        return np.zeros(np.broadcast_shapes(n.shape, nu.shape))
    inside = 2 * np.arccos(1 - min(level, mean) / (0.6 * mean))
    reach = np.sin(inside / 2) if inside <= np.pi else 1.0
    rim = 0.36 * mean**2 * (inside - np.sin(inside)) * 0.05 * crowd
    # n² (n …)^-1.379 in one power, which is 0 at rest
    film = 1.093e-7 * n**0.621 * mean**3 * (mean**2 * reach / nu) ** -1.379 * rim
    return np.asarray((swept * n**2 + film) * 1e-3)
