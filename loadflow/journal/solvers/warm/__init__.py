"""Equilibrium of load and heat together."""
