"""Slip and inertia of rolling elements and cages, over time."""
