"""The gap of a film: cells, bore, grooves, roughness and what widens it; turbulence in it."""
