"""Elastic shells: how far a pressure moves the bore, and the film in it."""
