"""Speeds, slip and inertia of rolling elements and cages."""
