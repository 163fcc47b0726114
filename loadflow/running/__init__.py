"""Carries a plan out: run folder, processes, progress, the report of a run."""
