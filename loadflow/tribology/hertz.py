"""Hertzian contact of elastic bodies: points with exact elliptic integrals, and lines.

Curvatures are given in 1/m, positive where a body is convex. All functions broadcast over arrays.

References
----------
Hertz, H.: Über die Berührung fester elastischer Körper. J. reine angew. Math. 92 (1881).
Harris, T. A.; Kotzalas, M. N.: Essential Concepts of Bearing Technology, chapter 6.
ISO/TS 16281:2008, load deflection of a roller slice.
"""

from __future__ import annotations

import math
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_one_of
from loadflow.tribology.contact_ellipse import ellipse
from loadflow.tribology.hertz_contact import LineContact, PointContact

STEEL_MODULUS = 210e9
STEEL_POISSON = 0.3

Array = NDArray[np.float64]


def effective_modulus(
    modulus: ArrayLike = STEEL_MODULUS,
    poisson: ArrayLike = STEEL_POISSON,
    second_modulus: ArrayLike | None = None,
    second_poisson: ArrayLike | None = None,
) -> Array:
    """Contact modulus E* with 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂, in Pa.

    Parameters
    ----------
    modulus, poisson : array_like
        E₁, Pa, and ν₁ of one body; default steel.
    second_modulus, second_poisson : array_like, optional
        Of the other; default those of the first.

    Returns
    -------
    ndarray
        E*, Pa.

    Raises
    ------
    InputError
        A modulus that is not positive, or a ratio of Poisson outside 0 … 0.5.

    Examples
    --------
    >>> round(float(effective_modulus()) / 1e9, 2)
    115.38
    """
    e1, nu1 = np.asarray(modulus, float), np.asarray(poisson, float)
    e2 = e1 if second_modulus is None else np.asarray(second_modulus, float)
    nu2 = nu1 if second_poisson is None else np.asarray(second_poisson, float)
    for name, e in (("modulus", e1), ("second_modulus", e2)):
        if not np.all(np.isfinite(e) & (e > 0)):
            raise InputError(f"{name}: must be finite and > 0 Pa, got {e}")
    for name, nu in (("poisson", nu1), ("second_poisson", nu2)):
        if not np.all((nu >= 0) & (nu <= 0.5)):
            raise InputError(f"{name}: must lie in 0 … 0.5, got {nu}")
    return np.asarray(1 / ((1 - nu1**2) / e1 + (1 - nu2**2) / e2))


def hertz_point(
    r11: ArrayLike,
    r12: ArrayLike,
    r21: ArrayLike,
    r22: ArrayLike,
    *,
    force: ArrayLike,
    modulus: ArrayLike = STEEL_MODULUS,
    poisson: ArrayLike = STEEL_POISSON,
    second_modulus: ArrayLike | None = None,
    second_poisson: ArrayLike | None = None,
    rung: Literal["exact", "spline", "power", "regression"] = "exact",
) -> PointContact:
    """Hertzian point contact with exact elliptic integrals, (2.1)–(2.5) of [Ritzer 2018].

    The principal planes of the two bodies coincide. All arguments broadcast.

    Parameters
    ----------
    r11, r12 : array_like
        Curvatures of body 1 in plane 1 and plane 2, 1/m, positive if convex.
    r21, r22 : array_like
        Curvatures of body 2 in plane 1 and plane 2, 1/m, negative if concave (a groove).
    force : array_like
        Normal force, N, not negative.
    modulus, poisson : array_like
        Young's modulus, Pa, and Poisson's ratio of body 1, and of body 2 unless given.
    second_modulus, second_poisson : array_like, optional
        The same of body 2.
    rung : {"exact", "spline", "power", "regression"}
        Elliptic integrals: exact; splines (1e-9 off); approximations of Hamrock and Brewe, some per
        cent off (`loadflow.tribology.contact_ellipse`).

    Returns
    -------
    PointContact
        Stiffness factor, approach, largest pressure, semi-axes and ellipticity.

    Raises
    ------
    InputError
        If the summed curvature of a plane is not positive (a line contact or a conforming
        surface), or the force is negative or not finite.

    Examples
    --------
    A ball of 40 mm in a groove of 20.5 mm on a ring of 930 mm radius:

    >>> c = hertz_point(50, 50, -1 / 20.5e-3, 1 / 0.93, force=28_800)
    >>> round(float(c.pressure) / 1e6, 1)
    2238.4
    """
    load = np.asarray(force, float)
    if not np.all(np.isfinite(load) & (load >= 0)):
        raise InputError(f"force: must be finite and ≥ 0 N, got {load}")
    plane1 = np.asarray(r11, float) + np.asarray(r21, float)
    plane2 = np.asarray(r12, float) + np.asarray(r22, float)
    if not np.all((plane1 > 0) & (plane2 > 0)):
        raise InputError(
            "curvatures: their sum must be > 0 1/m in each plane (0 is a line contact, below 0 "
            f"the surfaces conform), got {plane1} and {plane2}"
        )
    total = plane1 + plane2
    ratio = np.maximum(plane1, plane2) / np.minimum(plane1, plane2)
    k, k_integral, e_integral = ellipse(ratio, rung)
    e_star = effective_modulus(modulus, poisson, second_modulus, second_poisson)

    minor = np.cbrt(2 * e_integral / (np.pi * k))  # η of Ritzer; ξ = k η, ψ/ξ below
    psi_xi = 2 * k_integral / (np.pi * k * minor)
    size = np.cbrt(1.5 * load / (total * e_star))
    a, b = k * minor * size, minor * size
    return PointContact(
        stiffness=stiffness_factor(psi_xi, total, e_star),
        approach=psi_xi * size**2 * total / 2,
        pressure=size * total * e_star / (np.pi * k * minor**2),
        semi_axes=(a, b),
        ellipticity=k,
        coefficient=psi_xi,
    )


def stiffness_factor(coefficient: ArrayLike, curvature_sum: ArrayLike, e_star: ArrayLike) -> Array:
    """Stiffness factor K of F = K δ^1.5 from Hertz's coefficient ψ/ξ, N/m^1.5.

    (3.5) of [Ritzer 2018].

    Parameters
    ----------
    coefficient : array_like
        ψ/ξ.
    curvature_sum : array_like
        Sum Σk of the four curvatures, 1/m.
    e_star : array_like
        Contact modulus, Pa (`effective_modulus`).

    Examples
    --------
    >>> round(float(stiffness_factor(1.0, 2.0, 115.38e9)) / 1e9, 2)
    153.84
    """
    total, psi_xi = np.asarray(curvature_sum, float), np.asarray(coefficient, float)
    return np.asarray(e_star, float) / 1.5 * np.sqrt(8 / total) / psi_xi**1.5


def curvature_sum(
    r11: ArrayLike, r12: ArrayLike, r21: ArrayLike, r22: ArrayLike
) -> tuple[Array, Array]:
    """Sum Σk of the four curvatures (1/m) and cos τ of their difference.

    (2.2) and (2.3) of [Ritzer 2018].

    Examples
    --------
    >>> total, cosine = curvature_sum(50, 50, -1 / 20.5e-3, 1 / 0.93)
    >>> round(float(total), 3), round(float(cosine), 4)
    (52.295, 0.9534)
    """
    plane1 = np.asarray(r11, float) + np.asarray(r21, float)
    plane2 = np.asarray(r12, float) + np.asarray(r22, float)
    total = plane1 + plane2
    return total, np.abs(plane1 - plane2) / total


def hertz_line(
    r1: ArrayLike,
    r2: ArrayLike,
    *,
    length: ArrayLike,
    force: ArrayLike,
    modulus: ArrayLike = STEEL_MODULUS,
    poisson: ArrayLike = STEEL_POISSON,
    law: Literal["iso", "palmgren", "lundberg"] = "iso",
) -> LineContact:
    """Hertzian line contact of two cylinders; approach after an empirical law for steel.

    Width and pressure are Hertz's. The approach of a finite line is not a local quantity; `law`
    names the formula: ``"iso"`` is one of the two equal contacts of ISO/TS 16281,
    q = 35 948 δ^(10/9) L^(8/9) (N, mm, δ over both); ``"palmgren"`` is
    δ = 3.84e-5 Q^0.9/L^0.8 (N, mm), both scaled to the given modulus as E*^-0.9; ``"lundberg"`` is
    that of Lundberg and Sjövall for a roller (body 1) on a longer raceway,
    δ = Q/(π E* L) ln(2π E* L² Σρ/(Q ρ₁)).

    Parameters
    ----------
    r1, r2 : array_like
        Curvatures across the line, 1/m, positive if convex; their sum must be positive.
    length : array_like
        Effective length of the line, m.
    force : array_like
        Normal force, N, not negative.
    modulus, poisson : array_like
        Young's modulus, Pa, and Poisson's ratio of both bodies.
    law : {"iso", "palmgren", "lundberg"}
        Formula of the approach.

    Returns
    -------
    LineContact
        Tangent stiffness, approach, largest pressure, half width.

    Raises
    ------
    InputError
        If lengths or the summed curvature are not positive, or the force is negative.

    Examples
    --------
    >>> c = hertz_line(100.0, 0.0, length=0.01, force=1e4)
    >>> round(float(c.pressure) / 1e6)
    1916
    """
    load, span = np.asarray(force, float), np.asarray(length, float)
    total = np.asarray(r1, float) + np.asarray(r2, float)
    if not np.all(np.isfinite(load) & (load >= 0)):
        raise InputError(f"force: must be finite and ≥ 0 N, got {load}")
    if not np.all(span > 0):
        raise InputError(f"length: must be > 0 m, got {span}")
    if not np.all(total > 0):
        raise InputError(f"curvatures: their sum must be > 0 1/m, got {total}")
    e_star = effective_modulus(modulus, poisson)
    semi_width = np.sqrt(4 * load / (np.pi * span * total * e_star))
    if law == "lundberg":
        if not np.all(np.asarray(r1, float) > 0):
            raise InputError(
                f"r1: must be > 0 1/m for a roller (law 'lundberg'), got {np.asarray(r1, float)}"
            )
        approach, stiffness = _lundberg(load, span, total / np.asarray(r1, float), e_star)
    else:
        factor = line_factor(span, e_star, law)
        approach = (load / factor) ** 0.9
        stiffness = 10 / 9 * factor * approach ** (1 / 9)
    return LineContact(
        stiffness=stiffness,
        approach=approach,
        pressure=np.sqrt(load * total * e_star / (np.pi * span)),
        semi_width=semi_width,
    )


def _lundberg(load: Array, span: Array, ratio: Array, e_star: Array) -> tuple[Array, Array]:
    """Approach and tangent stiffness of a roller on a raceway after Lundberg and Sjövall.

    Both are 0 without load, where the logarithm has no bound.
    """
    unit = math.pi * e_star * span
    load, unit, size = np.broadcast_arrays(load, unit, 2 * unit * span * ratio)
    at_work = load > 0
    logarithm = np.log(size / np.where(at_work, load, size))
    if not np.all(logarithm[at_work] > 1):
        raise InputError("force: too large for the law of Lundberg, whose approach no longer grows")
    stiffness = np.divide(unit, logarithm - 1, out=np.zeros(load.shape), where=at_work)
    return load / unit * logarithm, stiffness


def line_factor(
    length: ArrayLike, e_star: ArrayLike | None = None, law: Literal["iso", "palmgren"] = "iso"
) -> Array:
    """Factor c of ``force = c * approach**(10/9)`` for one line contact, N/m^(10/9).

    Parameters
    ----------
    length : array_like
        Effective length, m.
    e_star : array_like, optional
        Contact modulus, Pa (`effective_modulus`); steel if not given.
    law : {"iso", "palmgren"}
        See `hertz_line`.

    Raises
    ------
    InputError
        If `law` is unknown.

    Examples
    --------
    >>> round(float(line_factor(0.01)) / 1e9, 3)
    1.295
    """
    check_one_of("law", law, ("iso", "palmgren"))
    factor = 35_948.0 * 2 ** (10 / 9) if law == "iso" else 3.84e-5 ** (-10 / 9)
    steel = effective_modulus()
    stiffer = 1.0 if e_star is None else np.asarray(e_star, float) / steel
    return factor * stiffer * (np.asarray(length, float) * 1e3) ** (8 / 9) * 1e3 ** (10 / 9)
