"""What every iterative solver reports."""

from __future__ import annotations

from dataclasses import dataclass


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
