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

from dataclasses import dataclass

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


def rounding_level(terms: float) -> float:
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
