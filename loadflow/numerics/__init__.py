"""Numerics that no room owns: the convergence record, Newton, band solvers, splines."""
