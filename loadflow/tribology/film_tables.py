"""Printed tables of the film, interpolated: ISO 7902 between its widths and eccentricities.

The tables in ``loadflow/data/reference`` hold converged values for 1/8 ≤ B/D ≤ 1 and ε ≤ 0.99:
Swift–Stieber rupture, inlet at the widest gap. What is interpolated, by cubic splines over
−ln(1 − ε) and ln(B/D), is the logarithm of their ratio to the short bearing.
"""

from __future__ import annotations

from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError
from loadflow.tribology.film import short_bearing

Array = NDArray[np.float64]

NARROWEST, WIDEST, LARGEST_RATIO = 0.125, 1.0, 0.99


def reference_table(name: str) -> tuple[Array, Array, Array]:
    """B/D (m,), ε (n,) and values (n, m) of a table in ``loadflow/data/reference``.

    Examples
    --------
    >>> widths, ratios, values = reference_table("ref_So_rot.csv")
    >>> values.shape == (ratios.size, widths.size)
    True
    """
    text = (files("loadflow") / "data" / "reference" / name).read_text("utf-8").splitlines()
    widths = np.array([float(head.split("=")[1]) for head in text[0].split(",")[1:]])
    values = np.array([line.split(",") for line in text[1:]], dtype=float)
    return widths, values[:, 0], values[:, 1:]


def tabulated(eccentricity_ratio: ArrayLike, width_ratio: float) -> tuple[Array, Array]:
    """So and β (rad) of the finite bearing from the tables, for ε in [0, 0.99].

    Raises
    ------
    InputError
        B/D outside 1/8 … 1, ε outside 0 … 0.99.

    Examples
    --------
    >>> so, beta = tabulated(0.5, 0.5)
    >>> round(float(so), 4), round(float(np.degrees(beta)), 2)
    (0.3125, 54.99)
    """
    e = _checked(eccentricity_ratio, width_ratio)
    so, beta = short_bearing(e, width_ratio)
    near = np.maximum(e, 0.1)  # the ratio hardly changes below the first row
    return so * _ratio("ref_So_rot.csv", near, width_ratio), beta * _ratio(
        "ref_beta_deg.csv", near, width_ratio
    )


def tabulated_squeeze(eccentricity_ratio: ArrayLike, width_ratio: float) -> Array:
    """So_V = F ψ²/(B D η ε') of pure squeeze from the table; ε < 0 if it falls.

    Raises
    ------
    InputError
        B/D outside 1/8 … 1, ε outside −0.99 … 0.99.

    Examples
    --------
    >>> round(float(tabulated_squeeze(-0.5, 0.5)), 4)
    0.2664
    """
    e = _checked(np.abs(eccentricity_ratio), width_ratio) * np.sign(eccentricity_ratio)
    return _short_squeeze(e, width_ratio) * _ratio("ref_So_squeeze.csv", e, width_ratio)


def tabulated_peak(eccentricity_ratio: ArrayLike, width_ratio: float) -> Array:
    """Largest pressure over the mean pressure F/(B D) from the table, for ε in [0, 0.99].

    Raises
    ------
    InputError
        B/D outside 1/8 … 1, ε outside 0 … 0.99.

    Examples
    --------
    >>> round(float(tabulated_peak(0.5, 0.5)), 4)
    2.4634
    """
    e = np.maximum(_checked(eccentricity_ratio, width_ratio), 0.1)
    return _ratio("peak_pressure.csv", e, width_ratio)


def _checked(ratio: ArrayLike, width: float) -> Array:
    e = np.asarray(ratio, dtype=float)
    if not NARROWEST - 1e-6 <= width <= WIDEST:
        raise InputError(f"width/diameter = {width:.6g} is not allowed: 1/8 … 1 in the tables")
    if e.size and not (e.min() >= 0.0 and e.max() <= LARGEST_RATIO):
        raise InputError(f"ε = {e.min():.6g} … {e.max():.6g} is not allowed: 0 … 0.99")
    return e


def _short_squeeze(e: Array, width: float) -> Array:
    """So_V of the short bearing: pressure only where the squeeze is positive."""
    arc = np.arccos(-e) * (1 + 2 * e**2) + 3 * e * np.sqrt(1 - e**2)
    return 2 * width**2 * arc / (1 - e**2) ** 2.5


def _ratio(name: str, e: Array, width: float) -> Array:
    sign = np.where(e < 0, -1.0, 1.0) if "squeeze" in name else 1.0
    at = sign * np.log1p(-np.abs(e))
    return np.exp(_spline(name).ev(-at, np.log(min(max(width, NARROWEST), WIDEST))))


@cache
def _spline(name: str) -> Any:
    """Spline of the logarithm of a table over its norm."""
    from scipy.interpolate import RectBivariateSpline

    widths, ratios, values = reference_table(name)
    place = -np.sign(ratios) * np.log1p(-np.abs(ratios))
    norm = {
        "ref_So_rot.csv": lambda b: short_bearing(ratios, b)[0],
        "ref_beta_deg.csv": lambda b: np.degrees(short_bearing(ratios, b)[1]),
        "ref_So_squeeze.csv": lambda b: _short_squeeze(ratios, b),
        "peak_pressure.csv": lambda b: np.ones(ratios.size),
    }[name]
    logs = np.log(values / np.stack([norm(b) for b in widths], axis=-1))
    order = np.argsort(widths)
    return RectBivariateSpline(place, np.log(widths[order]), logs[:, order], s=0)
