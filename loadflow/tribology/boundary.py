"""Boundary friction: coefficients of material pairs, and the power that touching asperities turn
into heat.
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import lru_cache
from importlib import resources
from typing import Annotated, Any

import numpy as np
from annotated_types import Ge, Gt, Le
from numpy.typing import NDArray

from loadflow.errors import InputError
from loadflow.numerics.fields import check_fields, not_one_of
from loadflow.tribology.traction import boundary_coefficient

Value = float | NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class FrictionPair:
    """Friction of a bearing material on steel.

    Attributes
    ----------
    static : float, optional
        Coefficient of breaking away, f = 2 M/(F D).
    static_scatter : float, optional
        Scatter ± of `static`.
    sliding : float, optional
        Coefficient of the bearing in motion at the relative film thickness `film`. Oil may carry
        most of the load there (metal on polymer: 0.0007), so it is a result to compare with.
    film : float, optional
        h_min over the clearance c at which `sliding` was measured.
    boundary : float, optional
        Coefficient of touching asperities in motion; `static` if not given.
    name, source : str
        What it is, and where the numbers come from.

    Raises
    ------
    InputError
        If a field is out of its range, or neither `static` nor `boundary` is given.

    Examples
    --------
    >>> friction_pair("bronze").boundary_coefficient
    0.3
    """

    static: Annotated[float, Gt(0), Le(2)] | None = None
    static_scatter: Annotated[float, Ge(0), Le(1)] | None = None
    sliding: Annotated[float, Gt(0), Le(2)] | None = None
    film: Annotated[float, Gt(0), Le(1)] | None = None
    boundary: Annotated[float, Gt(0), Le(2)] | None = None
    name: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        check_fields(self)
        if self.boundary is None and self.static is None:
            raise InputError("static, boundary: one of the two coefficients must be given")

    @property
    def boundary_coefficient(self) -> float:
        """Coefficient of touching asperities: `boundary`, else `static`, its upper bound."""
        found = self.static if self.boundary is None else self.boundary
        assert found is not None  # checked when it was made
        return found


def friction_pair(name: str) -> FrictionPair:
    """Pair of the library `loadflow/data/friction_pairs.toml`.

    Parameters
    ----------
    name : str
        One of `friction_pair_names`.

    Returns
    -------
    FrictionPair
        Its coefficients, those that its source gives; the others are None.

    Raises
    ------
    InputError
        If there is none of that name.

    Examples
    --------
    >>> friction_pair("metal-polymer").static
    0.15
    """
    table = _library()
    if name not in table:
        raise InputError(f"friction_pair: {not_one_of(name, sorted(table))}")
    return FrictionPair(name=name, **table[name])


def friction_pair_names() -> list[str]:
    """Names of the pairs of the library.

    Returns
    -------
    list of str
        In the order of the alphabet, for `friction_pair`.

    Examples
    --------
    >>> friction_pair_names()
    ['bronze', 'engine-bearing', 'metal-polymer', 'polymer']
    """
    return sorted(_library())


def boundary_stress(
    pressure: Value, sliding: Value, coefficient: float, reference: float = 1e-3
) -> Value:
    """Shear stress μ p tanh(Δv/v_ref) of touching asperities, Pa, of the sign of the sliding.

    Parameters
    ----------
    pressure : float or ndarray
        Pressure that asperities carry, Pa.
    sliding : float or ndarray
        Sliding speed Δv, m/s.
    coefficient : float
        Boundary friction coefficient μ.
    reference : float
        Speed v_ref over which the friction turns round, m/s.

    Returns
    -------
    float or ndarray
        Pa.

    Examples
    --------
    >>> round(float(boundary_stress(2e6, -1.0, 0.1)))
    -200000
    """
    return boundary_coefficient(sliding, coefficient, reference) * pressure


def contact_power(
    pressure: Value, sliding: Value, coefficient: float, reference: float = 1e-3
) -> Value:
    """Friction power of touching asperities in an area, μ p Δv tanh(Δv/v_ref) ≥ 0, W/m².

    Parameters as of `boundary_stress`.

    Parameters
    ----------
    pressure, sliding, coefficient, reference
        As `boundary_stress`.

    Returns
    -------
    float or ndarray
        W/m².

    Examples
    --------
    >>> round(float(contact_power(2e6, -1.5, 0.1)))
    300000
    """
    return boundary_stress(pressure, sliding, coefficient, reference) * sliding


@lru_cache(maxsize=1)
def _library() -> dict[str, dict[str, Any]]:
    path = resources.files("loadflow.data") / "friction_pairs.toml"
    return tomllib.loads(path.read_text(encoding="utf-8"))
