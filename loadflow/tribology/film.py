"""Closed forms of the hydrodynamic film in a plain journal bearing.

So = F ψ²/(B D η ω); β is the attitude angle from load to eccentricity; ε = |e|/c. All functions
take arrays of ε in [0, 1). References: Ocvirk 1952; Sommerfeld 1904; Butenschön 1976 (the
polynomials of ISO 7902-2 / DIN 31652-2).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def effective_speed(shaft: float, shell: float = 0.0, load: float = 0.0) -> float:
    """Speed at which a film at rest would carry the same: ω_shaft + ω_shell − 2 ω_load, rad/s.

    (3.8) of [Jonuschies 2015]; a load that turns at half the speed of the shaft finds
    no film.

    Examples
    --------
    >>> effective_speed(10.0, load=5.0)
    0.0
    """
    return shaft + shell - 2.0 * load


def short_bearing(eccentricity_ratio: ArrayLike, width_ratio: float) -> tuple[Array, Array]:
    """So and β (rad) of the short bearing of Ocvirk with the Gümbel condition.

    Examples
    --------
    >>> so, beta = short_bearing(0.6, 1.0)
    >>> round(float(so), 6), round(float(np.degrees(beta)), 4)
    (2.545263, 46.3207)
    """
    e = np.asarray(eccentricity_ratio, dtype=float)
    root = np.sqrt(np.pi**2 * (1 - e**2) + 16 * e**2)
    so = width_ratio**2 * e / (2 * (1 - e**2) ** 2) * root
    return so, np.arctan2(np.pi * np.sqrt(1 - e**2), 4 * e)


def butenschoen(eccentricity_ratio: ArrayLike, width_ratio: float) -> tuple[Array, Array]:
    """So and β (rad) of the finite bearing by Butenschön's polynomials.

    Against the converged solution, at the widths 1, 1/2, 2/5, 1/3, 1/4, 1/5, 1/6 and 1/8 of the
    tables and 0.1 ≤ ε ≤ 0.99, So is off by up to 6.6 % (2.6 % in the mean) and β by up to 2.4°.
    Between B/D = 1/2 and 1, where nothing was fitted, So is off by up to 10 %; below ε = 0.1 β is
    off by up to 5°.

    Examples
    --------
    >>> so, beta = butenschoen(0.5, 0.5)
    >>> round(float(so), 4), round(float(np.degrees(beta)), 2)
    (0.3049, 56.42)
    """
    e, b = np.asarray(eccentricity_ratio, dtype=float), width_ratio
    a1 = np.polyval([5.0141, -10.1073, 7.1161, -1.9456, 1.1642], b)
    a2 = np.polyval([-0.090551, -0.038817, -0.4215, -0.023634, -1.000026], b)
    short, _ = short_bearing(e, b)
    so = short * a1 * (e - 1) / (a2 + e)
    k = [
        6.6294 - 1.591732 * b,
        -13.3414 + 3.424337 * b,
        8.73393 - 2.3291 * b,
        -2.5905 + 0.798745 * b,
        1.152624 - 0.104565 * b,
    ]
    return so, np.polyval(k, e) * np.arctan2(np.pi * np.sqrt(1 - e**2), 2 * e)


def butenschoen_squeeze(eccentricity_ratio: ArrayLike, width_ratio: float) -> Array:
    """So_V = F ψ²/(B D η ε') of pure squeeze; ε > 0 if it grows, ε < 0 if it falls.

    Within 5.4 % of the converged solution at the widths of the tables; between B/D = 1/2 and 1,
    where nothing was fitted, off by up to 20 %.

    Examples
    --------
    >>> round(float(butenschoen_squeeze(0.5, 0.5)), 4)
    3.6448
    """
    e, b = np.asarray(eccentricity_ratio, dtype=float), width_ratio
    a1 = np.polyval([-9.3561, 18.895, -12.2486, 3.2415, 0.70038], b)
    a2 = np.polyval([-0.368928, 0.42278, -0.74224, 0.0157434, -0.999935], b)
    arc = (np.pi / 2 - np.arccos(e) / 2) * (1 + 2 * e**2) + 1.5 * e * np.sqrt(1 - e**2)
    return 4 * b**2 * (1 - e**2) ** -2.5 * arc * a1 * (1 - e) / (-a2 - e)


def side_flow_number(eccentricity_ratio: ArrayLike, width_ratio: float) -> Array:
    """Side flow Q/(D³ ψ ω) of the film that starts at the widest gap, ISO 7902-2.

    Within 1.4 % of the converged solution for 1/8 ≤ B/D ≤ 1.

    Examples
    --------
    >>> round(8 * float(side_flow_number(0.5, 0.5)), 4)
    0.4721
    """
    e, b = np.asarray(eccentricity_ratio, dtype=float), width_ratio
    return 0.25 * (b - 0.223 * b**3) * e


def squeeze_time(
    start: float, end: float, force: float, width: float, radius: float,
    relative_clearance: float, viscosity: float,
) -> float:  # fmt: skip
    """Time (s) in which `force` (N) squeezes a wide film from ε `start` to `end`.

    (1.5) of [Jonuschies 2015], exact for the Gümbel film; the values printed in its
    Table 1-1 are twice as long.

    Examples
    --------
    >>> round(squeeze_time(0.4, 0.8, 500e3, 0.25, 0.5, 1e-3, 0.09), 2)
    0.67
    """

    def travel(e: float) -> float:
        return float(np.arctan((1 + e) / np.sqrt(1 - e**2)) * e / np.sqrt(1 - e**2))

    scale = 24 * viscosity * width * radius / (relative_clearance**2 * force)
    return scale * (travel(end) - travel(start))
