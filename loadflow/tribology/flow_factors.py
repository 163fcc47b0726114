"""Flow and friction factors of a film between rough surfaces after Patir and Cheng.

With H = h/σ, h the gap of the mean planes and σ the combined roughness, the averaged Reynolds
equation and the mean shear stress are

    ∂x(φ_x h³/(12 η) ∂x p) + ∂z(φ_z h³/(12 η) ∂z p)
        = U₊ ∂x⟨h_T⟩ + U₋ σ ∂x φ_s + ∂t⟨h_T⟩,     U₊ = (U₁ + U₂)/2, U₋ = (U₁ - U₂)/2
    τ = η (U₁ - U₂)/h (φ_f ± φ_fs) ± φ_fp h/2 ∂x p

with φ_s = (σ₁² Φ_s(H, γ₁) - σ₂² Φ_s(H, γ₂))/σ² of surfaces 1 and 2, φ_fs formed likewise from
Φ_fs, and the Peklenik number γ: length of the roughness along the motion over that across it; 1 is
isotropic, below 1 transverse, above 1 longitudinal. Within loops of a solver, call
`loadflow.tribology.kernels`.

References
----------
Patir, N.; Cheng, H. S.: An average flow model for determining effects of three-dimensional
roughness on partial hydrodynamic lubrication. ASME J. Lubr. Technol. 100 (1978) 12.
Patir, N.; Cheng, H. S.: Application of average flow model to lubrication between rough sliding
surfaces. ASME J. Lubr. Technol. 101 (1979) 220.
Wu, C.; Zheng, L.: An average Reynolds equation for partial film lubrication with a contact factor.
ASME J. Tribology, 1989.
"""

from __future__ import annotations

import warnings
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from loadflow.errors import InputError, ValidityWarning
from loadflow.tribology._flow_coefficients import PATTERNS

Array = NDArray[np.float64]


@dataclass(frozen=True)
class FlowFactors:
    """Factors of the averaged film; all arrays have the common shape of H and γ.

    Attributes
    ----------
    pressure_x, pressure_z : ndarray
        Pressure flow factors φ_x(H, γ) along the motion and φ_z = φ_x(H, 1/γ) across it.
    shear : ndarray
        Shear flow factor Φ_s(H, γ) of one surface.
    friction : ndarray
        Factor φ_f of the shear stress by the motion, h⟨1/h_T⟩.
    friction_shear : ndarray
        Factor Φ_fs(H, γ) of one surface.
    friction_pressure : ndarray
        Factor φ_fp(H, γ) of the shear stress by the pressure's slope.
    slope : FlowFactors, optional
        The derivatives of all factors with respect to H; None within these.

    Examples
    --------
    >>> factors = patir_cheng(3.0)
    >>> round(float(factors.pressure_x), 4), round(float(factors.slope.pressure_x), 4)
    (0.8323, 0.0939)
    """

    pressure_x: Array
    pressure_z: Array
    shear: Array
    friction: Array
    friction_shear: Array
    friction_pressure: Array
    slope: FlowFactors | None = None


def patir_cheng(
    film_parameter: ArrayLike, pattern: ArrayLike = 1.0, *, smooth: bool = False
) -> FlowFactors:
    """Flow and friction factors of rough surfaces [Patir and Cheng 1978, 1979].

    The factors at the tabulated γ = 1/9, 1/6, 1/3, 1, 3, 6, 9 are those printed; between them, the
    factors of the two neighbours are interpolated linearly in ln γ at the same H. (Their
    coefficients cannot be: φ_x has another form above γ = 1.) Left out and interpolated from rows
    twice as far apart, the printed φ_x come back within 0.05 for H ≥ 3, 0.1 at 2 and 0.24 at 1.

    Ranges: φ_x is printed for H > 0.5 (γ ≥ 1) and H > 1 (γ < 1). Below, the formula would become
    negative or unbounded, so each row of the table holds its value at that limit; the conductance
    φ_x h³ then still goes to 0 with the gap. φ_fp is held likewise. Φ_s and Φ_fs fall to 0 with H
    as printed. φ_fp was confirmed in a second source for γ = 1 alone; its coefficients at other γ
    are unverified.

    Parameters
    ----------
    film_parameter : array_like
        H = h/σ ≥ 0 of the nominal gap h, infinite for smooth surfaces.
    pattern : array_like
        Peklenik number γ > 0. Beyond 1/9 … 9 the factors of the nearest end hold, with a
        `ValidityWarning`.
    smooth : bool
        For Newton iterations: Φ_fs, which as printed jumps to 0 at H = 7, fades to 0 over
        H = 6 … 7, and the two laws of Φ_s, 2e-4 apart at H = 5, are blended over 4.75 … 5.25, both
        with two continuous derivatives.

    Returns
    -------
    FlowFactors
        Six factors, and their derivatives with respect to H in `slope`.

    Raises
    ------
    InputError
        If H is negative or not a number, or γ is not positive and finite.

    Examples
    --------
    >>> factors = patir_cheng([1.0, 3.0, 6.0], 1.0)
    >>> factors.pressure_x.round(4).tolist()
    [0.4859, 0.8323, 0.9687]
    >>> factors.friction.round(6).tolist()
    [1.636589, 1.166667, 1.029878]
    >>> bool(patir_cheng(3.0, 6.0).pressure_x > 1 > patir_cheng(3.0, 6.0).pressure_z)
    True
    """
    from loadflow.tribology.kernels import flow_factor_table

    h, gamma = np.broadcast_arrays(np.asarray(film_parameter, float), np.asarray(pattern, float))
    if not np.all(h >= 0):
        raise InputError(f"film_parameter: must be ≥ 0 everywhere, got {h[~(h >= 0)][0]}")
    sound = np.isfinite(gamma) & (gamma > 0)
    if not np.all(sound):
        raise InputError(f"pattern: must be finite and > 0 everywhere, got {gamma[~sound][0]}")
    low, high = PATTERNS[0] * (1 - 1e-12), PATTERNS[-1] * (1 + 1e-12)
    if gamma.size and (gamma.min() < low or gamma.max() > high):
        warnings.warn(
            f"pattern: {gamma.min():g} … {gamma.max():g} leaves the table of Patir and Cheng, "
            "1/9 … 9; the factors at its end are used",
            ValidityWarning,
            stacklevel=2,
        )
    table = flow_factor_table(np.ravel(h), np.ravel(gamma), smooth)
    values, slopes = table.reshape(2, 6, *h.shape)
    return replace(FlowFactors(*values), slope=FlowFactors(*slopes))


def mean_gap(film_parameter: ArrayLike) -> tuple[Array, Array]:
    """Mean gap ⟨h_T⟩/σ of Gaussian surfaces cut where they touch, and the contact factor.

    The Couette and squeeze terms of the averaged Reynolds equation transport ⟨h_T⟩, which stays
    positive where the mean planes overlap.

    Parameters
    ----------
    film_parameter : array_like
        H = h/σ, of any sign.

    Returns
    -------
    gap : ndarray
        ⟨h_T⟩/σ = H/2 (1 + erf(H/√2)) + exp(-H²/2)/√(2π).
    contact_factor : ndarray
        d⟨h_T⟩/dh = (1 + erf(H/√2))/2 [Wu and Zheng 1989].

    Examples
    --------
    >>> gap, factor = mean_gap([0.0, 3.0])
    >>> gap.round(6).tolist(), factor.round(6).tolist()
    ([0.398942, 3.000382], [0.5, 0.99865])
    """
    from loadflow.tribology.kernels import mean_gap_table

    h = np.asarray(film_parameter, float)
    gap, factor = mean_gap_table(np.ravel(h)).reshape(2, *h.shape)
    return gap, factor
