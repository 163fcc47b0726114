"""When an iterative solver stops, and what it then reports."""

from __future__ import annotations

import math
from dataclasses import dataclass

from loadflow.numerics.fields import require


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
    Limits(tolerance=1e-10, max_iterations=60, strict=False)
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
    """A `Control` with its defaults filled in."""

    tolerance: float
    max_iterations: int
    strict: bool = True
