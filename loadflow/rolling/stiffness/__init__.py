"""Stiffness and damping of bearings and of their lubricated contacts."""
