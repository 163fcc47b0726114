"""When an iteration has an answer: one rule for every solver, compiled loops included.

A residual is a sum of terms that nearly cancel. Each term is rounded, so that the sum cannot fall
below some roundings of the largest ones: *the rounding level*. A step is what the matrix makes of
a residual, so that it cannot fall below what the matrix makes of those roundings: *the finest
step*. Which processor, compiler or library adds the terms up decides where below these levels an
iteration ends, never whether it has an answer. The rule:

- a residual is small that is within its tolerance, or at the rounding level;
- an answer is a state of small residual whose last step was within what is asked of steps, or no
  longer than the finest, or began at the rounding level already.

What fails it is unresolved, and says which residual it reached and which one rounding allows.

Compiled loops take the functions by ``njit(is_small)``; nothing here needs numba.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from loadflow.numerics.fields import require

Level = TypeVar("Level", float, NDArray[np.float64])

EPS = 2.220446049250313e-16
"""Relative distance of neighbouring floating-point numbers."""

DIGITS = 16.0
"""Roundings, of the size of the largest one, that may add up in a sum or a step."""

COARSEST = 1e-6
"""Rounding level of a film's residual, over its scale, above which nothing is left of an answer."""


@dataclass(frozen=True)
class Convergence:
    """Outcome of an iteration.

    Attributes
    ----------
    converged : bool
        Whether the residual fell below the tolerance.
    residual : float
        Final scaled residual (dimensionless; the scale is stated by the solver).
    iterations : int
        Number of iterations taken.
    """

    converged: bool
    residual: float
    iterations: int


@dataclass(frozen=True)
class Control:
    """How hard to solve.

    Attributes
    ----------
    tolerance : float, optional
        On the scaled residual; None: the default of what is called.
    max_iterations : int, optional
        Newton steps of one load, position or time step; None: the default of what is called.
    strict : bool
        Raise for the first load without an answer; else its results are NaN and `converged` is
        False.

    Raises
    ------
    loadflow.errors.InputError
        A tolerance that is not > 0, or fewer iterations than one.

    Examples
    --------
    >>> Control(strict=False).limits(tolerance=1e-10, max_iterations=60)
    Limits(tolerance=1e-10, max_iterations=60, strict=False, refine=True)
    """

    tolerance: float | None = None
    max_iterations: int | None = None
    strict: bool = True

    def __post_init__(self) -> None:
        if self.tolerance is not None:
            good = self.tolerance > 0 and math.isfinite(self.tolerance)
            require(good, "tolerance", self.tolerance, "> 0, finite")
        if self.max_iterations is not None:
            require(self.max_iterations >= 1, "max_iterations", self.max_iterations, "≥ 1")

    def limits(self, tolerance: float, max_iterations: int) -> Limits:
        """Fill in the defaults of what is called."""
        return Limits(
            tolerance if self.tolerance is None else self.tolerance,
            max_iterations if self.max_iterations is None else self.max_iterations,
            self.strict,
        )


@dataclass(frozen=True)
class Limits:
    """A `Control` with its defaults filled in.

    `refine` says whether a load that a model does not solve goes on to a more expensive one.
    """

    tolerance: float
    max_iterations: int
    strict: bool = True
    refine: bool = True


def rounding_level(terms: Level) -> Level:
    """Level of rounding of a sum whose terms have the magnitude `terms`, in the same unit.

    Examples
    --------
    >>> rounding_level(1.0) < 1e-14
    True
    """
    return DIGITS * EPS * terms


def is_small(residual: float, tolerance: float, rounding: float) -> bool:
    """Whether a scaled residual is within its tolerance, or at the rounding level; never if NaN.

    Examples
    --------
    >>> is_small(1e-9, 1e-10, 1e-12), is_small(1e-9, 1e-10, 2e-9), is_small(float("nan"), 1.0, 1.0)
    (False, True, False)
    """
    return residual <= max(tolerance, rounding)


def stalled(step: float, finest: float) -> bool:
    """Whether a step is no longer than the finest, so that none that follows it is.

    Examples
    --------
    >>> stalled(1e-17, rounding_level(1.0)), stalled(1e-3, rounding_level(1.0))
    (True, False)
    """
    return step <= finest


def answered(
    residual: float, tolerance: float, rounding: float, before: float, step: float, asked: float,
    finest: float,
) -> bool:  # fmt: skip
    """Whether an iteration has its answer.

    Parameters
    ----------
    residual, tolerance, rounding : float
        Scaled residual after the last step, its tolerance, and its rounding level.
    before : float
        Scaled residual before that step.
    step, asked, finest : float
        Length of the step, what is asked of it, and that of the finest one, in one unit.

    Examples
    --------
    >>> answered(1e-13, 1e-10, 1e-15, 1e-6, step=1e-9, asked=1e-7, finest=0.0)
    True
    >>> answered(1e-13, 1e-10, 1e-15, 1e-6, step=1e-3, asked=1e-7, finest=1e-9)
    False
    >>> answered(3e-16, 1e-10, 1e-15, 4e-16, step=1e-3, asked=1e-7, finest=1e-9)
    True
    """
    if not is_small(residual, tolerance, rounding):
        return False
    return step <= max(asked, finest) or is_small(before, 0.0, rounding)


def unresolved(residual: float, rounding: float, iterations: float) -> str:
    """What an iteration without an answer says: both residuals, and its steps.

    Examples
    --------
    >>> unresolved(3e-4, 2e-13, 60)
    'residual 0.0003 after 60 steps, where rounding allows 2e-13'
    """
    return (
        f"residual {residual:.3g} after {iterations:.0f} steps, where rounding allows "
        f"{rounding:.3g}"
    )
