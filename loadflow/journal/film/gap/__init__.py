"""The gap of a film: cells, where the bore lies, its roughness and what widens it."""
