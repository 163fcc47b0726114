"""Compiled loops of the rung "reduced" with effects."""
