"""Basic dynamic capacities: of bearings (ISO 281, DG03), of raceways and slices (ISO/TS 16281).

Formulas in the standards' units (N, mm) inside, SI at the door. ISO/TR 1281-1 gives the closed
forms of the factors that ISO 281 tabulates.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from loadflow.errors import InputError

Array = NDArray[np.float64]

_LINE_REDUCTION = 0.83  # λν of ISO/TS 16281: edge loading and unequal distribution
_THRUST_REDUCTION = 0.73  # λν of thrust roller bearings

# Table 4.8: f_cm over γ for contact angles of 45°, 60°, 75° (ISO 281, thrust ball bearings).
_GAMMA = np.r_[1:11, 12:31:2] / 100
_F_CM = {
    45: "42.1 51.7 58.2 63.3 67.3 70.7 73.5 75.9 78.0 79.7 82.3 84.1 85.1 85.5 85.4 84.9 84.0 82.8 "
    "81.3 79.6",
    60: "39.2 48.1 54.2 58.9 62.6 65.8 68.4 70.7 72.6 74.2 76.6 78.3 79.2 79.6 79.5",
    75: "37.3 45.9 51.7 56.1 59.7 62.7 65.2 67.3 69.2 70.7",
}
_ROUNDED = 1e-3
"""Rad by which an angle may miss the ends of the table: 45° are 0.785."""
_COLUMNS = {np.radians(a): np.array(text.split(), float) for a, text in _F_CM.items()}


def capacity_factor(gamma: float, contact_angle: float) -> float:
    """Factor f_cm of Table 4.8, linear in γ and in the contact angle.

    Parameters
    ----------
    gamma : float
        D_w cos α₀/D_pw, (4.10).
    contact_angle : float
        Nominal contact angle, rad, 45° … 75°.

    Raises
    ------
    InputError
        If γ or the angle is outside the table.
    """
    angles = np.array(list(_COLUMNS))
    if not angles[0] - _ROUNDED <= contact_angle <= angles[-1] + _ROUNDED:
        told = "contact_angle: f_cm is tabulated for 45° … 75°, got "
        told += f"{np.degrees(contact_angle):.4g}°"
        raise InputError(f"{told}; state dynamic_capacity instead")
    upper = int(np.clip(np.searchsorted(angles, contact_angle), 1, 2))
    pair = [_COLUMNS[angles[upper - 1]], _COLUMNS[angles[upper]]]
    column = pair[1] if contact_angle > angles[upper - 1] + _ROUNDED else pair[0]
    last = _GAMMA[len(column) - 1]
    if not _GAMMA[0] <= gamma <= last:
        told = f"gamma: f_cm is tabulated for {_GAMMA[0]} … {last:.2f}, got {gamma:.5g}"
        raise InputError(f"{told}; state dynamic_capacity instead")
    values = [np.interp(gamma, _GAMMA[: len(c)], c) for c in pair]
    return float(np.interp(contact_angle, angles[upper - 1 : upper + 1], values))


def slewing_capacity(
    *,
    balls: int,
    rows: int,
    ball_diameter: float,
    pitch_diameter: float,
    contact_angle: float,
    groove_radius: float,
    factor: float | None = None,
) -> float:
    """Basic dynamic axial capacity C_a of a ball slewing bearing, N, (4.8)–(4.10).

    Parameters
    ----------
    balls, rows : int
        Balls per row and number of rows.
    ball_diameter, pitch_diameter, groove_radius : float
        m.
    contact_angle : float
        Nominal contact angle, rad.
    factor : float, optional
        f_cm; from `capacity_factor` if not given.

    Raises
    ------
    InputError
        If the osculation (r - R_w)/R_w exceeds 0.08, where Ritzer leaves the correction open,
        or the geometry is outside the table.
    """
    osculation = 2 * groove_radius / ball_diameter - 1
    if osculation > 0.08:
        raise InputError(
            f"groove_radius: capacity holds for (r - R_w)/R_w ≤ 0.08, got {osculation:.3g}; "
            "state dynamic_capacity instead"
        )
    if factor is None:
        gamma = ball_diameter * np.cos(contact_angle) / pitch_diameter
        factor = capacity_factor(gamma, contact_angle)
    d = ball_diameter * 1e3
    size = d**1.8 if d <= 25.4 else 3.647 * d**1.4
    angle = (rows * np.cos(contact_angle)) ** 0.7 * np.tan(contact_angle)
    return float(1.3 * factor * angle * balls ** (2 / 3) * size)


def raceway_capacity_thrust(
    capacity: float, balls: int, contact_angle: float, gamma: float, osculation: float = 1.0
) -> tuple[float, float]:
    """Dynamic capacities (Q_ci, Q_ce) of the raceways of one thrust ball row, N, ISO/TS 16281.

    Parameters
    ----------
    capacity : float
        Basic dynamic axial capacity of the row, N.
    balls : int
        Balls in the row.
    contact_angle : float
        Nominal contact angle, rad, below 90°.
    gamma : float
        D_w cos α/D_pw.
    osculation : float
        r_i (2 r_e - D)/(r_e (2 r_i - D)) of the groove radii; 1 for equal grooves.
    """
    ratio = _raceway_ratio(gamma, osculation)
    each = capacity / (balls * np.sin(contact_angle))
    return (
        float(each * (1 + ratio ** (10 / 3)) ** 0.3),
        float(each * (1 + ratio ** (-10 / 3)) ** 0.3),
    )


def raceway_capacity_radial(
    capacity: float,
    balls: int,
    rows: int,
    contact_angle: float,
    gamma: float,
    osculation: float = 1.0,
) -> tuple[float, float]:
    """Dynamic capacities (Q_ci, Q_ce) of the raceways of a radial ball bearing, N, ISO/TS 16281.

    Parameters
    ----------
    capacity : float
        Basic dynamic radial capacity, N.
    balls, rows : int
        Balls per row, rows.
    contact_angle, gamma, osculation : float
        As in `raceway_capacity_thrust`.
    """
    ratio = _raceway_ratio(gamma, osculation)
    each = capacity / (balls * np.cos(contact_angle) ** 0.7 * rows**0.7)
    return (
        float(each / 0.407 * (1 + ratio ** (10 / 3)) ** 0.3),
        float(each / 0.389 * (1 + ratio ** (-10 / 3)) ** 0.3),
    )


def radial_ball_capacity(
    *,
    balls: int,
    rows: int,
    ball_diameter: float,
    contact_angle: float,
    gamma: float,
    inner_groove: float,
    osculation: float = 1.0,
) -> float:
    """Basic dynamic radial capacity C_r of a ball bearing, N, ISO/TR 1281-1 with b_m = 1.3.

    The closed f_c lies up to 2.4 % above the table of ISO 281 for γ > 0.15; give the catalogue's
    capacity where there is one.

    Parameters
    ----------
    balls, rows : int
        Balls per row, rows.
    ball_diameter, inner_groove : float
        m.
    contact_angle, gamma, osculation : float
        As in `raceway_capacity_thrust`.
    """
    f_c = (
        39.9
        * (1 + (_raceway_ratio(gamma, osculation) * 1.04 / 1.044) ** (10 / 3)) ** -0.3
        * gamma**0.3
        * (1 - gamma) ** 1.39
        / (1 + gamma) ** (1 / 3)
        * (2 * inner_groove / (2 * inner_groove - ball_diameter)) ** 0.41
    )
    d = ball_diameter * 1e3
    size = d**1.8 if d <= 25.4 else 3.647 * d**1.4
    return float(1.3 * f_c * (rows * np.cos(contact_angle)) ** 0.7 * balls ** (2 / 3) * size)


def _raceway_ratio(gamma: float, osculation: float) -> float:
    """Capacity of the inner over the outer raceway of a ball bearing."""
    return float(1.044 * ((1 - gamma) / (1 + gamma)) ** 1.72 * osculation**0.41)


def radial_roller_capacity(
    *,
    rollers: int,
    rows: int,
    roller_diameter: float,
    roller_length: float,
    contact_angle: float,
    gamma: float,
) -> float:
    """Basic dynamic radial capacity C_r of a roller bearing, N, ISO/TR 1281-1 with b_m = 1.1.

    Parameters
    ----------
    rollers, rows : int
        Rollers per row, rows.
    roller_diameter, roller_length : float
        Mean diameter and effective length, m.
    contact_angle : float
        rad.
    gamma : float
        D_w cos α/D_pw.
    """
    ratio = 1.04 / 1.038 * _line_ratio(gamma)
    f_c = (
        207.9
        * _LINE_REDUCTION
        * gamma ** (2 / 9)
        * (1 - gamma) ** (29 / 27)
        / (1 + gamma) ** (1 / 4)
        * (1 + ratio**4.5) ** (-2 / 9)
    )
    length = (rows * roller_length * 1e3 * np.cos(contact_angle)) ** (7 / 9)
    return float(1.1 * f_c * length * rollers ** (3 / 4) * (roller_diameter * 1e3) ** (29 / 27))


def slice_capacity(
    capacity: float, rollers: int, rows: int, slices: int, contact_angle: float, gamma: float
) -> tuple[float, float]:
    """Dynamic capacities (q_ci, q_ce) of a slice at the raceways, N, ISO/TS 16281.

    Parameters
    ----------
    capacity : float
        Basic dynamic radial capacity of the bearing, N.
    rollers, rows, slices : int
        Rollers per row, rows, slices per roller.
    contact_angle, gamma : float
        As in `radial_roller_capacity`.
    """
    ratio = _line_ratio(gamma)
    roller = capacity / (_LINE_REDUCTION * rollers * np.cos(contact_angle) * rows ** (7 / 9))
    each = roller * slices ** (-7 / 9)
    return (
        float(each / 0.378 * (1 + ratio**4.5) ** (2 / 9)),
        float(each / 0.364 * (1 + ratio**-4.5) ** (2 / 9)),
    )


def thrust_roller_capacity(
    *,
    rollers: int,
    roller_diameter: float,
    roller_length: float,
    contact_angle: float,
    gamma: float,
) -> float:
    """Basic dynamic axial capacity C_a of one row of a thrust roller bearing, N, ISO/TR 1281-1.

    With b_m = 1. At 90° it gives the tabulated f_c of ISO 281 (105.4 at γ = 0.01), below 90° 2 %
    less.

    Parameters
    ----------
    rollers : int
        Rollers of the row.
    roller_diameter, roller_length : float
        m.
    contact_angle : float
        rad, above 0 and up to 90°.
    gamma : float
        D_w cos α/D_pw, at 90° D_w/D_pw.
    """
    flat = contact_angle > np.pi / 2 - 1e-9
    cos, tan = (1.0, 1.0) if flat else (np.cos(contact_angle), np.tan(contact_angle))
    uneven = 1 - 0.15 * np.sin(contact_angle)  # η: rollers share the load unequally
    f_c = 551.134 * _THRUST_REDUCTION * uneven * gamma ** (2 / 9)
    if flat:
        f_c *= 2 ** (-2 / 9)
    else:
        ratio = 1.04 / 1.038 * _line_ratio(gamma)
        f_c *= (1 - gamma) ** (29 / 27) / (1 + gamma) ** (1 / 4) * (1 + ratio**4.5) ** (-2 / 9)
    length = (roller_length * 1e3 * cos) ** (7 / 9) * tan
    return float(f_c * length * rollers ** (3 / 4) * (roller_diameter * 1e3) ** (29 / 27))


def slice_capacity_thrust(
    capacity: float, rollers: int, slices: int, contact_angle: float, gamma: float
) -> tuple[float, float]:
    """Dynamic capacities (q_ci, q_ce) of a slice of one thrust roller row, N, ISO/TS 16281.

    Parameters
    ----------
    capacity : float
        Basic dynamic axial capacity of the row, N.
    rollers, slices : int
        Rollers of the row, slices per roller.
    contact_angle, gamma : float
        As in `thrust_roller_capacity`.
    """
    ratio = 1.0 if contact_angle > np.pi / 2 - 1e-9 else _line_ratio(gamma)
    each = capacity / (_THRUST_REDUCTION * rollers * np.sin(contact_angle))
    each *= slices ** (-7 / 9)
    return (
        float(each * (1 + ratio**4.5) ** (2 / 9)),
        float(each * (1 + ratio**-4.5) ** (2 / 9)),
    )


def edge_stress(slices: int) -> Array:
    """Stress concentration of each slice of a roller toward its ends, ISO/TS 16281."""
    if slices == 1:
        return np.ones(1)
    along = np.abs(2 * np.arange(slices) - (slices - 1)) / (2 * slices - 2)
    with np.errstate(divide="ignore"):  # the middle slice of an odd number: ln 0, factor 1
        return np.asarray(1 - 0.01 / np.log(1.985 * along))


def _line_ratio(gamma: float) -> float:
    """Capacity of the inner over the outer raceway of a roller bearing."""
    return float(1.038 * ((1 - gamma) / (1 + gamma)) ** (143 / 108))
