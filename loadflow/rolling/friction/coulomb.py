"""Roller and cage with Coulomb friction (Hampp): forces, moments, losses of the first model stage.

Signed forces on one roller: radial load R, the inertia it needs N (radial) and U (tangential), both
mass times acceleration, and the rib drag M_b over its lever ρ_h. μ is the adhesion of the raceways,
μ' the sliding friction at cage and rib. Plain expressions for floats or arrays; equation numbers
are those of von Hollen 2013, ``variant="printed"`` gives them with their misprints.
"""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.fields import check_one_of

Value = float | NDArray[np.float64]
Driving = Literal["inner", "outer"]
Variant = Literal["physics", "printed"]


def cage_force(
    radial: Value,
    tangential: Value,
    rib_force: Value,
    adhesion: float,
    sliding: float,
    driving: Driving = "inner",
    rib: Literal["outer", "inner"] = "outer",
) -> Value:
    """Tangential force K between an unloaded roller and the cage, N, (4.73), (4.75).

    Parameters
    ----------
    radial, tangential : float or ndarray
        N and U, N.
    rib_force : float or ndarray
        M_b/ρ_h, N.
    adhesion, sliding : float
        μ and μ'.
    driving : {"inner", "outer"}
        Ring that turns.
    rib : {"outer", "inner"}
        Ring with the ribs.

    Returns
    -------
    float or ndarray
        K, N.

    Examples
    --------
    >>> from loadflow.rolling.friction import cage_force
    >>> round(cage_force(-3.18, -0.59, 0.0, adhesion=0.12, sliding=0.04), 2)  # N
    0.21
    """
    check_one_of("driving", driving, ("inner", "outer"))
    check_one_of("rib", rib, ("outer", "inner"))
    side = 1.0 if rib == "outer" else -1.0
    if driving == "inner":
        grip, drag = adhesion * radial, -side * rib_force
    else:
        grip, drag = -adhesion * radial, side * rib_force
    return (grip - tangential + drag) / (1 - adhesion * sliding)


def driving_moment(
    load: Value,
    radial: Value,
    tangential: Value,
    rib_force: Value,
    radius: float,
    adhesion: float,
    sliding: float,
    driving: Driving = "inner",
    rib: Literal["outer", "inner"] = "outer",
    variant: Variant = "physics",
) -> Value:
    """Moment that drives the spin before viscous drag, N m, (4.74), (4.76).

    It contains the cage friction with the sign of von Hollen, which for a driving outer ring helps
    the spin; `pocket_loss` has the dissipative form. Von Hollen prints (1 ∓ μ') for (1 ∓ μ)
    in the rib's term and, in (5.32), in that of U.

    Parameters
    ----------
    load : float or ndarray
        R, N.
    radius : float
        ρ, m.
    radial, tangential, rib_force, adhesion, sliding, driving, rib
        As `cage_force`.
    variant : {"physics", "printed"}
        See the module.

    Returns
    -------
    float or ndarray
        N m.

    Examples
    --------
    >>> from loadflow.rolling.friction import driving_moment
    >>> moment = driving_moment(700.0, 3.0, 0.5, 0.0, 5.5e-3, adhesion=0.12, sliding=0.04)
    >>> round(float(moment), 3)  # N m
    0.926
    """
    check_one_of("variant", variant, ("physics", "printed"))
    check_one_of("driving", driving, ("inner", "outer"))
    check_one_of("rib", rib, ("outer", "inner"))
    sign = -1.0 if driving == "inner" else 1.0
    side = (1.0 if rib == "outer" else -1.0) * -sign
    bind = 1 - adhesion * sliding
    wrong = variant == "printed"
    in_rib = sliding if wrong else adhesion
    in_inertia = sliding if wrong and driving == "outer" else adhesion
    moment = 2 * adhesion * load + adhesion * np.abs(radial) * (1 + sign * sliding) / bind
    moment = moment + sliding * tangential * (1 + sign * in_inertia) / bind
    return radius * (moment + side * sliding * (1 + sign * in_rib) / bind * rib_force)


def rolling_loss(
    load: Value, radial: Value, cage: Value, spin: Value, radius: float, coefficient: float,
    sliding: float,
) -> Value:  # fmt: skip
    """Loss of rolling, μ_R ρ |2R + N + μ'K| ω_roller, W, (5.36), (5.37).

    Parameters
    ----------
    load, radial, cage : float or ndarray
        R, N and K, N.
    spin : float or ndarray
        Absolute spin of the roller, rad/s.
    radius : float
        ρ, m.
    coefficient : float
        μ_R of rolling friction.
    sliding : float
        μ'.

    Returns
    -------
    float or ndarray
        W.

    Examples
    --------
    >>> from loadflow.rolling.friction import rolling_loss
    >>> loss = rolling_loss(700.0, 3.0, 0.0, 280.0, 5.5e-3, coefficient=5e-4, sliding=0.04)
    >>> round(float(loss), 3)  # W
    1.08
    """
    return coefficient * radius * np.abs(2 * load + radial + sliding * cage) * spin


def sliding_loss(
    load: Value, radial: Value, cage: Value, slip: Value, radius: float, sliding: float,
    adhesion_force: Value = 0.0, variant: Variant = "physics",
) -> Value:  # fmt: skip
    """Loss of sliding on the raceways, μ' ρ |2R + N + μ'K| Δω, W, (5.38), (5.39).

    Parameters
    ----------
    load, radial, cage, radius, sliding
        As `rolling_loss`.
    slip : float or ndarray
        Ideal less actual spin, rad/s.
    adhesion_force : float or ndarray
        μ N/(1 - μμ'), only used by "printed": (5.38) has it with the opposite sign in K.
    variant : {"physics", "printed"}
        See the module.

    Returns
    -------
    float or ndarray
        W.

    Examples
    --------
    >>> from loadflow.rolling.friction import sliding_loss
    >>> round(float(sliding_loss(0.0, 3.0, 0.5, 50.0, 5.5e-3, sliding=0.04)), 4)  # W
    0.0332
    """
    check_one_of("variant", variant, ("physics", "printed"))
    force = cage - 2 * adhesion_force if variant == "printed" else cage
    return sliding * radius * np.abs(2 * load + radial + sliding * force) * slip


def pocket_loss(
    cage: Value, spin: Value, radius: float, sliding: float, variant: Variant = "physics"
) -> Value:
    """Loss of roller and cage, μ' ρ |K| |ω_w|, W, (5.40), (5.41).

    Von Hollen prints μ'² for μ', which makes it 25 times too small.

    Parameters
    ----------
    cage : float or ndarray
        Force K between roller and cage, N.
    spin : float or ndarray
        Spin ω_w of the roller, rad/s.
    radius : float
        ρ, m.
    sliding : float
        Friction coefficient μ'.
    variant : {"physics", "printed"}
        See the module.

    Returns
    -------
    float or ndarray
        W.

    Examples
    --------
    >>> from loadflow.rolling.friction import pocket_loss
    >>> round(float(pocket_loss(2.0, 250.0, 5.5e-3, 0.04)), 4)  # W
    0.11
    """
    check_one_of("variant", variant, ("physics", "printed"))
    power = sliding**2 if variant == "printed" else sliding
    return power * radius * np.abs(cage) * np.abs(spin)
